"""The equations of section 6, resonance, as printed, and the ones derived. Trusted, and shared.

Names: phi, gamma phase and velocity of an impact, phi1 the next phase, d = phi1 - phi or the time
of the flight; alpha, theta amplitude and angle. Derived: kick K = epsilon (gamma + nu cos phi), and
t for half a time of flight, so that no arctan is needed.
"""

from __future__ import annotations

# -- the relations, (30)-(31) ----------------------------------------------------------------------

HEIGHT = "(1 + nu*sin(phi))"
SPEED = "(epsilon*gamma + nu*(1 + epsilon)*cos(phi))"
S14 = f"{HEIGHT}*cos(d) + {SPEED}*sin(d) - 1 - nu*sin(phi1)"  # = 0
S15 = f"{HEIGHT}*sin(d) - {SPEED}*cos(d)"  # = gamma_(k+1)
S30 = "alpha*sin(theta + d)"  # = alpha_(k+1) sin(theta_(k+1)), alpha sin(theta) being HEIGHT
S31 = "-alpha*cos(theta + d)"
POLAR = "h=alpha*sin(theta), w=alpha*cos(theta)"

# The model itself: the mass after an impact, the table, and the rule of restitution.
MASS = f"({HEIGHT}*cos(t) + {SPEED}*sin(t))"
TABLE = "(1 + nu*sin(phi + t))"

# -- in closed form --------------------------------------------------------------------------------

KICK = "(epsilon*(gamma + nu*cos(phi)))"
CLOSING = f"({S15} + nu*cos(phi + d))"  # gamma + nu cos(phi) at the next impact
FIXED = "gamma=-nu*cos(phi)"
ROOT = "gamma=sin(t)/cos(t)/epsilon - nu*cos(phi), phi1=phi + 2*t"  # K = tan t: the other zero

# DF by the closed form, where next = phi + 2 arctan K has the derivative d phi + 2 dK/(1 + K^2).
_TURN = tuple(f"2*D({KICK}, {x})/(1 + {KICK}**2)" for x in ("phi", "gamma"))
_LIFT = "nu*sin(phi + 2*t)"
CLOSED_JACOBIAN = (
    f"(1 + {_TURN[0]})",
    f"({_TURN[1]})",
    f"(D({KICK}, phi) + {_LIFT}*(1 + {_TURN[0]}))",
    f"(D({KICK}, gamma) + {_LIFT}*{_TURN[1]})",
)
FIXED_JACOBIAN = (
    "(1 - 2*epsilon*nu*sin(phi))",
    "(2*epsilon)",
    "(nu*sin(phi)*(1 - epsilon - 2*epsilon*nu*sin(phi)))",
    "(epsilon*(1 + 2*nu*sin(phi)))",
)

# -- 6.1, single impacts ---------------------------------------------------------------------------

PRINTED_JACOBIAN = (
    "(1 - epsilon*nu*sin(phi))",
    "(-epsilon)",
    "(nu*sin(phi)*(1 - epsilon*nu*sin(phi)))",
    "(-epsilon*nu*sin(phi))",
)
# What a11, a12, the derived a21, and a22 are where gamma = -nu cos(phi), for every phi1.
OFF_THE_MAP = (
    "(1 - epsilon*nu*sin(phi))",
    "(epsilon)",
    "(nu*sin(phi1)*(1 - epsilon*nu*sin(phi)))",
    "(epsilon*nu*sin(phi1))",
)
PRINTED_EIGENVALUE = "(1 - 2*epsilon*nu*sin(phi))"


def trace(matrix: tuple[str, ...]) -> str:
    """Write the trace of a matrix, given by its rows."""
    return f"{matrix[0]} + {matrix[3]}"


def determinant(matrix: tuple[str, ...]) -> str:
    """Write the determinant of a matrix, given by its rows."""
    return f"{matrix[0]}*{matrix[3]} - {matrix[1]}*{matrix[2]}"


# -- 6.2, double impacts ---------------------------------------------------------------------------

AMPLITUDE_SQUARE = f"({HEIGHT}**2 + {SPEED}**2)"
ALPHA_ZERO_PRINTED = "-(1 + 1/epsilon)*cos(phi)"
ALPHA_ZERO = "-(1 + 1/epsilon)*nu*cos(phi)"

# Case 1.2.2: (gamma_o, gamma_1) over nu cos(phi_o), and the signs (s_o, s_1) of their equations.
VECTORS = {
    ("-1", "1"): (1, 1),
    ("(1 - epsilon**2)/(1 + epsilon**2)", "(1 + epsilon)**2/(1 + epsilon**2)"): (-1, 1),
    ("-(1 + epsilon)**2/(1 + epsilon**2)", "-(1 - epsilon**2)/(1 + epsilon**2)"): (1, -1),
    ("(1 + epsilon)/(1 - epsilon)", "-(1 + epsilon)/(1 - epsilon)"): (-1, -1),
}
# The left side of (14) from phi to pi - phi, sin(phi) = -1/nu: there d = pi - 2 phi.
ACROSS14 = f"at(-{HEIGHT}*cos(2*phi) + {SPEED}*sin(2*phi) - 1 - nu*sin(phi), nu=-1/sin(phi))"

# The entries of DF at an impact at phi1 after one at (phi, gamma).
_D = "(phi1 - phi)"
BELOW = f"(-{HEIGHT}*sin{_D} + {SPEED}*cos{_D} - nu*cos(phi1))"
A11 = f"(1 + (nu*cos(phi1) - nu*cos(phi)*cos{_D} + nu*(1 + epsilon)*sin(phi)*sin{_D})/{BELOW})"
A12 = f"(-epsilon*sin{_D}/{BELOW})"


def _a21(sign: str) -> str:
    return (
        f"({HEIGHT}*cos{_D}*({A11} - 1) + nu*cos(phi)*sin{_D} + {SPEED}*sin{_D}*({A11} - 1)"
        f" {sign} nu*(1 + epsilon)*sin(phi)*cos{_D})"
    )


A21, TRUE_A21 = _a21("-"), _a21("+")
A22 = f"({HEIGHT}*{A12}*cos{_D} + {SPEED}*sin{_D}*{A12} - epsilon*cos{_D})"

# The same by implicit differentiation of (14), (15).
_IMPACT, _VELOCITY = (f"at({side}, d=phi1 - phi)" for side in (S14, S15))
_PHASE = tuple(f"(-D({_IMPACT}, {x})/D({_IMPACT}, phi1))" for x in ("phi", "gamma"))
DERIVED_JACOBIAN = (
    *_PHASE,
    *(
        f"(D({_VELOCITY}, {x}) + D({_VELOCITY}, phi1)*{turn})"
        for x, turn in zip(("phi", "gamma"), _PHASE, strict=True)
    ),
)
JACOBIAN = (A11, A12, TRUE_A21, A22)

STICKING = f"{HEIGHT}*sin(d) - {SPEED}*cos(d) + nu*cos(phi)"  # printed: < 0 where it does not stick
# The same with x, y = sin, cos of phi and u, v = sin, cos of d, for points with rational sines.
STICKING_SINES = "(1 + nu*x)*u - (epsilon*gamma + (1 + epsilon)*nu*y)*v + nu*y"
