"""What floating point sees of the circle, against a scan of the equation of motion."""

import math
from fractions import Fraction
from itertools import pairwise

import pytest

from proofs.motion.system import System
from proofs.search.orbits import FALLS, FLIES, RISES, STICKS, TOUCHES, stable_cycle
from proofs.search.portrait import fates, rebounding_fates, stretches
from tests.oracles.motion import Impact, flight

F = Fraction
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


def test_fates_count_all_orbits():
    found = {fate.name: fate.share for fate in fates(System(F("5"), F("-0.2")), 24, 50, 100.0)}
    assert found == {"it only touches the table, again and again": 1.0}
    stable = fates(System(F("0.237"), F("0.3")), 24, 300, 100.0)
    assert sum(fate.share for fate in stable) == pytest.approx(1)
    assert any("stable orbit of period" in fate.name for fate in stable)
    (rests,) = fates(System(F(1), F(1)), 7, 5, 9.0)
    assert (rests.name, rests.share) == ("it rests on the table for ever", 1)


@pytest.mark.parametrize(
    ("eta", "nu", "name"),
    [  # by P4.3: period 1 in two turns; by figure 5
        ("0.2121", "1", "a stable orbit of period 1 near 0.134519"),
        ("0.2121", "-0.2", "it sticks or rests on the table in each period, and leaves it again"),
    ],
)
def test_what_sticks_is_followed_from_the_separation(eta, nu, name):
    first = fates(System(F(eta), F(nu)), 24, 400, 200.0)[0]
    assert first.name == name and first.share > 0.9


@pytest.mark.slow
def test_soft_touches_are_no_stable_orbits():
    """Resonance: by R9 all motions tend to grazing ones; eta = 20 also repeats after one turn."""
    for eta in ("1", "20"):
        found = rebounding_fates(System(F(eta), F("-0.5")), 0.5, 12, 100)
        assert [fate.name for fate in found] == ["it only touches the table, again and again"]


def test_stable_orbits_with_restitution():
    """At (0.6, -0.75), 0.3 one impact a period is stable, by the curves C1; others rest."""
    found = rebounding_fates(System(F("0.6"), F("-0.75")), 0.3, 12, 100)
    assert any(fate.name == "a stable orbit of period 1" for fate in found)
    assert math.isclose(sum(fate.share for fate in found), 1)


@pytest.mark.parametrize(("nu", "start", "period"), [("1.62", 0.763, 1), ("1.635", 0.73, 2)])
def test_a_slow_orbit_is_found_with_its_least_period(nu, start, period):
    """Multipliers -0.9935 and 0.9967: after 400 impacts others are still away from them."""
    cycle = stable_cycle(System(F("0.33"), F(nu)), start, 400.0)
    found = [flight(F("0.33"), F(nu), F(seen.phase), latest=400) for seen in cycle]
    ends = [seen.phase for seen in (*cycle[1:], cycle[0])]
    assert len(cycle) == period
    assert all(abs(x.phase - end) < 1e-9 for x, end in zip(found, ends, strict=True))
    assert 0.99 < abs(math.prod(x.slope for x in found)) < 1
