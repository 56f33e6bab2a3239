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

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.firstzero import Gap
from proofs.trusted.kernel.formulas import (
    MAX_VALUES,
    MAX_VARIABLES,
    Formulas,
    Placer,
    same_form,
)
from proofs.trusted.kernel.head import optional, read_head, require_name, require_periods
from proofs.trusted.kernel.injective import angles_of, determines, is_smooth, placed
from proofs.trusted.kernel.normalform import NormalForms
from proofs.trusted.kernel.returns import ReturnMap
from proofs.trusted.kernel.trees import Derivative, Operation, Power, Tree, Variable, read_tree

_MOST_MOTIONS, _MOST_GAPS, _MOST_ORDERS = 6, 6, 4


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
class Flight(ReturnMap):
    """The map, by formulas; motions: the equations that the forms solve."""

    formulas: Formulas
    motions: tuple[Motion, ...]
    placer: Placer

    @property
    def time(self) -> str:
        """The name of the time."""
        return self.formulas.variables[self.state]

    @property
    def walls(self) -> tuple[Tree, ...]:
        """The gaps, as they are written."""
        return self.formulas.trees[: len(self.gaps)]

    @property
    def trees(self) -> tuple[Tree, ...]:
        """The values, as they are written."""
        return self.formulas.trees[len(self.gaps) :]

    def bend(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the second derivative of the one value F by the one state.

        With t' = -gap_x / gap_t the total second derivative of a function h of x and t is h_t t'' +
        h_xx + (2 h_xt + h_tt t') t'; that of the gap is 0, which gives t''.
        """
        impact, derivative = self._impact(x), self.formulas.tape.derivative

        def partials(root: int) -> tuple[int, ...]:
            by_x, by_t = derivative(root, 0), derivative(root, 1)
            return by_x, by_t, derivative(by_x, 0), derivative(by_x, 1), derivative(by_t, 1)

        roots = self.gaps[0].orders[0], self.outcome[0]
        values = impact.launches.on([x for root in roots for x in partials(root)], impact.time)
        gap, own = values[:5], values[5:]
        later = -(gap[0] / gap[1])
        bends = [xx + (xt * 2 + tt * later) * later for _, _, xx, xt, tt in (gap, own)]
        return bends[1] - own[1] * (bends[0] / gap[1])

    def is_reversible(self, on_images: bool) -> bool:
        """Whether the map is proved to be one-to-one.

        Theorem. Let a variable p have the value p + w t, w a number; let equations, gaps and values
        be functions of p + w t and of the motions y, D(y, t), ..., below their orders, alone; let
        some gap be 0 at launch. Let p + w t and the motions follow from the values and the first
        gap being 0, the state from p and the starts, by `determines`. Then F(a) = F(b) only if
        a = b.
        Proof. Backwards from their ends the flights from a and b solve the same equations from the
        same state, so they agree as long as both last. They last as long: where the shorter one
        began a gap is 0, and in between all are > 0. So p and the starts are the same.
        """
        del on_images
        tape, n = self.formulas.tape, self.state
        own = [_order(each.name, k) for each in self.motions for k in range(len(each.start))]
        moving = range(MAX_VARIABLES - len(own), MAX_VARIABLES)
        is_square = self.size == n and moving.start >= len(self.formulas.variables)
        if not (is_square and any(gap.order for gap in self.gaps)):
            return False
        places = {
            x: tape.add("variable", datum=Fraction(k)) for x, k in zip(own, moving, strict=True)
        }
        names = {motion.name for motion in self.motions}
        places |= {x: y for x, y in self.placer.places.items() if x not in names}
        placer = Placer(tape, places, [])
        trees = (*self.trees, *self.walls, *(motion.equation for motion in self.motions))
        roots = [placer.place(_state_at(tree, self.time, names)) for tree in trees]
        starts = [placer.place(tree) for motion in self.motions for tree in motion.start]
        angles, begin = angles_of(self), {tape.add("variable", datum=Fraction(n)): tape.number(0)}
        ends = tape.moved(roots[: n + 1], begin)
        values = [*placed(self, ends[:n]), (ends[n], None)]
        return any(
            self._moves_with(p, roots, starts)
            and determines(tape, values, {p, *moving}, angles)
            and determines(tape, [(x, None) for x in starts], {*range(n)} - {p}, angles)
            for p in range(n)
        )

    def _moves_with(self, p: int, roots: Sequence[int], starts: Sequence[int]) -> bool:
        """Whether p has the value p + w t, functions are such of p + w t, and respect periods."""
        tape, n, forms = self.formulas.tape, self.state, NormalForms(MAX_VARIABLES)
        inputs = [tape.add("variable", datum=Fraction(k)) for k in range(n + 1)]
        rate = tape.derivative(roots[p], n)
        steady = tape.add("+", inputs[p], tape.add("*", rate, inputs[n]))
        changes = [rate, tape.add("-", roots[p], steady)]
        for root in roots:
            along = tape.add("*", rate, tape.derivative(root, p))
            changes.append(tape.add("-", tape.derivative(root, n), along))
            changes += [tape.derivative(root, k) for k in range(n) if k != p]
        for k, period in angles_of(self).items():
            same = [*roots[:p], *roots[p + 1 :], *starts]
            moved = tape.moved(same, {inputs[k]: tape.add("+", inputs[k], period)})
            changes += map(partial(tape.add, "-"), moved, same)
        w, *rest = tape.evaluate(tuple(changes), forms, forms.inputs())
        smooth = all(is_smooth(tape, root, {*range(n + 1)}) for root in roots)
        return smooth and {*w} <= {()} and all(map(forms.is_zero, rest))

    @property
    def definition(self) -> str:
        """Write F(x, ...) = ... at the first t > 0 where gap = 0, and what the motion is."""
        time, (first, *others) = self.time, (f"`{gap}`" for gap in self.walls)
        values = ", ".join(map(str, self.trees))
        walls = f" and {', '.join(others)} > 0 after launch until it" if others else ""
        motions = "; ".join(motion.said(time) for motion in self.motions)
        return (
            f"`{self.name}({', '.join(self.variables)}) = ({values})` at the first `{time}` > 0 "
            f"where {first} = 0{walls}; {motions}{self.formulas.given}"
        )


def _order(name: str, k: int) -> str:
    """Name a motion's derivative, as no variable of a file is named."""
    return f"{name}'{k}"


def _state_at(tree: Tree, time: str, names: Container[str]) -> Tree:
    """Return a formula with variables in the places of motions and of their derivatives.

    Where it differentiates something else, the motions are left, as unknown variables.
    """
    match tree:
        case Variable(name=name) if name in names:
            return Variable(_order(name, 0))
        case Derivative(by=by, parts=(Variable(name=name),)) if name in names and {*by} == {time}:
            return Variable(_order(name, len(by)))
        case Operation() | Power():
            return replace(tree, parts=tuple(_state_at(x, time, names) for x in tree.parts))
    return tree


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
    return Flight(formulas, len(head.state), left, tuple(motions), placer)


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


def read_gap(placer: Placer, time: str, tree: Tree) -> Gap:
    """Return a gap with its derivatives, up to the one after the first that is not 0 at launch.

    Raises Unproved where there is none.
    """
    tape, clock = placer.tape, placer.places[time]
    orders = [placer.place(tree)]
    for order in range(_MOST_ORDERS + 1):
        while len(orders) < max(3, order + 2):
            orders.append(tape.derivative(orders[-1], int(tape.nodes[clock].datum)))
        start = tape.moved([orders[order]], {clock: tape.number(0)})[0]
        if not same_form(tape, start, tape.number(0)):
            placer.parts += orders[:-1]
            return Gap(tuple(orders), order, start, is_constant=orders[1] == tape.number(0))
    raise Unproved("the gap is 0 at launch, with all its first derivatives")
