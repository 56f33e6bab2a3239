"""Bad input to the commands: one line, status 2, nothing written."""

import os
import shlex
from time import perf_counter

import pytest

from proofs.__main__ import main
from proofs.commands import impact, single_impact
from proofs.search import periodic
from tests.proofs.shell.processes import guarded_here

AT = ["--eta", "0.2121", "--nu", "-0.2"]
POINT = [*AT, "--phi", "1.11"]
KICK = " ".join(POINT)
KICKED = {"--epsilon": "0.01", "--gamma": "-0.3"}
BASES = {
    "impact": {"--eta": "0.2121", "--nu": "-0.2", "--phi": "1.11", **KICKED},
    "orbits": {"--word": "01", "--eta": "0.2121", "--nu": "-0.2"},
    "single_impact": {"--eta": "0.2121", "--nu": "-0.2", "--n": "4"},
}
NO_NUMBERS = ["x", "", "nan", "inf", "-inf", "1/0", "0x10", "1e400", "1e-400", "-1e400"]
NO_NUMBERS += ["1e999999999", "1e-999999999", "9" * 250, "1/" + "9" * 250, "--bogus"]
OUTSIDE = {
    "--eta": ["0", "-1", "-1e-9"],
    "--nu": ["0"],
    "--phi": ["-1e-9", "7", "1e180"],
    "--epsilon": ["-1e-9", "1.000001", "1e180", "-1/3"],
    "--gamma": ["1e180"],  # from inside the table, for all of them
    "--n": ["0", "-1", "1.5", "1e7"],
    "--word": ["2", "0" * 257, "O1"],
}
NO_DIGITS = ["0", "-3", "1000000000", "1001", "1.5", "nan", "1e3", "x", "", "\u0663", "9" * 5000]
FILES = [*((command, "--json") for command in BASES), ("orbits", "--csv")]
WORK = {
    impact: "rebound",
    periodic: "horseshoe",
    single_impact: "answer_for",
}


def flat(options):
    return [part for pair in options.items() for part in pair]


def refused(capsys, command, arguments):
    """The one line that a command leaves with, at once, with status 2."""
    capsys.readouterr()
    began = perf_counter()
    assert guarded_here(lambda: main([command, *arguments])) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1 and said.err.endswith("\n")
    begins = f"python -m proofs {command}: ", "python -m proofs: nowhere.toml: "
    assert said.err.startswith(begins) and "Traceback" not in said.err
    assert perf_counter() - began < 5
    return said.err


def wrong_options():
    """(command, arguments)"""
    for command, base in BASES.items():
        for option in base:
            wrong = NO_NUMBERS if option != "--word" else ["", "--bogus"]
            for text in [*wrong, *OUTSIDE.get(option, [])]:
                arguments = flat(base | {option: text})
                yield pytest.param(command, arguments, id=f"{command}{option}={text:.9}")


@pytest.mark.parametrize("command, arguments", [*wrong_options()])
def test_a_wrong_number_is_refused(command, arguments, capsys):
    refused(capsys, command, arguments)


@pytest.mark.parametrize(
    ("command", "claim"),
    [("foundations", "M7"), ("resonance", "R11"), ("single", "P6"), ("soft", "S21")],
)
def test_the_most_digits_that_can_be_asked_for_are_proved_and_checked(command, claim, tmp_path):
    options = ["--only", claim, "--digits", "1000", "--quiet", "--out", str(tmp_path)]
    assert main([command, *options]) == 0


@pytest.mark.parametrize("text", NO_DIGITS, ids=[text[:10] for text in NO_DIGITS])
@pytest.mark.parametrize("command", BASES)
def test_digits_are_a_whole_number_up_to_1000(command, text, capsys):
    assert "digits" in refused(capsys, command, [*flat(BASES[command]), "--digits", text])


@pytest.mark.parametrize("command", BASES)
def test_nothing_may_be_missing_or_too_much(command, capsys):
    base = BASES[command]
    for option in base:
        refused(capsys, command, [*flat({k: v for k, v in base.items() if k != option}), option])
    for more in (["stray"], ["--bogus"], ["--digits"], ["--json"]):
        refused(capsys, command, [*flat(base), *more])
    for option in (option for option in base if (command, option) not in OPTIONAL):
        refused(capsys, command, flat({k: v for k, v in base.items() if k != option}))


