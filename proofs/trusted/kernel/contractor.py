"""What an equation W = F(Z) leaves of two boxes: F's operations done, then undone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Protocol

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.operations import Enclosures, sqrt

Point = list[Enclosure]  # a box


class Empty(Exception):
    """Nothing is left: a proof. (Unproved is none, so `Enclosure.meet` does not serve.)"""


def meet(x: Enclosure, y: Enclosure) -> Enclosure:
    """Return what two enclosures have in common, or raise Empty."""
    low, high = x.lo if x.lo > y.lo else y.lo, x.hi if x.hi < y.hi else y.hi
    if low > high:
        raise Empty
    return Enclosure(low, high, x.bits)


class Cutter(Protocol):
    """Cuts of boxes Z and W that lose no z in Z and w in W with w = F(z)."""

    def cut(self, z: Point, w: Point) -> tuple[Point, Point]:
        """Return what is left of Z and W; Empty if nothing is."""


@dataclass(frozen=True)
class Images:
    """Cuts of W by the image of Z, for any map."""

    map: Map

    def cut(self, z: Point, w: Point) -> tuple[Point, Point]:
        """Return what is left of Z and W; all, where F is not proved defined on all of Z."""
        try:
            image = self.map.values(z)
        except Unproved:
            return z, w
        return z, list(map(meet, image, w))


def contractor(function: Map, bits: int) -> Cutter:
    """Return the best cuts for a map: for a formula its operations are undone."""
    if isinstance(function, Formulas) and not function.ranges:
        return Contractor(function, bits)
    return Images(function)


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
                self._undo(values, values[place], op, arguments, datum)
        return left, image

    def _undo(
        self,
        values: dict[int, Enclosure],
        t: Enclosure,
        op: str,
        arguments: Sequence[int],
        datum: Fraction,
    ) -> None:
        """Cut the arguments of an operation whose value is in t, if they are no numbers."""
        for one, other in zip(arguments, reversed(arguments), strict=True):
            x = values[other]
            if one in self._known:
                continue
            if op == "+":
                known = t - x
            elif op == "-":
                known = t + x if one == arguments[0] else x - t
            elif op == "*" and not x.has_zero:
                known = t / x
            elif op == "/" and one == arguments[0]:
                known = t * x
            elif op == "negative":
                known = -t
            elif op == "^" and datum == 2:
                known = _roots(x, t)
            else:
                continue
            values[one] = meet(values[one], known)


def _roots(x: Enclosure, square: Enclosure) -> Enclosure:
    """Return what holds all numbers of x whose squares are in an enclosure."""
    root = sqrt(meet(square, Enclosure(0, max(0, square.hi), square.bits)))
    if x.lo > -root.lo:
        return root
    return -root if x.hi < root.lo else root.hull(-root)
