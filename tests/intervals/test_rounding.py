"""Directed conversion and the outward step, also in foreign states of the floating-point unit.

A library that somebody imports may leave the thread in another rounding mode, or let it flush
subnormal numbers to zero. Every public operation then encloses the truth, or refuses.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example
from hypothesis import strategies as st

from intervals.array import IntervalArray
from intervals.rounding import (
    ETA,
    MAX,
    bounded,
    float_down,
    float_up,
    outward,
    outward_sum,
    require_nearest,
    require_subnormals,
)
from tests.intervals.boxes import for_all
from tests.intervals.foreign_states import (
    ANY_MODE,
    MULTIPRECISION,
    OPERATIONS,
    RELATIONS,
    STATES,
    foreign,
    results,
    x86_linux,
)

MODES = ["downward", "upward", "toward zero"]
FLUSHED = "subnormal numbers are flushed to zero in this thread"
NOT_NEAREST = "this thread does not round to nearest"

finite = st.floats(allow_nan=False, allow_infinity=False)
edges = st.sampled_from(
    [0.0, ETA, 2.0**-1022, 2.0**-1022 - ETA, 2.0**-970, 1.0, 1.0 - 2.0**-53, 2.0**52, 2.0**1023]
)
numbers = finite | edges | edges.map(lambda x: -x)


@for_all(st.fractions() | finite.map(Fraction), st.integers(-1100, 1020), tries=100)
@example(Fraction(2**53), 0)
@example(Fraction(-(2**53) - 1), 0)
def test_conversions_are_the_tightest(value, exponent):
    value *= Fraction(2) ** exponent
    if abs(value) >= MAX:
        return
    low, high = float_down(value), float_up(value)
    assert Fraction(low) <= value <= Fraction(high)
    assert low == high or math.nextafter(low, math.inf) == high
    assert (low == high) is (Fraction(float(value)) == value)


def test_conversions_at_the_ends_of_the_range():
    top = Fraction(MAX)
    assert float_down(top) == float_up(top) == MAX
    assert float_down(top + 1) == MAX
    assert float_up(-top - 1) == -MAX
    for convert, value in (
        (float_up, top + 1),
        (float_down, -top - 1),
        (float_up, 2 * top),
        (float_down, 2 * top),
        (float_down, 10**400),
    ):
        with pytest.raises(OverflowError):
            convert(value)
    tiny = Fraction(1, 2**2000)
    assert (float_down(tiny), float_up(tiny)) == (0.0, ETA)
    assert (float_down(-tiny), float_up(-tiny)) == (-ETA, 0.0)


@for_all(numbers, tries=100)
def test_outward_passes_the_next_number(x):
    if abs(x) > MAX / 2:
        return
    y = float(outward(np.array([x]))[0])
    assert y >= math.nextafter(x, math.inf)
    assert Fraction(y) - Fraction(x) <= abs(Fraction(x)) / 2**51 + Fraction(ETA)


@for_all(numbers, numbers, tries=100)
def test_outward_sum_encloses_sums(x, y):
    if abs(x) + abs(y) > MAX / 2:
        return
    exact = Fraction(x) + Fraction(y)
    bound = Fraction(float(outward_sum(np.array([x + y]))[0]))
    assert exact <= bound
    assert (exact == 0) <= (bound == 0)
    if abs(x + y) >= 2.0**-1022:
        assert bound >= Fraction(math.nextafter(x + y, math.inf))


@pytest.mark.parametrize("bad", [math.nan, math.inf, MAX])
def test_out_of_range_is_refused(bad):
    with pytest.raises(OverflowError):
        bounded(np.array([0.0, bad]))
    with np.errstate(all="ignore"):
        assert outward(np.array([bad])).tolist() == [math.inf]
        assert outward(np.array([-math.inf])).tolist() == [-MAX]
    assert bounded(np.empty((2, 0))).size == 0


def points():
    rng = np.random.default_rng(20)
    x, y = (rng.normal(size=400) * 2.0 ** rng.integers(-520, 500, 400) for _ in range(2))
    x[:60], y[20:60] = (1.0 + np.arange(60) * 2.0**-52) * 2.0**-100, 2.0**-1050
    return x, y


def encloses(result, exact):
    pairs = zip(result.inf.tolist(), exact, result.sup.tolist(), strict=True)
    return all(Fraction(low) <= value <= Fraction(high) for low, value, high in pairs)


@x86_linux
@pytest.mark.parametrize("mode", ["nearest", *MODES])
def test_arithmetic_holds_in_every_rounding_mode(mode):
    x, y = points()
    wide = IntervalArray.from_floats(x, x + np.abs(x) / 8)
    with foreign(*STATES[mode]):
        a, b = IntervalArray.from_floats(x), IntervalArray.from_floats(y)
        results = a + b, a - b, a * b, a / b, a.sqr(), wide * b, wide * wide
        root = abs(a).sqrt()
    pairs = [(Fraction(p), Fraction(q)) for p, q in zip(x.tolist(), y.tolist(), strict=True)]
    true = [(p + q, p - q, p * q, p / q, p * p, p * q, p * p) for p, q in pairs]
    for result, values in zip(results, zip(*true, strict=True), strict=True):
        assert encloses(result, values)
    for (p, _), bottom, top in zip(pairs, root.inf.tolist(), root.sup.tolist(), strict=True):
        assert Fraction(bottom) ** 2 <= abs(p) <= Fraction(top) ** 2


@x86_linux
@pytest.mark.parametrize("mode", MODES)
def test_what_other_rounding_modes_refuse(mode):
    x, big = IntervalArray([1]), IntervalArray.from_floats([1e300, -1e300])
    small = IntervalArray(["1e-10"])
    with foreign(*STATES[mode]):
        with pytest.raises(FloatingPointError):
            x.sin()
        for operation in (lambda: big * big, lambda: big * 10**10, lambda: big / small):
            result = operation()
            assert ((result.sup == math.inf) | (result.inf == -math.inf)).any()
            assert not np.isnan(result._rows).any()
    require_nearest()


# -- every public operation ------------------------------------------------------------------------


@pytest.fixture(scope="module")
def undisturbed():
    return results("nearest")


def overlaps(outer, inner):
    """Whether each interval overlaps its undisturbed twin, and by all but a few ulps of it."""
    for low, high, true_low, true_high in zip(*outer, *inner, strict=True):
        slack = (abs(true_low) + abs(true_high)) * Fraction(1, 2**47) + Fraction(1, 2**1071)
        if not (low <= true_high and true_low <= high):
            return False
        if abs(low - true_low) > slack or abs(high - true_high) > slack:
            return False
    return True


@x86_linux
def test_undisturbed_results_are_results(undisturbed):
    assert not [name for name, value in undisturbed.items() if isinstance(value, str)]
    assert set(OPERATIONS) == set(undisturbed)
    assert undisturbed["positive"] == [True, False, True]
    assert undisturbed["subset"] == [False, False, False]


@x86_linux
@pytest.mark.parametrize("mode", MODES)
def test_rounding_modes(mode, undisturbed):
    for name, value in results(mode).items():
        if name in RELATIONS:
            assert value == undisturbed[name]
        elif name in ANY_MODE | MULTIPRECISION:
            assert overlaps(value, undisturbed[name]), name
        else:
            assert value == NOT_NEAREST, name
    require_nearest()


@x86_linux
@pytest.mark.parametrize("state", [state for state, (kind, _) in STATES.items() if kind == "flush"])
def test_flushing_is_refused(state, undisturbed):
    for name, value in results(state).items():
        assert value == (undisturbed[name] if name in MULTIPRECISION else FLUSHED), name
    with foreign(*STATES[state]):
        for require in (require_subnormals, require_nearest):
            with pytest.raises(FloatingPointError):
                require()
    require_nearest()
