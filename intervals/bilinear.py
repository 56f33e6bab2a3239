"""Sums of outer products of intervals in binary64, by midpoints and radii.

Theorem. For 1 <= k <= K <= 100 let X_k be n and Y_k be T intervals, X_0 another n. `bilinear`
returns n by T intervals that contain x_0i + sum over k of x_ki y_kj for all x_ki in X_ki, y_kj in
Y_kj, if the processor rounds to nearest (`require_nearest` checks that).

Proof. Let m, r be binary64 numbers with |x - m| <= r for all x in X, and n, s the same for Y; let
e = 2^-52, eta = 2^-1074, and n_0 = 1, s_0 = 0. fl is one rounded operation: a sum has relative
error <= e, a product relative error <= e and absolute error <= eta.

1. |x y - m n| = |(x - m) n + x (y - n)| <= r |n| + (|m| + r) s. Let B be the sum of these bounds,
   A the sum of |m_k n_k|, both over k = 0, ..., K.
2. The centre c = fl(m_0 + sum of fl(m_k n_k)) has K products and K sums, so that
   |c - sum m_k n_k| <= ((1 + e)^(K+1) - 1) A + 2 K eta <= (K + 2) e A + 2 K eta, and hence
   |c| <= 2 A + 2 K eta. With R = B + (K + 2) e A + 2 K eta, every value is within R of c.
3. `_reach` gives P_k >= F (r_k + (K + 4) e |m_k|) and Q_k >= F (|m_k| + r_k), F = 1 + (2 K + 8) e,
   and P_0 has 2^-1000 more (its sum with P_0 loses nothing: see there). Hence the exact
   sum of P_k |n_k| + Q_k s_k is at least E = F (B + (K + 4) e A) + 2^-1000. Evaluated with 2 K
   products and 2 K sums, of numbers >= 0, it gives rho >= (1 - e)^(2K+1) E - 4 K eta. Since
   (1 - e)^(2K+2) F >= 1, (1 - e) rho >= B + (K + 4) e A + 2^-1001 - 4 K eta >= R + e |c|.
4. The ends fl(c - rho), fl(c + rho) err by at most e (|c| + rho), and rho >= R + e (|c| + rho).

An overflow leaves inf or NaN in an end, which `bounded` refuses.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from intervals.array import IntervalArray, _make
from intervals.rounding import ETA, ULP, Rows, bounded, outward_sum, require_nearest

_MOST_TERMS = 100
_TINY = 2.0**-1000


def bilinear(
    left: Sequence[IntervalArray], right: Sequence[IntervalArray], constant: IntervalArray
) -> IntervalArray:
    """Enclose constant_i + sum over k of left[k]_i right[k]_j; the shape is (n, T).

    left[k] and constant have the shape (n,), right[k] has the shape (T,). Fastest for T >> n. The
    temporary memory is 24 n T bytes.
    """
    terms = len(left)
    if not (1 <= terms <= _MOST_TERMS and len(right) == terms):
        raise ValueError(f"as many left as right factors, 1 to {_MOST_TERMS} of each")
    if constant.ndim != 1 or any(x.ndim != 1 for x in (*left, *right)):
        raise ValueError("the factors and the constant must have one axis")
    require_nearest()
    shape = (len(constant), len(right[0]))
    rows, term = np.empty((2, *shape)), np.empty(shape)
    with np.errstate(all="ignore"):
        centres, radii = _ball((constant, *left))
        of_right, radii_right = _ball(right)
        rounding, sizes = _reach(centres, radii, terms)
        sizes_right = np.abs(of_right)
        rows[0] = (rounding[0] + _TINY)[:, np.newaxis]
        rows[1] = centres[0][:, np.newaxis]
        for k in range(terms):
            for row, x, y in (
                (1, centres[k + 1], of_right[k]),
                (0, rounding[k + 1], sizes_right[k]),
                (0, sizes[k + 1], radii_right[k]),
            ):
                np.multiply(x[:, np.newaxis], y, out=term)
                rows[row] += term
        np.subtract(rows[0], rows[1], out=term)
        rows[1] += rows[0]
        rows[0] = term
        return _make(bounded(rows))


def _ball(arrays: Sequence[IntervalArray]) -> tuple[Rows, Rows]:
    """Return for each array binary64 numbers m, near the middle, and r >= |x - m| for x in X."""
    low, high = np.stack([x._rows for x in arrays], axis=1)  # (-inf, sup)
    centre = 0.5 * high - 0.5 * low
    return centre, outward_sum(np.maximum(high - centre, low + centre))


def _reach(centre: Rows, radius: Rows, terms: int) -> tuple[Rows, Rows]:
    """Return P >= F (r + (K + 4) e |m|) and Q >= F (r + |m|), see the theorem.

    Proof. With G = F + 8 e in place of F, at most one product below eta, two sums and the product
    with G lose a factor (1 - e)^4 and less than 3 eta; G (1 - e)^4 >= F (1 + 3 e). Adding 4 eta,
    and after that a 2^-1000, exceeds what remains: where that sum is not exact, P > 2^-1022 and
    its rounding loses no more than e P, which the factor 1 + 3 e holds in reserve.
    """
    factor = 1.0 + (2 * terms + 16) * ULP
    size = np.abs(centre)
    rounding = (size * ((terms + 4) * ULP) + radius) * factor + 4.0 * ETA
    return rounding, (size + radius) * factor + 4.0 * ETA
