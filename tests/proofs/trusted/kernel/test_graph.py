"""Covering relations, graphs, entropy, cones: true ones against Arb, false ones refused."""

import json
import random
from fractions import Fraction
from itertools import combinations, pairwise, product

import flint
import numpy as np
import pytest

from intervals import Undecided
from proofs.methods.lemmas import inverse
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import SCHEMA, Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.covers import HSet, disjoint
from proofs.trusted.kernel.graph import _require_disjoint
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.kernel.lemma_examples import text


def file(name):
    return json.loads(text(name))


def refused(document, reason, error=Rejected):
    with pytest.raises(error, match=reason):
        check(json.dumps(document))


def witness_of(document, rule, index=0):
    return [s["witness"] for s in document["steps"].values() if s["rule"] == rule][index]


def only(document, *claims):
    """Keep the claims named, and the steps that they need."""
    reached = set(claims)
    for name, step in reversed(document["steps"].items()):
        if name in reached:
            reached |= set(json.dumps(step["witness"]).split('"'))
    document["claims"] = list(claims)
    document["steps"] = {n: s for n, s in document["steps"].items() if n in reached}
    return document


# -- h-sets ----------------------------------------------------------------------------------------


def h(centre, matrix):
    rows = tuple(tuple(map(Fraction, row)) for row in matrix)
    return HSet(tuple(map(Fraction, centre)), rows, inverse(rows))


def test_inverse():
    rng = random.Random(1)
    for n in (1, 2, 3, 4):
        for _ in range(20):
            a = tuple(tuple(Fraction(rng.randint(-3, 3)) for _ in range(n)) for _ in range(n))
            true = flint.fmpq_mat(n, n, [flint.fmpq(int(x)) for row in a for x in row])
            if true.det() == 0:
                with pytest.raises(Undecided, match="singular"):
                    inverse(a)
                continue
            found = [x for row in inverse(a) for x in row]
            assert [Fraction(int(x.p), int(x.q)) for x in true.inv().entries()] == found


def corners(one):
    n = len(one.centre)
    for q in product((-1, 1), repeat=n):
        yield [
            c + sum(a * x for a, x in zip(row, q, strict=True))
            for c, row in zip(one.centre, one.matrix, strict=True)
        ]


def clip(polygon, normal, bound):
    """The part of a convex polygon with normal . x <= bound."""
    result = []
    for p, q in pairwise([*polygon, polygon[0]]):
        a, b = (sum(n * x for n, x in zip(normal, v, strict=True)) - bound for v in (p, q))
        if a <= 0:
            result.append(p)
        if a * b < 0:
            result.append([x + (y - x) * a / (a - b) for x, y in zip(p, q, strict=True)])
    return result


def meets(one, two):
    """Whether two parallelograms meet: exact clipping of the first by the sides of the second."""
    (a, b, c, d) = corners(one)
    polygon = [a, b, d, c]
    for row in two.inverse:
        middle = sum(x * y for x, y in zip(row, two.centre, strict=True))
        for sign in (1, -1):
            if not polygon:
                return False
            polygon = clip(polygon, [sign * x for x in row], sign * middle + 1)
    return bool(polygon)


@pytest.mark.slow
def test_disjoint_parallelograms():
    rng = random.Random(2)
    outcomes = set()
    for _ in range(400):
        pair = []
        while len(pair) < 2:
            matrix = [[Fraction(rng.randint(-4, 4), 3) for _ in range(2)] for _ in range(2)]
            centre = [Fraction(rng.randint(-6, 6), 2) for _ in range(2)]
            if matrix[0][0] * matrix[1][1] != matrix[0][1] * matrix[1][0]:
                pair.append(h(centre, matrix))
        assert disjoint(*pair) is not meets(*pair)
        assert disjoint(*pair) is disjoint(*pair[::-1])
        outcomes.add(disjoint(*pair))
    assert outcomes == {True, False}


def test_touching_sets_are_not_disjoint():
    one, two = h([0, 0], [[1, 0], [0, 1]]), h([2, 0], [[1, 0], [0, 1]])
    assert not disjoint(one, two)
    assert disjoint(one, h([Fraction(2000001, 1000000), 0], [[1, 0], [0, 1]]))


def accepted(nodes):
    try:
        _require_disjoint(nodes)
    except Unproved:
        return False
    return True


def test_families_are_disjoint_if_all_pairs_are():
    """Squares of the side 2/5 on a lattice, in any order; neighbours on it touch at 2/5."""
    rng = random.Random(7)
    outcomes = []
    for _ in range(300):
        step = Fraction(rng.choice([2, 3]), 5)
        nodes = [
            h(
                [step * rng.randint(0, 5), step * rng.randint(0, 5)],
                [[Fraction(1, 5), 0], [0, Fraction(1, 5)]],
            )
            for _ in range(rng.randint(2, 4))
        ]
        pairs = [disjoint(*pair) for pair in combinations(nodes, 2)]
        assert accepted(nodes) is all(pairs)
        outcomes.append(all(pairs))
    assert 50 < sum(outcomes) < 250


