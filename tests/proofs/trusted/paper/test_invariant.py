"""The invariant set of the map: by the oracles, and by edited certificates."""

import copy
import json
import random
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.search.s32_sets import prove
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.itineraries import Itinerary, follow
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.kernel.staying import StayingSet, prove_staying_set
from proofs.trusted.numbers import Phase, Phases
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper.s32_sets.invariant import ROWS, InvariantSet, staying
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Found, Verdict
from proofs.trusted.verify import Rejected, check
from tests.once import REPORTS
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper.steps import moved_to

DECIDE = {row.id: row.decide for row in ROWS}


def sets(left, right):
    low, high = (tuple(map(Fraction, part)) for part in (left, right))
    return Parameters(PAPER.eta, PAPER.nu, low, high, (low[0], high[1]), PAPER.slopes)


def horseshoe(of, slopes=PAPER.slopes, at=PAPER.place):
    cells = Phases(*of.left), Phases(*of.right)
    whole = Phases(*of.interval)
    return StayingSet(PlasticMap(at), (whole,), cells, (slopes,) * 2, ((0, 1),) * 2, whole=True)


@pytest.fixture(scope="module")
def proved():
    """The certificate at the paper's numbers."""
    return json.loads((REPORTS / "sets.json").read_text())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("left", "right"),
    [
        (("1.11", "1.15"), ("1.27", "1.32")),
        (("1.105", "1.15"), ("1.27", "1.316")),
        (("1.1", "1.15"), ("1.27", "1.31")),
        (("1.1", "1.15"), ("1.27", "1.32")),
    ],
)
def test_the_orbits_that_stay_are_those_the_oracle_sees(left, right):
    of = sets(left, right)
    found = [conclusion for _, conclusion in prove(of, ["H8"], digits=10).proofs["H8"]]
    known = staying(of.interval, Found(of, found))
    assert oracle(known, random.Random(1), of) == []
    verdict = DECIDE["H7"](of, found).verdict
    assert verdict is (Verdict.REFUTED if known.shift.forbidden else Verdict.VERIFIED)


def test_printed_set_has_no_000(proved):
    """1.11 lies between the phases with the itineraries 000... and those with 001..."""
    entry = next(each for each in proved["claims"] if each["id"] == "H7")
    assert entry["verdict"] == "REFUTED"
    assert "without the factor 000," in entry["witness"]
    assert "orbit of 1.11 has the itinerary 00 in I0 = [1.1, 1.15]" in entry["witness"]
    assert "Lebesgue measure zero" in entry["corrected"]
    assert "1, 3, 7, 11, 21, 39, 71, 131 fixed points" in entry["corrected"]


# -- following an orbit ----------------------------------------------------------------------------

BASE = horseshoe(sets(("1", "1.2"), ("1.3", "1.4")))


def known(*pairs, at=PAPER.place):
    """f at points, as a step of the rule slopes has it."""
    images = tuple(Phase(Fraction(a), Fraction(b)) for _, (a, b) in pairs)
    nothing = (Fraction(0), Fraction(9))
    return SlopeRange(
        PlasticMap(at),
        tuple(Fraction(p) for p, _ in pairs),
        (nothing,) * len(pairs),
        images,
        (nothing,) * (len(pairs) - 1),
    )


STEPS = known(("1", ("0.8", "0.9")), ("1.1", ("1.25", "1.26")), ("1.2", ("1.5", "1.6")))


def test_follow_takes_the_nearest_points():
    found = follow(BASE, [STEPS], Fraction("1.1"))
    assert found == Itinerary(BASE, ((Fraction("1.1"),) * 2, (Fraction("1.25"), Fraction("1.26"))))
    assert found.cut == "01"
    assert follow(BASE, [STEPS], Fraction("0.9")).cut == "0"
    assert follow(BASE, [STEPS], Fraction("1.5")).cut == "2"


