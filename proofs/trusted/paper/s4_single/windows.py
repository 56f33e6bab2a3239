"""Section 4: where stable orbits are; the lemmas are those of `orbits` and `below`."""

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
from proofs.trusted.paper.s4_single.below import LATE, MOST_NU, grazed
from proofs.trusted.paper.s4_single.orbits import (
    FLIP,
    SADDLE,
    STICK,
    bracketed,
    distance,
    excess_at,
    records,
    turn,
)

_MOST_RECORDS = 10**5
_HALF = Fraction(1, 2)
_FINE = Fraction(1, 10**9)
_LEAVING = (
    "an orbit that leaves the table at once (launch acceleration > 0), with its first impact, a "
    "transversal one, n table periods later and |f'| < 1, exists exactly"
)
Ends = tuple[Range, Range]  # enclosures of both ends of a window


# -- at fixed nu -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class EtaWindows(Conclusion):
    """Where stable short orbits are at fixed nu in [-3/10, 0) or (0, 1), for all eta >= low.

    With n eta < 1 exactly for n = 1, ..., len(ends) and eta between the two values that ends[n - 1]
    enclose. For nu > 0 the slope is -1 at the first and 0 at the second; for nu < 0 it is 1 at the
    first and 0 at the second, or that is 1/n. With n eta > 1 for nu > 0 never, for nu < 0 exactly
    for n = 1 and eta between two that `late` encloses: slope 1, and an earlier touch.
    """

    nu: Fraction
    low: Fraction
    ends: tuple[Ends, ...]
    late: Ends | None = None

    def __post_init__(self) -> None:
        if (self.late is None) is (self.nu < 0):
            raise Unproved("windows with n eta > 1 are those for nu < 0")
        windows = (*([self.late] if self.late else []), *self.ends)
        down = [end for pair in windows for end in reversed(pair)]
        if any(high - low > _FINE for low, high in down):
            raise Unproved("the ends of windows are not known to nine places")
        if any(later[1] >= end[0] for end, later in pairwise(down)):
            raise Unproved("the windows are not proved to be apart")

    @property
    def sentence(self) -> str:
        sign, start, rounded = "p < 0", "f' = -1 (flip)", "Rounded"
        before, late = "", ""
        if self.late:
            sign, start, rounded = "p > 0", "f' = 1 (saddle-node)", "The former rounded"
            before = "n and eta as follows. With n eta < 1: for "
            saddle, graze = (between(end, 15) for end in self.late)
            late = (
                f" With n eta > 1: for n = 1 and eta from {saddle} (saddle-node) to {graze}, where "
                "the flight touches the table on its way (grazing), both excluded."
            )
        comma = "," if self.late else ""
        return (
            f"For nu = {show(self.nu)} ({sign}), plastic impacts and eta >= {show(self.low)}, "
            f"{_LEAVING} for {before}n = 1, ..., {len(self.ends)}{comma} if eta is in one of as "
            f"many disjoint open intervals, one for each n, from {start} up to f' = 0 (sticking)"
            f"{self._tops}, or what of it is above {show(self.low)}.{late} {rounded} inward, by "
            f"less than 2e-8: {self._listed}."
        )

    @property
    def _listed(self) -> str:
        return "; ".join(
            f"n = {n}: ({ceil_text(max(first[1], self.low), 8)}, {floor_text(last[0], 8)})"
            for n, (first, last) in enumerate(self.ends, start=1)
        )

    @property
    def _tops(self) -> str:
        """Name the windows that end at 1/n."""
        resonant = [f"{n}" for n, (_, last) in enumerate(self.ends, start=1) if last[0] == last[1]]
        return f" (to 1/n for n = {', '.join(resonant)})" if resonant else ""

    @property
    def quantities(self) -> Mapping[str, Range]:
        names = ("below_saddle", "below_last") if self.late else ("flip", "stick")
        named = {
            f"eta_{name}_{n}": bounds
            for n, pair in enumerate(self.ends, start=1)
            for name, bounds in zip(names, pair, strict=True)
        }
        late = zip(("eta_late_saddle", "eta_late_graze"), self.late or (), strict=False)
        return named | dict(late)


def _eta_windows(reader: Reader) -> EtaWindows:
    """Prove where windows in eta are."""
    is_below = ("late", "touch") if reader.has("late") else ()
    nu_of, low_of, ends_of, *late_of = reader.fields("nu", "low", "ends", *is_below)
    nu, least = nu_of.number(), low_of.number()
    if not (-MOST_NU <= nu < 1 and nu != 0 and 0 < least < 1):
        raise Unproved("-3/10 <= nu < 0 or 0 < nu < 1, and 0 < low < 1 are expected")
    ends = []
    for n, entry in enumerate(ends_of.items(1, 1000), start=1):
        ends.append(_window(nu, n, entry))
        if ends[-1][1][0] <= least:
            raise entry.fail("a window that is not proved to reach beyond the least eta")
    if not _is_last(nu, least, len(ends)):
        raise Unproved(f"windows for n = {len(ends) + 1} are not excluded")
    late = None
    if late_of:
        low, high, *graze = late_of[0].numbers(4, 4)
        saddle = _end_in_eta(nu, 1, SADDLE, (low, high), LATE)
        late = saddle, grazed(nu, (graze[0], graze[1]), late_of[1].number())
    return EtaWindows(nu, least, tuple(ends), late)


