"""Figures 8 and 10: resonance, in place of double-impact orbits, and simulated.

The paper's experiment drives the table at the natural frequency, raises the amplitude, and sees an
eighth subharmonic. Figure 10 is what the model does in floating point, an observation, never
evidence. Impacts are found by `motion.simulate`, which knows nothing of the closed form.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

from intervals import Undecided
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.equations import arrival, clock
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find
from proofs.trusted.verdicts import Verdict

_EPSILONS = (0.7, 0.3)
_STARTS = ((1.5, -0.5), (3.0, -0.8), (4.6, -1.1), (6.1, -1.4))  # phase and c of first impacts
_STEPS = 12


def orbit(epsilon: float, phase: float, c: float) -> list[tuple[float, float]]:
    """Return impacts (phase, c) at resonance, by the closed form; phases on the line."""
    points = [(phase, c)]
    for _ in range(_STEPS):
        phase, c = phase + 2 * math.atan(epsilon * c), epsilon * c
        points.append((phase, c))
    return points


def plot_impacts(proved: Context) -> Drawing:
    """Draw the grazing orbits, and motions that tend to them."""
    row = find("R13")
    decision = None if row is None else row.decide(proved.of, list(proved.known.values()))
    if decision is None or decision.verdict is not Verdict.REFUTED:
        raise Undecided("that there are no double-impact orbits is not proved")
    drawing, both = style.sheet(2.9, 1, 2, sharey=True)
    for axes, epsilon in zip(both, _EPSILONS, strict=True):
        _motions(axes, epsilon)
        axes.axhline(0, color=style.BLUE, lw=3, gid=style.PROVED, zorder=0, label=_GRAZING)
        axes.set_title(rf"$\varepsilon$ = {epsilon}, $\eta$ = 1, $\nu$ < 0")
        axes.set(xlabel=r"phase $\phi$ [rad]", xlim=(0, math.tau))
    both[0].set_ylabel(r"$c = \gamma + \nu\,\cos\,\phi$ before the impact")
    style.legend_below(drawing, both[0], 1)
    return drawing


_GRAZING = "c = 0: the grazing orbits of period one; there are no other periodic orbits, proved"


def _motions(axes: Axes, epsilon: float) -> None:
    """Draw impacts of some motions, those of one motion joined."""
    label = "impacts of four motions, by the closed form of the map in floating point"
    for colour, (phase, c) in zip(
        (style.ORANGE, style.RED, style.GREY, "#222222"), _STARTS, strict=True
    ):
        points = [(x % math.tau, y) for x, y in orbit(epsilon, phase, c)]
        joined = points[:1]
        for before, point in pairwise(points):
            if abs(before[0] - point[0]) > math.pi:  # the phase passes 2 pi
                joined.append((math.nan, math.nan))
            joined.append(point)
        axes.plot(*zip(*joined, strict=True), color=colour, lw=0.5)
        axes.plot(*zip(*points, strict=True), ".", color=colour, markersize=5, label=label)
        label = "_"


IMPACTS = Figure(
    "figure-8",
    "Figure 8: at resonance, in place of double-impact orbits",
    ("R9", "R13"),
    "resonance",
    "Blue: all periodic orbits there are for nu < 0, proved. Dots: motions, by the closed form of "
    "the map in floating point; each tends to a grazing orbit.",
    plot_impacts,
)


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


def plot_traces(proved: Context) -> Drawing:
    """Draw the displacement at the lowest and the highest amplitude, early and late: simulated."""
    del proved
    drawing, all_axes = style.sheet(3.8, 2, 2, sharey="row", sharex="col")
    for row, nu in zip(all_axes, (NUS[0], NUS[-1]), strict=True):
        samples = displacement(nu, WINDOWS[-1] + WINDOW)
        for axes, first in zip(row, WINDOWS, strict=True):
            part = samples[first * SAMPLES : (first + WINDOW) * SAMPLES]
            axes.plot(
                [first + k / SAMPLES for k in range(len(part))], part, color=style.BLUE, lw=0.7
            )
            axes.set_title(rf"$\nu$ = {float(nu)}, $\varepsilon$ = {EPSILON}, simulated")
        row[0].set_ylabel("x / |p|")
    for axes in all_axes[1]:
        axes.set_xlabel("turns of the table")
    return drawing


TRACES = Figure(
    "figure-10",
    "Figure 10: the mass at resonance",
    ("E1",),
    "resonance",
    f"A simulation in floating point at eta = 1, epsilon = {EPSILON}: the first turns of the table "
    f"and those from {WINDOWS[-1]} on, at the lowest and the highest amplitude of those tried.",
    plot_traces,
)
