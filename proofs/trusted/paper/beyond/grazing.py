"""Curves on which single-impact orbits touch the table on their way.

The orbits have one impact in n table periods, T = 2 pi n, at a phase phi, with restitution 0 <=
epsilon < 1; q = (1 - epsilon)/(1 + epsilon), x = pi n eta, h = 1 + nu sin(phi) > 0, p = nu
sin(phi)/h, e = (eta tan x)^2; 2 n eta is no integer. By `curves.curves` phase and velocity repeat
exactly if nu cos(phi) = q eta h tan x, gamma = nu cos(phi)/(q eta); nu^2 = A(p) = (p^2 + q^2 e)/
(1 - p)^2; side, the sign of nu, is that of tan x, so that gap' < 0 at T.

Lemma 1. Then gap = side h D, with D(t) = cos(eta t - x)/cos x - 1 + p (1 - cos t) - q eta tan x
sin t. Proof. The mass starts at h with the velocity nu cos(phi)/q = eta h tan x, the table is at
1 + h p cos t + h q eta tan x sin t; 1 = h (1 - p).

Lemma 2. Let eta, n, epsilon be fixed, and let gap >= 0 on (0, T) at p = p_G, gap = 0 at one t_G in
(0, T) alone, which is no multiple of 2 pi, gap' < 0 at T, and the first derivative of the gap at
launch that is not 0 (by order) be > 0. Then nothing is hit before T exactly for side (p - p_G) > 0:
D grows with p at all t but the multiples of 2 pi, at which gap > 0 for all p if for one; and if
side (p - p_G) < 0, gap < 0 at t_G.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Launch, clock, gap, sincos
from proofs.trusted.kernel import firstzero
from proofs.trusted.kernel.arcs import Arc, an_arc
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, centre_of, integer
from proofs.trusted.kernel.firstzero import FirstZero
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.kernel.gaps import Gap, falls
from proofs.trusted.kernel.operations import sqrt
from proofs.trusted.kernel.zeros import Piece
from proofs.trusted.numbers import COVER_BITS, Range, ceil_text, floor_text, show, show_range

ETA, P, TIME = range(3)  # the variables of a curve's formulas, in the order of the alphabet
FOLD, FLIP = "fold", "flip"
_MOST_PERIODS = 1000
_POINT_BITS, _PLACES = 128, 15
_HALVINGS = 6
_LATER = 6  # than T, at most, all flights are proved below the table
Number = Any


def ratio(epsilon: Fraction) -> Fraction:
    """Return q."""
    return (1 - epsilon) / (1 + epsilon)


def equations(n: int, epsilon: Fraction) -> dict[str, str]:
    """Return cos(x) D, its derivative, and what is 0 on folds and on flips, as formulas."""
    q, x = f"({ratio(epsilon)})", f"(pi*{n}*eta)"
    distance = f"cos(eta*t - {x}) - cos{x}*(1 - p*(1 - cos(t))) - {q}*eta*sin{x}*sin(t)"
    return {
        "D": distance,
        "D'": f"D({distance}, t)",
        FOLD: f"p*cos{x}**2 + {q}**2*eta**2*sin{x}**2",
        FLIP: f"p*cos{x}**2 - eta**2*(1 + {q}**2*cos{x}**2)",
    }


def touch(n: int, epsilon: Fraction, *others: str) -> Formulas:
    """Return F = (cos(x) D, its derivative in t, others) as a function of eta, p and t."""
    texts = equations(n, epsilon)
    return replace(read_formulas(*(Reader(texts[each]) for each in ("D", "D'", *others))), name="F")


def single_launch(
    n: int, q: Fraction, side: int, place: tuple[Number, Number], pi: Number
) -> Launch:
    """Return the launch of the solution at place = (eta, p): the mass with eta h tan(x)."""
    eta, p = place
    sin, cos = sincos(pi * n * eta)
    lift = p / (1 - p)
    speed = eta * sin / cos * (lift + 1)
    rate = speed * q.numerator / q.denominator
    kick = speed * (q.denominator - q.numerator) / q.denominator
    return Launch(side, eta, lift, rate, kick if q < 1 else None)


@dataclass(frozen=True)
class GrazingCurve(Conclusion):
    """A smooth curve (p_G, t_G) over an interval of eta: lemma 2 holds all along it.

    arc: of zeros of `touch`.
    """

    n: int
    epsilon: Fraction
    side: int
    arc: Arc

    def __post_init__(self) -> None:
        if self.n < 1 or not 0 <= self.epsilon < 1 or self.side not in (1, -1):
            raise Unproved("n >= 1, 0 <= epsilon < 1 and a sign are required")
        if self.arc.ends[0] <= 0 or any(x.hull(ETA)[P][1] >= 1 for x in self.arc.pieces):
            raise Unproved("eta > 0 and p < 1 are required")

    @cached_property
    def amplitudes(self) -> list[Range]:
        """Enclosures of nu at its points."""
        return [amplitude(self, point) for point in self.arc.points]

    @property
    def named(self) -> str:
        """Name its parameters."""
        sign = ">" if self.side > 0 else "<"
        return f"epsilon = {show(self.epsilon)}, n = {self.n} and nu {sign} 0"

    @property
    def sentence(self) -> str:
        beyond = ">" if self.side > 0 else "<"
        listed = "; ".join(
            f"eta = {show(point[ETA][0])}: nu in {show_range(nu)}, p_G in {show_range(point[P])}, "
            f"t_G in {show_range(point[TIME])}"
            for point, nu in zip(self.arc.points, self.amplitudes, strict=True)
        )
        return (
            f"for {self.named}: there are smooth functions p_G and t_G of eta in "
            f"{show_range(self.arc.ends)} such that the solution of (14), (15) with one impact in "
            "2 pi n, h = 1 + nu sin(phi) > 0 and p = nu sin(phi)/h < 1 leaves the table at once "
            "and has no impact or touch before that one, which is transversal, exactly if p "
            f"{beyond} p_G. At p = p_G it touches the table once, at the time t_G, with relative "
            f"velocity 0 and relative acceleration > 0 (grazing); there nu = {self._sign}sqrt(p^2 "
            f"+ (q eta tan(pi n eta))^2)/(1 - p), q = {show(ratio(self.epsilon))}. The curve is in "
            f"{len(self.arc.pieces)} slanted boxes, at one eta at most {self._width(P)} wide in p, "
            f"{self._width(TIME)} in t{listed and f'; at {listed}'}."
        )

    def _width(self, place: int) -> str:
        return ceil_text(self.arc.width(place), 4)

    @property
    def _sign(self) -> str:
        return "" if self.side > 0 else "-"

    @property
    def brief(self) -> str:
        ends = " to ".join(map(show, self.arc.ends))
        return f"grazing for {self.named}, eta from {ends}, in {len(self.arc.pieces)} boxes"

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {
            f"nu_graze_{self.n}_at_{show(point[ETA][0])}".replace(".", "_"): nu
            for point, nu in zip(self.arc.points, self.amplitudes, strict=True)
        }


def grazing_curve(_: Context, reader: Reader) -> GrazingCurve:
    """Rule `grazing-curve`: {n, epsilon, pieces, points}.

    Hypotheses: pieces and points are those of an arc over eta of zeros of `touch`, see `an_arc`,
    p < 1 and 0 < t < T. For each piece, and all (eta, p) in it, the gap is proved > 0 up to a time
    after T but in two windows (see `FirstZero.windows`; gap' > 0 at first, gap'' > 0 for epsilon =
    0): gap'' > 0 in the first, T is inside the second one, and gap' < 0 there. Conclusion: lemma 2,
    with relative acceleration > 0 at t_G.

    Proof. gap = gap' = 0 at t_G, in (0, T), so t_G is in a window, not in the second one:
    it is in the first, and the only zero there. The derivative of F by p and t is regular, so t_G
    is no multiple of 2 pi.
    """
    n_of, epsilon_of, pieces_of, points_of = reader.fields("n", "epsilon", "pieces", "points")
    n, epsilon = integer(n_of, 1, _MOST_PERIODS), epsilon_of.number()
    if not 0 <= epsilon < 1:
        raise epsilon_of.fail("0 <= epsilon < 1 is expected")
    arc = an_arc(touch(n, epsilon), ETA, pieces_of, points_of)
    side = -1 if 2 * n * arc.ends[0] // 1 % 2 else 1
    for piece in arc.pieces:
        require_one_touch(n, epsilon, side, piece)
    return GrazingCurve(n, epsilon, side, arc)


class _Flights(NamedTuple):
    """Flights of all (eta, p) of a piece."""

    gap_of: Gap
    states: list[Enclosure]

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose derivatives of the gap."""
        return [self.gap_of(t.range, order) for order in roots]


