"""Work-precision curves: fits, sweeps, the work itself against other arithmetics, the limit."""

import importlib
import json
import math
import re
import sys
from fractions import Fraction
from xml.etree import ElementTree

import mpmath
import pytest

from intervals import Undecided
from proofs.benchmark import (
    codac_slopes,
    curves,
    diagrams,
    horseshoe_flint,
    limit,
    long_curves,
    peers,
    point_curves,
    precision,
    slope_curves,
    slope_forms,
)
from proofs.benchmark.__main__ import main
from proofs.benchmark.arithmetics import Flint, Iv, Ours
from proofs.benchmark.curves import Budget, Curve, Point
from proofs.benchmark.diagrams import Diagram, svg
from proofs.benchmark.horseshoe import DOMAINS, SYSTEM
from proofs.benchmark.slope_curves import ARRAY, CODAC, FLINT, IV, SCALAR
from proofs.trusted.certificate import SCHEMA
from proofs.trusted.equations import clock, gap, launch

PEERS = (FLINT, IV, CODAC)

# -- fits ------------------------------------------------------------------------------------------


def curve_of(errors, **options):
    points = [Point(2.0**k, error, [1.0]) for k, error in enumerate(errors)]
    return Curve("work", "way", "boxes", points, **options)


@pytest.mark.parametrize("power", [-3, 0.5])
def test_the_exponent_of_a_power_law(power):
    sizes = [1, 3, 10, 40]
    found = curves.exponent(sizes, [7 * size**power for size in sizes])
    assert math.isclose(found, power)


def test_a_fit_uses_the_last_four_points_above_the_floor():
    errors = [5.0, 5.0, 1.0, 0.25, 2.0**-4, 2.0**-6, 1e-12, 1e-12]
    assert curve_of(errors, floor=1e-14).fit() == (pytest.approx(-2.0), 4)
    assert curve_of(errors[:2]).fit() is None
    assert curve_of([1.0, None, 0.5, None, 0.25]).fit() == (pytest.approx(-0.5), 3)


def test_time_is_fitted_where_it_is_asked():
    points = [Point(d, 10.0**-d, [d**1.5, 99.0, d**1.5]) for d in (10.0, 20.0, 40.0)]
    curve = Curve("work", "way", "digits", points, against="time")
    assert curve.fit() == (pytest.approx(1.5), 3)
    assert "time ~ digits^1.50" in curves.row(curve).measured


def test_rows_judge_orders_and_enclosures():
    good = curves.row(curve_of([1.0, 0.25, 2.0**-4], least=1.8))
    assert good.reached and "error ~ boxes^-2.00" in good.measured
    assert curves.row(curve_of([1.0, 0.5, 0.25], least=1.8)).reached is False
    few = curves.row(curve_of([1.0, 0.5], least=1.8))
    assert (few.reached, few.target) == (None, "") and "too few sizes" in few.measured
    wrong = curve_of([1.0, -1e-9, 2.0**-4], least=1.8)
    assert curves.row(wrong).reached is False
    assert "NOT AN ENCLOSURE" in curves.row(wrong).measured
    wrong.proved = False
    assert "NOT AN ENCLOSURE" not in curves.row(wrong).measured


def test_the_worst_of_what_is_not_proved_shows():
    missed = curve_of([1e-3, 31.0, 1e-9], proved=False, against="")
    assert "worst, boxes 2: 3.1e+01" in curves.row(missed).measured
    assert "worst" not in curves.row(curve_of([1e-3, 1e-6, 1e-9], proved=False)).measured


# -- sweeps ----------------------------------------------------------------------------------------


@pytest.fixture
def passing(monkeypatch):
    """Time that passes only where a task says so."""
    now = [0.0]
    monkeypatch.setattr(curves, "perf_counter", lambda: now[0])
    monkeypatch.setattr("proofs.benchmark.measuring.perf_counter", lambda: now[0])
    return now


def way(passing, name, seconds, calls):
    def make(size):
        if seconds(size) is None:
            raise Undecided("too wide")

        def task():
            calls.append((name, size))
            passing[0] += seconds(size)
            return 1 / size

        return task

    return Curve("work", name, "boxes"), make


