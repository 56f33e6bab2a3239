"""Figure 10 simulated: the mass at resonance in floating point, an observation, never evidence.

The paper's experiment drives the table at the natural frequency, raises the amplitude, and sees an
eighth subharmonic. Here is what the model does. Impacts are found by `motion.simulate`, which knows
nothing of the closed form.
"""

from __future__ import annotations

import math
from fractions import Fraction

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import arrival, clock

NUS = tuple(Fraction(text) for text in ("-1/20", "-1/10", "-1/5", "-1/2", "-1", "-2"))
EPSILON = 0.9
SAMPLES = 64  # a table period
WINDOW = 32  # table periods
WINDOWS = (0, 400)  # first periods
_HORIZON = 4 * math.pi


def displacement(nu: Fraction, periods: int, epsilon: float = EPSILON) -> list[float]:
    """Return the position of the mass, sampled from phase 0 on, for nu < 0.

    It meets the table at phase 0 while at rest. A mass that only touches the table flies on.
    """
    system = System(Fraction(1), nu)
    kick = -epsilon * float(nu)  # side (gamma + nu cos phi) epsilon, gamma = phi = 0
    begun, taken, samples = 0.0, 0, []
    while taken < periods * SAMPLES:
        phase = begun % math.tau
        impact = next_impact(system, phase, _HORIZON, kick)
        if impact is None:
            raise ValueError(f"no impact within {_HORIZON:g} of phase {phase:g}")
        while (now := math.tau * taken / SAMPLES) < begun + impact.time:
            samples.append(float(arrival(impact.start, clock(1.0, now - begun))[0]))
            taken += 1
        begun, kick = begun + impact.time, epsilon * impact.speed
    return samples[: periods * SAMPLES]
