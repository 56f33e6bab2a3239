"""Where results go, and that none is lost: by another run, by an interrupt, by a second writer."""

import json
import os
import signal
import subprocess
import sys
from time import monotonic, sleep

import pytest

from proofs import horseshoe
from proofs.commands import ledger
from proofs.shell import files
from proofs.shell.files import writing
from proofs.trusted.manifest import check_manifest
from tests.proofs.shell.processes import ROOT, children, started, wait_until_it_listens

OTHERS = [
    ["--only", "H1", "H2"],
    ["--eta", "0.212", "--only", "H16"],
    ["--digits", "12", "--only", "H16"],
    ["--horizon", "500", "--only", "H16"],
]


def contents(folder):
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.fixture
def clone(tmp_path, monkeypatch):
    """A folder with the committed certificate of the main job, in which commands are run."""
    (tmp_path / "reports").mkdir()
    committed = (ROOT / "reports" / "horseshoe.json").read_bytes()
    (tmp_path / "reports" / "horseshoe.json").write_bytes(committed)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("arguments", OTHERS, ids=" ".join)
def test_another_run_leaves_the_papers_results_alone(arguments, clone, capsys):
    before = contents(clone / "reports")
    assert horseshoe.main(arguments) in (0, 1)
    assert horseshoe.main(arguments) in (0, 1)  # what is in runs may be replaced
    assert contents(clone / "reports") == before
    assert {"horseshoe.json", "MANIFEST.json"} <= set(contents(clone / "runs"))
    assert "runs/horseshoe.md" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [OTHERS[0], OTHERS[1]], ids=" ".join)
def test_not_even_if_it_is_told_to_write_there(arguments, clone, capsys):
    before = contents(clone / "reports")
    with pytest.raises(SystemExit) as leave:
        horseshoe.main([*arguments, "--out", "reports"])
    said = capsys.readouterr()
    assert leave.value.code == 2 and said.out == "" and said.err.count("\n") == 1
    assert "choose another --out" in said.err and contents(clone / "reports") == before


@pytest.mark.slow
def test_the_papers_own_run_gives_the_bytes_that_are_committed(clone):
    assert horseshoe.main(["--quiet"]) == 0
    assert (clone / "reports" / "horseshoe.md").is_file()
    made, committed = (each / "reports" / "horseshoe.json" for each in (clone, ROOT))
    assert made.read_bytes() == committed.read_bytes()
    ours, theirs = (
        json.loads((folder / "reports/MANIFEST.json").read_text())["files"]["horseshoe.json"]
        for folder in (clone, ROOT)
    )
    assert ours == theirs and not (clone / "runs").exists()


@pytest.mark.slow
def test_the_ledger_of_some_claims_takes_what_is_there_and_leaves_it(clone, capsys):
    before = contents(clone / "reports")
    assert ledger.main(["--only", "H1", "H16"]) == 0
    assert "in reports, checked again" in capsys.readouterr().out
    assert contents(clone / "reports") == before
    runs = contents(clone / "runs")
    assert runs["horseshoe.json"] == before["horseshoe.json"]
    assert [x["id"] for x in json.loads(runs["ledger.json"])["claims"]] == ["H1", "H16"]


# -- two writers -----------------------------------------------------------------------------------

WRITER = """
import json, sys
from pathlib import Path
from proofs.shell.files import writing
folder, name = Path(sys.argv[1]), sys.argv[2]
for k in range(40):
    with writing(folder) as put:
        there = folder / "list.json"
        entries = json.loads(there.read_text()) if there.exists() else []
        put("list.json", json.dumps([*entries, f"{name}{k}"]))
        put(f"{name}.txt", str(k))
"""


@pytest.mark.slow
def test_two_runs_into_one_folder_lose_no_entry(tmp_path):
    asked = {"horseshoe": "H16", "sets": "H12", "soft": "S2", "single": "P1"}
    runs = [
        started(name, ["--only", claim, "--no-check", "--out", str(tmp_path)])
        for name, claim in asked.items()
    ]
    for run in runs:
        assert run.communicate(timeout=60)[1] == b"" and run.returncode == 0
    text = (tmp_path / "MANIFEST.json").read_text()
    assert {each.id for each in check_manifest(text, tmp_path, 1e9)} == {*asked.values()}


def test_a_writer_waits_for_another(tmp_path):
    code = WRITER.replace("range(40)", "range(1)")
    with writing(tmp_path) as put:
        waiting = subprocess.Popen([sys.executable, "-c", code, str(tmp_path), "x"], cwd=ROOT)
        sleep(0.5)
        assert waiting.poll() is None and not (tmp_path / "x.txt").exists()
        put("list.json", '["mine"]')
    assert waiting.wait(30) == 0
    assert json.loads((tmp_path / "list.json").read_text()) == ["mine", "x0"]


# -- whole files -----------------------------------------------------------------------------------


def test_all_or_none(tmp_path, monkeypatch):
    (tmp_path / "a").write_text("old")
    count = iter(range(9))

    def full(file):
        if next(count) == 1:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match="No space"), writing(tmp_path) as put:
        put("a", "new")
        put("b", "new")
    with pytest.raises(KeyboardInterrupt), writing(tmp_path) as put:
        put("a", "new")
        raise KeyboardInterrupt
    with pytest.raises(OSError, match="not a regular"), writing(tmp_path) as put:
        put("a", "new")
        (tmp_path / "folder").mkdir()
        put("folder", "new")
    assert contents(tmp_path / "folder") == {}
    (tmp_path / "folder").rmdir()
    assert contents(tmp_path) == {"a": b"old"}


def test_what_a_killed_run_left_is_cleared_by_the_next_and_nothing_else(tmp_path):
    mine = [".hidden", ".notes.part", "x.12.part", ".horseshoe.json"]
    for name in (*mine, ".horseshoe.json.12345.part"):
        (tmp_path / name).write_text("")
    assert horseshoe.main(["--only", "H16", "--quiet", "--out", str(tmp_path)]) == 0
    left = {"horseshoe.json", "horseshoe.md", "MANIFEST.json"}
    assert set(contents(tmp_path)) == {*mine, *left}


def test_a_folder_that_cannot_be_locked_is_written_to(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(37, "No locks available")

    monkeypatch.setattr("fcntl.flock", refuse)
    with writing(tmp_path) as put:
        put("a", "new")
    assert contents(tmp_path) == {"a": b"new"} and files.__doc__


@pytest.mark.slow
def test_fresh_keeps_what_is_finished_when_interrupted(tmp_path):
    """H16 is done in a moment, G4 takes seconds."""
    ask = ["--fresh", "--only", "H16", "G4", "--out", str(tmp_path)]
    with started("ledger", ask) as process:
        wait_until_it_listens(process)
        began = monotonic()
        while not (tmp_path / "horseshoe.json").exists() and monotonic() - began < 30:
            sleep(0.02)
        sleep(0.1)
        os.killpg(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=10)
        assert not children(process)
    assert process.returncode == 130 and err == b"python -m proofs: interrupted\n"
    assert not (tmp_path / "circle.json").exists() and not list(tmp_path.glob(".*"))
    text = (tmp_path / "MANIFEST.json").read_text()
    assert [each.id for each in check_manifest(text, tmp_path, 1e9)] == ["H16"]
