"""All orbits that do not come to stick: f expands on them, and words tell them apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import inverse_slope
from proofs.trusted.flights import Motion, lifted
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, hull, increasing, show
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.pieces import Piece, Pieces
from proofs.trusted.windows import BITS

BRACKET = Fraction(1, 2**26)  # the width of the time brackets in the rule `expansion`
Part = tuple[Fraction, Range]  # a bound of 1/|f'| on a part of a piece, and what holds its image


@dataclass(frozen=True)
class Expansion:
    """Lengths, times scales[i] in piece i, grow by `rate` > 1 or more from piece to piece."""

    pieces: Pieces
    scales: tuple[Fraction, ...]
    rate: Fraction

    def __post_init__(self) -> None:
        if len(self.scales) != len(self.pieces.monotone) or min(self.scales) <= 0:
            raise Unproved("a scale > 0 for each piece is expected")
        if self.rate <= 1:
            raise Unproved("f does not expand")

    @property
    def least(self) -> Fraction:
        """A constant c with |(f^n)'| >= c rate^n."""
        return min(self.scales) / max(self.scales)

    @property
    def sentence(self) -> str:
        """Return it in words."""
        return (
            f"{self.pieces.sentence} |(f^n)'| >= {self._growth} wherever phi, f(phi), ..., "
            "f^n(phi) lie in these intervals and none before the last is grazing. So two phases "
            "whose orbits stay in them for ever, and in the same one each time, are equal, and "
            "every periodic orbit in them is unstable. All other orbits come to the periodic orbit "
            "that sticks, which is stable, or to a phase without any impact, which is fixed if a "
            "touch counts."
        )

    @property
    def brief(self) -> str:
        """Return it in a line."""
        return (
            f"|(f^n)'| >= {self._growth} on all orbits that do not "
            "come to stick, nor to a phase without any impact"
        )

    @property
    def _growth(self) -> str:
        """The bound c rate^n, written."""
        above, below = self.least.as_integer_ratio()
        power = f"{show(self.rate)}^n" if above == 1 else f"{above} {show(self.rate)}^n"
        return power if below == 1 else f"{power}/{below}"


def expansion(
    pieces: Pieces, parts: list[list[Part]], scales: tuple[Fraction, ...], rate: Fraction
) -> Expansion:
    """Theorem. Let each piece i be the union of parts with 1/|f'| <= s and images in an interval,
    and rate s scale_i <= scale_j wherever this meets piece j. Then what `Expansion.sentence` says.

    Proof. Where f leads from piece i to j, |f'| scale_j >= rate scale_i: the chain rule. Two phases
    with one sequence bound an interval in one piece, sent monotonically onto one in the next, and
    so on: by the mean value theorem these grow by 1/s each time, and the pieces are bounded. On a
    periodic orbit |(f^n)'| >= c rate^n for all n: it is repelling. What leaves J is on the arc, or
    there after the next impact, and the flight from the arc returns to it.
    """
    found = Expansion(pieces, scales, rate)
    targets = [(piece.phases, scale) for piece, scale in zip(pieces.monotone, scales, strict=True)]
    for piece_parts, scale in zip(parts, scales, strict=True):
        METER.get().spend(2 * len(piece_parts) * len(targets))
        for bound, image in piece_parts:
            low, high = pieces.unwrapped(image)
            for (first, last), other in targets:
                if first <= high and low <= last and rate * bound * scale > other:
                    raise Unproved("f is not proved to expand from piece to piece")
    return found


def read_expansion(
    pieces: Pieces, cells_of: Reader, scales_of: Reader, rate_of: Reader
) -> Expansion:
    """Prove what `expansion` concludes.

    The cuts of cells lead from one end of the branch of a piece to the other; at each the gap is
    > 0 at the time given, < 0 by 2^-26 later. Parts are the phases between cuts, mapped between the
    images of these, and those beside grazes, near the limits there.
    """
    count = len(pieces.monotone)
    pairs = zip(pieces.monotone, cells_of.items(count, count), strict=True)
    parts = [[*_between(piece, entry), *beside(piece)] for piece, entry in pairs]
    return expansion(pieces, parts, scales_of.numbers(count, count), rate_of.number())


def _between(piece: Piece, entry: Reader) -> Iterator[Part]:
    """Read cuts of a branch, and yield the parts between them."""
    cuts_of, times_of = entry.fields("cuts", "times")
    cuts, branch = cuts_of.numbers(2), piece.branch
    times = times_of.numbers(len(cuts), len(cuts))
    if not increasing(cuts) or (cuts[0], cuts[-1]) != (branch.cuts[0], branch.cuts[-1]):
        raise cuts_of.fail("phases from one end of the branch to the other are expected")
    images = [branch.image(x, (t, t + BRACKET)) for x, t in zip(cuts, times, strict=True)]
    for phases, ends in zip(pairwise(cuts), pairwise(images), strict=True):
        yield part(branch, phases, hull(ends))


def part(branch: Branch, phases: Range, image: Range) -> Part:
    """Return what f is on an interval of a branch, on which it is monotone onto `image`."""
    bound = stretch(branch.motion(phases), (image[0] - phases[1], image[1] - phases[0]))
    return bound, lifted(image, -branch.turn, BITS)


def stretch(motion: Motion, time: Range) -> Fraction:
    """Bound 1/|f'| for impacts at these times; Unproved where f' may be 0."""
    bounds: Range = inverse_slope(motion.start, motion.clock(time)).range
    return max(-bounds[0], bounds[1])


def beside(piece: Piece) -> Iterator[Part]:
    """Yield the parts of a piece between its branch and grazes."""
    for grazing, above in ((piece.left, True), (piece.right, False)):
        if grazing is not None:
            yield _side(grazing, near=grazing.below is not above)


def _side(grazing: Grazing, *, near: bool) -> Part:
    """Return the part on one side of a graze."""
    time = (grazing.begin, grazing.time[1]) if near else grazing.landing
    if time is None:
        raise Unproved("nothing is known of impacts beside a graze")
    image = grazing.phases[0] + time[0], grazing.phases[1] + time[1]
    turn = grazing.turn if near else grazing.beyond
    return stretch(grazing.motion, time), lifted(image, -turn, BITS)
