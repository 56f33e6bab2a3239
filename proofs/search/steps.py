"""Proof steps of the plastic map: each proves something and records its witness.

The steps are those of `proofs.trusted.flights`, by the same names. A witness is what its lemmas say
of floats; the checker's rule concludes from it, and where it does not, from what they say of the
checker's numbers. So neither mpmath nor numpy is needed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any, TypeVar

from proofs.methods.derivation import Derivation
from proofs.methods.extremes import extremes
from proofs.methods.moran import moran_root
from proofs.motion.branch import Branch
from proofs.motion.covering import cover_by
from proofs.motion.system import System
from proofs.motion.witness import FlightBox, Seen, locate
from proofs.search.evidence import Proved, Steps, floats_first
from proofs.trusted.certificate import texts
from proofs.trusted.flights import FirstImpact
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, show_range
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.slopes import Avoids, Impact, comes_to

_Made = TypeVar("_Made")


class Prover(Derivation):
    """The proof steps about the plastic map of one oscillator; each is named after its rule."""

    def __init__(
        self, system: System, digits: int, horizon: Fraction, steps: Steps | None = None
    ) -> None:
        super().__init__({}, {} if steps is None else steps, Context(system.place))
        self.system, self.digits, self.horizon = system, digits, horizon

    @property
    def at(self) -> Place:
        """The oscillator that conclusions are about."""
        return self.system.place

    @property
    def bits(self) -> int:
        """Binary places of a bracket: enough for the digits after a loss of some 2^10."""
        return self.digits * 10 // 3 + 16

    def derive(self, rule: str, witness: dict[str, Any]) -> tuple[str, Any]:
        """Add a step; return its name, with what it concludes."""
        name = self.add(rule, witness)
        return name, self.known[name]

    def claimed(self, name: str) -> Proved:
        """Return the steps so far, that one claimed."""
        return self.at, self.steps, [name]

    def seen_or_proved(self, make: Callable[[bool], _Made]) -> _Made:
        """Make steps by what floats see; where the rules deny that, by the checker's numbers."""

        def made(floats: bool) -> _Made:
            with self.undone():
                return make(floats)

        return floats_first(made)

    def add_impact(self, seen: Seen) -> tuple[str, FirstImpact]:
        """Prove a first impact (rule first-impact)."""
        phases, times = texts(seen.flights.phases), texts(seen.times)
        return self.derive("first-impact", {"phases": phases, "times": times})

    def flights(self, phases: Range) -> FlightBox:
        """Return all launches of some phases."""
        return FlightBox.plastic(self.at, phases)

    def impacts(self, phases: Range) -> list[tuple[str, FirstImpact]]:
        """Prove transversal first impacts on parts of an interval, in order."""
        return self.seen_or_proved(partial(self._impacts, phases))

    def _impacts(self, phases: Range, floats: bool) -> list[tuple[str, FirstImpact]]:
        parts = cover_by(self.flights(phases), horizon=self.horizon, floats=floats)
        return [self.add_impact(part) for part in parts]

    def impact(self, phases: Range) -> tuple[str, FirstImpact]:
        """Prove the transversal first impact of (nearly) one launch."""
        return self.seen_or_proved(partial(self._impact, phases))

    def _impact(self, phases: Range, floats: bool) -> tuple[str, FirstImpact]:
        return self.add_impact(locate(self.flights(phases), horizon=self.horizon, floats=floats))

    def slopes(self, points: list[Fraction]) -> tuple[str, SlopeRange]:
        """Prove f C^1 on [points[0], points[-1]] and enclose f' there (rule slope-range)."""
        return self.seen_or_proved(partial(self._slopes, points))

    def _slopes(self, points: list[Fraction], floats: bool) -> tuple[str, SlopeRange]:
        parts = self._impacts((points[0], points[-1]), floats)
        branch = Branch(parts, self.bits, floats)
        cuts = sorted({*points, *branch.ends})
        extreme = extremes(lambda x: branch.slope(x, x), branch.curvature, cuts)
        return self.derive("slope-range", branch.witness(extreme.points))

    def avoids(self, phases: Range, target: Range) -> tuple[str, Avoids]:
        """Prove that no phase of `phases` has its first impact in `target` (rule avoids)."""
        return self.seen_or_proved(partial(self._avoids, phases, target))

    def _avoids(self, phases: Range, target: Range, floats: bool) -> tuple[str, Avoids]:
        def accept(seen: Seen) -> bool:
            return not any(
                comes_to(self.at, seen.flights.phases, window, target) for window in seen.windows
            )

        parts = cover_by(
            self.flights(phases),
            accept,
            obstacle=f"an impact in {show_range(target)} is possible",
            horizon=self.horizon,
            limit=400,
            floats=floats,
        )
        flights = [self.add_impact(part)[0] for part in parts]
        return self.derive("avoids", {"flights": flights, "target": texts(target)})

    def point(self, phase: Fraction) -> tuple[str, Impact]:
        """Enclose f and f' at one phase (rule point)."""
        return self.seen_or_proved(partial(self._point, phase))

    def _point(self, phase: Fraction, floats: bool) -> tuple[str, Impact]:
        branch = Branch([self._impact((phase, phase), floats)], self.bits, floats)
        return self.derive("point", branch.bracket(phase, phase, phase=str(phase)))

    def root(self, ratios: Range) -> tuple[str, MoranRoot]:
        """Bracket the root of r0^s + r1^s = 1 (rule moran-root)."""
        root = texts(moran_root(ratios, self.bits))
        return self.derive("moran-root", {"ratios": texts(ratios), "root": root})

    def stays(
        self,
        region: Sequence[Range],
        cells: Sequence[tuple[tuple[str, SlopeRange], Range]],
        gaps: Sequence[tuple[str, Avoids]] = (),
    ) -> tuple[str, StayingSet]:
        """Prove what stays in a region (rule staying-set).

        cells: each a slope-range step and two of its points.
        """
        witness = {
            "region": [texts(part) for part in region],
            "cells": [{"slopes": name, "domain": texts(ends)} for (name, _), ends in cells],
            "gaps": [name for name, _ in gaps],
        }
        return self.derive("staying-set", witness)

    def horseshoe(
        self,
        slopes: Sequence[tuple[str, SlopeRange]],
        gap: tuple[str, Avoids],
        sets: Parameters,
    ) -> tuple[str, StayingSet]:
        """Prove a horseshoe on I0 and I1 of `sets`."""
        cells = list(zip(slopes, (sets.left, sets.right), strict=True))
        name, shift = self.stays([sets.interval], cells, [gap])
        if not shift.is_horseshoe:
            raise Unproved("I is not covered")
        return name, shift
