"""Arrays of intervals in binary64 beside other packages': time, and width beyond the least bounds.

The least bounds are those of `Interval` at 53 bits. A package that is absent has no row.
"""

from __future__ import annotations

import importlib
import operator
from collections.abc import Callable, Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from intervals import Interval, IntervalArray, TightArray
from proofs.benchmark.measure import Row, Tell, in_turn, ratio_row
from proofs.benchmark.page import Section
from proofs.benchmark.peers import installed

_LENGTHS = {"smallest": 300, "quick": 200_000, "full": 200_000}
_ROUNDS = {"smallest": 1, "quick": 5, "full": 15}
_SAMPLE = 300
_SIGNS = {"+": operator.add, "*": operator.mul, "/": operator.truediv}
NAMES = (*_SIGNS, "sqrt", "exp", "log", "sin", "tanh")


class Package(NamedTuple):
    """Arrays of a package: made from two ends, with functions by name, and their ends."""

    make: Callable[[Any, Any], Any]
    function: Callable[[str], Callable[[Any], Any]]
    ends: Callable[[Any], Any] = lambda x: (x.inf, x.sup)


def packages() -> dict[str, Package]:
    """Return those that are here, ours first."""
    ours = {
        kind.__name__: Package(kind.from_floats, _method) for kind in (IntervalArray, TightArray)
    }
    return ours | dict(_others())


def _others() -> Iterator[tuple[str, Package]]:
    if installed("ival"):
        crival = importlib.import_module("ival")
        yield "crival", Package(crival.Interval, lambda name: getattr(crival, name))
    if installed("pyintval"):  # one by one
        single = importlib.import_module("pyintval")
        yield (
            "pyintval",
            Package(
                np.frompyfunc(single.Interval, 2, 1),
                lambda name: np.frompyfunc(getattr(single, name), 1, 1),
                lambda x: np.array([(y.lo, y.hi) for y in x], dtype=float).T,
            ),
        )


def _method(name: str) -> Callable[[Any], Any]:
    return lambda x: getattr(x, name)()


def computed(package: Package, name: str, lower: Any, upper: Any) -> Callable[[], Any]:
    """Return what does an operation on the intervals, with themselves if it has two operands."""
    x = package.make(lower, upper)
    if sign := _SIGNS.get(name):
        return lambda: sign(x, x)
    function = package.function(name)
    return lambda: function(x)


def excess(package: Package, name: str, lower: Any, upper: Any) -> Any:
    """Return how many ulps each result has beyond the least bounds, on its worse side."""
    low, high = package.ends(computed(package, name, lower, upper)())
    ends = (map(Interval.from_float, x.tolist()) for x in (lower, upper))
    single = (a.hull(b) for a, b in zip(*ends, strict=True))
    least = [_SIGNS[name](x, x) if name in _SIGNS else getattr(x, name)() for x in single]
    best = np.array([[float(x.inf), float(x.sup)] for x in least]).T
    return np.maximum(*np.abs(np.array((low, high)) - best) / np.spacing(np.abs(best)))


def measure(mode: str, tell: Tell) -> Section:
    """Measure all, each beside the arrays of today's default."""
    tell("arrays")
    rng, count = np.random.default_rng(1), _LENGTHS[mode]
    lower = rng.uniform(0.05, 3, count)
    upper = lower * (1 + rng.random(count) * 1e-3)
    rows = chain.from_iterable(_rows(name, lower, upper, _ROUNDS[mode]) for name in NAMES)
    about = (
        f"{count} intervals, one call: how many times as long as an IntervalArray takes, and by "
        "how many ulps bounds are beyond the least there are, at most and on average. Where a "
        "package has 0 and an IntervalArray has not, the package is tighter."
    )
    return Section("Arrays beside other packages", about, list(rows))


def _rows(name: str, lower: Any, upper: Any, rounds: int) -> Iterator[Row]:
    every = packages()
    times = in_turn([computed(p, name, lower, upper) for p in every.values()], rounds)
    for (package, p), samples in zip(every.items(), times, strict=True):
        row = ratio_row(f"{name}: {package} / IntervalArray", samples, times[0])
        beyond = excess(p, name, lower[:_SAMPLE], upper[:_SAMPLE])
        row.measured += f"; {beyond.max():.0f} ulps, {beyond.mean():.2f} on average"
        row.samples["ulps"] = beyond.tolist()
        yield row
