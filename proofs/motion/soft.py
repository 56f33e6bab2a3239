"""Section 5, soft springs: fixed points and orbits of period 2 of the impact equations, enclosed.

The equations are (24), (25) with k = omega_n / omega, q = 2 omega^2 p / g, rho = 2 omega^2 beta /
g, lambda = 2 omega v / g, and their limit for k = 0; flights go over m table periods, c = 2 pi m.

Fixed points. Let r = (1 - epsilon) / (1 + epsilon), w = tan(pi m k) / k, pi m for k = 0. For each a
with B = 2 + k^2 (a - q) > 0 there is one with rho sin psi = a: rho cos psi = r w B, lambda = -w B.
So rho^2 is a quadratic in a, least at a = -(r w k)^2 (2 - k^2 q) / (1 + (r w k^2)^2), where B > 0:
the saddle-node. The eigenvalue -1 is at a = M (2 - k^2 q) / ((1 + epsilon)^2 (1 + C) - k^2 M), C =
cos(2 pi m k), M = (1 + epsilon)^2 + 2 (1 + epsilon^2) + (1 - epsilon)^2 C. Proof. Claims S10, S18.

Period 2. For each d there is one motion psi, psi + d, psi, ... with flights of c + d and c - d,
where a determinant is not 0: with rho cos(psi + d/2), rho sin(psi + d/2) and the two velocities as
unknowns the four equations are linear.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from typing import NamedTuple

from intervals import Interval, Undecided, cos, sqrt, tan
from proofs.methods.formulas import Intervals, Matrix, Values, dot
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.paper.s5_soft import displayed as eq

Gap = Callable[[Interval, int], Interval]  # of the time, and the order of a derivative


class State(NamedTuple):
    """Phase and velocity at an impact."""

    psi: Interval
    lam: Interval


@dataclass(frozen=True)
class Motion:
    """A periodic motion at rho: its impacts; `time` of the flight from each to the next."""

    rho: Interval
    impacts: tuple[State, ...]
    times: tuple[Interval, ...]


@cache
def _equations(limit: bool) -> Formulas:
    """Return (24) and the velocity of (25), scaled."""
    texts = (eq.MAP, eq.VELOCITY) if limit else (eq.STIFF_MAP, eq.STIFF_VELOCITY)
    return read_formulas(*map(Reader, texts))


@dataclass(frozen=True)
class Springs:
    """m >= 1, 0 <= epsilon < 1, 0 <= k < 1 / (2 m), k^2 q < 2: exact; the bits of enclosures."""

    m: int
    epsilon: Fraction
    k: Fraction
    q: Fraction
    bits: int

    def exact(self, value: Fraction | int) -> Interval:
        """Return a number as an interval."""
        return Interval(value, precision=self.bits)

    @cached_property
    def period(self) -> Interval:
        """The time c of m table periods."""
        return Interval.pi(precision=self.bits) * (2 * self.m)

    @cached_property
    def tangent(self) -> Interval:
        """The w of fixed points."""
        return tan(self.period * self.k / 2) / self.k if self.k else self.period / 2

    @property
    def ratio(self) -> Fraction:
        """The r of fixed points."""
        return (1 - self.epsilon) / (1 + self.epsilon)

    # -- fixed points ------------------------------------------------------------------------------

    def bend(self, height: Interval) -> Interval:
        """Return the B of the fixed point with rho sin psi = height."""
        return (height - self.q) * self.k**2 + 2

    def fixed(self, height: Interval) -> Motion:
        """Return the fixed point with rho sin psi = height, where B > 0."""
        speed = self.tangent * self.bend(height)
        across = speed * self.ratio
        rho = sqrt(across.sqr() + height.sqr())
        return Motion(rho, (State(height.atan2(across), -speed),), (self.period,))

    @property
    def saddle_node(self) -> Motion:
        """The fixed point with the least rho."""
        reach = self.tangent * self.ratio * self.k
        return self.fixed(-reach.sqr() * (2 - self.k**2 * self.q) / ((reach * self.k).sqr() + 1))

    @property
    def flip(self) -> Motion | None:
        """The fixed point with the eigenvalue -1, None if there is none with B > 0."""
        turn = cos(self.period * self.k)
        plus, minus = (1 + self.epsilon) ** 2, (1 - self.epsilon) ** 2
        total = turn * minus + plus + 2 * (1 + self.epsilon**2)
        below = (turn + 1) * plus - total * self.k**2
        if below.contains_zero():
            raise Undecided("whether there is a flip")
        height = total * (2 - self.k**2 * self.q) / below
        return self.fixed(height) if self.bend(height).inf > 0 else None

    def at(self, rho: Fraction) -> tuple[Motion, ...]:
        """Return the fixed points at rho with B > 0, at most two, the greater height first."""
        reach, rest = (self.tangent * self.ratio).sqr(), 2 - self.k**2 * self.q
        square, linear = reach * self.k**4 + 1, reach * (self.k**2 * rest)
        under = linear.sqr() - square * (reach * rest**2 - rho**2)
        if under.sup < 0:
            return ()
        if under.inf <= 0:
            raise Undecided("rho is at the saddle-node, or too close to tell")
        heights = ((-linear + root) / square for root in (sqrt(under), -sqrt(under)))
        return tuple(self.fixed(height) for height in heights if self.bend(height).inf > 0)

    # -- period 2 ----------------------------------------------------------------------------------

    def double(self, shift: Interval) -> Motion:
        """Return the motion of period 2 with the flights c + shift, c - shift; shift is not 0."""
        half = shift / 2
        (fall, speed), (fall2, speed2) = self._linear(-half, half), self._linear(half, -half)
        one = _sum(speed2, speed, speed2[-1])
        one = [each / (1 - speed[-1] * speed2[-1]) for each in one]
        other = _sum(speed, one, speed[-1])
        (a, b, c), (e, f, g) = _sum(fall, one, fall[-1]), _sum(fall2, other, fall2[-1])
        determinant = b * g - c * f
        across, up = (c * e - a * g) / determinant, (a * f - b * e) / determinant
        rho, middle = sqrt(across.sqr() + up.sqr()), up.atan2(across)
        impacts = (
            State(middle - half, dot(one, (1, across, up))),
            State(middle + half, dot(other, (1, across, up))),
        )
        return Motion(rho, impacts, (self.period + shift, self.period - shift))

    def _linear(self, before: Interval, after: Interval) -> tuple[Values, Values]:
        """Return (24), (25) as 1, rho cos x, rho sin x, lambda times coefficients.

        before, after: the phases less x.
        """
        none, unit = self.exact(0), self.exact(1)
        quarter = Interval.pi(precision=self.bits) / 2
        start = self._values(none, State(before, none), after)
        columns = [
            self._values(unit, State(before, none), after),
            self._values(unit, State(before + quarter, none), after + quarter),
            self._values(none, State(before, unit), after),
        ]
        first, second = (
            [start[i], *(column[i] - start[i] for column in columns)] for i in range(2)
        )
        return first, second

    # -- impacts -----------------------------------------------------------------------------------

    def _values(
        self, rho: Interval, state: State, after: Interval, roots: tuple[int, ...] = ()
    ) -> Values:
        """Enclose (24) and (25), or other places on the tape, with psi1 = after."""
        formulas = _equations(not self.k)
        one, exact = self.exact(1), {"epsilon": self.epsilon, "k": self.k, "q": self.q}
        given = {name: self.exact(value) for name, value in exact.items()}
        given |= {"m": one * self.m, "rho": rho, "psi": state.psi, "lam": state.lam, "psi1": after}
        x = [given.get(name, one) for name in formulas.variables]  # g and omega are 1
        return formulas.tape.evaluate(roots or formulas.roots, Intervals(self.bits), x)

    def jacobian(self, rho: Interval, state: State, after: Interval) -> Matrix:
        """Enclose the derivatives of the next phase and velocity by phase and velocity."""
        entries = self._values(rho, state, after, _partials(not self.k))
        (a, b, down), (c, d, slope) = entries[:3], entries[3:]
        turn = [-a / down, -b / down]
        return [turn, [c + slope * turn[0], d + slope * turn[1]]]

    def derivative(self, motion: Motion) -> Matrix:
        """Enclose the derivative of the map, or of its second iterate, at the first impact."""
        product: Matrix = [[self.exact(int(i == j)) for j in range(2)] for i in range(2)]
        for i, state in enumerate(motion.impacts):
            after = motion.impacts[(i + 1) % len(motion.impacts)].psi
            step = self.jacobian(motion.rho, state, after)
            columns = list(zip(*product, strict=True))
            product = [[dot(row, column) for column in columns] for row in step]
        return product

    def gap(self, rho: Interval, state: State) -> Gap:
        """Return the gap, and its derivatives, of the flight after an impact."""

        def gap(time: Interval, order: int) -> Interval:
            after = state.psi + time - self.period
            return self._values(rho, state, after, (_rates(not self.k)[order],))[0]

        return gap


@cache
def _rates(limit: bool) -> tuple[int, ...]:
    """Return the places of (24) and of its derivatives by psi1, on the tape."""
    formulas = _equations(limit)
    by = formulas.variables.index("psi1")
    first = formulas.tape.derivative(formulas.roots[0], by)
    return formulas.roots[0], first, formulas.tape.derivative(first, by)


@cache
def _partials(limit: bool) -> tuple[int, ...]:
    """Return the places of the derivatives of (24) and (25) by psi, lambda and psi1."""
    formulas = _equations(limit)
    by = [formulas.variables.index(name) for name in ("psi", "lam", "psi1")]
    return tuple(formulas.tape.derivative(root, x) for root in formulas.roots for x in by)


def _sum(first: Values, second: Values, factor: Interval) -> Values:
    """Return the coefficients of 1, rho cos x, rho sin x in first + factor second."""
    return [a + factor * b for a, b in zip(first[:3], second[:3], strict=True)]
