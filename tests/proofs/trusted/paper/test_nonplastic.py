"""Claims N1-N3: verdicts against independent numbers, and certificates that must be rejected."""

import copy
import json
import math
import random
from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.shell.groups import produce
from proofs.trusted.certificate import Malformed, render
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.paper import reference


def made(claims, of=PAPER):
    """The verdicts by claim, and the certificate, which the checker accepts."""
    found = produce({"nonplastic": claims}, of, digits=30)
    report = check(found.certificate)
    assert [(each.id, each.verdict) for each in report.claims] == [
        (line.id, line.verdict) for line in found.lines
    ]
    return {line.id: line.verdict for line in found.lines}, json.loads(found.certificate)


@pytest.fixture(scope="module")
def paper():
    return made(["N1", "N2"])


def entry(certificate, claim):
    return next(one for one in certificate["claims"] if one["id"] == claim)


# -- what is proved --------------------------------------------------------------------------------


def test_verdicts(paper):
    assert paper[0] == {"N1": Verdict.REFUTED, "N2": Verdict.VERIFIED}


def corner(phi, gamma, near):
    """The image phase of a state, by the root of (14) typed by hand, at 50 digits."""
    numbers = [mpf(x) for x in ("0.2121", "-0.2", "0.01", phi, gamma)]
    time = mp.findroot(lambda t: reference.left_side_14(*numbers, t), near)
    return (numbers[3] + time) % (2 * mp.pi)


@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("image_of_left_edge_of_V1", ("1.11", "0", 25.13)),
        ("image_of_right_edge_of_V1", ("1.15", "-0.45", 25.28)),
        ("image_of_left_edge_of_V2", ("1.27", "0", 56.36)),
        ("image_of_right_edge_of_V2", ("1.32", "-0.45", 56.53)),
    ],
)
def test_extreme_images_of_the_edges(paper, name, state):
    printed = entry(paper[1], "N1")["quantities"][name]
    true = corner(*state)
    assert mpf(printed["lower"]) <= true <= mpf(printed["upper"])
    assert mpf(printed["upper"]) - mpf(printed["lower"]) < mpf(10) ** -25


def test_texts_name_what_fails_and_what_holds(paper):
    refuted = entry(paper[1], "N1")
    assert "V2 V2 V2 V2" in refuted["witness"]
    assert "short of 1.32 by at least 0.019174" in refuted["witness"]
    assert "V1 = [1.11, 1.16] x [-0.45, 0], V2 = [1.27, 1.33] x [-0.45, 0]" in refuted["corrected"]
    assert "golden mean" in refuted["corrected"]
    assert "physically possible" in refuted["corrected"]


def image(state):
    """F in floating point, by a scan of (14)."""
    phi, gamma = state
    numbers = (0.2121, -0.2, 0.01, phi, gamma)

    def height(t):
        return -reference.left_side_14(*numbers, t, math.sin, math.cos)

    t = 24.0 if phi < 1.2 else 56.0  # no impact before: seen in scans from 0
    while height(t + 0.005) > 0:
        t += 0.005
    low, high = t, t + 0.005
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    velocity = reference.right_side_15(*numbers, low, math.sin, math.cos)
    return (phi + low) % math.tau, velocity


def symbol(state):
    phases = ((1.11, 1.15), (1.27, 1.32))
    return next((i for i, (low, high) in enumerate(phases) if low <= state[0] <= high), None)


def test_barred_words_are_not_seen_and_others_are():
    random.seed(1)
    seen = set()
    for _ in range(600):
        state = (random.choice((1.11, 1.27)) + random.uniform(0, 0.05), random.uniform(-0.45, 0))
        word = []
        while (now := symbol(state)) is not None and len(word) < 6:
            word.append(now)
            state = image(state)
        seen.update(tuple(word[i:j]) for i in range(len(word)) for j in range(i + 1, len(word) + 1))
    assert {(0, 0), (0, 1), (1, 0), (1, 1)} <= seen
    assert not seen & {(1, 1, 1, 1, 1), (0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1)}


@pytest.mark.slow
def test_orbits_and_ranges():
    verdicts, certificate = made(["N3"])
    assert verdicts["N3"] is Verdict.VERIFIED
    corrected = entry(certificate, "N3")["corrected"]
    assert (
        "eta in [0.21205, 0.21215], nu in [-0.20475, -0.1965], epsilon in [0, 0.015]" in corrected
    )
    assert "without 22" in corrected
    assert "short of 1.34 by at least 0.0022" in corrected
    assert len(render(certificate)) < 1_000_000


@pytest.mark.slow
def test_undecided_says_where_edges_go():
    """At nu = -0.25 a rectangle grazes; the images of its corners are proved all the same."""
    verdicts, certificate = made(["N1"], replace(PAPER, nu=Fraction("-0.25")))
    assert verdicts["N1"] is Verdict.UNDECIDED
    assert (
        "the right edge of V2 to a phase in [1.015248, 1.015249]"
        in (entry(certificate, "N1")["why"])
    )


