"""Run coqc on the theory and on a case, and read what it prints."""

from __future__ import annotations

import errno
import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import monotonic, sleep
from typing import IO

from platformdirs import user_cache_path

THEORY = Path(__file__).parent / "theory"
NAME = "Oscillator"  # the logical name of the folder, in Coq
OPTIONS = ["-R", ".", NAME, "-w", "-ambiguous-paths"]
TESTED = "8.16"
GET = "apt-get install coq libcoq-interval libcoq-coquelicot"
_PARTS = ("Interval/Tactic.vo", "Coquelicot/Coquelicot.vo")
_HEADING = re.compile(r"^(?:Lemma|Theorem) (\w+)", re.MULTILINE)

REALS = frozenset(  # the axioms of the standard library's real numbers
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "Classical_Prop.classic",
        "FunctionalExtensionality.functional_extensionality_dep",
    }
)


class Missing(RuntimeError):
    """Coq, or a library of it, is not there, or older than the theory needs."""


class Ended(RuntimeError):
    """coqc was killed, or needs more memory or time than it has; nothing is known."""


class Refused(RuntimeError):
    """coqc does not accept a file: where it stops, and what it says."""

    def __init__(self, module: str, lemma: str, message: str) -> None:
        super().__init__(f"{module}.v: {lemma}: {message}")
        self.lemma = lemma


@dataclass(frozen=True)
class Accepted:
    """A file that coqc accepts: its output, and the kilobytes that it takes."""

    output: str
    memory: int


def required(text: str) -> list[str]:
    """Return the modules of the theory that a file requires."""
    lists = re.findall(rf"^From {NAME} Require (?:Import|Export) ([\w\s]+)\.", text, re.MULTILINE)
    return [name for names in lists for name in names.split()]


def order(text: str) -> list[str]:
    """Return the modules that a file needs, each after what it requires."""
    ordered: list[str] = []
    for name in required(text):
        before = order((THEORY / f"{name}.v").read_text())
        ordered += [each for each in [*before, name] if each not in ordered]
    return ordered


@cache
def _installed() -> bytes:
    """Return a digest of the installed Coq; raise Missing where it, or a part, is not enough."""
    if shutil.which("coqc") is None:
        raise Missing(f"coqc is missing: {GET}")
    version, where = (
        subprocess.run(["coqc", asked], capture_output=True, text=True, check=False).stdout.strip()
        for asked in ("--print-version", "-where")
    )
    found = re.match(r"(\d+)\.(\d+)", version)
    if found is None or (int(found[1]), int(found[2])) < tuple(map(int, TESTED.split("."))):
        raise Missing(f"coqc {version or 'of an unknown version'} is older than {TESTED}: {GET}")
    digest = hashlib.sha256(version.encode())
    for part in _PARTS:
        path = Path(where, "user-contrib", part)
        if not path.is_file():
            raise Missing(f"coqc has no library {part.partition('/')[0]}: {GET}")
        digest.update(path.read_bytes())
    return digest.digest()


