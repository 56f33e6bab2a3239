"""atan2 and hypot over arrays of boxes, in binary64."""

from functools import partial

import numpy as np

from intervals.elementary.binary64 import fallback
from intervals.elementary.binary64.arctangent import angle
from intervals.elementary.binary64.blocks import Mask, in_blocks, moderate
from intervals.elementary.binary64.fallback import PI_UP, Ends
from intervals.elementary.binary64.pair import Bounds, Pair, bounds
from intervals.errors import DomainError
from intervals.rounding import Rows, joined
from intervals.rows import aligned, is_thin, magnitude


def hypot(x: Rows, y: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of sqrt(x^2 + y^2), x in X, y in Y: increasing in |x| and in |y|."""

    def exactly(a: Ends, b: Ends) -> Ends:
        return fallback.at_corners("hypot", a, b)

    return in_blocks(partial(_hypot, rounded), exactly, *map(magnitude, aligned(x, y)))


def _hypot(rounded: Bounds, x: Rows, y: Rows) -> tuple[Rows, Mask]:
    proved = moderate(x) & moderate(y)
    thin = is_thin(x) and is_thin(y)
    a, b = (Pair(x[1]), Pair(y[1])) if thin else (Pair(x), Pair(y))
    root = (a * a + b * b).sqrt()
    below, above = rounded(root)
    rows = joined(below, above) if thin else joined(below[0], above[1])
    np.minimum(rows[0], 0.0, out=rows[0])
    return rows, proved


def atan2(y: Rows, x: Rows, rounded: Bounds = bounds) -> Rows:
    """Return rows of the angles in (-pi, pi] of the points (x, y), x in X, y in Y.

    DomainError if (0, 0) is in a box. A box with points on the cut {x < 0, y = 0}, where the angle
    is pi, and points below it, where it is near -pi, gives [-pi, pi].
    """

    def exactly(of_y: Ends, of_x: Ends) -> Ends:
        return fallback.at_corners("atan2", of_y, of_x)

    return in_blocks(partial(_atan2, rounded), exactly, *aligned(y, x))


def _atan2(rounded: Bounds, y: Rows, x: Rows) -> tuple[Rows, Mask]:
    """Do `atan2` for a block: both rows are the largest angle, of the box and of its mirror image.

    The mirror image in y = 0 has the angles -theta and the rows of -Y, those of Y exchanged. The
    largest angle of a box that does not cross the cut is at a corner: theta increases with y where
    x > 0, decreases with y where x < 0, decreases with x where y > 0, increases with x where y < 0.
    If the largest y is > 0, a point with y > 0 has the largest angle (in a box that meets y <= 0,
    too, x > 0), so the least x is best; otherwise the largest x is. Then the sign of that x says
    which y is best. Points with y = 0, x < 0 have theta = pi, in the mirror image -pi.
    """
    if ((y[0] >= 0.0) & (y[1] >= 0.0) & (x[0] >= 0.0) & (x[1] >= 0.0)).any():
        raise DomainError("atan2 of a box that contains (0, 0)")
    crosses = (y[0] > 0.0) & (y[1] >= 0.0) & (x[0] > 0.0)
    thin = is_thin(y) and is_thin(x)
    if thin:
        ys, xs = y[1], x[1]
        sign = np.where(ys < 0.0, -1.0, 1.0)
    else:
        xs = np.where(y > 0.0, -x[0], x[1])
        ys = np.where(xs >= 0.0, y, -y[::-1])
        sign = np.where(ys < 0.0, -1.0, 1.0)
        sign[0, ys[0] == 0.0] = -1.0
    theta = angle(Pair(np.abs(ys)), Pair(xs)).scaled(sign)
    below, above = rounded(theta)
    rows = np.minimum(joined(below, above) if thin else above, PI_UP)
    rows[:, crosses] = PI_UP
    proved = moderate(xs) & moderate(ys)
    return rows, crosses | proved
