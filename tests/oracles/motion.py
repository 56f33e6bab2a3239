"""The paper's oscillator, from the paper's text alone (sections 2, 3.3), to judge conclusions by.

Scaled as there: time psi = omega t, X = -x/p, Z = -z/p = 1 + nu sin(psi), nu = -beta/p,
eta = omega_n/omega. As p > 0 exactly if nu < 0, the mass is above the table where
side (X - Z) > 0, side = sign(nu). After an impact at phase phi, by (14),
X(t) = (1 + nu sin phi) cos(eta t) + (epsilon gamma + nu/eta (1 + epsilon) cos phi) sin(eta t).

A first impact is found by marching: while gap > 0, by Taylor's formula with bounds on gap''',
no step goes over a zero. It is done in floats with a margin, and again in Arb balls where a float
does not decide; None means that no decision was reached.
"""

import math
from fractions import Fraction
from functools import lru_cache

import flint
import numpy as np

PRECISION = 240
LATEST = 2000.0  # the longest flight that is followed, unless more is asked for
TURN = 2 * math.pi
_SHORT, _STEP = 60.0, TURN / 32  # after so long a time, a scan with this step comes first


def ball(x):
    """An Arb ball around a rational, a float (exact) or a ball."""
    if isinstance(x, flint.arb):
        return x
    x = Fraction(x)
    with flint.ctx.workprec(PRECISION):
        return flint.arb(x.numerator) / x.denominator


def two_pi():
    with flint.ctx.workprec(PRECISION):
        return 2 * flint.arb.pi()


class _Floats:
    """Numbers of one kind: how to make them and their circular functions; the margin of a sign."""

    make, sin, cos, margin = float, math.sin, math.cos, 1e-10


class _Balls:
    make, margin = staticmethod(ball), 1e-45

    @staticmethod
    def sin(x):
        return x.sin()

    @staticmethod
    def cos(x):
        return x.cos()


class Gap:
    """The gap after an impact, side (X - Z), and its derivatives, in one kind of numbers."""

    def __init__(self, kind, eta, nu, phi, epsilon=0, gamma=0):
        make = kind.make
        eta, nu, phi, epsilon, gamma = map(make, (eta, nu, phi, epsilon, gamma))
        self.kind, self.eta, self.nu, self.phi = kind, eta, nu, phi
        self.side = 1 if nu > 0 else -1
        self.height = 1 + nu * kind.sin(phi)
        self.speed = epsilon * gamma + nu / eta * (1 + epsilon) * kind.cos(phi)
        size = abs(float(self.height)) + abs(float(self.speed))
        self.third = float(eta) ** 3 * size + abs(float(nu))

    def mass(self, t):
        """X and X' at a time."""
        s, c = self.kind.sin(self.eta * t), self.kind.cos(self.eta * t)
        return (
            self.height * c + self.speed * s,
            self.eta * (self.speed * c - self.height * s),
        )

    def at(self, t):
        """gap, gap', gap'' at a time."""
        x, v = self.mass(t)
        s, c = self.kind.sin(self.phi + t), self.kind.cos(self.phi + t)
        return (
            self.side * (x - 1 - self.nu * s),
            self.side * (v - self.nu * c),
            self.side * (-self.eta * self.eta * x + self.nu * s),
        )

    def start(self):
        """gap', gap'', gap''' right after the impact."""
        s, c = self.kind.sin(self.phi), self.kind.cos(self.phi)
        square = self.eta * self.eta
        return (
            self.side * (self.eta * self.speed - self.nu * c),
            self.side * (self.nu * s - square * self.height),
            self.side * (self.nu * c - square * self.eta * self.speed),
        )


def _leaves(gap, released):
    """A time up to which gap > 0; None where the mass does not leave at once, or it is undecided.

    released: gap' and gap'' are 0 by hypothesis (the separation phase).
    """
    slope, bend, third = map(float, gap.start())
    fourth = float(gap.eta) ** 4 * (abs(float(gap.height)) + abs(float(gap.speed)))
    fourth += abs(float(gap.nu))
    if released:
        return 3 * third / fourth if third > 0 else None
    small = 1e-12 if gap.kind is _Floats else 1e-60
    if slope < -small or (abs(slope) <= small and bend < small):
        return None
    if slope > small:  # gap >= slope t + bend t^2/2 - third t^3/6, at t up to 1
        return min(1.0, slope / (2 * max(0.0, -bend) + gap.third))
    # gap >= t^2 (bend/2 + third t/6 - fourth t^2/24)
    return min(1.0, math.sqrt(6 * bend / fourth) if third >= 0 else bend / (-third + fourth))


