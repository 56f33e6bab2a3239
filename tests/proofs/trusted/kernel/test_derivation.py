"""Rules about formulas: textbook equations hold, false ones beside them do not, bad forms fail."""

from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.equation import Equal, Value
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.paper.formulas import Passage, at, corollary, derived_row, differ
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import find_rule
from proofs.trusted.verdicts import Verdict


def run(rule, **witness):
    with metered(1_000_000):
        return find_rule(rule)(Context(PAPER), Reader(witness))


def equal(left, right):
    return run("formula-equal", left=left, right=right)


def series(function, *coefficients, variable="x", nonzero=()):
    return run(
        "formula-series",
        function=function,
        variable=variable,
        coefficients=list(coefficients),
        nonzero=list(nonzero),
    )


def value(function, bounds, tree=None, **box):
    return run("formula-value", function=function, box=box, tree=tree, bounds=list(bounds))


TRUE = [
    ("(x + y)**2", "x**2 + 2*x*y + y**2"),
    ("sin(x + y)", "sin(x)*cos(y) + cos(x)*sin(y)"),
    ("cos(3*x)", "4*cos(x)**3 - 3*cos(x)"),
    ("1 - cos(x)", "2*sin(x/2)**2"),
    ("sin(x/2)*cos(x/3 - y)", "(sin(5*x/6 - y) + sin(x/6 + y))/2"),
    ("sin(w*(s + t)/v)", "sin(w*s/v)*cos(w*t/v) + cos(w*s/v)*sin(w*t/v)"),
    ("sin(x/(1 + y))*2*cos(x/(1 + y))", "sin(2*x/(y + 1))"),
    ("cos(0) + sin(0)", "1"),
    ("cos(x)**2 - sin(x)**2", "cos(-2*x)"),
    ("sqrt(x**2 + 1)**2", "1 + x*x"),
    ("D(x**3*sin(x), x)", "3*x**2*sin(x) + x**3*cos(x)"),
    ("D(x*y**2, y, x)", "2*y"),
    ("D(exp(2*x), x, x)", "4*exp(x*2)"),
    ("at(x - y, x=y, y=x)", "y - x"),
    ("at(D(sin(t)*x, t), t=0)", "x"),
    ("at(D(x**2, x), x=y**2)", "2*y**2"),
    ("D(at(x**2, x=y**2), y)", "4*y**3"),
    ("1/x - 1/(x + 1)", "1/(x*(x + 1))"),
    ("pi*x/pi", "x"),
    ("x**-2", "1/x/x"),
]
FALSE = [
    ("(x + y)**2", "x**2 + x*y + y**2"),
    ("sin(x + y)", "sin(x)*cos(y) - cos(x)*sin(y)"),
    ("cos(3*x)", "4*cos(x)**3 + 3*cos(x)"),
    ("1 - cos(x)", "2*sin(x)**2"),
    ("sin(x)", "cos(x)"),
    ("sin(2*x)", "2*sin(x)"),
    ("D(x**3*sin(x), x)", "3*x**2*sin(x) - x**3*cos(x)"),
    ("D(x*y**2, y)", "y**2"),
    ("at(x - y, x=y, y=x)", "0"),
    ("at(D(sin(t)*x, t), t=0)", "0"),
    ("D(at(x**2, x=y**2), y)", "2*y**2"),
    ("x", "y"),
    ("sin(2*pi)", "0"),  # true, but no normal form knows the zeros of the sine
    ("sqrt(x**2)", "x"),
    ("x/0", "x/0"),
    ("1/(x - x)", "1"),
]


@pytest.mark.parametrize(("left", "right"), TRUE)
def test_true_equations(left, right):
    assert equal(left, right) == Equal(left, right)


