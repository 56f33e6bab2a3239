"""The linear Cantor set: its witnesses by brute force over words, its numbers by Arb."""

import random
import re
from dataclasses import replace
from fractions import Fraction

import pytest
from flint import arb, ctx

from proofs.search.s32_sets import prove
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper.s32_sets.cantor import (
    Excess,
    LinearSet,
    cylinder,
    decimal_between,
    gap_after,
    length,
    ratio_pairs,
)
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.paper.s32_sets.rules import RULES
from proofs.trusted.paper.s32_sets.sets import CLAIMS
from proofs.trusted.paper.s32_sets.subshift import words
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Verdict

DECIDE = {claim.id: claim.decide for claim in CLAIMS}
EXACT = (Fraction(4, 21), Fraction(5, 21))
ROUNDED = (Fraction("0.1905"), Fraction("0.2381"))
ROOTS = {  # mpmath, 50 digits
    EXACT: Fraction("0.44896935113647966112"),
    ROUNDED: Fraction("0.44898970740667915011"),
}
BOTH = pytest.mark.parametrize("ratios", [EXACT, ROUNDED])
I = PAPER.interval  # noqa: E741


def inside(part, whole):
    return whole[0] < part[0] and part[1] < whole[1]


def cylinders(ratios, deepest):
    """All intervals of up to so many letters, by the similarities themselves."""
    low, high = I
    found = {"": I}
    for size in range(1, deepest + 1):
        for word in words(size):
            end = found[word[1:]]
            r = ratios[int(word[0])]
            fixed = high if word[0] == "1" else low
            found[word] = tuple(fixed + r * (x - fixed) for x in end)
    return found


def intervals_named(text):
    pairs = re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)(?: holds| and| cover|,)", text)
    return [(Fraction(a), Fraction(b)) for a, b in pairs]


def test_ratios_as_defined_and_as_printed():
    assert ratio_pairs(PAPER) == [EXACT, ROUNDED]


@BOTH
def test_cylinders_are_images_under_the_similarities(ratios):
    for word, part in cylinders(ratios, 5).items():
        assert cylinder(ratios, I, word) == part
        if len(word) < 5:
            assert gap_after(ratios, I, word)[0] == cylinder(ratios, I, word + "0")[1]


@pytest.mark.parametrize(
    ("low", "high", "value"),
    [("0.1", "0.2", "0.11"), ("1/3", "1/2", "0.4"), ("-0.5", "0.5", "0"), ("0.99", "1.01", "1")],
)
def test_decimal_between(low, high, value):
    assert decimal_between(Fraction(low), Fraction(high)) == Fraction(value)


def test_no_decimal_between():
    with pytest.raises(ValueError, match="nothing"):
        decimal_between(Fraction(1), Fraction(1))


# -- the witnesses ---------------------------------------------------------------------------------


def largest(found, interval):
    """The words of the intervals inside an open interval that are in no other one inside."""
    chosen = []
    for word in sorted(found, key=len):
        if inside(found[word], interval) and not any(map(word.startswith, chosen)):
            chosen.append(word)
    return sorted(chosen, key=lambda word: found[word])


@pytest.mark.parametrize(("index", "ratios"), [(0, EXACT), (1, ROUNDED)])
def test_gap_estimates_fail_at_the_witness(index, ratios):
    decision = DECIDE["H15"](PAPER, [])
    assert decision.verdict is Verdict.REFUTED
    first, second = intervals_named(decision.witness.split("(eta0, eta1)")[1 + index])
    found = cylinders(ratios, 10)
    left, right = largest(found, first)
    assert (left, right) == ("001", "01")
    longer = max(length(found[left]), length(found[right]))
    gap = found[right][0] - found[left][1]
    assert gap < (1 - sum(ratios)) / ratios[0] * longer
    left, right = (max(side, key=lambda word: length(found[word])) for side in sides(found, second))
    shorter, longer = length(found[left]), length(found[right])
    assert shorter < longer
    assert shorter > ratios[0] / ratios[1] * longer  # with eta0, eta1 exchanged, as for a longer H1


def sides(found, interval):
    """The largest intervals on the left and on the right of the middle gap."""
    chosen = largest(found, interval)
    return [w for w in chosen if w[0] == "0"], [w for w in chosen if w[0] == "1"]


