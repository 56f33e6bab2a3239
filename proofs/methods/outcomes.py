"""What comes after a launch other than an impact: candidates in floating point, then the rules."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np

from intervals import Undecided
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import subdivide
from proofs.methods.sampling import Floats, Sampled, compiled
from proofs.trusted.certificate import Reader, texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import Box, centre_of, point_box
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.trees import formula
from proofs.trusted.numbers import Range
from proofs.trusted.rules import find_rule

_TIMES = (16, 64, 256)  # after which the end is looked at
_PARTS = 60  # of a box of states
_POINTS, _HALVINGS, _STEPS = 400, 40, 8
_LATER = 1e-3  # by which impacts on both sides of a graze differ, in units of the motion's pace
_SIZES = (  # of boxes around a graze: the variable, the time in such units
    (Fraction(1, 10**9), Fraction(1, 10**3)),
    (Fraction(1, 10**12), Fraction(1, 10**4)),
    (Fraction(1, 10**6), Fraction(1, 10**2)),
)


def _flight(file: Derivation, function: str) -> Flight:
    flight = file.map(function)
    if not isinstance(flight, Flight):
        raise Undecided("this is proved for flights with a closed form")
    return flight


def _divided(file: Derivation, rule: str, box: Box, **witness: Any) -> str:
    """Add a step of a rule whose witness has a tree that divides a box."""
    derive = find_rule(rule)

    def holds(part: Box) -> bool:
        sides = {"box": list(map(texts, part)), "tree": None}
        try:
            return bool(derive and derive(file.context, Reader({**witness, **sides})))
        except Unproved as error:
            reasons.append(str(error))
            return False

    reasons: list[str] = []
    if not holds(point_box(centre_of(box))):
        raise Undecided(reasons[-1])
    try:
        tree = subdivide(box, holds, most=_PARTS)
    except Undecided:
        raise Undecided(reasons[-1]) from None
    return file.add(rule, {**witness, "box": list(map(texts, box)), "tree": tree})


def pressed(file: Derivation, function: str, box: Box) -> str:
    """Prove that no flight begins after the states of a box; Undecided where that is not proved."""
    _flight(file, function)
    return _divided(file, "pressed", box, function=function)


def no_impact(file: Derivation, function: str, box: Box) -> str:
    """Prove that no impact follows ever; Undecided where that is not proved."""
    reason = Undecided("nothing is looked at")
    _flight(file, function)
    for time in _TIMES:
        try:
            return _divided(file, "no-impact", box, function=function, time=str(time))
        except Undecided as error:
            reason = error
    raise reason


# -- grazes ----------------------------------------------------------------------------------------


def graze(file: Derivation, function: str, box: Box) -> str:
    """Prove that one value of the variable with a range is followed by a graze, if one is found."""
    flight = _flight(file, function)
    free = [k for k, (low, high) in enumerate(box) if low < high]
    if len(free) != 1:
        raise ValueError("one variable with a range is expected, and numbers for the others")
    reason, axis = "no graze is seen", free[0]
    unit = Sampled(flight).unit(flight)
    for value, time in _touches(flight, box, axis, unit):
        for radius, width in _SIZES:
            sides, window = list(box), _around(time, width * Fraction(f"{unit:.3g}"))
            sides[axis] = _around(value, radius)
            witness = {"function": function, "box": list(map(texts, sides)), "axis": str(axis + 1)}
            try:
                return file.add("graze", {**witness, "time": texts(window)})
            except Unproved as error:
                reason = str(error)
    raise Undecided(reason)


def _around(value: float, radius: Fraction) -> Range:
    middle = radius / 100 * round(Fraction(value) / radius * 100)
    return middle - radius, middle + radius


def _touches(flight: Flight, box: Box, axis: int, unit: float) -> Iterator[tuple[float, float]]:
    """Yield values of a variable, where the time of the impact jumps, and times: gap = gap' = 0.

    Not those right after launch, where every gap is 0.
    """
    sampled, point = Sampled(flight), np.array([[float(x)] for x in centre_of(box)])

    def times(values: Floats) -> Floats:
        states = np.repeat(point, len(values), axis=1)
        states[axis] = values
        return np.nan_to_num(sampled.times(flight, states), nan=np.inf)

    grid = np.linspace(float(box[axis][0]), float(box[axis][1]), _POINTS)
    ends, low, high = times(grid), grid[:-1], grid[1:]
    first, last = ends[:-1], ends[1:]
    with np.errstate(invalid="ignore"):
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            time = times(middle)
            is_first = np.abs(time - first) <= np.abs(time - last)
            low, first = np.where(is_first, (middle, time), (low, first))
            high, last = np.where(is_first, (high, last), (middle, time))
        jumps = np.flatnonzero(np.abs(first - last) > _LATER * unit)
    for k in jumps:
        point[axis] = low[k]
        touch = _polished(flight, point[:, 0], axis, min(first[k], last[k]))
        if math.isfinite(touch[0]) and touch[1] > 20 * _LATER * unit:
            yield touch


def _polished(flight: Flight, x: Floats, axis: int, time: float) -> tuple[float, float]:
    """Solve gap = gap' = 0 for one variable and the time, by Newton's method."""
    tape, orders = flight.formulas.tape, flight.gaps[0].orders
    slopes = [tape.derivative(root, axis) for root in orders[:2]]
    function = compiled(tape, [*orders[:3], *slopes])
    numbers = [float(sum(side) / 2) for side in flight.formulas.ranges]
    for _ in range(_STEPS):
        gap, rate, bend, lead, turn = function(*x, time, *numbers)
        if not (divisor := lead * bend - rate * turn):
            return math.nan, math.nan
        x[axis] -= (gap * bend - rate * rate) / divisor
        time -= (lead * rate - turn * gap) / divisor
    return x[axis], time


# -- states at rest on a wall ----------------------------------------------------------------------


def resting(function: Mapping[str, Any], contact: Mapping[str, str]) -> dict[str, Any]:
    """Return a flight from states where some variables are formulas of the others."""

    def put(part: Any) -> Any:
        match part:
            case dict():
                return {key: put(value) for key, value in part.items()}
            case list():
                return [put(each) for each in part]
        words = re.sub(r"[a-z]\w*", lambda word: places.get(word[0], word[0]), part)
        return part if words == part else str(formula(words))

    if "motion" not in function:
        raise Undecided("this is proved for flights with a closed form")
    places = {name: f"({value})" for name, value in contact.items()}
    kept = [k for k, name in enumerate(function["variables"]) if name not in contact]
    left = {key: [function[key][k] for k in kept] for key in ("variables", "values")}
    return {**function, "motion": put(function["motion"]), **left, "values": put(left["values"])}
