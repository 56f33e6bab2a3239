"""Judge of which single-impact orbits are stable: those that repeat, by (14) and (15) on a grid of
phases, are launched; their multipliers are those of the derivative at the impact that comes first.
"""

from fractions import Fraction

import numpy as np

from tests.oracles.motion import TURN, Impact, flight

_GRID = 4000
_LEAST = 1e-9  # relative velocity of an impact


def _repeated(eta, nu, epsilon, n, phi):
    """The velocity that (15) repeats after n turns from a phase, and what (14) leaves then."""
    angle, h, rate = TURN * n * eta, 1 + nu * np.sin(phi), nu * np.cos(phi)
    pushed = (1 + epsilon) * rate / eta
    gamma = (h * np.sin(angle) - pushed * np.cos(angle)) / (1 + epsilon * np.cos(angle))
    return gamma, h * np.cos(angle) + (epsilon * gamma + pushed) * np.sin(angle) - h


def repeating(eta, nu, epsilon, n):
    """Phases and velocities that (14) and (15) repeat after n turns."""
    grid = np.linspace(0, TURN, _GRID + 1)
    left = _repeated(eta, nu, epsilon, n, grid)[1]
    if np.abs(left).max() < 1e-9:  # n eta is an integer: all phases, without relative velocity
        return
    for k in np.flatnonzero(np.sign(left[:-1]) * np.sign(left[1:]) < 0):
        low, high = grid[k], grid[k + 1]
        for _ in range(60):
            middle = (low + high) / 2
            same = np.sign(_repeated(eta, nu, epsilon, n, middle)[1]) == np.sign(left[k])
            low, high = (middle, high) if same else (low, middle)
        yield low, _repeated(eta, nu, epsilon, n, low)[0]


def stable(eta, nu, epsilon, n):
    """How many orbits with one impact in n turns are stable; None where that is a near thing."""
    count = 0
    for phi, gamma in repeating(*map(float, (eta, nu, epsilon)), n):
        found = flight(eta, nu, Fraction(phi), epsilon, Fraction(gamma), latest=TURN * n + 1)
        if not isinstance(found, Impact):
            continue
        if abs(float(found.time) - TURN * n) > 1e-5 or float(found.speed) < _LEAST:
            continue
        size = max(abs(np.linalg.eigvals(np.array(found.derivative(), float))))
        if abs(size - 1) < 1e-6:
            return None
        count += size < 1
    return count


def stable_singles(view, rng):
    """One stable orbit for each n that is named, none for the others; and for some greater n."""
    told, more = [], (1, 2, 5) if view.is_complete else ()
    for n in (*range(1, view.most + 1), *(view.most + k for k in more)):
        count = stable(view.eta, view.nu, view.epsilon, n)
        if count not in (None, int(n in view.stable)):
            told.append(f"{count} stable orbits for n = {n}")
    return told
