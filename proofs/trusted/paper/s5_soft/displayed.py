"""The equations of section 5, as printed, and the ones that are derived. Trusted, and shared.

Names: x0, v0 position and velocity at t0; v the velocity v_k before an impact, tau the time to the
next one; a, b for omega t_k, omega t_(k+1), psi, psi1 without multiples of 2 pi, which change no
sine or cosine; psi, v also for the fixed point. lam is lambda, omega_n also what is printed as w_n.
S22 is the left side of (22), S23 the right side of (23) and so on, as printed; where the scan lost
something, the reading is stated.
"""

from __future__ import annotations

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
MAP = f"rho*sin(psi) + {LAUNCH}*{FLIGHT} - {FLIGHT}**2 - rho*sin(psi1)"  # = 0 gives psi1
VELOCITY = f"{LAUNCH} - 2*{FLIGHT}"  # lambda_(k+1)
PLASTIC = f"rho*sin(psi) + rho*cos(psi)*{FLIGHT} - {FLIGHT}**2 - rho*sin(psi1)"
SCALES = "beta=rho*g/(2*omega**2), v=lam*g/(2*omega)"

# The fixed points, by their phase: rho and alpha = (1 + epsilon) rho sin psi.
RHO = "(1 - epsilon)*2*pi*m/((1 + epsilon)*cos(psi))"
ALPHA = "(1 - epsilon)*2*pi*m*sin(psi)/cos(psi)"
FIXED = f"psi1=psi, lam=-2*pi*m, rho={RHO}"

JACOBIAN = (
    "1 - (1 + epsilon)/2*alpha",
    "-epsilon*(1 + epsilon)/2",
    "epsilon*alpha",
    "epsilon**2",
)
TURN = (f"(-D({MAP}, psi)/D({MAP}, psi1))", f"(-D({MAP}, lam)/D({MAP}, psi1))")  # of psi1
DERIVED_JACOBIAN = (
    *TURN,
    f"(D({VELOCITY}, psi) + D({VELOCITY}, psi1)*{TURN[0]})",
    f"(D({VELOCITY}, lam) + D({VELOCITY}, psi1)*{TURN[1]})",
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
# h = psi_k - psi_o, j = psi_(k+1) - psi_o, l = lambda_k + c, c = 2 pi m, a = alpha.

LOCAL = (
    "a*(cos(h) - cos(j)) + (1 - epsilon)*c*(sin(h) - sin(j)) + (1 + epsilon)*((epsilon*(c - l)"
    " + (1 - epsilon)*c*cos(h) - a*sin(h))*(j - h + c) - (j - h + c)**2)"
)
LOCAL_VELOCITY = "epsilon*(c - l) + (1 - epsilon)*c*cos(h) - a*sin(h) - 2*(j - h + c)"
MOVED = f"psi=x + h, psi1=x + j, lam=l - 2*pi*m, rho=at({RHO}, psi=x)"
HERE = f"a=at({ALPHA}, psi=x), c=2*pi*m"

# The centre manifold at the flip, l = MANIFOLD(h), and the map on it, j = REDUCED(h), to order 3.
SECOND = "(c**2 - 8)*(epsilon**2 - 1)/4/c/(1 + epsilon**2)"
THIRD = (
    "(3*c**4*epsilon**2*(1 - epsilon**2)**2"
    " - c**2*(20*epsilon**6 + 16*epsilon**5 - 132*epsilon**4 + 32*epsilon**3 + 12*epsilon**2"
    " + 16*epsilon - 28) - 96*(1 - epsilon**2)**3)"
    "/24/c**2/(1 - epsilon)/(1 + epsilon)/(1 + epsilon**2)/(1 + epsilon**2)"
)
REDUCED = f"(-h + {SECOND}*h**2 + {THIRD}*h**3)"
_L2 = (
    "(epsilon - 1)*(c**2*epsilon**2 + c**2*epsilon - 8*epsilon + 8)/2/c/(1 + epsilon)"
    "/(1 + epsilon**2)"
)
_L3 = (
    "(3*c**4*epsilon*(1 - epsilon**2)**2 + 4*c**2*(2*epsilon**7 + epsilon**6 - 2*epsilon**5 - "
    "9*epsilon**4 + 38*epsilon**3 - 9*epsilon**2 - 6*epsilon + 1) - 96*(1 - epsilon**2)**2*(1 - "
    "epsilon)**2)/12/c**2/(epsilon - 1)/(1 + epsilon)/(1 + epsilon)/(1 + epsilon**2)/(1 + "
    "epsilon**2)"
)
MANIFOLD = f"(-4*epsilon/(1 + epsilon)*h + {_L2}*h**2 + {_L3}*h**3)"
CUBIC = "(3*c**2*(1 - epsilon**2)**2 + 8*(1 - epsilon)**4 + 64*epsilon**2)/(48*(1 - epsilon**4))"

# The plastic map near a fixed point: rho = rho_o (1 + r), a = rho_o sin psi_o, c = rho_o cos psi_o
LOCAL_PLASTIC = (
    "(1 + r)*(a*cos(h) + c*sin(h) + (c*cos(h) - a*sin(h))*(j - h + c) - a*cos(j) - c*sin(j))"
    " - (j - h + c)**2"
)
F_FLIP = "(-h + (8 - c**2)/(4*c)*h**2 + (7*c**2 - 24)/(6*c**2)*h**3 + r*(c/2 - 3*h))"  # a = 4
F_PRINTED = "(-c/4*h**2 + 1/3*h**3 + r*(c/2 - h))"  # a = 2

F2_PSI_RHO = f"{TRUE_RHO_O}/4"  # derivatives of f^2 at its fixed point at this rho
F2_PSI_PSI_PSI = "-(3*pi**2*m**2 + 2)"

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

# The plastic map there, near a fixed point: h, j as above, C = cos(2 s), S = sin(2 s), t = tan s,
# a = rho sin psi_o, b = rho cos psi_o. Where its slope is -1, j = STIFF_FLIP(h) to order 3.
_TURNED = ("(C*cos(k*(j - h)) - S*sin(k*(j - h)))", "(S*cos(k*(j - h)) + C*sin(k*(j - h)))")
STIFF_LOCAL = (
    f"(a*cos(h) + b*sin(h) - q)*{_TURNED[0]} + (b*cos(h) - a*sin(h))*{_TURNED[1]}/k"
    f" - 2/k**2*(1 - {_TURNED[0]}) - (a*cos(j) + b*sin(j) - q)"
)
STIFF_HERE = "C=(1 - t**2)/(1 + t**2), S=2*t/(1 + t**2), b=t*big/k, q=a - (big - 2)/k**2"
STIFF_SECOND = "(2*k**2 + 2*k**2*t**2 - k**2*t**4 - t**2)/2/k/t/(1 + t**2)"
STIFF_THIRD = "(11*k**2*t**4 - 4*k**2*t**2 - 6*k**2 - 2*t**4 + 7*t**2)/6/t**2/(1 + t**2)"
STIFF_FLIP = f"(-h + {STIFF_SECOND}*h**2 + {STIFF_THIRD}*h**3)"
STIFF_CUBIC = (
    "(k**4*(3*t**6 + 10*t**4 + 14*t**2 + 4) + 2*k**2*(t**4 - t**2 + 1) + 3*t**2)"
    "/(12*k**2*(1 + t**2)**2)"
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
