"""Section 5, soft springs: S11 to S23, the limit map, its stability and its bifurcations."""

from __future__ import annotations

from proofs.trusted.numbers import Range, between
from proofs.trusted.paper import Decision
from proofs.trusted.paper.formulas import Derivation, Equal, at, differ
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import soft_lemmas as given
from proofs.trusted.paper.s5_soft import soft_theorems as theorems
from proofs.trusted.verdicts import Verdict


def _verified(why: str, corrected: str | None = None) -> Decision:
    return Decision(Verdict.VERIFIED, why, corrected=corrected)


def _refuted(why: str, witness: str, corrected: str) -> Decision:
    return Decision(Verdict.REFUTED, why, witness=witness, corrected=corrected)


_MINUS_ONE = f"at({eq.AT_MINUS_ONE}, alpha={eq.ALPHA_RHO})"


def _discriminant(difference: Range) -> Decision:
    return _refuted(
        "the two sides differ by 2 (1 + epsilon) alpha",
        f"at epsilon = 1/2, alpha = 1 the right side minus the left one is {between(difference)}; "
        "always it is 2 (1 + epsilon) alpha",
        "For all epsilon and alpha (1 - epsilon^2 - (1 + epsilon) alpha/2)^2 - 2 epsilon^2 (1 + "
        "epsilon) alpha = (1 - epsilon^2)^2 + ((1 + epsilon) alpha/2)^2 - (1 + epsilon) (1 + "
        "epsilon^2) alpha = ((1 + epsilon) alpha/2 - (1 - epsilon)^2) ((1 + epsilon) alpha/2 - "
        "(1 + epsilon)^2), which is negative for (1 - epsilon)^2 < (1 + epsilon) alpha/2 < (1 + "
        "epsilon)^2.",
    )


def _complex(value: Range) -> Decision:
    return _refuted(
        f"at m = 1, epsilon = 1/2, rho = 11/5 the discriminant is in {between(value)}",
        "m = 1, epsilon = 1/2, rho = 11/5: the eigenvalues are not real, their discriminant is in "
        f"{between(value)}",
        "Let 0 <= epsilon < 1, c = 2 pi m, alpha = sqrt((1 + epsilon)^2 rho^2 - (1 - epsilon)^2 "
        "c^2). The eigenvalues at psi_o are real exactly if (1 + epsilon) alpha/2 is at most (1 "
        "- epsilon)^2 or at least (1 + epsilon)^2, that is if (1 + epsilon)^2 rho^2 is at most "
        "(1 - epsilon)^2 c^2 + 4 (1 - epsilon)^4/(1 + epsilon)^2 or at least (1 - epsilon)^2 c^2 "
        "+ 4 (1 + epsilon)^2; in between, for epsilon > 0, they are complex with the modulus "
        "epsilon, so the fixed point is a sink (a focus).",
    )


def _first_kind(printed: Range, alpha: Range, other: Range) -> Decision:
    return _refuted(
        f"at m = 1, epsilon = 1/2, rho = 43/20 < rho_m there is a sink, alpha in {between(alpha)}",
        f"m = 1, epsilon = 1/2, rho = 43/20: rho_m - rho is in {between(printed)}, alpha in "
        f"{between(alpha)}, and the characteristic polynomial, with the product 1/4 of its roots, "
        f"is positive at 1 and in {between(other)} at -1, so both are inside the unit circle: a "
        "sink",
        theorems.DIAGRAM,
    )


