"""Exact numbers in and out: decimal strings are rationals, printed decimals are outward bounds."""

import re
from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Number, Rational
from typing import Any

Exact = int | Fraction | str | Decimal

_LONGEST = 4000  # digits or exponent: beyond it a number is a typing error or an attack
_UNCERTAIN = re.compile(r"([+-]?\d+(?:\.(\d*))?)\?(\d*)([ud]?)(e[+-]?\d+)?", re.ASCII)
_PLACES = 60  # beyond the digits: farther from the point a decimal has an exponent


def fraction(value: Exact) -> Fraction:
    """Return the exact rational that `value` denotes.

    An int, a Fraction, a Decimal, or a string such as "0.2121", "-2e-3" or "7/5". A float raises
    TypeError: 0.2121 typed as a float is not 2121/10000, use `from_float` where the binary
    number itself is meant. Text that is no number raises ValueError.
    """
    if type(value) is Fraction:
        return value
    if isinstance(value, str | Decimal):
        return _read(str(value))
    if isinstance(value, float):
        raise no_decimal(value)
    if not isinstance(value, Rational) or is_time(value):
        raise TypeError(f"{value!r} is not an int, a Fraction or a string")
    return Fraction(int(value.numerator), int(value.denominator))  # numpy's integers would wrap


def no_decimal(value: Any, constructor: str = "from_float") -> TypeError:
    """Return the error for a float, which says what to write."""
    typed = repr(float(value))
    try:
        top, bottom = value.as_integer_ratio()
    except (ValueError, OverflowError):
        return TypeError(f"{value!r} is no number: from_float takes finite ones")
    if Fraction(typed) == Fraction(top, bottom) and bottom < 1 << 20:
        meant = f"write Fraction({top}, {bottom})" if bottom > 1 else f"write {top}"
    else:
        meant = f"write Fraction({typed!r}) for the decimal"
    return TypeError(
        f"{value!r} is a float, not a decimal: {meant}, a string, or use {constructor}"
    )


def refuse_equality(other: object) -> None:
    """Raise TypeError for a number, a text or another kind of set: a quiet False would pass."""
    names = ("__float__", "__complex__", "_mpi_", "inf", "real")
    if isinstance(other, Number | str) or any(hasattr(other, name) for name in names):
        raise TypeError("a set is no number: use contains, <, > or a second one of the same type")


def whole(value: object) -> int | None:
    """Return the int that an int of Python's or numpy's is; None for anything else."""
    return int(value) if isinstance(value, Integral) and not is_time(value) else None


def is_time(value: object) -> bool:
    """Return whether it is one of numpy's spans of time, integers by their type, NaT among them."""
    return getattr(getattr(value, "dtype", None), "kind", "") == "m"


def pair(lower: Exact, upper: Exact | None) -> tuple[Fraction, Fraction]:
    """Return the ends that a constructor was given: two numbers, one, or text such as "[1.1, 1.2]".

    "3.56?1" is 3.56 up to 1 in its last place, "3.56?" up to half a unit, "3.56?2u" at most 2 units
    more, "3.56?2d" less, "3.56?1e-3" a thousandth (IEEE 1788). Reversed ends raise ValueError.
    """
    if upper is None and isinstance(lower, str):
        if lower.strip().startswith("["):
            lower, upper = _bracketed(lower.strip())
        elif parts := _UNCERTAIN.fullmatch(lower.strip()):
            return _uncertain(*parts.groups())
    low = fraction(lower)
    high = low if upper is None else fraction(upper)
    if low > high:
        raise ValueError(f"reversed interval: {lower} > {upper}")
    return low, high


def _uncertain(
    middle: str, places: str | None, units: str, side: str, exponent: str | None
) -> tuple[Fraction, Fraction]:
    """Return the ends of a decimal with an uncertainty in units of its last place."""
    scale = fraction(f"1{exponent or 'e0'}")
    unit = scale * Fraction(10) ** -len(places or "")
    reach = (Fraction(int(units)) if units else Fraction(1, 2)) * unit
    value = fraction(middle) * scale
    return value - reach * (side != "u"), value + reach * (side != "d")


