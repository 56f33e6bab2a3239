"""Flows of the checker in floating point, many at once: extrapolated midpoint rules (Gragg)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.flow import Flow
from proofs.trusted.kernel.formulas import Formulas

Floats = NDArray[np.float64]
Compiled = Callable[..., Any]

_ROW = (2, 4, 6, 8, 10, 12)  # midpoint rules of a step; exact to the order 12
_EXACT, _FAR = 1e-11, 1e4  # the error of a step, as a part of states; where they are lost
_FIRST, _SHORTEST, _LONGEST, _LATEST = 1 / 512, 1 / 64, 1 / 4, 64.0
_PACE, _PERIODS = 4, 8  # the speed of a phase from which steps are shorter; they more than times
_NEWTON = 5
AT_ONCE = "at once, as at rest or after chatter"
_ZERO = 1e-12  # a gap that is so small at the start is 0


def phase_speeds(tape: Tape, roots: Sequence[int], time: int) -> list[int]:
    """Return the derivatives by the time of what roots take the sine or cosine of."""
    nodes = (tape.nodes[place] for place in tape.order(tuple(roots)))
    phases = dict.fromkeys(node.arguments[0] for node in nodes if node.op in ("sin", "cos"))
    return [tape.derivative(phase, time) for phase in phases]


def pace(speeds: Any) -> float:
    """Return by how much steps are shorter than usual, at speeds of phases: 1 or more."""
    return max(1.0, float(np.nanmax(np.abs([*speeds]), initial=0)) / _PACE)


@dataclass(frozen=True)
class Flown:
    """A flow in floating point, at values of the parameters that have ranges.

    compile: makes a function of arrays from a tape and its roots.
    """

    flow: Flow
    parameters: Sequence[float]
    compile: Callable[..., Compiled]

    def __call__(self, w: Floats) -> Floats:
        """Return the values for variables w, a row each; nan where the end is not reached.

        Gaps are looked at after each step: what is passed twice within one is missed.
        """
        flow, count, section = self.flow, w.shape[1], self.flow.section
        given = [np.full(count, value) for value in self.parameters]
        w, here = np.array([*w, *given]), np.arange(count)
        walls = [self._function(wall.formulas) for wall in section.walls]
        first, rate = self._function(section.gap.formulas), self._function(section.velocity)
        x = self._function(flow.start)(w, np.zeros((flow.equation.n, count)), np.zeros(count))
        values, falls = np.full((flow.size, count), np.nan), np.zeros(count, int)
        begin, arrivals = w, list[tuple[Floats, ...]]()
        above, time, unit = first(w, x, np.zeros(count))[0] > _ZERO, 0.0, 1 / self._pace(w, x)
        h, latest = _FIRST * unit, min(_LATEST, _PERIODS * _LATEST * unit)
        while here.size and time < latest:
            after, error = _step(rate, w, x, np.full(here.size, time), np.full(here.size, h))
            exact = error < _EXACT
            if not exact.all() and h > _SHORTEST * unit:
                h /= 2
                continue
            t = np.full(here.size, time + h)
            gap = first(w, after, t)[0]
            falls = falls + (above & (gap <= 0))
            arrived = falls == section.number
            arrivals.append(
                (here[arrived], x[:, arrived], t[arrived] - h, np.full(arrived.sum(), h))
            )
            going = ~arrived & exact & (np.abs(after) < _FAR).all(axis=0)
            for wall in walls:
                going &= wall(w, after, t)[0] > 0
            w, x, here, falls = w[:, going], after[:, going], here[going], falls[going]
            above, time = (gap > 0)[going], time + h
            h = min(2 * h if (error < _EXACT / 2**13).all() else h, _LONGEST * unit)
        if arrivals:
            who, *way = (np.concatenate(each, axis=-1) for each in zip(*arrivals, strict=True))
            end = _landed(rate, first, begin[:, who], way)
            values[:, who] = self._function(flow.outcome)(begin[:, who], *end)
        return values

    def undefined(self, w: Floats) -> str:
        """Say why a point, a column, has no image."""
        flow, soon = self.flow, np.full(1, _FIRST)
        w = np.array([*w, *(np.full(1, value) for value in self.parameters)])
        x = self._function(flow.start)(w, np.zeros((flow.equation.n, 1)), np.zeros(1))
        after, _ = _step(self._function(flow.section.velocity), w, x, np.zeros(1), soon)
        if flow.end.walls and self._function(flow.section.gap.formulas)(w, after, soon)[0] <= 0:
            return f"{AT_ONCE}: {flow.end.gaps[0]} is not > 0 right after the impact"
        return "where the motion goes far away, is not smooth, or is not seen to end"

    def _pace(self, w: Floats, x: Floats) -> float:
        """Return by how much steps are shorter: the speed of phases in the equation and the gap."""
        time, speeds = self.flow.first + self.flow.equation.n, list[Floats]()
        for formulas in (self.flow.section.velocity, self.flow.section.gap.formulas):
            if roots := phase_speeds(formulas.tape, formulas.roots, time):
                speeds += [*self._function(replace(formulas, roots=tuple(roots)))(w, x, 0 * w[0])]
        return pace(speeds)

    def _function(self, formulas: Formulas) -> Compiled:
        function = self.compile(formulas.tape, formulas.roots)

        def at(w: Floats, x: Floats, t: Floats) -> Floats:
            values = np.empty((len(formulas.roots), *t.shape))
            for value, entry in zip(
                values, function(*self.flow.equation.inputs([*w], [*x], t)), strict=True
            ):
                value[:] = entry
            return values

        return at


def closer(
    time: Floats, gap: Floats, slope: Floats, low: Floats, high: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return a time nearer to that at which a gap falls to 0, and the times between which it does.

    Newton's, or the middle: his may be that of the launch.
    """
    low, high = np.where(gap > 0, (time, high), (low, time))
    newton = time - gap / slope
    return np.where((low <= newton) & (newton <= high), newton, (low + high) / 2), low, high


