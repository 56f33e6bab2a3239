"""Curves of folds and flips of single-impact orbits in the plane of eta and nu; rows C1 to C4.

In formulas a, b stand for psi_k, psi_(k+1), delta for their difference, z for a multiplier.
"""

from __future__ import annotations

from collections.abc import Sequence

from proofs.trusted.paper.beyond.grazing import GrazingCurve
from proofs.trusted.paper.beyond.meetings import Meeting
from proofs.trusted.paper.formulas import Equal, Passage, derived_row, theorem
from proofs.trusted.paper.s2_foundations import S14, S15
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

X = "(pi*n*eta)"
SPEED = "(epsilon*eta*gamma + (1 + epsilon)*nu*cos(a))"  # of the mass after an impact
E14 = f"(1 + nu*sin(a))*cos(eta*delta) + {SPEED}/eta*sin(eta*delta) - 1 - nu*sin(b)"
E15 = f"(1 + nu*sin(a))*sin(eta*delta) - {SPEED}/eta*cos(eta*delta)"
_REPEATED = "a=phi, b=phi, delta=2*pi*n"
_LAUNCHED = f"at({SPEED}, a=phi)"
_HALFWAY = f"({_LAUNCHED}*cos{X} - eta*(1 + nu*sin(phi))*sin{X})"
GAMMA = "(1 + epsilon)/(1 - epsilon)*nu*cos(phi)/eta"
NU = f"(1 - epsilon)*eta*sin{X}/((1 + epsilon)*cos(phi)*cos{X} - (1 - epsilon)*eta*sin{X}*sin(phi))"
TRACE = (
    f"(cos{X}**2*((1 - epsilon)**2 - (1 + epsilon)**2*nu*sin(phi)/(1 + nu*sin(phi))/eta**2)"
    " + 2*epsilon)"
)
_MATRIX = (
    f"z*(D({E14}, b) + D({E14}, delta)) + D({E14}, a) - D({E14}, delta)",
    f"D({E14}, gamma)",
    f"-z*D({E15}, delta) - D({E15}, a) + D({E15}, delta)",
    f"z - D({E15}, gamma)",
)
_DETERMINANT = f"({_MATRIX[0]})*({_MATRIX[3]}) - {_MATRIX[1]}*({_MATRIX[2]})"

REPEATED = (
    Equal.read(f"at({E14}, a=psi, b=psi1, delta=psi1 - psi)", S14),
    Equal.read(f"at({E15}, a=psi, b=psi1, delta=psi1 - psi)", S15),
    Equal.read(f"at({E14}, {_REPEATED})", f"2/eta*sin{X}*{_HALFWAY}"),
    Equal.read(f"at({E15}, {_REPEATED}) - {_LAUNCHED}/eta", f"-2/eta*cos{X}*{_HALFWAY}"),
)
MULTIPLIERS = Equal.read(
    f"at(at({_DETERMINANT}, {_REPEATED}, gamma={GAMMA}), nu={NU})",
    f"at(-2/(1 - epsilon)*nu*cos(phi)*(z**2 - z*{TRACE} + epsilon**2), nu={NU})",
)
LEAST = Equal.read(
    "D((p**2 + q**2*e)/(1 - p)**2, p)",
    "2*(p + q**2*e)/(1 - p)**3",
)