@pytest.mark.parametrize(
    ("steps", "phase"),
    [
        (STEPS, "1.15"),  # anywhere in [1.25, 1.6]
        (STEPS, "1.35"),  # nothing is known there
        (known(("1.1", ("1.1", "1.1")), ("1.2", ("1.5", "1.6"))), "1.1"),  # it stays
        (moved_to(STEPS, replace(PAPER, eta=Fraction("0.21")).place), "1.1"),
        *(
            (known(("1.1", image), ("1.2", ("1.5", "1.6"))), "1.1")
            for image in (("1.19", "1.21"), ("1.15", "1.35"), ("0.99", "1.01"), ("1.39", "1.41"))
        ),
    ],
)
def test_follow_gives_up_where_the_set_is_not_decided(steps, phase):
    with pytest.raises(Unproved):
        follow(BASE, [steps], Fraction(phase))


def test_an_image_beyond_phase_zero_is_no_phase():
    with pytest.raises(Unproved, match="straddles"):
        known(("1.1", ("6.2", "6.3")), ("1.2", ("1.5", "1.6")))


def test_points_within_the_uncertainty_bound_nothing():
    """x in [1.11, 1.13], f(1.12) = 1.25: f(x) is between f(1.1) and f(1.2) only."""
    steps = [
        known(("1.1", ("1.11", "1.13")), ("1.12", ("1.25", "1.25")), ("1.2", ("1.26", "1.27")))
    ]
    assert follow(BASE, steps, Fraction("1.12")).cut == "01"
    with pytest.raises(Unproved):
        follow(BASE, steps, Fraction("1.1"))


def test_every_step_of_an_orbit_counts_the_points_it_looks_at():
    """A file with many points and many itineraries cannot be slow unseen."""
    images = [(str(Fraction(k, 1000)), ("1.25", "1.26")) for k in range(1000, 1200)]
    with metered(1000) as meter:
        follow(BASE, [known(*images)], Fraction("1.1"))
    assert meter.spent >= 200
    part = {"slopes": "s", "domain": ["1", "1199/1000"]}
    witness = Reader({"region": [["1", "2"]], "cells": [part, part], "gaps": []})
    with metered(1000), pytest.raises(Exhausted):
        prove_staying_set(Context(PAPER, {}, {"s": known(*images)}), witness)


@pytest.mark.parametrize(
    "orbit",
    [
        [("1.1", "1.1"), ("1.1", "1.1")],  # never leaves
        [("1.1", "1.11"), ("1.25", "1.25")],  # no phase
        [("1.1", "1.1"), ("1.25", "1.25"), ("1.26", "1.26")],  # leaves before
        [("1.1", "1.1"), ("1.19", "1.21")],  # perhaps in I0
        [("-1.1", "-1.1")],  # no phase in [0, 2 pi): below I0, but above it mod 2 pi
    ],
)
def test_no_itinerary_without_its_orbit(orbit):
    with pytest.raises(Unproved):
        Itinerary(BASE, tuple((Fraction(a), Fraction(b)) for a, b in orbit))


@pytest.mark.parametrize("signs", [(-1, -1), (1, -1), (-1, 1)])
def test_orbits_are_followed_where_f_increases(signs):
    """The order of phases is that of itineraries, and of images, there alone."""
    slopes = tuple(
        (Fraction(4), Fraction(5)) if x > 0 else (Fraction(-5), Fraction(-4)) for x in signs
    )
    with pytest.raises(Unproved, match="increases"):
        follow(replace(BASE, slopes=slopes), [STEPS], Fraction("1.1"))


def test_orbits_are_followed_in_a_horseshoe_alone():
    part = replace(BASE, whole=False)
    third = Phases(Fraction("1.5"), Fraction("1.6"))
    three = replace(
        BASE,
        region=(Phases(Fraction(1), third[1]),),
        cells=(*BASE.cells, third),
        slopes=(BASE.slopes[0],) * 3,
        onward=((0, 1, 2),) * 3,
    )
    for base in (part, three):
        with pytest.raises(Unproved, match="horseshoe"):
            follow(base, [STEPS], Fraction("1.1"))
        with pytest.raises(Unproved, match="around"):
            InvariantSet(base, base.interval, ())


# -- decisions -------------------------------------------------------------------------------------

