"""What the curves do at a size: each does its work and returns the error, < 0 if it is wrong."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from intervals import Undecided
from intervals.rounding import float_down, float_up
from proofs.benchmark.peers import Range, arithmetic
from proofs.benchmark.slopes import ETA, MONOTONE, NU, Work, bounds, first_impact
from proofs.motion.marching import march
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, Flights
from proofs.search.image import Image, image
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.oscillator import PlasticMap

SYSTEM = System(ETA, NU)
DOMAINS = ((Fraction("1.11"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32")))
PHASES = tuple(map(Fraction, ("1.11", "1.13", "1.15", "1.27", "1.3", "1.32")))
_TRUE_DIGITS = 400  # more than are asked of any
_SIGN_BITS = 53
_OPENING, _PART = 1e-11, 0.1  # of times, and of a bracket: by which it is opened
_MONOTONE_BOXES = 8


def bits_for(digits: float) -> int:
    """Return bits for so many digits, with some to spare."""
    return math.ceil(digits * math.log2(10)) + 30


@cache
def truth(phase: Fraction) -> Image:
    """Return flight, image and slope to more digits than any other here."""
    true = image(SYSTEM, (phase, phase), digits=_TRUE_DIGITS)
    if not isinstance(true, Image):
        raise ArithmeticError(f"there is no single image of {phase}")
    return true


# -- slopes ----------------------------------------------------------------------------------------


def loss(slopes: Sequence[Range]) -> float:
    """Return by how much bounds of f' on I0 and I1, where f'' > 0, miss its values at the ends."""
    losses = []
    for (low, high), ends in zip(slopes, DOMAINS, strict=True):
        least, most = (truth(end).slope for end in ends)
        losses += [least[1] - low, high - most[0]]
    return float(min(losses)) if min(losses) < 0 else float(max(losses))


def _before(phases: Range) -> list[float]:
    """Return times up to the window of the impacts, between which the gap is > 0."""
    return [float(t) for t in Flights.plastic(Motion(SYSTEM.place, phases)).times((2,))[:-1]]


@cache
def works(boxes: int) -> list[Work]:
    """Return what is given to all; Undecided if the kernel does not find it."""
    return [work(domain, boxes) for domain in DOMAINS]


@cache
def _opened(low: float, high: float) -> tuple[float, float]:
    """Return a bracket that is so much wider that each library can prove it."""
    spare = _OPENING * high + _PART * (high - low)
    return low - spare, high + spare


def work(domain: Range, boxes: int) -> Work:
    """Return the work of one domain, on times before every impact that the lemmas find."""
    map_ = PlasticMap(SYSTEM.place)
    low, high = domain
    cuts = [float_down(low), *np.linspace(float(low), float(high), boxes + 1)[1:-1], float_up(high)]
    exact = [low, *map(Fraction, cuts[1:-1]), high]
    times = [map_.impact(enclosed((ends,), _SIGN_BITS)).range for ends in pairwise(exact)]
    brackets = [_opened(float(x), float(y)) for x, y in times]
    centres = [_about((x + y) / 2) for x, y in pairwise(cuts)]
    return Work(
        domain, cuts, _before(domain), brackets, centres, [*map(_about, map(float, domain))]
    )


def _about(phase: float) -> float:
    """Return about the time of the first impact."""
    impact = next_impact(SYSTEM, phase)
    if impact is None:
        raise Undecided("no impact is seen")
    return impact.time


def by_library(library: str, order: int, digits: float | None, boxes: float) -> float:
    """Do the work box by box, to so many digits or in binary64, signs to 53 bits."""
    kernel = arithmetic(library, bits_for(digits) if digits else _SIGN_BITS)
    signs = arithmetic(library, _SIGN_BITS)
    return loss([bounds(kernel, signs, work, order) for work in works(int(boxes))])


def monotone(library: str, digits: float) -> float:
    """Prove f'' > 0 on 8 boxes, and enclose f' at the ends."""
    return by_library(library, MONOTONE, digits, _MONOTONE_BOXES)


def main_job_slopes(digits: float) -> float:
    """Do what the main job does: it is given nothing, and keeps the witness."""
    from proofs.search.steps import Prover

    slopes = []
    for domain in DOMAINS:
        pieces = Prover(SYSTEM, int(digits), HORIZON).slopes(list(domain))[1].pieces
        slopes.append((min(low for low, _ in pieces), max(high for _, high in pieces)))
    return loss(slopes)


# -- flights ---------------------------------------------------------------------------------------


def width(flights: Sequence[Range]) -> float:
    """Return the largest width of enclosures of the six times; -1 if one excludes the truth."""
    for (low, high), phase in zip(flights, PHASES, strict=True):
        least, most = truth(phase).flight
        if not (low <= most and least <= high):
            return -1.0
    return float(max(high - low for low, high in flights))


def deviation(times: Sequence[float | None]) -> float:
    """Return the largest error of six approximate times; Undecided where there is none."""
    seen = [(time, phase) for time, phase in zip(times, PHASES, strict=True) if time is not None]
    if len(seen) < len(PHASES):
        raise Undecided("no impact was found")
    return max(abs(float(Fraction(time) - truth(phase).flight[0])) for time, phase in seen)


def images(digits: float) -> float:
    """Enclose the certified map, which is given the phase alone."""
    answers = [image(SYSTEM, (phase, phase), digits=int(digits)) for phase in PHASES]
    return width([each.flight for each in answers if isinstance(each, Image)])


def flights(library: str, digits: float) -> float:
    """Exclude impacts on given grids at 53 bits, then enclose time and f' to so many digits."""
    kernel, signs = arithmetic(library, bits_for(digits)), arithmetic(library, _SIGN_BITS)
    return width([first_impact(kernel, signs, phase, *_given(phase)) for phase in PHASES])


@cache
def _given(phase: Fraction) -> tuple[list[float], float]:
    """Return times before the impact, and about the time of it."""
    return _before((phase, phase)), _about(float(phase))


def marches(step: float) -> float:
    """March by algorithm A.1, as the paper prints it."""
    return deviation([march(SYSTEM, float(phase), step) for phase in PHASES])


def solved(method: str, tolerance: float) -> float:
    """Simulate as one would with scipy: the mass as an ODE, the table as an event."""
    from scipy.integrate import solve_ivp  # type: ignore[import, unused-ignore]

    eta, nu, times = float(ETA), float(NU), list[float | None]()
    for phase in map(float, PHASES):

        def below(t: float, y: Any, phase: float = phase) -> float:
            return 1 + nu * math.sin(phase + t) - float(y[0])

        below.terminal, below.direction = True, -1  # type: ignore[attr-defined]
        start = 1 + nu * math.sin(phase), nu * math.cos(phase)
        solution = solve_ivp(
            lambda _, y: (y[1], -eta * eta * y[0]), (0.0, 200.0), start, method, events=below,
            max_step=1.0, rtol=tolerance, atol=tolerance,
        )  # fmt: skip
        events = [t for t in solution.t_events[0] if t > 0.25]  # before is the launch itself
        times.append(float(events[0]) if events else None)
    return deviation(times)
