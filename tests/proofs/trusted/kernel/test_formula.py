"""Formulas: reading, printing, enclosures and derivatives against Arb, and the limits."""

import json
from fractions import Fraction

import flint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import (
    Components,
    Enclosures,
    Exact,
    Work,
    attempts,
    decide,
    leaves,
)
from proofs.trusted.kernel.formula import Exhausted, read_formula
from tests.intervals.oracle import arb, ends

VARIABLES = ["x", "y"]


def formula(*expressions, variables=VARIABLES, name="F"):
    return read_formula(name, Reader({"variables": variables, "values": list(expressions)}))


def by_arb(expression, inputs):
    """The value of an expression, for Arb balls or power series: an evaluator of its own."""
    if isinstance(expression, str):
        return inputs[expression] if expression in inputs else lift(Fraction(expression), inputs)
    op, *parts = expression
    if op == "pi":
        return lift(flint.arb.pi(), inputs)
    if op == "^":
        return repeated(by_arb(parts[0], inputs), int(parts[1]))
    values = [by_arb(part, inputs) for part in parts]
    if len(values) == 1:
        return -values[0] if op == "-" else getattr(values[0], op)()
    total = values[0]
    for value in values[1:]:
        total = {
            "+": lambda a, b: a + b,
            "-": lambda a, b: a - b,
            "*": lambda a, b: a * b,
            "/": lambda a, b: a / b,
        }[op](total, value)
    return total


def repeated(x, n):
    """x^n by multiplication: Arb's own power is undefined on balls around 0."""
    product = x
    for _ in range(abs(n) - 1):
        product = product * x
    return product if n > 0 else 1 / product


def lift(value, inputs):
    ball = value if isinstance(value, flint.arb) else arb(value)
    like = next(iter(inputs.values()))
    return flint.arb_series([ball], like.prec) if isinstance(like, flint.arb_series) else ball


rationals = st.builds(
    lambda p, q: str(Fraction(p, q)), st.integers(-40, 40), st.sampled_from([1, 2, 3, 7, 10, 64])
)
leaf = st.sampled_from(["x", "y", "x", ["pi"]]) | rationals


def extend(inner):
    return st.one_of(
        st.tuples(st.sampled_from(["+", "-", "*", "/"]), inner, inner).map(list),
        st.tuples(st.sampled_from(["+", "*"]), inner, inner, inner).map(list),
        st.tuples(st.sampled_from(["-", "sqrt", "exp", "log", "sin", "cos"]), inner).map(list),
        st.tuples(
            st.just("^"), inner, st.sampled_from(["-3", "-2", "-1", "1", "2", "3", "4", "7"])
        ).map(list),
    )


expressions = st.recursive(leaf, extend, max_leaves=7)
points = st.fractions(-4, 4, max_denominator=50)
widths = st.sampled_from([Fraction(0), Fraction(1, 10**9), Fraction(1, 100), Fraction(1, 2)])


# -- enclosures ------------------------------------------------------------------------------------


def check_contains(enclosure, ball):
    """The enclosure of a box contains the value at a point of it, up to Arb's own radius."""
    if ball.is_finite():
        low, high = ends(ball)
        assert enclosure.range[0] <= high
        assert low <= enclosure.range[1]


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(expressions, points, points, widths, st.sampled_from([0, Fraction(1, 3), 1]))
def test_enclosures_contain_the_values(expression, x, y, width, share):
    read = formula(expression)
    box = ((x, x + width), (y, y + width))
    inside = {"x": x + share * width, "y": y + share * width}
    map_ = Components.of(read, Work())
    with flint.ctx.workprec(300):
        true = by_arb(expression, {name: arb(value) for name, value in inside.items()})
        for values in attempts(map_, box):
            assert true.is_finite() or not width
            check_contains(values[0], true)


@settings(max_examples=150, deadline=None)
@given(expressions, points, points, st.sampled_from([0, 1]))
def test_derivatives_contain_the_slopes(expression, x, y, variable):
    """Arb's power series in x, or in y, give the derivative without any symbolic rule."""
    read = formula(expression)
    with flint.ctx.workprec(400):
        inputs = {
            name: flint.arb_series([arb(value), arb(int(index == variable))], 2)
            for index, (name, value) in enumerate((("x", x), ("y", y)))
        }
        try:
            series = by_arb(expression, inputs)
        except (ValueError, ZeroDivisionError):
            return
        true = series[1]
        map_ = Components.of(read, Work())
        for bits in (64, 300):
            point = [Enclosure.of(value, value, bits) for value in (x, y)]
            try:
                row = map_.jacobian(point)[0]
            except Unproved:
                continue
            check_contains(row[variable], true)


