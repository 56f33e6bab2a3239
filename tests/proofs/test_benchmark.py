import json
import re

import pytest

from proofs import benchmark, benchmark_flint
from proofs.benchmark import Row, main, table


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
    if benchmark_flint.available():
        for name, row in rows.items():
            if name.startswith("f' on"):
                assert min(row["samples"]["losses"]) >= 0
            if row["target"].startswith("loss"):
                assert row["reached"]


def test_an_absent_peer_is_reported(monkeypatch):
    monkeypatch.setattr(benchmark_flint, "available", lambda: False)
    effort = benchmark.EFFORTS["smallest"]
    text = table([*benchmark.accuracy(effort), *benchmark.kernel(effort)])
    assert text.count("python-flint is absent") == 2
    assert text.count("not measured") == 2


def test_a_missed_target_shows(monkeypatch, capsys):
    rows = [Row("ratio", "5.00", "<= 4", False), Row("other", "1")]
    monkeypatch.setattr(benchmark, "measure", lambda effort: rows)
    assert main([]) == 1
    assert re.search(r"^ratio +<= 4 +5\.00 +NO$", capsys.readouterr().out, re.M)


@pytest.mark.parametrize("arguments", [["--nonsense"], ["--quick", "--full"]])
def test_bad_usage_exits_2(arguments):
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2


def test_a_missing_directory_is_refused_before_measuring(tmp_path, capsys):
    assert main(["--json", str(tmp_path / "absent" / "x.json")]) == 2
    assert "no such directory" in capsys.readouterr().err


def test_help_has_examples(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--help"])
    assert stopped.value.code == 0
    assert "examples:" in capsys.readouterr().out
