"""The first zero of a gap after launch, for all flights of a box at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple, Protocol

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.gaps import clears
from proofs.trusted.numbers import Range, between, show

_SMALL = 4  # halvings
_MOST_WINDOWS, _SHARP = 16, 6


class Launches(Protocol):
    """All flights from a box of states: what is asked of them."""

    @property
    def states(self) -> Sequence[Enclosure]:
        """The box."""

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose formulas at times."""


class NoFirstZero(Unproved):
    """The gap is > 0 up to the latest time."""


class Gap(NamedTuple):
    """A gap on the tape: its derivatives by the time, and the order of the first not 0 at launch.

    order: 0 for a gap that is not 0 at launch. launch: that derivative there, of the state alone.
    is_constant: whether the gap is the same at all times.
    """

    orders: tuple[int, ...]
    order: int
    launch: int
    is_constant: bool


class Step(NamedTuple):
    """Times low < high, in units: the gap is > 0 on (0, high]; else, `end` being what it is at
    `high`, on (0, low], and falls between.
    """

    low: int
    high: int
    end: Enclosure | None


@dataclass
class FirstZero:
    """Goes through the times after launch; they are integers in units of 2^-bits.

    Invariant: the gap is > 0 on (0, low]. A step to `high` keeps it by one of these.
    1. The derivative of its order has been > 0 from 0 to `high`, as in `_leaves`, the lower ones
       being 0 at launch.
    2. gap > 0 at both ends, so much that gap'' cannot bring it to 0 (`clears`).
    3. gap_t < 0 from a time at which gap > 0 on, up to one at which gap < 0: there the gap has its
       first zero, by Bolzano's theorem, and only one.

    taken: the steps of a search before, which are likely to do again; then of this one.
    """

    launches: Launches
    gap: Gap
    taken: list[int] = field(default_factory=list)
    _heights: dict[int, Enclosure] = field(default_factory=dict)
    _reach: int = 0
    _bend: Enclosure | None = None  # gap'' up to the time `_reach`

    def __post_init__(self) -> None:
        self.bits = self.launches.states[0].bits
        self._first, self._shortest = 1 << self.bits >> 2, 1 << self.bits // 2

    def window(self, latest: Fraction) -> Range:
        """Return times low < high, gap > 0 on (0, low], gap_t < 0 between, gap(high) < 0."""
        end = None
        for low, high, end in self._steps(Enclosure.of(latest, latest, self.bits).hi):
            if end is not None and end.hi < 0:
                return Enclosure(low, high, self.bits).range
        raise self._none_before(latest, end is None)

    def _none_before(self, latest: Fraction, is_up: bool) -> Unproved:
        kind = NoFirstZero if is_up else Unproved
        return kind(f"no impact is proved before the time {show(latest)}, {self._place}")

    def windows(self, latest: Fraction) -> Iterator[Range]:
        """Yield times low < high: gap > 0 before and between them, and < 0 at the end of the last.

        So the first zero of each flight is in one of them, be it a graze. They are no sharper than
        a part of the widths of the states.
        """
        widths = (x.hi - x.lo for x in self.launches.states)
        self._shortest = max(self._shortest, min(self._first, max(widths) >> _SHARP))
        high, end = 0, Enclosure.of(latest, latest, self.bits).hi
        for _ in range(_MOST_WINDOWS):
            low = self._up(high, end)
            before, high = high, self._decided(low, end)
            if high > end:
                raise self._none_before(latest, not before and low == end)
            yield Enclosure(low, high, self.bits).range
            if self._at(high).hi < 0:
                return
        raise Unproved(f"an impact is possible in more than {_MOST_WINDOWS} windows, {self._place}")

    def _up(self, low: int, end: int) -> int:
        """Return a time up to which the gap is proved > 0, as it is up to `low`."""
        try:
            for step in self._steps(end, low, is_past=False):
                low = step.high
        except Unproved:
            if not low:
                raise
        return low

    def _decided(self, low: int, end: int) -> int:
        """Return a time after `low` at which the gap has one sign, or one after the end."""
        step = self._shortest
        while low + step <= end and self._at(low + step).has_zero:
            step *= 2
        return low + step

    def require_none(self, until: Fraction) -> None:
        """Raise Unproved unless the gap is proved > 0 up to a time."""
        end = Enclosure.of(until, until, self.bits).hi
        for step in self._steps(min(end, self._first) if self.gap.is_constant else end):
            if step.end is not None:
                time = round(until, 6)
                raise Unproved(
                    f"a gap is not proved > 0 up to the time {show(time)}, {self._place}"
                )

    def _steps(self, end: int, low: int = 0, is_past: bool = True) -> Iterator[Step]:
        """Step from `low` to the end; is_past: also where the gap falls and is not > 0 any more."""
        step, leaving = self._first, self.gap.order > 0 and not low
        least, falling, is_new = self._at(low).lo, None, True
        known, self.taken = self.taken, []
        if not leaving and least <= 0:
            raise Unproved(f"a gap is not proved > 0 at launch, {self._place}")
        while low < end:
            high = min(low + step, end)
            try:
                after = self._at(high)
                leaves = leaving and self._leaves(low, high)
                stays = leaves or (falling is None and self._stays(low, high, min(least, after.lo)))
                may_fall = not stays and low > 0 and (is_past or after.lo > 0)
                falls = may_fall and self._falls(low, high)
            except Unproved:  # a formula is not proved defined for so long a time
                leaves = stays = falls = False
            if not (stays or falls):
                if step < self._shortest:
                    raise Unproved(f"{self._reason(low)}, {self._place}")
                step >>= 1
                continue
            if falls and falling is None and is_new and after.lo <= 0 <= after.hi:
                step, is_new = step * 3 >> 2, False  # `high` is next to the impact: not the best
                continue
            falling = None if stays or after.lo > 0 else low if falling is None else falling
            self.taken.append(high)
            yield Step(low, high, None) if falling is None else Step(falling, high, after)
            low, least, leaving, is_new = high, after.lo, leaves, True
            step = (
                2 * step if leaving or falling is not None else self._likely(low, 2 * step, least)
            )
            step = next((time - low for time in known if time > low), step)

    def _leaves(self, low: int, high: int) -> bool:
        """Whether the derivative of the gap's order is > 0 until `high`, where it is on (0, low].

        Between them it is > 0; or the next one is, and it is >= 0 at launch if that is `low`.
        """
        order = self.gap.order
        if self._of(low, high, order).lo > 0:
            return True
        return self._of(low, high, order + 1).lo > 0 and (low > 0 or self._launch.lo >= 0)

    def _falls(self, low: int, high: int) -> bool:
        """Whether gap_t < 0 between two times: directly, or by gap_t at the first one and gap''."""
        if self._of(low, high, 1).hi < 0:
            return True
        first = self._of(low, low, 1).hi
        return first < 0 and first + (self._of(low, high, 2).hi * (high - low) >> self.bits) < -1

    def _stays(self, low: int, high: int, least: int) -> bool:
        """Whether the gap, `least` or more at both times, is > 0 between them."""
        if least <= 0:
            return False
        bend, width, unit = self._known_bend(high), high - low, 1 << self.bits
        if bend is not None and clears(least, bend.hi, width, unit):
            return True
        return clears(least, self._of(low, high, 2).hi, width, unit)

    def _likely(self, low: int, step: int, least: int) -> int:
        """Return a step for which a gap of so much is likely to do: by gap'' at all times that are
        known, or, where that allows a small part only, by what it is on the step.
        """
        bend = self._known_bend(0)
        likely = step if bend is None else self._allowed(step, least, bend)
        if likely > step >> _SMALL:
            return likely
        try:
            return self._allowed(step, least, self._of(low, low + step, 2))
        except Unproved:  # it is not proved defined so long
            return likely

    def _allowed(self, step: int, least: int, bend: Enclosure) -> int:
        """Halve a step until gap'' allows it."""
        while step > self._shortest and not clears(2 * least, bend.hi, step, 1 << self.bits):
            step >>= 1
        return step

    def _known_bend(self, high: int) -> Enclosure | None:
        """Enclose gap'' up to a time, and some more; None where it is not proved defined."""
        if self._reach < high or not self._reach:
            self._reach = 2 * high + (8 << self.bits)
            try:
                self._bend = self._of(0, self._reach, 2)
            except Unproved:
                self._bend = None
        return self._bend

    def _reason(self, low: int) -> str:
        """Say why no step after a time is proved."""
        if low:
            time = round(Fraction(low, 1 << self.bits), 6)
            return f"a graze is not excluded at the time {show(time)}"
        if self.gap.order and self._of(0, 0, self.gap.order).hi < 0:
            return "the gap is < 0 right after launch: such a state does not leave the wall"
        return "it is not proved that the gap is > 0 right after launch"

    @property
    def _launch(self) -> Enclosure:
        return self.launches.on((self.gap.launch,), Enclosure(0, 0, self.bits))[0]

    def _of(self, low: int, high: int, order: int) -> Enclosure:
        t = Enclosure(low, high, self.bits)
        return self.launches.on(self.gap.orders[order : order + 1], t)[0]

    def _at(self, time: int) -> Enclosure:
        if time not in self._heights:
            self._heights[time] = self._of(time, time, 0)
        return self._heights[time]

    @property
    def _place(self) -> str:
        return shown(self.launches.states)


def shown(x: Sequence[Enclosure]) -> str:
    """Write a box for a message, its ends rounded outward."""
    return f"for states in {' x '.join(between(each.range) for each in x)}"
