"""Section 3.4: is there another invariant set, and how much chaos is there in all?

Claims G5, G11, G20: which orbits stay in [1.32, 1.48], and the full shifts around it. G9: a lower
bound on the topological entropy, from all branches of f near the phase pi/2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from intervals import Undecided
from proofs.methods.subshifts import Growing, largest_subshift, tower
from proofs.motion.system import System
from proofs.motion.windows import Candidate, Candidates
from proofs.search.budget import FASTEST
from proofs.search.evidence import FAILED, Evidence
from proofs.search.request import Request, proving
from proofs.search.s34_staying import prove_staying
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.flights import lifted
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, within
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s34_circle.other_sets import PRINTED
from proofs.trusted.windows import BITS

_DOMAIN = (1.0, 2.1)  # the phases around pi/2 whose orbits come back to them
_GRID = 1200  # phases to start from in the search for branches
_NARROWEST = 1e-5  # branches that are narrower are left out
_MOST_TURNS = 1500
_MARGINS = (1e-7, 1e-6, 1e-5)  # how far from grazing, relative to the length of a branch
_SHARE = 0.06  # of a part of a branch in the one before, towards grazing
_DEPTH = 3  # of the tower of states
_PLACES = 8  # of the ends of states
_SOON = Fraction(1, 10**7)  # how long after an impact the gap is looked at
_NEAREST, _TRIES = Fraction(1, 2**32), 12  # of brackets of impacts: the narrowest, how many


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims asked for rest on."""
    prover = request.prover()
    evidence = Evidence(prover.steps)
    if asked := {"G5", "G11", "G20"}.intersection(request.claims):
        request.tell("which orbits stay in [1.32, 1.48], and around it")
        evidence.proofs |= dict.fromkeys(asked, prove_staying(prover, PRINTED, request.of.interval))
    if request.asks("G20"):
        ends = [prover.point(phase) for phase in PRINTED]
        kept = [  # the other orbits are beside the point
            (name, each)
            for name, each in evidence.proofs["G20"]
            if isinstance(each, StayingSet) and (not each.orbit or each.region == (PRINTED,))
        ]
        evidence.proofs["G20"] = [*kept, *ends]
    if request.asks("G9"):
        request.tell("branches of f, and their covering graph")
        evidence.proofs["G9"] = [*prove_entropy(prover)]
    return evidence


def prove_entropy(
    prover: Prover, most_turns: int = _MOST_TURNS, depth: int = _DEPTH
) -> list[tuple[str, EntropyBound]]:
    """Prove a covering graph on all branches with flights over at most so many turns.

    At the paper's numbers the growth is 1.618 with two branches, up to 5 turns; 3.469 with four, up
    to 15; 3.996, 4.177, 4.712, 5.518, 5.741, 5.799 with 7, 9, 15, 25, 35, 49 branches, up to 60,
    130, 330, 650, 1000, 1500 turns. The rest, flights over up to 10000 turns, adds 0.0001 only; two
    more levels of the tower, 0.0011. So log 5.8 seems to be the entropy of f to three digits.
    """
    if not -1 < prover.system.nu < 0 or prover.system.eta > FASTEST:
        return []
    branches = Branches(prover.system, Candidates(prover.system, most_turns))
    for low, high in branches.candidates.runs(*_DOMAIN, _GRID):
        if high - low > _NARROWEST:
            branches.prove(prover, low, high)
    return prove_covering(prover, branches, depth)


def prove_covering(
    prover: Prover, branches: Branches, depth: int = _DEPTH
) -> list[tuple[str, EntropyBound]]:
    """Prove the covering graph of the largest subshift seen on branches; none, no step."""
    pieces = [branch.phases for branch in branches.branches]
    try:
        states = tower(pieces, branches.image, depth, _PLACES)
        subshift = largest_subshift(pieces, branches.image, states)
        return [] if subshift is None else [_record(prover, branches, subshift)]
    except FAILED:
        return []


