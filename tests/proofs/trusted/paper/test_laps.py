"""The entropy from both sides: against words counted by brute force, and witnesses with lies.

At eta = 0.21, nu = -0.2 the circle has ten pieces; there all is proved and derived in two seconds.
"""

import copy
import math
import random
from dataclasses import replace
from fractions import Fraction as F
from functools import cache
from itertools import product

import pytest

from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.coverings import EntropyBound, Weighted
from proofs.trusted.numbers import Phases, show_range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.s34_circle.cycles import Coding, Cycles, Outer
from proofs.trusted.paper.s34_circle.expansion import (
    beside,
    expansion,
    part,
)
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.paper.s34_circle.laps import EntropyRange, entropy_range
from proofs.trusted.paper.s34_circle.pieces import Pieces
from proofs.trusted.paper.s34_circle.roots import Between
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.oracles.judge import oracle
from tests.oracles.motion import TURN, Impact, next_impact
from tests.oracles.sources import committed
from tests.proofs.trusted.paper.steps import add, apply, derive, edited, moved_to, proved_by
from tests.proofs.trusted.paper.test_edits import TEN_PIECES as OF
from tests.proofs.trusted.paper.test_edits import derived, few_pieces


@pytest.fixture(scope="module")
def steps():
    return few_pieces()


@pytest.fixture(scope="module")
def known():
    return derived(OF, few_pieces).known


def only(kind, known):
    return [x for x in known.values() if isinstance(x, kind)]


# -- against brute force ---------------------------------------------------------------------------


@pytest.mark.slow
def test_what_is_derived_is_what_the_oracles_see(known):
    """Grazes, square roots, pieces, how lengths grow, periodic orbits."""
    between = Between(*firsts(only(Pieces, known)[0]))
    assert between.full == 2 and "each infinite sequence of them" in between.sentence
    assert all(show_range(graze.phases) in between.sentence for graze in between.grazes)
    judged = (Grazing, EntropyBound, EntropyRange, Cycles)
    for found in (x for kind in judged for x in only(kind, known)):
        assert oracle(found, random.Random(1), OF) == []


@cache
def image(phase):
    """f by brute force, on the line around pi/2."""
    found = next_impact(OF.eta, OF.nu, F(phase), 7000.0)
    assert isinstance(found, Impact)
    return (float(found.lifted) + math.pi / 2) % TURN - math.pi / 2


# -- narrow grazes ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def roots():
    """The grazes at the paper's numbers."""
    names = [x for x in committed("entropy")["proofs"]["H18"] if x.startswith("grazing")]
    return proved_by("entropy", *names)


def test_the_square_roots_at_the_ends_of_the_first_branches(roots):
    own = roots
    for one, near in zip(own, ("1.2", "1.36", "1.5", "1.57"), strict=True):
        assert abs(one.phases[0] - F(near)) < F(1, 200) and one.below
    decision = find("H18").decide(PAPER, own)
    assert decision.verdict is Verdict.VERIFIED
    assert all(x[1] - x[0] < F(1, 10**9) for x in decision.quantities.values())
    assert decision.quantities["root_1"] == own[0].root
    assert 1.1218 < decision.quantities["jump_1"][0] < 1.1219  # 1.941607 - 0.819754


def test_h18_needs_each_of_its_grazes_narrowly(roots):
    own = roots
    for i, one in enumerate(own):
        wide = replace(one, root=(one.root[0], one.root[1] + F(1, 10**8)))
        flat = replace(one, landing=one.time, beyond=one.turn)  # no jump
        assert (
            find("H18").decide(PAPER, [*own[:i], flat, *own[i + 1 :]]).verdict.value == "UNDECIDED"
        )
        none = replace(one, landing=None)
        for few in (
            own[:i] + own[i + 1 :],
            [*own[:i], wide, *own[i + 1 :]],
            [*own[:i], none, *own[i + 1 :]],
            [*own[:i], flat, *own[i + 1 :]],
        ):
            assert find("H18").decide(PAPER, few).verdict is Verdict.UNDECIDED
    assert find("H18").decide(OF, own).verdict is Verdict.UNDECIDED


def firsts(pieces):
    """The pieces of the circle, and the grazes at the ends of the first ones, where f increases."""
    return pieces, tuple(x for x in pieces.arcs if isinstance(x, Grazing) and x.below)


