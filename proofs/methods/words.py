"""Words over a few symbols, and how they turn into each other by rotation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

Symbols = NDArray[np.intp]


@dataclass(frozen=True)
class Words:
    """Different words of one length over the digits, closed under rotation."""

    texts: tuple[str, ...]

    @classmethod
    def of_length(cls, length: int, alphabet: str = "01") -> Words:
        """Return all words of a length over the digits of an alphabet, in lexicographic order."""
        return cls(tuple("".join(letters) for letters in product(sorted(alphabet), repeat=length)))

    @classmethod
    def rotations(cls, word: str) -> Words:
        """Return a word and its rotations, w, s w, ..., in the order of the orbit."""
        return cls(tuple(dict.fromkeys(word[i:] + word[:i] for i in range(len(word)))))

    @cached_property
    def symbols(self) -> Symbols:
        """The first symbol of each word."""
        return np.array([int(text[0]) for text in self.texts], dtype=np.intp)

    @cached_property
    def following(self) -> Symbols:
        """For each word w the index of s w, w rotated by one."""
        index = {text: i for i, text in enumerate(self.texts)}
        return np.array([index[text[1:] + text[0]] for text in self.texts], dtype=np.intp)

    @cached_property
    def cycles(self) -> list[list[int]]:
        """The indices of w, s w, ... for each orbit: as many as its minimal period."""
        following, cyclic, seen = self.following.tolist(), [], set[int]()
        for first in range(len(following)):
            if first not in seen:
                cycle = [first]
                while (index := following[cycle[-1]]) != first:
                    cycle.append(index)
                cyclic.append(cycle)
                seen.update(cycle)
        return cyclic
