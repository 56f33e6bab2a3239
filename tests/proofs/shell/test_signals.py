"""Interrupts, closed pipes, full disks: a line at most, the status that is due, nothing half."""

import os
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

import pytest

from proofs.shell.groups import FILES
from tests.proofs.shell.processes import (
    COMMANDS,
    LENGTHY,
    WRITES,
    arguments_of,
    children,
    started,
    wait_until_it_listens,
)

pytestmark = pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="needs /proc")
STOPS = {signal.SIGINT: (130, "interrupted"), signal.SIGTERM: (143, "terminated")}


def stopped(name, folder, number, after, everyone=True):
    """What becomes of a command that is stopped so long after it listens."""
    arguments = arguments_of(name, folder, LENGTHY)
    arguments += ["--out", str(folder)] if name == "__main__" else []
    with started(name, arguments) as process:
        wait_until_it_listens(process)
        sleep(after)
        began = monotonic()
        with suppress(ProcessLookupError):  # it was done before
            (os.killpg if everyone else os.kill)(process.pid, number)
        try:
            _, err = process.communicate(timeout=20)
            took = monotonic() - began
            left = children(process)
        finally:
            if children(process):  # a failing test is to leave nothing behind
                os.killpg(process.pid, signal.SIGKILL)
    return process.returncode, err.decode(), took, left


def check_stop(name, folder, number, after, everyone=True):
    status, err, took, left = stopped(name, folder, number, after, everyone)
    if status in (0, 1) and not err:  # it was done before; 1: something undecided, a target missed
        return False
    code, word = STOPS[number]
    assert (status, err) == (code, f"python -m proofs: {word}\n"), (name, status, err)
    assert took < 2 and not left, (name, took, left)
    assert not list(folder.glob(".*"))
    return True


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_an_interrupt_while_it_begins(name, tmp_path):
    """Before its own imports are done, at times."""
    check_stop(name, tmp_path, signal.SIGINT, 0.02 * (COMMANDS.index(name) % 5))


