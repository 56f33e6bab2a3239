"""`python -m proofs formal`: what it writes, prints, refuses, and the status it leaves with."""

import json

import pytest

from proofs.formal import __main__ as formal
from proofs.formal import coqc
from proofs.formal.written import Case, Theorem
from tests.proofs.formal.coq import PAPER, ROOT, needs_coqc, printed_by_coq
from tests.proofs.shell.processes import guarded_here
from tests.proofs.trusted.corpus import CORPUS, path_of

LOGISTIC = ROOT / "reports" / "systems" / "logistic" / "horseshoe.json"
REALS = {
    "ClassicalDedekindReals.sig_not_dec",
    "ClassicalDedekindReals.sig_forall_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
}


@needs_coqc
@pytest.mark.slow
def test_the_paper_s_theorems(proved):
    shown = (proved.parent / "shown").read_text()
    answer = json.loads((proved.parent / "answer.json").read_text())
    names = [each["name"] for each in answer["theorems"]]
    assert names[:4] == ["model", "corrected_theorem", "theorem_3", "theorem_4"]
    assert {"measure_zero", "H1_verified", "H2_refuted", "H3_verified"} < set(names)
    assert {"H4_verified", "H5_refuted", "no_word_000", "H6_verified"} < set(names)
    assert {"H11_conditional", "H16_verified"} < set(names)
    assert set(answer["axioms"]) == REALS and len(answer["axioms"]) == 4
    assert answer["other_axioms"] == [] and int(answer["seconds"]) < 900
    assert int(answer["megabytes"]) < 1500
    assert all(name in shown for name in [*names, *REALS])


@needs_coqc
@pytest.mark.slow
def test_what_coq_has_proved_is_what_is_meant(proved):
    """Asked of coqc itself: the theorem's numbers, and that f' is one number."""
    said = printed_by_coq(
        proved, "Check corrected_theorem.", "Check (slope_at_unique side eta nu)."
    )
    numbers = "(11 / 10) (23 / 20) (127 / 100) (33 / 25) 1 1 (43 / 10) (619 / 100)"
    assert (
        f"horseshoe next {numbers}" in said and "slope_at phi d -> slope_at phi e -> d = e" in said
    )


@pytest.mark.slow
@needs_coqc
def test_an_axiom_of_one_s_own_is_told_with_status_3(capsys, tmp_path, monkeypatch):
    cheat = "Axiom easy : False.\nTheorem corrected_theorem : 1 = 2.\nProof. destruct easy. Qed.\n"
    text = cheat + "Definition all := corrected_theorem.\nPrint Assumptions all.\n"
    made = Case(text, [Theorem("corrected_theorem", "one is two")])
    monkeypatch.setattr(formal.cases, "case", lambda *of: made)
    assert formal.main([str(PAPER), "--out", str(tmp_path)]) == 3
    assert "axioms not expected: easy" in capsys.readouterr().err


@pytest.mark.slow
@needs_coqc
def test_what_coqc_refuses_is_a_bug_with_status_3(capsys, tmp_path, monkeypatch):
    text = "Theorem corrected_theorem : 1 = 2.\nProof. reflexivity. Qed.\n"
    made = Case(text, [Theorem("corrected_theorem", "one is two")])
    monkeypatch.setattr(formal.cases, "case", lambda *of: made)
    assert formal.main([str(PAPER), "--out", str(tmp_path)]) == 3
    error = capsys.readouterr().err
    assert "coqc REFUSES" in error and "corrected_theorem" in error and error.count("\n") == 1


@pytest.mark.slow
def test_without_coqc_the_files_are_written_and_a_line_says_how_to_get_it(
    capsys, tmp_path, monkeypatch
):
    coqc._installed.cache_clear()
    monkeypatch.setenv("PATH", str(tmp_path))
    assert formal.main([str(PAPER), "--out", str(tmp_path / "out")]) == 1
    said = capsys.readouterr()
    assert "apt-get install coq" in said.err and said.err.count("\n") == 1 and not said.out
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"Impact.v", "Flight.v", "Shift.v", "Corrected.v", "Case.v"} <= written


