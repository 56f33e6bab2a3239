"""Horseshoes of any map: covering relations, graph and entropy, concluded by the rules."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from intervals import Undecided
from proofs.methods.cones import add_cone, graph_of
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import Tree, holds, scale_of, subdivide
from proofs.methods.frames import Frames, crossing, frames, laps, widened
from proofs.methods.lemmas import inverse
from proofs.methods.newton import distance
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import HSet, LocalMap, Rows, beyond, cube
from proofs.trusted.kernel.enclose import Box, enclosed
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.numbers import Range

_BITS, _PLACES = 64, 4  # places: of centres, after the first of the radius
_MOST_BOXES = 128  # of a tree
_MOST_PAIRS, _MOST_PROOFS, _LONGEST_WORD = 40, 3, 4
_WORK = 8_000_000  # of all attempts at one iterate
_CUBE = (Fraction(-1), Fraction(1))
_AMPLE = 0.3  # the first sets that cross by so much are tried before others are looked at


def add_h_set(file: Derivation, centre: tuple[Fraction, ...], matrix: Rows) -> str:
    """Add a step `h-set`; the first column is the unstable direction."""
    parts = {"matrix": matrix, "inverse": inverse(matrix)}
    witness = {name: [texts(row) for row in part] for name, part in parts.items()}
    return file.add("h-set", {"centre": texts(centre), **witness})


def _short(values: Floats) -> tuple[Fraction, ...]:
    return tuple(Fraction(f"{value:.6g}") for value in values)


def _centre(values: Floats, radii: Floats) -> tuple[Fraction, ...]:
    """Round to as many digits as matter for a set of these radii."""
    units = (Fraction(10) ** (math.floor(math.log10(radius)) - _PLACES) for radius in radii)
    return tuple(
        round(Fraction(float(x)) / unit) * unit for x, unit in zip(values, units, strict=True)
    )


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
    first, second = (file.context.known[name] for name in (source, target))
    if not (isinstance(first, HSet) and isinstance(second, HSet)):
        raise TypeError("covers is about h-sets")
    map_, n = file.map(function), len(first.centre)
    local = LocalMap(map_, power, first, second, _turns(map_, power, first, second))
    tip = local.values(enclosed(((Fraction(1),) * 2, *((Fraction(0),) * 2,) * (n - 1)), _BITS))[0]
    way = 1 if tip.lo + tip.hi > 0 else -1
    ends = [((end, end), *cube(n - 1)) for end in _CUBE]
    tree = partial(_tree, local, scale=scale_of(local, cube(n)), most=most)
    trees = {
        "left": tree(ends[0], lambda values: beyond(values[0], -way)),
        "right": tree(ends[1], lambda values: beyond(values[0], way)),
        "support": tree(cube(n), _clear),
    }
    place = {"function": function, "power": str(power), "source": source, "target": target}
    turns = {"turns": list(map(str, local.turns))} if map_.circles else {}
    return file.add("covers", {**place, **turns, "sign": "+" if way > 0 else "-", **trees})


def _clear(values: Sequence[Any]) -> bool:
    unit = 1 << values[0].bits
    return beyond(values[0]) or all(-unit < v.lo and v.hi < unit for v in values[1:])


def _turns(map_: Map, power: int, source: HSet, target: HSet) -> tuple[int, ...]:
    """Return how many periods lie between the image of one centre and the other."""
    sampled = Sampled(map_).iterate(power)
    start = np.array(source.centre, float)[:, None]
    apart = sampled(start)[:, 0] - np.array(target.centre, float)
    return tuple(int(np.round(apart[c.place] / sampled.periods[c.place])) for c in map_.circles)


def _tree(local: LocalMap, box: Box, test: Any, scale: Box, most: int) -> Tree:
    return subdivide(box, lambda part: holds(local, part, test), scale, most)


def add_entropy(file: Derivation, graph: str, longest: int) -> str:
    """Add a step `entropy`: the best of the bounds from path lengths up to `longest`."""
    step = graph_of(file, graph)
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


def prove_shift(
    file: Derivation, function: str, power: int, candidates: Frames, growth: int
) -> list[str]:
    """Add the graph of sets and arrows, its entropy and, where that is found, uniqueness.

    growth: how many arrows lead to each set. Returns the steps of the consequences; raises
    Undecided or Unproved.
    """
    names = [
        add_h_set(file, _centre(centre, np.abs(matrix).sum(axis=1)), tuple(map(_short, matrix)))
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
            is_first = True
            for pair in pairs[: int(_MOST_PAIRS * self.share)]:
                for margin, candidates in _crossing(sampled, pair, length):
                    if margin > _AMPLE and is_first:
                        is_first, left = False, left - 1
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
    with metered(int(_WORK * candidates.share)):
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
