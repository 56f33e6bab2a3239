"""The marching algorithm of appendix A.1 as printed: a baseline to compare with, never evidence.

It takes the sign s_n of the left side of (10) at psi_k + n delta, and returns the first phase at
which s_n is the opposite of s_1. Where it is right, its error is at most delta. It is wrong where
s_1 is not the sign right after the launch, and where the gap dips below 0 and comes back within a
step; for every delta > 0 there are such phases, on either side of the arc of sticking phases
(`wrong_inputs`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import perf_counter

import numpy as np

from intervals import Undecided
from proofs.motion.image import Image, image
from proofs.motion.kernel import Floats, float_clock, float_launch
from proofs.motion.system import System
from proofs.trusted.equations import gap
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import PAPER

_CHUNK = 1 << 14
STEPS = (1e-2, 1e-3, 1e-4)
GRAZING = Fraction("1.199985859947")  # some 1e-12 below a grazing phase
ONSET = Fraction("3.379354048")  # some 1e-9 below the phase at which sticking begins
_HORIZON = 200


def march(system: System, phase: float, delta: float, horizon: float = _HORIZON) -> float | None:
    """Return n* delta, the time of flight by A.1 with step delta; None if no sign reverses.

    The printed algorithm does not end then; this one does at the horizon. s_n is the sign of the
    gap: that of (10) but for a common factor, which does not change s_1 s_n.
    """
    start = float_launch(system, np.array([phase]))
    first = None
    for begin in range(1, int(horizon / delta) + 1, _CHUNK):
        times: Floats = np.arange(begin, begin + _CHUNK) * np.array([delta])
        signs = np.sign(gap(start, float_clock(system, times)))
        first = signs[0] if first is None else first
        opposite = np.flatnonzero(first * signs == -1)
        if opposite.size:
            return float(times[opposite[0]])
    return None


@dataclass(frozen=True)
class Trial:
    """What A.1 returns at one step, how far off the certified time of flight, and how slowly."""

    delta: float
    flight: float | None
    error: float | None
    seconds: float


def trials(system: System, phase: Fraction, deltas: Sequence[float] = STEPS) -> list[Trial]:
    """Measure A.1 against the certified first impact of a phase that does not stick."""
    truth = flight(system, phase)
    if truth is None:
        raise ValueError("no certified impact to compare with")
    middle = float(truth[0] + truth[1]) / 2
    rows = []
    for delta in deltas:
        began = perf_counter()
        found = march(system, float(phase), delta)
        spent = perf_counter() - began
        rows.append(Trial(delta, found, None if found is None else abs(found - middle), spent))
    return rows


def flight(system: System, phase: Fraction) -> Range | None:
    """Return the certified time from this phase to the next impact, rest on the table included.

    None if none is certified up to the horizon: there is none, or mass and table touch only.
    """
    try:
        found = image(system, (phase, phase), digits=12, horizon=Fraction(_HORIZON))
    except Undecided:
        return None
    if not isinstance(found, Image):
        raise TypeError("the image of one phase is one phase")
    rest = found.dwell or (Fraction(0), Fraction(0))
    return found.flight[0] + rest[0], found.flight[1] + rest[1]


@dataclass(frozen=True)
class WrongInput:
    """A phase at which A.1 is wrong for each of `deltas`, and the certified truth."""

    reason: str
    system: System
    phase: Fraction
    truth: Range | None
    returned: dict[float, float | None]


def wrong_inputs(deltas: Sequence[float] = STEPS) -> list[WrongInput]:
    """Return exact phases at which A.1 fails at these steps, each for a reason of its own.

    Grazing: the gap dips below 0 for some 1e-6 and A.1 steps over the impact; a phase closer to
    the grazing one makes the dip as short as one likes. Onset of sticking: the flight is shorter
    than delta, so that s_1 is the sign after the impact; again as short as one likes. Sticking:
    the formula lets the mass sink into the table, s_1 is the sign below it, for every delta.
    Resonance, eta = 1: the gap is 1 - cos t for every phase (nu < 0), the mass touches the table
    at t = 2 pi with velocity 0, and s_n is never opposite: A.1 does not end, for any delta.
    """
    paper = System(PAPER.eta, PAPER.nu)
    cases = (
        ("grazing", paper, GRAZING),
        ("onset of sticking", paper, ONSET),
        ("sticking", paper, Fraction("4.64")),
        ("resonance", System(Fraction(1), PAPER.nu), Fraction(1)),
    )
    return [
        WrongInput(
            reason,
            system,
            phase,
            flight(system, phase),
            {delta: march(system, float(phase), delta, _HORIZON) for delta in deltas},
        )
        for reason, system, phase in cases
    ]
