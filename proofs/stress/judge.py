"""The verdict on one case: does the answer contain the truth, and how wide is it?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from time import perf_counter

from intervals import IntervalError
from proofs.benchmark.peers import Arithmetic, Range
from proofs.motion.witness import Impossible, NoImpact
from proofs.shell.backstop import Overrun, within
from proofs.stress.cases import Case, Ranges, Truth

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


@dataclass(frozen=True)
class Judgement:
    """What became of a case. seconds: for the library's answer, on the clock.

    widths: of each of its bounds, by what it must at least be.
    """

    case: Case
    outcome: Outcome
    seconds: float
    reason: str = ""
    widths: dict[str, float] = field(default_factory=dict)

    @property
    def width(self) -> float | None:
        """That of the widest bounds."""
        return max(self.widths.values(), default=None)


def judge(case: Case, kernel: Arithmetic, allowed: float = 1.0) -> Judgement:
    """Ask the library and the kernel, and compare."""
    began = perf_counter()
    try:
        with within(allowed, "VIRTUAL"):
            answer = case.answer()
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
    widths = _widths(case, alternatives[0], truths, kernel)
    return Judgement(case, Outcome.ENCLOSED, seconds, "", widths)


def _has_impact(case: Case, kernel: Arithmetic) -> bool:
    return any(truth is not None and truth.known for truth in case.truths(kernel))


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
    if not truth.known:
        return f"there is no value: {truth.reason}"
    wrong = []
    for name, (low, high) in said.items():
        if name in truth.known:
            true = _beside(name, truth.known[name], (low, high), kernel)
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
) -> dict[str, float]:
    """Return the width of every quantity by the best possible; 1 where both are 0."""
    widths = {}
    for name, said in answer.items():
        known = [truth.known[name] for truth in truths if truth and name in truth.known]
        if len(known) < len(truths):
            continue
        near = [_beside(name, true, said, kernel) for true in known]
        best = case.best((min(x[0] for x in near), max(x[1] for x in near)))
        width = said[1] - said[0]
        if best > 0:
            widths[name] = float(min(width / best, _WIDEST))
        elif width == 0:
            widths[name] = 1.0
    return widths
