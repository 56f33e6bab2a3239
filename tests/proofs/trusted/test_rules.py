"""Each inference rule takes true witnesses and refuses false ones.

The true times and phases below come from `reference` (equation (10) typed by hand, mpmath, 50
digits). At phase 1.2 the gap has a minimum of 1.06e-5 near time 25.874 and vanishes first at
56.16847...; at phase 1.15 it vanishes at 25.32582... and is positive again at 27.
"""

from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.laps import meets
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import RULES
from proofs.trusted.slopes import impact as impact_of
from proofs.trusted.slopes import impacts
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import apply as step
from tests.proofs.trusted.paper.steps import exact


def true_turn():
    ctx.prec = 400
    man, exp = (2 * arb.pi()).mid().man_exp()
    return Fraction(int(man)) * Fraction(2) ** int(exp)


TURN = true_turn()  # to 1e-118
TURNS = [k * TURN for k in range(-1, 170)]
numbers = st.fractions(0, 1000, max_denominator=10**6)

# -- witnesses -------------------------------------------------------------------------------------


def times(*values):
    return [str(Fraction(value)) for value in values]


def flight_time(phase):
    """The true time of the first impact, correct to some 40 digits."""
    return reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(phase))[0]


def refused(rule, witness, known=None, reason=None, error=(Unproved, Malformed)):
    with pytest.raises(error, match=reason):
        step(rule, witness, known)


# -- the first impact ------------------------------------------------------------------------------


def places(low, high, latest=100):
    """Where the first impact of the phases of an interval may be: phase + time."""
    f = PlasticMap(PAPER.place, Fraction(latest))
    x = enclosed(((Fraction(low), Fraction(high)),), 64)
    return [value.range for (value,) in f.possible_values(x)]


@pytest.mark.parametrize("phase", ["1.11", "1.15", "1.19998", "1.2", "1.3"])
def test_a_flight_has_one_impact_if_it_does_not_graze(phase):
    ((low, high),) = places(phase, phase)
    assert low < exact(flight_time(phase)) + Fraction(phase) < high < low + Fraction(1, 10)
    begin, end = PlasticMap(PAPER.place).window(enclosed(((Fraction(phase),) * 2,), 64))
    assert begin < exact(flight_time(phase)) < end


@pytest.mark.parametrize("phases", [("1.15", "1.27"), ("1.19", "1.2"), ("1.1999", "1.2001")])
def test_a_graze_is_not_passed_over(phases):
    """At 1.199985... the gap touches 0 at 25.87, and vanishes first at 56.2: f jumps."""
    early, late = places(*phases)
    low, high = map(Fraction, phases)
    for phase in (low, (low + high) / 2, Fraction("1.19998"), Fraction("1.19999"), high):
        image = exact(flight_time(f"{float(phase)}")) + phase
        assert any(begin < image < end for begin, end in (early, late))
    assert early[0] < Fraction("25.88") + high and late[1] > Fraction("56.1") + low
    with pytest.raises(Unproved, match=r"graze|transversal"):
        PlasticMap(PAPER.place).window(enclosed(((low, high),), 64))


@pytest.mark.parametrize("phase", ["4", "4.7", "5"])
def test_a_sticking_launch_is_refused(phase):
    """Where the launch acceleration is negative the mass sticks to the table first."""
    nu = mpf("-0.2")
    assert reference.launch_acceleration(mpf("0.2121"), nu, mpf(phase)) < 0
    with pytest.raises(Unproved, match="right after launch"):
        places(phase, phase)


@pytest.mark.parametrize(("latest", "phase"), [(25, "1.15"), (50, "1.2"), (100, "1.57")])
def test_an_impact_that_is_too_late_is_none(latest, phase):
    with pytest.raises(Unproved, match="before the time"):
        places(phase, phase, latest)


# -- f at a phase, and on an interval --------------------------------------------------------------

F = {"eta": ["2121/10000"] * 2, "nu": ["-1/5"] * 2}


def at_phase(phase, turns="4", bits="128"):
    box = [times(phase, phase)]
    return step("differential", {"function": F, "box": box, "turns": [turns], "bits": bits})


@pytest.mark.parametrize("phase", ["1.14", "1.1425", "1.15"])
def test_a_phase(phase):
    found = impact_of(at_phase(phase))
    flight, image = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(phase))
    slope = exact(reference.slope(mpf("0.2121"), mpf("-0.2"), mpf(phase), flight))
    near = Fraction(1, 10**17)
    assert found.phase == Fraction(phase)
    assert found.slope[0] - near < slope < found.slope[1] + near
    assert found.slope[1] - found.slope[0] < near
    assert found.image[0] <= exact(image) <= found.image[1] < found.image[0] + near


