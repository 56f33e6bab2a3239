"""Section 2 and the appendix: M1 to M5, free flight, launch, and the impact relations."""

from __future__ import annotations

from proofs.trusted.paper import Decision
from proofs.trusted.paper.formulas import Derivation, Equal
from proofs.trusted.paper.s2_foundations import displayed as eq
from proofs.trusted.paper.s2_foundations.separation import LAUNCH, SEPARATIONS
from proofs.trusted.paper.s5_soft.displayed import HEIGHT4
from proofs.trusted.paper.s7_appendix.appendix import MARCHING, MEASURES
from proofs.trusted.verdicts import Verdict

_FLIGHT = (
    Equal(f"D({eq.X2}, t, t) + omega_n**2*({eq.X2})", "0"),
    Equal(f"at({eq.X2}, t=t0)", "x0"),
    Equal(f"D({eq.X2}, t)", eq.V3),
    Equal(f"at({eq.V3}, t=t0)", "v0"),
)
_LAUNCH = (
    Equal(f"at({eq.TABLE}, t=a/omega)", HEIGHT4),
    Equal(f"at(D({eq.TABLE}, t), t=a/omega)", "beta*omega*cos(a)"),
    Equal(eq.RESTITUTION, "epsilon"),
)
_RELATIONS = (
    Equal(f"at({eq.X2}, {eq.AT_IMPACT}) - (-p + beta*sin(b))", eq.S8),
    Equal(f"at({eq.V3}, {eq.AT_IMPACT})", eq.S9),
    Equal(f"at({eq.S8}, {eq.SCALES}, b=psi1)", f"-p*({eq.S14})"),
    Equal(f"at({eq.S9}, {eq.SCALES})", f"eta*omega*p*({eq.S15})"),
)
_PLASTIC = (*_RELATIONS[::2], Equal(f"at({eq.S14}, epsilon=0)", eq.S10))

# At eta = 1: sin(h)/cos(h) stands for K, and a zero of the second factor is t = 2 h + 2 pi n.
_RESONANT = (
    Equal(f"at({eq.REBOUND}, eta=1)", eq.RESONANT),
    Equal("sin(h)/cos(h)*cos(t/2) - sin(t/2)", "sin(h - t/2)/cos(h)"),
    Equal(
        f"at({eq.S15}, eta=1, psi1=psi + 2*h, gamma=sin(h)/(epsilon*cos(h)) - nu*cos(psi))",
        "sin(h)/cos(h) - nu*cos(psi + 2*h)",
    ),
    Equal(f"at({eq.S15}, eta=1, epsilon=0, psi1=psi)", "-nu*cos(psi)"),
)
_QUADRATIC = (
    Equal(f"at({eq.PLASTIC}, eta=1/2)", eq.HALF),
    Equal(f"at({eq.PLASTIC}, eta=2)", eq.TWICE),
)


def _verified(why: str, corrected: str | None = None) -> Decision:
    return Decision(Verdict.VERIFIED, why, corrected=corrected)


