"""What a run found, by family: Markdown for people, JSON for machines, and a picture."""

from __future__ import annotations

import io
import json
import statistics
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from proofs.stress.families import FAMILIES
from proofs.stress.judge import Judgement, Outcome

SCHEMA = "impact-proofs-stress-1"
_REASONS = 3
_PRESCRIBED = ("operations", "functions", "arrays")
_COUNTED = {
    "enclosed": Outcome.ENCLOSED,
    "possible": Outcome.POSSIBLE,
    "refused": Outcome.REFUSED,
    "stopped": Outcome.STOPPED,
    "missed": Outcome.MISSED,
    "unjudged": Outcome.UNJUDGED,
    "EXCLUDED": Outcome.EXCLUDED,
    "CRASHED": Outcome.CRASHED,
}
_HEADER = ("family", "cases", *_COUNTED, "width", "width max", "ms", "ms max")


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
        found: dict[str, list[Judgement]] = {family.name: [] for family in FAMILIES}
        for one in self.judgements:
            found[one.family].append(one)
        return {name: some for name, some in found.items() if some}


def table(run: Run) -> list[tuple[str, ...]]:
    """Return the header and a line for each family; widths and times are medians and largest."""
    lines: list[tuple[str, ...]] = [_HEADER]
    for name, some in run.by_family().items():
        count = Counter(one.outcome for one in some)
        numbers = (len(some), *(count[outcome] for outcome in _COUNTED.values()))
        ratios = [one.ratio for one in some if one.ratio is not None]
        times = [1000 * one.seconds for one in some]
        lines.append((name, *(str(n) for n in numbers), *_spread(ratios), *_spread(times)))
    return lines


def _spread(values: Sequence[float]) -> tuple[str, str]:
    if not values:
        return "-", "-"
    return f"{statistics.median(values):.2g}", f"{max(values):.2g}"


def text(run: Run) -> str:
    """Return the table in plain aligned text, with the verdict."""
    lines = table(run)
    widths = [max(len(line[i]) for line in lines) for i in range(len(_HEADER))]
    shown = [
        "  ".join([line[0].ljust(widths[0]), *map(str.rjust, line[1:], widths[1:])])
        for line in lines
    ]
    return "\n".join([*shown, "", *_precisions(run), *_failures(run), verdict(run)])


def verdict(run: Run) -> str:
    """Return the line that the exit status stands for."""
    excluded = sum(one.outcome is Outcome.EXCLUDED for one in run.judgements)
    crashed = len(run.failures) - excluded
    count = f"{len(run.judgements)} cases in {run.seconds:.0f} s, judged by {run.kernel}: "
    if not run.failures:
        return count + "no case excludes the truth"
    return count + f"{excluded} EXCLUDE THE TRUTH, {crashed} crash"


def _precisions(run: Run) -> list[str]:
    """Say how many motions needed how many bits to find the first impact."""
    needed = Counter(
        one.bits for one in run.judgements if one.bits is not None and one.family not in _PRESCRIBED
    )
    if not needed:
        return []
    parts = ", ".join(f"{bits} bits {count}" for bits, count in sorted(needed.items()))
    return [f"first impacts of points and of boxes, by the least precision that sufficed: {parts}"]


def _failures(run: Run) -> list[str]:
    return [
        f"{one.outcome.value}: {one.family}: {one.reason}; input {_input(one)}"
        for one in run.failures
    ]


def _input(one: Judgement) -> str:
    return ", ".join(f"{name} = {value}" for name, value in one.inputs.items() if name != "family")


