"""Inverse branches of the impact map, proved in a complex neighbourhood of an interval."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import prod

from proofs.trusted.equations import Clock, Launch, clock, gap, launch, launch_acceleration, slope
from proofs.trusted.flights import Motion, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational, sincos_near_zero
from proofs.trusted.kernel.complexes import BITS, Arc, Complex, Ellipse
from proofs.trusted.kernel.transfer import Series
from proofs.trusted.numbers import Phases, Range, hull, within
from proofs.trusted.paper.branches import Branch

_ZERO, _ONE = Fraction(0), Fraction(1)


@dataclass(frozen=True)
class Letter:
    """F on a branch, the domain: the time of the first impact after y, plus y, less 2 pi `turns`;
    F' has a sign.
    """

    branch: Branch

    @property
    def turns(self) -> int:
        """The turns that F is less."""
        return self.branch.turn

    @property
    def domain(self) -> Phases:
        """The whole domain."""
        return self.branch.phases

    @cached_property
    def motion(self) -> Motion:
        """The oscillator's flights."""
        return self.branch.motion(self.domain)

    @cached_property
    def sign(self) -> int:
        """The sign of F', that of -sin(eta t), as the slope's other factors have known ones."""
        sines = [self.motion.clock(window).mass_sin for window in self.branch.windows]
        if all(sine.hi < 0 for sine in sines):
            return 1
        if all(sine.lo > 0 for sine in sines):
            return -1
        raise Unproved("f is not proved monotone on a domain")

    def require_once(self, whole: Range) -> None:
        """Raise Unproved unless F > b - 2 pi and F < a + 2 pi at the ends of the domain, at the
        lower one first if F increases.

        So only x itself, of all x + 2 pi k, is F of a point in the domain, for x in [a, b].
        """
        (low, high), turn = whole, whole_turns(1, BITS)
        first, last = self.domain[:: self.sign]
        above = self.branch.side(first, (high - turn[1], high - turn[0])) > 0
        if not above or self.branch.side(last, (low + turn[0], low + turn[1])) >= 0:
            raise Unproved("f is not proved to pass the hull only once on a domain")

    def time(self, phase: Fraction, image: Range, bits: int) -> Range:
        """Enclose x - phase + 2 pi turns for x in `image`."""
        low, high = whole_turns(self.turns, bits)
        return image[0] - phase + low, image[1] - phase + high

    def starts_within(self, phases: Range, image: Range, bits: int) -> bool:
        """Whether x - y + 2 pi turns is in the windows of all the pieces that y may be on."""
        spans = (self.time(end, image, bits) for end in phases)
        times = hull(list(spans))
        pieces = zip(pairwise(self.branch.cuts), self.branch.windows, strict=True)
        return within(phases, self.domain) and all(
            within(times, window)
            for (low, high), window in pieces
            if low <= phases[1] and phases[0] <= high
        )

    def over(self, y: Complex, x: Complex) -> tuple[Launch, Clock]:
        """Return the state after a launch at y, and the clock at x, for complex numbers."""
        motion, turn = self.motion, pi(BITS) * (2 * self.turns)
        eta, nu = map(Complex.of, motion.at.point)
        ahead = x - y + Complex(turn, Enclosure(0, 0, BITS))
        return launch(motion.side, eta, nu, y), clock(eta, ahead)

    def at(self, y: Enclosure, x: Enclosure) -> tuple[Launch, Clock]:
        """Return the same for real numbers."""
        motion, bits = self.motion, y.bits
        eta, nu = (rational(number, bits) for number in motion.at.point)
        ahead = x - y + pi(bits) * (2 * self.turns)
        return launch(motion.side, eta, nu, y), clock(eta, ahead)

    def inverse(self, x: Enclosure, y: Enclosure) -> tuple[Enclosure, Enclosure]:
        """Enclose the y in Y with F(y) = x for x in X, if there is just one, and F' there.

        Interval Newton, with more and more bits: G(y) = gap(y, x - y + 2 pi turns) = 0, so y is in
        m - G(m) / G'(Y), m a number in Y. By `slope` -G' is sin(eta t) / eta times the launch
        acceleration. What depends on Y follows from what is known at m.
        """
        good = y.bits - (y.hi - y.lo).bit_length()
        while True:
            before, bits = good, min(max(BITS, -(-good >> 5) << 6), x.bits)  # few kinds: see `pi`
            y = rounded(y, bits)
            middle = Enclosure((y.lo + y.hi) >> 1, (y.lo + y.hi) >> 1, bits)
            state = self.at(middle, rounded(x, bits))
            few = min(bits, BITS + (-(-good >> 6) << 6))
            start, now = _later(*state, rounded(y - middle, few))
            rate = now.mass_sin / start.eta * launch_acceleration(start)
            y = y.meet(middle + gap(*state) / rounded(rate, bits))
            good = bits - (y.hi - y.lo).bit_length()
            if good <= before or good >= x.bits - 10:
                later = rounded(y - middle, x.bits)
                return rounded(y, x.bits), slope(*_later(*state, later))


