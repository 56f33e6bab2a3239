"""Section 5: stability of the fixed points of the limit map, by epsilon and rho."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction

from intervals import Undecided
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.values import Value
from proofs.trusted.paper import find
from proofs.trusted.paper.formulas import Asked
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import orbits
from proofs.trusted.verdicts import Verdict

_PERIODS = 1  # m
_HIGHEST = 9.0  # rho
_POINTS = 60
_BITS = 64
_LATEST = Fraction("1.57")  # of u, a little below pi/2
_FOCUS = ("2*(1 - epsilon)**2/(1 + epsilon)", "2*(1 + epsilon)")  # alpha where the kind changes


def values(formula: str, points: Sequence[Mapping[str, Fraction]]) -> list[float]:
    """Return the values of a formula; nan where it has none.

    It is evaluated by the checker's arithmetic; what is returned is inside its bounds.
    """
    read, result = read_formulas(Reader(formula)), []
    for inputs in points:
        point = [rational(inputs[name], _BITS) for name in read.variables]
        try:
            low, high = read.values(point)[0].range
            result.append(float(low + high) / 2)
        except Unproved:
            result.append(math.nan)
    return result


def curve(formula: str) -> list[float]:
    """Return the values of a formula in epsilon and m at `_POINTS` epsilons."""
    m = Fraction(_PERIODS)
    return values(formula, [{"epsilon": epsilon, "m": m} for epsilon in _epsilons()])


def _epsilons() -> list[Fraction]:
    return [Fraction(k, _POINTS) for k in range(_POINTS)]


def grazing() -> list[tuple[float, float, float]]:
    """Return epsilon, h and the rho at which the flight of a fixed point touches the table.

    For one with rho sin psi = h, rho cos psi = rho_SN: at time 2 u of the flight.
    """
    points = [{"u": Fraction(k * k, _POINTS**2) * _LATEST} for k in range(1, _POINTS + 1)]
    length = f"d={_PERIODS}*pi"
    epsilons = values(f"at({orbits.RESTITUTION}, {length})", points)
    heights = values(f"at({orbits.HEIGHT}, {length})", points)
    born = [math.tau * _PERIODS * (1 - epsilon) / (1 + epsilon) for epsilon in epsilons]
    rows = zip(epsilons, heights, born, strict=True)
    return [(epsilon, h, math.hypot(h, x)) for epsilon, h, x in rows]


def witnesses(proved: Context) -> list[tuple[float, float]]:
    """Return the oscillators, (epsilon, rho), at which the certificate refutes printed claims."""
    proved_values, places = all_of(proved, Value), set()
    for claim in ("S14", "S16", "S17"):
        row = find(claim)
        for need in () if row is None else row.needs:
            if isinstance(need, Asked) and any(need.met_by(value) for value in proved_values):
                point = {variable.name: side for variable, side in need.box}
                if {"epsilon", "rho"} <= point.keys():
                    places.add((float(point["epsilon"][0]), float(point["rho"][0])))
    return sorted(places)


def plot(proved: Context) -> Drawing:
    """Draw the regions that are proved, and the printed bifurcation values."""
    for claim in ("S15", "S18"):  # stability, and which of them are orbits
        row = find(claim)
        decision = None if row is None else row.decide(proved.of, list(proved.known.values()))
        if decision is None or decision.verdict is Verdict.UNDECIDED:
            raise Undecided(f"{claim} is not decided")
    drawing, axes = style.sheet(4.4)
    _regions(axes)
    _orbits(axes)
    epsilons = [float(each) for each in _epsilons()]
    axes.plot(epsilons, curve(eq.RHO_M), "--", color=style.RED, label=r"printed $\rho_m$, refuted")
    printed = [rho if rho < 3 * _HIGHEST else math.nan for rho in curve(eq.RHO_MF)]
    axes.plot(epsilons, printed, ":", color=style.RED, lw=1.2, label=r"printed $\rho_m^f$, refuted")
    label = "where printed claims are refuted"
    axes.plot(
        *zip(*witnesses(proved), strict=True), "o", color=style.BLACK, markersize=4, label=label
    )
    axes.set(xlabel=r"$\varepsilon$", ylabel=r"$\rho = 2\omega^2\beta/g$")
    axes.set(xlim=(0, 0.99), ylim=(0, _HIGHEST))
    axes.set_title(f"m = {_PERIODS}: flights over one period of the table, $\\omega_n \\to 0$")
    style.legend_below(drawing, axes, 2)
    return drawing


def _regions(axes: Axes) -> None:
    """Fill what the fixed point psi = arccos(rho_SN/rho) is; the other one is a saddle."""
    epsilons = [float(each) for each in _epsilons()]
    born, flip = curve(eq.RHO_SN), curve(eq.flip(eq.ALPHA_FLIP))
    first, last = (curve(eq.flip(alpha)) for alpha in _FOCUS)
    top = [_HIGHEST] * len(epsilons)
    regions = (
        ([0.0] * len(epsilons), born, "0.9", "no fixed points"),
        (born, first, "#B9DDF1", "a sink with real eigenvalues (a node)"),
        (first, last, "#7FBCE0", "a sink with complex eigenvalues (a focus)"),
        (last, flip, "#B9DDF1", "_"),
        (flip, top, "#F7E3B5", "a saddle of the second kind"),
    )
    for low, high, colour, name in regions:
        label = name if name == "_" else f"{name}, proved"
        axes.fill_between(epsilons, low, high, color=colour, lw=0, label=label, gid=style.PROVED)
    label = r"saddle-node at $\rho_{SN}$, proved"
    axes.plot(epsilons, born, color=style.BLUE, lw=1.2, gid=style.PROVED, label=label)
    label = r"flip at $\rho_F$, proved"
    axes.plot(epsilons, flip, color=style.ORANGE, lw=1.2, gid=style.PROVED, label=label)


def _orbits(axes: Axes) -> None:
    """Draw where the flights of fixed points graze: beyond, they are no orbits."""
    rows = grazing()
    for colour, kept, label in (
        (style.GREEN, [row for row in rows if row[1] >= 0], r"above it $\psi$ is an orbit, proved"),
        (
            style.PURPLE,
            [row for row in rows if row[1] <= 0],
            r"below it $-\psi$ is an orbit, proved",
        ),
    ):
        x, y = [epsilon for epsilon, _, _ in kept], [rho for _, _, rho in kept]
        axes.plot(x, y, color=colour, lw=1.6, gid=style.PROVED, label=label)


FIGURE = Figure(
    "section-5",
    "Section 5: stability of the fixed points as the spring becomes soft, and which are orbits",
    ("S15", "S16", "S17", "S18"),
    "soft",
    "The colours say what the fixed point psi = arccos(rho_SN/rho) of the limit map is; the other "
    "one, -psi, is a saddle of the first kind wherever there is one. On the green and the purple "
    "curve the flight of a fixed point grazes the table: psi is an orbit but from rho_SN up to the "
    "green curve, -psi only from rho_SN up to the purple one. Curves are the formulas of the "
    "theorems and of the paper.",
    plot,
)
