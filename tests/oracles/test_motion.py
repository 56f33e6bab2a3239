"""The oracles' motion against dense simulation, and against closed forms."""

import math
import random
from fractions import Fraction

import flint
import mpmath
import pytest

from tests.oracles.motion import Gap, Impact, _Floats, ball, flight, next_impact, separation, sticks

PAPER = Fraction("0.2121"), Fraction("-0.2")


def simulated(eta, nu, phi, epsilon=0, gamma=0, until=80, count=400_000):
    """The first sign change of the gap on a fine grid, or None."""
    import numpy as np

    eta, nu, phi, epsilon, gamma = map(float, (eta, nu, phi, epsilon, gamma))
    t = np.linspace(0, until, count)[1:]
    mass = (1 + nu * np.sin(phi)) * np.cos(eta * t)
    mass += (epsilon * gamma + nu / eta * (1 + epsilon) * np.cos(phi)) * np.sin(eta * t)
    gap = math.copysign(1, nu) * (mass - 1 - nu * np.sin(phi + t))
    below = np.nonzero(gap < 0)[0]
    return t[below[0]] if len(below) else None


@pytest.mark.parametrize("seed", range(60))
def test_first_impacts_are_those_of_a_dense_simulation(seed):
    rng = random.Random(seed)
    eta, nu = Fraction(rng.randint(50, 2500), 1000), Fraction(rng.randint(-950, 950) or 1, 1000)
    phi = Fraction(rng.randint(0, 6283), 1000)
    epsilon = Fraction(rng.choice((0, 0, 100, 500, 900)), 1000)
    gamma = -nu / eta * Fraction(math.cos(phi)) + Fraction(rng.randint(1, 500), 1000) / (
        1 if nu > 0 else -1
    )
    found = flight(eta, nu, phi, epsilon, gamma, latest=70)
    if found == "sticks":
        assert epsilon == 0
        assert sticks(eta, nu, phi)
        return
    own = simulated(eta, nu, phi, epsilon, gamma)
    if isinstance(found, Impact):
        assert own is not None
        assert abs(own - float(found.time)) < 5e-3 or own < 1e-3
    else:
        assert found in ("none", "touches", None)
        assert found is None or own is None or own > 70 or own > 6.28 * eta.denominator - 0.1


def test_the_flights_of_the_paper_s_figures():
    """Figure 2 and 5: f(1.11) about 1.13; the orbit (4.64, 6.05); superstable."""
    assert abs(next_impact(*PAPER, Fraction("1.11")).phase - 1.1292) < 1e-3
    away = separation(*PAPER)
    assert abs(float(away) - 6.05) < 0.005
    assert abs(next_impact(*PAPER, Fraction(4)).phase - 4.64) < 0.005


def test_derivatives_are_difference_quotients():
    state = (*PAPER, Fraction("1.13"), Fraction("0.01"), Fraction("-0.2"))
    step = Fraction(1, 10**12)
    one = flight(*state)
    for place in (2, 4):
        moved = flight(*(x + step * (i == place) for i, x in enumerate(state)))
        with flint.ctx.workprec(200):
            by = [
                (moved.lifted - one.lifted) / ball(step),
                (moved.velocity - one.velocity) / ball(step),
            ]
        column = [row[(place - 2) // 2] for row in one.derivative()]
        assert all(abs(float(x - y)) < 1e-8 for x, y in zip(by, column, strict=True))


def test_the_gap_is_that_of_equation_10():
    eta, nu, phi, t = (mpmath.mpf(x) for x in ("0.2121", "-0.2", "1.11", "3.7"))
    printed = (1 + nu * mpmath.sin(phi)) * mpmath.cos(eta * t) - 1 - nu * mpmath.sin(phi + t)
    printed += nu / eta * mpmath.cos(phi) * mpmath.sin(eta * t)
    assert abs(Gap(_Floats, *PAPER, 1.11).at(3.7)[0] + float(printed)) < 1e-12


def test_a_launch_that_only_touches_is_told():
    assert flight(Fraction(1, 2), Fraction(-1, 2), Fraction(1)) == "touches"
    assert flight(Fraction(1), Fraction(-1, 2), Fraction(1)) == "touches"
