"""Sticking, flights that never end, and how much of the circle sticks in the end.

Expected values come from `reference` (equation (10) typed by hand, mpmath at 50 digits), from
closed forms, and from brute force over flights in floating point.
"""

import copy
import json
import random
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf

from intervals import Undecided
from proofs.motion.impact import HORIZON
from proofs.motion.landing import prove_never
from proofs.motion.system import System
from proofs.report.circle_figure import proved
from proofs.search import s34_circle as circle
from proofs.search.s34_absorbing import Partition
from proofs.search.steps import Prover
from proofs.shell.groups import certificate, decide
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.absorption import Cell, absorbed, links
from proofs.trusted.paper.s34_circle.circle_rules import RULES
from proofs.trusted.paper.s34_circle.landing import Absorption, NeverImpacts, Separation
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check, find_rule
from tests.proofs.trusted.paper import reference

ETA, NU = mpf("0.2121"), mpf("-0.2")
SYSTEM = System(PAPER.eta, PAPER.nu)


def third(low, high, image):
    return Cell((Fraction(low), Fraction(high)), image, Fraction(1, 3))


# -- bookkeeping ---------------------------------------------------------------------------------


def test_what_is_left_of_the_middle_thirds():
    """x -> 3x mod 1, absorbed in the open middle third: (2/3)^(n + 1) is left after n steps."""
    whole = ((Fraction(0), Fraction(1)),)
    cells = [third(0, Fraction(1, 3), whole), third(Fraction(2, 3), 1, whole)]
    found = absorbed(cells, links(cells), 12)
    for n, rest in enumerate(found.rest):
        assert 0 <= rest - Fraction(2, 3) ** (n + 1) < Fraction(1, 2**55)
    assert found.steps == (None, None)


def test_absorbed_cells_one_after_the_other():
    ends = [Fraction(i) for i in range(5)]
    cells = [
        Cell((a, b), () if i == 0 else ((ends[i - 1], ends[i]),))
        for i, (a, b) in enumerate(pairwise(ends))
    ]
    # an image that only touches the next cell counts as meeting it
    assert absorbed(cells, links(cells), 6).steps == (1, None, None, None)
    inner = [Cell(cells[0].phases, ())]
    quarter = Fraction(1, 4)
    inner += [
        Cell(cell.phases, ((cell.phases[0] - 3 * quarter, cell.phases[0] - quarter),))
        for cell in cells[1:]
    ]
    found = absorbed(inner, links(inner), 6)
    assert found.steps == (1, 2, 3, 4)
    assert found.rest == (4, 3, 2, 1, 0, 0, 0)


def test_an_unknown_cell_is_never_absorbed_and_blocks_others():
    unit = Fraction(1)
    cells = [Cell((0 * unit, unit)), Cell((unit, 2 * unit), ((unit / 4, unit / 2),), unit)]
    found = absorbed(cells, links(cells), 3)
    assert found.steps == (None, None)
    assert found.rest[-1] >= Fraction(5, 4)  # the whole first cell, and a quarter of the second


def test_overlapping_cells_are_refused():
    with pytest.raises(ValueError, match="overlap"):
        links([Cell((Fraction(0), Fraction(2))), Cell((Fraction(1), Fraction(3)))])


# -- separation ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def arc():
    prover = Prover(SYSTEM, 30, HORIZON)
    return prover, *circle.prove_arc(prover)


def inside(bounds, value, digits=30):
    low, high = (mpf(x.numerator) / x.denominator for x in bounds)
    return low <= value <= high and high - low < mpf(10) ** -digits


def test_separation_against_fifty_digits(arc):
    found = arc[2]
    phase = reference.separation_phase(ETA, NU)
    assert inside(found.phase, phase)
    assert inside(found.start, 3 * mp.pi - phase)
    time = mp.findroot(lambda t: reference.left_side_10(ETA, NU, phase, t), mpf("23.7278"))
    assert inside(found.time, time)
    assert inside(found.arrival, (phase + time) % (2 * mp.pi))
    assert mp.nstr((phase + time) % (2 * mp.pi), 10) == "4.640489737"
    assert found.returns


def run(rule, witness, known=None, of=PAPER):
    return RULES[rule](of, known or {}, Reader(copy.deepcopy(witness)))


def moved(values, by):
    return [str(Fraction(value) + by) for value in values]


