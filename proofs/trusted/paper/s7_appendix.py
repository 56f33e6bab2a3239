"""The appendix: A1, the marching algorithm; A2, the definitions and theorems of measure theory."""

from __future__ import annotations

from dataclasses import replace

from proofs.trusted.kernel.values import Equal
from proofs.trusted.paper import s2_foundations as eq
from proofs.trusted.paper.formulas import Passage, at, derived_row, theorem
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Verdict

# -- A1: the marching algorithm --------------------------------------------------------------------


_FORM = Equal.read(
    "at(4*(nu*cos(psi))**2 - (1 + nu*sin(psi))*(1 - 3*nu*sin(psi)), nu=-1/2)",
    "-sin(psi)*(1 + sin(psi)/4)",
)
_STEPS = tuple(
    at(eq.PLASTIC, sign, eta="1/2", nu="-1/2", psi=psi, t=t)
    for sign, psi, t in (
        (-1, "-1/1000000", "1/100"),
        (-1, "-1/1000000", "471/50"),
        (1, "-1/1000000", "94247/10000"),
        (-1, "-1/1000000", "943/100"),
        (-1, "387/100", "1/1000"),
        (1, "387/100", "1/100"),
        (1, "387/100", "1/50"),
    )
)
_BENDS = at(eq.BEND, -1, eta="1/2", nu="-1/2", psi="387/100")


@theorem(
    Equal.read(f"at({eq.PLASTIC}, eta=1)", "-2*sin(t/2)**2"),
    eq.HALF,
    _FORM,
    eq.LAUNCH,
    values=(*_STEPS, _BENDS),
)
def missteps(*_: str) -> str:
    """Proof. s_n is the sign of (10) at t = n delta, sign(nu) times that of the gap g. (1) is the
    closed form. (2) For 0 < psi < pi the quadratic form in eq.HALF has a negative discriminant,
    _FORM, and is positive: g > 0 but at t = 4 pi n, where g = g' = 0. (3) The form vanishes in at
    most two directions t/4 between 0 and pi: on (0, 4 pi) (10) is positive on one interval only,
    the one within (9.42, 9.43) (_STEPS), and s_n = -1 for all other n up to 1256. (4) (10) is
    negative at first (_BENDS, eq.LAUNCH), and up to t = 0.01 it has one zero, beyond 0.001
    (_STEPS), as more would be three: s_1 = s_2 = 1 though the impact came before delta.
    """
    return (
        "It never ends, whatever delta, (1) at eta = 1, nu < 0, any psi_k, where (10) is -2 "
        "sin^2(t/2) <= 0, t = psi - psi_k, and s_1 s_n is never -1, and (2) at (eta, nu) = (1/2, "
        "-1/2), 0 < psi_k < pi, where (10) is < 0 but at t = 4 pi n, where it is 0. (3) At (1/2, "
        "-1/2), psi_k = -1/1000000, delta = 1/100 the impact is at t < 9.4247, between the signs - "
        "at 9.42 and + at 9.4247; s_n = -1 for n = 1, ..., 1256, so the phase returned is off by "
        "more than 3, on the line. (4) At (1/2, -1/2), psi_k = 3.87, delta = 1/100 the impact is "
        "at 0.001 < t < 0.01, and s_1 = s_2 = 1 is the sign below the table: the phase returned is "
        "off by more than 2 delta, on the line."
    )


@theorem(eq.LAUNCH)
def marching() -> str:
    """Proof. 1. On (0, delta] g'' >= B - M t, so g >= t^2 (B/2 - M t/6) > 0 for t < 3 B/M; after T
    g' <= -v + m s, so g <= -v s + m s^2/2 < 0 for s < 2 v/m: |X''| <= eta^2 r, |X'''| <= eta^3 r, r
    bounding |X|, and |Z''|, |Z'''| <= |nu|. 2. Then s_1 is the sign of a positive gap, s_n has it
    or is 0 as long as n delta <= T, and the next n has the other. 3. At the phase where sticking
    begins g = g' = g'' = 0 > g''' (eq.LAUNCH): g(delta) < 0 and g(2 delta) < 0, also at the phases
    just below it, where g'' > 0 at the launch and the impact comes before delta.
    """
    return (
        "Let g(t) be the gap at the time t after a plastic impact at phase psi_k, in units of |p|, "
        "T its first zero, v = -g'(T) > 0, and B = sign(nu) (nu (1 - eta^2) sin psi_k - eta^2) > "
        "0. Let r = 1 + |nu| + |nu|/eta, m = eta^2 r + |nu|, M = eta^3 r + |nu|. If 0 < delta < T "
        "and g < 0 on (T, T + delta], then the algorithm ends, with 0 < n* delta - T <= delta; for "
        "that delta < min(3 B/M, 2 v/m) suffices. If g never changes its sign it ends for no "
        "delta; for eta = p/q and nu < 0 that is so when g > 0 on (0, 2 pi q). Where eta is not 1 "
        "and |eta^2/(nu (1 - eta^2))| < 1, there is for every small delta an interval of phases, "
        "just before those that stick, at which it is wrong by more than delta. On phases that "
        "stick it is not to be used: s_1 is the sign below the table."
    )


