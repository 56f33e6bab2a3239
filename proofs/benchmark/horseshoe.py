"""Whole processes, cold: the main job against its limits, and the ledger."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from proofs.benchmark.measure import Row, Tell, ratio_row, spread
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, libraries
from proofs.shell.groups import row_of
from proofs.trusted.paper import GROUPS

CLAIMS = ("H1", "H2", "H3", "H4", "H5", "H6")  # that the script in flint decides too
_PAIRS = {"smallest": 1, "quick": 7, "full": 31}
# Started by a process as small as this one, a job's peak memory is its own.
_LAUNCHER = """
import json, os, sys, time
quiet = [(os.POSIX_SPAWN_OPEN, fd, os.devnull, os.O_WRONLY, 0) for fd in (1, 2)]
began = time.perf_counter()
command = [sys.executable, *sys.argv[1:]]
pid = os.posix_spawn(command[0], command, os.environ, file_actions=quiet)
_, status, usage = os.wait4(pid, 0)
seconds = time.perf_counter() - began
print(json.dumps([seconds, os.waitstatus_to_exitcode(status), usage.ru_maxrss]))
"""


class Process(NamedTuple):
    """What a whole process took."""

    seconds: float
    status: int
    megabytes: float


@contextmanager
def scratch() -> Iterator[Path]:
    """Yield a folder, in which processes write and find compiled bytecode meanwhile."""
    before = dict(os.environ)
    with TemporaryDirectory() as name:
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = f"{name}/cache"
        try:
            yield Path(name)
        finally:
            os.environ.clear()
            os.environ.update(before)


def process(arguments: Sequence[str]) -> Process:
    """Run python with these arguments; ChildProcessError if it fails."""
    command = [sys.executable, "-S", "-c", _LAUNCHER, *arguments]
    done = run_process(command, stdout=subprocess.PIPE)
    done.check_returncode()
    seconds, status, peak = json.loads(done.stdout)
    if status not in (0, 1):  # 1: a claim is undecided
        raise ChildProcessError(f"python {' '.join(arguments)}: exit status {status}")
    return Process(seconds, status, peak / (1 << 20 if sys.platform == "darwin" else 1 << 10))


def run_process(command: Sequence[str], **streams: Any) -> subprocess.CompletedProcess[bytes]:
    """Do as `subprocess.run`; where that is given up, the process ends at once with all of its own.

    It is in a session of its own, so that an interrupt from the keyboard does not reach it.
    """
    with subprocess.Popen(command, start_new_session=True, **streams) as process:
        try:
            out, err = process.communicate()
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def limits(mode: str, tell: Tell) -> Section:
    """Measure the main job beside the bare imports, and beside a script in python-flint."""
    tell("the main job")
    job = ["-m", "proofs.horseshoe", "--out"]
    with scratch() as folder:
        commands = {
            "plastic claims": [*job, str(folder), "--only", *CLAIMS],
            "main job": [*job, str(folder)],
            "import numpy, mpmath": ["-c", "import numpy, mpmath"],
        }
        script = "the same claims by a script in python-flint"
        if FLINT in libraries():
            commands[script] = ["-m", "proofs.benchmark.flint_job"]
        first = [process(command) for command in commands.values()]
        rounds = range(_PAIRS[mode])
        runs = [[process(command) for command in commands.values()] for _ in rounds]
    seconds = {name: [each[k].seconds for each in runs] for k, name in enumerate(commands)}
    rows = [
        Row(f"{name}, whole process [s]", spread(some), samples={"seconds": some})
        for name, some in seconds.items()
    ]
    rows.append(Row("main job, first run, everything compiled [s]", f"{first[1].seconds:.3g}"))
    plastic, main_job, bare, *flint = seconds.values()
    rows.append(ratio_row("plastic claims / import numpy, mpmath", plastic, bare, 2.5))
    rows.append(ratio_row("main job / import numpy, mpmath", main_job, bare, 2))
    if flint:
        rows.append(ratio_row(f"plastic claims / {script}", plastic, flint[0], 1.5))
    else:
        rows.append(Row(f"plastic claims / {script}", f"{FLINT} is absent", "<= 1.5"))
    memory = max(each[0].megabytes for each in runs)
    rows.append(Row("plastic claims, memory [MB]", f"{memory:.0f}", "< 120", memory < 120))
    about = (
        "Whole processes of `python -m proofs horseshoe` beside bare imports, and beside a plain "
        "script that decides the same claims in python-flint, without certificate, report or "
        "check. `python -X importtime` and cProfile tell where the time goes."
    )
    return Section("The main job", about, rows)


def ledger(mode: str, tell: Tell) -> Section:
    """Measure the whole ledger, made anew and with nothing changed, and 30 digits of H13."""
    tell("the ledger")
    papers = [claim for ids in GROUPS.values() for claim in ids if not row_of(claim).own]
    counts = {"smallest": 1, "quick": 1, "full": 3}
    with scratch() as folder:
        out = ["--out", str(folder / "ledger")]
        claims = ["-m", "proofs", "ledger", *out]
        digits = ["-m", "proofs", "dimension", "--only", "H13", "--digits", "30"]
        digits += ["--out", str(folder)]
        jobs: list[tuple[str, list[str], float]] = [
            ("the paper's claims, made anew", [*claims, "--fresh", "--only", *papers], 10),
            ("all claims, everything made anew", [*claims, "--fresh"], 10),
            ("all claims, nothing changed", claims, 2),
            ("two dimensions, 30 digits, found and checked", digits, 1),
        ]
        process(digits)
        rows = [_within(name, job, most, counts[mode]) for name, job, most in jobs]
    return Section("The ledger", "Whole processes, with the check of all certificates.", rows)


def _within(name: str, job: Sequence[str], most: float, runs: int) -> Row:
    seconds = [process(job).seconds for _ in range(runs)]
    row = Row(f"{name} [s]", spread(seconds), f"< {most:g}", median(seconds) < most)
    row.samples = {"seconds": seconds}
    return row
