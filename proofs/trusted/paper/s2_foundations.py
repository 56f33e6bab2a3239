"""Section 2: M1 to M5 and M7 to M9, free flight, the impact relations, sticking and separation.

Names: x0, v0 position and velocity at t0; v the velocity v_k before an impact, tau the time to the
next one; a, b for omega t_k, omega t_(k+1), psi, psi1 for psi_k, psi_(k+1); gamma = v/(omega_n p).
S8 is the left side of (8), S9 the right side of (9). t is the time since t0 or since a launch.
"""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Passage, at, corollary, derived_row, theorem
from proofs.trusted.paper.s6_resonance.resonance import closed_form
from proofs.trusted.verdicts import Verdict

# -- dimensional: (1)-(9) --------------------------------------------------------------------------

X2 = "x0*cos(omega_n*(t - t0)) + v0/omega_n*sin(omega_n*(t - t0))"
V3 = "v0*cos(omega_n*(t - t0)) - omega_n*x0*sin(omega_n*(t - t0))"
TABLE = "-p + beta*sin(omega*t)"
HEIGHT4 = "-p + beta*sin(a)"
SPEED5 = "-epsilon*v + (1 + epsilon)*beta*omega*cos(a)"
S8 = (
    "(-p + beta*sin(a))*cos(omega_n*tau)"
    " + (-epsilon*v + (1 + epsilon)*beta*omega*cos(a))/omega_n*sin(omega_n*tau)"
    " + p - beta*sin(b)"
)
S9 = (
    "(omega_n*p - beta*omega_n*sin(a))*sin(omega_n*tau)"
    " + ((epsilon + 1)*beta*omega*cos(a) - epsilon*v)*cos(omega_n*tau)"
)
_AT_IMPACT = f"t=t0 + tau, x0={HEIGHT4}, v0={SPEED5}"
_FLIGHT = (
    Equal.read(f"D({X2}, t, t) + omega_n**2*({X2})", "0"),
    Equal.read(f"at({X2}, t=t0)", "x0"),
    Equal.read(f"D({X2}, t)", V3),
    Equal.read(f"at({V3}, t=t0)", "v0"),
)
RESTITUTION = Equal.read(f"-(({SPEED5}) - beta*omega*cos(a))/(v - beta*omega*cos(a))", "epsilon")
_LAUNCH = (
    Equal.read(f"at({TABLE}, t=a/omega)", HEIGHT4),
    Equal.read(f"at(D({TABLE}, t), t=a/omega)", "beta*omega*cos(a)"),
    RESTITUTION,
)

# -- nondimensional: (10), (14), (15) --------------------------------------------------------------

S10 = (
    "(1 + nu*sin(psi))*cos(eta*(psi1 - psi)) + nu/eta*cos(psi)*sin(eta*(psi1 - psi))"
    " - 1 - nu*sin(psi1)"
)
S14 = (
    "(1 + nu*sin(psi))*cos(eta*(psi1 - psi))"
    " + (epsilon*gamma + nu/eta*(1 + epsilon)*cos(psi))*sin(eta*(psi1 - psi))"
    " - 1 - nu*sin(psi1)"
)
S15 = (
    "(1 + nu*sin(psi))*sin(eta*(psi1 - psi))"
    " - (epsilon*gamma + nu/eta*(1 + epsilon)*cos(psi))*cos(eta*(psi1 - psi))"
)
_RATIOS = "omega_n=eta*omega, beta=-nu*p"
_VELOCITIES = "beta=-nu*p, v=eta*omega*p*gamma, a=psi"
_SCALES = f"{_VELOCITIES}, omega_n=eta*omega, tau=(psi1 - psi)/omega"
_RELATIONS = (
    Equal.read(f"at({X2}, {_AT_IMPACT}) - (-p + beta*sin(b))", S8),
    Equal.read(f"at({V3}, {_AT_IMPACT})", S9),
    Equal.read(f"at({S8}, {_SCALES}, b=psi1)", f"-p*({S14})"),
    Equal.read(f"at({S9}, {_SCALES})", f"eta*omega*p*({S15})"),
)
_PLASTIC = (*_RELATIONS, Equal.read(f"at({S14}, epsilon=0)", S10))

# -- the flight: (10) and (14) as functions of t ---------------------------------------------------

