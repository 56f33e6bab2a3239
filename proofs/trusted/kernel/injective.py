"""Maps that are one-to-one: what follows from values, variable by variable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Protocol, runtime_checkable

from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.formulas import MAX_VARIABLES, Formulas
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.normalform import NormalForms, number

Value = tuple[int, int | None]  # and the period up to which it is known, both on the tape


@runtime_checkable
class Reversible(Protocol):
    """A map that may be known to be one-to-one."""

    def is_reversible(self, on_images: bool) -> bool:
        """Whether it is proved to be, if need be on its images alone."""


def is_one_to_one(map_: Map, on_images: bool = False) -> bool:
    """Whether a map is proved to be one-to-one, if need be on its images alone."""
    if isinstance(map_, Formulas):
        values, angles = placed(map_, map_.roots), angles_of(map_)
        is_square = map_.size == len(map_.variables)
        return is_square and determines(map_.tape, values, {*range(map_.size)}, angles)
    return isinstance(map_, Reversible) and map_.is_reversible(on_images)


def angles_of(map_: Map) -> dict[int, int]:
    """Return the numbers of the variables that are angles, with their periods."""
    return {circle.place: circle.root for circle in map_.circles}


def placed(map_: Map, roots: Sequence[int]) -> list[Value]:
    """Return values of a map, those that are angles being known up to their periods."""
    angles = angles_of(map_)
    return [(root, angles.get(k)) for k, root in enumerate(roots)]


def determines(
    tape: Tape, values: Sequence[Value], wanted: set[int], angles: Mapping[int, int]
) -> bool:
    """Whether values give some variables, angles up to their periods, one after the other.

    Theorem. Let there be, until all are known, a value or a difference of values that is a x + g,
    with a number a != 0, a variable x, and a function g of known ones and of variables that are not
    wanted, which are given. If x is no angle, let it be known exactly; if x is one, let it be known
    up to the period of x, and a = 1 or -1. Then x is known as well, if with another multiple of a
    period in an angle each value is the same up to a multiple of its period.
    """
    wanted = set(wanted)
    differences = [
        (tape.add("-", one, two), by if of is None else of)
        for (one, by), (two, of) in combinations(values, 2)
        if by == of or None in (by, of)
    ]
    values = [*values, *differences]
    while wanted:
        found = {
            x
            for root, by in values
            for x in variables_of(tape, root) & wanted
            if by == angles.get(x) and _is_alone(tape, root, x, wanted, x in angles)
        }
        if not found:
            return False
        wanted -= found
    return True


def variables_of(tape: Tape, *roots: int) -> set[int]:
    """Return the numbers of the variables that occur."""
    nodes = [tape.nodes[place] for place in tape.order(roots)]
    return {int(datum) for op, _, datum in nodes if op == "variable"}


def is_smooth(tape: Tape, root: int, variables: set[int]) -> bool:
    """Whether no divisor, root or logarithm has any of these variables in it.

    Then a derivative by one that is constant is so on a line, not on its parts alone.
    """
    nodes = [tape.nodes[place] for place in tape.order((root,))]
    inside = [
        arguments[-1]
        for op, arguments, n in nodes
        if op in ("/", "sqrt", "log") or (op == "^" and n < 0)
    ]
    return not variables_of(tape, *inside) & variables


def _is_alone(tape: Tape, root: int, x: int, wanted: set[int], is_angle: bool) -> bool:
    """Whether a value is a x + g, no other wanted variable in g; a is 1 or -1 for an angle."""
    forms = NormalForms(MAX_VARIABLES)
    others = variables_of(tape, root) & wanted - {x}
    roots = tuple(tape.derivative(root, y) for y in (x, *others))
    slope, *rest = tape.evaluate(roots, forms, forms.inputs())
    is_number = {*slope} == {()} and (not is_angle or slope in (number(1), number(-1)))
    return is_number and all(map(forms.is_zero, rest)) and is_smooth(tape, root, wanted)
