"""Interval: one closed bounded interval of reals, at any precision.

Endpoints are dyadic rationals held as libmp numbers; + - * / sqrt are libmp's with directed
rounding, sin cos exp log are this package's own with proved remainders, rounded to the next
number. So each of these, sqr and x**n (n >= 0) return the tightest enclosure of the range at their
precision, and X within Y implies op(X) within op(Y). The precision in bits travels with the
number: a result has the larger precision of its operands.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from mpmath.libmp import (
    fone,
    from_float,
    from_int,
    from_man_exp,
    from_rational,
    fzero,
    mpf_add,
    mpf_cmp,
    mpf_div,
    mpf_lt,
    mpf_mul,
    mpf_neg,
    mpf_pos,
    mpf_sqrt,
    mpf_sub,
)

from intervals.elementary import tightest
from intervals.elementary.constants import pi_fixed
from intervals.elementary.tightest import DOWN, UP
from intervals.elementary.tightest import Raw as _Raw
from intervals.errors import DomainError, Undecided
from intervals.exact import Exact, decimal_down, decimal_up, fraction

_ZERO: _Raw = fzero
_ONE: _Raw = fone
_MINUS_ONE: _Raw = mpf_neg(fone)


class Interval:
    """The set of reals between two exact endpoints, `inf <= x <= sup`.

    Interval("0.2121") is the tightest enclosure of 2121/10000 at `precision` bits,
    Interval("1.11", "1.15") that of a range; ints, Fractions and "7/5" enter the same way. A
    float raises TypeError; Interval.from_float(x) takes the binary number itself.

    Every operation returns a superset of {op(x, y): x in X, y in Y} (the inclusion principle).
    """

    __slots__ = ("_hi", "_lo", "precision")
    _lo: _Raw
    _hi: _Raw
    precision: int

    def __init__(self, lower: Exact, upper: Exact | None = None, *, precision: int = 53) -> None:
        low = fraction(lower)
        high = low if upper is None else fraction(upper)
        if low > high:
            raise ValueError(f"reversed interval: {lower} > {upper}")
        self.precision = _checked(precision)
        self._lo = _round(low, precision, DOWN)
        self._hi = _round(high, precision, UP)

    @classmethod
    def from_float(cls, value: float, *, precision: int = 53) -> Interval:
        """Enclose the binary number `value`, exactly from 53 bits on.

        NaN, inf and what no binary64 number equals (2^53 + 1, Fraction(1, 3)) raise ValueError.
        """
        number = float(value)
        if number != value or number - number != 0:
            raise ValueError(f"not a finite binary64 number: {value!r}")
        raw, p = from_float(number), _checked(precision)
        return _make(mpf_pos(raw, p, DOWN), mpf_pos(raw, p, UP), p)

    @classmethod
    def pi(cls, *, precision: int = 53) -> Interval:
        """Enclose pi."""
        bits = _checked(precision) + 4
        low = pi_fixed(bits)
        return cls(Fraction(low, 1 << bits), Fraction(low + 1, 1 << bits), precision=precision)

    # -- the set -------------------------------------------------------------------------------

    @property
    def inf(self) -> Fraction:
        """The exact lower endpoint."""
        return _fraction(self._lo)

    @property
    def sup(self) -> Fraction:
        """The exact upper endpoint."""
        return _fraction(self._hi)

    @property
    def mid(self) -> Fraction:
        """The exact midpoint."""
        return (self.inf + self.sup) / 2

    @property
    def wid(self) -> Fraction:
        """The exact width."""
        return self.sup - self.inf

    @property
    def mag(self) -> Fraction:
        """The largest absolute value."""
        return max(abs(self.inf), abs(self.sup))

    @property
    def mig(self) -> Fraction:
        """The smallest absolute value."""
        return Fraction(0) if self.contains_zero() else min(abs(self.inf), abs(self.sup))

    def contains(self, value: Exact | Interval) -> bool:
        """Whether a number or an interval is a subset of this one."""
        if isinstance(value, Interval):
            return _compare(self._lo, value._lo) <= 0 <= _compare(self._hi, value._hi)
        return self.inf <= fraction(value) <= self.sup

    def contains_zero(self) -> bool:
        """Whether 0 is in the interval."""
        return _compare(self._lo, _ZERO) <= 0 <= _compare(self._hi, _ZERO)

    def hull(self, other: Interval) -> Interval:
        """Return the smallest interval that holds both."""
        low = other._lo if mpf_lt(other._lo, self._lo) else self._lo
        high = self._hi if mpf_lt(other._hi, self._hi) else other._hi
        return _make(low, high, max(self.precision, other.precision))

    def intersection(self, other: Interval) -> Interval | None:
        """Return the common part, None where there is none."""
        low = self._lo if mpf_lt(other._lo, self._lo) else other._lo
        high = other._hi if mpf_lt(other._hi, self._hi) else self._hi
        if mpf_lt(high, low):
            return None
        return _make(low, high, max(self.precision, other.precision))

    def with_precision(self, precision: int) -> Interval:
        """Return an enclosure of this interval at another precision."""
        p = _checked(precision)
        return _make(mpf_pos(self._lo, p, DOWN), mpf_pos(self._hi, p, UP), p)

    # -- arithmetic ----------------------------------------------------------------------------

    def _other(self, value: object) -> Interval | None:
        if isinstance(value, Interval):
            return value
        if isinstance(value, int):
            raw = from_int(value)
            return _make(raw, raw, self.precision)
        if isinstance(value, Fraction):
            return Interval(value, precision=self.precision)
        if isinstance(value, float):
            raise TypeError(f"{value!r} is a float, not a decimal: use Interval.from_float")
        return None

    def __neg__(self) -> Interval:
        return _make(mpf_neg(self._hi), mpf_neg(self._lo), self.precision)

    def __pos__(self) -> Interval:
        return self

    def __add__(self, value: Interval | Fraction | int) -> Interval:
        other = self._other(value)
        if other is None:
            return NotImplemented
        p = max(self.precision, other.precision)
        return _make(mpf_add(self._lo, other._lo, p, DOWN), mpf_add(self._hi, other._hi, p, UP), p)

    __radd__ = __add__

    def __sub__(self, value: Interval | Fraction | int) -> Interval:
        other = self._other(value)
        if other is None:
            return NotImplemented
        p = max(self.precision, other.precision)
        return _make(mpf_sub(self._lo, other._hi, p, DOWN), mpf_sub(self._hi, other._lo, p, UP), p)

    def __rsub__(self, value: Fraction | int) -> Interval:
        return -self + value

    def __mul__(self, value: Interval | Fraction | int) -> Interval:
        other = self._other(value)
        if other is None:
            return NotImplemented
        p = max(self.precision, other.precision)
        a, b, c, d = self._lo, self._hi, other._lo, other._hi
        if not a[0]:  # [0] is the sign bit: X lies in x >= 0
            low = mpf_mul(b if c[0] else a, c, p, DOWN)
            return _make(low, mpf_mul(a if d[0] else b, d, p, UP), p)
        if not c[0]:
            low = mpf_mul(d if a[0] else c, a, p, DOWN)
            return _make(low, mpf_mul(c if b[0] else d, b, p, UP), p)
        if b[0]:
            return -(-self * other)
        if d[0]:
            return -(self * -other)
        products = [mpf_mul(x, y) for x in (a, b) for y in (c, d)]
        low, high = _extremes(products)
        return _make(mpf_pos(low, p, DOWN), mpf_pos(high, p, UP), p)

    __rmul__ = __mul__

    def __truediv__(self, value: Interval | Fraction | int) -> Interval:
        other = self._other(value)
        if other is None:
            return NotImplemented
        if other.contains_zero():
            raise DomainError("division by an interval that contains 0")
        p = max(self.precision, other.precision)
        if other._hi[0]:
            return (-self) / (-other)
        a, b, c, d = self._lo, self._hi, other._lo, other._hi
        low = mpf_div(a, c if a[0] else d, p, DOWN)
        high = mpf_div(b, d if b[0] else c, p, UP)
        return _make(low, high, p)

    def __rtruediv__(self, value: Fraction | int) -> Interval:
        other = self._other(value)
        return NotImplemented if other is None else other / self

    def __abs__(self) -> Interval:
        if not self._lo[0]:
            return self
        if _compare(self._hi, _ZERO) <= 0:
            return -self
        top = mpf_neg(self._lo)
        return _make(_ZERO, self._hi if mpf_lt(top, self._hi) else top, self.precision)

    def sqr(self) -> Interval:
        """Return the square, without the dependency of x * x."""
        x = abs(self)
        return x * x

    def __pow__(self, n: int) -> Interval:
        """Return the n-th power, n an int; DomainError for n < 0 and an interval with 0."""
        if not isinstance(n, int):
            return NotImplemented
        if n < 0:
            return 1 / self**-n
        if n == 0:
            return Interval(1, precision=self.precision)
        x = abs(self) if n % 2 == 0 else self
        p = self.precision
        return _make(_power(x._lo, n, p, DOWN), _power(x._hi, n, p, UP), p)

    # -- elementary functions ------------------------------------------------------------------

    def sqrt(self) -> Interval:
        """Return the square root; DomainError where the interval reaches below 0."""
        if self._lo[0]:
            raise DomainError("sqrt of an interval with negative numbers")
        p = self.precision
        return _make(mpf_sqrt(self._lo, p, DOWN), mpf_sqrt(self._hi, p, UP), p)

    def sincos(self) -> tuple[Interval, Interval]:
        """Return (sin X, cos X): values at the ends, and +-1 where a quarter turn is passed."""
        p = self.precision
        sin_low, cos_low, n_low = tightest.sincos(self._lo, p)
        if self._lo == self._hi:
            return _make(*sin_low, p), _make(*cos_low, p)
        sin_high, cos_high, n_high = tightest.sincos(self._hi, p)
        sin = _with_extrema(_hull_raw(sin_low, sin_high), n_low, n_high, 1, p)
        return sin, _with_extrema(_hull_raw(cos_low, cos_high), n_low, n_high, 0, p)

    def sin(self) -> Interval:
        """Return sin X."""
        return self.sincos()[0]

    def cos(self) -> Interval:
        """Return cos X."""
        return self.sincos()[1]

    def exp(self) -> Interval:
        """Return exp X; OverflowError where the interval reaches beyond +-2^30."""
        return self._increasing(tightest.exp)

    def log(self) -> Interval:
        """Return the natural logarithm; DomainError where the interval reaches 0 or below."""
        if _compare(self._lo, _ZERO) <= 0:
            raise DomainError("log of an interval that reaches 0 or below")
        return self._increasing(tightest.log)

    def _increasing(self, function: Callable[[_Raw, int], tuple[_Raw, _Raw]]) -> Interval:
        low, high = function(self._lo, self.precision)
        if self._lo != self._hi:
            _, high = function(self._hi, self.precision)
        return _make(low, high, self.precision)

    # -- comparisons ---------------------------------------------------------------------------

    def _ordered(self, value: object, strict: bool) -> bool:
        """Return whether X < Y (X <= Y if not strict) for all pairs; Undecided if some do."""
        if isinstance(value, Fraction):
            below, above = _sign(self.sup - value), _sign(self.inf - value)
        else:
            other = self._other(value)
            if other is None:
                raise TypeError(f"an Interval cannot be compared with {value!r}")
            below, above = _compare(self._hi, other._lo), _compare(self._lo, other._hi)
        if below < 0 or (below == 0 and not strict):
            return True
        if above > 0 or (above == 0 and strict):
            return False
        raise Undecided(f"{self} and {self._other(value)} overlap")

    def __lt__(self, value: Interval | Fraction | int) -> bool:
        return self._ordered(value, strict=True)

    def __le__(self, value: Interval | Fraction | int) -> bool:
        return self._ordered(value, strict=False)

    def __gt__(self, value: Interval | Fraction | int) -> bool:
        return not self._ordered(value, strict=False)

    def __ge__(self, value: Interval | Fraction | int) -> bool:
        return not self._ordered(value, strict=True)

    def is_positive(self) -> bool:
        """Whether every number in the interval is > 0 (False also says: not known)."""
        return _compare(self._lo, _ZERO) > 0

    def is_negative(self) -> bool:
        """Whether every number in the interval is < 0 (False also says: not known)."""
        return _compare(self._hi, _ZERO) < 0

    def __eq__(self, other: object) -> bool:
        """Return equality as sets (IEEE 1788 `equal`), not of the unknown numbers inside.

        Comparing with a number raises TypeError: a quiet False would pass for a proof.
        """
        if isinstance(other, int | float | Fraction):
            raise TypeError("an Interval is no number: use contains, <, > or a second Interval")
        if not isinstance(other, Interval):
            return NotImplemented
        return self._lo == other._lo and self._hi == other._hi

    def __hash__(self) -> int:
        return hash((self._lo, self._hi))

    def __bool__(self) -> bool:
        raise TypeError("the truth of an interval is not defined: compare it with something")

    # -- text ----------------------------------------------------------------------------------

    def __repr__(self) -> str:
        """Return what evaluates to an equal interval, given the names Interval and Fraction."""
        return f"Interval({_literal(self._lo)}, {_literal(self._hi)}, precision={self.precision})"

    def __str__(self) -> str:
        digits = max(3, self.precision * 3 // 10)
        return f"[{decimal_down(self.inf, digits)}, {decimal_up(self.sup, digits)}]"

    def __reduce__(self) -> tuple[Callable[..., Interval], tuple[Any, ...]]:
        return _restore, (_dyadic(self._lo), _dyadic(self._hi), self.precision)


def _checked(precision: int) -> int:
    if precision < 2:
        raise ValueError("precision is at least 2 bits")
    return precision


def _make(lo: _Raw, hi: _Raw, precision: int) -> Interval:
    new = object.__new__(Interval)
    new._lo = lo
    new._hi = hi
    new.precision = precision
    return new


def _round(value: Fraction, precision: int, direction: str) -> _Raw:
    raw: _Raw = from_rational(value.numerator, value.denominator, precision, direction)
    return raw


def _dyadic(raw: _Raw) -> tuple[int, int]:
    """Return (m, e) with raw = m 2^e as Python's ints: gmpy2's integers stay inside."""
    man = int(raw[1])
    return -man if raw[0] else man, int(raw[2])


def _restore(low: tuple[int, int], high: tuple[int, int], precision: int) -> Interval:
    """Return the interval with these endpoints m 2^e (for pickle and copy)."""
    return _make(from_man_exp(*low), from_man_exp(*high), precision)


def _fraction(raw: _Raw) -> Fraction:
    man, exp = _dyadic(raw)
    return Fraction(man << exp) if exp >= 0 else Fraction(man, 1 << -exp)


def _literal(raw: _Raw) -> str:
    """Return Python's text of an endpoint: a string that `fraction` reads, or an expression."""
    man, exp = _dyadic(raw)
    if man.bit_length() + abs(exp) < 13_000:  # below 4000 digits
        return f"'{_fraction(raw)}'"
    return f"{man:#x} * Fraction(2) ** {exp}"