PLASTIC = f"at({S10}, psi1=psi + t)"
_CLOSING = "(eta*gamma + nu*cos(psi))"  # minus the relative velocity before an impact
# The derivatives of (10) at the launch, from the second on; s = sin(psi).
_BEND = "(nu*(1 - eta**2)*s - eta**2)"
_JERK = "nu*(1 - eta**2)*cos(psi)"
_SNAP = "(eta**4*(1 + nu*s) - nu*s)"
BEND = f"at({_BEND}, s=sin(psi))"
LAUNCH = Series.read(
    PLASTIC, "t", ("0", "0", f"{BEND}/2", f"{_JERK}/6", f"at({_SNAP}, s=sin(psi))/24"), ("eta",)
)
# At eta = 1/2 and eta = 2 a quadratic form in the sine and the cosine of a quarter, or half, of t.
HALF = Equal.read(
    f"at({PLASTIC}, eta=1/2)",
    "-2*sin(t/4)**2*((1 + nu*sin(psi))*sin(t/4)**2 - 4*nu*cos(psi)*sin(t/4)*cos(t/4)"
    " + (1 - 3*nu*sin(psi))*cos(t/4)**2)",
)
_TWICE = Equal.read(
    f"at({PLASTIC}, eta=2)",
    "2*sin(t/2)**2*(nu*sin(psi)*sin(t/2)**2 - 2*nu*cos(psi)*sin(t/2)*cos(t/2)"
    " - (4 + 3*nu*sin(psi))*cos(t/2)**2)",
)

# At psi = pi/2 the first two terms vanish, and the last two are >= 0 if -1 < nu < 0.
_TOP = Equal.read(
    f"-({PLASTIC})",
    "nu*(1 - sin(psi))*(cos(eta*t) - cos(t)) - nu*cos(psi)*(sin(eta*t)/eta - sin(t))"
    " + (-nu)*(1 - cos(t)) + (1 + nu)*(1 - cos(eta*t))",
)

# -- separation: s = sin(omega t_s) ----------------------------------------------------------------

_PULL = "-beta*omega**2*s"  # the acceleration of the table
_PUSH = "-omega_n**2*(-p + beta*s)"  # that of a free mass where the table is
_SEPARATION = "eta**2/(nu*(1 - eta**2))"
_FORCE = Equal.read(f"at({_PULL} - ({_PUSH}), {_RATIOS})", f"p*omega**2*{_BEND}")
_IMPACT = (
    Equal.read(f"at({SPEED5}, epsilon=0) - beta*omega*cos(a)", "0"),
    Equal.read(f"at(v - beta*omega*cos(a), {_VELOCITIES})", f"p*omega*{_CLOSING}"),
    Series.read(f"at({S14}, psi1=psi + t)", "t", ("0", f"epsilon*{_CLOSING}"), ("eta",)),
    LAUNCH,
    Equal.read(f"at({_SNAP}, s={_SEPARATION})", "-eta**2"),
)
_EQUATION = (  # between the accelerations, as printed
    Equal.read(f"at({_PULL}, beta=-nu*p)", "-(eta*omega)**2*p*(-nu/eta**2*s)"),
    Equal.read(f"at({_PUSH}, {_RATIOS})", "-(eta*omega)**2*p*(-1 - nu*s)"),
    Equal.read(_BEND, f"nu*(1 - eta**2)*(s - {_SEPARATION})"),
    Equal.read(f"at({_BEND}, eta=1)", "-1"),
    Equal.read(f"D({BEND}, psi)", _JERK),
)
_EXTREMES = (
    Equal.read(f"at({_BEND}, s=0)", "-eta**2"),
    Equal.read(f"at({_BEND}, s=1)", "(1 + nu)*(nu/(1 + nu) - eta**2)"),
    Equal.read(f"at({_BEND}, s=-1)", "-nu - (1 - nu)*eta**2"),
    Equal.read(f"at({_SEPARATION}, eta=237/1000)", "56169/(943831*nu)"),
)

# -- theorems --------------------------------------------------------------------------------------


@theorem(HALF, _TWICE, LAUNCH)
def rational() -> str:
    """Proof. With u = tan(t/(2 q)) the four functions of time in (10) are polynomials in u, of
    degree <= 2 N, over (1 + u^2)^N; the double zero at t = 0 (LAUNCH) is u^2. HALF and _TWICE are
    divided by the square of the cosine, 0 at a zero only if 1 + L = 0 or L = 0.
    """
    return (
        "For rational eta = m/q, N = max(m, q), the left side of (10) is u^2 times a polynomial of "
        "degree <= 2 N - 2 in u = tan(t/(2 q)), divided by (1 + u^2)^N, t = psi_(k+1) - psi_k: one "
        "of degree <= 4, solved by radicals, at eta = 1/3, 1/2, 2/3, 3/2, 2 and 3. Let L = nu sin "
        "psi_k, R = nu cos psi_k. At eta = 1/2, where 1 + L is not 0, its zeros with 0 < t < 4 pi "
        "are t = 4 arctan u, + 4 pi if u < 0, for the real u not 0 among (2 R +- sqrt(4 R^2 - (1 + "
        "L) (1 - 3 L)))/(1 + L). At eta = 2, where L is not 0, its zeros with 0 < t < 2 pi are t = "
        "2 arctan u, + 2 pi if u < 0, for the real u not 0 among (R +- sqrt(R^2 + L (4 + 3 L)))/L."
    )


