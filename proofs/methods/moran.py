"""The dimension of a linear Cantor set: Moran's equation."""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.kernel.arithmetic import rational
from proofs.trusted.kernel.elementary import exp, log

Range = tuple[Fraction, Fraction]


def moran_root(ratios: Range, bits: int) -> Range:
    """Bracket the root s > 0 of r0^s + r1^s = 1, ratios in (0, 1), by 2^(1 - bits).

    A candidate, by Newton's method from the left: the left side falls and is convex in s.
    """
    logs = [log(ratio, bits + 30) for ratio in ratios]

    s, unit = Fraction(0), Fraction(1, 2**bits)
    for _ in range(60):
        first, second = (exp(each * rational(s, bits + 30)) for each in logs)
        height, tilt = (first + second - 1).range, (logs[0] * first + logs[1] * second).range
        step = -(height[0] + height[1]) / (tilt[0] + tilt[1])
        s = round((s + step) / unit) * unit
        if abs(step) < unit:
            break
    return s - unit, s + unit
