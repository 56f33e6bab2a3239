import math
import random
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from mpmath import mp, mpf

from intervals import IntervalArray, Undecided
from proofs.motion import kernel
from proofs.motion.covering import cover_by
from proofs.motion.kernel import CHUNK, Launches, exclude_impacts, find_times, prove_brackets
from proofs.motion.slope_cover import BINARY64, cut, grid_of, slope_cover
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, FlightBox
from proofs.search.steps import Prover

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
OTHER = System(Fraction("0.31"), Fraction("0.4"))  # p < 0: the mass flies above the table
I0, I1 = (
    (Fraction("1.11"), Fraction("1.15")),
    (Fraction("1.27"), Fraction("1.32")),
)
TRUE_EXTREMES = {
    I0: ("4.7269475378464088834", "6.1848695882061817003"),
    I1: ("4.3078032000324800005", "6.0559611942783438474"),
}
CASES = [(PAPER, I0), (PAPER, I1), (OTHER, (Fraction("2.1"), Fraction("2.13")))]


def bracket(eta, nu, phi, step=0.01):
    """Times before and after the first impact, by a scan in floating point."""

    def gap(t):
        mass = (1 + nu * math.sin(phi)) * math.cos(eta * t)
        return nu * (
            mass + nu * math.cos(phi) / eta * math.sin(eta * t) - 1 - nu * math.sin(phi + t)
        )

    t = 0.1
    while gap(t) > 0:
        t += step
    return t - step, t


@cache
def true_impact(system, phase):
    """(time, slope) at 50 digits from x - z as printed: a scan, bisection, dt/dphi by hand."""
    with mp.workdps(50):
        eta, nu, phi = (
            mpf(x.numerator) / x.denominator for x in (system.eta, system.nu, Fraction(phase))
        )
        side = -1 if nu < 0 else 1
        lift, rate = nu * mp.sin(phi), nu * mp.cos(phi)

        def gap(t):
            mass = (1 + lift) * mp.cos(eta * t) + rate / eta * mp.sin(eta * t)
            return side * (mass - 1 - nu * mp.sin(phi + t))

        low, high = (mpf(t) for t in bracket(*map(float, (system.eta, system.nu, phase))))
        while high - low > mpf(10) ** -45:
            middle = (low + high) / 2
            low, high = (middle, high) if gap(middle) > 0 else (low, middle)
        t = low
        by_time = rate * mp.cos(eta * t) - eta * (1 + lift) * mp.sin(eta * t) - nu * mp.cos(phi + t)
        by_phase = rate * mp.cos(eta * t) - lift / eta * mp.sin(eta * t) - nu * mp.cos(phi + t)
        return Fraction(*_ratio(t)), Fraction(*_ratio(1 - by_phase / by_time))


def _ratio(x):
    sign, mantissa, exponent, _ = x._mpf_
    value = Fraction(-mantissa if sign else mantissa) * Fraction(2) ** exponent
    return value.numerator, value.denominator


def holds(x, value, spare=Fraction(1, 10**40)):
    return Fraction(float(x.inf)) - spare <= value <= Fraction(float(x.sup)) + spare


def grid_over(system, phases):
    """Times before every first impact."""
    return grid_of(cover_by(FlightBox.plastic(system.place, phases))[0])


def launches_of(system, cuts):
    return Launches(system, IntervalArray.from_floats(cuts[:-1], cuts[1:]))


def box_with(cover, phase):
    index = int(np.searchsorted(cover.boxes.inf, float(phase), side="right")) - 1
    return max(index, 0)