# -- covers ----------------------------------------------------------------------------------------


def interval(centre, radius):
    matrix, inverse_of = [[radius]], [[str(1 / Fraction(radius))]] if radius != "0" else [["0"]]
    return {"centre": [centre], "matrix": matrix, "inverse": inverse_of}


def interval_file(expression, source, target, sign="+", power="1", trees=None):
    """One covering relation of intervals (centre, radius)."""
    trees = trees or {}
    steps = {
        name: {"rule": "h-set", "witness": interval(centre, radius)}
        for name, (centre, radius) in {"one": source, "two": target}.items()
    }
    witness = {
        "function": "F",
        "power": power,
        "source": "one",
        "target": "two",
        "sign": sign,
        "left": None,
        "right": None,
        "support": None,
        **trees,
    }
    return {
        "schema": SCHEMA,
        "parameters": None,
        "functions": {"F": {"variables": ["x"], "values": [expression]}},
        "steps": {**steps, "step": {"rule": "covers", "witness": witness}},
        "claims": ["step"],
    }


TRIPLE = "3*x"
UNIT = ("0", "1")
SQUARE = [["1", "0"], ["0", "1"]]


def test_covers_of_intervals():
    assert check(json.dumps(interval_file(TRIPLE, UNIT, UNIT)))
    assert check(json.dumps(interval_file(TRIPLE, UNIT, ("1", "19/10"))))
    assert check(json.dumps(interval_file("-3*x", UNIT, UNIT, "-")))
    assert check(json.dumps(interval_file(TRIPLE, UNIT, ("0", "26"), power="3")))
    assert check(json.dumps(interval_file(TRIPLE, UNIT, ("0", "-1"), "-")))


@pytest.mark.every
@pytest.mark.parametrize(
    "changed",
    [
        interval_file(TRIPLE, UNIT, UNIT, "-"),
        interval_file("-3*x", UNIT, UNIT),
        interval_file("x", UNIT, UNIT),
        interval_file(TRIPLE, UNIT, ("0", "3")),
        interval_file(TRIPLE, UNIT, ("1", "2")),
        interval_file(TRIPLE, UNIT, ("0", "27"), power="3"),
        interval_file(TRIPLE, UNIT, ("0", "26"), power="2"),
        interval_file("x**2", ("0", "2"), UNIT),
        interval_file("x**2", ("0", "2"), UNIT, "-"),
        interval_file("-1/x", ("0", "1/4"), UNIT, "-"),
        interval_file("1/x", ("0", "1/4"), UNIT, "+"),
        interval_file(TRIPLE, UNIT, ("0", "-1")),
    ],
)
def test_false_covers(changed):
    """Wrong orientation, too short, exactly on the end, folded, or broken by a pole."""
    refused(changed, "not proved")


@pytest.mark.every
@pytest.mark.parametrize(
    ("matrix", "inverse_of"),
    [
        ([["1", "1"], ["0", "1"]], [["1", "-1"], ["0", "1"]]),
        ([["1", "1"], ["0", "1"]], [["1", "0"], ["-1", "1"]]),
        ([["1", "1"], ["0", "1"]], [["1", "1"], ["0", "1"]]),
        ([["1", "2"], ["2", "4"]], [["1", "2"], ["2", "4"]]),
        ([["2", "0"], ["0", "1/2"]], [["2", "0"], ["0", "1/2"]]),
        ([["1", "1"], ["0", "1"]], [["1", "-1"], ["0", "2"]]),
        ([["1", "1"], ["0", "1"]], [["1", "-1"], ["1", "1"]]),
    ],
)
def test_the_inverse_is_the_inverse(matrix, inverse_of):
    changed = interval_file(TRIPLE, UNIT, UNIT)
    witness_of(changed, "h-set").update(centre=["0", "0"], matrix=matrix, inverse=inverse_of)
    true = inverse_of == [["1", "-1"], ["0", "1"]]
    refused(changed, "one dimension" if true else "inverse", Malformed if true else Rejected)


def plane_file(expressions, support=None):
    document = interval_file("x", UNIT, UNIT, trees={"support": support})
    document["functions"]["F"] = {"variables": ["x", "y"], "values": expressions}
    for index in (0, 1):
        witness_of(document, "h-set", index).update(
            centre=["0", "0"], matrix=SQUARE, inverse=SQUARE
        )
    return json.dumps(document)


