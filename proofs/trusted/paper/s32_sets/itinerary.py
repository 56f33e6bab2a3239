"""The invariant set of the plastic map as a set of itineraries. Trusted, shared.

Let sets I0, I1 within I = [A, B] be a proved horseshoe (H1 to H6 hold there), so that itineraries
conjugate f on its invariant set L to the full shift. Another interval J within I, such as the
printed one, has the invariant set L_J = {phi : f^n(phi) in J for n >= 0}, a subset of L. f
increases on I0 and on I1, I0 lies before I1, so the order of phases is the lexicographic order of
itineraries: let phi follow the word w = w_0 ... w_(k-1) in I0 and I1, and f^k(phi) lie in
neither. A point x of L with the itinerary u is below phi exactly if u_0 ... u_k comes before
w_0 ... w_(k-1) c, where c = 0, 1 or 2 as f^k(phi) is below I0, between I0 and I1, or above I1.

Proof. If u_j is the first letter that differs from w_j, j < k, then f^j(x), f^j(phi) are in
different sets, in that order, and j times the inverse of an increasing branch keeps it. If none
differs, f^k(x) is in the set of u_k, and f^k(phi) is beside it, in the order of u_k and c.

So with phi = the lower and the upper end of J, L_J = {x in L : no iterate is below one or above
the other} is given by finitely many forbidden words: a subshift of finite type.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range, show
from proofs.trusted.paper.s31_horseshoe import Horseshoe
from proofs.trusted.paper.s32_sets.subshift import Subshift, words
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import SlopeRange

_LONGEST = 10


@dataclass(frozen=True)
class Itinerary(Conclusion):
    """A phase follows a word in I0 and I1 of a horseshoe and then leaves both.

    orbit: enclosures of the phase and its images, the one that left included; leaves: 0, 1 or 2
    where that is below I0, between I0 and I1, or above I1.
    """

    sets: Horseshoe
    phase: Fraction
    word: str
    leaves: int
    orbit: tuple[Range, ...]


def follow(sets: Horseshoe, slopes: Sequence[SlopeRange], phase: Fraction) -> Itinerary | None:
    """Follow a phase through a proved horseshoe, f being known at points; None if undecided.

    f increases on I0 and I1, and f(I0), f(I1) do not pass phase 0 (H5). So where p <= x <= q are
    points of one set, f(p) <= f(x) <= f(q).
    """
    x, word, orbit = (phase, phase), "", [(phase, phase)]
    while len(word) < _LONGEST:
        for letter, domain in zip("01", (sets.left, sets.right), strict=True):
            if domain[0] <= x[0] and x[1] <= domain[1]:
                image = _image(slopes, domain, x)
                if image is None:
                    return None
                x, word = image, word + letter
                orbit.append(image)
                break
        else:
            beside = (x[1] < sets.left[0], _within(x, sets.gap), x[0] > sets.right[1])
            if not any(beside):
                return None
            return Itinerary(sets, phase, word, beside.index(True), tuple(orbit))
    return None


def _within(x: Range, gap: Range) -> bool:
    return gap[0] < x[0] and x[1] < gap[1]


def _image(slopes: Sequence[SlopeRange], domain: Range, x: Range) -> Range | None:
    """Enclose f(x) by f at the nearest known points of the domain."""
    known = [
        (point, image)
        for step in slopes
        for point, image in zip(step.points, step.images, strict=True)
        if domain[0] <= point <= domain[1] and image[1] <= TURN
    ]
    below = [image[0] for point, image in known if point <= x[0]]
    above = [image[1] for point, image in known if point >= x[1]]
    return (max(below), min(above)) if below and above else None


def surrounding(of: Parameters, found: Sequence[object]) -> Horseshoe | None:
    """Return the sets of a horseshoe among the conclusions whose interval contains I."""
    low, high = of.interval
    for step in found:
        if isinstance(step, Horseshoe):
            begin, end = step.interval
            if begin <= low and high <= end:
                return step
    return None


NO_HORSESHOE = "no horseshoe is proved on sets around the given interval I"


def invariant_set(of: Parameters, found: Sequence[object]) -> tuple[Horseshoe, Subshift] | str:
    """Return the horseshoe around I and the subshift of the points whose orbits stay in I.

    What is missing, if it is not proved.
    """
    sets, (low, high) = surrounding(of, found), of.interval
    if sets is None:
        return NO_HORSESHOE
    factors: set[str] = set()
    for end, outer, is_low in ((low, sets.interval[0], True), (high, sets.interval[1], False)):
        if end == outer:
            continue
        orbit = next(
            (x for x in found if isinstance(x, Itinerary) and (x.sets, x.phase) == (sets, end)),
            None,
        )
        if orbit is None:
            return f"the orbit of {show(end)} is not followed until it leaves I0 and I1"
        place = [*map(int, orbit.word), orbit.leaves]
        cut = {word for word in words(len(place)) if (list(map(int, word)) < place) is is_low}
        factors |= cut
    return sets, Subshift.without(factors)
