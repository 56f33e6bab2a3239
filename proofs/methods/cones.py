"""Cone conditions on the arrows of a graph: forms, and boxes of what stays, with their trees."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import product
from math import log2
from typing import Any

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import holds, scale_of, shares, subdivide
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.cones import Form, derivatives, difference, positive_definite
from proofs.trusted.kernel.covers import LocalMap, beyond, cube
from proofs.trusted.kernel.enclose import Box, enclosed
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.numbers import hull

_BITS = 64
_MOST_BOXES = 128  # of a tree
_WEIGHTS = ("1", "4", "1/4", "16")  # of stable directions in cone conditions
_PARTS = (1, 16)  # of a side of an h-set, on which derivatives are enclosed
_STRIP = -Fraction(1, 16), Fraction(1, 16)


def graph_of(file: Derivation, name: str) -> Graph:
    """Return the graph that a step concludes."""
    step = file.known[name]
    if not isinstance(step, Graph):
        raise TypeError(f"{name} is not a graph")
    return step


def add_cone(file: Derivation, graph: str, forms: Sequence[Form] = ()) -> str:
    """Add a step `cone`, with one form for all h-sets, the first that is proved of some.

    Raises Undecided or Unproved.
    """
    step = graph_of(file, graph)
    scales = [scale_of(cover.local, cube(len(step.nodes[0].centre))) for cover in step.covers]
    for form, parts in product(forms or _forms(step), _PARTS):
        with suppress(Undecided, Unproved):
            relations = [
                _relation(cover.local, form, scale, parts)
                for cover, scale in zip(step.covers, scales, strict=True)
            ]
            witness = {"forms": [texts(form)] * len(step.nodes), "relations": relations}
            return file.add("cone", {"graph": graph, **witness})
    raise Undecided("no form of the cone condition is found")


def _forms(graph: Graph) -> list[Form]:
    """Return forms to try: weights that balance what mixes the directions come first.

    With D = (a, b; c, d) and the form q_1^2 - w q_2^2 the condition is about a^2 > 1 + w c^2 and
    w > b^2 / (a^2 - 1): for flows, where c is enclosed widely and b is tiny, w = b / c.
    """
    n = len(graph.nodes[0].centre)
    usual = [(Fraction(1), *(-Fraction(weight),) * (n - 1)) for weight in _WEIGHTS]
    if n == 1:
        return usual[:1]
    most = [[Fraction(0)] * n for _ in range(n)]
    for cover in graph.covers:
        strip = enclosed((_STRIP, *cube(n - 1)), _BITS)
        for row, entries in zip(most, cover.local.jacobian(strip), strict=True):
            for j, entry in enumerate(entries):
                row[j] = max(row[j], *map(abs, entry.range))
    pairs = [(most[0][j], most[j][0]) for j in range(1, n)]
    if not all(min(pair) for pair in pairs):
        return usual
    weights = [Fraction(2) ** round(log2(upper / lower)) for upper, lower in pairs]
    return [(Fraction(1), *(-weight for weight in weights)), *usual]


def _relation(local: LocalMap, form: Form, scale: Box, parts: int) -> dict[str, Any]:
    """Return what `cone` is told about a relation: a box, and a tree.

    [-1, 1]^n is halved until each part is mapped out of the target, or derivatives on it are
    enclosed that obey the condition, the part being small enough. The box is around these parts.
    """
    whole, inner = cube(len(scale)), list[Box]()
    smallest = max(shares(whole, scale)) / parts

    def decided(part: Box) -> bool:
        if not _obeys(local, part, form):
            return holds(local, part, lambda values: any(map(beyond, values)))
        if is_small := max(shares(part, scale)) <= smallest:
            inner.append(part)
        return is_small

    tree = subdivide(whole, decided, scale, _MOST_BOXES)
    box = tuple(map(hull, zip(*inner, strict=True))) if inner else whole
    return {"box": list(map(texts, box)), "tree": tree}


def _obeys(local: LocalMap, box: Box, form: Form) -> bool:
    """Whether derivatives on a box, where they are enclosed, obey the condition."""
    with suppress(Unproved):
        matrices = derivatives(local, box, _BITS)
        return positive_definite(difference(matrices, form, form, _BITS))
    return False
