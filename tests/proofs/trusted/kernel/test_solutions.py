"""Expressions for unknowns: the lemmas hold with them, and nothing else is put in."""

import pytest

from proofs.methods.lemmas import witness_of
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.solutions import Expressions, implicit_derivative, solution
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import Equal, Series, equal
from proofs.trusted.paper.formulas import unknowns

SQUARE = {"left": "a**2 - b", "right": "0"}


def prove(expressions, *lemmas):
    witness = {"expressions": expressions, "lemmas": list(lemmas)}
    return solution(Context(), Reader(witness))


def test_what_is_proved():
    found = prove({"a": "x + 1", "b": "x**2 + 2*x + 1"}, SQUARE)
    assert found == Expressions(
        (("a", formula("x + 1")), ("b", formula("x**2 + 2*x + 1"))), (Equal.read("a**2 - b", "0"),)
    )
    assert found.sentence.startswith("With `a = x + 1`, `b = x**2 + 2*x + 1`: `a**2 - b = 0`")


def test_expressions_are_put_in_at_once():
    assert prove({"a": "x", "b": "x**2"}, {"left": "a*b", "right": "x**3"}, SQUARE)
    with pytest.raises(Unproved, match="no unknowns"):
        prove({"a": "b", "b": "a"}, {"left": "a - 2*b", "right": "a - 2*b"})


def test_series():
    lemma = {"function": "sin(a*h)", "variable": "h", "coefficients": ["0", "b"], "nonzero": []}
    found = prove({"a": "2*x", "b": "2*x"}, lemma)
    assert found.lemmas == (Series.read("sin(a*h)", "h", ("0", "b")),)
    with pytest.raises(Unproved):
        prove({"a": "2*x", "b": "x"}, lemma)
    with pytest.raises(Unproved, match="no coefficient"):
        prove({"a": "2*x", "b": "2*x + h"}, lemma)


SERIES = {"function": "sin(x) + 1", "variable": "x", "coefficients": ["1", "1"], "nonzero": []}


@pytest.mark.every
@pytest.mark.parametrize(
    ("expressions", "lemma"),
    [
        ({"a": "1", "b": "2"}, SQUARE),
        ({"a": "1, b=1"}, {"left": "a**2 - b", "right": "0"}),
        ({"a=1, b": "1"}, SQUARE),
        ({"a": "1", "b": "1)"}, SQUARE),
        ({"a": "1"}, {"left": "a**2, b=1", "right": "1"}),
        ({"a": "1"}, {"left": "a), (b", "right": "1"}),
        ({"A": "1", "b": "1"}, SQUARE),
        ({"pi": "3"}, {"left": "pi", "right": "3"}),
        ({}, {"left": "x", "right": "x"}),
        ({"a": "1/(x - x)"}, {"left": "a", "right": "a"}),
        ({"a": "1"}, {"left": "a", "right": "1", "note": "x"}),
        ({"a": "1"}, {"function": "a", "variable": "h"}),
        ({"a": "1"}, "a"),
        ({"x": "0"}, {**SERIES, "coefficients": ["1", "0"]}),
        ({"x": "2*x"}, SERIES),
        ({"a": "b", "b": "a"}, {"left": "a*b", "right": "b*a"}),
        ({"a": "x", "sin": "x"}, {"left": "a", "right": "x"}),
    ],
)
def test_what_is_refused(expressions, lemma):
    with pytest.raises((Unproved, Malformed)):
        prove(expressions, lemma)


def test_no_lemmas_prove_nothing():
    with pytest.raises(Malformed):
        prove({"a": "1"})


# -- what theorems ask for -------------------------------------------------------------------------

ASKED = unknowns("a b", "x", Equal.read("a**2 - b", "0"), nonzero=("x",))


def solved(expressions, asked=ASKED):
    places = tuple((name, formula(text)) for name, text in expressions.items())
    return asked.met_by(Expressions(places, asked.lemmas))


def test_expressions_have_no_other_variables_and_all_names():
    good = {"a": "x", "b": "x**2"}
    assert solved(good)
    assert not solved({"a": "y", "b": "y**2"})
    assert not solved({"b": "x**2", "a": "x"})
    assert not solved({"a": "x"})
    other = unknowns("a b", "x", Equal.read("a**2 + b", "0"), nonzero=("x",))
    assert solved(good, other) and not ASKED.met_by(
        Expressions(tuple((x, formula(y)) for x, y in good.items()), other.lemmas)
    )


@pytest.mark.parametrize(
    ("a", "b"),
    [
        ("sqrt(-1 - x**2)", "-1 - x**2"),  # nowhere real
        ("x*(x - 1)/(x - 1)", "x**2"),  # not at x = 1
        ("x + log(x) - log(x)", "x**2"),
    ],
)
def test_expressions_that_are_not_defined_everywhere_are_refused(a, b):
    first, *others = map(witness_of, ASKED.lemmas)
    assert prove({"a": "1/x", "b": "1/x**2"}, first, *others)
    assert prove({"a": a, "b": b}, *others)
    with pytest.raises(Unproved):
        prove({"a": a, "b": b}, first, *others)


# -- implicit derivatives --------------------------------------------------------------------------


def test_the_derivative_of_a_rotation_given_implicitly():
    """x1 + y1 = x - y and x1 - y1 = y + x, so x1 = x and y1 = -y."""
    equations = ("x1 + y1 - x + y", "x1 - y1 - y - x")
    asked = implicit_derivative(equations, ("x", "y"), ("x1", "y1"), ("1", "0", "0", "-1"))
    assert len(asked) == 4
    for text in asked:
        equal(Context(), Reader({"left": text, "right": "0"}))
    wrong = implicit_derivative(equations, ("x", "y"), ("x1", "y1"), ("1", "0", "0", "1"))
    with pytest.raises(Unproved):
        for text in wrong:
            equal(Context(), Reader({"left": text, "right": "0"}))
