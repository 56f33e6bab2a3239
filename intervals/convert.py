"""Numbers of other libraries: exact on the way in, enclosed on the way out.

Each says by its type that it is meant as the number that it holds, unlike a float that was typed.
"""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from mpmath.ctx_mp_python import _constant
from mpmath.libmp import from_man_exp, fzero, mpf_add, mpf_neg

from intervals.complex import ComplexInterval
from intervals.elementary.tightest import DOWN, UP, Raw
from intervals.exact import decimal_down, decimal_up
from intervals.interval import Interval, _make

if TYPE_CHECKING:
    import flint


def interval(value: Any, *, precision: int | None = None) -> Interval:
    """Enclose a Decimal, an mpf of mpmath, an arb of python-flint, a number of sympy.

    At `precision` bits it is the tightest enclosure. Without, it has 53, or as many as the number
    has itself: a point then stays what it is, unless it is a Decimal. Infinities and NaN raise
    ValueError, other types TypeError.
    """
    if isinstance(value, Decimal):
        return Interval(value, precision=precision or 53)
    if getattr(value, "is_Rational", False):  # sympy's
        return Interval(Fraction(int(value.p), int(value.q)), precision=precision or 53)
    if hasattr(value, "_mpi_"):
        raise TypeError("mpmath's intervals are not rigorous: see unproved_mpi")
    return _enclosed(value, precision)


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
