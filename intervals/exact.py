"""Exact numbers in and out: decimal strings are rationals, printed decimals are outward bounds."""

from fractions import Fraction

Exact = int | Fraction | str

_LONGEST = 4000  # digits or exponent: beyond it a number is a typing error or an attack


def fraction(value: Exact) -> Fraction:
    """Return the exact rational that `value` denotes.

    An int, a Fraction, or a string such as "0.2121", "-2e-3" or "7/5". A float raises
    TypeError: 0.2121 typed as a float is not 2121/10000, use `from_float` where the binary
    number itself is meant. Text that is no number raises ValueError.
    """
    if isinstance(value, float):
        raise TypeError(f"{value!r} is a float, not a decimal: pass a string, or use from_float")
    if isinstance(value, str):
        _, _, exponent = value.lower().partition("e")
        huge_exponent = exponent.lstrip("+-").isdigit() and int(exponent[:9]) not in range(
            -_LONGEST, _LONGEST
        )
        if len(value) > _LONGEST or huge_exponent:
            raise ValueError(f"a number of unreasonable size: {value[:20]}...")
    try:
        return Fraction(value)
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"not a number: {value!r}") from None


def _scaled(value: Fraction, digits: int) -> tuple[Fraction, int]:
    """Return (value * 10^shift, shift) where the first has `digits` digits before the point."""
    numerator, denominator = abs(value.numerator), value.denominator
    magnitude = len(str(numerator)) - len(str(denominator))  # 10^(m-1) < |value| < 10^(m+1)
    if numerator >= denominator * Fraction(10) ** magnitude:
        magnitude += 1
    shift = digits - magnitude
    return value * Fraction(10) ** shift, shift


def _decimal(integer: int, shift: int) -> str:
    """Write integer * 10^-shift as a plain decimal."""
    if shift <= 0:
        return str(integer * 10**-shift)
    sign, text = "-" if integer < 0 else "", str(abs(integer)).rjust(shift + 1, "0")
    return f"{sign}{text[:-shift]}.{text[-shift:]}"


def decimal_down(value: Fraction, digits: int) -> str:
    """Return the largest decimal of `digits` significant digits that is <= value."""
    if value == 0:
        return "0"
    scaled, shift = _scaled(value, digits)
    return _decimal(scaled.numerator // scaled.denominator, shift)


def decimal_up(value: Fraction, digits: int) -> str:
    """Return the smallest decimal of `digits` significant digits that is >= value."""
    if value == 0:
        return "0"
    scaled, shift = _scaled(value, digits)
    return _decimal(-(-scaled.numerator // scaled.denominator), shift)


def decimal_bounds(low: Fraction, high: Fraction, digits: int) -> tuple[str, str]:
    """Print an interval outward, at most 10^-digits of its size wider than it is.

    What is printed is read back and compared, so a slip in the conversion cannot go unseen.
    """
    lower, upper = decimal_down(low, digits + 3), decimal_up(high, digits + 3)
    if not (Fraction(lower) <= low and high <= Fraction(upper)):
        raise ArithmeticError("a printed bound does not enclose")
    return lower, upper
