"""Single systems: each function takes the variables and returns as many equations.

Sources: see `systems`. Coefficients are exact: ints and Fractions.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from intervals import Interval

q = Fraction


def caprasse(x: Any, y: Any, z: Any, t: Any) -> list[Any]:
    """Return the system of Caprasse and Demaret."""
    return [
        2 * t * x * y - 2 * x + (y.sqr() - 1) * z,
        2 + 4 * x.sqr() - 10 * t * y + 4 * t * x.sqr() * y - 10 * y.sqr() + 2 * t * y**3
        + 4 * x * z - x**3 * z + 4 * x * y.sqr() * z,
        (t.sqr() - 1) * x - 2 * z + 2 * t * y * z,
        2 - 10 * t.sqr() - 10 * t * y + 2 * t**3 * y + 4 * x * z + 4 * t.sqr() * x * z
        + 4 * z.sqr() + 4 * t * y * z.sqr() - x * z**3,
    ]  # fmt: skip


def kinematics(*t: Any) -> list[Any]:
    """Return the inverse position problem of a robot with six joints, Kin1."""
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
    """Return x_i less a constant and a factor times a product, and another term of powers."""

    def f(*x: Any) -> list[Any]:
        lines = []
        for i, (constant, factor, three, two) in enumerate(MOORE_JONES):
            first, second = power([x[j - 1] for j in three], [x[j - 1] for j in two])
            lines.append(x[i] - q(constant) - q(factor) * first + second)
        return lines

    return f


def plain(a: list[Any], b: list[Any]) -> tuple[Any, Any]:
    """Return a product, and no other term: I1."""
    return a[0] * a[1] * a[2], 0 * b[0]


def fifth(a: list[Any], b: list[Any]) -> tuple[Any, Any]:
    """Return a product cubed, and another of powers four and seven: I5."""
    return (a[0] * a[1] * a[2]) ** 3, b[0] ** 4 * b[1] ** 7


def sjirk_boon(a: Any, b: Any, s: Any, t: Any) -> list[Any]:
    """Return a problem of control by Boon."""
    return [
        5 + a * (3 * s).cos() + b * (3 * t).cos(),
        a * s.cos() + b * t.cos() - 3,
        a * (3 * s).sin() + b * (3 * t).sin(),
        a * s.sin() + b * t.sin() - 4,
    ]


def bellido(*x: Any) -> list[Any]:
    """Return the inverse kinematics of a parallel robot."""
    a, b, c, d, e, g, h, i, j = x
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
    """Return the equilibrium of combustion of propane, for five variables."""
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


def virasoro(*x: Any) -> list[Any]:
    """Return the equations of a construction of Virasoro algebras."""
    a, b, c, d, e, g, h, i = x
    return [
        a * (8 * (a + b + c) + 2 * (d + e + g + h) - 1) - 8 * b * c - 2 * (d * h + e * g),
        b * (8 * (a + b + c) + 2 * (d + e + g + h) - 1) - 8 * a * c - 2 * (d * g + e * h),
        c * (8 * (a + b + c) + 2 * (d + e + g + h) - 1) - 8 * a * b - 2 * (d * e + g * h),
        d * (2 * (a + b + c) + 8 * (d + e) + 2 * (g + h) + 6 * i - 1)
        - 2 * (a * h + b * g + c * e) - 6 * e * i,
        e * (2 * (a + b + c) + 8 * (d + e) + 2 * (g + h) + 6 * i - 1)
        - 2 * (a * g + b * h + c * d) - 6 * d * i,
        g * (2 * (a + b + c) + 2 * (d + e) + 8 * (g + h) + 6 * i - 1)
        - 2 * (a * e + b * d + c * h) - 6 * h * i,
        h * (2 * (a + b + c) + 2 * (d + e) + 8 * (g + h) + 6 * i - 1)
        - 2 * (a * d + b * e + c * g) - 6 * g * i,
        i * (6 * (d + e + g + h) + 8 * i - 1) - 6 * (d * e + g * h),
    ]  # fmt: skip


def geneig(*x: Any) -> list[Any]:
    """Return a generalised eigenvalue problem, quadratic in the last variable."""
    matrices = (
        ((10, 2, -1, 2, -2), (2, 9, 3, -1, -2), (-1, 3, 10, 2, -1), (2, -1, 2, 12, 1),
         (-2, -2, -1, 1, 10)),
        ((1, 2, 1, 2, 1), (2, 1, 2, 1, 3), (1, 2, 0, -2, -2), (2, 1, -2, 2, 3), (1, 3, -2, 3, 3)),
        ((-10, 2, -1, 1, 3), (2, -11, 2, -2, 1), (-1, 2, -12, -1, 1), (1, -2, -1, -10, 2),
         (3, 1, 1, 2, -11)),
    )  # fmt: skip
    *v, y = x
    parts = [
        [sum((a * b for a, b in zip(row[1:], v[1:], strict=True)), row[0] * v[0]) for row in one]
        for one in matrices
    ]
    rows = zip(*parts, strict=True)
    lines = [constant + y * (linear + y * square) for constant, linear, square in rows]
    return [*lines, sum(v[1:], v[0]) - 1]


TRANSISTOR = (
    ("0.485", "0.752", "0.869", "0.982"),
    ("0.369", "1.254", "0.703", "1.455"),
    ("5.2095", "10.0677", "22.9274", "20.2153"),
    ("23.3037", "101.779", "111.461", "191.267"),
    ("28.5132", "111.8467", "134.3884", "211.4823"),
)


def transistor(*x: Any) -> list[Any]:
    """Return the design of a transistor circuit (Ebers and Moll)."""
    a, b, c, d, e, g, h, i, j = x
    left = (1 - a * b) * c
    right = (1 - a * b) * d
    lines = []
    for g1, g2, g3, g4, g5 in (map(q, column) for column in zip(*TRANSISTOR, strict=True)):
        lines += [
            left * ((e * (g1 - g3 / 1000 * h - g5 / 1000 * i)).exp() - 1) - g5 + g4 * b,
            right * ((g * (g1 - g2 - g3 / 1000 * h + g4 / 1000 * j)).exp() - 1) - g5 * a + g4,
        ]
    return [*lines, a * c - b * d]


def hayes(*x: Any) -> list[Any]:
    """Return Hayes's rational approximation problem; s, t, u are the inner points."""
    a, b, c, d, s, t, u = x
    low, high = 1 + a + b, 1 - a + b
    at = [1 + y * (a + b * y) for y in (s, t, u)]
    return [
        52 * low - 90 * (2 + c + d),
        90 * high - 30 * (2 - c + d),
        58 * at[0] - 41 * (2 + s * (c + d * s)),
        159600 * (1 + s) / high - q(2803905, 8) * (1 - s) / low - q(3080337, 8) * s
        - 54944 * (u - s) / at[2],
        89760 * (1 + s) / high + q(7312635, 32) * (1 - s) / low + q(7677115, 32) * s
        - 99586 * (t - s) / at[1],
        -q(2803905, 4) * (1 - s) / low - q(3080337, 8) * s - 54944 * (1 + u) * (u - s) / at[2],
        q(7312635, 16) * (1 - s) / low + q(7677115, 32) * s - 99586 * (1 + t) * (t - s) / at[1],
    ]  # fmt: skip


