"""Which orbits stay in a region: the rule `staying-set`, for horseshoes and for single orbits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import AboutMap, Subject, given, named
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.elementary import log
from proofs.trusted.kernel.images import ImageArc, image_arc
from proofs.trusted.kernel.laps import SlopeRange, interval_of, signed, subject_of
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.shifts import closed_paths, irreducible, log_of, spectral_radius
from proofs.trusted.numbers import (
    Range,
    between,
    ceil_text,
    covered,
    floor_text,
    hull,
    show,
    show_range,
    within,
)

_LOG_BITS = 128
_MOST_CELLS = 100  # that orbits stay in
_PHASE = "phase", "phi"  # of the oscillator's map
_CONNECTIONS = (
    " The {point}s with sequences over 0, 1 and those over 1, 2 are two invariant Cantor sets, "
    "each a full shift on two symbols, with the fixed point p = 111... in common; they are the "
    "{point}s whose orbits stay in the interval up to p, and in the interval from p on. They are "
    "connected in both directions: a word over 0, 1, as long as one likes, and then a sequence "
    "over 1, 2 belong to a {point} whose orbit begins near the first set and ends in the second "
    "one; a sequence infinite to both sides, over 0, 1 in the past and over 1, 2 in the future, to "
    "a full orbit that tends to the first set in the past and lies in the second in the future; "
    "and the same with the two sets exchanged."
)


def listed(ranges: Iterable[Range]) -> str:
    """Write intervals."""
    return ", ".join(map(show_range, ranges))


def apart(intervals: Iterable[Range]) -> bool:
    """Whether intervals are disjoint, and in order of phase."""
    return all(one[1] < two[0] for one, two in pairwise(intervals))


@dataclass(frozen=True)
class StayingSet(AboutMap):
    """The points whose orbits stay in a region: in disjoint cells, f expanding on each, over some.

    onward[i]: the cells that f maps cell i over; it misses the others. slopes: bounds on f' on each
    cell. whole: whether the region is an interval, and in the image of each cell, an interval of
    phases, and f maps no other phase of the region into it.
    """

    function: Subject
    region: tuple[Range, ...]
    cells: tuple[Range, ...]
    slopes: tuple[Range, ...]
    onward: tuple[tuple[int, ...], ...]
    whole: bool = False

    def __post_init__(self) -> None:
        """Raise Unproved unless all is in order and apart, f expands, the graph is irreducible."""
        count = len(self.cells)
        if not count or not apart(self.cells) or not apart(self.region):
            raise Unproved("cells, and the intervals of a region, are expected apart and in order")
        ordered = all(low <= high for low, high in self.slopes)
        if len(self.slopes) != count or not ordered or self.expansion <= 1:
            raise Unproved("f does not expand")
        known = all(list(x) == sorted(set(x) & set(range(count))) for x in self.onward)
        if len(self.onward) != count or not known or not irreducible(dict(enumerate(self.onward))):
            raise Unproved("no path leads from every cell to every one")
        if self.whole and (len(self.region) > 1 or not self.full):
            raise Unproved("not every cell is mapped over the region")

    @property
    def steepness(self) -> Range:
        """Bounds on |f'|."""
        return hull([signed(*each) for each in zip(self.slopes, self.signs, strict=True)])

    @property
    def expansion(self) -> Fraction:
        """The least |f'|."""
        return self.steepness[0]

    @property
    def interval(self) -> Range:
        """The region, where it is one interval."""
        (interval,) = self.region
        return interval

    @property
    def is_horseshoe(self) -> bool:
        """Whether it is a full shift on two sets of an interval, I0 and I1."""
        return self.whole and len(self.cells) == 2

    @property
    def gap(self) -> Range:
        """The phases between I0 and I1 (open)."""
        (_, low), (high, _) = self.cells
        return low, high

    @property
    def sets(self) -> str:
        """I0 and I1, in words."""
        return ", ".join(f"I{index} = {show_range(cell)}" for index, cell in enumerate(self.cells))

    @property
    def signs(self) -> tuple[int, ...]:
        """Those of f' on the cells."""
        return tuple(1 if low > 0 else -1 for low, _ in self.slopes)

    @property
    def is_null(self) -> bool:
        """Whether it has measure zero: m^n intervals, c/mu^(n-1) long at most, cover it, mu > m."""
        return self.expansion > len(self.cells)

    @property
    def full(self) -> bool:
        """Whether each of two cells or more is mapped over all."""
        return all(len(after) == len(self.cells) > 1 for after in self.onward)

    @property
    def orbit(self) -> tuple[Range, ...]:
        """The cells in the order of the orbit, where all that stays is one; () where it is not."""
        if any(len(after) > 1 for after in self.onward):
            return ()
        path = [0]
        while (following := self.onward[path[-1]][0]) != 0:
            path.append(following)
        return tuple(self.cells[i] for i in path)

    @property
    def bracketed(self) -> bool:
        """Whether the region is nothing but the cells."""
        return self.cells == self.region

    @cached_property
    def growth(self) -> Range:
        """Bounds on the number whose log is the entropy."""
        return spectral_radius(dict(enumerate(self.onward)))

    @property
    def entropy(self) -> Range:
        """Bounds on the entropy of f on the set."""
        low, high = (log(end, _LOG_BITS).range for end in self.growth)
        return low[0], high[1]

    @cached_property
    def fixed_points(self) -> list[int]:
        """How many phases f^n fixes there, n = 1, 2, ...: the closed paths of n steps."""
        return closed_paths(dict(enumerate(self.onward)))

    @property
    def sentence(self) -> str:
        f, (point, x) = named(self.function), ("point", "x") if self.place is None else _PHASE
        if self.orbit:
            points = "" if self.bracketed else f", with one point in each of {listed(self.orbit)}"
            return f"{given(self.function)}{self.brief}{points}."
        sets = ", ".join(f"{index} = {show_range(cell)}" for index, cell in enumerate(self.cells))
        region, over = "these sets" if self.bracketed else listed(self.region), ""
        if self.whole:
            over = (
                f", maps each of them one-to-one over {region}, and no other {point} there into it"
            )
        falls = [f"{index}" for index, sign in enumerate(self.signs) if sign < 0]
        if falls:
            over = f", decreasing on {', '.join(falls)}{over}"
        steps = f"full shift on {len(self.cells)} symbols"
        if not self.full:
            arrows = (f"{i} by {', '.join(map(str, x))}" for i, x in enumerate(self.onward))
            steps = (
                "subshift of the sequences in which each symbol is followed so: "
                f"{', '.join(arrows)}"
            )
        null = " of Lebesgue measure zero" if self.is_null else ""
        longest = max(high - low for low, high in self.cells)
        counts = f"{len(self.cells)}^n fixed points there for every n"
        if not self.full:
            numbers = ", ".join(map(str, self.fixed_points))
            counts = f"{numbers} fixed points there for n = 1, ..., 8"
        more = _CONNECTIONS.format(point=point) if self._is_chain else ""
        return (
            f"{given(self.function)}{f} is continuously differentiable and monotone on each of the "
            f"sets {sets}, with {self._slope} in {between(self.steepness, 3)}{over}. The {point}s "
            f"whose orbits stay in {region} are a Cantor set{null}, on which {f} is topologically "
            f"conjugate to the one-sided {steps}, the n-th symbol being the number of the set that "
            f"{f}^n({x}) lies in. For every n and each word of n symbols that occurs, the {point}s "
            f"with {x}, ..., {f}^(n-1)({x}) in its sets are a closed interval, disjoint from those "
            f"of the other words and at most {show(longest)}/{floor_text(self.expansion, 3)}^(n-1) "
            f"long. {f}^n has {counts}; there are periodic orbits of {self._periods}, uncountably "
            f"many nonperiodic ones and a dense one; the entropy of {f} there is "
            f"{log_of(self.growth)}.{more}"
        )

    @property
    def _periods(self) -> str:
        return "every period" if self.full else "arbitrarily high periods"

    @property
    def latex(self) -> str:
        if not self.whole or self.place is None:
            return ""
        low, high = floor_text(self.expansion, 3), ceil_text(self.steepness[1], 3)
        size = self._slope
        return rf"f(I_j) \supseteq I,\quad {low} \le {size} \le {high} \text{{ on all }} I_j"

    @property
    def _slope(self) -> str:
        slope = f"{named(self.function)}'"
        return slope if self._rises else f"|{slope}|"

    @property
    def _rises(self) -> bool:
        return set(self.signs) == {1}

    @property
    def _is_chain(self) -> bool:
        """Whether it holds two full shifts that are connected."""
        return self.whole and self._rises and len(self.cells) == 3

    @property
    def brief(self) -> str:
        if period := len(self.orbit):
            orbit = "fixed point" if period == 1 else f"periodic orbit of period {period}"
            return f"the orbits that stay in {listed(self.region)} are one unstable {orbit}"
        kind, least = "full shift" if self.full else "subshift", floor_text(self.expansion, 3)
        if self.is_horseshoe:
            return f"a horseshoe on {self.sets}, {self._slope} >= {least}"
        return f"a {kind} on {len(self.cells)} symbols, {self._slope} >= {least}"


