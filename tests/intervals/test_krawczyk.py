"""Krawczyk and interval Newton in several variables, on systems whose zeros are known."""

from fractions import Fraction
from itertools import product

import pytest
from hypothesis import strategies as st

from intervals import DomainError, Interval
from intervals.array import IntervalArray
from intervals.generic import meet
from intervals.operators import krawczyk, newton_system
from intervals.systems import Roots
from tests.intervals.boxes import check_claim, for_all, from_roots
from tests.intervals.oracle import sqrt_down, sqrt_up, ulp

METHODS = pytest.mark.parametrize("method", [krawczyk, newton_system])


def circle_and_line(x, y):
    return x.sqr() + y.sqr() - 1, x - y


def square(low, high, precision=53):
    return [Interval(low, high, precision=precision)] * 2


# -- single systems --------------------------------------------------------------------------------


@METHODS
@pytest.mark.parametrize("precision", [24, 53, 200, 1100])
def test_a_zero_to_every_precision(method, precision):
    outcome, box, _ = method(circle_and_line, square("0.5", 1, precision))
    low, high = sqrt_down(Fraction(1, 2), precision), sqrt_up(Fraction(1, 2), precision)
    assert outcome is Roots.UNIQUE
    for x in box:
        assert x.inf <= low and high <= x.sup
        assert x.wid <= 20 * ulp(low, precision)


@METHODS
def test_one_box_and_many_agree(method):
    pairs = [("1/2", 1), (-1, "-1/2"), (2, 3), (-1, 1), ("0.7", "0.70710678")]
    x = IntervalArray(pairs)
    many = method(circle_and_line, [x, x])
    unique, none, undecided = Roots.UNIQUE, Roots.NONE, Roots.UNDECIDED
    assert many.outcomes.tolist() == [unique, unique, none, undecided, none]
    for i, pair in enumerate(pairs):
        one = method(circle_and_line, square(*pair))
        assert (one.outcome, one.reason) == (many.outcomes[i], many.reasons[i])
        assert (one.box is None) == (one.outcome is Roots.NONE)
        if one.outcome is Roots.UNIQUE:
            for a, b in zip(one.box, many.boxes, strict=True):
                assert abs(a.inf - Fraction(b.inf[i])) < Fraction(1, 2**48)
                assert abs(a.sup - Fraction(b.sup[i])) < Fraction(1, 2**48)


UNIT, D = (-1, 1), Fraction(1, 2**10)
POSSIBLE = {Roots.UNDECIDED, Roots.AT_LEAST_ONE}
NO_PROOF = {Roots.UNDECIDED, Roots.NONE}
SIGNS = {Roots.AT_LEAST_ONE}
CASES = [  # equations, a box, the outcomes that are right
    (lambda x: x.sqr() - 2, [(1, 2)], {Roots.UNIQUE}),
    (lambda x: x.sqr() - 2, [("-1.5", "-1.4")], {Roots.UNIQUE}),
    (lambda x: x.sqr() - 2, [(2, 3)], {Roots.NONE}),
    (lambda x: x.sqr() - 2, [(-2, 2)], {Roots.UNDECIDED}),
    # all images equal the box: a subset of it, but not a proper one
    (lambda x, y: (0 * x, 0 * y), [UNIT, UNIT], SIGNS),
    (lambda x, y: (0 * x, 0 * y), [(0, 1), (3, 3)], SIGNS),
    (lambda x, y: (x - 3 * y, 2 * x - 6 * y), [UNIT, UNIT], POSSIBLE),
    (lambda x, y: (x - y, y - x), [(0, 2), (0, 2)], POSSIBLE),
    # the zeros are a segment: the image is thin in one variable and whole in the other
    (lambda x, y: (x, 0 * y), [UNIT, UNIT], POSSIBLE),
    (lambda x, y: (0 * y, x), [UNIT, UNIT], POSSIBLE),
    # a triple zero inside, and at an end
    *((lambda x: x * x * x, [ends], SIGNS) for ends in ((-1, 2), (0, 1), (-1, 0), (0, 0))),
    # double zeros
    *(
        (lambda x, y: (x.sqr() + y.sqr() - 1, y - 1), [side, ("0.5", "1.5")], POSSIBLE)
        for side in (UNIT, ("-0.001", "0.002"), (0, 1))
    ),
    # a zero just outside
    (lambda x, y: (x + y, x - y), [(Fraction(1, 2**50), 1), UNIT], {Roots.NONE}),
    (lambda x, y: (x + y, x - y), [(-1, -Fraction(1, 2**50)), UNIT], {Roots.NONE}),
    # opposite signs on faces, the last time only after the approximate inverse
    (lambda x, y: (x * x * x + y * 0, 8 * y * y * y - x * x * x), [(-1, 2), (-1, 2)], SIGNS),
    (lambda x, y: (x.sqr(), y), [UNIT, UNIT], {Roots.UNDECIDED}),
    (lambda x, y: (y * (y.sqr() - Fraction(1, 4)), x), [UNIT, UNIT], SIGNS),
    # dependent equations have opposite signs on faces, and no common zero
    (lambda x, y: (x + y, x + y + D), [UNIT, UNIT], NO_PROOF),
    (lambda x, y: (x, x + D * y * y + D), [UNIT, UNIT], NO_PROOF),
    (lambda x, y: (x * y, x * y + D), [UNIT, UNIT], NO_PROOF),
]


@METHODS
@pytest.mark.parametrize(("f", "sides", "right"), CASES)
def test_outcomes(method, f, sides, right):
    """For a box, and for it in an array of one, which may decide less."""
    outcome, box, reason = method(f, [Interval(*side) for side in sides])
    assert outcome in right
    assert (box is None) == (outcome is Roots.NONE)
    assert "faces" in reason or outcome is not Roots.AT_LEAST_ONE
    many = method(f, [IntervalArray([side]) for side in sides])
    assert many.outcomes[0] in right | {Roots.UNDECIDED}


