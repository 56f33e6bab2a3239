"""The Henon map at a = 1.4, b = 0.3 against what is published.

Its trapping region is Henon's quadrilateral (Commun. Math. Phys. 50, 1976); the numbers of cycles
in it are those of Galias, Interval methods for rigorous investigations of periodic orbits,
Int. J. Bifurcation Chaos 11 (2001).
"""

from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from mpmath import matrix, mp, mpf

from intervals import Interval, Undecided
from proofs.methods.cells import Region, function_of, invariant_cover
from proofs.methods.lemmas import Lemmas
from proofs.methods.periodic import periodic_orbits
from proofs.methods.rectangles import lemma, rectangles
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import Reader
from proofs.trusted.files import render
from proofs.trusted.kernel import trees
from proofs.trusted.kernel.head import read_function
from proofs.trusted.verify import check
from tests.proofs.trusted.kernel.lemma_examples import Written, henon

HENON = henon("7/5", "3/10")
CORNERS = [("-1.33", "0.42"), ("-1.06", "-0.5"), ("1.245", "-0.14"), ("1.32", "0.133")]
TABLE = """
1 1 0 1 0 2 4 7 6 10 14 19 32 44 72 102 166 233 364 535 834 1225 1930 2902 4498 6806 10518 16031
24740 37936
"""
CYCLES = dict(enumerate(map(int, TABLE.split()), 1))  # by their least periods
SAMPLE = 40  # orbits of a period that are looked at one by one


@cache
def cover():
    formula = read_function("F", Reader({"variables": HENON[0], "values": HENON[1]}))
    return invariant_cover(function_of(formula), Region.convex(CORNERS))


# -- the trapping region ---------------------------------------------------------------------------


def trapped(corners):
    """The functions (b - a) x (F(P(s, t)) - a), P from [0, 1]^2 onto the quadrilateral."""
    s, t = Written("s"), Written("t")
    points = [tuple(map(Fraction, corner)) for corner in corners]
    weights = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t]
    x, y = (
        weights[0] * points[0][i]
        + weights[1] * points[1][i]
        + weights[2] * points[2][i]
        + weights[3] * points[3][i]
        for i in (0, 1)
    )
    image = 1 - x**2 * Fraction(7, 5) + y, x * Fraction(3, 10)
    sides = pairwise([*points, points[0]])
    values = [
        (image[1] - a[1]) * (b[0] - a[0]) - (image[0] - a[0]) * (b[1] - a[1]) for a, b in sides
    ]
    return [value.text for value in values]


@pytest.mark.slow
def test_the_quadrilateral_is_mapped_into_its_interior():
    file = Lemmas()
    for text in trapped(CORNERS):
        file.sign(text, 1, s=("0", "1"), t=("0", "1"))
    assert len(check(render(file.document())).sentences) == 4
    bounds = [step["witness"]["bounds"] for step in file.steps.values()]
    assert all(Fraction(low) > 0 for low, _ in bounds)


@pytest.mark.parametrize(("corner", "sign"), [(("-1.27", "0.42"), -1), (CORNERS[0], 1)])
def test_a_corner_that_is_moved_leaves(corner, sign):
    """The corner (-1.33, 0.42) at (-1.27, 0.42): F takes (1.32, 0.133) to (-1.306..., 0.396)."""
    first = trapped([corner, *CORNERS[1:]])[0]
    there = {"s": ("0", "0"), "t": ("1", "1")}
    file = Lemmas()
    file.sign(first, sign, **there)
    assert check(render(file.document())).sentences[0].startswith(f"`{trees.formula(first)}`")
    with pytest.raises((Undecided, ValueError)):
        file.sign(first, -sign, **there)


# -- cycles ----------------------------------------------------------------------------------------


def test_the_fixed_point_and_the_cycle_of_period_two():
    """x = (-7 + sqrt 609)/28; x + x' = 1/2, x x' = -13/28, trace 7.84 x x' + 0.6 = -3.04."""
    (fixed,) = periodic_orbits(cover(), 1)
    x, y = fixed.points[0]
    assert (28 * x + 7).sqr().contains(609) and x > 0
    assert (y - x * Fraction(3, 10)).contains(0)
    assert (fixed.trace + x * Fraction(14, 5)).contains(0)
    (cycle,) = [orbit for orbit in periodic_orbits(cover(), 2) if orbit.period == 2]
    (low, _), (high, _) = cycle.points
    assert (low + high).contains("1/2") and (low * high).contains("-13/28")
    assert cycle.trace.contains("-3.04")


@cache
def cycles(period):
    return periodic_orbits(cover(), period)


