"""Proof steps of the map with restitution: each proves something and records its witness.

The general rules prove it of the oscillator's flight; floats see what is worth to be tried.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from typing import Any, TypeVar

from intervals.errors import Undecided
from proofs.motion.simulate import landing
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import FAILED
from proofs.search.s33_rectangles import Sets, image_phases, state_after
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion, place_of
from proofs.trusted.kernel.differential import BITS, Differential, differential_on
from proofs.trusted.kernel.rates import PLAIN, Cone
from proofs.trusted.kernel.rectangles import Rectangle
from proofs.trusted.numbers import Range
from proofs.trusted.oscillator import Oscillator
from proofs.trusted.paper.s33_restitution.rectangles import ALL
from proofs.trusted.parameters import Parameters, Place

C = TypeVar("C", bound=Conclusion)
Box = tuple[Range, ...]  # phases x velocities
Fits = Callable[[Differential], bool]
_WIDEST = Fraction(1, 32)  # of a part of a rectangle, in phase
_NARROWEST = Fraction(1, 256)
_LONGEST = 8  # symbols of a barred word
_FINEST = 8  # parts of a step
_MOST_SLABS = 40
_ROOM = 40  # bits beyond those of a result


class ReboundProver(Prover):
    """Adds steps about impacts with restitution to those of the plastic map."""

    def __init__(self, statement: Parameters, digits: int) -> None:
        super().__init__(System(statement.eta, statement.nu), digits, HORIZON)
        self.of = self.context.parameters = statement
        self._names = dict[str, str]()  # of steps, some of which may have been taken back

    @property
    def velocities(self) -> Range:
        """The velocities of the statement's rectangles."""
        if self.of.velocities is None:
            raise Undecided("no range of velocities is given")
        return self.of.velocities

    def get(self, name: str, kind: type[C]) -> C:
        """Return a conclusion by its name."""
        conclusion = self.known[name]
        if not isinstance(conclusion, kind):
            raise TypeError(f"{name} is no {kind.__name__}")
        return conclusion

    @contextmanager
    def attempt(self) -> Iterator[None]:
        """Do something; nothing is recorded of it if it fails, and failures are Unproved."""
        try:
            with self.undone():
                yield
        except FAILED as failure:
            raise Unproved(str(failure)) from None

    # -- steps ---------------------------------------------------------------------------------

    def derive(self, rule: str, witness: dict[str, Any], kind: str = "") -> tuple[str, Any]:
        """Add a step, once; return its name, with what it concludes."""
        step = {"rule": rule, "witness": witness}
        name = self._names.get(repr(step), "")
        if self.steps.get(name) != step:
            name = self._names[repr(step)] = self.add(rule, witness, kind)
        return name, self.known[name]

    def state(self, at: Place, box: Box, bits: int = BITS) -> tuple[str, Differential]:
        """Prove the next impact of all states of a box (rule differential), once."""
        witness = {
            "function": function_of(at),
            "box": [texts(side) for side in box],
            "turns": [turns_of(at, box)],
            "bits": str(bits),
        }
        return self.derive("differential", witness)

    def rectangle(self, at: Place, phases: Range, cuts: Sequence[Fraction] = ()) -> str:
        """Prove what F does on a rectangle, in parts between the cuts or finer."""
        return self.cut_rectangle(at, (phases, self.velocities), cuts, self._stays)

    def cut_rectangle(self, at: Place, box: Box, cuts: Sequence[Fraction], fits: Fits) -> str:
        """Prove what F does on a rectangle, in parts that fit, between the cuts or finer."""
        (low, high), turns = box[0], turns_of(at, box)
        inner = _finer([low, *(cut for cut in cuts if low < cut < high), high])
        while True:
            try:
                witness = {
                    "function": function_of(at),
                    "box": [texts(side) for side in box],
                    "cuts": texts(inner[1:-1]),
                    "turns": [turns],
                }
                name, rectangle = self.derive("rectangle", witness)
                wide = [part.box[0] for part in rectangle.parts if not fits(part)]
            except FAILED:
                wide = [part for part in pairwise(inner) if not _is_smooth(at, (part, box[1]))]
                if not wide:
                    raise
            if not wide:
                return name
            if any(high - low <= _NARROWEST for low, high in wide):
                raise Unproved("images or derivatives do not fit")
            inner = sorted({*inner, *(sum(part, Fraction(0)) / 2 for part in wide)})

    def _stays(self, part: Differential) -> bool:
        """Whether image velocities stay in the rectangles."""
        (low, high), (least, most) = self.velocities, part.values[1]
        return low < least <= most < high

    def pair(self, at: Place, sets: Sets, cuts: Sequence[Fraction] = ()) -> list[str]:
        """Prove what F does on two rectangles."""
        with self.attempt():
            return [self.rectangle(at, phases, cuts) for phases in sets]

    def crossing(self, at: Place, sets: Sets, cuts: Sequence[Fraction] = ()) -> str:
        """Prove that F maps both rectangles across both."""
        images = image_phases(at, self.velocities)
        for ends in sets:
            seen = [image for image in map(images, ends) if image is not None]
            low, high = min(seen, default=(0, 0)), max(seen, default=(0, 0))  # f may fall
            short = float(max(low[1] - sets[0][0], sets[1][1] - high[0]))
            if len(seen) < 2 or short >= 0:
                raise Unproved(f"an edge seems to fall short by {short:.6g}, or to stick")
        with self.attempt():
            return self.across(self.pair(at, sets, cuts), ALL, PLAIN)

    def across(
        self, names: Sequence[str], arrows: Sequence[Sequence[int]], cone: Cone, **more: Any
    ) -> str:
        """Prove which rectangles F maps across which (rule horseshoe)."""
        following = [[str(k + 1) for k in each] for each in arrows]
        witness = {"rectangles": list(names), "arrows": following, "cone": texts(cone), **more}
        return self.derive("horseshoe", witness)[0]

    # -- words ---------------------------------------------------------------------------------

    def bar(self, pair: Sequence[str], word: Sequence[int], above: bool) -> str:
        """Prove that no orbit follows a word, if floats agree."""
        if not _seems_barred([self.get(pair[symbol], Rectangle) for symbol in word], above):
            raise Unproved("in floating point an orbit follows the word")
        symbols = [str(symbol + 1) for symbol in word]
        way = {"from": "above" if above else "below"}
        return self.derive("barred-word", {"rectangles": list(pair), "word": symbols, **way})[0]

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
            part = self.rectangle(place_of(self.known[pair[0]]), right)
            words = [
                self.bar(pair, word, True) for word in ((0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1))
            ]
            words.append(self.constant_word(pair, (1,)))
            wider = {"rectangles": list(pair), "words": words}
            return self.across([pair[0], part], ((0, 1), (0,)), PLAIN, wider=wider)

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
                    names.append(self.state(at, ((end, end), (gamma, gamma)), self.bits + _ROOM)[0])
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
                names.append(self.crossing(replace(at, **{side: slab}), sets))
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


