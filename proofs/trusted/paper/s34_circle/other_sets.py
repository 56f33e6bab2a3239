"""Section 3.4: is there another invariant set in [1.32, 1.48]? Claims G5, and G11, our own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Phases, Range, between, covered, show_range, within
from proofs.trusted.paper.s31_horseshoe import read_part
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.slopes import Avoids, SlopeRange, image_arc
from proofs.trusted.verdicts import Decide, Decision, Found, Row, Verdict, decided, undecided

PRINTED = Phases(Fraction("1.32"), Fraction("1.48"))


def _listed(ranges: Iterable[Range]) -> str:
    return ", ".join(map(show_range, ranges))


# -- orbits that stay ------------------------------------------------------------------------------


@dataclass(frozen=True)
class StayingSet:
    """Theorem. Let cells lie in a region and meet at ends at most, with |f'| > 1 on each, its image
    an interval of phases. Let cells and gaps cover the region, and let f map each gap outside a set
    that contains the region. Then every orbit that stays in the region runs through the cells.

    Region (intervals that are apart) and cells are in order of phase, whatever the order given.
    """

    region: tuple[Phases, ...]
    cells: tuple[SlopeRange, ...]
    gaps: tuple[Avoids, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "region", tuple(sorted(self.region)))
        object.__setattr__(self, "cells", tuple(sorted(self.cells, key=lambda x: x.domain)))
        if not apart(self.region) or not self.cells:
            raise Unproved("no cells, or the intervals of a region are not apart")
        if any(one.domain[1] > two.domain[0] for one, two in pairwise(self.cells)):
            raise Unproved("cells overlap")
        for cell in self.cells:
            if not (cell.expands and image_arc(cell).is_interval):
                raise Unproved("on a cell f does not expand, or its image passes phase 0")
            if not any(within(cell.domain, part) for part in self.region):
                raise Unproved("a cell leaves the region")
        if not all(within(part, gap.target) for part in self.region for gap in self.gaps):
            raise Unproved("a gap is not proved to avoid the region")
        if {each.place for each in (*self.cells, *self.gaps)} != {self.at}:
            raise Unproved("the hypotheses are about different oscillators")
        known = sorted([*(cell.domain for cell in self.cells), *(gap.phases for gap in self.gaps)])
        if not all(covered(part, known) for part in self.region):
            raise Unproved("cells and gaps do not cover the region")

    @property
    def at(self) -> Place:
        """The oscillator."""
        return self.cells[0].at

    @classmethod
    def read(cls, context: Context, reader: Reader) -> StayingSet:
        """Read {region: [[low, high], ...], cells: [{slopes, domain}], gaps: [avoids steps]}.

        slopes: a slope-range step; domain: two of its points.
        """
        region, cells, gaps = reader.fields("region", "cells", "gaps")
        return cls(
            tuple(Phases(*part.range()) for part in region.items(1, 20)),
            tuple(read_part(context, cell) for cell in cells.items(1, 500)),
            tuple(context.step(gap, Avoids) for gap in gaps.items(0, 50)),
        )


def apart(intervals: Iterable[Phases]) -> bool:
    """Whether intervals are disjoint, and in order of phase."""
    return all(one[1] < two[0] for one, two in pairwise(intervals))


# -- infinitely many -------------------------------------------------------------------------------

_CONNECTIONS = (
    " The phases with sequences over 0, 1 and those over 1, 2 are two invariant Cantor sets, each "
    "a full shift on two symbols, with the fixed point p = 111... in common; they are the phases "
    "whose orbits stay in the interval up to p, and in the interval from p on. They are connected "
    "in both directions: a word over 0, 1, as long as one likes, and then a sequence over 1, 2 "
    "belong to a phase whose orbit begins near the first set and ends in the second one; a "
    "sequence infinite to both sides, over 0, 1 in the past and over 1, 2 in the future, to a full "
    "orbit that tends to the first set in the past and lies in the second in the future; and the "
    "same with the two sets exchanged."
)


@dataclass(frozen=True)
class FullShift(Conclusion):
    """The phases whose orbits stay in `interval` are a full shift on the cells, in order of phase.

    f is one-to-one on each cell and maps it over the interval, into which no other phase goes.
    slopes: bounds on f', which is above 1 on the cells.
    """

    at: Place
    interval: Phases
    cells: tuple[Phases, ...]
    slopes: Range

    def __post_init__(self) -> None:
        if len(self.cells) < 2 or not apart(self.cells) or self.slopes[0] <= 1:
            raise Unproved("a full shift needs two cells or more, apart, on which f' > 1")

    @property
    def sentence(self) -> str:
        whole = show_range(self.interval)
        named = ", ".join(f"{index} = {show_range(cell)}" for index, cell in enumerate(self.cells))
        return (
            f"f is C^1, f' in {between(self.slopes, 2)}, on each of the sets {named}, maps each of "
            f"them one-to-one over {whole}, and no other phase of {whole} into it: the phases "
            f"whose orbits stay in {whole} are a Cantor set on which f is conjugate to the full "
            f"shift on {len(self.cells)} symbols, the n-th symbol of phi being the number of the "
            f"set that f^n(phi) lies in.{_CONNECTIONS if len(self.cells) == 3 else ''}"
        )


def full_shift(staying: StayingSet) -> FullShift:
    """Theorem. Let f increase on the cells of a staying set, which are two or more and disjoint,
    and map each of them over the interval. Then what `FullShift.sentence` says.

    Proof. 0. An image that is an interval of phases is shorter than the circle, so f, which
    increases, is one-to-one on a cell. 1. The phases that follow a word of length n through the
    cells are an interval, by the inverse branches, which are defined on all cells; it is at most
    |cell| / mu^(n-1) long, mu = min f' > 1. So every sequence is followed by one phase, which
    depends continuously on it; sequences are compact, so this is a homeomorphism, and it turns the
    shift into f. 2. f increases, and the cells are in order of phase: the order of phases is the
    lexicographic order of sequences. 3. So, on three symbols, f^n(phi) <= p for all n if and only
    if no sequence moved on begins with 2, that is, none of the symbols is 2; f^n(phi) >= p if and
    only if none is 0. Every sequence has its phase, and those of sequences that agree for long are
    close.
    """
    interval, *more = staying.region
    if more or not all(image_arc(cell).covers(interval) for cell in staying.cells):
        raise Unproved("the image of a cell is not proved to cover the interval")
    low = min(cell.minimum[0] for cell in staying.cells)
    high = max(cell.maximum[1] for cell in staying.cells)
    return FullShift(staying.at, interval, tuple(x.domain for x in staying.cells), (low, high))


def prove_full_shift(context: Context, reader: Reader) -> FullShift:
    """Rule `full-shift`: {region, cells, gaps}, see `StayingSet`. Concludes `full_shift`."""
    return full_shift(StayingSet.read(context, reader))


# -- finitely many ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class StayingOrbit(Conclusion):
    """All orbits that stay in a region are one periodic orbit, through disjoint cells in turn."""

    at: Place
    region: tuple[Phases, ...]
    cells: tuple[Phases, ...]

    def __post_init__(self) -> None:
        if not self.cells or not apart(sorted(self.cells)):
            raise Unproved("the cells of a periodic orbit are not disjoint")

    @property
    def bracketed(self) -> bool:
        """Whether the region is nothing but the cells: brackets of the points."""
        return set(self.cells) == set(self.region)

    @property
    def sentence(self) -> str:
        points = "" if self.bracketed else f", with one point in each of {_listed(self.cells)}"
        return f"{self.brief}{points}."

    @property
    def brief(self) -> str:
        period = len(self.cells)
        orbit = "fixed point" if period == 1 else f"periodic orbit of period {period}"
        return f"the orbits that stay in {_listed(self.region)} are one unstable {orbit}"


def staying_orbit(staying: StayingSet) -> StayingOrbit:
    """Theorem. Join a cell to those that its image may meet. If from each cell at most one infinite
    path starts, all these are one closed path, through disjoint cells, and f of each of these
    covers the next one, then `StayingOrbit`.

    Proof. 1. Two phases on the same path move apart, by min |f'| > 1 at least each time, as long
    as both stay: they are the same, so at most one phase of each cell stays. 2. The inverse
    branches along the path contract its first cell into itself: it holds a periodic point.
    """
    cells, arcs = staying.cells, [image_arc(cell) for cell in staying.cells]
    METER.get().spend(len(cells) ** 2)
    onward = [[j for j, y in enumerate(cells) if not arc.misses(y.domain)] for arc in arcs]
    alive = set(range(len(cells)))
    while dying := {i for i in alive if alive.isdisjoint(onward[i])}:
        METER.get().spend(sum(len(onward[i]) for i in alive))
        alive -= dying
    path: list[int] = []
    following = min(alive, default=-1)
    while following not in path and alive:
        path.append(following)
        following, *others = (j for j in onward[path[-1]] if j in alive)
        if others or not arcs[path[-1]].covers(cells[following].domain):
            raise Unproved("orbits that stay are not proved to follow one path")
    if not path or following != path[0] or len(path) < len(alive):
        raise Unproved("orbits that stay are not proved to follow one closed path")
    return StayingOrbit(staying.at, staying.region, tuple(cells[i].domain for i in path))


def prove_staying_orbit(context: Context, reader: Reader) -> StayingOrbit:
    """Rule `staying-orbit`: {region, cells, gaps}, see `StayingSet`. Concludes `staying_orbit`."""
    return staying_orbit(StayingSet.read(context, reader))


# -- the row ---------------------------------------------------------------------------------------


def _another_set(one_orbit: Verdict) -> Decide:
    """Decide by what stays in the printed interval: a full shift, or one periodic orbit.

    The latter is not in Lambda, in [1.11, 1.32], if a point of it is beyond. It is an invariant
    set, which is all that the paper's words say (G5), but not one like Lambda (G11).
    """

    def decide(of: Parameters, found: Found) -> Decision:
        shifts, orbits = found.all(FullShift), found.all(StayingOrbit)
        for shift in shifts:
            if shift.interval == PRINTED:
                return decided(Verdict.VERIFIED, shift)
        staying = [orbit for orbit in orbits if orbit.region == (PRINTED,)]
        if not (staying and any(cell[0] > of.interval[1] for cell in staying[0].cells)):
            return undecided(f"no proof which orbits stay in {show_range(PRINTED)}")
        beside = [each for each in orbits if each.bracketed]
        known: dict[str, Range] = {}
        for period in sorted({len(each.cells) for each in beside}):
            points = {x for each in beside if len(each.cells) == period for x in each.cells}
            known |= {f"period_{period}_point_{i}": x for i, x in enumerate(sorted(points), 1)}
        corrected = (staying[0], *shifts, *beside)
        return decided(one_orbit, staying[0], corrected=corrected, known=known)

    return decide


ROWS = (
    Row(
        "G5",
        "3.4",
        "This suggests the existence of another invariant set",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of f.",
        _another_set(Verdict.VERIFIED),
        printed_at=PAPER.place,
    ),
    Row(
        "G11",
        "3.4",
        "",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of the same kind, "
        "on which f is conjugate to the full shift on two symbols.",
        _another_set(Verdict.REFUTED),
        printed_at=PAPER.place,
    ),
)
