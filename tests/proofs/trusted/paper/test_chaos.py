"""The other invariant set and the entropy: against brute force, and certificates with lies in them.

Expected values come from a scan of equation (10) typed by hand (`reference`, mpmath) or from
plain floating point below, never from the code under test.
"""

import copy
import math
import random
from dataclasses import replace
from fractions import Fraction as F

import pytest
from mpmath import mpf

from proofs.motion.system import System
from proofs.motion.windows import Candidates
from proofs.motion.witness import HORIZON
from proofs.search.s34_chaos import prove_entropy
from proofs.search.steps import Prover
from proofs.trusted.certificate import Malformed
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import staying_set
from proofs.trusted.numbers import Phase, Phases
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.other_sets import PRINTED
from proofs.trusted.parameters import PAPER
from proofs.trusted.slopes import Impact
from proofs.trusted.verdicts import Verdict
from proofs.trusted.windows import BITS, Meetings
from tests.oracles.judge import oracle
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import apply, derive, evidence, moved_to

ETA, NU = 0.2121, -0.2
SYSTEM = System(PAPER.eta, PAPER.nu)
AT = PAPER.place


def distance(phase, t):
    """Table above mass, p > 0: equation (10) typed by hand."""
    return -reference.left_side_10(ETA, NU, phase, t, math.sin, math.cos)


def true_map(phase):
    """f by brute force, in floating point."""
    exact = mpf(F(phase).numerator) / F(phase).denominator
    time, image = reference.first_impact(mpf("0.2121"), mpf("-0.2"), exact)
    return float(time), float(image)


@pytest.fixture(scope="module")
def small():
    """The graph on the branches with flights over at most 15 turns."""
    prover = Prover(SYSTEM, 30, HORIZON)
    ((name, graph),) = prove_entropy(prover, most_turns=15, depth=1)
    return prover.steps, name, graph


@pytest.fixture(scope="module")
def graphs(small):
    return derive(small[0])


def refused(known, steps, name, change, reason=None):
    """Change the witness of one step; some rule must refuse it or what rests on it."""
    forged = copy.deepcopy(steps)
    change(forged[name]["witness"])
    with pytest.raises((Unproved, Malformed), match=reason):
        derive(forged, known=known, originals=steps)


# -- G5 --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_printed_interval_holds_one_orbit_of_period_two():
    found = find("G5").decide(PAPER, [each for _, each in evidence("chaos").proofs["G5"]])
    assert found.verdict is Verdict.VERIFIED
    assert "one unstable periodic orbit of period 2" in found.why
    for words in ("shift on 2 symbols", "shift on 3 symbols", "connected in both directions"):
        assert words in found.theorem
    known = {  # by mpmath, from equation (10)
        "period_1_point_1": "1.10477582912755084783825200487426348966",
        "period_1_point_2": "1.31638618266630966708810299847081679974",
        "period_1_point_3": "1.48882469464981606860152919725370295827",
        "period_2_point_1": "1.33751365213526555255158206000164860507",
        "period_2_point_2": "1.45739910220552884807350634946930233791",
    }
    assert {name for name in found.quantities if "point" in name} == {*known}
    bounds = [found.quantities[name] for name in known]  # to the 30 digits asked for
    for digits, (low, high) in zip(known.values(), bounds, strict=True):
        assert low < F(digits) < high and high - low < F(1, 10**29)
    pair = bounds[3:]
    for (phase, _), (image, _) in ((bounds[2], bounds[2]), pair, pair[::-1]):
        assert true_map(phase)[1] == pytest.approx(float(image), abs=1e-12)


def first(steps, rule):
    return next(name for name, step in steps.items() if step["rule"] == rule)


def cell(low, high, bottom, top, slope=5):
    """An invented cell: f goes from `bottom` to `top`, or back if the slope is negative."""
    images = (Phase(F(bottom), F(bottom)), Phase(F(top), F(top)))
    bounds = (F(slope), F(slope))
    images = images if slope > 0 else images[::-1]
    return SlopeRange(PlasticMap(AT), (F(low), F(high)), (bounds,) * 2, images, (bounds,))


def made(*cells, region=(PRINTED,)):
    """What stays in a region; all of it is a gap, too."""
    gaps = [Avoids(PlasticMap(AT), Phases(part[0], part[1]), Phases(F(0), F(6))) for part in region]
    return staying_set(region, cells, gaps)