def _second_kind(printed: Range, alpha: Range, other: Range) -> Decision:
    return _refuted(
        f"at m = 1, epsilon = 9/10, rho = 1 > rho_m^f there is a sink, alpha in {between(alpha)}",
        f"m = 1, epsilon = 9/10, rho = 1: rho - rho_m^f is in {between(printed)}, alpha in "
        f"{between(alpha)}, and the characteristic polynomial, with the product 81/100 of its "
        f"roots, is positive at 1 and in {between(other)} at -1: a sink",
        f"{theorems.DIAGRAM} With a = 4 (1 - epsilon)/(1 - 2 epsilon^2), the paper's value of "
        "alpha at its rho_m^f, a^2 - (4 (1 + epsilon^2)/(1 + epsilon))^2 = 64 epsilon^4 (1 - "
        "epsilon^2 - epsilon^4)/((1 - 2 epsilon^2)^2 (1 + epsilon)^2): so rho_m^f is rho_F for "
        "epsilon = 0 and epsilon^2 = (sqrt(5) - 1)/2 only; it is larger, and rho > rho_m^f is "
        "sufficient but not necessary for a saddle of the second kind, if 0 < epsilon^2 < "
        "(sqrt(5) - 1)/2, epsilon^2 not 1/2; it is smaller, with sinks between, if epsilon^2 > "
        "(sqrt(5) - 1)/2.",
    )


def _values(at_minus_one: Range) -> Decision:
    return _refuted(
        "at rho_m the characteristic polynomial is 1 - epsilon^2 at 1, no saddle-node; at rho_m^f, "
        f"epsilon = 1/2, it is {between(at_minus_one)} at -1, no flip",
        "at rho_m alpha = 2 (1 - epsilon), the characteristic polynomial is 1 - epsilon^2 at 1, "
        "so 1 is no eigenvalue, and two fixed points are there already for rho < rho_m; for "
        f"epsilon = 1/2, any m, it is {between(at_minus_one)} at -1 at rho_m^f, so -1 is no "
        "eigenvalue",
        f"{theorems.DIAGRAM} So rho_SN is the value of the saddle-node bifurcation and rho_F that "
        f"of the flip. {theorems.STIFF}",
    )


def _bouncing_ball() -> Decision:
    return _refuted(
        "same fixed points and saddle-node; but determinant epsilon^2, not epsilon, and a later "
        "flip",
        "the map of [1], (phi, w) to (phi + w, epsilon w - gamma cos(phi + w)), gamma = (1 + "
        "epsilon) rho, has determinant epsilon everywhere, and at w = 2 pi m the trace 1 + "
        "epsilon + gamma sin phi: it flips at |gamma sin phi| = 2 (1 + epsilon); the limit map "
        "has determinant epsilon^2 and flips at alpha = (1 + epsilon) rho sin psi = 4 (1 + "
        "epsilon^2)/(1 + epsilon), larger by 2 (1 - epsilon)^2/(1 + epsilon)",
        "Without the high-bounce assumption the fixed points of [1] and their saddle-node value "
        "(1 + epsilon) rho = (1 - epsilon) 2 pi m are the same. The stability is not: the flip "
        "is at (1 + epsilon) rho = sqrt((4 (1 + epsilon^2)/(1 + epsilon))^2 + (1 - epsilon)^2 (2 "
        "pi m)^2), that of the map of [1] at sqrt((2 (1 + epsilon))^2 + (1 - epsilon)^2 (2 pi "
        "m)^2), which is smaller for every epsilon in [0, 1); the products of the eigenvalues "
        "are epsilon^2 and epsilon.",
    )


def _rho_o(printed: Range, true: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        f"the slope is -1 at sqrt(16 + (2 pi m)^2), for m = 1 {between(true)}; at the printed "
        f"rho_o, {between(printed)}, it is 0",
        f"at the printed rho_o, in {between(printed)} for m = 1, alpha = sqrt(rho_o^2 - (2 pi "
        "m)^2) = 2 and the slope 1 - alpha/2 of f at its fixed point is 0, not -1, for every m",
        "In the plastic case the slope of f at psi_o = arccos(2 pi m/rho) is 1 - sqrt(rho^2 - (2 "
        "pi m)^2)/2: -1 exactly at rho_o = sqrt(16 + (2 pi m)^2), which the paper's rho_m^f "
        "gives too. sqrt(4 + (2 pi m)^2), where the slope is 0, is the value below which the "
        "mass sticks at this fixed point: the gap is t^2 (rho sin psi_o/2 - 1) + (2 pi m) t^3/6 "
        "+ O(t^4) after the impact, rho sin psi_o = sqrt(rho^2 - (2 pi m)^2).",
        {"rho_flip": true, "rho_o_printed": printed},
    )


