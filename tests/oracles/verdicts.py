"""`verdict_oracle`: is a row's verdict, and are its sentences, consistent with brute force?

`TRUTHS` say of a claim at given parameters whether it is true as printed (None: not decided here);
`NEEDS` what it speaks of; `SENTENCES` are phrases with numbers, and what is checked about them.
"""

import math
import random
import re
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from types import SimpleNamespace

import flint

from tests.oracles import circle, plastic, restitution
from tests.oracles.adapter import parameters
from tests.oracles.motion import (
    TURN,
    Impact,
    ball,
    flight,
    inside,
    inside_mod,
    next_impact,
    orbit,
    separation,
    sticks,
    two_pi,
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
    """G2-G4: the orbit is (4.64, 6.05)."""
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
    """G5: two branches over [1.32, 1.48] would be a full shift."""
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
    "G5": _second_set,
    "N1": _edges,
    "N2": _hyperbolic,
    "P4": _false,
    "P5": _false,
    "P6": _false,
}
NEEDS = {
    **dict.fromkeys(("H14", "H15", "H17"), ("a linear Cantor set", _linear)),
    **dict.fromkeys(("G2", "G3", "G4"), ("the orbit (4.64, 6.05)", _printed_orbit)),
}

# -- sentences -------------------------------------------------------------------------------------


def _separation_at(of, low, high):
    away = separation(of.eta, of.nu)
    return away is not None and inside(away, (low, high))


def _arc_from(of, low, high):
    away = separation(of.eta, of.nu)
    return away is not None and inside_mod(3 * flint.arb.pi() - away, (low, high), 1e-12)


def _lands_at(of, low, high):
    away = separation(of.eta, of.nu)
    found = None if away is None else flight(of.eta, of.nu, away, released=True)
    return not isinstance(found, Impact) or inside_mod(found.lifted, (low, high))


def _fixed(of, low, high):
    """f(phi) - phi goes from - to +, mod 2 pi, between the ends, and is small there."""
    ends = []
    for end in (low, high):
        found = next_impact(of.eta, of.nu, end)
        if not isinstance(found, Impact):
            return found is None
        ends.append(found.lifted - ball(end))
    turns = round(float(sum(ends)) / 2 / TURN)
    first, last = (x - turns * two_pi() for x in ends)
    slack = 60 * (float(high - low) + 1e-14)
    return not first > 0 and not last < 0 and float(last - first) < slack


def _never(of, low, high):
    record = SimpleNamespace(eta=of.eta, nu=of.nu, phases=(low, high))
    return not circle.never_impacts(record, random.Random(0), 0)


def _reach(of, low, high, steps):
    middle = [float(plastic.between((low, high), Fraction(k, 7))) for k in range(1, 7)]
    counts = [circle.impacts_before_rest(of.eta, of.nu, phase, int(steps)) for phase in middle]
    return all(n is None or n <= steps for n in counts)


def _share_least(of, percent):
    counts = [n for n in circle.basin(of.eta, of.nu, 40) if n is not None]
    return sum(n <= 40 for n in counts) / max(1, len(counts)) > float(percent) / 100 - 0.15


def _slope_at(of, phase, relation, bound):
    found = flight(of.eta, of.nu, phase)
    if not isinstance(found, Impact):
        return found is None
    return found.slope < ball(bound) if relation == "<=" else found.slope > ball(bound)


def _image_in(of, phase):
    return plastic.lands_in(of, phase, of.interval, -1e-12)


def _no_preimage(of, low, high, name):
    part = of.left if name == 0 else of.right
    about = SimpleNamespace(eta=of.eta, nu=of.nu, phases=part, target=(low, high))
    return not plastic.avoids(about, random.Random(0))


def _increasing_symbols(of, text):
    ends = [(Fraction(a), Fraction(b)) for a, b in re.findall(_PAIR, text)]
    return all(a[1] < b[0] for a, b in pairwise(ends))


def _full_shift(of, low, high, symbols):
    return full_branches(of.eta, of.nu, (low, high)) >= int(symbols)


