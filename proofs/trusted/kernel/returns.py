"""Maps of first impacts: to what is when a gap is 0 for the first time, of any motion.

A state starts a flight; gaps are functions of the state, the time and perhaps parameters. The map
takes the state to some values, functions of the same, at the first t > 0 at which the first gap is
0, and it is defined where all gaps are > 0 in between, and the others at the impact too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import Protocol, Self

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Box, Circle, Matrix, add, enclosed
from proofs.trusted.kernel.firstzero import FirstZero, Gap, shown
from proofs.trusted.kernel.gaps import fall
from proofs.trusted.numbers import Range

LATEST = Fraction(1024)
_ENOUGH = 1024  # moves by a smaller part of the width do not pay
_HALVINGS = 4  # of a window, to prove that the gap falls
_COARSE = 64  # bits, in which a window is looked for first
_REMEMBERED, _AROUND = 256, 16  # impacts; of these, the last, in whose boxes others are looked for


class Launched(Protocol):
    """Functions of the time, for all of some states and parameters."""

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose some of them, by their numbers, at times."""


class Timed(Protocol):
    """Functions of the state, the time and the parameters, in this order; each has a number.

    roots: first the gaps, then the values. ranges: of the parameters.
    """

    @property
    def name(self) -> str: ...
    @property
    def variables(self) -> tuple[str, ...]: ...
    @property
    def roots(self) -> tuple[int, ...]: ...
    @property
    def ranges(self) -> Box: ...
    @property
    def circles(self) -> tuple[Circle, ...]: ...
    def periods(self, bits: int) -> dict[int, Enclosure]: ...
    def pinned(self) -> Self:
        """Return them at the middle of the ranges."""

    def derivative(self, root: int, place: int) -> int:
        """Return the number of a partial derivative."""

    def launched(self, states: Sequence[Enclosure], parameters: Sequence[Enclosure]) -> Launched:
        """Return them for all of these states and parameters."""


