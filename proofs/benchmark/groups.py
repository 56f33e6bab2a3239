"""The groups of claims: whole processes, their checks, and time against digits and periods."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from proofs.benchmark.horseshoe import process
from proofs.benchmark.measuring import Effort, Row, spread
from proofs.trusted.paper import GROUPS

Tell = Callable[[str], None]
_PROVED_WITHIN = {"nonplastic": 3.0, "dimension": 20.0, "circle": 60.0}  # seconds
_CHECKED_WITHIN = {"nonplastic": 5.0}
_ORBITS_WITHIN = {(12, 15): 10.0, (12, 25): 60.0}
_MOST_MEMORY = 500  # MB


def measure(effort: Effort, tell: Tell) -> list[Row]:
    """Measure everything."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = [row for group in GROUPS for row in _group(group, folder, effort, tell)]
        return rows + _dimensions(folder, effort, tell) + _orbits(folder, effort, tell)


def _run(arguments: Sequence[str], times: int) -> tuple[list[float], set[int], float]:
    """Run python some times; return the seconds, the exit statuses and the peak memory in MB."""
    runs = [process(arguments) for _ in range(times)]
    return [one[0] for one in runs], {one[1] for one in runs}, max(one[2] for one in runs)


def _row(
    name: str, arguments: Sequence[str], effort: Effort, within: float | None = None, more: str = ""
) -> Row:
    """Measure one command, which may leave a claim undecided but must not fail."""
    seconds, statuses, memory = _run(arguments, effort.large_rounds)
    if not statuses <= {0, 1}:
        return Row(name, f"failed: exit status {max(statuses)}", "exit status 0", False)
    target = f"< {_MOST_MEMORY} MB" if within is None else f"< {within:g} s, < {_MOST_MEMORY} MB"
    reached = memory < _MOST_MEMORY and (within is None or statistics.median(seconds) < within)
    return Row(
        f"{name} [s]",
        f"{spread(seconds)}, {memory:.0f} MB{more}",
        target,
        reached,
        {"seconds": seconds, "megabytes": memory},
    )


def _group(group: str, folder: Path, effort: Effort, tell: Tell) -> list[Row]:
    """Measure the command of a group with its check, and the check alone."""
    tell(group)
    file = folder / f"{group}.json"
    proving = _row(
        f"proofs.{group}, proved and checked",
        ["-m", f"proofs.{group}", "--out", str(folder)],
        effort,
        _PROVED_WITHIN.get(group),
    )
    if not file.exists():
        return [proving]
    check = ["-S", "-O", "-m", "proofs.check", str(file)]
    size = f", {file.stat().st_size / 1000:.0f} kB"
    return [proving, _row(f"the check of {group}", check, effort, _CHECKED_WITHIN.get(group), size)]


def _dimensions(folder: Path, effort: Effort, tell: Tell) -> list[Row]:
    """Measure time against digits of the dimension."""
    rows = []
    for digits in (5, 10, 15, 20):
        tell(f"dimension, {digits} digits")
        arguments = ["-m", "proofs.dimension", "--digits", str(digits), "--out", str(folder)]
        rows.append(
            _row(f"dimension, {digits} digits", arguments, effort, 20 if digits <= 10 else None)
        )
    return rows


def _orbits(folder: Path, effort: Effort, tell: Tell) -> list[Row]:
    """Measure time against period of all periodic orbits, and against digits."""
    rows = []
    for period, digits in ((4, 25), (8, 25), (12, 15), (12, 25)):
        tell(f"orbits of period {period}")
        file = str(folder / "orbits.csv")
        arguments = ["-m", "proofs.orbits", "--period", str(period), "--digits", str(digits)]
        name = f"all {2**period} words of length {period}, {digits} digits"
        within = _ORBITS_WITHIN.get((period, digits))
        rows.append(_row(name, [*arguments, "--csv", file], effort, within))
    return rows
