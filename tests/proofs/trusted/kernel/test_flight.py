"""Flights against simulations and the paper's own rules; forgeries, each refused with its reason.

The simulation (`tests.oracles.flights`) integrates the equation of motion and never sees the closed
form.
"""

import random
import subprocess
import sys
from collections import Counter
from fractions import Fraction

import numpy as np
import pytest

from proofs import Oscillator
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.enclose import enclosed, point_box
from tests.once import examples
from tests.oracles.flights import Simulation, system_of
from tests.proofs.trusted.kernel.lemma_examples import add_orbit, horseshoe
from tests.proofs.trusted.kernel.lemma_examples import ball as ball_example
from tests.proofs.trusted.kernel.systems import BALL, SYSTEMS, box_of

SLOW = pytest.mark.slow
BY_SPEED = [pytest.param(x, marks=() if x in ("rattle", "back") else SLOW) for x in SYSTEMS]
SLIP = 1e-8  # of the simulation's values
SLOPE_SLIP = 2e-6  # of its differences, as a part of the derivatives


def flight(data):
    return read_map("F", Reader(data), {})


def ends(entries):
    return np.array([[float(end) for end in x.range] for x in entries]).T


# -- containment -----------------------------------------------------------------------------------


def enclosures(name, count, rng):
    """Boxes of states with enclosures of the values and derivatives there, where there are some."""
    map_ = flight(SYSTEMS[name].data)
    for _ in range(count):
        box = box_of(SYSTEMS[name], rng)
        try:
            values, rows = map_.values(enclosed(box, 64)), map_.jacobian(enclosed(box, 64))
        except Unproved:
            continue
        yield box, ends(values), ends([x for row in rows for x in row])


def outside(name, boxes, points, rng):
    """Count points with values outside of what encloses them; boxes with such derivatives."""
    found = list(enclosures(name, boxes, rng))
    states = np.array([_inside(box, rng) for box, *_ in found for _ in range(points)]).T
    simulation = Simulation(system_of(SYSTEMS[name].data))
    values, slopes = simulation.fly(states)[:-1], simulation.slopes(states[:, ::points])
    counts = Counter(boxes=boxes, enclosed=len(found), points=states.shape[1])
    for j, (_, value, slope) in enumerate(found):
        own, flat = values[:, j * points : (j + 1) * points], slopes[:, :, j].ravel()
        counts["values"] += sum(not _within(x, value, SLIP) for x in own.T)
        slip = SLOPE_SLIP * (1 + np.max(np.abs(flat)))
        counts["derivatives"] += not _within(flat, slope, slip)
    return counts


def _inside(box, rng):
    return [float(low) + (float(high) - float(low)) * rng.random() for low, high in box]


def _within(x, bounds, slip):
    return np.all(bounds[0] - slip <= x) and np.all(x <= bounds[1] + slip)


@pytest.mark.parametrize("name", BY_SPEED)
def test_values_and_derivatives_are_enclosed(name):
    counts = outside(name, examples(24), 4, random.Random(name))
    assert 2 * counts["enclosed"] > counts["boxes"], counts
    assert not counts["values"] and not counts["derivatives"], counts


@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_thousands_of_points_are_enclosed(name):
    counts = outside(name, 340, 60, random.Random(f"{name}, at length"))
    print(name, dict(counts))
    assert counts["points"] > 14_000
    assert not counts["values"] and not counts["derivatives"], counts


def at(name, point, bits):
    map_, x = flight(SYSTEMS[name].data), enclosed(point_box(point), bits)
    return [*map_.values(x), *(entry for row in map_.jacobian(x) for entry in row)]


def launches(name, count):
    """Points from which there is a flight."""
    rng, listed = random.Random(f"{name} points"), []
    while len(listed) < count:
        point = [low for low, _ in box_of(SYSTEMS[name], rng)]
        try:
            listed.append((point, at(name, point, 64)))
        except Unproved:
            continue
    return listed


