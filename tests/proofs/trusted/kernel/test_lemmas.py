"""The rules about formulas: true witnesses are accepted and said in words, false ones refused.

Expectations are closed forms and hand-made functions; `lemma_examples` has the prover's files.
"""

import copy
import json
import os
import subprocess
import sys
import time
from fractions import Fraction
from math import isqrt
from pathlib import Path

import pytest
from proofs.trusted.kernel.lemma import RULES, check_lemma

from proofs.trusted.certificate import Malformed
from proofs.trusted.verify import Rejected
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

SCHEMA = "impact-proofs.lemma/1"
SQUARE = {"variables": ["x"], "values": [["-", ["^", "x", "2"], "2"]]}
PLANE = {"variables": ["x", "y"], "values": [["-", ["*", "x", "y"], "1"], ["-", "x", "y"]]}


def document(functions, rule, witness):
    return {
        "schema": SCHEMA,
        "functions": copy.deepcopy(functions),
        "steps": {"step": {"rule": rule, "witness": witness}},
        "claims": ["step"],
    }


def says(functions, rule, witness):
    return check_lemma(json.dumps(document(functions, rule, witness))).claims[0]


def on(box, **fields):
    return {"function": "F", "component": "1", "box": box, **fields}


def refused(functions, rule, witness, reason, error=Rejected):
    with pytest.raises(error, match=reason):
        says(functions, rule, witness)


# -- the examples ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_accepted(name):
    made = json.loads(text(name))
    report = check_lemma(text(name))
    assert len(report.claims) == len(made["claims"])
    for sentence in report.claims:
        assert sentence.startswith(("for ", "it is false that for "))


def brackets(name, words):
    """The numbers of the last interval in the sentences that contain some words."""
    found = [s for s in check_lemma(text(name)).claims if words in s]
    return [
        tuple(Fraction(end) for end in s.rpartition("[")[2].rstrip("]").split(", ")) for s in found
    ]


def test_the_roots_of_the_cubic():
    """x^3 - 3x + 1 at x = 2 cos(a) is 2 cos(3a) + 1: the roots are 2 cos(80, 40, 160 degrees)."""
    import flint

    with flint.ctx.workprec(200):
        roots = [2 * flint.arb.cos_pi_fmpq(flint.fmpq(k, 9)) for k in (8, 4, 2)]
        for (low, high), root in zip(brackets("cubic", "it lies in"), roots, strict=True):
            assert flint.arb(flint.fmpq(low.numerator, low.denominator)) < root
            assert root < flint.arb(flint.fmpq(high.numerator, high.denominator))
            assert high - low < Fraction(1, 10**11)


def test_the_fixed_points_of_the_henon_map():
    """1 - 1.4 x^2 + 0.3 x = x: x = (-7 +- sqrt(609)) / 28, in the two boxes."""
    root = Fraction(isqrt(609 * 10**40), 10**20)
    steps = json.loads(text("henon_fixed_points"))["steps"]
    for name, x in (("unique-zero-1", (root - 7) / 28), ("unique-zero-2", (-root - 7) / 28)):
        box = [[Fraction(end) for end in side] for side in steps[name]["witness"]["box"]]
        assert box[0][0] < x < box[0][1]
        assert box[1][0] < Fraction(3, 10) * x < box[1][1]


@pytest.mark.parametrize(("name", "growth"), [("logistic", "2"), ("henon_horseshoe", "2")])
def test_entropy_of_full_horseshoes(name, growth):
    ((low, high),) = brackets(name, "entropy")
    assert low < Fraction("0.69314718055994530941723212145818") < high
    assert any(f"log({growth})/1" in s for s in check_lemma(text(name)).claims)


def test_entropy_of_the_golden_mean():
    """The bounds log(L_p)/p come near log((1 + sqrt 5)/2) = 0.4812118250596 from below."""
    ((low, high),) = brackets("golden_mean", "entropy")
    assert Fraction("0.4812118") < low < high < Fraction("0.4812118250596035")


