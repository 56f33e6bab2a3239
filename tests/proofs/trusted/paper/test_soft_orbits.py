"""Which solutions of section 5 are orbits: the theorems against flights followed in small steps."""

import math
import random
from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest

from proofs.search.evidence import Evidence
from proofs.shell import groups
from proofs.trusted.paper.s5_soft import orbits, theorems
from tests.oracles.sources import committed, committed_conclusions

CRITICAL = {1: 0.0204576324, 2: 0.0048328820, 3: 0.0021270921}  # epsilon_m, found below


def times(c, count=20_000):
    """Times of a flight, close to each other after the launch."""
    return np.concatenate([c * np.geomspace(1e-4, 1e-3, 500), np.linspace(1e-3, 1, count)[:-1] * c])


def gap(m, eps, rho, psi, t):
    """The height above the table after an impact at psi with the velocity -2 pi m: flight (20)."""
    speed = eps * 2 * np.pi * m + (1 + eps) * rho * np.cos(psi)
    return rho * np.sin(psi) + speed * t - t * t - rho * np.sin(psi + t)


def fixed(m, eps, rho):
    """The phases of the two fixed points."""
    psi = math.acos((1 - eps) / (1 + eps) * 2 * math.pi * m / rho)
    return psi, -psi


def is_orbit(m, eps, rho, psi):
    """Whether nothing but the end of the flight meets the table, but for rounding."""
    t = times(2 * math.pi * m)
    return bool((gap(m, eps, rho, psi, t) / t**2 > -1e-6).all())


def printed_bound(m, eps):
    """h as it is printed: the greatest value of F on (0, pi/2]."""
    d, r, u = math.pi * m, (1 - eps) / (1 + eps), np.linspace(1e-4, math.pi / 2, 200_001)
    return float(np.max(2 * d * r / np.tan(u) - 2 * u * (d - u) / np.sin(u) ** 2))


def printed_curve(m, eps):
    """h as H(u) where R(u) = r."""
    d, r = mp.pi * m, (1 - mp.mpf(eps)) / (1 + mp.mpf(eps))

    def turned(u):
        return (2 * u + 2 * u * (d - u) * mp.cot(u)) / d - 1 - r

    u = mp.findroot(turned, (mp.mpf("1e-9"), mp.pi / 2), solver="anderson")
    return 2 * u * (d - u) * (mp.cot(u) ** 2 - 1) - 2 * (d - 2 * u) * mp.cot(u)


@pytest.mark.parametrize("m", [1, 2, 3])
def test_orbits_are_the_fixed_points_above_h(m):
    chance, met = random.Random(m), set()
    for _ in range(25):
        eps = chance.choice([chance.uniform(0, 1), 10 ** chance.uniform(-4, -1)])
        bound, saddle = printed_bound(m, eps), (1 - eps) / (1 + eps) * 2 * math.pi * m
        assert abs(bound - printed_curve(m, eps)) < 1e-5
        for height in (bound + 0.01, bound - 0.01, chance.uniform(-12, 5)):
            rho, side = math.hypot(saddle, height), 0 if height > 0 else 1
            found = is_orbit(m, eps, rho, fixed(m, eps, rho)[side])
            assert found == (height > bound), (eps, height, bound)
            met.add((found, side))
    assert len(met) == 4


