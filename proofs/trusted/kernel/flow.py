"""Flows without a closed form: from a start along x' = f, to a time or a section.

A function {variables w, time t, state x, field, start, end, values}, with `parameters` and
`periods` as all maps may have them:

- field: formulas of x, t, w, one for each of the state; start: formulas of w, its values at t = 0.
- end: {time: T}, T a formula of w, > 0; or {section: g, direction, count: k}: the k-th time t > 0
  at which g, a formula of x, t, w, falls ("-") or rises ("+") through 0. It falls through 0 at a
  time if it is 0 then, and > 0 just before. Or {gaps: [g, ...]}: the first t > 0 at which g = 0,
  all gaps being > 0 in between, the others at that time, too: an impact.
- values: formulas of x, t, w, taken then.

The map takes w to the values. What is enclosed is proved to exist: the solution up to there, and a
crossing that is transversal. No witness of the integration is needed: steps, orders and frames are
found here, in integers, and what is proved does not depend on them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import reduce
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Futile
from proofs.trusted.kernel.enclose import (
    Box,
    Circle,
    Matrix,
    centre_of,
    enclosed,
    integer,
    multiply,
    point_box,
)
from proofs.trusted.kernel.formulas import MAX_VALUES, Formulas, same_form
from proofs.trusted.kernel.head import optional, read_head, require_periods
from proofs.trusted.kernel.injective import variables_of
from proofs.trusted.kernel.lohner import Field, Point, Solutions, linearized, moved
from proofs.trusted.kernel.section import LATEST, Gap, Journey, Section, hulls
from proofs.trusted.kernel.trees import At, Derivative, Operation, Tree, Variable, read_tree

_MOST_STATES, _MOST_CROSSINGS, _MOST_GAPS = 8, 100, 6
_KEPT = 512  # boxes with their values and derivatives: all of a tree, for the next arrow
_GUARD = 64  # bits of the width of a box
_DIRECTIONS = ("+", "-")


class End(NamedTuple):
    """Where a flow ends: at the fall of that number of the first gap; in words.

    walls: how many of the gaps stay > 0 until then. is_time: whether it is at a time.
    """

    gaps: tuple[Tree, ...]
    number: int
    walls: int
    words: str
    is_time: bool = False


@dataclass(frozen=True, eq=False)
class Flow:
    """The map of a flow: start, field, gap and values, formulas of the same variables.

    The variables are w without parameters in ranges, the states, the time, these parameters.
    """

    first: int
    start: Formulas
    section: Section
    outcome: Formulas
    ranges: Box
    equation: Field
    end: End
    _known: dict[tuple[int, ...], tuple[Point, Matrix]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The map's."""
        return self.outcome.name

    @property
    def variables(self) -> tuple[str, ...]:
        """Those of the map."""
        return self.outcome.variables[: self.first]

    @property
    def size(self) -> int:
        """The number of values."""
        return self.outcome.size

    @property
    def trees(self) -> tuple[Tree, ...]:
        """The values, as they are written."""
        return self.outcome.trees

    @property
    def circles(self) -> tuple[Circle, ...]:
        """The angles among the variables."""
        return self.outcome.circles

    def periods(self, bits: int) -> dict[int, Enclosure]:
        """Enclose the periods of the angles."""
        return self.outcome.periods(bits)

    @property
    def definition(self) -> str:
        """Write F(w) = values, when, and which equation with which start."""
        *states, time = self.outcome.variables[self.first :][: self.equation.n + 1]
        values = ", ".join(map(str, self.trees))
        rates, starts = (
            ", ".join(f"`{left.format(x)} = {tree}`" for x, tree in zip(states, trees, strict=True))
            for left, trees in (
                (f"D({{}}, {time})", self.section.velocity.trees),
                ("{}", self.start.trees),
            )
        )
        return (
            f"`{self.name}({', '.join(self.variables)}) = ({values})` at {self.end.words}, where "
            f"{rates} and {starts} at `{time} = 0`{self.outcome.given}"
        )

    def values(self, x: Sequence[Enclosure]) -> Point:
        """Enclose the values on a box, from those for its middle by the mean value theorem."""
        return self._enclosed(x)[0]

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative on a box."""
        return [row[: self.first] for row in self._enclosed(x)[1]]

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivatives by the parameters in ranges, on a box."""
        return [row[self.first :] for row in self._enclosed(x)[1]]

    def pinned(self) -> Flow:
        """Return the map at the middle of the ranges."""
        return replace(self, ranges=point_box(centre_of(self.ranges)), _known={})

    def _enclosed(self, x: Sequence[Enclosure]) -> tuple[Point, Matrix]:
        """Enclose values and derivatives, with no more digits than are worth it for a wide box."""
        w = [*x, *enclosed(self.ranges, x[0].bits)]
        width = max(side.hi - side.lo for side in w).bit_length()
        spare = max(0, min(width, w[0].bits) - _GUARD)
        box = [Enclosure(a.lo >> spare, -(-a.hi >> spare), a.bits - spare) for a in w]
        key = (box[0].bits, *(end for side in box for end in (side.lo, side.hi)))
        if key not in self._known:
            if len(self._known) == _KEPT:
                self._known.clear()
            self._known[key] = self._map(box)
        values, rows = self._known[key]
        return finer(values, spare), [finer(row, spare) for row in rows]

    def is_reversible(self, on_images: bool) -> bool:
        """Whether the map is proved to be one-to-one on its images.

        Theorem. Let the field, the section and the values be functions of the state alone, the end
        a section, and let the start from the values at a state on the section be that state. Then
        F(a) = F(b) for images a and b of points only if a = b.
        Proof. The starts from a, b and F(a) are states in which solutions fall through the section.
        Solutions are unique, backwards as well: those from a and b to the start from F(a) are parts
        of one. If b came first, it would fall through once more on its way than a does. So both
        start in one state, of which a and b are the values.
        """
        tape, first, last = self.outcome.tape, self.first, self.first + self.equation.n
        section = self.section.gap.formulas.roots
        roots = (*self.section.velocity.roots, *section, *self.outcome.roots)
        others = {*range(first), last} & variables_of(tape, *roots)
        is_closed = not (others or self.circles) and self.size == first
        if not (on_images and is_closed) or self.end.is_time or self.end.walls:
            return False
        places = [tape.add("variable", datum=Fraction(k)) for k in range(last)]
        known = dict(zip(places, self.outcome.roots, strict=False))
        begins = zip(tape.moved(self.start.roots, known), places[first:], strict=True)
        return not any(map(tape.may_fail, self.start.roots)) and all(
            same_form(tape, start, state)
            or any(same_form(tape, start, tape.add(op, state, section[0])) for op in "+-")
            for start, state in begins
        )

    def journey(self, w: Point) -> Journey:
        """Return the solutions for all w, the parameters in ranges among them, at their start."""
        solutions = Solutions.of(self.equation, w)
        everywhere, middle = map(self._at_start, (w, solutions.middle))
        if self.end.is_time:
            time, _ = self.section.gap.at(everywhere)
            if time.lo <= 0:
                raise Futile("the time is not proved positive")
            if time.lo >> time.bits >= LATEST:
                raise Futile(f"the time is not proved to be before {LATEST}")
        slopes = [
            [*row[: self.first], *row[self.first + self.equation.n + 1 :]]
            for row in self.start.jacobian(everywhere)
        ]
        begin = solutions.begin(self.start.values(middle), slopes)
        return Journey(solutions, self.section, begin)

    def _map(self, w: Point) -> tuple[Point, Matrix]:
        """Enclose values and derivatives for all w."""
        journey = self.journey(w)
        arrival = journey.arrive()
        derivative = multiply(self.outcome.jacobian(arrival.all), arrival.derivative)
        middle = reduce(hulls, map(self.outcome.values, arrival.middle))
        mean = moved(middle, derivative, journey.solutions.q)
        return list(map(Enclosure.meet, mean, self.outcome.values(arrival.all))), derivative

    def _at_start(self, w: Point) -> Point:
        """Return all variables at the time 0, for formulas that do not depend on the state."""
        nothing = w[0] * 0
        return self.equation.inputs(w, [nothing] * self.equation.n, nothing)


