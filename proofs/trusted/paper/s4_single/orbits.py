"""Section 4: solutions of (16), which of them are orbits, and where stable orbits are.

A short orbit, here, is one of the plastic impact map that leaves the table at once (its launch
acceleration is > 0) and has its first impact, a transversal one, n table periods later. The lemmas
are those of `single_facts`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock, launch_acceleration, sincos, slope
from proofs.trusted.flights import COVER_BITS, MAX_BITS, FirstImpact, Motion
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import TURN, Range, ceil_text, floor_text, show, within
from proofs.trusted.paper.s4_single.single_facts import (
    FLIP,
    SADDLE,
    STICK,
    defect,
    distance,
    excess,
    records,
)
from proofs.trusted.parameters import Place

_MOST_PERIODS = 10**6
_MOST_RECORDS = 10**5
_HALF = Fraction(1, 2)
_FINE = Fraction(1, 10**9)
_LEAVING = (
    "an orbit that leaves the table at once (launch acceleration > 0), with its first impact, a "
    "transversal one, n table periods later and |f'| < 1, exists exactly"
)
Turn = tuple[Enclosure, Enclosure]


def _within(values: Range, places: int = 6) -> str:
    return f"[{floor_text(values[0], places)}, {ceil_text(values[1], places)}]"


def _bits(width: Fraction, n: int) -> int:
    if width <= 0:
        raise Unproved("an empty bracket")
    needed = (1 / width).__ceil__().bit_length() + 2 * n.bit_length() + 64
    return min(MAX_BITS, max(COVER_BITS, needed))


def _turn(eta: Fraction, n: int, bits: int) -> Turn:
    """Enclose sin x, cos x, x = pi n eta."""
    return (pi(bits) * rational(n * eta, bits)).sincos()


# -- solutions and orbits --------------------------------------------------------------------------


@dataclass(frozen=True)
class Solution(Conclusion):
    """(16) has exactly one solution phi in `phase` for these eta, nu, n, n eta being no integer.

    multiplier encloses the slope (18) there, acceleration the relative one at launch, < 0 where
    the mass sticks. If `early` is not None, it is a time in (0, 2 pi n) at which gap < 0.
    """

    at: Place
    n: int
    phase: Range
    multiplier: Range
    acceleration: Range
    early: Fraction | None

    def __post_init__(self) -> None:
        """Raise Unproved where n is none, or all phases solve (16)."""
        if not 1 <= self.n <= _MOST_PERIODS or self.n * self.at.eta[0] % 1 == 0:
            raise Unproved("n >= 1 is a whole number, n eta is none")

    @property
    def contracts(self) -> bool:
        """Whether |slope| < 1."""
        return self.multiplier[0] > -1 and self.multiplier[1] < 1

    @property
    def sticks(self) -> bool:
        """Whether the mass does not leave the table at once."""
        return self.acceleration[1] < 0

    @property
    def hits(self) -> bool:
        """Whether the mass leaves at once, and its first impact comes before n periods."""
        return self.acceleration[0] > 0 and self.early is not None

    @property
    def sentence(self) -> str:
        """Return the statement."""
        why = ""
        if self.hits and self.early is not None:
            why = f", but the mass would be inside the table at time {show(self.early)} < 2 pi n"
        elif self.sticks:
            why = ", so that the mass sticks"
        return (
            f"for n = {self.n} the phase in {_within(self.phase, 20)} solves (16); there (18) is "
            f"in {_within(self.multiplier)}, the launch acceleration in "
            f"{_within(self.acceleration)}{why}."
        )

    @property
    def brief(self) -> str:
        """Return it with its place."""
        return f"at {self.at}, {self.sentence.rstrip('.')}"


@dataclass(frozen=True)
class Orbit(Conclusion):
    """After a launch at the solution's phase the first impact is at 2 pi n, and transversal."""

    at: Place
    solution: Solution

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"a phase in {_within(self.solution.phase, 20)} is a fixed point of f, with slope in "
            f"{_within(self.solution.multiplier, 12)}: the mass leaves the table at once, and its "
            f"first impact, a transversal one, is 2 pi n later, n = {self.solution.n}."
        )


