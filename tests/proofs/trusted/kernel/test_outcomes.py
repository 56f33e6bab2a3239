"""What comes after launches: enclosures for ever against mpmath, lies, simulations at random."""

import json
import random
import re
from contextlib import suppress
from fractions import Fraction

import mpmath
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import on_tape
from proofs.trusted.kernel.tails import Ray, Rays
from proofs.trusted.kernel.trees import formula
from proofs.trusted.rules import find_rule
from tests.once import examples
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel.systems import BALL, FAR, RESTING
from tests.proofs.trusted.kernel.test_flight import CLOCK, clock, moving

# -- formulas at all later times -------------------------------------------------------------------

BITS, SINCE = 64, 3
NUMBERS = {name: getattr(mpmath, name) for name in ("sin", "cos", "atan", "sqrt", "log")}
LEAVES = st.sampled_from(["t", "t", "x", "2", "-3", "1/7", "0"])
FORMULAS = st.recursive(
    LEAVES,
    lambda parts: st.one_of(
        st.tuples(parts, st.sampled_from("+-*/"), parts).map(lambda p: f"({p[0]}) {p[1]} ({p[2]})"),
        st.tuples(st.sampled_from([*NUMBERS, "exp", "-"]), parts).map(lambda p: f"{p[0]}({p[1]})"),
        st.tuples(parts, st.sampled_from([-2, -1, 2, 3])).map(lambda p: f"({p[0]})**{p[1]}"),
    ),
    max_leaves=6,
)


class TooLargeError(ArithmeticError):
    """An argument of exp with which the reference takes too long."""


def exp(x):
    if abs(x) > 10**4:
        raise TooLargeError
    return mpmath.exp(x)


def value_of(text, x, time):
    """A formula by mpmath."""
    exact = re.sub(r"(?<![\w*])(\d+)", r"mpf(\1)", text)
    place = {"x": mpmath.mpf(x.numerator) / x.denominator, "t": mpmath.mpf(time)}
    return eval(exact, {**NUMBERS, "exp": exp, "mpf": mpmath.mpf}, place)


@settings(max_examples=examples(200, 500))
@given(FORMULAS, st.fractions(-4, 4, max_denominator=50), st.lists(st.integers(SINCE, 300)))
def test_formulas_are_enclosed_for_ever(text, x, times):
    functions = on_tape(tree := formula(text), variables=("x", "t"))
    inputs = [Ray.of(Enclosure.of(x, x, BITS)), Ray((0, SINCE << BITS), (1, 0))]
    try:
        (ray,) = functions.tape.evaluate(functions.roots, Rays(BITS), inputs)
    except Unproved:
        assume(False)
    for time in (SINCE, *times):
        with mpmath.workdps(60), suppress(TooLargeError):
            value = value_of(str(tree), x, time) * 2**BITS
            slip = abs(value) * mpmath.mpf(10) ** -30
            assert ray.lo[0] < 0 or value >= ray.lo[1] - slip
            assert ray.hi[0] > 0 or value <= ray.hi[1] + slip


def test_products_are_rounded_outward():
    """Of what is -2^-64 at the most and of 2^-64 each is -2^-128 at the most, and at least."""
    (low, high), unit = ((-1, 0), (0, -1)), Ray((0, 1), (0, 1))
    assert Rays(BITS).apply("*", [Ray(low, high), unit], Fraction(0)) == Ray(low, (0, 0))
    upward = Rays(BITS).apply("*", [Ray((0, -1), (1, 0)), unit], Fraction(0))
    assert upward == Ray((0, -1), (1, 0))


# -- what is false is refused ----------------------------------------------------------------------


def concluded(rule, data, **witness):
    context = Context(functions={"F": read_map("F", Reader(data), {})})
    listed = {key: json.loads(json.dumps(value)) for key, value in witness.items()}
    return find_rule(rule)(context, Reader({"function": "F", **listed}))


def ever(*gaps, box=(("0", "0"),), time="4", **fields):
    return "no-impact", clock(gaps=list(gaps), **fields), {"box": box, "tree": None, "time": time}


def press(data, *box):
    return "pressed", data, {"box": box, "tree": None}


def touch(*gaps, side=("-1/100", "1/100"), time=("3/4", "5/4")):
    return "graze", clock(gaps=list(gaps)), {"box": [side], "axis": "1", "time": time}


