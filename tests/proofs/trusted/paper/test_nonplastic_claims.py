"""What claims N1-N3 make of conclusions: synthetic ones, at the paper's numbers."""

from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.rebound_facts import restricted
from proofs.trusted.paper.s33_restitution.rebounds import BarredWord, Rectangle
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.proofs.trusted.paper.test_rebounds import HERE, linear, pair_of

# -- orbits that never repeat the right rectangle, at the paper's numbers --------------------------

EXACT = ((PAPER.eta,) * 2, (PAPER.nu,) * 2, (PAPER.epsilon,) * 2)
STEEP = ((pair_of(5, 6), pair_of("1/50", "1/20")), (pair_of("-1/2", "1/2"), pair_of(0, "1/200")))
VELOCITY = pair_of("-0.43", "-0.23")


def printed(phases, left, right, box=EXACT):
    ends = pair_of(left, left), pair_of(right, right)
    return Rectangle(box, phases, PAPER.velocities, 0, *ends, VELOCITY, STEEP)


V1 = printed(PAPER.left, "1.10", "1.30")
V2 = printed(PAPER.right, "1.06", "1.30")
PART = printed(pair_of("1.27", "1.293"), "1.06", "1.17")
WORDS = [
    BarredWord(EXACT, (PAPER.left, PAPER.right), PAPER.velocities, word, Fraction(1, 100))
    for word in ((0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1), (1, 1, 1, 1))
]


def test_restricted_horseshoe():
    found = restricted(PAPER, [V1, V2, PART, *WORDS])
    assert found is not None
    assert found.rectangles == (V1, PART)


@pytest.mark.parametrize(
    "found",
    [
        [V1, V2, PART, *WORDS[1:]],
        [V1, V2, PART, *WORDS[:-1]],
        [V1, V2, *WORDS],
        [V1, PART, *WORDS],
        [V2, PART, *WORDS],
        [V1, V2, replace(PART, phases=pair_of("1.271", "1.293")), *WORDS],
        [V1, V2, replace(PART, right=pair_of("1.14", "1.15")), *WORDS],
        [V1, V2, replace(PART, phases=pair_of("1.27", "1.31")), *WORDS],  # V1 does not reach it
        [V1, V2, PART, *(replace(word, velocities=pair_of("-0.4", 0)) for word in WORDS)],
        [V1, V2, PART, *(replace(word, sets=(V1.phases, PART.phases)) for word in WORDS)],
    ],
)
def test_restricted_horseshoe_needs_all(found):
    assert restricted(PAPER, found) is None


def test_restricted_horseshoe_needs_restitution():
    of = replace(PAPER, epsilon=Fraction(0))
    box = (*EXACT[:2], pair_of(0, 0))
    found = [replace(one, box=box) for one in (V1, V2, PART, *WORDS)]
    assert restricted(of, found) is None


# -- what the claims make of conclusions -----------------------------------------------------------


def verdict(claim, found, of=PAPER):
    return find(claim).decide(of, found).verdict


def test_horseshoe_claim_refuted_by_a_word_at_these_numbers_only():
    assert verdict("N1", [V1, V2, *WORDS]) is Verdict.REFUTED
    assert verdict("N1", [V1, V2]) is Verdict.UNDECIDED
    assert verdict("N1", WORDS) is Verdict.UNDECIDED
    elsewhere = ((PAPER.eta,) * 2, (PAPER.nu,) * 2, pair_of("0.02", "0.02"))
    others = [replace(word, box=elsewhere) for word in WORDS]
    assert verdict("N1", [V1, V2, *others]) is Verdict.UNDECIDED
    wide = [replace(word, velocities=pair_of("-0.4", 0)) for word in WORDS]
    assert verdict("N1", [V1, V2, *wide]) is Verdict.UNDECIDED


def test_horseshoe_claim_verified_and_of_other_parameters():
    right = replace(V2, right=pair_of("1.33", "1.33"))
    left = replace(V1, right=pair_of("1.33", "1.33"))
    assert verdict("N1", [left, right]) is Verdict.VERIFIED
    assert verdict("N3", [left, right]) is Verdict.VERIFIED
    assert verdict("N1", [left, right], replace(PAPER, eta=Fraction("0.2"))) is Verdict.UNDECIDED
    assert verdict("N3", [left, replace(right, box=((PAPER.eta,) * 2,) * 3)]) is Verdict.UNDECIDED


def state(phi, gamma, image):
    """What is known about a corner: the image phase to 1/1000."""
    reach = Fraction(1, 1000)
    one = linear(pair_of(phi, phi), velocities=pair_of(gamma, gamma), box=EXACT)
    return replace(one, phase=(Fraction(image) - reach, Fraction(image) + reach))


@pytest.mark.parametrize(
    ("corner", "expected"),
    [
        (state("1.15", "-0.45", "1.30"), Verdict.REFUTED),
        (state("1.15", "-0.3", "1.30"), Verdict.UNDECIDED),  # no corner
        (state("1.14", "-0.45", "1.30"), Verdict.UNDECIDED),
        (state("1.15", "-0.45", "1.3195"), Verdict.UNDECIDED),  # perhaps beyond 1.32
        (state("1.15", "-0.45", "1.40"), Verdict.UNDECIDED),
        (state("1.11", "0", "1.1105"), Verdict.UNDECIDED),
        (state("1.11", "0", "1.12"), Verdict.REFUTED),
        (replace(state("1.15", "-0.45", "1.30"), box=HERE), Verdict.UNDECIDED),
    ],
)
def test_horseshoe_claim_refuted_by_a_corner(corner, expected):
    assert verdict("N1", [corner]) is expected
    assert verdict("N1", [V1, V2, corner]) is expected


def test_extreme_images_need_a_phase_that_grows_with_the_velocity():
    corner = state("1.11", "0", "1.10")
    name = "greatest_image_left_V1"
    assert find("N1").decide(PAPER, [V1, V2, corner]).quantities == {name: corner.phase}
    (p, q), row = STEEP
    falling = replace(V1, derivative=((p, (-q[1], -q[0])), row))
    assert find("N1").decide(PAPER, [falling, V2, corner]).quantities == {}


@pytest.mark.parametrize(
    ("entries", "expected"),
    [
        (STEEP, Verdict.VERIFIED),
        (((pair_of(50, 60), pair_of("1.2", "1.2")), STEEP[1]), Verdict.UNDECIDED),  # q >= 1
        (((pair_of("1.02", 6), pair_of(0, 0)), STEEP[1]), Verdict.UNDECIDED),
        (((pair_of("0.9", 6), pair_of(0, 0)), (pair_of(0, 0),) * 2), Verdict.UNDECIDED),
    ],
)
def test_rates_claim(entries, expected):
    assert verdict("N2", [V1, replace(V2, derivative=entries)]) is expected
    assert verdict("N2", [V1]) is Verdict.UNDECIDED


def test_without_restitution_there_is_nothing_to_contract():
    of = replace(PAPER, epsilon=Fraction(0))
    found = [replace(one, box=(*EXACT[:2], pair_of(0, 0))) for one in (V1, V2)]
    assert verdict("N2", found, of) is verdict("N3", found, of) is Verdict.UNDECIDED


@pytest.mark.parametrize("missing", ["epsilon", "velocities"])
def test_claims_without_their_numbers(missing):
    of = replace(PAPER, **{missing: None})
    for claim in ("N1", "N2", "N3"):
        assert verdict(claim, [V1, V2, PART, *WORDS], of) is Verdict.UNDECIDED