def test_ways_are_measured_in_turn_and_undecided_ones_are_kept(passing):
    calls = []
    a, b = (
        way(passing, "a", lambda n: None if n == 1 else 0.01, calls),
        way(passing, "b", lambda n: 0.02, calls),
    )
    first, second = curves.sweep({"a": a, "b": b}, (1, 2), Budget(2, 0.1))
    assert first.points[0] == Point(1, None, [], "too wide")
    assert second.points[1].seconds == pytest.approx([0.02] * 3)
    of_two = [name for name, size in calls if size == 2]
    assert of_two == ["a", "a", "b", "b", "a", "b", "a", "b"]
    assert curves.row(first).samples["curve"]["points"][0]["note"] == "too wide"


def test_slow_ways_are_not_repeated_and_leave_if_they_grow(passing):
    calls = []
    ways = {
        "growing": way(passing, "growing", lambda n: 0.04 * n, calls),
        "faster": way(passing, "faster", lambda n: 0.002 * n**2, calls),
        "flat": way(passing, "flat", lambda n: 0.2, calls),
        "long": way(passing, "long", lambda n: 1.1, calls),
    }
    growing, faster, flat, long = curves.sweep(ways, (1, 4, 16, 64), Budget(3, 0.1))
    assert [len(p.seconds) for p in growing.points] == [4, 4]
    assert [len(p.seconds) for p in faster.points] == [4, 4, 1]
    assert [len(p.seconds) for p in flat.points] == [4, 4, 4, 4]
    assert [len(p.seconds) for p in long.points] == [1]
    assert calls.count(("long", 1)) == 1


def test_ratios_are_of_pairs_at_the_largest_common_size():
    own = Curve("w", "form, ours", "boxes", [Point(1, 1.0, [9.0]), Point(4, 1.0, [2.0, 4.0])])
    theirs = Curve("w", "form, theirs", "boxes", [Point(1, 1.0, [9.0]), Point(4, 1.0, [6.0, 20.0])])
    assert curves.ratios(own, theirs).samples["ratios"] == [3.0, 5.0]
    assert curves.ratios(own, Curve("w", "form, other", "boxes", [Point(2, 1.0, [1.0])])) is None


# -- the slopes ------------------------------------------------------------------------------------


def test_the_truth_is_that_of_another_transcription():
    pytest.importorskip("flint")
    for found, domain in zip(slope_curves.truth(), DOMAINS, strict=True):
        for ours, theirs in zip(found, horseshoe_flint.true_extremes(*domain), strict=True):
            assert abs(ours - theirs) < Fraction(1, 10**150)


def test_the_series_of_the_slope_is_that_of_another_transcription():
    pytest.importorskip("flint")
    of, phase, step = Ours(300), Fraction("1.12"), Fraction(1, 2**20)
    at, beside = horseshoe_flint.true_extremes(phase, phase + step)
    phi = of.number(phase, phase)
    about = slope_curves.find_times(SYSTEM, slope_curves.np.array([float(phase)]))[0]
    time = slope_forms.thin_time(of, SYSTEM, phi, float(about))
    found = slope_forms.coefficients(of, SYSTEM, phi, time, 4)
    assert abs(found[0].mid - at) < Fraction(1, 10**80)
    value = sum(c.mid * step**k for k, c in enumerate(found))
    bound = 10**6 * step**5
    assert abs(value - beside) < bound
    for k in (1, 2, 3, 4):  # without any of the terms it is not
        assert abs(value - found[k].mid * step**k - beside) > bound


