"""Cones of vectors that a derivative in the plane expands, and how fast it does and contracts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.enclose import Box
from proofs.trusted.numbers import Range, ceil_text, floor_text, show


class Cone(NamedTuple):
    """The unstable vectors of a plane: |dy - slope dx| <= width |dx|; the others are stable."""

    slope: Fraction
    width: Fraction

    def offset(self, x: str, y: str) -> str:
        """|dy - slope dx|, written."""
        if self.slope == 0:
            return f"|d{y}|"
        sign = "-" if self.slope > 0 else "+"
        return f"|d{y} {sign} {show(abs(self.slope))} d{x}|"

    def turned(self, derivative: Sequence[Box]) -> tuple[Range, Range, Range, Range]:
        """Enclose the entries P, Q, R, S for the coordinates dx, (dy - slope dx) / width."""
        e, c = self
        (p, q), (r, s) = derivative
        by_x = r, _times(s, e), _times(p, -e), _times(q, -e * e)
        return (
            _sum(p, _times(q, e)),
            _times(q, c),
            _times(_sum(*by_x), 1 / c),
            _sum(s, _times(q, -e)),
        )


PLAIN = Cone(Fraction(0), Fraction(2))


def _times(values: Range, factor: Fraction) -> Range:
    low, high = sorted(factor * value for value in values)
    return low, high


def _sum(*ranges: Range) -> Range:
    low, high = (sum(ends, Fraction(0)) for ends in zip(*ranges, strict=True))
    return low, high


class Rates(NamedTuple):
    """How vectors (u, v) = (dx, (dy - slope dx) / width) grow and shrink under a derivative.

    expansion: a lower bound > 1 on |u'| / |u| where |v| <= |u|; contraction: an upper bound < 1
    on |v'| / |v| where |u'| <= |v'|.
    """

    expansion: Fraction
    contraction: Fraction
    cone: Cone = PLAIN

    def said(self, x: str, y: str) -> str:
        """Write it; x, y: the names of the variables."""
        offset, width = self.cone.offset(x, y), self.cone.width
        return (
            f"uniformly hyperbolic: unstable directions have {offset} <= {show(width)} |d{x}| and "
            f"are stretched at least {floor_text(self.expansion, 2)} times in {x} by each step, "
            f"stable ones have {show(width)} |d{x}| <= {offset} and shrink to at most "
            f"{ceil_text(self.contraction, 3)} times in {offset}"
        )

    @staticmethod
    def worst(each: Sequence[Rates]) -> Rates:
        """Return rates that hold for all; Unproved unless they are about the same cone."""
        if len({x.cone for x in each}) > 1:
            raise Unproved("the rates are about different cones")
        return Rates(min(x.expansion for x in each), max(x.contraction for x in each), each[0].cone)


def rates(parts: Iterable[Differential], cone: Cone = PLAIN) -> Rates:
    """Return the rates of hypothesis 3 of the rule `horseshoe`, or Unproved.

    Theorem. In the coordinates of `Rates` let all derivatives on each of these boxes have entries
    with |R| + |S| < |P| - |Q|, |P| - |Q| >= expansion > 1, |Q| + |S| <= steepest (|P| - |R|), and
    steepest |R| + |S| <= contraction < 1. Then so has each mean D of them over a connected union of
    such boxes: (1) if |v| <= |u|, then |v'| < |u'| and |u'| >= expansion |u|; (2) if |u'| <= |v'|,
    then |v'| <= contraction |v|.
    Proof. P, continuous and not 0, has one sign there; so the inequalities say that convex
    functions of the entries are at most 0, and means obey them.
    (1) |u'| >= (|P| - |Q|) |u| > (|R| + |S|) |u| >= |v'|. (2) |P u| <= |u'| + |Q v| <= |R u| +
    (|S| + |Q|) |v|, so |u| <= steepest |v|, as |P| - |R| > 0, and |v'| <= |R u| + |S v|.
    """
    if cone.width <= 0:
        raise Unproved("a cone has a width > 0")
    found = [cone.turned(part.matrix) for part in parts]
    bounds = [(max(p[0], -p[1]), size(q), size(r), size(s)) for p, q, r, s in found]
    if any(p - q <= r + s for p, q, r, s in bounds):
        raise Unproved("the cone condition is not proved")
    steepest = max((q + s) / (p - r) for p, q, r, s in bounds)
    expansion = min(p - q for p, q, _, _ in bounds)
    contraction = max(steepest * r + s for _, _, r, s in bounds)
    if expansion <= 1 or contraction >= 1:
        raise Unproved("the rates are not proved hyperbolic")
    return Rates(expansion, contraction, cone)


def size(values: Range) -> Fraction:
    """Return the largest absolute value in a range."""
    return max(abs(values[0]), abs(values[1]))