@pytest.mark.parametrize(
    ("op", "low", "high", "true"),
    [
        ("sqrt", 0, 2, ("0", "1.41421356237309504880168872420969807")),
        ("exp", -50, 1, ("1.92874984796391778e-22", "2.71828182845904523536028747135266249")),
        ("log", "1/1000", 2, ("-6.907755278982137052", "0.69314718055994530941723212145818")),
        ("sin", 1, 4, ("-0.756802495307928251372639094511829", "1")),
        ("cos", 3, 4, ("-1", "-0.653643620863611914639168183097750")),
    ],
)
@pytest.mark.parametrize("bits", [64, 256])
def test_functions_are_tight_on_wide_intervals(op, low, high, true, bits):
    x = Enclosure.of(Fraction(low), Fraction(high), bits)
    found = Enclosures(bits).apply(op, [x], None).range
    for end, value in zip(found, map(Fraction, true), strict=True):
        assert abs(end - value) < Fraction(1, 10**15)
    assert found[0] <= Fraction(true[0]) + Fraction(1, 10**17)
    assert found[1] >= Fraction(true[1]) - Fraction(1, 10**17)


@pytest.mark.parametrize(
    ("low", "high", "n", "expected"),
    [
        (-1, 2, 2, (0, 4)),
        (-3, 2, 2, (0, 9)),
        (-3, -2, 2, (4, 9)),
        (-3, 2, 3, (-27, 8)),
        (-2, 0, 4, (0, 16)),
        (2, 4, -2, (Fraction(1, 16), Fraction(1, 4))),
        (-4, -2, -1, (Fraction(-1, 2), Fraction(-1, 4))),
        (-1, 1, 1000, (0, 1)),
    ],
)
def test_powers(low, high, n, expected):
    x = Enclosure.of(Fraction(low), Fraction(high), 64)
    found = Enclosures(64).apply("^", [x], Fraction(n)).range
    assert found[0] <= expected[0] and expected[1] <= found[1]
    assert expected[0] - found[0] + found[1] - expected[1] < Fraction(1, 10**15)


@pytest.mark.parametrize(
    ("expression", "box"),
    [
        (["/", "1", "x"], (-1, 1)),
        (["/", "1", "x"], (0, 1)),
        (["^", "x", "-2"], (-1, 1)),
        (["log", "x"], (0, 1)),
        (["log", "x"], (-2, -1)),
        (["sqrt", "x"], (-1, 1)),
        (["*", "0", ["sqrt", "x"]], (-2, -1)),
        (["exp", "x"], (63, 65)),
        (["^", "x", "1000"], (2, 2)),
        (["+", "x", "1" + "0" * 400], (0, 1)),
        (["-", ["/", "1", "x"], ["/", "1", "x"]], (-1, 1)),
    ],
)
def test_nothing_is_known_where_a_formula_is_not_defined_or_too_large(expression, box):
    read = formula(expression, variables=["x"])
    side = tuple(map(Fraction, box))
    assert list(attempts(Components.of(read, Work()), (side,))) == []


def test_a_derivative_needs_the_function():
    """d/dx (x + 0 sqrt(y)) = 1 is not used where sqrt(y) does not exist."""
    read = formula(["+", "x", ["*", "0", ["sqrt", "y"]]])
    map_ = Components.of(read, Work())
    one, below = (
        Enclosure.of(Fraction(1), Fraction(1), 64),
        Enclosure.of(Fraction(-1), Fraction(1), 64),
    )
    assert map_.jacobian([one, one])[0][0].range == (1, 1)
    with pytest.raises(Unproved):
        map_.jacobian([one, below])


def test_the_mean_value_form_and_more_bits_decide():
    """x - x^2 on a narrow box; 10^-40 beside a 64-bit unit."""
    narrow = ((Fraction("0.5"), Fraction("0.5001")),)
    flat = formula(["-", "x", ["*", "x", "x"]], variables=["x"])
    rest = Fraction(1, 4) + Fraction(1, 10**7)
    decide(Components.of(flat, Work()), narrow, lambda v: v[0].range[1] < rest)
    tiny = formula(["-", ["+", "1", ["^", "10", "-40"]], "1"], variables=["x"])
    decide(Components.of(tiny, Work()), ((Fraction(0), Fraction(0)),), lambda v: v[0].lo > 0)