@pytest.mark.parametrize("field", ["phase", "time"])
@pytest.mark.parametrize("by", [Fraction(1, 10**20), Fraction(-1, 10**20), Fraction(1)])
def test_a_moved_separation_is_refused(arc, field, by):
    witness = arc[0].steps["separation-1"]["witness"]
    assert isinstance(run("separation", witness), Separation)
    with pytest.raises(Unproved):
        run("separation", witness | {field: moved(witness[field], by)})


def test_a_phase_that_flies_is_no_separation():
    """The flights from [6.05, 6.0501] end between 23.7 and 23.75, but the launches do not stick."""
    phases = ["121/20", "60501/10000"]
    with pytest.raises(Unproved, match="does not change sign"):
        run("separation", {"phase": phases, "time": ["237/10", "95/4"]})


def test_separation_needs_a_soft_spring_and_a_table_above():
    witness = {"phase": ["6", "61/10"], "time": ["23", "24"]}
    for change in ({"eta": Fraction(3, 2)}, {"nu": Fraction(1, 5)}, {"nu": Fraction(-3, 2)}):
        of = circle.Parameters(**{**vars(PAPER), **change})
        with pytest.raises(Unproved):
            run("separation", witness, of=of)


# -- flights that never end ----------------------------------------------------------------------


def least_gap(phase, oscillations=2121):
    """The least gap near all closest approaches but the launch, by the amplitude and angle of X."""
    eta, nu = 0.2121, -0.2
    height, speed = 1 + nu * np.sin(phase), nu * np.cos(phase) / eta
    size, angle = np.hypot(height, speed), np.arctan2(speed, height)
    m = np.arange(1, oscillations)
    lag = (angle / eta + phase + 2 * np.pi * ((m * 10000) % 2121) / 2121) % (2 * np.pi)
    s = np.linspace(-0.02, 0.02, 4001)
    return min(
        float(np.min(1 + nu * np.sin(s + one) - size * np.cos(eta * s)))
        for one in lag[np.abs(lag - np.pi / 2) < 0.1]
    )


@pytest.fixture(scope="module")
def never():
    prover = Prover(SYSTEM, 30, HORIZON)
    name, found = circle.prove_longest(prover)
    return prover.steps[name]["witness"], found


def test_phases_that_never_impact_by_brute_force(never):
    low, high = map(float, never[1].phases)
    for phase in np.linspace(low, high, 9):
        assert least_gap(phase) > 0
    for phase in (low - 2e-8, high + 2e-8):  # the interval is the longest, but for a few 1e-9
        assert least_gap(phase) < 0


def test_the_motion_repeats_after_twenty_thousand_pi():
    eta, phase = mpf("0.2121"), mpf("1.5709")
    assert abs(reference.left_side_10(eta, NU, phase, 20000 * mp.pi)) < mpf(10) ** -40


def test_longer_intervals_are_refused(never):
    low, high = never[1].phases
    step = run("never-impacts", never[0])
    assert step == NeverImpacts((low, high))
    further = Fraction(1, 10**7)
    for phases in ((low - further, high), (low, high + further), (Fraction(1), Fraction(2))):
        with pytest.raises(Unproved):
            run("never-impacts", {"phases": [str(x) for x in phases]})
        with pytest.raises(Undecided):
            prove_never(SYSTEM, phases)


@pytest.mark.parametrize("turns", [1, -1])
def test_the_interval_a_turn_later_is_refused(never, turns):
    far = Fraction("6.283185307") * turns
    phases = [str(x + far) for x in never[1].phases]
    with pytest.raises((Unproved, Malformed)):
        run("never-impacts", {"phases": phases})


def test_a_launch_that_sticks_is_no_flight():
    """At (eta, nu) = (1/2, -1/10) the launch acceleration at pi/2 is 0.075 - 0.25 < 0."""
    of = circle.Parameters(**{**vars(PAPER), "eta": Fraction(1, 2), "nu": Fraction(-1, 10)})
    with pytest.raises(Unproved):
        run("never-impacts", {"phases": ["157/100", "1571/1000"]}, of=of)
    with pytest.raises(Undecided):
        prove_never(System(of.eta, of.nu), (Fraction("1.57"), Fraction("1.571")))


def test_another_frequency_has_another_interval(never):
    """With eta = 2121/9999 = 7/33 the motion repeats after 33 turns: far more phases are free."""
    of = circle.Parameters(**{**vars(PAPER), "eta": Fraction(2121, 9999)})
    wide = Prover(System(of.eta, of.nu), 30, HORIZON)
    _, found = circle.prove_longest(wide)
    assert found.phases[1] - found.phases[0] > 100 * (never[1].phases[1] - never[1].phases[0])
    with pytest.raises(Unproved):
        run("never-impacts", wide.steps["never-impacts-1"]["witness"])


