"""The solver on systems that others publish: no zero is missed, none is made up."""

import json
from fractions import Fraction

import pytest

from intervals import Interval
from proofs.benchmark.zeros import __main__ as command
from proofs.benchmark.zeros.systems import System, systems

SYSTEMS = {system.name: system for system in systems()}
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


def test_there_are_a_hundred_of_different_names():
    assert len(SYSTEMS) == len(list(systems())) >= 100


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_systems_that_are_decided(name):
    row = command.solved(SYSTEMS[name])
    assert not row.left and row.proved == row.system.known


@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_no_known_count_is_contradicted(name):
    assert not command.solved(SYSTEMS[name], 4000).contradicts


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
    assert max(float(y.mag) for y in values) <= size


def test_a_wrong_count_is_noticed(monkeypatch, tmp_path, capsys):
    """A known number that is one off ends with status 3; an undecided double zero with 1."""
    boggs, double = (
        SYSTEMS["Boggs"],
        System("double", "", lambda x: (2 * x**2 - 1) ** 2, [Interval(0, 1)], 1),
    )
    for known, status in ((3, 0), (2, 3), (4, 3)):
        monkeypatch.setattr(command, "systems", lambda n=known: [boggs._replace(known=n)])
        assert command.main(["--out", str(tmp_path), "--quiet"]) == status
        (line,) = json.loads((tmp_path / "zeros.json").read_text())["systems"]
        assert (line["known"], line["proved"], line["left"]) == (known, 3, 0)
        assert ("CONTRADICTION" in (tmp_path / "zeros.md").read_text()) == (status == 3)
    monkeypatch.setattr(command, "systems", lambda: [double])
    assert command.main([]) == 1
    assert "1 not decided" in capsys.readouterr().out
