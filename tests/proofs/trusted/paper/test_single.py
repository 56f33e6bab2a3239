"""Single-impact orbits: solutions of (16), which of them are orbits, and their windows.

Expected values come from `reference` (equation (10) typed by hand, mpmath at 50 digits), from
scans of the gap in floating point, and from systems of equations solved by mpmath.
"""

import json
import math
import random
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Undecided
from proofs.commands import single_impact
from proofs.motion.single_orbits import last_period, solutions
from proofs.motion.system import System
from proofs.trusted.equations import Clock
from proofs.trusted.paper.s4_single.orbits import (
    distance,
    excess,
    records,
)
from tests.oracles import single
from tests.oracles.motion import inside, inside_mod
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf


def system(eta, nu):
    return System(Fraction(str(eta)), Fraction(str(nu)))


def middle(pair):
    return mpf(pair[0].numerator) / pair[0].denominator / 2 + mpf(pair[1].numerator) / (
        2 * pair[1].denominator
    )


def drawn(seed, count, sign=0, most=1.5):
    """Random oscillators with |nu| < 1, and numbers of periods, not near a resonance."""
    rng = random.Random(seed)
    for _ in range(count):
        nu = round(rng.uniform(0.01, 0.99), 4) * (sign or rng.choice((-1, 1)))
        eta, n = round(rng.uniform(0.02, most), 4), rng.randint(1, 9)
        if 0.01 < n * eta % 1 < 0.99:
            yield system(eta, nu), n


# -- solutions of (16) ---------------------------------------------------------------------------


def judged(of, n, one):
    """Whether the oracle takes a solution for an orbit; None where it does not tell."""
    (phi,) = [x for x in single.solutions(of.eta, of.nu, n) if inside_mod(x, one.phase)]
    assert inside(single.slope18(of.eta, of.nu, n, phi), one.multiplier)
    return single.is_orbit(of.eta, of.nu, n, phi)


def test_solutions_and_orbits_are_those_the_oracle_sees():
    """By (17) and (18), and the first impact after each launch."""
    seen = {True: 0, False: 0}
    for of, n in (*drawn(1, 60), *drawn(5, 60, 1, most=0.3)):
        found = solutions(of, n, 120)
        assert len(found) == len(single.solutions(of.eta, of.nu, n)), (of, n)
        for one in found:
            assert 0 <= one.phase[0] < 7 and one.phase[1] - one.phase[0] < 2**-110
            assert one.multiplier[1] - one.multiplier[0] < (1 + abs(one.multiplier[0])) / 10**25
            expected = judged(of, n, one)
            assert expected in (None, one.admissible), (of, n, one)
            seen[one.admissible] += 1
            assert not one.admissible or (one.multiplier[0] < 0) == (of.nu > 0)
    assert min(seen.values()) > 10


def test_closed_forms_of_a_solution():
    """With p = nu sin(phi)/h: the gap of its flight, and nu^2 = A(p)."""
    rng = random.Random(5)
    for of, n in drawn(6, 25):
        eta, nu, x = as_mpf(of.eta), as_mpf(of.nu), mp.pi * n * as_mpf(of.eta)
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
            assert one.admissible is judged(of, n, one), (of, n, one)
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


# -- ends of windows -----------------------------------------------------------------------------


def slope_18(eta, nu, n, phi):
    """(18) typed by hand."""
    s, c, h = mp.sin(2 * mp.pi * n * eta), mp.cos(2 * mp.pi * n * eta), 1 + nu * mp.sin(phi)
    top = nu / eta * mp.sin(phi) * s - eta * h * s
    return top / (-eta * h * s + nu * mp.cos(phi) * c - nu * mp.cos(phi))


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


@pytest.mark.slow
@pytest.mark.parametrize("nu", ["1", "-1"])
def test_at_amplitude_one_a_solution_is_at_rest_and_the_other_as_elsewhere(nu):
    """It is sin(phi) = -1/nu, cos(phi) = 0; the other one is continued from |nu| = 1 -+ 1e-12."""
    for eta, n in (("0.3", 1), ("0.3", 2), ("0.7", 2), ("0.1", 3)):
        *others, rest = solutions(system(eta, nu), n, 80)
        assert rest.multiplier is None and rest.admissible is rest.stable is False
        assert abs(mp.sin(middle(rest.phase)) * mpf(nu) + 1) < mpf(10) ** -40
        (one,) = others
        for near in (
            Fraction(nu) * (1 + step) for step in (Fraction(1, 10**12), -Fraction(1, 10**12))
        ):
            found = solutions(System(Fraction(eta), near), n, 80)
            match = min(found, key=lambda x: abs(middle(x.phase) - middle(one.phase)))
            assert abs(middle(match.phase) - middle(one.phase)) < mpf(10) ** -9
            assert abs(middle(match.multiplier) - middle(one.multiplier)) < mpf(10) ** -8
            assert (match.admissible, match.stable) == (one.admissible, one.stable)
    assert [x.multiplier for x in solutions(system("0.5", nu), 1, 80)] == [None]


@pytest.mark.parametrize(("eta", "nu"), [("1e-30", "0.2"), ("1e-30", "-0.2")])
def test_very_soft_springs_are_decided_by_the_lemmas(eta, nu):
    """Lemma 2: for nu < 0 there is no orbit with n eta < 1/2; lemma 3: for nu > 0 there is."""
    found = solutions(System(Fraction(eta), Fraction(nu)), 1, 80)
    assert [one.admissible for one in found] == [nu == "0.2", False]
    assert found[0].stable is False


def test_a_launch_at_rest_height_has_the_slope_of_18():
    """eta = 1/2, n = 1, nu = -3/2: 1 + nu sin(phi) = 0, where p is infinite; (18) is 0."""
    one, other = solutions(system("1/2", "-3/2"), 1, 80)
    assert one.multiplier == other.multiplier == (0, 0) and one.admissible and one.stable
    phi = middle(one.phase)
    assert abs(slope_18(mpf(1) / 2, mpf("-1.5"), 1, phi)) < mpf(10) ** -20
    found = reference.first_impact(mpf(1) / 2, mpf("-1.5"), phi)
    assert abs(found[0] - 2 * mp.pi) < mpf(10) ** -15


def test_a_saddle_node_is_undecided_and_does_not_hide_the_rest(capsys):
    assert single_impact.main(["--eta", "3/4", "--nu", "-3/5", "--json", "-"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert answer["undecided"] == [1, 3] and answer["resonant"] == [4]
    assert single_impact.main(["--eta", "3/4", "--nu", "-3/5", "--n", "1"]) == 1
    assert "n = 1: undecided" in capsys.readouterr().out
