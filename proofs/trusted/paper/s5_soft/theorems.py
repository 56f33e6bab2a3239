"""Section 5, soft springs: what S11 to S23 rest on, lemmas and theorems."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Lemma, corollary
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import near
from proofs.trusted.paper.s5_soft.orbits import admissible

_SCALED = ("omega", "g")
MAP: tuple[Lemma, ...] = (
    Series.read(f"at({eq.S24}, {eq.SCALES})*2*omega**2/g", "omega_n", (eq.MAP,), _SCALED),
    Series.read(f"at({eq.S25}, {eq.SCALES})*2*omega/g", "omega_n", (eq.VELOCITY,), _SCALED),
    Equal.read(f"at({eq.MAP}, psi1=psi)", f"2*pi*m*({eq.LAUNCH} - 2*pi*m)"),
    Equal.read(f"at({eq.VELOCITY}, psi1=psi)", f"({eq.LAUNCH} - 2*pi*m) - 2*pi*m"),
    Equal.read(f"at({eq.LAUNCH}, lam=-2*pi*m, rho={eq.RHO})", "2*pi*m"),
    Equal.read(f"({eq.ALPHA})**2", f"at({eq.ALPHA_SQUARE}, rho={eq.RHO})"),
)
LOCAL: tuple[Lemma, ...] = tuple(
    Equal.read(f"at({each}, {near.MOVED})", f"at({local}, {near.HERE})")
    for each, local in zip((eq.MAP, f"lam1 - ({eq.VELOCITY})"), near.LOCAL, strict=True)
)
JACOBIAN: tuple[Lemma, ...] = (*MAP, *LOCAL, near.POINT)
_A, _B, _C, _D = (f"({entry})" for entry in eq.JACOBIAN)
DETERMINANT = Equal.read(f"{_A}*{_D} - {_B}*{_C}", "epsilon**2")
TRACE: tuple[Lemma, ...] = (Equal.read(f"{_A} + {_D}", eq.TRACE),)
CHARACTERISTIC: tuple[Lemma, ...] = (
    *JACOBIAN,
    DETERMINANT,
    *TRACE,
    Equal.read(eq.AT_ONE, "(1 + epsilon)/2*alpha"),
    Equal.read(eq.AT_MINUS_ONE, f"(1 + epsilon)/2*({eq.ALPHA_FLIP} - alpha)"),
    Equal.read(f"at({eq.ALPHA_SQUARE}, rho={eq.RHO_SN})", "0"),
    Equal.read(f"at({eq.ALPHA_SQUARE}, rho={eq.flip('alpha')})", "alpha**2"),
)
ROOTS = Equal.read(
    eq.DISCRIMINANT,
    "((1 + epsilon)/2*alpha - (1 - epsilon)**2)*((1 + epsilon)/2*alpha - (1 + epsilon)**2)",
)
THRESHOLDS: tuple[Lemma, ...] = (
    Equal.read(f"at({eq.ALPHA_SQUARE}, rho={eq.RHO_M})", "(2*(1 - epsilon))**2"),
    Equal.read(
        f"({eq.PRINTED_ALPHA_FLIP})**2 - ({eq.ALPHA_FLIP})**2",
        "64*epsilon**4*(1 - epsilon**2 - epsilon**4)/((1 - 2*epsilon**2)**2*(1 + epsilon)**2)",
    ),
)
STIFF: tuple[Lemma, ...] = (
    *(
        Equal.read(
            f"at({each}, psi=x + y, psi1=x1 + y, m=s/(pi*k))",
            f"at({local}, a=rho*sin(y), b=rho*cos(y), C=cos(2*s), S=sin(2*s))",
        )
        for each, local in zip(
            (eq.STIFF_MAP, f"lam1 - ({eq.STIFF_VELOCITY})"), near.STIFF, strict=True
        )
    ),
    Equal.read("cos(2*s)*(1 + (sin(s)/cos(s))**2)", "1 - (sin(s)/cos(s))**2"),
    Equal.read("sin(2*s)*(1 + (sin(s)/cos(s))**2)", "2*sin(s)/cos(s)"),
    near.STIFF_POINT,
)
PLASTIC_LIMIT = Series.read(
    f"at({eq.S24}, epsilon=0, beta=rho*g/(2*omega**2))*2*omega**2/g",
    "omega_n",
    (eq.PLASTIC,),
    _SCALED,
)
CONDITIONS: tuple[Lemma, ...] = (
    PLASTIC_LIMIT,
    Equal.read(f"at({eq.MAP}, epsilon=0)", eq.PLASTIC),
    *LOCAL,
    near.JET,
    Equal.read("at(-(3*c**2/4 + 2), c=2*pi*m)", near.F2_PSI_PSI_PSI),
    Equal.read(f"at((c**2 + 16)/4, c=2*pi*m)/{eq.TRUE_RHO_O}", near.F2_PSI_RHO),
)
PRINTED_CONDITIONS: tuple[Lemma, ...] = (*CONDITIONS, near.PRINTED_JET)
SLOPES: tuple[Lemma, ...] = (
    *JACOBIAN,
    Equal.read(f"at({eq.ALPHA_SQUARE}, epsilon=0, rho={eq.RHO_O})", "2**2"),
    Equal.read(f"at({eq.ALPHA_SQUARE}, epsilon=0, rho={eq.TRUE_RHO_O})", "4**2"),
)
HIGH_BOUNCE: tuple[Lemma, ...] = (
    Equal.read(eq.HIGH_DETERMINANT, "epsilon"),
    Equal.read(eq.HIGH_TRACE, "1 + epsilon + gamma*sin(x)"),
    Equal.read(f"{eq.ALPHA_FLIP} - 2*(1 + epsilon)", "2*(1 - epsilon)**2/(1 + epsilon)"),
)

# -- theorems --------------------------------------------------------------------------------------

diagram = corollary(
    "Let m >= 1, 0 <= epsilon < 1, rho > 0, c = 2 pi m, r = (1 - epsilon)/(1 + epsilon). The "
    "limits of (24), (25) have solutions with psi_(k+1) = psi_k, lambda_(k+1) = lambda_k and "
    "flights over m periods exactly for rho >= rho_SN = r c: psi = arccos(rho_SN/rho) and psi = "
    "-arccos(rho_SN/rho), with lambda = -c. Let alpha = sqrt((1 + epsilon)^2 rho^2 - (1 - "
    "epsilon)^2 c^2) >= 0 and rho_F = sqrt((4 (1 + epsilon^2)/(1 + epsilon))^2 + (1 - epsilon)^2 "
    "c^2)/(1 + epsilon). The first has trace 1 + epsilon^2 - (1 + epsilon) alpha/2 and determinant "
    "epsilon^2: it is a sink for rho_SN < rho < rho_F, with eigenvalues that are not real, of "
    "modulus epsilon, exactly if (1 - epsilon)^2 < (1 + epsilon) alpha/2 < (1 + epsilon)^2; for "
    "rho > rho_F it is a saddle with one eigenvalue below -1 (of the second kind if epsilon > 0). "
    "The second has -alpha in place of alpha: it is a saddle with one eigenvalue above 1 (of the "
    "first kind if epsilon > 0) for all rho > rho_SN. At rho_SN, where the two are one, the "
    "eigenvalues are 1 and epsilon^2; at rho_F those of the first are -1 and -epsilon^2. (The "
    "characteristic polynomial is (1 + epsilon) alpha/2 at 1 and (1 + epsilon) (4 (1 + epsilon^2)/"
    "(1 + epsilon) - alpha)/2 at -1, and the product of its roots is epsilon^2 < 1.) These are "
    "orbits, the mass staying above the table from launch to impact, as follows. For 0 < epsilon < "
    "1 let h be the greatest value of r c cot u - u (c - 2 u)/sin^2 u, 0 < u <= pi/2, and rho_G = "
    "sqrt(rho_SN^2 + h^2); h < 2 falls as epsilon grows and is 0 at one epsilon_m, epsilon_1 = "
    "0.0204576.... If epsilon > epsilon_m, the first is an orbit for all rho >= rho_SN, the second "
    "exactly for rho < rho_G; if epsilon < epsilon_m, the first exactly for rho > rho_G, the "
    "second for no rho; if epsilon = epsilon_m, the first for rho > rho_SN, the second for no rho. "
    "If epsilon = 0, the first exactly for rho >= sqrt(4 + c^2), the second for no rho: the mass "
    "sticks.",
    *CHARACTERISTIC,
    admissible,
)
first_kind = corollary(
    "For m >= 1, 0 < epsilon < 1 and rho > 0 a fixed point is a saddle of the first kind exactly "
    "if it is the second one of S15, psi = -arccos(rho_SN/rho), and rho > rho_SN; and an orbit, "
    "too, exactly if epsilon > epsilon_m and rho < rho_G, with epsilon_m and rho_G of S15.",
    diagram,
)
second_kind = corollary(
    "For m >= 1, 0 < epsilon < 1 and rho > 0 a fixed point is a saddle of the second kind exactly "
    "if it is the first one of S15, psi = arccos(rho_SN/rho), and rho > rho_F; it is an orbit "
    "then. With a = 4 (1 - epsilon)/(1 - 2 epsilon^2), the paper's value of alpha at its rho_m^f, "
    "a^2 - (4 (1 + epsilon^2)/(1 + epsilon))^2 = 64 epsilon^4 (1 - epsilon^2 - epsilon^4)/((1 - 2 "
    "epsilon^2)^2 (1 + epsilon)^2): so rho_m^f is rho_F for epsilon = 0 and epsilon^2 = (sqrt(5) - "
    "1)/2 only; it is larger, and rho > rho_m^f is sufficient but not necessary for a saddle of "
    "the second kind, if 0 < epsilon^2 < (sqrt(5) - 1)/2, epsilon^2 not 1/2; it is smaller, with "
    "sinks between, if epsilon^2 > (sqrt(5) - 1)/2.",
    diagram,
    *THRESHOLDS,
)
bifurcations = corollary(
    "For m >= 1 and 0 <= epsilon < 1 two solutions, the fixed points of S15, appear at rho_SN in a "
    "saddle-node bifurcation, and the first has a flip at rho_F. The flip is one of an orbit; the "
    "saddle-node is one of orbits exactly if epsilon > epsilon_m, epsilon_1 = 0.0204576.... If 0 < "
    "epsilon < epsilon_m the first becomes an orbit at rho_G > rho_SN, where the mass grazes the "
    "table, if epsilon = 0 at sqrt(4 + (2 pi m)^2).",
    diagram,
)
stiff = corollary(
    "For springs with k = omega_n/omega, 0 < k < 1/(2 m), m >= 1, 0 <= epsilon < 1, q = 2 omega^2 "
    "p/g, s = pi m k, B = 2 + k^2 (rho sin psi - q), not 0: at a solution of (24), (25), an orbit "
    "or not, with psi_(k+1) = psi_k = psi, lambda_(k+1) = lambda_k and a flight over m periods, "
    "where rho cos psi = ((1 - epsilon)/(1 + epsilon)) tan(s) B/k, the Jacobian has the rows "
    "({k11}, {k12}) and ({k21}, {k22}), a = rho sin psi, t = tan s. The determinant is "
    "epsilon^2 as well and the trace is ((1 + epsilon)^2 + (1 - epsilon)^2 cos(2 s) - (1 + "
    "epsilon)^2 (1 + cos(2 s)) rho sin(psi)/B)/2. So -1 is an eigenvalue exactly where ((1 + "
    "epsilon)^2 (1 + cos(2 s)) - k^2 M) rho sin psi = M (2 - k^2 q), M = (1 + epsilon)^2 + 2 (1 + "
    "epsilon^2) + (1 - epsilon)^2 cos(2 s).",
    *STIFF,
)
flip = corollary(
    "For every m >= 1 and 0 <= epsilon < 1 the fixed point psi = arccos(rho_SN/rho) of the limit "
    "map, rho_SN = ((1 - epsilon)/(1 + epsilon)) c, c = 2 pi m, undergoes a supercritical "
    "period-doubling bifurcation at rho_F = sqrt((4 (1 + epsilon^2)/(1 + epsilon))^2 + (1 - "
    "epsilon)^2 c^2)/(1 + epsilon), and at no other rho, so for epsilon = 0 at sqrt(16 + c^2), not "
    "at the printed rho_o. It is an orbit there, stable just below and unstable just above, and an "
    "attracting orbit of period 2 branches off for rho just above rho_F. At rho_F the eigenvalues "
    "are -1 and -epsilon^2; the characteristic polynomial at -1, (1 + epsilon) (4 (1 + "
    "epsilon^2)/(1 + epsilon) - alpha)/2, changes sign there with alpha = sqrt((1 + epsilon)^2 "
    "rho^2 - (1 - epsilon)^2 c^2), whose derivative is positive; and the map on the centre "
    "manifold, h = psi - psi_o, has the second iterate h - 2 K h^3 + O(h^4) with K = (3 c^2 (1 - "
    "epsilon^2)^2 + 8 (1 - epsilon)^4 + 64 epsilon^2)/(48 (1 - epsilon^4)) > 0. For epsilon = 0 "
    "the third derivative of f^2 is -(3 pi^2 m^2 + 2). (There rho sin psi > 2, so the mass leaves "
    "at once, stays above the table and meets it with a speed that is not 0; so it does on nearby "
    "flights.)",
    *CHARACTERISTIC,
    *CONDITIONS,
    *LOCAL,
    near.FLIP,
    admissible,
    tex=r"h - 2 K h^3 + O(h^4), \quad K = \frac{3 c^2 (1 - \varepsilon^2)^2 + 8 (1 - \varepsilon)^4"
    r" + 64 \varepsilon^2}{48 (1 - \varepsilon^4)}",
)