@pytest.mark.slow
def test_an_edge_alone_refutes():
    verdicts, certificate = made(["N1"], replace(PAPER, eta=Fraction("0.212")))
    assert verdicts["N1"] is Verdict.REFUTED
    assert (
        "the left edge of V1 to a phase in [1.114936, 1.114937], short of 1.11 by at least "
        in (entry(certificate, "N1")["witness"])
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "verdicts"),
    [
        ({"left": ("1.11", "1.16"), "right": ("1.27", "1.33")}, ("VERIFIED", "VERIFIED")),
        ({"epsilon": "0"}, ("REFUTED", "UNDECIDED")),  # the left edge of V1 fails
        ({"nu": "-0.25"}, ("UNDECIDED", "UNDECIDED")),
        ({"velocities": ("-0.3", "0")}, ("REFUTED", "UNDECIDED")),  # images leave them
        ({"velocities": ("0.5", "1")}, ("UNDECIDED", "UNDECIDED")),  # impossible states
        ({"epsilon": None}, ("UNDECIDED", "UNDECIDED")),
        ({"velocities": None}, ("UNDECIDED", "UNDECIDED")),
    ],
)
def test_other_numbers(change, verdicts):
    exact = {
        name: value
        if value is None
        else Fraction(value)
        if isinstance(value, str)
        else tuple(map(Fraction, value))
        for name, value in change.items()
    }
    left, right = (exact.get(name, getattr(PAPER, name)) for name in ("left", "right"))
    of = replace(PAPER, **exact, interval=(left[0], right[1]))
    assert tuple(each.value for each in made(["N1", "N2"], of)[0].values()) == verdicts


# -- what must be rejected -------------------------------------------------------------------------


def broken(paper, change):
    certificate = copy.deepcopy(paper[1])
    change(certificate)
    with pytest.raises((Rejected, Malformed)) as failure:
        check(json.dumps(certificate))
    return str(failure.value)


def steps(certificate, rule):
    return [step["witness"] for step in certificate["steps"].values() if step["rule"] == rule]


def wide(certificate):
    """A rebound step about a part of a rectangle."""
    return next(
        one for one in steps(certificate, "rebound") if one["phases"][0] != one["phases"][1]
    )


def test_bracket_moved(paper):
    def change(certificate):
        one = wide(certificate)
        one["impact"] = [str(Fraction(x) + Fraction(1, 4)) for x in one["impact"]]

    assert "bracket" in broken(paper, change)


def test_bracket_tightened(paper):
    def change(certificate):
        one = wide(certificate)
        low, high = map(Fraction, one["impact"])
        one["impact"] = [str(low + (high - low) / 3), str(high - (high - low) / 3)]

    assert "signs" in broken(paper, change)


def test_bracket_ends_before_the_impact(paper):
    def change(certificate):
        one = wide(certificate)
        low, high = map(Fraction, one["impact"])
        one["impact"][1] = str(low + (high - low) / 1000)

    assert "signs" in broken(paper, change)


def test_bracket_of_a_later_zero(paper):
    """At (1.15, -0.45) the formal gap is positive again after the impact and falls at 56.1."""
    numbers = [mpf(x) for x in ("0.2121", "-0.2", "0.01", "1.15", "-0.45")]
    later = mp.findroot(lambda t: reference.left_side_14(*numbers, t), 56.1)
    assert later > 50
    assert -reference.left_side_14(*numbers, later - 0.01) > 0

    def change(certificate):
        one = next(
            one
            for one in steps(certificate, "rebound")
            if one["phases"] == ["23/20"] * 2 and one["velocities"] == ["-9/20"] * 2
        )
        centre = Fraction(mp.nstr(later, 30))
        one["impact"] = [str(centre - Fraction(1, 10**6)), str(centre + Fraction(1, 10**6))]

    assert "window" in broken(paper, change)


@pytest.mark.parametrize("left_out", range(4))
def test_golden_mean_without_a_word(paper, left_out):
    def change(certificate):
        (golden,) = steps(certificate, "golden-mean")
        del golden["words"][left_out]

    assert "repeated" in broken(paper, change)


@pytest.mark.parametrize("field", ["eta", "nu", "epsilon", "phases"])
def test_box_widened(paper, field):
    def change(certificate):
        one = wide(certificate)
        low, high = map(Fraction, one[field])
        one[field] = [str(low * Fraction(19, 20)), str(high * Fraction(21, 20))]
        if low < 0:
            one[field] = [str(low * Fraction(21, 20)), str(high * Fraction(19, 20))]

    broken(paper, change)


def test_impossible_velocities(paper):
    def change(certificate):
        wide(certificate)["velocities"][1] = "1/2"

    assert "possible" in broken(paper, change)


@pytest.mark.parametrize("kept", [2, 3])
def test_times_left_out(paper, kept):
    def change(certificate):
        one = wide(certificate)
        one["times"] = one["times"][: kept - 1] + one["times"][-1:]

    broken(paper, change)


def test_times_end_before_the_impact(paper):
    def change(certificate):
        one = wide(certificate)
        one["times"] = one["times"][:-2]

    assert "negative" in broken(paper, change)


