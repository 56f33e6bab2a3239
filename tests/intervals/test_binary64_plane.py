"""tan, atan2, hypot and x^y in binary64 against Arb: containment, ulps, poles, cuts, corners."""

import math

import flint
import numpy as np
import pytest

from intervals import DomainError
from intervals.elementary import binary64
from tests.intervals.binary64_oracle import ETA, MAX, distances, plane_points, points, rows
from tests.once import examples

COUNT = examples(4500, 100_000)


def tangents(_name, count, seed):
    x = points("tan", 2 * count, seed)
    return [x[(np.abs(x) >= 2.0**-400) | (x == 0)][:count]]


def check(name, x, bounds, stated=None):
    assert distances(name, x, bounds).max() <= (stated or binary64.ERRORS[name])


@pytest.mark.parametrize("name", ["tan", "atan2", "hypot", "power"])
def test_points(name):
    x = (tangents if name == "tan" else plane_points)(name, COUNT, 1)
    assert len(x[0]) == COUNT
    check(name, x, getattr(binary64, name)(*map(rows, x)))


# -- tan -------------------------------------------------------------------------------------------


def half_pi_multiples():
    with flint.ctx.workprec(300):
        half = flint.arb.pi() / 2
        return [(n, float((n * half).mid())) for n in range(-651, 652)]


def test_poles_are_refused_exactly_where_they_are():
    for n, x in half_pi_multiples():
        with flint.ctx.workprec(300):
            below = flint.arb(x) < n * flint.arb.pi() / 2
        a, b = (x, math.nextafter(x, math.inf)) if below else (math.nextafter(x, -math.inf), x)
        across = rows(np.array([a if n else -ETA]), np.array([b if n else ETA]))
        if n % 2:
            with pytest.raises(DomainError, match="pole"):
                binary64.tan(across)
            beside = rows(np.array([a - 1.0, b]), np.array([a, b + 1.0]))
            bounds = binary64.tan(beside)
            assert (bounds[1][0] > 1e11, bounds[0][1] > 1e11) == (True, True)
        else:
            bounds = binary64.tan(across)
            assert (bounds >= 0).all()


@pytest.mark.parametrize("shift", [1e5, 1e15, 1e300, -1e22])
def test_tan_beyond_the_limit(shift):
    x = np.array([shift])
    check("tan", [x], binary64.tan(rows(x)), 1)
    with pytest.raises(DomainError):
        binary64.tan(rows(x, x + max(4.0, 4 * np.spacing(abs(shift)))))


def test_tan_far_and_near_in_one_array():
    x = np.array([1.0, 2e3, 2.0**-1060, 0.0])
    check("tan", [x], binary64.tan(rows(x)))
    wide = rows(np.array([-1.5, 0.0, 2.0]), np.array([1.5, 1.0, 4.0]))
    bounds = binary64.tan(wide)
    for t in (0.0, 0.25, 0.5, 1.0):
        distances("tan", [-wide[0] * (1 - t) + wide[1] * t], bounds)
    for low, high in ((-2.0, 0.0), (1.0, 2.0), (0.0, 1000.0), (1000.0, 1025.0)):
        with pytest.raises(DomainError):
            binary64.tan(rows(np.array([low]), np.array([high])))


# -- atan2 and hypot -------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["atan2", "hypot"])
def test_extreme_points_of_the_plane(name):
    sizes = [0.0, ETA, 2.0**-1022, 1e-200, 1.0, 1e200, MAX / 2]
    sizes = [s * sign for s in sizes for sign in (-1, 1)]
    x, y = np.array([(a, b) for a in sizes for b in sizes if a or b]).T.copy()
    check(name, (x, y), getattr(binary64, name)(rows(x), rows(y)))


def boxes(count, seed):
    rng = np.random.default_rng(seed)
    ends = rng.choice([-3.0, -1.0, -(2.0**-20), 0.0, 2.0**-20, 1.0, 3.0], (2, 2, count))
    ends = np.where(rng.random(ends.shape) < 0.3, rng.normal(size=ends.shape), ends)
    ends.sort(axis=1)
    return ends


def corners_and_more(x, y, seed):
    rng = np.random.default_rng(seed)
    for _ in range(6):
        t, s = (rng.choice([0.0, 0.0, 1.0, 1.0, 0.5, 0.1], x.shape[1]) for _ in range(2))
        a, b = x[0] * (1 - t) + x[1] * t, y[0] * (1 - s) + y[1] * s
        yield np.clip(a, x[0], x[1]), np.clip(b, y[0], y[1])


