"""Work-precision at points: flights, the marching algorithm, s_0, coverings."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from itertools import pairwise
from typing import Any

from intervals import Undecided
from proofs.benchmark import horseshoe_flint
from proofs.benchmark.arithmetics import Arithmetic
from proofs.benchmark.curves import Budget, Curve, Maker, Task, sweep
from proofs.benchmark.horseshoe import SYSTEM
from proofs.benchmark.operations import SCALAR
from proofs.benchmark.peers import FLINT, IV
from proofs.benchmark.slope_curves import arithmetic, at_bits, bits_for
from proofs.benchmark.slope_forms import coefficients, exclude, thin_time
from proofs.motion import candidate
from proofs.motion.image import Image, image
from proofs.motion.impact import FirstImpact, locate
from proofs.motion.marching import march
from proofs.motion.restitution import Rebounds, next_impact
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import PAPER

PHASES = tuple(map(Fraction, ("1.11", "1.13", "1.15", "1.27", "1.3", "1.32")))
_COARSE_BITS = 53
_FLIGHTS = "6 flights, I0 and I1"
_TRUE_DIGITS = 400  # more than are asked of any
_LONGEST_STEP = 1.0  # of the ODE solver: the table turns once in 6.28
_LAUNCHED = 0.25  # an event before is the launch itself


# -- flights ---------------------------------------------------------------------------------------


@cache
def _impacts() -> tuple[FirstImpact, ...]:
    return tuple(locate(SYSTEM, (phase, phase)) for phase in PHASES)


@cache
def _true_flights() -> list[Fraction]:
    found = [image(SYSTEM, (phase, phase), digits=_TRUE_DIGITS) for phase in PHASES]
    return [(one.flight[0] + one.flight[1]) / 2 for one in found if isinstance(one, Image)]


def _width(found: Sequence[Range]) -> float:
    """Return the largest width of enclosures of the six times; -1 if one excludes the truth."""
    if not all(
        low <= time + Fraction(1, 10**_TRUE_DIGITS) and time - Fraction(1, 10**_TRUE_DIGITS) <= high
        for (low, high), time in zip(found, _true_flights(), strict=True)
    ):
        return -1.0
    return float(max(high - low for low, high in found))


def _deviation(found: Sequence[float | None]) -> float:
    """Return the largest error of six approximate times; Undecided where there is none."""
    times = [time for time in found if time is not None]
    if len(times) < len(PHASES):
        raise Undecided("no impact was found")
    pairs = zip(times, _true_flights(), strict=True)
    return max(abs(float(Fraction(x) - time)) for x, time in pairs)


def flights(
    budget: Budget, digits: Sequence[float], steps: Sequence[float], flint: bool
) -> list[Curve]:
    """Measure six flight times: certified, by peers, by A.1, by an ODE solver, by floats."""
    _true_flights(), _impacts()  # not in anybody's time
    names = (SCALAR, FLINT, IV) if flint else (SCALAR, IV)
    makers: dict[str, tuple[Curve, Maker]] = {
        name: (
            Curve(_FLIGHTS, f"the grid given, {name}", "digits", [], "time"),
            partial(_flights_by, name),
        )
        for name in names
    }
    certified = Curve(_FLIGHTS, "certified map (model.image)", "digits", against="time")
    makers[""] = certified, _images
    found = sweep(makers, digits, budget)
    marched = Curve(_FLIGHTS, "algorithm A.1", "step", proved=False, least=0.8)
    found += sweep({"": (marched, _marches)}, steps, budget)
    for point in (*marched.measured[:1], *marched.measured[-1:]):  # names of all would overlap
        point.note = f"step {point.size:g}"
    floats = Curve(_FLIGHTS, "floating point, steps that pass no zero", "run", proved=False)
    found += sweep({"": (floats, _floats)}, (1,), budget)
    return found + _solved(budget)


def _images(digits: float) -> Task:
    def task() -> float:
        found = [image(SYSTEM, (phase, phase), digits=int(digits)) for phase in PHASES]
        return _width([one.flight for one in found if isinstance(one, Image)])

    return task


def _flights_by(name: str, digits: float) -> Task:
    """Return: exclude impacts on the grids at 53 bits, then time and f' at so many digits."""
    bits = bits_for(digits)
    of, coarse = arithmetic(name, bits), arithmetic(name, _COARSE_BITS)

    def one(phase: Fraction, found: FirstImpact) -> Range:
        grid = [float(time) for time in found.times[1:] if time <= found.window[0]]
        exclude(coarse, SYSTEM, [coarse.number(phase, phase)], grid)
        about = candidate.next_impact(SYSTEM, float(phase))
        with at_bits(name, bits):
            phi = of.number(phase, phase)
            time = thin_time(of, SYSTEM, phi, about[0] if about else 0.0)
            coefficients(of, SYSTEM, phi, time, 0)
            return of.ends(time)

    return lambda: _width([one(*pair) for pair in zip(PHASES, _impacts(), strict=True)])


def _marches(step: float) -> Task:
    return lambda: _deviation([march(SYSTEM, float(phase), step) for phase in PHASES])


def _floats(_: float) -> Task:
    def task() -> float:
        found = [candidate.next_impact(SYSTEM, float(phase)) for phase in PHASES]
        return _deviation([None if one is None else one[0] for one in found])

    return task


def has_scipy() -> bool:
    """Whether scipy is installed."""
    return importlib.util.find_spec("scipy") is not None