def _suspects(gap, t, latest):
    """The times from t on, on a grid, that a coarse scan does not exclude: for long flights.

    Below the table's extreme at nu < 0 (above it at nu > 0) there is no impact: so the scan
    visits, of each oscillation R cos(eta t - delta) of the mass, only the times when it gets there.
    """
    eta, nu, side = float(gap.eta), float(gap.nu), gap.side
    height, speed = float(gap.height), float(gap.speed)
    size = math.hypot(height, speed)
    limit = (size * eta**2 + abs(nu)) * _STEP**2 / 8 + 1e-8
    middle = math.atan2(speed, height) + (math.pi if side > 0 else 0)  # of the times near the table
    ratio = (-1 - nu if side > 0 else 1 + nu) / size - 1e-9
    if ratio >= 1:
        return
    reach = math.acos(max(-1.0, ratio)) / eta + _STEP
    offsets = np.arange(-reach, reach + _STEP, _STEP)
    first = math.floor((eta * (t - reach - _STEP) - middle) / TURN)
    last = math.ceil((eta * (latest + reach) - middle) / TURN) + 1
    rows = max(1, 20_000 // len(offsets))
    for begin in range(first, last, rows):
        peaks = (middle + TURN * np.arange(begin, min(last, begin + rows))) / eta
        times = (peaks[:, None] + offsets[None, :]).ravel()
        mass = height * np.cos(eta * times) + speed * np.sin(eta * times)
        near = side * (mass - 1 - nu * np.sin(float(gap.phi) + times)) <= limit
        yield from np.sort(times[near & (times >= t - 3 * _STEP)]).tolist()


def _march(gap, t, latest):
    """A bracket (t, t') of the first zero, gap falling in it; "none" up to latest; or None."""
    margin, third = gap.kind.margin, gap.third
    make, suspects, suspect = gap.kind.make, None, 0.0
    for _ in range(20_000):
        if t > _SHORT:
            suspects = suspects or _suspects(gap, t, latest)
            while suspect < t - 3 * _STEP:
                suspect = next(suspects, 2 * latest)
            t = max(t, suspect - 3 * _STEP)
        if t > latest:
            return "none"
        value, slope, bend = map(float, gap.at(make(t)))
        if value <= margin:
            return None
        if slope < 0:
            h = -2 * value / slope
            falls = slope + max(bend, 0.0) * h + third * h * h / 2 < 0
            if falls and float(gap.at(make(t + h))[0]) < -margin:
                return t, t + h
        # gap >= the cubic below at t + h; or, while bend h/4 >= third h^2/12, a parabola
        h, down, bent = 1.0, min(slope, 0.0), min(bend, 0.0) / 2
        while value - margin / 2 + h * (down + h * (bent - h * third / 6)) <= 0:
            h *= 0.7
        if bend > 0 and (slope >= 0 or slope * slope < bend * (value - margin)):
            h = max(h, 1.5 * bend / third)
        if h < 1e-14 * max(1.0, t):
            return None
        t += h
    return None


def _refined(gap, bracket):
    """The zero in a bracket, where the gap falls, as a ball (Newton, then signs prove it)."""
    low, high = map(ball, bracket)
    t = (low + high) / 2
    for _ in range(60):
        value, slope, _ = gap.at(t)
        step = (value / slope).mid()
        t = (t - step).mid()
        if not low < t < high:  # bisection instead
            t = ((low + high) / 2).mid()
            if gap.at(t)[0] > 0:
                low = t
            else:
                high = t
        elif abs(step) < flint.arb(2) ** (20 - PRECISION):
            break
    width = flint.arb(2) ** (30 - PRECISION) * (1 + abs(1 / slope))
    while width < 1e-9:  # wider, where the launch itself is not known so well
        if gap.at(t - width)[0] > 0 > gap.at(t + width)[0]:
            return t + flint.arb(0, width)
        width *= 1024
    return None


class Impact:
    """The first impact after a launch: time (a ball), phase on the line, and derivatives there."""

    def __init__(self, gap, epsilon, time):
        self.gap, self.epsilon, self.time = gap, ball(epsilon), time
        self.lifted = gap.phi + time
        self.speed = -gap.at(time)[1]  # relative, before the impact
        self.velocity = -gap.mass(time)[1] / gap.eta  # gamma, by (15)

    @property
    def phase(self):
        """The phase in [0, 2 pi), as a float."""
        return float(self.lifted) % TURN

    def turned(self, turns):
        """The phase on the line, less a number of turns, as a ball."""
        with flint.ctx.workprec(PRECISION):
            return self.lifted - turns * two_pi()

    def derivative(self):
        """DF by implicit differentiation of (14), (15): rows (phase, gamma) by (phi, gamma)."""
        with flint.ctx.workprec(PRECISION):
            return self._derivative()

    def _derivative(self):
        g, e, t = self.gap, self.epsilon, self.time
        s, c = (g.eta * t).sin(), (g.eta * t).cos()
        rise, turned = g.nu * g.phi.cos(), -g.nu / g.eta * (1 + e) * g.phi.sin()
        moved = rise * c + turned * s, e * s  # dX by phi, by gamma
        faster = g.eta * (turned * c - rise * s), g.eta * e * c  # dX'
        table = g.nu * self.lifted.cos()
        fall, pull = g.mass(t)[1] - table, -g.eta * g.eta * g.mass(t)[0]
        later = (table - moved[0]) / fall, -moved[1] / fall
        return (
            (1 + later[0], later[1]),
            tuple(-(f + pull * d) / g.eta for f, d in zip(faster, later, strict=True)),
        )

    @property
    def slope(self):
        """f' after a plastic launch."""
        return self.derivative()[0][0]


def flight(eta, nu, phi, epsilon=0, gamma=0, latest=LATEST, released=False):
    """The first impact after a launch; or "sticks", "none" (up to latest), "touches"; or None.

    After a plastic impact mass and table are, if eta = p/q, after q turns where they were, and as
    fast: where there is no impact before, the mass touches the table then. None: undecided.
    """
    back = TURN * Fraction(eta).denominator if epsilon == 0 else math.inf
    last = "touches" if back < latest else "none"
    latest = min(float(latest), back - 1e-3)
    with flint.ctx.workprec(PRECISION):
        found = None
        for kind in (_Floats, _Balls):
            if kind is _Floats and released:
                continue
            gap = Gap(kind, eta, nu, phi, epsilon, gamma)
            slope, bend, _ = map(float, gap.start())
            if not released and slope < 1e-12 and bend < -1e-9:
                return "sticks"
            begin = _leaves(gap, released)
            if begin is None:
                if kind is _Balls and slope < 1e-40 and bend < 0:
                    return "sticks"
                continue
            found = _march(gap, begin, float(latest))
            if found is not None:
                break
        if found is None or found == "none":
            return found and last
        exact = gap if kind is _Balls else Gap(_Balls, eta, nu, phi, epsilon, gamma)
        time = _refined(exact, found)
        return None if time is None else Impact(exact, epsilon, time)


def separation(eta, nu):
    """phi_s in [0, 2 pi), where a sticking mass leaves the table; None if there is none.

    sin(phi_s) = eta^2/(nu (1 - eta^2)), and the launch acceleration, 0 there, increases.
    """
    with flint.ctx.workprec(PRECISION):
        eta, nu = ball(eta), ball(nu)
        if eta == 1:
            return None
        sine = eta * eta / (nu * (1 - eta * eta))
        if not abs(sine) < 1:
            return None
        angle = sine.asin()  # cos > 0
        if eta > 1:
            angle = flint.arb.pi() - angle
        return angle if angle > 0 else angle + two_pi()


def sticks(eta, nu, phi):
    """Whether the table pushes the mass at rest at a phase: the launch acceleration is < 0."""
    eta, nu, phi = float(eta), float(nu), float(phi)
    push = nu * (1 - eta * eta) * math.sin(phi) - eta * eta
    return (push if nu > 0 else -push) < 0


@lru_cache(maxsize=4096)
def _next(eta, nu, phi, latest):
    found = flight(eta, nu, phi, latest=latest)
    if found == "sticks":
        away = separation(eta, nu)
        return "rests" if away is None else flight(eta, nu, away, latest=latest, released=True)
    return found


def next_impact(eta, nu, phi, latest=LATEST):
    """f of section 2: the next impact, after the separation where the mass sticks; or a word."""
    find = _next.__wrapped__ if isinstance(phi, flint.arb) else _next
    return find(eta, nu, phi, float(latest))


def orbit(eta, nu, phi, count, latest=LATEST):
    """The phases phi, f(phi), ... in [0, 2 pi) as floats, until undecided or none is left."""
    phases = [float(phi) % TURN]
    for _ in range(count):
        found = next_impact(eta, nu, Fraction(phases[-1]), latest)
        if not isinstance(found, Impact):
            break
        phases.append(found.phase)
    return phases


def inside(x, bounds, slack=0.0):
    """False only if a ball certainly lies outside of exact bounds."""
    with flint.ctx.workprec(PRECISION):
        low, high = (ball(end) for end in bounds)
        return not (x < low - slack or x > high + slack)


def inside_mod(x, bounds, slack=0.0):
    """False only if a phase on the line certainly lies outside of bounds mod 2 pi."""
    with flint.ctx.workprec(PRECISION):
        first = math.floor((float(bounds[0]) - float(x)) / TURN)
        return any(inside(x + (first + k) * two_pi(), bounds, slack) for k in (0, 1, 2))
