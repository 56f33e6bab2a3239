"""The work on cells, as it is sent out in chunks: what is proved in each, as rows of the store."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from time import thread_time

from intervals import Undecided
from proofs.plane import horseshoe, settling, singles
from proofs.plane.horseshoe import Sets
from proofs.plane.steps import Steps
from proofs.plane.store import SPLIT, Row
from proofs.trusted.atlas import Region, proved
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.parameters import Place
from proofs.trusted.questions import Question
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check

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
        for made, sets in _proposals(region.asked, region.box(key), hints):
            try:
                text = made.certificate()
                with metered(DEFAULT) as meter:
                    said = proved(region, key, check(text))
                packed = zlib.compress(text.encode())
                return Row(key, *said, packed, meter.spent, sets=sets.text if sets else "")
            except (Rejected, Exhausted) as failure:
                why = str(failure).rpartition(": ")[2]
    except (Undecided, ArithmeticError) as failure:
        why = str(failure)
    if len(key.partition("/")[2]) < depth:
        return Row(key, SPLIT)
    return Row(key, Verdict.UNDECIDED.value, conclusion=why)


def _proposals(
    asked: Question, box: Place, hints: Sequence[str]
) -> Iterator[tuple[Steps, Sets | None]]:
    """Yield certificates that seem to answer a question."""
    if asked.kind == "entropy":
        yield from horseshoe.propose(box, [Sets.of(hint) for hint in hints], asked.size)
    elif asked.kind == "orbits":
        yield singles.propose(box, asked.size), None
    else:
        yield from ((made, None) for made in settling.propose(box))
