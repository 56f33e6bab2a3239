"""The picture of an atlas: cells in the colours of what is proved in them, curves on top."""

from __future__ import annotations

import io
from collections import defaultdict
from collections.abc import Mapping
from fractions import Fraction
from itertools import cycle
from types import MappingProxyType
from typing import Any, NamedTuple

from proofs.plane.overlay import GRAZING, Line, Overlay, holds, overlay
from proofs.plane.store import Store
from proofs.plane.summary import joined, kinds, merged, words
from proofs.report.figures import style
from proofs.report.figures.style import Axes, Drawing
from proofs.report.layout import percent
from proofs.trusted.atlas import NOT_YET, Region
from proofs.trusted.verdicts import Verdict

SHADES = MappingProxyType(
    {
        Verdict.VERIFIED.value: ("#8FD3BC", "#3FA283", "#CDEBDD", "#1F7D60", "#B3D98C", "#6DB6B0"),
        Verdict.REFUTED.value: ("#F3C0A0", "#DE8555", "#F9DFCF"),
    }
)  # greens and reds, as verdicts have on every page
UNDECIDED = "#F1F1EF"
STROKES = MappingProxyType(
    {
        GRAZING: (style.RED, 1.8, ()),
        "folds": (style.BLACK, 1.0, ()),
        "flips": (style.BLACK, 1.0, (5, 2)),
        "where it begins to stick": (style.BLACK, 1.0, (1, 2)),
    }
)  # colour, width, dashes
_GREEK = MappingProxyType({"eta": "η", "nu": "ν"})
_MOST_NAMED = 40  # lines: of more the names would hide the cells
MEETINGS = "grazing meets another one"


class Shown(NamedTuple):
    """What is shown of an atlas: its summary, cells by kind of conclusion, curves over them.

    verdicts: of the kinds.
    """

    made: dict[str, Any]
    regions: dict[str, list[str]]
    verdicts: dict[str, str]
    over: Overlay


def shown(store: Store, made: dict[str, Any]) -> Shown:
    """Return what is shown of a store: cells, as few as are the same part of the plane."""
    keys_of, verdicts = defaultdict[str, list[str]](list), {}
    for cell in store.cells(Verdict.VERIFIED, Verdict.REFUTED):
        keys_of[cell.kind].append(cell.key)
        verdicts[cell.kind] = cell.verdict
    parts = {kind: merged(keys) for kind, keys in keys_of.items()}
    return Shown(made, parts, verdicts, overlay(store.region))


def labels(region: Region) -> tuple[str, str]:
    """Return the names of the parameters as they are shown, the oscillator's in Greek."""
    across, up = (_GREEK.get(name, name) for name in region.names)
    return across, up


def coloured(verdicts: Mapping[str, str]) -> dict[str, str]:
    """Return a shade of its verdict's colour for each kind, in the order of a legend."""
    shades = {verdict: cycle(each) for verdict, each in SHADES.items()}
    return {kind: next(shades[verdicts[kind]]) for kind in kinds(verdicts)}


def picture(region: Region, shown: Shown) -> Drawing:
    """Draw an atlas, the shares of the area in the legend."""
    made, regions, verdicts, over = shown
    shares = made["share_of_area"]
    drawing, axes = style.sheet(5.4)
    undecided = f"undecided: {percent(shares[Verdict.UNDECIDED.value])}"
    if shares[NOT_YET] != "0":
        undecided += f"; {NOT_YET}: {percent(shares[NOT_YET])}"
    axes.set_facecolor(UNDECIDED)
    axes.fill([], [], color=UNDECIDED, label=undecided)
    for kind, colour in coloured(verdicts).items():
        boxes = map(region.sides, regions[kind])
        label = f"{words(kind)}: {percent(shares[kind])}"
        style.proved_boxes(axes, joined(boxes), colour, label, lw=0)
    _draw_lines(axes, region, over)
    across, up = labels(region)
    axes.set(xlabel=across, ylabel=up, xlim=_ends(region.first), ylim=_ends(region.second))
    axes.set_title(f"{region.question}: {made['holds']}", wrap=True)
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower left", ncols=2)
    return drawing


def png(drawing: Drawing) -> bytes:
    """Return a drawing as PNG."""
    image = io.BytesIO()
    drawing.savefig(image, format="png", dpi=200)
    return image.getvalue()


def _ends(side: tuple[Fraction, Fraction]) -> tuple[float, float]:
    return float(side[0]), float(side[1])


def _draw_lines(axes: Axes, region: Region, over: Overlay) -> None:
    names = [line.name for line in over.lines]
    for k, line in enumerate(over.lines):
        colour, width, dashes = STROKES[line.name]
        label = line.name if line.name not in names[:k] else "_"
        proved = style.PROVED if line.name == GRAZING else None
        (stroke,) = axes.plot(*zip(*line.points, strict=True), color=colour, lw=width, gid=proved)
        stroke.set_label(label)
        if dashes:
            stroke.set_dashes(dashes)
        if len(over.lines) > _MOST_NAMED:
            continue
        x, y = named(region, line)
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.8}
        axes.text(x, y, f"n = {line.n}", ha="center", va="center", fontsize=6, bbox=box)
    if over.meetings:
        places = zip(*over.meetings, strict=True)
        axes.plot(*places, "o", color=style.BLACK, markersize=4, gid=style.PROVED, label=MEETINGS)


def named(region: Region, line: Line) -> tuple[float, float]:
    """Return where the name of a line is: along it, inside of a region, for each kind elsewhere."""
    inside = [place for place in line.points if holds(region, place)]
    share = (1 + [*STROKES].index(line.name)) / (1 + len(STROKES))
    return inside[int(len(inside) * share)] if inside else line.points[0]
