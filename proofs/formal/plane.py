"""Covering graphs of a map of the plane, with cones, as the Coq file has them: data for Coq.

Not trusted: a reader reads `theory/Histories.v`, and the definitions and theorems here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise, product
from typing import NamedTuple

from proofs.formal.written import NoTheorem
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import LocalMap
from proofs.trusted.kernel.enclose import Box, enclosed
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.numbers import Range, hull, show

PARTS = 10000  # of what bounds and rates are written in
_SPARE = Fraction(1, 4), Fraction(1, 20), Fraction(1, 200)  # of what is enclosed
_LEAST = 20  # wider than rounding
_RATES = PARTS * 3 // 4, PARTS * 19 // 20
_WIDTHS = [round(PARTS * 2.0**exponent) for exponent in range(-8, 10)]
_FINEST = 5  # halvings of a set: Coq's checker makes one more
_BITS = 64

MAP = """
Definition F{i} (z : R * R) : R * R := let x := fst z in let y := snd z in ({real}).
Definition sets{i} : list (R * R * (R * R) * (R * R)) := [
  {sets}].
Definition arrows{i} : list (nat * nat) := [{arrows}]%nat.
Definition tree{i} : formula * formula := ({tree}).
Definition data{i} := [{data}]%Z.
Definition rates{i} := Rates {rates}.
Lemma checked{i} : check_plane tree{i} {power} {unit} {parts} data{i} arrows{i} rates{i} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem graph{i} : followed_once nat (fun i j => In (i, j) arrows{i}) (parallelogram sets{i})
  (fun z z' => z' = {map} z) ({rate} / {parts}).
Proof. exact (plane_checked tree{i} {power} {unit} {parts} data{i} arrows{i} rates{i} checked{i}).
Qed.
"""
ENTROPY = """
Definition vector{j} := [{vector}]%Z.
Lemma growing{j} : growing_plane data{i} arrows{i} vector{j} {length} {growth} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem entropy{j} : entropy_at_least in_plane {map} (parallelogram sets{i}) arrows{i}
  {length} {growth}.
Proof. exact (plane_growth tree{i} {power} {unit} {parts} data{i} arrows{i} rates{i} checked{i}
  vector{j} {length} {growth} growing{j}). Qed.
"""


class Rates(NamedTuple):
    """In PARTS, of derivatives in coordinates: |dx'/dx| >= p, |dx'/dy| <= q, |dy'/dx| <= r,
    |dy'/dy| <= s; cones |dy| <= width |dx|; two orbits of one history draw near by `rate` a step.
    """

    p: int
    q: int
    r: int
    s: int
    width: int
    rate: int

    @classmethod
    def seen(cls, p: Fraction, q: Fraction, r: Fraction, s: Fraction) -> Rates | None:
        """Return a rate that bounds on derivatives give, with room: Coq sees them sooner then."""
        for rate, spare in product(_RATES, _SPARE):
            low = math.floor(p * (1 - spare) * PARTS)
            shear, fall, shrink = (math.ceil(x * (1 + spare) * PARTS) + _LEAST for x in (q, r, s))
            every = [cls._with(low, fall, width, rate) for width in _WIDTHS if width > fall]
            wide = [each for each in every if each.q >= shear and each.s >= shrink]
            if wide:
                return max(wide, key=lambda each: min(each.q / shear, each.s / shrink))
        return None

    @classmethod
    def _with(cls, p: int, r: int, width: int, rate: int) -> Rates:
        """Return the largest q and s that 1 + q width <= rate p, r rate + s width <= rate width."""
        return cls(p, (rate * p - PARTS**2) // width, r, rate * (width - r) // width, width, rate)


class Plane:
    """A graph of a map of the plane: its sets, and the arrows that two-sided paths have."""

    modules = "Graph Histories Formula Entropy Plane"
    graph = MAP
    entropy = ENTROPY

    def __init__(self, graph: Graph) -> None:
        self.power = graph.covers[0].local.power
        self.nodes = graph.nodes
        covers = dict(zip(graph.edges, graph.covers, strict=True))
        self.arrows = _two_sided(sorted(covers))
        self.relations = [covers[arrow].local for arrow in self.arrows]
        numbers = [x for node in self.nodes for row in (node.centre, *node.matrix) for x in row]
        self.unit = math.lcm(*(each.denominator for each in numbers))
        self.rates = self._rates()

    @property
    def live(self) -> list[tuple[int, int]]:
        """The arrows of infinite paths: all."""
        return self.arrows

    def weights(self, vector: Sequence[str]) -> list[int]:
        """Return a vector of the certificate on the sets of two-sided paths, 0 on the others."""
        reached = {a[0] for a in self.arrows}
        return [int(x) if i in reached else 0 for i, x in enumerate(vector)]

    @property
    def values(self) -> dict[str, object]:
        """What the templates have of it."""
        rows = [(*node.centre, *sum(zip(*node.matrix, strict=True), ())) for node in self.nodes]
        data = [[f"({int(x * self.unit)})" for x in row] for row in rows]
        points = [[f"{x[1:-1]} / {self.unit}" for x in row] for row in data]
        shape = "(({}, {}), ({}, {}), ({}, {}))"
        return {
            "sets": ";\n  ".join(shape.format(*row) for row in points),
            "data": "; ".join(f"Hset {' '.join(row)}" for row in data),
            "rates": " ".join(map(str, self.rates)),
            "rate": self.rates.rate,
            "parts": PARTS,
        }

    @property
    def says(self) -> str:
        """What the theorem says, of the map on the parallelograms."""
        rate = Fraction(self.rates.rate, PARTS)
        return (
            f"on {len(self.nodes)} parallelograms with {len(self.arrows)} arrows: each two-sided "
            "path is that of exactly one full orbit, each periodic path of a periodic orbit, and "
            f"orbits whose paths agree from -n to n are within {show(rate)}^n size at time 0"
        )

    def _rates(self) -> Rates:
        """Enclose the derivatives on finer and finer parts of the sets, until cones are seen."""
        for halvings in range(_FINEST + 1):
            try:
                bounds = [_largest(each, halvings) for each in self.relations]
            except Unproved:
                continue
            p, *others = zip(*bounds, strict=True)
            if (rates := Rates.seen(min(p), *map(max, others))) is not None:
                return rates
        raise NoTheorem("no cones are seen, without which Coq has no theorem in the plane")


def _two_sided(arrows: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return the arrows before and after which there always is another."""
    kept = list(arrows)
    while (now := [a for a in kept if _runs_on(a, kept)]) != kept:
        kept = now
    if not kept:
        raise NoTheorem("the graph has no two-sided path")
    return kept


def _runs_on(arrow: tuple[int, int], among: Sequence[tuple[int, int]]) -> bool:
    return any(a[1] == arrow[0] for a in among) and any(a[0] == arrow[1] for a in among)


def _largest(local: LocalMap, halvings: int) -> tuple[Fraction, ...]:
    """Return the least |dx'/dx|, 0 if its sign is unclear, and the greatest other derivatives."""
    parts = 2**halvings
    cuts = [Fraction(2 * i, parts) - 1 for i in range(parts + 1)]
    sides = list(pairwise(cuts))
    every = [_entries(local, box) for box in product(sides, repeat=2)]
    (low, high), *others = (hull(each) for each in zip(*every, strict=True))
    return max(low, -high, Fraction(0)), *(max(-a, b) for a, b in others)


def _entries(local: LocalMap, box: Box) -> list[Range]:
    """Enclose the derivatives on a part of a set, row by row."""
    return [entry.range for row in local.jacobian(enclosed(box, _BITS)) for entry in row]
