"""Functions of Interval and IntervalArray alike: ranges, domains, poles, steps, corners."""

import math
import random
from fractions import Fraction

import flint
import pytest
from hypothesis import example
from hypothesis import strategies as st

import intervals
from intervals import DomainError, Interval, IntervalArray
from tests.intervals import oracle
from tests.intervals.boxes import boxes, for_all

RANGES = {
    **dict.fromkeys(("exp", "exp2", "exp10", "expm1", "sinh", "cosh", "tanh"), (-30, 30)),
    **dict.fromkeys(("cbrt", "atan", "asinh"), (-50, 50)),
    **{name: (Fraction(1, 1000), 50) for name in ("log", "log2", "log10")},
    **dict.fromkeys(("asin", "acos"), (-1, 1)),
    **dict.fromkeys(("sin", "cos"), (-9, 9)),
    "sqrt": (0, 50),
    "log1p": (Fraction(-999, 1000), 50),
    "tan": (Fraction(-3, 2), Fraction(3, 2)),
    "acosh": (1, 50),
    "atanh": (Fraction(-999, 1000), Fraction(999, 1000)),
}
parts = st.integers(0, 2**20) | st.sampled_from([0, 2**20])


def both(low, high, precision=53):
    """The same interval as an Interval and in an IntervalArray."""
    return Interval(low, high, precision=precision), IntervalArray([(low, high)])


def ends(y):
    """The exact ends of an Interval, or of an array of one."""
    return (y.inf, y.sup) if isinstance(y, Interval) else tuple(map(Fraction, (y.inf[0], y.sup[0])))


def contains(y, low, high):
    """Whether a true value in [low, high], far narrower than an ulp, can be in the result."""
    bottom, top = ends(y)
    return bottom <= high and low <= top


@pytest.mark.parametrize("name", RANGES)
@for_all(parts, parts, parts, st.integers(2, 200), tries=25)
def test_ranges_contain_the_values_inside(name, s, t, r, precision):
    least, most = RANGES[name]
    low, high = sorted(least + (most - least) * Fraction(k, 2**20) for k in (s, t))
    point = low + (high - low) * Fraction(r, 2**20)
    below, above = oracle.evaluate(oracle.FUNCTIONS[name], 500, point)
    for x in both(low, high, precision):
        try:
            y = getattr(intervals, name)(x)
        except DomainError:
            # rounding outward may leave the domain, or reach a pole of tan
            assert name in ("asin", "acos", "atanh", "tan", "acosh", "log1p", "log", "sqrt")
            continue
        assert contains(y, below, above)


@pytest.mark.parametrize(
    ("name", "inside", "outside"),
    [
        ("sqrt", [(0, 4), (0, 0)], [(-1, 4), (-2, -1), ("-1e-300", 1)]),
        ("log", [("1e-300", 2)], [(0, 1), (-1, 2), (0, 0)]),
        ("log2", [("1e-300", 2)], [(0, 1)]),
        ("log10", [("1e-300", 2)], [(0, 1)]),
        ("log1p", [("-0.99", 2)], [(-1, 1), (-2, 0)]),
        ("asin", [(-1, 1)], [(-1, "1.0000000000001"), (2, 3)]),
        ("acos", [(-1, 1)], [("-1.0000000000001", 0)]),
        ("acosh", [(1, 2)], [("0.99", 2), (-3, -2)]),
        ("atanh", [("-0.99", "0.99")], [(-1, 0), (0, 1), (0, 2)]),
        (
            "tan",
            [("-1.57", "1.57"), ("1.58", "4.71"), (21, 22)],
            [(1, 2), (-2, -1), (0, 4), (0, 100), (4, 5)],
        ),
    ],
)
def test_domains(name, inside, outside):
    for box in inside:
        for x in both(*box):
            getattr(x, name)()
    for box in outside:
        for x in both(*box):
            with pytest.raises(DomainError, match=f"{name} of an interval that"):
                getattr(x, name)()
    with pytest.raises(DomainError):
        getattr(IntervalArray([inside[0], outside[0]]), name)()


STEPS = {
    "floor": math.floor,
    "ceil": math.ceil,
    "trunc": math.trunc,
    "round_ties_to_even": round,
    "round_ties_to_away": lambda x: math.floor(abs(x) + Fraction(1, 2)) * (1 if x > 0 else -1),
    "sign": lambda x: (x > 0) - (x < 0),
}
quarters = st.integers(-60, 60).map(lambda k: Fraction(k, 4))
dyadics = quarters | st.floats(-1e17, 1e17).map(Fraction)


