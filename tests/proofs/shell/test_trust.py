"""What a claim rests on: the files that run when it is checked alone, and no others."""

from pathlib import Path

import pytest

from proofs import check
from proofs.shell.trust import trusted_for
from proofs.trusted.kernel.meter import DEFAULT

REPORTS = Path(__file__).parents[3] / "reports"
LEMMAS = Path(__file__).parents[2] / "certificates" / "lemmas" / "accepted"


def files(path):
    trust = trusted_for(path.read_text(), DEFAULT)
    return {each.claim: {name for name, _ in each.files} for each in trust}


def test_a_claim_rests_on_what_its_steps_call():
    rests = files(REPORTS / "horseshoe.json")
    assert "slopes.py" in rests["H1"] and "slopes.py" not in rests["H16"]
    assert "kernel/rectangles.py" in rests["N1"] and "oscillator.py" in rests["N1"]
    assert not any("s33" in name for name in rests["H1"] | rests["H16"])


def test_own_maps_rest_on_the_kernel_alone():
    for rests in files(LEMMAS / "ball.json").values():
        assert "kernel/flight.py" in rests
        assert not any(x.startswith("paper/s") or x == "equations.py" for x in rests)


@pytest.mark.slow
def test_lines_are_counted_and_a_list_is_refused(capsys):
    assert check.main([str(REPORTS / "horseshoe.json"), "--trust"]) == 0
    said = capsys.readouterr().out
    assert said.count("to believe this") == said.count("\n") == 10
    assert check.main([str(REPORTS / "MANIFEST.json"), "--trust"]) == 2
    assert check.main(["nowhere.json", "--trust"]) == 2
