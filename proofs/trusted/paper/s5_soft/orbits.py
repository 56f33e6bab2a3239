"""Section 5, soft springs: which solutions of the limit equations are orbits, of first impacts."""

from __future__ import annotations

from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import at, corollary
from proofs.trusted.paper.s5_soft import displayed as eq

# The flight from a fixed point lasts 2 d = 2 pi m; r = (1 - epsilon)/(1 + epsilon). At time 2 u the
# gap is 2 sin^2(u) (rho sin psi - LEAST); it touches 0 there if r = TOUCH and rho sin psi = HEIGHT.
_COT = "cos(u)/sin(u)"
LEAST = f"(2*d*r*{_COT} - 2*u*(d - u)/sin(u)**2)"
TOUCH = f"((2*u + 2*u*(d - u)*{_COT})/d - 1)"
HEIGHT = f"(2*u*(d - u)*(({_COT})**2 - 1) - 2*(d - 2*u)*{_COT})"
RESTITUTION = f"(1 - {TOUCH})/(1 + {TOUCH})"
_SAGITTA = "(u - sin(u)*cos(u))"
_GRAZING = (
    Equal.read(
        f"at({eq.GAP}, tau=2*u, lam=-2*pi*m, rho={eq.RHO})",
        f"2*sin(u)**2*({eq.RHO}*sin(psi) - at({LEAST}, d=pi*m, r=(1 - epsilon)/(1 + epsilon)))",
    ),
    Equal.read(f"D({LEAST}, u)", f"2*d*({TOUCH} - r)/sin(u)**2"),
    Equal.read(f"D({TOUCH}, u)", f"-2*({_SAGITTA}*(d - {_SAGITTA}) - sin(u)**4)/(d*sin(u)**2)"),
    Equal.read(f"D({_SAGITTA}*(pi - {_SAGITTA}) - sin(u)**4, u)", "2*(pi - 2*u)*sin(u)**2"),
    Equal.read(f"at({LEAST}, r={TOUCH})", HEIGHT),
    Equal.read(f"D({HEIGHT}, u)", f"2*d*{_COT}*D({TOUCH}, u)"),
    Series.read(TOUCH, "u", ("1",), ("d",)),
    Series.read(HEIGHT, "u", ("2",)),
    Series.read(f"at({LEAST}, r=1)", "u", ("2",)),
    Equal.read(f"at(({eq.ALPHA_FLIP})/(1 + epsilon), epsilon=(1 - r)/(1 + r))", "2*(1 + r**2)"),
    Series.read(
        f"at({eq.GAP}, epsilon=0, lam=-2*pi*m, rho=2*pi*m/cos(psi))",
        "tau",
        ("0", "0", "pi*m*sin(psi)/cos(psi) - 1"),
        ("cos(psi)",),
    ),
)
_LOW, _HIGH = "2552984/10000000", "2552985/10000000"  # HEIGHT is 0 between them if m = 1
_FIRST_EPSILON = (
    at(f"at({HEIGHT}, d=pi)", 1, u=_LOW),
    at(f"at({HEIGHT}, d=pi)", -1, u=_HIGH),
    at(f"at({RESTITUTION}, d=pi) - 2045763/100000000", 1, u=_LOW),
    at(f"2045765/100000000 - at({RESTITUTION}, d=pi)", 1, u=_HIGH),
)

# A plastic launch with rho sin psi = 2 and rho cos psi = w is at the table again at the times at
# which w = SPEED; with T for such a time rho sin(psi + T) - 2 = LANDING.
SPEED = "(tau**2 - 2 + 2*cos(tau))/(tau - sin(tau))"
_HALVES = "(2*sin(tau/2) - tau*cos(tau/2))"
_STICKING = (
    Equal.read(
        f"at({eq.PLASTIC}, m=0, psi1=psi + tau, rho=2/sin(psi))",
        f"(tau - sin(tau))*(2*cos(psi)/sin(psi) - {SPEED})",
    ),
    Equal.read(f"D({SPEED}, tau)", f"2*{_HALVES}**2/(tau - sin(tau))**2"),
    Equal.read(
        f"2*cos(tau) + {SPEED}*sin(tau) - 2",
        f"-2*tau*sin(tau/2)*{_HALVES}/(tau - sin(tau))",
    ),
    Equal.read(f"{SPEED} - tau", f"-2*sin(tau/2)*{_HALVES}/(tau - sin(tau))"),
    Equal.read("D(u*cos(u)/sin(u), u)", "(sin(u)*cos(u) - u)/sin(u)**2"),
    Series.read(SPEED, "tau", ("0", "1/2")),
)

