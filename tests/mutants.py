"""Mistakes made on purpose in the trusted part: which do the tests see? `python -m tests.mutants`.

`mutants.txt` is the list. Each mutant is made in a copy of the tree, and the tests that should see
it run there: first their quick tier, then, if that saw nothing, all but the long ones. Words after
the command choose mutants by parts of their file's name or of what is wrong; --quick leaves it at
the quick tier. Status 1 if a mutant survives, or is none any more.
"""

import argparse
import os
import shutil
import subprocess
import sys
from collections import Counter
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
QUICK, ALL = "not slow", "not long"
FAILED, NO_TESTS = (1, 2), 5  # statuses of pytest; 2: modules that cannot be imported
LONGEST = 1800  # seconds: a mutant that does not end is seen
_TIMES = count(1_000_000_000)  # of files, each another: else Python takes an old compiled one


class Mutant(NamedTuple):
    """A mistake: what is wrong, in which file, and what tests should see it."""

    wrong: str
    path: str
    tests: tuple[str, ...]
    old: str
    new: str

    @property
    def told(self):
        """Where it is, and what is wrong."""
        return f"{self.path.removeprefix('proofs/trusted/')}: {self.wrong}"

    @property
    def applies(self):
        """Whether the old text is in the file, exactly once."""
        path = ROOT / self.path
        return path.is_file() and path.read_text(encoding="utf-8").count(self.old) == 1


def mutants():
    """The mutants, in the order of the list."""
    listed, path, tests = [], "", ()
    for line in (ROOT / "tests" / "mutants.txt").read_text(encoding="utf-8").splitlines():
        mark, _, rest = line.partition(" ")
        if mark == "==":
            name, *tests = rest.replace(":", "").split()
            path = f"proofs/trusted/{name}.py"
            tests = [f"tests/proofs/trusted/{test}.py" for test in tests]
        elif mark == "--":
            listed.append(Mutant(rest, path, tuple(tests), "", ""))
        elif listed and mark in ("-", "+"):
            name = "old" if mark == "-" else "new"
            before = getattr(listed[-1], name)
            listed[-1] = listed[-1]._replace(**{name: f"{before}\n{rest}" if before else rest})
    return listed


def copied(folder):
    """Copy the tree, as it stands, without what git does not know."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    for name in done.stdout.splitlines():
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    return folder


def fails(folder, tests, marks):
    """Whether a test fails in a copy of the tree."""
    shutil.rmtree(folder / ".hypothesis", ignore_errors=True)  # what other mutants have taught
    command = [sys.executable, "-m", "pytest", "-x", "-m", marks, "--hypothesis-seed=0", *tests]
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("PYTEST", "TESTS"))}
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, check=False, timeout=LONGEST
        )
    except subprocess.TimeoutExpired:
        return True
    if done.returncode not in (0, *FAILED, NO_TESTS):
        raise RuntimeError(f"{tests}: {(done.stdout + done.stderr)[-500:].decode()}")
    return done.returncode in FAILED


def seen_by(mutant, folder, tiers):
    """The tier that sees a mutant: its marks; "" if none does."""
    path = folder / mutant.path
    source = path.read_text(encoding="utf-8")
    _write(path, source.replace(mutant.old, mutant.new))
    try:
        return next((marks for marks in tiers if fails(folder, mutant.tests, marks)), "")
    finally:
        _write(path, source)


def _write(path, text):
    path.write_text(text, encoding="utf-8")
    when = next(_TIMES)
    os.utime(path, (when, when))


def main(arguments=None):
    """Try the mutants that are asked for; print how each ends, and the counts."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args(arguments)
    tiers = (QUICK,) if options.quick else (QUICK, ALL)
    asked = [x for x in mutants() if not options.words or any(map(x.told.count, options.words))]
    ends = Counter()
    with TemporaryDirectory() as place:
        folder = copied(Path(place))
        for marks in tiers:
            if fails(folder, {test for each in asked for test in each.tests}, marks):
                raise RuntimeError(f"a test fails without any mutant: {marks}")
        for mutant in asked:
            marks = seen_by(mutant, folder, tiers) if mutant.applies else None
            end = {None: "NO LONGER THERE", "": "SURVIVES", QUICK: "quick", ALL: "slow"}[marks]
            ends[end] += 1
            print(f"{end:16} {mutant.told}", flush=True)
    print(", ".join(f"{number} {end}" for end, number in ends.items()))
    return int(not {*ends} <= {"quick", "slow"})


if __name__ == "__main__":
    sys.exit(main())