def test_the_stable_direction_must_stay_inside():
    assert check(plane_file(["2*x", "1/2*y"]))
    with pytest.raises(Rejected, match="not proved"):
        check(plane_file(["2*x", "y"]))
    with pytest.raises(Rejected, match="not proved"):
        check(plane_file(["x", "1/2*y"]))
    with pytest.raises(Rejected, match="not proved"):
        check(plane_file(["1/2*y", "2*x"]))
    for shift in ("+ 3/5", "- 3/5"):
        with pytest.raises(Rejected, match="not proved"):
            check(plane_file(["2*x", f"1/2*y {shift}"]))


def test_the_stable_direction_is_free_beyond_the_exits():
    """y -> x^4: leaves the strip only where |2 x| > 1."""
    cuts = ["1", "-3/5", None, ["1", "3/5", None, None]]
    expressions = ["2*x", "(11/10*x)**4"]
    assert check(plane_file(expressions, cuts))
    with pytest.raises(Rejected, match="not proved"):
        check(plane_file(expressions))
    higher = ["2*x", "(21/10*x)**4"]
    with pytest.raises(Rejected, match="not proved"):
        check(plane_file(higher, cuts))


# -- graphs and entropy ----------------------------------------------------------------------------


def test_relations_of_another_power_make_no_graph():
    """x -> 9 x: each relation holds, under F and under F^2."""
    document = interval_file("9*x", ("0", "1/20"), ("1/5", "1/100"))
    first = witness_of(document, "covers")
    for name, power, target in (("again", "2", "two"), ("back", "1", "one")):
        witness = {**first, "power": power, "target": target}
        document["steps"][name] = {"rule": "covers", "witness": witness}
    document["steps"]["arrows"] = {"rule": "graph", "witness": {"covers": ["back", "again"]}}
    document["claims"] = ["arrows", "step"]
    refused(document, "another map", Malformed)
    witness_of(document, "graph")["covers"] = ["back", "step"]
    document["claims"] = ["arrows", "again"]
    assert check(json.dumps(document))


@pytest.mark.every
@pytest.mark.parametrize(
    ("length", "vector", "growth", "true"),
    [
        ("1", ["1", "1"], "1", True),
        ("2", ["1", "1"], "2", True),
        ("19", ["1", "1"], "9349", False),
        ("2", ["1", "2"], "3", False),
        ("1", ["1", "1"], "2", False),
        ("3", ["1", "1"], "4", False),
        ("3", ["1", "1"], "3", True),
        ("10", ["55", "89"], "122", True),
        ("10", ["55", "89"], "123", False),
        ("1", ["0", "1"], "1", True),
        ("1", ["1", "0"], "1", False),
    ],
)
def test_entropy_of_the_golden_mean_graph(length, vector, growth, true):
    """A = ((0, 1), (1, 1)); A^n has the Fibonacci numbers, A^10 (55, 89) = (6765, 10946)."""
    document = only(file("golden_mean"), "entropy-1")
    witness_of(document, "entropy").update(length=length, vector=vector, growth=growth)
    if true:
        share = f"/{length}" if length != "1" else ""
        assert f"at least log({growth}){share}, " in check(json.dumps(document)).sentences[0]
    else:
        refused(document, "does not multiply")


def test_entropy_follows_the_arrows():
    """N1 => N1, N1 => N2 alone: A (1, 1) = (2, 0), the transposed matrix would give (1, 1)."""
    document = only(file("logistic"), "entropy-1")
    witness_of(document, "graph")["covers"] = ["covers-1", "covers-2"]
    document = only(document, "entropy-1")
    witness_of(document, "entropy").update(vector=["1", "1"], growth="1")
    refused(document, "does not multiply")
    witness_of(document, "entropy").update(vector=["1", "0"])
    assert check(json.dumps(document))


def test_entropy_counts_the_power():
    """Under F^2 the bound is halved."""
    document = file("second_iterate")
    document["steps"]["entropy"] = None
    del document["steps"]["entropy"]
    document["steps"]["growth"] = {
        "rule": "entropy",
        "witness": {"graph": "graph-1", "length": "3", "vector": ["5"], "growth": "1"},
    }
    document["claims"] = ["growth"]
    assert "at least log(1)/6" in check(json.dumps(only(document, "growth"))).sentences[0]


# -- cones -----------------------------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    "forms",
    [
        [["1", "-2"], ["1", "-200"]],
        [["1", "-200"], ["1", "-2"]],
        [["-1", "2"], ["-1", "2"]],
        [["1", "2"], ["1", "2"]],
        [["0", "0"], ["0", "0"]],
        [["1", "-1/100"], ["1", "-1/100"]],
        [["1", "-100"], ["1", "-100"]],
    ],
)
def test_other_forms_are_refused(forms):
    document = only(file("henon_horseshoe"), "cone-1")
    witness_of(document, "cone")["forms"] = forms
    refused(document, "cone condition")


