"""The forward-backward contractor: no solution is lost, and what can be cut is cut."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import strategies as st

import intervals
from intervals import Interval, IntervalArray, reverse
from intervals.branch import shaved
from intervals.contractor import contract, contracted
from intervals.formula import Formula
from intervals.reverse import quotient, root
from intervals.systems import Roots
from intervals.zero_finder import zeros
from tests.intervals.boxes import for_all

NAMES = {  # ends between which boxes are drawn
    **dict.fromkeys(("exp", "exp2", "exp10", "expm1", "sinh", "cosh", "tanh", "tan"), (-8, 8)),
    **dict.fromkeys(("sin", "cos", "atan", "asinh", "cbrt"), (-40, 40)),
    **dict.fromkeys(("log", "log2", "log10", "sqrt"), (Fraction(1, 100), 40)),
    "log1p": (Fraction(-1, 2), 40),
    **dict.fromkeys(("asin", "acos", "atanh"), (Fraction(-7, 8), Fraction(7, 8))),
    "acosh": (1, 40),
}
POWERS = {
    "square": (lambda x: x**2, (-8, 8)),
    "cube": (lambda x: x**3, (-8, 8)),
    "reciprocal": (lambda x: x**-3, (Fraction(1, 9), 8)),
    "real power": (lambda x: x.pow(Fraction(-3, 2)), (Fraction(1, 9), 8)),
    "fourth root": (lambda x: intervals.rootn(x, 4), (0, 8)),
    "fifth root": (lambda x: intervals.rootn(x, 5), (-8, 8)),
    "abs": (abs, (-8, 8)),
    "composed": (lambda x: 3 - 2 / (x.sqr() + 1), (-8, 8)),
    "numpy's": (lambda x: np.exp(np.multiply(-1, x)), (-8, 8)),
    "exponential": (lambda x: 3**x, (-8, 8)),
}
FUNCTIONS = {
    name: ((lambda x, name=name: getattr(x, name)()), ends) for name, ends in NAMES.items()
}
FUNCTIONS |= POWERS
parts = st.integers(0, 64).map(lambda k: Fraction(k, 64))


def point_value(f, x):
    """An interval of 200 bits around f(x): by `Interval`, whose kernel is not the arrays' one."""
    return f(Interval(x, precision=200))


@for_all(st.sampled_from(sorted(FUNCTIONS)), parts, parts, parts, st.sampled_from([0, 1, 20]))
def test_no_solution_is_lost(name, a, b, c, width):
    f, (low, high) = FUNCTIONS[name]
    a, c, b = (Fraction(float(low + t * (high - low))) for t in sorted((a, b, c)))
    try:
        value = point_value(f, c)
        f(Interval(a, b))
    except intervals.DomainError:  # a pole
        return
    target = Interval(value.inf, value.sup + Fraction(width, 10), precision=200)
    (rest,) = contract(f, Interval(a, b), [target])
    assert rest.contains(c) and Interval(a, b).contains(rest)


PARTIAL = {"sqrt": 0, "log": 0, "log2": 0, "log10": 0, "log1p": -1, "asin": -1, "acos": -1}
PARTIAL |= {"acosh": 1, "atanh": -1, "fourth root": 0}
TINIEST = Fraction(2) ** -1074


@for_all(st.sampled_from(sorted(PARTIAL)), parts, st.booleans(), st.sampled_from([0, 3]))
def test_what_leaves_the_domain_is_cut_to_it(name, part, near, width):
    """No solution in the domain is lost, also next to its ends; what is outside it goes."""
    f, low = FUNCTIONS[name][0], PARTIAL[name]
    start = low + (TINIEST if low == 0 else Fraction(1, 2**50)) if near else low + part / 2
    c = start + (name in ("log", "log2", "log10", "log1p", "atanh") and part == 0)
    if name in ("asin", "acos", "atanh") and c >= 1:
        return
    value = point_value(f, c)
    target = Interval(value.inf - width, value.sup + width, precision=200)
    (rest,) = contract(f, Interval(-9, 9), [target])
    assert rest.contains(c) and rest.inf >= low
    assert contract(f, Interval(-9, Fraction(-3, 2)), [target]) is None


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_what_takes_no_value_of_the_target_is_cut(name):
    """Of ever smaller targets around f(x) only what is near to a solution is left."""
    f, (low, high) = FUNCTIONS[name]
    c = Fraction(float(low + (high - low) * Fraction(11, 16)))
    box = Interval(c - Fraction(1, 16), c + Fraction(1, 32))
    (rest,) = contract(f, box, [point_value(f, c)])
    assert rest.contains(c) and rest.wid < Fraction(1, 10**10)
    above = f(box).sup + Fraction(1, 100)
    assert contract(f, box, [Interval(above, above + 1)]) is None