@METHODS
def test_a_zero_on_the_boundary(method):
    """(0, 0) is a corner or on an edge: never lost, and proved where the signs are exact."""
    for x, y in ((0, 1), (0, 1)), ((-1, 1), (0, 1)), ((-1, 0), (-1, 1)):
        for f, proved in (
            (lambda x, y: (2 * x, 3 * y), {Roots.UNIQUE, Roots.AT_LEAST_ONE}),
            (lambda x, y: (2 * x + y, x - y), set(Roots) - {Roots.NONE}),
        ):
            outcome, box, _ = method(f, [Interval(*x), Interval(*y)])
            assert outcome in proved
            assert all(side.contains(0) and side.wid < Fraction(1, 2**40) for side in box)


@METHODS
def test_an_image_disjoint_from_the_box_proves_that_there_is_no_zero(method):
    """x x - x - 1 over [2, 3] is enclosed in [0, 6], the image in [1.6, 2)."""

    def f(x):
        return x * x - x - 1

    assert f(Interval(2, 3)).contains_zero()
    assert method(f, [Interval(2, 3)], steps=1).outcome is Roots.NONE
    assert method(f, [IntervalArray([(2, 3)])], steps=1).outcomes[0] is Roots.NONE


def test_the_common_part_is_taken_element_by_element():
    x, y = IntervalArray([(0, 2), (0, 2), (1, 1)]), IntervalArray([(1, 3), (5, 6), (0, 4)])
    assert meet(x, y).equal(IntervalArray([(1, 2), (0, 2), (1, 1)])).all()
    assert meet(Interval(0, 2), Interval(1, 3)) == Interval(1, 2)
    assert meet(Interval(0, 2), Interval(5, 6)) == Interval(0, 2)


@METHODS
def test_hypotheses_are_checked(method):
    with pytest.raises(ValueError, match="1 equations in 2 variables"):
        method(lambda x, y: (x + y,), square(-1, 1))
    with pytest.raises(ValueError, match="step"):
        method(circle_and_line, square(-1, 1), steps=0)
    with pytest.raises(DomainError):
        method(lambda x, y: (x.sqrt(), y), square(-1, 1))
    with pytest.raises(DomainError):  # not differentiable at 0
        method(lambda x, y: (x.sqrt(), y), square(0, 1))


# -- systems with known rational zeros -------------------------------------------------------------


rationals = st.fractions(-2, 2, max_denominator=8)
root_lists = st.lists(rationals, min_size=1, max_size=3)


@st.composite
def systems(draw):
    """A(p(x - c y), q(y)) for a regular A: all zeros are (r + c s, s), p(r) = 0, q(s) = 0."""
    a, b, c, d = (draw(st.integers(-3, 3)) for _ in range(4))
    if a * d == b * c:
        a, b, c, d = 1, 2, 1, 1
    shear = draw(st.sampled_from([0, 1, -2]))
    first, second = draw(root_lists), draw(root_lists)

    def f(x, y):
        p, q = from_roots(first, x - shear * y), from_roots(second, y)
        return a * p + b * q, c * p + d * q

    return f, {(r + shear * s, s) for r, s in product(first, second)}


@st.composite
def sides(draw, values):
    """An interval around, beside, from or to one of the values, or anywhere."""
    value = draw(st.sampled_from(sorted(values)))
    widths = st.sampled_from([Fraction(1), Fraction(1, 10), Fraction(1, 2**12), Fraction(0)])
    low, high = value - draw(widths), value + draw(widths)
    if draw(st.integers(0, 3)) == 0:
        low, high = high, high + draw(widths)
    return low, high


@st.composite
def problems(draw, count):
    f, roots = draw(systems())
    x, y = zip(*roots, strict=True)
    boxes = [(draw(sides(x)), draw(sides(y))) for _ in range(count)]
    return f, roots, boxes


methods, precisions = st.sampled_from([krawczyk, newton_system]), st.sampled_from([10, 24, 53, 150])


@pytest.mark.slow
@for_all(problems(4), methods, precisions, tries=30, at_length=75)
def test_what_is_claimed_is_true(problem, method, precision):
    """Of each box at some precision, and of all of them in arrays."""
    f, roots, boxes = problem
    for pair in boxes:
        box = [Interval(*side, precision=precision) for side in pair]
        outcome, smaller, reason = method(f, box)
        assert reason
        check_claim(outcome, box, smaller, roots)
    arrays = [IntervalArray(list(column)) for column in zip(*boxes, strict=True)]
    results = method(f, arrays)
    for i, outcome in enumerate(results.outcomes):
        box, smaller = ([x[i].item() for x in side] for side in (arrays, results.boxes))
        check_claim(outcome, box, smaller, roots)


@METHODS
def test_simple_zeros_are_found_in_small_boxes(method):
    """Each of 9 zeros in a box of radius 1/100 is unique; 9 boxes between them have none."""
    roots = [Fraction(-1), Fraction(1, 3), Fraction(5, 4)]
    centres = list(product(roots, roots))
    reach = Fraction(1, 100)

    def f(x, y):
        return from_roots(roots, x) + 3 * from_roots(roots, y), from_roots(roots, y)

    def around(shift):
        columns = zip(*centres, strict=True)
        return [IntervalArray([(c + shift - reach, c + shift + reach) for c in x]) for x in columns]

    assert set(method(f, around(0)).outcomes) == {Roots.UNIQUE}
    assert set(method(f, around(Fraction(1, 5))).outcomes) == {Roots.NONE}