def _compare(x: _Raw, y: _Raw) -> int:
    """Return a number that has the sign of x - y."""
    result: int = mpf_cmp(x, y)
    return result


def _sign(value: Fraction) -> int:
    return (value > 0) - (value < 0)


def _power(x: _Raw, n: int, precision: int, direction: str) -> _Raw:
    """Return x^n rounded, n >= 1: exact products (the powers wanted here are small)."""
    result = x
    for _ in range(n - 1):
        result = mpf_mul(result, x)
    rounded: _Raw = mpf_pos(result, precision, direction)
    return rounded


def _extremes(values: list[_Raw]) -> tuple[_Raw, _Raw]:
    low = high = values[0]
    for value in values[1:]:
        if mpf_lt(value, low):
            low = value
        elif mpf_lt(high, value):
            high = value
    return low, high


def _hull_raw(x: tuple[_Raw, _Raw], y: tuple[_Raw, _Raw]) -> tuple[_Raw, _Raw]:
    return (
        y[0] if mpf_lt(y[0], x[0]) else x[0],
        x[1] if mpf_lt(y[1], x[1]) else y[1],
    )


def _with_extrema(
    ends: tuple[_Raw, _Raw], n_low: int, n_high: int, top: int, precision: int
) -> Interval:
    """Add the maximum 1 at m pi/2, m = top mod 4, and the minimum -1 at m = top + 2 mod 4.

    n_low and n_high are the floors of the ends over pi/2, so the multiples m pi/2 inside have
    n_low < m <= n_high, or are the lower end itself, which is then 0. Between them both functions
    are monotone.
    """
    low, high = ends
    if (n_high - top) // 4 > (n_low - top) // 4:
        high = _ONE
    if (n_high - top - 2) // 4 > (n_low - top - 2) // 4:
        low = _MINUS_ONE
    return _make(low, high, precision)
