"""Interval arithmetic on rows: arrays (-lower, upper) of shape (2, ...), see `rounding`.

The formulas below give each bound as the largest x of some candidates, each rounded once in any
mode. If e is the largest exact candidate and x < e, then its own rounded value, which is e or a
neighbour of it and at most x, is x: so `outward`, which only asks that, makes an upper bound.
"""

from collections.abc import Callable
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals import few
from intervals.errors import DomainError
from intervals.rounding import (
    Rows,
    all_of,
    constant,
    joined,
    outward,
    outward_sum,
)

_BLOCK = 16384  # elements at a time
_ZERO = constant(0.0)
_TAIL = np.array((1 << 27) - 1)
_LEAST, _MOST = constant(few.LOW), constant(few.HIGH)


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
    if ends and 0 < first.size <= 2 * few.MOST and first.shape == operands[-1].shape:
        try:
            return few.one_by_one(ends, first, operands[-1])
        except OverflowError:
            pass
    with np.errstate(all="ignore"):
        return _in_blocks(operation, *operands)


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
        raise DomainError(few.ZERO_INSIDE)
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
    return bool(rows.size) and few.is_half(rows.item(0)) and few.is_half(rows.item(rows.size - 1))


def _exact_factors(a: Rows, b: Rows) -> bool:
    return _short(a) and _short(b) and _halves(a) and _halves(b)


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


_BY_ENDS = {total: few.total, product: few.product, quotient: few.quotient}


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
