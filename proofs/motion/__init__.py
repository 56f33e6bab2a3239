"""Motions in floating point: candidates, never evidence."""

import math

from proofs.trusted.equations import registered_sincos


@registered_sincos.register
def _(x: float) -> tuple[float, float]:
    return math.sin(x), math.cos(x)
