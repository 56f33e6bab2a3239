"""Exact normal forms of formulas: polynomials, without rounding.

They have rational coefficients, and integer powers, negative ones too, of generators: the
variables; pi; i with i^2 = -1; the inverse of a polynomial; roots and logarithms of arguments, but
for log(1) = 0 and roots of squares of rational numbers, which are numbers; and
exponentials exp(b), exp(i b) of monomials b, of which rational powers occur: exp(i a) is the
product of the powers exp(i b)^q over the terms q b of a. So sin(a) = (exp(i a) - exp(-i a)) / (2 i)
and cos(a) = (exp(i a) + exp(-i a)) / 2 obey the addition theorem and sin^2 + cos^2 = 1 by
themselves. Where a formula is defined, no divisor is 0 and the normal form has the same value.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from math import isqrt
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import size
from proofs.trusted.kernel.meter import METER

MOST_DIGITS = 20_000  # bits of a coefficient

Exponent = Fraction | int
Monomial = tuple[tuple[int, Exponent], ...]  # (generator, exponent not 0), generators increasing
Polynomial = dict[Monomial, Fraction]  # no coefficient is 0


class Exponential(NamedTuple):
    """exp of a monomial, or of i times a monomial."""

    circular: bool
    monomial: Monomial


class Inverse(NamedTuple):
    """1 over a polynomial without inverses, given by its terms, sorted, the first coefficient 1."""

    terms: tuple[tuple[Monomial, Fraction], ...]


class Function(NamedTuple):
    """A root or a logarithm."""

    op: str
    argument: tuple[tuple[Monomial, Fraction], ...]


def number(value: Fraction | int) -> Polynomial:
    """Return a constant polynomial."""
    return {(): Fraction(value)} if value else {}


def power(place: int, n: Exponent = 1) -> Polynomial:
    """Return a power of a generator."""
    return {((place, n),): Fraction(1)}


def plus(a: Polynomial, b: Polynomial, factor: Fraction | int = 1) -> Polynomial:
    """Return a + factor b."""
    METER.get().spend(3 * (len(a) + len(b)))
    result = dict(a)
    for monomial, value in b.items():
        _accumulate(result, monomial, factor * value)
    return result


def over(a: Polynomial, divisor: Monomial) -> Polynomial:
    """Divide a polynomial by a monomial."""
    inverse = tuple((place, -n) for place, n in divisor)
    return {_merge(monomial, inverse): value for monomial, value in a.items()} if divisor else a


def lowest(polynomial: Polynomial) -> dict[int, Exponent]:
    """Return the least exponent of each generator in a polynomial, where that is not 0."""
    powers: dict[int, Exponent] | None = None
    for monomial in polynomial:
        others = dict(monomial)
        if powers is None:
            powers = others
        powers = {g: min(powers.get(g, 0), others.get(g, 0)) for g in powers | others}
    return {g: n for g, n in (powers or {}).items() if n}


@dataclass
class NormalForms:
    """The operations of formulas on normal forms; generators are the variables, pi, i, others."""

    variables: int
    generators: dict[int, Exponential | Inverse | Function] = field(default_factory=dict)
    _places: dict[Exponential | Inverse | Function, int] = field(default_factory=dict)
    _squares: dict[int, Polynomial] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._squares[self.imaginary] = number(-1)

    @property
    def imaginary(self) -> int:
        """The place of i."""
        return self.variables + 1

    def inputs(self) -> list[Polynomial]:
        """Return the variables."""
        return [power(place) for place in range(self.variables)]

    def apply(self, op: str, arguments: list[Polynomial], datum: Fraction) -> Polynomial:
        """Return op(arguments)."""
        match op:
            case "number":
                result = number(datum)
            case "pi":
                result = power(self.variables)
            case "+" | "-":
                result = plus(arguments[0], arguments[1], 1 if op == "+" else -1)
            case "negative":
                result = plus({}, arguments[0], -1)
            case "*":
                result = self.times(*arguments)
            case "/":
                result = self.times(arguments[0], self._inverse(arguments[1]))
            case "^":
                base = arguments[0] if datum > 0 else self._inverse(arguments[0])
                result = self._power(base, abs(int(datum)))
            case "exp":
                result = self._exponential(arguments[0])
            case "sin" | "cos":
                result = self._circular(op, arguments[0])
            case _:
                result = self._function(op, arguments[0])
        return result

    def is_zero(self, polynomial: Polynomial) -> bool:
        """Whether a normal form is found to be 0, wherever it is defined."""
        return not self.cleared(polynomial)[0]

    def cleared(self, polynomial: Polynomial) -> tuple[Polynomial, dict[int, int]]:
        """Return it times powers of polynomials, without inverses; and these: place, exponent.

        The places are those of the inverses, and of i and roots, of which no negative power is
        left. None of the polynomials is 0 where the normal form is defined.
        """
        factors: dict[int, int] = {}
        METER.get().spend(2 * len(polynomial))
        while places := {g for monomial in polynomial for g, n in monomial if self._left(g, n)}:
            place = max(places)
            parts: dict[int, Polynomial] = {}
            for monomial, value in polynomial.items():
                powers = dict(monomial)
                parts.setdefault(int(powers.pop(place, 0)), {})[tuple(powers.items())] = value
            known = self.generators.get(place)
            factors[place] = max(0, *parts) if isinstance(known, Inverse) else -min(parts)
            if isinstance(known, Inverse):  # Horner: the sum of part_k d^(n - k)
                d, polynomial = dict(known.terms), {}
                for k in range(min(parts), factors[place] + 1):
                    polynomial = plus(self.times(polynomial, d), parts.get(k, {}))
            else:
                polynomial = self.times(polynomial, power(place, factors[place]))
        return polynomial, factors

    def _left(self, place: int, n: Exponent) -> bool:
        inverse = isinstance(self.generators.get(place), Inverse)
        return inverse or (n < 0 and place in self._squares)

    def times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """Return the product, with the squares of i and of roots replaced."""
        METER.get().spend(5 * len(a) * len(b) + len(b) * _weight(a) + len(a) * _weight(b))
        product: Polynomial = {}
        longest = max(map(len, b), default=0)
        for one, c in a.items():
            before = len(product)
            for two, d in b.items():
                _accumulate(product, _merge(one, two), c * d)
            METER.get().spend((len(product) - before) * (4 + len(one) + longest))
        while places := {g for m in product for g, n in m if n > 1 and g in self._squares}:
            product = self._without_square(product, max(places))
        if any(size(value) > MOST_DIGITS for value in product.values()):
            raise Unproved("a coefficient with too many digits")
        return product

    def _without_square(self, polynomial: Polynomial, place: int) -> Polynomial:
        """Replace one square of a generator in each term: that brings in earlier ones only."""
        result: Polynomial = {}
        for monomial, value in polynomial.items():
            if dict(monomial).get(place, 0) < 2:
                _accumulate(result, monomial, value)
                continue
            (rest,) = over({monomial: value}, ((place, 2),))
            for other, factor in self._squares[place].items():
                METER.get().spend(12 + 3 * len(monomial) + (size(value) + size(factor) >> 4))
                _accumulate(result, _merge(rest, other), value * factor)
        return result

    def _power(self, base: Polynomial, n: int) -> Polynomial:
        result = base
        for bit in bin(n)[3:]:
            result = self.times(result, result)
            if bit == "1":
                result = self.times(result, base)
        return result

    def _inverse(self, a: Polynomial) -> Polynomial:
        """Return 1 / a: a number, a monomial, and the inverse of what is left of a."""
        rest, factors = self.cleared(a)
        if not rest:
            raise Unproved("a division by the polynomial 0")
        METER.get().spend(3 * _weight(rest))
        divisor = tuple(sorted(lowest(rest).items()))
        terms = sorted(over(rest, divisor).items())
        scaled = tuple((monomial, value / terms[0][1]) for monomial, value in terms)
        result = over(number(1 / terms[0][1]), divisor)
        for place, n in factors.items():
            inverse = isinstance(self.generators.get(place), Inverse)
            result = over(result, ((place, n if inverse else -n),) if n else ())
        return self.times(result, self._generator(Inverse(scaled)) if scaled[1:] else number(1))

    def _generator(self, of: Exponential | Inverse | Function, n: Exponent = 1) -> Polynomial:
        place = self._places.setdefault(of, self.variables + 2 + len(self._places))
        self.generators[place] = of
        return power(place, n)

    def _exponential(
        self, argument: Polynomial, circular: bool = False, sign: int = 1
    ) -> Polynomial:
        """Return exp of sign * argument, or of i times that."""
        powers = [
            number(1 - 2 * (int(value) % 2))  # exp(i pi n)
            if circular and monomial == ((self.variables, 1),) and value.denominator == 1
            else self._generator(Exponential(circular, monomial), _whole(sign * value))
            for monomial, value in argument.items()
        ]
        return reduce(self.times, powers, number(1))

    def _circular(self, op: str, argument: Polynomial) -> Polynomial:
        """Return sin or cos of an argument."""
        one, other = (self._exponential(argument, True, sign) for sign in (1, -1))
        if op == "cos":
            return plus({}, plus(one, other), Fraction(1, 2))
        return self.times(plus(one, other, -1), {((self.imaginary, 1),): Fraction(-1, 2)})  # / 2i

    def _function(self, op: str, argument: Polynomial) -> Polynomial:
        """Return log, atan or sqrt of an argument: a generator, or the number that it is."""
        exact = _exact(op, argument)
        if exact is not None:
            return number(exact)
        for place, known in self.generators.items():
            if isinstance(known, Function) and known.op == op and self._same(known, argument):
                return power(place)
        result = self._generator(Function(op, tuple(sorted(argument.items()))))
        if op == "sqrt":
            self._squares[max(self.generators)] = argument
        return result

    def _same(self, known: Function, argument: Polynomial) -> bool:
        return self.is_zero(plus(dict(known.argument), argument, -1))


def _exact(op: str, argument: Polynomial) -> Fraction | None:
    """Return log(1) = atan(0) = 0, and the root of 0 or of the square of a rational number."""
    if not set(argument) <= {()}:
        return None
    value = argument.get((), Fraction(0))
    if op != "sqrt":
        return Fraction(0) if value == int(op == "log") else None
    if value < 0:
        return None
    root = Fraction(isqrt(value.numerator), isqrt(value.denominator))
    return root if root * root == value else None


def _accumulate(polynomial: Polynomial, monomial: Monomial, value: Fraction) -> None:
    """Add a term in place."""
    known = polynomial.get(monomial)
    total = value if known is None else known + value
    if total:
        polynomial[monomial] = total
    else:
        polynomial.pop(monomial, None)


def _weight(polynomial: Polynomial) -> int:
    """Return the work of a factor, for each term of the other one."""
    return sum(1 + len(each) + (size(value) >> 4) for each, value in polynomial.items())


def _whole(value: Fraction) -> Exponent:
    """Return a number as an integer if it is one: integers are found faster in a table."""
    return value.numerator if value.denominator == 1 else value


def _merge(a: Monomial, b: Monomial) -> Monomial:
    """Multiply two monomials."""
    if not (a and b):
        return a or b
    powers: dict[int, Exponent] = dict(a)
    for place, n in b:
        powers[place] = powers.get(place, 0) + n
    return tuple(sorted((place, n) for place, n in powers.items() if n))
