"""Judges of conclusions about the plastic map: points, slopes, branches, staying sets."""

from fractions import Fraction
from itertools import pairwise
from types import SimpleNamespace

import flint
import numpy as np

from tests.oracles.motion import (
    LATEST,
    PRECISION,
    TURN,
    Impact,
    ball,
    flight,
    inside,
    inside_mod,
    next_impact,
    two_pi,
)


def between(bounds, share):
    """A point of an interval."""
    return bounds[0] + (bounds[1] - bounds[0]) * share


def points(bounds, rng, count=3):
    """The ends and the middle of an interval, and random points of it, in order."""
    shares = [Fraction(rng.randint(0, 1 << 20), 1 << 20) for _ in range(count)]
    return sorted({between(bounds, share) for share in (0, Fraction(1, 2), 1, *shares)})


def _impact(view, phase, latest=LATEST):
    return flight(view.eta, view.nu, phase, latest=latest)


def point(view, rng):
    """f' and f at a phase, mod 2 pi."""
    return _at_point(view, view.phase, view.slope, view.image)


def _at_point(view, phase, slope, image):
    found = _impact(view, phase)
    if found is None:
        return []
    if isinstance(found, str):
        return [f"the launch at {float(phase):.9g}: {found}"]
    told = []
    if not inside(found.slope, slope):
        told.append(f"f'({float(phase):.12g}) is {found.slope.str(15)}")
    if not inside_mod(found.lifted, image):
        told.append(f"f({float(phase):.12g}) is {found.phase:.15g}")
    return told


def at_phases(view, rng):
    """f on an interval of phases, or at one: f', and f less so many turns."""
    (phases,), (values,), ((slope,),), told = view.region, view.values, view.matrix, []
    for phase in points(phases, rng, 2):
        found = _impact(view, phase)
        if isinstance(found, Impact):
            moved = found.lifted - two_pi() * view.turns[0]
            told += [] if inside(moved, values) else [f"f({float(phase):.12g}) is {moved.str(15)}"]
            ok = inside(found.slope, slope)
            told += [] if ok else [f"f'({float(phase):.12g}) is {found.slope.str(15)}"]
        elif found:
            told.append(f"the launch at {float(phase):.9g}: {found}")
    return told


def slope_range(view, rng):
    """f is C^1 from the first point to the last, f' in the bounds of the pieces."""
    count = len(view.points)
    if not count == len(view.slopes) == len(view.images) == len(view.pieces) + 1 >= 2:
        return ["the lengths do not fit"]
    if any(b <= a for a, b in zip(view.points, view.points[1:], strict=False)):
        return ["the points do not increase"]
    told, chosen = [], {0, count - 2, *(rng.randrange(count - 1) for _ in range(3))}
    for k in sorted(chosen):
        for end in (k, k + 1):
            told += _at_point(view, view.points[end], view.slopes[end], view.images[end])
        told += smooth(view, (view.points[k], view.points[k + 1]), view.pieces[k], rng)
    return told


def smooth(view, phases, bounds, rng, count=2):
    """f is C^1 on an interval of phases, with f' in bounds."""
    told, before = [], None
    for phase in points(phases, rng, count):
        found = _impact(view, phase)
        if not isinstance(found, Impact):
            told += [f"the launch at {float(phase):.9g}: {found}"] if found else []
            before = None
            continue
        if not inside(found.slope, bounds):
            told.append(f"f'({float(phase):.12g}) is {found.slope.str(15)}")
        told += _jump(view, before, (phase, found.lifted), bounds)
        before = phase, found.lifted
    return told


def _jump(view, before, now, bounds):
    """What the mean value theorem forbids between two phases."""
    if before is None or before[0] == now[0]:
        return []
    ratio = (now[1] - before[1]) / ball(now[0] - before[0])
    if inside(ratio, bounds, 1e-9):
        return []
    return [f"f jumps, or is steeper, between {float(before[0]):.9g} and {float(now[0]):.9g}"]


def lifted(view, phase, latest=LATEST):
    """The phase of the first impact on the line, as a float; None where there is none."""
    found = _impact(view, phase, latest)
    return float(found.lifted) if isinstance(found, Impact) else None


def lands_in(view, phase, target, slack=1e-12):
    """Whether the first impact certainly is in the target, mod 2 pi."""
    found = _impact(view, phase)
    if not isinstance(found, Impact):
        return False
    low, high = (float(end) for end in target)
    turns = (float(found.lifted) - low) // TURN
    return low + slack < float(found.lifted) - turns * TURN < high - slack


