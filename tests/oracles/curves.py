"""Judges of curves of zeros, and of curves in the plane of eta and nu, by dense looking.

The gap of a single-impact orbit is typed here again, from (14) with a velocity that repeats.
"""

import math
from fractions import Fraction

import flint
import numpy as np

from tests.oracles.flights import SHORT, least_near, simulated
from tests.oracles.formulas import BITS, exact
from tests.oracles.kernel import matrix, newton, values
from tests.oracles.motion import TURN, Impact, flight, inside

_SLACK = 1e-9


def _cut(piece, axis, x):
    """The sides of a slanted box at one value of its axis."""
    box, slope = piece
    beyond = x - sum(box[axis]) / 2
    return [
        (low + s * beyond, high + s * beyond) for (low, high), s in zip(box, slope, strict=True)
    ]


def _sample(pieces, axis, rng, count):
    """Values of the axis, with the sides of the boxes there."""
    for _ in range(count):
        piece = rng.choice(pieces)
        low, high = piece[0][axis]
        x = low + (high - low) * Fraction(rng.randint(0, 64), 64)
        yield x, _cut(piece, axis, x)


def _zeros(view, x, sides, rng):
    """The zeros, at one value of the axis, that Newton's method finds in a box."""
    others = [k for k in range(len(sides)) if k != view.axis]

    def function(y):
        point = [exact(x)] * len(sides)
        for k, value in zip(others, y, strict=True):
            point[k] = exact(float(value))
        found = np.array([float(v) for v in values(view.function, point)])
        return found, matrix(view.function, point)[:, others]

    found = []
    with flint.ctx.workprec(BITS):
        for share in (0.5, *(rng.random() for _ in range(4))):
            start = [float(a) + share * float(b - a) for a, b in (sides[k] for k in others)]
            zero = newton(function, start)
            if zero is not None and all(
                float(sides[k][0]) - _SLACK < v < float(sides[k][1]) + _SLACK
                for k, v in zip(others, zero, strict=True)
            ):
                found += [] if any(np.max(abs(zero - each)) < 1e-7 for each in found) else [zero]
    return found


def arc(view, rng):
    """One zero at each value of the axis, the same where two pieces meet; one in each point's."""
    told = []
    places = list(_sample(view.pieces, view.axis, rng, 6))
    places += [(point[view.axis][0], list(point)) for point in view.points]
    for x, sides in places:
        found = _zeros(view, x, sides, rng)
        told += [] if len(found) == 1 else [f"{len(found)} zeros at {float(x):.6g}"]
    for first, second in zip(view.pieces, view.pieces[1:], strict=False):
        low, high = first[0][view.axis][1], second[0][view.axis][0]
        told += [] if low == high else ["a gap between two pieces"]
    return told


def flight_arc(view, rng):
    """Where values and gap are 0, by Newton's method with differences, the gap is least, or falls.

    In the place of a last value that is the gap's speed its difference is taken.
    """
    told, axis, h = [], view.arc.axis, 1e-4
    formulas, n = view.function.formulas, len(view.function.gaps)
    (gap, *_), values = formulas.trees[:n], formulas.trees[n:]
    is_graze = values[-1] == f"D({gap}, {formulas.variables[view.function.state]})"
    flights = simulated(view, (*values[: len(values) - is_graze], gap))

    def function(places):
        """All of this at columns of states and times."""
        here = flights.at(places[:-1], places[-1])
        if not is_graze:
            return here
        early, late = (flights.at(places[:-1], places[-1] + d)[-1] for d in (-h, h))
        return np.vstack([here, (late - early) / (2 * h)])

    for x, sides in _sample(view.arc.pieces, axis, rng, 3):
        place = np.array([float(low + high) / 2 for low, high in sides])
        place[axis], free = float(x), [k for k in range(len(place)) if k != axis]
        moves = np.eye(len(place))[:, free] * 1e-5
        for _ in range(5):
            found = function(place[:, None] + np.hstack([0 * moves[:, :1], moves, -moves]))
            after, before = np.split(found[:, 1:], 2, axis=1)
            place[free] -= np.linalg.solve((after - before) / 2e-5, found[:, 0])
        gaps = flights.heights(place[:-1, None], place[-1] + 4 * SHORT)[:, :, 0]
        if not all(a - 1e-6 < y < b + 1e-6 for y, (a, b) in zip(place, sides, strict=True)):
            told.append(f"at {float(x):.6g} the flight is elsewhere: {place}")
        elif gaps[: int(0.97 * place[-1] / SHORT)].min() <= 0:
            told.append(f"at {float(x):.6g} a gap is < 0 before")
        elif not is_graze:
            told += [] if gaps[-1, 0] < 0 else [f"at {float(x):.6g} the gap is > 0 after it"]
        else:
            least, time = least_near(gaps[:, 0], round(place[-1] / SHORT) - 1)
            if abs(least) > 1e-7 or abs(time - place[-1]) > 1e-4:
                told.append(f"at {float(x):.6g} the gap is least at {time:.9g}: {least:.3g}")
    return told


