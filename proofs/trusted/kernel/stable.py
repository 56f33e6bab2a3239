"""Rule: an iterate of a map that contracts a box, and the periodic orbit that attracts it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.conclusion import Conclusion, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import MAX_POWER
from proofs.trusted.kernel.cycle import PeriodicOrbit, periodic_orbit
from proofs.trusted.kernel.differential import sharp_values
from proofs.trusted.kernel.enclose import Box, enclosed, integer
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.periodic import Closing
from proofs.trusted.kernel.zeros import Rows, require_zero
from proofs.trusted.numbers import between, show_range

_BITS = 128


@dataclass(frozen=True)
class StableCycle(Conclusion):
    """A map takes the first of these boxes into the second one, and so on; its iterate, of as many
    steps times `rounds`, takes the first into itself, and contracts it.
    """

    function: Map
    boxes: tuple[Box, ...]
    rounds: int = 1

    @property
    def sentence(self) -> str:
        count, map_ = len(self.boxes), self.function
        first, *others = self.boxes
        boxes = ", ".join(
            [" x ".join(map(show_range, first)), *(" x ".join(map(between, box)) for box in others)]
        )
        sides = f"({' x '.join(f'`{each}`' for each in map_.variables)})"
        power = count * self.rounds
        iterate = f"{map_.name}^{power}" if power > 1 else map_.name
        return (
            f"{given(map_)}{map_.name} has a {count}-periodic orbit, a point in each of {boxes} "
            f"{sides}, in this order; {iterate} contracts the first box, so that this orbit "
            "attracts every motion with a point there."
        )

    @property
    def brief(self) -> str:
        where = f"at {self.place} " if self.place else given(self.function)
        return f"{where}{self.function.name} has a stable {len(self.boxes)}-periodic orbit"


def stable_cycle(context: Context, reader: Reader) -> StableCycle:
    """Rule `stable-cycle`: {orbit: the witness of a `periodic-orbit`, rounds m}; n = m times k.

    Hypotheses: those of that rule, of the period k, B being the box; by `require_zero` with -1 for
    the matrix F^n(x) - m p - x has exactly one zero in B. Conclusion: the orbit attracts all of B.

    Proof. The operator of Krawczyk is then c + F^n(c) - m p - c + (F^n)' (B - c), c the middle: by
    the mean value theorem it contains F^n(B) less m p, and F^n contracts B, as in `unique-zero`. So
    all of B comes to the one fixed point of F^n there, which the orbit's point is.
    """
    orbit_of, rounds_of = reader.fields("orbit", "rounds")
    orbit, rounds = periodic_orbit(context, orbit_of), integer(rounds_of, 1, MAX_POWER)
    turns = tuple(rounds * count for count in orbit.turns)
    closing = Closing(orbit.function, rounds * orbit.period, turns)
    require_zero(closing, orbit.box, minus_one(len(orbit.box)))
    return StableCycle(orbit.function, (orbit.box, *_later(orbit)), rounds)


def minus_one(n: int) -> Rows:
    """Return the matrix -1."""
    return [[Fraction(-(i == j)) for j in range(n)] for i in range(n)]


def _later(orbit: PeriodicOrbit) -> Iterator[Box]:
    """Yield boxes of the points but the first, angles less about as many periods as put the lower
    end in [0, P).
    """
    x = enclosed(orbit.box, _BITS)
    for _ in range(orbit.period - 1):
        x = sharp_values(orbit.function, x)
        for place, period in orbit.function.periods(_BITS).items():
            x[place] = x[place] - period * (x[place].lo // period.lo)
        yield tuple(side.range for side in x)
