"""Signs of sums of outer products of intervals in binary64, by midpoints and a radius a row.

Theorem. For 1 <= k <= K <= 100 let X_k be n and Y_k be T intervals, Z another n. Where the result
of `bilinear` is True, z_i + sum over k of x_ki y_kj > 0 for all z_i in Z_i, x_ki in X_ki, y_kj in
Y_kj, if the processor rounds to nearest (`require_nearest` checks that).

Proof. Let m, r be binary64 numbers with |x - m| <= r for all x in X, and n, s the same for Y; let
N_k and S_k be the largest |n_kj| and s_kj over all j. Let e = 2^-52, eta = 2^-1074. fl is one
rounded operation: a sum has relative error <= e, a product relative error <= e and absolute error
<= eta.

1. |x y - m n| = |(x - m) n + x (y - n)| <= r N + (|m| + r) S. Let B be the sum of these bounds,
   A the sum of |m_k| N_k, over all k: one number a row.
2. The centre c = fl(sum of fl(m_k n_k)) has K products and K - 1 sums, so that
   |c - sum m_k n_k| <= ((1 + e)^K - 1) A + 2 K eta <= (K + 1) e A + 2 K eta. Hence every sum of
   x_k y_k is at least c - R, where R = B + (K + 1) e A + 2 K eta.
3. `_radii` gives rho >= R.
4. The level l = `outward_sum`(fl(rho - inf Z)) is at least rho - inf Z. Where c > l, which is
   compared exactly, every sum is at least c - R > -inf Z.

Overflow: 2 A and l are `bounded`, and no partial sum of step 2 exceeds (1 + e)^K A + 2 K eta.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from intervals.array import IntervalArray
from intervals.rounding import ULP, Rows, bounded, outward_sum, require_nearest

_MOST_TERMS = 100
_TINY = 2.0**-1000
_BLOCK = 32768  # sums at a time: they, and what is added, stay in the cache


def bilinear(
    left: Sequence[IntervalArray], right: Sequence[IntervalArray], constant: IntervalArray
) -> NDArray[np.bool_]:
    """Return where constant_i + sum over k of left[k]_i right[k]_j > 0 is certain, shape (n, T).

    left[k] and constant have the shape (n,), right[k] has the shape (T,). Fastest for T >> n, and
    sharp where the intervals in one right[k] are of about the same size and width. Temporary memory
    is 16 T bytes or half a megabyte. Raises OverflowError where a sum may leave binary64's range.
    """
    terms = len(left)
    if not (1 <= terms <= _MOST_TERMS and len(right) == terms):
        raise ValueError(f"as many left as right factors, 1 to {_MOST_TERMS} of each")
    if any(x.ndim != 1 for x in (constant, *right)) or any(x.shape != constant.shape for x in left):
        raise ValueError("the factors and the constant must have one axis, left ones the same")
    require_nearest()
    with np.errstate(all="ignore"):
        centres, radii = _ball(left)
        of_right, radii_right = _ball(right)
        largest = (np.abs(x).max(axis=1, initial=0.0) for x in (of_right, radii_right))
        radius = _radii(centres, radii, *largest)
        levels = outward_sum(radius + constant._rows[0])  # the row holds -inf
        return _exceed(centres, of_right, levels)


def _exceed(left: Rows, right: Rows, levels: Rows) -> NDArray[np.bool_]:
    """Return where c_ij > levels[i], c_ij = fl(sum over k of left[k]_i right[k]_j)."""
    rows, columns = len(levels), right.shape[1]
    result = np.empty((rows, columns), dtype=np.bool_)
    block = min(rows, max(1, _BLOCK // max(1, columns)))
    buffers = np.empty((2, block, columns))
    for begin in range(0, rows, block or 1):
        part = slice(begin, begin + block)
        sums, term = buffers[:, : rows - begin]
        np.multiply(left[0, part, np.newaxis], right[0], out=sums)
        for x, y in zip(left[1:, part, np.newaxis], right[1:], strict=True):
            np.multiply(x, y, out=term)
            sums += term
        np.greater(sums, levels[part, np.newaxis], out=result[part])
    return result


def _ball(arrays: Sequence[IntervalArray]) -> tuple[Rows, Rows]:
    """Return for each array binary64 numbers m, near the middle, and r >= |x - m| for x in X."""
    low, high = np.stack([x._rows for x in arrays], axis=1)  # (-inf, sup)
    centre = 0.5 * high - 0.5 * low
    return centre, outward_sum(np.maximum(high - centre, low + centre))


def _radii(centre: Rows, radius: Rows, sizes: Rows, widths: Rows) -> Rows:
    """Return rho >= B + (K + 1) e A + 2 K eta, for N_k = sizes[k], S_k = widths[k].

    Proof. At most K + 5 roundings meet on one path, so that the factor F = 1 + (K + 8) e makes up
    for their relative errors: F (1 - e)^(K + 5) >= 1. At most 3 K + 2 products have absolute errors
    besides, none of which a factor above F multiplies; with 2 K eta they are far below 2^-1000.
    """
    terms = len(centre)
    size = np.abs(centre)
    sizes, widths = sizes[:, np.newaxis], widths[:, np.newaxis]
    total = (size * sizes).sum(axis=0)
    bounded(2.0 * total)
    spread = (radius * sizes + (size + radius) * widths).sum(axis=0)
    rho: Rows = (total * ((terms + 1) * ULP) + spread) * (1.0 + (terms + 8) * ULP) + _TINY
    return rho