A, B = ("1.32", "1.34"), ("1.45", "1.48")
A_AND, B_AND = Phases(F("1.32"), F("1.35")), Phases(F("1.4"), F("1.48"))
FULL = (cell(*A, "1.3", "1.5"), cell(*B, "1.3", "1.5"))
SWAP = (cell(*A, "1.4", "1.5"), cell(*B, "1.3", "1.35"))
GOLDEN = (cell(*A, "1.4", "1.5"), cell(*B, "1.3", "1.5"))


def test_a_full_shift_needs_cells_apart_that_increase_over_the_interval():
    shift = made(*FULL)
    assert shift == made(*FULL[::-1]) and shift.full and shift.whole and not shift.orbit
    assert [list(map(str, map(float, x))) for x in shift.cells] == [list(A), list(B)]
    touching = (cell("1.32", "1.4", "1.3", "1.5"), cell("1.4", "1.48", "1.3", "1.5"))
    with pytest.raises(Unproved):
        made(*touching)
    two = A_AND, B_AND
    assert made(*FULL, region=two).full and not made(*FULL, region=two).whole
    assert made(*FULL).latex and not made(*FULL, region=two).latex  # images need not cover all
    short = (cell(*A, "1.32", "1.48"), cell(*B, "1.32", "1.4801"))
    assert made(*short, region=(Phases(F("1.31"), F("1.48")),)).whole is False
    assert not made(*GOLDEN).full and made(FULL[0]).orbit == (FULL[0].domain,)
    falling = made(cell(*A, "1.3", "1.5", slope=-5), FULL[1])
    assert falling.whole and "|f'|" in falling.sentence and "one-to-one over" in falling.sentence
    assert "|f'|" not in shift.sentence


def test_a_cell_from_which_orbits_leave_is_none_of_the_sets():
    dead = cell("1.36", "1.4", "2", "2.5")
    shift = made(*FULL, dead)
    assert shift.full and not shift.whole and len(shift.cells) == 2
    assert "no other phase" not in shift.sentence
    beyond = cell(*B, "6.2", "0.1", slope=-5)  # its image passes phase 0
    assert made(cell(*A, "1.3", "1.5"), beyond).orbit == (FULL[0].domain,)
    around = made(cell(*A, "1.2", "1.1"), cell(*B, "1.3", "1.5"))  # all but [1.1, 1.2]
    assert around.full and not around.whole  # no interval of phases


def test_connections_are_for_three_symbols():
    middle = cell("1.38", "1.4", "1.3", "1.5")
    shift = made(FULL[1], middle, FULL[0])
    assert shift.cells == (FULL[0].domain, middle.domain, FULL[1].domain)
    assert "connected" in shift.sentence
    assert "connected" not in made(*FULL).sentence
    falling = cell("1.38", "1.4", "1.3", "1.5", slope=-5)
    assert "connected" not in made(FULL[1], falling, FULL[0]).sentence
    brackets = [x.domain for x in (FULL[1], middle, FULL[0])]  # no interval up to p
    assert "connected" not in made(FULL[1], middle, FULL[0], region=brackets).sentence


def test_one_orbit_needs_one_closed_path_that_is_covered():
    swap = made(*SWAP)
    assert swap.orbit == (SWAP[0].domain, SWAP[1].domain) and not swap.bracketed
    assert made(*SWAP[::-1]) == swap
    alone = made(cell(*A, "1.3", "1.35"))
    assert alone.sentence.count("fixed point") == 1
    dead = cell("1.36", "1.4", "2", "2.5")
    assert len(made(*SWAP, dead).cells) == 2
    assert not made(*FULL).orbit and not made(*GOLDEN).orbit
    shared = (cell("1.32", "1.4", "1.4", "1.5"), cell("1.4", "1.48", "1.3", "1.39"))
    for cells in (
        (cell(*A, "1.46", "1.5"), SWAP[1]),  # B is met, not covered
        (cell(*A, "1.33", "1.5"), SWAP[1]),  # so is A, beside B
        (SWAP[0], cell(*B, "1.5", "1.6")),  # nothing stays
        (cell(*A, "1.3", "1.35"), cell(*B, "1.44", "1.5")),  # two orbits
        (cell(*A, "1.44", "1.5"), cell(*B, "1.44", "1.5")),  # a path that joins a cycle
        shared,
    ):
        with pytest.raises(Unproved):
            made(*cells)


