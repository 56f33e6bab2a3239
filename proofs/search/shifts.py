"""Horseshoes at any parameters, in floating point: branches of f, and sets mapped across them all.

Candidates only: `proofs.search.beyond` proves or discards them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, groupby, islice, pairwise

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.budget import reach
from proofs.search.orbits import Seen
from proofs.search.portrait import Check, stretches
from proofs.search.repair import rounded_slopes
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import BITS
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import TURN, Range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Parameters

_GRID = 1500  # phases that are looked at
_STEEP = 1.02  # the least |f'| of a piece
_SPARES = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0002, 0.00002)  # from the most
_MOST_SYMBOLS = 8
_MOST_PAIRS = 24
_FINE = 6000  # phases, where fewer show nothing
_SAMPLES, _BETWEEN = 8, 128  # phases of a set, and of the gap, that are looked at


# -- branches, in floating point -------------------------------------------------------------------


@dataclass(frozen=True)
class Piece:
    """Phases in a row on a branch of f where it expands, and about their images: phase + time."""

    phases: tuple[float, ...]
    images: tuple[float, ...]

    @property
    def arc(self) -> tuple[float, float]:
        """The image, from below."""
        low, high = sorted((self.images[0], self.images[-1]))
        return low, high

    @property
    def falls(self) -> bool:
        """Whether f decreases."""
        return self.images[0] > self.images[-1]

    def preimage(self, image: float) -> float | None:
        """Return about the phase with this image; None if there is none."""
        phases, images = self.phases, self.images
        if self.falls:
            phases, images = phases[::-1], images[::-1]
        if not images[0] <= image <= images[-1]:
            return None
        for k in range(1, len(images)):
            if image <= images[k]:
                share = (image - images[k - 1]) / (images[k] - images[k - 1])
                return phases[k - 1] + share * (phases[k] - phases[k - 1])
        return None


def pieces(
    system: System,
    grid: int = _GRID,
    farthest: float | None = None,
    check: Check = lambda: None,
) -> list[Piece]:
    """Return the pieces of branches on which f expands, as a grid of phases shows them."""
    seen = stretches(system, grid, farthest or reach(system.eta), check)
    return [piece for stretch in seen for piece in expanding(stretch.points)]


def expanding(branch: Sequence[Seen]) -> Iterator[Piece]:
    """Yield the pieces of one branch on which f expands."""
    for steep, points in groupby(branch, lambda point: abs(point.slope) >= _STEEP):
        run = list(points)
        if steep and len(run) > 2:
            yield Piece(tuple(x.phase for x in run), tuple(x.image for x in run))


# -- horseshoes ------------------------------------------------------------------------------------

Symbol = tuple[Piece, int]  # a piece, and the turns of the table that an image is less


def symbols(seen: Sequence[Piece]) -> list[Symbol]:
    """Return the pieces, once for each turn that their images reach."""
    return [
        (piece, turn)
        for piece in seen
        for turn in range(int(piece.arc[0] // math.tau), int(piece.arc[1] // math.tau) + 1)
    ]


def cells(chosen: Sequence[Symbol], spare: float) -> list[tuple[float, float]] | None:
    """Return the sets that f maps over an interval J around all of them, by `spare` at each end.

    J is the greatest that the images share, then the hull of the sets and the spare, and so on.
    """
    low = max(0.0, *(piece.arc[0] - math.tau * turn for piece, turn in chosen))
    high = min(float(TURN), *(piece.arc[1] - math.tau * turn for piece, turn in chosen))
    for _ in range(60):
        sets = []
        for piece, turn in chosen:
            ends = piece.preimage(math.tau * turn + low), piece.preimage(math.tau * turn + high)
            if ends[0] is None or ends[1] is None or low >= high:
                return None
            sets.append((min(ends[0], ends[1]), max(ends[0], ends[1])))
        sets.sort()
        first, last = sets[0][0] - spare, max(end for _, end in sets) + spare
        if first < low or last > high:
            return None
        if first - low + high - last < spare / 100:
            break
        low, high = first, last
    apart = all(left[1] + spare / 10 < right[0] for left, right in pairwise(sets))
    return sets if apart else None


def full_shifts(seen: Sequence[Piece]) -> Iterator[list[Range]]:
    """Yield sets, in short decimals, on which f seems to be a full shift, most symbols first."""
    letters = symbols(seen)
    for family in sorted(families(letters, _MOST_SYMBOLS), key=len, reverse=True):
        yield from islice(with_spare(family), 1)


def pairs(seen: Sequence[Piece]) -> Iterator[tuple[Range, Range]]:
    """Yield I0 and I1, with ever less spare, on which f seems to be a full shift.

    Rather where f increases on both.
    """
    for family in sorted(
        families(symbols(seen), 2), key=lambda pair: sum(x[0].falls for x in pair)
    ):
        yield from ((left, right) for left, right in with_spare(family))


def own_sets(statement: Parameters) -> Parameters | None:
    """Return the statement about I0 and I1 found at its oscillator, bounds of |f'| rounded outward.

    Rather those that the flights of each set are proved for in one piece, as for the dimension.
    None where no horseshoe is seen.
    """
    system = System(statement.eta, statement.nu)
    for grid in (_GRID, _FINE):
        near = (
            _statement(statement, system, sets)
            for sets in islice(pairs(pieces(system, grid)), _MOST_PAIRS)
        )
        statements = [each for each in near if each is not None]
        if statements:
            certain = (
                each for each in statements if _in_one_piece(system, (each.left, each.right))
            )
            return next(certain, statements[0])
    return None


def _statement(
    statement: Parameters, system: System, sets: tuple[Range, Range]
) -> Parameters | None:
    """Return the statement about sets; None unless f seems to be monotone on each and to map both
    over I, their hull, and all between them past it.
    """
    (low, high), signs = (float(sets[0][0]), float(sets[1][1])), list[int]()
    slopes = list[float]()
    for domain in sets:
        seen = [next_impact(system, phase) for phase in _evenly(domain, _SAMPLES)]
        impacts = [each for each in seen if each is not None]
        signs.append(1 if impacts and impacts[0].slope > 0 else -1)
        ends = [impacts[k].phase for k in (0, -1)][:: signs[-1]] if impacts else [high, low]
        steep = [each.slope * signs[-1] for each in impacts]
        if len(impacts) < len(seen) or min(steep) <= 1 or ends[0] > low or ends[1] < high:
            return None
        slopes += steep
    between = (next_impact(system, phase) for phase in _evenly((sets[0][1], sets[1][0]), _BETWEEN))
    if any(each is not None and low <= each.phase <= high for each in between):
        return None
    return replace(
        statement,
        left=sets[0],
        right=sets[1],
        interval=(sets[0][0], sets[1][1]),
        slopes=rounded_slopes((Fraction(min(slopes)), Fraction(max(slopes))), 1),
        ratios=None,
        printed_s0=None,
        signs=(signs[0], signs[1]),
    )


def _evenly(domain: Range, count: int) -> list[float]:
    """Return phases from one end of an interval to the other."""
    low, high = map(float, domain)
    return [low + (high - low) * k / count for k in range(count + 1)]


def _in_one_piece(system: System, sets: Sequence[Range]) -> bool:
    """Whether the first impacts of each set are proved in one piece."""
    f = PlasticMap(system.place, HORIZON)
    try:
        return all(f.window(enclosed((each,), BITS)) for each in sets)
    except Unproved:
        return False


def families(letters: Sequence[Symbol], most: int) -> list[list[Symbol]]:
    """Return symbols that seem to make a full shift, up to so many together, each family once."""
    least = _SPARES[-1]
    grown: list[list[Symbol]] = []
    for pair in combinations(letters, 2):
        if any(set(map(id, pair)) <= set(map(id, family)) for family in grown):
            continue
        family = list(pair)
        if not cells(family, least):
            continue
        for symbol in letters:
            if len(family) < most and symbol not in family:
                more = [*family, symbol]
                family = more if cells(more, least) else family
        grown.append(family)
    return grown


def with_spare(family: Sequence[Symbol]) -> Iterator[list[Range]]:
    """Yield the sets of a full shift, rounded outward, from the most spare that there is on."""
    for spare in _SPARES:
        sets = cells(family, spare)
        if sets:
            yield rounded_out(sets, spare)


def rounded_out(sets: Sequence[tuple[float, float]], spare: float) -> list[Range]:
    """Round sets outward to decimals, of the fewest places that leave room around them."""
    narrowest = min(high - low for low, high in sets)
    gap = min(right[0] - left[1] for left, right in pairwise(sets))
    room = min(narrowest / 20, gap / 20, spare / 5)
    unit = Fraction(1, 10 ** max(2, math.ceil(-math.log10(room))))
    return [(Fraction(low) // unit * unit, -(Fraction(-high) // unit) * unit) for low, high in sets]
