"""Lemma files: true witnesses are accepted and said in words, false and hostile files refused.

Expectations are closed forms and hand-made functions; `lemma_examples` has the prover's files.
"""

import copy
import json
import time
from fractions import Fraction

import pytest

from proofs.trusted.certificate import SCHEMA, Malformed
from proofs.trusted.kernel.meter import DEFAULT, Exhausted
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.kernel.hostile import HOSTILE, source_of
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

PLANE = {"variables": ["x", "y"], "values": ["x*y - 1", "x - y"]}
SQUARE = "x**2 - 2"
QUICK = ("deep_tree", "undecided_leaves", "wide_cone")


def document(rule, witness, **functions):
    return {
        "schema": SCHEMA,
        "parameters": None,
        "functions": copy.deepcopy(functions),
        "steps": {"step": {"rule": rule, "witness": witness}},
        "claims": ["step"],
    }


def says(rule, witness, **functions):
    return check(json.dumps(document(rule, witness, **functions))).sentences[0]


def refused(rule, witness, reason, error=Rejected, **functions):
    with pytest.raises(error, match=reason):
        says(rule, witness, **functions)


def value(function, bounds, tree=None, **box):
    return {"function": function, "box": box, "tree": tree, "bounds": bounds}


# -- the examples ----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_accepted(name):
    report = check(text(name))
    assert len(report.sentences) == len(json.loads(text(name))["claims"])
    for sentence in report.sentences:
        assert sentence.endswith(".") and not sentence.endswith("..")


def brackets(name, words):
    """The numbers of the last interval in the sentences that contain some words."""
    found = [s for s in check(text(name)).sentences if words in s]
    return [
        tuple(Fraction(end) for end in s.split(words)[1].split("[")[1].split("]")[0].split(", "))
        for s in found
    ]


@pytest.mark.parametrize(("name", "growth"), [("logistic", "2"), ("henon_horseshoe", "2")])
def test_entropy_of_full_horseshoes(name, growth):
    ((low, high),) = brackets(name, "entropy")
    assert low < Fraction("0.69314718055994530941723212145818") < high
    assert any(f"at least log({growth}), which" in s for s in check(text(name)).sentences)


def test_a_form_with_both_signs_makes_a_two_sided_shift():
    assert any(
        "conjugate to the two-sided shift" in x for x in check(text("henon_horseshoe")).sentences
    )


def test_sentences_in_full():
    assert says("unique-zero", UNIQUE, F=PLANE) == (
        "for `F(x, y) = (x*y - 1, x - y)` and `x` in [0.9, 1.1], `y` in [0.9, 1.1]: "
        "`F` has exactly one zero."
    )


def test_a_sign_of_a_subdivision():
    """sin(x) - x/2 > 0 on [1/10, 18/10]: not as a whole, but in parts."""
    wave, bounds = "sin(x) - x/2", ["1/100", "1"]
    refused("formula-value", value(wave, bounds, x=["1/10", "9/5"]), "not proved")
    tree = ["1", "1", ["1", "1/2", None, None], ["1", "3/2", None, ["1", "17/10", None, None]]]
    assert says("formula-value", value(wave, bounds, tree, x=["1/10", "9/5"]))
    wider = value(wave, bounds, tree, x=["1/10", "2"])
    refused("formula-value", wider, r"not proved on \[1.7, 2\]")


# -- zeros -----------------------------------------------------------------------------------------


UNIQUE = {
    "function": "F",
    "box": [["9/10", "11/10"], ["9/10", "11/10"]],
    "centre": ["1", "1"],
    "matrix": [["1/2", "1/2"], ["1/2", "-1/2"]],
}


@pytest.mark.every
@pytest.mark.parametrize(
    "changes",
    [
        {"box": [["-2", "2"], ["-2", "2"]]},  # two zeros
        {"box": [["6/5", "7/5"], ["6/5", "7/5"]], "centre": ["6/5", "6/5"]},
        {"box": [["1", "11/10"], ["9/10", "11/10"]]},
        {"box": [["1", "1"], ["1", "1"]]},
        {"matrix": [["0", "0"], ["0", "0"]]},
        {"matrix": [["1", "1"], ["1", "1"]]},
        {"matrix": [["1/2", "1/2"], ["1/2", "1/2"]]},
        {"matrix": [["-1/2", "-1/2"], ["-1/2", "1/2"]]},
        {"matrix": [["1/2", "-1/2"], ["1/2", "1/2"]]},
    ],
)
def test_unique_zero(changes):
    """x y = 1, x = y: (1, 1), with the derivative ((y, x), (1, -1))."""
    assert says("unique-zero", UNIQUE, F=PLANE)
    refused("unique-zero", {**UNIQUE, **changes}, "Krawczyk", F=PLANE)


def test_a_double_zero_is_not_proved_unique():
    double = {"variables": ["x"], "values": ["x**2"]}
    for entry in ("1", "1000", "1/1000", "0"):
        witness = {"function": "F", "box": [["-1", "1"]], "centre": ["0"], "matrix": [[entry]]}
        refused("unique-zero", witness, "Krawczyk", F=double)


# -- arcs ------------------------------------------------------------------------------------------

