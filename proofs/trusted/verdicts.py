"""Verdicts, and how rows of the catalogue are decided by conclusions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from itertools import groupby
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, floor_text
from proofs.trusted.parameters import Parameters, Place

C = TypeVar("C", bound=Conclusion)


class Verdict(Enum):
    """The outcome of a claim.

    Proved as printed; proved false; proved under conditions that the paper leaves out; neither;
    or no mathematics but an observation, reproduced by simulation.
    """

    VERIFIED = "VERIFIED"
    REFUTED = "REFUTED"
    CONDITIONAL = "CONDITIONAL"
    UNDECIDED = "UNDECIDED"
    SIMULATED = "SIMULATED"


def tally(verdicts: Iterable[tuple[Verdict, bool]]) -> str:
    """Count verdicts, in words: those on the paper's claims, and on the project's own (True)."""
    counts = Counter(verdicts)
    paper, own = (
        ", ".join(f"{counts[each, own]} {each.value}" for each in Verdict if counts[each, own])
        for own in (False, True)
    )
    return "; ".join(filter(None, (paper, own and f"of our own {own}")))


def told(conclusions: Iterable[Conclusion]) -> str:
    """Return conclusions as a text: their sentences, each after the parameters that it is about."""
    parts: list[str] = []
    for at, group in groupby(dict.fromkeys(conclusions), key=lambda each: each.place):
        first, *more = (each.sentence for each in group)
        start = f"At {at}: {first}" if at is not None else _begun(first)
        parts += [start, *map(_begun, more)]
    return " ".join(parts)


def _begun(sentence: str) -> str:
    """Begin a sentence with a capital letter, unless its first word is a symbol, such as f."""
    word = sentence.split(" ", 1)[0].rstrip(",:")
    return sentence[:1].upper() + sentence[1:] if len(word) > 1 and word.isalpha() else sentence


class Decision(NamedTuple):
    """What conclusions make of a claim.

    because: those that verify, refute or condition it. corrected: the strongest true statements
    nearby. margin: by how much the bound that the claim asks for holds. missing: what is not
    proved, where nothing is decided. of: the numbers of the claim.
    """

    verdict: Verdict
    because: tuple[Conclusion, ...] = ()
    corrected: tuple[Conclusion, ...] = ()
    margin: Fraction | None = None
    missing: str = ""
    quantities: Mapping[str, Range] = {}
    of: Parameters | None = None

    @property
    def why(self) -> str:
        """A line with the numbers; of witnesses at other oscillators it says which."""
        reasons = []
        for each in dict.fromkeys(self.because):
            at, brief = each.place, each.brief.rstrip(".")
            here = at is None or self.of is None or at.holds(self.of)
            reasons.append(brief if here or str(at) in brief else f"at {at}: {brief}")
        spare = [] if self.margin is None else [f"{floor_text(self.margin)} to spare"]
        return self.missing or "; ".join([*reasons, *spare])

    @property
    def witness(self) -> str | None:
        """What refutes the claim, or the conditions that it needs."""
        told_by = (Verdict.REFUTED, Verdict.CONDITIONAL)
        return told(self.because) if self.verdict in told_by else None

    @property
    def theorem(self) -> str | None:
        """The strongest true statement nearby, complete; None where there is nothing to add."""
        return told(self.corrected) if self.corrected else None


def decided(
    verdict: Verdict,
    *because: Conclusion,
    corrected: Iterable[Conclusion] = (),
    margin: Fraction | None = None,
    known: Mapping[str, Range] = MappingProxyType({}),
) -> Decision:
    """Return a decision that rests on conclusions, with the enclosures that these report."""
    beside = tuple(corrected)
    quantities = {name: x for each in (*because, *beside) for name, x in each.quantities.items()}
    return Decision(verdict, because, beside, margin, quantities={**quantities, **known})


def undecided(missing: str, known: Mapping[str, Range] = MappingProxyType({})) -> Decision:
    """Return that nothing is decided, what is missing, and what is known all the same."""
    return Decision(Verdict.UNDECIDED, missing=missing, quantities={**known})


class Found:
    """The conclusions that a claim is decided by, matched with its parameters here, and only here.

    here: about the claim's own oscillator, or about none; everywhere: witnesses at other ones, too.
    What is about a map of the file decides nothing.
    """

    def __init__(self, of: Parameters, conclusions: Iterable[Conclusion]) -> None:
        self.everywhere = tuple(x for x in conclusions if not x.is_foreign)
        self.here = tuple(x for x in self.everywhere if x.place is None or x.place.holds(of))

    def all(self, kind: type[C]) -> list[C]:
        """Return the conclusions of a kind about the claim's own oscillator, in their order."""
        return [each for each in self.here if isinstance(each, kind)]

    def first(self, kind: type[C]) -> C | None:
        """Return the first of them, None if there is none."""
        return next(iter(self.all(kind)), None)

    def elsewhere(self, kind: type[C]) -> list[C]:
        """Return the conclusions of a kind, whatever oscillator they are about."""
        return [each for each in self.everywhere if isinstance(each, kind)]


Decide = Callable[[Parameters, Found], Decision]


@dataclass(frozen=True)
class Row:
    """A claim of the catalogue.

    where: section, equation, figure. words: the paper's own, a few; "" for a row of the project's.
    reading: ours, complete; {eta}, {nu}, {i} and so on are the numbers of the statement.
    printed_at: the oscillator at which alone its printed numbers are asked about; None: all.
    needs: what is to be proved about formulas, whatever the parameters.
    """

    id: str
    where: str
    words: str
    reading: str
    decide_by: Decide
    printed_at: Place | None = None
    needs: tuple[Any, ...] = ()

    @property
    def own(self) -> bool:
        """Whether the row is the project's, not the paper's."""
        return not self.words

    def says(self, of: Parameters) -> str:
        """Return the claim in words at the given numbers."""
        return of.fill(self.reading)

    def is_asked(self, of: Parameters) -> bool:
        """Whether the claim is asked about these numbers."""
        return self.printed_at is None or self.printed_at.holds(of)

    def decide(self, of: Parameters, conclusions: Sequence[Conclusion]) -> Decision:
        """Decide the claim by what is proved; where it is not asked, tell what is true instead."""
        try:
            decision = self.decide_by(of, Found(of, conclusions))._replace(of=of)
        except Unproved as failure:  # a hypothesis of a theorem
            return undecided(str(failure))
        if self.own and decision.verdict is Verdict.VERIFIED and not decision.corrected:
            decision = decision._replace(corrected=decision.because)  # its answer is the theorem
        if self.is_asked(of):
            return decision
        missing = f"the printed numbers are about {self.printed_at}: not asked here"
        return decision._replace(
            verdict=Verdict.UNDECIDED, because=(), margin=None, missing=missing
        )
