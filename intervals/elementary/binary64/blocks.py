"""How arrays go through the kernels: in blocks, and one by one where these are not proved."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from intervals.elementary.binary64.fallback import Ends
from intervals.rounding import Rows, bounded, require_nearest

CHUNK = 16384  # elements at a time: the temporaries stay in the cache
SMALL, LARGE = 2.0**-400, 2.0**400

LOWER_UPPER = np.array([[-1.0], [1.0]])  # times rows: the lower and the upper ends, and back

Mask = NDArray[np.bool_]


def in_blocks(
    kernel: Callable[..., tuple[Rows, Mask]], exactly: Callable[..., Ends], *operands: Rows
) -> Rows:
    """Return the rows of a function of the intervals in `operands`, which broadcast.

    kernel: rows to the rows of the result and a mask that says where these are proved.
    exactly: the ends (lower, upper) of each operand to those of the result, for the others.
    A bound that is not finite is not proved. OverflowError if a bound is beyond binary64.
    """
    require_nearest()
    aligned = np.broadcast_arrays(*operands)
    flat = [rows.reshape(2, -1) for rows in aligned]
    result = np.empty_like(flat[0])
    with np.errstate(all="ignore"):
        for start in range(0, result.shape[1], CHUNK):
            block = [rows[:, start : start + CHUNK] for rows in flat]
            bounds, proved = kernel(*block)
            proved &= np.isfinite(bounds).all(axis=0)
            for index in np.flatnonzero(~proved):
                ends = [(-float(rows[0, index]), float(rows[1, index])) for rows in block]
                lower, upper = exactly(*ends)
                bounds[:, index] = -lower, upper
            result[:, start : start + CHUNK] = bounds
    return bounded(result).reshape(aligned[0].shape)


def moderate(x: Rows, small: float = SMALL, large: float = LARGE) -> Mask:
    """Return where x = 0 or small <= |x| <= large."""
    size = np.abs(x)
    return np.asarray(((size >= small) | (size == 0.0)) & (size <= large))