@pytest.mark.parametrize("name", BY_SPEED)
def test_precisions_agree_and_points_are_in_their_boxes(name):
    for point, coarse in launches(name, 2):
        fine = at(name, point, 192)
        for one, other in zip(coarse, fine, strict=True):
            (a, b), (c, d) = one.range, other.range
            assert a <= d and c <= b
            assert d - c <= b - a
        narrow, wide = (
            [(x - r, x + r) for x in point] for r in (Fraction(1, 10**5), Fraction(1, 10**4))
        )
        for first in (narrow, wide):  # the other one is met with the windows of the first
            map_ = flight(SYSTEMS[name].data)
            boxes = {id(box): map_.values(enclosed(box, 64)) for box in (first, narrow, wide)}
            for one, inner, outer in zip(coarse, boxes[id(narrow)], boxes[id(wide)], strict=False):
                assert outer.lo <= inner.lo <= inner.hi <= outer.hi
                assert inner.lo <= one.hi and one.lo <= inner.hi


# -- the paper's own rules -------------------------------------------------------------------------


@pytest.mark.parametrize("phi", ["1.13", "1.3"])
def test_the_oscillator_as_data_is_the_oscillator(phi):
    """By the rules that know it: phase, velocity and their derivatives, to 14 digits."""
    map_, state = flight(SYSTEMS["oscillator"].data), [Fraction(phi), Fraction("-0.2")]
    x = enclosed(point_box(state), 192)
    (angle, speed), rows = map_.values(x), map_.jacobian(x)
    flown, phase, *others = (
        bounds for _, bounds in Oscillator("0.2121", "-0.2", "0.01").image(phi, "-0.2").bounds
    )
    turns = round(float(phase.lower - angle.range[0]) / (2 * np.pi))
    own = [map_.impact(x), angle + map_.periods(192)[0] * turns, speed, *rows[0], *rows[1]]
    for one, other in zip(own, (flown, phase, *others), strict=True):
        low, high = one.range
        assert low <= other.upper and other.lower <= high
        assert max(high, other.upper) - min(low, other.lower) < Fraction(1, 10**14)


# -- forgeries -------------------------------------------------------------------------------------

STILL = {"name": "y", "form": "x", "equation": "0", "start": ["x"]}
CLOCK = {"variables": ["x"], "time": "t", "motion": [STILL], "gaps": ["2 - t"], "values": ["y"]}
SIX = {"name": "p", "form": "6", "equation": "0", "start": ["6"]}
KINK = {
    "name": "y",
    "form": "sqrt((t - 1)**2)",
    "equation": "0",
    "start": ["sqrt(1)", "-1/sqrt(1)"],
}


def clock(**fields):
    return {**CLOCK, **fields}


def moving(form, equation, *start, **fields):
    motion = {"name": "y", "form": form, "equation": equation, "start": list(start)}
    return clock(motion=[motion], **fields)


def ball(**fields):
    return {**BALL, **fields}


