"""Exact normal forms of formulas: quotients of polynomials over the rationals.

Polynomials are over generators: the variables, pi, and one for each function of an argument that
occurs, as cos(t) or sqrt(1 - x^2). Two arguments are one where their difference has the normal
form 0, and sin and cos of -a are reduced to those of a. A normal form has no square of a sine, by
sin(a)^2 = 1 - cos(a)^2, and none of a root, by sqrt(a)^2 = a. No number is rounded.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import size
from proofs.trusted.kernel.meter import METER

_MOST_DIGITS = 20_000  # bits of a coefficient

Monomial = tuple[tuple[int, int], ...]  # (generator, exponent > 0), generators increasing
Polynomial = dict[Monomial, Fraction]  # no coefficient is 0


class Quotient(NamedTuple):
    """A quotient of normal forms: equal to the formula wherever that is defined."""

    top: Polynomial
    bottom: Polynomial


class Generator(NamedTuple):
    """A function of an argument, and its place among the generators."""

    op: str
    argument: Quotient
    place: int


def constant(value: Fraction) -> Polynomial:
    """Return a constant polynomial."""
    return {(): value} if value else {}


def generator(place: int) -> Quotient:
    """Return a generator as a quotient."""
    return Quotient({((place, 1),): Fraction(1)}, constant(Fraction(1)))


def plus(a: Polynomial, b: Polynomial, factor: int = 1) -> Polynomial:
    """Return a + factor b."""
    result = dict(a)
    for monomial, value in b.items():
        _accumulate(result, monomial, factor * value)
    return result


def _accumulate(polynomial: Polynomial, monomial: Monomial, value: Fraction) -> None:
    """Add a term in place."""
    total = polynomial.get(monomial, Fraction(0)) + value
    if total:
        polynomial[monomial] = total
    else:
        polynomial.pop(monomial, None)


def _merge(a: Monomial, b: Monomial) -> Monomial:
    powers = dict(a)
    for place, n in b:
        powers[place] = powers.get(place, 0) + n
    return tuple(sorted(powers.items()))


@dataclass
class NormalForms:
    """The operations of formulas on quotients; the first generators are the variables, then pi."""

    variables: int
    _known: list[Generator] = field(default_factory=list)
    _squares: dict[int, Polynomial] = field(default_factory=dict)

    def inputs(self) -> list[Quotient]:
        """Return the variables."""
        return [generator(place) for place in range(self.variables)]

    def apply(self, op: str, arguments: list[Quotient], datum: Fraction | None) -> Quotient:
        """Return op(arguments)."""
        match op:
            case "number":
                result = Quotient(constant(datum or Fraction(0)), constant(Fraction(1)))
            case "pi":
                result = generator(self.variables)
            case "+" | "-":
                result = self._sum(arguments[0], arguments[1], 1 if op == "+" else -1)
            case "negative":
                result = Quotient(plus({}, arguments[0].top, -1), arguments[0].bottom)
            case "*":
                result = self._product(*arguments)
            case "/":
                result = self._product(arguments[0], self._inverse(arguments[1]))
            case "^":
                result = self._power(arguments[0], int(datum or 0))
            case "sin" | "cos":
                result = self._circular(op, arguments[0])
            case _:
                result = self._function(op, arguments[0])
        return result

    # -- quotients -----------------------------------------------------------------------------

    def _sum(self, a: Quotient, b: Quotient, factor: int) -> Quotient:
        METER.get().spend(4 * (len(a.top) + len(b.top)))
        if a.bottom == b.bottom:
            return Quotient(plus(a.top, b.top, factor), a.bottom)
        top = plus(self._times(a.top, b.bottom), self._times(b.top, a.bottom), factor)
        return self._quotient(top, self._times(a.bottom, b.bottom))

    def _product(self, a: Quotient, b: Quotient) -> Quotient:
        return self._quotient(self._times(a.top, b.top), self._times(a.bottom, b.bottom))

    def _inverse(self, a: Quotient) -> Quotient:
        return self._quotient(a.bottom, a.top)

    def _power(self, base: Quotient, n: int) -> Quotient:
        if n < 0:
            return self._inverse(self._power(base, -n))
        result = base
        for bit in bin(n)[3:]:
            result = self._product(result, result)
            if bit == "1":
                result = self._product(result, base)
        return result

    def _quotient(self, top: Polynomial, bottom: Polynomial) -> Quotient:
        """Return a quotient; one by a number as a polynomial."""
        if not bottom:
            raise Unproved("a division by the polynomial 0")
        if set(bottom) == {()}:
            top = {monomial: value / bottom[()] for monomial, value in top.items()}
            bottom = constant(Fraction(1))
        return Quotient(top, bottom)

    # -- functions -----------------------------------------------------------------------------

    def _circular(self, op: str, argument: Quotient) -> Quotient:
        """Return sin or cos of an argument: generators, cos just before sin."""
        for known in self._known:
            for sign in (1, -1):
                if known.op == "cos" and not self._sum(known.argument, argument, -sign).top:
                    if op == "cos":
                        return generator(known.place)
                    sine = generator(known.place + 1)
                    return sine if sign > 0 else self.apply("negative", [sine], None)
        place = self._new("cos", argument)
        self._new("sin", argument)
        one = constant(Fraction(1))
        self._squares[place + 1] = plus(one, {((place, 2),): Fraction(1)}, -1)
        return generator(place + (op == "sin"))

    def _function(self, op: str, argument: Quotient) -> Quotient:
        """Return exp, log or sqrt of an argument: a generator."""
        for known in self._known:
            if known.op == op and not self._sum(known.argument, argument, -1).top:
                return generator(known.place)
        place = self._new(op, argument)
        if op == "sqrt":
            if argument.bottom != constant(Fraction(1)):
                raise Unproved("the square root of a quotient")
            self._squares[place] = argument.top
        return generator(place)

    def _new(self, op: str, argument: Quotient) -> int:
        place = self.variables + 1 + len(self._known)
        self._known.append(Generator(op, argument, place))
        return place

    # -- polynomials ---------------------------------------------------------------------------

    def _times(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """Return the normal form of a product."""
        product: Polynomial = {}
        for one, c in a.items():
            for two, d in b.items():
                METER.get().spend(15 + (size(c) + size(d)) / 5)
                _accumulate(product, _merge(one, two), c * d)
        while places := self._squared(product):
            product = self._without_square(product, max(places))
        if any(size(value) > _MOST_DIGITS for value in product.values()):
            raise Unproved("a coefficient with too many digits")
        return product

    def _squared(self, polynomial: Polynomial) -> set[int]:
        """Return the places of the generators of which a square is to be replaced."""
        METER.get().spend(4 * len(polynomial))
        powers = {power for monomial in polynomial for power in monomial}
        return {place for place, n in powers if n > 1 and place in self._squares}

    def _without_square(self, polynomial: Polynomial, place: int) -> Polynomial:
        """Replace one square of a generator in each term: that brings in earlier ones only."""
        result: Polynomial = {}
        for monomial, value in polynomial.items():
            powers = dict(monomial)
            if powers.get(place, 0) < 2:
                _accumulate(result, monomial, value)
                continue
            powers[place] -= 2
            rest = tuple((g, n) for g, n in powers.items() if n)
            for other, factor in self._squares[place].items():
                METER.get().spend(15 + (size(value) + size(factor)) / 5)
                _accumulate(result, _merge(rest, other), value * factor)
        return result