# -- exact values ----------------------------------------------------------------------------------


def test_exact_values():
    expression = ["/", ["-", ["^", "x", "3"], ["*", "2/3", "y"]], ["+", "x", ["-", "y"]]]
    read = formula(expression)
    x, y = Fraction(2, 7), Fraction(-5, 3)
    found = read.tape.evaluate(read.roots, Exact(), (x, y))
    assert found == [(x**3 - Fraction(2, 3) * y) / (x - y)]


@pytest.mark.parametrize(
    "expression",
    [
        ["sin", "x"],
        ["pi"],
        ["/", "1", "x"],
        ["^", "x", "-1"],
        ["^", ["^", ["+", "x", "7"], "1000"], "1000"],
    ],
)
def test_no_exact_value(expression):
    read = formula(expression, variables=["x"])
    with pytest.raises(Unproved):
        read.tape.evaluate(read.roots, Exact(), (Fraction(0),))


# -- printing --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (["-", "x", ["-", "y", "1"]], "x - (y - 1)"),
        (["-", ["-", "x", "y"], "1"], "x - y - 1"),
        (["+", "x", "-3"], "x + (-3)"),
        (["*", ["+", "x", "1"], "y"], "(x + 1)*y"),
        (["/", "x", ["*", "y", "2"]], "x/(y*2)"),
        (["*", ["/", "x", "y"], "2"], "x/y*2"),
        (["*", "x", ["/", "y", "2"]], "x*(y/2)"),
        (["^", ["-", "x"], "2"], "(-x)^2"),
        (["-", ["^", "x", "2"]], "-x^2"),
        (["^", ["^", "x", "2"], "3"], "(x^2)^3"),
        (["^", "x", "-2"], "x^(-2)"),
        (["^", "-2", "2"], "(-2)^2"),
        (["^", "1/3", "2"], "(1/3)^2"),
        (["*", "7/5", "x"], "1.4*x"),
        (["*", "x", "1/3"], "x*(1/3)"),
        (["sin", ["*", "2", ["pi"]]], "sin(2*pi)"),
        (["-", ["-", "x"]], "-(-x)"),
        (["+", "x", "y", "1"], "x + y + 1"),
    ],
)
def test_infix(expression, text):
    assert formula(expression).texts == (text,)


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(expressions)
def test_infix_means_the_expression(expression):
    """Python reads the text, and Arb finds the value of the expression."""
    text = formula(expression).texts[0].replace("^", "**")
    names = {name: getattr(flint.arb, name) for name in ("sqrt", "exp", "log", "sin", "cos")}
    with flint.ctx.workprec(200):
        inputs = {"x": arb(Fraction(7, 5)), "y": arb(Fraction(-3, 8))}
        true = by_arb(expression, inputs)
        try:
            found = eval(wrapped(text), {**names, **inputs, "pi": flint.arb.pi(), "R": arb})
        except ZeroDivisionError:
            return
        assert not true.is_finite() or found.overlaps(true)


def wrapped(text):
    """Numbers as exact balls, exponents as ints."""
    import re

    return re.sub(
        r"(\*\*\(?-?\d+\)?)|(\d+(?:\.\d+)?)", lambda m: m[1] or f"R(Fraction('{m[2]}'))", text
    ).replace("Fraction(", "__import__('fractions').Fraction(")


# -- reading ---------------------------------------------------------------------------------------


