"""The operations of `Interval` on FLINT's balls, rounded to the same bits as by libmp.

Theorem. Let a ball contain the real y, and let l <= y <= u be its ends. If l and u have the same
largest number of p bits that is not above them, this is the largest one <= y, since rounding down
is monotone; so for rounding up. An exact ball is y itself.

What this does not settle, and what raises, is left to the method that is replaced here. Beside
libmp's ends an Interval has the slots `_low` and `_high`, its ends as exact balls; each pair is
filled from the other where it is asked for first. FLINT's precision is one for the whole process;
`_prec`, the number behind `ctx.prec`, costs no conversion to digits. CPython switches threads, and
heeds signals, at calls only: where the precision is another, there are operators alone.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from functools import partial
from itertools import starmap
from math import pi
from operator import methodcaller
from typing import Any, TypeAlias

from flint import arb, ctx
from mpmath.libmp import from_man_exp

from intervals.functions import DOMAINS, STEPS, TABLE

Ball: TypeAlias = Any  # flint.arb, which has no types
Ends: TypeAlias = tuple[Ball, Ball]
Method: TypeAlias = Callable[..., Any]

# Filled in by who loads this: the type, and what is replaced
Interval: Any = None
BY_MPMATH: dict[str, Method] = {}

_GUARD = 30  # bits beyond the precision: one result in 10^8 is not settled
_MOST = 64  # the largest power by multiplication
_TURNS = 1 / pi
_ZERO, _TWO, _TEN = arb(0), arb(2), arb(10)
_FAR = (arb(-(1 << 20)), arb(1 << 20))  # what grows may overflow beyond
_LIMITS = {  # where the values are finite
    **dict.fromkeys(("exp", "exp2", "exp10", "expm1", "sinh", "cosh"), _FAR),
    **{
        name: (arb(domain.low), arb("inf" if domain.high is None else domain.high))
        for name, domain in DOMAINS.items()
        if not domain.closed
    },
}
_OTHERS = {*STEPS, "sin", "cos", "tan"}  # not monotone, or exact
_FUNCTIONS: dict[str, Callable[[Ball], Ball]] = {
    **{name: getattr(arb, name) for name in {*TABLE} - _OTHERS if hasattr(arb, name)},
    "cbrt": methodcaller("root", 3),
    "exp2": partial(operator.pow, _TWO),
    "exp10": partial(operator.pow, _TEN),
    "log2": methodcaller("log_base", 2),
    "log10": methodcaller("log_base", 10),
}
_context: Any = ctx
_new: Callable[[type], Any] = object.__new__
if not hasattr(ctx, "_prec"):
    raise ImportError("this python-flint keeps its precision elsewhere")


# -- the ends --------------------------------------------------------------------------------------


def take(interval: Any, by_mpmath: dict[str, Method]) -> None:
    """Compute for this type from now on, and make its ends by libmp from balls where asked for.

    Not by `__getattr__`: a type that has one is read more slowly in all of its slots.
    """
    global Interval  # noqa: PLW0603 - there is one
    if Interval is None:
        Interval = interval
        BY_MPMATH.update(by_mpmath)
        low, high = interval._given_lo, interval._given_hi = interval._lo, interval._hi  # the slots
        interval._lo, interval._hi = property(_lower, low.__set__), property(_upper, high.__set__)


def _lower(self: Any) -> Any:
    try:
        return self._given_lo
    except AttributeError:
        self._given_lo = raw = _raw(self._low)
        return raw


def _upper(self: Any) -> Any:
    try:
        return self._given_hi
    except AttributeError:
        self._given_hi = raw = _raw(self._high)
        return raw


def _balls(x: Any) -> Ends:
    """Return the ends as exact balls, filled in from libmp's."""
    try:
        return x._low, x._high
    except AttributeError:
        low = x._low = _ball(x._lo)
        high = x._high = low if x._hi == x._lo else _ball(x._hi)
        return low, high


def _ball(raw: tuple[int, int, int, int]) -> Ball:
    return arb((-raw[1] if raw[0] else raw[1], raw[2]))


def _raw(end: Ball) -> Any:
    man, exp = end.man_exp()
    return from_man_exp(int(man), int(exp))


