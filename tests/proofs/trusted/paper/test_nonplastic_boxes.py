"""Claim N4, the horseshoe for a user's box of parameters: verdicts, parts, edited certificates."""

import copy
import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from itertools import product

import pytest

from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.s33_steps import ReboundProver
from proofs.search.steps import Prover
from proofs.shell.groups import settle
from proofs.shell.runner import run
from proofs.trusted.certificate import (
    Malformed,
    Reader,
    parameters_from_json,
    parameters_to_json,
    render,
)
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.rebound_boxes import covered
from proofs.trusted.paper.s33_restitution.rebounds import BarredWord, Rebound, Rectangle
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.corpus import accepted
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.test_rebounds import pair_of
from tests.proofs.trusted.second_reader import NotACertificate, parameters

WIDE = replace(
    PAPER,
    left=pair_of("1.09", "1.18"),
    right=pair_of("1.25", "1.35"),
    interval=pair_of("1.09", "1.35"),
)


def made(of):
    rows, certificate = settle("nonplastic", of, ["N4"], digits=30, tell=lambda stage: None)
    assert check(render(certificate)).claims[0].verdict is rows[0].verdict
    return rows[0], certificate


def reaching(of, *reach):
    return replace(of, reach=tuple(map(Fraction, reach)))


# -- the box of a statement ------------------------------------------------------------------------


def test_the_paper_s_box():
    assert PAPER.box == (
        pair_of("0.21205", "0.21215"),
        pair_of("-0.20005", "-0.19995"),
        pair_of("0.005", "0.015"),
    )
    exact = replace(PAPER, reach=None)
    assert exact.box == tuple(pair_of(x, x) for x in (PAPER.eta, PAPER.nu, PAPER.epsilon))
    assert replace(PAPER, epsilon=None).box is None
    assert replace(PAPER, epsilon=Fraction(0)).box[2] == pair_of(0, "0.005")


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
    with pytest.raises(NotACertificate):
        parameters(document)


@pytest.mark.parametrize(
    "reach", ["1/100", ["0", "0"], ["0"] * 4, ["0", "0", "2/200"], [0, 0, 0], {}, ["0", "0", None]]
)
def test_boxes_in_another_form(reach):
    document = parameters_to_json(PAPER) | {"reach": reach}
    with pytest.raises(Malformed):
        parameters_from_json(Reader(document))
    with pytest.raises(NotACertificate):
        parameters(document)


@pytest.mark.parametrize("of", [PAPER, replace(PAPER, reach=None), reaching(PAPER, 0, "1/7", 0)])
def test_parameters_are_read_as_written(of):
    document = json.loads(json.dumps(parameters_to_json(of)))
    assert parameters_from_json(Reader(document)) == parameters(document) == of


# -- parts that cover a box ------------------------------------------------------------------------


def cut(box, count, generator):
    """Cut a box into parts at random."""
    parts = [box]
    while len(parts) < count:
        one = parts.pop(generator.randrange(len(parts)))
        side = generator.choice([k for k in range(3) if one[k][0] < one[k][1]])
        low, high = one[side]
        at = low + (high - low) * Fraction(generator.randint(1, 9), 10)
        parts += [(*one[:side], ends, *one[side + 1 :]) for ends in ((low, at), (at, high))]
    generator.shuffle(parts)
    return parts


@pytest.mark.parametrize("box", [((0, 1),) * 3, ((0, 1), (2, 2), (0, 3)), ((0, 0), (0, 0), (0, 1))])
def test_parts_cover_a_box_and_fewer_do_not(box):
    box = tuple(pair_of(*side) for side in box)
    generator = random.Random(7)
    for count in (1, 2, 3, 5, 9, 17):
        parts = cut(box, count, generator)
        assert covered(box, parts)
        for left_out in range(count):
            assert not covered(box, parts[:left_out] + parts[left_out + 1 :])


