"""IntervalArray: many closed bounded intervals of reals in binary64, vectorised."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from fractions import Fraction
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from intervals import display, numpy_protocol, tight
from intervals.elementary import binary64
from intervals.elementary.binary64.pair import bounds, least_bounds
from intervals.entry import ends, exact_rows, float_rows, scalar_rows
from intervals.errors import DomainError
from intervals.exact import Exact, fraction, whole
from intervals.functions import DOMAINS, Domain, Elementary
from intervals.relations import Relations, overlap_state
from intervals.rounding import (
    MAX,
    Rows,
    all_of,
    extended,
    joined,
    outward_sum,
    require_subnormals,
)
from intervals.rows import (
    STEPS,
    aligned,
    in_blocks,
    magnitude,
    power,
    product,
    quotient,
    square_root,
    total,
)
from intervals.shapes import Shaped
from intervals.tight import Operation, matrix_product, pairwise

if TYPE_CHECKING:
    from intervals.interval import Interval

_A = TypeVar("_A", bound="IntervalArray")
Mask = NDArray[np.bool_]
Operand: TypeAlias = "IntervalArray | Interval | Fraction | int"

# glibc hands each freed temporary back to the system, and asks for its pages again, until it has
# seen a large array freed: that made the functions here three times slower. No page is touched.
np.empty(4_000_000)


class IntervalArray(Shaped, Relations[Mask], Elementary):
    """An array of sets {x real : inf <= x <= sup}, inf <= sup in binary64 or infinite.

    `IntervalArray(values)` is `from_exact`; binary64 numbers enter through `from_floats`. Shapes
    broadcast as in numpy, whose own functions know the class (np.sin(X), np.concatenate, X @ Y).
    The other operand may be an IntervalArray, an int, an array of ints, a Fraction or an Interval
    (enclosed as tightly as binary64 allows); a float raises TypeError. Every operation returns
    elementwise a superset of {op(x, y) : x in X, y in Y} (the inclusion principle); a bound that
    would leave the range of binary64 is infinite. An array does not change after it is made.
    """

    __slots__ = ("_rows",)
    _rows: Rows  # (-inf, sup), shape (2, *shape): both rows are rounded upward
    _total, _product = staticmethod(total), staticmethod(product)
    _quotient, _power = staticmethod(quotient), staticmethod(power)
    _ieee: ClassVar = {**STEPS, "sqrt": square_root}  # what the processor rounds correctly
    _rounded = staticmethod(bounds)  # bounds of what a kernel encloses

    def __init__(self, values: Any) -> None:
        require_subnormals()
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
        return cls._of_rows(float_rows(lower, lower if upper is None else upper))

    @staticmethod
    def concatenate(arrays: Sequence[IntervalArray], axis: int = 0) -> IntervalArray:
        """Join arrays along an element axis: np.concatenate, with its type."""
        joined: Any = np.concatenate(arrays, axis)
        return cast("IntervalArray", joined)

    @classmethod
    def _of_rows(cls, rows: Rows) -> Self:
        return _make(rows, cls)

    def _like(self, rows: Rows) -> Self:
        return _make(rows, type(self))

    # -- the sets ------------------------------------------------------------------------------

    @property
    def inf(self) -> Rows:
        """The lower endpoints."""
        require_subnormals()
        return np.asarray(0.0 - self._rows[0])

    @property
    def sup(self) -> Rows:
        """The upper endpoints."""
        return self._rows[1, ...].copy()

    @property
    def mid(self) -> Rows:
        """Binary64 numbers in the intervals, the midpoints up to rounding.

        Of what is not bounded 0, or the largest number that is on its side.
        """
        low, high = self.inf, self.sup
        with _quiet():
            middle = 0.5 * low + 0.5 * high
        if not np.isfinite(middle).all():
            middle = np.clip(np.where(np.isnan(middle), 0.0, middle), -MAX, MAX)
        return np.asarray(np.clip(middle, low, high))

    @property
    def wid(self) -> Rows:
        """Upper bounds of the widths; 0 for points."""
        with _quiet():
            return outward_sum(np.asarray(self._rows[0] + self._rows[1]))

    @property
    def rad(self) -> Rows:
        """Upper bounds of |x - mid| for x in the intervals."""
        middle = self.mid
        with _quiet():
            return outward_sum(np.maximum(self._rows[0] + middle, self._rows[1] - middle))

    @property
    def mag(self) -> Rows:
        """The largest absolute values."""
        require_subnormals()
        return np.asarray(magnitude(self._rows)[1])

    @property
    def mig(self) -> Rows:
        """The smallest absolute values."""
        require_subnormals()
        return np.asarray(0.0 - magnitude(self._rows)[0])

    def hull(self, other: Operand) -> IntervalArray:
        """Return the smallest intervals that hold both."""
        return self._like(np.maximum(*self._pair(other)))

    def intersection(self, other: Operand) -> IntervalArray | None:
        """Return the common parts, None if any is empty: `disjoint` says where."""
        rows = np.minimum(*self._pair(other))
        return (
            None if (rows[1] < -rows[0]).any() else self._like(np.where(np.isnan(rows), inf, rows))
        )

    __and__, __or__ = intersection, hull

    def bisect(self) -> tuple[IntervalArray, IntervalArray]:
        """Return two arrays, the halves of each interval, cut at `mid`."""
        middle = self.mid
        left, right = joined(self._rows[0], middle), joined(-middle, self._rows[1])
        return self._like(left), self._like(right)

    def widen(self, radius: Exact) -> IntervalArray:
        """Return enclosures of [inf - radius, sup + radius], radius >= 0 exact."""
        r = fraction(radius)
        return self + IntervalArray((-r, r))

    # -- the elements: see also `Shaped` ---------------------------------------------------------

    def item(self) -> Interval:
        """Return the only element, exactly, as an Interval; OverflowError if it is not bounded."""
        from intervals.interval import Interval

        low, high = self.inf.item(), self.sup.item()
        if not high - low < inf:
            raise OverflowError(f"not bounded: {self}")
        return Interval.from_float(low).hull(Interval.from_float(high))

    def tolist(self) -> Any:
        """Return the elements as nested lists of Intervals."""
        return [x.tolist() for x in self] if self.ndim else self.item()

    # -- relations: see Relations; comparisons with NaN are False, so that it decides nothing -----

    def _bounds(self, other: Operand | str) -> tuple[Any, Any, Any, Any]:
        require_subnormals()
        if isinstance(other, IntervalArray):
            a, b = aligned(self._rows, other._rows)
            return -a[0], a[1], -b[0], b[1]
        if type(other) is int and abs(other) < 2**53:
            return self.inf, self._rows[1], float(other), float(other)
        return self.inf, self.sup, *ends(other)

    def overlap(self, other: IntervalArray) -> NDArray[np.object_]:
        """Return how the intervals lie to the others: an array of `Overlap`."""
        states = np.vectorize(overlap_state, otypes=[object])
        found: NDArray[np.object_] = states(*self._bounds(self._like(self._pair(other)[1])))
        return found

    def __eq__(self, other: object) -> Any:
        """Return where two IntervalArrays are equal as sets: a mask, as numpy's ==."""
        if not isinstance(other, IntervalArray):
            raise TypeError("an IntervalArray equals IntervalArrays only: use contains or subset")
        return self.equal(other)

    def __ne__(self, other: object) -> Any:
        """Return where two IntervalArrays differ as sets."""
        return ~(self == other)

    def __hash__(self) -> NoReturn:
        raise TypeError("an IntervalArray has no hash")

    def _unordered(self, other: object) -> NoReturn:
        raise TypeError("intervals may overlap: use certainly_less, possibly_less, ...")

    __lt__ = __le__ = __gt__ = __ge__ = _unordered

    def __bool__(self) -> NoReturn:
        raise TypeError("the truth of an IntervalArray is not defined: use a mask, .all(), .any()")

    # -- numpy ---------------------------------------------------------------------------------

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        return numpy_protocol.apply_ufunc(type(self), ufunc, method, inputs, options)

    def __array_function__(self, function: Any, _types: Any, arguments: Any, options: Any) -> Any:
        return numpy_protocol.apply_function(type(self), function, arguments, options)

    def __array__(self, *_arguments: Any, **_options: Any) -> Any:
        raise TypeError("an IntervalArray is no array of numbers: take .inf, .sup or .mid")

    def sum(
        self, axis: int | tuple[int, ...] | None = None, *, keepdims: bool = False, initial: Any = 0
    ) -> IntervalArray:
        """Return the sums over some axes, or over all elements; `initial` is added to each."""
        result = self._reduced(self._total, (0.0, 0.0), axis, keepdims)
        if type(initial) is not int or initial != 0:
            result = result + initial
        return result

    def prod(
        self, axis: int | tuple[int, ...] | None = None, *, keepdims: bool = False, initial: Any = 1
    ) -> IntervalArray:
        """Return the products over some axes, or over all elements, times `initial`."""
        result: IntervalArray = self._reduced(self._product, (-1.0, 1.0), axis, keepdims) * initial
        return result

    def _reduced(
        self, operation: Operation, neutral: tuple[float, float], axis: Any, keepdims: bool
    ) -> IntervalArray:
        rows, place, shape = self._rows, 0, (1,) * self.ndim
        if axis is None:
            rows = rows.reshape(2, -1)
        elif isinstance(axis, tuple):
            front = range(len(axis))
            rows = joined(*(np.moveaxis(row, axis, front) for row in rows))
            rows = rows.reshape(2, -1, *rows.shape[len(axis) + 1 :])
            shape = self.inf.sum(axis=axis, keepdims=True).shape
        elif -self.ndim <= axis < self.ndim:
            place = axis % self.ndim
            shape = (*self.shape[:place], 1, *self.shape[place + 1 :])
        else:
            raise np.exceptions.AxisError(axis, self.ndim)
        with _quiet():
            reduced = pairwise(operation, rows, place, neutral)
        return self._like(reduced.reshape(2, *shape) if keepdims else reduced)

    def __matmul__(self, other: IntervalArray) -> IntervalArray:
        """Return the matrix product, with numpy's rules for vectors and stacks."""
        if not isinstance(other, IntervalArray):
            return NotImplemented
        if not (self.ndim and other.ndim):
            raise ValueError("a matrix product needs arrays of at least one axis")
        a = self._rows if self.ndim > 1 else self._rows[:, np.newaxis]
        b = other._rows if other.ndim > 1 else other._rows[..., np.newaxis]
        with _quiet():
            rows = matrix_product(*aligned(a, b), self._total, self._product)
        if self.ndim == 1:
            rows = rows[..., 0, :]
        return self._like(rows[..., 0] if other.ndim == 1 else rows)

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
        return self._like(self._rows[::-1])

    def __abs__(self) -> IntervalArray:
        return self._like(magnitude(self._rows))

    def __add__(self, other: Operand) -> IntervalArray:
        rows = _rows_of(other)
        if rows is None:
            return NotImplemented
        return self._like(in_blocks(self._total, *aligned(self._rows, rows)))

    __radd__ = __add__

    def __sub__(self, other: Operand) -> IntervalArray:
        rows = _rows_of(other)
        return NotImplemented if rows is None else self + self._like(rows[::-1])

    def __rsub__(self, other: Operand) -> IntervalArray:
        return -self + other

    def __mul__(self, other: Operand) -> IntervalArray:
        """Return the products; those by the ints 0 and +-2^k are exact."""
        number = None if isinstance(other, IntervalArray) else whole(other)  # numpy's abs wraps
        if number is not None and (size := abs(number)) & (size - 1) == 0 and size < 2**1024:
            if number == 1:
                return self
            if number == 0:
                return self._like(np.zeros_like(self._rows))
            rows = self._rows if number >= 0 else self._rows[::-1]
            with _quiet():
                rows = np.maximum(rows * float(size), -MAX)
                return self._like(extended(rows, rows))
        factor = _rows_of(other)
        if factor is None:
            return NotImplemented
        return self._like(in_blocks(self._product, *aligned(self._rows, factor)))

    __rmul__ = __mul__

    def __truediv__(self, other: Operand) -> IntervalArray:
        """Return the quotients; DomainError if a divisor contains 0."""
        divisor = _rows_of(other)
        if divisor is None:
            return NotImplemented
        return self._like(in_blocks(self._quotient, *aligned(self._rows, divisor)))

    def __rtruediv__(self, other: Operand) -> IntervalArray:
        dividend = _rows_of(other)
        return NotImplemented if dividend is None else self._like(dividend) / self

    def __pow__(self, exponent: Operand) -> IntervalArray:
        """Return the n-th powers without the dependency of x * x; real powers by `pow`."""
        n = whole(exponent)
        if n is None:
            return NotImplemented if _rows_of(exponent) is None else self.pow(exponent)
        if n < 0:
            return (1 / self) ** -n
        if n < 2:
            return self if n else self * 0 + 1
        return self._like(in_blocks(partial(self._power, n=n), self._rows))

    def __rpow__(self, base: Operand) -> IntervalArray:
        if isinstance(base, float):  # which Fraction.__pow__ makes of itself
            raise TypeError(
                f"{base!r} is a float: write pow(Fraction(p, q), x) of intervals for p/q"
            )
        rows = _rows_of(base)
        return NotImplemented if rows is None else self._like(rows).pow(self)

    def sqr(self) -> IntervalArray:
        """Return the squares: within [0, oo), without the dependency of x * x."""
        return self**2

    def recip(self) -> IntervalArray:
        """Return 1 / x."""
        return 1 / self

    def fma(self, factor: Operand, term: Operand) -> IntervalArray:
        """Return x y + z, with two outward steps."""
        return self * factor + term

    # -- elementary functions: see Elementary, and `elementary.binary64` for the errors -----------

    def _monotone(self, name: str) -> IntervalArray:
        if name in DOMAINS and not self._inside(DOMAINS[name]):
            raise DomainError(f"{name} of an interval that leaves {DOMAINS[name]}")
        if name not in self._ieee:
            return self._like(binary64.monotone(name, self._rows, self._rounded))
        return self._like(in_blocks(self._ieee[name], self._rows))

    def _inside(self, domain: Domain) -> bool:
        ends = (None if domain.low is None else -domain.low, domain.high)
        within = operator.le if domain.closed else operator.lt
        rows = zip(self._rows, ends, strict=True)
        return all(end is None or all_of(within(row, end)) for row, end in rows)

    def sincos(self) -> tuple[IntervalArray, IntervalArray]:
        """Return (sin X, cos X), within [-1, 1], from one reduction."""
        sin, cos = binary64.sincos(self._rows, self._rounded)
        return self._like(sin), self._like(cos)

    def sin(self) -> IntervalArray:
        """Return the sine."""
        return self.sincos()[0]

    def cos(self) -> IntervalArray:
        """Return the cosine."""
        return self.sincos()[1]

    def tan(self) -> IntervalArray:
        """Return the tangent; DomainError where a pole is, or may be, inside."""
        return self._like(binary64.tan(self._rows, self._rounded))

    def atan2(self, x: Operand) -> IntervalArray:
        """Return the angle in (-pi, pi] of the points (x, y), y in this interval."""
        return self._like(binary64.atan2(*self._pair(x), self._rounded))

    def hypot(self, other: Operand) -> IntervalArray:
        """Return sqrt(x^2 + y^2)."""
        return self._like(binary64.hypot(*self._pair(other), self._rounded))

    def pow(self, exponent: Operand) -> IntervalArray:
        """Return x^y for real y; the domain is x > 0, and x = 0 with y > 0."""
        base, power_of = self._pair(exponent)
        if not ((base[0] < 0.0) | ((base[0] <= 0.0) & (power_of[0] < 0.0))).all():
            raise DomainError("pow leaves x > 0, or x = 0 with y > 0")
        return self._like(binary64.power(base, power_of, self._rounded))

    def minimum(self, other: Operand) -> IntervalArray:
        """Return the range of min(x, y)."""
        a, b = self._pair(other)
        return self._like(joined(np.maximum(a[0], b[0]), np.minimum(a[1], b[1])))

    def maximum(self, other: Operand) -> IntervalArray:
        """Return the range of max(x, y)."""
        a, b = self._pair(other)
        return self._like(joined(np.minimum(a[0], b[0]), np.maximum(a[1], b[1])))

    # -- text ----------------------------------------------------------------------------------

    def __repr__(self) -> str:
        """Return what evaluates to an equal array, given numpy's names: up to 1000 intervals."""
        if self.size > 1000:
            return f"<IntervalArray of shape {self.shape}>"
        low, high = self.inf.tolist(), self.sup.tolist()
        empty = "" if self.size else f".reshape{self.shape}"
        return f"IntervalArray.from_floats({low}, {high}){empty}"

    def __str__(self) -> str:
        """Return decimals that enclose, which the constructor reads; of many only some."""
        return display.array_text(self.inf, self.sup)

    def _repr_html_(self) -> str:
        flat = self.reshape(-1)
        return display.html(self.shape, zip(flat.inf, flat.sup, strict=True), self.size)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self)._of_rows, (np.ascontiguousarray(self._rows),)


