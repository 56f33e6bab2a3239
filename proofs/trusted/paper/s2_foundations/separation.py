"""Section 2: M7 to M9, when the mass sticks to the table, and when it leaves."""

from __future__ import annotations

from proofs.trusted.numbers import Range, between
from proofs.trusted.paper import Decision
from proofs.trusted.paper.formulas import Derivation, Equal, Series, at, over
from proofs.trusted.paper.s2_foundations import displayed as eq
from proofs.trusted.paper.s5_soft.displayed import SPEED5
from proofs.trusted.verdicts import Verdict

_BEND = f"at({eq.BEND}, s=sin(psi))"
LAUNCH = Series(
    eq.PLASTIC,
    "t",
    ("0", "0", f"{_BEND}/2", f"{eq.JERK}/6", f"at({eq.SNAP}, s=sin(psi))/24"),
    ("eta",),
)
_FORCE = Equal(f"at({eq.PULL} - ({eq.PUSH}), {eq.RATIOS})", f"p*omega**2*{eq.BEND}")
_ZERO = Equal(f"at({eq.BEND}, s={eq.SEPARATION})", "0")
_RISES = Equal(f"D({_BEND}, psi)", eq.JERK)
_STICKS = (
    Equal(f"at({SPEED5}, epsilon=0) - beta*omega*cos(a)", "0"),
    Equal(
        "at(v - beta*omega*cos(a), beta=-nu*p, v=eta*omega*p*gamma, a=psi)",
        f"p*omega*{eq.CLOSING}",
    ),
    Series(eq.REBOUND, "t", ("0", f"epsilon*{eq.CLOSING}"), ("eta",)),
    LAUNCH,
    _FORCE,
    Equal(f"at({eq.SNAP}, s={eq.SEPARATION})", "-eta**2"),
)
_EQUATION = (
    Equal(f"at({eq.PULL}, beta=-nu*p)", f"-(eta*omega)**2*p*({eq.TABLE_SCALED})"),
    Equal(f"at({eq.PUSH}, {eq.RATIOS})", f"-(eta*omega)**2*p*({eq.MASS_SCALED})"),
    _FORCE,
    _ZERO,
    Equal(eq.BEND, f"nu*(1 - eta**2)*(s - {eq.SEPARATION})"),
    Equal(f"at({eq.BEND}, eta=1)", "-1"),
    _RISES,
    Equal(f"at({eq.SNAP}, s={eq.SEPARATION})", "-eta**2"),
    LAUNCH,
)
_PRESSED = (
    *_EQUATION,
    Equal(f"at({eq.BEND}, eta=1/2, nu=1/10)", "3/40*s - 1/4"),
    Equal(f"at({eq.BEND}, s=0)", "-eta**2"),
    Equal(f"at({eq.BEND}, s=1)", "(1 + nu)*(nu/(1 + nu) - eta**2)"),
    Equal(f"at({eq.BEND}, s=-1)", "-nu - (1 - nu)*eta**2"),
    Equal(f"at({eq.SEPARATION}, eta=237/1000)", "56169/(943831*nu)"),
)

_A = "A(phi) = nu (1 - eta^2) sin phi - eta^2"
_FREE = (
    f"Let {_A}, beta > 0, so that p > 0 exactly if nu < 0. A mass that rests on the table is "
    "pressed on it by the force m p omega^2 A(phi), as long as that is >= 0"
)


def _sticking(leaves: Range, sticks: Range) -> Decision:
    """Decide M7.

    X - Z is the left side of (10), (14), in units of -p, and x - z > 0 is sign(nu) (X - Z) > 0: so
    the sign of the first term of its series decides, and where that is negative the table pushes.
    """
    return Decision(
        Verdict.REFUTED,
        "after every plastic impact the relative velocity is 0, before every impact it is <= 0; "
        "what decides is the relative acceleration",
        witness="(eta, nu) = (1/2, -1/2), plastic impacts at the phases 1 and 5, both with the "
        "same relative velocity -1 (any negative number) before: after them it is 0, and the mass "
        f"leaves the table at once with the relative acceleration {between(leaves)} after the "
        f"first, and is pressed on it, {between(sticks)}, after the second. For epsilon > 0 no "
        "impact with a negative relative velocity sticks.",
        corrected=f"{_FREE}. After a plastic impact at phase phi the relative velocity is 0, and "
        "the distance between mass and table grows, in units of |p|, by sign(nu) (A(phi) t^2/2 + "
        "nu (1 - eta^2) cos(phi) t^3/6 + (eta^4 (1 + nu sin phi) - nu sin phi) t^4/24 + O(t^5)). "
        "So the mass sticks if sign(nu) A(phi) < 0, and leaves at once if sign(nu) A(phi) > 0. "
        "Where A(phi) = 0, it sticks if (1 - eta^2) cos(phi) < 0, and leaves if (1 - eta^2) "
        "cos(phi) > 0; where cos(phi) = 0 too, the last term is -sign(nu) eta^2 t^4/24: it sticks "
        "if nu > 0, and leaves if nu < 0. After an impact with epsilon > 0 the relative velocity "
        "is -epsilon times the one before: the mass leaves at once, unless that is 0, and then "
        "the rule for plastic impacts decides. A flight ends with a relative velocity <= 0, so a "
        "negative one is necessary for a plastic impact to stick where sign(nu) A < 0, but not "
        "sufficient.",
    )


