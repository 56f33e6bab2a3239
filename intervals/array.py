"""IntervalArray: many closed bounded intervals of reals in binary64, vectorised."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from intervals.elementary import binary64
from intervals.rounding import Rows, bounded, outward_sum
from intervals.rows import (
    aligned,
    elementwise,
    exact_rows,
    float_rows,
    magnitude,
    power,
    product,
    quotient,
    scalar_rows,
    square_root,
)

if TYPE_CHECKING:
    from intervals.interval import Interval

Mask = NDArray[np.bool_]
Operand: TypeAlias = "IntervalArray | Interval | Fraction | int"


class IntervalArray:
    """An array of sets {x real : inf <= x <= sup}, with finite binary64 `inf <= sup` elementwise.

    `IntervalArray(values)` is `from_exact`; binary64 numbers enter through `from_floats`. Shapes
    broadcast as in numpy. The other operand may be an IntervalArray, an int, a Fraction or an
    Interval (enclosed as tightly as binary64 allows); a float raises TypeError. Every operation
    returns elementwise a superset of {op(x, y) : x in X, y in Y} (the inclusion principle); where
    a bound would leave the range of binary64 it raises OverflowError. An array does not change
    after it is made.
    """

    __slots__ = ("_rows",)
    __array_ufunc__ = None  # numpy leaves the operators to this class
    _rows: Rows  # (-inf, sup), shape (2, *shape): both rows are rounded upward

    def __init__(self, values: Any) -> None:
        self._rows = exact_rows(values)

    @classmethod
    def from_exact(cls, values: Any) -> IntervalArray:
        """Return the tightest binary64 enclosures of exact numbers, the same as the constructor.

        A list (or a range, or an array of ints) is an axis. An element is an int, a Fraction, a
        string such as "0.1" or "7/5", an Interval, or a tuple (lower, upper) of these. A float
        raises TypeError, a reversed pair or ragged lists ValueError. Ints up to 2^53 are exact.
        """
        return cls(values)

    @classmethod
    def from_floats(cls, lower: ArrayLike, upper: ArrayLike | None = None) -> IntervalArray:
        """Take binary64 numbers as they are: [lower, upper], or the points [lower, lower].

        Shapes broadcast. NaN, inf, lower > upper, and ints that binary64 does not hold raise
        ValueError; what is not a number (a string) raises TypeError.
        """
        return _make(float_rows(lower, lower if upper is None else upper))

    @staticmethod
    def concatenate(arrays: Sequence[IntervalArray], axis: int = 0) -> IntervalArray:
        """Join arrays of at least one axis along the element axis `axis`, as numpy does."""
        return _make(np.concatenate([x._rows for x in arrays], axis + 1 if axis >= 0 else axis))

    # -- the sets ------------------------------------------------------------------------------

    @property
    def inf(self) -> Rows:
        """The lower endpoints."""
        return np.asarray(0.0 - self._rows[0])

    @property
    def sup(self) -> Rows:
        """The upper endpoints."""
        return self._rows[1, ...].copy()

    @property
    def mid(self) -> Rows:
        """Binary64 numbers in the intervals, the midpoints up to rounding."""
        return np.asarray(np.clip(0.5 * self.inf + 0.5 * self.sup, self.inf, self.sup))

    @property
    def wid(self) -> Rows:
        """Upper bounds of the widths; 0 for points."""
        with _quiet():
            return outward_sum(np.asarray(self._rows[0] + self._rows[1]))

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

    def __len__(self) -> int:
        return len(self._rows[1, ...])

    def __getitem__(self, index: Any) -> IntervalArray:
        """Select intervals, by any index that numpy knows, on the element axes."""
        if isinstance(index, slice):
            return _make(self._rows[:, index])
        return _make(np.stack((self._rows[0][index], self._rows[1][index])))

    def reshape(self, *shape: int) -> IntervalArray:
        """Return the same intervals in another shape."""
        return _make(self._rows.reshape(2, *shape))

    def hull(self, other: Operand) -> IntervalArray:
        """Return the smallest intervals that hold both."""
        return _make(np.maximum(*self._pair(other)))

    def intersection(self, other: Operand) -> IntervalArray:
        """Return the common parts; ValueError if any is empty."""
        rows = np.minimum(*self._pair(other))
        if not (-rows[0] <= rows[1]).all():
            raise ValueError("an intersection is empty")
        return _make(rows)

    # -- masks: True only where a comparison of bounds holds, so that NaN decides nothing --------

    def subset(self, other: Operand) -> Mask:
        """Where every number of this interval is in the other."""
        a, b = self._pair(other)
        return np.asarray((a[0] <= b[0]) & (a[1] <= b[1]))

    def contains(self, other: Operand) -> Mask:
        """Where the other interval, or the exact number, is in this one; the answer is exact.

        An exact x is in [a, b], a and b in binary64, if and only if its tightest enclosure is.
        """
        b, a = self._pair(other)
        return np.asarray((a[0] <= b[0]) & (a[1] <= b[1]))

    def certainly_positive(self) -> Mask:
        """Where x > 0 for every x of the interval."""
        return np.asarray(self._rows[0] < 0.0)

    def certainly_negative(self) -> Mask:
        """Where x < 0 for every x of the interval."""
        return np.asarray(self._rows[1] < 0.0)

    def certainly_less(self, other: Operand) -> Mask:
        """Where x < y for every x of this interval and every y of the other."""
        a, b = self._pair(other)
        return np.asarray(a[1] < -b[0])

    def __eq__(self, other: object) -> Any:
        """Return where two IntervalArrays are equal as sets: a mask, as numpy's ==."""
        if not isinstance(other, IntervalArray):
            raise TypeError("an IntervalArray equals IntervalArrays only: use contains or subset")
        a, b = self._pair(other)
        return np.asarray((a[0] == b[0]) & (a[1] == b[1]))

    def __hash__(self) -> NoReturn:
        raise TypeError("an IntervalArray has no hash")

    def _unordered(self, other: object) -> NoReturn:
        raise TypeError("intervals may overlap: use certainly_less, _positive, _negative")

    __lt__ = __le__ = __gt__ = __ge__ = _unordered

    def __bool__(self) -> NoReturn:
        raise TypeError("the truth of an IntervalArray is not defined: use a mask, .all(), .any()")

    # -- arithmetic ----------------------------------------------------------------------------

    def _pair(self, other: Operand) -> tuple[Rows, Rows]:
        """Return the rows of both with their element axes aligned; TypeError if there are none."""
        rows = _rows_of(other)
        if rows is None:
            raise TypeError(f"not an interval or an exact number: {other!r}")
        return aligned(self._rows, rows)

    def __pos__(self) -> IntervalArray:
        return self

    def __neg__(self) -> IntervalArray:
        return _make(self._rows[::-1])

    def __abs__(self) -> IntervalArray:
        return _make(magnitude(self._rows))

    def __add__(self, other: Operand) -> IntervalArray:
        rows = _rows_of(other)
        if rows is None:
            return NotImplemented
        with _quiet():
            return _make(outward_sum(np.add(*aligned(self._rows, rows))))

    __radd__ = __add__

    def __sub__(self, other: Operand) -> IntervalArray:
        rows = _rows_of(other)
        return NotImplemented if rows is None else self + _make(rows[::-1])

    def __rsub__(self, other: Operand) -> IntervalArray:
        return -self + other

    def __mul__(self, other: Operand) -> IntervalArray:
        """Return the products; those by the ints 0 and +-2^k are exact."""
        if isinstance(other, int) and abs(other) & (abs(other) - 1) == 0:
            if other == 1:
                return self
            rows = self._rows if other >= 0 else self._rows[::-1]
            with _quiet():
                return _make(bounded(rows * float(abs(other))))
        factor = _rows_of(other)
        if factor is None:
            return NotImplemented
        with _quiet():
            return _make(product(*aligned(self._rows, factor)))

    __rmul__ = __mul__

    def __truediv__(self, other: Operand) -> IntervalArray:
        """Return the quotients; DomainError if a divisor contains 0."""
        divisor = _rows_of(other)
        if divisor is None:
            return NotImplemented
        with _quiet():
            return _make(quotient(*aligned(self._rows, divisor)))

    def __rtruediv__(self, other: Operand) -> IntervalArray:
        dividend = _rows_of(other)
        return NotImplemented if dividend is None else _make(dividend) / self

    def __pow__(self, n: int) -> IntervalArray:
        """Return the n-th powers, without the dependency of x * x."""
        if n < 0:
            return 1 / self**-n
        if n < 2:
            return self if n else self * 0 + 1
        with _quiet():
            return _make(power(self._rows, n))

    def sqr(self) -> IntervalArray:
        """Return the squares: within [0, oo), without the dependency of x * x."""
        return self**2

    # -- elementary functions ------------------------------------------------------------------

    def sqrt(self) -> IntervalArray:
        """Return the square roots; DomainError if an interval reaches below 0."""
        with _quiet():
            return _make(square_root(self._rows))

    def sincos(self) -> tuple[IntervalArray, IntervalArray]:
        """Return (sin X, cos X), within [-1, 1], from one reduction: see `elementary.binary64`."""
        with _quiet():
            sin, cos = binary64.sincos(self._rows)
        return _make(sin), _make(cos)

    def sin(self) -> IntervalArray:
        """Return sin X."""
        return self.sincos()[0]

    def cos(self) -> IntervalArray:
        """Return cos X."""
        return self.sincos()[1]

    def exp(self) -> IntervalArray:
        """Return exp X, tight to an ulp or two: element by element in multiprecision, so slow."""
        return _make(elementwise(self._rows, lambda x: x.exp()))

    def log(self) -> IntervalArray:
        """Return log X, likewise; DomainError if an interval reaches 0 or below."""
        return _make(elementwise(self._rows, lambda x: x.log()))

    def __repr__(self) -> str:
        bounds = np.stack((self.inf, self.sup), axis=-1)
        text = np.array2string(bounds, floatmode="unique", separator=", ", threshold=40)
        return f"<IntervalArray {self.shape}: (inf, sup) =\n{text}>"


def _make(rows: Rows) -> IntervalArray:
    """Return the IntervalArray of these rows, which nobody changes from now on."""
    new = object.__new__(IntervalArray)
    new._rows = rows
    return new


def _quiet() -> np.errstate:
    """Silence numpy's warnings: a bound that overflows is refused by `bounded`."""
    return np.errstate(all="ignore")


def _rows_of(value: object) -> Rows | None:
    """Return the rows of an operand, None for what is none; a float raises TypeError."""
    return value._rows if isinstance(value, IntervalArray) else scalar_rows(value)
