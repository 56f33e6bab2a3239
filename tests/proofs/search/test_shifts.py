"""Sets found at parameters of one's own: what they are for is proved of them."""

import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import pytest

from proofs.motion.system import System
from proofs.search.loops import loops
from proofs.search.s31_horseshoe import prove
from proofs.search.shifts import own_sets, pieces
from proofs.shell.groups import decide, produce
from proofs.trusted.certificate import Malformed
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check, premises
from tests.oracles.judge import oracle, parameters
from tests.oracles.plastic import horseshoe_faults

CLAIMS = ("H1", "H2", "H3", "H4", "H5", "H6")
F = Fraction


def at(eta, nu):
    return replace(PAPER, eta=F(eta), nu=F(nu))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("eta", "nu", "sign"),
    [
        ("0.22", "-0.2", 1),
        ("0.112", "-0.336", 1),
        ("0.2121", "-0.2", 1),
        ("0.2121", "-0.9", 1),  # where a coarse grid of phases misleads
        ("0.103", "0.541", -1),
        ("0.0847", "-1.2762", -1),
    ],
)
def test_a_horseshoe_is_found_and_all_of_it_is_proved(eta, nu, sign):
    of = own_sets(at(eta, nu))
    assert of is not None and of.interval == (of.left[0], of.right[1])
    assert of.signs == (sign, sign)
    assert max(end.denominator for end in (*of.left, *of.right)) <= 10**5  # short decimals
    found = prove(of, CLAIMS)
    assert {decide(claim, of, found, 15)[0].verdict for claim in CLAIMS} == {Verdict.VERIFIED}
    assert not horseshoe_faults(parameters(of), random.Random(1))


@pytest.fixture(scope="module")
def falling():
    return own_sets(at("0.103", "0.541"))


@pytest.mark.slow
def test_where_f_decreases_the_sign_is_part_of_the_statement(falling):
    """A certificate without it, or with other ones, is refused, and so is that f increases."""
    made = produce({"horseshoe": CLAIMS}, falling, digits=15).certificate
    assert len(check(made).claims) == len(CLAIMS)
    document = json.loads(made)
    assert document["parameters"]["signs"] == ["-1", "-1"]
    assert "decreases on I0" in document["claims"][2]["statement"]
    for signs in (["1", "1"], ["-1", "1"], ["-1"], ["-1", "0"], "-1", None):
        document["parameters"]["signs"] = signs
        with pytest.raises((Malformed, Rejected)):
            check(json.dumps(document))
    del document["parameters"]["signs"]
    with pytest.raises(Rejected):
        check(json.dumps(document))
    rising = replace(falling, signs=(1, 1))
    found = prove(rising, ("H1", "H3"))
    verdicts = {decide(claim, rising, found, 15)[0].verdict for claim in ("H1", "H3")}
    assert verdicts == {Verdict.REFUTED}


@pytest.mark.slow
def test_where_f_decreases_theorems_and_dimension_are_those_of_the_oracle(falling):
    """H2 is refuted by slopes too low, and beside it stands the horseshoe; H7 and H13 hold."""
    low = replace(falling, slopes=(F(2), F(9)))
    found = prove(low, ("H2",))
    line = decide("H2", low, found, 15)[0]
    assert line.verdict is Verdict.REFUTED and "decreasing on 0, 1" in line.truth
    sets = produce({"sets": ("H7", "H10"), "dimension": ("H13",)}, falling, digits=10)
    assert [x.verdict.value for x in sets.lines] == ["VERIFIED", "VERIFIED", "REFUTED"]
    told = premises(sets.certificate).known.values()
    proved = [*told, *(conclusion for _, conclusion in found.proofs["H2"])]
    kinds = {type(each).__name__ for each in proved}
    assert {"StayingSet", "Repeller", "Differential"} <= kinds
    assert [x for each in proved for x in oracle(each, random.Random(1), falling)] == []


@pytest.mark.slow
@pytest.mark.parametrize(("eta", "nu"), [("1.1009", "-1.2954"), ("0.22", "-0.2")])
def test_loops_are_mapped_as_a_markov_set_must_be(eta, nu):
    """Each cell over a part of the others, and past the rest: by the oracle's own impacts."""
    from tests.oracles.plastic import lifted

    system = System(F(eta), F(nu))
    cells = next(loops(system, pieces(system)))
    view, covered = SimpleNamespace(eta=system.eta, nu=system.nu), []
    for cell in cells:
        low, high = sorted(lifted(view, end) for end in cell)
        inside, met = 0, 0
        for first, last in cells:
            turns = [k * math.tau for k in range(int(low // math.tau), int(high // math.tau) + 1)]
            inside += any(low < first + x and last + x < high for x in turns)
            met += any(low <= last + x and first + x <= high for x in turns)
        assert inside == met > 0
        covered.append(inside)
    assert set(covered) == {1, 2}  # ways from all cells, from some of them two
