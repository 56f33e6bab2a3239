"""Elementary functions at hard arguments: Interval at any precision, IntervalArray in binary64."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from intervals import Interval, IntervalArray
from proofs.stress.cases import Answer, Case, Truth
from proofs.stress.kernels import Kernel, Range

_PERIODIC = ("sin", "cos", "tan")
_NEAR_ONE = ("log", "log2", "log10", "acosh", "sqrt", "cbrt")
_UNIT = ("asin", "acos", "atanh", "log1p")
_GROWING = ("exp", "exp2", "exp10", "expm1", "sinh", "cosh", "tanh", "atan", "asinh")
NAMES = _PERIODIC + _NEAR_ONE + _UNIT + _GROWING
_POSITIVE = ("log", "log2", "log10", "sqrt")
_PRECISIONS = (24, 53, 64, 100, 200, 333)
_WORST = Fraction(6381956970095103 << 797)  # of binary64, the closest to a multiple of pi/2
_BITS = 500  # of the truth, and more where the argument is large or the value next to 0
_MOST_BITS = 20_000
_LEAST = -1074  # binary64 has no multiples of less than 2^-1074


@dataclass(frozen=True)
class ValueCase(Case):
    """A case whose answer is one value, in a precision that is prescribed."""

    @property
    def rounding(self) -> tuple[int, bool]:
        """The precision, and whether the value is of an array, so of the range of binary64."""
        raise NotImplementedError

    def bits(self) -> int | None:
        """Return the precision."""
        return self.rounding[0]

    def best(self, hull: Range) -> Fraction:
        """Return the width of the range with its ends rounded outward."""
        precision, binary64 = self.rounding
        low = rounded_down(hull[0], precision, binary64=binary64)
        return -rounded_down(-hull[1], precision, binary64=binary64) - low


def value_of(found: Interval | IntervalArray) -> Answer:
    """Return an Interval, or the one amid two easy neighbours in an IntervalArray, as answer."""
    if isinstance(found, Interval):
        return Answer((({"value": (found.inf, found.sup)},),))
    return Answer((({"value": (Fraction(found.inf[1]), Fraction(found.sup[1]))},),))


@dataclass(frozen=True)
class FunctionCase(ValueCase):
    """f on [low, high], whose ends have at most `precision` bits."""

    function: str
    low: Fraction
    high: Fraction
    precision: int

    @property
    def rounding(self) -> tuple[int, bool]:
        """The precision, and whether it is of an array."""
        return self.precision, self.family == "arrays"

    def answer(self) -> Answer:
        """Return the enclosure by Interval, or by IntervalArray amid two easy neighbours."""
        easy = Fraction(5, 4) if self.function == "acosh" else Fraction(3, 4)
        argument: Interval | IntervalArray
        if self.family == "arrays":
            argument = IntervalArray([easy, (self.low, self.high), easy])
        else:
            argument = Interval(self.low, self.high, precision=self.precision)
        return value_of(getattr(argument, self.function)())

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the two ends of the range, as truths about the one sample."""
        return true_range(kernel, self.function, self.low, self.high, self.precision)


def rounded_down(value: Fraction, bits: int, *, binary64: bool = True) -> Fraction:
    """Round down to `bits` bits, to a multiple of the least number of binary64 if that is asked."""
    if value == 0:
        return value
    exponent = abs(value.numerator).bit_length() - value.denominator.bit_length()
    exponent -= abs(value) < Fraction(2) ** exponent
    place = exponent - bits + 1
    unit = Fraction(2) ** (max(place, _LEAST) if binary64 else place)
    return value // unit * unit


def true_range(
    kernel: Kernel, function: str, low: Fraction, high: Fraction, precision: int
) -> list[Truth | None]:
    """Return the least and the largest value, or one Truth without value if there is a pole.

    With so many bits that it is known between which two numbers of `precision` bits each lies.
    """
    bits = _BITS + max(abs(low), abs(high)).__ceil__().bit_length()
    while True:
        fine = precision if bits < _MOST_BITS else 1  # a value that is such a number never ends it
        try:
            with kernel.digits(bits):
                return _ends(kernel, function, (low, high), fine)
        except _Unsharp:
            if bits >= _MOST_BITS:
                return [None]
            bits *= 3


