"""Soft springs: enclosures of periodic motions against flights typed once more, in mpmath."""

from fractions import Fraction
from types import SimpleNamespace

import mpmath as mp
import pytest

from intervals import Interval, Undecided
from proofs.motion.soft import Motion, Springs, State
from proofs.motion.soft_orbits import (
    attracts,
    critical_epsilon,
    double_at,
    eigenvalues,
    followed,
    judge,
    judge_fixed,
    least_height,
)

CASES = [
    (1, "0", "0", "0"),
    (1, "3/10", "0", "0"),
    (2, "9/10", "0", "0"),
    (1, "1/5", "1/10", "0"),
    (1, "0", "1/5", "-3"),
    (2, "1/2", "1/20", "7"),
]


@pytest.fixture(params=CASES, ids=lambda case: ",".join(map(str, case)))
def springs(request):
    m, *others = request.param
    return Springs(m, *map(Fraction, others), 160)


def real(x):
    return mp.mpf(x.numerator) / x.denominator


def inside(interval, value, room=0):
    return real(interval.inf) - room <= value <= real(interval.sup) + room


def flight(springs, rho, psi, lam):
    """The gap and the velocity at time t after an impact, by the flight (20), (21)."""
    e, k, q = (real(x) for x in (springs.epsilon, springs.k, springs.q))
    out = -e * lam + (1 + e) * rho * mp.cos(psi)

    def gap(t):
        height = rho * mp.sin(psi) + out * t - t * t
        if k:
            rest = rho * mp.sin(psi) - q + 2 / k**2
            height = rest * mp.cos(k * t) + out * mp.sin(k * t) / k - 2 / k**2 + q
        return height - rho * mp.sin(psi + t)

    def speed(t):
        if not k:
            return out - 2 * t
        rest = rho * mp.sin(psi) - q + 2 / k**2
        return out * mp.cos(k * t) - rest * k * mp.sin(k * t)

    return gap, speed


def step(springs, rho, psi, lam, guess):
    gap, speed = flight(springs, rho, psi, lam)
    t = mp.findroot(gap, guess)
    return psi + t - 2 * mp.pi * springs.m, speed(t)


def middles(motion):
    return [tuple(real(x.mid) for x in impact) for impact in motion.impacts]


def jacobian(springs, motion):
    """By differences: of the map, or of its second iterate."""
    h, rho, times = mp.mpf(10) ** -12, real(motion.rho.mid), [real(t.mid) for t in motion.times]

    def turn(psi, lam):
        for t in times:
            psi, lam = step(springs, rho, psi, lam, t)
        return psi, lam

    psi, lam = middles(motion)[0]
    columns = []
    for d in ((h, 0), (0, h)):
        ends = [turn(psi + s * d[0], lam + s * d[1]) for s in (1, -1)]
        columns.append([(a - b) / (2 * h) for a, b in zip(*ends, strict=True)])
    return mp.matrix(columns).T


def check(springs, motion):
    """Each impact leads to the next; the derivative is enclosed."""
    with mp.workdps(45):
        states, rho = middles(motion), real(motion.rho.mid)
        for i, state in enumerate(states):
            found = step(springs, rho, *state, real(motion.times[i].mid))
            for a, b in zip(found, states[(i + 1) % len(states)], strict=True):
                assert abs(a - b) < 1e-25
        for row, numbers in zip(
            springs.derivative(motion), jacobian(springs, motion).tolist(), strict=True
        ):
            assert all(inside(x, y, 1e-15) for x, y in zip(row, numbers, strict=True))


def stays_above(springs, motion):
    """Whether the gap is positive at many times of each flight, and at once."""
    with mp.workdps(25):
        rho = real(motion.rho.mid)
        for state, time in zip(middles(motion), motion.times, strict=True):
            gap, _ = flight(springs, rho, *state)
            end = real(time.mid)
            if any(gap(end * n / 700) <= 0 for n in range(1, 700)) or gap(mp.mpf("1e-4")) <= 0:
                return False
    return True


def test_fixed_points_and_their_bifurcations(springs):
    square = real(springs.epsilon) ** 2
    saddle, flip = springs.saddle_node, springs.flip
    rho = flip.rho.mid * 21 // 20 * Fraction(1) + Fraction(1, 3)
    for motion in (saddle, flip, *springs.at(rho)):
        check(springs, motion)
    for motion, trace in ((saddle, 1 + square), (flip, -1 - square)):
        (a, _), (_, d) = springs.derivative(motion)
        assert inside(a + d, trace)
    for motion in springs.at(rho):
        assert inside(motion.rho, real(rho))
        assert judge(springs, motion).orbit is stays_above(springs, motion)
    assert springs.at(saddle.rho.mid * 99 / 100) == ()


@pytest.mark.slow
def test_orbits_of_period_2(springs):
    for shift in ("1/16", "1/2", "-1/2"):
        motion = springs.double(springs.exact(Fraction(shift)))
        check(springs, motion)
        assert judge(springs, motion).orbit is stays_above(springs, motion)


