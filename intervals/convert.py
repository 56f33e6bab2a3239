"""Numbers of other libraries: exact on the way in, enclosed on the way out.

Each says by its type that it is meant as the number that it holds, unlike a float that was typed.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from functools import reduce
from typing import TYPE_CHECKING, Any, cast

from mpmath.ctx_mp_python import _constant
from mpmath.libmp import from_man_exp, fzero, mpf_add, mpf_neg

from intervals.complex import ComplexInterval
from intervals.elementary.tightest import DOWN, UP, Raw
from intervals.exact import decimal_down, decimal_up
from intervals.functions import TABLE
from intervals.interval import Interval, _make

if TYPE_CHECKING:
    import flint

_OF_SYMPY: dict[str, Callable[..., Interval]] = {
    "Add": lambda *x: reduce(operator.add, x),
    "Mul": lambda *x: reduce(operator.mul, x),
    "Pow": Interval.pow,
    "Abs": abs,
    "Min": lambda *x: reduce(Interval.minimum, x),
    "Max": lambda *x: reduce(Interval.maximum, x),
    "atan2": Interval.atan2,
}


def interval(value: Any, *, precision: int | None = None) -> Interval:
    """Enclose a Decimal, an mpf of mpmath, an arb of python-flint, a number of sympy.

    At `precision` bits it is the tightest enclosure, but of terms of sympy. Without, it has 53, or
    as many as the number has itself: a point then stays what it is, unless it is a Decimal.
    Infinities and NaN raise ValueError, other types TypeError.
    """
    if isinstance(value, Decimal):
        return Interval(value, precision=precision or 53)
    if hasattr(value, "free_symbols") and not value.is_Float:
        return _of_sympy(value, precision or 53)
    if hasattr(value, "_mpi_"):
        raise TypeError("mpmath's intervals are not rigorous: see unproved_mpi")
    return _enclosed(value, precision)


def _of_sympy(x: Any, precision: int) -> Interval:
    """Return an enclosure of a number of sympy, such as pi / sqrt(2), or of a closed interval."""
    name = type(x).__name__
    if x.is_Rational:
        return Interval(Fraction(int(x.p), int(x.q)), precision=precision)
    if name in ("Pi", "Exp1"):
        return (Interval.pi if name == "Pi" else Interval.e)(precision=precision)
    if name == "Interval" and not (x.left_open or x.right_open):
        return _of_sympy(x.start, precision).hull(_of_sympy(x.end, precision))
    if name == "Pow" and x.exp.is_Integer:
        return _of_sympy(x.base, precision) ** int(x.exp)
    operation = _OF_SYMPY.get(name) or (getattr(Interval, name) if name in TABLE else None)
    if not operation or x.free_symbols:
        raise TypeError(f"not a real number, or a closed interval, of sympy: {x!r}")
    parts = [_of_sympy(part, precision) for part in x.args]
    return cast("Interval", operation(*parts))


def unproved_mpi(value: Any, *, precision: int | None = None) -> Interval:
    """Take an iv.mpf of mpmath as the interval that it is.

    Operations of mpmath may have left out true values; what is proved is proved if they have not.
    """
    return _enclosed(value, precision)


def sympy(x: Interval) -> Any:
    """Return the same interval as one of sympy, with rational ends."""
    from sympy import Interval as Closed
    from sympy import Rational

    return Closed(*(Rational(end.numerator, end.denominator) for end in (x.inf, x.sup)))


def _enclosed(value: Any, precision: int | None) -> Interval:
    middle, low, high = _parts(value)
    bits = precision or max(53, *(raw[3] for raw in (middle, low, high)))
    return _make(mpf_add(middle, low, bits, DOWN), mpf_add(middle, high, bits, UP), bits)


def complex_interval(value: Any, *, precision: int | None = None) -> ComplexInterval:
    """Enclose an mpc of mpmath, an acb of python-flint, as `interval` does."""
    if not any(hasattr(value, name) for name in ("_mpc_", "complex_rad")):
        raise TypeError(f"not an mpc or an acb: {value!r}")
    parts = (interval(part, precision=precision) for part in (value.real, value.imag))
    return ComplexInterval(*parts)


def acb(z: ComplexInterval) -> flint.acb:
    """Return a box of python-flint that contains z; a point is its own."""
    import flint

    return flint.acb(arb(z.real), arb(z.imag))


def _parts(value: Any) -> tuple[Raw, Raw, Raw]:
    """Return m, a, b with [m + a, m + b] the number, or interval, of mpmath or python-flint."""
    if hasattr(value, "mid_rad_10exp"):  # an arb, which has an _mpf_, too: its midpoint
        if not value.is_finite():
            raise ValueError(f"not a bounded interval: {value}")
        middle, radius = (
            from_man_exp(*map(int, part.man_exp())) for part in (value.mid(), value.rad())
        )
        return middle, mpf_neg(radius), radius
    if isinstance(value, _constant):  # its _mpf_ is only near pi, say
        raise TypeError(
            f"not the number that it stands for: {value!r}; see Interval.pi, or mpmath.iv"
        )
    point = getattr(value, "_mpf_", None)
    bounds = getattr(value, "_mpi_", point and (point, point))
    if not bounds:
        raise TypeError(f"not a Decimal, an mpf, an mpi or an arb: {value!r}")
    low, high = bounds
    if any(exponent and not mantissa for _, mantissa, exponent, _ in bounds):
        raise ValueError(f"not a bounded interval: {value}")
    return fzero, low, high


def arb(x: Interval) -> flint.arb:
    """Return a ball of python-flint that contains x; a point is its own."""
    import flint

    middle, radius = ((q.numerator, 1 - q.denominator.bit_length()) for q in (x.mid, x.rad))
    return flint.arb(middle, radius)


def mpi(x: Interval) -> Any:
    """Return the same interval as mpmath's iv.mpf, whose own operations are not rigorous."""
    from mpmath import iv

    return iv.make_mpf((x._lo, x._hi))


def decimals(x: Interval, digits: int) -> tuple[Decimal, Decimal]:
    """Return the tightest decimals of so many significant digits around x."""
    return Decimal(decimal_down(x.inf, digits)), Decimal(decimal_up(x.sup, digits))
