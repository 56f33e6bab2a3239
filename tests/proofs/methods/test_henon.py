"""The Henon map at a = 1.4, b = 0.3 against what is published.

Its trapping region is Henon's quadrilateral (Commun. Math. Phys. 50, 1976); the numbers of cycles
in it are those of Galias, Interval methods for rigorous investigations of periodic orbits,
Int. J. Bifurcation Chaos 11 (2001).
"""

from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
import sympy

from intervals import Undecided
from proofs.methods.lemmas import Lemmas
from proofs.methods.newton import cycles, seeds
from proofs.methods.rectangles import lemma, rectangles
from proofs.methods.sampling import Sampled
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.files import render
from proofs.trusted.kernel import trees
from proofs.trusted.verify import check
from tests.proofs.trusted.kernel.lemma_examples import henon

HENON = henon("7/5", "3/10")
CORNERS = [("-1.33", "0.42"), ("-1.06", "-0.5"), ("1.245", "-0.14"), ("1.32", "0.133")]
TABLE = """
1 1 0 1 0 2 4 7 6 10 14 19 32 44 72 102 166 233 364 535 834 1225 1930 2902 4498 6806 10518 16031
24740 37936
"""
CYCLES = dict(enumerate(map(int, TABLE.split()), 1))  # by their least periods
STARTS = 500  # of Newton's method, times the period


# -- the trapping region ---------------------------------------------------------------------------


def trapped(corners):
    """The functions (b - a) x (F(P(s, t)) - a), P from [0, 1]^2 onto the quadrilateral."""
    s, t = sympy.symbols("s t")
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
    return [str(value) for value in values]


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
    file = SymbolicLemmas({"F": HENON})
    sampled = Sampled(file.map("F"))
    box = [(Fraction("-1.33"), Fraction("1.32")), (Fraction("-0.5"), Fraction("0.42"))]
    orbits = [
        cycle
        for period in range(1, longest + 1)
        for cycle in cycles(sampled, period, seeds(sampled, box, STARTS * period))
    ]
    step = lemma(file, "F", rectangles(sampled, orbits, **choice))
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
