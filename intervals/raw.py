"""libmp's numbers (sign, mantissa, exponent, bit length): exact conversions, order, text."""

from fractions import Fraction
from struct import pack, unpack

from mpmath.libmp import from_man_exp, from_rational, mpf_cmp, mpf_lt

from intervals.elementary.tightest import Bounds, Raw


def rounded(value: Fraction, precision: int, direction: str) -> Raw:
    """Return a rational rounded to `precision` bits."""
    top, bottom = value.numerator, value.denominator
    if bottom & (bottom - 1):
        raw: Raw = from_rational(top, bottom, precision, direction)
    else:  # a power of 2: no division
        raw = from_man_exp(top, 1 - bottom.bit_length(), precision, direction)
    return raw


def dyadic(raw: Raw) -> tuple[int, int]:
    """Return (m, e) with raw = m 2^e as Python's ints: gmpy2's integers stay inside."""
    man = int(raw[1])
    return -man if raw[0] else man, int(raw[2])


def exact(raw: Raw) -> Fraction:
    """Return the number as a Fraction."""
    man, exp = dyadic(raw)
    return Fraction(man << exp) if exp >= 0 else Fraction(man, 1 << -exp)


def from_bits(value: float) -> Raw:
    """Return a finite binary64 number, from its bits: no unit that flushes subnormals sees it."""
    (bits,) = unpack("<q", pack("<d", value))
    exp, man = bits >> 52 & 0x7FF, bits & ((1 << 52) - 1)
    if exp:
        man |= 1 << 52
    raw: Raw = from_man_exp(-man if bits < 0 else man, max(exp, 1) - 1075)
    return raw


def literal(raw: Raw) -> str:
    """Return Python's text of an endpoint: a string that `fraction` reads, or an expression."""
    man, exp = dyadic(raw)
    if man.bit_length() + abs(exp) < 13_000:  # below 4000 digits
        return f"'{exact(raw)}'"
    return f"{man:#x} * Fraction(2) ** {exp}"


def compare(x: Raw, y: Raw) -> int:
    """Return a number that has the sign of x - y."""
    result: int = mpf_cmp(x, y)
    return result


def extremes(values: list[Raw]) -> Bounds:
    """Return the least and the largest."""
    low = high = values[0]
    for value in values[1:]:
        if mpf_lt(value, low):
            low = value
        elif mpf_lt(high, value):
            high = value
    return low, high


def hull(x: Bounds, y: Bounds) -> Bounds:
    """Return the smaller of the lower and the larger of the upper bounds."""
    return (
        y[0] if mpf_lt(y[0], x[0]) else x[0],
        x[1] if mpf_lt(y[1], x[1]) else y[1],
    )
