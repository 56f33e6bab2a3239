"""The truth about one motion to 100 digits: the paper's (10), (14), (15) typed again, in Arb.

Nothing is shared with what is tried, so that a slip in an equation shows as well.

The first impact is found by steps that cannot pass a zero. The mass is a harmonic oscillator of
amplitude A, so |d^k gap / dt^k| <= M_k = |nu| + eta^k A for k >= 2; where gap = g > 0 and gap' = v,
the gap is positive for the next (v + sqrt(v^2 + 2 M g)) / M, M = M_2, by Taylor. Once 4 M g < v^2
and v < 0, gap' < 0 on [t, t - 2 g / v] and gap < 0 at its end: one zero, and it is the first.
Few bits do for the steps far from zeros.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import factorial
from typing import Any

from proofs.benchmark.peers import Arithmetic, Range

BITS = 1200  # 100 digits, after what cancels next to a graze or to zero flight time
_FEW_BITS = 64
_RELATIVE = Fraction(1, 2**360)  # to which impact times are known: more than 100 digits
_SHORTER = 1 - Fraction(1, 2**20)  # of a step, for what rounding adds to it
_MOST_STEPS = 100_000
_CONSTANT = ("slope", "phase by phi", "phase by gamma", "velocity by phi", "velocity by gamma")


Ranges = dict[str, Range]


@dataclass(frozen=True)
class Truth:
    """Bounds of true values, by name; none of them, and a reason, where there is no value."""

    bounds: Ranges
    reason: str = ""


class Unknown(ArithmeticError):
    """The truth is out of reach: a touch, or too many steps."""


@dataclass(frozen=True)
class Launched:
    """The parameters of one flight, exact: plastic, or with (epsilon, gamma) before the impact."""

    eta: Fraction
    nu: Fraction
    phi: Fraction
    epsilon: Fraction = Fraction(0)
    gamma: Fraction | None = None


class Motion:
    """The flight after a launch; from another phase, if one is given."""

    def __init__(self, kernel: Arithmetic, given: Launched, phi: Any = None) -> None:
        self.kernel, self.given = kernel, given
        self.side = 1 if given.nu > 0 else -1
        self.eta, self.nu, self.epsilon = map(kernel.point, (given.eta, given.nu, given.epsilon))
        self.phi = kernel.point(given.phi) if phi is None else phi
        self.gamma = kernel.point(given.gamma or 0)
        height, speed = self._launch(self.phi, self.gamma)
        self.amplitude = kernel.call("sqrt", height * height + speed * speed)

    def _sincos(self, x: Any) -> tuple[Any, Any]:
        return self.kernel.call("sin", x), self.kernel.call("cos", x)

    def _launch(self, phi: Any, gamma: Any) -> tuple[Any, Any]:
        """Return the coefficients of cos(eta t) and sin(eta t) in (14)."""
        sin, cos = self._sincos(phi)
        speed = self.nu / self.eta * (1 + self.epsilon) * cos + self.epsilon * gamma
        return 1 + self.nu * sin, speed

    def after(self, phi: Any, gamma: Any, t: Any) -> tuple[Any, Any]:
        """Return side times the left side of (14), and the velocity by (15): numbers or series."""
        (height, speed), (s, c) = self._launch(phi, gamma), self._sincos(self.eta * t)
        gap = height * c + speed * s - 1 - self.nu * self._sincos(phi + t)[0]
        return self.side * gap, height * s - speed * c

    def most(self, order: int) -> Any:
        """Return M_order."""
        return abs(self.nu) + self.eta**order * self.amplitude

    def gap(self, t: Any, order: int) -> list[Any]:
        """Return the gap and its derivatives by time up to some order, at least 1."""
        time = self.kernel.series([t, self.kernel.point(1), *[self.kernel.point(0)] * (order - 1)])
        gap, _ = self.after(self.phi, self.gamma, time)
        return [self.kernel.coefficient(gap, k) * factorial(k) for k in range(order + 1)]

    def rates(self, t: Any, k: int) -> tuple[Any, Any]:
        """Return the derivatives of gap and velocity by phi, gamma or t."""
        at = [self.phi, self.gamma, t]
        at[k] = self.kernel.series([at[k], self.kernel.point(1)])
        gap, velocity = self.after(*at)
        return self.kernel.coefficient(gap, 1), self.kernel.coefficient(velocity, 1)

    def answers(self, t: Any) -> dict[str, Any]:
        """Return flight, phase, gamma and f' or DF at an impact, by implicit differentiation."""
        values = {"flight": t, "phase": self.phi + t}
        values["velocity"] = self.after(self.phi, self.gamma, t)[1]
        by_t, push = self.rates(t, 2)
        for k, name in enumerate(("phi", "gamma")):
            gap, velocity = self.rates(t, k)
            values[f"phase by {name}"] = 1 - k - gap / by_t
            values[f"velocity by {name}"] = velocity - gap / by_t * push
        if self.given.gamma is None:
            names = {"flight": "flight", "phase": "phase", "phase by phi": "slope"}
            return {new: values[old] for old, new in names.items()}
        return values