@pytest.mark.parametrize("m", [1, 2, 3])
def test_the_regions_of_the_diagram(m):
    """The six cases, at points on both sides of each bound, and the critical epsilon."""
    bound = mp.findroot(lambda e: printed_curve(m, e), CRITICAL[m])
    assert abs(bound - CRITICAL[m]) < 1e-9
    for eps in (CRITICAL[m] / 2, CRITICAL[m] * 1.5, 0.3):
        saddle, h = (1 - eps) / (1 + eps) * 2 * math.pi * m, printed_bound(m, eps)
        grazing = math.hypot(saddle, h)
        assert (h < 0) == (eps > CRITICAL[m]) and h < 2
        for rho in (saddle + 1e-6, (saddle + grazing) / 2, grazing + 1e-2, grazing * 1.4):
            first, second = (is_orbit(m, eps, rho, psi) for psi in fixed(m, eps, rho))
            assert first == (eps > CRITICAL[m] or rho > grazing)
            assert second == (eps > CRITICAL[m] and rho < grazing)
    plastic = math.sqrt(4 + (2 * math.pi * m) ** 2)
    for rho in (2 * math.pi * m + 1e-6, plastic - 1e-2, plastic + 1e-2, 2 * plastic):
        assert [is_orbit(m, 0, rho, psi) for psi in fixed(m, 0, rho)] == [rho > plastic, False]


def test_what_is_printed_of_epsilon_1():
    assert "0.02045763 < epsilon_1 < 0.02045765" in orbits.admissible.text()
    assert "epsilon_1 = 0.0204576..." in theorems.diagram.text()
    assert 0.02045763 < CRITICAL[1] < 0.02045765


def test_flights_through_the_table():
    """Where the equations alone have a fixed point: the mass would be below the table."""
    saddle = 0.99 / 1.01 * 2 * math.pi
    assert abs(gap(1, 0.01, saddle, 0, 0.3) + 0.025) < 1e-3
    assert abs(gap(1, 0.5, 6, fixed(1, 0.5, 6)[1], 2.5) + 1.92) < 0.01


@pytest.mark.parametrize("m", [1, 2, 3])
@pytest.mark.parametrize("eps", [0, 0.01, 0.3, 0.9])
def test_the_flip_is_one_of_an_orbit(m, eps):
    r = (1 - eps) / (1 + eps)
    rho = math.hypot(2 * (1 + r * r), r * 2 * math.pi * m)
    alpha = (1 + eps) * rho * math.sin(fixed(m, eps, rho)[0])
    assert abs(alpha - 4 * (1 + eps**2) / (1 + eps)) < 1e-12
    assert is_orbit(m, eps, rho, fixed(m, eps, rho)[0])


# -- masses that stick -----------------------------------------------------------------------------


def landing(rho):
    """The phase, not reduced, at which a mass that left the table at rest comes back."""
    start = mp.asin(2 / mp.mpf(rho))

    def height(t):
        speed = rho * mp.cos(start)
        return rho * mp.sin(start) + speed * t - t * t - rho * mp.sin(start + t)

    steps = np.linspace(0.02, rho + 5, 20 * int(rho + 5))
    for low, high in pairwise(map(mp.mpf, steps)):
        if height(high) < 0:
            return start, start + mp.findroot(height, (low, high), solver="anderson", tol=1e-25)
    raise AssertionError("no impact")


def turns(j):
    """The solution u_j of tan u = u."""
    return mp.findroot(lambda u: mp.sin(u) - u * mp.cos(u), mp.pi * (j + 0.45)) if j else mp.mpf(0)


@pytest.mark.parametrize("m", [1, 2, 3, 4])
def test_orbits_that_stick_after_their_impact(m):
    with mp.workdps(30):
        low = 2 * mp.sqrt(1 + turns(m - 1) ** 2)
        high = mp.sqrt(4 + (2 * mp.pi * m) ** 2)
        inside = [low + (high - low) * share for share in (0.001, 0.3, 0.9, 0.999)]
        for rho in inside:
            start, end = landing(rho)
            assert rho * mp.sin(end) < 2
            assert 2 * mp.pi * (m - 1) < end - start < 2 * mp.pi * m  # the next launch: m periods
        for rho in [high + 0.01, *([low - 0.01] if m > 1 else [])]:
            assert rho * mp.sin(landing(rho)[1]) > 2  # it leaves again at once


# -- period doublings ------------------------------------------------------------------------------


