"""What an atlas amounts to: areas, work, the digest of its lines."""

from __future__ import annotations

import json
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from fractions import Fraction
from hashlib import sha256
from typing import Any

from proofs.plane.store import LEAVES, Row, Store, quarters
from proofs.trusted.atlas import LEFT_OUT, NOT_YET, Region, area
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import Range, floor_text, show_range
from proofs.trusted.subjects import Box

_VERDICTS = [verdict.value for verdict in LEAVES]
_LINE = 300  # work of the checker on a line, beside the certificate
_WORDS = {
    "EntropyBound": "a full shift is a factor of f",
    "StickingMotion": "a superstable periodic motion that sticks",
    "ReturningMotion": "a stable periodic motion, sticking or not",
    "StableOrbit": "a stable periodic orbit that does not stick",
    "AllStick": "every motion sticks, and is periodic then",
    "AtRest": "every motion comes to rest",
    "StableSingles": "a stable single-impact orbit",
    "PeriodicOrbit": "a periodic orbit",
    "Entropy": "positive topological entropy",
}


def words(kind: str) -> str:
    """Return what a conclusion of a kind says, in a few words."""
    name, *periods = kind.split("-")
    if name == "StableSingles" and not periods:
        return "no stable single-impact orbit"
    phrase = _WORDS.get(name, re.sub(r"(?<!^)(?=[A-Z])", " ", name).lower())
    return f"{phrase}: n = {', '.join(periods)}" if periods else phrase


def kinds(names: Iterable[str]) -> list[str]:
    """Return kinds of conclusions in the order in which they are shown."""
    return sorted(names, key=lambda name: (name not in _WORDS, [*_WORDS, name].index(name), name))


def summary(store: Store) -> dict[str, Any]:
    """Return what is proved on which area, of all cells so far.

    checker_work: what the checker needs for all lines, and some to spare. digest: their SHA-256.
    """
    region, digest = store.region, sha256()
    for line in store.lines():
        digest.update(line.encode())
    cells, counts, areas = Counter[str](), Counter[str](), defaultdict[str, Fraction](Fraction)
    reasons = Counter[str]()
    for cell in store.cells(*LEAVES):
        size = area(region.sides(cell.key))
        cells[cell.verdict] += 1
        areas[cell.verdict] += size
        if cell.kind:
            counts[cell.kind] += 1
            areas[cell.kind] += size
        else:
            reasons[cell.conclusion] += 1
    plane = area(region.sides_of)
    areas[LEFT_OUT] = plane - sum(map(area, region.roots), Fraction(0))
    areas[NOT_YET] = plane - areas[LEFT_OUT] - sum(areas[name] for name in _VERDICTS)
    named = (*_VERDICTS, *kinds(counts), NOT_YET, LEFT_OUT)
    return {
        **json.loads(region.text),
        "holds": region.asked.holds,
        "opposite": region.asked.opposite,
        "parts": [dict(zip(region.names, map(texts, root), strict=True)) for root in region.roots],
        "cells": dict(cells),
        "share_of_area": {name: floor_text(areas[name] / plane) for name in named},
        "kinds": {kind: counts[kind] for kind in kinds(counts)},
        "undecided_because": dict(reasons.most_common(8)),
        "cpu_seconds": f"{store.total('seconds'):.1f}",
        "checker_work": f"{1.1 * (store.total('work') + _LINE * (cells.total() + 10)):.0f}",
        "digest": f"sha256:{digest.hexdigest()}",
    }


def lines(made: dict[str, Any], region: Region) -> Iterator[str]:
    """Yield what a summary says, for the screen."""
    question, shares = region.asked, made["share_of_area"]
    yield f"{region.question}: for all parameters of a cell, {question.holds}."
    yield f"Opposite: {question.opposite}."
    if len(region.parts) > 1 or region.parts[0] != region.sides_of:
        sides = ([show_range(side) for side in root] for root in region.roots)
        parts = "; ".join(f"eta {eta}, nu {nu}" for eta, nu in sides)
        yield f"The region is cut at eta = 1 and nu = 0, next to which a strip is left out: {parts}"
    for verdict in LEAVES:
        count = made["cells"].get(verdict.value, 0)
        yield f"{verdict.value:10} {count:8} cells, {shares[verdict.value]} of the area"
    for kind, count in made["kinds"].items():
        yield f"  {count} cells, {shares[kind]} of the area: {words(kind)}"
    for why, count in made["undecided_because"].items():
        yield f"  {count} cells undecided: {why}"
    if shares[NOT_YET] != "0":
        yield f"not looked at yet: {shares[NOT_YET]} of the area"
    yield f"{made['cpu_seconds']} CPU seconds on cells; {made['digest']}"


def merged(keys: Iterable[str]) -> list[str]:
    """Return fewer cells that are the same part of the plane: four quarters are one cell."""
    left = set(keys)
    for length in range(max(map(len, left), default=0), 2, -1):
        for parent in {key[:-1] for key in left if len(key) == length and key[-1] != "/"}:
            if left.issuperset(quarters(parent)):
                left = left.difference(quarters(parent)) | {parent}
    return sorted(left)


def joined(boxes: Iterable[Box]) -> list[Box]:
    """Return fewer boxes that are the same part of the plane: those side by side are one."""
    parts = list(boxes)
    for axis in (0, 1):
        rows = defaultdict[Range, list[Range]](list)
        for box in sorted(parts):
            sides = rows[box[1 - axis]]
            before = sides.pop() if sides and sides[-1][1] == box[axis][0] else box[axis]
            sides.append((before[0], box[axis][1]))
        runs = [(side, other) for other, sides in rows.items() for side in sides]
        parts = [(side, other) if axis == 0 else (other, side) for side, other in runs]
    return parts


def at(store: Store, first: Fraction, second: Fraction) -> Row | None:
    """Return the cell that holds a point; None where there is none yet."""
    for cell in store.cells(*LEAVES):
        (left, right), (low, high) = store.region.sides(cell.key)
        if left <= first <= right and low <= second <= high:
            return cell
    return None
