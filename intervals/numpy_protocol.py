"""numpy's functions on IntervalArrays: np.sin(X), np.add(1, X), np.concatenate((X, Y)), np.sum(X).

Ufuncs become the operation of the same meaning; functions that only move elements are applied to
both rows of endpoints alike. What is in neither table has no rigorous meaning here, and raises.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from importlib import import_module
from itertools import accumulate
from math import inf, prod
from typing import Any, TypeAlias

import numpy as np

from intervals.entry import integer_rows
from intervals.exact import is_time, whole
from intervals.functions import TABLE

_HINT = "bare floats do not mix with intervals: IntervalArray.from_floats says that they are exact"


_LONG = (np.longdouble, np.clongdouble)
Kind: TypeAlias = Any  # the class IntervalArray, whose module imports this one


_ARITHMETIC: dict[Any, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.divide: operator.truediv,
    np.power: operator.pow,
    np.negative: operator.neg,
    np.positive: operator.pos,
    np.absolute: operator.abs,
    np.fabs: operator.abs,
}
_OPERATORS: dict[Any, Callable[..., Any]] = _ARITHMETIC | {
    np.matmul: operator.matmul,
    np.equal: operator.eq,
    np.not_equal: operator.ne,
    np.less: operator.lt,
    np.less_equal: operator.le,
    np.greater: operator.gt,
    np.greater_equal: operator.ge,
}
_METHODS: dict[Any, str] = {
    getattr(np, spelled): name
    for name in TABLE
    if hasattr(np, spelled := f"arc{name[1:]}" if name[0] == "a" else name)
} | {
    np.square: "sqr",
    np.reciprocal: "recip",
    np.arctan2: "atan2",
    np.rint: "round_ties_to_even",
    np.hypot: "hypot",
    np.minimum: "minimum",
    np.maximum: "maximum",
}
_REDUCTIONS = {np.add: "sum", np.multiply: "prod"}


def apply_ufunc(kind: Kind, ufunc: Any, method: str, inputs: tuple[Any, ...], options: Any) -> Any:
    """Do what `__array_ufunc__` is asked for; TypeError for what intervals do not do."""
    known = {"axis", "keepdims", "initial"}
    if method == "reduce" and ufunc in _REDUCTIONS and options.keys() <= known:
        return getattr(inputs[0], _REDUCTIONS[ufunc])(**{"axis": 0} | options)
    if options.get("out") is not None:
        raise TypeError(
            f"an IntervalArray does not change: take what numpy.{ufunc.__name__} returns"
        )
    if method != "__call__" or options or not (ufunc in _OPERATORS or ufunc in _METHODS):
        asked = ".".join([ufunc.__name__, *([] if method == "__call__" else [method]), *options])
        raise TypeError(f"numpy.{asked} is not defined for IntervalArrays")
    first, *others = (_exact(kind, x) for x in inputs)
    if ufunc in _OPERATORS:
        return _OPERATORS[ufunc](first, *others)
    return getattr(first if isinstance(first, kind) else kind(first), _METHODS[ufunc])(*others)


def jet_ufunc(jet: Any, ufunc: Any, method: str, inputs: tuple[Any, ...], options: Any) -> Any:
    """Do what `__array_ufunc__` is asked for by a jet; TypeError for what jets do not do."""
    if method != "__call__" or options or not (ufunc in _ARITHMETIC or ufunc in _METHODS):
        raise TypeError(f"numpy.{ufunc.__name__} is not defined so for jets")
    first, *others = inputs
    if type(first) is not type(jet):  # an array, whose own operators would ask here again
        first = 0 * jet + first
    if ufunc in _ARITHMETIC:
        return _ARITHMETIC[ufunc](first, *others)
    return getattr(first, _METHODS[ufunc])(*others)


def object_ufunc(kind: Kind, ufunc: Any, method: str, inputs: tuple[Any, ...], options: Any) -> Any:
    """Do what numpy does with objects of a kind; spans of time, ints to it, raise TypeError."""
    if any(map(is_time, inputs)):
        raise TypeError("spans of time are no numbers")
    if any(getattr(x, "dtype", None) in _LONG for x in inputs):  # whose objects would ask again
        raise TypeError(_HINT)
    known = kind, np.ndarray, np.generic
    if any(hasattr(x, "__array_ufunc__") and not isinstance(x, known) for x in inputs):
        return NotImplemented  # an IntervalArray or a jet, which is asked next
    objects = (np.array(x, dtype=object) if isinstance(x, kind) else x for x in inputs)
    if method == "__call__" and ufunc in _METHODS and not options:
        name, count = _METHODS[ufunc], len(inputs)
        return np.frompyfunc(lambda x, *y: _called(kind, name, x, *y), count, 1)(*objects)
    return getattr(ufunc, method)(*objects, **options)


def _called(kind: Kind, name: str, x: Any, *y: Any) -> Any:
    """Return a function of objects of a kind, the first of which may be an exact number."""
    return getattr(x if isinstance(x, kind) else kind(x), name)(*y)


def _exact(kind: Kind, x: Any) -> Any:
    """Return x, arrays of ints as intervals; floats, which may be rounded, raise TypeError."""
    if isinstance(x, float | np.floating):
        raise TypeError(_HINT)
    if isinstance(x, np.generic) and (number := whole(x)) is not None:
        return number
    if isinstance(x, np.generic):  # its operators would ask here again
        raise TypeError(f"not an interval or an exact number: {x!r}")
    if not isinstance(x, np.ndarray):
        return x
    if x.dtype.kind not in "iu":
        raise TypeError(_HINT)
    return kind._of_rows(integer_rows(x))


def _lifted(kind: Kind, x: Any) -> Any:
    exact = _exact(kind, x)
    return exact if isinstance(exact, kind) else kind(exact)


# -- functions that move elements --------------------------------------------------------------

# The options that are heeded, in numpy's order: others (dtype, casting, out) would round, or write.
_OF_ONE: dict[Any, tuple[str, ...]] = {
    **dict.fromkeys((np.ravel, np.copy, np.fliplr, np.flipud, np.atleast_1d, np.atleast_2d), ()),
    **dict.fromkeys((np.reshape, np.broadcast_to), ("shape",)),
    **dict.fromkeys((np.squeeze, np.expand_dims, np.flip), ("axis",)),
    np.transpose: ("axes",),
    np.swapaxes: ("axis1", "axis2"),
    np.moveaxis: ("source", "destination"),
    np.rot90: ("k", "axes"),
    np.roll: ("shift", "axis"),
    **dict.fromkeys((np.split, np.array_split), ("indices_or_sections", "axis")),
    np.tile: ("reps",),
    np.repeat: ("repeats", "axis"),
    np.take: ("indices", "axis"),
    np.delete: ("obj", "axis"),
    **dict.fromkeys((np.diag, np.tril, np.triu), ("k",)),
    np.pad: ("pad_width", "mode"),  # with 0
    np.diagonal: ("offset", "axis1", "axis2"),
}
_OF_MANY: dict[Any, tuple[str, ...]] = {
    **dict.fromkeys((np.concatenate, np.stack), ("axis",)),
    **dict.fromkeys((np.vstack, np.hstack, np.dstack, np.column_stack), ()),
}
_MOVING = _OF_ONE | _OF_MANY


# -- functions that compute, or ask ------------------------------------------------------------


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


_ASKING: dict[Any, Callable[..., Any]] = {
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


def apply_function(kind: Kind, function: Any, arguments: tuple[Any, ...], options: Any) -> Any:
    """Do what `__array_function__` is asked for; TypeError for what intervals do not do."""
    if function in _ASKING:
        lifted = (_exact(kind, x) if isinstance(x, np.ndarray) else x for x in arguments)
        return _ASKING[function](*lifted, **options)
    if function is np.where and len(arguments) == 3 and not options:
        mask, pair = arguments[0], [_lifted(kind, x)._rows for x in arguments[1:]]
        return _joined(kind, [np.where(mask, pair[0][i], pair[1][i]) for i in (0, 1)])
    names = _MOVING.get(function, ())
    heeded = options.keys() <= set(names) and len(arguments) <= 1 + len(names)
    if function not in _MOVING or not arguments or not heeded:
        raise TypeError(f"numpy.{function.__name__} is not defined so for IntervalArrays")
    first, *rest = arguments
    if function in _OF_MANY:
        rows = [_lifted(kind, x)._rows for x in first]
        data: list[Any] = [[r[0] for r in rows], [r[1] for r in rows]]
    else:
        data = list(_lifted(kind, first)._rows)
    return _joined(kind, [function(x, *rest, **options) for x in data])


def _joined(kind: Kind, rows: list[Any]) -> Any:
    """Return the intervals of two equally moved rows, a list where numpy returned lists."""
    if isinstance(rows[0], list):
        return [_joined(kind, [low, high]) for low, high in zip(*rows, strict=True)]
    return kind._of_rows(np.stack(rows))
