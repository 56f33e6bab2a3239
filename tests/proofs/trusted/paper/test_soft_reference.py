"""Section 5 against the paper read a second time, and against maps iterated at 50 digits."""

import random
from fractions import Fraction

import mpmath as mp
import pytest

from proofs.search.derivations import enclose
from proofs.trusted.paper.s5_soft import displayed as eq


def printed_equations(p, beta, omega, wn, eps, g, m, psi, v, psi1):
    """Transcribe (24)-(29) from the paper once more, by hand, for numbers."""
    s, c = mp.sin, mp.cos
    phase = wn / omega * (psi1 - psi + 2 * mp.pi * m)
    out = -eps * v + (1 + eps) * beta * omega * c(psi)
    th = 2 * mp.pi * m * wn / omega
    low = 1 + eps * c(th)
    return {
        eq.S24: (-p + beta * s(psi)) * c(phase)
        + out / wn * s(phase)
        - 2 * g / wn**2 * s(phase / 2) ** 2
        + p
        - beta * s(psi1),
        eq.S25: out * c(phase) - wn * (-p + beta * s(psi)) * s(phase) - g / wn * s(phase),
        eq.S26: (-p + beta * s(psi)) * c(th)
        + out / wn * s(th)
        - 2 * g / wn**2 * s(th) ** 2
        + p
        - beta * s(psi),
        eq.S27: out * c(th) - wn * (-p + beta * s(psi)) * s(th) - g / wn * s(th),
        eq.S28: 2 * (p - beta * s(psi)) * s(th / 2) ** 2
        + eps * (-p + beta * s(psi)) * s(th) ** 2 / (wn * low)
        + eps * g * s(th) ** 2 / (wn**2 * low)
        - 2 * g / wn**2 * s(th / 2) ** 2
        + (1 + eps) * beta * omega * c(psi) * s(th) / (wn * low),
        eq.S29: -wn * (-p + beta * s(psi)) * s(th) / low
        - g * s(th) / (wn * low)
        + (1 + eps) * beta * omega * c(psi) * c(th) / low,
    }


def test_transcriptions_against_a_second_reading():
    names = ["p", "beta", "omega", "omega_n", "epsilon", "g", "m", "psi", "v", "psi1"]
    chance = random.Random(3)
    with mp.workdps(40):
        for _ in range(3):
            point = [Fraction(chance.randint(1, 40), 17) for _ in names]
            numbers = [mp.mpf(x.numerator) / x.denominator for x in point]
            for text, expected in printed_equations(*numbers).items():
                low, high = enclose(text, 25, **dict(zip(names, point, strict=True)))
                assert mp.mpf(low.numerator) / low.denominator <= expected + mp.mpf(10) ** -35
                assert mp.mpf(high.numerator) / high.denominator >= expected - mp.mpf(10) ** -35


def step(rho, eps, psi, lam, guess):
    """Solve the limit map for the next impact near a guess of the flight."""
    speed = -eps * lam + (1 + eps) * rho * mp.cos(psi)

    def gap(t):
        return rho * mp.sin(psi) + speed * t - t * t - rho * mp.sin(psi + t)

    t = mp.findroot(gap, guess)
    return psi + t, speed - 2 * t


def fixed(rho, eps, m):
    return mp.acos((1 - eps) * 2 * mp.pi * m / ((1 + eps) * rho))


def jacobian(rho, eps, m):
    h = mp.mpf(10) ** -20
    c, psi = 2 * mp.pi * m, fixed(rho, eps, m)
    columns = []
    for d in ((h, 0), (0, h)):
        ends = [step(rho, eps, psi + s * d[0], -c + s * d[1], c) for s in (1, -1)]
        columns.append([(a - b) / (2 * h) for a, b in zip(*ends, strict=True)])
    return columns


@pytest.mark.parametrize(("m", "eps", "rho"), [(1, "0.3", 6), (2, "0", 13), (3, "0.8", 5)])
def test_jacobian_against_differences(m, eps, rho):
    with mp.workdps(50):
        eps, rho = mp.mpf(eps), mp.mpf(rho)
        (a, b), (c, d) = jacobian(rho, eps, m)
        alpha = mp.sqrt((1 + eps) ** 2 * rho**2 - (1 - eps) ** 2 * (2 * mp.pi * m) ** 2)
        expected = (1 - (1 + eps) / 2 * alpha, eps * alpha, -eps * (1 + eps) / 2, eps**2)
        assert max(abs(x - y) for x, y in zip((a, b, c, d), expected, strict=True)) < 1e-25


@pytest.mark.parametrize(("m", "eps"), [(1, "1/2"), (2, "1/5"), (1, "9/10"), (3, "0")])
def test_the_flip_is_where_an_eigenvalue_is_minus_one(m, eps):
    low, high = enclose(eq.flip(eq.ALPHA_FLIP), 40, m=Fraction(m), epsilon=Fraction(eps))
    with mp.workdps(50):
        rho = mp.mpf(low.numerator) / low.denominator + mp.mpf(high.numerator) / high.denominator
        (a, b), (c, d) = jacobian(
            rho / 2, mp.mpf(Fraction(eps).numerator) / Fraction(eps).denominator, m
        )
        assert abs(1 + a + d + a * d - b * c) < 1e-25


def orbit(rho, eps, m, kick, count):
    """Iterate the limit map from near the centre manifold; return the phases less 2 pi m n."""
    c = 2 * mp.pi * m
    psi, lam, phases = fixed(rho, eps, m) + kick, -c - 4 * eps / (1 + eps) * kick, []
    for n in range(count):
        phases.append(psi - n * c)
        psi, lam = step(rho, eps, psi, lam, c)
    return phases


