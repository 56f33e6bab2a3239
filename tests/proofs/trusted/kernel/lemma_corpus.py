"""The committed lemma files: each file of tests/certificates/lemmas, made from the examples.

From the root, `python -m tests.proofs.trusted.kernel.lemma_corpus` writes them again.
"""

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from proofs.trusted.certificate import SCHEMA, render
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

FOLDER = Path(__file__).parents[3] / "certificates" / "lemmas"
Document = dict[str, Any]


class Entry(NamedTuple):
    """A file: what it is, a part of the checker's message, and how to make it."""

    change: str
    message: str
    make: Callable[[], str]


def changed(name: str, edit: Callable[[Document], Any]) -> Callable[[], str]:
    """Return the maker that edits an example."""

    def make() -> str:
        document = json.loads(text(name))
        edit(document)
        return render(document)

    return make


def witness(document: Document, step: str) -> Document:
    found: Document = document["steps"][step]["witness"]
    return found


def set_in(step: str, **fields: Any) -> Callable[[Document], Any]:
    """Return the edit that replaces fields of a witness."""
    return lambda document: witness(document, step).update(fields)


def formula(name: str, *values: str) -> Callable[[Document], Any]:
    """Return the edit that replaces the values of a function."""
    return lambda document: document["functions"][name].update(values=list(values))


def value_of(text: str, bounds: list[str], tree: Any = None, **box: list[str]) -> Callable[[], str]:
    """Return the maker of a file with one step about a value."""
    step = {"function": text, "box": box, "tree": tree, "bounds": bounds}
    return single("formula-value", step)


def single(rule: str, step: Document) -> Callable[[], str]:
    """Return the maker of a file with one step."""

    def make() -> str:
        steps = {"step": {"rule": rule, "witness": step}}
        return render(
            {"schema": SCHEMA, "parameters": None, "functions": {}, "steps": steps}
            | {"claims": ["step"]}
        )

    return make


def moved_bracket(document: Document) -> None:
    low, high = map(Fraction, witness(document, "zero-1")["bracket"])
    witness(document, "zero-1")["bracket"] = [str(high), str(2 * high - low)]


def twin_sets(document: Document) -> None:
    """The second set and its relations like the first: nothing is told apart."""
    steps = document["steps"]
    steps["h-set-2"] = steps["h-set-1"]
    for new, old in (("covers-3", "covers-1"), ("covers-4", "covers-2")):
        steps[new]["witness"] = {**witness(document, old), "source": "h-set-2"}
        steps[new]["witness"]["target"] = "h-set-1" if new == "covers-3" else "h-set-2"
    keep = {"h-set-1", "h-set-2", "covers-1", "covers-2", "covers-3", "covers-4", "graph-1"}
    document["steps"] = {name: step for name, step in steps.items() if name in keep}
    document["claims"] = ["graph-1"]


def pole(document: Document) -> None:
    """1/x on both sides of 0 has values of both signs."""
    value = {"function": "1/x", "box": {"x": ["-1", "1"]}, "bounds": ["-9", "9"]}
    tree = ["1", "1/3", None, None]
    zero = {"function": "1/x", "value": "value-1", "bracket": ["-1", "1"]}
    document["steps"] = {
        "value-1": {"rule": "formula-value", "witness": {**value, "tree": tree}},
        "zero-1": {"rule": "zero", "witness": zero},
    }
    document["claims"] = ["zero-1"]


def first_rate(document: Document) -> str:
    text: str = witness(document, "equal-1")["right"]
    return text


