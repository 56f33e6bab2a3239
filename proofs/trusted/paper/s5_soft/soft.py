"""Section 5, soft springs: S1 to S10, the relations, their fixed points and the limit of them."""

from __future__ import annotations

from proofs.trusted.numbers import Range, between
from proofs.trusted.paper import Decision
from proofs.trusted.paper.formulas import Derivation, Equal, Series, at, differ
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft.soft_stability import STABILITY
from proofs.trusted.verdicts import Verdict

_FLIGHT = (
    Equal(f"D({eq.X20}, t, t) + omega_n**2*({eq.X20})", "-g"),
    Equal(f"at({eq.X20}, t=t0)", "x0"),
    Equal(f"D({eq.X20}, t)", eq.V21),
    Equal(f"at({eq.V21}, t=t0)", "v0"),
)
_RESTITUTION = Equal(f"-(({eq.SPEED5}) - beta*omega*cos(a))/(v - beta*omega*cos(a))", "epsilon")
_IMPACT = (
    Equal(
        f"at({eq.X20}, t=t0 + tau, x0={eq.HEIGHT4}, v0={eq.SPEED5}) - (-p + beta*sin(b))", eq.S22
    ),
    Equal(f"at({eq.V21}, t=t0 + tau, x0={eq.HEIGHT4}, v0={eq.SPEED5})", eq.S23),
    Equal(f"at({eq.S22}, a=psi, b=psi1, tau=(psi1 - psi + 2*pi*m)/omega)", eq.S24),
    Equal(f"at({eq.S23}, a=psi, tau=(psi1 - psi + 2*pi*m)/omega)", eq.S25),
)
_FIRST = Equal(f"at({eq.S24}, psi1=psi)", eq.TRUE26)
_SECOND = Equal(f"at({eq.S25}, psi1=psi)", eq.S27)
_VELOCITY = Equal(f"at({eq.S27}, v={eq.S29})", eq.S29)
_PHASE = Equal(f"at({eq.TRUE26}, v={eq.S29})", eq.TRUE28)
_NONZERO = ("omega", "1 + epsilon")
_LIMITS = tuple(
    Series(printed, "omega_n", (limit,), _NONZERO) for printed, limit in eq.LIMITS.items()
)
_TRUE_LIMITS = (
    Series(eq.TRUE_A28, "omega_n", ("0",), _NONZERO),
    Series(eq.TRUE28, "omega_n", (eq.LIMIT28, "0"), _NONZERO),
)
_COSINE = (
    Equal(eq.LIMIT28, f"2*pi*m*beta*(cos(psi) - {eq.COSINE})"),
    Equal(f"at({eq.COSINE}, beta=rho*g/(2*omega**2))", eq.COSINE_RHO),
)
_FINITE = (
    Equal(f"({eq.TRUE28})*(1 + epsilon*cos(2*pi*m*omega_n/omega))", eq.FACTORS28),
    Series(eq.FINITE, "k", ("2*pi*m", "0", "2*(pi*m)**3/3 - pi*m*(q - rho*sin(psi))")),
    Equal(f"at({eq.STIFF_MAP}, {eq.STIFF_FIXED})", "0"),
    Equal(f"at({eq.STIFF_VELOCITY}, {eq.STIFF_FIXED})", eq.STIFF_LAMBDA),
)

_POINT26 = {"p": "1", "beta": "1/10", "psi": "1", "m": "1", "omega_n": "1/10", "omega": "1"}
_POINT26 |= {"epsilon": "1/2", "g": "1"}


def _verified(why: str, corrected: str | None = None) -> Decision:
    return Decision(Verdict.VERIFIED, why, corrected=corrected)


def _misprint26(difference: Range) -> Decision:
    why = f"printed minus derived is {between(difference)} where p = omega = m = psi = g = 1"
    return Decision(
        Verdict.REFUTED,
        why,
        witness="at p = omega = m = psi = g = 1, omega_n = beta = 1/10, epsilon = 1/2, v = -1 the "
        f"left side of (26) as printed minus the one that follows from (24) is "
        f"{between(difference)}; always, with x = pi m omega_n/omega, it is -2 g (sin^2(2 x) - "
        "sin^2 x)/omega_n^2",
        corrected="At a fixed point psi_(k+1) = psi_k = psi, v_(k+1) = v_k = v with a flight "
        "over m periods of the table (24) reads (-p + beta sin psi) cos(2 x) + (-epsilon v + (1 "
        "+ epsilon) beta omega cos psi) sin(2 x)/omega_n - (2 g/omega_n^2) sin^2(x) + p - beta "
        "sin psi = 0, x = pi m omega_n/omega: the square is that of sin x, as in C(omega_n) of "
        "(28), not of sin(2 x).",
    )


