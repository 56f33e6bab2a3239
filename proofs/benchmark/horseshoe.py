"""The main job, its slopes and its kernel: whole processes, losses, and python-flint beside them.

Every loss is against extremes computed by python-flint at 600 bits, on another transcription of the
equations.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import partial
from pathlib import Path

from intervals import IntervalArray, Undecided
from proofs.benchmark import horseshoe_flint
from proofs.benchmark.measuring import Effort, Row, in_pairs, spread, timed
from proofs.benchmark.peers import has_flint
from proofs.motion.covering import cover_by_impacts
from proofs.motion.impact import HORIZON
from proofs.motion.kernel import Launches, exclude_impacts
from proofs.motion.slope_cover import cut, grid_of, slope_cover, slope_extremes
from proofs.motion.system import System
from proofs.search.steps import Prover
from proofs.trusted.paper import GROUPS

SYSTEM = System(horseshoe_flint.ETA, horseshoe_flint.NU)
DOMAINS = ((Fraction("1.11"), Fraction("1.15")), (Fraction("1.27"), Fraction("1.32")))
BOXES = 1024
_FASTER = 14  # times as fast as python-flint, box by box in lists
JOB, BARE = ("-m", "proofs.horseshoe"), ("-c", "import numpy, mpmath")
PLASTIC = (
    "--only",
    *GROUPS["horseshoe"],
)  # those that have a target
TARGET = 2.5  # times as long as BARE
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

Range = tuple[Fraction, Fraction]


# -- whole processes -----------------------------------------------------------------------------


def process(arguments: Sequence[str]) -> tuple[float, int, float]:
    """Run python with these arguments; return (seconds, exit status, peak memory in MB)."""
    text = subprocess.run(
        [sys.executable, "-S", "-c", _LAUNCHER, *arguments],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    seconds, status, peak = json.loads(text)
    return seconds, status, peak / (1 << 20 if sys.platform == "darwin" else 1 << 10)


@contextmanager
def bytecode(folder: Path) -> Iterator[None]:
    """Have processes write and find compiled bytecode in a folder meanwhile."""
    before = dict(os.environ)
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = str(folder)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def processes(
    commands: Sequence[Sequence[str]], folder: Path, pairs: int
) -> list[list[tuple[float, int, float]]]:
    """Run `process` on the commands in turn, and once before that writes bytecode to `folder`."""
    with bytecode(folder):
        rounds = [[process(command) for command in commands] for _ in range(pairs + 1)]
    return [list(column) for column in zip(*rounds[1:], strict=True)]


def ratio_row(name: str, ours: Sequence[float], theirs: Sequence[float], most: float | None) -> Row:
    """Return the row of a ratio of seconds in pairs, that should be at most `most`."""
    ratios = [own / other for own, other in zip(ours, theirs, strict=True)]
    target, reached = "", None
    if most is not None:
        target, reached = f"<= {most:g}", statistics.median(ratios) <= most
    samples = {"ratios": ratios, "theirs": list(theirs)}
    return Row(f"{name} (pairs)", spread(ratios), target, reached, samples)


def whole_job(effort: Effort) -> list[Row]:
    """Measure the main job beside the bare imports of numpy and mpmath."""
    with tempfile.TemporaryDirectory() as name:
        commands = [[*JOB, *PLASTIC, "--out", name], BARE]
        jobs, imports = processes(commands, Path(name) / "cache", effort.process_pairs)
    failed = {status for _, status, _ in (*jobs, *imports)} - {0}
    if failed:
        return [Row("main job", f"failed: exit status {failed}", "exit status 0", False)]
    ours, theirs = ([one[0] for one in runs] for runs in (jobs, imports))
    memory = max(one[2] for one in jobs)
    return [
        Row(
            "main job (plastic claims), whole process [s]", spread(ours), samples={"seconds": ours}
        ),
        Row("import numpy, mpmath [s]", spread(theirs), samples={"seconds": theirs}),
        ratio_row("main job / import numpy, mpmath", ours, theirs, TARGET),
        Row(
            "main job, peak memory [MB]",
            f"{memory:.0f}",
            "< 120",
            memory < 120,
            {"megabytes": [one[2] for one in jobs]},
        ),
    ]


# -- accuracy ------------------------------------------------------------------------------------


def accuracy(effort: Effort) -> list[Row]:
    """Measure time and loss of slope enclosures over both intervals."""
    if not has_flint():
        return [Row("accuracy of slopes", "python-flint is absent", "loss <= 1e-11")]
    truth = [horseshoe_flint.true_extremes(*domain) for domain in DOMAINS]
    rows = [_accuracy("binary64, f'' > 0", effort, truth, _by_monotonicity, 1e-11)]
    for boxes in (256, 1024, 4096):
        name = f"binary64, mean value, {boxes} boxes"
        rows.append(_accuracy(name, effort, truth, partial(_by_boxes, boxes)))
    for digits in (30, 50, 100):
        name, task = f"multiprecision, {digits} digits", partial(_by_multiprecision, digits)
        rows.append(_accuracy(name, effort, truth, task, 10.0**-digits))
    return rows


def _by_monotonicity(domain: Range) -> Range:
    found = slope_extremes(SYSTEM, domain)
    return Fraction(found.minimum[0]), Fraction(found.maximum[1])


def _by_boxes(boxes: int, domain: Range) -> Range:
    low, high = slope_cover(SYSTEM, domain, boxes).bounds
    return Fraction(low), Fraction(high)


def _by_multiprecision(digits: int, domain: Range) -> Range:
    found = Prover(SYSTEM, digits, HORIZON).slopes(list(domain))[1]
    return min(low for low, _ in found.pieces), max(high for _, high in found.pieces)


def _accuracy(
    name: str,
    effort: Effort,
    truth: Sequence[Range],
    task: Callable[[Range], Range],
    target: float | None = None,
) -> Row:
    found = [task(domain) for domain in DOMAINS]
    losses = [
        loss
        for (low, high), (true_low, true_high) in zip(found, truth, strict=True)
        for loss in (true_low - low, high - true_high)
    ]
    times = [timed(lambda: [task(domain) for domain in DOMAINS]) for _ in range(effort.repeats)]
    loss = float(max(losses))
    sound = min(losses) >= 0
    return Row(
        f"f' on I0 and I1, {name}",
        f"loss {loss:.1e} in {1e3 * statistics.median(times):.1f} ms"
        + ("" if sound else ", NOT AN ENCLOSURE"),
        "" if target is None else f"loss <= {target:.0e}",
        (sound and loss <= target) if target is not None else (None if sound else False),
        {"losses": [float(loss) for loss in losses], "seconds": times},
    )


# -- the kernel ----------------------------------------------------------------------------------


def kernel(effort: Effort) -> list[Row]:
    """Measure the subdivision kernel, all earlier impacts excluded, beside python-flint."""
    grids = [grid_of(cover_by_impacts(SYSTEM, domain)[0]) for domain in DOMAINS]
    cuts = [cut(domain, BOXES) for domain in DOMAINS]
    boxes = [IntervalArray.from_floats(one[:-1], one[1:]) for one in cuts]
    evaluations = sum(2 * BOXES * len(grid) for grid in grids)

    def ours() -> None:
        for box, grid in zip(boxes, grids, strict=True):
            exclude_impacts(Launches(SYSTEM, box), grid)

    def whole() -> None:
        for domain, grid in zip(DOMAINS, grids, strict=True):
            slope_cover(SYSTEM, domain, BOXES, grid)

    (all_steps,) = in_pairs([whole], effort.kernel_pairs)
    rows = [
        Row(
            f"kernel with f', f'' and time brackets, 2 x {BOXES} boxes [s]",
            spread(all_steps),
            samples={"seconds": all_steps},
        )
    ]
    if not has_flint():
        (seconds,) = in_pairs([ours], effort.kernel_pairs)
        rates = [evaluations / one for one in seconds]
        absent = Row("ratio to python-flint", "python-flint is absent", f">= {_FASTER}")
        return [*rows, Row("kernel, gap [1/s]", spread(rates), samples={"rates": rates}), absent]
    peers: dict[str, list[Callable[[], bool]]] = {"lists": [], "arb_mat": []}
    for one, grid in zip(cuts, grids, strict=True):
        peers["lists"].append(horseshoe_flint.exclusion(one.tolist(), grid))
        peers["arb_mat"].append(horseshoe_flint.exclusion_by_matrices(one.tolist(), grid))
    return rows + _beside(effort, ours, peers, evaluations)


def _beside(
    effort: Effort,
    ours: Callable[[], None],
    peers: dict[str, list[Callable[[], bool]]],
    evaluations: int,
) -> list[Row]:
    """Return the rates and ratios of single calls, of ours in the caches that the others emptied.

    The last row is of calls of ours in a row, about as long together as one of python-flint.
    """
    groups = {name: partial(_each, tasks) for name, tasks in peers.items()}
    for name, group in groups.items():
        if not group():
            raise Undecided(f"python-flint ({name}) does not exclude the earlier impacts")
    calls = max(1, round(timed(groups["lists"]) / timed(ours)))

    def in_a_row() -> None:
        for _ in range(calls):
            ours()

    once, many, *others = in_pairs([ours, in_a_row, *groups.values()], effort.kernel_pairs)
    times = [once, *others]
    rates = [[evaluations / seconds for seconds in column] for column in times]
    rows = [
        Row("kernel, evaluations of the gap [1/s]", spread(rates[0]), "", None, {"rates": rates[0]})
    ]
    targets = (_FASTER, None)
    for name, target, column, rate in zip(peers, targets, others, rates[1:], strict=True):
        ratios = [theirs / own for theirs, own in zip(column, times[0], strict=True)]
        rows.append(
            Row(f"python-flint, {name}, the same [1/s]", spread(rate), "", None, {"rates": rate})
        )
        reached = None if target is None else statistics.median(ratios) >= target
        text = "" if target is None else f">= {target}"
        rows.append(
            Row(f"ratio to it ({name}, pairs)", spread(ratios), text, reached, {"ratios": ratios})
        )
    ratios = [calls * theirs / own for theirs, own in zip(others[0], many, strict=True)]
    name = "ratio to it (lists, calls in a row)"
    return [*rows, Row(name, spread(ratios), samples={"ratios": ratios, "calls": calls})]


def _each(tasks: Sequence[Callable[[], bool]]) -> bool:
    return all(task() for task in tasks)


def measure(effort: Effort) -> list[Row]:
    """Measure everything."""
    return [*whole_job(effort), *accuracy(effort), *kernel(effort)]
