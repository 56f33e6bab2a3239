"""--stats of the commands that answer a question: the counts, and what they show is not done."""

import json
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

import pytest
from proofs.trusted.kernel.formula import Tape

from intervals import Interval, Jet
from proofs import impact, orbits, period_doubling, resonance, single_impact
from proofs.check import main as check_command
from proofs.methods.extremes import extremes
from proofs.motion.covering import cover_by_impacts
from proofs.motion.flight import Flight
from proofs.motion.impact import bisected, first_impact
from proofs.motion.system import System
from proofs.shell.cli import counting
from proofs.shell.counting import (
    ALGEBRA,
    ARRAYS,
    BISECTIONS,
    CELLS,
    CHECKED,
    CHECKER,
    COLUMNS,
    EQUATIONS,
    FLOATS,
    FORMULAS,
    GAP,
    GRID,
    INTERVALS,
    MADE,
    MATRIX,
    NUMBERS,
    PARTS,
    RATES,
    ROWS,
    SLOPE,
    WORK,
    Kind,
    counted,
)
from proofs.trusted import equations
from proofs.trusted.paper import GROUPS
from proofs.trusted.paper.s4_single import single_facts
from proofs.trusted.parameters import PAPER
from tests.proofs.trusted.corpus import path_of

ROOT = Path(__file__).parents[3]
AT = ["--eta", "0.2121", "--nu", "-0.2"]
POINT = [*AT, "--phi", "1.11"]
COMMANDS = {
    impact: POINT,
    orbits: ["--word", "01", "--fast"],
    period_doubling: ["--epsilon", "0.1"],
    single_impact: [*AT, "--n", "4"],
    resonance: ["--nu", "-0.2", "--epsilon", "0.5", "--phi", "1", "--gamma", "-0.3"],
}
QUESTIONS = [pytest.param(*pair, id=pair[0].__name__) for pair in COMMANDS.items()]


def rows_of(text):
    """The rows of the one table in a text: what, its number or a number for each column."""
    _, table = text.split("\nasked: ")
    lines = table.splitlines()
    assert lines[1].split() == ["evaluated", *COLUMNS]
    found = {}
    for line in lines[2:]:
        what = next(row for row in ROWS if line.startswith(row + "  "))
        numbers = [int(x.replace(" ", "")) for x in line[len(what) :].split("  ") if x.strip()]
        assert len(numbers) in (1, len(COLUMNS))
        found[what] = numbers[0] if len(numbers) == 1 else dict(zip(COLUMNS, numbers, strict=True))
    return found


def shown(capsys, command, *arguments, status=0):
    """What a command evaluates, by its table."""
    capsys.readouterr()
    assert command.main([*arguments, "--stats"]) == status
    return rows_of(capsys.readouterr().out)


@pytest.fixture
def watch(monkeypatch):
    """Replace a function wherever it is bound, and count its calls with a wrapper of its own."""

    def put(original, name, count):
        calls = Counter()

        def wrapper(*arguments, **options):
            value = original(*arguments, **options)
            calls.update(count(value, *arguments, **options))
            return value

        places = [m for m in list(sys.modules.values()) if vars(m).get(name) is original]
        assert places
        for place in places:
            monkeypatch.setattr(place, name, wrapper)
        return calls

    return put


# -- counted right, by wrappers --------------------------------------------------------------------

ASKED = {
    "a point": (POINT, 0),
    "an interval": ([*AT, "--phi", "1.11", "1.15"], 0),
    "a sticking phase": ([*AT, "--phi", "4.64"], 0),
    "grazing": ([*AT, "--phi", "1.17", "1.2"], 1),
    "restitution": ([*POINT, "--epsilon", "0.01", "--gamma", "-0.3", "-0.29"], 0),
}
CASES = [
    pytest.param(*case, id=name, marks=[pytest.mark.slow] * (name == "grazing"))
    for name, case in ASKED.items()
]


