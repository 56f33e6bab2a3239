"""Section 4: single-impact periodic orbits, as printed and as they are. Claims P1 to P6.

In formulas a, b stand for psi_k, psi_(k+1), delta for their difference, n for the number of table
periods, theta for the angle of (17). E10 is the left side of (10) and so on; (18) is
TOP18/BOTTOM18.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper.formulas import Derived, Equal, Passage, Theorem, derived_row, theorem
from proofs.trusted.paper.s4_single.orbits import Solution
from proofs.trusted.paper.s4_single.windows import EtaWindows, NuWindows
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

FIGURE_NU, FIGURE_ETAS = Fraction("0.2"), (Fraction("0.01"), Fraction(14))
FIGURE_ETA, FIGURE_NUS = Fraction("0.237"), (Fraction("-0.9"), Fraction("0.9"))

X = "(pi*n*eta)"
E10 = "(1 + nu*sin(a))*cos(eta*delta) + nu/eta*cos(a)*sin(eta*delta) - 1 - nu*sin(b)"
E16 = "(1 + nu*sin(phi))*cos(2*pi*n*eta) + nu/eta*cos(phi)*sin(2*pi*n*eta) - 1 - nu*sin(phi)"
ALPHA, BETA = "eta*(1 - cos(2*pi*n*eta))", "sin(2*pi*n*eta)"
LINEAR = "alpha*sin(phi) - beta*cos(phi) + alpha/nu"
E17 = "sin(phi - theta) + cos(theta)/nu"
TOP18 = "nu/eta*sin(phi)*sin(2*pi*n*eta) - eta*(1 + nu*sin(phi))*sin(2*pi*n*eta)"
BOTTOM18 = "-eta*(1 + nu*sin(phi))*sin(2*pi*n*eta) + nu*cos(phi)*cos(2*pi*n*eta) - nu*cos(phi)"
DEFECT = f"(nu*cos(phi)*cos{X} - eta*(1 + nu*sin(phi))*sin{X})"
LAUNCH = "(nu*sin(phi) - eta**2*(1 + nu*sin(phi)))"
_HEIGHT = "(eta**2*(1 + nu*sin(phi)))"
_AT = "a=phi, b=phi, delta=2*pi*n"

NECESSARY = (
    Equal.read(f"at({E10}, {_AT})", E16),
    Equal.read(E16, f"2/eta*sin{X}*{DEFECT}"),
)
ANGLE = (
    Equal.read(E16, f"-nu/eta*at({LINEAR}, alpha={ALPHA}, beta={BETA})"),
    Equal.read(f"at({LINEAR}, alpha=r*cos(theta), beta=r*sin(theta))", f"r*({E17})"),
    Equal.read(f"({BETA})/({ALPHA})", f"cos{X}/(eta*sin{X})"),
)
SLOPE = (
    Equal.read(f"at(-D({E10}, a) + D({E10}, delta), {_AT})", TOP18),
    Equal.read(f"at(D({E10}, b) + D({E10}, delta), {_AT})", BOTTOM18),
    Equal.read(BOTTOM18, f"-2*nu*cos(phi) + 2*cos{X}*{DEFECT}"),
    Equal.read(
        f"({TOP18}) - 2*nu*cos(phi)*cos{X}**2*{LAUNCH}/{_HEIGHT}",
        f"-2*cos{X}*{LAUNCH}/{_HEIGHT}*{DEFECT}",
    ),
)
FLIGHT = (
    Equal.read(
        "cos(2*eta*y) - 1 + tan*sin(2*eta*y) + eta**2*(1 - cos(2*y)) - eta*tan*sin(2*y)",
        "2*(tan*(sin(eta*y)*cos(eta*y) - eta*sin(y)*cos(y)) - sin(eta*y)**2 + eta**2*sin(y)**2)",
    ),
)
LEMMAS = (*NECESSARY, *ANGLE, *SLOPE, *FLIGHT)


# -- theorems --------------------------------------------------------------------------------------


@theorem(*NECESSARY)
def necessary() -> str:
    """NECESSARY: (16) is (10) with b = a = phi, delta = 2 pi n, and its factors."""
    return (
        "(10) with psi_(k+1) = psi_k + 2 pi n is (16), which is necessary for an orbit with an "
        "impact every n table periods after which the mass leaves the table at once (after one "
        "that sticks the flight starts at phi_s instead). With x = pi n eta it is (2/eta) sin(x) "
        "(nu cos(phi) cos(x) - eta (1 + nu sin(phi)) sin(x)) = 0: all phases satisfy it if n eta "
        "is an integer."
    )


@theorem(*NECESSARY, *ANGLE)
def solved() -> str:
    """1. alpha = 2 eta sin(pi n eta)^2 > 0 unless n eta is an integer; then alpha = r cos(theta),
    beta = r sin(theta) with r > 0 and cos(theta) > 0, tan(theta) = beta/alpha, and by ANGLE (16) is
    -(nu/eta) r times (17). 2. (17) says that sin(phi - theta) = -cos(theta)/nu, which two phases
    solve, one, or none. 3. At an integer n eta the factor sin(pi n eta) of (16) is 0 (NECESSARY),
    and so are alpha and beta.
    """
    return (
        "(17) is (16) unless n eta is an integer, n >= 1: then, for example at eta = n = 1, alpha "
        "= beta = 0, so that theta is not defined, while every phase satisfies (16). Else, with "
        "theta in (-pi/2, pi/2), tan(theta) = cot(pi n eta)/eta, (17) is equivalent to (16). If "
        "cos(theta) > |nu| "
        "no phase solves it, else phi_1 = theta - asin(cos(theta)/nu) and phi_2 = theta + pi + "
        "asin(cos(theta)/nu) do (mod 2 pi), and no others; they coincide if cos(theta) = |nu|."
    )


_TRUE_SLOPE = "cos^2(pi n eta) (1 - nu sin(phi)/(eta^2 (1 + nu sin(phi))))"


@theorem(*SLOPE)
def slope() -> str:
    """1. A mass that leaves the table at once flies by (10) for all launches nearby, and where the
    first impact is transversal, the implicit function theorem gives db/da = (D_delta - D_a) /
    (D_delta + D_b) of (10): SLOPE, first and second. 2. Where K = 0, the third and the fourth.
    """
    return (
        "Where the mass leaves the table at once (launch acceleration > 0) and the first impact "
        "after phi is 2 pi n later and transversal, f'(phi) is (18). If (16) holds and n eta is no "
        "integer, the denominator of (18) is -2 nu cos(phi), and where that and 1 + nu sin(phi) "
        f"are not 0, (18) equals {_TRUE_SLOPE}."
    )


@theorem(*LEMMAS)
def orbits() -> str:
    """Lemmas 1 to 3 of `orbits.py`: 1. (16), the multiplier M and where it is 1, 0, -1 (lemma
    1). 2. Which n are possible (lemma 2), and that for the others stated nothing is hit before
    (lemma 3). 3. Leaving at once is side (p - eta^2) > 0, which gives the sign of M; on p > -e,
    A(p) = nu^2 grows, so that M < 1, the launch and M > -1 are bounds on nu^2.
    """
    return (
        "Let 0 < |nu| < 1, and beta > 0, so nu > 0 if p < 0 (for beta < 0 replace nu, phi by -nu, "
        "phi + pi). An orbit that leaves the table at once, at phi, with launch acceleration > 0, "
        "with its first impact, a transversal one, 2 pi n later, exists exactly if phi solves "
        "(16), n eta is no integer, side (nu (1 - eta^2) sin(phi) - eta^2) > 0, side the sign of "
        "nu, and nothing is hit before. The last is so for nu > 0 if n eta < 1/2, and only then; "
        "for nu < 0 if 1/2 < n eta < 1, and only if {n eta} > 1/2 and 0 < {l eta} < {n eta} for "
        "0 < l < n, {} being fractional parts. The slope is M = "
        f"{_TRUE_SLOPE}, < 0 for nu > 0 and > 0 for nu < 0; the orbit is stable if |M| < 1, "
        "unstable if |M| > 1, and only phi = theta - asin(cos(theta)/nu), tan(theta) = "
        "cot(pi n eta)/eta, can be stable: with e = (eta tan(pi n eta))^2, A(p) = (p^2 + e)/"
        "(1 - p)^2 and q = eta^2 (1 + 1/cos^2(pi n eta)), if n eta < 1/2, nu > 0, it is exactly if "
        "A(eta^2) < nu^2 and nu^2 (1 - q)^2 < q^2 + e; if 1/2 < n eta < 1, nu < 0, exactly if "
        "e/(1 + e) < nu^2 < A(eta^2)."
    )


# -- rows ------------------------------------------------------------------------------------------


def _proved(found: Found, *theorems: Derived) -> list[Theorem]:
    proved = [known for each in theorems if (known := each.prove(found)) is not None]
    if len(proved) < len(theorems):
        raise Unproved("the theorems about orbits are not all proved")
    return proved


def _counterexample(found: Found, asked: Callable[[Solution], bool]) -> Solution:
    """Return a solution with |slope| < 1, of those asked for: they are no orbits."""
    for each in found.elsewhere(Solution):
        if each.contracts and asked(each):
            return each
    raise Unproved("not proved: solutions of (16) that are no orbits")


def _stability(_: Parameters, found: Found) -> Decision:
    """P4: a solution with |slope| < 1 that does not stick and is no orbit; orbits that are. It
    asks about no range: true where 2 pi n later there is the first impact.
    """
    hits = _counterexample(found, lambda x: x.hits)
    nearby = [*_proved(found, solved, orbits), *(x for x in found.all(Solution) if x.first)]
    bounds = {"slope_no_orbit": hits.multiplier}
    return decided(Verdict.CONDITIONAL, hits, corrected=nearby, known=bounds)


def _figure_a(_: Parameters, found: Found) -> Decision:
    """P5: the windows, for both signs of p, and solutions outside: for p < 0 one that sticks, for
    p > 0 one that hits. A claim about the axis of a figure that fails inside of it is REFUTED.
    """

    def shown(one: Solution, nu: Fraction) -> bool:
        return one.at.nu[0] == nu and FIGURE_ETAS[0] < one.at.eta[0] < FIGURE_ETAS[1]

    stuck = _counterexample(found, lambda x: x.sticks and shown(x, FIGURE_NU))
    hits = _counterexample(found, lambda x: x.hits and shown(x, -FIGURE_NU))
    known, asked = _proved(found, orbits), (FIGURE_NU, FIGURE_ETAS[0])
    windows = {x.nu: x for x in found.all(EtaWindows) if (abs(x.nu), x.low) == asked}
    if len(windows) < 2:
        return undecided("no proof of all windows in eta, for both signs of p")
    both = windows[FIGURE_NU], windows[-FIGURE_NU]
    return decided(Verdict.REFUTED, stuck, hits, corrected=[*known, *both])


def _figure_b(_: Parameters, found: Found) -> Decision:
    """P6: the windows, all below |nu| = 0.9, and a solution that is no orbit: as P5."""
    (low, high), known = FIGURE_NUS, _proved(found, orbits)
    hits = _counterexample(
        found, lambda x: x.hits and x.at.eta[0] == FIGURE_ETA and low < x.at.nu[0] < high
    )
    for windows in found.all(NuWindows):
        ends = [last[1] for _, _, last in (*windows.above, *windows.below)]
        if windows.eta == FIGURE_ETA and all(end < high for end in ends):
            return decided(Verdict.REFUTED, hits, corrected=[*known, windows])
    return undecided("no proof of all windows in nu, and that they end before |nu| = 0.9")


ROWS = (
    derived_row(
        Passage("P1", "4, (16)", "of the map is given by"),
        "The fixed points with n table periods between impacts, where the mass leaves the table at "
        "once, satisfy (16), which is (10) with psi_(k+1) - psi_k = 2 pi n.",
        Verdict.VERIFIED,
        necessary,
        corrected=(necessary,),
    ),
    derived_row(
        Passage("P2", "4, (17)", "Equation (16) can be rewritten as"),
        "(16) can be rewritten as (17), sin(phi - theta) + cos(theta)/nu = 0, with theta = "
        "atan(beta/alpha), alpha = eta (1 - cos(2 pi n eta)), beta = sin(2 pi n eta).",
        Verdict.CONDITIONAL,
        solved,
        corrected=(solved,),
    ),
    derived_row(
        Passage("P3", "4, (18)", "The slope is given by"),
        "At these fixed points, where the mass leaves the table at once, the slope of f is (18).",
        Verdict.VERIFIED,
        slope,
        corrected=(slope,),
    ),
    Row(
        "P4",
        "4, after (17)",
        "stability of these fixed points can be determined",
        "A fixed point given by (17), with a launch that does not stick, is stable if |slope| < 1.",
        _stability,
        needs=orbits.needs,
    ),
    Row(
        "P5",
        "4, Figure 7a",
        "the various stable n-periodic fixed points",
        "Figure 7a: for nu = 0.2 the solutions of (16) with |slope| < 1 are stable n-periodic "
        "fixed points, at which the mass leaves the table at once, over eta in (0.01, 14).",
        _figure_a,
        needs=orbits.needs,
    ),
    Row(
        "P6",
        "4, Figure 7b",
        "fixed points vary as we change",
        "Figure 7b: for eta = 0.237 the solutions of (16) with |slope| < 1 are stable n-periodic "
        "fixed points, at which the mass leaves the table at once, over nu in (-0.9, 0.9).",
        _figure_b,
        needs=orbits.needs,
    ),
)
