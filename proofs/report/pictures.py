"""The figures as the page and the Markdown show them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from proofs.report.figures import figures
from proofs.report.figures.figure import Figure
from proofs.report.findings import section_of
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find


@dataclass(frozen=True)
class Picture:
    """A figure of the report. claims: those that it belongs to and that are decided."""

    figure: Figure
    claims: tuple[str, ...]

    @property
    def name(self) -> str:
        """The name of its file, without ".svg"."""
        return self.figure.name

    @property
    def title(self) -> str:
        """Its title."""
        return self.figure.title

    @property
    def section(self) -> str:
        """The section of the paper that it belongs to: that of its first claim."""
        row = find(self.claims[0])
        return "" if row is None else section_of(row)


def pictures(documents: Mapping[str, Context], claims: Iterable[str]) -> list[Picture]:
    """Return the figures for which there are certificates and claims."""
    present = set(claims)
    return [
        Picture(figure, tuple(claim for claim in figure.claims if claim in present))
        for figure in figures()
        if present.intersection(figure.claims) and figure.certificate in documents
    ]
