"""Sticking, flights that never end, and how much of the circle sticks in the end.

Expected values come from `reference` (equation (10) typed by hand, mpmath at 50 digits), from
closed forms, and from brute force over flights in floating point.
"""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf

from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.report.figures.circle import bars
from proofs.search import s34_circle as circle
from proofs.search.steps import Prover
from proofs.shell.groups import decide, wanted
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phase, Phases
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.absorption import UNIT, Absorption, Sink
from proofs.trusted.paper.s34_circle.cells import Cell, Inverse, _links, absorbed, in_order
from proofs.trusted.paper.s34_circle.circle import ROWS
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.paper.s34_circle.transients import long_transients
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.oracles.circle import impacts_before_rest
from tests.oracles.judge import oracle
from tests.oracles.motion import Impact, flight
from tests.oracles.sources import committed
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import (
    add,
    apply,
    derive,
    edited,
    moved_to,
    proved_by,
    texts,
)
from tests.proofs.trusted.paper.test_edits import coarse
from tests.proofs.trusted.paper.test_edits import derived as conclusions

ETA, NU = mpf("0.2121"), mpf("-0.2")
CLAIMS = tuple(row.id for row in ROWS)


SMALL = Fraction(1, 2**60)


def affine(phases, images, slope):
    """A cell on which 1/|f'| is constant, and one for each of its images."""
    images = [tuple(map(Fraction, image)) for image in images]
    ends = (Fraction(slope),) * 2
    known = [Inverse.of(((u, u), (v, v)), (ends, ends), (0 * SMALL, 0 * SMALL)) for u, v in images]
    return Cell(tuple(map(Fraction, phases)), tuple(images), tuple(known))


# -- bookkeeping ---------------------------------------------------------------------------------


def test_what_is_left_of_the_middle_thirds():
    """x -> 3x mod 1, absorbed in the open middle third: (2/3)^(n + 1) is left after n steps."""
    third, whole = Fraction(1, 3), [(0, 1)]
    cells = [
        affine((0, third), whole, third),
        Cell((third, 2 * third), ()),
        affine((2 * third, 1), whole, third),
    ]
    found = absorbed(cells, 12, 1)
    assert found.open == found.rest[-1]  # without a sink
    for n, rest in enumerate(found.rest):
        assert 0 <= rest - Fraction(2, 3) ** (n + 1) < Fraction(1, 2**55)
    assert found.steps == [None, 0, None]
    sunk = absorbed(cells, 60, sink=1).sunk
    assert 1 - Fraction(1, 10**6) < sunk < 1  # almost every point comes to the middle third


def test_absorbed_cells_one_after_the_other():
    ends = [Fraction(i) for i in range(5)]
    first, *others = pairwise(ends)
    touching = [Cell(first, ()), *(Cell((a, b), ((a - 1, a),)) for a, b in others)]
    # an image that only touches the next cell counts as meeting it
    assert absorbed(touching, 6).steps == [1, None, None, None]
    quarter = Fraction(1, 4)
    inner = [Cell((a, b), ((a - 3 * quarter, a - quarter),)) for a, b in others]
    found = absorbed([touching[0], *inner], 6)
    assert found.steps == [1, 2, 3, 4]
    assert all(0 <= x - n < SMALL for x, n in zip(found.rest, [4, 3, 2, 1, 0, 0, 0], strict=True))


def test_what_is_said_of_intervals_is_a_bound(derived):
    """A file may bound the impacts of any of them as loosely as it likes, or of none."""
    known = derived["absorption-1"]
    known = replace(known, sink=None, open=known.rest[-1])
    long = next(phases for phases, _ in known.within if phases[1] - phases[0] > Fraction(1, 40))
    loose, none = (replace(known, within=each).sentence for each in ((((long), 999),), ()))
    assert loose.endswith("] within 999.") and "most" not in loose and "longest" not in loose
    assert none.endswith("; " + loose.split(" All phases")[0].rpartition("; ")[2])


