"""Systems of equations that others publish as tests of solvers, written from their definitions.

Sources: More, Garbow, Hillstrom 1981 (MGH) and their extensions; the benchmarks of the COPRIN
project (ALIAS) and of IBEX; Kearfott 1987; Galias 2001. `count` is the number of zeros in the box,
as published there (Araya, Neveu, Trombettoni 2010 for most), or where it follows from the
definition, which is then said; None where no count is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from intervals import Interval

Box = list[Interval]


class System(NamedTuple):
    """f = 0 in a box, and how many zeros there are."""

    name: str
    f: Callable[..., Any]
    box: Box
    count: int | None


def q(text: str) -> Fraction:
    return Fraction(text)


def cube(n: int, low: int | str, high: int | str) -> Box:
    """A cube with binary64 ends, which decimals are rounded to."""
    ends = [float(Fraction(end)) for end in (low, high)]
    return [Interval(*map(Fraction, ends))] * n


# -- families --------------------------------------------------------------------------------------


def broyden_tridiagonal(*x: Any) -> list[Any]:
    y = (0, *x, 0)
    return [(3 - 2 * b) * b - a - 2 * c + 1 for a, b, c in zip(y, x, y[2:], strict=False)]


def broyden_banded(*x: Any) -> list[Any]:
    def row(i: int) -> Any:
        near = (x[j] * (1 + x[j]) for j in range(max(0, i - 5), min(len(x), i + 2)) if j != i)
        return x[i] * (2 + 5 * x[i].sqr()) + 1 - sum(near, 0 * x[i])

    return [row(i) for i in range(len(x))]


def brown(*x: Any) -> list[Any]:
    n, total, product = len(x), sum(x[1:], x[0]), x[0]
    for y in x[1:]:
        product = product * y
    return [*(y + total - (n + 1) for y in x[:-1]), product - 1]


def bratu(*x: Any) -> list[Any]:
    y, h = (0, *x, 0), Fraction(1, (len(x) + 1) ** 2)
    return [a - 2 * b + c + h * b.exp() for a, b, c in zip(y, x, y[2:], strict=False)]


def discrete_boundary(*x: Any) -> list[Any]:
    y, h = (0, *x, 0), Fraction(1, len(x) + 1)
    return [
        2 * b - a - c + (b + i * h + 1) ** 3 * (h**2 / 2)
        for i, (a, b, c) in enumerate(zip(y, x, y[2:], strict=False), 1)
    ]


def discrete_integral(*x: Any) -> list[Any]:
    n, h = len(x), Fraction(1, len(x) + 1)
    cubes = [(y + i * h + 1) ** 3 for i, y in enumerate(x, 1)]

    def row(i: int) -> Any:
        left = sum(((1 - i * h) * j * h * cubes[j - 1] for j in range(1, i + 1)), 0 * x[0])
        return x[i - 1] + h / 2 * sum(
            (i * h * (1 - j * h) * cubes[j - 1] for j in range(i + 1, n + 1)), left
        )

    return [row(i) for i in range(1, n + 1)]


def trigexp(*x: Any) -> list[Any]:
    def waves(a: Any, b: Any) -> Any:
        return (a - b).sin() * (a + b).sin()

    first = 3 * x[0] ** 3 + 2 * x[1] - 5 + waves(x[0], x[1])
    inner = [
        3 * b**3 + b * 4 - a * (a - b).exp() + 2 * c + waves(b, c) - 8
        for a, b, c in zip(x, x[1:], x[2:], strict=False)
    ]
    return [first, *inner, 4 * x[-1] - x[-2] * (x[-2] - x[-1]).exp() - 3]


def henon(*x: Any) -> list[Any]:
    a, b = q("1.4"), q("0.3")
    return [1 - a * y.sqr() + b * x[i - 1] - x[(i + 1) % len(x)] for i, y in enumerate(x)]


def brent(*x: Any) -> list[Any]:
    """Brent's system. For n = 2 the first equation gives x_2 = k x_1, two k; the other two x_1."""
    y = (0, *x, 20)
    return [
        3 * b * (c - 2 * b + a) + (c - a) ** 2 / 4 if i else 3 * b * (c - 2 * b) + c**2 / 4
        for i, (a, b, c) in enumerate(zip(y, x, y[2:], strict=False))
    ]


def troesch(*x: Any) -> list[Any]:
    y, h = (0, *x, 1), Fraction(1, len(x) + 1)
    return [
        2 * b - a - c + 10 * h**2 * (10 * b).sinh() for a, b, c in zip(y, x, y[2:], strict=False)
    ]


def economics(*x: Any) -> list[Any]:
    """The economics system for n = len(x): sum over j of x_j x_(j+k), x_0 = 1, times x_n is k."""
    *y, last = x
    n = len(x)
    lines = [
        (y[k] + sum((y[j] * y[j + k + 1] for j in range(n - k - 2)), 0 * last)) * last - (k + 1)
        for k in range(n - 1)
    ]
    return [*lines, sum(y[1:], y[0]) + 1]