def require_one_touch(n: int, epsilon: Fraction, side: int, piece: Piece) -> None:
    """Raise Unproved unless what the rule `grazing-curve` asks of a piece is proved."""
    gap_of, order = gap_along(n, ratio(epsilon), side, piece), 1 if epsilon else 2
    whole, touched = (pi(COVER_BITS) * (2 * n)).range, piece.hull(ETA)[TIME]
    if not 0 < touched[0] <= touched[1] < whole[0]:
        raise Unproved("the touch is not proved to be before the impact")
    flights = _Flights(gap_of, [Enclosure.of(*piece.box[ETA], COVER_BITS)])
    search = FirstZero(flights, firstzero.Gap((0, 1, 2, 3), order, order, is_constant=False))
    windows = list(search.windows(whole[1] + _LATER))
    if len(windows) != 2:
        raise Unproved("another touch on the way is not excluded")
    around, last = windows
    if gap_of(around, 2).lo <= 0:
        raise Unproved("the touch is not proved to be the only one in its window")
    if not (last[0] < whole[0] and whole[1] < last[1] and falls(gap_of, last, _HALVINGS)):
        raise Unproved("the impact is not proved to be transversal")


def gap_along(n: int, q: Fraction, side: int, piece: Piece) -> Gap:
    """Return the gap of all (eta, p) in a piece, enclosed directly and by the mean value theorem:
    the p - slope (eta - middle) do not depend on eta.
    """
    bits = COVER_BITS
    (low, high), (mean, _) = piece.box[ETA], centre_of(piece.box)[ETA : P + 1]
    own, middle = Enclosure.of(low, high, bits), rational(mean, bits)
    slope, one = (rational(x, bits) for x in (piece.slope[P], Fraction(1)))
    eta, p = Dual(own, one), Dual(Enclosure.of(*piece.hull(ETA)[P], bits), slope)
    moving = single_launch(n, q, side, (eta, p), pi(bits))
    still = single_launch(n, q, side, (middle, Enclosure.of(*piece.box[P], bits)), pi(bits))

    def gap_of(time: Range, order: int) -> Enclosure:
        t = Enclosure.of(*time, bits)
        along: Dual = gap(moving, clock(eta, t), order)
        there: Enclosure = gap(still, clock(middle, t), order)
        return along.value.meet(there + along.derivative * (own - middle))

    return gap_of


def nu_squared(n: int, q: Fraction, place: tuple[Number, Number], pi: Number) -> Number:
    """Return A(p) at place = (eta, p)."""
    eta, p = place
    sin, cos = sincos(pi * n * eta)
    across = eta * sin / cos * q.numerator / q.denominator
    return (p * p + across * across) / ((1 - p) * (1 - p))


def amplitude(of: GrazingCurve, box: Box) -> Range:
    """Enclose nu at all (eta, p) of a box, in decimals."""
    place = Enclosure.of(*box[ETA], _POINT_BITS), Enclosure.of(*box[P], _POINT_BITS)
    square: Enclosure = nu_squared(of.n, ratio(of.epsilon), place, pi(_POINT_BITS))
    low, high = (sqrt(square) * of.side).range
    return Fraction(floor_text(low, _PLACES)), Fraction(ceil_text(high, _PLACES))
