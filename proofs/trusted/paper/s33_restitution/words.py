"""Section 3.3: the golden mean shift that is left where V2 is never repeated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.horseshoe import read_rectangles
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.rates import Rates, rates
from proofs.trusted.kernel.rectangles import Rectangle, crossing, require_together
from proofs.trusted.kernel.words import BarredWord
from proofs.trusted.paper.s33_restitution.horseshoes import NAMES, strips_of
from proofs.trusted.paper.s33_restitution.rectangles import Strips
from proofs.trusted.parameters import Place


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
            f"shift), and is {self.rates.said(*NAMES)}. Lambda_2 lies in the open rectangles, so "
            "that it is theirs too. It has topological entropy log((1 + sqrt 5)/2), periodic "
            "orbits of every period, uncountably many nonperiodic orbits and a dense orbit."
        )

    @property
    def brief(self) -> str:
        return "F on Lambda_2 is conjugate to the two-sided shift on sequences without 22"


def golden_mean(context: Context, reader: Reader) -> GoldenMean:
    """Rule `golden-mean`: {rectangles: two names, part: a rectangle, words: barred-word steps}.

    Hypotheses: epsilon > 0; every word of some length that ends in 11 (V2 twice) contains a barred
    word; the next phase increases; V1 and N = `part`, a part of V2 with the same left edge, obey
    the hypotheses of `horseshoe` with the arrows V1 -> V1, V1 -> N, N -> V1. Conclusion:
    F on the states whose full orbits stay in V1 and V2 is conjugate to the two-sided shift on
    sequences without 22.
    Proof. 1. V2 is never followed by V2 in a full orbit, thus by V1. 2. The right edge of N goes to
    the right of V1 and the next phase increases on V2, so a state of V2 outside N does not go to
    V1. So full orbits in V1 and V2 follow the arrows, and `horseshoe` describes those.
    """
    names, part_of, words_of = reader.fields("rectangles", "part", "words")
    first, second = read_rectangles(context, names, 2, 2)
    part = context.step(part_of, Rectangle)
    words = [context.step(name, BarredWord) for name in words_of.items(most=64)]
    at, found = place_of(first), strips_of((first, second))
    if at.sides[2][0] <= 0:
        raise Unproved("without restitution F is not one-to-one")
    if any((word.place, word.boxes) != (at, (first.box, second.box)) for word in words):
        raise Unproved("words are about other rectangles or oscillators")
    if not never_twice([word.word for word in words]):
        raise Unproved("V2 is not proved never to be repeated")
    (left, right), heights = part.box
    low, high = found.right
    if (part.turns, left, heights) != (second.turns, low, found.velocities) or right > high:
        raise Unproved("N is no part of V2 with the same left edge")
    require_together((first, part))
    if min(each.sign for each in (first, second, part)) < 0:
        raise Unproved("the next phase is not proved to increase with the phase")
    crossing((first, part), ((0, 1), (0,)))
    return GoldenMean(at, found, rates((*first.parts, *part.parts)))


def never_twice(words: Sequence[tuple[int, ...]]) -> bool:
    """Whether every word of some length that ends in 11 contains one of these."""
    longest = max(map(len, words), default=0)
    METER.get().spend(len(words) << longest)
    return longest > 0 and all(
        any((*start, 1, 1)[k : k + len(word)] == word for word in words for k in range(longest))
        for start in product((0, 1), repeat=longest - 2)
    )