def _period(of, period, text):
    """Each bracket holds a point of the period, by the images of its middle."""
    good = True
    for a, b in re.findall(_PAIR, text):
        middle = (Fraction(a) + Fraction(b)) / 2
        run = orbit(of.eta, of.nu, middle, int(period))
        if len(run) > int(period):
            good &= abs(run[-1] - float(middle)) < 1e-4
    return good


def _edge_at(of, low, high, phi, gamma):
    found = flight(of.eta, of.nu, phi, of.epsilon, gamma)
    return not isinstance(found, Impact) or inside_mod(found.lifted, (low, high))


def _horseshoe(of, *numbers):
    values = iter(numbers)
    interval, left, right, slopes = ((next(values), next(values)) for _ in range(4))
    sets = SimpleNamespace(
        eta=of.eta, nu=of.nu, interval=interval, left=left, right=right, slopes=slopes
    )
    return slopes[0] > 1 and not plastic.horseshoe_faults(sets, random.Random(0))


_N = r"-?\d+(?:\.\d+)?(?:/\d+)?"
_PAIR = rf"\[({_N}), ({_N})\]"
_LIST = rf"((?:{_PAIR}(?:, )?)+)".replace(f"({_N})", _N)
SENTENCES = (
    (rf"(?<!- )phi_s in {_PAIR}", _separation_at),
    (rf"3 pi - phi_s in {_PAIR}", _arc_from),
    (rf"phi_1 in {_PAIR}", _lands_at),
    (rf"fixed point(?: p)? in {_PAIR}", _fixed),
    (rf"(?:no phase of|not defined on) {_PAIR}(?! has its)", _never),
    (rf"Every phase of {_PAIR} mod 2 pi reaches the arc within ({_N}) impact", _reach),
    (rf"attracts at least ({_N}) percent", _share_least),
    (rf"f'\(({_N})\) (<=|>=) ({_N})", _slope_at),
    (rf"f\(({_N})\) is in I", _image_in),
    (rf"{_PAIR} has no preimage in I([01])", _no_preimage),
    (r"With the symbols (.*?): ", _increasing_symbols),
    (rf"those in {_PAIR} are a full shift on (\d+) symbols", _full_shift),
    (rf"points of period (\d+) lie in {_LIST}", _period),
    (rf"reaches phase {_PAIR} from \(phi, gamma\) = \(({_N}), ({_N})\)", _edge_at),
    (
        rf"let I = {_PAIR}, I0 = {_PAIR}, I1 = {_PAIR}\. The impact map f is continuously "
        rf"differentiable and increasing on I0 and on I1, with ({_N}) <= f' <= ({_N})",
        _horseshoe,
    ),
    (rf"\(eta0, eta1\) = \(({_N}), ({_N})\)", lambda of, a, b: a + b < 1),
    (rf"linear Cantor set of the ratios ({_N}) and ({_N})", lambda of, a, b: a + b < 1),
    (rf"log ({_N}) >= ({_N})", lambda of, a, b: math.log(a) >= b - Fraction(1, 10**12)),
    (rf"interval of length ({_N})", lambda of, a: a > 0),
)


def _read(text):
    try:
        return Fraction(text)
    except ValueError:
        return text


def sentence_faults(of, text):
    """What is false about phrases with numbers in a text."""
    told = []
    for pattern, judge in SENTENCES:
        for match in re.finditer(pattern, text):
            if not judge(of, *map(_read, match.groups())):
                told.append(f"not so: {match.group()[:120]}")
    return told


def verdict_oracle(claim, about, verdict, texts):
    """Complaints about a row: its verdict at the parameters `about`, and its texts."""
    verdict, of = getattr(verdict, "value", verdict), parameters(about)
    if verdict in ("UNDECIDED", "SIMULATED"):
        return []
    told = []
    if claim in NEEDS and not NEEDS[claim][1](of):
        told.append(f"{claim} is {verdict}, but there is not {NEEDS[claim][0]}")
    own = TRUTHS.get(claim, lambda of: None)(of)
    if (verdict, own) in (("VERIFIED", False), ("REFUTED", True)):
        told.append(f"{claim} is {verdict}, but as printed it is {own}")
    for text in texts:
        told += sentence_faults(of, text)
    return told
