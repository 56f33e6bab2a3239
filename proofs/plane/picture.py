"""The picture of an atlas: cells in the colours of what is proved in them, curves on top."""

from __future__ import annotations

import io
import math
from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from itertools import cycle, pairwise
from types import MappingProxyType
from typing import Any, NamedTuple

from proofs.plane.store import Store
from proofs.plane.summary import joined, kinds, merged, words
from proofs.report.figures import style
from proofs.report.figures.curves import along, closed
from proofs.report.figures.figure import all_of
from proofs.report.figures.style import Axes, Drawing
from proofs.report.layout import percent
from proofs.search.curves import Curves, Seen, seen_curves
from proofs.search.evidence import FAILED
from proofs.trusted.atlas import NOT_YET, Region
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper.beyond.grazing import GrazingCurve, nu_squared, ratio
from proofs.trusted.paper.beyond.meetings import Meeting
from proofs.trusted.subjects import Oscillators
from proofs.trusted.verdicts import Verdict

PERIODS = 5  # of the table, at most, between the impacts of an orbit
GRAZING = "grazing"
_MOST_SEEN = 80  # points of curves of grazing that are seen, for which proofs are looked for
_MANY = 5  # windows between multiples of 1/(2 n)
Points = list[tuple[float, float]]


class Line(NamedTuple):
    """A piece of a curve: of what, of orbits with one impact in n table periods, and where."""

    name: str
    n: int
    points: Points


class Overlay(NamedTuple):
    """Lines, and proved points at which two of them meet."""

    lines: list[Line]
    meetings: Points


def overlay(region: Region) -> Overlay:
    """Return the curves that pass through a region; none for a range of epsilon."""
    if not isinstance(region.subject, Oscillators):
        return Overlay([], [])
    least, epsilon = region.subject.epsilon or (Fraction(0),) * 2
    if least < epsilon:
        return Overlay([], [])
    proved = _grazing(region, epsilon)
    curves = list(_closed(region, ratio(epsilon)))
    for curve in all_of(proved, GrazingCurve) if proved else ():
        curves.append((GRAZING, curve.n, list(zip(*along(curve), strict=True))))
    meetings = [
        (float(sum(each.box[0]) / 2), float(sum(each.amplitude) / 2))
        for each in (all_of(proved, Meeting) if proved else ())
    ]
    lines = [Line(name, n, part) for name, n, points in curves for part in _inside(region, points)]
    return Overlay(lines, [place for place in meetings if holds(region, place)])


def holds(region: Region, place: tuple[float, float]) -> bool:
    """Whether a point is in a region."""
    (low, high), (least, most) = region.sides_of
    return low <= place[0] <= high and least <= place[1] <= most


def _inside(region: Region, points: Points) -> Iterator[Points]:
    """Yield the parts of a curve that pass through a region, with an end outside on each side."""
    part: Points = []
    for begin, end in pairwise(points):
        if any(map(math.isnan, (begin[1], end[1]))) or not (
            holds(region, begin) or holds(region, end)
        ):
            if part:
                yield part
            part = []
        else:
            part = [*(part or [begin]), end]
    if part:
        yield part


def _closed(region: Region, q: Fraction) -> Iterator[tuple[str, int, Points]]:
    low, high = region.first
    windows = [
        (n, k)
        for n in range(1, PERIODS + 1)
        for k in range(low * 2 * n // 1, -(-high * 2 * n // 1))
    ]
    step = 1 + len(windows) // _MANY  # short curves need fewer points
    for n, k in windows:
        ends = max(low, Fraction(k, 2 * n)), min(high, Fraction(k + 1, 2 * n))
        for name, etas, nus in closed(n, q, *map(float, ends)):
            points = list(zip(etas, nus, strict=True))
            yield name, n, [*points[:-1:step], points[-1]]


def _grazing(region: Region, epsilon: Fraction) -> Context | None:
    """Prove the curves of grazing that are seen to pass through a region."""
    made, left = Curves(epsilon), _MOST_SEEN
    for n in range(1, PERIODS + 1):
        for run in seen_curves(n, epsilon):
            part = _near(region, n, ratio(epsilon), run)
            left -= len(part)
            if part and left >= 0:
                with suppress(*FAILED):
                    made.grazing(n, part)
    return made.derivation.context if made.traced else None


def _near(region: Region, n: int, q: Fraction, run: list[Seen]) -> list[Seen]:
    """Return the part of a curve, as it is seen, from before to after it is in a region."""
    side = -1 if 2 * n * run[0].eta // 1 % 2 else 1

    def nu(seen: Seen) -> float:
        return side * math.sqrt(nu_squared(n, q, (float(seen.eta), seen.p), math.pi))

    places = [(float(seen.eta), nu(seen)) for seen in run]
    crossed = [k for k, two in enumerate(pairwise(places)) if _crosses(region, *two)]
    return run[crossed[0] : crossed[-1] + 2] if crossed else []


def _crosses(region: Region, begin: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether the box around two points meets a region."""
    sides = zip(begin, end, region.sides_of, strict=True)
    return all(min(a, b) <= side[1] and max(a, b) >= side[0] for a, b, side in sides)


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
