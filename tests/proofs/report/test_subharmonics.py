"""Figure 10 simulated."""

import math
from fractions import Fraction

import pytest

from proofs.report import subharmonics


def test_the_steady_motion_has_the_frequency_of_the_table():
    for nu in (Fraction(-1, 10), Fraction(-2)):
        early, late = subharmonics.spectrum(nu)
        assert early.subharmonic > 0.01 and late.subharmonic < 1e-6
        assert late.drive > 0.5


def test_elastic_impacts_may_repeat_after_eight_periods_without_a_line_below_the_drive():
    nu = -Fraction(math.tan(math.pi / 9))  # nine impacts in eight periods
    samples = subharmonics.displacement(nu, 40, epsilon=1.0)
    period, window = 8 * 64, samples[512:]
    assert max(abs(a - b) for a, b in zip(window[period:], window, strict=False)) < 1e-6
    assert max(abs(a - b) for a, b in zip(window[64:], window, strict=False)) > 0.1
    whole = samples[: 32 * 64]
    below = max(subharmonics.amplitude(whole, Fraction(j, 8)) for j in range(1, 8))
    assert below < 1e-3 and subharmonics.amplitude(whole, Fraction(9, 8)) > 0.1


def test_samples_are_the_flight_after_the_first_impact():
    samples = subharmonics.displacement(Fraction(-1, 2), 1)
    for k, value in enumerate(samples[:40]):
        t = 2 * math.pi * k / 64
        assert value == pytest.approx(math.cos(t) - 0.95 * math.sin(t), abs=1e-12)


@pytest.mark.slow
def test_the_table(capsys):
    subharmonics.main()
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "nu,first_period,drive,subharmonic" and len(lines) == 13
