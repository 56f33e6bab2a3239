"""Interval and short IntervalArrays beside python-flint and mpmath.iv: ratios in pairs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any, NamedTuple

from intervals import Interval
from intervals._engine import by_mpmath, fastest, use
from proofs.benchmark.measure import Row, Tell, in_turn, ratio_row
from proofs.benchmark.operations import ARRAY, operands, statement
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, IV, OURS, libraries

_ROUNDS = {"smallest": 1, "quick": 9, "full": 31}
_LENGTH = 300
_CALLS = 30  # of an array, whose first calls are the dearest


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
    known = operands(library, pair.bits, pair.length)
    lists = {name: known[name] for name in "xyu"}
    third = {name: x / 3 if library == ARRAY else [e / 3 for e in x] for name, x in lists.items()}
    given = [third]
    if library == FLINT and pair.at_ends:
        given = [
            {name: [getattr(ball, end)() for ball in x] for name, x in third.items()}
            for end in ("lower", "upper")
        ]
    code = compile(statement(pair.name, library), pair.name, "eval")
    scopes = [known | some for some in given]
    calls = _CALLS if pair.ours == ARRAY else 1

    def run() -> list[Any]:
        for _ in range(calls - 1):
            eval(code, scopes[0])
        return [eval(code, scope) for scope in scopes]

    return run
