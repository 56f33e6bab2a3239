"""One way in: the list of commands, what each takes, and the form of what each says to machines."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs import __main__ as every
from proofs import __version__, check
from proofs.commands import impact, ledger
from proofs.commands.groups import GROUPS
from proofs.shell.groups import FILES, produce, wanted
from proofs.trusted.manifest import command
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import check as verified
from tests.proofs.shell.processes import AT, QUICK, ROOT, arguments_of
from tests.proofs.trusted import corpus

PACKAGES = {"benchmark", "formal", "report", "stress"}
QUESTIONS = ["impact", "orbits", "single_impact"]


def main_of(name):
    return every.main if name == "__main__" else lambda arguments: every.main([name, *arguments])


def test_the_list_has_a_line_for_every_command(capsys):
    assert {*FILES, *QUESTIONS, *PACKAGES, "check", "ledger"} <= set(every.commands())
    for arguments in ([], ["--help"], ["-h"]):
        assert every.main(arguments) == 0
        said = capsys.readouterr().out
        for name, line in every.commands().items():
            assert re.search(rf"^  {name} +{re.escape(line)}$", said, re.M) and len(line) > 20


def test_a_new_command_is_listed_when_it_is_there(tmp_path, monkeypatch):
    """By its guard; by a package's `__main__`; other modules are not."""
    guard = 'if __name__ == "__main__":\n    pass\n'
    (tmp_path / "shadow.py").write_text(f'"""Casts\none.\n\nMore."""\n{guard}')
    (tmp_path / "library.py").write_text('"""No command."""\n')
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder/__main__.py").write_text(f'"""Is one."""\n{guard}')
    monkeypatch.setattr(every, "_ROOT", tmp_path)
    assert every.modules() == {"shadow": "Casts\none.\n\nMore.", "folder": "Is one."}


def test_a_command_is_named_first(capsys):
    assert every.main(["impact", *AT, "--phi", "1.11"]) == 0
    said = capsys.readouterr().out
    assert impact.main([*AT, "--phi", "1.11"]) == 0
    assert capsys.readouterr().out == said
    assert every.main(["check", str(corpus.path_of("accepted/h16_alone"))]) == 0
    with pytest.raises(SystemExit):
        every.main(["stress", "--help"])
    assert "python -m proofs stress" in capsys.readouterr().out


@pytest.mark.slow
def test_without_a_command_options_are_the_ledgers(tmp_path, capsys):
    ask = ["--only", "H16", "--out", str(tmp_path), "--json", "-"]
    assert every.main(ask) == 0
    said = capsys.readouterr().out
    assert every.main(["ledger", *ask]) == 0 and capsys.readouterr().out == said
    assert json.loads(said)["claims"][0]["id"] == "H16"


@pytest.mark.parametrize("name", ["hoseshoe", "trusted", "__main__", "", "reports/x.json"])
def test_what_is_no_command_is_a_line(name, capsys):
    assert every.main([name]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert ("horseshoe" in said.err) == (name == "hoseshoe")


@pytest.mark.parametrize("name", ["__main__", *every.commands()])
def test_every_command_has_a_version(name, capsys):
    try:
        assert main_of(name)(["--version"]) == 0
    except SystemExit as leave:
        assert leave.code == 0
    assert capsys.readouterr().out == f"impact-proofs {__version__}\n"


# -- options ---------------------------------------------------------------------------------------

CHANGES = {
    "eta": {"eta": Fraction("0.25")},
    "nu": {"nu": Fraction("-0.3")},
    "left": {"left": (Fraction("1.12"), Fraction("1.15"))},
    "right": {"right": (Fraction("1.28"), Fraction("1.32"))},
    "interval": {"interval": (Fraction("1.1"), Fraction("1.33"))},
    "slopes": {"slopes": (Fraction(4), Fraction(5)), "ratios": None, "printed_s0": None},
    "epsilon": {"epsilon": Fraction("0.02")},
    "velocities": {"velocities": (Fraction("-0.4"), Fraction(0))},
    "reach": {"reach": (Fraction("0.00004"), Fraction("0.00004"), Fraction("0.004"))},
}


@pytest.mark.parametrize(
    "name",
    [pytest.param(x, marks=pytest.mark.slow if x == "sets" else pytest.mark.long) for x in FILES],
)
def test_what_a_command_takes_is_what_it_heeds(name):
    """A number that is an option changes what is decided or said; one that is none does not."""
    decided = {}
    for option, change in {"": {}, **CHANGES}.items():
        of = replace(PAPER, **change)
        made = produce(wanted(name, of) or wanted(name, of, FILES[name][name]), of, digits=12)
        decided[option] = json.loads(made.certificate)["claims"]
    assert {x for x in CHANGES if decided[x] != decided[""]} == set(GROUPS[name].heeded)
    same = {x["id"] for x in decided[""] if all(x in claims for claims in decided.values())}
    assert same >= {*GROUPS[name].fixed}


def test_two_provers_that_name_their_steps_alike_share_a_certificate():
    """Each alone calls its first steps equal-1, equal-2, ...; what they prove is not the same."""
    made = produce({"soft": ("S1", "S6"), "foundations": ("M1", "M2")}, PAPER, digits=12)
    alone = produce({"foundations": ("M1", "M2")}, PAPER, digits=12)
    assert made.lines[2:] == alone.lines
    steps, own = (json.loads(each.certificate)["steps"] for each in (made, alone))
    assert steps.keys() & own.keys() and len(verified(made.certificate).claims) == 4
    assert all(step in steps.values() for step in own.values())


@pytest.mark.parametrize("name", FILES)
def test_what_it_does_not_heed_it_refuses(name, capsys):
    for option in CHANGES.keys() - {*GROUPS[name].heeded} - {"nu", "epsilon"}:
        with pytest.raises(SystemExit) as leave:
            main_of(name)([f"--{option}", "0.3", "0.4", "0.5"])
        said = capsys.readouterr()
        assert leave.value.code == 2 and said.out == "" and said.err.count("\n") == 1
        assert f"--{option} would change nothing here" in said.err
    with pytest.raises(SystemExit):
        main_of(name)(["--bogus"])
    assert "unrecognized arguments: --bogus\n" in capsys.readouterr().err


@pytest.mark.parametrize("name, claim", [("horseshoe", "H16"), ("sets", "H12"), ("soft", "S2")])
def test_the_command_in_the_manifest_is_one_that_is_taken(name, claim, tmp_path):
    """At numbers that leave the usual box of parameters no room, too."""
    option = {"eta": "0.00002", "nu": "-0.00002", "epsilon": "0.001"}
    given = [f"--{x}={option[x]}" for x in GROUPS[name].heeded if x in option]
    given += ["--left", "1.12", "1.16"] if "left" in GROUPS[name].heeded else []
    status = main_of(name)([*given, "--only", claim, "--quiet", "--out", str(tmp_path)])
    assert status in (0, 1)
    manifest = json.loads((tmp_path / "MANIFEST.json").read_text())["files"]
    made = manifest[f"{name}.json"]["made"].split()
    before = (tmp_path / f"{name}.json").read_text()
    assert main_of(name)([*made[4:], "--quiet", "--out", str(tmp_path)]) == status
    assert (tmp_path / f"{name}.json").read_text() == before


def test_the_command_leaves_out_what_follows_from_the_sets():
    moved = replace(PAPER, left=(Fraction("1.12"), Fraction("1.15")))
    made = "python -m proofs sets --left 1.12 1.15"
    assert command("sets.json", moved) == f"{made} --interval 1.11 1.32"
    moved = replace(moved, interval=(Fraction("1.12"), PAPER.interval[1]))
    assert command("sets.json", moved) == made


# -- for machines ----------------------------------------------------------------------------------


def numbers(value):
    """Every number of a machine form that is no string."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [x for each in value for x in numbers(each)]
    return [] if isinstance(value, (str, bool, type(None))) else [value]