@theorem(*REPEATED, MULTIPLIERS, LEAST)
def curves() -> str:
    """1. With s, c = sin x, cos x, W the velocity of the mass after the impact and r = nu cos(phi),
    REPEATED says: (14) repeats the phase exactly if s (W c - eta h s) = 0, and then (15) gives
    gamma = W/eta; W = epsilon eta gamma + (1 + epsilon) r, so W = r/q. As s != 0, r c = q eta h s,
    and c != 0 since h > 0. With h = 1/(1 - p), nu^2 = (nu sin(phi))^2 + r^2 is A(p). 2. gap' = -2
    side W/(1 + epsilon) before the impact (by -W - r): side r > 0, and r has the sign of tan x.
    3. The equations (14), (15) define the map by G(x, y) = 0, so its derivative Y has det(z - Y) =
    det(z G_y + G_x)/det(G_y): MULTIPLIERS, where the z^2 has the factor det(G_y), not 0.
    4. epsilon^2 < 1: both roots are inside the unit circle exactly if |tr| < 1 + epsilon^2 (Jury);
    one is 1 or -1 exactly if tr = 1 + epsilon^2, -1 - epsilon^2, and roots that are not real have
    the modulus epsilon. tr falls with p, linearly. 5. LEAST: A falls up to p = -q^2 e, grows from
    there, and A'' > 0 there. A(p) -> 1 for p -> -oo, -> oo for p -> 1. 6. For epsilon = 0 the
    launch acceleration is side h (p - eta^2), and tr = 0 at p = eta^2. 7. As n eta tends to an
    integer, e and W = eta h tan x tend to 0; as n eta + 1/2 does, e and 1/cos^2 x to oo.
    """
    return (
        "Let 0 <= epsilon < 1, q = (1 - epsilon)/(1 + epsilon), n >= 1, 2 n eta no integer, e = "
        "(eta tan(pi n eta))^2, and of solutions of (14), (15) consider those with h = 1 + nu "
        "sin(phi) > 0 (all, if |nu| < 1); p = nu sin(phi)/h < 1. Phase and velocity are the same "
        "2 pi n later exactly if nu cos(phi) = q eta h tan(pi n eta), gamma = nu cos(phi)/(q eta); "
        "then nu^2 = A(p) = (p^2 + q^2 e)/(1 - p)^2. If the impact is transversal and from above "
        "the table, nu has the sign of tan(pi n eta), and cos(phi) > 0. If nothing is hit before, "
        "it is a periodic motion whose multipliers are the roots of z^2 - tr z + epsilon^2, tr = 2 "
        "epsilon + cos^2(pi n eta) ((1 - epsilon)^2 - (1 + epsilon)^2 p/eta^2): stable if -q^2 e < "
        "p < p_F = eta^2 (q^2 + 1/cos^2(pi n eta)), unstable if p is outside. In the plane of eta "
        "and nu, for one n, a multiplier is 1 exactly on nu^2 = q^2 e/(1 + q^2 e) (folds: p = -q^2 "
        "e, two solutions for greater |nu| < 1, none for smaller; A has a nondegenerate minimum "
        "there, so there is no cusp), and -1 exactly on nu^2 = A(p_F), where p_F < 1 (flips: the "
        "multiplier passes -1 with a speed other than 0 as nu changes). Both curves are graphs "
        "over eta and do not meet; no other multipliers come to the unit circle. For epsilon = 0 "
        "the mass leaves the table at once (launch acceleration > 0) exactly if p - eta^2 has the "
        "sign of nu; sticking begins at nu^2 = A(eta^2), where the multipliers are 0. The ends of "
        "these curves: as n eta tends to an integer, folds tend to nu = 0, flips to |nu| = "
        "p_F/(1 - p_F), p_F = eta^2 (1 + q^2), if that p_F is below 1, the onset of sticking to "
        "eta^2/(1 - eta^2), if eta < 1; at any fixed p the relative velocity at the impact to 0 "
        "(resonant grazing), and beyond nu has the other sign. As 2 n eta tends to an odd integer, "
        "folds tend to |nu| = 1, and p_F has passed 1, where |nu| grows without bound."
    )


NU_SEPARATING = "eta**2/((1 - eta**2)*sin(phi))"
_FALL = "(eta*cos(phi)/sin(phi)*cos(eta*tau) - sin(eta*tau))"
_LATER = f"a=phi, b=phi, delta=2*tau, epsilon=0, nu={NU_SEPARATING}"
_TABLE = f"at(nu*cos(phi), nu={NU_SEPARATING})"
AGAIN = (
    Equal.read(f"at({E14}, {_LATER})", f"2*sin(eta*tau)*{_FALL}/(1 - eta**2)"),
    Equal.read(f"eta*at({E15}, {_LATER}) - {_TABLE}", f"-2*eta*cos(eta*tau)*{_FALL}/(1 - eta**2)"),
)
ONSET = Equal.read(
    "at((p**2 + q**2*e)/(1 - p)**2, p=eta**2, q=1, e=(eta**2*cos(phi)/sin(phi))**2)",
    f"({NU_SEPARATING})**2",
)


