"""Section 2 and the appendix: closed forms, sticking, separation, and marching, by brute force.

Expected values come from `reference` (the equations typed by hand) at 50 digits and more.
"""

import math
import random
from dataclasses import replace
from fractions import Fraction
from functools import partial

import pytest
from mpmath import mp, mpf

from proofs.motion.marching import march
from proofs.motion.system import System
from proofs.trusted.numbers import Phases
from proofs.trusted.paper import find
from proofs.trusted.paper.s2_foundations import unending
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import PAPER
from tests.proofs.trusted.paper import reference

HALF = System(Fraction(1, 2), Fraction(-1, 2))


def gap(eta, nu, psi, t, epsilon=mpf(0), gamma=mpf(0)):
    return mp.sign(nu) * reference.left_side_14(eta, nu, epsilon, psi, gamma, t)


# -- M6: no impact at all ----------------------------------------------------------------------

slow = partial(pytest.param, marks=pytest.mark.slow)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("eta", "nu", "never"),
    [
        (mp.sqrt(2) / 7, "-0.2", True),
        slow(mp.sqrt(3), "-0.9", True),
        slow(mpf("0.2121"), "-0.2", True),  # a touch after 10000 turns, not before
        # nu <= -1: it touches after one turn, or is below the table
        slow(mp.sqrt(2) / 7, "-1", False),
        slow(mp.sqrt(2) / 7, "-1.5", False),
        slow(mp.sqrt(2) / 7, "0.2", False),  # nu > 0: the mass sticks
        (mpf(2) / 7, "-0.2", False),  # rational: a touch after 7 turns
    ],
)
def test_launched_at_the_top_the_mass_never_touches_the_table_again(eta, nu, never):
    """The hypotheses of `unending`: -1 < nu < 0, and t, eta t never both multiples of 2 pi."""
    turns = [2 * mp.pi * k for k in range(1, 2000)]
    times = [*turns, *(t / eta for t in turns), *(mpf(k) / 97 for k in range(1, 3000))]
    least = min(gap(eta, mpf(nu), mp.pi / 2, t) for t in times)
    assert (least > 1e-12) == never


def test_the_sentence_about_irrational_frequencies_needs_its_lemma():
    lemma, of = unending.needs[0], replace(PAPER, nu=Fraction("-0.3"))
    never = NeverImpacts(of.place, Phases(Fraction("1.57"), Fraction("1.571")))
    told = [find("M6").decide(of, known).theorem for known in ([never, lemma], [never])]
    assert "every irrational eta > 0 there is no impact" in told[0]
    assert "For -1 < nu < 0 and" in told[0] and "irrational" not in told[1]


# -- M5: closed forms --------------------------------------------------------------------------


def first_zero(function, begin, end, pieces=300):
    """Return the first sign change, by scanning and bisection; None if there is none."""
    step = (end - begin) / pieces
    low = begin
    while low < end:
        high = low + step
        if function(low) * function(high) < 0:
            return mp.findroot(function, (low, high), solver="anderson", tol=1e-30)
        low = high
    return None


def test_resonance_is_solved_by_an_arctangent():
    rng = random.Random(3)
    for sign in (1, -1):
        for _ in range(4):
            nu, epsilon = sign * mpf(rng.uniform(0.1, 0.9)), mpf(rng.uniform(0.2, 0.9))
            psi = mpf(rng.uniform(0, 6))
            kick = sign * mpf(rng.uniform(0.1, 2))
            gamma = kick / epsilon - nu * mp.cos(psi)
            t = 2 * mp.atan(kick) + (0 if sign > 0 else 2 * mp.pi)
            found = first_zero(
                lambda x, of=(nu, psi, epsilon, gamma): gap(mpf(1), *of[:2], x, *of[2:]),
                mpf("0.01"),
                mpf(7),
            )
            assert abs(found - t) < mpf(10) ** -25
            after = reference.right_side_15(1, nu, epsilon, psi, gamma, t)
            assert abs(after - (kick - nu * mp.cos(psi + t))) < mpf(10) ** -40


