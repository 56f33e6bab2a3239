"""The holes that a hostile audit found (issue 13): documents that must not be accepted as then.

Each is made from what the project's own provers find, at the parameters named, by an edit of the
witnesses. The texts are left out: a test that puts a hole back renews them with the checker's own
functions (`sources.conclusions` derives the steps, `sources.rows` decides the claims).
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

from tests.oracles.motion import flight
from tests.oracles.sources import committed, proved


class Hole(NamedTuple):
    """A document without texts: parameters, steps, and the steps that each claim rests on."""

    name: str
    claims: tuple[str, ...]
    false: str  # the verdict, which is false, or rests on a falsehood
    make: Callable[[], dict[str, Any]]  # {"parameters", "steps", "proofs": {claim: [names]}}
    told: str  # part of the complaint that is expected of the oracles


def swapped_pieces():
    """Hole 1: the cells of a staying set out of the order of phases."""
    made = committed("chaos")
    pieces = made["steps"]["staying-set-3"]["witness"]["pieces"]
    pieces[0], pieces[1] = pieces[1], pieces[0]
    return made


def _straddling(made, phases):
    """Add slopes on an interval; the image of its upper end is said to reach from below 2 pi.

    f maps both ends a little beyond a multiple of 2 pi, below the interval: there is no fixed
    point. A bracket of the last impact that begins early encloses phases on both sides of 2 pi.
    """
    eta, nu = (Fraction(made["parameters"][name]) for name in ("eta", "nu"))
    ends = [Fraction(phase) for phase in phases]
    times = [flight(eta, nu, phase).time for phase in ends]
    ends_of = [Fraction(round(float(time) * 10**9), 10**9) for time in times]
    nearest = [flight(eta, nu, phase).phase for phase in ends]
    early = ends_of[1] - Fraction(round((nearest[1] + 0.0004) * 10**6), 10**6)
    grid = [Fraction(3, 100) * Fraction(21, 20) ** k for k in range(60)]
    grid = [round(t, 4) for t in grid if t < Fraction(1, 2)]
    count = int((min(early, ends_of[0]) - Fraction(1, 10) - grid[-1]) * 100)
    grid += [grid[-1] + Fraction(k, 100) for k in range(1, count)]
    last = max(ends_of) + Fraction(1, 50)
    thin = Fraction(1, 10**7)
    points = [
        {
            "flight": "wide",
            "phase": str(ends[0]),
            "time": _texts(ends_of[0] - thin, ends_of[0] + thin),
        },
        {"flight": "wide", "phase": str(ends[1]), "time": _texts(early, ends_of[1] + thin)},
    ]
    made["steps"]["wide"] = {
        "rule": "first-impact",
        "witness": {"phases": _texts(*ends), "times": _texts(*grid, last)},
    }
    whole = _texts(min(ends_of) - Fraction(1, 200), max(ends_of) + Fraction(1, 200))
    made["steps"]["straddling"] = {
        "rule": "slope-range",
        "witness": {"points": points, "pieces": [{"flight": "wide", "time": whole}]},
    }
    for claim in ("G4", "G6"):
        proof = [name for name in made["proofs"][claim] if not name.startswith("slope-range")]
        made["proofs"][claim] = [*proof, "straddling"]
    return made


def _texts(*numbers):
    return [str(number) for number in numbers]


def _with(**parameters):
    return {"parameters": {**committed("sets")["parameters"], **parameters}, "steps": {}}


def equal_ratios():
    """Hole 3: H15 at equal ratios, where it is true; the reciprocals of the slopes differ."""
    return {**_with(ratios=["1/5", "1/5"], printed_s0=None), "proofs": {"H15": []}}


def no_linear_set():
    """Hole 4: H14 where the ratios 2/3 and 5/6 sum to more than 1."""
    sets = {"left": ["1/10", "1"], "right": ["5", "31/5"], "interval": ["1/10", "31/5"]}
    made = _with(slopes=["6/5", "3/2"], ratios=None, printed_s0=None, **sets)
    made["steps"] = {
        "lone": {
            "rule": "moran-root",
            "witness": {"ratios": ["2/3", "5/6"], "root": _moran("2/3", "5/6")},
        },
        "more": {
            "rule": "excess",
            "witness": {"root": "lone", "epsilon": "1/10", "word": "11"},
        },
    }
    return {**made, "proofs": {"H14": ["more"]}}


def _moran(*ratios):
    """A narrow bracket of the root of r0^s + r1^s = 1, as texts."""
    pair, low, high = [float(Fraction(ratio)) for ratio in ratios], 0.0, 64.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if sum(r**middle for r in pair) > 1 else (low, middle)
    middle = Fraction(round(low * 10**9), 10**9)
    return _texts(middle - Fraction(1, 10**8), middle + Fraction(1, 10**8))


def no_linear_dimension():
    """Hole 4: H13 with the ratios 7/10 and 4/5, of which no linear Cantor set is made."""
    made = committed("dimension")
    made["parameters"] = {**made["parameters"], "ratios": ["7/10", "4/5"], "printed_s0": None}
    made["steps"]["root-of-none"] = {
        "rule": "moran-root",
        "witness": {"ratios": ["7/10", "4/5"], "root": _moran("7/10", "4/5")},
    }
    made["proofs"]["H13"] = [*made["proofs"]["H13"], "root-of-none"]
    return made


def one_phase():
    """Hole 5: a single phase as an interval that never impacts."""
    made = committed("circle")
    witness = made["steps"]["never-impacts-1"]["witness"]
    witness["phases"] = ["15707/10000"] * 2
    return made


HOLES = (
    Hole("swapped pieces of a staying set", ("G5",), "REFUTED", swapped_pieces, "order"),
    Hole(
        "an image that straddles 2 pi, G6",
        ("G6",),
        "VERIFIED",
        lambda: _straddling(proved("circle", "5/22", "-0.95"), ("1.228", "1.236")),
        "fixed point",
    ),
    Hole(
        "an image that straddles 2 pi, G4",
        ("G4",),
        "REFUTED",
        lambda: _straddling(proved("circle", "1/6", "-0.45"), ("1.246", "1.25")),
        "fixed point",
    ),
    Hole("equal ratios", ("H15",), "REFUTED", equal_ratios, "as printed it is True"),
    Hole("no linear set, H14", ("H14",), "REFUTED", no_linear_set, "linear Cantor set"),
    Hole("no linear set, H13", ("H13",), "REFUTED", no_linear_dimension, "linear Cantor set"),
    Hole("one phase that never impacts", ("G4",), "REFUTED", one_phase, "no interval"),
    Hole(
        "another orbit than the one printed",
        ("G3",),
        "VERIFIED",
        lambda: proved("circle", "1/6", "-0.45"),
        "there is not the orbit",
    ),
)
