"""What an atlas amounts to: areas, work, a digest; and its picture."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from fractions import Fraction
from hashlib import sha256
from typing import TYPE_CHECKING, Any

from proofs.plane.store import Store, quarters
from proofs.trusted.atlas import QUESTIONS, Cell, Region, area
from proofs.trusted.certificate import box_to_json
from proofs.trusted.numbers import floor_text, show_range
from proofs.trusted.verdicts import Verdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

LEAVES = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED
_WORDS = {
    "CoveringShift": "a full shift on two symbols is a factor of f",
    "StickingMotion": "a superstable periodic motion that sticks",
    "ReturningMotion": "a stable periodic motion, sticking or not",
    "StableOrbit": "a stable periodic orbit that does not stick",
    "AllStick": "every motion sticks, and is periodic then",
    "AtRest": "every motion comes to rest",
}


def summary(store: Store) -> dict[str, Any]:
    """Return what is proved on which area, of all cells so far.

    digest: SHA-256 of the lines "key verdict digest-of-the-certificate", in the order of the keys.
    """
    region, digest = store.region, sha256()
    cells, kinds, areas = Counter[str](), Counter[str](), defaultdict[str, Fraction](Fraction)
    reasons = Counter[str]()
    for cell in store.cells(*LEAVES):
        size = area(region.box(cell.key))
        cells[cell.verdict] += 1
        areas[cell.verdict] += size
        if cell.kind:
            kinds[cell.kind] += 1
        else:
            reasons[cell.conclusion] += 1
        digest.update(f"{cell.key} {cell.verdict} {cell.sha256 or '-'}\n".encode())
    whole = sum(map(area, region.roots), Fraction(0))
    shares = {x.value: floor_text(areas[x.value] / whole) for x in LEAVES}
    return {
        **json.loads(region.text),
        "holds": QUESTIONS[region.question].holds,
        "opposite": QUESTIONS[region.question].opposite,
        "parts": [box_to_json(root) for root in region.roots],
        "cells": dict(cells),
        "share_of_area": shares | {"not looked at": floor_text(1 - sum(areas.values()) / whole)},
        "kinds": dict(kinds),
        "undecided_because": dict(reasons.most_common(8)),
        "cpu_seconds": f"{store.seconds():.1f}",
        "digest": f"sha256:{digest.hexdigest()}",
    }


def lines(made: dict[str, Any], region: Region) -> Iterator[str]:
    """Yield what a summary says, for the screen."""
    question = QUESTIONS[region.question]
    yield f"{region.question}: for all oscillators of a cell, {question.holds}."
    yield f"Opposite: {question.opposite}."
    if len(region.roots) > 1 or 0 in region.nu:
        parts = "; ".join(f"eta {show_range(x.eta)}, nu {show_range(x.nu)}" for x in region.roots)
        yield f"The region is cut at eta = 1 and nu = 0, next to which a strip is left out: {parts}"
    for verdict in LEAVES:
        count, share = made["cells"].get(verdict.value, 0), made["share_of_area"][verdict.value]
        yield f"{verdict.value:10} {count:8} cells, {share} of the area"
    for kind, count in made["kinds"].items():
        yield f"  {count} cells: {_WORDS[kind]}"
    for why, count in made["undecided_because"].items():
        yield f"  {count} cells undecided: {why}"
    if made["share_of_area"]["not looked at"] != "0":
        yield f"not looked at yet: {made['share_of_area']['not looked at']} of the area"
    yield f"{made['cpu_seconds']} CPU seconds on cells; {made['digest']}"


def picture(store: Store) -> Drawing:
    """Draw the cells, each in the colour of what is proved in it; what is blank is undecided."""
    from proofs.report.figures import style

    region, found = store.region, defaultdict[str, list[str]](list)
    for cell in store.cells(Verdict.VERIFIED, Verdict.REFUTED):
        found[cell.kind].append(cell.key)
    colours = style.BLUE, style.GREEN, style.SKY, style.ORANGE, style.PURPLE, style.GREY
    drawing, axes = style.sheet(4.6)
    for kind, colour in zip(_WORDS, colours, strict=True):
        boxes = [region.box(key) for key in merged(found[kind])]
        if boxes:
            sides = [(box.eta, box.nu) for box in boxes]
            style.proved_boxes(axes, sides, colour, _WORDS[kind], lw=0)
    axes.set(xlabel="eta", ylabel="nu", xlim=_ends(region.eta), ylim=_ends(region.nu))
    if any(found.values()):
        axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2)
    return drawing


def _ends(side: tuple[Fraction, Fraction]) -> tuple[float, float]:
    return float(side[0]), float(side[1])


def merged(keys: Iterable[str]) -> list[str]:
    """Return fewer cells that are the same part of the plane: four quarters are one cell."""
    left = set(keys)
    for length in range(max(map(len, left), default=0), 2, -1):
        for parent in {key[:-1] for key in left if len(key) == length and key[-1] != "/"}:
            if left.issuperset(quarters(parent)):
                left = left.difference(quarters(parent)) | {parent}
    return sorted(left)


def at(store: Store, eta: Fraction, nu: Fraction) -> Cell | None:
    """Return the cell that holds a point; None where there is none yet."""
    for cell in store.cells(*LEAVES):
        box = store.region.box(cell.key)
        if box.eta[0] <= eta <= box.eta[1] and box.nu[0] <= nu <= box.nu[1]:
            return cell
    return None
