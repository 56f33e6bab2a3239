"""Figure 10 simulated."""

import cmath
import math
from fractions import Fraction

from proofs.report.figures import resonance


def amplitude(samples, cycles):
    """That of the oscillation with so many cycles a table period, 64 samples each."""
    turn = -2j * math.pi * float(cycles) / 64
    return 2 * abs(sum(x * cmath.exp(turn * k) for k, x in enumerate(samples))) / len(samples)


def below(samples):
    """The largest amplitude at a multiple of an eighth of the table's frequency below it."""
    return max(amplitude(samples, Fraction(j, 8)) for j in range(1, 8))


def test_the_steady_motion_has_the_frequency_of_the_table():
    for nu in (Fraction(-1, 10), Fraction(-2)):
        samples = resonance.displacement(nu, 432)
        early, late = samples[: 32 * 64], samples[400 * 64 :]
        assert below(early) > 0.01 and below(late) < 1e-6 and amplitude(late, 1) > 0.5


def test_elastic_impacts_may_repeat_after_eight_periods_without_a_line_below_the_drive():
    nu = -Fraction(math.tan(math.pi / 9))  # nine impacts in eight periods
    samples = resonance.displacement(nu, 40, epsilon=1.0)
    period, window = 8 * 64, samples[512:]
    assert max(abs(a - b) for a, b in zip(window[period:], window, strict=False)) < 1e-6
    assert max(abs(a - b) for a, b in zip(window[64:], window, strict=False)) > 0.1
    whole = samples[: 32 * 64]
    assert below(whole) < 1e-3 and amplitude(whole, Fraction(9, 8)) > 0.1
