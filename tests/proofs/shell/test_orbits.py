"""`python -m proofs orbits`: the periodic phases against equations typed by hand, at 50 digits."""

import csv
import io
import json
import re
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from mpmath import mp, mpf

from proofs.commands import orbits
from proofs.methods.orbits import periodic_points
from proofs.methods.words import Words
from proofs.search import periodic
from proofs.trusted.parameters import PAPER
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf

ETA, NU = mpf("0.2121"), mpf("-0.2")
EXACT = replace(
    PAPER,
    left=orbits.LEFT,
    right=orbits.RIGHT,
    interval=(orbits.LEFT[0], orbits.RIGHT[1]),
    slopes=(Fraction(1), Fraction(1)),
    ratios=None,
    printed_s0=None,
)


@cache
def horseshoe():
    return periodic.horseshoe(EXACT)


@cache
def points(length, digits):
    return periodic_points(horseshoe(), Words.of_length(length), digits)


def answer(capsys, *arguments):
    assert orbits.main([*arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def contains(bounds, value, margin=mpf(10) ** -45):
    low, high = map(as_mpf, bounds)
    return low - margin <= value <= high + margin


def flight(here, ahead):
    """The time from a phase in I0 or I1 to the next."""
    return ahead - here + 2 * mp.pi * (4 if here < 1.2 else 9)


def true_orbit(rows):
    """Solve (10) along a cycle of n phases, by Newton's method in n unknowns at 50 digits."""

    def equations(*phases):
        ahead = [*phases[1:], phases[0]]
        return [
            reference.left_side_10(ETA, NU, a, flight(a, b))
            for a, b in zip(phases, ahead, strict=True)
        ]

    start = [as_mpf(sum(row.point) / 2) for row in rows]
    if len(start) == 1:
        return [mp.findroot(lambda x: equations(x)[0], start[0])]
    return list(mp.findroot(equations, start))


def test_every_flight_is_the_first_impact():
    """By a scan for the first sign change of (10)."""
    for row in points(3, 20):
        phase = sum(row.point) / 2
        found = reference.first_impact(ETA, NU, as_mpf(phase), horizon=60)
        (ahead,) = (x for x in points(3, 20) if x.word == row.word[1:] + row.word[0])
        assert found is not None
        assert abs(found[0] - flight(as_mpf(phase), found[1])) < mpf(10) ** -30
        assert abs(found[1] - as_mpf(sum(ahead.point) / 2)) < 1e-12


@pytest.mark.parametrize("digits", [25, 40])
@pytest.mark.parametrize("word", ["0", "1", "01", "001", "0111", "00101"])
def test_phases_and_multipliers_solve_the_equations(word, digits):
    rows = periodic_points(horseshoe(), Words.rotations(word), digits)
    truth = true_orbit(rows)
    multiplier = mpf(1)
    for here, ahead in zip(truth, [*truth[1:], truth[0]], strict=True):
        multiplier *= reference.slope(ETA, NU, here, flight(here, ahead))
    for row, phase in zip(rows, truth, strict=True):
        assert contains(row.point, phase)
        assert contains(row.multiplier, multiplier, mpf(10) ** -20)
        width = Fraction(1, 10**digits)
        assert row.point[1] - row.point[0] <= width
        assert row.multiplier[1] - row.multiplier[0] <= 100 * width * row.multiplier[0]


@pytest.mark.parametrize("length", [1, 2, 5, 8])
def test_all_words_in_order(length):
    """f increases on I0 and I1: phases lie as their words do, and are pairwise disjoint."""
    rows = points(length, 12)
    assert len(rows) == 2**length
    for row in rows:
        low, high = (orbits.LEFT, orbits.RIGHT)[int(row.word[0])]
        assert low <= row.point[0] <= row.point[1] <= high
        assert Fraction("4.30") ** length <= row.multiplier[0]
        assert row.multiplier[1] <= Fraction("6.19") ** length
        periods = [d for d in range(1, length + 1) if row.word[d:] + row.word[:d] == row.word]
        assert row.period == periods[0]
    for before, after in pairwise(rows):
        assert before.word < after.word and before.point[1] < after.point[0]


@pytest.mark.slow
@pytest.mark.parametrize(("length", "digits"), [(10, 25), (7, 60)])
def test_all_orbits_solve_the_equations(length, digits):
    """With |g_t| > 1/40 and f' < 6.2, an error of e in the phases leaves about e in (10)."""
    rows = {row.word: row for row in points(length, digits)}
    assert len(rows) == 2**length
    with mp.workdps(digits + 25):
        eta, nu = mpf(2121) / 10000, mpf(-1) / 5
        for word, row in rows.items():
            here, ahead = (as_mpf(sum(x.point) / 2) for x in (row, rows[word[1:] + word[0]]))
            assert abs(reference.left_side_10(eta, nu, here, flight(here, ahead))) < mpf(10) ** (
                1 - digits
            )
            assert row.point[1] - row.point[0] <= Fraction(2, 10**digits)


@pytest.mark.slow
def test_the_machine_form(capsys):
    found = answer(capsys, "--word", "0010", "--digits", "30")
    assert found["schema"] == "impact-proofs.orbits/1"
    assert found["parameters"]["left"] == ["1.1", "1.15"]
    assert [row["word"] for row in found["orbits"]] == ["0010", "0100", "1000", "0001"]
    for row in found["orbits"]:
        assert row["period"] == 4
        for key in ("phase", "multiplier"):
            low, high = (Fraction(row[key][end]) for end in ("lower", "upper"))
            assert 0 < (high - low) * 10**29 < low
    fixed = answer(capsys, "--period", "1")["orbits"]
    assert fixed[0]["phase"]["lower"].startswith("1.1047758291275")
    assert fixed[1]["phase"]["lower"].startswith("1.3163861826663")
    assert [row["word"] for row in answer(capsys, "--word", "0101")["orbits"]] == ["0101", "1010"]


@pytest.mark.slow
def test_printed_bounds_enclose(capsys):
    """At few digits the printed bounds contain those at more."""
    more = answer(capsys, "--period", "2")["orbits"]
    for few in (["--digits", "1"], ["--digits", "9"]):
        rough = answer(capsys, "--period", "2", *few)["orbits"]
        for row, fine in zip(rough, more, strict=True):
            for key in ("phase", "multiplier"):
                assert Fraction(row[key]["lower"]) <= Fraction(fine[key]["lower"])
                assert Fraction(fine[key]["upper"]) <= Fraction(row[key]["upper"])


def test_tables(capsys, tmp_path):
    target = tmp_path / "orbits.csv"
    assert orbits.main(["--period", "5", "--csv", str(target), "--json", str(tmp_path / "o")]) == 0
    said = capsys.readouterr().out
    assert "and 16 more" in said and "32 words of length 5" in said and "orbits: 8" in said
    rows = list(csv.DictReader(io.StringIO(target.read_text())))
    machine = json.loads((tmp_path / "o").read_text())["orbits"]
    for row, entry in zip(rows, machine, strict=True):
        assert row["word"] == entry["word"] and int(row["period"]) == entry["period"]
        assert row["phase_lower"] == entry["phase"]["lower"]
        assert row["multiplier_upper"] == entry["multiplier"]["upper"]
    assert orbits.main(["--word", "1", "--csv", "-"]) == 0
    said = capsys.readouterr().out
    assert re.fullmatch(r"word,period,.*\n1,1,1\.316386182666.*\n", said)


def nothing_claimed(capsys, *arguments):
    """The one line of a command that proves nothing."""
    assert orbits.main([*arguments]) == 1
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1 and "UNDECIDED" in said.err
    return said.err


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (
            ["--left", "1.11", "1.15"],
            "f maps [1.11, 1.15] monotonically",
        ),
        (["--left", "1.1", "1.12"], "no horseshoe is proved"),
    ],
)
@pytest.mark.parametrize("how", [["--period", "3"], ["--word", "01", "--json", "-"]])
def test_without_a_horseshoe_nothing_is_claimed(arguments, reason, how, capsys):
    assert reason in nothing_claimed(capsys, *how, *arguments)