def cycle(m, eps, k, q, h):
    """rho^2 of the motion with flights of 2 pi m + 2 h and 2 pi m - 2 h: by its equations."""
    c = 2 * mp.pi * m

    def flights(across, up, one, other):
        rho, x = mp.hypot(across, up), mp.atan2(up, across)
        defects = []
        for sign, lam, after in ((1, one, other), (-1, other, one)):
            psi, t = x - sign * h, c + 2 * sign * h
            out, rest = -eps * lam + (1 + eps) * rho * mp.cos(psi), rho * mp.sin(psi) - q + 2 / k**2
            end = rest * mp.cos(k * t) + out * mp.sin(k * t) / k - 2 / k**2 + q
            defects += [end - rho * mp.sin(psi + t)]
            defects += [out * mp.cos(k * t) - k * rest * mp.sin(k * t) - after]
        return defects

    a, b, lam = flip(m, eps, k, q)[:3]
    across, up, _, _ = mp.findroot(flights, (b, a, lam, lam))
    return across**2 + up**2


def flip(m, eps, k, q):
    """rho sin psi, rho cos psi, lambda at the flip, and kappa: as printed."""
    r, t = (1 - eps) / (1 + eps), mp.tan(mp.pi * m * k)
    whole = 1 + t**2 + r**2
    big = (2 - k**2 * q) / (1 - k**2 * whole)
    n = 3 * r**2 * t**2
    n += k**2 * ((1 + t**2) ** 2 + r**2 * (1 + t**2) * (t**2 - 2) + 3 * r**4 * (1 - t**2))
    n += k**4 * ((1 + t**2) ** 2 * (3 * t**2 - 1 + 5 * r**2) + 3 * r**4 * (1 + t**2) - 3 * r**6)
    kappa = big**2 * n / (3 * k**2 * (1 - k**2 * whole))
    return whole * big, r * t * big / k, -t * big / k, kappa


@pytest.mark.parametrize(
    ("m", "eps", "k", "q"),
    [(1, "0", "0.1", 0), (1, "0.3", "0.2", 5), (2, "0.8", "0.03", -4), (1, "0.99", "0.001", 0)],
)
def test_orbits_of_period_2_are_above_the_flip(m, eps, k, q):
    with mp.workdps(50):
        eps, k = mp.mpf(eps), mp.mpf(k)
        a, b, _, kappa = flip(m, eps, k, q)
        assert kappa > 0
        ends = [
            (cycle(m, eps, k, q, h) - a**2 - b**2) / h**2 for h in (mp.mpf("1e-6"), mp.mpf("2e-6"))
        ]
        assert abs((4 * ends[0] - ends[1]) / 3 - kappa) < 1e-15 * kappa
        if k < 0.01:  # the limit
            r = (1 - eps) / (1 + eps)
            limit = 4 * (3 * r**2 * (mp.pi * m) ** 2 + 1 - 2 * r**2 + 3 * r**4) / 3
            assert abs(limit - kappa) < 1e-3


@pytest.mark.slow
def test_kappa_is_positive_wherever_there_is_a_flip():
    chance, least = random.Random(7), math.inf
    for _ in range(4000):
        m, eps, k = chance.randint(1, 4), chance.random(), 10 ** chance.uniform(-3, 0)
        r = (1 - eps) / (1 + eps)
        if k < 1 / (2 * m) and k * k * (1 + math.tan(math.pi * m * k) ** 2 + r * r) < 1:
            least = min(least, flip(m, eps, k, 0)[3])
    assert 0 < least < 4


# -- hypotheses ------------------------------------------------------------------------------------


def said(claim):
    """What is printed about a claim, by what the committed certificate proves."""
    proof, (of, known) = committed("soft")["proofs"][claim], committed_conclusions("soft")
    return groups.decide(claim, of, Evidence({}, {claim: [(x, known[x]) for x in proof]}), 20)[0]