@pytest.mark.parametrize(("index", "ratios"), [(0, EXACT), (1, ROUNDED)])
def test_no_two_intervals_replace_the_witness(index, ratios):
    decision = DECIDE["H17"](PAPER, [])
    assert decision.verdict is Verdict.REFUTED
    first, second = intervals_named(decision.witness.split("(eta0, eta1)")[1 + index])
    found = cylinders(ratios, 7)
    level = [word for word in found if len(word) == 7]
    covered = [w for w in level if inside(found[w], first) or inside(found[w], second)]
    assert covered == level
    pieces = [word for word in found if len(word) < 6 and inside(found[word], first)]
    rest = [word for word in level if not inside(found[word], second)]
    for one in pieces:
        for other in pieces:
            assert any(not w.startswith((one, other)) for w in rest)


def test_equal_ratios_need_no_names():
    same = Parameters(PAPER.eta, PAPER.nu, PAPER.left, PAPER.right, I, (Fraction(4), Fraction(4)))
    assert DECIDE["H15"](same, []).verdict is Verdict.VERIFIED


@pytest.mark.parametrize("claim", ["H15", "H17"])
def test_without_a_gap_nothing_is_decided(claim):
    wide = Parameters(PAPER.eta, PAPER.nu, PAPER.left, PAPER.right, I, (Fraction(1), Fraction(3)))
    assert DECIDE[claim](wide, []).verdict is Verdict.UNDECIDED


# -- the lemma and the numbers ---------------------------------------------------------------------


@BOTH
def test_lemma_on_random_intervals(ratios):
    """|J|^s is at least the sum over the cylinders in J, with equality for J = I."""
    s = float(ROOTS[ratios])
    parts = [(float(a), float(b)) for w, (a, b) in cylinders(ratios, 8).items() if len(w) == 8]
    powers = [(b - a) ** s for a, b in parts]
    assert sum(powers) == pytest.approx(float(length(I)) ** s)
    draw = random.Random(4)
    ends = [x for part in parts for x in part]
    for _ in range(500):
        low, high = sorted(draw.sample(ends, 2))
        total = sum(p for p, (a, b) in zip(powers, parts, strict=True) if low <= a and b <= high)
        assert (high - low) ** s >= total * (1 - 1e-9)


@pytest.fixture(scope="module")
def evidence():
    return prove(PAPER, ["H12", "H14"])


def exact_arb(value):
    return arb(value.numerator) / value.denominator


def test_dimension_and_measure_by_arb(evidence):
    ctx.prec = 200
    for _, found in evidence.proofs["H12"]:
        assert isinstance(found, LinearSet)
        low, high = map(exact_arb, found.root)
        r0, r1 = map(exact_arb, found.ratios)
        assert r0**low + r1**low > 1 > r0**high + r1**high
        assert exact_arb(found.measure[0]) < exact_arb(length(I)) ** high
        assert exact_arb(found.measure[1]) > exact_arb(length(I)) ** low
        assert found.measure[1] - found.measure[0] < Fraction(1, 10**29)


def test_excess_by_arb(evidence):
    ctx.prec = 200
    for _, found in evidence.proofs["H14"]:
        assert isinstance(found, Excess)
        r1, s = found.ratios[1], exact_arb(ROOTS[found.ratios])
        part, delta = exact_arb(r1 * r1 * length(I)), exact_arb(found.epsilon / 4)
        value = (part + delta) ** s - part**s - delta
        assert exact_arb(found.excess[0]) - arb("1e-18") < value
        assert value < exact_arb(found.excess[1]) + arb("1e-18")
        assert found.epsilon < r1 - r1**2
        assert r1 * r1 * length(I) + found.epsilon / 4 > r1 * length(I)


# -- the rules of the checker ----------------------------------------------------------------------


def rule(name, known, **witness):
    return RULES[name](PAPER, known, Reader(witness))


@pytest.fixture(scope="module")
def roots():
    reach = Fraction(1, 10**19)
    return {"r": MoranRoot(EXACT, (ROOTS[EXACT] - reach, ROOTS[EXACT] + reach))}


