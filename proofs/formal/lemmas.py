"""Write the lemmas of a plan: inequalities on boxes for `interval`, and what they say of f.

The writer is not trusted: coqc proves every line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.formal import lemma_text as text
from proofs.formal.flights import Cut, Cutter
from proofs.formal.hints import Branch, Hints, NoHint, binary
from proofs.formal.plan import Plan
from proofs.formal.written import Writer, by_cases, rational
from proofs.search.repair import short_decimal
from proofs.trusted.numbers import Range, hull, show_range, within

ROOM = 2.0**-24  # of a bracket, where no margin is thin


class Sets(NamedTuple):
    """I0 and I1 by a name, and bounds on f' there."""

    name: str
    domains: tuple[Range, Range]
    bounds: tuple[Range, Range]

    def sign(self, index: int) -> int:
        """The sign of f' on I0 or I1; 0 if the bounds leave it open."""
        low, high = self.bounds[index]
        return 1 if low > 0 else -1 if high < 0 else 0

    def sizes(self, index: int) -> Range:
        """Bounds on |f'| for I0 or I1; for both, if f' has a sign on each."""
        signs = self.sign(0), self.sign(1)
        return hull([self._size(i) for i in ((0, 1) if all(signs) else (index,))])

    def _size(self, index: int) -> Range:
        low, high = self.bounds[index]
        return (low, high) if self.sign(index) > 0 else (-high, -low)

    @property
    def interval(self) -> Range:
        """I, from the left end of I0 to the right end of I1."""
        return self.domains[0][0], self.domains[1][1]


def _place(branches: Sequence[Branch], phases: Range) -> int:
    """Return which of the branches has all these phases."""
    for index, branch in enumerate(branches):
        if within(phases, (branch.a, branch.b)):
            return index
    raise NoHint(f"no branch has all phases of {show_range(phases)}")