@pytest.mark.parametrize("turns", ["3", "5", "0"])
def test_a_phase_with_other_turns_says_nothing_of_f(turns):
    found = at_phase("1.14", turns)
    with pytest.raises(Unproved, match="straddles"):
        impact_of(found)
    assert impacts([found]) == []


def test_only_f_at_one_phase_is_a_phase():
    wide = replace(at_phase("1.14"), box=((Fraction("1.14"), Fraction("1.15")),))
    with pytest.raises(Unproved, match="one phase"):
        impact_of(wide)


@pytest.mark.parametrize(
    ("phase", "reason"),
    [("4", "right after launch"), ("4.7", "right after launch"), ("1.57", "before the time")],
)
def test_a_phase_that_sticks_or_never_impacts_is_refused(phase, reason):
    with pytest.raises(Unproved, match=reason):
        enclosed_at = enclosed(((Fraction(phase),) * 2,), 64)
        PlasticMap(PAPER.place, Fraction(100)).values(enclosed_at)


def between_114_and_115(**change):
    witness = {"function": F, "points": ["57/50", "23/20"], "bits": "64"}
    return step("slopes", witness | change)


def test_slopes_contain_the_slopes_between():
    found = between_114_and_115()
    ((low, high),) = found.pieces
    for share in range(11):
        phase = mpf("1.14") + mpf(share) / 1000
        flight = reference.first_impact(mpf("0.2121"), mpf("-0.2"), phase)[0]
        assert low <= exact(reference.slope(mpf("0.2121"), mpf("-0.2"), phase, flight)) <= high
    assert low == found.slopes[0][0] and high == found.slopes[1][1]  # as f'' > 0


@pytest.mark.parametrize("points", [("1.19", "1.21"), ("1.1", "1.3"), ("3.3", "3.4")])
def test_slopes_across_a_graze_or_where_sticking_begins_are_refused(points):
    with pytest.raises(Unproved, match=r"graze|launch|transversal"):
        between_114_and_115(points=times(*points))


# -- avoids ----------------------------------------------------------------------------------------


def avoided(target, *points):
    """What is proved of f, whose values on [1.14, 1.15] are [1.283..., 1.343...]."""
    points = points or ("1.14", "1.1425", "1.145", "1.1475", "1.15")
    witness = {"function": F, "points": times(*points), "target": times(*target)}
    return step("avoids", witness)


@pytest.mark.parametrize("target", [("2", "6"), ("1.35", "6.28"), ("0", "1.27")])
def test_avoids(target):
    found = avoided(target)
    assert found.source == (Fraction("1.14"), Fraction("1.15"))
    assert found.target == tuple(map(Fraction, target))


@pytest.mark.parametrize(
    "target", [("1.3", "1.32"), ("1.34", "6"), ("0", "1.29"), ("0", "6.28"), ("1.34308", "1.34309")]
)
def test_avoids_refuses_a_target_that_is_entered(target):
    with pytest.raises(Unproved, match="miss"):
        avoided(target)


@pytest.mark.parametrize(
    ("target", "points", "reason"),
    [
        (("6", "2"), (), "reversed"),
        (("2", "2"), (), "no interval"),
        (("6", "6.2832"), (), "straddles"),
        (("2", "6"), ("1.15", "1.14"), "increase"),
        (("2", "6"), ("1.14", "1.14"), "increase"),
        (("2", "6"), ("1.14",), "entries"),
        (("2", "6"), ("1.14", "6.29"), "straddles"),
        (("2", "6"), ("4", "4.1"), "right after launch"),
    ],
)
def test_avoids_is_about_two_intervals(target, points, reason):
    with pytest.raises((Unproved, Malformed), match=reason):
        avoided(target, *points)


@pytest.mark.parametrize(("target", "holds"), [("1.94", 0), ("0.82", 0), ("1.3", 1), ("3", 1)])
def test_avoids_counts_every_impact_that_may_be_the_first(target, holds):
    """At the graze f jumps from 1.941606... to 0.819753...: launches around it have both."""
    ends, points = (target, Fraction(target) + Fraction(1, 100)), ("1.1999", "1.2001")
    if holds:
        assert avoided(ends, *points)
    else:
        with pytest.raises(Unproved, match="miss"):
            avoided(ends, *points)