@pytest.mark.slow
@pytest.mark.parametrize("number", STOPS, ids=["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("everyone", [True, False], ids=["its group", "itself alone"])
def test_workers_end_with_the_ledger(number, everyone, tmp_path):
    assert check_stop("ledger", tmp_path, number, 1.0, everyone)


@pytest.mark.long
@pytest.mark.parametrize("after", [0.0, 0.1, 0.3, 1.0, 2.5])
@pytest.mark.parametrize("number", STOPS, ids=["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("name", COMMANDS)
def test_a_signal_at_any_time(name, number, after, tmp_path):
    ended = check_stop(name, tmp_path, number, after)
    assert ended or name not in LENGTHY or after > 0.3
    check_stop(name, tmp_path, number, after, everyone=False)


FORKED = """
import os, signal, sys, time
from proofs.shell.entry import guarded

def work():
    child = os.fork()
    if child == 0:
        time.sleep(20)
        os._exit(1)
    time.sleep(0.2)
    os.kill(child, signal.SIGINT)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) - 100

sys.exit(guarded("it", work))
"""


def test_a_forked_process_ends_silently():
    """Also before it has set up anything of its own."""
    done = subprocess.run([sys.executable, "-c", FORKED], capture_output=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (30, b"", b"")


SWALLOWED = """
import os, signal, sys, time
from proofs.shell.entry import guarded

class Deaf:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.01)

def work():
    if sys.argv[1] == "finalised":
        Deaf()
    else:
        try:
            os.kill(os.getpid(), signal.SIGTERM)
        except KeyboardInterrupt:
            raise ImportError("as C code makes of it")
    time.sleep(5)
    return 0

sys.exit(guarded("it", work))
"""


@pytest.mark.parametrize(
    "where, ended",
    [("finalised", (130, b"it: interrupted\n")), ("in C", (143, b"it: terminated\n"))],
)
def test_a_signal_is_not_lost(where, ended):
    done = subprocess.run(
        [sys.executable, "-c", SWALLOWED, where], capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == ended


def test_what_is_ignored_stays_ignored():
    """As in a background job of a shell without job control."""
    code = "import signal, subprocess, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); "
    code += "ask = ['single_impact', '--eta', '0.237', '--nu', '0.3', '--quiet']; "
    code += "sys.exit(subprocess.call([sys.executable, '-m', 'proofs', *ask]))"
    process = subprocess.Popen([sys.executable, "-c", code], start_new_session=True, stdout=-3)
    sleep(0.3)
    os.killpg(process.pid, signal.SIGINT)
    assert process.wait(30) == 0


# -- pipes -----------------------------------------------------------------------------------------


def without_reader(name, arguments):
    """A command's status and errors where nobody reads what it prints."""
    ours, theirs = os.pipe()
    os.close(ours)
    with started(name, arguments, stdout=theirs) as process:
        os.close(theirs)
        _, err = process.communicate(timeout=60)
    return process.returncode, err.decode()


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_a_closed_pipe_is_quiet(name, tmp_path):
    assert without_reader(name, ["--help"]) == (141, "")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["check", "horseshoe", "orbits"])
def test_a_closed_pipe_is_quiet_after_work_as_well(name, tmp_path):
    assert without_reader(name, arguments_of(name, tmp_path)) == (141, "")


@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_a_closed_pipe_is_quiet_whatever_is_printed(name, tmp_path):
    assert without_reader(name, arguments_of(name, tmp_path)) == (141, "")


# -- full disks ------------------------------------------------------------------------------------

FULL = Path("/dev/full")
needs_full = pytest.mark.skipif(not FULL.exists(), reason="needs /dev/full")


def on_full_disk(name, arguments):
    """A command's status and errors where standard output takes nothing."""
    with FULL.open("w") as full, started(name, arguments, stdout=full) as process:
        _, err = process.communicate(timeout=60)
    return process.returncode, err.decode()


@pytest.mark.slow
@needs_full
@pytest.mark.parametrize("name", ["check", "horseshoe", "orbits", "stress"])
def test_a_full_disk_is_a_line(name, tmp_path):
    line = "python -m proofs: No space left on device\n"
    assert on_full_disk(name, arguments_of(name, tmp_path)) == (2, line)


@needs_full
@pytest.mark.long
@pytest.mark.parametrize("name", COMMANDS)
def test_a_full_disk_is_a_line_whatever_is_printed(name, tmp_path):
    line = "python -m proofs: No space left on device\n"
    assert on_full_disk(name, arguments_of(name, tmp_path)) == (2, line)


@pytest.fixture
def small_disk(tmp_path):
    """A folder with room for 16 kB, an older certificate in it."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(folder)]
    if os.geteuid() or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("nobody but root may mount a small disk")
    try:
        (folder / "horseshoe.json").write_text("old")
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_disk_that_is_full_in_the_end_keeps_what_was_there(small_disk):
    with started("horseshoe", ["--only", "H1", "H5", "--out", str(small_disk)]) as process:
        out, err = process.communicate(timeout=60)
    assert process.returncode == 2 and out == b"" and err.count(b"\n") == 1
    assert b"cannot write" in err and b"No space left on device" in err
    assert [path.name for path in small_disk.iterdir()] == ["horseshoe.json"]
    assert (small_disk / "horseshoe.json").read_text() == "old"


@pytest.mark.long
@pytest.mark.parametrize("name", sorted(WRITES))
def test_every_command_keeps_what_was_there(name, small_disk):
    (small_disk / "filler").write_text("x" * 12_000)
    claim = FILES[name][name][0] if name in FILES else "H1"
    with started(name, ["--only", claim, "--out", str(small_disk)]) as process:
        _, err = process.communicate(timeout=300)
    assert process.returncode == 2 and err.count(b"\n") == 1, err
    assert {path.name for path in small_disk.iterdir()} <= {"horseshoe.json", "filler"}
