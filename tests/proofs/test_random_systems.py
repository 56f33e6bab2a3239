"""Maps and systems at random: the command has an answer, and simulation contradicts none of it."""

import pytest

from tests.oracles.random_systems import answers, case, falsehoods

KINDS, SEEDS = 6, 200  # the kinds take turns


def judged(seed, folder):
    made = case(seed)
    claims = answers(made, folder)
    assert [claim["id"] for claim in claims] == ["orbits:1", "orbits:2", "stable", "horseshoe"]
    assert all(claim["why"].strip() for claim in claims if claim["verdict"] == "UNDECIDED")
    assert falsehoods(made, claims) == []
    return claims


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(KINDS))
def test_no_theorem_is_false(seed, tmp_path):
    judged(seed, tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(KINDS, SEEDS))
def test_no_theorem_about_many_is_false(seed, tmp_path):
    judged(seed, tmp_path)


def test_simulation_contradicts_what_is_false(tmp_path):
    """Theorems about one map are false of another: the oracle says so."""
    one, other = case(0), case(6)
    claims = answers(one, tmp_path)
    assert any(claim["theorems"] for claim in claims)
    assert falsehoods(other, claims)
