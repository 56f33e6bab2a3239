"""Work-precision curves: fits, sweeps, the work itself against other arithmetics, diagrams."""

import json
import math
import re
import sys
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from intervals import Undecided
from proofs.benchmark import codac_server, curves, horseshoe, peers, slopes, tasks
from proofs.benchmark.__main__ import main
from proofs.benchmark.curves import Budget, Curve, Point
from proofs.benchmark.diagrams import Diagram, of_peer, svg
from proofs.benchmark.peers import CODAC, FLINT, IV, OURS, PEERS, arithmetic
from proofs.trusted.equations import clock, gap, launch

DOMAINS = tasks.DOMAINS


def curve_of(errors, **options):
    points = [Point(2.0**k, error, [1.0]) for k, error in enumerate(errors)]
    return Curve("work", "way", "boxes", points=points, **{"against": "error", **options})


# -- curves ----------------------------------------------------------------------------------------


def test_a_fit_uses_the_last_four_points_above_the_floor():
    errors = [5.0, 5.0, 1.0, 0.25, 2.0**-4, 2.0**-6, 1e-12, 1e-12]
    assert curve_of(errors, floor=1e-14).order() == pytest.approx(-2.0)
    assert curve_of(errors[:2]).order() is None
    assert curve_of([1.0, None, 0.5, None, 0.25]).order() == pytest.approx(-0.5)
    points = [Point(d, 10.0**-d, [d**1.5, 99.0, d**1.5]) for d in (10.0, 20.0, 40.0)]
    timed = Curve("work", "way", "digits", points=points)
    assert timed.order() == pytest.approx(1.5) and "time ~ digits^1.50" in timed.row().measured


def test_rows_judge_orders_and_enclosures():
    good = curve_of([1.0, 0.25, 2.0**-4], least=1.8).row()
    assert good.reached and "error ~ boxes^-2.00" in good.measured
    assert curve_of([1.0, 0.5, 0.25], least=1.8).row().reached is False
    assert curve_of([1.0, 0.5], least=1.8).row().reached is None
    wrong = curve_of([1.0, -1e-9, 2.0**-4])
    assert wrong.row().reached is False and "NOT AN ENCLOSURE" in wrong.row().measured
    wrong.proved = False
    assert wrong.row().reached is None
    missed = curve_of([1e-3, 31.0, 1e-9], proved=False, against="")
    assert "boxes 2: 3.1e+01" in missed.row().measured  # the worst of what is not proved


@pytest.fixture
def passing(monkeypatch):
    """Time that passes only where a task says so."""
    now = [0.0]
    monkeypatch.setattr(curves, "perf_counter", lambda: now[0])
    monkeypatch.setattr("proofs.benchmark.measure.perf_counter", lambda: now[0])
    return now


def way(passing, calls, name, seconds, sizes=(1, 4, 16, 64)):
    def run(size):
        if seconds(size) is None:
            raise Undecided("too wide")
        calls.append(name)
        passing[0] += seconds(size)
        return 1 / size

    return Curve("work", name, "boxes", sizes, run)


def test_ways_are_measured_in_turn_and_undecided_ones_are_kept(passing):
    calls = []
    first = way(passing, calls, "a", lambda n: None if n == 1 else 0.01, (1, 2))
    second = way(passing, calls, "b", lambda n: 0.02, (1, 2))
    curves.sweep([first, second], Budget(2, 0.1))
    assert first.points[0] == Point(1, None, [], "too wide")
    assert second.points[1].seconds == pytest.approx([0.02] * 3)
    assert "".join(calls) == "bbbb" + "aabb" + "abab"


def test_slow_ways_are_not_repeated_and_leave_if_they_grow(passing):
    growing, faster, flat, long = (
        way(passing, [], "", seconds)
        for seconds in (lambda n: 0.04 * n, lambda n: 0.002 * n**2, lambda n: 0.2, lambda n: 1.1)
    )
    curves.sweep([growing, faster, flat, long], Budget(3, 0.1))
    lengths = [
        [len(point.seconds) for point in one.points] for one in (growing, faster, flat, long)
    ]
    assert lengths == [[4, 4], [4, 4, 1], [4, 4, 4, 4], [1]]


