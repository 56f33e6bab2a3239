"""Where curves of grazing meet the curves of folds or of flips; names are those of `grazing`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, centre_of, read_box, sign_on
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.kernel.zeros import Piece, read_matrix, require_zero
from proofs.trusted.numbers import Range, between, floor_text, show_range, within
from proofs.trusted.paper.beyond.grazing import (
    ETA,
    FLIP,
    FOLD,
    TIME,
    GrazingCurve,
    P,
    amplitude,
    equations,
    touch,
)


def level(curve: GrazingCurve, other: str, piece: Piece) -> Formulas:
    """Return what is 0 on folds, or on flips, and grows with p, on a piece by its box.

    It is a function of eta and of p - slope (eta - middle).
    """
    along = f"{piece.slope[P]}", f"{centre_of(piece.box)[ETA]}"
    moved = f"p + ({along[0]})*(eta - {along[1]})"
    return read_formulas(Reader(f"at({equations(curve.n, curve.epsilon)[other]}, p={moved})"))


@dataclass(frozen=True)
class Meeting(Conclusion):
    """The one point of a curve of grazing at which it meets the curve of folds, or of flips.

    box: of eta, p and t there; rising: whether p_G minus the p of the fold (flip) goes from
    negative to positive as eta grows.
    """

    curve: GrazingCurve
    other: str
    box: Box
    rising: bool

    def __post_init__(self) -> None:
        if self.other not in (FOLD, FLIP):
            raise Unproved("a curve of folds or of flips is expected")

    @property
    def amplitude(self) -> Range:
        """Enclose nu there."""
        return amplitude(self.curve, self.box)

    @property
    def sentence(self) -> str:
        orbits = "below" if self.rising == (self.curve.side > 0) else "above"
        hit = "above" if orbits == "below" else "below"
        return (
            f"for {self.curve.named}: in {show_range(self.curve.arc.ends)} exactly one eta is such "
            f"that grazing, at p = p_G, takes place on the curve of {self.other}s. It is in "
            f"{show_range(self.box[ETA])}, nu in {show_range(self.amplitude)}, p_G in "
            f"{show_range(self.box[P])}, t_G in {show_range(self.box[TIME])}. For eta {orbits} it "
            f"the {self.other}s there are of orbits, for eta {hit} it of solutions that "
            "touch the table earlier, inside of that interval."
        )

    @property
    def brief(self) -> str:
        eta, nu = (between(each, 12) for each in (self.box[ETA], self.amplitude))
        return f"grazing and {self.other} meet for {self.curve.named} at eta in {eta}, nu in {nu}"

    @property
    def quantities(self) -> Mapping[str, Range]:
        near = floor_text(self.box[ETA][0], 2).replace(".", "_")
        name = f"{self.other}_{self.curve.n}_near_{near}"
        return {f"eta_graze_{name}": self.box[ETA], f"nu_graze_{name}": self.amplitude}


def meeting(context: Context, reader: Reader) -> Meeting:
    """Rule `grazing-meets`: {curve, other: fold or flip, around, box: {box, matrix}}.

    With L the formula of p - p_fold (or p_flip) times cos(x)^2, and F = (touch, L). Hypotheses: F
    has exactly one zero in the box `around`, and in `box`, a part of it (Krawczyk, see
    `unique-zero`); pieces of the curve that are not parts of `around` have a sign of L, one sign
    before and the other one after those that are. Conclusion: on the curve L has exactly one zero;
    it is in `box`, and L changes its sign there. Proof. L changes its sign along the pieces inside
    of `around`, so it has a zero there; that is one of F, and F has one. On the others it has none.
    """
    curve_of, other_of, around_of, box_of = reader.fields("curve", "other", "around", "box")
    curve, other = context.step(curve_of, GrazingCurve), other_of.string()
    if other not in (FOLD, FLIP):
        raise other_of.fail("fold or flip is expected")
    function = touch(curve.n, curve.epsilon, other)
    around, box = (_only_zero(function, each) for each in (around_of, box_of))
    if not all(map(within, box, around)):
        raise box_of.fail("a part of the box around is expected")
    return Meeting(curve, other, box, _rises(curve, other, around))


def _only_zero(function: Formulas, reader: Reader) -> Box:
    """Read a box with a matrix, by which a function has exactly one zero there."""
    box_of, matrix_of = reader.fields("box", "matrix")
    n = len(function.variables)
    box = read_box(box_of, n)
    require_zero(function, box, read_matrix(matrix_of, n))
    return box


def _rises(curve: GrazingCurve, other: str, around: Box) -> bool:
    """Whether L goes from < 0 to > 0 along the curve; Unproved unless it is as in `meeting`."""
    signs = [
        0 if all(map(within, piece.hull(ETA), around)) else sign(curve, other, piece)
        for piece in curve.arc.pieces
    ]
    runs = [sign for sign, _ in groupby(signs)]
    if runs not in ([-1, 0, 1], [1, 0, -1]):
        raise Unproved("the curves are not proved to meet once")
    return runs[0] < 0


def sign(curve: GrazingCurve, other: str, piece: Piece) -> int:
    """Return the sign of L on a piece; Unproved if it has none, or is not seen."""
    return sign_on(level(curve, other, piece), (piece.box[ETA], piece.box[P]))
