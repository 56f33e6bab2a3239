"""Proofs about a map for boxes of two of its parameters: the methods for any map, by cells."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import suppress

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.newton import Cycle, cycles, prove_orbits, seeds
from proofs.methods.sampling import Floats, Sampled
from proofs.methods.shifts import Candidates, find_horseshoe
from proofs.trusted.questions import Question
from proofs.trusted.subjects import Box, Systems

_SEEDS, _MOST = 60, 6  # points; orbits of a cell that are tried
_SHARE = 1 / 8  # of the usual work on a horseshoe
_POWERS = (1, 2)


def propose(
    subject: Systems, box: Box, asked: Question, hints: Sequence[str]
) -> Iterator[tuple[str, str]]:
    """Yield certificates that answer a question all over a box, and points that may help others.

    hints: such points, of neighbours. Raises Undecided where there is none.
    """
    file = Derivation(subject.at(box))
    near = [np.array(point, float) for hint in hints for point in json.loads(hint)]
    find = _horseshoe if asked.kind == "horseshoe" else _orbit
    step, points = find(file, subject, asked, near)
    yield file.certificate(step), json.dumps([[*map(float, point)] for point in points])


def _orbit(
    file: Derivation, subject: Systems, asked: Question, near: Sequence[Floats]
) -> tuple[str, list[Floats]]:
    sampled = Sampled(file.map(subject.function))
    for cycle in _seen(sampled, subject, asked, near)[:_MOST]:
        with suppress(Undecided):
            (step,) = prove_orbits(file, subject.function, [cycle])
            if asked.proved_by(file.conclusion(step)):
                return step, [cycle.points[0]]
    raise Undecided("no orbit is found that is proved all over the box")


def _seen(
    sampled: Sampled, subject: Systems, asked: Question, near: Sequence[Floats]
) -> list[Cycle]:
    """Return orbits of a period in floating point, those next to some points if there are any."""
    starts = [np.array(near).T] if near else []
    for x in (*starts, seeds(sampled, subject.region, _SEEDS * asked.size)):
        if orbits := [
            each
            for each in cycles(sampled, asked.size, x)
            if asked.kind == "orbits" or each.multipliers[-1] < 1
        ]:
            return orbits
    return []


def _horseshoe(
    file: Derivation, subject: Systems, asked: Question, near: Sequence[Floats]
) -> tuple[str, list[Floats]]:
    sampled, reason = Sampled(file.map(subject.function)), Undecided("nothing was looked at")
    saddles: list[Floats] = []
    for power in _POWERS:
        starts = np.array(near).T if near else seeds(sampled, subject.region, _SEEDS * power)
        for cycle in cycles(sampled, power, starts):
            saddles += [*cycle.points] if cycle.is_saddle else []
        try:
            candidates = Candidates(saddles, subject.region, power, _SHARE)
            return find_horseshoe(file, subject.function, candidates)[0], saddles
        except Undecided as error:
            reason = error
    raise reason
