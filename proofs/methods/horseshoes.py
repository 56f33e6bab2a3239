"""Full horseshoes of maps of the line that are given by formulas, one on each domain.

Theorem. Let I_0, ..., I_(k-1) be disjoint closed intervals, I the smallest interval that contains
them, f given on each I_j by a formula. If `full_horseshoe` returns, f is C^1 on each I_j with
|f'| >= L > 1, and f(I_j) contains I: the hypotheses of `proofs.methods.orbits`. So for each word
over 0, ..., k-1 exactly one point follows it periodically, the points that stay in the union of
the I_j for ever are a Cantor set (k > 1), and f on it is conjugate to the shift on k symbols.

Proof. Each I_j is divided into parts, and the jets of the formula have enclosures on them: so f
is C^1; |f'| >= L is read off. The enclosures of f at the ends of I_j lie on both sides of I; by
the intermediate value theorem f(I_j) contains I. The last claim: the inverse branches
g_j: I -> I_j are contractions with disjoint images; a point follows w_0 w_1 ... exactly if it is in
every set g_(w_0) ... g_(w_m)(I), and these are nested intervals of lengths at most |I| / L^(m+1).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from intervals import DomainError, Interval, IntervalArray, Undecided
from intervals.jet import Jet
from proofs.methods.orbits import Floats, Range
from proofs.methods.words import Symbols
from proofs.trusted.numbers import hull, show_range

_PARTS = (16, 256, 4096)  # of each domain
_ENDS_PRECISION = 100

Branch = Callable[[Any], Any]
"""A formula for intervals, IntervalArrays, and jets of them."""


def full_horseshoe(
    f: Branch | Sequence[Branch], domains: Sequence[tuple[Fraction | str, Fraction | str]]
) -> Horseshoe:
    """Prove that f maps each domain over all of them and expands there; Undecided if not.

    f is one formula, or one for each domain.
    """
    exact = tuple((Fraction(low), Fraction(high)) for low, high in domains)
    branches = (f,) * len(exact) if callable(f) else tuple(f)
    if len(branches) != len(exact):
        raise ValueError(f"{len(branches)} formulas on {len(exact)} domains")
    if any(low >= high for low, high in exact):
        raise ValueError("a domain is an interval of positive length")
    if any(one[1] >= two[0] for one, two in pairwise(sorted(exact))):
        raise ValueError("the domains are not disjoint")
    whole = hull(exact)
    for branch, domain in zip(branches, exact, strict=True):
        _check_image(branch, domain, whole)
    expansions = [_expansion(b, d) for b, d in zip(branches, exact, strict=True)]
    return Horseshoe(branches, exact, min(expansions))


def _check_image(f: Branch, domain: Range, whole: Range) -> None:
    """Raise Undecided unless f takes the ends of a domain to both sides of an interval."""
    ends = [f(Interval(x, precision=_ENDS_PRECISION)) for x in domain]
    if min(y.sup for y in ends) > whole[0] or max(y.inf for y in ends) < whole[1]:
        raise Undecided(
            f"the image of {show_range(domain)} is not proved to contain {show_range(whole)}: "
            f"the ends go to {' and '.join(format(y, '12') for y in ends)}"
        )


def _expansion(f: Branch, domain: Range) -> Fraction:
    """Return a lower bound above 1 of |f'|; its sign does not change, as f' is continuous."""
    least = 0.0
    for count in _PARTS:
        cuts = [domain[0] + (domain[1] - domain[0]) * Fraction(i, count) for i in range(count + 1)]
        try:
            slopes = f(Jet.variable(IntervalArray(list(pairwise(cuts))))).derivative()
        except DomainError:
            continue
        least = float((slopes + IntervalArray([0] * count)).mig.min())
        if least > 1:
            return Fraction(least)
    raise Undecided(f"|f'| > 1 is not proved on {show_range(domain)}: |f'| >= {least:.6g} is")


@dataclass(frozen=True)
class Horseshoe:
    """A map as `proofs.methods.orbits` wants it; made by `full_horseshoe`."""

    branches: tuple[Branch, ...]
    domains: tuple[Range, ...]
    expansion: Fraction

    def jets(self, symbols: Symbols, x: IntervalArray) -> tuple[IntervalArray, IntervalArray]:
        """Enclose f and f' over x[i] by the formula of the domain symbols[i]."""
        order = np.argsort(symbols, kind="stable")
        back = np.argsort(order, kind="stable")
        parts = [x[symbols == j] for j in range(len(self.branches))]
        found = [
            f(Jet.variable(part)) for f, part in zip(self.branches, parts, strict=True) if part.size
        ]
        values, slopes = (
            IntervalArray.concatenate([jet.coefficients[k] for jet in found])[back] for k in (0, 1)
        )
        return values, slopes

    def approximate(self, symbols: Symbols, x: Floats) -> tuple[Floats, Floats]:
        """Return about f and f'."""
        values, slopes = self.jets(symbols, IntervalArray.from_floats(x))
        return values.mid, slopes.mid

    def defects(self, symbols: Symbols, x: Floats, y: Floats) -> IntervalArray:
        """Enclose f(x) - y."""
        values, _ = self.jets(symbols, IntervalArray.from_floats(x))
        return values - IntervalArray.from_floats(y)

    def germs(self, symbols: Symbols, boxes: IntervalArray) -> HorseshoeGerms:
        """Return f near boxes."""
        return HorseshoeGerms(self, symbols, boxes)


@dataclass(frozen=True)
class HorseshoeGerms:
    """The formulas near boxes, where their jets have enclosures."""

    of: Horseshoe
    symbols: Symbols
    boxes: IntervalArray

    @cached_property
    def slopes(self) -> IntervalArray:
        """Enclosures of f' over the boxes."""
        return self.slopes_at(self.boxes, self.boxes)

    def defect(self, index: int, x: Interval, y: Interval) -> Interval:
        """Enclose f(x) - y."""
        found: Interval = self.of.branches[self.symbols[index]](x) - y
        return found

    def slope(self, index: int, x: Interval, _y: Interval) -> Interval:
        """Enclose f'."""
        found: Interval = self.of.branches[self.symbols[index]](Jet.variable(x)).derivative()
        return found + 0 * x

    def defects(self, x: IntervalArray, y: IntervalArray) -> IntervalArray:
        """Enclose f(x) - y for all boxes at once."""
        return self.of.jets(self.symbols, x)[0] - y

    def slopes_at(self, x: IntervalArray, _y: IntervalArray) -> IntervalArray:
        """Enclose f' for all boxes at once."""
        return self.of.jets(self.symbols, x)[1]