@pytest.mark.slow
@pytest.mark.parametrize("order", [slope_forms.MONOTONE, 0, 1, 2, 3, 4])
def test_all_arithmetics_do_the_same_work(order):
    pytest.importorskip("flint")
    losses = [
        slope_curves._by_scalars(name, order, bits, 4)()
        for name in (SCALAR, FLINT, IV)
        for bits in (53, 100)
    ]
    if order == slope_forms.MONOTONE:
        assert all(0 <= lost < 1e-10 for lost in losses)
        assert all(lost < 1e-24 for lost in losses[1::2])
        return
    losses.append(slope_curves._by_array(order, 4)())
    assert all(lost > 0 for lost in losses)
    assert max(losses[:-1]) < 1.1 * min(losses[:-1])
    assert losses[-1] < 1.1 * min(losses[:-1])  # its polynomials have a tighter range


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("end", [0, 1])
def test_bounds_within_the_truth_have_a_negative_loss(side, end):
    bounds = [list(pair) for pair in slope_curves.truth()]
    assert slope_curves.loss(bounds) == 0
    bounds[side][end] += (1 - 2 * end) * Fraction(1, 10**12)
    bounds[1 - side][1 - end] -= (1 - 2 * (1 - end)) * Fraction(1, 1000)
    assert -1.1e-12 < slope_curves.loss(bounds) < -0.9e-12


def altered(work, **changes):
    return slope_forms.Work(**{**vars(work), **changes})


@pytest.mark.parametrize("of", [Ours(53), Iv(53)])
def test_a_wrong_bracket_or_grid_is_not_proved(of):
    work = slope_curves.works(4)[1]
    slope_forms.one_by_one(of, of, SYSTEM, work, 0)
    moved = [(low + 0.5, high + 0.5) for low, high in work.brackets]
    early = [(low - 0.01, low - 0.001) for low, high in work.brackets]
    impact = work.brackets[-1][1]
    rising = [time for time in work.grid if time < impact - 4]  # then gap' > 0 at first
    for change in ({"brackets": moved}, {"brackets": early}, {"grid": rising}):
        with pytest.raises(Undecided):
            slope_forms.one_by_one(of, of, SYSTEM, altered(work, **change), 0)
    boxes = [of.number(*pair) for pair in zip(work.cuts, work.cuts[1:], strict=False)]
    slope_forms.exclude(of, SYSTEM, boxes, work.grid)
    beyond = [*work.grid, impact + 3]  # the gap is positive again
    for grid in ([*work.grid, impact + 0.1], beyond, work.grid[-1:]):
        with pytest.raises(Undecided):
            slope_forms.exclude(of, SYSTEM, boxes, grid)


def zero_of_the_gap(phase, low, high):
    """Bisect in floating point."""
    start = launch(-1, 0.2121, -0.2, phase)
    below = gap(start, clock(0.2121, low)) < 0
    while low < (middle := (low + high) / 2) < high:
        same = (gap(start, clock(0.2121, middle)) < 0) == below
        low, high = (middle, high) if same else (low, middle)
    return low


def test_where_the_mass_leaves_the_table_there_is_no_impact_time():
    of, phase = Ours(100), Fraction("1.11")
    phi = of.number(phase, phase)
    impact = slope_forms.thin_time(of, SYSTEM, phi, zero_of_the_gap(1.11, 25.0, 25.5))
    assert impact.wid < 1e-20
    with pytest.raises(Undecided):  # the next zero of the gap, upward
        slope_forms.thin_time(of, SYSTEM, phi, zero_of_the_gap(1.11, 26.0, 27.5))


def test_monotonicity_is_proved_and_not_taken_for_granted():
    domain = Fraction(3), Fraction("3.01")  # f'' changes its sign
    grid = slope_curves.grid_of(slope_curves.cover_by_impacts(SYSTEM, domain)[0])
    work = slope_curves.work(domain, grid, 8)
    of = Ours(53)
    slope_forms.one_by_one(of, of, SYSTEM, work, 1)
    with pytest.raises(Undecided, match="f'' > 0"):
        slope_forms.one_by_one(of, of, SYSTEM, work, slope_forms.MONOTONE)


def test_a_form_that_is_not_monotone_is_still_enclosed():
    of = Ours(100)
    c = [of.number(x, x) for x in (1, 0, 1)]  # 1 + h^2 on [-1, 1]
    low, high = slope_forms._range(
        of, slope_forms._polynomial(of, c, of.number(-1, 1), (-1.0, 1.0), of.number(0, 0))
    )
    assert low <= 1 and high >= 2