def check_cycles(periods):
    for n in periods:
        orbits = cycles(n)
        found = [orbit for orbit in orbits if orbit.period == n]
        assert len(found) == CYCLES[n]
        fixed = sum(d * CYCLES[d] for d in range(1, n + 1) if n % d == 0)
        assert sum(orbit.period for orbit in orbits) == fixed
        for orbit in found[:: 1 + len(found) // SAMPLE]:
            check_orbit(orbit)


def check_orbit(orbit):
    """Newton at 40 digits from the midpoints ends inside; the determinant is (-0.3)^n."""
    (a, b), (c, d) = orbit.derivative
    assert (a * d - b * c).contains(Fraction(-3, 10) ** orbit.period)
    with mp.workdps(40):
        x, y = newton([mpf(x.mid.numerator) / x.mid.denominator for x in orbit.points[0]], orbit)
        for sides in orbit.points:
            for side, value in zip(sides, (x, y), strict=True):
                assert as_mpf(side.inf) <= value <= as_mpf(side.sup)
                assert side.wid < Fraction(1, 10**10)
            x, y = 1 - mpf(7) / 5 * x**2 + y, mpf(3) / 10 * x


def as_mpf(x):
    return mpf(x.numerator) / x.denominator


def newton(point, orbit):
    for _ in range(3):
        (x, y), slope = point, mp.eye(2)
        for _ in range(orbit.period):
            slope = matrix([[-mpf(14) / 5 * x, 1], [mpf(3) / 10, 0]]) * slope
            x, y = 1 - mpf(7) / 5 * x**2 + y, mpf(3) / 10 * x
        step = mp.lu_solve(slope - mp.eye(2), matrix([x - point[0], y - point[1]]))
        point = [point[0] - step[0], point[1] - step[1]]
    return point


@pytest.mark.slow
def test_all_cycles_up_to_period_six():
    check_cycles(range(1, 7))


@pytest.mark.slow
@pytest.mark.parametrize("period", [*range(7, 13), 18])
def test_all_cycles_of_longer_periods(period):
    check_cycles([period])


@pytest.mark.long
@pytest.mark.parametrize("period", [22, 24, 26])
def test_all_cycles_of_the_longest_periods(period):
    check_cycles([period])


def test_the_other_fixed_point_is_outside_the_quadrilateral():
    """x = (-7 - sqrt 609)/28 = -1.131..., which the box around the quadrilateral contains."""
    box = invariant_cover(cover().f, Region((Interval("-1.4", "1.4"), Interval("-0.5", "0.5"))))
    other, _ = periodic_orbits(box, 1)
    x = other.points[0][0]
    assert x < 0 and (28 * x + 7).sqr().contains(609)


# -- entropy ---------------------------------------------------------------------------------------


# Parallelograms c + A q on the attractor: c, the unstable and the stable column of A.
SETS = [
    (("0.2223", "0.2266"), ("0.141", "-0.0325"), ("0.0652", "0.0758")),
    (("0.5497", "0.1511"), ("0.103", "-0.0238"), ("0.0652", "0.0758")),
    (("-0.7563", "0.3251"), ("-0.1268", "0.0142"), ("0.0284", "-0.0528")),
    (("-0.4129", "0.3112"), ("0.0829", "-0.0078"), ("-0.0069", "0.0073")),
]
ARROWS = {0: (2, 3), 1: (0, 1), 2: (0, 1), 3: (2,)}


@cache
def horseshoe():
    """The covering relations of F^2 among these, and the entropy of their graph."""
    file = SymbolicLemmas({"F": HENON})
    sets = [file.h_set(centre, list(zip(*columns, strict=True))) for centre, *columns in SETS]
    covers = [file.covers("F", 2, sets[i], sets[j]) for i in ARROWS for j in ARROWS[i]]
    file.entropy(file.graph(covers), 24)
    return render(file.document())


def entropy(text):
    (sentence,) = [claim for claim in check(text).sentences if "entropy" in claim]
    ends = sentence.rpartition("[")[2].rstrip("].").split(", ")
    return sentence, *map(Fraction, ends)


def test_a_graph_of_four_sets():
    """The numbers of paths grow by 1.8392867552..., the root of t^3 = t^2 + t + 1, in two steps."""
    _, low, high = entropy(horseshoe())
    assert Fraction("0.30468893") < low < high < Fraction("0.304688931718004")


def by_cycles(longest, **choice):
    """The covering relations of F among the sets around the cycles, and their entropy."""
    orbits = [o for n in range(1, longest + 1) for o in cycles(n) if o.period == n]
    file = SymbolicLemmas({"F": HENON})
    step = lemma(file, "F", rectangles(cover().f, orbits, **choice))
    return render(file.document(step))


@pytest.mark.long
def test_sets_around_cycles():
    """Above 0.4320 (Day, Frongillo and Trevino 2008); 0.46469 is Newhouse's and others' (2008)."""
    _, low, high = entropy(by_cycles(18, angle=0.3, past=3, future=7))
    assert Fraction("0.4359") < low < high < Fraction("0.46469")


@pytest.mark.long
def test_more_sets_around_cycles():
    _, low, high = entropy(by_cycles(23, angle=0.15, past=4, future=10, spare=0.01))
    assert Fraction("0.4562") < low < high < Fraction("0.46469")
