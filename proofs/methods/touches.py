"""Curves of grazes: candidates in floating point, which are followed by the rule `flight-arc`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from intervals import IntervalError, Undecided
from proofs.methods.branches import PIECES, Moving, add_arc, over, residual
from proofs.methods.derivation import Derivation
from proofs.methods.sampling import Floats, Sampled
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.flightarcs import timed
from proofs.trusted.numbers import Range

_SEEDS, _STEPS, _LOOKS = 300, 20, 1000
_BEGINNINGS = 4  # values of the axis at which grazes are looked for
_LATEST, _SOON = 32.0, 0.05  # times of grazes, in units of the motion's pace
_SMALL, _NEAR = 1e-9, 1e-6
_NAME = "G"


def periodic(
    function: Mapping[str, Any],
    region: Sequence[Range],
    moving: tuple[Moving, Moving],
    *,
    share: float = 1,
) -> Derivation:
    """Return a file whose steps are curves of flights that graze where they began.

    function: a flight from a wall, its states in contact with it; its values are those at the
    graze. The curves are over the second parameter; share: of the usual work.
    """
    names = [each.name for each in moving]
    periods = Sampled(_flight(Derivation({_NAME: function}))).periods

    def graze(turns: Sequence[int]) -> dict[str, Any]:
        made = residual(function, names, turns)
        return over(made, made["variables"], [*made["values"], _speed(made)])

    return _followed(graze, periods, [*region, *(each.range for each in moving)], share)


def launches(
    function: Mapping[str, Any], moving: tuple[Moving, Moving], *, share: float = 1
) -> Derivation:
    """Return a file whose steps are curves of launches before a graze, over the second of two.

    They are among the variables and the parameters; the other variables are parameters here.
    """
    names = [each.name for each in moving]
    made = over(function, names, [_speed(function)])
    return _followed(lambda _: made, np.array([]), [each.range for each in moving], share)


def _speed(function: Mapping[str, Any]) -> str:
    if "gaps" not in function:
        raise Undecided("grazes are followed of flights with a closed form")
    return f"D({function['gaps'][0]}, {function['time']})"


def _flight(file: Derivation, name: str = _NAME) -> Flight:
    flight = file.map(name)
    if not isinstance(flight, Flight):
        raise Undecided("this is proved for flights with a closed form")
    return flight


def _followed(graze: Any, periods: Floats, sides: Sequence[Range], share: float) -> Derivation:
    """Return a file with the curves that are found; the last side is their axis.

    graze: makes the function of the numbers of periods by which angles increase.
    """
    low, high = sides[-1]
    angles = np.isfinite(periods)
    first = _flight(Derivation({_NAME: graze([0] * sum(angles))}))
    reason, left, axis = "no graze is seen", int(PIECES * share), len(sides) - 1
    for k in range(_BEGINNINGS):
        begin = low + (high - low) * k / _BEGINNINGS
        seen = _seen(first, periods, [*sides[:-1], (begin, begin)], int(_SEEDS * share))
        kinds = {turns: f"{_NAME}{i}" for i, turns in enumerate(dict.fromkeys(t for _, t in seen))}
        file = Derivation({name: graze(turns) for turns, name in kinds.items()})
        for point, turns in seen:
            start = [*point[:axis], begin, *point[axis + 1 :]]
            try:
                left -= add_arc(file, kinds[turns], start, (low, high), left) if left else 0
            except (IntervalError, Unproved) as error:
                reason = str(error)
        if file.steps:
            return file
    raise Undecided(f"no curve is followed: {reason}")


def _seen(
    flight: Flight, periods: Floats, sides: Sequence[Range], count: int
) -> list[tuple[list[Fraction], tuple[int, ...]]]:
    """Return states and times of grazes that Newton's method finds from points at random.

    The time is the last number; with the periods by which angles increase.
    """
    unit, rng = Sampled(flight).unit(flight), np.random.default_rng(0)
    low, high = np.array([[float(end) for end in side] for side in sides]).T
    latest, formulas = _LATEST * unit, timed(flight)
    bottom, top = np.append(low, 0)[:, None], np.append(high, latest)[:, None]
    x = bottom + (top - bottom) * rng.random((len(low) + 1, count))
    free, sampled = [k for k in range(len(x)) if k != len(sides) - 1], Sampled(formulas)
    turns, error = np.zeros((count, len(periods))), np.full(count, np.inf)
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            values, slopes = sampled.expanded(x)
            turns = np.round(values[:, : len(periods)] / periods)
            values[:, : len(periods)] -= turns * np.where(np.isfinite(periods), periods, 0)
            error = np.abs(values).max(axis=1)
            slopes = slopes[:, :, free]
            kept = np.isfinite(error) & np.isfinite(slopes).all(axis=(1, 2))
            moves = np.linalg.pinv(slopes[kept]) @ values[kept][:, :, None]
            for place, change in zip(free, moves[:, :, 0].T, strict=True):
                x[place, kept] -= change
    found: list[tuple[list[Fraction], tuple[int, ...]]] = []
    near: list[Floats] = []
    angles = np.flatnonzero(np.isfinite(periods))
    for k in sorted(np.flatnonzero(error < _SMALL), key=lambda k: float(x[-1, k])):
        here = x[:, k].copy()
        here[angles] %= periods[angles]
        is_in = (low <= here[:-1]) & (here[:-1] <= high) | np.isin(np.arange(len(low)), angles)
        if not is_in.all() or not _SOON * unit < here[-1] < latest:
            continue
        if any(np.allclose(here[:-1], other, atol=_NEAR) for other in near):
            continue  # it goes on after a graze
        near.append(here[:-1])
        if _is_first(sampled, flight, here):
            found.append(([*map(Fraction, here.tolist())], tuple(map(int, turns[k, angles]))))
    return found


def _is_first(sampled: Sampled, flight: Flight, place: Floats) -> bool:
    """Whether all gaps are > 0 before, at the times that are looked at."""
    formulas, times = flight.formulas, place[-1] * np.linspace(0, 0.99, _LOOKS)[1:]
    states = [np.full(len(times), each) for each in place[:-1]]
    gaps = sampled.evaluated(formulas, formulas.roots[: len(flight.gaps)], [*states, times])
    return bool((gaps > 0).all())
