"""Write the Coq file of covering graphs of a map of the line: data that Coq's own checker computes.

The writer is not trusted: a reader reads `theory/Graph.v` and the definitions and theorems here.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import count, pairwise
from typing import Any

from proofs.formal.written import Case, NoTheorem, Writer, rational
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import along, images
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.numbers import Range, show, show_range
from proofs.trusted.verify import Report

_LONGEST = 5000  # operations of a formula as a tree
_PARTS = 64  # of an interval, to look for the least slope
_BITS = 64
_WRITTEN = {  # of an operation on parts: a real number, and a tree of Formula.v
    "variable": ("x", "X"),
    "pi": ("PI", "Pi"),
    "negative": ("(- {0})", "(Neg {0})"),
    "+": ("({0} + {1})", "(Add {0} {1})"),
    "-": ("({0} - {1})", "(Sub {0} {1})"),
    "*": ("({0} * {1})", "(Mul {0} {1})"),
    "/": ("({0} / {1})", "(Div {0} {1})"),
    "^": ("({0} ^ {n})", "(Power {0} {n})"),
    "1/^": ("(1 / {0} ^ {n})", "(Div (Integer 1) (Power {0} {n}))"),
    "sqrt": ("(sqrt {0})", "(Sqrt {0})"),
    "exp": ("(exp {0})", "(Exp {0})"),
    "log": ("(ln {0})", "(Log {0})"),
    "sin": ("(sin {0})", "(Sin {0})"),
    "cos": ("(cos {0})", "(Cos {0})"),
}

HEAD = """\
(* Written by python -m proofs formal from the certificate with the SHA-256
   {digest}.
   Not trusted: Coq computes and proves. To be read: Graph.v, and the map, the intervals, the arrows
   and the theorems stated here. *)
From Coq Require Import Reals ZArith List.
From Oscillator Require Import Graph Formula Cells Checker.
Import ListNotations.
Open Scope R_scope.
"""
MAP = """
Definition F{i} (x : R) : R := {real}.
Definition cells{i} : list (R * R) := [{cells}].
Definition arrows{i} : list (nat * nat) := [{arrows}]%nat.
Definition tree{i} : formula := {tree}.
Definition ends{i} := [{ends}]%Z.
Lemma checked{i} : check tree{i} {power} {unit} ends{i} arrows{i} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
"""
SEMICONJUGATE = """
(* {says} *)
Theorem graph{i} : semiconjugate {map} cells{i} arrows{i}.
Proof. exact (graph_checked tree{i} {power} {unit} ends{i} arrows{i} checked{i}). Qed.
"""
CONJUGATE = """
Lemma expanding{i} : expanding tree{i} {power} {unit} ends{i} arrows{i} {m} {n} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem graph{i} : conjugate {map} cells{i} arrows{i} ({m} / {n}).
Proof. exact (expansion_checked tree{i} {power} {unit} ends{i} arrows{i} checked{i} {m} {n}
  expanding{i}). Qed.
"""
ENTROPY = """
Definition live{j} : list (nat * nat) := [{arrows}]%nat.
Lemma live_checked{j} : check tree{i} {power} {unit} ends{i} live{j} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Definition vector{j} := [{vector}]%Z.
Lemma growing{j} : growing ends{i} live{j} vector{j} {length} {growth} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* {says} *)
Theorem entropy{j} : entropy_at_least {map} cells{i} live{j} {length} {growth}.
Proof. exact (growth_checked tree{i} {power} {unit} ends{i} live{j} live_checked{j}
  vector{j} {length} {growth} growing{j}). Qed.