def distance(n, epsilon, eta, p, t):
    """The gap over h, but for its sign, from (14): x = X/h, the table at (1 + nu sin)/h."""
    q, swing = (1 - epsilon) / (1 + epsilon), eta * math.tan(math.pi * n * eta)
    mass = np.cos(eta * t) + swing / eta * np.sin(eta * t)
    return mass - (1 - p) - p * np.cos(t) - q * swing * np.sin(t)


def grazing(n, epsilon, eta):
    """The p at which flights begin to touch the table, and when; by looking closer and closer."""
    side = 1 if math.tan(math.pi * n * eta) > 0 else -1
    low, high = 1e-6, TURN * n - 1e-6
    for _ in range(4):
        t = np.linspace(low, high, 20_003)[1:-1]
        with np.errstate(divide="ignore"):
            bound = -side * distance(n, epsilon, eta, 0.0, t) / (1 - np.cos(t))
        k = int(np.argmax(np.where(np.isfinite(bound), bound, -np.inf)))
        low, high = t[max(k - 3, 0)], t[min(k + 3, len(t) - 1)]
    return side, side * float(bound[k]), float(t[k])


def amplitude(n, epsilon, eta, p, side):
    """nu, from nu sin(phi) = p h and nu cos(phi) = q eta h tan(pi n eta)."""
    h, q = 1 / (1 - p), (1 - epsilon) / (1 + epsilon)
    return side * math.hypot(p * h, q * eta * h * math.tan(math.pi * n * eta))


def state(n, epsilon, eta, p, side):
    """nu, phi and gamma of the solution of (14), (15)."""
    h, q = 1 / (1 - p), (1 - epsilon) / (1 + epsilon)
    across = q * eta * h * math.tan(math.pi * n * eta)
    nu = amplitude(n, epsilon, eta, p, side)
    return nu, math.atan2(p * h / nu, across / nu) % TURN, across / (q * eta)


def repeats(n, epsilon, eta, p, side):
    """Whether the first impact after the solution's is 2 pi n later; None if undecided."""
    nu, phi, gamma = state(n, epsilon, eta, p, side)
    found = flight(*map(Fraction, (eta, nu, phi, epsilon, gamma)), latest=TURN * n + 1)
    return abs(float(found.time) - TURN * n) < 1e-6 if isinstance(found, Impact) else None


def grazing_curve(view, rng):
    """The p and the time at which flights begin to touch; impacts on both sides; nu at points."""
    told, n, epsilon = arc(view.arc, rng), view.n, float(view.epsilon)
    for x, (_, p_side, t_side) in _sample(view.arc.pieces, 0, rng, 4):
        side, p, t = grazing(n, epsilon, float(x))
        near = [(p, p_side, 1e-8), (t, t_side, 1e-5)]
        if side != view.side or any(not inside(v, ends, slack) for v, ends, slack in near):
            told.append(f"at {float(x):.6g} flights begin to touch at p = {p:.9g}, t = {t:.9g}")
            continue
        for step in (1e-3, -1e-3):
            seen = repeats(n, epsilon, float(x), p + side * step * (1 - p), side)
            if seen is not None and seen is not (step > 0):
                told.append(f"beyond p by {step} it is an orbit: {seen}")
    for point, nu in zip(view.arc.points, view.amplitudes, strict=True):
        side, p, _ = grazing(n, epsilon, float(point[0][0]))
        if not inside(amplitude(n, epsilon, float(point[0][0]), p, side), nu, 1e-10):
            told.append("the amplitude at a point")
    return told


def beyond(view, eta):
    """p_G less the p of the fold (of the flip)."""
    n, epsilon = view.curve.n, float(view.curve.epsilon)
    q, x = (1 - epsilon) / (1 + epsilon), math.pi * n * eta
    fold, flip = -((q * eta * math.tan(x)) ** 2), eta**2 * (q * q + 1 / math.cos(x) ** 2)
    return grazing(n, epsilon, eta)[1] - (fold if view.other == "fold" else flip)


def meeting(view, rng):
    """p_G crosses the other curve at the one eta, in the direction that is said."""
    eta, (low, high) = float(sum(view.box[0]) / 2), view.curve.arc.pieces[0][0][0]
    high = view.curve.arc.pieces[-1][0][0][1]
    sign = 1 if view.rising else -1
    told = []
    for k in range(9):
        place = float(low) + (float(high) - float(low)) * k / 8
        if abs(place - eta) > 1e-6 and beyond(view, place) * sign * (place - eta) <= 0:
            told.append(f"at {place:.6g} it is on the other side")
    for step in (-1e-6, 1e-6):
        if beyond(view, eta + step) * sign * step <= 0:
            told.append("they do not meet there")
    side, p, _ = grazing(view.curve.n, float(view.curve.epsilon), eta)
    nu = amplitude(view.curve.n, float(view.curve.epsilon), eta, p, side)
    return told if inside(nu, view.amplitude, 1e-9) else [*told, f"nu is {nu}"]
