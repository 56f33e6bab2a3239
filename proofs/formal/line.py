"""Covering graphs of a map of the line, as the Coq file has them: data for Coq's own checker.

Not trusted: a reader reads `theory/Graph.v`, and the definitions and theorems here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from proofs.formal.written import pairs
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import along, images
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.numbers import Range, show, show_range

_PARTS = 64  # of an interval, to look for the least slope
_BITS = 64

MAP = """
Definition F{i} (x : R) : R := {real}.
Definition cells{i} : list (R * R) := [{cells}].
Definition arrows{i} : list (nat * nat) := [{arrows}]%nat.
Definition tree{i} : formula := {tree}.
Definition ends{i} := [{ends}]%Z.
Lemma checked{i} : check tree{i} {power} {unit} ends{i} arrows{i} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
"""
SEMICONJUGATE = (
    MAP
    + """
(* {says} *)
Theorem graph{i} : semiconjugate {map} cells{i} arrows{i}.
Proof. exact (graph_checked tree{i} {power} {unit} ends{i} arrows{i} checked{i}). Qed.
"""
)
CONJUGATE = (
    MAP
    + """
Lemma expanding{i} : expanding tree{i} {power} {unit} ends{i} arrows{i} {m} {n} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem graph{i} : conjugate {map} cells{i} arrows{i} ({m} / {n}).
Proof. exact (expansion_checked tree{i} {power} {unit} ends{i} arrows{i} checked{i} {m} {n}
  expanding{i}). Qed.
"""
)
ENTROPY = """
Definition live{j} : list (nat * nat) := [{arrows}]%nat.
Lemma live_checked{j} : check tree{i} {power} {unit} ends{i} live{j} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Definition vector{j} := [{vector}]%Z.
Lemma growing{j} : growing live{j} (length ends{i}) vector{j} {length} {growth} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem entropy{j} : entropy_at_least on_line {map} (interval cells{i}) live{j} {length} {growth}.
Proof. exact (growth_checked tree{i} {power} {unit} ends{i} live{j} live_checked{j}
  vector{j} {length} {growth} growing{j}). Qed.
"""


class Line:
    """A graph of a map of the line, its intervals in ascending order.

    places: of the intervals in the certificate; least: a bound on |(F^k)'| above 1, or 0.
    """

    modules = "Graph Formula Entropy Cells Checker"
    entropy = ENTROPY

    def __init__(self, graph: Graph) -> None:
        first = graph.covers[0].local
        self.map, self.power = first.map, first.power
        self.places = sorted(range(len(graph.nodes)), key=lambda i: graph.nodes[i].span())
        self.cells: list[Range] = [graph.nodes[place].span() for place in self.places]
        rank = {place: rank for rank, place in enumerate(self.places)}
        self.arrows = sorted((rank[i], rank[j]) for i, j in graph.edges)
        self.unit = math.lcm(*(end.denominator for cell in self.cells for end in cell))
        self.least = _rounded(self._steepness())

    @property
    def values(self) -> dict[str, object]:
        """What the templates have of it."""
        ends = [tuple(int(end * self.unit) for end in cell) for cell in self.cells]
        written = "; ".join(f"({a} / {self.unit}, {b} / {self.unit})" for a, b in ends)
        bound = {"m": self.least.numerator, "n": self.least.denominator}
        return {"cells": written, "ends": pairs(ends), **bound}

    @property
    def graph(self) -> str:
        """The template of its theorem."""
        return CONJUGATE if self.least else SEMICONJUGATE

    @property
    def says(self) -> str:
        """What the theorem says, of the map on the intervals."""
        cells = ", ".join(show_range(cell) for cell in self.cells)
        what = (
            f"on {cells} with {len(self.arrows)} arrows: each infinite path is followed by a "
            "point, each periodic one by a periodic point, no point follows two, near points "
            "follow the same path for long, and all these points are a compact set"
        )
        if not self.least:
            return what
        return (
            f"{what}; the slope is {show(self.least)} at least in size there: a path is followed "
            "by one point alone, and the map on these points is conjugate to the shift on paths"
        )

    def weights(self, vector: Sequence[str]) -> list[int]:
        """Return a vector of the certificate, in the order of the intervals."""
        return [int(vector[place]) for place in self.places]

    @property
    def live(self) -> list[tuple[int, int]]:
        """The arrows of infinite paths: those after which there is always another."""
        arrows = self.arrows
        while (kept := [a for a in arrows if any(b[0] == a[1] for b in arrows)]) != arrows:
            arrows = kept
        return arrows

    def _steepness(self) -> Fraction:
        """Return about the least |(F^k)'| on the intervals from which arrows go; 0 if unclear."""
        try:
            return min(self._least(self.cells[i]) for i in {a[0] for a in self.arrows})
        except Unproved:
            return Fraction(0)

    def _least(self, cell: Range) -> Fraction:
        low, high = cell
        cuts = [low + (high - low) * i / _PARTS for i in range(_PARTS + 1)]
        ends = []
        for part in pairwise(cuts):
            points = images(self.map, enclosed((part,), _BITS), self.power)
            slope = along(self.map, points, [enclosed(((Fraction(1),) * 2,), _BITS)])[0][0]
            ends.append(slope.range)
        if all(end[0] > 0 for end in ends):
            return min(end[0] for end in ends)
        return min(-end[1] for end in ends)


def _rounded(least: Fraction) -> Fraction:
    """Round a bound down to few digits, to above 1 where it is above 1."""
    for digits in range(2, 9):
        bound = Fraction(math.floor(least * 10**digits * Fraction(9999, 10000)), 10**digits)
        if bound > 1:
            return bound
    return Fraction(0)
