"""Section 6, resonance: R1 to R13, and E1 of section 7. At eta = 1 the map has a closed form."""

from __future__ import annotations

from proofs.trusted.kernel.trees import Tree, formula
from proofs.trusted.paper.formulas import Passage, corollary, derived_row, theorem
from proofs.trusted.paper.s6_resonance import displayed as eq
from proofs.trusted.verdicts import Verdict

# -- theorems --------------------------------------------------------------------------------------


@theorem(
    *eq.MODEL,
    *eq.ROOTS,
    tex=r"\phi_{k+1} = \phi_k + 2 \arctan(\varepsilon c_k), \quad c_{k+1} = \varepsilon c_k",
)
def closed_form() -> str:
    """Proof. 1. (14), (15) are the motion of the mass and the rule of restitution: eq.MODEL.
    2. The gap is sign(nu) times (14), which eq.ROOTS factors, t standing for t/2 there.
    3. For nu > 0, K > 0 both factors are positive for 0 < t/2 < arctan K. For nu < 0 the gap is
    2 sqrt(1 + K^2) sin(t/2) sin(t/2 + arctan|K|), positive for 0 < t/2 < pi - arctan|K|. Both zeros
    are simple, and c = sin t - K cos t = K there, by eq.ROOTS.
    4. On the table the mass has the relative acceleration -1 in scaled units: for nu > 0 it is
    pressed on, always.
    """
    return (
        "At eta = 1 the gap at time t after an impact is 2 sign(nu) sin(t/2) (K_k cos(t/2) - "
        "sin(t/2)), in units of |p|, K_k = epsilon c_k, c_k = gamma_k + nu cos(phi_k), phi_k and "
        "gamma_k being phase and velocity before the impact. Let beta > 0, nu not 0, 0 <= epsilon "
        "<= 1; nu c_k >= 0, as the mass comes from outside the table. If K_k is not 0, the next "
        "impact is at phi_(k+1) = phi_k + 2 arctan(K_k) mod 2 pi, after the time 2 arctan(K_k) for "
        "nu > 0 and 2 pi + 2 arctan(K_k) for nu < 0, and c_(k+1) = epsilon c_k. If K_k = 0: for nu "
        "< 0 the mass touches the table again after 2 pi, at the same phase, with c_(k+1) = 0; for "
        "nu > 0 it rests on the table for ever. For nu < 0 no impact sticks, even a plastic one."
    )


iterates = corollary(
    "At eta = 1, for 0 <= epsilon < 1 and c = gamma + nu cos(phi), c_n = epsilon^n c_0, and the "
    "phases converge: phi_n = phi_0 + 2 arctan(epsilon c_0) + ... + 2 arctan(epsilon^n c_0) mod 2 "
    "pi, |phi_n - phi_limit| <= 2 epsilon^(n+1) |c_0|/(1 - epsilon) on the line. For nu < 0 every "
    "motion with an impact tends to a grazing orbit gamma = -nu cos(phi); for nu > 0 every motion "
    "comes to rest in finite time, after infinitely many impacts if epsilon c_0 is not 0.",
    closed_form,
)


@theorem(closed_form, *eq.ENTRIES, eq.AT_REST)
def jacobian(**f: Tree) -> str:
    """Proof. 1. Implicit differentiation of (14), (15): eq.ENTRIES. 2. By `closed_form` F is, in
    phi and c, (phi + 2 arctan(epsilon c), epsilon c), with the determinant epsilon, and the change
    from gamma to c has determinant 1. 3. At K = 0, as arctan K = K + O(K^3): eq.AT_REST.
    """
    return (
        "At eta = 1 the displayed a11, a12, a22, and a21 with +nu (1 + epsilon) sin(phi_o) "
        "cos(phi_1 - phi_o) as its last term, are DF where phi_1 = phi_o + 2 arctan K, K = epsilon "
        "(gamma_o + nu cos phi_o) not 0. F(phi, gamma) = (phi + 2 arctan K, K - nu cos(phi + 2 "
        "arctan K)) is analytic, also up to the states with K = 0 for nu < 0, which graze; det DF "
        f"= epsilon. At gamma = -nu cos(phi) DF has the rows ({f['f11']}, {f['f12']}) and "
        f"({f['f21']}, {f['f22']}), and the eigenvalues 1 and epsilon."
    )