def finer(x: Sequence[Enclosure], bits: int) -> Point:
    """Return the same with more bits."""
    return [Enclosure(a.lo << bits, a.hi << bits, a.bits + bits) for a in x]


def read_flow(name: str, reader: Reader) -> Flow:
    """Read a flow; that its formulas respect the periods of angles is proved."""
    names = ("variables", "time", "state", "field", "start", "end", "values")
    fields = reader.fields(*names, *optional(reader))
    _, _, state_of, field_of, start_of, end_of, values_of, *_ = fields
    n, head = len(state_of.items(1, _MOST_STATES)), read_head(name, reader)
    placer, first, (time,) = head.placer(), len(head.state) - n, head.time
    states, numbers = head.state[first:], tuple(head.ranges.values())

    def placed(trees: Sequence[Tree]) -> Formulas:
        return replace(head.formulas(name, replace(placer, parts=[]), trees), ranges=())

    rates, starts, values = (
        [read_tree(each) for each in part.items(*sizes)]
        for part, sizes in ((field_of, (n, n)), (start_of, (n, n)), (values_of, (1, MAX_VALUES)))
    )
    if any(tree.free & {*states, time} for tree in starts):
        raise start_of.fail("a start does not depend on the state, nor on the time")
    end = _read_end(end_of, {*states}, time)
    if any(_differentiates(tree, {*states}) for tree in (*rates, *values, *end.gaps)):
        raise reader.fail("no derivatives of what flows, and no substitution there")
    velocity, start, outcome = map(placed, (rates, starts, values))
    begin = dict(zip((placer.places[x] for x in states), start.roots, strict=True))
    zero, gaps = placer.tape.number(0), []
    for tree in end.gaps:
        both = placed([tree, _rate(tree, rates, states, time)])
        (at_first,) = placer.tape.moved(both.roots[:1], begin | {placer.places[time]: zero})
        gaps.append(Gap(both, same_form(placer.tape, at_first, zero)))
    others = (*velocity.roots, *(gap.formulas.roots[0] for gap in gaps))
    require_periods(reader, outcome, outcome.roots, others, begin)
    section = Section(gaps[0], velocity, end.number, tuple(gaps[: end.walls]))
    return Flow(first, start, section, outcome, numbers, linearized(velocity, first), end)


