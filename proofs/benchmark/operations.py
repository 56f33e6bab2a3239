"""Single operations of Interval and short IntervalArrays beside python-flint and mpmath.iv."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from random import Random
from typing import Any, NamedTuple

from intervals import Interval, IntervalArray
from intervals._engine import by_mpmath, fastest, use
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
    at_ends: bool = False  # they do it at both ends, each a point

    def __str__(self) -> str:
        size = f", length {self.length}" if self.ours == ARRAY else f", {self.bits} bits"
        theirs = f"{self.theirs} at both ends" if self.at_ends else self.theirs
        without = " without python-flint" if self.theirs == IV else ""
        return f"{self.name}{size}: {self.ours}{without} / {theirs}"


def _pairs() -> Iterator[_Pair]:
    # first without python-flint, which changes the slots of Interval when it comes to be used
    for name, bits in (("log", 333), ("hypot", 333), ("sin", 3333), ("hypot", 3333)):
        yield _Pair(OURS, IV, name, bits, 1.0, length=30)
    if FLINT in libraries():
        for name, share in {"+": 0.15, "sin": 0.06, "exp": 0.06, "log": 0.06}.items():
            yield _Pair(OURS, FLINT, name, 333, 1 / share)
        for name in ("exp", "log"):  # increasing: the ends' images are the image's ends
            yield _Pair(OURS, FLINT, name, 333, 1 / 0.4, at_ends=True)
        for name in ("+", "*", "sin", "exp"):
            for length in (1, 10, 100):
                yield _Pair(ARRAY, FLINT, name, 53, length=length)


def measure(mode: str, tell: Tell) -> Section:
    """Measure all pairs, python-flint computing for `Interval` but beside mpmath.iv."""
    tell("single operations")
    rows = [_row(pair, _ROUNDS[mode]) for pair in _pairs()]
    about = (
        "The same operation on the same operands, intervals 2^-6 / 3 wide with ends of full "
        "precision: how many times as long ours takes as one ball, or as the balls of both ends, "
        "or as mpmath.iv. Ours are two ends, each rounded to the precision, and one Python object."
    )
    return Section("Single operations", about, rows)


def _row(pair: _Pair, rounds: int) -> Row:
    with ExitStack() as stack:
        stack.enter_context(by_mpmath(Interval))
        if pair.theirs == FLINT:
            import flint

            stack.enter_context(flint.ctx.workprec(pair.bits))
            use(Interval, fastest(Interval))
        ours, theirs = (_task(pair, library) for library in pair[:2])
        above, below = in_turn([ours, theirs], rounds)
        return ratio_row(str(pair), above, below, pair.most)


def _task(pair: _Pair, library: str) -> Callable[[], list[Any]]:
    """Return what does the operation on all operands, often where they are few; what it returns is
    what it found, at both ends one after the other.
    """
    names = operands(library, pair.bits, pair.length)
    lists = {name: names[name] for name in "xy"}
    third = {name: x / 3 if library == ARRAY else [e / 3 for e in x] for name, x in lists.items()}
    given = [third]
    if library == FLINT and pair.at_ends:
        given = [
            {name: [getattr(ball, end)() for ball in x] for name, x in third.items()}
            for end in ("lower", "upper")
        ]
    code = compile(statement(pair.name, library), pair.name, "eval")
    scopes = [names | some for some in given]
    calls = _CALLS if pair.ours == ARRAY else 1

    def run() -> list[Any]:
        for _ in range(calls - 1):
            eval(code, scopes[0])
        return [eval(code, scope) for scope in scopes]

    return run
