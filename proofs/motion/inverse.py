"""Inverse branches of the plastic impact map, as series of any order with proved coefficients."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from intervals import Interval, Jet, Undecided
from intervals.generic import ends
from proofs.motion.candidate import next_impact
from proofs.motion.impact import FirstImpact
from proofs.motion.phase import turn
from proofs.trusted.equations import clock, gap, launch, launch_acceleration
from proofs.trusted.numbers import Range

_STEPS = 40  # of Newton's method in floating point


@dataclass(frozen=True)
class InverseBranch:
    """The inverse g of F(y) = y + t - 2 pi turns on a domain, t the time of the first impact.

    The first impact is transversal on the domain, and F' > 0 (see `passes_once`). g is enclosed
    at points to `radius`, which is much more than the rounding at the precision of its arguments.
    """

    impact: FirstImpact
    domain: Range
    radius: Fraction
    _known: dict[Range, Range] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def turns(self) -> int:
        """The turns of the table that leave the image of the middle of the domain in [0, 2 pi)."""
        middle = (self.domain[0] + self.domain[1]) / 2
        found = next_impact(self.impact.flight.system, float(middle))
        if found is None:
            raise Undecided("no first impact in floating point")
        return round((float(middle) + found[0] - found[1]) / 6.283185307179586)

    def passes_once(self, hull: Range) -> bool:
        """Whether it is proved that F' > 0, and that F takes the domain past the hull but once.

        All factors of `slope` but sin(eta t) have known signs. F > b - 2 pi at the lower and
        F < a + 2 pi at the upper end: no other point of the circle's [a, b] than F's is reached.
        """
        flight, (begin, end) = self.impact.flight, self.impact.window
        whole, (low, high) = turn(flight.precision), (Interval(x) for x in hull)
        return (
            flight.clock(begin, end).mass_sin.certainly_negative()
            and self.excess(self.domain[0], high - whole) > 0
            and self.excess(self.domain[1], low + whole) < 0
        )

    def excess(self, phase: Fraction, image: Interval) -> int:
        """Return the sign of F(phase) - x for all x in `image`, 0 if it is not decided.

        Let T = x - phase + 2 pi turns. F(phase) > x means T < t. In the window the gap has the one
        zero t; it is positive before that and negative after.
        """
        bits = image.precision
        time = image - phase + turn(bits) * self.turns
        begin, end = self.impact.window
        if time.sup < begin or time.inf > end:
            return 1 if time.sup < begin else -1
        height = self.impact.thin((phase, phase), bits).gap(time.inf, time.sup)
        if height.certainly_positive() and time.sup <= end:
            return 1
        return -1 if height.certainly_negative() and begin <= time.inf else 0

    def preimage(self, x: Interval) -> Range:
        """Enclose g(X), which increases: F takes the bounds to both sides of X."""
        key = x.inf, x.sup
        if key not in self._known:
            low = self.approximate(x.inf, x.precision) - self.radius
            high = self.approximate(x.sup, x.precision) + self.radius
            if not (self.domain[0] <= low and high <= self.domain[1]):
                raise Undecided("an inverse image seems to lie outside the domain")
            bottom, top = ends(x)
            if not self.excess(low, bottom) < 0 < self.excess(high, top):
                raise Undecided("an inverse image is not proved where it seems to be")
            self._known[key] = low, high
        return self._known[key]

    def approximate(self, x: Fraction, bits: int) -> Fraction:
        """Return about g(x), a multiple of radius / 8, by Newton's method for gap = 0.

        d gap(y, x - y + 2 pi turns) / dy is -sin(eta t) / eta times the launch acceleration.
        """
        system, (low, high) = self.impact.flight.system, map(float, self.domain)
        eta, ahead = float(system.eta), float(x) + 6.283185307179586 * self.turns
        y, step = (low + high) / 2, 1.0
        for _ in range(_STEPS):
            if abs(step) < 1e-13:
                break
            start, now = launch(system.side, eta, float(system.nu), y), clock(eta, ahead - y)
            step = gap(start, now) * eta / (now.mass_sin * launch_acceleration(start))
            y = min(max(y + step, low), high)
        unit, point = self.radius / 8, Interval(x, precision=bits)
        exact = Fraction(y)
        for _ in range((bits // 40).bit_length()):  # each step doubles the 40 good bits
            height, rate = self._at(Jet(point), Jet(Interval(exact, precision=bits)))
            exact = round((exact + (height.value / rate.value).mid) / unit) * unit
        return exact

    def _at(self, x: Jet, y: Jet) -> tuple[Jet, Jet]:
        """Return gap(y, x - y + 2 pi turns) and minus its derivative by y."""
        bits, system = x.value.precision, self.impact.flight.system
        eta, nu = (Interval(z, precision=bits) for z in (system.eta, system.nu))
        start = launch(system.side, eta, nu, y)
        now = clock(eta, x - y + turn(bits) * self.turns)
        return gap(start, now), now.mass_sin / eta * launch_acceleration(start)

    def __call__(self, x: Jet) -> Jet:
        """Return the jet of g(x): Newton's method doubles the number of known coefficients.

        Theorem. Let z be the polynomial of the first m coefficients of y = g(x(h)), and G(y) =
        gap(y, x - y + 2 pi turns). Then y - z = -G(z) / G'(z) up to order 2m, so G(z) begins with
        h^m. Source: Taylor's formula 0 = G(y) = G(z) + G'(z) (y - z) + O((y - z)^2).
        """
        known = [Interval(*self.preimage(x.value), precision=x.value.precision)]
        while len(known) <= x.order:
            m = len(known)
            count = min(2 * m, x.order + 1)
            z = Jet(*known, *[0 * known[0]] * (count - m))
            height, rate = self._at(Jet(*x.coefficients[:count]), z)
            step = Jet(*height.coefficients[m:]) / Jet(*rate.coefficients[: count - m])
            known += step.coefficients
        return Jet(*known)


@dataclass(frozen=True)
class InverseSystem:
    """The branches g_w on a hull, g_w = g_j after g_v for a word w = jv."""

    letters: tuple[InverseBranch, InverseBranch]
    hull: Range
    words: tuple[str, ...]
    radius: Fraction
    precision: int

    def images_are_disjoint(self) -> bool:
        """Whether it is proved that the g_w map the hull into itself, to disjoint images."""
        hull = Jet(Interval(*self.hull, precision=self.precision))
        images = sorted((image.value.inf, image.value.sup) for image in self(hull))
        inside = all(self.hull[0] <= low and high <= self.hull[1] for low, high in images)
        return inside and all(one[1] < two[0] for one, two in pairwise(images))

    def __call__(self, x: Jet) -> list[Jet]:
        """Return the jets of all g_w(x)."""
        found = {"": x}
        for suffix in self.suffixes:
            found[suffix] = self.letters[int(suffix[0])](found[suffix[1:]])
        return [found[word] for word in self.words]

    @property
    def suffixes(self) -> list[str]:
        """The words and their shorter ends, these first."""
        found = {word[k:] for word in self.words for k in range(len(word))}
        return sorted(found, key=lambda suffix: (len(suffix), suffix))

    def centres(self, points: Sequence[Fraction]) -> dict[str, tuple[Fraction, ...]]:
        """Return for each end w of a word the middles of brackets of g_w, of the given radius.

        That of g_w for w = jv is one for all that the bracket of g_v contains.
        """
        found = {"": tuple(points)}
        for suffix in self.suffixes:
            letter, rest = self.letters[int(suffix[0])], suffix[1:]
            spread = self.radius if rest else Fraction(0)
            found[suffix] = tuple(self._centre(letter, x, spread) for x in found[rest])
        del found[""]
        return found

    def _centre(self, letter: InverseBranch, x: Fraction, spread: Fraction) -> Fraction:
        around = Interval(x - spread, x + spread, precision=self.precision)
        y = letter.approximate(x, self.precision)
        if not letter.excess(y - self.radius, around) < 0 < letter.excess(y + self.radius, around):
            raise Undecided("a bracket of an inverse image is too narrow")
        return y
