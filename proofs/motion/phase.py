"""Phases: times modulo 2 pi, enclosed."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

from intervals import Interval
from proofs.trusted.numbers import Range


def turn(precision: int) -> Interval:
    """Enclose 2 pi."""
    return Interval.pi(precision=precision) * 2


@lru_cache(maxsize=64)
def _whole(precision: int) -> Range:
    whole = turn(precision)
    return whole.inf, whole.sup


def lifted(phase: Range, turns: int, precision: int) -> Range:
    """Add 2 pi turns to an enclosure."""
    added = [turns * end for end in _whole(precision)]
    return phase[0] + min(added), phase[1] + max(added)


def on_circle(phase: Range, precision: int) -> Range:
    """Enclose phases mod 2 pi; the lower end lies in [0, 2 pi), undecided ones aside."""
    return lifted(phase, -int(phase[0] // _whole(precision)[1]), precision)


def phase_after(phase: Fraction, time: Range, precision: int) -> Range:
    """Enclose phase + time mod 2 pi."""
    return on_circle((phase + time[0], phase + time[1]), precision)
