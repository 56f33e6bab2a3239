"""Proof steps of the map with restitution: each proves something and records its witness.

Impacts are looked for as in `steps`; what follows from them, by the theorems of `s33_restitution`
themselves, applied to the conclusions reached here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from typing import Any, TypeVar

from intervals.errors import Undecided
from proofs.motion.brackets import transversal_impact
from proofs.motion.witness import FlightBox
from proofs.search.evidence import FAILED, concluded
from proofs.search.rebound import witness
from proofs.search.s33_rectangles import Sets, image_phases, state_after
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.cones import PLAIN
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, RectangleMap
from proofs.trusted.parameters import Parameters, Place

C = TypeVar("C", bound=Conclusion)
Box = tuple[Range, Range]  # phases x velocities
Fits = Callable[[Rebound], bool]
ImagesOf = Callable[[Place, Fraction, Range], Range]  # phases after one phase and velocities
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
    known: dict[str, Conclusion] = field(default_factory=dict)
    _names: dict[object, str] = field(default_factory=dict)  # some of steps that were taken back

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

    def all(self, kind: type[C], at: Place) -> list[tuple[str, C]]:
        """Return the conclusions of a kind about these oscillators, with their names."""
        return [(k, x) for k, x in self.known.items() if type(x) is kind and x.place == at]

    def get(self, name: str, kind: type[C]) -> C:
        """Return a conclusion by its name."""
        found = self.known[name]
        if not isinstance(found, kind):
            raise TypeError(f"{name} is no {kind.__name__}")
        return found

    @contextmanager
    def attempt(self) -> Iterator[None]:
        """Do something; nothing is recorded of it if it fails, and failures are Unproved."""
        steps, known = dict(self.steps), dict(self.known)
        try:
            yield
        except FAILED as failure:
            self.plain.steps, self.known = steps, known
            raise Unproved(str(failure)) from None

    # -- steps ---------------------------------------------------------------------------------

    def rebound(self, at: Place, phases: Range, velocities: Range) -> tuple[str, Rebound]:
        """Prove the next impact of all states of a box (rule rebound), once."""
        wanted = at, phases, velocities
        known = self.known.get(self._names.get(wanted, ""))
        if type(known) is not Rebound or (known.at, known.phases, known.velocities) != wanted:
            make = partial(self._rebound, at, phases, velocities)
            self._names[wanted] = self.plain.seen_or_proved(make)
        return self._names[wanted], self.get(self._names[wanted], Rebound)

    def _rebound(self, at: Place, phases: Range, velocities: Range, floats: bool) -> str:
        flights = FlightBox(at.sides, phases, velocities)
        found, time = transversal_impact(
            flights, self.plain.bits, horizon=self.plain.horizon, floats=floats
        )
        return self.derive("rebound", **witness(flights, found.times, time))

    def derive(self, rule: str, **witness: Any) -> str:
        """Prove a step from earlier ones, by the theorem itself; once."""
        step = {"rule": rule, "witness": witness}
        name = self._names.get(repr(step), "")
        if self.steps.get(name) != step:
            conclusion = concluded(rule, witness, Context(self.of, {}, self.known))
            name = self._names[repr(step)] = self.plain.add(rule, witness)
            self.known[name] = conclusion
        return name

    def rectangle(self, at: Place, phases: Range, cuts: Sequence[Fraction]) -> str:
        """Prove what F does on a rectangle, from parts that are known, or else between the cuts."""
        for name, known in self.all(RectangleMap, at):
            if known.phases == phases:
                return name
        if parts := self._chain(at, phases):
            return self._joined(at, (phases, self.velocities), parts)
        return self.cut_rectangle(at, (phases, self.velocities), cuts, self._stays)

    def cut_rectangle(self, at: Place, box: Box, cuts: Sequence[Fraction], fits: Fits) -> str:
        """Prove what F does on a rectangle, in parts that fit, between the cuts or finer."""
        low, high = box[0]
        inner = (cut for cut in cuts if low < cut < high)
        return self._joined(at, box, self._parts(at, [low, *inner, high], box[1], fits))

    def _joined(self, at: Place, box: Box, parts: list[str]) -> str:
        edges = [self.rebound(at, (end, end), box[1])[0] for end in box[0]]
        return self.derive("rectangle", parts=parts, edges=edges)

    def _chain(self, at: Place, phases: Range) -> list[str]:
        """Return known parts, one after the other, that cover the phases; or none."""
        names, reach = [], phases[0]
        wide = [(k, x) for k, x in self.all(Rebound, at) if x.velocities == self.velocities]
        while reach < phases[1]:
            onward = [(x.phases[1], k) for k, x in wide if x.phases[0] <= reach < x.phases[1]]
            if not onward:
                return []
            reach, name = max(onward)
            names.append(name)
        return names

    def _parts(
        self, at: Place, cuts: Sequence[Fraction], velocities: Range, fits: Fits
    ) -> list[str]:
        """Prove impacts on parts between cuts, in order, each halved while it must be."""
        names, rest = [], list(reversed(list(pairwise(cuts))))
        while rest:
            low, high = rest.pop()
            try:
                if high - low > _WIDEST:
                    raise Undecided("wider than it is worth to try")
                with self.attempt():
                    name, found = self.rebound(at, (low, high), velocities)
                    if not fits(found):
                        raise Undecided("images or derivatives do not fit")
                    names.append(name)
            except FAILED:
                if high - low <= _NARROWEST:
                    raise
                middle = (low + high) / 2
                rest += [(middle, high), (low, middle)]
        return names

    def _stays(self, found: Rebound) -> bool:
        """Whether image velocities stay in the rectangles."""
        low, high = self.velocities
        return low < found.velocity[0] <= found.velocity[1] < high

    def pair(self, at: Place, sets: Sets, cuts: Sequence[Fraction] = ()) -> list[str]:
        """Prove what F does on two rectangles."""
        with self.attempt():
            return [self.rectangle(at, phases, cuts) for phases in sets]

    def horseshoe(self, at: Place, sets: Sets, cuts: Sequence[Fraction] = ()) -> str:
        """Prove that F maps both rectangles across both."""
        with self.attempt():
            for ends in sets:
                low, high = sorted(
                    self.rebound(at, (end, end), self.velocities)[1].phase for end in ends
                )
                short = max(low[1] - sets[0][0], sets[1][1] - high[0])
                if short >= 0:
                    raise Unproved(f"an edge may fall short by up to {float(short):.6g}")
            pair = self.pair(at, sets, cuts)
            return self.derive("rectangle-horseshoe", rectangles=pair, cone=texts(PLAIN))

    # -- words ---------------------------------------------------------------------------------

    def bar(self, pair: Sequence[str], word: Sequence[int], above: bool) -> str:
        """Prove that no orbit follows a word, if floats agree."""
        maps, images = [self.get(name, RectangleMap) for name in pair], list[str]()

        def proved(at: Place, bound: Fraction, gammas: Range) -> Range:
            name, image = self.rebound(at, (bound, bound), gammas)
            images.append(name)
            return image.phase

        low, high = maps[word[-1]].phases
        seen = self._extreme(maps, word, above, _seen_images)
        if seen >= low if above else seen <= high:
            raise Unproved("in floating point an orbit follows the word")
        with self.attempt():
            self._extreme(maps, word, above, proved)
            return self.derive(
                "barred-word",
                rectangles=list(pair),
                word="".join(map(str, word)),
                images=images,
                **{"from": "above" if above else "below"},
            )

    def _extreme(
        self, maps: Sequence[RectangleMap], word: Sequence[int], above: bool, images: ImagesOf
    ) -> Fraction:
        """Return how far states come along a word, bounds rounded outward to four places."""
        extreme, gammas = maps[word[0]].phases[above], self.velocities
        for symbol in word[:-1]:
            here = maps[symbol]
            low, high = here.phases
            bound = min(high, _up(extreme)) if above else max(low, -_up(-extreme))
            extreme = images(here.at, bound, gammas)[above]
            gammas = -_up(-here.velocity[0]), _up(here.velocity[1])
        return extreme

    def constant_word(self, pair: Sequence[str], symbols: Sequence[int] = (0, 1)) -> str:
        """Prove that no orbit follows some word of one symbol, the shortest that will do."""
        for length, symbol, above in product(range(2, _LONGEST + 1), symbols, (True, False)):
            with suppress(Unproved):
                return self.bar(pair, (symbol,) * length, above)
        raise Unproved("no word of one symbol is excluded")

    def missing_word(self, pair: Sequence[str]) -> str:
        """Prove that no orbit follows some word of one symbol, but perhaps for the first."""
        with suppress(Unproved):
            return self.constant_word(pair)
        for length, start in product(range(2, _LONGEST + 1), (0, 1)):
            with suppress(Unproved):
                return self.bar(pair, (start,) + (1 - start,) * (length - 1), start == 0)
        raise Unproved("no word is excluded")

    def never_repeats(self, pair: Sequence[str], right: Range) -> str:
        """Prove that full orbits do not repeat V2, by what F does on a part N of V2."""
        with self.attempt():
            part = self.rectangle(self.get(pair[0], RectangleMap).at, right, ())
            words = [
                self.bar(pair, word, True) for word in ((0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1))
            ]
            words.append(self.constant_word(pair, (1,)))
            return self.derive("golden-mean", rectangles=list(pair), part=part, words=words)

    # -- states on edges -----------------------------------------------------------------------

    def corners(self, at: Place, sets: Sets, *, short: bool = False) -> list[str]:
        """Prove, for each edge, the impact of the corner that seems to overshoot least.

        short: only of those whose images seem to be between the outer edges.
        """
        names = []
        eta, nu, epsilon = (float(low) for low, _ in at.sides)
        edges = [(end, least) for ends in sets for end, least in zip(ends, (max, min), strict=True)]
        for end, least in edges:
            images = {
                image[0]: gamma
                for gamma in self.velocities
                if (image := state_after(eta, nu, epsilon, (float(end), float(gamma))))
            }
            if images and (not short or sets[0][0] < least(images) < sets[1][1]):
                gamma = images[least(images)]
                with suppress(*FAILED):
                    names.append(self.rebound(at, (end, end), (gamma, gamma))[0])
        return names

    # -- ranges of parameters ------------------------------------------------------------------

    def slabs(self, at: Place, sets: Sets, side: str, step: Fraction) -> list[str]:
        """Prove horseshoes beyond a side of a box in steps, then in smaller ones, while it goes."""
        names: list[str] = []
        low, high = getattr(at, side)
        size = step
        while abs(size) >= abs(step) / _FINEST and len(names) < _MOST_SLABS:
            slab = (high, high + size) if step > 0 else (low + size, low)
            try:
                names.append(self.horseshoe(replace(at, **{side: slab}), sets))
            except (Unproved, ValueError):
                size /= 2
            else:
                low, high = min(low, slab[0]), max(high, slab[1])
        return names

    def beyond(
        self, at: Place, sets: Sets, side: str, begin: Fraction, step: Fraction
    ) -> list[str]:
        """Prove states with which the horseshoe fails, at the first parameters that have such."""
        for count in range(1, _MOST_SLABS):
            value = begin + count * step / _FINEST
            if abs(value) < 1:
                states = self.corners(replace(at, **{side: (value, value)}), sets, short=True)
                if states:
                    return states
        return []


def _seen_images(at: Place, phase: Fraction, velocities: Range) -> Range:
    """Return about the least and the greatest next phase."""
    seen = image_phases(at, velocities)(phase)
    if seen is None:
        raise Unproved("in floating point a state sticks, or never impacts")
    return Fraction(seen[0]), Fraction(seen[1])


def _up(value: Fraction) -> Fraction:
    """Round up to four decimal places."""
    return -Fraction(-value * 10**4 // 1, 10**4)