def _misprint28(difference: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        f"a divisor omega_n too many in the second term: off by {between(difference)} at a point",
        witness="at p = omega = m = psi = g = 1, omega_n = beta = 1/10, epsilon = 1/2 the "
        f"printed expression minus the derived one is {between(difference)}; always it is epsilon "
        "(-p + beta sin psi) sin^2(2 x) (1/omega_n - 1)/(1 + epsilon cos(2 x)), x = pi m "
        "omega_n/omega",
        corrected="With v from (29), the fixed-point equation derived from (24) is 2 (p - beta "
        "sin psi) sin^2 x + epsilon (-p + beta sin psi) sin^2(2 x)/(1 + epsilon cos(2 x)) + B - "
        "C + D = 0, x = pi m omega_n/omega, B, C, D as printed in (28). Multiplied by 1 + "
        "epsilon cos(2 x) it is 2 sin^2(x) ((1 - epsilon) (p - beta sin psi - g/omega_n^2) + (1 "
        "+ epsilon) beta omega cos(psi) cot(x)/omega_n) = 0, where sin x is not 0.",
    )


def _misprint_phase(value: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        f"cos X - X in {between(value)} for X = pi/4 (epsilon = 1/3, m = 1, rho = 4): "
        "arccos X is not X",
        witness="m = 1, epsilon = 1/3, rho = 4: X = ((1 - epsilon)/(1 + epsilon)) 2 pi m/rho = "
        f"pi/4, and cos X - X is in {between(value)}, so arccos X is not X: the second equality, "
        "without the inverse cosine, is false",
        corrected="Let X = (1 - epsilon) pi m g/((1 + epsilon) omega^2 beta) = ((1 - epsilon)/(1 "
        "+ epsilon)) 2 pi m/rho, rho = 2 omega^2 beta/g. If X < 1, for every small omega_n > 0 "
        "there are exactly two fixed phases; they tend to arccos X and -arccos X as omega_n -> "
        "0. If X > 1 there is none for small omega_n. The limit equation is cos psi = X.",
    )


def _order(_: Range) -> Decision:
    return Decision(
        Verdict.REFUTED,
        "O(mu) as defined holds for every convergent function; the error is O(omega_n^2)",
        witness="f(mu) = 1 for all mu has the finite limit K = 1, so it is O(mu) as defined, and "
        "'psi = psi_o + O(mu)' says nothing about the error of the limit",
        corrected="Let k = omega_n/omega, rho = 2 omega^2 beta/g, q = 2 omega^2 p/g, 0 < k <= "
        "1/(pi m), 0 <= epsilon < 1. The fixed points of (24), (25) with flights over m periods "
        "are exactly the phases with ((1 + epsilon)/(1 - epsilon)) rho cos psi = tan(pi m k) "
        "(2/k - k (q - rho sin psi)), with lambda = -((1 + epsilon)/(1 - epsilon)) rho cos psi. "
        "The right side is 2 pi m + (2 (pi m)^3/3 - pi m (q - rho sin psi)) k^2 + O(k^3), so the "
        "error is of the order omega_n^2; and |rho cos psi - ((1 - epsilon)/(1 + epsilon)) 2 pi "
        "m| <= ((1 - epsilon)/(1 + epsilon)) 2 pi m ((pi m)^2 + |q| + rho) k^2. (For 0 < x <= 1: "
        "tan is convex and tan 1 < 1.56, so tan x < 1.56 x, tan' - 1 = tan^2 < 2.44 x^2 and x < "
        "tan x < x + x^3.)",
    )


