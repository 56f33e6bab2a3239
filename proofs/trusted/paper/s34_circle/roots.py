"""Square roots where f jumps, and the horseshoe between them. Row H18."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.numbers import Range, between, show_range, within
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.pieces import Piece, Pieces
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_NARROW, _NEAR = Fraction(1, 10**9), Fraction(1, 200)
_PLACES = 9
ENDS = tuple(map(Fraction, ("1.2", "1.36", "1.5", "1.57")))  # where row H18 looks for grazes


@dataclass(frozen=True)
class Between(Conclusion):
    """Theorem. Let grazes, in order, be those at the ends of pieces that follow one another, with
    f' > 0, the impacts after a piece in one window. Then what the sentence says.

    Proof. On a piece f is monotone, between its limits at the grazes, less the same turns. Let the
    first m pieces all have images that contain the phases from phi_1 to phi_(m+1). Each has a
    compact part that f maps onto these, apart from the grazes, whose limits are beyond; so for each
    sequence of pieces the phases that follow it for n steps are compact, not empty, and nested.
    """

    pieces: Pieces
    grazes: tuple[Grazing, ...]

    def __post_init__(self) -> None:
        if len(self.grazes) < 2 or any(each.at != self.at for each in self.grazes):
            raise Unproved("two grazes or more of one oscillator are expected")
        for one, two in pairwise(self.grazes):
            if not any(_ends(piece, one, two) for piece in self.pieces.monotone):
                raise Unproved("no piece is proved to lie between two grazes")
            if one.other is None or one.beyond != two.turn:
                raise Unproved("between two grazes images are not less the same turns")

    at = About("pieces")

    @property
    def images(self) -> list[tuple[Range, Range]]:
        """Enclose the limits of f on both ends of each piece, less the same turns."""
        return [(one.other, two.graze) for one, two in pairwise(self.grazes) if one.other]

    @property
    def full(self) -> int:
        """How many pieces, from the first on, are mapped over them all."""
        low = self.grazes[0].phases[0]
        return max(
            m
            for m in range(len(self.grazes))
            if all(a[1] < low and self.grazes[m].phases[1] < b[0] for a, b in self.images[:m])
        )

    @property
    def sentence(self) -> str:
        onto = "; ".join(
            f"between phi_{i} and phi_{i + 1} f increases from a limit in {between(low, _PLACES)} "
            f"to one in {between(high, _PLACES)}"
            for i, (low, high) in enumerate(self.images, 1)
        )
        phases = ", ".join(show_range(graze.phases) for graze in self.grazes)
        shift = ""
        if self.full > 1:
            shift = (
                f" So each of the first {self.full} of these intervals is mapped over all phases "
                f"from phi_1 to phi_{self.full + 1}: each infinite sequence of them is "
                "followed by an orbit there, at a distance from all grazes, though f' is not "
                "bounded on these intervals."
            )
        return f"with phi_1, phi_2, ... the grazing phases in {phases}: {onto}.{shift}"


def _ends(piece: Piece, one: Grazing, two: Grazing) -> bool:
    """Whether grazes are those at the ends of a piece on which f increases."""
    if piece.left is None or piece.right is None or not (one.below and two.below):
        return False
    return within(one.phases, piece.left.phases) and within(two.phases, piece.right.phases)


# -- the row ---------------------------------------------------------------------------------------


def _jump(graze: Grazing) -> Range:
    """Enclose f_g less f's limit on the other side; both are counted from the window's turn."""
    other = graze.other or graze.graze
    return graze.graze[0] - other[1], graze.graze[1] - other[0]


def _roots(of: Parameters, found: Found) -> Decision:
    """H18: by narrow grazes near each of the phases asked about, in their order."""
    del of
    narrow = [x for x in found.all(Grazing) if x.root[1] - x.root[0] <= _NARROW and x.other]
    known = [x for x in narrow if not _jump(x)[0] <= 0 <= _jump(x)[1]]
    near = [[x for x in known if abs(x.phases[0] - end) <= _NEAR] for end in ENDS]
    if not all(near):
        return undecided(
            "not at each of these phases a jump and its square root are enclosed narrowly"
        )
    best = [group[0] for group in near]
    values = {
        f"{name}_{index}": value
        for index, graze in enumerate(best, 1)
        for name, value in (("phase", graze.phases), ("root", graze.root), ("jump", _jump(graze)))
    }
    horseshoes = [Between(pieces, tuple(best)) for pieces in found.all(Pieces)[:1]]
    return decided(Verdict.VERIFIED, *best, corrected=[*best, *horseshoes], known=values)


ROWS = (
    Row(
        "H18",
        "3.1",
        "",
        "At (eta, nu) = ({eta}, {nu}): f jumps at phases near 1.2, 1.36, 1.50 and 1.57 after which "
        "the mass grazes the table, with a square root whose coefficients are known to 9 places.",
        _roots,
        PAPER.place,
    ),
)
