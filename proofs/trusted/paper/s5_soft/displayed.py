"""The equations of section 5, as printed, and the ones that are derived. Trusted, and shared.

Names: x0, v0 position and velocity at t0; v the velocity v_k before an impact, tau the time to the
next one; a, b for omega t_k, omega t_(k+1), psi, psi1 without multiples of 2 pi, which change no
sine or cosine; psi, v also for the fixed point. lam is lambda, omega_n also what is printed as w_n.
S22 is the left side of (22), S23 the right side of (23) and so on, as printed; where the scan lost
something, the reading is stated.
"""

from __future__ import annotations

from proofs.trusted.kernel.solutions import implicit_derivative
from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.paper.formulas import Unknowns, unknowns

# -- flight and impact, (19)-(25) ------------------------------------------------------------------

X20 = "(x0 + g/omega_n**2)*cos(omega_n*(t - t0)) + v0/omega_n*sin(omega_n*(t - t0)) - g/omega_n**2"
V21 = "v0*cos(omega_n*(t - t0)) - omega_n*(x0 + g/omega_n**2)*sin(omega_n*(t - t0))"

S22 = (
    "(-p + beta*sin(a))*cos(omega_n*tau)"
    " + (-epsilon*v + (1 + epsilon)*beta*omega*cos(a))/omega_n*sin(omega_n*tau)"
    " - 2*g/omega_n**2*sin(omega_n/2*tau)**2 + p - beta*sin(b)"
)
S23 = (
    "(-epsilon*v + (1 + epsilon)*beta*omega*cos(a))*cos(omega_n*tau)"
    " - omega_n*(-p + beta*sin(a))*sin(omega_n*tau) - g/omega_n*sin(omega_n*tau)"
)

_PHASE = "omega_n/omega*(psi1 - psi + 2*pi*m)"
S24 = (
    f"(-p + beta*sin(psi))*cos({_PHASE})"
    f" + (-epsilon*v + (1 + epsilon)*beta*omega*cos(psi))/omega_n*sin({_PHASE})"
    " - 2*g/omega_n**2*sin(omega_n/(2*omega)*(psi1 - psi + 2*pi*m))**2 + p - beta*sin(psi1)"
)
S25 = (
    f"(-epsilon*v + (1 + epsilon)*beta*omega*cos(psi))*cos({_PHASE})"
    f" - omega_n*(-p + beta*sin(psi))*sin({_PHASE}) - g/omega_n*sin({_PHASE})"
)

# -- fixed points, (26)-(29) -----------------------------------------------------------------------

_WHOLE, _HALF = "(2*pi*m*omega_n/omega)", "(pi*m*omega_n/omega)"


def _s26(angle: str) -> str:
    return (
        f"(-p + beta*sin(psi))*cos{_WHOLE}"
        f" + (-epsilon*v + (1 + epsilon)*beta*omega*cos(psi))/omega_n*sin{_WHOLE}"
        f" - 2*g/omega_n**2*sin{angle}**2 + p - beta*sin(psi)"
    )


S26, TRUE26 = _s26(_WHOLE), _s26(_HALF)
S27 = (
    f"(-epsilon*v + (1 + epsilon)*beta*omega*cos(psi))*cos{_WHOLE}"
    f" - omega_n*(-p + beta*sin(psi))*sin{_WHOLE} - g/omega_n*sin{_WHOLE}"
)

_BELOW = f"(1 + epsilon*cos{_WHOLE})"


def _a28(divisor: str) -> str:
    return (
        f"2*(p - beta*sin(psi))*sin{_HALF}**2"
        f" + epsilon*(-p + beta*sin(psi))*sin{_WHOLE}**2/({divisor}{_BELOW})"
    )


