"""Which orbits stay in an interval: witnesses for the rule `staying-set`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from intervals import Undecided
from proofs.motion.digits import middle, phase_after
from proofs.motion.simulate import Impact, next_impact
from proofs.search.evidence import FAILED, Proof
from proofs.search.steps import Prover
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, within

_FINE = Fraction(1, 1000)
_COARSE = Fraction(1, 100)
_FINEST = Fraction(1, 10**4)
_WIDEST = 5  # how many hundredths an interval is widened to each side
_CUTS = 4


@dataclass(frozen=True)
class Sketch:
    """A staying set in floating point: the cuts of its pieces, and the gaps between."""

    interval: Range
    pieces: tuple[tuple[Fraction, ...], ...]
    gaps: tuple[Range, ...]


@dataclass
class Sketcher:
    """Finds pieces by the map in floating point: candidates, never evidence."""

    prover: Prover
    _impacts: dict[Fraction, Impact | None] = field(default_factory=dict)

    def image(self, phase: Fraction) -> float | None:
        """Return about f(phase)."""
        if phase not in self._impacts:
            self._impacts[phase] = next_impact(self.prover.system, float(phase))
        impact = self._impacts[phase]
        return None if impact is None else impact.phase

    def sketch(self, interval: Range, unit: Fraction) -> Sketch:
        """Return the runs of multiples of `unit` that f leaves in the interval, one wider."""
        low, high = interval
        grid = [low + unit * i for i in range(int((high - low) / unit) + 1)]
        inside = [(y := self.image(x)) is not None and low <= y <= high for x in grid]
        pieces: list[tuple[Fraction, ...]] = []
        begin: int | None = None
        for i, stays in enumerate([*inside, False]):
            if begin is not None and (not stays or self._jumps(grid, i)):
                pieces.append((self._wider(grid, begin, -1), self._wider(grid, i - 1, 1)))
                begin = None
            if stays and begin is None:
                begin = i
        marks = [low, *(end for piece in pieces for end in piece), high]
        gaps = [(a, b) for a, b in zip(marks[::2], marks[1::2], strict=True) if a < b]
        return Sketch(interval, tuple(pieces), tuple(gaps))

    def _jumps(self, grid: Sequence[Fraction], i: int) -> bool:
        """Whether f jumps between two neighbouring phases: its flight times are far apart."""
        if not 0 < i < len(grid):
            return True
        left, right = (self._impacts.get(x) for x in (grid[i - 1], grid[i]))
        return left is None or right is None or abs(left.time - right.time) > 1

    def _wider(self, grid: Sequence[Fraction], i: int, way: int) -> Fraction:
        """Return the next phase on, if it is on the same branch."""
        if self._jumps(grid, i + (way > 0)):
            return grid[i]
        return grid[i + way]

    def refined(self, sketch: Sketch) -> Sketch:
        """Cut the pieces at the images of their ends, rounded away from the rest of the image."""
        cuts = {piece[0]: -1 for piece in sketch.pieces} | {piece[-1]: 1 for piece in sketch.pieces}
        fresh = dict(cuts)
        for _ in range(_CUTS):
            following: dict[Fraction, int] = {}
            for phase, way in fresh.items():
                image = self.image(phase)
                if image is None:
                    continue
                units = Fraction(image) / _FINEST
                place = (units.__floor__() if way < 0 else units.__ceil__()) * _FINEST
                if place not in cuts and any(a < place < b for a, *_, b in sketch.pieces):
                    following[place] = way
            cuts |= following
            fresh = following
        pieces = tuple(
            tuple(sorted(x for x in cuts if piece[0] <= x <= piece[-1])) for piece in sketch.pieces
        )
        return Sketch(sketch.interval, pieces, sketch.gaps)

    def full_shifts(self, printed: Range, around: Range) -> list[Sketch]:
        """Return what looks like full shifts on two and three symbols, around both intervals."""
        widest = min(printed[0], around[0]), max(printed[1], around[1])
        sketches = self.full_shift(printed, 2), self.full_shift(widest, 3)
        return [each for each in sketches if each is not None]

    def full_shift(self, interval: Range, symbols: int) -> Sketch | None:
        """Return the least widening of an interval that looks like a full shift."""
        for extra in range(2 * _WIDEST + 1):
            for below in range(max(0, extra - _WIDEST), min(extra, _WIDEST) + 1):
                low = interval[0] - below * _COARSE
                high = interval[1] + (extra - below) * _COARSE
                seen = self.sketch((low, high), _COARSE)
                if len(seen.pieces) == symbols and all(map(self._over(low, high), seen.pieces)):
                    return seen
        return None

    def _over(self, low: Fraction, high: Fraction) -> Callable[[Sequence[Fraction]], bool]:
        def covers(piece: Sequence[Fraction]) -> bool:
            images = [self.image(piece[0]), self.image(piece[-1])]
            ends = sorted(x for x in images if x is not None)
            return len(ends) == 2 and ends[0] <= low and high <= ends[1]

        return covers


def prove_staying(prover: Prover, printed: Range, around: Range) -> Proof:
    """Prove which orbits stay in `printed`, and full shifts on two and three symbols around it.

    The second one in an interval that contains `around` too. What is not proved is left out.
    """
    sketcher = Sketcher(prover)
    few = sketcher.refined(sketcher.sketch(printed, _FINE))
    shifts = sketcher.full_shifts(printed, around)
    proofs = Pieces(prover, [few, *shifts])
    proof: Proof = []
    orbits: list[tuple[Range, ...]] = []
    with suppress(*FAILED):
        name, kept = proofs.prove(few)
        proof.append((name, kept))
        orbits += filter(None, [kept.orbit])
    for name, shift in _shifts(proofs, shifts):
        proof.append((name, shift))
        orbits += [(shift.cells[0],), (shift.cells[-1],)]
    brackets: list[tuple[Range, ...]] = []
    for cells in orbits:
        if not any(len(x) == len(cells) and all(map(within, x, cells)) for x in brackets):
            with suppress(*FAILED):
                name, kept = periodic_orbit(prover, cells)
                proof.append((name, kept))
                brackets.append(kept.orbit)
    return proof


def prove_shift(prover: Prover, around: Range, symbols: int) -> tuple[str, StayingSet]:
    """Prove a full shift on the least interval around the given one that looks like one."""
    sketch = Sketcher(prover).full_shift(around, symbols)
    if sketch is None:
        raise Undecided("no full shift is seen")
    return Pieces(prover, [sketch]).prove(sketch)


def prove_full_shifts(
    prover: Prover, printed: Range, around: Range
) -> list[tuple[str, StayingSet]]:
    """Prove the full shifts of `prove_staying` alone."""
    shifts = Sketcher(prover).full_shifts(printed, around)
    return _shifts(Pieces(prover, shifts), shifts)


def _shifts(proofs: Pieces, sketches: Sequence[Sketch]) -> list[tuple[str, StayingSet]]:
    proof = []
    for sketch in sketches:
        with suppress(*FAILED):
            name, kept = proofs.prove(sketch)
            if kept.whole:
                proof.append((name, kept))
    return proof


@dataclass
class Pieces:
    """f' on the pieces of several sketches: pieces that overlap are proved as one."""

    prover: Prover
    sketches: Sequence[Sketch]
    _known: list[tuple[str, SlopeRange]] = field(default_factory=list)

    def prove(self, sketch: Sketch) -> tuple[str, StayingSet]:
        """Record the step about what stays, and those that it needs."""
        slopes = [self._slopes(piece) for piece in sketch.pieces]
        gaps = [self.prover.avoids(gap, sketch.interval) for gap in sketch.gaps]
        ends = [
            (proved, pair)
            for proved, cuts in zip(slopes, sketch.pieces, strict=True)
            for pair in pairwise(cuts)
        ]
        return self.prover.stays([sketch.interval], ends, gaps)

    def _slopes(self, piece: Sequence[Fraction]) -> tuple[str, SlopeRange]:
        for name, slopes in self._known:
            if set(piece) <= set(slopes.points):
                return name, slopes
        points = set(piece)
        for sketch in self.sketches:
            for other in sketch.pieces:
                if other[0] <= piece[-1] and piece[0] <= other[-1]:
                    points |= set(other)
        self._known.append(self.prover.slopes(sorted(points)))
        return self._known[-1]


