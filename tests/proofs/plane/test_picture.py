"""Curves over an atlas: where theory says, inside of the region, and grazing only if proved."""

import math
from fractions import Fraction

import numpy as np
import pytest

from intervals import Undecided
from proofs.plane.picture import GRAZING, overlay
from proofs.search.curves import Curves
from proofs.trusted.atlas import Region
from tests.oracles.curves import distance

F = Fraction
REGION = Region((F("0.15"), F("0.35")), (F("-0.4"), F("-0.1")), "attractor")
MEETS = Region((F("1.42"), F("1.43")), (F("-0.6"), F("-0.58")), "attractor")


@pytest.mark.slow
def test_folds_flips_and_sticking_are_where_row_c1_says_typed_here_again():
    found = overlay(REGION)
    assert {line.name for line in found.lines} == {"folds", "flips", "where it begins to stick"}
    assert {line.n for line in found.lines} == {3, 4, 5} and found.meetings == []
    for line in found.lines:
        for eta, nu in line.points[1:-1:40]:
            assert 0.15 <= eta <= 0.35 and -0.4 <= nu <= -0.1
            e = (eta * math.tan(math.pi * line.n * eta)) ** 2
            square = {
                "folds": e / (1 + e),
                "where it begins to stick": (eta**4 + e) / (1 - eta**2) ** 2,
                "flips": (eta**2 * (1 + 1 / math.cos(math.pi * line.n * eta) ** 2), e),
            }[line.name]
            if line.name == "flips":
                square = (square[0] ** 2 + e) / (1 - square[0]) ** 2
            assert nu**2 == pytest.approx(square, rel=1e-9)


@pytest.mark.slow
def test_what_is_not_proved_is_not_drawn(monkeypatch):
    def fails(self, n, run):
        raise Undecided("no proof")

    asked = []
    monkeypatch.setattr(
        Curves, "grazing", lambda self, n, run: asked.append(n) or fails(self, n, run)
    )
    found = overlay(MEETS)
    assert asked == [2] and found.meetings == []
    assert GRAZING not in {line.name for line in found.lines}


@pytest.mark.slow
def test_orbits_touch_the_table_on_curves_of_grazing():
    """By the gap, typed again from (14), at either orbit of these eta and nu."""
    found = overlay(MEETS)
    (line,) = (line for line in found.lines if line.name == GRAZING)
    assert line.n == 2 and len(line.points) > 3
    times = np.linspace(0.3, 4 * math.pi - 0.3, 200_001)
    for eta, nu in line.points:
        e = (eta * math.tan(2 * math.pi * eta)) ** 2
        orbits = [p.real for p in np.roots([1 - nu**2, 2 * nu**2, e - nu**2])]
        least = [(-distance(2, 0, eta, p, times)).min() for p in orbits]
        assert min(map(abs, least)) < 2e-4  # boxes are some 1e-5 wide
    ((eta, nu),) = found.meetings
    places, heights = np.array(sorted(line.points)).T
    assert np.interp(eta, places, heights) == pytest.approx(nu, abs=1e-5)
    e = (eta * math.tan(2 * math.pi * eta)) ** 2
    assert nu**2 == pytest.approx(e / (1 + e), rel=1e-9)  # it is on the folds
