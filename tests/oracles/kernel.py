"""Judges of the generic kernel's conclusions, from the texts of the formulas alone."""

from fractions import Fraction
from functools import reduce
from itertools import combinations, product

import flint
import numpy as np

from tests.oracles.flights import Simulation, parameters_in, system_of_record
from tests.oracles.formulas import BITS, STEP, compiled, exact
from tests.oracles.ode import LONG, Solver

STEP_OF_FLIGHTS, SHORT = 1 / 10, 1 / 160
NARROW = 1e-4  # boxes in which zeros are looked for in short steps
FLOATS = LONG._replace(step=1 / 40, row=LONG.row[:6])  # about as good as floats


def values(function, point, step=STEP_OF_FLIGHTS):
    """The components of a map at a point (Arb numbers); those of a flight from floats."""
    if function.kind == "Composition":
        return reduce(lambda x, each: values(each, x, step), function.maps, point)
    if function.kind == "Flight":
        return [flint.arb(float(x)) for x in simulated(function, step).fly(column(point))[:-1, 0]]
    if function.kind == "Flow":
        return [flint.arb(float(x)) for x in solved(function)(column(point))[:, 0]]
    env = dict(zip(function.variables, point, strict=True)) | parameters(function)
    return [compiled(text)[0](env) for text in function.trees]


def matrix(function, point):
    """The derivative of a map at a point, in floats."""
    if function.kind == "Composition":
        product_ = np.eye(len(point))
        for each in function.maps:
            product_ = matrix(each, point) @ product_
            point = values(each, point)
        return product_
    if function.kind == "Flight":
        return simulated(function).slopes(column(point))[:, :, 0]
    if function.kind == "Flow":
        return solved(function).both(column(point))[1][:, :, 0].astype(float)
    columns = [partial(function, point, k) for k in range(len(point))]
    return np.array([[float(x) for x in each] for each in columns]).T


def simulated(flight, step=STEP_OF_FLIGHTS):
    return Simulation(system_of_record(flight), step)


def solved(flow):
    return Solver(vars(flow) | {"parameters": parameters_in(flow.given)}, FLOATS)


def column(point):
    return np.array([[float(x)] for x in point])


def parameters(formula):
    """One value of each parameter."""
    sides = parameters_in(formula.given).items()
    return {name: exact(low + (high - low) / 3) for name, (low, high) in sides}


def shift(function, turns):
    """So many periods of the angles, as a vector (Arb numbers)."""
    while function.kind == "Composition":
        function = function.maps[0]
    formula, count = function, len(getattr(function, "variables", ()))
    if function.kind == "Flight":
        formula, count = function.formulas, function.state
    env, moved = parameters(formula), [flint.arb(0)] * count
    for (place, _, (text, *_)), times in zip(formula.circles, turns, strict=True):
        moved[place] = compiled(text)[0](env) * int(times)
    return moved


def partial(formula, point, place):
    """The partial derivatives of all components, by central differences."""
    step, sides = flint.arb(2) ** STEP, []
    for sign in (1, -1):
        moved = list(point)
        moved[place] = moved[place] + sign * step
        sides.append(values(formula, moved))
    return [(up - down) / (2 * step) for up, down in zip(*sides, strict=True)]


def sampled(box, rng, count=6):
    """Some corners of a box and random points, as Arb numbers."""
    yield from ([exact(x) for x in corner] for corner in list(product(*box))[:8])
    for _ in range(count):
        yield [exact(a + (b - a) * Fraction(rng.randint(0, 65536), 65536)) for a, b in box]


def _told(point):
    return "(" + ", ".join(f"{float(x):.6g}" for x in point) + ")"


# -- zeros -----------------------------------------------------------------------------------------


