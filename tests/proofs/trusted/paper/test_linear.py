"""The linear Cantor set: its witnesses by brute force over words, its numbers by Arb."""

import random
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product

import pytest
from flint import arb, ctx

from proofs.search.s32_sets import prove
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.paper.s32_sets import linear, linear_steps
from proofs.trusted.paper.s32_sets.linear import ExactMeasure, LinearDimension, LinearSet
from proofs.trusted.paper.s32_sets.linear_steps import Excess, ShortGap, Uncovered, linear_sets
from proofs.trusted.paper.s32_sets.subshift import words
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.oracles.judge import oracle

DECIDE = {row.id: row.decide for row in (*linear.ROWS, *linear_steps.ROWS)}
EXACT = (Fraction(4, 21), Fraction(5, 21))
ROUNDED = (Fraction("0.1905"), Fraction("0.2381"))
ROOTS = {  # mpmath, 50 digits
    EXACT: Fraction("0.44896935113647966112"),
    ROUNDED: Fraction("0.44898970740667915010"),
}
BOTH = pytest.mark.parametrize("ratios", [EXACT, ROUNDED])
I = PAPER.interval  # noqa: E741
VERIFIED, REFUTED, UNDECIDED = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED


def length(part):
    return part[1] - part[0]


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


def in_gap(found, word, at=Fraction(1, 3)):
    """A phase of the gap of an interval."""
    low, high = found[word + "0"][1], found[word + "1"][0]
    return low + at * (high - low)


@pytest.mark.parametrize(
    ("ratios", "interval"),
    [
        (("7/10", "4/5"), I),
        (("1/2", "1/2"), I),
        (("2/5", "1/5"), I),  # not in order
        (("0", "1/2"), I),
        (("-1/5", "1/5"), I),
        (("1/5", "1/4"), (I[1], I[0])),
        (("1/5", "1/4"), (I[0], I[0])),
    ],
)
@pytest.mark.parametrize("kind", [LinearSet, ExactMeasure, ShortGap, Uncovered])
def test_there_is_no_other_linear_set(kind, ratios, interval):
    with pytest.raises(Unproved):
        kind(tuple(map(Fraction, ratios)), interval)


# -- the witnesses ---------------------------------------------------------------------------------


def largest(found, interval):
    """The words of the intervals inside an open interval that are in no other one inside."""
    chosen = []
    for word in sorted(found, key=len):
        if inside(found[word], interval) and not any(map(word.startswith, chosen)):
            chosen.append(word)
    return sorted(chosen, key=lambda word: found[word])


@pytest.mark.parametrize("place", [Fraction(1, 100), Fraction(99, 100)])
@BOTH
def test_gap_estimates_fail_at_the_witness(ratios, place):
    """Every J from the gap of I_00 to that of I; and the exchanged names of the text."""
    found = cylinders(ratios, 10)
    left, right = largest(found, (in_gap(found, "00", place), in_gap(found, "", place)))
    assert (left, right) == ("001", "01")
    longer = max(length(found[left]), length(found[right]))
    gap = found[right][0] - found[left][1]
    assert gap == (1 - sum(ratios)) / ratios[1] * longer < (1 - sum(ratios)) / ratios[0] * longer
    text = ShortGap(ratios, I).sentence
    w, v = (part.split(",")[0].split(" ")[0] for part in text.split("= I_")[2:4])
    chosen = largest(found, (in_gap(found, w[:-1], place), in_gap(found, v[:-1], place)))
    assert w in chosen and v in chosen
    assert length(found[w]) == max(length(found[x]) for x in chosen if x[0] == "0")
    assert length(found[v]) == max(length(found[x]) for x in chosen if x[0] == "1")
    shorter, longer = length(found[w]), length(found[v])
    assert ratios[0] / ratios[1] * longer < shorter < longer


def test_exchanged_names_may_help():
    """1/4, 1/2: an interval of length 2^-a beside one of 2^-b is at most twice as long."""
    assert "exchange" not in ShortGap((Fraction(1, 4), Fraction(1, 2)), I).sentence


