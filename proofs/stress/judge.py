"""The verdict on one case: does the answer contain the truth, and how wide is it?"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from enum import Enum
from fractions import Fraction
from statistics import median
from time import perf_counter
from typing import NamedTuple

from intervals import IntervalError
from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.witness import Impossible, NoImpact
from proofs.report.page import markdown_table
from proofs.shell.backstop import Overrun, within
from proofs.stress.cases import Case
from proofs.stress.truth import Ranges, Truth

_TURN_BITS = 800
_WIDEST = Fraction(10**300)


class Outcome(Enum):
    """What became of a case. Only the last two are failures."""

    ENCLOSED = "enclosed"
    POSSIBLE = "possible"  # a set of possible images, one of them true
    REFUSED = "refused"
    STOPPED = "stopped"  # it took too long
    MISSED = "missed"  # refused as without impact, or as impossible, but there is an impact
    UNJUDGED = "unjudged"  # answered, but the truth is out of reach
    EXCLUDED = "EXCLUDES THE TRUTH"
    CRASHED = "CRASHED"

    @property
    def failure(self) -> bool:
        """Whether the library is wrong here."""
        return self in (Outcome.EXCLUDED, Outcome.CRASHED)


class Judgement(NamedTuple):
    """What became of a case. seconds: for the library's answer, on the clock.

    width: of its widest bounds, by what they must at least be.
    """

    case: Case
    outcome: Outcome
    seconds: float
    reason: str = ""
    width: float | None = None


def judge(case: Case, kernel: Arithmetic, allowed: float = 1.0) -> Judgement:
    """Ask the library and the kernel, and compare."""
    began = perf_counter()
    try:
        with within(allowed, "VIRTUAL"):
            answer = case.ask()
    except Overrun:
        return Judgement(case, Outcome.STOPPED, allowed, "stopped: it took too long")
    except Exception as error:  # what is no refusal is a defect to be shown
        seconds, outcome = perf_counter() - began, Outcome.CRASHED
        if isinstance(error, (IntervalError, Impossible, OverflowError)):
            outcome = Outcome.REFUSED
        if isinstance(error, (NoImpact, Impossible)) and _has_impact(case, kernel):
            outcome = Outcome.MISSED
        return Judgement(case, outcome, seconds, f"{type(error).__name__}: {error}")
    seconds = perf_counter() - began
    truths = case.truths(kernel)
    alternatives = answer if isinstance(answer, list) else [answer]
    if wrong := _excluded(alternatives, truths, kernel):
        return Judgement(case, Outcome.EXCLUDED, seconds, wrong)
    if not any(truths):
        return Judgement(case, Outcome.UNJUDGED, seconds, "the truth is out of reach")
    if answer is alternatives:
        return Judgement(case, Outcome.POSSIBLE, seconds)
    width = max(_widths(case, alternatives[0], truths, kernel), default=None)
    return Judgement(case, Outcome.ENCLOSED, seconds, "", width)


def _has_impact(case: Case, kernel: Arithmetic) -> bool:
    return any(truth is not None and truth.bounds for truth in case.truths(kernel))


def _excluded(
    alternatives: list[Ranges], truths: Sequence[Truth | None], kernel: Arithmetic
) -> str:
    """Say what is wrong: some alternative must meet all the true values that it speaks of."""
    for number, truth in enumerate(truths):
        wrong = [truth and _wrong(said, truth, kernel) for said in alternatives]
        if all(wrong):
            return f"sample {number}: {wrong[0]}"
    return ""


def _wrong(said: Ranges, truth: Truth, kernel: Arithmetic) -> str:
    """Say which true values are outside what was said of them; nothing where all are inside."""
    if not truth.bounds:
        return f"there is no value: {truth.reason}"
    wrong = []
    for name, (low, high) in said.items():
        if name in truth.bounds:
            true = _beside(name, truth.bounds[name], (low, high), kernel)
            if true[1] < low or high < true[0]:
                ends = f"[{float(low):.17g}, {float(high):.17g}]"
                wrong.append(f"{name} {ends}, not {float(true[0]):.17g}")
    return "; ".join(wrong)


def _beside(name: str, true: Range, said: Range, kernel: Arithmetic) -> Range:
    """Shift a true phase by the whole turns that bring it next to what was said."""
    if name != "phase":
        return true
    with kernel.precision(_TURN_BITS):
        low, high = kernel.ends(kernel.pi() * 2)
    count = round((sum(said) - sum(true)) / 2 / low)
    return true[0] + min(count * low, count * high), true[1] + max(count * low, count * high)


def _widths(
    case: Case, answer: Ranges, truths: Sequence[Truth | None], kernel: Arithmetic
) -> Iterator[float]:
    """Yield the width of every quantity by the best possible; 1 where both are 0."""
    for name, said in answer.items():
        true = [truth.bounds[name] for truth in truths if truth and name in truth.bounds]
        if len(true) < len(truths):
            continue
        near = [_beside(name, true, said, kernel) for true in true]
        least = case.least((min(x[0] for x in near), max(x[1] for x in near)))
        width = said[1] - said[0]
        if least > 0:
            yield float(min(width / least, _WIDEST))
        elif width == 0:
            yield 1.0


SCHEMA = "impact-proofs.stress/1"
_OUTCOMES = {
    outcome.name if outcome.failure else outcome.name.lower(): outcome for outcome in Outcome
}
_HEADER = ("family", "cases", *_OUTCOMES, "width", "width max", "ms", "ms max")
_ABOUT = """\
Each case is an exact input at which programs fail; the answer of the library is compared
with a computation to 100 digits by another kernel. Width: of the widest bounds of an
answer, by the least possible (what the input's own width makes of the result, and the
digits asked for); median and largest. ms: on the clock. Possible: a set of possible
images, the true one among them. Refused: with the reason that the machine form gives.
Stopped: after a second of work. Missed: refused for want of an impact, or as impossible,
though there is one. Unjudged: the truth is out of reach."""


class Run(NamedTuple):
    """All judgements of one run, by family, and what it was asked for."""

    judgements: list[Judgement]
    seed: int
    kernel: str
    seconds: float

    @property
    def failures(self) -> list[Judgement]:
        """Return the cases on which the library is wrong."""
        return [each for each in self.judgements if each.outcome.failure]


def text(run: Run) -> str:
    """Return the table, the failures, and the line that the exit status stands for."""
    return "\n".join([_table(run), "", *_failures(run), _verdict(run)])


def markdown(run: Run, about: dict[str, str]) -> str:
    """Return the page. about: what each family is."""
    lines = ["# Stress", "", f"{_verdict(run)}. Seed {run.seed}.", "", _ABOUT, "", _table(run)]
    lines += ["", "## What each family is", ""]
    lines += [f"- {name}: {about[name]}" for name in _families(run)]
    if run.failures:
        lines += ["", "## Failures", "", *(f"- {line}" for line in _failures(run))]
    return "\n".join(lines) + "\n"


def machine_form(run: Run) -> str:
    """Return every case as JSON: its exact input and what became of it."""
    cases = [
        {
            **each.case.inputs(),
            "outcome": each.outcome.value,
            "ms": round(1000 * each.seconds, 3),
            "reason": each.reason,
            "width": each.width and float(f"{each.width:.4g}"),
        }
        for each in run.judgements
    ]
    data = {"schema": SCHEMA, "seed": run.seed, "kernel": run.kernel}
    data |= {"seconds": round(run.seconds, 2), "failures": len(run.failures), "cases": cases}
    return json.dumps(data, indent=1) + "\n"


def _families(run: Run) -> dict[str, list[Judgement]]:
    """Return the judgements on each family."""
    names = dict.fromkeys(each.case.family for each in run.judgements)
    return {name: [x for x in run.judgements if x.case.family == name] for name in names}


def _table(run: Run) -> str:
    rows = [_HEADER, *(_row(name, judged) for name, judged in _families(run).items())]
    return "\n".join(markdown_table(rows, numbers_from=1))


def _row(name: str, judged: Sequence[Judgement]) -> tuple[str, ...]:
    """Return the line of a family; widths and times are medians and largest."""
    count = Counter(each.outcome for each in judged)
    numbers = len(judged), *(count[outcome] for outcome in _OUTCOMES.values())
    row = [name, *map(str, numbers)]
    widths = [each.width for each in judged if each.width is not None]
    for values in (widths, [1000 * each.seconds for each in judged]):
        row += [f"{median(values):.2g}", f"{max(values):.2g}"] if values else ["-", "-"]
    return tuple(row)


def _verdict(run: Run) -> str:
    count = f"{len(run.judgements)} cases in {run.seconds:.0f} s, judged by {run.kernel}: "
    if not run.failures:
        return count + "no case excludes the truth"
    excluded = sum(each.outcome is Outcome.EXCLUDED for each in run.failures)
    return count + f"{excluded} EXCLUDE THE TRUTH, {len(run.failures) - excluded} crash"


def _failures(run: Run) -> Iterator[str]:
    for each in run.failures:
        family, *given = (f"{name} = {value}" for name, value in each.case.inputs().items())
        yield f"{each.outcome.value}: {family}: {each.reason}; input {', '.join(given)}"
