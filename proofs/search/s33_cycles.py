"""Stable periodic orbits with restitution: simulated, then proved by boxes around their states."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import reduce

from intervals import Undecided
from proofs.motion.simulate import late_state
from proofs.motion.system import System
from proofs.search.evidence import FAILED
from proofs.search.s33_steps import ReboundProver
from proofs.trusted.numbers import TURN
from proofs.trusted.paper.s33_restitution.cycles import StableCycle, stable_cycle
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, size
from proofs.trusted.parameters import Place

_IMPACTS = 200  # until simulated motions are near an orbit
_SAME = 1e-9  # the distance of states that are one
_HALF = 1e-6  # half a side, in phase, of a box around a state
_EDGE = 1e-3  # phases so close to 0 are left alone
_LONGEST = 24  # period
_GRID = 10**12  # states and half sides are multiples of 1 / _GRID
State = tuple[Fraction, Fraction]
Floats = tuple[float, float]


def stable_cycles(
    prover: ReboundProver, epsilon: Fraction, tries: int, period: int | None = None
) -> Iterator[tuple[str, StableCycle]]:
    """Prove the stable orbits of F, of one period or of any, that simulated motions come to."""
    eta, nu = prover.of.eta, prover.of.nu
    at = Place((eta, eta), (nu, nu), (epsilon, epsilon))
    seen: list[Floats] = []
    for states in _candidates(System(eta, nu), float(epsilon), tries):
        known = any(math.dist(states[0], other) < _HALF for other in seen)
        if known or period not in (None, len(states)):
            continue
        seen += states
        with suppress(*FAILED), prover.attempt():
            yield _proved(prover, at, states)


def _proved(prover: ReboundProver, at: Place, states: Sequence[Floats]) -> tuple[str, StableCycle]:
    """Prove a stable orbit (rule stable-cycle).

    The half sides r of the first box are (1 - c M)^-1 (1, 1), M the product of the |DF|, c > 1 so
    that c M still contracts: M r < r / c. Each next box is a little larger than the image.
    """

    def around(state: State, half: State) -> tuple[str, Rebound]:
        phases, velocities = ((x - r, x + r) for x, r in zip(state, half, strict=True))
        return prover.rebound(at, phases, velocities)

    exact = [_state(System(at.eta[0], at.nu[0]), *state) for state in states]
    centres = [around(state, (Fraction(0), Fraction(0))) for state in exact]
    sizes = [[float(size(x)) for row in step.derivative for x in row] for _, step in centres]
    p, q, r, s = reduce(_times, sizes)
    root = (p + s + math.hypot(p - s, 2 * math.sqrt(q * r))) / 2
    if root >= 1:
        raise Undecided("the orbit is not seen to contract")
    more = min(4.0, max(root, 1e-9) ** -0.5)
    across = (1 - more * p) * (1 - more * s) - more * more * q * r
    x, y = (1 - more * (s - q)) / across, (1 - more * (p - r)) / across
    half = _HALF * x / max(x, y), _HALF * y / max(x, y)
    each, halves = more ** (1 / len(states)), [half]
    for p, q, r, s in sizes[:-1]:
        halves.append((each * (p * half[0] + q * half[1]), each * (r * half[0] + s * half[1])))
        half = halves[-1]
    boxes = [
        around(state, (_up(half[0]), _up(half[1])))
        for state, half in zip(exact, halves, strict=True)
    ]
    found = stable_cycle([step for _, step in boxes], [step for _, step in centres])
    names = {"boxes": [name for name, _ in boxes], "centres": [name for name, _ in centres]}
    return prover.plain.add("stable-cycle", names), found


def _times(before: Sequence[float], after: Sequence[float]) -> list[float]:
    """Return the product of two matrices, given by rows: first the one, then the other."""
    (a, b, c, d), (p, q, r, s) = before, after
    return [p * a + q * c, p * b + q * d, r * a + s * c, r * b + s * d]


def _candidates(system: System, epsilon: float, tries: int) -> Iterator[list[Floats]]:
    """Yield about the states of periodic orbits that simulated motions tend to."""
    generator = random.Random(1)
    for _ in range(tries):
        start = generator.uniform(0, math.tau), generator.uniform(0, 0.4)
        state = late_state(system, epsilon, *start, _IMPACTS)
        states: list[Floats] = []
        while state is not None and len(states) < _LONGEST:
            if states and math.dist(state, states[0]) < _SAME:
                break
            states.append(state)
            state = late_state(system, epsilon, *state, 1)
        inside = all(_EDGE < phase < float(TURN) - _EDGE for phase, _ in states)
        if states and state is not None and math.dist(state, states[0]) < _SAME and inside:
            yield states


def _state(system: System, phase: float, speed: float) -> State:
    """Return the phase and the velocity gamma before an impact with this relative speed."""
    rate = float(system.nu) * math.cos(phase)
    gamma = (system.side * speed - rate) / float(system.eta)
    return Fraction(round(phase * _GRID), _GRID), Fraction(round(gamma * _GRID), _GRID)


def _up(value: float) -> Fraction:
    return Fraction(math.ceil(value * _GRID) + 1, _GRID)
