"""Work, counted where it happens: in the arithmetic and in the reader.

Whatever a rule does, its numbers come from a file and are computed with, so no rule can forget to
count. The unit is up to a microsecond, and 20 bytes where results are kept.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

DEFAULT = 8_000_000  # some eight seconds; one committed certificate takes more


class Exhausted(ArithmeticError):
    """A check would take more work than it was given."""


class Meter:
    """The work that one check may take: part of a larger one, there may be less left of that."""

    __slots__ = ("limit", "most", "spent")

    def __init__(self, limit: int, left: int) -> None:
        self.limit, self.most, self.spent = limit, min(limit, left), 0

    def spend(self, amount: int) -> None:
        """Count work; Exhausted where more is asked for than there is."""
        self.spent += amount
        if self.spent > self.most:
            raise Exhausted(f"it needs more work, --work {2 * self.limit}")


_UNLIMITED = Meter(10**30, 10**30)
METER: ContextVar[Meter] = ContextVar("meter", default=_UNLIMITED)


@contextmanager
def metered(limit: int) -> Iterator[Meter]:
    """Give what is done inside so much work, which is part of what is done around it."""
    outer = METER.get()
    meter = Meter(limit, outer.most - outer.spent)
    token = METER.set(meter)
    try:
        yield meter
    finally:
        METER.reset(token)
        outer.spent += meter.spent
