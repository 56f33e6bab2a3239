"""Graphs of maps of the line in Coq: what is written and accepted, and that nothing false is."""

import json
import math
import random
import re
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.formal import __main__ as formal
from proofs.formal import coqc, graphs
from proofs.formal.line import Line
from proofs.formal.written import comment, pairs
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.files import render
from proofs.trusted.kernel.trees import formula
from proofs.trusted.verify import check
from tests.proofs.formal.coq import edited, needs_coqc
from tests.proofs.trusted.kernel.lemma_examples import text as example

HEAD = graphs.HEAD.format(digest="0", modules=Line.modules)

# a formula as people write it, as Coq's reals have it, and as a tree
FORMULAS = [
    ("x - 2*x", "(x - ((2) * x))", "(Sub X (Mul (Integer (2)) X))"),
    ("-(x/3)", "(- (x / (3)))", "(Neg (Div X (Integer (3))))"),
    ("x**3", "(x ^ 3)", "(Power X 3)"),
    ("x**-2", "(1 / x ^ 2)", "(Div (Integer 1) (Power X 2))"),
    ("log(exp(sqrt(x)))", "(ln (exp (sqrt x)))", "(Log (Exp (Sqrt X)))"),
    ("sin(pi*x)", "(sin (PI * x))", "(Sin (Mul Pi X))"),
    ("x + cos(-7/2)", "(x + (cos (-7 / 2)))", None),
]

# maps of the line: a formula, an iterate, intervals, and the covering relations among them
ALL = list(product(range(2), repeat=2))
MAPS = {
    "logistic": ("5*x*(1 - x)", 1, ["-1/100 29/100", "71/100 101/100"], ALL),
    "second iterate": ("5*x*(1 - x)", 2, ["-1/100 11/100", "17/100 29/100"], ALL),
    "quadratic": ("x**2 - 6", 1, ["-31/10 -8/5", "8/5 31/10"], ALL),
    "cubic": (
        "4*x**3 - 3*x + x/2",
        1,
        ["-23/20 -3/5", "-1/2 1/2", "3/5 23/20"],
        [(0, 0), (0, 1), (1, 1), (2, 1), (2, 2)],
    ),
    "five laps": (
        "3*sin(4*x) + x/7",
        1,
        [
            "-187/100 -127/100",
            "-27/25 -49/100",
            "-29/100 29/100",
            "49/100 27/25",
            "127/100 187/100",
        ],
        list(product(range(5), repeat=2)),
    ),
    "Ricker": ("x*exp(4*(1 - x))", 1, ["1/200 1/10", "3/5 13/5"], [(0, 1), (1, 0), (1, 1)]),
    "logarithm": ("6*log(x)**2 - 1", 1, ["1/20 3/5", "17/10 3"], [(0, 1), (1, 1)]),
    "square root": ("4*sqrt(x)*(2 - x)", 1, ["1/100 1/2", "17/10 21/10"], [(0, 1), (1, 0)]),
    "rational": ("1/x - 3*x", 1, ["-3/2 -1/4", "1/4 3/2"], ALL),
    "cosine of pi": (
        "3*cos(pi*x)",
        1,
        ["-19/10 -11/10", "1/10 9/10", "11/10 19/10"],
        list(product(range(3), repeat=2)),
    ),
}


def certificate(text, power, intervals, arrows):
    """A certificate of covering relations, their graph and its entropy."""
    file = SymbolicLemmas({"F": (["x"], [text])})
    ends = [tuple(map(Fraction, each.split())) for each in intervals]
    sets = [file.h_set([str((a + b) / 2)], [[str((b - a) / 2)]]) for a, b in ends]
    graph = file.graph([file.covers("F", power, sets[i], sets[j]) for i, j in arrows])
    file.entropy(graph)
    return render(file.document())


def written(source):
    return graphs.case(check(source), source, "0")


@pytest.mark.parametrize(("text", "real", "tree"), FORMULAS)
def test_formulas_as_coq_reads_them(text, real, tree):
    map_ = SymbolicLemmas({"F": (["x"], [text])}).function("F")
    assert graphs.formulas(map_)[0][0] == real
    assert tree is None or graphs.formulas(map_)[0][1] == tree


BINARY = {"Add": "+", "Sub": "-", "Mul": "*", "Div": "/"}
NAMES = {"sqrt": math.sqrt, "exp": math.exp, "log": math.log, "ln": math.log}
NAMES |= {"sin": math.sin, "cos": math.cos, "pi": math.pi, "PI": math.pi, "x": 0.7}
texts = st.recursive(
    st.sampled_from(["x", "pi", "2", "7/3"]),
    lambda inner: st.one_of(
        st.builds("({}) {} ({})".format, inner, st.sampled_from("+-"), inner),
        st.builds("({}){}({})".format, inner, st.sampled_from("*/"), inner),
        st.builds("({})**{}".format, inner, st.sampled_from([3, -2])),
        st.builds("{}({})".format, st.sampled_from(["sqrt", "exp", "log", "sin", "-"]), inner),
    ),
    max_leaves=6,
)


