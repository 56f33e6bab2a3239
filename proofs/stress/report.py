"""What a run found, by family: Markdown for people, JSON for machines."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from statistics import median
from typing import NamedTuple

from proofs.report.markup import markdown_table
from proofs.stress.judge import Judgement, Outcome

SCHEMA = "impact-proofs.stress/1"
_REASONS = 3  # of a family, that are shown
_OUTCOMES = {
    outcome.name if outcome.failure else outcome.name.lower(): outcome for outcome in Outcome
}
_HEADER = ("family", "cases", *_OUTCOMES, "width", "width max", "ms", "ms max")
_ABOUT = """\
Each case is an exact input at which programs fail; the answer of the library is compared
with a computation to 100 digits by another kernel. Width: of the widest bounds of an
answer, by the least possible (what the input's own width makes of the result, and the
digits asked for); median and largest. ms: on the clock. Possible: a set of possible
images, the true one among them. Refused: for the reasons below. Stopped: after a second
of work. Missed: refused for want of an impact, or as impossible, though there is one.
Unjudged: the truth is out of reach."""


class Run(NamedTuple):
    """All judgements of one run, by family, and what it was asked for."""

    families: dict[str, list[Judgement]]
    seed: int
    kernel: str
    seconds: float

    @property
    def judgements(self) -> list[Judgement]:
        """Return all of them."""
        return [one for some in self.families.values() for one in some]

    @property
    def failures(self) -> list[Judgement]:
        """Return the cases on which the library is wrong."""
        return [one for one in self.judgements if one.outcome.failure]


def text(run: Run) -> str:
    """Return the table, the failures, and the line that the exit status stands for."""
    return "\n".join([_table(run), "", *_failures(run), _verdict(run)])


def markdown(run: Run, about: dict[str, str]) -> str:
    """Return the page. about: what each family is."""
    lines = ["# Stress", "", f"{_verdict(run)}. Seed {run.seed}.", "", _ABOUT, "", _table(run)]
    lines += ["", "## What each family is", ""]
    lines += [f"- {name}: {about[name]}" for name in run.families]
    lines += ["", "## Why cases were refused", ""]
    for name, some in run.families.items():
        lines += [f"- {name}: {count} times: {why}" for why, count in _reasons(some)]
    if run.failures:
        lines += ["", "## Failures", "", *(f"- {line}" for line in _failures(run))]
    return "\n".join(lines) + "\n"


def machine_form(run: Run) -> str:
    """Return every case as JSON: its exact input and what became of it."""
    cases = [
        {
            **one.case.inputs(),
            "outcome": one.outcome.value,
            "ms": round(1000 * one.seconds, 3),
            "reason": one.reason,
            "width": {name: float(f"{width:.4g}") for name, width in one.widths.items()},
        }
        for one in run.judgements
    ]
    data = {"schema": SCHEMA, "seed": run.seed, "kernel": run.kernel}
    data |= {"seconds": round(run.seconds, 2), "failures": len(run.failures), "cases": cases}
    return json.dumps(data, indent=1) + "\n"


def _table(run: Run) -> str:
    rows = [_HEADER, *(_row(name, some) for name, some in run.families.items())]
    return "\n".join(markdown_table(rows, numbers_from=1))


def _row(name: str, some: Sequence[Judgement]) -> tuple[str, ...]:
    """Return the line of a family; widths and times are medians and largest."""
    count = Counter(one.outcome for one in some)
    numbers = len(some), *(count[outcome] for outcome in _OUTCOMES.values())
    row = [name, *map(str, numbers)]
    widths = [one.width for one in some if one.width is not None]
    for values in (widths, [1000 * one.seconds for one in some]):
        row += [f"{median(values):.2g}", f"{max(values):.2g}"] if values else ["-", "-"]
    return tuple(row)


def _verdict(run: Run) -> str:
    count = f"{len(run.judgements)} cases in {run.seconds:.0f} s, judged by {run.kernel}: "
    if not run.failures:
        return count + "no case excludes the truth"
    excluded = sum(one.outcome is Outcome.EXCLUDED for one in run.failures)
    return count + f"{excluded} EXCLUDE THE TRUTH, {len(run.failures) - excluded} crash"


def _failures(run: Run) -> Iterator[str]:
    for one in run.failures:
        family, *given = (f"{name} = {value}" for name, value in one.case.inputs().items())
        yield f"{one.outcome.value}: {family}: {one.reason}; input {', '.join(given)}"


def _reasons(some: Sequence[Judgement]) -> list[tuple[str, int]]:
    """Return the commonest reasons of refusals, without what differs from case to case."""
    refused = (Outcome.REFUSED, Outcome.STOPPED, Outcome.MISSED)
    reasons = (one.reason.split() for one in some if one.outcome in refused)
    words = (["..." if any(map(str.isdigit, word)) else word for word in each] for each in reasons)
    return Counter(map(" ".join, words)).most_common(_REASONS)
