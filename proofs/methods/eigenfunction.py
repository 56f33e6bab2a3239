"""Eigenfunctions of transfer operators by collocation: candidates, nothing here is proved.

At Chebyshev's nodes L_s h = mean h, L_s h the sum of |g_i'|^s h(g_i), for h a sum of Chebyshev's
polynomials. In floating point first; then to twice as many digits again and again, by Newton's
method, its linear equations by iterative refinement of what floating point gives.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from intervals import Undecided
from proofs.trusted.kernel.arithmetic import Enclosure, pi, rational
from proofs.trusted.kernel.complexes import BITS, Ellipse
from proofs.trusted.kernel.elementary import exp, log_of
from proofs.trusted.kernel.transfer import Branches, Collocation, Series, Trial

if TYPE_CHECKING:
    import numpy as np

    _Matrix = np.ndarray[Any, Any]

_MOST_NODES = 2500
_FIRST = 40  # bits that floating point is trusted with
_STEPS = 60  # of Newton's method, or of secants
_CLOSE = 1e-13
_LITTLE = 1.05  # so many times the nodes cost little
_BITS_AT_ONCE = 400  # of what a system of linear equations is solved to
_SPARE = 24  # bits that are computed beyond those that count
_MARGIN = 24  # bits of a step of the ladder that rounding may spoil


def candidate(
    branches: Branches,
    ellipse: Ellipse,
    arcs: int,
    digits: int,
    s: Fraction | None = None,
) -> tuple[Trial, Collocation]:
    """Return guesses of s and h, L_s h = h; for a given s, of mean and h, L_s h = mean h."""
    guard = 3 + math.ceil(2 * math.log10(digits + 10))
    goal = max(BITS, math.ceil((digits + guard) * math.log2(10)))
    ladder = [goal]
    while ladder[0] > 2 * (_FIRST + _MARGIN):
        ladder.insert(0, ladder[0] // 2 + _MARGIN)
    rate = math.log2(ellipse.rho)
    least = [math.ceil(bits / rate) + 2 for bits in (_FIRST, *ladder)]
    count = least[-1]
    if len(ladder) > 1 and count < 2 * least[-2] < _LITTLE * count:
        count = 2 * least[-2]  # so that every other node is enough before
    if count > _MOST_NODES:
        raise Undecided(f"{digits} digits need {count} nodes")
    table = _Table.of(branches, ellipse, count, goal + 16)
    eigenfunction = _Eigenfunction.rough(table.part(least[0], BITS), s)
    for bits, terms in zip(ladder, least[1:], strict=True):
        eigenfunction.refine(table.part(terms, bits + 16))
    unit = 10 ** (digits + guard)
    h = tuple(
        Fraction(round(Fraction(c, 1 << eigenfunction.bits) * unit), unit)
        for c in eigenfunction.terms
    )
    s, mean = (
        Fraction(round(Fraction(x, 1 << eigenfunction.bits) * unit), unit)
        for x in (eigenfunction.s, eigenfunction.mean)
    )
    by = Collocation(ellipse, arcs, len(h), mean, goal + 16)
    return Trial(s, h), by


@dataclass(frozen=True)
class _Table:
    """Chebyshev's nodes u_j, and for each branch the images v_ij in [-1, 1] and log |g_i'|."""

    bits: int
    nodes: list[int]
    images: list[list[int]]
    rates: list[list[int]]

    @classmethod
    def of(cls, branches: Branches, ellipse: Ellipse, count: int, bits: int) -> _Table:
        middle, half = (rational(each, bits) for each in ellipse.coordinates)
        nodes = [(pi(bits) * (2 * j + 1) / (2 * count)).sincos()[1] for j in range(count)]
        columns = [branches.at(middle + half * u) for u in nodes]
        images, rates = [], []
        for row in zip(*columns, strict=True):
            images.append([_mid((y - middle) / half) for y, _ in row])
            rates.append([_mid(log_of(rate if rate.lo > 0 else -rate)) for _, rate in row])
        return cls(bits, [_mid(u) for u in nodes], images, rates)

    def part(self, least: int, bits: int) -> _Table:
        """Return so many nodes, or a few more, at equally many angles; with fewer bits."""
        step, down = max(1, len(self.nodes) // least), self.bits - bits

        def few(values: list[int]) -> list[int]:
            return [value >> down for value in values[step // 2 :: step]]

        images, rates = ([few(row) for row in rows] for rows in (self.images, self.rates))
        return _Table(bits, few(self.nodes), images, rates)

    def float(self, values: Sequence[int]) -> _Matrix:
        """Return the numbers in floating point."""
        import numpy as np

        return np.array([value / (1 << self.bits) for value in values])


def _mid(x: Enclosure) -> int:
    return (x.lo + x.hi) >> 1


@dataclass
class _Eigenfunction:
    """h = sum of terms[k] T_k, terms[0] = 1, with L_s h = mean h, about, in units of 2^-bits.

    given: s, where it is, and mean is looked for; where it is None, mean is 1.
    """

    terms: list[int]
    s: int
    mean: int
    bits: int
    given: Fraction | None

    @classmethod
    def rough(cls, table: _Table, given: Fraction | None) -> _Eigenfunction:
        """Return the leading eigenfunction in floating point, s by secants."""
        import numpy as np
        from numpy.polynomial.chebyshev import chebvander

        count = len(table.nodes)
        inverse = np.linalg.inv(chebvander(table.float(table.nodes), count - 1))
        basis = [chebvander(table.float(v), count - 1) for v in table.images]
        rates = [table.float(rate)[:, None] for rate in table.rates]

        def leading(s: float) -> tuple[float, Any]:
            terms = [np.exp(s * r) * b for r, b in zip(rates, basis, strict=True)]
            values, vectors = np.linalg.eig(inverse @ sum(terms))
            best = int(np.argmax(values.real))
            if values[best].real <= 0:
                raise Undecided("the operator has no leading eigenvalue on polynomials")
            return float(values[best].real), vectors[:, best].real

        before, at = 0.4, 0.5 if given is None else float(given)
        value = math.log(leading(before)[0])
        for _ in range(_STEPS if given is None else 0):
            now = math.log(leading(at)[0])
            if abs(at - before) < _CLOSE or now == value:
                break
            before, value, at = at, now, at - now * (at - before) / (now - value)
        mean, vector = leading(at)
        terms = [round(Fraction(c / vector[0]) * (1 << 64)) for c in vector]
        return cls(
            terms, round(Fraction(at) * (1 << 64)), round(Fraction(mean) * (1 << 64)), 64, given
        )

    def refine(self, table: _Table) -> None:
        """Improve this to the digits of a table, by Newton's method."""
        import numpy as np

        self._rescale(table)
        inverse = np.linalg.inv(self._derivative(table))
        before = 1 << (2 * table.bits)
        for _ in range(_STEPS):
            tangent = _Tangent.of(self, table)
            size = max(map(abs, tangent.defect))
            if 2 * size > before:  # no better than the last one
                return
            goal = size * size >> table.bits
            first, *change = tangent.solve(inverse, tangent.defect, goal)
            self.terms[1:] = [c - x for c, x in zip(self.terms[1:], change, strict=True)]
            if self.given is None:
                self.s -= first
            else:
                self.mean -= first
            if 2 * size.bit_length() <= table.bits:  # the error is now that of rounding
                return
            before = size

    def _rescale(self, table: _Table) -> None:
        """Go over to the units of a table, and to as many terms as it has nodes."""
        up, self.bits = table.bits - self.bits, table.bits
        few = [c << up if up > 0 else c >> -up for c in self.terms[: len(table.nodes)]]
        self.terms = few + [0] * (len(table.nodes) - len(few))
        self.s, self.mean = (x << up if up > 0 else x >> -up for x in (self.s, self.mean))
        if self.given is None:
            self.mean = 1 << self.bits
        else:
            self.s = round(self.given * (1 << self.bits))

    def _derivative(self, table: _Table) -> _Matrix:
        """Return that of the defects by s or mean, and by the coefficients but the first."""
        import numpy as np
        from numpy.polynomial.chebyshev import chebvander

        last, unit = len(self.terms) - 1, 1 << self.bits
        h = np.array([c / unit for c in self.terms])
        here = chebvander(table.float(table.nodes), last)
        total, by_s = -here * (self.mean / unit), 0 * h
        for images, rates in zip(table.images, table.rates, strict=True):
            rate = table.float(rates)
            part = np.exp(self.s / unit * rate)[:, None] * chebvander(table.float(images), last)
            total, by_s = total + part, by_s + rate * (part @ h)
        total[:, 0] = by_s if self.given is None else -(here @ h)
        return total


