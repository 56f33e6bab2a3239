"""Taylor series of normal forms in one variable x, with normal forms as coefficients.

A polynomial in x and in exponentials of terms b x^d, b without x, is analytic in x at fixed values
of the other variables; its coefficients are those of products of series of exp. No number is
rounded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.normalform import (
    Exponential,
    Inverse,
    Monomial,
    NormalForms,
    Polynomial,
    lowest,
    number,
    over,
    plus,
    power,
)

_MOST_ORDER = 8  # of a divisor


@dataclass(frozen=True)
class Taylor:
    """Series in the variable x of the given place; what `nonzero` are may be divided by."""

    forms: NormalForms
    x: int
    nonzero: Sequence[Polynomial]

    def vanishes(self, form: Polynomial, order: int) -> bool:
        """Whether a normal form is proved to be O(x^order) as x -> 0.

        It is N / (x^k D), with N and D analytic, D = O(x^m) of that order by `order`; so it is
        if the coefficients of N below x^(order + k + m) are 0.
        """
        numerator, factors = self.forms.cleared(form)
        order += self._pole(numerator)
        for place, n in factors.items():
            divisor = self.forms.generators.get(place)
            if isinstance(divisor, Inverse) and self._varies(place):
                order += n * self.order(dict(divisor.terms))
        return all(map(self.forms.is_zero, self.coefficients(numerator, order)))

    def order(self, form: Polynomial) -> int:
        """Return m such that a normal form is x^m c + O(x^(m+1)) and c is not 0.

        Raises Unproved unless c is a number times a product of powers of `nonzero`. (m is that of
        the numerator, as x^k D, see above, is only multiplied with: the form is not 0 either.)
        """
        numerator, _ = self.forms.cleared(form)
        series = self.coefficients(numerator, _MOST_ORDER + 1)
        order = next((n for n, each in enumerate(series) if not self.forms.is_zero(each)), None)
        if order is None:
            raise Unproved("a division by a series of which no term is known but 0")
        rest = self._without_units(series[order])
        for factor in map(self._without_units, self.nonzero):
            while factor.keys() - {()} and (ratio := divided(rest, factor)) is not None:
                rest = ratio
        if rest.keys() != {()}:
            raise Unproved("a division by a formula that is not said to be nonzero")
        return order

    def coefficients(self, polynomial: Polynomial, length: int) -> list[Polynomial]:
        """Return the coefficients of x^-k, ..., x^(length - 1 - k), x^-k being its pole."""
        METER.get().spend(10 * length)
        groups: dict[Monomial, Polynomial] = {}  # by what varies with x
        for monomial, value in polynomial.items():
            varying = tuple(each for each in monomial if self._varies(each[0]))
            rest = tuple(each for each in monomial if each not in varying)
            groups.setdefault(varying, {})[rest] = value
        total, pole = [number(0)] * length, self._pole(polynomial)
        for varying, factor in groups.items():
            start, rates = self._rates(varying)
            start += pole
            terms = [number(1)]
            for k in range(1, length - start):
                term = number(0)
                for d, rate in rates.items():
                    if d <= k:
                        term = plus(term, self.forms.times(rate, terms[k - d]), Fraction(1, k))
                terms.append(term)
            for k, term in enumerate(terms[: max(0, length - start)], start):
                total[k] = plus(total[k], self.forms.times(factor, term))
        return total

    def _rates(self, varying: Monomial) -> tuple[int, dict[int, Polynomial]]:
        """Return n and, by d, the d b_d for which the monomial is x^n exp(sum of b_d x^d).

        The coefficients e_k of the exponential, e' = e u', obey k e_k = sum of d b_d e_(k-d).
        """
        start, rates = 0, dict[int, Polynomial]()
        for place, n in varying:
            known = self.forms.generators.get(place)
            if place == self.x:
                start = int(n)
                continue
            monomial = known.monomial if isinstance(known, Exponential) else ()
            d = int(dict(monomial).get(self.x, 0))
            others = tuple(each for each in monomial if each[0] != self.x)
            if d < 1 or any(self._varies(g) for g, _ in others):
                raise Unproved("no series of a function of this argument")
            rate = {others: Fraction(n * d)}
            if isinstance(known, Exponential) and known.circular:
                rate = self.forms.times(rate, power(self.forms.imaginary))
            rates[d] = plus(rates.get(d, {}), rate)
        return start, rates

    def _pole(self, polynomial: Polynomial) -> int:
        return int(-min(0, lowest(polynomial).get(self.x, 0)))

    def _varies(self, place: int) -> bool:
        """Whether a generator depends on x (roots and logarithms of what does are not met here)."""
        known = self.forms.generators.get(place)
        if isinstance(known, Exponential):
            return any(self._varies(g) for g, _ in known.monomial)
        if isinstance(known, Inverse):
            return any(self._varies(g) for monomial, _ in known.terms for g, _ in monomial)
        return place == self.x

    def _without_units(self, form: Polynomial) -> Polynomial:
        """Return a numerator, without factors that are exponentials or i."""
        rest, _ = self.forms.cleared(form)
        kept = [
            (place, n)
            for place, n in sorted(lowest(rest).items())
            if n < 0 or place == self.forms.imaginary or self._is_exponential(place)
        ]
        return over(rest, tuple(kept))

    def _is_exponential(self, place: int) -> bool:
        return isinstance(self.forms.generators.get(place), Exponential)


def divided(top: Polynomial, bottom: Polynomial) -> Polynomial | None:
    """Return top / bottom if that is a polynomial, by division of leading terms.

    No exponent is negative. Relations between generators are not used.
    """
    result: Polynomial = {}
    lead = max(bottom, key=_order)
    while top:
        first = max(top, key=_order)
        if any(dict(first).get(place, 0) < n for place, n in lead):
            return None
        (monomial,) = over({first: Fraction(1)}, lead)
        result[monomial] = top[first] / bottom[lead]
        METER.get().spend(8 * len(bottom))
        shifted = over(bottom, tuple((place, -n) for place, n in monomial))
        top = plus(top, shifted, -result[monomial])
    return result


def _order(monomial: Monomial) -> Monomial:
    """Order monomials lexicographically."""
    return tuple((-place, n) for place, n in monomial)