def staying_set(
    region: Sequence[Range], cells: Sequence[SlopeRange], gaps: Sequence[Avoids]
) -> StayingSet:
    """Theorem. Let cells lie in a region, intervals that are apart, and meet at ends at most, |f'|
    > 1 on each, with an image shorter than the circle. Let cells and gaps cover the region, and let
    f map each gap outside a set that contains the region. Join a cell to those that its image may
    meet, and leave out those from which no infinite path starts. Let the others be apart, each
    image contain those that it is joined to, and a path lead from each to each. Then what the
    sentence says, of a region and cells in order of phase, whatever the order given: of the whole,
    too, if each image is an interval of phases that contains all of the region, one interval.

    Proof. 0. An orbit that stays runs through the cells, along the arrows, so in those that are not
    left out. f is monotone on C_i and its image is shorter than the circle: f is one-to-one there,
    and the phases of C_i that are sent into an interval inside the image are an interval.
    1. So for a path i_0, ..., i_n the phases phi with f^k(phi) in C_(i_k), k <= n, are a closed
    interval, that f maps onto that of i_1, ..., i_n, and at most max |C| / mu^n long, mu = min |f'|
    > 1; for what is no path there are none. 2. Nested, these shrink to one phase for each infinite
    path: itineraries are a bijection to the paths. The cells are apart and f is continuous on them,
    so it is continuous; paths are compact: it is a homeomorphism, and turns f into the shift. One
    path alone is a periodic orbit, repelling as |f'| > 1. 3. The shift on the paths of other such
    graphs is as said, see `is_chaotic`; its entropy is the log of the spectral radius (Lind
    and Marcus 1995, theorem 4.3.1), and closed paths are its periodic points. 4. Where f increases
    and images contain all of an interval, the order of phases is the lexicographic order of
    sequences. So, on three symbols, f^n(phi) <= p for all n if and only if no sequence moved on
    begins with 2, that is, none of the symbols is 2; f^n(phi) >= p if and only if none is 0. Every
    sequence has its phase, and those of sequences that agree for long are close.
    """
    function, cells = subject_of([*cells, *gaps]), sorted(cells, key=lambda x: x.domain)
    region = sorted(interval_of(function, part) for part in region)
    if any(one.domain[1] > two.domain[0] for one, two in pairwise(cells)):
        raise Unproved("cells overlap")
    for cell in cells:
        if not cell.expands or not any(within(cell.domain, part) for part in region):
            raise Unproved("on a cell f does not expand, or it leaves the region")
    if not all(within(part, gap.target) for part in region for gap in gaps):
        raise Unproved("a gap is not proved to avoid the region")
    known = sorted([*(cell.domain for cell in cells), *(gap.source for gap in gaps)])
    if not all(covered(part, known) for part in region):
        raise Unproved("cells and gaps do not cover the region")
    arcs = [image_arc(cell) for cell in cells]
    alive = _going_on(cells, arcs)
    onward = [_over(arcs[i], [cells[j].domain for j in alive]) for i in alive]
    whole = len(region) == 1 < len(cells) and all(
        arc.is_interval and arc.covers(region[0]) for arc in arcs
    )
    slopes = tuple(cells[i].bounds() for i in alive)
    kept = tuple(cells[i].domain for i in alive)
    return StayingSet(function, tuple(region), kept, slopes, tuple(onward), whole)


