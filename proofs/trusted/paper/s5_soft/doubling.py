"""Section 5, soft springs of any stiffness: orbits of period 2 near the flip."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import corollary
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft.theorems import STIFF

# Impacts at the phases x - h and x + h, with the velocities l(h) and l(-h): the flight from the
# first, of the time 2 pi m + 2 h. a = rho sin x, b = rho cos x, C = cos(2 s), S = sin(2 s), and
# r = (1 - epsilon)/(1 + epsilon), d = 1 - k^2 (1 + t^2 + r^2); s, k, t, q and big as in STIFF_HERE.
_TURNED = "(C*cos(2*k*h) - S*sin(2*k*h))", "(S*cos(2*k*h) + C*sin(2*k*h))/k"
_LAUNCH = "((2*b*cos(h) + 2*a*sin(h) - (1 - r)*l)/(1 + r))"
_HEIGHT = "(a*cos(h) - b*sin(h) - q)"
_FALL = (
    f"({_HEIGHT}*{_TURNED[0]} + {_LAUNCH}*{_TURNED[1]} - 2/k**2*(1 - {_TURNED[0]})"
    " - (a*cos(h) + b*sin(h) - q))"
)
_SPEED = f"({_LAUNCH}*{_TURNED[0]} - (k**2*{_HEIGHT} + 2)*{_TURNED[1]})"
_FLIGHT = "psi=x - h, psi1=x + h, m=s/(pi*k), lam=l, epsilon=(1 - r)/(1 + r)"
_NAMED = "a=rho*sin(x), b=rho*cos(x), C=cos(2*s), S=sin(2*s)"
_TANGENT = "C=(1 - t**2)/(1 + t**2), S=2*t/(1 + t**2)"

# The solution near h = 0, as series in h.
_D = "(1 - k**2*(1 + t**2 + r**2))"
_A0, _B0 = "big*(1 + t**2 + r**2)", "r*t*big/k"
_A2 = f"big*(3*r**2 + 1 + t**2 - k**2*(3*r**4 - (3*t**2 - 1)*(1 + t**2)))/(6*{_D})"
_B2 = (
    "big*r*(3*t**2 + 2*k**4*(1 + t**2)*(3*r**2 + t**2 + 3)"
    f" - k**2*(3*r**2*t**2 + (6 - t**2)*(1 + t**2)))/(6*k*t*{_D})"
)
_L2 = f"big*k*(1 + t**2)*(3*r + 2*t**2 - k**2*(3*r**3 + 3*r*(1 + t**2) + 2*t**2))/(3*t*{_D})"
_L3 = f"big*(r - 2*k**4*r*(r + 1)*(1 + t**2) - k**2*(r**3 + (2*t**2 - r)*(1 + t**2)))/(3*{_D})"
_VELOCITY = f"(-t*big/k + big*(1 + t**2 - r)*h - {_L2}*h**2 - {_L3}*h**3)"
_CYCLE = (
    f"a={_A0} + {_A2}*h**2, b={_B0} + {_B2}*h**2, l={_VELOCITY}, q={_A0} - (big - 2)/k**2, "
    f"{_TANGENT}"
)
_NONZERO = ("k", "t", "1 + t**2", "1 + r", _D)
_ZERO4 = ("0", "0", "0", "0")
_RISE = (
    "(3*r**2*t**2 + k**2*((1 + t**2)**2 + r**2*(1 + t**2)*(t**2 - 2) + 3*r**4*(1 - t**2))"
    " + k**4*((1 + t**2)**2*(3*t**2 - 1 + 5*r**2) + 3*r**4*(1 + t**2) - 3*r**6))"
)
RISE = f"big**2*{_RISE}/(3*k**2*{_D})"
LIMIT_RISE = "4*(3*r**2*(pi*m)**2 + 1 - 2*r**2 + 3*r**4)/3"
_POSITIVE = (
    "(1 - k**2)*(k**2*(1 - 2*r**2 + 3*r**4) + 3*r**2*t**2) + k**2*(3*k**2*r**2*(1 + 2*r**2 - r**4) "
    "+ t**2*(2 + 2*r**2 - 3*r**4)) + k**4*t**2*(1 + 10*r**2 + 3*r**4) + k**2*t**4*(1 + r**2)*(1 + "
    "5*k**2) + 3*k**4*t**6"
)

# The odd parts at h = 0 where the even ones vanish, b and l(0) being those of a fixed point.
_FAMILY = f"b=r*t*(2 + k**2*(a - q))/k, l=w*h - t*(2 + k**2*(a - q))/k, {_TANGENT}"
_ODD = tuple(f"at(D(at({each}, {_FAMILY}), h), h=0)" for each in (_FALL, f"({_SPEED} + w*h)"))
_REGULAR = (
    f"D({_ODD[0]}, a)*D({_ODD[1]}, w) - D({_ODD[0]}, w)*D({_ODD[1]}, a)",
    f"4*t*{_D}/(k*(1 + r)*(1 + t**2))",
)

doubling = corollary(
    "For every m >= 1, 0 <= epsilon < 1 and springs of any stiffness 0 < k = omega_n/omega < 1/(2 "
    "m) a flip of a fixed point, an orbit or not, is a supercritical period doubling. Let q = 2 "
    "omega^2 p/g, k^2 q < 2, r = (1 - epsilon)/(1 + epsilon), t = tan(pi m k), c = 2 pi m, A = 1 + "
    "t^2 + r^2. The fixed points of (24), (25) with lambda < 0 and flights over m periods have rho "
    "cos psi = r t B/k, lambda = -t B/k, B = 2 + k^2 (rho sin psi - q) > 0. One of them has the "
    "eigenvalue -1, the other being -epsilon^2, exactly if k^2 A < 1: at rho sin psi = A B, B = (2 "
    "- k^2 q)/(1 - k^2 A), where the trace falls as rho grows. For each small h, not 0, there is "
    "one motion with impacts at x - h and x + h by turns and flights of c + 2 h and c - 2 h; it "
    "has rho^2 = rho_F^2 + kappa h^2 + O(h^4), rho_F being the value of the flip, kappa = B^2 N/(3 "
    "k^2 (1 - k^2 A)), N = 3 r^2 t^2 + k^2 ((1 + t^2)^2 + r^2 (1 + t^2) (t^2 - 2) + 3 r^4 (1 - "
    "t^2)) + k^4 ((1 + t^2)^2 (3 t^2 - 1 + 5 r^2) + 3 r^4 (1 + t^2) - 3 r^6) > 0. So orbits of "
    "period 2 are at rho > rho_F, where the fixed point is unstable, and attract. As k -> 0 kappa "
    "tends to (4/3) (3 r^2 (pi m)^2 + 1 - 2 r^2 + 3 r^4). Proof. The equations are linear in rho "
    "cos x, rho sin x and the velocities l(h) and l(-h). Divide their odd parts by h: at h = 0 the "
    "even ones give rho cos x and the even part of l for each rho sin x, with the determinant -(1 "
    "+ epsilon) sin(2 pi m k)/k, and then the odd ones the others, with a determinant of the sign "
    "of 1 - k^2 A; so the solution is the power series that solves them to order 3. N is the sum "
    "of (1 - k^2) (k^2 (1 - 2 r^2 + 3 r^4) + 3 r^2 t^2), k^2 (3 k^2 r^2 (1 + 2 r^2 - r^4) + t^2 (2 "
    "+ 2 r^2 - 3 r^4)) and positive terms, 0 < r <= 1 and k < 1. On the centre manifold the second "
    "iterate is h + 2 mu h - 2 K h^3 to leading order, mu growing with rho, and its fixed points "
    "have mu = K h^2: so K > 0.",
    *STIFF,
    Equal(f"at({eq.STIFF_MAP}, {_FLIGHT})", f"at({_FALL}, {_NAMED})"),
    Equal(f"at({eq.STIFF_VELOCITY}, {_FLIGHT})", f"at({_SPEED}, {_NAMED})"),
    Series(f"at({_FALL}, {_CYCLE})", "h", _ZERO4, _NONZERO),
    Series(f"at({_SPEED}, {_CYCLE}) - at({_VELOCITY}, h=-h)", "h", _ZERO4, _NONZERO),
    Equal(*_REGULAR),
    Equal(f"2*({_A0}*{_A2} + {_B0}*{_B2})", RISE),
    Equal(_RISE, _POSITIVE),
    Series(f"at({RISE}, t=sin(pi*m*k)/cos(pi*m*k), big=2)", "k", (LIMIT_RISE,)),
    tex=r"\rho^2 = \rho_F^2 + \kappa h^2 + O(h^4)",
)
