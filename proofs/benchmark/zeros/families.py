"""Systems of n equations in n variables, for every n: each function takes the variables.

Sources: see `systems`. Coefficients are exact: ints and Fractions.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

q = Fraction


def broyden_tridiagonal(*x: Any) -> list[Any]:
    """Return (3 - 2 x_i) x_i - x_(i-1) - 2 x_(i+1) + 1 (MGH 30)."""
    y = (0, *x, 0)
    return [(3 - 2 * b) * b - a - 2 * c + 1 for a, b, c in zip(y, x, y[2:], strict=False)]


def broyden_banded(*x: Any) -> list[Any]:
    """Return x_i (2 + 5 x_i^2) + 1 less the sum of x_j (1 + x_j) for its neighbours (MGH 31)."""

    def row(i: int) -> Any:
        near = (x[j] * (1 + x[j]) for j in range(max(0, i - 5), min(len(x), i + 2)) if j != i)
        return x[i] * (2 + 5 * x[i].sqr()) + 1 - sum(near, 0 * x[i])

    return [row(i) for i in range(len(x))]


def brown(*x: Any) -> list[Any]:
    """Return x_i + x_1 + ... + x_n - (n + 1) for i < n, and the product less 1 (MGH 27).

    x_1 = ... = x_(n-1) = t with n t^n - (n + 1) t^(n-1) + 1 = 0: t = 1, one t in (0, 1), and one
    below 0 if n is odd.
    """
    n, total, product = len(x), sum(x[1:], x[0]), x[0]
    for y in x[1:]:
        product = product * y
    return [*(y + total - (n + 1) for y in x[:-1]), product - 1]


def bratu(*x: Any) -> list[Any]:
    """Return x_(i-1) - 2 x_i + x_(i+1) + exp(x_i) / (n + 1)^2."""
    y, h = (0, *x, 0), Fraction(1, (len(x) + 1) ** 2)
    return [a - 2 * b + c + h * b.exp() for a, b, c in zip(y, x, y[2:], strict=False)]


def discrete_boundary(*x: Any) -> list[Any]:
    """Return the discrete boundary value problem (MGH 28)."""
    y, h = (0, *x, 0), Fraction(1, len(x) + 1)
    return [
        2 * b - a - c + (b + i * h + 1) ** 3 * (h**2 / 2)
        for i, (a, b, c) in enumerate(zip(y, x, y[2:], strict=False), 1)
    ]


def discrete_integral(*x: Any) -> list[Any]:
    """Return the discrete integral equation (MGH 29)."""
    n, h = len(x), Fraction(1, len(x) + 1)
    cubes = [(y + i * h + 1) ** 3 for i, y in enumerate(x, 1)]

    def row(i: int) -> Any:
        left = sum(((1 - i * h) * j * h * cubes[j - 1] for j in range(1, i + 1)), 0 * x[0])
        return x[i - 1] + h / 2 * sum(
            (i * h * (1 - j * h) * cubes[j - 1] for j in range(i + 1, n + 1)), left
        )

    return [row(i) for i in range(1, n + 1)]


def trigexp(*x: Any) -> list[Any]:
    """Return the first system of this name."""

    def waves(a: Any, b: Any) -> Any:
        return (a - b).sin() * (a + b).sin()

    first = 3 * x[0] ** 3 + 2 * x[1] - 5 + waves(x[0], x[1])
    inner = [
        3 * b**3 + b * 4 - a * (a - b).exp() + 2 * c + waves(b, c) - 8
        for a, b, c in zip(x, x[1:], x[2:], strict=False)
    ]
    return [first, *inner, 4 * x[-1] - x[-2] * (x[-2] - x[-1]).exp() - 3]


def henon(*x: Any) -> list[Any]:
    """Return 1 - 1.4 x_i^2 + 0.3 x_(i-1) - x_(i+1): cycles of Henon's map, of period n or less."""
    a, b = q("1.4"), q("0.3")
    return [1 - a * y.sqr() + b * x[i - 1] - x[(i + 1) % len(x)] for i, y in enumerate(x)]


