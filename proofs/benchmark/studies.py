"""What each curve does: slope bounds, flights, s_0, coverings, dimensions, orbits.

A maker takes a size (boxes, digits, a step, ...) and returns the task, which returns its error:
the width of what it encloses, or what its bounds exceed the truth by; < 0 if they exclude it.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from intervals import IntervalArray, Undecided
from intervals.taylor import polynomial_range
from proofs.benchmark.peers import OURS, Arithmetic, Range, arithmetic
from proofs.benchmark.curves import Task
from proofs.benchmark.slopes import (
    ETA,
    MONOTONE,
    NU,
    SIGN_BITS,
    Work,
    bounds,
    coefficients,
    excludes,
    thin_time,
)
from proofs.motion import candidate
from proofs.motion.covering import cover_by_impacts
from proofs.motion.image import Image, image
from proofs.motion.impact import HORIZON, FirstImpact, locate
from proofs.motion.kernel import (
    Launches,
    enclose_times,
    exclude_impacts,
    find_times,
    prove_brackets,
)
from proofs.motion.marching import march
from proofs.motion.rebound import rebound
from proofs.motion.slope_cover import cut, grid_of, slope_cover, slope_extremes
from proofs.motion.system import System

Maker = Callable[[float], Task]
SYSTEM = System(ETA, NU)
DOMAINS = ((Fraction("1.11"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32")))
PHASES = tuple(map(Fraction, ("1.11", "1.13", "1.15", "1.27", "1.3", "1.32")))
_EPSILON, _VELOCITIES = Fraction("0.01"), (Fraction("-0.45"), Fraction(0))  # of claim N1
_RATIOS = Fraction("0.1905"), Fraction("0.2381")
_TRUE_DIGITS = 400  # more than are asked of any
_TRUTH = Fraction(1, 10**_TRUE_DIGITS)
_SPARE_BITS = 30
_OPENING = 1e-11  # relative: a bracket that one library proves, another can prove too
_MONOTONE_BOXES = 8
_PERIOD = 4


def bits_for(digits: float) -> int:
    """Return bits for so many digits, with some to spare."""
    return math.ceil(digits * math.log2(10)) + _SPARE_BITS


@cache
def truth(phase: Fraction) -> Image:
    """Return flight, image and slope to more digits than any other here, far above its domain."""
    found = image(SYSTEM, (phase, phase), digits=_TRUE_DIGITS)
    if not isinstance(found, Image):
        raise ArithmeticError(f"there is no single image of {phase}")
    return found


# -- slopes ----------------------------------------------------------------------------------------


def loss(found: Sequence[Range]) -> float:
    """Return by how much bounds of f' on I0 and I1, where f'' > 0, miss its values at the ends."""
    losses = []
    for (low, high), domain in zip(found, DOMAINS, strict=True):
        least, most = (truth(phase).slope for phase in domain)
        losses += [least[1] - low, high - most[0]]
    return float(min(losses)) if min(losses) < 0 else float(max(losses))


@cache
def grids() -> list[list[float]]:
    """Return times before every impact, for each domain: what a scalar proof finds."""
    return [grid_of(cover_by_impacts(SYSTEM, domain)[0]) for domain in DOMAINS]


@cache
def works(boxes: int) -> list[Work]:
    """Return what is given to all; Undecided if the kernel does not find it."""
    loss(DOMAINS)  # the truth: not in anybody's time
    return [work(domain, grid, boxes) for domain, grid in zip(DOMAINS, grids(), strict=True)]


def work(domain: Range, grid: list[float], boxes: int) -> Work:
    """Return the work of one domain."""
    times, cuts = slope_cover(SYSTEM, domain, boxes, grid).times, cut(domain, boxes)
    low, high = times.inf * (1 - _OPENING), times.sup * (1 + _OPENING)
    centres, ends = 0.5 * (cuts[:-1] + cuts[1:]), np.array([float(end) for end in domain])
    first, last = find_times(SYSTEM, ends).tolist()
    return Work(
        domain,
        cuts.tolist(),
        grid,
        list(zip(low.tolist(), high.tolist(), strict=True)),
        find_times(SYSTEM, centres).tolist(),
        (first, last),
    )


def by_bounds(of: Callable[[Work, int], Range], order: int) -> Maker:
    """Return the work in a library that has `bounds`."""

    def make(boxes: float) -> Task:
        given = works(int(boxes))
        return lambda: loss([of(one, order) for one in given])

    return make


def by_library(library: str, order: int, digits: float | None = None) -> Maker:
    """Return the work box by box at so many digits, signs to 53 bits; binary64 for None."""
    of = arithmetic(library, SIGN_BITS if digits is None else bits_for(digits))
    signs = arithmetic(library, SIGN_BITS)
    return by_bounds(lambda work, order: bounds(of, signs, work, order), order)


