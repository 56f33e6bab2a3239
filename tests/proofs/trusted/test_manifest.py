"""MANIFEST.json: what the main job writes, and what the checker makes of a changed one."""

import json
from pathlib import Path

import pytest

from proofs.check import main as check
from proofs.commands.ledger import CLAIMS
from proofs.horseshoe import main
from proofs.shell.files import writing
from proofs.shell.groups import MANIFEST_NAME, entered
from proofs.trusted.certificate import MANIFEST, Malformed
from proofs.trusted.files import digest
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.manifest import check_ledger, check_manifest
from proofs.trusted.verify import Rejected
from tests.once import report
from tests.oracles.sources import certificates
from tests.proofs.trusted import corpus

ROOT = Path(__file__).parents[3]
SETS = ["--left", "1.11", "1.15", "--right", "1.27", "1.32"]


@pytest.fixture
def folder(tmp_path):
    content = corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8")
    enter(tmp_path, "horseshoe.json", content)
    return tmp_path


def enter(folder, name, content):
    with writing(folder) as put:
        put(name, content)
        put(MANIFEST_NAME, entered(folder, {name: content}))


def files(folder):
    return json.loads((folder / MANIFEST_NAME).read_text(encoding="utf-8"))["files"]


def edited(folder, edit):
    path = folder / MANIFEST_NAME
    document = json.loads(path.read_text(encoding="utf-8"))
    edit(document)
    path.write_text(json.dumps(document), encoding="utf-8")
    return path


def test_the_main_job_writes_it_and_the_checker_confirms_it(tmp_path, capsys):
    assert main(["--only", "H1", "H16", "--out", str(tmp_path)]) == 0
    path = tmp_path / MANIFEST_NAME
    document = json.loads(path.read_text(encoding="utf-8"))
    assert document["schema"] == MANIFEST
    entry = document["files"]["horseshoe.json"]
    assert set(entry["claims"]) == {"H1", "H16"}
    assert entry["made"] == "python -m proofs horseshoe --only H1 H16"
    assert entry["digest"] == digest((tmp_path / "horseshoe.json").read_text(encoding="utf-8"))
    checked = entry["checked"].split()
    assert checked[:4] == ["python", "-I", "-m", "proofs.check"]
    assert check([str(tmp_path / name) for name in checked[4:]]) == 0
    capsys.readouterr()
    assert check([str(path)]) == 0
    assert "2 claims at the paper's parameters: 2 VERIFIED" in capsys.readouterr().out


def test_the_command_names_the_parameters(tmp_path, capsys):
    words = ["--eta", "0.25", "--nu", "-0.3", *SETS, "--only", "H16", "--out", str(tmp_path)]
    assert main(words) == 0
    path = tmp_path / MANIFEST_NAME
    made = files(tmp_path)["horseshoe.json"]["made"]
    named = " ".join(SETS)  # without them others would be found
    assert made == f"python -m proofs horseshoe --eta 0.25 --nu -0.3 {named} --only H16"
    capsys.readouterr()
    assert check([str(path)]) == 0
    assert "1 claims, 1 of them at other parameters" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("name", ["MANIFEST.json", "ledger.json"])
def test_what_is_committed_is_about_the_committed_files(name, monkeypatch):
    texts = {(ROOT / "reports" / f"{x}.json").read_text(): x for x in certificates()}
    monkeypatch.setattr("proofs.trusted.manifest.check", lambda text, _: report(texts[text]))
    source = (ROOT / "reports" / name).read_text(encoding="utf-8")
    examine = check_manifest if name == MANIFEST_NAME else check_ledger
    listed = examine(source, ROOT / "reports", DEFAULT)
    assert {each.id for each in listed} == set(CLAIMS) and all(each.is_paper for each in listed)


@pytest.mark.slow
@pytest.mark.parametrize("field", ["statement", "verdict", "why", "witness", "corrected", "file"])
def test_no_text_of_a_ledger_is_believed(tmp_path, field):
    for path in (ROOT / "reports").glob("*.json"):
        (tmp_path / path.name).write_text(path.read_text())
    document = json.loads((ROOT / "reports/ledger.json").read_text())
    entry = next(each for each in document["claims"] if each["id"] == "H5")
    document["claims"] = [entry]
    assert check_ledger(json.dumps(document), tmp_path, DEFAULT)
    entry[field] = {"verdict": "VERIFIED", "file": "sets.json"}.get(field, f"{entry[field]} ")
    with pytest.raises((Rejected, Malformed)):
        check_ledger(json.dumps(document), tmp_path, DEFAULT)
    with pytest.raises(Malformed, match="no claims"):
        check_ledger(json.dumps({**document, "claims": []}), tmp_path, DEFAULT)


