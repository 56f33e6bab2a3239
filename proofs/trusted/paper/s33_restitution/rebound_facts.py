"""What conclusions about rectangles say together, for the statement's V1 and V2."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import combinations, product

from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.rebounds import (
    BarredWord,
    Box,
    Horseshoe,
    Rebound,
    Rectangle,
    Unjoined,
    horseshoe,
)
from proofs.trusted.parameters import Parameters

FULL = ((0, 1), (0, 1))
NO_REPEATED_ONE = ((0, 1), (0,))  # as 11 is barred: the golden mean shift
Pair = tuple[Rectangle, Rectangle]
_LONGEST = 10  # symbols of a word that matters


def oscillator(of: Parameters) -> Box | None:
    """Return the exact parameters as a box; None without epsilon."""
    if of.epsilon is None:
        return None
    return (of.eta, of.eta), (of.nu, of.nu), (of.epsilon, of.epsilon)


def printed_pair(of: Parameters, found: Sequence[object]) -> Pair | None:
    """Return what is known about the rectangles V1 and V2 of the statement."""
    known = {
        one.phases: one
        for one in found
        if isinstance(one, Rectangle)
        and (one.box, one.velocities) == (oscillator(of), of.velocities)
    }
    if of.left not in known or of.right not in known:
        return None
    return known[of.left], known[of.right]


def horseshoes(
    of: Parameters, found: Sequence[object], arrows: tuple[tuple[int, ...], tuple[int, ...]]
) -> Iterator[Horseshoe]:
    """Yield what rectangles with the statement's velocities prove about these arrows."""
    known = [one for one in found if isinstance(one, Rectangle) and one.velocities == of.velocities]
    for pair in combinations(sorted(known, key=lambda one: one.phases), 2):
        try:
            yield horseshoe(pair, arrows)
        except Unjoined:
            continue


def barred_words(of: Parameters, found: Sequence[object]) -> dict[tuple[int, ...], BarredWord]:
    """Return the words that no orbit in V1 and V2 follows."""
    return {
        one.word: one
        for one in found
        if isinstance(one, BarredWord)
        and (one.box, one.sets, one.velocities)
        == (oscillator(of), (of.left, of.right), of.velocities)
    }


def restricted(of: Parameters, found: Sequence[object]) -> Horseshoe | None:
    """Return the horseshoe of the full orbits in V1 and V2, if these never repeat V2.

    Theorem. Let epsilon > 0, let every word of some length that ends in 11 (V2 twice) contain a
    barred word, and let V1 and N, a part of V2 with the same left edge, have the arrows 0 -> 0,
    0 -> 1, 1 -> 0. Then the full orbits in V1 and V2 are those that follow these arrows: V2 is
    never followed by V2, thus by V1; the right edge of N goes to the right of V1, the next phase
    increases on V2, so a state of V2 outside N does not go to V1.
    """
    pair, words = printed_pair(of, found), barred_words(of, found)
    if pair is None or not of.epsilon or not never_twice(words):
        return None
    for one in horseshoes(of, found, NO_REPEATED_ONE):
        left, right = one.rectangles
        same = left == pair[0] and right.box == pair[1].box
        if same and right.phases[0] == of.right[0] and right.phases[1] <= of.right[1]:
            return one
    return None


def never_twice(words: Collection[tuple[int, ...]]) -> bool:
    """Whether every word of some length that ends in 11 contains one of these."""
    longest = max(map(len, words), default=0)
    if not 2 <= longest <= _LONGEST:
        return False
    return all(
        any((*start, 1, 1)[k : k + len(word)] == word for word in words for k in range(longest))
        for start in product((0, 1), repeat=longest - 2)
    )


def is_state(one: Rebound) -> bool:
    """Whether it is about a single state."""
    return one.phases[0] == one.phases[1] and one.velocities[0] == one.velocities[1]


def corner_of(
    one: Rebound, sets: tuple[Range, Range], velocities: Range | None
) -> Iterator[tuple[int, str]]:
    """Yield the rectangle and the edge, if it is about a corner."""
    if velocities is not None and is_state(one) and one.velocities[0] in velocities:
        for number, ends in enumerate(sets):
            for end, side in zip(ends, ("left", "right"), strict=True):
                if end == one.phases[0]:
                    yield number, side
