"""An atlas as a page of its own: what is proved in each cell, for all cells, in one small file.

Cells are the leaves of a quadtree, written in its order. Sentences that differ in numbers alone are
one pattern, and what two cells say alike of themselves is there once.
"""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from markupsafe import Markup

from proofs.plane import picture, summary
from proofs.plane.picture import Shown
from proofs.plane.store import LEAVES, SAMPLE, Row, Store, quarters
from proofs.report.atlases import about, areas
from proofs.report.html import rendered
from proofs.report.layout import percent
from proofs.report.typeset import begun
from proofs.trusted.atlas import NOT_YET, Region
from proofs.trusted.numbers import show_range
from proofs.trusted.subjects import Oscillators
from proofs.trusted.verdicts import Verdict

MOST = 200_000  # cells of a page
SIDE = 1000  # of the map, in its own units
_ETA, _NU, _SPLIT, _NOTHING = -1, -2, -1, -2
_NUMBER = re.compile(r"(-?\d[\d./]*\d|-?\d)")


class Said(NamedTuple):
    """What a cell says: verdict, kind, and its sentence without the cell's box.

    parts: strings, between which are numbers; _ETA and _NU stand for the sides of the box.
    """

    verdict: str
    kind: str
    parts: tuple[str | int, ...]
    numbers: tuple[str, ...]


def said(cell: Row, eta: str, nu: str) -> Said:
    """Divide the sentence of a cell, of this box, into what others have as well, and numbers."""
    parts: list[str | int] = []
    numbers: list[str] = []
    before, sides, rest = cell.conclusion.partition(f"eta in {eta}, nu in {nu}")
    if sides:
        parts += [f"{before}eta in ", _ETA, ", nu in ", _NU]
    for k, text in enumerate(_NUMBER.split(rest if sides else before)):
        if k % 2:
            parts.append(len(numbers))
            numbers.append(text)
        elif text:
            parts.append(text)
    return Said(cell.verdict, cell.kind, tuple(parts), tuple(numbers))


def data(region: Region, cells: Iterable[Row]) -> dict[str, Any]:
    """Return what the page holds of cells.

    patterns: verdict, kind, and parts of a sentence: strings, places of numbers, -1 and -2 for the
    box. said: a pattern and its numbers. roots: of each where it is in the map, how deep it is cut,
    the ends of sides in its finest grid, and its tree, parents first: -1 is cut in four, -2 is not
    looked at, others are places in `said`.
    """
    leaves = {}
    for cell in cells:
        across, up = map(show_range, region.sides(cell.key))
        leaves[cell.key] = said(cell, across, up), across, up
    patterns, codes = _coded(each for each, _, _ in leaves.values())
    index = {text: k for k, text in enumerate(dict.fromkeys(codes.values()))}
    inner = {key[:k] for key in leaves for k in range(key.index("/") + 1, len(key))}

    def tree(key: str) -> Iterator[int]:
        if key in leaves:
            yield index[codes[leaves[key][0]]]
        elif key in inner:
            yield _SPLIT
            for child in quarters(key):
                yield from tree(child)
        else:
            yield _NOTHING

    roots = []
    for number in range(len(region.roots)):
        own = {key: sides for key, (_, *sides) in leaves.items() if key.startswith(f"{number}/")}
        depth = _deepest(own)
        sides: list[dict[int, str]] = [{}, {}]
        for key, texts in own.items():
            for ends, at, text in zip(sides, corner(key, depth), texts, strict=True):
                low, high = text.strip("[]").split(", ")
                ends |= {at: low, at + size(key, depth): high}
        names = ("eta", "nu")
        place = {"depth": depth, "map": _on_map(region, number)}
        coordinates = dict(zip(names, sides, strict=True))
        roots.append(place | coordinates | {"tree": list(tree(f"{number}/"))})
    return {"patterns": patterns, "said": list(index), "roots": roots}


def _coded(all_said: Iterable[Said]) -> tuple[list[list[Any]], dict[Said, str]]:
    """Return patterns, numbers that are always the same being text; and the code of each."""
    groups: dict[tuple[Any, ...], dict[Said, None]] = defaultdict(dict)
    for each in all_said:
        groups[each[:3]][each] = None
    patterns, codes = [], {}
    for number, ((verdict, kind, parts), members) in enumerate(groups.items()):
        columns = list(zip(*(each.numbers for each in members), strict=True))
        moving = [k for k, column in enumerate(columns) if len(set(column)) > 1]
        joined: list[str | int] = []
        for part in parts:
            text = columns[part][0] if isinstance(part, int) and part >= 0 else part
            if isinstance(part, int) and part in moving:
                joined.append(moving.index(part))
            elif isinstance(text, str) and joined and isinstance(joined[-1], str):
                joined[-1] += text
            else:
                joined.append(text)
        patterns.append([verdict, kind, joined])
        for each in members:
            codes[each] = " ".join([str(number), *(each.numbers[k] for k in moving)])
    return patterns, codes


