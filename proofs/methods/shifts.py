"""Horseshoes of any map: covering relations, graph, entropy and cones, concluded by the rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from itertools import combinations, islice, product
from math import log2
from typing import Any, NamedTuple

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.formulas import Tree, inverse, shares, subdivide
from proofs.methods.frames import Frames, crossing, frames, laps, widened
from proofs.methods.newton import distance
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.cones import Form, check_cone
from proofs.trusted.kernel.covers import HSet, LocalMap, Rows, beyond, cube
from proofs.trusted.kernel.enclose import Box, attempts, enclosed
from proofs.trusted.kernel.flow import Flow
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.numbers import Range, hull

_BITS = 64
_MOST_BOXES = 128  # of a tree
_WEIGHTS = ("1", "4", "1/4", "16")  # of stable directions in cone conditions
_MOST_PAIRS, _MOST_PROOFS, _LONGEST_WORD = 40, 3, 4
_WORK = 8_000_000  # of all attempts at one iterate
_PARTS = (1, 16)  # of a side of an h-set, on which derivatives are enclosed
_CUBE = (Fraction(-1), Fraction(1))
_AMPLE = 0.3  # by so much sets cross that they are tried before others are looked at
_STRIP, _LEAST = (-Fraction(1, 16), Fraction(1, 16)), Fraction(1, 2**20)


def add_h_set(file: Derivation, centre: tuple[Fraction, ...], matrix: Rows) -> str:
    """Add a step `h-set`; the first column is the unstable direction."""
    parts = {"matrix": matrix, "inverse": inverse(matrix)}
    witness = {name: [texts(row) for row in part] for name, part in parts.items()}
    return file.add("h-set", {"centre": texts(centre), **witness})


def _short(values: Floats) -> tuple[Fraction, ...]:
    return tuple(Fraction(f"{value:.6g}") for value in values)


def add_covers(
    file: Derivation,
    function: str,
    power: int,
    source: str,
    target: str,
    *,
    most: int = _MOST_BOXES,
) -> str:
    """Add a step `covers`, its trees found by halving; raises Undecided or Unproved.

    most: how many boxes a tree may have.
    """
    one, two = (file.context.known[name] for name in (source, target))
    if not (isinstance(one, HSet) and isinstance(two, HSet)):
        raise TypeError("covers is about h-sets")
    map_, n = file.map(function), len(one.centre)
    local = LocalMap(map_, power, one, two, _turns(map_, power, one, two))
    tip = local.values(enclosed(((Fraction(1),) * 2, *((Fraction(0),) * 2,) * (n - 1)), _BITS))[0]
    way = 1 if tip.lo + tip.hi > 0 else -1
    ends = [((end, end), *cube(n - 1)) for end in _CUBE]
    tree = partial(_tree, local, scale=_scale(local, n), most=most)
    trees = {
        "left": tree(ends[0], lambda values: beyond(values[0], -way)),
        "right": tree(ends[1], lambda values: beyond(values[0], way)),
        "support": tree(cube(n), _clear),
    }
    place = {"function": function, "power": str(power), "source": source, "target": target}
    turns = {"turns": list(map(str, local.turns))} if map_.circles else {}
    return file.add("covers", {**place, **turns, "sign": "+" if way > 0 else "-", **trees})


def _clear(values: Sequence[Any]) -> bool:
    one = 1 << values[0].bits
    return beyond(values[0]) or all(-one < v.lo and v.hi < one for v in values[1:])


def _turns(map_: Map, power: int, source: HSet, target: HSet) -> tuple[int, ...]:
    """Return how many periods lie between the image of one centre and the other."""
    sampled = Sampled(map_).iterate(power)
    start = np.array(source.centre, float)[:, None]
    apart = sampled(start)[:, 0] - np.array(target.centre, float)
    return tuple(int(np.round(apart[c.place] / sampled.periods[c.place])) for c in map_.circles)


def _scale(local: LocalMap, n: int) -> Box:
    """Return sides whose images are enclosed about equally widely, to halve boxes by."""
    units = []
    for j in range(n):
        strip = [_STRIP if k == j else (Fraction(0),) * 2 for k in range(n)]
        values = local.values(enclosed(tuple(strip), _BITS))
        reach = max(high - low for low, high in (x.range for x in values))
        units.append((Fraction(0), 1 / max(reach, _LEAST)))
    return tuple(units)


def _tree(local: LocalMap, box: Box, holds: Any, scale: Box, most: int) -> Tree:
    return subdivide(box, lambda part: _holds(local, part, holds), scale, most)


def _holds(local: LocalMap, box: Box, holds: Any) -> bool:
    ways = 1 if isinstance(local.map, Flow) else 2  # a flow's values have the mean value form
    try:
        return any(holds(values) for values in islice(attempts(local, box, (_BITS,)), ways))
    except Unproved:
        return False


def add_entropy(file: Derivation, graph: str, longest: int) -> str:
    """Add a step `entropy`: the best of the bounds from path lengths up to `longest`."""
    step = _graph(file, graph)
    vector = _perron(step.edges, len(step.nodes))
    image, best = vector, (0.0, 1, 0)
    for length in range(1, longest + 1):
        image = [sum(image[j] for i, j in step.edges if i == k) for k in range(len(vector))]
        growth = min(a // b for a, b in zip(image, vector, strict=True) if b)
        if growth ** (1 / length) > best[0] + 1e-9:
            best = (growth ** (1 / length), length, growth)
    _, length, growth = best
    if growth < 1:
        raise Undecided("the graph has no closed path, or the vector shows none")
    bound = {"length": str(length), "vector": list(map(str, vector)), "growth": str(growth)}
    return file.add("entropy", {"graph": graph, **bound})


def _perron(edges: Sequence[tuple[int, int]], count: int) -> list[int]:
    """Return about a positive eigenvector of A + 1, A the matrix of a graph, in integers."""
    vector = [1] * count
    for _ in range(200):
        vector = [v + sum(vector[j] for i, j in edges if i == k) for k, v in enumerate(vector)]
        largest = max(vector)
        if largest > 10**12:
            vector = [v * 10**9 // largest for v in vector]
    return vector


def _graph(file: Derivation, name: str) -> Graph:
    step = file.conclusion(name)
    if not isinstance(step, Graph):
        raise TypeError(f"{name} is not a graph")
    return step


def add_cone(file: Derivation, graph: str, forms: Sequence[Form] = ()) -> str:
    """Add a step `cone`, with one form for all h-sets, the first that is proved of some.

    Raises Undecided or Unproved.
    """
    step = _graph(file, graph)
    scales = [_scale(cover.local, len(step.nodes[0].centre)) for cover in step.covers]
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
    weights = [Fraction(2) ** round(log2(one / two)) for one, two in pairs]
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
            return _holds(local, part, lambda values: any(map(beyond, values)))
        if is_small := max(shares(part, scale)) <= smallest:
            inner.append(part)
        return is_small

    tree = subdivide(whole, decided, scale, _MOST_BOXES)
    box = tuple(map(hull, zip(*inner, strict=True))) if inner else whole
    own, boxes = _within(tree, box)
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


def _within(tree: Tree, box: Box) -> tuple[Tree, list[Box]]:
    """Return the part of a tree that divides a smaller box, and its leaves."""
    if tree is None:
        return None, [box]
    axis, cut = int(tree[0]) - 1, Fraction(tree[1])
    low, high = box[axis]
    if high <= cut or cut <= low:
        return _within(tree[2 if high <= cut else 3], box)
    sides = [(*box[:axis], ends, *box[axis + 1 :]) for ends in ((low, cut), (cut, high))]
    (one, first), (two, second) = (
        _within(part, side) for part, side in zip(tree[2:], sides, strict=True)
    )
    return [*tree[:2], one, two], first + second


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


def prove_shift(
    file: Derivation, function: str, power: int, candidates: Frames, growth: int
) -> list[str]:
    """Add the graph of sets and arrows, its entropy and, where that is found, uniqueness.

    growth: how many arrows lead to each set. Returns the steps of the consequences; raises
    Undecided or Unproved.
    """
    names = [
        add_h_set(file, _short(centre), tuple(map(_short, matrix)))
        for centre, matrix in zip(candidates.centres, candidates.matrices, strict=True)
    ]
    relations = [
        add_covers(file, function, power, names[i], names[j]) for i, j in candidates.arrows
    ]
    graph = file.add("graph", {"covers": relations})
    bound = {"length": "1", "vector": ["1"] * len(names), "growth": str(growth)}
    claims = [file.add("entropy", {"graph": graph, **bound})]
    with suppress(Undecided, Unproved, Exhausted):
        claims.append(add_cone(file, graph))
    return claims


class Candidates(NamedTuple):
    """Where horseshoes of an iterate are looked for.

    saddles: points over which sets are looked for, neighbours first; share: of the usual work.
    """

    saddles: Sequence[Floats]
    box: Sequence[Range]
    power: int = 1
    share: float = 1.0

    def frames(self, sampled: Sampled) -> Iterator[Frames]:
        """Yield candidates: laps on the line, then sets over two saddle points."""
        if len(self.box) == 1 and not sampled.map.circles:
            with suppress(Undecided):
                yield laps(sampled, self.box[0])
        pairs = sorted(combinations(self.saddles, 2), key=lambda pair: distance(sampled, *pair))
        for length in range(2, _LONGEST_WORD + 1):
            seen, left = [], max(1, int(_MOST_PROOFS * self.share))
            for pair in pairs[: int(_MOST_PAIRS * self.share)]:
                for margin, candidates in _crossing(sampled, pair, length):
                    if margin > _AMPLE and left:
                        left -= 1
                        yield candidates
                    else:
                        seen.append((margin, candidates))
            for _, candidates in sorted(seen, key=lambda each: -each[0])[:left]:
                yield candidates


def _crossing(
    sampled: Sampled, pair: Sequence[Floats], length: int
) -> Iterator[tuple[float, Frames]]:
    """Yield sets over two saddle points, the wider ones if these cross, and by how much."""
    with suppress(Undecided, np.linalg.LinAlgError):
        thin = frames(sampled, pair, length)
        for candidates in (widened(thin), thin):
            with suppress(Undecided):
                yield crossing(sampled, candidates), candidates
                return


def find_horseshoe(file: Derivation, function: str, candidates: Candidates) -> list[str]:
    """Prove a full shift on two symbols for an iterate; raises Undecided where none is found.

    Returns the steps.
    """
    power, reason = candidates.power, "no candidate is seen"
    sampled = Sampled(file.map(function)).iterate(power)
    with metered(_WORK * candidates.share):
        for sets in candidates.frames(sampled):
            try:
                with file.undone():
                    return prove_shift(file, function, power, sets, 2)
            except (Undecided, Unproved, Exhausted) as error:
                is_late = isinstance(error, Exhausted)
                reason = "candidates take too long to prove" if is_late else str(error)
                if is_late:
                    break
    raise Undecided(f"no horseshoe is found: {reason}")
