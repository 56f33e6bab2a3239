"""Parallelograms around the cycles of a map of the plane, for covering relations and entropy.

These are candidates, in floating point; what is proved about them is what the rules `covers`,
`graph` and `entropy` derive. Of the cycles those are used along which the stable and the unstable
direction keep an angle: they stay away from the tangencies, where nothing is covered. The side of
the tangencies on which a point lies, which is the sign of that angle where both directions have a
positive first coordinate, is its symbol. Points whose last `past` and next `future` symbols agree
are surrounded by one parallelogram, along the mean directions; an arrow leads from one to another
if some cycle does. Then the sides grow until the image of each set crosses all sets that its arrows
lead to: the unstable side back from their ends, the stable side forward. Sets that meet others go.

Source: Galias, Int. J. Bifurcation Chaos 11 (2001) for entropy by covering relations of sets along
the two directions; Day, Frongillo and Trevino, SIAM J. Appl. Dyn. Syst. 7 (2008), 0.4320 for
Henon's map; Grassberger and Kantz, Phys. Lett. A 113 (1985) for symbols by tangencies.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import Undecided
from proofs.methods.newton import Cycle
from proofs.methods.sampling import Sampled
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.kernel.arithmetic import Unproved

Floats = NDArray[np.floating[Any]]
Indices = NDArray[np.intp]

_ROUNDS = 3  # along a cycle, until the directions are found
_GROWTHS = 100
_SETTLED = 1e-4  # of a side
_NEWTON_STEPS = 8
_POINT, _MOST = 1e-9, 2.0  # sides around a single point, and the longest: parts of the whole
_SAMPLES = 15
_LONGEST = 60  # paths, whose number bounds the entropy


class Rectangles(NamedTuple):
    """The sets c + A q, q in [-1, 1]^2, their first column unstable, and arrows (i, j)."""

    centres: Floats
    matrices: Floats
    arrows: Indices


class _Points(NamedTuple):
    """Points of cycles, their unstable and stable direction as columns, their word and the next."""

    places: Floats
    frames: Floats
    words: Indices
    following: Indices


def rectangles(
    sampled: Sampled,
    cycles: Sequence[Cycle],
    *,
    angle: float,
    past: int,
    future: int,
    spare: float = 0.02,
) -> Rectangles:
    """Return sets for all words of cycles that keep an angle with this sine.

    An image exceeds what it crosses by `spare` of its size. Raises Undecided where the sides grow
    without end: for a larger angle or longer words they may not.
    """
    points = _points(sampled, cycles, angle, past + future, past)
    names, word = np.unique(points.words, return_inverse=True)
    if len(names) < 2:
        raise Undecided("no two words belong to cycles that keep such an angle")
    arrows = np.unique(np.stack([word, np.searchsorted(names, points.following)], 1), axis=0)
    counts = np.bincount(word)[:, np.newaxis]
    centres, frames = np.zeros((len(names), 2)), np.zeros((len(names), 2, 2))
    np.add.at(centres, word, points.places)
    np.add.at(frames, word, points.frames)
    centres, frames = centres / counts, frames / counts[..., np.newaxis]
    local = _solve(frames[word], points.places - centres[word])
    low, high = np.full((2, len(names), 2), np.inf)
    np.minimum.at(low, word, local)
    np.minimum.at(high, word, -local)
    size = np.ptp(points.places, axis=0).max()
    least, most = low - _POINT * size, _POINT * size - high
    low, high = _grown(
        _Arrows(sampled, centres, frames, *arrows.T), least, most, spare, _MOST * size
    )
    centres = centres + _times(frames, (low + high) / 2)
    matrices = frames * ((high - low) / 2)[:, np.newaxis]
    return Rectangles(centres, matrices, _disjoint(centres, matrices, arrows))


def lemma(file: SymbolicLemmas, function: str, sets: Rectangles, digits: int = 9) -> str:
    """Prove the covering relations, with coordinates of so many decimals, and add the entropy.

    Arrows for which a relation is not proved are left out; Undecided if no closed path is left.
    """

    def exact(value: float) -> Fraction:
        return Fraction(round(value * 10**digits), 10**digits)

    names = {
        i: file.h_set(
            [exact(x) for x in sets.centres[i].tolist()],
            [[exact(x) for x in row] for row in sets.matrices[i].tolist()],
        )
        for i in np.unique(sets.arrows).tolist()
    }
    proved = {}
    for i, j in sets.arrows.tolist():
        try:
            proved[i, j] = file.covers(function, 1, names[i], names[j])
        except (Undecided, Unproved):
            continue
    kept = _recurrent(np.array(list(proved)).reshape(-1, 2))
    if not len(kept):
        raise Undecided("no closed path of covering relations is proved")
    relations = [proved.pop((i, j)) for i, j in kept.tolist()]
    unused = [name for i, name in names.items() if i not in kept]
    file.forget({*proved.values(), *unused})
    return file.entropy(file.graph(relations), _LONGEST)


# -- words -----------------------------------------------------------------------------------------


def _points(
    sampled: Sampled, cycles: Sequence[Cycle], angle: float, length: int, past: int
) -> _Points:
    """Return the points of all cycles that keep the angle, with words of so many symbols."""
    parts = []
    for _, group in groupby(cycles, lambda cycle: len(cycle.points)):
        orbits = np.stack([cycle.points for cycle in group])
        slopes = sampled.expanded(orbits.reshape(-1, 2).T)[1].reshape(*orbits.shape, 2)
        back = _directions(np.linalg.inv(slopes)[:, ::-1])
        frames = np.stack([_directions(slopes), np.roll(back[:, ::-1], 1, axis=1)], -1)
        sines = np.linalg.det(frames)
        kept = np.abs(sines).min(axis=1) > angle
        symbols = (sines[kept] > 0).astype(np.int64)
        words = sum((np.roll(symbols, past - k, axis=1) << k for k in range(length)), 0 * symbols)
        after = np.roll(words, -1, axis=1)
        places, frames = orbits[kept].reshape(-1, 2), frames[kept].reshape(-1, 2, 2)
        parts.append(_Points(places, frames, words.ravel(), after.ravel()))
    return _Points(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _directions(slopes: Floats) -> Floats:
    """Return the directions that products of matrices along cycles turn to."""
    directions: Floats = np.empty(slopes.shape[:3])
    direction: Floats = np.ones((len(slopes), 2))
    for i in list(range(slopes.shape[1])) * _ROUNDS:
        directions[:, i] = direction
        direction = _times(slopes[:, i], direction)
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return directions * np.where(directions[..., :1] < 0, -1.0, 1.0)


# -- sides -----------------------------------------------------------------------------------------


class _Arrows(NamedTuple):
    """A map from the coordinates of the i-th set to those of the j-th, for each arrow."""

    map: Sampled
    centres: Floats
    frames: Floats
    i: Indices
    j: Indices

    def image(self, q: Floats) -> tuple[Floats, Floats]:
        """Return about the images of points, (arrows, n, 2), and the slopes of u' by u there."""
        frames = self.frames[self.i][:, np.newaxis]
        points = self.centres[self.i][:, np.newaxis] + _times(frames, q)
        values, slopes = self.map.expanded(points.reshape(-1, 2).T)
        inverse = np.linalg.inv(self.frames[self.j])[:, np.newaxis]
        ends = values.reshape(q.shape) - self.centres[self.j][:, np.newaxis]
        along = inverse @ slopes.reshape(*q.shape, 2) @ frames
        return _times(inverse, ends), along[..., 0, 0]

    def preimage(self, u: Floats, s: Floats) -> Floats:
        """Return about the u, (arrows, n), from which f comes to the given u."""
        q = np.stack([np.zeros_like(s), s], -1)
        for _ in range(_NEWTON_STEPS):
            images, slopes = self.image(q)
            q[..., 0] -= np.clip((images[..., 0] - u) / slopes, -0.3, 0.3)
        return np.asarray(q[..., 0])


