"""Normal forms in which sines and cosines of sums and of multiples are expanded.

Every argument is a sum of terms q b, q rational, b a monomial or one over a polynomial. The terms
with the same b that occur are integer multiples of one unit; sin and cos of the units are the
generators, all others are polynomials in them by the addition theorem, exactly.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.normalform import (
    Monomial,
    NormalForms,
    Polynomial,
    Quotient,
    constant,
    plus,
)

_MOST = 24  # multiples of a unit

Base = tuple[Monomial, tuple[tuple[Monomial, Fraction], ...]]
Point = tuple[Quotient, Quotient]  # cosine and sine of an angle


class Finer(Exception):
    """A unit turned out too coarse; it has been made finer: begin again."""


@dataclass
class Angles(NormalForms):
    """The operations of formulas on quotients, with the addition theorem."""

    units: dict[Base, Fraction] = field(default_factory=dict)

    def _circular(self, op: str, argument: Quotient) -> Quotient:
        """Return sin or cos of an argument, term by term."""
        one = Quotient(constant(Fraction(1)), constant(Fraction(1)))
        total: Point = (one, Quotient({}, constant(Fraction(1))))
        for monomial, value in sorted(argument.top.items()):
            base, factor = _base(monomial, argument.bottom)
            total = self._turned(total, self._multiple(base, value * factor))
        return total[op == "sin"]

    def _multiple(self, base: Base, value: Fraction) -> Point:
        """Return cosine and sine of value times a base."""
        unit = self.units.setdefault(base, abs(value))
        count = value / unit
        if count.denominator != 1:
            self.units[base] = Fraction(
                gcd(value.numerator * unit.denominator, unit.numerator * value.denominator),
                value.denominator * unit.denominator,
            )
            raise Finer
        if abs(count) > _MOST:
            raise Unproved(f"an angle of more than {_MOST} units")
        monomial, bottom = base
        angle = Quotient({monomial: unit}, dict(bottom))
        cosine, sine = (super(Angles, self)._circular(op, angle) for op in ("cos", "sin"))
        step = (cosine, sine if count > 0 else self.apply("negative", [sine], None))
        result = step
        for _ in range(abs(int(count)) - 1):
            result = self._turned(result, step)
        return result

    def _turned(self, one: Point, two: Point) -> Point:
        """Return cosine and sine of the sum of two angles."""
        (a, b), (c, d) = one, two
        return (
            self._sum(self._product(a, c), self._product(b, d), -1),
            self._sum(self._product(b, c), self._product(a, d), 1),
        )

    def _sum(self, a: Quotient, b: Quotient, factor: int) -> Quotient:
        """Return a + factor b; over one of the denominators if it is a multiple of the other."""
        if a.bottom != b.bottom:
            for one, two in ((a, b), (b, a)):
                ratio = self._divided(two.bottom, one.bottom)
                if ratio is not None:
                    wider = Quotient(self._times(one.top, ratio), two.bottom)
                    a, b = (wider, b) if one is a else (a, wider)
                    break
        return super()._sum(a, b, factor)

    def _divided(self, top: Polynomial, bottom: Polynomial) -> Polynomial | None:
        """Return top / bottom if that is a polynomial, by division of leading terms.

        The quotient is one of polynomials, without the relations between generators.
        """
        result: Polynomial = {}
        lead = max(bottom, key=_order)
        while top:
            first = max(top, key=_order)
            if _common([first, lead]) != lead:
                return None
            (monomial,) = _without({first: Fraction(1)}, lead)
            result[monomial] = top[first] / bottom[lead]
            METER.get().spend(15 * len(bottom))
            top = plus(top, _shifted(bottom, monomial, -result[monomial]))
        return result

    def _quotient(self, top: Polynomial, bottom: Polynomial) -> Quotient:
        """Return a quotient without common factors that are single generators.

        Where the quotient is defined, its denominator is not 0, hence nor are they.
        """
        common = _common([*top, *bottom]) if bottom else ()
        if common:
            top, bottom = _without(top, common), _without(bottom, common)
        return super()._quotient(top, bottom)


def _base(monomial: Monomial, bottom: Polynomial) -> tuple[Base, Fraction]:
    """Write a monomial over a polynomial as a factor times a base in lowest terms."""
    common = _common([monomial, *bottom])
    reduced = _without(bottom, common)
    first = reduced[min(reduced)]
    (monomial,) = _without({monomial: Fraction(1)}, common)
    scaled = tuple(sorted((other, value / first) for other, value in reduced.items()))
    return (monomial, scaled), 1 / first


def _common(monomials: list[Monomial]) -> Monomial:
    """Return the greatest common divisor of monomials."""
    if () in monomials:
        return ()
    powers = dict(monomials[0])
    for monomial in monomials[1:]:
        others = dict(monomial)
        powers = {g: min(n, others[g]) for g, n in powers.items() if g in others}
    return tuple(sorted(powers.items()))


def _without(polynomial: Polynomial, divisor: Monomial) -> Polynomial:
    """Divide a polynomial by a monomial that divides all its terms."""
    taken = dict(divisor)
    return {
        tuple((g, n - taken.get(g, 0)) for g, n in monomial if n > taken.get(g, 0)): value
        for monomial, value in polynomial.items()
    }


def _shifted(polynomial: Polynomial, monomial: Monomial, factor: Fraction) -> Polynomial:
    """Multiply a polynomial by a monomial and a number."""
    powers = Counter(dict(monomial))
    return {
        tuple(sorted((powers + Counter(dict(other))).items())): factor * value
        for other, value in polynomial.items()
    }


def _order(monomial: Monomial) -> tuple[tuple[int, int], ...]:
    """Order monomials lexicographically."""
    return tuple((-place, n) for place, n in monomial)