@pytest.mark.parametrize(("m", "eps"), [(1, "0"), (1, "0.3"), (2, "0.1")])
def test_supercritical_with_the_amplitude_of_the_cubic(m, eps):
    """Just above rho_F orbits settle to period 2 at h^2 = -(1 + multiplier)/K, about."""
    with mp.workdps(45):
        eps = mp.mpf(eps)
        c, a = 2 * mp.pi * m, 4 * (1 + eps**2) / (1 + eps)
        alpha = a * (1 + mp.mpf("0.002"))
        rho = mp.sqrt(alpha**2 + ((1 - eps) * c) ** 2) / (1 + eps)
        (p, q), (r, s) = jacobian(rho, eps, m) if eps else ((1 - alpha / 2, 0), (0, 0))
        trace, det = p + s, p * s - q * r
        least = (trace - mp.sqrt(trace**2 - 4 * det)) / 2
        k = (3 * c**2 * (1 - eps**2) ** 2 + 8 * (1 - eps) ** 4 + 64 * eps**2) / 48 / (1 - eps**4)
        start = mp.sqrt(-(1 + least) / k)
        phases = orbit(rho, eps, m, start, 120)
        first, second, third = phases[-3:]
        assert abs(first - third) < 1e-3 * abs(first - second)
        assert abs(abs(first - second) / 2 / start - 1) < 0.05


@pytest.mark.parametrize("m", [1, 2])
def test_derivatives_of_the_second_iterate(m):
    with mp.workdps(60):
        rho = mp.sqrt(16 + (2 * mp.pi * m) ** 2)
        psi, h = fixed(rho, 0, m), mp.mpf(10) ** -9

        def twice(x, r):
            for _ in range(2):
                x = step(r, 0, x, 0, 2 * mp.pi * m)[0] - 2 * mp.pi * m
            return x

        third = (
            twice(psi + 2 * h, rho)
            - 2 * twice(psi + h, rho)
            + 2 * twice(psi - h, rho)
            - twice(psi - 2 * h, rho)
        ) / (2 * h**3)
        mixed = (
            twice(psi + h, rho + h)
            - twice(psi - h, rho + h)
            - twice(psi + h, rho - h)
            + twice(psi - h, rho - h)
        ) / (4 * h**2)
        assert abs(third + 3 * mp.pi**2 * m**2 + 2) < 1e-10
        assert abs(mixed - rho / 4) < 1e-10


def test_the_printed_rho_o_is_superstable():
    with mp.workdps(40):
        rho, h = mp.sqrt(4 + 4 * mp.pi**2), mp.mpf(10) ** -15
        psi = fixed(rho, 0, 1)
        ends = [step(rho, 0, psi + s * h, 0, 2 * mp.pi)[0] for s in (1, -1)]
        assert abs((ends[0] - ends[1]) / (2 * h)) < 1e-12


@pytest.mark.parametrize(("m", "k", "eps", "q"), [(1, "0.1", "0.4", 3), (2, "0.05", "0.7", -2)])
def test_springs_of_any_stiffness(m, k, eps, q):
    """The trace and determinant of the theorem, against differences of the flight with a spring."""
    with mp.workdps(50):
        k, eps, psi, s = mp.mpf(k), mp.mpf(eps), mp.mpf("0.7"), mp.pi * m * mp.mpf(k)
        ratio = (1 - eps) / (1 + eps) * mp.tan(s) / k
        rho = ratio * (2 - k**2 * q) / (mp.cos(psi) - ratio * k**2 * mp.sin(psi))
        big = 2 + k**2 * (rho * mp.sin(psi) - q)
        lam = -mp.tan(s) * big / k

        def move(x, speed):
            out = -eps * speed + (1 + eps) * rho * mp.cos(x)
            start = rho * mp.sin(x) - q + 2 / k**2

            def gap(t):
                height = start * mp.cos(k * t) + out / k * mp.sin(k * t) - 2 / k**2
                return height - rho * mp.sin(x + t) + q

            t = mp.findroot(gap, 2 * mp.pi * m)
            return x + t - 2 * mp.pi * m, out * mp.cos(k * t) - k * start * mp.sin(k * t)

        assert max(abs(a - b) for a, b in zip(move(psi, lam), (psi, lam), strict=True)) < 1e-40
        h = mp.mpf(10) ** -20
        columns = []
        for d in ((h, 0), (0, h)):
            ends = [move(psi + n * d[0], lam + n * d[1]) for n in (1, -1)]
            columns.append([(x - y) / (2 * h) for x, y in zip(*ends, strict=True)])
        (a, b), (c, d) = columns
        both = (1 + eps) ** 2 * (1 + mp.cos(2 * s)) * rho * mp.sin(psi) / big
        trace = ((1 + eps) ** 2 + (1 - eps) ** 2 * mp.cos(2 * s) - both) / 2
        assert abs(a + d - trace) < 1e-25 and abs(a * d - b * c - eps**2) < 1e-25


@pytest.mark.parametrize("eps", ["0", "0.3", "0.9"])
@pytest.mark.parametrize("m", [1, 2, 5])
def test_the_flip_is_an_orbit(m, eps):
    """The gap stays positive until the impact, at rho_F and where S = 2 r exactly."""
    with mp.workdps(20):
        eps, c = mp.mpf(eps), 2 * mp.pi * m
        r = (1 - eps) / (1 + eps)
        for height in (2 * (1 + r**2), 2 * r):
            for n in range(1, 400):
                t = c * n / 400
                assert t * (c - t) + height * (1 - mp.cos(t)) - r * c * mp.sin(t) > 0
