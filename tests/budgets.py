"""How much code there is, counted, beside what it may be: `python -m tests.budgets`.

Lines are those of Python files as they stand, blank ones and docstrings with them. Lower a budget
when things have shrunk, which a test asks for where a tenth is unused; raise one only in a commit
that says why.
"""

import subprocess
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

from proofs.__main__ import main
from proofs.shell.trust import watched
from proofs.trusted.rules import RULES

ROOT = Path(__file__).parents[1]
GENERATED = ["docs/api.md", "docs/systems.md"]
BUDGETS = {
    "proofs": 55_120,
    "proofs/trusted": 23_335,
    "proofs/search, proofs/motion": 7_625,
    "proofs/shell": 1_465,
    "proofs/benchmark": 1_800,
    "proofs/stress": 1_150,
    "tests": 44_710,
    "words of the docs": 12_000,  # of those that are written by hand, the README with them
    "rules outside the kernel": 17,
    "loose modules": 9,  # of the package proofs
    "tracked files": 863,
    "headline": 7_005,  # lines of the files that run to check reports/horseshoe.json
    "way of H2": 7_441,  # lines of the files that run to prove H2 and to check it
    "way of H2, files": 46,
}


def counts():
    """The numbers, by the names of the budgets."""
    tracked = _tracked()
    python = [path for path in tracked if path.endswith(".py")]
    found = {"tracked files": len(tracked)}
    found["words of the docs"] = sum(len((ROOT / x).read_text().split()) for x in _written(tracked))
    found["rules outside the kernel"] = sum(
        not place.startswith("kernel.") for place in RULES.values()
    )
    found["loose modules"] = sum(path.count("/") == 1 and path[:7] == "proofs/" for path in python)
    for name in BUDGETS:
        folders = tuple(f"{folder}/" for folder in name.split(", "))
        if (ROOT / folders[0]).is_dir():
            found[name] = sum(_lines(path) for path in python if path.startswith(folders))
    checked = _run(["check", str(ROOT / "reports" / "horseshoe.json")])
    with TemporaryDirectory() as folder:
        proved = _run(["horseshoe", "--only", "H2", "--out", folder])
    found["headline"] = sum(map(_lines, checked))
    return found | {"way of H2": sum(map(_lines, proved)), "way of H2, files": len(proved)}


def _written(tracked):
    """Pages written by hand: generated ones are apart, and what `docs` only links to."""
    pages = [x for x in tracked if x.startswith("docs/") and x.endswith(".md")]
    own = [x for x in pages if not (ROOT / x).is_symlink() and x not in GENERATED]
    return ["README.md", "proofs/methods/README.md", *own]


def _tracked():
    """Files that git knows and that are there, and new ones that it does not ignore."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return sorted({path for path in done.stdout.splitlines() if (ROOT / path).is_file()})


def _lines(path):
    return len((ROOT / path).read_text(encoding="utf-8").splitlines())


def _run(arguments):
    """The files of both packages of which a function is called while a command runs."""
    with redirect_stdout(StringIO()):
        status, files = watched(lambda: main([*arguments, "--quiet"]))
    if status:
        raise RuntimeError(f"{arguments}: status {status}")
    packages = tuple(str(ROOT / name) + "/" for name in ("proofs", "intervals"))
    return [str(Path(path).relative_to(ROOT)) for path in files if path.startswith(packages)]


if __name__ == "__main__":
    is_kept = True
    for what, number in counts().items():
        state = "MORE" if number > BUDGETS[what] else "lower it" * (number < 0.9 * BUDGETS[what])
        is_kept = is_kept and not state
        print(f"{what:30} {number:6} of {BUDGETS[what]:6} {state}".rstrip())
    sys.exit(not is_kept)