@pytest.mark.parametrize(("left", "right"), FALSE)
def test_false_equations(left, right):
    with pytest.raises(Unproved):
        equal(left, right)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x +",
        "f(x)",
        "x ^ 2",
        "x**y",
        "x**0",
        "x**65",
        "x**True",
        "True",
        "1.5",
        "1e3",
        "'x'",
        "x if y else x",
        "x < y",
        "+x",
        "x // 2",
        "x.y",
        "x[0]",
        "(x, y)",
        "[x]",
        "lambda: 1",
        "sin",
        "sin(x, y)",
        "sin(x=y)",
        "sin()",
        "D(x)",
        "D(x, y)",
        "D(x, 1)",
        "D(x**2, x + 1)",
        "D",
        "at(x)",
        "at(x, y)",
        "at(x, y=1)",
        "at(x, x=1, x=2)",
        "at(x, **y)",
        "(x := 2)",
        "__import__('os')",
        "µ",
        "x; y",
        "-" * 400 + "x",
        "(" * 300 + "x" + ")" * 300,
        "+".join(["x"] * 500),
        "x" * 13_000,
        "+".join(f"x{i}" for i in range(40)),
        "9" * 5000,
    ],
)
def test_what_is_no_formula(text):
    with pytest.raises(Malformed):
        equal(text, "1")


@pytest.mark.parametrize(
    "text",
    [
        "sin(99*x) + sin(x)",
        "sin(((x + 1)**40 + y)**9)",
        pytest.param("((x + y + z + 1)**60)**60", marks=pytest.mark.slow),
    ],
)
def test_too_much_work_is_no_proof(text):
    with pytest.raises((Unproved, Exhausted)):
        equal(text, f"{text} + 0*x")


def test_series():
    series("sin(x)/x", "1", "0", "-1/6", "0", "1/120")
    series("sin(x)/cos(x)", "0", "1", "0", "1/3", "0", "2/15")
    series("1/(1 - x)", "1", "1", "1", "1", "1")
    series("(1 - cos(a*x))/x**2", "a**2/2", "0", "-a**4/24")
    series("cos(a + x)", "cos(a)", "-sin(a)", "-cos(a)/2")
    series("x/(a*x + x**2)", "1/a", "-1/a**2", nonzero=["a"])
    series("1/(1 + e*cos(x))", "1/(1 + e)", "0", "e/(2*(1 + e)**2)", nonzero=["1 + e"])
    series("x/(2*a**2*b)", "0", "1/(2*a*a*b)", nonzero=["a", "b"])
    series("(sin(x) - x)/x**3", "-1/6", "0", "1/120")
    series("D(sin(x)/x, x)", "0", "-1/3")


@pytest.mark.parametrize(
    ("function", "coefficients", "nonzero"),
    [
        ("sin(x)/x", ["1", "1"], []),
        ("sin(x)/x", ["1", "0", "1/6"], []),
        ("1/x", ["0"], []),
        ("cos(x)/x", ["0"], []),
        ("1/(x*(x - x))", ["0"], []),
        ("x/(a*x + x**2)", ["1/a"], []),  # it is 1 - x + ... at a = 0
        ("x/(a*x + x**2)", ["1/a"], ["b"]),
        ("x/(a + b)", ["0", "1/(a + b)"], ["a", "b"]),
        ("1/(1 + e*cos(x))", ["1/(1 + e)"], ["e"]),
        ("x/(a + b)", ["0", "1/(a + b)"], ["a - b", "2*a + b"]),
        ("cos((sin(x) - x)/x**40)", ["1"], []),
        ("sin(1/x)", ["0"], []),
        ("sqrt(x)", ["0"], []),
        ("exp(x)", ["1"], []),
        ("log(1 + x)", ["0"], []),
        ("(sin(x) - x)/x**30", ["0"], []),
        ("x**2", ["0", "0", "0"], []),
    ],
)
def test_false_or_unfounded_series(function, coefficients, nonzero):
    with pytest.raises(Unproved):
        series(function, *coefficients, nonzero=nonzero)


def test_a_derivative_is_one_where_the_function_is_defined():
    hidden = "D(x + 0*sqrt(y), x)"
    value(hidden, ["1", "1"], x=["0", "1"], y=["1", "2"])
    value(f"at({hidden}, y=x)", ["1", "1"], x=["1", "2"])
    for function, y in ((hidden, ["-1", "2"]), (f"at({hidden}, y=y - 9)", ["1", "2"])):
        with pytest.raises(Unproved):
            value(function, ["1", "1"], x=["0", "1"], y=y)
    with pytest.raises(Unproved):
        series(hidden, "1")
    with pytest.raises(Malformed):
        value(hidden, ["1", "1"], x=["0", "1"])