def _read_end(reader: Reader, states: set[str], time: str) -> End:
    if reader.has("time"):
        (when,) = reader.fields("time")
        tree = read_tree(when)
        if tree.free & {*states, time}:
            raise when.fail("a time depends on the variables of the map and on parameters alone")
        gap = Operation("-", (tree, Variable(time)))
        return End((gap,), 1, 0, f"`{time} = {tree}`", is_time=True)
    if reader.has("gaps"):
        (gaps_of,) = reader.fields("gaps")
        gaps = tuple(read_tree(each) for each in gaps_of.items(1, _MOST_GAPS))
        others = ", ".join(f"`{gap}`" for gap in gaps[1:])
        walls = f" and {others} > 0 after `{time} = 0` until it" if others else ""
        words = f"the first `{time} > 0` at which `{gaps[0]} = 0`{walls}"
        return End(gaps, 1, len(gaps), words)
    section_of, direction, count_of = reader.fields("section", "direction", "count")
    tree, number = read_tree(section_of), integer(count_of, 1, _MOST_CROSSINGS)
    if direction.string() not in _DIRECTIONS:
        raise direction.fail('"+" or "-" is expected')
    is_fall = direction.string() == "-"
    crosses = f"`{tree}` {'falls' if is_fall else 'rises'} through 0"
    words = f"the {_ordinal(number)} `{time} > 0` at which {crosses}"
    return End((tree if is_fall else Operation("negative", (tree,)),), number, 0, words)


def _differentiates(tree: Tree, states: set[str]) -> bool:
    """Whether a formula has a derivative of states, or a substitution into one of them.

    On the tape they are variables, in words functions of the time: D(x, t) would be 0 there.
    """
    own = isinstance(tree, Derivative | At) and bool(tree.free & states)
    return own or any(_differentiates(part, states) for part in tree.parts)


def _ordinal(n: int) -> str:
    suffixes = {1: "st", 2: "nd", 3: "rd"} if n // 10 != 1 else {}
    return f"{n}{suffixes.get(n % 10, 'th')}"


def _rate(gap: Tree, field: Sequence[Tree], states: Sequence[str], time: str) -> Tree:
    """Return the rate of a gap along solutions: D(g, t) + D(g, x) f + ..."""
    rate: Tree = Derivative((time,), (gap,))
    for x, velocity in zip(states, field, strict=True):
        if x in gap.free:
            term = Operation("*", (Derivative((x,), (gap,)), velocity))
            rate = Operation("+", (rate, term))
    return rate
