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
from functools import cmp_to_key
from numbers import Number
from operator import index
from typing import Any

from mpmath.libmp import (
    from_int,
    from_man_exp,
    fzero,
    mpf_add,
    mpf_cmp,
    mpf_div,
    mpf_lt,
    mpf_mul,
    mpf_neg,
    mpf_pos,
    mpf_shift,
    mpf_sqrt,
    mpf_sub,
)

from intervals import display, ranges
from intervals.elementary.constants import pi_fixed
from intervals.elementary.tightest import DOWN, UP, Bounds
from intervals.elementary.tightest import Raw as _Raw
from intervals.errors import DomainError, Undecided
from intervals.exact import Exact, fraction, pair, refuse_equality
from intervals.functions import DOMAINS, Elementary
from intervals.raw import compare, dyadic, exact, extremes, from_bits, literal, rounded
from intervals.relations import Overlap, Relations, overlap_state

_ZERO: _Raw = fzero
_ordered_key = cmp_to_key(mpf_cmp)


class Interval(Relations[bool], Elementary):
    """The set of reals between two exact endpoints, `inf <= x <= sup`.

    Interval("0.2121") is the tightest enclosure of 2121/10000 at `precision` bits,
    Interval("1.11", "1.15") that of a range; ints, Fractions and "7/5" enter the same way. A
    float raises TypeError; Interval.from_float(x) takes the binary number itself. What `str`
    prints, such as "[1.11, 1.15]", is read as well, and "3.56?1". Interval(X) is X.

    Every operation returns a superset of {op(x, y): x in X, y in Y} (the inclusion principle).
    """

    __slots__ = ("_hi", "_lo", "precision")
    _lo: _Raw
    _hi: _Raw
    precision: int

    def __init__(
        self,
        lower: Exact | Interval,
        upper: Exact | Interval | None = None,
        *,
        precision: int | None = None,
    ) -> None:
        if isinstance(lower, Interval) or isinstance(upper, Interval):
            upper = lower if upper is None else upper
            given = [x for x in (lower, upper) if isinstance(x, Interval)]
            precision = precision or max(x.precision for x in given)
            lower = lower.inf if isinstance(lower, Interval) else lower
            upper = upper.sup if isinstance(upper, Interval) else upper
        low, high = pair(lower, upper)
        self.precision = precision = _checked(53 if precision is None else precision)
        self._lo = rounded(low, precision, DOWN)
        self._hi = rounded(high, precision, UP)

    @classmethod
    def from_float(cls, value: float, *, precision: int = 53) -> Interval:
        """Enclose the binary number `value`, exactly from 53 bits on.

        NaN, inf and what no binary64 number equals (2^53 + 1, Fraction(1, 3)) raise ValueError.
        """
        number = float(value)
        if number != value or number - number != 0:
            raise ValueError(f"not a finite binary64 number: {value!r}")
        raw = from_bits(number)
        return _outward(raw, raw, _checked(precision))

    @classmethod
    def from_midpoint(cls, mid: Exact, rad: Exact, *, precision: int = 53) -> Interval:
        """Enclose [mid - rad, mid + rad], rad >= 0."""
        m, r = fraction(mid), fraction(rad)
        return cls(m - r, m + r, precision=precision)

    @classmethod
    def pi(cls, *, precision: int = 53) -> Interval:
        """Enclose pi."""
        bits = _checked(precision) + 4
        low = pi_fixed(bits)
        return cls(Fraction(low, 1 << bits), Fraction(low + 1, 1 << bits), precision=precision)

    @classmethod
    def e(cls, *, precision: int = 53) -> Interval:
        """Enclose Euler's number e = exp 1."""
        return cls(1, precision=precision).exp()

    # -- the set -------------------------------------------------------------------------------

    @property
    def inf(self) -> Fraction:
        """The exact lower endpoint."""
        return exact(self._lo)

    @property
    def sup(self) -> Fraction:
        """The exact upper endpoint."""
        return exact(self._hi)

    @property
    def mid(self) -> Fraction:
        """The exact midpoint."""
        return (self.inf + self.sup) / 2

    @property
    def wid(self) -> Fraction:
        """The exact width."""
        return self.sup - self.inf

    @property
    def rad(self) -> Fraction:
        """The exact radius, half the width."""
        return self.wid / 2

    @property
    def mag(self) -> Fraction:
        """The largest absolute value."""
        return max(abs(self.inf), abs(self.sup))

    @property
    def mig(self) -> Fraction:
        """The smallest absolute value."""
        return max(Fraction(0), self.inf, -self.sup)

    def hull(self, other: Interval | Fraction | int) -> Interval:
        """Return the smallest interval that holds both."""
        other = self._required(other)
        low = other._lo if mpf_lt(other._lo, self._lo) else self._lo
        high = self._hi if mpf_lt(other._hi, self._hi) else other._hi
        return _outward(low, high, max(self.precision, other.precision))

    def intersection(self, other: Interval | Fraction | int) -> Interval | None:
        """Return the common part, None where there is none."""
        other = self._required(other)
        low = self._lo if mpf_lt(other._lo, self._lo) else other._lo
        high = other._hi if mpf_lt(other._hi, self._hi) else self._hi
        if mpf_lt(high, low):
            return None
        return _outward(low, high, max(self.precision, other.precision))

    __and__, __or__ = intersection, hull

    def __contains__(self, other: Interval | Exact) -> bool:
        """Return whether an interval, or an exact number, lies in this one."""
        return self.contains(other)

    def with_precision(self, precision: int) -> Interval:
        """Return an enclosure of this interval at another precision."""
        return _outward(self._lo, self._hi, _checked(precision))

    def bisect(self) -> tuple[Interval, Interval]:
        """Return two intervals whose union this is, cut at the midpoint or a number next to it."""
        middle = mpf_pos(mpf_shift(mpf_add(self._lo, self._hi), -1), self.precision, DOWN)
        if mpf_lt(middle, self._lo):
            middle = self._lo
        return _make(self._lo, middle, self.precision), _make(middle, self._hi, self.precision)

    def widen(self, radius: Exact) -> Interval:
        """Return an enclosure of [inf - radius, sup + radius], radius >= 0 exact."""
        r = fraction(radius)
        return self + Interval(-r, r, precision=self.precision)

    # -- arithmetic ----------------------------------------------------------------------------

    def _other(self, value: object) -> Interval | None:
        if isinstance(value, Interval):
            return value
        if isinstance(value, int):
            raw = from_int(value)
            return _make(raw, raw, self.precision)
        if isinstance(value, Fraction):
            return Interval(value, precision=self.precision)
        if isinstance(value, Number) and not isinstance(value, complex):
            return Interval(fraction(value), precision=self.precision)  # type: ignore[arg-type]
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
        other = value if type(value) is Interval else self._other(value)
        if other is None:
            return NotImplemented
        p = self.precision if self.precision >= other.precision else other.precision
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
        return _outward(*extremes(products), p)

    __rmul__ = __mul__

    def __truediv__(self, value: Interval | Fraction | int) -> Interval:
        other = self._other(value)
        if other is None:
            return NotImplemented
        a, b, c, d = self._lo, self._hi, other._lo, other._hi
        if (c[0] or c == _ZERO) and not d[0]:
            raise DomainError("division by an interval that contains 0")
        p = max(self.precision, other.precision)
        if c[0]:
            return (-self) / (-other)
        low = mpf_div(a, c if a[0] else d, p, DOWN)
        high = mpf_div(b, d if b[0] else c, p, UP)
        return _make(low, high, p)

    def __rtruediv__(self, value: Fraction | int) -> Interval:
        other = self._other(value)
        return NotImplemented if other is None else other / self

    def recip(self) -> Interval:
        """Return 1 / x."""
        return 1 / self

    def fma(self, factor: Interval | Fraction | int, term: Interval | Fraction | int) -> Interval:
        """Return x y + z, rounded once."""
        factor, term = self._required(factor), self._required(term)
        p = max(self.precision, factor.precision, term.precision)
        low, high = extremes(
            [mpf_mul(x, y) for x in (self._lo, self._hi) for y in (factor._lo, factor._hi)]
        )
        return _make(mpf_add(low, term._lo, p, DOWN), mpf_add(high, term._hi, p, UP), p)

    def cancel_minus(self, term: Interval | Fraction | int) -> Interval | None:
        """Return the tightest Z with term + Z containing X; None where term is wider than X."""
        term = self._required(term)
        if self.wid < term.wid:
            return None
        p = max(self.precision, term.precision)
        return _make(mpf_sub(self._lo, term._lo, p, DOWN), mpf_sub(self._hi, term._hi, p, UP), p)

    def cancel_plus(self, term: Interval | Fraction | int) -> Interval | None:
        """Return the tightest Z with Z - term containing X; None where term is wider than X."""
        return self.cancel_minus(-self._required(term))

    def __abs__(self) -> Interval:
        if not self._lo[0]:
            return self
        if compare(self._hi, _ZERO) <= 0:
            return -self
        top = mpf_neg(self._lo)
        return _make(_ZERO, self._hi if mpf_lt(top, self._hi) else top, self.precision)

    def sqr(self) -> Interval:
        """Return the square, without the dependency of x * x."""
        x, p = abs(self), self.precision
        return _make(mpf_mul(x._lo, x._lo, p, DOWN), mpf_mul(x._hi, x._hi, p, UP), p)

    def __pow__(self, n: Interval | Fraction | int) -> Interval:
        """Return x^n; for an int n also below 0, else see `pow`."""
        if not isinstance(n, int):
            return self.pow(n) if isinstance(n, Interval | Fraction) else NotImplemented
        if n == 0:
            return Interval(1, precision=self.precision)
        if n < 0:
            return self._negative_power(n)
        return (abs(self) if n % 2 == 0 else self)._with(ranges.integer_power, n)

    def _negative_power(self, n: int) -> Interval:
        """Return x^n, n < 0: decreasing on x > 0, and even or odd."""
        if self._hi[0]:
            return (-self) ** n if n % 2 == 0 else -((-self) ** n)
        if not self.certainly_positive():
            raise DomainError("a negative power of an interval that contains 0")
        return self._with(ranges.integer_power, n)

    def __rpow__(self, base: Fraction | int) -> Interval:
        if isinstance(base, float):  # which Fraction.__pow__ makes of itself
            raise TypeError(
                f"{base!r} is a float: write pow(Fraction(p, q), x) of intervals for p/q"
            )
        other = self._other(base)
        return NotImplemented if other is None else other.pow(self)

    # -- elementary functions ------------------------------------------------------------------

    def _with(self, range_of: Callable[..., Bounds], *details: Any) -> Interval:
        """Return a range over this interval, at its precision."""
        return _make(*range_of((self._lo, self._hi), *details, self.precision), self.precision)

    def _with_other(self, range_of: Callable[..., Bounds], other: Interval) -> Interval:
        """Return a range over this interval and another one, at the larger precision."""
        p = max(self.precision, other.precision)
        return _make(*range_of((self._lo, self._hi), (other._lo, other._hi), p), p)

    def _monotone(self, name: str) -> Interval:
        p = self.precision
        return _make(*ranges.monotone(name, (self._lo, self._hi), p), p)

    def sqrt(self) -> Interval:
        """Return the square root; the domain is x >= 0."""
        if self._lo[0]:
            raise DomainError(f"sqrt of an interval that leaves {DOMAINS['sqrt']}")
        p = self.precision
        return _make(mpf_sqrt(self._lo, p, DOWN), mpf_sqrt(self._hi, p, UP), p)

    def rootn(self, n: int) -> Interval:
        """Return the real n-th root, n >= 1; the domain is x >= 0 for even n."""
        return self._with(ranges.root, n)

    def sincos(self) -> tuple[Interval, Interval]:
        """Return (sin X, cos X): values at the ends, and +-1 where a quarter turn is passed."""
        sin, cos = ranges.sincos((self._lo, self._hi), self.precision)
        return _make(*sin, self.precision), _make(*cos, self.precision)

    def sin(self) -> Interval:
        """Return the sine."""
        return self.sincos()[0]

    def cos(self) -> Interval:
        """Return the cosine."""
        return self.sincos()[1]

    def tan(self) -> Interval:
        """Return the tangent; DomainError where a pole is inside."""
        return self._with(ranges.tan)

    # -- functions of two variables ------------------------------------------------------------

    def _required(self, value: object) -> Interval:
        other = self._other(value)
        if other is None:
            raise TypeError(f"not an interval or an exact number: {value!r}")
        return other

    def atan2(self, x: Interval | Fraction | int) -> Interval:
        """Return the angle in (-pi, pi] of the points (x, y), y in this interval."""
        y, other = self, self._required(x)
        if y.contains_zero() and other.contains_zero():
            raise DomainError("atan2 of a box that contains the origin")
        if other._lo[0] and y._lo[0] and not y._hi[0]:
            pi = Interval.pi(precision=max(y.precision, other.precision))
            return pi.hull(-pi)
        if y._lo[0] and (y._hi[0] or y._hi == _ZERO):
            return -(-y).atan2(other)
        return y._with_other(ranges.angle, other)

    def hypot(self, other: Interval | Fraction | int) -> Interval:
        """Return sqrt(x^2 + y^2)."""
        return abs(self)._with_other(ranges.length, abs(self._required(other)))

    def pow(self, exponent: Interval | Fraction | int) -> Interval:
        """Return x^y for real y; the domain is x > 0, and x = 0 with y > 0."""
        return self._with_other(ranges.power, self._required(exponent))

    def minimum(self, other: Interval | Fraction | int) -> Interval:
        """Return the range of min(x, y)."""
        y = self._required(other)
        low, high = extremes([self._lo, y._lo])[0], extremes([self._hi, y._hi])[0]
        return _outward(low, high, max(self.precision, y.precision))

    def maximum(self, other: Interval | Fraction | int) -> Interval:
        """Return the range of max(x, y)."""
        return -(-self).minimum(-self._required(other))

    # -- comparisons ---------------------------------------------------------------------------

    def _bounds(self, other: Interval | Exact) -> tuple[Any, Any, Any, Any]:
        if isinstance(other, int):
            other = self._required(other)
        if isinstance(other, Interval):
            a, b, c, d = map(_ordered_key, (self._lo, self._hi, other._lo, other._hi))
            return a, b, c, d
        number = fraction(other)
        return self.inf, self.sup, number, number

    def overlap(self, other: Interval | Exact) -> Overlap:
        """Return how this interval lies to the other: one of the 13 states of IEEE 1788."""
        return overlap_state(*self._bounds(other))

    def _ordered(self, value: Interval | Fraction | int, strict: bool) -> bool:
        """Return whether X < Y (X <= Y if not strict) for all pairs; Undecided if some do."""
        if isinstance(value, str):
            raise TypeError(f"an Interval cannot be compared with the text {value!r}")
        a, b, c, d = self._bounds(value)
        if b < c or (b == c and not strict):
            return True
        if d < a or (d == a and strict):
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

    def __eq__(self, other: object) -> bool:
        """Return equality as sets (IEEE 1788 `equal`), not of the unknown numbers inside.

        Comparing with a number raises TypeError: a quiet False would pass for a proof.
        """
        if not isinstance(other, Interval):
            refuse_equality(other)
            return NotImplemented
        return self._lo == other._lo and self._hi == other._hi

    def __hash__(self) -> int:
        return hash((self._lo, self._hi))

    def __bool__(self) -> bool:
        raise TypeError("the truth of an interval is not defined: compare it with something")

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        from intervals.numpy_protocol import object_ufunc

        return object_ufunc(Interval, ufunc, method, inputs, options)

    # -- text ----------------------------------------------------------------------------------

    def __repr__(self) -> str:
        """Return what evaluates to an equal interval, given the names Interval and Fraction."""
        return f"Interval({literal(self._lo)}, {literal(self._hi)}, precision={self.precision})"

    def __str__(self) -> str:
        """Return decimals that enclose, about as many digits as the precision is worth."""
        return display.text(self.inf, self.sup, self._digits)

    def __format__(self, spec: str) -> str:
        """Return decimals that enclose: f"{x:20}" has 20 significant digits; also .6f, .6e, .6g."""
        return display.formatted(self.inf, self.sup, spec) if spec else str(self)

    def _repr_latex_(self) -> str:
        return display.latex(self.inf, self.sup, self._digits)

    @property
    def _digits(self) -> int:
        """About as many digits as the precision is worth."""
        return max(3, self.precision * 3 // 10)

    def __reduce__(self) -> tuple[Callable[..., Interval], tuple[Any, ...]]:
        return _restore, (dyadic(self._lo), dyadic(self._hi), self.precision)


def _checked(precision: int) -> int:
    precision = index(precision)
    if precision < 2:
        raise ValueError("precision is at least 2 bits")
    return precision


def _make(lo: _Raw, hi: _Raw, precision: int) -> Interval:
    new = object.__new__(Interval)
    new._lo = lo
    new._hi = hi
    new.precision = precision
    return new


def _outward(lo: _Raw, hi: _Raw, precision: int) -> Interval:
    """Return the tightest enclosure of the interval at this precision: an int may have more."""
    return _make(mpf_pos(lo, precision, DOWN), mpf_pos(hi, precision, UP), precision)


def _restore(low: tuple[int, int], high: tuple[int, int], precision: int) -> Interval:
    """Return the interval with these endpoints m 2^e (for pickle and copy)."""
    return _make(from_man_exp(*low), from_man_exp(*high), precision)
