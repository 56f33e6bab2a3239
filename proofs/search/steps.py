"""Proof steps of the plastic map: each proves something and records its witness.

What f is on intervals is asked of the checker's own map, and when impacts come of its lemmas on
flights. So neither mpmath nor numpy is needed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

from intervals import Undecided
from intervals.cover import PartsExhausted, cover, halves
from proofs.methods.derivation import Derivation, concluded
from proofs.methods.moran import moran_root
from proofs.motion.system import System
from proofs.motion.witness import NoImpact
from proofs.search.evidence import Proved, Steps
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.differential import BITS, Avoids, Differential, misses
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import TURN, Range, hull, show_range, within
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.windows import BITS as WINDOW_BITS

_MOST_PARTS = 400
_THINNEST, _NO_IMPACT = 2**16, 2**4  # parts of an interval, the other where no impact is seen


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
        """Binary places: enough for the digits after a loss of some 2^30."""
        return max(BITS, self.digits * 10 // 3 + 36)

    @cached_property
    def impact_map(self) -> PlasticMap:
        """The checker's map f, with impacts up to the horizon."""
        return PlasticMap(self.at, self.horizon)

    @property
    def function(self) -> dict[str, list[str]]:
        """It, as witnesses name it."""
        return {"eta": texts(self.at.eta), "nu": texts(self.at.nu)}

    def derive(self, rule: str, witness: dict[str, Any], kind: str = "") -> tuple[str, Any]:
        """Add a step; return its name, with what it concludes."""
        name = self.add(rule, witness, kind)
        return name, self.known[name]

    def claimed(self, name: str) -> Proved:
        """Return the steps so far, that one claimed."""
        return self.at, self.steps, [name]

    def windows(self, phases: Range) -> dict[Range, Range]:
        """Return the windows of transversal first impacts, on parts of an interval in order."""

        def has_window(part: Range) -> bool:
            windows[part] = self.impact_map.window(enclosed((part,), WINDOW_BITS))
            return True

        windows = dict[Range, Range]()
        self.parts(phases, has_window, "grazing")
        return windows

    def parts(self, phases: Range, holds: Callable[[Range], bool], obstacle: str) -> list[Fraction]:
        """Cut an interval until something is proved of f on every part; return its ends, in order.

        Undecided names a phase near which nothing helps, `obstacle` being the likely reason; a part
        without impact up to the horizon is cut a few times before that is taken for an answer.
        """
        width = phases[1] - phases[0]

        def decide(part: Range) -> bool | None:
            thinnest = _THINNEST
            failure = Undecided(f"{obstacle} near phase {float(part[0]):.9g}")
            try:
                if holds(part):
                    return True
            except NoFirstZero as error:
                thinnest, failure = _NO_IMPACT, NoImpact(str(error))
            except Unproved as error:
                failure = Undecided(str(error))
            if (part[1] - part[0]) * thinnest <= width:
                raise failure
            return None

        decided = cover([phases], decide, halves, limit=_MOST_PARTS)
        try:
            return [phases[0], *(part[1] for part, _ in decided)]
        except PartsExhausted:
            raise Undecided(f"{_MOST_PARTS} parts of {show_range(phases)} do not suffice") from None

    def slopes(self, points: list[Fraction]) -> tuple[str, SlopeRange]:
        """Prove f C^1 on [points[0], points[-1]] and enclose f' there (rule slopes).

        Between the points others are put only where their slopes do not bound f'.
        """
        witness = {"function": self.function, "points": texts(points), "bits": str(self.bits)}
        with suppress(Unproved):
            proved: SlopeRange = concluded("slopes", witness, self.context)
            if all(map(within, proved.pieces, map(hull, pairwise(proved.slopes)))):
                return self.record("slopes", witness, proved), proved
        return self.derive("slopes", witness | {"points": texts(list(self._cuts(points)))})

    def _cuts(self, points: list[Fraction]) -> Sequence[Fraction]:
        """Return points between which f' is bounded by its values there, or nearly so."""
        from proofs.methods.extremes import extremes

        def slope(x: Fraction) -> Range:
            return self.impact_map.jacobian(enclosed(((x, x),), BITS))[0][0].range

        def bend(low: Fraction, high: Fraction) -> Range:
            return self.impact_map.bend(enclosed(((low, high),), BITS)).range

        return extremes(slope, bend, points).points

    def avoids(self, phases: Range, target: Range) -> tuple[str, Avoids]:
        """Prove that no phase of `phases` has its first impact in `target` (rule avoids)."""
        points = self.parts(
            phases,
            lambda part: misses(self.impact_map, part, target),
            f"an impact in {show_range(target)} is possible",
        )
        witness = {"function": self.function, "points": texts(points), "target": texts(target)}
        return self.derive("avoids", witness)

    def point(self, phase: Fraction) -> tuple[str, Differential]:
        """Enclose f and f' at one phase (rule differential)."""
        (image,) = self.impact_map.values(enclosed(((phase, phase),), BITS))
        witness = {
            "function": self.function,
            "box": [texts((phase, phase))],
            "turns": [str(image.range[0] // TURN)],
            "bits": str(self.bits),
        }
        return self.derive("differential", witness, "point")

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

        cells: each a step of the rule slopes and two of its points.
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
