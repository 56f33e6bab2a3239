"""Phases less whole turns, against 50 digits of mpmath and 1e-118 of Arb."""

from fractions import Fraction

import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from proofs.motion.digits import phase_after
from tests.proofs.trusted.paper import reference  # sets the digits of mpmath
from tests.proofs.trusted.paper.steps import exact

assert reference
numbers = st.fractions(0, 1000, max_denominator=10**6)


def true_turn():
    ctx.prec = 400
    man, exp = (2 * arb.pi()).mid().man_exp()
    return Fraction(int(man)) * Fraction(2) ** int(exp)


TURN = true_turn()


@pytest.mark.parametrize("phase", ["0", "0.752", "1.15", "6.2831853"])
@pytest.mark.parametrize("time", ["0.001", "5.5311", "24.38", "56.1685", "12345.678"])
def test_phase_after_is_the_phase_mod_a_turn(phase, time):
    low, high = phase_after(Fraction(phase), (Fraction(time), Fraction(time)), 80)
    true = exact((mpf(phase) + mpf(time)) % (2 * mp.pi))
    assert low <= true <= high < low + Fraction(1, 10**15)


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
    centre = exact(2 * mp.pi * turns)
    low, high = phase_after(Fraction(0), (centre - Fraction(1, 100), centre + Fraction(1, 100)), 80)
    assert high - low < Fraction("0.0201")
    assert low < exact(2 * mp.pi) - Fraction("0.0099") and high > exact(2 * mp.pi) + Fraction(
        "0.0099"
    )
    low, high = phase_after(Fraction(0), (centre, centre), 64)
    assert 0 <= low <= exact(2 * mp.pi) <= high
