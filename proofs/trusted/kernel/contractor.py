"""What an equation W = F(Z) leaves of two boxes: F's operations done, then undone."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Enclosures, sqrt
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.meter import METER

Point = list[Enclosure]  # a box


class Empty(Exception):
    """Nothing is left."""


def meet(x: Enclosure, y: Enclosure) -> Enclosure:
    """Return what two enclosures have in common, or raise Empty."""
    low, high = max(x.lo, y.lo), min(x.hi, y.hi)
    if low > high:
        raise Empty
    return Enclosure(low, high, x.bits)


def has_zero(x: Enclosure) -> bool:
    """Whether 0 is in an enclosure."""
    return x.lo <= 0 <= x.hi


class Contractor:
    """Cuts of boxes Z and W that lose no z in Z and w in W with w = F(z).

    Each value is that of an operation at such a z: first forward, then, of what is known of it,
    backward to its arguments. So, if t = a + b, a is in t - b. Source: HC4 of Benhamou, Goualard,
    Granvilliers and Puget, Revising hull and box consistency, 1999.
    """

    def __init__(self, function: Formulas, bits: int) -> None:
        tape, self._roots, self._numbers = function.tape, function.roots, Enclosures(bits)
        self._nodes, self._known = [], dict[int, Enclosure]()
        for place in tape.order(function.roots):
            op, arguments, datum = tape.nodes[place]
            if op != "variable" and all(i in self._known for i in arguments):
                known = [self._known[i] for i in arguments]
                self._known[place] = self._numbers.apply(op, known, datum)
            else:
                self._nodes.append((place, op, arguments, datum))

    def cut(self, z: Point, w: Point) -> tuple[Point, Point]:
        """Return what is left of Z and W; all, where F is not proved defined on all of Z."""
        METER.get().spend(4 * len(self._nodes))
        values, left = dict(self._known), list(z)
        try:
            for place, op, arguments, datum in self._nodes:
                known = [values[i] for i in arguments]
                values[place] = (
                    z[int(datum)] if op == "variable" else self._numbers.apply(op, known, datum)
                )
        except Unproved:
            return z, w
        image = [meet(values[root], x) for root, x in zip(self._roots, w, strict=True)]
        for root, x in zip(self._roots, image, strict=True):
            values[root] = meet(values[root], x)
        for place, op, arguments, datum in reversed(self._nodes):
            if op == "variable":
                left[int(datum)] = values[place]
            else:
                _undo(values, values[place], op, arguments, datum)
        return left, image


def _undo(
    values: dict[int, Enclosure], t: Enclosure, op: str, arguments: Sequence[int], datum: Fraction
) -> None:
    """Cut the arguments of an operation whose value is in t."""
    a, b = arguments[0], arguments[-1]
    if op == "+":
        values[a] = meet(values[a], t - values[b])
        values[b] = meet(values[b], t - values[a])
    elif op == "-":
        values[a] = meet(values[a], t + values[b])
        values[b] = meet(values[b], values[a] - t)
    elif op == "negative":
        values[a] = meet(values[a], -t)
    elif op == "*":
        for one, other in ((a, b), (b, a)):
            if not has_zero(values[other]):
                values[one] = meet(values[one], t / values[other])
    elif op == "/":
        values[a] = meet(values[a], t * values[b])
    elif op == "^" and datum == 2:
        values[a] = _roots_in(values[a], meet(t, Enclosure(0, max(0, t.hi), t.bits)))


def _roots_in(x: Enclosure, square: Enclosure) -> Enclosure:
    """Return a part of x with all numbers in it that have their squares in `square`."""
    root = sqrt(square)
    if x.lo > -root.lo:
        return meet(x, root)
    if x.hi < root.lo:
        return meet(x, -root)
    return meet(x, Enclosure(-root.hi, root.hi, x.bits))