def _evaluated(value, start, now, order=0):
    """The row and the number of an evaluation of the gap, by its arguments."""
    numbers = [*start[1:4], *now]
    kind = INTERVALS if any(isinstance(x, Interval | Jet) for x in numbers) else FLOATS
    plain = order == 0 and not any(isinstance(x, Jet) for x in numbers)
    return {(GAP if plain else RATES, kind): 1}


@pytest.mark.parametrize("arguments, status", CASES)
def test_the_map_s_evaluations_are_those_that_wrappers_count(arguments, status, watch, capsys):
    rows = shown(capsys, impact, *arguments, status=status)
    calls = watch(equations.gap, "gap", _evaluated)
    slopes = watch(equations.slope, "slope", lambda value, *_, **__: {type(value): 1})
    matrices = watch(
        equations.return_map_derivative, "return_map_derivative", lambda *_, **__: {"": 1}
    )
    assert impact.main(arguments) == status
    for what in (GAP, RATES):
        by_kind = {column: rows[what][column] for column in COLUMNS}
        expected = {column: calls[what, column] for column in (FLOATS, INTERVALS)}
        assert by_kind == {ARRAYS: 0, CHECKER: 0, **expected}
    assert rows.get(SLOPE, {INTERVALS: 0})[INTERVALS] == slopes[Interval]
    assert rows.get(MATRIX, {INTERVALS: 0})[INTERVALS] == matrices[""]
    assert slopes[Interval] + matrices[""] > 0 or status or "4.64" in arguments


def test_other_formulas_are_those_that_wrappers_count(watch, monkeypatch, capsys):
    rows = shown(capsys, single_impact, *AT, "--n", "4")
    calls = watch(single_facts.multiplier, "multiplier", lambda *_, **__: {"": 1})
    assert single_impact.main([*AT, "--n", "4"]) == 0
    assert rows[FORMULAS][INTERVALS] == calls[""] > 0
    for epsilon in ("0", "0.1"):
        rows = shown(capsys, period_doubling, "--epsilon", epsilon)
        components = []
        with monkeypatch.context() as patch:
            plain = Tape.evaluate

            def evaluate(self, roots, numbers, inputs, plain=plain, components=components):
                components.extend(roots)
                return plain(self, roots, numbers, inputs)

            patch.setattr(Tape, "evaluate", evaluate)
            assert period_doubling.main(["--epsilon", epsilon]) == 0
        assert rows[FORMULAS] == {**dict.fromkeys(COLUMNS, 0), INTERVALS: len(components)}
        assert set(rows) <= {FORMULAS, *NUMBERS}
    assert len(components) == 3  # rho_flip, rho_saddle_node and tan psi
    state = COMMANDS[resonance]
    rows = shown(capsys, resonance, *state)
    pairs = watch(equations.arrival, "arrival", lambda value, *_, **__: {"": len(value)})
    assert resonance.main(state) == 0
    assert rows[FORMULAS][INTERVALS] == pairs[""] == 2


def test_bisections_are_one_evaluation_each():
    part = Fraction("1.11"), Fraction("1.12")
    found = first_impact(Flight(System(PAPER.eta, PAPER.nu), part))
    with counted() as counts:
        bisected(found.flight, found.window, 7)
    assert counts[Kind(BISECTIONS)] == counts[Kind(GAP, INTERVALS)] == 14
    with counted() as counts:
        parts = cover_by_impacts(System(PAPER.eta, PAPER.nu), (Fraction("0.5"), Fraction("1.15")))
    assert counts[Kind(BISECTIONS)] == len(parts) - 1 > 0


def test_each_piece_of_a_range_is_asked_for_its_slope_once():
    asked = []

    def slope(low, high):
        asked.append((low, high))
        x = Interval(low, high)
        return 3 * x * x - 1  # of x^3 - x

    with counted() as counts:
        extremes(lambda x: Interval(x) ** 3 - Interval(x), slope, [*map(Fraction, (-1, 0, 1))])
    pieces, halved = counts[Kind(PARTS)], counts[Kind(BISECTIONS)]
    assert pieces == halved + 2 > 2 and len(asked) == len(set(asked)) == pieces + halved


