"""Section 3.2: Claim 1 for the linear Cantor set, and the steps of its proof. H12, H14 to H17."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product

from proofs.trusted.flights import bits_for
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, exp, log
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, show, show_range
from proofs.trusted.paper.s32_sets.moran import MoranRoot, NoGap
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_LONGEST_WORD = 12


@dataclass(frozen=True)
class LinearSet(Conclusion):
    """The linear Cantor set Lambda of two ratios 0 < eta0 <= eta1, eta0 + eta1 < 1, in I.

    The closed interval I_w of a word w over 0, 1 has the left part I_w0, of eta0 times its length,
    the right part I_w1, of eta1 times its length, and between them its open gap. Lambda is the
    intersection of all E_n, the union of the 2^n intervals of level n, of words of n letters.
    What is concluded about it is a subclass.
    """

    ratios: Range
    interval: Range

    def __post_init__(self) -> None:
        """Raise Unproved where there is no such set."""
        if not 0 < self.ratios[0] <= self.ratios[1] or self.interval[0] >= self.interval[1]:
            raise Unproved("ratios in order and an interval of positive length are expected")
        if sum(self.ratios) >= 1:
            raise Unproved(f"there is no linear Cantor set {self.named}: eta0 + eta1 >= 1")

    @property
    def named(self) -> str:
        """What it is about."""
        first, second = map(show, self.ratios)
        return f"with (eta0, eta1) = ({first}, {second}) in I = {show_range(self.interval)}"

    @property
    def brief(self) -> str:
        return self.sentence.partition(". ")[0].rstrip(".")


@dataclass(frozen=True)
class ExactMeasure(LinearSet):
    """Theorem (Claim 1). What the sentence says. Proof. 0 < s < 1, as eta0 + eta1 < 1.

    1. |H0| <= |I_w0| = eta0 |I_w|, and so for H1. With k = 1 - eta0 - eta1 the function G(x, y) =
       (x + k + y)^s - x^s - y^s decreases in x and in y, since t^(s-1) decreases, and G(eta0, eta1)
       = 0; so G >= 0 on [0, eta0] x [0, eta1].
    2. q' = s ((c + x)^(s-1) - x^(s-1)) < 0, c > 0; q(eta1/eta0) = (1 - eta0^s - eta1^s) / eta0^s.
    3. Induction on n, for all similar sets; n = 0 is clear. Where all the I_w in J lie in I_0, or
       all in I_1, it is the statement for that part. Otherwise J contains the gap of I, and meets
       I_0 and I_1 in H0 and H1: by 1 the sum is at most |H0|^s + |H1|^s <= |J|^s. And Lambda is
       compact: finitely many members of an open cover suffice, and by Lebesgue's number each I_w of
       a large level is inside one of them.
    4. Let e be that minimum: |L'| <= eta1^(n+1) |I| + e <= eta1^n |I|, |L'|^s <= |L|^s + e^s, as
       (x + y)^s <= x^s + y^s for 0 < s < 1. The sum of all |L|^s is |I|^s.
    5. By 3 and 4 |I|^s is the infimum of the sums over covers by intervals no longer than any given
       bound. (Moran 1946, Hutchinson 1981 have the dimension, the measure is as in Falconer.)
    """

    @property
    def sentence(self) -> str:
        return (
            f"for the linear Cantor set Lambda {self.named}, I_w0 and I_w1 the end parts of an "
            "interval I_w, eta0 and eta1 times as long, and eta0^s + eta1^s = 1: (1) if H0 in I_w0 "
            "and H1 in I_w1 are intervals on both sides of the gap K of the same I_w, then |K|"
            " >= (1 - eta0 - eta1) max(|H0|/eta0, |H1|/eta1) and (|H0| + |K| + |H1|)^s >= |H0|^s + "
            "|H1|^s, whichever is longer; (2) 0 < s < 1, so that q(x) = (c + x)^s - 1 - x^s, c = "
            "(1 - eta1)/eta0, decreases on x > 0, and q(eta1/eta0) = 0; (3) for every interval J "
            "and every n, |J|^s is at least the sum of |I_w|^s over the intervals I_w of level n "
            "inside J, so that the sum of |J|^s over every open cover of Lambda is at least |I|^s, "
            "which is (13); (4) for n >= 0 and epsilon > 0 let the open L'_j contain the intervals "
            "L_j of level n + 1, with |L'_j| <= |L_j| + min((epsilon/2^(n+1))^(1/s), (eta1^n - "
            "eta1^(n+1)) |I|): then |L'_j| <= eta1^n |I|, |L'_j|^s <= |L_j|^s + epsilon/2^(n+1), "
            "and the sum of all |L'_j|^s is at most |I|^s + epsilon, which gives (12); (5) the "
            "Hausdorff dimension of Lambda is s and its s-dimensional measure is |I|^s."
        )

    @property
    def brief(self) -> str:
        return f"Claim 1 holds for the linear set {self.named}, 0 < s < 1"


@dataclass(frozen=True)
class LinearDimension(ExactMeasure):
    """The root s is in `root`; so the Hausdorff measure |I|^s of the linear set is enclosed."""

    root: Range

    @property
    def measure(self) -> Range:
        """Bounds of |I|^s."""
        return power(self.interval[1] - self.interval[0], self.root).range

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {"dimension": self.root, "measure": self.measure}


def power(base: Fraction, exponent: Range) -> Enclosure:
    """Enclose base^s for all s in an interval, base > 0, at the precision that this deserves."""
    bits = bits_for(exponent)
    return exp(Enclosure.of(*exponent, bits) * log(base, bits))


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


def _linear_dimension(of: Parameters, found: Found) -> Decision:
    """H12: the lines of these slopes must map I0 and I1 exactly onto I."""
    (low, high), (first, second) = of.interval, of.reciprocals
    ends = low + first * (high - low), high - second * (high - low)
    if (of.left, of.right) != ((low, ends[0]), (ends[1], high)):
        return undecided("lines of these slopes do not map I0 and I1 exactly onto I")
    for step in found.all(MoranRoot):
        if step.ratios == of.reciprocals:
            return decided(Verdict.VERIFIED, LinearDimension(step.ratios, of.interval, step.root))
    return undecided("no bracket of s_0 for the ratios 1 / slopes")


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


def _gap_function(of: Parameters, found: Found) -> Decision:
    """H16: exactly if eta0 + eta1 < 1."""
    if sum(of.moran_ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(of.moran_ratios))
    return decided(Verdict.VERIFIED, ExactMeasure(of.moran_ratios, of.interval))


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
        "H12",
        "3.2, Claim 1",
        "The Hausdorff dimension of the set Lambda is s_0",
        "If f is replaced by lines of slope {hi} on I0 = {i0} and {lo} on I1 = {i1}, Lambda in I = "
        "{i} has the Hausdorff dimension s_0: eta0^s_0 + eta1^s_0 = 1, eta0 = 1/{hi}, eta1 = "
        "1/{lo}.",
        _linear_dimension,
    ),
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
        "H16",
        "3.2, Claim 1, 3.",
        "is a monotonically decreasing function",
        "With eta0 = {r0}, eta1 = {r1} and eta0^s_0 + eta1^s_0 = 1, the function q(x) = "
        "((1 - eta1)/eta0 + x)^s_0 - 1 - x^s_0 decreases on x > 0 and q(eta1/eta0) = 0.",
        _gap_function,
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
