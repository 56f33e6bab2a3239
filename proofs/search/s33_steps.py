"""Proof steps of the map with restitution: each proves something and records its witness.

The steps are those of `s33_restitution.rules`, by the same names.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise, product
from typing import Any

from intervals import DomainError, Undecided
from proofs.motion.restitution import Rebounds, next_impact
from proofs.motion.system import System
from proofs.search.s33_rectangles import Sets, state_after
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.rebound_boxes import with_side
from proofs.trusted.paper.s33_restitution.rebound_facts import FULL, oscillator
from proofs.trusted.paper.s33_restitution.rebounds import (
    BarredWord,
    Box,
    Rebound,
    Rectangle,
    Unjoined,
    barred,
    horseshoe,
    rectangle,
)
from proofs.trusted.parameters import Parameters

_WIDEST = Fraction(1, 32)  # of a part of a rectangle, in phase
_NARROWEST = Fraction(1, 256)
_LONGEST = 8  # symbols of a barred word
_FINEST = 8  # parts of a step
_MOST_SLABS = 40


@dataclass
class ReboundProver:
    """Collects steps about impacts with restitution, and the conclusions they reach."""

    of: Parameters
    plain: Prover
    rebounds: dict[str, Rebound] = field(default_factory=dict)
    rectangles: dict[str, Rectangle] = field(default_factory=dict)
    words: dict[str, BarredWord] = field(default_factory=dict)

    @property
    def steps(self) -> dict[str, dict[str, Any]]:
        """The steps so far."""
        return self.plain.steps

    @property
    def velocities(self) -> Range:
        """The velocities of the statement's rectangles."""
        if self.of.velocities is None:
            raise Undecided("no range of velocities is given")
        return self.of.velocities

    # -- steps ---------------------------------------------------------------------------------

    def rebound(self, box: Box, phases: Range, velocities: Range) -> tuple[str, Rebound]:
        """Prove the next impact of all states of a box (rule rebound), once."""
        for name, known in self.rebounds.items():
            if (known.box, known.phases, known.velocities) == (box, phases, velocities):
                return name, known
        eta, nu = ((low + high) / 2 for low, high in box[:2])
        flight = Rebounds(
            System(eta, nu),
            phases,
            velocities=velocities,
            epsilon=box[2],
            eta_reach=box[0][1] - eta,
            nu_reach=box[1][1] - nu,
        )
        found = next_impact(flight, bits=self.plain.bits, horizon=self.plain.horizon)
        name = self.plain.add(
            "rebound",
            {
                **_box(box, phases, velocities),
                "times": texts(found.found.times[1:]),
                "impact": texts(found.flight),
            },
        )
        known = Rebound(
            box, phases, velocities, found.turns, found.phase, found.velocity, found.derivative
        )
        self.rebounds[name] = known
        return name, known

    def parts(self, box: Box, cuts: Sequence[Fraction]) -> list[str]:
        """Prove impacts on parts between cuts, in order, each halved while it must be."""
        names, rest = [], list(reversed(list(pairwise(cuts))))
        while rest:
            low, high = rest.pop()
            try:
                if high - low > _WIDEST:
                    raise Undecided("wider than it is worth to try")
                names.append(self._part(box, (low, high)))
            except (Undecided, DomainError):
                if high - low <= _NARROWEST:
                    raise
                middle = (low + high) / 2
                rest += [(middle, high), (low, middle)]
        return names

    def _part(self, box: Box, phases: Range) -> str:
        """Prove the impacts of a part; Undecided also where its images leave the velocities."""
        steps = dict(self.plain.steps)
        name, found = self.rebound(box, phases, self.velocities)
        if not self.velocities[0] < found.velocity[0] <= found.velocity[1] < self.velocities[1]:
            self.plain.steps = steps
            del self.rebounds[name]
            raise Undecided("an image velocity may leave the rectangles")
        return name

    def rectangle(self, box: Box, phases: Range, cuts: Sequence[Fraction]) -> str:
        """Prove what F does on a rectangle (rule rectangle), from parts between the cuts, once."""
        (low, high), velocities = phases, self.velocities
        for name, known in self.rectangles.items():
            if (known.box, known.phases) == (box, phases):
                return name
        edges = [self.rebound(box, (end, end), velocities)[0] for end in phases]
        names = edges + [
            name
            for name, one in self.rebounds.items()
            if (one.box, one.velocities) == (box, velocities)
            and max(low, one.phases[0]) < min(high, one.phases[1])
        ]
        try:
            joined = rectangle(self.named(names), box, phases, velocities)
        except Unjoined:
            inner = (cut for cut in cuts if low < cut < high)
            names = edges + self.parts(box, [low, *inner, high])
            joined = rectangle(self.named(names), box, phases, velocities)
        witness = {"impacts": names, **_box(box, phases, self.velocities)}
        name = self.plain.add("rectangle", witness)
        self.rectangles[name] = joined
        return name

    def pair(self, box: Box, sets: tuple[Range, Range], cuts: Sequence[Fraction]) -> list[str]:
        """Prove what F does on two rectangles; nothing is recorded of an attempt that fails."""
        before = dict(self.plain.steps)
        try:
            return [self.rectangle(box, phases, cuts) for phases in sets]
        except (Undecided, DomainError, Unjoined):
            self.forget(before)
            raise

    def forget(self, steps: dict[str, dict[str, Any]]) -> None:
        """Go back to earlier steps."""
        self.plain.steps = steps
        for known in (self.rebounds, self.rectangles, self.words):
            for name in [name for name in known if name not in steps]:
                del known[name]

    def named(self, names: Sequence[str]) -> list[Rebound]:
        """Return conclusions by their names."""
        return [self.rebounds[name] for name in names]

    # -- the printed rectangles ----------------------------------------------------------------

    def bar(self, pair: Sequence[str], word: tuple[int, ...], sign: int) -> str:
        """Prove that no orbit follows a word (rule barred-word); Unjoined if one seems to."""
        rectangles = (self.rectangles[pair[0]], self.rectangles[pair[1]])
        about = rectangles[0].box, tuple(one.phases for one in rectangles), word
        for name, known in self.words.items():
            if (known.box, known.sets, known.word) == about:
                return name
        before = dict(self.plain.steps)
        far = 1 if sign > 0 else 0
        extreme, gammas = rectangles[word[0]].phases[far], self.velocities
        names, bounds = [], []
        for symbol in word[:-1]:
            here = rectangles[symbol]
            end = here.phases[far]
            bounds.append(sign * min(sign * end, sign * _outward(extreme, sign)))
            try:
                name, image = self.rebound(here.box, (bounds[-1], bounds[-1]), gammas)
            except (Undecided, DomainError) as failure:
                self.forget(before)
                raise Unjoined(str(failure)) from None
            names.append(name)
            extreme = image.phase[far]
            gammas = _outward(here.velocity[0], -1), _outward(here.velocity[1], 1)
        names = list(dict.fromkeys(names))
        try:
            found = barred(self.named(names), rectangles, word, bounds, sign)
        except Unjoined:
            self.forget(before)
            raise
        witness = {
            "impacts": names,
            "rectangles": list(pair),
            "word": "".join(map(str, word)),
            "bounds": texts(bounds),
            "from": "above" if sign > 0 else "below",
        }
        name = self.plain.add("barred-word", witness)
        self.words[name] = found
        return name

    def constant_word(self, pair: Sequence[str], symbols: Sequence[int] = (0, 1)) -> str:
        """Prove that no orbit follows some word of one symbol, the shortest that will do."""
        for length, symbol, sign in product(range(2, _LONGEST + 1), symbols, (1, -1)):
            with suppress(Unjoined):
                return self.bar(pair, (symbol,) * length, sign)
        raise Unjoined("no word of one symbol is excluded")

    def missing_word(self, pair: Sequence[str]) -> str:
        """Prove that no orbit follows some word of one symbol, but perhaps for the first."""
        with suppress(Unjoined):
            return self.constant_word(pair)
        for length, start in product(range(2, _LONGEST + 1), (0, 1)):
            with suppress(Unjoined):
                return self.bar(pair, (start,) + (1 - start,) * (length - 1), 1 - 2 * start)
        raise Unjoined("no word is excluded")

    def corners(self, box: Box, sets: Sets) -> list[str]:
        """Prove impacts of the corners that decide whether the edges go beyond both sets."""
        low, high = self.velocities
        names = []
        for phi, gamma in (state for a, b in sets for state in ((a, high), (b, low))):
            with suppress(Undecided, DomainError):
                names.append(self.rebound(box, (phi, phi), (gamma, gamma))[0])
        return names

    def refuting_states(self, box: Box, sets: Sets) -> list[str]:
        """Prove impacts of corners of rectangles whose images seem to be between the outer edges.

        One corner of each edge that has such, with the velocity that makes it fail most.
        """
        names = []
        eta, nu, epsilon = (float(low) for low, _ in box)
        for ends in sets:
            for end, wanted in zip(ends, (max, min), strict=True):
                images = {
                    image[0]: gamma
                    for gamma in self.velocities
                    if (image := state_after(eta, nu, epsilon, (float(end), float(gamma))))
                }
                if images and sets[0][0] < wanted(images) < sets[1][1]:
                    gamma = images[wanted(images)]
                    names.append(self.rebound(box, (end, end), (gamma, gamma))[0])
        return names

    def never_repeats(self, pair: Sequence[str], right: Range) -> list[str]:
        """Prove that full orbits do not repeat V2, and what F does on the part N of V2."""
        box = self.rectangles[pair[0]].box
        part = self.rectangle(box, right, ())
        words = [self.bar(pair, word, 1) for word in ((0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1))]
        return [*pair, part, *words, self.constant_word(pair, (1,))]

    # -- ranges of parameters ------------------------------------------------------------------

    def horseshoe(self, box: Box, sets: Sets, cuts: Sequence[Fraction] = ()) -> list[str]:
        """Prove that F maps both rectangles across both; nothing is left of a failed attempt."""
        before = dict(self.plain.steps)
        try:
            for ends in sets:
                low, high = (
                    self.rebound(box, (end, end), self.velocities)[1].phase for end in ends
                )
                if low[1] >= sets[0][0] or high[0] <= sets[1][1]:
                    raise Unjoined("an edge is not mapped beyond the rectangles")
            names = [self.rectangle(box, phases, cuts) for phases in sets]
            horseshoe((self.rectangles[names[0]], self.rectangles[names[1]]), FULL)
        except (Undecided, DomainError, Unjoined) as failure:
            self.forget(before)
            raise Unjoined(str(failure)) from None
        return names

    def ranges(self, box: Box, sets: Sets, side: int, step: Fraction) -> list[str]:
        """Extend a side of a box in steps while horseshoes are proved, then in smaller ones.

        side: 1 (nu) or 2 (epsilon). Beyond, at the exact parameters but for that side, states are
        looked for and proved with which the theorem fails.
        """
        names: list[str] = []
        reach, size = box[side][0] if step < 0 else box[side][1], step
        while abs(size) >= abs(step) / _FINEST and len(names) < _MOST_SLABS:
            low, high = sorted((reach, reach + size))
            try:
                names += self.horseshoe(with_side(box, side, (low, high)), sets)
                reach += size
            except (Unjoined, ValueError):
                size /= 2
        exact = oscillator(self.of)
        for count in range(1, _MOST_SLABS):
            value = reach + count * step / _FINEST
            if exact is not None and abs(value) < 1:
                states = self.refuting_states(with_side(exact, side, (value, value)), sets)
                if states:
                    return names + states
        return names


def _outward(value: Fraction, sign: int) -> Fraction:
    """Round up (sign 1) or down to four decimal places."""
    return sign * -Fraction(-sign * value * 10**4 // 1, 10**4)


def _box(box: Box, phases: Range, velocities: Range) -> dict[str, list[str]]:
    sides = (*box, phases, velocities)
    names = ("eta", "nu", "epsilon", "phases", "velocities")
    return {name: texts(side) for name, side in zip(names, sides, strict=True)}