def test_forms_of_series():
    for arguments in (
        {"variable": "y"},
        {"coefficients": ["x"]},
        {"coefficients": []},
        {"nonzero": ["x"]},
        {"coefficients": ["0"] * 13},
    ):
        witness = {"function": "x", "variable": "x", "coefficients": ["0"], "nonzero": []}
        with pytest.raises(Malformed):
            run("formula-series", **{**witness, **arguments})


def test_values():
    value("sin(x)/cos(x)", ["389/250", "779/500"], x=["1", "1"])
    value("x - y", ["1/2", "1/2"], y=["1/2", "1/2"], x=["1", "1"])
    value("at(x*a, a=y)", ["0", "1"], y=["0", "1"], x=["0", "1"])
    value("x*(1 - x)", ["0", "9/20"], x=["0", "1"], tree=["1", "1/2", None, None])


@pytest.mark.parametrize(
    ("function", "bounds", "box"),
    [
        ("sin(x)", ["0", "21/25"], {"x": ["1", "1"]}),
        ("sin(x)", ["17/20", "1"], {"x": ["1", "1"]}),
        ("1/x", ["-100", "100"], {"x": ["-1", "1"]}),
        ("sqrt(x)", ["0", "2"], {"x": ["-1", "1"]}),
        ("x*(1 - x)", ["0", "9/20"], {"x": ["0", "1"]}),  # true, and needs a tree
    ],
)
def test_false_values(function, bounds, box):
    with pytest.raises(Unproved):
        value(function, bounds, **box)


@pytest.mark.parametrize("box", [{}, {"y": ["0", "0"]}, {"x": ["0", "0"], "y": ["0", "0"]}])
def test_a_box_has_the_variables_of_the_function(box):
    with pytest.raises(Malformed):
        value("x", ["0", "1"], **box)


class TestDecisions:
    ASKED = (at("x - 1", 1, x="2"), differ("x", "2*x", x="3"))
    LEMMA = corollary("It begins.", Equal("x", "x"))
    THEOREM = corollary("It is in {0}. So {1} is not.", LEMMA, values=ASKED, reports=("first",))
    ROW = derived_row(Passage("S1", "1", "words"), "It is so.", Verdict.REFUTED, THEOREM)

    def found(self, **changes):
        one = {"function": "x - 1", "x": "2", "bounds": ("1/2", "3/2")} | changes
        box = (("x", (Fraction(one["x"]),) * 2),)
        bounds = tuple(map(Fraction, one["bounds"]))
        three = (("x", (Fraction(3),) * 2),)
        other = Value("(x) - (2*x)", three, (Fraction(-3), Fraction(-3)))
        return [Equal("x", "x"), Value(one["function"], box, bounds), other]

    def test_decides_by_the_tightest_bounds(self):
        wide = self.found(bounds=("1/3", "2"))
        decided = self.ROW.decide(PAPER, [*wide, *self.found()])
        assert decided.verdict is Verdict.REFUTED
        assert decided.why == "It is in [0.5, 1.5]"
        assert decided.witness == "It is in [0.5, 1.5]. So -3 is not."
        assert decided.quantities == {"first": (Fraction(1, 2), Fraction(3, 2))}

    @pytest.mark.parametrize(
        "changes",
        [
            {"function": "x - 2"},
            {"x": "5/2"},
            {"bounds": ("0", "3/2")},
            {"bounds": ("-3/2", "-1")},
        ],
    )
    def test_another_value_decides_nothing(self, changes):
        decided = self.ROW.decide(PAPER, self.found(**changes))
        assert decided.verdict is Verdict.UNDECIDED and decided.witness is decided.theorem is None

    def test_every_part_is_needed_of_what_is_nearby_too(self):
        beside = derived_row(
            Passage("S1", "1", "words"), "", Verdict.VERIFIED, self.LEMMA, corrected=(self.THEOREM,)
        )
        assert beside.needs == self.ROW.needs == (Equal("x", "x"), *self.ASKED)
        assert beside.decide(PAPER, self.found()).theorem.startswith("It is in")
        for index in range(3):
            found = self.found()
            del found[index]
            assert self.ROW.decide(PAPER, found).verdict is Verdict.UNDECIDED
            assert beside.decide(PAPER, found).verdict is Verdict.UNDECIDED