def _make(low: Ball, high: Ball, precision: int) -> Any:
    result = _new(Interval)
    result._low = low
    result._high = high
    result.precision = precision
    return result


def _bounds(self: Any, other: Any) -> tuple[Any, Any, Any, Any]:
    """Return the ends of both as exact balls, which compare as numbers do."""
    if type(other) is Interval:
        return *_balls(self), *_balls(other)
    if type(other) is int:
        number = arb(other)
        return *_balls(self), number, number
    ends: tuple[Any, Any, Any, Any] = BY_MPMATH["_bounds"](self, other)
    return ends


def _operator(function: Any) -> Any:
    """Return f with f[x] = function(x), for a function in C: no call in the sense above."""
    return type("", (), {"__slots__": (), "__getitem__": staticmethod(function)})()


_down, _up, _next = map(_operator, (arb.lower, arb.upper, next))


def _range(p: int, bits: int, function: Any, least: Any, most: Any) -> Any:
    """Return [function[least], function[most]] rounded outward from `bits` to p bits, or None.

    Without `most` both are the same. `_next` takes them from an iterator in C that computes them.
    """
    saved = _context._prec
    _context._prec = bits
    x = function[least]
    y = x if most is None else function[most]
    exact = x == x and y == y  # noqa: PLR0124 - certainly: no ball of several numbers does
    upper, lower = (x, y) if exact else (_up[x], _down[y])
    _context._prec = p
    low = _down[x]
    high = _up[y]
    settled = exact or (_down[upper] == low and _up[lower] == high)
    _context._prec = saved
    if not settled:
        return None
    result = _new(Interval)
    result._low = low
    result._high = high
    result.precision = p
    return result


# -- arithmetic ------------------------------------------------------------------------------------


def _arithmetic(
    name: str,
    operation: Callable[[Ball, Ball], Ball],
    corners: Callable[[Ball, Ball, Ball, Ball], tuple[Ends, Ends] | None],
    factor: int = 2,
) -> Method:
    """Return the method for an operation, given where its range over two intervals has its ends.

    Its values are exact, mostly, at `factor` times the precision, if this is 2.
    """

    def method(self: Any, value: Any) -> Any:
        p = self.precision
        if type(value) is Interval:
            c, d = _balls(value)
            p = p if p >= value.precision else value.precision
        elif type(value) is int:
            c = d = arb(value)
        else:
            return BY_MPMATH[name](self, value)
        a, b = _balls(self)
        places, result = corners(a, b, c, d), None
        if places:
            values = starmap(operation, places)
            result = _range(p, factor * p + _GUARD, _next, values, values)
        return BY_MPMATH[name](self, value) if result is None else result

    method.__name__ = method.__qualname__ = name
    return method


_by_sums = _arithmetic("__add__", operator.add, lambda a, b, c, d: ((a, c), (b, d)))


def _add(self: Any, value: Any) -> Any:
    """Return the sum, with less around it where it is exact at first."""
    if type(value) is not Interval:
        return _by_sums(self, value)
    p, q = self.precision, value.precision
    p = p if p >= q else q
    try:
        a, b, c, d = self._low, self._high, value._low, value._high
    except AttributeError:
        return _by_sums(self, value)
    saved = _context._prec
    _context._prec = p + p + _GUARD
    x = a + c
    y = b + d
    _context._prec = p
    low = _down[x]
    high = _up[y]
    _context._prec = saved
    if x == x and y == y:  # noqa: PLR0124 - see `_range`
        result = _new(Interval)
        result._low = low
        result._high = high
        result.precision = p
        return result
    return _by_sums(self, value)


def _of_product(a: Ball, b: Ball, c: Ball, d: Ball) -> tuple[Ends, Ends] | None:
    """Return the corners of [a, b] x [c, d] with the least and the largest product."""
    if a >= _ZERO:
        return (a if c >= _ZERO else b, c), (b if d >= _ZERO else a, d)
    if c >= _ZERO:
        return (a, d), (b, d if b >= _ZERO else c)
    if b <= _ZERO:
        return (b if d <= _ZERO else a, d), (a, c)
    if d <= _ZERO:
        return (b, c), (a, c)
    least, most = _lesser(a * d, (a, d), b * c, (b, c)), _lesser(-b * d, (b, d), -a * c, (a, c))
    return (least, most) if least and most else None