@pytest.mark.slow
def test_sets_that_hardly_lie_apart_are_no_horseshoe(capsys):
    sets = ["--left", "1.1", "1.16", "--right", "1.161", "1.32"]
    assert "no horseshoe is proved" in nothing_claimed(capsys, "--period", "3", *sets)


@pytest.mark.parametrize("word", ["0", "01", "0011"])
def test_sets_are_found_where_f_decreases(word, capsys):
    """At (0.103, 0.541) f falls on both sets: multipliers of odd words are negative, by (10)."""
    asked = ["--eta", "0.103", "--nu", "0.541", "--word", word, "--digits", "20"]
    orbit = answer(capsys, *asked)["orbits"]
    phases = [mpf(row["phase"]["lower"]) for row in orbit]
    product, eta, nu = mpf(1), mpf("0.103"), mpf("0.541")
    for here, ahead in zip(phases, [*phases[1:], phases[0]], strict=True):
        time = (ahead - here) % (2 * mp.pi) if len(word) > 1 else 2 * mp.pi
        while abs(reference.left_side_10(eta, nu, here, time)) > mpf(10) ** -17:
            time += 2 * mp.pi
        product *= reference.slope(eta, nu, here, time)
    assert (product < 0) == (len(word) % 2 == 1)
    assert abs(product / mpf(orbit[0]["multiplier"]["lower"]) - 1) < mpf(10) ** -15
