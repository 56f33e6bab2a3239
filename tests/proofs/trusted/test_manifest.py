"""MANIFEST.json: what the main job writes, and what the checker makes of a changed one."""

import json
from pathlib import Path

import pytest

from proofs.check import main as check
from proofs.horseshoe import main
from proofs.shell import manifest
from proofs.shell.ledger import CLAIMS, FILES
from proofs.trusted.certificate import MANIFEST, Malformed, digest
from proofs.trusted.manifest import check_manifest
from proofs.trusted.verify import Rejected
from tests.proofs.trusted import corpus

ROOT = Path(__file__).parents[3]


@pytest.fixture
def folder(tmp_path):
    content = corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8")
    (tmp_path / "horseshoe.json").write_text(content, encoding="utf-8")
    manifest.record(tmp_path, "horseshoe.json", content, "python -m proofs.horseshoe")
    return tmp_path


def edited(folder, edit):
    path = folder / manifest.NAME
    document = json.loads(path.read_text(encoding="utf-8"))
    edit(document)
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def test_the_main_job_writes_it_and_the_checker_confirms_it(tmp_path, capsys):
    assert main(["--only", "H1", "H16", "--out", str(tmp_path)]) == 0
    path = tmp_path / manifest.NAME
    document = json.loads(path.read_text(encoding="utf-8"))
    assert document["schema"] == MANIFEST
    assert set(document["claims"]) == {"H1", "H16"}
    entry = document["claims"]["H1"]
    assert entry["made"].startswith("python -m proofs.horseshoe --only H1 H16")
    assert entry["digest"] == digest((tmp_path / "horseshoe.json").read_text(encoding="utf-8"))
    provenance = document["files"]["horseshoe.json"]
    assert {"impact-proofs", "commit", "python", "mpmath", "platform", "date"} <= set(provenance)
    capsys.readouterr()
    assert check([str(path)]) == 0
    assert "2 claims in 1 files, all as listed" in capsys.readouterr().out


@pytest.mark.slow
def test_the_committed_manifest_is_about_the_committed_files():
    source = (ROOT / "reports" / manifest.NAME).read_text(encoding="utf-8")
    assert f"{len(CLAIMS)} claims in {len(FILES)} files" in check_manifest(source, ROOT / "reports")
    for entry in json.loads(source)["claims"].values():
        assert entry["checked"] == "python -S -O -m proofs.check reports/" + entry["file"]


def test_entries_about_other_files_stay(folder):
    content = corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8")
    edited(folder, lambda d: d["claims"].update(X1={**d["claims"]["H1"], "file": "other.json"}))
    manifest.record(folder, "horseshoe.json", content, "again")
    claims = json.loads((folder / manifest.NAME).read_text(encoding="utf-8"))["claims"]
    assert claims["X1"]["file"] == "other.json"
    assert claims["H1"]["made"] == "again"


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"claims": 1, "files": {}}', '{"claims": {"H1": 1}}']
)
def test_a_manifest_that_cannot_be_read_is_replaced(folder, text):
    path = folder / manifest.NAME
    path.write_text(text, encoding="utf-8")
    content = (folder / "horseshoe.json").read_text(encoding="utf-8")
    manifest.record(folder, "horseshoe.json", content, "again")
    assert len(json.loads(path.read_text(encoding="utf-8"))["claims"]) == 8


WRONG = {
    "digest": (lambda d: d["claims"]["H2"].update(digest="sha256:" + "0" * 64), "has the digest"),
    "verdict": (lambda d: d["claims"]["H2"].update(verdict="VERIFIED"), "does not prove this"),
    "statement": (lambda d: d["claims"]["H2"].update(statement="f' <= 7."), "another statement"),
    "claim": (lambda d: d["claims"].update(G1=d["claims"]["H1"]), "does not prove this"),
    "missing file": (lambda d: d["files"].update({"none.json": {}}), "cannot be read"),
    "file outside": (lambda d: d["files"].update({"../x.json": {}}), "same folder"),
    "unlisted file": (lambda d: d["claims"]["H2"].update(file="x.json"), "names no file"),
    "field": (lambda d: d["claims"]["H2"].pop("made"), "missing field"),
    "extra": (lambda d: d["claims"]["H2"].update(extra=""), "unknown field"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_changed_manifest_is_refused(folder, name, capsys):
    edit, message = WRONG[name]
    path = edited(folder, edit)
    with pytest.raises((Rejected, Malformed), match=message):
        check_manifest(path.read_text(encoding="utf-8"), folder)
    assert check([str(path)]) in (1, 2)
    assert capsys.readouterr().err.count("\n") == 1


def test_a_changed_certificate_is_noticed(folder):
    path = folder / "horseshoe.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    document["claims"] = document["claims"][::-1]
    path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(Rejected, match="has the digest"):
        check_manifest((folder / manifest.NAME).read_text(encoding="utf-8"), folder)


def test_the_digest_is_of_the_canonical_form():
    assert digest('{"b": "1", "a": ["x"]}') == digest('{ "a":["x"],\n"b":"1"}')
    assert digest('{"a": ["x", "y"]}') != digest('{"a": ["y", "x"]}')
