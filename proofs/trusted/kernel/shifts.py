"""Subshifts of finite type: sequences over 0 and 1 without certain words."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import TypeVar

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, between, show

S = TypeVar("S", bound=Hashable)
_ROUNDS = 200


def words(length: int) -> list[str]:
    """Return all words of a length over 0 and 1, in lexicographic order."""
    return ["".join(letters) for letters in product("01", repeat=length)]


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


@dataclass(frozen=True)
class Subshift:
    """The sequences x_0 x_1 ... over 0, 1 that have no factor among `forbidden`.

    `forbidden` are words of one length n >= 2. The sequences are the infinite paths in the graph
    whose states are the words of n - 1 letters, with an arrow for each word of n letters that is
    not forbidden, from its first n - 1 letters to its last.
    """

    length: int
    forbidden: frozenset[str]

    @classmethod
    def between(cls, low: str, high: str) -> Subshift:
        """Return the sequences of which no factor comes before `low` and all come before `high`.

        Factors as long as these are compared, in lexicographic order; "0" and "2" bound nothing.
        """
        length = max(2, len(low), len(high))
        cut = (w for w in words(length) if w[: len(low)] < low or w[: len(high)] >= high)
        return cls(length, frozenset(cut))

    @cached_property
    def arrows(self) -> dict[str, list[str]]:
        """The graph, without the states from which no infinite path starts."""
        graph = {
            state: [(state + x)[1:] for x in "01" if state + x not in self.forbidden]
            for state in words(self.length - 1)
        }
        while dead := {state for state, after in graph.items() if not after}:
            graph = {x: [y for y in after if y not in dead] for x, after in graph.items() if after}
        return graph

    @property
    def named(self) -> str:
        """What it is, in words."""
        kind = f"subshift of the sequences without the factor {self.factors}"
        return kind if self.forbidden else "full shift on 0 and 1"

    @property
    def factors(self) -> str:
        """Name the forbidden words, the shortest that say the same."""
        shortest: list[str] = []
        for size in range(1, self.length + 1):
            for word in words(size):
                longer = {word + end for end in words(self.length - size)}
                if longer <= self.forbidden and not any(known in word for known in shortest):
                    shortest.append(word)
        return " or ".join(shortest)

    @cached_property
    def chaotic(self) -> bool:
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
        return irreducible(self.arrows) and any(len(x) > 1 for x in self.arrows.values())

    @cached_property
    def growth(self) -> Range:
        """Bounds on the spectral radius of a chaotic graph; its log is the entropy."""
        if not self.chaotic:
            raise Unproved("the graph is not proved irreducible")
        return spectral_radius(self.arrows)
