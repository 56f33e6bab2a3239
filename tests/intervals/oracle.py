"""True values as exact rationals, from integers alone and from Arb: nothing of `intervals`."""

from fractions import Fraction
from functools import lru_cache
from math import isqrt

import flint


def exponent(x):
    """The e with 2^e <= |x| < 2^(e+1)."""
    e = abs(x.numerator).bit_length() - x.denominator.bit_length()
    return e if abs(x) >= Fraction(2) ** e else e - 1


def ulp(x, precision):
    return Fraction(2) ** (exponent(x) + 1 - precision)


def round_down(x, precision):
    """The largest number of `precision` bits that is <= x."""
    if x == 0:
        return Fraction(0)
    scaled = x / ulp(x, precision)
    return scaled.__floor__() * ulp(x, precision)


def round_up(x, precision):
    return -round_down(-x, precision)


def outward(low, high, precision):
    """The tightest ends of `precision` bits around [low, high]."""
    return round_down(low, precision), round_up(high, precision)


def sqrt_down(x, precision):
    """The largest number of `precision` bits whose square is <= x."""
    if x == 0:
        return Fraction(0)
    shift = precision - exponent(x) // 2 + 2
    return round_down(
        isqrt((x * Fraction(4) ** shift).__floor__()) / Fraction(2) ** shift, precision
    )


def sqrt_up(x, precision):
    low = sqrt_down(x, precision)
    return low if low * low == x else low + ulp(low, precision)


def ends(ball):
    """The exact ends of an Arb ball."""
    (mid, e), (rad, d) = ball.mid().man_exp(), ball.rad().man_exp()
    middle, radius = int(mid) * Fraction(2) ** int(e), int(rad) * Fraction(2) ** int(d)
    return middle - radius, middle + radius


def arb(x):
    """A ball that holds the rational x, a point if x is dyadic."""
    x = Fraction(x)
    power = x.denominator.bit_length() - 1
    if x.denominator == 1 << power:
        return flint.arb((x.numerator, -power))
    return flint.arb(flint.fmpq(x.numerator, x.denominator))


def evaluate(function, bits, *arguments):
    """The ends of function(*arguments) with Arb at `bits` bits; (None, None) if not bounded."""
    with flint.ctx.workprec(bits):
        value = function(*map(arb, arguments))
        return ends(value) if value.is_finite() else (None, None)


FUNCTIONS = {
    "sqrt": lambda x: x.sqrt(),
    "cbrt": lambda x: x.root(3) if x > 0 else -((-x).root(3)) if x < 0 else x,
    "exp": lambda x: x.exp(),
    "exp2": lambda x: flint.arb(2) ** x,
    "exp10": lambda x: flint.arb(10) ** x,
    "expm1": lambda x: x.expm1(),
    "log": lambda x: x.log(),
    "log2": lambda x: x.log() / flint.arb(2).log(),
    "log10": lambda x: x.log() / flint.arb(10).log(),
    "log1p": lambda x: x.log1p(),
    "sin": lambda x: x.sin(),
    "cos": lambda x: x.cos(),
    "tan": lambda x: x.tan(),
    "asin": lambda x: x.asin(),
    "acos": lambda x: x.acos(),
    "atan": lambda x: x.atan(),
    "sinh": lambda x: x.sinh(),
    "cosh": lambda x: x.cosh(),
    "tanh": lambda x: x.tanh(),
    "asinh": lambda x: x.asinh(),
    "acosh": lambda x: x.acosh(),
    "atanh": lambda x: x.atanh(),
    "atan2": lambda y, x: flint.arb.atan2(y, x),
    "hypot": lambda x, y: (x * x + y * y).sqrt(),
    "pow": lambda x, y: x**y,
}


DOMAINS = {  # where a function is defined, of those that are not so everywhere
    "sqrt": lambda x: x >= 0,
    **{name: lambda x: x > 0 for name in ("log", "log2", "log10")},
    "log1p": lambda x: x > -1,
    **{name: lambda x: abs(x) <= 1 for name in ("asin", "acos")},
    "acosh": lambda x: x >= 1,
    "atanh": lambda x: abs(x) < 1,
}