def avoids(view, rng, count=10):
    """No first impact in the target; where two of them lie on both sides, look between."""
    before = None
    for phase in points(view.source, rng, count):
        now = lifted(view, phase)
        if lands_in(view, phase, view.target):
            return [f"the launch at {float(phase):.12g} lands in the target"]
        hit = None if None in (before, now) else _between(view, (before, (phase, now)))
        if hit is not None:
            return [f"the launch at {float(hit):.12g} lands in the target"]
        before = None if now is None else (phase, now)
    return []


def _between(view, ends):
    """A phase between two that lands in the middle of the target, where F is continuous."""
    (a, fa), (b, fb) = ends
    middle = float(sum(view.target)) / 2
    turns = (max(fa, fb) - middle) // TURN
    goal = middle + turns * TURN
    if abs(fa - fb) > TURN / 2 or not min(fa, fb) < goal < max(fa, fb):
        return None
    for _ in range(30):
        c = (a + b) / 2
        fc = lifted(view, c)
        if fc is None:
            return None
        if lands_in(view, c, view.target):
            return c
        if (fc < goal) == (fa < goal):
            a, fa = c, fc
        else:
            b, fb = c, fc
    return None


def branch(view, rng):
    """On each piece gap > 0 up to its window, and then one zero in it; any turn may be counted."""
    told = []
    if any(b <= a for a, b in zip(view.cuts, view.cuts[1:], strict=False)):
        return ["the cuts do not increase"]
    if len(view.windows) != len(view.cuts) - 1:
        return ["the lengths do not fit"]
    for k in {0, len(view.windows) - 1, rng.randrange(len(view.windows))}:
        end = view.windows[k][1]
        for phase in points((view.cuts[k], view.cuts[k + 1]), rng, 1):
            found = _impact(view, phase, float(end) + 1)
            if isinstance(found, str):
                told.append(f"the launch at {float(phase):.9g}: {found}")
            elif found is not None:
                if not inside(found.time, view.windows[k]):
                    told.append(f"the impact after {float(phase):.9g} is at {found.time.str(9)}")
                rest = ball(end) - found.time
                below = [found.gap.at(found.time + rest * s / 8)[0] for s in (1, 4, 8)]
                if max(map(float, below)) > 1e-12:
                    told.append(f"the gap does not stay below 0 after {float(phase):.9g}")
    return told


