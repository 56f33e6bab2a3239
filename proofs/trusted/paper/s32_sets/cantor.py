"""Claim 1 of the paper: the measure of the linear Cantor set, and the steps of its proof. Trusted.

Let 0 < r0, r1 and r0 + r1 < 1. The closed interval I_w of a word w over 0, 1 has the left part
I_w0, of r0 times its length, the right part I_w1, of r1 times its length, and between them the
open gap K_w. E_n is the union of the 2^n intervals of words of length n, L the intersection of
all E_n. s is the root of r0^s + r1^s = 1; it lies in (0, 1), as r0 + r1 < 1.

Lemma. For every interval J and every n, |J|^s >= sum of |I_w|^s over the words w of length n with
I_w in J.

Proof. Put k = 1 - r0 - r1 and G(x, y) = (x + k + y)^s - x^s - y^s. For x, y > 0 both derivatives
are negative, since t^(s-1) decreases; G(r0, r1) = 0; so G >= 0 on [0, r0] x [0, r1]. The lemma
holds for n = 0. Let it hold for n - 1 (for all similar sets as well). Where all the intervals in J
lie in I_0, or all in I_1, it is the lemma for that part. Otherwise J contains the gap of I, and
meets I_0 in a length x |I| <= r0 |I|, I_1 in y |I| <= r1 |I|; the sum is at most
(x^s + y^s) |I|^s <= (x + k + y)^s |I|^s <= |J|^s.

Theorem. L has dimension s, and its s-dimensional Hausdorff measure is exactly |I|^s; so is the
infimum of sum |T_k|^s over its covers by intervals T_k no longer than any given bound.

Proof. The 2^n intervals of length n cover L, get arbitrarily short, and sum |I_w|^s = |I|^s;
slightly longer open intervals do as well (see `_covering_sum`). Conversely L is compact: of an open
cover finitely many members suffice, and by Lebesgue's number every I_w with w long enough is
inside one of them. By the lemma sum |J|^s >= sum |I_w|^s = |I|^s. (Moran 1946, Hutchinson 1981
have the dimension; the measure is that of Falconer's proof for the middle third set.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, ceil_text, decimal_between, floor_text, show
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict

_LONGEST = 30


@dataclass(frozen=True)
class LinearSet(Conclusion):
    """The root s of r0^s + r1^s = 1 is in `root`, and |I|^s in `measure`; r0 + r1 < 1."""

    ratios: Range
    root: Range
    measure: Range


@dataclass(frozen=True)
class Excess(Conclusion):
    """(|L| + d)^s - |L|^s - d is in `excess`, s the root for the ratios.

    L = I_w with w of n + 1 letters, and d = epsilon / 2^(n+1).
    """

    ratios: Range
    epsilon: Fraction
    word: str
    excess: Range


def cylinder(ratios: Range, interval: Range, word: str) -> Range:
    """Return the interval I_w, exact."""
    low, high = interval
    for letter in word:
        cut = ratios[int(letter)] * (high - low)
        low, high = (low, low + cut) if letter == "0" else (high - cut, high)
    return low, high


def gap_after(ratios: Range, interval: Range, word: str) -> Range:
    """Return the ends of the gap K_w between I_w0 and I_w1."""
    left, right = (cylinder(ratios, interval, word + letter) for letter in "01")
    return left[1], right[0]


def length(interval: Range) -> Fraction:
    """Return the length of an interval."""
    return interval[1] - interval[0]


def ratio_pairs(of: Parameters) -> list[Range]:
    """Return (eta0, eta1) as 1 / slopes and, where they differ, as printed."""
    return list(dict.fromkeys((of.reciprocals, of.moran_ratios)))


def _in_gap(ratios: Range, interval: Range, word: str) -> Fraction:
    return decimal_between(*gap_after(ratios, interval, word))


def _named(ratios: Range) -> str:
    return f"(eta0, eta1) = ({show(ratios[0])}, {show(ratios[1])})"


_NO_GAP = "eta0 + eta1 >= 1: there is no gap"


def _linear_sets(found: Sequence[object]) -> dict[Range, LinearSet]:
    return {step.ratios: step for step in found if isinstance(step, LinearSet)}


def _linear_dimension(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H12 by the theorem above, with ratios 1 / slopes.

    The lines of these slopes must map I0 and I1 exactly onto I.
    """
    sets, exact = _linear_sets(found), of.reciprocals
    if exact not in sets:
        return undecided("no bracket of s_0 for the ratios 1 / slopes, with eta0 + eta1 < 1")
    parts = [cylinder(exact, of.interval, letter) for letter in "01"]
    if parts != [of.left, of.right]:
        return undecided("lines of these slopes do not map I0 and I1 exactly onto I")
    low, high = sets[exact].root
    why = (
        f"|I0| = |I| / {show(of.slopes[1])} and |I1| = |I| / {show(of.slopes[0])} exactly; s_0 in "
        f"[{floor_text(low, 9)}, {ceil_text(high, 9)}], and the Hausdorff measure is |I|^s_0"
    )
    printed = sets.get(of.moran_ratios)
    if printed is not None and of.moran_ratios != exact:
        low, high = printed.root
        why += (
            f"; the ratios rounded to {show(of.moran_ratios[0])}, {show(of.moran_ratios[1])} have "
            f"the root [{floor_text(low, 9)}, {ceil_text(high, 9)}]"
        )
    return Decision(
        Verdict.VERIFIED,
        why,
        quantities={"dimension": sets[exact].root, "measure": sets[exact].measure},
    )


