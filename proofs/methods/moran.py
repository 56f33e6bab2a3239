"""The dimension of a linear Cantor set: Moran's equation."""

from __future__ import annotations

from fractions import Fraction

from intervals.errors import Undecided
from proofs.trusted.kernel.arithmetic import Enclosure, rational
from proofs.trusted.kernel.elementary import exp, log

Range = tuple[Fraction, Fraction]


def moran_root(ratios: Range, bits: int) -> Range:
    """Bracket the root s > 0 of r0^s + r1^s = 1, ratios in (0, 1), by 2^(1 - bits).

    The left side decreases in s. A secant iteration finds the candidate, signs prove it.
    """
    logs = [log(ratio, bits + 30) for ratio in ratios]

    def powers(s: Fraction) -> list[Enclosure]:
        return [exp(each * rational(s, bits + 30)) for each in logs]

    def excess(s: Fraction) -> Enclosure:
        first, second = powers(s)
        return first + second - 1

    s, unit = Fraction(0), Fraction(1, 2**bits)
    for _ in range(60):  # Newton from the left of a convex decreasing function: no overshoot
        first, second = powers(s)
        height, tilt = (first + second - 1).range, (logs[0] * first + logs[1] * second).range
        step = -(height[0] + height[1]) / (tilt[0] + tilt[1])
        s = round((s + step) / unit) * unit
        if abs(step) < unit:
            break
    bracket = (s - unit, s + unit)
    if not excess(bracket[0]).lo > 0 > excess(bracket[1]).hi:
        raise Undecided("the bracket of s_0 has not the signs it must have")
    return bracket
