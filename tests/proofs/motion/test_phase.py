"""Phases modulo 2 pi against exact multiples of an independent pi."""

from fractions import Fraction

import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.motion.phase import misses, phase_after, turn


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


@pytest.mark.slow
@settings(deadline=None, max_examples=300)
@given(
    numbers,
    st.fractions(0, 7, max_denominator=50),
    st.fractions(0, 6, max_denominator=50),
    st.fractions(0, 2, max_denominator=50),
)
def test_misses_is_never_claimed_of_what_meets(time, width, start, length):
    target = (start, min(start + length, Fraction(628, 100)))
    if misses((time, time + width), target):
        low, high = time - target[1], time + width - target[0]
        assert not any(low <= turns <= high for turns in TURNS)


def test_misses_next_to_a_multiple_of_the_turn():
    """Just before 8 pi the multiple to take off is not decided by rounding; phase 0 is met."""
    before = turn(64).inf * 4
    assert not misses((before, before + Fraction(13, 2)), (Fraction(0), Fraction(1)))
    assert not misses((before, before + Fraction(1, 10)), (Fraction(0), Fraction(1)))
    assert misses((before + Fraction(1), before + Fraction(2)), (Fraction(0), Fraction(1, 2)))
