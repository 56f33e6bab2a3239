"""Sums of outer products of intervals in binary64, by midpoints and radii.

Theorem. For 1 <= k <= K <= 100 let X_k be n and Y_k be T intervals, Y_0 another T. `bilinear`
returns n by T intervals that contain y_0j + sum over k of x_ki y_kj for all x_ki in X_ki, y_kj in
Y_kj, if the processor rounds to nearest (`require_nearest` checks that).

Proof. Let m, r be binary64 numbers with |x - m| <= r for all x in X, and n, s the same for Y; let
e = 2^-52, eta = 2^-1074, and m_0 = 1, r_0 = 0. fl is one rounded operation: a sum has relative
error <= e, a product relative error <= e and absolute error <= eta.

1. |x y - m n| = |m (y - n) + (x - m) y| <= |m| s + r (|n| + s). Let B be the sum of these bounds,
   A the sum of |m_k n_k|, both over k = 0, ..., K.
2. The centre c = fl(n_0 + sum of fl(m_k n_k)) has K products and K sums, so that
   |c - sum m_k n_k| <= ((1 + e)^(K+1) - 1) A + 2 K eta <= (K + 2) e A + 2 K eta, and hence
   |c| <= 2 A + 2 K eta. With R = B + (K + 2) e A + 2 K eta, every value is within R of c.
3. The small arrays P_k >= F (s_k + (K + 4) e |n_k|), Q_k >= F (|n_k| + s_k), F = 1 + (2 K + 8) e,
   and 2^-1000 more in P_0, are rounded upward. The sum P_0 + sum of |m_k| P_k + r_k Q_k is then at
   least E = F (B + (K + 4) e A) + 2^-1000. Evaluated with 2 K products and 2 K sums, of numbers
   >= 0, it gives rho >= (1 - e)^(2K+1) E - 4 K eta. Since (1 - e)^(2K+2) F >= 1,
   (1 - e) rho >= B + (K + 4) e A + 2^-1001 - 4 K eta >= R + e |c|.
4. The ends fl(c - rho), fl(c + rho) err by at most e (|c| + rho), and rho >= R + e (|c| + rho).

An overflow leaves inf or NaN in an end, which `bounded` refuses.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from intervals.array import IntervalArray, _make
from intervals.rounding import bounded, require_nearest

_MOST_TERMS = 100
_EPSILON = Fraction(1, 2**52)
_TINY = Fraction(1, 2**1000)


def bilinear(
    left: Sequence[IntervalArray], right: Sequence[IntervalArray], constant: IntervalArray
) -> IntervalArray:
    """Enclose constant_j + sum over k of left[k]_i right[k]_j; the shape is (n, T).

    left[k] has the shape (n,), right[k] and constant have the shape (T,); temporary memory 24 n T bytes.
    """
    terms = len(left)
    if not (1 <= terms <= _MOST_TERMS and len(right) == terms):
        raise ValueError(f"as many left as right factors, 1 to {_MOST_TERMS} of each")
    if constant.ndim != 1 or any(x.ndim != 1 for x in (*left, *right)):
        raise ValueError("the factors and the constant must have one axis")
    require_nearest()
    rounding, spare = (terms + 4) * _EPSILON, 1 + (2 * terms + 8) * _EPSILON
    centre, radius = _ball(constant)
    shape = (*left[0].shape, *constant.shape)
    rows, term = np.empty((2, *shape)), np.empty(shape)
    rows[1] = centre.mid
    rows[0] = ((abs(centre) * rounding + radius) * spare + _TINY).sup
    with np.errstate(all="ignore"):
        for x, y in zip(left, right, strict=True):
            (m, r), (n, s) = _ball(x), _ball(y)
            size = abs(n)
            factors = (
                (rows[1], m.mid, n.mid),
                (rows[0], abs(m).sup, ((size * rounding + s) * spare).sup),
                (rows[0], r.sup, ((size + s) * spare).sup),
            )
            for target, of_left, of_right in factors:
                np.multiply(of_left[:, np.newaxis], of_right, out=term)
                target += term
        np.subtract(rows[0], rows[1], out=term)
        rows[1] += rows[0]
        rows[0] = term
        return _make(bounded(rows))


def _ball(x: IntervalArray) -> tuple[IntervalArray, IntervalArray]:
    """Return points in the intervals and upper bounds of their distance to the rest, as points."""
    centre = IntervalArray.from_floats(x.mid)
    return centre, IntervalArray.from_floats(abs(x - centre).sup)