def test_a_smaller_box_is_covered_and_a_larger_is_not():
    unit = (pair_of(0, 1),) * 3
    parts = cut(unit, 9, random.Random(3))
    assert covered((pair_of("1/3", "2/3"),) * 3, parts)
    assert covered((pair_of("1/3", "1/3"),) * 3, parts)
    assert not covered((pair_of(0, 1), pair_of(0, 1), pair_of(0, "1.001")), parts)
    assert not covered((pair_of(0, 1), pair_of(2, 2), pair_of(0, 1)), parts)
    assert not covered(unit, [])


# -- what the claim makes of conclusions -----------------------------------------------------------

STEEP = ((pair_of(5, 6), pair_of("1/50", "1/20")), (pair_of("-1/2", "1/2"), pair_of(0, "1/200")))


def mapped(phases, box=PAPER.box, left="1.10", right="1.33"):
    """What could be known about F on a rectangle: on the printed ones, a horseshoe."""
    ends = pair_of(left, left), pair_of(right, right)
    return Rectangle(box, phases, PAPER.velocities, 0, *ends, pair_of("-0.43", "-0.23"), STEEP)


def both(box=PAPER.box, **more):
    return [mapped(PAPER.left, box, **more), mapped(PAPER.right, box, **more)]


def with_nu(low, high):
    return PAPER.box[0], pair_of(low, high), PAPER.box[2]


POINT = tuple(pair_of(x, x) for x in (PAPER.eta, PAPER.nu, PAPER.epsilon))
CORNER = tuple((low, low) for low, _ in PAPER.box)
OUTSIDE = (*CORNER[:2], pair_of("0.0049", "0.0049"))
PARTLY = (*CORNER[:2], pair_of("0.0049", "0.006"))


def word(box, sets=(PAPER.left, PAPER.right), velocities=PAPER.velocities):
    return BarredWord(box, sets, velocities, (1, 1, 1), Fraction(1, 100))


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        (both(), Verdict.VERIFIED),
        (both(with_nu("-0.21", "-0.19")), Verdict.VERIFIED),
        (both(with_nu("-0.21", "-0.2")) + both(with_nu("-0.2", "-0.19")), Verdict.VERIFIED),
        (both(with_nu("-0.21", "-0.2")), Verdict.UNDECIDED),
        (both(with_nu("-0.21", "-0.2")) + both(with_nu("-0.1999", "-0.19")), Verdict.UNDECIDED),
        (both(POINT), Verdict.UNDECIDED),
        (both()[:1], Verdict.UNDECIDED),
        ([both()[0], both(with_nu("-0.21", "-0.19"))[1]], Verdict.UNDECIDED),
        (both(left="1.12"), Verdict.UNDECIDED),
        (both(right="1.315"), Verdict.UNDECIDED),
        ([replace(one, velocities=pair_of("-0.44", 0)) for one in both()], Verdict.UNDECIDED),
        ([mapped(pair_of("1.105", "1.15")), mapped(PAPER.right)], Verdict.UNDECIDED),
        ([word(POINT)], Verdict.REFUTED),
        ([word(CORNER)], Verdict.REFUTED),
        ([word(PAPER.box)], Verdict.REFUTED),
        ([*both(with_nu("-0.21", "-0.2")), word(CORNER)], Verdict.REFUTED),
        ([word(OUTSIDE)], Verdict.UNDECIDED),
        ([word(PARTLY)], Verdict.UNDECIDED),
        ([word(POINT, sets=(PAPER.left, pair_of("1.27", "1.33")))], Verdict.UNDECIDED),
        ([word(POINT, velocities=pair_of("-0.4", 0))], Verdict.UNDECIDED),
        ([], Verdict.UNDECIDED),
    ],
)
def test_the_whole_box_or_a_point_of_it(found, expected):
    decision = find("N4").decide(PAPER, found)
    assert decision.verdict is expected
    assert (decision.witness is not None) is (expected is Verdict.REFUTED)