def _separation() -> Decision:
    """Decide M8. The mass leaves where p A(phi) goes from >= 0 to < 0, A rising as JERK says."""
    return Decision(
        Verdict.CONDITIONAL,
        "the formula holds where there is a separation phase: eta is not 1, |eta^2/(nu (1 - "
        "eta^2))| < 1; of the two phases it is the one with (1 - eta^2) cos(phi_s) > 0",
        witness="conditions: eta is not 1, |eta^2/(nu (1 - eta^2))| < 1, and of the two phases "
        "with this sine the one with cos(phi_s) > 0 if eta < 1, cos(phi_s) < 0 if eta > 1; at the "
        "other one sticking begins",
        corrected=f"{_FREE}. If eta is not 1 and |eta^2/(nu (1 - eta^2))| < 1, A has two zeros on "
        "the circle, both with sin phi = eta^2/(nu (1 - eta^2)). The mass separates at the one "
        "with (1 - eta^2) cos(phi) > 0, at the other one sticking begins. So phi_s lies in "
        "(3 pi/2, 2 pi) if nu < 0 and eta < 1, in (pi/2, pi) if nu < 0 and eta > 1, in (0, pi/2) "
        "if nu > 0 and eta < 1, in (pi, 3 pi/2) if nu > 0 and eta > 1. Otherwise (eta = 1, or "
        "the quotient is at least 1 in size) there is no separation phase: after a plastic impact "
        "the mass never sticks if nu < 0, and never leaves if nu > 0.",
    )


def _forever(_: Range) -> Decision:
    """Decide M9. A is affine in sin(phi) and -eta^2 at sin(phi) = 0, so for nu < 0 it leaves.

    For nu > 0 the table pushes always if A <= 0 for sin(phi) = 1 and -1; at a phase where A = 0
    then, cos(phi) = 0, the mass stays by the fourth derivative (see M7).
    """
    return Decision(
        Verdict.REFUTED,
        "not for (eta, nu) = (1/2, 1/10): the table pushes at every phase; true for nu < 0, that "
        "is p > 0, and for nu > 0 exactly if nu |1 - eta^2| > eta^2",
        witness="(eta, nu) = (1/2, 1/10), so p < 0: the acceleration of a free mass relative to "
        "the table it rests on is 3/40 sin phi - 1/4 <= -7/40 < 0 at every phase phi: after a "
        "plastic impact the mass stays on the table forever",
        corrected=f"{_FREE}. If nu < 0, A = -eta^2 < 0 at the phase 0: after a plastic impact the "
        "mass separates within one turn of the table. If nu > 0, it separates within one turn if "
        "nu |1 - eta^2| > eta^2; if nu |1 - eta^2| <= eta^2, it stays on the table forever after "
        "its first plastic impact, and f is not defined at any phase. For 0 < nu <= 1 that is so "
        "exactly if eta^2 >= nu/(1 + nu): for nu = 0.2 (figure 7a) if eta^2 >= 1/6, that is for "
        "all eta >= 0.4083; for eta = 0.237 (figure 7b) if 0 < nu <= 56169/943831, that is up to "
        "nu = 0.0595.",
    )


SEPARATIONS = (
    Derivation(
        "M7",
        "The mass sticks to the table exactly when the relative velocity x' - z' is negative at "
        "the instant of impact.",
        _STICKS,
        _sticking,
        (
            at(f"-at({eq.BEND}, s=sin(psi))", 1, eta="1/2", nu="-1/2", psi="1"),
            at(f"-at({eq.BEND}, s=sin(psi))", -1, eta="1/2", nu="-1/2", psi="5"),
        ),
    ),
    Derivation(
        "M8",
        "sin(phi_s) = eta^2/(nu (1 - eta^2)), from -(nu/eta^2) sin(phi_s) = -1 - nu sin(phi_s), "
        "gives the phase at which a sticking mass separates.",
        _EQUATION,
        _separation,
    ),
    Derivation(
        "M9",
        "After a plastic impact mass and table always separate eventually.",
        _PRESSED,
        _forever,
        (over(f"at({eq.BEND}, eta=1/2, nu=1/10)", -1, "s", ("-1", "1")),),
    ),
)
