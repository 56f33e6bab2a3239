"""Single operations beside python-flint and mpmath.iv; arrays, and how wide their results are.

The least bounds are those of `Interval` at 53 bits. A package that is absent has no row.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from itertools import chain
from random import Random
from typing import Any, NamedTuple

import numpy as np

from intervals import Interval, IntervalArray, TightArray
from proofs.benchmark.measure import Row, Tell, in_turn, ratio_row
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, IV, OURS, arithmetic, libraries

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
    number, functions = arithmetic(library, bits).number, dict[str, Any]()
    if library == FLINT:
        import flint

        flint.ctx.prec = bits
    elif library == IV:
        functions = {x: getattr(number(1, 1).ctx, x) for x in ("sqrt", "sin", "exp", "log")}
    return functions | {name: list(map(number, lower[name], upper[name])) for name in lower}


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
KINDS = (IntervalArray, TightArray)


def computed(kind: type[IntervalArray], name: str, lower: Any, upper: Any) -> Callable[[], Any]:
    """Return what does an operation on the intervals, with themselves if it has two operands."""
    x = kind.from_floats(lower, upper)
    if sign := _SIGNS.get(name):
        return lambda: sign(x, x)
    function: Callable[[], Any] = getattr(x, name)
    return function


def excess(done: IntervalArray, name: str, lower: Any, upper: Any) -> Any:
    """Return how many ulps each result has beyond the least bounds, on its worse side."""
    ends = (map(Interval.from_float, x.tolist()) for x in (lower, upper))
    single = (a.hull(b) for a, b in zip(*ends, strict=True))
    least = [_SIGNS[name](x, x) if name in _SIGNS else getattr(x, name)() for x in single]
    best = np.array([[float(x.inf), float(x.sup)] for x in least]).T
    return np.maximum(*np.abs(np.array((done.inf, done.sup)) - best) / np.spacing(np.abs(best)))


def measure_arrays(mode: str, tell: Tell) -> Section:
    """Measure both kinds of arrays, each beside today's default."""
    tell("arrays")
    rng, count = np.random.default_rng(1), _LENGTHS[mode]
    lower = rng.uniform(0.05, 3, count)
    upper = lower * (1 + rng.random(count) * 1e-3)
    rows = chain.from_iterable(
        _array_rows(name, lower, upper, _ARRAY_ROUNDS[mode]) for name in NAMES
    )
    about = (
        f"{count} intervals, one call: how many times as long as an IntervalArray takes, and by "
        "how many ulps bounds are beyond the least there are, at most and on average."
    )
    return Section("Arrays", about, list(rows))


def _array_rows(name: str, lower: Any, upper: Any, rounds: int) -> Iterator[Row]:
    times = in_turn([computed(kind, name, lower, upper) for kind in KINDS], rounds)
    for kind, samples in zip(KINDS, times, strict=True):
        row = ratio_row(f"{name}: {kind.__name__} / IntervalArray", samples, times[0])
        first = lower[:_SAMPLE], upper[:_SAMPLE]
        beyond = excess(computed(kind, name, *first)(), name, *first)
        row.measured += f"; {beyond.max():.0f} ulps, {beyond.mean():.2f} on average"
        row.samples["ulps"] = beyond.tolist()
        yield row
