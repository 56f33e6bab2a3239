"""Judges of conclusions about impacts with restitution: boxes of oscillators and of states."""

from fractions import Fraction
from itertools import product
from types import SimpleNamespace

from tests.oracles.motion import Impact, ball, flight, inside
from tests.oracles.plastic import between

CONE = 2  # unstable vectors have |dgamma| <= CONE |dphi|


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


def _image(view, state):
    """F at a state as (phase less the turns, velocity, DF); a complaint; or None."""
    eta, nu, epsilon, phi, gamma = state
    side = 1 if nu > 0 else -1
    if side * (ball(eta) * ball(gamma) + ball(nu) * ball(phi).cos()) < 0:
        return f"the state ({float(phi):.6g}, {float(gamma):.6g}) is not possible"
    found = flight(eta, nu, phi, epsilon, gamma)
    if isinstance(found, str):
        return f"the state ({float(phi):.6g}, {float(gamma):.6g}): {found}"
    if not isinstance(found, Impact):
        return None
    return found.turned(int(view.turns)), found.velocity, found.derivative()


def _entries(found, bounds):
    for i, j in product((0, 1), repeat=2):
        if not inside(found[i][j], bounds[i][j]):
            yield f"DF[{i}][{j}] is {found[i][j].str(12)}"


def rebound(view, rng):
    """All states are possible; phases, velocities and derivatives of their images."""
    return _map_faults(view, rng, view.phases, view.phase)


def _map_faults(view, rng, phases, image):
    told = []
    if view.box[0][0] <= 0 or view.box[1][0] * view.box[1][1] <= 0 or not view.box[2][0] >= 0:
        return ["the box leaves the model"]
    for state in _states(view.box, phases, view.velocities, rng):
        found = _image(view, state)
        if found is None or isinstance(found, str):
            told += [found] if found else []
            continue
        place = f"({float(state[3]):.6g}, {float(state[4]):.6g})"
        if image is not None and not inside(found[0], image):
            told.append(f"the phase after {place} is {found[0].str(12)}")
        if not inside(found[1], view.velocity):
            told.append(f"the velocity after {place} is {found[1].str(12)}")
        told += _entries(found[2], view.derivative)
    return told


def rectangle(view, rng):
    """The same on a rectangle, with the images of its left and right edges."""
    if view.phases[0] >= view.phases[1]:
        return ["a rectangle without width"]
    told = _map_faults(view, rng, view.phases, None)
    for end, image in zip(view.phases, (view.left, view.right), strict=True):
        told += _map_faults(view, rng, (end, end), image)
    return told


def barred_word(view, rng):
    """No orbit follows the word: look for one, by the ends of the phases that follow its start.

    The next phase increases with the phase; so the phases (at one velocity) whose images follow
    part of a word are an interval, found by bisection.
    """
    told, word = [], [int(letter) for letter in view.word]
    for share in (0, 1, rng.random()):
        eta, nu, epsilon = (between(side, Fraction(share)) for side in view.box)
        gamma = between(view.velocities, Fraction(rng.choice((0, 1, rng.random()))))
        at = SimpleNamespace(eta=eta, nu=nu, epsilon=epsilon, sets=view.sets, gamma=gamma)
        low, high = (float(end) for end in view.sets[word[0]])
        for n in range(1, len(word)):
            goal = [float(end) for end in view.sets[word[n]]]
            ends = [_after(at, x, n, goal) for x in (low, high)]
            if None in ends:
                break
            short = max(goal[0] - ends[1], ends[0] - goal[1])
            if short > 0:
                if n == len(word) - 1 and short < float(view.short) - 1e-9:
                    told.append(f"an orbit comes within {short:.9g} of the last rectangle")
                break
            low = low if ends[0] >= goal[0] else _solve(at, (low, high), n, goal, goal[0])
            high = high if ends[1] <= goal[1] else _solve(at, (low, high), n, goal, goal[1])
        else:
            told.append(f"the orbit of ({low:.9g}, {float(gamma):.6g}) follows the word")
    return told


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
    for _ in range(40):
        middle = (low + high) / 2
        found = _after(at, middle, count, goal)
        if found is None:
            break
        low, high = (middle, high) if found < wanted else (low, middle)
    return (low + high) / 2


def crossings(view, rng):
    """The rectangles are crossed as the arrows say, by the margin; cones are expanded."""
    told = []
    for one, targets in zip(view.rectangles, view.arrows, strict=True):
        told += rectangle(one, rng)
        low = min(view.rectangles[j].phases[0] for j in targets)
        high = max(view.rectangles[j].phases[1] for j in targets)
        for state in _states(one.box, one.phases, one.velocities, rng):
            for edge, reach in ((0, low - view.margin), (1, high + view.margin)):
                state[3] = one.phases[edge]
                found = _image(one, state)
                if found is None or isinstance(found, str):
                    continue
                beyond = found[0] <= ball(reach) if edge == 0 else found[0] >= ball(reach)
                if not beyond:
                    told.append(f"an edge is mapped to {found[0].str(12)}, not beyond the arrows")
                (p, q), (r, s) = ([float(x) for x in row] for row in found[2])
                if abs(p) - CONE * abs(q) < float(view.expansion) - 1e-9:
                    told.append(f"phases grow {abs(p) - CONE * abs(q):.6g} times only")
                if abs(s) + abs(q * r) / abs(p) > float(view.contraction) + 1e-2:
                    told.append("velocities shrink less")
    if view.expansion <= 1 or view.contraction >= 1 or view.margin <= 0:
        told.append("not hyperbolic, or no margin")
    return told


JUDGES = {
    "rebound": rebound,
    "rectangle": rectangle,
    "barred_word": barred_word,
    "crossings": crossings,
}