def evaluated(text):
    """The float that a formula gives, or None."""
    try:
        value = eval(text, {"__builtins__": {}}, NAMES)
    except (ArithmeticError, ValueError):
        return None
    return value if isinstance(value, float | int) and abs(value) < 1e6 else None


def parsed(tokens):
    """The first term of a list of tokens, which it is taken from."""
    token = tokens.pop(0)
    if token != "(":
        return token
    parts = []
    while tokens[0] != ")":
        parts.append(parsed(tokens))
    tokens.pop(0)
    return parts


def python(term):
    """A tree of Formula.v in Python's notation."""
    if isinstance(term, str):
        return {"X": "x", "Pi": "pi"}.get(term, term)
    if len(term) == 1:
        return f"({python(term[0])})"
    name, one, *others = term[0], *map(python, term[1:])
    if name in BINARY:
        return f"({one} {BINARY[name]} {others[0]})"
    if name == "Power":
        return f"({one}**{others[0]})"
    return one if name == "Integer" else f"({'-' if name == 'Neg' else name.lower()}({one}))"


@given(texts)
def test_a_tree_has_the_values_of_its_text(text):
    """And Coq proves that the real function at the head of the case is that of the tree."""
    value = evaluated(text)
    if value is None:
        return
    map_ = SymbolicLemmas({"F": (["x"], [str(formula(text))])}).function("F")
    tree = parsed(re.findall(r"[()]|[^\s()]+", graphs.formulas(map_)[0][1]))
    assert evaluated(python(tree)) == pytest.approx(value, rel=1e-9, abs=1e-9)


def test_no_word_ends_a_comment_or_begins_another():
    words = comment('x *) Axiom injected : False. (* y "z')
    assert "*)" not in words and "(*" not in words and '"' not in words


def test_what_is_stated_for_a_certificate_of_the_checker():
    made = written(example("golden_mean"))
    said = coqc.statements(made.text, [theorem.name for theorem in made.theorems])
    assert "F1 (x : R) : R := (((39 / 10) * x) * ((1) - x))." in made.text
    assert "[(34 / 200, 88 / 200); (112 / 200, 191 / 200)]" in made.text
    assert said("graph1") == "Theorem graph1 : semiconjugate F1 cells1 arrows1."
    assert (
        said("entropy1")
        == "Theorem entropy1 : entropy_at_least on_line F1 (interval cells1) live1 19 9349."
    )
    logistic = written(example("logistic"))
    assert "graph1 : conjugate F1 cells1 arrows1 (209 / 100)" in logistic.text


def test_an_interval_without_an_arrow_onward_carries_no_entropy():
    text = certificate("5*x*(1 - x)", 1, ["-1/100 29/100", "71/100 101/100"], [(0, 0), (0, 1)])
    made = written(text)
    assert "arrows1 : list (nat * nat) := [(0, 0); (0, 1)]%nat" in made.text
    assert "live1 : list (nat * nat) := [(0, 0)]%nat" in made.text


def test_a_map_of_three_variables_is_a_line_and_status_1(capsys, tmp_path):
    file = SymbolicLemmas({"F": (["x", "y", "z"], ["9*x", "y/9", "z/9"])})
    unit = [[str(int(i == j)) for j in range(3)] for i in range(3)]
    cube = file.h_set(["0", "0", "0"], unit)
    file.graph([file.covers("F", 1, cube, cube)])
    path = tmp_path / "cube.json"
    path.write_text(render(file.document()))
    assert formal.main([str(path), "--out", str(tmp_path / "out")]) == 1
    error = capsys.readouterr().err
    assert "more than two variables" in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.fixture(scope="session")
def theory(tmp_path_factory):
    """A folder with the theory of graphs, compiled."""
    folder = tmp_path_factory.mktemp("graphs")
    modules = coqc.order(HEAD)
    coqc.copy(coqc.theory(modules, print), folder, modules, ".vo")
    return folder


def asked(folder, name, text):
    (folder / f"{name}.v").write_text(text)
    return coqc.run(folder, name).output


