"""Commands as processes: with a signal, without a reader, on a full disk, on a terminal."""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
from pathlib import Path
from time import monotonic, sleep

from proofs.__main__ import commands
from proofs.shell.entry import guarded

ROOT = Path(__file__).parents[3]
COMMANDS = [*commands(), "__main__"]
AT = ["--eta", "0.2121", "--nu", "-0.2"]
UNSET = ("COLUMNS", "NO_COLOR", "PYTHONUNBUFFERED")  # output is buffered, as usual
QUICK = {  # arguments with which a command prints something soon; another one prints its help
    "__main__": [],
    "chaos": ["--only", "G5"],
    "check": ["tests/certificates/horseshoe.json"],
    "circle": ["--only", "G2"],
    "foundations": ["--only", "M2", "M7"],
    "horseshoe": ["--only", "H1", "N1"],
    "impact": [*AT, "--phi", "1.11"],
    "ledger": ["--only", "H16", "S22"],
    "nonplastic": ["--only", "N1", "N2"],
    "orbits": ["--word", "01"],
    "entropy": ["--only", "H18"],
    "persistence": ["--only", "G8"],
    "resonance": ["--only", "R1"],
    "sets": ["--only", "H12"],
    "single": ["--only", "P1"],
    "single_impact": [*AT, "--n", "4"],
    "soft": ["--only", "S17"],
    "stress": ["--cases", "20"],
}
LENGTHY = {  # that take seconds, some in processes of their own
    "__main__": ["--fresh"],
    "benchmark": ["limit"],
    "check": ["reports/ledger.json"],
    "dimension": ["--digits", "500"],
    "circle": [],
    "foundations": [],
    "horseshoe": ["--digits", "900"],
    "impact": [*AT, "--phi", "1.11", "1.15", "--digits", "1000"],
    "ledger": ["--fresh"],
    "nonplastic": [],
    "orbits": ["--period", "16"],
    "soft": [],
    "stress": ["--cases", "100000"],
}
WRITES = {*COMMANDS} - {"benchmark", "check", "__main__", "stress"}
WRITES -= {"atlas", "impact", "orbits", "single_impact"}


def started(name, arguments, **streams):
    """A process of a command, at the root of the project, in a group of its own."""
    environment = {k: v for k, v in os.environ.items() if k not in UNSET}
    return subprocess.Popen(
        [sys.executable, "-m", "proofs", *([] if name == "__main__" else [name]), *arguments],
        **{"cwd": ROOT, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams},
        env=environment | {"TERM": "xterm-256color"},
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # noqa: PLW1509
    )


def guarded_here(work):
    """The status of some work as a command's, in this process; its signals are left as they were.

    Else they would be ignored from then on, also by the processes that later tests start.
    """
    before = {x: signal.getsignal(x) for x in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM)}
    report = sys.unraisablehook
    try:
        return guarded("python -m proofs", work)
    finally:
        sys.unraisablehook = report
        for number, handler in before.items():
            signal.signal(number, handler)


def arguments_of(name, folder, table=QUICK):
    """Quick arguments, results going to a folder."""
    arguments = table.get(name, QUICK.get(name, ["--help"]))
    writes = name in WRITES and name in {*QUICK, *table} and "--help" not in arguments
    return [*arguments, *(["--out", str(folder)] if writes else [])]


def wait_until_it_listens(process):
    """Wait until a process catches SIGTERM, as commands do from their first line on."""
    bit, began = 1 << (signal.SIGTERM - 1), monotonic()
    while process.poll() is None and monotonic() - began < 30:
        status = Path(f"/proc/{process.pid}/status").read_text()
        if int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16) & bit:
            return
        sleep(0.005)


def children(process):
    """The processes of a group that are alive, zombies aside."""
    alive = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, group = path.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(group) == process.pid and state != "Z":
            alive.append(path.parent.name)
    return alive


def on_terminal(name, arguments, width):
    """The status and what is shown on a terminal of that width, as lines without escapes."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 50, width, 0, 0))
    process = started(name, arguments, stdin=theirs, stdout=theirs, stderr=theirs)
    os.close(theirs)
    said = b""
    while select.select([ours], [], [], 120)[0]:
        try:
            said += os.read(ours, 1 << 16)
        except OSError:  # the other end is closed
            break
    os.close(ours)
    text = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", said.decode())
    return (
        process.wait(10),
        [line.rpartition("\r")[2] for line in text.split("\r\n")],
        said.decode(),
    )