def _deepest(keys: Iterable[str]) -> int:
    return max((len(key.partition("/")[2]) for key in keys), default=0)


def corner(key: str, depth: int) -> tuple[int, int]:
    """Return the place of a cell in a grid of 2^depth cells a side: along eta, along nu."""
    path = key.partition("/")[2]
    bits = (
        sum((int(digit) >> bit & 1) << k for k, digit in enumerate(path[::-1])) for bit in (0, 1)
    )
    eta, nu = (place * size(key, depth) for place in bits)
    return eta, nu


def size(key: str, depth: int) -> int:
    """Return the side of a cell in that grid."""
    return 1 << depth - len(key.partition("/")[2])


def _on_map(region: Region, number: int) -> list[float]:
    """Return left, right, bottom and top of a root, in shares of the region's sides."""
    root = region.roots[number]
    sides = zip(root, region.sides_of, strict=True)
    return [float((end - low) / (high - low)) for ends, (low, high) in sides for end in ends]


# -- the page --------------------------------------------------------------------------------------


class Layer(NamedTuple):
    """What is proved alike: its colour, words, share of the area, cells; a path for each root."""

    kind: str
    colour: str
    words: str
    share: str
    cells: int
    paths: list[tuple[str, str]]


class Stroke(NamedTuple):
    """A curve in the map: what it is of, its points there, where its label is."""

    name: str
    n: int
    points: str
    place: tuple[str, str]


def page(store: Store, shown: Shown) -> str:
    """Return the page."""
    (made, regions, verdicts, over), region = shown, store.region
    shares = made["share_of_area"]
    leaves = data(region, store.cells(*LEAVES))
    numbers = {name: percent(share) for name, share in shares.items()} | areas(shares)
    layers = [
        Layer(kind, colour, summary.words(kind), numbers[kind], made["kinds"][kind], paths)
        for kind, colour in picture.coloured(verdicts).items()
        for paths in [[*_paths(region, regions[kind])]]
    ]
    return rendered(
        "atlas.html",
        region=region,
        sides={name: show_range(side) for name, side in _sides(region)},
        made=made,
        labels=picture.labels(region),
        command=" ".join(map(str.upper, region.names)),
        about=begun(about(made)),
        has_curves=isinstance(region.subject, Oscillators),
        numbers=numbers,
        verdicts=[x for x in Verdict if made["cells"].get(x.value)],
        not_yet=NOT_YET,
        layers=layers,
        undecided=picture.UNDECIDED,
        strokes=[_stroke(region, line) for line in over.lines],
        styles=picture.STROKES,
        meetings=[_in_map(region, place) for place in over.meetings],
        meet=picture.MEETINGS,
        periods=picture.PERIODS,
        sample=SAMPLE,
        side=SIDE,
        data=Markup(_json({**leaves, "names": picture.labels(region)})),
        ends=Markup(_json({name: [*map(float, side)] for name, side in _sides(region)})),
    )


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")


def _sides(region: Region) -> list[tuple[str, tuple[Any, Any]]]:
    return list(zip(("eta", "nu"), region.sides_of, strict=True))


def _paths(region: Region, keys: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield for each root what moves its grid into the map, and the squares of its cells."""
    for number in range(len(region.roots)):
        own = [key for key in keys if key.startswith(f"{number}/")]
        if own:
            depth = _deepest(own)
            left, right, bottom, top = (SIDE * each for each in _on_map(region, number))
            scale = (right - left) / 2**depth, (bottom - top) / 2**depth
            moved = (
                f"translate({left:.6g} {SIDE - bottom:.6g}) scale({scale[0]:.9g} {scale[1]:.9g})"
            )
            yield moved, "".join(_square(key, depth) for key in own)


def _square(key: str, depth: int) -> str:
    (left, low), side = corner(key, depth), size(key, depth)
    return f"M{left} {low}h{side}v{side}h-{side}z"


def _in_map(region: Region, place: tuple[float, float]) -> tuple[str, str]:
    x, y = (
        SIDE * (end - float(low)) / float(high - low)
        for end, (low, high) in zip(place, region.sides_of, strict=True)
    )
    return f"{x:.1f}", f"{SIDE - y:.1f}"


def _stroke(region: Region, line: picture.Line) -> Stroke:
    points = " ".join(",".join(_in_map(region, place)) for place in line.points)
    return Stroke(line.name, line.n, points, _in_map(region, picture.named(region, line)))