AROUND = horseshoe(sets(("1.1", "1.15"), ("1.27", "1.32")))
LEAVES = {"0": "1.05", "1": "1.2", "2": "1.5"}
INSIDE = {"0": "1.12", "1": "1.3"}
END = Fraction("1.11")


def orbit(cut, phase=END, base=AROUND):
    """An orbit that follows a word, whose first letter must be right, and then leaves."""
    places = [*(INSIDE[letter] for letter in cut[1:-1]), LEAVES[cut[-1]]]
    return Itinerary(base, ((phase, phase), *((Fraction(x),) * 2 for x in places)))


CUT = orbit("001")


@pytest.mark.parametrize("claim", ["H7", "H8", "H9", "H10"])
@pytest.mark.parametrize(
    "found",
    [
        [],
        [CUT],
        [horseshoe(sets(("1.115", "1.15"), ("1.27", "1.32")))],
        [horseshoe(sets(("1.1", "1.15"), ("1.27", "1.319")))],
        [moved_to(AROUND, replace(PAPER, nu=Fraction("-0.21")).place), CUT],
    ],
)
def test_nothing_without_a_horseshoe_around_the_interval(claim, found):
    assert DECIDE[claim](PAPER, found).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("claim", ["H7", "H8", "H9"])
@pytest.mark.parametrize(
    "other",
    [
        orbit("001", phase=Fraction("1.12")),
        orbit("001", base=replace(AROUND, slopes=((Fraction(3),) * 2,) * 2)),
    ],
)
def test_the_end_itself_must_be_followed(claim, other):
    assert DECIDE[claim](PAPER, [AROUND, other]).verdict is Verdict.UNDECIDED
    with pytest.raises(Unproved, match="not followed"):
        InvariantSet(AROUND, Phases(*PAPER.interval), (other,))


def test_an_orbit_of_an_outer_end_is_not_taken():
    with pytest.raises(Unproved, match="not followed"):
        InvariantSet(AROUND, AROUND.interval, (CUT,))


@pytest.mark.parametrize(
    ("cut", "factors"), [("001", "000"), ("000", ""), ("002", "00"), ("01", "00")]
)
def test_what_an_orbit_forbids(cut, factors):
    """Of the lower end of I: all words before its own."""
    found = staying(PAPER.interval, Found(PAPER, [AROUND, orbit(cut)]))
    assert found.shift.factors == factors


def test_gap_of_another_width():
    """Points of Lambda that are in neither printed set have no symbol there."""
    narrow = sets(("1.11", "1.14"), ("1.27", "1.32"))
    assert DECIDE["H7"](narrow, [AROUND, CUT]).verdict is Verdict.UNDECIDED
    assert DECIDE["H9"](narrow, [AROUND, CUT]).verdict is Verdict.VERIFIED


def test_slopes_of_two_are_not_enough_for_measure_zero():
    slow = replace(AROUND, slopes=((Fraction(2), Fraction(7)),) * 2)
    assert DECIDE["H10"](PAPER, [slow]).verdict is Verdict.UNDECIDED
    assert "measure" not in slow.sentence
    assert DECIDE["H10"](PAPER, [AROUND]).verdict is Verdict.VERIFIED


def test_an_empty_invariant_set():
    """If the orbit of the lower end is above that of all points, nothing stays in I."""
    low = sets(("1.28", "1.29"), ("1.3", "1.32"))
    gone = orbit("12", phase=Fraction("1.28"))
    for claim in ("H8", "H9"):
        decision = DECIDE[claim](low, [AROUND, gone])
        assert decision.verdict is Verdict.REFUTED and "Lambda is empty" in decision.witness


# -- certificates ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("step", "field", "value"),
    [
        ("staying-set-1", "region", [["111/100", "33/25"]]),  # the printed interval
        ("itinerary-1", "phase", "11/10"),  # the fixed point's side
    ],
)
def test_forged_certificates_are_refused(proved, step, field, value):
    document = copy.deepcopy(proved)
    document["steps"][step]["witness"][field] = value
    with pytest.raises((Rejected, Malformed)):
        check(render(document))
