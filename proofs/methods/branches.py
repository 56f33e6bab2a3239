"""Branches of fixed points of any map over a parameter, and curves of folds and flips over two.

A fixed point is a zero of F(x) - x, with parameters among the variables: a formula, or, of a
flight, other values at the impact. Where it also has the multiplier 1, or -1, det(F' - 1) = 0,
or det(F' + 1) = 0: a further value. Such zeros are followed by the rules
`arc` and `flight-arc`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from intervals import IntervalError, Undecided
from proofs.methods.arcs import follow
from proofs.methods.derivation import Derivation
from proofs.methods.lemmas import newton
from proofs.methods.newton import Cycle, cycles, distance, seeds
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.flightarcs import require_first, timed
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.zeros import Piece
from proofs.trusted.numbers import Range

_LONGEST, PIECES = 8, 200  # steps of a branch, at the least; pieces of all of them, at the most
_ROUNDS = 3  # of Newton's method, next to where two orbits meet
_BEFORE = [Fraction(1, k) for k in (8, 4, 32, 128)]  # parts of the time of an impact
_GRID, _SEEDS, _TRIES, _NEAR = 24, 60, 6, 1e-6
_NAME = "G"


class Moving(NamedTuple):
    """A parameter of a map, and its range."""

    name: str
    range: Range


def residual(
    function: Mapping[str, Any],
    moving: Sequence[str],
    turns: Sequence[int] = (),
    multiplier: int | None = None,
) -> dict[str, Any]:
    """Return the function whose zeros are the fixed points, parameters being variables, too.

    turns: by how many periods the angles increase; multiplier: of fixed points with this one, 1 or
    -1, for maps of one or two variables. Raises Undecided for more.
    """
    state, periods = function["variables"], function.get("periods", {})
    angles = dict(zip(periods, turns, strict=True))
    values = [
        f"({value}) - {name}" + _less(angles.get(name, 0), periods.get(name, ""))
        for name, value in zip(state, function["values"], strict=True)
    ]
    if multiplier is not None:
        values.append(_determinant(function, multiplier))
    return over(function, [*state, *moving], values)


def over(
    function: Mapping[str, Any], variables: Sequence[str], values: Sequence[str]
) -> dict[str, Any]:
    """Return a function of other variables, which may be its parameters, with other values."""
    kept = {key: value for key, value in function.items() if key not in ("parameters", "periods")}
    others = {k: v for k, v in function.get("parameters", {}).items() if k not in variables}
    made = {**kept, **({"parameters": others} if others else {})}
    renamed = {"e": "ee"} if "e" in variables else {}  # no variable is named e
    read = _read({**made, "variables": [*variables], "values": [*values]}, renamed)
    return dict(read)


def _less(turns: int, period: str) -> str:
    """Return what takes so many periods off."""
    factor = "" if abs(turns) == 1 else f"{abs(turns)}*"
    return f" {'-' if turns > 0 else '+'} {factor}({period})" if turns else ""


def _require_one(function: Mapping[str, Any]) -> dict[str, Any]:
    if "maps" in function or "field" in function:
        raise Undecided("branches are followed of formulas, and of one wall with a closed form")
    return dict(function)


def _determinant(function: Mapping[str, Any], multiplier: int) -> str:
    """Return det(F' - multiplier) as a formula."""
    state, values = function["variables"], function["values"]

    def slope(value: str, name: str) -> str:
        if "gaps" not in function:
            return f"D({value}, {name})"
        gap, time = function["gaps"][0], function["time"]
        return f"(D({value}, {name}) - D({value}, {time})*D({gap}, {name})/D({gap}, {time}))"

    rows = [
        [f"({slope(value, name)} - {multiplier * (i == j)})" for j, name in enumerate(state)]
        for i, value in enumerate(values)
    ]
    if len(rows) == 1:
        return rows[0][0]
    if len(rows) > 2:
        raise Undecided("folds and flips are followed for maps of one or two variables")
    (a, b), (c, d) = rows
    return f"{a}*{d} - {b}*{c}"


def _read(function: Any, renamed: Mapping[str, str]) -> Any:
    """Return a function with its formulas as a certificate has them, some variables renamed."""
    match function:
        case dict():
            return {key: _read(value, renamed) for key, value in function.items()}
        case list():
            return [_read(each, renamed) for each in function]
    plain = re.sub(r"\b[a-z]\w*\b", lambda name: renamed.get(name[0], name[0]), function)
    return plain if re.fullmatch(r"[a-z]\w*|-?[\d/]+", plain) else str(formula(plain))


def branches(
    file: Derivation, function: str, moving: Moving, region: Sequence[Range], *, share: float = 1
) -> Derivation:
    """Return a file whose steps are the branches of fixed points that are found at the low end.

    share: of the usual work.
    """
    low = moving.range[0]
    sampled = _at(file, function, {moving.name: low})
    starts = [
        ([*map(Fraction, cycle.points[0].tolist()), low], turns)
        for cycle, turns in _fixed(sampled, region)
    ]
    return _followed(sampled, file.functions[function], [moving], starts, share=share)


def curves(
    file: Derivation,
    function: str,
    moving: tuple[Moving, Moving],
    multiplier: int,
    region: Sequence[Range],
    *,
    share: float = 1,
) -> Derivation:
    """Return a file whose steps are curves along which fixed points have the multiplier 1, or -1.

    They are followed along the second parameter, from points that are found at its low end.
    share: of the usual work.
    """
    (name, (low, high)), (other, (begin, _)) = moving
    near = []
    for k in range(_GRID + 1):
        value = low + (high - low) * k / _GRID
        there = _at(file, function, {name: value, other: begin})
        for cycle, turns in _fixed(there, region):
            size = abs(np.linalg.det(cycle.derivative - multiplier * np.eye(len(region))))
            near.append((size, [*map(Fraction, cycle.points[0].tolist()), value, begin], turns))
    starts = [(point, turns) for _, point, turns in sorted(near, key=lambda each: each[0])[:_TRIES]]
    return _followed(
        there, file.functions[function], moving, starts, share=share, multiplier=multiplier
    )


def _at(file: Derivation, function: str, values: Mapping[str, Fraction]) -> Sampled:
    made = _require_one(file.functions[function])
    parameters = {**made["parameters"], **{k: [str(v)] * 2 for k, v in values.items()}}
    return Sampled(Derivation({function: {**made, "parameters": parameters}}).map(function))


def _fixed(sampled: Sampled, region: Sequence[Range]) -> Iterator[tuple[Cycle, list[int]]]:
    """Yield the fixed points that are found, and by how many periods their angles increase."""
    for cycle in cycles(sampled, 1, seeds(sampled, region, _SEEDS)):
        apart = (sampled(cycle.points.T)[:, 0] - cycle.points[0]) / sampled.periods
        yield cycle, [round(apart[circle.place]) for circle in sampled.map.circles]


def _followed(
    sampled: Sampled,
    function: Mapping[str, Any],
    moving: Sequence[Moving],
    starts: Sequence[tuple[Sequence[Fraction], Sequence[int]]],
    *,
    share: float,
    multiplier: int | None = None,
) -> Derivation:
    """Return a file with the arcs from some points, each once; sampled: for its angles."""
    names = [each.name for each in moving]
    kinds = {tuple(turns): f"{_NAME}{k}" for k, (_, turns) in enumerate(starts)}
    file = Derivation(
        {name: residual(function, names, turns, multiplier) for turns, name in kinds.items()}
    )
    seen: list[Floats] = []
    left, reason = int(PIECES * share), "no orbit is found"
    for point, turns in starts:
        name, reason = kinds[tuple(turns)], "nothing is found"
        map_ = file.map(name)
        try:
            start = _with_time(map_, point)
            for _ in range(_ROUNDS):
                start = newton(zeros(map_), start, axis=len(point) - 1)[0]
            here = np.array(start, float)
            if not left or any(_is_same(sampled, here, each) for each in seen):
                continue
            seen.append(here)
            left -= add_arc(file, name, start, moving[-1].range, left)
        except (IntervalError, Unproved) as error:
            reason = str(error)
    if not file.steps:
        raise Undecided(f"no curve is followed: {reason}")
    return file


def _with_time(map_: Map, point: Sequence[Fraction]) -> list[Fraction]:
    """Return a point, of a flight with the time of its impact."""
    if not isinstance(map_, Flight):
        return [*point]
    (time,) = Sampled(map_).times(map_, np.array([[float(x)] for x in point]))
    if not np.isfinite(time):
        raise Undecided("no impact is seen")
    return [*point, Fraction(float(time))]


def zeros(map_: Map) -> Map:
    """Return the function whose zeros make an arc: of a flight, of the time as well."""
    return timed(map_) if isinstance(map_, Flight) else map_


def add_arc(file: Derivation, name: str, start: Sequence[Fraction], side: Range, most: int) -> int:
    """Follow zeros of a function over its last variable, and add what is proved of them.

    side: of that variable, to whose end they are followed from about a point. Return the number of
    pieces; raises Undecided or Unproved where there are none.
    """
    map_ = file.map(name)
    axis, step, earlier = len(map_.variables) - 1, (side[1] - side[0]) / _LONGEST, {}

    def accept(piece: Piece) -> None:
        if isinstance(map_, Flight):
            earlier[piece] = _start(map_, axis, piece)

    found = follow(zeros(map_), axis, start, side[1], step=step, most=most, accept=accept)
    pieces = [each.witness for each in found]
    witness = {"function": name, "axis": map_.variables[axis], "points": [], "pieces": pieces}
    if isinstance(map_, Flight):
        times = [str(earlier[each.piece]) for each in found]
        file.add("flight-arc", {**witness, "starts": times})
    else:
        file.add("arc", witness)
    return len(found)


def _start(flight: Flight, axis: int, piece: Piece) -> Fraction:
    """Return a time before impacts by which they are the first; Undecided where none will do."""
    reason, low = "", piece.hull(axis)[-1][0]
    for part in _BEFORE:
        start = round(low * (1 - part), 6)
        try:
            require_first(flight, axis, piece, start)
        except Unproved as error:
            reason = str(error)
        else:
            return start
    raise Undecided(reason)


def _is_same(sampled: Sampled, x: Floats, y: Floats) -> bool:
    """Whether two points of curves are one, angles being taken modulo their periods."""
    n = len(sampled.periods)
    return distance(sampled, x[:n], y[:n]) < _NEAR and bool(np.allclose(x[n:], y[n:], atol=_NEAR))
