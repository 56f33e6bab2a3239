"""The work on cells, as it is sent out in chunks: what is proved in each, as rows of the store."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from time import thread_time

from intervals import Undecided
from proofs.plane import horseshoe, settling, singles, systems
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
        yield from systems.propose(subject, sides, asked, hints)


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