stability = corollary(
    "At eta = 1, for nu < 0 and 0 <= epsilon < 1, the grazing orbit gamma = -nu cos(phi_o) of each "
    "phase phi_o is stable, none asymptotically. With c = gamma + nu cos(phi), phi_n stays within "
    "|phi_0 - phi_o| + 2 epsilon |c_0|/(1 - epsilon), |c_n| <= |c_0|; all phases next to it have "
    "such orbits, and their family attracts every motion with an impact, with the factor epsilon "
    "from impact to impact.",
    iterates,
)
no_double = corollary(
    "At eta = 1, for 0 <= epsilon < 1 and any nu, all periodic solutions of (14), (15), that is of "
    "(30), (31) with polar angles, first impacts or not, have period one and gamma = -nu cos(phi): "
    "there are no two-impact orbits. The zeros of (14) are phi_(k+1) = phi_k, with c_(k+1) = "
    "-epsilon c_k, and phi_(k+1) = phi_k + 2 arctan(epsilon c_k) mod 2 pi, with c_(k+1) = epsilon "
    "c_k, c_k = gamma_k + nu cos(phi_k): so c_k = 0 on a periodic solution, and the phase is "
    "constant. For epsilon = 1 the map is (phi, c) -> (phi + 2 arctan c, c): period n > 1 exactly "
    "if arctan|c| = pi j/n, j and n coprime, 1 <= j < n/2, so n >= 3: none of period two either.",
    closed_form,
)
rebound = corollary(
    "At eta = 1 an impact that sticks has K_o = epsilon (gamma_o + nu cos phi_o) = 0, phi_1 = "
    "phi_o, and the displayed expression is 0, not < 0. In general it is K_o - nu (cos phi_1 - "
    "cos phi_o); for |nu| <= 1/2 it has the sign of K_o, as |cos phi_1 - cos phi_o| <= 2 "
    "|sin(arctan K_o)| = 2 |K_o|/sqrt(1 + K_o^2). The converse is false: at nu = -5/2, epsilon = "
    "1/2, sin(phi_o) = 4/5, cos(phi_o) = 3/5, gamma_o = 5/6, K_o = -1/3, the mass leaves the table "
    "and lands at phi_1 = phi_o - 2 arctan(1/3) mod 2 pi, and the expression is 17/30 > 0. With "
    "cos(phi_1) for its last cos(phi_o) it is K_o, and epsilon K_o is in scaled units the relative "
    "velocity of the launch at phi_1: that impact rebounds exactly if nu epsilon K_o > 0.",
    closed_form,
    *eq.TEST,
)
no_subharmonic = corollary(
    "At eta = 1, for 0 <= epsilon < 1, the model has no steady subharmonic, at any amplitude nu: "
    "for nu < 0 every motion with an impact tends to one of a family of motions, one for each "
    "phase phi_o of its touches, which are sines of the frequency of the table, (1 + nu sin phi_o) "
    "cos t + nu cos phi_o sin t at the time t after a touch, in units of -p, and one without is a "
    "sine of this frequency, too; for nu > 0 every motion comes to rest on the table. For epsilon "
    "= 1 all flights of a motion with c = gamma + nu cos(phi) not 0, which is constant, last T = 2 "
    "pi - 2 arctan|c| for nu < 0, T = 2 arctan|c| for nu > 0, so the displacement, table plus gap, "
    "has only the frequency of the table and multiples of 2 pi/T times it, larger ones. It repeats "
    "after n impacts in n - j periods of the table if nu < 0 and |c| = tan(pi j/n), j and n "
    "coprime, 1 <= j < n/2 (nine in eight for tan(pi/9)); such motions attract nothing.",
    iterates,
)

# -- the rows --------------------------------------------------------------------------------------

