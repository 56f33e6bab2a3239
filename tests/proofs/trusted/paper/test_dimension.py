"""H13: the dimension of the impact map's invariant sets, and what decides the claim."""

from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.shell import groups
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.itineraries import Itinerary
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phases
from proofs.trusted.paper import find
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000, StayingDimension
from proofs.trusted.paper.s32_sets.invariant import staying
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Found, Verdict
from proofs.trusted.verify import check
from tests.proofs.trusted.paper import periodic_dimension
from tests.proofs.trusted.paper.steps import evidence

SLOPES = (Fraction(2), Fraction(9))
LEFT, RIGHT = (Fraction("1.1"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32"))
HULL = (LEFT[0], RIGHT[1])


def conclusions():
    return [found for _, found in evidence("dimension").proofs["H13"]]


def one(kind, **fields):
    (found,) = (
        each
        for each in conclusions()
        if isinstance(each, kind) and all(getattr(each, k) == v for k, v in fields.items())
    )
    return found


def decide(found, of=PAPER):
    return find("H13").decide(of, found)


# -- the numbers -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_ten_digits_by_periodic_orbits():
    values = {
        FULL: periodic_dimension.dimension(7),
        WITHOUT_000: periodic_dimension.dimension(6, periodic_dimension.blocks),
    }
    repellers = [each for each in conclusions() if isinstance(each, Repeller)]
    assert {each.words for each in repellers} == set(values)
    for each in repellers:
        low, high = each.dimension
        rounding = Fraction(1, 10**14)
        assert low - rounding < values[each.words] < high + rounding
        assert high - low < Fraction(1, 10**10)


@pytest.mark.slow
def test_the_slopes_are_those_of_the_branches():
    """1 / g' at the ends of I, and the extremes in between, by equations typed by hand."""
    for letter, (low, high) in enumerate(one(Repeller, words=FULL).slopes):
        seen = [
            periodic_dimension.inverse(letter, float(1.1 + 0.22 * k / 20))[1] for k in range(21)
        ]
        assert low <= min(seen) and max(seen) <= high
        assert high - low < 1.3 * (max(seen) - min(seen)) + 0.3


# -- the verdict -----------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_paper_is_refuted():
    found = decide(conclusions())
    assert found.verdict is Verdict.REFUTED and "without the factor 000" in found.witness
    assert found.theorem.count("the Hausdorff dimension of Lambda lies between") == 2
    for name, value in (
        ("dimension", "0.425083744300103"),
        ("dimension_of_I", "0.367465319782449"),
        ("s0", "0.448989707406679"),
    ):
        low, high = found.quantities[name]
        assert low < Fraction(value) + Fraction(1, 10**15) and Fraction(value) < high


@pytest.mark.slow
@pytest.mark.parametrize("of", [PAPER, replace(PAPER, left=LEFT, right=RIGHT, interval=HULL)])
def test_a_set_around_i_bounds_from_above(of):
    """The sets that are proved themselves, too."""
    found = [each for each in conclusions() if getattr(each, "words", None) != WITHOUT_000]
    for decision in (decide(found, of), *([] if of is PAPER else [decide(conclusions(), of)])):
        assert decision.verdict is Verdict.REFUTED and "0.42508" in decision.why
        assert "dimension_of_I" not in decision.quantities and "full shift" in decision.theorem


@pytest.mark.parametrize("ratios", [("0.7", "0.8"), ("1/2", "1/2")])
def test_without_a_linear_set_none_is_spoken_of(ratios):
    """s_0 > 1 is a root of Moran's equation, and the dimension of no linear Cantor set."""
    pair = tuple(map(Fraction, ratios))
    root = MoranRoot(pair, (Fraction(1), Fraction(3)))
    decision = decide([*conclusions(), root], replace(PAPER, ratios=pair))
    assert decision.verdict is Verdict.REFUTED
    assert "linear" not in decision.witness + decision.theorem


def changed(kind, change, **fields):
    old = one(kind, **fields)
    return [replace(old, **change) if each is old else each for each in conclusions()]


def end(low, high):
    return Phases(Fraction(low), Fraction(high))


FALSE_STEPS = {
    "I is not inside": {"hull": end("1.12", "1.32")},
    "a domain begins after I": {"domains": (end("1.105", "1.15"), end("1.27", "1.32"))},
    "a domain ends before I": {"domains": (end("1.1", "1.15"), end("1.27", "1.31"))},
    "a domain without a part of I0": {"domains": (end("1.1", "1.14"), end("1.27", "1.32"))},
    "a domain without a part of I1": {"domains": (end("1.1", "1.15"), end("1.28", "1.32"))},
    "other words": {"words": ("0", "11")},
    "words without 000": {"words": WITHOUT_000, "slopes": (SLOPES,) * 3},
    "s_0 may be the dimension": {"dimension": (Fraction("0.4"), Fraction("0.449"))},
}


@pytest.mark.parametrize("name", FALSE_STEPS)
def test_what_a_decision_needs(name):
    found = changed(Repeller, FALSE_STEPS[name], words=FULL)
    found = [each for each in found if not isinstance(each, Itinerary)]
    assert decide(found).verdict is Verdict.UNDECIDED


def test_when_000_is_excluded():
    """By the orbit of the lower end of I, which leaves after 00; other words are not of the set."""
    base, orbit = one(StayingSet), one(Itinerary)
    short = one(Repeller, words=WITHOUT_000)

    def of(interval, *orbits):
        return staying(interval, Found(PAPER, [base, *orbits]))

    assert StayingDimension(short, of(short.hull, orbit)).interval == short.hull
    other = replace(orbit, orbit=(orbit.orbit[0], (Fraction("1.2"),) * 2))  # no 00 at all
    for known, repeller in (
        (of(short.hull, other), short),
        (of(base.interval), short),
        (of(short.hull, orbit), replace(short, words=FULL, slopes=(SLOPES,) * 2)),
    ):
        with pytest.raises(Unproved):
            StayingDimension(repeller, known)
    found = [other if each is orbit else each for each in conclusions()]
    assert "dimension_of_I" not in decide(found).quantities


@pytest.mark.parametrize(
    "change",
    [
        {"domains": (end("1.27", "1.32"), end("1.1", "1.15"))},
        {"domains": (end("1.1", "1.28"), end("1.27", "1.32"))},
        {"slopes": ((Fraction(1), Fraction(2)),) * 2},
        {"dimension": (Fraction("0.4"), Fraction("0.4"))},
    ],
)
def test_a_repeller_is_canonical(change):
    with pytest.raises(Unproved):
        replace(one(Repeller, words=FULL), **change)


def test_other_intervals_and_other_ratios():
    of = replace(PAPER, interval=(Fraction("1.09"), HULL[1]))
    assert decide(conclusions(), of).verdict is Verdict.UNDECIDED
    found = changed(MoranRoot, {"ratios": (Fraction("0.19"), Fraction("0.24"))})
    assert decide(found).verdict is Verdict.UNDECIDED
    of = replace(PAPER, ratios=(Fraction("0.2"), Fraction(1)))
    assert decide([], of).verdict is Verdict.REFUTED  # there is no s_0


def test_other_parameters_without_a_horseshoe():
    of = replace(PAPER, nu=Fraction("-0.05"))
    made = groups.produce({"dimension": ["H13"]}, of, digits=5)
    assert made.lines[0].verdict is Verdict.UNDECIDED
    assert check(made.certificate).claims[0].verdict is Verdict.UNDECIDED