@theorem(
    *_IMPACT,
    _FORCE,
    tex=r"\operatorname{sign}(\nu) \tfrac{1}{2} (\nu (1 - \eta^2) \sin\phi - \eta^2) t^2 + O(t^3)",
)
def sticking() -> str:
    """Proof. 1. The gap is sign(nu) times the left side of (10), in units of |p|: LAUNCH. The sign
    of its first term decides; where that is negative the table pushes, by _FORCE. 2. Where A = 0 =
    cos(phi), the fourth derivative is -sign(nu) eta^2, and the velocities are as said: _IMPACT.
    """
    return (
        "Let A = nu (1 - eta^2) sin phi - eta^2, beta > 0, so that p > 0 exactly if nu < 0. A mass "
        "that rests on the table is pressed on it by the force m p omega^2 A, as long as that is "
        ">= 0. After a plastic impact at the phase phi the relative velocity is 0, and the gap "
        "grows, in units of |p|, by sign(nu) (A t^2/2 + nu (1 - eta^2) cos(phi) t^3/6 + (eta^4 (1 "
        "+ nu sin phi) - nu sin phi) t^4/24 + O(t^5)): the mass sticks if sign(nu) A < 0, and "
        "leaves at once if sign(nu) A > 0. Where A = 0, it sticks if (1 - eta^2) cos(phi) < 0, and "
        "leaves if (1 - eta^2) cos(phi) > 0; where cos(phi) = 0 too, it sticks if nu > 0, and "
        "leaves if nu < 0. After an impact with epsilon > 0 the relative velocity is -epsilon "
        "times the one before: the mass leaves at once, unless that is 0, and then the rule for "
        "plastic impacts decides. A flight ends with a relative velocity <= 0: that it is < 0 does "
        "not make an impact stick."
    )


@theorem(sticking, *_EQUATION, tex=r"\sin\phi_s = \frac{\eta^2}{\nu (1 - \eta^2)}")
def separation() -> str:
    """Proof. 1. The printed equation says A = 0: _EQUATION. 2. The mass leaves where p A goes from
    >= 0 to < 0 (`sticking`), and A' = nu (1 - eta^2) cos(phi): _EQUATION.
    """
    return (
        "If eta is not 1 and |eta^2/(nu (1 - eta^2))| < 1, the formula gives two phases: the mass "
        "separates at the one with (1 - eta^2) cos(phi) > 0, beta > 0, and sticking begins at the "
        "other. So phi_s lies in (3 pi/2, 2 pi) if nu < 0 and eta < 1, in (pi/2, pi) if nu < 0 and "
        "eta > 1, in (0, pi/2) if nu > 0 and eta < 1, in (pi, 3 pi/2) if nu > 0 and eta > 1. "
        "Otherwise there is no separation phase: after a plastic impact the mass never sticks if "
        "nu < 0, and never leaves if nu > 0."
    )


@theorem(separation, *_EXTREMES)
def rest() -> str:
    """Proof. 1. A is affine in sin(phi), and -eta^2 at the phase 0, so for nu < 0 the mass leaves.
    2. For nu > 0 the table pushes always if A <= 0 at sin(phi) = 1 and -1: _EXTREMES; at a phase
    where A = 0 then, cos(phi) = 0, the mass stays by `sticking`.
    """
    return (
        "After a plastic impact (beta > 0) the mass separates within one turn if nu < 0, or if "
        "nu |1 - eta^2| > eta^2. If nu > 0 and nu |1 - eta^2| <= eta^2, it stays on the table for "
        "ever after its first plastic impact, and f is not defined at any phase. For 0 < nu <= 1 "
        "that is so exactly if eta^2 >= nu/(1 + nu): for nu = 0.2 (figure 7a) if eta^2 >= 1/6, "
        "that is for all eta >= 0.4083; for eta = 0.237 (figure 7b) if 0 < nu <= 56169/943831, "
        "that is up to nu = 0.0595."
    )


@theorem(_TOP, tex=r"|\nu| (1 - \cos t) + (1 - |\nu|) (1 - \cos \eta t)")
def unending() -> str:
    """Proof. For nu < 0 the gap is minus the left side of (10), in units of |p|: by _TOP it is at
    psi = pi/2 a sum of two terms >= 0, as -nu > 0 and 1 + nu > 0, and 0 only where both are: where
    t = 2 pi k and eta t = 2 pi m with whole k, m. For k not 0 then eta = m/k.
    """
    return (
        "For -1 < nu < 0 and every irrational eta > 0 there is no impact after a launch at the "
        "phase pi/2, and no touch: f is not defined there, whatever counts as an impact, and does "
        "not map [0, 2 pi) into itself. For -1 < nu < 0 and eta > 0 the gap at the time t after "
        "that launch is |nu| (1 - cos t) + (1 - |nu|) (1 - cos(eta t)), in units of |p|, and > 0 "
        "but for the t at which t and eta t are both multiples of 2 pi: for irrational eta that is "
        "t = 0 alone, for eta = p/q in lowest terms the multiples of 2 pi q."
    )


