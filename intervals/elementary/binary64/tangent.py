"""tan over arrays of intervals, in binary64."""

from functools import partial

import numpy as np

from intervals.elementary.binary64 import fallback
from intervals.elementary.binary64.blocks import Mask, in_blocks, moderate
from intervals.elementary.binary64.pair import Bounds, bounds
from intervals.elementary.binary64.trigonometric import LIMIT, point_sincos, quarters
from intervals.errors import DomainError
from intervals.rounding import Rows, constant

_NEAR = constant(LIMIT)


def tan(rows: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of tan X; DomainError if an X contains a pole."""
    return in_blocks(partial(_tan, rounded), fallback.tan, rows)


def _tan(rounded: Bounds, rows: Rows) -> tuple[Rows, Mask]:
    """Do `tan` where |x| <= 1024. tan(-x) = -tan x: the rows of tan X are tan of the rows of X.

    No binary64 number is a pole, and `quarters` says exactly between which multiples of pi/2 it is.
    """
    proved = np.all(moderate(rows, large=_NEAR), axis=0)
    sin, cos, n, rest = point_sincos(rows)
    first, last = quarters(n, rest)
    if (proved & ((first + 1) >> 1 != (last + 1) >> 1)).any():  # j pi/2 is inside for an odd j
        raise DomainError("tan of an interval that contains a pole")
    return rounded(sin.normal() / cos.normal())[1], proved