def test_entries_about_other_files_stay(folder):
    content = corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8")
    other = corpus.path_of("accepted/h16_alone").read_text(encoding="utf-8")
    enter(folder, "other.json", other)
    enter(folder, "horseshoe.json", content)
    assert {name: len(entry["claims"]) for name, entry in files(folder).items()} == {
        "horseshoe.json": 8,
        "other.json": 1,
    }


def test_a_manifest_is_the_same_bytes_in_whatever_order_and_how_often_files_come(tmp_path):
    reports = [(ROOT / f"reports/{name}.json").read_text() for name in ("horseshoe", "soft")]
    named = list(zip(("horseshoe.json", "soft.json"), reports, strict=True))
    texts = set()
    for folder, order in (("a", named), ("b", named[::-1]), ("c", [*named, *named])):
        for name, content in order:
            enter(tmp_path / folder, name, content)
        texts.add((tmp_path / folder / MANIFEST_NAME).read_bytes())
    assert len(texts) == 1


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"schema": 1, "files": {}}', f'{{"schema": "{MANIFEST}", "files": 1}}'],
)
def test_a_manifest_that_cannot_be_read_is_replaced(folder, text):
    path = folder / MANIFEST_NAME
    path.write_text(text, encoding="utf-8")
    content = (folder / "horseshoe.json").read_text(encoding="utf-8")
    enter(folder, "horseshoe.json", content)
    assert len(files(folder)["horseshoe.json"]["claims"]) == 8


FILE = "horseshoe.json"


def of(document):
    return document["files"][FILE]["claims"]


WRONG = {
    "digest": (lambda d: d["files"][FILE].update(digest="sha256:" + "0" * 64), "proves 'sha256"),
    "parameters": (lambda d: d["files"][FILE]["parameters"].update(eta="1/5"), "file proves"),
    "made": (lambda d: d["files"][FILE].update(made="python -m proofs sets"), "the command is"),
    "checked": (lambda d: d["files"][FILE].update(checked="true"), "proves 'python -I -m"),
    "verdict": (lambda d: of(d)["H2"].update(verdict="VERIFIED"), "file proves"),
    "statement": (lambda d: of(d)["H2"].update(statement="f' <= 7."), "file proves"),
    "claim": (lambda d: of(d).update(G1=of(d)["H1"]), "file proves"),
    "claim left out": (lambda d: of(d).pop("H1"), "file proves"),
    "claims of another form": (lambda d: d["files"][FILE].update(claims=["H1"]), "file proves"),
    "no files": (lambda d: d.update(files={}), "no claims"),
    "missing file": (lambda d: d["files"].update({"soft.json": d["files"][FILE]}), "be read"),
    "file outside": (lambda d: d["files"].update({"../x.json": d["files"][FILE]}), "same folder"),
    "NUL": (lambda d: d["files"].update({"x\0.json": d["files"][FILE]}), "same folder"),
    "field": (lambda d: d["files"][FILE].pop("digest"), "missing field"),
    "extra": (lambda d: d["files"][FILE].update(extra=""), "unknown field"),
    "extra of a claim": (lambda d: of(d)["H2"].update(extra=""), "file proves"),
}


@pytest.mark.parametrize("name", ["copy", "sets", "explore"])  # sets: of other claims
def test_a_copy_under_another_name_is_no_file_that_a_command_makes(folder, name):
    text = (folder / FILE).read_text(encoding="utf-8")
    (folder / f"{name}.json").write_text(text, encoding="utf-8")

    def copied(document):
        entry = json.dumps(document["files"][FILE])
        entry = entry.replace("proofs horseshoe", f"proofs {name}").replace(FILE, f"{name}.json")
        document["files"][f"{name}.json"] = json.loads(entry)

    path = edited(folder, copied)
    with pytest.raises(Rejected, match="no command makes"):
        check_manifest(path.read_text(encoding="utf-8"), folder, DEFAULT)


@pytest.mark.parametrize("name", WRONG)
def test_a_changed_manifest_is_refused(folder, name, capsys):
    edit, message = WRONG[name]
    path = edited(folder, edit)
    with pytest.raises((Rejected, Malformed), match=message):
        check_manifest(path.read_text(encoding="utf-8"), folder, DEFAULT)
    assert check([str(path)]) in (1, 2)
    assert capsys.readouterr().err.count("\n") == 1


def test_a_changed_certificate_is_noticed(folder):
    path = folder / "horseshoe.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    document["claims"] = document["claims"][::-1]
    path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(Rejected, match="proves 'sha256"):
        check_manifest((folder / MANIFEST_NAME).read_text(encoding="utf-8"), folder, DEFAULT)


def test_the_digest_is_of_the_canonical_form():
    assert digest('{"a": ["x"], "b": "1"}') == digest('{ "a":["x"],\n"b":"1"}')
    assert digest('{"a": ["x", "y"]}') != digest('{"a": ["y", "x"]}')
    assert digest('{"a": "x", "b": "y"}') != digest('{"b": "y", "a": "x"}')
