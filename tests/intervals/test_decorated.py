"""Decorated sets by brute force: what a decoration promises, at exact points of the arguments.

The vectors of ITF1788 are run in tests/reference.
"""

import copy
import pickle
from fractions import Fraction
from math import inf

import pytest
from hypothesis import strategies as st

import intervals
from intervals import Decorated, Decoration, DomainError, Interval
from intervals.decorations import COM, DAC, DEF, ILL, TRV
from tests.intervals import oracle
from tests.intervals.boxes import for_all
from tests.intervals.test_functions import STEPS

numbers = st.integers(-40, 40).map(lambda n: Fraction(n, 8)) | st.sampled_from([-1, 0, 1])
pairs = st.tuples(numbers, numbers).map(sorted)
DOMAINS = oracle.DOMAINS | {"recip": lambda x: x != 0}
EVERYWHERE = ("exp", "exp2", "expm1", "sin", "cos", "atan", "sinh", "cosh", "tanh", "asinh", "cbrt")
EVERYWHERE += (*STEPS, "sqr", "__neg__", "__abs__")
JUMPS = {
    "floor": lambda x: x.denominator == 1,
    "ceil": lambda x: x.denominator == 1,
    "trunc": lambda x: x.denominator == 1 and x != 0,
    "sign": lambda x: x == 0,
    "round_ties_to_even": lambda x: x.denominator == 2,
    "round_ties_to_away": lambda x: x.denominator == 2,
}


def points(low, high):
    """Exact points, all multiples of 1/8 of the grid among them."""
    return [low + (high - low) * Fraction(k, 8) for k in range(9)] + [
        Fraction(n, 8) for n in range(-40, 41) if low <= Fraction(n, 8) <= high
    ]


def value(name, x):
    """The value at a point of the domain, in a narrow interval."""
    if name in STEPS:
        return Interval(STEPS[name](x))
    exact = {"recip": lambda: 1 / x, "sqr": lambda: x * x, "__neg__": lambda: -x}
    exact["__abs__"] = lambda: abs(x)
    if name in exact:
        return Interval(exact[name](), precision=200)
    return Interval(*oracle.evaluate(oracle.FUNCTIONS[name], 200, x), precision=200)


@pytest.mark.parametrize("name", [*DOMAINS, *EVERYWHERE])
@for_all(pairs, tries=20)
def test_promises_of_functions_of_one_variable(name, ends):
    found = getattr(Decorated(Interval(*ends)), name)()
    inside = DOMAINS.get(name, lambda x: True)
    some = [x for x in points(*ends) if inside(x)]
    for x in some:
        y = value(name, x)
        assert found.inf <= y.sup and y.inf <= found.sup
    jumps = [x for x in some if name in JUMPS and JUMPS[name](Fraction(x))]
    constant = len({value(name, x) for x in some}) == 1
    best = TRV if len(some) < len(points(*ends)) else COM
    if name in STEPS and best is COM:
        best = DEF if not constant else DAC if jumps else COM
    assert found.decoration is best
    if not some:
        assert found.inf == inf and found.sup == -inf


@pytest.mark.parametrize("name", [*DOMAINS, *EVERYWHERE, "tan"])
@for_all(pairs, tries=20)
def test_inside_the_domain_the_sets_are_those_of_intervals(name, ends):
    x = Interval(*ends)
    try:
        expected = getattr(x, name)()
    except DomainError:
        assert getattr(Decorated(x), name)().decoration is TRV
        return
    found = getattr(Decorated(x), name)()
    assert found.interval == expected and found.decoration >= DEF


TWO = {
    "+": (lambda x, y: x + y, lambda x, y: True),
    "-": (lambda x, y: x - y, lambda x, y: True),
    "*": (lambda x, y: x * y, lambda x, y: True),
    "/": (lambda x, y: x / y, lambda x, y: y != 0),
}


@pytest.mark.parametrize("name", TWO)
@for_all(pairs, pairs, tries=40)
def test_arithmetic_by_brute_force(name, a, b):
    operation, defined = TWO[name]
    found = operation(Decorated(Interval(*a)), Decorated(Interval(*b)))
    grid = [(x, y) for x in points(*a) for y in points(*b)]
    values = [operation(Fraction(x), Fraction(y)) for x, y in grid if defined(x, y)]
    assert all(found.inf <= v <= found.sup for v in values)
    assert found.decoration is (COM if len(values) == len(grid) else TRV)
    if found.decoration is COM:
        ends = oracle.outward(min(values), max(values), 53)
        assert (found.inf, found.sup) == ends  # taken at corners, which are in the grid
    elif values:
        assert inf in (-found.inf, found.sup) or set(a) == {0}
    else:
        assert found == Decorated(None)


