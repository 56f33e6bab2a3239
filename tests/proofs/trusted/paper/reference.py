"""The paper's equations typed by hand, and its impact map: independent of the code."""

import math
from fractions import Fraction

from mpmath import mp, mpf

from tests.oracles.motion import Impact, flight

mp.dps = 50


def left_side_10(eta, nu, psi_k, delta, sin=mp.sin, cos=mp.cos):
    """Equation (10) as printed, with psi_{k+1} = psi_k + delta."""
    return (
        (1 + nu * sin(psi_k)) * cos(eta * delta)
        + nu / eta * cos(psi_k) * sin(eta * delta)
        - 1
        - nu * sin(psi_k + delta)
    )


def left_side_14(eta, nu, epsilon, psi_k, gamma_k, delta, sin=mp.sin, cos=mp.cos):
    """Equation (14) as printed."""
    return (
        (1 + nu * sin(psi_k)) * cos(eta * delta)
        + (epsilon * gamma_k + nu / eta * (1 + epsilon) * cos(psi_k)) * sin(eta * delta)
        - 1
        - nu * sin(psi_k + delta)
    )


def right_side_15(eta, nu, epsilon, psi_k, gamma_k, delta, sin=mp.sin, cos=mp.cos):
    """Equation (15) as printed."""
    return (1 + nu * sin(psi_k)) * sin(eta * delta) - (
        epsilon * gamma_k + nu / eta * (1 + epsilon) * cos(psi_k)
    ) * cos(eta * delta)


def launch_acceleration(eta, nu, phi):
    """Relative acceleration x'' - z'' right after a plastic impact, from Newton's law.

    x'' = -omega_n^2 x, z'' = -beta omega^2 sin: in units of omega^2 |p|, with x = z there.
    """
    return math.copysign(1, nu) * (-(eta**2) * (1 + nu * mp.sin(phi)) + nu * mp.sin(phi))


def separation_phase(eta, nu):
    """The paper's phi_s, on the side on which the launch acceleration goes from - to +."""
    sine = mpf(eta) ** 2 / (mpf(nu) * (1 - mpf(eta) ** 2))
    roots = [mp.asin(sine), mp.pi - mp.asin(sine)]
    h = mpf(10) ** -20
    rising = [
        r
        for r in roots
        if launch_acceleration(eta, nu, r - h) < 0 < launch_acceleration(eta, nu, r + h)
    ]
    (root,) = rising
    return root % (2 * mp.pi)


def first_impact(eta, nu, phi, horizon=400.0):
    """(flight time, phase mod 2 pi) of the first impact after a plastic launch.

    None if there is none up to the horizon. A launch at the separation phase, to 40 digits, leaves.
    """
    leaves = abs(launch_acceleration(mpf(eta), mpf(nu), mpf(phi))) < mpf(10) ** -40
    found = flight(*map(exact, (eta, nu, phi)), latest=horizon, released=leaves)
    if not isinstance(found, Impact):
        return None
    time = number(found.time)
    return time, (mpf(phi) + time) % (2 * mp.pi)


def rebound(eta, nu, epsilon, phi, gamma):
    """(flight time, velocity) of the next impact after one with restitution."""
    found = flight(*map(exact, (eta, nu, phi, epsilon, gamma)))
    return number(found.time), number(found.velocity)


def exact(x):
    """A number as a rational."""
    size, exponent = mpf(x).man_exp
    return int(mp.sign(x)) * int(size) * Fraction(2) ** exponent


def as_mpf(x):
    """A rational at the precision of mpmath's context."""
    return mpf(x.numerator) / x.denominator


def number(ball):
    """The middle of a ball."""
    return mpf(ball.mid().str(60, radius=False))


def slope(eta, nu, phi, flight, h=mpf(10) ** -15):
    """f' by central differences of the root of (10), at 50 digits."""

    def root(p):
        return mp.findroot(lambda t: left_side_10(mpf(eta), mpf(nu), p, t), flight)

    return 1 + (root(mpf(phi) + h) - root(mpf(phi) - h)) / (2 * h)