def monotone(library: str) -> Maker:
    """Return f'' > 0 on 8 boxes and f' at the ends, its size the digits."""
    return lambda digits: by_library(library, MONOTONE, digits)(_MONOTONE_BOXES)


def by_arrays(order: int) -> Maker:
    """Return the work for all boxes at once, in binary64."""
    return by_bounds(_at_once, order)


def _at_once(given: Work, order: int) -> Range:
    of = replace(arithmetic(OURS, SIGN_BITS), number=lambda low, high: low)  # exact numbers
    cuts = np.array(given.cuts)
    launches = Launches(SYSTEM, IntervalArray.from_floats(cuts[:-1], cuts[1:]))
    exclude_impacts(launches, given.grid)
    last = np.full(len(cuts) - 1, given.grid[-1])
    low, high = np.array(given.brackets).T
    prove_brackets(launches, last, low, high)
    times = IntervalArray.from_floats(low, high)
    over = coefficients(of, launches.phases, times, order)
    found = over[0]
    if order:
        centre, about = launches.centre, np.array(given.centres)
        thin = enclose_times(centre, last, (about, about))
        at = coefficients(of, centre.phases, thin, order - 1)
        found = polynomial_range([*at, over[order]], launches.offset)
    return Fraction(float(found.inf.min())), Fraction(float(found.sup.max()))


def extremes(_: float) -> Task:
    """Return our bounds by monotonicity in binary64."""

    def task() -> float:
        found = [slope_extremes(SYSTEM, domain) for domain in DOMAINS]
        return loss([(Fraction(x.minimum[0]), Fraction(x.maximum[1])) for x in found])

    return task


def main_job_slopes(digits: float) -> Task:
    """Return what the main job does: it is given nothing, and keeps the witness."""
    from proofs.search.steps import Prover

    def task() -> float:
        provers = (Prover(SYSTEM, int(digits), HORIZON).slopes(list(d))[1] for d in DOMAINS)
        pieces = [one.pieces for one in provers]
        return loss([(min(x for x, _ in one), max(y for _, y in one)) for one in pieces])

    return task


# -- flights ---------------------------------------------------------------------------------------


def width(found: Sequence[Range]) -> float:
    """Return the largest width of enclosures of the six times; -1 if one excludes the truth."""
    for (low, high), phase in zip(found, PHASES, strict=True):
        least, most = truth(phase).flight
        if not (low <= most and least <= high):
            return -1.0
    return float(max(high - low for low, high in found))


def deviation(found: Sequence[float | None]) -> float:
    """Return the largest error of six approximate times; Undecided where there is none."""
    errors = []
    for time, phase in zip(found, PHASES, strict=True):
        if time is None:
            raise Undecided("no impact was found")
        errors.append(abs(float(Fraction(time) - truth(phase).flight[0])))
    return max(errors)


def images(digits: float) -> Task:
    """Return the certified map, which is given the phase alone."""

    def task() -> float:
        found = [image(SYSTEM, (phase, phase), digits=int(digits)) for phase in PHASES]
        return width([one.flight for one in found if isinstance(one, Image)])

    return task


@cache
def _impacts() -> tuple[FirstImpact, ...]:
    return tuple(locate(SYSTEM, (phase, phase)) for phase in PHASES)


def flights(library: str) -> Maker:
    """Return: exclude impacts on given grids at 53 bits, then time and f' at so many digits."""

    def make(digits: float) -> Task:
        of, signs = arithmetic(library, bits_for(digits)), arithmetic(library, SIGN_BITS)
        known = zip(PHASES, _impacts(), strict=True)
        grids = {phi: [float(t) for t in one.times[1:] if t <= one.window[0]] for phi, one in known}

        def time(phase: Fraction) -> Range:
            with signs.precision():
                if not excludes(signs, [signs.point(phase)], grids[phase]):
                    raise Undecided("an earlier impact is not excluded")
            about = candidate.next_impact(SYSTEM, float(phase))
            with of.precision():
                phi = of.point(phase)
                found = thin_time(of, phi, about[0] if about else 0.0)
                coefficients(of, phi, found, 0)
                return of.ends(found)

        return lambda: width([time(phase) for phase in PHASES])

    return make


def marches(step: float) -> Task:
    """Return algorithm A.1 as the paper prints it."""
    return lambda: deviation([march(SYSTEM, float(phase), step) for phase in PHASES])


def floats(_: float) -> Task:
    """Return the search in floating point by steps that pass no zero."""

    def task() -> float:
        found = [candidate.next_impact(SYSTEM, float(phase)) for phase in PHASES]
        return deviation([None if one is None else one[0] for one in found])

    return task


