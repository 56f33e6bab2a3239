"""Section 5, soft springs: S11 to S23, the limit map, its stability and its bifurcations."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal
from proofs.trusted.paper.formulas import Passage, at, corollary, derived_row, differ
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import near
from proofs.trusted.paper.s5_soft import theorems as given
from proofs.trusted.paper.s5_soft.doubling import doubling
from proofs.trusted.paper.s5_soft.orbits import admissible, sticking
from proofs.trusted.verdicts import Verdict

_MINUS_ONE = f"at({eq.AT_MINUS_ONE}, alpha={eq.ALPHA_RHO})"

ROWS = (
    derived_row(
        Passage("S11", "5, J", "This matrix was evaluated at"),
        "The Jacobian of the limit map at (psi_o, lambda_o), psi_o := arccos((1 - epsilon)/(1 + "
        "epsilon)) 2 pi m/rho, lambda_o := -2 pi m, its four entries.",
        Verdict.CONDITIONAL,
        corollary(
            "True if X = ((1 - epsilon)/(1 + epsilon)) 2 pi m/rho < 1 and psi_o is arccos X, the "
            "inverse cosine of the whole product, as the last expression of S8 is read. Printed is "
            "that of its first factor, times the others, where no fixed point is: at m = 1, "
            "epsilon = 1/3, rho = 4 cos psi_o - X is in {0} then. For arccos X all four entries "
            "hold, by implicit differentiation of the limits of (24), (25), for the branch sin "
            "psi_o >= 0 of the inverse cosine; on the other alpha has the other sign. With a = rho "
            "sin psi_o and c = 2 pi m, rho cos psi_o = {b}, lambda_o = {lam}, the rows are ({j11}, "
            "{j12}) and ({j21}, {j22}); alpha = (1 + epsilon) a.",
            *given.JACOBIAN,
            values=(
                # arccos((1 - epsilon)/(1 + epsilon)) = arccos(1/2) = pi/3
                at(f"cos(pi/3*2*pi*m/rho) - {eq.COSINE_RHO}", -1, epsilon="1/3", m="1", rho="4"),
            ),
        ),
    ),
    derived_row(
        Passage("S12", "5, eigenvalues", "The eigenvalues of this matrix are given by"),
        "The eigenvalues gamma_1, gamma_2 of this matrix are as displayed, with product epsilon^2.",
        Verdict.VERIFIED,
        corollary(
            "Their sum is the trace, their product epsilon^2, the determinant.",
            given.DETERMINANT,
            Equal.read(" + ".join(eq.EIGENVALUES), eq.TRACE),
            Equal.read("*".join(f"({one})" for one in eq.EIGENVALUES), "epsilon**2"),
            *given.TRACE,
        ),
    ),
    derived_row(
        Passage("S13", "5, discriminant", "Also we note that"),
        "The displayed identity for the discriminant.",
        Verdict.REFUTED,
        corollary(
            "The right side minus the left one is 2 (1 + epsilon) alpha, {0} at epsilon = 1/2, "
            "alpha = 1.",
            Equal.read(f"({eq.PRINTED_SUM}) - ({eq.DISCRIMINANT})", "2*(1 + epsilon)*alpha"),
            values=(differ(eq.PRINTED_SUM, eq.DISCRIMINANT, epsilon="1/2", alpha="1"),),
        ),
        corrected=(
            corollary(
                "For all epsilon and alpha (1 - epsilon^2 - (1 + epsilon) alpha/2)^2 - 2 epsilon^2 "
                "(1 + epsilon) alpha = (1 - epsilon^2)^2 + ((1 + epsilon) alpha/2)^2 - (1 + "
                "epsilon) (1 + epsilon^2) alpha = ((1 + epsilon) alpha/2 - (1 - epsilon)^2) ((1 + "
                "epsilon) alpha/2 - (1 + epsilon)^2), which is negative for (1 - epsilon)^2 < (1 + "
                "epsilon) alpha/2 < (1 + epsilon)^2.",
                Equal.read(eq.DISCRIMINANT, eq.TRUE_SUM),
                given.ROOTS,
                tex=r"(\tfrac{1 + \varepsilon}{2} \alpha - (1 - \varepsilon)^2)"
                r"(\tfrac{1 + \varepsilon}{2} \alpha - (1 + \varepsilon)^2)",
            ),
        ),
    ),
    derived_row(
        Passage("S14", "5, discriminant", "and therefore the eigenvalues are real"),
        "The eigenvalues of this matrix are real.",
        Verdict.REFUTED,
        corollary(
            "At m = 1, epsilon = 1/2, rho = 11/5 they are not real: their discriminant is in {0}.",
            values=(
                at(
                    f"at({eq.DISCRIMINANT}, alpha={eq.ALPHA_RHO})",
                    -1,
                    epsilon="1/2",
                    rho="11/5",
                    m="1",
                ),
            ),
        ),
        corrected=(
            corollary(
                "Let m >= 1, 0 <= epsilon < 1, c = 2 pi m, rho >= ((1 - epsilon)/(1 + epsilon)) c, "
                "alpha = sqrt((1 + epsilon)^2 rho^2 - (1 - epsilon)^2 c^2). The eigenvalues at "
                "psi_o are real exactly if (1 + epsilon) alpha/2 is at most (1 - epsilon)^2 or at "
                "least (1 + epsilon)^2, that is if (1 + epsilon)^2 rho^2 is at most (1 - "
                "epsilon)^2 c^2 + 4 (1 - epsilon)^4/(1 + epsilon)^2 or at least (1 - epsilon)^2 "
                "c^2 + 4 (1 + epsilon)^2; in between, for epsilon > 0, they are complex with the "
                "modulus epsilon, so the fixed point is a sink (a focus).",
                *given.JACOBIAN,
                given.DETERMINANT,
                given.ROOTS,
            ),
        ),
    ),
    derived_row(
        Passage("S15", "5", "the fixed points are either sinks or saddles"),
        "For 0 < epsilon < 1 the fixed points are sinks or saddles.",
        Verdict.REFUTED,  # said of all 0 < epsilon < 1 and all rho, it fails at some of these
        corollary(
            "For each m and 0 < epsilon < 1 it fails at two values of rho: where alpha is 0 or 4 "
            "(1 + epsilon^2)/(1 + epsilon), that is at rho_SN and rho_F, an eigenvalue is 1 or -1, "
            "and the fixed point is neither. At all other rho >= rho_SN it is true.",
            *given.CHARACTERISTIC,
        ),
        corrected=(given.diagram,),
    ),
    derived_row(
        Passage("S16", "5, rho_m", "We show that the fixed points are saddles of the first"),
        "The fixed points are saddles of the first kind, 0 < gamma_2 < 1 < gamma_1, if rho < rho_m "
        "= 2 ((1 - epsilon)/(1 + epsilon)) sqrt(pi^2 m^2 + 1).",
        Verdict.REFUTED,
        corollary(
            "At m = 1, epsilon = 1/2, rho = 43/20 < rho_m there is a sink, an orbit. rho_m - rho "
            "is in {0}, alpha in {1}, and the characteristic polynomial, with the product 1/4 of "
            "its roots, is positive at 1 and in {2} at -1, so both are inside the unit circle; as "
            "epsilon > epsilon_1, the mass stays above the table until its impact.",
            *given.CHARACTERISTIC,
            admissible,
            values=(
                at(f"{eq.RHO_M} - rho", 1, epsilon="1/2", m="1", rho="43/20"),
                at(eq.ALPHA_RHO, 1, epsilon="1/2", rho="43/20", m="1"),
                at(_MINUS_ONE, 1, epsilon="1/2", rho="43/20", m="1"),
            ),
        ),
        corrected=(given.first_kind,),
    ),
    derived_row(
        Passage("S17", "5, rho_m^f", "saddles of the second kind"),
        "The fixed points are saddles of the second kind, gamma_2 < -1 < gamma_1 < 0, if rho > "
        "rho_m^f = sqrt((4 (1 - epsilon)/(1 - 2 epsilon^2))^2 + (1 - epsilon)^2 (2 pi m)^2)/(1 + "
        "epsilon).",
        Verdict.REFUTED,
        corollary(
            "At m = 1, epsilon = 9/10, rho = 1 > rho_m^f there is a sink, an orbit. rho - rho_m^f "
            "is in {0}, alpha in {1}, and the characteristic polynomial, with the product 81/100 "
            "of its roots, is positive at 1 and in {2} at -1; as epsilon > epsilon_1, the mass "
            "stays above the table until its impact.",
            *given.CHARACTERISTIC,
            admissible,
            values=(
                at(f"rho - {eq.RHO_MF}", 1, epsilon="9/10", m="1", rho="1"),
                at(eq.ALPHA_RHO, 1, epsilon="9/10", rho="1", m="1"),
                at(_MINUS_ONE, 1, epsilon="9/10", rho="1", m="1"),
            ),
        ),
        corrected=(given.second_kind,),
    ),
    derived_row(
        Passage("S18", "5, rho_m, rho_m^f", "a pair of fixed points appear in a saddle-node"),
        "At rho_m a pair of fixed points appears in a saddle-node bifurcation, at rho_m^f there "
        "is a flip.",
        Verdict.REFUTED,
        corollary(
            "At rho_m, where alpha = 2 (1 - epsilon), the characteristic polynomial is 1 - "
            "epsilon^2 at 1, no saddle-node; at rho_m^f, epsilon = 1/2, any m, it is {0} at -1, no "
            "flip. Two fixed points are there already for rho < rho_m.",
            *given.CHARACTERISTIC,
            *given.THRESHOLDS,
            Equal.read(f"at({eq.AT_ONE}, alpha=2*(1 - epsilon))", "1 - epsilon**2"),
            values=(
                at(f"at({eq.AT_MINUS_ONE}, alpha={eq.PRINTED_ALPHA_FLIP})", -1, epsilon="1/2"),
            ),
        ),
        corrected=(given.bifurcations, admissible, sticking, given.stiff),
    ),
    derived_row(
        Passage("S19", "5, and 1", "Our analysis reproduces all the results in"),
        "The analysis of section 5 reproduces all the results of [1] on the bouncing ball, its "
        "stability and bifurcations among them, without its assumption that the ball bounces "
        "high.",
        Verdict.REFUTED,
        corollary(
            "The map of [1], (phi, w) to (phi + w, epsilon w - gamma cos(phi + w)), gamma = (1 + "
            "epsilon) rho, has determinant epsilon everywhere, not epsilon^2, and an earlier flip. "
            "At w = 2 pi m it has the trace 1 + epsilon + gamma sin phi: it flips at |gamma sin "
            "phi| = 2 (1 + epsilon); the limit map has determinant epsilon^2 and flips at alpha = "
            "(1 + epsilon) rho sin psi = 4 (1 + epsilon^2)/(1 + epsilon), larger by 2 (1 - "
            "epsilon)^2/(1 + epsilon).",
            *given.CHARACTERISTIC,
            *given.HIGH_BOUNCE,
        ),
        corrected=(
            corollary(
                "For m >= 1, 0 <= epsilon < 1 and solutions of the limits of (24), (25), without "
                "the high-bounce assumption, the fixed points of [1] and their saddle-node value "
                "(1 + epsilon) rho = (1 - epsilon) 2 pi m are the same. The stability is not: the "
                "flip is at (1 + epsilon) rho = sqrt((4 (1 + epsilon^2)/(1 + epsilon))^2 + (1 - "
                "epsilon)^2 (2 pi m)^2), that of the map of [1] at sqrt((2 (1 + epsilon))^2 + (1 - "
                "epsilon)^2 (2 pi m)^2), which is smaller for every epsilon in [0, 1).",
                *given.CHARACTERISTIC,
                *given.HIGH_BOUNCE,
            ),
        ),
    ),
    derived_row(
        Passage("S20", "5, plastic", "The equation describing this system"),
        "The equation of the limit map in the plastic case.",
        Verdict.VERIFIED,
        corollary(
            "The limit of (24), times 2 omega^2/g, at epsilon = 0; the next impact is its first "
            "solution after a launch that does not stick.",
            given.PLASTIC_LIMIT,
        ),
    ),
    derived_row(
        Passage("S21", "5, rho_o", "where $\\rho_o := \\sqrt{(4 + (2\\pi m)^2)}$"),
        "The plastic limit map has the slope -1 at psi_o for rho = rho_o = sqrt(4 + (2 pi m)^2).",
        Verdict.REFUTED,
        corollary(
            "The slope 1 - alpha/2 of f is 0, not -1, at the printed rho_o, {0} for m = 1, for "
            "every m, as alpha = sqrt(rho_o^2 - (2 pi m)^2) = 2; it is -1 at sqrt(16 + (2 pi "
            "m)^2), {1} for m = 1.",
            *given.SLOPES,
            values=(at(eq.RHO_O, m="1"), at(eq.TRUE_RHO_O, m="1")),
            reports=("rho_o_printed", "rho_flip"),
        ),
        corrected=(
            corollary(
                "In the plastic case, m >= 1, the slope at psi_o = arccos(2 pi m/rho), rho >= 2 pi "
                "m, is 1 - sqrt(rho^2 - (2 pi m)^2)/2: -1 exactly at rho_o = sqrt(16 + (2 pi "
                "m)^2), which the paper's rho_m^f gives too. At sqrt(4 + (2 pi m)^2), where the "
                "slope is 0, this fixed point begins to be an orbit: for smaller rho the mass "
                "sticks there, as rho sin psi_o = sqrt(rho^2 - (2 pi m)^2) < 2.",
                *given.SLOPES,
                admissible,
                tex=r"\rho_o = \sqrt{16 + (2 \pi m)^2}",
            ),
        ),
    ),
    derived_row(
        Passage("S22", "5, six conditions", "By taking successive derivatives of this map"),
        "At (psi_o, rho_o), rho_o = sqrt(4 + (2 pi m)^2): f = 0, df/dpsi = -1, d(f^2)/drho = "
        "d^2(f^2)/dpsi^2 = 0, d^2(f^2)/dpsi drho and d^3(f^2)/dpsi^3 are not 0.",
        Verdict.REFUTED,
        corollary(
            "At rho_o = sqrt(4 + (2 pi m)^2), for every m, the solution near psi_o of the equation "
            "of S20 has df/dpsi = 0, d(f^2)/drho = pi m/rho_o, d^2(f^2)/dpsi drho = 0 and "
            "d^3(f^2)/dpsi^3 = 0, and f = psi_o = arccos(2 pi m/rho_o) is not 0, nor is it at "
            "sqrt(16 + (2 pi m)^2): five of the six fail, all but d^2(f^2)/dpsi^2 = 0.",
            *given.PRINTED_CONDITIONS,
        ),
        corrected=(
            corollary(
                "For every m >= 1, at rho_o = sqrt(16 + (2 pi m)^2), the flip, and psi_o = "
                "arccos(2 pi m/rho_o): f = psi_o, df/dpsi = -1, d(f^2)/drho = 0, d^2(f^2)/dpsi^2 = "
                "0, d^2(f^2)/dpsi drho = rho_o/4 > 0, d^3(f^2)/dpsi^3 = -(3 pi^2 m^2 + 2) < 0.",
                *given.CONDITIONS,
                values=(at(near.F2_PSI_RHO, m="1"), at(near.F2_PSI_PSI_PSI, m="1")),
                reports=("f2_psi_rho", "f2_psi_psi_psi"),
            ),
        ),
    ),
    derived_row(
        Passage("S23", "5", "undergoes a period doubling bifurcation"),
        "The plastic limit map f undergoes a period-doubling bifurcation.",
        Verdict.VERIFIED,
        given.flip,
        doubling,
        corrected=(given.flip, doubling),
    ),
)