def kolev(*x: Any) -> list[Any]:
    """Return the equations of a quartic's extrema and their values (Kolev)."""
    a, b, c, d, e, g = x

    def slope(y: Any) -> Any:
        return d + y * (2 * e + y * (3 * g + 4 * y))

    def value(y: Any) -> Any:
        return y * (d + y * (e + y * (g + y)))

    return [
        slope(c), slope(b), slope(a), d + e + g + 1, value(b) + value(c), value(a) + value(b),
    ]  # fmt: skip


def cyclohexane(x: Any, y: Any, z: Any) -> list[Any]:
    """Return the conformations of cyclohexane: y^2 z^2 + y^2 + z^2 - 24 y z + 13, and so on."""
    pairs = ((y, z), (x, y), (z, x))
    return [a.sqr() * (1 + b.sqr()) + b * (b - 24 * a) + 13 for a, b in pairs]


def numerical_analysis(a: Any, b: Any) -> list[Any]:
    """Return 7/10 z^12 + 3/10 z^13 - 32, z = exp(i a - b), in its two parts: 13 zeros a turn."""
    large, small = q("0.7") * (-12 * b).exp(), q("0.3") * (-13 * b).exp()
    return [
        large * (12 * a).cos() + small * (13 * a).cos() - 32,
        large * (12 * a).sin() + small * (13 * a).sin(),
    ]


