"""Single operations and arrays, beside python-flint, mpmath.iv and other packages of arrays.

The least bounds are those of `Interval` at 53 bits. A package that is absent has no row.
"""

from __future__ import annotations

import importlib
import operator
from collections.abc import Callable, Iterator
from itertools import chain
from random import Random
from typing import Any, NamedTuple

import numpy as np

from intervals import Interval, IntervalArray, TightArray
from proofs.benchmark.measure import Row, Tell, in_turn, ratio_row
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, IV, OURS, arithmetic, installed, libraries

ARRAY = "IntervalArray"
_ROUNDS = {"smallest": 1, "quick": 9, "full": 31}
_LENGTH = 300
_CALLS = 30  # of an array, whose first calls are the dearest
_TEXTS = {  # x in [-10, 10], y in [1, 4]
    **{"+": "x + y", "*": "x * y", "hypot": "x.hypot(y)"},
    **{"sin": "x.sin()", "exp": "x.exp()", "log": "y.log()"},
}
_IV = {"hypot": "sqrt(x * x + y * y)", "sin": "sin(x)", "exp": "exp(x)", "log": "log(y)"}


def statement(name: str, library: str) -> str:
    """Return what a library does with its x and y, lists or an array each."""
    text = _IV.get(name, _TEXTS[name]) if library == IV else _TEXTS[name]
    return text if library == ARRAY else f"[{text} for x, y in zip(x, y)]"


def operands(library: str, bits: int, length: int) -> dict[str, Any]:
    """Return so many intervals for x and y, the same in all libraries, and their functions."""
    random, width = Random(length), 2.0**-6
    lower, upper = dict[str, list[float]](), dict[str, list[float]]()
    for name, ends in {"x": (-10, 10 - width), "y": (1, 4)}.items():
        lower[name] = [random.uniform(*ends) for _ in range(length)]
        upper[name] = [x + width * random.random() for x in lower[name]]
    if library == ARRAY:
        return {name: IntervalArray.from_floats(lower[name], upper[name]) for name in lower}
    of, functions = arithmetic(library, bits), dict[str, Any]()
    if library == FLINT:
        import flint

        flint.ctx.prec = bits
    elif library == IV:
        functions = {name: getattr(of.point(1).ctx, name) for name in ("sqrt", "sin", "exp", "log")}
    return functions | {name: list(map(of.number, lower[name], upper[name])) for name in lower}


class _Pair(NamedTuple):
    """One operation by two libraries, and how many times as long as theirs ours should take."""

    ours: str
    theirs: str
    name: str
    bits: int
    most: float | None = None
    length: int = _LENGTH

    def __str__(self) -> str:
        size = f", length {self.length}" if self.ours == ARRAY else f", {self.bits} bits"
        return f"{self.name}{size}: {self.ours} / {self.theirs}"


def _pairs() -> Iterator[_Pair]:
    for name, bits in (("log", 333), ("hypot", 333), ("sin", 3333), ("hypot", 3333)):
        yield _Pair(OURS, IV, name, bits, 1.0, length=30)
    if FLINT in libraries():
        for name in ("+", "*", "sin", "exp"):
            for length in (1, 10, 100):
                yield _Pair(ARRAY, FLINT, name, 53, length=length)


def measure(mode: str, tell: Tell) -> Section:
    """Measure all pairs."""
    tell("single operations")
    rows = [_row(pair, _ROUNDS[mode]) for pair in _pairs()]
    about = (
        "The same operation on the same operands, intervals 2^-6 / 3 wide with ends of full "
        "precision: how many times as long ours takes as mpmath.iv, or as one ball of python-flint."
    )
    return Section("Single operations", about, rows)


def _row(pair: _Pair, rounds: int) -> Row:
    ours, theirs = (_task(pair, library) for library in pair[:2])
    above, below = in_turn([ours, theirs], rounds)
    return ratio_row(str(pair), above, below, pair.most)


def _task(pair: _Pair, library: str) -> Callable[[], Any]:
    """Return what does the operation on all operands, often where they are few."""
    names = operands(library, pair.bits, pair.length)
    scope = names | {
        name: x / 3 if library == ARRAY else [each / 3 for each in x]
        for name, x in names.items()
        if name in ("x", "y")
    }
    code = compile(statement(pair.name, library), pair.name, "eval")
    calls = _CALLS if pair.ours == ARRAY else 1

    def run() -> Any:
        for _ in range(calls - 1):
            eval(code, scope)
        return eval(code, scope)

    return run


_LENGTHS = {"smallest": 300, "quick": 200_000, "full": 200_000}
_ARRAY_ROUNDS = {"smallest": 1, "quick": 5, "full": 15}
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


def measure_arrays(mode: str, tell: Tell) -> Section:
    """Measure all, each beside the arrays of today's default."""
    tell("arrays")
    rng, count = np.random.default_rng(1), _LENGTHS[mode]
    lower = rng.uniform(0.05, 3, count)
    upper = lower * (1 + rng.random(count) * 1e-3)
    rows = chain.from_iterable(
        _array_rows(name, lower, upper, _ARRAY_ROUNDS[mode]) for name in NAMES
    )
    about = (
        f"{count} intervals, one call: how many times as long as an IntervalArray takes, and by "
        "how many ulps bounds are beyond the least there are, at most and on average. Where a "
        "package has 0 and an IntervalArray has not, the package is tighter."
    )
    return Section("Arrays beside other packages", about, list(rows))


def _array_rows(name: str, lower: Any, upper: Any, rounds: int) -> Iterator[Row]:
    every = packages()
    times = in_turn([computed(p, name, lower, upper) for p in every.values()], rounds)
    for (package, p), samples in zip(every.items(), times, strict=True):
        row = ratio_row(f"{name}: {package} / IntervalArray", samples, times[0])
        beyond = excess(p, name, lower[:_SAMPLE], upper[:_SAMPLE])
        row.measured += f"; {beyond.max():.0f} ulps, {beyond.mean():.2f} on average"
        row.samples["ulps"] = beyond.tolist()
        yield row
