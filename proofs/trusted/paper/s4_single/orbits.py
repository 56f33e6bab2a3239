"""Section 4: solutions of (16), and which of them are orbits; five lemmas about them.

A short orbit, here, is one of the plastic impact map that leaves the table at once (its launch
acceleration is > 0) and has its first impact, a transversal one, n table periods later.

Plastic impacts, 0 < |nu| < 1. T = 2 pi n, x = pi n eta, n eta no integer; s, c = sin x, cos x;
side = sign(nu); h = 1 + nu sin(phi) > 0. Numbers are of any type, as in `proofs.trusted.equations`.

Lemma 1 (solutions). (16) is (2/eta) s K = 0 with K = nu cos(phi) c - eta h s. Where K = 0, let
p = nu sin(phi)/h and e = (eta tan x)^2: then h = 1/(1 - p), nu cos(phi) = eta h tan x and nu^2 =
A(p), A(p) = (p^2 + e)/(1 - p)^2; gap' at T is -2 |nu| cos(phi), and the slope (18) is the
multiplier M = c^2 (1 - p/eta^2). A falls on (-oo, -e] and grows on [-e, 1) from e/(1 + e) to oo,
since A' = 2 (p + e)/(1 - p)^3. M = 1 at p = -e (saddle-node); M = 0 at p = eta^2, where the launch
acceleration side h (p - eta^2) is 0 (sticking); M = -1 at p = eta^2 (1 + 1/c^2) (flip). Solutions
with p > -e, M < 1, are those of (17) with cos(phi - theta) > 0: (p + e) h sin(theta) = nu cos(phi -
theta), and sin(theta) has the sign of tan x, which is that of nu if cos(phi) > 0.

Lemma 2 (orbits). Let gap > 0 on (0, T) and gap = 0 > gap' at T. Then cos(phi) > 0, so tan x has
the sign of nu; for nu > 0, n eta < 1/2; for nu < 0, {n eta} > 1/2 and n is a record: 0 < {l eta} <
{n eta} for 0 < l < n, {} being fractional parts. Proof. The mass is at h cos(eta t - x)/c. If nu >
0, it is above the table, so above 0, for a time T, which is less than half its period. If nu < 0,
the table is at 2 pi l where it was at launch, and the mass below: cos(2 pi l eta - x)/c < 1; with
d = 1 - {n eta} this is cos(pi d + 2 pi l eta) < cos(pi d), that is 0 < {l eta} < 1 - d.

Lemma 3 (converse). Let K = 0 and side (p - eta^2) > 0: the launch leaves at once. If nu > 0 and
n eta < 1/2, or nu < 0 and 1/2 < n eta < 1, then gap > 0 on (0, T) and gap = 0 > gap' at T.
Proof. eta < 1: else, for nu > 0, side (p - eta^2) h = nu (1 - eta^2) sin(phi) - eta^2 < 0. With
y = t/2 we have gap = 2 side h (E - B + (p - eta^2) sin(y)^2), E = sin(eta y) sin(x - eta y)/c,
B = eta sin y (tan x cos y - eta sin y). side E > 0 is symmetric about y = pi n/2 and grows up to
there, so at y = pi k + r, 0 <= r < pi, it is at least its value at min(r, pi - r), or r = 0, B =
0, gap > 0. B has the period pi. At y = r, t = 2 r, 2 (E - B) = tan(x) U(t) - eta int_0^t U, where
U(t) = sin(eta t) - eta sin t grows on [0, pi]. nu > 0: if r >= pi/2, B <= 0. If r < pi/2,
2 (E - B) >= (tan x - eta t) U > 0, since int U <= t U and tan x > x >= pi eta >= eta t.
nu < 0: if r <= pi/2, -2 (E - B) = |tan x| U + eta int U > 0. If w = pi - r < pi/2, it is at least
2 (sin(eta w)^2 - eta^2 sin(w)^2 + |tan x| (sin(eta w) cos(eta w) + eta sin w cos w)) > 0.

Lemma 4 (earlier impacts). At fixed eta, n, t and nu < 0, gap/h falls as p grows: if gap < 0 at a
t in (0, T) for p = -e, then no solution with p >= -e, M <= 1, is an orbit.

Lemma 5 (windows in eta). On (0, 1/(2 n)) e, A(eta^2) and p_1 = eta^2 (1 + 1/c^2) grow with eta, and
A(p_1) does while p_1 < 1. So at fixed nu > 0 the condition eta^2 < p < p_1 on the p > -e with
A(p) = nu^2, that is A(eta^2) < nu^2 and (p_1 >= 1 or A(p_1) > nu^2), holds between two values of
eta; and if A(eta^2) >= nu^2 at some eta in (0, 1) and n, likewise at greater eta, n < 1/(2 eta).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Clock, clock, launch_acceleration, sincos, slope
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import COVER_BITS, MAX_BITS, TURN, Range, between, show
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Place

_MOST_PERIODS = 10**6
Number = Any
Pair = tuple[Number, Number]

SADDLE, STICK, FLIP = 1, 0, -1  # the multiplier at the ends of windows


def defect(eta: Number, nu: Number, phase: Pair, turn: Pair) -> Number:
    """Return K from the sines and cosines of phi and of x."""
    return nu * phase[1] * turn[1] - eta * (nu * phase[0] + 1) * turn[0]


def excess(eta: Number, nu: Number, turn: Pair, end: int) -> Number:
    """Return c^4 (p^2 + e - nu^2 (1 - p)^2) at the p with M = end.

    For |nu| <= 1 it is > 0 exactly if p >= 1 or nu^2 < A(p), since p^2 > (1 - p)^2 if p >= 1.
    """
    squares = turn[0] * turn[0], turn[1] * turn[1]
    share = squares[1] - end  # c^2 p/eta^2
    beyond = nu * (squares[1] - eta * eta * share)
    return eta * eta * (squares[0] * squares[1] + eta * eta * share * share) - beyond * beyond


def distance(eta: Number, turn: Pair, now: Clock, p: Number) -> Number:
    """Return side gap/h at a time of the flight of a solution: the mass minus the table."""
    tangent = turn[0] / turn[1]
    mass = now.mass_cos + tangent * now.mass_sin - 1
    return mass + p * (1 - now.table_cos) - eta * tangent * now.table_sin


def records(eta: Fraction, most: int) -> Iterator[int]:
    """Yield the n up to `most` that are records with {n eta} > 1/2.

    None is greater than the denominator of eta: the fractional parts repeat, from 0.
    """
    highest = Fraction(0)
    for n in range(1, most + 1):
        part = n * eta % 1
        if part > highest:
            highest = part
            if part > Fraction(1, 2):
                yield n


def bits_of(width: Fraction, n: int) -> int:
    """Return the precision that a bracket of this width deserves."""
    if width <= 0:
        raise Unproved("an empty bracket")
    needed = (1 / width).__ceil__().bit_length() + 2 * n.bit_length() + 64
    return min(MAX_BITS, max(COVER_BITS, needed))


def turn(eta: Fraction, n: int, bits: int) -> tuple[Enclosure, Enclosure]:
    """Enclose sin x, cos x, x = pi n eta."""
    return (pi(bits) * rational(n * eta, bits)).sincos()


def excess_at(eta: Fraction, nu: Fraction, n: int, end: int, bits: int = COVER_BITS) -> Enclosure:
    """Enclose excess at exact numbers."""
    found: Enclosure = excess(rational(eta, bits), rational(nu, bits), turn(eta, n, bits), end)
    return found


def bracketed(
    n: int, end: int, below: tuple[Fraction, Fraction], above: tuple[Fraction, Fraction]
) -> None:
    """Require that excess is < 0 at one point (eta, nu) and > 0 at another."""
    bits = bits_of(max(abs(x - y) for x, y in zip(below, above, strict=True)), n)
    if not excess_at(*below, n, end, bits).hi < 0 < excess_at(*above, n, end, bits).lo:
        raise Unproved("an end of a window is not bracketed")


# -- solutions and orbits --------------------------------------------------------------------------


@dataclass(frozen=True)
class Solution(Conclusion):
    """(16) has exactly one solution phi in `phase` for these eta, nu, n, n eta being no integer.

    multiplier encloses the slope (18) there, acceleration the relative one at launch, < 0 where
    the mass sticks. If `early` is not None, it is a time in (0, 2 pi n) at which gap < 0. first:
    whether the first impact after a launch there is at 2 pi n, and transversal.
    """

    at: Place
    n: int
    phase: Range
    multiplier: Range
    acceleration: Range
    early: Fraction | None = None
    first: bool = False

    def __post_init__(self) -> None:
        if not 1 <= self.n <= _MOST_PERIODS or self.n * self.at.eta[0] % 1 == 0:
            raise Unproved("n >= 1 is a whole number, n eta is none")

    @property
    def contracts(self) -> bool:
        return self.multiplier[0] > -1 and self.multiplier[1] < 1

    @property
    def sticks(self) -> bool:
        return self.acceleration[1] < 0

    @property
    def hits(self) -> bool:
        """Whether the mass leaves at once, and its first impact comes before n periods."""
        return self.acceleration[0] > 0 and self.early is not None

    @property
    def sentence(self) -> str:
        if self.first:
            return (
                f"a phase in {between(self.phase, 20)} is a fixed point of f, with slope in "
                f"{between(self.multiplier, 12)}: the mass leaves the table at once, and its first "
                f"impact, a transversal one, is 2 pi n later, n = {self.n}."
            )
        why = ", so that the mass sticks" if self.sticks else ""
        if self.early is not None and self.hits:
            why = f", but the mass would be inside the table at time {show(self.early)} < 2 pi n"
        return (
            f"for n = {self.n} the phase in {between(self.phase, 20)} solves (16); there (18) is "
            f"in {between(self.multiplier)}, the launch acceleration in "
            f"{between(self.acceleration)}{why}."
        )


def single_solution(_: Context, reader: Reader) -> Solution:
    """Rule `single-solution`: {eta, nu, n, phase: [lo, hi], early: time or null, latest: or null}.

    Hypotheses: n eta is no integer; K changes its sign between lo and hi, dK/dphi has one sign
    there; at the time `early`, in (0, 2 pi n), gap < 0 for all launches from the bracket; first
    impacts of all of them are found by `latest`, and 2 pi n is inside their window (see
    `FirstZero`). Conclusion: K and (16) have exactly one zero in between; its flight has an earlier
    impact, if `early` is given; 2 pi n is its first impact, if `latest` is given. Proof. K is a
    factor of (16), by lemma 1 the one that may vanish, and monotone on the bracket. gap = 0 at 2
    pi n, and gap has one zero in the window. The multiplier is from the slope formula.
    """
    eta_of, nu_of, n_of, phase_of, early_of, latest_of = reader.fields(
        "eta", "nu", "n", "phase", "early", "latest"
    )
    eta, nu, periods, phase = eta_of.number(), nu_of.number(), n_of.number(), phase_of.range()
    n, at = int(periods), Place.plastic(eta, nu)
    if n != periods:
        raise n_of.fail("a whole number is expected")
    if phase[0] < -TURN or phase[1] > TURN:
        raise phase_of.fail("phases lie between -2 pi and 2 pi")
    bits = bits_of(phase[1] - phase[0], n)
    own_eta, own_nu, one = (rational(x, bits) for x in (eta, nu, Fraction(1)))
    low, high, along = (
        defect(own_eta, own_nu, sincos(Dual(Enclosure.of(*ends, bits), one)), turn(eta, n, bits))
        for ends in ((phase[0], phase[0]), (phase[1], phase[1]), phase)
    )
    if not low.value.hi < 0 < high.value.lo and not high.value.hi < 0 < low.value.lo:
        raise Unproved("the bracket is not proved to contain a solution of (16)")
    if along.derivative.has_zero:
        raise Unproved("the bracket is not proved to contain one solution of (16) alone")
    motion = Motion(at, phase, bits)
    start, whole = motion.start, pi(bits) * (2 * n)
    early = None if early_of.is_null() else early_of.number()
    if early is not None and not 0 < early < whole.range[0]:
        raise early_of.fail("not a time between 0 and 2 pi n")
    if early is not None and motion.gap(start, (early, early)).hi >= 0:
        raise Unproved("the gap is not proved negative at the earlier time")
    factor, acceleration = slope(start, clock(own_eta, whole)), launch_acceleration(start)
    found = Solution(at, n, phase, factor.range, acceleration.range, early)
    if latest_of.is_null():
        return found
    begin, end = PlasticMap(at, latest_of.number()).window((Enclosure.of(*phase, bits),))
    if not (begin < whole.range[0] and whole.range[1] < end):
        raise Unproved("the first impact is not proved to be after n periods")
    return replace(found, first=True)
