"""The operations of ITF1788: what computes each here, and where it is defined.

Where an operation is defined is told by exact arithmetic on the operands of the vector, and by
Arb's pi for tan: nothing of `intervals`. Leaving the natural domain raises, while the vectors hold
the range over the part of the box inside it.
"""

from collections.abc import Callable
from operator import add, matmul, methodcaller, mul, neg, pos, sub, truediv
from typing import Any, NamedTuple

from intervals import DomainError, Interval, IntervalArray
from tests.intervals.oracle import quarter_turns


class Operation(NamedTuple):
    """An operation on Intervals, and on IntervalArrays if `arrays`.

    `kinds` has a letter for each operand: x an interval, r a number (an x if it is a point), n an
    int, l a list of numbers. `defined` takes the operands as Boxes, Fractions and ints; where it
    is false, `outside` is raised, or the operation returns None.
    """

    category: str
    kinds: str
    evaluate: Callable[..., Any]
    defined: Callable[..., bool] = lambda *_operands: True
    outside: Any = DomainError
    arrays: bool = True


def _holds_zero(x):
    return x.lower <= 0 <= x.upper


def _between_poles(x):
    """No odd multiple of pi/2 lies in x: the quarter turn before each end is the same, or even."""
    return (quarter_turns(x.lower) + 1) // 2 == (quarter_turns(x.upper) + 1) // 2


def _has_real_powers(x, y):
    return x.lower > 0 or (x.lower == 0 and y.lower > 0)


def _without_origin(y, x):
    return not (_holds_zero(y) and _holds_zero(x))


def _meet(x, y):
    return x.lower <= y.upper and y.lower <= x.upper


def _narrower(x, y):
    return y.upper - y.lower <= x.upper - x.lower


def _forward(kinds, evaluate, defined=lambda *_operands: True):
    return Operation("forward", kinds, evaluate, defined)


_METHODS = {  # of one interval, everywhere defined
    **{name: name for name in ("cbrt", "exp", "exp2", "exp10", "expm1", "sin", "cos", "atan")},
    **{name: name for name in ("sinh", "cosh", "tanh", "asinh")},
    **{name: name for name in ("sqr", "sign", "floor", "ceil", "trunc")},
    "roundTiesToEven": "round_ties_to_even",
    "roundTiesToAway": "round_ties_to_away",
}
_PARTIAL = {  # of one interval, with the domain
    "sqrt": lambda x: x.lower >= 0,
    "log": lambda x: x.lower > 0,
    "log2": lambda x: x.lower > 0,
    "log10": lambda x: x.lower > 0,
    "log1p": lambda x: x.lower > -1,
    "asin": lambda x: max(-x.lower, x.upper) <= 1,
    "acos": lambda x: max(-x.lower, x.upper) <= 1,
    "acosh": lambda x: x.lower >= 1,
    "atanh": lambda x: max(-x.lower, x.upper) < 1,
    "tan": _between_poles,
    "recip": lambda x: not _holds_zero(x),
}
_RELATIONS = {
    **{name: name for name in ("equal", "subset", "interior", "less", "precedes", "disjoint")},
    "strictLess": "strictly_less",
    "strictPrecedes": "strictly_precedes",
    "overlap": "overlap",
}


def _reduction(kinds, of_list, of_array):
    """Return the reduction of lists of points: of Intervals one by one, or of arrays at once."""

    def evaluate(*lists):
        return (of_array if isinstance(lists[0], IntervalArray) else of_list)(*lists)

    return Operation("numeric", kinds, evaluate)


def _total(points):
    return sum(points, Interval(0))


OPERATIONS = {
    **{name: _forward("x", methodcaller(method)) for name, method in _METHODS.items()},
    **{name: _forward("x", methodcaller(name), inside) for name, inside in _PARTIAL.items()},
    "logp1": _forward("x", methodcaller("log1p"), _PARTIAL["log1p"]),
    "pos": _forward("x", pos),
    "neg": _forward("x", neg),
    "abs": _forward("x", abs),
    "add": _forward("xx", add),
    "sub": _forward("xx", sub),
    "mul": _forward("xx", mul),
    "div": _forward("xx", truediv, lambda _x, y: not _holds_zero(y)),
    "fma": _forward("xxx", lambda x, y, z: x.fma(y, z)),
    "pown": _forward("xn", lambda x, n: x**n, lambda x, n: n >= 0 or not _holds_zero(x)),
    "pow": _forward("xx", lambda x, y: x.pow(y), _has_real_powers),
    "atan2": _forward("xx", lambda y, x: y.atan2(x), _without_origin),
    "hypot": _forward("xx", lambda x, y: x.hypot(y)),
    "min": _forward("xx", lambda x, y: x.minimum(y)),
    "max": _forward("xx", lambda x, y: x.maximum(y)),
    "cancelMinus": Operation("set", "xx", lambda x, y: x.cancel_minus(y), _narrower, None, False),
    "cancelPlus": Operation("set", "xx", lambda x, y: x.cancel_plus(y), _narrower, None, False),
    "convexHull": Operation("set", "xx", lambda x, y: x.hull(y)),
    "intersection": Operation("set", "xx", lambda x, y: x.intersection(y), _meet, None),
    **{
        name: Operation("boolean", "xx", lambda x, y, method=method: getattr(x, method)(y))
        for name, method in _RELATIONS.items()
    },
    "isMember": Operation("boolean", "rx", lambda r, x: x.contains(r)),
    "isSingleton": Operation("boolean", "x", methodcaller("is_singleton")),
    **{
        name: Operation("numeric", "x", lambda x, name=name: (getattr(x, name),))
        for name in ("inf", "sup", "mag", "mig", "wid", "mid")
    },
    "rad": Operation("numeric", "x", lambda x: (x.mid, x.rad)),
    "midRad": Operation("numeric", "x", lambda x: (x.mid, x.rad)),
    "sum_nearest": _reduction("l", _total, lambda x: x.sum()),
    "sum_abs_nearest": _reduction("l", lambda x: _total(map(abs, x)), lambda x: abs(x).sum()),
    "sum_sqr_nearest": _reduction(
        "l", lambda x: _total(a.sqr() for a in x), lambda x: x.sqr().sum()
    ),
    "dot_nearest": _reduction("ll", lambda x, y: _total(map(mul, x, y)), matmul),
}

EXACT_SUMS = {
    "sum_nearest": sum,
    "sum_abs_nearest": lambda x: sum(map(abs, x)),
    "sum_sqr_nearest": lambda x: sum(a * a for a in x),
    "dot_nearest": lambda x, y: sum(map(mul, x, y)),
}

DECORATIONS = {"newDec", "setDec", "decorationPart", "intervalPart", "isNaI"}
CONSTRUCTORS = {"b-numsToInterval", "d-numsToInterval", "b-textToInterval", "d-textToInterval"}