def _bracketed(text: str) -> tuple[str, str]:
    """Return the ends in "[1.1, 1.2]", and both of them in "[1.1]"."""
    ends = [end.strip() for end in text.removeprefix("[").removesuffix("]").split(",")]
    if not text.endswith("]") or len(ends) > 2:
        raise ValueError(f"not an interval: {text!r}")
    return ends[0], ends[-1]


def _read(text: str) -> Fraction:
    if len(text) > _LONGEST:
        raise ValueError(f"a number of unreasonable size: {text[:20]}...")
    exponent = text.lower().partition("e")[2]
    try:
        reasonable = not exponent or abs(int(exponent)) <= _LONGEST
        if reasonable:
            return Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"not a number: {text!r}") from None
    raise ValueError(f"a number of unreasonable size: {text[:20]}...")


def _rounded(value: Fraction, digits: int, up: bool) -> str:
    """Return the next decimal of so many significant digits that is <= value, or >= value."""
    if digits < 1:
        raise ValueError("a decimal has at least one digit")
    if value == 0:
        return "0"
    top, bottom = abs(value.numerator), value.denominator
    places = (
        (top.bit_length() - bottom.bit_length()) * 30103 // 100_000
    )  # in front of the point, about
    while not _below(top, bottom, places):
        places += 1
    while _below(top, bottom, places - 1):
        places -= 1
    shift = digits - places
    factor = 10 ** abs(shift)
    top, bottom = (top * factor, bottom) if shift > 0 else (top, bottom * factor)
    signed = -top if value < 0 else top
    integer = -(-signed // bottom) if up else signed // bottom
    if abs(integer) == 10**digits:
        integer, shift = integer // 10, shift - 1
    if abs(digits - shift) <= _PLACES + digits:
        return _placed(integer, shift)
    text = str(Decimal(abs(integer)))  # of any length, unlike str(int)
    point = f".{text[1:]}" if digits > 1 else ""
    return f"{'-' * (integer < 0)}{text[0]}{point}e{digits - shift - 1}"


def _below(top: int, bottom: int, places: int) -> bool:
    """Return whether top / bottom < 10^places."""
    factor: int = 10 ** abs(places)
    return top < bottom * factor if places >= 0 else top * factor < bottom


def _placed(integer: int, shift: int) -> str:
    """Write integer * 10^-shift."""
    sign, text = "-" if integer < 0 else "", str(Decimal(abs(integer)))
    if shift <= 0:
        return sign + text + "0" * -shift
    text = text.rjust(shift + 1, "0")
    return f"{sign}{text[:-shift]}.{text[-shift:]}"


def decimal_down(value: Fraction, digits: int) -> str:
    """Return the largest decimal of `digits` significant digits that is <= value."""
    return _rounded(value, digits, up=False)


def decimal_up(value: Fraction, digits: int) -> str:
    """Return the smallest decimal of `digits` significant digits that is >= value."""
    return _rounded(value, digits, up=True)


def decimal_places(value: Fraction, places: int, *, up: bool = False) -> str:
    """Return the next decimal of so many places after the point that is <= value, or >= value."""
    scaled = value * 10**places
    return _placed(-(-scaled // 1) if up else scaled // 1, places)


def decimal_bounds(low: Fraction, high: Fraction, digits: int) -> tuple[str, str]:
    """Print an interval outward, at most 10^-digits max(|low|, |high|) wider than it is.

    What is printed is read back and compared, so a slip in the conversion cannot go unseen.
    """
    lower, upper = decimal_down(low, digits + 3), decimal_up(high, digits + 3)
    if not (Fraction(Decimal(lower)) <= low and high <= Fraction(Decimal(upper))):
        raise ArithmeticError("a printed bound does not enclose")
    return lower, upper
