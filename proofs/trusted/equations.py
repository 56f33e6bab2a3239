"""The equations of the impact oscillator, each written once, for every number type.

Scaled as in the paper: time psi = omega t, lengths in units of -p, nu = -beta / p,
eta = omega_n / omega. The mass is at x, the table at z = 1 + nu sin(psi). An impact at phase
phi starts a flight; t >= 0 is the time since then. Equations (8)-(10), (14) and (15) are one
statement: the mass is a harmonic oscillator of frequency eta about 0, the table one of
frequency 1 about 1, both start at the same place, and their distance vanishes at the impact.

Numbers are anything with + - * / and `sincos()`: Interval, IntervalArray, Jet, the checker's
own. Other types (floats, sympy's) are entered in `registered_sincos`.
"""

from __future__ import annotations

from functools import singledispatch
from typing import Any, NamedTuple

Number = Any


def sincos(x: Number) -> tuple[Number, Number]:
    """Return (sin x, cos x) by the number's own method, else as its type is registered."""
    own = getattr(x, "sincos", None)
    pair: tuple[Number, Number] = registered_sincos(x) if own is None else own()
    return pair


@singledispatch
def registered_sincos(x: Number) -> tuple[Number, Number]:
    """Return (sin x, cos x) for numbers of other libraries."""
    raise TypeError(f"no sine of {type(x).__name__}")


class Launch(NamedTuple):
    """The state right after an impact at phase phi.

    lift = nu sin(phi): the table above its mean; rate = nu cos(phi): its velocity; kick: the
    velocity of the mass relative to the table, None (exactly 0) after a plastic impact. side:
    the sign of nu, +1 or -1; p > 0 exactly if nu < 0, and x - z > 0 means side (X - Z) > 0 for
    the scaled X, Z.
    """

    side: int
    eta: Number
    lift: Number
    rate: Number
    kick: Number | None = None


class Clock(NamedTuple):
    """sin(eta t), cos(eta t), sin(t), cos(t) at a time t of the flight."""

    mass_sin: Number
    mass_cos: Number
    table_sin: Number
    table_cos: Number


AT_LAUNCH = Clock(0, 1, 0, 1)


def launch(side: int, eta: Number, nu: Number, phi: Number) -> Launch:
    """Return the state after a plastic impact, epsilon = 0: mass and table move as one."""
    sin, cos = sincos(phi)
    return Launch(side, eta, nu * sin, nu * cos)


def launch_with_restitution(
    side: int, eta: Number, nu: Number, phi: Number, *, epsilon: Number, gamma: Number
) -> Launch:
    """Return the state after an impact with velocity gamma = v / (omega_n p) of the mass.

    Source: (5). The relative velocity before the impact, -eta gamma - nu cos(phi) in scaled
    units, is multiplied by -epsilon.
    """
    plastic = launch(side, eta, nu, phi)
    return plastic._replace(kick=epsilon * closing(plastic, gamma))


def closing(start: Launch, gamma: Number) -> Number:
    """Return -(X' - Z') = eta gamma + rate before an impact with velocity gamma.

    There gap' = -side closing, and gap > 0 before it: the state (phi, gamma) is possible only
    if side closing >= 0, else the mass would come from inside the table. Then the launch has
    gap' = side kick = epsilon side closing >= 0.
    """
    return start.eta * gamma + start.rate


def clock(eta: Number, t: Number) -> Clock:
    """Return the four functions of time that a flight is made of."""
    return Clock(*sincos(eta * t), *sincos(t))


def gap(start: Launch, now: Clock, order: int = 0) -> Number:
    """Return the distance x - z (in units of |p|), or its time derivative of the given order.

    Source: (10) and (14), with 1 + nu sin(psi_k + t) expanded by the addition theorem, so that
    phase and time separate; derivatives (order 1: relative velocity, 2: acceleration, ...) by
    (d/dt)^k cos(wt) = w^k cos(wt + k pi/2). Flight means gap > 0, an impact gap = 0.
    """
    side, eta, lift, rate, kick = start
    mass_sin, mass_cos, table_sin, table_cos = now
    for _ in range(order % 4):
        mass_cos, mass_sin, table_cos, table_sin = -mass_sin, mass_cos, -table_sin, table_cos
    if order == 0:
        mass_sin = mass_sin / eta
    elif order == 1:
        mass_cos = eta * mass_cos
    else:
        scale = eta ** (order - 1)
        mass_cos, mass_sin = eta * scale * mass_cos, scale * mass_sin
    total = lift * (mass_cos - table_cos) + rate * (mass_sin - table_sin) + mass_cos
    if order == 0:
        total = total - 1
    if kick is not None:
        total = total + kick * mass_sin
    return total if side > 0 else -total