A28, TRUE_A28 = _a28("omega_n*"), _a28("")  # the brace of A is lost: it is the first line
B28 = f"epsilon*g*sin{_WHOLE}**2/(omega_n**2*{_BELOW})"
C28 = f"2*g/omega_n**2*sin{_HALF}**2"
D28 = f"(1 + epsilon)*beta*omega*cos(psi)*sin{_WHOLE}/(omega_n*{_BELOW})"
S28, TRUE28 = (f"{first} + {B28} - {C28} + {D28}" for first in (A28, TRUE_A28))
# The braces of (29) are lost too: E, F, G are its three summands, F without its sign.
E29 = f"-omega_n*(-p + beta*sin(psi))*sin{_WHOLE}/{_BELOW}"
F29 = f"g*sin{_WHOLE}/(omega_n*{_BELOW})"
G29 = f"(1 + epsilon)*beta*omega*cos(psi)*cos{_WHOLE}/{_BELOW}"
S29 = f"{E29} - {F29} + {G29}"

LIMITS = {
    A28: "0",
    B28: "epsilon*g/(1 + epsilon)*(2*pi*m/omega)**2",
    C28: "g/2*(2*pi*m/omega)**2",
    D28: "2*pi*m/omega*beta*omega*cos(psi)",
    E29: "0",
    F29: "2*pi*m*g/(omega*(1 + epsilon))",
    G29: "beta*omega*cos(psi)",
}
LIMIT28 = f"{LIMITS[D28]} - {LIMITS[C28]} + {LIMITS[B28]}"
COSINE = "(1 - epsilon)*pi*m*g/((1 + epsilon)*omega**2*beta)"
COSINE_RHO = "(1 - epsilon)/(1 + epsilon)*2*pi*m/rho"

# With k = omega_n/omega and q = 2 omega^2 p/g the fixed points of any k are those with this as
# (1 + epsilon)/(1 - epsilon) rho cos psi, and lambda = -(1 + epsilon)/(1 - epsilon) rho cos psi.
FINITE = "sin(pi*m*k)/cos(pi*m*k)*(2/k - k*(q - rho*sin(psi)))"
FACTORS28 = (
    f"2*sin{_HALF}**2*((1 - epsilon)*(p - beta*sin(psi)) - (1 - epsilon)*g/omega_n**2"
    f" + (1 + epsilon)*beta*omega*cos(psi)*cos{_HALF}/sin{_HALF}/omega_n)"
)

# -- the limit map ---------------------------------------------------------------------------------

LAUNCH = "(-epsilon*lam + (1 + epsilon)*rho*cos(psi))"
FLIGHT = "(psi1 - psi + 2*pi*m)"


def _limit(sine: str, launch: str, flight: str, landing: str) -> tuple[str, str]:
    """Write what is 0 at the next impact, and lambda_(k+1); sine, landing: rho sin psi there."""
    return f"{sine} + {launch}*{flight} - {flight}**2 - {landing}", f"{launch} - 2*{flight}"


MAP, VELOCITY = _limit("rho*sin(psi)", LAUNCH, FLIGHT, "rho*sin(psi1)")  # MAP = 0 gives psi1
PLASTIC = f"rho*sin(psi) + rho*cos(psi)*{FLIGHT} - {FLIGHT}**2 - rho*sin(psi1)"
SCALES = "beta=rho*g/(2*omega**2), v=lam*g/(2*omega)"

# The fixed points, by their phase: rho and alpha = (1 + epsilon) rho sin psi.
RHO = "(1 - epsilon)*2*pi*m/((1 + epsilon)*cos(psi))"
ALPHA = "(1 - epsilon)*2*pi*m*sin(psi)/cos(psi)"
JACOBIAN = (
    "1 - (1 + epsilon)/2*alpha",
    "-epsilon*(1 + epsilon)/2",
    "epsilon*alpha",
    "epsilon**2",
)

# -- eigenvalues and bifurcation values ------------------------------------------------------------

