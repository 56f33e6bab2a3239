"""Two rectangles of states with restitution in Coq: what is stated, accepted, and refused."""

import json
import re
from functools import cache, partial

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.formal import __main__ as formal
from proofs.formal import coqc, rebounds
from proofs.trusted.verify import check
from tests.proofs.formal.coq import ROOT, asking, computed, needs_coqc, one

NONPLASTIC = ROOT / "reports" / "nonplastic.json"
RECTANGLES = "(111 / 100) (29 / 25) (127 / 100) (133 / 100) (-9 / 20) (0)"


@cache
def repaired():
    """The case of the paper's repaired rectangles."""
    source = NONPLASTIC.read_text()
    return rebounds.case(check(source), source, "0")


@pytest.mark.slow
def test_what_is_stated_at_the_paper_s_parameters():
    made = repaired()
    said = coqc.statements(made.text, [theorem.name for theorem in made.theorems])
    assert f"two_sided_shift rebound {RECTANGLES}" in said("rectangles_horseshoe")
    edge = said("printed_edge_falls_short")
    assert "exists z, rebound ((33 / 25), (-9 / 20)) z /\\ (111 / 100) < fst z < (33 / 25)" in edge
    assert "forall f g, (127 / 100) <= f <= (133 / 100)" in edge  # in one turn of the circle
    assert "Definition eps := (1 / 100)." in made.text and "side := -1." in made.text


@cache
def strips():
    """The pieces of both rectangles, with what is flown in them."""
    source = NONPLASTIC.read_text()
    report = check(source)
    (shoe, maps), *_ = rebounds._found(report, source)
    writer = rebounds.Rectangles(shoe, maps)
    return list(zip(writer.flights, writer.pieces, strict=True)), writer.bounds


def exactly(x):
    """A rational for mpmath."""
    return mpmath.mpf(x.numerator) / x.denominator


def within(value, enclosure):
    """Whether a value is enclosed, up to the error of differences."""
    low, high = map(exactly, enclosure.range)
    return low - 1e-9 <= value <= high + 1e-9


def image(numbers, phase, gamma, near):
    """Phase, not reduced, and velocity of the next impact, typed from the paper's (14), (15)."""
    eta, nu, eps = numbers
    kick = eps * gamma + nu / eta * (1 + eps) * mpmath.cos(phase)
    rise = 1 + nu * mpmath.sin(phase)

    def height(t):
        wall = 1 + nu * mpmath.sin(phase + t)
        return rise * mpmath.cos(eta * t) + kick * mpmath.sin(eta * t) - wall

    time = mpmath.findroot(height, near)
    return time, phase + time, rise * mpmath.sin(eta * time) - kick * mpmath.cos(eta * time)


@pytest.mark.slow
@given(
    st.integers(0, 1),
    st.floats(0, 1),
    st.floats(0, 1),
    st.floats(0, 1),
)
def test_df_and_times_are_enclosed_and_within_the_bounds(i, which, part, height):
    of, bounds = strips()
    flights, pieces = of[i]
    piece = pieces[min(int(which * len(pieces)), len(pieces) - 1)]
    unit = flights.unit
    with mpmath.workdps(30):
        low, high = map(exactly, flights.velocities)
        numbers = [exactly(x) for x in flights.sides]
        phase = mpmath.mpf(piece.cut.a + part * (piece.cut.b - piece.cut.a)) / unit
        gamma = low + height * (high - low)
        near = mpmath.mpf(piece.early + piece.late) / 2 / unit
        time, _, velocity = image(numbers, phase, gamma, near)
        assert piece.early <= time * unit <= piece.late and low <= velocity <= high
        entries, enclosed = flights.entries(piece)
        assert within(velocity, enclosed)
        exact = [
            mpmath.diff(lambda *at, j=j: image(numbers, *at, near)[j], (phase, gamma), order)
            for j in (1, 2)
            for order in ((1, 0), (0, 1))
        ]
        for value, entry in zip(exact, entries, strict=True):
            assert within(value, entry)
        p, q, r, s = map(exactly, bounds)
        assert exact[0] >= p
        assert all(abs(x) <= most for x, most in zip(exact[1:], (q, r, s), strict=True))


@needs_coqc
@pytest.mark.long
def test_coqc_accepts_the_repaired_rectangles(capsys, tmp_path):
    assert formal.main([str(NONPLASTIC), "--out", str(tmp_path), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in answer["theorems"]] == [
        "model",
        "rectangles_horseshoe",
        "hyperbolic",
        "printed_edge_falls_short",
    ]
    assert set(answer["axioms"]) == coqc.REALS


def number(head, place, change):
    """An edit of a number after a head, by its place."""
    pattern = f"({head}" + r" \(-?\d+\)" * place + r") \((-?\d+)\)"
    return one(pattern, lambda found: f"{found[1]} ({change(int(found[2]))})")


bound = partial(number, "Bounds")


def strip(name, place, change):
    return number(f"Definition {name} := Strip", place, change)


LIES = {
    "P is larger": bound(0, lambda x: x * 2),
    "Q is smaller": bound(1, lambda x: x // 3),
    "R is smaller": bound(2, lambda x: x // 3),
    "S is smaller": bound(3, lambda x: x // 9),
    "higher velocities": bound(4, lambda x: x * 2 // 3),
    "lower velocities": bound(5, lambda x: x - 10**12),
    "no room around the velocities": bound(7, lambda x: 0),
    "the left edge further left": strip("left", 0, lambda x: x * 99 // 100),
    "the right edge further right": strip("right", 1, lambda x: x * 101 // 100),
    "a turn more": strip("left", 2, lambda x: x + 1),
    "no impact so early": strip("right", 2, lambda x: x - 1),
    "a longer launch": strip("left", 3, lambda x: x * 2),
    "a later impact": strip("left", 5, lambda x: x * 2),
    "a piece left out": one(r"\(Piece .*;\n", ""),
    "an impact too late from the left edge": one(r"\] ?\n? *(\d+) ", "] 1 "),
    "rectangles that overlap": strip("left", 1, lambda x: x * 6 // 5),
    "another eta": asking(r"569351602176", "579351602176"),
    "another nu": asking(r"\(-536870912000\)", "(-336870912000)"),
    "another side": asking(r"\(-1\)", "(1)"),
    "another coefficient of restitution": asking(r"26843545600 ", "1268435456000 "),
}


@needs_coqc
@pytest.mark.long
def test_data_on_rectangles_that_is_not_right_is_refused(tmp_path):
    text = repaired().text
    definitions = text[text.index("Definition bounds") : text.index("Lemma checked")]
    check = re.search(r"Lemma checked : (check_strips .*?) = true", text)[1]
    lies = [lie(definitions, check) for lie in LIES.values()]
    said = computed(tmp_path, "Numbers Flights Strips", lies)
    assert dict(zip(LIES, said, strict=True)) == dict.fromkeys(LIES, "false")
