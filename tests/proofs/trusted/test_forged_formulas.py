"""Formulas as a forger writes them, all texts renewed: no sentence is hers, and none is false."""

import copy
import json
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from proofs.check import main
from proofs.trusted.certificate import SCHEMA, Malformed
from proofs.trusted.files import digest, render
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.renewing import renewed

REPORTS = Path(__file__).parents[3] / "reports"
REFUSED = (Malformed, Rejected)


@cache
def committed(name):
    return json.loads((REPORTS / f"{name}.json").read_text(encoding="utf-8"))


def lemma_file(steps, claims=("step",), functions=()):
    document = {"schema": SCHEMA, "parameters": None, "functions": dict(functions)}
    return render({**document, "steps": steps, "claims": list(claims)})


def formula_step(rule, **witness):
    return lemma_file({"step": {"rule": rule, "witness": witness}})


def with_expression(name, unknown, text):
    """A file of the paper's claims with another text for one expression, as the checker says it."""
    document = copy.deepcopy(committed(name))
    given = [
        step["witness"]["expressions"]
        for step in document["steps"].values()
        if unknown in step["witness"].get("expressions", ())
    ]
    assert given
    for each in given:
        each[unknown] = text
    return render(renewed(document))


def theorems(source):
    """What a file's decided claims say."""
    found = {each.id: each for each in check(source).claims}
    return {
        name: (each.why, each.corrected)
        for name, each in found.items()
        if each.verdict.value != "UNDECIDED"
    }


EQUAL = [  # the same function, in other words; bound names and factors that read as others
    ("resonance", "f12", "-2*-epsilon"),
    ("resonance", "f12", "at(2*epsilon, truth=1)"),
    ("resonance", "f12", "at(2*epsilon, the_paper_is_right_after_all=1)"),
    ("resonance", "o12", "epsilon*1"),
    pytest.param("soft", "j12", "-epsilon*(1+epsilon)/2", marks=pytest.mark.long),
    ("soft", "lam", "-1*c"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "unknown", "text"), EQUAL)
def test_equal_spellings_say_the_same_or_decide_nothing(name, unknown, text):
    said = theorems(render(committed(name)))
    try:
        forged = theorems(with_expression(name, unknown, text))
    except REFUSED:
        return
    assert forged.items() <= said.items()


# -- the order of keys, and older files ------------------------------------------------------------


def test_files_of_one_digest_say_the_same():
    """The order of steps and of expressions is part of the proof, and of what is said."""
    lemma = {"left": "a + b", "right": "2*x"}
    one, two = (
        formula_step("formula-solution", expressions=given, lemmas=[lemma])
        for given in ({"a": "x", "b": "x"}, {"b": "x", "a": "x"})
    )
    assert check(one).sentences != check(two).sentences and digest(one) != digest(two)
    document = committed("resonance")
    assert digest(render(document)) == digest(json.dumps(document))
    turned = {**document, "steps": dict(reversed(document["steps"].items()))}
    assert digest(render(turned)) != digest(render(document))


def test_an_older_file_is_refused_in_a_line(tmp_path, capsys):
    path = tmp_path / "old.json"
    path.write_text(render(committed("sets")).replace(SCHEMA, SCHEMA[:-1] + "3"), encoding="utf-8")
    assert main([str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert SCHEMA in line and "python -m proofs ledger --fresh" in line


# -- points for intervals --------------------------------------------------------------------------


def test_a_cell_that_is_a_point_is_no_cell():
    """[x, x] where f' is bounded between points of a step of the rule slopes."""
    document = copy.deepcopy(committed("horseshoe"))
    name, step = next(
        (name, step) for name, step in document["steps"].items() if step["rule"] == "slopes"
    )
    point = str(Fraction(step["witness"]["points"][0]))
    cell = {"slopes": name, "domain": [point, point]}
    for rule, witness in (
        ("stable-orbit", {"cells": [cell]}),
        ("staying-set", {"region": [[point, "2"]], "cells": [cell], "gaps": []}),
        ("sticking-motion", {"flight": name, "cells": [cell], "beyond": cell}),
    ):
        document["steps"]["point-cell"] = {"rule": rule, "witness": witness}
        with pytest.raises(REFUSED):
            check(render(document))
