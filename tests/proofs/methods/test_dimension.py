"""Dimensions of sets with known ones: linear Cantor sets, continued fractions with digits 1, 2."""

from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import findroot, mp, mpf

from intervals import Undecided
from proofs.methods.dimension import Formulas, dimension
from proofs.methods.eigenfunction import candidate
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.complexes import Ellipse
from proofs.trusted.kernel.transfer import growth

# Jenkinson, Pollicott, Rigorous effective bounds on the Hausdorff dimension of continued fraction
# Cantor sets: a hundred decimal digits for the dimension of E_2, Advances in Math. 325 (2018)
E2 = Fraction(
    "0.5312805062772051416244686473684717854930591090183"
    "987798883978039275295356438313459181095701811852398"
)
E2_HULL = (Fraction("0.36"), Fraction("0.74"))
UNIT = (Fraction(0), Fraction(1))
AROUND = (Fraction(-1, 10), Fraction(11, 10))  # mapped into its inside, where [0, 1] may not be


def e2(x):
    return [1 / (1 + x), 1 / (2 + x)]


def lines(*pairs):
    """The maps x -> r x + t."""
    return lambda x: [r * x + t for r, t in pairs]


def moran(ratios, digits=40):
    with mp.workdps(digits):
        root = findroot(
            lambda s: sum(mpf(r.numerator) ** s / mpf(r.denominator) ** s for r in ratios) - 1, 0.5
        )
        return Fraction(mp.nstr(root, digits))


@pytest.mark.parametrize("digits", [3, 20, pytest.param(99, marks=pytest.mark.slow)])
def test_continued_fractions(digits):
    found = dimension(e2, E2_HULL, digits)
    low, high = found.bounds
    # what is published is cut off, or rounded, after 100 places
    assert low - Fraction(1, 10**100) < E2 < high + Fraction(1, 10**100)
    assert high - low < Fraction(1, 10**digits)
    # |g'| is 1 / (1 + x)^2 and 1 / (2 + x)^2
    for (least, most), shift in zip(found.growth.rates, (1, 2), strict=True):
        assert least <= 1 / (E2_HULL[1] + shift) ** 2 < 1 / (E2_HULL[0] + shift) ** 2 <= most


@pytest.mark.long
def test_all_published_digits_of_continued_fractions():
    low, high = dimension(e2, E2_HULL, 110).bounds
    assert high - low < Fraction(1, 10**110)
    published = E2 * 10**100
    assert low * 10**100 - 1 < published < high * 10**100 + 1


@pytest.mark.parametrize(
    "maps",
    [
        [(Fraction(1, 3), 0), (Fraction(1, 3), Fraction(2, 3))],
        [(Fraction("0.1905"), 0), (Fraction("0.2381"), Fraction("0.7"))],
        [
            (Fraction(-1, 5), Fraction(1, 4)),
            (Fraction(1, 3), Fraction(1, 2)),
            (Fraction(1, 9), Fraction(8, 9)),
        ],
    ],
)
def test_linear_sets_by_moran(maps):
    low, high = dimension(lines(*maps), AROUND, 12).bounds
    assert low < moran([abs(r) for r, _ in maps]) < high


def of_e2(digits=8, s=None):
    """A candidate for the continued fractions, its branches, and how it is proved."""
    branches = Formulas(e2, Ellipse(E2_HULL, Fraction(6)))
    return branches, *candidate(branches, branches.ellipse, 128, digits, s)


def test_the_growth_of_lengths():
    """At s = 1 by Gauss's operator, in floating point: sum of h(1 / (k + x)) / (k + x)^2."""
    branches, trial, by = of_e2(s=Fraction(1))
    low, high = growth(branches, trial, by).bounds
    h, points, value = [1.0] * 400, [0.36 + 0.38 * (j + 0.5) / 400 for j in range(400)], 0.0
    for _ in range(60):
        images = [
            [
                (h[min(399, max(0, int((1 / (k + x) - 0.36) / 0.38 * 400)))]) / (k + x) ** 2
                for k in (1, 2)
            ]
            for x in points
        ]
        fresh = [sum(pair) for pair in images]
        value = max(fresh)
        h = [y / value for y in fresh]
    assert abs(value - low) < 1e-3 and high - low < Fraction(1, 10**8)
    assert trial.s == 1 and low < by.mean < high


