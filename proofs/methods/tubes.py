"""Initial value problems: enclosures at times, by the rule `image`, and a tube around all times.

What a certificate holds are the enclosures at times. A tube is the checker's own enclosure of the
solutions in between, step by step; it is proved here, and in no file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.trusted.certificate import text, texts
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Box, enclosed
from proofs.trusted.kernel.flow import Flow
from proofs.trusted.kernel.lohner import Solutions, Step
from proofs.trusted.kernel.section import Fate, Journey
from proofs.trusted.numbers import Range, decimals, hull

_BITS = 64
_PARTS = 8  # of a step


def prove_states(
    function: Mapping[str, Any], times: Sequence[Fraction], box: Box
) -> tuple[Derivation, list[str]]:
    """Enclose the states of a flow that begins in a box at some times, a step `image` each.

    function: the flow as a certificate has it, whatever its end. Raises Undecided with the time up
    to which the solutions are followed.
    """
    names = [f"X{k}" for k in range(1, len(times) + 1)]
    file = Derivation({x: to_time(function, t) for x, t in zip(names, times, strict=True)})
    steps = []
    for name in names:
        try:
            values = file.map(name).values(enclosed(box, _BITS))
        except Unproved as error:
            raise Undecided(str(error)) from None
        witness = {"function": name, "box": list(map(texts, box)), "tree": None}
        bounds = [decimal_ends(value.range) for value in values]
        steps.append(file.add("image", {**witness, "bounds": bounds}))
    return file, steps


def to_time(function: Mapping[str, Any], time: Fraction) -> dict[str, Any]:
    """Return a flow that ends at a time, in its states."""
    kept = {key: value for key, value in function.items() if key != "periods"}
    return {**kept, "end": {"time": text(time)}, "values": list(function["state"])}


def decimal_ends(side: Range) -> list[str]:
    """Write both ends of an enclosure, rounded outward."""
    ends = decimals(side) if side[0] < side[1] else side
    return texts((Fraction(ends[0]), Fraction(ends[1])))


class Piece(NamedTuple):
    """All solutions are in the box at all of these times."""

    time: Range
    box: Box


@dataclass(frozen=True)
class Tube:
    """Where the solutions are at all times up to `until`, proved.

    steps: those of the checker, with the times at which they begin. reason: why it is not proved
    how the solutions go on, if they are not followed up to the time that was asked for.
    """

    names: tuple[str, ...]
    solutions: Solutions
    steps: tuple[tuple[Fraction, Step], ...]
    until: Fraction
    reason: str = ""

    def at(self, first: Fraction, last: Fraction | None = None) -> Box:
        """Enclose the states at a time, or at all times between two; ValueError beyond the tube."""
        end = first if last is None else last
        if not 0 <= first <= end <= self.until:
            raise ValueError(f"times from 0 to {float(self.until):.6g} are those of the tube")
        here = [
            self._during(begin, step, max(first, begin), min(end, begin + step.h))
            for begin, step in self.steps
            if begin <= end and first <= begin + step.h
        ]
        return tuple(map(hull, zip(*here, strict=True)))

    def _during(self, begin: Fraction, step: Step, first: Fraction, last: Fraction) -> Box:
        """Enclose the states between two times of a step."""
        part = Enclosure.of((first - begin) / step.h, (last - begin) / step.h, self.solutions.bits)
        return tuple(x.range for x in self.solutions.at(step, part).all)

    def pieces(self, parts: int = _PARTS) -> list[Piece]:
        """Return the tube in pieces, so many of each step."""
        cuts = [begin + step.h * k / parts for begin, step in self.steps for k in range(parts)]
        cuts = [*(cut for cut in cuts if cut < self.until), *[self.until] * bool(cuts)]
        return [Piece(times, self.at(*times)) for times in pairwise(cuts)]


@dataclass
class _Recorded(Journey):
    """Solutions on their way, with all steps that are proved."""

    steps: list[tuple[Fraction, Step]] = field(default_factory=list)

    def _move(self, step: Step, fate: Fate) -> None:
        self.steps.append((self.time, step))
        super()._move(step, fate)


def tube(function: Mapping[str, Any], until: Fraction, box: Box) -> Tube:
    """Follow the solutions of a flow that begin in a box up to a time, or as far as is proved."""
    flow = Derivation({"X": to_time(function, until)}).map("X")
    if not isinstance(flow, Flow):
        raise TypeError("a tube is that of a flow")
    begun = flow.journey([*enclosed(box, _BITS), *enclosed(flow.ranges, _BITS)])
    journey, reason = _Recorded(begun.solutions, begun.section, begun.now), ""
    try:
        journey.arrive()
    except Unproved as error:
        reason = str(error)
    reached = min(journey.steps[-1][0] + journey.steps[-1][1].h, until) if journey.steps else 0
    names = tuple(function["state"])
    return Tube(names, begun.solutions, tuple(journey.steps), Fraction(reached), reason)