REJECTED = {
    "false_sign": (
        "the cubic > 0 on an interval that contains its root",
        "not proved on",
        changed("cubic", set_in("value-5", box={"x": ["3/2", "3"]})),
    ),
    "range_too_narrow": (
        "the cubic's range on [-2, 2] without its maximum 3 and its value 3 at 2",
        "not proved on",
        changed("cubic", set_in("value-4", bounds=["-2", "29/10"])),
    ),
    "monotone_past_the_turn": (
        "the cubic increasing from -2 to beyond its maximum at -1",
        "not proved on",
        changed("cubic", set_in("value-1", box={"x": ["-2", "-9/10"]})),
    ),
    "bracket_moved": (
        "the bracket of a root moved up by its width",
        "same sign",
        changed("cubic", moved_bracket),
    ),
    "pole_for_zero": (
        "1/x changes its sign on [-1, 1], without a zero",
        "not proved on",
        changed("cubic", pole),
    ),
    "logarithm_of_negatives": (
        "the logarithm of numbers that may be negative",
        "not proved on",
        value_of("log(x)", ["-9", "9"], x=["-1", "2"]),
    ),
    "derivative_without_function": (
        "the derivative 1 of x + 0 sqrt(y) where y is negative",
        "not proved on",
        value_of("D(x + 0*sqrt(y), x)", ["1", "1"], x=["0", "1"], y=["-1", "2"]),
    ),
    "series_with_another_term": (
        "sin(x)/x = 1 + x/6 + O(x^2)",
        "begins otherwise",
        changed("refutations", set_in("series-1", coefficients=["1", "1/6"])),
    ),
    "series_without_condition": (
        "x/(a x + x^2) = 1/a + O(x), without a other than 0",
        "nonzero",
        single(
            "formula-series",
            {"function": "x/(a*x + x**2)", "variable": "x", "coefficients": ["1/a"], "nonzero": []},
        ),
    ),
    "two_zeros": (
        "one box around both fixed points of the Henon map",
        "Krawczyk",
        changed("henon_fixed_points", set_in("unique-zero-1", box=[["-2", "2"], ["-2", "2"]])),
    ),
    "singular_preconditioner": (
        "the Krawczyk operator with a singular matrix",
        "Krawczyk",
        changed("henon_fixed_points", set_in("unique-zero-1", matrix=[["1", "1"], ["1", "1"]])),
    ),
    "orbit_left_out": (
        "the periodic orbits of the Henon map but one",
        "another periodic orbit",
        changed("henon_orbits", lambda d: witness(d, "periodic-orbits-1")["orbits"].pop()),
    ),
    "orbit_of_another_map": (
        "the periodic orbits of the Henon map at a = 1.4 for a = 1.41",
        "Krawczyk",
        changed("henon_orbits", formula("F", "1 - 141/100*x**2 + y", "3/10*x")),
    ),
    "false_identity": (
        "the second time derivative of the gap given as the first",
        "differ",
        changed("gap_identities", lambda d: witness(d, "equal-3").update(right=first_rate(d))),
    ),
    "value_moved": (
        "an exact value at a point, another digit",
        "not proved on",
        changed("refutations", set_in("value-3", bounds=["1/100", "1/100"])),
    ),
    "singular_h_set": (
        "an h-set without volume",
        "inverse",
        changed("henon_horseshoe", set_in("h-set-1", matrix=[["1", "2"], ["2", "4"]])),
    ),
    "target_too_wide": (
        "an h-set that its images do not cross",
        "not proved on",
        changed(
            "henon_horseshoe",
            set_in(
                "h-set-1",
                matrix=[["47/100", "0"], ["0", "1/5"]],
                inverse=[["100/47", "0"], ["0", "5"]],
            ),
        ),
    ),
    "orientation_reversed": (
        "a covering relation of the other degree",
        "not proved on",
        changed("henon_horseshoe", set_in("covers-1", sign="-")),
    ),
    "no_horseshoe": (
        "the Henon map at a = 2, where the same sets have no such relations",
        "not proved on",
        changed("henon_horseshoe", formula("F", "1 - 2*x**2", "x")),
    ),
    "sets_not_disjoint": (
        "two equal sets in one graph",
        "disjoint",
        changed("logistic", twin_sets),
    ),
    "entropy_too_large": (
        "a growth of 3 in a graph of two sets",
        "does not multiply",
        changed("logistic", set_in("entropy-1", growth="3")),
    ),
    "cones_too_wide": (
        "forms for which the cone condition fails",
        "cone condition",
        changed("henon_horseshoe", set_in("cone-1", forms=[["1", "-100"], ["1", "-100"]])),
    ),
    "expansion_overstated": (
        "|F'| >= 2.11 where it is 2.1 at an end",
        "not proved on",
        changed("logistic", set_in("value-1", bounds=["211/100", "6"])),
    ),
}