SCRIPT = """#!/bin/sh
case "$1" in
  --print-version) echo "{version} 4.13.1" ;;
  -where) echo "{where}" ;;
  *) for file; do :; done
     touch "${{file%.v}}.vo"
     [ "$file" = Case.v ] || exit 0
     {does} ;;
esac
"""
FAILS = "echo 'File \"./Case.v\", line 13, characters 0-5:\nError: {}' >&2; exit 1"
AT_WORK = 'echo "Chars 0 - 60 [x] 1. secs"; '
# what a coqc does on the case; the status, and what the one line says
ENDINGS = {
    "killed": (AT_WORK + "kill -9 $$", 1, "killed by signal 9"),
    "out of memory": ('echo "Error: Out of memory." >&2; exit 1', 1, "Out of memory"),
    "out of time": (AT_WORK + "exec sleep 60", 1, "is not done in 1 s"),
    "an unknown option": ('echo "Error: Unknown option -time" >&2; exit 1', 1, "Unknown option"),
    "a library that is another": (
        FAILS.format("Cannot find a physical path bound to logical path Interval."),
        1,
        "a part of Coq is missing",
    ),
    "a full disk": (
        'echo "Error: System error: No space left on device" >&2; exit 1',
        2,
        "No space left on device",
    ),
    "refused": (FAILS.format("The term has another type."), 3, "coqc REFUSES"),
}


@pytest.fixture
def pretended(tmp_path, monkeypatch):
    """Returns what puts a program in coqc's place, as one of a version, with what it does."""

    def put(does, version="8.16.1", parts=coqc._PARTS):
        for part in parts:
            place = tmp_path / "lib" / "user-contrib" / part
            place.parent.mkdir(parents=True, exist_ok=True)
            place.touch()
        script = tmp_path / "bin" / "coqc"
        script.parent.mkdir()
        script.write_text(SCRIPT.format(version=version, where=tmp_path / "lib", does=does))
        script.chmod(0o755)
        monkeypatch.setenv("PATH", f"{script.parent}:/usr/bin:/bin")
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
        coqc._installed.cache_clear()
        return ["--out", str(tmp_path / "out"), "--seconds", "1"]

    yield put
    coqc._installed.cache_clear()


@pytest.mark.parametrize("name", ENDINGS)
def test_how_coqc_may_end_is_a_line_with_its_status(capsys, pretended, name):
    does, status, line = ENDINGS[name]
    ended = guarded_here(lambda: formal.main([str(LOGISTIC), *pretended(does)]))
    said = capsys.readouterr()
    assert ended == status and line in said.err and said.err.count("\n") == 1 and not said.out


@pytest.mark.parametrize("old", ["8.13.2", "8.9", "unknown"])
def test_an_old_coqc_is_a_line_and_status_1(capsys, pretended, old):
    assert formal.main([str(LOGISTIC), *pretended("exit 0", version=old)]) == 1
    assert "is older than 8.16" in capsys.readouterr().err


def test_a_missing_library_is_named(capsys, pretended):
    assert formal.main([str(LOGISTIC), *pretended("exit 0", parts=coqc._PARTS[:1])]) == 1
    assert "coqc has no library Coquelicot" in capsys.readouterr().err


def test_the_theory_is_compiled_once(pretended, tmp_path):
    pretended("exit 0")
    told = []
    for _ in range(2):
        coqc.theory(["Graph"], told.append)
    assert told == ["coqc Graph.v, theory"]


@needs_coqc
@pytest.mark.slow
def test_the_checker_s_arithmetic(capsys, tmp_path):
    assert formal.main(["--arithmetic", "--out", str(tmp_path), "--json", "-"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [each["name"] for each in answer["theorems"]] == [
        "numbers",
        "linear",
        "products",
        "sets",
        "circle",
        "sines",
    ]
    assert set(answer["axioms"]) == REALS


@pytest.mark.parametrize("kind", ["rejected", "malformed"])
def test_a_wrong_certificate_is_one_line_and_nothing_is_written(capsys, tmp_path, kind):
    out = tmp_path / "out"
    paths = [path_of(name) for name in CORPUS if name.startswith(f"{kind}/")]
    assert len(paths) > 10
    for path in paths:
        with pytest.raises(SystemExit) as left:
            formal.main([str(path), "--out", str(out)])
        said = capsys.readouterr()
        assert left.value.code == 2, path
        assert said.err.count("\n") == 1 and path.name in said.err and not said.out
    assert not out.exists()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["circle.json", "nothing.json", "MANIFEST.json"])
def test_what_is_no_certificate_of_a_horseshoe(capsys, tmp_path, name):
    out = tmp_path / "out"
    with pytest.raises(SystemExit) as left:
        formal.main([str(ROOT / "reports" / name), "--out", str(out)])
    assert left.value.code == 2 and capsys.readouterr().err.count("\n") == 1 and not out.exists()


@pytest.mark.slow
def test_a_folder_that_cannot_be_written(capsys, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(SystemExit) as left:
        formal.main([str(PAPER), "--out", str(tmp_path / "file" / "out")])
    assert left.value.code == 2 and "cannot write" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
