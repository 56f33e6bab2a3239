"""Write the Coq file of covering graphs of maps: data that Coq's own checker computes.

The writer is not trusted: a reader reads `theory/Graph.v`, and `theory/Histories.v` for maps of the
plane, and the definitions and theorems here.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from itertools import count
from typing import Any

from proofs.formal.line import Line
from proofs.formal.plane import Plane
from proofs.formal.written import Case, NoTheorem, Writer, pairs, rational
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.verify import Report

_LONGEST = 5000  # operations of a formula as a tree
_WRITTEN = {  # of an operation on parts: a real number, and a tree of Formula.v
    "first": ("x", "X"),
    "second": ("y", "Y"),
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
(* Written by python -m proofs formal from the certificate with the digest
   {digest}.
   Not trusted: Coq computes and proves. To be read: Graph.v, for the plane
   Histories.v, and the map, the sets, the arrows and the theorems stated here. *)
From Coq Require Import Reals ZArith List.
From Oscillator Require Import {modules}.
Import ListNotations.
Open Scope R_scope.
"""


def formulas(map_: Formulas) -> list[tuple[str, str]]:
    """Return a map's formulas as terms of Coq's reals, and as trees of `Formula.v`.

    All that is known here of the checker's formulas: the nodes of its tape.
    """
    written: dict[int, tuple[str, str]] = {}
    sizes: dict[int, int] = {}
    for place in map_.tape.order(map_.roots):
        op, arguments, datum = map_.tape.nodes[place]
        sizes[place] = 1 + sum(sizes[each] for each in arguments)
        if sizes[place] > _LONGEST:
            raise NoTheorem("the formula is too long to be written as a tree")
        written[place] = _node(op, [written[each] for each in arguments], datum)
    return [written[root] for root in map_.roots]


def _node(op: str, parts: Sequence[tuple[str, str]], datum: Fraction) -> tuple[str, str]:
    """Return an operation on parts."""
    if op == "number":
        over, under = f"(Integer ({datum.numerator}))", datum.denominator
        return rational(datum), over if under == 1 else f"(Div {over} (Integer {under}))"
    if op == "variable":
        return _WRITTEN[("first", "second")[int(datum)]]
    written = "1/^" if op == "^" and datum < 0 else op
    if written not in _WRITTEN:
        raise NoTheorem(f"the formulas of the theory have no {op}")
    real, tree = _WRITTEN[written]
    reals, trees = ([part[i] for part in parts] for i in (0, 1))
    return real.format(*reals, n=abs(datum)), tree.format(*trees, n=abs(datum))


def _map(graph: Graph) -> Formulas:
    """Return the map of a graph, if Coq has a theorem for it."""
    map_ = graph.covers[0].local.map
    if len(map_.variables) > 2:
        raise NoTheorem("its maps have more than two variables")
    if not isinstance(map_, Formulas) or map_.circles or map_.ranges:
        raise NoTheorem("Coq has the theorem for formulas, without angles and ranges")
    if any(cover.local.map is not map_ for cover in graph.covers):
        raise NoTheorem("the graph is of several maps, and Coq has the theorem for one")
    return map_


def _label(map_: Formulas, power: int) -> str:
    """Return the name of a map, F or F^k."""
    return map_.name if power == 1 else f"{map_.name}^{power}"


class Graphs(Writer):
    """Collects the theorems of a certificate's graphs."""

    def graph(self, i: int, map_: Formulas, of: Line | Plane) -> dict[str, object]:
        """Write a map, its graph and the theorem on it; return what they are named."""
        reals, trees = zip(*formulas(map_), strict=True)
        named: dict[str, object] = {
            "i": i,
            "power": of.power,
            "unit": of.unit,
            "map": f"F{i}" if of.power == 1 else f"(iter F{i} {of.power})",
            "arrows": pairs(of.arrows),
            "real": ", ".join(reals),
            "tree": ", ".join(trees),
            **of.values,
        }
        says = f"{map_.definition}, {_label(map_, of.power)} {of.says}"
        self.state(f"graph{i}", says, of.graph, **named)
        return named

    def entropy(
        self, j: int, map_: Formulas, of: Line | Plane, named: dict[str, object], witness: Any
    ) -> None:
        """Write the theorem on the entropy of a graph."""
        vector = of.weights(witness["vector"])
        growth, length = int(witness["growth"]), int(witness["length"])
        values = {**named, "j": j, "growth": growth, "length": length}
        values |= {"arrows": pairs(of.live), "vector": "; ".join(map(str, vector))}
        says = (
            f"the entropy of {_label(map_, of.power)} on the points that follow paths is at least "
            f"log({growth})/{length}"
        )
        self.state(f"entropy{j}", says, of.entropy, **values)


def case(report: Report, source: str, digest: str) -> Case:
    """Return the Coq file of the graphs that a checked certificate claims.

    Raises Malformed where there are none.
    """
    document = json.loads(source)
    steps = [document["steps"][name] | {"name": name} for name in document["claims"]]
    asked = [step["witness"] for step in steps if step["rule"] == "entropy"]
    names = [step["name"] for step in steps if step["rule"] == "graph"]
    names += [step["witness"]["graph"] for step in steps if step["rule"] in ("entropy", "cone")]
    writer, number = Graphs(), count(1)
    kinds: dict[str, None] = {}
    for i, name in enumerate(dict.fromkeys(names), 1):
        graph = report.context.known[name]
        if not isinstance(graph, Graph):  # the checker has seen that it is
            raise NoTheorem(f"{name} is no graph")
        map_ = _map(graph)
        of = (Line if len(map_.variables) == 1 else Plane)(graph)
        kinds |= dict.fromkeys([*of.modules.split()])
        named = writer.graph(i, map_, of)
        for each in asked:
            if each["graph"] == name:
                writer.entropy(next(number), map_, of, named, each)
    if not writer.theorems:
        raise Malformed("$.claims: none is a graph, an entropy or a cone")
    return writer.ended(HEAD.format(digest=digest, modules=" ".join(kinds)))
