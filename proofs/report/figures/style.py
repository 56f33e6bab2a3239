"""One style for all figures, and SVG that is the same from run to run."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from matplotlib import axes, figure

    Axes: TypeAlias = axes.Axes
    Drawing: TypeAlias = figure.Figure
else:  # matplotlib is imported where something is drawn
    Axes = Drawing = Any

# Okabe and Ito's colours, which the colour-blind tell apart
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, BLACK, GREY = "#CC79A7", "#222222", "#999999"

WIDTH = 6.4  # inches
PROVED = "proved"  # the gid of what a certificate proves

_STYLE: dict[Any, Any] = {
    "font.size": 8,
    "font.sans-serif": ["DejaVu Sans", "Verdana"],  # where letters lie is reckoned with the first
    "svg.fonttype": "none",  # letters are letters: to be found, copied, read aloud
    "axes.titlesize": 8,
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 1.4,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 0.8,
    "patch.linewidth": 0.6,
    "hatch.linewidth": 0.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "path.simplify_threshold": 0.15,
    "figure.constrained_layout.use": True,
}
_SHORT = 1e-6  # matplotlib leaves out strokes without length
_NUMBER = re.compile(r"-?\d+\.\d{3,}")
_PATH = re.compile(r' (?:d|x|y|points|transform)="[^"]*"')
_FAMILY = "font-family: 'DejaVu Sans', Verdana, sans-serif"
_COMMON = f"stroke-linejoin: round; stroke-linecap: butt; {_FAMILY}"  # of all parts
_SPARE = re.compile(
    r"^.*?(?=<svg)|<metadata>.*?</metadata>|<defs>\s*<style.*?</defs>|<!--.*?-->"
    r"|; font-family: [^;\"]*| transform=\"rotate\(-0 [^\"]*\"",
    re.DOTALL,
)
_GROUP_OF_ONE = re.compile(r"<g>\n(<[^g/].*\n)</g>\n")
_MADE = re.compile(r' id="([^"]+)"')
_USED = re.compile(r'(?<=="#)[^"]+|(?<=url\(#)[^)]+')


@contextmanager
def style(salt: str) -> Iterator[None]:
    """Set the style; salt: of the names inside the SVG. matplotlib is imported here."""
    import matplotlib as mpl

    mpl.use("svg")
    with mpl.rc_context({**_STYLE, "svg.hashsalt": salt}):
        yield


def sheet(height: float, rows: int = 1, columns: int = 1, **options: Any) -> tuple[Drawing, Any]:
    """Return a drawing of the common width, and its axes."""
    from matplotlib import pyplot as plt

    return plt.subplots(rows, columns, figsize=(WIDTH, height), **options)


def legend_below(drawing: Drawing, axes: Axes, columns: int) -> None:
    """Put the legend of some axes below the drawing."""
    handles = axes.get_legend_handles_labels()
    drawing.legend(*handles, loc="outside lower center", ncols=columns)


def outline(
    axes: Axes, across: Sequence[Any], upward: Sequence[Any], label: str, **more: Any
) -> None:
    """Draw the sides of a rectangle, given by a range of x and one of y."""
    (left, right), (low, high) = (map(float, ends) for ends in (across, upward))
    corners = [left, right, right, left, left], [low, low, high, high, low]
    axes.plot(*corners, color=BLACK, label=label, **more)


def on_axis(
    axes: Axes,
    sets: Sequence[Sequence[Any]],
    height: float,
    colour: str,
    name: str = "{}",
    **more: Any,
) -> None:
    """Mark sets of phases at a height, each with its number in a name."""
    for index, ends in enumerate(sets):
        low, high = map(float, ends)
        axes.plot([low, high], [height] * 2, color=colour, lw=7, solid_capstyle="butt")
        middle = (low + high) / 2
        axes.text(middle, height, name.format(index), ha="center", va="center", **more)


def proved_polygons(
    axes: Axes,
    polygons: Iterable[Sequence[tuple[Any, Any]]],
    colour: str,
    label: str = "_",
    **more: Any,
) -> None:
    """Fill polygons that are proved, as one path, each closed by its first corner."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    shapes = [
        Path([(float(x), float(y)) for x, y in [*corners, corners[0]]], closed=True)
        for corners in polygons
    ]
    if not shapes:
        return
    more = {"facecolor": colour, "edgecolor": colour, "lw": 0.4} | more
    axes.add_patch(PathPatch(Path.make_compound_path(*shapes), gid=PROVED, label=label, **more))
    axes.autoscale_view()


def proved_boxes(
    axes: Axes, boxes: Iterable[tuple[Any, Any]], colour: str, label: str = "_", **more: Any
) -> None:
    """Fill boxes, each a range of x and one of y, that are proved."""
    corners = (
        [(left, low), (right, low), (right, high), (left, high)]
        for (left, right), (low, high) in boxes
    )
    proved_polygons(axes, list(corners), colour, label, **more)


def dots(
    axes: Axes, points: Iterable[tuple[float, float]], label: str = "_", size: float = 1.4
) -> None:
    """Draw what floating point gives: dots, as one path of strokes too short to be seen."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    ends = [point for x, y in points for point in ((x, y), (x + _SHORT, y))]
    strokes = Path(ends, [Path.MOVETO, Path.LINETO] * (len(ends) // 2))
    strokes.should_simplify = False
    axes.add_patch(PathPatch(strokes, fill=False, edgecolor=BLACK, lw=size, capstyle="round"))
    axes.plot([], [], ".", color=BLACK, markersize=3, label=label)
    axes.autoscale_view()


def svg_of(drawing: Drawing, name: str, title: str, dpi: int = 72) -> str:
    """Return a drawing as SVG without date and metadata, and close it.

    Coordinates have two places, a hundredth of a point. Names are those that something refers to;
    they begin with the figure's, and nothing is said but of its own parts, so that a page may hold
    several figures. dpi: of what is rastered in it.
    """
    from matplotlib import pyplot as plt

    file = io.StringIO()
    none = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    drawing.savefig(file, format="svg", dpi=dpi, metadata={**none, "Title": title})
    plt.close(drawing)
    text = _PATH.sub(_shortened, _SPARE.sub("", file.getvalue()))
    text = text.replace(">", f' style="{_COMMON}">', 1)
    short = {long: f"{name}-{k}" for k, long in enumerate(dict.fromkeys(_USED.findall(text)))}
    text = _MADE.sub(lambda made: f' id="{short[made[1]]}"' if made[1] in short else "", text)
    text = _USED.sub(lambda used: short[used[0]], text)
    text = re.sub(r"\s*\n\s*", "\n", text).strip() + "\n"
    while (less := _GROUP_OF_ONE.sub(r"\1", text)) != text:
        text = less
    return text


def _shortened(attribute: re.Match[str]) -> str:
    """Return places with two decimals; in a path, lines lead to all points after a point."""
    text = _NUMBER.sub(lambda number: f"{round(float(number[0]), 2):g}", attribute[0])
    text = re.sub(r"\s+", " ", text).replace(' "', '"')
    if not re.search('[^ dMLz0-9.="-]', text):
        text = re.sub(r"M (\S+ \S+) L \1(?= M|\")", r"M \1 h0", text).replace(" L ", " ")
    return re.sub(r"(?<=[\dA-Z\"]) ?([A-Zhz]) ?", r"\1", text)