# -- the circle ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def coarse(arc):
    """A coarse partition: few branches, wide cells, 12 impacts."""
    prover = Prover(SYSTEM, 30, HORIZON)
    separation = circle.prove_arc(prover)
    step = Partition(prover, separation, finest=1e-2, turns=25, impacts=12).prove()
    proof = {"G3": [separation, step], "G4": [separation, circle.prove_longest(prover), step]}
    entries = [decide(claim, PAPER, rests, 30)[1] for claim, rests in proof.items()]
    return certificate(PAPER, prover.steps, entries), step[1]


def impacts_until_stuck(phase, most=200):
    """The number of impacts before the sticking arc, by scanning (10); None if it is large."""
    start, leave = (float(x) for x in (3 * mp.pi - reference.separation_phase(ETA, NU), 0))
    leave = float(reference.separation_phase(ETA, NU))
    for count in range(most):
        if start < phase < leave:
            return count
        found = next_phase(phase)
        if found is None:
            return None
        phase = found
    return None


def next_phase(phase, horizon=3000.0):
    """The next impact by marching (10) in steps of 0.01, in floating point; f(phase)."""
    eta, nu = 0.2121, -0.2
    for begin in np.arange(0.0, horizon, 100.0):
        t = begin + np.arange(1, 10001) * 0.01
        gap = -(
            (1 + nu * np.sin(phase)) * np.cos(eta * t)
            + nu / eta * np.cos(phase) * np.sin(eta * t)
            - 1
            - nu * np.sin(phase + t)
        )
        below = np.flatnonzero(gap < 0)
        if below.size:
            k = below[0]
            before = gap[k - 1] if k else 0.0
            return float((phase + t[k] - 0.01 * gap[k] / (gap[k] - before)) % (2 * np.pi))
    return None


def test_absorbed_phases_stick_as_soon_as_is_said(coarse):
    rng = random.Random(1)
    for (low, high), steps in coarse[1].within:
        for _ in range(3):
            phase = rng.uniform(float(low), float(high)) % float(2 * mp.pi)
            count = impacts_until_stuck(phase)
            assert count is not None
            assert count <= steps


@pytest.mark.slow
def test_the_measure_against_a_sample(coarse):
    """Of 600 phases spread evenly no more are left than the bounds say, but for chance."""
    phases = (np.arange(600) + 0.5) / 600 * 2 * np.pi
    counts = [impacts_until_stuck(float(x), 6) for x in phases]
    for n in (0, 1, 2, 3, 5):
        share = sum(count is None or count > n for count in counts) / 600
        assert share <= float(coarse[1].rest[n]) / (2 * np.pi) + 0.01
        assert share >= float(coarse[1].rest[n]) / (2 * np.pi) - 0.05


def test_the_coarse_certificate_is_accepted(coarse):
    report = check(json.dumps(coarse[0]))
    assert [claim.verdict for claim in report.claims] == [Verdict.VERIFIED, Verdict.REFUTED]


@pytest.fixture(scope="module")
def derived(coarse):
    """What the checker derives from each step of the coarse certificate."""
    return derive(coarse[0]["steps"], coarse[0]["steps"], {})


def derive(steps, originals, known):
    """Derive all steps; those that are as they were, and name none that is not, are known."""
    result = {}
    for name, step in steps.items():
        if step == originals[name] and name in known:
            result[name] = known[name]
        else:
            rule, witness = find_rule(step["rule"]), copy.deepcopy(step["witness"])
            result[name] = rule(PAPER, result, Reader(witness))
    return result


def _absorption(steps):
    return steps["absorption-1"]["witness"]


def _first_lands(steps):
    return steps["lands-1"]["witness"]


def _set(values, index, by):
    values[index] = str(Fraction(values[index]) + by)


def _grazing(steps):
    return steps["first-impact-1"]["witness"]["phases"]


def _turning(steps):
    """The cells of a branch whose window begins before a zero of sin(eta t)."""

    def half_turns(time):
        return mp.floor(ETA * mpf(float(Fraction(time))) / mp.pi)

    return next(
        cell
        for cell in _absorption(steps)["cells"]
        if half_turns(cell["after"]) > half_turns(_branch(steps, cell).begin)
    )


def _branch(steps, cell):
    return prove_branch(PAPER, {}, Reader(steps[cell["branch"]]["witness"]))


