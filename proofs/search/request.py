"""What a group of claims is asked for, as the searches take it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, NamedTuple

from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import Evidence, Steps, Tell
from proofs.search.steps import Prover
from proofs.trusted.parameters import Parameters


class Request(NamedTuple):
    """Claims of a group at some parameters, to so many digits; tell: is told of stages."""

    of: Parameters
    claims: Sequence[str]
    digits: int
    tell: Tell

    def asks(self, *claims: str) -> bool:
        """Whether one of these claims is asked for."""
        return not {*claims}.isdisjoint(self.claims)

    def prover(self, steps: Steps | None = None, least_digits: int = 0) -> Prover:
        """Return a prover at the parameters, with steps that there are."""
        system = System(self.of.eta, self.of.nu)
        return Prover(system, max(self.digits, least_digits), HORIZON, steps)


def proving(search: Callable[..., Evidence]) -> Callable[..., Evidence]:
    """Return the function by which a group is proved, as far as it goes: a search for a request."""

    @wraps(search)
    def prove(
        numbers: Parameters,
        claims: Sequence[str],
        *,
        digits: int = 30,
        tell: Tell = lambda stage: None,
        **options: Any,
    ) -> Evidence:
        return search(Request(numbers, claims, digits, tell), **options)

    return prove