DECAY = moving("exp(-t)", "-y", "1", gaps=["y + 1"])
FREE = [("0", "0"), ("-1/10", "-1/10")]
TRUTHS = [
    ("a gap that grows", ever("1 + t"), "no further impact"),
    ("by its derivative", ever("1 + t**2 - t"), "no further impact"),
    ("from launch", ever("t"), "no further impact"),
    ("a bounded oscillation", ever("2 + sin(t)*cos(3*t)"), "no further impact"),
    ("a narrow one", ever("1 + sin(t/100)*cos(t) + t/10**9"), "no further impact"),
    ("a decay", ("no-impact", DECAY, ever()[2]), "no further impact"),
    ("of two walls", ever("1 + t", "2 - exp(-t)"), "and `2 - exp(-t)` > 0 at all"),
    ("into the wall", press(BALL, ("1", "1"), ("1/2", "1/2")), "as before an impact"),
    ("at rest", press(RESTING, ("-1", "1/2")), "as are its derivatives of orders below 2"),
    ("a graze", touch("(t - 1)**2 + x"), "After smaller `x` there the first impact"),
    ("on the other side", touch("(t - 1)**2 - x"), "After greater `x` there the first impact"),
]
LATER, NONE = "no impact later", "a gap is not proved > 0 up to the time"
LIES = [
    ("an impact soon", ever("3 - t"), NONE),
    ("an impact later", ever("5 - t"), LATER),
    ("an impact much later", ever("10**9 - t"), LATER),
    ("an impact of some", ever("2 + x*t", box=[("-1/1000", "1")]), LATER),
    ("another wall later", ever("1 + t", "9 - t"), LATER),
    ("an oscillation that is larger", ever("99/100 + sin(t/100)*cos(t)"), LATER),
    ("grazes for ever", ever("1 - cos(t)", time="6"), LATER),
    ("a graze now", ever("(t - 2)**2 + 0*x"), NONE),
    ("no bound above 0", ever("exp(-t)"), LATER),
    ("an oscillation that grows", ever("1 + t*sin(t)/10"), LATER),
    ("an undefined gap", ever("1 + t + 0*(1/(t - 50))"), "is not followed for ever"),
    ("the root of what is negative later", ever("1 + t + 0*sqrt(50 - t)"), "sqrt is not"),
    ("a motion that ends", ("no-impact", moving("1/(50 - t)", "1/(50 - t)**2", "1/50",
     gaps=["1 + t"]), ever()[2]), "is not followed for ever"),
    ("a launch into the wall", ever("-t"), "right after launch"),
    ("no time", ever("1 + t", time="0"), "a time between 0 and 1024"),
    ("a time too late", ever("1 + t", time="2000"), "a time between 0 and 1024"),
    ("a formula", ("no-impact", {"variables": ["x"], "values": ["x"]}, ever()[2]), "a flight is"),
    ("a launch", press(BALL, ("1", "1"), ("2", "2")), "not proved that no flight begins"),
    ("a launch of some", press(BALL, ("1", "1"), ("0", "2")), "that no flight begins"),
    ("neither", press(BALL, ("0", "0"), ("1", "1")), "not proved that no flight begins"),
    ("a table that falls away", press(RESTING, ("-1", "3/5")), "that no flight begins"),
    ("no wall", press(CLOCK, ("0", "0")), "do not start at one wall"),
    ("two walls", press(clock(gaps=["-t", "-2*t"]), ("0", "0")), "do not start at one wall"),
    ("no touch", touch("(t - 1)**2 + x + 1"), "touches 0"),
    ("a passage", touch("1 - t + x"), "not proved that a gap has one minimum"),
    ("a touch of all", touch("(t - 1)**2 + 0*x"), "one minimum"),
    ("a touch that turns back", touch("(t - 1)**2 + x**2 - 1/10000"), "one minimum"),
    ("a double touch", touch("((t - 1)**2 - 1/100)**2 + x/10**5"), "one minimum"),
    ("a flat touch", touch("(t - 1)**4 + x", side=("-1/1000", "1/1000")), "one minimum"),
    ("a touch from below", touch("x - (t - 1)**2"), "at launch"),
    ("an impact before", touch("((t - 1)**2 + x)*(t - 1/2)*(t - 1/4)*8"), NONE),
    ("a touch outside", touch("(t - 2)**2 + x", time=("3/4", "5/4")), "one minimum"),
    ("a touch of none in the side", touch("(t - 1)**2 + x", side=("1/200", "1/100")), "touches 0"),
    ("impacts alone", touch("(t - 1)**2 + x", side=("-1/50", "-1/1000"), time=("1/2", "17/10")),
     "touches 0"),
    ("nearly a touch", touch("(t - 1)**2 + x - 1/3 + 1/10**25", side=("1/3", "1/2")), "touches 0"),
    ("another wall before", touch("(t - 1)**2 + x", "1/2 - t"), NONE),
    ("another wall at once", touch("(t - 1)**2 + x", "(t - 1)**2 + x"), NONE),
    ("no axis", ("graze", CLOCK, {"box": FREE[:1], "axis": "2", "time": ["1", "2"]}), "from 1 to"),
    ("times that are one", touch("(t - 1)**2 + x", time=("1", "1")), "times between 0 and 1024"),
]  # fmt: skip


def test_a_graze_is_one_in_its_times():
    """Here x = 1/200 touches as well, but at t = 3."""
    rule, data, witness = touch("((t - 1)**2 + x)*((t - 3)**2 + x + 1/200)")
    assert "has a graze at a `t` in [0.75, 1.25]" in concluded(rule, data, **witness).sentence


@pytest.mark.every
@pytest.mark.parametrize(("case", "said"), [x[1:] for x in TRUTHS], ids=[x[0] for x in TRUTHS])
def test_truths(case, said):
    rule, data, witness = case
    conclusion = concluded(rule, data, **witness)
    assert said in conclusion.sentence
    assert oracle(conclusion, random.Random(said)) == []


@pytest.mark.every
@pytest.mark.parametrize(("case", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES])
def test_lies(case, reason):
    rule, data, witness = case
    with pytest.raises((Unproved, Malformed), match=reason) as caught:
        concluded(rule, data, **witness)
    assert len(str(caught.value).splitlines()) == 1


# -- against simulations ---------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_where_no_impact_is_proved_none_is_simulated(seed):
    """Walls and launches at random: some impacts are proved to be none, others are seen."""
    rng, proved = random.Random(seed), 0
    for _ in range(12):
        sides = (1.2, 2.5), (0, 6), (-1.5, -0.05)
        wall, phi, v = (Fraction(rng.uniform(*x)).limit_denominator(99) for x in sides)
        values = {"s": [str(wall)] * 2, "d": ["1/5", "1/5"]}
        data = {**FAR, "parameters": {**FAR["parameters"], **values}}
        box = [[str(phi)] * 2, [str(v), str(v + Fraction(1, 1000))]]
        with suppress(Unproved):
            conclusion = concluded("no-impact", data, box=box, tree=None, time="64")
            assert oracle(conclusion, rng) == []
            proved += 1
    assert proved > 0
