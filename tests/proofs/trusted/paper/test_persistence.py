"""G7 and G8: what the rules accept, what they refuse, and what their conclusions decide.

True values come from `reference` (equations (10) and (14) typed by hand, mpmath, 50 digits).
"""

import copy
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from mpmath import mpf

from proofs.motion.system import System
from proofs.motion.transients import transients
from proofs.search.s34_persistence import prove
from proofs.shell.groups import decide
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.stable import StableCycle
from proofs.trusted.numbers import Phase
from proofs.trusted.oscillator import Oscillator, PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.landing import Separation
from proofs.trusted.paper.s34_circle.persistence import SuperstableMotion
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.verdicts import Verdict
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import add, derive, edited, evidence, exact, known_of

F = Fraction
ETA, NU = mpf("0.2121"), mpf("-0.2")
ARC, MOTION, PAIR = "separation-1", "superstable-motion-1", "stable-cycle-1"


def proof(claim):
    return [each for _, each in evidence("persistence").proofs[claim]]


# -- what is concluded -----------------------------------------------------------------------------


@pytest.mark.slow
def test_the_oracles_see_what_is_concluded():
    """The flight from phi_s, bounces, and the boxes of the other orbit."""
    found = known_of("persistence")
    decision = find("G7").decide(
        PAPER, [found[step] for step, _ in evidence("persistence").proofs["G7"]]
    )
    assert "F^2 contracts the first box" in decision.theorem
    for each in (found[ARC], found[MOTION], found[PAIR]):
        assert oracle(each, random.Random(1)) == []


# -- the other orbit -------------------------------------------------------------------------------


@pytest.mark.parametrize("claim", ["X7", "G7"])
def test_a_stable_cycle_of_the_plastic_map_is_no_motion_with_restitution(claim):
    """A conclusion about plastic impacts is about the oscillator of any epsilon, too: its f."""
    box, other = ((F(1), F(2)),), ((F(3), F(4)),)
    plastic = StableCycle(PlasticMap(PAPER.place), (box, other))
    at = Place.restituting(PAPER.eta, PAPER.nu, PAPER.epsilon)
    bouncing = StableCycle(Oscillator(at.sides), (box * 2, other * 2))
    verdicts = [find(claim).decide(PAPER, [x]).verdict for x in (plastic, bouncing)]
    assert verdicts == [Verdict.UNDECIDED, Verdict.VERIFIED]


@pytest.mark.slow
def test_the_pair_alone_decides_nothing():
    motion, pair = proof("G7")
    assert isinstance(motion, SuperstableMotion) and isinstance(pair, StableCycle)
    assert find("G7").decide(PAPER, [pair]).verdict is Verdict.UNDECIDED
    assert "F^2 contracts" not in find("G7").decide(PAPER, [motion]).theorem
    assert "epsilon = 0.29" in pair.brief  # it stands beside claims about other epsilons


# -- the verdicts ----------------------------------------------------------------------------------


@pytest.mark.parametrize("claim, verdict", [("G7", "CONDITIONAL"), ("G12", "REFUTED")])
def test_the_orbit_persists_if_a_landing_counts_once_and_not_for_the_map(claim, verdict):
    found = find(claim).decide(PAPER, proof(claim))
    assert found.verdict is Verdict(verdict)
    assert "one landing with all that follows until it rests and one separation" in found.witness
    assert "infinitely many" in found.witness and "none attracts this open set" in found.witness
    assert "epsilon in [0, 0.35" in found.theorem and "less 4 turns" in found.theorem
    assert "a period of 2 pi * 4;" in found.theorem
    low, high = found.quantities["impact_phase"]
    leave = reference.separation_phase(ETA, NU)
    digits = Fraction(1, 10**44)  # of the reference
    assert low - digits < exact(reference.first_impact(ETA, NU, leave)[1]) < high + digits