def newton(function, start, box=()):
    """A zero near a start, or None; function(point) gives values and the matrix, in floats.

    box: what is not left by more than its width.
    """
    point = np.array([float(x) for x in start])
    far = [(float(2 * a - b), float(2 * b - a)) for a, b in box] or [(-1e9, 1e9)] * len(point)
    for _ in range(30):
        found, matrix = function(point)
        try:
            step = np.linalg.solve(matrix, found)
        except np.linalg.LinAlgError:
            return None
        point = point - step
        if not all(a <= x <= b for x, (a, b) in zip(point, far, strict=True)):
            return None
        if np.max(np.abs(step)) < 1e-13:
            return point
    return None


def _plain(map_, box=()):
    """The values, as exact as zeros in a box ask for, and the matrix, in floats."""
    is_narrow = bool(box) and max(b - a for a, b in box) < NARROW
    step = SHORT if is_narrow else STEP_OF_FLIGHTS

    def function(point):
        balls = [exact(float(x)) for x in point]
        with np.errstate(all="ignore"):
            return np.array([float(x) for x in values(map_, balls, step)]), matrix(map_, balls)

    return function


def image(view, rng):
    """Points of the box are taken into the bounds."""
    with flint.ctx.workprec(BITS):
        points = list(sampled(view.box, rng))
        if view.function.kind == "Flow":  # which takes many as fast as one
            images = solved(view.function)(np.hstack([column(x) for x in points])).T
        else:
            images = [values(view.function, point) for point in points]
        for point, found in zip(points, images, strict=True):
            for value, (low, high) in zip(found, view.bounds, strict=True):
                if not float(low) - 1e-6 <= float(value) <= float(high) + 1e-6:
                    return [f"the image of {_told(point)} is not in the bounds"]
    return []


def trapped(view, rng):
    """Images of points of the boxes are in boxes, angles aside."""
    angles = {place for place, *_ in view.function.circles}
    places = [i for i in range(len(view.boxes[0])) if i not in angles]
    for box in view.boxes:
        with flint.ctx.workprec(BITS):
            points = list(sampled(box, rng))
            if view.function.kind == "Flow":
                images = solved(view.function)(np.hstack([column(x) for x in points])).T
            else:
                images = [values(view.function, point) for point in points]
        for point, found in zip(points, images, strict=True):
            ends = [[(float(found[i]), *map(float, box[i])) for i in places] for box in view.boxes]
            if not any(all(low <= x <= high for x, low, high in sides) for sides in ends):
                return [f"the image of {_told(point)} is in none of the boxes"]
    return []


def zeros_in(function, box, rng):
    """The zeros that Newton's method finds inside a box; function: as for `newton`."""
    found = []
    with flint.ctx.workprec(BITS):
        for start in rng.sample(list(sampled(box, rng, 5)), 4):
            zero = newton(function, start, box)
            if zero is None:
                continue
            inside = all(
                float(a) - 1e-9 < x < float(b) + 1e-9 for x, (a, b) in zip(zero, box, strict=True)
            )
            if inside and all(np.max(np.abs(zero - other)) > 1e-7 for other in found):
                found.append(zero)
    return found


def unique_zero(view, rng):
    found = zeros_in(_plain(view.function, view.box), view.box, rng)
    return [] if len(found) == 1 else [f"{len(found)} zeros are found"]


def periodic_orbits(view, rng):
    """The orbits that Newton's method finds from many places are as many, by least period."""
    formula, found, counts, asked = view.function, [], {}, dict(view.counts)
    near = [(max(low, Fraction(-2)), min(high, Fraction(2))) for low, high in view.box]
    with flint.ctx.workprec(BITS):
        for period in (d for d in range(1, view.period + 1) if view.period % d == 0):
            shorter, few = len(found), 12 * period
            starts = (*sampled(view.box, rng, 6), *sampled(near, rng, 40 * few))
            for tries, start in enumerate(starts):
                if tries > few and len(found) - shorter == asked.get(period, 0):
                    break  # the last orbits take many more places than the others
                point = newton(_closing(formula, period), start)
                orbit = [] if point is None else _orbit(formula, point, period)
                if orbit and _inside(orbit, view.box) and not any(_meets(orbit, x) for x in found):
                    found.append(orbit)
            if len(found) > shorter:
                counts[period] = len(found) - shorter
    return [] if counts == asked else [f"orbits are found: {counts}"]


