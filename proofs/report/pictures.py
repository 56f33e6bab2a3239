"""The figures as the page and the Markdown show them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from proofs.report.findings import section_of
from proofs.report.figures import FIGURES, Figure
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find


@dataclass(frozen=True)
class Picture:
    """A figure that is drawn. claims: those of the report that it belongs to."""

    name: str
    title: str
    caption: str
    svg: str
    claims: tuple[str, ...]

    @property
    def section(self) -> str:
        """The section of the paper that it belongs to: that of its first claim."""
        row = find(self.claims[0])
        return "" if row is None else section_of(row)


def pictures(documents: Mapping[str, Context], claims: Iterable[str]) -> list[Picture]:
    """Draw the figures for which there are certificates and claims; matplotlib is imported here."""
    present = set(claims)
    return [
        _drawn(figure, documents, present)
        for figure in FIGURES
        if present.intersection(figure.claims) and set(figure.certificates) <= set(documents)
    ]


def _drawn(figure: Figure, documents: Mapping[str, Context], present: set[str]) -> Picture:
    claims = tuple(claim for claim in figure.claims if claim in present)
    caption, svg = figure.caption(documents), figure.svg(documents)
    return Picture(figure.name, figure.title, caption, svg, claims)
