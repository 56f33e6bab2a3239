"""Judges of conclusions about impacts with restitution: boxes of oscillators and of states."""

from fractions import Fraction
from itertools import product
from math import inf
from types import SimpleNamespace

from tests.oracles import planar, plastic
from tests.oracles.motion import TURN, Impact, ball, flight, inside, inside_mod
from tests.oracles.plastic import between


def _states(box, phases, velocities, rng, count=5):
    """(eta, nu, epsilon, phi, gamma): two opposite corners and random places."""
    for k in range(count):
        shares = [
            Fraction(k) if k < 2 else Fraction(rng.choice((0, 1, rng.random()))) for _ in range(5)
        ]
        yield [
            between(side, share)
            for side, share in zip((*box, phases, velocities), shares, strict=True)
        ]


def _launched(state):
    """The next impact after a state before one; a complaint, if it is not possible; or None."""
    eta, nu, epsilon, phi, gamma = state
    side, place = 1 if nu > 0 else -1, f"({float(phi):.6g}, {float(gamma):.6g})"
    if side * (ball(eta) * ball(gamma) + ball(nu) * ball(phi).cos()) < 0:
        return f"the state {place} is not possible"
    found = flight(eta, nu, phi, epsilon, gamma)
    return f"the state {place}: {found}" if isinstance(found, str) else found


def _entries(found, bounds):
    for i, j in product((0, 1), repeat=2):
        if not inside(found[i][j], bounds[i][j]):
            yield f"DF[{i}][{j}] is {found[i][j].str(12)}"


def differential(view, rng):
    """Values and derivatives on a region; of an oscillator all states there are possible."""
    return _faults(view, rng, view.region, view.values, view.matrix)


def _faults(view, rng, region, image, matrix=None):
    if planar.is_of_a_file(view):
        return planar.faults(view, rng, region, image, matrix)
    if view.function.kind == "PlasticMap":
        return plastic.at_phases(view, rng)
    told = []
    if view.box[0][0] <= 0 or view.box[1][0] * view.box[1][1] <= 0 or not view.box[2][0] >= 0:
        return ["the box leaves the model"]
    for state in _states(view.box, *region, rng):
        found = _launched(state)
        if not isinstance(found, Impact):
            told += [found] if found else []
            continue
        place, phase = (
            f"({float(state[3]):.6g}, {float(state[4]):.6g})",
            found.turned(view.turns[0]),
        )
        if not inside(phase, image[0]):
            told.append(f"the phase after {place} is {phase.str(12)}")
        if not inside(found.velocity, image[1]):
            told.append(f"the velocity after {place} is {found.velocity.str(12)}")
        told += _entries(found.derivative(), matrix) if matrix else []
    return told


def rectangle(view, rng):
    """The same on the parts, which are those of a rectangle, and for its left and right edges."""
    (low, high), side = view.region
    told, reached = [], low
    for part in view.parts:
        if part.region[0][0] != reached or part.region[1] != side:
            told.append("parts that are not those of the rectangle")
        reached = part.region[0][1]
        told += differential(part, rng)
    for end, image in zip((low, high), view.edges, strict=True):
        told += _faults(view, rng, ((end, end), side), image)
    return told if low < reached == high else [*told, "no parts of a rectangle"]


def horseshoe(view, rng):
    """What it says of its sets is true."""
    if planar.is_of_a_file(view):
        return planar.horseshoe(view, rng)
    return rectangle_horseshoe(view, rng)


def barred_word(view, rng):
    """No orbit follows the word, and the last image falls short by as much as is said."""
    if planar.is_of_a_file(view):
        return planar.barred_word(view, rng)
    short = _shortfall(view, view.word, rng)
    if short is None or short >= float(view.short) - 1e-9:
        return []
    return [f"an orbit along {view.word} comes within {short:.9g} of the last rectangle"]