def test_the_orbit_of_period_2_at_rho(springs):
    rho = Fraction(round(springs.flip.rho.mid * 1020), 1000)
    motion = double_at(springs, rho)
    assert inside(motion.rho, real(rho)) and motion.rho.wid < Fraction(1, 10**30)
    check(springs, motion)
    assert double_at(springs, Fraction(round(springs.flip.rho.mid * 990), 1000)) is None


@pytest.mark.slow
def test_what_attracts(springs):
    """Orbits that begin near an attracting one come nearer, near another one they leave."""
    rho = Fraction(round(springs.flip.rho.mid * 1005), 1000)
    motion, (first, *_) = double_at(springs, rho), springs.at(rho)
    assert attracts(springs, motion) is True and attracts(springs, first) is False
    with mp.workdps(30):
        for start, times, nearer in (
            (motion, motion.times, True),
            (first, first.times * 2, False),
        ):
            psi, lam = middles(start)[0]
            state = psi + mp.mpf("1e-6"), lam - 4 * real(springs.epsilon) * mp.mpf("1e-6")
            for _ in range(100):
                for t in times:
                    state = step(springs, real(rho), *state, real(t.mid))
            assert (abs(state[0] - psi) < 1e-8) is nearer
        values = eigenvalues(springs, motion)
        if values is not None:
            matrix = jacobian(springs, motion)
            found = sorted((mp.re(x) for x in mp.eig(matrix)[0]), reverse=True)
            assert all(inside(x, y, 1e-12) for x, y in zip(values, found, strict=True))


@pytest.mark.slow
def test_the_orbit_of_period_2_is_followed_to_its_end():
    """For plastic impacts, m = 1, it sticks before it loses its stability."""
    springs = Springs(1, Fraction(0), Fraction(0), Fraction(0), 80)
    *inner, last = followed(springs)
    assert len(inner) > 10 and all(found.orbit for _, found in inner)
    assert last[1].orbit is False and "sticks" in last[1].reason
    impacts = [real(last[0].rho.mid) * mp.sin(psi) for psi, _ in middles(last[0])]
    assert min(impacts) < 2 < max(impacts)
    springs = Springs(1, Fraction(3, 10), Fraction(0), Fraction(0), 80)
    *_, last = followed(springs)
    assert last[1].orbit and attracts(springs, last[0]) is False


@pytest.mark.parametrize(("m", "expected"), [(1, "0.02045763242"), (3, "0.00212709207")])
def test_the_limit_by_h(m, expected):
    """Fixed points on both sides of h: the theorem and the flight agree."""
    for epsilon in ("1/100", "1/2"):
        springs = Springs(m, Fraction(epsilon), Fraction(0), Fraction(0), 70)
        assert abs(real(critical_epsilon(springs).mid) - mp.mpf(expected)) < 1e-11
        least = least_height(springs)
        for beside in ("1/1000", "-1/1000"):
            motion = springs.fixed(springs.exact(least.mid + Fraction(beside)))
            found = judge_fixed(springs, motion, least)
            assert found.orbit is judge(springs, motion).orbit is (beside[0] != "-")
    touch = springs.fixed(least)
    assert judge_fixed(springs, touch, least).orbit is None is judge(springs, touch).orbit


def test_a_saddle_node_is_not_told_from_two_points():
    springs = Springs(1, Fraction(1, 2), Fraction(0), Fraction(0), 60)
    with pytest.raises(Undecided):
        springs.at(springs.saddle_node.rho.mid)


@pytest.mark.parametrize(
    ("matrix", "expected"),
    [
        (((0, 1), ("-1/2", 0)), True),
        (((0, 1), ("-3/2", 0)), False),  # a pair of modulus above 1
        (((0, 1), (1, 0)), None),
        ((("3/2", 0), (0, "1/2")), False),
        ((("-3/2", 0), (0, "1/2")), False),
    ],
)
def test_both_eigenvalues_have_to_be_inside(matrix, expected):
    rows = [[Interval(entry) for entry in row] for row in matrix]
    assert attracts(SimpleNamespace(derivative=lambda motion: rows), None) is expected


def test_a_launch_into_the_table_is_no_orbit():
    """A velocity with which no mass arrives: below the table at first, above it from then on."""
    springs = Springs(1, Fraction(1, 10), Fraction(0), Fraction(0), 80)
    rho, psi, lam = mp.mpf(20), mp.mpf(1), 20 * mp.cos(1) + mp.mpf("0.01")
    gap, _ = flight(springs, rho, psi, lam)
    end = mp.findroot(gap, (4, 12), solver="anderson")
    assert gap(mp.mpf("1e-5")) < 0 and all(gap(end * n / 500) > 0 for n in range(1, 500))
    state = State(springs.exact(1), springs.exact(Fraction(str(lam))))
    times = (springs.exact(Fraction(str(end))).widen(Fraction(1, 10**9)),)
    assert judge(springs, Motion(springs.exact(20), (state,), times)).orbit is None


def test_fixed_points_are_those_of_falling_masses():
    """With stiff springs there may be no flip, and one fixed point instead of two."""
    springs = Springs(1, Fraction(0), Fraction(2, 5), Fraction(10), 80)
    assert springs.flip is None
    (motion,) = springs.at(Fraction(40))
    assert motion.impacts[0].lam.sup < 0
