"""The list: name, source, function, box, and how many zeros there are.

`known` is the number of zeros in the box: as published with the system (Araya, Trombettoni, Neveu
2010 for many), or where it follows from the definition, see the function's docstring; None where
neither is known to us.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from math import factorial
from typing import Any, NamedTuple

from intervals import Interval
from proofs.benchmark.zeros import families as many
from proofs.benchmark.zeros import single as one

Box = list[Interval]


class System(NamedTuple):
    """f = 0 in a box, and how many zeros there are, of those with where >= 0 if it is given."""

    name: str
    source: str
    f: Callable[..., Any]
    box: Box
    known: int | None = None
    where: Callable[..., Any] | None = None
    boxes: int = 5000  # sub-boxes that are examined, about


def side(low: int | str, high: int | str) -> Interval:
    """Return an interval with binary64 ends, which decimals are rounded to."""
    return Interval(*(Fraction(float(Fraction(end))) for end in (low, high)))


def cube(n: int, low: int | str, high: int | str) -> Box:
    """Return n equal sides."""
    return [side(low, high)] * n


WIDE = 10**8
MANY, FEW = 100_000, 100  # sub-boxes where many are needed, and where each takes long
TURN = Interval(0, 2 * Interval.pi().sup)
FAMILIES: tuple[tuple[str, str, Callable[..., Any], tuple[int, ...], Any, Any, Any], ...] = (
    ("Broyden tridiagonal", "MGH", many.broyden_tridiagonal, (3, 4, 5, 6, 8, 10, 12, 16),
     -100, 100, lambda n: 2),
    ("Broyden banded", "MGH", many.broyden_banded, (2, 3, 4, 5, 6, 8, 10, 12), -100, 100,
     lambda n: 1),
    ("Brown almost linear", "MGH", many.brown, (3, 4, 5, 6, 7, 8, 10), -WIDE, WIDE,
     lambda n: 2 + n % 2),
    ("Bratu", "IBEX", many.bratu, (3, 4, 5, 8, 10, 15), -WIDE, 20, lambda n: 2),
    ("discrete boundary value", "MGH", many.discrete_boundary, (2, 3, 5, 8, 10, 12), -100, 100,
     lambda n: 1),
    ("discrete integral", "MGH", many.discrete_integral, (2, 3, 4, 5, 6), -100, 100,
     lambda n: 1),
    ("trigexp", "IBEX", many.trigexp, (2, 3, 4, 5, 6, 8), -100, 100, lambda n: 1),
    ("trigexp 2", "IBEX", many.trigexp_two, (5, 7, 9), -200, 200, None),
    ("trigonometric", "MGH", many.trigonometric, (2, 3, 4, 5), "0.00000001", "6.28318529", None),
    ("Henon", "Galias", many.henon, (1, 2, 4, 6, 7, 8, 9, 11), -2, 2,
     {1: 2, 2: 4, 4: 8, 6: 16, 7: 30, 8: 64, 9: 56, 11: 156}.get),
    ("Brent", "IBEX", many.brent, (2, 3, 4, 5, 6), -WIDE, WIDE, {2: 4}.get),
    ("Troesch", "IBEX", many.troesch, (3, 5, 8, 10), -10, 10, lambda n: 1),
    ("economics", "PHC", many.economics, (3, 4, 5, 6), -100, 100, None),
    ("redeco", "IBEX", many.redeco, (4, 5, 6, 7, 8), -WIDE, WIDE, {8: 8}.get),
    ("Katsura", "PHC", many.katsura, (3, 4, 5, 6, 7), 0, 1, None),
    ("Yamamura", "IBEX", many.yamamura, (3, 4, 5, 6, 8), -WIDE, WIDE, {8: 7}.get),
    ("Eiger", "IBEX", many.eiger, (2, 4, 6, 8, 10), -WIDE, WIDE, None),
    ("reactors", "IBEX", many.reactors, (2, 4, 6), -(10**5), 10**5, None),
    ("Freudenstein", "MGH", many.freudenstein_pairs, (2, 4, 6), -WIDE, WIDE, lambda n: 1),
    ("Rosenbrock", "MGH", many.rosenbrock, (2, 4), -WIDE, WIDE, lambda n: 1),
    ("chebyquad", "MGH", many.chebyquad, (2, 3, 4, 5), 0, 1, factorial),
    ("noon", "PHC", many.noon, (2, 3, 4), -10, 10, None),
    ("Wright", "PHC", many.wright, (3, 4, 5), -20, 20, lambda n: 2**n),
    ("quadrature", "PHC", many.quadrature, (2, 4, 6), -10, 10, lambda n: factorial(n // 2)),
    ("cyclic", "PHC", many.cyclic, (3, 5), -10, 10, {3: 0}.get),
)  # name, source, f, numbers of variables, ends of the box, number of zeros (by size)  # fmt: skip


def systems() -> Iterator[System]:
    """Yield all of them."""
    for name, source, f, sizes, low, high, count in FAMILIES:
        for n in sizes:
            many_or_few = {"quadrature 6": FEW, "redeco 8": MANY}.get(f"{name} {n}", 20_000)
            known = count and count(n)
            yield System(f"{name} {n}", source, f, cube(n, low, high), known, None, many_or_few)
    yield System("Wood 4", "IBEX", many.wood, cube(4, -(10**6), 10**6))
    yield from _cycles()
    yield from _with_pi()
    yield from _polynomial()
    yield from _other()
    yield from _in_one_variable()


def _cycles() -> Iterator[System]:
    """Yield Henon's cycles of a period that divides n, each from its least point.

    Galias has 14, 32, 364 cycles of prime period 11, 13, 19, and there are two fixed points.
    """

    def least(*x: Any) -> list[Any]:
        return [y - x[0] for y in x[1:]]

    for n, count in ((11, 16), (13, 34), (19, 366)):
        yield System(f"Henon's cycles {n}", "IBEX", many.henon, cube(n, -2, 2), count, least)


def _with_pi() -> Iterator[System]:
    """Yield those with trigonometric functions."""
    quarter = side("-3.2044245066615893", "3.2044245066615893")  # 1.02 pi
    half = side("-1.5707963267948968", "1.5707963267948968")
    yield System("Kin1", "IBEX", one.kinematics, [TURN] * 6, 16)
    yield System("Sjirk Boon", "IBEX", one.sjirk_boon, [*cube(2, -100, 100), TURN, TURN])
    turned = [side("-0.5", "5.7831853071795862"), side(-10, 30)]
    yield System("numerical analysis", "IBEX", one.numerical_analysis, turned, 13)
    yield System("Boggs", "Floudas", one.boggs, cube(2, -10, 10), 3)
    pair = [side("0.25", 1), side("1.5", "6.2831853071795862")]
    yield System("Ferraris, Tronconi", "Floudas", one.ferraris, pair, 2)
    yield System("Rastrigin", "IntervalRootFinding.jl", one.rastrigin, cube(2, -5, 6), 529)
    ends = [quarter, quarter, half, half]
    smiley = "IntervalRootFinding.jl"
    yield System("Smiley, Chun 2.2", smiley, one.smiley_chun, cube(2, -3, 3), 8)
    yield System("Smiley, Chun 5.2", smiley, one.smiley_chun_spheres, cube(3, -3, 3), 24)
    scaled = [side(-510, "1.4"), side(-510, "1.1")]
    yield System("Smiley, Chun 5.4", smiley, one.smiley_chun_scaled, scaled, 7)
    yield System("Smiley, Chun 5.5", smiley, one.smiley_chun_pendulum, ends, 41)


def _polynomial() -> Iterator[System]:
    """Yield the polynomial ones."""
    yield System("Caprasse", "PHC", one.caprasse, cube(4, -10, 10), 18)
    yield System("I1", "IBEX", one.moore_jones(one.plain), cube(10, -2, 2), 1)
    yield System("I5", "IBEX", one.moore_jones(one.fifth), cube(10, -100, 100), 30, None, FEW)
    yield System("Bellido", "IBEX", one.bellido, cube(9, -WIDE, WIDE), 8, None, MANY)
    yield System("combustion", "IBEX", one.combustion, cube(5, -WIDE, WIDE), 4)
    yield System("Virasoro", "IBEX", one.virasoro, cube(8, -1, 1), 224)
    yield System("generalised eigenvalues", "IBEX", one.geneig, cube(6, -WIDE, WIDE), 10)
    yield System("dipole", "IBEX", one.dipole, cube(8, -1000, 1000))
    yield System("cyclohexane", "IBEX", one.cyclohexane, cube(3, -WIDE, WIDE), 16)
    yield System("robot", "Floudas", one.robot, cube(8, -1, 1), 16)
    yield System("Himmelblau", "Floudas", one.himmelblau, cube(2, -5, 5), 4)
    yield System("Himmelblau's extrema", "Floudas", one.himmelblau_extrema, cube(2, -5, 5), 9)
    yield System("six-hump camel", "Floudas", one.camel, cube(2, -5, 5), 15)
    yield System("Powell singular", "MGH", one.powell_singular, cube(4, -100, 100), 1)
    ends = ("0.0333", "0.2173"), ("0.4", "0.6"), ("0.786", "0.9666"), ("-3071", "-0.1071")
    box = [side(*pair) for pair in (*ends, ("1.1071", "1.3071"), ("-2.1", "-1.9"))]
    yield System("Kolev", "IBEX", one.kolev, box)


def _other() -> Iterator[System]:
    """Yield those with exponentials and quotients."""
    yield System("transistor", "IBEX", one.transistor, cube(9, 0, 10), 1)
    yield System("Osborne", "IBEX", one.osborne, cube(5, -10, 10))
    yield System("Biggs", "IBEX", one.biggs, cube(6, -20, 20))
    yield System("Powell badly scaled", "MGH", one.powell, cube(2, 0, 100), 2)
    pair = [side("0.00000549", "4.553"), side("0.002196", "18.21")]
    yield System("Bullard, Biegler", "Floudas", one.bullard, pair, 1)
    ends = ("-0.9", "-0.7"), ("-0.03", "-0.01"), ("-2.7", "-2.6"), ("0.7", "0.8")
    inner = ("1.35", "1.45"), ("6.9", 7), ("1.15", "1.25")
    yield System(
        "Hayes", "IBEX", one.hayes, [side(*pair) for pair in (*ends, *inner)], 1, None, FEW
    )


def _in_one_variable() -> Iterator[System]:
    """Yield the functions of Ratz that have finitely many zeros where he looks for them."""
    for k, f in enumerate(one.RATZ, 1):
        if k != 8:  # atan(cos(tan x)): its zeros accumulate at pi/2
            yield System(f"Ratz {k}", "IntervalRootFinding.jl", f, cube(1, "0.75", "1.75"))
