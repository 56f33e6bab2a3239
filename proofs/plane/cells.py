"""The work on cells, as it is sent out in chunks: what is proved in each, as rows of the store.

About boxes of two parameters of a map, it is the methods for any map that prove.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from time import thread_time

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.newton import Cycle, cycles, prove_orbits, seeds
from proofs.methods.sampling import Floats, Sampled
from proofs.methods.shifts import Candidates, find_horseshoe
from proofs.plane import horseshoe, settling, singles
from proofs.plane.horseshoe import Sets
from proofs.plane.store import SPLIT, Row
from proofs.trusted.atlas import Region, proved
from proofs.trusted.certificate import parse
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.parameters import Place
from proofs.trusted.questions import Question
from proofs.trusted.subjects import Box, Oscillators, Systems
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected

_SEEDS, _MOST = 60, 6  # points; orbits of a cell that are tried
_SHARE = 1 / 8  # of the usual work on a horseshoe
_POWERS = (1, 2)


def about_maps(
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
            if asked.proved_by(file.known[step]):
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


_HINTS = 3  # sets of neighbours that are tried


def decide(region: Region, depth: int, todo: Sequence[tuple[str, str]]) -> list[Row]:
    """Return the rows of cells, given by key and sets that may help; undecided ones are split.

    The last depth is never split. Cells in order are neighbours: each tries the sets of the last.
    """
    hints: list[str] = []
    rows = []
    for key, sets in todo:
        began = thread_time()  # Dask has other threads at work
        near = list(dict.fromkeys(each for each in (sets, *hints) if each))[:_HINTS]
        row = _decided(region, depth, key, near)
        rows.append(row._replace(seconds=thread_time() - began, sets=row.sets or sets))
        if row.sets:
            hints = [row.sets, *(each for each in hints if each != row.sets)][:_HINTS]
    return rows


def _decided(region: Region, depth: int, key: str, hints: Sequence[str]) -> Row:
    why = "no proof is found"
    try:
        for text, sets in _proposals(region, region.sides(key), hints):
            try:
                with metered(DEFAULT) as meter:
                    said = proved(region, key, parse(text))
                packed = zlib.compress(text.encode())
                return Row(key, *said, packed, meter.spent, sets=sets)
            except (Rejected, Exhausted) as failure:
                why = str(failure).rpartition(": ")[2]
    except (Undecided, ArithmeticError) as failure:
        why = str(failure)
    if len(key.partition("/")[2]) < depth:
        return Row(key, SPLIT)
    return Row(key, Verdict.UNDECIDED.value, conclusion=why)


def _proposals(region: Region, sides: Box, hints: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield certificates that seem to answer a question, and what may help neighbours."""
    asked, subject = region.asked, region.subject
    if isinstance(subject, Oscillators):
        yield from _about_oscillators(subject.at(sides), asked, hints)
    elif isinstance(subject, Systems):
        yield from about_maps(subject, sides, asked, hints)


def _about_oscillators(
    box: Place, asked: Question, hints: Sequence[str]
) -> Iterator[tuple[str, str]]:
    if asked.kind == "entropy":
        before = [Sets.of(hint) for hint in hints]
        for made, sets in horseshoe.propose(box, before, asked.size):
            yield made.certificate(), sets.text if sets else ""
    else:
        steps = [singles.propose(box, asked.size)] if asked.kind == "orbits" else None
        for made in steps or settling.propose(box):
            yield made.certificate(), ""
