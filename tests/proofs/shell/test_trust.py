"""What a claim rests on: the files that run when it is checked alone, and no others."""

from pathlib import Path

import pytest

from proofs import check, horseshoe
from proofs.shell.trust import trusted_for
from proofs.trusted.kernel.meter import DEFAULT
from tests.proofs.trusted.corpus import path_of

REPORTS = Path(__file__).parents[3] / "reports"


def files(path):
    trust = trusted_for(path.read_text(), DEFAULT)
    return {each.claim: {name for name, _ in each.files} for each in trust}


@pytest.mark.slow
def test_a_claim_rests_on_what_its_steps_call():
    rests = files(REPORTS / "horseshoe.json")
    assert len(rests) == 10
    assert "slopes.py" in rests["H1"] and "slopes.py" not in rests["H16"]
    assert "kernel/rectangles.py" in rests["N1"] and "oscillator.py" in rests["N1"]
    assert not any("s33" in name for name in rests["H1"] | rests["H16"])


@pytest.mark.slow
def test_own_maps_rest_on_the_kernel_alone():
    for rests in files(path_of("lemmas/accepted/ball")).values():
        assert "kernel/flight.py" in rests
        assert not any(x.startswith("paper/s") or x == "equations.py" for x in rests)


def test_lines_are_counted_and_a_list_is_refused(tmp_path, capsys):
    assert check.main([str(path_of("accepted/h11_alone")), "--trust"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("H11: to believe this, ") and said.count("\n") == 1
    assert horseshoe.main(["--only", "H16", "--quiet", "--out", str(tmp_path)]) == 0
    assert check.main([str(tmp_path / "MANIFEST.json"), "--trust"]) == 2
    assert check.main(["nowhere.json", "--trust"]) == 2
