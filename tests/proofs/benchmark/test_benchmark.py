import json
import platform
import re
import sys
from pathlib import Path

import pytest

from proofs.benchmark import __main__ as command
from proofs.benchmark import horseshoe, page
from proofs.benchmark.__main__ import main
from proofs.benchmark.curves import Curve, Point
from proofs.benchmark.diagrams import Diagram
from proofs.benchmark.measuring import EFFORTS, Row, figures, in_turn, table
from proofs.benchmark.page import Section


@pytest.mark.slow
def test_the_smallest_run_prints_its_table_and_writes_its_samples(tmp_path, capsys):
    target = tmp_path / "samples.json"
    status = main(["horseshoe", "--smallest", "--json", str(target)])
    text = capsys.readouterr().out
    assert status in (0, 1)  # speed is never asserted
    assert re.search(r"^what +target +measured +reached$", text, re.M)
    for name in (
        "import numpy, mpmath (pairs)",
        "peak memory",
        "mean value, 4096",
        "100 digits",
        "kernel",
    ):
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


MISSED, REACHED = Row("ratio", "5.00", "<= 4", False), Row("loss|", "1e-30", "< 1e-20", True)


def measured(monkeypatch, *sections):
    """Have a run measure these sections, at once."""
    monkeypatch.setattr(command, "measure", lambda options: list(sections))


@pytest.mark.parametrize("subject", [[], ["horseshoe"], ["intervals"]])
def test_a_missed_target_shows(monkeypatch, capsys, subject):
    measured(monkeypatch, Section("A title", "About.", [MISSED, Row("other", "1")]))
    assert main(subject) == 1
    text = capsys.readouterr().out
    assert re.search(r"^ratio +<= 4 +5\.00 +NO$", text, re.M)
    assert "1 targets: 0 reached, 1 missed, 0 not measured" in text


@pytest.mark.parametrize(
    ("row", "status"),
    [
        (REACHED, 0),
        (Row("no target", "1"), 0),
        (Row("ratio", "absent", ">= 10"), 1),
        (Row("not an enclosure", "1", "", False), 1),
    ],
)
def test_the_status_is_0_if_all_that_is_asked_is_reached(monkeypatch, row, status):
    measured(monkeypatch, Section("A title", "About.", [REACHED, row]))
    assert main([]) == status


def test_the_default_is_all_that_has_a_diagram_or_a_limit(monkeypatch, capsys):
    for name in command.SUBJECTS:
        section = Section(f"That is {name}", "About.", [Row("what", "1")])
        monkeypatch.setitem(command.SUBJECTS, name, lambda *_, one=section: iter([one]))
    assert main([]) == 0
    found = re.findall(r"^== That is (\w+) ==$", capsys.readouterr().out, re.M)
    assert found == ["horseshoe", "limit", "precision"]
    assert main(["claims"]) == 0
    assert capsys.readouterr().out.startswith("what ")  # one section has no heading


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


def test_a_file_that_cannot_be_written_is_refused_before_measuring(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "measure", lambda options: pytest.fail("measured"))
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit) as stopped:
        main(["--json", str(tmp_path / "file" / "x.json")])
    assert stopped.value.code == 2 and "cannot write" in capsys.readouterr().err


def test_the_samples_go_to_a_file_or_to_the_screen_alone(tmp_path, monkeypatch, capsys):
    measured(monkeypatch, Section("A title", "About.", [MISSED]))
    target = tmp_path / "new" / "samples.json"
    assert main(["--json", str(target)]) == 1
    assert "what " in capsys.readouterr().out
    assert main(["--json", "-"]) == 1
    for written in (target.read_text(), capsys.readouterr().out):
        assert [row["name"] for row in json.loads(written)["rows"]] == ["ratio"]


def test_a_missing_interpreter_is_refused_before_measuring(tmp_path, capsys):
    assert main(["intervals", "--codac-python", str(tmp_path / "python")]) == 2
    assert "no such interpreter" in capsys.readouterr().err


