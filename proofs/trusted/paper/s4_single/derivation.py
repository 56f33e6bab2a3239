"""How the claims of section 4 about formulas are decided, until they are rows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.formulas import Asked, Lemma, Value
from proofs.trusted.parameters import Parameters


@dataclass(frozen=True)
class Derivation:
    """A claim that follows from lemmas and from values.

    decision: what follows, given bounds on the values in their order.
    """

    id: str
    text: str
    lemmas: tuple[Lemma, ...]
    decision: Callable[..., Decision]
    values: tuple[Asked, ...] = ()

    def decide(self, of: Parameters, found: Sequence[object]) -> Decision:
        """Decide the claim: UNDECIDED if something that it follows from is not proved."""
        missing: list[Lemma | Asked] = [lemma for lemma in self.lemmas if lemma not in found]
        bounds = []
        for value in self.values:
            proved = [one.bounds for one in found if isinstance(one, Value) and value.met_by(one)]
            bounds.append(min(proved, key=lambda ends: ends[1] - ends[0]) if proved else None)
            if not proved:
                missing.append(value)
        if missing:
            count = f"{len(missing)} of {len(self.lemmas) + len(self.values)}"
            return undecided(f"not proved: {count} of what it follows from")
        return self.decision(*bounds)

    @property
    def claim(self) -> Claim:
        """The claim, as the catalogue has it."""
        return Claim(self.id, self.text, self.decide)
