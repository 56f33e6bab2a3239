"""Figures 7a and 7b of the paper, certified: solutions of (16), and the stable orbits among them.

What a certificate proves is drawn: thick curves are stable orbits, in the proved windows; thin ones
solutions of (16) with |slope| < 1 that are none. Curves are (17).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from intervals import Undecided
from proofs.report.figures.figure import Documents, Figure
from proofs.trusted.paper.s4_single.windows import EtaWindows, NuWindows
from proofs.trusted.verdicts import told

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

Floats = NDArray[np.float64]
_POINTS = 2000
_LABELLED = 8  # n up to which windows in eta are labelled


def proved(documents: Documents) -> tuple[EtaWindows, NuWindows]:
    """Return the windows that are proved."""
    known = documents["single"].known.values()
    eta = next((each for each in known if isinstance(each, EtaWindows)), None)
    nu = next((each for each in known if isinstance(each, NuWindows)), None)
    if eta is None or nu is None:
        raise Undecided("no windows of section 4 are proved")
    return eta, nu


def curve(eta: Floats | float, nu: Floats | float, n: int) -> tuple[Floats, Floats]:
    """Return phases of (17) in (-pi, pi), of the solution that can be stable, and slopes there."""
    with np.errstate(all="ignore"):
        x = math.pi * n * np.asarray(eta)
        theta = np.arctan(1 / (np.tan(x) * eta))
        phase = theta - np.arcsin(np.cos(theta) / nu)
        lift = nu * np.sin(phase)
        slope = np.cos(x) ** 2 * (1 - lift / (eta**2 * (1 + lift)))
    return phase, np.asarray(slope)


def _candidates(eta: Floats | float, nu: Floats | float, n: int) -> Floats:
    """Return the phases with |slope| < 1, nan elsewhere and where the curve jumps."""
    phase, slope = curve(eta, nu, n)
    kept = np.where(np.abs(slope) < 1, phase, np.nan)
    kept[1:][np.abs(np.diff(kept)) > 1] = np.nan
    return kept


def _figure_a(axes: Axes, windows: EtaWindows) -> None:
    nu, label = float(windows.nu), f"solutions with |slope| < 1, n up to {_LABELLED}"
    for n, (flip, stick) in enumerate(windows.ends, start=1):
        if n <= _LABELLED:
            etas = np.linspace(float(windows.low), 0.4, _POINTS)
            axes.plot(etas, _candidates(etas, nu, n), "C7", lw=0.7, label=label)
            label = "_"
        stable = np.linspace(float(flip[1]), float(stick[0]), 50)
        axes.plot(stable, curve(stable, nu, n)[0], "C0", lw=2.5)
        if n <= _LABELLED:
            place = float(flip[1] + stick[0]) / 2
            axes.annotate(
                str(n), (place, curve(place, nu, n)[0]), xytext=(0, 5), textcoords="offset points"
            )
    axes.set(xlabel=r"$\eta$", ylabel=r"$\phi$", xscale="log")
    axes.legend(fontsize=7)


def _figure_b(axes: Axes, windows: NuWindows) -> None:
    eta = float(windows.eta)
    for n in range(1, 22):
        amplitudes = np.concatenate(
            (np.linspace(-0.9, -1e-3, _POINTS), np.linspace(1e-3, 0.9, _POINTS))
        )
        axes.plot(amplitudes, _candidates(eta, amplitudes, n), "C7", lw=0.7)
    for sign, side in ((1, windows.above), (-1, windows.below)):
        for n, first, last in side:
            stable = sign * np.linspace(float(first[1]), float(last[0]), 50)
            axes.plot(stable, curve(eta, stable, n)[0], "C0", lw=2.5)
            axes.annotate(
                str(n),
                (stable[25], curve(eta, stable, n)[0][25]),
                xytext=(6, 3),
                textcoords="offset points",
            )
    axes.set(xlabel=r"$\nu$", ylabel=r"$\phi$")


def plot_a(documents: Documents) -> Drawing:
    """Draw figure 7a."""
    from matplotlib import pyplot as plt

    drawing, axes = plt.subplots(figsize=(6.4, 3.2))
    _figure_a(axes, proved(documents)[0])
    return drawing


def plot_b(documents: Documents) -> Drawing:
    """Draw figure 7b."""
    from matplotlib import pyplot as plt

    drawing, axes = plt.subplots(figsize=(6.4, 3.2))
    _figure_b(axes, proved(documents)[1])
    return drawing


FIGURE_A = Figure(
    "figure-7a",
    "Figure 7a: stable orbits with one impact a period, against eta",
    ("P5",),
    ("single",),
    lambda documents: told([proved(documents)[0]]),
    plot_a,
)
FIGURE_B = Figure(
    "figure-7b",
    "Figure 7b: stable orbits with one impact a period, against nu",
    ("P6",),
    ("single",),
    lambda documents: told([proved(documents)[1]]),
    plot_b,
)
