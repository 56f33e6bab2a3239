"""`verdict_oracle`: is a row's verdict consistent with brute force?

`TRUTHS` say of a claim at given parameters whether it is true as printed (None: not decided here);
`NEEDS` what it speaks of.
"""

import math
import random
from fractions import Fraction
from functools import lru_cache
from types import SimpleNamespace

from tests.oracles import plastic, restitution
from tests.oracles.judge import parameters
from tests.oracles.motion import (
    TURN,
    Impact,
    flight,
    separation,
    sticks,
)
from tests.oracles.sets import _root
from tests.oracles.single import contracting_but_none

ORBIT, CONSTANT, PRINTED = (4.64, 6.05), (3.38, 6.04), (Fraction("1.32"), Fraction("1.48"))
_PLACES = 0.05  # "to the places printed" is read as one to two places


# -- truths ----------------------------------------------------------------------------------------


def _faults(of):
    return tuple(plastic.horseshoe_faults(of, random.Random(0)))


def _no_fault(name):
    return lambda of: False if any(name in one.split() for one in _faults(of)) else None


def _digits(of):
    """H11: the ratios are rounded reciprocals, and the digits printed those of the root."""
    if max(of.ratios) >= 1:
        return False
    if of.printed_s0 is None:
        return None
    printed, unit = float(Fraction(of.printed_s0)), 10.0 ** -len(of.printed_s0.partition(".")[2])
    roots = [float(_root(pair)) for pair in {of.ratios, of.reciprocals} if max(pair) < 1]
    readings = [
        printed - unit / 2 <= r <= printed + unit / 2 or printed <= r < printed + unit
        for r in roots
    ]
    return False if not all(readings) else None


def _linear(of):
    return sum(of.ratios) < 1


def _lines(of):
    """H12: lines with these slopes map I0 and I1 onto I."""
    size = of.interval[1] - of.interval[0]
    onto = [of.interval[0] + of.reciprocals[0] * size, of.interval[1] - of.reciprocals[1] * size]
    ends = of.left[0] == of.interval[0] and of.right[1] == of.interval[1]
    return ends and onto == [of.left[1], of.right[0]] and sum(of.reciprocals) < 1


def _arc(of):
    """G1: the mass sticks on all of (3.38, 6.04)."""
    return (
        all(sticks(of.eta, of.nu, end) for end in CONSTANT)
        and separation(of.eta, of.nu) is not None
    )


@lru_cache(maxsize=256)
def _sticking_orbit(eta, nu):
    """The impact and separation phases of the periodic motion that sticks, or None."""
    away = separation(eta, nu)
    if away is None:
        return None
    found = flight(eta, nu, away, released=True)
    if not isinstance(found, Impact) or not sticks(eta, nu, found.phase):
        return None
    return found.phase, float(away)


def _printed_orbit(of):
    """G2-G4, G10: the orbit is (4.64, 6.05)."""
    found = _sticking_orbit(of.eta, of.nu)
    return found is not None and all(
        abs(x - y) < _PLACES for x, y in zip(found, ORBIT, strict=True)
    )


@lru_cache(maxsize=256)
def full_branches(eta, nu, interval, count=160):
    """How many runs of an interval f maps continuously over the whole of it, as sampled."""
    view = SimpleNamespace(eta=eta, nu=nu)
    low, high = map(float, interval)
    runs, before = [[]], None
    for k in range(count + 1):
        now = plastic.lifted(view, plastic.between(interval, Fraction(k, count)))
        if now is None or (before is not None and abs(now - before) > 0.6):
            runs.append([])
        if now is not None:
            runs[-1].append(now)
        before = now
    total = 0
    for run in filter(None, runs):
        first, last = math.ceil((min(run) - low) / TURN), math.floor((max(run) - high) / TURN)
        total += max(0, last - first + 1)
    return total


def _second_set(of):
    """G11, G20: two branches over [1.32, 1.48] would be a full shift."""
    return full_branches(of.eta, of.nu, PRINTED) >= 2


def _edges(of):
    """N1: the edges of V1 and V2 are mapped beyond both."""
    if not of.epsilon or not of.velocities:
        return None
    for part in (of.left, of.right):
        for side, phase in enumerate(part):
            for gamma in of.velocities:
                found = flight(of.eta, of.nu, phase, of.epsilon, gamma)
                if not isinstance(found, Impact):
                    return None
                x = (
                    (found.phase - float(of.left[0]) + TURN / 2) % TURN
                    - TURN / 2
                    + float(of.left[0])
                )
                if (x >= float(of.left[0])) if side == 0 else (x <= float(of.right[1])):
                    return False
    return None


def _hyperbolic(of):
    """N2: phases expand, velocities shrink."""
    if not of.epsilon or not of.velocities:
        return None
    box = ((of.eta,) * 2, (of.nu,) * 2, (of.epsilon,) * 2)
    for part in (of.left, of.right):
        for state in restitution._states(box, part, of.velocities, random.Random(0)):
            found = flight(state[0], state[1], state[3], state[2], state[4])
            if isinstance(found, Impact):
                (p, q), (_, s) = found.derivative()
                if not (p > 1 and abs(q) + abs(s) < 1):
                    return False
    return None


@lru_cache(maxsize=1)
def _contraction_is_not_enough():
    """P4-P6: solutions with |slope| < 1 that are no orbits, at the paper's parameters."""
    cases = (
        (Fraction("0.2121"), Fraction("-0.2"), (1, 13)),
        (Fraction(13999, 1000), Fraction("0.2"), (1,)),
    )
    return all(contracting_but_none(*case) for case in cases)


def _false(of):
    return False if _contraction_is_not_enough() else None


TRUTHS = {
    **{name: _no_fault(name) for name in ("H1", "H2", "H3", "H4", "H5", "H6")},
    "H11": _digits,
    "H12": _lines,
    "H14": lambda of: False,
    "H15": lambda of: of.ratios[0] == of.ratios[1],
    "H16": lambda of: max(of.ratios) < 1 and _linear(of),
    "H17": lambda of: False,
    "G1": _arc,
    "G11": _second_set,
    "G20": _second_set,
    "N1": _edges,
    "N2": _hyperbolic,
    "X1": lambda of: all(sticks(of.eta, of.nu, TURN * k / 97) for k in range(97)),
    "P4": _false,
    "P5": _false,
    "P6": _false,
}
NEEDS = {
    **dict.fromkeys(("H14", "H15", "H17"), ("a linear Cantor set", _linear)),
    **dict.fromkeys(("G2", "G3", "G4", "G10"), ("the orbit (4.64, 6.05)", _printed_orbit)),
}


def verdict_oracle(claim, about, verdict):
    """Complaints about a row's verdict at the parameters `about`."""
    of = parameters(about)
    if verdict in ("UNDECIDED", "SIMULATED"):
        return []
    told = []
    if claim in NEEDS and not NEEDS[claim][1](of):
        told.append(f"{claim} is {verdict}, but there is not {NEEDS[claim][0]}")
    own = TRUTHS.get(claim, lambda of: None)(of)
    if (verdict, own) in (("VERIFIED", False), ("REFUTED", True)):
        told.append(f"{claim} is {verdict}, but as printed it is {own}")
    return told