def deep(n):
    expression = "x"
    for _ in range(n):
        expression = ["sin", expression]
    return expression


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("z", "unknown variable"),
        ("2/4", "lowest terms"),
        ("1.5", "canonical"),
        ("+1", "canonical"),
        ("-0", "lowest terms"),
        ("", "canonical"),
        ([], "entries"),
        (None, "list"),
        ({"+": "x"}, "list"),
        (["+"], "no operation"),
        (["+", "x"], "no operation"),
        (["-"], "no operation"),
        (["-", "x", "x", "x"], "no operation"),
        (["/", "x"], "no operation"),
        (["/", "x", "x", "x"], "no operation"),
        (["sin"], "no operation"),
        (["sin", "x", "x"], "no operation"),
        (["pi", "x"], "no operation"),
        (["tan", "x"], "no operation"),
        (["x", "x"], "no operation"),
        (["negative", "x"], "no operation"),
        (["number"], "no operation"),
        ([["+"], "x", "x"], "string"),
        (["^", "x"], "no operation"),
        (["^", "x", "y"], "canonical"),
        (["^", "x", "0"], "exponents"),
        (["^", "x", "1/2"], "exponents"),
        (["^", "x", "1001"], "exponents"),
        (["^", "x", "1000000000"], "exponents"),
        (["^", "x", "10^9"], "canonical"),
        (deep(60), "deep"),
        (["+", *(["x"] * 600)], "entries"),
        (["+", *([["*", str(i), "x"] for i in range(400)])], "operations"),
        (["+", *(f"{i}" + "7" * 2000 for i in range(1, 7))], "characters"),
    ],
)
def test_malformed_expressions(expression, message):
    with pytest.raises(Malformed, match=message) as caught:
        formula(expression)
    assert str(caught.value).startswith("$.values")


@pytest.mark.parametrize(
    ("name", "variables"),
    [
        ("f", ["x"]),
        ("F_1", ["x"]),
        ("N1", ["x"]),
        ("N", ["x"]),
        ("A", ["x"]),
        ("F-G", ["x"]),
        ("F" * 21, ["x"]),
        ("F", []),
        ("F", ["x", "x"]),
        ("F", ["X"]),
        ("F", ["x-y"]),
        ("F", ["pi"]),
        ("F", ["sin"]),
        ("F", ["e"]),
        ("F", ["1"]),
        ("F", ["x y"]),
        ("F", ["x\n"]),
        ("F", list("abcdfgh")),
    ],
)
def test_misleading_names_are_refused(name, variables):
    with pytest.raises(Malformed):
        formula("1", variables=variables, name=name)


def test_deep_enough():
    assert formula(deep(58)).texts[0].count("sin") == 58


# -- subdivision -----------------------------------------------------------------------------------

UNIT = ((Fraction(0), Fraction(1)), (Fraction(0), Fraction(1)))
trees = st.recursive(
    st.none(),
    lambda inner: st.tuples(
        st.sampled_from(["1", "2"]), st.sampled_from(["1/2", "1/3", "7/8"]), inner, inner
    ).map(list),
    max_leaves=12,
)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(trees, points, points)
def test_leaves_cover_the_box(tree, x, y):
    """Every point of the box is in a leaf, their areas sum to 1."""
    try:
        parts = list(leaves(Reader(tree), UNIT))
    except Malformed as error:
        assert "cut" in str(error)
        return
    area = sum(((b - a) * (d - c) for (a, b), (c, d) in parts), Fraction(0))
    assert area == 1
    x, y = abs(x) / 4, abs(y) / 4
    assert any(a <= x <= b and c <= y <= d for (a, b), (c, d) in parts)


@pytest.mark.parametrize(
    "tree",
    [
        ["0", "1/2", None, None],
        ["3", "1/2", None, None],
        ["1", "0", None, None],
        ["1", "1", None, None],
        ["1", "2", None, None],
        ["1", "1/2", None],
        ["1", "1/2", None, None, None],
        ["1", "1/2", ["1", "3/4", None, None], None],
        ["x", "1/2", None, None],
        "1",
        [],
        {},
    ],
)
def test_malformed_trees(tree):
    with pytest.raises(Malformed):
        list(leaves(Reader(tree), UNIT))


@pytest.mark.parametrize("depth", [59, 60, 61, 200])
def test_deep_trees_are_refused(depth):
    tree = None
    for k in reversed(range(depth)):
        tree = ["1", f"1/{2 ** (k + 1)}", tree, None]
    box = ((Fraction(0), Fraction(1)),)
    if depth <= 60:
        assert len(list(leaves(Reader(tree), box))) == depth + 1
        return
    with pytest.raises(Malformed, match="60 deep"):
        list(leaves(Reader(tree), box))


def test_work_is_counted():
    read = formula(["sin", "x"], variables=["x"])
    map_ = Components.of(read, Work(10_000))
    with pytest.raises(Exhausted):
        for _ in range(100):
            list(attempts(map_, ((Fraction(0), Fraction(1)),)))


def test_equal_subexpressions_are_stored_once():
    read = formula(["+", ["sin", "x"], ["*", ["sin", "x"], ["sin", "x"]]], variables=["x"])
    assert sum(node.op == "sin" for node in read.tape.nodes) == 1
    json.dumps(read.texts)