def _later(start: Launch, now: Clock, d: Enclosure) -> tuple[Launch, Clock]:
    """Return the state after a launch later by d, and the clock at the same time, in d's bits.

    By the addition theorems: the phase of the launch grows by d, the time of flight shrinks by d.
    """
    eta, lift, rate = (rounded(each, d.bits) for each in (start.eta, start.lift, start.rate))
    (slow_sin, slow_cos), (sin, cos) = map(sincos_near_zero, (eta * d, d))
    mass_sin, mass_cos, table_sin, table_cos = (rounded(each, d.bits) for each in now)
    clock_then = Clock(
        mass_sin * slow_cos - mass_cos * slow_sin,
        mass_cos * slow_cos + mass_sin * slow_sin,
        table_sin * cos - table_cos * sin,
        table_cos * cos + table_sin * sin,
    )
    return Launch(start.side, eta, lift * cos + rate * sin, rate * cos - lift * sin), clock_then


def rounded(x: Enclosure, bits: int) -> Enclosure:
    """Return an enclosure with other bits."""
    if bits >= x.bits:
        return Enclosure(x.lo << bits - x.bits, x.hi << bits - x.bits, bits)
    return Enclosure(x.lo >> x.bits - bits, -(-x.hi >> x.bits - bits), bits)


