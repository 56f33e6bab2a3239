"""Adaptive subdivision that provably covers."""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import TypeVar

from intervals.errors import Undecided


class PartsExhausted(Undecided):
    """A cover was not finished within its limit."""


_Part = TypeVar("_Part")
_Answer = TypeVar("_Answer")


def cover(
    parts: Iterable[_Part],
    decide: Callable[[_Part], _Answer | None],
    split: Callable[[_Part], Iterable[_Part]],
    *,
    limit: int = 10_000,
) -> Iterator[tuple[_Part, _Answer]]:
    """Yield (part, answer) until the given parts are used up, in their order.

    Hypothesis: the union of split(part) contains the part. Conclusion: the union of what was
    yielded contains the union of `parts`, and `decide` answered each. A part that it does not
    answer (None) is split; after `limit` decisions PartsExhausted names the part at hand,
    so an incomplete cover is never taken for a cover.
    """
    waiting = list(parts)[::-1]
    for _ in range(limit):
        if not waiting:
            return
        part = waiting.pop()
        answer = decide(part)
        if answer is None:
            pieces = list(split(part))
            if not pieces:
                raise ValueError(f"split returned nothing for {part}")
            waiting.extend(pieces[::-1])
        else:
            yield part, answer
    if waiting:
        raise PartsExhausted(f"{limit} parts do not suffice; the next one is {waiting[-1]}")


def halves(
    part: tuple[Fraction, Fraction],
) -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
    """Cut an interval in the middle."""
    middle = (part[0] + part[1]) / 2
    return (part[0], middle), (middle, part[1])