def test_help_has_examples(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--help"])
    assert stopped.value.code == 0
    assert "examples:" in capsys.readouterr().out


# -- the report ------------------------------------------------------------------------------------


def diagram():
    curve = Curve("work", "way", "boxes", [Point(2.0, 1e-3, [1.0])])
    return Diagram("curves", "Work", [curve])


def sections():
    rows = [
        MISSED,
        REACHED,
        Row("rate", "absent", ">= 10"),
        Row("  other", "1   -", samples={"s": 2}),
    ]
    return Section("First", "About the first.", rows, [diagram()]), Section("Second", "-", [])


def test_the_page_says_what_was_measured_and_shows_it(monkeypatch, tmp_path):
    pytest.importorskip("matplotlib")
    measured(monkeypatch, *sections())
    out = tmp_path / "new" / "out"
    assert main(["--out", str(out)]) == 1
    names = {"benchmark.md", "benchmark.json", "benchmark-curves.svg"}
    assert {path.name for path in out.iterdir()} == names
    text = (out / "benchmark.md").read_text()
    assert "3 targets: 1 reached, 1 missed, 1 not measured" in text
    assert "| First | 3 | 1 | 1 | 1 |\n\nMissed:" in text
    assert "Missed:\n\n- First: ratio: 5.00; wanted: <= 4\n\nNot measured:\n" in text
    assert "Not measured:\n\n- First: rate: absent; wanted: >= 10\n\n## First" in text
    assert "| loss\\| | < 1e-20 | 1e-30 | yes |\n" in text
    assert "## First\n\nAbout the first.\n\n| what |" in text and "## Second" in text
    assert "| ratio | <= 4 | 5.00 | NO |\n" in text and "| other | - | 1 · - | - |\n" in text
    assert "![Work](benchmark-curves.svg)" in text
    assert f"python {platform.python_version()}" in text
    for word in filter(None, (platform.node(), str(tmp_path), str(Path.home()), sys.prefix)):
        assert word not in text
    data = json.loads((out / "benchmark.json").read_text())
    assert data["subject"] == "all" and data["rows"][3]["samples"] == {"s": 2}
    assert [row["section"] for row in data["rows"]] == ["First"] * 4
    assert {"python", "numpy", "mpmath", "scipy", "processors"} <= set(data)


def test_without_matplotlib_the_page_has_no_pictures(monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    measured(monkeypatch, *sections())
    main(["--out", str(tmp_path)])
    assert "no pictures" in capsys.readouterr().err
    assert "![" not in (tmp_path / "benchmark.md").read_text()
    assert not list(tmp_path.glob("*.svg"))
    measured(monkeypatch, sections()[1])  # which has none
    main(["--out", str(tmp_path)])
    assert not capsys.readouterr().err


def test_a_report_is_never_half_new(monkeypatch, tmp_path, capsys):
    before = {"benchmark.md": "the page before", "benchmark.json": "the samples before"}
    for name, content in before.items():
        (tmp_path / name).write_text(content)

    def fails(*_):
        raise RuntimeError("it cannot be drawn")

    measured(monkeypatch, *sections())
    monkeypatch.setattr(page, "svg", fails)
    with pytest.raises(RuntimeError):
        main(["--out", str(tmp_path)])
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == before

    def full(path, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(page, "svg", lambda one: "<svg/>")
    monkeypatch.setattr(page, "write_atomically", full)
    with pytest.raises(SystemExit) as stopped:
        main(["--out", str(tmp_path)])
    assert stopped.value.code == 2 and "No space left" in capsys.readouterr().err
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == before


def test_the_page_is_written_after_what_it_links_to(monkeypatch, tmp_path):
    written = []
    monkeypatch.setattr(page, "svg", lambda one: "<svg/>")
    monkeypatch.setattr(page, "write_atomically", lambda path, content: written.append(path.name))
    page.write(tmp_path, page.Run("all", "quick", sections(), 1.0))
    assert written == ["benchmark-curves.svg", "benchmark.json", "benchmark.md"]


def test_a_folder_that_cannot_be_written_is_refused_before_measuring(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "measure", lambda options: pytest.fail("measured"))
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit) as stopped:
        main(["--out", str(tmp_path / "file")])
    assert stopped.value.code == 2 and "cannot write" in capsys.readouterr().err
