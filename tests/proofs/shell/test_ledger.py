"""python -m proofs: what is asked for is proved once, what is there is checked."""

import inspect
import json
import shutil

import pytest

from proofs.commands import ledger as shell
from proofs.commands.ledger import jobs, main, settle
from proofs.report import build as report
from proofs.report import current
from proofs.shell import files
from proofs.trusted import equations
from proofs.trusted.verify import Rejected, check

FLAT = ["H1", "H2", "H11"]


def run(folder, *more):
    return main(["--only", *FLAT, "--out", str(folder), *more])


@pytest.mark.slow
def test_proves_writes_and_reuses(tmp_path, capsys):
    assert run(tmp_path) == 0
    ledger = json.loads((tmp_path / "ledger.json").read_text())
    assert [row["verdict"] for row in ledger["claims"]] == ["VERIFIED", "REFUTED", "CONDITIONAL"]
    assert all(row["file"] == "horseshoe.json" for row in ledger["claims"])
    assert [each.id for each in check((tmp_path / "horseshoe.json").read_text()).claims] == FLAT
    before = (tmp_path / "horseshoe.json").stat().st_mtime_ns
    assert "proved and checked" in capsys.readouterr().out
    current.place(tmp_path).unlink()
    assert run(tmp_path) == 0
    assert "checked again" in capsys.readouterr().out
    assert (tmp_path / "horseshoe.json").stat().st_mtime_ns == before
    assert run(tmp_path, "--fresh") == 0
    assert "proved and checked" in capsys.readouterr().out


@pytest.mark.slow
def test_nothing_is_checked_again_where_nothing_has_changed(tmp_path, monkeypatch, capsys):
    """Neither certificates nor pages nor the program: else all is, and a forgery is found."""

    def ran(*more):
        only = [] if "--only" in more else ["--only", "H16"]
        assert main([*only, "--out", str(tmp_path), *more]) == 0
        return capsys.readouterr().out

    def drawn(folder, *arguments, **known):
        return {"ledger.md": (folder / "ledger.json").read_text()}

    monkeypatch.setattr(report, "built", drawn)
    assert "proved and checked" in ran()
    found = (tmp_path / "ledger.json").read_text()
    assert "nothing has changed" in ran() and ran("--json", "-") == found
    for name in ("horseshoe.json", "ledger.json", "MANIFEST.json", "ledger.md"):
        path = tmp_path / name
        path.write_text(path.read_text().replace('"VERIFIED"', '"REFUTED"', 1))
        assert "nothing has changed" not in ran(), name
        assert (tmp_path / "ledger.json").read_text() == found
        assert "nothing has changed" in ran()
    folder = tmp_path / "from somebody else"
    shutil.copytree(tmp_path, folder)
    assert main(["--only", "H16", "--out", str(folder)]) == 0
    assert "checked again" in capsys.readouterr().out, "nothing in a folder vouches for it"
    for more in (["--digits", "30"], ["--fresh"], ["--only", "H11"]):
        assert "nothing has changed" not in ran(*more), more
    assert "nothing has changed" not in ran() and "nothing has changed" in ran()
    monkeypatch.setattr(current, "_digests", without("trusted/verify.py"))
    assert "checked again" in ran() and "nothing has changed" in ran()


def test_what_is_undecided_is_tried_again(tmp_path, monkeypatch):
    monkeypatch.setattr(current, "pages", lambda *about: {"ledger.md"})
    rows = [{"id": claim, "verdict": "UNDECIDED"} for claim in FLAT]
    (tmp_path / "ledger.json").write_text(json.dumps({"claims": rows}))
    assert shell._unchanged(tmp_path, FLAT) is None
    (tmp_path / "ledger.json").write_text(
        json.dumps({"claims": [{**row, "verdict": "VERIFIED"} for row in rows]})
    )
    assert shell._unchanged(tmp_path, FLAT) is not None
    assert shell._unchanged(tmp_path, FLAT[:2]) is None


