"""Subshifts of finite type: the infinite paths of a graph."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from fractions import Fraction
from typing import TypeVar

from proofs.trusted.numbers import Range, between, show

S = TypeVar("S", bound=Hashable)
_ROUNDS = 200


def irreducible(arrows: Mapping[S, Sequence[S]]) -> bool:
    """Whether a path of one step or more leads from every state of a graph to every one.

    It is enough that one state reaches all states and is reached from all.
    """
    ahead = set(list(arrows)[:1])
    behind = set(ahead)
    while new := {then for state in ahead for then in arrows[state]} - ahead:
        ahead |= new
    while new := {x for x, after in arrows.items() if behind.intersection(after)} - behind:
        behind |= new
    return all(arrows.values()) and ahead == behind == set(arrows)


def spectral_radius(arrows: Mapping[S, Sequence[S]]) -> Range:
    """Enclose the spectral radius of a graph.

    min (A v)_i / v_i <= radius <= max (A v)_i / v_i for any positive vector v (Collatz and
    Wielandt); v is iterated under 1 + A, in integers that stay positive.
    """
    vector = image = dict.fromkeys(arrows, 1 << 200)
    for _ in range(_ROUNDS):
        vector = {x: 1 + (vector[x] + image[x]) // 2 for x in vector}
        image = {x: sum(vector[then] for then in after) for x, after in arrows.items()}
    quotients = [Fraction(image[x], vector[x]) for x in vector]
    return min(quotients), max(quotients)


def log_of(growth: Range) -> str:
    """Write the entropy of a graph, by bounds on its spectral radius."""
    low, high = growth
    return f"log {show(low)}" if low == high else f"the log of a number in {between(growth, 12)}"


def closed_paths(arrows: Mapping[S, Sequence[S]], most: int = 8) -> list[int]:
    """Return how many closed paths of 1, 2, ..., so many steps there are in a graph."""
    counts = [0] * most
    for start in arrows:
        reached = {start: 1}
        for n in range(most):
            after: dict[S, int] = {}
            for state, ways in reached.items():
                for then in arrows[state]:
                    after[then] = after.get(then, 0) + ways
            reached = after
            counts[n] += reached.get(start, 0)
    return counts


def is_chaotic(arrows: Mapping[S, Sequence[S]]) -> bool:
    """Whether a path leads from every state to every one, and some state has two successors.

    Then, for the shift on the set X of sequences:

    1. X is a Cantor set. It is compact, and any two points differ in a letter, which splits X
       into two open sets; no point is isolated, since from every state a path leads to the
       state with two successors.
    2. There are countably many periodic points, of least periods beyond every bound: two
       closed paths a, b through that state that differ in their first step give sequences
       a^n b a^n b ..., different for different n; only finitely many have a given period.
    3. Uncountably many points are neither periodic nor eventually periodic: those are
       countably many, X is not countable.
    4. Some orbit is dense: that of a path that follows all finite paths one after another.
    """
    return irreducible(arrows) and any(len(after) > 1 for after in arrows.values())
