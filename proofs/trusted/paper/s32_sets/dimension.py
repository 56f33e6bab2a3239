"""Section 3.2, Claim 1 read for the map itself: the dimension of the set that stays in I. H13."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import (
    TURN,
    Phases,
    Range,
    ceil_text,
    floor_text,
    hull,
    show_range,
    within,
)
from proofs.trusted.paper.s31_horseshoe import escapes
from proofs.trusted.paper.s32_sets.moran import MoranRoot, NoGap
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.slopes import Avoids, Impact
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

FULL = ("0", "1")
WITHOUT_000 = ("1", "01", "001")


@dataclass(frozen=True)
class StayingDimension(Conclusion):
    """The phases whose orbits stay in I, the hull of a repeller, are its set K.

    Theorem. Let I0 and I1, the domains of the repeller, begin and end with I, and let f take no
    phase of the closed gap between them into I. Let the words be 0 and 1; or let them be 1, 01, 001
    and f(a) >= y, f(y) > c for the lower end a of I, the upper end c of I0 and a phase y of I0, and
    f(a) in I. Then Lambda(I), the set of the phases in I whose images all stay in I, is K.

    Proof. A point x of Lambda(I) lies in I0 or I1 with all its images. 1. Words 0, 1: x = g_j(f(x)),
    and so on, is in K. 2. Words 1, 01, 001: if x and f(x) are in I0, then f(x) >= f(a) >= y, so that
    f(f(x)) >= f(y) > c: no three images in a row are in I0. So x is in some g_w(Lambda(I)), and in
    K. For on I0 f, lifted as its inverse is, stays below a + 2 pi and above the upper end - 2 pi:
    a phase within I is the lifted value; one beyond c in [0, 2 pi) is that value, or is 2 pi above
    it, and then the value is below I, where f(y) >= f(a) is not. 3. Conversely f maps K to K, and
    g_w(K) with its images up to K is in I0 and I1.
    """

    repeller: Repeller
    escape: Avoids
    start: Impact | None
    then: Impact | None

    def __post_init__(self) -> None:
        """Raise Unproved unless the hypotheses are proved, of one oscillator."""
        (low, high), (left, right) = self.interval, self.repeller.domains
        parts = [x for x in (self.repeller, self.escape, self.start, self.then) if x is not None]
        if len({x.at for x in parts}) > 1:
            raise Unproved("the hypotheses are about different oscillators")
        if (low, high) != (left[0], right[1]):
            raise Unproved("the domains do not begin and end with I")
        if not escapes(self.escape, (left[1], right[0]), self.interval):
            raise Unproved("the gap is not proved to leave I")
        if self.repeller.words != FULL and not self._blocked(left):
            raise Unproved("the set that stays in I is not proved to have these words")

    def _blocked(self, left: Phases) -> bool:
        """Whether no three images in a row are in I0, and the words are those without 000."""
        if self.start is None or self.then is None or self.repeller.words != WITHOUT_000:
            return False
        return (
            self.start.phase == left[0] < self.then.phase <= self.start.image[0]
            and self.start.image[1] <= self.interval[1]
            and self.then.phase <= left[1] < self.then.image[0]
        )

    @property
    def at(self) -> Place:
        """The oscillator."""
        return self.repeller.at

    @property
    def interval(self) -> Phases:
        """I."""
        return self.repeller.hull

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        left, right = map(show_range, self.repeller.domains)
        flat, steep = hull(self.repeller.slopes)
        kind = "" if self.repeller.words == FULL else f", without three in a row in {left}"
        branches = "along 1, 01 and 001" if kind else "where it arrives in I"
        return (
            f"let Lambda(I) be the set of the phases in I = {show_range(self.interval)} whose "
            f"images by the impact map f all stay in I. f increases on {left} and on {right} and "
            f"takes no phase between them into I; Lambda(I) are the phases whose images stay in "
            f"these two{kind}; derivatives {branches} are between {floor_text(flat, 2)} and "
            f"{ceil_text(steep, 2)}, and the Hausdorff dimension of Lambda(I) satisfies "
            f"{between(self.repeller.dimension, 'D')}."
        )

    @property
    def brief(self) -> str:
        """Return the dimension."""
        return f"{between(self.repeller.dimension, 'dim')} for I = {show_range(self.interval)}"


def staying_dimension(
    repeller: Repeller, gaps: Sequence[Avoids], points: Sequence[Impact]
) -> StayingDimension:
    """Return the theorem of `StayingDimension`, by what is proved of the gap and of phases."""
    (low, high), (left, right) = repeller.hull, repeller.domains
    escape = next((x for x in gaps if escapes(x, (left[1], right[0]), (low, high))), None)
    if escape is None:
        raise Unproved("the gap is not proved to leave I")
    if repeller.words == FULL:
        return StayingDimension(repeller, escape, None, None)
    start = next((x for x in points if x.phase == low), None)
    beyond = [x for x in points if low < x.phase <= left[1] < x.image[0]]
    return StayingDimension(
        repeller, escape, start, min(beyond, key=lambda x: x.phase, default=None)
    )


def between(bounds: Range, name: str) -> str:
    """Write bounds outward, with two digits more than they decide."""
    places = min(40, len(str(int(1 / (bounds[1] - bounds[0])))) + 1)
    return f"{floor_text(bounds[0], places)} <= {name} <= {ceil_text(bounds[1], places)}"


def _dimension(of: Parameters, found: Found) -> Decision:
    """H13: by the set of I itself, or by a larger one, whose dimension is not smaller."""
    if max(of.moran_ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(of.moran_ratios))
    around = []
    for each in found.all(Repeller):
        with suppress(Unproved):
            around.append(staying_dimension(each, found.all(Avoids), found.all(Impact)))
    around = [each for each in around if within(of.interval, each.interval)]
    itself = [each for each in around if each.interval == of.interval]
    root = next((each for each in found.all(MoranRoot) if each.ratios == of.moran_ratios), None)
    if root is None or not around:
        return undecided(
            "no bracket of s_0" if root is None else "no horseshoe around I with dimension"
        )
    known = {"dimension": around[0].repeller.dimension, "s0": root.root}
    if itself and itself[0] is not around[0]:
        known["dimension_of_I"] = itself[0].repeller.dimension
    reason = (itself or around)[0]
    low, high = reason.repeller.dimension
    if root.root[1] < low and itself or high < root.root[0]:
        return decided(Verdict.REFUTED, reason, root, corrected=around, known=known)
    return undecided(f"{reason.brief}, and {root.brief}", known=known)


ROWS = (
    Row(
        "H13",
        "3.2, Claim 1",
        "The Hausdorff dimension of the set Lambda is s_0",
        "At (eta, nu) = ({eta}, {nu}): the phases whose images by f all stay in I = {i} form a set "
        "of Hausdorff dimension s_0, where {r0}^s_0 + {r1}^s_0 = 1.",
        _dimension,
    ),
)
