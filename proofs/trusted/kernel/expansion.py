"""Laurent series in one variable, with normal forms as coefficients.

A series stands for a function analytic at 0 but for a pole, at fixed values of the other variables.
Every division is by a leading coefficient that is a number other than 0, or one of the formulas
that are said not to be 0. No number is rounded.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.angles import Angles
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.normalform import Polynomial, Quotient, constant, generator

_ONE = Quotient(constant(Fraction(1)), constant(Fraction(1)))
_ZERO = Quotient({}, constant(Fraction(1)))
_MINUS = Fraction(-1)


class Laurent(NamedTuple):
    """terms[0] x^start + terms[1] x^(start + 1) + ... + O(x^end)."""

    start: int
    terms: tuple[Quotient, ...]

    @property
    def end(self) -> int:
        """The first power that is not known."""
        return self.start + len(self.terms)

    def coefficient(self, power: int) -> Quotient:
        """Return the coefficient of a power below the end."""
        return self.terms[power - self.start] if power >= self.start else _ZERO


@dataclass
class Expansions:
    """The operations of formulas on series; x is the variable of the given number.

    length: how many terms a series begins with. nonzero: what may be divided by.
    """

    forms: Angles
    number: int
    length: int
    nonzero: tuple[Quotient, ...]

    def inputs(self) -> list[Laurent]:
        """Return the variables: x itself, the others as constants."""
        found = [self._constant(generator(place)) for place in range(self.forms.variables)]
        found[self.number] = Laurent(1, self._constant(_ONE).terms)
        return found

    def apply(self, op: str, arguments: list[Laurent], datum: Fraction | None) -> Laurent:
        """Return op(arguments)."""
        match op:
            case "number" | "pi":
                result = self._constant(self.forms.apply(op, [], datum))
            case "+":
                result = self._sum(*arguments)
            case "-":
                result = self._sum(arguments[0], self._scaled(arguments[1], _MINUS))
            case "negative":
                result = self._scaled(arguments[0], _MINUS)
            case "*":
                result = self._product(*arguments)
            case "/":
                result = self._product(arguments[0], self._inverse(arguments[1]))
            case "^":
                result = self._power(arguments[0], int(datum or 0))
            case "sin" | "cos":
                result = self._circular(op, arguments[0])
            case _:
                raise Unproved(f"no series of {op}")
        return result

    def _constant(self, value: Quotient) -> Laurent:
        return Laurent(0, (value, *[_ZERO] * (self.length - 1)))

    def _plus(self, a: Quotient, b: Quotient) -> Quotient:
        return self.forms.apply("+", [a, b], None)

    def _times(self, a: Quotient, b: Quotient) -> Quotient:
        return self.forms.apply("*", [a, b], None) if a.top and b.top else _ZERO

    def _scaled(self, a: Laurent, factor: Fraction) -> Laurent:
        return self._by(Quotient(constant(factor), constant(Fraction(1))), a)

    def _sum(self, a: Laurent, b: Laurent) -> Laurent:
        start, end = min(a.start, b.start), min(a.end, b.end)
        powers = range(start, max(start, end))
        return Laurent(start, tuple(self._plus(a.coefficient(n), b.coefficient(n)) for n in powers))

    def _product(self, a: Laurent, b: Laurent) -> Laurent:
        terms = []
        for n in range(min(len(a.terms), len(b.terms))):
            total = _ZERO
            for i in range(n + 1):
                total = self._plus(total, self._times(a.terms[i], b.terms[n - i]))
            terms.append(total)
        return Laurent(a.start + b.start, tuple(terms))

    def _inverse(self, a: Laurent) -> Laurent:
        """Return 1 / a: b_0 = 1 / a_0, b_n = -(a_1 b_(n-1) + ... + a_n b_0) / a_0."""
        while a.terms and not a.terms[0].top:
            a = Laurent(a.start + 1, a.terms[1:])
        if not a.terms:
            raise Unproved("a division by a series of which no term is known but 0")
        lead = a.terms[0]
        if not self._is_nonzero(lead):
            raise Unproved("a division by a formula that is not said to be nonzero")
        first = self.forms.apply("/", [_ONE, lead], None)
        terms = [first]
        for n in range(1, len(a.terms)):
            total = _ZERO
            for i in range(1, n + 1):
                total = self._plus(total, self._times(a.terms[i], terms[n - i]))
            terms.append(self._times(self.forms.apply("negative", [total], None), first))
        return Laurent(-a.start, tuple(terms))

    def _is_nonzero(self, value: Quotient) -> bool:
        """Whether a formula is a number, not 0, times some of those that are said to be nonzero."""
        if set(value.top) == {()}:
            return True
        for one in self.nonzero:
            rest = self.forms.apply("/", [value, one], None)
            if _proportional(rest.top, rest.bottom):
                return True
            if set(rest.bottom) == {()} and _degree(rest.top) < _degree(value.top):
                return self._is_nonzero(rest)
        return False

    def _power(self, base: Laurent, n: int) -> Laurent:
        if n < 0:
            return self._inverse(self._power(base, -n))
        result = base
        for _ in range(n - 1):
            result = self._product(result, base)
        return result

    def _split(self, a: Laurent) -> tuple[Quotient, Laurent]:
        """Return the constant term and the rest, of a series without a pole."""
        if a.end <= 0 or any(a.coefficient(n).top for n in range(a.start, 0)):
            raise Unproved("a function at a pole")
        rest = tuple(a.coefficient(n) for n in range(1, a.end))
        return a.coefficient(0), Laurent(1, rest)

    def _circular(self, op: str, argument: Laurent) -> Laurent:
        """Return sin or cos of c + d, d = O(x), by the addition theorem and the series of both."""
        middle, rest = self._split(argument)
        cosine, sine = (self.forms.apply(name, [middle], None) for name in ("cos", "sin"))
        power = Laurent(0, (_ONE, *[_ZERO] * (rest.end - 1)))
        sums = [Laurent(0, (_ZERO,) * rest.end)] * 2  # of the series of cos and sin of d
        for n in range(rest.end):
            sums[n % 2] = self._sum(sums[n % 2], power)
            factor = Fraction(-1 if n % 2 else 1, n + 1)  # from x^n / n! to the next, with sign
            power = self._scaled(self._product(power, rest), factor)
        if op == "sin":
            return self._sum(self._by(sine, sums[0]), self._by(cosine, sums[1]))
        return self._sum(self._by(cosine, sums[0]), self._scaled(self._by(sine, sums[1]), _MINUS))

    def _by(self, factor: Quotient, a: Laurent) -> Laurent:
        return Laurent(a.start, tuple(self._times(factor, term) for term in a.terms))


def _proportional(a: Polynomial, b: Polynomial) -> bool:
    """Whether a is a number times b."""
    if a.keys() != b.keys():
        return False
    return len({value / b[monomial] for monomial, value in a.items()}) == 1


def _degree(a: Polynomial) -> int:
    return max(sum(n for _, n in monomial) for monomial in a)