OPTIONAL = {("orbits", "--eta"), ("orbits", "--nu"), ("single_impact", "--n")}


# -- files -----------------------------------------------------------------------------------------


@pytest.fixture
def no_work(monkeypatch):
    """Make the work itself fail: a target is refused before it."""

    def refuse(*arguments, **options):
        raise AssertionError("worked")

    for command, name in WORK.items():
        monkeypatch.setattr(command, name, refuse)


@pytest.mark.parametrize("command, option", FILES)
def test_a_file_that_cannot_be_written_is_refused_before_the_work(
    command, option, tmp_path, capsys, no_work
):
    base = flat(BASES[command])
    (tmp_path / "file").write_text("mine")
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "link").symlink_to(tmp_path / "fifo")
    for name in ("", "fifo", "link", ".", "file/below", "x" * 300):
        target = str(tmp_path / name) if name else ""
        assert "cannot write" in refused(capsys, command, [*base, option, target])
    assert (tmp_path / "file").read_text() == "mine" and (tmp_path / "fifo").is_fifo()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fifo", "file", "link"]
    with pytest.raises(AssertionError, match="worked"):
        main([command, *base, option, str(tmp_path / "file")])
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.parametrize("command, option", FILES)
def test_where_writing_fails_in_the_end_nothing_is_printed(
    command, option, tmp_path, capsys, monkeypatch
):
    def full(file):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    said = refused(capsys, command, [*flat(BASES[command]), option, str(tmp_path / "file")])
    assert "No space left" in said and [*tmp_path.iterdir()] == []


def test_a_link_is_followed_and_stays(tmp_path):
    (tmp_path / "file").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "file")
    assert impact.main([*POINT, "--json", str(tmp_path / "link")]) == 0
    assert (tmp_path / "link").is_symlink() and '"flight"' in (tmp_path / "file").read_text()


