"""Where mass and table can meet at all: windows of time, for flights over thousands of turns."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.equations import clock, gap, launch
from proofs.trusted.flights import Motion, stays_up
from proofs.trusted.flights import falls as gap_falls
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.numbers import Range

BITS = 80
_DEEPEST = 24
_ZERO = Fraction(0)
_UNIT = Fraction(1, 2**30)


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
        """Find delta, sigma and tau in floating point, and prove the hypotheses."""
        try:
            return cls._found(motion)
        except (OverflowError, ZeroDivisionError):
            raise Unproved("numbers beyond floating point") from None

    @classmethod
    def _found(cls, motion: Motion) -> Meetings:
        start, bits = motion.start(), motion.bits
        phase = float(motion.phases[0] + motion.phases[1]) / 2
        nu, eta = float(motion.nu), float(motion.eta)
        delta = _near(math.atan2(nu * math.cos(phase) / eta, 1 + nu * math.sin(phase)))
        sin, cos = rational(delta, bits).sincos()
        along, across = 1 + start.lift, start.rate / start.eta
        a, b = along * cos + across * sin, across * cos - along * sin
        size = max(abs(b.lo), abs(b.hi))
        sideways = Enclosure(size, size, bits)
        if a.lo <= 0:
            raise Unproved("the amplitude is not proved positive")
        amplitude = a + sideways * sideways / a / 2  # sqrt(a^2 + b^2) <= a + b^2 / (2 a)
        table = rational(motion.nu, bits)
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
        bits, eta = self.motion.bits, self.motion.eta
        first = self.window(0)
        whole = 2 * pi(bits)
        bounds = Enclosure.of(
            eta * first[0] - self.delta - self.tau, eta * first[1] - self.delta + self.tau, bits
        )
        share = bounds / whole
        unit = eta.denominator << bits
        low, high = share.lo * eta.denominator, share.hi * eta.denominator
        step = eta.numerator << bits
        for turn in range(count):
            if -((-low) // unit) <= high // unit:
                yield self.window(turn)
            low, high = low + step, high + step


def _near(value: float) -> Fraction:
    return round(Fraction(value) / _UNIT) * _UNIT


def _sigma(amplitude: Enclosure, nu: Enclosure) -> Fraction:
    """Return a sigma < pi with amplitude < 1 + nu cos(sigma), or 4 if there seems to be none."""
    ratio = (float(amplitude.range[1]) - 1) / float(nu.range[0])
    if ratio <= -1:
        return Fraction(4)
    sigma = _near(1.001 * math.acos(min(ratio, 1.0))) + 4 * _UNIT
    margin = 1 + nu * rational(sigma, nu.bits).sincos()[1] - amplitude
    return sigma if margin.lo > 0 and sigma < 3 else Fraction(4)


def _tau(a: Enclosure, b: Enclosure, deepest: Enclosure) -> Fraction:
    """Return a tau as in `Meetings`, or 4 if there seems to be none."""
    large, small, least = float(a.range[1]), float(b.range[1]), float(deepest.range[0])
    angle = math.acos(min(1.0, least / math.hypot(large, small))) + math.atan2(small, large)
    tau = _near(1.001 * angle) + 4 * _UNIT
    sin, cos = rational(tau, a.bits).sincos()
    decreasing = b * cos - a * sin
    high = a * cos + b * sin - deepest
    proved = decreasing.hi <= 0 and high.hi < 0 and (b - deepest).hi < 0
    return tau if proved and 2 * tau < 3 else Fraction(4)


# -- the gap over an interval of launches ------------------------------------------------------


def leaves(motion: Motion) -> Fraction:
    """Return a time up to which gap'' > 0: all launches leave the table."""
    start = motion.start()
    for halvings in range(10):
        time = Fraction(1, 2**halvings)
        if motion.gap(start, (_ZERO, time), 2).lo > 0:
            return time
    raise Unproved("the launches are not proved to leave the table")


def level(motion: Motion, time: Fraction) -> Range:
    """Enclose the gap at one time: by the ends of the phases where it is monotone in the phase."""
    bits, (low, high) = motion.bits, motion.phases
    one, eta = rational(Fraction(1), bits), rational(motion.eta, bits)
    now = clock(eta, rational(time, bits))
    nu = rational(motion.nu, bits)
    whole: Dual = gap(launch(motion.side, eta, nu, Dual(Enclosure.of(low, high, bits), one)), now)
    if low == high or whole.derivative.lo <= 0 <= whole.derivative.hi:
        return whole.value.range
    ends = [gap(launch(motion.side, eta, nu, rational(x, bits)), now).range for x in (low, high)]
    return min(bottom for bottom, _ in ends), max(top for _, top in ends)


def clear(motion: Motion, times: Range) -> None:
    """Prove gap > 0 for all launches on an interval of times, halving it, or raise Unproved."""
    _clear(motion, times, [level(motion, time)[0] for time in times], 0)


def _clear(motion: Motion, times: Range, least: Sequence[Fraction], depth: int) -> None:
    """Do `clear`, lower bounds of the gap at the ends of the interval being known."""
    if min(least) <= 0 or depth == _DEEPEST:
        raise Unproved("an earlier impact is not excluded")
    if stays_up(motion.gap_of, times, min(least)):
        return
    middle = (times[0] + times[1]) / 2
    between = level(motion, middle)[0]
    _clear(motion, (times[0], middle), (least[0], between), depth + 1)
    _clear(motion, (middle, times[1]), (between, least[1]), depth + 1)


def falls(motion: Motion, times: Range) -> None:
    """Prove gap' < 0 for all launches on an interval of times, halving it, or raise Unproved."""
    if not gap_falls(motion.gap_of, times, _DEEPEST):
        raise Unproved("the gap is not proved to fall to the impact")
