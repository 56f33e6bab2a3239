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


def limit(sine: str, launch: str, flight: str, landing: str) -> tuple[str, str]:
    """Write what is 0 at the next impact, and lambda_(k+1); sine, landing: rho sin psi there."""
    return f"{sine} + {launch}*{flight} - {flight}**2 - {landing}", f"{launch} - 2*{flight}"


MAP, VELOCITY = limit("rho*sin(psi)", LAUNCH, FLIGHT, "rho*sin(psi1)")  # MAP = 0 gives psi1
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

# Mass minus table at time tau of the flight from a fixed point.
GAP = f"rho*sin(psi) + {LAUNCH}*tau - tau**2 - rho*sin(psi + tau)"

# -- springs of any stiffness ----------------------------------------------------------------------
# k and q as above, s = pi m k, B = 2 + k^2 (rho sin psi - q): fixed points by psi and B.

STIFF_MAP = f"at({S24}, {SCALES}, p=q*g/(2*omega**2), omega_n=k*omega)*2*omega**2/g"
STIFF_VELOCITY = f"at({S25}, {SCALES}, p=q*g/(2*omega**2), omega_n=k*omega)*2*omega/g"
STIFF_LAMBDA = "-sin(s)/cos(s)*B/k"
_STIFF_RHO = "(1 - epsilon)*B*sin(s)/((1 + epsilon)*k*cos(s)*cos(psi))"
STIFF_FIXED = (
    f"psi1=psi, lam={STIFF_LAMBDA}, rho={_STIFF_RHO}, m=s/(pi*k),"
    f" q={_STIFF_RHO}*sin(psi) - (B - 2)/k**2"
)
