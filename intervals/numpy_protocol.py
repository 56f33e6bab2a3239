"""numpy's functions on IntervalArrays: np.sin(X), np.add(1, X), np.concatenate((X, Y)), np.sum(X).

Ufuncs become the operation of the same meaning; functions that only move elements are applied to
both rows of endpoints alike. What is in neither table has no rigorous meaning here, and raises.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from intervals.array import IntervalArray

_HINT = "bare floats do not mix with intervals: IntervalArray.from_floats says that they are exact"


def _method(name: str) -> Callable[..., Any]:
    return lambda x, *rest: getattr(x, name)(*rest)


_UFUNCS: dict[Any, Callable[..., Any]] = {
    np.add: operator.add,
    np.subtract: operator.sub,
    np.multiply: operator.mul,
    np.divide: operator.truediv,
    np.matmul: operator.matmul,
    np.power: operator.pow,
    np.negative: operator.neg,
    np.positive: operator.pos,
    np.absolute: operator.abs,
    np.fabs: operator.abs,
    np.equal: operator.eq,
    np.not_equal: operator.ne,
    np.less: operator.lt,
    np.less_equal: operator.le,
    np.greater: operator.gt,
    np.greater_equal: operator.ge,
    np.square: _method("sqr"),
    np.reciprocal: _method("recip"),
    np.arcsin: _method("asin"),
    np.arccos: _method("acos"),
    np.arctan: _method("atan"),
    np.arcsinh: _method("asinh"),
    np.arccosh: _method("acosh"),
    np.arctanh: _method("atanh"),
    np.arctan2: _method("atan2"),
    np.rint: _method("round_ties_to_even"),
} | {
    getattr(np, name): _method(name)
    for name in (
        *("sqrt", "cbrt", "exp", "exp2", "expm1", "log", "log2", "log10", "log1p"),
        *("sin", "cos", "tan", "sinh", "cosh", "tanh"),
        *("floor", "ceil", "trunc", "sign", "hypot", "minimum", "maximum"),
    )
}
_REDUCTIONS = {np.add: "sum", np.multiply: "prod"}


def apply_ufunc(
    kind: type[IntervalArray], ufunc: Any, method: str, inputs: tuple[Any, ...], options: Any
) -> Any:
    """Do what `__array_ufunc__` is asked for; TypeError for what intervals do not do."""
    if method == "reduce" and ufunc in _REDUCTIONS and options.keys() <= {"axis"}:
        return getattr(inputs[0], _REDUCTIONS[ufunc])(axis=options.get("axis", 0))
    operation = _UFUNCS.get(ufunc)
    if method != "__call__" or options or operation is None:
        asked = ".".join([ufunc.__name__, *([] if method == "__call__" else [method]), *options])
        raise TypeError(f"numpy.{asked} is not defined for IntervalArrays")
    return operation(*(_exact(kind, x) for x in inputs))


def _exact(kind: type[IntervalArray], x: Any) -> Any:
    """Return x, arrays of ints as intervals; floats, which may be rounded, raise TypeError."""
    if isinstance(x, float | np.floating):
        raise TypeError(_HINT)
    if not isinstance(x, np.ndarray):
        return int(x) if isinstance(x, np.integer) else x
    if not np.issubdtype(x.dtype, np.integer):
        raise TypeError(_HINT)
    return kind.from_floats(x)


def _lifted(kind: type[IntervalArray], x: Any) -> IntervalArray:
    exact = _exact(kind, x)
    return exact if isinstance(exact, kind) else kind(exact)


# -- functions that move elements --------------------------------------------------------------

_OF_ONE = {
    *(np.reshape, np.ravel, np.squeeze, np.expand_dims, np.broadcast_to, np.atleast_1d),
    *(np.transpose, np.swapaxes, np.moveaxis, np.flip, np.fliplr, np.flipud, np.rot90, np.roll),
    *(np.split, np.array_split, np.tile, np.repeat, np.take, np.compress, np.delete, np.copy),
    *(np.diag, np.diagonal, np.tril, np.triu, np.atleast_2d),
}
_OF_MANY = {np.concatenate, np.stack, np.vstack, np.hstack, np.dstack, np.column_stack}
_ASKING: dict[Any, Callable[..., Any]] = {
    np.shape: lambda x: x.shape,
    np.ndim: lambda x: x.ndim,
    np.size: lambda x: x.size,
    np.sum: lambda x, axis=None: x.sum(axis=axis),
    np.prod: lambda x, axis=None: x.prod(axis=axis),
    np.dot: operator.matmul,
    np.array_equal: lambda x, y: x.shape == y.shape and bool((x == y).all()),
}


def apply_function(
    kind: type[IntervalArray], function: Any, arguments: tuple[Any, ...], options: Any
) -> Any:
    """Do what `__array_function__` is asked for; TypeError for what intervals do not do."""
    if function in _ASKING:
        return _ASKING[function](*arguments, **options)
    known = function in _OF_ONE | _OF_MANY | {np.where}
    if not known or not arguments or "out" in options:
        raise TypeError(f"numpy.{function.__name__} is not defined so for IntervalArrays")
    first, *rest = arguments
    if function is np.where:
        mask, pair = first, [_lifted(kind, x)._rows for x in rest]
        return _joined(kind, [np.where(mask, pair[0][i], pair[1][i]) for i in (0, 1)])
    if function in _OF_MANY:
        rows = [_lifted(kind, x)._rows for x in first]
        data: list[Any] = [[r[0] for r in rows], [r[1] for r in rows]]
    else:
        data = list(_lifted(kind, first)._rows)
    return _joined(kind, [function(x, *rest, **options) for x in data])


def _joined(kind: type[IntervalArray], rows: list[Any]) -> Any:
    """Return the intervals of two equally moved rows, a list where numpy returned lists."""
    if isinstance(rows[0], list):
        return [_joined(kind, [low, high]) for low, high in zip(*rows, strict=True)]
    return kind._of_rows(np.stack(rows))
