import json
import re

import pytest

from proofs.benchmark import __main__ as command
from proofs.benchmark import horseshoe
from proofs.benchmark.__main__ import main
from proofs.benchmark.measuring import EFFORTS, Row, figures, in_turn, table


@pytest.mark.slow
def test_the_smallest_run_prints_its_table_and_writes_its_samples(tmp_path, capsys):
    target = tmp_path / "samples.json"
    status = main(["--smallest", "--json", str(target)])
    text = capsys.readouterr().out
    assert status in (0, 1)  # speed is never asserted
    assert re.search(r"^what +target +measured +reached$", text, re.M)
    for name in ("ratio of medians", "peak memory", "mean value, 4096", "100 digits", "kernel"):
        assert name in text
    assert "NOT AN ENCLOSURE" not in text
    rows = {row["name"]: row for row in json.loads(target.read_text())["rows"]}
    assert rows["main job, peak memory [MB]"]["samples"]["megabytes"]
    if horseshoe.has_flint():
        for name, row in rows.items():
            if name.startswith("f' on"):
                assert min(row["samples"]["losses"]) >= 0
            if row["target"].startswith("loss"):
                assert row["reached"]


def test_an_absent_peer_is_reported(monkeypatch):
    monkeypatch.setattr(horseshoe, "has_flint", lambda: False)
    effort = EFFORTS["smallest"]
    text = table([*horseshoe.accuracy(effort), *horseshoe.kernel(effort)])
    assert text.count("python-flint is absent") == 2
    assert text.count("not measured") == 2


@pytest.mark.parametrize("subject", [[], ["horseshoe"], ["intervals"]])
def test_a_missed_target_shows(monkeypatch, capsys, subject):
    rows = [Row("ratio", "5.00", "<= 4", False), Row("other", "1")]
    monkeypatch.setattr(command, "measure", lambda options: rows)
    assert main(subject) == 1
    assert re.search(r"^ratio +<= 4 +5\.00 +NO$", capsys.readouterr().out, re.M)


def test_samples_are_taken_in_turn():
    calls = []
    samplers = [lambda name=name: calls.append(name) or float(len(calls)) for name in "ab"]
    assert in_turn(samplers, 3) == [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]
    assert "".join(calls) == "ababab"


def test_numbers_are_written_without_exponents():
    found = [figures(x) for x in (0.0123456, 1.0, 999.4, 999.5, 12345.6)]
    assert found == ["0.0123", "1", "999", "1,000", "12,346"]


@pytest.mark.parametrize("arguments", [["--nonsense"], ["--quick", "--full"], ["circles"]])
def test_bad_usage_exits_2(arguments):
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2


def test_a_missing_directory_is_refused_before_measuring(tmp_path, capsys):
    assert main(["--json", str(tmp_path / "absent" / "x.json")]) == 2
    assert "no such directory" in capsys.readouterr().err


def test_a_missing_interpreter_is_refused_before_measuring(tmp_path, capsys):
    assert main(["intervals", "--codac-python", str(tmp_path / "python")]) == 2
    assert "no such interpreter" in capsys.readouterr().err


def test_help_has_examples(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--help"])
    assert stopped.value.code == 0
    assert "examples:" in capsys.readouterr().out