@pytest.mark.parametrize(
    ("phases", "time", "target", "expected"),
    [
        (("1", "1"), ("5.1", "5.2"), ("6.2001", "6.25"), False),
        (("1", "1"), ("5.1", "5.2"), ("6.2", "6.25"), True),
        (("1", "1"), ("5.1", "5.3"), ("0", "0.01"), True),  # 6.1 to 6.3: past 2 pi
        (("1", "1"), ("5.29", "5.3"), ("0", "0.001"), False),  # 6.29 to 6.3: past 0.0068
        (("1", "1"), ("5.29", "5.3"), ("0.0069", "0.01"), True),
        (("1", "1"), ("5.283185307", "5.4"), ("6.283", "6.283185307"), True),
        (("0", "6"), ("1", "2"), ("3", "3"), True),
        (("0", "0"), ("100", "107"), ("3", "3.1"), True),  # more than one turn
        (("0", "0"), ("0", "0.001"), ("0", "0"), True),
        (("0.5", "0.5"), ("62.83", "62.84"), ("0.4", "0.6"), True),  # ten turns, nearly
        (("0.5", "0.5"), ("62.83", "62.84"), ("0", "0.49"), False),
        (("0.5", "0.5"), ("62.83", "62.84"), ("0.51", "6.28"), False),
    ],
)
def test_meets_mod_two_pi(phases, time, target, expected):
    values = tuple(Fraction(x) + Fraction(t) for x, t in zip(phases, time, strict=True))
    target = tuple(map(Fraction, target))
    assert meets(PlasticMap(PAPER.place), values, target) is expected


@pytest.mark.slow
@settings(max_examples=300)
@given(
    numbers,
    st.fractions(0, 7, max_denominator=50),
    st.fractions(0, 6, max_denominator=50),
    st.fractions(0, 2, max_denominator=50),
)
def test_what_meets_is_never_missed(time, width, start, length):
    target = (start, min(start + length, Fraction(628, 100)))
    if not meets(PlasticMap(PAPER.place), (time, time + width), target):
        low, high = time - target[1], time + width - target[0]
        assert not any(low <= turns <= high for turns in TURNS)


# -- moran-root ------------------------------------------------------------------------------------

S0 = Fraction("0.448989707406679150108086734513027704911016535")
PRINTED = times("0.1905", "0.2381")
S0_GUESS = "0.4489897074066791501"


def root(low, high, ratios=PRINTED):
    return {"ratios": list(ratios), "root": times(low, high)}


@pytest.mark.parametrize("reach", ["0.4", "1e-3", "1e-15", "1e-30", "1e-42"])
def test_moran_root(reach):
    found = step("moran-root", root(S0 - Fraction(reach), S0 + Fraction(reach)))
    assert found.root[0] < S0 < found.root[1]
    s = mp.findroot(lambda s: mpf("0.1905") ** s + mpf("0.2381") ** s - 1, 0.45)
    assert abs(exact(s) - S0) < Fraction(1, 10**42)


# -- signs that no precision decides ---------------------------------------------------------------


@cache
def to_1400_digits(find):
    with mp.workdps(1420):
        return Fraction(mp.nstr(find(), 1400))


def root_of_moran():
    return mp.findroot(lambda s: mpf("0.1905") ** s + mpf("0.2381") ** s - 1, S0_GUESS)


def thin(find, shift):
    """A bracket 10^-1300 wide, beside a number that `find` computes to 1400 digits."""
    low = to_1400_digits(find) + shift * Fraction(1, 10**1300)
    low = Fraction(low * 10**1310 // 1, 10**1310)
    return times(low, low + Fraction(1, 10**1300))


@pytest.mark.slow
@pytest.mark.parametrize(
    "shift", [2, *(pytest.param(shift, marks=pytest.mark.slow) for shift in (-2, 0))]
)
def test_an_undecided_sign_is_no_sign(shift):
    """At such brackets F is far below the checker's last place."""
    refused("moran-root", {"ratios": PRINTED, "root": thin(root_of_moran, shift)}, None, "signs")


# -- the form of every witness ---------------------------------------------------------------------


@pytest.mark.parametrize("rule", sorted(RULES))
@pytest.mark.parametrize("witness", [None, "1", [], {}, {"times": ["1"]}, {"phases": "1"}])
def test_malformed_witnesses(rule, witness):
    refused(rule, witness, {}, r"^\$", Malformed)