def test_sentences_in_full():
    assert says({"F": SQUARE}, "zero", {**zero_of("1", "2")}) == (
        "for F(x) = x^2 - 2 and x in [1, 2]: F has a zero"
    )
    witness = {"claim": on([["3/2", "2"]], sign="+"), "tree": None}
    assert says({"F": SQUARE}, "sign", witness) == "for F(x) = x^2 - 2 and x in [1.5, 2]: F > 0"
    witness = {"claim": on([["1", "2"], ["1/3", "1/3"]], sign="+", variable="x"), "tree": None}
    assert says({"F": PLANE}, "monotone", witness) == (
        "for F_1(x, y) = x*y - 1 and x in [1, 2], y = 1/3: F_1 is strictly increasing in x"
    )
    witness = {"rule": "sign", "claim": on([["0", "2"]], sign="+"), "point": ["1"]}
    assert says({"F": SQUARE}, "refute-at", witness) == (
        "it is false that for F(x) = x^2 - 2 and x in [0, 2]: F > 0; a witness is x = 1"
    )


# -- inequalities ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rule", "claim", "reason"),
    [
        ("sign", on([["1", "2"]], sign="+"), "not proved"),
        ("sign", on([["1", "7/5"]], sign="+"), "not proved"),
        ("sign", on([["3/2", "2"]], sign="-"), "not proved"),
        ("monotone", on([["-1", "1"]], variable="x", sign="+"), "not proved"),
        ("monotone", on([["0", "1"]], variable="x", sign="+"), "not proved"),
        ("monotone", on([["1", "2"]], variable="x", sign="-"), "not proved"),
        ("range", on([["0", "2"]], variable=None, bounds=["-2", "199/100"]), "not proved"),
        ("range", on([["0", "2"]], variable=None, bounds=["-199/100", "2"]), "not proved"),
        ("range", on([["0", "2"]], variable="x", bounds=["0", "399/100"]), "not proved"),
        (
            "expansion",
            {"function": "F", "interval": ["1", "2"], "bound": "2000000000001/1000000000000"},
            "not proved",
        ),
        ("expansion", {"function": "F", "interval": ["-2", "2"], "bound": "2"}, "not proved"),
    ],
)
def test_false_inequalities(rule, claim, reason):
    for tree in (None, ["1", "27/16", None, None]):
        if tree is None or Fraction(claim.get("interval", claim.get("box", [[0]])[0])[1]) > 1.8:
            refused({"F": SQUARE}, rule, {"claim": claim, "tree": tree}, reason)


@pytest.mark.parametrize(
    ("rule", "claim"),
    [
        ("sign", on([["71/50", "2"]], sign="+")),
        ("sign", on([["-7/5", "7/5"]], sign="-")),
        ("monotone", on([["1/1000", "1"]], variable="x", sign="+")),
        ("range", on([["0", "2"]], variable=None, bounds=["-2", "2"])),
        ("range", on([["0", "2"]], variable="x", bounds=["0", "4"])),
        ("expansion", {"function": "F", "interval": ["1", "2"], "bound": "2"}),
        ("expansion", {"function": "F", "interval": ["-2", "-1"], "bound": "2"}),
    ],
)
def test_true_inequalities(rule, claim):
    assert says({"F": SQUARE}, rule, {"claim": claim, "tree": None})


def test_a_sign_of_a_subdivision():
    """sin(x) - x/2 > 0 on [1/10, 18/10]: not as a whole, but in parts."""
    wave = {"F": {"variables": ["x"], "values": [["-", ["sin", "x"], ["/", "x", "2"]]]}}
    claim = on([["1/10", "9/5"]], sign="+")
    refused(wave, "sign", {"claim": claim, "tree": None}, "not proved")
    tree = ["1", "1", ["1", "1/2", None, None], ["1", "3/2", None, ["1", "17/10", None, None]]]
    assert says(wave, "sign", {"claim": claim, "tree": tree})
    wider = on([["1/10", "2"]], sign="+")
    refused(wave, "sign", {"claim": wider, "tree": tree}, r"not proved on \[1.7, 2\]")


def test_no_zero():
    witness = {"function": "F", "box": [["0", "1"], ["3/2", "2"]], "tree": None}
    assert says({"F": PLANE}, "no-zero", witness).endswith("F has no zero")
    witness["box"] = [["0", "1"], ["1", "2"]]
    refused({"F": PLANE}, "no-zero", witness, "not proved")


