"""Interval arithmetic on rows: arrays (-lower, upper) of shape (2, ...), see `rounding`.

The formulas below give each bound as the largest x of some candidates, each rounded once in any
mode. If e is the largest exact candidate and x < e, then its own rounded value, which is e or a
neighbour of it and at most x, is x: so `outward`, which only asks that, makes an upper bound.
"""

import json
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from math import frexp, inf, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals.errors import DomainError
from intervals.exact import fraction, no_decimal, pair, whole
from intervals.rounding import (
    ETA,
    MAX,
    ULP,
    BeyondRange,
    Rows,
    all_of,
    constant,
    float_down,
    float_up,
    joined,
    outward,
    outward_sum,
    towards,
)

_BLOCK = 16384  # elements at a time
_FEW = 10  # intervals: they are done sooner without numpy
_ZERO = constant(0.0)
_HALF, _TAIL = 2.0**26, np.array((1 << 27) - 1)
_LOW, _HIGH = 2.0**-400, 2.0**400
_LEAST, _MOST = constant(_LOW), constant(_HIGH)
_ZERO_INSIDE = "division by an interval that contains 0"


def aligned(a: Rows, b: Rows) -> tuple[Rows, Rows]:
    """Give both the same number of axes, the missing element axes (length 1) on the left."""
    if a.ndim == b.ndim:
        return a, b
    return _with_axes(a, b.ndim), _with_axes(b, a.ndim)


def _with_axes(rows: Rows, ndim: int) -> Rows:
    if rows.ndim >= ndim:
        return rows
    return rows.reshape(2, *(1,) * (ndim - rows.ndim), *rows.shape[1:])