def test_ratios_are_of_pairs_at_the_largest_common_size():
    own = [Point(1, 1.0, [9.0]), Point(4, 1.0, [2.0, 4.0])]
    theirs = [Point(1, 1.0, [9.0]), Point(4, 1.0, [6.0, 20.0]), Point(9, 1.0, [1.0])]
    ways = {"ours": own, FLINT: theirs, IV: theirs[2:], "another": theirs}
    some = [Curve("w", f"form, {name}", "boxes", points=ways[name]) for name in ways]
    (row,) = curves.beside(some)
    assert row.samples["ratios"] == [3.0, 5.0] and FLINT in row.name


# -- the slopes ------------------------------------------------------------------------------------


def test_the_series_of_the_slope_is_that_of_the_truth_nearby():
    of, phase, step = arithmetic(OURS, 300), Fraction("1.12"), Fraction(1, 2**20)
    phi = of.point(phase)
    about = float(tasks.truth(phase).flight[0])
    found = slopes.coefficients(of, phi, slopes.thin_time(of, phi, about), 4)
    assert abs(found[0].mid - tasks.truth(phase).slope[0]) < Fraction(1, 10**80)
    beside = tasks.truth(phase + step).slope[0]
    value, bound = sum(c.mid * step**k for k, c in enumerate(found)), 10**6 * step**5
    assert abs(value - beside) < bound
    for k in (1, 2, 3, 4):  # without any of the terms it is not
        assert abs(value - found[k].mid * step**k - beside) > bound


def test_the_truth_is_that_of_another_transcription():
    flint = pytest.importorskip("flint")
    from proofs.benchmark import flint_job

    for phase in tasks.PHASES:
        known, (image, slope) = tasks.truth(phase), flint_job.at(phase)
        flight = image - flint.arb(phase.numerator) / phase.denominator
        assert abs(float(slope.mid()) - float(known.slope[0])) < 1e-10
        assert abs(float(flight.mid()) - float(known.flight[0])) < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("order", [slopes.MONOTONE, 0, 1, 2, 3, 4])
def test_all_arithmetics_do_the_same_work(order):
    losses = [
        tasks.by_library(name, order, digits, 4)
        for name in peers.libraries()
        for digits in (None, 30)
    ]
    if order == slopes.MONOTONE:
        assert all(0 <= lost < 1e-10 for lost in losses)
        assert all(lost < 1e-24 for lost in losses[1::2])
        return
    assert all(lost > 0 for lost in losses)
    assert max(losses) < 1.1 * min(losses)


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("end", [0, 1])
def test_bounds_within_the_truth_have_a_negative_loss(side, end):
    bounds = [[tasks.truth(phase).slope[0] for phase in domain] for domain in DOMAINS]
    assert abs(tasks.loss(bounds)) < 1e-300
    bounds[side][end] += (1 - 2 * end) * Fraction(1, 10**12)
    bounds[1 - side][1 - end] -= (2 * end - 1) * Fraction(1, 1000)
    assert -1.1e-12 < tasks.loss(bounds) < -0.9e-12


@pytest.mark.parametrize("library", [OURS, IV])
def test_a_wrong_bracket_or_grid_is_not_proved(library):
    of, work = arithmetic(library, 53), tasks.works(4)[1]
    slopes.bounds(of, of, work, 0)
    moved = [(low + 0.5, high + 0.5) for low, high in work.brackets]
    early = [(low - 0.01, low - 0.001) for low, high in work.brackets]
    impact = work.brackets[-1][1]
    rising = [time for time in work.grid if time < impact - 4]  # then gap' > 0 at first
    for change in ({"brackets": moved}, {"brackets": early}, {"grid": rising}):
        with pytest.raises(Undecided):
            slopes.bounds(of, of, replace(work, **change), 0)
    boxes = [of.number(*pair) for pair in pairwise(work.cuts)]
    slopes.exclude(of, boxes, work.grid)
    beyond = [*work.grid, impact + 3]  # the gap is positive again
    for grid in ([*work.grid, impact + 0.1], beyond, work.grid[-1:]):
        with pytest.raises(Undecided):
            slopes.exclude(of, boxes, grid)