def markdown(run: Run) -> str:
    """Return the page."""
    header, *rows = table(run)
    lines = [
        "# Stress",
        "",
        f"{verdict(run)}. Seed {run.seed}.",
        "",
        "Each case is an exact input at which programs fail; the answer of the library is compared",
        "with a computation to 100 digits by another kernel. Width: of the widest bounds of an",
        "answer, by the least possible (what the input's own width makes of the result, and the",
        "digits asked for); median and largest. ms: on the clock. Possible: a set of possible",
        "images, the true one among them. Refused: for the reasons below. Stopped: after a second",
        "of work. Missed: refused for want of an impact, or as impossible, though there is one.",
        "Unjudged: the truth is out of reach.",
        "",
        "| " + " | ".join(header) + " |",
        "|---" * len(header) + "|",
        *("| " + " | ".join(row) + " |" for row in rows),
        "",
        *_precisions(run),
        "",
        "## What each family is",
        "",
        *(f"- {f.name}: {f.about}" for f in FAMILIES if f.name in run.by_family()),
        "",
        "## Why cases were refused",
        "",
    ]
    for name, some in run.by_family().items():
        for reason, count in reasons(some):
            lines.append(f"- {name}: {count} times: {reason}")
    if run.failures:
        lines += ["", "## Failures", "", *(f"- {line}" for line in _failures(run))]
    return "\n".join(lines) + "\n"


def reasons(some: Sequence[Judgement]) -> list[tuple[str, int]]:
    """Return the commonest reasons of refusals, without their numbers."""
    refused = (Outcome.REFUSED, Outcome.STOPPED, Outcome.MISSED)
    count = Counter(_generic(one.reason) for one in some if one.outcome in refused)
    return count.most_common(_REASONS)


def _generic(reason: str) -> str:
    """Leave out what differs from case to case."""
    words = ("..." if any(c.isdigit() for c in word) else word for word in reason.split())
    return " ".join(words)


def machine_form(run: Run) -> str:
    """Return every case as JSON: its exact input and what became of it."""
    data = {
        "schema": SCHEMA,
        "seed": run.seed,
        "kernel": run.kernel,
        "seconds": round(run.seconds, 2),
        "failures": len(run.failures),
        "families": [dict(zip(_HEADER, line, strict=True)) for line in table(run)[1:]],
        "cases": [_case(one) for one in run.judgements],
    }
    return json.dumps(data, indent=1) + "\n"


def _case(one: Judgement) -> dict[str, object]:
    found: dict[str, object] = {
        **one.inputs,
        "outcome": one.outcome.value,
        "ms": round(1000 * one.seconds, 3),
    }
    if one.reason:
        found["reason"] = one.reason
    if one.bits is not None:
        found["bits"] = one.bits
    if one.ratios:
        found["width"] = {name: float(f"{ratio:.4g}") for name, ratio in one.ratios.items()}
    return found


def svg(run: Run) -> str:
    """Return a picture: the width of every answer by the least possible, by family."""
    import matplotlib as mpl

    mpl.use("svg")
    from matplotlib import pyplot as plt

    families = run.by_family()
    with mpl.rc_context({"svg.hashsalt": "stress", "font.size": 8}):
        figure, axes = plt.subplots(figsize=(7.0, 0.28 * len(families) + 1.2), layout="constrained")
        for row, some in enumerate(families.values()):
            ratios = [max(one.ratio, 1e-8) for one in some if one.ratio is not None]
            spots = [row + 0.3 * ((7 * k) % 11 - 5) / 5 for k in range(len(ratios))]
            axes.plot(ratios, spots, ".", ms=5, alpha=0.6, mew=0)
            count = Counter(one.outcome for one in some)
            wrong = count[Outcome.EXCLUDED] + count[Outcome.CRASHED]
            note = f"{count[Outcome.ENCLOSED]} of {len(some)} enclosed, {wrong} wrong"
            axes.annotate(note, (1.01, row), xycoords=("axes fraction", "data"), va="center")
        axes.axvline(1, color="0.6", lw=0.8, zorder=0)
        axes.set_xscale("log")
        axes.set_yticks(range(len(families)), list(families))
        axes.invert_yaxis()
        axes.set_xlabel(
            "width of the answer, by the least possible (below 1: more digits than asked)"
        )
        target = io.StringIO()
        figure.savefig(target, format="svg", metadata={"Date": None})
        plt.close(figure)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines()) + "\n"
