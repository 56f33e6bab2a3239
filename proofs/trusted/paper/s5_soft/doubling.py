"""Section 5, soft springs of any stiffness: orbits of period 2 near the flip."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import corollary, unknowns
from proofs.trusted.paper.s5_soft import near
from proofs.trusted.paper.s5_soft.theorems import STIFF

# Impacts at -h and h about a phase, by turns, with the velocities l(h) and l(-h); names as in
# `near`, r = (1 - epsilon)/(1 + epsilon). Near h = 0 rho times the sine and the cosine of that
# phase are a + a_2 h^2 and b + b_2 h^2.
_FLIGHT = (
    "x=-h, x1=h, epsilon=(1 - r)/(1 + r), C=(1 - t**2)/(1 + t**2), S=2*t/(1 + t**2), lam={0}, "
    "lam1=at({0}, h=-h)"
)
_VELOCITY = "(-t*B/k + l_1*h + l_2*h**2 + l_3*h**3)"
_SERIES = f"a=a + a_2*h**2, b=b + b_2*h**2, q=a - (B - 2)/k**2, {_FLIGHT.format(_VELOCITY)}"
SIDES = tuple(f"at({each}, {_SERIES})" for each in near.STIFF)
_D = "(1 - k**2*(1 + t**2 + r**2))"
_NONZERO = ("k", "t", "1 + t**2", "1 + r", _D)
_ZERO4 = ("0", "0", "0", "0")
_RISE = (
    "(3*r**2*t**2 + k**2*((1 + t**2)**2 + r**2*(1 + t**2)*(t**2 - 2) + 3*r**4*(1 - t**2))"
    " + k**4*((1 + t**2)**2*(3*t**2 - 1 + 5*r**2) + 3*r**4*(1 + t**2) - 3*r**6))"
)
RISE = f"B**2*{_RISE}/(3*k**2*{_D})"
LIMIT_RISE = "4*(3*r**2*(pi*m)**2 + 1 - 2*r**2 + 3*r**4)/3"
_POSITIVE = (
    "(1 - k**2)*(k**2*(1 - 2*r**2 + 3*r**4) + 3*r**2*t**2) + k**2*(3*k**2*r**2*(1 + 2*r**2 - r**4) "
    "+ t**2*(2 + 2*r**2 - 3*r**4)) + k**4*t**2*(1 + 10*r**2 + 3*r**4) + k**2*t**4*(1 + r**2)*(1 + "
    "5*k**2) + 3*k**4*t**6"
)

CYCLE = unknowns(
    "a b l_1 a_2 b_2 l_2 l_3",
    "k t r B",
    *(Series.read(side, "h", _ZERO4, _NONZERO) for side in SIDES),
    Equal.read("a", "B*(1 + t**2 + r**2)"),
    Equal.read("b", "r*t*B/k"),
    Equal.read("2*(a*a_2 + b*b_2)", RISE),
    nonzero=_NONZERO,
)

# The odd parts at h = 0 where the even ones vanish, b and l(0) being those of a fixed point.
_BEND = "(2 + k**2*(a - q))"
_FAMILY = f"b=r*t*{_BEND}/k, {_FLIGHT.format(f'(w*h - t*{_BEND}/k)')}"
_ODD = tuple(f"at(D(at({each}, {_FAMILY}), h), h=0)" for each in near.STIFF)
_REGULAR = (
    f"D({_ODD[0]}, a)*D({_ODD[1]}, w) - D({_ODD[0]}, w)*D({_ODD[1]}, a)",
    f"-4*t*{_D}/(k*(1 + r)*(1 + t**2))",
)

doubling = corollary(
    "For m >= 1, 0 <= epsilon < 1 and springs of any stiffness 0 < k = omega_n/omega < 1/(2 m), "
    "k^2 q < 2, q = 2 omega^2 p/g, every flip of a fixed point with lambda < 0, an orbit or not, "
    "is a supercritical period doubling. Let r = (1 - epsilon)/(1 + epsilon), t = tan(pi m k), c = "
    "2 pi m, A = 1 + t^2 + r^2. The fixed points of (24), (25) with lambda < 0 and flights over m "
    "periods have rho cos psi = r t B/k, lambda = -t B/k, B = 2 + k^2 (rho sin psi - q) > 0. One "
    "of them has the eigenvalue -1, the other being -epsilon^2, exactly if k^2 A < 1: at rho sin "
    "psi = A B, B = (2 - k^2 q)/(1 - k^2 A), where the trace falls as rho grows. For each small h, "
    "not 0, there is one motion with impacts at x - h and x + h by turns and flights of c + 2 h "
    "and c - 2 h; it has rho^2 = rho_F^2 + kappa h^2 + O(h^4), rho_F being the value of the flip, "
    "kappa = B^2 N/(3 k^2 (1 - k^2 A)), N = 3 r^2 t^2 + k^2 ((1 + t^2)^2 + r^2 (1 + t^2) (t^2 - 2) "
    "+ 3 r^4 (1 - t^2)) + k^4 ((1 + t^2)^2 (3 t^2 - 1 + 5 r^2) + 3 r^4 (1 + t^2) - 3 r^6) > 0. So "
    "orbits of period 2 are at rho > rho_F, where the fixed point is unstable, and attract. As k "
    "-> 0 kappa tends to (4/3) (3 r^2 (pi m)^2 + 1 - 2 r^2 + 3 r^4). Proof. The equations are "
    "linear in rho cos x, rho sin x and the velocities l(h) and l(-h). Divide their odd parts by "
    "h: at h = 0 the even ones give rho cos x and the even part of l for each rho sin x, with the "
    "determinant -(1 + epsilon) sin(2 pi m k)/k, and then the odd ones the others, with a "
    "determinant of the sign of 1 - k^2 A; so the solution is the power series that solves them to "
    "order 3. N is the sum of (1 - k^2) (k^2 (1 - 2 r^2 + 3 r^4) + 3 r^2 t^2), k^2 (3 k^2 r^2 (1 + "
    "2 r^2 - r^4) + t^2 (2 + 2 r^2 - 3 r^4)) and positive terms, 0 < r <= 1 and k < 1. On the "
    "centre manifold the second iterate is h + 2 mu h - 2 K h^3 to leading order, mu growing with "
    "rho, and its fixed points have mu = K h^2: so K > 0.",
    *STIFF,
    CYCLE,
    Equal.read(*_REGULAR),
    Equal.read(_RISE, _POSITIVE),
    Series.read(f"at({RISE}, t=sin(pi*m*k)/cos(pi*m*k), B=2)", "k", (LIMIT_RISE,)),
    tex=r"\rho^2 = \rho_F^2 + \kappa h^2 + O(h^4)",
)