def _window(nu: Fraction, n: int, entry: Reader) -> Ends:
    """Return the ends of a window with n eta < 1, by lemma 5 or 6."""
    numbers, middle = entry.numbers(2, 4), _HALF / n
    start, room = (FLIP, (Fraction(0), middle)) if nu > 0 else (SADDLE, (middle, 2 * middle))
    first = _end_in_eta(nu, n, start, (numbers[0], numbers[1]), room)
    if len(numbers) == 4:
        if not _ends_stuck(nu, n):
            raise entry.fail("a window that is not proved to end where the mass sticks")
        return first, _end_in_eta(nu, n, STICK, (numbers[2], numbers[3]), room)
    if len(numbers) == 3 or nu > 0 or (1 - nu) * first[0] ** 2 < -nu:
        raise entry.fail("a window that is not proved to end at 1/n")
    return first, (room[1], room[1])


def _ends_stuck(nu: Fraction, n: int) -> bool:
    return nu > 0 or 1 - nu <= n * n * -nu


def _end_in_eta(nu: Fraction, n: int, end: int, bracket: Range, room: Range) -> Range:
    """Require that excess passes 0 in a bracket inside an interval: up for nu > 0, else down."""
    low, high = bracket
    if not room[0] < low < high < room[1]:
        raise Unproved("a bracket of an end is not where its lemma looks")
    below, above = (low, high) if nu > 0 else (high, low)
    bracketed(n, end, (below, nu), (above, nu))
    return bracket


def _is_last(nu: Fraction, least: Fraction, n: int) -> bool:
    """Whether there are no windows with n eta < 1 for greater n, by lemma 5 or 6."""
    turns, beyond = (n + 1) * least, excess_at(least, nu, n + 1, STICK)
    if nu > 0:
        return turns >= _HALF or beyond.lo > 0
    return turns >= 1 or (turns > _HALF and _ends_stuck(nu, n + 1) and beyond.hi < 0)


# -- at fixed eta ----------------------------------------------------------------------------------


Window = tuple[int, Range, Range]  # n, and enclosures of both ends


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
            f"For eta = {show(self.eta)}, plastic impacts and 0 < |nu| < 1, {_LEAVING} with n and "
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


def _nu_windows(reader: Reader) -> NuWindows:
    """Prove where windows in nu are."""
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


# -- the rule --------------------------------------------------------------------------------------


def single_windows(_: Context, reader: Reader) -> EtaWindows | NuWindows:
    """Rule `single-windows`: {nu, low, ends}, for nu < 0 {nu, low, ends, late, touch}, or for
    windows in nu {eta, above, below, early}.

    At fixed nu: ends: [[first lo, hi, stick lo, hi], or for nu < 0 [first lo, hi]] for n = 1, 2,
    ..., first being the flip for nu > 0, else the saddle-node. Hypotheses: 0 < low < 1; 0 < nu < 1
    or -3/10 <= nu < 0; brackets lie in (0, 1/(2 n)), for nu < 0 in (1/(2 n), 1/n); excess at M = -1
    (flip), M = 0 (stick) is < 0 at the lower end and > 0 at the upper one, for nu < 0 that at M = 1
    (saddle-node) and M = 0 the other way round; windows reach beyond low. For the n after the last:
    n low >= 1/2, or excess > 0 at M = 0, eta = low; for nu < 0: n low >= 1, or n low > 1/2,
    1 + |nu| <= n^2 |nu| and excess < 0 at M = 0, eta = low. For nu < 0 a window that sticks has
    1 + |nu| <= n^2 |nu|, another (1 + |nu|) eta^2 >= |nu| at its saddle-node; late: [saddle lo, hi,
    graze lo, hi] in (3/2, 2); touch: a time in J; D + (5/2) D'^2 < 0 there at graze lo, so that
    D < 0 on J, as D'' < -1/5; D > 0 there at graze hi. Conclusion: `EtaWindows`. Proof. Lemmas 1 to
    4 of `single-solution`, 5 there for nu > 0, 6 to 8 of `below` for nu < 0.

    At fixed eta: `above`: [[from, to]] for n = 1, 2, ... < 1/(2 eta), `below`: for the records n <
    1/eta, both 0 < eta < 1; a bracket for |nu| has excess > 0 at its lower and < 0 at its upper
    end; null: excess > 0 at nu = 1. `early`: for the records n > 1/eta a time in (0, 2 pi n) at
    which the mass is above the table if p = -e. Conclusion: `NuWindows`; ends (1, 1) mean that
    there is no window. Proof. Lemmas 1 to 4 of `single-solution`; after the denominator of eta
    there are no records.
    """
    return _nu_windows(reader) if reader.has("eta") else _eta_windows(reader)
