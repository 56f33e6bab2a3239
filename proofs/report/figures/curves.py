"""Curves in the plane of eta and nu: grazing, as far as it is proved, folds and flips beside."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import BLACK, BLUE, GREEN, ORANGE, PROVED, sheet
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.beyond.grazing import (
    ETA,
    GrazingCurve,
    Meeting,
    amplitude,
    nu_squared,
    ratio,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

_POINTS = 400
_DASHES = ("-", (0, (4, 1)))  # of n = 1, 2


def _beside(curve: GrazingCurve, flip: bool) -> tuple[list[float], list[float]]:
    """Return points of the curve of folds, or of flips, where it is below |nu| = 1."""
    n, q = curve.n, ratio(curve.epsilon)
    low, high = map(float, curve.arc.ends)
    etas, nus = [low + (high - low) * k / _POINTS for k in range(_POINTS + 1)], []
    for eta in etas:
        x = math.pi * n * eta
        share = -((float(q) * eta * math.tan(x)) ** 2)
        if flip:
            share = eta**2 * (float(q) ** 2 + 1 / math.cos(x) ** 2)
        nu = math.sqrt(nu_squared(n, q, (eta, share), math.pi)) if share < 1 else math.nan
        nus.append(curve.side * nu if nu < 1 else math.nan)
    return etas, nus


def plot(proved: Context) -> Drawing:
    """Draw all curves of a certificate."""
    epsilon = the(proved, GrazingCurve).epsilon
    drawing, axes = sheet(3.6)
    seen: set[str] = set()

    def once(text: str) -> str:
        new = text not in seen
        seen.add(text)
        return text if new else "_"

    for curve in all_of(proved, GrazingCurve):
        ends = [piece.cut(ETA, piece.box[ETA][0]) for piece in curve.arc.pieces]
        last = curve.arc.pieces[-1]
        ends.append(last.cut(ETA, last.box[ETA][1]))
        nus = [float(sum(amplitude(curve, end)) / 2) for end in ends]
        label, dashes = once(f"grazing, n = {curve.n}"), _DASHES[(curve.n - 1) % 2]
        etas = [float(end[ETA][0]) for end in ends]
        axes.plot(etas, nus, color=BLUE, lw=1.8, ls=dashes, gid=PROVED, label=label)
        for flip, colour, name in ((False, GREEN, "folds"), (True, ORANGE, "flips")):
            shown = once(f"{name}, n = {curve.n}")
            axes.plot(*_beside(curve, flip), color=colour, lw=0.8, ls=dashes, label=shown)
    for each in all_of(proved, Meeting):
        place = float(sum(each.box[ETA]) / 2), float(sum(each.amplitude) / 2)
        axes.plot(*place, "o", color=BLACK, markersize=3, gid=PROVED, label=once("they meet"))
    axes.axhline(0, color="0.7", lw=0.4)
    axes.set(xlabel=r"$\eta$", ylabel=r"$\nu$", ylim=(-1, 1))
    axes.set_title(rf"$\epsilon$ = {float(epsilon):g}")
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return drawing


FIGURE = Figure(
    "curves",
    "Curves of grazing, of folds and of flips in the plane of eta and nu",
    ("C2", "C3"),
    "curves",
    "Thick: single-impact orbits that touch the table on their way, through the ends of the proved "
    "boxes; points: where that meets folds or flips, proved. Thin: folds and flips by their closed "
    "forms, in floating point.",
    plot,
)
