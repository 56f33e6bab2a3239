"""Operations next to cancellation, overflow and 0, and elementary functions at hard arguments.

Of Interval at any precision, of IntervalArray in binary64.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from random import Random
from typing import Any

from intervals import Interval, IntervalArray
from proofs.benchmark.peers import Arithmetic, Range
from proofs.stress.cases import Answer, Case, Draw
from proofs.stress.truth import Truth

_OPERATIONS: dict[str, Any] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_PERIODIC = ("sin", "cos", "tan")
_NEAR_ONE = ("log", "log2", "log10", "acosh", "sqrt", "cbrt")
_UNIT = ("asin", "acos", "atanh", "log1p")
_GROWING = ("exp", "exp2", "exp10", "expm1", "sinh", "cosh", "tanh", "atan", "asinh")
NAMES = _PERIODIC + _NEAR_ONE + _UNIT + _GROWING
_POSITIVE = ("log", "log2", "log10", "sqrt")
_WORST = Fraction(6381956970095103 << 797)  # of binary64, the closest to a multiple of pi/2
_BITS = 500  # of the truth, and more where the argument is large or the value next to 0
_MOST_BITS = 20_000
_LEAST = -1074  # binary64 has no multiples of less than 2^-1074


def _operand(ends: Range, bits: int, array: bool, easy: Fraction) -> Any:
    """Return an Interval, or an IntervalArray with two easy neighbours."""
    return IntervalArray([easy, ends, easy]) if array else Interval(*ends, precision=bits)


def _answer(made: Interval | IntervalArray) -> Answer:
    ends = (made.inf, made.sup) if isinstance(made, Interval) else (made.inf[1], made.sup[1])
    return {"value": (Fraction(ends[0]), Fraction(ends[1]))}


def _case(
    family: str, given: dict[str, Any], ask: Callable[[], Any], truths: Callable[[Arithmetic], Any]
) -> Case:
    """Return a case whose answer is one value, to so many bits: in binary64 if of an array."""
    bits, array = given["precision"], given["array"]

    def least(hull: Range) -> Fraction:
        low, high = (rounded_down(x, bits, array) for x in (hull[0], -hull[1]))
        return -high - low

    return Case(family, given, lambda: _answer(ask()), truths, least)


def rounded_down(value: Fraction, bits: int, binary64: bool = True) -> Fraction:
    """Round down to `bits` bits, to a multiple of the least number of binary64 if that is asked."""
    if value == 0:
        return value
    exponent = abs(value.numerator).bit_length() - value.denominator.bit_length()
    exponent -= abs(value) < Fraction(2) ** exponent
    place = exponent - bits + 1
    unit = Fraction(2) ** (max(place, _LEAST) if binary64 else place)
    return value // unit * unit


# -- operations ------------------------------------------------------------------------------------


def operation_case(
    family: str, operation: str, pairs: tuple[Range, Range], bits: int = 53, array: bool = False
) -> Case:
    """Return an operation on two intervals, their ends of at most so many bits."""
    apply, (first, second) = _OPERATIONS[operation], pairs
    given = {"precision": bits, "array": array, "operation": operation}
    given |= zip(("low", "high", "left", "right"), (*first, *second), strict=True)

    def ask() -> Any:
        return apply(*(_operand(x, bits, array, Fraction(3, 4)) for x in pairs))

    def truths(kernel: Arithmetic) -> list[Truth]:
        if operation == "/" and second[0] <= 0 <= second[1]:
            return [Truth({}, "a quotient by 0")]
        values = [apply(a, b) for a in first for b in second]  # the ends are among these
        return [Truth({"value": (end, end)}) for end in (min(values), max(values))]

    return _case(family, given, ask, truths)


def operation(random: Draw, _: Arithmetic) -> Case:
    """Return a random operation on random hard operands."""
    array = random.random() < 0.5
    bits = 53 if array else random.choice((53, 53, 24, 64, 200))
    low, high = _hard(random, bits)
    left, right = _hard(random, bits)
    if random.random() < 0.3:  # next to cancellation
        left, right = (low, high) if random.random() < 0.5 else (-high, -low)
        right += abs(right) / 2 ** (bits - 2)
        right = -rounded_down(-right, bits)
    symbol = random.choice("+-*/")
    return operation_case(random.family, symbol, ((low, high), (left, right)), bits, array)


def _hard(random: Random, bits: int) -> Range:
    """Return an interval of tiny, large or plain numbers, or one around 0."""
    scale = random.choice((0, 0, 0, 1, -1)) * random.randrange(1, 1000)
    low = random.choice((-1, 1)) * Fraction(random.getrandbits(bits), 1 << bits)
    width = abs(low) / (1 << random.choice((bits - 1, bits // 2, 1)))
    width = random.choice((0, 1, 1)) * width + random.choice((0, 0, 0, 1)) * abs(low)
    ends = (low * Fraction(2) ** scale, (low + width) * Fraction(2) ** scale)
    down = rounded_down(ends[0], bits)
    return down, max(down, -rounded_down(-ends[1], bits))


# -- functions -------------------------------------------------------------------------------------


def function_case(family: str, name: str, ends: Range, bits: int = 53, array: bool = False) -> Case:
    """Return a function of an interval whose ends have at most so many bits."""
    given = {"precision": bits, "array": array, "function": name, "low": ends[0], "high": ends[1]}

    def ask() -> Any:
        easy = Fraction(5, 4) if name == "acosh" else Fraction(3, 4)
        return getattr(_operand(ends, bits, array, easy), name)()

    return _case(family, given, ask, lambda kernel: _extremes(kernel, name, ends, bits))


def _extremes(
    kernel: Arithmetic, function: str, ends: Range, precision: int
) -> Sequence[Truth | None]:
    """Return the least and the largest value, or one Truth without value if there is a pole.

    With so many bits that it is known between which two numbers of the precision each lies.
    """
    bits = _BITS + max(map(abs, ends)).__ceil__().bit_length()
    while True:
        fine = precision if bits < _MOST_BITS else 1  # such a number itself never ends it
        try:
            with kernel.precision(bits):
                return _range(kernel, function, ends, fine)
        except ArithmeticError:
            if bits >= _MOST_BITS:
                return [None]
            bits *= 3


def _range(kernel: Arithmetic, function: str, ends: Range, precision: int) -> list[Truth | None]:
    """Return the least and the largest value; ArithmeticError if more bits are needed."""
    low, high = ends
    values = [_value(kernel, function, x, precision) for x in {low, high}]
    if function == "cosh" and low < 0 < high:
        values.append((Fraction(1), Fraction(1)))
    if function in _PERIODIC:
        # turning points of sin at pi/2 + k pi, of cos at k pi; poles of tan at pi/2 + k pi
        shift = Fraction(0) if function == "cos" else Fraction(1, 2)
        first, last = (_turns(kernel, x, shift) for x in ends)
        if first < last and function == "tan":
            return [Truth({}, "a pole")]
        turning = range(first + 1, min(last, first + 2) + 1)
        values += [(Fraction(1 - 2 * (k % 2)),) * 2 for k in turning]
    return [Truth({"value": min(values)}), Truth({"value": max(values, key=lambda v: v[1])})]


def _value(kernel: Arithmetic, function: str, x: Fraction, precision: int) -> Range:
    low, high = kernel.ends(_called(kernel, function, x))
    if rounded_down(low, precision, False) != rounded_down(high, precision, False):
        raise ArithmeticError("it is not known which way it is to be rounded")
    if high - low > min(abs(low), abs(high)) / 10**20:
        raise ArithmeticError("few of its digits are known")
    return low, high


def _called(kernel: Arithmetic, function: str, x: Fraction) -> Any:
    """Return a function of x; those that a kernel lacks, or has on another domain, by others."""
    exp, log = partial(kernel.call, "exp"), partial(kernel.call, "log")
    at = kernel.point(x)
    if function == "cbrt" and x != 0:
        return exp(log(abs(at)) / 3) * (1 if x > 0 else -1)
    if function in ("exp2", "exp10"):
        return exp(at * log(kernel.point(int(function[3:]))))
    if function in ("log2", "log10"):
        return log(at) / log(kernel.point(int(function[3:])))
    return at if function == "cbrt" else kernel.call(function, at)


def _turns(kernel: Arithmetic, x: Fraction, shift: Fraction) -> int:
    """Return the largest k with (k + shift) pi <= x."""
    low, high = kernel.ends(kernel.point(x) / kernel.pi() - kernel.point(shift))
    if low // 1 != high // 1:
        raise ArithmeticError("it is not known on which side of a turning point it is")
    return int(low // 1)


def function(random: Draw, kernel: Arithmetic) -> Case:
    """Return a random function at a random hard argument, a point or an interval."""
    name = random.choice(NAMES)
    array = random.family == "arrays"
    bits = 53 if array else random.choice((24, 53, 64, 100, 200, 333))
    low = rounded_down(_argument(random, kernel, name, bits), bits)
    high = low
    if random.random() < 0.5:
        width = abs(low) / (1 << random.choice((bits - 1, bits - 1, bits // 2, 10, 1)))
        if name in _PERIODIC and abs(low) < 100 and random.random() < 0.3:
            width = Fraction(random.uniform(0, 6.5))
        high = max(low, -rounded_down(-low - width, bits))
        outside = high <= 0 if name in _POSITIVE else name in _UNIT and abs(high) >= 1
        high = low if outside else high
    return function_case(random.family, name, (low, high), bits, array)


def _argument(random: Random, kernel: Arithmetic, function: str, bits: int) -> Fraction:
    """Return a point of the domain, next to its ends, to zeros, to poles, tiny, large or plain."""
    sign = random.choice((-1, 1))
    plain = Fraction(random.getrandbits(bits) | 1, 2**bits)
    tiny = plain / (1 << random.randrange(1, 900))
    kind = random.randrange(4)
    if function in _PERIODIC:
        if kind == 0:
            return sign * tiny
        if kind == 1:
            large = plain * (1 << random.randrange(1, 900))
            return sign * random.choice((large, large, large, _WORST))
        turns = random.randrange(1, 2 ** random.randrange(2, 60))
        with kernel.precision(_BITS):
            return sign * kernel.ends(kernel.pi())[0] * turns / 2
    if function in _UNIT:
        edge = 1 - Fraction(1, 1 << random.randrange(1, bits))
        return sign * (tiny, edge, plain, plain / 1000)[kind]
    if function in _NEAR_ONE:
        side = 1 if function == "acosh" else sign
        near = 1 + side * plain / (1 << random.randrange(1, bits))
        large = (1 + plain) * (1 << random.randrange(1, 900))
        return (near, large, 1 + plain, near if function == "acosh" else tiny)[kind]
    return sign * (tiny, plain, plain * 30, plain * 900)[kind]
