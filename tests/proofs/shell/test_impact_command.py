"""`python -m proofs impact`: what it prints and refuses; F and DF against the oracle's."""

import json
from fractions import Fraction

import pytest

from proofs.commands import impact
from proofs.motion.system import System
from proofs.search.rebound import Impossible, rebound
from tests.intervals.oracle import ends

AT = ["--eta", "0.2121", "--nu", "-0.2"]


def answer(capsys, *arguments):
    assert impact.main([*AT, *arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def test_a_point_has_the_digits_asked_for(capsys):
    found = answer(capsys, "--phi", "1.11", "--digits", "50")
    for key in ("flight", "phase", "slope"):
        low, high = (Fraction(found[key][side]) for side in ("lower", "upper"))
        assert 0 < (high - low) * 10**50 < abs(low)
    assert found["sticking"] is False
    assert found["flight"]["lower"].startswith("25.15189922112723614")


def test_an_interval_and_a_sticking_phase(capsys):
    found = answer(capsys, "--phi", "1.11", "1.15")
    assert (
        Fraction(found["phase"]["lower"]) < Fraction("1.1292") < Fraction(found["phase"]["upper"])
    )
    stuck = answer(capsys, "--phi", "4.64")
    assert stuck["sticking"] is True and stuck["slope"] == {"lower": "0", "upper": "0"}
    assert set(stuck["dwell"]) == {"lower", "upper"}


@pytest.mark.slow
def test_a_jump_gives_a_set_and_status_1(capsys):
    assert impact.main([*AT, "--phi", "1.17", "1.2", "--json", "-"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert len(found["possible"]) >= 2 and "slope" not in found
    assert impact.main([*AT, "--phi", "1.17", "1.2"]) == 1
    assert "several images are possible" in capsys.readouterr().out


def test_json_to_a_file(capsys, tmp_path):
    target = tmp_path / "answer.json"
    assert impact.main([*AT, "--phi", "1.11", "--json", str(target)]) == 0
    assert json.loads(target.read_text())["sticking"] is False
    assert "sticks first" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--eta", "1", "--nu", "1", "--phi", "1"], "forever"),
        ([*AT, "--phi", "1.57"], "horizon"),
        ([*AT, "--phi", "1.11", "--horizon", "20"], "horizon"),
        (
            [*AT, "--phi", "1.11", "--epsilon", "0.01", "--gamma", "-0.3", "--horizon", "9"],
            "before the time 9",
        ),
    ],
)
def test_no_impact_is_an_answer_and_not_bad_input(arguments, message, capsys):
    assert impact.main(arguments) == 1
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert said.err.startswith("python -m proofs impact: no impact: ") and message in said.err


def test_the_onset_of_sticking_is_undecided(capsys):
    assert impact.main([*AT, "--phi", "3.37", "3.39"]) == 1
    assert "sticking begins" in capsys.readouterr().err


# -- with restitution ------------------------------------------------------------------------------


def within(bounds, value):
    """Whether a number of the oracle's can be in bounds."""
    low, high = (Fraction(bounds[side]) for side in ("lower", "upper"))
    least, most = ends(value)
    return low <= most and least <= high


def test_for_people(capsys):
    assert impact.main([*AT, "--phi", "1.11", "--epsilon", "0.01", "--gamma", "-0.3"]) == 0
    said = capsys.readouterr().out
    assert "epsilon = 0.01, gamma = -0.3" in said
    assert "velocity gamma" in said and "d gamma / d phi" in said and "slope" not in said


@pytest.mark.slow
def test_a_jump_in_the_box_is_undecided(capsys):
    box = ["--phi", "1.19", "1.21", "--epsilon", "0.01", "--gamma", "-0.3"]
    assert impact.main([*AT, *box]) == 1
    said = capsys.readouterr()
    assert said.err.count("\n") == 1 and "undecided" in said.err and said.out == ""


def test_the_possible_velocities_depend_on_the_side():
    at = Fraction(1), Fraction(1)
    above = System(Fraction("0.2121"), Fraction("0.2"))
    with pytest.raises(Impossible, match=r"at least -0\.509"):
        rebound(above, at, (Fraction(-1), Fraction(-1)), Fraction("0.1"))
