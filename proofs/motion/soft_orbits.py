"""Soft springs: which periodic motions are orbits, of first impacts, and which attract."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache

from intervals import Interval, Undecided, sqrt
from proofs.methods.formulas import values
from proofs.motion.digits import around
from proofs.motion.soft import Gap, Motion, Springs
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s5_soft import orbits as eq

_PIECES = 500  # of a flight, at most
_EDGE = 64  # the part of a flight, at first, that is its launch, and that is its impact
_HALVINGS = 40
_STEP = Fraction(1, 32)  # of the shift, along the orbits of period 2
_SHIFTS = 96
_COARSE = 56  # bits of candidates, beside those that rounding may take
_GUARD = 24  # bits that rounding may take, for m = 1


@dataclass(frozen=True)
class Judgement:
    """Whether a motion is an orbit, of first impacts, and why; None: not decided."""

    orbit: bool | None
    reason: str


# -- first impacts ---------------------------------------------------------------------------------


def judge(springs: Springs, motion: Motion) -> Judgement:
    """Decide whether the mass stays above the table on each flight."""
    for state, time in zip(motion.impacts, motion.times, strict=True):
        found = _flight(springs, springs.gap(motion.rho, state), time)
        if not found.orbit:
            return found
    return Judgement(True, "the mass stays above the table from launch to impact")


def _flight(springs: Springs, gap: Gap, time: Interval) -> Judgement:
    """Decide gap > 0 between 0 and time: gap(0) = gap(time) = 0, gap'(0) = 0 if epsilon = 0."""
    bits, start = springs.bits, springs.exact(0)
    if not springs.epsilon and gap(start, 2).sup < 0:
        return Judgement(False, "the mass sticks after an impact")
    upward = not springs.epsilon or gap(start, 1).inf > 0

    def leaves(length: Fraction) -> bool:
        part = Interval(0, length, precision=bits)
        return upward and (gap(part, 2).inf > 0 or gap(part, 1).inf > 0)

    def arrives(length: Fraction) -> bool:
        return gap(Interval(time.inf - length, time.sup, precision=bits), 1).sup < 0

    begin, end = (_shrunk(holds, time.inf / _EDGE) for holds in (leaves, arrives))
    if begin is None or end is None:
        return Judgement(None, "a launch or an impact too slow to tell")
    return _stays(springs, gap, begin, time.inf - end)


def _shrunk(holds: Callable[[Fraction], bool], length: Fraction) -> Fraction | None:
    """Return the first of length, length / 2, ... for which something holds."""
    lengths = (length / 2**n for n in range(_HALVINGS))
    return next((each for each in lengths if holds(each)), None)


def _stays(springs: Springs, gap: Gap, begin: Fraction, end: Fraction) -> Judgement:
    """Decide gap > 0 by the mean value form, on halves of halves."""
    waiting, pieces = [(begin, end)], 0
    while waiting:
        low, high = waiting.pop()
        middle, part = (low + high) / 2, Interval(low, high, precision=springs.bits)
        height = gap(springs.exact(middle), 0)
        if height.sup < 0:
            return Judgement(False, f"the table is met earlier, before time {float(middle):.4g}")
        pieces += 1
        if pieces > _PIECES:
            return Judgement(None, "the mass comes too close to the table to tell")
        if (height + gap(part, 1) * (part - middle)).inf <= 0:
            waiting += [(middle, high), (low, middle)]
    return Judgement(True, "")


# -- the limit, k = 0 ------------------------------------------------------------------------------


@cache
def _curve() -> Formulas:
    """Return R, H and (1 - R)/(1 + R) of the theorem on admissibility, claim S18."""
    return read_formulas(Reader(eq.TOUCH), Reader(eq.HEIGHT), Reader(eq.RESTITUTION))


def _at(springs: Springs, u: Interval) -> list[Interval]:
    return values(_curve(), [springs.period / 2, u])


def _falls_through(springs: Springs, of: Callable[[Interval], Interval]) -> Range:
    """Bracket the zero on (0, pi/2) of a function that falls there, and is negative up to 2.

    R - r and H are: R falls on (0, pi), and H rises from pi/2 to 2 without coming to 0.
    """
    low, high, width = Fraction(0), Fraction(2), Fraction(1, 2 ** (springs.bits - _GUARD))
    for _ in range(2 * springs.bits):
        middle = (low + high) / 2
        value = of(springs.exact(middle))
        if value.contains_zero() or high - low <= high * width:
            break
        low, high = (middle, high) if value.inf > 0 else (low, middle)
    if not low:
        raise Undecided("a touch too close to the launch to tell")
    return low, high


