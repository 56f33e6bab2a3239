"""The committed lemma files: each file of tests/certificates/lemmas, made from the examples.

From the root, `python -m tests.proofs.trusted.kernel.lemma_corpus` writes them again.
"""

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from proofs.trusted.certificate import render
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


def claim_in(step: str, **fields: Any) -> Callable[[Document], Any]:
    """Return the edit that replaces fields of a claim."""
    return lambda document: witness(document, step)["claim"].update(fields)


def formula(name: str, *values: Any) -> Callable[[Document], Any]:
    """Return the edit that replaces the values of a function."""
    return lambda document: document["functions"][name].update(values=list(values))


def moved_bracket(document: Document) -> None:
    low, high = map(Fraction, witness(document, "root-1")["bracket"])
    witness(document, "root-1")["bracket"] = [str(high), str(2 * high - low)]


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
    formula("F", ["/", "1", "x"])(document)
    zero = {"function": "F", "component": "1", "interval": ["-1", "1"], "tree": None}
    document["steps"] = {"zero-1": {"rule": "zero", "witness": zero}}
    document["claims"] = ["zero-1"]


def deep(document: Document) -> None:
    value: Any = "x"
    for _ in range(100):
        value = ["sin", value]
    formula("F", value)(document)


def swapped_identity(document: Document) -> None:
    witness(document, "identity-1").update(right="3")


REJECTED = {
    "false_sign": (
        "the cubic > 0 on an interval that contains its root",
        "not proved on",
        changed("cubic", claim_in("sign-1", box=[["3/2", "3"]])),
    ),
    "range_too_narrow": (
        "the cubic's range on [-2, 2] without its maximum 3 and its value 3 at 2",
        "not proved on",
        changed("cubic", claim_in("range-1", bounds=["-2", "29/10"])),
    ),
    "monotone_past_the_turn": (
        "the cubic increasing from -2 to beyond its maximum at -1",
        "not proved on",
        changed("cubic", claim_in("monotone-1", box=[["-2", "-9/10"]])),
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
        changed("cubic", formula("F", ["log", "x"])),
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
    "false_identity": (
        "the second time derivative of the gap given as the first",
        "differ",
        changed("gap_identities", swapped_identity),
    ),
    "refuted_where_true": (
        "a refutation at a point where the claim holds",
        "not proved false",
        changed("refutations", set_in("refute-at-1", point=["0"])),
    ),
    "singular_h_set": (
        "an h-set without volume",
        "singular",
        changed("henon_horseshoe", set_in("h-set-1", matrix=[["1", "2"], ["2", "4"]])),
    ),
    "target_too_wide": (
        "an h-set that its images do not cross",
        "not proved on",
        changed("henon_horseshoe", set_in("h-set-1", matrix=[["47/100", "0"], ["0", "1/5"]])),
    ),
    "orientation_reversed": (
        "a covering relation of the other degree",
        "not proved on",
        changed("henon_horseshoe", set_in("covers-1", sign="-")),
    ),
    "no_horseshoe": (
        "the Henon map at a = 2, where the same sets have no such relations",
        "not proved on",
        changed("henon_horseshoe", formula("F", ["-", "1", ["*", "2", ["^", "x", "2"]]], "x")),
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
        changed("logistic", claim_in("expansion-1", bound="211/100")),
    ),
}

MALFORMED = {
    "huge_exponent": (
        "x^1000000000",
        "exponents",
        changed("cubic", formula("F", ["^", "x", "1000000000"])),
    ),
    "nested_deeply": ("100 sines in one another", "deep", changed("cubic", deep)),
    "unknown_variable": (
        "a variable that is not declared",
        "unknown variable",
        changed("cubic", formula("F", "z")),
    ),
    "unknown_operation": (
        "a function that the format does not have",
        "no operation",
        changed("cubic", formula("F", ["tan", "x"])),
    ),
    "number_not_canonical": (
        "6/4 in a formula",
        "lowest terms",
        changed("cubic", formula("F", "6/4")),
    ),
    "variable_named_like_a_function": (
        "a variable exp",
        "not a name for a variable",
        changed("cubic", lambda d: d["functions"]["F"].update(variables=["exp"])),
    ),
    "cut_outside": (
        "a subdivision whose cut is not in the box",
        "cut",
        changed("cubic", set_in("sign-1", tree=["1", "5", None, None])),
    ),
    "part_missing": (
        "a subdivision with one part",
        "entries",
        changed("cubic", set_in("sign-1", tree=["1", "2", None])),
    ),
    "reversed_box": (
        "a box from 3 to 8/5",
        "reversed",
        changed("cubic", claim_in("sign-1", box=[["3", "8/5"]])),
    ),
    "point_outside": (
        "a refutation at a point beside the box",
        "not in the box",
        changed("refutations", set_in("refute-at-1", point=["2"])),
    ),
    "later_step": (
        "a root whose monotone step comes later",
        "no earlier step",
        changed("cubic", lambda d: d.update(steps=dict(reversed(d["steps"].items())))),
    ),
    "unused_step": (
        "a true step that no claim uses",
        "nothing uses",
        changed("cubic", lambda d: d["claims"].remove("sign-1")),
    ),
    "claim_twice": (
        "a claim given twice",
        "twice",
        changed("cubic", lambda d: d["claims"].append("sign-1")),
    ),
    "relation_twice": (
        "a covering relation twice in a graph",
        "twice",
        changed("golden_mean", lambda d: witness(d, "graph-1")["covers"].append("covers-1")),
    ),
    "other_schema": (
        "a schema of the future",
        "schema",
        changed("cubic", lambda d: d.update(schema="impact-proofs.lemma/2")),
    ),
    "note_added": (
        "a field that the rule does not know",
        "unknown field",
        changed("cubic", set_in("sign-1", note="trust me")),
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
            "All are made by `python -m tests.proofs.trusted.kernel.lemma_corpus`; tests prove",
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
