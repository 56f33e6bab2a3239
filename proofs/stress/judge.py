"""The verdict on one case: does the answer contain the truth, and how wide is it?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from time import perf_counter

from intervals import IntervalError
from proofs.motion.impact import NoImpact
from proofs.motion.rebound import Impossible
from proofs.stress.cases import Answer, Case, Ranges, Truth, inputs
from proofs.stress.kernels import Kernel
from proofs.stress.limit import TookTooLong, limited
from proofs.trusted.numbers import Range

_TURN_BITS = 800


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

    ratio: the width of the widest bounds, by what it must at least be; ratios: of all.
    """

    family: str
    outcome: Outcome
    seconds: float
    inputs: dict[str, str]
    reason: str = ""
    ratio: float | None = None
    bits: int | None = None
    ratios: dict[str, float] = field(default_factory=dict)


def judge(case: Case, kernel: Kernel, allowed: float = 1.0) -> Judgement:
    """Ask the library and the kernel, and compare."""
    began = perf_counter()
    try:
        with limited(allowed):
            answer = case.answer()
    except TookTooLong:
        reason = "stopped: it took too long"
        return Judgement(case.family, Outcome.STOPPED, allowed, inputs(case), reason)
    except (IntervalError, Impossible, OverflowError) as refusal:
        seconds, outcome = perf_counter() - began, Outcome.REFUSED
        if isinstance(refusal, (NoImpact, Impossible)) and _has_impact(case, kernel):
            outcome = Outcome.MISSED
        reason = f"{type(refusal).__name__}: {refusal}"
        return Judgement(case.family, outcome, seconds, inputs(case), reason)
    except Exception as crash:  # whatever else the library raises is a defect to be shown
        seconds = perf_counter() - began
        reason = f"{type(crash).__name__}: {crash}"
        return Judgement(case.family, Outcome.CRASHED, seconds, inputs(case), reason)
    seconds = perf_counter() - began
    truths = case.truths(kernel)
    outcome, reason = _contained(answer, truths, kernel)
    ratios = _ratios(case, answer, truths, kernel) if outcome is Outcome.ENCLOSED else {}
    return Judgement(
        case.family, outcome, seconds, inputs(case), reason,
        max(ratios.values(), default=None),
        _bits(case, answer, allowed),
        ratios,
    )  # fmt: skip


def _bits(case: Case, answer: Answer, allowed: float) -> int | None:
    try:
        with limited(allowed):
            return answer.bits or case.bits()
    except TookTooLong:
        return None


def _has_impact(case: Case, kernel: Kernel) -> bool:
    return any(truth is not None and truth.known for truth in case.truths(kernel))


def _contained(
    answer: Answer, truths: Sequence[Truth | None], kernel: Kernel
) -> tuple[Outcome, str]:
    """Compare each sample: some alternative must meet all the true values that it speaks of."""
    judged = False
    for number, truth in enumerate(truths):
        if truth is None:
            continue
        judged = True
        alternatives = _of(answer, number)
        if not any(_meets(one, truth, kernel) for one in alternatives):
            return (
                Outcome.EXCLUDED,
                f"sample {number}: {_difference(alternatives[0], truth, kernel)}",
            )
    if not judged:
        return Outcome.UNJUDGED, "the truth is out of reach"
    return (Outcome.POSSIBLE if answer.possible else Outcome.ENCLOSED), ""


def _of(answer: Answer, number: int) -> tuple[Ranges, ...]:
    return answer.samples[min(number, len(answer.samples) - 1)]


def _meets(said: Ranges, truth: Truth, kernel: Kernel) -> bool:
    return bool(truth.known) and not _wrong(said, truth, kernel)


def _wrong(said: Ranges, truth: Truth, kernel: Kernel) -> dict[str, tuple[Range, Range]]:
    """Return the quantities whose true value is outside what was said, with both."""
    wrong = {}
    for name, (low, high) in said.items():
        if name in truth.known:
            true = _beside(name, truth.known[name], (low, high), kernel)
            if true[1] < low or high < true[0]:
                wrong[name] = (low, high), true
    return wrong


def _beside(name: str, true: Range, said: Range, kernel: Kernel) -> Range:
    """Shift a true phase by the whole turns that bring it next to what was said."""
    if name != "phase":
        return true
    low, high = _turn(kernel)
    count = round((sum(said) - sum(true)) / 2 / low)
    return (true[0] + min(count * low, count * high), true[1] + max(count * low, count * high))


def _turn(kernel: Kernel) -> Range:
    with kernel.digits(_TURN_BITS):
        return kernel.bounds(kernel.pi() * 2)


def _difference(said: Ranges, truth: Truth, kernel: Kernel) -> str:
    if not truth.known:
        return f"there is no value: {truth.reason}"
    return "; ".join(
        f"{name} [{float(low):.17g}, {float(high):.17g}], not {float(true[0]):.17g}"
        for name, ((low, high), true) in _wrong(said, truth, kernel).items()
    )


def _ratios(
    case: Case, answer: Answer, truths: Sequence[Truth | None], kernel: Kernel
) -> dict[str, float]:
    """Return the width of every quantity by the best possible; 1 where both are 0."""
    ratios = {}
    for name, said in answer.samples[0][0].items():
        near = [_beside(name, truth.known[name], said, kernel)
                for truth in truths if truth is not None and name in truth.known]  # fmt: skip
        if len(near) < len(truths):
            continue
        best = case.best(name, (min(x[0] for x in near), max(x[1] for x in near)))
        width = said[1] - said[0]
        if best > 0:
            ratios[name] = float(min(width / best, Fraction(10**300)))
        elif width == 0:
            ratios[name] = 1.0
    return ratios
