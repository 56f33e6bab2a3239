"""x^y for x > 0 over arrays of boxes, in binary64: exp(y log x), with the sharp logarithm."""

from functools import partial

import numpy as np

from intervals.elementary.binary64 import fallback
from intervals.elementary.binary64.blocks import Mask, in_blocks, lower_upper, moderate
from intervals.elementary.binary64.exponential import exp
from intervals.elementary.binary64.fallback import Ends
from intervals.elementary.binary64.logarithm import sharp_log
from intervals.elementary.binary64.pair import Bounds, Pair, bounds
from intervals.rounding import MAX, Rows
from intervals.rows import aligned, is_thin, nonnegative

_LEAST_NORMAL = 2.0**-1022


def power(x: Rows, y: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of x^y, x in X, y in Y, where X > 0, or X >= 0 and Y > 0.

    x^y is monotone in x and in y, so its extremes are at corners.
    """

    def exactly(a: Ends, b: Ends) -> Ends:
        return fallback.at_corners("power", a, b)

    return in_blocks(partial(_power, rounded), exactly, *aligned(x, y))


def _power(rounded: Bounds, x: Rows, y: Rows) -> tuple[Rows, Mask]:
    bases, exponents = _ends(x), _ends(y)
    products = Pair(exponents[np.newaxis]) * sharp_log(Pair(bases))[:, np.newaxis]
    size = np.max(np.abs(products.hi), axis=(0, 1))
    proved = (
        ((bases >= _LEAST_NORMAL) & (bases <= MAX)).all(axis=0)
        & np.all(moderate(exponents), axis=0)
        & (size <= 640.0)
    )
    rows = np.stack([np.max(side, axis=(0, 1)) for side in rounded(exp(products))])
    return nonnegative(rows), proved


def _ends(rows: Rows) -> Rows:
    """Return the lower and upper ends, or the points once: shape (2 or 1, n)."""
    return rows[1:] if is_thin(rows) else lower_upper(rows)