def least_height(springs: Springs) -> Interval:
    """Enclose the h of S18: a fixed point for k = 0 is an orbit exactly if rho sin psi > h.

    For epsilon = 0 this is 2, and rho sin psi = 2 will do.
    """
    if not springs.epsilon:
        return springs.exact(2)
    ends = _falls_through(springs, lambda u: _at(springs, u)[0] - springs.ratio)
    above, below = (_at(springs, springs.exact(u))[1] for u in ends)
    return above.hull(below)


def critical_epsilon(springs: Springs) -> Interval:
    """Enclose the epsilon_m of S18: above it the saddle-node is one of orbits."""
    ends = _falls_through(springs, lambda u: _at(springs, u)[1])
    first, last = (_at(springs, springs.exact(u))[2] for u in ends)
    return first.hull(last)


def judge_fixed(springs: Springs, motion: Motion, least: Interval | None) -> Judgement:
    """Decide whether a fixed point is an orbit, by h in the limit, by its flight otherwise."""
    if least is None:
        return judge(springs, motion)
    height = motion.rho * motion.impacts[0].psi.sin()
    if height.inf > least.sup:
        return Judgement(True, "rho sin psi > h")
    if height.sup >= least.inf:
        return Judgement(None, "rho sin psi is too close to h to tell")
    how = "the table is met earlier" if springs.epsilon else "the mass sticks"
    return Judgement(False, f"rho sin psi < h: {how}")


# -- stability -------------------------------------------------------------------------------------


def eigenvalues(springs: Springs, motion: Motion) -> tuple[Interval, Interval] | None:
    """Enclose the eigenvalues of the derivative, the greater first; None if they are not real."""
    (a, b), (c, d) = springs.derivative(motion)
    split = (a - d).sqr() + b * c * 4
    if split.sup < 0:
        return None
    if split.inf < 0:
        raise Undecided("whether the eigenvalues are real")
    root = sqrt(split)
    return (a + d + root) / 2, (a + d - root) / 2


def attracts(springs: Springs, motion: Motion) -> bool | None:
    """Whether the derivative has both eigenvalues inside the unit circle: Jury's conditions."""
    (a, b), (c, d) = springs.derivative(motion)
    trace, determinant = a + d, a * d - b * c
    margins = (1 - trace + determinant, 1 + trace + determinant, 1 - determinant)
    if all(each.inf > 0 for each in margins):
        return True
    return False if any(each.sup < 0 for each in margins) else None


# -- period 2 --------------------------------------------------------------------------------------


def double_at(springs: Springs, rho: Fraction) -> Motion | None:
    """Return the motion of period 2 at rho, the first on the curve from the flip; None if none is.

    It is looked for by bisection and secants, and proved by the signs on both sides of its shift.
    """

    spare = _GUARD + 4 * springs.m.bit_length()

    def excess(shift: Fraction, bits: int) -> Interval:
        return replace(springs, bits=bits).double(Interval(shift, precision=bits)).rho - rho

    def above(shift: Fraction) -> bool:
        return excess(shift, _COARSE + spare).mid > 0

    high = next((n * _STEP for n in range(1, _SHIFTS) if above(n * _STEP)), None)
    low = _STEP**5 if high == _STEP else (high or 0) - _STEP
    if high is None or above(low):
        return None
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if above(middle) else (middle, high)
    bits, last, now = springs.bits, low, high
    width = Fraction(1, 2 ** (bits - spare))
    while abs(now - last) > width:
        slope = (excess(now, bits).mid - excess(last, bits).mid) / (now - last)
        last, now = now, around(now - excess(now, bits).mid / slope, bits)[0]
    ends = now - width, now + width
    if excess(ends[0], bits).sup < 0 < excess(ends[1], bits).inf:
        return springs.double(Interval(*ends, precision=bits))
    raise Undecided("the orbit of period 2 at this rho")


def followed(springs: Springs) -> Iterator[tuple[Motion, Judgement]]:
    """Yield motions of period 2 from the flip on, up to the first that is no attracting orbit."""
    for n in range(1, _SHIFTS):
        motion = springs.double(springs.exact(n * _STEP))
        found = judge(springs, motion)
        yield motion, found
        if not (found.orbit and attracts(springs, motion)):
            return
