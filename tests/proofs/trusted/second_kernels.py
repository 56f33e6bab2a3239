"""The checker's arithmetic and Arb's, asked for the same quantities of the plastic map."""

from dataclasses import replace
from fractions import Fraction
from typing import Any

from flint import arb, arb_series, ctx

from proofs.trusted import equations
from proofs.trusted.flights import Motion, phase_after
from proofs.trusted.kernel.arithmetic import exp, log, pi, rational
from proofs.trusted.numbers import Range
from tests.proofs.trusted.second_map import ball, bounds


@equations.sincos.register(arb)
@equations.sincos.register(arb_series)
def _(x):
    return x.sin_cos()


class Checker:
    """The checker's arithmetic, at the precision of a motion that it made."""

    def __init__(self, motion: Motion | None, bits: int) -> None:
        self.motion, self.bits = motion, bits

    def _at(self, phases: Range) -> Motion:
        return replace(self.motion, phases=phases, bits=self.bits)

    def gap(self, phases: Range, time: Range, order: int = 0) -> Range:
        motion = self._at(phases)
        return motion.gap(motion.start(), time, order).range

    def slope(self, phases: Range, time: Range) -> Range:
        return self._at(phases).slope(time).range

    def curvature(self, phases: Range, time: Range) -> Range:
        return self._at(phases).curvature(time).range

    def image(self, phase: Fraction, time: Range) -> Range:
        return phase_after(phase, time, self.bits)

    def power(self, base: Fraction, exponent: Fraction) -> Range:
        return exp(rational(exponent, self.bits) * log(base, self.bits)).range

    def turns(self, count: int) -> Range:
        return (pi(self.bits) * (2 * count)).range


class Arb:
    """The same quantities in balls, at a precision of its own."""

    def __init__(self, motion: Motion | None, bits: int) -> None:
        self.motion, self.bits = motion, bits

    def _launch(self, phi: Any) -> equations.Launch:
        return equations.launch(self.motion.side, ball(self.motion.eta), ball(self.motion.nu), phi)

    def _clock(self, t: Any) -> equations.Clock:
        return equations.clock(ball(self.motion.eta), t)

    def gap(self, phases: Range, time: Range, order: int = 0) -> Range:
        ctx.prec = self.bits
        return bounds(equations.gap(self._launch(ball(phases)), self._clock(ball(time)), order))

    def _slope(self, phi: Any, t: Any) -> Any:
        return equations.slope(self._launch(phi), self._clock(t))

    def slope(self, phases: Range, time: Range) -> Range:
        ctx.prec = self.bits
        return bounds(self._slope(ball(phases), ball(time)))

    def curvature(self, phases: Range, time: Range) -> Range:
        ctx.prec = self.bits
        phi, t = ball(phases), ball(time)
        now = arb_series([t, self._slope(phi, t) - 1], prec=2)
        return bounds(self._slope(arb_series([phi, 1], prec=2), now)[1])

    def image(self, phase: Fraction, time: Range) -> Range:
        ctx.prec = self.bits
        count = int((phase + time[0]) / bounds(2 * arb.pi())[0])
        return bounds(ball((phase + time[0], phase + time[1])) - 2 * count * arb.pi())

    def power(self, base: Fraction, exponent: Fraction) -> Range:
        ctx.prec = self.bits
        return bounds(ball(base) ** ball(exponent))

    def turns(self, count: int) -> Range:
        ctx.prec = self.bits
        return bounds(2 * count * arb.pi())


Kernel = Checker | Arb