def _grown(
    arrows: _Arrows, low: Floats, high: Floats, spare: float, longest: float
) -> tuple[Floats, Floats]:
    """Return sides such that each arrow is a crossing, around the given ones."""
    i, j, least, most = arrows.i, arrows.j, low, high
    levels, share = np.array([0.0, 0.5, 1.0]), np.linspace(0.0, 1.0, _SAMPLES)
    for _ in range(_GROWTHS):
        before, width = (low, high), high - low
        ends = np.stack([low[j, 0] - spare * width[j, 0], high[j, 0] + spare * width[j, 0]], 1)
        s = low[i, 1, np.newaxis] + width[i, 1, np.newaxis] * levels
        starts = arrows.preimage(np.repeat(ends, 3, axis=1), np.tile(s, 2))
        first, last = starts.min(axis=1), starts.max(axis=1)
        u = first[:, np.newaxis] + (last - first)[:, np.newaxis] * share
        sides = [np.stack(np.broadcast_arrays(u, side[i, 1, np.newaxis]), -1) for side in before]
        images = arrows.image(np.concatenate(sides, axis=1))[0][..., 1]
        bottom, top = images.min(axis=1), images.max(axis=1)
        room = spare * width[j, 1]
        low, high = least.copy(), most.copy()
        np.minimum.at(low[:, 0], i, first)
        np.maximum.at(high[:, 0], i, last)
        np.minimum.at(low[:, 1], j, bottom - room)
        np.maximum.at(high[:, 1], j, top + room)
        moved = np.abs(low - before[0]) + np.abs(high - before[1])
        if not (moved < longest).all():
            break
        if (moved <= _SETTLED * (high - low)).all():
            return low, high
    raise Undecided("the sides of the sets grow without end")


def _disjoint(centres: Floats, matrices: Floats, arrows: Indices) -> Indices:
    """Return the arrows that are left when sets that meet others have gone."""
    normals = np.linalg.inv(matrices)
    meets = np.ones((len(centres), len(centres)), dtype=bool)
    for n in (normals[:, 0], normals[:, 1]):
        gaps = np.abs(n @ centres.T - (n * centres).sum(1)[:, np.newaxis])
        reach = np.abs(np.einsum("ik,nkc->inc", n, matrices)).sum(2)
        apart = gaps > reach + np.diag(reach)[:, np.newaxis]
        meets &= ~(apart | apart.T)
    np.fill_diagonal(meets, False)
    while meets.any():
        worst = meets.sum(axis=1).argmax()
        meets[worst], meets[:, worst] = False, False
        arrows = arrows[(arrows != worst).all(axis=1)]
    return _recurrent(arrows)


def _recurrent(arrows: Indices) -> Indices:
    """Return the arrows without those that begin or end at a dead end."""
    while True:
        onward = np.isin(arrows[:, 1], arrows[:, 0]) & np.isin(arrows[:, 0], arrows[:, 1])
        if onward.all():
            return arrows
        arrows = arrows[onward]


def _times(matrices: Floats, vectors: Floats) -> Floats:
    return np.asarray((matrices @ vectors[..., np.newaxis])[..., 0])


def _solve(matrices: Floats, vectors: Floats) -> Floats:
    return np.linalg.solve(matrices, vectors[..., np.newaxis])[..., 0]