def periodic_orbit(prover: Prover, cells: Sequence[Range]) -> tuple[str, StayingSet]:
    """Bracket a periodic orbit with one point in each cell: it is all that stays in the brackets.

    f expands, so it maps each bracket over the next one.
    """
    accuracy = Fraction(1, 10 ** max(6, prover.digits + 1))
    phase = _newton(prover, cells, accuracy)
    brackets = []
    for _ in cells:
        low, high = ((phase // accuracy + shift) * accuracy for shift in (-2, 3))
        brackets.append((low, high))
        phase = _value(prover, phase)[0]
    parts = [(prover.slopes(list(ends)), ends) for ends in brackets]
    return prover.stays(brackets, parts)


def _newton(prover: Prover, cells: Sequence[Range], accuracy: Fraction) -> Fraction:
    """Return about the point in the first cell of the orbit through cells, by Newton's method."""
    low, high = cells[0]
    phase = (low + high) / 2
    for _ in range(40):
        image, slope = phase, Fraction(1)
        for _ in cells:
            image, factor = _value(prover, image)
            slope *= factor
        step = (image - phase) / (1 - slope)
        phase = min(high, max(low, round((phase + step) / accuracy * 10**6) * accuracy / 10**6))
        if abs(step) < accuracy:
            return phase
    raise Undecided("no periodic orbit found")


def _value(prover: Prover, phase: Fraction) -> tuple[Fraction, Fraction]:
    """Return about (f(phase), f'(phase))."""
    x = enclosed(((phase, phase),), prover.bits)
    time = prover.impact_map.impact(x).range
    return phase_after(phase, time, prover.bits)[0], middle(prover.impact_map.jacobian(x)[0][0])
