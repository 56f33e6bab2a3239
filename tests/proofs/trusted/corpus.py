"""The committed certificates: each file of tests/certificates, made from the accepted one.

From the root, `python -m tests.proofs.trusted.corpus` writes them again, after a change of the
schema or of a statement's words.
"""

import copy
import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

from proofs.trusted.certificate import SCHEMA, parameters_to_json
from proofs.trusted.certificate import render as text_of
from proofs.trusted.paper import find
from proofs.trusted.parameters import Parameters
from tests.proofs.trusted.mutations import Document, Edit
from tests.proofs.trusted.renewing import fresh, renewed

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
    """A file: what was changed, a part of the checker's message, and how to make it."""

    change: str
    message: str
    make: Callable[[Document], str]


def changing(*edits: Edit) -> Callable[[Document], str]:
    """Return the maker that edits a copy of the accepted certificate."""

    def make(document: Document) -> str:
        changed = copy.deepcopy(document)
        for edit in edits:
            edit(changed)
        return text_of(changed)

    return make


def only(*wanted: str) -> Edit:
    """Keep some claims, and the steps that they name."""

    def edit(document: Document) -> None:
        document["claims"] = [c for c in document["claims"] if c["id"] in wanted]
        reached = {name for claim in document["claims"] for name in claim["proof"]}
        for name, step in reversed(list(document["steps"].items())):
            if name in reached:
                reached.update(json.dumps(step).split('"'))
        document["steps"] = {n: s for n, s in document["steps"].items() if n in reached}

    return edit


def claim_of(document: Document, claim: str) -> Document:
    return next(entry for entry in document["claims"] if entry["id"] == claim)


def witness_of(document: Document, step: str) -> Document:
    witness: Document = document["steps"][step]["witness"]
    return witness


def first(document: Document, rule: str) -> str:
    return next(name for name, step in document["steps"].items() if step["rule"] == rule)


# -- rejected --------------------------------------------------------------------------------------


def bracket_moved(document: Document) -> None:
    witness = witness_of(document, "point-1")
    low, high = map(Fraction, witness["time"])
    witness["time"] = [str(high), str(2 * high - low)]


def earlier_impact_skipped(document: Document) -> None:
    early = ["1", "2", "4", "8", "12", "16", "20", "22", "24", "25"]
    late = ["27", "31", "35", "39", "43", "47", "51", "54", "55", "56", "57"]
    flight = witness_of(document, "slope-range-1")["points"][0]["flight"]
    witness_of(document, flight)["times"] = early + late


def launch_skipped(document: Document) -> None:
    flight = witness_of(document, "slope-range-1")["points"][0]["flight"]
    times = witness_of(document, flight)["times"]
    witness_of(document, flight)["times"] = [t for t in times if Fraction(t) > 20]


def verdict_flipped(document: Document) -> None:
    claim_of(document, "H2")["verdict"] = "VERIFIED"


def statement_softened(document: Document) -> None:
    claim = claim_of(document, "H2")
    claim["statement"] = claim["statement"].replace("5.25", "6.19")


def table_faster(document: Document) -> None:
    document["parameters"]["nu"] = "-2001/10000"


def gap_not_covered(document: Document) -> None:
    witness_of(document, "avoids-1")["flights"].pop()
    used = set(witness_of(document, "avoids-1")["flights"])
    document["steps"] = {
        n: s for n, s in document["steps"].items() if s["rule"] == "avoids" or n in used
    }


def target_narrowed(document: Document) -> None:
    low, high = witness_of(document, "avoids-1")["target"]
    witness_of(document, "avoids-1")["target"] = [low, str(Fraction(high) - Fraction(1, 100))]


def root_off(document: Document) -> None:
    witness = witness_of(document, "moran-root-1")
    witness["root"] = [str(Fraction(end) + Fraction(1, 10**25)) for end in witness["root"]]


def root_unread(document: Document) -> None:
    for step in document["steps"].values():
        step["witness"]["root"] = ["2/5", "1/2"]
    claim_of(document, "H11").update(verdict="REFUTED", quantities={})


def ratios_without_places(document: Document) -> None:
    document["parameters"].update(ratios=["1/3", "3/7"], printed_s0=None)
    witness = witness_of(document, "moran-root-1")
    witness.update(ratios=["1/3", "3/7"], root=["71/100", "18/25"])
    claim = claim_of(document, "H11")
    claim.update(statement=renewed(document)["claims"][0]["statement"], quantities={})


def witness_elsewhere(document: Document) -> None:
    first, second = claim_of(document, "H1"), claim_of(document, "H2")
    for name in ("verdict", "proof", "why", "witness", "corrected"):
        first[name] = second[name]


def quantity_tightened(document: Document) -> None:
    bounds = claim_of(document, "H1")["quantities"]["slope_min_I0"]
    bounds["lower"] = bounds["upper"]


def corrected_interval_widened(document: Document) -> None:
    witness_of(document, first(document, "staying-set"))["region"] = [["11/10", "133/100"]]