admissible = corollary(
    "Let m >= 1, 0 < epsilon < 1, d = pi m, r = (1 - epsilon)/(1 + epsilon). A fixed point of the "
    "limits of (24), (25) with a flight over m periods is an orbit, the mass staying above the "
    "table from launch to impact, exactly if rho sin psi > h, h the greatest value on (0, pi/2] of "
    "F(u) = 2 d r cot u - 2 u (d - u)/sin^2 u; h < 2 falls as epsilon grows and is 0 at one "
    "epsilon_m. For epsilon = 0 it is one exactly if rho sin psi >= 2; with less the mass sticks "
    "at once. So at rho_F it is one, where rho sin psi = 2 (1 + r^2). 0.02045763 < epsilon_1 < "
    "0.02045765. With R(u) = (2 u + 2 u (d - u) cot u)/d - 1 and H(u) = 2 u (d - u) (cot^2 u - 1) "
    "- 2 (d - 2 u) cot u, which both fall on (0, pi/2), R from 1 to 1/m - 1 and H from 2, h is "
    "H(u) where R(u) = r, and epsilon_m is (1 - R(u))/(1 + R(u)) where H(u) = 0; if rho sin psi = "
    "h, the mass touches the table at time 2 u. Proof. The gap at time 2 u, 0 < u < d, is 2 "
    "sin^2(u) (rho sin psi - F(u)), where sin u is not 0, and 4 u (d - u) > 0 elsewhere. If cot u "
    "< 0 then F(d - u) > F(u); and F(w) >= F(w + j pi) if 0 < w <= pi/2, j >= 1, w + j pi < d, as "
    "w <= w + j pi <= d - w: so only u <= pi/2 counts. There F' = 2 d (R - r)/sin^2 u, H' = 2 d "
    "cot(u) R', and R' = -2 (y (d - y) - sin^4 u)/(d sin^2 u), y = u - sin u cos u <= pi/2, where "
    "y (d - y) - sin^4 u >= y (pi - y) - sin^4 u > 0: that is 0 at 0, with the derivative 2 (pi - "
    "2 u) sin^2 u. So F is greatest where R = r, and is H there, below 0 for r near 0, as F < 0 "
    "for r = 0. For r = 1 F falls from 2, and the gap begins with (rho sin psi/2 - 1) t^2.",
    *_GRAZING,
    values=_FIRST_EPSILON,
    tex=r"\rho \sin \psi > h",
)
sticking = corollary(
    "For plastic impacts, epsilon = 0, and m >= 1 an orbit of the limit equations with one impact "
    "in m table periods, after which the mass sticks, exists exactly if 2 sqrt(1 + u_(m-1)^2) <= "
    "rho < sqrt(4 + (2 pi m)^2), for m = 1 exactly if 2 < rho < sqrt(4 + (2 pi)^2); u_0 = 0, and "
    "tan u_j = u_j, pi j < u_j < pi j + pi/2. There is one for each such rho, and between the "
    "bounds it attracts: impacts at phases near its own stick as well, and the mass leaves at the "
    "same phase. (For 0 < epsilon < 1 no fixed point of the limit equations sticks: it is launched "
    "with the speed 2 epsilon c/(1 + epsilon) > 0, c = 2 pi m, relative to the table.) Proof. A "
    "mass at rest on the table leaves it where rho sin psi rises through 2, so with rho cos psi = "
    "w = sqrt(rho^2 - 4) > 0, and never for rho <= 2. At time t its gap is (t - sin t) (w - W(t)), "
    "W(t) = (t^2 - 2 + 2 cos t)/(t - sin t), W' = 2 (t cos(t/2) - 2 sin(t/2))^2/(t - sin t)^2: W "
    "increases from 0 to infinity, so there is one impact, at T with W(T) = w. At T rho sin psi is "
    "2 - 4 T sin^2(x) (1 - x cot x)/(T - sin T), x = T/2. It is below 2, and the mass sticks, "
    "exactly if x cot x < 1, x not a multiple of pi; x cot x falls on each (pi j, pi j + pi), from "
    "1 if j = 0 and from infinity otherwise: for x > u_j. At x = u_j it is 2 and falling, so the "
    "mass sticks; at multiples of pi it is 2 and rising, and the mass leaves at once. The next "
    "launch is j + 1 periods after the last. W(2 u_j) = 2 u_j and W(2 pi j) = 2 pi j give the "
    "bounds, with rho^2 = 4 + w^2.",
    *_STICKING,
    tex=r"2 \sqrt{1 + u_{m-1}^2} \le \rho < \sqrt{4 + (2 \pi m)^2}",
)
