"""The equations of section 6, resonance, as printed, and what is proved about them.

Names: phi, gamma phase and velocity of an impact, phi1 the next phase, d = phi1 - phi or the time
of the flight; alpha, theta amplitude and angle. Derived: kick K = epsilon (gamma + nu cos phi), and
t for half a time of flight, so that no arctan is needed.
"""

from __future__ import annotations

from proofs.trusted.kernel.solutions import implicit_derivative
from proofs.trusted.kernel.values import Equal
from proofs.trusted.paper.formulas import differ, unknowns

# -- the relations, (14), (15), (30), (31) ---------------------------------------------------------

HEIGHT = "(1 + nu*sin(phi))"
SPEED = "(epsilon*gamma + nu*(1 + epsilon)*cos(phi))"
S14 = f"{HEIGHT}*cos(d) + {SPEED}*sin(d) - 1 - nu*sin(phi1)"  # = 0
S15 = f"{HEIGHT}*sin(d) - {SPEED}*cos(d)"  # = gamma_(k+1)
AMPLITUDES = (  # (30) and (31), HEIGHT being alpha sin(theta), SPEED alpha cos(theta)
    Equal.read("alpha*sin(theta)*cos(d) + alpha*cos(theta)*sin(d)", "alpha*sin(theta + d)"),
    Equal.read("alpha*sin(theta)*sin(d) - alpha*cos(theta)*cos(d)", "-alpha*cos(theta + d)"),
)

# The model itself: the mass after an impact, the table, and the rule of restitution.
_MASS = f"({HEIGHT}*cos(t) + {SPEED}*sin(t))"
_TABLE = "(1 + nu*sin(phi + t))"
MODEL = (
    Equal.read(f"D({_MASS}, t, t) + {_MASS}", "0"),
    Equal.read(f"at({_MASS}, t=0)", f"at({_TABLE}, t=0)"),
    Equal.read(f"at(D({_MASS}, t), t=0)", SPEED),
    Equal.read(f"-({SPEED} - nu*cos(phi))/(-gamma - nu*cos(phi))", "epsilon"),
    Equal.read(f"{_MASS} - {_TABLE}", f"at({S14}, d=t, phi1=phi + t)"),
    Equal.read(f"-D({_MASS}, t)", f"at({S15}, d=t)"),
)

KICK = "(epsilon*(gamma + nu*cos(phi)))"
CLOSING = f"({S15} + nu*cos(phi + d))"  # gamma + nu cos(phi) at the next impact
ROOTS = (
    Equal.read(f"at({S14}, d=2*t, phi1=phi + 2*t)", f"2*sin(t)*({KICK}*cos(t) - sin(t))"),
    Equal.read(f"at({CLOSING}, d=2*t)", f"sin(2*t) - {KICK}*cos(2*t)"),
    Equal.read("sin(2*t) - sin(t)/cos(t)*cos(2*t)", "sin(t)/cos(t)"),
)

# -- the Jacobian ----------------------------------------------------------------------------------


def trace(matrix: tuple[str, ...]) -> str:
    """Write the trace of a matrix, given by its rows."""
    return f"{matrix[0]} + {matrix[3]}"


def determinant(matrix: tuple[str, ...]) -> str:
    """Write the determinant of a matrix, given by its rows."""
    return f"{matrix[0]}*{matrix[3]} - {matrix[1]}*{matrix[2]}"


# The entries as printed, at an impact at phi1 after one at (phi, gamma); a21 as derived, too.
_D = "(phi1 - phi)"
_BELOW = f"(-{HEIGHT}*sin{_D} + {SPEED}*cos{_D} - nu*cos(phi1))"
_A11 = f"(1 + (nu*cos(phi1) - nu*cos(phi)*cos{_D} + nu*(1 + epsilon)*sin(phi)*sin{_D})/{_BELOW})"
_A12 = f"(-epsilon*sin{_D}/{_BELOW})"
A21, TRUE_A21 = (
    f"({HEIGHT}*cos{_D}*({_A11} - 1) + nu*cos(phi)*sin{_D} + {SPEED}*sin{_D}*({_A11} - 1)"
    f" {sign} nu*(1 + epsilon)*sin(phi)*cos{_D})"
    for sign in "-+"
)
_A22 = f"({HEIGHT}*{_A12}*cos{_D} + {SPEED}*sin{_D}*{_A12} - epsilon*cos{_D})"
JACOBIAN = (_A11, _A12, TRUE_A21, _A22)

# They are the derivative that (14), (15) determine.
_IMPACT, _VELOCITY = (f"at({side}, d=phi1 - phi)" for side in (S14, S15))
ENTRIES = tuple(
    Equal.read(entry, "0")
    for entry in implicit_derivative(
        (_IMPACT, f"{_VELOCITY} - gamma1"), ("phi", "gamma"), ("phi1", "gamma1"), JACOBIAN
    )
)
SIGN_OF_A21 = Equal.read(f"{A21} - {TRUE_A21}", "-2*nu*(1 + epsilon)*sin(phi)*cos(phi1 - phi)")
_ROOT = "gamma=sin(t)/cos(t)/epsilon - nu*cos(phi), phi1=phi + 2*t"  # K = tan t
A21_DIFFERS = differ(
    f"at({A21}, {_ROOT})", f"at({TRUE_A21}, {_ROOT})", nu="-1/5", epsilon="1/2", phi="1", t="-1/4"
)