def test_a_correction_is_about_other_rectangles_on_the_whole_box():
    other = [mapped(pair_of("1.12", "1.15")), mapped(pair_of("1.27", "1.325"))]
    decision = find("N4").decide(PAPER, [*both(POINT), *other, word(POINT)])
    assert decision.corrected.startswith(
        "For eta in [0.21205, 0.21215], nu in [-0.20005, -0.19995]"
    )
    assert "[1.12, 1.15] x [-0.45, 0] and [1.27, 1.325] x [-0.45, 0]" in decision.corrected


def test_without_restitution_the_theorem_is_about_f():
    of = replace(reaching(PAPER, 0, "0.01", 0), epsilon=Fraction(0))
    decision = find("N4").decide(of, both(of.box))
    assert decision.verdict is Verdict.VERIFIED
    assert "the plastic map f" in decision.corrected
    assert "one-sided full shift" in decision.corrected and "two-sided" not in decision.corrected


@pytest.mark.parametrize("missing", ["epsilon", "velocities"])
def test_a_box_needs_its_numbers(missing):
    of = replace(PAPER, **{missing: None})
    assert find("N4").decide(of, [*both(), word(POINT)]).verdict is Verdict.UNDECIDED


def test_failing_edges_are_named_with_their_point_and_margin():
    reach = Fraction(1, 1000)
    phase, gamma = PAPER.right[1], PAPER.velocities[0]
    image = Fraction("1.30") - reach, Fraction("1.30") + reach
    state = Rebound(CORNER, (phase, phase), (gamma, gamma), 0, image, pair_of(-1, 0), STEEP)
    said = find("N4").decide(PAPER, [state])
    assert said.verdict is Verdict.UNDECIDED
    assert said.why.startswith(
        "at eta = 0.21205, nu = -0.20005, epsilon = 0.005 the right edge of V2"
    )
    assert "short of 1.32 by at least 0.019" in said.why
    assert "0.019" not in find("N4").decide(PAPER, [replace(state, box=OUTSIDE)]).why
    edge = replace(state, box=PAPER.box, velocities=PAPER.velocities, phase=pair_of("1.3", "1.4"))
    said = find("N4").decide(PAPER, [edge])
    assert "not proved to be mapped beyond 1.32" in said.why and "up to 0.02 short" in said.why


# -- what is proved, against other arithmetic ------------------------------------------------------


def image(numbers, state):
    """The next phase in floating point, by a scan of (14) from just after the launch."""
    phi, gamma = state

    def height(t):
        return -reference.left_side_14(*numbers, phi, gamma, t, math.sin, math.cos)

    t = 0.1
    while height(t + 0.01) > 0:
        t += 0.01
    low, high = t, t + 0.01
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    velocity = reference.right_side_15(*numbers, phi, gamma, low, math.sin, math.cos)
    return (phi + low) % math.tau, velocity


def least_overshoot(of, sets):
    """By how much the four edges go beyond at the corners of the box."""
    margins = []
    for numbers in product(*(map(float, side) for side in of.box)):
        for ends, gamma in product(sets, map(float, of.velocities)):
            margins.append(sets[0][0] - image(numbers, (ends[0], gamma))[0])
            margins.append(image(numbers, (ends[1], gamma))[0] - sets[1][1])
    return min(margins)


@pytest.fixture(scope="module")
def paper():
    return made(PAPER)


@pytest.fixture(scope="module")
def wide():
    return made(WIDE)


@pytest.mark.slow
def test_the_printed_rectangles_are_refuted_and_others_proved(paper):
    row, certificate = paper
    assert row.verdict is Verdict.REFUTED
    (claim,) = certificate["claims"]
    point = "at eta = 0.2121, nu = -0.2, epsilon = 0.01 "
    assert claim["witness"].startswith(point + "no orbit of F follows V2 V2 V2 V2 V2")
    assert point + "the right edge of V2 reaches phase [1.300825, 1.300826]" in claim["witness"]
    assert "short of 1.32 by at least 0.019174" in claim["witness"]
    assert claim["corrected"].startswith(
        "For eta in [0.21205, 0.21215], nu in [-0.20005, -0.19995], epsilon in [0.005, 0.015]: on "
        "N1, N2 = [1.1, 1.17] x [-0.45, 0] and [1.26, 1.34] x [-0.45, 0] "
    )


