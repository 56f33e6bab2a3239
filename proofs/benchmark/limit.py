"""The whole process of the main job, accounted for: where each millisecond goes, and what limits.

`python -m proofs.horseshoe` in new processes, with compiled bytecode at hand as after a first run;
functions of the job are watched from outside, and the time of each is its own: that of watched
ones inside it is theirs. Imports are attributed to the package that asked for them first.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from statistics import median

from proofs.benchmark.horseshoe import (
    BARE,
    JOB,
    PLASTIC,
    TARGET,
    bytecode,
    process,
    processes,
    ratio_row,
)
from proofs.benchmark.measuring import Effort, Row, spread
from proofs.benchmark.peers import has_flint

_SCRIPT = ("-m", "proofs.benchmark.flint_job")
_LATE = "imports, late"
_WATCHING = "watching, no part of the job"
_STAGES = {
    "search in floating point": (
        "proofs.motion.candidate:next_impact",
        "proofs.search.repair:nearest_sets",
        "proofs.search.s33_rectangles:image_phases",
        "proofs.search.s33_rectangles:nearest_rectangles",
        "proofs.search.s33_rectangles:narrowed",
    ),
    "proof: slopes on I0 and I1": ("proofs.search.steps:Prover.slopes",),
    "proof: the gap leaves I": ("proofs.search.steps:Prover.avoids",),
    "proof: witnesses": ("proofs.search.steps:Prover.point",),
    "proof: s_0": ("proofs.search.steps:Prover.root",),
    "proof: impacts with restitution": ("proofs.search.s33_steps:ReboundProver.rebound",),
    "decisions": ("proofs.search.s31_horseshoe:prove", "proofs.shell.groups:settle"),
    "certificate": (
        "proofs.trusted.certificate:render",
        "proofs.shell.groups:certificate",
        "proofs.shell.runner:write",
    ),
    "manifest": ("proofs.shell.manifest:record",),
    "report": ("proofs.report.page:markdown",),
    "check": ("proofs.trusted.verify:check", "proofs.trusted.certificate:read"),
    _LATE: ("builtins:__import__", "importlib:import_module"),
}
_EARLY, _REST = "imports, at the start", "arguments, screen, the rest"
_OUTSIDE = "interpreter: start and end"
_PACKAGES = ("proofs", "intervals", "mpmath", "gmpy2", "numpy", "sympy")
# Arguments: where to add the seconds of each stage and what was never loaded, the stage of late
# imports, the stages as JSON, those of the job.
_DRIVER = """
from time import perf_counter
began = perf_counter()
import proofs.horseshoe
seconds = {"imports, at the start": perf_counter() - began}
import importlib, json, sys, types
stack = [["arguments, screen, the rest", perf_counter()]]

def charge():
    now = perf_counter()
    seconds[stack[-1][0]] = seconds.get(stack[-1][0], 0.0) + now - stack[-1][1]
    return now

def enter(stage):
    stack.append([stage, charge()])

def leave():
    now = charge()
    stack.pop()
    stack[-1][1] = now

def iterate(stage, items):
    while True:
        enter(stage)
        try:
            item = next(items)
        except StopIteration:
            return
        finally:
            leave()
        yield item

def watch(stage, name):
    module, _, path = name.partition(":")
    holder = sys.modules[module]
    *outer, last = path.split(".")
    for part in outer:
        holder = getattr(holder, part)
    function = getattr(holder, last)
    def watched(*arguments, **options):
        enter(stage)
        try:
            found = function(*arguments, **options)
        finally:
            leave()
            if stage == late:
                watch_loaded()
        return iterate(stage, found) if isinstance(found, types.GeneratorType) else found
    setattr(holder, last, watched)
    for known in list(sys.modules.values()):
        if known.__name__.startswith("proofs") and vars(known).get(last) is function:
            setattr(known, last, watched)

def watch_loaded():
    for stage, name in list(pending):
        module, _, path = name.partition(":")
        if hasattr(sys.modules.get(module), path.partition(".")[0]):
            pending.remove((stage, name))
            watch(stage, name)

target, late, stages, *arguments = sys.argv[1:]
pending = [(stage, name) for stage, names in json.loads(stages).items() for name in names]
watch_loaded()
sys.argv = ["proofs.horseshoe", *arguments]
seconds["watching, no part of the job"] = perf_counter() - stack[-1][1]
stack[-1][1] = perf_counter()
status = proofs.horseshoe.main(arguments)
charge()
with open(target, "a") as file:
    print(json.dumps([seconds, [name for _, name in pending]]), file=file)