def _lesser(x: Ball, of_x: Ends, y: Ball, of_y: Ends) -> Ends | None:
    """Return where the lesser of two values is found, None where balls do not tell."""
    return of_x if x <= y else of_y if y <= x else None


def _of_quotient(a: Ball, b: Ball, c: Ball, d: Ball) -> tuple[Ends, Ends] | None:
    """Return the corners of [a, b] x [c, d] with the least and the largest quotient."""
    if c > _ZERO:
        return (a, c if a < _ZERO else d), (b, d if b < _ZERO else c)
    if d < _ZERO:
        return (b, d if b > _ZERO else c), (a, c if a > _ZERO else d)
    return None


def _negative(self: Any) -> Any:
    low, high = _balls(self)
    return _make(high.neg(True), low.neg(True), self.precision)


def _absolute(self: Any) -> Any:
    low, high = _balls(self)
    if low >= _ZERO:
        return self
    if high <= _ZERO:
        return -self
    top = low.neg(True)
    return _make(_ZERO, top if top > high else high, self.precision)


def _square(self: Any) -> Any:
    x = abs(self)
    return x * x


def _power(self: Any, n: Any) -> Any:
    result = None
    if type(n) is int and 0 < n <= _MOST:
        low, high = _balls(self if n % 2 else abs(self))
        p = self.precision
        values = map(operator.pow, (low, high), (n, n))
        result = _range(p, p + _GUARD, _next, values, values)
    return BY_MPMATH["__pow__"](self, n) if result is None else result


# -- elementary functions --------------------------------------------------------------------------


def _elementary(name: str) -> Method:
    """Return the method for a function that is monotone on its domain; outside it is NaN."""
    function, falls, limits = _operator(_FUNCTIONS[name]), TABLE[name].falls, _LIMITS.get(name)

    def method(self: Any) -> Any:
        low, high = _balls(self)
        result, p = None, self.precision
        if not limits or (limits[0] < low and high < limits[1]):
            least, most = (high, low) if falls else (low, high)
            result = _range(p, p + _GUARD, function, least, None if low is high else most)
        return BY_MPMATH["_monotone"](self, name) if result is None else result

    method.__name__ = method.__qualname__ = name
    return method


_BY_NAME = {name: _elementary(name) for name in _FUNCTIONS}


def _monotone(self: Any, name: str) -> Any:
    method = _BY_NAME.get(name)
    return method(self) if method else BY_MPMATH["_monotone"](self, name)


def _circular(part: int) -> Method:
    """Return the method for sin for part 0, for cos for part 1.

    sin(x + part pi/2) is monotone where floor(x/pi + (part + 1)/2) = n, up if n is even. Floats,
    which err by 1e-9, tell n where they are farther from its ends.
    """
    function, shift = _operator(arb.cos if part else arb.sin), (part + 1) / 2

    def method(self: Any) -> Any:
        low, high = _balls(self)
        result, p = None, self.precision
        first = float(low) * _TURNS + shift
        n = first // 1.0
        if first - n > 1e-6 and float(high) * _TURNS + shift - n < 1 - 1e-6 and -1e6 < n < 1e6:
            least, most = (high, low) if n % 2 else (low, high)
            result = _range(p, p + _GUARD, function, least, None if low is high else most)
        return BY_MPMATH["sincos"](self)[part] if result is None else result

    return method


_sin, _cos = map(_circular, (0, 1))


BY_FLINT: dict[str, Method] = {
    **{name: _BY_NAME[name] for name in ("sqrt", "exp", "log")},
    "__neg__": _negative,
    "__abs__": _absolute,
    "__pow__": _power,
    "__add__": _add,
    "__radd__": _add,
    "__sub__": _arithmetic("__sub__", operator.sub, lambda a, b, c, d: ((a, d), (b, c))),
    "__mul__": _arithmetic("__mul__", operator.mul, _of_product),
    "__rmul__": _arithmetic("__rmul__", operator.mul, _of_product),
    "__truediv__": _arithmetic("__truediv__", operator.truediv, _of_quotient, 1),
    "sqr": _square,
    "sin": _sin,
    "cos": _cos,
    "sincos": lambda self: (_sin(self), _cos(self)),
    "_monotone": _monotone,
    "_bounds": _bounds,
}
