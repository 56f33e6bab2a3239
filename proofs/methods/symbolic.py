"""Lemma files about symbolic dynamics: covering relations, graphs, entropy, cone conditions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.methods.cones import add_cone
from proofs.methods.lemmas import Lemmas, Number, Sides, exact
from proofs.methods.periodic import prove_all_orbits
from proofs.methods.shifts import add_covers, add_entropy, add_h_set

_MOST_BOXES = 10_000  # of a tree


@dataclass
class SymbolicLemmas(Lemmas):
    """A lemma file about maps of any kind, of steps that the checker's rules conclude.

    Raises Undecided, or the checker's Unproved, where they do not.
    """

    def h_set(self, centre: Sequence[Number], matrix: Sequence[Sequence[Number]]) -> str:
        """Add a step `h-set`; the first column is the unstable direction."""
        rows = tuple(tuple(Fraction(x) for x in row) for row in matrix)
        return add_h_set(self, tuple(Fraction(x) for x in centre), rows)

    def covers(self, function: str, power: int, source: str, target: str) -> str:
        """Add a step `covers`."""
        return add_covers(self, function, power, source, target, most=_MOST_BOXES)

    def periodic_orbits(self, function: str, period: int, box: Sides) -> str:
        """Add a step `periodic-orbits`, of the orbits that `periodic` finds in a box."""
        return prove_all_orbits(self, function, period, exact(box))

    def graph(self, covers: Sequence[str]) -> str:
        """Add a step `graph`."""
        return self.add("graph", {"covers": list(covers)})

    def entropy(self, graph: str, longest: int = 12) -> str:
        """Add a step `entropy`: the best of the bounds from path lengths up to `longest`."""
        return add_entropy(self, graph, longest)

    def cone(self, graph: str, form: Sequence[Number]) -> str:
        """Add a step `cone`, with one form for all h-sets."""
        return add_cone(self, graph, [tuple(Fraction(entry) for entry in form)])
