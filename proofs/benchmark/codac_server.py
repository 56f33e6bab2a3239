"""codac in a process of its own, because importing it changes the rounding mode of the process.

Standard input: a job as JSON to be prepared, or the word run. Standard output, a line each: an
empty line once prepared, or the seconds an element; at first the version of codac.
"""

from __future__ import annotations

import json
import os
import sys
from importlib.metadata import version
from math import ldexp
from typing import Any

from proofs.benchmark.libraries import Job, Library, in_rows, one_by_one

_BITS = 53


def _library() -> Library:
    import codac  # type: ignore[import-not-found, unused-ignore]

    def interval(lower: int, upper: int) -> Any:
        return codac.Interval(ldexp(lower, 4 - _BITS), ldexp(upper, 4 - _BITS))

    def matrix(items: list[Any], side: int) -> Any:
        return codac.IntervalMatrix(in_rows(items, side))

    return Library(one_by_one(interval, codac.Interval), _BITS, vars(codac), matrix)


def main() -> None:
    """Serve until standard input ends."""
    replies = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints is no reply
    library = _library()
    print(version("codac"), file=replies, flush=True)
    for line in sys.stdin:
        request = json.loads(line)
        if isinstance(request, dict):
            sampler, reply = library.sampler(Job(**request["job"]), request["enough"]), ""
        else:
            reply = repr(sampler())
        print(reply, file=replies, flush=True)


if __name__ == "__main__":
    main()