@pytest.mark.parametrize("place", [Fraction(1, 100), Fraction(99, 100)])
@BOTH
def test_no_two_intervals_replace_the_witness(ratios, place):
    found = cylinders(ratios, 7)
    cut = in_gap(found, "11", place)
    first, second = (I[0] - 1, cut), (cut, I[1] + 1)
    level = [word for word in found if len(word) == 7]
    assert [w for w in level if inside(found[w], first) or inside(found[w], second)] == level
    pieces = [word for word in found if len(word) < 6 and inside(found[word], first)]
    rest = [word for word in level if not inside(found[word], second)]
    for one, other in product(pieces, repeat=2):
        assert any(not w.startswith((one, other)) for w in rest)


# -- H15: pair by pair -----------------------------------------------------------------------------


def at(slopes, ratios=None):
    pair = ratios and tuple(map(Fraction, ratios))
    return replace(PAPER, slopes=tuple(map(Fraction, slopes)), ratios=pair, printed_s0=None)


@pytest.mark.every
@pytest.mark.parametrize(
    ("slopes", "ratios", "expected"),
    [
        (("5", "5"), None, VERIFIED),
        (("5", "5"), ("1/5", "1/5"), VERIFIED),
        (("4.95", "5.05"), ("0.2", "0.2"), UNDECIDED),  # false as defined, true as printed
        (("5", "5"), ("0.2", "0.21"), UNDECIDED),
        (("4.2", "5.25"), ("0.1905", "0.2381"), REFUTED),
        (("5", "5.0000001"), None, REFUTED),
        (("6/5", "3/2"), None, UNDECIDED),  # no linear set
        (("4", "5"), ("7/10", "4/5"), UNDECIDED),
        (("2", "2"), None, UNDECIDED),
    ],
)
def test_gap_estimates_for_both_pairs(slopes, ratios, expected):
    of = at(slopes, ratios)
    decision = DECIDE["H15"](of, [])
    assert decision.verdict is expected
    if expected is UNDECIDED and sum(of.moran_ratios) < 1 and sum(of.reciprocals) < 1:
        assert "true with (eta0, eta1) = (" in decision.why and "false with" in decision.why


def test_gap_estimates_by_brute_force_for_equal_ratios():
    """All J between gaps of level 4: the two largest intervals side by side, and their gap."""
    ratio = Fraction(1, 5)
    found = cylinders((ratio, ratio), 5)
    ends = sorted(in_gap(found, word) for word in found if len(word) < 4)
    seen = 0
    for low, high in product(ends, ends):
        chosen = largest(found, (low, high)) if low < high else []
        for left, right in pairwise(chosen):
            sizes = [length(found[left]), length(found[right])]
            if sorted(sizes) == sorted(length(found[w]) for w in chosen)[-2:]:
                gap = found[right][0] - found[left][1]
                assert gap >= (1 - 2 * ratio) / ratio * max(sizes)
                seen += 1
    assert seen > 50


@pytest.mark.parametrize("claim", ["H12", "H14", "H15", "H17"])
@pytest.mark.parametrize("slopes", [("1", "3"), ("6/5", "3/2"), ("10/8", "10/7")])
def test_nothing_is_said_of_a_set_that_does_not_exist(claim, slopes):
    decision = DECIDE[claim](at(slopes), [])
    assert decision.verdict is UNDECIDED and decision.theorem is decision.witness is None


@pytest.mark.parametrize("claim", ["H12", "H14", "H15", "H16", "H17"])
@pytest.mark.parametrize("power", [60, 390])
def test_tiny_ratios_end_at_once(claim, power):
    of = at((Fraction(10) ** power, Fraction(10) ** power + 1))
    proof = prove(of, [claim]).proofs.get(claim, []) if power < 100 else []
    decision = DECIDE[claim](of, [found for _, found in proof])
    assert decision.verdict is {"H12": UNDECIDED, "H14": UNDECIDED, "H16": VERIFIED}.get(
        claim, REFUTED
    )
    assert len(decision.why) < 5000


# -- the lemma and the numbers ---------------------------------------------------------------------


@pytest.fixture(scope="module")
def evidence():
    """What H12 and H14 are decided by."""
    proofs = prove(PAPER, ["H12", "H14"]).proofs
    roots = {claim: [found for _, found in proof] for claim, proof in proofs.items()}
    return {claim: DECIDE[claim](PAPER, found).because for claim, found in roots.items()}


def exact_arb(value):
    return arb(value.numerator) / value.denominator


# -- by the bounds of the root ---------------------------------------------------------------------


