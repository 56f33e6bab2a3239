"""The relations of IEEE 1788 between nonempty intervals, for one number type or another.

Each is a comparison of endpoints, so it is exact, and it says what all or some of the numbers
inside do: the relation holds or it does not, and nothing is ever undecided about two sets.
"""

from __future__ import annotations

from enum import Enum
from typing import Any, Generic, TypeVar, cast

_Truth = TypeVar("_Truth")  # bool, or a mask of numpy


class Overlap(Enum):
    """How two nonempty intervals lie to each other: the 13 states of IEEE 1788, table 10.7."""

    BEFORE = "before"
    MEETS = "meets"
    OVERLAPS = "overlaps"
    STARTS = "starts"
    CONTAINED_BY = "contained by"
    FINISHES = "finishes"
    EQUALS = "equals"
    FINISHED_BY = "finished by"
    CONTAINS = "contains"
    STARTED_BY = "started by"
    OVERLAPPED_BY = "overlapped by"
    MET_BY = "met by"
    AFTER = "after"


class Relations(Generic[_Truth]):
    """Relations of X = [a, b] and Y = [c, d]; Y may also be an exact number, the interval [y, y].

    An Interval answers with a bool, an IntervalArray with a mask, element by element.
    """

    __slots__ = ()

    def _bounds(self, other: Any) -> tuple[Any, Any, Any, Any]:
        """Return a, b, c, d as things that <, <=, == order; TypeError for what is no interval."""
        raise NotImplementedError

    def equal(self, other: Any) -> _Truth:
        """X = Y as sets."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (a == c) & (b == d))

    def subset(self, other: Any) -> _Truth:
        """X lies in Y."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (c <= a) & (b <= d))

    def interior(self, other: Any) -> _Truth:
        """X lies in the interior of Y."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (c < a) & (b < d))

    def contains(self, other: Any) -> _Truth:
        """Y, an interval or an exact number, lies in X; the answer is exact."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (a <= c) & (d <= b))

    def disjoint(self, other: Any) -> _Truth:
        """No number lies in both."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (b < c) | (d < a))

    def less(self, other: Any) -> _Truth:
        """Every x has a y >= x and every y an x <= y."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (a <= c) & (b <= d))

    def strictly_less(self, other: Any) -> _Truth:
        """Every x has a y > x and every y an x < y."""
        a, b, c, d = self._bounds(other)
        return cast(_Truth, (a < c) & (b < d))

    def precedes(self, other: Any) -> _Truth:
        """Every x <= every y."""
        _, b, c, _ = self._bounds(other)
        return cast(_Truth, b <= c)

    def strictly_precedes(self, other: Any) -> _Truth:
        """Every x < every y."""
        _, b, c, _ = self._bounds(other)
        return cast(_Truth, b < c)

    # -- what is known of numbers x in X, y in Y -----------------------------------------------

    def certainly_less(self, other: Any) -> _Truth:
        """x < y for all x and y."""
        return self.strictly_precedes(other)

    def certainly_less_equal(self, other: Any) -> _Truth:
        """x <= y for all x and y."""
        return self.precedes(other)

    def possibly_less(self, other: Any) -> _Truth:
        """x < y for some x and y."""
        a, _, _, d = self._bounds(other)
        return cast(_Truth, a < d)

    def possibly_less_equal(self, other: Any) -> _Truth:
        """x <= y for some x and y."""
        a, _, _, d = self._bounds(other)
        return cast(_Truth, a <= d)

    def certainly_positive(self) -> _Truth:
        """x > 0 for all x."""
        a, _, zero, _ = self._bounds(0)
        return cast(_Truth, zero < a)

    def certainly_negative(self) -> _Truth:
        """x < 0 for all x."""
        _, b, zero, _ = self._bounds(0)
        return cast(_Truth, b < zero)

    def possibly_positive(self) -> _Truth:
        """x > 0 for some x."""
        _, b, zero, _ = self._bounds(0)
        return cast(_Truth, zero < b)

    def possibly_negative(self) -> _Truth:
        """x < 0 for some x."""
        a, _, zero, _ = self._bounds(0)
        return cast(_Truth, a < zero)

    def contains_zero(self) -> _Truth:
        """Zero lies in X."""
        a, b, zero, _ = self._bounds(0)
        return cast(_Truth, (a <= zero) & (zero <= b))

    def is_singleton(self) -> _Truth:
        """X is one number."""
        a, b, _, _ = self._bounds(0)
        return cast(_Truth, a == b)


_STATES = {  # by the signs of a - c and b - d
    (0, 0): Overlap.EQUALS,
    (0, -1): Overlap.STARTS,
    (0, 1): Overlap.STARTED_BY,
    (1, 0): Overlap.FINISHES,
    (-1, 0): Overlap.FINISHED_BY,
    (1, -1): Overlap.CONTAINED_BY,
    (-1, 1): Overlap.CONTAINS,
}


def overlap_state(a: Any, b: Any, c: Any, d: Any) -> Overlap:
    """Return the state of [a, b] and [c, d], a <= b and c <= d."""
    state = _STATES.get((_order(a, c), _order(b, d)))
    if state:
        return state
    if a < c:
        return (Overlap.BEFORE, Overlap.MEETS, Overlap.OVERLAPS)[1 + _order(b, c)]
    return (Overlap.OVERLAPPED_BY, Overlap.MET_BY, Overlap.AFTER)[1 + _order(a, d)]


def _order(x: Any, y: Any) -> int:
    return -1 if x < y else int(y < x)
