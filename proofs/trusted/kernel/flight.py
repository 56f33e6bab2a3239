"""Flights: maps to the first zero of a gap, for any motion that solves an equation.

A function {variables x, time t, motion, gaps, values}, with `parameters` and `periods` as all maps
may have them:

- motion: a list of {name y, form, equation, start}. The form is a formula of x, t and the motions
  before it; it is proved to be the solution of y^(n) = equation whose derivatives of the orders
  0, ..., n - 1 at t = 0 are `start`, n in number. In the formulas y stands for it, D(y, t) for its
  velocity; nothing is substituted for y, or into it. In an equation only y, D(y, t), ... of the
  orders below n occur, and neither divisors nor roots nor logarithms of them, so that the solution
  is unique where the rest is defined.
- gaps: formulas of x and t; the first is that of the impact, the others are those of other walls.
- values: formulas of x and t, taken at the impact.

The map takes x to the values at the first t > 0 at which the first gap is 0, and it is defined
where all gaps are > 0 in between, and the others at the impact too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Box, Matrix, add, enclosed
from proofs.trusted.kernel.evaluation import Partial
from proofs.trusted.kernel.firstzero import FirstZero, Gap, shown
from proofs.trusted.kernel.formulas import (
    MAX_VALUES,
    Circle,
    Formulas,
    Placer,
    same_form,
)
from proofs.trusted.kernel.gaps import fall
from proofs.trusted.kernel.head import optional, read_head, require_name, require_periods
from proofs.trusted.kernel.trees import (
    Derivative,
    Operation,
    Power,
    Tree,
    Variable,
    read_tree,
)
from proofs.trusted.numbers import Range

LATEST = Fraction(1024)
_MOST_MOTIONS, _MOST_GAPS, _MOST_ORDERS = 6, 6, 4
_ENOUGH = 1024  # moves by a smaller part of the width do not pay
_COARSE = 64  # bits, in which a window is looked for first
_REMEMBERED, _AROUND = 256, 16  # impacts; of these, the last, in whose boxes others are looked for


class Motion(NamedTuple):
    """A motion as it is read, and the place of its form."""

    name: str
    form: int
    equation: Tree
    start: tuple[Tree, ...]

    def said(self, time: str) -> str:
        """Write the equation and the start."""
        n = len(self.start)
        name = Variable(self.name)
        rates = [name, *(Derivative((time,) * k, (name,)) for k in range(1, n + 1))]
        start = ", ".join(
            f"`{rate}` = `{each}`" for rate, each in zip(rates, self.start, strict=False)
        )
        return f"`{rates[n]}` = `{self.equation}` with {start} at `{time}` = 0"


@dataclass(frozen=True, eq=False)
class Flight:
    """The map of first impacts: the gaps, then the values, as formulas of the state and the time.

    motions: the equations that the forms solve. latest: until when impacts are looked for.
    """

    formulas: Formulas
    state: int
    gaps: tuple[Gap, ...]
    motions: tuple[Motion, ...]
    latest: Fraction = LATEST
    _known: dict[tuple[int, ...], tuple[Sequence[Enclosure], Enclosure]] = field(
        default_factory=dict
    )  # boxes, with the times of the impacts
    _last: dict[tuple[int, ...], Impact] = field(default_factory=dict)
    _taken: dict[int, list[int]] = field(default_factory=dict)  # steps of the last search, by bits

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
    def time(self) -> str:
        """The name of the time."""
        return self.formulas.variables[self.state]

    @property
    def walls(self) -> tuple[Tree, ...]:
        """The gaps, as they are written."""
        return self.formulas.trees[: len(self.gaps)]

    @property
    def definition(self) -> str:
        """Write F(x, ...) = ... at the first t > 0 where gap = 0, and what the motion is."""
        time, (first, *others) = self.time, (f"`{gap}`" for gap in self.walls)
        values = ", ".join(map(str, self.formulas.trees[len(self.gaps) :]))
        walls = f" and {', '.join(others)} > 0 after launch until it" if others else ""
        motions = "; ".join(motion.said(time) for motion in self.motions)
        return (
            f"`{self.name}({', '.join(self.variables)}) = ({values})` at the first `{time}` > 0 "
            f"where {first} = 0{walls}; {motions}{self.formulas.given}"
        )

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

    def pinned(self) -> Flight:
        """Return the map at the middle of the ranges."""
        return type(self)(self.formulas.pinned(), self.state, self.gaps, self.motions, self.latest)

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
        return [self.formulas.tape.derivative(root, k) for k in (*on_tape, self.state)]

    def impact(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the time of the impact, for all states in a box: see `FirstZero`."""
        return self._impact(x).time

    def _impact(self, x: Sequence[Enclosure]) -> Impact:
        key = (x[0].bits, *(end for side in x for end in (side.lo, side.hi)))
        if key not in self._last:
            launches = Launches(self, list(x), enclosed(self.formulas.ranges, x[0].bits))
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
        for gap in self.gaps[1:]:
            FirstZero(launches, gap).require_none(window[1])
        self._taken[search.bits] = search.taken
        return window


