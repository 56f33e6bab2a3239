"""Section 6, resonance: the theorems, each with its proof from proved lemmas."""

_NOTATION = (
    "Let eta = 1, nu not 0, 0 <= epsilon <= 1; (phi_k, gamma_k) are phase and velocity before "
    "the impacts, c_k = gamma_k + nu cos(phi_k), K_k = epsilon c_k; a mass that comes from "
    "outside the table has nu c_k >= 0. "
)
CLOSED = (
    _NOTATION
    + "At time t after an impact mass minus table is 2 sin(t/2) (K_k cos(t/2) - sin(t/2)). If "
    "K_k is not 0, the next impact is phi_(k+1) = phi_k + 2 arctan(K_k) mod 2 pi, after the "
    "time 2 arctan(K_k) for nu > 0 and 2 pi + 2 arctan(K_k) for nu < 0; gamma_(k+1) = K_k - nu "
    "cos(phi_(k+1)), that is c_(k+1) = epsilon c_k. If K_k = 0: for nu < 0 the gap is 1 - cos "
    "t and the mass touches the table again after 2 pi, at the same phase, with c_(k+1) = 0; "
    "for nu > 0 it rests on the table for ever. Proof. For nu > 0, K > 0 both factors are "
    "positive for 0 < t/2 < arctan K. For nu < 0 the gap is 2 sqrt(1 + K^2) sin(t/2) sin(t/2 + "
    "arctan|K|), positive for 0 < t/2 < pi - arctan|K|. Both zeros are simple. Then c = sin t "
    "- K cos t = K there. On the table the mass has the relative acceleration -1 in scaled "
    "units: for nu > 0 it is pressed on, always."
)
SINGLE = (
    CLOSED
    + " So for 0 <= epsilon <= 1 the solutions of (14), (15) with phi_(k+1) = phi_k, gamma_(k+1) "
    "= gamma_k are exactly the states with gamma = -nu cos(phi) (c = 0), one at each phase, "
    "whatever epsilon is. For nu < 0 each is a motion that touches the table once a period of "
    "the table, with no relative velocity: a grazing orbit. For nu > 0 none is an orbit: the "
    "mass rests on the table for ever."
)
_ITERATES = (
    "For 0 <= epsilon < 1: c_n = epsilon^n c_0, and phi_n = phi_0 + 2 arctan(epsilon c_0) + "
    "... + 2 arctan(epsilon^n c_0) mod 2 pi converges, with |phi_n - phi_limit| <= 2 "
    "epsilon^(n+1) |c_0|/(1 - epsilon) on the line. For nu < 0 every motion tends to a grazing "
    "orbit gamma = -nu cos(phi); for nu > 0 every motion comes to rest in finite time, after "
    "infinitely many impacts if epsilon c_0 is not 0, and stays on the table."
)
JACOBIAN = (
    _NOTATION
    + "F(phi, gamma) = (phi + 2 arctan K, K - nu cos(phi + 2 arctan K)), K = epsilon (gamma + nu "
    "cos phi), is analytic, also up to the states with K = 0 for nu < 0, which graze. In the "
    "coordinates phi, c it is (phi, c) -> (phi + 2 arctan(epsilon c), epsilon c). Its "
    "determinant is epsilon everywhere. At gamma = -nu cos(phi), s = nu sin(phi), DF has the "
    "rows (1 - 2 epsilon s, 2 epsilon) and (s (1 - epsilon - 2 epsilon s), epsilon (1 + 2 s)), "
    "with the eigenvalues 1 and epsilon. The formulas a11, a12, a21 (corrected), a22 are DF at "
    "phi_1 = phi + 2 arctan K, K not 0; set gamma = -nu cos(phi) in them with another phi_1 "
    "and they are not: they are 1 - epsilon s, epsilon, (1 - epsilon s) nu sin(phi_1), epsilon "
    "nu sin(phi_1), with the eigenvalues 0 and 1 as phi_1 -> phi. That limit, with the signs "
    "of a12 and a22 changed, is the printed matrix."
)
STABILITY = (
    CLOSED
    + " At each state with gamma = -nu cos(phi) DF has the eigenvalues 1 and epsilon. "
    + _ITERATES
    + " So for nu < 0 and 0 <= epsilon < 1 the grazing orbit of each phase phi_o is stable: "
    "phi_n stays within |phi_0 - phi_o| + 2 epsilon |c_0|/(1 - epsilon), |c_n| <= |c_0|. None "
    "is asymptotically stable, since all phases next to it have such orbits; their family "
    "attracts every motion, with the factor epsilon from impact to impact."
)
NO_DOUBLE = (
    _NOTATION
    + "Relations (14), (15), that is (30), (31) with polar angles, allow two zeros, first impact "
    "or not: phi_(k+1) = phi_k with c_(k+1) = -epsilon c_k, or phi_(k+1) = phi_k + 2 "
    "arctan(epsilon c_k) mod 2 pi with c_(k+1) = epsilon c_k. So c_n = +-epsilon^n c_0, and "
    "for 0 <= epsilon < 1 a solution of period n >= 1 has c_0 = 0 and constant phase: every "
    "periodic solution has period one and gamma = -nu cos(phi). There are no double-impact "
    "orbits, nor of any other period, for any nu. For epsilon = 1 the map is (phi, c) -> (phi "
    "+ 2 arctan c, c): period n > 1 exactly if arctan|c| = pi j/n, j and n coprime, 1 <= j < "
    "n/2, so n >= 3: none of period two either."
)
STICKING = (
    CLOSED
    + " Sticking: for nu < 0 no impact sticks, even a plastic one; for nu > 0 exactly those with "
    "K_k = 0 do, for ever, and all others rebound. The launch from (phi_1, gamma_1) has the "
    "relative velocity epsilon (gamma_1 + nu cos phi_1) in scaled units, with cos(phi_1) and "
    "not cos(phi_o); gamma_1 + nu cos(phi_1) = K_o, so the true condition for the rebound at "
    "phi_1 is nu epsilon K_o > 0. As printed the expression is K_o - nu (cos phi_1 - cos "
    "phi_o). Where K_o = 0 it is 0, so that it does not stick where it is < 0 is true, but no "
    "test; for |nu| <= 1/2 it has the sign of K_o, as |cos phi_1 - cos phi_o| <= 2 "
    "|K_o|/sqrt(1 + K_o^2)."
)
SUBHARMONICS = (
    CLOSED
    + " "
    + _ITERATES
    + " So for 0 <= epsilon < 1 and every amplitude nu the steady motion is a sine of the "
    "frequency of the table (nu < 0), or rest on it (nu > 0): the model has no steady "
    "subharmonic, and raising the amplitude makes none. For epsilon = 1 all flights of a motion "
    "with c_0 not 0 are equal: for nu < 0 they last T = 2 pi - 2 arctan|c_0|, for nu > 0 T = 2 "
    "arctan|c_0|, so the gap has the period T < 2 pi, and the displacement, table plus gap, has "
    "only the frequency of the table and multiples of 2 pi/T times it, larger ones: no component "
    "below the frequency of the table either. It repeats after n impacts in n - j periods of the "
    "table if nu < 0 and |c_0| = tan(pi j/n), j and n coprime, 1 <= j < n/2 (nine in eight for "
    "tan(pi/9)); such motions attract nothing, since |c_k| is constant."
)