def redeco(*x: Any) -> list[Any]:
    *y, u = x
    m = len(y)
    lines = [
        y[k] + sum((y[j] * y[j + k + 1] for j in range(m - k - 1)), 0 * u) - (k + 1) * u
        for k in range(m)
    ]
    return [*lines, sum(y[1:], y[0]) + 1]


def katsura(*u: Any) -> list[Any]:
    n = len(u) - 1

    def at(k: int) -> Any:
        return u[abs(k)] if abs(k) <= n else 0 * u[0]

    lines = [sum((at(j) * at(m - j) for j in range(-n, n + 1)), 0 * u[0]) - u[m] for m in range(n)]
    return [*lines, u[0] + 2 * sum(u[2:], u[1]) - 1]


def wood(*x: Any) -> list[Any]:
    a, b, c, d = x
    return [
        200 * a * (b - a.sqr()) + 1 - a,
        200 * (b - a.sqr()) + q("20.2") * (b - 1) + q("19.8") * (d - 1),
        180 * c * (d - c.sqr()) + 1 - c,
        180 * (d - c.sqr()) + q("20.2") * (d - 1) + q("19.8") * (b - 1),
    ]


def freudenstein(x: Any, y: Any) -> list[Any]:
    return [x - 13 + y * (y * (5 - y) - 2), x - 29 + y * (y * (y + 1) - 14)]


# -- single ones -----------------------------------------------------------------------------------


def caprasse(x: Any, y: Any, z: Any, t: Any) -> list[Any]:
    return [
        2 * t * x * y - 2 * x + (y.sqr() - 1) * z,
        2 + 4 * x.sqr() - 10 * t * y + 4 * t * x.sqr() * y - 10 * y.sqr() + 2 * t * y**3
        + 4 * x * z - x**3 * z + 4 * x * y.sqr() * z,
        (t.sqr() - 1) * x - 2 * z + 2 * t * y * z,
        2 - 10 * t.sqr() - 10 * t * y + 2 * t**3 * y + 4 * x * z + 4 * t.sqr() * x * z
        + 4 * z.sqr() + 4 * t * y * z.sqr() - x * z**3,
    ]  # fmt: skip


def kinematics(*t: Any) -> list[Any]:
    """Kin1: the inverse position problem of a robot with six joints."""
    s, c = [x.sin() for x in t], [x.cos() for x in t]
    across = s[1] - s[2] - s[3]
    return [
        s[5] * c[4] * across + c[5] * (c[1] + c[2] + c[3]) - q("0.4077"),
        c[0] * s[4] * (c[1] + c[2] + c[3]) + s[0] * c[4] - q("1.9115"),
        s[4] * (s[1] + s[2] + s[3]) - q("1.9791"),
        c[0] * (3 * c[1] + 2 * c[2] + c[3]) - q("4.0616"),
        s[0] * (3 * c[1] + 2 * c[2] + c[3]) - q("1.7172"),
        3 * s[1] + 2 * s[2] + s[3] - q("3.9701"),
    ]


MOORE_JONES = (
    ("0.25428722", "0.18324757", (4, 3, 9), (3, 9)),
    ("0.37842197", "0.16275449", (1, 10, 6), (10, 6)),
    ("0.27162577", "0.16955071", (1, 2, 10), (2, 10)),
    ("0.19807914", "0.15585316", (7, 1, 6), (1, 6)),
    ("0.44166728", "0.19950920", (7, 6, 3), (6, 3)),
    ("0.14654113", "0.18922793", (8, 5, 10), (5, 10)),
    ("0.42937161", "0.21180486", (2, 5, 8), (5, 8)),
    ("0.07056438", "0.17081208", (1, 7, 6), (7, 6)),
    ("0.34504906", "0.19612740", (10, 6, 8), (6, 8)),
    ("0.42651102", "0.21466544", (4, 8, 1), (8, 1)),
)  # the constant, the factor of a product of three, and the two of another term


def moore_jones(power: Callable[[list[Any], list[Any]], tuple[Any, Any]]) -> Callable[..., Any]:
    def f(*x: Any) -> list[Any]:
        lines = []
        for i, (constant, factor, three, two) in enumerate(MOORE_JONES):
            first, second = power([x[j - 1] for j in three], [x[j - 1] for j in two])
            lines.append(x[i] - q(constant) - q(factor) * first + second)
        return lines

    return f


def plain(a: list[Any], b: list[Any]) -> tuple[Any, Any]:
    return a[0] * a[1] * a[2], 0 * b[0]


def fifth(a: list[Any], b: list[Any]) -> tuple[Any, Any]:
    return (a[0] * a[1] * a[2]) ** 3, b[0] ** 4 * b[1] ** 7


def sjirk_boon(a: Any, b: Any, s: Any, t: Any) -> list[Any]:
    return [
        5 + a * (3 * s).cos() + b * (3 * t).cos(),
        a * s.cos() + b * t.cos() - 3,
        a * (3 * s).sin() + b * (3 * t).sin(),
        a * s.sin() + b * t.sin() - 4,
    ]