def single_solution(context: Context, reader: Reader) -> Solution:
    """Rule `single-solution`: {eta, nu, n, phase: [lo, hi], early: time or null}.

    Hypotheses: n eta is no integer; K changes its sign between lo and hi, dK/dphi has one sign
    there, so K and (16) have exactly one zero in between; at the time `early`, in (0, 2 pi n), gap
    < 0 for all launches from the bracket. The multiplier is from the slope formula.
    """
    eta_of, nu_of, n_of, phase_of, early_of = reader.fields("eta", "nu", "n", "phase", "early")
    eta, nu, periods, phase = eta_of.number(), nu_of.number(), n_of.number(), phase_of.range()
    n, at = int(periods), Place.plastic(eta, nu)
    if n != periods:
        raise n_of.fail("a whole number is expected")
    if phase[0] < -TURN or phase[1] > TURN:
        raise phase_of.fail("phases lie between -2 pi and 2 pi")
    bits = _bits(phase[1] - phase[0], n)
    own_eta, own_nu, turn = rational(eta, bits), rational(nu, bits), _turn(eta, n, bits)

    def k(x: Dual) -> Dual:
        found: Dual = defect(own_eta, own_nu, sincos(x), turn)
        return found

    one = rational(Fraction(1), bits)
    low, high = (k(Dual(rational(x, bits), one)).value for x in phase)
    along = k(Dual(Enclosure.of(*phase, bits), one)).derivative
    if not (low.hi < 0 < high.lo or high.hi < 0 < low.lo) or along.lo <= 0 <= along.hi:
        raise Unproved("the bracket is not proved to contain one solution of (16)")
    motion = Motion(eta, nu, phase, bits)
    start = motion.start()
    early = None if early_of.is_null() else early_of.number()
    whole = pi(bits) * (2 * n)
    if early is not None:
        if not 0 < early < whole.range[0]:
            raise early_of.fail("not a time between 0 and 2 pi n")
        if motion.gap(start, (early, early)).hi >= 0:
            raise Unproved("the gap is not proved negative at the earlier time")
    factor: Enclosure = slope(start, clock(own_eta, whole))
    acceleration: Enclosure = launch_acceleration(start)
    return Solution(at, n, phase, factor.range, acceleration.range, early)


def single_orbit(context: Context, reader: Reader) -> Orbit:
    """Rule `single-orbit`: {solution, flight}.

    Hypotheses: the earlier step `flight` proves a transversal first impact, at these eta and nu,
    for all launches from the solution's bracket, and 2 pi n is inside its window. Since gap = 0
    there and has one zero in the window, that is the first impact.
    """
    solution_of, flight_of = reader.fields("solution", "flight")
    solution = context.step(solution_of, Solution)
    flight = context.step(flight_of, FirstImpact)
    if solution.at != flight.at or not within(solution.phase, flight.motion.phases):
        raise flight_of.fail("is about other parameters or phases")
    whole = (pi(COVER_BITS) * (2 * solution.n)).range
    begin, end = flight.windows[0]
    if not (flight.transversal and begin < whole[0] and whole[1] < end):
        raise Unproved("the first impact is not proved to be after n periods")
    return Orbit(solution.at, solution)


# -- windows in eta --------------------------------------------------------------------------------