def _going_on(cells: Sequence[SlopeRange], arcs: Sequence[ImageArc]) -> list[int]:
    """Return the places of the cells from which infinite paths start."""
    METER.get().spend(len(cells) ** 2)
    onward = [[j for j, y in enumerate(cells) if not arc.misses(y.domain)] for arc in arcs]
    alive = set(range(len(cells)))
    while dying := {i for i in alive if alive.isdisjoint(onward[i])}:
        METER.get().spend(sum(len(onward[i]) for i in alive))
        alive -= dying
    if len(alive) > _MOST_CELLS:
        raise Unproved(f"orbits may stay in more than {_MOST_CELLS} cells")
    METER.get().spend(len(alive) ** 3)
    return sorted(alive)


def _over(arc: ImageArc, cells: Sequence[Range]) -> tuple[int, ...]:
    """Return the places of the cells that an image contains; it must miss the others."""
    if not all(arc.covers(cell) or arc.misses(cell) for cell in cells):
        raise Unproved(f"{arc.brief}: a cell is proved neither covered nor missed")
    return tuple(j for j, cell in enumerate(cells) if arc.covers(cell))


def read_part(context: Context, reader: Reader) -> SlopeRange:
    """Read {slopes: a step of that rule, domain: two of its points}: what it says in between."""
    name, domain = reader.fields("slopes", "domain")
    whole = context.step(name, SlopeRange)
    METER.get().spend(8 * len(whole.points))
    part = whole.over(domain.range())
    if part is None:
        raise domain.fail("not two points of the step")
    return part


def prove_staying_set(context: Context, reader: Reader) -> StayingSet:
    """Rule `staying-set`: {region: [[low, high], ...], cells: [{slopes, domain}], gaps}.

    For a map of the line, or of a circle. slopes: a step of the rule `slopes`;
    domain: two of its points; gaps: names of steps `avoids`. Conclusion: `staying_set`.
    """
    region, cells, gaps = reader.fields("region", "cells", "gaps")
    return staying_set(
        [part.range() for part in region.items(1, 500)],
        [read_part(context, cell) for cell in cells.items(1, 500)],
        [context.step(gap, Avoids) for gap in gaps.items(0, 50)],
    )
