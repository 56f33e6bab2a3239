"""Graphs of maps of the plane in Coq: what is stated and accepted, and that nothing false is."""

import json
import re
from fractions import Fraction
from itertools import product

import pytest

from proofs.formal import __main__ as formal
from proofs.formal import coqc, graphs
from proofs.formal.plane import PARTS, Plane, Rates
from proofs.formal.written import NoTheorem
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.files import render
from proofs.trusted.verify import check
from tests.proofs.formal.coq import ROOT, asking, computed, needs_coqc, one

HENON = ROOT / "reports" / "systems" / "henon" / "horseshoe.json"
HEAD = graphs.HEAD.format(digest="0", modules=Plane.modules)


def certificate(values, sets, arrows):
    """A certificate of covering relations of F: boxes x, y, in hundredths, and the entropy."""
    file = SymbolicLemmas({"F": (["x", "y"], values)})
    made = []
    for x, y in sets:
        (a, b), (c, d) = ([Fraction(end, 100) for end in side] for side in (x, y))
        rows = [[str((b - a) / 2), "0"], ["0", str((d - c) / 2)]]
        made.append(file.h_set([str((a + b) / 2), str((c + d) / 2)], rows))
    graph = file.graph([file.covers("F", 1, made[i], made[j]) for i, j in arrows])
    if all(any(a[0] == b[1] for a in arrows) for b in arrows):
        file.entropy(graph)
    return render(file.document())


FOLDED = [
    "x**2 - 6 + y/10",
    "x/10",
]  # two laps, each across both sets; y is near 1/10 of the x before
SETS = [((-310, -160), (-40, 40)), ((160, 310), (-40, 40))]
ALL = list(product(range(2), repeat=2))


@pytest.fixture(scope="module")
def made():
    """The case of a folded map."""
    source = certificate(FOLDED, SETS, ALL)
    return graphs.case(check(source), source, "0")


def test_what_is_stated(made):
    said = coqc.statements(made.text, [theorem.name for theorem in made.theorems])
    assert "let x := fst z in let y := snd z in ((((x ^ 2) - (6)) + (y / (10))), (x / (10)))" in (
        made.text.replace("x ^ 2 ", "(x ^ 2) ")
    )
    assert re.search(
        r"graph1 : followed_once nat \(fun i j => In \(i, j\) arrows1\) \(parallelogram sets1\) "
        r"\(fun z z' => z' = F1 z\) \(\d+ / 10000\)\.",
        said("graph1"),
    )
    assert said("entropy1") == (
        "Theorem entropy1 : entropy_at_least in_plane F1 (parallelogram sets1) arrows1 1 2."
    )
    assert "((-47 / 20, 0 / 20), (15 / 20, 0 / 20), (0 / 20, 8 / 20))" in made.text


def test_arrows_that_no_two_sided_path_has_are_left_out():
    source = certificate(FOLDED, SETS, [(0, 0), (0, 1)])
    made = graphs.case(check(source), source, "0")
    assert "arrows1 : list (nat * nat) := [(0, 0)]%nat" in made.text
    above = [*SETS, ((-310, -160), (60, 90))]  # which no set covers
    source = certificate(FOLDED, above, [*ALL, (2, 0)])
    made = graphs.case(check(source), source, "0")
    assert "arrows1 : list (nat * nat) := [(0, 0); (0, 1); (1, 0); (1, 1)]%nat" in made.text
    assert re.search(r"vector1 := \[([1-9]\d*); \1; 0\]", made.text)
    source = certificate(FOLDED, SETS, [(0, 1)])
    with pytest.raises(NoTheorem, match="no two-sided path"):
        graphs.case(check(source), source, "0")


def test_without_cones_there_is_no_theorem():
    source = certificate(["4*x**3 - 3*x", "y/9"], [((-110, 110), (-40, 40))], [(0, 0)])
    with pytest.raises(NoTheorem, match="no cones"):
        graphs.case(check(source), source, "0")