@pytest.mark.parametrize(("epsilon", "word"), [("17/100", "11"), ("1/10", "0"), ("1/9", "0110")])
def test_excess_of_the_checker_by_arb(roots, epsilon, word):
    ctx.prec = 200
    found = rule("excess", roots, root="r", epsilon=epsilon, word=word)
    s, part = exact_arb(ROOTS[EXACT]), length(cylinders(EXACT, 4)[word])
    delta = Fraction(epsilon) / 2 ** len(word)
    value = exact_arb(part + delta) ** s - exact_arb(part) ** s - exact_arb(delta)
    assert exact_arb(found.excess[0]) < value < exact_arb(found.excess[1])
    assert found.excess[1] - found.excess[0] < Fraction(1, 10**17)
    assert (found.ratios, found.epsilon, found.word) == (EXACT, Fraction(epsilon), word)


def test_measure_of_the_checker_by_arb(roots):
    ctx.prec = 200
    found = rule("linear-set", roots, root="r")
    value = exact_arb(length(I)) ** exact_arb(ROOTS[EXACT])
    assert exact_arb(found.measure[0]) < value < exact_arb(found.measure[1])
    assert found.measure[1] - found.measure[0] < Fraction(1, 10**17)


@pytest.mark.parametrize(
    ("epsilon", "word"),
    [("0", "11"), ("-1/10", "11"), ("1/10", ""), ("1/10", "12"), ("1/10", "0" * 13)],
)
def test_excess_of_nothing(roots, epsilon, word):
    with pytest.raises(Malformed):
        rule("excess", roots, root="r", epsilon=epsilon, word=word)


def test_parts_that_overlap_are_no_cantor_set():
    whole = {"r": MoranRoot((Fraction(1, 2), Fraction(1, 2)), (Fraction(1, 2), Fraction(2)))}
    with pytest.raises(Unproved, match="overlap or touch"):
        rule("linear-set", whole, root="r")


@pytest.mark.parametrize("name", ["linear-set", "excess"])
def test_a_root_is_named(name):
    more = {} if name == "linear-set" else {"epsilon": "1/10", "word": "11"}
    for known in ({}, {"r": LinearSet(EXACT, EXACT, EXACT)}):
        with pytest.raises(Malformed, match="moran-root"):
            rule(name, known, root="r", **more)


# -- decisions -------------------------------------------------------------------------------------


def edited(evidence, claim, **changes):
    return [replace(found, **changes) for _, found in evidence.proofs[claim]]


@pytest.mark.parametrize(
    "changes",
    [
        {"epsilon": Fraction("0.19")},  # above eta1 - eta1^2
        {"epsilon": Fraction(0)},
        {"word": "1"},  # n = 0
        {"excess": (Fraction(0), Fraction(1))},
        {"ratios": (Fraction(1, 5), Fraction(1, 4))},
    ],
)
def test_no_refutation_by_another_L(evidence, changes):
    assert DECIDE["H14"](PAPER, edited(evidence, "H14", **changes)).verdict is Verdict.UNDECIDED


def test_a_small_epsilon_refutes_the_sum_alone(evidence):
    """L' is in T_n then; the sum is in the wrong order all the same."""
    found = edited(evidence, "H14", epsilon=Fraction(1, 10))
    decision = DECIDE["H14"](PAPER, found)
    assert decision.verdict is Verdict.REFUTED
    assert "T_n" not in decision.witness
    assert "T_n" in DECIDE["H14"](PAPER, edited(evidence, "H14")).witness


def test_lines_that_are_not_onto_leave_the_dimension_open(evidence):
    found = [step for _, step in evidence.proofs["H12"]]
    assert DECIDE["H12"](PAPER, found).verdict is Verdict.VERIFIED
    assert DECIDE["H12"](PAPER, found[1:]).verdict is Verdict.UNDECIDED
    wider = Parameters(
        PAPER.eta,
        PAPER.nu,
        (Fraction("1.1"), Fraction("1.15")),
        PAPER.right,
        (Fraction("1.1"), Fraction("1.32")),
        PAPER.slopes,
        PAPER.ratios,
    )
    assert DECIDE["H12"](wider, found).verdict is Verdict.UNDECIDED