REACH = Fraction(1, 10**19)
ROOT = ROOTS[EXACT] - REACH, ROOTS[EXACT] + REACH


def test_measures_and_excesses_are_those_the_oracles_see(evidence):
    (measure,), excesses = evidence["H12"], evidence["H14"]
    rough = LinearDimension(EXACT, I, ROOT)
    assert [found.ratios for found in excesses] == [EXACT, ROUNDED]
    assert {found.level for found in excesses} == {1}
    for found, digits in ((measure, 29), (rough, 17)):
        assert isinstance(found, LinearDimension)
        assert length(found.measure) < Fraction(1, 10**digits)
    for found in (measure, rough, *excesses):
        assert oracle(found, random.Random(1), PAPER) == []


def test_excess_in_a_long_interval_begins_at_a_later_level():
    """For |I| = 6 the longest L and the largest d at n = 1 are too long for the proof."""
    ctx.prec = 200
    found = Excess(EXACT, (Fraction(0), Fraction(6)), ROOT)
    s, r1, n = exact_arb(ROOTS[EXACT]), EXACT[1], found.level - 1
    part, d = r1 ** (n + 1) * 6, (r1**n - r1 ** (n + 1)) / 2 ** (n + 1)
    assert n >= 1 and s * exact_arb(part + d) ** (s - 1) < 1
    assert found.sentence.endswith("every L' is in T_n.")


def test_parts_that_overlap_are_no_cantor_set():
    for ratios in ((Fraction(1, 2),) * 2, (Fraction(7, 10), Fraction(4, 5))):
        for kind in (LinearDimension, Excess):
            with pytest.raises(Unproved, match="no linear Cantor set"):
                kind(ratios, I, (Fraction(1, 2), Fraction(4)))


# -- decisions -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "changes",
    [
        {"root": (Fraction("0.44"), Fraction(1))},
        {"root": (Fraction(1, 10**12), Fraction("0.02"))},
        {"interval": (Fraction(0), Fraction(10**20))},
    ],
)
def test_no_excess_that_refutes_nothing(evidence, changes):
    with pytest.raises(Unproved, match=r"refuted|expected"):
        replace(evidence["H14"][0], **changes)


def test_no_refutation_by_the_root_of_another_set():
    one, two = (MoranRoot(each, (x - REACH, x + REACH)) for each, x in ROOTS.items())
    other = replace(one, ratios=(Fraction(1, 5), Fraction(1, 4)))
    assert DECIDE["H14"](PAPER, [other, two]).verdict is UNDECIDED
    assert DECIDE["H14"](PAPER, [one]).verdict is UNDECIDED
    assert DECIDE["H14"](PAPER, [other, two, one]).verdict is REFUTED


@pytest.mark.parametrize(
    "change",
    [
        {"left": (Fraction("1.1"), Fraction("1.15")), "interval": (Fraction("1.1"), I[1])},
        {"left": (I[0], Fraction("1.16"))},
        {"right": (Fraction("1.28"), I[1])},
        {"slopes": (Fraction("4.2"), Fraction("5.2"))},
    ],
)
def test_lines_that_are_not_onto_leave_the_dimension_open(change):
    found = [MoranRoot(EXACT, ROOT)]
    assert DECIDE["H12"](PAPER, found).verdict is VERIFIED
    assert DECIDE["H12"](PAPER, []).verdict is UNDECIDED
    assert DECIDE["H12"](replace(PAPER, **change), found).verdict is UNDECIDED


@pytest.mark.parametrize(
    ("ratios", "expected"),
    [
        (("0.1905", "0.2381"), VERIFIED),
        (("0.3", "0.69999"), VERIFIED),
        (("0.3", "0.7"), REFUTED),  # s_0 = 1: q is constant
        (("0.5", "0.6"), REFUTED),
        (("0.5", "1"), REFUTED),
        (("2", "3"), REFUTED),
    ],
)
def test_gap_function(ratios, expected):
    of = replace(PAPER, ratios=tuple(map(Fraction, ratios)))
    decision = DECIDE["H16"](of, [])
    assert decision.verdict is expected
    assert expected is VERIFIED or "linear" not in decision.witness


def test_both_pairs_of_ratios():
    assert [each.ratios for each in linear_sets(PAPER)] == [EXACT, ROUNDED]