def _six(by_rho: Range, third: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        "at the printed rho_o f has slope 0; at sqrt(16 + (2 pi m)^2) all hold but f = 0, which is "
        "f = psi_o",
        witness="at rho_o = sqrt(4 + (2 pi m)^2), for every m, df/dpsi = 0, d(f^2)/drho = pi "
        "m/rho_o, d^2(f^2)/dpsi drho = 0 and d^3(f^2)/dpsi^3 = 0: four of the six fail; f(psi_o) = "
        "psi_o is not 0 there, nor at sqrt(16 + (2 pi m)^2), since 0 < 2 pi m/rho < 1",
        corrected="For every m >= 1, at rho_o = sqrt(16 + (2 pi m)^2) and psi_o = arccos(2 pi "
        "m/rho_o): f = psi_o, df/dpsi = -1, d(f^2)/drho = 0, d^2(f^2)/dpsi^2 = 0, d^2(f^2)/dpsi "
        "drho = rho_o/4 > 0, d^3(f^2)/dpsi^3 = -(3 pi^2 m^2 + 2) < 0.",
        quantities={"f2_psi_rho": by_rho, "f2_psi_psi_psi": third},
    )


def _doubling(stiff: Range, *gap: Range) -> Decision:
    finite = (
        f"rho in {between(stiff, 15)}, and the flight from its fixed point has gap'' > 0 up to "
        "time 1/2, gap > 0 from 1/2 to 6 and gap' < 0 from 6 to 6.3, so its first impact is at 2 "
        "pi."
    )
    return Decision(
        Verdict.VERIFIED,
        "supercritical, at rho = sqrt(16 + (2 pi m)^2), not at the printed rho_o, for every m; for "
        "every 0 < epsilon < 1 as well; and for springs of any stiffness",
        corrected=f"{theorems.FLIP}{theorems.ADMISSIBLE} {theorems.STIFF_FLIP}{finite}",
        quantities={"rho_flip_at_k_tenth": stiff},
    )


