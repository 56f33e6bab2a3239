"""Rules about orbits with a single impact; the lemmas are in `s4_single.single_facts`."""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock, launch_acceleration, sincos, slope
from proofs.trusted.flights import COVER_BITS, MAX_BITS, FirstImpact, Motion
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.paper.s4_single.single_facts import (
    FLIP,
    MOST_PERIODS,
    SADDLE,
    STICK,
    EtaWindows,
    NuWindows,
    Orbit,
    Solution,
    Window,
    defect,
    distance,
    excess,
    records,
)

_MOST_RECORDS = 10**5
_HALF = Fraction(1, 2)
_MOST_DIGITS = 400
Turn = tuple[Enclosure, Enclosure]


def _parameter(reader: Reader) -> Fraction:
    value = reader.number()
    if len(str(value)) > _MOST_DIGITS:
        raise reader.fail(f"a number of more than {_MOST_DIGITS} digits")
    return value


def _periods(reader: Reader) -> int:
    value = reader.number()
    if value.denominator != 1 or not 1 <= value <= MOST_PERIODS:
        raise reader.fail(f"n is a whole number from 1 to {MOST_PERIODS}")
    return int(value)


def _bits(width: Fraction, n: int) -> int:
    if width <= 0:
        raise Unproved("an empty bracket")
    needed = (1 / width).__ceil__().bit_length() + 2 * n.bit_length() + 64
    return min(MAX_BITS, max(COVER_BITS, needed))


def _turn(eta: Fraction, n: int, bits: int) -> Turn:
    """Enclose sin x, cos x, x = pi n eta."""
    return (pi(bits) * rational(n * eta, bits)).sincos()


def single_solution(context: Context, reader: Reader) -> Solution:
    """Rule `single-solution`: {eta, nu, n, phase: [lo, hi], early: time or null}.

    Hypotheses: n eta is no integer; K changes its sign between lo and hi, dK/dphi has one sign
    there, so K and (16) have exactly one zero in between; at the time `early`, in (0, 2 pi n), gap
    < 0 for all launches from the bracket. The multiplier is from the slope formula.
    """
    eta_of, nu_of, n_of, phase_of, early_of = reader.fields("eta", "nu", "n", "phase", "early")
    eta, nu, n, phase = _parameter(eta_of), _parameter(nu_of), _periods(n_of), phase_of.range()
    if eta <= 0 or nu == 0 or n * eta % 1 == 0:
        raise Unproved("eta > 0, nu != 0 and n eta not an integer are required")
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
    return Solution(eta, nu, n, phase, factor.range, acceleration.range, early)


def single_orbit(context: Context, reader: Reader) -> Orbit:
    """Rule `single-orbit`: {solution, flight}.

    Hypotheses: the earlier step `flight` proves a transversal first impact, at these eta and nu,
    for all launches from the solution's bracket, and 2 pi n is inside its window. Since gap = 0
    there and has one zero in the window, that is the first impact.
    """
    solution_of, flight_of = reader.fields("solution", "flight")
    solution = context.step(solution_of, Solution)
    flight = context.step(flight_of, FirstImpact)
    motion = flight.motion
    if (solution.eta, solution.nu) != (motion.eta, motion.nu):
        raise flight_of.fail("is about other parameters")
    if not (motion.phases[0] <= solution.phase[0] and solution.phase[1] <= motion.phases[1]):
        raise flight_of.fail("is about other phases")
    whole = (pi(COVER_BITS) * (2 * solution.n)).range
    begin, end = flight.windows[0]
    if not (flight.transversal and begin < whole[0] and whole[1] < end):
        raise Unproved("the first impact is not proved to be after n periods")
    return Orbit(solution)


def eta_windows(context: Context, reader: Reader) -> EtaWindows:
    """Rule `single-eta-windows`: {nu, low, ends: [[flip lo, hi, stick lo, hi]] for n = 1, 2, ...}.

    Hypotheses: 0 < nu < 1; all brackets lie in (0, 1/(2 n)); excess at M = -1 (flip) and M = 0
    (stick) is < 0 at the lower end and > 0 at the upper one; stick lo > low; for the n after the
    last, low n >= 1/2, or excess > 0 at M = 0 and eta = low < 1. Conclusion: lemmas 1, 2, 3 and 5.
    """
    nu_of, low_of, ends_of = reader.fields("nu", "low", "ends")
    nu, least = _parameter(nu_of), _parameter(low_of)
    if not (0 < nu < 1 and 0 < least < 1):
        raise Unproved("nu and the least eta must lie between 0 and 1")
    ends = []
    for n, entry in enumerate(ends_of.items(0, 1000), start=1):
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


def nu_windows(context: Context, reader: Reader) -> NuWindows:
    """Rule `single-nu-windows`: {eta, above: [[from, to]], below: [[from, to]], early: [time]}.

    `above` is about n = 1, 2, ... < 1/(2 eta), `below` about the records n < 1/eta, both 0 < eta
    < 1; a bracket for |nu| has excess > 0 at its lower and < 0 at its upper end; null: excess > 0
    at nu = 1. `early`: for the records n > 1/eta a time in
    (0, 2 pi n) at which the mass is above the table if p = -e. Conclusion: lemmas 1 to 4, since
    after the denominator of eta there are no records. Ends (1, 1) mean that there is no window.
    """
    eta_of, above_of, below_of, early_of = reader.fields("eta", "above", "below", "early")
    eta = _parameter(eta_of)
    if not 0 < eta < 1 or eta.denominator > _MOST_RECORDS:
        raise eta_of.fail(f"0 < eta < 1 and a denominator up to {_MOST_RECORDS} are expected")
    found = list(records(eta, eta.denominator))
    single = [n for n in found if n * eta < 1]
    later = [n for n in found if n * eta > 1]
    least = list(range(1, (_HALF / eta).__ceil__()))
    above = _windows(eta, least, (STICK, FLIP), above_of)
    below = _windows(eta, single, (SADDLE, STICK), below_of)
    times = early_of.numbers(0)
    if len(times) != len(later):
        raise early_of.fail(f"{len(later)} times are expected")
    for n, time in zip(later, times, strict=True):
        _excluded(eta, n, time)
    return NuWindows(eta, above, below, tuple(later))


def _windows(
    eta: Fraction, periods: list[int], ends: tuple[int, int], reader: Reader
) -> tuple[Window, ...]:
    windows = []
    for n, entry in zip(periods, reader.items(len(periods), len(periods)), strict=True):
        brackets = [
            _bracketed_nu(eta, n, end, one)
            for end, one in zip(ends, entry.items(2, 2), strict=True)
        ]
        if brackets[0][0] < 1:
            windows.append((n, brackets[0], brackets[1]))
    return tuple(windows)


def _excluded(eta: Fraction, n: int, time: Fraction) -> None:
    """Require gap < 0 at the time for nu < 0 and p = -(eta tan x)^2."""
    bits = 4 * COVER_BITS
    turn, own = _turn(eta, n, bits), rational(eta, bits)
    tangent = turn[0] / turn[1] * own
    now = clock(own, rational(time, bits))
    above: Enclosure = distance(own, turn, now, -(tangent * tangent))
    if not (0 < time < (pi(bits) * (2 * n)).range[0] and above.lo > 0):
        raise Unproved(f"an earlier impact is not proved for n = {n}")
