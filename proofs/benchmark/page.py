"""What a run measured: tables for the screen, a page with pictures, JSON with samples."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from proofs.benchmark.diagrams import Diagram, svg
from proofs.benchmark.measuring import Row, environment, table, word
from proofs.trusted.certificate import write_atomically

SCHEMA = "impact-proofs-benchmark-1"
_PREFIX = "benchmark-"
_MODES = {
    "smallest": "each thing measured once, on small work",
    "quick": "few repetitions, short work",
    "full": "more repetitions, longer work",
}


@dataclass(frozen=True)
class Section:
    """Rows that belong together: a heading, what they are, and their diagrams."""

    title: str
    about: str
    rows: list[Row]
    diagrams: list[Diagram] = field(default_factory=list)

    @property
    def asked(self) -> list[Row]:
        """Return the rows with a target, and those that fail without one."""
        return [row for row in self.rows if row.target or row.reached is False]


@dataclass(frozen=True)
class Run:
    """All that one run measured, what it was asked for, and how long it took."""

    subject: str
    mode: str
    sections: Sequence[Section]
    seconds: float

    @property
    def asked(self) -> list[Row]:
        """Return the rows with a target, and those that fail without one, of all sections."""
        return [row for section in self.sections for row in section.asked]

    @property
    def reached(self) -> bool:
        """Whether every target was measured and reached."""
        return all(row.reached for row in self.asked)


def verdict(run: Run) -> str:
    """Return the line that the exit status stands for."""
    reached, missed, unmeasured = _counts(run.asked)
    counts = f"{reached} reached, {missed} missed, {unmeasured} not measured"
    return f"{len(run.asked)} targets: {counts}; {run.seconds:.0f} s in all"


def _counts(asked: Sequence[Row]) -> tuple[int, int, int]:
    """Return how many were reached, missed, not measured."""
    found = [row.reached for row in asked]
    return found.count(True), found.count(False), found.count(None)


def text(run: Run) -> str:
    """Return the tables, under headings if there are several, and the verdict."""
    parts = [table(one.rows) for one in run.sections]
    if len(parts) > 1:
        headed = zip(run.sections, parts, strict=True)
        parts = [f"== {one.title} ==\n{part}" for one, part in headed]
    return "\n\n".join([*parts, f"median (least .. largest); {verdict(run)}"])


def machine_form(run: Run) -> str:
    """Return everything, with the raw samples, as JSON."""
    data = {
        "schema": SCHEMA,
        "subject": run.subject,
        "mode": run.mode,
        "seconds": round(run.seconds, 2),
        **environment(),
        "rows": [
            {"section": section.title, **vars(row)}
            for section in run.sections
            for row in section.rows
        ],
    }
    return json.dumps(data, indent=1) + "\n"


# -- the page --------------------------------------------------------------------------------------


def write(folder: Path, run: Run) -> bool:
    """Write pictures, samples and page, each file whole; return whether there are pictures.

    All is drawn before anything is written, and the page comes last: what it links to is there.
    Without matplotlib there are no pictures. OSError if nothing can be written.
    """
    pictures = _pictures(run)
    page, samples = markdown(run, pictures), machine_form(run)
    for name, picture in pictures.items():
        write_atomically(folder / name, picture)
    write_atomically(folder / "benchmark.json", samples)
    write_atomically(folder / "benchmark.md", page)
    return bool(pictures) or not any(section.diagrams for section in run.sections)


def _pictures(run: Run) -> dict[str, str]:
    """Draw all diagrams by file name; none without matplotlib."""
    try:
        return {_file(one): svg(one) for section in run.sections for one in section.diagrams}
    except ImportError:
        return {}


def _file(diagram: Diagram) -> str:
    return f"{_PREFIX}{diagram.name}.svg"


def markdown(run: Run, pictures: Collection[str] = ()) -> str:
    """Return the page, with links to those pictures that are there."""
    lines = [
        "# Benchmark",
        "",
        f"{verdict(run)}. Subject: {run.subject}. Mode: {run.mode} ({_MODES[run.mode]}).",
        "",
        "Times are on the clock: medians, with the least and the largest in brackets. What is",
        "compared was measured in turn, in one run, so that a busy machine slows all alike;",
        "ratios are of samples taken side by side. The raw samples are in `benchmark.json`.",
        "",
        f"Measured on: {_listed(environment())}.",
        "",
        *_targets(run),
    ]
    for section in run.sections:
        lines += ["", f"## {section.title}", "", section.about, "", *_cells(section.rows)]
        drawn = [one for one in section.diagrams if _file(one) in pictures]
        for diagram in drawn:
            lines += ["", f"![{diagram.title}]({_file(diagram)})"]
    return "\n".join(lines) + "\n"


def _listed(found: Mapping[str, str | int | None]) -> str:
    """Write versions, what is absent, and the machine."""
    return ", ".join(f"{name} {'absent' if one is None else one}" for name, one in found.items())


def _targets(run: Run) -> Iterator[str]:
    """Yield how many targets each section has and reached; each that was not."""
    yield "## Targets"
    if not run.asked:
        yield from ["", "None is set for this subject."]
        return
    yield from [
        "",
        "| section | targets | reached | missed | not measured |",
        "|---|---|---|---|---|",
    ]
    for section in run.sections:
        if section.asked:
            counts = " | ".join(map(str, (len(section.asked), *_counts(section.asked))))
            yield f"| {_cell(section.title)} | {counts} |"
    for state, heading in {False: "Missed", None: "Not measured"}.items():
        rows = [(one.title, row) for one in run.sections for row in one.asked]
        rows = [(title, row) for title, row in rows if row.reached is state]
        if rows:
            yield from ["", f"{heading}:", ""]
        for title, row in rows:
            yield f"- {_cell(f'{title}: {row.name}')}: {_cell(row.measured)}{_wanted(row)}"


def _wanted(row: Row) -> str:
    return f"; wanted: {_cell(row.target)}" if row.target else ""


def _cells(rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a table."""
    yield "| what | target | measured | reached |"
    yield "|---|---|---|---|"
    for row in rows:
        cells = row.name, row.target or "-", row.measured, word(row)
        yield "| " + " | ".join(map(_cell, cells)) + " |"


def _cell(content: str) -> str:
    """Write one cell: columns of the screen apart, no sign of Markdown taken for one."""
    plain = re.sub(" {2,}", " · ", content.strip())
    for sign in "\\|*`":
        plain = plain.replace(sign, f"\\{sign}")
    return plain
