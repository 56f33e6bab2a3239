"""--stats, and what it shows: nothing is evaluated that what is asked for does not need."""

import inspect
import json
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path

import pytest

from proofs import horseshoe, impact, orbits, period_doubling, resonance, single_impact
from proofs.check import main as check_command
from proofs.shell import counting, groups, ledger
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
    INTERVALS,
    MADE,
    MATRIX,
    NUMBERS,
    PARTS,
    RATES,
    ROWS,
    SECOND,
    SLOPE,
    WORK,
    Kind,
    counted,
    evaluations,
    table,
)
from proofs.trusted import equations
from proofs.trusted.paper import GROUPS, s2_foundations
from proofs.trusted.paper.formulas import Asked, Unknowns
from proofs.trusted.paper.s5_soft import stability
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, check

ROOT = Path(__file__).parents[3]
PROVER = (FLOATS, INTERVALS, ARRAYS)
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


def proved(group, *claims, of=PAPER):
    """Prove claims; return the certificate and what that evaluated."""
    with counted() as counts:
        made = groups.produce(groups.wanted(group, of, claims), of, digits=30)
    return made.certificate, counts


def by(counts, what):
    return sum(number for kind, number in counts.items() if kind.what == what)


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


# -- nothing that is not asked for -----------------------------------------------------------------


@pytest.mark.parametrize(
    "group, claim",
    [("horseshoe", "H16"), ("horseshoe", "H11"), ("foundations", "A2")]
    + [("sets", claim) for claim in ("H12", "H14", "H15", "H17")],
)
def test_no_flight_where_the_claim_is_about_none(group, claim):
    text, counts = proved(group, claim)
    assert evaluations(counts) == by(counts, PARTS) == by(counts, BISECTIONS) == 0
    assert by(counts, ALGEBRA) == 0
    with counted() as checking:
        check(text)
    assert evaluations(checking) == 0


def test_nothing_at_all_for_a_claim_that_exact_numbers_decide():
    _, counts = proved("horseshoe", "H16")
    assert not +counts
    assert table(counts, ["H16"]).splitlines()[2:] == ["nothing"]


def test_the_gap_alone_has_no_slopes_and_slopes_no_second_derivative_at_points():
    text, counts = proved("horseshoe", "H4")
    assert counts[Kind(SLOPE, INTERVALS)] == counts[Kind(SECOND, INTERVALS)] == 0
    assert {step["rule"] for step in json.loads(text)["steps"].values()} == {
        "first-impact",
        "avoids",
    }
    _, counts = proved("horseshoe", "H1")
    assert counts[Kind(SECOND, INTERVALS)] <= counts[Kind(SLOPE, INTERVALS)] <= 10
    assert by(counts, MATRIX) == 0


@pytest.mark.slow
def test_one_claim_is_less_than_two_and_shared_steps_are_made_once():
    one, other, both = (
        evaluations(proved("horseshoe", *claims)[1], CHECKER)
        for claims in (("H1",), ("H4",), ("H1", "H4"))
    )
    assert 0 < max(one, other) < both <= one + other
    again = evaluations(proved("horseshoe", "H1", "H3", "H6", "H11", "H16")[1], CHECKER)
    assert again == one


@pytest.mark.slow
def test_restitution_and_the_plastic_map_do_not_need_each_other():
    _, counts = proved("horseshoe", "N2")
    assert counts[Kind(MATRIX, CHECKER)] > 0 == by(counts, SLOPE) + by(counts, SECOND)
    _, counts = proved("horseshoe", "H2")
    assert by(counts, MATRIX) == 0 < by(counts, SLOPE)


@pytest.mark.parametrize("claim", ["G1", "G2"])
def test_the_orbit_through_the_sticking_arc_takes_no_cells(claim):
    text, counts = proved("circle", claim)
    assert by(counts, CELLS) == by(counts, BISECTIONS) == by(counts, SLOPE) == 0
    assert 0 < evaluations(counts) < 200 and by(counts, MADE) == 1
    assert [step["rule"] for step in json.loads(text)["steps"].values()] == ["separation"]


@pytest.mark.parametrize(
    "group, rows, claim",
    [
        ("foundations", s2_foundations.ROWS, "M4"),
        pytest.param("soft", stability.ROWS, "S21", marks=pytest.mark.slow),
    ],
)
def test_a_formula_asks_for_its_own_lemmas(group, rows, claim):
    other = (Asked, Unknowns)
    lemmas = {row.id: {x for x in row.needs if not isinstance(x, other)} for row in rows}
    with counted() as counts:
        found = import_module(f"proofs.search.{groups.PROVERS[group]}").prove(PAPER, [claim])
    proved_ones = [
        x for x in found.steps.values() if x["rule"] in ("formula-equal", "formula-series")
    ]
    assert len(proved_ones) == len(lemmas[claim]) < len(set().union(*lemmas.values()))
    assert evaluations(counts) == 0


