"""Where the windows of stable single-impact orbits end, and brackets of solutions: candidates.

Enclosed by intervals, or by the signs at both ends; the checker decides by the same signs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from mpmath import MPContext
from mpmath.libmp import to_rational

from intervals import Interval, Undecided
from intervals.newton import Roots, derivative, newton
from proofs.motion.digits import around
from proofs.motion.single_orbits import turn
from proofs.motion.system import System
from proofs.trusted.equations import Clock, clock
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s4_single.orbits import defect, distance, excess

Function = Callable[[Any], Any]

_LOOKS = 64  # times looked at in a table period
_DEEP = 1e-12  # far above rounding
_LITTLE = 1e-6  # below 2, where the flight for n = 1 is inside the table after half its time


def root(function: Function, about: float, bits: int) -> Range:
    """Enclose a zero of an increasing or decreasing function near a float, to 2^(1 - bits).

    The bracket's ends are multiples of 2^-bits at which the function has opposite signs.
    """
    precision, reach = 2 * bits + 60, Fraction(1, 2**36)
    box = Interval(Fraction(about) - reach, Fraction(about) + reach, precision=precision)
    isolated = newton(function, derivative(function), box)
    if isolated.outcome is not Roots.UNIQUE or isolated.box is None:
        raise Undecided(f"no root is isolated near {about:.9g}: {isolated.reason}")
    return _changes_sign(function, around(isolated.box.mid, bits), precision)


def _changes_sign(function: Function, ends: Range, precision: int) -> Range:
    """Return the ends, where a function is proved to have opposite signs; Undecided if not."""
    low, high = (function(Interval(x, precision=precision)) for x in ends)
    if not (low * high).certainly_negative():
        raise Undecided(f"no change of sign is seen near {float(ends[0]):.9g}")
    return ends


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

    def beyond(eta: float) -> float:
        value = float(excess(eta, float(nu), turn(eta, n, math.pi), end))
        return -value if falls else value

    def formula(eta: Any) -> Any:
        precision = 2 * bits + 60
        pi = Interval.pi(precision=precision)
        return excess(eta, Interval(nu, precision=precision), turn(eta, n, pi), end)

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
    precise = MPContext()
    precise.prec = 2 * bits + 60

    def both(eta: Any, time: Any) -> tuple[Any, Any]:
        def along(t: Any) -> Any:
            return _above(eta, nu, t, precise)

        return along(time), precise.diff(along, time)

    eta, time = (Fraction(*to_rational(x._mpf_)) for x in precise.findroot(both, (about, touch)))
    return around(eta, bits), around(time, bits)[0]


def _above(eta: Any, nu: Fraction, time: Any, functions: Any) -> Any:
    """Return D for n = 1 at the solution with slope < 1, by the functions of a module."""
    sines = functions.sin(functions.pi * eta), functions.cos(functions.pi * eta)
    tangent, square = eta * sines[0] / sines[1], eta * 0 + nu.numerator**2
    square /= nu.denominator**2
    share = (functions.sqrt(square - (1 - square) * tangent * tangent) - square) / (1 - square)
    angles = (functions.sin, functions.cos)
    now = Clock(*(each(eta * time) for each in angles), *(each(time) for each in angles))
    return distance(eta, sines, now, share)


def nu_end(eta: Fraction, n: int, end: int, bits: int) -> Range | None:
    """Enclose the |nu| at which the solution has slope `end`, None where it is not below 1."""
    precision = 2 * bits + 60
    own = Interval(eta, precision=precision)
    orbit = turn(own, n, Interval.pi(precision=precision))
    top, rest = excess(own, 0, orbit, end), excess(own, 1, orbit, end)
    if rest.certainly_positive():
        return None
    return around((top / (top - rest)).sqrt().mid, bits)


def earlier(eta: Fraction, n: int) -> Fraction | None:
    """Return a time at which all solutions for nu < 0 with slope <= 1 are inside the table."""
    own, orbit = float(eta), turn(float(eta), n, math.pi)
    share = -((own * orbit[0] / orbit[1]) ** 2)
    times = [step * math.tau / _LOOKS for step in range(1, _LOOKS * n)]
    best = max(times, key=lambda t: float(distance(own, orbit, clock(own, t), share)))
    deepest = distance(own, orbit, clock(own, best), share)
    return round(Fraction(best), 6) if deepest > _DEEP else None


def bracket(system: System, n: int, phase: Range, bits: int) -> Range:
    """Return a bracket of width 2^(1 - bits) of a solution of (16)."""
    precision = 2 * bits + 60
    eta, nu = (Interval(x, precision=precision) for x in (system.eta, system.nu))
    orbit = turn(eta, n, Interval.pi(precision=precision))
    about = float((phase[0] + phase[1]) / 2)
    return root(lambda x: defect(eta, nu, x.sincos(), orbit), about, bits)
