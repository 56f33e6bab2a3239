"""The questions that an atlas may ask: by which conclusions each holds, or its opposite does."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.cycle import ATTRACTING, PeriodicOrbit
from proofs.trusted.kernel.graph import Entropy
from proofs.trusted.kernel.loops import StableOrbit
from proofs.trusted.paper.beyond.attractors import AllStick, AtRest
from proofs.trusted.paper.beyond.returning import ReturningMotion, StickingMotion
from proofs.trusted.paper.beyond.singles import MOST_PERIODS, StableSingles
from proofs.trusted.verdicts import Verdict

_MOST_CELLS = 50


class Question(NamedTuple):
    """What is asked in each cell: by which conclusions it holds, by which its opposite does.

    size: the number in its name, if there is one. plastic: whether impacts have to be.
    """

    kind: str
    size: int
    holds: str
    opposite: str
    proved_by: Callable[[Conclusion], bool]
    refuted_by: Callable[[Conclusion], bool]
    plastic: bool = True

    def verdict(self, found: Sequence[Conclusion]) -> Verdict:
        """Return what one conclusion makes of the question."""
        if len(found) == 1 and self.proved_by(found[0]):
            return Verdict.VERIFIED
        if len(found) == 1 and self.refuted_by(found[0]):
            return Verdict.REFUTED
        return Verdict.UNDECIDED


_NEVER = "none of this is ever refuted"
_ATTRACTORS = StickingMotion, ReturningMotion, StableOrbit, AllStick, AtRest
_ATTRACTOR = Question(
    "attractor",
    0,
    "a periodic motion, or rest, attracts all motions from an open set of phases",
    _NEVER,
    lambda found: isinstance(found, _ATTRACTORS),
    lambda found: False,
)


def _entropy(count: int) -> Question:
    number, every = ("two", "both") if count == 2 else (f"{count}", "them all")
    return Question(
        "entropy",
        count,
        f"f is continuous on {number} disjoint intervals of phases and maps each over {every}: the "
        f"full {count}-shift is a factor of f, of entropy log {count}",
        "every motion comes to rest, and f is defined nowhere, or f(f) is constant",
        lambda found: isinstance(found, EntropyBound) and len(found.cells) >= count,
        lambda found: isinstance(found, AtRest | AllStick),
    )


def _orbits(most: int) -> Question:
    def shown(found: Conclusion, *, stable: bool) -> bool:
        if not isinstance(found, StableSingles) or found.most != most:
            return False
        return bool(found.stable) is stable

    return Question(
        "orbits",
        most,
        f"for at least one n up to {most} a periodic motion that never sticks, with one impact, a "
        "transversal one, in n table periods, is stable; and it is proved for which of these n",
        f"there is none for any n up to {most}",
        lambda found: shown(found, stable=True),
        lambda found: shown(found, stable=False),
        plastic=False,
    )


OF_MAPS = "orbits:N, stable:N (N from 1 to 60), horseshoe"


def map_question(name: str, function: str) -> Question:
    """Return what is asked of a map under a name; ValueError where that is nothing.

    Conclusions about this function of a file answer, not the paper's map. Nothing is refuted.
    """
    kind, _, number = name.partition(":")

    def is_orbit(found: Conclusion) -> bool:
        if not isinstance(found, PeriodicOrbit) or found.place or found.function.name != function:
            return False
        is_asked = kind == "orbits" or found.stability == ATTRACTING
        return is_asked and found.period == int(number)

    def is_horseshoe(found: Conclusion) -> bool:
        if not isinstance(found, Entropy) or found.growth < 2:
            return False
        maps = [cover.local.map for cover in found.graph.covers]
        return all(map_.name == function and not hasattr(map_, "at") for map_ in maps)

    if name == "horseshoe":
        holds = "a compact invariant set of the map has positive topological entropy"
        return Question(kind, 0, holds, _NEVER, is_horseshoe, lambda found: False, plastic=False)
    if kind in ("orbits", "stable") and re.fullmatch("[1-5]?[0-9]|60", number) and int(number):
        which = "an attracting" if kind == "stable" else "a"
        holds = f"the map has {which} periodic orbit of the least period {number}"
        return Question(
            kind, int(number), holds, _NEVER, is_orbit, lambda found: False, plastic=False
        )
    raise ValueError(f"the question is one of {OF_MAPS}, not {name[:30]!r}")


_SIZED = {"entropy": (_entropy, 2, _MOST_CELLS), "orbits": (_orbits, 1, MOST_PERIODS)}
_SHORT = {"horseshoe": "entropy:2", "orbits": "orbits:10"}
QUESTIONS = ("attractor", *_SHORT, *(f"{x}:{a} to {x}:{b}" for x, (_, a, b) in _SIZED.items()))


def question(name: str) -> Question:
    """Return what is asked under a name; ValueError where that is nothing."""
    kind, _, number = _SHORT.get(name, name).partition(":")
    if kind in _SIZED and re.fullmatch("[1-9][0-9]{0,2}", number):
        make, least, most = _SIZED[kind]
        if least <= int(number) <= most:
            return make(int(number))
    if name != _ATTRACTOR.kind:
        raise ValueError(f"the question is one of {', '.join(QUESTIONS)}")
    return _ATTRACTOR