def test_wider_rectangles_are_verified(wide):
    row, certificate = wide
    assert row.verdict is Verdict.VERIFIED
    assert "by at least 0.051" in row.why
    assert len(render(certificate)) < 100_000


@pytest.mark.slow
def test_edges_go_beyond_at_the_corners_of_the_box():
    assert 0.0515 < least_overshoot(WIDE, ((1.09, 1.18), (1.25, 1.35))) < 0.06
    assert least_overshoot(PAPER, ((1.1, 1.17), (1.26, 1.34))) > 0.0171
    assert least_overshoot(PAPER, ((1.11, 1.16), (1.27, 1.33))) < 0  # N1's: for the point alone


@pytest.mark.slow
def test_a_plastic_box():
    of = replace(
        reaching(PAPER, "0.00005", "0.00005", 0),
        epsilon=Fraction(0),
        left=pair_of("1.1", "1.15"),
        right=pair_of("1.27", "1.32"),
        interval=pair_of("1.1", "1.32"),
    )
    row, _ = made(of)
    assert row.verdict is Verdict.VERIFIED
    assert "the plastic map f is continuously differentiable" in row.corrected
    assert "f' >= 4.02" in row.corrected
    assert least_overshoot(of, ((1.1, 1.15), (1.27, 1.32))) > 0.0004


@pytest.mark.slow
def test_nu_read_to_one_place_is_refuted_at_a_point():
    """No orbit follows V1 V2 V2 V2 there: even the rightmost image of V1 leaves V2 to the left."""
    row, certificate = made(reaching(WIDE, "0.00005", "0.05", "0.005"))
    assert row.verdict is Verdict.REFUTED
    witness = certificate["claims"][0]["witness"]
    assert witness.startswith("at eta = 0.2121, nu = -0.2125, epsilon = 0.01 no orbit of F follows")
    assert "V1 V2 V2 V2" in witness and "the right edge of V1 reaches phase [1.3" in witness
    phase = image((0.2121, -0.2125, 0.01), (1.18, 0.0))[0]
    assert 1.25 < phase < 1.35
    for _ in range(2):
        phase = image((0.2121, -0.2125, 0.01), (phase, 0.0))[0]
    assert phase < 1.25
    assert "nu in [-0.203125, -0.196875]" in row.corrected


@pytest.mark.slow
def test_a_box_in_parts():
    of = reaching(WIDE, "0.0001", "0.001", "0.002")
    row, certificate = made(of)
    assert row.verdict is Verdict.VERIFIED
    names = [n for n, step in certificate["steps"].items() if step["rule"] == "rectangle"]
    assert len(names) > 2
    certificate["claims"][0]["proof"] = [
        name for name in certificate["claims"][0]["proof"] if name != names[-1]
    ]
    with pytest.raises((Rejected, Malformed)):
        check(json.dumps(certificate))


@pytest.mark.slow
@pytest.mark.parametrize(
    "change",
    [
        {"velocities": pair_of("0.5", "1")},  # impossible states
        {"velocities": pair_of("-0.3", 0)},  # images leave them
        {"epsilon": None},
        {"velocities": None},
    ],
)
def test_undecided(change):
    assert made(replace(WIDE, **change))[0].verdict is Verdict.UNDECIDED


@pytest.mark.slow
def test_a_word_is_barred_for_each_oscillator_anew():
    prover = ReboundProver(PAPER, Prover(System(PAPER.eta, PAPER.nu), 30, HORIZON))
    names = []
    for epsilon in ("0.01", "0.0102"):
        box = (*POINT[:2], pair_of(epsilon, epsilon))
        pair = prover.pair(box, (PAPER.left, PAPER.right), ())
        names.append(prover.bar(pair, (1,) * 5, 1))
        assert prover.words[names[-1]].box == box
        assert prover.bar(pair, (1,) * 5, 1) == names[-1]
    assert len(set(names)) == 2