ROWS = (
    derived_row(
        Passage("R1", "6, (30)-(31)", "These equations can be rewritten as"),
        "At eta = 1 the relations between impacts are (30) and (31), with alpha_k and "
        "tan(theta_k) as displayed.",
        Verdict.CONDITIONAL,
        corollary(
            "At eta = 1 (14), (15) are (30), (31) if alpha_k >= 0 and theta_k are the polar "
            "coordinates of (V_k, 1 + nu sin phi_k), V_k = epsilon gamma_k + nu (1 + epsilon) cos "
            "phi_k; the tangent leaves theta_k open by pi. nu = -1/5, phi_k = phi_(k+1) = 0, "
            "gamma_k = gamma_(k+1) = 1/5 satisfies (14), (15) for every epsilon; theta_k = "
            "arctan(-5) has the displayed tangent and a positive cosine, alpha_k > 0, and (31) "
            "gives gamma_(k+1) < 0.",
            *eq.MODEL,
            *eq.AMPLITUDES,
        ),
        corrected=(closed_form,),
    ),
    derived_row(
        Passage("R2", "6.1", "can lead to a periodic orbit"),
        "Every phase phi_o gives a single-impact periodic orbit, with gamma_o = -nu cos(phi_o), "
        "and there are no others.",
        Verdict.CONDITIONAL,
        corollary(
            "At eta = 1, true for p > 0 (nu < 0), as a touch without relative velocity, once a "
            "period of the table: a grazing orbit; for p < 0 (nu > 0) the gap of the flight would "
            "be cos t - 1 < 0, and the mass rests on the table for ever. For 0 <= epsilon <= 1 the "
            "solutions of (14), (15) with phi_(k+1) = phi_k, gamma_(k+1) = gamma_k are exactly the "
            "states with c = gamma + nu cos(phi) = 0, as c_(k+1) = -epsilon c_k after 2 pi n.",
            closed_form,
        ),
        corrected=(closed_form,),
    ),
    derived_row(
        Passage("R3", "6.1", "the Jacobian of this map at these values"),
        "The Jacobian of F at (phi_o, gamma_o) is the displayed matrix.",
        Verdict.REFUTED,
        corollary(
            "At eta = 1, for nu < 0 and every phi_o, its (1,2) entry d phi_(k+1)/d gamma_k is 2 "
            "epsilon, not -epsilon, and its determinant epsilon, not 0. With gamma_o and a phi1 "
            "that is not the next phase a11, a12, a21 (corrected), a22 are {o11}, {o12}, {o21}, "
            "{o22}, phi = phi_o: their limit as phi1 -> phi_o, with the signs of a12 and a22 "
            "changed, is the printed matrix.",
            jacobian,
            eq.OFF_THE_MAP,
        ),
        corrected=(jacobian,),
    ),
    derived_row(
        Passage("R4", "6.1", "the periodic orbits are stable as long as"),
        "The eigenvalues there are 0 and 1 - 2 epsilon nu sin(phi_o), and the orbits are stable "
        "as long as the second lies in (-1, 1).",
        Verdict.REFUTED,
        corollary(
            "At eta = 1, nu = -1/5, epsilon = 1/100, phi_o = pi/2, gamma_o = 0 the printed "
            "eigenvalue is 1.004 > 1, the true ones are 1 and 1/100, and the orbit is stable "
            "(motions that begin near it stay near it): it is stable without the condition. At "
            "phi_o = 3 pi/2 it is 0.996 < 1, the true ones are the same, and the orbit is not "
            "asymptotically stable, as all phases next to it have such orbits: if that is meant, "
            "the condition does not suffice, there or anywhere. The printed eigenvalues are those "
            "of the printed matrix.",
            jacobian,
            stability,
            *eq.PRINTED,
        ),
        corrected=(jacobian, stability),
    ),
    derived_row(
        Passage("R5", "6.2, Case 1", "to find the double impact periodic points"),
        "In Case 1, sin(theta_(k+2)) = sin(theta_k), theta_(k+1) = theta_k + Delta + n pi.",
        Verdict.CONDITIONAL,
        corollary(
            "At eta = 1, for 0 <= epsilon < 1, true if alpha_k and alpha_(k+1) are not 0 (else no "
            "angle is defined, Case 1.2.1) and theta are the polar angles. For states of period "
            "two (30) gives sin(Delta) sin(theta_(k+1) - theta_k - Delta) = 0. Delta is not pi mod "
            "2 pi, where (30) reads -(1 + nu sin phi_k) = 1 - nu sin(phi_k); where sin(Delta), "
            "which is divided by, is 0, the two states are the same.",
            no_double,
            *eq.AMPLITUDES,
            eq.PRODUCT,
        ),
        corrected=(no_double,),
    ),
    derived_row(
        Passage("R6", "6.2, Case 1.1", "are two impact periodic if"),
        "Case 1.1: (phi_o, gamma_o) is two-impact periodic, every second impact being there, if "
        "gamma_o = -nu cos(phi_o) and d alpha_k/d phi_k = 0; the latter is equivalent to 1 - "
        "epsilon nu sin(phi_o) = 0.",
        Verdict.CONDITIONAL,
        corollary(
            "At eta = 1, beta > 0, true for p > 0 (nu < 0), a touch without relative velocity "
            "being an impact, and equivalent where cos(phi_o) is not 0. But every impact of such "
            "an orbit is at (phi_o, gamma_o), period one, whatever d alpha_k/d phi_k is: at nu = "
            "-2, epsilon = 1/2, phi_o = 3 pi/2, gamma_o = 0, where both conditions hold, the gap "
            "is 1 - cos t. The derivative of alpha_k^2/2 is nu cos(phi_o) (1 - epsilon nu sin "
            "phi_o), 0 where cos(phi_o) = 0, too. For p < 0 (nu > 0) the mass rests on the table "
            "for ever after such an impact.",
            closed_form,
            eq.ALPHA_TURNS,
        ),
        corrected=(no_double,),
    ),
    derived_row(
        Passage("R7", "6.2, Case 1.2.1", "the double impact periodic points are given by"),
        "Case 1.2.1: with alpha = 0 the two-impact points are phi_o = arcsin(-1/nu), phi_1 = pi - "
        "phi_o, gamma_i = -(1 + 1/epsilon) cos(phi_i).",
        Verdict.REFUTED,
        corollary(
            "At eta = 1, nu = -5/3, epsilon = 1/2, sin(phi_o) = 3/5, cos(phi_o) = 4/5, alpha_o = 0 "
            "gives gamma_1 = 0 by (31); printed is gamma_1 = 12/5 (-4 with the factor nu without "
            "which alpha_o is not 0 either). alpha_k = 0 means that the mass is left at rest at x "
            "= 0: sin(phi_k) = -1/nu, gamma_k = -(1 + 1/epsilon) nu cos(phi_k). So alpha_k = "
            "alpha_(k+1) = 0 takes gamma_(k+1) = cos(phi_(k+1)) = 0, |nu| = 1: period one.",
            closed_form,
            *eq.AMPLITUDES,
            *eq.ALPHA_ZERO,
        ),
        corrected=(no_double,),
    ),
    derived_row(
        Passage("R8", "6.2, Case 1.2.2", "On solving these, we obtain"),
        "Case 1.2.2: the four displayed vectors are two-impact periodic points, with phi_o, phi_1 "
        "the two solutions of sin(phi) = -1/nu.",
        Verdict.REFUTED,
        corollary(
            "At eta = 1, |nu| > 1 (say sin(phi_o) = 3/5, nu = -5/3), 0 <= epsilon < 1, they solve "
            "the displayed linear equations, but alpha_o sin(theta_o + Delta), which must be "
            "alpha_1 sin(theta_1) = 0, is s_1 gamma_1 sin(2 phi_o), not 0. For nu < 0 the "
            "states of the first one are two different orbits of period one, for nu > 0 the mass "
            "rests on the table.",
            closed_form,
            *eq.SOLUTIONS,
        ),
        corrected=(no_double,),
    ),
    derived_row(
        Passage("R9", "6.2, Case 2", "solving the corresponding equations numerically"),
        "Case 2, sin(theta_(k+2)) = -sin(theta_k): further two-impact orbits, found numerically.",
        Verdict.REFUTED,
        no_double,
        corrected=(iterates,),
    ),
    derived_row(
        Passage("R10", "6.2, a11, a12, a22", "studying the eigenvalues of the Jacobian"),
        "The entries a11, a12, a22 of the Jacobian of F, gamma being gamma_o.",
        Verdict.VERIFIED,
        jacobian,
        corollary(
            "At eta = 1 DF has four such entries, a21 corrected. At an impact at phi = phi_o, "
            "gamma = gamma_o, the next one being at phi1: "
            + "; ".join(
                f"a{n} = {formula(text)}"
                for n, text in zip((11, 12, 21, 22), eq.JACOBIAN, strict=True)
            )
            + ".",
            jacobian,
        ),
    ),
    derived_row(
        Passage("R11", "6.2, a21", "studying the eigenvalues of the Jacobian"),
        "The entry a21.",
        Verdict.REFUTED,
        corollary(
            "At eta = 1 the last term of a21 has the wrong sign: off by {0} at nu = -1/5, epsilon "
            "= 1/2, phi_o = 1, gamma_o = cos(1)/5 - 2 tan(1/4), where the next impact is at phi_1 "
            "= phi_o - 1/2 mod 2 pi. Printed minus derived it is -2 nu (1 + epsilon) sin(phi_o) "
            "cos(phi_1 - phi_o).",
            jacobian,
            eq.SIGN_OF_A21,
            values=(eq.A21_DIFFERS,),
        ),
        corrected=(jacobian,),
    ),
    derived_row(
        Passage("R12", "6.2, end", "is not 'sticking' if"),
        "The impact at (phi_o, gamma_o) is not sticking if the displayed expression is < 0.",
        Verdict.VERIFIED,
        rebound,
        corrected=(closed_form, rebound),
    ),
    derived_row(
        Passage("R13", "6.2, Figure 8", "are the unstable double impact periodic orbits"),
        "Figure 8: unstable double-impact periodic orbits exist.",
        Verdict.REFUTED,
        no_double,
        corrected=(iterates,),
    ),
    derived_row(
        Passage("E1", "7, Fig. 10", "eighth subharmonic appearing as the amplitude is increased"),
        "Figure 10: at resonance subharmonics of the table frequency, an eighth one, appear as "
        "the amplitude grows (an experiment; python -m proofs resonance --figure draws motions of "
        "the model beside it).",
        Verdict.SIMULATED,
        no_subharmonic,
        corrected=(iterates, no_subharmonic),
    ),
)