def test_an_orbit_of_period_three_goes_on_in_its_own_order():
    cells = [
        cell("1.33", "1.34", "1.44", "1.46"),
        cell("1.38", "1.39", "1.32", "1.35"),
        cell("1.45", "1.455", "1.37", "1.4"),
    ]
    assert made(*cells).orbit == tuple(cells[i].domain for i in (0, 2, 1))
    brackets = [x.domain for x in cells]
    inside = staying_set(brackets, cells, ())
    assert inside.bracketed and "with one point" not in inside.sentence


@pytest.mark.every
@pytest.mark.parametrize(
    ("cells", "reason"),
    [
        ([cell(*A, "1.3", "1.5", slope=1)], "expand"),
        ([cell(*A, "1.3", "1.5", slope=F("0.5"))], "not expand"),
        ([cell(*A, "1.3", "1.5", slope=-1)], "expand"),
        ([cell(*A, "1.3", "1.5", slope=400)], "longer than the circle"),
        ([cell(*A, "6.2", "0.1")], "apart and in order"),  # nothing stays
        ([cell("1.2", "1.34", "1.3", "1.5")], "leaves the region"),
        ([cell(*A, "1.3", "1.5"), cell("1.33", "1.48", "1.3", "1.5")], "overlap"),
        ([cell(*A, "1.3", "1.5")] * 2, "overlap"),
        ([], "apart and in order"),
    ],
)
def test_what_is_no_staying_set(cells, reason):
    with pytest.raises(Unproved, match=reason):
        made(*cells)


def test_the_intervals_of_a_region_are_apart():
    for region in ((A_AND, Phases(F("1.35"), F("1.48"))), (A_AND, A_AND, B_AND)):
        with pytest.raises(Unproved, match="apart"):
            made(*FULL, region=region)


def test_an_image_that_straddles_the_whole_turn_is_no_phase():
    with pytest.raises(Unproved, match="straddles"):
        cell(*A, "1.3", "6.2832")


def test_cells_and_gaps_must_cover_the_region():
    left, right = (F("1.32"), F("1.4")), (F("1.4"), F("1.48"))
    for ends, gap in ((left, right), (right, left)):
        one = (cell(*ends, "1.3", "1.5"),)
        assert staying_set((PRINTED,), one, (Avoids(PlasticMap(AT), Phases(*gap), PRINTED),)).cells
        short = Phases(gap[0] + F(1, 1000), gap[1] - F(1, 1000))
        less = Avoids(PlasticMap(AT), Phases(*gap), Phases(F("1.33"), F("1.48")))
        for gaps in ((), (Avoids(PlasticMap(AT), short, PRINTED),), (less,)):
            with pytest.raises(Unproved, match=r"cover|avoid"):
                staying_set((PRINTED,), one, gaps)


def test_hypotheses_about_different_oscillators_are_refused():
    other = moved_to(cell(*B, "1.3", "1.35"), replace(PAPER, eta=F("0.2122")).place)
    with pytest.raises(Unproved, match="different maps"):
        made(SWAP[0], other)


def test_an_arrow_that_is_told_twice_makes_no_shift():
    alone, golden = made(FULL[0]), made(*GOLDEN)
    for told, onward in ((alone, ((0, 0),)), (golden, ((1, 1), (0, 1))), (golden, ((1,), (1, 0)))):
        with pytest.raises(Unproved, match="path"):
            replace(told, onward=onward)


def test_a_full_shift_is_in_order_of_phase_or_nothing():
    shift = made(*FULL)
    for cells in (shift.cells[::-1], shift.cells[:1], (shift.cells[0],) * 2):
        with pytest.raises(Unproved):
            replace(shift, cells=cells)
    with pytest.raises(Unproved):
        replace(shift, slopes=((F(1), F(2)),) * 2)
    for whole in (made(*SWAP), made(*GOLDEN), made(*FULL, region=(A_AND, B_AND))):
        with pytest.raises(Unproved, match="over the region"):
            replace(whole, whole=True)