@dataclass
class Launches:
    """All flights from a box of states, for all parameters of a box."""

    flight: Flight
    states: Sequence[Enclosure]
    parameters: Sequence[Enclosure]

    def __post_init__(self) -> None:
        self._partial = Partial(self.flight.state)

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose formulas at times."""
        x = [*self.states, t]
        return self.flight.formulas.enclose(tuple(roots), x, self.parameters, self._partial)

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
    def steps(self) -> list[Enclosure]:
        """How far these sides reach from there."""
        return [self._inputs[k] - self.middle._inputs[k] for k in self.wide]


@dataclass
class Impact:
    """When all flights from a box end."""

    launches: Launches
    time: Enclosure

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
    enclosed directly, and by gap(m, s) + gap_x (x - m), m the middle (mean value theorem).
    """
    gap, rate = launches.flight.gaps[0], _fall(launches, t)
    slopes = launches.flight.slopes(gap.orders[0], launches.wide)[:-1]
    for start in starts:
        s = Enclosure(start, start, t.bits)
        if is_plain:
            (value,) = launches.on(gap.orders[:1], s)
        else:
            (value,) = launches.middle.on(gap.orders[:1], s)
            height, *row = launches.on((gap.orders[0], *slopes), s)
            value = height.meet(add(value, row, launches.steps))
        t = t.meet(s - value / rate)
    return t


def _fall(launches: Launches, t: Enclosure) -> Enclosure:
    """Enclose gap_t at times, and require that it is < 0."""
    gap = launches.flight.gaps[0]

    def gap_of(time: Range, order: int) -> Enclosure:
        return launches.on(gap.orders[order : order + 1], Enclosure.of(*time, t.bits))[0]

    (rate,) = launches.on(gap.orders[1:2], t)
    if rate.hi >= 0:
        rate = fall(gap_of, t.range)
    if rate.hi >= 0:
        raise Unproved(f"the impact is not proved transversal, {shown(launches.states)}")
    return rate


def _within(x: Sequence[Enclosure], box: Sequence[Enclosure]) -> bool:
    """Whether a box of at least as many bits lies in another one."""
    more = x[0].bits - box[0].bits
    return more >= 0 and all(
        b.lo << more <= a.lo and a.hi <= b.hi << more for a, b in zip(x, box, strict=True)
    )


# -- reading ---------------------------------------------------------------------------------------


def read_flight(name: str, reader: Reader) -> Flight:
    """Read a flight; its forms are proved to solve its equations, its gaps to leave 0."""
    more = optional(reader)
    fields = reader.fields("variables", "time", "motion", "gaps", "values", *more)
    head, (_, _, motion_of, gaps_of, values_of, *_) = read_head(name, reader), fields
    placer, time = head.placer(), head.time[0]
    motions = [_read_form(placer, time, each) for each in motion_of.items(1, _MOST_MOTIONS)]
    orders = {motion.name: len(motion.start) for motion in motions}
    for motion in motions:
        _require_solution(placer, time, motion, orders)
    gaps = [read_tree(each) for each in gaps_of.items(1, _MOST_GAPS)]
    values = [read_tree(each) for each in values_of.items(1, MAX_VALUES)]
    try:
        left = tuple(read_gap(placer, time, each) for each in gaps)
    except Unproved as error:
        raise gaps_of.fail(str(error)) from None
    formulas = head.formulas(name, placer, [*gaps, *values])
    roots, count = formulas.roots, len(gaps)
    require_periods(reader, formulas, roots[count:], roots[:count])
    return Flight(formulas, len(head.state), left, tuple(motions))