@pytest.mark.parametrize(("width", "power"), [("1/1000", 2), ("1/1001", 3), ("999/1000000", 3)])
def test_a_graze_s_interval_is_narrower_than_the_power_of_ten(width, power):
    phases, time = Phases(F(1), 1 + F(width)), (F(1), F(2))
    graze = Grazing(PAPER.place, phases, 1, F(1), time, True, 2, None, time)
    assert f"which is less than 10^(-{power}) wide" in graze.sentence


def test_pieces_between_other_grazes_are_not_told_of(known, roots):
    pieces, grazes = firsts(only(Pieces, known)[0])
    for wrong in (grazes[:1], grazes[::-1], grazes[::2]):
        with pytest.raises(Unproved):
            Between(pieces, wrong)
    with pytest.raises(Unproved, match="one oscillator"):
        Between(pieces, tuple(roots))
    last = [x for x in pieces.arcs if isinstance(x, Grazing) and not x.below]
    with pytest.raises(Unproved, match="no piece"):
        Between(pieces, tuple(last))
    with pytest.raises(Unproved, match="the same turns"):
        Between(pieces, (grazes[0], replace(grazes[1], turn=grazes[1].turn + 1)))
    with pytest.raises(Unproved, match="the same turns"):
        Between(pieces, (replace(grazes[0], landing=None), grazes[1]))
    assert Between(pieces, grazes[2:]).full < 2
    assert "sequence" not in Between(pieces, grazes[2:]).sentence


# -- lies ------------------------------------------------------------------------------------------

LIES = [  # that edits of all fields do not tell, in test_edits
    ("grazing", lambda w: w.update(landing=None), "within q turns"),
    (
        "grazing",
        lambda w: w["times"].__setitem__(0, add(F(-1, 10**9))(w["times"][1])),
        "to the gra",
    ),
    ("grazing", lambda w: w["times"].__setitem__(2, add(F(1, 10**9))(w["times"][1])), "to rise"),
    ("grazing", lambda w: w["times"].__setitem__(3, add(8)(w["times"][3])), "to rise"),
    ("grazing", lambda w: w.update(beyond=w["turn"]), "not in order"),
    ("expansion", lambda w: w["scales"].__setitem__(0, "0"), "scale > 0"),
    ("expansion", lambda w: w.update(radius="0"), "no radius"),
    ("itinerary-graph", lambda w: w.update(growth="1/2"), "growth >= 1"),
    ("itinerary-graph", lambda w: w["weights"].__setitem__(0, "0"), "weights > 0"),
    (
        "itinerary-graph",
        lambda w: w.update(states=[[low, str(min(F(high), F(2)))] for low, high in w["states"]]),
        "no state contains",
    ),
]


@pytest.mark.every
@pytest.mark.parametrize(("rule", "change", "reason"), LIES, ids=[x[2] for x in LIES])
def test_a_forged_step_is_refused(steps, known, rule, change, reason):
    forged = copy.deepcopy(steps)
    change(next(x for x in forged.values() if x["rule"] == rule)["witness"])
    with pytest.raises((Unproved, Malformed), match=reason):
        derive(forged, OF, known, steps)


def test_pieces_have_one_part_that_never_impacts(known):
    (pieces,) = only(Pieces, known)
    never = next(x for x in pieces.arcs if isinstance(x, NeverImpacts))
    twice = [replace(never, phases=x.phases) if x is pieces.arcs[0] else x for x in pieces.arcs]
    with pytest.raises(Unproved, match="one part without impacts"):
        replace(pieces, arcs=tuple(twice))


def test_what_is_beside_grazes_counts(known):
    """f expands on all cells, but nothing is said of the phases next to a graze."""
    found = only(Cycles, known)[0].expansion
    count = len(found.scales)
    fine = [[(F(1, 1000), (F(0), F(3)))]] * count
    assert expansion(found.pieces, fine, found.scales, found.rate) == found
    steep = [*fine[:-1], [*fine[-1], (F(9), (F(1), F(1)))]]
    with pytest.raises(Unproved, match="to expand"):
        expansion(found.pieces, steep, found.scales, found.rate)
    piece = next(x for x in found.pieces.monotone if x.left and x.right)
    parts = list(beside(piece))
    assert len(parts) == 2
    for (bound, image), phase in zip(parts, piece.branch.phases, strict=True):
        seen = next_impact(OF.eta, OF.nu, phase, 7000.0)
        assert bound >= 1 / abs(float(seen.slope)) - 1e-9
        assert image[0] <= F(float(seen.lifted) - TURN * piece.branch.turn) + F(1, 10**9)