def _solved(budget: Budget) -> list[Curve]:
    """Measure scipy's solve_ivp with an event at the impact, at several tolerances."""
    if not has_scipy():
        return []
    makers: dict[str, tuple[Curve, Maker]] = {
        method: (
            Curve(_FLIGHTS, f"scipy solve_ivp, {method}", "tolerance", against="", proved=False),
            partial(_solve, method),
        )
        for method in ("RK45", "DOP853")
    }
    return sweep(makers, (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13), budget)


def _solve(method: str, tolerance: float) -> Task:
    """Return the simulation that one would write: mass as an ODE, table as an event."""
    from scipy.integrate import solve_ivp  # type: ignore[import, unused-ignore]

    eta, nu = float(horseshoe_flint.ETA), float(horseshoe_flint.NU)

    def time_of(phase: float) -> float | None:
        def below(t: float, y: Any) -> float:
            return 1 + nu * math.sin(phase + t) - float(y[0])

        below.terminal, below.direction = True, -1  # type: ignore[attr-defined]
        found = solve_ivp(
            lambda _, y: (y[1], -eta * eta * y[0]),
            (0.0, 200.0),
            (1 + nu * math.sin(phase), nu * math.cos(phase)),
            method=method,
            events=below,
            rtol=tolerance,
            atol=tolerance,
            max_step=_LONGEST_STEP,
        )
        events = [time for time in found.t_events[0] if time > _LAUNCHED]
        return float(events[0]) if events else None

    return lambda: _deviation([time_of(float(phase)) for phase in PHASES])


# -- s_0, coverings --------------------------------------------------------------------------------


def moran(budget: Budget, digits: Sequence[float], flint: bool) -> list[Curve]:
    """Measure brackets of s_0."""
    from proofs.methods.moran import moran_root

    ratios = PAPER.moran_ratios

    def ours(d: float) -> Task:
        def task() -> float:
            low, high = moran_root(ratios, bits_for(d))
            return float(high - low)

        return task

    names = (FLINT, IV) if flint else (IV,)
    makers: dict[str, tuple[Curve, Maker]] = {
        name: (
            Curve("s_0", name, "digits", against="time"),
            partial(_moran_by, name, ratios),
        )
        for name in names
    }
    own = Curve("s_0", "methods.moran", "digits", against="time")
    return sweep({"": (own, ours), **makers}, digits, budget)


def _moran_by(name: str, ratios: Range, digits: float) -> Task:
    """Return the algorithm of `moran_root` in another library."""
    bits = bits_for(digits)
    of = arithmetic(name, bits + 30)

    def task() -> float:
        with at_bits(name, bits + 30):
            low, high = root_of_moran(of, ratios, Fraction(1, 2**bits))
        return float(high - low)

    return task


def root_of_moran(of: Arithmetic, ratios: Range, unit: Fraction) -> Range:
    """Bracket the root of r0^s + r1^s = 1 by about 2 units: Newton's method from 0, two signs."""
    logs = [of.log(of.number(ratio, ratio)) for ratio in ratios]

    def excess(s: Any) -> Any:
        return of.exp(logs[0] * s) + of.exp(logs[1] * s) - 1

    s, small = of.number(0, 0), of.number(unit, unit)
    while True:
        tilt = logs[0] * of.exp(logs[0] * s) + logs[1] * of.exp(logs[1] * s)
        step = of.middle(excess(s) / tilt)
        s = of.middle(s - step)
        if of.positive(small - step) and of.positive(small + step):
            break
    if not (of.positive(excess(s - small)) and of.positive(-excess(s + small))):
        raise Undecided("the bracket of s_0 has not the signs it must have")
    return of.ends(s - small)[0], of.ends(s + small)[1]


def coverings(budget: Budget, pieces: Sequence[float]) -> list[Curve]:
    """Measure the images of the four vertical edges of V1 and V2, cut into pieces: N1's step.

    The error is by how much the enclosures of the image phases exceed those of the edge's ends:
    at most the overestimate, and all of it where F is monotone on the edge.
    """
    velocities = PAPER.velocities
    if velocities is None or PAPER.epsilon is None:
        raise ValueError("the paper prints rectangles and epsilon")
    low, high = velocities
    epsilon = PAPER.epsilon, PAPER.epsilon
    edges = (*PAPER.left, *PAPER.right)

    def phases(phi: Fraction, gammas: Range, bits: int) -> Range:
        flight = Rebounds(SYSTEM, (phi, phi), velocities=gammas, epsilon=epsilon)
        found = next_impact(replace(flight, precision=bits), bits=bits)
        return found.phase

    @cache
    def true(phi: Fraction) -> Range:
        ends = [phases(phi, (gamma, gamma), 100) for gamma in (low, high)]
        return min(x for x, _ in ends), max(y for _, y in ends)

    def make(bits: int) -> Maker:
        def of_size(n: float) -> Task:
            count = int(n)
            cuts = [low + (high - low) * j / count for j in range(count + 1)]

            def task() -> float:
                losses = []
                for phi in edges:
                    found = [phases(phi, pair, bits) for pair in pairwise(cuts)]
                    losses.append(true(phi)[0] - min(x for x, _ in found))
                    losses.append(max(y for _, y in found) - true(phi)[1])
                return float(max(losses))

            return task

        return of_size

    for phi in edges:
        true(phi)  # not in anybody's time
    title = "edges of V1, V2 at epsilon = 0.01"
    makers: dict[str, tuple[Curve, Maker]] = {
        str(bits): (Curve(title, f"images, {bits} bits", "pieces"), make(bits))
        for bits in (64, 200)
    }
    return sweep(makers, pieces, budget)
