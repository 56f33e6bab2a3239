"""Zeros of n equations in n variables from signs on the faces of a box.

Theorem (Miranda 1940). Let f be continuous on a box X, C a regular matrix. If for each i
(C f)_i <= 0 on one of the two faces of X orthogonal to x_i and (C f)_i >= 0 on the other, f has a
zero in X. For n = 1 this is the intermediate value theorem.

If f is C^1, J contains f' over X and m is in X, (C f)_i on the face x_i = e lies in
(C f(m'))_i + sum over j != i of (C J)_ij (X_j - m_j), where m'_i = e and m'_j = m_j else: the
mean-value form on that face. It lies in the natural form as well.
"""

from __future__ import annotations

import numpy as np

from intervals.array import Mask
from intervals.generic import ends, meet, middle
from intervals.systems import Box, Function, Matrix, components, dot, matrix_product, spread


def signs_on_faces(f: Function, box: Box, jacobian: Matrix, inverse: Matrix) -> Mask:
    """Return where the theorem holds for C = I, or for C = inverse, proved to be regular."""
    n = len(box)
    identity = [[int(i == j) for j in range(n)] for i in range(n)]
    plain = _opposite(f, box, identity, jacobian)
    if plain.all():
        return plain
    product = matrix_product(inverse, jacobian)
    return plain | (_regular(inverse, jacobian) & _opposite(f, box, inverse, product))


def _opposite(f: Function, box: Box, factor: Matrix, product: Matrix) -> Mask:
    """Return where (C f)_i has opposite signs on opposite faces, for each i; product is C J."""
    certain = np.asarray(True)
    for i, x in enumerate(box):
        around = spread(product[i], box, i)
        values = []
        for end in ends(x):
            face = [*box[:i], end, *box[i + 1 :]]
            centre = [middle(y) for y in face]
            centred = dot(factor[i], components(f(*centre))) + around
            values.append(meet(dot(factor[i], components(f(*face))), centred))
        low, high = values
        rising = (low.sup <= 0) & (high.inf >= 0)
        certain = certain & (rising | ((low.inf >= 0) & (high.sup <= 0)))
    return certain


def _regular(inverse: Matrix, jacobian: Matrix) -> Mask:
    """Return where C is regular: C B is strictly diagonally dominant for the middle B of J."""
    product = matrix_product(inverse, [[middle(x) for x in row] for row in jacobian])
    dominant = np.asarray(True)
    for i, row in enumerate(product):
        others = sum((abs(x) for j, x in enumerate(row) if j != i), 0)
        dominant = dominant & (abs(row[i]) - others).certainly_positive()
    return dominant
