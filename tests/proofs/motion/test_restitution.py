"""The map with restitution against the oracle's, by (14) and (15)."""

import random
from fractions import Fraction

import flint
import pytest
from mpmath import mp, mpf

from proofs.motion.witness import HORIZON
from proofs.search.rebound import next_state
from proofs.trusted.equations import closing, launch
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.oscillator import Oscillator
from tests.intervals.oracle import ends
from tests.oracles import motion
from tests.proofs.trusted.paper import reference

ETA, NU = Fraction("0.2121"), Fraction("-0.2")
RIGHT = (Fraction("-0.45"), Fraction(0))


def true_flight(eta, nu, epsilon, phi, gamma):
    """The next impact, by the oracle."""
    eta, nu, epsilon, phi, gamma = map(Fraction, (eta, nu, epsilon, phi, gamma))
    return motion.flight(eta, nu, phi, epsilon, gamma)


def single(phi, gamma, epsilon="0.01", eta="0.2121", nu="-0.2", horizon=HORIZON):
    eta, nu, epsilon, phi, gamma = ((Fraction(x),) * 2 for x in (eta, nu, epsilon, phi, gamma))
    return Oscillator((eta, nu, epsilon), horizon), (phi, gamma)


class Next:
    """What is proved of the next impact."""

    def __init__(self, of, box, bits=64):
        found = next_state(of, box, bits)
        self.flight, (self.phase, self.velocity) = found.flight, found.proved.values
        self.derivative, (self.turns,) = found.proved.matrix, found.proved.turns


def contains(bounds, value, slack=Fraction(1, 10**45)):
    """Whether a number of the oracle's, or one to 50 digits, can be in bounds."""
    if isinstance(value, flint.arb):
        low, high = ends(value)
        return bounds[0] <= high and low <= bounds[1]
    value = Fraction(mp.nstr(value, 50))
    return bounds[0] - slack <= value <= bounds[1] + slack


STATES = [
    ("0.2121", "-0.2", "0.01", "1.11", "-0.45"),
    ("0.2121", "-0.2", "0.01", "1.15", "0"),
    ("0.2121", "-0.2", "0.01", "1.32", "-0.237"),
    ("0.2121", "-0.2", "0.5", "1.0", "-0.3"),
    ("0.2121", "-0.2", "0.8", "4.0", "-2"),  # leaves against the acceleration
    ("0.2121", "-0.2", "1", "2.5", "-1.1"),
    ("0.5", "0.7", "0.3", "1.2", "0.9"),  # the table on the other side
    ("1", "0.4", "0.2", "0.9", "0.3"),
]


@pytest.mark.parametrize("state", STATES)
def test_image_and_derivative_at_a_state(state):
    eta, nu, epsilon, phi, gamma = state
    found, true = Next(*single(phi, gamma, epsilon, eta, nu), bits=150), true_flight(*state)
    assert contains(found.flight, true.time) and contains(found.velocity, true.velocity)
    assert contains(found.phase, true.turned(found.turns))
    for entries, row in zip(found.derivative, true.derivative(), strict=True):
        for entry, value in zip(entries, row, strict=True):
            assert contains(entry, value) and entry[1] - entry[0] < Fraction(1, 10**20)


@pytest.mark.parametrize("state", STATES[:4])
def test_determinant_is_epsilon_squared_times_the_ratio_of_closing_speeds(state):
    """Areas (relative velocity) dv dt are preserved by a flight: det DF = epsilon^2 w / w'."""
    eta, nu, epsilon, phi, gamma = (mpf(x) for x in state)
    found = Next(*single(*state[3:], state[2], *state[:2]), bits=150)
    (p, q), (r, s) = ([mpf(str(float(x[0]))) for x in row] for row in found.derivative)
    phase, velocity = (mpf(str(float(x[0]))) for x in (found.phase, found.velocity))
    closing = eta * gamma + nu * mp.cos(phi)
    arriving = eta * velocity + nu * mp.cos(phase)
    assert abs(p * s - q * r - epsilon**2 * closing / arriving) < 1e-12


def test_without_restitution_it_is_the_plastic_map():
    found = Next(*single("1.15", "-0.3", "0"), bits=150)
    time, phase = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf("1.15"))
    assert contains(found.phase, phase, Fraction(1, 10**25))
    slope = reference.slope("0.2121", "-0.2", "1.15", time)
    assert contains(found.derivative[0][0], slope, Fraction(1, 10**20))
    assert found.derivative[0][1] == (0, 0) == found.derivative[1][1]


@pytest.mark.slow
def test_box_contains_the_images_of_its_states_and_oscillators():
    phases = (Fraction("1.12"), Fraction("1.14"))
    reach = Fraction(1, 20000)
    epsilons = Fraction("0.005"), Fraction("0.015")
    sides = (ETA - reach, ETA + reach), (NU - reach, NU + reach), epsilons
    found = Next(Oscillator(sides), (phases, RIGHT))
    random.seed(5)
    for _ in range(20):
        phi, gamma = random.uniform(1.12, 1.14), random.uniform(-0.45, 0)
        eta, nu = random.uniform(0.21205, 0.21215), random.uniform(-0.20005, -0.19995)
        epsilon = random.uniform(0.005, 0.015)
        true = true_flight(eta, nu, epsilon, phi, gamma)
        assert contains(found.phase, true.turned(found.turns))
        assert contains(found.velocity, true.velocity)


def closing_speed(of, box):
    eta, nu, phi, gamma = (Enclosure.of(*side, 64) for side in (*of.ranges[:2], *box))
    return closing(launch(of.formulas.side, eta, nu, phi), gamma) * of.formulas.side


@pytest.mark.parametrize(
    ("phi", "gamma", "possible"),
    [
        ("1.11", "0.4192", True),  # -nu cos(phi) / eta = 0.41929...
        ("1.11", "0.4193", False),
        ("4.0", "-0.6164", True),  # -0.61635...
        ("4.0", "-0.6163", False),
    ],
)
def test_a_mass_does_not_come_from_inside_the_table(phi, gamma, possible):
    state = single(phi, gamma, "0.5")
    assert (closing_speed(*state).lo > 0) is possible
    if possible:
        assert Next(*state).flight[0] > 0
    else:
        with pytest.raises(Unproved):
            Next(*state)


def test_a_box_that_contains_a_grazing_flight_has_no_smooth_image():
    sides = (ETA, ETA), (NU, NU), (Fraction("0.01"),) * 2
    with pytest.raises(Unproved):
        Next(Oscillator(sides), ((Fraction("1.19"), Fraction("1.23")), RIGHT))
