"""codac in a process of its own, because importing it changes the rounding mode of the process.

Each work travels as a pickle, in which floats are exact in any rounding mode.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import IO, Any

from intervals import Undecided
from proofs.benchmark.peers import CODAC, Range, arithmetic
from proofs.benchmark.slopes import Work, bounds

_ROOT = str(Path(__file__).parents[2])
Bounds = Callable[[Work, int], Range]


@contextmanager
def codac(python: str) -> Iterator[tuple[str, Bounds] | None]:
    """Yield codac's version, and its `bounds`, by the interpreter `python`; None if it has none."""
    path = os.pathsep.join(filter(None, (_ROOT, os.environ.get("PYTHONPATH"))))
    server = subprocess.Popen(
        [python, "-m", "proofs.benchmark.codac_server"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": path},
    )
    requests: Any = server.stdin
    replies: Any = server.stdout

    def ask(work: Work, order: int) -> Range:
        _send((work, order), requests)
        reply: Range | str = pickle.load(replies)
        if isinstance(reply, str):
            raise Undecided(reply)
        return reply

    with server:
        try:
            yield pickle.load(replies), ask
        except EOFError:
            yield None
        finally:
            server.terminate()


def _send(message: object, where: IO[bytes]) -> None:
    pickle.dump(message, where)
    where.flush()


def main() -> None:
    """Serve until standard input ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no reply
    of = arithmetic(CODAC, 53)
    _send(version(CODAC), replies)
    while True:
        work, order = pickle.load(sys.stdin.buffer)
        try:
            _send(bounds(of, of, work, order), replies)
        except Undecided as failure:
            _send(str(failure), replies)


if __name__ == "__main__":
    main()
