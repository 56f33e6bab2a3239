"""Section 3.2: the steps of the proof of Claim 1, for the linear Cantor set. H14, H15 and H17."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s32_sets.linear import ExactMeasure, LinearSet, power
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_LONGEST_WORD = 12


@dataclass(frozen=True)
class Excess(LinearSet):
    """Theorem. (11) fails for all n >= level >= 1 and all epsilon that it admits: as the sentence.

    root: bounds of s. Proof. s < 1. Let d = epsilon/2^(n+1), l = |L| <= eta1^(n+1) |I|. As t^s is
    concave, (l + d)^s - l^s >= s (l + d)^(s-1) d, which is > d if (l + d)^(1-s) < s. And l + d is
    less than u = eta1^(n+1) |I| + (eta1^n - eta1^(n+1))/2^(n+1), which decreases in n: u^(1-s) < s
    at n = level is enough. The longest L' has the length eta1^(n+1) |I| + d.
    """

    root: Range

    def __post_init__(self) -> None:
        """Raise Unproved unless it refutes (11)."""
        super().__post_init__()
        if not 0 < self.root[0] <= self.root[1] < 1:
            raise Unproved("a root between 0 and 1 is expected")
        _ = self.level

    @cached_property
    def level(self) -> int:
        """The first n at which the bounds give u^(1-s) < s."""
        longest, (low, high), (least, most) = self.ratios[1], self.interval, self.root
        for n in range(1, _LONGEST_WORD + 1):
            u = longest ** (n + 1) * (high - low) + longest**n * (1 - longest) / 2 ** (n + 1)
            if power(u, (1 - most, 1 - least)).range[1] < least:
                return n
        raise Unproved(f"(11) is not refuted from n = {_LONGEST_WORD} on")

    @property
    def sentence(self) -> str:
        length, last = self.interval[1] - self.interval[0], 0
        while 2 ** (last + 2) * length < 1:
            last += 1
        outside = (
            "the longest L' is not in T_n exactly if epsilon > 2^(n+1) |I| (eta1^n - eta1^(n+1)), "
            f"which this allows for n <= {last} only"
        )
        inside = "every L' is in T_n"
        return (
            f"{self.brief}, every epsilon with 0 < epsilon < eta1^n - eta1^(n+1) and every L of "
            "level n + 1: if |L'| = |L| + epsilon/2^(n+1), as (11) allows, then |L'|^s > |L|^s + "
            "epsilon/2^(n+1), and so for their sum; "
            f"{outside if last else inside}."
        )

    @property
    def brief(self) -> str:
        return f"(11) fails for the linear set {self.named}, every n >= {self.level}"


@dataclass(frozen=True)
class ShortGap(LinearSet):
    """Theorem. If eta0 < eta1, the gap estimates fail for H0 the longer one, as the sentence says.

    Proof. 1. J contains no I_w larger than I_001 and I_01. I_01 is the longer, for eta0^2 eta1 <
    eta0 eta1, and |K| = (1 - eta0 - eta1) eta0 |I| = (1 - eta0 - eta1)/eta1 |I_01|. 2. Where eta0
    and eta1 are exchanged if the right one is longer, |H0| <= eta0/eta1 |H1| is asked for: with
    k ones and j zeros it fails if eta0^j < eta1^k and eta1^(k-1) < eta0^(j-1).
    """

    def __post_init__(self) -> None:
        """Raise Unproved where the ratios are equal: then `ExactMeasure`, (1), is what is asked."""
        super().__post_init__()
        if self.ratios[0] == self.ratios[1]:
            raise Unproved("eta0 = eta1: the names do not matter")

    @property
    def sentence(self) -> str:
        (left, right), sizes = self.ratios, range(1, _LONGEST_WORD)
        exchanged = (
            " Nor does it help to exchange eta0 and eta1 where the right one is longer: an interval"
            f" may hold H0 = I_0{'1' * k}, the gap of I, H1 = I_1{'0' * j} and no larger ones; |H0|"
            " < |H1|, but |H0| > eta0/eta1 |H1|."
            for k, j in product(sizes, sizes)
            if left**j < right**k and right ** (k - 1) < left ** (j - 1)
        )
        return (
            f"for the linear set {self.named} an interval J from the gap of I_00 to that of I holds"
            " I_001, the gap K of I_0, I_01 and no larger ones; H0 = I_01 is the longer, and |K| = "
            f"(1 - eta0 - eta1)/eta1 |H0| < (1 - eta0 - eta1)/eta0 |H0|.{next(exchanged, '')}"
        )


@dataclass(frozen=True)
class Uncovered(LinearSet):
    """Theorem. Replacing an interval of a cover by two intervals may uncover points of Lambda.

    Proof. An I_w in J lies in I_0, I_10 or I_110, since J contains neither I nor I_1 nor I_11. So
    two of them leave points of one of these three uncovered, and J' contains none of the three.
    """

    @property
    def sentence(self) -> str:
        return (
            f"the linear set {self.named} is covered by J, from below I to the gap of I_11, and "
            "J', from there to above I. J holds I_0, I_10, I_110 and no interval that is not in "
            "one of these, J' holds I_111; whichever two intervals replace J, here H0 = I_0 and "
            "H1 = I_10, all points of one of the three, here of I_110, are no longer covered."
        )


def linear_sets(of: Parameters) -> list[ExactMeasure]:
    """Return Claim 1 for the ratios 1 / slopes and, where they differ, for those printed."""
    pairs = dict.fromkeys((of.reciprocals, of.moran_ratios))
    return [ExactMeasure(ratios, of.interval) for ratios in pairs]


def _covering_sum(of: Parameters, found: Found) -> Decision:
    """H14: for both pairs of ratios."""
    sets, roots = linear_sets(of), {each.ratios: each.root for each in found.all(MoranRoot)}
    if any(each.ratios not in roots for each in sets):
        return undecided("no bracket of s_0 for one of the pairs of ratios")
    refuted = [Excess(each.ratios, each.interval, roots[each.ratios]) for each in sets]
    return decided(Verdict.REFUTED, *refuted, corrected=sets[-1:])


def _gap_estimates(of: Parameters, found: Found) -> Decision:
    """H15: true for equal ratios, false for others; both pairs must agree."""
    sets = linear_sets(of)
    true = [each for each in sets if each.ratios[0] == each.ratios[1]]
    false = [ShortGap(each.ratios, each.interval) for each in sets if each not in true]
    if true and false:
        return undecided(f"true {true[0].named}, false {false[0].named}")
    if true:
        return decided(Verdict.VERIFIED, *true)
    return decided(Verdict.REFUTED, *false, corrected=sets[-1:])


def _replacing(of: Parameters, found: Found) -> Decision:
    """H17: for both pairs of ratios."""
    sets = linear_sets(of)
    covers = [Uncovered(each.ratios, each.interval) for each in sets]
    return decided(Verdict.REFUTED, *covers, corrected=sets[-1:])


_LINEAR = (
    "For the linear set with eta0 = {r0}, eta1 = {r1} and eta0^s_0 + eta1^s_0 = 1 in I = {i}: "
)
ROWS = (
    Row(
        "H14",
        "3.2, (11)",
        "This implies that L'_j is in T_n for all j",
        _LINEAR + "if 0 < epsilon < eta1^n - eta1^(n+1) and the open L' contain the intervals L of "
        "level n + 1, |L'| - |L| <= epsilon/2^(n+1), then |L'| <= eta1^n |I| and |L'|^s_0 <= "
        "|L|^s_0 + epsilon/2^(n+1).",
        _covering_sum,
    ),
    Row(
        "H15",
        "3.2, Claim 1, 1.-2.",
        "Without loss of generality, let |H0| >= |H1|",
        _LINEAR + "where an open J contains H0, the gap K and H1, the largest intervals in it, and "
        "these are named such that |H0| >= |H1|, then |K| >= (1 - eta0 - eta1)/eta0 |H0| and |H1| "
        "<= eta1/eta0 |H0|.",
        _gap_estimates,
    ),
    Row(
        "H17",
        "3.2, Claim 1",
        "does not increase the sum",
        _LINEAR + "replacing each J of a finite open cover by its two largest intervals H0, H1 "
        "keeps a cover of Lambda and does not increase the sum of |J|^s_0.",
        _replacing,
    ),
)
