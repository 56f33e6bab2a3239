"""Flights by simulation: steps of Runge and Kutta along the equation of motion, then bisection.

A reader of its own: texts by Python's `eval`, y and D(y, t) being variables. It never sees the
closed form. Many flights at once, as arrays; nan where there is no impact with the first gap, or
another gap is passed before. The steps are off by some 1e-11.
"""

import re
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from tests.once import EFFORT

STEP, LATEST, HALVINGS = 1 / 200, 200, 50
DIFFERENCE = 2e-4
NUMPY = {name: getattr(np, name) for name in ("sin", "cos", "exp", "log", "sqrt", "pi")}


class Motion(NamedTuple):
    """y^(n) = equation, with y, y', ... at the start."""

    name: str
    equation: str
    start: tuple[str, ...]


class System(NamedTuple):
    """What a flight is, in texts; parameters: their least and greatest values."""

    variables: tuple[str, ...]
    time: str
    motions: tuple[Motion, ...]
    gaps: tuple[str, ...]
    values: tuple[str, ...]
    parameters: dict[str, tuple[Fraction, Fraction]]

    def written(self, text):
        """A text in which y and D(y, t) are names: y_0, y_1."""
        for name in (motion.name for motion in self.motions):
            rates = re.compile(rf"D\({name}((?:, {self.time})+)\)")
            text = rates.sub(lambda m, y=name: f"{y}_{m[1].count(',')}", text)
            text = re.sub(rf"\b{name}\b", f"{name}_0", text)
        return text

    def function(self, texts, numbers=NUMPY):
        """A function of an environment: the values of some texts."""
        code = compile("".join(f"({self.written(text)}), " for text in texts), "", "eval")
        return lambda env: eval(code, numbers, env)


def system_of(data):
    """The system of a function in a file."""
    motions = tuple(
        Motion(each["name"], each["equation"], tuple(each["start"])) for each in data["motion"]
    )
    sides = {n: tuple(map(Fraction, ends)) for n, ends in data.get("parameters", {}).items()}
    texts = (tuple(data[part]) for part in ("gaps", "values"))
    return System(tuple(data["variables"]), data["time"], motions, *texts, sides)


def system_of_record(flight):
    """The same of a record that `judge.view` made: from what its sentence says."""
    formulas, count = flight.formulas, len(flight.gaps)
    variables, time = formulas.variables[: flight.state], formulas.variables[flight.state]
    texts = formulas.trees[:count], formulas.trees[count:]
    motions = tuple(Motion(name, right, tuple(start)) for name, _, right, start in flight.motions)
    return System(variables, time, motions, *texts, parameters_in(formulas.given))


def parameters_in(given):
    """The parameters in ", `g` = 0.1, for all `e` in [0.5, 0.6], `phi` modulo `2*pi`"."""
    found = re.findall(r", (?:for all )?`(\w+)` (?:= ([^,]+)|in \[([^,]+), ([^\]]+)\])", given)
    return {name: (Fraction(x or low), Fraction(x or high)) for name, x, low, high in found}


