"""Section 3.3: words that no orbit of F follows, and the golden mean shift that is left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import floor_text, within
from proofs.trusted.paper.s33_restitution.cones import Rates, rates
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap
from proofs.trusted.paper.s33_restitution.rectangles import (
    Strips,
    crossing,
    read_maps,
    require_rising,
    strips,
)
from proofs.trusted.parameters import Place

_LONGEST = 10  # symbols of a barred word


@dataclass(frozen=True)
class BarredWord(Conclusion):
    """There is no orbit x_0, ..., x_n of F with x_k in V1 where word[k] = 0, in V2 where it is 1.

    short: by how much the n-th image at least falls short of the last rectangle.
    """

    at: Place
    strips: Strips
    word: tuple[int, ...]
    short: Fraction

    def __post_init__(self) -> None:
        if self.short <= 0:
            raise Unproved("an orbit along the word is not excluded")

    @property
    def brief(self) -> str:
        names = [f"V{symbol + 1}" for symbol in self.word]
        return (
            f"no orbit of F follows {' '.join(names)}: the last impact misses {names[-1]} by at "
            f"least {floor_text(self.short)}"
        )

    @property
    def sentence(self) -> str:
        return f"{self.brief}; {self.strips}."


def barred_word(context: Context, reader: Reader) -> BarredWord:
    """Rule `barred-word`: {rectangles: two names, word of 0 and 1, images: rebound steps, from}.

    from: "above" or "below". Hypotheses: 1 of `rectangle-horseshoe`, the next phase increasing;
    from above, image k is about the states {b_k} x G_k at least, b_k a phase of the rectangle
    word[k], G_0 its velocities, G_(k+1) the image velocities of the rectangle word[k]; with e_0 the
    right end of word[0] and e_(k+1) the greatest phase of image k, min(e_k, right end of word[k])
    <= b_k; the last e_n is left of word[n]. From below: with left for right and <= for >=.
    Conclusion: no orbit x_0, ..., x_n has x_k in the rectangle word[k] for all k.
    Proof. The next phase increases with phi. So if phi_k <= b_k and gamma_k is in G_k,
    then phi_(k+1) <= e_(k+1), and phi_(k+1) <= b_(k+1) if it is in the rectangle.
    """
    maps_of, word_of, images_of, side_of = reader.fields("rectangles", "word", "images", "from")
    maps, word, side = read_maps(context, maps_of), word_of.string(), side_of.string()
    if side not in ("above", "below"):
        raise side_of.fail("above or below")
    if not set(word) <= {"0", "1"} or not 2 <= len(word) <= _LONGEST:
        raise word_of.fail(f"a word is 2 to {_LONGEST} symbols 0 and 1")
    *path, last = [maps[int(symbol)] for symbol in word]
    end, sign = (1, 1) if side == "above" else (0, -1)  # all is mirrored from below
    gammas, extreme = maps[0].velocities, maps[int(word[0])].phases[end]
    for here, name in zip(path, images_of.items(len(path), len(path)), strict=True):
        image = context.step(name, Rebound)
        bound = image.phases[0]
        if bound != image.phases[1] or not within(image.phases, here.phases):
            raise Unproved("a bound is not a phase of the rectangle")
        if sign * bound < min(sign * extreme, sign * here.phases[end]):
            raise Unproved("a phase beyond the bound is not excluded")
        if (image.at, image.turns) != (here.at, here.turns):
            raise Unproved("an image is about another oscillator, or whole turns apart")
        if not within(gammas, image.velocities):
            raise Unproved("an image is not about all velocities")
        extreme, gammas = image.phase[end], here.velocity
        if not within(gammas, here.velocities):
            raise Unproved("an image velocity leaves the rectangles")
    require_rising(maps)
    short = sign * (last.phases[1 - end] - extreme)
    return BarredWord(maps[0].at, strips(maps), tuple(map(int, word)), short)


@dataclass(frozen=True)
class GoldenMean(Conclusion):
    """Full orbits in V1 and V2 are those that never repeat V2: the golden mean shift."""

    at: Place
    strips: Strips
    rates: Rates

    @property
    def sentence(self) -> str:
        return (
            f"{self.strips.smooth}, and one-to-one. Let Lambda_2 be the set of all states whose "
            "full orbits stay in the union of V1 and V2. F on Lambda_2 is conjugate, by the "
            "itinerary, to the shift on all two-sided sequences of 1 and 2 without 22 (golden mean "
            f"shift), and is {self.rates}. Lambda_2 lies in the open rectangles, so that it is "
            "theirs too. It has topological entropy log((1 + sqrt 5)/2), periodic orbits of every "
            "period, uncountably many nonperiodic orbits and a dense orbit."
        )

    @property
    def brief(self) -> str:
        return "F on Lambda_2 is conjugate to the two-sided shift on sequences without 22"


def golden_mean(context: Context, reader: Reader) -> GoldenMean:
    """Rule `golden-mean`: {rectangles: two names, part: a rectangle, words: barred-word steps}.

    Hypotheses: epsilon > 0; every word of some length that ends in 11 (V2 twice) contains a barred
    word; the next phase increases; V1 and N = `part`, a part of V2 with the same left edge, obey
    the hypotheses of `rectangle-horseshoe` with the arrows V1 -> V1, V1 -> N, N -> V1. Conclusion:
    F on the states whose full orbits stay in V1 and V2 is conjugate to the two-sided shift on
    sequences without 22.
    Proof. 1. V2 is never followed by V2 in a full orbit, thus by V1. 2. The right edge of N goes to
    the right of V1 and the next phase increases on V2, so a state of V2 outside N does not go to
    V1. So full orbits in V1 and V2 follow the arrows, and `rectangle-horseshoe` describes those.
    """
    names, part_of, words_of = reader.fields("rectangles", "part", "words")
    maps, part = read_maps(context, names), context.step(part_of, RectangleMap)
    words = [context.step(name, BarredWord) for name in words_of.items(most=64)]
    (first, second), found = maps, strips(maps)
    if first.at.sides[2][0] <= 0:
        raise Unproved("without restitution F is not one-to-one")
    if any((word.at, word.strips) != (first.at, found) for word in words):
        raise Unproved("words are about other rectangles or oscillators")
    if not never_twice([word.word for word in words]):
        raise Unproved("V2 is not proved never to be repeated")
    same = part.turns == second.turns and part.phases[0] == second.phases[0]
    if not same or part.phases[1] > second.phases[1]:
        raise Unproved("N is no part of V2 with the same left edge")
    strips((first, part))
    require_rising((first, second, part))
    crossing((first, part), ((0, 1), (0,)))
    return GoldenMean(first.at, found, rates((*first.parts, *part.parts)))


def never_twice(words: Sequence[tuple[int, ...]]) -> bool:
    """Whether every word of some length that ends in 11 contains one of these."""
    longest = max(map(len, words), default=0)
    METER.get().spend(len(words) << longest)
    return longest > 0 and all(
        any((*start, 1, 1)[k : k + len(word)] == word for word in words for k in range(longest))
        for start in product((0, 1), repeat=longest - 2)
    )
