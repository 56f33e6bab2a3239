"""Formulas as trees: printed and read again, the same; substitution; names that are bound."""

import ast
import json
import re
from fractions import Fraction
from pathlib import Path

import flint
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.formulas import Placer
from proofs.trusted.kernel.normalform import NormalForms
from proofs.trusted.kernel.trees import (
    At,
    Derivative,
    Number,
    Operation,
    Pi,
    Power,
    Variable,
    bind,
    formula,
    substitute,
)
from proofs.trusted.paper import GROUPS, find
from proofs.trusted.paper.formulas import Asked
from proofs.trusted.verify import check
from tests.intervals.oracle import arb
from tests.once import examples
from tests.once import report as committed
from tests.oracles.formulas import compiled, differ
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES
from tests.proofs.trusted.kernel.lemma_examples import text as example

ROOT = Path(__file__).parents[4]
NAMES = ("x", "y", "u", "u1", "epsilon")
FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "atan")


def extended(inner):
    names = st.lists(st.sampled_from(NAMES), min_size=1, max_size=3)
    places = names.map(set).flatmap(
        lambda keys: st.tuples(*(st.tuples(st.just(key), inner) for key in sorted(keys)))
    )
    return st.one_of(
        st.builds(lambda op, a, b: Operation(op, (a, b)), st.sampled_from("+-*/"), inner, inner),
        st.builds(lambda a: Operation("negative", (a,)), inner),
        st.builds(lambda op, a: Operation(op, (a,)), st.sampled_from(FUNCTIONS), inner),
        st.builds(lambda n, a: Power(n, (a,)), st.sampled_from([-7, -1, 1, 2, 3]), inner),
        st.builds(lambda by, a: Derivative(tuple(by), (a,)), names, inner),
        st.builds(bind, inner, places),
    )


decimals = st.builds(lambda n, k: Fraction(n, 10**k), st.integers(0, 10**45), st.integers(0, 40))
numbers = (st.integers(0, 10**20) | decimals).map(Number)
leaves = st.sampled_from(NAMES).map(Variable) | numbers | st.just(Pi())
trees = st.recursive(leaves, extended, max_leaves=12)


@settings(max_examples=examples(300))
@given(trees)
def test_what_is_printed_is_read_as_the_same_tree(tree):
    assert formula(str(tree)) == tree
    assert formula(f"({tree})") == tree
    assert formula(str(tree).replace(" ", "")) == tree


@given(trees)
def test_what_is_printed_leaves_nothing_to_be_guessed(tree):
    """No product without its sign, no two signs side by side, no names but free ones and _1, _2."""
    text = str(tree)
    assert not re.search(r"[\w)] +[\w(]", text.replace(" + ", "+").replace(" - ", "-"))
    assert not re.search(r"[-+*/] *[-+/]", text)
    assert "*-" not in text and "**-" not in text
    names = set(re.findall(r"[A-Za-z_]\w*", text)) - {*FUNCTIONS, "pi", "D", "at"}
    assert names == tree.free | tree.bound
    assert all(re.fullmatch(r"_[1-9]\d*", name) for name in tree.bound)


def subtrees(tree):
    yield tree
    for part in tree.parts:
        yield from subtrees(part)


@given(trees)
def test_bound_variables_are_named_by_the_reader_alone(tree):
    """Whatever a text calls them."""
    text = str(tree)
    for each in (node for node in subtrees(tree) if isinstance(node, At)):
        assume(not any(name[0] == "_" for name in each.free))
        function, *values = each.parts
        for k, name in enumerate(each.names):
            assume(not re.search(rf"\bq{k}\b", text))
            renamed = substitute(function, {name: Variable(f"q{k}")})
            names = [f"q{k}" if x == name else x for x in each.names]
            places = zip(names, values, strict=True)
            shown = ", ".join([str(renamed), *(f"{x}={value}" for x, value in places)])
            assert formula(f"at({shown})") == each


