"""Figure 10 simulated: the mass at resonance in floating point, an observation, never evidence.

The paper's experiment drives the table at the natural frequency, raises the amplitude, and sees an
eighth subharmonic. Here is what the model does. Impacts are found by `motion.simulate`, which knows
nothing of the closed form.

  python -m proofs.report.subharmonics > figure-10.csv

Rows: the amplitude of the table, the window of table periods, the amplitude of the displacement
at the frequency of the table, and the largest one at a multiple of an eighth of it, but below it.
"""

from __future__ import annotations

import cmath
import csv
import math
import sys
from dataclasses import astuple, dataclass, fields
from fractions import Fraction

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import arrival, clock, launch

NUS = tuple(Fraction(text) for text in ("-1/20", "-1/10", "-1/5", "-1/2", "-1", "-2"))
EPSILON = 0.9
_ORDER = 8
SAMPLES = 64  # a table period
WINDOW = 32  # table periods, a multiple of the order
WINDOWS = (0, 400)  # first periods
_HORIZON = 4 * math.pi


@dataclass(frozen=True)
class Row:
    """A line of the table."""

    nu: str
    first_period: int
    drive: float
    subharmonic: float


def displacement(nu: Fraction, periods: int, epsilon: float = EPSILON) -> list[float]:
    """Return the position of the mass, sampled from phase 0 on, for nu < 0.

    It meets the table at phase 0 while at rest. A mass that only touches the table flies on.
    """
    system = System(Fraction(1), nu)
    kick = -epsilon * float(nu)  # side (gamma + nu cos phi) epsilon, gamma = phi = 0
    begun, taken, samples = 0.0, 0, []
    while taken < periods * SAMPLES:
        phase = begun % math.tau
        found = next_impact(system, phase, kick, _HORIZON)
        if found is None:
            raise ValueError(f"no impact within {_HORIZON:g} of phase {phase:g}")
        time, speed = found
        start = launch(system.side, 1.0, float(nu), phase)._replace(kick=-kick)
        while (now := math.tau * taken / SAMPLES) < begun + time:
            samples.append(float(arrival(start, clock(1.0, now - begun))[0]))
            taken += 1
        begun, kick = begun + time, epsilon * speed
    return samples[: periods * SAMPLES]


def amplitude(samples: list[float], cycles: Fraction) -> float:
    """Return the amplitude of the oscillation with so many cycles a table period."""
    turn = -2j * math.pi * float(cycles) / SAMPLES
    total = sum(value * cmath.exp(turn * k) for k, value in enumerate(samples))
    return 2 * abs(total) / len(samples)


def spectrum(nu: Fraction) -> list[Row]:
    """Return the amplitudes at the drive and below it, early and late."""
    samples = displacement(nu, WINDOWS[-1] + WINDOW)
    rows = []
    for first in WINDOWS:
        part = samples[first * SAMPLES : (first + WINDOW) * SAMPLES]
        below = max(amplitude(part, Fraction(j, _ORDER)) for j in range(1, _ORDER))
        rows.append(Row(str(float(nu)), first, amplitude(part, Fraction(1)), below))
    return rows


def main() -> None:
    """Print the table as CSV."""
    writer = csv.writer(sys.stdout)
    writer.writerow(field.name for field in fields(Row))
    for nu in NUS:
        writer.writerows(
            (name, first, f"{drive:.6f}", f"{below:.6f}")
            for name, first, drive, below in map(astuple, spectrum(nu))
        )


if __name__ == "__main__":
    main()