LOADED = """
import sys
from importlib import import_module

status = import_module(sys.argv[1]).main(sys.argv[2:])
print(*sorted(sys.modules), file=sys.stderr)
sys.exit(status)
"""


@pytest.mark.slow
@pytest.mark.parametrize("command, arguments", QUESTIONS)
def test_without_stats_nothing_of_it_is_there(command, arguments):
    ask = [sys.executable, "-c", LOADED, command.__name__, *arguments, "--json", "-"]
    done = subprocess.run(ask, capture_output=True, text=True, cwd=ROOT, check=True)
    modules = set(done.stderr.split())
    assert command.__name__ in modules
    assert {"sympy", "proofs.shell.counting"}.isdisjoint(modules)
    if command is impact:
        unwanted = {"numpy", "mpmath", "proofs.check", "proofs.motion.kernel"}
        assert unwanted.isdisjoint(modules)


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
        assert 0 < few[what][CHECKER] <= many[what][CHECKER]
    beyond = NUMBERS[-1]
    assert beyond not in few and many[beyond][CHECKER] > 0
    assert few[NUMBERS[0]] == many[NUMBERS[0]]  # the first impact is proved in 64 bits


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
    assert fast[GAP][CHECKER] == exact[GAP][CHECKER]  # the horseshoe is proved once


# -- nothing again ---------------------------------------------------------------------------------

KEPT = {"horseshoe": ("H1", "H11"), "sets": ("H14",), "foundations": ("M4", "A2")}


def settled(folder, name, fresh=False):
    (job,) = ledger.jobs(KEPT[name], folder, 30, fresh, stats=True)
    found = ledger.settle_counting(job)
    (folder / f"{job.name}.json").write_text(found.made.certificate)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", KEPT)
def test_a_certificate_that_is_there_is_checked_and_not_proved(tmp_path, name):
    first = settled(tmp_path, name)
    assert by(first.counts, MADE) > 0 and first.is_new
    second = settled(tmp_path, name)
    assert not second.is_new and second.made.certificate == first.made.certificate
    assert {kind.by for kind in +second.counts} <= {CHECKER, ""}
    assert evaluations(second.counts, *PROVER) == 0
    for what in (MADE, ALGEBRA, PARTS, BISECTIONS, CELLS):
        assert by(second.counts, what) == 0, what
    assert by(second.counts, CHECKED) == len(json.loads(first.made.certificate)["steps"])
    for what in (CHECKED, WORK):
        assert by(second.counts, what) == by(first.counts, what) > 0
    third = settled(tmp_path, name, fresh=True)
    assert third.made.certificate == first.made.certificate
    for what in (*EQUATIONS, MADE, ALGEBRA):
        assert by(third.counts, what) == by(first.counts, what)


@pytest.mark.slow
def test_a_good_certificate_about_other_numbers_is_none_here(tmp_path):
    other, _ = proved("horseshoe", *KEPT["horseshoe"], of=replace(PAPER, eta=Fraction(212, 1000)))
    assert not check(other).is_paper
    (tmp_path / "horseshoe.json").write_text(other)
    again = settled(tmp_path, "horseshoe")
    assert by(again.counts, MADE) > 0 and again.report.is_paper


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
    first = settled(tmp_path, "horseshoe")
    monkeypatch.setattr(equations.gap, "__code__", changed_gap())
    with pytest.raises(Rejected):
        check(first.made.certificate)
    again = settled(tmp_path, "horseshoe")
    assert again.is_new and by(again.counts, MADE) > 0
    assert by(again.counts, CHECKED) > by(again.counts, MADE)  # one of the old ones, all new ones
    assert not settled(tmp_path, "horseshoe").is_new
    monkeypatch.undo()
    with pytest.raises(Rejected):
        check(again.made.certificate)
    expected, _ = proved("horseshoe", "H1", of=replace(PAPER, nu=PAPER.nu * 99 / 100))
    for name, bounds in json.loads(expected)["claims"][0]["quantities"].items():
        found = json.loads(again.made.certificate)["claims"][0]["quantities"][name]
        assert Fraction(found["lower"]) <= Fraction(bounds["upper"])
        assert Fraction(bounds["lower"]) <= Fraction(found["upper"])