def _late(steps, cell):
    """A time after the first impact, and before the windows of all impacts end."""
    return (min(map(Fraction, cell["times"])) + min(_branch(steps, cell).ends)) / 2


prove_branch = find_rule("branch")
UNIT = Fraction(1, 10**7)
EDITS = {
    "less is left": (
        lambda s: _set(_absorption(s)["rest"], 3, -Fraction(1, 1000)),
        "more may be left",
    ),
    "less is left at first": (lambda s: _set(_absorption(s)["rest"], 0, -1), "more may be left"),
    "nothing is left later": (lambda s: _absorption(s)["rest"].append("0"), "more may be left"),
    "absorbed sooner": (lambda s: _set(_absorption(s)["within"][2], 2, -1), "so soon"),
    "absorbed further": (
        lambda s: _absorption(s)["within"].append(["1", "3/2", "12"]),
        "so soon",
    ),
    "a grazing phase absorbed at once": (
        lambda s: _absorption(s)["within"].append([*_grazing(s), "1"]),
        "so soon",
    ),
    "sin(eta t) changes sign": (
        lambda s: _turning(s).update(after=str(_branch(s, _turning(s)).begin)),
        "one sign",
    ),
    "an impact before the time given": (
        lambda s: _turning(s).update(after=str(_late(s, _turning(s)))),
        "not excluded",
    ),
    "a cut moved": (
        lambda s: _set(_absorption(s)["cells"][0]["cuts"], 2, UNIT),
        "signs",
    ),
    "a time moved": (lambda s: _set(_absorption(s)["cells"][0]["times"], 2, UNIT), "signs"),
    "a later start": (
        lambda s: _absorption(s)["cells"][1].update(after="1000"),
        "begins later, or ends before",
    ),
    "an earlier start": (
        lambda s: _absorption(s)["cells"][1].update(after="0"),
        "begins later, or ends before",
    ),
    "another branch": (
        lambda s: _absorption(s)["cells"][0].update(branch="branch-2"),
        "outside the branch",
    ),
    "a grazing phase twice": (
        lambda s: _absorption(s)["impacts"].append("first-impact-1"),
        "overlap",
    ),
    "cells twice": (
        lambda s: _absorption(s)["cells"].append(_absorption(s)["cells"][0]),
        "overlap",
    ),
    "no landing above": (lambda s: _absorption(s)["lands"].pop(), "2 to|entries"),
    "landing above twice": (
        lambda s: _absorption(s).update(lands=["lands-2", "lands-2"]),
        "do not reach",
    ),
    "a branch for an arc": (
        lambda s: _absorption(s).update(separation="branch-1"),
        "Separation",
    ),
    "more turns": (lambda s: _first_lands(s).update(turns="4"), "earlier impact"),
    "fewer turns": (lambda s: _first_lands(s).update(turns="2"), "not negative"),
    "no turns": (lambda s: _first_lands(s).update(turns="0"), "stay up"),
    "landing further": (lambda s: _set(_first_lands(s)["cuts"], -1, Fraction(1, 10)), "negative"),
    "landing from before": (lambda s: _set(_first_lands(s)["cuts"], 0, -4), "stay up"),
    "landing from sooner": (
        lambda s: _set(s["lands-2"]["witness"]["cuts"], 0, -UNIT),
        "not negative",
    ),
    "landing from the arc": (
        lambda s: s["lands-2"]["witness"].update(cuts=["-1", "3"]),
        "stay up",
    ),
    "an earlier impact after the separation": (
        lambda s: _set(s["separation-1"]["witness"]["time"], 1, -1),
        "reversed",
    ),
}


@pytest.mark.parametrize("name", EDITS)
def test_edited_steps_are_refused(coarse, derived, name):
    edit, message = EDITS[name]
    steps = copy.deepcopy(coarse[0]["steps"])
    edit(steps)
    with pytest.raises((Unproved, Malformed), match=message):
        derive(steps, coarse[0]["steps"], derived)


def test_a_later_crossing_is_not_the_first_impact(coarse, derived):
    """The gap, continued below the table, falls through 0 again later: signs +, - there too."""
    steps = copy.deepcopy(coarse[0]["steps"])
    cell = _absorption(steps)["cells"][0]
    cut, first = float(Fraction(cell["cuts"][1])), float(Fraction(cell["times"][1]))

    def gap(t):
        return -reference.left_side_10(ETA, NU, mpf(cut), t)

    grid = np.arange(first + 1, first + 60, 0.05)
    signs = [gap(mpf(t)) > 0 for t in grid]
    begin = next(t for t, u, v in zip(grid, signs, signs[1:], strict=False) if u and not v)
    root = mp.findroot(gap, (mpf(begin), mpf(begin + 0.05)), solver="anderson")
    unit = Fraction(1, 2**32)
    cell["times"][1] = str(int((root - mpf(2) ** -27) / unit.numerator * unit.denominator) * unit)
    with pytest.raises(Unproved, match="leaves the window"):
        derive(steps, coarse[0]["steps"], derived)


