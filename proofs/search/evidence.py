"""What a prover found."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from typing import Any

from intervals import DomainError, Undecided
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.parameters import Place

Tell = Callable[[str], None]
Proof = list[tuple[str, Conclusion]]  # steps, each with what it proves
Steps = dict[str, dict[str, Any]]
Proved = tuple[Place, Steps, list[str]]  # oscillators, steps, and those that are claimed
# What a proof that does not succeed raises; Malformed: what floats saw is no witness of a rule.
FAILED = (Undecided, DomainError, Unproved, Malformed)


@dataclass
class Evidence:
    """What a prover found: its steps in order, and for each claim the steps that it rests on.

    Each of these comes with the conclusion that the prover reached, by arithmetic of its own or,
    where floats found the witness, by the checker's rule. notes: why more was not proved, or what
    was simulated.
    """

    steps: dict[str, dict[str, Any]] = field(default_factory=dict)
    proofs: dict[str, Proof] = field(default_factory=dict)
    notes: dict[str, str] = field(default_factory=dict)


def search_each(
    evidence: Evidence,
    claims: Iterable[str],
    searches: Mapping[str, tuple[str, Callable[..., Proof]]],
    tell: Tell,
    *about: Any,
    within: Callable[[], AbstractContextManager[object]] = nullcontext,
) -> Evidence:
    """Search for what each claim rests on, within a context of its own; note what fails.

    searches: what is told of a claim, and the function that proves steps, given what it is about.
    """
    for claim in claims:
        if claim not in searches:
            continue
        stage, search = searches[claim]
        tell(stage)
        try:
            with within():
                evidence.proofs[claim] = search(*about)
        except FAILED as failure:
            evidence.notes[claim] = str(failure)
    return evidence
