"""Section 5: the verdicts, the map iterated at 50 digits beside them, and bent certificates."""

import copy
import json
import random
from fractions import Fraction

import pytest

from proofs.search.derivations import Steps
from proofs.search.s5_soft import prove
from proofs.shell import groups
from proofs.trusted.certificate import Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.values import Equal, Series, equal
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.formulas import differ
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import soft, stability
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, _check_claim, check
from tests.once import REPORTS, report
from tests.oracles.algebra import agrees
from tests.proofs.trusted.renewing import REFUSED, rederived

CLAIMS = GROUPS["soft"]
ROWS = (*soft.ROWS, *stability.ROWS)
VERDICTS = {
    "VERIFIED": "S1 S2 S4 S6 S7 S9 S12 S20 S23",
    "REFUTED": "S3 S5 S13 S14 S15 S16 S17 S18 S19 S21 S22",
    "CONDITIONAL": "S8 S10 S11",
}


def certificate(*claims):
    made = groups.produce({"soft": claims or CLAIMS}, PAPER, digits=20)
    return json.loads(made.certificate)


@pytest.mark.slow
def test_every_claim_and_its_verdict():
    document = certificate()
    assert tuple(f"S{n}" for n in range(1, 24)) == CLAIMS
    found = {claim.id: claim.verdict.value for claim in check(render(document)).claims}
    assert found == {name: word for word, names in VERDICTS.items() for name in names.split()}
    for entry in document["claims"]:
        refuted = entry["verdict"] == "REFUTED"
        assert not refuted or (entry["witness"] and entry["corrected"])
    assert len(render(document)) < 100_000


@pytest.mark.slow
@pytest.mark.parametrize("each", [5, pytest.param(1, marks=pytest.mark.long)])
def test_sympy_proves_every_lemma(each):
    lemmas = [x for row in ROWS for x in row.needs if isinstance(x, Equal | Series)]
    assert all(map(agrees, lemmas[::each]))


@pytest.mark.slow
def test_every_lemma_that_is_needed_is_proved():
    evidence = prove(PAPER, CLAIMS, digits=20)
    for row in ROWS:
        assert len(evidence.proofs[row.id]) == len(row.needs), row.id


def test_one_claim_at_a_time():
    document = certificate("S21")
    assert [entry["id"] for entry in document["claims"]] == ["S21"]
    assert [claim.verdict.value for claim in check(render(document)).claims] == ["REFUTED"]


# -- bent certificates -----------------------------------------------------------------------------


def _bent(text, chance):
    """Return a formula with one thing changed: a sign, a digit, a function, a variable."""
    swaps = [(" + ", " - "), (" - ", " + "), ("sin", "cos"), ("cos", "sin"), ("2", "3")]
    swaps += [("*", "/"), ("epsilon", "rho"), ("omega_n", "omega"), ("psi1", "psi"), ("h", "j")]
    swaps = [(old, new) for old, new in swaps if old in text]
    old, new = chance.choice(swaps or [(text, f"({text}) + 1")])
    places = [i for i in range(len(text)) if text.startswith(old, i)]
    place = chance.choice(places)
    return text[:place] + new + text[place + len(old) :]


@pytest.mark.slow
def test_bent_formulas_are_refused():
    """No step with another formula proves the claim: the step fails, or the verdict does."""
    whole, chance, tried = json.loads((REPORTS / "soft.json").read_text()), random.Random(5), 0
    proved = report("soft").context
    for name in list(whole["steps"])[::3]:
        entries = [entry for entry in whole["claims"] if name in entry["proof"]]
        entry = min(entries, key=lambda one: len(one["proof"]))
        steps = {**whole["steps"], name: copy.deepcopy(whole["steps"][name])}
        witness = steps[name]["witness"]
        witness = witness.get("expressions", witness)
        field = chance.choice([key for key, text in witness.items() if isinstance(text, str)])
        witness[field] = _bent(witness[field], chance)
        tried += 1
        with pytest.raises(REFUSED):
            _check_claim(rederived(proved, steps, name), Reader(entry), set())
            pytest.fail(f"accepted {name}: {witness[field]}")
    assert tried > 35


def test_bent_bounds_are_refused():
    document = certificate("S14")
    name = next(name for name in document["steps"] if name.startswith("value"))
    for bounds in (["-1", "-4/5"], ["-7/10", "0"], ["0", "1"]):
        changed = copy.deepcopy(document)
        changed["steps"][name]["witness"]["bounds"] = bounds
        with pytest.raises(Rejected):
            check(render(changed))


@pytest.mark.parametrize(
    ("printed", "misprinted"),
    [
        (eq.S27, eq.S27.replace("- g/omega_n", "+ g/omega_n")),
        (eq.JACOBIAN[0], "1 + (1 + epsilon)/2*alpha"),
        (eq.TRUE26, eq.S26),
    ],
)
def test_a_misprint_is_refuted_and_what_is_right_is_not(printed, misprinted):
    names = read_formulas(Reader(printed)).variables
    point = {name: str(Fraction(n + 2, 7)) for n, name in enumerate(names)}
    for other, met in ((misprinted, True), (f"{printed} + 0", False)):
        asked = differ(other, printed, **point)
        assert asked.met_by(Steps(20).prove(asked)[1]) is met


def test_nothing_and_the_printed_identity_decide_nothing():
    witness = {"left": eq.DISCRIMINANT, "right": eq.PRINTED_SUM}
    with pytest.raises(Unproved, match="differ"):
        equal(Context(PAPER), Reader(witness))
    for row in ROWS:
        assert row.decide(PAPER, []).verdict.value == "UNDECIDED"
