"""The shape of an array of intervals, and what selects and moves its elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NoReturn, Self, cast

import numpy as np

from intervals.rounding import Rows, joined


class Shaped:
    """An array of elements with rows of shape (2, *shape), under numpy's names."""

    __slots__ = ()
    _rows: Rows

    def _like(self, rows: Rows) -> Self:
        """Return the array of these rows."""
        raise NotImplementedError

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the array of intervals."""
        return self._rows.shape[1:]

    @property
    def ndim(self) -> int:
        """The number of element axes."""
        return self._rows.ndim - 1

    @property
    def size(self) -> int:
        """The number of intervals."""
        return self._rows.size // 2

    @property
    def T(self) -> Self:  # noqa: N802 - numpy's name
        """The transposed array."""
        return self._like(np.moveaxis(self._rows.T, -1, 0))

    def __len__(self) -> int:
        return len(self._rows[1, ...])

    def __iter__(self) -> Iterator[Self]:
        return (self[i] for i in range(len(self)))

    def __contains__(self, _value: object) -> NoReturn:
        raise TypeError("an IntervalArray is many sets: use contains or subset, which say which")

    def __getitem__(self, index: Any) -> Self:
        """Select intervals, by any index that numpy knows, on the element axes."""
        if isinstance(index, slice):
            return self._like(self._rows[:, index])
        return self._like(joined(self._rows[0][index], self._rows[1][index]))

    def reshape(self, *shape: int | Sequence[int]) -> Self:
        """Return the same intervals in another shape."""
        return self._like(self._rows.reshape(2, *_sizes(shape)))

    def flatten(self) -> Self:
        """Return the intervals along one axis."""
        return self.reshape(-1)

    def transpose(self, *axes: int | Sequence[int]) -> Self:
        """Return the array with its axes in another order, the opposite one if none is given."""
        order = _sizes(axes) or range(self.ndim)[::-1]
        return self._like(self._rows.transpose(0, *(i % self.ndim + 1 for i in order)))

    def copy(self) -> Self:
        """Return the array, which does not change."""
        return self

    @property
    def dtype(self) -> np.dtype[np.float64]:
        """The type of the endpoints."""
        return self._rows.dtype

    def dot(self, other: Any) -> Any:
        """Do as np.dot."""
        return np.dot(cast(Any, self), other)

    def mean(self, axis: Any = None, *, keepdims: bool = False) -> Any:
        """Return the means over some axes, or over all elements."""
        return np.mean(cast(Any, self), axis=axis, keepdims=keepdims)

    def max(self, axis: Any = None, *, keepdims: bool = False) -> Any:
        """Return the range of the largest element along some axes, or of all."""
        return np.max(cast(Any, self), axis=axis, keepdims=keepdims)

    def min(self, axis: Any = None, *, keepdims: bool = False) -> Any:
        """Return the range of the smallest element along some axes, or of all."""
        return np.min(cast(Any, self), axis=axis, keepdims=keepdims)


def _sizes(given: tuple[int | Sequence[int], ...]) -> Sequence[int]:
    """Return ints that were given one by one, or as one sequence."""
    first = given[0] if len(given) == 1 else given
    return (first,) if isinstance(first, int | np.integer) else cast("Sequence[int]", first)