class _Unsharp(ArithmeticError):
    """More bits are needed."""


def _ends(kernel: Kernel, function: str, ends: Range, precision: int) -> list[Truth | None]:
    low, high = ends
    values = [_sharp(kernel, function, x, precision) for x in {low, high}]
    if function == "cosh" and low < 0 < high:
        values.append((Fraction(1), Fraction(1)))
    if function in _PERIODIC:
        # turning points of sin at pi/2 + k pi, of cos at k pi; poles of tan at pi/2 + k pi
        shift = Fraction(0) if function == "cos" else Fraction(1, 2)
        first, last = (_whole(kernel, x, shift) for x in ends)
        if first < last and function == "tan":
            return [Truth({}, "a pole")]
        turning = range(first + 1, min(last, first + 2) + 1)
        values += [(Fraction(1 - 2 * (k % 2)),) * 2 for k in turning]
    return [Truth({"value": min(values)}), Truth({"value": max(values, key=lambda v: v[1])})]


def _sharp(kernel: Kernel, function: str, x: Fraction, precision: int) -> Range:
    try:
        low, high = kernel.bounds(kernel.call(function, kernel.number(x)))
    except ArithmeticError:
        raise _Unsharp from None
    below = [rounded_down(x, precision, binary64=False) for x in (low, high)]
    if below[0] != below[1]:
        raise _Unsharp
    if high - low > min(abs(low), abs(high)) / 10**20:
        raise _Unsharp
    return low, high


def _whole(kernel: Kernel, x: Fraction, shift: Fraction) -> int:
    """Return the largest k with (k + shift) pi <= x."""
    low, high = kernel.bounds(kernel.number(x) / kernel.pi() - kernel.number(shift))
    if low // 1 != high // 1:
        if x == 0:
            return 0 if shift == 0 else -1
        raise _Unsharp
    return int(low // 1)


# -- hard arguments --------------------------------------------------------------------------------


def draw(generator: Random, kernel: Kernel, family: str) -> FunctionCase:
    """Return a random function at a random hard argument, a point or an interval."""
    function = generator.choice(NAMES)
    bits = 53 if family == "arrays" else generator.choice(_PRECISIONS)
    low = rounded_down(_argument(generator, kernel, function, bits), bits)
    high = low
    if generator.random() < 0.5:
        width = abs(low) / (1 << generator.choice((bits - 1, bits - 1, bits // 2, 10, 1)))
        if function in _PERIODIC and abs(low) < 100 and generator.random() < 0.3:
            width = Fraction(generator.uniform(0, 6.5))
        high = max(low, -rounded_down(-low - width, bits))
        high = high if _inside(function, high) else low
    return FunctionCase(family, function, low, high, bits)


def _argument(generator: Random, kernel: Kernel, function: str, bits: int) -> Fraction:
    """Return a point of the domain, next to its ends, to zeros, to poles, tiny, large or plain."""
    sign = generator.choice((-1, 1))
    plain = Fraction(generator.getrandbits(bits) | 1, 2**bits)
    tiny = plain / (1 << generator.randrange(1, 900))
    kind = generator.randrange(4)
    if function in _PERIODIC:
        if kind == 0:
            return sign * tiny
        if kind == 1:
            large = plain * (1 << generator.randrange(1, 900))
            return sign * generator.choice((large, large, large, _WORST))
        turns = generator.randrange(1, 2 ** generator.randrange(2, 60))
        with kernel.digits(_BITS):
            near = kernel.bounds(kernel.pi())[0] * turns / 2
        return sign * near
    if function in _UNIT:
        edge = 1 - Fraction(1, 1 << generator.randrange(1, bits))
        return sign * (tiny, edge, plain, plain / 1000)[kind]
    if function in _NEAR_ONE:
        near = 1 + (sign if function != "acosh" else 1) * plain / (
            1 << generator.randrange(1, bits)
        )
        large = (1 + plain) * (1 << generator.randrange(1, 900))
        return (near, large, 1 + plain, near if function == "acosh" else tiny)[kind]
    return sign * (tiny, plain, plain * 30, plain * 900)[kind]


def _inside(function: str, x: Fraction) -> bool:
    if function in _POSITIVE:
        return x > 0
    return abs(x) < 1 if function in _UNIT else True
