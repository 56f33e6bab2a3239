"""The simulator, phases and the algorithm of A.1 against the printed equations at 50 digits."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from proofs.motion.digits import agree, phase_after
from proofs.motion.many import next_impacts
from proofs.motion.marching import march
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.transients import until_rest
from tests.oracles import motion
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import exact

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
ETA, NU = mpf("0.2121"), mpf("-0.2")
REST_TURNS = 4  # the period of the stable motion


def flight(phase, kick):
    """(time, speed) of the first impact, by the oracle; the launch has side -1."""
    gamma = (-mpf(kick) - NU * mp.cos(phase)) / ETA
    found = motion.flight(PAPER.eta, PAPER.nu, *map(reference.exact, (phase, 1, gamma)))
    return reference.number(found.time), reference.number(found.speed)


def rest(epsilon, phase, speed, turns=200.0):
    """Whether one motion comes to rest, and after how many turns."""
    (rests,), (last,) = until_rest(PAPER, *(np.array([x]) for x in (epsilon, phase, speed)), turns)
    return rests, last


@pytest.mark.parametrize(
    ("phase", "kick"),
    [("1.11", "0.004"), ("4.64", "0.04"), ("0.3", "0.1"), ("2.5", "0"), ("6.02214", "0.0881")],
)
def test_impacts_are_located_to_rounding_error(phase, kick):
    time, speed = flight(mpf(phase), mpf(kick))
    impact = next_impact(PAPER, float(phase), 100.0, float(kick))
    assert abs(impact.time - time) < 1e-11 * time
    assert abs(impact.speed - speed) < 1e-11


def test_many_impacts_are_those_one_by_one():
    rng = np.random.default_rng(2)
    phases, kicks = rng.uniform(0, 6.283, 300), rng.uniform(0, 0.3, 300) * (rng.random(300) < 0.8)
    horizons = rng.uniform(0, 60, 300)
    found = next_impacts(-1, 0.2121, -0.2, phases, horizons, kicks=kicks)
    rows = zip(phases.tolist(), horizons.tolist(), kicks.tolist(), strict=True)
    for time, speed, row in zip(found.times, found.speeds, rows, strict=True):
        alone = next_impact(PAPER, *row)
        if alone is None:
            assert np.isnan(time)
        else:
            assert abs(time - alone.time) < 1e-9 and abs(speed - alone.speed) < 1e-9
    assert 20 < np.isnan(found.times).sum() < 280


@pytest.mark.parametrize("epsilon", [0.0, 0.01, 0.2, 0.35])
def test_the_flight_from_the_separation_phase_comes_to_rest_in_its_four_turns(epsilon):
    leave = float(reference.separation_phase(ETA, NU))
    rests, turns = rest(epsilon, leave + 1e-9, 0.0)
    assert rests and REST_TURNS - 1 < turns < REST_TURNS


# -- phases less whole turns, against 50 digits of mpmath ------------------------------------------


TURN = exact(2 * mp.pi)
numbers = st.fractions(0, 1000, max_denominator=10**6)


@pytest.mark.slow
@given(numbers, numbers, st.fractions(0, 3, max_denominator=1000))
def test_phase_after_encloses_the_phase(phase, time, width):
    low, high = phase_after(phase, (time, time + width), 100)
    true = (phase + time) % TURN
    slack = Fraction(1, 10**20)
    assert any(low <= true + k * TURN <= low + slack for k in (0, 1))  # 1 where it is undecided
    assert high - low < width + slack


@pytest.mark.parametrize("turns", [1, 2, 4, 100])
def test_phase_after_next_to_whole_turns(turns):
    """A bracket that contains 2 pi k stays one interval, up to and beyond 2 pi."""
    centre, near = exact(2 * mp.pi * turns), Fraction(1, 100)
    low, high = phase_after(Fraction(0), (centre - near, centre + near), 80)
    assert high - low < Fraction("0.0201")
    assert low < TURN - Fraction("0.0099") and high > TURN + Fraction("0.0099")
    low, high = phase_after(Fraction(0), (centre, centre), 64)
    assert 0 <= low <= TURN <= high


def test_agree_counts_digits():
    low = Fraction(100)
    assert agree((low, Fraction("100.01")), 4) and not agree((low, Fraction("100.011")), 4)


# -- the algorithm of A.1: right where it is right, wrong where it must be -------------------------


def printed(eta, nu, psi, delta, horizon):
    """A.1 line by line, from the page, in floating point."""

    def sign(n):
        value = reference.left_side_10(eta, nu, psi, n * delta, mp.sin, mp.cos)
        return (value > 0) - (value < 0)

    first = sign(1)
    n = 1
    while n * delta < horizon:
        if first * sign(n) == -1:
            return n * delta
        n += 1
    return None


@pytest.mark.slow
@pytest.mark.parametrize("phase", ["1.11", "2.5", "3.3", "4.64", "6.1"])
def test_it_is_the_printed_algorithm(phase):
    expected = printed(mpf("0.2121"), mpf("-0.2"), mpf(phase), mpf("0.05"), 60)
    assert march(PAPER, float(phase), 0.05, 60.0) == pytest.approx(float(expected), abs=1e-9)


@pytest.mark.slow
def test_where_it_is_right_the_error_is_at_most_a_step():
    for delta in (1e-2, 1e-3, 1e-4):
        assert 0 <= march(PAPER, 1.11, delta) - 25.15189922112723 <= delta


@pytest.mark.slow
def test_it_steps_over_an_impact_next_to_grazing_and_does_not_end_where_there_is_none():
    """1.199985859947 is some 1e-12 below a grazing phase: the gap is negative for some 1e-6."""
    assert march(PAPER, 1.199985859947, 1e-4) > 56
    assert march(PAPER, 1.57, 1e-2, 100.0) is None