_MARCHING = derived_row(
    Passage("A1", "A.1", "We know that the solution is between"),
    "For small delta the marching algorithm of A.1 terminates and returns the next impact phase "
    "with an error of at most delta.",
    Verdict.REFUTED,
    missteps,
    corrected=(marching,),
)


def _decide_marching(of: Parameters, found: Found) -> Decision:
    """Decide A1, and name phases, at the parameters given or at others, that never impact again."""
    decision = _MARCHING.decide_by(of, found)
    if decision.verdict is not Verdict.REFUTED:
        return decision
    return decision._replace(corrected=(*decision.corrected, *found.elsewhere(NeverImpacts)))


# -- A2: measures ----------------------------------------------------------------------------------


@theorem()
def premeasures() -> str:
    """Proof. Definitions 1-5, 7 are the usual ones; Theorem 5 is Caratheodory's. Theorem 6, tau >=
    0: mu*(empty) <= tau(empty) = 0; a cover of B covers A in B; covers of A_k with sums <= mu*(A_k)
    + e/2^k are together one of the union. Definition 8: fewer covers, larger infima; a supremum of
    outer measures is one, as mu_n*(union) <= sum mu_n*(A_k) <= sum mu*(A_k). Theorem 7: diam^t <=
    n^(s - t) diam^s on T_n, so mu_n^t(E) <= n^(s - t) mu^s(E) -> 0. Definition 10: by Theorem 7 the
    s with mu^s(E) = infinity are an interval from 0, empty or not, and mu^s(E) = 0 above its end.
    Claim 1: an open set of diameter d lies in an open interval of length d, so intervals give the
    same mu_n as open sets of R; and any bounds d_n -> 0 in the place of 1/n give the same limit, as
    T_n for one sequence contains one for the other.
    """
    return (
        "True if premeasures tau are >= 0, as in Theorem 6, and the diameter of the empty set is "
        "0. Then Theorems 5 (Caratheodory), 6 and 7 are true; Method II gives an outer measure, "
        "the supremum of the mu_n*; and dim(E) of Definition 10 is the one number d in [0, "
        "infinity] with mu^(s)(E) = infinity for 0 < s < d and mu^(s)(E) = 0 for s > d. At s = d "
        "the measure may be 0, finite or infinite; if it is positive and finite for some s > 0, "
        "then dim(E) = s, as the proof of Claim 1 uses. That proof takes open intervals of length "
        "<= eta_1^n |I| in the place of open sets of diameter <= 1/n: mu_n* is another, its limit "
        "the same."
    )


@theorem()
def not_premeasures() -> str:
    """Proof. X, taken k times, covers every set, and all diameters are 0 <= 1/n."""
    return (
        "Definition 6 allows X = {x}, T = {empty set, X}, tau(empty set) = 0, tau(X) = -1, where "
        "covers by X, taken k times, have the sum -k, so that mu_n*(empty set) = -infinity, not 0: "
        "Definition 8 gives no outer measure. With diameter(empty set) = sup of the empty set, "
        "tau(empty set) of Definition 9, a power of it, is not 0."
    )


ROWS = (
    replace(_MARCHING, decide_by=_decide_marching),
    derived_row(
        Passage("A2", "A.2", "Some Definitions in Measure Theory"),
        "The definitions and theorems of measure theory in A.2 are right as stated.",
        Verdict.CONDITIONAL,
        premeasures,
        not_premeasures,
    ),
)