def is_thin(rows: Rows) -> bool:
    """Return whether every interval is a point; most arrays of others show it at once."""
    if rows.size and -rows.item(0) != rows.item(rows.size // 2):
        return False
    return all_of(-rows[0] == rows[1])


def in_blocks(operation: Callable[..., Rows], *operands: Rows) -> Rows:
    """Do an elementwise operation on aligned rows in blocks along the longest axis.

    The temporaries of a block stay in the cache, and small beside a large result. Few intervals
    are done one by one, sooner, and to the same bits, or exactly where the numbers are short.
    """
    first, ends = operands[0], _BY_ENDS.get(operation)
    if ends and 0 < first.size <= 2 * _FEW and first.shape == operands[-1].shape:
        try:
            return _few(ends, first, operands[-1])
        except OverflowError:
            pass
    with np.errstate(all="ignore"):
        return _in_blocks(operation, *operands)


def _few(ends: Callable[..., tuple[float, float]], a: Rows, b: Rows) -> Rows:
    x, y = a.ravel().tolist(), b.ravel().tolist()
    if len(x) == 2:
        return np.array(ends(*x, *y)).reshape(a.shape)
    n = len(x) // 2
    columns = map(ends, x[:n], x[n:], y[:n], y[n:])
    return np.array([*zip(*columns, strict=True)]).reshape(a.shape)


def _in_blocks(operation: Callable[..., Rows], *operands: Rows) -> Rows:
    if prod([x.size for x in operands]) <= 2 * _BLOCK:
        return operation(*operands)
    shape = np.broadcast(*operands).shape
    axis = max(range(1, len(shape)), key=lambda i: shape[i])
    step = max(1, shape[axis] * 2 * _BLOCK // prod(shape))
    result = np.empty(shape)
    for start in range(0, shape[axis], step):
        part = (slice(None),) * axis + (slice(start, start + step),)
        cut = [x[part] if x.shape[axis] > 1 else x for x in operands]
        result[part] = operation(*cut)
    return result


def total(a: Rows, b: Rows) -> Rows:
    """Return rows that contain x + y for x in A, y in B; of short numbers the exact ones, if short.

    s = fl(a + b) is exact if s - a and s - b are b and a: that of the larger one has no rounding.
    """
    s = a + b
    if _short(a) and _short(b) and all_of((s - a == b) & (s - b == a)):
        return s
    return outward_sum(s)


def product(a: Rows, b: Rows) -> Rows:
    """Return rows that contain x y for x in A, y in B.

    With a = (-l, u) and b = (-m, v): a0 b0 = l m, a1 b1 = u v, a0 b1 = -l v, a1 b0 = -u m, and
    x y lies between the least and the largest of l m, u v, l v, u m.
    """
    if is_thin(a):
        a, b = b, a
    if not is_thin(b):
        return _of_four(a, b, np.multiply, exact=_exact_factors(a, b))
    if is_thin(a):
        point = a[1] * b[1]
        rows = joined(-point, point)
        return rows if _exact_factors(a[1], b[1]) else outward(rows)
    scaled = a * b[1]  # (-l v, u v), reversed (u v, -l v): the bounds if v >= 0, if v < 0
    if _exact_factors(a, b[1]):
        return _of_point(scaled)
    return outward(_of_point(scaled), lambda: _of_point(_without_nan(scaled, a, b)))


def _of_point(scaled: Rows) -> Rows:
    return np.maximum(scaled, -scaled[::-1])


def quotient(a: Rows, b: Rows) -> Rows:
    """Return rows that contain x / y for x in A, y in B; DomainError if 0 is in a divisor.

    Monotone in x and in y, x / y lies between the least and the largest of the four quotients
    of endpoints; the signs are those of the products.
    """
    a, b = dividends(a, b)
    exact = False
    if _short(a) and _short(b) and _halves(b):
        quotients = a[:, np.newaxis] / b
        exact = _halves(quotients) and all_of(quotients * b == a[:, np.newaxis])
    return _of_four(a, b, np.divide, exact=exact)


def dividends(a: Rows, b: Rows) -> tuple[Rows, Rows]:
    """Return both, aligned; DomainError if 0 is in a divisor."""
    if not all_of(np.minimum(b[0], b[1]) < _ZERO):
        raise DomainError(_ZERO_INSIDE)
    return aligned(a, b)


def _of_four(a: Rows, b: Rows, operation: Callable[[Rows, Rows], Rows], *, exact: bool) -> Rows:
    """Return rows of the hull of the four results at ends, of which those that are NaN stand for 0.

    0 inf: 0 times numbers. inf / inf: x / y tends to 0 with y, so that 0 is a bound of the others.
    """
    ends = ((a[0], b[0]), (a[1], b[1]), (a[0], b[1]), (a[1], b[0]))
    candidates = [operation(x, y) for x, y in ends]
    rows = _hull_of_four(*candidates)
    if exact:
        return rows
    return outward(rows, lambda: _hull_of_four(*(_without_nan(x, a, b) for x in candidates)))


def _short(rows: Rows) -> bool:
    """Return whether the first and the last number have at most 26 bits: a guess at all of them."""
    return bool(rows.size) and _is_half(rows.item(0)) and _is_half(rows.item(rows.size - 1))


def _exact_factors(a: Rows, b: Rows) -> bool:
    return _short(a) and _short(b) and _halves(a) and _halves(b)


def _is_half(x: float) -> bool:
    return frexp(x)[0] * _HALF % 1.0 == 0.0


def _is_fit(x: float) -> bool:
    return _is_half(x) and (x == 0.0 or _LOW < abs(x) < _HIGH)


def _halves(rows: Rows) -> bool:
    """Return whether all have at most 26 bits and are 0 or of moderate size.

    Then their products are exact: 52 bits, above 2^-800.
    """
    size = np.abs(rows)
    fit = ((size >= _LEAST) & (size <= _MOST)) | (size == _ZERO)
    return all_of(fit) and not (rows.view(np.int64) & _TAIL).any()


def _without_nan(x: Rows, *operands: Rows) -> Rows:
    if any(np.isnan(operand).any() for operand in operands):
        raise FloatingPointError("a bound is not a number")
    return np.where(np.isnan(x), 0.0, x)


def _hull_of_four(p: Rows, q: Rows, r: Rows, s: Rows) -> Rows:
    """Return (-least, largest) of p, q, -r, -s."""
    rows, others = np.empty((2, *p.shape)), np.empty((2, *p.shape))
    np.minimum(p, q, out=rows[0, ...])
    np.minimum(r, s, out=rows[1, ...])
    np.negative(rows, out=rows)
    np.maximum(r, s, out=others[0, ...])
    np.maximum(p, q, out=others[1, ...])
    return np.maximum(rows, others, out=rows)


def _total(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    x, y = a + c, b + d
    if not (x - a == c and x - c == a):
        x += abs(x) * ULP
    if not (y - b == d and y - d == b):
        y += abs(y) * ULP
    return _finite(x, y)


def _product(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    p, q, r, s = a * c, b * d, a * d, b * c
    if all(map(_is_fit, (a, b, c, d))):
        return max(r, s, -p, -q), max(p, q, -r, -s)
    return _outermost(p, q, r, s)


def _quotient(a: float, b: float, c: float, d: float) -> tuple[float, float]:
    if not (c < 0.0 or d < 0.0):
        raise DomainError(_ZERO_INSIDE)
    p, q, r, s = a / c, b / d, a / d, b / c
    products = ((p, c, a), (q, d, b), (r, d, a), (s, c, b))
    if all(_is_fit(x) and _is_fit(y) and x * y == z for x, y, z in products):
        return max(r, s, -p, -q), max(p, q, -r, -s)
    return _outermost(p, q, r, s)


def _outermost(p: float, q: float, r: float, s: float) -> tuple[float, float]:
    """Do `outward` for `_hull_of_four`, of numbers."""
    x, y = max(r, s, -p, -q), max(p, q, -r, -s)
    x += abs(x) * ULP + ETA
    y += abs(y) * ULP + ETA
    return _finite(x, y)


def _finite(x: float, y: float) -> tuple[float, float]:
    if not (x < MAX and y < MAX):  # nor NaN: infinities are done by arrays
        raise OverflowError
    return x, y


_BY_ENDS = {total: _total, product: _product, quotient: _quotient}


def magnitude(rows: Rows) -> Rows:
    """Return the rows of |X|: (-mig, mag), mag = max(-l, u), mig = max(0, l, -u)."""
    low, high = rows
    return joined(np.minimum(_ZERO, np.minimum(low, high)), np.maximum(low, high))


def power(rows: Rows, n: int) -> Rows:
    """Return rows that contain x^n, n >= 2.

    On the rows p of X (n odd) or |X| (n even), t_n = p |p|^(n-1) is the row of the result. An upper
    bound r of t_k gives the upper bounds r |r| of t_(2k) = t_k |t_k| and r |p| of t_(k+1).
    """
    return powers(rows, n, _above)


def _above(x: Rows, y: Rows) -> Rows:
    """Return upper bounds of the products of numbers."""
    return x * y if _exact_factors(x, y) else outward(x * y)


def powers(rows: Rows, n: int, above: Callable[[Rows, Rows], Rows]) -> Rows:
    """Do the same, given upper bounds of x y for numbers."""
    rows = rows if n % 2 else magnitude(rows)
    size = np.abs(rows)
    result = rows
    for bit in bin(n)[3:]:
        result = above(result, np.abs(result))
        if bit == "1":
            result = above(result, size)
    return result if n % 2 else nonnegative(result)


def square_root(rows: Rows) -> Rows:
    """Return rows that contain sqrt x, x >= 0 (IEEE's is correctly rounded)."""
    roots = np.sqrt(np.abs(rows))
    exact = _short(roots) and _halves(roots) and all_of(roots * roots == np.abs(rows))
    np.negative(roots[0], out=roots[0, ...])
    return roots if exact else nonnegative(outward(roots))


def nonnegative(rows: Rows) -> Rows:
    """Cut off what the outward step added below 0, in place: for values known to be >= 0."""
    np.minimum(rows[0], _ZERO, out=rows[0, ...])
    return rows


# -- step functions, which are exact ---------------------------------------------------------------


def _step(function: Callable[[NDArray[np.float64]], Any]) -> Callable[[Rows], Rows]:
    """Return the step function of rows, from that of numbers."""
    return lambda rows: joined(-function(-rows[0]), function(rows[1]))


def _rounded(x: NDArray[np.float64], away: bool) -> NDArray[np.float64]:
    """Return the nearest integers; np.rint would follow the rounding mode.

    |x| - whole is exact, and whole + 1 is, below 2^52; from there on x is an integer.
    """
    size = np.abs(x)
    whole = np.floor(size)
    fraction_of = size - whole
    odd = whole * 0.5 != np.floor(whole * 0.5)
    up = (fraction_of > 0.5) | ((fraction_of == 0.5) & (odd | away))
    nearest: NDArray[np.float64] = np.copysign(whole + up, x)
    return nearest


STEPS: dict[str, Callable[[Rows], Rows]] = {
    "floor": _step(np.floor),
    "ceil": _step(np.ceil),
    "trunc": _step(np.trunc),
    "sign": _step(np.sign),
    "round_ties_to_even": _step(lambda x: _rounded(x, away=False)),
    "round_ties_to_away": _step(lambda x: _rounded(x, away=True)),
}


# -- numbers into rows ---------------------------------------------------------------------------


def scalar_rows(value: object) -> Rows | None:
    """Return the tightest rows of an int, Fraction, Interval or array of ints; None for others.

    A float, or an array of anything else, raises TypeError.
    """
    if isinstance(value, np.ndarray) and value.dtype.kind in "iu":
        return integer_rows(value)
    if isinstance(value, float | np.floating):
        raise no_decimal(value, "from_floats")
    if isinstance(value, np.ndarray):
        raise TypeError("floats do not mix with intervals: use IntervalArray.from_floats")
    if isinstance(value, np.generic) and whole(value) is None:  # else numpy asks again
        raise TypeError(f"not an interval or an exact number: {value!r}")
    if type(value) is int or type(value) is Fraction:
        return _rational_rows(value)
    if isinstance(value, int | Fraction | np.integer | Decimal) or _is_interval(value):
        return np.array(_enclosure(value))
    return None


@lru_cache(maxsize=256)
def _rational_rows(value: int | Fraction) -> Rows:
    """Return the tightest rows of a number: the few constants of a formula come again and again."""
    rows = np.array(_enclosure(value))
    rows.setflags(write=False)
    return rows


def integer_rows(values: NDArray[Any]) -> Rows:
    """Return the tightest rows of an array of ints."""
    try:
        return float_rows(values, values)
    except ValueError:  # binary64 does not hold them all
        return exact_rows(values)


def _is_interval(value: object) -> bool:
    """Return whether `value` has exact endpoints `inf` and `sup`, as an Interval has."""
    if hasattr(value, "decoration"):
        raise TypeError(f"{value} would lose its decoration: take its .interval")
    return isinstance(getattr(value, "inf", None), Fraction)


def exact_rows(values: Any) -> Rows:
    """Return rows of (nested lists of) exact numbers and pairs, as `IntervalArray.from_exact`."""
    if isinstance(values, np.ndarray) and not values.size:
        return np.empty((2, *values.shape))
    if isinstance(rows := getattr(values, "_rows", None), np.ndarray):
        return rows
    pairs = np.array(_nested(values), dtype=np.float64)
    if pairs.size == 0:
        pairs = pairs.reshape(*pairs.shape, 2)
    return np.ascontiguousarray(np.moveaxis(pairs, -1, 0))


def _nested(values: Any) -> Any:
    """Replace the elements in nested lists by their pairs (-lower, upper)."""
    if isinstance(values, str) and values.lstrip().startswith("["):
        values = _from_text(values)
    if isinstance(values, np.ndarray):
        if _unmasked(values).dtype.kind == "m":
            raise TypeError("spans of time are no numbers")
        values = values.tolist()
    if isinstance(values, list | range):
        return [_nested(value) for value in values]
    if not isinstance(values, tuple):
        return _enclosure(values)
    if len(values) != 2:
        raise ValueError(f"a tuple is a pair (lower, upper), a list is an axis: {values!r}")
    lower, upper = values
    if _endpoint(lower, "inf") > _endpoint(upper, "sup"):
        raise ValueError(f"reversed interval: {lower} > {upper}")
    return (_enclosure(lower)[0], _enclosure(upper)[1])


def _from_text(text: str) -> Any:
    """Return the nested lists of pairs that `str` of an IntervalArray prints."""

    try:
        values = json.loads(text, parse_float=str, parse_int=str, parse_constant=str)
        return _elements(values)
    except ValueError:
        raise ValueError(f"not intervals in nested brackets: {text[:40]!r}") from None


def _elements(values: list[Any]) -> Any:
    """Return one or two numbers as a pair, lists as an axis."""
    if not any(isinstance(value, str) for value in values):
        return [_elements(value) for value in values]
    if len(values) > 2 or any(isinstance(value, list) for value in values):
        raise ValueError("neither an interval nor an axis")
    return values[0], values[-1]


def _unmasked(values: NDArray[Any]) -> NDArray[Any]:
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError("a masked array has no numbers where it is masked: take its .compressed()")
    return values


def _endpoint(value: Any, name: str) -> Fraction:
    """Return the exact endpoint `name` of an Interval, or the exact number itself."""
    if _is_interval(value):
        end: Fraction = getattr(value, name)
        return end
    if isinstance(value, float | np.floating):
        raise no_decimal(value, "from_floats")
    return fraction(value)


def _enclosure(value: Any) -> tuple[float, float]:
    """Return (-lower, upper), the tightest, of an exact number or an Interval."""
    if isinstance(value, str):
        low, high = pair(value, None)
    else:
        low, high = _endpoint(value, "inf"), _endpoint(value, "sup")
    return -towards(low, float_down), towards(high, float_up)


def float_rows(lower: Any, upper: Any) -> Rows:
    """Return rows of binary64 bounds, as `IntervalArray.from_floats`."""
    low = high = _binary64(lower)
    if upper is not lower:
        low, high = np.broadcast_arrays(low, _binary64(upper))
    if not (low <= high).all():
        raise ValueError("bounds must be numbers or infinite, with lower <= upper")
    if (low == inf).any() or (high == -inf).any():
        raise BeyondRange("an interval holds a number")
    return joined(-low, high)


def _binary64(values: Any) -> NDArray[np.float64]:
    """Return floats as an array, unchanged; ints that binary64 does not hold raise ValueError."""
    if isinstance(values, np.ndarray) and _unmasked(values).dtype == np.float64:
        return values
    objects = np.asarray(values, dtype=object)
    if not all(isinstance(x, float | int | np.floating | np.integer) for x in objects.flat):
        raise TypeError("from_floats takes binary64 numbers only: use the constructor for others")
    floats = objects.astype(np.float64)
    if not (np.isnan(floats) | (floats == objects)).all():
        raise ValueError("from_floats takes binary64 numbers only: one of these needs more bits")
    return floats


class End:
    """An endpoint that binary64 need not hold, between its neighbours `down` <= it <= `up`.

    A binary64 number x is below it if and only if x < up, and at most it if and only if x <= down.
    """

    __array_ufunc__ = None  # so that `array < End` comes here
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Fraction) -> None:
        self.down, self.up = towards(value, float_down), towards(value, float_up)

    def __gt__(self, x: Any) -> Any:
        return x < self.up

    def __ge__(self, x: Any) -> Any:
        return x <= self.down

    def __lt__(self, x: Any) -> Any:
        return self.down < x

    def __le__(self, x: Any) -> Any:
        return self.up <= x

    def __eq__(self, x: object) -> Any:
        return (self.down == x) & (self.up == x)


def ends(value: Any) -> tuple[End, End]:
    """Return the endpoints of an exact number or an Interval, to be compared with arrays."""
    return End(_endpoint(value, "inf")), End(_endpoint(value, "sup"))
