"""Soft springs, plastic impacts: the motion with one impact a period that sticks."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from intervals import Interval, Undecided, asin, cos, pi, sin, sqrt


@dataclass(frozen=True)
class Sticking:
    """The mass leaves the table at the phase `leaves`, is in flight for `time`, and sticks when it
    lands, at `lands`, less 2 pi `turns`; it leaves `periods` table periods after it left before.
    """

    leaves: Interval
    time: Interval
    lands: Interval
    periods: int


def sticking(rho: Fraction, bits: int) -> Sticking | None:
    """Return the one motion that sticks, for epsilon = 0 and the limit of soft springs; None: none.

    Theorem, proved as `s5_soft.orbits.sticking` (S18.4): for rho <= 2 the mass never leaves. For
    rho > 2 it leaves where rho sin psi = 2, cos psi > 0, and lands at the one T with W(T) = w, w^2
    = rho^2 - 4, W(t) = (t^2 - 2 + 2 cos t)/(t - sin t), which increases. With x = T/2 it sticks if
    x cot x < 1, x no multiple of pi, and leaves j + 1 periods later, pi j < x < pi (j + 1); the
    motion attracts. If x cot x > 1 it leaves at once. Raises Undecided where x cot x may be 1.
    """
    if rho <= 2:
        return None
    exact = Interval(rho, precision=bits)
    speed, leaves = sqrt(exact * exact - 4), asin(2 / exact)
    time = _landing(speed, bits)
    half, circle = time / 2, pi(precision=bits)
    low, high = (int(end) for end in ((half / circle).inf, (half / circle).sup))
    margin = half * cos(half) - sin(half) if low % 2 == 0 else sin(half) - half * cos(half)
    if low != high or margin.inf <= 0 <= margin.sup:  # of the sign of x cot x - 1
        raise Undecided("the mass sticks, or leaves at once: too close to tell")
    if margin.inf > 0:
        return None
    whole = leaves + time
    turns = int((whole / (2 * circle)).inf)
    return Sticking(leaves, time, whole - 2 * turns * circle, low + 1)


def _landing(speed: Interval, bits: int) -> Interval:
    """Enclose the zero T > 0 of t^2 - 2 + 2 cos t - w (t - sin t), which is < 0 before it."""
    low, high = Fraction(0), 2 * speed.sup + 8
    while high - low > Fraction(1, 2**bits):
        middle = (low + high) / 2
        t = Interval(middle, precision=bits * 2)
        found = t * t - 2 + 2 * cos(t) - speed * (t - sin(t))
        if found.inf <= 0 <= found.sup:
            break
        low, high = (middle, high) if found.sup < 0 else (low, middle)
    return Interval(low, high, precision=bits)
