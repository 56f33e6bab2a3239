"""Tables and pictures as text that is the same from run to run."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def markdown_table(rows: Sequence[Sequence[str]], numbers_from: int = 99) -> list[str]:
    """Return the lines of a table, the first row its header, aligned for a screen, too.

    Columns from `numbers_from` on are aligned to the right.
    """
    rows = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]

    def line(row: Sequence[str]) -> str:
        cells = [
            cell.rjust(width) if k >= numbers_from else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        return "| " + " | ".join(cells) + " |"

    rule = "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    header, *others = rows
    return [line(header), rule, *map(line, others)]


def drawn(
    salt: str,
    size: tuple[float, float],
    draw: Callable[[Any], None],
    rows: int = 1,
    columns: int = 1,
) -> str:
    """Return as SVG what `draw` puts on the axes that it is given; matplotlib is imported here.

    salt: of the names inside the SVG.
    """
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    with mpl.rc_context({"svg.hashsalt": salt, "font.size": 9}):
        figure, axes = plt.subplots(rows, columns, figsize=size, layout="constrained")
        draw(axes)
        return svg_text(figure)


def svg_text(figure: Figure) -> str:
    """Return a figure as SVG without the date, and close it. Set svg.hashsalt before."""
    from matplotlib import pyplot as plt

    file = io.StringIO()
    figure.savefig(file, format="svg", metadata={"Date": None})
    plt.close(figure)
    return "\n".join(line.rstrip() for line in file.getvalue().splitlines()) + "\n"