def theory(modules: list[str], tell: Callable[[str], None]) -> Path:
    """Return a folder of the user's cache that has these modules compiled, each made once.

    Its name is a digest of the installed Coq and of the theory; who comes second waits.
    """
    digest = hashlib.sha256(_installed())
    for path in sorted(THEORY.glob("*.v")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    place = Path(user_cache_path("impact-proofs"), "coq", digest.hexdigest()[:40])
    place.mkdir(parents=True, exist_ok=True)
    with (place / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for name in modules:
            if not (place / f"{name}.vo").exists():
                tell(f"coqc {name}.v, theory")
                _compile(name, place)
    return place


def _compile(module: str, place: Path) -> None:
    """Compile a module after those it requires, which are there; leave nothing half made."""
    with tempfile.TemporaryDirectory(dir=place) as folder:
        new = Path(folder)
        copy(THEORY, new, [module], ".v")
        copy(place, new, order((new / f"{module}.v").read_text()), ".vo")
        run(new, module)
        for ending in (".v", ".vo"):
            (new / f"{module}{ending}").replace(place / f"{module}{ending}")


def copy(source: Path, target: Path, modules: list[str], *endings: str) -> None:
    """Copy modules of the theory from a folder to another."""
    for name in modules:
        for ending in endings:
            shutil.copyfile(source / f"{name}{ending}", target / f"{name}{ending}")


def run(
    folder: Path,
    module: str,
    seconds: float = float("inf"),
    tell: Callable[[str], None] = lambda lemma: None,
) -> Accepted:
    """Compile one file of a folder, after those it requires; tell the lemma that is at work.

    Raises Missing, Ended or Refused, and OSError where the disk is full.
    """
    _installed()
    text, began, pause = (folder / f"{module}.v").read_text(), monotonic(), 0.01
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        command = ["coqc", "-time", *OPTIONS, f"{module}.v"]
        process = subprocess.Popen(command, cwd=folder, stdout=output, stderr=errors)
        try:
            while True:
                done, status, usage = os.wait4(process.pid, os.WNOHANG)
                if done:
                    break
                lemma = _at_work(text, _read(output))
                tell(lemma)
                if monotonic() - began > seconds:
                    raise Ended(f"coqc is not done in {seconds:g} s: it was at {lemma}")
                sleep(pause := min(0.2, pause * 1.5))
            process.returncode = os.waitstatus_to_exitcode(status)
        except BaseException:
            process.kill()
            process.wait()
            raise
        said, wrong = _read(output), _read(errors)
    if process.returncode:
        raise _failure(text, module, process.returncode, said, wrong)
    return Accepted(said, usage.ru_maxrss)


def _read(file: IO[str]) -> str:
    """Return what is in a file that another process writes, whose offset is shared: leave it."""
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode(errors="replace")


def _at_work(text: str, output: str) -> str:
    """Return the lemma after the last sentence that is done."""
    ends = re.findall(r"^Chars \d+ - (\d+) ", output, re.MULTILINE)
    end = int(ends[-1]) if ends else 0
    end += len(text[end:]) - len(text[end:].lstrip()) + 1
    names = [found[1] for found in _HEADING.finditer(text) if found.start() < end]
    return names[-1] if names else "its head"


def _failure(text: str, module: str, status: int, output: str, errors: str) -> Exception:
    """Return what the errors of coqc mean."""
    found = re.search(r'File ".*", line (\d+), characters .*\n((?:.*\n)*)', errors)
    message = " ".join((found[2] if found else errors).split())[:300]
    lemma = _at_work(text, output)
    if status < 0 or re.search("out of memory|Stack overflow", message, re.IGNORECASE):
        why = message or f"killed by signal {-status}"
        return Ended(f"coqc ended at {lemma} of {module}.v: {why}")
    if "No space left on device" in errors:
        return OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), f"{module}.v")
    if "Cannot find a physical path" in message or "Unable to locate library" in message:
        return Missing(f"a part of Coq is missing: {GET} ({message})")
    if found is None:
        return Missing(f"coqc does not run as it did in {TESTED}: {message}")
    before = "\n".join(text.splitlines()[: int(found[1])])
    return Refused(module, next(reversed(_HEADING.findall(before)), "its head"), message)


def axioms(output: str) -> list[str]:
    """Return what `Print Assumptions` lists: axioms, and definitions that escape a check."""
    _, _, listed = output.partition("\nAxioms:\n")
    words = [line.split()[0] for line in listed.splitlines() if line[:1].strip()]
    return [word for word in words if word != "Chars"]  # that line tells the time taken


def seconds(text: str, output: str, names: list[str]) -> dict[str, float]:
    """Return for each theorem the seconds since the one before, its lemmas counted."""
    taken = [
        (int(start), float(time))
        for start, time in re.findall(
            r"^Chars (\d+) - \d+ .*?\] ([\d.]+) secs", output, re.MULTILINE
        )
    ]
    result, begin = {}, 0
    for name in names:
        end = text.index("Qed.", text.index(f"Theorem {name} ")) + len("Qed.")
        result[name] = sum(time for start, time in taken if begin <= start < end)
        begin = end
    return result


def statements(text: str, names: list[str]) -> Callable[[str], str]:
    """Return what gives a theorem's statement, as it is written."""
    found = {name: text[text.index(f"Theorem {name} ") :] for name in names}
    return lambda name: " ".join(found[name].partition("\nProof.")[0].split())