def first_impact(kernel: Arithmetic, given: Launched, horizon: Fraction) -> Truth:
    """Return the truth about the next impact, phases up to 2 pi; raise Unknown where it must."""
    with kernel.precision(BITS):
        motion = Motion(kernel, given)
        _, first, second = motion.gap(kernel.point(0), 2)
        rebounds = given.gamma is not None and given.epsilon != 0
        if rebounds and _sign(kernel, first) < 0:
            raise Unknown("an impossible state")
        sticks = not rebounds and _sign(kernel, second) < 0
        if sticks:
            leave = separation(kernel, given.eta, given.nu)
            if leave is None:
                return Truth({}, "the mass stays on the table")
            motion = Motion(kernel, Launched(given.eta, given.nu, given.phi), leave)
        time = _first_zero(motion, horizon, leaving=sticks)
        if time is None:
            return Truth({}, "no impact up to the horizon")
        values = motion.answers(time)
        if sticks:
            dwell = leave - kernel.point(given.phi)
            while _sign(kernel, dwell) < 0:  # the next time that the table is there
                dwell += 2 * kernel.pi()
            values |= dict.fromkeys(_CONSTANT, kernel.point(0)) | {"dwell": dwell}
        return Truth({name: kernel.ends(value) for name, value in values.items()})


def separation(kernel: Arithmetic, eta: Fraction, nu: Fraction) -> Any:
    """Return the phase at which a sticking mass leaves, where there is one."""
    if eta == 1:
        return None
    sine = eta**2 / (nu * (1 - eta**2))
    if abs(sine) >= 1:
        return None
    angle = kernel.call("asin", kernel.point(sine))
    return angle if eta < 1 else kernel.pi() - angle


def _sign(kernel: Arithmetic, x: Any) -> int:
    low, high = kernel.ends(x)
    return 1 if low > 0 else -1 if high < 0 else 0


def _first_zero(motion: Motion, horizon: Fraction, *, leaving: bool) -> Any:
    """Return the first t > 0 with gap = 0, or None; gap > 0 before it."""
    kernel = motion.kernel
    t = _start(motion, leaving)
    for bits in (_FEW_BITS, BITS):
        with kernel.precision(bits):
            t = _advanced(motion, t, horizon)
    if kernel.ends(t)[0] >= horizon:
        return None
    if _sign(kernel, motion.gap(t, 1)[0]) <= 0:
        raise Unknown("the gap touches 0 to within what is computed")
    return _polished(motion, t)


def _advanced(motion: Motion, t: Any, horizon: Fraction) -> Any:
    """Step to the horizon, or to where the gap falls to its first zero, or is not known to be > 0.

    M is M_2, or in the next t alone, where that is less, |gap''(t)| + M_3 t.
    """
    kernel = motion.kernel
    for _ in range(_MOST_STEPS):
        if kernel.ends(t)[0] >= horizon:
            return t
        height, rate, second = motion.gap(t, 2)
        if _sign(kernel, height) <= 0:
            return t
        bend = abs(second) + motion.most(3) * t
        near = _sign(kernel, motion.most(2) - bend) > 0
        bend = bend if near else motion.most(2)
        falls = _sign(kernel, rate) < 0 and _sign(kernel, 4 * bend * height - rate * rate) < 0
        if falls and not (near and _sign(kernel, 2 * height + rate * t) > 0):
            return t
        step = (rate + kernel.call("sqrt", rate * rate + 2 * bend * height)) / bend
        if near and _sign(kernel, step - t) > 0:
            step = t
        t = kernel.middle(t + step * kernel.point(_SHORTER))
    raise Unknown("too many steps")