def test_an_unknown_cell_is_never_absorbed_and_blocks_others():
    cells = [
        Cell((Fraction(0), Fraction(1))),
        affine((1, 2), [(Fraction(1, 4), Fraction(1, 2))], 1),
    ]
    found = absorbed(cells, 3)
    assert found.steps == [None, None]
    assert found.rest[-1] >= Fraction(5, 4)  # the whole first cell, and a quarter of the second


def test_images_without_an_inverse_bound_nothing():
    cells = [Cell((Fraction(0), Fraction(1)), ((Fraction(0), Fraction(1)),))]
    assert all(0 <= x - 1 < SMALL for x in absorbed(cells, 3).rest)


@pytest.mark.parametrize(("shift", "least"), [("0", "1.5"), ("0.5", "0.5")])
def test_what_is_sunk_may_lie_in_the_part_of_a_cell_that_is_not_reached(shift, least):
    """Translations: [1, 2] to [5, 6] + shift, [2, 3] to [0.5, 1.5]; [5, 6] is the sink.

    With a shift of 1/2 one half of [1, 2] is sunk, perhaps the one in the image, [1, 1.5].
    """
    shift, half = Fraction(shift), Fraction(1, 2)
    cells = [Cell((Fraction(i), Fraction(i + 1))) for i in range(7)]
    cells[1] = affine((1, 2), [(5 + shift, 6 + shift)], 1)
    cells[2] = affine((2, 3), [(half, 3 * half)], 1)
    assert 0 <= 1 + Fraction(least) - absorbed(cells, 5, sink=5).sunk < SMALL


@pytest.mark.parametrize("slope", [1, 3])
def test_bounds_of_a_density_from_both_ends(slope):
    """|X'| = 1 + slope y on [0, 1], known at the ends: exact on every part."""
    one, zero = Fraction(1), Fraction(0)
    ends = [(one, one), (one + slope, one + slope)]
    known = Inverse.of(((zero, zero), (one, one)), ends, (Fraction(slope),) * 2)
    low, high = known.density(2**62, 2**63)
    assert (low, high) == (2**64 + slope * 2**62, 2**64 + slope * 2**63)
    rough = Inverse.of(((zero, zero), (one, one)), ends, (Fraction(slope) / 2, 2 * Fraction(slope)))
    assert rough.density(2**62, 2**63)[0] == 2**64 + slope * 2**61  # from the lower end
    assert rough.density(2**62, 2**63)[1] == 2**64 + slope * 3 * 2**62  # from the upper one


def test_a_density_holds_up_to_the_true_end_of_a_cell():
    """Ends are rounded down: the first cell may end at 10.5 units, where |X'| = 1 + y is 11.5."""
    one = 2**64
    steep = Inverse(((0, 0), (20, 20)), ((one, one), (21 * one, 21 * one)), (one**2, one**2))
    link = _links((0, 10, 20), (0, 20), steep)
    assert link.dense[0] >= 23 * one // 2 and link.sparse[1] <= 11 * one


def test_what_is_held_may_lie_as_far_as_it_can_from_an_image():
    """A cell from 0.95 to 10.9 units holds 9, perhaps from 1.9 on: 3.1 of them in [0, 5]."""
    one = 2**64
    even = Inverse(((0, 0), (5, 5)), ((one, one), (one, one)), (0, 0))
    assert _links((0, 10, 20), (0, 5), even).least([9, 0]) <= 31 * one // 10


