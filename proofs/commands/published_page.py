"""Pages about published systems and maps: theorems first, from certificates; then the literature.

`written` proves nothing: it reads certificates that `python -m proofs published` has made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from proofs.map import Map
from proofs.report.figures.portrait import portrait
from proofs.report.page import markdown_table
from proofs.theorem import Theorem
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.verify import check

FOLDER = Path("reports/systems")
INDEX = Path("docs/systems.md")
_WORK = 2 * DEFAULT  # of a certificate, at most
_MOST = 12  # theorems of a certificate that a page has in full
Prove = Callable[[], Theorem]


class Published(NamedTuple):
    """What is published about a system or a map, and what is proved of it, by certificates.

    beside: what the literature says, a paragraph each; omitted: what is not proved here, and why.
    """

    name: str
    title: str
    source: str
    system: Map
    asked: Mapping[str, Prove]
    beside: Sequence[str]
    omitted: Sequence[str] = ()


def theorem(file: Path) -> Theorem:
    """Return the theorem of a certificate, as the checker concludes it."""
    text = file.read_text("utf-8")
    return Theorem(check(text, _WORK).conclusions, text)


def page(published: Published, theorems: Mapping[str, Theorem]) -> str:
    """Return a page in Markdown; each sentence about the mathematics is a conclusion's."""
    lines = [f"# {published.title}", "", f"> Source: {published.source}", "", "## Theorems", ""]
    for name, proved in theorems.items():
        lines += [*_told(proved), f"Certificate: [{name}.json]({published.name}/{name}.json)", ""]
    lines += ["## What the literature says", ""]
    for paragraph in published.beside:
        lines += [paragraph, ""]
    if published.omitted:
        lines += [
            "## What is not proved here",
            "",
            *(f"- {each}" for each in published.omitted),
            "",
        ]
    lines += ["## Picture", "", f"![{published.title}]({published.name}/portrait.svg)"]
    return "\n".join(lines) + "\n"


def _told(proved: Theorem) -> list[str]:
    """Return the conclusions of a certificate; of many orbits the first ones, and a count."""
    return ["```text", proved.text(_MOST), "```", ""]


def picture(published: Published, theorems: Mapping[str, Theorem]) -> str:
    """Return what is proved about the system itself over points that others at random come to."""
    conclusions = [each for proved in theorems.values() for each in proved]
    return portrait(published.system.sample()[::4], published.system.variables, conclusions)


def index(pages: Sequence[tuple[Published, Mapping[str, Theorem]]]) -> str:
    """Return the table of all pages."""
    rows = [["system or map", "page", "conclusions", "certificates"]]
    for published, theorems in pages:
        place = f"`reports/systems/{published.name}.md`"
        files = ", ".join(f"`{name}`" for name in theorems)
        rows.append([published.title, place, str(sum(map(len, theorems.values()))), files])
    return "\n".join([*_HEAD.split("\n"), *markdown_table(rows), ""])


_HEAD = """\
# Published systems

Impacting systems and maps of the literature, with what is proved of them here. Each page has the
theorems first, as the checker concludes them, then what the source says. `python -m proofs check`
accepts every certificate; `python -m proofs published --fresh` proves all of it again. A file
of such a system is ten lines: [Your own system](own-system.md).
"""