class Lemmas(Writer):
    """Collects the lemmas of a plan: slopes and images on I0 and I1, and where the gap goes."""

    def __init__(self, plan: Plan) -> None:
        super().__init__()
        self.plan = plan
        self.hints = Hints(plan.of.eta, plan.of.nu)
        self.finest = 1.0
        self.sets = list(self._sets())
        self.branches: list[list[Branch]] = []
        self.laps: dict[int, int] = {}
        self.avoid: dict[str, str] = {}  # for each of the sets, the lemma that the gap leaves I

    def slopes(self) -> None:
        """Write the first impacts of launches near I0 and I1, and the bounds on f' there."""
        if self.sets:
            self.branches = [self._branches(index) for index in (0, 1)]

    def _sets(self) -> Iterator[Sets]:
        """Yield the sets of the horseshoe, and those printed if something is stated there."""
        plan, headline = self.plan, self.plan.headline
        if headline is not None:
            low, high = headline.slopes
            first, second = ((low, high) if sign > 0 else (-high, -low) for sign in headline.signs)
            yield Sets("horseshoe", (headline.left, headline.right), (first, second))
        asked = {"H1", "H2", "H3", "H6"} & {name for name in plan.verdicts if plan.holds(name)}
        if asked or "H5" in plan.verdicts:
            known = self._bounds(plan.of.left), self._bounds(plan.of.right)
            yield Sets("printed", (plan.of.left, plan.of.right), known)

    def _bounds(self, domain: Range) -> Range:
        """Return what the claims say about f' on a printed set, roughly where they say nothing."""
        least, greatest = self.hints.rates(domain)
        low = binary(least / 2 if least > 0 else least * 2, 10)
        high = binary(greatest * 2 if greatest > 0 else greatest / 2, 10, up=True)
        if self.plan.holds("H1"):
            low = max(low, self.plan.of.slopes[0])
        if self.plan.holds("H6"):
            low = short_decimal(self.plan.of.slopes[0], Fraction(least))
        if self.plan.holds("H2"):
            high = min(high, self.plan.of.slopes[1])
        return low, high

    def _branches(self, index: int) -> list[Branch]:
        """Write that the launches near I0, or I1, have transversal first impacts."""
        whole = hull([sets.domains[index] for sets in self.sets])
        cutter = Cutter(self.hints, whole)
        cuts = cutter.pieces(*whole)
        branches = [cut.branch for cut in cuts]
        parts = []
        for j, branch in enumerate(branches):
            self.branch(f"{index}_{j}", cutter, cuts[j])
            part = text.LAST if branch is branches[-1] else text.GLUED
            next_a = branches[min(j + 1, len(branches) - 1)].a
            parts.append(
                part.format(branch=f"{index}_{j}", b=rational(branch.b), c=rational(next_a))
            )
        ends = {"a": branches[0].a, "b": branches[-1].b}
        self.add(text.REGULAR, i=index, parts="".join(parts), **ends)
        self._rates(index, branches, whole)
        return branches

    def branch(self, name: str, cutter: Cutter, cut: Cut) -> None:
        """Write that launches have transversal first impacts, between two times."""
        starts = " ".join(map(str, cut.times))
        values = {
            **cutter.numbers,
            "cut": cut,
            "times": f"{cut.times}%Z",
            "starts": starts,
            "i": name,
        }
        self.add(text.BRANCH, **values, **cut.branch._asdict())

    def _rates(self, index: int, branches: list[Branch], whole: Range) -> None:
        """Write the bounds on f', piece by piece, then for each of the sets and on the whole."""
        parts = [(sets.domains[index], sets.bounds[index]) for sets in self.sets]
        cuts = {end for domain, _ in parts for end in domain}
        cuts |= {(one.b + other.a) / 2 for one, other in pairwise(branches)}
        pieces: list[tuple[str, Range]] = []
        used = [bounds for _, bounds in parts]
        for zone in pairwise(sorted(cuts)):
            j = _place(branches, zone)
            inside = [bounds for domain, bounds in parts if within(zone, domain)]
            inside = inside or [self._bounds(zone)]
            bounds = max(low for low, _ in inside), min(high for _, high in inside)
            used.append(bounds)
            for piece in self.hints.pieces(branches[j], zone, bounds):
                name = f"piece{index}_{len(pieces)}"
                self.finest = min(self.finest, float(piece.d))
                named = {"name": name, "branch": f"{index}_{j}", "lo": bounds[0], "hi": bounds[1]}
                self.add(text.PIECE, **named, **piece._asdict())
                pieces.append((name, (piece.p, piece.q)))
        everywhere = Sets("whole", (whole, whole), (hull(used),) * 2)
        for sets in (*self.sets, everywhere):
            self._bounded(sets, index, branches, pieces)

    def _bounded(
        self, sets: Sets, index: int, branches: list[Branch], pieces: list[tuple[str, Range]]
    ) -> None:
        """Write the bounds on f' for I0 or I1, and that f is monotone there."""
        (x, y), (lo, hi) = sets.domains[index], sets.bounds[index]
        mine = [(name, part[1]) for name, part in pieces if within(part, (x, y))]
        named = {"i": index, "set": sets.name, "x": x, "y": y, "lo": lo, "hi": hi}
        self.add(text.RATE, **named, cuts=by_cases(mine, "destruct ({} phi); lra"))
        sign, (least, greatest) = sets.sign(index), sets.sizes(index)
        if sign:
            ends = {"a": branches[0].a, "b": branches[-1].b}
            self.add(text.MONOTONE, **named, **ends, s=f"({sign})", m=least, M=greatest)

    def impact(self, index: int, phases: Range, name: str, room: float = ROOM) -> Range:
        """Write a bracket of the impact times of some launches, and return it."""
        times = [self.hints.impact(float(phase)) for phase in phases]
        bits = 2 - math.floor(math.log2(room))
        low, high = binary(min(times) - room, bits), binary(max(times) + room, bits, up=True)
        self.finest = min(self.finest, room)
        j = _place(self.branches[index], phases)
        named = {"name": name, "branch": f"{index}_{j}", "p": phases[0], "q": phases[1]}
        self.add(text.IMPACT, **named, s=low, t=high)
        return low, high

    def lap(self, index: int) -> dict[str, object]:
        """Write in which lap all images of a branch are; return it with the branch's ends."""
        a, b = self.branches[index][0].a, self.branches[index][-1].b
        if index not in self.laps:
            x, y = hull([sets.domains[index] for sets in self.sets])
            if not all(sets.sign(index) == self.sets[0].sign(index) != 0 for sets in self.sets):
                raise NoHint("f is not monotone")
            low = self.impact(index, (a, x), f"before{index}", ROOM * 2**8)
            high = self.impact(index, (y, b), f"after{index}", ROOM * 2**8)
            least = min(a + low[0], y + high[0])
            greatest = max(x + low[1], b + high[1])
            lap = math.floor(least / Fraction(math.tau))
            if greatest > (lap + 1) * Fraction(math.tau):
                raise NoHint("an image passes phase 0")
            self.add(text.LAP, i=index, x=x, y=y, k=lap, l=least, r=greatest, a=a, b=b)
            self.laps[index] = lap
        return {"a": a, "b": b, "k": self.laps[index]}

    def covers(self, sets: Sets) -> None:
        """Write that f maps I0 and I1 over I."""
        low, high = sets.interval
        for index, (x, y) in enumerate(sets.domains):
            where, sign = self.lap(index), sets.sign(index)
            targets = (low, high) if sign > 0 else (high, low)
            for end, phase, target in ((0, x, targets[0]), (1, y, targets[1])):
                room = min(ROOM, abs(self.image(index, phase) - float(target)) / 8)
                self.impact(index, (phase, phase), f"end_{sets.name}{index}_{end}", room)
            named = {"i": index, "set": sets.name, "x": x, "y": y, "A": low, "B": high}
            self.add(text.COVERS, **named, **where, s=f"({sign})")

    def image(self, index: int, phase: Fraction) -> float:
        """Return about f(phase), in the lap of the branch."""
        return float(phase) + self.hints.impact(float(phase)) - self.laps[index] * math.tau

    def avoids(self, name: str, phases: Range, target: Range) -> None:
        """Write that no launch from an interval of phases has its impact in the target."""
        escapes = self.hints.escapes(phases, target)
        for j, escape in enumerate(escapes):
            laps = " \\/ ".join(f"(k = {lap})%Z" for lap in range(1, escape.K)) or "False"
            named = {"name": name, "j": j, "A": target[0], "B": target[1], "cases": laps}
            self.add(text.ESCAPE, **named, **escape._asdict())
        parts = [(f"{name}{j}", escape.q) for j, escape in enumerate(escapes)]
        named = {"name": name, "A": target[0], "B": target[1], "p": phases[0], "q": phases[1]}
        self.add(text.AVOIDS, **named, cuts=by_cases(parts, "apply {}; lra"))

    def leaving(self) -> None:
        """Write that the gap leaves I: for the horseshoe and for H4 at once, if that can be."""
        of, headline = self.plan.of, self.plan.headline
        wanted: list[tuple[str, Range, Range]] = []
        if headline is not None:
            wanted.append(("horseshoe", (headline.left[1], headline.right[0]), headline.interval))
        if self.plan.holds("H4"):
            wanted.append(("printed", of.gap, of.interval))
        if not wanted:
            return
        phases, target = hull([x[1] for x in wanted]), hull([x[2] for x in wanted])
        try:
            self.avoids("escape", phases, target)
            self.avoid = {name: "escape" for name, _, _ in wanted}
        except NoHint:
            for name, phases, target in wanted:
                self.avoid[name] = f"escape_{name}"
                self.avoids(self.avoid[name], phases, target)