def brent(*x: Any) -> list[Any]:
    """Return Brent's equations; for n = 2 the first gives x_2 = k x_1, two k; the other two x_1."""
    y = (0, *x, 20)
    return [
        3 * b * (c - 2 * b + a) + (c - a) ** 2 / 4 if i else 3 * b * (c - 2 * b) + c**2 / 4
        for i, (a, b, c) in enumerate(zip(y, x, y[2:], strict=False))
    ]


def troesch(*x: Any) -> list[Any]:
    """Return Troesch's boundary value problem, discrete."""
    y, h = (0, *x, 1), Fraction(1, len(x) + 1)
    return [
        2 * b - a - c + 10 * h**2 * (10 * b).sinh() for a, b, c in zip(y, x, y[2:], strict=False)
    ]


def economics(*x: Any) -> list[Any]:
    """Return (sum over j of x_j x_(j+k), x_0 = 1) x_n - k, and x_1 + ... + x_(n-1) + 1."""
    *y, last = x
    n = len(x)
    lines = [
        (y[k] + sum((y[j] * y[j + k + 1] for j in range(n - k - 2)), 0 * last)) * last - (k + 1)
        for k in range(n - 1)
    ]
    return [*lines, sum(y[1:], y[0]) + 1]


def redeco(*x: Any) -> list[Any]:
    """Return the reduced economics system; the last variable is u."""
    *y, u = x
    m = len(y)
    lines = [
        y[k] + sum((y[j] * y[j + k + 1] for j in range(m - k - 1)), 0 * u) - (k + 1) * u
        for k in range(m)
    ]
    return [*lines, sum(y[1:], y[0]) + 1]


def katsura(*u: Any) -> list[Any]:
    """Return Katsura's equations of a magnet, for u_0, ..., u_n."""
    n = len(u) - 1

    def at(k: int) -> Any:
        return u[abs(k)] if abs(k) <= n else 0 * u[0]

    lines = [sum((at(j) * at(m - j) for j in range(-n, n + 1)), 0 * u[0]) - u[m] for m in range(n)]
    return [*lines, u[0] + 2 * sum(u[2:], u[1]) - 1]


def wood(*x: Any) -> list[Any]:
    """Return the gradient of Wood's function (MGH 14)."""
    a, b, c, d = x
    return [
        200 * a * (b - a.sqr()) + 1 - a,
        200 * (b - a.sqr()) + q("20.2") * (b - 1) + q("19.8") * (d - 1),
        180 * c * (d - c.sqr()) + 1 - c,
        180 * (d - c.sqr()) + q("20.2") * (d - 1) + q("19.8") * (b - 1),
    ]


def freudenstein(x: Any, y: Any) -> list[Any]:
    """Return the equations of Freudenstein and Roth (MGH 2)."""
    return [x - 13 + y * (y * (5 - y) - 2), x - 29 + y * (y * (y + 1) - 14)]


def yamamura(*x: Any) -> list[Any]:
    """Return 2.5 x_i^3 - 10.5 x_i^2 + 11.8 x_i - i + x_1 + ... + x_n."""
    total = sum(x[1:], x[0])
    return [
        y * (y * (q("2.5") * y - q("10.5")) + q("11.8")) - i + total for i, y in enumerate(x, 1)
    ]


def trigonometric(*x: Any) -> list[Any]:
    """Return n - sum of cos x_j + i (1 - cos x_i) - sin x_i (MGH 26)."""
    n, total = len(x), sum((y.cos() for y in x[1:]), x[0].cos())
    return [n - total + i * (1 - y.cos()) - y.sin() for i, y in enumerate(x, 1)]


def trigexp_two(*x: Any) -> list[Any]:
    """Return the second system of this name, for odd n > 3: for 3 two of the equations agree."""
    m = len(x) // 2
    triples = [x[2 * k : 2 * k + 3] for k in range(m)]
    waves = [(a - b - c).sin() * (a + b - c).sin() for a, b, c in triples]
    cubes = [3 * (a - c) ** 3 for a, _, c in triples]
    lines = [waves[0] + 2 * x[1] - 5 + cubes[0]]
    for k, (a, b, c) in enumerate(triples):
        lines.append(4 * b - 3 - (a - b - c).exp() * (a - c))
        here = -2 * waves[k] - 4 * b - 2 * cubes[k]
        if k + 1 < m:
            lines.append(here + 5 + waves[k + 1] - 2 * x[2 * k + 3] + cubes[k + 1])
        else:
            lines.append(here + 10)
    return lines


