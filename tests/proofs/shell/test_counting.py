"""What --stats counts: each evaluation once, by hand and by wrappers of the functions counted."""

import inspect
import sys
from collections import Counter
from fractions import Fraction
from importlib import import_module
from pkgutil import walk_packages

import numpy as np
import pytest

import intervals
import proofs
from intervals import Interval, IntervalArray, Jet
from proofs import impact, period_doubling, resonance, single_impact
from proofs.methods.extremes import extremes
from proofs.motion import single_orbits
from proofs.motion.covering import cover_by
from proofs.motion.many import float_clock, float_launch
from proofs.motion.system import System
from proofs.motion.witness import FlightBox
from proofs.shell import counting
from proofs.shell.counting import (
    ARRAYS,
    BISECTIONS,
    CHECKER,
    COLUMNS,
    FLOATS,
    FORMULAS,
    GAP,
    INTERVALS,
    MATRIX,
    NUMBERS,
    PARTS,
    RATES,
    SECOND,
    SLOPE,
    Kind,
    counted,
    evaluations,
)
from proofs.trusted import equations
from proofs.trusted.equations import clock, gap, launch, slope
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, rational
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.parameters import PAPER
from tests.proofs.shell.test_stats import AT, CASES, COMMANDS, by, shown

SYSTEM = System(PAPER.eta, PAPER.nu)
MODULES = {
    module.name
    for package in (intervals, proofs)
    for module in walk_packages(package.__path__, f"{package.__name__}.")
}


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


@pytest.mark.parametrize("name", [*counting._RESULTS, *counting._CALLS])
def test_every_function_counted_exists(name):
    """Counts are by name: who renames a function must rename it here."""
    parts = name.split(".")
    depth = next(i for i in range(len(parts), 0, -1) if ".".join(parts[:i]) in MODULES)
    outer, *inner = parts[depth:]
    found = inspect.unwrap(getattr(import_module(".".join(parts[:depth])), outer))
    if inspect.isclass(found):
        found = vars(found)[inner[0]]
    assert ".".join([outer, *inner]) in {code.co_qualname for code in codes(found.__code__)}


def test_counting_changes_nothing_and_ends():
    def other(frame, event, value):
        pass

    launched, now = launch(-1, 0.2, -0.2, 1.0), clock(0.2, 1.0)
    plain = gap(launched, now)
    with counted() as counts:
        assert gap(launched, now) == plain
    gap(launched, now)
    assert counts == {Kind(GAP, FLOATS): 1} and sys.getprofile() is None
    sys.setprofile(other)
    try:
        with pytest.raises(KeyError), counted():
            assert sys.getprofile() is not other
            raise KeyError
        assert sys.getprofile() is other
    finally:
        sys.setprofile(None)


# -- by wrappers ----------------------------------------------------------------------------------


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


def _evaluated(value, start, now, order=0):
    """The row and the number of an evaluation of the gap, by its arguments."""
    numbers = [*start[1:4], *now]
    kind = CHECKER if any(isinstance(x, Enclosure | Dual) for x in numbers) else FLOATS
    plain = order == 0 and not any(isinstance(x, Dual) for x in numbers)
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
        expected = {column: calls[what, column] for column in (FLOATS, CHECKER)}
        assert by_kind == {ARRAYS: 0, INTERVALS: 0, **expected}
    assert rows.get(SLOPE, {CHECKER: 0})[CHECKER] == slopes[Enclosure]
    assert rows.get(MATRIX, {CHECKER: 0})[CHECKER] == matrices[""]
    assert slopes[Enclosure] + matrices[""] > 0 or status or "4.64" in arguments


@pytest.mark.slow
def test_other_formulas_are_those_that_wrappers_count(watch, monkeypatch, capsys):
    rows = shown(capsys, single_impact, *AT, "--n", "4")
    calls = watch(single_orbits.multiplier, "multiplier", lambda *_, **__: {"": 1})
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
        assert set(rows) <= {FORMULAS, *NUMBERS} and components
    state = COMMANDS[resonance]
    rows = shown(capsys, resonance, *state)
    pairs = watch(equations.arrival, "arrival", lambda value, *_, **__: {"": len(value)})
    assert resonance.main(state) == 0
    assert rows[FORMULAS][INTERVALS] == pairs[""] == 2


def test_each_bisection_makes_one_part_more():
    with counted() as counts:
        parts = cover_by(FlightBox.plastic(SYSTEM.place, (Fraction("0.5"), Fraction("1.15"))))
    assert counts[Kind(BISECTIONS)] == len(parts) - 1 > 0


def test_each_piece_of_a_range_is_asked_for_its_slope_once():
    asked = []

    def slope(low, high):
        asked.append((low, high))
        slopes = 3 * low * low - 1, 3 * high * high - 1  # of x^3 - x
        return (-1, max(slopes)) if low < 0 < high else (min(slopes), max(slopes))

    with counted() as counts:
        extremes(lambda x: (x**3 - x,) * 2, slope, [*map(Fraction, (-1, 0, 1))])
    pieces, halved = counts[Kind(PARTS)], counts[Kind(BISECTIONS)]
    assert pieces == halved + 2 > 2 and len(asked) == len(set(asked)) == pieces + halved
