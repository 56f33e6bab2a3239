"""Work, counted where it happens: in the arithmetic and in the reader.

Whatever a rule does, its numbers come from a file and are computed with, so no rule can forget to
count. The unit is about half a microsecond, and 20 bytes where results are kept.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

DEFAULT = 10_000_000  # some seconds; every committed certificate takes less


class Exhausted(ArithmeticError):
    """A check would take more work than it was given."""


class Meter:
    """What is left of the work that one check may take."""

    __slots__ = ("left", "limit")

    def __init__(self, limit: float) -> None:
        self.left = self.limit = limit

    @property
    def spent(self) -> float:
        """The work so far."""
        return self.limit - self.left

    def spend(self, amount: float) -> None:
        """Count work; Exhausted where more is asked for than there is."""
        self.left -= amount
        if self.left < 0:
            raise Exhausted(f"it needs more work, --work {2 * self.limit:.0f}")


_UNLIMITED = Meter(float("inf"))
METER: ContextVar[Meter] = ContextVar("meter", default=_UNLIMITED)


@contextmanager
def metered(limit: float) -> Iterator[Meter]:
    """Give what is done inside so much work."""
    meter = Meter(limit)
    token = METER.set(meter)
    try:
        yield meter
    finally:
        METER.reset(token)
