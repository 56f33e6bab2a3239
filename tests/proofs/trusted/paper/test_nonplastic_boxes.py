"""What claims N1 to N4 make of conclusions, and N4 for a user's box of parameters."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.__main__ import main
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.s33_steps import ReboundProver
from proofs.search.steps import Prover
from proofs.trusted.certificate import Malformed, Reader, parameters_from_json
from proofs.trusted.files import parameters_to_json
from proofs.trusted.kernel.arithmetic import Unproved
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


@pytest.mark.parametrize(
    "reach", ["1/100", ["0", "0"], ["0"] * 4, ["0", "0", "2/200"], [0, 0, 0], {}, ["0", "0", None]]
)
def test_boxes_in_another_form(reach):
    document = parameters_to_json(PAPER) | {"reach": reach}
    with pytest.raises(Malformed):
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
        ([RIGHT_CORNER], REFUTED),
        ([state("1.15", "-0.45", "1.30", CORNER)], UNDECIDED),
        ([state("1.15", "-0.3", "1.30")], UNDECIDED),  # no corner
        ([state("1.14", "-0.45", "1.30")], UNDECIDED),
        ([state("1.15", "-0.45", "1.3195")], UNDECIDED),  # perhaps beyond 1.32
        ([state("1.15", "-0.45", "1.40")], UNDECIDED),
        ([state("1.11", "0", "1.1105")], UNDECIDED),
        ([state("1.11", "0", "1.12")], REFUTED),
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


def test_sentences_carry_place_sets_and_numbers():
    decision = find("N1").decide(PAPER, [BARRED, word("1111"), word("0011"), RIGHT_CORNER, shoe()])
    assert decision.verdict is VERIFIED  # whatever else is there
    decision = find("N1").decide(PAPER, [BARRED, word("0011"), RIGHT_CORNER, shoe(sets=OTHER_SETS)])
    point = "At eta = 0.2121, nu = -0.2, epsilon = 0.01: "
    assert decision.witness.startswith(point + "no orbit of F follows V2 V2 V2 V2 V2: ")
    assert "the right edge of V1 to a phase in [1.299, 1.301], short of 1.32 by at least 0.019" in (
        decision.witness
    )
    assert str(PRINTED) in decision.witness
    assert decision.theorem.startswith(
        "At eta in [0.21205, 0.21215], nu in [-0.20005, -0.19995], epsilon in [0.005, 0.015]: let "
        "V1 = [1.11, 1.15] x [-0.45, 0], V2 = [1.27, 1.33] x [-0.45, 0]"
    )
    assert decision.quantities == {"image_of_right_edge_of_V1": RIGHT_CORNER.values[0]}
    assert find("N4").own and not any(find(claim).own for claim in ("N1", "N2", "N3"))


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
                "[0.005, 0.015]: let V1 = [1.1, 1.17] x [-0.45, 0], V2 = [1.26, 1.34] x [-0.45, 0]",
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
        slow(replace(WIDE, velocities=pair_of("0.5", "1")), "UNDECIDED", []),  # impossible states
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


@pytest.mark.slow
def test_a_word_is_barred_for_each_oscillator_anew():
    prover = ReboundProver(PAPER, Prover(System(PAPER.eta, PAPER.nu), 30, HORIZON))
    names = []
    for epsilon in ("0.01", "0.0102"):
        at = replace(EXACT, epsilon=pair_of(epsilon, epsilon))
        pair = prover.pair(at, (PAPER.left, PAPER.right))
        names.append(prover.bar(pair, (1,) * 4, True))
        assert prover.known[names[-1]].place == at
        assert prover.bar(pair, (1,) * 4, True) == names[-1]
    assert len(set(names)) == 2


def test_a_step_that_was_taken_back_is_made_again():
    """Its name is another one's by then."""
    prover = ReboundProver(PAPER, Prover(System(PAPER.eta, PAPER.nu), 30, HORIZON))
    edge, other = (((end, end), prover.velocities) for end in PAPER.left)
    with pytest.raises(Unproved), prover.attempt():
        lost, _ = prover.state(EXACT, edge)
        raise Unproved("elsewhere")
    assert prover.state(EXACT, other)[0] == lost
    name, found = prover.state(EXACT, edge)
    assert name != lost and found.box == edge
    assert prover.state(EXACT, edge) == (name, found)
    assert list(prover.steps) == [lost, name]


# -- the command -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_command_takes_a_box(tmp_path, capsys):
    sets = ["--left", "1.09", "1.18", "--right", "1.25", "1.35"]
    box = ["--reach", "0.0001", "0", "1/1000"]
    where = ["--only", "N4", "--out", str(tmp_path)]
    assert main(["nonplastic", *sets, *box, *where]) == 0
    said = capsys.readouterr().out
    assert "For all eta in [0.212, 0.2122], nu = -0.2, epsilon in [0.009, 0.011]" in said
    document = json.loads((tmp_path / "nonplastic.json").read_text())
    assert document["parameters"]["reach"] == ["1/10000", "0", "1/1000"]


@pytest.mark.parametrize("reach", [*LEAVING, ("0", "0", "0.011"), ("a", "0", "0"), ("0", "0")])
def test_the_command_refuses_other_boxes(tmp_path, capsys, reach):
    with pytest.raises(SystemExit) as leaving:
        main(["nonplastic", "--only", "N4", "--out", str(tmp_path / "new"), "--reach", *reach])
    assert leaving.value.code == 2
    assert "reach" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()
