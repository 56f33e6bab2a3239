"""The equations of section 4, as printed, and what they equal. Trusted, and shared.

a, b stand for psi_k, psi_(k+1), delta for their difference, n for the number of table periods,
theta for the angle of (17). E10 is the left side of (10) and so on; (18) is TOP18/BOTTOM18.
"""

from __future__ import annotations

from proofs.trusted.paper.formulas import Equal

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
    Equal(f"at({E10}, {_AT})", E16),
    Equal(E16, f"2/eta*sin{X}*{DEFECT}"),
)
ANGLE = (
    Equal(E16, f"-nu/eta*at({LINEAR}, alpha={ALPHA}, beta={BETA})"),
    Equal(f"at({LINEAR}, alpha=r*cos(theta), beta=r*sin(theta))", f"r*({E17})"),
    Equal(f"({BETA})/({ALPHA})", f"cos{X}/(eta*sin{X})"),
)
SLOPE = (
    Equal(f"at(-D({E10}, a) + D({E10}, delta), {_AT})", TOP18),
    Equal(f"at(D({E10}, b) + D({E10}, delta), {_AT})", BOTTOM18),
    Equal(BOTTOM18, f"-2*nu*cos(phi) + 2*cos{X}*{DEFECT}"),
    Equal(
        f"({TOP18}) - 2*nu*cos(phi)*cos{X}**2*{LAUNCH}/{_HEIGHT}",
        f"-2*cos{X}*{LAUNCH}/{_HEIGHT}*{DEFECT}",
    ),
)
FLIGHT = (
    Equal(
        "cos(2*eta*y) - 1 + tan*sin(2*eta*y) + eta**2*(1 - cos(2*y)) - eta*tan*sin(2*y)",
        "2*(tan*(sin(eta*y)*cos(eta*y) - eta*sin(y)*cos(y)) - sin(eta*y)**2 + eta**2*sin(y)**2)",
    ),
)
LEMMAS = (*NECESSARY, *ANGLE, *SLOPE, *FLIGHT)
