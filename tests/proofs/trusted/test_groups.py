"""The committed certificates of every group: accepted, listed, and not to be talked into more."""

import json
import re
from decimal import Decimal

import pytest

from proofs.shell.manifest import NAME
from proofs.trusted import paper as catalogue
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import RULES, find_rule
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, _check_claim
from tests.once import REPORTS, report

REFUSED = (Malformed, Rejected)
EXACT = {"H15", "H16", "H17", "A2"}  # decided by exact arithmetic on the paper's numbers
SPARE = {(claim, "separation-1") for claim in ("G4", "G6", "G10", "G13")}  # absorption has the arc
SLOW = {
    "nonplastic",
    "dimension",
    "chaos",
    "circle",
    "entropy",
    "soft",
}  # slow checks


def document(group):
    return json.loads((REPORTS / f"{group}.json").read_text())


def proved(group):
    """What the steps of a group's certificate prove."""
    return report(group).context


def judged(group, entry):
    """What the checker makes of an entry, the steps being those of the certificate."""
    try:
        return _check_claim(proved(group), Reader(entry), set())
    except Unproved as error:
        raise Rejected(str(error)) from None


def refused(group, entry, **changes):
    with pytest.raises(REFUSED):
        pytest.fail(f"accepted: {judged(group, {**entry, **changes})}: {changes}")


@pytest.mark.parametrize("group", GROUPS)
def test_every_claim_of_a_group_is_in_its_file_and_in_the_manifest(group):
    given = document(group)
    entries = given["claims"]
    assert tuple(entry["id"] for entry in entries)[: len(GROUPS[group])] == GROUPS[group]
    listed = json.loads((REPORTS / NAME).read_text())["files"][f"{group}.json"]["claims"]
    for entry in entries:
        assert listed[entry["id"]]["verdict"] == entry["verdict"]
        assert entry["statement"] and not re.search(r"\{[a-z0-9]+\}", entry["statement"])


@pytest.mark.parametrize("group", GROUPS)
def test_what_is_refuted_has_a_witness_and_what_is_proved_a_proof(group):
    for entry in document(group)["claims"]:
        if entry["verdict"] in ("REFUTED", "CONDITIONAL"):
            assert entry["witness"], entry["id"]
        if entry["verdict"] in ("REFUTED", "CONDITIONAL", "VERIFIED"):
            assert entry["proof"] or entry["id"] in EXACT, entry["id"]


@pytest.mark.parametrize(
    "group", [pytest.param(g, marks=[pytest.mark.slow] * (g in SLOW)) for g in GROUPS]
)
def test_nothing_in_an_entry_is_believed(group):
    """Every text is recomputed, every bound must contain what is proved."""
    for entry in document(group)["claims"]:
        assert judged(group, entry).verdict.value == entry["verdict"]
        for name in ("statement", "verdict", "why", "witness", "corrected"):
            text = entry[name]
            refused(group, entry, **{name: "VERIFIED " if text is None else text + " "})
            if text is not None:
                refused(group, entry, **{name: None})
        for verdict in Verdict:
            if verdict.value != entry["verdict"]:
                refused(group, entry, verdict=verdict.value)
        for name, bounds in entry["quantities"].items():
            beyond = Decimal(bounds["upper"]) + 1
            moved = {"lower": f"{beyond:f}", "upper": f"{beyond + 1:f}"}
            refused(group, entry, quantities={name: moved})
            refused(group, entry, quantities={"other": bounds})
            if bounds["lower"] != bounds["upper"]:
                refused(group, entry, quantities={name: {**bounds, "lower": bounds["upper"]}})
        for name in entry["proof"]:
            if (entry["id"], name) not in SPARE:
                refused(group, entry, proof=[step for step in entry["proof"] if step != name])
        if entry["proof"]:
            refused(group, entry, proof=[])


@pytest.mark.parametrize("group", GROUPS)
def test_without_conclusions_nothing_is_decided_but_a_simulation(group):
    for claim in GROUPS[group]:
        decided = catalogue.find(claim).decide(PAPER, [])
        open_ones = (Verdict.UNDECIDED, Verdict.SIMULATED)
        assert decided.verdict in open_ones or claim in EXACT, claim
        assert decided.why


def test_every_rule_of_the_table_is_there_and_says_what_it_is():
    for name in RULES:
        assert find_rule(name).__doc__.startswith(f"Rule `{name}`: "), name
    assert find_rule("believe") is None
