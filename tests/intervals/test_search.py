"""Branch and bound: signs, ranges and zeros of functions for which these are known."""

import sys
import time
from fractions import Fraction
from functools import partial
from itertools import product

import flint
import numpy as np
import pytest
from hypothesis import strategies as st

from intervals import DomainError, Formula, Interval, rootn, search
from intervals.array import IntervalArray
from intervals.branch import clusters, evaluated, one_box, split
from intervals.search import Sign, range_of, sign_of
from intervals.systems import Roots
from intervals.zero_finder import _examined, zeros
from tests.intervals import oracle
from tests.intervals.boxes import for_all, from_roots, holds, horner

rationals = st.fractions(-2, 2, max_denominator=8)
dyadics = st.integers(-32, 32).map(lambda k: Fraction(k, 16))


# -- the parts -------------------------------------------------------------------------------------


def test_halves_cover_and_the_widest_side_is_cut():
    boxes = (IntervalArray([(0, 4), (0, 1), (2, 2)]), IntervalArray([(0, 3), (0, 2), (1, 1)]))
    unit = one_box([Interval(0, 1), Interval(0, 1)])
    halves, cut = split(boxes, unit, 2.0**-20)
    assert cut.tolist() == [True, True, False]
    corners = [list(zip(x.inf.tolist(), x.sup.tolist(), strict=True)) for x in halves]
    assert corners == [[(0, 2), (0, 1), (2, 4), (0, 1)], [(0, 3), (0, 1), (0, 3), (1, 2)]]
    other = one_box([Interval(0, 100), Interval(0, 1)])
    assert split(boxes, other, 2.0**-20)[0][1].sup.tolist() == [1.5, 1, 3, 2]
    assert not split(boxes, unit, 5.0)[1].any()


