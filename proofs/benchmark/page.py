"""What is shown: rows in sections; tables, a page with pictures, JSON with samples."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from proofs.benchmark.curves import Diagram, svg
from proofs.benchmark.measure import Row, version_of
from proofs.report.page import markdown_table
from proofs.shell.files import writing

SCHEMA = "impact-proofs.benchmark/1"
_PACKAGES = ("numpy", "mpmath", "gmpy2", "python-flint", "scipy", "matplotlib")
_ABOUT = """\
Times are on the clock: medians, with the least and the largest in brackets. What is
compared was measured in turn, in one run, so that a busy machine slows all alike;
ratios are of samples taken side by side. The command writes the raw samples as `benchmark.json`."""


class Section(NamedTuple):
    """Rows that belong together: a heading, what they are, and their diagrams."""

    title: str
    about: str
    rows: Sequence[Row]
    diagrams: Sequence[Diagram] = ()

    @property
    def table(self) -> str:
        """The rows under their header."""
        header = "what", "target", "measured", "reached"
        return "\n".join(markdown_table([header, *(row.cells for row in self.rows)]))


@dataclass(frozen=True)
class Run:
    """All that one run measured, what it was asked for, and how long it took."""

    subject: str
    mode: str
    sections: Sequence[Section]
    seconds: float

    @property
    def asked(self) -> list[Row]:
        """Return the rows with a target, and those that fail without one."""
        rows = [row for section in self.sections for row in section.rows]
        return [row for row in rows if row.target or row.reached is False]

    @property
    def verdict(self) -> str:
        """Return the line that the exit status stands for."""
        states = [row.reached for row in self.asked]
        counts = f"{states.count(True)} reached, {states.count(False)} missed"
        unmeasured = f"{states.count(None)} not measured"
        return f"{len(states)} targets: {counts}, {unmeasured}; {self.seconds:.0f} s in all"


def text(run: Run) -> str:
    """Return the tables and the verdict."""
    parts = [f"## {each.title}\n\n{each.table}\n" for each in run.sections]
    return "\n".join([*parts, f"median (least .. largest); {run.verdict}"])


def environment() -> dict[str, str]:
    """Return what the measurements ran on."""
    packages = {name: version_of(name) for name in _PACKAGES}
    machine = {"machine": platform.machine(), "processors": str(os.cpu_count())}
    return {"python": platform.python_version(), **packages, **machine}


def machine_form(run: Run) -> str:
    """Return everything, with the raw samples, as JSON."""
    rows = [{"section": each.title, **vars(row)} for each in run.sections for row in each.rows]
    asked = {"subject": run.subject, "mode": run.mode, "seconds": round(run.seconds, 2)}
    return json.dumps({"schema": SCHEMA, **asked, **environment(), "rows": rows}, indent=1) + "\n"


def markdown(run: Run) -> str:
    """Return the page; it names its pictures, which are not kept with it."""
    machine = ", ".join(f"{name} {version}" for name, version in environment().items())
    about = f"{run.verdict}. Subject: {run.subject}. Mode: {run.mode}."
    lines = ["# Benchmark", "", about, "", _ABOUT, "", f"Measured on: {machine}."]
    lines += [f"\nMissed: {row.name}: {row.measured}." for row in run.asked if not row.reached]
    for section in run.sections:
        lines += ["", f"## {section.title}", "", section.about, "", section.table]
        names = [f"`benchmark-{diagram.name}.svg`" for diagram in section.diagrams]
        lines += ["", f"Drawn by the command: {', '.join(names)}."] if names else []
    return "\n".join(lines) + "\n"


def write(folder: Path, run: Run) -> bool:
    """Write pictures, samples and page, each file whole; return whether there are pictures.

    All is drawn before anything is written, and the page comes last: what it names is there.
    Without matplotlib there are no pictures. OSError if nothing can be written.
    """
    diagrams = [diagram for section in run.sections for diagram in section.diagrams]
    drawn = True
    try:
        files = {f"benchmark-{diagram.name}.svg": svg(diagram) for diagram in diagrams}
    except ImportError:
        files, drawn = {}, False
    files["benchmark.json"] = machine_form(run)
    files["benchmark.md"] = markdown(run)
    with writing(folder) as put:
        for name, content in files.items():
            put(name, content)
    return drawn
