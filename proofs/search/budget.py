"""How much is looked at by the searches beyond the paper."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from fractions import Fraction
from time import monotonic

from intervals import Undecided

EFFORT = 3
FASTEST = 100  # the greatest eta for which flights are followed: their work grows with it
_FARTHEST = 200.0  # the longest flight, if eta <= _SLOW
_SLOW = 3


def reach(eta: Fraction) -> float:
    """Return how long flights are followed: shorter where the mass swings fast, for the work."""
    return _FARTHEST * min(1.0, float(_SLOW / eta))


class Budget:
    """How much is looked at: the same on every machine, unless it is stopped after some seconds.

    effort: from 1 to 5; each doubles the phases on the circle (`grid`), orbits (`starts`), their
    impacts, the longest flight among them (`farthest`) and the sets that are tried.
    """

    def __init__(
        self, eta: Fraction, effort: int = EFFORT, seconds: float | Fraction = math.inf
    ) -> None:
        share, self._seconds = 2.0 ** (effort - EFFORT), float(seconds)
        self.grid, self.starts, self.impacts = int(3000 * share), int(48 * share), int(400 * share)
        self.tries, self.farthest = int(8 * share), 2 * share * reach(eta)
        self._until = monotonic() + self._seconds

    def check(self) -> None:
        """Raise Undecided once the time is over."""
        if monotonic() > self._until:
            raise Undecided(f"stopped after {self._seconds:g} seconds, as asked")

    @contextmanager
    def attempt(self, undone: Callable[[], AbstractContextManager[None]]) -> Iterator[None]:
        """One search within the budget: nothing is left of it if it fails."""
        with undone():
            self.check()
            yield