def test_forms_belong_to_their_sets():
    """|F'| <= 6.4 on the logistic horseshoe: a form 100 times larger is not exceeded."""
    document = only(file("logistic"), "cone-1")
    for forms in ([["1"], ["100"]], [["100"], ["1"]]):
        witness_of(document, "cone")["forms"] = forms
        refused(document, "cone condition")
    witness_of(document, "cone")["forms"] = [["3"], ["4"]]
    assert "one-sided" in check(json.dumps(document)).sentences[0]


def test_orbits_under_cones_are_hyperbolic():
    """Henon's fixed points at (5, 0.3): det F' = -0.3 and the trace is -10 x, x = -0.535, 0.402."""
    sentence = check(json.dumps(only(file("henon_horseshoe"), "cone-1"))).sentences[0]
    assert sentence.endswith("uniformly hyperbolic, with 1 unstable and 1 stable direction.")
    for x in np.roots([5, 0.7, -1]):
        assert sorted(abs(np.linalg.eigvals([[-10 * x, 1], [0.3, 0]])) > 1) == [False, True]
    sentence = check(json.dumps(only(file("logistic"), "cone-1"))).sentences[0]
    assert sentence.endswith("to the one-sided shift on paths, and uniformly expanding.")


@pytest.mark.parametrize(
    ("after", "is_hyperbolic"), [(["1", "-1"], True), (["1", "1"], False), (["1", "0"], False)]
)
def test_forms_of_different_signs_split_no_directions(after, is_hyperbolic):
    """(3 x, y / 2), from one square to another: where signs change, directions would be lost."""
    lemmas = SymbolicLemmas({"F": (["x", "y"], ["3*x", "y/2"])})
    one, two = (
        lemmas.h_set([x, "0"], [[r, "0"], ["0", "1"]]) for x, r in (("0", "1"), ("2", "1/2"))
    )
    graph = lemmas.graph([lemmas.covers("F", 1, one, two)])
    name = lemmas.cone(graph, ["1", "-1"])
    document = json.loads(lemmas.certificate(name))
    document["steps"][name]["witness"]["forms"][1] = after
    sentence = check(json.dumps(document)).sentences[0]
    assert ("hyperbolic" in sentence) is is_hyperbolic


def test_derivatives_must_obey_the_cone_condition():
    """With a = -10 x and c = 0.3 in Henon's derivative: a^2 > 1 + 10000 c^2 does not hold."""
    document = only(file("henon_horseshoe"), "cone-1")
    witness_of(document, "cone")["forms"] = [["1", "-10000"]] * 2
    refused(document, "cone condition")


def test_cone_box_must_hold_all_that_stays():
    document = only(file("henon_horseshoe"), "cone-1")
    relation = witness_of(document, "cone")["relations"][1]
    relation["box"] = [["-1", "0"], ["-1", "1"]]
    refused(document, "not proved on")
    relation["tree"] = ["1", "0", None, None]
    refused(document, "not proved on")
    for box in (["-1", "2"], ["0", "0"]):
        relation["box"] = [box, ["-1", "1"]]
        refused(document, "interior", Malformed)


def expanding(formula, **relation):
    """A file of cones, of an interval that a map takes over itself."""
    document = interval_file(formula, UNIT, UNIT)
    witness_of(document, "covers")["target"] = "one"
    del document["steps"]["two"]
    document["steps"]["arrows"] = {"rule": "graph", "witness": {"covers": ["step"]}}
    witness = {"graph": "arrows", "forms": [["1"]], "relations": [relation]}
    document["steps"]["cones"] = {"rule": "cone", "witness": witness}
    document["claims"] = ["cones"]
    return document


def test_a_smaller_cone_box():
    """x -> 3 x + x^3 maps only |q| <= 1/3 back: all outside is mapped out."""
    tree = ["1", "-1/2", None, ["1", "1/2", None, None]]
    document = expanding("3*x + x**3", box=[["-1/2", "1/2"]], tree=tree)
    assert "one-sided shift" in check(json.dumps(document)).sentences[0]
    refused(expanding("3*x + x**3", box=[["-1/4", "1/4"]], tree=tree), "not proved on")


@pytest.mark.parametrize("sign", "+-")
def test_all_parts_of_a_cone_box_count(sign):
    """The derivative of 5 x/2 - x^2 is 1/2 at 1, and above 2 to the left of 0; or turned around."""
    file = expanding(f"5/2*x {sign} x**2", box=[["-1", "1"]], tree=["1", "0", None, None])
    refused(file, "cone condition")