def periodic_orbit(view, rng):
    """Newton's method finds one zero of F^n(x) - x - p; its points differ, its multipliers fit."""
    turned = np.array([float(x) for x in shift(view.function, view.turns)])
    found = zeros_in(_closing(view.function, view.period, turned, view.box), view.box, rng)
    if len(found) != 1:
        return [f"{len(found)} orbits are found"]
    told, step = [], _plain(view.function, view.box)
    points, product_ = [found[0]], np.eye(len(turned))
    for _ in range(view.period):
        with flint.ctx.workprec(BITS):
            x, slopes = step(points[-1])
        points.append(x)
        product_ = slopes @ product_
    one = np.array([float(x) for x in shift(view.function, [1] * len(view.turns))])
    for x, y in combinations(points[:-1], 2):
        apart = np.where(one == 0, x - y, np.remainder(x - y + one / 2, one + (one == 0)) - one / 2)
        if np.max(np.abs(apart)) < 1e-7:
            told.append("two of its points are the same")
    sizes = abs(np.linalg.eigvals(product_))
    fits = {
        None: True,
        "attracting": all(sizes < 1),
        "repelling": all(sizes > 1),
        "a saddle": min(sizes) < 1 < max(sizes),
    }
    return told if fits[view.stability] else [*told, f"multipliers of sizes {sizes}"]


def _closing(formula, period, turned=0, box=()):
    step = _plain(formula, box)

    def function(point):
        x, product = np.array(point), np.eye(len(point))
        for _ in range(period):
            if not np.all(np.abs(x) < 1e6):
                return np.full(len(point), np.nan), np.eye(len(point))
            x, slopes = step(x)
            product = slopes @ product
        return x - turned - point, product - np.eye(len(point))

    return function


def _orbit(formula, point, period):
    """The points from one on, and the first once more."""
    points, step = [point], _plain(formula)
    for _ in range(period):
        points.append(step(points[-1])[0])
    return points


def _inside(orbit, box):
    return all(
        float(a) < x < float(b) for point in orbit for x, (a, b) in zip(point, box, strict=True)
    )


def _close(one, other):
    return np.max(np.abs(one - other)) < 1e-7


def _meets(orbit, other):
    return any(_close(orbit[0], point) for point in other)


# -- symbolic dynamics -----------------------------------------------------------------------------


def h_set(view, rng):
    """The matrix is regular, and its inverse is the one given."""
    n, total = len(view.centre), view.matrix
    unit = [
        [sum(total[i][k] * view.inverse[k][j] for k in range(n)) for j in range(n)]
        for i in range(n)
    ]
    return [] if unit == [[int(i == j) for j in range(n)] for i in range(n)] else ["no inverse"]


def _local(cover, q, derivative=False):
    """f(q) = B^-1 (F^k(c + A q) - d) in Arb numbers; with the derivative, in floats."""
    local = cover.local
    point = [
        exact(c) + sum((exact(a) * x for a, x in zip(row, q, strict=True)), flint.arb(0))
        for c, row in zip(local.source.centre, local.source.matrix, strict=True)
    ]
    product_ = np.array(local.source.matrix, float)
    for _ in range(local.power):
        if derivative:
            product_ = matrix(local.map, point) @ product_
        point = [x.mid() for x in values(local.map, point)]
    centre, turned = local.target.centre, shift(local.map, local.turns)
    moved = [x - p - exact(d) for x, p, d in zip(point, turned, centre, strict=True)]
    image = [
        sum((exact(a) * x for a, x in zip(row, moved, strict=True)), flint.arb(0))
        for row in local.target.inverse
    ]
    return (image, np.array(local.target.inverse, float) @ product_) if derivative else image


