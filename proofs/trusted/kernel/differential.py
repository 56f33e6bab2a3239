"""Rule: what a map and its derivative are on a box."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import counted, read_turns, turned
from proofs.trusted.kernel.enclose import (
    PRECISIONS,
    Box,
    box_text,
    enclosed,
    integer,
    mean_value_form,
    read_box,
)
from proofs.trusted.kernel.maps import Map
from proofs.trusted.numbers import Range, between

BITS = PRECISIONS[0]


@dataclass(frozen=True)
class Differential(Conclusion):
    """A map is continuously differentiable on a box; `values`, less some periods of its angles,
    and `matrix`, by rows, enclose what it and its derivative are there.
    """

    function: Map
    box: Box
    turns: tuple[int, ...]
    values: Box
    matrix: tuple[Box, ...]

    @property
    def sentence(self) -> str:
        """Return the statement."""
        map_, name = self.function, self.function.name
        place = box_text(self.box, map_.variables)
        rows = ", ".join(f"({', '.join(map(between, row))})" for row in self.matrix)
        return (
            f"{given(map_)}`{name}` is continuously differentiable for {place}, with values in "
            f"{' x '.join(map(between, self.values))}{less(map_, self.turns)}, and a derivative "
            f"with rows in {rows}."
        )


def less(map_: Map, turns: Sequence[int]) -> str:
    """Say how many periods of its angles images are less, if it has any."""
    lifts = [f"{counted(n)} of `{v}`" for v, n in zip(angles(map_), turns, strict=True)]
    return f" (less {', '.join(lifts)})" if lifts else ""


def angles(map_: Map) -> list[str]:
    """Return the names of the angles among the variables."""
    return [map_.variables[circle.place] for circle in map_.circles]


def given(map_: Map) -> str:
    """Begin a sentence about a map; what the oscillator's is, the text before says."""
    return "" if getattr(map_, "at", None) else f"for {map_.definition}: "


def differential(context: Context, reader: Reader) -> Differential:
    """Rule `differential`: {function F, box, turns, bits}; turns: an integer for each angle of F.

    Conclusion: F is continuously differentiable on the box; its values, less so many periods, and
    its derivative are enclosed, by numbers of so many bits.
    Proof. Enclosures exist only where F and its derivative are defined; values are enclosed in the
    natural form, and in the mean value form: for x in the box and m its middle F(x) is in F(m) +
    F'(box) (x - m).
    """
    names = ("turns",) if reader.has("turns") else ()
    function_of, box_of, bits_of, *_ = reader.fields("function", "box", "bits", *names)
    map_ = context.function(function_of)
    box = read_box(box_of, len(map_.variables))
    bits = integer(bits_of, BITS, PRECISIONS[-1])
    return differential_on(map_, box, read_turns(map_, reader), bits)


def differential_on(map_: Map, box: Box, turns: Sequence[int], bits: int = BITS) -> Differential:
    """Return what `differential` concludes; Unproved where the map is not proved to be smooth."""
    x = enclosed(box, bits)
    values = turned(map_, sharp_values(map_, x), turns)
    rows = tuple(_ranges(row) for row in map_.jacobian(x))
    return Differential(map_, box, tuple(turns), _ranges(values), rows)


def image_of(map_: Map, box: Box, turns: Sequence[int]) -> Box:
    """Return bounds on the values on a box, less so many periods, in the natural form alone."""
    return _ranges(turned(map_, map_.values(enclosed(box, BITS)), turns))


def sharp_values(map_: Map, x: Sequence[Enclosure]) -> list[Enclosure]:
    """Enclose the values on a box in the natural form and in the mean value form."""
    return list(map(Enclosure.meet, map_.values(x), mean_value_form(map_, x)))


def _ranges(values: Sequence[Enclosure]) -> tuple[Range, ...]:
    return tuple(value.range for value in values)