# -- on the screen ---------------------------------------------------------------------------------


def test_a_table_of_what_there_is():
    counts = counting.Counts({Kind(GAP, FLOATS): 12, Kind(GAP, CHECKER): 3456789, Kind(WORK): 7})
    lines = table(counts, ["H1", "N1"]).splitlines()
    assert lines[0] == "asked: H1 N1" and len(lines) == 4
    assert lines[1].split() == ["evaluated", *counting.COLUMNS]
    assert lines[2].split("  ")[-1].strip() == "3 456 789" and lines[3].split()[-1] == "7"
    expected = {FLOATS: 12, INTERVALS: 0, ARRAYS: 0, CHECKER: 3456789}
    assert rows_of("\n" + "\n".join(lines)) == {GAP: expected, WORK: 7}


@pytest.mark.slow
def test_the_commands_show_it(tmp_path, capsys):
    ask = ["--only", "H1", "--out", str(tmp_path)]
    assert horseshoe.main([*ask, "--stats"]) == 0
    said = capsys.readouterr()
    assert "checker: accepted" in said.out and "\nasked: H1\n" in said.out and not said.err
    rows = rows_of(said.out)
    assert rows[GAP][FLOATS] > rows[GAP][CHECKER] > rows[GAP][INTERVALS] == 0
    assert rows[CHECKED] == rows[MADE] > 0
    unchecked = shown(capsys, horseshoe, *ask, "--no-check")
    assert {CHECKED, WORK}.isdisjoint(unchecked)
    assert 0 < unchecked[GAP][CHECKER] < rows[GAP][CHECKER]  # by the same rules
    assert {**unchecked[GAP], CHECKER: 0} == {**rows[GAP], CHECKER: 0}
    assert horseshoe.main([*ask, "--stats", "--json", "-"]) == 0
    said = capsys.readouterr()
    assert said.out == (tmp_path / "horseshoe.json").read_text()
    assert rows_of(said.err) == rows


@pytest.mark.slow
def test_the_ledger_shows_it_of_each_file(tmp_path, capsys):
    """The work is done in other processes; their counts come back."""
    ask = ["--only", "H1", "H15", "--out", str(tmp_path), "--stats"]

    def tables(text):
        return [rows_of("\nasked: " + part) for part in text.split("\nasked: ")[1:]]

    assert ledger.main(ask) == 0
    first, second = tables(capsys.readouterr().out)
    assert first[GAP][FLOATS] > 0 and first[MADE] == first[CHECKED]
    assert not set(EQUATIONS) & set(second)
    assert ledger.main([*ask, "--json", "-"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out)["claims"]
    again = tables(said.err)[0]
    assert 0 < again[GAP][CHECKER] < first[GAP][CHECKER]
    assert {**again[GAP], CHECKER: 0} == dict.fromkeys((*PROVER, CHECKER), 0)
    assert MADE not in again


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


@pytest.mark.slow
def test_every_command_beside_the_packages_has_it(capsys):
    sources = {path.stem: path.read_text() for path in (ROOT / "proofs").glob("*.py")}
    commands = {name for name, text in sources.items() if '\nif __name__ == "__main__":' in text}
    commands -= {"__main__", "atlas"}  # the list of them; what proves in other processes
    assert {*GROUPS, "horseshoe", "check"} <= commands
    assert {command.__name__.removeprefix("proofs.") for command in COMMANDS} <= commands
    for name in commands:
        with pytest.raises(SystemExit):
            import_module(f"proofs.{name}").main(["--help"])
        assert "--stats" in capsys.readouterr().out, name


@pytest.mark.slow
def test_undecided_is_counted_and_bad_input_is_not(capsys):
    assert impact.main([*AT, "--phi", "3.37", "3.39", "--stats"]) == 1
    out = capsys.readouterr()
    assert "sticking begins" in out.err and rows_of(out.out)[NUMBERS[0]][CHECKER] > 0
    with pytest.raises(SystemExit) as leave:
        impact.main([*AT, "--phi", "7", "--stats"])  # outside the circle
    out = capsys.readouterr()
    assert leave.value.code == 2 and out.out == "" and out.err.count("\n") == 1
    assert sys.getprofile() is None


def test_the_checker_shows_what_it_evaluates(capsys, tmp_path):
    path = tmp_path / "horseshoe.json"
    path.write_text(proved("horseshoe", "H1")[0])
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
