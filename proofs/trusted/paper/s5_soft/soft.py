"""Section 5, soft springs: S1 to S10, the relations, their fixed points and the limit of them."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Passage, at, corollary, derived_row, differ
from proofs.trusted.paper.s2_foundations import HEIGHT4, RESTITUTION, SPEED5
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.verdicts import Verdict

_FLIGHT = (
    Equal.read(f"D({eq.X20}, t, t) + omega_n**2*({eq.X20})", "-g"),
    Equal.read(f"at({eq.X20}, t=t0)", "x0"),
    Equal.read(f"D({eq.X20}, t)", eq.V21),
    Equal.read(f"at({eq.V21}, t=t0)", "v0"),
)
_IMPACT = (
    Equal.read(f"at({eq.X20}, t=t0 + tau, x0={HEIGHT4}, v0={SPEED5}) - (-p + beta*sin(b))", eq.S22),
    Equal.read(f"at({eq.V21}, t=t0 + tau, x0={HEIGHT4}, v0={SPEED5})", eq.S23),
    Equal.read(f"at({eq.S22}, a=psi, b=psi1, tau=(psi1 - psi + 2*pi*m)/omega)", eq.S24),
    Equal.read(f"at({eq.S23}, a=psi, tau=(psi1 - psi + 2*pi*m)/omega)", eq.S25),
)
_FIRST = Equal.read(f"at({eq.S24}, psi1=psi)", eq.TRUE26)
_SECOND = Equal.read(f"at({eq.S25}, psi1=psi)", eq.S27)
_VELOCITY = Equal.read(f"at({eq.S27}, v={eq.S29})", eq.S29)
_PHASE = Equal.read(f"at({eq.TRUE26}, v={eq.S29})", eq.TRUE28)
_NONZERO = ("omega", "1 + epsilon")
_LIMITS = tuple(
    Series.read(printed, "omega_n", (limit,), _NONZERO) for printed, limit in eq.LIMITS.items()
)
_TRUE_LIMITS = (
    Series.read(eq.TRUE_A28, "omega_n", ("0",), _NONZERO),
    Series.read(eq.TRUE28, "omega_n", (eq.LIMIT28, "0"), _NONZERO),
)
_COSINE = (
    Equal.read(eq.LIMIT28, f"2*pi*m*beta*(cos(psi) - {eq.COSINE})"),
    Equal.read(f"at({eq.COSINE}, beta=rho*g/(2*omega**2))", eq.COSINE_RHO),
)
_FINITE = (
    Equal.read(f"({eq.TRUE28})*(1 + epsilon*cos(2*pi*m*omega_n/omega))", eq.FACTORS28),
    Series.read(eq.FINITE, "k", ("2*pi*m", "0", "2*(pi*m)**3/3 - pi*m*(q - rho*sin(psi))")),
    Equal.read(f"at({eq.STIFF_MAP}, {eq.STIFF_FIXED})", "0"),
    Equal.read(f"at({eq.STIFF_VELOCITY}, {eq.STIFF_FIXED})", eq.STIFF_LAMBDA),
)

_POINT = {"p": "1", "beta": "1/10", "psi": "1", "m": "1", "omega_n": "1/10", "omega": "1"}
_POINT |= {"epsilon": "1/2", "g": "1"}

ROWS = (
    derived_row(
        Passage("S1", "5, (19)-(21)", "The solution of this equation is given by"),
        "Flight with gravity: (20) and (21) solve x'' + omega_n^2 x = -g, (19), with x = x_o and "
        "x' = x'_o at t = t_0.",
        Verdict.VERIFIED,
        corollary(
            "(20) solves (19), (21) is its derivative, both have the initial values; there is no "
            "other solution (Picard and Lindelof).",
            *_FLIGHT,
        ),
    ),
    derived_row(
        Passage("S2", "5, (22)-(25)", "The impact dynamics can be obtained"),
        "The impact relations (22) and (23), and (24) and (25) in the phase psi, follow from (20), "
        "(21) and the rule of restitution.",
        Verdict.VERIFIED,
        corollary(
            "(22), (23) are (20) minus the table and (21) after a launch by (4), (5); (24), (25) "
            "are these with omega t = psi + 2 pi m.",
            *_FLIGHT,
            RESTITUTION,
            *_IMPACT,
        ),
    ),
    derived_row(
        Passage("S3", "5, (26)", "To find the fixed points"),
        "The fixed points satisfy (26), with sin^2(2 pi m omega_n/omega) in its third term.",
        Verdict.REFUTED,
        corollary(
            "Printed minus derived, the left side of (26) is {0} at p = omega = m = psi = g = 1, "
            "omega_n = beta = 1/10, epsilon = 1/2, v = -1. Always it is -2 g (sin^2(2 x) - sin^2 "
            "x)/omega_n^2, x = pi m omega_n/omega.",
            Equal.read(
                f"({eq.S26}) - ({eq.TRUE26})",
                "-2*g*(sin(2*pi*m*omega_n/omega)**2 - sin(pi*m*omega_n/omega)**2)/omega_n**2",
            ),
            values=(differ(eq.S26, eq.TRUE26, **_POINT, v="-1"),),
        ),
        corrected=(
            corollary(
                "At a fixed point psi_(k+1) = psi_k = psi, v_(k+1) = v_k = v with a flight over m "
                "periods of the table (24) reads (-p + beta sin psi) cos(2 x) + (-epsilon v + (1 + "
                "epsilon) beta omega cos psi) sin(2 x)/omega_n - (2 g/omega_n^2) sin^2(x) + p - "
                "beta sin psi = 0, x = pi m omega_n/omega: the square is that of sin x, as in "
                "C(omega_n) of (28), not of sin(2 x).",
                _FIRST,
            ),
        ),
    ),
    derived_row(
        Passage("S4", "5, (27)", "To find the fixed points"),
        "The fixed points satisfy (27).",
        Verdict.VERIFIED,
        corollary("(25) at psi_(k+1) = psi_k, with v_(k+1) = v_k, is (27).", _SECOND),
    ),
    derived_row(
        Passage("S5", "5, (28)", "These equations can be rewritten as"),
        "The equation (28) with A, B, C, D, its right side 0, is (26) with v from (27).",
        Verdict.REFUTED,
        corollary(
            "The second term of (28) has a divisor omega_n too many: printed minus derived it is "
            "{0} at p = omega = m = psi = g = 1, omega_n = beta = 1/10, epsilon = 1/2. Always it "
            "is epsilon (-p + beta sin psi) sin^2(2 x) (1/omega_n - 1)/(1 + epsilon cos(2 x)), x = "
            "pi m omega_n/omega.",
            Equal.read(
                f"({eq.S28}) - ({eq.TRUE28})",
                "epsilon*(-p + beta*sin(psi))*sin(2*pi*m*omega_n/omega)**2*(1/omega_n - 1)"
                "/(1 + epsilon*cos(2*pi*m*omega_n/omega))",
            ),
            values=(differ(eq.S28, eq.TRUE28, **_POINT),),
        ),
        corrected=(
            corollary(
                "With v from (29), the fixed-point equation derived from (24) is 2 (p - beta sin "
                "psi) sin^2 x + epsilon (-p + beta sin psi) sin^2(2 x)/(1 + epsilon cos(2 x)) + B "
                "- C + D = 0, x = pi m omega_n/omega, B, C, D as printed in (28). Multiplied by 1 "
                "+ epsilon cos(2 x) it is 2 sin^2(x) ((1 - epsilon) (p - beta sin psi - g/"
                "omega_n^2) + (1 + epsilon) beta omega cos(psi) cot(x)/omega_n) = 0, where sin x "
                "is not 0.",
                _VELOCITY,
                _PHASE,
                _FINITE[0],
            ),
        ),
    ),
    derived_row(
        Passage("S6", "5, (29)", "These equations can be rewritten as"),
        "(29), with E, F, G, is (27) solved for v.",
        Verdict.VERIFIED,
        corollary(
            "(29) satisfies (27), which is linear in v with the coefficient 1 + epsilon cos(2 pi m "
            "omega_n/omega), not 0 for epsilon < 1.",
            _VELOCITY,
        ),
    ),
    derived_row(
        Passage("S7", "5, limits of A to G", "Now,"),
        "The limits of A, B, C, D, E, F, G as omega_n -> 0.",
        Verdict.VERIFIED,
        corollary(
            "Each is the constant term of a power series in omega_n, psi fixed; A -> 0 also "
            "without the divisor omega_n of S5; the sum A + B - C + D has no term of first order.",
            *_LIMITS,
            *_TRUE_LIMITS,
        ),
    ),
    derived_row(
        Passage("S8", "5, psi-bar", "So, for every $\\mu > 0$, there exists a $\\delta > 0$"),
        "The fixed phase 'can be made arbitrarily close to' arccos((1 - epsilon) pi m g/((1 + "
        "epsilon) omega^2 beta)), which is ((1 - epsilon)/(1 + epsilon)) 2 pi m/rho, 'plus O(mu)'.",
        Verdict.CONDITIONAL,
        corollary(
            "Let X = (1 - epsilon) pi m g/((1 + epsilon) omega^2 beta) = ((1 - epsilon)/(1 + "
            "epsilon)) 2 pi m/rho. True if X < 1, for an error O(mu) that tends to 0 with omega_n "
            "(as the paper defines O(mu), see S10, it need not), and if the last expression, "
            "printed without its inverse cosine, is read as psi_o of S11 is: arccos of the whole "
            "product, arccos X. As printed it is X, which is not arccos X: at m = 1, epsilon = "
            "1/3, rho = 4, X = pi/4 and cos X - X is in {0}.",
            *_TRUE_LIMITS,
            *_COSINE,
            *_FINITE,
            values=(
                at(f"cos(({eq.COSINE_RHO})) - {eq.COSINE_RHO}", -1, epsilon="1/3", m="1", rho="4"),
            ),
        ),
        corrected=(
            corollary(
                "Let beta, omega, g > 0, m >= 1, 0 <= epsilon < 1, rho = 2 omega^2 beta/g and X = "
                "(1 - epsilon) pi m g/((1 + epsilon) omega^2 beta) = ((1 - epsilon)/(1 + epsilon)) "
                "2 pi m/rho. If X < 1, for every small omega_n > 0 there are exactly two fixed "
                "phases with flights over m periods; they tend to arccos X and -arccos X as "
                "omega_n -> 0. If X > 1 there is none for small omega_n. The limit equation is cos "
                "psi = X.",
                _VELOCITY,
                _PHASE,
                *_TRUE_LIMITS,
                *_COSINE,
                _FINITE[0],
            ),
        ),
    ),
    derived_row(
        Passage("S9", "5, v-bar, lambda-bar", "Note that the same results have been obtained in"),
        "The fixed velocity tends to v = -pi m g/omega, that is lambda = -2 pi m.",
        Verdict.VERIFIED,
        corollary(
            "(29) tends to beta omega cos psi - 2 pi m g/(omega (1 + epsilon)), which is -pi m "
            "g/omega at the limit phase.",
            *_COSINE,
            Series.read(
                eq.S29, "omega_n", (f"{eq.LIMITS[eq.G29]} - {eq.LIMITS[eq.F29]}",), _NONZERO
            ),
            Equal.read(f"at(beta*omega*x - {eq.LIMITS[eq.F29]}, x={eq.COSINE})", "-pi*m*g/omega"),
            Equal.read("at(2*omega*v/g, v=-pi*m*g/omega)", "-2*pi*m"),
        ),
    ),
    derived_row(
        Passage("S10", "5, O(mu)", "is said to be of $O(\\mu)$ if"),
        "The fixed points are their limits 'plus O(mu)', f being 'of O(mu) if there exists a "
        "constant K such that 0 <= K < infinity and lim f(mu) = K' as mu -> 0.",
        Verdict.CONDITIONAL,
        corollary(
            "True if X < 1, X as in S8, where both fixed points exist for small omega_n and tend "
            "to their limits, psi_o being read as in S8 and S11. If X > 1 there are none. As "
            "defined f = 1 is O(mu), too, so the words leave open how small the error is; it is of "
            "the order omega_n^2.",
            *_TRUE_LIMITS,
            *_COSINE,
            *_FINITE,
        ),
        corrected=(
            corollary(
                "Let beta, omega, g > 0, m >= 1, 0 <= epsilon < 1, k = omega_n/omega, rho = 2 "
                "omega^2 beta/g, q = 2 omega^2 p/g, 0 < k <= 1/(pi m). The fixed points of (24), "
                "(25) with flights over m periods are exactly the phases with ((1 + epsilon)/(1 - "
                "epsilon)) rho cos psi = tan(pi m k) (2/k - k (q - rho sin psi)), with lambda = "
                "-((1 + epsilon)/(1 - epsilon)) rho cos psi. The right side is 2 pi m + (2 (pi "
                "m)^3/3 - pi m (q - rho sin psi)) k^2 + O(k^3), so the error of rho cos psi, and "
                "with X < 1 as in S8 that of psi, is of the order omega_n^2; and |rho cos psi - "
                "((1 - epsilon)/(1 + epsilon)) 2 pi m| <= ((1 - epsilon)/(1 + epsilon)) 2 pi m "
                "((pi m)^2 + |q| + rho) k^2. (For 0 < x <= 1: tan is convex and tan 1 < 1.56, so "
                "tan x < 1.56 x, tan' - 1 = tan^2 < 2.44 x^2 and x < tan x < x + x^3.)",
                _VELOCITY,
                _PHASE,
                *_FINITE,
                values=(at("39/25 - sin(x)/cos(x)", 1, x="1"),),
            ),
        ),
    ),
)
