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

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Box, Matrix, add, enclosed
from proofs.trusted.kernel.formulas import (
    MAX_VALUES,
    Circle,
    Formulas,
    Placer,
    same_form,
)
from proofs.trusted.kernel.gaps import stays_up
from proofs.trusted.kernel.head import optional, read_head, require_name, require_periods
from proofs.trusted.kernel.trees import (
    Derivative,
    Operation,
    Power,
    Tree,
    Variable,
    read_tree,
)
from proofs.trusted.numbers import Range, between, show

LATEST = Fraction(1024)
_FIRST_STEP, _SHORTEST = Fraction(1, 4), Fraction(1, 2**30)
_MOST_MOTIONS, _MOST_GAPS, _MOST_ORDERS = 6, 6, 4
_REMEMBERED = 8  # windows of times, for boxes inside boxes


class Gap(NamedTuple):
    """A gap on the tape: its derivatives by the time, and the order of the first not 0 at launch.

    order: 0 for a gap that is not 0 at launch.
    """

    orders: tuple[int, ...]
    order: int


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

    motions: the equations that the forms solve.
    """

    formulas: Formulas
    state: int
    gaps: tuple[Gap, ...]
    motions: tuple[Motion, ...]
    _windows: list[tuple[list[Enclosure], Range]] = field(default_factory=list)
    _last: list[tuple[list[Enclosure], Enclosure]] = field(default_factory=list)

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
        """Write F(x, ...) = ... at the first t > 0 where gap = 0, and what the motion is."""
        time, count = self.formulas.variables[self.state], len(self.gaps)
        first, *others = (f"`{gap}`" for gap in self.formulas.trees[:count])
        values = ", ".join(map(str, self.formulas.trees[count:]))
        walls = f" and {', '.join(others)} > 0 after launch until it" if others else ""
        motions = "; ".join(motion.said(time) for motion in self.motions)
        return (
            f"`{self.name}({', '.join(self.variables)}) = ({values})` at the first `{time}` > 0 "
            f"where {first} = 0{walls}; {motions}{self.formulas.given}"
        )

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box of states."""
        return self.on(self.outcome, x, self.impact(x))

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative by the state."""
        return self._slopes(x, range(self.state))

    @property
    def ranges(self) -> Box:
        """Those of the parameters."""
        return self.formulas.ranges

    def pinned(self) -> Flight:
        """Return the map at the middle of the ranges."""
        return Flight(self.formulas.pinned(), self.state, self.gaps, self.motions)

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative by the parameters."""
        return self._slopes(x, [self.state + 1 + k for k in range(len(self.ranges))])

    def _slopes(self, x: Sequence[Enclosure], by: Sequence[int]) -> Matrix:
        """Enclose F_y - F_t gap_y / gap_t for inputs y (implicit function theorem: gap_t < 0)."""
        t, n, tape = self.impact(x), len(by), self.formulas.tape
        roots = (self.gaps[0].orders[0], *self.outcome)
        wanted = [tape.derivative(root, v) for root in roots for v in (*by, self.state)]
        entries = self.on((*wanted, *roots), x, t)
        (*gap, fall), *rows = (entries[i * (n + 1) : (i + 1) * (n + 1)] for i in range(len(roots)))
        return [[a - row[n] * g / fall for a, g in zip(row, gap, strict=False)] for row in rows]

    def impact(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the time of the impact, for all states in a box: see `_Search`."""
        if not (self._last and _same(self._last[0][0], x)):
            t = self._sharp(x, self._window(x))
            self._last[:] = [(list(x), t)]
        return self._last[0][1]

    def _window(self, x: Sequence[Enclosure]) -> Range:
        for box, window in self._windows:
            if _within(x, box):
                return window
        window = _Search(self, self.gaps[0], x).fall()
        for gap in self.gaps[1:]:
            _Search(self, gap, x).up_to(window[1])
        self._windows[:] = [(list(x), window), *self._windows[: _REMEMBERED - 1]]
        return window

    def _sharp(self, x: Sequence[Enclosure], window: Range) -> Enclosure:
        """Enclose the only zero of the gap in a window where gap_t < 0 (Newton's operator).

        For x in X, m its middle, s in T: gap(x, t) = 0 = gap(m, s) + gap_x (x - m) + gap_t (t - s)
        with derivatives on X x {s} and X x T (mean value theorem).
        """
        bits, tape, gap = x[0].bits, self.formulas.tape, self.gaps[0]
        t = Enclosure.of(*window, bits)
        sides = [*x, *enclosed(self.formulas.ranges, bits)]
        places = [*range(self.state), *range(self.state + 1, len(sides) + 1)]
        slopes = tuple(tape.derivative(gap.orders[0], place) for place in places)
        middle = [Enclosure(m := (a.lo + a.hi) >> 1, m, bits) for a in sides]
        steps = [a - m for a, m in zip(sides, middle, strict=True)]
        while True:
            width = t.hi - t.lo
            s = Enclosure(m := (t.lo + t.hi) >> 1, m, bits)
            (fall,), row = self.on(gap.orders[1:2], x, t), self.on(slopes, x, s)
            (value,) = self.on(gap.orders[:1], middle[: self.state], s, middle[self.state :])
            if fall.hi >= 0:
                raise Unproved(f"the impact is not proved transversal, {_place(x)}")
            t = t.meet(s - add(value, row, steps) / fall)
            if 2 * (t.hi - t.lo) >= width:
                return t

    def on(
        self,
        roots: Sequence[int],
        x: Sequence[Enclosure],
        t: Enclosure,
        parameters: Sequence[Enclosure] = (),
    ) -> list[Enclosure]:
        """Enclose formulas on a box of states and times; parameters: instead of their ranges."""
        return self.formulas.enclose(tuple(roots), [*x, t], parameters)


def _same(one: Sequence[Enclosure], two: Sequence[Enclosure]) -> bool:
    return one[0].bits == two[0].bits and _within(one, two) and _within(two, one)


def _within(x: Sequence[Enclosure], box: Sequence[Enclosure]) -> bool:
    """Whether a box of at least as many bits lies in another one."""
    more = x[0].bits - box[0].bits
    return more >= 0 and all(
        b.lo << more <= a.lo and a.hi <= b.hi << more for a, b in zip(x, box, strict=True)
    )


@dataclass
class _Search:
    """Goes through the times after launch, for all states in a box at once.

    Invariant: the gap is > 0 on (0, low]. A step to `high` keeps it by one of these.
    1. The first derivative that is not 0 at launch has been > 0 from 0 to `high`, the lower ones
       being 0 there.
    2. gap > 0 at both ends, so much that gap'' cannot bring it to 0 (`stays_up`).
    3. gap_t < 0 from a time at which gap > 0 on, up to one at which gap < 0: there the gap has its
       first zero, by Bolzano's theorem, and only one.
    """

    flight: Flight
    gap: Gap
    x: Sequence[Enclosure]

    def fall(self) -> Range:
        """Return times low < high, gap > 0 on (0, low], gap_t < 0 between, gap(high) < 0."""
        for low, high, falls in self._steps(LATEST):
            if falls and self._at(high).hi < 0:
                return low, high
        raise Unproved(f"no impact is proved before the time {show(LATEST)}, {_place(self.x)}")

    def up_to(self, end: Fraction) -> None:
        """Raise Unproved unless the gap is proved > 0 on (0, end]."""
        for _, _, falls in self._steps(end):
            if falls:
                raise Unproved(f"another gap is not proved > 0 until the impact, {_place(self.x)}")

    def _steps(self, end: Fraction) -> Iterator[tuple[Fraction, Fraction, bool]]:
        """Iterate over low < high, and whether the gap falls between; else gap > 0 on (0, high]."""
        low, step, leaving = Fraction(0), _FIRST_STEP, self.gap.order > 0
        least, falling, is_new = self._at(low).lo, None, True
        if not leaving and least <= 0:
            raise Unproved(f"a gap is not proved > 0 at launch, {_place(self.x)}")
        while low < end:
            high = min(low + step, end)
            try:
                after = self._at(high).lo
                leaves = leaving and self._of((low, high), self.gap.order).lo > 0
                stays = leaves or (
                    falling is None and stays_up(self._of, (low, high), min(least, after))
                )
                falls = not stays and low > 0 and self._of((low, high), 1).hi < 0
            except Unproved:  # a formula is not proved defined for so long a time
                leaves = stays = falls = False
            if not (stays or falls):
                if step < _SHORTEST:
                    raise Unproved(f"{self._reason(low)}, {_place(self.x)}")
                step /= 2
                continue
            if falls and falling is None and is_new and after <= 0 <= self._at(high).hi:
                step, is_new = step * 3 / 4, False  # `high` is next to the impact: not the best end
                continue
            falling = None if stays or after > 0 else low if falling is None else falling
            yield low if falling is None else falling, high, falling is not None
            low, step, least, leaving, is_new = high, 2 * step, after, leaves, True

    def _reason(self, low: Fraction) -> str:
        """Say why no step after a time is proved."""
        if low:
            return f"a graze is not excluded at the time {show(round(low, 6))}"
        if self.gap.order and self._of((low, low), self.gap.order).hi < 0:
            return "the gap is < 0 right after launch: such a state does not leave the wall"
        return "it is not proved that the gap is > 0 right after launch"

    def _of(self, time: Range, order: int) -> Enclosure:
        t = Enclosure.of(*time, self.x[0].bits)
        return self.flight.on(self.gap.orders[order : order + 1], self.x, t)[0]

    def _at(self, time: Fraction) -> Enclosure:
        return self._of((time, time), 0)


def _place(x: Sequence[Enclosure]) -> str:
    """Write a box for a message, its ends rounded outward."""
    return f"for states in {' x '.join(between(each.range) for each in x)}"


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
    left = tuple(_gap(placer, time, *each) for each in zip(gaps, gaps_of.items(), strict=True))
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


def _gap(placer: Placer, time: str, tree: Tree, reader: Reader) -> Gap:
    """Return a gap with its derivatives, up to the first that is not 0 at launch for all states."""
    tape, clock = placer.tape, placer.places[time]
    orders = [placer.place(tree)]
    while len(orders) < 3:
        orders.append(tape.derivative(orders[-1], int(tape.nodes[clock].datum)))
    for order in range(_MOST_ORDERS + 1):
        if order == len(orders):
            orders.append(tape.derivative(orders[-1], int(tape.nodes[clock].datum)))
        start = tape.moved([orders[order]], {clock: tape.number(0)})[0]
        if not same_form(tape, start, tape.number(0)):
            placer.parts += orders[: max(order, 2)]
            return Gap(tuple(orders), order)
    raise reader.fail("the gap is 0 at launch, with all its first derivatives")