@pytest.mark.parametrize("seed", range(3))
def test_two_basins_of_a_quadratic_map(seed):
    """x -> 5 x (1 - x) on cells cut at random: of the two halves of an escape hole one keeps what
    comes, one absorbs it. Against 10^5 orbits in floating point."""
    rng, c = np.random.default_rng(seed), Fraction(5)
    half = Fraction(1, 2)
    holes = [(Fraction("0.276"), half), (half, Fraction("0.724"))]  # c x (1 - x) < 1 elsewhere
    cells = [Cell(hole) for hole in holes]
    for low, high in ((Fraction(0), holes[0][0]), (holes[1][1], Fraction(1))):
        inner = sorted(low + (high - low) * Fraction(x) for x in rng.uniform(0, 1, 250).tolist())
        for ends in pairwise([low, *inner, high]):
            images = sorted((c * x * (1 - x), x) for x in ends)
            slopes = [1 / abs(c * (1 - 2 * x)) for _, x in images]
            # 1/|f'| = (c^2 - 4 c y)^(-1/2), with the derivative 2 c (c^2 - 4 c y)^(-3/2) = 2 c s^3
            bend = tuple(2 * c * s**3 for s in slopes)
            y, z = (image for image, _ in images)
            inverse = Inverse.of(((y, y), (z, z)), [(s, s) for s in slopes], bend)
            cells.append(Cell(ends, ((y, z),), (inverse,)))
    cells = in_order(cells)
    absorbing, keeping = ([x.phases for x in cells].index(hole) for hole in holes)
    found = absorbed(cells, 60, absorbing, keeping)
    x = (np.arange(10**5) + rng.uniform()) / 10**5
    ends = np.zeros(2)
    for _ in range(60):
        for i, (low, high) in enumerate(holes):
            inside = (float(low) < x) & (x < float(high))
            ends[i] += inside.sum() / 10**5
            x = x[~inside]
        x = 5 * x * (1 - x)
    assert ends[0] - 0.04 < 1 - float(found.rest[-1]) < ends[0] + 1e-3
    assert ends[1] - 0.04 < float(found.sunk) < ends[1] + 1e-3
    assert len(x) / 10**5 <= found.open + Fraction(1, 10**3) and found.open < Fraction(1, 10**4)


def test_cells_are_ordered_and_gaps_are_filled():
    one, two = Cell((Fraction(0), Fraction(2)), ()), Cell((Fraction(3), Fraction(4)), ())
    assert in_order([two, one]) == [one, Cell((Fraction(2), Fraction(3))), two]
    with pytest.raises(Unproved, match="overlap"):
        in_order([one, Cell((Fraction(1), Fraction(3)))])


# -- separation ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def arc():
    return proved_by("circle", "separation-1")[0]


def separating():
    return committed("circle")["steps"]["separation-1"]["witness"]


def inside(bounds, value, digits=30):
    low, high = (mpf(x.numerator) / x.denominator for x in bounds)
    return low <= value <= high and high - low < mpf(10) ** -digits


def test_separation_against_fifty_digits(arc):
    phase = reference.separation_phase(ETA, NU)
    assert inside(arc.phase, phase)
    assert inside(arc.start, 3 * mp.pi - phase)
    time = mp.findroot(lambda t: reference.left_side_10(ETA, NU, phase, t), mpf("23.7278"))
    assert inside(arc.time, time)
    assert inside(arc.arrival, (phase + time) % (2 * mp.pi))
    assert mp.nstr((phase + time) % (2 * mp.pi), 10) == "4.640489737"
    assert arc.returns


def test_a_bracket_that_begins_at_the_separation_is_none():
    """To the precision of a wide bracket the push is 0 at its lower end."""
    leave = Fraction(mp.nstr(reference.separation_phase(ETA, NU), 45))
    witness = separating() | {"phase": texts((leave - Fraction(1, 10**40), leave + SMALL))}
    with pytest.raises(Unproved, match="does not change sign"):
        apply("separation", witness)


def test_a_phase_that_flies_is_no_separation(arc):
    """The flights from [6.05, 6.0501] end between 23.7 and 23.75, but the launches do not stick."""
    witness = separating()
    with pytest.raises(Unproved, match="does not change sign"):
        apply("separation", witness | {"phase": ["121/20", "60501/10000"]})


