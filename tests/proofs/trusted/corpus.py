"""Certificates that are accepted, rejected or malformed, from the table of tests/certificates.

From the root, `python -m tests.proofs.trusted.corpus DIR` writes them all, for another checker.
"""

import copy
import json
import os
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from proofs.trusted.certificate import SCHEMA
from proofs.trusted.files import parameters_to_json, render
from proofs.trusted.paper import find
from proofs.trusted.parameters import Parameters
from tests.once import FOLDER as OF_THIS_RUN
from tests.proofs.trusted.edits import Document, lie
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

VERDICTS = {  # of the accepted certificate, at the paper's numbers
    "H1": "VERIFIED",
    "H2": "REFUTED",
    "H3": "VERIFIED",
    "H4": "VERIFIED",
    "H5": "REFUTED",
    "H6": "VERIFIED",
    "H11": "CONDITIONAL",
    "H16": "VERIFIED",
}
FOLDER = Path(__file__).parents[2] / "certificates"


class Entry(NamedTuple):
    """A file: the claims or the example it is made from, the edit, a part of the message."""

    source: str
    edit: str
    message: str

    def make(self) -> str:
        """The file's text."""
        document = _source(self.source)
        if self.edit in TEXTS:
            return TEXTS[self.edit](render(document))
        if self.edit in MADE:
            MADE[self.edit](document)
        elif self.edit:
            lie(self.edit)(document)
        return render(document)


def _source(name: str) -> Document:
    if name in EXAMPLES:
        return json.loads(text(name))
    if name == "nothing":
        document = {"schema": SCHEMA, "parameters": None, "functions": {}, "steps": {}}
        return {**document, "claims": ["step"]}
    document = accepted()
    only(*name.split())(document)
    return document


def only(*wanted: str) -> Callable[[Document], None]:
    """Keep some claims, and the steps that they name."""

    def edit(document: Document) -> None:
        document["claims"] = [c for c in document["claims"] if c["id"] in wanted]
        reached = {name for claim in document["claims"] for name in claim["proof"]}
        for name, step in reversed(list(document["steps"].items())):
            if name in reached:
                reached.update(json.dumps(step).split('"'))
        document["steps"] = {n: s for n, s in document["steps"].items() if n in reached}

    return edit


def path_of(name: str) -> Path:
    """A file of the table, which is written once in a run of the tests."""
    path = Path(os.environ[OF_THIS_RUN]) / f"corpus/{name}.json"
    if not path.exists():
        _write(path, CORPUS[name].make())
    return path


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{os.getpid()}")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def accepted() -> Document:
    """Return the committed certificate that the others are made from."""
    document: Document = json.loads((FOLDER / "horseshoe.json").read_text(encoding="utf-8"))
    return document


def entries() -> dict[str, Entry]:
    """The files of the table, and the examples of lemmas."""
    found = {f"lemmas/accepted/{name}": Entry(name, "", "") for name in EXAMPLES}
    for line in (FOLDER / "README.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if line.startswith("| `"):
            name, source, edit, message, _ = cells
            found[name.strip("`")] = Entry(source, edit.strip("`"), message)
    return found


# -- what no line says -----------------------------------------------------------------------------


def softened(document: Document) -> None:
    (claim,) = document["claims"]
    claim["statement"] = claim["statement"].replace("5.25", "6.19")


def witness_elsewhere(document: Document) -> None:
    first, second = document["claims"]
    for name in ("verdict", "proof", "why", "witness", "corrected"):
        first[name] = second[name]


def quantity_tightened(document: Document) -> None:
    bounds = document["claims"][0]["quantities"]["slope_min_I0"]
    bounds["lower"] = bounds["upper"]


def step_named_like_output(document: Document) -> None:
    name = "x\nhorseshoe.json: accepted, the paper's parameters\n  H2   VERIFIED  f' <= 5.25"
    document["steps"] = {name: document["steps"]["moran-root-1"], **document["steps"]}


def twin_sets(document: Document) -> None:
    """The second set and its relations like the first: nothing is told apart."""
    steps = document["steps"]
    steps["h-set-2"] = steps["h-set-1"]
    for new, old in (("covers-3", "covers-1"), ("covers-4", "covers-2")):
        steps[new]["witness"] = copy.deepcopy(steps[old]["witness"]) | {"source": "h-set-2"}
        steps[new]["witness"]["target"] = "h-set-1" if new == "covers-3" else "h-set-2"
    document["steps"] = {x: y for x, y in steps.items() if not x.startswith(("e", "cone", "v"))}
    document["claims"] = ["graph-1"]


FALSE = Parameters(
    eta=Fraction("0.2121"),
    nu=Fraction("-0.2"),
    left=(Fraction("0.752"), Fraction("0.756")),
    right=(Fraction("0.766"), Fraction("0.77")),
    interval=(Fraction("0.752"), Fraction("0.77")),
    slopes=(Fraction(2), Fraction(3)),
)


def false_horseshoe(document: Document) -> None:
    """True images: f(0.752) = 0.0006..., f(0.756) = 0.0106..., f(0.766) = 0.0355..., 0.0455...

    All lie just after phase 0, none in I.
    """

    def about(rule: str, ends: tuple[Fraction, Fraction], **fields: Any) -> Document:
        at = {"eta": [str(FALSE.eta)] * 2, "nu": [str(FALSE.nu)] * 2}
        points = [str(end) for end in ends]
        return {"rule": rule, "witness": {"function": at, "points": points, **fields}}

    target = [str(end) for end in FALSE.interval]
    document["parameters"] = parameters_to_json(FALSE)
    document["steps"] = {
        "slopes-1": about("slopes", FALSE.left, bits="64"),
        "slopes-2": about("slopes", FALSE.right, bits="64"),
        "avoids-1": about("avoids", FALSE.gap, target=target),
    }
    parts = zip(("slopes-1", "slopes-2"), (FALSE.left, FALSE.right), strict=True)
    cells = [{"slopes": name, "domain": [str(x) for x in part]} for name, part in parts]
    witness = {"region": [target], "cells": cells, "gaps": ["avoids-1"]}
    document["steps"]["staying-set-1"] = {"rule": "staying-set", "witness": witness}
    text = {"verdict": "VERIFIED", "why": "", "witness": None, "corrected": None}
    statement = find("H5").says(FALSE)
    document["claims"] = [
        {"id": "H5", "statement": statement, "proof": ["staying-set-1"], "quantities": {}, **text}
    ]


MADE = {
    each.__name__: each
    for each in (
        softened,
        witness_elsewhere,
        quantity_tightened,
        step_named_like_output,
        twin_sets,
        false_horseshoe,
    )
}
TEXTS: dict[str, Callable[[str], str]] = {
    "truncated": lambda text: text[: len(text) // 2],
    "not_json": lambda text: "All claims are verified.\n",
    "bare_number": lambda text: text.replace('"-1/5"', "-0.2"),
    "verdict_twice": lambda text: text.replace('"verdict"', '"verdict": "REFUTED",\n   "verdict"'),
    "nested_deeply": lambda text: text.replace('"0.449"', "[" * 50_000 + "]" * 50_000),
}
CORPUS = entries()


if __name__ == "__main__":
    for every, made in CORPUS.items():
        _write(Path(sys.argv[1]) / f"{every}.json", made.make())
