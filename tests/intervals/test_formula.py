"""Formulas: what is recorded is what is proved; what branches is refused, by every solver."""

import math
import operator
import re
from fractions import Fraction
from functools import lru_cache

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

import intervals
from intervals import ComplexInterval, Decorated, Formula, Interval, IntervalArray, Jet
from intervals.contractor import contract
from intervals.operators import krawczyk, newton_system
from intervals.search import range_of, sign_of
from intervals.systems import Roots
from intervals.taylor import taylor
from intervals.zero_finder import zeros
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.expression import FUNCTIONS
from tests.intervals.boxes import for_all
from tests.proofs.trusted.kernel.test_formulas import expressions, formula, points

BOX = Interval(Fraction(1, 2), 2)
TABLE = {1: 0}


def _caught(x):
    """f(1) = 0, and where the question is refused, x + 1: which has no zero here."""
    try:
        return x - 1 if x == 1 else x + 1
    except TypeError:
        return x + 1


def _matched(x):
    match x:
        case 1:
            return x - 1
        case _:
            return x + 1


def _loop(x):
    while x < 1:
        x = 2 * x
    return x


BRANCHES = {  # of numbers; those that have f(1) = 0 take another way at 1 than elsewhere
    "==": lambda x: x - 1 if x == 1 else x + 1,
    "!=": lambda x: x + 1 if x != 1 else x - 1,
    "if": lambda x: x + 1 if x - 1 else x - 1,
    "not": lambda x: x - 1 if not x - 1 else x + 1,
    "and": lambda x: (x - 1 and x) + 1,
    "or": lambda x: x - 1 or x + 1,
    "<": lambda x: x - 1 if x < 2 else x + 1,
    ">=": lambda x: x - 1 if x >= 1 else x + 1,
    "chain": lambda x: x - 1 if 0 < x < 2 else x + 1,
    "while": _loop,
    "caught": _caught,
    "match": _matched,
    "in": lambda x: x - 1 if x in (1, 3) else x + 1,
    "min": lambda x: min(x, 2 - x) - 1,
    "max": lambda x: max(x - 1, 0),
    "sorted": lambda x: sorted([x, 1 + 0 * x])[0] - 1,
    "any": lambda x: x + 1 if any([x - 1]) else x - 1,
    "range": lambda x: sum((x for _ in range(int(x))), 0 * x) - 1,
    "index": lambda x: [x + 1, x - 1][x],
    "float": lambda x: x - 1 if float(x) == 1 else x + 1,
    "math": lambda x: x - 1 if math.floor(x) == 1 else x + 1,
    "round": lambda x: x - 1 if round(x) == 1 else x + 1,
    "%": lambda x: x % 1 + x,
    "//": lambda x: x // 1 - 1,
    "divmod": lambda x: divmod(x, 1)[0] - 1,
    "np.where": lambda x: np.where(x == 1, x - 1, x + 1).item(),
    "np.greater": lambda x: x - 1 if np.greater_equal(x, 1) else x + 1,
    "np.isclose": lambda x: x - 1 if np.isclose(x, 1) else x + 1,
    "dictionary": lambda x: TABLE.get(x, x + 1),
    "set": lambda x: x - 1 if x in {1} else x + 1,
    "cache": lru_cache(lambda x: x - 1),
    "iteration": lambda x: sum(y - 1 for y in x),
    "sum of parts": lambda x: sum(x) - 1,
    "length": lambda x: x - len(x),
}
HARMLESS = {  # what was recorded, and where its zero is
    "isinstance": (lambda x: x - 1 if not isinstance(x, Interval) else x + 1, 1),
    "type": (lambda x: x + 1 if type(x) in (Interval, IntervalArray) else x - 1, 1),
    "hasattr": (lambda x: x + 1 if hasattr(x, "inf") else x - 1, 1),
    "is": (lambda x: x + 1 if x is None else x - 1, 1),
    "text": (lambda x: x + 1 if str(x) == "1" else x - 1, 1),
    "loop": (lambda x: sum((x for _ in range(3)), 0) - 3, 1),
    "numpy": (lambda x: np.multiply(2, np.sqrt(x)) - 2, 1),
    "array": (lambda x: np.array([[1, 1]]) @ np.array([x, x]) - 2, 1),
}
SOLVERS = {
    "zeros": lambda f: zeros(f, BOX),
    "where": lambda f: zeros(lambda x: x - 1, BOX, where=f),
    "krawczyk": lambda f: krawczyk(f, [BOX]),
    "newton_system": lambda f: newton_system(f, [BOX]),
    "contract": lambda f: contract(f, BOX, [0]),
    "taylor": lambda f: taylor(f, BOX),
    "range_of": lambda f: range_of(f, BOX),
    "sign_of": lambda f: sign_of(f, BOX),
    "jet": lambda f: f(Jet(BOX, Interval(1))),
}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("kind", BRANCHES)
def test_a_function_that_branches_is_refused(kind, solver):
    """But the jets, which nobody records, may have the function go on: without a question."""
    if solver == "jet" and kind == "caught":
        return
    with pytest.raises(TypeError):
        SOLVERS[solver](BRANCHES[kind])


