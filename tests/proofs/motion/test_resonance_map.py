"""The map at resonance: its command, its limit phases, and figure 10 simulated."""

import json
import math
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Interval
from proofs.commands import resonance
from proofs.motion.resonant import TooManyImpacts, angles, motion
from proofs.motion.system import System
from proofs.report import subharmonics
from proofs.search.rebound import Impossible, rebound


def answer(capsys, **state):
    options = [part for name, text in state.items() for part in (f"--{name}", text)]
    assert resonance.main([*options, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def within(bounds, value, slack="1e-40"):
    low, high = (mpf(bounds[side]) for side in ("lower", "upper"))
    return low - mpf(slack) <= value <= high + mpf(slack) and high - low < 1e-28


def ends(bounds):
    return {"lower": str(float(bounds[0])), "upper": str(float(bounds[1]))}


@pytest.mark.parametrize(
    ("nu", "epsilon", "phi", "gamma"),
    [("-0.2", "0.5", "1", "-0.3"), ("3/2", "0.9", "2", "1"), ("-7", "0.99", "6.2", "0")],
)
def test_a_state_agrees_with_the_general_code_and_the_sum(capsys, nu, epsilon, phi, gamma):
    found = answer(capsys, nu=nu, epsilon=epsilon, phi=phi, gamma=gamma)
    numbers = [Fraction(text) for text in (nu, epsilon, phi, gamma)]
    general = rebound(
        System(Fraction(1), numbers[0]), (numbers[2],) * 2, (numbers[3],) * 2, numbers[1]
    )
    for key, bounds in (("phase", general.phase), ("velocity", general.velocity)):
        low, high = (Fraction(found[key][side]) for side in ("lower", "upper"))
        assert low <= bounds[1] and bounds[0] <= high
    a, b, c, d = (Fraction(sum(entry)) / 2 for entry in general.jacobian)
    assert abs(a * d - b * c - numbers[1]) < Fraction(1, 10**25)
    with mp.workdps(60):
        v, e, p, g = (mpf(x.numerator) / x.denominator for x in numbers)
        kick = e * (g + v * mp.cos(p))
        total = sum(mp.atan(kick * e**n) for n in range(int(-140 / mp.log(e)) + 2))
        assert within(found["limit_phase"], (p + 2 * total) % (2 * mp.pi))
        assert within(found["phase"], (p + 2 * mp.atan(kick)) % (2 * mp.pi))
    assert found["sticking"] is False


def test_what_does_not_rebound(capsys):
    touch = answer(capsys, nu="-0.2", epsilon="0", phi="1", gamma="-0.3")
    assert Fraction(touch["phase"]["lower"]) <= 1 <= Fraction(touch["phase"]["upper"])
    with mp.workdps(40):
        assert within(touch["velocity"], mp.cos(1) / 5, "1e-31")
    again = answer(capsys, nu="-0.2", epsilon="0.5", phi="0", gamma="0.2")
    assert again["phase"] == again["limit_phase"] == {"lower": "0", "upper": "0"}
    rest = answer(capsys, nu="0.2", epsilon="0", phi="1", gamma="0.3")
    assert rest["phase"] is rest["velocity"] is None and rest["sticking"] is True
    assert answer(capsys, nu="1", epsilon="1", phi="1", gamma="1")["limit_phase"] is None


def test_the_text_has_all_digits(capsys):
    state = ["--nu", "-0.2", "--epsilon", "0.5", "--phi", "1", "--gamma", "-0.3"]
    assert resonance.main([*state, "--digits", "60"]) == 0
    text = capsys.readouterr().out
    assert text.count("[0.") == 2 and "rests at once      no" in text
    assert "0.59746447785597285867098909025706" in text


@pytest.mark.slow
def test_too_many_impacts_are_undecided(capsys):
    state = [Fraction(text) for text in ("-0.2", "0.9999999999", "1", "-3")]
    with pytest.raises(TooManyImpacts):
        motion(*state)
    options = ["--nu", "-0.2", "--epsilon", "0.9999999999", "--phi", "1", "--gamma", "-3"]
    assert resonance.main(options) == 1
    assert "undecided" in capsys.readouterr().err


def test_almost_touching_is_told_from_impossible():
    phi, nu = Fraction(1), Fraction(-1, 5)
    with mp.workdps(60):
        edge = Fraction(int(mp.cos(1) / 5 * 10**50), 10**50)  # a little below -nu cos(phi)
    assert motion(nu, Fraction(1, 2), phi, edge).phase[0] < 1
    with pytest.raises(Impossible):
        motion(nu, Fraction(1, 2), phi, edge + Fraction(1, 10**49))


def test_the_rest_of_the_series_is_added():
    """One term is an exact number here, and the sum, arctan x, is less."""
    x = Interval(Fraction(1, 2**30))
    found = angles(x, Fraction(0))
    with mp.workdps(40):
        sum_ = mp.atan(mpf(2) ** -30)
        assert mpf(found.inf.numerator) / found.inf.denominator <= sum_ < mpf(2) ** -30
    assert found.inf < x.inf <= found.sup


def test_the_series_is_not_used_where_it_is_slow_and_both_ways_agree():
    """States that are impacts of one motion have one limit."""
    nu, epsilon = Fraction(-1), Fraction(3, 4)
    first = motion(nu, epsilon, Fraction(2), Fraction(-4), digits=25)
    phase, gamma = (sum(ends) / 2 for ends in (first.phase, first.velocity))
    second = motion(nu, epsilon, phase, gamma, digits=25)
    assert abs(sum(first.limit) - sum(second.limit)) < Fraction(1, 10**22)


# -- figure 10 -------------------------------------------------------------------------------------


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
