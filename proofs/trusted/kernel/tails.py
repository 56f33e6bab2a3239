"""Enclosures for all later times at once: numbers between ends that may be infinite."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.firstzero import Gap, shown
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.operations import LARGEST, Enclosures
from proofs.trusted.kernel.returns import Launches

_ORDERS = 3  # derivatives of a gap, itself the first, of which one is looked at for ever
End = tuple[int, int]  # the sign of an infinite end, or 0; units of 2^-bits
_ZERO: End = (0, 0)


class Ray(NamedTuple):
    """The real numbers between two ends; the lower may be -infinity, the upper +infinity."""

    lo: End
    hi: End

    @classmethod
    def of(cls, x: Enclosure) -> Ray:
        """Return an enclosure."""
        return cls((0, x.lo), (0, x.hi))


class Rays:
    """The operations on them, each containing all results for real numbers in its arguments."""

    def __init__(self, bits: int) -> None:
        self.bits, self._finite = bits, Enclosures(bits)
        self._limit = 1 << (2 * bits + LARGEST)  # of products, before they are rounded

    def apply(self, op: str, arguments: list[Ray], datum: Fraction) -> Ray:
        """Enclose op(arguments); Unproved where it is not proved defined, or not known here."""
        if not any(x.lo[0] or x.hi[0] for x in arguments):
            known = [Enclosure(x.lo[1], x.hi[1], self.bits) for x in arguments]
            return Ray.of(self._finite.apply(op, known, datum))
        x, y = arguments[0], arguments[-1]
        match op:
            case "+" | "-":
                result = _sum(x, _negative(y) if op == "-" else y)
            case "negative":
                result = _negative(x)
            case "*":
                result = self._product(x, y)
            case "/":
                result = self._product(x, self.apply("^", [y], Fraction(-1)))
            case "^" if datum > 0:
                result = self._power(x, int(datum))
            case "exp":
                result = self._exp(x)
            case "sin" | "cos":
                result = Ray((0, -1 << self.bits), (0, 1 << self.bits))
            case _:
                raise Unproved(f"{op} is not followed for ever")
        return result

    def _exp(self, x: Ray) -> Ray:
        """Enclose exp, which increases, from 0 to infinity."""
        low, high = (
            end if end[0] else self.apply("exp", [Ray(end, end)], Fraction(0))[k]
            for k, end in enumerate(x)
        )
        return Ray(max(low, _ZERO), high)

    def _product(self, x: Ray, y: Ray) -> Ray:
        """Enclose products: of the ends; as all numbers are finite, 0 times them is 0."""
        corners = [(_infinite(a, b), a[1] * b[1]) for a in x for b in y]
        (low, least), (high, most) = min(corners), max(corners)
        if max(-least, most) >= self._limit:
            raise Unproved("a value beyond 2^256")
        return Ray((low, least >> self.bits), (high, -(-most >> self.bits)))

    def _power(self, x: Ray, n: int) -> Ray:
        if n == 1:
            return x
        half = self._power(x, n // 2)
        square = self._product(half, half)
        return self._product(square, x) if n % 2 else square


def _sum(x: Ray, y: Ray) -> Ray:
    low, high = ((a[0] or b[0], a[1] + b[1]) for a, b in zip(x, y, strict=True))
    return Ray(low, high)


def _negative(x: Ray) -> Ray:
    return Ray((-x.hi[0], -x.hi[1]), (-x.lo[0], -x.lo[1]))


def _infinite(a: End, b: End) -> int:
    """Return the sign of a product of two ends if it is infinite; 0 else, as where one is 0."""
    if not (a[0] or b[0]):
        return 0
    one, two = (end[0] or (end[1] > 0) - (end[1] < 0) for end in (a, b))
    return one * two


def require_positive(formulas: Formulas, launches: Launches, gap: Gap, since: Fraction) -> None:
    """Raise Unproved unless a gap is > 0 for all t >= T: see the rule `no-impact`."""
    bits = launches.states[0].bits
    begin = rational(since, bits)
    now = launches.on(gap.orders[:_ORDERS], begin)
    time = Ray((0, begin.lo), (1, 0))
    inputs = [*map(Ray.of, launches.states), time, *map(Ray.of, launches.parameters)]
    for order in range(_ORDERS):
        roots = (*gap.orders[: order + 1], *formulas.parts)
        least = formulas.tape.evaluate(roots, Rays(bits), inputs)[order].lo
        if least > _ZERO or (order and least == _ZERO):
            return
        if now[order].lo <= 0:
            break
    reason = "it is not proved that there is no impact later"
    raise Unproved(f"{reason}, {shown(launches.states)}")
