"""Single operations of Interval and short IntervalArrays beside python-flint and mpmath.iv."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import Any, NamedTuple

from intervals import IntervalArray
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
