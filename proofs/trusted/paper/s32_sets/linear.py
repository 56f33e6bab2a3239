"""Section 3.2: Claim 1 for the linear Cantor set, and its function q. Claims H12 and H16."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.elementary import exp, log
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.numbers import Range, bits_for, show, show_range
from proofs.trusted.paper.s32_sets.moran import NoGap
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


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


def _gap_function(of: Parameters, found: Found) -> Decision:
    """H16: exactly if eta0 + eta1 < 1."""
    if sum(of.moran_ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(of.moran_ratios))
    return decided(Verdict.VERIFIED, ExactMeasure(of.moran_ratios, of.interval))


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
        "H16",
        "3.2, Claim 1, 3.",
        "is a monotonically decreasing function",
        "With eta0 = {r0}, eta1 = {r1} and eta0^s_0 + eta1^s_0 = 1, the function q(x) = "
        "((1 - eta1)/eta0 + x)^s_0 - 1 - x^s_0 decreases on x > 0 and q(eta1/eta0) = 0.",
        _gap_function,
    ),
)