@dataclass(frozen=True)
class _Tangent:
    """The defects w = L_s h - mean h at the nodes, and what their derivative is made of.

    parts: for h itself and for each branch, weights and arguments of h; by: by s, or by mean.
    """

    bits: int
    parts: list[tuple[list[int], list[int]]]
    defect: list[int]
    by: list[int]

    @classmethod
    def of(cls, at: _Eigenfunction, table: _Table) -> _Tangent:
        """Evaluate the operator."""
        bits, count = table.bits, len(table.nodes)
        parts, defect, by = [([-at.mean] * count, table.nodes)], [0] * count, [0] * count
        for images, rates in zip(table.images, table.rates, strict=True):
            exponents = (at.s * rate >> bits for rate in rates)
            weights = [_mid(exp(Enclosure(x, x, bits))) for x in exponents]
            parts.append((weights, images))
        for i, (weights, points) in enumerate(parts):
            for j, value in enumerate(_weighted(at.terms, bits, weights, points)):
                defect[j] += value
                if i and at.given is None:
                    by[j] += value * table.rates[i - 1][j] >> bits
                elif at.given is not None and not i:
                    by[j] = (value << bits) // at.mean
        return cls(bits, parts, defect, by)

    def solve(self, inverse: _Matrix, left: list[int], goal: int) -> list[int]:
        """Return the change of s or mean, and of the coefficients but the first.

        The linear equations are solved for what is left, again and again: their first digits in
        floating point, more of them by this, to few bits, so that few steps need all bits.
        """
        drop = max(0, goal.bit_length() - _SPARE)
        total, before = [0] * len(left), 1 << (2 * self.bits)
        while goal < (size := max(map(abs, left))) <= before // 2:
            few = size >> _BITS_AT_ONCE
            change = self.solve(inverse, left, few) if few > goal else _rough(inverse, left, size)
            total = [x + y for x, y in zip(total, change, strict=True)]
            moved = self._along(change, drop)
            left, before = [x - y for x, y in zip(left, moved, strict=True)], size
        return total

    def _along(self, change: list[int], drop: int) -> list[int]:
        """Return the derivative along a change, without the last bits, which do not count."""
        first, *others = change
        total, bits = [first * x >> (self.bits + drop) for x in self.by], self.bits - drop
        terms = [0, *(c >> drop for c in others)]
        for weights, points in self.parts:
            few = ([x >> drop for x in each] for each in (weights, points))
            for j, value in enumerate(_weighted(terms, bits, *few)):
                total[j] += value
        return [value << drop for value in total]


def _rough(inverse: _Matrix, values: list[int], size: int) -> list[int]:
    """Return the product with a matrix in floating point."""
    import numpy as np

    shift = size.bit_length() - 60
    change = inverse @ np.array(_moved(values, -shift), dtype=float)
    return _moved(map(int, change), shift)


def _moved(values: Iterable[int], up: int) -> list[int]:
    """Return values times a power of 2, rounded down."""
    return [value << up if up > 0 else value >> -up for value in values]


def _weighted(terms: list[int], bits: int, weights: list[int], points: list[int]) -> list[int]:
    """Return the products of weights with h at points, h = sum of terms[k] T_k."""
    h = Series(terms, bits)
    return [w * h.near(2 * x) >> bits for w, x in zip(weights, points, strict=True)]