# At K = 0: F near it, but for O(K^3), and DF there; what is printed; and the entries at any phi1.
_FIXED = "gamma=-nu*cos(phi)"
_NEAR_FIXED = (f"(phi + 2*{KICK})", f"({KICK} - nu*cos(phi + 2*{KICK}))")
FIXED_JACOBIAN = ("f11", "f12", "f21", "f22")
AT_REST = unknowns(
    " ".join(FIXED_JACOBIAN),
    "phi nu epsilon",
    *(
        Equal.read(f"at(D({part}, {x}), {_FIXED})", FIXED_JACOBIAN[2 * row + column])
        for row, part in enumerate(_NEAR_FIXED)
        for column, x in enumerate(("phi", "gamma"))
    ),
    Equal.read(trace(FIXED_JACOBIAN), "1 + epsilon"),
    Equal.read(determinant(FIXED_JACOBIAN), "epsilon"),
    given="1 - 2*epsilon*nu*sin(phi); 2*epsilon; "
    "nu*sin(phi)*(1 - epsilon - 2*epsilon*nu*sin(phi)); epsilon*(1 + 2*nu*sin(phi))",
)
PRINTED_JACOBIAN = (
    "(1 - epsilon*nu*sin(phi))",
    "(-epsilon)",
    "(nu*sin(phi)*(1 - epsilon*nu*sin(phi)))",
    "(-epsilon*nu*sin(phi))",
)
PRINTED = (
    Equal.read(trace(PRINTED_JACOBIAN), "1 - 2*epsilon*nu*sin(phi)"),
    Equal.read(determinant(PRINTED_JACOBIAN), "0"),
)
_OFF_THE_MAP = ("o11", "o12", "o21", "o22")
OFF_THE_MAP = unknowns(
    " ".join(_OFF_THE_MAP),
    "phi phi1 nu epsilon",
    *(
        Equal.read(f"at({entry}, {_FIXED})", name)
        for entry, name in zip(JACOBIAN, _OFF_THE_MAP, strict=True)
    ),
    given="1 - epsilon*nu*sin(phi); epsilon; nu*sin(phi1)*(1 - epsilon*nu*sin(phi)); "
    "epsilon*nu*sin(phi1)",
)

# -- 6.2, double impacts ---------------------------------------------------------------------------

PRODUCT = Equal.read("sin(a + d)*sin(b - d) - sin(a)*sin(b)", "sin(d)*sin(b - a - d)")
ALPHA_TURNS = Equal.read(
    f"at(D({HEIGHT}**2 + {SPEED}**2, phi)/2, {_FIXED})", "nu*cos(phi)*(1 - epsilon*nu*sin(phi))"
)
ALPHA_ZERO = (
    Equal.read(f"at({SPEED}, gamma=-(1 + 1/epsilon)*nu*cos(phi))", "0"),
    Equal.read(f"at({SPEED}, gamma=-(1 + 1/epsilon)*cos(phi))", "-(1 + epsilon)*(1 - nu)*cos(phi)"),
)

# Case 1.2.2: (gamma_o, gamma_1) over nu cos(phi_o), and the signs (s_o, s_1) of their equations.
VECTORS = {
    ("-1", "1"): (1, 1),
    ("(1 - epsilon**2)/(1 + epsilon**2)", "(1 + epsilon)**2/(1 + epsilon**2)"): (-1, 1),
    ("-(1 + epsilon)**2/(1 + epsilon**2)", "-(1 - epsilon**2)/(1 + epsilon**2)"): (1, -1),
    ("(1 + epsilon)/(1 - epsilon)", "-(1 + epsilon)/(1 - epsilon)"): (-1, -1),
}
# The left side of (14) from phi to pi - phi, sin(phi) = -1/nu: there d = pi - 2 phi.
_ACROSS = f"at(-{HEIGHT}*cos(2*phi) + {SPEED}*sin(2*phi) - 1 - nu*sin(phi), nu=-1/sin(phi))"
SOLUTIONS = tuple(
    lemma
    for (first, second), (s_o, s_1) in VECTORS.items()
    for lemma in (
        Equal.read(first, f"{s_o}*(epsilon*({second}) - (1 + epsilon))"),
        Equal.read(second, f"{s_1}*(epsilon*({first}) + (1 + epsilon))"),
        Equal.read(
            f"at({_ACROSS}, gamma=-({first})*cos(phi)/sin(phi))",
            f"-{s_1}*({second})*cos(phi)/sin(phi)*sin(2*phi)",
        ),
    )
)

STICKING = f"{HEIGHT}*sin(d) - {SPEED}*cos(d) + nu*cos(phi)"  # printed: < 0 where it does not stick
# The same with x, y = sin, cos of phi and u, v = sin, cos of d, for points with rational sines.
_SINES = "(1 + nu*x)*u - (epsilon*gamma + (1 + epsilon)*nu*y)*v + nu*y"
TEST = (
    Equal.read(f"at({_SINES}, x=sin(phi), y=cos(phi), u=sin(d), v=cos(d))", STICKING),
    Equal.read(f"{STICKING} + nu*cos(phi + d) - nu*cos(phi)", CLOSING),
    Equal.read(
        f"at({_SINES}, nu=-5/2, epsilon=1/2, x=4/5, y=3/5, gamma=5/6, u=-3/5, v=4/5)", "17/30"
    ),
)
