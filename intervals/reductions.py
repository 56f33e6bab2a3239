"""Sums, products and matrix products of rows (-lower, upper), without BLAS.

Each is a tree or a chain of the rigorous + and * of `rows`, in an order that does not matter: the
inclusion principle holds for every bracketing.
"""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from intervals.rounding import Rows

Operation: TypeAlias = Callable[[Rows, Rows], Rows]


def pairwise(operation: Operation, rows: Rows, axis: int, neutral: tuple[float, float]) -> Rows:
    """Return rows of the sums, or products, over the element axis `axis` >= 0.

    Neighbours are combined until one is left: n terms lose at most ceil(log2 n) outward steps.
    `neutral` are the rows of the empty combination.
    """
    work = np.moveaxis(rows, axis + 1, 1)
    while work.shape[1] > 1:
        half = work.shape[1] // 2
        rest = work[:, 2 * half :]
        work = operation(work[:, :half], work[:, half : 2 * half])
        work = np.concatenate((work, rest), axis=1) if rest.shape[1] else work
    if work.shape[1]:
        return work[:, 0]
    empty = np.empty((2, *work.shape[2:]))
    empty[0], empty[1] = neutral
    return empty


def matrix_product(a: Rows, b: Rows, total: Operation, product: Operation) -> Rows:
    """Return rows of A B for matrices (..., n, k) and (..., k, m); stacks of them broadcast.

    k products of a column and a row are added up one after the other.
    """
    terms = a.shape[-1]
    if b.shape[-2] != terms:
        raise ValueError(f"matrices of shapes {a.shape[1:]} and {b.shape[1:]} do not fit")
    if not terms:
        lead = np.broadcast_shapes(a.shape[1:-2], b.shape[1:-2])
        return np.zeros((2, *lead, a.shape[-2], b.shape[-1]))
    result = product(a[..., :, :1], b[..., :1, :])
    for k in range(1, terms):
        result = total(result, product(a[..., :, k : k + 1], b[..., k : k + 1, :]))
    return result
