"""H13: the dimension of the impact map's invariant sets, and what decides the claim."""

import copy
import json
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from mpmath import findroot, mp, mpf

from intervals import Interval, Jet, Undecided
from proofs.motion.covering import cover_by_impacts
from proofs.motion.inverse import InverseBranch, InverseSystem
from proofs.motion.system import System
from proofs.search import s32_dimension as dimension
from proofs.shell import groups
from proofs.trusted.certificate import render
from proofs.trusted.paper import find
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000, Repeller
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.parameters import PAPER
from proofs.trusted.slopes import Avoids, Impact
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.paper import periodic_dimension, reference

DIGITS = 5
SYSTEM = System(PAPER.eta, PAPER.nu)
LEFT, RIGHT = (Fraction("1.1"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32"))
HULL = (LEFT[0], RIGHT[1])


@cache
def evidence():
    return dimension.prove(PAPER, ["H13"], digits=DIGITS)


def conclusions():
    return [found for _, found in evidence().proofs["H13"]]


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


@pytest.mark.parametrize(
    ("words", "longest", "read"),
    [
        pytest.param(FULL, 6, periodic_dimension.every, marks=pytest.mark.slow),
        (WITHOUT_000, 8, periodic_dimension.without_000),
        (WITHOUT_000, 4, periodic_dimension.blocks),
    ],
)
def test_contains_the_dimension_by_periodic_orbits(words, longest, read):
    low, high = one(Repeller, words=words).dimension
    assert low < periodic_dimension.dimension(longest, read) < high
    assert high - low < Fraction(1, 10**DIGITS)


@pytest.mark.slow
def test_ten_digits_by_periodic_orbits():
    found = dimension.prove(PAPER, ["H13"], digits=10).proofs["H13"]
    repellers = {each.words: each.dimension for _, each in found if isinstance(each, Repeller)}
    for words, value in (
        (FULL, periodic_dimension.dimension(7)),
        (WITHOUT_000, periodic_dimension.dimension(6, periodic_dimension.blocks)),
    ):
        low, high = repellers[words]
        assert low < value < high < low + Fraction(1, 10**10)


def test_the_slopes_are_those_of_the_branches():
    """1 / g' at the ends of I, and the extremes in between, by equations typed by hand."""
    for letter, (low, high) in enumerate(one(Repeller, words=FULL).slopes):
        seen = [
            periodic_dimension.inverse(letter, float(1.1 + 0.22 * k / 20))[1] for k in range(21)
        ]
        assert low <= min(seen) and max(seen) <= high
        assert high - low < 1.1 * (max(seen) - min(seen)) + 0.3


def inverse_at(x, turns, guess):
    """g(x) to 50 digits, by equation (10) typed by hand."""
    eta, nu = mpf("0.2121"), mpf("-0.2")
    return findroot(
        lambda y: reference.left_side_10(eta, nu, y, x - y + 2 * mp.pi * turns), mpf(guess)
    )


@pytest.mark.parametrize(("domain", "turns", "guess"), [(LEFT, 4, "1.12"), (RIGHT, 9, "1.29")])
def test_jets_of_inverse_branches(domain, turns, guess):
    (impact,) = cover_by_impacts(SYSTEM, domain)
    branch = InverseBranch(impact, domain, Fraction(1, 2**120))
    assert branch.turns == turns and branch.passes_once(HULL)
    true = mp.taylor(lambda x: inverse_at(x, turns, guess), mpf("1.2"), 3)
    jet = branch(Jet.variable(Interval("1.2", precision=160), 5))
    over = branch(Jet.variable(Interval("1.15", "1.25", precision=160), 5))
    for k, value in enumerate(true):
        exact, error = Fraction(mp.nstr(value, 45)), Fraction(1, 10**10)
        found = jet.coefficients[k]
        assert found.inf - error < exact < found.sup + error and found.wid < error
        assert over.coefficients[k].inf < exact < over.coefficients[k].sup


def test_a_bracket_below_the_rounding_is_refused():
    (impact,) = cover_by_impacts(SYSTEM, LEFT)
    branch = InverseBranch(impact, LEFT, Fraction(1, 2**150))
    with pytest.raises(Undecided, match="not proved"):
        branch.preimage(Interval("1.2", precision=100))
    with pytest.raises(Undecided, match="outside"):
        branch.preimage(Interval("1.5", precision=200))


def test_overlapping_images_are_seen():
    (first,), (second,) = (cover_by_impacts(SYSTEM, domain) for domain in (LEFT, RIGHT))
    letters = tuple(
        InverseBranch(impact, domain, Fraction(1, 2**80))
        for impact, domain in ((first, LEFT), (second, RIGHT))
    )
    for words, disjoint in ((FULL, True), (WITHOUT_000, True), (("0", "1", "11"), False)):
        system = InverseSystem(letters, HULL, words, Fraction(1, 2**80), 120)
        assert system.images_are_disjoint() is disjoint
    low = InverseSystem(letters, (Fraction("1.12"), HULL[1]), FULL, Fraction(1, 2**80), 120)
    assert not low.images_are_disjoint()


# -- the verdict -----------------------------------------------------------------------------------


def test_the_paper_is_refuted():
    found = decide(conclusions())
    assert found.verdict is Verdict.REFUTED and found.witness
    assert "three images in a row in [1.11, 1.15]" in found.corrected
    for name, value in (
        ("dimension", "0.425083744300103"),
        ("dimension_of_I", "0.367465319782449"),
        ("s0", "0.448989707406679"),
    ):
        low, high = found.quantities[name]
        assert low < Fraction(value) + Fraction(1, 10**15) and Fraction(value) < high
    low, high = found.quantities["dimension_crude"]
    assert low < found.quantities["dimension"][0] and found.quantities["dimension"][1] < high
    assert high - low < Fraction(1, 10)


def test_a_set_around_i_bounds_from_above():
    found = [each for each in conclusions() if not isinstance(each, Impact)]
    decision = decide(found)
    assert decision.verdict is Verdict.REFUTED
    assert "dimension_of_I" not in decision.quantities and "at most" in decision.corrected


def test_the_proved_sets_themselves():
    of = replace(PAPER, left=LEFT, right=RIGHT, interval=HULL)
    decision = decide(conclusions(), of)
    assert decision.verdict is Verdict.REFUTED and "dimension_of_I" not in decision.quantities
    assert "0.42508" in decision.why


@pytest.mark.parametrize("kind", [Avoids, MoranRoot, Repeller])
def test_nothing_is_decided_without(kind):
    found = [each for each in conclusions() if not isinstance(each, kind)]
    assert decide(found).verdict is Verdict.UNDECIDED
    assert decide([]).verdict is Verdict.UNDECIDED


def changed(kind, change, **fields):
    old = one(kind, **fields)
    return [replace(old, **change) if each is old else each for each in conclusions()]


FALSE_STEPS = {
    "the gap is not covered": (Avoids, {"phases": (Fraction("1.15"), Fraction("1.26"))}),
    "the target is not all of I": (Avoids, {"target": (Fraction("1.11"), HULL[1])}),
    "I is not inside": (Repeller, {"hull": (Fraction("1.12"), HULL[1])}),
    "a domain begins after I": (Repeller, {"domains": ((Fraction("1.105"), LEFT[1]), RIGHT)}),
    "a domain ends before I": (Repeller, {"domains": (LEFT, (RIGHT[0], Fraction("1.31")))}),
    "other words": (Repeller, {"words": ("0", "11")}),
    "s_0 may be the dimension": (Repeller, {"dimension": (Fraction("0.4"), Fraction("0.449"))}),
}


@pytest.mark.parametrize("name", FALSE_STEPS)
def test_what_a_decision_needs(name):
    kind, change = FALSE_STEPS[name]
    found = changed(kind, change, **({"words": FULL} if kind is Repeller else {}))
    found = [each for each in found if not isinstance(each, Impact)]
    assert decide(found).verdict is Verdict.UNDECIDED


def test_a_larger_interval_is_not_bounded():
    of = replace(PAPER, interval=(Fraction("1.09"), HULL[1]))
    assert decide(conclusions(), of).verdict is Verdict.UNDECIDED


def test_a_root_for_other_ratios_is_not_s_0():
    found = changed(
        MoranRoot, {"ratios": (Fraction("0.19"), Fraction("0.24"))}, ratios=PAPER.ratios
    )
    assert decide(found).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    "points",
    [
        [],
        [("1.11", "1.129", "1.13"), ("1.13", "1.2", "1.3")],  # f(1.11) >= 1.13 is not proved
        [("1.11", "1.129", "1.13"), ("1.12", "1.149", "1.3")],  # f(1.12) > 1.15 is not
        [("1.111", "1.129", "1.13"), ("1.12", "1.2", "1.3")],  # not the end of I
        [("1.11", "1.13", "1.4"), ("1.12", "1.2", "1.3")],  # f(1.11) may be beyond I
        [("1.11", "1.129", "1.13"), ("1.12", "1.2", "6.29")],  # f may be beyond phase 0
        [("1.11", "1.2", "1.3"), ("1.16", "1.2", "1.3")],  # 1.16 is not in I0
    ],
)
def test_when_000_is_excluded(points):
    found = [each for each in conclusions() if not isinstance(each, Impact)]
    for numbers in points:
        phase, low, high = map(Fraction, numbers)
        found.append(Impact(phase, (Fraction(4), Fraction(5)), (low, high)))
    assert "dimension_of_I" not in decide(found).quantities
    right = Impact(Fraction("1.11"), (Fraction(4), Fraction(5)), (Fraction("1.129"),) * 2)
    then = Impact(Fraction("1.12"), (Fraction(4), Fraction(5)), (Fraction("1.2"),) * 2)
    assert "dimension_of_I" in decide([*found, right, then]).quantities


def test_no_root_no_dimension():
    of = replace(PAPER, ratios=(Fraction("0.2"), Fraction(1)))
    assert decide([], of).verdict is Verdict.REFUTED


# -- the certificate -------------------------------------------------------------------------------


@cache
def document():
    row, entry = groups.decide("H13", PAPER, evidence().proofs["H13"], DIGITS)
    assert row.verdict is Verdict.REFUTED
    return json.loads(render(groups.certificate(PAPER, evidence().steps, [entry])))


def test_the_certificate_is_accepted_and_small():
    text = render(document())
    (claim,) = check(text).claims
    assert (claim.id, claim.verdict) == ("H13", Verdict.REFUTED)
    assert len(text) < 20_000


def test_narrower_bounds_are_rejected():
    false = copy.deepcopy(document())
    bounds = {"lower": "0.425083", "upper": "0.425084"}
    false["claims"][0]["quantities"]["dimension"] = bounds
    with pytest.raises(Rejected, match="bounds"):
        check(render(false))


def test_other_parameters_without_a_horseshoe():
    of = replace(PAPER, nu=Fraction("-0.05"))
    rows, _ = groups.settle("dimension", of, digits=5, tell=lambda stage: None)
    assert rows[0].verdict is Verdict.UNDECIDED
