"""Candidates of sets that a map stretches across each other, in floating point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise, product

import numpy as np

from intervals import Undecided
from proofs.methods.newton import along_orbit, distance, whole_periods
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.numbers import Range

_STEPS, _NEAR = 12, 1e-9  # of Newton's method
_SPARE = 1.15  # what an image exceeds, linearly, of what it has to
_LEAST = 1e-6  # the smallest side of an h-set
_GRID, _LEVELS = 4001, 61  # of a graph that is sampled
_SAMPLES = 9  # of an h-set, along each side


@dataclass(frozen=True)
class Frames:
    """Candidates of h-sets: centres, and matrices whose first columns are unstable; arrows."""

    centres: Floats
    matrices: Floats
    arrows: tuple[tuple[int, int], ...]


def frames(sampled: Sampled, symbols: Sequence[Floats], length: int) -> Frames:
    """Return h-sets for all words of a length over some saddle points, and the arrows of the shift.

    The centre for a word is a point of the periodic orbit that repeats it. The sides are the least
    for which, linearly, the image of each set crosses all sets that follow. Raises Undecided where
    there are none.
    """
    words = list(product(range(len(symbols)), repeat=length))
    place, centres, matrices = (length - 1) // 2, [], []
    orbits: dict[tuple[int, ...], Floats] = {}  # by the first of the words that they repeat
    for word in words:
        rotations = [word[k:] + word[:k] for k in range(length)]
        first = min(rotations)
        if first not in orbits:
            orbits[first] = _shadow(sampled, symbols, first)
        points = np.roll(orbits[first], rotations.index(first) - place, axis=0)
        centres.append(points[0])
        matrices.append(_directions(along_orbit(sampled, points)))
    arrows = tuple(
        (i, j) for i, a in enumerate(words) for j, b in enumerate(words) if a[1:] == b[:-1]
    )
    places = np.array(centres) - whole_periods(sampled, np.array(centres) - centres[0])
    sides = _sides(sampled, places, np.array(matrices), arrows)
    return Frames(places, np.array(matrices) * sides[:, None, :], arrows)


def _shadow(sampled: Sampled, symbols: Sequence[Floats], word: Sequence[int]) -> Floats:
    """Return the periodic orbit whose points are next to the symbols of a word, one by one.

    Newton's method for all of it may lead to a rotation.
    """
    x = np.array([symbols[k] for k in word])
    count, n = x.shape
    for _ in range(30):
        images, derivatives = sampled.expanded(x.T)
        missed = images - np.roll(x, -1, axis=0)
        defect = (missed - whole_periods(sampled, missed)).ravel()
        matrix = np.zeros((n * count, n * count))
        for i in range(count):
            j = (i + 1) % count
            rows = slice(i * n, (i + 1) * n)
            matrix[rows, rows] += derivatives[i]
            matrix[rows, j * n : (j + 1) * n] -= np.eye(n)
        if not (np.isfinite(defect).all() and np.isfinite(matrix).all()):
            break
        step = np.linalg.lstsq(matrix, -defect, rcond=None)[0].reshape(count, n)
        x = x + step
        if np.abs(step).max() < _NEAR:
            nearest = [np.argmin([distance(sampled, p, symbol) for symbol in symbols]) for p in x]
            for k in range(count):
                if (*nearest[k:], *nearest[:k]) == tuple(word):
                    return np.roll(x, -k, axis=0)
            break
    raise Undecided("no periodic orbit follows this word")


def _directions(matrix: Floats) -> Floats:
    """Return eigenvectors as columns, that of the largest eigenvalue first."""
    values, vectors = np.linalg.eig(matrix)
    order = np.argsort(-np.abs(values))
    if np.iscomplex(values).any() or not abs(values[order[0]]) > 1:
        raise Undecided("no unstable direction")
    real = np.real(vectors[:, order])
    return np.asarray(real / np.abs(real).max(axis=0) * np.where(real[0] < 0, -1, 1))


def _sides(
    sampled: Sampled, centres: Floats, matrices: Floats, arrows: Sequence[tuple[int, int]]
) -> Floats:
    """Return the least sides, by iteration from small ones; they grow."""
    images, derivatives = sampled.expanded(centres.T)
    drift = np.zeros_like(images)  # with the parameters, to first order
    for ends in sampled.varied():
        drift += np.maximum(*(np.abs(end(centres.T).T - images) for end in ends))
    linear = []
    for i, j in arrows:
        back, apart = np.linalg.inv(matrices[j]), images[i] - centres[j]
        apart = apart - whole_periods(sampled, apart)
        linear.append(
            (
                i,
                j,
                np.abs(back @ apart) + np.abs(back) @ drift[i],
                back @ derivatives[i] @ matrices[i],
            )
        )
    sides = np.full(centres.shape, _LEAST)
    for _ in range(200):
        grown = sides.copy()
        for i, j, offset, matrix in linear:
            size = np.abs(matrix)
            spread = size @ (sides[i] * np.r_[0, np.ones(len(offset) - 1)])
            need = _SPARE * (sides[j][0] + offset[0]) + spread[0]
            grown[i, 0] = max(grown[i, 0], need / max(size[0, 0], 1e-12))
            reach = _SPARE * (offset + size @ sides[i])
            grown[j, 1:] = np.maximum(grown[j, 1:], reach[1:])
        if (grown <= sides * (1 + 1e-6)).all():
            return grown
        if grown.max() > 1e3:
            break
        sides = grown
    raise Undecided("the sides of the sets grow without end")


def widened(candidates: Frames) -> Frames:
    """Return the sets, each stable side the geometric mean of what it was and of the unstable one.

    Where the map contracts much, the least sides are so thin that images would have to be enclosed
    much more tightly than they cross.
    """
    sizes = np.abs(candidates.matrices).max(axis=1, keepdims=True)
    factors = np.sqrt(np.maximum(sizes[:, :, :1] / sizes, 1))
    return replace(candidates, matrices=candidates.matrices * factors)


@np.errstate(all="ignore")
def laps(sampled: Sampled, side: Range) -> Frames:
    """Return two intervals that a map of the line takes across both, as steeply as is seen.

    The sides of monotone pieces of a sampled graph between two levels are tried for all pairs of
    levels. Raises Undecided where no two pieces cross any.
    """
    low, high = map(float, side)
    low, high = low - (high - low) / 20, high + (high - low) / 20  # what maps onto all of the side
    x = np.linspace(low, high, _GRID)
    y = sampled(x[None, :])[0]
    rises = np.sign(np.diff(y))
    turns = [0, *(np.flatnonzero(rises[1:] != rises[:-1]) + 1), len(x) - 1]
    pieces = [slice(a, b + 1) for a, b in pairwise(turns) if b - a > 2]
    best, sides = 0.0, None
    for bottom, top in combinations(np.linspace(low, high, _LEVELS), 2):
        sets = []
        for piece in pieces:
            order = slice(None) if y[piece][0] < y[piece][-1] else slice(None, None, -1)
            xs, ys = x[piece][order], y[piece][order]
            room = (top - bottom) / 100
            if ys[0] < bottom - room and ys[-1] > top + room:
                ends = sorted(np.interp([bottom - room, top + room], ys, xs))
                if bottom < ends[0] and ends[1] < top:
                    sets.append((ends[0], ends[1]))
        if len(sets) < 2:
            continue
        steepness = [np.abs(np.gradient(y, x)[(x >= a) & (x <= b)]).min(initial=9) for a, b in sets]
        chosen = sorted(np.argsort(steepness)[-2:])
        if min(steepness[k] for k in chosen) > best:
            best, sides = min(steepness[k] for k in chosen), [sets[k] for k in chosen]
    if sides is None:
        raise Undecided("no two monotone pieces cross an interval")
    low_ends, high_ends = np.array(sides).T
    arrows = tuple((i, j) for i in range(2) for j in range(2))
    middle, radius = (low_ends + high_ends) / 2, (high_ends - low_ends) / 2
    return Frames(middle[:, None], radius[:, None, None], arrows)


def crossing(sampled: Sampled, candidates: Frames) -> float:
    """Return by how much a sample of points crosses, linearly; Undecided where it does not."""
    _require_apart(sampled, candidates)
    n = candidates.centres.shape[1]
    q, margin = np.array(list(product(np.linspace(-1, 1, _SAMPLES), repeat=n))).T, np.inf
    for i, centre in enumerate(candidates.centres):
        image = sampled(centre[:, None] + candidates.matrices[i] @ q)
        for _, j in (arrow for arrow in candidates.arrows if arrow[0] == i):
            apart = image - candidates.centres[j][:, None]
            middle = apart[:, apart.shape[1] // 2]
            there = np.linalg.inv(candidates.matrices[j]) @ (
                apart - whole_periods(sampled, middle)[:, None]
            )
            faces, size = np.abs(q[0]) == 1, np.abs(there)
            ends = there[0, faces] * q[0, faces]
            clear = np.maximum(size[0] - 1, 1 - size[1:].max(axis=0, initial=0))
            margin = min(margin, float(np.abs(ends).min() - 1), float(clear.min()))
            if not (margin > 0 and len({*np.sign(ends)}) == 1):
                raise Undecided("the image of a set does not cross another one")
    return margin


def _require_apart(sampled: Sampled, candidates: Frames) -> None:
    """Raise Undecided where two sets meet: no normal of a face separates them."""
    inverses = np.linalg.inv(candidates.matrices)
    for i, j in combinations(range(len(candidates.centres)), 2):
        apart = candidates.centres[i] - candidates.centres[j]
        normals = np.concatenate(inverses[[i, j]])
        reach = sum(np.abs(normals @ candidates.matrices[k]).sum(axis=1) for k in (i, j))
        if not (np.abs(normals @ (apart - whole_periods(sampled, apart))) > reach).any():
            raise Undecided("two sets meet")