# -- nothing that is not asked for -----------------------------------------------------------------


@pytest.mark.parametrize("arguments, status", CASES)
def test_the_map_takes_no_algebra_no_certificate_and_no_arrays(arguments, status, capsys):
    rows = shown(capsys, impact, *arguments, status=status)
    assert {ALGEBRA, MADE, CHECKED, WORK, GRID, CELLS}.isdisjoint(rows)
    columns = [row for row in rows.values() if isinstance(row, dict)]
    assert all(row[ARRAYS] == row[CHECKER] == row[FLOATS] == 0 for row in columns)
    assert sum(row[INTERVALS] for row in columns) > 100


LOADED = """
import sys
from importlib import import_module

command = import_module(sys.argv[1])
status = command.main(sys.argv[2:])
print(*sorted(sys.modules), file=sys.stderr)
sys.exit(status)
"""


def loaded(command, arguments):
    """The modules that a command has imported at its end."""
    done = subprocess.run(
        [sys.executable, "-c", LOADED, command.__name__, *arguments],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=True,
    )
    return set(done.stderr.split())


@pytest.mark.slow
@pytest.mark.parametrize("command, arguments", QUESTIONS)
def test_without_stats_nothing_of_it_is_there(command, arguments):
    modules = loaded(command, [*arguments, "--json", "-"])
    assert command.__name__ in modules and "proofs.shell.counting" not in modules
    assert "sympy" not in modules
    if command is impact:
        unwanted = {"numpy", "proofs.trusted.certificate", "proofs.check", "proofs.motion.kernel"}
        assert unwanted.isdisjoint(modules)
    assert "proofs.shell.counting" in loaded(command, [*arguments, "--stats"])


@pytest.mark.parametrize("command, arguments", QUESTIONS)
def test_nothing_is_watched_without_stats(command, arguments, capsys, monkeypatch):
    def refuse(function):
        raise AssertionError("watched")

    monkeypatch.setattr(sys, "setprofile", refuse)
    assert command.main(arguments) == 0
    assert "asked: " not in (out := capsys.readouterr()).out + out.err
    with pytest.raises(AssertionError, match="watched"):
        command.main([*arguments, "--stats"])


def test_fewer_digits_take_fewer_evaluations_and_fewer_bits(capsys):
    few, many = (shown(capsys, impact, *POINT, "--digits", digits) for digits in ("30", "300"))
    for what in (GAP, RATES):
        assert 0 < few[what][INTERVALS] < many[what][INTERVALS]
    beyond = NUMBERS[-1]
    assert beyond not in few and many[beyond][INTERVALS] > 0
    assert few[NUMBERS[0]] == many[NUMBERS[0]]  # the first impact is found in 64 bits


def test_one_period_is_less_than_all_and_formulas_alone_need_no_flight(capsys):
    one, all_of_them = (
        shown(capsys, single_impact, *AT, "--n", "4"),
        shown(capsys, single_impact, *AT, "--most", "6"),
    )
    assert one[FORMULAS][INTERVALS] < all_of_them[FORMULAS][INTERVALS]
    for command in (period_doubling, resonance):
        assert {*EQUATIONS, PARTS, BISECTIONS}.isdisjoint(
            shown(capsys, command, *COMMANDS[command])
        )


@pytest.mark.slow
def test_binary64_takes_no_more_bits(capsys):
    fast = shown(capsys, orbits, "--word", "01", "--fast")
    exact = shown(capsys, orbits, "--word", "01", "--digits", "60")
    assert NUMBERS[3] not in fast and exact[NUMBERS[3]][INTERVALS] > 0
    assert fast[GRID] == exact[GRID]  # the horseshoe is proved once, in binary64


# -- on the screen ---------------------------------------------------------------------------------


