"""Transfer operators of contractions of an interval: bounds of their growth, and of dimensions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Protocol

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.complexes import Arc, Complex, Ellipse
from proofs.trusted.kernel.elementary import exp, log, log_of
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, hull, within


class Branches(Protocol):
    """Functions g_1, ..., g_N, real on the reals, continuous on an ellipse, analytic inside."""

    def over(self, arc: Arc) -> Sequence[tuple[Complex, Complex]]:
        """Enclose g_i and g_i' on an arc of the ellipse's boundary."""

    def at(self, x: Enclosure) -> Sequence[tuple[Enclosure, Enclosure]]:
        """Enclose g_i and g_i' at a number between the foci; all arcs have been asked for."""


@dataclass(frozen=True)
class Trial:
    """A number s, and h = sum of c_k T_k(u) on [a, b], u = (2x - a - b) / (b - a)."""

    s: Fraction
    coefficients: tuple[Fraction, ...]


@dataclass(frozen=True)
class Growth:
    """low h <= L_s h <= high h for some h > 0 on [a, b], L_s h = sum of |g_i'|^s h(g_i).

    The g_i map [a, b] into itself, monotonically, to disjoint images; |g_i'| is in rates[i].
    """

    s: Fraction
    bounds: Range
    rates: tuple[Range, ...]

    def dimension(self, bits: int) -> Range:
        """Return bounds of the dimension of K, the compact set that is the union of all g_i(K).

        Theorem (Bowen 1979; as min-max bounds Pollicott and Vytnova 2022). If |g_i'| <= exp(-m)
        < 1, it is at least s + log(min(low, 1)) / m and at most s + log(max(high, 1)) / m.

        Proof. Let l and u be these. L_(s+t) <= exp(-t m) L_s for t >= 0, so L_u h <= h and
        L_l h >= h. For words W of n letters let R_W and r_W be the extremes of the derivative of
        the composition g_W. R_W <= C r_W with C free of n, since log |g_i'| are Lipschitz and the
        arguments approach each other by exp(-m) a step. Upper bound: the sum of R_W^u is at most
        C^u L_u^n h / min h <= C', the intervals g_W([a, b]) cover K and are at most R_W (b - a)
        long, which tends to 0: the u-dimensional measure of K is finite. Lower bound: the sum of
        r_W^l is at least L_l^n h / (C^l max h) >= c > 0, so for t > 0 that of r_W^(l - t) is at
        least c exp(n m t), over 1 for a large n. As g_W contract by r_W at most and have disjoint
        images, dim K >= l - t (Falconer, Fractal Geometry, Proposition 9.7).
        """
        most = max(high for _, high in self.rates)
        if most >= 1 or self.bounds[0] <= 0:
            raise Unproved("the inverse branches are not proved to contract, or to grow")
        m, one = -log(most, bits), Fraction(1)
        low, high = (log(x, bits) / m for x in (min(self.bounds[0], one), max(self.bounds[1], one)))
        return max(Fraction(0), self.s + low.range[0]), self.s + high.range[1]


