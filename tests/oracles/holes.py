"""The holes that a hostile audit found, to be put back one by one.

Each is a document made from what the project's own provers find, by an edit of the witnesses, and
the lines of the checker that close it, with what they were like when it was open.
"""

import importlib
import inspect
import textwrap
from collections.abc import Callable
from contextlib import contextmanager
from fractions import Fraction
from typing import Any, NamedTuple

from tests.oracles.motion import flight
from tests.oracles.sources import committed, proved


class Lines(NamedTuple):
    """A function, "module:name" below proofs.trusted, and pieces of it as they are and were."""

    where: str
    pieces: tuple[tuple[str, str], ...]


class Hole(NamedTuple):
    """A document without texts: {"parameters", "steps", "proofs": {claim: [names of steps]}}."""

    name: str
    claim: str
    false: str  # the verdict, which is false, or stands beside a falsehood
    make: Callable[[], dict[str, Any]]
    told: str  # part of the complaint that is expected of the oracles
    lines: tuple[Lines, ...]


@contextmanager
def reopened(lines):
    """The function as it was."""
    name, _, path = lines.where.partition(":")
    module = importlib.import_module(f"proofs.trusted.{name}")
    function = module
    for part in path.split("."):
        function = getattr(function, part)
    source = textwrap.dedent(inspect.getsource(function))
    for closed, opened in lines.pieces:
        assert closed in source, f"{lines.where} has no {closed!r}"
        source = source.replace(closed, opened)
    made: dict[str, Any] = {}
    exec(f"from __future__ import annotations\n{source}", vars(module), made)
    code = getattr(made[function.__name__], "__func__", made[function.__name__]).__code__
    function.__code__, before = code, function.__code__
    try:
        yield
    finally:
        function.__code__ = before


def swapped_cells():
    """Hole 1: the cells of a full shift out of the order of phases."""
    made = committed("chaos")
    for step in made["steps"].values():
        if step["rule"] == "staying-set" and len(step["witness"]["cells"]) == 3:
            cells = step["witness"]["cells"]
            cells[0], cells[1] = cells[1], cells[0]
    return made


def _straddling(eta, nu, phases):
    """Slopes on an interval; the image of its upper end is said to reach from below 2 pi.

    f maps both ends a little beyond a multiple of 2 pi, below the interval: there is no fixed
    point. A bracket of the last impact that begins early encloses phases on both sides of 2 pi.
    """
    made = {**_with(eta=eta, nu=nu), "proofs": {"G5": ["false-orbit"]}}
    eta, nu = Fraction(eta), Fraction(nu)
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
    cell = {"slopes": "straddling", "domain": _texts(*ends)}
    made["steps"]["false-orbit"] = {
        "rule": "staying-set",
        "witness": {"region": [_texts(*ends)], "cells": [cell], "gaps": []},
    }
    return made


def _texts(*numbers):
    return [str(number) for number in numbers]


def _with(**parameters):
    return {"parameters": {**committed("sets")["parameters"], **parameters}, "steps": {}}


def equal_ratios():
    """Hole 3: H15 at equal ratios, where it is true; the reciprocals of the slopes differ."""
    return {**_with(ratios=["1/5", "1/5"], printed_s0=None), "proofs": {"H15": []}}


def no_linear_cover():
    """Hole 4: H17 with the ratios 7/10 and 4/5, of which no linear Cantor set is made."""
    return {**_with(ratios=["7/10", "4/5"], printed_s0=None), "proofs": {"H17": []}}


def one_phase():
    """Hole 5: a single phase as an interval that never impacts."""
    made = committed("circle")
    for step in made["steps"].values():
        if step["rule"] == "never-impacts":
            step["witness"]["phases"] = ["15707/10000"] * 2
    return made


ORDER = (
    Lines(
        "paper.staying:staying_set",
        (
            ("sorted(cells, key=lambda x: x.domain)", "list(cells)"),
            ('raise Unproved("cells overlap")', "pass"),
        ),
    ),
    Lines(
        "paper.staying:StayingSet.__post_init__",
        (("not apart(self.cells)", "False"),),
    ),
)
ASKED = Lines("verdicts:Row.is_asked", (("self.printed_at is None", "True"),))
PLACES = Lines(
    "paper.s34_circle.circle:_is_the_printed_orbit",
    (("all(within(phase, (x - _HALF, x + _HALF)) for x, phase in printed)", "True"),),
)
STRADDLE = Lines("numbers:Phase._require", (("low <= high <= TURN", "low <= high"),))
GAP = Lines("paper.s32_sets.linear:LinearSet.__post_init__", (("sum(self.ratios) >= 1", "False"),))
EQUAL = Lines(
    "paper.s32_sets.linear_steps:_gap_estimates",
    (("if true and false:", "if False:"), ("if true:", "if not false:")),
)
POINT = (
    Lines("numbers:Phases._require", (("low < high", "low <= high"),)),
    Lines("paper.s34_circle.landing:never_impacts", (("phases[0] < phases[1]", "True"),)),
)
HOLES = (
    Hole("swapped cells of a full shift", "G5", "VERIFIED", swapped_cells, "order", ORDER),
    Hole(
        "an image that straddles 2 pi",
        "G5",
        "UNDECIDED",
        lambda: _straddling("1/6", "-9/20", ("1.246", "1.25")),
        "no cycle",
        (STRADDLE,),
    ),
    Hole(
        "equal ratios",
        "H15",
        "REFUTED",
        equal_ratios,
        "as printed it is True",
        (EQUAL,),
    ),
    Hole("no linear set, H17", "H17", "REFUTED", no_linear_cover, "linear Cantor set", (GAP,)),
    Hole(
        "one phase that never impacts",
        "M6",
        "CONDITIONAL",
        one_phase,
        "no interval",
        POINT,
    ),
    Hole(
        "another orbit than the one printed",
        "G3",
        "VERIFIED",
        lambda: proved("circle", "1/6", "-0.45"),
        "there is not the orbit",
        (ASKED, PLACES),
    ),
)