def launch_acceleration(start: Launch) -> Number:
    """Return the relative acceleration at launch: the plastic mass sticks where it is < 0.

    It is side * (nu (1 - eta^2) sin(phi) - eta^2), so it vanishes at the paper's phi_s.
    """
    return gap(start._replace(kick=None), AT_LAUNCH, 2)


def slope(start: Launch, now: Clock, fall: Number | None = None) -> Number:
    """Return the derivative f' of the plastic impact map at an impact `now` after `start`.

    fall: gap' there, if it is known better than by `gap`.

    Theorem. Let g(phi, t) be the plastic gap. Then dg/dt - dg/dphi = sin(eta t) / eta times the
    launch acceleration, and where g = 0 and dg/dt < 0, the next impact phase phi + t(phi) has
    derivative 1 - (dg/dphi) / (dg/dt) = (sin(eta t) / eta) launch_acceleration / (dg/dt). Proof.
    The terms with cos(eta t), and those of the table, cancel in the difference.
    """
    if fall is None:
        fall = gap(start, now, 1)
    return now.mass_sin / start.eta * launch_acceleration(start) / fall


def inverse_slope(start: Launch, now: Clock, fall: Number | None = None) -> Number:
    """Return 1 / f', which is 0 where the impact grazes: `slope` upside down.

    Its sign is that of -sin(eta t), where the mass leaves and the impact is transversal.
    """
    if fall is None:
        fall = gap(start, now, 1)
    return fall / (now.mass_sin / start.eta * launch_acceleration(start))


def inverse_bend(start: Launch, now: Clock, first: Number) -> Number:
    """Return the derivative of 1 / f' in the image y = f(phi); first: 1 / f' there.

    Theorem. Let X be an inverse branch of f, G(x, y) = g(x, y - x) the plastic gap at the phase y
    after a launch at x, and A, S, C the launch acceleration, sin(eta t), cos(eta t). By `slope`
    G_x = -(S / eta) A, so that G_xx = C A - (S / eta) A' and G_xy = -C A; G_yy = g_tt; and at
    launch A' = g_ttt. From G(X(y), y) = 0: X'' = -(G_yy + 2 G_xy X' + G_xx X'^2) / G_x.
    """
    push, sine = launch_acceleration(start), now.mass_sin / start.eta
    turn = now.mass_cos * push
    change = gap(start._replace(kick=None), AT_LAUNCH, 3)
    bent = gap(start, now, 2) + first * (first * (turn - sine * change) - 2 * turn)
    return bent / (sine * push)


def arrival(start: Launch, now: Clock) -> tuple[Number, Number]:
    """Return the mass's position X and velocity gamma = -X' / eta at a time of its flight.

    Source: (15) is the second one at the impact.
    """
    speed = start.rate if start.kick is None else start.rate + start.kick
    height, speed = 1 + start.lift, speed / start.eta
    return (
        height * now.mass_cos + speed * now.mass_sin,
        height * now.mass_sin - speed * now.mass_cos,
    )


def return_map_derivative(
    start: Launch, now: Clock, epsilon: Number
) -> tuple[tuple[Number, Number], tuple[Number, Number]]:
    """Return DF, rows (phase, velocity) by columns (phi, gamma), at an impact `now` after `start`.

    Theorem. Let S, C = sin(eta t), cos(eta t), K = kick and a = nu sin(phi) (1 + epsilon) -
    eta^2 (1 + nu sin(phi)). With D = d/dt - d/dphi, D Z = 0, D X = a S/eta + K C and
    D X' = a C - eta K S, since dK/dphi = -epsilon lift; dX/dgamma = epsilon S and
    dX'/dgamma = epsilon eta C. Where gap = 0 > gap', the impact phase phi + t has the derivatives
    p = side D X / gap' and q = -side epsilon S / gap', and X'' = -eta^2 X gives those of
    gamma = -X'/eta: eta X p + (D X')/eta and eta X q - epsilon C. For epsilon = 0, p is `slope`.
    """
    push = start.side * launch_acceleration(start) + epsilon * start.lift
    side, eta, _, _, kick = start
    big_s, big_c = now.mass_sin, now.mass_cos
    fall = side * gap(start, now, 1)
    along = push / eta
    moved, turned = along * big_s, along * big_c
    if kick is not None:
        moved, turned = moved + kick * big_c, turned - kick * big_s
    by_phi, by_gamma = moved / fall, -(epsilon * big_s) / fall
    pull = eta * arrival(start, now)[0]
    return (by_phi, by_gamma), (pull * by_phi + turned, pull * by_gamma - epsilon * big_c)
