"""Formulas: enclosures and derivatives against Arb, subdivision, names, limits."""

from fractions import Fraction

import flint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import attempts, decide, leaves
from proofs.trusted.kernel.head import read_function
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.kernel.operations import Enclosures
from tests.intervals.oracle import arb, ends
from tests.oracles.formulas import BITS, compiled


def formula(*texts, variables=("x", "y"), name="F"):
    return read_function(name, Reader({"variables": list(variables), "values": list(texts)}))


rationals = st.builds(
    lambda p, q: f"({p}/{q})", st.integers(-40, 40), st.sampled_from([1, 2, 3, 7, 10, 64])
)
FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "atan")
leaf = st.sampled_from(["x", "y", "x", "pi"]) | rationals


def extend(inner):
    return st.one_of(
        st.builds("({})*({})".format, inner, inner),
        st.builds("({})/({})".format, inner, inner),
        st.builds("({}) + ({})".format, inner, inner),
        st.builds("({}) - ({})".format, inner, inner),
        st.builds("-({})".format, inner),
        st.builds("{}({})".format, st.sampled_from(FUNCTIONS), inner),
        st.builds("({})**{}".format, inner, st.sampled_from([-3, -2, -1, 1, 2, 3, 4, 7])),
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
@settings(max_examples=150)
@given(expressions, points, points, widths, st.sampled_from([0, Fraction(1, 3), 1]))
def test_enclosures_contain_the_values(expression, x, y, width, share):
    read = formula(expression)
    box = ((x, x + width), (y, y + width))
    inside = {"x": x + share * width, "y": y + share * width}
    with flint.ctx.workprec(BITS):
        true = compiled(expression)[0]({name: arb(value) for name, value in inside.items()})
        for values in attempts(read, box):
            assert true.is_finite() or not width
            check_contains(values[0], true)


@pytest.mark.slow
@settings(max_examples=150)
@given(expressions, points, points, st.sampled_from([0, 1]))
def test_derivatives_contain_the_slopes(expression, x, y, variable):
    """Arb's power series in x, or in y, give the derivative without any symbolic rule."""
    read = formula(expression)
    with flint.ctx.workprec(400):
        series = [flint.arb_series([arb(value)], 2) for value in (x, y)]
        series[variable] += flint.arb_series([0, 1], 2)
        try:
            true = compiled(f"0*x + {expression}")[0](dict(zip("xy", series, strict=True)))[1]
        except (ValueError, ZeroDivisionError):
            return
        for bits in (64, 300):
            point = [Enclosure.of(value, value, bits) for value in (x, y)]
            try:
                row = read.jacobian(point)[0]
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
        ("atan", -1, 1000, ("-0.785398163397448309615660845819876", "1.56979632712822975256")),
    ],
)
@pytest.mark.parametrize("bits", [64, 256])
def test_functions_are_tight_on_wide_intervals(op, low, high, true, bits):
    x = Enclosure.of(Fraction(low), Fraction(high), bits)
    found = Enclosures(bits).apply(op, [x], Fraction(0)).range
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


@pytest.mark.every
@pytest.mark.parametrize(
    ("expression", "box"),
    [
        ("1/x", (-1, 1)),
        ("1/x", (0, 1)),
        ("x**-2", (-1, 1)),
        ("log(x)", (0, 1)),
        ("log(x)", (-2, -1)),
        ("sqrt(x)", (-1, 1)),
        ("0*sqrt(x)", (-2, -1)),
        ("exp(x)", (63, 65)),
        ("x**1000", (2, 2)),
        ("x + 1" + "0" * 400, (0, 1)),
        ("1/x - 1/x", (-1, 1)),
        ("x/0", (1, 2)),
        ("D(x + 0*sqrt(x), x)", (-1, 1)),
        ("D(x + 0*sqrt(x), x)", (0, 1)),
        ("D(x + 0*sqrt(-x**2), x)", (0, 0)),  # of a function that is defined at 0 alone
        ("D(x + sqrt(-x**2)*0, x)", (0, 0)),
    ],
)
def test_nothing_is_known_where_a_formula_is_not_defined_or_too_large(expression, box):
    read = formula(expression, variables=["x"])
    assert list(attempts(read, (tuple(map(Fraction, box)),))) == []


