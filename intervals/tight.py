"""+ - * / and squares of rows with the least bounds that binary64 has, by error-free steps.

Theorem. Let y = fl(e) be an exact value e rounded to nearest, d a number with the sign of e - y.
The least binary64 number that is not below e is y where d <= 0, and the next one above y where
d > 0. Of several e_i the one with the largest y_i may be any with this y_i: those with a smaller
y_i are below the midpoint in front of it. So the largest d of these decides.

d is the error itself for + (Knuth) and * (Dekker, Veltkamp's split); for x / y and sqrt x it is
a remainder, x - y q with the sign of y, and x - y^2, which are numbers of binary64. Dekker's
product needs factors below 2^990 and a product above 2^-900 in size, so that no part of it
overflows, or underflows and meets a processor that flushes; elsewhere a bound is `outward`'s.
All this holds where the processor rounds to nearest, which is checked.

Sums, products and matrix products of rows (-lower, upper), without BLAS.

Each is a tree or a chain of the rigorous + and * of `rows`, in an order that does not matter: the
inclusion principle holds for every bracketing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from intervals.elementary.binary64.pair import NEXT, two_product, two_sum
from intervals.rounding import MAX, Rows, all_of, constant, outward, require_nearest
from intervals.rows import dividends, is_thin, nonnegative, powers

Operation: TypeAlias = Callable[[Rows, Rows], Rows]


def pairwise(operation: Operation, rows: Rows, axis: int, neutral: tuple[float, float]) -> Rows:
    """Return rows of the sums, or products, over the element axis `axis` >= 0.

    Neighbours are combined until one is left: n terms lose at most ceil(log2 n) outward steps.
    `neutral` are the rows of the empty combination.
    """
    work = np.moveaxis(rows, axis + 1, 1)
    while work.shape[1] > 1:
        half = work.shape[1] // 2
        rest = work[:, 2 * half :]
        work = operation(work[:, :half], work[:, half : 2 * half])
        work = np.concatenate((work, rest), axis=1) if rest.shape[1] else work
    if work.shape[1]:
        return work[:, 0]
    empty = np.empty((2, *work.shape[2:]))
    empty[0], empty[1] = neutral
    return empty


def matrix_product(a: Rows, b: Rows, total: Operation, product: Operation) -> Rows:
    """Return rows of A B for matrices (..., n, k) and (..., k, m); stacks of them broadcast.

    k products of a column and a row are added up one after the other.
    """
    terms = a.shape[-1]
    if b.shape[-2] != terms:
        raise ValueError(f"matrices of shapes {a.shape[1:]} and {b.shape[1:]} do not fit")
    if not terms:
        lead = np.broadcast_shapes(a.shape[1:-2], b.shape[1:-2])
        return np.zeros((2, *lead, a.shape[-2], b.shape[-1]))
    result = product(a[..., :, :1], b[..., :1, :])
    for k in range(1, terms):
        result = total(result, product(a[..., :, k : k + 1], b[..., k : k + 1, :]))
    return result


_SMALL, _LARGE = constant(2.0**-900), constant(2.0**900)


def total(a: Rows, b: Rows) -> Rows:
    """Return the least rows that contain x + y for x in A, y in B."""
    require_nearest()
    return _least(*two_sum(a, b))


def product(a: Rows, b: Rows) -> Rows:
    """Return the least rows that contain x y for x in A, y in B."""
    require_nearest()
    return _hull(*_products(*_corners(a, b)))


def quotient(a: Rows, b: Rows) -> Rows:
    """Return the least rows that contain x / y for x in A, y in B; DomainError if 0 is in B."""
    require_nearest()
    x, y = _corners(*dividends(a, b))
    q = x / y
    p, error = two_product(q, y)
    rest = np.copysign(1.0, y) * ((x - p) - error)
    known = _moderate(p) & _moderate(q) & _moderate(x) & _moderate(y)
    if not all_of(known):
        rest = np.where(x == 0.0, 0.0, np.where(known, rest, np.nan))
    return _hull(q, rest)


def square_root(rows: Rows) -> Rows:
    """Return the least rows that contain sqrt x, x >= 0."""
    require_nearest()
    x = np.abs(rows)
    root = np.sqrt(x)
    p, error = two_product(root, root)
    rest = np.where(_moderate(x), (x - p) - error, np.where(x == 0.0, 0.0, np.nan))
    for part in (root, rest):
        np.negative(part[0], out=part[0, ...])
    return nonnegative(_least(root, rest))


def power(rows: Rows, n: int) -> Rows:
    """Return rows that contain x^n, n >= 2: the least for n = 2, and each product's least."""
    require_nearest()
    return powers(rows, n, _above)


def _above(x: Rows, y: Rows) -> Rows:
    return _least(*_products(x, y))


def _products(x: Rows, y: Rows) -> tuple[Rows, Rows]:
    """Return fl(x y) and its error, NaN where that is not known."""
    p, error = two_product(x, y)
    known = _moderate(p) & _moderate(x) & _moderate(y)
    if not all_of(known):
        error = np.where((x == 0.0) | (y == 0.0), 0.0, np.where(known, error, np.nan))
    return p, error


def _corners(a: Rows, b: Rows) -> tuple[Rows, Rows]:
    """Return x and y, pairs of ends, with a first axis; see `rows` for the signs of x y."""
    a, b = np.broadcast_arrays(a, b)
    if is_thin(b):
        ends = a[1:] if is_thin(a) else np.stack((-a[0], a[1]))
        return ends, b[1:]
    x, y = a, b
    return np.stack((x[0], x[1], -x[0], -x[1])), np.stack((y[0], y[1], y[1], y[0]))


def _hull(values: Rows, errors: Rows) -> Rows:
    """Return the rows of all values, each with a number of the sign of its error, NaN if unknown.

    A value that is NaN stands for 0: see `rows`.
    """
    if np.isnan(values).any():
        values = np.where(np.isnan(values), 0.0, values)
    both, signed = np.stack((-values, values)), np.stack((-errors, errors))
    most = both.max(axis=1)
    return _least(most, np.where(both == most[:, np.newaxis], signed, -1.0).max(axis=1))


def _least(rows: Rows, errors: Rows) -> Rows:
    """Return the least bounds; those of `outward` where the error is NaN and the row finite."""
    size = np.abs(rows)
    plain = size >= _SMALL
    step = size * NEXT
    step *= errors > 0.0
    bounds = np.maximum(rows + step, -MAX)
    if not all_of(plain & (errors == errors)):  # noqa: PLR0124 - NaN
        bounds = np.where(plain | ~(errors > 0.0), bounds, np.nextafter(rows, np.inf))
        bounds = np.where(size == np.inf, np.maximum(rows, -MAX), bounds)
        unknown = np.isnan(errors) & (size < np.inf)
        bounds = np.where(unknown, outward(rows.copy()), bounds)
    return bounds


def _moderate(x: Rows) -> Any:
    size = np.abs(x)
    return (size >= _SMALL) & (size <= _LARGE)
