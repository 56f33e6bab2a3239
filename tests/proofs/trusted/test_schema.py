"""The JSON Schema says the form of a certificate, as far as a schema can."""

import json
import re
from dataclasses import fields
from fractions import Fraction
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator
from proofs.trusted.GONE import STATEMENTS, Facts, quantities

from proofs.trusted.certificate import _MAX_DIGITS, _MAX_DIGITS_OF_PARAMETERS, SCHEMA
from proofs.trusted.flights import RULES
from proofs.trusted.numbers import TURN
from proofs.trusted.paper import GROUPS, rules_of
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict
from tests.proofs.trusted.mutations import mutations, outcome

ROOT = Path(__file__).parents[3]
ACCEPTED = ROOT / "tests/certificates/accepted/horseshoe.json"
CORPUS = sorted((ROOT / "tests/certificates").glob("[amr]*/*.json"))
FORM = json.loads((ROOT / "proofs/trusted/certificate.schema.json").read_text())
VALIDATOR = Draft202012Validator(FORM)

# Malformed files of the corpus that the schema does not refuse.
BEYOND = {
    "truncated": "no JSON",
    "not_json": "no JSON",
    "nested_deeply": "a parser gives up before the schema is asked",
    "duplicate_field": "a parser keeps one of two fields of the same name",
    "not_lowest_terms": "a pattern knows no divisors",
    "unused_step": "that a name occurs elsewhere",
}
# What the checker says of other malformed files that the schema lets pass.
UNSAYABLE = re.compile(
    r"not JSON|nested too deeply|characters; at most|a field is there twice"  # before the schema
    r"|not in lowest terms|reversed|must increase|between 0 and 2 pi|leaves \[0, 2 pi\)"
    r"|in increasing order|times beyond|must lie in the interval I|overlap"
    r"|expected \d+ to"  # so far orders and sizes
    r"|names no|nothing uses|other phases|do not continue|not the phase of that step"  # references
)


def valid(text):
    """Whether a text is JSON and of the schema's form; None if it is no JSON."""
    try:
        return VALIDATOR.is_valid(json.loads(text))
    except (ValueError, RecursionError):
        return None


def test_the_schema_is_one():
    Draft202012Validator.check_schema(FORM)
    assert FORM["properties"]["schema"] == {"const": SCHEMA}


def test_every_name_is_the_code_s():
    definitions = FORM["$defs"]
    steps = FORM["properties"]["steps"]
    assert steps["propertyNames"]["allOf"][1]["not"]["enum"] == list(RULES)
    named = [each["$ref"].rpartition("/")[2] for each in steps["additionalProperties"]["oneOf"]]
    assert named == [*RULES, "other-step"]
    assert [definitions[rule]["properties"]["rule"]["const"] for rule in RULES] == list(RULES)
    claim = definitions["claim"]["properties"]
    assert claim["id"]["enum"] == list(STATEMENTS)
    once = [part["contains"]["properties"]["id"]["const"] for part in
            FORM["properties"]["claims"]["allOf"]]  # fmt: skip
    assert once == list(STATEMENTS)
    other = definitions["other-claim"]["properties"]
    assert other["id"]["enum"] == [claim for claims in GROUPS.values() for claim in claims]
    assert other["verdict"]["enum"] == [verdict.value for verdict in Verdict]
    assert set(claim["verdict"]["enum"]) < set(other["verdict"]["enum"])
    groups = [rules_of(group) for group in GROUPS]
    names = dict.fromkeys(name for rules in groups for name in rules if name not in RULES)
    assert definitions["other-step"]["properties"]["rule"]["enum"] == list(names)
    assert definitions["parameters"]["required"] == [field.name for field in fields(Parameters)]
    assert definitions["number"]["maxLength"] == _MAX_DIGITS
    eta = definitions["parameters"]["properties"]["eta"]
    assert eta["allOf"][1]["maxLength"] == _MAX_DIGITS_OF_PARAMETERS


def test_every_quantity_is_named():
    some = (Fraction(1), TURN)
    facts = Facts({0: some, 1: some}, {0: some, 1: some}, {0: (some, some), 1: (some, some)})
    facts.s0 = facts.s0_reciprocal = some
    known = {name for claim in STATEMENTS for name in quantities(claim, facts)}
    named = FORM["$defs"]["claim"]["properties"]["quantities"]["propertyNames"]["enum"]
    assert set(named) == known and len(named) == len(known)


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_the_corpus(path):
    """Accepted and rejected certificates have the form, malformed ones not, but for BEYOND."""
    text = path.read_text()
    if SCHEMA not in text and "impact-proofs." in text[:100] and path.stem != "other_schema":
        pytest.skip("a file of another schema")
    well_formed = path.parent.name != "malformed" or path.stem in BEYOND
    assert bool(valid(text)) == well_formed or (valid(text) is None and path.stem in BEYOND)


def test_every_exception_is_of_the_corpus():
    assert set(BEYOND) <= {path.stem for path in CORPUS if path.parent.name == "malformed"}


def test_the_report_has_the_form():
    assert valid(ACCEPTED.read_text())


def compare(chosen):
    """Assert that the schema refuses nothing that is accepted, and what it can of the malformed."""
    refused = 0
    for mutation in chosen:
        text = mutation.make()
        found, reason, _ = outcome(text)
        form = valid(text)
        told = f"{mutation.kind} at {mutation.where}: {found}, {reason[:200]}"
        assert form is not False or found != "accepted", told
        assert not (form and found == "malformed") or UNSAYABLE.search(reason), told
        refused += form is False
    return refused


@pytest.fixture(scope="module")
def all_mutations():
    return list(mutations(json.loads(ACCEPTED.read_text())))


@pytest.mark.parametrize(
    ("one_in", "least"), [(684, 6), pytest.param(171, 25, marks=pytest.mark.slow)]
)
def test_changed_certificates(all_mutations, one_in, least):
    assert compare(all_mutations[::one_in]) > least


@pytest.mark.slow
@pytest.mark.usefixtures("remembered_clock")
def test_many_changed_certificates(all_mutations):
    assert compare(all_mutations[5::25]) > 200
