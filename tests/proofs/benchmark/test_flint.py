"""The script in python-flint beside the main job: its verdicts, and what it does not decide."""

import subprocess
import sys
from fractions import Fraction

import pytest

from tests.proofs.trusted import corpus

flint = pytest.importorskip("flint")

from proofs.benchmark import flint_job  # noqa: E402 (it needs flint)
from proofs.benchmark.horseshoe import CLAIMS  # noqa: E402

KNOWN = {claim: corpus.VERDICTS[claim] for claim in CLAIMS}


def test_the_script_decides_all_as_it_is_known_and_needs_nothing_but_flint():
    code = (
        "import runpy, sys; runpy.run_module('proofs.benchmark.flint_job', run_name='__main__')\n"
        "print('loaded', len({'numpy', 'mpmath', 'sympy', 'intervals'}.intersection(sys.modules)))"
    )
    command = [sys.executable, "-c", code]
    found = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    known = dict(line.split() for line in found.splitlines())
    assert known.pop("loaded") == "0" and known == KNOWN


def test_the_functions_agree_with_the_known_map():
    # the values that the main job reports, by other arithmetic
    _, slope = flint_job.at(Fraction("1.13"))
    assert slope.overlaps(flint.arb("5.2963535", "5e-7"))
    for phase, value in (("1.11", "4.7269475378464088834"), ("1.27", "4.3078032000324800005")):
        _, slope = flint_job.at(Fraction(phase))
        assert slope.overlaps(flint.arb(value, "1e-18")) and slope.rad() < 1e-9
    image, _ = flint_job.at(Fraction("1.11"))
    assert (image - 4 * flint_job.TURN).overlaps(flint.arb("1.1291579924088902410", "1e-18"))


@pytest.mark.parametrize(
    ("name", "value", "lost"),
    [
        ("SLOPES", (Fraction("4.31"), Fraction("5.25")), {"H1", "H3", "H5", "H6"}),
        ("SLOPES", (Fraction("4.2"), Fraction("6.19")), {"H2"}),
        ("GAP", (Fraction("1.14"), Fraction("1.27")), {"H4"}),
        ("LEFT", (Fraction("1.1"), Fraction("1.15")), {"H2", "H5"}),
    ],
)
def test_what_is_not_so_is_not_decided(monkeypatch, name, value, lost):
    monkeypatch.setattr(flint_job, "MOST_BALLS", 100)
    monkeypatch.setattr(flint_job, name, value)
    found = flint_job.verdicts()
    assert {claim for claim, verdict in found.items() if verdict == "UNDECIDED"} == lost
    assert all(found[claim] == KNOWN[claim] for claim in KNOWN.keys() - lost)