TRACE = "1 + epsilon**2 - (1 + epsilon)/2*alpha"
DISCRIMINANT = "(1 - epsilon**2 - (1 + epsilon)/2*alpha)**2 - 2*epsilon**2*(1 + epsilon)*alpha"
PRINTED_SUM = (
    "(1 - epsilon**2)**2 + ((1 + epsilon)/2*alpha)**2 + (1 + epsilon)*(1 - epsilon**2)*alpha"
)
TRUE_SUM = "(1 - epsilon**2)**2 + ((1 + epsilon)/2*alpha)**2 - (1 + epsilon)*(1 + epsilon**2)*alpha"
EIGENVALUES = tuple(
    f"1/2*((1 + epsilon**2 - (1 + epsilon)/2*alpha) {sign} sqrt({DISCRIMINANT}))" for sign in "+-"
)
ALPHA_SQUARE = "((1 + epsilon)**2*rho**2 - (1 - epsilon)**2*(2*pi*m)**2)"
ALPHA_RHO = f"sqrt{ALPHA_SQUARE}"

RHO_SN = "(1 - epsilon)/(1 + epsilon)*2*pi*m"
RHO_M = "2*(1 - epsilon)/(1 + epsilon)*sqrt(pi**2*m**2 + 1)"
ALPHA_FLIP = "4*(1 + epsilon**2)/(1 + epsilon)"
PRINTED_ALPHA_FLIP = "4*(1 - epsilon)/(1 - 2*epsilon**2)"


def flip(alpha: str) -> str:
    """Write the rho at which alpha has a value."""
    return f"1/(1 + epsilon)*sqrt(({alpha})**2 + (1 - epsilon)**2*(2*pi*m)**2)"


RHO_MF = flip(PRINTED_ALPHA_FLIP)
RHO_O, TRUE_RHO_O = "sqrt(4 + (2*pi*m)**2)", "sqrt(16 + (2*pi*m)**2)"

# The characteristic polynomial at 1 and at -1.
AT_ONE = f"1 - ({TRACE}) + epsilon**2"
AT_MINUS_ONE = f"1 + ({TRACE}) + epsilon**2"

# The map of [1], of the phase and the departure velocity w, and its derivative where phi + w = x.
HIGH_BOUNCE = ("phi + w", "epsilon*w - gamma*cos(phi + w)")
_F, _G = HIGH_BOUNCE
HIGH_DETERMINANT = f"D({_F}, phi)*D({_G}, w) - D({_F}, w)*D({_G}, phi)"
HIGH_TRACE = f"at(D({_F}, phi) + D({_G}, w), phi=x - w)"

# -- near the fixed points -------------------------------------------------------------------------
# x = psi_k - psi_o, x1 = psi_(k+1) - psi_o, a = rho sin psi_o, b = rho cos psi_o, c = 2 pi m; lam
# in the solutions is lambda_o. A solution next to the paper's alpha is alpha = (1 + epsilon) a.

_RETURN, _SPEED = _limit(
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
        for printed, name in zip(JACOBIAN, ("j11", "j12", "j21", "j22"), strict=True)
    ),
)


def _flip(equation: str, more: str = "") -> str:
    """Put x = h, x1 = N(h) = -h + b2 h^2 + b3 h^3 and lambda on the centre manifold."""
    reduced = "(-h + b2*h**2 + b3*h**3)"
    return f"at({equation}, x=h, x1={reduced}{more.format(f'h={reduced}')})"


# The centre manifold at the flip and the map on it, to order 3; K = b2^2 + b3.
_MANIFOLD = "lam + lam_1*h + lam_2*h**2 + lam_3*h**3"
CUBIC = "(3*c**2*(1 - epsilon**2)**2 + 8*(1 - epsilon)**4 + 64*epsilon**2)/(48*(1 - epsilon**4))"
FLIP = unknowns(
    "a b lam lam_1 lam_2 lam_3 b2 b3",
    "c epsilon",
    *(
        Series(
            _flip(each, f", lam={_MANIFOLD}, lam1=at({_MANIFOLD}, {{}})"),
            "h",
            _ZERO4,
            ("1 + epsilon", "1 - epsilon", "1 + epsilon**2", "c"),
        )
        for each in LOCAL
    ),
    Equal("(1 + epsilon)*a", ALPHA_FLIP),
    Equal("b2**2 + b3", CUBIC),
)

