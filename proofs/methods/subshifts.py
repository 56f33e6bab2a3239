"""Large subshifts in a piecewise monotone map, and their entropy, by covering graphs.

A map f of an interval is continuous and monotone on disjoint closed pieces Z_1, ..., Z_m. A state
is a closed interval D. For each piece, f(D and Z_b) is the interval between the images of two
ends; if it contains a state E, there is an edge D -> E. Two edges from one state belong to
different pieces, so different paths from one state are followed by different orbits, and the log
of the spectral radius of the graph bounds the topological entropy of f from below.

The states to take: the images of the pieces, the images of their parts, and so on (Hofbauer's
tower). With all of them the bound is the entropy of f on the pieces; a few steps come close.
Source: F. Hofbauer, On intrinsic ergodicity of piecewise monotonic transformations with positive
entropy, Israel J. Math. 34 (1979).

From above: if the pieces are all that an orbit that stays can be in, and each image of a part of a
state lies in a state again, then the words over the pieces grow no faster than the paths.

Everything here is a candidate; growths are exact for the images that were given.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from proofs.trusted.numbers import Range

Image = Callable[[int, Fraction], Range]  # an enclosure of f at a point of a piece
Images = Callable[[Range], Sequence[Range]]  # what holds the images of the parts of a state

_ROUNDS = 400
_SCALE = 10**12
_LEAST = 1e-9  # value of a state from which few paths stay, beside the greatest


@dataclass(frozen=True)
class Growing:
    """States, and a vector v of whole numbers that bounds the growth of paths of a graph A.

    From below, A v >= growth v, or from above, A v <= growth v, all entries of v being positive
    (Collatz and Wielandt).
    """

    states: tuple[Range, ...]
    vector: tuple[int, ...]
    growth: Fraction


def common(piece: Range, state: Range) -> Range | None:
    """Return the common part of two intervals if it is longer than a point."""
    low, high = max(piece[0], state[0]), min(piece[1], state[1])
    return (low, high) if low < high else None


def between(first: Range, second: Range) -> Range | None:
    """Return what certainly lies between two enclosed numbers: the image of an interval has it."""
    low, high = min(first[1], second[1]), max(first[0], second[0])
    return (low, high) if low < high else None


def arc(pieces: Sequence[Range], image: Image, index: int, state: Range) -> Range | None:
    """Return what f is known to cover by the part of a state in a piece."""
    part = common(pieces[index], state)
    return None if part is None else between(image(index, part[0]), image(index, part[1]))


def tower(pieces: Sequence[Range], image: Image, depth: int, places: int) -> list[Range]:
    """Return the images of the pieces and, depth times, those of the parts that states cut off.

    They are rounded inward to decimals, and so lie inside the images.
    """
    fresh = _images(pieces, image, ((i, piece) for i, piece in enumerate(pieces)), places)
    states = set(fresh)
    for _ in range(depth):
        cut = (
            (i, state)
            for state in fresh
            for i, piece in enumerate(pieces)
            if common(piece, state) not in (None, piece)
        )
        fresh = _images(pieces, image, cut, places) - states
        states |= fresh
    return sorted(states)


def _images(
    pieces: Sequence[Range], image: Image, parts: Iterable[tuple[int, Range]], places: int
) -> set[Range]:
    """Return the images of parts of pieces, rounded inward."""
    unit, rounded = Fraction(1, 10**places), set()
    for index, state in parts:
        image_arc = arc(pieces, image, index, state)
        if image_arc is not None:
            low, high = -(-image_arc[0] // unit) * unit, image_arc[1] // unit * unit
            if low < high:
                rounded.add((low, high))
    return rounded


def largest_subshift(
    pieces: Sequence[Range], image: Image, states: Sequence[Range]
) -> Growing | None:
    """Return the subshift of greatest growth found on the states; None if no path goes on.

    The value v_i of a state is the number of long paths from it. An edge goes to the state of
    greatest value that the image contains; values and edges are improved in turn, and the states
    that are not reached from the best one are left out. The growth is exact for the integer v.
    """
    sources, choices = _choices(pieces, image, states)
    if not len(sources):
        return None
    values = np.array([float(high - low) for low, high in states])
    for _ in range(_ROUNDS):
        targets = np.where(choices, values, -1.0).argmax(axis=1)
        image_values = np.bincount(sources, values[targets], len(states))
        if not image_values.max() > 0.0:
            return None
        values = values / values.max() + image_values / image_values.max()
    kept = _reached(int(values.argmax()), sources, targets)
    vector = [round(float(values[i]) / float(values.max()) * _SCALE) for i in kept]
    sums = dict.fromkeys(kept, 0)
    value_of = dict(zip(kept, vector, strict=True))
    for source, target in zip(sources.tolist(), targets.tolist(), strict=True):
        if source in sums:
            sums[source] += value_of[target]
    growth = min(Fraction(sums[i], v) for i, v in value_of.items() if v)
    return Growing(tuple(states[i] for i in kept), tuple(vector), growth)


def _choices(
    pieces: Sequence[Range], image: Image, states: Sequence[Range]
) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Return for each state and piece that has a target: the state, and which states it covers."""
    lows = sorted({low for low, _ in states})
    highs = sorted({high for _, high in states})
    low_ranks = np.array([bisect_left(lows, low) for low, _ in states])
    high_ranks = np.array([bisect_left(highs, high) for _, high in states])
    sources, choices = [], []
    for i, state in enumerate(states):
        for index in range(len(pieces)):
            image_arc = arc(pieces, image, index, state)
            if image_arc is None:
                continue
            inside = (low_ranks >= bisect_left(lows, image_arc[0])) & (
                high_ranks < bisect_right(highs, image_arc[1])
            )
            if inside.any():
                sources.append(i)
                choices.append(inside)
    return np.array(sources, dtype=np.intp), np.array(choices)


