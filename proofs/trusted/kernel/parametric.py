"""Maps whose parameters have ranges: values and derivatives by these."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol, Self, runtime_checkable

from proofs.trusted.kernel.arithmetic import Enclosure, rational
from proofs.trusted.kernel.enclose import (
    Box,
    Differentiable,
    Matrix,
    add,
    centre_of,
    enclosed,
    multiply,
)


@runtime_checkable
class Parametric(Protocol):
    """A map F(x, p) for all p in a box, the product of `ranges`."""

    @property
    def ranges(self) -> Box: ...
    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]: ...
    def jacobian(self, x: Sequence[Enclosure]) -> Matrix: ...
    def pinned(self) -> Self:
        """Return the map at the middle of the ranges."""

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivatives by the parameters, for all x in a box and all parameters."""


def ranges_of(map_: Differentiable) -> Box:
    """Return the ranges of a map's parameters; none where it has no derivatives by these."""
    return map_.ranges if isinstance(map_, Parametric) else ()


class Moved(NamedTuple):
    """What encloses F(x, p), for all p: F(x, q), q in the middle, derivatives by p, and p - q."""

    values: list[Enclosure]
    slopes: Matrix
    steps: list[Enclosure]

    def combined(self, row: Sequence[Enclosure]) -> Enclosure:
        """Enclose row . F(x, p) (mean value theorem, for this combination of the values)."""
        columns = zip(*self.slopes, strict=True)
        slopes = [add(row[0] * 0, row, column) for column in columns]
        return add(add(row[0] * 0, row, self.values), slopes, self.steps)


def moved(map_: Differentiable, x: Sequence[Enclosure]) -> Moved:
    """Enclose the values on a box, parts by parts; for a map without ranges they are all."""
    ranges, bits = ranges_of(map_), x[0].bits
    if not ranges or not isinstance(map_, Parametric):
        return Moved(map_.values(x), [], [])
    sides = zip(enclosed(ranges, bits), centre_of(ranges), strict=True)
    steps = [side - rational(q, bits) for side, q in sides]
    return Moved(map_.pinned().values(x), map_.sensitivity(x), steps)


def chained(maps: Sequence[Parametric], x: Sequence[Enclosure], *, shared: bool) -> Matrix:
    """Enclose the derivatives of maps one after the other by their parameters (chain rule).

    shared: whether the parameters are those of all maps, else each has columns of its own.
    """
    point, rows = list(x), list[list[Enclosure]]()
    for each in maps:
        own = each.sensitivity(point)
        if rows:
            before = multiply(each.jacobian(point), rows)
            pairs = zip(before, own, strict=True)
            if shared:
                own = [[a + b for a, b in zip(*pair, strict=True)] for pair in pairs]
            else:
                own = [[*a, *b] for a, b in pairs]
        rows, point = own, each.values(point)
    return rows