def covers(view, rng):
    """The faces are mapped beyond the target's, the rest beside or through it."""
    cube = [(Fraction(-1), Fraction(1))] * len(view.local.source.centre)
    with flint.ctx.workprec(BITS):
        for place in sampled(cube, rng, 8):
            on_face = [exact(rng.choice((-1, 1))), *place[1:]]
            q = on_face if rng.random() < 0.3 else place
            image = _local(view, q)
            beyond = abs(image[0]) > 1
            if abs(q[0]) == 1 and not view.orientation * q[0] * image[0] > 1:
                return [f"a face is not mapped beyond the target, at {_told(q)}"]
            if not beyond and any(abs(x) > 1 for x in image[1:]):
                return [f"the image leaves the target through a side, at {_told(q)}"]
    return []


def graph(view, rng):
    """The relations hold, are those of the arrows, and the sets are disjoint."""
    told = [x for one in view.covers for x in covers(one, rng)]
    for cover, (i, j) in zip(view.covers, view.edges, strict=True):
        if (cover.local.source, cover.local.target) != (view.nodes[i], view.nodes[j]):
            told.append("an arrow is about other sets")
    for one, two in product(view.nodes, repeat=2):
        for _ in range(40 if one != two else 0):
            q = [rng.choice((-1, 1, 2 * rng.random() - 1)) for _ in one.centre]
            place = np.array(one.centre, float) + np.array(one.matrix, float) @ q
            back = np.array(two.inverse, float) @ (place - np.array(two.centre, float))
            if np.max(np.abs(back)) < 1 - 1e-9:
                return [*told, "two of the sets meet"]
    return told


def _adjacency(of):
    matrix = np.zeros((len(of.nodes), len(of.nodes)))
    for i, j in of.edges:
        matrix[i, j] = 1
    return matrix


def entropy(view, rng):
    """growth <= (spectral radius)^length."""
    radius = max(abs(np.linalg.eigvals(_adjacency(view.graph))))
    fits = float(view.growth) <= radius ** float(view.length) * (1 + 1e-9)
    return graph(view.graph, rng) + ([] if fits else [f"the spectral radius is {radius:.9g} only"])


def conjugacy(view, rng):
    """Of a closed path only one periodic orbit is found, from several starts."""
    told, of = graph(view.graph, rng), view.graph
    by_edge = dict(zip(of.edges, of.covers, strict=True))
    n = len(of.nodes[0].centre)
    for path in _closed(of.edges, rng):
        steps = [by_edge[edge] for edge in path]

        def defect(point, steps=steps):
            """q_(m+1) - f(q_m), cyclically, and its derivative."""
            size = n * len(steps)
            rest, matrix = np.zeros(size), np.zeros((size, size))
            for m, step in enumerate(steps):
                own, after = slice(n * m, n * m + n), n * ((m + 1) % len(steps))
                image, slope = _local(step, [exact(float(x)) for x in point[own]], True)
                rest[own] = point[after : after + n] - np.array([float(x) for x in image])
                matrix[own, after : after + n] += np.eye(n)
                matrix[own, own] -= slope
            return rest, matrix

        found = []
        with flint.ctx.workprec(BITS):
            for _ in range(6):
                zero = newton(defect, [2 * rng.random() - 1 for _ in range(n * len(steps))])
                inside = zero is not None and np.max(np.abs(zero)) < 1 - 1e-9
                if inside and all(np.max(np.abs(zero - other)) > 1e-7 for other in found):
                    found.append(zero)
        if len(found) > 1:
            told.append(f"{len(found)} periodic orbits follow one path")
    return told


def _closed(edges, rng, most=2):
    """Some closed paths of up to three arrows."""
    paths = [(e,) for e in edges if e[0] == e[1]]
    paths += [
        (e, f) for e, f in product(edges, repeat=2) if e[1] == f[0] and f[1] == e[0] and e < f
    ]
    return rng.sample(paths, min(most, len(paths)))
