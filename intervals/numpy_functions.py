"""numpy's functions that compute with arrays of intervals, or ask them something."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from itertools import accumulate
from math import inf, prod
from typing import Any

import numpy as np


def _dot(x: Any, y: Any) -> Any:
    if not (np.ndim(x) and np.ndim(y)):
        return x * y
    if max(x.ndim, y.ndim) > 2:
        raise TypeError("numpy.dot of more than two axes is not defined for IntervalArrays: use @")
    return x @ y


def _inner(x: Any, y: Any) -> Any:
    return _dot(x, y.T)


def _einsum(subscripts: str, *operands: Any, optimize: Any = False) -> Any:
    """Return the sums of products; all of these are there at once, so `@` is for matrices.

    No way to compute them is chosen: `optimize` is not heeded.
    """
    inputs, arrow, output = subscripts.replace(" ", "").partition("->")
    letters = inputs.replace(",", "")
    output = output if arrow else "".join(sorted(c for c in letters if letters.count(c) == 1))
    if not (letters + output).isalpha() or len(set(output)) < len(output):
        raise ValueError(f"einsum takes letters here, each once in the output: {subscripts!r}")
    if not set(output) <= set(letters):
        raise ValueError(f"einsum has an output without an input: {subscripts!r}")
    order = output + "".join(sorted(set(letters) - set(output)))
    result: Any = 1
    for names, x in zip(inputs.split(","), operands, strict=True):
        own = "".join(c for c in order if c in names)
        rows = np.einsum(f"...{names}->...{own}", x._rows)  # nothing is summed: elements move
        result = x._of_rows(rows)[tuple(slice(None) if c in own else None for c in order)] * result
    for _ in order[len(output) :]:
        result = result.sum(axis=-1)
    return result


def _mean(x: Any, axis: Any = None, keepdims: bool = False) -> Any:
    total = x.sum(axis=axis, keepdims=keepdims)
    return total / (x.size // total.size if total.size else 1)


def _diff(x: Any, n: int = 1, axis: int = -1) -> Any:
    if n < 0:
        raise ValueError(f"a difference of order {n}")
    for _ in range(n):
        moved = np.moveaxis(x, axis, 0)
        x = np.moveaxis(moved[1:] - moved[:-1], 0, axis)
    return x


def _cumsum(x: Any, axis: int | None = None) -> Any:
    moved = x.reshape(-1) if axis is None else np.moveaxis(x, axis, 0)
    totals = list(accumulate(moved))
    return np.moveaxis(np.stack(totals) if totals else moved, 0, axis or 0)


def _largest(x: Any, axis: Any = None, **options: Any) -> Any:
    """Return the range of the largest element: it increases with each of them."""
    return type(x).from_floats(x.inf.max(axis=axis, **options), x.sup.max(axis=axis, **options))


def _full_like(x: Any, value: Any) -> Any:
    return 0 * x + type(x)(value)


def _append(x: Any, y: Any, axis: int | None = None) -> Any:
    parts = [x, y] if isinstance(y, type(x)) else [x, type(x)(y)]
    return np.concatenate([np.ravel(part) for part in parts] if axis is None else parts, axis or 0)


def _tensordot(x: Any, y: Any, axes: Any = 2) -> Any:
    left, right = (range(-axes, 0), range(axes)) if isinstance(axes, int) else axes
    left, right = ([i % v.ndim for i in np.atleast_1d(a)] for a, v in ((left, x), (right, y)))
    rest = [[i for i in range(v.ndim) if i not in a] for a, v in ((left, x), (right, y))]
    rows = np.transpose(x, rest[0] + left), np.transpose(y, right + rest[1])
    outer = [x.shape[i] for i in rest[0]], [y.shape[i] for i in rest[1]]
    inner = prod(x.shape[i] for i in left)
    product = rows[0].reshape(prod(outer[0]), inner) @ rows[1].reshape(inner, prod(outer[1]))
    return product.reshape(*outer[0], *outer[1])


def _kron(x: Any, y: Any) -> Any:
    n = max(x.ndim, y.ndim)
    x, y = (v.reshape(*(1,) * (n - v.ndim), *v.shape) for v in (x, y))
    blocks = x.reshape(*(s for size in x.shape for s in (size, 1)))
    product = blocks * y.reshape(*(s for size in y.shape for s in (1, size)))
    return product.reshape(*(a * b for a, b in zip(x.shape, y.shape, strict=True)))


def _cross(x: Any, y: Any) -> Any:
    if x.shape[-1] != 3 or y.shape[-1] != 3:
        raise ValueError("a cross product is one of vectors of length 3")
    (a, b, c), (u, v, w) = (np.moveaxis(z, -1, 0) for z in (x, y))
    return np.stack((b * w - c * v, c * u - a * w, a * v - b * u), axis=-1)


def _norm(x: Any, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Any:
    """Return the length of a vector, of all entries, or one of numpy's norms 1, 2, inf, "fro"."""
    options, size = {"axis": axis, "keepdims": keepdims}, abs(x)
    vectors = x.ndim == 1 if axis is None else not isinstance(axis, tuple)
    if ord is None or ord == (2 if vectors else "fro"):
        return np.sqrt(x.sqr().sum(**options))
    if ord not in (1, inf) or not (vectors or (x.ndim == 2 and axis is None and not keepdims)):
        raise TypeError(f"numpy.linalg.norm of the order {ord!r} is not defined for IntervalArrays")
    if vectors:
        return size.sum(**options) if ord == 1 else size.max(**options)
    return size.sum(axis=0 if ord == 1 else 1).max()


def _by_linalg(name: str) -> Callable[..., Any]:
    def function(*arrays: Any) -> Any:
        return getattr(import_module("intervals.linalg"), name)(*arrays)

    return function


ASKING: dict[Any, Callable[..., Any]] = {
    np.shape: lambda x: x.shape,
    np.ndim: lambda x: x.ndim,
    np.size: lambda x: x.size,
    np.sum: lambda x, **options: x.sum(**options),
    np.prod: lambda x, **options: x.prod(**options),
    np.dot: _dot,
    np.inner: _inner,
    np.outer: lambda x, y: x.reshape(-1, 1) * y.reshape(1, -1),
    np.vdot: lambda x, y: x.reshape(-1) @ y.reshape(-1),
    np.einsum: _einsum,
    np.mean: _mean,
    np.diff: _diff,
    np.cumsum: _cumsum,
    np.full_like: _full_like,
    np.append: _append,
    np.tensordot: _tensordot,
    np.kron: _kron,
    np.cross: _cross,
    np.linalg.norm: _norm,
    np.linalg.solve: _by_linalg("solve"),
    np.linalg.inv: _by_linalg("inverse"),
    np.linalg.det: _by_linalg("determinant"),
    np.linalg.eigvals: _by_linalg("eigenvalues"),
    np.trace: lambda x, offset=0: np.diagonal(x, offset).sum(axis=-1),
    np.max: _largest,
    np.min: lambda x, axis=None, **options: -_largest(-x, axis, **options),
    np.clip: lambda x, low, high: x.maximum(low).minimum(high),
    np.zeros_like: lambda x: 0 * x,
    np.ones_like: lambda x: type(x).from_floats(np.ones(x.shape)),
    np.array_equal: lambda x, y: np.shape(x) == np.shape(y) and bool(np.all(np.equal(x, y))),
}
