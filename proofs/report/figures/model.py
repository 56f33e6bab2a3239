"""Figure 1: the oscillator and the table, and one motion."""

from __future__ import annotations

import math

from proofs.motion.simulate import next_impact, separation_phase
from proofs.motion.system import System
from proofs.report.figures import style
from proofs.report.figures.figure import Figure
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.equations import arrival, clock, launch, launch_acceleration
from proofs.trusted.kernel.context import Context

_TURNS = 40
_SAMPLES = 30  # a turn
_BEGIN = 1.13  # phase of the first impact
_JUST_AFTER = 1e-7  # at the separation phase itself the gap has a triple zero


def motion(system: System, begin: float, turns: int) -> tuple[list[tuple[float, float]], list[int]]:
    """Return times in turns with x/|p|, sampled after an impact at a phase, and the impacts'
    places in the list."""
    side, eta, nu = system.side, float(system.eta), float(system.nu)
    end = begin + math.tau * turns
    samples, impacts, now = [(begin, _table(system, begin))], [0], begin
    while now < end:
        start = launch(side, eta, nu, now % math.tau)
        if launch_acceleration(start) < 0:
            leaves = now + (separation_phase(system) - now) % math.tau
            samples += _steps(now, min(leaves, end), lambda t: _table(system, t))
            now = leaves + _JUST_AFTER
            start = launch(side, eta, nu, now % math.tau)
        impact = next_impact(system, now % math.tau)
        last = end if impact is None else now + impact.time
        samples += _steps(
            now,
            min(last, end),
            lambda t, start=start, now=now: side * arrival(start, clock(eta, t - now))[0],
        )
        now = last
        impacts.append(len(samples) - 1)
    return [(time / math.tau, x) for time, x in samples], impacts[:-1]


def _table(system: System, time: float) -> float:
    return system.side * (1 + float(system.nu) * math.sin(time))


def _steps(first: float, last: float, position: object) -> list[tuple[float, float]]:
    count = max(2, math.ceil((last - first) / math.tau * _SAMPLES))
    times = [first + (last - first) * k / count for k in range(1, count + 1)]
    return [(time, position(time)) for time in times]  # type: ignore[operator]


def plot(proved: Context) -> Drawing:
    """Draw the model, and a motion at the oscillator of the certificate."""
    system = System(proved.of.eta, proved.of.nu)
    drawing, (left, right) = style.sheet(3.0, 1, 2, width_ratios=(1, 2.6))
    _model(left)
    samples, impacts = motion(system, _BEGIN, _TURNS)
    times, heights = zip(*samples, strict=True)
    right.plot(
        times, [_table(system, math.tau * t) for t in times], color=style.ORANGE, label="table z"
    )
    right.plot(times, heights, color=style.BLUE, label="mass x")
    marks = [samples[k] for k in impacts]
    right.plot(*zip(*marks, strict=True), "o", color=style.RED, markersize=3, label="impacts")
    right.axhline(0, color=style.GREY, lw=0.5, zorder=0)
    right.set(xlabel=r"time [turns of the table]", ylabel="position / |p|", ylim=(-1.6, 2.3))
    right.legend(ncols=3, loc="upper right")
    right.set_title("a motion with plastic impacts, in floating point")
    return drawing


def _model(axes: Axes) -> None:
    """Draw spring, mass and table."""
    from matplotlib.patches import Rectangle

    axes.set(xlim=(-1.5, 1.9), ylim=(-2.1, 2.4))
    axes.set_aspect("equal")
    axes.axis("off")
    for k in range(9):
        axes.plot([0.2 * k - 0.9, 0.2 * k - 0.7], [2.1, 2.28], color=style.BLACK, lw=0.5)
    axes.plot([-0.9, 0.9], [2.1, 2.1], color=style.BLACK)
    zigzag = [0, 0, *[0.22 * (-1) ** k for k in range(9)], 0, 0]
    heights = [2.1, 1.95, *[1.85 - 0.15 * k for k in range(9)], 0.52, 0.4]
    axes.plot(zigzag, heights, color=style.BLACK)
    axes.add_patch(Rectangle((-0.4, 0), 0.8, 0.4, facecolor=style.BLUE, edgecolor="none"))
    axes.add_patch(Rectangle((-1.1, -1.5), 2.2, 0.3, facecolor=style.ORANGE, edgecolor="none"))
    for y, name in ((0, "$x = 0$"), (-1.35, "$-p$")):
        axes.plot([-1.4, 1.25], [y, y], ":", color=style.GREY, lw=0.7, zorder=0)
        axes.text(1.3, y, name, va="center")
    arrow = {"arrowstyle": "<->", "color": style.BLACK, "lw": 0.8, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (-1.25, -0.95), (-1.25, -1.75), arrowprops=arrow)
    axes.text(0.5, 0.2, "$x(t)$", va="center")
    axes.text(0, -1.85, r"$z(t) = -p + \beta\,\sin\,\omega t$", ha="center", va="center")
    axes.text(0.35, 1.25, r"spring, $\omega_n$", va="center")


FIGURE = Figure(
    "figure-1",
    "Figure 1: the model",
    ("M4", "M7", "M8"),
    "foundations",
    "Left: the model, nu = -beta/p, eta = omega_n/omega. Right: one motion, sampled in floating "
    "point, which flies, lands, and in the end rests on the table until it leaves at the same "
    "phase again and again.",
    plot,
)
