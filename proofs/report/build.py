"""All pages of a folder of certificates: Markdown, figures, the page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from types import MappingProxyType

from intervals import Undecided
from proofs.report import graph
from proofs.report.atlases import atlases
from proofs.report.checker import checker
from proofs.report.figures import figures as all_figures
from proofs.report.figures.figure import Certificates, Documents, Figure
from proofs.report.findings import findings
from proofs.report.ledger import ledger
from proofs.report.theorem import theorem
from proofs.trusted.kernel.context import Context

NEEDED = ("jinja2", "latex2mathml", "matplotlib")  # for the page, by the extra `report`
INSTALL = "pip install 'impact-proofs[report]'"
Tell = Callable[[str], None]
Each = Callable[..., Iterable[str | None]]  # as `map`, here or in other processes


def missing() -> list[str]:
    """Return the packages that the page needs and that are not installed."""
    return [name for name in NEEDED if find_spec(name) is None]


def built(
    folder: Path,
    tell: Tell = lambda stage: None,
    only_text: bool = False,
    pyodide: Path | None = None,
    *,
    derived: Documents = MappingProxyType({}),
    each: Each = map,
) -> dict[str, str]:
    """Return the files of the report, by their names in the folder; nothing is proved again.

    only_text: without the page and the figures of matplotlib, for which packages may be missing.
    pyodide: where it is, for a page with a checker in it, too. derived: what came from
    certificates of the folder just now, by name. each: what draws the figures.
    Raises Malformed, Rejected or OSError where the folder has no ledger, or one that its
    certificates do not prove.
    """
    documents = Certificates(folder, derived)
    tell("certificates")
    claims = findings(folder, documents)
    figures = shown(documents, [claim.id for claim in claims.claims])
    texts = [] if only_text else each(_svg, figures, [documents[x.certificate] for x in figures])
    files = {"ledger.md": ledger(claims, figures), "theorem.md": theorem(claims)}
    files["figures/dependencies.svg"] = graph.svg(claims)
    if only_text:
        return files
    from proofs.report.html import page  # needs what may be missing

    drawn = {}
    for figure, text in zip(figures, texts, strict=True):
        tell(figure.title)
        if text is not None:
            drawn[figure.name] = text
    files |= {f"figures/{name}.svg": text for name, text in drawn.items()}
    tell("index.html")
    figures = [figure for figure in figures if figure.name in drawn]
    maps = atlases(folder)
    files["index.html"] = page(claims, figures, drawn, atlases=maps)
    if pyodide is not None:
        certificates = dict.fromkeys(claim.file for claim in claims.claims)
        files["checker.html"] = page(
            claims, figures, drawn, checker(pyodide, folder, certificates), maps
        )
    return files


def shown(documents: Documents, claims: Iterable[str]) -> list[Figure]:
    """Return the report's figures for which there are certificates, with those of the claims."""
    present = set(claims)
    return [
        replace(figure, claims=tuple(claim for claim in figure.claims if claim in present))
        for figure in all_figures()
        if present.intersection(figure.claims) and figure.certificate in documents
    ]


def _svg(figure: Figure, proved: Context) -> str | None:
    """Return a figure, None where the certificate does not prove what it shows."""
    try:
        return figure.svg({figure.certificate: proved})
    except Undecided:
        return None