@dataclass(frozen=True)
class EtaWindows(Conclusion):
    """Where stable short orbits are at fixed nu in (0, 1), for all eta >= low.

    They exist exactly for n = 1, ..., len(ends) and eta between the two values that ends[n - 1] =
    (flip, stick) enclose: there the slope is -1, 0.
    """

    nu: Fraction
    low: Fraction
    ends: tuple[tuple[Range, Range], ...]

    def __post_init__(self) -> None:
        """Raise Unproved unless the windows are apart and their ends known to nine places."""
        down = [end for flip, stick in self.ends for end in (stick, flip)]
        if any(high - low > _FINE for low, high in down):
            raise Unproved("the ends of windows are not known to nine places")
        if any(later[1] >= end[0] for end, later in pairwise(down)):
            raise Unproved("the windows are not proved to be apart")

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        inner = [(max(flip[1], self.low), stick[0]) for flip, stick in self.ends]
        listed = "; ".join(
            f"n = {n}: ({ceil_text(low, 8)}, {floor_text(high, 8)})"
            for n, (low, high) in enumerate(inner, start=1)
        )
        return (
            f"For nu = {show(self.nu)} (p < 0), plastic impacts and eta >= {show(self.low)}, "
            f"{_LEAVING} for n = 1, ..., {len(self.ends)} if eta is in one of as many disjoint "
            "open intervals, one for each n, from f' = -1 (flip) up to f' = 0 (sticking), or what "
            f"of it is above {show(self.low)}. Rounded inward, by less than 2e-8: {listed}."
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        """Return the ends."""
        return {
            f"eta_{name}_{n}": bounds
            for n, pair in enumerate(self.ends, start=1)
            for name, bounds in zip(("flip", "stick"), pair, strict=True)
        }


def eta_windows(context: Context, reader: Reader) -> EtaWindows:
    """Rule `single-eta-windows`: {nu, low, ends: [[flip lo, hi, stick lo, hi]] for n = 1, 2, ...}.

    Hypotheses: 0 < nu < 1; all brackets lie in (0, 1/(2 n)); excess at M = -1 (flip) and M = 0
    (stick) is < 0 at the lower end and > 0 at the upper one; stick lo > low; for the n after the
    last, low n >= 1/2, or excess > 0 at M = 0 and eta = low < 1. Conclusion: lemmas 1, 2, 3 and 5.
    """
    nu_of, low_of, ends_of = reader.fields("nu", "low", "ends")
    nu, least = nu_of.number(), low_of.number()
    if not (0 < nu < 1 and 0 < least < 1):
        raise Unproved("nu and the least eta must lie between 0 and 1")
    ends = []
    for n, entry in enumerate(ends_of.items(1, 1000), start=1):
        flip_low, flip_high, stick_low, stick_high = entry.numbers(4, 4)
        flip, stick = (flip_low, flip_high), (stick_low, stick_high)
        for end, bracket in ((FLIP, flip), (STICK, stick)):
            if not 0 < bracket[0] < bracket[1] < _HALF / n:
                raise entry.fail("a bracket in (0, 1/(2 n)) is expected")
            bits = _bits(bracket[1] - bracket[0], n)
            low, high = (_excess(eta, nu, n, end, bits) for eta in bracket)
            if not low.hi < 0 < high.lo:
                raise Unproved("an end of a window is not bracketed")
        if stick_low <= least:
            raise entry.fail("a window that is not proved to reach beyond the least eta")
        ends.append((flip, stick))
    after = len(ends) + 1
    if after * least < _HALF and _excess(least, nu, after, STICK, COVER_BITS).lo <= 0:
        raise Unproved(f"windows for n = {after} are not excluded")
    return EtaWindows(nu, least, tuple(ends))


def _excess(eta: Fraction, nu: Fraction, n: int, end: int, bits: int) -> Enclosure:
    found: Enclosure = excess(rational(eta, bits), rational(nu, bits), _turn(eta, n, bits), end)
    return found


# -- windows in nu ---------------------------------------------------------------------------------

Window = tuple[int, Range, Range]


@dataclass(frozen=True)
class NuWindows(Conclusion):
    """Where stable short orbits are at fixed eta, for 0 < |nu| < 1: n and enclosures of the ends.

    above: for nu > 0, from the nu where the slope is 0 to that where it is -1 (or 1 if that is
    larger). below: for nu < 0, from the |nu| where it is 1 to that where it is 0 (or 1). There
    are no others; early are those n > 1/eta that need an earlier impact to be excluded.
    """

    eta: Fraction
    above: tuple[Window, ...]
    below: tuple[Window, ...]
    early: tuple[int, ...]

    def __post_init__(self) -> None:
        """Raise Unproved unless each window begins before it ends."""
        if any(first[1] >= last[0] for _, first, last in (*self.above, *self.below)):
            raise Unproved("a window is not proved to have a length")

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        above, below = (
            "; ".join(
                f"n = {n}, |nu| from {_within(first, 15)} to {_within(last, 15)}"
                for n, first, last in windows
            )
            or "none"
            for windows in (self.above, self.below)
        )
        early = ""
        if self.early:
            periods = ", ".join(map(str, self.early))
            early = f" For nu < 0 and n = {periods} all solutions with slope <= 1 impact earlier."
        return (
            f"For eta = {show(self.eta)}, plastic impacts and 0 < |nu| < 1, {_LEAVING} with n and "
            f"|nu| in one of these open intervals. For nu > 0 (p < 0), from f' = 0 (sticking) to "
            f"f' = -1 (flip), or to 1: {above}. For nu < 0 (p > 0), from f' = 1 (saddle-node) to "
            f"f' = 0 (sticking), or to 1: {below}.{early}"
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        """Return the ends."""
        sides = ((self.below, ("saddle", "stick")), (self.above, ("stick", "flip")))
        return {
            f"nu_{name}_{n}": bounds
            for windows, names in sides
            for n, *both in windows
            for name, bounds in zip(names, both, strict=True)
        }


def nu_windows(context: Context, reader: Reader) -> NuWindows:
    """Rule `single-nu-windows`: {eta, above: [[from, to]], below: [[from, to]], early: [time]}.

    `above` is about n = 1, 2, ... < 1/(2 eta), `below` about the records n < 1/eta, both 0 < eta
    < 1; a bracket for |nu| has excess > 0 at its lower and < 0 at its upper end; null: excess > 0
    at nu = 1. `early`: for the records n > 1/eta a time in
    (0, 2 pi n) at which the mass is above the table if p = -e. Conclusion: lemmas 1 to 4, since
    after the denominator of eta there are no records. Ends (1, 1) mean that there is no window.
    """
    eta_of, above_of, below_of, early_of = reader.fields("eta", "above", "below", "early")
    eta = eta_of.number()
    if not 0 < eta < 1 or eta.denominator > _MOST_RECORDS:
        raise eta_of.fail(f"0 < eta < 1 and a denominator up to {_MOST_RECORDS} are expected")
    METER.get().spend(4 * eta.denominator)
    found = list(records(eta, eta.denominator))
    later = [n for n in found if n * eta > 1]
    least = list(range(1, (_HALF / eta).__ceil__()))
    above = _windows(eta, least, (STICK, FLIP), above_of)
    below = _windows(eta, [n for n in found if n * eta < 1], (SADDLE, STICK), below_of)
    for n, time in zip(later, early_of.items(len(later), len(later)), strict=True):
        _excluded(eta, n, time.number())
    return NuWindows(eta, above, below, tuple(later))


def _windows(
    eta: Fraction, periods: Sequence[int], ends: tuple[int, int], reader: Reader
) -> tuple[Window, ...]:
    windows = []
    for n, entry in zip(periods, reader.items(len(periods), len(periods)), strict=True):
        first, last = (
            _bracketed_nu(eta, n, end, one)
            for end, one in zip(ends, entry.items(2, 2), strict=True)
        )
        if first[0] < 1:
            windows.append((n, first, last))
    return tuple(windows)


def _bracketed_nu(eta: Fraction, n: int, end: int, reader: Reader) -> Range:
    """Enclose the |nu| of a solution with M = end; (1, 1) for null if it is 1 or more."""
    if reader.is_null():
        if _excess(eta, Fraction(1), n, end, COVER_BITS).lo <= 0:
            raise Unproved("an end of a window is not proved to be at |nu| >= 1")
        return Fraction(1), Fraction(1)
    bracket = reader.range()
    bits = _bits(bracket[1] - bracket[0], n)
    low, high = (_excess(eta, nu, n, end, bits) for nu in bracket)
    if not (bracket[0] > 0 and bracket[1] <= 1 and high.hi < 0 < low.lo):
        raise Unproved("an end of a window is not bracketed")
    return bracket


def _excluded(eta: Fraction, n: int, time: Fraction) -> None:
    """Require gap < 0 at the time for nu < 0 and p = -(eta tan x)^2."""
    bits = 4 * COVER_BITS
    turn, own = _turn(eta, n, bits), rational(eta, bits)
    tangent = turn[0] / turn[1] * own
    now = clock(own, rational(time, bits))
    above: Enclosure = distance(own, turn, now, -(tangent * tangent))
    if not (0 < time < (pi(bits) * (2 * n)).range[0] and above.lo > 0):
        raise Unproved(f"an earlier impact is not proved for n = {n}")
