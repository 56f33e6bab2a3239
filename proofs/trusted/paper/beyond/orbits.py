"""Stable periodic orbits of the plastic map, at whose impacts the mass leaves at once. X4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import prod

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import TURN, Range, ceil_text, show_range
from proofs.trusted.paper.staying import read_part
from proofs.trusted.parameters import Place
from proofs.trusted.slopes import SlopeRange, image_range, inside

_MOST_IMPACTS = 200


@dataclass(frozen=True)
class StableOrbit(Conclusion):
    """f maps each cell inside the next, the last inside the first, and the loop contracts."""

    at: Place
    cells: tuple[Range, ...]
    contraction: Range

    def __post_init__(self) -> None:
        ordered = sorted(self.cells)
        around = [*ordered, *((low + TURN, high + TURN) for low, high in ordered[:1])]
        if not ordered or any(one[1] >= two[0] for one, two in pairwise(around)):
            raise Unproved("the cells of a stable orbit are not apart")
        if not 0 <= self.contraction[0] <= self.contraction[1] < 1:
            raise Unproved("f is not proved to contract around the loop")

    @property
    def sentence(self) -> str:
        named = ", ".join(map(show_range, self.cells))
        return (
            f"{self.brief}, one point in each of {named}, mod 2 pi, in this order, and it "
            "attracts all phases of these sets; all its impacts are transversal, and after each "
            "the mass leaves the table at once."
        )

    @property
    def brief(self) -> str:
        most = ceil_text(self.contraction[1])
        return f"f has a stable periodic orbit of period {len(self.cells)}, |multiplier| <= {most}"

    @property
    def quantities(self) -> dict[str, Range]:
        return {"multiplier_size": self.contraction}


def stable_orbit(parts: Sequence[SlopeRange]) -> StableOrbit:
    """Theorem. Let f be C^1 on disjoint closed intervals C_1, ..., C_k of phases,
    f(C_i) inside C_(i+1), f(C_k) inside C_1, and let the product of sup |f'| be below 1. Then what
    `StableOrbit.sentence` says.

    Proof. f^k maps C_1 into itself and contracts: it has one fixed point there, to which all orbits
    of C_1 come, and its orbit is in the cells in turn, which are apart: its period is k. The others
    come to C_1 first.
    """
    if len({part.at for part in parts}) != 1:
        raise Unproved("the hypotheses are about different oscillators")
    first = min(range(len(parts)), key=lambda i: parts[i].ends)
    parts = [*parts[first:], *parts[:first]]
    led([image_range(parts[-1])], parts)
    zero, one = Fraction(0), Fraction(1)
    most = prod((part.steepest for part in parts), start=one)
    least = prod((max(part.minimum[0], -part.maximum[1], zero) for part in parts), start=one)
    return StableOrbit(parts[0].at, tuple(part.ends for part in parts), (least, most))


def led(images: list[Range], parts: Sequence[SlopeRange]) -> list[Range]:
    """Return what f leads to: images inside the first part, that inside the second, and so on."""
    for part in parts:
        if not all(inside(image, part.ends) for image in images):
            raise Unproved("an image is not proved to be inside the next set")
        images = [image_range(part)]
    return images


def prove_stable_orbit(context: Context, reader: Reader) -> StableOrbit:
    """Rule `stable-orbit`: {cells: [{slopes, domain}]}, as in `sticking-motion`.

    Conclusion: `stable_orbit`.
    """
    (cells_of,) = reader.fields("cells")
    parts = [read_part(context, cell) for cell in cells_of.items(1, _MOST_IMPACTS)]
    METER.get().spend(len(parts))
    return stable_orbit(parts)