class Simulation:
    """A system with values of its parameters, a third of the way between their ends."""

    def __init__(self, system, step=STEP):
        self.system, self.step = system, step
        sides = system.parameters.items()
        self.parameters = {name: float(low + (high - low) / 3) for name, (low, high) in sides}
        self.names = [f"{m.name}_{k}" for m in system.motions for k in range(len(m.start))]
        rates = []
        for m in system.motions:
            rates += [f"{m.name}_{k + 1}" for k in range(len(m.start) - 1)] + [m.equation]
        self.rates, self.starts, self.gaps, self.values = map(
            system.function,
            (rates, [x for m in system.motions for x in m.start], system.gaps, system.values),
        )

    def _on(self, function, env, t, z):
        place = dict(zip(self.names, z, strict=True))
        return function({**env, self.system.time: t, **place})

    def _rows(self, function, env, t, z):
        found = self._on(function, env, t, z)
        return np.array([np.broadcast_to(x, z[0].shape) for x in found])

    def _moved(self, env, t, z, h):
        k = [self._on(self.rates, env, t, z)]
        for part in (h / 2, h / 2, h):
            there = [x + part * rate for x, rate in zip(z, k[-1], strict=True)]
            k.append(self._on(self.rates, env, t + part, there))
        steps = zip(z, *k, strict=True)
        return np.array([x + h / 6 * (a + 2 * (b + c) + d) for x, a, b, c, d in steps])

    def _launched(self, states):
        """The environment of many flights, and where they start."""
        env = dict(zip(self.system.variables, states, strict=True))
        env |= {name: np.full(states.shape[1], value) for name, value in self.parameters.items()}
        nobody = np.zeros((len(self.names), states.shape[1]))
        return env, self._rows(self.starts, env, 0.0, nobody)

    def heights(self, states, until):
        """The gaps along many flights through all walls: of the shape (times, gaps, flights)."""
        env, z = self._launched(np.asarray(states, float))
        found = []
        for k in range(round(until / self.step)):
            z = self._moved(env, k * self.step, z, self.step)
            found.append(self._rows(self.gaps, env, (k + 1) * self.step, z))
        return np.array(found)

    def at(self, states, times):
        """The values, a row each, of many flights at about one time."""
        (env, z), count = self._launched(np.asarray(states, float)), int(min(times) / self.step)
        for k in range(count):
            z = self._moved(env, k * self.step, z, self.step)
        z = self._moved(env, count * self.step, z, times - count * self.step)
        return self._rows(self.values, env, times, z)

    def fly(self, states):
        """The values, a row each, at the impacts of many flights; the last row has the times."""
        states = np.asarray(states, float)
        result = np.full((len(self.system.values) + 1, states.shape[1]), np.nan)
        (env, z), steps, here = self._launched(states), 0, np.arange(states.shape[1])
        while here.size and steps * self.step < LATEST:
            t = steps * self.step
            after = self._moved(env, t, z, self.step)
            first, *others = self._on(self.gaps, env, t + self.step, after)
            hit, lost = first <= 0, np.any([x <= 0 for x in others], axis=0) & (first > 0)
            if np.any(hit):
                inner = {name: x[hit] for name, x in env.items()}
                result[:, here[hit]] = self._landed(inner, t, z[:, hit])
            if np.any(left := hit | lost):
                env, after = {n: x[~left] for n, x in env.items()}, after[:, ~left]
                here = here[~left]
            z, steps = after, steps + 1
        return result

    def _landed(self, env, t, z):
        low, high = np.zeros(z.shape[1]), np.full(z.shape[1], self.step)
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            up = self._on(self.gaps, env, t + middle, self._moved(env, t, z, middle))[0] > 0
            low, high = np.where(up, middle, low), np.where(up, high, middle)
        end = self._moved(env, t, z, high)
        found = np.vstack([self._rows(self.values, env, t + high, end), t + high])
        others = self._rows(self.gaps, env, t + high, end)[1:]
        found[:, np.any(others <= 0, axis=0)] = np.nan
        return found

    def slopes(self, states):
        """The derivatives d value_i / d x_j, by differences of the fourth order."""
        states = np.asarray(states, float)
        n, columns = len(states), []
        for k in range(n):
            step = np.eye(n)[:, [k]] * DIFFERENCE
            sides = np.hstack([states + j * step for j in (-2, -1, 1, 2)])
            a, b, c, d = np.split(self.fly(sides)[:-1], 4, axis=1)
            columns.append((a - 8 * b + 8 * c - d) / (12 * DIFFERENCE))
        return np.stack(columns, axis=1)


# -- judges of what comes after a launch, by simulation --------------------------------------------


LONG, SHORT = (20 if EFFORT.quick else 80), 1 / 200  # times
SLIP = 1e-10  # of the gaps


def simulated(view, values=None):
    """The flights of a record, perhaps with other values."""
    system = system_of_record(view.function)
    return Simulation(system._replace(values=values or system.values))


def _states(view, rng, count=12):
    """Corners and random points of the box, a column each."""
    sides = [(float(low), float(high)) for low, high in view.box]
    shares = [[rng.choice((0, 1, rng.random())) for _ in sides] for _ in range(count)]
    return np.array(
        [[a + (b - a) * s for (a, b), s in zip(sides, x, strict=True)] for x in shares]
    ).T


def no_impact(view, rng):
    """Gaps are > 0 for a long time."""
    heights = simulated(view).heights(_states(view, rng), LONG)
    return [] if heights.min() > -SLIP else [f"a gap of {heights.min():.3g} is seen"]


def pressed(view, rng):
    """A gap is < 0 soon."""
    heights = simulated(view).heights(_states(view, rng), SHORT)
    most = heights.min(axis=(0, 1)).max()
    return [] if most < 0 else [f"all gaps are {most:.3g} at least, soon after launch"]


def graze(view, rng):
    """The least gap in the window, between the steps, is < 0 on one side, and > 0 on the other."""
    states = _states(view, rng, 2)
    states[:] = states[:, :1]
    states[view.axis] = [float(x) for x in view.box[view.axis]]
    low, high = map(float, view.time)
    gaps = simulated(view).heights(states, high + 4 * SHORT)
    below, above = (0, 1) if view.rises else (1, 0)
    told = [] if gaps[: int(low / SHORT)].min() > 0 else ["a gap is < 0 before"]
    for side, sign in ((below, -1), (above, 1)):
        least, time = least_near(gaps[:, 0, side], round((low + high) / 2 / SHORT) - 1)
        if sign * least < 0 or not low <= time <= high:
            told.append(f"on one side the gap is {least:.3g} at the least, at the time {time:.9g}")
    return told


def least_near(gap, near):
    """The least value between some steps, by interpolation, and the time."""
    about = near + np.arange(-3, 4)
    curve = np.polynomial.Polynomial.fit(SHORT * (about + 1), gap[about], 6)
    times = [x.real for x in curve.deriv().roots() if abs(x.imag) < 1e-9]
    time = min(times, key=lambda t: abs(t - SHORT * (near + 1)))
    return curve(time), time
