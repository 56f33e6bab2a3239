"""Words over a few symbols, and how they turn into each other by rotation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, product

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
    def of_orbits(cls, length: int, most: int, alphabet: str = "01") -> Iterator[Words]:
        """Yield the words of least period `length`, orbit by orbit, so many orbits at a time.

        An orbit begins with the first of its words in lexicographic order.
        """
        orbits = lyndon(length, alphabet)
        while some := tuple(islice(orbits, most)):
            yield cls(tuple(word[i:] + word[:i] for word in some for i in range(length)))

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
        following, found, seen = self.following.tolist(), [], set[int]()
        for first in range(len(following)):
            if first not in seen:
                cycle = [first]
                while (index := following[cycle[-1]]) != first:
                    cycle.append(index)
                found.append(cycle)
                seen.update(cycle)
        return found


def lyndon(length: int, alphabet: str = "01") -> Iterator[str]:
    """Yield the words of a length that come before all their rotations, in lexicographic order.

    They are the words that are no power of a shorter one, one for each orbit of rotations. Source:
    Duval 1988: the next such word, of any length up to this one, is the last repeated up to the
    length, without its trailing last letters, and with the letter after its final one.
    """
    letters = sorted(alphabet)
    word = [-1]
    while word:
        word[-1] += 1
        if len(word) == length:
            yield "".join(letters[i] for i in word)
        word = [word[i % len(word)] for i in range(length)]
        while word and word[-1] == len(letters) - 1:
            word.pop()
