"""Stable periodic orbits with restitution: simulated, then proved by boxes around their states."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction

from intervals import Undecided
from proofs.methods.lemmas import inverse
from proofs.motion.simulate import TURNS, landing
from proofs.motion.system import System
from proofs.search.evidence import FAILED
from proofs.search.s33_steps import ReboundProver, function_of
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import rational
from proofs.trusted.kernel.covers import images
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.enclose import Matrix, enclosed, point_box
from proofs.trusted.kernel.parametric import moved
from proofs.trusted.kernel.periodic import Closing, derivative, less_one
from proofs.trusted.kernel.rates import size
from proofs.trusted.kernel.stable import StableCycle, minus_one
from proofs.trusted.kernel.zeros import Rows
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.oscillator import Oscillator
from proofs.trusted.parameters import Place

_IMPACTS = 200  # until simulated motions are near an orbit
_SAME = 1e-9  # the distance of states that are one
_HALF = 1e-6  # half a side, in phase, of a box around a state
_EDGE = 1e-3  # phases so close to 0 are left alone
_LONGEST = 24  # period
_MOST_ROUNDS = 8  # of an orbit, until F contracts a box
_NEWTON = 3  # steps
_BITS = 128
_GRID = 10**12  # states and half sides are multiples of 1 / _GRID
State = tuple[Fraction, Fraction]
Floats = tuple[float, float]


def stable_cycles(
    prover: ReboundProver, epsilon: Fraction, tries: int, period: int | None = None
) -> Iterator[tuple[str, StableCycle]]:
    """Prove the stable orbits of F, of one period or of any, that simulated motions come to."""
    eta, nu = prover.of.eta, prover.of.nu
    at = Place.restituting(eta, nu, epsilon)
    seen: list[Floats] = []
    for states in _candidates(System(eta, nu), float(epsilon), tries):
        again = any(math.dist(states[0], other) < _HALF for other in seen)
        if again or period not in (None, len(states)):
            continue
        seen += states
        for rounds in range(1, _MOST_ROUNDS + 1):
            with suppress(*FAILED), prover.attempt():
                state = state_before(System(eta, nu), *states[0])
                yield prove_cycle(prover, at, state, len(states), rounds)
                break


def prove_cycle(
    prover: ReboundProver, at: Place, state: State, period: int, rounds: int = 1
) -> tuple[str, StableCycle]:
    """Prove a stable orbit near a state, for all oscillators of a box (rule stable-cycle).

    The half sides r of the first box are (1 - c |D|)^-1 (c s + h (1, 1)), D the derivative of F^n,
    s how far F^n leads from the state, c > 1 so that c |D| still contracts: c (s + |D| r) < r.
    n is the period times `rounds`: more than one where F turns states around the orbit.
    """
    map_, count = Oscillator(at.sides), period * rounds
    *points, end = images(map_, enclosed(point_box(state), _BITS), count + 1)
    turns = round(float(end[0].range[0] - state[0]) / math.tau / rounds)
    ((p, q), (r, s)), root = _sizes(derivative(map_, points))
    if root >= 1:
        raise Undecided("the orbit is not seen to contract")
    more = min(4.0, max(root, 1e-9) ** -0.5)
    across = (1 - more * p) * (1 - more * s) - more * more * q * r

    def box(x: float, y: float) -> Floats:
        return (
            ((1 - more * s) * x + more * q * y) / across,
            (more * r * x + (1 - more * p) * y) / across,
        )

    closing = Closing(map_, count, (rounds * turns,))
    defect = moved(closing, points[0])
    rows = [[rational(x, _BITS) for x in row] for row in minus_one(2)]
    away = [more * float(size(defect.combined(row).range)) for row in rows]
    least, reach = box(1, 1), box(away[0], away[1])
    half = [rounded(_HALF * x / max(least) + y) for x, y in zip(least, reach, strict=True)]
    around = [texts((x - r, x + r)) for x, r in zip(state, half, strict=True)]
    matrix = minus_one(2) if rounds == 1 else _newton(derivative(map_, points[:period]))
    orbit = {
        "function": function_of(at),
        "period": str(period),
        "box": around,
        "matrix": [[str(x) for x in row] for row in matrix],
        "turns": [str(turns)],
    }
    return prover.derive("stable-cycle", {"orbit": orbit, "rounds": str(rounds)})


def _newton(matrix: Matrix) -> Rows:
    """Return about the inverse of D - 1."""
    slopes = less_one(matrix)
    middles = tuple(tuple(sum(x.range, Fraction(0)) / 2 for x in row) for row in slopes)
    return [[Fraction(round(x * _GRID), _GRID) for x in row] for row in inverse(middles)]


def seen_from(at: Place, state: State, period: int) -> tuple[State, float]:
    """Return about the orbit's state near another, by Newton's method, and how F contracts there.

    That is the spectral radius of |D|, D the derivative of F^n; in floating point.
    """
    import numpy as np

    eta, nu, epsilon = (low for low, _ in at.sides)
    system, (phase, gamma) = System(eta, nu), map(float, state)
    for _ in range(_NEWTON):
        here, product = (phase, gamma), np.eye(2)
        for _ in range(period):
            after = landing(system, float(epsilon), *here, math.tau * TURNS)
            if after is None:
                raise Undecided("the orbit is lost")
            product = np.array(after.derivative) @ product
            here = after.phase, after.velocity
        away = np.subtract(here, (phase, gamma))
        step = np.linalg.solve(np.eye(2) - product, away)
        phase, gamma = phase + float(step[0]), gamma + float(step[1])
    root = float(max(abs(np.linalg.eigvals(abs(product)))))
    return (rounded(phase), rounded(gamma)), root


def _sizes(matrix: Matrix) -> tuple[list[list[float]], float]:
    """Return about |D|, the largest absolute values of entries, and its spectral radius."""
    (p, q), (r, s) = product = [[float(size(entry.range)) for entry in row] for row in matrix]
    return product, (p + s + math.hypot(p - s, 2 * math.sqrt(q * r))) / 2


def around_image(step: Differential) -> list[Range]:
    """Return a box of states, short numbers, that contains the image of another one."""
    return [(-rounded(-low), rounded(high)) for low, high in step.values]


def _candidates(system: System, epsilon: float, tries: int) -> Iterator[list[Floats]]:
    """Yield about the states of periodic orbits that simulated motions tend to."""
    from proofs.motion.transients import GOING, Motions, random_impacts

    motions, path = Motions(system, epsilon, random_impacts(tries)), []
    motions.follow(_IMPACTS)
    for _ in range(_LONGEST + 1):
        path.append([*zip(motions.phases.tolist(), motions.speeds.tolist(), strict=True)])
        motions.follow(1)
    for states, kind in zip(zip(*path, strict=True), motions.kinds, strict=True):
        back = (k for k in range(1, len(path)) if math.dist(states[k], states[0]) < _SAME)
        orbit = [*states[: next(back, 0)]]
        inside = all(_EDGE < phase < float(TURN) - _EDGE for phase, _ in orbit)
        if kind == GOING and orbit and inside:
            yield orbit


def state_before(system: System, phase: float, speed: float) -> State:
    """Return the phase and the velocity gamma before an impact with this relative speed."""
    rate = float(system.nu) * math.cos(phase)
    gamma = (system.side * speed - rate) / float(system.eta)
    return Fraction(round(phase * _GRID), _GRID), Fraction(round(gamma * _GRID), _GRID)


def rounded(value: Fraction | float) -> Fraction:
    """Round up to a multiple of 1 / _GRID."""
    return Fraction(math.ceil(Fraction(value) * _GRID), _GRID)