@pytest.mark.parametrize(("eta", "turn"), [("0.5", 4), ("2", 2)])
def test_plastic_relations_are_quadratic_at_a_half_and_at_two(eta, turn):
    rng, eta = random.Random(4), mpf(eta)
    for _ in range(8):
        nu, psi = mpf(rng.uniform(-0.9, -0.1)), mpf(rng.uniform(0, 6.28))
        lift, rate = nu * mp.sin(psi), nu * mp.cos(psi)
        if turn == 4:
            a, b, c = 1 + lift, 2 * rate, 1 - 3 * lift
        else:
            a, b, c = lift, rate, -(4 + 3 * lift)
        root = b * b - a * c
        zeros = [(b + s * mp.sqrt(root)) / a for s in (1, -1)] if root > 0 else []
        times = sorted(turn * (mp.atan(u) + (mp.pi if u < 0 else 0)) for u in zeros)
        ends = mpf("0.02"), turn * mp.pi - mpf("0.02")
        inside = [t for t in times if ends[0] < t < ends[1]]
        found = first_zero(lambda t, of=(nu, psi): gap(eta, *of, t), *ends)
        assert (found is None) == (not inside)
        assert found is None or abs(found - inside[0]) < mpf(10) ** -25


# -- M7 to M9: sticking and separation ---------------------------------------------------------


def leaves(eta, nu, psi):
    """Return whether a plastic launch leaves the table at once, by the gap a moment later."""
    with mp.workdps(120):
        return gap(mpf(eta), mpf(nu), psi, mpf(10) ** -12) > 0


def test_what_sticks_is_decided_by_the_acceleration():
    rng = random.Random(5)
    for _ in range(60):
        eta, nu = rng.choice((rng.uniform(0.1, 0.9), rng.uniform(1.1, 3))), rng.uniform(-2, 2)
        psi = mpf(rng.uniform(0, 6.28))
        bend = math.copysign(1, nu) * (nu * (1 - eta**2) * mp.sin(psi) - eta**2)
        assert leaves(eta, nu, psi) == (bend > 0)
    assert leaves("0.5", "-0.5", mpf(1)) and not leaves("0.5", "-0.5", mpf(5))


@pytest.mark.parametrize("nu", ["-0.5", "0.5"])
def test_the_launches_without_acceleration(nu):
    """eta = 1/2: sin = +-2/3, where the third derivative decides."""
    with mp.workdps(120):
        sine = mpf(1) / 3 / mpf(nu)
        for psi in (mp.asin(sine), mp.pi - mp.asin(sine)):
            assert leaves("0.5", nu, psi) == (mp.cos(psi) > 0)


def test_the_launches_without_acceleration_and_jerk():
    """nu = +-1/3, eta = 1/2: sin = +-1, where the fourth derivative decides."""
    with mp.workdps(120):
        assert leaves("0.5", mpf(-1) / 3, -mp.pi / 2)
        assert not leaves("0.5", mpf(1) / 3, mp.pi / 2)


@pytest.mark.parametrize("nu", [-0.7, 0.7])
@pytest.mark.parametrize(("eta", "middle"), [(0.4, True), (2.5, False)])
def test_which_root_is_the_separation_phase(nu, eta, middle):
    """The force of the table on a resting mass goes from push to pull in the stated quadrant."""
    quadrants = {(True, True): 3, (True, False): 1, (False, True): 0, (False, False): 2}
    if abs(eta**2 / (nu * (1 - eta**2))) >= 1:
        nu *= 3
    number = quadrants[nu < 0, middle]
    steps = [(i + 0.5) * math.tau / 2000 for i in range(2001)]
    push = [reference.launch_acceleration(eta, nu, phi) < 0 for phi in steps]
    (ends,) = [
        (phi, later)
        for phi, later, now, then in zip(steps, steps[1:], push, push[1:], strict=False)
        if now and not then
    ]
    assert number == int(ends[0] / (math.pi / 2))
    assert math.isclose(math.sin(ends[0]), eta**2 / (nu * (1 - eta**2)), abs_tol=5e-3)