def function_of(at: Place) -> dict[str, list[str]]:
    """Name the map of these oscillators, for a witness."""
    sides = zip(("eta", "nu", "epsilon"), at.sides, strict=True)
    return {name: texts(side) for name, side in sides}


def turns_of(at: Place, box: Box) -> str:
    """Return about how many turns the next phases have passed, seen from the middle of a box."""
    eta, nu, epsilon, phase, gamma = (float(low + high) / 2 for low, high in (*at.sides, *box))
    after = landing(System(Fraction(eta), Fraction(nu)), epsilon, phase, gamma)
    return str(math.floor((after.lifted if after else phase) / math.tau))


def _is_smooth(at: Place, box: Box) -> bool:
    try:
        differential_on(Oscillator(at.sides), box, (0,))
    except FAILED:
        return False
    return True


def _finer(cuts: Sequence[Fraction]) -> list[Fraction]:
    """Halve parts until none is wider than it is worth to try."""
    while wide := [part for part in pairwise(cuts) if part[1] - part[0] > _WIDEST]:
        cuts = sorted({*cuts, *((low + high) / 2 for low, high in wide)})
    return list(cuts)


def _seems_barred(path: Sequence[Rectangle], above: bool) -> bool:
    """Whether in floating point no orbit follows rectangles, as the rule barred-word sees it."""
    (bound, heights), end = (path[0].box[0][above], path[0].box[1]), int(above)
    for here, following in pairwise(path):
        low, high = here.box[0]
        seen = image_phases(place_of(here), heights)(min(max(bound, low), high))
        if seen is None:
            return False
        bound, heights = Fraction(seen[end]), here.image[1]
        last = following.box[0]
    return bound < last[0] if above else bound > last[1]
