"""Section 6, resonance: R1 to R13, and E1 of section 7. At eta = 1 the map has a closed form."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from proofs.trusted.numbers import Range, between
from proofs.trusted.paper import Decision
from proofs.trusted.paper.formulas import Derivation, Equal, differ
from proofs.trusted.paper.s6_resonance import displayed as eq
from proofs.trusted.paper.s6_resonance.resonance_lemmas import (
    ALPHA_TURNS,
    ALPHA_ZERO,
    AMPLITUDES,
    DIFFERENTIABLE,
    MAP,
    MODEL,
    OFF_THE_MAP,
    PRODUCT,
    TEST,
    VECTORS,
)
from proofs.trusted.paper.s6_resonance.resonance_theorems import (
    CLOSED,
    JACOBIAN,
    NO_DOUBLE,
    SINGLE,
    STABILITY,
    STICKING,
    SUBHARMONICS,
)
from proofs.trusted.verdicts import Verdict


def _verified(why: str, corrected: str | None = None) -> Decision:
    return Decision(Verdict.VERIFIED, why, corrected=corrected)


def _none(verdict: Verdict, why: str, witness: str, corrected: str) -> Callable[[], Decision]:
    """Return a decision that depends on no value."""
    return partial(Decision, verdict, why, witness, corrected)


def _misprint21(difference: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        f"the last term of a21 has the wrong sign: off by {between(difference)} at a point",
        witness="at nu = -1/5, epsilon = 1/2, phi_o = 1, gamma_o = cos(1)/5 - 2 tan(1/4), where "
        "the next impact is at phi_1 = phi_o - 1/2 mod 2 pi, printed a21 minus the derived one is "
        f"{between(difference)}; always it is -2 nu (1 + epsilon) sin(phi_o) cos(phi_1 - phi_o)",
        corrected="a21 = d gamma_1/d phi_o = (1 + nu sin phi_o) cos(phi_1 - phi_o) (a11 - 1) + nu "
        "cos(phi_o) sin(phi_1 - phi_o) + (epsilon gamma_o + nu (1 + epsilon) cos phi_o) sin(phi_1 "
        "- phi_o) (a11 - 1) + nu (1 + epsilon) sin(phi_o) cos(phi_1 - phi_o). " + JACOBIAN,
    )


_REFUTED, _CONDITIONAL = Verdict.REFUTED, Verdict.CONDITIONAL

DERIVATIONS = (
    Derivation(
        "R1",
        "At eta = 1 the relations between impacts are (30) and (31), with alpha_k and "
        "tan(theta_k) as displayed.",
        (*MODEL, *AMPLITUDES),
        _none(
            _CONDITIONAL,
            "true if theta_k is the polar angle of (V_k, 1 + nu sin phi_k); its tangent leaves it "
            "open by pi",
            "condition: alpha_k sin(theta_k) = 1 + nu sin(phi_k) and alpha_k cos(theta_k) = V_k = "
            "epsilon gamma_k + nu (1 + epsilon) cos(phi_k). Without it: nu = -1/5, phi_k = phi_"
            "(k+1) = 0, gamma_k = gamma_(k+1) = 1/5 satisfies (14), (15) for every epsilon; "
            "theta_k = arctan(-5) has the displayed tangent and a positive cosine, alpha_k > 0, "
            "and (31) gives gamma_(k+1) < 0",
            "At eta = 1, with Delta = phi_(k+1) - phi_k and V_k = epsilon gamma_k + nu (1 + "
            "epsilon) cos(phi_k), (14) and (15) are alpha_k sin(theta_k + Delta) = alpha_(k+1) "
            "sin(theta_(k+1)) and gamma_(k+1) = -alpha_k cos(theta_k + Delta), alpha_k >= 0 and "
            "theta_k being polar coordinates: alpha_k cos(theta_k) = V_k, alpha_k sin(theta_k) = "
            "1 + nu sin(phi_k). " + CLOSED,
        ),
    ),
    Derivation(
        "R2",
        "Every phase phi_o gives a single-impact periodic orbit, with gamma_o = -nu cos(phi_o), "
        "and there are no others.",
        MAP,
        _none(
            _CONDITIONAL,
            "true for p > 0 (nu < 0), as a touch without impact; for p < 0 (nu > 0) the mass rests "
            "on the table for ever",
            "condition: nu < 0. Then the gap after the touch is 1 - cos t. For nu > 0 the "
            "relations hold too, but the gap of the flight would be cos t - 1 < 0",
            SINGLE,
        ),
    ),
    Derivation(
        "R3",
        "The Jacobian of F at (phi_o, gamma_o) is the displayed matrix.",
        (*DIFFERENTIABLE, *OFF_THE_MAP),
        _none(
            _REFUTED,
            "its (1,2) entry is 2 epsilon, not -epsilon; its determinant epsilon, not 0",
            "for every nu < 0, epsilon > 0 and phi_o the (1,2) entry, d phi_(k+1)/d gamma_k, is 2 "
            "epsilon, and -epsilon is printed",
            JACOBIAN,
        ),
    ),
    Derivation(
        "R4",
        "The eigenvalues there are 0 and 1 - 2 epsilon nu sin(phi_o), and the orbits are stable "
        "as long as the second lies in (-1, 1).",
        (
            *DIFFERENTIABLE,
            *OFF_THE_MAP,
            Equal(eq.trace(eq.PRINTED_JACOBIAN), eq.PRINTED_EIGENVALUE),
            Equal(eq.determinant(eq.PRINTED_JACOBIAN), "0"),
        ),
        _none(
            _REFUTED,
            "they are 1 and epsilon at every phase; each such orbit is stable, none asymptotically",
            "nu = -1/5, epsilon = 1/100, phi_o = pi/2, gamma_o = 0: the printed eigenvalue is "
            "1.004 > 1, the true ones are 1 and 1/100, and the orbit is stable. The printed ones "
            "are those of the printed matrix",
            STABILITY,
        ),
    ),
    Derivation(
        "R5",
        "In Case 1, sin(theta_(k+2)) = sin(theta_k), theta_(k+1) = theta_k + Delta + n pi.",
        (*MAP, *AMPLITUDES, PRODUCT),
        _none(
            _CONDITIONAL,
            "true if alpha_k and alpha_(k+1) are not 0; the displayed quotients also need sin "
            "Delta not 0",
            "conditions: alpha_k, alpha_(k+1) not 0 (else no angle is defined, Case 1.2.1), theta "
            "polar angles, and 0 <= epsilon < 1 where sin(Delta) = 0, by which is divided",
            "Let (phi_k, gamma_k) and (phi_(k+1), gamma_(k+1)) follow each other under (30), (31) "
            "with period two, alpha_k, alpha_(k+1) not 0, theta the polar angles. Then sin(Delta) "
            "sin(theta_(k+1) - theta_k - Delta) = 0, since sin(a + d) sin(b - d) - sin a sin b = "
            "sin(d) sin(b - a - d). Delta is not pi mod 2 pi, where (30) reads -(1 + nu sin "
            "phi_k) = 1 - nu sin(phi_k). If Delta = 0 mod 2 pi and 0 <= epsilon < 1, the two "
            "states are the same (below), and theta_(k+1) = theta_k. So theta_(k+1) = theta_k + "
            "Delta + n pi. " + NO_DOUBLE,
        ),
    ),
    Derivation(
        "R6",
        "Case 1.1: (phi_o, gamma_o) is two-impact periodic, not of period one, if gamma_o = -nu "
        "cos(phi_o) and 1 - epsilon nu sin(phi_o) = 0; this is equivalent to d alpha_k/d phi_k = "
        "0.",
        (*MAP, ALPHA_TURNS),
        _none(
            _REFUTED,
            "with gamma_o = -nu cos(phi_o) every next impact is at the same phase and velocity",
            "nu = -2, epsilon = 1/2, phi_o = 3 pi/2, gamma_o = 0: both conditions hold, the gap "
            "after the impact is 1 - cos t, and the next touch is at phi_o with gamma_o: period "
            "one. The derivative of alpha_k^2/2 is nu cos(phi_o) (1 - epsilon nu sin phi_o), 0 at "
            "phi_o = pi/2 too",
            NO_DOUBLE,
        ),
    ),
    Derivation(
        "R7",
        "Case 1.2.1: with alpha = 0 the two-impact points are phi_o = arcsin(-1/nu), phi_1 = pi - "
        "phi_o, gamma_i = -(1 + 1/epsilon) cos(phi_i).",
        (*MAP, *AMPLITUDES, *ALPHA_ZERO),
        _none(
            _REFUTED,
            "alpha_k = 0 gives gamma_(k+1) = 0 by (31), not the printed velocity",
            "nu = -5/3, epsilon = 1/2, sin(phi_o) = 3/5, cos(phi_o) = 4/5: by (31) alpha_o = 0 "
            "gives gamma_1 = 0; printed is gamma_1 = 12/5 (-4 with the factor nu without which "
            "alpha_o is not 0 either)",
            "alpha_k = 0 means that the mass is left at rest at x = 0: sin(phi_k) = -1/nu, "
            "gamma_k = -(1 + 1/epsilon) nu cos(phi_k), and then gamma_(k+1) = 0 by (31). So "
            "alpha_k = alpha_(k+1) = 0 takes cos(phi_(k+1)) = 0, |nu| = 1: a state with gamma = "
            "-nu cos(phi) = 0, of period one. " + NO_DOUBLE,
        ),
    ),
    Derivation(
        "R8",
        "Case 1.2.2: the four displayed vectors are two-impact periodic points, with phi_o, phi_1 "
        "the two solutions of sin(phi) = -1/nu.",
        (*MAP, *VECTORS),
        _none(
            _REFUTED,
            "they solve the displayed linear equations, but none of them (30) from phi_o to phi_1",
            "nu = -5/3, sin(phi_o) = 3/5, cos(phi_o) = 4/5, phi_1 = pi - phi_o, any epsilon in "
            "[0, 1): alpha_o sin(theta_o + Delta), which must be alpha_1 sin(theta_1) = 0, is s_1 "
            "gamma_1 sin(2 phi_o), and no printed gamma_1 is 0",
            "With |nu| > 1, sin(phi_o) = -1/nu, phi_1 = pi - phi_o and 0 <= epsilon < 1 the left "
            "side of (14) from (phi_o, gamma_o) to phi_1 is s_1 gamma_1 sin(2 phi_o), not 0, for "
            "each of the four vectors. The states of the first one are two different orbits of "
            "period one. " + NO_DOUBLE,
        ),
    ),
    Derivation(
        "R9",
        "Case 2, sin(theta_(k+2)) = -sin(theta_k): further two-impact orbits, found numerically.",
        MAP,
        _none(
            _REFUTED,
            "there are none: every solution of period two has period one",
            "none exists for any nu and 0 <= epsilon < 1: from impact to impact |gamma + nu cos "
            "phi| is multiplied by epsilon, so it is 0 on a periodic orbit, and the phase constant",
            NO_DOUBLE,
        ),
    ),
    Derivation(
        "R10",
        "The entries a11, a12, a22 of the Jacobian of F, gamma being gamma_o.",
        DIFFERENTIABLE,
        lambda: _verified(
            "implicit differentiation of (14), (15) at eta = 1 gives them; the determinant of the "
            "true matrix is epsilon",
            JACOBIAN,
        ),
    ),
    Derivation(
        "R11",
        "The entry a21.",
        (
            *DIFFERENTIABLE,
            Equal(f"{eq.A21} - {eq.TRUE_A21}", "-2*nu*(1 + epsilon)*sin(phi)*cos(phi1 - phi)"),
        ),
        _misprint21,
        (
            differ(
                f"at({eq.A21}, {eq.ROOT})",
                f"at({eq.TRUE_A21}, {eq.ROOT})",
                nu="-1/5",
                epsilon="1/2",
                phi="1",
                t="-1/4",
            ),
        ),
    ),
    Derivation(
        "R12",
        "The impact at (phi_o, gamma_o) is not sticking if the displayed expression is < 0, read "
        "as a test: exactly then.",
        (*MAP, *TEST),
        _none(
            _REFUTED,
            "no impact sticks for p > 0; for p < 0 exactly those with epsilon (gamma + nu cos phi) "
            "= 0 do, where the expression is 0; it also mixes phi_o with gamma_1",
            "nu = -5/2, epsilon = 1/2, sin(phi_o) = 4/5, cos(phi_o) = 3/5, gamma_o = 5/6, "
            "epsilon (gamma_o + nu cos phi_o) = -1/3: the mass leaves the table and lands at phi_1 "
            "= phi_o - 2 arctan(1/3) mod 2 pi, and the expression is 17/30 > 0",
            STICKING,
        ),
    ),
    Derivation(
        "R13",
        "Figure 8: unstable double-impact periodic orbits exist.",
        MAP,
        _none(
            _REFUTED,
            "none exist, stable or not, for any nu and 0 <= epsilon < 1",
            "every state of period two under (30), (31) has gamma = -nu cos(phi) and period one, "
            "at every nu and every epsilon in [0, 1)",
            NO_DOUBLE,
        ),
    ),
    Derivation(
        "E1",
        "Figure 10: at resonance subharmonics of the table frequency, an eighth one, appear as "
        "the amplitude grows (an experiment).",
        MAP,
        lambda: Decision(
            Verdict.SIMULATED,
            "an observation; the model of section 6 has no steady subharmonics, at any "
            "amplitude: proofs.report.resonance_figure simulates it",
            corrected=SUBHARMONICS,
        ),
    ),
)

CLAIMS = tuple(derivation.claim for derivation in DERIVATIONS)