@pytest.mark.parametrize(("claim", "one_orbit"), [("G5", "VERIFIED"), ("G11", "REFUTED")])
def test_another_set_is_decided_by_what_stays_in_the_printed_interval(claim, one_orbit):
    """One orbit is an invariant set, but not one like the first; it must not be in the first."""

    def verdict(*found):
        return find(claim).decide(PAPER, found).verdict

    full, swap = made(*FULL), made(*SWAP)
    assert verdict(full) is Verdict.VERIFIED
    assert verdict(made(*GOLDEN)) is Verdict.UNDECIDED
    assert verdict(swap) is Verdict(one_orbit)
    assert (
        verdict(replace(swap, cells=(Phases(F("1.2"), F("1.21")), Phases(F("1.3"), F("1.31")))))
        is Verdict.UNDECIDED
    )
    assert verdict() is Verdict.UNDECIDED
    wider = Phases(F("1.31"), F("1.49"))
    assert verdict(replace(full, region=(wider,))) is Verdict.UNDECIDED
    assert verdict(replace(swap, region=(wider,))) is Verdict.UNDECIDED
    elsewhere = replace(PAPER, eta=F("0.2122"))
    assert verdict(moved_to(swap, elsewhere.place)) is Verdict.UNDECIDED
    there = find(claim).decide(elsewhere, [moved_to(swap, elsewhere.place)])
    assert there.verdict is Verdict.UNDECIDED and "printed" in there.why


def test_a_graph_like_that_on_the_first_interval_would_leave_a_fixed_phase():
    """G20: an orbit of period 2 alone refutes it; f at the ends is told beside."""
    row, swap = find("G20"), made(*SWAP)
    ends = [
        Impact(AT, F("1.32"), (F(6), F(7)), Phase(F("1.337"), F("1.338"))),
        Impact(AT, F("1.48"), (F(5), F(6)), Phase(F("1.438"), F("1.439"))),
    ]
    elsewhere = replace(ends[0], phase=F("1.4"))
    decision = row.decide(PAPER, [swap, *ends, elsewhere])
    assert decision.verdict is Verdict.REFUTED and decision.because == (*ends, swap)
    fixed = made(cell("1.32", "1.34", "1.3", "1.5"))
    wider = replace(swap, region=(Phases(F("1.31"), F("1.49")),))
    for found in ([], ends, [made(*FULL)], [made(*GOLDEN)], [fixed], [wider]):
        assert row.decide(PAPER, found).verdict is Verdict.UNDECIDED


# -- the branches ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("phase", "turns"), [("1.25", 60), ("1.45", 60), ("1.6", 900)])
def test_every_meeting_is_in_a_window(phase, turns):
    """Where brute force has the mass on or below the table, the windows must look."""
    motion = Motion(PAPER.place, (F(phase), F(phase)), BITS)
    found = list(Meetings.of(motion).before(turns))
    last = 2 * math.pi * (turns - 1)
    times = [i * math.pi / 50 for i in range(10, int(50 * last / math.pi))]
    met = [t for t in times if distance(float(phase), t) <= 0]
    assert met
    assert all(any(low <= t <= high for low, high in found) for t in met)
    assert len(found) < turns / 2


def test_an_impact_in_the_first_turn_is_not_overlooked():
    time, _ = true_map("2.2")
    assert time + 2.2 - math.pi / 2 < 3 * math.pi
    witness = {"cuts": ["11/5", "22001/10000"], "turn": "5", "ends": ["40"]}
    with pytest.raises(Unproved, match="an earlier impact is not excluded"):
        apply("branch", witness)


@pytest.mark.slow
def test_a_long_flight_is_proved_by_prover_and_checker():
    """phi = 1.6: the first impact is in turn 844, after some 5300 units of time."""
    phase, found = 1.6, Candidates(SYSTEM, 1500).impact(1.6)
    assert found.turn == 844
    assert abs(distance(phase, found.time)) < 1e-10
    steps = [i * 0.003 for i in range(40, int(found.time / 0.003) - 4)]
    assert all(distance(phase, t) > 0 for t in steps[::7])
    witness = {
        "cuts": ["15999/10000", "16001/10000"],
        "turn": "844",
        "ends": [str(F(round((found.time + 0.02) * 1000), 1000))],
    }
    branch = apply("branch", witness)
    assert branch.times[0] < F(found.time) < branch.times[1]
    for turn in ("843", "845", "811"):
        with pytest.raises((Unproved, Malformed)):
            apply("branch", {**witness, "turn": turn})


def test_at_the_end_of_a_window_the_gap_is_negative_for_all_launches(small):
    """Between the impacts of the first and of the last launch of a piece some are still to come."""
    witness = small[0][first(small[0], "branch")]["witness"]
    apply("branch", witness)
    between = F(sum(true_map(phase)[0] for phase in witness["cuts"][:2]) / 2)
    with pytest.raises(Unproved, match="negative at an end"):
        apply("branch", {**witness, "ends": [str(between), *witness["ends"][1:]]})


