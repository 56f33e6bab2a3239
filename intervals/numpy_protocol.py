"""numpy's functions on IntervalArrays: np.sin(X), np.add(1, X), np.concatenate((X, Y)), np.sum(X).

Ufuncs become the operation of the same meaning; functions that only move elements are applied to
both rows of endpoints alike. What is in neither table has no rigorous meaning here, and raises.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from intervals.entry import integer_rows
from intervals.exact import is_time, whole
from intervals.functions import TABLE
from intervals.numpy_functions import ASKING

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


def apply_function(kind: Kind, function: Any, arguments: tuple[Any, ...], options: Any) -> Any:
    """Do what `__array_function__` is asked for; TypeError for what intervals do not do."""
    if function in ASKING:
        lifted = (_exact(kind, x) if isinstance(x, np.ndarray) else x for x in arguments)
        return ASKING[function](*lifted, **options)
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
