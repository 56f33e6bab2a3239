"""The paper's equations typed by hand, and a brute-force impact map: independent of the code."""

import math

from mpmath import mp, mpf

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


def first_impact(eta, nu, phi, horizon=400.0, step=0.002):
    """(flight time, phase mod 2 pi) by scanning (10) for its first sign change, then bisection.

    None if there is none, or if a local minimum comes so near 0 that a scan cannot tell.
    """
    side = math.copysign(1.0, nu)
    e, n, p = float(eta), float(nu), float(phi)

    def gap(t):
        return side * left_side_10(e, n, p, t, math.sin, math.cos)

    t, before, last = step, gap(step), math.inf
    while before <= 0:  # rounding next to launch
        t += step
        before = gap(t)
        if t > 0.2:
            return None
    while t < horizon:
        value = gap(t + step)
        if value <= 0:
            return _refine(mpf(eta), mpf(nu), mpf(phi), side, t, t + step)
        if before < last and before < value and before < 1e-5 and t > 0.2:
            return None
        t, last, before = t + step, before, value
    return None


def _refine(eta, nu, phi, side, low, high):
    low, high = mpf(low), mpf(high)
    for _ in range(150):
        middle = (low + high) / 2
        if side * left_side_10(eta, nu, phi, middle) > 0:
            low = middle
        else:
            high = middle
    return low, (phi + low) % (2 * mp.pi)


def rebound(eta, nu, epsilon, phi, gamma, step):
    """(flight time, velocity) of the next impact by a scan of (14) in steps, bisection and (15)."""
    side = math.copysign(1.0, nu)
    low = step = mpf(step)
    while side * left_side_14(eta, nu, epsilon, phi, gamma, low + step) > 0:
        low += step
    high = low + step
    for _ in range(90):
        middle = (low + high) / 2
        flying = side * left_side_14(eta, nu, epsilon, phi, gamma, middle) > 0
        low, high = (middle, high) if flying else (low, middle)
    return low, right_side_15(eta, nu, epsilon, phi, gamma, low)


def slope(eta, nu, phi, flight, h=mpf(10) ** -15):
    """f' by central differences of the root of (10), at 50 digits."""

    def root(p):
        return mp.findroot(lambda t: left_side_10(mpf(eta), mpf(nu), p, t), flight)

    return 1 + (root(mpf(phi) + h) - root(mpf(phi) - h)) / (2 * h)
