"""Work-precision curves: fits, sweeps, the work itself against other arithmetics, diagrams."""

import json
import math
import re
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from intervals import Undecided
from proofs.benchmark import horseshoe, peers, slopes, tasks
from proofs.benchmark.__main__ import main
from proofs.benchmark.curves import Curve, Diagram, Point, svg
from proofs.benchmark.peers import FLINT, IV, OURS, arithmetic

DOMAINS = tasks.DOMAINS


def curve_of(errors, **options):
    points = [Point(2.0**k, error, [1.0]) for k, error in enumerate(errors)]
    return Curve("work", "way", "boxes", points=points, **{"against": "error", **options})


# -- curves ----------------------------------------------------------------------------------------


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


# -- the slopes ------------------------------------------------------------------------------------


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
        assert both.count(f">{words}</text>") == 1
    assert ">simulated</text>" not in svg(drawn(certified=True))
    ways = [f"{form}, {name}" for form in ("natural", "Taylor 2") for name in (OURS, FLINT)]
    forms = [Curve("w", way, "boxes", points=[Point(1, 0.1, [2.0])]) for way in ways]
    panels = svg(Diagram("d", "A title", curves=forms, panels=True))
    for words in ("natural", "Taylor 2", OURS, FLINT):
        assert panels.count(f">{words}</text>") == 1


@pytest.mark.slow
def test_the_smallest_run_measures_everything(tmp_path, capsys, monkeypatch):
    """Everything but whole processes, which other tests and CI start."""
    monkeypatch.setattr("proofs.benchmark.page.svg", lambda of: f"{of.title}, not drawn")
    monkeypatch.setattr(horseshoe, "process", lambda command: horseshoe.Process(1.0, 0, 1.0))
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
    ):
        assert name in text
    rows = json.loads(target.read_text())["rows"]
    curves = [row["samples"] for row in rows if "points" in row["samples"]]
    assert len(curves) > 30 and all(each["points"][0]["seconds"] for each in curves)
    assert any(math.isfinite(each["order"] or math.inf) for each in curves)
    page = (out / "benchmark.md").read_text()
    linked = set(re.findall(r"`(benchmark-.*?\.svg)`", page))
    assert linked == {path.name for path in out.glob("*.svg")}
    names = ("slopes-binary64", "slopes-30-digits", "slopes-monotone", "flights")
    assert linked >= {f"benchmark-{name}.svg" for name in names}
    assert all(f"## {row['section']}\n" in page for row in rows)
    assert {FLINT, "scipy"} <= {row["name"] for row in rows}
