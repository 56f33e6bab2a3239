"""The Hausdorff dimension of a set made of contracted copies of itself, with a proof.

Let g_1, ..., g_N map the interval J = [a, b] into itself, with disjoint images, be twice
continuously differentiable, and 0 < |g_i'| <= exp(-m) < 1. There is one compact set K that is the
union of all g_i(K) (Hutchinson 1981). Let

    L_s h(x) = sum over i of |g_i'(x)|^s h(g_i(x)).

Theorem (Bowen 1979; as min-max bounds Pollicott and Vytnova 2022). If s > 0, h > 0, q > 0 and
-q h / (1 + q) <= L_s h - h <= q h on J, then s - q/m <= dim K <= s + q/m (if s > q/m).

Proof. L_(s+t) <= exp(-t m) L_s for t >= 0. So with l = s - q/m, u = s + q/m: L_u h <= h and
L_l h >= h. For words W of n letters let R_W and r_W be the extremes of |g_W'|, g_W the composition.
R_W <= C r_W with C free of n, since log |g_i'| are Lipschitz and arguments approach each other by
exp(-m) a step. Upper bound: sum R_W^u <= C^u L_u^n h / min h <= C', and the g_W(J), of length at
most R_W |J| -> 0, cover K. Lower bound: sum r_W^l >= L_l^n h / (C^l max h) >= c > 0, so
sum r_W^(l-t) >= c exp(n m t) for t > 0, which is over 1 for a large n; the images g_W(J) are
disjoint and g_W contracts by r_W at most, so dim K >= l - t (Falconer, Fractal Geometry, 9.7).

The test function is a candidate: the eigenvector of L_s on polynomials, by collocation. The
branches are one formula that takes jets over intervals: `lambda x: [1 / (1 + x), 1 / (2 + x)]`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import pairwise, zip_longest
from typing import Any

from mpmath import MPContext

from intervals import DomainError, Interval, Jet, Undecided

Range = tuple[Fraction, Fraction]
Branches = Callable[[Jet], Sequence[Jet]]

_MOST_TERMS = 120
_MOST_PIECES = 64
_GUARD = 64  # bits, beyond those of the digits wanted


@dataclass(frozen=True)
class Trial:
    """h = sum of c_k u^k, with u = (x - middle of the hull) / half its width; and s."""

    hull: Range
    s: Fraction
    coefficients: tuple[Fraction, ...]

    def h(self, x: Jet) -> Jet:
        """Return h(x): blocks of about sqrt(n) terms save products (Paterson, Stockmeyer)."""
        low, high = self.hull
        u = (x - (low + high) / 2) * (2 / (high - low))
        size = math.isqrt(len(self.coefficients)) + 1
        powers = [0 * u + 1, u]
        while len(powers) <= size:
            powers.append(powers[-1] * u)
        terms = [Interval(c, precision=u.value.precision) for c in self.coefficients]
        total = 0 * u
        for first in reversed(range(0, len(terms), size)):
            block = zip(terms[first : first + size], powers, strict=False)
            total = reduce(lambda sum_, pair: sum_ + pair[1] * pair[0], block, total * powers[size])
        return total

    def defect(self, x: Jet, images: Sequence[Jet]) -> Jet:
        """Return L_s h - h, to an order less than that of x, g_1(x), ..., g_N(x)."""
        total = -self.h(x)
        for y in images:
            total = total + (_logarithm(_derivative(y)) * self.s).exp() * self.h(y)
        return total


@dataclass(frozen=True)
class Dimension:
    """The bounds, the test function, and how the inequality was shown: pieces, order of Taylor.

    slopes: enclosures of 1 / |g_i'| on the hull.
    """

    bounds: Range
    trial: Trial
    pieces: int
    order: int
    slopes: tuple[Range, ...]


def dimension(
    branches: Branches,
    hull: Range,
    digits: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> Dimension:
    """Enclose the dimension within 10^-digits / 5, by the theorem of this module.

    Hypothesis, not checked here: the branches map the hull into itself, with disjoint images.
    Undecided says how far the inequality was proved.
    """
    tell("a test function for the dimension")
    found = candidate(branches, hull, digits)
    radius = Fraction(1, 10 ** (digits + 1))
    bounds = (found.s - radius, found.s + radius)
    tell("the operator's inequality, on all of the interval")
    order, pieces, before = len(found.coefficients) + 4, 2, None
    while True:
        try:
            excess, slopes = operator_excess(branches, found, pieces, order, precision(digits))
        except (DomainError, Undecided):  # the pieces are too wide to say anything
            if pieces >= _MOST_PIECES:
                raise
            pieces *= 2
            continue
        least = min(low for low, _ in slopes)
        if least > 1 and 2 * excess < radius * Interval(least).log().inf:
            return Dimension(bounds, found, pieces, order, slopes)
        if before is not None and 2 * excess > before:  # finer pieces gain no more
            reason = "the branches are not proved to contract" if least <= 1 else "too far from 1"
            raise Undecided(f"L_s h / h is proved within {float(excess):.1e} of 1: {reason}")
        pieces, before = 2 * pieces, excess


def precision(digits: int) -> int:
    """Return the bits to work with."""
    return digits * 10 // 3 + _GUARD


def operator_excess(
    branches: Branches, trial: Trial, pieces: int, order: int, bits: int
) -> tuple[Fraction, tuple[Range, ...]]:
    """Return a bound of |L_s h - h| / h and enclosures of 1 / |g_i'|, on the hull.

    By Taylor's formula with Lagrange's remainder: on each piece the coefficients below `order`
    come from its middle, the last one from the whole piece. Undecided where h > 0 is not proved.
    """
    low, high = trial.hull
    ends = [low + (high - low) * k / pieces for k in range(pieces + 1)]
    worst, slopes = Fraction(0), list[Interval]()
    for left, right in pairwise(ends):
        reach = Interval(left - right, right - left, precision=bits) / 2
        jet, images = _germs(branches, Interval(left, right, precision=bits), order + 1)
        centre, inner = _germs(branches, Interval((left + right) / 2, precision=bits), order + 1)
        least = trial.h(Jet(jet.value)).value.inf
        if least <= 0:
            raise Undecided("the test function is not proved positive")
        defect = _range(trial.defect(centre, inner), trial.defect(jet, images), order, reach)
        worst = max(worst, defect.mag / least)
        rates = [
            _range(_derivative(thin), _derivative(whole), order, reach)
            for thin, whole in zip(inner, images, strict=True)
        ]
        here = [1 / abs(rate) for rate in rates]
        slopes = [a.hull(b) for a, b in zip(slopes, here, strict=True)] if slopes else here
    return worst, tuple((slope.inf, slope.sup) for slope in slopes)


def _range(middle: Jet, whole: Jet, order: int, reach: Interval) -> Interval:
    """Enclose a function by its jets at the middle of a piece and at all points of the piece."""
    coefficients = [*middle.coefficients[:order], whole.coefficients[order]]
    value: Interval = reduce(lambda total, c: total * reach + c, reversed(coefficients))
    return value


def _germs(branches: Branches, x: Interval, order: int) -> tuple[Jet, Sequence[Jet]]:
    jet = Jet.variable(x, order)
    return jet, branches(jet)


def _derivative(y: Jet) -> Jet:
    """Return the jet of the derivative, an order less."""
    return Jet(*(k * c for k, c in enumerate(y.coefficients) if k))


def _logarithm(slope: Jet) -> Jet:
    """Return the jet of log |slope|."""
    return (slope if slope.value.certainly_positive() else -slope).log()


# -- the candidate: nothing here is proved ---------------------------------------------------------


def candidate(branches: Branches, hull: Range, digits: int) -> Trial:
    """Return a guess of s with L_s h = h, and of h, on polynomials of a degree that suffices."""
    terms, goal = 12, digits + 6
    while terms <= _MOST_TERMS:
        found, last = _eigenvector(branches, hull, digits, terms)
        reached = -math.log10(last)
        if reached >= goal:
            return found
        # the coefficients fall like powers: h is analytic
        terms = max(terms + 4, math.ceil(terms * goal / max(reached, 0.1)) + 2)
    raise Undecided(f"the eigenvector is no polynomial of degree {_MOST_TERMS} to {digits} digits")


def _eigenvector(branches: Branches, hull: Range, digits: int, terms: int) -> tuple[Trial, float]:
    """Collocate at Chebyshev's nodes: return the test function and its last Chebyshev coefficient.

    At the nodes u_j, L_s is the matrix of the values |g'|^s l_k(g), l_k Lagrange's polynomials.
    """
    mp = MPContext()
    mp.prec = precision(digits) + 2 * terms
    angles = [mp.pi * (2 * j + 1) / (2 * terms) for j in range(terms)]
    nodes = [mp.cos(angle) for angle in angles]
    weights = [(-1) ** j * mp.sin(angle) for j, angle in enumerate(angles)]
    low, high = hull
    parts = []
    for node in nodes:
        x = (low + high) / 2 + (high - low) / 2 * _fraction(node)
        point = Jet.variable(Interval(x, precision=mp.prec), 1)
        for image in branches(point):
            v = _real(mp, (2 * image.value.mid - low - high) / (high - low))
            row = [w / (v - u) for w, u in zip(weights, nodes, strict=True)]
            total = mp.fsum(row)
            rate = mp.log(abs(_real(mp, image.derivative().mid)))
            parts.append((rate, [value / total for value in row]))
    s, values = _root(mp, parts, len(parts) // terms)
    chebyshev = [
        2 * mp.fdot(values, [mp.cos(k * angle) for angle in angles]) / terms for k in range(terms)
    ]
    chebyshev[0] /= 2
    unit = 10 ** (digits + 6)
    coefficients = tuple(Fraction(round(_fraction(c) * unit), unit) for c in _monomials(chebyshev))
    last = max(1e-300, *(abs(float(c)) for c in chebyshev[-2:]))
    return Trial(hull, Fraction(round(_fraction(s) * unit), unit), coefficients), last


def _root(mp: Any, parts: list[tuple[Any, list[Any]]], count: int) -> tuple[Any, list[Any]]:
    """Return s with the leading eigenvalue 1 and its eigenvector, by secants of the logarithm."""
    size = len(parts) // count
    vector, tiny = [mp.mpf(1)] * size, mp.mpf(2) ** (20 - mp.prec)

    def growth(s: Any, vector: list[Any]) -> tuple[Any, list[Any]]:
        rows = []
        for j in range(size):
            scaled = [
                [mp.exp(s * rate) * value for value in row]
                for rate, row in parts[count * j : count * (j + 1)]
            ]
            rows.append([mp.fsum(column) for column in zip(*scaled, strict=True)])
        value, before = mp.mpf(0), mp.mpf(1)
        for _ in range(mp.prec):  # the other eigenvalues are much smaller
            if abs(value - before) < tiny:
                break
            vector = [mp.fdot(row, vector) for row in rows]
            value, before = max(vector), value
            if value <= 0:
                break
            vector = [x / value for x in vector]
        if not abs(value - before) < tiny:
            raise Undecided("the operator has no leading eigenvalue on polynomials")
        return mp.log(value), vector

    a, b = mp.mpf("0.4"), mp.mpf("0.6")
    at_a, vector = growth(a, vector)
    for _ in range(50):
        at_b, vector = growth(b, vector)
        if abs(b - a) < mp.sqrt(tiny) ** 1.5 or at_a == at_b:
            break
        a, b, at_a = b, b - at_b * (b - a) / (at_b - at_a), at_b
    return b, vector


def _monomials(chebyshev: Sequence[Any]) -> list[Any]:
    """Return the coefficients in powers of u of sum c_k T_k(u): T_(k+1) = 2 u T_k - T_(k-1)."""
    powers = [[1], [0, 1]]
    while len(powers) < len(chebyshev):
        before, now = powers[-2:]
        powers.append([2 * a - b for a, b in zip_longest([0, *now], before, fillvalue=0)])
    return [
        sum(c * p[k] for c, p in zip(chebyshev, powers, strict=False) if k < len(p))
        for k in range(len(chebyshev))
    ]


def _fraction(x: Any) -> Fraction:
    """Return an mpf as a rational, exactly."""
    sign, mantissa, exponent, _ = x._mpf_  # the mantissa may be of another integer type
    return Fraction(int(-mantissa if sign else mantissa)) * Fraction(2) ** int(exponent)


def _real(mp: Any, x: Fraction) -> Any:
    """Return a rational as an mpf of this context."""
    return mp.mpf(x.numerator) / x.denominator
