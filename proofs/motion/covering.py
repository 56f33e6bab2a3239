"""Phases, and the precision and the steps of time that their flights need."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from intervals.errors import Undecided
from proofs.motion.witness import (
    HORIZON,
    FlightBox,
    locate,
)
from proofs.trusted.numbers import COVER_BITS, Range

_MOST_HALVINGS = 128  # of a time step: thinner sets of phases are as good as one phase
_AGAIN = 16  # of the finest steps to a window: they may be longer for some of the launches


def bits_needed(flights: FlightBox, horizon: Fraction = HORIZON) -> int:
    """Return the bits at which the middle one of the launches is decided, the least if none."""
    middle = sum(flights.phases, Fraction(0)) / 2
    try:
        launch = replace(flights, phases=(middle, middle))
        return locate(launch, horizon=horizon).bits
    except Undecided:
        return COVER_BITS


def steps_for(phases: Range) -> Fraction:
    """Return a finest time step that suits the width w of the phases: about sqrt(w) / 8.

    At a distance w from a grazing phase the gap dips below 0 for a time of the order sqrt(w).
    """
    halvings = (1 / (phases[1] - phases[0])).__ceil__().bit_length() // 2
    return Fraction(1, 1 << (3 + min(halvings, _MOST_HALVINGS)))


def halves(part: Range) -> tuple[Range, Range]:
    """Cut an interval in the middle."""
    middle = (part[0] + part[1]) / 2
    return (part[0], middle), (middle, part[1])