LAUNCH = [("1/2", "501/1000"), ("2", "2001/1000")]
STATE = [("0", "1/10")]
TRUTHS = [
    ("a clock", CLOCK, STATE, 0),
    ("the first of three zeros", clock(gaps=["(1 - t)*(2 - t)*(3 - t)"], values=["t"]), STATE, 1),
    ("much later for some", clock(gaps=["2 + x - t"], values=["t"]), [("0", "8")], 10),
    ("y' = y", moving("x*exp(t)", "y", "x", values=["y/x"]), [("1/10", "1/5")], 7.389056),
    ("y' = 2 t", moving("t**2", "2*t", "0", values=["y"]), STATE, 4),
    ("a ball", ball(values=["v", "phi"], periods={}), LAUNCH, 2),
    ("at rest or faster", clock(gaps=["x*t + t**2 - t**3"], values=["t"]), [("0", "0")], 1),
]
NOT_0 = "a gap is not proved > 0 at launch"
LEAVES, GRAZE = "right after launch", "a graze is not excluded at the time 1,"
OTHER = "a gap is not proved > 0 up to the time"
UNKNOWNS = "unknowns of lower order alone"
SOLVES, STARTS = "not proved to solve this equation", "not proved to start so"
PERIOD = "not proved to respect the period"
INTO = "nothing is substituted into the solution"
LIES = [  # what is false, the function, a box of states, the reason
    ("a gap < 0 at launch", ball(gaps=["y - sin(phi + t) - 1/10"]), LAUNCH, NOT_0),
    ("a launch into the table", BALL, [("1/2", "1/2"), ("1/2", "1/2")], LEAVES),
    ("a double zero at launch", BALL, [("0", "0"), ("1", "1")], LEAVES),
    ("a launch that may be both", BALL, [("1/2", "1/2"), ("1/2", "1")], LEAVES),
    ("a wrong order of leaving", clock(gaps=["-t**3 + t**4"]), STATE, LEAVES),
    ("slower than at rest", clock(gaps=["t**2 - x*t - t**3"]), STATE, LEAVES),
    ("a gap that is 0", clock(gaps=["0*t"]), STATE, "the gap is 0 at launch"),
    ("a graze before", clock(gaps=["(t - 1)**2*(2 - t)"]), STATE, GRAZE),
    ("a graze as the impact", clock(gaps=["(t - 1)**2"]), STATE, GRAZE),
    ("a graze for some", clock(gaps=["((t - 1)**2 + x)*(2 - t)"]), STATE, GRAZE),
    ("a gap that jumps", clock(gaps=["1/(1 - t)"]), STATE, GRAZE),
    ("no impact", clock(gaps=["1 + t"]), STATE, "no impact is proved before the time 1024"),
    ("another wall first", clock(gaps=["2 - t", "1 - t"]), STATE, OTHER),
    ("another wall at once", clock(gaps=["2 - t", "2 - t"]), STATE, OTHER),
    ("another wall for some", clock(gaps=["2 - t", "2 + x - t"]), STATE, OTHER),
    ("another wall before the last", clock(gaps=["2 + x - t", "2 + 1/20 - t"]), STATE, OTHER),
    ("another wall grazed", clock(gaps=["2 - t", "(t - 1)**2"]), STATE, OTHER),
    ("a gap undefined between", clock(gaps=["2 - t + 0*(1/(t - 1))"]), STATE, GRAZE),
    ("another gap undefined", clock(gaps=["2 - t", "3 - t + 0*(1/(t - 1))"]), STATE, GRAZE),
    ("another equation", moving("t**2", "3", "0", "0"), STATE, SOLVES),
    ("another start", moving("1 + t**2", "2", "0", "0"), STATE, STARTS),
    ("another speed", moving("t + t**2", "2", "0", "0"), STATE, STARTS),
    ("too few starts", moving("t**2", "2", "0"), STATE, SOLVES),
    ("y'' = y''", moving("t**2", "D(y, t, t)", "0", "0"), STATE, UNKNOWNS),
    ("y' = 2 sqrt(y)", moving("t**2", "2*sqrt(y)", "0"), STATE, UNKNOWNS),
    ("a root in disguise", moving("t**2", "2*exp(log(y)/2)", "0"), STATE, UNKNOWNS),
    ("a root as a quotient", moving("t**2", "2*y/sqrt(y)", "0"), STATE, UNKNOWNS),
    ("a negative power", moving("t**2", "2*t*y**2*y**-2", "0"), STATE, UNKNOWNS),
    ("y' = 2 y / t", moving("t**2", "2*y/t", "0"), STATE, "division by an enclosure of 0"),
    ("a derivative by the state", moving("x*t", "x*D(y, x)", "0"), STATE, UNKNOWNS),
    ("the solution at another time", moving("t", "at(y, t=1)", "0"), STATE, INTO),
    ("a start that is the motion", moving("7", "0", "y"), STATE, "nor on motions"),
    ("the motion's start", moving("7", "0", "at(y, t=0)"), STATE, INTO),
    ("a start that moves", moving("t", "1", "t"), STATE, "does not depend on the time"),
    ("an undefined start", moving("x", "0", "x**2/x"), STATE, "division by an enclosure of 0"),
    ("a kink", clock(motion=[KINK]), STATE, GRAZE),
    ("past the impact", clock(gaps=["3/4 - t"], values=["at(y, t=2*t)"]), STATE, INTO),
    ("a derivative by y", clock(values=["D(x*y, y)"]), STATE, "not a variable: 'y'"),
    ("a derivative by a number", ball(values=["D(g*t, g)", "v"]), LAUNCH, "not a variable: 'g'"),
    ("half a period", ball(periods={"phi": "pi"}), LAUNCH, PERIOD),
    ("a gap that counts turns", ball(gaps=["(y - sin(phi + t))*(9 + phi)"]), LAUNCH, PERIOD),
    ("the period of another circle", ball(periods={"v": "2*pi"}), LAUNCH, PERIOD),
    ("a period that varies", ball(periods={"phi": "v"}), LAUNCH, "a period is a number"),
    (
        "a motion as a period",
        ball(motion=[*BALL["motion"], SIX], periods={"phi": "p"}),
        LAUNCH,
        "a period is a number",
    ),
    (
        "a velocity as a period",
        ball(motion=[*BALL["motion"], SIX], periods={"phi": "6 + D(p, t)"}),
        LAUNCH,
        "a period is a number",
    ),
    ("no period", ball(periods={"phi": "0"}), LAUNCH, "a period is positive"),
    ("a period of nothing", ball(periods={"y": "pi"}), LAUNCH, "what is no variable"),
    ("a name twice", clock(variables=["x", "t"]), STATE, "a name that is there twice"),
    ("a motion named as a state", clock(motion=[{**STILL, "name": "x"}]), STATE, "there twice"),
    ("a motion named as a function", clock(motion=[{**STILL, "name": "sin"}]), STATE, "not a name"),
]


