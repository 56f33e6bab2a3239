"""Orbits with one impact in n table periods: all solutions of (16), and which of them are orbits.

The lemmas are those of `s4_single.orbits`; beyond |nu| < 1 and where they say nothing,
the first impact is found by intervals.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from intervals import Interval, Undecided
from proofs.motion.digits import phase_after
from proofs.motion.system import System
from proofs.trusted.equations import Launch, launch, launch_acceleration, sincos
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import Range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper.s4_single.orbits import records

_ATTEMPTS = 6
_STICKS = "the mass sticks after the impact"
_LONGEST = 10**4  # time of flight that is followed


def turn(eta: Any, n: int, pi: Any) -> tuple[Any, Any]:
    """Return sin x, cos x, x = pi n eta."""
    return sincos(eta * (pi * n))


def multiplier(
    eta: Interval, nu: Interval, phase: tuple[Interval, Interval], around: tuple[Interval, Interval]
) -> Interval:
    """Return M, the slope (18) where K = 0, from the sines and cosines of phi and of x.

    Where h may be 0, the launch at x = 0, by 1/h = eta tan(x)/(nu cos(phi)).
    """
    lift, cos = nu * phase[0], around[1]
    if not (lift + 1).contains(0):
        return cos * cos * (1 - lift / ((lift + 1) * eta * eta))
    return cos * (cos - around[0] * phase[0] / (phase[1] * eta))


@dataclass(frozen=True)
class SingleImpact:
    """A phase in `phase` that solves (16), and the slope (18) there, None where it is 0/0.

    admissible: whether the mass leaves at once and its first impact is n table periods later, a
    transversal one; stable: whether it is an orbit, and attracts. None: not decided.
    """

    n: int
    phase: Range
    multiplier: Range | None
    admissible: bool | None
    stable: bool | None
    reason: str


def solutions(system: System, n: int, bits: int) -> list[SingleImpact]:
    """Return the solutions of (16), phases to 2^-bits; n eta must be no integer.

    Raises Undecided where two of them are too close to a saddle-node to tell.
    """
    if n * system.eta % 1 == 0:
        raise ValueError("n eta is an integer: every phase solves (16)")
    precision = bits + 40 + 2 * n.bit_length()
    for _ in range(_ATTEMPTS):
        phases, orbit = _phases(system, n, precision)
        if phases is not None and all(phase.wid * 2**bits <= 1 for phase in phases):
            orbits = [_judged(system, n, phase, orbit, bits) for phase in phases]
            return [*orbits, *_at_rest(system, n, precision)]
        precision *= 2
    raise Undecided(f"n = {n}: two solutions meet to within the precision")


def _phases(
    system: System, n: int, precision: int
) -> tuple[list[Interval] | None, tuple[Interval, Interval]]:
    """Enclose the solutions by (17), None if their number is not decided, and sin x, cos x.

    If |nu| = 1 but for `_at_rest`: asin(cos(theta)) = pi/2 - |theta|, and theta = 0 if n eta is a
    half-integer.
    """
    eta, nu = (Interval(x, precision=precision) for x in (system.eta, system.nu))
    half_turn = Interval.pi(precision=precision)
    sin, cos = turn(eta, n, half_turn)
    if _is_half(n * system.eta):
        cos = Interval(0, precision=precision)
    if sin.contains(0):
        return None, (sin, cos)
    theta = (cos / (sin * eta)).atan()
    if abs(system.nu) == 1:
        return [] if cos.mag == 0 else [theta * 2 - nu * half_turn / 2], (sin, cos)
    sine = theta.cos() / nu
    if sine.mig > 1:
        return [], (sin, cos)
    if sine.mag > 1:
        return None, (sin, cos)
    angle = sine.asin()
    return [theta - angle, theta + angle + half_turn], (sin, cos)


def _is_half(number: Fraction) -> bool:
    return number % 1 == Fraction(1, 2)


def _at_rest(system: System, n: int, precision: int) -> list[SingleImpact]:
    """Return the solution with 1 + nu sin(phi) = cos(phi) = 0, if |nu| = 1: a launch at rest at x =
    0, which sticks for nu = 1, and which the table reaches once a period for nu = -1.
    """
    if abs(system.nu) != 1:
        return []
    phase = Interval(-system.nu, precision=precision) * Interval.pi(precision=precision) / 2
    touched = "the mass, at rest at x = 0, is touched without relative velocity"
    reason = _STICKS if system.nu > 0 else touched
    reduced = phase_after(Fraction(0), (phase.inf, phase.sup), precision)
    return [SingleImpact(n, reduced, None, False, False, reason)]


def last_period(system: System) -> int | None:
    """Return an n after which no solution is an orbit (lemma 2), None if none is known."""
    if 0 < system.nu < 1:
        return (1 / (2 * system.eta)).__ceil__() - 1
    if -1 < system.nu < 0:
        return system.eta.denominator
    return None


def _judged(
    system: System, n: int, phase: Interval, orbit: tuple[Interval, Interval], bits: int
) -> SingleImpact:
    """Return a solution with its slope and what it is."""
    precision = phase.precision
    eta, nu = (Interval(x, precision=precision) for x in (system.eta, system.nu))
    factor = multiplier(eta, nu, phase.sincos(), orbit)
    reduced = phase_after(Fraction(0), (phase.inf, phase.sup), precision)
    admissible, reason = _admissible(system, n, reduced, bits)
    stable: bool | None = False
    if admissible is not False:
        size = abs(factor)
        inside = True if size.sup < 1 else False if size.inf > 1 else None
        stable = inside if admissible or inside is False else None
    return SingleImpact(n, reduced, (factor.inf, factor.sup), admissible, stable, reason)


def _admissible(system: System, n: int, phase: Range, bits: int) -> tuple[bool | None, str]:
    """Decide whether a solution of (16) is an orbit, and say why."""
    precision = bits + 20
    eta, nu = (Interval(x, precision=precision) for x in (system.eta, system.nu))
    start = launch(system.side, eta, nu, Interval(*phase, precision=precision))
    acceleration = launch_acceleration(start)
    arrives = _arrives(system, n, start)
    if acceleration.certainly_negative():
        return False, _STICKS
    if arrives.certainly_negative():
        return False, "the gap is negative just before"
    if not (arrives.certainly_positive() and acceleration.certainly_positive()):
        return None, "too close to sticking, or to grazing"
    if abs(system.nu) < 1:
        if n * system.eta < 1:  # lemma 3: as cos(phi) > 0, tan x has the sign of nu
            return True, "the first impact"
        if system.side > 0 or n not in _known_records(system.eta, 1 << n.bit_length()):
            return False, "an earlier impact"
    return _by_flight(system, n, phase, 2 * precision)


def _arrives(system: System, n: int, start: Launch) -> Interval:
    """Return a number with the sign of -gap' at 2 pi n, that of side nu cos(phi).

    By lemma 1 that is the sign of side h tan x, which is exact but for h.
    """
    number: Interval = start.rate if _is_half(n * system.eta) else start.lift + 1
    rises = n * system.eta % 1 <= Fraction(1, 2)
    return number * (system.side if rises else -system.side)


@lru_cache(maxsize=8)
def _known_records(eta: Fraction, most: int) -> frozenset[int]:
    return frozenset(records(eta, most))


def _by_flight(system: System, n: int, phase: Range, bits: int) -> tuple[bool | None, str]:
    """Decide by the first impact of the flight, which the checker's own map finds."""
    period = Interval.pi(precision=bits) * (2 * n)
    if period.sup > _LONGEST:
        return None, "the flight is too long to follow"
    try:
        begin, end = PlasticMap(system.place, period.sup + 1).impact(enclosed((phase,), bits)).range
    except Unproved as failure:
        return None, str(failure)
    if end < period.inf:
        return False, "an earlier impact"
    if begin < period.inf and period.sup < end:
        return True, "the first impact"
    return None, "the first impact is not told from one after n periods"
