"""What people type, and what the checker reads: the same function, or a sentence."""

import math
import random

import flint
import pytest

from proofs.methods.grammar import GrammarError, as_typed, canonical
from tests.oracles.formulas import compiled

TYPED = {
    "1 - 1.4*x^2 + y": "1 - 1.4*x**2 + y",
    "x^-1": "x**(-1)",
    "x^0.5": "sqrt(x)",
    "x^1.5": "x*sqrt(x)",
    "x^0": "1",
    "tan(x)": "sin(x)/cos(x)",
    "sin (x)": "sin(x)",
    "abs(x - 1)": "sqrt((x - 1)**2)",
    "atan(x)": "atan(x)",
    "cosh(x)": "(exp(x) + exp(-x))/2",
    "y'' + 2*y'": "D(y, t, t) + 2*D(y, t)",
    "1e-3*x + 1/4": "0.001*x + 1/4",
    "+x": "x",
    " x ": "x",
    ".5": "0.5",
    "0.00001*x^1.5": "0.00001*(x*sqrt(x))",
    "A*Sin2 + Omega''": "a_*sin2_ + D(omega_, t, t)",
    "lambda*x + Lambda": "lambda_*x + lambda__",
}
REFUSED = {
    "2x": "character 2 .* write \\* for a product",
    "x y": "character 3 .* write \\* for a product",
    "(x)(y)": "write \\* for a product",
    "f(x)": "functions are sqrt, exp",
    "arctan(x)": "write atan",
    "x (1 - x)": "write \\* for a product",
    "1e999999999": "unreasonable size",
    "1e300*x": "more than 190 digits",
    "x mod 1": "character 3 .* on a circle give the period",
    "floor(x)": "on a circle give the period",
    "max(x, 0)": "a map in pieces",
    "a_*x": "no name for a variable",
    "xOmega": "no name for a variable",
    "mod(x)": "period",
    "ln(x)": "write log",
    "x % 2": "character 3 .* on a circle give the period",
    "x = 3": "no equation",
    "sin(x": "not a formula",
    "": "empty",
    "x^y": "an exponent is a number",
    "x^(1/3)": "multiple of 1/2",
    "tan(x, y)": "one number",
    "é + 1": "character 1",
    "x.y": "character 2",
    "3 \u2212 x": "write -$",
    "3\u00d7x": "write \\*$",
    "x\u00b2": "character 2 .* write \\^2",
    "\u03bb*x": "the letters a to z and the digits alone, as in lambda",
    "y\u2019": "with a straight quote",
}


@pytest.mark.parametrize(("typed", "read"), TYPED.items())
def test_typed_and_read(typed, read):
    assert canonical(typed, "t") == read


@pytest.mark.parametrize(("typed", "reason"), REFUSED.items())
def test_what_is_no_formula_is_a_sentence(typed, reason):
    with pytest.raises(GrammarError, match=reason) as refused:
        canonical(typed)
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 250


@pytest.mark.parametrize("value", [1.5, 3, None])
def test_only_texts_are_formulas(value):
    with pytest.raises(GrammarError, match="a formula is a text"):
        canonical(value)


def test_primes_need_a_time():
    with pytest.raises(GrammarError, match="no time"):
        canonical("y'")


def grown(rng, depth):
    if depth == 0:
        return rng.choice(["x", "y", "0.5", "3", "1.25", "pi"])
    one, two = (grown(rng, depth - 1) for _ in range(2))
    pattern = rng.choice(
        ["({0})+{1}", "{0} - ({1})", "({0})*({1})", "-({0})", "({0})^2", "sin({0})", "tanh({0})"]
    )
    return pattern.format(one, two)


@pytest.mark.parametrize("seed", range(60))
def test_the_same_function(seed):
    typed = grown(random.Random(seed), 3)
    python = typed.replace("^", "**")
    names = {"x": 0.3, "y": -0.7, **{f: getattr(math, f) for f in ("sin", "tanh", "pi")}}
    function, _ = compiled(canonical(typed))
    value = float(function({"x": flint.arb("0.3"), "y": flint.arb("-0.7")}))
    assert value == pytest.approx(eval(python, {}, names), rel=1e-9, abs=1e-9)


def test_messages_have_what_was_typed():
    message = "-e*D(x, t) - D(y_, t, t) + omega_*f(x, t) is not 0, lambda_ is"
    assert as_typed(message) == "-e*x' - Y'' + Omega*f(x, t) is not 0, lambda is"