@pytest.mark.parametrize("command, arguments", QUESTIONS)
def test_the_answer_is_the_same_and_machines_are_spared(command, arguments, capsys):
    answers = []
    for more in ([], ["--stats"]):
        assert command.main([*arguments, "--json", "-", *more]) == 0
        answers.append(capsys.readouterr())
    assert answers[0].out == answers[1].out and answers[0].err == ""
    assert json.loads(answers[1].out)
    rows = rows_of("\n" + answers[1].err.lstrip("\n"))
    assert rows and answers[1].err.startswith("\nasked: ")
    assert rows == shown(capsys, command, *arguments)
    assert sys.getprofile() is None


@pytest.mark.parametrize("command, arguments", QUESTIONS)
def test_help_tells_of_it(command, arguments, capsys):
    with pytest.raises(SystemExit) as leave:
        command.main([*arguments, "--help"])
    assert leave.value.code == 0 and "--stats" in capsys.readouterr().out


@pytest.mark.slow
def test_every_command_beside_the_packages_has_it():
    sources = {path.stem: path.read_text() for path in (ROOT / "proofs").glob("*.py")}
    commands = {name for name, text in sources.items() if '\nif __name__ == "__main__":' in text}
    commands -= {"__main__"}  # the ledger's
    assert {*GROUPS, "horseshoe", "check"} <= commands
    assert {command.__name__.removeprefix("proofs.") for command in COMMANDS} <= commands
    for name in commands:
        ask = [sys.executable, "-m", f"proofs.{name}", "--help"]
        done = subprocess.run(ask, capture_output=True, text=True, cwd=ROOT, check=True)
        assert "--stats" in done.stdout, name


def test_csv_on_the_screen_is_for_machines_too(capsys):
    assert orbits.main(["--word", "01", "--fast", "--csv", "-", "--stats"]) == 0
    out = capsys.readouterr()
    assert out.out.splitlines()[0].startswith("word,period") and len(out.out.splitlines()) == 3
    assert "asked: word 01, binary64\n" in out.err


@pytest.mark.slow
def test_undecided_is_counted_and_bad_input_is_not(capsys):
    assert impact.main([*AT, "--phi", "3.37", "3.39", "--stats"]) == 1
    out = capsys.readouterr()
    assert "sticking begins" in out.err and rows_of(out.out)[NUMBERS[0]][INTERVALS] > 0
    for bad in (["--phi", "7"], ["--phi", "1.57"]):  # outside the circle; no impact at all
        with pytest.raises(SystemExit) as leave:
            impact.main([*AT, *bad, "--stats"])
        out = capsys.readouterr()
        assert leave.value.code == 2 and out.out == "" and out.err.count("\n") == 1
        assert sys.getprofile() is None


def test_the_checker_shows_what_it_evaluates(capsys, tmp_path):
    path = path_of("accepted/horseshoe")
    assert check_command([str(path)]) == 0
    plain = capsys.readouterr()
    assert check_command([str(path), "--stats"]) == 0
    said = capsys.readouterr()
    assert said.out.startswith(plain.out) and "asked: " not in plain.out and said.err == ""
    rows = rows_of(said.out)
    assert rows[CHECKED] == len(json.loads(path.read_text())["steps"]) and rows[WORK] > 0
    columns = [row for row in rows.values() if isinstance(row, dict)]
    assert all(row[column] == 0 for row in columns for column in (FLOATS, INTERVALS, ARRAYS))
    assert rows[GAP][CHECKER] > 0 and {ALGEBRA, MADE, PARTS, CELLS}.isdisjoint(rows)
    (tmp_path / "bad.json").write_text("{")
    assert check_command([str(tmp_path / "bad.json"), "--stats"]) == 2
    assert capsys.readouterr().out == ""


def test_counts_need_a_wish():
    with counting(False) as none:
        equations.gap(equations.launch(-1, 0.2, -0.2, 1.0), equations.clock(0.2, 1.0))
    with counting(True) as one:
        equations.gap(equations.launch(-1, 0.2, -0.2, 1.0), equations.clock(0.2, 1.0))
    assert not none and one[Kind(GAP, FLOATS)] == 1
