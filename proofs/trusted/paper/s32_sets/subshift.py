"""Subshifts of finite type: sequences over 0 and 1 without certain words."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.shifts import is_chaotic, spectral_radius
from proofs.trusted.numbers import Range


def words(length: int) -> list[str]:
    """Return all words of a length over 0 and 1, in lexicographic order."""
    return ["".join(letters) for letters in product("01", repeat=length)]


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
        """See `is_chaotic`."""
        return is_chaotic(self.arrows)

    @cached_property
    def growth(self) -> Range:
        """Bounds on the spectral radius of a chaotic graph; its log is the entropy."""
        if not self.chaotic:
            raise Unproved("the graph is not proved irreducible")
        return spectral_radius(self.arrows)