# -- codac -----------------------------------------------------------------------------------------

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
def sin(x): return Interval(x.x.sin())
def cos(x): return Interval(x.x.cos())
"""


def test_codac_does_the_same_work_in_a_process_of_its_own(tmp_path, monkeypatch):
    (tmp_path / "codac.py").write_text(FAKE)
    (tmp_path / "codac-9.8.7.dist-info").mkdir()
    (tmp_path / "codac-9.8.7.dist-info" / "METADATA").write_text("Name: codac\nVersion: 9.8.7\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    work = slope_curves.works(4)[0]
    with peers.codac(sys.executable, "codac_slopes") as server:
        assert server.version == "9.8.7"
        for order in (0, 1, 2):
            low, high = codac_slopes.slopes(server, work, order)
            least, most = slope_forms.one_by_one(Ours(53), Ours(53), SYSTEM, work, order)
            assert abs(low - least) < 1e-9 and abs(high - most) < 1e-9
        with pytest.raises(Undecided, match="not excluded"):
            codac_slopes.slopes(server, altered(work, grid=work.grid[-1:]), 0)


def test_floats_travel_exactly():
    given = {"cuts": [0.1, 5e-324], "brackets": [(1 / 3, 1e300)]}
    told = json.loads(json.dumps(codac_slopes._written(given)))
    assert codac_slopes._read(told["cuts"]) == given["cuts"]
    assert codac_slopes._read(told["brackets"]) == [[1 / 3, 1e300]]


# -- points and proofs -----------------------------------------------------------------------------


def test_enclosures_of_flights_that_exclude_the_truth_show():
    times = point_curves._true_flights()
    assert point_curves._width([(time, time + 1) for time in times]) == 1
    assert point_curves._width([(time + 1, time + 2) for time in times]) < 0
    for side in (-1, 1):  # by less than any of the precisions shows
        off = [time + side * Fraction(1, 10**350) for time in times]
        assert point_curves._width([(time, time) for time in off]) < 0
    late = [*map(float, times[:-1]), float(times[-1]) + 31]
    assert abs(point_curves._deviation(late) - 31) < 1e-9
    with pytest.raises(Undecided):
        point_curves._deviation([*late[:-1], None])


def test_an_ode_solver_finds_the_flights_where_it_sees_them():
    pytest.importorskip("scipy")
    assert point_curves._solve("DOP853", 1e-13)() < 1e-10


def test_morans_root_in_all_arithmetics_is_that_of_a_closed_form():
    flint = pytest.importorskip("flint")
    ratios = Fraction(1, 2), Fraction(1, 4)  # x + x^2 = 1 for x = 2^-s
    with mpmath.workdps(40):
        root = Fraction(str(mpmath.log(mpmath.phi, 2)))
    unit = Fraction(1, 2**100)
    with flint.ctx.workprec(140):
        for of in (Flint(140), Iv(140), Ours(140)):
            low, high = point_curves.root_of_moran(of, ratios, unit)
            assert root - 2 * unit < low < root < high < root + 2 * unit
    with pytest.raises(Undecided):  # 20 bits do not show the signs
        point_curves.root_of_moran(Iv(24), ratios, Fraction(1, 2**23))


def test_s_0_is_measured_beside_others():
    pytest.importorskip("flint")
    found = point_curves.moran(Budget(1, 9.0), (20,), True)
    assert [curve.way for curve in found] == ["methods.moran", FLINT, IV]
    assert all(0 < curve.points[0].error < 1e-20 for curve in found)


def test_certificates_that_the_checker_refuses_show(tmp_path):
    (tmp_path / "false.json").write_text(json.dumps({"schema": SCHEMA, "padding": 9 * "-"}))
    (tmp_path / "cut.json").write_text(f'{{"schema": "{SCHEMA}"')
    (tmp_path / "horseshoe.json").write_text(json.dumps({"schema": SCHEMA, "padding": 99 * "-"}))
    (tmp_path / "MANIFEST.json").write_text("{}")
    (tmp_path / "stress.json").write_text('{"schema": "another", "seconds": 1.5}')
    (tmp_path / "list.json").write_text("[]")
    (curve,), rows = long_curves.checks(Budget(1, 1.0), tmp_path, 1.0)
    names = [row.name for row in rows]
    assert names == [f"check of {name}.json" for name in ("horseshoe", "cut", "false")]
    assert [row.reached for row in rows] == [False] * 3 and not curve.points
    (_, rows) = long_curves.checks(Budget(1, 1.0), tmp_path, -1.0)
    assert all("not measured" in row.measured for row in rows)
    (_, rows) = long_curves.checks(Budget(1, 1.0), tmp_path / "absent", 1.0)
    assert "no certificates" in rows[0].measured


# -- diagrams --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_diagram_shows_what_was_measured():
    pytest.importorskip("matplotlib")
    proved = curve_of([1.0, None, 1e-9])
    guessed = Curve("work", "simulated", "step", [Point(1, 0.1, [2.0])], proved=False)
    both = svg(Diagram("d", "A title", [proved, guessed], "error [kg]"))
    assert both == svg(Diagram("d", "A title", [proved, guessed], "error [kg]"))
    assert ElementTree.fromstring(both).tag.endswith("svg")
    for words in ("simulated", "way", "A title", "error [kg]", "time [s]"):
        assert both.count(f"<!-- {words} -->") == 1
    certified = svg(Diagram("d", "A title", [proved, guessed], certified=True))
    assert "<!-- simulated -->" not in certified
    assert ElementTree.fromstring(svg(Diagram("d", "Nothing", [Curve("w", "v", "kB")])))


@pytest.mark.slow
def test_forms_have_panels_and_libraries_one_entry_each():
    pytest.importorskip("matplotlib")
    ways = [f"{form}, {name}" for form in ("natural", "Taylor 2") for name in (ARRAY, FLINT)]
    found = [Curve("w", way, "boxes", [Point(1, 0.1, [2.0])]) for way in ways]
    drawn = svg(Diagram("d", "A title", found, panels=True))
    for words in ("natural", "Taylor 2", ARRAY, FLINT):
        assert drawn.count(f"<!-- {words} -->") == 1


@pytest.mark.slow
def test_points_with_a_name_show_it_at_their_size():
    pytest.importorskip("matplotlib")
    curve = Curve("check", "files", "kB", [Point(9, None, [2.0], "circle")], against="")
    assert "<!-- circle -->" in svg(Diagram("d", "A title", [curve], "kB", "size"))
    assert "<!-- circle -->" not in svg(Diagram("d", "A title", [curve]))  # it has no error


def test_what_is_across_is_the_error_its_digits_or_the_size():
    point, none = Point(3.0, 1e-7, [1.0]), Point(3.0, None, [], "too wide")
    for against, places in {"error": (1e-7, 0), "digits": (7, 0), "size": (3, 3)}.items():
        of = Diagram("d", "A title", [], "across", against)
        assert [diagrams._across(one, of) for one in (point, none)] == pytest.approx(places)
    assert diagrams._across(point, Diagram("d", "A title", [], least=1e-6)) == 0


@pytest.mark.parametrize(("against", "sign"), [("error", -1), ("digits", 1), ("size", 1)])
def test_smaller_errors_are_to_the_right_and_a_decade_is_seen(against, sign):
    axes = pytest.importorskip("matplotlib.figure").Figure().subplots()
    axes.set(xscale="log", yscale="log", xlim=(3e-3, 4e-3), ylim=(2.0, 3.0))
    diagrams._scale(axes, Diagram("d", "A title", [], "across", against))
    left, right = axes.get_xlim()
    assert sign * math.log10(right / left) == pytest.approx(1)
    low, high = axes.get_ylim()
    assert low < 2 and high > 3 and high / low == pytest.approx(10)


def test_a_library_has_the_same_colour_everywhere():
    known = {diagrams._style(f"{form}{name}") for form in ("", "natural, ") for name in PEERS}
    assert len(known) == len(PEERS) and None not in known
    assert len({colour for colour, _ in (*diagrams._OTHERS.values(), *diagrams._OURS)}) == 10
    for own in (ARRAY, SCALAR, "images, 64 bits", "certified map (model.image)"):
        assert diagrams._style(own) is None


# -- the limit -------------------------------------------------------------------------------------

TRACE = """\
import time: self [us] | cumulative | imported package
import time:       100 |        100 | site
import time:         7 |          7 |       email
import time:        20 |         27 |     gmpy2.gmpy2
import time:        30 |         57 |   mpmath.libmp
import time:         5 |         62 | mpmath
import time:         2 |          2 |   json
import time:        10 |         12 | proofs.horseshoe

