"""Rules: what a map and its derivative are on a box, on an interval."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Conclusion, Subject, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import (
    PRECISIONS,
    Box,
    attempts,
    box_text,
    decide,
    enclosed,
    integer,
    leaves,
    mean_value_form,
    read_box,
)
from proofs.trusted.kernel.laps import SlopeRange, interval_of, meets, shifted, turn_of
from proofs.trusted.kernel.maps import Bent, Jumping, Map, lifted, read_turns, turned
from proofs.trusted.kernel.trees import is_name
from proofs.trusted.numbers import (
    Range,
    between,
    common,
    increasing,
    mean_values,
    show_range,
    within,
)

BITS = PRECISIONS[0]
_MOST_POINTS = 1000
_AT_POINT = 12  # decimals that are written


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
        places = _AT_POINT if all(low == high for low, high in self.box) else 6
        values = " x ".join(between(each, places) for each in self.values)
        rows = ", ".join(
            f"({', '.join(between(each, places) for each in row)})" for row in self.matrix
        )
        return (
            f"{given(map_)}`{name}` is continuously differentiable for {place}, with values in "
            f"{values}{less(map_, self.turns)}, and a derivative with rows in {rows}."
        )


def less(map_: Map, turns: Sequence[int]) -> str:
    """Say how many periods of its angles are taken off images, if it has any."""
    lifts = [f"{lifted(n)} of `{v}`" for v, n in zip(angles(map_), turns, strict=True)]
    return f" ({', '.join(lifts)})" if lifts else ""


def angles(map_: Map) -> list[str]:
    """Return the names of the angles among the variables."""
    return [map_.variables[circle.place] for circle in map_.circles]


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


# -- values ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Image(Conclusion):
    """A map is defined and continuous on a box, and takes it into another one."""

    function: Map
    box: Box
    bounds: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        place, names = box_text(self.box, self.function.variables), labels(self.function)
        return (
            f"for {self.function.definition}: `{self.function.name}` is defined for {place}, and "
            f"its values are {'' if names else 'in '}{box_text(self.bounds, names)}."
        )


def labels(map_: Map) -> tuple[str, ...]:
    """Return names for the values of a map, if it has some.

    They are those of the variables in their places, and after them what is written as a name, as
    the time is; if all values are written as names of others, as states of a flow, these.
    """
    trees, n = [*map(str, getattr(map_, "trees", ()))], len(map_.variables)
    if not all(map(is_name, trees[n:])) or len(trees) < n:
        return ()
    is_other = all(is_name(each) and each not in map_.variables for each in trees)
    names = tuple(trees) if is_other else (*map_.variables, *trees[n:])
    return names if len({*names}) == len(names) else ()


def image(context: Context, reader: Reader) -> Image:
    """Rule `image`: {function F, box, tree, bounds}, bounds being a range for each value.

    Hypothesis: on each leaf of the tree, which divides the box, an enclosure of F, in the natural
    or in the mean value form, lies within the bounds. Conclusion: F is defined on the box, and its
    values there are in the bounds; those of angles are not reduced. Proof. The leaves cover the
    box; an enclosure contains all values on its leaf, and exists only where F is defined.
    """
    function_of, box_of, tree, bounds_of = reader.fields("function", "box", "tree", "bounds")
    function = context.function(function_of)
    box, bounds = read_box(box_of, len(function.variables)), read_box(bounds_of, function.size)
    for leaf in leaves(tree, box):
        decide(function, leaf, partial(_inside, bounds))
    return Image(function, box, bounds)


def _inside(bounds: Box, values: list[Enclosure]) -> bool:
    return all(within(value.range, side) for value, side in zip(values, bounds, strict=True))


# -- what a map avoids -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Avoids(AboutMap):
    """A map takes no point of one interval into another one."""

    function: Subject
    source: Range
    target: Range

    def __post_init__(self) -> None:
        for ends in (self.source, self.target):
            interval_of(self.function, ends)

    @property
    def sentence(self) -> str:
        """Return the statement."""
        source, target = show_range(self.source), show_range(self.target)
        if self.place is not None:
            return f"no phase of {source} has its first impact in {target}."
        name = self.function.name
        return f"{given(self.function)}`{name}` takes no point of {source} into {target}."


def avoids(context: Context, reader: Reader) -> Avoids:
    """Rule `avoids`: {function F of one variable, points x_0 < ... < x_n, target}.

    Conclusion: F takes no point of [x_0, x_n] into the target; if the variable is an angle, modulo
    its period. Proof. Each value at a point of a piece [x_i, x_(i+1)] is in one of the enclosures
    on that piece, be F continuous there or not; they miss the target, less any number of periods.
    """
    function_of, points_of, target_of = reader.fields("function", "points", "target")
    map_, points = read_line(context, function_of, points_of)
    conclusion = Avoids(map_, (points[0], points[-1]), target_of.range())
    for piece in pairwise(points):
        if not misses(map_, piece, conclusion.target):
            raise Unproved(f"a value on {show_range(piece)} is not proved to miss the target")
    return conclusion


def misses(map_: Map, piece: Range, target: Range) -> bool:
    """Whether it is proved that no point of an interval is taken into another one."""
    if isinstance(map_, Jumping):
        places = map_.possible_values(enclosed((piece,), BITS))
        return not any(meets(map_, value.range, target) for (value,) in places)
    return any(not meets(map_, value.range, target) for (value,) in attempts(map_, (piece,)))


# -- slopes ----------------------------------------------------------------------------------------


def slopes(context: Context, reader: Reader) -> SlopeRange:
    """Rule `slopes`: {function F of one variable, points x_0 < ... < x_n, bits}.

    Conclusion: F is C^1 on [x_0, x_n]; F and F' are enclosed at the points, F' on the pieces
    between; if the variable is an angle, F is less as many periods as put it in [0, P).
    Proof. Enclosures exist only where F and its derivative are defined, and the pieces are closed.
    Where F'' is enclosed over a piece of width w, F' lies in F'(x_i) + F'' [0, w] and in
    F'(x_(i+1)) - F'' [0, w] as well, by the mean value theorem.
    """
    function_of, points_of, bits_of = reader.fields("function", "points", "bits")
    map_, points = read_line(context, function_of, points_of)
    bits = integer(bits_of, BITS, PRECISIONS[-1])
    turns, over = [0] * len(map_.circles), [_slope_and_bend(map_, x) for x in pairwise(points)]
    at = [differential_on(map_, ((x, x),), turns, bits) for x in points]
    inner = tuple(each.matrix[0][0] for each in at)
    images = tuple(_reduced(map_, each.values[0], bits) for each in at)
    pieces = [
        slope if bend is None else common(slope, mean_values(*ends, bend, high - low))
        for (slope, bend), ends, (low, high) in zip(
            over, pairwise(inner), pairwise(points), strict=True
        )
    ]
    return SlopeRange(map_, points, inner, images, tuple(pieces))


def read_line(
    context: Context, function_of: Reader, points_of: Reader
) -> tuple[Map, tuple[Fraction, ...]]:
    """Read a map of the line, or of a circle, and points x_0 < ... < x_n."""
    map_, points = context.function(function_of), points_of.numbers(2, _MOST_POINTS)
    if not len(map_.variables) == map_.size == 1 or not increasing(points):
        raise function_of.fail("a map of the line, and points that increase, are expected")
    return map_, points


def _slope_and_bend(map_: Map, piece: Range) -> tuple[Range, Range | None]:
    """Enclose F' on a piece, and F'' if it is known."""
    x = enclosed((piece,), BITS)
    slope = map_.jacobian(x)[0][0].range
    return slope, map_.bend(x).range if isinstance(map_, Bent) else None


def _reduced(map_: Map, value: Range, bits: int) -> Range:
    turn = turn_of(map_)
    return value if turn is None else shifted(map_, value, -int(value[0] // turn), bits)