def _reached(first: int, sources: NDArray[np.intp], targets: NDArray[np.intp]) -> list[int]:
    """Return the states reached from one, in order."""
    after: dict[int, set[int]] = {}
    for source, target in zip(sources.tolist(), targets.tolist(), strict=True):
        after.setdefault(source, set()).add(target)
    reached, waiting = {first}, [first]
    while waiting:
        new = after.get(waiting.pop(), set()) - reached
        reached |= new
        waiting += new
    return sorted(reached)


# -- from above ------------------------------------------------------------------------------------


def outer_tower(interval: Range, images: Images, depth: int, places: int) -> list[Range]:
    """Return an interval, and what holds the images of its parts, of theirs, and so on.

    They are rounded outward to decimals, but stay in the interval, which contains all images.
    """
    unit, states, fresh = Fraction(1, 10**places), {interval}, {interval}
    for _ in range(depth):
        outer = {
            (max(interval[0], low // unit * unit), min(interval[1], -(-high // unit) * unit))
            for state in fresh
            for low, high in images(state)
        }
        fresh = outer - states
        states |= fresh
    return sorted(states)


def least_ceiling(states: Sequence[Range], images: Images) -> Growing:
    """Return the outer graph of least growth found on states, one of which contains all images.

    From each state an edge leads, for each image, to the state of least value that contains it; see
    `largest_subshift`.
    """
    lows, highs = (np.array([float(x) for x in side]) for side in zip(*states, strict=True))
    sources, choices = [], []
    for i, state in enumerate(states):
        for low, high in images(state):
            sources.append(i)
            choices.append((lows <= float(low)) & (highs >= float(high)))
    contained = np.array(choices)
    values = np.ones(len(states))
    for _ in range(_ROUNDS):
        targets = np.where(contained, values, np.inf).argmin(axis=1)
        sums = np.bincount(sources, values[targets], len(states))
        values = np.maximum(values / values.max() + sums / sums.max(), _LEAST)
    vector = [1 + round(float(value) / float(values.max()) * _SCALE) for value in values]
    totals = [0] * len(states)
    for source, target in zip(sources, targets.tolist(), strict=True):
        totals[source] += vector[target]
    growth = max(Fraction(total, v) for total, v in zip(totals, vector, strict=True))
    return Growing(tuple(states), tuple(vector), growth)
