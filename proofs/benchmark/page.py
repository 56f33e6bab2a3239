"""What a run measured: tables for the screen, a page with pictures, JSON with samples."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from proofs.benchmark.diagrams import svg
from proofs.benchmark.rows import Row, Section
from proofs.report.markup import markdown_table
from proofs.trusted.certificate import write_atomically

SCHEMA = "impact-proofs-benchmark-1"
_PACKAGES = ("numpy", "mpmath", "gmpy2", "python-flint", "scipy", "matplotlib")
_MODES = {
    "smallest": "each thing measured once, on small work",
    "quick": "few repetitions, short work",
    "full": "more repetitions, longer work",
}
_ABOUT = """\
Times are on the clock: medians, with the least and the largest in brackets. What is
compared was measured in turn, in one run, so that a busy machine slows all alike;
ratios are of samples taken side by side. The raw samples are in `benchmark.json`."""


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


def text(run: Run) -> str:
    """Return the tables and the verdict."""
    parts = [f"## {one.title}\n\n" + "\n".join(_table(one.rows)) for one in run.sections]
    return "\n\n".join([*parts, f"median (least .. largest); {verdict(run)}"])


def verdict(run: Run) -> str:
    """Return the line that the exit status stands for."""
    reached, missed, unmeasured = _counts(run.asked)
    counts = f"{reached} reached, {missed} missed, {unmeasured} not measured"
    return f"{len(run.asked)} targets: {counts}; {run.seconds:.0f} s in all"


def _counts(asked: Sequence[Row]) -> list[int]:
    return [sum(row.reached is state for row in asked) for state in (True, False, None)]


def _table(rows: Sequence[Row]) -> list[str]:
    header = ("what", "target", "measured", "reached")
    cells = [(row.name, row.target or "-", row.measured, row.state) for row in rows]
    return markdown_table([header, *cells])


def environment() -> dict[str, str | int | None]:
    """Return what the measurements ran on; None stands for a package that is absent."""
    packages = {name: version_of(name) for name in _PACKAGES}
    machine = {"machine": platform.machine(), "processors": os.cpu_count()}
    return {"python": platform.python_version(), **packages, **machine}


def version_of(package: str) -> str | None:
    """Return the version of a package; None if it is absent."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None


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


def write(folder: Path, run: Run) -> bool:
    """Write pictures, samples and page, each file whole; return whether there are pictures.

    All is drawn before anything is written, and the page comes last: what it links to is there.
    Without matplotlib there are no pictures. OSError if nothing can be written.
    """
    diagrams = [one for section in run.sections for one in section.diagrams]
    try:
        files = {f"benchmark-{one.name}.svg": svg(one) for one in diagrams}
    except ImportError:
        files = {}
    drawn = bool(files) or not diagrams
    files |= {"benchmark.json": machine_form(run), "benchmark.md": markdown(run, files)}
    for name, content in files.items():
        write_atomically(folder / name, content)
    return drawn


def markdown(run: Run, pictures: Collection[str] = ()) -> str:
    """Return the page, with links to those pictures that are there."""
    machine = ", ".join(f"{name} {one or 'absent'}" for name, one in environment().items())
    mode = f"Subject: {run.subject}. Mode: {run.mode} ({_MODES[run.mode]})."
    lines = ["# Benchmark", "", f"{verdict(run)}. {mode}", "", _ABOUT, ""]
    lines += [f"Measured on: {machine}.", "", "## Targets", "", *_targets(run)]
    for section in run.sections:
        lines += ["", f"## {section.title}", "", section.about, "", *_table(section.rows)]
        for diagram in section.diagrams:
            if (file := f"benchmark-{diagram.name}.svg") in pictures:
                lines += ["", f"![{diagram.title}]({file})"]
    return "\n".join(lines) + "\n"


def _targets(run: Run) -> list[str]:
    """Return how many targets each section has and reached; each that was not."""
    counts = [
        (one.title, *map(str, (len(one.asked), *_counts(one.asked))))
        for one in run.sections
        if one.asked
    ]
    lines = markdown_table([("section", "targets", "reached", "missed", "not measured"), *counts])
    for state, heading in ((False, "Missed"), (None, "Not measured")):
        rows = [(one.title, row) for one in run.sections for row in one.asked]
        rows = [(title, row) for title, row in rows if row.reached is state]
        if rows:
            lines += ["", f"{heading}:", ""]
        for title, row in rows:
            wanted = f"; wanted: {row.target}" if row.target else ""
            lines.append(f"- {title}: {row.name}: {row.measured}{wanted}")
    return lines
