"""What is sent out and comes back: proposals, hints, executors, merged cells."""

import math
from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from intervals import Undecided
from proofs.motion.candidate import next_impact
from proofs.motion.many import next_impacts
from proofs.motion.system import System
from proofs.motion.witness import FlightBox
from proofs.plane import settling
from proofs.plane.cells import decide
from proofs.plane.head import Here, executor
from proofs.plane.horseshoe import Sets, _pieces, propose
from proofs.plane.steps import bracket, times_for
from proofs.plane.summary import joined, merged
from proofs.search.shifts import pieces
from proofs.trusted.atlas import Region
from proofs.trusted.kernel.loops import StableOrbit
from proofs.trusted.paper.beyond.attractors import AtRest
from proofs.trusted.paper.beyond.returning import ReturningMotion, StickingMotion
from proofs.trusted.parameters import Place
from proofs.trusted.verify import Rejected, check

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
        for phase, time, image, slope in zip(phases, *found, strict=True):
            one = next_impact(system, float(phase), 60.0)
            if one is None:
                assert math.isnan(time) and math.isnan(image) and math.isnan(slope)
            else:
                assert time == pytest.approx(one[0], abs=1e-6)
                assert image % math.tau == pytest.approx(one[1], abs=1e-6)
                assert slope == pytest.approx(one[2], rel=1e-4, abs=1e-4)


def test_times_are_those_of_the_rule_and_none_where_flights_differ():
    here, phases = box("0.212", "-0.2"), (F("1.1"), F("1.12"))
    times = times_for(FlightBox.plastic(here, phases), 25.5)
    assert times == sorted(times) and 23 < times[-2] < times[-1] < 26
    early, late = bracket(here, phases, times)
    assert times[-2] <= early < late <= times[-1] and late - early < times[-1] - times[-2]
    for wrong in ((F("1.1"), F("1.3")), (F("3.2"), F("3.6"))):  # some graze and fly on; some stick
        with pytest.raises(Undecided):
            times_for(FlightBox.plastic(here, wrong), 60.0)


def test_sets_of_a_neighbour_are_tried_first():
    made, sets = next(propose(box("0.212", "-0.2"), []))
    hint = Sets.of(sets.text)
    assert hint.phases == sets.phases and hint.turns == sets.turns
    again, same = next(propose(box("0.2121", "-0.2"), [hint]))
    assert same.phases == sets.phases and again.certificate() != made.certificate()
    far = hint._replace(phases=tuple((low - 1, high - 1) for low, high in hint.phases))
    _, other = next(propose(box("0.212", "-0.2"), [far]))
    assert other.phases == sets.phases


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


def test_pieces_of_branches_that_are_seen_at_once():
    """Each is part of one that is seen phase by phase, with the same images."""
    slowly = pieces(System(F("0.212"), F("-0.2")), 800)
    found = _pieces(-1, 0.212, -0.2)
    assert len(found) > 5
    for piece in found:
        (other,) = [x for x in slowly if x.phases[0] <= piece.phases[0] <= x.phases[-1]]
        assert set(piece.phases) <= set(other.phases)
        images = dict(zip(other.phases, other.images, strict=True))
        for phase, image in zip(piece.phases, piece.images, strict=True):
            assert image == pytest.approx(images[phase], abs=1e-6)


def test_phases_are_brought_next_to_others():
    moved = settling._next_to(np.array([0.1, 6.2, 3.0]), np.array([6.2, 0.1 + 3 * math.tau, -3.2]))
    assert moved == pytest.approx([6.2 - math.tau, 0.1 + math.tau, math.tau - 3.2])


def test_a_cell_without_a_proof_is_split_and_undecided_at_the_last_depth():
    nowhere = Region((F("0.2522"), F("0.2526")), (F("-0.1151"), F("-0.1147")), "horseshoe")
    (row,) = decide(nowhere, 1, [("0/", "")])
    assert (row.verdict, row.conclusion, row.certificate) == ("SPLIT", "", None)
    (row,) = decide(nowhere, 0, [("0/", "")])
    assert (row.verdict, row.kind) == ("UNDECIDED", "") and "sets" in row.conclusion


def test_no_horseshoe_where_all_comes_to_rest():
    rest = Region((F("0.5"), F("0.6")), (F("0.1"), F("0.2")), "horseshoe")
    (row,) = decide(rest, 0, [("0/", "")])
    assert (row.verdict, row.kind) == ("REFUTED", "AtRest")


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


def test_four_quarters_are_one_part_of_the_picture():
    keys = ["0/00", "0/01", "0/02", "0/03", "0/1", "0/2", "0/3", "1/0"]
    assert merged(keys) == ["0/", "1/0"]
    assert merged(keys[1:]) == sorted(keys[1:])
    assert merged([]) == []


def test_boxes_side_by_side_are_joined_and_no_others():
    whole = {(x, y) for x in range(8) for y in range(8)} - {(3, 3), (3, 4), (7, 0)}
    found = joined(((F(x), F(x + 1)), (F(y), F(y + 1))) for x, y in sorted(whole, key=hash))
    covered = [
        (x, y)
        for (a, b), (c, d) in found
        for x in range(int(a), int(b))
        for y in range(int(c), int(d))
    ]
    assert sorted(covered) == sorted(whole) and len(found) < 9
