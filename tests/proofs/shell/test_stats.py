"""--stats, and what it shows: nothing is evaluated that the claims asked for do not need."""

import inspect
import json
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from intervals import Interval, IntervalArray, Jet
from proofs import horseshoe
from proofs.motion.kernel import float_clock, float_launch
from proofs.motion.system import System
from proofs.shell import cli, counting, groups, ledger, runner
from proofs.shell.counting import (
    ALGEBRA,
    ARRAYS,
    BISECTIONS,
    CELLS,
    CHECKED,
    CHECKER,
    EQUATIONS,
    FLOATS,
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
from proofs.trusted.equations import clock, gap, launch, slope
from proofs.trusted.kernel.arithmetic import Dual, rational
from proofs.trusted.paper.s2_foundations.relations import DERIVATIONS as BASIC
from proofs.trusted.paper.s5_soft.soft import DERIVATIONS as SOFT
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, check

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
SYSTEM = System(PAPER.eta, PAPER.nu)
PROVER = (FLOATS, INTERVALS, ARRAYS)


def proved(group, *claims, of=PAPER):
    """Prove claims; return the certificate and what that evaluated."""
    produce = horseshoe.produce if group == "horseshoe" else partial(groups.produce, group)
    with counted() as counts:
        made = produce(of, claims, digits=30)
    return made.certificate, counts


def by(counts, what):
    return sum(number for kind, number in counts.items() if kind.what == what)


# -- counted right ---------------------------------------------------------------------------------


def numbers_of_each_kind():
    """(column, boxes, a jet or not, launch, clock)"""

    def case(column, boxes, jet, eta, nu, phi, t):
        return column, boxes, jet, launch(-1, eta, nu, phi), clock(eta, t)

    exact = [Fraction(x) for x in ("2121/10000", "-1/5", "6/5", "25")]
    intervals = [Interval(x) for x in exact]
    phases = IntervalArray.from_floats([1.1, 1.2, 1.3])
    yield case(FLOATS, 1, False, *map(float, exact))
    start, times = float_launch(SYSTEM, np.linspace(1.1, 1.3, 4)), np.full(4, 25.0)
    yield FLOATS, 4, False, start, float_clock(SYSTEM, times)
    yield case(INTERVALS, 1, False, *intervals)
    times = IntervalArray.from_floats([24.0, 25.0, 26.0])
    yield case(ARRAYS, 3, False, *intervals[:2], phases, times)
    jets = *intervals[:2], Jet.variable(intervals[2]), intervals[3]
    yield case(INTERVALS, 1, True, *jets)
    mine = [rational(x, 80) for x in exact]
    yield case(CHECKER, 1, False, *mine)
    one = rational(Fraction(1), 80)
    yield case(CHECKER, 1, True, *mine[:2], Dual(mine[2], one), mine[3])


@pytest.mark.parametrize("column, boxes, jet, start, now", [*numbers_of_each_kind()])
def test_each_evaluation_counts_once_for_each_box(column, boxes, jet, start, now):
    with counted() as counts:
        for order in (0, 0, 0, 1, 2):
            gap(start, now, order)
    plain = 0 if jet else 3
    expected = {GAP: plain * boxes, RATES: (5 - plain) * boxes}
    assert {what: counts[Kind(what, column)] for what in expected} == expected
    assert evaluations(counts) == evaluations(counts, column) == 5 * boxes
    with counted() as counts:
        slope(start, now)
    # f' = (sin(eta t) / eta) gap''(0) / gap'(t)
    assert counts[Kind(SECOND if jet else SLOPE, column)] == boxes
    assert by(counts, SLOPE) + by(counts, SECOND) == boxes and by(counts, RATES) >= 1 + boxes


def test_numbers_count_by_their_bits():
    x = {bits: Interval("1/3", precision=bits) for bits in (53, 64, 65, 200, 3000)}
    with counted() as counts:
        for bits, times in ((53, 1), (64, 2), (65, 3), (200, 4), (3000, 5)):
            for _ in range(times):
                x[bits] + x[bits]
    found = [counts[Kind(what, INTERVALS)] for what in NUMBERS]
    assert found == [3, 3, 4, 0, 0, 5]
    boxes = IntervalArray.from_floats(np.ones(7))
    with counted() as counts:
        boxes + boxes
    assert counts == {Kind(NUMBERS[0], ARRAYS): 7}


def codes(code):
    yield code
    for inner in code.co_consts:
        if inspect.iscode(inner):
            yield from codes(inner)


@pytest.mark.parametrize("name", counting._RULES)
def test_every_function_counted_exists(name):
    """Counts are by name: who renames a function must rename it here."""
    parts = name.split(".")
    first = next(i for i, part in enumerate(parts) if not part.islower() or i == len(parts) - 1)
    while True:
        try:
            module = import_module(".".join(parts[:first]))
            break
        except ModuleNotFoundError:
            first -= 1
    outer, *_ = inner = parts[first:]
    found = getattr(module, outer)
    if inspect.isclass(found):
        found = vars(found)[inner[1]]
    assert ".".join(inner) in {code.co_qualname for code in codes(found.__code__)}


def test_counting_changes_nothing_and_ends():
    plain = horseshoe.produce(PAPER, ("H1",), digits=20).certificate
    with counted() as counts:
        assert horseshoe.produce(PAPER, ("H1",), digits=20).certificate == plain
    assert evaluations(counts) and sys.getprofile() is None
    so_far = counts.copy()
    check(plain)
    assert counts == so_far
    with pytest.raises(KeyError), counted():
        raise KeyError
    assert sys.getprofile() is None


def test_nothing_is_watched_unless_that_is_wanted():
    with cli.counting(False) as counts:
        assert sys.getprofile() is None
        gap(launch(-1, 0.2, -0.2, 1.0), clock(0.2, 1.0))
    assert not counts


def test_without_stats_this_is_not_even_imported(tmp_path):
    code = "import sys; from proofs import horseshoe as h; h.main(sys.argv[1:]); "
    code += "sys.exit('proofs.shell.counting' in sys.modules)"
    ask = [sys.executable, "-c", code, "--only", "H16", "--out", str(tmp_path)]
    for more, imported in (([], 0), (["--stats"], 1)):
        done = subprocess.run(ask + more, capture_output=True, text=True, cwd=ROOT, check=False)
        assert done.returncode == imported, done.stderr
        assert ("asked: H16" in done.stdout) is bool(imported)


def test_a_profiler_that_was_there_is_there_again():
    def other(frame, event, value):
        pass

    sys.setprofile(other)
    try:
        with counted():
            assert sys.getprofile() is not other
        assert sys.getprofile() is other
    finally:
        sys.setprofile(None)


# -- nothing that is not asked for -----------------------------------------------------------------


@pytest.mark.parametrize(
    "group, claim",
    [("horseshoe", "H16"), ("horseshoe", "H11"), ("persistence", "G8"), ("foundations", "A2")]
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


def test_one_claim_is_less_than_two_and_shared_steps_are_made_once():
    one, other, both = (
        evaluations(proved("horseshoe", *claims)[1], INTERVALS)
        for claims in (("H1",), ("H4",), ("H1", "H4"))
    )
    assert 0 < max(one, other) < both <= one + other
    again = evaluations(proved("horseshoe", "H1", "H3", "H6", "H11", "H16")[1], INTERVALS)
    assert again == one


def test_restitution_and_the_plastic_map_do_not_need_each_other():
    _, counts = proved("horseshoe", "N2")
    assert counts[Kind(MATRIX, INTERVALS)] > 0 == by(counts, SLOPE) + by(counts, SECOND)
    _, counts = proved("horseshoe", "H2")
    assert by(counts, MATRIX) == 0 < by(counts, SLOPE)


@pytest.mark.parametrize("claim", ["G1", "G2"])
def test_the_orbit_through_the_sticking_arc_takes_no_cells(claim):
    text, counts = proved("circle", claim)
    assert by(counts, CELLS) == by(counts, BISECTIONS) == by(counts, SLOPE) == 0
    assert 0 < evaluations(counts) < 200 and by(counts, MADE) == 1
    assert [step["rule"] for step in json.loads(text)["steps"].values()] == ["separation"]


@pytest.mark.parametrize(
    "group, derivations, claim",
    [
        ("foundations", BASIC, "M4"),
        pytest.param("soft", SOFT, "S21", marks=pytest.mark.slow),
    ],
)
def test_a_formula_asks_for_its_own_lemmas(group, derivations, claim):
    lemmas = {each.id: set(each.lemmas) for each in derivations}
    _, counts = proved(group, claim)
    assert by(counts, ALGEBRA) == len(lemmas[claim]) < len(set().union(*lemmas.values()))
    assert evaluations(counts) == 0


# -- nothing again ---------------------------------------------------------------------------------

KEPT = {"horseshoe": ("H1", "H11"), "sets": ("H14",), "foundations": ("M4", "A2")}


def settled(folder, name, fresh=False):
    (job,) = ledger.jobs(KEPT[name], folder, 30, fresh, stats=True)
    found = ledger.settle_counting(job)
    if found.page is not None:
        (folder / f"{job.name}.json").write_text(found.certificate)
    return found


@pytest.mark.parametrize("name", KEPT)
def test_a_certificate_that_is_there_is_checked_and_not_proved(tmp_path, name):
    first = settled(tmp_path, name)
    assert by(first.counts, MADE) > 0 and first.page is not None
    second = settled(tmp_path, name)
    assert second.page is None and second.certificate == first.certificate
    assert {kind.by for kind in +second.counts} <= {CHECKER, ""}
    assert evaluations(second.counts, *PROVER) == 0
    for what in (MADE, ALGEBRA, PARTS, BISECTIONS, CELLS):
        assert by(second.counts, what) == 0, what
    assert by(second.counts, CHECKED) == len(json.loads(first.certificate)["steps"])
    for what in (CHECKED, WORK):
        assert by(second.counts, what) == by(first.counts, what) > 0
    third = settled(tmp_path, name, fresh=True)
    assert third.certificate == first.certificate
    for what in (*EQUATIONS, MADE, ALGEBRA):
        assert by(third.counts, what) == by(first.counts, what)


def test_another_number_in_the_file_has_it_proved_again(tmp_path):
    first = settled(tmp_path, "horseshoe")
    path = tmp_path / "horseshoe.json"
    for old, new in (('"2121/10000"', '"2122/10000"'), ('"2121/10000"', '"1061/5000"')):
        path.write_text(first.certificate.replace(old, new, 1))
        again = settled(tmp_path, "horseshoe")
        assert by(again.counts, MADE) == by(first.counts, MADE) > 0
        assert path.read_text() == again.certificate == first.certificate


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


def test_another_equation_has_it_proved_again(tmp_path, monkeypatch):
    """Prover and checker share the equations, so that what is proved then is about the new ones."""
    first = settled(tmp_path, "horseshoe")
    monkeypatch.setattr(equations.gap, "__code__", changed_gap())
    with pytest.raises(Rejected):
        check(first.certificate)
    again = settled(tmp_path, "horseshoe")
    assert again.page is not None and by(again.counts, MADE) > 0
    assert by(again.counts, CHECKED) > by(again.counts, MADE)  # one of the old ones, all new ones
    assert settled(tmp_path, "horseshoe").page is None
    monkeypatch.undo()
    with pytest.raises(Rejected):
        check(again.certificate)
    expected, _ = proved("horseshoe", "H1", of=replace(PAPER, nu=PAPER.nu * 99 / 100))
    for name, bounds in json.loads(expected)["claims"][0]["quantities"].items():
        found = json.loads(again.certificate)["claims"][0]["quantities"][name]
        assert Fraction(found["lower"]) <= Fraction(bounds["upper"])
        assert Fraction(bounds["lower"]) <= Fraction(found["upper"])


# -- on the screen ---------------------------------------------------------------------------------


def rows_of(text):
    """The rows of a table: what, numbers."""
    found = {}
    for line in text.splitlines():
        what = next((row for row in ROWS if line.startswith(row + "  ")), None)
        if what is not None:
            numbers = filter(None, line[len(what) :].split("  "))
            found[what] = [int(number.replace(" ", "")) for number in numbers]
    return found


def test_a_table_of_what_there_is():
    counts = counting.Counts({Kind(GAP, FLOATS): 12, Kind(GAP, CHECKER): 3456789, Kind(WORK): 7})
    lines = table(counts, ["H1", "N1"]).splitlines()
    assert lines[0] == "asked: H1 N1" and len(lines) == 4
    assert lines[1].split() == ["evaluated", *counting.COLUMNS]
    assert lines[2].split("  ")[-1].strip() == "3 456 789" and lines[3].split()[-1] == "7"
    assert rows_of("\n".join(lines)) == {GAP: [12, 0, 0, 3456789], WORK: [7]}


def test_the_commands_show_it(tmp_path, capsys):
    ask = ["--only", "H1", "--out", str(tmp_path)]
    assert horseshoe.main([*ask, "--stats"]) == 0
    shown = capsys.readouterr()
    results, _, stats = shown.out.partition("asked: ")
    assert "checker: accepted" in results and stats.startswith("H1\n") and not shown.err
    rows = rows_of(stats)
    assert all(rows[GAP][i] > 0 for i in (0, 1, 3)) and rows[CHECKED] == rows[MADE]
    assert horseshoe.main([*ask, "--stats", "--no-check"]) == 0
    assert {CHECKED, WORK}.isdisjoint(unchecked := rows_of(capsys.readouterr().out))
    assert unchecked[GAP] == [*rows[GAP][:3], 0]
    assert horseshoe.main([*ask, "--stats", "--json", "-"]) == 0
    shown = capsys.readouterr()
    assert shown.out == (tmp_path / "horseshoe.json").read_text()
    assert rows_of(shown.err) == rows
    assert runner.run("sets", ["--only", "H15", "--out", str(tmp_path), "--stats"]) == 0
    assert "asked: H15\n" in capsys.readouterr().out
    assert runner.run("sets", ["--only", "H15", "--out", str(tmp_path)]) == 0
    assert "asked: " not in capsys.readouterr().out


def test_the_ledger_shows_it_of_each_file(tmp_path, capsys):
    """The work is done in other processes; their counts come back."""
    ask = ["--only", "H1", "H15", "--out", str(tmp_path), "--stats"]
    assert ledger.main(ask) == 0
    first, second = (rows_of(part) for part in capsys.readouterr().out.split("asked: ")[1:])
    assert first[GAP][1] > 0 and first[MADE] == first[CHECKED]
    assert not set(EQUATIONS) & set(second)
    assert ledger.main([*ask, "--json", "-"]) == 0
    shown = capsys.readouterr()
    assert json.loads(shown.out)["claims"]
    again = [rows_of(part) for part in shown.err.split("asked: ")[1:]]
    assert again[0][GAP] == [0, 0, 0, first[GAP][3]] and MADE not in again[0]