def eiger(*x: Any) -> list[Any]:
    """Return (x_i - 1/100)^2 + x_(i+1), and x_1 + x_n - 1/5 (Eiger, Sikorski, Stenger)."""
    lines = [(a - q("0.01")) ** 2 + b for a, b in pairwise(x)]
    return [*lines, x[0] + x[-1] - q("0.2")]


def reactors(*x: Any) -> list[Any]:
    """Return the equations of countercurrent reactors, for even n."""
    half, n = q("0.5"), len(x)
    before, after = (1, 0, *x), (*x[2:], 0, 1)
    rows = []
    for i in range(n):
        partner = x[i + 1] if i % 2 == 0 else x[i - 1]
        rate = half if i % 2 == 0 else 3 * half
        rows.append(half * before[i] - rate * after[i] - x[i] * (1 + 4 * partner))
    return rows


def freudenstein_pairs(*x: Any) -> list[Any]:
    """Return the equations of Freudenstein and Roth for each pair (MGH 2)."""
    pairs = zip(x[::2], x[1::2], strict=True)
    return [line for a, b in pairs for line in freudenstein(a, b)]


def rosenbrock(*x: Any) -> list[Any]:
    """Return 10 (b - a^2), 1 - a for each pair (MGH 1, 21)."""
    pairs = zip(x[::2], x[1::2], strict=True)
    return [line for a, b in pairs for line in (10 * (b - a.sqr()), 1 - a)]


def chebyquad(*x: Any) -> list[Any]:
    """Return the mean of T_i(2 x_j - 1), less its integral over [0, 1] (MGH 35).

    The equations fix the power sums of the x_j, hence them but for their order: n! zeros or none.
    """
    n = len(x)

    def polynomial(i: int, y: Any) -> Any:
        last, value = 1 + 0 * y, 2 * y - 1
        for _ in range(i - 1):
            last, value = value, 2 * (2 * y - 1) * value - last
        return value

    sums = [sum((polynomial(i, y) for y in x[1:]), polynomial(i, x[0])) for i in range(1, n + 1)]
    return [
        total * q(1, n) + (q(1, i * i - 1) if i % 2 == 0 else 0) for i, total in enumerate(sums, 1)
    ]


def noon(*x: Any) -> list[Any]:
    """Return x_i times the sum of the other squares, - 1.1 x_i + 1 (Noonburg's neural network)."""
    total = sum((y.sqr() for y in x[1:]), x[0].sqr())
    return [y * (total - y.sqr() - q("1.1")) + 1 for y in x]


def wright(*x: Any) -> list[Any]:
    """Return x_i^2 - 2 x_i + x_1 + ... + x_n - 10.

    x_i = 1 + s_i t for signs s_i and t > 0, t^2 = 11 - n - t (s_1 + ... + s_n): 2^n zeros, n < 11.
    """
    total = sum(x[1:], x[0])
    return [y.sqr() - 2 * y + total - 10 for y in x]


def quadrature(*x: Any) -> list[Any]:
    """Return the moments of Gauss's rule, n / 2 weights, then nodes, on [-1, 1]: (n / 2)! zeros."""
    m = len(x) // 2
    weights, nodes = x[:m], x[m:]
    lines = []
    for k in range(2 * m):
        terms = [w * y**k if k else w for w, y in zip(weights, nodes, strict=True)]
        lines.append(sum(terms[1:], terms[0]) - (q(2, k + 1) if k % 2 == 0 else 0))
    return lines


def cyclic(*x: Any) -> list[Any]:
    """Return the cyclic n-roots equations: sums of products of k neighbours, and all's less 1."""
    n = len(x)

    def run(i: int, k: int) -> Any:
        product = x[i]
        for j in range(1, k):
            product = product * x[(i + j) % n]
        return product

    lines = [sum((run(i, k) for i in range(1, n)), run(0, k)) for k in range(1, n)]
    return [*lines, run(0, n) - 1]
