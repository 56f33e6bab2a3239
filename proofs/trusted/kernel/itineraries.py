"""Rule: the orbit of a point through a horseshoe of a map of the line, or of a circle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion, given, named
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.laps import SlopeRange, point_of
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, between, show, within
from proofs.trusted.parameters import Place

_LONGEST = 10
_SPOTS = ("below I0", "in I0", "between I0 and I1", "in I1", "above I1")


def _spot(base: StayingSet, x: Range) -> int:
    """Return which of `_SPOTS` an enclosed phase is in: 1 and 3 are the sets, 0, 2, 4 are not."""
    if not base.is_horseshoe:
        raise Unproved("orbits are followed in a horseshoe, on two sets")
    left, right = (a, b), (c, d) = base.cells
    known = (x[1] < a, within(x, left), b < x[0] and x[1] < c, within(x, right), d < x[0])
    if True not in known:
        raise Unproved("it is not decided in which of I0 and I1 an image is")
    return known.index(True)


@dataclass(frozen=True)
class Itinerary(Conclusion):
    """A point, `phase`, follows a word in I0 and I1 of a horseshoe and then leaves both.

    orbit: the point, and enclosures of its images up to the one that is in neither.
    """

    base: StayingSet
    orbit: tuple[Range, ...]

    at = About("base")

    @property
    def place(self) -> Place | None:
        """The oscillators, if it is about such."""
        return self.base.place

    @property
    def is_foreign(self) -> bool:
        """Whether it is about another map."""
        return self.base.is_foreign

    def __post_init__(self) -> None:
        """Raise Unproved unless the orbit is in the sets, but for its last point."""
        if self.base.signs != (1, 1):
            raise Unproved("orbits are followed where f increases on I0 and on I1")
        for x in self.orbit:
            point_of(self.base.function, x)
        *inside, last = (spot % 2 for spot in self.spots)
        if self.orbit[0] != (self.phase,) * 2 or not all(inside) or last:
            raise Unproved("an orbit starts at one phase and ends where it leaves I0 and I1")

    @cached_property
    def spots(self) -> list[int]:
        """Where the phase and its images are, in `_SPOTS`."""
        return [_spot(self.base, x) for x in self.orbit]

    @property
    def phase(self) -> Fraction:
        """The phase that is followed."""
        return self.orbit[0][0]

    @property
    def cut(self) -> str:
        """The word, and then 0, 1 or 2 as the orbit ends below I0, between, or above I1."""
        return "".join(str(spot // 2) for spot in self.spots)

    @property
    def sentence(self) -> str:
        word, x, function = self.cut[:-1], show(self.phase), self.base.function
        return (
            f"{given(function)}the orbit of {x} has the itinerary {word or 'of no letter'} in "
            f"{self.base.sets}; then {named(function)}^{len(word)}({x}), in "
            f"{between(self.orbit[-1])}, is {_SPOTS[self.spots[-1]]}."
        )


def follow(base: StayingSet, slopes: Sequence[SlopeRange], phase: Fraction) -> Itinerary:
    """Follow a phase through a horseshoe, f being known at points of `slopes`.

    Proof. f increases on I0 and I1, and f(I0), f(I1) do not pass phase 0. So where p <= x <= q are
    points of one set, f(p) <= f(x) <= f(q). Raises Unproved where that does not decide.
    """
    known = [
        (x, point_of(base.function, y))
        for each in slopes
        if each.function == base.function
        for x, y in zip(each.points, each.images, strict=True)
    ]
    orbit = [(phase, phase)]
    while (spot := _spot(base, orbit[-1])) % 2:
        if len(orbit) > _LONGEST:
            raise Unproved(f"the orbit of {show(phase)} stays in I0 and I1 for {_LONGEST} steps")
        METER.get().spend(len(known))
        domain, (low, high) = base.cells[spot // 2], orbit[-1]
        below = [image[0] for p, image in known if domain[0] <= p <= low]
        above = [image[1] for p, image in known if high <= p <= domain[1]]
        if not below or not above:
            raise Unproved("f is not known on both sides of an image")
        orbit.append((max(below), min(above)))
    return Itinerary(base, tuple(orbit))


def itinerary(context: Context, reader: Reader) -> Itinerary:
    """Rule `itinerary`: {horseshoe, slopes: names of such steps, phase}.

    Conclusion: where the phase goes until it leaves I0 and I1, within 10 steps: `follow`.
    """
    base, names, phase = reader.fields("horseshoe", "slopes", "phase")
    slopes = [context.step(name, SlopeRange) for name in names.items(most=10)]
    return follow(context.step(base, StayingSet), slopes, phase.number())