def test_boxes_of_angles():
    x, y = boxes(4000, 5)
    origin = (x[0] <= 0) & (x[1] >= 0) & (y[0] <= 0) & (y[1] >= 0)
    x, y = x[:, ~origin], y[:, ~origin]
    bounds = binary64.atan2(rows(*y), rows(*x))
    for a, b in corners_and_more(x, y, 6):
        distances("atan2", (b, a), bounds)
    crosses = (y[0] < 0) & (y[1] >= 0) & (x[0] < 0)
    assert crosses.sum() > 50
    assert (bounds[:, crosses] == math.nextafter(math.pi, 4)).all()
    # elsewhere the range is the hull of the corners' angles, to a few ulps
    x, y, bounds = x[:, ~crosses], y[:, ~crosses], bounds[:, ~crosses]
    corners = np.stack([binary64.atan2(rows(b), rows(a)) for a in x for b in y])
    assert np.allclose(corners.max(axis=0), bounds, rtol=1e-15, atol=0)


def test_boxes_of_angles_that_contain_the_origin_are_refused():
    x, y = boxes(500, 7)
    origin = (x[0] <= 0) & (x[1] >= 0) & (y[0] <= 0) & (y[1] >= 0)
    for i in np.flatnonzero(origin)[:60]:
        with pytest.raises(DomainError, match="0, 0"):
            binary64.atan2(rows(*y[:, i : i + 1]), rows(*x[:, i : i + 1]))


def test_boxes_of_angles_beyond_the_proved_range():
    tiny = 2.0**-1000
    bounds = binary64.atan2(
        rows(np.array([-1e300, tiny]), np.array([-1.0, 1e300])),
        rows(np.array([-1.0, -1e308]), np.array([tiny, -tiny])),
    )
    assert (-bounds[0] >= [-math.pi, math.pi / 2 - 1e-9]).all()
    assert bounds[1, 1] >= math.pi
    cut = binary64.atan2(
        rows(np.array([-tiny]), np.array([0.0])), rows(np.array([-1e300]), np.array([-tiny]))
    )
    assert (cut >= math.pi).all()


def test_boxes_of_hypotenuses():
    x, y = boxes(3000, 8)
    bounds = binary64.hypot(rows(*x), rows(*y))
    assert (bounds[0] <= 0).all()
    for a, b in corners_and_more(x, y, 9):
        distances("hypot", (a, b), bounds)
    touches = (x[0] <= 0) & (x[1] >= 0) & (y[0] <= 0) & (y[1] >= 0)
    assert touches.any()
    assert (bounds[0][touches] == 0).all()
    farthest = binary64.hypot(*(rows(np.abs(v).max(axis=0)) for v in (x, y)))
    nearest = (np.where((v[0] <= 0) & (v[1] >= 0), 0.0, np.abs(v).min(axis=0)) for v in (x, y))
    assert (bounds[1] == farthest[1]).all()
    assert (bounds[0] == binary64.hypot(*map(rows, nearest))[0]).all()


# -- real powers -----------------------------------------------------------------------------------


def test_powers_of_boxes():
    rng = np.random.default_rng(12)
    x = np.sort(2.0 ** rng.uniform(-8, 8, (2, 2000)), axis=0)
    y = np.sort(rng.uniform(-20, 20, (2, 2000)), axis=0)
    x[:, :300] = np.sort(rng.choice([0.5, 1.0, 2.0], (2, 300)), axis=0)
    for a, b in ((x, y), (x, y[:1].repeat(2, axis=0)), (x[:1].repeat(2, axis=0), y)):
        bounds = binary64.power(rows(*a), rows(*b))
        for p, q in corners_and_more(a, b, 13):
            distances("power", (p, q), bounds)
        corners = np.stack([binary64.power(rows(p), rows(q)) for p in a for q in b])
        assert (corners.max(axis=0) == bounds).all()


def test_powers_beyond_the_proved_range():
    x = np.array([ETA, 1e-310, 0.5, 1e300, 2.0, 3.0])
    y = np.array([0.5, -0.99, 1050.0, -1.05, 1023.5, -1e-320])
    check("power", (x, y), binary64.power(rows(x), rows(y)), 1)
    beyond = binary64.power(rows(np.array([2.0, 3.0])), rows(np.array([1024.0, 1e300])))
    assert beyond.tolist() == [[-MAX, -MAX], [math.inf, math.inf]]
    zero = binary64.power(
        rows(np.array([0.0]), np.array([4.0])), rows(np.array([0.5]), np.array([2.0]))
    )
    assert zero[0] == 0
    assert 16 <= zero[1] <= 16 + 1e-13
