"""The solver on systems that others publish: no zero is missed, none is made up."""

from fractions import Fraction

import pytest

from intervals import Interval
from tests.intervals.zero_systems import page, solved, systems

SYSTEMS = systems()
QUICK = [
    "Broyden tridiagonal 8",
    "Broyden banded 6",
    "Bratu 5",
    "discrete boundary value 12",
    "discrete integral 4",
    "trigexp 5",
    "Henon's cycles 11",
    "Troesch 8",
    "Freudenstein 4",
    "Yamamura 8",
    "Wright 5",
    "chebyquad 3",
    "Powell badly scaled",
    "Himmelblau's extrema",
    "six-hump camel",
    "Boggs",
    "I1",
]


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_systems_that_are_decided(name):
    row = solved(SYSTEMS[name])
    assert not row.left and row.proved == row.system.known


@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_no_known_count_is_contradicted(name):
    assert not solved(SYSTEMS[name], 4000).contradicts


PI = Interval.pi(precision=100).mid
POINTS = {  # zeros that are published, exactly, or rounded to the places that are given
    "Himmelblau": ((3, 2), 0),
    "Himmelblau's extrema": ((3, 2), 0),
    "Virasoro": ((Fraction(1, 8), 0, 0, 0, 0, 0, 0, 0), 0),
    "Katsura 4": ((Fraction(1, 3), 0, 0, Fraction(1, 3)), 1e-12),
    "Smiley, Chun 2.2": ((2, 0), 0),
    "Smiley, Chun 5.2": ((Fraction(-4, 5), 0, Fraction(3, 5)), 1e-12),
    "Smiley, Chun 5.4": ((Fraction("1.34030"), Fraction("0.99866")), 5),
    "Smiley, Chun 5.5": ((Fraction("0.33419") * PI, 0, Fraction("0.48025") * PI, 0), 1e-4),
    "Boggs": ((-1, 2), 1e-12),
    "I1": (
        tuple(
            Fraction(x, 10**4) for x in (2578, 3811, 2787, 2007, 4453, 1492, 4320, 734, 3460, 4273)
        ),
        1e-3,
    ),
    "transistor": (tuple(map(Fraction, ("0.9", "0.45", "1", "2", "8", "8", "5", "1", "2"))), 0.1),
}


@pytest.mark.parametrize("name", POINTS)
def test_transcriptions_have_published_zeros(name):
    point, size = POINTS[name]
    values = SYSTEMS[name].f(*(Interval(x, precision=80) for x in point))
    assert len(values) == len(point) == len(SYSTEMS[name].box)
    assert max(float(y.mag) for y in values) <= size


def test_a_wrong_count_is_noticed():
    """A known number that is one off contradicts; a double zero is not decided."""
    assert len(SYSTEMS) == 160
    row = solved(SYSTEMS["Boggs"])
    assert (row.proved, row.left) == (3, 0)
    for known, wrong in ((3, False), (2, True), (4, True), (None, False)):
        told = row._replace(system=row.system._replace(known=known))
        assert told.contradicts == wrong == ("CONTRADICTION" in page([told]))
    double = SYSTEMS["Boggs"]._replace(
        f=lambda x: (2 * x**2 - 1) ** 2, box=[Interval(0, 1)], known=1
    )
    assert "1 not decided" in page([solved(double)])