"""


def formula(map_: Formulas) -> tuple[str, str]:
    """Return a formula of one variable as a term of Coq's reals, and as a tree of `Formula.v`.

    All that is known here of the checker's formulas: the nodes of its tape.
    """
    written: dict[int, tuple[str, str]] = {}
    sizes: dict[int, int] = {}
    for place in map_.tape.order(map_.roots[:1]):
        op, arguments, datum = map_.tape.nodes[place]
        sizes[place] = 1 + sum(sizes[each] for each in arguments)
        if sizes[place] > _LONGEST:
            raise NoTheorem("the formula is too long to be written as a tree")
        written[place] = _node(op, [written[each] for each in arguments], datum)
    return written[map_.roots[0]]


def _node(op: str, parts: Sequence[tuple[str, str]], datum: Fraction) -> tuple[str, str]:
    """Return an operation on parts."""
    if op == "number":
        over, under = f"(Integer ({datum.numerator}))", datum.denominator
        return rational(datum), over if under == 1 else f"(Div {over} (Integer {under}))"
    written = "1/^" if op == "^" and datum < 0 else op
    if written not in _WRITTEN:
        raise NoTheorem(f"the formulas of the theory have no {op}")
    real, tree = _WRITTEN[written]
    reals, trees = ([part[i] for part in parts] for i in (0, 1))
    return real.format(*reals, n=abs(datum)), tree.format(*trees, n=abs(datum))


class Line:
    """A graph of a map of the line, its intervals in ascending order.

    places: of the intervals in the certificate.
    """

    def __init__(self, graph: Graph) -> None:
        first = graph.covers[0].local
        self.power = first.power
        if len(first.map.variables) != 1:
            raise NoTheorem("its maps have more than one variable, and Coq has the theorem for one")
        if not isinstance(first.map, Formulas) or first.map.circles or first.map.ranges:
            raise NoTheorem("Coq has the theorem for formulas, without angles and ranges")
        if any(cover.local.map is not first.map for cover in graph.covers):
            raise NoTheorem("the graph is of several maps, and Coq has the theorem for one")
        self.map = first.map
        self.places = sorted(range(len(graph.nodes)), key=lambda i: graph.nodes[i].span())
        self.cells: list[Range] = [graph.nodes[place].span() for place in self.places]
        rank = {place: rank for rank, place in enumerate(self.places)}
        self.arrows = sorted((rank[i], rank[j]) for i, j in graph.edges)
        self.unit = math.lcm(*(end.denominator for cell in self.cells for end in cell))

    @property
    def live(self) -> list[tuple[int, int]]:
        """The arrows of infinite paths: those after which there is always another."""
        arrows = self.arrows
        while (kept := [a for a in arrows if any(b[0] == a[1] for b in arrows)]) != arrows:
            arrows = kept
        return arrows

    def steepness(self) -> Fraction:
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

    @property
    def of_map(self) -> str:
        """The map, F or F^k."""
        return self.map.name if self.power == 1 else f"{self.map.name}^{self.power}"


def pairs(arrows: Sequence[tuple[int, ...]]) -> str:
    """Write pairs of numbers for Coq."""
    return "; ".join(f"({a}, {b})" for a, b in arrows)


def _rounded(least: Fraction) -> Fraction:
    """Round a bound down to few digits, to above 1 where it is above 1."""
    for digits in range(2, 9):
        bound = Fraction(math.floor(least * 10**digits * Fraction(9999, 10000)), 10**digits)
        if bound > 1:
            return bound
    return Fraction(0)


class Graphs(Writer):
    """Collects the theorems of a certificate's graphs."""

    def graph(self, i: int, line: Line) -> dict[str, object]:
        """Write a map, its graph and the theorem on it; return what they are named."""
        real, tree = formula(line.map)
        numerators = [tuple(int(end * line.unit) for end in cell) for cell in line.cells]
        cells = ", ".join(show_range(cell) for cell in line.cells)
        named: dict[str, object] = {
            "i": i,
            "power": line.power,
            "unit": line.unit,
            "map": f"F{i}" if line.power == 1 else f"(iter F{i} {line.power})",
            "arrows": pairs(line.arrows),
        }
        written = "; ".join(f"({a} / {line.unit}, {b} / {line.unit})" for a, b in numerators)
        self.add(MAP, real=real, tree=tree, cells=written, ends=pairs(numerators), **named)
        what = (
            f"{line.map.definition}, {line.of_map} on {cells} with {len(line.arrows)} arrows: "
            "each infinite path is followed by a point, each periodic one by a periodic point, no "
            "point follows two, near points follow the same path for long, and all these points "
            "are a compact set"
        )
        least = _rounded(line.steepness())
        if least:
            m, n = least.numerator, least.denominator
            more = (
                f"; the slope is {show(least)} at least in size there: a path is followed by one "
                "point alone, and the map on these points is conjugate to the shift on paths"
            )
            self.state(f"graph{i}", what + more, CONJUGATE, **named, m=m, n=n)
        else:
            self.state(f"graph{i}", what, SEMICONJUGATE, **named)
        return named

    def entropy(self, j: int, line: Line, named: dict[str, object], witness: Any) -> None:
        """Write the theorem on the entropy of a graph."""
        vector = [int(witness["vector"][place]) for place in line.places]
        growth, length = int(witness["growth"]), int(witness["length"])
        values = {**named, "j": j, "growth": growth, "length": length}
        values |= {"arrows": pairs(line.live), "vector": "; ".join(map(str, vector))}
        says = (
            f"the entropy of {line.of_map} on the points that follow paths is at least "
            f"log({growth})/{length}"
        )
        self.state(f"entropy{j}", says, ENTROPY, **values)


def case(report: Report, source: str, digest: str) -> Case:
    """Return the Coq file of the graphs that a checked certificate claims.

    Raises Malformed where there are none.
    """
    document = json.loads(source)
    steps = [(name, document["steps"][name]) for name in document["claims"]]
    entropies = [step["witness"] for _, step in steps if step["rule"] == "entropy"]
    graphs = [name for name, step in steps if step["rule"] == "graph"]
    writer, number = Graphs(), count(1)
    for i, name in enumerate(dict.fromkeys([*graphs, *(each["graph"] for each in entropies)]), 1):
        graph = report.context.known[name]
        if not isinstance(graph, Graph):  # the checker has seen that it is
            raise NoTheorem(f"{name} is no graph")
        line = Line(graph)
        named = writer.graph(i, line)
        for each in entropies:
            if each["graph"] == name:
                writer.entropy(next(number), line, named, each)
    if not writer.theorems:
        raise Malformed("$.claims: none is a graph or an entropy")
    return writer.ended(HEAD.format(digest=digest))
