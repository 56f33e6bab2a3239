"""What is sent out and comes back, merged cells; the atlases that were made once."""

import json
import math
import random
from fractions import Fraction
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from intervals import Undecided
from proofs.check import check_file
from proofs.motion.many import next_impacts
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.plane import settling
from proofs.plane.cells import decide
from proofs.plane.head import Here, executor
from proofs.trusted.atlas import Region, check_atlas
from proofs.trusted.kernel.loops import StableOrbit
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.paper.beyond.attractors import AtRest
from proofs.trusted.paper.beyond.returning import ReturningMotion, StickingMotion
from proofs.trusted.parameters import Place
from proofs.trusted.verify import Rejected, check
from tests.once import committed
from tests.oracles.judge import oracle

F = Fraction
REGION = Region((F("0.2115"), F("0.2127")), (F("-0.201"), F("-0.199")), "horseshoe")


def box(eta, nu, width="0.0002"):
    return Place((F(eta), F(eta) + F(width)), (F(nu), F(nu) + F(width)))


def timeless(row):
    """A row without what depends on what was done before: values that are kept cost nothing."""
    return row._replace(seconds=0, work=0)


def test_next_impacts_of_many_are_those_of_one():
    phases = np.linspace(0.05, 6.2, 60)
    for eta, nu in (("0.2121", "-0.2"), ("0.3", "0.5"), ("1.7", "0.9")):
        system = System(F(eta), F(nu))
        found = next_impacts(system.side, float(eta), float(nu), phases, 60.0)
        for phase, time, image, slope, _ in zip(phases, *found, strict=True):
            alone = next_impact(system, float(phase), 60.0)
            if alone is None:
                assert math.isnan(time) and math.isnan(image) and math.isnan(slope)
            else:
                assert time == pytest.approx(alone.time, abs=1e-9)
                assert image % math.tau == pytest.approx(alone.phase, abs=1e-9)
                assert slope == pytest.approx(alone.slope, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    ("place", "kind", "impacts"),
    [
        (box("0.212", "-0.2"), StickingMotion, 0),
        (box("0.5", "0.2"), AtRest, 0),
        (box("0.237", "0.3"), StableOrbit, 1),
        (box("0.2213", "-0.1843"), StickingMotion, 0),  # one impact before the arc
        (box("0.2674", "-0.2168", "0.001"), ReturningMotion, 0),  # on the arc or just after it
        (box("0.2378", "-0.2059", "0.0004"), ReturningMotion, 1),
    ],
)
def test_attractors(place, kind, impacts):
    (found,) = check(next(settling.propose(place)).certificate()).conclusions
    assert isinstance(found, kind) and found.at == place
    assert len(getattr(found, "cells", ())) == impacts


@pytest.mark.slow
def test_what_is_rehearsed_is_what_is_proved():
    """At boxes over the region: a proof of `sticks` where the rehearsal ends well, none else."""
    told = set()
    for eta, nu in product(("0.1641", "0.2121", "0.3113"), ("-0.3", "-0.2", "-0.13")):
        place = box(eta, nu, "0.0008")
        try:
            settling._rehearse(place)
        except Undecided:
            with pytest.raises((Undecided, Rejected)):
                check(settling.sticks(place).certificate())
            told.add(False)
        else:
            check(settling.sticks(place).certificate())
            told.add(True)
    assert told == {False, True}


def test_a_cell_without_a_proof_is_split_and_undecided_at_the_last_depth():
    nowhere = Region((F("0.2522"), F("0.2526")), (F("-0.1151"), F("-0.1147")), "horseshoe")
    (row,) = decide(nowhere, 1, [("0/", "")])
    assert (row.verdict, row.conclusion, row.certificate) == ("SPLIT", "", None)
    (row,) = decide(nowhere, 0, [("0/", "")])
    assert (row.verdict, row.kind) == ("UNDECIDED", "") and "sets" in row.conclusion


@pytest.mark.parametrize("kind", ["here", pytest.param("dask:", marks=pytest.mark.slow)])
def test_every_executor_gives_the_same_rows(kind):
    if kind == "dask:":
        pytest.importorskip("distributed")
    todo = [("0/00", ""), ("0/31", "")]
    here = decide(REGION, 2, todo)
    with executor(2, kind) as (pool, count):
        there = pool.submit(decide, REGION, 2, todo).result()
    assert count == 2 and isinstance(here[0].certificate, bytes)
    assert [*map(timeless, there)] == [*map(timeless, here)]
    assert Here().submit(math.sqrt, 4).result() == 2


# -- the atlases that were made once ---------------------------------------------------------------


FOLDER = Path(__file__).parents[3] / "reports" / "atlas"
NAMES = ["attractor", "entropy-3", "horseshoe", "orbits", "orbits-0.3"]


@pytest.mark.parametrize("name", NAMES)
def test_ten_cells_are_proved_where_they_are_said_to_be(name, capsys):
    """And simulation agrees, at an oscillator of each."""
    folder = FOLDER / name
    made = json.loads((folder / "atlas.json").read_text())
    assert check_file(folder / "sample.jsonl", DEFAULT) == 1  # the rest is not looked at
    assert "not looked at" in capsys.readouterr().out
    head, *lines = map(json.loads, (folder / "sample.jsonl").read_text().splitlines())
    assert head.items() <= made.items()
    cells = [line for line in lines if line["certificate"]]
    assert len(cells) == 10 and {line["kind"] for line in cells} <= made["kinds"].keys()
    page = (folder / "atlas.html").read_text()
    assert made["digest"] in page and 'href="sample.jsonl"' in page and len(page) < 3_000_000
    if name != "attractor":  # enclosures of arcs over a box are not one arc's
        for file, text in committed().items():
            if file.startswith(f"atlas/{name}/"):
                assert oracle(check(text).conclusions[0], random.Random(file)) == []


def test_all_questions_were_asked():
    assert sorted(path.parent.name for path in FOLDER.glob("*/atlas.json")) == NAMES


@pytest.mark.slow
def test_a_small_one_is_there_as_a_whole():
    """On both sides of resonance and of the table at rest: every verdict, and the strip."""
    path = FOLDER / "across-resonance.jsonl"
    assert path.stat().st_size < 1_000_000
    with path.open() as file:
        found = check_atlas(file)
    assert {*found.cells} == {"VERIFIED", "REFUTED", "UNDECIDED", "left out"}
    assert sum(found.shares.values()) == 1 and found.shares["left out"] < 1e-6
    assert found.shares["REFUTED"] + found.shares["VERIFIED"] > 0.9
