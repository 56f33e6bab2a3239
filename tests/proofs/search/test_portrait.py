"""What floating point sees of the circle, against a scan of the equation of motion."""

import math
from fractions import Fraction
from itertools import pairwise

import pytest

from proofs.motion.system import System
from proofs.search.orbits import FALLS, FLIES, RISES, STICKS, TOUCHES, stable_cycle
from proofs.search.portrait import fates, stretches
from tests.oracles.motion import Impact, flight

F = Fraction
LEAVES = "it sticks or rests on the table in each period, and leaves it again"
KINDS = {"sticks": STICKS, "touches": TOUCHES, "none": FLIES}


@pytest.mark.parametrize(
    ("eta", "nu"), [("0.2121", "-0.2"), ("0.25", "-0.3"), ("5", "-0.2"), ("0.5", "0.9")]
)
def test_stretches_are_what_the_oracle_sees(eta, nu):
    system = System(F(eta), F(nu))
    seen = stretches(system, 300, 100.0)
    assert all(a.points[-1].phase < b.points[0].phase for a, b in pairwise(seen))
    for stretch in seen:
        if stretch.width < 0.05:
            continue
        point = stretch.points[len(stretch.points) // 2]
        found = flight(system.eta, system.nu, F(point.phase), latest=100)
        if isinstance(found, Impact):
            assert stretch.kind == (RISES if found.slope > 0 else FALLS)
            assert point.image - point.phase == pytest.approx(float(found.time), abs=1e-5)
        else:
            assert stretch.kind == KINDS[found]
        slopes = [x.slope for x in stretch.points]
        assert stretch.kind not in (RISES, FALLS) or min(slopes) > 0 or max(slopes) < 0


@pytest.mark.parametrize(
    ("eta", "nu", "epsilon", "name"),
    [  # by P4.3: period 1 in two turns; by figure 5; by the curves C1; at resonance by R9
        ("0.2121", "1", 0, "a stable orbit of period 1"),
        ("0.237", "0.3", 0, "a stable orbit of period 1"),
        (
            "0.2121",
            "-0.2",
            0,
            "it sticks or rests on the table in each period, and leaves it again",
        ),
        ("5", "-0.2", 0, "it only touches the table, again and again"),
        ("1", "1", 0, "it rests on the table for ever"),
        ("0.6", "-0.75", 0.3, "a stable orbit of period 1"),
        ("1", "-0.5", 0.5, "it only touches the table, again and again"),
        ("20", "-0.5", 0.5, "it only touches the table, again and again"),
    ],
)
def test_motions_come_to_what_is_proved_elsewhere(eta, nu, epsilon, name):
    found = fates(System(F(eta), F(nu)), epsilon, 12, 100)
    assert [(fate.name, fate.share) for fate in found] == [(name, 1.0)]


@pytest.mark.parametrize(("nu", "start", "period"), [("1.62", 0.763, 1), ("1.635", 0.73, 2)])
def test_a_slow_orbit_is_found_with_its_least_period(nu, start, period):
    """Multipliers -0.9935 and 0.9967: after 400 impacts others are still away from them."""
    cycle = stable_cycle(System(F("0.33"), F(nu)), start, 400.0)
    found = [flight(F("0.33"), F(nu), F(seen.phase), latest=400) for seen in cycle]
    ends = [seen.phase for seen in (*cycle[1:], cycle[0])]
    assert len(cycle) == period
    assert all(abs(x.phase - end) < 1e-9 for x, end in zip(found, ends, strict=True))
    assert 0.99 < abs(math.prod(x.slope for x in found)) < 1
