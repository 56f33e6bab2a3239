"""Rule: words of rectangles that no orbit follows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise, product

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, given
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import image_of
from proofs.trusted.kernel.enclose import Box, integer
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.rectangles import read_rectangles
from proofs.trusted.numbers import floor_text, show_range, within

_LONGEST = 10  # symbols of a barred word


@dataclass(frozen=True)
class BarredWord(Conclusion):
    """No orbit x_0, ..., x_n of a map has x_k in the rectangle of number word[k] for all k.

    short: by how much the n-th image at least falls short of the last rectangle.
    """

    function: Map
    boxes: tuple[Box, ...]
    word: tuple[int, ...]
    short: Fraction

    def __post_init__(self) -> None:
        if self.short <= 0:
            raise Unproved("an orbit along the word is not excluded")

    @property
    def brief(self) -> str:
        names = [f"V{symbol + 1}" for symbol in self.word]
        return (
            f"no orbit of {self.function.name} follows {' '.join(names)}: the last image misses "
            f"{names[-1]} by at least {floor_text(self.short)}"
        )

    @property
    def sentence(self) -> str:
        sets = (f"V{i} = {' x '.join(map(show_range, box))}" for i, box in enumerate(self.boxes, 1))
        return f"{given(self.function)}{self.brief}; {', '.join(sets)}."


def barred_word(context: Context, reader: Reader) -> BarredWord:
    """Rule `barred-word`: {rectangles: names, word: a number for each symbol, from}.

    from: "above" or "below". Hypotheses: 1 of `horseshoe`, all with the same side in y, images
    increasing. From above let b_0 be the right end of word[0], G_0 its side in y; the image of the
    line {b_k} x G_k, of which b_k is in word[k], has x up to e_(k+1); G_(k+1) is the image's y of
    the rectangle word[k], a part of that side; b_(k+1) is the lesser one of e_(k+1) and the right
    end of word[k+1]. The last e_n is left of word[n]. From below: with left for right.
    Conclusion: no orbit x_0, ..., x_n has x_k in the rectangle word[k] for all k.
    Proof. The image's x increases with x. So if x_k is up to b_k and y_k in G_k, then x_(k+1) is up
    to e_(k+1), and up to b_(k+1) if it is in the rectangle; and y_(k+1) is in G_(k+1).
    """
    names, word_of, side_of = reader.fields("rectangles", "word", "from")
    maps, side = read_rectangles(context, names), side_of.string()
    if side not in ("above", "below"):
        raise side_of.fail("above or below")
    word = tuple(integer(each, 1, len(maps)) - 1 for each in word_of.items(2, _LONGEST))
    if len({each.box[1] for each in maps}) > 1 or min(each.sign for each in maps) < 0:
        raise Unproved("the rectangles differ in height, or images are not proved to increase")
    end, sign = (1, 1) if side == "above" else (0, -1)  # all is mirrored from below
    path = [maps[symbol] for symbol in word]
    bound, heights = path[0].box[0][end], path[0].box[1]
    for here, following in pairwise(path):
        if not here.box[0][0] <= bound <= here.box[0][1]:
            raise Unproved("a shorter word has no orbit")
        line = image_of(here.function, ((bound, bound), heights), here.turns)
        extreme, heights = line[0][end], here.image[1]
        if not within(heights, here.box[1]):
            raise Unproved("an image leaves the rectangles upwards or downwards")
        last = following.box[0]
        bound = sign * min(sign * extreme, sign * last[end])
        short = sign * (last[1 - end] - extreme)
    return BarredWord(maps[0].function, tuple(each.box for each in maps), word, short)


def never_ends(words: Sequence[Sequence[int]], pair: tuple[int, int], count: int) -> bool:
    """Whether every word of some length in so many symbols that ends in a pair contains a word."""
    longest = max(map(len, words), default=0)
    METER.get().spend(len(words) * count**longest)
    return longest > 1 and all(
        any(
            (*start, *pair)[k : k + len(word)] == tuple(word)
            for word in words
            for k in range(longest)
        )
        for start in product(range(count), repeat=longest - 2)
    )
