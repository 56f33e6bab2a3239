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
    """The ends of function(*arguments) with Arb at `bits` bits."""
    with flint.ctx.workprec(bits):
        return ends(function(*map(arb, arguments)))


FUNCTIONS = {
    "sin": lambda x: x.sin(),
    "cos": lambda x: x.cos(),
    "exp": lambda x: x.exp(),
    "log": lambda x: x.log(),
}


def rounded(name, x, precision):
    """The numbers of `precision` bits next below and above FUNCTIONS[name](x), x dyadic."""
    bits = 3 * precision + 64
    while True:
        low, high = evaluate(FUNCTIONS[name], bits, x)
        down, up = round_down(low, precision), round_up(high, precision)
        if down == round_down(high, precision) and up == round_up(low, precision):
            return down, up
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
        if low <= a and b <= high:
            return True
        if b < low or high < a:
            return False
        bits *= 2
    raise ArithmeticError("not decided")