def _make(rows: Rows, kind: type[_A]) -> _A:
    """Return the IntervalArray of these rows, which nobody changes from now on.

    Every array comes through here, so none is made where subnormal numbers are flushed to zero.
    """
    require_subnormals()
    new = object.__new__(kind)
    new._rows = rows
    return new


def _quiet() -> np.errstate:
    """Silence numpy's warnings: a bound that overflows is refused by `bounded`."""
    return np.errstate(all="ignore")


def _rows_of(value: object) -> Rows | None:
    """Return the rows of an operand, None for what is none; a float raises TypeError."""
    return value._rows if isinstance(value, IntervalArray) else scalar_rows(value)


class TightArray(IntervalArray):
    """An IntervalArray with the least bounds for + - * / sqr sqrt, sums and products of these.

    They are sharper than those of IntervalArray, by 1.5 ulps, and take longer: see `tight`, which
    has this where the processor rounds to nearest and results are between 2^-900 and 2^900 in size.
    Bounds of elementary functions are within 1.5 ulps of the range, half an ulp sharper. Where both
    types meet the first operand's is the result's.
    """

    __slots__ = ()
    _total, _product = staticmethod(tight.total), staticmethod(tight.product)
    _quotient, _power = staticmethod(tight.quotient), staticmethod(tight.power)
    _ieee: ClassVar = {**STEPS, "sqrt": tight.square_root}
    _rounded = staticmethod(least_bounds)