def enclosed_values(data, box):
    return flight(data).values(enclosed([tuple(map(Fraction, side)) for side in box], 64))


@pytest.mark.every
@pytest.mark.parametrize(
    ("data", "box", "first"), [x[1:] for x in TRUTHS], ids=[x[0] for x in TRUTHS]
)
def test_truths(data, box, first):
    low, high = enclosed_values(data, box)[0].range
    assert low - Fraction(1, 10**6) <= first <= high + Fraction(1, 10**6)


@pytest.mark.every
@pytest.mark.parametrize(("data", "box", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES])
def test_lies(data, box, reason):
    with pytest.raises((Unproved, Malformed)) as caught:
        enclosed_values(data, box)
    assert reason in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_windows_are_kept_for_boxes_inside_alone():
    """A wider, another, or a more precise box is not served from what is remembered."""
    map_ = flight(BALL)
    for low, high in (("2", "2.001"), ("1.999", "2.001"), ("2.0001", "2.0002"), ("2.5", "2.6")):
        for bits in (64, 128, 64):
            x = enclosed([(Fraction("0.5"),) * 2, (Fraction(low), Fraction(high))], bits)
            kept, new = map_.values(x), flight(BALL).values(x)
            assert all(a.lo <= b.hi and b.lo <= a.hi for a, b in zip(kept, new, strict=True))
    with pytest.raises(Unproved):
        map_.values(enclosed([(Fraction("0.5"),) * 2, (Fraction("0.1"), Fraction("2.6"))], 64))


# -- generality ------------------------------------------------------------------------------------

BARRED = """
import json, sys
class Barred:
    def find_spec(self, name, path=None, target=None):
        if name.startswith(("proofs.trusted.paper", "proofs.trusted.equations")):
            raise ImportError(name)
sys.meta_path.insert(0, Barred())
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.rules import find_rule
document, context = json.load(sys.stdin), Context()
for name, data in document["functions"].items():
    context.functions[name] = read_map(name, Reader(data), context.functions)
for name, step in document["steps"].items():
    context.known[name] = find_rule(step["rule"])(context, Reader(step["witness"]))
print("\\n".join(context.known[name].sentence for name in document["claims"]))
"""


def barred(script, text=""):
    command = [sys.executable, "-c", script]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_a_horseshoe_of_the_ball_needs_nothing_of_the_paper():
    file = ball_example()  # has cones, too
    box = [["28971361/25000000", "28971411/25000000"], ["70584009/50000000", "70584109/50000000"]]
    orbit = add_orbit(file, 2, box, [["-1.0497", "-0.7723"], ["0.0676", "0.0471"]], "10")
    entropy = horseshoe(file)
    document = file.document("cone-1", entropy, orbit)
    rules = {step["rule"] for step in document["steps"].values()}
    assert rules == {"h-set", "covers", "graph", "entropy", "cone", "periodic-orbit"}
    made = barred(BARRED, render(document))
    assert not made.stderr
    cone, entropy, orbit = made.stdout.splitlines()
    assert "conjugate to the two-sided shift" in cone
    assert "at least log(2), which lies in [0.69314718" in entropy
    assert "exactly one periodic orbit of least period 2" in orbit
    assert "(`phi` having increased by 10 periods); it is a saddle" in orbit


@pytest.mark.parametrize("name", ["proofs.trusted.paper", "proofs.trusted.equations"])
def test_the_bar_holds(name):
    assert (
        f"ImportError: {name}"
        in barred(f"{BARRED.partition('from proofs')[0]}import {name}").stderr
    )
