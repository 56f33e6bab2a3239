"""Tables as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table for a browser; a cell may have its bars escaped already."""
    cells = [
        [cell.replace("|", "\\|").replace("\\\\|", "\\|") for cell in row] for row in (head, *rows)
    ]
    first, *others = (f"| {' | '.join(row)} |" for row in cells)
    return "\n".join([first, "|" + "---|" * len(head), *others])


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