def solved(method: str) -> Maker:
    """Return the simulation that one would write with scipy: mass as an ODE, table as an event."""
    eta, nu = float(ETA), float(NU)

    def time(phase: float, tolerance: float) -> float | None:
        from scipy.integrate import solve_ivp  # type: ignore[import, unused-ignore]

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
            max_step=1.0,  # the table turns once in 6.28
        )
        events = [t for t in found.t_events[0] if t > 0.25]  # before is the launch itself
        return float(events[0]) if events else None

    return lambda tolerance: lambda: deviation([time(float(x), tolerance) for x in PHASES])


# -- s_0, coverings, dimensions, orbits ------------------------------------------------------------


def moran(digits: float) -> Task:
    """Return our bracket of the root s_0 of r0^s + r1^s = 1 at the printed ratios."""
    from proofs.methods.moran import moran_root

    def task() -> float:
        low, high = moran_root(_RATIOS, bits_for(digits))
        return float(high - low)

    return task


def moran_by(library: str) -> Maker:
    """Return the algorithm of `moran_root` in another library."""

    def make(digits: float) -> Task:
        bits = bits_for(digits)
        of = arithmetic(library, bits + 30)

        def task() -> float:
            with of.precision():
                low, high = root_of_moran(of, _RATIOS, Fraction(1, 2**bits))
            return float(high - low)

        return task

    return make


def root_of_moran(of: Arithmetic, ratios: Range, unit: Fraction) -> Range:
    """Bracket the root of r0^s + r1^s = 1 by about 2 units: Newton's method from 0, two signs."""
    logs = [of.log(of.point(ratio)) for ratio in ratios]

    def excess(s: Any) -> Any:
        return of.exp(logs[0] * s) + of.exp(logs[1] * s) - 1

    s, small, step = of.point(0), of.point(unit), of.point(1)
    while not (of.positive(small - step) and of.positive(small + step)):
        tilt = logs[0] * of.exp(logs[0] * s) + logs[1] * of.exp(logs[1] * s)
        step = of.middle(excess(s) / tilt)
        s = of.middle(s - step)
    if not (of.positive(excess(s - small)) and of.positive(-excess(s + small))):
        raise Undecided("the bracket of s_0 has not the signs it must have")
    return of.ends(s - small)[0], of.ends(s + small)[1]


def coverings(pieces: float) -> Task:
    """Return the images of the vertical edges of V1 and V2, cut into pieces: N1's step.

    The error is by how much the enclosures of the image phases exceed those of the edge's ends:
    at most the overestimate, and all of it where F is monotone on the edge.
    """
    count, (low, high) = int(pieces), _VELOCITIES
    cuts = [low + (high - low) * j / count for j in range(count + 1)]

    def phases(phi: Fraction, pairs: Sequence[Range]) -> Range:
        found = [rebound(SYSTEM, (phi, phi), pair, _EPSILON).phase for pair in pairs]
        return min(x for x, _ in found), max(y for _, y in found)

    edges = [phi for domain in DOMAINS for phi in domain]
    corners = {phi: phases(phi, [(low, low), (high, high)]) for phi in edges}

    def task() -> float:
        losses = []
        for phi, (least, most) in corners.items():
            first, last = phases(phi, list(pairwise(cuts)))
            losses += [least - first, last - most]
        return float(max(losses))

    return task


def dimensions(digits: float) -> Task:
    """Return the command that proves both Hausdorff dimensions to so many digits."""

    def task() -> float:
        with TemporaryDirectory() as folder:
            options = ["--digits", str(int(digits)), "--no-check", "--out", folder, "--json", "-"]
            command = [sys.executable, "-m", "proofs.dimension", *options]
            found = subprocess.run(command, capture_output=True, check=True, text=True).stdout
        quantities = json.loads(found)["claims"][0]["quantities"]
        both = [quantities[name] for name in ("dimension", "dimension_of_I")]
        return float(max(Fraction(one["upper"]) - Fraction(one["lower"]) for one in both))

    return task


def orbits(digits: int | None) -> Maker:
    """Return all periodic points of a horseshoe that is proved before, by number of words."""
    from proofs import orbits
    from proofs.methods.orbits import periodic_points
    from proofs.methods.words import Words

    of = orbits.horseshoe(orbits.parameters())

    def make(words: float) -> Task:
        given = Words.of_length(int(words).bit_length() - 1)

        def task() -> float:
            points = periodic_points(of, given, digits)
            return float(max(one.point[1] - one.point[0] for one in points))

        return task

    return make


def four_orbits(digits: float) -> Task:
    """Return all periodic points of period 4, to so many digits."""
    return orbits(int(digits))(2**_PERIOD)