@pytest.mark.slow
def test_pages_are_made_again_only_where_something_has_changed(tmp_path, monkeypatch, capsys):
    made = []

    def built(folder, *arguments, **known):
        made.append(folder)
        return {"ledger.md": (folder / "ledger.json").read_text()}

    monkeypatch.setattr(report, "built", built)
    for times, more in ((1, ()), (1, ()), (2, ("--fresh",))):
        assert run(tmp_path, *more) == 0
        assert len(made) == times
        assert (tmp_path / "ledger.md").read_text() == (tmp_path / "ledger.json").read_text()
        assert f"{tmp_path}/ledger.md" in capsys.readouterr().out


@pytest.mark.slow
def test_pages_are_those_of_the_certificates_and_of_the_program(tmp_path, monkeypatch):
    (tmp_path / "one.json").write_text("{}")
    texts = {"ledger.md": "text", "figures/one.svg": "<svg/>"}

    def there():
        return current.pages(tmp_path, current.inputs(tmp_path))

    def write():
        files.write_files(tmp_path, texts)
        current.record(tmp_path, current.inputs(tmp_path), texts)

    assert there() is None
    write()
    assert there() == set(texts)
    for change in (
        lambda: (tmp_path / "ledger.md").write_text("edited"),
        lambda: (tmp_path / "figures" / "one.svg").unlink(),
        lambda: (tmp_path / "one.json").write_text("[]"),
        lambda: (tmp_path / "two.json").write_text("{}"),
        lambda: current.place(tmp_path).write_text("{"),
        lambda: monkeypatch.setattr(current, "_version", lambda package: "another"),
        lambda: monkeypatch.setattr(current, "_digests", without("report/html.py")),
        lambda: monkeypatch.setattr(current, "_digests", without("templates/page.html")),
        lambda: monkeypatch.setattr(current, "_digests", without("interval.py")),
    ):
        change()
        assert there() is None
        write()
        assert there() == set(texts)


def without(name, digests=current._digests):
    """The digests of all files but one."""
    return lambda *of: [text for text in digests(*of) if name not in text]


@pytest.mark.slow
@pytest.mark.parametrize(
    "old, new",
    [
        ('"REFUTED"', '"VERIFIED"'),
        pytest.param("2121/10000", "2122/10000", marks=pytest.mark.slow),
        pytest.param("}", "", marks=pytest.mark.slow),
    ],
)
def test_a_file_that_does_not_prove_it_is_proved_again(tmp_path, old, new):
    assert run(tmp_path) == 0
    path = tmp_path / "horseshoe.json"
    good = path.read_text()
    path.write_text(good.replace(old, new, 1))
    (job,) = jobs(FLAT, tmp_path, 30, False)
    found = settle(job)
    assert found.is_new and found.made.certificate == good


def changed_gap():
    """The equation (10) with 99/100 nu in place of nu."""
    source = inspect.getsource(equations.gap)
    for name in ("lift", "rate"):
        assert source.count(f"{name} * (") == 1
        source = source.replace(f"{name} * (", f"{name} * 99 / 100 * (")
    space = dict(vars(equations))
    exec(compile(source, equations.__file__, "exec", 1 << 24), space)  # annotations as strings
    return space["gap"].__code__


@pytest.mark.slow
def test_another_equation_has_it_proved_again(tmp_path, monkeypatch):
    """Prover and checker share the equations, so that what is proved then is about the new ones."""
    assert run(tmp_path) == 0
    old = (tmp_path / "horseshoe.json").read_text()
    monkeypatch.setattr(equations.gap, "__code__", changed_gap())
    with pytest.raises(Rejected):
        check(old)
    (job,) = jobs(["H1"], tmp_path, 30, False)
    again = settle(job)
    assert again.is_new
    monkeypatch.undo()
    with pytest.raises(Rejected):
        check(again.made.certificate)


@pytest.mark.slow
def test_a_claim_that_is_not_there_is_proved(tmp_path):
    assert run(tmp_path) == 0
    (job,) = jobs(["H1", "H16"], tmp_path, 30, False)
    found = settle(job)
    assert found.is_new
    assert {claim.id for claim in found.report.claims} == {"H1", "H16"}