@pytest.mark.parametrize(
    ("rule", "claim", "points"),
    [
        ("sign", on([["0", "2"]], sign="+"), {"1": True, "0": True, "3/2": False, "2": False}),
        ("sign", on([["0", "2"]], sign="-"), {"1": False, "3/2": True}),
        ("monotone", on([["-1", "1"]], variable="x", sign="+"), {"-1": True, "0": False}),
        ("monotone", on([["-1", "1"]], variable="x", sign="-"), {"1/9": True, "-1": False}),
        (
            "range",
            on([["0", "2"]], variable=None, bounds=["-1", "2"]),
            {"0": True, "1": False, "2": False},
        ),
        (
            "expansion",
            {"function": "F", "interval": ["0", "2"], "bound": "2"},
            {"1/2": True, "1": False, "2": False},
        ),
    ],
)
def test_refutations(rule, claim, points):
    for point, holds in points.items():
        witness = {"rule": rule, "claim": claim, "point": [point]}
        if holds:
            assert says({"F": SQUARE}, "refute-at", witness)
        else:
            refused({"F": SQUARE}, "refute-at", witness, "not proved false")


def test_a_zero_refutes_a_strict_sign_exactly():
    """(3x - 1) > 0 fails at 1/3, which no binary number is."""
    line = {"F": {"variables": ["x"], "values": [["-", ["*", "3", "x"], "1"]]}}
    witness = {"rule": "sign", "claim": on([["0", "1"]], sign="+"), "point": ["1/3"]}
    assert says(line, "refute-at", witness)


def test_an_undecided_sign_refutes_nothing():
    """exp(x) - exp(x) + 10^-400 > 0 is true, and beyond every precision of the checker."""
    flat = ["+", ["-", ["exp", "x"], ["exp", "x"]], ["^", "1/10", "400"]]
    function = {"F": {"variables": ["x"], "values": [flat]}}
    for sign in "+-":
        claim = on([["0", "1"]], sign=sign)
        witness = {"rule": "sign", "claim": claim, "point": ["1/2"]}
        refused(function, "refute-at", witness, "not proved false")
        refused(function, "sign", {"claim": claim, "tree": None}, "not proved on")


def test_a_refutation_needs_a_point_of_the_box():
    witness = {"rule": "sign", "claim": on([["3/2", "2"]], sign="+"), "point": ["1"]}
    refused({"F": SQUARE}, "refute-at", witness, "not in the box", Malformed)


@pytest.mark.parametrize("point", [["1", "3"], ["3", "1"], ["-1", "1"], ["1", "-1"]])
def test_every_coordinate_lies_in_the_box(point):
    claim = on([["0", "2"], ["0", "2"]], sign="-")
    witness = {"rule": "sign", "claim": claim, "point": point}
    refused({"F": PLANE}, "refute-at", witness, "not in the box", Malformed)
    matrix = [["1/2", "1/2"], ["1/2", "-1/2"]]
    witness = {"function": "F", "box": claim["box"], "centre": point, "matrix": matrix}
    refused({"F": PLANE}, "unique-zero", witness, "centre", Malformed)


@pytest.mark.parametrize("bound", ["1", "1/2", "0", "-3"])
def test_expansion_is_by_more_than_1(bound):
    claim = {"function": "F", "interval": ["1", "2"], "bound": bound}
    refused({"F": SQUARE}, "expansion", {"claim": claim, "tree": None}, "above 1", Malformed)


def test_a_value_that_is_undefined_refutes_nothing():
    root = {"F": {"variables": ["x"], "values": [["-", ["sqrt", "x"], "5"]]}}
    witness = {"rule": "sign", "claim": on([["-2", "2"]], sign="+"), "point": ["-1"]}
    refused(root, "refute-at", witness, "not proved false")
    witness["point"] = ["2"]
    assert says(root, "refute-at", witness)


# -- zeros -----------------------------------------------------------------------------------------


def zero_of(low, high, tree=None):
    return {"function": "F", "component": "1", "interval": [low, high], "tree": tree}


def test_zero():
    assert says({"F": SQUARE}, "zero", zero_of("1", "3/2"))
    for low, high in (("3/2", "2"), ("0", "1"), ("-2", "2"), ("1", "1")):
        refused({"F": SQUARE}, "zero", zero_of(low, high), "same sign")


def test_a_zero_needs_a_continuous_function():
    """1/x changes sign without a zero; so does the tangent."""
    for values in ([["/", "1", "x"]], [["/", ["cos", "x"], ["sin", "x"]]]):
        pole = {"F": {"variables": ["x"], "values": values}}
        for tree in (None, ["1", "1/7", None, None]):
            refused(pole, "zero", zero_of("-1", "1", tree), "not proved on")