@pytest.mark.parametrize("name", STEPS)
@for_all(dyadics, dyadics, tries=100)
@example(Fraction(-5, 2), Fraction(3, 2))
@example(Fraction(-3, 2), Fraction(5, 2))
def test_step_functions_are_exact(name, x, y):
    low, high = min(x, y), max(x, y)
    for box in both(low, high):
        assert ends(getattr(intervals, name)(box)) == (STEPS[name](low), STEPS[name](high))


def test_step_functions_of_extreme_numbers():
    tiny = Interval(Fraction(1, 2**100000))
    assert [getattr(tiny, n)().inf for n in ("floor", "ceil", "trunc", "sign")] == [0, 1, 0, 1]
    assert (-tiny).floor() == Interval(-1)
    assert tiny.round_ties_to_even() == Interval(0)
    huge = Interval(2**30 - 1).exp()
    assert huge.floor() == huge


def box_of(data, low, high):
    ends = sorted(data.draw(st.fractions(low, high, max_denominator=64)) for _ in range(2))
    return tuple(Fraction(float(x)) for x in ends)


def inner(data, box):
    return box[0] + (box[1] - box[0]) * Fraction(data.draw(st.sampled_from([0, 1, 2, 5, 8])), 8)


def angle(q, p):
    return oracle.evaluate(flint.arb.atan2, 300, q, p)


@pytest.mark.slow
@for_all(st.data(), tries=120)
def test_hypot_and_powers_contain_the_values_inside(data):
    x, y = box_of(data, -9, 9), box_of(data, -9, 9)
    base = box_of(data, Fraction(1, 16), 9)
    p, q, r = inner(data, x), inner(data, y), inner(data, base)
    root = oracle.evaluate(oracle.FUNCTIONS["hypot"], 300, p, q)
    power = oracle.evaluate(oracle.FUNCTIONS["pow"], 300, r, q)
    for one, two, three in zip(both(*x), both(*y), both(*base), strict=True):
        assert contains(intervals.hypot(one, two), *root)
        assert contains(three.pow(two), *power)
        assert contains(three ** Interval(*y), *power)


@pytest.mark.slow
@for_all(st.data(), tries=150)
def test_atan2_contains_the_angles_inside(data):
    y, x = (box_of(data, -4, 4) for _ in range(2))
    if y[0] <= 0 <= y[1] and x[0] <= 0 <= x[1]:
        for one, two in zip(both(*y), both(*x), strict=True):
            with pytest.raises(DomainError, match=r"origin|\(0, 0\)"):
                one.atan2(two)
        return
    true = angle(inner(data, y), inner(data, x))
    for one, two in zip(both(*y), both(*x), strict=True):
        result = intervals.atan2(one, two)
        assert contains(result, *true)
        low, high = ends(result)
        assert (high - low > 6) == (x[0] < 0 and y[0] < 0 <= y[1])


def test_atan2_is_tight_at_the_corners():
    """The extremes of the angle over a box are angles of corners: brute force over all four."""
    numbers = random.Random(5)
    for _ in range(300):
        y, x = (sorted(Fraction(numbers.randint(-8, 8), 4) for _ in range(2)) for _ in range(2))
        if (y[0] <= 0 <= y[1] and x[0] <= 0 <= x[1]) or (x[0] < 0 and y[0] < 0 <= y[1]):
            continue
        corners = [angle(q, p) for q in y for p in x]
        low, high = min(c[0] for c in corners), max(c[1] for c in corners)
        pairs = zip(both(*y, precision=60), both(*x), (55, 46), strict=True)
        for one, two, bits in pairs:
            bottom, top = ends(one.atan2(two))
            assert abs(bottom - low) + abs(top - high) < Fraction(1, 2**bits)


@pytest.mark.parametrize("box", [((-1, 2), 1), ((0, 2), 0), ((0, 2), (-1, 1)), ((0, 1), (0, 2))])
def test_real_powers_need_a_positive_base(box):
    base, exponent = box
    exponent = exponent if isinstance(exponent, tuple) else (exponent, exponent)
    for x, y in zip(both(*base), both(*exponent), strict=True):
        with pytest.raises(DomainError, match="pow"):
            x.pow(y)