BEFORE = (
    Derivation(
        "S1",
        "Flight with gravity: (20) and (21) solve x'' + omega_n^2 x = -g, (19), with x = x_o and "
        "x' = x'_o at t = t_0.",
        _FLIGHT,
        lambda: _verified(
            "(20) solves (19), (21) is its derivative, both have the initial values; there is no "
            "other solution (Picard and Lindelof)"
        ),
    ),
    Derivation(
        "S2",
        "The impact relations (22) and (23), and (24) and (25) in the phase psi, follow from (20), "
        "(21) and the rule of restitution.",
        (*_FLIGHT, _RESTITUTION, *_IMPACT),
        lambda: _verified(
            "(22), (23) are (20) minus the table and (21) after a launch by (4), (5); (24), (25) "
            "are these with omega t = psi + 2 pi m"
        ),
    ),
    Derivation(
        "S3",
        "The fixed points satisfy (26), with sin^2(2 pi m omega_n/omega) in its third term.",
        (
            _FIRST,
            Equal(
                f"({eq.S26}) - ({eq.TRUE26})",
                "-2*g*(sin(2*pi*m*omega_n/omega)**2 - sin(pi*m*omega_n/omega)**2)/omega_n**2",
            ),
        ),
        _misprint26,
        (differ(eq.S26, eq.TRUE26, **_POINT26, v="-1"),),
    ),
    Derivation(
        "S4",
        "The fixed points satisfy (27).",
        (_SECOND,),
        lambda: _verified("(25) at psi_(k+1) = psi_k, with v_(k+1) = v_k, is (27)"),
    ),
    Derivation(
        "S5",
        "The equation (28) with A, B, C, D, its right side 0, is (26) with v from (27).",
        (
            _VELOCITY,
            _PHASE,
            Equal(
                f"({eq.S28}) - ({eq.TRUE28})",
                "epsilon*(-p + beta*sin(psi))*sin(2*pi*m*omega_n/omega)**2*(1/omega_n - 1)"
                "/(1 + epsilon*cos(2*pi*m*omega_n/omega))",
            ),
            _FINITE[0],
        ),
        _misprint28,
        (differ(eq.S28, eq.TRUE28, **_POINT26),),
    ),
    Derivation(
        "S6",
        "(29), with E, F, G, is (27) solved for v.",
        (_VELOCITY,),
        lambda: _verified(
            "(29) satisfies (27), which is linear in v with the coefficient 1 + epsilon cos(2 pi m "
            "omega_n/omega), not 0 for epsilon < 1"
        ),
    ),
    Derivation(
        "S7",
        "The limits of A, B, C, D, E, F, G as omega_n -> 0.",
        (*_LIMITS, *_TRUE_LIMITS),
        lambda: _verified(
            "each is the constant term of a power series in omega_n, psi fixed; A -> 0 also "
            "without the divisor omega_n of S5; the sum A + B - C + D has no term of first order"
        ),
    ),
    Derivation(
        "S8",
        "The fixed phase tends to arccos((1 - epsilon) pi m g/((1 + epsilon) omega^2 beta)), which "
        "equals ((1 - epsilon)/(1 + epsilon)) 2 pi m/rho.",
        (_VELOCITY, _PHASE, *_TRUE_LIMITS, *_COSINE, _FINITE[0]),
        _misprint_phase,
        (at(f"cos(({eq.COSINE_RHO})) - {eq.COSINE_RHO}", -1, epsilon="1/3", m="1", rho="4"),),
    ),
    Derivation(
        "S9",
        "The fixed velocity tends to v = -pi m g/omega, that is lambda = -2 pi m.",
        (
            *_COSINE,
            Series(eq.S29, "omega_n", (f"{eq.LIMITS[eq.G29]} - {eq.LIMITS[eq.F29]}",), _NONZERO),
            Equal(
                f"at(beta*omega*x - {eq.LIMITS[eq.F29]}, x={eq.COSINE})",
                "-pi*m*g/omega",
            ),
            Equal("at(2*omega*v/g, v=-pi*m*g/omega)", "-2*pi*m"),
        ),
        lambda: _verified(
            "(29) tends to beta omega cos psi - 2 pi m g/(omega (1 + epsilon)), which is -pi m "
            "g/omega at the limit phase"
        ),
    ),
    Derivation(
        "S10",
        "The error of these limits is O(mu), f being O(mu) if f(mu) has a finite limit K >= 0 as "
        "mu -> 0.",
        (_VELOCITY, _PHASE, *_FINITE),
        _order,
        (at("39/25 - sin(x)/cos(x)", 1, x="1"),),
    ),
)

DERIVATIONS = (*BEFORE, *STABILITY)
CLAIMS = tuple(derivation.claim for derivation in DERIVATIONS)
