"""Single-impact orbits: solutions of (16), which of them are orbits, and their windows.

Expected values come from `reference` (equation (10) typed by hand, mpmath at 50 digits), from
scans of the gap in floating point, and from systems of equations solved by mpmath.
"""

import json
import math
import random
from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp, mpf

from intervals import Undecided
from proofs import single_impact
from proofs.motion.single_orbits import earlier, eta_end, last_period, nu_end, solutions
from proofs.motion.system import System
from proofs.trusted.equations import Clock
from proofs.trusted.paper.s4_single.orbits import (
    FLIP,
    SADDLE,
    STICK,
    distance,
    excess,
    records,
)
from tests.proofs.trusted.paper import reference


def system(eta, nu):
    return System(Fraction(str(eta)), Fraction(str(nu)))


def middle(pair):
    return mpf(pair[0].numerator) / pair[0].denominator / 2 + mpf(pair[1].numerator) / (
        2 * pair[1].denominator
    )


def real(value):
    return mpf(value.numerator) / value.denominator


def drawn(seed, count, sign=0, most=1.5):
    """Random oscillators with |nu| < 1, and numbers of periods, not near a resonance."""
    rng = random.Random(seed)
    for _ in range(count):
        nu = round(rng.uniform(0.01, 0.99), 4) * (sign or rng.choice((-1, 1)))
        eta, n = round(rng.uniform(0.02, most), 4), rng.randint(1, 9)
        if 0.01 < n * eta % 1 < 0.99:
            yield system(eta, nu), n


def lowest(of, n, phase):
    """The least gap on a grid of (0, 2 pi n), near launch and return left out, and its scale."""
    eta, nu, phi = float(of.eta), float(of.nu), float(phase[0])
    t = np.linspace(0, math.tau * n, 4000 * n + 1)[40:-40]
    lift, rate = nu * math.sin(phi), nu * math.cos(phi)
    mass = (1 + lift) * np.cos(eta * t) + rate / eta * np.sin(eta * t)
    return float(np.min((mass - 1 - nu * np.sin(phi + t)) * math.copysign(1, nu)))


# -- solutions of (16) ---------------------------------------------------------------------------


def test_solutions_satisfy_the_impact_equation():
    for of, n in drawn(1, 60):
        for one in solutions(of, n, 120):
            eta, nu, phi = real(of.eta), real(of.nu), middle(one.phase)
            assert abs(reference.left_side_10(eta, nu, phi, 2 * mp.pi * n)) < mpf(10) ** -28
            assert 0 <= one.phase[0] < 7 and one.phase[1] - one.phase[0] < 2**-110


def test_there_are_two_solutions_or_none():
    """Counted by the changes of sign of (16) on a fine grid of phases."""
    for of, n in drawn(2, 60):
        eta, nu = float(of.eta), float(of.nu)
        phases = np.linspace(0, math.tau, 20001)
        left = reference.left_side_10(eta, nu, phases, math.tau * n, np.sin, np.cos)
        changes = int(np.count_nonzero(left[1:] * left[:-1] < 0))
        assert changes == len(solutions(of, n, 80)), (of, n)


def test_closed_forms_of_a_solution():
    """With p = nu sin(phi)/h: the gap of its flight, and nu^2 = A(p)."""
    rng = random.Random(5)
    for of, n in drawn(6, 25):
        eta, nu, x = real(of.eta), real(of.nu), mp.pi * n * real(of.eta)
        turn = mp.sin(x), mp.cos(x)
        for one in solutions(of, n, 150):
            phi, t = middle(one.phase), mpf(rng.uniform(0.1, 20))
            h = 1 + nu * mp.sin(phi)
            p = nu * mp.sin(phi) / h
            now = Clock(mp.sin(eta * t), mp.cos(eta * t), mp.sin(t), mp.cos(t))
            expected = reference.left_side_10(eta, nu, phi, t) / h
            assert abs(distance(eta, turn, now, p) - expected) < mpf(10) ** -25
            factor = turn[1] ** 2 * (1 - p / eta**2)
            assert abs(factor - middle(one.multiplier)) < mpf(10) ** -25 * (1 + abs(factor))
            scale = mpf(1) + abs(factor) ** 2
            assert abs(excess(eta, nu, turn, factor)) < mpf(10) ** -25 * scale