def _is_power(z, base, n):
    """Whether z = base^n, without a long power where it cannot be."""
    return n.denominator == 1 and abs(n) < 2**16 and z == Fraction(base) ** int(n)


def _is_dyadic_power(z, x, y):
    """Whether z = x^y: z^(2^j) = x^c for y = c / 2^j, without long powers where it cannot be."""
    if z <= 0 or abs(y.numerator) * y.denominator > 2**14:
        return z == x == 0 or z == x == 1
    return z**y.denominator == x**y.numerator


EXACT = {  # whether a number is the value: an equation between rationals
    "sqrt": lambda z, x: z >= 0 and z * z == x,
    "cbrt": lambda z, x: z**3 == x,
    "exp": lambda z, x: (x, z) == (0, 1),
    "exp2": lambda z, x: _is_power(z, 2, x),
    "exp10": lambda z, x: _is_power(z, 10, x),
    "log2": lambda z, x: _is_power(x, 2, z),
    "log10": lambda z, x: _is_power(x, 10, z),
    "log": lambda z, x: (x, z) == (1, 0),
    "cos": lambda z, x: (x, z) == (0, 1),
    "acos": lambda z, x: (x, z) == (1, 0),
    "cosh": lambda z, x: (x, z) == (0, 1),
    "acosh": lambda z, x: (x, z) == (1, 0),
    "atan2": lambda z, y, x: y == z == 0 < x,
    "hypot": lambda z, x, y: z >= 0 and z * z == x * x + y * y,
    "pow": _is_dyadic_power,
}


def rounded(name, *arguments):
    """The numbers of `precision` bits (the last argument) next below and above the value.

    The value is that of FUNCTIONS[name] at the dyadic numbers before it.
    """
    *arguments, precision = arguments
    exactly = EXACT.get(name, lambda z, x: x == z == 0)
    bits = 3 * precision + 64
    while True:
        low, high = evaluate(FUNCTIONS[name], bits, *arguments)
        if low is not None:
            down, up = round_down(low, precision), round_up(high, precision)
            if down == round_down(high, precision) and up == round_up(low, precision):
                return down, up
            between = round_up(low, precision)
            if between <= high and exactly(between, *arguments):
                return between, between
        bits *= 2


@lru_cache(maxsize=64)
def pi_bounds(bits):
    return evaluate(flint.arb.pi, bits + 8)


def quarter_turns(x):
    """The floor of x / (pi/2)."""
    low, high = pi_bounds(100 + 2 * (abs(x.numerator) * x.denominator).bit_length())
    floors = {(2 * x / low).__floor__(), (2 * x / high).__floor__()}
    (floor,) = floors
    return floor


def range_of(name, low, high, precision):
    """The tightest bounds of `precision` bits on the range of sin, cos, exp or log over a box."""
    at_low, at_high = rounded(name, low, precision), rounded(name, high, precision)
    bottom, top = min(at_low[0], at_high[0]), max(at_low[1], at_high[1])
    if name in ("sin", "cos"):
        turns = range(-quarter_turns(-low), quarter_turns(high) + 1)  # ceil and floor
        peaks = {n % 4 for n in turns[:4]}
        crest = 1 if name == "sin" else 0
        top = Fraction(1) if crest in peaks else top
        bottom = Fraction(-1) if crest + 2 in peaks else bottom
    return bottom, top


def encloses(low, high, function, *arguments, bits):
    """Whether low <= function(*arguments) <= high, decided with Arb at growing precision."""
    for _ in range(16):
        a, b = evaluate(function, bits, *arguments)
        if a is None:
            pass
        elif low <= a and b <= high:
            return True
        elif b < low or high < a:
            return False
        bits *= 2
    raise ArithmeticError("not decided")
