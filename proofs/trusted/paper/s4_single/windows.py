"""Section 4: where stable orbits are; the lemmas are those of `orbits`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import COVER_BITS, Range, between, ceil_text, floor_text, show
from proofs.trusted.paper.s4_single.orbits import (
    FLIP,
    SADDLE,
    STICK,
    bits_of,
    distance,
    excess,
    records,
    turn,
)

_MOST_RECORDS = 10**5
_HALF = Fraction(1, 2)
FINE = Fraction(1, 10**9)
LEAVING = (
    "an orbit that leaves the table at once (launch acceleration > 0), with its first impact, a "
    "transversal one, n table periods later and |f'| < 1, exists exactly"
)


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


def require_apart(down: Sequence[Range]) -> None:
    """Raise Unproved unless the ends of windows, the greatest first, are narrow and apart."""
    if any(high - low > FINE for low, high in down):
        raise Unproved("the ends of windows are not known to nine places")
    if any(later[1] >= end[0] for end, later in pairwise(down)):
        raise Unproved("the windows are not proved to be apart")


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
        require_apart([end for flip, stick in self.ends for end in (stick, flip)])

    @property
    def sentence(self) -> str:
        listed = "; ".join(
            f"n = {n}: ({ceil_text(max(flip[1], self.low), 8)}, {floor_text(stick[0], 8)})"
            for n, (flip, stick) in enumerate(self.ends, start=1)
        )
        return (
            f"For nu = {show(self.nu)} (p < 0), plastic impacts and eta >= {show(self.low)}, "
            f"{LEAVING} for n = 1, ..., {len(self.ends)} if eta is in one of as many disjoint "
            "open intervals, one for each n, from f' = -1 (flip) up to f' = 0 (sticking), or what "
            f"of it is above {show(self.low)}. Rounded inward, by less than 2e-8: {listed}."
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
        return {
            f"eta_{name}_{n}": bounds
            for n, pair in enumerate(self.ends, start=1)
            for name, bounds in zip(("flip", "stick"), pair, strict=True)
        }


def eta_windows(context: Context, reader: Reader) -> EtaWindows:
    """Rule `single-eta-windows`: {nu, low, ends: [[flip lo, hi, stick lo, hi]] for n = 1, 2, ...}.

    Hypotheses: 0 < nu < 1; all brackets lie in (0, 1/(2 n)); excess at M = -1 (flip) and M = 0
    (stick) is < 0 at the lower end and > 0 at the upper one; stick lo > low; for the n after the
    last, low n >= 1/2, or excess > 0 at M = 0 and eta = low < 1. Conclusion: `EtaWindows`. Proof.
    Lemmas 1, 2, 3 and 5 of `single-solution`.
    """
    nu_of, low_of, ends_of = reader.fields("nu", "low", "ends")
    nu, least = nu_of.number(), low_of.number()
    if not (0 < nu < 1 and 0 < least < 1):
        raise Unproved("nu and the least eta must lie between 0 and 1")
    ends = []
    for n, entry in enumerate(ends_of.items(1, 1000), start=1):
        flip_low, flip_high, stick_low, stick_high = entry.numbers(4, 4)
        flip, stick = (flip_low, flip_high), (stick_low, stick_high)
        for end, (low, high) in ((FLIP, flip), (STICK, stick)):
            if not 0 < low < high < _HALF / n:
                raise entry.fail("a bracket in (0, 1/(2 n)) is expected")
            bracketed(n, end, (low, nu), (high, nu))
        if stick_low <= least:
            raise entry.fail("a window that is not proved to reach beyond the least eta")
        ends.append((flip, stick))
    after = len(ends) + 1
    if after * least < _HALF and excess_at(least, nu, after, STICK).lo <= 0:
        raise Unproved(f"windows for n = {after} are not excluded")
    return EtaWindows(nu, least, tuple(ends))


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
        if any(first[1] >= last[0] for _, first, last in (*self.above, *self.below)):
            raise Unproved("a window is not proved to have a length")

    @property
    def sentence(self) -> str:
        above, below = (
            "; ".join(
                f"n = {n}, |nu| from {between(first, 15)} to {between(last, 15)}"
                for n, first, last in windows
            )
            or "none"
            for windows in (self.above, self.below)
        )
        return (
            f"For eta = {show(self.eta)}, plastic impacts and 0 < |nu| < 1, {LEAVING} with n and "
            f"|nu| in one of these open intervals. For nu > 0 (p < 0), from f' = 0 (sticking) to "
            f"f' = -1 (flip), or to 1: {above}. For nu < 0 (p > 0), from f' = 1 (saddle-node) to "
            f"f' = 0 (sticking), or to 1: {below}."
        )

    @property
    def quantities(self) -> Mapping[str, Range]:
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
    (0, 2 pi n) at which the mass is above the table if p = -e. Conclusion: `NuWindows`; ends (1, 1)
    mean that there is no window. Proof. Lemmas 1 to 4 of `single-solution`; after the denominator
    of eta there are no records.
    """
    eta_of, above_of, below_of, early_of = reader.fields("eta", "above", "below", "early")
    eta = eta_of.number()
    if not 0 < eta < 1 or eta.denominator > _MOST_RECORDS:
        raise eta_of.fail(f"0 < eta < 1 and a denominator up to {_MOST_RECORDS} are expected")
    METER.get().spend(4 * eta.denominator)
    found = list(records(eta, eta.denominator))
    later = tuple(n for n in found if n * eta > 1)
    above = _windows(eta, range(1, (_HALF / eta).__ceil__()), (STICK, FLIP), above_of)
    below = _windows(eta, [n for n in found if n * eta < 1], (SADDLE, STICK), below_of)
    for n, time in zip(later, early_of.items(len(later), len(later)), strict=True):
        _excluded(eta, n, time.number())
    return NuWindows(eta, above, below, later)


def _windows(
    eta: Fraction, periods: Sequence[int], ends: tuple[int, int], reader: Reader
) -> tuple[Window, ...]:
    windows = []
    for n, entry in zip(periods, reader.items(len(periods), len(periods)), strict=True):
        first, last = (
            _end_in_nu(eta, n, end, bracket)
            for end, bracket in zip(ends, entry.items(2, 2), strict=True)
        )
        if first[0] < 1:
            windows.append((n, first, last))
    return tuple(windows)


def _end_in_nu(eta: Fraction, n: int, end: int, reader: Reader) -> Range:
    """Enclose the |nu| of a solution with M = end; (1, 1) for null if it is 1 or more."""
    if reader.is_null():
        if excess_at(eta, Fraction(1), n, end).lo <= 0:
            raise Unproved("an end of a window is not proved to be at |nu| >= 1")
        return Fraction(1), Fraction(1)
    low, high = reader.range()
    if low <= 0 or high > 1:
        raise reader.fail("a bracket in (0, 1] is expected")
    bracketed(n, end, (eta, high), (eta, low))
    return low, high


def _excluded(eta: Fraction, n: int, time: Fraction) -> None:
    """Require gap < 0 at the time for nu < 0 and p = -(eta tan x)^2."""
    bits = 4 * COVER_BITS
    around, own = turn(eta, n, bits), rational(eta, bits)
    tangent = around[0] / around[1] * own
    now = clock(own, rational(time, bits))
    above: Enclosure = distance(own, around, now, -(tangent * tangent))
    if not (0 < time < (pi(bits) * (2 * n)).range[0] and above.lo > 0):
        raise Unproved(f"an earlier impact is not proved for n = {n}")
