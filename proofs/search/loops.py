"""Two loops of f through one interval: a horseshoe of several steps, in floating point.

From an interval J backwards: intervals that f^n maps onto it, n = 1, 2, ..., until two of them lie
in J. With those on their ways they are the cells of a Markov set, of entropy > 0. Candidates only:
`proofs.search.beyond` proves or discards them.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.search.budget import reach
from proofs.search.portrait import Check
from proofs.search.shifts import Piece, rounded_out
from proofs.trusted.numbers import Range

_STARTS, _SETTLED = 12, 30  # orbits, and their impacts until J is laid around them
_WIDTHS = (0.1, 0.03, 0.01, 0.003, 0.001)  # of J
_NODES = 400  # intervals that are mapped back
_MOST_LOOPS = 4
_SPARE = 0.03  # by how much images overshoot, relative to what they cover
_NARROWEST = 1e-9
_HALVINGS = 50


@dataclass(frozen=True)
class _Node:
    """An interval that f maps onto its target, by a piece and a number of turns; J has none."""

    ends: tuple[float, float]
    piece: int = -1
    turn: int = 0
    target: _Node | None = None

    def way(self) -> list[_Node]:
        """The intervals from this one on, without J."""
        return [] if self.target is None else [self, *self.target.way()]


def loops(
    system: System, pieces: Sequence[Piece], check: Check = lambda: None
) -> Iterator[list[Range]]:
    """Yield the cells of two loops, in short decimals."""
    for low, high in _intervals(system):
        check()
        for pair in combinations(_returns((low, high), pieces), 2):
            cells = _cells(system, pieces, (low, high), pair)
            if cells is not None:
                yield rounded_out(cells, _SPARE * min(b - a for a, b in cells))


def _intervals(system: System) -> Iterator[tuple[float, float]]:
    """Yield intervals around phases that orbits visit late, the wider ones first."""
    late = []
    for k in range(_STARTS):
        phase: float | None = math.tau * (k + 0.5) / _STARTS
        for _ in range(_SETTLED):
            impact = next_impact(system, phase, reach(system.eta)) if phase is not None else None
            if impact is not None:
                late.append(impact.phase)
            phase = None if impact is None else impact.phase
    late = late[-1 :: -max(1, len(late) // (2 * _STARTS))]
    for width in _WIDTHS:
        for phase in late:
            if width < phase < math.tau - width:
                yield phase - width / 2, phase + width / 2


def _returns(ends: tuple[float, float], pieces: Sequence[Piece]) -> list[_Node]:
    """Return intervals in J that come back onto it, the soonest first."""
    returning: list[_Node] = []
    waiting = deque([_Node(ends)])
    for _ in range(_NODES):
        if not waiting or len(returning) == _MOST_LOOPS:
            break
        target = waiting.popleft()
        for node in _before(target, pieces):
            if ends[0] < node.ends[0] and node.ends[1] < ends[1]:
                returning.append(node)
            elif node.ends[1] < ends[0] or ends[1] < node.ends[0]:
                waiting.append(node)
    return returning[:_MOST_LOOPS]


def _before(target: _Node, pieces: Sequence[Piece]) -> Iterator[_Node]:
    """Yield the intervals that are mapped onto another in one step."""
    low, high = _wider(target.ends)
    for index, piece in enumerate(pieces):
        for turn in range(int(piece.arc[0] // math.tau), int(piece.arc[1] // math.tau) + 1):
            ends = piece.preimage(low + math.tau * turn), piece.preimage(high + math.tau * turn)
            if ends[0] is not None and ends[1] is not None and abs(ends[1] - ends[0]) > _NARROWEST:
                yield _Node((min(ends[0], ends[1]), max(ends[0], ends[1])), index, turn, target)


def _wider(ends: tuple[float, float]) -> tuple[float, float]:
    spare = _SPARE * (ends[1] - ends[0])
    return ends[0] - spare, ends[1] + spare


def _cells(
    system: System, pieces: Sequence[Piece], hull: tuple[float, float], pair: Sequence[_Node]
) -> list[tuple[float, float]] | None:
    """Return the cells of two loops, exactly, if they are apart and in J or away from it."""
    exact: dict[tuple[tuple[int, int], ...], tuple[float, float]] = {(): hull}
    for node in pair:
        word: tuple[tuple[int, int], ...] = ()
        for each in reversed(node.way()):
            after, word = word, ((each.piece, each.turn), *word)
            ends = exact.get(word) or _exact(system, pieces[each.piece], each, exact[after])
            if ends is None:
                return None
            exact[word] = ends
    inside = [hull[0] < low and high < hull[1] for low, high in exact.values()]
    cells = sorted(ends for word, ends in exact.items() if word)
    apart = all(a[1] + _SPARE * (a[1] - a[0] + b[1] - b[0]) < b[0] for a, b in pairwise(cells))
    return cells if apart and inside.count(True) == len(pair) else None


def _exact(
    system: System, piece: Piece, node: _Node, target: tuple[float, float]
) -> tuple[float, float] | None:
    """Return the ends of the interval of a piece that f maps onto a target and a little more."""
    low, high = (_preimage(system, piece, end + math.tau * node.turn) for end in _wider(target))
    return None if low is None or high is None else (min(low, high), max(low, high))


def _preimage(system: System, piece: Piece, image: float) -> float | None:
    """Return the phase of a piece with this image, by bisection."""
    pairs = enumerate(pairwise(piece.images))
    k = next((k for k, ends in pairs if min(ends) <= image <= max(ends)), None)
    if k is None:
        return None
    low, high = piece.phases[k], piece.phases[k + 1]
    rises = piece.images[k + 1] > piece.images[k]
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        impact = next_impact(system, middle, reach(system.eta))
        if impact is None:
            return None
        low, high = (middle, high) if (impact.lifted < image) == rises else (low, middle)
    return low
