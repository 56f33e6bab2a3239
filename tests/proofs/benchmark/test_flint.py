"""The script in python-flint beside the main job: its verdicts, and what it does not decide."""

import subprocess
import sys
from fractions import Fraction

import pytest

from proofs.benchmark import limit
from proofs.benchmark.measuring import EFFORTS
from tests.proofs.trusted import corpus

flint = pytest.importorskip("flint")

from proofs.benchmark import flint_job  # noqa: E402 (it needs flint)


def test_the_script_decides_all_as_it_is_known():
    command = [sys.executable, "-m", "proofs.benchmark.flint_job"]
    found = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert dict(line.split() for line in found.splitlines()) == corpus.VERDICTS


def test_the_script_needs_nothing_but_flint():
    code = (
        "import sys, proofs.benchmark.flint_job\n"
        "print(*(name for name in sys.modules if name.startswith('proofs.')))\n"
        "print({'numpy', 'mpmath', 'sympy', 'intervals'}.intersection(sys.modules))"
    )
    command = [sys.executable, "-c", code]
    found = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert found.splitlines() == ["proofs.benchmark proofs.benchmark.flint_job", "set()"]


def test_the_functions_agree_with_the_known_map():
    # the values that the main job reports, by other arithmetic
    image, slope = flint_job.at(Fraction("1.13"))
    assert slope.overlaps(flint.arb("5.2963535", "5e-7"))
    for phase, value in (("1.11", "4.7269475378464088834"), ("1.27", "4.3078032000324800005")):
        image, slope = flint_job.at(Fraction(phase))
        assert slope.overlaps(flint.arb(value, "1e-18"))
        assert slope.rad() < 1e-9
    image, _ = flint_job.at(Fraction("1.11"))
    assert (image - 4 * flint_job.TURN).overlaps(flint.arb("1.1291579924088902410", "1e-18"))


@pytest.mark.parametrize(
    ("name", "value", "lost"),
    [
        ("SLOPES", (Fraction("4.31"), Fraction("5.25")), {"H1", "H3", "H5", "H6", "H11"}),
        ("SLOPES", (Fraction("4.2"), Fraction("6.19")), {"H2", "H11"}),
        ("GAP", (Fraction("1.14"), Fraction("1.27")), {"H4"}),
        ("LEFT", (Fraction("1.1"), Fraction("1.15")), {"H2", "H5"}),
        ("ROOT", Fraction("0.448"), {"H11"}),
        ("RATIOS", (Fraction("0.1905"), Fraction("0.8381")), {"H11", "H16"}),
    ],
)
def test_what_is_not_so_is_not_decided(monkeypatch, name, value, lost):
    monkeypatch.setattr(flint_job, "MOST_BALLS", 100)
    monkeypatch.setattr(flint_job, name, value)
    found = flint_job.verdicts()
    assert {claim for claim, verdict in found.items() if verdict == "UNDECIDED"} == lost
    assert all(
        found[claim] == corpus.VERDICTS[claim] for claim in corpus.VERDICTS if claim not in lost
    )


def test_a_grazing_launch_has_no_single_crossing():
    graze = flint_job.Flight(Fraction("1.17"), Fraction("1.2"))
    assert graze.impact() is None
    with pytest.raises(ArithmeticError):
        flint_job.at(Fraction("-1"))  # sticks


def test_two_windows_are_no_single_crossing(monkeypatch):
    flight = flint_job.Flight(*flint_job.LEFT)
    (window,) = flight.windows()
    assert flight.impact() is not None
    monkeypatch.setattr(flint_job.Flight, "windows", lambda self: [window, (56.0, 57.0)])
    assert flight.impact() is None


def test_balls_that_may_meet_a_phase_do_not_miss_it():
    target = flint_job.ball(*flint_job.WHOLE)
    for turns in (0, 4, 100):
        whole = turns * flint_job.TURN
        for phase, missed in (("1.10", True), ("1.12", False), ("1.31", False), ("1.33", True)):
            assert flint_job.misses(whole + flint.arb(phase), target) is missed
    assert not flint_job.misses(flint.arb(4, 2), target)


def test_the_script_is_measured_beside_the_job(tmp_path):
    rows = limit._beside_script("job", [3.0, 4.0], [[1.0, 2.0]])
    assert rows[-1].samples["ratios"] == [3.0, 2.0]
    assert rows[-1].reached is False
    (absent,) = limit._beside_script("job", [3.0], [])
    assert absent.reached is None
    assert "absent" in absent.measured


@pytest.mark.slow
def test_the_limit_has_the_script_in_its_rows(tmp_path):
    job = ["--only", "H16", "--out", str(tmp_path)]
    rows = limit._account("plastic claims", job, tmp_path, EFFORTS["smallest"])
    (row,) = (row for row in rows if "python-flint (pairs)" in row.name)
    assert row.target == "<= 1"
    assert row.samples["ratios"]
