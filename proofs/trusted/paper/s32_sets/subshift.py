"""Sequences over 0 and 1 without certain words: subshifts of finite type. Trusted, and shared."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product

from proofs.trusted.numbers import Range

_PLACES = 10**30
_ROUNDS = 200


def words(length: int) -> list[str]:
    """Return all words of a length over 0 and 1, in lexicographic order."""
    return ["".join(letters) for letters in product("01", repeat=length)]


@dataclass(frozen=True)
class Subshift:
    """The sequences x_0 x_1 ... over 0, 1 that have no factor among `forbidden`.

    `forbidden` are words of one length n >= 2. The sequences are the infinite paths in the graph
    whose states are words of length n - 1, with an arrow from u to v for each word u_1 ... u_(n-1)
    v_(n-1) that is not forbidden, v being its last n - 1 letters.
    """

    length: int
    forbidden: frozenset[str]

    @classmethod
    def without(cls, factors: Iterable[str]) -> Subshift:
        """Return the subshift without these factors, which are written at one length.

        In an infinite sequence a word stands exactly if one of its extensions does.
        """
        given = set(factors)
        length = max((2, *map(len, given)))
        return cls(length, frozenset(w for w in words(length) if any(map(w.startswith, given))))

    @cached_property
    def arrows(self) -> dict[str, list[str]]:
        """The graph, without the states from which no infinite path starts."""
        graph = {
            state: [(state + x)[1:] for x in "01" if state + x not in self.forbidden]
            for state in words(self.length - 1)
        }
        while dead := {state for state, after in graph.items() if not after}:
            graph = {
                state: [then for then in after if then not in dead]
                for state, after in graph.items()
                if state not in dead
            }
        return graph

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
    def missing(self) -> str | None:
        """The first of the shortest words that begin no sequence; None if there is no such word."""
        for length in range(1, self.length + 1):
            for word in words(length):
                if not self.begins(word):
                    return word
        return None

    def begins(self, word: str) -> bool:
        """Whether some sequence begins with a word."""
        head, rest = word[: self.length - 1], word[self.length - 1 :]
        states = [state for state in self.arrows if state.startswith(head)]
        for letter in rest:
            states = [then for one in states for then in self.arrows[one] if then[-1] == letter]
        return bool(states)

    @cached_property
    def irreducible(self) -> bool:
        """Whether there is a path from every state to every state, and at least one state.

        It is enough that one state is reached from all states and reaches all.
        """
        return bool(self.arrows) and all(
            _reached(graph) == set(graph) for graph in (self.arrows, _reversed(self.arrows))
        )

    @property
    def chaotic(self) -> bool:
        """Whether the graph is irreducible and some state has two successors.

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
        return self.irreducible and any(len(after) == 2 for after in self.arrows.values())

    def fixed_points(self, period: int) -> int:
        """Return how many sequences the shift's iterate fixes: the closed paths of this length."""
        total = 0
        for start in self.arrows:
            paths = {start: 1}
            for _ in range(period):
                following: dict[str, int] = {}
                for state, count in paths.items():
                    for then in self.arrows[state]:
                        following[then] = following.get(then, 0) + count
                paths = following
            total += paths.get(start, 0)
        return total

    @cached_property
    def growth(self) -> Range:
        """Bounds on the spectral radius of an irreducible graph; its log is the entropy.

        min (A v)_i / v_i <= radius <= max (A v)_i / v_i for any positive vector v (Collatz and
        Wielandt); v is iterated under 1 + A, in integers that stay positive.
        """
        if not self.irreducible:
            raise ValueError("the graph is not irreducible")
        vector = dict.fromkeys(self.arrows, 1 << 200)
        for _ in range(_ROUNDS):
            image = self._image(vector)
            vector = {state: 1 + (vector[state] + image[state]) // 2 for state in vector}
        image = self._image(vector)
        quotients = [Fraction(image[state], vector[state]) for state in vector]
        low, high = min(quotients), max(quotients)
        return Fraction(low * _PLACES // 1, _PLACES), -Fraction(-high * _PLACES // 1, _PLACES)

    def _image(self, vector: dict[str, int]) -> dict[str, int]:
        return {state: sum(map(vector.__getitem__, after)) for state, after in self.arrows.items()}


def _reached(graph: dict[str, list[str]]) -> set[str]:
    """Return what is reached from the first state."""
    first = next(iter(graph))
    reached, waiting = {first}, [first]
    while waiting:
        new = set(graph[waiting.pop()]) - reached
        reached |= new
        waiting += new
    return reached


def _reversed(graph: dict[str, list[str]]) -> dict[str, list[str]]:
    """Return the graph with its arrows turned round."""
    turned: dict[str, list[str]] = {state: [] for state in graph}
    for state, after in graph.items():
        for then in after:
            turned[then].append(state)
    return turned
