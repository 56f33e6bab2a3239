"""Judges of images, horseshoes, barred words and stable cycles of a file's own maps of the plane.

They try points; the map comes from the texts of its formulas alone. What floats cannot tell apart
is let pass.
"""

from fractions import Fraction
from itertools import product

import flint

from tests.oracles import kernel
from tests.oracles.formulas import BITS, exact
from tests.oracles.plastic import between

CLOSE = 1e-9


def is_of_a_file(view):
    """Whether a conclusion is about a function of its file, not about the oscillator."""
    return hasattr(view, "function") and not hasattr(view, "nu")


def inside(point, box, room=CLOSE):
    return all(
        float(low) - room <= float(x) <= float(high) + room
        for x, (low, high) in zip(point, box, strict=True)
    )


def places(box, rng, count=6):
    """Corners of a box and points of it."""
    for k in range(count):
        shares = [Fraction(rng.choice((0, 1))) if k < 3 else Fraction(rng.random()) for _ in box]
        yield [exact(between(side, share)) for side, share in zip(box, shares, strict=True)]


def moved(view, point, turns=()):
    """The image of a point, less so many periods of the angles."""
    image = kernel.values(view.function, point)
    if not turns:
        return image
    return [x - y for x, y in zip(image, kernel.shift(view.function, turns), strict=True)]


def faults(view, rng, region, image, matrix=None):
    """Points of a region go into an image, the derivatives there into a matrix, if there is one."""
    told = []
    with flint.ctx.workprec(BITS):
        for point in places(region, rng):
            if not inside(moved(view, point, view.turns), image):
                told.append(f"the image of {[float(x) for x in point]} is not in the values")
            entries = kernel.matrix(view.function, point) if matrix else ()
            if not all(inside(*pair, 1e-6) for pair in zip(entries, matrix or (), strict=True)):
                told.append(f"the derivative at {[float(x) for x in point]} is not in the matrix")
    return told


def horseshoe(view, rng):
    """Edges go beyond the sets that are next, by the margin, images between them inside in y."""
    told = [] if view.margin > 0 and view.rates[1] < 1 < view.rates[0] else ["no margin, no rates"]
    with flint.ctx.workprec(BITS):
        for index, ((low, high), side) in enumerate(view.boxes):
            targets = [view.boxes[j] for j in view.arrows[index]]
            ends = [
                float(moved(view, point)[0])
                for end in (low, high)
                for point in places(((end, end), side), rng, 3)
            ]
            left, right = sorted((ends[:3], ends[3:]))
            least = float(min(box[0][0] for box in targets) - view.margin)
            greatest = float(max(box[0][1] for box in targets) + view.margin)
            if max(left) > least + CLOSE or min(right) < greatest - CLOSE:
                told.append(f"the edges of V{index + 1} are not mapped beyond the next sets")
            for point in places(view.boxes[index], rng, 12):
                x, y = map(float, moved(view, point))
                for (a, b), (c, d) in targets:
                    if a + CLOSE < x < b - CLOSE and not c < y < d:
                        told.append(f"an image in x of a next set has y = {y:.6g}")
    return told


def barred_word(view, rng):
    """No orbit that is tried follows the word."""
    with flint.ctx.workprec(BITS):
        for point in places(view.boxes[view.word[0]], rng, 40):
            orbit = [point]
            for symbol in view.word[1:]:
                orbit.append(moved(view, orbit[-1]))
                if not inside(orbit[-1], view.boxes[symbol], -CLOSE):
                    break
            else:
                return [f"an orbit follows the word {view.word}"]
    return []


def stable_cycle(view, rng):
    """Points of the first box come around, and come close to each other in the end."""
    told, last, period = [], [], len(view.boxes)
    with flint.ctx.workprec(BITS):
        for point in places(view.boxes[0], rng, 4):
            orbit = [point]
            while len(orbit) < 100 * period + 1:
                orbit.append([exact(float(x)) for x in moved(view, orbit[-1])])
            late, boxes = orbit[-1 - period :], [*view.boxes, view.boxes[0]]  # comes around
            if not all(inside(x, box) for x, box in zip(late, boxes, strict=True)):
                told.append("an orbit from the first box does not end in the boxes")
            last.append([float(x) for x in late[0]])
    apart = max(
        abs(a - b) for one, two in product(last, repeat=2) for a, b in zip(one, two, strict=True)
    )
    return told if apart < 1e-6 else [*told, "two orbits from the first box stay apart"]