@for_all(
    st.fractions(-50, 50, max_denominator=1000),
    st.fractions(0, 3, max_denominator=50),
    st.integers(1, 9),
    st.sampled_from([10, 53, 200]),
)
def test_roots_are_the_tightest(low, width, n, precision):
    """y^n increases on y >= 0, and everywhere for odd n: it tells bounds of the root."""
    low = low if n % 2 else abs(low)
    for x in both(low, low + width, precision):
        y = intervals.rootn(x, n)
        (bottom, top), (low, high) = ends(y), ends(x)
        assert bottom**n <= low and high <= top**n
        inward = Fraction(1, 2 ** (precision - 1) if isinstance(x, Interval) else 2**49)
        tiny = Fraction(1, 2**200)  # roots of 0, of an array, reach to the next number or its roots
        assert (bottom + abs(bottom) * inward) ** n > low or (low == 0 and -tiny < bottom <= 0)
        assert (top - abs(top) * inward) ** n < high or (high == 0 and top < tiny)


def test_even_roots_of_negatives_and_roots_of_no_degree():
    for x in (Interval(-1, 1), IntervalArray([-1, 1])):
        with pytest.raises(DomainError):
            x.rootn(4)
        for degree in (0, -1):
            with pytest.raises(ValueError, match="degree"):
                x.rootn(degree)


pairs = st.tuples(quarters, quarters).map(sorted)


@for_all(pairs, pairs, tries=100)
def test_minimum_and_maximum(x, y):
    for name, choose in (("minimum", min), ("maximum", max)):
        for one, two in zip(both(*x), both(*y), strict=True):
            assert ends(getattr(one, name)(two)) == (choose(x[0], y[0]), choose(x[1], y[1]))
    assert intervals.minimum(0, Interval(*x)) == Interval(min(0, x[0]), min(0, x[1]))


@for_all(pairs, pairs, pairs, tries=100)
def test_fma_cancel_bisect_widen(x, y, z):
    products = [a * b for a in x for b in y]
    low, high = min(products) + z[0], max(products) + z[1]
    for one, two, three in zip(both(*x), both(*y), both(*z), strict=True):
        bottom, top = ends(one.fma(two, three))
        assert bottom <= low and high <= top
    wider, narrower = sorted((x, y), key=lambda box: box[1] - box[0], reverse=True)
    rest = Interval(*wider).cancel_minus(Interval(*narrower))
    assert rest + Interval(*narrower) == Interval(*wider)
    assert Interval(*wider).cancel_plus(-Interval(*narrower)) == rest
    if wider[1] - wider[0] > narrower[1] - narrower[0]:
        assert Interval(*narrower).cancel_minus(Interval(*wider)) is None
    for box in both(*x):
        left, right = box.bisect()
        assert ends(left.hull(right)) == tuple(x)
        low, high = ends(box.widen("1/4"))
        assert low <= x[0] - Fraction(1, 4) and x[1] + Fraction(1, 4) <= high


@for_all(st.data(), st.sampled_from([3, 8, 53]))
def test_fma_is_rounded_once(data, precision):
    x, y, z = (data.draw(boxes(precision)) for _ in "xyz")
    products = [a * b for a in x for b in y]
    first, *rest = (Interval(*box, precision=precision) for box in (x, y, z))
    assert ends(first.fma(*rest)) == oracle.outward(
        min(products) + z[0], max(products) + z[1], precision
    )


def test_bisection_of_an_interval_that_cannot_be_halved():
    for x in (Interval(1, 1 + Fraction(1, 2**52)), Interval("1.1", precision=100)):
        left, right = x.bisect()
        assert left.hull(right) == x
    fine = Interval(0).minimum(-(2**60) - 1)  # its ends have more bits than its precision
    assert fine.bisect()[0].hull(fine.bisect()[1]) == fine


@pytest.mark.parametrize("value", [0.5, "0.5", None])
def test_functions_of_what_is_no_interval(value):
    for call in (lambda: intervals.sin(value), lambda: intervals.atan2(value, 1)):
        with pytest.raises(TypeError, match="Interval"):
            call()


def test_exponentials_of_very_negative_numbers_vanish():
    for name in ("exp", "exp2", "exp10"):
        low = getattr(Interval(-(10**300), -(2**40)), name)()
        assert low.inf == 0
        assert low.certainly_less(Interval(1, precision=10))
        wide = getattr(Interval(-(10**300), 0), name)()
        assert (wide.inf, wide.sup) == (0, 1)
        with pytest.raises(OverflowError):
            getattr(Interval(0, 10**300), name)()
    tiny = Interval("1/2").pow(2**60)
    assert tiny.inf == 0 and tiny.certainly_less(Interval(1))
    array = IntervalArray.from_floats([1e-300, 0.5]).pow(IntervalArray.from_floats([1e10, 1e300]))
    assert array.inf.tolist() == [0, 0] and (array.sup <= 1e-300).all()
