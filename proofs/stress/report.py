"""What a run found, by family: Markdown for people, JSON for machines."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from proofs.report.markup import markdown_table
from proofs.stress.families import FAMILIES
from proofs.stress.judge import Judgement, Outcome

SCHEMA = "impact-proofs.stress/1"
_REASONS = 3
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


@dataclass(frozen=True)
class Run:
    """All judgements of one run, and what it was asked for."""

    judgements: Sequence[Judgement]
    seed: int
    kernel: str
    seconds: float

    @property
    def failures(self) -> list[Judgement]:
        """Return the cases on which the library is wrong."""
        return [one for one in self.judgements if one.outcome.failure]

    def by_family(self) -> dict[str, list[Judgement]]:
        """Return the judgements of each family that has any."""
        found: dict[str, list[Judgement]] = {}
        for one in self.judgements:
            found.setdefault(one.case.family, []).append(one)
        return found


def rows(run: Run) -> list[tuple[str, ...]]:
    """Return a line for each family; widths and times are medians and largest."""
    lines = []
    for name, some in run.by_family().items():
        count = Counter(one.outcome for one in some)
        numbers = (len(some), *(count[outcome] for outcome in _OUTCOMES.values()))
        widths = [one.width for one in some if one.width is not None]
        times = [1000 * one.seconds for one in some]
        lines.append((name, *map(str, numbers), *_spread(widths), *_spread(times)))
    return lines


def _spread(values: Sequence[float]) -> tuple[str, str]:
    return (f"{median(values):.2g}", f"{max(values):.2g}") if values else ("-", "-")


def _table(run: Run) -> str:
    return "\n".join(markdown_table([_HEADER, *rows(run)], numbers_from=1))


def text(run: Run) -> str:
    """Return the table, the failures and the verdict."""
    return "\n".join([_table(run), "", *_failures(run), verdict(run)])


def verdict(run: Run) -> str:
    """Return the line that the exit status stands for."""
    count = f"{len(run.judgements)} cases in {run.seconds:.0f} s, judged by {run.kernel}: "
    if not run.failures:
        return count + "no case excludes the truth"
    excluded = sum(one.outcome is Outcome.EXCLUDED for one in run.failures)
    return count + f"{excluded} EXCLUDE THE TRUTH, {len(run.failures) - excluded} crash"


def _failures(run: Run) -> list[str]:
    lines = []
    for one in run.failures:
        inputs = one.case.inputs()
        name = inputs.pop("family")
        given = ", ".join(f"{field} = {value}" for field, value in inputs.items())
        lines.append(f"{one.outcome.value}: {name}: {one.reason}; input {given}")
    return lines


def markdown(run: Run) -> str:
    """Return the page."""
    known = run.by_family()
    families = [f"- {family.name}: {family.about}" for family in FAMILIES if family.name in known]
    refused = [
        f"- {name}: {count} times: {reason}"
        for name, some in known.items()
        for reason, count in reasons(some)
    ]
    lines = ["# Stress", "", f"{verdict(run)}. Seed {run.seed}.", "", _ABOUT, "", _table(run)]
    lines += ["", "## What each family is", "", *families]
    lines += ["", "## Why cases were refused", "", *refused]
    if run.failures:
        lines += ["", "## Failures", "", *(f"- {line}" for line in _failures(run))]
    return "\n".join(lines) + "\n"


def reasons(some: Sequence[Judgement]) -> list[tuple[str, int]]:
    """Return the commonest reasons of refusals, without what differs from case to case."""
    refused = (Outcome.REFUSED, Outcome.STOPPED, Outcome.MISSED)
    count: Counter[str] = Counter()
    for one in some:
        if one.outcome in refused:
            words = one.reason.split()
            count[" ".join("..." if any(map(str.isdigit, w)) else w for w in words)] += 1
    return count.most_common(_REASONS)


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
