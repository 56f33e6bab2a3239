"""The record of what coqc accepted: what it says of a certificate, and when it says nothing."""

import json
import shutil

import pytest

from proofs.formal import __main__ as formal
from proofs.formal import coqc
from proofs.formal.written import Case, Theorem
from proofs.report import accepted as record
from proofs.report.accepted import RECORD, accepted
from tests.proofs.formal.coq import PAPER, ROOT, needs_coqc

ENTRIES = json.loads(RECORD.read_text())
REPORTS = ROOT / "reports"
CERTIFICATES = {path.name: path.read_text() for path in REPORTS.glob("*.json")}
ONE, TWO, NEW = '{"schema": "one"}', '{"schema": "two"}', '{"schema": "new"}'
SAID = "\n\nAxioms:\nClassical_Prop.classic : forall P : Prop, P \\/ ~ P\n"


def written(path, **entries):
    """A record with entries: a certificate, the theory's digest, and claims."""
    path.write_text(json.dumps(entries))
    return path


def entry(source, claims, theory=None):
    """An entry about a certificate."""
    theory = theory or record.digest_of_theory()
    return {"certificate": record.digest(source), "theory": theory, "claims": claims}


def test_what_is_of_another_certificate_or_theory_says_nothing(tmp_path, monkeypatch):
    path = written(tmp_path / "record", a=entry(ONE, {"H1": ["t", "u"]}), b=entry(TWO, {}))
    assert accepted([ONE, "{}"], path) == {"H1": ("a", ("t", "u"))}
    assert accepted([f"\n{ONE} "], path) == accepted([ONE], path)  # however it is laid out
    assert accepted([ONE.upper()], path) == {} == accepted([], path)
    shutil.copytree(record.THEORY, tmp_path / "theory")
    monkeypatch.setattr(record, "THEORY", tmp_path / "theory")
    assert accepted([ONE], path) != {}
    with (tmp_path / "theory" / "Impact.v").open("a") as impact:
        impact.write(" ")
    assert accepted([ONE], path) == {}


def test_a_new_entry_takes_the_place_of_the_old_one_and_of_all_that_is_stale(tmp_path):
    stale, kept = entry("{}", {}, theory="other"), entry(TWO, {"N1": ["t"]})
    path = written(tmp_path / "record", a=entry(ONE, {"H1": ["t"]}), b=kept, c=stale)
    told = json.loads(record.recorded("a", NEW, {"H2": ["v"]}, path))
    assert told == {"a": entry(NEW, {"H2": ["v"]}), "b": kept}


def made(monkeypatch, tmp_path, axioms=SAID):
    """Run the command, coqc being an oracle that accepts, on a case of two theorems."""
    theorems = [Theorem("one", "1", ["H1"]), Theorem("two", "2", ["H1", "H2"]), Theorem("x", "")]
    text = "".join(f"Theorem {each.name} : True.\nProof. exact I. Qed.\n" for each in theorems)
    monkeypatch.setattr(formal.cases, "case", lambda *of: Case(text, theorems))
    monkeypatch.setattr(coqc, "theory", lambda *of: tmp_path)
    monkeypatch.setattr(coqc, "run", lambda *of: coqc.Accepted(axioms, 1))
    monkeypatch.setattr(formal, "RECORD", written(tmp_path / "record.json"))
    monkeypatch.setattr(record, "RECORD", tmp_path / "record.json")


def test_the_command_enters_what_is_accepted(monkeypatch, tmp_path):
    made(monkeypatch, tmp_path)
    assert formal.main([str(PAPER), "--record", "--out", str(tmp_path / "out")]) == 0
    told = accepted([PAPER.read_text()], tmp_path / "record.json")
    assert told == {"H1": (PAPER.name, ("one", "two")), "H2": (PAPER.name, ("two",))}


def test_nothing_is_entered_that_rests_on_other_axioms(monkeypatch, tmp_path):
    made(monkeypatch, tmp_path, "\n\nAxioms:\neasy : False\n")
    assert formal.main([str(PAPER), "--record", "--out", str(tmp_path / "out")]) == 3
    assert (tmp_path / "record.json").read_text() == "{}"


def test_the_ledger_says_what_the_record_says():
    told = accepted(CERTIFICATES.values())
    for row in json.loads(CERTIFICATES["ledger.json"])["claims"]:
        known = told.get(row["id"])
        assert row["coq"] == ([*known.theorems] if known else []), row["id"]


@pytest.mark.slow
def test_what_is_entered_is_stated_for_that_certificate():
    """Each theorem of the record stands, about its claim, in the case that is written now."""
    for file, known in ENTRIES.items():
        if known["certificate"] != record.digest(CERTIFICATES[file]):
            continue
        case = formal._of_certificate(CERTIFICATES[file])
        stated = [(claim, each.name) for each in case.theorems for claim in each.decides]
        entered = [(claim, name) for claim, names in known["claims"].items() for name in names]
        assert sorted(entered) == sorted(stated), file


@needs_coqc
@pytest.mark.long
@pytest.mark.parametrize("file", sorted(ENTRIES))
def test_the_record_made_anew(tmp_path, monkeypatch, file):
    path = written(tmp_path / "record.json")
    monkeypatch.setattr(formal, "RECORD", path)
    monkeypatch.setattr(record, "RECORD", path)
    command = [str(REPORTS / file), "--record", "--out", str(tmp_path)]
    assert formal.main(command) == 0
    assert json.loads(path.read_text()) == {file: ENTRIES[file]}
