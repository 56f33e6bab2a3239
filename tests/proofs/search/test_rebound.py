"""`python -m proofs impact --epsilon --gamma`: F and DF against the printed (14) and (15)."""

import json
import random
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.commands import impact
from proofs.motion.system import System
from proofs.search.rebound import Impossible, rebound
from tests.proofs.trusted.paper import reference

AT = ["--eta", "0.2121", "--nu", "-0.2"]


def answer(capsys, *arguments):
    assert impact.main([*AT, *arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def printed(eta, nu, epsilon, phi, gamma, horizon=60):
    """(time, phase, velocity) by a scan of (14) for its first sign change, then (15)."""
    side = 1 if nu > 0 else -1

    def gap(t):
        return side * reference.left_side_14(eta, nu, epsilon, phi, gamma, t)

    step = mpf("0.01")
    time = step
    while gap(time + step) > 0:
        time += step
        assert time < horizon
    low, high = time, time + step
    for _ in range(150):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) > 0 else (low, middle)
    velocity = reference.right_side_15(eta, nu, epsilon, phi, gamma, low)
    return low, (phi + low) % (2 * mp.pi), velocity


def within(bounds, value, slack="1e-40"):
    low, high = (Fraction(bounds[side]) for side in ("lower", "upper"))
    slack = mpf(slack)
    below, above = (mpf(end.numerator) / end.denominator for end in (low, high))
    return below - slack <= value <= above + slack


@pytest.mark.parametrize(
    ("phi", "epsilon", "gamma"),
    [
        ("5", "0.3", "-0.3"),
        pytest.param("1.11", "0.01", "-0.3", marks=pytest.mark.slow),
        pytest.param("1", "1", "0", marks=pytest.mark.slow),
    ],
)
def test_a_point_agrees_with_the_printed_equations(phi, epsilon, gamma, capsys):
    found = answer(capsys, "--phi", phi, "--epsilon", epsilon, "--gamma", gamma)
    state = [mpf("0.2121"), mpf("-0.2"), mpf(epsilon), mpf(phi), mpf(gamma)]
    time, phase, velocity = printed(*state)
    assert within(found["flight"], time) and within(found["phase"], phase)
    assert within(found["velocity"], velocity)
    assert found["sticking"] is False and "slope" not in found
    assert (found["epsilon"], found["gamma"]) == (epsilon, [gamma])
    h = mpf("1e-15")
    for column, index in enumerate((3, 4)):
        ends = []
        for sign in (1, -1):
            moved = list(state)
            moved[index] += sign * h
            ends.append(printed(*moved))
        for row in (0, 1):
            slope = (ends[0][row + 1] - ends[1][row + 1]) / (2 * h)
            assert within(found["jacobian"][row][column], slope, "1e-20")


def test_digits_are_certified(capsys):
    found = answer(
        capsys, "--phi", "1.11", "--epsilon", "0.01", "--gamma", "-0.3", "--digits", "60"
    )
    entries = [entry for row in found["jacobian"] for entry in row]
    bounds = [found["flight"], found["phase"], found["velocity"], *entries]
    for each in bounds:
        low, high = Fraction(each["lower"]), Fraction(each["upper"])
        assert 0 < (high - low) * 10**59 < abs(low)


@pytest.mark.slow
def test_a_box_contains_the_images_of_its_points(capsys):
    found = answer(capsys, "--phi", "1.11", "1.12", "--epsilon", "0.01", "--gamma", "-0.3", "-0.25")
    generator = random.Random(3)
    for _ in range(3):
        phi, gamma = mpf(generator.uniform(1.11, 1.12)), mpf(generator.uniform(-0.3, -0.25))
        _, phase, velocity = printed(mpf("0.2121"), mpf("-0.2"), mpf("0.01"), phi, gamma)
        assert within(found["phase"], phase) and within(found["velocity"], velocity)
    (width,) = (Fraction(found["phase"]["upper"]) - Fraction(found["phase"]["lower"]),)
    assert width < Fraction("0.06")


def test_epsilon_0_is_the_plastic_map(capsys):
    plastic = answer(capsys, "--phi", "1.11")
    found = answer(capsys, "--phi", "1.11", "--epsilon", "0", "--gamma", "-0.3")
    assert found["flight"] == plastic["flight"] and found["phase"] == plastic["phase"]
    assert found["jacobian"][0][0] == plastic["slope"]
    assert found["jacobian"][0][1] == {"lower": "0", "upper": "0"}
    stuck = answer(capsys, "--phi", "5", "--epsilon", "0", "--gamma", "-0.3")
    assert stuck["sticking"] is True and set(stuck["dwell"]) == {"lower", "upper"}
    leave = reference.separation_phase(mpf("0.2121"), mpf("-0.2"))
    time, _ = reference.first_impact(mpf("0.2121"), mpf("-0.2"), leave)
    velocity = reference.right_side_15(mpf("0.2121"), mpf("-0.2"), 0, leave, 0, time)
    assert within(stuck["velocity"], velocity, "1e-25")


def test_for_people(capsys):
    assert impact.main([*AT, "--phi", "1.11", "--epsilon", "0.01", "--gamma", "-0.3"]) == 0
    said = capsys.readouterr().out
    assert "epsilon = 0.01, gamma = -0.3" in said
    assert "velocity gamma" in said and "d gamma / d phi" in said and "slope" not in said


def test_no_impact_within_the_horizon_is_status_1(capsys):
    state = ["--epsilon", "0.01", "--gamma", "-0.3", "--horizon", "9"]
    assert impact.main([*AT, "--phi", "1.11", *state]) == 1
    said = capsys.readouterr()
    assert said.err.count("\n") == 1 and "no impact: " in said.err and said.out == ""


@pytest.mark.slow
def test_a_jump_in_the_box_is_undecided(capsys):
    box = ["--phi", "1.19", "1.21", "--epsilon", "0.01", "--gamma", "-0.3"]
    assert impact.main([*AT, *box]) == 1
    said = capsys.readouterr()
    assert said.err.count("\n") == 1 and "undecided" in said.err and said.out == ""


def test_the_possible_velocities_depend_on_the_side():
    at = Fraction(1), Fraction(1)
    above = System(Fraction("0.2121"), Fraction("0.2"))
    with pytest.raises(Impossible, match=r"at least -0\.509"):
        rebound(above, at, (Fraction(-1), Fraction(-1)), Fraction("0.1"))
