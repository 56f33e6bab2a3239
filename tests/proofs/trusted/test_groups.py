"""The committed certificates of every group: accepted, listed, and not to be talked into more."""

import copy
import json
import random
import re
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import pytest

from proofs.shell.groups import MANIFEST_NAME, produce
from proofs.trusted import paper as catalogue
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper import GROUPS
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import RULES, find_rule
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, _check_claim
from tests.once import REPORTS, report
from tests.proofs.trusted.renewing import REFUSED, rederived

VERDICTS = {
    "VERIFIED": "H1 H3 H4 H6 H8 H9 H10 H12 H16 H18 M1 M2 M3 M4 N2 N3 N5 G1 G3 G4 G5 G6 G9 G13 G14 "
    "G15 G16 G17 G18 G19 P1 P3 S1 S2 S4 S6 S7 S9 S12 S20 S23 R10 R12",
    "REFUTED": "H2 H5 H7 H13 H14 H15 H17 M5 M7 A1 N1 N4 G10 G11 G12 G20 P5 P6 S3 S5 S13 S14 S15 "
    "S16 S17 S18 S19 S21 S22 R3 R4 R7 R8 R9 R11 R13",
    "CONDITIONAL": "H11 M6 M8 M9 A2 G2 G7 P2 P4 S8 S10 S11 R1 R2 R5 R6",
    "SIMULATED": "G8 E1",
}
VERDICT_OF = {claim: verdict for verdict, claims in VERDICTS.items() for claim in claims.split()}
ANYWHERE = {"foundations", "single", "soft", "resonance"}  # about all oscillators
ANYWHERE |= {"H11", "H12", "H14", "N4"}  # about ratios, a linear map, a box
EXACT = {"H15", "H16", "H17", "A2"}  # decided by exact arithmetic on the paper's numbers
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
    listed = json.loads((REPORTS / MANIFEST_NAME).read_text())["files"][f"{group}.json"]["claims"]
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


NEEDED = {  # the rules of whatever is needed, where there are other witnesses or more is said
    "H2": "differential",
    "H5": "slopes",
    "N1": "",
    "N3": "horseshoe",
    "N4": "barred-word",
    "N5": "horseshoe",
    "H13": "moran-root staying-set",
    "G5": "staying-set",
    "G11": "staying-set",
    "G20": "staying-set",
    "M6": "never-impacts",
    "A1": "formula-equal formula-series formula-value",
    "P4": "formula-equal single-solution",
    "G4": "absorption",
    "G6": "absorption staying-set",
    "G10": "absorption",
    "G13": "absorption",
    "G18": "itinerary-graph expansion",
    "H18": "grazing",
    "G7": "superstable-motion",
    "G12": "superstable-motion",
    "G16": "superstable-motion stable-cycle",
}


@pytest.mark.parametrize(
    "group", [pytest.param(g, marks=[pytest.mark.slow] * (g in SLOW)) for g in GROUPS]
)
def test_without_any_part_of_its_proof_or_elsewhere_a_claim_is_undecided(group):
    known, of, steps = proved(group).known, proved(group).parameters, document(group)["steps"]
    elsewhere = replace(of, eta=of.eta + Fraction(1, 10**6))

    def verdict(names, oscillator=of):
        return catalogue.find(claim).decide(oscillator, [known[name] for name in names]).verdict

    for claim, proof in ((entry["id"], entry["proof"]) for entry in document(group)["claims"]):
        assert verdict(proof).value == VERDICT_OF[claim]
        needed = {
            name for name in proof if verdict([x for x in proof if x != name]) is Verdict.UNDECIDED
        }
        if claim in NEEDED:
            assert {steps[name]["rule"] for name in needed} == {*NEEDED[claim].split()}, claim
        else:
            assert needed == {*proof}, claim
        if (
            not ANYWHERE & {group, claim}
            and claim not in EXACT
            and VERDICT_OF[claim] != "SIMULATED"
        ):
            assert verdict(proof, elsewhere) is Verdict.UNDECIDED, claim


@pytest.mark.slow
@pytest.mark.parametrize("group", ["foundations", "single", "soft", "resonance", "chaos", "circle"])
def test_the_prover_finds_all_of_it_today(group):
    """Of the others the tests of their sections ask the prover."""
    made = produce({group: GROUPS[group]}, PAPER, digits=20)
    assert {line.id: line.verdict.value for line in made.lines} == {
        claim: VERDICT_OF[claim] for claim in GROUPS[group]
    }


SWAPS = [(" + ", " - "), (" - ", " + "), ("sin", "cos"), ("cos", "sin"), ("2", "3"), ("*", "/")]
SWAPS += [("epsilon", "rho"), ("omega_n", "omega"), ("psi1", "psi"), ("h", "j")]


def bent(text, chance):
    """A formula with one thing changed: a sign, a digit, a function, a variable."""
    old, new = chance.choice([x for x in SWAPS if x[0] in text] or [(text, f"({text}) + 1")])
    place = chance.choice([i for i in range(len(text)) if text.startswith(old, i)])
    return text[:place] + new + text[place + len(old) :]


@pytest.mark.slow
@pytest.mark.parametrize(("group", "each"), [("foundations", 1), ("soft", 3), ("resonance", 2)])
def test_bent_formulas_prove_no_claim(group, each):
    """The step fails, or the verdict does."""
    whole, chance = document(group), random.Random(5)
    for name in list(whole["steps"])[::each]:
        entries = [entry for entry in whole["claims"] if name in entry["proof"]]
        entry = min(entries, key=lambda one: len(one["proof"]))
        steps = {**whole["steps"], name: copy.deepcopy(whole["steps"][name])}
        witness = steps[name]["witness"]
        witness = witness.get("expressions", witness)
        texts = [key for key, text in witness.items() if isinstance(text, str)]
        if not texts:
            continue
        field = chance.choice(texts)
        witness[field] = bent(witness[field], chance)
        with pytest.raises(REFUSED):
            _check_claim(rederived(proved(group), steps, name), Reader(entry), set())
            pytest.fail(f"accepted {name}: {witness[field]}")


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