def osborne(a: Any, b: Any, c: Any, d: Any, e: Any) -> list[Any]:
    """Return five of the equations of Osborne's first function (MGH 17)."""
    values = enumerate(("0.844", "0.908", "0.932", "0.936", "0.925"))
    return [
        a + b * (-10 * k * d).exp() + c * (-10 * k * e).exp() - q(y) if k else a + b + c - q(y)
        for k, y in values
    ]


def biggs(*x: Any) -> list[Any]:
    """Return six of the equations of Biggs's function (MGH 18)."""
    a, b, c, d, e, g = x

    def decay(k: int, y: Any) -> Any:
        return (q(-k, 10) * y).exp()

    one = Interval(1)
    return [
        c * decay(k, a) - d * decay(k, b) + g * decay(k, e)
        - decay(k, one) + 5 * decay(k, 10 * one) - 3 * decay(k, 4 * one)
        for k in range(1, 7)
    ]  # fmt: skip


def dipole(*x: Any) -> list[Any]:
    """Return the moments of two dipoles (MINPACK-2)."""
    a, b, c, d, u, v, t, w = x
    p, r, s = t.sqr() - v.sqr(), u.sqr() - w.sqr(), 2 * t * v
    y = 2 * u * w
    m, n = t * (t.sqr() - 3 * v.sqr()), v * (v.sqr() - 3 * t.sqr())
    k, o = u * (u.sqr() - 3 * w.sqr()), w * (w.sqr() - 3 * u.sqr())
    return [
        a + b - q("0.63254"),
        c + d + q("1.34534"),
        a * t + b * u - c * v - d * w + q("0.8365348"),
        c * t + d * u + a * v + b * w - q("1.7345334"),
        a * p + b * r - c * s - d * y - q("1.352352"),
        c * p + d * r + a * s + b * y + q("0.843453"),
        a * m + b * k + c * n + d * o + q("0.9563453"),
        c * m + d * k - a * n - b * o - q("1.2342523"),
    ]


def boggs(x: Any, y: Any) -> list[Any]:
    """Return x^2 - y + 1, x - cos(pi y / 2): three zeros, at y = 1, 3/2, 2 (Boggs)."""
    return [x.sqr() - y + 1, x - (Interval.pi() * y / 2).cos()]


def himmelblau(x: Any, y: Any) -> list[Any]:
    """Return x^2 + y - 11, x + y^2 - 7."""
    return [x.sqr() + y - 11, x + y.sqr() - 7]


def himmelblau_extrema(x: Any, y: Any) -> list[Any]:
    """Return the gradient of the sum of the squares of these."""
    one, other = himmelblau(x, y)
    return [4 * x * one + 2 * other, 2 * one + 4 * y * other]


def camel(x: Any, y: Any) -> list[Any]:
    """Return the gradient of the six-hump camel function, with 6 minima, 2 maxima, 7 saddles."""
    return [x * (8 + x.sqr() * (q("-8.4") + 2 * x.sqr())) + y, x + y * (16 * y.sqr() - 8)]


def rastrigin(*x: Any) -> list[Any]:
    """Return the gradient of Rastrigin's function over 2: x_i + 10 pi sin(2 pi x_i)."""
    pi = Interval.pi()
    return [y + 10 * pi * (2 * pi * y).sin() for y in x]


def ferraris(x: Any, y: Any) -> list[Any]:
    """Return the system of Ferraris and Tronconi."""
    pi, e = Interval.pi(), Interval.e()
    return [
        (x * y).sin() / 2 - y / (4 * pi) - x / 2,
        (1 - 1 / (4 * pi)) * ((2 * x).exp() - e) + e * y / pi - 2 * e * x,
    ]


def bullard(x: Any, y: Any) -> list[Any]:
    """Return 10^4 x y - 1, exp(-x) + exp(-y) - 1.001 (Bullard and Biegler)."""
    return [10**4 * x * y - 1, (-x).exp() + (-y).exp() - q("1.001")]


def powell(x: Any, y: Any) -> list[Any]:
    """Return Powell's badly scaled function (MGH 3): a zero (x, y), and (y, x)."""
    return [10**4 * x * y - 1, (-x).exp() + (-y).exp() - q("1.0001")]