sys.exit(status)
"""


def measure(effort: Effort) -> list[Row]:
    """Account for the claims of the plastic map, which have a target, and for the default job."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = [_first_run(folder / "first")]
        rows += _account("plastic claims", [*PLASTIC, "--out", name], folder, effort)
        rows += _account("main job", ["--out", name], folder, effort)
        rows += _imports(folder)
    return rows


def _first_run(folder: Path) -> Row:
    """Measure the default job once, where no bytecode is."""
    with bytecode(folder):
        seconds, status, _ = process([*JOB, "--out", str(folder)])
    text = f"{seconds:.3g}, exit status {status}"
    return Row("first run, everything compiled [s]", text, samples={"seconds": seconds})


def _account(name: str, job: Sequence[str], folder: Path, effort: Effort) -> list[Row]:
    """Measure a job as it is, the bare imports, its stages and the script in flint, in turn."""
    target = folder / "stages.json"
    target.unlink(missing_ok=True)
    watched = ["-c", _DRIVER, str(target), _LATE, json.dumps(_STAGES), *job]
    asked = name == "plastic claims"
    commands = [[*JOB, *job], BARE, watched, *([_SCRIPT] if asked and has_flint() else [])]
    runs = processes(commands, folder / "cache", effort.process_pairs)
    failed = {status for column in runs for _, status, _ in column} - {0, 1}
    if failed:
        return [Row(name, f"failed: exit status {max(failed)}", "exit status 0", False)]
    parts = [json.loads(line)[0] for line in target.read_text().splitlines()[1:]]
    total, bare, stages, *script = ([one[0] for one in column] for column in runs)
    for seconds, part in zip(stages, parts, strict=True):
        part[_OUTSIDE] = seconds - sum(part.values())
        del part[_WATCHING]
    return [
        Row(f"{name}, whole process [s]", spread(total), samples={"seconds": total}),
        ratio_row(f"{name} / import numpy, mpmath", total, bare, TARGET if asked else None),
        *(_beside_script(name, total, script) if asked else []),
        *_stages(name, parts),
    ]


def _beside_script(name: str, ours: list[float], script: list[list[float]]) -> list[Row]:
    """Return the rows of the script that decides the same claims, and no more, in python-flint."""
    title = f"{name} / the same by a script in python-flint"
    if not script:
        return [Row(title, "python-flint is absent", "<= 1")]
    (theirs,) = script
    return [
        Row("script in python-flint, whole process [s]", spread(theirs)),
        ratio_row(title, ours, theirs, 1),
    ]


def _stages(name: str, parts: Sequence[dict[str, float]]) -> list[Row]:
    """Return a row a stage, in the order in which things happen, with its share."""
    known = (_OUTSIDE, _EARLY, *_STAGES, _REST)
    whole = median(sum(part.values()) for part in parts)
    rows = []
    for stage in known:
        seconds = [part.get(stage, 0.0) for part in parts]
        if any(seconds):
            share = 100 * median(seconds) / whole
            text = f"{spread([1e3 * one for one in seconds])}, {share:.1f} %"
            rows.append(Row(f"  {name}, {stage} [ms]", text, samples={"seconds": seconds}))
    return rows


# -- imports ---------------------------------------------------------------------------------------


def _imports(folder: Path) -> list[Row]:
    """Attribute the imports of the main job: each module to the package that asked for it."""
    command = [sys.executable, "-X", "importtime", "-c", "import proofs.horseshoe"]
    with bytecode(folder / "cache"):
        runs = [
            subprocess.run(command, capture_output=True, text=True, check=True) for _ in range(2)
        ]
    found = attributed(runs[-1].stderr)
    total = sum(found.values())
    return [
        Row(
            f"  imports asked for by {package} [ms]",
            f"{micros / 1e3:.3g}, {100 * micros / total:.1f} % of imports",
            samples={"microseconds": micros},
        )
        for package, micros in found.most_common()
    ]


def attributed(trace: str) -> Counter[str]:
    """Sum what `-X importtime` prints, in microseconds, by the packages that asked for the modules.

    That is the nearest of _PACKAGES above a module; the interpreter, where there is none.
    """
    micros: Counter[str] = Counter()
    above: list[tuple[int, str]] = []
    for line in reversed(trace.splitlines()):  # a module is printed after what it imports
        head, _, rest = line.partition("|")
        own = head.removeprefix("import time:").strip()
        name = rest.partition("|")[2]
        if not own.isdigit():
            continue
        depth, top = len(name) - len(name.lstrip()), name.strip().partition(".")[0]
        while above and above[-1][0] >= depth:
            above.pop()
        asked = top if top in _PACKAGES else above[-1][1] if above else "the interpreter"
        above.append((depth, asked))
        micros[asked] += int(own)
    return micros