@pytest.mark.slow
@pytest.mark.parametrize("claim", ["S8", "S10"])
def test_a_table_that_moves_and_gravity_are_assumed(claim):
    """With beta < 0, m = 1, epsilon = 0: X < 1, and no phase has cos psi = X."""
    assert "beta, omega, g > 0, m >= 1, 0 <= epsilon < 1" in said(claim).corrected
    assert 2 * math.pi / -1 < -1


@pytest.mark.slow
def test_o_of_mu_is_conditional_on_fixed_points():
    line = said("S10")
    assert line.verdict.value == "CONDITIONAL" and "lim f(mu) = K" in line.statement
    assert line.why.startswith("True if X < 1")


@pytest.mark.slow
def test_five_conditions_fail():
    """At the printed rho_o, m = 1, by differences of the map: one of six holds."""
    why = said("S22").why
    assert "five of the six fail, all but d^2(f^2)/dpsi^2 = 0" in why
    with mp.workdps(50):
        rho, c, h = mp.sqrt(4 + 4 * mp.pi**2), 2 * mp.pi, mp.mpf(10) ** -8
        psi = mp.acos(c / rho)

        def f(x, r):
            def height(t):
                return r * mp.sin(x) + r * mp.cos(x) * t - t * t - r * mp.sin(x + t)

            return x + mp.findroot(height, c) - c

        def twice(x, r=rho):
            return f(f(x, r), r)

        near = {n: twice(psi + n * h) for n in (-2, -1, 0, 1, 2)}
        third = (near[2] - 2 * near[1] + 2 * near[-1] - near[-2]) / (2 * h**3)
        mixed = twice(psi + h, rho + h) - twice(psi - h, rho + h)
        mixed = (mixed - twice(psi + h, rho - h) + twice(psi - h, rho - h)) / (4 * h * h)
        zeros = {
            "f = 0": f(psi, rho),
            "df/dpsi = -1": (f(psi + h, rho) - f(psi - h, rho)) / (2 * h) + 1,
            "d(f^2)/drho = 0": (twice(psi, rho + h) - twice(psi, rho - h)) / (2 * h),
            "d^2(f^2)/dpsi^2 = 0": (near[1] - 2 * near[0] + near[-1]) / h**2,
        }
        others = {"d^2(f^2)/dpsi drho": mixed, "d^3(f^2)/dpsi^3": third}
        holds = [name for name, value in zeros.items() if abs(value) < 1e-5]
        holds += [name for name, value in others.items() if abs(value) > 1e-5]
    assert holds == ["d^2(f^2)/dpsi^2 = 0"]


@pytest.mark.slow
def test_kinds_of_period_doublings():
    """Any stiffness and restitution, for masses that come down, where the springs let them."""
    why = said("S23").why
    assert "m >= 1, 0 <= epsilon < 1 and springs of any stiffness 0 < k" in why
    assert "k^2 q < 2" in why and "with lambda < 0, an orbit or not" in why


@pytest.mark.slow
def test_diagrams_say_which_points_are_orbits():
    words = {
        "S15": (
            "m >= 1, 0 <= epsilon < 1, rho > 0",
            "If epsilon > epsilon_m, the first is an orbit for all rho >= rho_SN",
            "if epsilon < epsilon_m, the first exactly for rho > rho_G, the second for no rho",
            "If epsilon = 0, the first exactly for rho >= sqrt(4 + c^2), the second for no rho",
        ),
        "S16": ("0 < epsilon < 1", "an orbit, too, exactly if epsilon > epsilon_m and rho < rho_G"),
        "S17": ("0 < epsilon < 1", "rho > rho_F; it is an orbit then"),
        "S18": (
            "the saddle-node is one of orbits exactly if epsilon > epsilon_m",
            "2 sqrt(1 + u_(m-1)^2) <= rho < sqrt(4 + (2 pi m)^2)",
        ),
    }
    for claim, parts in words.items():
        assert all(part in said(claim).corrected for part in parts), claim