@for_all(pairs, pairs, st.integers(-4, 4), tries=40)
def test_powers_and_angles(a, b, n):
    x, y = Decorated(Interval(*a)), Decorated(Interval(*b))
    power, real, angle = x**n, x.pow(y), y.atan2(x)
    for p in points(*a):
        if p or n >= 0:
            assert power.inf <= Fraction(p) ** n <= power.sup
        for q in points(*b)[:9]:
            if p > 0 or (p == 0 and q > 0):
                low, high = oracle.evaluate(oracle.FUNCTIONS["pow"], 300, p, q) if p else (0, 0)
                assert real.inf <= high and low <= real.sup
            if p or q:
                low, high = oracle.evaluate(oracle.FUNCTIONS["atan2"], 300, q, p)
                assert angle.inf <= high and low <= angle.sup
    assert power.decoration is (TRV if n < 0 and a[0] <= 0 <= a[1] else COM)
    assert real.decoration is (COM if a[0] > 0 or (a[0] == 0 < b[0]) else TRV)
    origin, cut = a[0] <= 0 <= a[1] and b[0] <= 0 <= b[1], a[0] < 0 and b[0] <= 0 <= b[1]
    assert angle.decoration is (TRV if origin else (DAC if b[0] == 0 else DEF) if cut else COM)


def test_numbers_and_decorations_that_are_given():
    x = Decorated(Interval(-1, 1))
    for found, expected in (
        (x / 0, "[empty]"),
        (0 / x, "[0, 0]_trv"),
        (0 * Decorated(None), "[empty]"),
        (Decorated(None).hull(1), "[1, 1]_trv"),
        (x.intersection(Interval(2, 3)), "[empty]"),
        (Decorated(x.interval, DEF) + 1, "[0, 2]_def"),
        (Decorated("[1, inf]", COM), "[1, inf]_dac"),
        (Decorated(None, COM), "[empty]_trv"),
        (Decorated(1, ILL), "[nai]"),
        (x.minimum(0).maximum(Fraction(-1, 2)), "[-1/2, 0]_com"),
        (Decorated(3).hypot(4).fma(2, 1), "[11]_com"),
        (2 ** Decorated(Interval(0, 3)), "[1, 8]_com"),
        (Decorated(4) ** Fraction(1, 2) - 1, "[1]"),
    ):
        assert found == Decorated(expected), expected


def test_a_promise_that_a_proof_needs():
    """x + 0/x has no zero at 0; the sets alone would say that it has one, by the fixed point."""

    def f(x):
        return x + 0 / x

    assert f(Decorated(Interval(1, 2))).decoration is COM
    assert f(Decorated(Interval(-1, 2))).decoration is TRV


@for_all(pairs, st.sampled_from(list(Decoration)), st.sampled_from([20, 53, 200]))
def test_text_pickle_and_copies(ends, decoration, precision):
    x = Decorated(Interval(*ends, precision=precision), decoration) / 3
    for y in (x, x.log(), 1 / x, Decorated(None)):
        for same in (
            eval(repr(y), {"Decorated": Decorated}),
            pickle.loads(pickle.dumps(y)),
            copy.deepcopy(y),
        ):
            assert same == y and hash(same) == hash(y) and same.precision == y.precision
        printed = Decorated(str(y), precision=300)
        assert printed.inf <= y.inf and y.sup <= printed.sup
        assert printed.decoration is y.decoration


def test_errors():
    for text in ("[1, 2]_ill", "[1, 2]_good", "[2, 1]", "[inf]", "[1, 2, 3]", "[nai]_trv", "1??"):
        with pytest.raises(ValueError):
            Decorated(text)
    for text in ("[empty]_com", "[1, inf]_com", "[1, inf", "[a, b]"):
        with pytest.raises(ValueError):
            Decorated(text)
    with pytest.raises(ValueError, match="not an interval"):
        _ = Decorated("[nai]").interval
    with pytest.raises(OverflowError, match="not bounded"):
        _ = Decorated("[0, inf]").interval
    assert Decorated(None).interval is None
    with pytest.raises(TypeError):
        Decorated(0.5)
    with pytest.raises(TypeError):
        Decorated(1) + 0.5
    with pytest.raises(TypeError, match="no number"):
        assert Decorated(1) == 1
    with pytest.raises(TypeError, match="truth"):
        bool(Decorated(1))


HUGE = {"exp": (0, 1), "exp2": (0, 1), "exp10": (0, 1), "expm1": (-1, 0), "cosh": (1, 1)}


@pytest.mark.parametrize("name", [*HUGE, "sinh"])
def test_values_that_no_interval_has_are_unbounded(name):
    """IEEE 1788: the result is not bounded, so the decoration is at most dac."""
    f = getattr(intervals, name)
    if name == "sinh":
        assert f(Decorated("[-2e10, 2e10]")) == Decorated("[entire]_dac")
    else:
        low, at_zero = HUGE[name]
        assert f(Decorated("[0, 2e10]")) == Decorated(f"[{at_zero}, inf]_dac")
        assert f(Decorated("[-inf, 2e10]")) == Decorated(
            f"[{1 if name == 'cosh' else low}, inf]_dac"
        )
    beyond = f(Decorated("[2e10, 3e10]"))
    assert beyond.inf == 2**1024 and beyond.sup == inf and beyond.decoration == DAC
    assert Decorated("[1, 2e10]").pow(Decorated("[1, 2e10]")) == Decorated("[1, inf]_dac")
