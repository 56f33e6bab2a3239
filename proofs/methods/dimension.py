"""The Hausdorff dimension of a set made of contracted copies of itself, with a proof.

Let g_1, ..., g_N map the interval [a, b] into itself, to disjoint images, and be analytic near it.
There is one compact set K that is the union of all g_i(K) (Hutchinson 1981). Its dimension is the s
at which L_s h = sum over i of |g_i'|^s h(g_i) has the leading eigenvalue 1 (Bowen 1979).

What is proved is the theorem of `proofs.trusted.kernel.transfer`, from an approximate
eigenfunction. That is found by collocation at Chebyshev's nodes, to twice as many digits again and
again, by Newton's method with the derivative in floating point.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import Any, TypeVar

from intervals import Undecided
from proofs.methods.eigenfunction import candidate
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, rational
from proofs.trusted.kernel.complexes import Arc, Complex, Ellipse
from proofs.trusted.kernel.transfer import (
    Branches,
    Collocation,
    Growth,
    Trial,
    growth,
    on_boundary,
)

T = TypeVar("T")
Range = tuple[Fraction, Fraction]
Formula = Callable[[Any], Sequence[Any]]
Images = Sequence[tuple[complex, complex]]
Samples = Callable[[Sequence[complex]], Sequence[Images]]

POINTS, _WAY = 48, 16  # of the boundary of an ellipse, and on the way there
_WIDEST, _NARROWEST, _NEAR = 50.0, 1.05, 1.05  # of the rho that are tried, and how near
_SHARES, _MANY = (0.9, 0.65, 0.5), 60  # of what seems possible: the first one for many digits
_LEAST_ARCS, _MOST_ARCS = 24, 192


@dataclass(frozen=True)
class Formulas:
    """Branches that a formula gives, for every number type: `lambda x: [1 / (1 + x), ...]`."""

    formula: Formula
    ellipse: Ellipse

    def over(self, arc: Arc) -> list[tuple[Complex, Complex]]:
        """Enclose g_i and g_i' on an arc of the ellipse's boundary."""
        x = arc.germ(self.ellipse.coordinates).values
        return self._images(x, Complex.of(Fraction(1)))

    def at(self, x: Enclosure) -> list[tuple[Enclosure, Enclosure]]:
        """Enclose g_i and g_i' at a real number."""
        return self._images(x, rational(Fraction(1), x.bits))

    def _images(self, x: Any, one: Any) -> list[tuple[Any, Any]]:
        return [(y.value, y.derivative) for y in self.formula(Dual(x, one))]


@dataclass
class Remembered:
    """Branches whose values are kept: candidate and proof ask for the same ones."""

    branches: Branches
    _known: dict[tuple[int, int, int], Sequence[tuple[Enclosure, Enclosure]]] = field(
        default_factory=dict
    )
    _arcs: dict[Arc, Sequence[tuple[Complex, Complex]]] = field(default_factory=dict)

    def over(self, arc: Arc) -> Sequence[tuple[Complex, Complex]]:
        """Enclose g_i and g_i' on an arc."""
        if arc not in self._arcs:
            self._arcs[arc] = self.branches.over(arc)
        return self._arcs[arc]

    def at(self, x: Enclosure) -> Sequence[tuple[Enclosure, Enclosure]]:
        """Enclose g_i and g_i' at a real number."""
        key = x.lo, x.hi, x.bits
        if key not in self._known:
            self._known[key] = self.branches.at(x)
        return self._known[key]


@dataclass(frozen=True)
class Dimension:
    """The bounds, and what they follow from."""

    bounds: Range
    growth: Growth
    trial: Trial
    by: Collocation


def dimension(
    formula: Formula,
    hull: Range,
    digits: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> Dimension:
    """Enclose the dimension within 10^-digits; Undecided says what could not be proved."""

    def samples(path: Sequence[complex]) -> list[Images]:
        duals: list[Any] = [Dual(z, 1) for z in path]  # type: ignore[arg-type]
        rows = [[(y.value, y.derivative) for y in formula(z)] for z in duals]
        return list(zip(*rows, strict=True))

    tell("an ellipse that the branches map into itself")
    last = "no ellipse is mapped into itself"
    for rho in ellipses(samples, hull, digits):
        ellipse = Ellipse(hull, rho)
        remembered = Remembered(Formulas(formula, ellipse))
        try:
            arcs = enough_arcs(partial(_maps_into_itself, remembered, ellipse))
            break
        except Unproved as error:
            last = str(error)
    else:
        raise Undecided(last)
    tell("a test function for the dimension")
    trial, by = candidate(remembered, ellipse, arcs, digits)
    tell("the operator's inequality, on all of the interval")
    try:
        bounded = growth(remembered, trial, by)
        bounds = bounded.dimension(by.bits)
    except Unproved as error:
        raise Undecided(str(error)) from error
    if bounds[1] - bounds[0] > Fraction(1, 10**digits):
        raise Undecided(f"the dimension is proved within {float(bounds[1] - bounds[0]):.1e} only")
    return Dimension(bounds, bounded, trial, by)


# -- the ellipse -----------------------------------------------------------------------------------


def boundary(hull: Range, rho: float) -> list[complex]:
    """Return points of the upper half of an ellipse's boundary, after a way there from its middle.

    The last POINTS of them are at the angles pi j / (POINTS - 1).
    """
    middle, half = float(sum(hull)) / 2, float(hull[1] - hull[0]) / 2
    u = [
        (w + 1 / w) / 2
        for w in (cmath.rect(rho, math.pi * j / (POINTS - 1)) for j in range(POINTS))
    ]
    way = [u[0] * j / _WAY for j in range(_WAY)]
    return [middle + half * each for each in (*way, *u)]


def ellipses(samples: Samples, hull: Range, digits: int) -> Iterator[Fraction]:
    """Yield values of rho for which the branches seem to map the ellipse into itself.

    The smaller they are, the fewer arcs prove it; the larger, the fewer nodes each digit needs.
    """
    low, high = _NARROWEST, _WIDEST
    while high > _NEAR * low:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if _seems_inside(samples, hull, middle) else (low, middle)
    for share in _SHARES[digits < _MANY :]:
        yield Fraction(1 + share * (low - 1)).limit_denominator(100)


def _seems_inside(samples: Samples, hull: Range, rho: float) -> bool:
    """Whether the branches seem to map the ellipse into itself, and Re g' to have one sign."""
    middle, half = float(sum(hull)) / 2, float(hull[1] - hull[0]) / 2
    axes = (rho + 1 / rho) / 2 * half, (rho - 1 / rho) / 2 * half
    try:
        rows = [row[-POINTS:] for row in samples(boundary(hull, rho))]
    except (ArithmeticError, Undecided, ValueError):
        return False
    for row in rows:
        if any(((y.real - middle) / axes[0]) ** 2 + (y.imag / axes[1]) ** 2 > 1 for y, _ in row):
            return False
        if not (min(d.real for _, d in row) > 0 or max(d.real for _, d in row) < 0):
            return False
    return True


def _maps_into_itself(branches: Branches, ellipse: Ellipse, arcs: int) -> int:
    on_boundary(branches, ellipse.arcs(arcs))
    return arcs


def enough_arcs(prove: Callable[[int], T]) -> T:
    """Return what is proved with a number of arcs that suffices."""
    arcs = _LEAST_ARCS
    while True:
        try:
            return prove(arcs)
        except Unproved:
            if arcs >= _MOST_ARCS:
                raise
            arcs = arcs * 4 // 3
