"""What an equation W = F(Z) leaves of two boxes: F's operations done, then undone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.evaluation import Bounds, run
from proofs.trusted.kernel.expression import Step
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.operations import sqrt

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
        self._roots, self._bits = function.roots, bits
        self._lower, self._upper = Bounds(), Bounds()  # of nodes without variables
        (steps, _), moving = function.tape.divided(function.roots, -1), set[int]()
        for step in steps:
            if step.op == "variable" or not moving.isdisjoint(step.node.arguments):
                moving.add(step.place)
        run([x for x in steps if x.place not in moving], (), bits, self._lower, self._upper)
        self._steps = [x for x in steps if x.place in moving]

    def cut(self, z: Point, w: Point) -> tuple[Point, Point]:
        """Return what is left of Z and W; all, where F is not proved defined on all of Z."""
        METER.get().spend(len(self._steps))
        known = _Known(dict(self._lower), dict(self._upper), self._lower, self._bits)
        try:
            run(self._steps, z, self._bits, known.lower, known.upper)
        except Unproved:
            return z, w
        image = [meet(known[root], x) for root, x in zip(self._roots, w, strict=True)]
        for root, x in zip(self._roots, image, strict=True):
            known.cut(root, x.lo, x.hi)
        left = list(z)
        for step in reversed(self._steps):
            if step.op == "variable":
                left[int(step.node.datum)] = known[step.place]
            else:
                known.undo(step)
        return left, image


@dataclass(frozen=True)
class _Known:
    """What is known of the values of nodes."""

    lower: Bounds
    upper: Bounds
    fixed: Bounds  # of numbers: not worth a division
    bits: int

    def __getitem__(self, place: int) -> Enclosure:
        return Enclosure(self.lower[place], self.upper[place], self.bits)

    def cut(self, place: int, low: int, high: int) -> None:
        """Cut a value, or raise Empty."""
        low, high = max(low, self.lower[place]), min(high, self.upper[place])
        if low > high:
            raise Empty
        self.lower[place], self.upper[place] = low, high

    def undo(self, step: Step) -> None:
        """Cut the arguments of an operation by its value."""
        place, op, i, j, node = step
        lower, upper = self.lower, self.upper
        low, high = lower[place], upper[place]
        if op == "+":
            self.cut(i, low - upper[j], high - lower[j])
            self.cut(j, low - upper[i], high - lower[i])
        elif op == "-":
            self.cut(i, low + lower[j], high + upper[j])
            self.cut(j, lower[i] - high, upper[i] - low)
        elif op == "negative":
            self.cut(i, -high, -low)
        elif op == "^" and node.datum == 2:
            self._cut(i, _roots(self[i], self[place]))
        elif op == "/":
            self._cut(i, self[place] * self[j])
        elif op == "*":
            for one, other in ((i, j), (j, i)):
                if one not in self.fixed and not self[other].has_zero:
                    self._cut(one, self[place] / self[other])

    def _cut(self, place: int, x: Enclosure) -> None:
        self.cut(place, x.lo, x.hi)


def _roots(x: Enclosure, square: Enclosure) -> Enclosure:
    """Return what holds all numbers of x whose squares are in an enclosure."""
    root = sqrt(meet(square, Enclosure(0, max(0, square.hi), square.bits)))
    if x.lo > -root.lo:
        return root
    return -root if x.hi < root.lo else root.hull(-root)