@dataclass
class Inverses:
    """The inverse branches g_w on the ellipse, near polynomials y_w of u, the empty one's x.

    paths: the coefficients of y_w by Chebyshev's polynomials, for the words and their shorter
    ends w, shorter ones first. found: how far g_w is from y_w at most, as `over` finds it.

    Theorem. Let w = jv, Gamma(y, x) = gap(y, x - y + 2 pi turns_j), and g_v analytic inside E and
    continuous, g the identity for the empty v. For all z on the boundary of E let Re Gamma_y(y, x)
    have one sign for x = g_v(z), |y - y_w(z)| <= r = radii[w], |Gamma_y| >= c, any two of its
    values be at most k c apart, k < 1, and |Gamma(y_w(z), x)| <= e c, e + k r <= r. Then for z in E
    there is one y with |y - y_w(z)| <= r and Gamma(y, g_v(z)) = 0, analytic in z; it is within
    e / (1 - k). Let its derivative have a real part of one sign on the boundary: then so in E.

    Proof. A(z) = Gamma_y(y_w(z), g_v(z)) is not 0 in E, by the sign of its real part on the
    boundary. N(z, y) = y - Gamma(y, g_v(z)) / A(z) has |dN/dy| <= k on the boundary, so for each
    d, |d| <= r, at y = y_w(z) + d in all of E (maximum principle), and as well
    |N(z, y_w(z)) - y_w(z)| <= e: N contracts the disc. Its iterates from y_w are analytic in z and
    converge uniformly; on the boundary y is analytic too (implicit functions), so that it may be
    differentiated by the angle. On [a, b] y is real, since its conjugate is a zero as well.
    """

    letters: tuple[Letter, ...]
    words: tuple[str, ...]
    ellipse: Ellipse
    paths: dict[str, tuple[Fraction, ...]]
    radii: dict[str, Fraction]
    found: dict[str, Fraction] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise Unproved unless f passes the hull once on each domain."""
        for letter in self.letters:
            letter.require_once(self.ellipse.hull)

    def sign(self, word: str) -> int:
        """The sign of g_w'."""
        return prod(self.letters[int(letter)].sign for letter in word)

    def over(self, arc: Arc) -> list[tuple[Complex, Complex]]:
        """Enclose g_w and g_w' for the words on an arc of the boundary.

        For w = jv, and the middle m of the arc, Gamma(y_w, g_v) is by the mean value theorem, in
        the angle, near its value at m, and that near Gamma(y_w(m), y_v(m)).
        """
        half = Fraction(11, 7) / arc.count  # more than half the angle
        turn = Complex(Enclosure.of(-half, half, BITS), Enclosure(0, 0, BITS))
        x = arc.germ(self.ellipse.coordinates)
        known = {"": (x, x.values, Complex.of(_ONE), _ZERO)}
        for word, path in self.paths.items():
            letter, y = self.letters[int(word[0])], arc.germ(path)
            before, images, rate, near = known[word[1:]]
            start, now = letter.over(y.values.widened(self.radii[word]), images)
            by_x, by_y = (
                gap(start, now, 1),
                -(now.mass_sin / start.eta * launch_acceleration(start)),
            )
            turning = (by_y * y.rates + by_x * rate * x.rates) * turn
            error = (gap(*letter.over(y.value, before.value)) + turning).size + by_x.size * near
            least = max(by_y.re.range[0], -by_y.re.range[1])
            if least <= 0 or by_y.spread >= least:
                raise Unproved(f"an inverse branch by {word} is not proved to be regular")
            distance = error / (least - by_y.spread)
            self.found[word] = max(distance, self.found.get(word, distance))
            faster = -(by_x / by_y) * rate
            if (faster.re * self.sign(word)).lo <= 0:
                raise Unproved(f"an inverse branch by {word} is not proved monotone")
            known[word] = y, y.values.widened(distance), faster, distance
        return [known[word][1:3] for word in self.words]

    def at(self, x: Enclosure) -> list[tuple[Enclosure, Enclosure]]:
        """Enclose g_w(x) and g_w'(x) for the words and a real x."""
        known = self._all_at(x)
        one = rational(Fraction(1), x.bits)
        return [(known[word][0], one / known[word][1]) for word in self.words]

    def _all_at(self, x: Enclosure) -> dict[str, tuple[Enclosure, Enclosure]]:
        middle, half = (rational(each, BITS) for each in self.ellipse.coordinates)
        near = (rounded(x, BITS) - middle) / half
        u = near.meet(Enclosure(-1 << BITS, 1 << BITS, BITS))
        known = {"": (x, rational(Fraction(1), x.bits))}
        for word, path in self._scaled.items():
            letter, (image, rate) = self.letters[int(word[0])], known[word[1:]]
            around = Enclosure.of(-self.found[word], self.found[word], BITS)
            y, faster = letter.inverse(image, path(u) + around)
            known[word] = y, faster * rate
        return known

    @cached_property
    def _scaled(self) -> dict[str, Series]:
        return {word: Series.of(path, BITS) for word, path in self.paths.items()}

    def require_near(self) -> None:
        """Raise Unproved unless the g_w are proved as near to the paths as is said."""
        for word, radius in self.radii.items():
            if self.found[word] > radius:
                raise Unproved(f"an inverse branch by {word} is not proved where it is said")

    def require(self, bits: int) -> None:
        """Raise Unproved unless g_w, real on [a, b], is what F on a domain takes to g_v.

        g_w is monotone (`over`); so its values are in the domain if those at a and b are. At a
        the zero of the gap is in the window, where it is the first impact. The gap is positive at
        the beginning of a window and negative at its end, for all launches that it is for; so it
        stays the zero there up to b, also where the window changes at a cut: there both hold the
        first impact.
        """
        self.require_near()
        low, high = (self._all_at(rational(end, bits)) for end in self.ellipse.hull)
        for word in self.paths:
            letter = self.letters[int(word[0])]
            (first, _), (last, _), (image, _) = low[word], high[word], low[word[1:]]
            if not within(hull([first.range, last.range]), letter.domain):
                raise Unproved(f"an inverse image by {word} is not proved in its domain")
            if not letter.starts_within(first.range, image.range, bits):
                raise Unproved(f"an inverse image by {word} is not proved to be the first impact's")
