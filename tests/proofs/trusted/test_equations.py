"""The shared equations against the paper's, typed by hand, by exact symbolic identities."""

import pytest
import sympy
from mpmath import mpf

from intervals import Jet
from proofs.trusted.equations import (
    clock,
    gap,
    inverse_bend,
    inverse_slope,
    launch,
    launch_acceleration,
    launch_with_restitution,
    registered_sincos,
    slope,
)
from tests.proofs.trusted.paper import reference

eta, nu, phi, t, epsilon, gamma = sympy.symbols("eta nu phi t epsilon gamma", positive=True)


@registered_sincos.register(sympy.Expr)
def _(x):
    return sympy.sin(x), sympy.cos(x)


@registered_sincos.register(mpf)
def _(x):
    return reference.mp.sin(x), reference.mp.cos(x)


def vanishes(expression):
    """Whether a polynomial in sines and cosines is 0: as a polynomial modulo s^2 + c^2 = 1."""
    expanded = sympy.expand(sympy.expand_trig(expression))
    names = {}
    for angle in (phi, t, eta * t):
        s, c = sympy.symbols(f"s{len(names)} c{len(names)}")
        names[sympy.sin(angle)], names[sympy.cos(angle)] = s, c
    polynomial = sympy.together(expanded.subs(names))
    numerator = sympy.numer(polynomial)
    relations = [names[sympy.sin(a)] ** 2 + names[sympy.cos(a)] ** 2 - 1 for a in (phi, t, eta * t)]
    assert not numerator.has(sympy.sin) and not numerator.has(sympy.cos)
    variables = [*names.values(), eta, nu, epsilon, gamma]
    return sympy.reduced(sympy.expand(numerator), relations, *variables)[1] == 0


def test_gap_is_equation_10():
    for side in (1, -1):
        ours = gap(launch(side, eta, nu, phi), clock(eta, t))
        printed = reference.left_side_10(eta, nu, phi, t, sympy.sin, sympy.cos)
        assert vanishes(ours - side * printed)
        assert not vanishes(ours + side * printed)


def test_gap_with_restitution_is_equation_14():
    start = launch_with_restitution(1, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    printed = reference.left_side_14(eta, nu, epsilon, phi, gamma, t, sympy.sin, sympy.cos)
    assert vanishes(gap(start, clock(eta, t)) - printed)


def test_relative_velocity_is_equation_15():
    """x' - z' = -eta gamma_{k+1} - nu cos(psi_{k+1}) in scaled units."""
    start = launch_with_restitution(1, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    next_gamma = reference.right_side_15(eta, nu, epsilon, phi, gamma, t, sympy.sin, sympy.cos)
    table = nu * (sympy.cos(phi) * sympy.cos(t) - sympy.sin(phi) * sympy.sin(t))
    assert vanishes(gap(start, clock(eta, t), 1) + eta * next_gamma + table)


def test_orders_are_time_derivatives():
    start = launch_with_restitution(-1, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    for order in range(6):
        derivative = sympy.diff(gap(start, clock(eta, t), order), t)
        assert vanishes(derivative - gap(start, clock(eta, t), order + 1)), order


def test_restitution_is_the_paper_s_definition():
    """-epsilon = (relative velocity after) / (before), with before = -eta gamma - nu cos(phi)."""
    start = launch_with_restitution(1, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    after = gap(start, clock(eta, sympy.Integer(0)), 1)
    assert vanishes(after + epsilon * (-eta * gamma - nu * sympy.cos(phi)))


def test_launch_acceleration_vanishes_at_the_paper_s_separation_phase():
    acceleration = launch_acceleration(launch(1, eta, nu, phi))
    sine = eta**2 / (nu * (1 - eta**2))
    assert sympy.simplify(acceleration.subs(sympy.sin(phi), sine)) == 0
    assert vanishes(
        acceleration - sympy.diff(gap(launch(1, eta, nu, phi), clock(eta, t)), t, 2).subs(t, 0)
    )


def test_slope_formula_is_implicit_differentiation():
    """1 - g_phi / g_t, where g is (10): an identity of polynomials, derivatives by sympy."""
    g = reference.left_side_10(eta, nu, phi, t, sympy.sin, sympy.cos)
    g_phi, g_t = sympy.diff(g, phi), sympy.diff(g, t)
    for side in (1, -1):
        ours = slope(launch(side, eta, nu, phi), clock(eta, t))
        assert vanishes(ours * g_t - (g_t - g_phi)) or vanishes(
            sympy.together(ours - (g_t - g_phi) / g_t)
        )


@pytest.mark.parametrize(("nu", "phase"), [("-0.2", "1.15"), ("-0.2", "1.8"), ("0.3", "2.4")])
def test_slopes_of_the_inverse_are_those_of_the_equation_solved_for_the_phase(nu, phase):
    """X(y) from (10) by Newton's method at fixed y, differenced at 50 digits."""
    eta, nu, x = mpf("0.2121"), mpf(nu), mpf(phase)
    mp = reference.mp

    def gap_at(x, y):
        return mp.sign(nu) * reference.left_side_10(eta, nu, x, y - x)

    times = (mpf(k) / 20 for k in range(10, 2000))
    begin = next(t for t in times if gap_at(x, x + t) > 0 > gap_at(x, x + t + mpf("0.05")))
    time = mp.findroot(lambda t: gap_at(x, x + t), (begin, begin + mpf("0.05")), solver="anderson")

    def inverse(y):
        return mp.findroot(lambda z: gap_at(z, y), x)

    start, now = launch(int(mp.sign(nu)), eta, nu, x), clock(eta, time)
    first = inverse_slope(start, now)
    assert abs(first - mp.diff(inverse, x + time)) < 1e-15 * abs(first)
    assert abs(1 / first - slope(start, now)) < 1e-40
    second = inverse_bend(start, now, first)
    assert abs(second - mp.diff(inverse, x + time, 2)) < 1e-12 * abs(second)


def test_jets_of_the_gap_agree_with_its_time_derivatives():
    start = launch(-1, mpf("0.2121"), mpf("-0.2"), mpf("1.3"))
    t0 = mpf("7.25")

    class Number(mpf):  # a number that brings its own sine and cosine, as jets ask of them
        def sincos(self):
            return reference.mp.sin(mpf(self)), reference.mp.cos(mpf(self))

    along = Jet(Number(t0), mpf(1), mpf(0), mpf(0))
    scaled = Jet(Number(mpf("0.2121") * t0), mpf("0.2121"), mpf(0), mpf(0))
    from proofs.trusted.equations import Clock

    now = Clock(*scaled.sincos(), *along.sincos())
    jet = gap(start, now)
    for order in range(4):
        expected = gap(start, clock(mpf("0.2121"), t0), order)
        assert abs(jet.derivative(order) - expected) < mpf(10) ** -45