def test_where_the_mass_leaves_the_table_there_is_no_impact_time():
    start, low, high = launch(-1, 0.2121, -0.2, 1.11), 26.0, 27.5
    while low < (middle := (low + high) / 2) < high:  # the next zero of the gap, upward
        rising = gap(start, clock(0.2121, middle)) < 0
        low, high = (middle, high) if rising else (low, middle)
    of = arithmetic(OURS, 100)
    impact = float(tasks.truth(Fraction("1.11")).flight[0])
    assert slopes.thin_time(of, of.point(Fraction("1.11")), impact).wid < 1e-20
    with pytest.raises(Undecided):
        slopes.thin_time(of, of.point(Fraction("1.11")), low)


def test_monotonicity_is_proved_and_not_taken_for_granted():
    work, of = tasks.work((Fraction(3), Fraction("3.01")), 8), arithmetic(OURS, 53)
    slopes.bounds(of, of, work, 1)
    with pytest.raises(Undecided, match="f'' > 0"):  # it changes its sign there
        slopes.bounds(of, of, work, slopes.MONOTONE)


FAKE = """
from fractions import Fraction
import intervals
class Interval:
    def __init__(self, x):
        self.x = x if isinstance(x, intervals.Interval) else intervals.Interval(Fraction(x))
    def _with(name):
        def operation(self, *others):
            found = (o.x if isinstance(o, Interval) else int(o) for o in others)
            if others and type(others[0]).__name__ == "Jet":
                return NotImplemented
            return Interval(getattr(self.x, name)(*found))
        return operation
    for name in "add radd sub rsub mul rmul truediv rtruediv pow neg".split():
        locals()[f"__{name}__"] = _with(f"__{name}__")
    def __or__(self, other): return Interval(self.x.hull(other.x))
    def lb(self): return self.x.inf
    def ub(self): return self.x.sup
    def mid(self): return self.x.mid
def sin(x): return print("no reply") or Interval(x.x.sin())
def cos(x): return Interval(x.x.cos())
"""


