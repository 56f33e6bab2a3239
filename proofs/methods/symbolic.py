"""Lemma files about symbolic dynamics: covering relations, graphs, entropy, cone conditions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from intervals import Interval, Undecided
from proofs.methods.cells import Region, function_of, invariant_cover
from proofs.methods.formulas import (
    Local,
    Values,
    dot,
    followed,
    inverse,
    subdivide,
)
from proofs.methods.lemmas import Lemmas, Number, Sides, exact, written
from proofs.methods.periodic import Orbit, periodic_orbits
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.covers import HSet
from proofs.trusted.kernel.enclose import Box
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.numbers import Range

_CUBE_SIDE = (Fraction(-1), Fraction(1))
_BITS, _STEPS = 160, 6  # of Newton's method
_PLACE, RADIUS = Fraction(1, 10**26), Fraction(1, 10**22)  # of periodic points
_ENTRIES = ((Fraction(0), Fraction(1)),)  # derivatives are compared as they are


@dataclass
class SymbolicLemmas(Lemmas):
    """A lemma file with h-sets."""

    h_sets: dict[str, HSet] = field(default_factory=dict)

    def h_set(self, centre: Sequence[Number], matrix: Sequence[Sequence[Number]]) -> str:
        """Add a step `h-set`; the first column is the unstable direction."""
        middle = tuple(Fraction(x) for x in centre)
        rows = tuple(tuple(Fraction(x) for x in row) for row in matrix)
        found = HSet(middle, rows, inverse(rows))
        parts = {"matrix": found.matrix, "inverse": found.inverse}
        witness = {name: [texts(row) for row in part] for name, part in parts.items()}
        name = self.add("h-set", {"centre": texts(middle), **witness})
        self.h_sets[name] = found
        return name

    def local(self, function: str, power: int, source: str, target: str) -> Local:
        """Return an iterate in the coordinates of two h-sets."""
        return Local(self.function(function), power, self.h_sets[source], self.h_sets[target])

    def covers(self, function: str, power: int, source: str, target: str) -> str:
        """Add a step `covers`."""
        local = self.local(function, power, source, target)
        n = len(local.formula.variables)
        whole = (_CUBE_SIDE,) * n
        right = ((Fraction(1), Fraction(1)), *whole[1:])
        left = ((Fraction(-1), Fraction(-1)), *whole[1:])
        # the sign at one point: over the whole face it may be unclear
        tip = [Interval(1), *[Interval(0)] * (n - 1)]
        way = 1 if local.values(tip)[0].mid > 0 else -1

        def clear(part: Box) -> bool:
            first, *others = local.on(part)
            return all(v.inf > -1 and v.sup < 1 for v in others) or _outside([first])

        trees = {
            "left": subdivide(left, lambda part: _beyond(local.on(part)[0], -way)),
            "right": subdivide(right, lambda part: _beyond(local.on(part)[0], way)),
            "support": subdivide(whole, clear),
        }
        place = {"function": function, "power": str(power), "source": source, "target": target}
        return self.add("covers", {**place, "sign": "+" if way > 0 else "-", **trees})

    def periodic_orbits(self, function: str, period: int, box: Sides) -> str:
        """Add a step `periodic-orbits`, of the orbits that `periodic` finds in a box."""
        formula, sides = self.function(function), exact(box)
        cover = invariant_cover(function_of(formula), Region(tuple(Interval(*x) for x in sides)))
        found = [orbit_witness(formula, each) for each in periodic_orbits(cover, period)]
        witness = {"function": function, "period": str(period), "box": written(sides)}
        return self.add("periodic-orbits", {**witness, "radius": str(RADIUS), "orbits": found})

    def graph(self, covers: Sequence[str]) -> str:
        """Add a step `graph`."""
        return self.add("graph", {"covers": list(covers)})

    def entropy(self, graph: str, longest: int = 12) -> str:
        """Add a step `entropy`: the best of the bounds from path lengths up to `longest`."""
        edges = self._edges(graph)
        names = list(dict.fromkeys(name for edge in edges for name in edge))
        places = [(names.index(a), names.index(b)) for a, b in edges]
        vector = _perron(places, len(names))
        image, best = vector, (0.0, 1, 0)
        for length in range(1, longest + 1):
            image = [sum(image[j] for i, j in places if i == k) for k in range(len(names))]
            growth = min(a // b for a, b in zip(image, vector, strict=True) if b)
            if growth ** (1 / length) > best[0] + 1e-9:
                best = (growth ** (1 / length), length, growth)
        _, length, growth = best
        if growth < 1:
            raise Undecided("the graph has no closed path, or the vector shows none")
        found = {"length": str(length), "vector": list(map(str, vector)), "growth": str(growth)}
        return self.add("entropy", {"graph": graph, **found})

    def _edges(self, graph: str) -> list[tuple[str, str]]:
        steps = [self.steps[name]["witness"] for name in self.steps[graph]["witness"]["covers"]]
        return [(step["source"], step["target"]) for step in steps]

    def cone(self, graph: str, form: Sequence[Number]) -> str:
        """Add a step `cone`, with one form for all h-sets, on the whole of each."""
        numbers = [Fraction(entry) for entry in form]
        n, relations = len(numbers), []
        whole = (_CUBE_SIDE,) * n
        for name in self.steps[graph]["witness"]["covers"]:
            step = self.steps[name]["witness"]
            local = self.local(step["function"], int(step["power"]), step["source"], step["target"])
            rows = local.jacobian([Interval(*side) for side in whole])
            bounds = tuple(_outward(entry) for row in rows for entry in row)
            matrices = subdivide(bounds, lambda part: _is_cone(part, numbers), _ENTRIES * n**2)
            relation = {"box": written(whole), "outside": None, "jacobian": written(bounds)}
            relations.append({**relation, "tree": None, "matrices": matrices})
        forms = [texts(numbers)] * len({name for edge in self._edges(graph) for name in edge})
        return self.add("cone", {"graph": graph, "forms": forms, "relations": relations})


def orbit_witness(formula: Formulas, orbit: Orbit) -> dict[str, Any]:
    """Return a point of an orbit to many digits, by Newton's method, as the rule reads it."""
    point, matrix = [x.mid for x in orbit.points[0]], []
    for _ in range(_STEPS):
        x = [Interval(value, precision=_BITS) for value in point]
        unit = [[int(i == j) for j in range(len(x))] for i in range(len(x))]
        x, product = followed(formula, x, unit, orbit.period)
        closing = (
            tuple(entry.mid - int(i == j) for j, entry in enumerate(row))
            for i, row in enumerate(product)
        )
        matrix = [[Fraction(f"{float(c):.10g}") for c in row] for row in inverse(tuple(closing))]
        missed = [after.mid - before for after, before in zip(x, point, strict=True)]
        last, moved = point, (x - dot(row, missed) for x, row in zip(point, matrix, strict=True))
        point = [round(x / _PLACE) * _PLACE for x in moved]
        if point == last:
            break
    entries = [texts(row) for row in matrix]
    return {"point": texts(point), "period": str(orbit.period), "matrix": entries}


