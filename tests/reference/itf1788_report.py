"""Print how Interval and IntervalArray do on the vectors of ITF1788, a line for each operation.

    python -m tests.reference.itf1788_report [FOLDER]

The exit status is 1 if a statement failed.
"""

import sys
from collections import Counter
from pathlib import Path

from tests.reference.itf1788_judge import CONTAINED, FAILED, OVERFLOW, RAISED
from tests.reference.itf1788_run import run
from tests.reference.itl import read

FOLDER = Path(__file__).parent / "itf1788"
_TIGHT = ("tight", "tight array", "overflow array")
_COLUMNS = ("cases", CONTAINED, *_TIGHT, RAISED, OVERFLOW, FAILED)


def outcomes_of(path):
    """Return the outcomes of the statements of a file."""
    return run(read(path.read_text(encoding="utf-8-sig", errors="replace")))


def counted(outcomes):
    """Return a Counter of kinds, tight results and all cases for each operation, and for "all"."""
    rows = {}
    for x in outcomes:
        counts = {"cases": 1, x.kind: 1}
        counts |= zip(_TIGHT, (x.tight, x.tight_array, x.overflow_array), strict=True)
        for name in (x.statement.operation or "(none)", "all"):
            rows.setdefault(name, Counter()).update(counts)
    return dict(sorted(rows.items(), key=lambda row: (row[0] == "all", row[0].lower())))


def table(outcomes):
    """Return the lines of the table: the reasons why a case is not applicable come last."""
    lines = [_line("operation", _COLUMNS, "not applicable")]
    for name, row in counted(outcomes).items():
        reasons = (f"{kind} {n}" for kind, n in sorted(row.items()) if kind not in _COLUMNS)
        lines.append(_line(name, [row[column] or "." for column in _COLUMNS], ", ".join(reasons)))
    return lines


def _line(name, cells, rest):
    widths = zip(cells, map(len, _COLUMNS), strict=True)
    return f"{name:18}" + "".join(f"{cell!s:>{n + 2}}" for cell, n in widths) + f"  {rest}"


def main(arguments):
    """Print the table of a folder, and what failed; return the exit status."""
    folder = Path(arguments[0]) if arguments else FOLDER
    paths = sorted(folder.rglob("*.itl"))
    outcomes = {path: outcomes_of(path) for path in paths}
    print("\n".join(table([x for some in outcomes.values() for x in some])))
    failed = 0
    for path, some in outcomes.items():
        for x in some:
            if x.kind == FAILED:
                failed += 1
                print(f"{path.name}:{x.statement.line}: {x.statement.operation}: {x.message}")
    return 1 if failed or not paths else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
