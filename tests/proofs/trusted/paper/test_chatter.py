"""Bounces on the sticking arc: enclosures against the printed equation, and the two lemmas."""

import random
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Undecided
from proofs.motion.chatter import Pushing
from proofs.motion.system import System
from proofs.trusted.paper.s34_circle.bounces import rest_phase
from proofs.trusted.parameters import Place
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
OTHER = System(Fraction("0.6"), Fraction("1.1"))


def point(value):
    return Fraction(value), Fraction(value)


def separation(system):
    return Fraction(mp.nstr(reference.separation_phase(as_mpf(system.eta), as_mpf(system.nu)), 30))


def pushing_on(system, *arc):
    return Pushing(Place.plastic(system.eta, system.nu), *arc)


def landing(system, phase, kick):
    """(time, speed) of the next impact after a rebound with the relative velocity `kick`.

    By (14) and (15); epsilon = 1 serves for any.
    """
    eta, nu, side = as_mpf(system.eta), as_mpf(system.nu), system.side
    gamma = (side * kick - nu * mp.cos(phase)) / eta
    time, gamma = reference.rebound(eta, nu, 1, phase, gamma)
    return time, side * (eta * gamma + nu * mp.cos(phase + time))


@pytest.mark.parametrize(
    ("system", "phase", "kick"),
    [(PAPER, "4.64", "0.04"), (PAPER, "5.3", "0.015"), (PAPER, "3.5", "0.01"),
     (PAPER, "5.7", "0.002"), (OTHER, "4", "0.2"), (OTHER, "2.9", "0.01")],
)  # fmt: skip
def test_a_bounce_is_where_the_printed_equation_puts_it(system, phase, kick):
    last = separation(system)
    last += 0 if last > Fraction(phase) else Fraction("6.283185307")
    (low, high), (_, (slow, fast)) = pushing_on(system, last).bounce(point(phase), point(kick))
    time, speed = landing(system, mpf(phase), mpf(kick))
    assert as_mpf(low) <= time <= as_mpf(high) and high - low < Fraction(1, 1000)
    assert as_mpf(slow) <= speed <= as_mpf(fast) and fast - slow < Fraction(1, 100)


def test_a_bounce_in_more_digits():
    pushing = pushing_on(PAPER, separation(PAPER), 170, 2**130)
    (low, high), (_, (slow, fast)) = pushing.bounce(point("4.64"), point("0.04"))
    assert high - low < Fraction(1, 10**36) and fast - slow < Fraction(1, 10**34)
    eta, nu, phase = as_mpf(PAPER.eta), as_mpf(PAPER.nu), mpf("4.64")
    gamma = (-mpf("0.04") - nu * mp.cos(phase)) / eta
    signs = [reference.left_side_14(eta, nu, 1, phase, gamma, t) for t in map(as_mpf, (low, high))]
    assert signs[0] < 0 < signs[1]  # nu < 0
    arrived = reference.right_side_15(eta, nu, 1, phase, gamma, as_mpf(low))
    speed = -(eta * arrived + nu * mp.cos(phase + as_mpf(low)))
    assert as_mpf(slow) - mpf("1e-45") < speed < as_mpf(fast) + mpf("1e-45")


@pytest.mark.parametrize(("after", "flies"), [("0.1", True), ("0.55", True), ("0.56", False)])
def test_a_mass_flies_until_it_lands(after, flies):
    """At 4.64, with the relative velocity 0.04, it comes back after 0.56."""
    time, _ = landing(PAPER, mpf("4.64"), mpf("0.04"))
    assert 0.55 < time < 0.56
    until = point(Fraction("4.64") + Fraction(after))
    pushing = pushing_on(PAPER, separation(PAPER))
    assert pushing.flies(point("4.64"), point("0.04"), until) is flies
    assert not pushing.flies(point("4.64"), (Fraction(0), Fraction("0.04")), until)