def test_where_the_mass_stays_for_ever():
    """nu = 0.2 at eta on either side of 0.4083, eta = 0.237 at nu on either side of 0.0595."""
    for eta, nu, stays in (
        ("0.4083", "0.2", True),
        ("0.4082", "0.2", False),
        ("3", "0.2", True),
        ("0.237", "0.0595", True),
        ("0.237", "0.0596", False),
        ("0.5", "0.1", True),
        ("3", "2", False),
        ("0.5", "-0.1", False),
    ):
        phases = [mp.pi / 2 * i for i in range(4)]
        worst = max(reference.launch_acceleration(mpf(eta), mpf(nu), phi) for phi in phases)
        assert (worst <= 0) == stays
        system = System(Fraction(eta), Fraction(nu))
        assert (system.sticking_arc == "all") == stays


# -- A1 ----------------------------------------------------------------------------------------


def test_marching_ends_for_no_step_where_the_sign_never_changes():
    for delta in (0.1, 0.01, 0.003):
        assert march(System(Fraction(1), Fraction(-1, 5)), 2.0, delta) is None
        assert march(HALF, 1.0, delta) is None


def test_marching_steps_over_an_impact():
    psi = -(mpf(10) ** -6)
    assert gap(mpf("0.5"), mpf("-0.5"), psi, mpf("9.4247")) < 0
    found = march(HALF, float(psi), 0.01)
    assert found is None or found >= 12.57


def test_marching_begins_below_the_table():
    times = [mpf(i) / 10000 for i in range(1, 100)]
    signs = [gap(mpf("0.5"), mpf("-0.5"), mpf("3.87"), t) > 0 for t in times]
    assert signs[0] and signs[9] and not signs[-1]
    found = march(HALF, 3.87, 0.01)
    assert found is not None and found > 0.03


@pytest.mark.parametrize("nu", ["-0.5", "0.5"])
def test_marching_is_wrong_before_the_phases_that_stick(nu):
    """eta = 1/2, a phase 0.0001 before sticking begins, where cos < 0: the flight is that short."""
    psi = mp.pi - mp.asin(mpf(1) / 3 / mpf(nu)) - mpf("0.0001")
    assert leaves("0.5", nu, psi)
    assert gap(mpf("0.5"), mpf(nu), psi, mpf("0.001")) < 0
    found = march(System(Fraction(1, 2), Fraction(nu)), float(psi), 0.01)
    assert found is None or found > 0.03


@pytest.mark.slow
def test_the_condition_for_marching_is_sufficient():
    rng, tried = random.Random(6), 0
    for _ in range(40):
        eta, nu, psi = rng.uniform(0.2, 1.5), rng.uniform(-0.9, 0.9), rng.uniform(0, 6.28)
        bend = math.copysign(1, nu) * (nu * (1 - eta**2) * math.sin(psi) - eta**2)
        if bend <= 0.05:
            continue
        of = (mpf(eta), mpf(nu), mpf(psi))
        zero = first_zero(lambda t, of=of: gap(*of, t), mpf("0.05"), mpf(20), 600)
        if zero is None:
            continue
        speed = float(-mp.diff(lambda t, of=of: gap(*of, t), zero))
        reach = 1 + abs(nu) + abs(nu) / eta
        limit = min(3 * bend / (eta**3 * reach + abs(nu)), 2 * speed / (eta**2 * reach + abs(nu)))
        if limit < 0.02:
            continue
        tried += 1
        delta = 0.99 * limit
        found = march(System(Fraction(eta), Fraction(nu)), psi, delta)
        assert found is not None and 0 < found - float(zero) <= delta
    assert tried >= 8
