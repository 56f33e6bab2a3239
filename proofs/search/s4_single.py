"""Section 4: single-impact orbits. (16)-(18) derived; which solutions are orbits, and stable.

Identities are found with sympy; solutions, first impacts and the ends of the windows of stable
orbits in figures 7a and 7b are enclosed with the package `intervals`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from intervals import Undecided
from proofs.motion.single_orbits import SingleImpact, solutions
from proofs.motion.system import System
from proofs.motion.window_ends import bracket, earlier, eta_end, graze_end, nu_end
from proofs.search.derivations import Steps
from proofs.search.evidence import FAILED, Evidence
from proofs.search.request import Request, proving
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.flights import Motion
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.paper.s4_single import single as claims
from proofs.trusted.paper.s4_single.orbits import FLIP, SADDLE, STICK, records
from proofs.trusted.parameters import PAPER

_MOST = 40  # table periods in the search for examples
_ORBITS = 12  # and for orbits to show
_STIFF = Fraction("13.999")  # almost a resonance, 14
_SOFT = Fraction("-0.03")  # an amplitude at which n = 21 has an earlier impact
_LATEST = 7  # more than a table period
_TIMES = 64  # a table period, looked at for an earlier impact
_HALF = Fraction(1, 2)


@dataclass
class Single:
    """Proves the steps of this group."""

    prover: Prover

    def _derive(self, rule: str, **witness: Any) -> str:
        return self.prover.derive(rule, witness)[0]

    def solution(
        self, system: System, orbit: SingleImpact, early: bool = False, first: bool = False
    ) -> str:
        """Record a solution of (16), with an earlier time at which the gap is < 0 if asked for.

        first: or with its first impact, n periods later, at the parameters of the certificate.
        """
        phase = bracket(system, orbit.n, orbit.phase, self.prover.bits)
        motion = Motion(system.place, phase, self.prover.bits + 60)
        return self._derive(
            "single-solution",
            eta=str(system.eta),
            nu=str(system.nu),
            n=str(orbit.n),
            phase=texts(phase),
            early=str(_inside(motion, orbit.n)) if early else None,
            latest=str(_LATEST * orbit.n) if first else None,
        )

    def eta_windows(self, nu: Fraction, low: Fraction) -> str:
        """Record all windows in eta >= low at which stable orbits exist, for nu in (0, 1)."""
        ends: list[tuple[Range, Range]] = []
        for n in range(1, (_HALF / low).__ceil__()):
            stick = eta_end(nu, n, STICK, self.prover.bits)
            if stick[0] <= low:
                break
            ends.append((eta_end(nu, n, FLIP, self.prover.bits), stick))
        return self._derive(
            "single-windows",
            nu=str(nu),
            low=str(low),
            ends=[texts([*flip, *stick]) for flip, stick in ends],
        )

    def below_windows(self, nu: Fraction, low: Fraction) -> str:
        """Record all windows in eta >= low at which stable orbits exist, for nu in [-3/10, 0)."""
        bits, ends, n = self.prover.bits, list[tuple[Range, Range]](), 1
        while n * low < 1:
            between = Fraction(1, 2 * n), Fraction(1, n)
            saddle = eta_end(nu, n, SADDLE, bits, between)
            sticks = 1 - nu <= n * n * -nu
            last = eta_end(nu, n, STICK, bits, between) if sticks else (between[1], between[1])
            if last[0] <= low:
                break
            ends.append((saddle, last))
            n += 1
        later = eta_end(nu, 1, SADDLE, bits, (3 * _HALF, Fraction(2)))
        graze, touch = graze_end(nu, float(later[1]), bits)
        return self._derive(
            "single-windows",
            nu=str(nu),
            low=str(low),
            ends=[texts([*first, *(last if last[0] < last[1] else ())]) for first, last in ends],
            late=texts([*later, *graze]),
            touch=str(touch),
        )

    def nu_windows(self, eta: Fraction) -> str:
        """Record all windows in nu at which stable orbits exist."""
        kept = list(records(eta, eta.denominator))
        short = [n for n in kept if n * eta < 1]
        least = range(1, (_HALF / eta).__ceil__())
        times = [earlier(eta, n) for n in kept if n * eta > 1]
        if None in times:
            raise Undecided("no earlier impact is seen after a long flight")
        return self._derive(
            "single-windows",
            eta=str(eta),
            above=self._windows(eta, least, (STICK, FLIP)),
            below=self._windows(eta, short, (SADDLE, STICK)),
            early=[str(time) for time in times],
        )

    def _windows(
        self, eta: Fraction, periods: Sequence[int], ends: tuple[int, int]
    ) -> list[list[list[str] | None]]:
        """Return the two ends of the window of each period, None where there is none."""
        return [
            [
                pair and texts(pair)
                for pair in (nu_end(eta, n, end, self.prover.bits) for end in ends)
            ]
            for n in periods
        ]


def _inside(motion: Motion, n: int) -> Fraction:
    """Return a time before n table periods at which the mass would be inside the table."""
    times = [round(TURN * step / _TIMES, 6) for step in range(1, _TIMES * n)]
    best = min(times, key=lambda time: motion.gap_of((time, time), 0).hi)
    if motion.gap_of((best, best), 0).hi >= 0:
        raise Undecided("no earlier impact is seen")
    return best


def examples(system: System, most: int) -> Iterator[SingleImpact]:
    """Yield the solutions of (16) with up to so many table periods."""
    for n in range(1, most + 1):
        if n * system.eta % 1 != 0:
            yield from solutions(system, n, 80)


def _contracts(orbit: SingleImpact) -> bool:
    return orbit.multiplier is not None and -1 < orbit.multiplier[0] <= orbit.multiplier[1] < 1


def _first(system: System, most: int, reason: str) -> SingleImpact:
    """Return the first solution with |slope| < 1 that is not an orbit for this reason."""
    for orbit in examples(system, most):
        if orbit.reason == reason and _contracts(orbit):
            return orbit
    raise Undecided(f"no solution of (16) with |slope| < 1 is found: {reason}")


def _stability(steps: Single) -> list[str]:
    paper, system = System(PAPER.eta, PAPER.nu), steps.prover.system
    names = [steps.solution(paper, _first(paper, _MOST, "an earlier impact"), early=True)]
    for orbit in examples(system, _ORBITS):
        with suppress(*FAILED), steps.prover.undone():
            names += [steps.solution(system, orbit, first=True)] if orbit.admissible else []
    return names


def _figure_a(steps: Single) -> list[str]:
    nu = claims.FIGURE_NU
    below, above = System(_STIFF, nu), System(_STIFF, -nu)
    return [
        steps.eta_windows(nu, claims.FIGURE_ETAS[0]),
        steps.below_windows(-nu, claims.FIGURE_ETAS[0]),
        steps.solution(below, _first(below, 1, "the mass sticks after the impact")),
        steps.solution(above, _first(above, 1, "an earlier impact"), early=True),
    ]


def _figure_b(steps: Single) -> list[str]:
    system = System(claims.FIGURE_ETA, _SOFT)
    late = _first(system, _MOST, "an earlier impact")
    return [
        steps.nu_windows(claims.FIGURE_ETA),
        steps.solution(system, late, early=True),
    ]


_FIND = {"P4": _stability, "P5": _figure_a, "P6": _figure_b}


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on: formulas, and for P4 to P6 orbits."""
    formulas = Steps(request.digits)
    prover = request.prover(formulas.steps)
    single, evidence = Single(prover), Evidence(formulas.steps)
    for row in claims.ROWS:
        if not request.asks(row.id):
            continue
        request.tell(f"formulas and orbits of {row.id}")
        names = _FIND[row.id](single) if row.id in _FIND else []
        proved = [formulas.prove(need) for need in row.needs]
        rest = [each for each in proved if each is not None]
        evidence.proofs[row.id] = [*rest, *((name, prover.known[name]) for name in names)]
    return evidence
