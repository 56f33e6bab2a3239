import random
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from intervals import IntervalArray, Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.covering import cover_by
from proofs.motion.kernel import Launches, enclose_times, prove_brackets
from proofs.motion.system import System
from proofs.motion.witness import FlightBox
from tests.intervals.oracle import ends
from tests.oracles.motion import flight

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
OTHER = System(Fraction("0.31"), Fraction("0.4"))  # p < 0: the mass flies above the table
I0, I1 = (
    (Fraction("1.11"), Fraction("1.15")),
    (Fraction("1.27"), Fraction("1.32")),
)
CASES = [(PAPER, I0), (PAPER, I1), (OTHER, (Fraction("2.1"), Fraction("2.13")))]


@cache
def true_impact(system, phase):
    """(time, slope) to 60 digits, by the oracle."""
    found = flight(system.eta, system.nu, Fraction(phase))
    return tuple(sum(ends(x)) / 2 for x in (found.time, found.slope))


def holds(x, value, spare=Fraction(1, 10**40)):
    return Fraction(float(x.inf)) - spare <= value <= Fraction(float(x.sup)) + spare


def launches_of(system, cuts):
    return Launches(system, IntervalArray.from_floats(cuts[:-1], cuts[1:]))


def cut(phases, boxes):
    return np.linspace(*map(float, phases), boxes + 1)


def last_times(system, phases, boxes):
    """A time before every first impact, for each box."""
    (found,) = cover_by(FlightBox.plastic(system.place, phases))
    return np.full(boxes, float(found.proved().windows[0][0]))


def about(system, phases):
    return np.array([next_impact(system, float(phase))[0] for phase in phases])


@pytest.mark.parametrize(
    "boxes",
    [1, 7, pytest.param(64, marks=pytest.mark.slow), pytest.param(512, marks=pytest.mark.slow)],
)
@pytest.mark.parametrize(("system", "phases"), CASES)
def test_true_slopes_and_times_are_enclosed(system, phases, boxes):
    cuts = cut(phases, boxes)
    launches, times = launches_of(system, cuts), about(system, cuts)
    around = np.minimum(times[:-1], times[1:]), np.maximum(times[:-1], times[1:])
    spread = np.abs(times[1:] - times[:-1])
    found = enclose_times(launches, last_times(system, phases, boxes), around, spread)
    slopes = launches.slopes(found)
    rng = random.Random(0)
    for _ in range(6):
        i, share = rng.randrange(boxes), Fraction(rng.randrange(1001), 1000)
        phase = Fraction(cuts[i]) + (Fraction(cuts[i + 1]) - Fraction(cuts[i])) * share
        time, slope = true_impact(system, phase)
        assert holds(found[i], time) and holds(slopes[i], slope)
        assert (found.sup - found.inf < 4 * spread + 1e-9).all()


def test_heights_are_those_of_every_phase_of_a_box():
    cuts = cut(I0, 5)
    launches = launches_of(PAPER, cuts)
    for time in (3.0, 17.0, 25.0):
        times = np.full(5, time)
        for phases in (cuts[:-1], cuts[1:], 0.3 * cuts[:-1] + 0.7 * cuts[1:]):
            thin = Launches(PAPER, IntervalArray.from_floats(phases)).heights(times)
            assert not launches.heights(times).certainly_less(thin).any()
            assert not thin.certainly_less(launches.heights(times)).any()


# -- refusals ------------------------------------------------------------------------------------


def brackets_of(system, phases, boxes=64):
    """Launches, last times, and brackets that are proved."""
    cuts = cut(phases, boxes)
    last, times = last_times(system, phases, boxes), about(system, cuts)
    low, high = np.minimum(times[:-1], times[1:]) - 1e-2, np.maximum(times[:-1], times[1:]) + 1e-2
    return launches_of(system, cuts), last, low, high


def test_a_bracket_that_begins_before_the_window_is_refused():
    launches, last, _, high = brackets_of(PAPER, I0)
    prove_brackets(launches, last, last, high)
    with pytest.raises(Undecided, match="not one"):
        prove_brackets(launches, last, last - 0.125, high)


def test_a_window_in_which_the_gap_rises_is_refused():
    launches, last, low, high = brackets_of(PAPER, I0)
    with pytest.raises(Undecided, match=r"gap' < 0 is not proved.*box 0 of 64"):
        prove_brackets(launches, last - 4, low, high)


def test_brackets_that_miss_are_refused():
    launches, last, low, high = brackets_of(PAPER, I0)
    prove_brackets(launches, last, low, high)
    for index in (0, 20, 63):
        for pair in ((low + 2e-2, high), (low, high - 2e-2), (high, low), (low * np.nan, high)):
            moved = [x.copy() for x in (low, high)]
            for one, end in zip(moved, pair, strict=True):
                one[index] = end[index]
            with pytest.raises(Undecided, match=f"box {index} of 64"):
                prove_brackets(launches, last, *moved)
