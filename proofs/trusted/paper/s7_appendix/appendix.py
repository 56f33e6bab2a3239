"""The appendix: A1, the marching algorithm; A2, the definitions and theorems of measure theory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import inf

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, show, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.formulas import Asked, Derivation, Equal, at
from proofs.trusted.paper.s2_foundations import displayed as eq
from proofs.trusted.paper.s2_foundations.separation import LAUNCH
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict

# -- A1 --------------------------------------------------------------------------------------------

_MARCH = (
    Equal(f"at({eq.PLASTIC}, eta=1)", "-2*sin(t/2)**2"),
    Equal(f"at({eq.PLASTIC}, eta=1/2)", eq.HALF),
    Equal(
        "at(4*(nu*cos(psi))**2 - (1 + nu*sin(psi))*(1 - 3*nu*sin(psi)), nu=-1/2)",
        "-sin(psi)*(1 + sin(psi)/4)",
    ),
    LAUNCH,
)


def _sampled(sign: int, psi: str, t: str) -> Asked:
    return at(eq.PLASTIC, sign, eta="1/2", nu="-1/2", psi=psi, t=t)


_SAMPLES = (
    *(_sampled(-1, "-1/1000000", t) for t in ("1/100", "471/50")),
    _sampled(1, "-1/1000000", "94247/10000"),
    _sampled(-1, "-1/1000000", "943/100"),
    at(f"at({eq.BEND}, s=sin(psi))", -1, eta="1/2", nu="-1/2", psi="387/100"),
    _sampled(-1, "387/100", "1/1000"),
    *(_sampled(1, "387/100", t) for t in ("1/100", "1/50")),
)


def _algorithm(*_: Range) -> Decision:
    """Decide A1: where the algorithm fails, and when it is right.

    s_n is the sign of (10), that is sign(nu) times that of the gap g(t) at t = n delta.
    (1) The resonant (10) is never positive. (2) At (1/2, -1/2) and 0 < psi < pi the quadratic form
    in `HALF` has a negative discriminant and is positive, so g > 0 but at t = 4 pi n; there
    t/4 = pi n, and g and g' are 0. (3) The form vanishes in at most two directions t/4 between 0
    and pi: so on (0, 4 pi) (10) is positive on one interval only, the one found within (9.42,
    9.43), and s_n = -1 for all other n up to 1256. (4) (10) is negative at first, by its second
    derivative, and up to t = 0.01 it has one zero, beyond 0.001, as more would be three. So s_1 =
    s_2 = 1 though the impact came before delta: the phase returned is that of n >= 3. For every
    small delta: at the phase where sticking begins g = g' = g'' = 0 > g''', so g(delta) < 0 and
    g(2 delta) < 0, also at the phases just below it, where g'' > 0 at the launch and the impact
    comes before delta.

    The sufficient condition: on (0, delta] g > 0 as g'' >= B - M t there, so g >= t^2 (B/2 - M t/6)
    > 0 for t < 3 B/M; after T g' <= -v + m s, so g <= -v s + m s^2/2 < 0 for s < 2 v/m. Then s_1 is
    the sign of a positive gap, s_n has it or is 0 as long as n delta <= T, and the next n has the
    other. |X''| <= eta^2 r, |X'''| <= eta^3 r, r the bound of |X|, and |Z''|, |Z'''| <= |nu|.
    """
    return Decision(
        Verdict.REFUTED,
        "at eta = 1, nu < 0 it never ends, whatever delta; at (1/2, -1/2) with delta = 1/100 it "
        "steps over an impact (error > 3), and over one before its first step (error > 2 delta)",
        witness="(1) eta = 1, nu < 0, any psi_k: the left side of (10) is -2 sin^2(t/2) <= 0, t = "
        "psi - psi_k: s_1 s_n = -1 for no n and no delta; the mass touches the table at t = 2 pi. "
        "(2) (eta, nu) = (1/2, -1/2), any psi_k with 0 < psi_k < pi: the left side of (10) is < 0 "
        "but at t = 4 pi n, where it is 0: again it does not end, for any delta. (3) (1/2, -1/2), "
        "psi_k = -1/1000000, delta = 1/100: the impact is at t < 9.4247, between the signs - at "
        "9.42 and + at 9.4247; s_n = -1 for n = 1, ..., 1256, so the phase returned is off by more "
        "than 3. (4) (1/2, -1/2), psi_k = 3.87, delta = 1/100: the impact is at 0.001 < t < 0.01, "
        "and s_1 = s_2 = 1 is the sign below the table: the phase returned is off by more than 2 "
        "delta.",
        corrected="Let g(t) be the distance of mass and table at the time t after a plastic impact "
        "at phase psi_k, in units of |p|, T its first zero, v = -g'(T) > 0, and B = sign(nu) (nu "
        "(1 - eta^2) sin psi_k - eta^2) > 0. Let r = 1 + |nu| + |nu|/eta, m = eta^2 r + |nu|, "
        "M = eta^3 r + |nu|. If 0 < delta < T and g < 0 on (T, T + delta], then the algorithm "
        "ends, with 0 < n* delta - T <= delta; for that delta < min(3 B/M, 2 v/m) suffices. If g "
        "never changes its sign it ends for no delta; for eta = p/q and nu < 0 that is so when g > "
        "0 on (0, 2 pi q). Where eta is not 1 and |eta^2/(nu (1 - eta^2))| < 1, there is for every "
        "small delta an interval of phases, just before those that stick, at which it is wrong by "
        "more than delta. On phases that stick it is not to be used: s_1 is the sign below the "
        "table.",
    )


@dataclass(frozen=True)
class Marching:
    """A1: what follows from formulas, and from phases that never impact again."""

    derivation: Derivation

    def decide(self, of: Parameters, found: Sequence[object]) -> Decision:
        """Decide A1; phases of the parameters at which the algorithm does not end are named."""
        decided = self.derivation.decide(of, found)
        never = next((step for step in found if isinstance(step, NeverImpacts)), None)
        if decided.verdict is not Verdict.REFUTED or never is None:
            return decided
        here = (
            f" At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) it ends for no delta from any phase "
            f"in {show_range(never.phases)}, where g > 0 on (0, {2 * of.eta.denominator} pi)."
        )
        return replace(
            decided,
            witness=f"{decided.witness}{here}",
            corrected=f"{decided.corrected}{here}",
        )

    @property
    def claim(self) -> Claim:
        """The claim, as the catalogue has it."""
        return Claim(self.derivation.id, self.derivation.text, self.decide)


MARCHING = Marching(
    Derivation(
        "A1",
        "For small delta the marching algorithm of A.1 terminates and returns the next impact "
        "phase with an error of at most delta.",
        _MARCH,
        _algorithm,
        _SAMPLES,
    )
)

# -- A2 --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class MethodOne(Conclusion):
    """Method I on the finite set {0, ..., points - 1}: from sets and values to a set function.

    outer[A], A as a bit mask, is the infimum of sums of values over countable covers of A.
    """

    points: int
    sets: tuple[frozenset[int], ...]
    values: tuple[Fraction, ...]
    outer: tuple[Fraction | float, ...]


_EMPTY: frozenset[int] = frozenset()
NEGATIVE = (1, (_EMPTY, frozenset({0})), (Fraction(0), Fraction(-1)))


def _measures(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide A2. Definitions 1-5, 7 are the usual ones; Theorem 5 is Caratheodory's.

    Theorem 6, tau >= 0: mu*(empty) <= tau(empty) = 0; a cover of B covers A in B; covers of A_k
    with sums <= mu*(A_k) + e/2^k are together one of the union. Definition 8: fewer covers, larger
    infima; a supremum of outer measures is one, as mu_n*(union) <= sum mu_n*(A_k) <= sum mu*(A_k).
    Theorem 7: diam^t <= n^(s - t) diam^s on T_n, so mu_n^t(E) <= n^(s - t) mu^s(E) -> 0.
    Definition 10: by Theorem 7 the s with mu^s(E) = infinity are an interval from 0, empty or not,
    and mu^s(E) = 0 above its end. Claim 1: an open set of diameter d lies in an open interval of
    length d, so intervals give the same mu_n as open sets of R; and any bounds d_n -> 0 in the
    place of 1/n give the same limit, as T_n for one sequence contains one for the other.
    """
    bad = [
        step
        for step in found
        if isinstance(step, MethodOne)
        and (step.points, step.sets, step.values) == NEGATIVE
        and step.outer[0] == -inf
    ]
    if not bad:
        return undecided("not proved: Method I with a negative premeasure")
    return Decision(
        Verdict.CONDITIONAL,
        "true with tau >= 0 in Definition 6 (as in Theorem 6), and diameter(empty set) = 0; with "
        "tau < 0 Method I gives no outer measure",
        witness="conditions: premeasures are >= 0, and the diameter of the empty set is 0. Without "
        "the first: X = {x}, T = {empty set, X}, tau(empty set) = 0, tau(X) = -1 is a premeasure "
        "on a covering family by Definition 6, all diameters are 0 <= 1/n, and Method I gives "
        "mu_n*(empty set) = -infinity, not 0: Definition 8 gives no outer measure. Without the "
        "second, diameter(empty set) = sup of the empty set, and tau(empty set) of Definition 9, "
        "a power of it, is not 0.",
        corrected="Let premeasures tau be >= 0 and the diameter of the empty set 0. Then Theorems "
        "5 (Caratheodory), 6 and 7 are true; Method II gives an outer measure, the supremum of the "
        "mu_n*; and dim(E) of Definition 10 is the one number d in [0, infinity] with mu^(s)(E) = "
        "infinity for 0 < s < d and mu^(s)(E) = 0 for s > d. At s = d the measure may be 0, finite "
        "or infinite; if it is positive and finite for some s > 0, then dim(E) = s, as the proof "
        "of Claim 1 uses. That proof takes open intervals of length <= eta_1^n |I| in the place of "
        "open sets of diameter <= 1/n: mu_n* is another, its limit the same.",
    )


MEASURES = Claim(
    "A2",
    "The definitions and theorems of measure theory in A.2 are right as stated.",
    _measures,
)