# -- the command -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_command_takes_a_box(tmp_path, capsys):
    sets = ["--left", "1.09", "1.18", "--right", "1.25", "1.35"]
    box = ["--reach", "0.0001", "0", "1/1000"]
    where = ["--only", "N4", "--out", str(tmp_path)]
    assert run("nonplastic", [*sets, *box, *where]) == 0
    said = capsys.readouterr().out
    assert "For all eta in [0.212, 0.2122], nu = -0.2, epsilon in [0.009, 0.011]" in said
    assert json.loads((tmp_path / "nonplastic.json").read_text())["parameters"]["reach"] == [
        "1/10000",
        "0",
        "1/1000",
    ]


@pytest.mark.parametrize("reach", [*LEAVING, ("0", "0", "0.011"), ("a", "0", "0"), ("0", "0")])
def test_the_command_refuses_other_boxes(tmp_path, capsys, reach):
    with pytest.raises(SystemExit) as leaving:
        run("nonplastic", ["--only", "N4", "--out", str(tmp_path / "new"), "--reach", *reach])
    assert leaving.value.code == 2
    assert "reach" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


# -- certificates edited on purpose ----------------------------------------------------------------


def rejected(certificate, change):
    edited = copy.deepcopy(certificate)
    change(edited)
    with pytest.raises((Rejected, Malformed)):
        check(json.dumps(edited))


@pytest.mark.parametrize(
    "reach",
    [
        ["1/20000", "1/20000", "1/199"],
        ["1/20000", "1/19999", "1/200"],
        ["1/19999", "1/20000", "1/200"],
        ["1/20000", "1/20000", "1/201"],
        None,
    ],
)
def test_the_box_is_what_is_stated(wide, reach):
    def change(certificate):
        certificate["parameters"]["reach"] = reach

    rejected(wide[1], change)

    def renewed(certificate):
        change(certificate)
        of = parameters_from_json(Reader(certificate["parameters"]))
        certificate["claims"][0]["statement"] = find("N4").says(of)

    if reach not in (None, ["1/20000", "1/20000", "1/201"]):  # these are inside what is proved
        rejected(wide[1], renewed)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("field", "old", "new"),
    [
        ("verdict", "REFUTED", "UNDECIDED"),
        ("verdict", "REFUTED", "VERIFIED"),
        ("witness", "nu = -0.2,", "nu = -0.21,"),
        ("witness", "V2 V2 V2 V2 V2", "V2 V2 V2 V2"),
        ("corrected", "[0.005, 0.015]", "[0.004, 0.015]"),
        ("corrected", "[1.26, 1.34]", "[1.27, 1.33]"),
        ("statement", "exactly one", "at least one"),
    ],
)
def test_texts_edited(paper, field, old, new):
    def change(certificate):
        (claim,) = certificate["claims"]
        assert old in claim[field]
        claim[field] = claim[field].replace(old, new)

    rejected(paper[1], change)


def test_a_correction_of_the_plastic_claims_has_no_box():
    certificate = accepted()
    assert certificate["corrected"]["parameters"]["reach"] is None

    def change(edited):
        edited["corrected"]["parameters"]["reach"] = ["0", "0", "0"]

    rejected(certificate, change)


def test_verified_needs_its_steps(wide):
    def change(certificate):
        (claim,) = certificate["claims"]
        claim["proof"] = claim["proof"][:-1]

    rejected(wide[1], change)


@pytest.mark.parametrize("side", ["eta", "nu", "epsilon"])
def test_parts_of_the_box_narrowed(wide, side):
    """Rectangles for less than the box are proved all the same, the claim is not."""

    def change(certificate):
        for step in certificate["steps"].values():
            if step["rule"] == "rectangle":
                low, high = map(Fraction, step["witness"][side])
                step["witness"][side] = [str(low), str(high - (high - low) / 10**6)]

    rejected(wide[1], change)
