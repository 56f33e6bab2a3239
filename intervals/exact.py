"""Exact numbers in and out: decimal strings are rationals, printed decimals are outward bounds."""

from decimal import Decimal
from fractions import Fraction
from numbers import Integral, Rational

Exact = int | Fraction | str

_LONGEST = 4000  # digits or exponent: beyond it a number is a typing error or an attack


def fraction(value: Exact) -> Fraction:
    """Return the exact rational that `value` denotes.

    An int, a Fraction, or a string such as "0.2121", "-2e-3" or "7/5". A float raises
    TypeError: 0.2121 typed as a float is not 2121/10000, use `from_float` where the binary
    number itself is meant. Text that is no number raises ValueError.
    """
    if type(value) is Fraction:
        return value
    if isinstance(value, str):
        return _read(value)
    if isinstance(value, float):
        raise TypeError(f"{value!r} is a float, not a decimal: pass a string, or use from_float")
    if not isinstance(value, Rational) or is_time(value):
        raise TypeError(f"{value!r} is not an int, a Fraction or a string")
    return Fraction(int(value.numerator), int(value.denominator))  # numpy's integers would wrap


def whole(value: object) -> int | None:
    """Return the int that an int of Python's or numpy's is; None for anything else."""
    return int(value) if isinstance(value, Integral) and not is_time(value) else None


def is_time(value: object) -> bool:
    """Return whether it is one of numpy's spans of time, integers by their type, NaT among them."""
    return getattr(getattr(value, "dtype", None), "kind", "") == "m"


def pair(lower: Exact, upper: Exact | None) -> tuple[Fraction, Fraction]:
    """Return the ends that a constructor was given: two numbers, one, or text such as "[1.1, 1.2]".

    Reversed ends raise ValueError.
    """
    if upper is None and isinstance(lower, str) and lower.strip().startswith("["):
        lower, upper = _bracketed(lower.strip())
    low = fraction(lower)
    high = low if upper is None else fraction(upper)
    if low > high:
        raise ValueError(f"reversed interval: {lower} > {upper}")
    return low, high


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


def _scaled(value: Fraction, digits: int) -> tuple[Fraction, int]:
    """Return (value * 10^shift, shift) where the first has `digits` digits before the point."""
    if digits < 1:
        raise ValueError("a decimal has at least one digit")
    numerator, denominator = abs(value.numerator), value.denominator
    # 10^(m-1) < |value| < 10^(m+1); Decimal(int) is exact and, unlike str(int), of any length
    magnitude = Decimal(numerator).adjusted() - Decimal(denominator).adjusted()
    if numerator >= denominator * Fraction(10) ** magnitude:
        magnitude += 1
    shift = digits - magnitude
    return value * Fraction(10) ** shift, shift


def _decimal(integer: int, shift: int, digits: int) -> str:
    """Write integer * 10^-shift, where |integer| <= 10^digits, with `digits` significant digits."""
    if abs(integer) == 10**digits:
        integer, shift = integer // 10, shift - 1
    return _placed(integer, shift)


def _placed(integer: int, shift: int) -> str:
    """Write integer * 10^-shift."""
    sign, text = "-" if integer < 0 else "", str(Decimal(abs(integer)))
    if shift <= 0:
        return sign + text + "0" * -shift
    text = text.rjust(shift + 1, "0")
    return f"{sign}{text[:-shift]}.{text[-shift:]}"


def decimal_down(value: Fraction, digits: int) -> str:
    """Return the largest decimal of `digits` significant digits that is <= value."""
    if value == 0:
        return "0"
    scaled, shift = _scaled(value, digits)
    return _decimal(scaled.numerator // scaled.denominator, shift, digits)


def decimal_up(value: Fraction, digits: int) -> str:
    """Return the smallest decimal of `digits` significant digits that is >= value."""
    if value == 0:
        return "0"
    scaled, shift = _scaled(value, digits)
    return _decimal(-(-scaled.numerator // scaled.denominator), shift, digits)


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