def value_of(tree, env):
    found = compiled(str(tree))[0](env)
    return found if found.is_finite() else None


@pytest.mark.slow
@settings(max_examples=examples(200))
@given(trees, st.dictionaries(st.sampled_from(NAMES), trees, max_size=3))
def test_substitution_is_evaluation_elsewhere(tree, places):
    """By Arb, with differences for derivatives: F with G in the place of x, at what G is."""
    try:
        put = substitute(tree, places)
    except Unproved:
        return
    with flint.ctx.workprec(900):
        env = {name: arb(Fraction(k + 3, 7)) for k, name in enumerate(NAMES)}
        try:
            inner = {name: value_of(value, env) for name, value in places.items()}
            if None in inner.values():
                return
            one, two = value_of(put, env), value_of(tree, {**env, **inner})
        except (ValueError, ZeroDivisionError):
            return
        if one is not None and two is not None and max(one.rad(), two.rad()) < arb("1e-60"):
            assert not differ(one, two)
    assert put.free == (tree.free - places.keys()).union(
        *(value.free for name, value in places.items() if name in tree.free)
    )


@pytest.mark.every
@pytest.mark.parametrize(
    ("text", "places"),
    [
        ("D(x*y, x)", {"y": "x"}),
        ("D(x*y, x)", {"x": "y"}),
        ("D(x*y, x)", {"x": "2"}),
        ("D(x*y, x, y)", {"x": "y", "y": "y"}),
        ("at(D(x*y, x), y=2)", {"x": "x + 1"}),
    ],
)
def test_capture_is_refused(text, places):
    with pytest.raises(Unproved, match="substitution that"):
        substitute(formula(text), {name: formula(value) for name, value in places.items()})


def test_what_is_bound_captures_nothing():
    """Also not what no text can say: a formula with the name that the reader gave."""
    with pytest.raises(Unproved, match="captures"):
        substitute(formula("at(x*w, w=2)"), {"x": Variable("_1")})


@pytest.mark.every
@pytest.mark.parametrize(
    ("text", "places", "expected"),
    [
        ("x*y", {"x": "y", "y": "x"}, "y*x"),
        ("D(x*y, x)", {"x": "z"}, "D(z*y, z)"),
        ("at(a*z, z=a)", {"a": "3"}, "at(3*w, w=3)"),
        ("at(z*u, z=u)", {"z": "7"}, "at(w*u, w=u)"),
    ],
)
def test_substitution(text, places, expected):
    put = substitute(formula(text), {name: formula(value) for name, value in places.items()})
    assert put == formula(expected)


@pytest.mark.every
@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("2*-x", "2*(-x)"),
        ("-2*-x", "-2*(-x)"),
        ("-2*x", "-2*x"),
        ("x**-2*x**2", "x**(-2)*x**2"),
        ("-x**2", "-x**2"),
        ("(-x)**2", "(-x)**2"),
        ("a-(b-c)", "a - (b - c)"),
        ("at(3, false=1)", "at(3, _1=1)"),
        ("(-2)*x", "-2*x"),
        ("-(2*x)", "-(2*x)"),
        ("a/b*c", "a/b*c"),
        ("a/(b*c)", "a/(b*c)"),
        ("2**-1", "2**(-1)"),
        ("(2*x)**2", "(2*x)**2"),
        ("a - -b", "a - (-b)"),
        ("a+-2*b", "a + (-2*b)"),
        ("at(w, w=0)", "at(_1, _1=0)"),
        ("at(w + u, w=u)", "at(_1 + u, _1=u)"),
        ("at(at(w, w=z), z=1)", "at(at(_1, _1=_2), _2=1)"),
        ("D(w**2, w)", "D(w**2, w)"),
    ],
)
def test_cases(text, printed):
    assert str(formula(text)) == printed


