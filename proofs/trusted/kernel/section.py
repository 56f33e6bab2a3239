"""From a start to a section: where solutions fall through it for the k-th time, and when.

A gap falls through 0 at a time if it is 0 then, and > 0 just before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from functools import reduce
from typing import NamedTuple

from proofs.trusted.kernel.arithmetic import Enclosure, Futile, Unproved, rational
from proofs.trusted.kernel.enclose import Matrix, multiply
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.lohner import Point, Set, Solutions, Step, middle_of, unit
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.numbers import between, floor_text

_EIGHTHS = (64, 70, 76, 83, 91, 99, 108, 117)  # 2^(j/8), about, in 64ths
_FIRST, _SHORTEST, _LONGEST = -32, -192, 64  # lengths of steps, 2^(n/8)
_SHORTER, _HALF, _LESS = -4, -8, -1  # changes of n
_FINE, _UNITS = 12, 256  # the rest of a step is about 2^-12 of the set, and so many units
LATEST = 1024  # a time beyond which solutions are not followed
_MOST_STEPS = 10_000
_NEWTON = 20
_NOT_REACHED = f"the end is not reached in {_MOST_STEPS} steps and the time {LATEST}"


class Fate(Enum):
    """What a gap does in a step.

    FALLING: all solutions are > 0 at first, and fall, some of them through 0, or maybe none.
    """

    PASSES, FALLING, FELL, OPEN = range(4)


class Gap(NamedTuple):
    """A gap and its rate along solutions, as formulas; is_left: it is 0 at every start."""

    formulas: Formulas
    is_left: bool

    def at(self, z: Point) -> tuple[Enclosure, Enclosure]:
        """Enclose the gap and its rate."""
        gap, rate = self.formulas.values(z)
        return gap, rate


class Section(NamedTuple):
    """The fall of that number of a gap through 0; velocity: formulas of the field.

    walls: gaps that are > 0 at all times between the start and the fall, this one perhaps among
    them; the others at the fall as well.
    """

    gap: Gap
    velocity: Formulas
    number: int
    walls: tuple[Gap, ...] = ()


class Arrival(NamedTuple):
    """All variables at the section, with their derivatives by w; those of the solution for q = 0.

    middle: none, of some of the solutions, if that one is not among them.
    """

    all: Point
    derivative: Matrix
    middle: list[Point]


@dataclass
class Journey:
    """Solutions on their way to a section.

    falls: how often they have been through it. falling: the last steps, with the times at which
    they begin, in which the gap falls from > 0 for all solutions, not yet to < 0 for all.
    """

    solutions: Solutions
    section: Section
    now: Set
    time: Fraction = Fraction(0)
    falls: int = 0
    falling: list[tuple[Fraction, Step]] = field(default_factory=list)

    def arrive(self) -> Arrival:
        """Go on to the section, and enclose what is there."""
        length = _FIRST
        try:
            for _ in range(_MOST_STEPS):
                step, change = self._step(length)
                fate = Fate.OPEN if step is None else self.watch(step)
                if step and not all(self._stays(wall, step, fate) for wall in self.section.walls):
                    fate = Fate.OPEN
                if step and fate is not Fate.OPEN:
                    self._move(step, fate)
                    if self.falls == self.section.number:
                        return self._arrival()
                    step = None  # what is left is one that decides nothing
                length = min(length + (change if step is None else _HALF), _LONGEST)
                if length < _SHORTEST:
                    raise self._stopped(self._reason(step))
        except Exhausted as error:
            raise Exhausted(f"{error}; {self._place()}") from None
        raise self._stopped(_NOT_REACHED)

    def _step(self, length: int) -> tuple[Step | None, int]:
        """Return a step of the length 2^(n/8), if it is proved, and by how much n should change."""
        bits, h = self.solutions.bits, _EIGHTHS[length % 8] * Fraction(2) ** (length // 8 - 6)
        spread = max(x.hi - x.lo for x in self.now.states(self.solutions.q))
        wanted = (spread >> _FINE) + _UNITS
        order = 4 + 3 * max(0, bits - wanted.bit_length()) // 10
        step = self.solutions.step(self.now, self.time, h, order)
        if step is None:
            return None, _SHORTER
        size = max(max(-e.lo, e.hi) for e in step.rest)
        change = 8 * (wanted.bit_length() - size.bit_length()) // (order + 1)
        return (step if change >= _LESS else None), max(_HALF, min(change, -_HALF))

    def watch(self, step: Step) -> Fate:
        """Return what the gap does in a step.

        Theorem. It has no fall where it has no zero, or where its rate is > 0; nor where its rate
        is < 0 and it is <= 0 at first or > 0 at last. If its rate is < 0 in one step, or in some
        that follow each other, and it is > 0 at first and < 0 at last, it has exactly one.
        Proof. At a fall the rate is <= 0. With a rate < 0 the gap has at most one zero; it has one
        if its sign changes (Bolzano), and is > 0 before it.
        """
        first = self.section.gap
        gap, rate = first.at(self._during(step))
        if not self.falling and (not gap.has_zero or rate.lo > 0):
            return Fate.PASSES
        if rate.hi >= 0:
            return Fate.OPEN
        if not self.falling:
            before, _ = first.at(self._here)
            if before.hi <= 0 or self._leaves(first):
                return Fate.PASSES
            if before.lo <= 0:
                return Fate.OPEN
        after, _ = first.at(self._after(step))
        if after.lo > 0:
            return Fate.PASSES
        return Fate.FELL if after.hi < 0 else Fate.FALLING

    def _stays(self, wall: Gap, step: Step, fate: Fate) -> bool:
        """Whether a wall's gap is proved > 0 in a step, but at the start if it is 0 there.

        It is if it rises from >= 0 or falls to > 0; so is the gap of the section before its fall.
        """
        gap, rate = wall.at(self._during(step))
        if gap.lo > 0 or (wall is self.section.gap and fate in (Fate.FALLING, Fate.FELL)):
            return True
        if rate.lo > 0:
            return self._leaves(wall) or wall.at(self._here)[0].lo >= 0
        return rate.hi < 0 and wall.at(self._after(step))[0].lo > 0

    def _leaves(self, gap: Gap) -> bool:
        return gap.is_left and not self.time

    def _move(self, step: Step, fate: Fate) -> None:
        """Go to the end of a step, unless it ends the journey."""
        if fate in (Fate.FALLING, Fate.FELL):
            self.falling.append((self.time, step))
        self.falls += fate is Fate.FELL
        if self.falls < self.section.number:
            if fate is not Fate.FALLING:
                self.falling.clear()
            self.now, self.time = self.solutions.after(step), self.time + step.h
            if self.time > LATEST:
                raise self._stopped(_NOT_REACHED)

    # -- at the section ----------------------------------------------------------------------------

    def _arrival(self) -> Arrival:
        """Enclose what all solutions are at the section, in whichever step they reach it."""
        return reduce(_joined, filter(None, (self.part(*each) for each in self.falling)))

    def part(self, begin: Fraction, step: Step) -> Arrival | None:
        """Enclose the variables z = (w, x, t) where the gap g is 0, of solutions for which it is.

        And their derivatives by w. Proof. At the time T of the section they are those at a fixed
        time, plus z_t T_w, where T_w = -(g_w + g_x x_w) / (g_t + g_x f) by the implicit function
        theorem; the divisor is < 0 in the step.
        """
        solutions, own = self.solutions, self.solutions.field
        s = self._zero(begin, step, self._whole, is_middle=False)
        if s is None:
            return None
        states, nothing = solutions.at(step, s), s * 0
        z = self._all(states.all, self._times(begin, step, s))
        still = [nothing] * len(solutions.w)
        fixed = own.inputs(unit(len(still), s.bits), states.derivative, still)
        (lead,) = multiply(self.section.gap.formulas.jacobian(z)[:1], fixed)
        rate = self._rate(begin, step, s)
        time = [-g / rate for g in lead]
        velocity = own.inputs(still, self.section.velocity.values(z), nothing + 1)
        derivative = [
            [x + v * t for x, t in zip(row, time, strict=True)]
            for row, v in zip(fixed, velocity, strict=True)
        ]
        at = self._zero(begin, step, s, is_middle=True)
        if at is None:
            return Arrival(z, derivative, [])
        middle, when = solutions.at(step, at).middle, self._times(begin, step, at)
        return Arrival(z, derivative, [own.inputs(solutions.middle, middle, when)])

    def _zero(self, begin: Fraction, step: Step, s: Enclosure, is_middle: bool) -> Enclosure | None:
        """Enclose when the gap is 0, among the times s h of a step; None if it never is.

        Newton's operator: 0 = gap(m) + rate (s - m), the rate between (mean value theorem).
        """
        solutions = self.solutions
        for _ in range(_NEWTON):
            m, width = middle_of(s), s.hi - s.lo
            states = solutions.at(step, m)
            x, w = (states.middle, solutions.middle) if is_middle else (states.all, solutions.w)
            z = solutions.field.inputs(w, x, self._times(begin, step, m))
            slope = self._rate(begin, step, s) * rational(step.h, s.bits)
            zero = m - self.section.gap.at(z)[0] / slope
            if zero.hi < s.lo or s.hi < zero.lo:
                return None
            s = s.meet(zero)
            if 4 * (s.hi - s.lo) > 3 * width:
                break
        return s

    def _rate(self, begin: Fraction, step: Step, s: Enclosure) -> Enclosure:
        """Enclose the rate of the gap at the times s h of a step, where it is < 0."""
        gap, there = self.section.gap, self.solutions.at(step, s).all
        path = self._all(step.path, self._times(begin, step, self._whole))
        return gap.at(path)[1].meet(gap.at(self._all(there, self._times(begin, step, s)))[1])

    # -- all variables z = (w, x, t), at some times ------------------------------------------------

    def _all(self, x: Point, t: Enclosure) -> Point:
        return self.solutions.field.inputs(self.solutions.w, x, t)

    @property
    def _here(self) -> Point:
        now = self.now.states(self.solutions.q)
        return self._all(now, rational(self.time, self.solutions.bits))

    def _during(self, step: Step) -> Point:
        return self._all(step.path, self._times(self.time, step, self._whole))

    def _after(self, step: Step) -> Point:
        one = rational(Fraction(1), self.solutions.bits)
        return self._all(self.solutions.at(step, one).all, self._times(self.time, step, one))

    def _times(self, begin: Fraction, step: Step, s: Enclosure) -> Enclosure:
        return rational(begin, s.bits) + rational(step.h, s.bits) * s

    @property
    def _whole(self) -> Enclosure:
        """The whole step: s in [0, 1]."""
        return Enclosure(0, 1 << self.solutions.bits, self.solutions.bits)

    # -- where there is no proof -------------------------------------------------------------------

    def _stopped(self, reason: str) -> Unproved:
        """Return Unproved with the place; Futile unless a thin set has grown wide by rounding."""
        half = self.solutions.bits // 2
        states = self.now.states(self.solutions.q)
        was, now = (max(x.hi - x.lo for x in box) >> half for box in (self.solutions.q, states))
        kind = Unproved if now and not was else Futile
        return kind(f"{reason}; {self._place()}")

    def _reason(self, step: Step | None) -> str:
        if step is None:
            return "it is not proved that the solutions go on: they may end, or be too many"
        if any(not self._stays(wall, step, self.watch(step)) for wall in self.section.walls):
            return "it is not proved that the gaps stay > 0"
        if self.section.gap.at(self._here)[0].has_zero and not self.falling:
            return "there are states on both sides of the section"
        return "it is not decided whether the section is crossed or touched"

    def _place(self) -> str:
        """Say up to when the solutions are followed, and where they are then."""
        place = ", ".join(between(x.range) for x in self.now.c)
        when = f"up to the time {floor_text(self.time, 6)}, where they are about ({place})"
        return f"the solutions are followed {when}, after {self.falls} crossings"


def _joined(one: Arrival, two: Arrival) -> Arrival:
    """Return what holds for the solutions of both."""
    derivative = list(map(hulls, one.derivative, two.derivative))
    return Arrival(hulls(one.all, two.all), derivative, [*one.middle, *two.middle])


def hulls(x: Sequence[Enclosure], y: Sequence[Enclosure]) -> Point:
    """Enclose both, side by side."""
    return list(map(Enclosure.hull, x, y))
