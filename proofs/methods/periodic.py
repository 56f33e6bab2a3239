"""All periodic orbits of a formula in a box, concluded by the checker's rule `periodic-orbits`.

The rule searches the box for orbits that a witness does not list. The witness comes from Newton's
method in floating point; where that misses some, from the same search: with nothing listed it
leaves small tubes, and Newton's method leads from each to an orbit.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from typing import cast

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.grammar import typed
from proofs.methods.lemmas import dot, inverse, middles, undecided, written
from proofs.methods.newton import cycles, seeds
from proofs.methods.sampling import Sampled
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.covers import Rows, images
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.kernel.periodic import Closing, Search
from proofs.trusted.numbers import Range, show, within

_STARTS = 400  # points at random for each period
_SMALLEST = 1 << 40  # side of a tube from which Newton's method begins, in 2^-64 of the box's
_STEPS, _BITS = 30, 160  # of Newton's method
_PLACE, _RADIUS = Fraction(1, 10**26), Fraction(1, 10**22)  # of points
_EDGE = 2 * _RADIUS  # about points: what is so near to a side of the box is on it
_SAME = 15  # decimal places of points that are told apart

Point = tuple[Fraction, ...]


def prove_all_orbits(
    file: Derivation, function: str, period: int, box: Sequence[Range], work: int = DEFAULT
) -> str:
    """Add a step `periodic-orbits`: all orbits of a formula in a box whose period divides one.

    Raises Undecided where an orbit is not isolated, or at the edge, or the rule does not conclude
    within some work.
    """
    formula = file.map(function)
    if not isinstance(formula, Formulas) or formula.circles or formula.ranges:
        raise Undecided(
            "all orbits are found for formulas without angles and ranges alone: give parameters "
            "one value; leave out the period of an angle, so that those that stay in one box are "
            f"found; or ask orbits:{period}, for those that are seen"
        )
    if not isinstance(period, int) or period < 1:
        raise ValueError(f"a period is a whole number from 1 on, not {period!r}")
    if any(low == high for low, high in box):
        raise ValueError("a side of the box is a point: give it two ends")
    orbits = Orbits(file, function, period, tuple(box))
    try:
        with metered(work):
            with suppress(Unproved, Undecided):
                for start, n in _seen(formula, period, box):
                    orbits.add(start, n)
                return orbits.prove()
            with undecided():
                for tube in Search(formula, tuple(box), period, ()).open_tubes(_SMALLEST):
                    orbits.add(middles(tube[0]), period)
                return orbits.prove()
    except Exhausted:
        raise Undecided(
            "it takes too long to prove that there are no others: some may be next to each other, "
            "or not isolated; give a smaller box, or a smaller period"
        ) from None


def _seen(formula: Formulas, period: int, box: Sequence[Range]) -> Iterator[tuple[Point, int]]:
    """Yield points to which Newton's method leads in floating point, and their least periods."""
    sampled = Sampled(formula)
    for n in (n for n in range(1, period + 1) if period % n == 0):
        for cycle in cycles(sampled, n, seeds(sampled, box, _STARTS * n)):
            yield tuple(map(Fraction, cycle.points[0].tolist())), n


@dataclass
class Orbits:
    """Orbits in a box whose period divides one: as the rule reads them, by their rounded points."""

    file: Derivation
    function: str
    period: int
    box: tuple[Range, ...]
    listed: dict[Point, dict[str, object]] = field(default_factory=dict)

    def add(self, start: Point, n: int) -> None:
        """Add the orbit of a period to which Newton's method leads, if it is in the box.

        Raises Undecided where it leads to none, or to one at an edge.
        """
        formula = cast(Formulas, self.file.map(self.function))
        point, matrix = _fixed(formula, n, start)
        orbit = [middles(x) for x in images(formula, _precise(point), n)]
        _require_no_edge(formula, orbit, self.box)
        names = {tuple(round(x, _SAME) for x in each) for each in orbit}
        if len(names) < n:
            self.add(point, len(names))
        elif all(_lies_in(each, self.box) for each in orbit):
            rows = list(map(texts, matrix))
            self.listed[min(names)] = {"point": texts(point), "period": str(n), "matrix": rows}

    def prove(self) -> str:
        """Add the step that there are no others; raises Unproved."""
        witness = {"function": self.function, "period": str(self.period), "box": written(self.box)}
        orbits = [self.listed[name] for name in sorted(self.listed)]
        numbers = {"radius": str(_RADIUS), "orbits": orbits}
        return self.file.add("periodic-orbits", {**witness, **numbers})


def _require_no_edge(formula: Formulas, orbit: Sequence[Point], box: Sequence[Range]) -> None:
    """Raise Undecided where a point of an orbit in the box is next to an edge of it."""
    if all(_lies_in(point, [(a - _EDGE, b + _EDGE) for a, b in box]) for point in orbit):
        for point in orbit:
            for name, x, side in zip(formula.variables, point, box, strict=True):
                if end := [end for end in side if abs(x - end) < _EDGE]:
                    raise Undecided(
                        f"a periodic point is on the edge {typed(name)} = {show(end[0])} of the "
                        "box, as far as is seen: give a box a little wider, or narrower, there"
                    )


def _lies_in(point: Point, box: Sequence[Range]) -> bool:
    return all(within((x, x), side) for x, side in zip(point, box, strict=True))


def _precise(point: Point) -> list[Enclosure]:
    return enclosed(point_box(point), _BITS)


def _fixed(formula: Formulas, period: int, start: Point) -> tuple[Point, Rows]:
    """Return about a fixed point of an iterate, and the inverse of the derivative less 1 there."""
    point, closing = start, Closing(formula, period)
    for _ in range(_STEPS):
        x = _precise(point)
        slopes = tuple(middles(row) for row in closing.jacobian(x))
        try:
            rows = inverse(slopes)
        except Undecided:
            break
        matrix = tuple(tuple(Fraction(f"{float(x):.10g}") for x in row) for row in rows)
        missed = middles(closing.values(x))
        before, moved = point, (x - dot(row, missed) for x, row in zip(point, matrix, strict=True))
        point = tuple(round(x / _PLACE) * _PLACE for x in moved)
        if point == before:
            return point, matrix
    place = ", ".join(f"{float(x):.9g}" for x in start)
    raise Undecided(f"whether there is a periodic point near ({place}), or many: not isolated")
