"""The operations of `Interval` on FLINT's balls, rounded to the same bits as by libmp.

Theorem. Let a ball contain the real y, and let l <= y <= u be its ends. If l and u have the same
largest number of p bits that is not above them, this is the largest one <= y, since rounding down
is monotone; so for rounding up. An exact ball is y itself.

What this does not settle, and what raises, is left to the method that is replaced here. Beside
libmp's ends an Interval has the slot `_balls`, its ends as exact balls; each is filled from the
other where it is asked for first. FLINT's precision is one for the whole process, so it is set and
restored under a lock; `_prec`, the number behind `ctx.prec`, costs no conversion to digits.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from math import floor, pi
from threading import RLock
from typing import Any, TypeAlias

from flint import arb, ctx
from mpmath.libmp import from_man_exp

from intervals.functions import DECREASING

Ball: TypeAlias = Any  # flint.arb, which has no types
Arguments: TypeAlias = tuple[Ball, ...]
Ends: TypeAlias = tuple[Ball, Ball]
Method: TypeAlias = Callable[..., Any]

BY_MPMATH: dict[str, Method] = {}  # what is replaced: filled in by who loads this

_GUARD = 30  # bits beyond the precision: one result in 10^8 is not settled
_MOST = 64  # the largest power by multiplication
_ZERO, _TWO, _TEN = arb(0), arb(2), arb(10)
_FAR = arb(1 << 20)  # what grows may overflow beyond
_GROWING = frozenset({"exp", "exp2", "exp10", "expm1", "sinh", "cosh"})
_NAMES = ("exp", "expm1", "log", "log1p", "atan", "asin", "acos", "sinh", "cosh", "tanh", "asinh")
_FUNCTIONS: dict[str, Callable[[Ball], Ball]] = {
    **{name: getattr(arb, name) for name in (*_NAMES, "acosh", "atanh", "sqrt")},
    "cbrt": lambda x: x.root(3),
    "exp2": lambda x: _TWO**x,
    "exp10": lambda x: _TEN**x,
    "log2": lambda x: x.log_base(2),
    "log10": lambda x: x.log_base(10),
}
_LOCK = RLock()
_context: Any = ctx
_new: Callable[[type], Any] = object.__new__
if not hasattr(ctx, "_prec"):
    raise ImportError("this python-flint keeps its precision elsewhere")


# -- the ends --------------------------------------------------------------------------------------


def _fill(self: Any, name: str) -> Any:
    """Fill in the ends in the form that is not there yet (as Interval.__getattr__)."""
    if name == "_balls":
        low = _ball(self._lo)
        self._balls = low, low if self._hi == self._lo else _ball(self._hi)
    elif name in {"_lo", "_hi"}:
        self._lo, self._hi = map(_raw, self._balls)
    else:
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
    return object.__getattribute__(self, name)


def _ball(raw: tuple[int, int, int, int]) -> Ball:
    return arb((-raw[1] if raw[0] else raw[1], raw[2]))


def _raw(end: Ball) -> Any:
    man, exp = end.man_exp()
    return from_man_exp(int(man), int(exp))


def _make(like: Any, ends: Ends, precision: int) -> Any:
    result = _new(type(like))
    result._balls = ends
    result.precision = precision
    return result


def _bounds(self: Any, other: Any) -> tuple[Any, Any, Any, Any]:
    """Return the ends of both as exact balls, which compare as numbers do."""
    if type(other) is type(self):
        return *self._balls, *other._balls
    if type(other) is int:
        number = arb(other)
        return *self._balls, number, number
    ends: tuple[Any, Any, Any, Any] = BY_MPMATH["_bounds"](self, other)
    return ends


def _range(function: Callable[..., Ball], least: Arguments, most: Arguments, p: int) -> Ends | None:
    """Return a function's values at two places, rounded down and up to p bits: see the theorem."""
    with _LOCK:
        saved = _context._prec
        try:
            _context._prec = p + _GUARD
            x = function(*least)
            y = x if least == most else function(*most)
            if x.is_exact() and y.is_exact() and x.bits() <= p and y.bits() <= p:
                low, high = x, y
            else:
                upper, lower = x.upper(), y.lower()
                _context._prec = p
                low, high = x.lower(), y.upper()
                if not (low == upper.lower() and high == lower.upper()):
                    return None
            return (low, high) if low.is_finite() and high.is_finite() else None
        finally:
            _context._prec = saved


# -- arithmetic ------------------------------------------------------------------------------------


def _add(self: Any, value: Any) -> Any:
    """Return the sum; `_prec` is set without a lock, as CPython switches threads at calls only."""
    p = self.precision
    if type(value) is type(self):
        c, d = value._balls
        p = p if p >= value.precision else value.precision
    elif type(value) is int:
        c = d = arb(value)
    else:
        return BY_MPMATH["__add__"](self, value)
    a, b = self._balls
    saved = _context._prec
    try:
        _context._prec = p
        low = a + c
        high = b + d
    finally:
        _context._prec = saved
    if not (low.is_exact() and high.is_exact()):
        ends = _range(operator.add, (a, c), (b, d), p)
        return _make(self, ends, p) if ends else BY_MPMATH["__add__"](self, value)
    result = _new(type(self))
    result._balls = low, high
    result.precision = p
    return result


