"""Section 3.3: cones of vectors that DF expands, and how fast it expands and contracts."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, ceil_text, floor_text, show
from proofs.trusted.paper.s33_restitution.rebounds import Entries, Rebound, size


class Cone(NamedTuple):
    """The unstable vectors: |dgamma - slope dphi| <= width |dphi|; the others are stable."""

    slope: Fraction
    width: Fraction

    @property
    def offset(self) -> str:
        """|dgamma - slope dphi|, written."""
        if self.slope == 0:
            return "|dgamma|"
        sign = "-" if self.slope > 0 else "+"
        return f"|dgamma {sign} {show(abs(self.slope))} dphi|"

    def turned(self, derivative: Entries) -> tuple[Range, Range, Range, Range]:
        """Enclose the entries P, Q, R, S of DF for x = dphi, y = (dgamma - slope dphi) / width."""
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
    """How vectors (x, y) = (dphi, (dgamma - slope dphi) / width) grow and shrink under DF.

    expansion: a lower bound > 1 on |x'| / |x| where |y| <= |x|; contraction: an upper bound < 1
    on |y'| / |y| where |x'| <= |y'|.
    """

    expansion: Fraction
    contraction: Fraction
    cone: Cone = PLAIN

    def __str__(self) -> str:
        offset, width = self.cone.offset, self.cone.width
        return (
            f"uniformly hyperbolic: unstable directions have {offset} <= {show(width)} |dphi| and "
            f"are stretched at least {floor_text(self.expansion, 2)} times in phase by each step, "
            f"stable ones have {show(width)} |dphi| <= {offset} and shrink to at most "
            f"{ceil_text(self.contraction, 3)} times in {self.shrinking}"
        )

    @property
    def shrinking(self) -> str:
        """What shrinks of stable vectors."""
        return "velocity" if self.cone.slope == 0 else self.cone.offset

    @staticmethod
    def worst(each: Sequence[Rates]) -> Rates:
        """Return rates that hold for all; Unproved unless they are about the same cone."""
        if len({x.cone for x in each}) > 1:
            raise Unproved("the rates are about different cones")
        return Rates(min(x.expansion for x in each), max(x.contraction for x in each), each[0].cone)


def rates(parts: Sequence[Rebound], cone: Cone = PLAIN) -> Rates:
    """Return the rates of hypothesis 3 of the rule `rectangle-horseshoe`, or Unproved.

    Theorem. In the coordinates of `Rates` let all DF on each of these boxes of states have entries
    with |R| + |S| < |P| - |Q|, |P| - |Q| >= expansion > 1, |Q| + |S| <= steepest (|P| - |R|), and
    steepest |R| + |S| <= contraction < 1. Then so has each mean D of DF over a connected union of
    such boxes: (1) if |y| <= |x|, then |y'| < |x'| and |x'| >= expansion |x|; (2) if |x'| <= |y'|,
    then |y'| <= contraction |y|.
    Proof. P, continuous and not 0, has one sign there; so the inequalities say that convex
    functions of the entries are at most 0, and means obey them.
    (1) |x'| >= (|P| - |Q|) |x| > (|R| + |S|) |x| >= |y'|. (2) |P x| <= |x'| + |Q y| <= |R x| +
    (|S| + |Q|) |y|, so |x| <= steepest |y|, as |P| - |R| > 0, and |y'| <= |R x| + |S y|.
    """
    if cone.width <= 0:
        raise Unproved("a cone has a width > 0")
    found = [cone.turned(part.derivative) for part in parts]
    bounds = [(max(p[0], -p[1]), size(q), size(r), size(s)) for p, q, r, s in found]
    if any(p - q <= r + s for p, q, r, s in bounds):
        raise Unproved("the cone condition is not proved")
    steepest = max((q + s) / (p - r) for p, q, r, s in bounds)
    expansion = min(p - q for p, q, _, _ in bounds)
    contraction = max(steepest * r + s for _, _, r, s in bounds)
    if expansion <= 1 or contraction >= 1:
        raise Unproved("the rates are not proved hyperbolic")
    return Rates(expansion, contraction, cone)