@pytest.mark.parametrize(
    ("eta", "nu", "returns"),
    [("0.6", "1.1", True), ("0.3", "0.5", False), ("3", "-2", False), ("2", "1.5", True)],
)
def test_the_sticking_arc_of_other_oscillators(eta, nu, returns):
    """Of stiff springs too, and of tables below the mass, where the arc passes phase 0."""
    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu))
    prover = Prover(System(of.eta, of.nu), 30, HORIZON)
    name, own = circle.prove_arc(prover)
    found = apply("separation", prover.steps[name]["witness"], of=of)
    assert (found.sentence, found.turns) == (own.sentence, own.turns)
    assert found.returns is returns
    start, leave = (mpf(float(x[0])) for x in (found.start, found.phase))
    for k in range(1, 40):
        phase, length = start + 2 * mp.pi * k / 40, leave - start
        push = reference.launch_acceleration(mpf(eta), mpf(nu), phase)
        assert (push < 0) == (2 * mp.pi * k / 40 < length)
    time, phase = reference.first_impact(mpf(eta), mpf(nu), leave + mpf(10) ** -12)
    assert abs(time - float(found.time[0])) < 1e-6
    assert abs((phase - float(found.arrival[0]) + 1) % (2 * mp.pi) - 1) < 1e-6


def test_there_is_no_sticking_arc_without_its_ends():
    ends = [(Fraction(low), Fraction(high)) for low, high in (("3", "7"), ("1", "8"))]
    for start in ends:
        with pytest.raises(Unproved, match="no arc"):
            Separation(PAPER.place, start, Phase(Fraction(6), Fraction(6)), ends[0], 1, *ends)


# -- flights that never end ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def never():
    name = "never-impacts-1"
    return committed("circle")["steps"][name]["witness"], *proved_by("circle", name)


def test_phases_that_never_impact_are_all_of_an_interval(never):
    """But for a few 1e-9."""
    assert oracle(never[1], random.Random(1)) == []
    low, high = never[1].phases
    for phase in (low - Fraction(2, 10**8), high + Fraction(2, 10**8)):
        assert isinstance(flight(PAPER.eta, PAPER.nu, phase, latest=70_000.0), Impact)


FURTHER, TURN = Fraction(1, 10**7), Fraction("6.283185307")
FASTER = {"eta": Fraction(5), "nu": Fraction(-1, 5)}  # an impact after phase 0.94


@pytest.mark.parametrize(
    ("change", "of"),
    [
        (lambda low, high: (low - FURTHER, high), {}),
        (lambda low, high: (low, high + FURTHER), {}),
        (lambda low, high: (1, 2), {}),
        (lambda low, high: (low, low), {}),  # one phase is no interval that is lost: G4, M6
        (lambda low, high: (low + TURN, high + TURN), {}),
        (lambda low, high: (low - TURN, high - TURN), {}),
        (lambda low, high: (Fraction("0.94"), Fraction("1.571")), FASTER),
        (lambda low, high: (low, high), {"nu": Fraction(-6, 5)}),
        (lambda low, high: (low, high), {"nu": Fraction(1, 5)}),
    ],
)
def test_other_intervals_are_refused(never, change, of):
    of, phases = replace(PAPER, **of), tuple(map(Fraction, change(*never[1].phases)))
    with pytest.raises((Unproved, Malformed)):
        apply("never-impacts", {"phases": texts(phases)}, of=of)


def test_another_frequency_has_another_interval(never):
    """With eta = 2121/9999 = 7/33 the motion repeats after 33 turns: far more phases are free."""
    of = replace(PAPER, eta=Fraction(2121, 9999))
    wide = Prover(System(of.eta, of.nu), 30, HORIZON)
    _, found = circle.prove_longest(wide)
    assert found.phases[1] - found.phases[0] > 100 * (never[1].phases[1] - never[1].phases[0])
    with pytest.raises(Unproved):
        apply("never-impacts", wide.steps["never-impacts-1"]["witness"])


