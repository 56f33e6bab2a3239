"""Phases less whole turns, against 50 digits of mpmath."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.motion.digits import agree, phase_after
from tests.proofs.trusted.paper.reference import mp
from tests.proofs.trusted.paper.steps import exact

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
