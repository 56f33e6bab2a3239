"""What the curves do: the task of a size, which returns its error, < 0 if it excludes the truth."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from dataclasses import replace
from fractions import Fraction
from functools import cache
from io import StringIO
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from intervals import IntervalArray, Undecided
from intervals.taylor import polynomial_range
from proofs.benchmark.curves import Task
from proofs.benchmark.peers import OURS, Range, arithmetic
from proofs.benchmark.slopes import (
    ETA,
    MONOTONE,
    NU,
    Work,
    bounds,
    coefficients,
    exclude,
    first_impact,
)
from proofs.motion import candidate, kernel
from proofs.motion.covering import cover_by_impacts
from proofs.motion.image import Image, image
from proofs.motion.impact import HORIZON, locate
from proofs.motion.marching import march
from proofs.motion.slope_cover import cut, grid_of, slope_cover, slope_extremes
from proofs.motion.system import System

SYSTEM = System(ETA, NU)
DOMAINS = ((Fraction("1.11"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32")))
PHASES = tuple(map(Fraction, ("1.11", "1.13", "1.15", "1.27", "1.3", "1.32")))
_TRUE_DIGITS = 400  # more than are asked of any
_SIGN_BITS = 53
_OPENING = 1e-11  # relative: a bracket that one library proves, another can prove too
_MONOTONE_BOXES = 8


def bits_for(digits: float) -> int:
    """Return bits for so many digits, with some to spare."""
    return math.ceil(digits * math.log2(10)) + 30


@cache
def truth(phase: Fraction) -> Image:
    """Return flight, image and slope to more digits than any other here."""
    found = image(SYSTEM, (phase, phase), digits=_TRUE_DIGITS)
    if not isinstance(found, Image):
        raise ArithmeticError(f"there is no single image of {phase}")
    return found


# -- slopes ----------------------------------------------------------------------------------------


def loss(found: Sequence[Range]) -> float:
    """Return by how much bounds of f' on I0 and I1, where f'' > 0, miss its values at the ends."""
    losses = []
    for (low, high), ends in zip(found, DOMAINS, strict=True):
        least, most = (truth(end).slope for end in ends)
        losses += [least[1] - low, high - most[0]]
    return float(min(losses)) if min(losses) < 0 else float(max(losses))


@cache
def grids() -> list[list[float]]:
    """Return times before every impact, for each domain: what a scalar proof finds."""
    return [grid_of(cover_by_impacts(SYSTEM, domain)[0]) for domain in DOMAINS]


@cache
def works(boxes: int) -> list[Work]:
    """Return what is given to all; Undecided if the kernel does not find it."""
    loss(DOMAINS)  # finds the truth, not in anybody's time
    return [work(domain, grid, boxes) for domain, grid in zip(DOMAINS, grids(), strict=True)]


def work(domain: Range, grid: list[float], boxes: int) -> Work:
    """Return the work of one domain."""
    times, cuts = slope_cover(SYSTEM, domain, boxes, grid).times, cut(domain, boxes)
    low, high = times.inf * (1 - _OPENING), times.sup * (1 + _OPENING)
    brackets = list(zip(low.tolist(), high.tolist(), strict=True))
    centres = kernel.find_times(SYSTEM, 0.5 * (cuts[:-1] + cuts[1:])).tolist()
    ends = kernel.find_times(SYSTEM, np.array([float(end) for end in domain])).tolist()
    return Work(domain, cuts.tolist(), grid, brackets, centres, ends)


def by_bounds(of: Callable[[Work, int], Range], order: int) -> Callable[[float], Task]:
    """Return the work at numbers of boxes, by what bounds f' on one domain."""

    def make(boxes: float) -> Task:
        given = works(int(boxes))
        return lambda: loss([of(one, order) for one in given])

    return make


def by_library(library: str, order: int, digits: float | None) -> Callable[[float], Task]:
    """Return the work box by box, to so many digits or in binary64, signs to 53 bits."""
    of = arithmetic(library, _SIGN_BITS if digits is None else bits_for(digits))
    signs = arithmetic(library, _SIGN_BITS)
    return by_bounds(lambda work, order: bounds(of, signs, work, order), order)


def monotone(library: str) -> Callable[[float], Task]:
    """Return f'' > 0 on 8 boxes and f' at the ends, at numbers of digits."""
    return lambda digits: by_library(library, MONOTONE, digits)(_MONOTONE_BOXES)


def at_once(given: Work, order: int) -> Range:
    """Do the work for all boxes at once, in arrays of binary64."""
    of = replace(arithmetic(OURS, _SIGN_BITS), number=lambda low, high: low)  # exact numbers
    cuts, about = np.array(given.cuts), np.array(given.centres)
    launches = kernel.Launches(SYSTEM, IntervalArray.from_floats(cuts[:-1], cuts[1:]))
    kernel.exclude_impacts(launches, given.grid)
    last = np.full(len(cuts) - 1, given.grid[-1])
    low, high = np.array(given.brackets).T
    kernel.prove_brackets(launches, last, low, high)
    terms = coefficients(of, launches.phases, IntervalArray.from_floats(low, high), order)
    if order:
        thin = kernel.enclose_times(launches.centre, last, (about, about))
        terms[:-1] = coefficients(of, launches.centre.phases, thin, order - 1)
    found = polynomial_range(terms, launches.offset) if order else terms[0]
    return Fraction(float(found.inf.min())), Fraction(float(found.sup.max()))