def test_the_rule_looks_beside_grazes(steps, known):
    """With a landing that is known badly, f' may be anything on the far side of a graze."""
    (pieces,) = only(Pieces, known)
    low, high = pieces.arcs[1].landing
    vague = replace(pieces.arcs[1], landing=(low - 1, high + 1))
    other = replace(pieces, arcs=(pieces.arcs[0], vague, *pieces.arcs[2:]))
    with pytest.raises(Unproved, match="to expand"):
        apply("expansion", steps["expansion-1"]["witness"], {**known, "pieces-1": other}, OF)


def test_a_part_holds_every_slope(known):
    (pieces,) = only(Pieces, known)
    for piece in pieces.monotone:
        ends = piece.branch.phases
        ends = ends[0], ends[0] + (ends[1] - ends[0]) / 8
        seen = [next_impact(OF.eta, OF.nu, phase, 7000.0) for phase in ends]
        arrivals = sorted(F(float(each.lifted)) for each in seen)
        bound, image = part(piece.branch, ends, (arrivals[0], arrivals[1]))
        assert all(bound > 0.999 / abs(float(each.slope)) for each in seen)
        assert abs(float(image[0] - arrivals[0]) + TURN * piece.branch.turn) < 1e-9


# -- periodic orbits -------------------------------------------------------------------------------


def closed_words(pieces, length):
    """The words that lead back to where they started, f being the brute-force one: closed paths.

    A word counts if after three rounds the images of its first piece are not empty.
    """
    ends = [tuple(map(float, piece.branch.phases)) for piece in pieces.monotone]

    def follow(state, i, j):
        after = sorted(image(x) for x in state)
        low, high = max(after[0], ends[j][0]), min(after[1], ends[j][1])
        return (low, high) if low < high else None

    found = []
    for word in product(range(len(ends)), repeat=length):
        state = ends[word[0]]
        for k in range(3 * length):
            state = state and follow(state, word[k % length], word[(k + 1) % length])
        if state:
            found.append(word)
    return found


def test_periodic_orbits_counted_by_brute_force(known):
    (found,) = only(Cycles, known)
    for n in (1, 2, 3):
        count = len(closed_words(found.expansion.pieces, n))
        low, high = (
            sum(d * found.counts[d - 1][side] for d in range(1, n + 1) if n % d == 0)
            for side in (0, 1)
        )
        assert low <= count <= high
    assert found.counts[0] == (4, 4)
    assert sum(high - low for low, high in found.counts) == len(found.left) <= 3
    count = len(found.expansion.pieces.monotone)
    assert f"of its own of {count} intervals on which f is C^1 and monotone" in found.sentence


def test_the_images_of_states_are_rounded_outward(known):
    (found,) = only(Cycles, known)
    for piece_number, piece in enumerate(found.expansion.pieces.monotone):
        low, high = (F(image(float(x))) for x in piece.branch.phases)
        outer = Outer(
            found.expansion, {x: (F(image(float(x))),) * 2 for x in piece.branch.phases}.get
        )
        exact = min(low, high), max(low, high)
        for after, other in enumerate(found.expansion.pieces.monotone):
            state = outer.step(piece.branch.phases, piece_number, after)
            common = max(exact[0], other.phases[0]), min(exact[1], other.phases[1])
            if common[0] <= common[1]:
                assert state[0] <= common[0] <= common[1] <= state[1]
                assert state[0] > common[0] - F(1, 10**7)


def test_g18_needs_both_bounds_of_the_words(known):
    (found,), (bounds,) = only(Cycles, known), only(EntropyRange, known)
    told = find("G18").decide(OF, [bounds, found])
    assert told.verdict is Verdict.VERIFIED and "periodic orbits of least period" in told.theorem
    for few in ([bounds], [found]):
        assert find("G18").decide(OF, few).verdict is Verdict.UNDECIDED


def test_an_orbit_twice_is_no_two(steps, known):
    forged = edited(steps, ("expansion-1", "witness", "orbits"), lambda old: [*old, old[0]])
    with pytest.raises(Unproved, match="not proved different"):
        derive(forged, OF, known, steps)


def test_an_orbit_that_is_not_given_is_left_open(steps, known):
    (found,) = only(Cycles, known)
    forged = edited(steps, ("expansion-1", "witness", "orbits"), lambda old: old[1:])
    less = derive(forged, OF, known, steps)["expansion-1"]
    assert (less.words, len(less.left)) == (found.words[1:], len(found.left) + 1)
    assert less.counts[0] == (3, 4)