def powell_singular(a: Any, b: Any, c: Any, d: Any) -> list[Any]:
    """Return Powell's singular function (MGH 13), factors that are irrational left away."""
    return [a + 10 * b, c - d, (b - 2 * c).sqr(), (a - d).sqr()]


def robot(*x: Any) -> list[Any]:
    """Return the kinematics of a robot (Kearfott and Novoa, after Tsai and Morgan)."""
    a, b, c, d, e, g, h, i = x
    return [
        q("0.004731") * a * c - q("0.3578") * b * c - q("0.1238") * a + h - q("0.001637") * b
        - q("0.9338") * d - q("0.3571"),
        q("0.2238") * a * c + q("0.7623") * b * c + q("0.2638") * a - h - q("0.07745") * b
        - q("0.6734") * d - q("0.6022"),
        g * i + q("0.3578") * a + q("0.004731") * b,
        q("0.2238") * b - q("0.7623") * a + q("0.3461"),
        *(y.sqr() + z.sqr() - 1 for y, z in ((a, b), (c, d), (e, g), (h, i))),
    ]  # fmt: skip


def smiley_chun(x: Any, y: Any) -> list[Any]:
    """Return Example 2.2 of Smiley and Chun 2001: an ellipse, and four curves."""
    return [x.sqr() + 4 * y.sqr() - 4, y * (x - q("1.995")) * (y - x.sqr()) * (y - x + 1)]


def smiley_chun_spheres(x: Any, y: Any, z: Any) -> list[Any]:
    """Return Example 5.2 of Smiley and Chun 2001: two spheres, two planes, three planes."""
    square, plane = x.sqr() + y.sqr() + z.sqr(), (x + y) / 2 + z
    product = 0 * x + 1
    for i in (1, 2, 3):
        angle = Interval.pi() * i / 3
        sin, cos = angle.sin(), angle.cos()
        v = -(cos + sin) / 2
        distance = (sin - cos) / 10
        product = product * ((v / 2 - sin) * x + (cos - v / 2) * y + (sin - cos) / 2 * z - distance)
    return [(square - 1) * (square - 4), (plane - q("0.2")) * (plane + q("0.7")), product]


def smiley_chun_scaled(x: Any, y: Any) -> list[Any]:
    """Return Example 5.4 of Smiley and Chun 2001, rescaled."""
    return [
        x * (x.sqr() * (q("0.00001069") * x + 200 * y + 10**5) - 180000) - q("0.0001283"),
        y.sqr() * (x / 50 + 10) - 10,
    ]


def smiley_chun_pendulum(*x: Any) -> list[Any]:
    """Return Example 5.5 of Smiley and Chun 2001: orbits of period 1 and 2, of a pendulum."""
    pi = Interval.pi()
    rates = pi / 10, pi / 5
    decays = [(-2 * rate).exp() for rate in rates]
    steps = [(1 - decay) / (2 * rate) for decay, rate in zip(decays, rates, strict=True)]

    def step(a: Any, b: Any, c: Any, d: Any) -> tuple[Any, ...]:
        c, d = c - 5 * a.sin() * b.cos(), d - 5 * a.cos() * b.sin()
        return a + steps[0] * c, b + steps[1] * d, decays[0] * c, decays[1] * d

    return [after - before for after, before in zip(step(*step(*x)), x, strict=True)]


RATZ: tuple[Callable[[Any], Any], ...] = (
    lambda x: (x + x.sin()) * (-x.sqr()).exp(),
    lambda x: x * (x * (x * (x - 10) + 35) - 50) + 24,
    lambda x: ((x + q("1.25")).log() - q("0.84") * x).sqr(),
    lambda x: q("0.02") * x.sqr() - q("0.03") * (-(20 * (x - q("0.875"))).sqr()).exp(),
    lambda x: x.sqr().exp(),
    lambda x: x * (x * (x * (x - 12) + 47) - 60) - 20 * (-x).exp(),
    lambda x: x.sqr() * (x.sqr() * (x.sqr() - 15) + 27) + 250,
    lambda x: x.tan().cos().atan(),
    lambda x: x.sin().acos().cos().asin(),
)  # the functions of Ratz, An optimized interval slope arithmetic and its application