def _arithmetic(
    name: str,
    operation: Callable[[Ball, Ball], Ball],
    corners: Callable[[Ball, Ball, Ball, Ball], tuple[Ends, Ends] | None],
) -> Method:
    """Return the method for an operation, given where its range over two intervals has its ends."""

    def method(self: Any, value: Any) -> Any:
        p = self.precision
        if type(value) is type(self):
            c, d = value._balls
            p = p if p >= value.precision else value.precision
        elif type(value) is int:
            c = d = arb(value)
        else:
            return BY_MPMATH[name](self, value)
        a, b = self._balls
        places = corners(a, b, c, d)
        ends = places and _range(operation, places[0], places[1], p)
        return _make(self, ends, p) if ends else BY_MPMATH[name](self, value)

    method.__name__ = method.__qualname__ = name
    return method


def _of_product(a: Ball, b: Ball, c: Ball, d: Ball) -> tuple[Ends, Ends] | None:
    """Return the corners of [a, b] x [c, d] with the least and the largest product."""
    if a >= _ZERO:
        return (a if c >= _ZERO else b, c), (b if d >= _ZERO else a, d)
    if c >= _ZERO:
        return (a, d), (b, d if b >= _ZERO else c)
    if b <= _ZERO:
        return (b if d <= _ZERO else a, d), (a, c)
    return ((b, c), (a, c)) if d <= _ZERO else None


def _of_quotient(a: Ball, b: Ball, c: Ball, d: Ball) -> tuple[Ends, Ends] | None:
    """Return the corners of [a, b] x [c, d] with the least and the largest quotient."""
    if c > _ZERO:
        return (a, c if a < _ZERO else d), (b, d if b < _ZERO else c)
    if d < _ZERO:
        return (b, d if b > _ZERO else c), (a, c if a > _ZERO else d)
    return None


def _negative(self: Any) -> Any:
    low, high = self._balls
    return _make(self, (high.neg(True), low.neg(True)), self.precision)


def _absolute(self: Any) -> Any:
    low, high = self._balls
    if low >= _ZERO:
        return self
    if high <= _ZERO:
        return -self
    top = low.neg(True)
    return _make(self, (_ZERO, top if top > high else high), self.precision)


def _square(self: Any) -> Any:
    x = abs(self)
    return x * x


def _power(self: Any, n: Any) -> Any:
    ends = None
    if type(n) is int and 0 < n <= _MOST:
        low, high = (self if n % 2 else abs(self))._balls
        ends = _range(operator.pow, (low, n), (high, n), self.precision)
    return _make(self, ends, self.precision) if ends else BY_MPMATH["__pow__"](self, n)


# -- elementary functions --------------------------------------------------------------------------


def _elementary(name: str) -> Method:
    """Return the method for a function that is monotone on its domain; outside it is NaN."""
    function, grows, falls = _FUNCTIONS[name], name in _GROWING, name in DECREASING

    def method(self: Any) -> Any:
        low, high = self._balls
        p, ends = self.precision, None
        if not grows or (low > -_FAR and high < _FAR):
            low, high = (high, low) if falls else (low, high)
            ends = _range(function, (low,), (high,), p)
        return _make(self, ends, p) if ends else BY_MPMATH["_monotone"](self, name)

    method.__name__ = method.__qualname__ = name
    return method


_BY_NAME = {name: _elementary(name) for name in _FUNCTIONS}


def _monotone(self: Any, name: str) -> Any:
    method = _BY_NAME.get(name)
    return method(self) if method else BY_MPMATH["_monotone"](self, name)


def _circular(self: Any, part: int) -> Any:
    """Return sin X for part 0, cos X for part 1.

    sin(x + part pi/2) is monotone where floor(x/pi + (part + 1)/2) = n, up if n is even. Floats,
    which err by 1e-9, tell n where they are farther from its ends.
    """
    low, high = self._balls
    p, ends, shift = self.precision, None, (part + 1) / 2
    first, last = float(low) / pi + shift, float(high) / pi + shift
    if first > -1e6 and last < 1e6:
        n = floor(first)
        if first - n > 1e-6 and last - n < 1 - 1e-6:
            least, most = ((high,), (low,)) if n % 2 else ((low,), (high,))
            ends = _range(arb.cos if part else arb.sin, least, most, p)
    return _make(self, ends, p) if ends else BY_MPMATH["sincos"](self)[part]


def _sincos(self: Any) -> Any:
    return _circular(self, 0), _circular(self, 1)


BY_FLINT: dict[str, Method] = {
    **{name: _BY_NAME[name] for name in ("sqrt", "exp", "log")},
    "__getattr__": _fill,
    "__neg__": _negative,
    "__abs__": _absolute,
    "__pow__": _power,
    "__add__": _add,
    "__radd__": _add,
    "__sub__": _arithmetic("__sub__", operator.sub, lambda a, b, c, d: ((a, d), (b, c))),
    "__mul__": _arithmetic("__mul__", operator.mul, _of_product),
    "__rmul__": _arithmetic("__rmul__", operator.mul, _of_product),
    "__truediv__": _arithmetic("__truediv__", operator.truediv, _of_quotient),
    "sqr": _square,
    "sin": lambda self: _circular(self, 0),
    "cos": lambda self: _circular(self, 1),
    "sincos": _sincos,
    "_monotone": _monotone,
    "_bounds": _bounds,
}