@pytest.mark.parametrize("kind", BRANCHES)
def test_the_refusal_says_what_to_do(kind):
    with pytest.raises(TypeError, match=r"minimum, maximum|not subscriptable|is a float"):
        Formula(BRANCHES[kind], 1)


@pytest.mark.parametrize("kind", HARMLESS)
def test_what_was_recorded_is_what_is_proved(kind):
    f, root = HARMLESS[kind]
    (result,) = zeros(f, BOX)
    assert result.outcome is Roots.UNIQUE and result.box[0].contains(root)


def test_a_recording_keeps_to_itself():
    kept = []
    Formula(lambda x: kept.append(x) or x, 1)
    for f, reason in (
        *((lambda x: x + kept[0], "another"), (Formula(lambda x, y: x + y, 2), "2 variables")),
        *((lambda x: x + 0.5, "float"), (lambda x: x.inf, "inf")),
    ):
        with pytest.raises(TypeError, match=reason):
            Formula(f, 1)
    with pytest.raises(NameError):  # a mistake of the user's own
        Formula(lambda x: x + undefined, 1)  # noqa: F821


def test_calls_happen_once():
    count = []
    assert zeros(lambda x: x - count.append(1) if count else x - 1, BOX) and not count
    (result,) = zeros(lambda x: [x - 1, count.append(1)][0], BOX)
    assert result.outcome is Roots.UNIQUE and len(count) == 1


# -- evaluation over number types ------------------------------------------------------------------

NUMBERS = st.integers(-3, 3) | st.fractions(-2, 2, max_denominator=7)
UNARY = ["sin", "cos", "exp", "atan", "sinh", "cosh", "tanh", "asinh", "__abs__", "__neg__"]
BINARY = [operator.add, operator.sub, operator.mul]


def trees(leaves):
    return st.recursive(
        leaves,
        lambda some: (
            st.tuples(st.sampled_from(UNARY), some)
            | st.tuples(st.sampled_from(BINARY), some, some)
            | st.tuples(st.just("power"), some, st.integers(0, 3))
        ),
        max_leaves=8,
    )


def evaluated(tree, x):
    if isinstance(tree, str):
        return x[int(tree)]
    if isinstance(tree, int | Fraction):
        return tree
    if tree[0] == "power":
        return evaluated(tree[1], x) ** tree[2]
    values = [evaluated(part, x) for part in tree[1:]]
    if callable(tree[0]):
        return tree[0](*values)
    return (
        getattr(intervals, tree[0], None)(*values)
        if tree[0][0] != "_"
        else (operator.neg if tree[0] == "__neg__" else abs)(*values)
    )


@for_all(trees(NUMBERS | st.sampled_from("01")), NUMBERS, NUMBERS, tries=200)
def test_every_number_type_encloses_the_same(tree, a, b):
    """A point by 200 bits lies in what arrays, jets, sets and boxes of the plane return."""
    try:
        (true,) = Formula(lambda *x: evaluated(tree, x), 2)(
            Interval(a, precision=200), Interval(b, precision=200)
        )
    except OverflowError:
        return
    f = Formula(lambda *x: evaluated(tree, x), 2)
    (coarse,) = f(Interval(a), Interval(b))
    assert coarse.contains(true)
    try:
        (array,) = f(IntervalArray([a]), IntervalArray([b]))
    except OverflowError:
        return
    assert array.contains(true).all()
    (decorated,) = f(Decorated(a), Decorated(b))
    assert decorated.inf <= true.inf and true.sup <= decorated.sup
    if "__abs__" not in str(tree) and not {"asinh", "atan"} & set(str(tree).split("'")):
        (box,) = f(ComplexInterval(a), ComplexInterval(b))
        assert box.contains(true)
    try:
        (jet,) = f(Jet.variable(Interval(a)), Jet.variable(Interval(b)))
    except intervals.DomainError:  # |x| at 0
        return
    assert jet.value.contains(true)


@for_all(expressions, points, points, st.sampled_from([0, Fraction(1, 9)]), tries=200)
def test_the_checker_reads_the_same_formula(text, a, b, width):
    """Its reader, tape and arithmetic share nothing with a recording of what Python reads."""
    names = {name: getattr(intervals, name) for name in FUNCTIONS}
    names |= {"pi": Interval.pi(precision=200)}
    names["number"] = lambda p, q: Interval(Fraction(p, q), precision=200)
    exact = re.sub(r"\((-?[0-9]+)/([0-9]+)\)", r"number(\1, \2)", text)
    box = [(a, a + width), (b, b + width)]
    outcomes = []
    for compute in (
        lambda: formula(text).values([Enclosure.of(*side, 200) for side in box])[0].range,
        lambda: ends_of(eval, exact, names, box),
    ):
        try:
            outcomes.append(compute())
        except (intervals.DomainError, ZeroDivisionError, OverflowError, Unproved, ValueError):
            outcomes.append(None)
    assume(None not in outcomes)
    (low, high), (bottom, top) = outcomes
    assert low <= top and bottom <= high
    assert width or max(high, top) - min(low, bottom) <= (1 + abs(top)) / 2**60


def ends_of(read, text, names, box):
    """The ends of a recorded text's values."""
    (value,) = Formula(lambda x, y: read(text, {**names, "x": x, "y": y}), 2)(
        *(Interval(*side, precision=200) for side in box)
    )
    return value.inf, value.sup