@pytest.mark.parametrize("name", ["sin", "cos"])
@pytest.mark.parametrize("start", [-20, -3, 0, 1, 17, 10**6])
def test_branches_of_periodic_functions(name, start):
    """Of f >= 0.9 the first and the last solution: an end of the box, or f = 0.9."""
    f, box, pi = getattr(intervals, name), Interval(start, start + 10), Interval.pi(precision=100)
    root, shift = Interval("0.9", precision=100).asin(), pi / 2 if name == "cos" else 0 * pi
    ends = [x for x in (Interval(box.inf), Interval(box.sup)) if f(x).inf > Fraction(9, 10)]
    turn = round(start / 6.283185307179586)
    for k in range(turn - 2, turn + 5):
        ends += [x + 2 * k * pi - shift for x in (root, pi - root)]
    inside = [x for x in ends if box.contains(x)]
    (rest,) = contract(f, box, [Interval("0.9", 1)])
    assert abs(rest.inf - min(x.inf for x in inside)) < Fraction(1, 10**8)
    assert abs(rest.sup - max(x.sup for x in inside)) < Fraction(1, 10**8)


HUGE = Interval.from_float(1e200).hull(Interval.from_float(-1e200))
UNIT = Interval(-1, 1)


@pytest.mark.parametrize(
    ("f", "box", "targets", "solution"),
    [
        (lambda x, y: x * x * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: (x * x + y) * y, [HUGE, UNIT], [0], (-(10**180), 0)),
        (lambda x, y: y / (x * x + 1) - 1, [HUGE, HUGE], [0], (10**80, 10**160 + 1)),
        (lambda x, y: (x * x).sin() * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: (x * x * y).exp() * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: (x**3 + x * x) * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: abs(x * x) * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: (x * x + 1).log() * y, [HUGE, UNIT], [0], (10**180, 0)),
        (lambda x, y: x * y - 1, [HUGE, HUGE], [0], (Fraction(1, 2**600), 2**600)),
        (lambda x, y: (x * x) * y - 1, [HUGE, HUGE], [0], (2**600, Fraction(1, 2**1200))),
    ],
)
def test_solutions_with_values_beyond_binary64_are_not_lost(f, box, targets, solution):
    rest = contract(f, box, targets)
    assert rest and all(x.contains(value) for x, value in zip(rest, solution, strict=True))


small = st.integers(-6, 6)
pairs = st.tuples(small, small).map(sorted)


def over(a, b):
    """a / b; an infinity beyond all numbers here where b = 0."""
    return Fraction(a, b) if b else (10**6 if a > 0 else -(10**6))


@for_all(pairs, pairs, pairs, tries=300)
def test_extended_division_is_the_hull(z, v, u):
    """{x in U: x y in Z for some y in V} from the signs of y, in fractions."""
    pieces = [u] if v[0] <= 0 <= v[1] and z[0] <= 0 <= z[1] else []
    for (low, high), (bottom, top) in (
        ((max(v[0], 0), v[1]), z),
        ((max(-v[1], 0), -v[0]), (-z[1], -z[0])),
    ):
        if 0 < high >= low:
            pieces.append(
                (over(bottom, high if bottom > 0 else low), over(top, low if top > 0 else high))
            )
    cut = [(max(u[0], low), min(u[1], high)) for low, high in pieces]
    cut = [(low, high) for low, high in cut if low <= high]
    x = IntervalArray([tuple(u)])
    part = quotient(IntervalArray([tuple(z)]), IntervalArray([tuple(v)]), x)
    if not cut:
        assert part.disjoint(x).all()
        return
    rest = part.intersection(x)
    low, high = min(low for low, _ in cut), max(high for _, high in cut)
    assert low - Fraction(1, 10**12) <= rest.inf[0] <= low
    assert high <= rest.sup[0] <= high + Fraction(1, 10**12)


def test_targets_boxes_and_what_is_no_formula():
    x, y = contract(lambda x, y: (x.sqr() + y.sqr(), x - y), [Interval(-9, 9)] * 2, [1, 0])
    assert x.contains(Interval(-1, 1)) and x.mag < Fraction(11, 10) and y.mag < Fraction(11, 10)
    for strange in (
        lambda x: x if x > 0 else -x,
        lambda x: x + 0.5,
        lambda x: np.isnan(x),
        lambda x: x.coefficients[0],
    ):
        with pytest.raises(TypeError):
            contract(strange, Interval(0, 1), [0])
    with pytest.raises(intervals.DomainError):
        contract(lambda x: 1 / x, Interval(-1, 1), [0])
    with pytest.raises(ValueError, match="zip"):
        contract(lambda x: (x, x), Interval(0, 1), [0])


