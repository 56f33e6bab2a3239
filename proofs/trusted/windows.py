"""Where mass and table can meet at all: windows of time, for flights over thousands of turns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.equations import gap
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.gaps import stays_up
from proofs.trusted.kernel.operations import atan, sqrt
from proofs.trusted.numbers import Range, hull

BITS = 80
DEEPEST = 24  # halvings of an interval of times
_ZERO = Fraction(0)
_UNIT = Fraction(1, 2**30)
_MORE = Fraction(1001, 1000)


@dataclass(frozen=True)
class Meetings:
    """The times at which a flight of some launches can meet the table, for -1 < nu < 0.

    Theorem. The mass is at X = a cos u + b sin u, u = eta t - delta, the table at
    Z = 1 - |nu| cos s, s = phi + t - pi/2. Let |X| <= A < 1 - |nu| cos(sigma), and, with
    0 < tau < pi/2, |b| cos(tau) <= a sin(tau), a cos(tau) + |b| sin(tau) < 1 - |nu|,
    |b| < 1 - |nu|. Then X = Z needs |s - 2 pi k| < sigma and |u - 2 pi m| < tau for some k, m.

    Proof. If sigma <= |s| <= pi, Z >= 1 - |nu| cos(sigma) > A. As Z >= 1 - |nu|, X is that large.
    For tau <= |u| <= pi/2, X <= a cos|u| + |b| sin|u|, which decreases from its value at tau,
    below 1 - |nu|; for |u| >= pi/2, X <= |b|.

    With sigma > pi or tau > pi nothing is asserted of s or of u, and nothing is needed.
    For phases phi >= 0 and times t >= 0, s >= -pi / 2, so k >= 0 (sigma <= 4 here).
    """

    motion: Motion
    delta: Fraction
    sigma: Fraction
    tau: Fraction

    @classmethod
    def of(cls, motion: Motion) -> Meetings:
        """Find delta, sigma and tau, rounded, and prove the hypotheses."""
        start, bits, table = motion.start, motion.bits, motion.nu
        along, across = 1 + start.lift, start.rate / start.eta
        delta = _near(atan(_middle(across) / _middle(along)))
        sin, cos = rational(delta, bits).sincos()
        a, b = along * cos + across * sin, across * cos - along * sin
        if a.lo <= 0:
            raise Unproved("the amplitude is not proved positive")
        size = max(abs(b.lo), abs(b.hi))
        sideways = Enclosure(size, size, bits)
        amplitude = a + sideways * sideways / a / 2  # sqrt(a^2 + b^2) <= a + b^2 / (2 a)
        if amplitude.hi < (1 + table).lo:
            raise Unproved("the mass never meets the table")
        return cls(motion, delta, _sigma(amplitude, table), _tau(a, sideways, 1 + table))

    def window(self, turn: int) -> Range:
        """Return the times of all launches at which |s - 2 pi turn| <= sigma."""
        low, high = (Fraction(4 * turn + 1, 2) * end for end in pi(self.motion.bits).range)
        return low - self.sigma - self.motion.phases[1], high + self.sigma - self.motion.phases[0]

    def before(self, count: int) -> Iterator[Range]:
        """Yield the windows 0, ..., count - 1 in which |u - 2 pi m| <= tau is possible too.

        u / (2 pi) lies in eta k + [low, high], tau / (2 pi) included: is a whole number in there?
        """
        bits, (eta, _) = self.motion.bits, self.motion.at.point
        first = self.window(0)
        shifts = -self.delta - self.tau, -self.delta + self.tau
        bounds = Enclosure.of(eta * first[0] + shifts[0], eta * first[1] + shifts[1], bits)
        share, unit = bounds / (2 * pi(bits)), eta.denominator << bits
        low, high = share.lo * eta.denominator, share.hi * eta.denominator  # whole numbers: fast
        for turn in range(count):
            if -(-low // unit) <= high // unit:
                yield self.window(turn)
            low, high = low + (eta.numerator << bits), high + (eta.numerator << bits)


def _middle(x: Enclosure) -> Enclosure:
    return Enclosure(m := (x.lo + x.hi) >> 1, m, x.bits)


def _near(value: Enclosure) -> Fraction:
    return round(sum(value.range) / (2 * _UNIT)) * _UNIT


def _positive(x: Enclosure) -> Enclosure:
    return Enclosure(max(0, x.lo), max(0, x.hi), x.bits)


def _sigma(amplitude: Enclosure, nu: Enclosure) -> Fraction:
    """Return a sigma < pi with amplitude < 1 + nu cos(sigma), or 4 if there seems to be none."""
    high, deep = (Enclosure(end, end, nu.bits) for end in (amplitude.hi, -nu.lo))
    down, up = deep - 1 + high, deep + 1 - high  # -nu (1 -+ cos(sigma)), about
    if up.lo <= 0:
        return Fraction(4)
    sigma = _near(2 * atan(sqrt(_positive(down) / up)) * _MORE) + 4 * _UNIT
    margin = 1 + nu * rational(sigma, nu.bits).sincos()[1] - amplitude
    return sigma if margin.lo > 0 and sigma < 3 else Fraction(4)


def _tau(a: Enclosure, b: Enclosure, deepest: Enclosure) -> Fraction:
    """Return a tau as in `Meetings`, or 4 if there seems to be none."""
    if deepest.lo <= 0:
        return Fraction(4)
    large, small, least = (Enclosure(x, x, a.bits) for x in (a.hi, b.hi, deepest.lo))
    angle = atan(sqrt(_positive(large * large + small * small - least * least)) / least)
    tau = _near((angle + atan(small / large)) * _MORE) + 4 * _UNIT
    sin, cos = rational(tau, a.bits).sincos()
    decreasing = b * cos - a * sin
    high = a * cos + b * sin - deepest
    proved = decreasing.hi <= 0 and high.hi < 0 and (b - deepest).hi < 0
    return tau if proved and 2 * tau < 3 else Fraction(4)


# -- the gap over an interval of launches ----------------------------------------------------------


def leaves(motion: Motion) -> Fraction:
    """Return a time up to which gap'' > 0: all launches leave the table."""
    for halvings in range(10):
        time = Fraction(1, 2**halvings)
        if motion.gap_of((_ZERO, time), 2).lo > 0:
            return time
    raise Unproved("the launches are not proved to leave the table")


def level(motion: Motion, time: Fraction) -> Range:
    """Enclose the gap at one time: by the ends of the phases where it is monotone in the phase."""
    now = motion.clock((time, time))
    whole: Dual = gap(motion.moving, now)
    if whole.derivative.has_zero:
        return whole.value.range
    return hull([gap(end, now).range for end in motion.outer])


def clear(motion: Motion, times: Range) -> None:
    """Prove gap > 0 for all launches on an interval of times, halving it, or raise Unproved."""
    gap_of, shortest = motion.gap_of, (times[1] - times[0]) / 2**DEEPEST
    begin, least = times[0], level(motion, times[0])[0]
    waiting = [(times[1], level(motion, times[1])[0])]
    while waiting:
        end, height = waiting[-1]
        if min(least, height) <= 0 or end - begin <= shortest:
            raise Unproved("an earlier impact is not excluded")
        if stays_up(gap_of, (begin, end), min(least, height) * 2**motion.bits):
            begin, least = waiting.pop()
        else:
            middle = (begin + end) / 2
            waiting.append((middle, level(motion, middle)[0]))