def image(of, n, phi):
    """The impact near 2 pi n after a launch at phi, by Newton's method at 50 digits."""
    eta, nu = real(of.eta), real(of.nu)
    return phi + mp.findroot(lambda t: reference.left_side_10(eta, nu, phi, t), 2 * mp.pi * n)


def test_multipliers_are_slopes_of_the_impact_map():
    for of, n in drawn(3, 25):
        for one in solutions(of, n, 120):
            phi, h = middle(one.phase), mpf(10) ** -15
            slope = (image(of, n, phi + h) - image(of, n, phi - h)) / (2 * h)
            low, high = map(real, one.multiplier)
            size = 1 + abs(slope)
            assert abs(slope - low) < size * mpf(10) ** -12 and high - low < size * mpf(10) ** -25


def test_resonance_and_double_solutions_are_not_guessed():
    with pytest.raises(ValueError, match="integer"):
        solutions(system("0.5", "-0.6"), 2, 80)
    # eta = 1/4, n = 1: theta = atan 4, cos theta = 1/sqrt 17; nu between its neighbours
    below, above = (Fraction(round(17**-0.5, 15)) + Fraction(k, 10**14) for k in (-1, 1))
    assert solutions(System(Fraction(1, 4), below), 1, 80) == []
    assert len(solutions(System(Fraction(1, 4), above), 1, 80)) == 2
    root = Fraction(math.isqrt(10**160 // 17), 10**80)
    assert solutions(System(Fraction(1, 4), root), 1, 80) == []
    near = solutions(System(Fraction(1, 4), root + Fraction(1, 10**80)), 1, 80)
    assert len(near) == 2 and all(one.phase[1] - one.phase[0] < 2**-80 for one in near)
    with pytest.raises(Undecided, match="meet"):  # tan theta = -4/3, cos theta = 3/5
        solutions(system("0.75", "-0.6"), 1, 80)


# -- which of them are orbits --------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("sign", [pytest.param(-1, marks=pytest.mark.slow), 1])
def test_admissible_solutions_against_a_scan_of_the_gap(sign):
    seen = {True: 0, False: 0}
    for of, n in drawn(4 + sign, 150, sign, most=1.5 if sign < 0 else 0.3):
        for one in solutions(of, n, 80):
            if abs(one.multiplier[0]) > 30:  # nearly grazing: the grid does not tell
                continue
            least = lowest(of, n, one.phase)
            push = reference.launch_acceleration(real(of.eta), real(of.nu), middle(one.phase))
            leaves = push > 0
            cosine = mp.cos(middle(one.phase))
            expected = bool(least > 0 and leaves and cosine > 0)
            assert one.admissible is expected, (of, n, one, least)
            seen[expected] += 1
            assert not one.admissible or (one.multiplier[0] < 0) == (sign > 0)
    assert min(seen.values()) > 10


def test_orbits_beyond_the_first_mass_period_are_found():
    """The corrected horseshoe's fixed points, n = 4 and 9; flights of 0.4 and 1.9 mass periods."""
    (fixed,) = [x for x in solutions(system("0.2121", "-0.2"), 9, 90) if x.admissible]
    assert abs(middle(fixed.phase) - mpf("1.316386182666309667088102998")) < mpf(10) ** -25
    _, phase = reference.first_impact(mpf("0.2121"), mpf("-0.2"), middle(fixed.phase))
    assert abs(phase - middle(fixed.phase)) < mpf(10) ** -8
    assert fixed.stable is False


def test_large_amplitudes_are_decided_by_the_flight():
    seen = set()
    for eta, nu, n in (("0.3", "1.5", 1), ("0.1", "3", 2), ("0.7", "-1.5", 1), ("0.4", "-2", 2)):
        of = system(eta, nu)
        for one in solutions(of, n, 80):
            least = lowest(of, n, one.phase)
            push = reference.launch_acceleration(mpf(eta), mpf(nu), middle(one.phase))
            falls = mpf(nu) * of.side * mp.cos(middle(one.phase)) > 0
            assert one.admissible is bool(least > 0 and push > 0 and falls), (of, n, one)
            seen.add(one.admissible)
    assert seen == {True, False}


def test_records_of_fractional_parts():
    eta = Fraction("0.237")
    slow = [
        n
        for n in range(1, 1001)
        if n * eta % 1 > Fraction(1, 2) and all(0 < k * eta % 1 < n * eta % 1 for k in range(1, n))
    ]
    assert list(records(eta, 5000)) == slow == [3, 4, 21, 59, 97, 135, 308, 481, 654, 827]
    assert last_period(system("0.237", "-0.5")) == 1000
    assert last_period(system("0.237", "0.5")) == 2
    assert last_period(system("0.25", "0.5")) == 1
    assert last_period(system("0.25", "-1")) is None


@pytest.mark.slow
def test_stiff_springs_have_no_stable_orbit_above_the_table():
    """Lemma 6, by scans: |nu| = 0.2 and eta > 2.2942."""
    rng, seen = random.Random(7), 0
    while seen < 10:
        n = rng.randint(1, 4)
        eta = (math.ceil(n * rng.uniform(2.3, 9)) - rng.uniform(0, 0.01)) / n
        of = system(round(eta, 5), "-0.2")
        for one in solutions(of, n, 80) if n * of.eta % 1 else ():
            if abs(one.multiplier[0]) < 1:
                assert one.admissible is False and lowest(of, n, one.phase) < 0, (of, n, one)
                seen += 1


# -- ends of windows -----------------------------------------------------------------------------


def slope_18(eta, nu, n, phi):
    """(18) typed by hand."""
    s, c, h = mp.sin(2 * mp.pi * n * eta), mp.cos(2 * mp.pi * n * eta), 1 + nu * mp.sin(phi)
    top = nu / eta * mp.sin(phi) * s - eta * h * s
    return top / (-eta * h * s + nu * mp.cos(phi) * c - nu * mp.cos(phi))


@pytest.mark.parametrize("n", [1, 2, 48])
@pytest.mark.parametrize("end", [FLIP, STICK])
def test_ends_in_eta_against_mpmath(n, end):
    bounds = eta_end(Fraction("0.2"), n, end, 100)
    nu = mpf("0.2")

    def equations(eta, phi):
        last = (
            slope_18(eta, nu, n, phi) + 1
            if end == FLIP
            else reference.launch_acceleration(eta, nu, phi)
        )
        return [reference.left_side_10(eta, nu, phi, 2 * mp.pi * n) * 100, last]

    one = solutions(System(bounds[0], Fraction("0.2")), n, 80)[0]
    found = mp.findroot(equations, (middle(bounds), middle(one.phase)))
    assert abs(found[0] - middle(bounds)) < mpf(10) ** -28
    assert bounds[1] - bounds[0] == Fraction(2, 2**100)


@pytest.mark.parametrize(
    ("n", "end", "expected"),
    [
        (1, STICK, "0.238918491150609"),
        (1, FLIP, "0.322333094279495"),
        (3, SADDLE, "0.290475553530403"),
        (3, STICK, "0.327089604037986"),
        (4, SADDLE, "0.039035349130376"),
    ],
)
def test_ends_in_nu_against_closed_forms(n, end, expected):
    eta, x = mpf("0.237"), mp.pi * n * mpf("0.237")
    e, c = (eta * mp.tan(x)) ** 2, mp.cos(x)
    p = {SADDLE: -e, STICK: eta**2, FLIP: eta**2 * (1 + 1 / c**2)}[end]
    nu = mp.sqrt(p**2 + e) / (1 - p)
    bounds = nu_end(Fraction("0.237"), n, end, 100)
    assert real(bounds[0]) < nu < real(bounds[1])
    assert mp.nstr(nu, 15)[:14] == expected[:14]


def test_ends_beyond_amplitude_one_are_none():
    assert nu_end(Fraction("0.237"), 2, STICK, 100) is None  # at nu = 3.06
    assert nu_end(Fraction("0.237"), 2, FLIP, 100) is None  # p > 1 there


def test_stable_inside_a_window_and_not_outside():
    for n in (1, 5):
        flip, stick = (eta_end(Fraction("0.2"), n, end, 60) for end in (FLIP, STICK))
        step = Fraction(1, 10**9)
        for eta, expected in (
            (flip[0] - step, (True, False)),
            (flip[1] + step, (True, True)),
            (stick[0] - step, (True, True)),
            (stick[1] + step, (False, False)),
        ):
            one = solutions(System(eta, Fraction("0.2")), n, 80)[0]
            assert (one.admissible, one.stable) == expected


def test_earlier_impacts_of_long_flights():
    eta = Fraction("0.237")
    assert earlier(eta, 4) is None and earlier(eta, 3) is None
    time = earlier(eta, 21)
    assert time is not None
    of = system("0.237", "-0.03")
    (one,) = [x for x in solutions(of, 21, 80) if abs(x.multiplier[0]) < 1]
    phi = middle(one.phase)
    gap = reference.left_side_10(mpf("0.237"), mpf("-0.03"), phi, real(time))
    assert -gap < 0 < time < 42 * 3.1415


# -- the command ---------------------------------------------------------------------------------


def test_command_answers_in_json(capsys):
    assert single_impact.main(["--eta", "0.237", "--nu", "0.3", "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    stable = [one for one in answer["solutions"] if one["stable"]]
    assert [one["n"] for one in stable] == [1] and stable[0]["admissible"] is True
    low, high = (mpf(stable[0]["phase"][end]) for end in ("lower", "upper"))
    left = [reference.left_side_10(mpf("0.237"), mpf("0.3"), x, 2 * mp.pi) for x in (low, high)]
    assert left[0] * left[1] <= 0 and high - low < mpf(10) ** -30
    assert answer["complete"] is True and answer["resonant"] == []


def test_command_says_what_is_resonant_and_what_is_left_out(capsys):
    assert single_impact.main(["--eta", "0.5", "--nu", "-0.6", "--n", "2", "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["resonant"] == [2] and answer["solutions"] == []
    assert single_impact.main(["--eta", "0.2121", "--nu", "-0.2", "--most", "4"]) == 0
    out = capsys.readouterr().out
    assert "n = 4: an orbit, not stable" in out and "greater n" not in out


@pytest.mark.parametrize(
    "arguments",
    [
        ["--eta", "0", "--nu", "0.1"],
        ["--eta", "0.3", "--nu", "0"],
        ["--eta", "0.3", "--nu", "0.1", "--n", "1.5"],
        ["--eta", "0.3", "--nu", "0.1", "--n", "0"],
        ["--eta", "zero", "--nu", "0.1"],
        ["--nu", "0.1"],
    ],
)
def test_bad_input_is_one_line(arguments, capsys):
    with pytest.raises(SystemExit) as left:
        single_impact.main(arguments)
    captured = capsys.readouterr()
    assert left.value.code == 2
    assert captured.out == "" and captured.err.count("\n") == 1


def test_a_saddle_node_is_undecided_and_does_not_hide_the_rest(capsys):
    assert single_impact.main(["--eta", "3/4", "--nu", "-3/5", "--json", "-"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert answer["undecided"] == [1, 3] and answer["resonant"] == [4]
    assert single_impact.main(["--eta", "3/4", "--nu", "-3/5", "--n", "1"]) == 1
    assert "n = 1: undecided" in capsys.readouterr().out
