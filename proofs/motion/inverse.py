"""Inverse branches of the plastic impact map in the complex plane: candidates, never evidence."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

from intervals import Undecided
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.trusted.equations import clock, gap, launch, launch_acceleration, registered_sincos
from proofs.trusted.numbers import Range

_STEPS = 40  # of Newton's method
_EXACT = 1e-13


@registered_sincos.register
def _(x: complex) -> tuple[complex, complex]:
    return cmath.sin(x), cmath.cos(x)


@dataclass(frozen=True)
class InverseBranch:
    """The inverse g of F(y) = y + t - 2 pi turns, t the time of the first impact after y."""

    system: System
    domain: Range

    @property
    def turns(self) -> int:
        """The turns of the table that leave the image of the middle of the domain in [0, 2 pi)."""
        impact = next_impact(self.system, self._middle)
        if impact is None:
            raise Undecided("no first impact in floating point")
        return round((impact.lifted - impact.phase) / math.tau)

    @property
    def _middle(self) -> float:
        return float(sum(self.domain)) / 2

    def along(self, path: Sequence[complex]) -> list[tuple[complex, complex]]:
        """Return g and g' along a path of complex numbers, which starts at the hull's middle.

        Newton's method for gap(y, x - y + 2 pi turns) = 0, from one number to the next.
        """
        ahead, y, values = math.tau * self.turns, complex(self._middle), []
        for x in path:
            y, rate = self._solve(x + ahead, y)
            values.append((y, rate))
        return values

    def _solve(self, x: complex, y: complex) -> tuple[complex, complex]:
        eta = float(self.system.eta)
        for _ in range(_STEPS):
            start, now = launch(self.system.side, eta, float(self.system.nu), y), clock(eta, x - y)
            rate = now.mass_sin * launch_acceleration(start) / eta
            step = gap(start, now) / rate
            y += step
            if abs(step) < _EXACT:
                return y, gap(start, now, 1) / rate
        raise Undecided("an inverse image is not found in floating point")
