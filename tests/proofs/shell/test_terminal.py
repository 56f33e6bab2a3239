"""On a terminal of any width: words stay whole; in a pipe: plain lines, the same each time."""

import json
import re
import sys
from contextlib import suppress
from io import StringIO
from time import sleep

import pytest

from proofs import check, horseshoe
from proofs.__main__ import main
from proofs.shell.cli import progress
from proofs.shell.screen import Decided, fitted, gist, show_verdicts
from proofs.trusted.verdicts import Verdict
from tests.proofs.shell.processes import (
    COMMANDS,
    ROOT,
    arguments_of,
    on_terminal,
    started,
)

WIDTHS = (60, 80, 120)


def fits(lines, width):
    """Whether every line fits, but for a word that is longer than the terminal."""
    return all(len(line) <= width or " " not in line.strip() for line in lines)


def words(lines):
    return " ".join(lines).split()


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_help_fits_and_has_examples(name, monkeypatch):
    screen, width = Terminal(), WIDTHS[COMMANDS.index(name) % 2]
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr(sys, "stdout", screen)
    with suppress(SystemExit):
        assert main([*([] if name == "__main__" else [name]), "--help"]) == 0
    lines = screen.getvalue().splitlines()
    examples = " ".join(words(lines)).partition("examples:")[2]
    assert name == "__main__" or f"python -m proofs {name} " in examples
    assert fits(lines, width), [line for line in lines if len(line) > width]


@pytest.mark.slow
@pytest.mark.parametrize("width", WIDTHS)
def test_the_main_job_fits_and_says_the_same_as_in_a_pipe(width, tmp_path):
    arguments = arguments_of("horseshoe", tmp_path)
    status, lines, raw = on_terminal("horseshoe", arguments, width)
    assert status == 0 and fits(lines, width) and "\x1b[32m" in raw
    with started("horseshoe", arguments) as process:
        out, err = process.communicate()
    plain = out.decode()
    assert err == b"" and "\x1b" not in plain
    timed = re.compile(r"\d+ ms")
    assert timed.sub("", " ".join(words(lines))).split() == timed.sub("", plain).split()


@pytest.mark.long
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_fits(name, width, tmp_path):
    for arguments in (arguments_of(name, tmp_path), ["--bogus"]):
        status, lines, _ = on_terminal(name, arguments, width)
        assert status == (2 if "--bogus" in arguments else 0)
        assert fits(lines, width), [line for line in lines if len(line) > width]


@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_a_pipe_has_plain_lines_the_same_each_time(name, tmp_path):
    said = set()
    for _ in range(2):
        with started(name, arguments_of(name, tmp_path)) as process:
            out, err = process.communicate()
        assert "\x1b" not in out.decode() and err == b"" and process.returncode == 0
        said.add(re.sub(r"[0-9.e+-]+ +m?s\b|.*\| +[0-9.e+|]+.*", "", out.decode()))
    assert len(said) == 1


# -- by themselves ---------------------------------------------------------------------------------


class Terminal(StringIO):
    """Takes text, and says that it is a terminal."""

    def isatty(self):
        return True


def shown(monkeypatch, width, rows):
    screen = Terminal()
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr(sys, "stdout", screen)
    show_verdicts(rows)
    return re.sub(r"\x1b\[[0-9;]*m", "", screen.getvalue()).splitlines()


@pytest.mark.parametrize("width", [20, 40, 60, 79, 120, 300])
def test_no_word_is_broken_or_lost(width, monkeypatch):
    text = "f([1.11, 1.15]) is short, 0.36746531978244912204348910692934 is not [bold]so[/bold]"
    rows = [Decided(f"H{k}", verdict, text, f"{text} {k}") for k, verdict in enumerate(Verdict)]
    lines = shown(monkeypatch, width, rows)
    assert fits(lines, width)
    for word in text.split():
        assert sum(word in line.split() for line in lines) >= len(rows), word


def test_progress_is_one_line_that_is_wiped(monkeypatch):
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    monkeypatch.setenv("COLUMNS", "30")
    with progress(after=10) as tell:
        tell("too short to be shown")
    assert screen.getvalue() == ""
    with progress(after=0.02) as tell:
        tell("the first of several parts, at length")
        sleep(0.2)
        tell("")
        assert screen.getvalue() == "\r\x1b[K0 s: the first of several ...\r\x1b[K"
        sleep(0.1)
    assert screen.getvalue().endswith("...\r\x1b[K")
    with progress(after=0.02) as tell, progress(after=0.02) as inner:
        assert inner is tell
    monkeypatch.setattr(sys, "stderr", StringIO())
    with progress(after=0.01) as tell:
        tell("nobody sees it")
        sleep(0.05)
    assert sys.stderr.getvalue() == ""


def test_no_colour_where_it_is_not_wanted(monkeypatch):
    monkeypatch.setenv("NO_COLOR", "1")
    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    show_verdicts([Decided("H1", Verdict.REFUTED, "all", "none")])
    assert "REFUTED" in screen.getvalue() and "\x1b[3" not in screen.getvalue()


def test_a_text_is_broken_between_words_and_elsewhere_stays(monkeypatch):
    monkeypatch.setenv("COLUMNS", "30")
    text = "one two three four five six seven\n  a: " + "word " * 12 + "\n\n" + "x" * 50 + "\n"
    lines = fitted(text, Terminal()).split("\n")
    assert fits(lines, 30) and words(lines) == text.split()
    assert lines[1] == "  seven" and lines[3].startswith("    word") and lines[-1] == ""
    assert fitted(text, StringIO()) == text


def test_the_screen_says_what_is_true_then_a_line_a_claim_then_numbers_on_request(tmp_path, capsys):
    assert horseshoe.main(["--only", "H1", "H2", "H5", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0].startswith("True (H2, H5): At (eta, nu) = (0.2121, -0.2): f is ")
    claims = [line for line in said if re.match(r"H\d+ ", line)]
    assert [line.split()[0] for line in claims] == ["H1", "H2", "H5"]
    assert max(map(len, claims)) <= 100 and "slope_min_I0 in" not in "".join(said)
    assert horseshoe.main(["--only", "H1", "H2", "--verbose", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "f'(1.13) is in [5.29635330653, " in said and "slope_min_I0 in [" in said


def test_what_is_not_decided_says_why_in_any_case(capsys):
    row = Decided("H1", Verdict.UNDECIDED, "At (eta, nu) = (1, 2): f' > 1.", "no cover")
    show_verdicts([row], verbose=False)
    assert capsys.readouterr().out == "H1   UNDECIDED   f' > 1.\n     no cover\n"


def test_every_theorem_of_the_ledger_has_a_gist_of_two_assertions():
    """None is cut within a sentence, and none begins with what refers to something before it."""
    claims = json.loads((ROOT / "reports/ledger.json").read_text())["claims"]
    for text in {claim["corrected"] for claim in claims} - {None}:
        short = gist(text)
        assert text.startswith(short.removesuffix(" ...")) and short.count(". ") <= 5
        assert short == text or short.endswith(". ...")


def test_quiet_is_quiet(tmp_path, capsys):
    assert horseshoe.main(["--only", "H1", "--quiet", "--out", str(tmp_path)]) == 0
    assert check.main(["--quiet", str(tmp_path / "horseshoe.json")]) == 0
    said = capsys.readouterr()
    assert said.out == said.err == ""