@theorem(*AGAIN, ONSET)
def sticking() -> str:
    """Let r = nu cos(phi_s), side the sign of nu, c = eta cot(phi_s), T = eta tau. 1. The launch
    acceleration side (nu (1 - eta^2) sin(phi) - eta^2) is < 0 inside the arc, and 0 at its ends,
    where the sine is that of phi_s; it rises at phi_s. An impact on the arc sticks until phi_s,
    where the motion begins anew; others nearby stick as well. 2. By AGAIN the gap of the flight
    from phi_s, side times (14), at a time 2 tau when the sine is that of phi_s, is 2 side sin(T) (c
    cos(T) - sin(T))/(1 - eta^2). At pi - phi_s, where nu cos is -r, gap' = -side (eta gamma - r) =
    2 side eta cos(T) (c cos(T) - sin(T))/(1 - eta^2): 0 if tan(T) = c, 2 side r if sin(T) = 0. At
    phi_s, 2 side r less, it is 0 if sin(T) = 0, -2 side r if tan(T) = c. At a first impact gap' <=
    0, side r has the sign of 1 - eta^2, and gap'' is the launch acceleration. 3. A first impact
    inside the arc is transversal: else gap' = 0 > gap'' there, and gap < 0 before. So as long as
    there is no touch before, it stays the first one nearby, and the set is open. At its boundary,
    where there is an arc, the third derivative of the gap, > 0 at phi_s, keeps impacts away from
    time 0: limits are times <= 2 pi n with gap = 0 on the closed arc, gap >= 0 before; if there is
    no touch before, at an end of it. With e = (eta tan(pi n eta))^2 = (eta c)^2 ONSET is the curve
    of C1.
    """
    return (
        "Let epsilon = 0, |nu| |1 - eta^2| > eta^2, so that the mass sticks on an arc of phases "
        "from pi - phi_s to phi_s, mod 2 pi, sin(phi_s) = eta^2/(nu (1 - eta^2)), cos(phi_s) of "
        "the sign of 1 - eta^2. Where the flight from phi_s has its first impact inside this arc, "
        "and n turns after the flight began the arc ends, it is a superstable motion with one "
        "impact in n table periods. In the plane of eta and nu, for one n, these (eta, nu) are an "
        "open set. At its boundary the arc vanishes, |nu| |1 - eta^2| = eta^2 or eta = 1; or the "
        "flight touches the table before that impact (grazing); or the impact comes at an end of "
        "the arc: at phi_s, on nu^2 = (eta^4 + (eta tan(pi n eta))^2)/(1 - eta^2)^2, where sticking"
        " begins (C1), gap' = -2 |nu| cos(phi_s) and eta < 1, or where n eta is an integer, gap' = "
        "gap'' = 0; or at pi - phi_s, for some integer k, where eta (pi/2 - phi_s + pi k) is a "
        "multiple of pi, gap' = 2 |nu| cos(phi_s) and eta > 1, or on tan(eta (pi/2 - phi_s + pi k))"
        " = eta cot(phi_s), where gap' = gap'' = 0."
    )


def _about(known: Sequence[GrazingCurve | Meeting], missing: str) -> Decision:
    return decided(Verdict.VERIFIED, *known, corrected=known) if known else undecided(missing)


def _grazing(of: Parameters, found: Found) -> Decision:
    known = [each for each in found.all(GrazingCurve) if each.epsilon == of.epsilon]
    return _about(known, "no curve is proved")


def _meeting(of: Parameters, found: Found) -> Decision:
    known = [each for each in found.all(Meeting) if each.curve.epsilon == of.epsilon]
    return _about(known, "no point is proved")


ROWS = (
    derived_row(
        Passage("C1", "beyond", ""),
        "For orbits with one impact in n table periods and 0 <= epsilon < 1 the curves of folds "
        "and of flips in the plane of eta and nu have a closed form, as graphs over eta.",
        Verdict.VERIFIED,
        curves,
        corrected=(curves,),
    ),
    Row(
        "C2",
        "beyond",
        "",
        "For epsilon = {epsilon} there are curves in the plane of eta and nu on which an orbit "
        "with one impact in n table periods touches the table on its way (grazing): smooth graphs "
        "over intervals of eta, on one side of which it is an orbit and on the other it is not.",
        _grazing,
    ),
    Row(
        "C3",
        "beyond",
        "",
        "For epsilon = {epsilon} there are points in the plane of eta and nu where such a curve of "
        "grazing meets the curve of folds or that of flips.",
        _meeting,
    ),
    derived_row(
        Passage("C4", "beyond", ""),
        "For plastic impacts the curves in the plane of eta and nu on which orbits with one impact "
        "in n table periods and a sticking phase end, other than by grazing, have a closed form.",
        Verdict.VERIFIED,
        sticking,
        corrected=(sticking,),
    ),
)
