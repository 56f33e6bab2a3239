"""Phases: times modulo 2 pi, enclosed."""

from __future__ import annotations

from fractions import Fraction

from intervals import Interval
from proofs.trusted.numbers import Range


def turn(precision: int) -> Interval:
    """Enclose 2 pi."""
    return Interval.pi(precision=precision) * 2


def lifted(phase: Range, turns: int, precision: int) -> Range:
    """Add 2 pi turns to an enclosure."""
    whole = turn(precision)
    added = turns * whole.inf, turns * whole.sup
    return phase[0] + min(added), phase[1] + max(added)


def on_circle(phase: Range, precision: int) -> Range:
    """Enclose phases mod 2 pi; the lower end lies in [0, 2 pi), undecided ones aside."""
    return lifted(phase, -int(phase[0] // turn(precision).sup), precision)


def phase_after(phase: Fraction, time: Range, precision: int) -> Range:
    """Enclose phase + time mod 2 pi."""
    return on_circle((phase + time[0], phase + time[1]), precision)


def misses(arrival: Range, target: Range) -> bool:
    """Whether arrival times are proved to be at no phase of `target`, a part of [0, 2 pi)."""
    low, high = on_circle(arrival, 64)
    whole = turn(64)
    if high - low >= whole.inf:
        return False
    return not any(
        low <= target[1] + k * whole.sup and target[0] + k * whole.inf <= high for k in (0, 1, 2)
    )
