"""Section 5 near its fixed points: what is asked about Jacobians, centre manifolds and jets.

x = psi_k - psi_o, x1 = psi_(k+1) - psi_o, a = rho sin psi_o, b = rho cos psi_o, c = 2 pi m; so the
paper's alpha is (1 + epsilon) a. In solutions lam is lambda_o.
"""

from __future__ import annotations

from proofs.trusted.kernel.solutions import implicit_derivative
from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Unknowns, unknowns
from proofs.trusted.paper.s5_soft import displayed as eq

_LAUNCH = "(-epsilon*lam + (1 + epsilon)*(b*cos(x) - a*sin(x)))"
_RETURN, _SPEED = eq.limit(
    "(a*cos(x) + b*sin(x))",
    _LAUNCH,
    "(x1 - x + c)",
    "(a*cos(x1) + b*sin(x1))",
)
LOCAL = (_RETURN, f"lam1 - ({_SPEED})")
MOVED, HERE = "psi=x + y, psi1=x1 + y", "a=rho*sin(y), b=rho*cos(y), c=2*pi*m"
_ZERO4 = ("0", "0", "0", "0")
_AT_POINT = "x=0, x1=0, lam1=lam"
POINT = unknowns(
    "b lam j11 j12 j21 j22",
    "a c epsilon",
    *(Equal.read(f"at({each}, {_AT_POINT})", "0") for each in LOCAL),
    Equal.read(f"at(D({_RETURN}, x1), {_AT_POINT})", "-2*c/(1 + epsilon)"),
    *(
        Equal.read(f"at({entry}, {_AT_POINT})", "0")
        for entry in implicit_derivative(
            LOCAL, ("x", "lam"), ("x1", "lam1"), ("j11", "j12", "j21", "j22")
        )
    ),
    *(
        Equal.read(f"at({printed}, alpha=(1 + epsilon)*a)", name)
        for printed, name in zip(eq.JACOBIAN, ("j11", "j12", "j21", "j22"), strict=True)
    ),
    nonzero=("1 + epsilon",),
    given="(1 - epsilon)*c/(1 + epsilon); -c; 1 - (1 + epsilon)**2*a/2; -epsilon*(1 + epsilon)/2; "
    "epsilon*(1 + epsilon)*a; epsilon**2",
)


def _flip(equation: str, more: str = "") -> str:
    """Put x = h, x1 = N(h) = -h + b2 h^2 + b3 h^3 and lambda on the centre manifold."""
    reduced = "(-h + b2*h**2 + b3*h**3)"
    return f"at({equation}, x=h, x1={reduced}{more.format(f'h={reduced}')})"


# The centre manifold at the flip and the map on it, to order 3; K = b2^2 + b3.
_MANIFOLD = "lam + lam_1*h + lam_2*h**2 + lam_3*h**3"
CUBIC = "(3*c**2*(1 - epsilon**2)**2 + 8*(1 - epsilon)**4 + 64*epsilon**2)/(48*(1 - epsilon**4))"
_NONZERO = ("1 + epsilon", "1 - epsilon", "1 + epsilon**2", "c")
FLIP = unknowns(
    "a b lam lam_1 lam_2 lam_3 b2 b3",
    "c epsilon",
    *(
        Series.read(
            _flip(each, f", lam={_MANIFOLD}, lam1=at({_MANIFOLD}, {{}})"),
            "h",
            _ZERO4,
            _NONZERO,
        )
        for each in LOCAL
    ),
    Equal.read("(1 + epsilon)*a", eq.ALPHA_FLIP),
    Equal.read("b2**2 + b3", CUBIC),
    nonzero=_NONZERO,
)

# The plastic map near a fixed point, rho = rho_o (1 + r): its 2-jet in h and r, and of order 3 in
# h; derivatives of its second iterate, which are those of the printed rho_o if a = 2.
LOCAL_PLASTIC = f"at({_RETURN}, epsilon=0, a=(1 + r)*a, b=(1 + r)*c)"
F2_PSI_RHO = f"{eq.TRUE_RHO_O}/4"  # derivatives of f^2 at its fixed point at this rho
F2_PSI_PSI_PSI = "-(3*pi**2*m**2 + 2)"