@dataclass(frozen=True)
class Series:
    """The sum of c_k T_k(u) for integers c_k in units of 2^-bits."""

    coefficients: Sequence[int]
    bits: int

    @classmethod
    def of(cls, coefficients: Sequence[Fraction], bits: int) -> Series:
        """Return the series with these coefficients, rounded."""
        return cls([round(c * (1 << bits)) for c in coefficients], bits)

    @cached_property
    def _steepest(self) -> int:
        return sum(k * k * abs(c) for k, c in enumerate(self.coefficients))

    @property
    def bend(self) -> Fraction:
        """A bound of the second derivative by the angle."""
        return Fraction(self._steepest, 1 << self.bits)

    def near(self, t: int) -> int:
        """Return about the value at u, |u| <= 1, for t = 2 u in units of 2^-bits (Clenshaw).

        b_k = c_k + 2 u b_(k+1) - b_(k+2), each rounded by less than one unit: the result is exactly
        that of c_k with these errors, so it is off by less than a unit for each c_k.
        """
        METER.get().spend(len(self.coefficients) * (1 + (self.bits >> 7) ** 2 // 32))
        now = before = 0
        for c in self.coefficients[:0:-1]:
            now, before = c + (t * now >> self.bits) - before, now
        return self.coefficients[0] + (t * now >> (self.bits + 1)) - before

    def __call__(self, u: Enclosure) -> Enclosure:
        """Enclose the values at numbers of [-1, 1], where |T_k'| <= k^2."""
        one = 1 << self.bits
        if not -one <= u.lo <= u.hi <= one or u.bits != self.bits:
            raise Unproved("a number that leaves the hull")
        value = self.near(u.lo + u.hi)
        turned = self._steepest * (u.hi - u.lo) >> (self.bits + 1)
        error = 2 * len(self.coefficients) + turned + 1
        return Enclosure(value - error, value + error, self.bits)

    def size(self, rho: Fraction) -> Fraction:
        """Return a bound of the sum of |c_k| rho^k."""
        total, scale = rational(Fraction(0), self.bits), rational(rho, self.bits)
        for c in reversed(self.coefficients):
            total = total * scale + Enclosure(abs(c), abs(c), self.bits)
        return total.range[1]


@dataclass(frozen=True)
class Collocation:
    """How the growth is bounded: arcs of the boundary of E, nodes on [a, b], bits; near `mean`."""

    ellipse: Ellipse
    arcs: int
    nodes: int
    mean: Fraction
    bits: int


def growth(branches: Branches, trial: Trial, by: Collocation) -> Growth:
    """Return what `Growth` says, h about that of `trial`: by the values at Chebyshev's n nodes.

    Hypotheses, [a, b] the foci of the ellipse E: on its boundary all g_i take values in E, and
    Re g_i' has one sign; images of [a, b] are disjoint and in it; 0 < s <= 1; h is proved positive.

    Proof. 1. E is convex, so g_i(E) is in E, and Re g_i' has its sign in E (maximum principle): g_i
    is monotone on [a, b], and |g_i'|^s is on [a, b] an analytic function, on E at most R_i^s by
    R_i >= |g_i'| on the boundary. As |T_k| <= rho^k there, w = L_s h - mean h is at most
    M = (mean + sum of max(1, R_i)) sum |c_k| rho^k, and so w = sum of a_k T_k with
    |a_k| <= 2 M rho^-k. 2. At the nodes cos(pi (2j + 1) / (2n)) T_k is, for k >= n, some T_i up to
    the sign, i < n, or 0. So the polynomial p of degree below n that agrees with w at the nodes is
    within 2 sum over k >= n of |a_k| of w, that is 4 M rho^(1 - n) / (rho - 1). The coefficients
    of p are 2/n (1/n the first) times the sum of w T_k over the nodes: |p| <= (2n - 1) max |w|.
    3. An even function F of the angle is within (pi / n)^2 / 8 max |F''| of its interpolation by
    lines between the nodes' angles, which are pi / n apart. |F''| is at most sum k^2 |c_k| for h
    and, as its coefficients are at most 2 R_i rho^-k, 2 R_i rho (rho + 1) / (rho - 1)^3 for g_i'.
    """
    ellipse, n, bits, rho = by.ellipse, by.nodes, by.bits, by.ellipse.rho
    if not 0 < trial.s <= 1 or by.mean < 0 or n < 1:
        raise Unproved("an exponent in (0, 1] and a growth are expected")
    signs, most = on_boundary(branches, ellipse.arcs(by.arcs))
    _require_disjoint(branches, ellipse.hull, bits)
    h, share = Series.of(trial.coefficients, bits), Fraction(5, 4) / n**2  # above (pi / n)^2 / 8
    least, worst, spans = _at_nodes(branches, signs, h, trial.s, by)
    smallest = least - share * h.bend
    if smallest <= 0:
        raise Unproved("the test function is not proved positive")
    bound = (by.mean + sum(max(Fraction(1), each) for each in most)) * h.size(rho)
    error = (2 * n - 1) * worst + 4 * bound / (rho ** (n - 1) * (rho - 1))
    slack = [2 * each * rho * (rho + 1) / (rho - 1) ** 3 * share for each in most]
    rates = tuple((low - x, high + x) for (low, high), x in zip(spans, slack, strict=True))
    low, high = by.mean - error / smallest, by.mean + error / smallest
    return Growth(trial.s, Enclosure.of(low, high, bits).range, rates)


def on_boundary(branches: Branches, arcs: Sequence[Arc]) -> tuple[list[int], list[Fraction]]:
    """Return the signs of Re g_i', and bounds of |g_i'|, on the boundary, half of which is enough.

    The other half are the conjugates.
    """
    found = [branches.over(arc) for arc in arcs]
    if not all(arc.ellipse.contains(y) for arc, on in zip(arcs, found, strict=True) for y, _ in on):
        raise Unproved("the branches are not proved to map the ellipse into itself")
    signs, most = list[int](), list[Fraction]()
    for rates in zip(*([rate for _, rate in on] for on in found), strict=True):
        low, high = hull([rate.re.range for rate in rates])
        if low <= 0 <= high:
            raise Unproved("a branch is not proved monotone")
        signs.append(1 if low > 0 else -1)
        most.append(max(rate.size for rate in rates))
    return signs, most


def _require_disjoint(branches: Branches, whole: Range, bits: int) -> None:
    """Raise Unproved unless the images of [a, b], between those of its ends, are as they must."""
    ends = zip(*(branches.at(rational(end, bits)) for end in whole), strict=True)
    spans = sorted(hull([y.range for y, _ in pair]) for pair in ends)
    if not within(hull(spans), whole):
        raise Unproved("the branches are not proved to map the hull into itself")
    if any(before[1] >= after[0] for before, after in pairwise(spans)):
        raise Unproved("the images of the branches are not proved disjoint")


def _at_nodes(
    branches: Branches, signs: Sequence[int], h: Series, exponent: Fraction, by: Collocation
) -> tuple[Fraction, Fraction, list[Range]]:
    """Return the least h, the greatest |L_s h - mean h|, and the ranges of |g_i'|, at the nodes."""
    bits = by.bits
    s, mean = rational(exponent, bits), rational(by.mean, bits)
    middle, half = (rational(each, bits) for each in by.ellipse.coordinates)
    heights, defects, sizes = list[Range](), list[Range](), list[list[Range]]()
    for j in range(by.nodes):
        u = (pi(bits) * (2 * j + 1) / (2 * by.nodes)).sincos()[1]
        height = h(u)
        defect, images = -(height * mean), branches.at(middle + half * u)
        rates = [rate * sign for (_, rate), sign in zip(images, signs, strict=True)]
        for (y, _), rate in zip(images, rates, strict=True):
            defect = defect + exp(log_of(rate) * s) * h((y - middle) / half)
        heights.append(height.range)
        defects.append(defect.range)
        sizes.append([rate.range for rate in rates])
    low, high = hull(defects)
    return hull(heights)[0], max(-low, high), list(map(hull, zip(*sizes, strict=True)))
