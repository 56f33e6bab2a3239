"""Validated flows from points, as the checker takes them: width and time; writes a page.

`python -m proofs.benchmark.flows OUT` writes OUT/flows.md. Beside it stands what others take, as it
was measured once: CAPD by capd_flows.cpp, on the machine of the committed page.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple

from proofs.methods.derivation import Derivation
from proofs.methods.tubes import to_time
from proofs.report.page import markdown_table
from proofs.shell.files import write_files
from proofs.shell.screen import say
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed, point_box

_TIMES = (1, 10, 100)
_BITS = (64, 192)  # more where a time is not reached
_ABOVE = """\
Pure Python, beside CAPD in doubles (commit 7310792, order 20, filib's intervals, g++ 12 -O2, by
`proofs/benchmark/capd_flows.cpp`). Derivatives are enclosed in the same steps. Widths: of the
widest state; seconds: of one core.\
"""
_HEADER = ("flow", "from", "time", "bits", "width", "seconds", "CAPD: width", "seconds")


class Problem(NamedTuple):
    """A field of the states, where solutions begin, and what CAPD takes: widths and seconds."""

    field: dict[str, str]
    start: tuple[str, ...]
    capd: tuple[tuple[str, str], ...]


PROBLEMS = {
    "Lorenz (10, 28, 8/3)": Problem(
        {"x": "10*(y - x)", "y": "x*(28 - z) - y", "z": "x*y - 8/3*z"},
        ("1", "1", "1"),
        (("9.1e-13", "0.012"), ("7.9e-11", "0.089"), ("ends at 34.2", "0.37")),
    ),
    "Roessler (1/5, 1/5, 57/10)": Problem(
        {"x": "-y - z", "y": "x + y/5", "z": "1/5 + z*(x - 57/10)"},
        ("0", "-8", "3/100"),
        (("4.7e-14", "0.0012"), ("2.8e-12", "0.015"), ("1.6e-09", "0.12")),
    ),
    "Van der Pol (1)": Problem(
        {"x": "v", "v": "(1 - x**2)*v - x"},
        ("2", "0"),
        (("8.7e-15", "0.0014"), ("2.3e-13", "0.015"), ("2.5e-12", "0.15")),
    ),
    "pendulum": Problem(
        {"x": "v", "v": "-sin(x)"},
        ("1", "0"),
        (("4.6e-15", "0.0012"), ("4.7e-14", "0.010"), ("3.3e-12", "0.10")),
    ),
    "x'' = -x": Problem(
        {"x": "v", "v": "-x"},
        ("1", "0"),
        (("3.3e-16", "0.0001"), ("5.0e-15", "0.0003"), ("4.1e-14", "0.002")),
    ),
}
BESIDE = """\
kv, built with g++ -O3, takes Lorenz's point to the time 1 by affine arithmetic of order 24 in
0.11 s with the width 3e-13, and Roessler's to 5.875 in 0.10 s with 1e-13.

CAPD is 10 to 100 times as fast, and 9 to 500 times as wide. Its example RosslerChaoticDynamics
takes 3.4 s: a trapping region and, by cones, that the second return is conjugate to a shift on the
sets [-8.4, -7.6] and [-5.7, -4.6] of y. The theorems of `reports/systems/roessler.md`, on other
sets, take 24 s to check. RosslerPeriodicOrbit takes 0.13 s for three orbits, the checker 3.
TaylorModels.jl was not built, for want of a Julia.

What one believes: of CAPD and kv the library in C++, a compiler, and the rounding modes of a
processor; they print a verdict. Here the files that `check --trust` names, which call Python's
integers, and a file that anybody can check again.
"""


def main(arguments: Sequence[str]) -> int:
    """Measure, and write the page."""
    rows = [row for name, each in PROBLEMS.items() for row in measured(name, each)]
    text = "\n".join(
        ["# Validated flows", "", _ABOVE, "", *markdown_table([_HEADER, *rows], 2), "", BESIDE]
    )
    write_files(Path(arguments[0]), {"flows.md": text})
    say(text)
    return 0


def measured(name: str, problem: Problem) -> list[tuple[str, ...]]:
    """Return the rows of a problem, a time each."""
    start = ", ".join(problem.start)
    return [
        (name, f"({start})", str(time), *_reached(problem, time), *beside)
        for time, beside in zip(_TIMES, problem.capd, strict=True)
    ]


def _reached(problem: Problem, time: int) -> tuple[str, str, str]:
    """Return the bits, the width and the seconds; with more bits where fewer do not reach."""
    states, own = [*problem.field], [f"{x}0" for x in problem.field]
    function: dict[str, Any] = {"variables": own, "time": "t", "state": states, "start": own}
    function["field"] = [*problem.field.values()]
    map_ = Derivation({"X": to_time(function, Fraction(time))}).map("X")
    box = point_box([Fraction(x) for x in problem.start])
    for bits in _BITS:
        began = process_time()
        try:
            values = map_.values(enclosed(box, bits))
        except Unproved:
            continue
        width = max(float(high - low) for low, high in (x.range for x in values))
        return str(bits), f"{width:.1e}", f"{process_time() - began:.2f}"
    return "-", "not reached", "-"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
