"""Judges of intervals of a file's own maps of the line, or of a circle, by points of them."""

from itertools import pairwise
from math import prod

import flint
import numpy as np

from tests.oracles import kernel
from tests.oracles.formulas import BITS, exact
from tests.oracles.plastic import graph_faults, points

CLOSE = 1e-9
STEPS = 30


class Line:
    """A map in floats: values on the line, derivatives, and what is the same on a circle."""

    def __init__(self, function):
        self.function = function
        turns = kernel.shift(function, [1] * len(function.circles))
        self.period = float(turns[0]) if function.circles else None

    def at(self, x):
        with flint.ctx.workprec(BITS):
            return float(kernel.values(self.function, [exact(x)])[0])

    def slope(self, x):
        with flint.ctx.workprec(BITS):
            return float(kernel.matrix(self.function, [exact(x)])[0][0])

    def near(self, x, side):
        """x, or what is the same and nearest to the middle of an interval."""
        if self.period is None:
            return x
        middle = float(sum(side)) / 2
        return x - self.period * np.round((x - middle) / self.period)

    def inside(self, x, side, room=CLOSE):
        return float(side[0]) - room <= self.near(x, side) <= float(side[1]) + room

    def over(self, cell, other):
        """Whether a cell is mapped over another one; None if it only meets it."""
        low, high = sorted(self.at(end) for end in cell)
        shifts = [0.0] if self.period is None else [self.period * k for k in range(-5, 6)]
        first, last = map(float, other)
        if any(low <= first + s + CLOSE and last + s - CLOSE <= high for s in shifts):
            return True
        met = any(low < last + s - CLOSE and first + s + CLOSE < high for s in shifts)
        return None if met else False


def slope_range(view, rng):
    """Values at the points, derivatives on the pieces."""
    line, told = Line(view.function), []
    for x, slope, image in zip(view.points, view.slopes, view.images, strict=True):
        if not line.inside(line.at(x), image) or not within(line.slope(x), slope):
            told.append(f"the image of {float(x):.9g}, or the slope there, is another")
    for piece, slope in zip(pairwise(view.points), view.pieces, strict=True):
        if not all(within(line.slope(x), slope) for x in points(piece, rng, 2)):
            told.append(f"a slope on {piece} is not in the bounds")
    return told


def within(x, side, room=1e-6):
    return float(side[0]) - room <= x <= float(side[1]) + room


def avoids(view, rng):
    """No point of the interval is taken into the target."""
    line = Line(view.function)
    hit = [x for x in points(view.source, rng, 20) if line.inside(line.at(x), view.target, -CLOSE)]
    return [f"the image of {float(x):.9g} is in the target" for x in hit]


def staying_set(view, rng):
    """Cells with slopes in bounds, mapped over those that follow; what stays is in them."""
    line, told = Line(view.function), []
    for i, (cell, slope) in enumerate(zip(view.cells, view.slopes, strict=True)):
        if not all(within(line.slope(x), slope) for x in points(cell, rng, 2)):
            told.append(f"a slope on cell {i} is not in the bounds")
        if min(map(abs, slope)) < view.expansion or view.expansion <= 1:
            told.append("the expansion is less than is said")
        for j, other in enumerate(view.cells):
            if line.over(cell, other) not in (None, j in view.onward[i]):
                told.append(f"cell {i} and cell {j} are not as the arrows say")
    told += graph_faults(view)
    for region in view.region:
        for start in points(region, rng, 40):
            orbit = [float(start)]
            for _ in range(STEPS):
                orbit.append(line.at(orbit[-1]))
                if not any(line.inside(orbit[-1], side, 0) for side in view.region):
                    break
            else:
                if not any(line.inside(orbit[0], cell) for cell in view.cells):
                    told.append(f"the orbit of {orbit[0]:.9g} stays, outside of the cells")
    return told


def entropy_bound(view, rng):
    """The growth is at most that of the branches' images; cells are mapped over them all."""
    line, told = Line(view.function), []
    ends = [(one.points[0], one.points[-1]) for one in view.branches]
    meets = np.array([[line.over(a, b) is not False for b in ends] for a in ends], dtype=float)
    if float(view.growth) > max(abs(np.linalg.eigvals(meets))) + CLOSE:
        told.append("a growth that the branches do not allow")
    if not within(np.log(float(view.growth)), view.entropy, CLOSE):
        told.append("an entropy that is not the log of the growth")
    if not all(line.over(a, b) for a in view.cells for b in view.cells):
        told.append("cells that are not mapped over each other")
    return told


def stable_orbit(view, rng):
    """Cells are mapped into the next ones, and the product of slopes is in the bounds."""
    line, told = Line(view.function), []
    for cell, after in zip(view.cells, (*view.cells[1:], view.cells[0]), strict=True):
        if not all(line.inside(line.at(x), after) for x in points(cell, rng, 3)):
            told.append("a cell is not mapped into the next one")
    slopes = [abs(line.slope(sum(cell) / 2)) for cell in view.cells]
    if not within(prod(slopes), view.contraction) or not view.contraction[1] < 1:
        told.append("the multiplier is another")
    return told


def itinerary(view, rng):
    """The orbit, and in which of the sets it is."""
    line, told, x = Line(view.base.function), [], view.orbit[0][0]
    if len(view.cut) != len(view.orbit):
        return ["a word of another length"]
    marks = sorted(end for cell in view.base.cells for end in cell)
    for k, (image, letter) in enumerate(zip(view.orbit, view.cut, strict=True)):
        if not line.inside(float(x), image):
            return [*told, f"the image number {k} is another"]
        spot = sum(float(mark) < line.near(float(x), image) for mark in marks)
        last = k == len(view.cut) - 1
        if spot % 2 == last or spot // 2 != int(letter):
            told.append(f"the point number {k} is elsewhere")
        x = line.at(line.near(float(x), image))
    return told


JUDGES = {
    "SlopeRange": slope_range,
    "Avoids": avoids,
    "StayingSet": staying_set,
    "EntropyBound": entropy_bound,
    "StableOrbit": stable_orbit,
    "Itinerary": itinerary,
}
