"""Elementary functions of arrays of intervals in binary64, with proved errors.

Everything takes and returns rows (-lower, upper), see `intervals.rounding`. The kernels use
+ - * / sqrt, rounding to integers, and tables; each states its error bound and derives it. What
they do not cover, the multiprecision functions answer, element by element.
"""

from intervals.elementary.binary64.blocks import CHUNK
from intervals.elementary.binary64.monotone import FUNCTIONS, monotone
from intervals.elementary.binary64.pair import ulps
from intervals.elementary.binary64.plane import atan2, hypot
from intervals.elementary.binary64.realpower import power
from intervals.elementary.binary64.trigonometric import LIMIT, sincos, tan

__all__ = ["CHUNK", "ERRORS", "LIMIT", "atan2", "hypot", "monotone", "power", "sincos", "tan"]

ERRORS = {name: ulps(function.k) for name, function in FUNCTIONS.items()} | {
    "sin": ulps(0.04),
    "cos": ulps(0.04),
    "tan": ulps(0.07),
    "atan2": ulps(0.07),
    "hypot": ulps(0.01),
    "power": ulps(0.18),
}
"""How far a bound at a point is from the true value at most, in ulps, in the proved range."""