def _covering_sum(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H14 by one L for which (11) fails, for the ratios as defined and as printed.

    The correction: with e = min((epsilon / 2^(n+1))^(1/s), (eta1^n - eta1^(n+1)) |I|) and
    |L'| <= |L| + e, |L'| <= eta1^(n+1) |I| + e <= eta1^n |I|, and |L'|^s <= |L|^s + e^s <=
    |L|^s + epsilon / 2^(n+1), as (x + y)^s <= x^s + y^s for 0 < s < 1.
    """
    steps = {step.ratios: step for step in found if isinstance(step, Excess)}
    whole, whys, witness = length(of.interval), [], []
    for ratios in ratio_pairs(of):
        step = steps.get(ratios)
        if step is None:
            return undecided(f"no L is examined for {_named(ratios)}")
        n, longest = len(step.word) - 1, max(ratios)
        delta = step.epsilon / 2 ** (n + 1)
        if not 0 < step.epsilon < longest**n - longest ** (n + 1) or step.excess[0] <= 0 or n < 1:
            return undecided(f"(11) is not refuted at n = {n}, epsilon = {show(step.epsilon)}")
        inside = length(cylinder(ratios, of.interval, step.word))
        whys.append(f"|L'|^s - |L|^s - epsilon/2^(n+1) >= {floor_text(step.excess[0])}")
        text = (
            f"{_named(ratios)}, n = {n}, epsilon = {show(step.epsilon)} < eta1^n - eta1^(n+1), L = "
            f"I_{step.word} and |L'| = |L| + {show(delta)}: |L'|^s_0 > |L|^s_0 + epsilon/2^(n+1)"
        )
        if inside + delta > longest**n * whole:
            text += f"; and |L'| = {show(inside + delta)} > eta1^n |I|, so that L' is not in T_n"
        if step.word == "1" * (n + 1):
            text += (
                "; L is the longest of its level and (x + d)^s_0 - x^s_0 decreases in x, so that "
                "the same fails for all L, and for the sum"
            )
        witness.append(text)
    return Decision(Verdict.REFUTED, whys[0], witness=". ".join(witness) + ".", corrected=_FATTENED)


_FATTENED = (
    "For 0 < eta0 <= eta1, eta0 + eta1 < 1, eta0^s + eta1^s = 1, n >= 0 and epsilon > 0 let the "
    "open intervals L'_j contain the closed intervals L_j of level n + 1, with |L'_j| <= |L_j| + "
    "min((epsilon/2^(n+1))^(1/s), (eta1^n - eta1^(n+1)) |I|). Then |L'_j| <= eta1^n |I|, |L'_j|^s "
    "<= |L_j|^s + epsilon/2^(n+1), and the sum of all |L'_j|^s is at most |I|^s + epsilon. So (12) "
    "holds: Lambda has covers by open intervals of length at most eta1^n |I| with sums arbitrarily "
    "close to |I|^s."
)


def _gap_estimates(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H15 by exact arithmetic on intervals J, for the ratios as defined and as printed."""
    del found
    witness = []
    for ratios in ratio_pairs(of):
        if sum(ratios) >= 1:
            return undecided(_NO_GAP)
        if ratios[0] == ratios[1]:
            continue
        failing = _longer_right(of.interval, ratios), _renamed_right(of.interval, ratios)
        witness.append(f"{_named(ratios)}: " + " ".join(filter(None, failing)))
    if not witness:
        return Decision(Verdict.VERIFIED, "eta0 = eta1: the names do not matter")
    return Decision(
        Verdict.REFUTED,
        "where the right one of the two is the longer, |K| = (1 - eta0 - eta1)/eta1 |H0|, which is "
        f"less than with eta0 = {show(of.moran_ratios[0])} in place of eta1",
        witness=" ".join(witness),
        corrected=_BOTH_SIDES,
    )


def _longer_right(interval: Range, ratios: Range) -> str:
    """Name a J that holds I_001 and I_01 and nothing else of level 2 or 1, and what fails.

    Its largest intervals are I_01 and, left of the gap K_0, I_001: any other in it is inside
    these. The longer one is I_01, since eta0 eta1 > eta0^2 eta1, and |K_0| = (1 - eta0 - eta1)
    eta0 |I| < (1 - eta0 - eta1)/eta0 |I_01| exactly if eta0 < eta1.
    """
    ends = _in_gap(ratios, interval, "00"), _in_gap(ratios, interval, "")
    gap = length(gap_after(ratios, interval, "0"))
    longer = length(cylinder(ratios, interval, "01"))
    bound = (1 - sum(ratios)) / ratios[0] * longer
    return (
        f"J = ({show(ends[0])}, {show(ends[1])}) holds I_001, K, I_01 and no larger ones; the "
        f"longer is H0 = I_01, and |K| = {show(gap)} < (1 - eta0 - eta1)/eta0 |H0| = {show(bound)}."
    )


def _renamed_right(interval: Range, ratios: Range) -> str | None:
    """Name a J for which eta0 and eta1 exchanged do not help where the right one is the longer.

    H0 = I_0 1...1 with k ones and H1 = I_1 0...0 with j zeros, both at the gap of I: with
    1 < eta1^k / eta0^j < eta1/eta0, |H0| < |H1| and yet |H0| > eta0/eta1 |H1|.
    """
    left, right = ratios
    for k in range(1, _LONGEST):
        for j in range(1, _LONGEST):
            if 1 < right**k / left**j < right / left:
                low = _in_gap(ratios, interval, "0" + "1" * (k - 1))
                high = _in_gap(ratios, interval, "1" + "0" * (j - 1))
                return (
                    "Nor does it help to exchange eta0 and eta1 where the right one is longer: "
                    f"({show(low)}, {show(high)}) holds I_w, w = 0{'1' * k}, K and I_v, v = "
                    f"1{'0' * j}, and no larger ones; |I_w| < |I_v|, but |I_w| > eta0/eta1 |I_v|."
                )
    return None


_BOTH_SIDES = (
    "For 0 < eta0, eta1, eta0 + eta1 < 1, eta0^s + eta1^s = 1 let H0 in I_w0 and H1 in I_w1 be "
    "intervals on both sides of the gap K of the same I_w. Then |K| = (1 - eta0 - eta1) |I_w| >= "
    "(1 - eta0 - eta1) max(|H0|/eta0, |H1|/eta1), and (|H0| + |K| + |H1|)^s >= |H0|^s + |H1|^s, "
    "whichever is longer: with k = 1 - eta0 - eta1, (x + k + y)^s - x^s - y^s decreases in x and "
    "in y and vanishes at (eta0, eta1), so it is not negative on [0, eta0] x [0, eta1]."
)


def _replacing(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H17 by an exact cover {J, J'} of the set that is none after the replacement.

    J holds I_0, I_10, I_110 and misses I_111; J' holds I_111 and misses I_110. An interval I_w in
    J lies in one of those three, since J contains neither I nor I_1 nor I_11. So two of them, H0
    and H1, leave points of at least one of the three uncovered, and J' does not contain these.
    """
    del found
    covers = []
    for ratios in ratio_pairs(of):
        if sum(ratios) >= 1:
            return undecided(_NO_GAP)
        low, high = of.interval[0] - 1, of.interval[1] + 1
        cut = show(_in_gap(ratios, of.interval, "11"))
        covers.append(
            f"{_named(ratios)}: J = ({show(low)}, {cut}), J' = ({cut}, {show(high)}) cover Lambda"
        )
    return Decision(
        Verdict.REFUTED,
        "a J that holds I_0, I_10 and I_110, but not I_1, is not replaced by two intervals",
        witness=". ".join(covers) + ". J holds I_0, I_10, I_110 and no interval that is not in one "
        "of these, J' holds I_111; whichever two intervals replace J, here H0 = I_0 and H1 = I_10, "
        "all points of Lambda in one of the three, here I_110, are no longer covered.",
        corrected=_MASS,
    )


_MASS = (
    "For 0 < eta0, eta1, eta0 + eta1 < 1, eta0^s + eta1^s = 1 and the linear set Lambda with these "
    "ratios in I: for every interval J and every n, |J|^s is at least the sum of |I_w|^s over all "
    "intervals I_w of level n inside J (induction on n with the inequality (|H0| + |K| + |H1|)^s "
    ">= |H0|^s + |H1|^s for the parts of J on both sides of the largest gap that it contains). "
    "Every open cover of Lambda has a finite subcover, and for large n each I_w lies in one of its "
    "members; so its sum is at least the sum of all |I_w|^s = |I|^s. Hence (13) holds, and with "
    "(12) the s-dimensional Hausdorff measure of Lambda is exactly |I|^s and its dimension s."
)

_LINEAR = (
    "For the linear set with eta0 = {r0}, eta1 = {r1} and eta0^s_0 + eta1^s_0 = 1 in I = {i}: "
)

CLAIMS = (
    Claim(
        "H12",
        "If f is replaced by lines of slope {hi} on I0 = {i0} and {lo} on I1 = {i1}, Lambda in I = "
        "{i} has the Hausdorff dimension s_0: eta0^s_0 + eta1^s_0 = 1, eta0 = 1/{hi}, eta1 = "
        "1/{lo}.",
        _linear_dimension,
    ),
    Claim(
        "H14",
        _LINEAR + "if 0 < epsilon < eta1^n - eta1^(n+1) and the open L' contain the intervals L of "
        "level n + 1, |L'| - |L| <= epsilon/2^(n+1), then |L'| <= eta1^n |I| and |L'|^s_0 <= "
        "|L|^s_0 + epsilon/2^(n+1).",
        _covering_sum,
    ),
    Claim(
        "H15",
        _LINEAR + "where an open J contains H0, the gap K and H1, the largest intervals in it, and "
        "these are named such that |H0| >= |H1|, then |K| >= (1 - eta0 - eta1)/eta0 |H0| and |H1| "
        "<= eta1/eta0 |H0|.",
        _gap_estimates,
    ),
    Claim(
        "H17",
        _LINEAR + "replacing each J of a finite open cover by its two largest intervals H0, H1 "
        "keeps a cover of Lambda and does not increase the sum of |J|^s_0.",
        _replacing,
    ),
)