@pytest.mark.parametrize("text", ["(" * 9000, "-" * 11_000 + "x", "x" + "**2" * 3000, "a" * 11_999])
def test_long_and_deep_texts_are_refused_soon(text):
    with pytest.raises(Malformed):
        formula(text)


@pytest.mark.parametrize(
    "text", ["1.", ".5", "1.2.3", "1.5e3", "0.5x", f"1.{'0' * 41}", "x**2.0", "1_0.5", "x.5"]
)
def test_other_numbers_are_refused(text):
    with pytest.raises(Malformed):
        formula(text)


def test_work_on_nested_bindings_is_bounded():
    """Renaming what is bound at every depth."""
    text = "+".join(["x"] * 80)
    for k in range(60):
        text = f"at({text}, x=x + {k})"
    assert formula(text).free == {"x"}


# -- the formulas of what is committed -------------------------------------------------------------


def formulas_in(value):
    """All formulas inside of a conclusion's fields, and of the conclusions inside."""
    waiting, seen = [value], {}
    while waiting:
        each = waiting.pop()
        if id(each) in seen:  # what a map remembers may lead back to it
            continue
        seen[id(each)] = each
        if hasattr(each, "bound"):
            yield each
        elif isinstance(each, list | tuple):
            waiting += each
        elif hasattr(each, "__dataclass_fields__"):
            waiting += [getattr(each, name) for name in each.__dataclass_fields__]


@pytest.mark.slow
@pytest.mark.parametrize("name", [*EXAMPLES, "foundations", "soft", "resonance", "single"])
def test_formulas_of_committed_certificates(name):
    """Read from the file, printed and read again; and those in backquotes, from the sentences."""
    report = check(example(name)) if name in EXAMPLES else committed(name)
    found = [tree for each in report.context.known.values() for tree in formulas_in(each)]
    for tree in {str(tree): tree for tree in found}.values():
        assert formula(str(tree)) == tree
    for sentence in report.sentences:
        for said in quoted(sentence):
            assert str(formula(said)) == said


def quoted(sentence):
    """The formulas between backquotes: sides of equations, components, and what precedes O()."""
    for each in re.findall(r"`([^`]*)`", sentence):
        for side in re.sub(r" \+ O\(.*\)$", "", each).split(" = "):
            node = ast.parse(side, mode="eval").body
            parts = node.elts if isinstance(node, ast.Tuple) else [node]
            texts = [ast.get_source_segment(side, part) for part in parts]
            yield from (text for text in texts if not re.fullmatch(r"[A-Z]\w*(\(.*\))?", text))


@pytest.mark.parametrize("group", ["foundations", "single", "soft", "resonance"])
def test_formulas_of_statements(group):
    """Each lemma that a theorem of the paper needs, and each text of a committed witness."""
    for claim in GROUPS[group]:
        for need in find(claim).needs:
            trees_of = [need.function] if isinstance(need, Asked) else formulas_in(need)
            assert all(formula(str(tree)) == tree for tree in trees_of)
    document = json.loads((ROOT / f"reports/{group}.json").read_text(encoding="utf-8"))
    for step in document["steps"].values():
        if step["rule"].startswith("formula-"):
            for text in Reader(step["witness"]).mentioned():
                if not re.fullmatch(r"-?[0-9/]+", text):
                    assert str(formula(text)) == text


def test_what_is_bound_is_no_other_variable_of_its_name():
    """u is bound beside a u that is free, and that may be a number on the tape."""
    tape = Tape()
    two = tape.number(2)
    placer = Placer(tape, {"u": two, "x": tape.add("variable")}, [])
    root = placer.place(formula("at(2*w + 2, w=5)*u + at(D(w**2, w), w=x + u)"))
    forms = NormalForms(1)
    (value,) = tape.evaluate((root,), forms, forms.inputs())
    assert value == {(): 28, ((0, 1),): 2}
    with pytest.raises(Unproved, match="not a variable"):
        placer.place(formula("D(x*u, u)"))