# The plastic map near a fixed point, rho = rho_o (1 + r): its 2-jet in h and r, and of order 3 in
# h; derivatives of its second iterate, which are those of the printed rho_o if a = 2.
LOCAL_PLASTIC = f"at({_RETURN}, epsilon=0, a=(1 + r)*a, b=(1 + r)*c)"
F2_PSI_RHO = f"{TRUE_RHO_O}/4"  # derivatives of f^2 at its fixed point at this rho
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
    )


JET = _jet(
    "4",
    "-1",
    "s1 s2 s3 s4 s5",
    "d1 d2 d3 d4",
    ("0", "0", "(c**2 + 16)/4", "-(3*c**2/4 + 2)"),
)
PRINTED_JET = _jet("2", "0", "p1 p2 p3 p4 p5", "e1 e2 e3 e4", ("c/2", "0", "0", "0"))

# Mass minus table at time tau of the flight from a fixed point.
GAP = f"rho*sin(psi) + {LAUNCH}*tau - tau**2 - rho*sin(psi + tau)"

# -- springs of any stiffness ----------------------------------------------------------------------
# k and q as above, s = pi m k, big = 2 + k^2 (rho sin psi - q): fixed points by psi and big.

STIFF_MAP = f"at({S24}, {SCALES}, p=q*g/(2*omega**2), omega_n=k*omega)*2*omega**2/g"
STIFF_VELOCITY = f"at({S25}, {SCALES}, p=q*g/(2*omega**2), omega_n=k*omega)*2*omega/g"
STIFF_LAMBDA = "-sin(s)/cos(s)*big/k"
_STIFF_RHO = "(1 - epsilon)*big*sin(s)/((1 + epsilon)*k*cos(s)*cos(psi))"
STIFF_FIXED = (
    f"psi1=psi, lam={STIFF_LAMBDA}, rho={_STIFF_RHO}, m=s/(pi*k),"
    f" q={_STIFF_RHO}*sin(psi) - (big - 2)/k**2"
)
_STIFF_TURN = tuple(f"(-D({STIFF_MAP}, {x})/D({STIFF_MAP}, psi1))" for x in ("psi", "lam"))
_STIFF_ROW = tuple(
    f"(D({STIFF_VELOCITY}, {x}) + D({STIFF_VELOCITY}, psi1)*{turn})"
    for x, turn in zip(("psi", "lam"), _STIFF_TURN, strict=True)
)
STIFF_TRACE = f"{_STIFF_TURN[0]} + {_STIFF_ROW[1]}"
STIFF_DETERMINANT = f"{_STIFF_TURN[0]}*{_STIFF_ROW[1]} - {_STIFF_TURN[1]}*{_STIFF_ROW[0]}"
FOUND_TRACE = (
    "((1 + epsilon)**2 + (1 - epsilon)**2*cos(2*s)"
    f" - (1 + epsilon)**2*(1 + cos(2*s))*({_STIFF_RHO})*sin(psi)/big)/2"
)

# The plastic map there, near a fixed point: x, x1, a, b as above, C = cos(2 s), S = sin(2 s), t =
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
STIFF_FLIP = unknowns(
    "b2 b3",
    "k t",
    Series(
        f"at(at({_flip(STIFF_LOCAL)}, {STIFF_HERE}), big=a/(2 + t**2))",
        "h",
        _ZERO4,
        ("k", "t", "1 + t**2", "2 + t**2"),
    ),
    Equal("b2**2 + b3", STIFF_CUBIC),
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