def test_an_end_that_is_a_zero_has_no_sign():
    line = {"F": {"variables": ["x"], "values": ["x"]}}
    refused(line, "zero", zero_of("0", "1"), "sign is not decided")


def test_unique_zero():
    """x y = 1, x = y: (1, 1), with the derivative ((y, x), (1, -1))."""
    witness = {
        "function": "F",
        "box": [["9/10", "11/10"], ["9/10", "11/10"]],
        "centre": ["1", "1"],
        "matrix": [["1/2", "1/2"], ["1/2", "-1/2"]],
    }
    assert says({"F": PLANE}, "unique-zero", witness).endswith("exactly one zero")
    wide = {**witness, "box": [["-2", "2"], ["-2", "2"]]}  # two zeros
    refused({"F": PLANE}, "unique-zero", wide, "Krawczyk")
    away = {**witness, "box": [["6/5", "7/5"], ["6/5", "7/5"]], "centre": ["6/5", "6/5"]}
    refused({"F": PLANE}, "unique-zero", away, "Krawczyk")
    edge = {**witness, "box": [["1", "11/10"], ["9/10", "11/10"]]}
    refused({"F": PLANE}, "unique-zero", edge, "Krawczyk")
    for matrix in (
        [["0", "0"], ["0", "0"]],
        [["1", "1"], ["1", "1"]],
        [["1/2", "1/2"], ["1/2", "1/2"]],
        [["-1/2", "-1/2"], ["-1/2", "1/2"]],
        [["1/2", "-1/2"], ["1/2", "1/2"]],
    ):
        refused({"F": PLANE}, "unique-zero", {**witness, "matrix": matrix}, "Krawczyk")
    refused({"F": PLANE}, "unique-zero", {**witness, "centre": ["2", "1"]}, "centre", Malformed)
    thin = {**witness, "box": [["1", "1"], ["1", "1"]]}
    refused({"F": PLANE}, "unique-zero", thin, "Krawczyk")


def test_a_double_zero_is_not_proved_unique():
    double = {"F": {"variables": ["x"], "values": [["^", "x", "2"]]}}
    for entry in ("1", "1000", "1/1000", "0"):
        witness = {"function": "F", "box": [["-1", "1"]], "centre": ["0"], "matrix": [[entry]]}
        refused(double, "unique-zero", witness, "Krawczyk")


def root_file(claim, bracket):
    made = document({"F": SQUARE}, "monotone", {"claim": claim, "tree": None})
    made["steps"]["bracket"] = {"rule": "root", "witness": {"monotone": "step", "bracket": bracket}}
    made["claims"] = ["bracket"]
    return json.dumps(made)


def test_root():
    rising = on([["1", "2"]], variable="x", sign="+")
    assert "lies in [1.4, 1.5]" in check_lemma(root_file(rising, ["7/5", "3/2"])).claims[0]
    for bracket, error in (
        (["1", "7/5"], Rejected),
        (["3/2", "2"], Rejected),
        (["3/2", "3/2"], Rejected),
        (["0", "3/2"], Malformed),
        (["7/5", "3"], Malformed),
        (["3/2", "7/5"], Malformed),
    ):
        with pytest.raises(error):
            check_lemma(root_file(rising, bracket))


# -- the form of the file --------------------------------------------------------------------------


def good():
    return document({"F": SQUARE}, "sign", {"claim": on([["3/2", "2"]], sign="+"), "tree": None})


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda d: d.update(schema="impact-proofs.lemma/2"), "schema"),
        (lambda d: d.update(note="x"), "unknown field"),
        (lambda d: d.pop("claims"), "missing field"),
        (lambda d: d.update(claims=[]), "entries"),
        (lambda d: d.update(claims=["nothing"]), "names no step"),
        (lambda d: d.update(claims=["step", "step"]), "twice"),
        (lambda d: d["functions"].update(G=SQUARE), "nothing uses: G"),
        (lambda d: d["steps"].update(other=d["steps"]["step"]), "nothing uses: other"),
        (lambda d: d["steps"].update(F=d["steps"]["step"]), "not named like"),
        (lambda d: d["steps"].update(sign=d["steps"]["step"]), "not named like"),
        (lambda d: d["steps"]["step"].update(rule="believe"), "unknown rule"),
        (lambda d: d["steps"]["step"].update(note="x"), "unknown field"),
        (lambda d: d["steps"]["step"]["witness"].update(note="x"), "unknown field"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(function="G"), "no function"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(component="0"), "integer"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(component="2"), "integer"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(component="1/2"), "integer"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(sign="1"), "expected"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(sign="-+"), "expected"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(box=[["2", "1"]]), "reversed"),
        (lambda d: d["steps"]["step"]["witness"]["claim"].update(box=[]), "entries"),
        (lambda d: d["steps"]["step"]["witness"].update(tree=[]), "entries"),
    ],
)
def test_malformed_files(edit, message):
    made = copy.deepcopy(good())
    edit(made)
    with pytest.raises(Malformed, match=message) as caught:
        check_lemma(json.dumps(made))
    assert str(caught.value).startswith("$")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("witness", [None, "1", [], {}, {"function": "F"}])