def corrected_sets_printed(document: Document) -> None:
    witness = witness_of(document, first(document, "staying-set"))
    witness["cells"][0]["domain"] = ["111/100", "23/20"]
    witness["region"] = [["111/100", "33/25"]]


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

    All lie just after phase 0, none in I; but the wide brackets at 0.756 and 0.77 reach back
    before 2 pi, so that the lower ends of f, mod 2 pi, are near 6.28.
    """
    early = ["1", "2", "4", "8", "12", "16", "20", "22", "24", "97/4"]

    def impacts(phases: tuple[Fraction, Fraction], *times: str) -> Document:
        ends = [str(Fraction(t)) for t in times]
        witness = {"phases": [str(x) for x in phases], "times": early + ends}
        return {"rule": "first-impact", "witness": witness}

    def slopes(flight: str, ends: tuple[Fraction, Fraction], *times: str) -> Document:
        pairs = [[str(Fraction(t)) for t in pair.split()] for pair in times]
        points = [
            {"flight": flight, "phase": str(end), "time": pair}
            for end, pair in zip(ends, pairs, strict=False)
        ]
        pieces = [{"flight": flight, "time": pairs[2]}]
        return {"rule": "slope-range", "witness": {"points": points, "pieces": pieces}}

    target = [str(end) for end in FALSE.interval]
    document["parameters"] = parameters_to_json(FALSE)
    document["steps"] = {
        "first-impact-1": impacts(FALSE.left, "24.35", "24.5"),
        "slope-range-1": slopes(
            "first-impact-1", FALSE.left, "24.3814 24.3815", "24.3749 24.3875", "24.38 24.3888"
        ),
        "first-impact-2": impacts(FALSE.right, "24.34", "24.5"),
        "slope-range-2": slopes(
            "first-impact-2", FALSE.right, "24.4022 24.4024", "24.36 24.4085", "24.4 24.41"
        ),
        "first-impact-3": impacts(FALSE.gap, "24.375", "24.39", "24.42"),
        "avoids-1": {
            "rule": "avoids",
            "witness": {"flights": ["first-impact-3"], "target": target},
        },
    }
    parts = zip(("slope-range-1", "slope-range-2"), (FALSE.left, FALSE.right), strict=True)
    cells = [{"slopes": name, "domain": [str(x) for x in part]} for name, part in parts]
    witness = {"region": [target], "cells": cells, "gaps": ["avoids-1"]}
    document["steps"]["staying-set-1"] = {"rule": "staying-set", "witness": witness}
    text = {"verdict": "VERIFIED", "why": "", "witness": None, "corrected": None}
    statement = find("H5").says(FALSE)
    document["claims"] = [
        {"id": "H5", "statement": statement, "proof": ["staying-set-1"], "quantities": {}, **text}
    ]


# -- malformed -------------------------------------------------------------------------------------


def unused_step(document: Document) -> None:
    step = {"ratios": ["1/10", "1/5"], "root": ["1/10", "1"]}
    document["steps"]["moran-root-9"] = {"rule": "moran-root", "witness": step}


def step_named_like_output(document: Document) -> None:
    name = "x\nhorseshoe.json: accepted, the paper's parameters\n  H2   VERIFIED  f' <= 5.25"
    document["steps"] = {name: document["steps"]["moran-root-1"], **document["steps"]}


def claim_twice(document: Document) -> None:
    document["claims"] *= 2


def note_added(document: Document) -> None:
    document["claims"][0]["note"] = "checked by hand"


H16 = changing(only("H16"))
H11 = only("H11")

CORPUS: dict[str, Entry] = {
    "accepted/horseshoe": Entry("nothing: the whole certificate", "", changing()),
    "accepted/h16_alone": Entry("one claim only, with no step to prove", "", H16),
    "accepted/h11_alone": Entry("one claim only, and its steps", "", changing(H11)),
    "rejected/bracket_moved": Entry(
        "H2's impact bracket moved up by its width",
        "signs +, -",
        changing(only("H2"), bracket_moved),
    ),
    "rejected/earlier_impact_skipped": Entry(
        "the times of I0's flights step over the first impact at 25.2, to the next near 56",
        "not transversal",
        changing(only("H1"), earlier_impact_skipped),
    ),
    "rejected/launch_skipped": Entry(
        "the times of I0's flights begin after 20: nothing excludes an earlier impact",
        "leave the table",
        changing(only("H1"), launch_skipped),
    ),
    "rejected/verdict_flipped": Entry(
        "H2 VERIFIED instead of REFUTED",
        "gives 'REFUTED'",
        changing(only("H2"), verdict_flipped),
    ),
    "rejected/statement_softened": Entry(
        "H2 with 6.19 in its words, 5.25 in the parameters",
        "the proof of H2 gives",
        changing(only("H2"), statement_softened),
    ),
    "rejected/other_nu": Entry(
        "nu = -0.2001 in the parameters, the witnesses of -0.2",
        "signs +, -",
        changing(only("H1"), table_faster),
    ),
    "rejected/gap_not_covered": Entry(
        "the last flight of H4's gap dropped",
        "the proof of H",
        changing(only("H4"), gap_not_covered),
    ),
    "rejected/target_narrowed": Entry(
        "H4's gap is proved to avoid a part of I only",
        "the proof of H",
        changing(only("H4"), target_narrowed),
    ),
    "rejected/root_off": Entry(
        "the bracket of s_0 moved up by 1e-25", "signs +, -", changing(H11, root_off)
    ),
    "rejected/root_unread": Entry(
        "H11 REFUTED with the bracket 0.4 to 0.5, whose ends do not round to 0.449",
        "the proof of H",
        changing(H11, root_unread),
    ),
    "rejected/ratios_without_places": Entry(
        "H11 with the ratios 1/3 and 3/7 for 1/5.25 and 1/4.2, 'to the places given'",
        "the proof of H11",
        changing(H11, ratios_without_places),
    ),
    "rejected/witness_elsewhere": Entry(
        "H2's witness and proof put under H1, which holds",
        "the proof of H1 gives",
        changing(only("H1", "H2"), witness_elsewhere),
    ),
    "rejected/quantity_tightened": Entry(
        "one lower bound raised to its upper bound",
        "do not contain",
        changing(only("H1"), quantity_tightened),
    ),
    "rejected/corrected_interval_widened": Entry(
        "the corrected theorem on a wider I, which the gap is not proved to avoid",
        "to avoid the region",
        changing(corrected_interval_widened),
    ),
    "rejected/corrected_sets_printed": Entry(
        "the corrected theorem on the printed I0, whose image does not cover I",
        "neither covered nor missed",
        changing(corrected_sets_printed),
    ),
    "rejected/false_horseshoe": Entry(
        "a horseshoe where there is none: images just after phase 0, in brackets across 2 pi",
        "straddles 2 pi",
        changing(false_horseshoe),
    ),
    "malformed/truncated": Entry(
        "the first half of the file", "not JSON", lambda d: text_of(d)[: len(text_of(d)) // 2]
    ),
    "malformed/not_json": Entry("a sentence", "not JSON", lambda d: "All claims are verified.\n"),
    "malformed/other_schema": Entry(
        "a schema of the future", "schema", lambda d: H16(d).replace(SCHEMA, SCHEMA + "1")
    ),
    "malformed/bare_number": Entry(
        "nu = -0.2 as a JSON number", "bare JSON number", lambda d: H16(d).replace('"-1/5"', "-0.2")
    ),
    "malformed/not_lowest_terms": Entry(
        "nu = -2/10", "lowest terms", lambda d: H16(d).replace('"-1/5"', '"-2/10"')
    ),
    "malformed/plus_sign": Entry(
        "eta = +2121/10000", "canonical", lambda d: H16(d).replace('"2121/', '"+2121/')
    ),
    "malformed/duplicate_field": Entry(
        "two verdicts in one claim",
        "twice",
        lambda d: H16(d).replace('"verdict"', '"verdict": "REFUTED",\n   "verdict"'),
    ),
    "malformed/note_added": Entry(
        "a field that the schema does not know", "unknown field", changing(only("H16"), note_added)
    ),
    "malformed/nested_deeply": Entry(
        "50,000 lists in one another",
        "nested too deeply",
        lambda d: H16(d).replace('"0.449"', "[" * 50_000 + "]" * 50_000),
    ),
    "malformed/step_named_like_output": Entry(
        "a step whose name contains lines that look like the checker's",
        "not a name",
        changing(H11, step_named_like_output),
    ),
    "malformed/unused_step": Entry(
        "a true step that no claim uses", "nothing uses", changing(H11, unused_step)
    ),
    "malformed/claim_twice": Entry(
        "a claim given twice", "appears twice", changing(only("H16"), claim_twice)
    ),
}


def path_of(name: str) -> Path:
    return FOLDER / f"{name}.json"


def accepted() -> Document:
    """Return the committed certificate that the others are made from."""
    document: Document = json.loads(path_of("accepted/horseshoe").read_text(encoding="utf-8"))
    return document


def readme() -> str:
    """Return the folder's README."""
    lines = [
        "# Certificates that the checker must accept, reject, or call malformed",
        "",
        "`python -m proofs check FILE` leaves with status 0 for `accepted/`, 1 for `rejected/` (it",
        "is a certificate, and does not prove what it says) and 2 for `malformed/`. All are made",
        "from `accepted/horseshoe.json` by `python -m tests.proofs.trusted.corpus`; `tests`",
        "prove them up to date.",
        "",
        "| file | what was changed |",
        "|---|---|",
        *(f"| `{name}.json` | {entry.change} |" for name, entry in CORPUS.items()),
    ]
    return "\n".join(lines) + "\n"


def write() -> None:
    """Write all files, from a fresh certificate of the paper's claims."""
    document = fresh()
    for name, entry in CORPUS.items():
        path = path_of(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(entry.make(document), encoding="utf-8")
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")


if __name__ == "__main__":
    write()