def _landed(
    rate: Compiled, gap: Compiled, w: Floats, way: Sequence[Floats]
) -> tuple[Floats, Floats]:
    """Return the states and the times at which the gap is 0, by Newton's method.

    way: the states and times before, and the times after which the gap is <= 0.
    """
    x, t, h = way
    low, s = 0 * h, h / 2
    for _ in range(_NEWTON):
        value, slope = gap(w, _step(rate, w, x, t, s)[0], t + s)
        s, low, h = closer(s, value, slope, low, h)
    return _step(rate, w, x, t, s)[0], t + s


def _step(rate: Compiled, w: Floats, x: Floats, t: Floats, h: Floats) -> tuple[Floats, Floats]:
    """Return the states after a time h, and how far off each is, as a part of it.

    All midpoint rules go on together, as a call costs more than its points; those of fewest parts,
    which come first, end first.
    """
    s, table = h / np.array(_ROW)[:, None], list[list[Floats]]()
    before, now = x[:, None], x[:, None] + s * rate(w, x, t)[:, None]
    for k in range(1, _ROW[-1] + 1):
        slopes = rate(w, now, t + k * s)
        if k == _ROW[len(table)]:
            line = [(now[:, 0] + before[:, 0] + s[0] * slopes[:, 0]) / 2]
            for j, other in enumerate(table[-1] if table else [], 1):
                line.append(line[-1] + (line[-1] - other) / ((k / _ROW[len(table) - j]) ** 2 - 1))
            table.append(line)
            s, before, now, slopes = s[1:], before[:, 1:], now[:, 1:], slopes[:, 1:]
        before, now = now, before + 2 * s * slopes
    last, previous = table[-1][-1], table[-1][-2]
    return last, (np.abs(last - previous) / (1 + np.abs(last))).max(axis=0)