# -- the rows --------------------------------------------------------------------------------------

ROWS = (
    derived_row(
        Passage("M1", "2, (1)-(3)", "The solution to this differential equation"),
        "Free flight: (2) and (3) solve x'' + omega_n^2 x = 0, (1), with x = x_o and x' = x'_o at "
        "t = t_0.",
        Verdict.VERIFIED,
        corollary(
            "(2) solves (1), (3) is its derivative, both have the initial values; the difference d "
            "of two solutions has d'^2 + omega_n^2 d^2 constant, so 0: there is no other.",
            *_FLIGHT,
        ),
    ),
    derived_row(
        Passage(
            "M2", "2, (4)-(5)", "is obtained from the definition of coefficient of restitution"
        ),
        "The launch: (4) is the position of the table, and (5) follows from the coefficient of "
        "restitution.",
        Verdict.VERIFIED,
        corollary(
            "(4) is z(t_k), and with (5) minus the ratio of the relative velocities is epsilon; "
            "v_k is the velocity, with its sign, not the speed.",
            *_LAUNCH,
        ),
    ),
    derived_row(
        Passage("M3", "2, (8)-(9), (14)-(15)", "we obtain the following equations"),
        "The impact relations (8), (9) follow from (2)-(7), and (14), (15) from them with psi = "
        "omega t, nu = -beta/p, eta = omega_n/omega, gamma = v/(omega_n p).",
        Verdict.VERIFIED,
        corollary(
            "(8) is (2) minus the table, (9) is (3), at t_(k+1); (8) is -p times (14), (9) is "
            "omega_n p times (15); psi_(k+1) is the first zero after psi_k at which the mass comes "
            "from above.",
            *_FLIGHT,
            *_LAUNCH,
            *_RELATIONS,
        ),
    ),
    derived_row(
        Passage("M4", "2, (10)", "the following equation for the plastic case"),
        "For plastic impacts, epsilon = 0, the nondimensional relation is (10).",
        Verdict.VERIFIED,
        corollary("(10) is (14) at epsilon = 0, (8) there divided by -p.", *_PLASTIC),
    ),
    derived_row(
        Passage("M5", "2, after (9)", "transcendental and therefore cannot be solved"),
        "The impact relations are transcendental and cannot be solved in closed form, whatever the "
        "frequency ratio.",
        Verdict.REFUTED,
        closed_form,
        corrected=(rational,),
    ),
    derived_row(
        Passage("M7", "2, sticking", "The sticking happens when the relative velocity"),
        "The mass sticks to the table exactly when the relative velocity x' - z' is negative at "
        "the instant of impact.",
        Verdict.REFUTED,
        corollary(
            "At (eta, nu) = (1/2, -1/2), after plastic impacts at the phases 1 and 5, both with a "
            "relative velocity of -1 (any negative number) before, it is 0, and the mass leaves at "
            "once with the relative acceleration {0} after the first, and is pressed on the table, "
            "{1}, after the second. For epsilon > 0 no impact with a negative one sticks.",
            sticking,
            values=(
                at(f"-{BEND}", 1, eta="1/2", nu="-1/2", psi="1"),
                at(f"-{BEND}", -1, eta="1/2", nu="-1/2", psi="5"),
            ),
        ),
        corrected=(sticking,),
    ),
    derived_row(
        Passage("M8", "2, phi_s", "the phase at separation"),
        "sin(phi_s) = eta^2/(nu (1 - eta^2)), from -(nu/eta^2) sin(phi_s) = -1 - nu sin(phi_s), "
        "gives the phase at which a sticking mass separates.",
        Verdict.CONDITIONAL,
        separation,
        corrected=(sticking,),
    ),
    derived_row(
        Passage("M9", "2, after (9)", "the mass and the table eventually separate"),
        "After a plastic impact mass and table always separate eventually, beta > 0.",
        Verdict.CONDITIONAL,
        rest,
        corollary(
            "At (eta, nu) = (1/2, 1/10), beta > 0 > p, the acceleration of a free mass relative to "
            "the table it rests on is 3/40 sin phi - 1/4 <= -7/40 < 0 at every phase phi: after a "
            "plastic impact the mass stays on the table for ever.",
            _FORCE,
            Equal.read(f"at({_BEND}, eta=1/2, nu=1/10)", "3/40*s - 1/4"),
        ),
        corrected=(rest,),
    ),
)