@dataclass(frozen=True, eq=False)
class ReturnMap:
    """The map of first impacts: the gaps, then the values, as functions of the state and the time.

    state: how many variables are its own. latest: until when impacts are looked for.
    """

    formulas: Timed
    state: int
    gaps: tuple[Gap, ...]
    latest: Fraction = field(default=LATEST, kw_only=True)
    _known: dict[tuple[int, ...], tuple[Sequence[Enclosure], Enclosure]] = field(
        default_factory=dict, init=False, repr=False
    )  # boxes, with the times of the impacts
    _last: dict[tuple[int, ...], Impact] = field(default_factory=dict, init=False, repr=False)
    _taken: dict[int, list[int]] = field(
        default_factory=dict, init=False, repr=False
    )  # steps of the last search, by bits

    @property
    def name(self) -> str:
        """The map's."""
        return self.formulas.name

    @property
    def variables(self) -> tuple[str, ...]:
        """The state."""
        return self.formulas.variables[: self.state]

    @property
    def size(self) -> int:
        """The number of values."""
        return len(self.outcome)

    @property
    def circles(self) -> tuple[Circle, ...]:
        """The angles among the state."""
        return self.formulas.circles

    def periods(self, bits: int) -> dict[int, Enclosure]:
        """Enclose the periods of the angles."""
        return self.formulas.periods(bits)

    @property
    def outcome(self) -> tuple[int, ...]:
        """The values, on the tape."""
        return self.formulas.roots[len(self.gaps) :]

    @property
    def definition(self) -> str:
        """Say what it is."""
        raise NotImplementedError

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box of states."""
        impact = self._impact(x)
        return impact.launches.on(self.outcome, impact.time)

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative in the state."""
        return self._derivative(self._impact(x), range(self.state))

    @property
    def ranges(self) -> Box:
        """Those of the parameters."""
        return self.formulas.ranges

    def pinned(self) -> ReturnMap:
        """Return the map at the middle of the ranges."""
        return ReturnMap(self.formulas.pinned(), self.state, self.gaps, latest=self.latest)

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative by the parameters."""
        places = range(self.state, self.state + len(self.ranges))
        return self._derivative(self._impact(x), places)

    def mean_value_form(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values by those in the middle of the states and of the parameters.

        F(x, p) is in F(m, q) + F_x (x - m) + F_p (p - q), by the mean value theorem.
        """
        impact = self._impact(x)
        launches = impact.launches
        time = impact.time
        enough = (time.hi - time.lo) >> 16
        middle = Impact.sharp(launches.middle, time.range, enough)
        values = middle.launches.on(self.outcome, middle.time)
        rows = self._derivative(impact, launches.wide)
        return [add(v, row, launches.steps) for v, row in zip(values, rows, strict=True)]

    def _derivative(self, impact: Impact, places: Sequence[int]) -> Matrix:
        """Enclose F_x - F_t gap_x / gap_t for some inputs x (implicit function theorem: gap_t < 0).

        places: of these among the state and the parameters.
        """
        roots, n = (self.gaps[0].orders[0], *self.outcome), len(places) + 1
        wanted = [root for each in roots for root in self.slopes(each, places)]
        entries = impact.launches.on((*wanted, *roots), impact.time)
        (*gap, fall), *rows = (entries[i * n : (i + 1) * n] for i in range(len(roots)))
        return [[a - row[-1] * g / fall for a, g in zip(row, gap, strict=False)] for row in rows]

    def slopes(self, root: int, places: Sequence[int]) -> list[int]:
        """Return the derivatives of a root in some of the state and the parameters, and in time."""
        on_tape = [k if k < self.state else k + 1 for k in places]  # the time is between them
        return [self.formulas.derivative(root, k) for k in (*on_tape, self.state)]

    def possible_values(self, x: Sequence[Enclosure]) -> Iterator[list[Enclosure]]:
        """Enclose the values after each of the times at which the first impact may be."""
        launches = self._launches(x)
        for low, high in FirstZero(launches, self.gaps[0]).windows(self.latest):
            self._require_others(launches, high)
            yield launches.on(self.outcome, Enclosure.of(low, high, x[0].bits))

    def impact(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the time of the impact, for all states in a box: see `FirstZero`."""
        return self._impact(x).time

    def _launches(self, x: Sequence[Enclosure]) -> Launches:
        return Launches(self, list(x), enclosed(self.formulas.ranges, x[0].bits))

    def _impact(self, x: Sequence[Enclosure]) -> Impact:
        key = (x[0].bits, *(end for side in x for end in (side.lo, side.hi)))
        if key not in self._last:
            launches = self._launches(x)
            if key not in self._known:
                time = Impact.sharp(launches, self._window(launches)).time
                if len(self._known) == _REMEMBERED:
                    del self._known[next(iter(self._known))]
                self._known[key] = launches.states, time
            self._last.clear()
            self._last[key] = Impact(launches, self._known[key][1])
        return self._last[key]

    def _window(self, launches: Launches) -> Range:
        """Return times between which the first zeros are; of a box inside another one its times."""
        for states, time in islice(reversed(self._known.values()), _AROUND):
            if _within(launches.states, states):
                return time.range
        try:
            return self._searched(launches.coarse)
        except Unproved:
            if launches.coarse is launches:
                raise
            return self._searched(launches)

    def _searched(self, launches: Launches) -> Range:
        search = FirstZero(launches, self.gaps[0], self._taken.get(launches.states[0].bits, []))
        window = search.window(self.latest)
        if len(self.gaps) > 1:  # other walls may be reached soon after this one
            window = Impact.sharp(launches, window).time.range
        self._require_others(launches, window[1])
        self._taken[search.bits] = search.taken
        return window

    def _require_others(self, launches: Launches, until: Fraction) -> None:
        """Raise Unproved unless the other gaps are proved > 0 up to a time."""
        for gap in self.gaps[1:]:
            FirstZero(launches, gap).require_none(until)


@dataclass
class Launches:
    """All flights from a box of states, for all parameters of a box."""

    flight: ReturnMap
    states: Sequence[Enclosure]
    parameters: Sequence[Enclosure]

    def __post_init__(self) -> None:
        self._functions = self.flight.formulas.launched(self.states, self.parameters)

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose functions at times."""
        return self._functions.on(roots, t)

    def gap_of(self, time: Range, order: int) -> Enclosure:
        """Enclose the first gap, or a derivative of it, on an interval of times."""
        t = Enclosure.of(*time, self.states[0].bits)
        return self.on(self.flight.gaps[0].orders[order : order + 1], t)[0]

    @cached_property
    def coarse(self) -> Launches:
        """These flights and some around, in few bits."""
        if self.states[0].bits <= _COARSE:
            return self
        sides = (
            [Enclosure.of(*x.range, _COARSE) for x in xs] for xs in (self.states, self.parameters)
        )
        return Launches(self.flight, *sides)

    @cached_property
    def _inputs(self) -> list[Enclosure]:
        return [*self.states, *self.parameters]

    @cached_property
    def wide(self) -> list[int]:
        """The places of those states and parameters that are no points."""
        return [k for k, side in enumerate(self._inputs) if side.hi - side.lo > 1]

    @cached_property
    def middle(self) -> Launches:
        """The flight in the middle of these sides."""
        middle = list(self._inputs)
        for k in self.wide:
            m = (middle[k].lo + middle[k].hi) >> 1
            middle[k] = Enclosure(m, m, middle[k].bits)
        n = self.flight.state
        return Launches(self.flight, middle[:n], middle[n:])

    @cached_property
    def pinned(self) -> Launches:
        """The flights from all states, in the middle of the parameters."""
        return Launches(self.flight, self.states, self.middle.parameters)

    @cached_property
    def steps(self) -> list[Enclosure]:
        """How far these sides reach from there."""
        return [self._inputs[k] - self.middle._inputs[k] for k in self.wide]


@dataclass
class Impact:
    """When all flights from a box end."""

    launches: Launches
    time: Enclosure

    @cached_property
    def fall(self) -> Enclosure:
        """Enclose gap_t then."""
        return fall(self.launches.gap_of, self.time.range)

    @classmethod
    def sharp(cls, launches: Launches, window: Range, enough: int = 0) -> Impact:
        """Enclose the only zero of the gap in a window where gap_t < 0, by Newton's operator.

        From the middle of what is known; for a box from both ends, plainly and then by the mean
        value form; while that gains a part of it, and more than `enough` is left.
        """
        t, is_box = Enclosure.of(*window, launches.states[0].bits), bool(launches.wide)
        for is_plain in (True, False)[: 1 + is_box]:
            width = 2 * (t.hi - t.lo)
            while t.hi - t.lo > enough and _ENOUGH * (width - t.hi + t.lo) > width:
                width, middle = t.hi - t.lo, (t.lo + t.hi) >> 1
                t = _newton(launches, t, is_plain, *((t.lo, t.hi) if is_box else (middle,)))
        return cls(launches, t)


def _newton(launches: Launches, t: Enclosure, is_plain: bool, *starts: int) -> Enclosure:
    """Return what Newton's operator leaves of times, from some of them.

    For x in X, s the start: gap(x, t) = 0 = gap(x, s) + gap_t (t - s), gap_t on X x T. gap(x, s) is
    enclosed directly, and by gap(m, s) + gap_x (x - m), m the middle of states and parameters, or
    of parameters alone (mean value theorem).
    """
    gap, rate = launches.flight.gaps[0], launches.on(launches.flight.gaps[0].orders[1:2], t)[0]
    if rate.hi >= 0 and (rate := fall(launches.gap_of, t.range, _HALVINGS)).hi >= 0:
        raise Unproved(f"the impact is not proved transversal, {shown(launches.states)}")
    slopes = launches.flight.slopes(gap.orders[0], launches.wide)[:-1]
    count = sum(k < launches.flight.state for k in launches.wide)  # of the states
    for start in starts:
        s = Enclosure(start, start, t.bits)
        if is_plain:
            (value,) = launches.on(gap.orders[:1], s)
        else:
            (value,) = launches.middle.on(gap.orders[:1], s)
            height, *row = launches.on((gap.orders[0], *slopes), s)
            value = height.meet(add(value, row, launches.steps))
            if 0 < count < len(row):
                (height,) = launches.pinned.on(gap.orders[:1], s)
                value = value.meet(add(height, row[count:], launches.steps[count:]))
        t = t.meet(s - value / rate)
    return t


def _within(x: Sequence[Enclosure], box: Sequence[Enclosure]) -> bool:
    """Whether a box of at least as many bits lies in another one."""
    more = x[0].bits - box[0].bits
    return more >= 0 and all(
        b.lo << more <= a.lo and a.hi <= b.hi << more for a, b in zip(x, box, strict=True)
    )
