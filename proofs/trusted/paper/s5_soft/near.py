"""Section 5 near its fixed points: what is asked about Jacobians, centre manifolds and jets.

x = psi_k - psi_o, x1 = psi_(k+1) - psi_o, a = rho sin psi_o, b = rho cos psi_o, c = 2 pi m; so the
paper's alpha is (1 + epsilon) a. In solutions lam is lambda_o.
"""

from __future__ import annotations

from proofs.trusted.kernel.solutions import implicit_derivative
from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Unknowns, unknowns
from proofs.trusted.paper.s5_soft import displayed as eq

_RETURN, _SPEED = eq.limit(
    "(a*cos(x) + b*sin(x))",
    "(-epsilon*lam + (1 + epsilon)*(b*cos(x) - a*sin(x)))",
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
    *(Equal(f"at({each}, {_AT_POINT})", "0") for each in LOCAL),
    Equal(f"at(D({_RETURN}, x1), {_AT_POINT})", "-2*c/(1 + epsilon)"),
    *(
        Equal(f"at({entry}, {_AT_POINT})", "0")
        for entry in implicit_derivative(
            LOCAL, ("x", "lam"), ("x1", "lam1"), ("j11", "j12", "j21", "j22")
        )
    ),
    *(
        Equal(f"at({printed}, alpha=(1 + epsilon)*a)", name)
        for printed, name in zip(eq.JACOBIAN, ("j11", "j12", "j21", "j22"), strict=True)
    ),
    nonzero=("1 + epsilon",),
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
        Series(
            _flip(each, f", lam={_MANIFOLD}, lam1=at({_MANIFOLD}, {{}})"),
            "h",
            _ZERO4,
            _NONZERO,
        )
        for each in LOCAL
    ),
    Equal("(1 + epsilon)*a", eq.ALPHA_FLIP),
    Equal("b2**2 + b3", CUBIC),
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
        Equal(s1, slope),
        Series(f"at({near}, r=0)", "h", _ZERO4, ("c",)),
        Series(f"at(D({near}, r), r=0)", "h", ("0", "0"), ("c",)),
        *(Equal(f"at(D({second}, {x}), h=0, r=0)", name) for x, name in by),
        *map(Equal, rates.split(), values),
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
# The plastic map, C = cos(2 s), S = sin(2 s), t =
# tan s. Where its slope is -1 it is -h + b2 h^2 + b3 h^3, to order 3, and K = b2^2 + b3.
_TURNED = ("(C*cos(k*(x1 - x)) - S*sin(k*(x1 - x)))", "(S*cos(k*(x1 - x)) + C*sin(k*(x1 - x)))")
STIFF_LOCAL = (
    f"(a*cos(x) + b*sin(x) - q)*{_TURNED[0]} + (b*cos(x) - a*sin(x))*{_TURNED[1]}/k"
    f" - 2/k**2*(1 - {_TURNED[0]}) - (a*cos(x1) + b*sin(x1) - q)"
)
STIFF_HERE = "C=(1 - t**2)/(1 + t**2), S=2*t/(1 + t**2), b=t*big/k, q=a - (big - 2)/k**2"
STIFF_CUBIC = (
    "(k**4*(3*t**6 + 10*t**4 + 14*t**2 + 4) + 2*k**2*(t**4 - t**2 + 1) + 3*t**2)"
    "/(12*k**2*(1 + t**2)**2)"
)
_STIFF_NONZERO = ("k", "t", "1 + t**2", "2 + t**2")
STIFF_FLIP = unknowns(
    "b2 b3",
    "k t",
    Series(
        f"at(at({_flip(STIFF_LOCAL)}, {STIFF_HERE}), big=a/(2 + t**2))",
        "h",
        _ZERO4,
        _STIFF_NONZERO,
    ),
    Equal("b2**2 + b3", STIFF_CUBIC),
    nonzero=_STIFF_NONZERO,
)
STIFF_SQUARE = "a**2 + (t*(2 + k**2*(a - q))/k)**2"  # rho^2
STIFF_HEIGHT = "(2 + t**2)*(2 - k**2*q)/(1 - k**2*(2 + t**2))"  # a at the flip
STIFF_GAP = (
    "(a - q)*cos(k*tau) + b*sin(k*tau)/k - 2/k**2*(1 - cos(k*tau)) - (a*cos(tau) + b*sin(tau) - q)"
)
_AT_FLIP = f"at(a/(2 + t**2), a={STIFF_HEIGHT})"
STIFF_FLIP_GAP = (
    f"at(at(at({STIFF_GAP}, b=t*big/k), big={_AT_FLIP}, a={STIFF_HEIGHT}), "
    "t=sin(pi*m*k)/cos(pi*m*k))"
)
STIFF_FLIP_RHO = f"sqrt(at(at({STIFF_SQUARE}, a={STIFF_HEIGHT}), t=sin(pi*m*k)/cos(pi*m*k)))"