def test_parts_outside_the_domain_are_isolated():
    boxes = (IntervalArray([(1, 2), (-1, 2), (3, 4), (0, 1), (5, 6)]),)
    seen = list(evaluated(lambda b: b[0].log(), boxes))
    covered = [i for part, _ in seen for i in range(part.start, part.stop)]
    assert covered == list(range(5))
    missing = [i for part, answer in seen if answer is None for i in range(part.start, part.stop)]
    assert missing == [1, 3]
    with pytest.raises(ZeroDivisionError):  # only what says "not on this box" is caught
        list(evaluated(lambda b: 1 // 0, boxes))


corners = st.tuples(*[st.integers(0, 30)] * 2, *[st.integers(0, 6)] * 2)


@for_all(st.lists(corners, max_size=12), tries=40)
def test_clusters_are_disjoint_and_hold_their_members(sides):
    lower, sizes = np.split(np.array(sides, dtype=float).reshape(-1, 4), 2, axis=1)
    upper = lower + sizes
    groups = clusters(lower, upper)
    assert sorted(i for _, _, members in groups for i in members) == list(range(len(sides)))
    for low, high, members in groups:
        assert (low == lower[members].min(axis=0)).all()
        assert (high == upper[members].max(axis=0)).all()
    for i, (a, b, _) in enumerate(groups):
        for c, d, _ in groups[:i]:
            assert (b < c).any() or (d < a).any()


def test_only_binary64_boxes_are_taken():
    third = Interval(Fraction(1, 3), 1, precision=200)
    for function in (sign_of, range_of, zeros):
        with pytest.raises(ValueError, match="binary64"):
            function(lambda x: x - 2, third)


def test_boxes_as_wide_as_binary64():
    """Widths are infinite: no error, no warning, and all boxes with a zero are there."""
    wide = [Interval(-Fraction(sys.float_info.max), Fraction(sys.float_info.max))] * 2
    assert outcomes(zeros(lambda x, y: [x * x - 2, x - y], wide)) == [Roots.UNIQUE] * 2
    for f in (lambda x, y: [x * y, x - y], lambda x, y: [x.sin(), y]):
        near = [r for r in zeros(f, wide, limit=500) if all(x.contains_zero() for x in r.box)]
        assert near


# -- zeros -----------------------------------------------------------------------------------------


def outcomes(results):
    return [result.outcome for result in results]


def test_zeros_on_common_faces_are_found_once():
    """0, 1/2 and 1/4 are where [-1, 1] is cut."""
    roots = [Fraction(0), Fraction(1, 2), Fraction(1, 4), Fraction(-1, 3)]
    results = zeros(lambda x: from_roots(roots, x), Interval(-1, 1))
    assert outcomes(results) == [Roots.UNIQUE] * 4
    for root, result in zip(sorted(roots), results, strict=True):
        assert result.box[0].contains(root) and result.box[0].wid < Fraction(1, 2**44)


def test_zeros_at_the_ends_of_the_box():
    results = zeros(lambda x: x * (x - 1), Interval(0, 1))
    assert outcomes(results) == [Roots.UNIQUE] * 2
    low, high = oracle.sqrt_down(Fraction(2), 53), oracle.sqrt_up(Fraction(2), 53)
    for ends, count in (((1, low), 0), ((high, 2), 0), ((1, high), 1), ((low, 2), 1)):
        results = zeros(lambda x: x.sqr() - 2, Interval(*ends))
        assert len(results) <= 1
        if count:
            assert results and results[0].box[0].inf <= low and high <= results[0].box[0].sup
        elif results:
            assert results[0].outcome is Roots.UNDECIDED


def oscillation(**options):
    """sin(40 x) has 128 zeros k pi / 40 in [0, 10], 0 <= k <= 127: each is in some result."""
    results = zeros(lambda x: (40 * x).sin(), Interval(0, 10), **options)
    low, high = oracle.pi_bounds(100)
    for k in range(128):
        true = Interval(k * low / 40, k * high / 40, precision=200)
        assert any(result.box[0].contains(true) for result in results)
    return outcomes(results)


def test_many_zeros_and_a_limit():
    assert oscillation() == [Roots.UNIQUE] * 128
    for limit in (1, 10, 50):
        assert {Roots.UNDECIDED, Roots.AT_LEAST_ONE} & set(oscillation(limit=limit))


def test_multiple_zeros_at_fractions_have_their_multiplicity():
    third = Fraction(1, 3)
    for f, root, k in (
        (lambda x: (x - third).sqr(), third, 2),
        (lambda x: (x - third) * (x - third).sqr(), third, 3),
        (lambda x: x * x - 2 * x + 1, 1, 2),
        (lambda x: (x**2 - 2 * x + 1) / (x + 7), 1, 2),
        (lambda x: (2 * x + 1) ** 5, -Fraction(1, 2), 5),
    ):
        (result,) = zeros(f, Interval(-1, 2))
        assert result.outcome is Roots.UNIQUE and result.reason.endswith(f"multiplicity {k}")
        assert result.box[0].contains(root) and result.box[0].wid < Fraction(1, 2**50)


def test_other_multiple_zeros_stay_undecided_in_one_box_or_change_sign():
    (double,) = zeros(lambda x: (x * x - 2).sqr(), Interval(0, 2))
    assert double.outcome is Roots.UNDECIDED
    assert (double.box[0].sqr() - 2).contains(0) and double.box[0].wid < Fraction(1, 10**6)
    (triple,) = zeros(lambda x: (x * x - 2) ** 3, Interval(0, 2))
    assert triple.outcome is Roots.AT_LEAST_ONE and (triple.box[0].sqr() - 2).contains(0)
    (touching,) = zeros(lambda x, y: (x * x + y * y - 2, x + y - 2), [Interval(-3, 3)] * 2)
    assert touching.outcome is Roots.UNDECIDED and all(x.contains(1) for x in touching.box)
    third = Fraction(1, 3)
    assert zeros(lambda x: (x - third).sqr() + Fraction(1, 10**9), Interval(-1, 1)) == []
    for away in (2, Fraction(1, 1000)):  # two of them, or one that is no zero of the second value
        f = lambda x, d=away: (x * (x - d)).sqr()  # noqa: E731
        assert len(zeros(f, Interval(-1, 3))) == 2


def test_a_limit_in_seconds():
    begin = time.monotonic()
    results = zeros(lambda x: (1 / (x * x + Fraction(1, 1000))).sin(), Interval(-5, 5), seconds=0.0)
    assert time.monotonic() - begin < 20
    assert results and any(r.outcome is not Roots.UNIQUE for r in results)


def test_large_boxes_and_values_beyond_binary64():
    huge = Interval.from_float(1e200)
    for f, box, roots in (
        (lambda x: x * x - 4, huge.hull(-huge), [-2, 2]),
        (lambda x: x**3 - 8, huge.hull(-huge), [2]),
        (lambda x: (x - 1).exp() - 1, Interval(-(10**6), 10**6), [1]),
    ):
        results = zeros(f, box)
        assert outcomes(results) == [Roots.UNIQUE] * len(roots)
        assert all(r.box[0].contains(root) for r, root in zip(results, roots, strict=True))


@pytest.mark.parametrize(
    ("f", "ends", "count"),
    [
        (lambda x: rootn(x, 2) - 2, (-5, -3), 0),
        (lambda x: rootn(x, 2) - 2, (-5, 30), 1),
        (lambda x: x.log() - 1, (-5, 30), 1),
        (lambda x: (x - 3).log1p() - 1, (-5, 30), 1),
        (lambda x: x.asin() - 1, (-9, 9), 1),
        (lambda x: x.atanh() - 1, (-9, 9), 1),
        (lambda x: x.acosh() - 1, (-9, 9), 1),
        (lambda x: x.pow(Fraction(1, 3)) - 2, (-9, 9), 1),
        (lambda x: x.sqrt() + x.log() + 3, (-9, 0), 0),
    ],
)
def test_where_f_is_not_defined_there_is_no_zero(f, ends, count):
    assert outcomes(zeros(f, Interval(*ends), limit=3000)) == [Roots.UNIQUE] * count


def test_no_zero_is_proved_by_no_result():
    """Also where there is one just outside: inside the larger box that is tried, unique there."""
    for f, *box in (
        (lambda x: x.exp(), Interval(-5, 5)),
        (lambda x, y: (x.sqr() + y.sqr() - 1, x + y - 2), *[Interval(-3, 3)] * 2),
        (lambda x: x - 2, Interval(1)),
        (lambda x: 100 * x - 101, Interval(0, 1)),
        (lambda x, y: (100 * x + 1, y), Interval(0, 1), Interval(-1, 1)),
    ):
        assert zeros(f, box) == []


def test_functions_with_a_domain():
    assert outcomes(zeros(lambda x: x.log(), Interval(Fraction(1, 2**20), 4))) == [Roots.UNIQUE]
    (root,) = zeros(lambda x: x.sqrt() - 1, Interval(0, 4))  # sqrt has no slope at 0
    assert root.outcome is Roots.UNIQUE and root.box[0].contains(1)
    (root,) = zeros(lambda x: x.sqrt(), Interval(0, 4))
    assert root.outcome is Roots.UNDECIDED and root.box[0].contains(0)
    (pole,) = zeros(lambda x: 1 / x, Interval(-1, 1))
    assert pole.outcome is Roots.UNDECIDED and pole.box[0].contains(0)


def test_a_system_in_three_variables():
    """xyz = 6, x + y + z = 6, xy + yz + zx = 11: the permutations of (1, 2, 3)."""

    def f(x, y, z):
        return x * y * z - 6, x + y + z - 6, x * y + y * z + z * x - 11

    results = zeros(f, [Interval("0.5", "3.5")] * 3, limit=200_000)
    assert outcomes(results) == [Roots.UNIQUE] * 6
    mids = [tuple(round(x.mid) for x in result.box) for result in results]
    assert sorted(mids) == sorted(
        (a, b, 6 - a - b) for a, b in ((1, 2), (1, 3), (2, 1), (2, 3), (3, 1), (3, 2))
    )


def check_zeros(results, roots, given_box):
    """Every zero in some box; exactly one in each UNIQUE one, never the same."""
    inside = [root for root in roots if holds(given_box, root)]

    def within(result):
        return {root for root in inside if holds(result.box, root)}

    assert set(inside) == set().union(*map(within, results))
    unique = [within(result) for result in results if result.outcome is Roots.UNIQUE]
    assert all(len(found) == 1 for found in unique)
    assert len(set().union(*unique)) == len(unique)
    for result in results:
        assert result.outcome is not Roots.NONE and result.reason
        assert holds(given_box, result.box)
        assert result.outcome is not Roots.AT_LEAST_ONE or within(result)
    return inside


def test_a_hull_does_not_repeat_a_zero():
    """The zero 1 of x - 1 is in the hull; it was found before, perhaps, or was not."""
    hull = (IntervalArray([("0.5", "1.5")]),)
    for known, outcome in (((1, 1), []), ((1, 2), [Roots.UNDECIDED]), ((3, 4), [Roots.UNIQUE])):
        found = _examined(Formula(lambda x: x - 1, 1), hull, (IntervalArray([known]),), hull)
        assert outcomes(found) == outcome


@st.composite
def polynomials(draw):
    roots = draw(st.lists(rationals | dyadics, max_size=4))
    ends = st.sampled_from([r for r in roots if r.denominator in (1, 2, 4, 8)] or [Fraction(2)])
    low, high = sorted([draw(ends | dyadics), draw(ends | dyadics)])
    return roots, draw(st.booleans()), Interval(low, high)


@for_all(polynomials(), tries=30, at_length=100)
def test_all_zeros_of_a_polynomial(problem):
    roots, lifted, box = problem
    results = zeros(
        lambda x: from_roots(roots, x) * (x.sqr() + Fraction(1, 5) if lifted else 1), box
    )
    inside = check_zeros(results, {(root,) for root in roots}, [box])
    simple = {root for root in roots if roots.count(root) == 1 and box.inf < root < box.sup}
    unique = {
        r for (r,) in inside for x in results if x.outcome is Roots.UNIQUE and x.box[0].contains(r)
    }
    if len(roots) == len(set(roots)):
        assert simple <= unique


few = st.lists(rationals, min_size=1, max_size=2)


@pytest.mark.slow
@for_all(few, few, st.sampled_from([0, 1, -2]), tries=10)
def test_all_zeros_of_a_system(first, second, shear):
    def f(x, y):
        p, q = from_roots(first, x - shear * y), from_roots(second, y)
        return p + 2 * q, p - q

    box = [Interval(-2, 2)] * 2
    results = zeros(f, box, limit=5000)
    check_zeros(results, {(r + shear * s, s) for r, s in product(first, second)}, box)


# -- ranges and signs ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("f", "box", "low", "high"),
    [
        (lambda x: x * x * x - 3 * x, Interval(-2, 2), -2, 2),
        (lambda x: x.sin(), Interval(-10, 10), -1, 1),
        (lambda x: x, Interval("-0.5", 7), Fraction(-1, 2), 7),
        (lambda x: 0 * x + 3, Interval(1, 2), 3, 3),
        (lambda x, y: x.sqr() + y.sqr() - x * y, [Interval(-1, 1)] * 2, 0, 3),
        (lambda x, y: (x - y).sqr() * (x + y), [Interval(0, 1), Interval(0, 2)], 0, 8),
        (lambda x, y: [x - y], [Interval(0, 1), Interval(3)], -3, -2),
        (lambda x: x.sqrt() - x, Interval(0, 4), -2, Fraction(1, 4)),
    ],
)
def test_known_ranges(f, box, low, high):
    outer, inner = range_of(f, box, limit=60_000)
    assert 0 <= low - outer.inf < Fraction(1, 2**25) > outer.sup - high >= 0
    if inner is None:
        assert low == high
    else:
        assert 0 <= inner.inf - low < Fraction(1, 2**25) > high - inner.sup >= 0


def test_bounds_of_boxes_that_are_done_are_kept(monkeypatch):
    """[0, 1/2] is done early with the least bound, the rest later with larger ones."""
    bounds = {(0.0, 1.0): -10.0, (0.0, 0.5): 4.8, (0.5, 1.0): 0.0, (0.5, 0.75): 4.9, (0.75, 1.0): 5}

    def scripted(f, boxes):
        ends = zip(boxes[0].inf.tolist(), boxes[0].sup.tolist(), strict=True)
        return np.array([bounds[pair] for pair in ends], dtype=float), 5.0, boxes

    monkeypatch.setattr(search, "_bounds", scripted)
    assert search._least(None, one_box(Interval(0, 1)), lambda found: found - 1, 100) == (4.8, 5.0)


def test_a_pole_has_no_range():
    with pytest.raises(DomainError):
        range_of(lambda x: 1 / x, Interval(-1, 1))
    with pytest.raises(DomainError):
        sign_of(lambda x: 1 / x.sqr(), Interval(-1, 1), limit=500)


def test_the_limit_leaves_a_valid_range():
    outer, inner = range_of(lambda x: (30 * x).sin() * x, Interval(0, 3), limit=3)
    fine, _ = range_of(lambda x: (30 * x).sin() * x, Interval(0, 3))
    assert outer.contains(fine)
    assert inner is None or fine.contains(inner)
    assert outer.wid > fine.wid


def true_range(coefficients, low, high):
    """Bounds of the range of a polynomial over [low, high], from Arb's roots of its derivative."""
    candidates = [oracle.arb(low), oracle.arb(high)]
    slopes = flint.fmpq_poly(
        [k * flint.fmpq(c.numerator, c.denominator) for k, c in enumerate(coefficients)][1:]
    )
    if slopes.degree() > 0:
        for root, _ in slopes.numer().complex_roots():
            left, right = oracle.ends(root.real)
            if root.imag.contains(0) and left <= high and low <= right:
                candidates.append(root.real)
    values = [horner([oracle.arb(c) for c in coefficients], t) for t in candidates]
    return min(oracle.ends(v)[0] for v in values), max(oracle.ends(v)[1] for v in values)


@st.composite
def ranges(draw):
    coefficients = draw(st.lists(st.fractions(-3, 3, max_denominator=10), min_size=1, max_size=5))
    low, high = sorted([draw(dyadics), draw(dyadics)])
    return coefficients, low, high


@pytest.mark.slow
@for_all(ranges(), tries=25, at_length=100)
def test_ranges_and_signs_of_polynomials(problem):
    coefficients, low, high = problem
    box, tiny, fine = Interval(low, high), Fraction(1, 2**24), Fraction(1, 2**60)
    f = partial(horner, coefficients)

    with flint.ctx.workprec(300):
        bottom, top = true_range(coefficients, low, high)
    for tolerance in (2.0, 0.1, 0.001):
        rough = range_of(f, box, tolerance).outer
        assert rough.inf <= bottom + fine and top - fine <= rough.sup
    outer, inner = range_of(f, box)
    assert outer.inf - fine <= bottom <= outer.inf + tiny
    assert outer.sup - tiny <= top <= outer.sup + fine
    for k in range(33):
        assert outer.contains(f(low + (high - low) * Fraction(k, 32)))
    if inner is not None:
        assert bottom <= inner.inf + fine and inner.sup <= top + fine
    sign = sign_of(f, box, limit=5000)
    if sign.sign is Sign.POSITIVE:
        assert 0 < sign.lower <= bottom + fine
    elif sign.sign is Sign.NEGATIVE:
        assert top - fine <= sign.upper < 0
    elif sign.sign is Sign.ZERO:
        assert bottom <= 0 <= top
    else:
        assert sign.lower <= 0 <= sign.upper
    for proved, true in (
        (Sign.POSITIVE, bottom > tiny),
        (Sign.NEGATIVE, top < -tiny),
        (Sign.ZERO, bottom < -tiny and top > tiny),
    ):
        assert not true or sign.sign is proved


def test_signs():
    box = [Interval(-1, 1)] * 2
    tiny = Fraction(1, 10**6)
    for f, sign in (
        (lambda x, y: x.sqr() + y.sqr() + tiny, Sign.POSITIVE),
        (lambda x, y: -x.sqr() - y.sqr() - tiny, Sign.NEGATIVE),
        (lambda x, y: x.sqr() + y.sqr() - tiny, Sign.ZERO),
    ):
        assert sign_of(f, box).sign is sign
    touching = sign_of(lambda x, y: (x - y).sqr(), box, limit=2000)
    assert touching.sign is Sign.UNDECIDED
    assert -tiny < touching.lower <= 0 and 4 <= touching.upper < 4 + tiny


def test_rational_zeros_on_the_boundary_are_counted_once():
    """x y = 0, x + 3 y = 1 in the unit square: (1, 0) at a corner, (0, 1/3) on a side."""
    found = zeros(lambda x, y: [x * y, x + 3 * y - 1], [Interval(0, 1)] * 2)
    assert [x.outcome for x in found] == [Roots.UNIQUE] * 2
    exact = {(0, Fraction(1, 3)), (1, 0)}
    for result in found:
        assert (
            sum(all(x.contains(v) for x, v in zip(result.box, p, strict=True)) for p in exact) == 1
        )


def test_an_irrational_zero_on_the_boundary_stays_undecided():
    """x + y^2 = 2, x - y^2 = -2: the zero (0, sqrt 2) is on a side; (-1/10^9, ...) is beyond it."""
    box = [Interval(0, 1), Interval(1, 2)]
    found = zeros(lambda x, y: [x + y**2 - 2, x - y**2 + 2], box)
    assert [x.outcome for x in found] == [Roots.UNDECIDED]
    tiny = Fraction(1, 10**9)
    assert not zeros(lambda x, y: [x + y**2 - 2 + tiny, x - y**2 + 2 + tiny], box)