@pytest.mark.parametrize(
    ("eta", "nu"),
    [("3/2", "-9/10"), ("5", "-1/5"), ("7/3", "-1/5"), ("1/2", "-1/10"), ("1", "-1/2")],
)
def test_flights_without_an_end_whatever_the_frequency(eta, nu):
    """By arithmetic of their own the oracles see each launch fly until all is where it was."""
    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu))
    prover = Prover(System(of.eta, of.nu), 30, HORIZON)
    name, found = circle.prove_longest(prover)
    assert apply("never-impacts", prover.steps[name]["witness"], of=of) == found
    low, high = found.phases
    assert high - low > Fraction(1, 4)
    for k in range(5):
        assert flight(of.eta, of.nu, low + (high - low) * k / 4, latest=1000) == "touches"


# -- the circle ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def derived():
    """What the checker derives from each of the steps of the coarse partition."""
    return conclusions(PAPER, coarse).known


ABSORPTION, LANDS = ("absorption-1", "witness"), ("lands-1", "witness")
LAST_LANDS, CELLS = ("lands-2", "witness"), (*ABSORPTION, "cells")


EDITS = {
    "a cut outside": ((*CELLS, 0, "cuts", -1), add(2**45), "outside the branch"),
    "fewer turns": ((*LANDS, "turns"), lambda x: "2", "not negative"),
    "no turns": ((*LANDS, "turns"), lambda x: "0", "stay up"),
    "landing further": ((*LANDS, "cuts", -1), add("1/10"), "negative"),
    "landing from before": ((*LANDS, "cuts", 0), add(-4), "stay up"),
    "landing from sooner": ((*LAST_LANDS, "cuts", 0), add("-1e-7"), "not negative"),
}


@pytest.mark.parametrize("name", EDITS)
def test_edited_steps_are_refused(derived, name):
    path, change, message = EDITS[name]
    refused(derived, edited(coarse(), path, change), message)


def refused(derived, steps, message):
    with pytest.raises((Unproved, Malformed), match=message):
        derive(steps, known=derived, originals=coarse())


def test_a_grazing_phase_is_not_absorbed(derived):
    cut = Fraction(coarse()["branch-1"]["witness"]["cuts"][-1])
    assert not any(low <= cut <= high for (low, high), _ in derived["absorption-1"].within)


def test_cells_begin_after_the_last_zero_of_the_sine_and_before_the_impacts(derived):
    """Of a branch whose window begins before a zero of sin(eta t)."""
    steps = coarse()
    cells = steps["absorption-1"]["witness"]["cells"]

    def half_turns(time):
        return mp.floor(ETA * mpf(float(Fraction(time))) / mp.pi)

    index, cell = next(
        (index, cell)
        for index, cell in enumerate(cells)
        if half_turns(derived[cell["branch"]].times[0]) < half_turns(cell["after"])
    )
    branch = derived[cell["branch"]]
    late = (min(map(Fraction, cell["times"])) * UNIT + min(end for _, end in branch.windows)) / 2
    for time, message in ((branch.times[0], "one sign"), (late, "not excluded")):
        refused(
            derived,
            edited(steps, (*CELLS, index, "after"), lambda x, time=time: str(time)),
            message,
        )


def test_a_later_crossing_is_not_the_first_impact(derived):
    """The gap, continued below the table, falls through 0 again later: signs +, - there too."""
    steps = coarse()
    cell = steps["absorption-1"]["witness"]["cells"][0]
    cut, first = (float(Fraction(cell[name][1]) * UNIT) for name in ("cuts", "times"))

    def gap(t):
        return -reference.left_side_10(ETA, NU, mpf(cut), t)

    grid = np.arange(first + 1, first + 60, 0.05)
    signs = [gap(mpf(t)) > 0 for t in grid]
    begin = next(t for t, u, v in zip(grid, signs, signs[1:], strict=False) if u and not v)
    root = mp.findroot(gap, (mpf(begin), mpf(begin + 0.05)), solver="anderson")
    later = int((root - mpf(2) ** -41) * 2**48)
    forged = edited(steps, (*CELLS, 0, "times", 1), lambda x: str(later))
    refused(derived, forged, "leaves the window")


