"""Curves in the plane of eta and nu: grazing, as far as it is proved, folds and flips beside."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from proofs.report.figures import style
from proofs.report.figures.figure import Figure, all_of, the
from proofs.report.figures.style import Drawing
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.beyond.grazing import (
    ETA,
    GrazingCurve,
    amplitude,
    nu_squared,
    ratio,
)
from proofs.trusted.paper.beyond.meetings import Meeting

_POINTS = 400
_WIDEST = 2  # eta
_COLOURS = {"folds": style.GREEN, "flips": style.ORANGE, "where it begins to stick": style.PURPLE}
_DASHES = ("-", (0, (4, 1)))  # of n = 1, 2


def closed(
    n: int, q: Fraction, low: float, high: float
) -> Iterator[tuple[str, list[float], list[float]]]:
    """Yield the closed forms (row C1) where they are below |nu| = 1: names, eta, nu.

    low, high: of eta, both in one interval between multiples of 1/(2 n).
    """
    window = math.floor(n * (low + high))
    etas = [low + (high - low) * (k + 0.5) / _POINTS for k in range(_POINTS)]
    forms: dict[str, list[float]] = {"folds": [], "flips": []}
    if q == 1 and window < 2:
        forms["where it begins to stick"] = []
    for eta in etas:
        x, own = math.pi * n * eta, float(q)
        shares = {
            "folds": -((own * eta * math.tan(x)) ** 2),
            "flips": eta**2 * (own * own + 1 / math.cos(x) ** 2),
            "where it begins to stick": eta**2,
        }
        for name, nus in forms.items():
            p = shares[name]
            nu = math.sqrt(nu_squared(n, q, (eta, p), math.pi)) if p < 1 else math.nan
            nus.append((-1) ** window * nu if nu < 1 else math.nan)
    for name, nus in forms.items():
        yield name, etas, nus


def along(curve: GrazingCurve) -> tuple[list[float], list[float]]:
    """Return eta and nu at the ends of the boxes of a curve, at the middle of what is proved."""
    ends = [piece.cut(ETA, piece.box[ETA][0]) for piece in curve.arc.pieces]
    last = curve.arc.pieces[-1]
    ends.append(last.cut(ETA, last.box[ETA][1]))
    return [float(end[ETA][0]) for end in ends], [
        float(sum(amplitude(curve, end)) / 2) for end in ends
    ]


def plot(proved: Context) -> Drawing:
    """Draw all curves of a certificate."""
    epsilon = the(proved, GrazingCurve).epsilon
    drawing, axes = style.sheet(3.6)
    seen: set[str] = set()

    def once(text: str) -> str:
        new = text not in seen
        seen.add(text)
        return text if new else "_"

    for curve in all_of(proved, GrazingCurve):
        label, dashes = once(f"grazing, n = {curve.n}"), _DASHES[(curve.n - 1) % 2]
        axes.plot(*along(curve), color=style.BLUE, lw=1.8, ls=dashes, gid=style.PROVED, label=label)
    for n in sorted({curve.n for curve in all_of(proved, GrazingCurve)}):
        for window in range(_WIDEST * 2 * n):
            for name, etas, nus in closed(
                n, ratio(epsilon), window / (2 * n), (window + 1) / (2 * n)
            ):
                line = {"color": _COLOURS[name], "lw": 0.7, "ls": _DASHES[(n - 1) % 2]}
                axes.plot(etas, nus, **line, label=once(f"{name}, n = {n}"))
    for each in all_of(proved, Meeting):
        place = float(sum(each.box[ETA]) / 2), float(sum(each.amplitude) / 2)
        axes.plot(
            *place, "o", color=style.BLACK, markersize=3, gid=style.PROVED, label=once("they meet")
        )
    axes.axhline(0, color="0.7", lw=0.4)
    axes.set(xlabel=r"$\eta$", ylabel=r"$\nu$", ylim=(-1, 1))
    axes.set_title(rf"$\epsilon$ = {float(epsilon):g}")
    style.legend_below(drawing, axes, 4)
    return drawing


FIGURE = Figure(
    "curves",
    "Curves of grazing, of folds and of flips in the plane of eta and nu",
    ("C2", "C3"),
    "curves",
    "Thick: single-impact orbits that touch the table on their way, through the ends of the proved "
    "boxes; points: where that meets folds or flips, proved. Thin, in floating point: folds, flips "
    "and for epsilon = 0 where the mass begins to stick, of the solutions of (14), (15), by their "
    "closed forms; whether they are orbits, grazing says.",
    plot,
)
