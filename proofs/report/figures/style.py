"""One style for all figures, and SVG that is the same from run to run."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

# Okabe and Ito's colours, which the colour-blind tell apart
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
SKY, PURPLE, GREY = "#56B4E9", "#CC79A7", "#8A8A8A"

_STYLE = {
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 9,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 0.9,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "mathtext.fontset": "dejavusans",
    "path.simplify": True,
    "path.simplify_threshold": 0.3,
    "figure.constrained_layout.use": True,
}
_NUMBER = re.compile(r"-?\d+\.\d{3,}")
_PATH = re.compile(r' (?:d|points)="[^"]*"')
_ID = re.compile(r' id="([^"]+)"')
_REFERENCE = re.compile(r'( id="|="#|url\(#)')


@contextmanager
def style(salt: str) -> Iterator[None]:
    """Set the style; salt: of the names inside the SVG. matplotlib is imported here."""
    import matplotlib as mpl

    mpl.use("svg")
    with mpl.rc_context({**_STYLE, "svg.hashsalt": salt}):
        yield


def svg_of(drawing: Drawing, name: str, title: str) -> str:
    """Return a drawing as SVG without date and metadata, and close it.

    Coordinates have two places (a seventh of a micrometre), and names are those that something
    refers to, beginning with the figure's, so that a page may hold several.
    """
    from matplotlib import pyplot as plt

    file = io.StringIO()
    none = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    drawing.savefig(file, format="svg", metadata={**none, "Title": title})
    plt.close(drawing)
    text = _PATH.sub(lambda path: _NUMBER.sub(_two_places, path[0]), file.getvalue())
    text = _ID.sub(lambda id_: id_[0] if f"#{id_[1]}" in text else "", text)
    text = _REFERENCE.sub(rf"\1{name}-", text)
    return "\n".join(line.rstrip() for line in text.splitlines()) + "\n"


def _two_places(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}"
