"""The monotone functions in binary64 against Arb: containment, stated ulps, ranges, refusals."""

import math

import flint
import numpy as np
import pytest

from intervals.elementary import binary64
from intervals.elementary.binary64.monotone import FUNCTIONS
from tests.effort import examples
from tests.intervals.binary64_oracle import ETA, MAX, distances, points, rows
from tests.intervals.measure_errors import errors, proved

QUICK = 1200
every_function = pytest.mark.parametrize("name", FUNCTIONS)


def enclosed(name, lower, upper=None):
    """The bounds (lower, upper) of monotone(name) as arrays."""
    low, high = binary64.monotone(name, rows(np.asarray(lower), upper))
    return -low, high


@every_function
def test_points(name):
    count = examples(3 * QUICK, 200_000)
    x = points(name, count, seed=1)
    within = proved(name, x)
    assert within.sum() > 0.5 * count
    for part, stated in (
        (x[within][:100_000], binary64.ERRORS[name]),
        (x[~within][: 300 + count // 300], 1.0),  # multiprecision, rounded outward
    ):
        assert distances(name, [part], binary64.monotone(name, rows(part))).max(initial=0) <= stated


@every_function
def test_errors_are_within_the_proved_bounds(name):
    _, error, k = errors(name, points(name, 5 * QUICK, seed=3))
    assert error.max() <= k <= FUNCTIONS[name].k
    assert binary64.ERRORS[name] <= 2 * FUNCTIONS[name].k + 1.54


@every_function
def test_wide_intervals_contain_images_and_are_those_of_the_ends(name):
    a, b = points(name, QUICK, seed=4), points(name, QUICK, seed=5)
    both = proved(name, a) & proved(name, b)
    keep = both | (np.arange(len(a)) < 60)  # some for multiprecision
    lower, upper, both = np.minimum(a, b)[keep], np.maximum(a, b)[keep], both[keep]
    low, high = enclosed(name, lower, upper)
    ends = [enclosed(name, lower), enclosed(name, upper)]
    first, last = ends[::-1] if FUNCTIONS[name].decreasing else ends
    assert (low == first[0])[both].all()
    assert (high == last[1])[both].all()
    t = np.random.default_rng(6).random(len(lower))
    inner = np.clip(lower * (1 - t) + upper * t, lower, upper)
    distances(name, [inner], rows(low, high))


@every_function
def test_blocks_and_shapes_do_not_show(name):
    low, high = FUNCTIONS[name].low, FUNCTIONS[name].high
    low, high = max(low, 0.01 if name.startswith("log") else -0.9), min(high, 0.9)
    x = np.linspace(low, max(high, low + 0.9), binary64.CHUNK + 6)
    whole = binary64.monotone(name, rows(x))
    parts = [binary64.monotone(name, rows(x[i : i + 7000])) for i in range(0, len(x), 7000)]
    assert (np.concatenate(parts, axis=1) == whole).all()
    assert (binary64.monotone(name, rows(x).reshape(2, 5, -1)).reshape(2, -1) == whole).all()
    ones = [binary64.monotone(name, rows(x[i : i + 1])) for i in range(0, len(x), 400)]
    assert (np.concatenate(ones, axis=1) == whole[:, ::400]).all()  # by Python's floats
    wide = binary64.monotone(name, rows(x, x + 0.01 * (x < 0.5)))
    assert (wide[0] == whole[0]).all() or name == "acos"
    assert binary64.monotone(name, np.empty((2, 0))).shape == (2, 0)


def test_ranges_are_respected():
    x = np.array([1.0, 18.0, 19.0, 20.0, 400.0, 1e200, MAX])
    low, high = enclosed("tanh", x)
    assert (high <= 1).all()
    assert (low[3:] >= 1 - 2.0**-50).all()
    assert enclosed("expm1", np.array([-650.0, -5000.0, -MAX]))[0].tolist() == [-1.0] * 3
    for name in ("exp", "exp2", "exp10"):
        low, high = enclosed(name, np.array([-5000.0, -1e300]))
        assert low.tolist() == [0.0, 0.0]
        assert high.tolist() == [ETA, ETA]
    assert enclosed("cosh", np.array([0.0]))[0] == 1.0
    assert enclosed("acos", np.array([1.0]))[0] == 0.0
    half_pi = float(flint.arb.pi()) / 2
    for name, x in (("asin", 1.0), ("atan", MAX), ("atan", 1e30)):
        low, high = enclosed(name, np.array([x]))
        assert half_pi - 1e-15 < low[0] <= half_pi < high[0] <= math.nextafter(half_pi, 2)


@pytest.mark.parametrize("name", ["exp", "exp2", "exp10", "expm1", "sinh", "cosh"])
def test_what_is_beyond_binary64_is_unbounded(name):
    for x in (1100.0, 1e9, MAX, math.inf):
        low, high = enclosed(name, np.array([0.5, x]))
        assert (low[1] == MAX or x == math.inf) and high[1] == math.inf and high[0] < 4
    low, high = enclosed("sinh", np.array([-1e5]))
    assert (low[0], high[0]) == (-math.inf, -MAX)


def test_a_bad_candidate_for_the_cube_root_is_not_believed(monkeypatch):
    x = np.array([8.0, -2.0, 1e9, 0.0])
    cbrt = np.cbrt
    monkeypatch.setattr(np, "cbrt", lambda v: cbrt(v) * np.array([1 + 2.0**-8, 2, np.nan, 1]))
    low, high = enclosed("cbrt", x)
    assert distances("cbrt", [x[:3]], rows(low[:3], high[:3])).max() <= 1
    assert (low[3], high[3]) == (0, 0)
