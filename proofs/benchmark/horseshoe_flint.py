"""What the benchmark compares with: python-flint, on its own transcription of the equations.

Nothing here is evidence for a claim. flint is imported where it is used: it may be absent.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

ETA = Fraction("0.2121")
NU = Fraction("-0.2")  # < 0: the mass flies below the table, the gap is z - x
_BITS = 600


def true_extremes(low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """Return f' at both ends, its extremes where f'' > 0, to some 150 digits."""
    first, last = _true_slope(low), _true_slope(high)
    return min(first, last), max(first, last)


def _true_slope(phase: Fraction) -> Fraction:
    """Return f' at a phase: a float scan for the first root, then Newton's method at 600 bits."""
    import flint

    with flint.ctx.workprec(_BITS):
        eta, nu, phi = (_arb(x) for x in (ETA, NU, phase))
        lift, rate = nu * phi.sin(), nu * phi.cos()

        def height(t: Any) -> Any:
            mass = (1 + lift) * (eta * t).cos() + rate * (eta * t).sin() / eta
            return 1 + nu * (phi + t).sin() - mass

        def speed(t: Any) -> Any:
            mass = rate * (eta * t).cos() - eta * (1 + lift) * (eta * t).sin()
            return nu * (phi + t).cos() - mass

        time = flint.arb(_scan(float(ETA), float(NU), float(phase)))
        for _ in range(12):
            time = (time - height(time) / speed(time)).mid()
        nearby = flint.arb(2) ** (40 - _BITS)
        if not (height(time - nearby) > 0 and height(time + nearby) < 0):
            raise ArithmeticError("the true impact time was not found")
        at = flint.arb(time, nearby)
        mass = rate * (eta * at).cos() - lift * (eta * at).sin() / eta
        by_phase = nu * (phi + at).cos() - mass
        slope = (1 - by_phase / speed(at)).mid().man_exp()
        return Fraction(int(slope[0])) * Fraction(2) ** int(slope[1])


def _scan(eta: float, nu: float, phase: float, step: float = 2.0**-9) -> float:
    """Return about the first t > 0 with gap <= 0, looking every `step`."""
    lift, rate = nu * math.sin(phase), nu * math.cos(phase)
    time = 0.25
    while time < 1000.0:
        mass = (1 + lift) * math.cos(eta * time) + rate * math.sin(eta * time) / eta
        if 1 + nu * math.sin(phase + time) - mass <= 0.0:
            return time
        time += step
    raise ArithmeticError("the true impact time was not found")


def _arb(value: Fraction | int) -> Any:
    import flint

    value = Fraction(value)
    return flint.arb(value.numerator) / value.denominator


def exclusion(cuts: Sequence[float], grid: Sequence[float]) -> Callable[[], bool]:
    """Return the same task as `exclude_impacts`, for arb at 53 bits, by list comprehensions.

    Boxes between the cuts, the same times, chord bounds and formulas; sine and cosine once a box
    and once a time; python floats in, one answer out.
    """

    def task() -> bool:
        form = _forms(cuts, grid)
        heights = [[a * x + b * y + d for a, b, d in form.at_ends] for x, y in form.phases]
        bends = [[a * x + b * y + d for a, b, d in form.over_pieces] for x, y in form.phases]
        return all(_is_excluded(height, bend) for height, bend in zip(heights, bends, strict=True))

    return task


def exclusion_by_matrices(cuts: Sequence[float], grid: Sequence[float]) -> Callable[[], bool]:
    """Return the same, with the boxes x times as two products of matrices (arb_mat)."""
    import flint

    def task() -> bool:
        form = _forms(cuts, grid)
        one = flint.arb(1)
        phases = flint.arb_mat([[x, y, one] for x, y in form.phases])
        heights = phases * flint.arb_mat(list(map(list, zip(*form.at_ends, strict=True))))
        bends = phases * flint.arb_mat(list(map(list, zip(*form.over_pieces, strict=True))))
        return all(
            _is_excluded(height, bend)
            for height, bend in zip(heights.tolist(), bends.tolist(), strict=True)
        )

    return task


def _is_excluded(height: list[Any], bend: list[Any]) -> bool:
    return (
        bend[0] > 0
        and all(x > 0 for x in height)
        and all(
            x > drop and y > drop for x, y, drop in zip(height, height[1:], bend[1:], strict=False)
        )
    )


class _Forms:
    """(lift, rate) of the boxes; A, B, D of gap = lift A + rate B + D and of w^2/8 gap''."""

    def __init__(self, phases: list[Any], at_ends: list[Any], over_pieces: list[Any]) -> None:
        self.phases, self.at_ends, self.over_pieces = phases, at_ends, over_pieces


def _forms(cuts: Sequence[float], grid: Sequence[float]) -> _Forms:
    import flint

    arb = flint.arb
    with flint.ctx.workprec(53):
        eta, nu = _arb(ETA), _arb(NU)
        boxes = [arb(low).union(arb(high)) for low, high in pairwise(cuts)]
        phases = [(nu * phi.sin(), nu * phi.cos()) for phi in boxes]
        at_ends, over_pieces = [], []
        for begin, end in pairwise([0.0, *grid]):
            time = arb(end)
            big_s, big_c = (eta * time).sin_cos()
            s, c = time.sin_cos()
            at_ends.append((c - big_c, s - big_s / eta, 1 - big_c))
            piece = arb(begin).union(time)
            share = (time - arb(begin)) ** 2 / 8
            big_s, big_c = (eta * piece).sin_cos()
            s, c = piece.sin_cos()
            over_pieces.append(
                (
                    share * (eta * eta * big_c - c),
                    share * (eta * big_s - s),
                    share * (eta * eta * big_c),
                )
            )
        return _Forms(phases, at_ends, over_pieces)
