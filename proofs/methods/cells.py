"""Cells of a grid that contain every full orbit of a map in a region, its periodic orbits too.

Let R be a region and f a map. A full orbit in R is a sequence of points x_k of R, k in Z, with
x_(k+1) = f(x_k): for example a periodic orbit.

Theorem. Let finitely many closed cells contain all points of full orbits in R. They still do when
a cell c goes that (1) is proved to miss R, or (2) has an enclosure of f(c) that meets no cell, or
(3) meets no enclosure of an f(c'), c' any of the cells; and when cells are split.

Proof. Let x_k be in c. (1) It is in R. (2) x_(k+1) is in the enclosure of f(c), and in a cell.
(3) x_(k-1) is in a cell c', so x_k is in the enclosure of f(c'), and in c.

f is a formula; where its jet has no enclosure on a cell c (DomainError), f(c) may be anything.
Source: the subdivision algorithm of Dellnitz and Hohmann, Numer. Math. 75 (1997), with the graph
reductions of Galias, Int. J. Bifurcation Chaos 11 (2001).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import Interval, IntervalArray
from intervals.array import Mask
from intervals.branch import Boxes, all_of, evaluated, one_box, select
from intervals.generic import meet, middle
from intervals.systems import Function, components, dot, jacobian
from proofs.methods.formulas import Intervals
from proofs.trusted.kernel.formulas import Formulas

Indices = NDArray[np.int64]
Floats = NDArray[np.float64]

_MOST_ARROWS = 4_000_000


def function_of(formula: Formulas) -> Function:
    """Return a formula of the checker as a function of intervals, arrays of these, and jets."""
    numbers: Any = Intervals()
    return lambda *x: formula.tape.evaluate(formula.roots, numbers, x)


@dataclass(frozen=True)
class Region:
    """The points of a box where g >= 0 in each component, all of them without g.

    The sides of the box have binary64 ends, as Interval("-1.3", "1.3") has; f and g take
    IntervalArrays and jets of them and return a list.
    """

    box: tuple[Interval, ...]
    g: Function | None = None

    @classmethod
    def convex(cls, corners: Sequence[tuple[Fraction | str, Fraction | str]]) -> Region:
        """Return a convex polygon in the plane, its corners anticlockwise.

        It is where (b - a) x (p - a) >= 0 for each side from a to b.
        """
        points = [(Fraction(x), Fraction(y)) for x, y in corners]
        sides = list(zip(points, points[1:] + points[:1], strict=True))

        def g(x: Any, y: Any) -> list[Any]:
            return [(y - a[1]) * (b[0] - a[0]) - (x - a[0]) * (b[1] - a[1]) for a, b in sides]

        return cls(tuple(Interval(min(p), max(p)) for p in zip(*points, strict=True)), g)

    def contains(self, boxes: Boxes) -> Mask:
        """Which boxes are proved to lie in the region."""
        inside = [x.subset(side) for x, side in zip(boxes, self.box, strict=True)]
        return all_of([*inside, *(v.inf >= 0 for v in self._values(boxes))])

    def misses(self, boxes: Boxes) -> Mask:
        """Which boxes are proved to have no point in it."""
        meets = [~x.disjoint(side) for x, side in zip(boxes, self.box, strict=True)]
        return ~all_of([*meets, *(v.sup >= 0 for v in self._values(boxes))])

    def _values(self, boxes: Boxes) -> list[IntervalArray]:
        return components(self.g(*boxes)) if self.g else []


@dataclass(frozen=True)
class Cover:
    """Cells that contain every full orbit of f in the region."""

    f: Function
    region: Region
    cells: Boxes


@dataclass(frozen=True)
class _Grid:
    """Cells of the grid of 2^depth parts of each side of a box, by their numbers, sorted.

    The ends of the parts are floats that increase from one end of the side to the other.
    """

    box: Boxes
    depth: int
    numbers: Indices

    @cached_property
    def ends(self) -> list[Floats]:
        """The ends of the parts of each side."""
        share = np.arange(2**self.depth + 1) * 0.5**self.depth
        result = []
        for side in self.box:
            low, high = float(side.inf[0]), float(side.sup[0])
            cuts = np.maximum.accumulate(np.clip(low + (high - low) * share, low, high))
            result.append(np.concatenate(([low], cuts[1:-1], [high])))
        return result

    @cached_property
    def places(self) -> list[Indices]:
        """For each axis the parts in which the cells lie."""
        n, mask = len(self.box), 2**self.depth - 1
        return [(self.numbers >> (self.depth * (n - 1 - i))) & mask for i in range(n)]

    @property
    def cells(self) -> Boxes:
        """The cells as boxes."""
        pairs = zip(self.ends, self.places, strict=True)
        return tuple(IntervalArray.from_floats(e[i], e[i + 1]) for e, i in pairs)

    def only(self, kept: Mask) -> _Grid:
        """Return some of the cells."""
        return _Grid(self.box, self.depth, self.numbers[kept])

    def split(self) -> _Grid:
        """Return the cells of the next depth in these."""
        depth, parts = self.depth + 1, []
        for shift in product((0, 1), repeat=len(self.box)):
            number = np.zeros_like(self.numbers)
            for place, bit in zip(self.places, shift, strict=True):
                number = (number << depth) + 2 * place + bit
            parts.append(number)
        return _Grid(self.box, depth, np.sort(np.concatenate(parts)))

    def met_by(self, images: Boxes) -> tuple[Indices, Indices] | None:
        """Return pairs (i, j): images[i] meets the j-th cell; None where there are too many."""
        ranges = [_parts(ends, x) for ends, x in zip(self.ends, images, strict=True)]
        counts = [np.maximum(last - first + 1, 0) for first, last in ranges]
        total = np.prod(np.stack(counts).astype(float), axis=0)
        if total.sum() > _MOST_ARROWS:
            return None
        size = total.astype(np.int64)
        source = np.repeat(np.arange(len(size)), size)
        offset = np.arange(len(source)) - np.repeat(np.cumsum(size) - size, size)
        number = np.zeros(len(source), dtype=np.int64)
        for axis in reversed(range(len(images))):
            place = ranges[axis][0][source] + offset % counts[axis][source]
            number += place << (self.depth * (len(images) - 1 - axis))
            offset //= counts[axis][source]
        target = np.minimum(np.searchsorted(self.numbers, number), len(self.numbers) - 1)
        hit = self.numbers[target] == number
        return source[hit], target[hit]


class _Images(NamedTuple):
    """The cells with an enclosure of their image, by their places, and the enclosures."""

    known: Mask
    boxes: Boxes


def invariant_cover(
    f: Function,
    region: Region,
    *,
    depth: int = 10,
    most: int = 100_000,
    tell: Callable[[str], None] = lambda stage: None,
) -> Cover:
    """Return cells of side 2^-depth of the region's box that contain all full orbits in it.

    Cells stay larger where the next grid has more than `most` to look at, or too many arrows
    between them. No cell: no full orbit.
    """
    start = one_box(region.box)
    if depth * len(start) > 60:
        raise ValueError("at most 2^60 cells")
    grid = _Grid(start, 0, np.zeros(1, dtype=np.int64))
    while True:
        grid = grid.only(~region.misses(grid.cells))
        reduced = _reduced(f, grid)
        if reduced is not None:
            grid = reduced
            tell(f"{len(grid.numbers)} cells, each side divided by {2**grid.depth}")
        finer = len(grid.numbers) * 2 ** len(start)
        if reduced is None or grid.depth == depth or not 0 < finer <= most:
            return Cover(f, region, grid.cells)
        grid = grid.split()


def _reduced(f: Function, grid: _Grid) -> _Grid | None:
    """Do (2) and (3) until all cells stay; None where the arrows are too many."""
    if not len(grid.numbers):
        return grid
    images = _images(f, grid.cells)
    arrows = grid.met_by(images.boxes)
    if arrows is None:
        return None
    source, target = np.flatnonzero(images.known)[arrows[0]], arrows[1]
    kept = np.ones(len(grid.numbers), dtype=bool)
    while True:
        leads, reached = ~images.known, np.zeros_like(kept)
        leads[source] = True
        reached[target] = True
        stays = kept & leads & (reached | (kept & ~images.known).any())
        if (stays == kept).all():
            return grid.only(kept)
        kept = stays
        live = kept[source] & kept[target]
        source, target = source[live], target[live]


def _images(f: Function, cells: Boxes) -> _Images:
    known = np.ones(len(cells[0]), dtype=bool)
    found = [select(cells, slice(0))]
    for part, image in evaluated(lambda boxes: _image(f, boxes), cells):
        known[part] = image is not None
        found += [] if image is None else [image]
    joined = [IntervalArray.concatenate(sides) for sides in zip(*found, strict=True)]
    return _Images(known, tuple(joined))


def _image(f: Function, boxes: Boxes) -> Boxes:
    """Enclose f over boxes by its natural and its mean value form."""
    values, slopes = jacobian(f, boxes)
    points = [middle(x) for x in boxes]
    steps = [x - m for x, m in zip(boxes, points, strict=True)]
    rows = zip(values, components(f(*points)), slopes, strict=True)
    return tuple(meet(value, centre + dot(row, steps)) for value, centre, row in rows)


def _parts(ends: Floats, x: IntervalArray) -> tuple[Indices, Indices]:
    """Return the first and the last part of a side that x meets; first > last: none."""
    first = np.searchsorted(ends[1:], x.inf, side="left")
    last = np.searchsorted(ends[:-1], x.sup, side="right") - 1
    return first.astype(np.int64), last.astype(np.int64)