def test_first_step_too_long(paper):
    def change(certificate):
        one = wide(certificate)
        one["times"] = one["times"][one["times"].index("1") + 3 :]

    assert "leave the table" in broken(paper, change)


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [
        ("eta", ["-1", "1"], "required"),
        ("eta", ["0", "1"], "required"),
        ("nu", ["-1/5", "1/5"], "positive or negative"),
        ("nu", ["0", "1/5"], "positive or negative"),
        ("epsilon", ["-1/100", "1/100"], "required"),
        ("epsilon", ["1/100", "11/10"], "required"),
        ("phases", ["1", "7"], "between 0 and 2 pi"),
        ("phases", ["-1/10", "1"], "between 0 and 2 pi"),
        ("times", ["1", "1", "26"], "increase"),
        ("times", ["0", "1", "26"], "increase"),
        ("times", ["26"], "entries"),
        ("times", ["1", "2000000"], "at most"),
        ("impact", ["25", "25"], "empty"),
        ("impact", ["26", "25"], "reversed"),
    ],
)
def test_outside_the_model(paper, field, value, reason):
    def change(certificate):
        wide(certificate)[field] = value

    assert reason in broken(paper, change)


@pytest.mark.parametrize("left_out", [0, -1])
def test_part_left_out(paper, left_out):
    def change(certificate):
        del steps(certificate, "rectangle")[0]["parts"][left_out]

    assert "entries" in broken(paper, change) or "cover" in broken(paper, change)


def test_edges_exchanged(paper):
    def change(certificate):
        steps(certificate, "rectangle")[0]["edges"].reverse()

    broken(paper, change)


def test_horseshoe_on_the_printed_rectangles(paper):
    def change(certificate):
        printed = steps(certificate, "barred-word")[0]["rectangles"]
        steps(certificate, "rectangle-horseshoe")[0]["rectangles"] = printed

    assert "not mapped beyond" in broken(paper, change)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("word", "11"),
        ("word", "1111"),
        ("word", "0000"),
        ("word", "12"),
        ("word", ""),
        ("from", "below"),
        ("from", "left"),
        ("rectangles", ["rectangle-2", "rectangle-1"]),
        ("rectangles", ["rectangle-1", "rectangle-1"]),
        ("rectangles", ["rebound-1", "rebound-2"]),
        ("images", ["rectangle-1"]),
        ("images", []),
    ],
)
def test_word_edited(paper, field, value):
    def change(certificate):
        constant = [one for one in steps(certificate, "barred-word") if "0" not in one["word"]]
        constant[0][field] = value

    broken(paper, change)


def test_bound_lowered(paper):
    def change(certificate):
        image = certificate["steps"][steps(certificate, "barred-word")[0]["images"][-1]]["witness"]
        image["phases"] = [str(Fraction(x) - Fraction(1, 1000)) for x in image["phases"]]

    broken(paper, change)


@pytest.mark.parametrize(
    ("claim", "field", "old", "new"),
    [
        ("N1", "verdict", "REFUTED", "VERIFIED"),
        ("N1", "witness", "V2 V2 V2 V2 V2", "V2 V2 V2"),
        ("N1", "witness", "0.019174", "0.019175"),
        ("N1", "corrected", "[1.11, 1.16]", "[1.11, 1.15]"),
        ("N1", "corrected", "every period", "period 2"),
        ("N1", "statement", "across both", "into both"),
        ("N2", "verdict", "VERIFIED", "REFUTED"),
        ("N2", "corrected", "at least 4 times", "at least 5 times"),
        ("N2", "corrected", "V2 = [1.27, 1.32]", "V2 = [1.27, 1.33]"),
    ],
)
def test_text_edited(paper, claim, field, old, new):
    def change(certificate):
        one = entry(certificate, claim)
        assert old in one[field]
        one[field] = one[field].replace(old, new)

    broken(paper, change)


def test_quantity_tightened(paper):
    def change(certificate):
        bounds = entry(certificate, "N1")["quantities"]["image_of_right_edge_of_V2"]
        bounds["lower"] = bounds["upper"]

    assert "enclosure" in broken(paper, change)


@pytest.mark.parametrize("rule", ["barred-word", "rectangle", "rebound"])
def test_proof_without_some_steps(paper, rule):
    def change(certificate):
        names = [name for name, step in certificate["steps"].items() if step["rule"] == rule]
        for one in certificate["claims"]:
            one["proof"] = [name for name in one["proof"] if name not in names]

    broken(paper, change)


@pytest.mark.parametrize(
    ("field", "value"),
    [("eta", "2122/10000"), ("epsilon", "1/50"), ("nu", "-19/100"), ("velocities", ["-1/2", "0"])],
)
def test_other_parameters(paper, field, value):
    def change(certificate):
        certificate["parameters"][field] = value

    broken(paper, change)


def test_too_much_work(paper):
    certificate = copy.deepcopy(paper[1])
    one = wide(certificate)
    last = Fraction(one["times"][-1])
    one["times"] = [str(last * k / 9000) for k in range(1, 9001)]
    one["impact"] = [str(Fraction(1, 2**3900)), str(Fraction(1, 2**3899))]
    with pytest.raises(Exhausted):
        check(json.dumps(certificate))
