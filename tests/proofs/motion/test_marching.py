"""The algorithm of A.1: right within its step where it is right, wrong where it must be."""

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.motion.marching import STEPS, flight, march, trials, wrong_inputs
from proofs.motion.system import System
from tests.proofs.trusted.paper import reference

pytestmark = pytest.mark.slow

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))


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


@pytest.mark.parametrize("phase", ["1.11", "2.5", "3.3", "4.64", "6.1"])
def test_it_is_the_printed_algorithm(phase):
    expected = printed(mpf("0.2121"), mpf("-0.2"), mpf(phase), mpf("0.05"), 60)
    assert march(PAPER, float(phase), 0.05, 60.0) == pytest.approx(float(expected), abs=1e-9)


@pytest.mark.parametrize("phase", ["1.11", "1.15", "2.5", "6.1"])
def test_where_it_is_right_the_error_is_at_most_a_step(phase):
    for trial in trials(PAPER, Fraction(phase)):
        assert 0 <= trial.error <= trial.delta and trial.seconds > 0


def test_a_step_too_many_passes_chunks_of_the_vector():
    assert march(PAPER, 1.11, 1e-4) == pytest.approx(25.15189922, abs=1e-4)
    assert march(PAPER, 1.57, 1e-2, 100.0) is None


def test_wrong_inputs_are_wrong_at_every_step_tried():
    found = {one.reason: one for one in wrong_inputs()}
    assert set(found) == {"grazing", "onset of sticking", "sticking", "resonance"}
    for one in found.values():
        assert set(one.returned) == set(STEPS)
        for value in one.returned.values():
            assert value is None or abs(value - float(sum(one.truth)) / 2) > 10 * max(STEPS)
    grazing, onset = found["grazing"], found["onset of sticking"]
    assert grazing.truth[1] < 26 and min(grazing.returned.values()) > 56
    assert onset.truth[1] < Fraction(1, 10**8) and min(onset.returned.values()) > 6
    resonance = found["resonance"]
    assert resonance.truth is None and set(resonance.returned.values()) == {None}


def test_the_certified_grazing_impact_is_there_in_the_printed_equation():
    """The gap dips below 0 for some 5e-6 around the certified time, which no step of 1e-4 sees."""
    grazing = next(one for one in wrong_inputs((1e-2,)) if one.reason == "grazing")
    low, high = (mpf(t.numerator) / t.denominator for t in grazing.truth)
    phase = mpf(grazing.phase.numerator) / grazing.phase.denominator

    def gap(t):
        return -reference.left_side_10(mpf("0.2121"), mpf("-0.2"), phase, t)

    assert gap(low - mpf("1e-9")) > 0 > gap(high + mpf("1e-9"))
    assert gap(high + mpf("1e-5")) > 0 > gap(high + mpf("1e-6"))


def test_at_resonance_the_mass_touches_the_table_and_no_sign_reverses():
    for phase in ("0", "1", "4"):
        for t in (mpf("0.1"), mp.pi, 2 * mp.pi, mpf(11)):
            gap = -reference.left_side_10(mpf(1), mpf("-0.2"), mpf(phase), t)
            assert abs(gap - (1 - mp.cos(t))) < mpf(10) ** -45


def test_no_certified_impact_no_trials():
    assert flight(System(Fraction(1), Fraction("-0.2")), Fraction(1)) is None
    with pytest.raises(ValueError, match="no certified impact"):
        trials(System(Fraction(1), Fraction("-0.2")), Fraction(1))