def test_two_outputs_are_two_files(tmp_path, capsys, no_work, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for csv, other in (("-", "-"), ("a", "a"), ("a", "./a"), ("a", str(tmp_path / "a"))):
        said = refused(capsys, "orbits", ["--word", "01", "--csv", csv, "--json", other])
        assert "exclude each other" in said
    assert [*tmp_path.iterdir()] == []


# -- what the line says ---------------------------------------------------------------------------

SIDES = "--eta 0.2115 0.2127 --nu -0.201 -0.199"
LOGISTIC = "--map 'r*x*(1 - x)' --set r=3 --box x=0:1"
CELLS = "--map 'r*x*(1 - x) + c' --box x=0:1 --range r 4.9 5.1"
NO_SETS = ["--right 1.32 1.27", "--left 1.27 1.32 --right 1.1 1.15", "--left -1 1.15"]
NO_SETS += ["--right 1.27 7", "--left 1.1", "--period 3"]
QUESTIONS = {  # of x/2
    "--ask orbits:0": "'orbits:0' is no question: ask as in orbits:2",
    "--ask horseshoe:0": "ask as in horseshoe:2",
    "--ask folds:a=1": "ask as in folds:P=A:B,Q=C:D",
    "--ask everything": "horseshoe:2, image:X=A,Y=B:C, ",
    "--ask impact:x=1": "impact is asked of systems, not of maps",
    "--seconds 0": "some seconds are expected, not 0",
    "--walls floor": "walls are those of a system",
    "--set a=2": "the parameter a is in none of the formulas",
    "--set a=2,b=3": "several are written with spaces between",
}
REFUSED = {  # arguments, and what the line says
    "atlas": [
        ("--depth -1", "from 0 to 40"),
        ("-z", "there is no option"),
        (f"--depth {'0' * 30}41", "from 0 to 40"),
        (f"--jobs {'9' * 30}", "from 1 to 1000"),
        ("--eta 0.3 0.2 --nu -0.2 -0.1 --ask horseshoe", "eta: reversed or empty"),
        ("--eta 0.2 0.2 --nu -0.2 -0.1 --ask horseshoe", "eta: reversed or empty"),
        ("--eta 0 0.2 --nu -0.2 -0.1 --ask horseshoe", "eta must be positive"),
        (SIDES, "go together"),
        ("--epsilon 0.1", "go together"),
        (f"{SIDES} --ask horseshoe --depth 41", "depth"),
        (f"{SIDES} --ask horseshoe --jobs 0", "--jobs"),
        (f"{SIDES} --ask horseshoe --executor ssh:somewhere", "dask:"),
        ("", "there is no"),
        (f"{SIDES} --ask chaos", "the question is one of attractor, horseshoe"),
        (f"{SIDES} --ask entropy:1", "entropy:2 to entropy:50"),
        (f"{SIDES} --ask horseshoe --epsilon 0.3", "plastic impacts alone"),
        *(
            (f"{SIDES} --ask orbits --epsilon {x}", "in [0, 1)")
            for x in ("1", "0.3 0.2", "0 .1 .2")
        ),
        (f"{SIDES} --ask horseshoe --json file/atlas.json", "cannot write"),
        *((f"{SIDES} --lines {more}", "") for more in ("--json -", "--cell 0.2122 -0.2")),
        (f"{CELLS} --range c 0 0.01", ""),
        (f"{CELLS} --range c 0 0.01 --eta 1 2", ""),
        (f"{CELLS} --ask horseshoe", ""),
    ],
    "benchmark": [(x, "") for x in ("--nonsense", "--quick --full", "circles", "--out file")],
    "orbits": [
        ("", "--period"),
        ("--period 0", "from 1 to 16"),
        ("--period 17", "from 1 to 16"),
        ("--period x", "from 1 to 16"),
        ("--word 012", "letters 0 and 1"),
        ("--word ''", "letters 0 and 1"),
        (f"--word {'0' * 300}", "letters 0 and 1"),
        ("--word 01 --period 2", "not allowed with"),
        ("--word 01 --left 1.2 1.1", "reversed"),
        ("--word 01 --left 1.1 1.3", "overlap"),
        *((f"--word 01 {sets}", "") for sets in NO_SETS),
        ("--word 01 --nu 0", "nu must not be 0"),
        ("--word 01 --eta abc", "not a number"),
    ],
    "bifurcation": [
        ("'x1 = r*x*(1 - x'", "not a formula"),
        ("'x1 = x^2 + c' --set d=1", "no parameter d"),
        ("'x1 = x^2 + c' --set c", "NAME=NUMBER"),
        ("'x1 = x^2 + c' --kind neimark_sacker", "one variable"),
        ("'x1 = x^2 + c' --near x=0,c=0", "--kind"),
        ("'x1 = x^2 + c' --kind flip --near x=0", "one parameter"),
        ("'x1 = x^2 + c' --solve x", "2 names"),
        ("'x1 = x^2 + h'", "something else: h"),
        *((f"'x1 = {text} + r'", "nowhere a real") for text in ("x/(r - r)", "sqrt(-1)*x")),
        ("'x1 = log(r - r) + x'", "nowhere a real"),
        ("'x1 = r/(sin(x)^2 + cos(x)^2 - 1)'", "nowhere a real"),
        ("'x1 - x1 = x - r'", "do not determine x1"),
        ("'(x1 - x)^2 = r'", "do not determine x1"),
        *((f"'x1 = x + {name} - x^2'", "not a name for a variable") for name in "e"),
        ("'x = 2'", "one or two variables"),
        ("'x1 = r*x*(1 - x)' --json /proc/none/x", "cannot write"),
        ("'x1 = r*x*(1 - x)' --out /proc/none", "cannot write"),
    ],
    "check": [(x, "") for x in ("", "--bogus", "--work x file")],
    "circle": [("--left 1 1.1", "change nothing")],
    "formal": [(x, "a certificate is expected") for x in ("", "file --arithmetic")],
    "horseshoe": [("--left 1.1 1.15 --left 1.1 1.14", "--left is given 2 times")],
    "impact": [
        ("--eta x --nu 1 --phi 1", "not a number"),
        ("--eta 0 --nu 1 --phi 1", "eta must be positive"),
        ("--eta 1 --nu 0 --phi 1", "nu must not be 0"),
        ("--eta 1 --nu 1 --phi 2 1", "reversed"),
        ("--eta 1 --nu 1 --phi 7", "outside the circle"),
        ("--eta 1 --nu 1 --phi -1/5", "outside the circle"),
        ("--eta 1 --nu 1 --phi 1 2 3", "one phase or two"),
        ("--eta 1 --nu 1", "--phi"),
        (f"{KICK} --gamma -0.3", "--epsilon is missing"),
        (f"{KICK} --epsilon 0.01", "--gamma is missing"),
        (f"{KICK} --epsilon 2 --gamma -0.3", "epsilon must be in [0, 1]"),
        (f"{KICK} --epsilon -1/2 --gamma -0.3", "epsilon must be in [0, 1]"),
        (f"{KICK} --epsilon x --gamma -0.3", "not a number"),
        (f"{KICK} --epsilon 0.01 --gamma 0.42", "gamma is at most 0.4192"),
        (f"{KICK} --epsilon 0.01 --gamma 0 1", "physically impossible"),
        (f"{KICK} --epsilon 0.01 --gamma 0 -1", "reversed"),
        (f"{KICK} --epsilon 0.01 --gamma 0 1 2", "one velocity or two"),
        *((f"{KICK} --horizon {x}", "--horizon") for x in ("0", "-1", "1000001", "1e400", "nan")),
        ("--phi 1.1 --phi=1.3", "--phi is given 2 times"),
    ],
    "ledger": [("--only H99", "H99"), ("--digits 0", "digits")],
    "persistence": [("--slopes 4 5", "change nothing")],
    "resonance": [(f"--{name} 2", "") for name in ("eta", "nu")],
    "single": [("--only P5 P1 --eta 0.5", "--eta would change nothing in P5 P1")],
    "single_impact": [("--eta 0.3 --nu 0.2 --eta 0.4", "--eta is given 2 times")],
    "soft": [("--eta 2", "change nothing")],
    "stress": [
        *((x, "") for x in ("--nonsense", "--cases 0", "--cases many", "--seed -1")),
        *((x, "") for x in ("--json .", "--family circles", "--out file/absent")),
    ],
    "system": [
        *(
            (x, "")
            for x in ("", "nowhere.toml", "--example none", "--map 2x", "--map x/2 --figure")
        ),
        *(
            (f"--map x {more}", "")
            for more in ("--effort 0", "--seconds soon", "--set r", "--example wall")
        ),
        *((f"--map x {more}", "") for more in ("--box x=1", "--box y=0:1")),
        *((f"--map x/2 {more}", why) for more, why in QUESTIONS.items()),
        *((f"{LOGISTIC} --ask {x}", "") for x in ("branches", "branches:r=2", "folds:r=2:4")),
        ("--example wall --ask impact:b=1", "a value for each variable"),
        ("--example bouncing-ball --ask rest:phi=1", "no 'rest'"),
        ("--example wall --ask graze:a=1,v=-1", "one variable with a range"),
        ("--example wall --ask touching:a=1,v=-1", "two ranges are expected"),
        ("--example wall --ask grazing:w=2:3", "2 parameters"),
        ("--example bouncing-ball --ask grazing:g=0.1:1,e=0:1", "no 'rest'"),
        ("--example wall --box v=1:3", "the gap d - x is < 0 right after each launch"),
        *((f"{LOGISTIC} --ask {x}:r=2:4,q=1:2", "") for x in ("branches", "flips")),
    ],
}


@pytest.mark.parametrize(
    "command, arguments, why", [(name, *row) for name, rows in REFUSED.items() for row in rows]
)
def test_the_line_says_why_before_the_work(command, arguments, why, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").touch()
    assert why in refused(capsys, command, shlex.split(arguments))
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [tmp_path / "file"]
