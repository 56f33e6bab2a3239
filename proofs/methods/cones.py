"""Cone conditions on the arrows of a graph: boxes, bounds on derivatives, trees that show them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import log2
from typing import Any

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import holds, part_of_tree, scale_of
from proofs.methods.formulas import Tree, shares, subdivide
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.cones import Form, check_cone
from proofs.trusted.kernel.covers import LocalMap, beyond, cube
from proofs.trusted.kernel.enclose import Box, enclosed
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.numbers import Range, hull

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
        try:
            relations = [
                _cone_relation(cover.local, form, scale, parts)
                for cover, scale in zip(step.covers, scales, strict=True)
            ]
        except Undecided:
            continue
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


def _cone_relation(local: LocalMap, form: Form, scale: Box, parts: int) -> dict[str, Any]:
    """Return what `cone` is told about a relation: a box, bounds on its derivatives, trees.

    [-1, 1]^n is halved until each part is mapped out of the target, or derivatives on it are
    enclosed that obey the condition, the part being small enough. The box is around these parts.
    """
    whole, inner = cube(len(scale)), list[Box]()
    smallest = max(shares(whole, scale)) / parts

    def decided(part: Box) -> bool:
        try:
            check_cone(_entries(local, part), form, form, (_BITS,))
        except Unproved:
            return holds(local, part, lambda values: any(map(beyond, values)))
        if is_small := max(shares(part, scale)) <= smallest:
            inner.append(part)
        return is_small

    tree = subdivide(whole, decided, scale, _MOST_BOXES)
    box = tuple(map(hull, zip(*inner, strict=True))) if inner else whole
    own, boxes = part_of_tree(tree, box)
    rows = [_entries(local, part) for part in boxes]
    bounds = tuple(_rounded(hull(sides)) for sides in zip(*rows, strict=True))
    return {
        "box": list(map(texts, box)),
        "outside": tree,
        "jacobian": list(map(texts, bounds)),
        "tree": own,
        "matrices": _cone_tree(bounds, form),
    }


def _entries(local: LocalMap, box: Box) -> Box:
    """Enclose the derivatives on a box, row by row."""
    rows = local.jacobian(enclosed(box, _BITS))
    return tuple(entry.range for row in rows for entry in row)


def _rounded(side: Range) -> Range:
    """Return an interval around another one, with few digits."""
    low, high = side
    unit = Fraction(1, 2**20)
    while 1024 * unit < high - low:
        unit *= 2
    return (low // unit - 1) * unit, (high // unit + 2) * unit


def _is_cone(matrices: Box, form: Form) -> bool:
    try:
        check_cone(matrices, form, form, (_BITS,))
    except Unproved:
        return False
    return True


def _cone_tree(jacobian: Box, form: Form) -> Tree:
    scale = ((Fraction(0), Fraction(1)),) * len(jacobian)  # derivatives are compared as they are
    return subdivide(jacobian, lambda part: _is_cone(part, form), scale, _MOST_BOXES)
