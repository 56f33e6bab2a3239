"""The solver on systems that others publish: no zero is missed, none is made up."""

from collections import Counter

import pytest

from intervals.newton import Roots
from intervals.zeros import zeros
from tests.intervals.systems import systems

SYSTEMS = {system.name: system for system in systems()}
QUICK = [
    "Broyden tridiagonal 4",
    "Broyden banded 3",
    "Brown almost linear 5",
    "Bratu 4",
    "discrete boundary value 12",
    "discrete integral 3",
    "trigexp 4",
    "Henon 8",
    "Troesch 8",
    "extended Freudenstein 2",
    "I1 (Moore, Jones)",
    "Kin1",
]


def check(name, limit):
    """Decided, the number of zeros is the published one; undecided, it is not excluded."""
    system = SYSTEMS[name]
    outcomes = Counter(x.outcome for x in zeros(system.f, system.box, limit=limit))
    if system.count is not None:
        assert outcomes[Roots.UNIQUE] <= system.count
        if not outcomes.keys() - {Roots.UNIQUE}:
            assert outcomes[Roots.UNIQUE] == system.count
    return not outcomes.keys() - {Roots.UNIQUE}


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_systems_that_are_decided(name):
    assert check(name, 100_000)


@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_no_published_count_is_contradicted(name):
    check(name, 4000)