def test_a_derivative_needs_the_function():
    """d/dx (x + 0 sqrt(y)) = 1 is not used where sqrt(y) does not exist."""
    read = formula("x + 0*sqrt(y)")
    one, below = (
        Enclosure.of(Fraction(1), Fraction(1), 64),
        Enclosure.of(Fraction(-1), Fraction(1), 64),
    )
    assert read.jacobian([one, one])[0][0].range == (1, 1)
    with pytest.raises(Unproved):
        read.jacobian([one, below])


def test_the_mean_value_form_and_more_bits_decide():
    """x - x^2 on a narrow box; 10^-40 beside a 64-bit unit."""
    narrow = ((Fraction("0.5"), Fraction("0.5001")),)
    rest = Fraction(1, 4) + Fraction(1, 10**7)
    decide(formula("x - x*x", variables=["x"]), narrow, lambda v: v[0].range[1] < rest)
    tiny = formula("1 + 10**-40 - 1", variables=["x"])
    decide(tiny, ((Fraction(0), Fraction(0)),), lambda v: v[0].lo > 0)


# -- reading ---------------------------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    ("name", "variables"),
    [
        ("f", ["x"]),
        ("F_1", ["x"]),
        ("N1", ["x"]),
        ("N", ["x"]),
        ("A", ["x"]),
        ("F-G", ["x"]),
        ("the", ["x"]),
        ("T h", ["x"]),
        ("F`", ["x"]),
        ("F" * 21, ["x"]),
        ("F", []),
        ("F", ["x", "x"]),
        ("F", ["X"]),
        ("F", ["x-y"]),
        ("F", ["pi"]),
        ("F", ["sin"]),
        ("F", ["at"]),
        ("F", ["e"]),
        ("F", ["1"]),
        ("F", ["x y"]),
        ("F", ["x\n"]),
        ("F", [f"x{i}" for i in range(31)]),
    ],
)
def test_misleading_names_are_refused(name, variables):
    with pytest.raises(Malformed):
        formula("1", variables=variables, name=name)


def test_functions_declare_their_variables():
    with pytest.raises(Malformed, match="unknown variable"):
        formula("x + z")
    assert formula("x + y", "x*y").definition == "`F(x, y) = (x + y, x*y)`"
    assert formula("x", variables=["x"]).definition == "`F(x) = x`"


def test_other_names_are_all_substituted_away():
    given = formula("at(D(x*z**2, z), z=y)", "y")
    assert given.variables == ("x", "y") and given.trees[0].free == {"x", "y"}
    for text in ("at(x + z, x=y)", "at(D(x*z**2, z), x=y)", "at(D(z, z), z=x) + z"):
        with pytest.raises(Malformed, match="unknown variable 'z'"):
            formula(text)
    assert formula("at(x + Z, Z=y)").definition == "`F(x, y) = at(x + _1, _1=y)`"


@pytest.mark.slow
def test_derivatives_that_grow_are_refused_when_read():
    """Each derivative of a product is about twice as long."""
    product = "*".join(["sin(x)*exp(x**2)"] * 12)
    with pytest.raises(Malformed, match="too many operations"):
        formula("D(" + product + ", x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x)")


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
@settings(max_examples=100)
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
    read = formula("sin(x)", variables=["x"])
    with pytest.raises(Exhausted), metered(10_000):
        for _ in range(100):
            list(attempts(read, ((Fraction(0), Fraction(1)),)))


def test_equal_subexpressions_are_stored_once():
    read = formula("sin(x) + sin(x)*sin(x)", variables=["x"])
    assert sum(node.op == "sin" for node in read.tape.nodes) == 1