@pytest.mark.parametrize(
    "numbers", [(3, "1/10", "1/10", "1/2"), (11, "1/6", "6/5", "1/40"), (2, 0, 0, 0)]
)
def test_rates_obey_the_theorem_s_inequalities(numbers):
    p, q, r, s = map(Fraction, numbers)
    rates = Rates.seen(p, q, r, s)
    low, *others, width, k = (Fraction(each, PARTS) for each in rates)
    assert low < p and all(a <= b for a, b in zip((q, r, s), others, strict=True))
    assert 0 <= k < 1 and 1 + others[0] * width <= k * low
    assert others[1] * k + others[2] * width <= k * width


@pytest.mark.parametrize("numbers", [(1, 0, 0, 0), (3, 0, 0, 1), (2, 1, 1, "1/2"), (0, 0, 0, 0)])
def test_no_rate_is_seen_where_there_is_none(numbers):
    assert Rates.seen(*map(Fraction, numbers)) is None


@pytest.fixture(scope="module")
def lines(made):
    """The definitions of the case, and what Coq is asked to compute."""
    check = re.search(r"Lemma checked1 : (.*?) = true", made.text)[1]
    return made.text[len(HEAD) : made.text.index("Lemma checked1")], check


def number(name, place, change):
    """An edit of a number of a definition, by its place."""
    pattern = rf"(Definition {name} :=(?:[^.]*?-?\d+){{{place}}}[^.\d-]*?)(-?\d+)"
    return one(pattern, lambda found: f"{found[1]}{change(int(found[2]))}")


LIES = {
    "another map": one(r"Integer \(6\)", "Integer (3)"),
    "a map that contracts": one(r"Power X 2", "X"),
    "a wider set": number("data1", 2, lambda x: x * 2),
    "a set further left": number("data1", 0, lambda x: x - 200),
    "a set too low": number("data1", 5, lambda x: x // 4),
    "a flat set": number("data1", 5, lambda x: 0),
    "sets that overlap": number("data1", 6, lambda x: x - 400),
    "an arrow to nowhere": one(r"\(1, 1\)\]%nat", "(1, 2)]%nat"),
    "steeper": number("rates1", 0, lambda x: x * 2),
    "less shear": number("rates1", 1, lambda x: 0),
    "less fall": number("rates1", 2, lambda x: 0),
    "narrower cones": number("rates1", 4, lambda x: x // 500),
    "nearer": number("rates1", 5, lambda x: x // 2),
    "an expanding rate": number("rates1", 5, lambda x: 10000),
    "another iterate": asking(r"tree1 1 ", "tree1 2 "),
    "another unit": asking(r"tree1 1 \d+", "tree1 1 900"),
}


# refused at once; the others after many boxes
SOON = ("an arrow to nowhere", "sets that overlap", "narrower cones", "an expanding rate", "nearer")


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize("names", [SOON, pytest.param(tuple(LIES), marks=pytest.mark.long)])
def test_coq_computes_what_is_true_and_nothing_that_is_not(lines, tmp_path, names):
    """All in one file: the true data first, then each lie."""
    parts = [lines, *(LIES[name](*lines) for name in names)]
    said = computed(tmp_path, Plane.modules, parts)
    assert dict(zip(["true data", *names], said, strict=True)) == {
        "true data": "true",
        **dict.fromkeys(names, "false"),
    }


OWN = {
    "henon": None,
    "sine": (["4*sin(x) + y", "-3/10*x"], ("-5", "5"), ("-2", "2")),
    "duffing": (["y", "-1/5*x + 11/4*y - y**3"], ("-2", "2"), ("-2", "2")),
}


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize("name", OWN)
def test_coqc_accepts_maps_of_the_plane(capsys, tmp_path, name):
    from proofs import Map

    path = HENON
    if OWN[name] is not None:
        formulas, x, y = OWN[name]
        path = tmp_path / "own.json"
        Map(*formulas).horseshoe({"x": x, "y": y}).save(path)
    assert formal.main([str(path), "--out", str(tmp_path / "out"), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in answer["theorems"]] == ["graph1", "entropy1"]
    assert set(answer["axioms"]) == coqc.REALS and answer["other_axioms"] == []