@needs_coqc
@pytest.mark.slow
def test_the_command_on_a_certificate_of_the_checker(capsys, tmp_path):
    path = tmp_path / "x *) Axiom injected : False. (* y.json"
    path.write_text(example("logistic"))
    assert formal.main([str(path), "--out", str(tmp_path / "out"), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in answer["theorems"]] == ["graph1", "entropy1"]
    assert set(answer["axioms"]) == coqc.REALS and answer["other_axioms"] == []
    assert "injected" not in (tmp_path / "out" / "Case.v").read_text()


@needs_coqc
@pytest.mark.slow
def test_ten_maps_of_the_line(theory):
    """All in one file of Coq, under names of their own."""
    parts, names = [], []
    for i, (name, of) in enumerate(MAPS.items()):
        made = written(certificate(*of))
        body = made.text[len(HEAD) :].partition("(* What all")[0]
        parts.append(f"Module M{i}.\n(* {name} *)\n{body}\nEnd M{i}.\n")
        names += [f"M{i}.{theorem.name}" for theorem in made.theorems]
    listed = f"Definition all := ({', '.join(names)}).\nPrint Assumptions all.\n"
    output = asked(theory, "Ten", HEAD + "".join(parts) + listed)
    assert set(coqc.axioms(output)) == coqc.REALS
    conjugate = [i for i, part in enumerate(parts) if ": conjugate F1" in part]
    assert [list(MAPS)[i] for i in conjugate] == [
        "logistic",
        "quadratic",
        "five laps",
        "logarithm",
        "square root",
        "rational",
        "cosine of pi",
    ]


def logistic(x):
    return 5 * x * (1 - x)


def covers(cell, target):
    """The truth, exactly: the ends of an interval in one lap go beyond those of the other."""
    low, high = sorted(map(logistic, cell))
    return low <= target[0] and target[1] <= high


def drawn(rng):
    """Intervals in the two laps of 5 x (1 - x), in hundredths, near those that cover each other."""
    left = sorted((rng.randint(-4, 3), rng.randint(24, 33)))
    right = sorted((rng.randint(67, 76), rng.randint(97, 104)))
    return [tuple(left), tuple(right)]


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize("count", [80, pytest.param(400, marks=pytest.mark.long)])
def test_of_many_graphs_coq_accepts_those_that_are_true(theory, count):
    """Ends moved, arrows left: true exactly where all arrows are covering relations."""
    rng = random.Random(20)
    cases = []
    for _ in range(count):
        ends = drawn(rng)
        arrows = rng.sample(ALL, rng.randint(1, 4))
        cells = [tuple(Fraction(end, 100) for end in cell) for cell in ends]
        cases.append((ends, arrows, all(covers(cells[i], cells[j]) for i, j in arrows)))
    terms = "; ".join(
        f"check tree 1 100 [{pairs(ends)}]%Z [{pairs(arrows)}]%nat" for ends, arrows, _ in cases
    )
    output = asked(
        theory,
        "Many",
        HEAD
        + "Definition tree := Mul (Mul (Integer 5) X) (Sub (Integer 1) X).\n"
        + f"Set Printing Width 100000.\nEval vm_compute in [{terms}].\n",
    )
    said = re.findall(r"true|false", output.partition("= [")[2].partition("]")[0])
    assert said == [str(truth).lower() for _, _, truth in cases]
    assert said.count("false") >= count / 2 and said.count("true") > count / 8


# edits of what is stated, the data that Coq computes with left as they are, and the other way round
FALSE = {
    "another map": ("(((5) * x) * ((1) - x))", "(((6) * x) * ((1) - x))"),
    "another tree": ("(Mul (Mul (Integer (5)) X)", "(Mul (Mul (Integer (4)) X)"),
    "another interval": ("(71 / 100, 101 / 100)]", "(71 / 100, 102 / 100)]"),
    "an interval too far": ("(71, 101)]%Z", "(71, 104)]%Z"),
    "intervals that meet": ("(-1, 29); (71, 101)]%Z", "(-1, 71); (71, 101)]%Z"),
    "another arrow": (
        "arrows1 : list (nat * nat) := [(0, 0);",
        "arrows1 : list (nat * nat) := [(0, 2);",
    ),
    "an iterate": ("conjugate F1 cells1", "conjugate (iter F1 2) cells1"),
    "too steep": ("arrows1 209 100 = true", "arrows1 211 100 = true"),
    "steeper as stated": ("(209 / 100)", "(210 / 100)"),
    "too much entropy": ("vector1 1 2 =", "vector1 1 3 ="),
    "more entropy as stated": ("cells1) live1 1 2.", "cells1) live1 1 3."),
    "faster": ("cells1) live1 1 2.", "cells1) live1 0 2."),
    "no weight": ("[729000000000; 729000000000]", "[0; 0]"),
    "a negative weight": ("[729000000000; 729000000000]", "[-1; 729000000000]"),
}
EACH_RUN = ("another arrow", "too steep", "more entropy as stated", "a negative weight")


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [name if name in EACH_RUN else pytest.param(name, marks=pytest.mark.long) for name in FALSE],
)
def test_what_is_false_is_refused(theory, tmp_path, name):
    text = edited(written(example("logistic")).text, FALSE[name])
    for path in theory.glob("*.vo"):
        (tmp_path / path.name).symlink_to(path)
    with pytest.raises(coqc.Refused):
        asked(tmp_path, "Case", text)
