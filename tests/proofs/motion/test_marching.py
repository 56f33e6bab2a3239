"""The algorithm of A.1: right within its step where it is right, wrong where it must be."""

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.motion.marching import march
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


def test_where_it_is_right_the_error_is_at_most_a_step():
    for delta in (1e-2, 1e-3, 1e-4):
        assert 0 <= march(PAPER, 1.11, delta) - 25.15189922112723 <= delta


def test_it_steps_over_an_impact_next_to_grazing_and_does_not_end_where_there_is_none():
    """1.199985859947 is some 1e-12 below a grazing phase: the gap is negative for some 1e-6."""
    assert march(PAPER, 1.199985859947, 1e-4) > 56
    assert march(PAPER, 1.57, 1e-2, 100.0) is None