@pytest.mark.slow
def test_codac_does_the_same_work_in_a_process_of_its_own(tmp_path, monkeypatch):
    (tmp_path / "codac.py").write_text(FAKE)
    (tmp_path / "codac-9.8.7.dist-info").mkdir()
    (tmp_path / "codac-9.8.7.dist-info" / "METADATA").write_text("Name: codac\nVersion: 9.8.7\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    work, of = tasks.works(4)[0], arithmetic(OURS, 53)
    with codac_server.codac(sys.executable) as (version, bounds):
        assert version == "9.8.7"
        for order in (0, 1, 2):
            pairs = zip(bounds(work, order), slopes.bounds(of, of, work, order), strict=True)
            assert all(abs(theirs - ours) < 1e-9 for theirs, ours in pairs)
        with pytest.raises(Undecided, match="not excluded"):
            bounds(replace(work, grid=work.grid[-1:]), 0)
    (tmp_path / "codac.py").write_text("raise ImportError\n")
    with codac_server.codac(sys.executable) as absent:
        assert absent is None


# -- flights ------------------------------------------------------------------------------------


def test_enclosures_of_flights_that_exclude_the_truth_show():
    times = [tasks.truth(phase).flight[0] for phase in tasks.PHASES]
    assert tasks.width([(time, time + 1) for time in times]) == 1
    for side in (-1, 1):  # by less than any of the precisions shows
        off = [time + side * Fraction(1, 10**350) for time in times]
        assert tasks.width([(time, time) for time in off]) < 0
    late = [*map(float, times[:-1]), float(times[-1]) + 31]
    assert abs(tasks.deviation(late) - 31) < 1e-9
    with pytest.raises(Undecided):
        tasks.deviation([*late[:-1], None])


def test_an_ode_solver_finds_the_flights_where_it_sees_them():
    pytest.importorskip("scipy")
    assert tasks.solved("DOP853", 1e-13) < 1e-10


# -- diagrams and the command ----------------------------------------------------------------------


@pytest.mark.slow
def test_a_diagram_shows_what_was_measured():
    pytest.importorskip("matplotlib")
    proved = curve_of([1.0, None, 1e-9])
    guessed = Curve("work", "simulated", "step", points=[Point(1, 0.1, [2.0])], proved=False)
    drawn = partial(Diagram, "d", "A title", "error [kg]", curves=[proved, guessed])
    both = svg(drawn())
    assert both == svg(drawn()) and ElementTree.fromstring(both).tag.endswith("svg")
    for words in ("simulated", "way", "A title", "error [kg]", "time [s]"):
        assert both.count(f"<!-- {words} -->") == 1
    assert "<!-- simulated -->" not in svg(drawn(certified=True))
    ways = [f"{form}, {name}" for form in ("natural", "Taylor 2") for name in (OURS, FLINT)]
    forms = [Curve("w", way, "boxes", points=[Point(1, 0.1, [2.0])]) for way in ways]
    panels = svg(Diagram("d", "A title", curves=forms, panels=True))
    for words in ("natural", "Taylor 2", OURS, FLINT):
        assert panels.count(f"<!-- {words} -->") == 1


def test_what_is_across_is_the_error_or_its_digits():
    point, none = Point(3.0, 1e-7, [1.0]), Point(3.0, None, [], "too wide")
    for against, places in {"error": (1e-7, 0), "digits": (7, 0)}.items():
        of = Diagram("d", "A title", "across", against)
        assert [of.place(one) for one in (point, none)] == pytest.approx(places)
    assert Diagram("d", "A title", least=1e-6).place(point) == 0


def test_a_library_has_the_same_colour_everywhere():
    known = {of_peer(f"{form}{name}") for form in ("", "natural, ") for name in PEERS}
    assert len(known) == len(PEERS) and None not in known
    assert of_peer(OURS) is of_peer("certified map (search.image)") is None


@pytest.mark.slow
def test_the_smallest_run_measures_everything(tmp_path, capsys, monkeypatch):
    """Everything but the ledger, which the suite makes elsewhere."""
    monkeypatch.setattr("proofs.benchmark.page.svg", lambda of: f"{of.title}, not drawn")
    process, done = horseshoe.process, horseshoe.Process(1.0, 0, 1.0)
    monkeypatch.setattr(horseshoe, "process", lambda x: done if "ledger" in x else process(x))
    target, out = tmp_path / "samples.json", tmp_path / "out"
    assert main(["--smallest", "--json", str(target), "--out", str(out)]) in (0, 1)
    text = capsys.readouterr().out
    assert "NOT AN ENCLOSURE" not in text
    assert re.search(r"^\| what +\| target +\| measured +\| reached +\|$", text, re.M)
    for name in (
        "import numpy, mpmath (pairs)",
        "script in python-flint (pairs)",
        "memory",
        "first run",
        "the main job's, witness kept",
        "nothing changed",
        "at both ends",
    ):
        assert name in text
    rows = json.loads(target.read_text())["rows"]
    found = [row["samples"] for row in rows if "points" in row["samples"]]
    assert len(found) > 30 and all(one["points"][0]["seconds"] for one in found)
    assert any(math.isfinite(one["order"] or math.inf) for one in found)
    page = (out / "benchmark.md").read_text()
    linked = set(re.findall(r"`(benchmark-.*?\.svg)`", page))
    assert linked == {path.name for path in out.glob("*.svg")}
    names = ("slopes-binary64", "slopes-30-digits", "slopes-monotone", "flights")
    assert linked >= {f"benchmark-{name}.svg" for name in names}
    assert all(f"## {row['section']}\n" in page for row in rows)
    assert {CODAC, FLINT, "scipy"} <= {row["name"] for row in rows}