pytestmark = pytest.mark.slow
"""


def test_imports_count_for_the_package_that_asked():
    assert limit.attributed(TRACE) == {
        "the interpreter": 100,
        "gmpy2": 27,
        "mpmath": 35,
        "proofs": 12,
    }


def test_all_watched_functions_exist():
    for names in limit._STAGES.values():
        for name in names:
            module, _, path = name.partition(":")
            found = importlib.import_module(module)
            for part in path.split("."):
                found = getattr(found, part)
            assert callable(found)


@pytest.mark.slow
def test_the_stages_of_the_main_job_are_all_of_it(tmp_path):
    from proofs.benchmark.measuring import EFFORTS

    job = ["--only", "H1", "N2", "--out", str(tmp_path)]
    rows = limit._account("job", job, tmp_path, EFFORTS["smallest"])
    shares = [float(row.measured.split()[-2]) for row in rows if row.name.endswith("[ms]")]
    assert sum(shares) == pytest.approx(100, abs=1)
    text = "\n".join(row.name for row in rows)
    for stage in ("start and end", "at the start", "slopes", "restitution", "certificate", "check"):
        assert stage in text
    assert (tmp_path / "horseshoe.json").exists()
    (failed,) = limit._account("job", ["--only", "H99"], tmp_path, EFFORTS["smallest"])
    assert failed.reached is False


# -- the command -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_smallest_run_measures_everything(tmp_path, monkeypatch, capsys):
    pytest.importorskip("matplotlib")
    monkeypatch.setattr(precision, "has_flint", lambda: False)
    monkeypatch.setattr(point_curves, "has_scipy", lambda: False)
    target, out = tmp_path / "samples.json", tmp_path / "out"
    outputs = ["--json", str(target), "--out", str(out)]
    status = main(["--smallest", *outputs, "--reports", str(tmp_path)])
    text = capsys.readouterr().out
    assert status in (0, 1)  # speed is never asserted
    assert "python-flint is absent" in text and "scipy is absent" in text
    assert "codac is absent" in text or "binary64 intervals, in C++" in text
    assert "NOT AN ENCLOSURE" not in text
    rows = json.loads(target.read_text())["rows"]
    found = [row["samples"]["curve"] for row in rows if "curve" in row["samples"]]
    assert len(found) > 30
    assert all(curve["points"] and curve["points"][0]["seconds"] for curve in found)
    sections = {row["section"] for row in rows}
    assert {"The main job", "Where the time of the main job goes", "The root s_0"} <= sections
    page = (out / "benchmark.md").read_text()
    linked = set(re.findall(r"^!\[.*\]\((.*)\)$", page, re.M))
    assert linked == {path.name for path in out.glob("*.svg")}
    names = ("slopes-binary64", "slopes-30-digits", "slopes-monotone", "flights", "s0", "orbits",
             "coverings", "dimensions", "checks")  # fmt: skip
    assert linked >= {f"benchmark-{name}.svg" for name in names}
    assert all(f"## {section}\n" in page for section in sections)


def test_names_of_libraries_are_those_of_the_other_benchmarks():
    assert (ARRAY, SCALAR, FLINT, IV, CODAC) == (
        "IntervalArray",
        "Interval",
        "python-flint",
        "mpmath.iv",
        "codac",
    )