def test_malformed_witnesses(rule, witness):
    with pytest.raises(Malformed):
        says({"F": SQUARE}, rule, witness)


@pytest.mark.parametrize("rule", ["root", "graph", "entropy", "cone", "covers"])
def test_steps_name_earlier_steps_of_the_right_kind(rule):
    for name in ("step", "nothing", "F"):
        witness = {
            "root": {"monotone": name, "bracket": ["0", "1"]},
            "graph": {"covers": [name]},
            "entropy": {"graph": name, "length": "1", "vector": ["1"], "growth": "1"},
            "cone": {"graph": name, "forms": [], "relations": []},
            "covers": {
                "function": "F",
                "power": "1",
                "source": name,
                "target": name,
                "sign": "+",
                "left": None,
                "right": None,
                "support": None,
            },
        }[rule]
        refused({"F": SQUARE}, rule, witness, "names no earlier step", Malformed)


def test_steps_in_another_order_are_refused():
    made = json.loads(text("cubic"))
    made["steps"] = dict(reversed(made["steps"].items()))
    with pytest.raises(Malformed, match="names no earlier"):
        check_lemma(json.dumps(made))


# -- hostile files ---------------------------------------------------------------------------------


def polynomial_bomb():
    bomb = "x"
    for _ in range(4):
        bomb = ["^", ["+", bomb, "y", "1"], "1000"]
    function = {"variables": ["x", "y"], "values": [bomb, "x"]}
    return document(
        {"F": function},
        "identity",
        {"function": "F", "left": "1", "derivative": [], "right": "2"},
    )


def many_generators():
    terms = [["*", ["sin", ["/", str(k), "x"]], ["sqrt", ["+", "x", str(k)]]] for k in range(1, 60)]
    total = ["+", *terms]
    function = {"variables": ["x"], "values": [["^", total, "9"], "x"]}
    witness = {"function": "F", "left": "1", "derivative": ["x"], "right": "2"}
    return document({"F": function}, "identity", witness)


def deep_tree(depth):
    cuts = (f"{2 ** (k + 2) - 1}/{2 ** (k + 1)}" for k in reversed(range(depth)))
    tree = "".join(f'["1", "{cut}", ' for cut in cuts) + "null" + ", null]" * depth
    return json.dumps(good()).replace('"tree": null', f'"tree": {tree}')


def wide_tree(levels=14, expression=None):
    """A balanced tree of 2^levels leaves about an expression that costs much."""

    def grow(low, high, level):
        if level == 0:
            return None
        cut = (low + high) / 2
        return ["1", str(cut), grow(low, cut, level - 1), grow(cut, high, level - 1)]

    value = "x"
    for _ in range(50):
        value = ["sin", value]
    made = document(
        {"F": {"variables": ["x"], "values": [["+", value, "3"]]}},
        "sign",
        {"claim": on([["0", "1"]], sign="+"), "tree": grow(Fraction(0), Fraction(1), levels)},
    )
    return json.dumps(made)


def undecided_leaf():
    """Every precision is tried in vain; a sum of 200 sines, six variables."""
    names = list("uvwxyz")
    terms = [["sin", ["*", names[k % 6], names[k % 5], f"{k + 1}"]] for k in range(100)]
    difference = ["-", ["+", *terms], ["+", *terms]]
    box = [["0", "1"]] * 6
    function = {"variables": names, "values": [difference]}
    return json.dumps(document({"F": function}, "sign", {"claim": on(box, sign="+"), "tree": None}))


