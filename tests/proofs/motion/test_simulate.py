"""The simulator against the printed equations at 50 digits; what its tables say."""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp, mpf

from proofs.motion.many import next_impacts
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.transients import until_rest
from tests.oracles import motion
from tests.proofs.trusted.paper import reference

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