def test_the_figure_draws_what_is_proved(derived):
    found = derived["absorption-1"]
    drawn = [(low, high, count) for (low, high), (_, count) in bars(found)]
    covered = 2.66606 + sum(high - low for low, high, _ in drawn)  # the sticking arc, and bars
    left = float(found.rest[-1])
    assert 2 * np.pi - 3 * left < covered < 2 * np.pi
    assert all(0 <= low < high <= 2 * np.pi for low, high, _ in drawn)
    for low, high, count in drawn:
        steps = impacts_before_rest(PAPER.eta, PAPER.nu, 0.3 * low + 0.7 * high, count)
        assert steps is not None and steps <= count


# -- decisions -----------------------------------------------------------------------------------


def test_nothing_is_claimed_where_the_mass_does_not_stick_and_fly():
    of = replace(PAPER, nu=Fraction(1, 5))
    assert not any(circle.prove(of, CLAIMS).proofs.values())


def test_an_orbit_elsewhere_is_not_the_printed_one(arc):
    found = arc
    for other in (("5", "5.1"), ("1", "1.1")):
        moved_ = replace(found, arrival=Phase(*map(Fraction, other)))
        assert find("G2").decide(PAPER, [moved_]).verdict is Verdict.UNDECIDED
    late = replace(found, start=Phase(Fraction("3.4"), Fraction("3.5")))
    assert find("G1").decide(PAPER, [late]).verdict is Verdict.UNDECIDED


def followed(arc, rest, *within):
    ranges = tuple(((Fraction(low), Fraction(high)), n) for low, high, n in within)
    rest = tuple(map(Fraction, rest))
    return Absorption(arc, rest, ranges, rest[-1])


@pytest.mark.parametrize(
    ("low", "high", "said"),
    [
        (1, 2, "[1, 2] within 3"),
        (-1, 2, "[5.283186, 2 pi) and [0, 2] within 3"),
        (-1, 0, "[5.283186, 2 pi) and [0, 0] within 3"),
        (-2, -1, "[4.283186, 5.283185] within 3"),  # not up to 2 pi
        (-1, "-1e-9", "[5.283186, 6.283185] within 3"),
    ],
)
def test_an_interval_of_phases_is_written_from_0_to_2_pi(arc, low, high, said):
    assert (
        f"All phases of these intervals do: {said}." in followed(arc, (4,), (low, high, 3)).sentence
    )


def test_most_is_verified_and_almost_every_open_without_free_phases(arc):
    found = [followed(arc, (4, "1/1000"), (-1, 1, 1))]
    strong = find("G10").decide(PAPER, found)
    assert strong.verdict is Verdict.UNDECIDED
    assert strong.quantities["basin_fraction"][0] > Fraction("0.999")
    assert find("G4").decide(PAPER, found).verdict is Verdict.VERIFIED


WHOLE = Fraction("6.283185307179586477")
SIDES = (("1.57", "1.5700000005"), ("1.571", "1.571000001"))  # 5e-10 and 1e-9 wide


@pytest.mark.parametrize(
    ("open_", "measure", "sides", "verdict"),
    [
        ("6.283e-6", "0.0022", SIDES, Verdict.VERIFIED),
        ("6.284e-6", "0.0022", SIDES, Verdict.UNDECIDED),  # more than a millionth of 2 pi
        ("6.283e-6", "0.0022", (SIDES[0], ("1.571", "1.571000002")), Verdict.UNDECIDED),
        ("6.283e-6", None, SIDES, Verdict.UNDECIDED),
    ],
)
def test_two_basins_need_nearly_all_of_the_circle_and_narrow_ends(
    arc, open_, measure, sides, verdict
):
    ends = tuple((Fraction(low), Fraction(high)) for low, high in sides)
    never = NeverImpacts(PAPER.place, Phases(ends[0][1], ends[1][0]))
    known = followed(arc, (4, "0.0023" if measure else open_), (-1, 1, 1))
    if measure:
        known = replace(known, sink=Sink(never, ends, Fraction(measure)), open=Fraction(open_))
        assert "or to phases of [1.57" in known.sentence
    decision = find("G13").decide(PAPER, [known, never])
    assert decision.verdict is verdict
    if measure:
        low, high = decision.quantities["basin_fraction"]
        assert 0 < high - (1 - Fraction(measure) / WHOLE) < Fraction(1, 10**9)
        assert 0 < 1 - Fraction("0.0023") / WHOLE - low < Fraction(1, 10**9)


