"""How arrays go through the kernels: in blocks, and one by one where these are not proved."""

from collections.abc import Callable, Sequence
from contextlib import suppress
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals.few import MOST
from intervals.rounding import Rows, all_of, constant, require_nearest

CHUNK = 16384  # elements at a time: the temporaries stay in the cache
_SIGNS = np.array((-1.0, 1.0))  # of rows
SMALL, LARGE = constant(2.0**-400), constant(2.0**400)

Mask = NDArray[np.bool_]


def in_blocks(
    kernel: Callable[..., tuple[Rows, Mask]],
    exactly: Callable[..., Any],
    *operands: Rows,
    few: Callable[[float, float], Sequence[float] | None] | None = None,
) -> Rows:
    """Return the rows of a function, or more, of the intervals in `operands`, which broadcast.

    kernel: rows to the rows of the result, and a mask, or one for each end, of what is proved.
    exactly: the ends (lower, upper) of each operand to those of the result, for the others.
    few: does as the kernel for one interval, sooner, to the same bits; None where it is not proved.
    A bound that is not finite is not proved.
    """
    require_nearest()
    rows = operands[0]
    if few and 0 < rows.size <= 2 * MOST:
        with suppress(ArithmeticError, ValueError):
            columns = [few(*ends) for ends in zip(*rows.reshape(2, -1).tolist(), strict=True)]
            return _as_rows(columns, rows.shape)
    aligned = operands if len(operands) == 1 else np.broadcast_arrays(*operands)
    flat = [rows.reshape(2, -1) for rows in aligned]

    def block(*parts: Rows) -> Rows:
        bounds, proved = kernel(*parts)
        finite = np.isfinite(bounds)
        if not (all_of(proved) and all_of(finite)):
            within = (proved & finite).reshape(-1, bounds.shape[-1]).all(axis=0)
            for index in np.flatnonzero(~within):
                ends = [(-float(rows[0, index]), float(rows[1, index])) for rows in parts]
                bounds[..., index] = _SIGNS * exactly(*ends)
        return bounds

    with np.errstate(all="ignore"):
        result = in_chunks(block, *flat)
    return result.reshape(*result.shape[:-2], *aligned[0].shape)


def _as_rows(columns: list[Sequence[float] | None], shape: tuple[int, ...]) -> Rows:
    """Return rows of such a shape, of one function or more, from the bounds of each element."""
    if not all(column and all(map(isfinite, column)) for column in columns):
        raise ArithmeticError("not proved")
    rows = np.array(columns).T.reshape(-1, *shape)
    return rows if len(rows) > 1 else rows[0]


def in_chunks(function: Callable[..., Rows], *operands: Rows) -> Rows:
    """Return the function of arrays (..., n), done in chunks along their last axis."""
    count = operands[0].shape[-1]
    if count <= CHUNK:
        return function(*operands)
    starts = range(0, count, CHUNK)
    parts = [function(*(x[..., i : i + CHUNK] for x in operands)) for i in starts]
    return np.concatenate(parts, axis=-1)


def moderate(x: Rows, small: Rows = SMALL, large: Rows = LARGE) -> Mask:
    """Return where x = 0 or small <= |x| <= large."""
    size = np.abs(x)
    within: Mask = size >= small
    if not all_of(within):
        within |= size == 0.0
    within &= size <= large
    return within


def lower_upper(rows: Rows) -> Rows:
    """Return the lower and the upper ends, from rows, or rows from these."""
    ends = rows.copy()
    np.negative(ends[0], out=ends[0])
    return ends
