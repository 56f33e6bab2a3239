"""Phases modulo 2 pi against exact multiples of an independent pi."""

from fractions import Fraction

import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.motion.phase import phase_after, turn


def true_turn():
    ctx.prec = 400
    man, exp = (2 * arb.pi()).mid().man_exp()
    return Fraction(int(man)) * Fraction(2) ** int(exp)


TURN = true_turn()  # to 1e-118
TURNS = [k * TURN for k in range(-1, 170)]
numbers = st.fractions(0, 1000, max_denominator=10**6)


def test_turn_is_enclosed_tightly():
    for precision in (10, 53, 200):
        found = turn(precision)
        assert found.inf < TURN < found.sup
        assert found.wid < Fraction(1, 2 ** (precision - 5))


@pytest.mark.slow
@settings(deadline=None)
@given(numbers, numbers, st.fractions(0, 3, max_denominator=1000))
def test_phase_after_encloses_the_phase(phase, time, width):
    low, high = phase_after(phase, (time, time + width), 100)
    true = (phase + time) % TURN
    slack = Fraction(1, 10**20)
    assert any(low <= true + k * TURN <= low + slack for k in (0, 1))  # 1 where it is undecided
    assert high - low < width + slack