def test_what_is_open_rests_on_a_sink_of_the_same_oscillator(arc):
    ends = tuple((Fraction(low), Fraction(high)) for low, high in SIDES)
    elsewhere = replace(PAPER, nu=Fraction("-0.3")).place
    known = followed(arc, (4, 1), (-1, 1, 1))
    for change, message in (
        ({"open": Fraction(1, 2)}, "a sink that is not known"),
        ({"open": Fraction(2)}, "no bound"),
        ({"open": Fraction(-1)}, "no bound"),
        ({"sink": Sink(NeverImpacts(elsewhere, Phases(ends[0][1], ends[1][0])), ends, Fraction(1))},
         "different oscillators"),
    ):  # fmt: skip
        with pytest.raises(Unproved, match=message):
            replace(known, **change)


@pytest.mark.parametrize(
    "ends",
    [
        (("1.5", "1.6"), ("1.7", "1.8")),
        (("1.57", "1.57"), ("1.6", "1.7")),
        (("1.5", "1.57"), ("1.6", "1.6")),
    ],
)
def test_the_ends_of_a_sink_are_brackets_of_its_interval(ends):
    never = NeverImpacts(PAPER.place, Phases(Fraction("1.57"), Fraction("1.6")))
    pairs = tuple((Fraction(low), Fraction(high)) for low, high in ends)
    with pytest.raises(Unproved, match="not bracketed"):
        Sink(never, pairs, Fraction(1))


@pytest.mark.parametrize("claim", ["G4", "G10", "G13"])
def test_the_basin_is_that_of_the_printed_orbit(arc, claim):
    """Of another orbit, or of half the circle, nothing is said."""
    elsewhere = replace(arc, arrival=Phase(Fraction("4.65"), Fraction("4.66")))
    for found in ([followed(elsewhere, (4, "1/1000"), (-1, 1, 1))], []):
        assert find(claim).decide(PAPER, found).verdict is Verdict.UNDECIDED
    half = followed(arc, (4, 4), (-1, 1, 1))
    assert half.share < Fraction(1, 2)
    assert find("G4").decide(PAPER, [half]).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("arrival", "verdict"),
    [
        (("4.636", "4.644"), Verdict.VERIFIED),
        (("4.6", "4.7"), Verdict.UNDECIDED),
        (("4.65", "4.66"), Verdict.UNDECIDED),
        (("3.3", "3.4"), Verdict.UNDECIDED),
        (("6", "6.1"), Verdict.UNDECIDED),
        (("1", "1.1"), Verdict.UNDECIDED),
    ],
)
def test_stability_needs_an_impact_inside_the_arc_and_at_the_printed_phase(arc, arrival, verdict):
    found = replace(arc, arrival=Phase(*map(Fraction, arrival)))
    assert find("G3").decide(PAPER, [found]).verdict is verdict


def shift(low="1.1", high="1.49"):
    """An invented full shift on three thirds of an interval."""
    low, high = Fraction(low), Fraction(high)
    step = (high - low) / 5
    cells = tuple(Phases(low + 2 * i * step, low + (2 * i + 1) * step) for i in range(3))
    slopes, onward = ((Fraction(5), Fraction(7)),) * 3, ((0, 1, 2),) * 3
    return StayingSet(
        PlasticMap(PAPER.place), (Phases(low, high),), cells, slopes, onward, whole=True
    )