@pytest.mark.slow
def test_edited_entries_are_rejected(coarse):
    for index, field, value in (
        (0, "verdict", "REFUTED"),
        (1, "witness", "none"),
        (0, "proof", []),
    ):
        document = copy.deepcopy(coarse[0])
        document["claims"][index][field] = value
        with pytest.raises(Rejected):
            check(json.dumps(document))


def test_the_figure_draws_what_is_proved(coarse):
    bars, free = proved(json.dumps(coarse[0]))
    covered = sum(high - low for low, high, _ in bars)
    left = float(coarse[1].rest[-1])
    assert 2 * np.pi - 2 * left < covered < 2 * np.pi
    assert all(0 <= low < high <= 2 * np.pi for low, high, _ in bars)
    for low, high, count in bars:
        assert impacts_until_stuck(0.3 * low + 0.7 * high) <= count
    assert free == [
        tuple(
            float(Fraction(x)) for x in coarse[0]["steps"]["never-impacts-1"]["witness"]["phases"]
        )
    ]


# -- decisions -----------------------------------------------------------------------------------


def test_nothing_is_decided_without_conclusions():
    for claim in circle.CLAIMS:
        assert find(claim).decide(PAPER, []).verdict is Verdict.UNDECIDED


def test_nothing_is_claimed_where_the_mass_does_not_stick_and_fly():
    of = circle.Parameters(**{**vars(PAPER), "nu": Fraction(1, 5)})
    assert not any(circle.prove(of, circle.CLAIMS).proofs.values())


def test_an_orbit_elsewhere_is_not_the_printed_one(arc):
    found = arc[2]
    for other in (
        Separation(found.start, found.phase, found.time, (Fraction(5), Fraction("5.1"))),
        Separation(found.start, found.phase, found.time, (Fraction(1), Fraction("1.1"))),
    ):
        assert find("G2").decide(PAPER, [other]).verdict is Verdict.UNDECIDED
    late = Separation((Fraction("3.4"), Fraction("3.5")), found.phase, found.time, found.arrival)
    assert find("G1").decide(PAPER, [late]).verdict is Verdict.UNDECIDED


def test_without_free_phases_almost_every_is_open(arc):
    step = Absorption((Fraction(4), Fraction(1, 1000)), (((Fraction(-1), Fraction(1)), 1),))
    found = find("G4").decide(PAPER, [arc[2], step])
    assert found.verdict is Verdict.UNDECIDED
    assert found.quantities["basin_fraction"][0] > Fraction("0.999")


def test_stability_needs_phases_beyond_the_separation(arc):
    found = arc[2]
    beyond = (Fraction(-1, 4), Fraction(1, 2))
    for within, verdict in (
        ((beyond, 1), Verdict.VERIFIED),
        ((beyond, 2), Verdict.UNDECIDED),
        (((Fraction(-1, 5), Fraction(1, 2)), 1), Verdict.UNDECIDED),
    ):
        step = Absorption((Fraction(4), Fraction(1)), (within,))
        assert find("G3").decide(PAPER, [found, step]).verdict is verdict


# -- the command's own numbers -------------------------------------------------------------------


@pytest.mark.slow
def test_all_claims_at_the_papers_numbers():
    evidence = circle.prove(PAPER, circle.CLAIMS)
    verdicts = {}
    for claim in circle.CLAIMS:
        row, _ = decide(claim, PAPER, evidence.proofs[claim], 30)
        verdicts[claim] = row
    assert [verdicts[claim].verdict.value for claim in ("M6", "G1", "G2", "G3", "G4", "G6")] == [
        "CONDITIONAL",
        "VERIFIED",
        "CONDITIONAL",
        "VERIFIED",
        "REFUTED",
        "VERIFIED",
    ]
    low, high = verdicts["G4"].quantities["basin_fraction"]
    assert Fraction("0.9989") < low < high < Fraction("0.99993")
    low, high = verdicts["G6"].quantities["fixed_point"]
    assert low < Fraction("1.104775829127550847838252004") < high + Fraction(1, 10**27)
