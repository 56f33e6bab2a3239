"""What the arithmetic is compared with: python-flint and mpmath.iv here, codac beside."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from mpmath.ctx_iv import MPIntervalContext
from mpmath.libmp import from_man_exp

from proofs.benchmark.libraries import Job, Library, Sampler, in_rows, one_by_one

FLINT, IV, CODAC = "python-flint", "mpmath.iv", "codac"
_ROOT = Path(__file__).parents[2]


def has_flint() -> bool:
    """Whether python-flint is installed."""
    return importlib.util.find_spec("flint") is not None


@contextmanager
def at_precision(bits: int) -> Iterator[dict[str, Library]]:
    """Yield mpmath.iv, and python-flint if there is one, that work with `bits` bits meanwhile."""
    if not has_flint():
        yield {IV: _iv(bits)}
        return
    import flint

    with flint.ctx.workprec(bits):
        yield {FLINT: _flint(bits), IV: _iv(bits)}


def _flint(bits: int) -> Library:
    import flint

    arb = flint.arb

    def interval(lower: int, upper: int) -> Any:
        low, high = arb((lower, 4 - bits)), arb((upper, 4 - bits))
        return low if lower == upper else low.union(high)

    def matrix(items: list[Any], side: int) -> Any:
        return flint.arb_mat(in_rows(items, side))

    return Library(one_by_one(interval), bits, {"arb": arb}, matrix)


def _iv(bits: int) -> Library:
    context = MPIntervalContext()  # of its own: mpmath.iv itself keeps its precision
    context.prec = bits

    def interval(lower: int, upper: int) -> Any:
        return context.make_mpf(tuple(from_man_exp(m, 4 - bits) for m in (lower, upper)))

    def matrix(items: list[Any], side: int) -> Any:
        return context.matrix(in_rows(items, side))

    known = ("sqrt", "exp", "log", "sin", "cos", "cos_sin", "tan", "atan2", "fsum", "one")
    names = {name: getattr(context, name) for name in known}
    return Library(one_by_one(interval), bits, names, matrix)


class Codac:
    """A process that measures codac, of the given version."""

    def __init__(self, server: subprocess.Popen[str], version: str) -> None:
        self._server, self.version = server, version

    def sampler(self, job: Job, enough: float) -> Sampler:
        """Have the job prepared; return its measurement, valid until the next job."""
        self.ask({"job": asdict(job), "enough": enough})
        return lambda: float(self.ask("run"))

    def ask(self, request: Any) -> str:
        """Return the answer to a request; RuntimeError if there is none."""
        if self._server.stdin and self._server.stdout:
            print(json.dumps(request), file=self._server.stdin, flush=True)
            answer = self._server.stdout.readline()
            if answer:
                return answer
        raise RuntimeError(f"the process with codac failed at {request}")


@contextmanager
def codac(python: str, server_module: str = "codac_server") -> Iterator[Codac | None]:
    """Yield codac in a process of the interpreter `python`, None where that cannot import it."""
    path = os.pathsep.join(filter(None, (str(_ROOT), os.environ.get("PYTHONPATH"))))
    with subprocess.Popen(
        [python, "-m", f"proofs.benchmark.{server_module}"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
    ) as server:
        try:
            version = server.stdout.readline().strip() if server.stdout else ""
            yield Codac(server, version) if version else None
        finally:
            server.terminate()
