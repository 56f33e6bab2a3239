"""What claims N1 to N4 make of conclusions, and N4 for a user's box of parameters."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed, Reader, parameters_from_json
from proofs.trusted.files import parameters_to_json
from proofs.trusted.kernel.differential import Differential
from proofs.trusted.kernel.rates import Rates
from proofs.trusted.oscillator import Oscillator
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.horseshoes import RectangleHorseshoe
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.verdicts import Verdict
from tests.proofs.trusted.paper.test_nonplastic import made, pair_of, slow
from tests.proofs.trusted.paper.test_rectangle_theorems import (
    EXACT,
    GAMMA,
    PRINTED,
    STEEP,
    V1,
    V2,
    golden,
    moved,
    printed,
    word,
)

VERIFIED, REFUTED, UNDECIDED = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED
WIDE = replace(
    PAPER,
    left=pair_of("1.09", "1.18"),
    right=pair_of("1.25", "1.35"),
    interval=pair_of("1.09", "1.35"),
)


def reaching(of, *reach):
    return replace(of, reach=tuple(map(Fraction, reach)))


# -- the box of a statement ------------------------------------------------------------------------


def test_the_paper_s_box():
    assert PAPER.box.sides == (
        pair_of("0.21205", "0.21215"),
        pair_of("-0.20005", "-0.19995"),
        pair_of("0.005", "0.015"),
    )
    exact = replace(PAPER, reach=None)
    assert exact.box.sides == tuple(pair_of(x, x) for x in (PAPER.eta, PAPER.nu, PAPER.epsilon))
    assert replace(PAPER, epsilon=None).box is None
    assert replace(PAPER, epsilon=Fraction(0)).box.sides[2] == pair_of(0, "0.005")


LEAVING = [
    ("-0.001", "0", "0"),
    ("0", "-0.001", "0"),
    ("0", "0", "-0.001"),
    ("0.2121", "0", "0"),
    ("0", "0.2", "0"),
    ("0", "0", "0.99"),
]


@pytest.mark.parametrize("reach", LEAVING)
def test_boxes_that_leave_the_model(reach):
    with pytest.raises(ValueError, match=r"^reach: [^\n]+$"):
        reaching(PAPER, *reach)
    document = parameters_to_json(PAPER) | {"reach": [str(Fraction(x)) for x in reach]}
    with pytest.raises(Malformed, match="reach"):
        parameters_from_json(Reader(document))


@pytest.mark.parametrize("of", [PAPER, replace(PAPER, reach=None), reaching(PAPER, 0, "1/7", 0)])
def test_parameters_are_read_as_written(of):
    document = json.loads(json.dumps(parameters_to_json(of)))
    assert parameters_from_json(Reader(document)) == of


# -- what the claims make of conclusions -----------------------------------------------------------

BOX = PAPER.box
CORNER = Place(*((low, low) for low, _ in BOX.sides))
OUTSIDE = replace(CORNER, epsilon=pair_of("0.0049", "0.0049"))
PARTLY = replace(CORNER, epsilon=pair_of("0.0049", "0.006"))
OTHER_SETS = replace(PRINTED, right=type(PRINTED.right)(*pair_of("1.27", "1.33")))
OTHER_VELOCITIES = replace(PRINTED, velocities=pair_of("-0.4", 0))


def shoe(at=BOX, sets=PRINTED):
    return RectangleHorseshoe(at, sets, Fraction(1, 100), Rates(Fraction(4), Fraction(1, 20)))


def with_nu(low, high):
    return replace(BOX, nu=pair_of(low, high))


def state(phi, gamma, image, at=EXACT):
    """What is known about a state: the image phase to 1/1000."""
    reach = Fraction(1, 1000)
    phase = Fraction(image) - reach, Fraction(image) + reach
    box, image = (pair_of(phi, phi), pair_of(gamma, gamma)), (phase, pair_of(-1, 0))
    return Differential(Oscillator(at.sides), box, (0,), image, STEEP)


BARRED = word("11111")
RIGHT_CORNER = state("1.15", "-0.45", "1.30")
LEFT_CORNER = state("1.11", "0", "1.10")


def verdict(claim, found, of=PAPER):
    return find(claim).decide(of, found).verdict


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ([shoe()], VERIFIED),
        ([shoe(with_nu("-0.21", "-0.19"))], VERIFIED),
        ([shoe(with_nu("-0.21", "-0.2"))], UNDECIDED),
        ([shoe(with_nu("-0.21", "-0.2")), shoe(with_nu("-0.2", "-0.19"))], VERIFIED),
        ([shoe(with_nu("-0.21", "-0.201")), shoe(with_nu("-0.2", "-0.19"))], UNDECIDED),
        ([shoe(EXACT)], UNDECIDED),
        ([shoe(sets=OTHER_SETS)], UNDECIDED),
        ([shoe(sets=OTHER_VELOCITIES)], UNDECIDED),
        ([word("111")], REFUTED),
        ([word("111", CORNER)], REFUTED),
        ([word("111", BOX)], REFUTED),
        ([shoe(EXACT), word("111", CORNER)], REFUTED),
        ([word("111", OUTSIDE)], UNDECIDED),
        ([word("111", PARTLY)], UNDECIDED),
        ([word("111", sets=OTHER_SETS)], UNDECIDED),
        ([word("111", sets=OTHER_VELOCITIES)], UNDECIDED),
        ([RIGHT_CORNER], UNDECIDED),  # an edge alone says nothing about words
        ([V1, V2], UNDECIDED),
        ([], UNDECIDED),
    ],
)
def test_n4_is_about_the_whole_box_or_a_point_of_it(found, expected):
    decision = find("N4").decide(PAPER, found)
    assert decision.verdict is expected
    assert (decision.witness is not None) is (expected is REFUTED)


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ([shoe()], VERIFIED),
        ([shoe(EXACT)], VERIFIED),
        ([shoe(CORNER)], UNDECIDED),
        ([shoe(EXACT, OTHER_SETS)], UNDECIDED),
        ([BARRED], REFUTED),
        ([word("11111", CORNER)], UNDECIDED),
        ([word("11111", sets=OTHER_VELOCITIES)], UNDECIDED),
        ([V1, V2], UNDECIDED),
        ([RIGHT_CORNER, LEFT_CORNER], REFUTED),
        ([RIGHT_CORNER], UNDECIDED),  # the left edge may be a turn away
        ([RIGHT_CORNER, state("1.11", "0", "-5.2")], UNDECIDED),  # it is
        ([state("1.15", "-0.45", "1.30", CORNER), LEFT_CORNER], UNDECIDED),
        ([state("1.15", "-0.3", "1.30"), LEFT_CORNER], UNDECIDED),  # no corner
        ([state("1.14", "-0.45", "1.30"), LEFT_CORNER], UNDECIDED),
        ([state("1.15", "-0.45", "1.3195"), LEFT_CORNER], UNDECIDED),  # perhaps beyond 1.32
        ([state("1.15", "-0.45", "1.40"), LEFT_CORNER], UNDECIDED),
        ([state("1.11", "0", "1.1105"), state("1.15", "-0.45", "1.40")], UNDECIDED),
        ([state("1.11", "0", "1.12"), state("1.15", "-0.45", "1.40")], REFUTED),
    ],
)
def test_n1(found, expected):
    assert verdict("N1", found) is expected


def test_n2_and_n3():
    assert verdict("N2", [V1, V2]) is VERIFIED
    assert verdict("N2", [V1]) is verdict("N2", [V1, moved(V2, CORNER)]) is UNDECIDED
    assert verdict("N2", [replace(x, box=(x.box[0], GAMMA)) for x in (V1, V2)]) is UNDECIDED
    flat = ((pair_of("0.9", 6), pair_of(0, 0)), STEEP[1])
    weak = printed(PAPER.right, "1.06", "1.30", derivative=flat)
    assert verdict("N2", [V1, weak]) is UNDECIDED
    assert verdict("N3", [golden()]) is verdict("N3", [shoe()]) is VERIFIED
    assert verdict("N3", [replace(golden(), at=CORNER)]) is UNDECIDED
    assert verdict("N3", [replace(golden(), strips=OTHER_SETS)]) is UNDECIDED
    assert verdict("N3", [shoe(sets=OTHER_SETS), BARRED, V1, V2]) is UNDECIDED


@pytest.mark.parametrize("claim", ["N1", "N2", "N3", "N4"])
@pytest.mark.parametrize("missing", ["epsilon", "velocities"])
def test_claims_without_their_numbers(claim, missing):
    found = [V1, V2, golden(), shoe(), BARRED]
    assert verdict(claim, found, replace(PAPER, **{missing: None})) is UNDECIDED


def test_without_restitution():
    of = replace(PAPER, epsilon=Fraction(0), reach=None)
    at = replace(EXACT, epsilon=pair_of(0, 0))
    found = [moved(x, at) for x in (V1, V2, shoe())]
    assert verdict("N2", found, of) is verdict("N3", found, of) is UNDECIDED
    assert verdict("N4", found, of) is verdict("N1", found, of) is VERIFIED
    said = shoe(at).sentence
    assert "the plastic map f" in said and "one-sided" in said and "two-sided" not in said
    assert "hyperbolic" not in said
    both = shoe(replace(EXACT, epsilon=pair_of(0, "0.01"))).sentence
    assert "For epsilon > 0 F is one-to-one" in both and "For epsilon = 0 the plastic" in both
    assert "plastic" not in shoe().sentence


# -- what is proved for boxes, against other arithmetic --------------------------------------------


PLASTIC = replace(
    reaching(PAPER, "0.00005", "0.00005", 0),
    epsilon=Fraction(0),
    left=pair_of("1.1", "1.15"),
    interval=pair_of("1.1", "1.32"),
)
ROUGH = reaching(WIDE, "0.00005", "0.05", "0.005")  # nu to one place


@pytest.mark.parametrize(
    ("of", "verdict", "texts"),
    [
        (WIDE, "VERIFIED", ["by at least 0.051"]),
        slow(
            PAPER,
            "REFUTED",
            [
                "At eta = 0.2121, nu = -0.2, epsilon = 0.01: no orbit of F follows V2 V2 V2 V2:",
                "[1.300825, 1.300826], short of 1.32 by at least 0.019174",
                "At eta in [0.21205, 0.21215], nu in [-0.20005, -0.19995], epsilon in "
                "[0.005, 0.015]: let V1 = [1.1, 1.17] x [-0.45, 0], V2 = [1.2",
            ],
        ),
        slow(PLASTIC, "VERIFIED", ["f' >= 4.06"]),
        slow(
            ROUGH,
            "REFUTED",
            [
                "At eta = 0.2121, nu = -0.2125, epsilon = 0.01: no orbit of F follows V1 V2 V2 V2",
                "nu in [-0.20625, -0.19375]",
            ],
        ),
        slow(replace(WIDE, velocities=pair_of("-0.3", 0)), "UNDECIDED", []),  # images leave them
        (replace(WIDE, epsilon=None), "UNDECIDED", []),
        (replace(WIDE, velocities=None), "UNDECIDED", []),
    ],
)
def test_what_is_said_of_a_box(of, verdict, texts):
    claim = made(of, "N4")[0]["N4"]
    assert claim["verdict"] == verdict
    said = " ".join(claim[part] or "" for part in ("witness", "corrected", "why"))
    assert [text for text in texts if text not in said] == []
