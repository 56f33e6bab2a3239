"""Where the map is at its worst: grazing launches, and the ends of the sticking arc."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any

from proofs.motion.candidate import next_impact
from proofs.motion.system import System
from proofs.stress.kernels import Kernel
from proofs.stress.truth import BITS, separation

_DIGITS = 80
_PHASES = 120
SYSTEMS = tuple(
    (Fraction(eta), Fraction(nu))
    for eta, nu in (("0.2121", "-0.2"), ("0.9", "-0.3"), ("1.7", "-0.9"), ("0.35", "-0.5"),
                    ("0.6", "1.1"), ("1.4", "-2.3"))
)  # fmt: skip


def separation_point(
    kernel: Kernel, eta: Fraction, nu: Fraction, *, beginning: bool = False
) -> Fraction:
    """Return the phase where a sticking mass leaves, or where sticking begins, to 80 digits."""
    with kernel.digits(BITS):
        phase = separation(kernel, eta, nu)
        if beginning:
            phase = kernel.pi() - phase
        low = kernel.bounds(phase)[0]
        if low < 0:
            low += 2 * kernel.bounds(kernel.pi())[0]
    return Fraction(round(low * 10**_DIGITS), 10**_DIGITS)


@cache
def _grazes() -> tuple[tuple[Fraction, Fraction, Fraction], ...]:
    """Return (eta, nu, phase) of grazing launches, the phase to 80 digits."""
    found = []
    for eta, nu in SYSTEMS:
        oscillator = System(eta, nu)
        phases = [0.01 + 6.26 * k / _PHASES for k in range(_PHASES)]
        times = [next_impact(oscillator, phase, 60.0) for phase in phases]
        for (a, b), (s, t) in zip(pairwise(phases), pairwise(times), strict=True):
            if s is None or t is None or abs(s[0] - t[0]) < 0.8:
                continue
            phase = _refined(oscillator, (a, b), (s[0], t[0]))
            if phase is not None:
                found.append((eta, nu, phase))
    return tuple(found)


def graze(number: int) -> tuple[Fraction, Fraction, Fraction]:
    """Return one of the grazing launches."""
    known = _grazes()
    return known[number % len(known)]


def _refined(
    oscillator: System, phases: tuple[float, float], times: tuple[float, float]
) -> Fraction | None:
    """Halve the jump of the flight time, then solve gap = gap' = 0 for phase and time."""
    import mpmath

    (a, b), (s, t) = phases, times
    for _ in range(40):
        middle = next_impact(oscillator, (a + b) / 2, 60.0)
        if middle is None:
            return None
        if abs(middle[0] - s) < abs(middle[0] - t):
            a, s = (a + b) / 2, middle[0]
        else:
            b, t = (a + b) / 2, middle[0]
    if abs(s - t) < 0.5:
        return None
    eta, nu = oscillator.eta, oscillator.nu
    with mpmath.workdps(_DIGITS + 20):
        e, n = (mpmath.mpf(x.numerator) / x.denominator for x in (eta, nu))

        def touch(phi: Any, time: Any) -> tuple[Any, Any]:
            sin, cos = mpmath.sin, mpmath.cos
            height, speed = 1 + n * sin(phi), n * cos(phi) / e
            gap = height * cos(e * time) + speed * sin(e * time) - 1 - n * sin(phi + time)
            rate = e * (speed * cos(e * time) - height * sin(e * time)) - n * cos(phi + time)
            return gap, rate

        try:
            phase, time = mpmath.findroot(touch, (a, min(s, t)))
        except (ValueError, ZeroDivisionError):
            return None
        if abs(phase - a) > 1e-3 or not math.isclose(time, min(s, t), rel_tol=1e-2):
            return None
        return Fraction(mpmath.nstr(phase, _DIGITS))
