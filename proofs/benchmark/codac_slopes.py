"""codac at the slopes, in a process of its own, because it changes the rounding mode.

Standard input: a work and an order as JSON, a line each. Standard output, a line each: the bounds
of f', or why there are none; at first the version of codac.
"""

from __future__ import annotations

import json
import os
import sys
from dataclasses import asdict
from fractions import Fraction
from itertools import pairwise
from typing import Any

from intervals import Undecided
from proofs.benchmark.arithmetics import End, Jets
from proofs.benchmark.horseshoe_flint import ETA, NU
from proofs.benchmark.peers import Codac
from proofs.benchmark.slope_forms import Work, exclude, one_by_one
from proofs.motion.system import System
from proofs.trusted.numbers import Range


def slopes(server: Codac, work: Work, order: int) -> Range:
    """Have the work done; return bounds of f'. Floats travel as hexadecimals, in any rounding."""
    found = json.loads(server.ask([_written(asdict(work)), order]))
    if isinstance(found, str):
        raise Undecided(found)
    low, high = map(float.fromhex, found)
    return Fraction(low), Fraction(high)


def _written(given: Any) -> Any:
    """Replace numbers by texts."""
    if isinstance(given, dict):
        return {name: _written(one) for name, one in given.items()}
    if isinstance(given, (list, tuple)):
        return [_written(one) for one in given]
    return given.hex() if isinstance(given, float) else str(given)


def _read(given: Any) -> Any:
    """Replace texts by numbers."""
    return [_read(one) for one in given] if isinstance(given, list) else float.fromhex(given)


class _Numbers(Jets):
    """codac's Interval."""

    bits = 53

    def __init__(self) -> None:
        import codac  # type: ignore[import-not-found, unused-ignore]

        self._codac = codac
        codac.Interval.sincos = lambda x: (codac.sin(x), codac.cos(x))

    def number(self, low: End, high: End) -> Any:
        one, other = (
            self._codac.Interval(float(x.numerator)) / float(x.denominator)
            for x in (Fraction(low), Fraction(high))
        )
        return one | other

    def ends(self, x: Any) -> Range:
        return Fraction(x.lb()), Fraction(x.ub())

    def middle(self, x: Any) -> Any:
        return self._codac.Interval(x.mid())

    def hull(self, x: Any, y: Any) -> Any:
        return x | y

    def positive(self, x: Any) -> bool:
        return bool(x.lb() > 0)

    def exp(self, x: Any) -> Any:
        return self._codac.exp(x)

    def log(self, x: Any) -> Any:
        return self._codac.log(x)


def main() -> None:
    """Serve until standard input ends."""
    from importlib.metadata import version

    replies = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints is no reply
    of, system = _Numbers(), System(ETA, NU)
    print(version("codac"), file=replies, flush=True)
    for line in sys.stdin:
        given, order = json.loads(line)
        low, high = map(Fraction, given.pop("phases"))
        work = Work((low, high), **{name: _read(one) for name, one in given.items()})
        try:
            exclude(of, system, [of.number(*ends) for ends in pairwise(work.cuts)], work.grid)
            answer: Any = [float(end).hex() for end in one_by_one(of, of, system, work, order)]
        except Undecided as failure:
            answer = str(failure)
        print(json.dumps(answer), file=replies, flush=True)


if __name__ == "__main__":
    main()