def entropy_bound(view, rng):
    """log(growth) is enclosed; it is below an upper bound of the entropy on the branches.

    f is monotone between the points examined: how often the arc between their images meets each
    of the branches bounds the number of orbits that take different branches.
    """
    told = _full_shift(view, rng) if view.cells else []
    logarithm = ball(view.growth).log()
    if not inside(logarithm, view.entropy):
        told.append(f"log(growth) is {logarithm.str(15)}")
    size = len(view.branches)
    ends = [(float(b.cuts[0]), float(b.cuts[-1])) for b in view.branches]
    if any(b[0] <= a[1] for a, b in pairwise(ends)):
        told.append("the branches overlap or are out of order")
    matrix = np.zeros((size, size))
    for i, one in enumerate(view.branches):
        cuts = (*one.cuts[:: max(1, len(one.cuts) // 3)], one.cuts[-1])
        images = [lifted(view, phase, float(max(one.windows)[1]) + 1) for phase in cuts]
        if None in images:
            return told
        low, high = min(images) - 1e-6, max(images) + 1e-6
        for j, (left, right) in enumerate(ends):
            first, last = np.ceil((low - right) / TURN), np.floor((high - left) / TURN)
            matrix[i, j] = max(0.0, last - first + 1)
    radius = max(abs(np.linalg.eigvals(matrix)), default=0.0)
    if float(view.growth) > radius * (1 + 1e-9):
        told.append(f"growth above {radius:.6g}, all that the branches allow")
    return told


def _full_shift(view, rng):
    """What is wrong with cells on which f does not jump, each mapped over the hull of all."""
    told, cells = [], view.cells
    if len(cells) != view.growth or any(b[0] <= a[1] for a, b in pairwise(cells)):
        told.append("the cells are out of order or overlap, or are not as many as is said")
    for cell in cells:
        if maps_over(view, cell, (cells[0][0], cells[-1][1])) in (False, None):
            told.append(f"f does not map {cell} over all cells")
        found = [_impact(view, phase) for phase in points(cell, rng, 5)]
        slopes = [each.slope for each in found if isinstance(each, Impact)]
        if len(slopes) < len(found):
            told.append(f"launches from {cell} without a transversal impact")
        steep = [float(slope) for slope in slopes] or [0.0]
        bounds = min(steep) - 1 - abs(min(steep)) / 2, max(steep) + 1 + abs(max(steep)) / 2
        told += smooth(view, cell, bounds, rng, 5)
    return told


def maps_over(view, cell, target):
    """Whether f maps a cell over another, or misses it; None where neither is seen."""
    ends = [lifted(view, phase) for phase in cell]
    if None in ends:
        return "unknown"
    low, high = min(ends), max(ends)
    for turns in range(int(low // TURN) - 1, int(high // TURN) + 2):
        first, last = (float(end) + turns * TURN for end in target)
        if low <= first + 1e-12 and last - 1e-12 <= high:
            return True
        if first <= high and low <= last:
            return None
    return False


def staying_set(view, rng):
    """Disjoint cells in the order of phases, f steeper than 1; what is outside of them leaves."""
    told, cells, count = [], view.cells, len(view.cells)
    if any(b[0] <= a[1] for a, b in pairwise(cells)) or not cells:
        told.append("the cells are not in the order of phases, or overlap")
    if not len(view.slopes) == len(view.onward) == count:
        return [*told, "slopes and arrows are not those of these cells"]
    steep = [min(abs(end) for end in bounds) for bounds in view.slopes]
    if min(steep) <= 1 or view.expansion != min(steep):
        told.append("f is not said to expand")
    for cell, bounds in zip(cells, view.slopes, strict=True):
        if not any(low <= cell[0] < cell[1] <= high for low, high in view.region):
            told.append("a cell is empty, or leaves the region")
        told += smooth(view, cell, bounds, rng, 1)
    for i, cell in enumerate(cells):
        for j, other in enumerate(cells):
            seen = maps_over(view, cell, other)
            if seen != "unknown" and seen is not (j in view.onward[i]):
                told.append(f"no full shift, no cycle: cell {i} is mapped over cell {j}: {seen}")
    told += graph_faults(view)
    if len(view.region) == 1:
        told += _region_faults(view, view.region[0], rng)
    elif view.whole:
        told.append("a whole of several intervals")
    return told


def graph_faults(view):
    """What is wrong with the arrows: growth, closed paths, the one orbit."""
    told, count = [], len(view.cells)
    matrix = np.array([[int(j in after) for j in range(count)] for after in view.onward])
    radius = max(abs(np.linalg.eigvals(matrix)))
    if not float(view.growth[0]) - 1e-9 <= radius <= float(view.growth[1]) + 1e-9:
        told.append(f"the spectral radius is {radius}")
    counts = [int(np.trace(np.linalg.matrix_power(matrix, n))) for n in range(1, 9)]
    if list(view.fixed_points) != counts:
        told.append(f"there are {counts} closed paths")
    if not (np.linalg.matrix_power(np.eye(count) + matrix, 2 * count) > 0).all():
        told.append("no path leads from some cell to some other")
    places = [view.cells.index(cell) for cell in view.orbit if cell in view.cells]
    if (len(places) == count) != (matrix.sum() == count):
        told.append("the orbit is not all of the cells")
    if any(not matrix[i, j] for i, j in zip(places, places[1:] + places[:1], strict=True)):
        told.append("no cycle: the orbit does not follow the arrows")
    return told


def _region_faults(view, region, rng):
    """What is wrong with an interval: fixed points, and what stays, out of the cells."""
    told = []
    for low, high in _fixed_points(view, region):
        near = [i for i, (a, b) in enumerate(view.cells) if a <= high and low <= b]
        if not any(i in view.onward[i] for i in near):
            told.append(f"no cycle: another orbit that stays, at {float(low):.9g}")
    if not view.whole:
        return told
    for cell in view.cells:
        told += [f"no full shift: {x}" for x in _short(view, cell, region)]
    for phase in points(region, rng, 12):
        outside = not any(low <= phase <= high for low, high in view.cells)
        if outside and lands_in(view, phase, region):
            told.append(f"f({float(phase):.12g}) stays, in no cell")
    return told


def _fixed_points(view, part, count=60):
    """Brackets of the fixed points that are seen in an interval, from values on a grid."""
    before = None
    for k in range(count + 1):
        phase = between(part, Fraction(k, count))
        value = lifted(view, phase)
        now = None if value is None else (value - float(phase)) / TURN
        if None not in (before, now) and abs(now - before) < 0.5 and now // 1 != before // 1:
            yield between(part, Fraction(k - 1, count)), phase
        before = now


def _short(view, cell, target):
    """Whether the image of a cell does not cover an interval of [0, 2 pi)."""
    images = [lifted(view, phase) for phase in cell]
    if None in images:
        return []
    low, high = min(images), max(images)
    first, last = (float(end) for end in target)
    turns = np.ceil((low - first) / TURN - 1e-9)
    if last + turns * TURN <= high + 1e-9:
        return []
    return [f"a cell is mapped to ({low % TURN:.9g}, {high % TURN:.9g}) only"]


def image_arc(view, rng):
    """f is continuous and monotone on the domain, onto the arc between its ends' images."""
    at = [lifted(view, phase) for phase in points(view.domain, rng, 4)]
    if None in at:
        return []
    rises = [b > a for a, b in pairwise(at)]
    told = [] if len(set(rises)) == 1 else ["f is not monotone"]
    if max(at) - min(at) >= TURN:
        told.append("the arc is longer than the circle")
    for given, end in ((view.low, min(at)), (view.high, max(at))):
        if not inside_mod(ball(end), given, 1e-9):
            told.append(f"an end of the arc is {end % TURN:.12g}")
    return told


def horseshoe_faults(sets, rng):
    """What is wrong with H1 to H6 at these numbers, each complaint beginning with its id."""
    told = []
    for part, sign in zip((sets.left, sets.right), sets.signs, strict=True):
        images = []
        for phase in points(part, rng, 2):
            found = _impact(sets, phase)
            if found == "none" or found is None:
                continue
            if isinstance(found, str):
                told.append(f"H1 H2 H3 the launch at {float(phase):.9g}: {found}")
                continue
            slope, within = sign * float(found.slope), part[0] < phase < part[1]
            images.append(float(found.lifted))
            if within and slope < float(sets.slopes[0]) - 1e-12:
                told.append(f"H1 H6 {sign} f'({float(phase):.12g}) is {slope:.12g}")
            if within and slope > float(sets.slopes[1]) + 1e-12:
                told.append(f"H2 f'({float(phase):.12g}) is {slope:.12g}")
            if slope < 0:
                told.append(f"H3 f'({float(phase):.12g}) is {slope:.12g}")
        if images and not _covered(images, sets.interval):
            told.append("H5 an image of I0 or I1 does not cover I")
    width = (sets.right[0] - sets.left[1]) / 10**6
    gap = SimpleNamespace(eta=sets.eta, nu=sets.nu, target=sets.interval)
    gap.source = sets.left[1] + width, sets.right[0] - width
    told += [f"H4 H5 {one}" for one in avoids(gap, rng)]
    return told


def _covered(images, interval):
    low, high = (float(end) for end in interval)
    first = np.ceil((min(images) - low - 1e-12) / TURN)
    return max(images) >= high + first * TURN - 1e-12


def itinerary(view, rng):
    """The orbit of a phase, and which of the sets it visits; `cut`: the word, where it leaves."""
    sets, told, lift, *word = view.base, [], ball(view.orbit[0][0]), *map(int, view.cut)
    left, right = sets.cells
    if len(view.orbit) != len(word):
        return ["the lengths do not fit"]
    with flint.ctx.workprec(PRECISION):
        for k, bounds in enumerate(view.orbit):
            if not inside_mod(lift, bounds):
                return [f"f^{k} of the phase is {float(lift) % TURN:.15g}"]
            phase = lift - int(float(lift) // TURN) * two_pi()
            where = [inside(phase, left), inside(phase, right)]
            if k < len(word) - 1:
                if not where[word[k]]:
                    return [f"f^{k} of the phase, {float(phase):.12g}, is not in I{word[k]}"]
                found = next_impact(sets.eta, sets.nu, phase)
                if not isinstance(found, Impact):
                    return told
                lift = found.lifted
            else:
                place = (phase > ball(left[0])) + (phase > ball(right[0]))
                if any(where) or int(place) != word[k]:
                    told.append(f"f^{k} of the phase, {float(phase):.12g}, is elsewhere")
        return told