def _read_form(placer: Placer, time: str, reader: Reader) -> Motion:
    name_of, form_of, equation, start_of = reader.fields("name", "form", "equation", "start")
    name = name_of.string()
    require_name(name_of, name)
    if name in placer.places:
        raise name_of.fail(f"a name that is there twice: {name!r}")
    placer.places[name] = form = placer.place(read_tree(form_of))
    placer.solutions.add(name)
    start = tuple(read_tree(each) for each in start_of.items(1, _MOST_ORDERS))
    return Motion(name, form, read_tree(equation), start)


def _require_solution(placer: Placer, time: str, motion: Motion, orders: Mapping[str, int]) -> None:
    """Raise Unproved unless a form solves its equation and starts as it says.

    Theorem. The right side is a smooth function of the unknowns, continuous in t, wherever it is
    defined: so its solution is unique (Picard and Lindelof). The form is one: the normal forms of
    both sides are the same, as are those of its derivatives at t = 0 and the start; all of these
    become parts, so they are proved defined wherever the flight is followed.
    """
    tape, right = placer.tape, placer.place(motion.equation)
    _require_explicit(motion.equation, time, orders)
    rate, clock = motion.form, placer.places[time]
    for tree in motion.start:
        start = placer.place(tree)
        if tree.free & {time, *orders}:
            raise Unproved("a start does not depend on the time, nor on motions")
        placer.parts += rate, start
        if not same_form(tape, tape.moved([rate], {clock: tape.number(0)})[0], start):
            raise Unproved(f"the form of {motion.name} is not proved to start so")
        rate = tape.derivative(rate, int(tape.nodes[clock].datum))
    placer.parts += rate, right
    if not same_form(tape, rate, right):
        raise Unproved(f"the form of {motion.name} is not proved to solve this equation")


def _require_explicit(tree: Tree, time: str, orders: Mapping[str, int]) -> None:
    """Raise Unproved unless the unknowns occur as y, D(y, t), ..., below their orders alone.

    And not in divisors, roots, logarithms, so that the formula is smooth in them.
    """
    if not tree.free & {*orders}:
        return
    parts: tuple[Tree, ...] = ()
    match tree:
        case Variable():
            is_explicit = True
        case Derivative(by=by, parts=(Variable(name=name),)):
            is_explicit = name in orders and len(by) < orders[name] and {*by} == {time}
        case Operation(op="/", parts=(top, bottom)):
            is_explicit, parts = not bottom.free & {*orders}, (top,)
        case Operation(op="+" | "-" | "*" | "negative" | "sin" | "cos" | "exp" | "atan"):
            is_explicit, parts = True, tree.parts
        case Power(exponent=n):
            is_explicit, parts = n > 0, tree.parts
        case _:
            is_explicit = False
    if not is_explicit:
        raise Unproved("unknowns of lower order alone, in no divisor, root or logarithm")
    for part in parts:
        _require_explicit(part, time, orders)


def read_gap(placer: Placer, time: str, tree: Tree, launch: Tree | None = None) -> Gap:
    """Return a gap with its derivatives, up to the one after the first that is not 0 at launch.

    launch: a formula of that one there, where a plain one encloses it better. Raises Unproved where
    it is another function, or there is none.
    """
    tape, clock = placer.tape, placer.places[time]
    orders = [placer.place(tree)]
    for order in range(_MOST_ORDERS + 1):
        while len(orders) < max(3, order + 2):
            orders.append(tape.derivative(orders[-1], int(tape.nodes[clock].datum)))
        start = tape.moved([orders[order]], {clock: tape.number(0)})[0]
        if not same_form(tape, start, tape.number(0)):
            placer.parts += orders[:-1]
            plain = start if launch is None else placer.place(launch)
            if plain != start and not same_form(tape, plain, start):
                raise Unproved("the gap does not leave 0 so")
            is_constant = orders[1] == tape.number(0)
            return Gap(tuple(orders), order, plain, is_constant)
    raise Unproved("the gap is 0 at launch, with all its first derivatives")