@pytest.mark.slow
@pytest.mark.parametrize("boxes", [1, 7, 64, 1024])
@pytest.mark.parametrize(("system", "phases"), CASES)
def test_true_slopes_and_times_are_enclosed(system, phases, boxes):
    cover = slope_cover(system, phases, boxes)
    rng = random.Random(0)  # the same for all numbers of boxes: true impacts take long
    low, high = phases
    inner = [low + (high - low) * Fraction(rng.randrange(1, 10**9), 10**9) for _ in range(6)]
    for phase in (low, high, *inner, Fraction(float(cover.boxes.sup[boxes // 2]))):
        if not low <= phase <= high:
            continue
        time, slope = true_impact(system, phase)
        i = box_with(cover, phase)
        i -= Fraction(float(cover.boxes.inf[i])) > phase
        assert holds(cover.boxes[i], phase, 0)
        assert holds(cover.times[i], time)
        assert holds(cover.slopes[i], slope)
        assert cover.last[i] < float(time)


@pytest.mark.slow
@pytest.mark.parametrize(("system", "phases"), CASES)
def test_the_second_derivative_is_enclosed(system, phases):
    cover = slope_cover(system, phases, 16)
    step = Fraction(1, 10**9)
    for i in (0, 5, 15):
        middle = Fraction(float(cover.boxes.mid[i]))
        (_, before), (_, after) = (true_impact(system, middle + s) for s in (-step, step))
        second = (after - before) / (2 * step)
        assert holds(cover.curvatures[i], second, Fraction(1, 10**8))


@pytest.mark.parametrize("boxes", [1, 7, 64, 1024])
def test_the_boxes_cover_the_phases(boxes):
    cover = slope_cover(PAPER, I0, boxes)
    low, high = cover.boxes.inf, cover.boxes.sup
    assert len(cover.boxes) == boxes
    assert Fraction(float(low[0])) <= I0[0]
    assert Fraction(float(high[-1])) >= I0[1]
    assert (low[1:] == high[:-1]).all()


@pytest.mark.parametrize("phases", [I0, I1])
@pytest.mark.parametrize("boxes", [1, 64, 1024])
def test_the_union_contains_the_multiprecision_path(phases, boxes):
    low, high = slope_cover(PAPER, phases, boxes).bounds
    exact = Prover(PAPER, 30, HORIZON).slopes(list(phases))[1]
    for enclosure in exact.slopes:
        assert Fraction(low) <= enclosure[0]
        assert enclosure[1] <= Fraction(high)


def test_the_excess_falls_with_the_square_of_the_number_of_boxes():
    true_low, true_high = (float(x) for x in TRUE_EXTREMES[I1])
    losses = []
    for boxes in (64, 256, 1024):
        low, high = slope_cover(PAPER, I1, boxes).bounds
        losses.append(max(true_low - low, high - true_high))
    assert losses[0] < 1e-3
    assert losses[1] < losses[0] / 10
    assert losses[2] < losses[1] / 10


@pytest.mark.slow
def test_two_chunks_or_more_give_the_same_boxes():
    grid = grid_over(PAPER, I0)
    boxes = 2 * CHUNK // len(grid) + 5
    cover = slope_cover(PAPER, I0, boxes, grid)
    assert len(cover.slopes) == boxes
    assert (cover.bits == BINARY64).all()


def test_heights_are_those_of_every_phase_of_a_box():
    cuts = cut(I0, 5)
    launches = launches_of(PAPER, cuts)
    for time in (3.0, 17.0, 25.0):
        times = np.full(5, time)
        for phases in (cuts[:-1], cuts[1:], 0.3 * cuts[:-1] + 0.7 * cuts[1:]):
            thin = Launches(PAPER, IntervalArray.from_floats(phases)).heights(times)
            assert not launches.heights(times).certainly_less(thin).any()
            assert not thin.certainly_less(launches.heights(times)).any()


# -- refusals ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_grazing_phase_is_refused():
    with pytest.raises(Undecided):
        slope_cover(PAPER, (Fraction("1.17"), Fraction("1.2")), 64)
    # even if the grid is one that serves the launches on one side of it
    grid = grid_over(PAPER, I1)
    with pytest.raises(Undecided, match=r"box \d+ of 256"):
        slope_cover(PAPER, (Fraction("1.17"), Fraction("1.2")), 256, grid)


WRONG_GRIDS = {
    "ends too early": (lambda grid: grid[:-3], r"gap' < 0 is not proved.*box 0 of 64"),
    "goes past the impact": (lambda grid: [*grid, 25.28], "not excluded"),
    "too coarse for the chord": (lambda grid: [grid[0], grid[-1]], "not excluded"),
    "starts too late": (lambda grid: [t for t in grid if t >= 4.0], "sticks"),
}


@pytest.mark.parametrize("change, message", WRONG_GRIDS.values(), ids=WRONG_GRIDS)
def test_a_wrong_grid_is_refused(change, message):
    with pytest.raises(Undecided, match=message):
        slope_cover(PAPER, I0, 64, change(grid_over(PAPER, I0)))


def test_a_grid_that_jumps_over_an_impact_is_refused():
    # at the last time the gap of every launch is > 0 again: two zeros lie in between
    cuts, grid = cut(I0, 64), grid_over(PAPER, I0)
    launches = launches_of(PAPER, cuts)
    times = (26.0 + k / 8 for k in range(400))
    again = next(t for t in times if launches.heights(np.full(64, t)).certainly_positive().all())
    with pytest.raises(Undecided, match="not excluded"):
        exclude_impacts(launches, [*grid, again])


def test_a_first_piece_on_which_the_acceleration_dips_below_0_is_refused():
    # after about one turn of the table the acceleration is what it was at launch
    launches = Launches(PAPER, IntervalArray([I0]))
    with pytest.raises(Undecided, match="sticks"):
        exclude_impacts(launches, [6.25])


def test_a_time_just_after_the_impact_is_refused():
    # gap'' < 0 there, so that no chord bound looks at it
    phase = Fraction("2.1")
    time = float(true_impact(OTHER, phase)[0])
    launches = Launches(OTHER, IntervalArray([phase]))
    grid = grid_over(OTHER, (phase, phase + Fraction(1, 50)))
    exclude_impacts(launches, [*grid, time - 1e-6])
    with pytest.raises(Undecided, match="not excluded"):
        exclude_impacts(launches, [*grid, time + 1e-9])


def test_the_first_failing_box_is_named_in_any_chunk(monkeypatch):
    # here later launches land earlier, the first after 2.20, the last after 2.12
    phases = Fraction("2.1"), Fraction("2.13")
    cuts, grid = (
        cut(phases, 256),
        [*grid_over(OTHER, phases), 2.15],
    )
    launches = launches_of(OTHER, cuts)
    messages = []
    for chunk in (CHUNK, 10 * len(grid)):
        monkeypatch.setattr(kernel, "CHUNK", chunk)
        with pytest.raises(Undecided) as refused:
            exclude_impacts(launches, grid)
        messages.append(str(refused.value))
    assert messages[0] == messages[1]
    assert "box 0 " not in messages[0]


def test_a_bracket_that_begins_before_the_window_is_refused():
    cuts, grid = cut(I0, 64), grid_over(PAPER, I0)
    launches = launches_of(PAPER, cuts)
    last, high = np.full(64, grid[-1]), find_times(PAPER, cuts)[1:] + 1e-2
    prove_brackets(launches, last, last, high)
    with pytest.raises(Undecided, match="not one"):
        prove_brackets(launches, last, last - 0.125, high)


@pytest.mark.parametrize("grid", [[], [0.0, 1.0], [1.0, 1.0], [2.0, 1.0], [1.0, float("nan")]])
def test_no_grid_at_all_is_refused(grid):
    with pytest.raises(ValueError, match="times"):
        slope_cover(PAPER, I0, 4, grid)


def test_brackets_that_miss_are_refused():
    cuts = cut(I0, 64)
    launches = launches_of(PAPER, cuts)
    grid = grid_over(PAPER, I0)
    exclude_impacts(launches, grid)
    last, times = np.full(64, grid[-1]), find_times(PAPER, cuts)
    low, high = times[:-1] - 1e-2, times[1:] + 1e-2
    prove_brackets(launches, last, low, high)
    for index in (0, 20, 63):
        for ends in ((low + 2e-2, high), (low, high - 2e-2), (high, low), (low * np.nan, high)):
            moved = [x.copy() for x in (low, high)]
            for one, end in zip(moved, ends, strict=True):
                one[index] = end[index]
            with pytest.raises(Undecided, match=f"box {index} of 64"):
                prove_brackets(launches, last, *moved)


def test_a_sticking_launch_is_refused():
    sticks = (Fraction("-1.0"), Fraction("-0.9"))  # sin < -0.2355
    assert PAPER.sticking_arc == "some"
    stick = System(Fraction("0.2121"), Fraction("0.2"))
    for system, phases in ((PAPER, sticks), (stick, (Fraction("4.5"), Fraction("4.6")))):
        with pytest.raises(Undecided):
            slope_cover(system, phases, 16)
        with pytest.raises(Undecided, match=r"sticks.*box 0 of 16"):
            slope_cover(system, phases, 16, [0.5, 1.0])


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="box"):
        slope_cover(PAPER, I0, 0)
    with pytest.raises(ValueError, match="low < high"):
        slope_cover(PAPER, (I0[1], I0[0]), 4)
    with pytest.raises(ValueError, match="more boxes"):
        cut((Fraction(1), 1 + Fraction(1, 2**50)), 100)