def _closed_form() -> Decision:
    """Decide M5. The first zero at eta = 1 lies where the gap, sign(nu) times (14), returns to 0.

    For nu < 0 the launch has K <= 0 and the gap is 2 sin(t/2) (sin(t/2) - K cos(t/2)), positive
    up to t/2 = pi + arctan K; for nu > 0 and K > 0 its negative, positive up to t/2 = arctan K.
    A rational eta = m/q: with u = tan(t/(2 q)) the four functions of time in (10) are polynomials
    in u of degree <= 2 N over (1 + u^2)^N, N = max(m, q); the double zero at t = 0 (M7) is u^2.
    At eta = 1/2, t/4 = pi/2 is a zero only if 1 + nu sin(psi) = 0; at eta = 2, t/2 = pi/2 only if
    sin(psi) = 0: elsewhere the form is divided by the square of the cosine.
    """
    return Decision(
        Verdict.REFUTED,
        "at eta = 1 (14) factors, and its zeros are t = 2 pi n and t = 2 arctan K + 2 pi n; at "
        "eta = 1/2 and 2 the plastic relation (10) is a quadratic equation",
        witness="eta = 1: with t = psi_(k+1) - psi_k and K = epsilon (gamma_k + nu cos psi_k) the "
        "left side of (14) is cos t - 1 + K sin t = 2 sin(t/2) (K cos(t/2) - sin(t/2)) for all "
        "nu, epsilon, psi_k, gamma_k: its zeros are t = 2 pi n and t = 2 arctan K + 2 pi n",
        corrected="Let t = psi_(k+1) - psi_k, L = nu sin psi_k, R = nu cos psi_k. At eta = 1, with "
        "K = epsilon (gamma_k + R), the left side of (14) is 2 sin(t/2) (K cos(t/2) - sin(t/2)): "
        "the next impact is at t = 2 pi + 2 arctan K if nu < 0 (K <= 0; at K = 0 the mass only "
        "touches the table), at t = 2 arctan K if nu > 0 and K > 0, and in both cases gamma_(k+1) "
        "= K - nu cos psi_(k+1); if nu > 0 and K = 0 the mass stays on the table. At eta = 1/2 "
        "the left side of (10) is -2 sin^2(t/4) ((1 + L) sin^2(t/4) - 4 R sin(t/4) cos(t/4) + (1 "
        "- 3 L) cos^2(t/4)): where 1 + L is not 0, its zeros with 0 < t < 4 pi are t = 4 arctan "
        "u, + 4 pi if u < 0, for the real u not 0 among (2 R +- sqrt(4 R^2 - (1 + L) (1 - 3 "
        "L)))/(1 + L). At eta = 2 it is 2 sin^2(t/2) (L sin^2(t/2) - 2 R sin(t/2) cos(t/2) - (4 + "
        "3 L) cos^2(t/2)): where L is not 0, its zeros with 0 < t < 2 pi are t = 2 arctan u, + 2 "
        "pi if u < 0, for the real u not 0 among (R +- sqrt(R^2 + L (4 + 3 L)))/L. For any "
        "rational eta = m/q, N = max(m, q), (10) is u^2 times a polynomial of degree <= 2 N - 2 in "
        "u = tan(t/(2 q)), divided by (1 + u^2)^N: one of degree <= 4, solved by radicals, at eta "
        "= 1/3, 2/3, 3/2 and 3 too.",
    )


RELATIONS = (
    Derivation(
        "M1",
        "Free flight: (2) and (3) solve x'' + omega_n^2 x = 0, (1), with x = x_o and x' = x'_o at "
        "t = t_0.",
        _FLIGHT,
        lambda: _verified(
            "(2) solves (1), (3) is its derivative, both have the initial values; the difference d "
            "of two solutions has d'^2 + omega_n^2 d^2 constant, so 0: there is no other"
        ),
    ),
    Derivation(
        "M2",
        "The launch: (4) is the position of the table, and (5) follows from the coefficient of "
        "restitution.",
        _LAUNCH,
        lambda: _verified(
            "(4) is z(t_k), and with (5) minus the ratio of the relative velocities is epsilon; "
            "v_k is the velocity, with its sign, not the speed"
        ),
    ),
    Derivation(
        "M3",
        "The impact relations (8), (9) follow from (2)-(7), and (14), (15) from them with psi = "
        "omega t, nu = -beta/p, eta = omega_n/omega, gamma = v/(omega_n p).",
        (*_FLIGHT, *_LAUNCH, *_RELATIONS),
        lambda: _verified(
            "(8) is (2) minus the table, (9) is (3), at t_(k+1); (8) is -p times (14), (9) is "
            "omega_n p times (15); psi_(k+1) is the first zero after psi_k at which the mass comes "
            "from above"
        ),
    ),
    Derivation(
        "M4",
        "For plastic impacts, epsilon = 0, the nondimensional relation is (10).",
        _PLASTIC,
        lambda: _verified("(10) is (14) at epsilon = 0, and (8) there divided by -p"),
    ),
    Derivation(
        "M5",
        "The impact relations are transcendental and cannot be solved in closed form, whatever the "
        "frequency ratio.",
        (*_RELATIONS, *_RESONANT, *_QUADRATIC, LAUNCH),
        _closed_form,
    ),
)

DERIVATIONS = (*RELATIONS, *SEPARATIONS, MARCHING.derivation)
CLAIMS = (*(each.claim for each in (*RELATIONS, *SEPARATIONS)), MARCHING.claim, MEASURES)