def _record(prover: Prover, branches: Branches, subshift: Growing) -> tuple[str, EntropyBound]:
    """Record the step `covering-graph`, the growth rounded down."""
    growth = subshift.growth * 10**4 // 1 / Fraction(10**4)
    used = {
        (index, end)
        for low, high in subshift.states
        for index, (first, last) in enumerate(branch.phases for branch in branches.branches)
        if low < last and first < high
        for end in (max(low, first), min(high, last))
    }
    kept = sorted({index for index, _ in used})
    images = [branches.bracket(index, phase) for index, phase in sorted(used)]
    witness = {
        "branches": [branches.names[index] for index in kept],
        "images": images,
        "states": [texts(state) for state in subshift.states],
        "weights": list(map(str, subshift.vector)),
        "growth": str(growth),
    }
    return prover.derive("covering-graph", witness)


@dataclass
class Branches:
    """Branches of f: intervals of phases with the first impact in one window of time.

    edges: how far from grazing they may end, the shortest tried first; none: relative to lengths.
    """

    system: System
    candidates: Candidates
    edges: Sequence[float] = ()
    branches: list[Branch] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    times: dict[tuple[int, Fraction], Range] = field(default_factory=dict)
    _images: dict[tuple[int, Fraction], Range] = field(default_factory=dict)

    def prove(self, prover: Prover, low: float, high: float) -> None:
        """Prove a branch, a little inside where f jumps, and record the step `branch`."""
        for edge in self.edges or [margin * (high - low) for margin in _MARGINS]:
            inside = low + edge, high - edge
            try:
                cuts, turn, ends = self._parts(*inside)
                witness = {"cuts": texts(cuts), "turn": str(turn), "ends": texts(ends)}
                name, branch = prover.derive("branch", witness)
            except FAILED:
                continue  # nearer to grazing than the arithmetic can tell
            self.branches.append(branch)
            self.names.append(name)
            return

    def _parts(self, low: float, high: float) -> tuple[list[Fraction], int, list[Fraction]]:
        """Cut a branch towards grazing; return the cuts, the turn, and times after the impacts."""
        first, last = self.impact(low), self.impact(high)
        if first.turn != last.turn:
            raise Undecided("a branch that is not one")
        steep_first = abs(first.slope) > abs(last.slope)
        shares = [(high - low) * _SHARE**k for k in range(1, 6)]
        inner = [low + x for x in shares[::-1]] if steep_first else [high - x for x in shares]
        cuts = [round(Fraction(x), 12) for x in (low, *inner, high)]
        times = [self.impact(float(cut)).time for cut in cuts]
        ends = [round(Fraction(max(pair)) + _SOON, 9) for pair in pairwise(times)]
        return cuts, first.turn, ends

    def impact(self, phase: float) -> Candidate:
        """Return about where the first impact is; Undecided if there is none."""
        candidate = self.candidates.impact(phase)
        if candidate is None:
            raise Undecided("no impact in floating point")
        return candidate

    def on(self, phase: Fraction) -> int:
        """Return the number of the branch that a phase lies on."""
        return next(i for i, x in enumerate(self.branches) if within((phase, phase), x.phases))

    def image(self, index: int, phase: Fraction) -> Range:
        """Prove and return the image of a phase in a branch."""
        if (index, phase) not in self._images:
            branch, about = self.branches[index], Fraction(self.impact(float(phase)).time)
            for time in _openings(about, branch.window(phase)):
                with suppress(Unproved):
                    image = lifted(branch.image(phase, time), -branch.turn, BITS)
                    self.times[index, phase], self._images[index, phase] = time, image
                    return image
            raise Undecided("no bracket of an impact time is proved")
        return self._images[index, phase]

    def bracket(self, index: int, phase: Fraction) -> dict[str, object]:
        """Return a phase, and the bracket by which its image is proved."""
        self.image(index, phase)
        return {"phase": str(phase), "time": texts(self.times[index, phase])}


def _openings(about: Fraction, window: Range) -> Iterator[Range]:
    """Yield wider and wider brackets of a time, within its window."""
    for unit in (_NEAREST * 4**count for count in range(_TRIES)):
        centre = round(about / unit) * unit
        yield max(window[0], centre - unit), min(window[1], centre + unit)