# -- systems, with the numbers of zeros that others found ------------------------------------------


def henon(n):
    """The orbits of period n of Henon's map at (1.4, 0.3)."""
    a, b = Fraction(14, 10), Fraction(3, 10)
    return lambda *x: [1 - a * x[i] ** 2 + b * x[i - 1] - x[(i + 1) % n] for i in range(n)]


def broyden(n):
    """Broyden's tridiagonal system."""

    def f(*x):
        x = (0, *x, 0)
        return [(3 - 2 * x[i]) * x[i] - x[i - 1] - 2 * x[i + 1] + 1 for i in range(1, n + 1)]

    return f


@pytest.mark.slow
@pytest.mark.parametrize(
    ("f", "n", "reach", "count"),
    [
        (henon(7), 7, 2, 30),  # Galias 2001: four cycles of period 7, two fixed points
        pytest.param(henon(9), 9, 2, 56, marks=pytest.mark.slow),
        pytest.param(henon(11), 11, 2, 156, marks=pytest.mark.long),
        (broyden(8), 8, 1, 1),
        pytest.param(broyden(10), 10, 1, 1, marks=pytest.mark.slow),
    ],
)
def test_systems_are_decided(f, n, reach, count):
    results = zeros(f, [Interval(-reach, reach)] * n)
    assert [result.outcome for result in results] == [Roots.UNIQUE] * count


@for_all(
    st.lists(st.fractions(-9, 9), min_size=2, max_size=2), st.integers(1, 12), st.integers(0, 60)
)
def test_roots_are_enclosed(ends, n, shift):
    """Of powers of exact numbers, from tiny ones to large ones."""
    low, high = (Fraction(float(x * 2 ** (shift - 30))) for x in sorted(ends))
    powers = sorted((low**n, high**n))
    z = IntervalArray([tuple(powers)])
    found = root(z, IntervalArray([(low, high)]), n)
    assert found.contains(low).all() and found.contains(high).all()
    if n % 2 and max(abs(low), abs(high)) * 2 ** (900 // n) > 1:
        assert (found.wid <= float(high - low) + 1e-12 * float(max(abs(low), abs(high)))).all()


@pytest.mark.parametrize("n", [3, 5, 11])
def test_roots_of_sets_that_end_at_zero(n):
    for low, high in ((0, 2), (-2, 0), (0, 0), (0, Fraction(1, 2**40))):
        found = root(IntervalArray([(low**n, high**n)]), IntervalArray([(-9, 9)]), n)
        assert found.contains(low).all() and found.contains(high).all()
        assert (found.wid <= float(high - low) + 1e-12).all()


def test_a_root_that_is_wrong_is_not_believed(monkeypatch):
    monkeypatch.setattr(reverse, "_SLACK", -(2.0**-30))
    found = root(IntervalArray([(-32, 243), (32, 243)]), IntervalArray([(-9, 9), (0, 9)]), 5)
    assert found.contains(IntervalArray([(-2, 3), (2, 3)])).all()


@for_all(st.lists(st.integers(-12, 12), min_size=10, max_size=10), st.integers(0, 3))
def test_shaving_keeps_every_solution(numbers, wide):
    """Of a system of two quadratic equations made to have a solution at a point of the box."""
    a, b, c, d, x, y, *_ = numbers
    x, y = Fraction(x, 4), Fraction(y, 4)

    def f(u, v):
        left = a * (u**2 - x**2) + b * (u * v - x * y) + (v - y)
        return [left, c * (u * v - x * y) + d * (v**2 - y**2) + (u - x)]

    formula = Formula(f, 2)
    low, high = numbers[6:8], numbers[8:10]
    boxes = tuple(
        IntervalArray([(min(Fraction(e, 4), t) - wide, max(Fraction(g, 4), t) + wide)])
        for t, e, g in zip((x, y), low, high, strict=True)
    )
    zero = [IntervalArray([0])] * 2
    shaved_boxes, empty = shaved(lambda z: contracted(formula, z, zero), boxes)
    assert not empty.any()
    assert all(s.contains(t).all() for s, t in zip(shaved_boxes, (x, y), strict=True))


def test_shaving_cuts_what_one_contraction_cannot():
    """x - x^3 = 0: no cut of [0.4, 4] as a whole; the slices beyond 1 go. None: x - x^3 = 9."""
    formula = Formula(lambda x: x - x**3, 1)
    box = (IntervalArray.from_floats([0.4], [4.0]),)
    for target, left in ((0, True), (9, False)):
        parts, empty = shaved(lambda z, t=target: contracted(formula, z, [IntervalArray([t])]), box)
        assert left == (not empty.any())
        assert not left or (parts[0].sup < 2).all()
