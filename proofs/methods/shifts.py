"""Horseshoes of any map: covering relations, graph, entropy and cones, concluded by the rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import combinations, islice
from typing import Any

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.formulas import Tree, inverse, subdivide
from proofs.methods.frames import Frames, crossing, frames, laps
from proofs.methods.newton import distance, iterated
from proofs.methods.sampling import Floats, Power, Sampled
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.cones import check_cone
from proofs.trusted.kernel.covers import HSet, LocalMap, beyond, cube
from proofs.trusted.kernel.enclose import Box, attempts, enclosed
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.numbers import Range, hull

_BITS = 64
_MOST_BOXES = 128  # of a tree
_WEIGHTS = ("1", "4", "1/4", "16")  # of stable directions in cone conditions
_MOST_PAIRS, _MOST_PROOFS, _LONGEST_WORD = 40, 3, 4
_WORK = 8_000_000  # of all attempts at one iterate
_PARTS = 16  # of an h-set, on which derivatives are enclosed
_CUBE = (Fraction(-1), Fraction(1))


def add_h_sets(file: Derivation, candidates: Frames) -> list[str]:
    """Add a step `h-set` for each candidate; return their names."""
    names = []
    for centre, matrix in zip(candidates.centres, candidates.matrices, strict=True):
        rows = tuple(tuple(_short(entry) for entry in row) for row in matrix)
        witness: dict[str, Any] = {"centre": texts(tuple(_short(c) for c in centre))}
        parts = {"matrix": rows, "inverse": inverse(rows)}
        witness |= {name: [texts(row) for row in part] for name, part in parts.items()}
        names.append(file.add("h-set", witness))
    return names


def _short(value: float) -> Fraction:
    return Fraction(f"{value:.6g}")


def add_covers(file: Derivation, function: str, power: int, source: str, target: str) -> str:
    """Add a step `covers`, its trees found by halving; raises Undecided or Unproved."""
    one, two = (file.context.known[name] for name in (source, target))
    if not (isinstance(one, HSet) and isinstance(two, HSet)):
        raise TypeError("covers is about h-sets")
    map_, n = file.map(function), len(one.centre)
    local = LocalMap(map_, power, one, two, _turns(map_, power, one, two))
    tip = local.values(enclosed(((Fraction(1),) * 2, *((Fraction(0),) * 2,) * (n - 1)), _BITS))[0]
    way = 1 if tip.lo + tip.hi > 0 else -1
    ends = [((end, end), *cube(n - 1)) for end in _CUBE]
    trees = {
        "left": _tree(local, ends[0], lambda values: beyond(values[0], -way)),
        "right": _tree(local, ends[1], lambda values: beyond(values[0], way)),
        "support": _tree(local, cube(n), _clear),
    }
    place = {"function": function, "power": str(power), "source": source, "target": target}
    turns = {"turns": list(map(str, local.turns))} if map_.circles else {}
    return file.add("covers", {**place, **turns, "sign": "+" if way > 0 else "-", **trees})


def _clear(values: Sequence[Any]) -> bool:
    one = 1 << values[0].bits
    return beyond(values[0]) or all(-one < v.lo and v.hi < one for v in values[1:])


def _turns(map_: Map, power: int, source: HSet, target: HSet) -> tuple[int, ...]:
    """Return how many periods lie between the image of one centre and the other."""
    sampled = Sampled(map_)
    start = np.array(source.centre, float)[:, None]
    apart = iterated(sampled, start, power)[:, 0] - np.array(target.centre, float)
    return tuple(int(np.round(apart[c.place] / sampled.periods[c.place])) for c in map_.circles)


def _tree(local: LocalMap, box: Box, holds: Any) -> Tree:
    def decided(part: Box) -> bool:
        return any(holds(values) for values in islice(attempts(local, part, (_BITS,)), 2))

    return subdivide(box, decided, most=_MOST_BOXES)


def add_cone(file: Derivation, graph: str) -> str:
    """Add a step `cone`, with one form for all h-sets; raises Undecided or Unproved."""
    step = file.conclusion(graph)
    if not isinstance(step, Graph):
        raise TypeError("cone is about a graph")
    n = len(step.nodes[0].centre)
    bounds = [_derivatives(cover.local, n) for cover in step.covers]
    trees = [_halved(cube(n), _PARTS)[0]] * len(bounds)
    for weight in map(Fraction, _WEIGHTS if n > 1 else _WEIGHTS[:1]):
        form = (Fraction(1), *(-weight,) * (n - 1))
        try:
            matrices = [_cone_tree(jacobian, form) for jacobian in bounds]
        except Undecided:
            continue
        relations = [
            {
                "box": [texts(side) for side in cube(n)],
                "outside": None,
                "jacobian": [texts(side) for side in jacobian],
                "tree": tree,
                "matrices": part,
            }
            for jacobian, tree, part in zip(bounds, trees, matrices, strict=True)
        ]
        forms = [texts(form)] * len(step.nodes)
        return file.add("cone", {"graph": graph, "forms": forms, "relations": relations})
    raise Undecided("no form of the cone condition is found")


def _derivatives(local: LocalMap, n: int) -> Box:
    """Return bounds of few digits on the derivatives on a whole h-set, row by row."""
    rows = [
        [entry.range for row in local.jacobian(enclosed(part, _BITS)) for entry in row]
        for part in _halved(cube(n), _PARTS)[1]
    ]
    unit = Fraction(1, 2**20)
    return tuple(
        ((low // unit - 1) * unit, (high // unit + 2) * unit)
        for low, high in (hull(entries) for entries in zip(*rows, strict=True))
    )


def _halved(box: Box, parts: int) -> tuple[Tree, list[Box]]:
    """Return a tree that divides a box into equal parts, a power of two, and these."""
    if parts == 1:
        return None, [box]
    axis = max(range(len(box)), key=lambda k: (box[k][1] - box[k][0], -k))
    (low, high), half = box[axis], parts // 2
    cut = (low + high) / 2
    sides = [(*box[:axis], ends, *box[axis + 1 :]) for ends in ((low, cut), (cut, high))]
    (one, first), (two, second) = (_halved(side, half) for side in sides)
    return [str(axis + 1), str(cut), one, two], first + second


def _cone_tree(jacobian: Box, form: tuple[Fraction, ...]) -> Tree:
    def decided(part: Box) -> bool:
        try:
            check_cone(part, form, form)
        except Unproved:
            return False
        return True

    scale = ((Fraction(0), Fraction(1)),) * len(jacobian)  # derivatives are compared as they are
    return subdivide(jacobian, decided, scale, _MOST_BOXES)


def prove_shift(
    file: Derivation, function: str, power: int, candidates: Frames, growth: int
) -> list[str]:
    """Add the graph of sets and arrows, its entropy and, where that is found, uniqueness.

    growth: how many arrows lead to each set. Returns the steps of the consequences; raises
    Undecided or Unproved.
    """
    names = add_h_sets(file, candidates)
    relations = [
        add_covers(file, function, power, names[i], names[j]) for i, j in candidates.arrows
    ]
    graph = file.add("graph", {"covers": relations})
    bound = {"length": "1", "vector": ["1"] * len(names), "growth": str(growth)}
    claims = [file.add("entropy", {"graph": graph, **bound})]
    with suppress(Undecided, Unproved):
        claims.append(add_cone(file, graph))
    return claims


def shifts(sampled: Sampled, saddles: Sequence[Floats], box: Sequence[Range]) -> Iterator[Frames]:
    """Yield candidates of horseshoes: laps on the line, then sets over two saddle points."""
    if len(box) == 1 and not sampled.map.circles:
        with suppress(Undecided):
            yield laps(sampled, box[0])
    pairs = sorted(combinations(saddles, 2), key=lambda pair: distance(sampled, *pair))
    for length in range(2, _LONGEST_WORD + 1):
        seen = []
        for pair in pairs[:_MOST_PAIRS]:
            with suppress(Undecided, np.linalg.LinAlgError):
                candidates = frames(sampled, pair, length)
                seen.append((crossing(sampled, candidates), candidates))
        for _, candidates in sorted(seen, key=lambda each: -each[0])[:_MOST_PROOFS]:
            yield candidates


def find_horseshoe(
    file: Derivation,
    function: str,
    saddles: Sequence[Floats],
    box: Sequence[Range],
    power: int = 1,
) -> list[str]:
    """Prove a full shift on two symbols for an iterate; raises Undecided where none is found.

    saddles: points over which sets are looked for, neighbours first. Returns the steps.
    """
    sampled, reason = Power(file.map(function), power), "no candidate is seen"
    with metered(_WORK):
        for candidates in shifts(sampled, saddles, box):
            kept = {*file.steps}
            try:
                return prove_shift(file, function, power, candidates, 2)
            except (Undecided, Unproved, Exhausted) as error:
                is_late = isinstance(error, Exhausted)
                reason = "candidates take too long to prove" if is_late else str(error)
                file.forget({*file.steps} - kept)
                if is_late:
                    break
    raise Undecided(f"no horseshoe is found: {reason}")