def _shortfall(view, word, rng, shares=(0, 1, None)):
    """By how much the orbits found that follow a word miss its last set; 0: one does not; None.

    The next phase increases with the phase; so the phases (at one velocity) whose images follow
    part of a word are an interval, found by bisection.
    """
    boxes = _boxes(view)
    least, sets = None, [phases for phases, _ in boxes]
    for given in shares:
        share = Fraction(rng.random() if given is None else given)
        eta, nu, epsilon = (between(side, share) for side in view.box)
        gamma = between(boxes[0][1], Fraction(rng.choice((0, 1, rng.random()))))
        at = SimpleNamespace(eta=eta, nu=nu, epsilon=epsilon, gamma=gamma)
        low, high = (float(end) for end in sets[word[0]])
        for n in range(1, len(word)):
            goal = [float(end) for end in sets[word[n]]]
            ends = [_after(at, x, n, goal) for x in (low, high)]
            if None in ends:
                break
            short = max(goal[0] - ends[1], ends[0] - goal[1])
            if short > 0:
                least = min(short if n == len(word) - 1 else inf, inf if least is None else least)
                break
            low = low if ends[0] >= goal[0] else _solve(at, (low, high), n, goal, goal[0])
            high = high if ends[1] <= goal[1] else _solve(at, (low, high), n, goal, goal[1])
        else:
            return 0.0
    return least


def _after(at, phase, count, goal):
    """The phase after some impacts, on the turn that is nearest to a goal."""
    gamma = at.gamma
    phase = Fraction(phase)
    for _ in range(count):
        found = flight(at.eta, at.nu, phase, at.epsilon, gamma)
        if not isinstance(found, Impact):
            return None
        phase, gamma = Fraction(found.phase), Fraction(float(found.velocity))
    return float(phase)


def _solve(at, ends, count, goal, wanted):
    low, high = ends
    for _ in range(32):
        middle = (low + high) / 2
        found = _after(at, middle, count, goal)
        if found is None:
            break
        low, high = (middle, high) if found < wanted else (low, middle)
    return (low + high) / 2


def _rates(derivative, rates):
    """Vectors (x, y) = (dphi, (dgamma - slope dphi) / width) that are flat grow, and those with a
    steep image shrink.
    """
    slope, width = map(float, rates[2])
    (p, q), (r, s) = (
        [row[0] + slope * row[1], width * row[1]]
        for row in ([float(x) for x in row] for row in derivative)
    )
    r, s = (r - slope * p) / width, (s - slope * q) / width
    p, q = (p, q) if p > 0 else (-p, -q)  # no size changes
    grow = min(abs(p + q * t) for t in (-1, 0, 1))
    edges = ((s - q) / (p - r), (-s - q) / (p + r)) if p > abs(r) else ()
    shrink = max((abs(r * t + s) for t in edges), default=1)
    if grow < float(rates[0]) - 1e-9 or shrink > float(rates[1]) + 1e-9:
        yield f"the rates are {grow:.6g}, {shrink:.6g}"
    if not rates[1] < 1 < rates[0]:
        yield "the rates are not hyperbolic"


def _boxes(view):
    """The rectangles; V1 and V2 by turns: two, or two for the states after V1 and two after V2."""
    if hasattr(view, "boxes"):
        return view.boxes
    strips = view.strips
    if hasattr(strips, "velocities"):
        return [(strips.left, strips.velocities), (strips.right, strips.velocities)]
    return [*strips.after_first, *strips.after_second]


def _impacts(view, rng, count=5):
    """States of the rectangles, which of them, and the next impacts."""
    for index, (phases, velocities) in enumerate(_boxes(view)):
        for state in _states(view.box, phases, velocities, rng, count):
            found = _launched(state)
            if found is not None:
                yield state, index, found