def bellido(a: Any, b: Any, c: Any, d: Any, e: Any, g: Any, h: Any, i: Any, j: Any) -> list[Any]:
    return [
        (a - 6).sqr() + b.sqr() + c.sqr() - 104,
        d.sqr() + (e - 6).sqr() + g.sqr() - 104,
        h.sqr() + (i - 12).sqr() + (j - 6).sqr() - 80,
        a * (d - 6) + e * (b - 6) + c * g - 52,
        a * (h - 6) + i * (b - 12) + j * (c - 6) + 64,
        d * h + i * (e - 12) + j * (g - 6) - 6 * e + 32,
        2 * b + 2 * c - d - e - 2 * g - h - j + 18,
        a + b + 2 * c + 2 * d + 2 * g - 2 * h + i - j - 38,
        a + c - 2 * d + e - g + 2 * h - 2 * i + 8,
    ]


def combustion(a: Any, b: Any, c: Any, d: Any, e: Any) -> list[Any]:
    r5, r6, r7 = q("0.193"), q("0.0004106217542"), q("0.0005451766686")
    r8, r9, r10 = q("0.00000044975"), q("0.00003407354179"), q("0.0000009615")
    return [
        a * b + a - 3 * e,
        2 * a * b + a + b * c.sqr() + r8 * b - 10 * e + r7 * b * c + r9 * b * d
        + q("0.0000028845") * b.sqr(),
        2 * b * c.sqr() + 2 * r5 * c.sqr() - 8 * e + r6 * c + r7 * b * c,
        r9 * b * d + 2 * d.sqr() - 40 * e,
        a * (b + 1) + r10 * b.sqr() + b * c.sqr() + r8 * b + r5 * c.sqr() + d.sqr() - 1 + r6 * c
        + r7 * b * c + r9 * b * d,
    ]  # fmt: skip


WIDE = 10**8
FAMILIES: tuple[tuple[str, Callable[..., Any], tuple[int, ...], int, int, Any], ...] = (
    ("Broyden tridiagonal", broyden_tridiagonal, (3, 4, 5, 6, 8, 10, 12), -100, 100, 2),
    ("Broyden banded", broyden_banded, (2, 3, 4, 5, 6, 8, 10), -100, 100, 1),
    ("Brown almost linear", brown, (3, 4, 5, 6, 7), -WIDE, WIDE, {3: 3, 4: 2, 5: 3, 6: 2, 7: 3}),
    ("Bratu", bratu, (3, 4, 5, 8, 10, 15), -WIDE, 20, 2),
    ("discrete boundary value", discrete_boundary, (2, 3, 5, 8, 10, 12), -100, 100, 1),
    ("discrete integral", discrete_integral, (2, 3, 4, 5, 6, 8), -100, 100, 1),
    ("trigexp", trigexp, (2, 3, 4, 5, 6, 8), -100, 100, 1),
    ("Henon", henon, (1, 2, 4, 6, 7, 8, 9, 11), -2, 2,
     {1: 2, 2: 4, 4: 8, 6: 16, 7: 30, 8: 64, 9: 56, 11: 156}),
    ("Brent", brent, (2, 3, 4, 5, 6), -WIDE, WIDE, {2: 4}),
    ("Troesch", troesch, (3, 5, 8, 10), -10, 10, 1),
    ("economics", economics, (3, 4, 5, 6), -100, 100, {}),
    ("redeco", redeco, (4, 5, 6, 7, 8), -WIDE, WIDE, {6: 4, 7: 4, 8: 8}),
    ("Katsura", katsura, (3, 4, 5, 6), 0, 1, {}),
)  # name, f, numbers of variables, ends of the box, number of zeros (by size)  # fmt: skip


def systems() -> Iterator[System]:
    """Yield all of them."""
    for name, f, sizes, low, high, counts in FAMILIES:
        for n in sizes:
            count = counts.get(n) if isinstance(counts, dict) else counts
            yield System(f"{name} {n}", f, cube(n, low, high), count)
    turn = Interval(0, 2 * Interval.pi().sup)
    yield System("extended Wood 4", wood, cube(4, -(10**6), 10**6), None)
    yield System("extended Freudenstein 2", freudenstein, cube(2, -WIDE, WIDE), 1)
    yield System("Caprasse", caprasse, cube(4, -10, 10), 18)
    yield System("Kin1", kinematics, [turn] * 6, 16)
    yield System("I1 (Moore, Jones)", moore_jones(plain), cube(10, -2, 2), 1)
    yield System("I5 (Moore, Jones)", moore_jones(fifth), cube(10, -100, 100), 30)
    yield System("Sjirk Boon", sjirk_boon, [*cube(2, -100, 100), turn, turn], None)
    yield System("Bellido", bellido, cube(9, -WIDE, WIDE), 8)
    yield System("combustion", combustion, cube(5, -WIDE, WIDE), 4)