def test_a_bounce_of_a_box_contains_those_of_its_points():
    phases, kicks = (Fraction("4.63"), Fraction("4.65")), (Fraction("0.039"), Fraction("0.041"))
    (low, high), (_, (slow, fast)) = pushing_on(PAPER, separation(PAPER)).bounce(phases, kicks)
    generator = random.Random(7)
    for _ in range(6):
        time, speed = landing(
            PAPER, mpf(generator.uniform(4.63, 4.65)), mpf(generator.uniform(0.039, 0.041))
        )
        assert as_mpf(low) <= time <= as_mpf(high)
        assert as_mpf(slow) <= speed <= as_mpf(fast)


def test_lemma_1_bounds_the_speed_by_the_range_of_the_push():
    for phase, kick in (("4.64", "0.06"), ("5.2", "0.03"), ("3.6", "0.02")):
        time, speed = landing(PAPER, mpf(phase), mpf(kick))
        along = [mpf(phase) + time * k / 200 for k in range(201)]
        push = [-reference.launch_acceleration(mpf("0.2121"), mpf("-0.2"), psi) for psi in along]
        ratio = (speed / mpf(kick)) ** 2
        assert min(push) / max(push) < ratio < max(push) / min(push)


def test_bounces_settle_without_a_bracket_where_they_are_weak():
    pushing = pushing_on(PAPER, separation(PAPER))
    settled, rest = pushing.settle(point("0.01"), point("4.64"), point("0.135"))
    assert not settled.bounces and Fraction("4.64") < rest < Fraction("4.67")
    _, rest = pushing.settle((Fraction(0), Fraction("0.2")), point("4.64"), point("0.135"))
    assert Fraction("4.67") < rest < pushing.last


@pytest.mark.parametrize("epsilon", ["0", "0.01", "0.1", "0.2", "0.3"])
@pytest.mark.parametrize("kick", ["0", "0.0001", "0.005", "0.02"])
def test_the_phase_of_rest_is_one_of_the_lemma(epsilon, kick):
    """By the push of the table between, at many phases: w shrinks by r, and all bounces end."""
    phases, last = (Fraction("4.63"), Fraction("4.64")), separation(PAPER)
    found = rest_phase(PAPER.place, phases, Fraction(kick), Fraction(epsilon), last)
    assert found is not None and phases[1] <= found < last
    along = [mpf("4.63") + (as_mpf(found) - mpf("4.63")) * k / 100 for k in range(101)]
    push = [-reference.launch_acceleration(mpf("0.2121"), mpf("-0.2"), psi) for psi in along]
    ratio = mpf(epsilon) * mp.sqrt(max(push) / min(push))
    assert ratio < 1
    assert mpf("4.64") + 2 * mpf(kick) / (min(push) * (1 - ratio)) <= as_mpf(found)


@pytest.mark.parametrize(
    ("phases", "kick", "epsilon", "last"),
    [
        ("4.63 4.64", "0.02", "0.99", "6"),  # bounces hardly shrink
        ("4.63 4.64", "0.02", "1.5", "6"),
        ("4.63 4.64", "0.9", "0.1", "6"),  # they end beyond the arc
        ("4.63 4.64", "0.02", "0.2", "4.65"),
        ("3.3 4.64", "0.02", "0.2", "6"),  # before the arc the table does not push
    ],
)
def test_where_bounces_may_not_end_there_is_no_phase_of_rest(phases, kick, epsilon, last):
    numbers = tuple(map(Fraction, phases.split()))
    assert rest_phase(PAPER.place, numbers, *map(Fraction, (kick, epsilon, last))) is None


@pytest.mark.parametrize(
    ("epsilon", "phase", "speed"),
    [
        ("0.4", "4.64", "0.1352"),  # the third bounce passes the separation phase
        ("0.9", "4.64", "0.1352"),
        ("0.3", "6", "0.1352"),
        ("0.3", "6.2", "0.01"),  # beyond the arc
        ("0.3", "3.3", "0.01"),  # before it
    ],
)
def test_what_does_not_come_to_rest_is_undecided(epsilon, phase, speed):
    with pytest.raises(Undecided):
        pushing_on(PAPER, separation(PAPER)).settle(point(epsilon), point(phase), point(speed))


def test_a_rebound_as_weak_as_one_likes_has_no_bracket():
    with pytest.raises(Undecided, match="weak"):
        pushing_on(PAPER, separation(PAPER)).bounce(point("4.64"), (Fraction(0), Fraction(1, 10)))