CIRCLE = {"variables": ["x", "y"], "values": ["x**2 + y**2 - 1"]}
LEFT = {"box": [["-1/4", "0"], ["3/4", "21/20"]], "slope": ["0", "1/8"], "matrix": [["1/2"]]}
RIGHT = {"box": [["0", "1/4"], ["3/4", "21/20"]], "slope": ["0", "-1/8"], "matrix": [["1/2"]]}
TOP = {"box": [["0", "0"], ["9/10", "41/40"]], "matrix": [["1/2"]]}
ARC = {"function": "C", "axis": "x", "pieces": [LEFT, RIGHT], "points": [TOP]}
LOW = {"box": [["0", "1/4"], ["-21/20", "-3/4"]], "slope": ["0", "1/8"], "matrix": [["-1/2"]]}


def test_arc():
    """The circle over [-1/4, 1/4], on two slanted boxes; over [-3/5, 4/5] in the example."""
    assert "are the graph of a smooth function of `x` in [-0.25, 0.25]" in says(
        "arc", ARC, C=CIRCLE
    )
    for piece, ends in ((LEFT, "[-0.25, 0]"), (LOW, "[0, 0.25]")):
        alone = {**ARC, "pieces": [piece], "points": []}
        assert says("arc", alone, C=CIRCLE).endswith(f"a smooth function of `x` in {ends}.")


@pytest.mark.every
@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"pieces": [LEFT, LOW], "points": []}, "Krawczyk"),  # to the other half of the circle
        ({"pieces": [RIGHT, LEFT], "points": []}, "one after the other"),
        ({"pieces": [LEFT, {**RIGHT, "box": [["1/10", "1/4"], ["3/4", "21/20"]]}]}, "one after"),
        ({"pieces": [LEFT, {**RIGHT, "slope": ["1", "-1/8"]}]}, "along its axis"),
        ({"pieces": [LEFT, {**RIGHT, "slope": ["0", "5"]}]}, "Krawczyk"),
        ({"pieces": [LEFT, {**RIGHT, "matrix": [["-1/2"]]}]}, "Krawczyk"),
        ({"pieces": [LEFT, {**RIGHT, "matrix": [["0"]]}]}, "Krawczyk"),
        ({"pieces": [LEFT, {**RIGHT, "box": [["0", "1/4"], ["1", "21/20"]]}]}, "Krawczyk"),
        ({"pieces": [{**LEFT, "box": [["0", "0"], ["3/4", "21/20"]]}], "points": []}, "one after"),
        (
            {"pieces": [{**RIGHT, "box": [["0", "1"], ["-1", "2"]]}], "points": []},
            "Krawczyk",
        ),
        ({"pieces": [{**RIGHT, "box": [["0", "1/4"], ["-2", "2"]]}], "points": []}, "Krawczyk"),
        ({"points": [{**TOP, "box": [["0", "0"], ["-41/40", "-9/10"]]}]}, "not in a piece"),
        ({"points": [{**TOP, "box": [["0", "0"], ["9/10", "1"]]}]}, "Krawczyk"),
        ({"points": [{**TOP, "box": [["1/2", "1/2"], ["9/10", "41/40"]]}]}, "not in a piece"),
        ({"points": [{**TOP, "box": [["-1/9", "1/9"], ["9/10", "41/40"]]}]}, "not in a piece"),
    ],
)
def test_false_arcs(changes, reason):
    refused("arc", {**ARC, **changes}, reason, C=CIRCLE)


def test_a_slanted_box_is_looked_at_where_it_is():
    """y + y^3 = 2 x: at x = 1 y is 1, and not in 2 + [-1/10, 1/10]."""
    cubic = {"variables": ["x", "y"], "values": ["y - 2*x + y**3"]}
    box = [["-1", "1"], ["-1/10", "1/10"]]
    piece = {"box": box, "slope": ["0", "2"], "matrix": [["1"]]}
    witness = {"function": "F", "axis": "x", "pieces": [piece], "points": []}
    refused("arc", witness, "Krawczyk", F=cubic)


@pytest.mark.parametrize("axis", ["z", "C", ""])
def test_the_axis_is_a_variable(axis):
    refused("arc", {**ARC, "axis": axis}, "variable", Malformed, C=CIRCLE)


# -- the form of the file --------------------------------------------------------------------------


def good():
    return document("formula-value", value(SQUARE, ["1/4", "2"], x=["3/2", "2"]))


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda d: d["functions"].update(G=PLANE), "nothing uses: G"),
        (lambda d: d["steps"].update({"unique-zero": d["steps"]["step"]}), "not named like"),
        (
            lambda d: d.update(functions={"F": PLANE}, steps={"F": d["steps"]["step"]}),
            "not named like",
        ),
    ],
)
def test_malformed_files(edit, message):
    made = good()
    edit(made)
    with pytest.raises(Malformed, match=message):
        check(json.dumps(made))


# -- hostile files ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (name not in QUICK)) for name in HOSTILE]
)
@pytest.mark.parametrize("part", [20, pytest.param(1, marks=pytest.mark.long)])
def test_hostile_files_end(name, part):
    """Within a part of the work that a check is given, and of the time."""
    source = source_of(name)
    start = time.process_time()
    try:
        check(source, DEFAULT / part)
    except (Malformed, Rejected, Exhausted) as error:
        assert len(str(error)) < 1000
    assert time.process_time() - start < 30 / part