def test_what_is_remembered_of_a_branch_is_not_said_of_another(small):
    branch = small[2].branches[0]
    phase, time = min(branch._proved)
    assert branch.image(phase, time) == (phase + time[0], phase + time[1])
    other = replace(branch, at=replace(PAPER, nu=F("-0.21")).place)
    with pytest.raises(Unproved, match="signs"):
        other.image(phase, time)


def test_an_impact_overlooked_is_refused():
    """phi = 1.6: the gap falls through 0 in turn 877 too, 33 turns after the first impact."""
    bottom = math.pi / 2 - 1.6 + 2 * math.pi * 877
    assert distance(1.6, bottom - 0.1) > 0 > distance(1.6, bottom - 0.05)
    end = str(F(round((bottom - 0.05) * 1000), 1000))
    cuts = ["15999/10000", "16001/10000"]
    with pytest.raises(Unproved, match="an earlier impact is not excluded"):
        apply("branch", {"cuts": cuts, "turn": "877", "ends": [end]})


@pytest.mark.parametrize("nu", ["1/5", "-1", "-3/2"])
def test_windows_are_for_moderate_amplitudes_only(small, nu):
    steps, _, _ = small
    witness = steps[first(steps, "branch")]["witness"]
    with pytest.raises(Unproved, match="windows are known"):
        apply("branch", witness, of=replace(PAPER, nu=F(nu)))


# -- the covering graph ----------------------------------------------------------------------------


def test_a_few_branches_beat_log_3(small, graphs):
    _, name, graph = small
    again = graphs[name]
    assert again.growth == graph.growth > F("3.4")
    assert [branch.turn for branch in again.branches] == [4, 9, 14, 5]
    assert oracle(again, random.Random(1)) == []
    assert float(again.entropy[0]) <= math.log(graph.growth) <= float(again.entropy[1]) + 1e-15
    assert find("G9").decide(PAPER, [again]).verdict is Verdict.VERIFIED


def later_zero(w):
    """The last phase before f jumps: the gap falls through 0 again at a time near 56.17."""
    entry = next(x for x in w["images"] if 1.19 < F(x["phase"]) < 1.2)
    time = 55.0
    while distance(float(F(entry["phase"])), time) > 0:
        time += 0.001
    entry["time"] = [str(F(round(time * 1000) + shift, 1000)) for shift in (-2, 2)]


GRAPH_LIES = {
    "a later zero": later_zero,
    "no growth": lambda w: w.update(growth="1/2"),
    "a negative value": lambda w: w["weights"].__setitem__(0, "-1"),
    "all values 0": lambda w: w.update(weights=["0"] * len(w["weights"])),
}


@pytest.mark.every
@pytest.mark.parametrize("lie", GRAPH_LIES)
def test_a_forged_graph_is_refused(small, graphs, lie):
    steps, name, _ = small
    refused(graphs, steps, name, GRAPH_LIES[lie])


def test_a_state_has_no_part_in_a_branch_beside_it(small, graphs):
    """D = [1.1, 1.11] covers itself once, by the first branch only."""
    steps, name, _ = small
    images = steps[name]["witness"]["images"]
    for phase in ("11/10", "111/100"):
        time = F(round(Candidates(SYSTEM, 20).impact(float(F(phase))).time * 10**6))
        bracket = [str((time + shift) / 10**6) for shift in (-1, 1)]
        images = [*images, {"phase": phase, "time": bracket}]
    witness = {
        "branches": steps[name]["witness"]["branches"],
        "images": images,
        "states": [["11/10", "111/100"]],
        "weights": ["1"],
    }
    found = apply("covering-graph", {**witness, "growth": "1"}, known=graphs)
    assert found.growth == 1
    with pytest.raises(Unproved, match="does not multiply"):
        apply("covering-graph", {**witness, "growth": "2"}, known=graphs)


def test_g9_without_enough_growth_is_undecided():
    branch = Branch(AT, (F(1), F("1.1")), 4, ((F(24), F(25)),))
    weak = EntropyBound(PlasticMap(AT), (branch,), 1, F("1.9"))
    undecided = find("G9").decide(PAPER, [weak])
    assert undecided.verdict is Verdict.UNDECIDED
    assert {*undecided.quantities} == {"entropy_lower_bound"}  # the entropy is more, see G17
    assert find("G9").decide(PAPER, []).verdict is Verdict.UNDECIDED
    nothing = find("G9").decide(PAPER, [replace(weak, growth=F(1))])  # "at least log 1"
    assert nothing == find("G9").decide(PAPER, [])
