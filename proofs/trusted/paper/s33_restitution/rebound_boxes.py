"""Claim N4: the horseshoe with restitution for every oscillator of a box of parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from proofs.trusted.numbers import Range, ceil_text, floor_text, hull, show, within
from proofs.trusted.paper import Decision, undecided
from proofs.trusted.paper.s33_restitution.rebound_facts import FULL, corner_of, horseshoes
from proofs.trusted.paper.s33_restitution.rebound_texts import (
    edge_text,
    full_text,
    merged,
    word_text,
)
from proofs.trusted.paper.s33_restitution.rebounds import BarredWord, Box, Horseshoe, Rebound
from proofs.trusted.parameters import Parameters, parameters_text
from proofs.trusted.verdicts import Verdict

_MOST_PARTS = 32  # that a box is covered with


def on_box(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide N4: horseshoes on parts that cover the box, or a point of it at which there is none.

    At a word without orbit, at any parameters of the box, the theorem fails, whatever holds for
    the others. Nothing less than a proof for the whole box verifies it.
    """
    if of.box is None or of.velocities is None:
        return undecided("no box of parameters or no velocities are given")
    proved = _proved(of, of.box, found)
    whole = [parts for parts in proved.values() if covered(of.box, _boxes(parts))]
    own = proved.get((of.left, of.right))
    if own is not None and own in whole:
        why = "for all of them, edges overshoot both rectangles by at least "
        why += floor_text(min(part.margin for part in own))
        return Decision(Verdict.VERIFIED, why, corrected=_theorem(own))
    corrected = next(map(_theorem, whole or proved.values()), None)
    edges, missing = list(_failing(of, of.box, found)), list(_missing(of, of.box, found))
    if missing:
        reasons = [*missing[:1], *edges]
        return Decision(Verdict.REFUTED, reasons[0], "; ".join(reasons), corrected)
    reasons = edges or list(_short(of, of.box, found))
    why = "; ".join(reasons) or "no proof about F on V1 and V2 for all of them"
    return Decision(Verdict.UNDECIDED, why, corrected=corrected)


def _proved(
    of: Parameters, box: Box, found: Sequence[object]
) -> dict[tuple[Range, Range], list[Horseshoe]]:
    """Return by phases of rectangles what is proved for parts of the box."""
    proved: dict[tuple[Range, Range], list[Horseshoe]] = {}
    for one in horseshoes(of, found, FULL):
        left, right = one.rectangles
        if _overlap(left.box, box):
            proved.setdefault((left.phases, right.phases), []).append(one)
    return proved


def _boxes(parts: Sequence[Horseshoe]) -> list[Box]:
    return [part.rectangles[0].box for part in parts]


def _theorem(parts: Sequence[Horseshoe]) -> str:
    return full_text(parts, merged(_boxes(parts)))


def _overlap(one: Box, box: Box) -> bool:
    """Whether two boxes meet, not only in a face of the second."""
    return all(
        (a[0] < b[1] and b[0] < a[1]) or (b[0] == b[1] and within(b, a))
        for a, b in zip(one, box, strict=True)
    )


def contains(box: Box, inner: Box) -> bool:
    """Whether a box contains another."""
    return all(within(a, b) for a, b in zip(inner, box, strict=True))


def covered(box: Box, parts: Sequence[Box]) -> bool:
    """Whether parts cover a box.

    If none contains it: it is cut where a part ends inside it, and both pieces must be covered.
    """
    near = [part for part in parts if _overlap(part, box)]
    if len(near) > _MOST_PARTS:
        return False
    if any(contains(part, box) for part in near):
        return True
    for side, (low, high) in enumerate(box):
        for end in (end for part in near for end in part[side]):
            if low < end < high:
                pieces = (with_side(box, side, ends) for ends in ((low, end), (end, high)))
                return all(covered(piece, near) for piece in pieces)
    return False


def with_side(box: Box, side: int, values: Range) -> Box:
    """Return the box with one side replaced."""
    eta, nu, epsilon = (values if index == side else old for index, old in enumerate(box))
    return eta, nu, epsilon


def _missing(of: Parameters, box: Box, found: Sequence[object]) -> Iterator[str]:
    """Write which words no orbit follows, at parameters of the box; the shortest first."""
    words = [
        one
        for one in found
        if isinstance(one, BarredWord)
        and (one.sets, one.velocities) == ((of.left, of.right), of.velocities)
        and contains(box, one.box)
    ]
    for one in sorted(words, key=lambda one: (len(set(one.word)), len(one.word), one.word)):
        yield (
            f"at {parameters_text(one.box)} no orbit of F follows {word_text(one.word)} in the "
            f"closed rectangles: the last impact misses V{one.word[-1] + 1} by at least "
            f"{floor_text(one.short)}"
        )


def _failing(of: Parameters, box: Box, found: Sequence[object]) -> Iterator[str]:
    """Write which edges are not mapped beyond both rectangles, at points of the box."""
    for one in found:
        if isinstance(one, Rebound) and contains(box, one.box):
            exact = all(low == high for low, high in one.box)
            if exact and of.left[0] < one.phase[0] and one.phase[1] < of.right[1]:
                for number, side in corner_of(one, (of.left, of.right), of.velocities):
                    text = edge_text(of, number, side, one)
                    yield f"at {parameters_text(one.box)} {text}"


def _short(of: Parameters, box: Box, found: Sequence[object]) -> Iterator[str]:
    """Write which edges are not proved to be mapped beyond both rectangles, over the box."""
    target = hull((of.left, of.right))
    for one in found:
        if not (isinstance(one, Rebound) and one.box == box and one.velocities == of.velocities):
            continue
        for number, ends in enumerate((of.left, of.right)):
            for side, end in zip(("left", "right"), ends, strict=True):
                past = (target[0] - one.phase[1], one.phase[0] - target[1])[side == "right"]
                if one.phases == (end, end) and past <= 0:
                    yield (
                        f"the {side} edge of V{number + 1} is not proved to be mapped beyond "
                        f"{show(target[side == 'right'])} for all of them: it reaches phases "
                        f"[{floor_text(one.phase[0])}, {ceil_text(one.phase[1])}] (modulo "
                        f"2 pi), up to {ceil_text(-past)} short"
                    )