def _start(motion: Motion, leaving: bool) -> Any:
    """Return a time up to which the gap is positive, by its Taylor polynomial at the launch."""
    kernel = motion.kernel
    _, first, second, third = motion.gap(kernel.point(0), 3)
    starts = []
    if leaving or (_sign(kernel, second) > 0 and _sign(kernel, third) > 0):
        starts.append(2 * third / motion.most(4))
    if not leaving and _sign(kernel, second) > 0:
        starts.append(3 * second / (2 * motion.most(3)))
    if not leaving and motion.given.gamma is not None and _sign(kernel, first) > 0:
        starts.append(first / motion.most(2))
    if not starts:
        raise Unknown("the launch itself is not decided")
    latest = max(starts, key=lambda t: kernel.ends(t)[0])
    return kernel.middle(latest * kernel.point(_SHORTER))


def _polished(motion: Motion, t: Any) -> Any:
    """Return the zero next to t, by Newton's method, its ends proved by the signs of the gap."""
    kernel = motion.kernel
    for _ in range(14):
        height, rate = motion.gap(t, 1)
        t = kernel.middle(t - height / rate)
    reach = abs(t) * kernel.point(_RELATIVE)
    signs = [_sign(kernel, motion.gap(end, 1)[0]) for end in (t - reach, t + reach)]
    if signs != [1, -1]:
        raise Unknown("the impact is too slow for 100 digits")
    return kernel.number(kernel.ends(t - reach)[0], kernel.ends(t + reach)[1])


# By eta and nu: phases, and times after them where gap = gap' = 0, before which gap > 0.
GRAZES = {
    ("0.2121", "-0.2"): "1.19998 25.874, 2.13648 5.152",
    ("0.9", "-0.3"): "2.04245 49.322, 2.30669 42.51, 2.60456 35.632, 2.94474 28.668, "
    "3.33137 21.612, 3.7621 14.467, 4.2276 7.253",
    ("1.7", "-0.9"): "0.01179 3.118, 1.4051 6.615, 1.47264 25.329, 1.83351 12.041, 2.40476 4.615",
    ("0.35", "-0.5"): "1.16952 13.369, 1.27043 32.017, 2.11154 5.202",
    ("1.4", "-2.3"): "0.38704 2.368, 0.51608 2.109",
}
_PLACES = [(*where, *each.split()) for where, near in GRAZES.items() for each in near.split(", ")]
_STEPS = 10


@cache
def graze(kernel: Arithmetic, number: int) -> tuple[Fraction, Fraction, Fraction]:
    """Return (eta, nu, phase) of one of the grazing launches, to 80 digits, by Newton's method."""
    eta, nu, *near = map(Fraction, _PLACES[number % len(_PLACES)])
    with kernel.precision(BITS):
        phase, time = map(kernel.point, near)
        for _ in range(_STEPS):
            motion = Motion(kernel, Launched(eta, nu, Fraction(0)), phase)
            height, rate, bend = motion.gap(time, 2)
            phase = kernel.middle(phase - height / motion.rates(time, 0)[0])
            time = kernel.middle(time - rate / bend)
        return eta, nu, _decimal(kernel, phase)


def separation_point(
    kernel: Arithmetic, eta: Fraction, nu: Fraction, *, beginning: bool = False
) -> Fraction:
    """Return the phase where a sticking mass leaves, or where sticking begins, to 80 digits."""
    with kernel.precision(BITS):
        phase = separation(kernel, eta, nu)
        if beginning:
            phase = kernel.pi() - phase
        return _decimal(kernel, phase if kernel.ends(phase)[0] >= 0 else phase + 2 * kernel.pi())


def _decimal(kernel: Arithmetic, x: Any) -> Fraction:
    return Fraction(round(kernel.ends(x)[0] * 10**80), 10**80)
