"""All periodic orbits of a map in a box: published and closed counts, and what must be refused."""

import contextlib
import copy
import json
import random
from fractions import Fraction
from functools import cache
from itertools import combinations

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from intervals import Undecided
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.contractor import Contractor, Empty
from proofs.trusted.kernel.head import read_function
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.kernel.periodic import _meets, _require_apart
from proofs.trusted.verify import Rejected, check, premises
from tests.once import examples
from tests.proofs.methods.test_henon import CYCLES
from tests.proofs.trusted.kernel.lemma_examples import LOGISTIC, henon

HENON = henon("7/5", "3/10"), (("-1.43", "1.43"), ("-0.43", "0.43"))
CUBIC = (["x", "y"], ["y", "5*y - y**3 - x/5"]), (("-2.6", "2.6"), ("-2.6", "2.6"))
SHIFT = LOGISTIC, (("-1/10", "11/10"),)


@cache
def made(function, box, period):
    file = SymbolicLemmas({"F": function})
    file.periodic_orbits("F", period, box)
    return render(file.document())


def source(of, period):
    (variables, values), box = of
    return made((tuple(variables), tuple(values)), box, period)


def counts(text):
    (found,) = premises(text).known.values()
    return dict(found.counts)


def necklaces(symbols, period):
    """How many cycles of this least period a full shift has (Moebius)."""
    fixed = sum(
        sympy.functions.combinatorial.numbers.mobius(period // d) * symbols**d
        for d in sympy.divisors(period)
    )
    return int(fixed) // period


# -- what is true ----------------------------------------------------------------------------------


def of_galias(period):
    """His cycles are those in Henon's quadrilateral; the other fixed point is outside."""
    found = {d: CYCLES[d] + (d == 1) for d in sympy.divisors(period)}
    return {d: n for d, n in found.items() if n}


@pytest.mark.parametrize("period", [6, pytest.param(8, marks=pytest.mark.slow)])  # and so 1 to 4
def test_the_cycles_of_the_henon_map_are_as_many_as_published(period):
    assert counts(source(HENON, period)) == of_galias(period)


@pytest.mark.long
@pytest.mark.parametrize("period", [10, 12, 14, 18, 20])
def test_longer_cycles_of_the_henon_map(period):
    assert counts(source(HENON, period)) == of_galias(period)


@pytest.mark.parametrize(
    ("of", "symbols", "period"),
    [(SHIFT, 2, 4), (CUBIC, 3, 3), pytest.param(CUBIC, 3, 4, marks=pytest.mark.slow)],
)
def test_full_shifts_have_as_many_cycles_as_there_are_necklaces(of, symbols, period):
    assert counts(source(of, period)) == {d: necklaces(symbols, d) for d in sympy.divisors(period)}


def test_three_variables():
    of = (("x", "y", "z"), ("5*x*(1 - x)", "y/2 + z", "x/9 - z/3"))
    box = (("-1/10", "11/10"), ("-1", "1"), ("-1", "1"))
    assert counts(source((of, box), 3)) == {1: 2, 3: 2}


def test_a_box_without_orbits_and_maps_that_are_not_polynomials():
    assert counts(source((LOGISTIC, (("1/10", "7/10"),)), 1)) == {}
    assert counts(source(((("x",), ("exp(-x)",)), (("0", "1"),)), 2)) == {1: 1}
    of = ("x",), ("sqrt(x + 2)",)  # the root is not undone; 2 = sqrt 4
    assert counts(source((of, (("-1", "3"),)), 3)) == {1: 1}


def test_the_sentence():
    assert check(source(SHIFT, 2)).sentences == (
        "for `F(x) = 5*x*(1 - x)`: the periodic orbits whose points all have `x` in [-0.1, 1.1], "
        "and whose least period divides 2, are exactly these: 2 of least period 1, 1 of least "
        "period 2.",
    )
    assert check(source((LOGISTIC, (("1/10", "7/10"),)), 1)).sentences[0].endswith(": none.")


def closing(coefficients, period):
    """f^n(x) - x as a polynomial."""
    x = sympy.Symbol("x")
    f = sum(sympy.Rational(c, 8) * x**k for k, c in enumerate(coefficients))
    iterate = x
    for _ in range(period):
        iterate = f.subs(x, iterate)
    return sympy.Poly(iterate - x, x)


def compare(coefficients, period):
    """The periodic points that are found beside the real roots, by Sturm's sequences."""
    text = " + ".join(f"({c}/8)*x**{k}" if k else f"({c}/8)" for k, c in enumerate(coefficients))
    found = counts(source(((("x",), (text,)), (("-5/2", "3"),)), period))
    polynomial = closing(coefficients, period)
    roots = {root for root, _ in polynomial.intervals(eps=sympy.Rational(1, 10**12))}
    inside = [
        root
        for root in roots
        if all(-2.5 <= y <= 3 for y in images(coefficients, float(sum(root) / 2), period))
    ]
    assert sum(n * d for d, n in found.items()) == len(inside)


@settings(max_examples=examples(20))
@given(st.lists(st.integers(-12, 12), min_size=2, max_size=4), st.sampled_from([1, 2, 3]))
def test_periodic_points_of_polynomials_are_the_roots(coefficients, period):
    polynomial = closing(coefficients, period)
    assume(not polynomial.is_zero and polynomial.is_sqf)  # else there is a fold, or a continuum
    with contextlib.suppress(Undecided, Unproved):  # a point at an end
        compare(coefficients, period)


def images(coefficients, y, count):
    for _ in range(count):
        yield y
        y = sum(c / 8 * y**k for k, c in enumerate(coefficients))


# -- what must be refused --------------------------------------------------------------------------


def refused(of, period, edit, message, error=Rejected):
    document = json.loads(source(of, period))
    edit(document["steps"]["periodic-orbits-1"]["witness"])
    with pytest.raises(error, match=message):
        check(json.dumps(document))


@pytest.mark.parametrize("which", range(4))
def test_an_orbit_that_is_left_out(which):
    refused(HENON, 4, lambda w: w["orbits"].pop(which), "another periodic orbit")


def test_an_orbit_that_is_none():
    def moved(witness):
        witness["orbits"][0]["point"][0] = "1/5"

    refused(HENON, 4, moved, "Krawczyk")


def test_an_orbit_twice_or_by_another_of_its_points():
    refused(HENON, 4, lambda w: w["orbits"].append(w["orbits"][-1]), "different")

    def turned(witness):
        (x,) = map(Fraction, witness["orbits"][-1]["point"])
        other = {**copy.deepcopy(witness["orbits"][-1]), "point": [str(5 * x * (1 - x))]}
        witness["orbits"].append(other)

    refused(SHIFT, 2, turned, "different")


def test_a_fixed_point_as_a_cycle():
    def longer(witness):
        for orbit in witness["orbits"]:
            slope = 5 - 10 * Fraction(orbit["point"][0])
            orbit.update(period="2", matrix=[[str(1 / (slope**2 - 1))]])

    refused(SHIFT, 1, lambda w: (w.update(period="2"), longer(w)), "different")


@pytest.mark.parametrize(
    ("fields", "message", "error"),
    [
        ({"period": "2"}, "must divide", Malformed),
        ({"matrix": [["0", "0"], ["0", "0"]]}, "Krawczyk", Rejected),
        ({"matrix": [["1"]]}, None, Malformed),
        ({"point": ["1/2"]}, None, Malformed),
        ({"period": "0"}, "integer from", Malformed),
    ],
)
def test_false_parts_of_an_orbit(fields, message, error):
    refused(HENON, 3, lambda w: w["orbits"][0].update(fields), message, error)


@pytest.mark.parametrize(
    ("fields", "message", "error"),
    [
        ({"period": "12"}, "another periodic orbit", Rejected),
        ({"period": "101"}, "integer from", Malformed),
        ({"radius": "0"}, "positive", Malformed),
        ({"radius": "-1"}, "positive", Malformed),
        ({"radius": "1/2"}, "Krawczyk", Rejected),
        ({"box": [["-143/100", "63/100"], ["-43/100", "43/100"]]}, "in the box", Rejected),
        ({"box": [["-143/100", "143/100"]]}, None, Malformed),
        ({"box": [["-1", "-1"], ["0", "1"]]}, "positive", Malformed),
        ({"function": "G"}, "names no function", Malformed),
    ],
)
def test_false_parts_of_the_rest(fields, message, error):
    refused(HENON, 2, lambda w: w.update(fields), message, error)


def test_another_function():
    document = json.loads(source(HENON, 2))
    document["functions"]["F"]["values"] = ["1 - 7/5*x**2 + y"]
    with pytest.raises(Malformed, match="as many values"):
        check(json.dumps(document))
    document["functions"]["F"]["values"] = ["1 - 3/2*x**2 + y", "3/10*x"]
    with pytest.raises(Rejected, match="Krawczyk"):
        check(json.dumps(document))


@pytest.mark.parametrize("value", [pytest.param("x + x**2", marks=pytest.mark.long), "x"])
def test_points_that_are_not_isolated_or_not_simple(value):
    orbit = {"point": ["0"], "period": "1", "matrix": [["1"]]}
    witness = {"function": "F", "period": "1", "box": [["-1", "2"]], "radius": "1/1000"}
    document = json.loads(source(SHIFT, 1))
    document["functions"]["F"] = {"variables": ["x"], "values": [value]}
    for orbits, message in (([orbit], "Krawczyk"), ([], "another periodic orbit")):
        document["steps"]["periodic-orbits-1"]["witness"] = {**witness, "orbits": orbits}
        with pytest.raises(Rejected, match=message):
            check(json.dumps(document))


def test_boxes_are_apart_if_all_pairs_are():
    rng, seen = random.Random(4), set()
    for _ in range(200):
        ends = [[rng.randint(0, 12) for _ in range(2)] for _ in range(rng.randint(2, 4))]
        boxes = [[Enclosure(x, x + rng.randint(0, 3), 64) for x in low] for low in ends]
        apart = not any(_meets(*pair) for pair in combinations(boxes, 2))
        try:
            _require_apart(sorted(boxes, key=lambda box: box[0].lo))
            assert apart
        except Unproved:
            assert not apart
        seen.add(apart)
    assert seen == {True, False}


@pytest.mark.slow
def test_a_period_too_long_for_the_precision():
    refused(SHIFT, 1, lambda witness: witness.update(period="90"), "another periodic orbit")


def test_the_search_counts_its_work():
    with pytest.raises(Exhausted):
        check(source(HENON, 8), 50_000)


# -- cuts ------------------------------------------------------------------------------------------

FORMULAS = [
    ("1 - 7/5*x**2 + y", "3/10*x"),
    ("x*y", "x - y"),
    ("x*x", "x + x - y"),
    ("-x/(y + 3)", "y**2"),
    ("(x - y)**2", "x**3"),
    ("sqrt(x + 5)*sin(y)", "exp(x)/7"),
    ("1/x", "log(y + 1)"),
    ("y", "2"),
]
POINTS = st.fractions(-2, 2, max_denominator=64)


@given(
    st.sampled_from(FORMULAS), st.tuples(POINTS, POINTS), st.lists(POINTS, min_size=8, max_size=8)
)
def test_a_cut_loses_no_point_with_its_image(texts, point, widths):
    formula = read_function("F", Reader({"variables": ["x", "y"], "values": list(texts)}))
    exact = [Enclosure.of(x, x, 64) for x in point]
    try:
        image = formula.values(exact)
    except ArithmeticError:
        return
    reach = [abs(each) for each in widths]
    z = [Enclosure.of(x - a, x + b, 64) for x, a, b in zip(point, reach, reach[2:], strict=False)]
    w = [
        Enclosure(y.lo - int(a * 2**64), y.hi + int(b * 2**64), 64)
        for y, a, b in zip(image, reach[4:], reach[6:], strict=False)
    ]
    left, hit = Contractor(formula, 64).cut(z, w)
    for x, y in zip((*left, *hit), (*exact, *image), strict=True):
        assert x.lo <= y.hi and y.lo <= x.hi
    for x, y in zip((*left, *hit), (*z, *w), strict=True):
        assert y.lo <= x.lo and x.hi <= y.hi


def test_cuts_are_sharp():
    """x in [-2, 2] with 1 - x^2 in [-3, -1/4 - 1/5]: |x| >= sqrt(1.45); with 3 x in [1, 2]."""
    formula = read_function("F", Reader({"variables": ["x"], "values": ["1 - x**2", "3*x"]}))

    def box(low, high):
        return Enclosure.of(Fraction(low), Fraction(high), 64)

    (x,), _ = Contractor(formula, 64).cut([box(0, 2)], [box(-3, "-0.45"), box(-9, 9)])
    assert abs(float(x.range[0]) - 1.45**0.5) < 1e-15
    (x,), _ = Contractor(formula, 64).cut([box(-2, 2)], [box(-3, 3), box(1, 2)])
    assert [float(end) for end in x.range] == pytest.approx([1 / 3, 2 / 3], abs=1e-15)
    with pytest.raises(Empty):
        Contractor(formula, 64).cut([box(-2, 2)], [box(2, 3), box(-9, 9)])