def _jet(a: str, slope: str, names: str, rates: str, values: tuple[str, ...]) -> Unknowns:
    """Ask for the jet where a = rho_o sin psi_o, and for derivatives of the second iterate."""
    s1, s2, s3, s4, s5 = names.split()
    text = f"({s1}*h + {s2}*h**2 + {s3}*h**3 + r*({s4} + {s5}*h))"
    near = f"at({LOCAL_PLASTIC}, a={a}, x=h, x1={text})"
    second = f"at({text}, h={text})"
    by = zip(("r", "h, h", "h, r", "h, h, h"), rates.split(), strict=True)
    return unknowns(
        f"{names} {rates}",
        "c",
        Equal.read(s1, slope),
        Series.read(f"at({near}, r=0)", "h", _ZERO4, ("c",)),
        Series.read(f"at(D({near}, r), r=0)", "h", ("0", "0"), ("c",)),
        *(Equal.read(f"at(D({second}, {x}), h=0, r=0)", name) for x, name in by),
        *map(Equal.read, rates.split(), values),
        nonzero=("c",),
    )


JET = _jet(
    "4",
    "-1",
    "s1 s2 s3 s4 s5",
    "d1 d2 d3 d4",
    ("0", "0", "(c**2 + 16)/4", "-(3*c**2/4 + 2)"),
)
PRINTED_JET = _jet("2", "0", "p1 p2 p3 p4 p5", "e1 e2 e3 e4", ("c/2", "0", "0", "0"))

# -- springs of any stiffness ----------------------------------------------------------------------
# C = cos(2 s), S = sin(2 s), s = pi m k, t = tan s, B = 2 + k^2 (a - q).

_COS, _SIN = "(C*cos(k*(x1 - x)) - S*sin(k*(x1 - x)))", "(S*cos(k*(x1 - x)) + C*sin(k*(x1 - x)))"
_STRETCH = "(a*cos(x) + b*sin(x) - q + 2/k**2)"  # from where the spring and gravity balance
STIFF = (
    f"{_STRETCH}*{_COS} + {_LAUNCH}*{_SIN}/k - 2/k**2 - (a*cos(x1) + b*sin(x1) - q)",
    f"lam1 - ({_LAUNCH}*{_COS} - k*{_STRETCH}*{_SIN})",
)
STIFF_HERE = "C=(1 - t**2)/(1 + t**2), S=2*t/(1 + t**2), q=a - (B - 2)/k**2"
_STIFF_ENTRIES = ("k11", "k12", "k21", "k22")
STIFF_POINT = unknowns(
    "b lam k11 k12 k21 k22",
    "a B k t epsilon",
    *(
        Equal.read(f"at(at({each}, {_AT_POINT}), {STIFF_HERE})", "0")
        for each in (
            *STIFF,
            *implicit_derivative(STIFF, ("x", "lam"), ("x1", "lam1"), _STIFF_ENTRIES),
        )
    ),
    Equal.read(f"at(at(D({STIFF[0]}, x1), {_AT_POINT}), {STIFF_HERE})", "-2*t*B/(k*(1 + epsilon))"),
    Equal.read(
        "k11 + k22",
        "at(((1 + epsilon)**2 + (1 - epsilon)**2*C - (1 + epsilon)**2*(1 + C)*a/B)/2, "
        "C=(1 - t**2)/(1 + t**2))",
    ),
    Equal.read("k11*k22 - k12*k21", "epsilon**2"),
    nonzero=("1 + epsilon", "B", "k", "1 + t**2"),
    given="(1 - epsilon)*t*B/((1 + epsilon)*k); -t*B/k; "
    "(B*(1 + epsilon*t**2) - (1 + epsilon)**2*a)/(B*(1 + t**2)); "
    "-epsilon*(1 + epsilon)/(B*(1 + t**2)); "
    "((1 + epsilon)**2*(epsilon + t**2)*a - (1 - epsilon)**2*t**2*B)/((1 + epsilon)*(1 + t**2)); "
    "epsilon*(epsilon + t**2)/(1 + t**2)",
)