def long_sentences():
    made = good()
    made["functions"]["F"]["values"] = [
        ["+", *(["*", "x", f"1/{i}" + "7" * 800] for i in range(1, 12)), "x"]
    ]
    for index in range(300):
        made["steps"][f"s{index}"] = {
            "rule": "sign",
            "witness": {"claim": on([["1", "2"]], sign="+"), "tree": None},
        }
    made["steps"].pop("step")
    made["claims"] = list(made["steps"])
    return json.dumps(made)


def many_h_sets(count=3000):
    wave = ["+", "x", ["*", "1/10", ["sin", ["*", "2", ["pi"], "x"]]]]
    function = {"variables": ["x"], "values": [wave]}
    made = {"schema": SCHEMA, "functions": {"F": function}, "steps": {}}
    for index in range(count):
        made["steps"][f"n{index}"] = {
            "rule": "h-set",
            "witness": {"centre": [str(index)], "matrix": [[f"1/{10**20 + 7}"]]},
        }
        made["steps"][f"c{index}"] = {
            "rule": "covers",
            "witness": {
                "function": "F",
                "power": "1",
                "source": f"n{index}",
                "target": f"n{index}",
                "sign": "+",
                "left": None,
                "right": None,
                "support": None,
            },
        }
    made["steps"]["g"] = {"rule": "graph", "witness": {"covers": [f"c{i}" for i in range(count)]}}
    made["claims"] = ["g"]
    return json.dumps(made)


def wide_expression():
    made = json.dumps(good())
    return made.replace('["^", "x", "2"]', '["+"' + ', "x"' * 1_000_000 + "]").replace(
        '", "', '","'
    )


def huge_numbers():
    made = good()
    made["functions"]["F"]["values"] = [["^", ["^", ["^", "x", "1000"], "1000"], "1000"]]
    made["steps"]["step"] = {
        "rule": "refute-at",
        "witness": {"rule": "sign", "claim": on([["1", "3"]], sign="+"), "point": ["3/2"]},
    }
    return json.dumps(made)


def long_iterate():
    made = json.loads(text("second_iterate"))
    made["functions"]["F"]["values"] = [["*", "5", ["sin", ["sin", "x"]], ["-", "1", "x"]]]
    witness = next(s["witness"] for s in made["steps"].values() if s["rule"] == "covers")
    witness["power"] = "100"
    return json.dumps(made)


HOSTILE = {
    "polynomial bomb": lambda: json.dumps(polynomial_bomb()),
    "many generators": lambda: json.dumps(many_generators()),
    "deep tree": lambda: deep_tree(3000),
    "deep tree, parsed": lambda: deep_tree(200),
    "wide tree": wide_tree,
    "undecided leaf": undecided_leaf,
    "long sentences": long_sentences,
    "many h-sets": many_h_sets,
    "10^6 nodes": wide_expression,
    "huge numbers": huge_numbers,
    "long iterate": long_iterate,
}


SLOW = ("polynomial bomb", "many generators", "wide tree", "many h-sets", "long iterate")


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in HOSTILE],
)
def test_hostile_files_end(name):
    source = HOSTILE[name]()
    start = time.perf_counter()
    with pytest.raises((Malformed, Rejected)) as caught:
        check_lemma(source)
    assert time.perf_counter() - start < 10
    assert len(str(caught.value)) < 1000


# -- the checker alone -----------------------------------------------------------------------------

ROOT = Path(__file__).parents[4]
ALONE = """
import sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("numpy", "mpmath", "sympy", "flint", "intervals", "matplotlib"):
            raise ImportError("the checker must not import " + name)
        if name.startswith("proofs.methods"):
            raise ImportError("the checker must not import " + name)

sys.meta_path.insert(0, Refuse())
sys.path.insert(0, "")
from proofs.trusted.kernel.lemma import check_lemma
from proofs.trusted.verify import Rejected
for line in check_lemma(sys.stdin.read()).claims:
    print(line)
"""


def test_the_standard_library_is_enough():
    done = subprocess.run(
        [sys.executable, "-S", "-O", "-c", ALONE],
        cwd=ROOT,
        input=text("henon_horseshoe"),
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        env={key: value for key, value in os.environ.items() if key != "PYTHONPATH"},
    )
    assert done.stderr == ""
    assert "conjugate to the two-sided shift" in done.stdout
