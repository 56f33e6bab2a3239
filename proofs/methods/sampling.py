"""A map of the checker in floating point, for many points at once: candidates, never proofs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from proofs.methods.flows import AT_ONCE, Flown, closer, pace, phase_speeds
from proofs.trusted.kernel.composition import Composition
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.flow import Flow
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.maps import Map
from proofs.trusted.numbers import Range

Floats = NDArray[np.float64]
Function = Callable[..., Sequence[Any]]

_BITS = 64  # of periods
_STEP, _LONGEST = 1 / 32, 64.0  # of a flight
_PERIODS = 8  # by so much more steps may be shorter than flights, where phases are fast
_TOGETHER, _FEWEST, _MOST = 8192, 128, 2048  # gaps of all flights at once; steps of each
_NEWTON = 16  # a flight may be a thousandth of a step, and he halves what is left, first
_JUST = 1e-12  # a part of a period by which an angle may be below 0
_APART = 1e-6  # of points for differences
_STARTS, _FEW = 120, 20  # points at random for a search

_OPERATORS = {
    "atan": "np.arctan({})",
    "+": "{} + {}",
    "-": "{} - {}",
    "*": "{}*{}",
    "/": "{}/{}",
    "negative": "-{}",
}


def compiled(tape: Tape, roots: Sequence[int]) -> Function:
    """Return the roots as a function of arrays: each operation of the tape in a line."""
    lines = ["def function(*x):"]
    for place in tape.order(tuple(roots)):
        op, arguments, datum = tape.nodes[place]
        names = [f"v{i}" for i in arguments]
        if op == "variable":
            value = f"x[{int(datum)}]"
        elif op == "number":
            value = f"np.float64({float(datum)!r})"  # which divides by 0, as arrays do
        elif op == "pi":
            value = "np.pi"
        elif op == "^":
            value = f"{names[0]}**{float(datum)}" if datum < 0 else f"{names[0]}**{int(datum)}"
        else:
            value = _OPERATORS.get(op, f"np.{op}({{}})").format(*names)
        lines.append(f"    v{place} = {value}")
    lines.append(f"    return [{', '.join(f'v{root}' for root in roots)}]")
    scope: dict[str, Any] = {"np": np}
    exec("\n".join(lines), scope)  # a text of our own, from nodes of known operations
    function: Function = scope["function"]
    return function


def ranges_of(map_: Map) -> tuple[Range, ...]:
    """Return the ranges of a map's parameters, which the maps of a composition have in common."""
    if isinstance(map_, Composition):
        return ranges_of(map_.maps[0])
    if isinstance(map_, Flow):
        return map_.ranges
    if isinstance(map_, Flight | Formulas):
        return map_.formulas.ranges if isinstance(map_, Flight) else map_.ranges
    raise TypeError(f"no way to sample a {type(map_).__name__}")


def shut(map_: Map, region: Sequence[Range]) -> str:
    """Return a gap that is < 0 right after all launches from a box that are tried; "" if none."""
    if not isinstance(map_, Flight):
        return ""
    shares = np.random.default_rng(0).random((len(region), _STARTS))
    low, high = np.array([[float(end) for end in side] for side in region]).T[:, :, None]
    soon = np.full(_STARTS, _STEP / 1024)
    sampled, formulas = Sampled(map_), map_.formulas
    with np.errstate(all="ignore"):
        gaps = sampled.evaluated(
            formulas, formulas.roots[: len(map_.gaps)], [*(low + (high - low) * shares), soon]
        )
    return next((str(gap) for gap, x in zip(map_.walls, gaps, strict=True) if (x < 0).all()), "")


