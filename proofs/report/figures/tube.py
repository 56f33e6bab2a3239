"""The tube of an initial value problem: each state over the time, as the boxes that are proved."""

from __future__ import annotations

from io import StringIO

from proofs.methods.tubes import Tube
from proofs.report.figures.style import BLUE, proved_boxes, sheet, style


def drawn(tube: Tube) -> str:
    """Return it as SVG."""
    pieces = tube.pieces()
    with style("tube"):
        drawing, grid = sheet(1.6 * len(tube.names), rows=len(tube.names), squeeze=False)
        panels = grid[:, 0]
        for k, (name, axes) in enumerate(zip(tube.names, panels, strict=True)):
            proved_boxes(axes, [(piece.time, piece.box[k]) for piece in pieces], BLUE)
            axes.set_ylabel(name)
        panels[-1].set_xlabel("time")
        stream = StringIO()
        drawing.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()