MACHINES = {name: QUICK[name] for name in QUESTIONS} | {
    "horseshoe": ["--only", "H1"],
    "ledger": ["--only", "H16"],
    "soft": ["--only", "S2"],  # all groups are alike
    "stress": ["--cases", "2", "--family", "operations"],
}


@pytest.mark.parametrize("name", MACHINES)
def test_every_machine_form_has_a_schema_and_one_form_of_numbers(name, tmp_path, capsys):
    """Exact numbers and bounds are strings, counts integers; only measured times are floats."""
    arguments = arguments_of(name, tmp_path, MACHINES)
    assert main_of(name)([*arguments, "--json", "-"]) == 0
    said = capsys.readouterr().out
    found = json.loads(said)
    assert re.fullmatch(r"impact-proofs\.[a-z_]+/\d+", found["schema"])
    assert name == "stress" or all(isinstance(x, int) for x in numbers(found))
    again = str(tmp_path / "again.json")
    assert main_of(name)([*arguments, "--json", again, "--quiet"]) == 0
    assert capsys.readouterr().out == ""
    if name != "stress":  # this one has times
        assert (tmp_path / "again.json").read_text() == said


# -- the checker -----------------------------------------------------------------------------------


def piped(text):
    command = [sys.executable, "-S", "-O", "-m", "proofs.check", "-"]
    return subprocess.run(command, input=text, cwd=ROOT, capture_output=True, check=False)


@pytest.mark.slow
def test_the_checker_reads_what_is_piped_in():
    text = corpus.path_of("accepted/h16_alone").read_bytes()
    done = piped(text)
    assert done.returncode == 0 and done.stdout.startswith(b"standard input: accepted")
    for wrong in (b"", b"\xff", text[:100], b" " * 5_000_000):
        done = piped(wrong)
        assert done.returncode == 2 and done.stdout == b"" and done.stderr.count(b"\n") == 1
        assert done.stderr.startswith(b"standard input: malformed")


@pytest.mark.slow
def test_the_checker_says_what_a_ledger_is(tmp_path, capsys):
    assert ledger.main(["--only", "H16", "--quiet", "--out", str(tmp_path)]) == 0
    assert check.main([str(tmp_path / "ledger.json"), str(tmp_path / "MANIFEST.json")]) == 0
    said = capsys.readouterr().out.splitlines()
    assert f"{tmp_path}/ledger.json: a ledger of 1 claims" in said[0]
    assert f"{tmp_path}/MANIFEST.json: a manifest of 1 claims" in said[1]
    (tmp_path / "horseshoe.json").unlink()
    assert check.main([str(tmp_path / "ledger.json")]) == 1
    assert "ledger.json: REJECTED" in capsys.readouterr().err