def _beyond(value: Interval, way: int) -> bool:
    """Whether way value > 1."""
    return value.inf > 1 if way > 0 else value.sup < -1


def _outside(found: Values) -> bool:
    return any(_beyond(value, way) for value in found for way in (1, -1))


def _outward(value: Interval) -> Range:
    """Return bounds of few digits around an interval."""
    ulp = Fraction(1, 2**20)
    return (value.inf // ulp - 1) * ulp, (value.sup // ulp + 2) * ulp


def _perron(edges: Sequence[tuple[int, int]], count: int) -> list[int]:
    """Return about a positive eigenvector of A + 1, A the matrix of a graph, in integers."""
    vector = [1] * count
    for _ in range(200):
        vector = [v + sum(vector[j] for i, j in edges if i == k) for k, v in enumerate(vector)]
        largest = max(vector)
        if largest > 10**12:
            vector = [v * 10**9 // largest for v in vector]
    return vector


def _is_cone(part: Box, form: Sequence[Fraction]) -> bool:
    """Whether D^T Q D - Q is positive definite for all D within bounds, by elimination."""
    n = len(form)
    d = [[Interval(*part[i * n + j]) for j in range(n)] for i in range(n)]
    rows = [
        [dot(form, [(row[i] * row[j] if i != j else row[i] ** 2) for row in d]) for j in range(n)]
        for i in range(n)
    ]
    for i in range(n):
        rows[i][i] = rows[i][i] - form[i]
    while rows:
        pivot = rows[0][0]
        if not pivot.inf > 0:
            return False
        column = [row[0] for row in rows[1:]]
        rows = [
            [entry - a * b / pivot for b, entry in zip(column, row[1:], strict=True)]
            for a, row in zip(column, rows[1:], strict=True)
        ]
    return True