@pytest.mark.slow
def test_a_wrong_exponent_is_seen():
    """L_s h / h moves by at least exp(-shift log|g'|) when s is shifted; the dimension stays in."""
    branches, trial, by = of_e2()
    right = growth(branches, trial, by)
    assert right.bounds[1] - right.bounds[0] < Fraction(1, 10**8)
    for shift in (Fraction(1, 10**4), Fraction(-1, 10**4)):
        wrong = growth(branches, replace(trial, s=trial.s + shift), by)
        assert max(abs(end - 1) for end in wrong.bounds) > abs(shift) / 2
        low, high = wrong.dimension(by.bits)
        assert low < E2 < high and high - low > abs(shift)


CHANGES = {
    "the remainder counts": ({}, {"nodes": 5}),
    "few bits": ({}, {"bits": 64}),
    "another function": ({"coefficients": (Fraction(1), Fraction(-1, 4))}, {}),
}


@pytest.mark.parametrize("name", CHANGES)
def test_what_makes_the_bound_wide(name):
    branches, trial, by = of_e2(16)
    of_trial, of_by = CHANGES[name]
    rough = growth(branches, replace(trial, **of_trial), replace(by, **of_by))
    low, high = rough.bounds
    assert low < 1 < high or name == "another function"
    assert high - low > Fraction(1, 10**16)


WRONG = {
    "an s above 1": ({"s": Fraction(3, 2)}, {}, "exponent"),
    "an s of 0": ({"s": Fraction(0)}, {}, "exponent"),
    "a function with a zero": ({"coefficients": (Fraction(0), Fraction(1))}, {}, "positive"),
    "a negative one": ({"coefficients": (Fraction(-1),)}, {}, "positive"),
    "zero between the nodes": (
        {"coefficients": (Fraction(1), *[Fraction(0)] * 9, Fraction(-1))},
        {"nodes": 10},
        "positive",
    ),
    "a wide ellipse": ({}, {"ellipse": Ellipse(E2_HULL, Fraction(12))}, None),
    "too few arcs": ({}, {"arcs": 4}, None),
    "another hull": (
        {},
        {"ellipse": Ellipse((Fraction("0.4"), Fraction("0.74")), Fraction(2))},
        None,
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_refused(name):
    branches, trial, by = of_e2()
    of_trial, of_by, reason = WRONG[name]
    with pytest.raises(Unproved, match=reason):
        branches = Formulas(e2, of_by.get("ellipse", by.ellipse))
        growth(branches, replace(trial, **of_trial), replace(by, **of_by))


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        (lambda x: [x / 3, x / 3 + Fraction(1, 4)], "disjoint"),
        (lambda x: [x / 3 - Fraction(1, 9), x / 3 + Fraction(2, 3)], "itself"),
        (lambda x: [x * x / 3, x / 3 + Fraction(2, 3)], None),  # g' = 0 at 0
    ],
)
def test_branches_that_do_not_fit(formula, reason):
    branches = Formulas(formula, Ellipse(UNIT, Fraction(2)))
    _, trial, by = of_e2()
    with pytest.raises(Unproved, match=reason):
        growth(branches, trial, replace(by, ellipse=branches.ellipse))


@pytest.mark.slow
def test_without_contraction_nothing_is_said():
    """On [0, 1] the derivative of 1 / (1 + x) is -1 at 0."""
    with pytest.raises(Undecided):
        dimension(e2, UNIT, 2)


@pytest.mark.slow
def test_a_pole_is_no_dimension():
    with pytest.raises(Undecided):
        dimension(lambda x: [1 / (2 * x - 1), 1 / (3 + x)], UNIT, 4)
