"""The marching algorithm of appendix A.1 as printed: a baseline to compare with, never evidence.

It takes the sign s_n of the left side of (10) at psi_k + n delta, and returns the first phase at
which s_n is the opposite of s_1. Where it is right, its error is at most delta. It is wrong where
s_1 is not the sign right after the launch, and where the gap dips below 0 and comes back within a
step; for every delta > 0 there are such phases, on either side of the arc of sticking phases.
"""

from __future__ import annotations

import numpy as np

from proofs.motion.many import Floats
from proofs.motion.system import System
from proofs.trusted.equations import clock, gap

_CHUNK = 1 << 14
_HORIZON = 200


def march(system: System, phase: float, delta: float, horizon: float = _HORIZON) -> float | None:
    """Return n* delta, the time of flight by A.1 with step delta; None if no sign reverses.

    The printed algorithm does not end then; this one does at the horizon. s_n is the sign of the
    gap: that of (10) but for a common factor, which does not change s_1 s_n.
    """
    start = system.launched(np.array([phase]))
    first = None
    for begin in range(1, int(horizon / delta) + 1, _CHUNK):
        times: Floats = np.arange(begin, begin + _CHUNK) * np.array([delta])
        signs = np.sign(gap(start, clock(float(system.eta), times)))
        first = signs[0] if first is None else first
        opposite = np.flatnonzero(first * signs == -1)
        if opposite.size:
            return float(times[opposite[0]])
    return None
