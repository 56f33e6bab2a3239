"""The equations of section 2 and (14), (15), as printed, and what they become. Trusted, and shared.

Names: x0, v0 position and velocity at t0; v the velocity v_k before an impact, tau the time to the
next one; a, b for omega t_k, omega t_(k+1), psi, psi1 for psi_k, psi_(k+1); gamma = v/(omega_n p).
omega_n is also what is printed as w_n in (2). S8 is the left side of (8), S9 the right side of (9)
and so on. In the formulas of a flight t is the time psi1 - psi since the launch.
"""

from __future__ import annotations

from proofs.trusted.paper.s5_soft.displayed import HEIGHT4, SPEED5

# -- dimensional: (1)-(9) --------------------------------------------------------------------------

X2 = "x0*cos(omega_n*(t - t0)) + v0/omega_n*sin(omega_n*(t - t0))"
V3 = "v0*cos(omega_n*(t - t0)) - omega_n*x0*sin(omega_n*(t - t0))"
TABLE = "-p + beta*sin(omega*t)"
RESTITUTION = f"-(({SPEED5}) - beta*omega*cos(a))/(v - beta*omega*cos(a))"  # as epsilon is defined
S8 = (
    "(-p + beta*sin(a))*cos(omega_n*tau)"
    " + (-epsilon*v + (1 + epsilon)*beta*omega*cos(a))/omega_n*sin(omega_n*tau)"
    " + p - beta*sin(b)"
)
S9 = (
    "(omega_n*p - beta*omega_n*sin(a))*sin(omega_n*tau)"
    " + ((epsilon + 1)*beta*omega*cos(a) - epsilon*v)*cos(omega_n*tau)"
)
AT_IMPACT = f"t=t0 + tau, x0={HEIGHT4}, v0={SPEED5}"

# -- nondimensional: (10), (14), (15) --------------------------------------------------------------

RATIOS = "omega_n=eta*omega, beta=-nu*p"
SCALES = f"{RATIOS}, a=psi, tau=(psi1 - psi)/omega, v=eta*omega*p*gamma"
S10 = (
    "(1 + nu*sin(psi))*cos(eta*(psi1 - psi)) + nu/eta*cos(psi)*sin(eta*(psi1 - psi))"
    " - 1 - nu*sin(psi1)"
)
S14 = (
    "(1 + nu*sin(psi))*cos(eta*(psi1 - psi))"
    " + (epsilon*gamma + nu/eta*(1 + epsilon)*cos(psi))*sin(eta*(psi1 - psi))"
    " - 1 - nu*sin(psi1)"
)
S15 = (
    "(1 + nu*sin(psi))*sin(eta*(psi1 - psi))"
    " - (epsilon*gamma + nu/eta*(1 + epsilon)*cos(psi))*cos(eta*(psi1 - psi))"
)

# -- the flight: (10) and (14) as functions of t ---------------------------------------------------

PLASTIC = f"at({S10}, psi1=psi + t)"
REBOUND = f"at({S14}, psi1=psi + t)"
CLOSING = "(eta*gamma + nu*cos(psi))"  # minus the relative velocity before an impact
# The derivatives of (10) at the launch, from the second on; s = sin(psi).
BEND = "(nu*(1 - eta**2)*s - eta**2)"
JERK = "nu*(1 - eta**2)*cos(psi)"
SNAP = "(eta**4*(1 + nu*s) - nu*s)"

# Closed forms. At eta = 1, with K the relative velocity of the launch; at eta = 1/2 and eta = 2 a
# quadratic form in the sine and the cosine of a quarter, or a half, of t.
K = f"(epsilon*at({CLOSING}, eta=1))"
RESONANT = f"2*sin(t/2)*({K}*cos(t/2) - sin(t/2))"
HALF = (
    "-2*sin(t/4)**2*((1 + nu*sin(psi))*sin(t/4)**2 - 4*nu*cos(psi)*sin(t/4)*cos(t/4)"
    " + (1 - 3*nu*sin(psi))*cos(t/4)**2)"
)
TWICE = (
    "2*sin(t/2)**2*(nu*sin(psi)*sin(t/2)**2 - 2*nu*cos(psi)*sin(t/2)*cos(t/2)"
    " - (4 + 3*nu*sin(psi))*cos(t/2)**2)"
)

# -- separation: s = sin(omega t_s) ----------------------------------------------------------------

PULL = "-beta*omega**2*s"  # the acceleration of the table
PUSH = "-omega_n**2*(-p + beta*s)"  # that of a free mass where the table is
TABLE_SCALED, MASS_SCALED = "-nu/eta**2*s", "-1 - nu*s"  # the equation between them, as printed
SEPARATION = "eta**2/(nu*(1 - eta**2))"
