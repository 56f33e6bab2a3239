"""Figures 7a and 7b: the stable orbits with one impact a period, and solutions of (16) beside."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from intervals import Undecided
from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import Axes, Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s4_single.windows import EtaWindows, NuWindows, Window

_POINTS = 4000
_WIDEST = 14.0  # the paper's eta
_NAMED = 8  # n up to which windows in eta are named
_DASHES = ("-", (0, (4, 1)), (0, (1, 1)))  # of n = 1, 2, 3
_STABLE = "stable orbits, leaving the table at once, over proved windows"
_OTHER = "solutions of (16) with |(18)| < 1, no such orbits"


def solution(eta: float, nu: float, n: int) -> tuple[float, float]:
    """Return the phase of (17) in (-pi, pi) that can be stable, and the slope (18) there; nan
    where there is none."""
    x = math.pi * n * eta
    try:
        theta = math.atan(1 / (math.tan(x) * eta))
        ratio = math.cos(theta) / nu  # of modulus 1 at a saddle-node, but for rounding
        phase = theta - math.asin(max(-1.0, min(1.0, ratio)) if abs(ratio) < 1 + 1e-9 else ratio)
    except (ValueError, ZeroDivisionError):
        return math.nan, math.nan
    lift = nu * math.sin(phase)
    return phase, math.cos(x) ** 2 * (1 - lift / (eta**2 * (1 + lift)))


def _candidates(points: Sequence[tuple[float, float]], n: int) -> list[float]:
    """Return the phases with |slope| < 1; nan elsewhere, and where the curve jumps."""
    kept, before = [], math.nan
    for eta, nu in points:
        phase, slope = solution(eta, nu, n)
        jumps = abs(phase - before) > 1
        kept.append(phase if abs(slope) < 1 and not jumps else math.nan)
        before = phase
    return kept


def _between(first: Range, last: Range, count: int = 40) -> list[float]:
    """Return numbers from one enclosed end of a window to the other, all inside it."""
    low, high = float(first[1]), float(last[0])
    shares = [k / (count - 1) for k in range(count - 1)]
    return [low + (high - low) * share for share in (*shares, 1 - 1e-9)]


def _window(axes: Axes, x: list[float], y: list[float], label: str) -> None:
    axes.plot(x, y, color=style.BLUE, lw=2.4, gid=style.PROVED, label=label, solid_capstyle="butt")


def _named(axes: Axes, x: list[float], y: list[float], name: str, colour: str = "0.4") -> None:
    """Write a name above the highest point of a curve."""
    top = max((k for k in range(len(y)) if not math.isnan(y[k])), key=lambda k: y[k])
    above: dict[str, Any] = {"xytext": (0, 2), "textcoords": "offset points", "ha": "center"}
    axes.annotate(name, (x[top], y[top]), **above, fontsize=6.5, color=colour)


def plot_a(proved: Context) -> Drawing:
    """Draw figure 7a for both signs of nu: eta on a logarithmic axis."""
    sides = sorted(all_of(proved, EtaWindows), key=lambda each: -each.nu)
    if len(sides) < 2:
        raise Undecided("windows in eta are not proved for both signs of nu")
    drawing, both = style.sheet(5.4, 2, 1, sharex=True)
    for axes, each in zip(both, sides, strict=True):
        late = [(1, *each.late)] if each.late else []
        _against_eta(axes, each.nu, each.low, [*_numbered(each.ends), *late])
    both[1].set(xlabel=r"$\eta$", xscale="log", xlim=(0.8 * float(sides[0].low), _WIDEST))
    style.legend_below(drawing, both[0], 2)
    return drawing


def _numbered(ends: Iterable[tuple[Range, Range]]) -> list[Window]:
    return [(n, first, last) for n, (first, last) in enumerate(ends, start=1)]


def _against_eta(axes: Axes, nu: Fraction, low: Fraction, windows: Sequence[Window]) -> None:
    """Draw solutions for a few n, and the stable orbits."""
    least, amplitude = float(low), float(nu)
    etas = [least * (_WIDEST / least) ** (k / _POINTS) for k in range(_POINTS + 1)]
    for n, dashes in enumerate(_DASHES, start=1):
        phases = _candidates([(eta, amplitude) for eta in etas], n)
        axes.plot(etas, phases, color=style.GREY, ls=dashes, lw=0.6, label=f"{_OTHER}: n = {n}")
    label = _STABLE
    for n, first, last in windows:
        inside = _between(first, last, 40 if n <= _NAMED else 6)
        phases = [solution(eta, amplitude, n)[0] for eta in inside]
        _window(axes, inside, phases, label)
        label = "_"
        if n <= _NAMED:
            _named(axes, inside, phases, str(n), style.BLUE)
    axes.set_ylabel(r"$\phi$ [rad]")
    axes.set_title(
        rf"$\nu$ = {show(nu)}; the numbers are n = 1, ..., {max(n for n, *_ in windows)}"
    )


def plot_b(proved: Context) -> Drawing:
    """Draw figure 7b."""
    windows = the(proved, NuWindows)
    drawing, axes = style.sheet(3.6)
    eta, label = float(windows.eta), _OTHER
    sides = {1: windows.above, -1: windows.below}
    stable = {sign: {n for n, _, _ in side} for sign, side in sides.items()}
    for n in range(1, 22):
        for sign in (-1, 1):
            amplitudes = [sign * (0.9 * (k + 1) / _POINTS) for k in range(_POINTS)]
            phases = _candidates([(eta, nu) for nu in amplitudes], n)
            if not all(map(math.isnan, phases)):
                axes.plot(amplitudes, phases, color=style.GREY, lw=0.6, label=label)
                if n not in stable[sign]:
                    _named(axes, amplitudes, phases, str(n))
                label = "_"
    label = _STABLE
    for sign, side in sides.items():
        for n, first, last in side:
            inside = [sign * size for size in _between(first, last)]
            phases = [solution(eta, nu, n)[0] for nu in inside]
            _window(axes, inside, phases, label)
            beside = {"xytext": (-4, 0), "textcoords": "offset points", "ha": "right"}
            axes.annotate(str(n), (inside[20], phases[20]), **beside, color=style.BLUE)
            label = "_"
    axes.set(xlabel=r"$\nu$", ylabel=r"$\phi$ [rad]", xlim=(-0.9, 0.9))
    axes.set_title(rf"$\eta$ = {show(windows.eta)}; the numbers are n")
    style.legend_below(drawing, axes, 2)
    return drawing


_SHOWS = (
    "Thick: the stable orbits with one impact in n periods of the table, over the windows that are "
    "proved. Thin: solutions of (16) at which (18) is below 1 in absolute value, but which are no "
    "such orbits. The phases are (17) in floating point."
)
FIGURE_A = Figure(
    "figure-7a",
    "Figure 7a: stable orbits with one impact a period, against eta",
    ("P5",),
    "single",
    _SHOWS,
    plot_a,
)
FIGURE_B = Figure(
    "figure-7b",
    "Figure 7b: stable orbits with one impact a period, against nu",
    ("P6",),
    "single",
    _SHOWS,
    plot_b,
)