def rectangle_horseshoe(view, rng):
    """Edges are mapped beyond the rectangles that are next, by the margin, images there to
    velocities in them, and into no others; vectors grow and shrink.
    """
    told, boxes = [], _boxes(view)
    arrows = getattr(view, "arrows", [(0, 1)] * 2 if len(boxes) == 2 else [(0, 1), (2, 3)] * 2)
    low, high = (min(box[0][0] for box in boxes), max(box[0][1] for box in boxes))
    for state, index, found in _impacts(view, rng, 12):
        following = [boxes[k] for k in arrows[index]]
        edges = [_launched((*state[:3], edge, state[4])) for edge in boxes[index][0]]
        if not all(isinstance(one, Impact) for one in (found, *edges)):
            told += [one for one in (found, *edges) if isinstance(one, str)]
            continue
        told += _rates(found.derivative(), view.rates)
        turns = round((float(edges[0].lifted + edges[1].lifted) - float(low + high)) / 2 / TURN)
        first, last = sorted((one.turned(turns) for one in edges), key=float)
        sides = [side for (side, _) in following]
        ends = min(sides)[0] - view.margin, max(side[1] for side in sides) + view.margin
        if first > ball(ends[0]) or last < ball(ends[1]):
            told.append(f"edges are mapped to {first.str(9)}, {last.str(9)}, not beyond both sets")
        for phases, velocities in boxes:
            if not inside(found.turned(turns), phases):
                continue
            is_inside = inside(found.velocity, velocities)
            if (phases, velocities) in following:
                is_false = not is_inside
            else:
                is_false = is_inside and getattr(view, "is_complete", True)
            if is_false:
                told.append(f"an image velocity is {found.velocity.str(9)}")
    return told if view.margin > 0 else [*told, "no margin"]


def horseshoe_family(view, rng):
    """A horseshoe for each interval of epsilon, one after the other from 0 on."""
    told, reached = [], 0
    for shoe in view.shoes:
        if shoe.box[2][0] != reached or shoe.box[:2] != view.box[:2]:
            told.append(f"no horseshoe from epsilon = {float(reached):.6g} on")
        reached = shoe.box[2][1]
        told += rectangle_horseshoe(shoe, rng)
    return told if reached == view.box[2][1] > 0 else [*told, "not as far as said"]


def golden_mean(view, rng):
    """Words without 11 are followed, words that end in 11 after a few letters are not."""
    told = [] if view.box[2][0] > 0 else ["without restitution F is not one-to-one"]
    for _, index, found in _impacts(view, rng):
        if isinstance(found, str):
            told.append(found)
        elif index == 0 or inside_mod(found.lifted, view.strips.left):
            told += _rates(found.derivative(), view.rates)
    word = (0, 1, 0)
    while len(word) < 6:
        word += (0,) if word[-1] else (rng.randint(0, 1),)
    if _shortfall(view, word, rng, (None,)):
        told.append(f"no orbit follows {word}")
    if _shortfall(view, (*word, 0, 1, 1), rng, (None,)) == 0:
        told.append(f"an orbit follows {word}, 0, 1, 1")
    return told


def hyperbolic(view, rng):
    """Horizontal distances grow, vertical ones shrink, vectors do both."""
    told = []
    for _, _, found in _impacts(view, rng):
        if isinstance(found, str):
            told.append(found)
            continue
        (p, q), (_, s) = ([float(x) for x in row] for row in found.derivative())
        if abs(p) < float(view.grow) - 1e-9 or abs(q) + abs(s) > float(view.shrink) + 1e-9:
            told.append(f"distances grow {p:.6g} times, shrink to {abs(q) + abs(s):.6g}")
        told += _rates(found.derivative(), view.rates)
    return told if view.grow > 1 > view.shrink else [*told, "not hyperbolic"]


def edge_image(view, rng):
    """The next impact after one state, a corner of the rectangles."""
    if view.phase not in (*view.strips.left, *view.strips.right):
        return ["no edge of the rectangles"]
    told = []
    for state in _states(view.box, (view.phase,) * 2, (view.velocity,) * 2, rng, 3):
        found = _launched(state)
        if isinstance(found, str):
            told.append(found)
        elif found is not None and not inside_mod(found.lifted, view.image):
            told.append(f"the phase after the edge is {found.phase:.12g}")
    return told