MALFORMED = {
    "huge_exponent": (
        "x^1000000000",
        "exponents",
        changed("logistic", formula("F", "x**1000000000")),
    ),
    "nested_deeply": (
        "160 sines in one another",
        "deep",
        changed("logistic", formula("F", "sin(" * 160 + "x" + ")" * 160)),
    ),
    "unknown_variable": (
        "a variable that is not declared",
        "unknown variable",
        changed("logistic", formula("F", "z")),
    ),
    "unknown_operation": (
        "a function that the format does not have",
        "no formula has",
        changed("logistic", formula("F", "tan(x)")),
    ),
    "comment": (
        "a formula with a comment that says more",
        "in no formula",
        changed("logistic", formula("F", "x # + 1")),
    ),
    "hexadecimal": (
        "a number 0x10 that is 16 and looks like 0 times x10",
        "in no formula",
        changed("logistic", formula("F", "0x10*x")),
    ),
    "number_not_canonical": (
        "6/4 as a bound",
        "lowest terms",
        changed("cubic", set_in("value-4", bounds=["-2", "6/4"])),
    ),
    "variable_named_like_a_function": (
        "a variable exp",
        "not a name for a variable",
        changed("logistic", lambda d: d["functions"]["F"].update(variables=["exp"])),
    ),
    "cut_outside": (
        "a subdivision whose cut is not in the box",
        "cut",
        changed("cubic", set_in("value-5", tree=["1", "5", None, None])),
    ),
    "part_missing": (
        "a subdivision with one part",
        "entries",
        changed("cubic", set_in("value-5", tree=["1", "2", None])),
    ),
    "reversed_box": (
        "a box from 3 to 8/5",
        "reversed",
        changed("cubic", set_in("value-5", box={"x": ["3", "8/5"]})),
    ),
    "side_missing": (
        "a box without one of the variables",
        "a side for each",
        changed("refutations", set_in("value-4", box={"x": ["1", "1"]})),
    ),
    "slope_of_another": (
        "a zero proved the only one by the derivative of another function",
        "another function",
        changed("cubic", set_in("zero-1", function="x**3 - 3*x")),
    ),
    "later_step": (
        "a root whose step about the derivative comes later",
        "no earlier step",
        changed("cubic", lambda d: d.update(steps=dict(reversed(d["steps"].items())))),
    ),
    "unused_step": (
        "a true step that no claim uses",
        "nothing uses",
        changed("cubic", lambda d: d["claims"].remove("value-5")),
    ),
    "claim_twice": (
        "a claim given twice",
        "twice",
        changed("cubic", lambda d: d["claims"].append("value-5")),
    ),
    "relation_twice": (
        "a covering relation twice in a graph",
        "twice",
        changed("golden_mean", lambda d: witness(d, "graph-1")["covers"].append("covers-1")),
    ),
    "other_schema": (
        "a schema of the future",
        "schema",
        changed("cubic", lambda d: d.update(schema="impact-proofs.certificate/9")),
    ),
    "note_added": (
        "a field that the rule does not know",
        "unknown field",
        changed("cubic", set_in("value-5", note="trust me")),
    ),
}


def accepted(name: str) -> Entry:
    return Entry((EXAMPLES[name].__doc__ or "").strip(), "", lambda: text(name))


CORPUS = {
    **{f"accepted/{name}": accepted(name) for name in EXAMPLES},
    **{f"rejected/{name}": Entry(*parts) for name, parts in REJECTED.items()},
    **{f"malformed/{name}": Entry(*parts) for name, parts in MALFORMED.items()},
}


def path_of(name: str) -> Path:
    return FOLDER / f"{name}.json"


def readme() -> str:
    rows = [f"| `{name}.json` | {entry.change} |" for name, entry in CORPUS.items()]
    return "\n".join(
        [
            "# Lemma files that the checker must accept, reject, or call malformed",
            "",
            "All are made by `python -m tests.proofs.trusted.kernel.lemma_corpus`; `tests` prove",
            "them up to date.",
            "",
            "| file | what it is |",
            "|---|---|",
            *rows,
            "",
        ]
    )


if __name__ == "__main__":
    for file, entry in CORPUS.items():
        path_of(file).parent.mkdir(parents=True, exist_ok=True)
        path_of(file).write_text(entry.make(), encoding="utf-8")
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")
