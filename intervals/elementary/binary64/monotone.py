"""Ranges of monotone functions over arrays of intervals, in binary64."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from intervals.elementary.binary64 import compositions, exponential, fallback, logarithm
from intervals.elementary.binary64.blocks import (
    Mask,
    in_blocks,
    lower_upper,
    moderate,
)
from intervals.elementary.binary64.fallback import Ends
from intervals.elementary.binary64.pair import Bounds, Pair, bounds
from intervals.rounding import MAX, Rows, constant, joined
from intervals.rows import is_thin

_LARGE = 2.0**400
_HALF_PI, _PI = 1.5707963267948968, 3.1415926535897936  # the next numbers above


@dataclass(frozen=True)
class Monotone:
    """A function on binary64 numbers.

    point: the function, with an error of k u, for x = 0 or small <= |x|, and low <= x <= high.
    least, greatest: bounds of its values.
    """

    point: Callable[[Any], Pair]
    k: float
    low: float
    high: float
    least: float = -MAX
    greatest: float = MAX
    small: float = 2.0**-400
    decreasing: bool = False

    def enclose(self, rounded: Bounds, rows: Rows) -> tuple[Rows, Mask]:
        """Return rows of f(X), and where they are proved."""
        if is_thin(rows):
            x = rows[1]
            bounds = joined(*rounded(self.point(x)))
        else:
            x = lower_upper(rows)
            below, above = rounded(self.point(x))
            bounds = joined(*(below[1], above[0]) if self.decreasing else (below[0], above[1]))
        for row, most in self._cuts:
            np.minimum(bounds[row], most, out=bounds[row])
        return bounds, self._proved(x)

    def few(self, rounded: Bounds, a: float, b: float) -> tuple[float, float] | None:
        """Return the row of f over [-a, b], None where it is not proved."""
        left, right = (b, -a) if self.decreasing else (-a, b)
        for x in (left, right):
            if not (self.low <= x <= self.high and (x == 0.0 or abs(x) >= self.small)):
                return None
        below, above = rounded(self.point(left))
        if left != right:
            _, above = rounded(self.point(right))
        return min(below, -self.least), min(above, self.greatest)

    @cached_property
    def _cuts(self) -> list[tuple[int, Rows]]:
        """The rows that have a bound of their own, and this."""
        bounds = enumerate((-self.least, self.greatest))
        return [(row, constant(most)) for row, most in bounds if most < MAX]

    @cached_property
    def _proved_from(self) -> tuple[Rows, ...]:
        return tuple(map(constant, (self.low, self.high, self.small, MAX)))

    def _proved(self, x: Rows) -> Mask:
        low, high, small, large = self._proved_from
        within: Mask = x >= low
        within &= x <= high
        return within & moderate(x, small, large) if self.small else within


def _of_pair(function: Callable[[Pair], Pair]) -> Callable[[Any], Pair]:
    return lambda x: function(Pair(x))


FUNCTIONS = {
    "exp": Monotone(_of_pair(exponential.exp), 0.016, -660.0, 709.0, least=0.0, small=0.0),
    "exp2": Monotone(_of_pair(exponential.exp2), 0.016, -950.0, 950.0, least=0.0, small=0.0),
    "exp10": Monotone(_of_pair(exponential.exp10), 0.016, -285.0, 308.0, least=0.0, small=0.0),
    "expm1": Monotone(_of_pair(exponential.expm1), 0.07, -660.0, 709.0, least=-1.0),
    "log": Monotone(_of_pair(logarithm.log), 0.04, 2.0**-1022, MAX),
    "log2": Monotone(_of_pair(logarithm.log2), 0.04, 2.0**-1022, MAX),
    "log10": Monotone(_of_pair(logarithm.log10), 0.04, 2.0**-1022, MAX),
    "log1p": Monotone(_of_pair(logarithm.log1p), 0.04, -1.0, _LARGE),
    "cbrt": Monotone(compositions.cbrt, 0.01, -_LARGE, _LARGE),
    "asin": Monotone(compositions.asin, 0.07, -1.0, 1.0, -_HALF_PI, _HALF_PI),
    "acos": Monotone(compositions.acos, 0.07, -1.0, 1.0, 0.0, _PI, decreasing=True),
    "atan": Monotone(compositions.atan, 0.07, -_LARGE, _LARGE, -_HALF_PI, _HALF_PI),
    "sinh": Monotone(compositions.sinh, 0.13, -690.0, 690.0),
    "cosh": Monotone(compositions.cosh, 0.016, 0.0, 600.0, least=1.0, small=0.0),
    "tanh": Monotone(compositions.tanh, 0.13, -MAX, MAX, -1.0, 1.0),
    "asinh": Monotone(compositions.asinh, 0.04, -_LARGE, _LARGE),
    "acosh": Monotone(compositions.acosh, 0.04, 1.0, _LARGE, least=0.0),
    "atanh": Monotone(compositions.atanh, 0.04, -1.0, 1.0),
}


def monotone(name: str, rows: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of f(X) for the intervals X of `rows`, (-lower, upper), in the domain of f.

    f, one of `FUNCTIONS`, is increasing, except acos; cosh takes X within x >= 0. OverflowError if
    a bound is beyond binary64. Outside the proved range of `point` the multiprecision functions
    answer, element by element.
    """
    function = FUNCTIONS[name]

    def exactly(x: Ends) -> Ends:
        return fallback.monotone(name, *(x[::-1] if function.decreasing else x))

    enclose, few = partial(function.enclose, rounded), partial(function.few, rounded)
    return in_blocks(enclose, exactly, rows, few=few)