@pytest.mark.parametrize("claim, verdict", [("G7", "VERIFIED"), ("G12", "REFUTED")])
def test_where_f_has_such_an_orbit_g7_needs_no_condition(claim, verdict):
    of, steps = (
        replace(PAPER, epsilon=Fraction("0.29")),
        [x for _, x in evidence("persistence").proofs["G7"]],
    )
    found = find(claim).decide(of, steps)
    assert found.verdict is Verdict(verdict)
    three = replace(steps[1], boxes=(*steps[1].boxes, ((Fraction(3), Fraction(4)),) * 2))
    assert find("G7").decide(of, [steps[0], three]).verdict is Verdict.CONDITIONAL


def test_g8_is_simulated_and_rests_on_no_step():
    found = find("G8").decide(PAPER, proof("G7"))
    assert found.verdict is Verdict.SIMULATED and found.theorem is None and found.witness is None
    assert not found.quantities and proof("G8") == []


@pytest.mark.slow
def test_g8_tells_what_is_simulated(monkeypatch):
    """Medians grow with epsilon, means do not, and some motions do not come to rest."""
    rows = transients(System(PAPER.eta, PAPER.nu))
    monkeypatch.setattr("proofs.search.s34_persistence.transients", lambda system: rows)
    found = prove(PAPER, ("G8",))
    assert found.steps == {} and found.proofs == {}
    line, entry = decide("G8", PAPER, found, 30)
    assert found.notes["G8"] in line.why and found.notes["G8"] not in entry["why"]
    medians, means = (
        [getattr(row, name) for row in rows] for name in ("median_turns", "mean_turns")
    )
    assert medians == sorted(medians) and means != sorted(means)
    assert all(row.rested < 1 for row in rows)
    for values in (medians, means, [100 * (1 - row.rested) for row in rows]):
        assert ", ".join(f"{value:.1f}" for value in values) in line.why


def motion(largest="1/4", eta=PAPER.eta):
    ends = [(Fraction(x), Fraction(x)) for x in (3, 6, 23, 4, 1)]
    place = Place.plastic(eta, PAPER.nu)
    arc = Separation(place, ends[0], Phase(*ends[1]), ends[2], 4, *ends[3:])
    epsilons = Fraction(0), Fraction(largest)
    return SuperstableMotion(arc, epsilons, ((ends[2], ends[4]),), rest=Fraction(5))


@pytest.mark.every
@pytest.mark.parametrize(
    "change",
    [
        {"rest": Fraction(6)},  # at the separation
        {"boxes": ()},
        *({"epsilons": (Fraction(a), Fraction(b))} for a, b in ((0, 0), (0, 1), (-1, "0.1"))),
        {"epsilons": (Fraction("0.2"), Fraction("0.1"))},
    ],
)
def test_no_motion_without_rest_or_coefficients(change):
    with pytest.raises(Unproved):
        replace(motion(), **change)


@pytest.mark.parametrize(
    ("of", "found"),
    [
        (PAPER, []),
        (PAPER, [motion("1/200")]),
        (PAPER, [motion(eta=Fraction("0.2122"))]),
        (replace(PAPER, epsilon=Fraction(0)), [motion()]),
        (replace(PAPER, epsilon=None), [motion()]),
        (replace(PAPER, epsilon=Fraction("0.3")), [motion()]),
    ],
)
@pytest.mark.parametrize("claim, verdict", [("G7", "CONDITIONAL"), ("G12", "REFUTED")])
def test_both_are_undecided_without_what_they_rest_on(of, found, claim, verdict):
    assert find(claim).decide(of, found).verdict is Verdict.UNDECIDED
    assert find(claim).decide(PAPER, [motion()]).verdict is Verdict(verdict)


@pytest.mark.parametrize(("eta", "nu"), [("0.2121", "0.02"), ("0.9", "-0.3"), ("3", "-2")])
def test_other_oscillators_are_undecided_or_proved(eta, nu):
    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu))
    found = prove(of, ("G7",))
    known = derive(found.steps, of)
    own = find("G7").decide(of, [known[name] for name, _ in found.proofs.get("G7", [])])
    assert own.verdict is (Verdict.CONDITIONAL if found.proofs else Verdict.UNDECIDED)