# -- what an expansion needs -----------------------------------------------------------------------


def test_an_expansion_and_a_range_of_other_pieces_are_no_coding(known):
    found, (bounds,) = only(Cycles, known)[0].expansion, only(EntropyRange, known)
    cuts, end = found.pieces.arcs[2].cuts, found.pieces.arcs[2].times[1]
    arcs = (
        *found.pieces.arcs[:2],
        replace(found.pieces.arcs[2], windows=((F(1), end),) * (len(cuts) - 1)),
        *found.pieces.arcs[3:],
    )
    other = replace(found, pieces=replace(found.pieces, arcs=arcs))
    with pytest.raises(Unproved, match="different pieces"):
        Coding(other, bounds)


def test_a_graze_that_only_one_half_has_is_none(known):
    """Parts that take turns: a branch where a graze should be, and the other way round."""
    (pieces,) = only(Pieces, known)
    low, high, *rest = pieces.arcs
    first = replace(low, cuts=(low.cuts[0], F(1)), windows=low.windows[:1])
    last = replace(low, cuts=(F(1), low.cuts[-1]), windows=low.windows[:1])
    with pytest.raises(Unproved, match="take turns"):
        replace(pieces, arcs=(first, last, high, *rest))
    with pytest.raises(Unproved, match="adjoin it"):
        replace(pieces, lands=pieces.lands[:1] * 2)


def test_images_lie_between_those_of_the_ends_whatever_the_enclosures(known):
    (pieces,) = only(Pieces, known)
    piece = next(x for x in pieces.monotone if x.left and x.right)
    low, high = piece.branch.phases
    middle, wide = (low + high) / 2, (F(1), F(2))
    assert piece.image((low, middle), lambda phase: wide if phase == low else (F(3), F(4))) == (
        1,
        4,
    )
    assert piece.image((F(0), F(1, 2)), lambda phase: wide) is None
    limit = piece.right.graze if piece.right.below else piece.right.other
    assert piece.image((middle, F(3)), lambda phase: wide) == (min(1, limit[0]), max(2, limit[1]))
    with pytest.raises(Unproved, match="no known image"):
        piece.image((low, middle), {}.get)


def test_images_longer_than_the_circle_are_refused(known):
    (pieces,), (found,) = only(Pieces, known), only(EntropyRange, known)
    whole = Weighted([pieces.region], [F(1)], F(100))
    assert entropy_range(pieces, found.lower, lambda _: (F(1), F(2)), whole).growth == 100
    for image in ((F(-5), F(1)), (F(1), F(7))):
        with pytest.raises(Unproved, match="longer than the circle"):
            entropy_range(pieces, found.lower, lambda _, image=image: image, whole)


# -- what conclusions refuse -----------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    ("place", "field"), [(1, "turn"), (1, "beyond"), (9, "turn"), (11, "turn")]
)
def test_a_piece_and_its_grazes_count_images_from_the_same_turn(known, place, field):
    (pieces,) = only(Pieces, known)
    arcs = list(pieces.arcs)
    arcs[place] = replace(arcs[place], **{field: getattr(arcs[place], field) + 1})
    with pytest.raises(Unproved, match="different turns"):
        replace(pieces, arcs=tuple(arcs))


def test_a_flight_from_the_arc_that_does_not_return_is_no_end(known):
    (pieces,) = only(Pieces, known)
    away = replace(pieces.arc, arrival=(F(1), F(1)))
    with pytest.raises(Unproved, match="does not return"):
        replace(pieces, arc=away)


def test_bounds_of_two_oscillators_are_no_range(known):
    (found,) = only(EntropyRange, known)
    with pytest.raises(Unproved, match="two bounds"):
        replace(found, lower=moved_to(found.lower, PAPER.place))
    with pytest.raises(Unproved, match="two bounds"):
        replace(found, growth=found.lower.growth - 1)
    with pytest.raises(Unproved, match="other branches"):
        replace(
            found,
            lower=EntropyBound(
                PlasticMap(found.at), (replace(found.lower.branches[0], turn=7),), 1, F(2)
            ),
        )


def test_wide_ranges_decide_nothing(known):
    (found,) = only(EntropyRange, known)
    wide = replace(found, growth=found.growth + 1)
    assert find("G17").decide(OF, [wide]).verdict is Verdict.UNDECIDED
    assert find("G17").decide(OF, []).verdict is Verdict.UNDECIDED
    assert find("G17").decide(OF, [wide, found]).verdict is Verdict.VERIFIED
