"""Beyond the paper: curves in the plane of eta and nu. Rows C1 to C3.

Where curves of grazing are is seen in floating point; then they are followed in slanted boxes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from intervals import Undecided
from proofs.methods.arcs import follow, thin
from proofs.methods.derivation import Derivation
from proofs.methods.lemmas import krawczyk, newton, require_zero, written
from proofs.search.derivations import Steps
from proofs.search.evidence import FAILED, Evidence
from proofs.search.request import Request, proving
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import centre_of
from proofs.trusted.kernel.zeros import Piece
from proofs.trusted.numbers import Range, hull, show
from proofs.trusted.paper.beyond.curves import curves, sticking
from proofs.trusted.paper.beyond.grazing import (
    ETA,
    FLIP,
    FOLD,
    GrazingCurve,
    ratio,
    require_one_touch,
    touch,
)
from proofs.trusted.paper.beyond.meetings import Meeting, sign

_MOST = 2  # table periods
_WIDEST = 2  # eta
_GRID = 40  # eta in an interval between multiples of 1/(2 n)
_TIMES = 240  # looked at in a table period
_EARLIEST = 0.1  # touch
_FEWEST = 6  # etas in a row
_STEP = Fraction(1, 25)
_NEAR = Fraction(1, 4000)  # how short pieces are next to a meeting point
_PIECES = 150
_PLACES = 16
_WIDENINGS = 3
_UNIT = Fraction(1, 10**8)
_SOFTEST = 4  # of the grid, in its first interval
_SHARES = (Fraction(1, 8), Fraction(3, 8), Fraction(5, 8), Fraction(7, 8))


class Seen(NamedTuple):
    """A point of a curve, in floating point."""

    eta: Fraction
    p: float
    time: float
    beyond: dict[str, bool]

    @property
    def guess(self) -> list[Fraction]:
        """Return it exactly."""
        return [self.eta, Fraction(self.p), Fraction(self.time)]


def _seen(n: int, q: float, eta: Fraction) -> Seen | None:
    """Return where flights begin to touch the table, for |nu| < 1, as p moves."""
    own, x = float(eta), math.pi * n * float(eta)
    side = -1 if 2 * n * eta // 1 % 2 else 1
    tangent, cos = own * math.tan(x), math.cos(x)

    def bound(t: float) -> float:
        mass = math.cos(own * t - x) / cos - 1 - q * tangent * math.sin(t)
        return -side * mass / (1 - math.cos(t))

    times = [math.tau * (k + 0.5) / _TIMES for k in range(_TIMES * n)]
    time = max(times, key=bound)
    p = side * bound(time)
    free = all(side * (math.cos(math.tau * m * own - x) / cos - 1) > 0 for m in range(1, n))
    if not free or p >= 1 or time < _EARLIEST or p * p + (q * tangent) ** 2 >= (1 - p) ** 2:
        return None
    beyond = {FOLD: p + (q * tangent) ** 2 > 0, FLIP: p > own**2 * (q * q + 1 / cos**2)}
    return Seen(eta, p, time, beyond)


def _runs(n: int, q: float) -> Iterator[list[Seen]]:
    """Yield curves: points one after the other, with times that do not jump."""
    for window in range(2 * n * _WIDEST):
        run: list[Seen] = []
        for k in range(1 if window else _SOFTEST, _GRID):
            eta = round((window + Fraction(k, _GRID)) / (2 * n), 4)
            seen = _seen(n, q, eta)
            if run and (seen is None or abs(seen.time - run[-1].time) > 0.5):
                yield run
                run = []
            run += [seen] if seen else []
        yield run


def seen_curves(n: int, epsilon: Fraction) -> list[list[Seen]]:
    """Return the curves of grazing that are seen, by points of each."""
    return [run for run in _runs(n, float(ratio(epsilon))) if len(run) >= _FEWEST]


@dataclass
class Curves:
    """Collects the steps of this group, each with its conclusion."""

    epsilon: Fraction
    derivation: Derivation = field(default_factory=lambda: Derivation({}))
    traced: list[tuple[str, GrazingCurve]] = field(default_factory=list)
    meetings: list[tuple[str, Meeting]] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    def grazing(self, n: int, run: Sequence[Seen]) -> None:
        """Follow a curve, and find where it meets others."""
        formula, epsilon = touch(n, self.epsilon), self.epsilon
        side = -1 if 2 * n * run[0].eta // 1 % 2 else 1
        crossings = {
            other: newton(touch(n, epsilon, other), first.guess)[0]
            for first, second in pairwise(run)
            for other in (FOLD, FLIP)
            if first.beyond[other] != second.beyond[other]
        }

        def accept(piece: Piece) -> None:
            low, high = piece.box[ETA]
            if high - low > _NEAR and any(
                low - _NEAR < point[ETA] < high + _NEAR for point in crossings.values()
            ):
                raise Undecided("a long piece next to another curve")
            require_one_touch(n, epsilon, side, piece)

        start = newton(formula, run[0].guess, axis=ETA)[0]
        traced = follow(formula, ETA, start, run[-1].eta, step=_STEP, most=_PIECES, accept=accept)
        pieces = [each.piece for each in traced]
        points = [thin(formula, ETA, guess, _PLACES)[1] for guess in _guesses(pieces)]
        name, curve = self._derived(
            "grazing-curve",
            n=str(n),
            epsilon=str(epsilon),
            pieces=[each.witness for each in traced],
            points=points,
        )
        self.traced.append((name, curve))
        for other, point in crossings.items():
            try:
                self._meeting(name, curve, other, point)
            except FAILED as failure:
                self.failures.append(f"{other} near eta = {float(point[ETA]):.6g}: {failure}")

    def _derived(self, rule: str, **witness: Any) -> tuple[str, Any]:
        name = self.derivation.add(rule, witness)
        return name, self.derivation.known[name]

    def _meeting(
        self, name: str, curve: GrazingCurve, other: str, near: Sequence[Fraction]
    ) -> None:
        """Prove that a curve meets another one at one point."""
        formula = touch(curve.n, self.epsilon, other)
        hulls = [piece.hull(ETA) for piece in curve.arc.pieces]
        pieces = enumerate(curve.arc.pieces)
        open_ones = [k for k, piece in pieces if not _has_sign(curve, other, piece)]
        if not open_ones:
            raise Undecided("the curves do not meet")
        nearby = hulls[max(open_ones[0] - 1, 0) : open_ones[-1] + 2]
        around = tuple(hull(sides) for sides in zip(*nearby, strict=True))
        _, witness = thin(formula, None, near, _PLACES)
        matrix = newton(formula, near)[1]
        for _ in range(_WIDENINGS):  # what has one zero may have it in a wider box alone
            image = krawczyk(formula, around, matrix)
            around = tuple(
                side if side[0] < each[0] and each[1] < side[1] else _wider(hull([side, each]))
                for side, each in zip(around, image.values(), strict=True)
            )
        require_zero(formula, around, matrix)
        met = self._derived(
            "grazing-meets",
            curve=name,
            other=other,
            around={"box": written(around), "matrix": [texts(row) for row in matrix]},
            box=witness,
        )
        self.meetings.append(met)


def _has_sign(curve: GrazingCurve, other: str, piece: Piece) -> bool:
    with suppress(Unproved):
        return bool(sign(curve, other, piece))
    return False


def _wider(side: Range) -> Range:
    """Return a range somewhat wider than another one, with short ends."""
    room = (side[1] - side[0]) / 8
    return (side[0] - room) // _UNIT * _UNIT, -(-(side[1] + room) // _UNIT) * _UNIT


def _guesses(pieces: Sequence[Piece]) -> Iterator[list[Fraction]]:
    """Yield about some points of a curve, at short decimals."""
    low, high = pieces[0].box[ETA][0], pieces[-1].box[ETA][1]
    for share in _SHARES:
        eta = round(low + (high - low) * share, 3)
        for piece in pieces:
            if piece.box[ETA][0] <= eta <= piece.box[ETA][1]:
                yield [*centre_of(piece.cut(ETA, eta))]
                break


@proving
def prove(request: Request) -> Evidence:
    """Prove closed forms of folds and flips, and follow the curves of grazing."""
    formulas = Steps(request.digits)
    evidence = Evidence(formulas.steps)
    for claim, stage, theorem in (("C1", "folds and flips", curves), ("C4", "sticking", sticking)):
        if request.asks(claim):
            request.tell(stage)
            proved = [formulas.prove(need) for need in theorem.needs]
            evidence.proofs[claim] = [each for each in proved if each is not None]
    if request.asks("C2", "C3"):
        derivation = Derivation({}, formulas.steps)
        followed = Curves(request.of.epsilon or Fraction(0), derivation)
        for n in range(1, _MOST + 1):
            for run in seen_curves(n, followed.epsilon):
                request.tell(f"grazing for n = {n}, eta from {show(run[0].eta)}")
                with suppress(*FAILED):
                    followed.grazing(n, run)
        evidence.proofs |= {"C2": [*followed.traced], "C3": [*followed.meetings]}
        evidence.notes["C3"] = "; ".join(followed.failures)
    return evidence