def excluded_at_once(boxes: float) -> Task:
    """Return the exclusion of all earlier impacts, in arrays; it has no error."""
    given = works(int(boxes))

    def task() -> float:
        for one in given:
            cuts = np.array(one.cuts)
            box = IntervalArray.from_floats(cuts[:-1], cuts[1:])
            kernel.exclude_impacts(kernel.Launches(SYSTEM, box), one.grid)
        return 0.0

    return task


def excluded(library: str) -> Callable[[float], Task]:
    """Return the same, box by box in a library."""

    def make(boxes: float) -> Task:
        of, given = arithmetic(library, _SIGN_BITS), works(int(boxes))

        def task() -> float:
            for one in given:
                exclude(of, [of.number(*ends) for ends in pairwise(one.cuts)], one.grid)
            return 0.0

        return task

    return make


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


def deviation(times: Sequence[float | None]) -> float:
    """Return the largest error of six approximate times; Undecided where there is none."""
    known = [(time, phase) for time, phase in zip(times, PHASES, strict=True) if time is not None]
    if len(known) < len(PHASES):
        raise Undecided("no impact was found")
    return max(abs(float(Fraction(time) - truth(phase).flight[0])) for time, phase in known)


def images(digits: float) -> Task:
    """Return the certified map, which is given the phase alone."""

    def task() -> float:
        found = [image(SYSTEM, (phase, phase), digits=int(digits)) for phase in PHASES]
        return width([one.flight for one in found if isinstance(one, Image)])

    return task


@cache
def _launches() -> list[tuple[Fraction, list[float], float]]:
    """Return the phases, times before each impact, and about the time of it."""
    found = []
    for phase in PHASES:
        impact, about = locate(SYSTEM, (phase, phase)), candidate.next_impact(SYSTEM, float(phase))
        grid = [float(time) for time in impact.times[1:] if time <= impact.window[0]]
        found.append((phase, grid, about[0] if about else 0.0))
    return found


def flights(library: str) -> Callable[[float], Task]:
    """Return: exclude impacts on given grids at 53 bits, then time and f' at so many digits."""

    def make(digits: float) -> Task:
        of, signs = arithmetic(library, bits_for(digits)), arithmetic(library, _SIGN_BITS)
        return lambda: width([first_impact(of, signs, *one) for one in _launches()])

    return make


def marches(step: float) -> Task:
    """Return algorithm A.1 as the paper prints it."""
    return lambda: deviation([march(SYSTEM, float(phase), step) for phase in PHASES])


def floats(_: float) -> Task:
    """Return the search in floating point by steps that pass no zero."""

    def task() -> float:
        found = [candidate.next_impact(SYSTEM, float(phase)) for phase in PHASES]
        return deviation([one and one[0] for one in found])

    return task


def solved(method: str) -> Callable[[float], Task]:
    """Return the simulation that one would write with scipy: mass as an ODE, table as an event."""
    eta, nu = float(ETA), float(NU)

    def time(phase: float, tolerance: float) -> float | None:
        from scipy.integrate import solve_ivp  # type: ignore[import, unused-ignore]

        def below(t: float, y: Any) -> float:
            return 1 + nu * math.sin(phase + t) - float(y[0])

        below.terminal, below.direction = True, -1  # type: ignore[attr-defined]
        start, accuracy = (1 + nu * math.sin(phase), nu * math.cos(phase)), (tolerance, tolerance)
        found = solve_ivp(
            lambda _, y: (y[1], -eta * eta * y[0]), (0.0, 200.0), start, method, events=below,
            max_step=1.0, **dict(zip(("rtol", "atol"), accuracy, strict=True)),
        )  # fmt: skip
        events = [t for t in found.t_events[0] if t > 0.25]  # before is the launch itself
        return float(events[0]) if events else None

    return lambda tolerance: lambda: deviation([time(float(x), tolerance) for x in PHASES])


# -- whole proofs ----------------------------------------------------------------------------------


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


def orbits(words: float, digits: int | None) -> Task:
    """Return all periodic points of a period, by the number of words, of a proved horseshoe."""
    from proofs.methods.orbits import periodic_points
    from proofs.methods.words import Words

    of, given = _horseshoe(), Words.of_length(int(words).bit_length() - 1)

    def task() -> float:
        points = periodic_points(of, given, digits)
        return float(max(one.point[1] - one.point[0] for one in points))

    return task


def checked(certificate: Path) -> Task:
    """Return the check of a certificate in this process, for its exit status."""
    from proofs import check

    def task() -> float:
        with redirect_stdout(StringIO()):
            return check.main([str(certificate)])

    return task


@cache
def _horseshoe() -> Any:
    from proofs import orbits
    from proofs.trusted.facts import PAPER

    whole, least = (orbits.LEFT[0], orbits.RIGHT[1]), (Fraction(1), Fraction(1))
    sets = replace(PAPER, left=orbits.LEFT, right=orbits.RIGHT, interval=whole)
    return orbits.horseshoe(replace(sets, slopes=least, ratios=None, printed_s0=None))