# -- certificates edited on purpose ----------------------------------------------------------------


@cache
def short():
    """The motion, for few epsilons only, which a check takes little time for."""
    steps = {name: copy.deepcopy(evidence("persistence").steps[name]) for name in (ARC, MOTION)}
    cells = steps[MOTION]["witness"]["cells"]
    del cells[1 + next(i for i, cell in enumerate(cells) if len(cell["bounces"]) > 2) :]
    return steps


def test_the_short_proof_is_one():
    cells = short()[MOTION]["witness"]["cells"]
    assert derive(short())[MOTION].largest == Fraction(cells[-1]["epsilon"][1])
    assert 3 <= len(cells) < 30


FLIGHT, CHATTER = (ARC, "witness"), (MOTION, "witness")
CELL = (*CHATTER, "cells", -1)


def widen(ends, by):
    return [add(f"-{by}")(ends[0]), add(by)(ends[1])]


EDITS = [
    ((*FLIGHT, "phase"), lambda ends: [ends[1], add("1/1000")(ends[1])]),
    ((*FLIGHT, "phase"), lambda ends: widen(ends, "1/2")),
    ((*CHATTER, "box"), lambda box: [widen(ends, "1/2") for ends in box]),
    ((*CHATTER, "cells"), lambda cells: [cells[0], *cells[-1:]]),
    ((*CHATTER, "cells"), lambda cells: [*cells, cells[-1]]),
    ((*CELL, "epsilon", 0), add("1/1000")),
    ((*CHATTER, "cells", 0, "epsilon", 0), lambda text: "-1/1000"),
    ((*CELL, "bounces", 0), lambda ends: ["0", ends[1]]),
    ((*CELL, "bounces", 0, 1), add("2")),
]


@pytest.mark.every
@pytest.mark.parametrize(("path", "change"), EDITS)
def test_an_edited_witness_is_refused(path, change):
    with pytest.raises((Unproved, Malformed)):
        derive(edited(short(), path, change))


def alone(**cell):
    """The rule on one cell and these words beside it, after the true flight."""
    spread = cell.pop("spread", "0")
    cells = [{"epsilon": ["0", "1/100"], "bounces": []} | cell]
    box = [widen(ends, spread) for ends in short()[MOTION]["witness"]["box"]]
    witness = {"separation": ARC, "box": box, "impacts": [], "cells": cells}
    return derive(edited(short(), CHATTER, lambda old: witness))[MOTION]


def test_one_cell_alone():
    assert alone().at.epsilon == (0, Fraction(1, 100)) and alone().rest < Fraction("4.7")
    assert alone(epsilon=["1/200", "1/100"]).at.epsilon == (Fraction(1, 200), Fraction(1, 100))
    with pytest.raises(Unproved, match="positive"):
        alone(spread="7/10")
    with pytest.raises(Unproved, match="coefficients"):
        alone(epsilon=["0", "0"])


def test_the_kick_of_the_largest_epsilon_counts():
    """At 1/5 the first bounce, from the speed 0.1352, takes 0.37; the lemma grants 0.6 in all."""
    found = alone(epsilon=["0", "1/5"])
    assert found.largest == Fraction(1, 5) and found.rest > 5
    with pytest.raises(Unproved, match="to end before phi_s"):
        alone(epsilon=["0", "9/10"])


def test_a_bounce_that_leaves_the_arc_is_refused():
    with pytest.raises(Unproved, match="push all through a bounce"):
        derive(edited(short(), (*CELL, "bounces", 0, 1), add("1")))


@pytest.mark.every
@pytest.mark.parametrize(
    ("of", "changes"),
    [
        ("eta", {"eta": Fraction("0.2122")}),
        ("nu", {"nu": Fraction("-0.2001")}),
        ("side", {"nu": Fraction("0.2")}),
    ],
)
def test_a_witness_for_another_oscillator_is_refused(of, changes):
    with pytest.raises((Unproved, Malformed)):
        derive(short(), replace(PAPER, **changes))