@dataclass(frozen=True)
class Sampled:
    """A map on arrays of points, of the shape (n, points); nan where it is not defined.

    shares: where each parameter is in its range, from 0 to 1; in the middle of those left out.
    """

    map: Map
    shares: tuple[float, ...] = ()

    def iterate(self, power: int) -> Power:
        """Return an iterate of it."""
        return Power(self.map, self.shares, power)

    def varied(self) -> Iterator[tuple[Self, Self]]:
        """Yield the map with one parameter at the ends of its range, for each of the parameters."""
        for k in range(len(ranges_of(self.map))):
            low, high = ((0.5,) * k + (end,) for end in (0.0, 1.0))
            yield replace(self, shares=low), replace(self, shares=high)

    def __call__(self, x: Floats) -> Floats:
        """Return the images; angles are not reduced."""
        with np.errstate(all="ignore"):
            return self._images(self.map, x)

    @property
    def starts(self) -> int:
        """The number of points at random for a search: fewer of a flow, where each is dear."""
        return _FEW if self.has_flows else _STARTS

    @property
    def has_flows(self) -> bool:
        """Whether a part of it is a flow without a closed form, which takes long."""
        return any(isinstance(part, Flow) for part in self.parts)

    @property
    def parts(self) -> tuple[Map, ...]:
        """The maps of which it is made, in their order."""
        return self.map.maps if isinstance(self.map, Composition) else (self.map,)

    def undefined(self, part: Map, x: Floats) -> str:
        """Say why a point, a column, has no image under one of the parts."""
        if isinstance(part, Formulas):
            return "where the map is not defined, or too large for floating point"
        if isinstance(part, Flow):
            return Flown(part, self._parameters(part.ranges), compiled).undefined(x)
        if not isinstance(part, Flight):
            raise TypeError(f"no way to sample a {type(part).__name__}")
        gaps = self._function(part.formulas, part.formulas.roots[: len(part.gaps)])
        step, longest = self._steps(part)
        times = np.concatenate([[step / 1024], np.arange(step, longest, step)])
        with np.errstate(all="ignore"):
            passed = [np.broadcast_to(gap <= 0, times.shape) for gap in gaps(*x, times)]
        if not np.any(passed):
            return f"no impact is seen up to the time {longest:.3g}"
        first = np.any(passed, axis=0).argmax()
        gap = next(
            str(wall) for wall, is_in in zip(part.walls, passed, strict=True) if is_in[first]
        )
        if not first:
            return f"{AT_ONCE}: {gap} is not > 0 right after the impact"
        if gap == str(part.walls[0]):
            return "where the state after the impact is not defined"
        return f"at another wall than is next in their order: {gap} is 0 first"

    @cached_property
    def periods(self) -> Floats:
        """The period of each variable, inf for one that is no angle."""
        lengths = self.map.periods(_BITS)
        return np.array(
            [
                float(sum(lengths[i].range) / 2) if i in lengths else np.inf
                for i in range(len(self.map.variables))
            ]
        )

    def reduced(self, x: Floats) -> Floats:
        """Return points with their angles from 0 on, or just below, to short of their periods."""
        return x - self.turns(x) * np.where(np.isfinite(self.periods), self.periods, 0)[:, None]

    def turns(self, x: Floats) -> Floats:
        """Return the whole periods in the angles of points."""
        with np.errstate(invalid="ignore"):
            return np.floor(x / self.periods[:, None] + _JUST)

    def expanded(self, x: Floats) -> tuple[Floats, Floats]:
        """Return the images of points, of the shape (points, n), and the derivatives there.

        By the derivatives of the formulas; of flows, by differences.
        """
        if self.has_flows:
            return self._differences(x)
        product = np.broadcast_to(np.eye(len(x)), (x.shape[1], len(x), len(x)))
        with np.errstate(all="ignore"):
            for part in self.parts:
                x, slopes = self._expanded(part, x)
                product = slopes @ product
        return x.T, product

    def _differences(self, x: Floats) -> tuple[Floats, Floats]:
        """Do so in one call, since a call costs more than its points."""
        n, count = x.shape
        moves = [s * unit[:, None] for unit in np.eye(n) for s in (_APART, -_APART)]
        ends = self(np.concatenate([x, *(x + move for move in moves)], axis=1))
        image, *others = ends.reshape(n, 2 * n + 1, count).swapaxes(0, 1)
        columns = [(a - b) / (2 * _APART) for a, b in zip(others[::2], others[1::2], strict=True)]
        return image.T, np.moveaxis(np.array(columns), 2, 0).swapaxes(1, 2)

    def _expanded(self, part: Map, x: Floats) -> tuple[Floats, Floats]:
        """Return the images under one map, and the derivatives, of the shape (points, m, n).

        Of a flight F_x - F_t gap_x / gap_t, by the implicit function theorem.
        """
        n = len(x)
        if isinstance(part, Formulas):
            slopes = [part.tape.derivative(root, k) for root in part.roots for k in range(n)]
            values = self.evaluated(part, (*part.roots, *slopes), [*x])
            image, rates = np.split(values, [len(part.roots)])
            return image, np.moveaxis(rates.reshape(len(image), n, -1), 2, 0)
        if not isinstance(part, Flight):
            raise TypeError(f"no derivatives of a {type(part).__name__}")
        roots = (part.gaps[0].orders[0], *part.outcome)
        slopes = [slope for root in roots for slope in part.slopes(root, range(n))]
        values = self.evaluated(part.formulas, (*roots, *slopes), [*x, self.times(part, x)])
        images, rates = np.split(values, [len(roots)])
        (*gap, fall), *rows = rates.reshape(len(roots), n + 1, -1)
        own = [row[:n] - row[n] * np.array(gap) / fall for row in rows]
        return images[1:], np.moveaxis(np.array(own), 2, 0)

    def _images(self, map_: Map, x: Floats) -> Floats:
        if isinstance(map_, Composition):
            for each in map_.maps:
                x = self._images(each, x)
            return x
        if isinstance(map_, Flight):
            time = self.times(map_, x)
            return self.evaluated(map_.formulas, map_.outcome, [*x, time])
        if isinstance(map_, Flow):
            return Flown(map_, self._parameters(map_.ranges), compiled)(x)
        if isinstance(map_, Formulas):
            return self.evaluated(map_, map_.roots, [*x])
        raise TypeError(f"no way to sample a {type(map_).__name__}")

    def times(self, flight: Flight, x: Floats) -> Floats:
        """Return the times of the first impacts, nan where there is none, or another gap is first.

        Gaps are looked at in small steps: what touches between two of them is missed.
        """
        gaps = self._function(flight.formulas, flight.formulas.roots[: len(flight.gaps)])

        def gap(t: Floats, at: Any = slice(None)) -> Floats:
            return np.array([np.broadcast_to(g, np.shape(t)) for g in gaps(*x[:, at], t)])

        step, longest = self._steps(flight)
        soon, hit = np.full(x.shape[1], step / 1024), np.full(x.shape[1], np.nan)
        waiting = np.flatnonzero(np.isfinite(x).all(axis=0) & (gap(soon) > 0).all(axis=0))
        now, count = 0.0, min(max(_FEWEST, _TOGETHER // max(len(waiting), 1)), _MOST)
        steps = step * np.arange(1, count + 1)
        while len(waiting) and now < longest:
            times = np.broadcast_to((now + steps)[:, None], (count, len(waiting)))
            below = gap(times, waiting) <= 0
            stops = below.any(axis=0)
            first = stops.argmax(axis=0)
            stopped = stops.any(axis=0)
            own = below[0, first, np.arange(len(waiting))]
            hit[waiting[stopped & own]] = now + steps[first[stopped & own]]
            waiting, now = waiting[~stopped], now + count * step
        slope = self._function(flight.formulas, flight.gaps[0].orders[:2])
        low = np.maximum(hit - step, step / 1024)
        above, below = (slope(*x, t)[0] for t in (low, hit))
        time: Floats = low + (hit - low) * above / (above - below)
        for _ in range(_NEWTON):
            value, rate = slope(*x, time)
            time, low, hit = closer(time, value, rate, low, hit)
        return time

    def _steps(self, flight: Flight) -> tuple[float, float]:
        """Return the time between two looks at the gaps, and the longest time."""
        unit = self.unit(flight)
        return _STEP * unit, min(_LONGEST, _PERIODS * _LONGEST * unit)

    def unit(self, flight: Flight) -> float:
        """Return a time in which the fastest phase of the gaps turns by about 1, or 1."""
        formulas, time = flight.formulas, len(flight.variables)
        start = [np.zeros(1)] * (time + 1)
        speeds = phase_speeds(formulas.tape, formulas.roots[: len(flight.gaps)], time)
        return 1 / pace(self.evaluated(formulas, speeds, start) if speeds else ())

    def evaluated(self, formulas: Formulas, roots: Sequence[int], x: list[Floats]) -> Floats:
        """Return roots of a tape at points."""
        values = self._function(formulas, tuple(roots))(*x)
        return np.array([np.broadcast_to(value, np.shape(x[0])) for value in values])

    def _parameters(self, ranges: Sequence[Range]) -> list[float]:
        shares = (*self.shares, *[0.5] * len(ranges))
        sides = zip(ranges, shares, strict=False)
        return [float(low) + float(high - low) * share for (low, high), share in sides]

    def _function(self, formulas: Formulas, roots: Sequence[int]) -> Function:
        key = (id(formulas), tuple(roots))
        if key not in self._compiled:
            parameters = self._parameters(formulas.ranges)
            function = compiled(formulas.tape, roots)
            self._compiled[key] = lambda *x: function(*x, *parameters)
        return self._compiled[key]

    @cached_property
    def _compiled(self) -> dict[tuple[int, tuple[int, ...]], Function]:
        return {}


@dataclass(frozen=True)
class Power(Sampled):
    """An iterate of a map, in floating point."""

    power: int = 1

    @property
    def parts(self) -> tuple[Map, ...]:
        """The maps of which it is made, in their order."""
        return super().parts * self.power

    def __call__(self, x: Floats) -> Floats:
        """Return the images."""
        for _ in range(self.power):
            x = Sampled.__call__(self, x)
        return x
