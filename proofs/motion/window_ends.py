"""Where the windows of stable single-impact orbits end, and brackets of solutions: candidates.

The checker decides by the signs at both ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

from mpmath import MPContext
from mpmath.libmp import to_rational

from proofs.motion.digits import around
from proofs.motion.system import System
from proofs.trusted.equations import Clock, clock
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s4_single.orbits import defect, distance, excess

_LOOKS = 64  # times looked at in a table period
_DEEP = 1e-12  # far above rounding
_LITTLE = 1e-6  # below 2, where the flight for n = 1 is inside the table after half its time


def precise(bits: int) -> MPContext:
    """Return numbers for brackets of width 2^(1 - bits)."""
    numbers = MPContext()
    numbers.prec = 2 * bits + 60
    return numbers


def root(function: Callable[[Any, Any], Any], about: float, bits: int) -> Range:
    """Bracket a zero of function(numbers, x) near a float, by multiples of 2^-bits."""
    numbers = precise(bits)
    zero = numbers.findroot(partial(function, numbers), about)
    return around(Fraction(*to_rational(zero._mpf_)), bits)


def orbit(numbers: Any, eta: Any, n: int) -> tuple[Any, Any]:
    """Return sin x, cos x, x = pi n eta, by the functions of a module."""
    x = numbers.pi * n * eta
    return numbers.sin(x), numbers.cos(x)


def as_type(value: Any, number: Fraction) -> Any:
    """Return a fraction as a number of the type of another one."""
    return (value * 0 + number.numerator) / number.denominator


def bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Return about where a function of floats becomes positive."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return low


def eta_end(nu: Fraction, n: int, end: int, bits: int, falls: Range | None = None) -> Range:
    """Enclose the eta at which the solution has slope `end`.

    In (0, 1/(2 n)), where excess grows with eta, for nu in (0, 1), or where it falls, for nu < 0.
    """
    low, high = falls or (Fraction(0), Fraction(1, 2 * n))

    def formula(numbers: Any, eta: Any) -> Any:
        return excess(eta, as_type(eta, nu), orbit(numbers, eta, n), end)

    def beyond(eta: float) -> float:
        value = float(formula(math, eta))
        return -value if falls else value

    return root(formula, bisected(beyond, float(low), float(high)), bits)


def graze_end(nu: Fraction, saddle: float, bits: int) -> tuple[Range, Fraction]:
    """Return a bracket of the eta in (saddle, 2) at which flights for n = 1 touch early, and when.

    nu < 0, slope < 1. A candidate: there D = D' = 0, D the `distance`, says mpmath.
    """
    times = [math.pi + k / _LOOKS / 8 for k in range(-_LOOKS, _LOOKS)]

    def highest(eta: float) -> float:
        return max(float(_above(eta, nu, time, math)) for time in times)

    about = bisected(highest, saddle, 2 - _LITTLE)
    touch = max(times, key=lambda time: _above(about, nu, time, math))
    numbers = precise(bits)

    def both(eta: Any, time: Any) -> tuple[Any, Any]:
        def along(t: Any) -> Any:
            return _above(eta, nu, t, numbers)

        return along(time), numbers.diff(along, time)

    eta, time = (Fraction(*to_rational(x._mpf_)) for x in numbers.findroot(both, (about, touch)))
    return around(eta, bits), around(time, bits)[0]


def _above(eta: Any, nu: Fraction, time: Any, numbers: Any) -> Any:
    """Return D for n = 1 at the solution with slope < 1, by the functions of a module."""
    sines = orbit(numbers, eta, 1)
    tangent, square = eta * sines[0] / sines[1], as_type(eta, nu**2)
    share = (numbers.sqrt(square - (1 - square) * tangent * tangent) - square) / (1 - square)
    angles = (numbers.sin, numbers.cos)
    now = Clock(*(each(eta * time) for each in angles), *(each(time) for each in angles))
    return distance(eta, sines, now, share)


def nu_end(eta: Fraction, n: int, end: int, bits: int) -> Range | None:
    """Bracket the |nu| at which the solution has slope `end`, None where it is not below 1."""
    numbers = precise(bits)
    own = as_type(numbers.mpf(1), eta)
    turn = orbit(numbers, own, n)
    top, rest = excess(own, 0, turn, end), excess(own, 1, turn, end)
    if rest > 0:
        return None
    return around(Fraction(*to_rational(numbers.sqrt(top / (top - rest))._mpf_)), bits)


def earlier(eta: Fraction, n: int) -> Fraction | None:
    """Return a time at which all solutions for nu < 0 with slope <= 1 are inside the table."""
    own, turn = float(eta), orbit(math, float(eta), n)
    share = -((own * turn[0] / turn[1]) ** 2)
    times = [step * math.tau / _LOOKS for step in range(1, _LOOKS * n)]
    best = max(times, key=lambda t: float(distance(own, turn, clock(own, t), share)))
    deepest = distance(own, turn, clock(own, best), share)
    return round(Fraction(best), 6) if deepest > _DEEP else None


def bracket(system: System, n: int, phase: Range, bits: int) -> Range:
    """Return a bracket of width 2^(1 - bits) of a solution of (16)."""

    def formula(numbers: Any, phi: Any) -> Any:
        eta, nu = (as_type(phi, x) for x in (system.eta, system.nu))
        return defect(eta, nu, (numbers.sin(phi), numbers.cos(phi)), orbit(numbers, eta, n))

    return root(formula, float((phase[0] + phase[1]) / 2), bits)