@pytest.mark.parametrize(
    ("within", "interval", "verdict"),
    [
        ([("1.2", "1.3", 3)], ("1.1", "1.49"), Verdict.VERIFIED),
        ([(0, "1.15", 2), ("1.48", "1.6", 4)], ("1.1", "1.49"), Verdict.VERIFIED),
        ([(0, "1.1", 2), ("1.49", "1.6", 4)], ("1.1", "1.49"), Verdict.UNDECIDED),  # outside
        ([("1.2", "1.3", 3)], ("1.12", "1.49"), Verdict.UNDECIDED),  # not around [1.11, 1.32]
        ([("1.2", "1.3", 3)], ("1.1", "1.47"), Verdict.UNDECIDED),  # nor [1.32, 1.48]
        ([("1.2", "1.3", 3)], ("1.1", "1.51"), Verdict.UNDECIDED),  # not in [1.1, 1.5]
    ],
)
def test_long_transients_need_phases_that_stick_inside_of_a_shift(arc, within, interval, verdict):
    known = followed(arc, (4, 1), *within)
    decision = find("G6").decide(PAPER, [shift(*interval), known])
    assert decision.verdict is verdict
    if verdict is Verdict.VERIFIED:
        assert f"at most n + {within[-1][2] if within[0][0] else 2} impacts" in decision.theorem
        assert "0.39/5^(n-1)" in decision.theorem


def test_a_shift_where_the_mass_sticks_says_nothing(arc):
    stuck = replace(arc, start=Phase(Fraction("1.4"), Fraction("1.41")))
    with pytest.raises(Unproved, match="before the sticking arc"):
        long_transients(shift(), followed(stuck, (4, 1), ("1.2", "1.3", 3)))
    elsewhere = moved_to(shift(), replace(PAPER, nu=Fraction("-0.3")).place)
    with pytest.raises(Unproved, match="different oscillators"):
        long_transients(elsewhere, followed(arc, (4, 1), ("1.2", "1.3", 3)))


@pytest.mark.slow
def test_rows_about_printed_phases_are_not_asked_elsewhere():
    """At (1/6, -0.45) a motion sticks too, at (5.17, 6.22): not at the phases printed."""
    of = replace(PAPER, eta=Fraction(1, 6), nu=Fraction("-0.45"))
    evidence = circle.prove(of, CLAIMS)
    lines = {claim: decide(claim, of, evidence, 30)[0] for claim in CLAIMS}
    printed = [claim for claim, line in lines.items() if "not asked here" in line.why]
    assert printed == ["G1", "G2", "G3", "G4", "G6", "G10", "G13"]
    assert {lines[claim].verdict for claim in printed} == {Verdict.UNDECIDED}
    assert lines["M6"].verdict is Verdict.CONDITIONAL
    assert "(eta, nu) = (1/6, -0.45)" in lines["G3"].truth
    impact, leave = (lines["G3"].quantities[f"{x}_phase"] for x in ("impact", "separation"))
    assert Fraction("5.1728") < impact[0] < Fraction("5.1729")
    assert Fraction("6.2196") < leave[0] < Fraction("6.2197")
    assert wanted("circle", of) == {"circle": ("M6", "G14")}
    assert wanted("circle", of, ["G3"]) == {"circle": ("G3",)}
    assert wanted("circle", PAPER)["circle"] == (*CLAIMS, "G14")


# -- touching for ever ---------------------------------------------------------------------------


def test_touching_needs_an_interval_without_impacts(never):
    assert find("G14").decide(PAPER, []).verdict is Verdict.UNDECIDED
    decision = find("G14").decide(PAPER, [never[1]])
    assert decision.verdict is Verdict.VERIFIED
    assert "after 10000 turns" in decision.theorem and "1.570570441202" in decision.theorem
    elsewhere = replace(never[1], at=replace(PAPER, nu=Fraction("-0.3")).place)
    assert find("G14").decide(PAPER, [elsewhere]).verdict is Verdict.UNDECIDED
