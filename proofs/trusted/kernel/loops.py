"""Rule: intervals that a map takes each into the next, and the orbit that attracts them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import prod

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Subject, given, named
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.images import image_range, inside
from proofs.trusted.kernel.laps import SlopeRange, subject_of, turn_of
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.staying import read_part
from proofs.trusted.numbers import Range, ceil_text, show_range

MOST_CELLS = 200


@dataclass(frozen=True)
class StableOrbit(AboutMap):
    """f maps each cell inside the next, the last inside the first, and the loop contracts."""

    function: Subject
    cells: tuple[Range, ...]
    contraction: Range

    def __post_init__(self) -> None:
        ordered = sorted(self.cells)
        turn = turn_of(self.function)
        around = [*ordered, *((x + turn, y + turn) for x, y in ordered[:1] if turn is not None)]
        if not ordered or any(one[1] >= two[0] for one, two in pairwise(around)):
            raise Unproved("the cells of a stable orbit are not apart")
        if not 0 <= self.contraction[0] <= self.contraction[1] < 1:
            raise Unproved("f is not proved to contract around the loop")

    @property
    def sentence(self) -> str:
        cells = ", ".join(map(show_range, self.cells))
        points, circle = "phases" if self.place else "points", turn_of(self.function) is not None
        modulo = ", mod 2 pi" if self.place else ", modulo the period" if circle else ""
        more = getattr(self.function, "of_orbits", "")
        return (
            f"{given(self.function)}{self.brief}, one point in each of {cells}{modulo}, in this "
            f"order, and it attracts all {points} of these sets{more}."
        )

    @property
    def brief(self) -> str:
        most = ceil_text(self.contraction[1])
        name, period = named(self.function), len(self.cells)
        return f"{name} has a stable periodic orbit of period {period}, |multiplier| <= {most}"

    @property
    def quantities(self) -> dict[str, Range]:
        return {"multiplier_size": self.contraction}


def stable_orbit(parts: Sequence[SlopeRange]) -> StableOrbit:
    """Theorem. Let f be C^1 on disjoint closed intervals C_1, ..., C_k of the line or of a circle,
    f(C_i) inside C_(i+1), f(C_k) inside C_1, and let the product of sup |f'| be below 1. Then what
    `StableOrbit.sentence` says.

    Proof. f^k maps C_1 into itself and contracts: it has one fixed point there, to which all orbits
    of C_1 come, and its orbit is in the cells in turn, which are apart: its period is k. The others
    come to C_1 first.
    """
    function = subject_of(parts)
    first = min(range(len(parts)), key=lambda i: parts[i].ends)
    parts = [*parts[first:], *parts[:first]]
    led([image_range(parts[-1])], parts)
    zero, one = Fraction(0), Fraction(1)
    most = prod((part.steepest for part in parts), start=one)
    least = prod((max(part.minimum[0], -part.maximum[1], zero) for part in parts), start=one)
    return StableOrbit(function, tuple(part.ends for part in parts), (least, most))


def prove_stable_orbit(context: Context, reader: Reader) -> StableOrbit:
    """Rule `stable-orbit`: {cells: [{slopes, domain}]}, as in `staying-set`.

    Conclusion: `stable_orbit`.
    """
    (cells_of,) = reader.fields("cells")
    parts = [read_part(context, cell) for cell in cells_of.items(1, MOST_CELLS)]
    METER.get().spend(len(parts))
    return stable_orbit(parts)


def led(images: list[Range], parts: Sequence[SlopeRange]) -> list[Range]:
    """Return what f leads to: images inside the first part, that inside the second, and so on."""
    for part in parts:
        if not all(inside(part.function, image, part.ends) for image in images):
            raise Unproved("an image is not proved to be inside the next set")
        images = [image_range(part)]
    return images
