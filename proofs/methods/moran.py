"""The dimension of a linear Cantor set: Moran's equation."""

from __future__ import annotations

from fractions import Fraction

from intervals import Interval, Undecided, exp, log

Range = tuple[Fraction, Fraction]


def moran_root(ratios: Range, bits: int) -> Range:
    """Bracket the root s > 0 of r0^s + r1^s = 1, ratios in (0, 1), by 2^(1 - bits).

    The left side decreases in s. A secant iteration finds the candidate, signs prove it.
    """
    logs = [log(Interval(ratio, precision=bits + 30)) for ratio in ratios]

    def excess(s: Fraction) -> Interval:
        return exp(logs[0] * s) + exp(logs[1] * s) - 1

    def tilt(s: Fraction) -> Interval:
        return logs[0] * exp(logs[0] * s) + logs[1] * exp(logs[1] * s)

    s, unit = Fraction(0), Fraction(1, 2**bits)
    for _ in range(60):  # Newton from the left of a convex decreasing function: no overshoot
        step = (-excess(s) / tilt(s)).mid
        s = round((s + step) / unit) * unit
        if abs(step) < unit:
            break
    bracket = (s - unit, s + unit)
    if not (excess(bracket[0]).certainly_positive() and excess(bracket[1]).certainly_negative()):
        raise Undecided("the bracket of s_0 has not the signs it must have")
    return bracket