STABILITY = (
    Derivation(
        "S11",
        "The Jacobian of the limit map at (psi_o, lambda_o), its four entries.",
        given.JACOBIAN,
        lambda: _verified(
            "all four entries, by implicit differentiation of the limits of (24), (25), for the "
            "branch sin psi_o >= 0 of the inverse cosine; on the other alpha has the other sign"
        ),
    ),
    Derivation(
        "S12",
        "The eigenvalues gamma_1, gamma_2 of this matrix are as displayed, with product epsilon^2.",
        (
            given.DETERMINANT,
            Equal(" + ".join(eq.EIGENVALUES), eq.TRACE),
            Equal("*".join(f"({one})" for one in eq.EIGENVALUES), "epsilon**2"),
            *given.TRACE,
        ),
        lambda: _verified("their sum is the trace, their product epsilon^2, the determinant"),
    ),
    Derivation(
        "S13",
        "The displayed identity for the discriminant.",
        (
            Equal(eq.DISCRIMINANT, eq.TRUE_SUM),
            Equal(f"({eq.PRINTED_SUM}) - ({eq.DISCRIMINANT})", "2*(1 + epsilon)*alpha"),
            given.ROOTS,
        ),
        _discriminant,
        (differ(eq.PRINTED_SUM, eq.DISCRIMINANT, epsilon="1/2", alpha="1"),),
    ),
    Derivation(
        "S14",
        "The eigenvalues of this matrix are real.",
        (*given.JACOBIAN, given.DETERMINANT, given.ROOTS),
        _complex,
        (
            at(
                f"at({eq.DISCRIMINANT}, alpha={eq.ALPHA_RHO})",
                -1,
                epsilon="1/2",
                rho="11/5",
                m="1",
            ),
        ),
    ),
    Derivation(
        "S15",
        "For 0 < epsilon < 1 the fixed points are sinks or saddles.",
        given.CHARACTERISTIC,
        lambda: Decision(
            Verdict.CONDITIONAL,
            "true except at two values of rho for each m and epsilon, rho_SN and rho_F",
            witness="the condition is that alpha is neither 0 nor 4 (1 + epsilon^2)/(1 + epsilon): "
            "there an eigenvalue is 1 or -1",
            corrected=theorems.DIAGRAM,
        ),
    ),
    Derivation(
        "S16",
        "The fixed points are saddles of the first kind, 0 < gamma_2 < 1 < gamma_1, if rho < rho_m "
        "= 2 ((1 - epsilon)/(1 + epsilon)) sqrt(pi^2 m^2 + 1).",
        given.CHARACTERISTIC,
        _first_kind,
        (
            at(f"{eq.RHO_M} - rho", 1, epsilon="1/2", m="1", rho="43/20"),
            at(eq.ALPHA_RHO, 1, epsilon="1/2", rho="43/20", m="1"),
            at(_MINUS_ONE, 1, epsilon="1/2", rho="43/20", m="1"),
        ),
    ),
    Derivation(
        "S17",
        "The fixed points are saddles of the second kind, gamma_2 < -1 < gamma_1 < 0, if rho > "
        "rho_m^f = sqrt((4 (1 - epsilon)/(1 - 2 epsilon^2))^2 + (1 - epsilon)^2 (2 pi m)^2)/(1 + "
        "epsilon).",
        (*given.CHARACTERISTIC, *given.THRESHOLDS),
        _second_kind,
        (
            at(f"rho - {eq.RHO_MF}", 1, epsilon="9/10", m="1", rho="1"),
            at(eq.ALPHA_RHO, 1, epsilon="9/10", rho="1", m="1"),
            at(_MINUS_ONE, 1, epsilon="9/10", rho="1", m="1"),
        ),
    ),
    Derivation(
        "S18",
        "At rho_m a pair of fixed points appears in a saddle-node bifurcation, at rho_m^f there "
        "is a flip.",
        (
            *given.CHARACTERISTIC,
            *given.THRESHOLDS,
            *given.STIFF,
            Equal(f"at({eq.AT_ONE}, alpha=2*(1 - epsilon))", "1 - epsilon**2"),
        ),
        _values,
        (at(f"at({eq.AT_MINUS_ONE}, alpha={eq.PRINTED_ALPHA_FLIP})", -1, epsilon="1/2"),),
    ),
    Derivation(
        "S19",
        "The results of [1] on the bouncing ball follow, without its assumption that the ball "
        "bounces high.",
        (*given.CHARACTERISTIC, *given.HIGH_BOUNCE),
        _bouncing_ball,
    ),
    Derivation(
        "S20",
        "The equation of the limit map in the plastic case.",
        (given.PLASTIC_LIMIT,),
        lambda: _verified(
            "the limit of (24), times 2 omega^2/g, at epsilon = 0; the next impact is its first "
            "solution after a launch that does not stick"
        ),
    ),
    Derivation(
        "S21",
        "The plastic limit map has the slope -1 at psi_o for rho = rho_o = sqrt(4 + (2 pi m)^2).",
        given.SLOPES,
        _rho_o,
        (at(eq.RHO_O, m="1"), at(eq.TRUE_RHO_O, m="1")),
    ),
    Derivation(
        "S22",
        "At (psi_o, rho_o), rho_o = sqrt(4 + (2 pi m)^2): f = 0, df/dpsi = -1, d(f^2)/drho = "
        "d^2(f^2)/dpsi^2 = 0, d^2(f^2)/dpsi drho and d^3(f^2)/dpsi^3 are not 0.",
        given.CONDITIONS,
        _six,
        (at(eq.F2_PSI_RHO, m="1"), at(eq.F2_PSI_PSI_PSI, m="1")),
    ),
    Derivation(
        "S23",
        "The plastic limit map f undergoes a period-doubling bifurcation.",
        (
            *given.CHARACTERISTIC,
            *given.CONDITIONS,
            *given.MANIFOLD,
            given.ADMISSIBLE,
            *given.HEIGHT,
            *given.STIFF_PLASTIC,
        ),
        _doubling,
        given.STIFF_VALUES,
    ),
)
