"""The truth about one motion to 100 digits: the paper's (10), (14), (15) typed again, in Arb.

The first impact is found by steps that cannot pass a zero. The mass is a harmonic oscillator of
amplitude A, so |d^k gap / dt^k| <= M_k = |nu| + eta^k A for k >= 2; where gap = g > 0 and gap' = v,
the gap is positive for the next (v + sqrt(v^2 + 2 M g)) / M, M = M_2, by Taylor. Once 4 M g < v^2
and v < 0, gap' < 0 on [t, t - 2 g / v] and gap < 0 at its end: one zero, and it is the first.
While the gap is large the steps are floats, 2 % shorter: with Arb, too, this is a check and no
proof.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from proofs.benchmark.peers import Arithmetic
from proofs.stress.cases import Truth

BITS = 1200  # 100 digits, after what cancels next to a graze or to zero flight time
_RELATIVE = Fraction(1, 2**360)  # to which impact times are known: more than 100 digits
_SHORTER = 1 - Fraction(1, 2**20)  # of a step, for what rounding adds to it
_MOST_STEPS = 4000
_CONSTANT = ("slope", "phase by phi", "phase by gamma", "velocity by phi", "velocity by gamma")
_FLOAT_STEPS = 400_000


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
    """The flight with position (1 + nu sin phi) cos(eta t) + c sin(eta t), as in (14)."""

    def __init__(self, kernel: Arithmetic, of: Launched, phi: Any = None) -> None:
        self.kernel, self.of = kernel, of
        self.side = 1 if of.nu > 0 else -1
        self.eta, self.nu = kernel.point(of.eta), kernel.point(of.nu)
        self.phi = kernel.point(of.phi) if phi is None else phi
        self.sin, self.cos = self._sincos(self.phi)
        self.height = 1 + self.nu * self.sin
        self.restitution = kernel.point(of.epsilon)
        self.speed = self.nu / self.eta * self.cos
        if of.gamma is not None:
            self.speed = self.speed * (1 + self.restitution)
            self.speed += self.restitution * kernel.point(of.gamma)
        self.amplitude = kernel.call("sqrt", self.height * self.height + self.speed * self.speed)

    def _sincos(self, x: Any) -> tuple[Any, Any]:
        return self.kernel.call("sin", x), self.kernel.call("cos", x)

    def most(self, order: int) -> Any:
        """Return M_order."""
        return abs(self.nu) + self.eta**order * self.amplitude

    def gap(self, t: Any, order: int = 0) -> Any:
        """Return side times the left side of (14), or its time derivative of an order up to 3."""
        s, c = self._sincos(self.eta * t)
        table = self._sincos(self.phi + t)[order % 2]
        mass = (self.height * c + self.speed * s, self.speed * c - self.height * s)[order % 2]
        sign = 1 if order < 2 else -1
        distance = sign * (self.eta**order * mass - self.nu * table)
        return self.side * (distance if order else distance - 1)

    def answers(self, t: Any) -> dict[str, Any]:
        """Return flight, phase, and f' or gamma and DF, at an impact, by implicit differentiation.

        The gap's derivatives by t, phi and gamma; those of the time follow, then (15).
        """
        s, c = self._sincos(self.eta * t)
        table = self.nu * self.kernel.call("cos", self.phi + t)
        by_t = self.eta * (self.speed * c - self.height * s) - table
        share = 1 if self.of.gamma is None else 1 + self.restitution
        speed_by_phi = -self.nu / self.eta * self.sin * share
        by_phi = self.nu * self.cos * c + speed_by_phi * s - table
        found = {"flight": t, "phase": self.phi + t}
        found["velocity"] = self.height * s - self.speed * c
        if self.of.gamma is None:
            return found | {"slope": 1 - by_phi / by_t}
        time_by_phi, time_by_gamma = -by_phi / by_t, -self.restitution * s / by_t
        pull = self.eta * (self.height * c + self.speed * s)
        return found | {
            "phase by phi": 1 + time_by_phi,
            "phase by gamma": time_by_gamma,
            "velocity by phi": self.nu * self.cos * s - speed_by_phi * c + time_by_phi * pull,
            "velocity by gamma": -self.restitution * c + time_by_gamma * pull,
        }


def first_impact(kernel: Arithmetic, of: Launched, horizon: Fraction) -> Truth:
    """Return the truth about the next impact, phases up to 2 pi; raise Unknown where it must."""
    with kernel.precision(BITS):
        motion = Motion(kernel, of)
        first, second = (_sign(kernel, motion.gap(kernel.point(0), k)) for k in (1, 2))
        if of.gamma is not None and of.epsilon != 0 and first < 0:
            raise Unknown("an impossible state")
        sticks = (of.gamma is None or of.epsilon == 0) and second < 0
        if sticks:
            leave = separation(kernel, of.eta, of.nu)
            if leave is None:
                return Truth({}, "the mass stays on the table")
            motion = Motion(kernel, Launched(of.eta, of.nu, of.phi), leave)
        time = _first_zero(motion, horizon, leaving=sticks)
        if time is None:
            return Truth({}, "no impact up to the horizon")
        found = motion.answers(time)
        if sticks:
            dwell = leave - kernel.point(of.phi)
            while _sign(kernel, dwell) < 0:  # the next time that the table is there
                dwell += 2 * kernel.pi()
            found |= dict.fromkeys(_CONSTANT, kernel.point(0)) | {"dwell": dwell}
        return Truth({name: kernel.ends(value) for name, value in found.items()})


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
    """Return the first t > 0 with gap = 0, or None; gap > 0 before it.

    M is M_2, or in the next t alone, where that is less, |gap''(t)| + M_3 t.
    """
    kernel = motion.kernel
    t = _start(motion, leaving)
    for _ in range(_MOST_STEPS):
        t = _coast(motion, t, horizon)
        if kernel.ends(t)[0] >= horizon:
            return None
        gap, rate = motion.gap(t), motion.gap(t, 1)
        if _sign(kernel, gap) <= 0:
            raise Unknown("the gap touches 0 to within what is computed")
        bend = abs(motion.gap(t, 2)) + motion.most(3) * t
        near = _sign(kernel, motion.most(2) - bend) > 0
        bend = bend if near else motion.most(2)
        falls = _sign(kernel, rate) < 0 and _sign(kernel, 4 * bend * gap - rate * rate) < 0
        if falls and not (near and _sign(kernel, 2 * gap + rate * t) > 0):
            return _polished(motion, t)
        step = (rate + kernel.call("sqrt", rate * rate + 2 * bend * gap)) / bend
        if near and _sign(kernel, step - t) > 0:
            step = t
        t = kernel.middle(t + step * kernel.point(_SHORTER))
    raise Unknown("too many steps")


def _start(motion: Motion, leaving: bool) -> Any:
    """Return a time up to which the gap is positive, by its Taylor polynomial at the launch."""
    kernel = motion.kernel
    first, second, third = (motion.gap(kernel.point(0), k) for k in (1, 2, 3))
    starts = []
    if leaving or (_sign(kernel, second) > 0 and _sign(kernel, third) > 0):
        starts.append(2 * third / motion.most(4))
    if not leaving and _sign(kernel, second) > 0:
        starts.append(3 * second / (2 * motion.most(3)))
    if not leaving and motion.of.gamma is not None and _sign(kernel, first) > 0:
        starts.append(first / motion.most(2))
    if not starts:
        raise Unknown("the launch itself is not decided")
    latest = max(starts, key=lambda t: kernel.ends(t)[0])
    return kernel.middle(latest * kernel.point(_SHORTER))


def _coast(motion: Motion, start: Any, horizon: Fraction) -> Any:
    """Take the long steps in floats, 2 % shorter, while the gap is far above their rounding."""
    try:
        eta, nu, phi, height, speed, bend, begin = (
            _float(motion.kernel, x)
            for x in (motion.eta, motion.nu, motion.phi, motion.height, motion.speed,
                      motion.most(2), start)
        )  # fmt: skip
    except OverflowError:
        return start
    t, safe = begin, begin
    for _ in range(_FLOAT_STEPS):
        s, c = math.sin(eta * t), math.cos(eta * t)
        gap = motion.side * (height * c + speed * s - 1 - nu * math.sin(phi + t))
        size = abs(height) + abs(nu) + abs(speed) * min(1.0, eta * t) + 1
        if not gap > 1e-4 * size:
            break
        safe = t
        if t > float(horizon):
            break
        rate = motion.side * (eta * (speed * c - height * s) - nu * math.cos(phi + t))
        t += 0.98 * (rate + math.sqrt(rate * rate + 1.9 * bend * gap)) / bend
    return motion.kernel.point(Fraction(safe)) if safe > begin else start


def _float(kernel: Arithmetic, x: Any) -> float:
    return float(sum(kernel.ends(x)) / 2)


def _polished(motion: Motion, t: Any) -> Any:
    """Return the zero next to t, by Newton's method, its ends proved by the signs of the gap."""
    kernel = motion.kernel
    for _ in range(14):
        t = kernel.middle(t - motion.gap(t) / motion.gap(t, 1))
    reach = abs(t) * kernel.point(_RELATIVE)
    signs = [_sign(kernel, motion.gap(end)) for end in (t - reach, t + reach)]
    if signs != [1, -1]:
        raise Unknown("the impact is too slow for 100 digits")
    return kernel.number(kernel.ends(t - reach)[0], kernel.ends(t + reach)[1])
