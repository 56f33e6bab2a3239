"""What every command that proves claims shares: options, files, the screen, the check.

`run` is the command of a group of claims.
"""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from intervals import Undecided
from proofs.report.figures import FIGURES
from proofs.report.page import Line
from proofs.shell import manifest
from proofs.shell.cli import (
    Parser,
    add_stats,
    coloured,
    counting,
    digits,
    horizon,
    number,
    progress,
    writable,
)
from proofs.shell.groups import FILES, Made, printed, produce, wanted
from proofs.trusted.certificate import Malformed, read, write_atomically
from proofs.trusted.numbers import show
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, check, premises

if TYPE_CHECKING:
    from proofs.shell.counting import Counts

_USED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "foundations": ("--eta", "--nu"),
        "circle": ("--eta", "--nu"),
        "persistence": ("--eta", "--nu", "--epsilon"),
        "single": ("--eta", "--nu"),
        "soft": (),
        "resonance": (),
    }
)  # the numbers that a command's claims are about, where not all; see `proofs.report.page`
EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. Results go to DIR/{group}.json
(the certificate, which is also the machine form) and DIR/{group}.md; DIR/MANIFEST.json says which
file settles which claim, its digest, and how it was made.

exit status: 0 every claim asked for is decided, 1 something is undecided,
             2 bad input (nothing is written), 3 the checker disagrees (a bug)

examples:
  python -m proofs.{group}
  python -m proofs.{group} --only {first} --digits 40
  python -m proofs.{group} --json - > {group}.json
"""


def run(
    file: str,
    arguments: list[str] | None = None,
    description: str | None = None,
    *,
    examples: str = "",
) -> int:
    """Run the command of a certificate; return the exit status.

    With --figure the figures that are drawn from this certificate alone are written, too.
    """
    claims = [claim for ids in FILES[file].values() for claim in ids]
    epilog = EPILOG.format(group=file, first=claims[0]) + examples
    parser = Parser(f"proofs.{file}", description, epilog)
    add_parameters(parser, _USED.get(file))
    add_outputs(parser, claims)
    parser.set_defaults(figure=False, horizon=None)
    if file == "horseshoe":
        longest = "longest flight looked at (default 1000)"
        parser.add_argument("--horizon", type=horizon, help=longest)
    figures = [figure for figure in FIGURES if figure.certificate == file]
    if figures:
        names = ", ".join(f"{figure.name}.svg" for figure in figures)
        help_text = f"draw {names} in DIR/figures, too (needs matplotlib)"
        parser.add_argument("--figure", action="store_true", help=help_text)
    options = parser.parse_args(arguments)
    if options.figure and find_spec("matplotlib") is None:
        parser.error("--figure needs matplotlib: pip install matplotlib")
    of = prepared(parser, options)
    more = {"horizon": options.horizon} if options.horizon else {}
    began = perf_counter()
    with counting(options.stats) as counts, progress() as tell:
        asked = wanted(file, of, options.only)
        if not asked:
            parser.error("all its claims are about the paper's parameters: choose some by --only")
        made = produce(asked, of, digits=options.digits, tell=tell, **more)
    seconds = perf_counter() - began
    try:
        write(options.out, file, made)
        for figure in figures if options.figure else ():
            text = figure.svg({file: premises(made.certificate)})
            write_atomically(options.out / "figures" / f"{figure.name}.svg", text)
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    except (Undecided, OverflowError) as failure:
        print(f"{parser.prog}: no figure: {failure}", file=sys.stderr)
    return finish(made, seconds, options, f"{file}.json", counts)


def add_parameters(parser: Parser, used: Sequence[str] | None = None) -> None:
    """Add the options for the numbers of a statement, the paper's by default: all, or some."""

    def add(option: str, **more: Any) -> None:
        if used is None or option in used:
            parser.add_argument(option, type=number, **more)
        else:
            parser.set_defaults(**{option.removeprefix("--"): more.get("default")})

    add("--eta", default=PAPER.eta, help="frequency ratio (default 0.2121)")
    add("--nu", default=PAPER.nu, help="amplitude -beta/p (default -0.2)")
    for name, default in (("left", PAPER.left), ("right", PAPER.right), ("slopes", PAPER.slopes)):
        help_text = f"default {show(default[0])} {show(default[1])}"
        add(f"--{name}", nargs=2, default=default, metavar=("A", "B"), help=help_text)
    interval = "I (default: from the left end of I0 to the right end of I1)"
    add("--interval", nargs=2, metavar=("A", "B"), help=interval)
    add("--epsilon", default=PAPER.epsilon, help="of restitution (default 0.01)")
    gamma, ends = "range of velocities gamma (default -0.45 0)", ("A", "B")
    add("--velocities", nargs=2, default=PAPER.velocities, metavar=ends, help=gamma)
    box = "box around eta, nu, epsilon (default 0.00005 0.00005 0.005, or less to stay in it)"
    add("--reach", nargs=3, metavar=("DETA", "DNU", "DEPSILON"), help=box)


def add_outputs(parser: Parser, claims: Sequence[str]) -> None:
    """Add the options for what is asked and where results go."""
    add = parser.add_argument
    add("--only", nargs="+", choices=claims, metavar="ID", help=f"claims, of {' '.join(claims)}")
    places = "significant digits of the numbers (default 30)"
    add("--digits", type=digits, default=30, help=places)
    add("--out", type=Path, default=Path("reports"), metavar="DIR", help="default: reports")
    add("--json", choices=["-"], help="print the machine form on standard output")
    add("--no-check", action="store_true", help="do not run the checker on what was written")
    add_stats(parser)


def prepared(parser: Parser, options: Namespace) -> Parameters:
    """Return the statement's numbers, the output folder tried; leave with one line if bad."""
    try:
        of = parameters(options)
    except ValueError as error:
        parser.error(str(error))
    writable(parser, options.out)
    return of


def parameters(options: Namespace) -> Parameters:
    """Return the statement's numbers; those printed for s_0 go with the printed slopes only."""
    left, right, slopes = tuple(options.left), tuple(options.right), tuple(options.slopes)
    of = replace(
        PAPER,
        eta=options.eta,
        nu=options.nu,
        left=left,
        right=right,
        interval=tuple(options.interval) if options.interval else (left[0], right[1]),
        slopes=slopes,
        epsilon=options.epsilon,
        velocities=tuple(options.velocities),
        reach=_reach(options),
    )
    return of if slopes == PAPER.slopes else replace(of, ratios=None, printed_s0=None)


def _reach(options: Namespace) -> tuple[Fraction, Fraction, Fraction] | None:
    """Return the box asked for, else the paper's, narrowed where the numbers leave less room."""
    eta, nu, epsilon = options.eta, abs(options.nu), options.epsilon
    if options.reach:
        if options.reach[2] > epsilon:
            raise ValueError("reach: epsilon must stay in [0, 1)")
        return tuple(options.reach)
    room = (eta / 2, nu / 2, min(epsilon, (1 - epsilon) / 2))
    if PAPER.reach is None or min(room) < 0:
        return None
    first, second, third = map(min, PAPER.reach, room)
    return first, second, third


def write(folder: Path, name: str, made: Made) -> None:
    """Write a certificate and its page, and enter it in the manifest."""
    write_atomically(folder / f"{name}.json", made.certificate)
    write_atomically(folder / f"{name}.md", made.page)
    manifest.record(folder, f"{name}.json", made.certificate)


def finish(made: Made, seconds: float, options: Namespace, name: str, counts: Counts) -> int:
    """Print what was decided, have it checked, and return the exit status.

    counts: of what was evaluated up to here; with what the check evaluates they are printed, if
    that is asked for.
    """
    if options.json:
        print(made.certificate, end="")
    else:
        print_lines(made.lines, seconds)
    with counting(options.stats) as checking:
        accepted = options.no_check or _checked(options.out / name, quiet=bool(options.json))
    if options.stats:
        from proofs.shell.counting import show

        show(counts + checking, [row.id for row in made.lines], quiet=bool(options.json))
    if not accepted:
        return 3
    return int(any(row.verdict is Verdict.UNDECIDED for row in made.lines))


def print_lines(lines: Sequence[Line], seconds: float) -> None:
    """Print a paragraph a claim, the theorems beside them once each, and a summary line."""
    for line in lines:
        print(f"{line.id:4} {coloured(line.verdict)} {line.statement}")
        print(f"     {line.why}")
        for name, bounds in line.quantities.items():
            lower, upper = printed(bounds, 17).values()
            print(f"     {name} in [{lower}, {upper}]")
    for text in dict.fromkeys(line.corrected for line in lines if line.corrected is not None):
        beside = ", ".join(line.id for line in lines if line.corrected == text)
        print(f"\nTheorem beside {beside}, VERIFIED: {text}")
    summary = tally((line.verdict, not line.words) for line in lines)
    print(f"\n{summary}; proved in {seconds * 1000:.0f} ms")


def _checked(path: Path, quiet: bool) -> bool:
    """Run the independent checker on what was written; say loudly if it disagrees."""
    began = perf_counter()
    try:
        report = check(read(path))
    except (Malformed, Rejected) as error:
        print(f"THE CHECKER DISAGREES WITH THE PROVER, a bug: {error}", file=sys.stderr)
        return False
    if not quiet:
        spent = (perf_counter() - began) * 1000
        count = f"{len(report.claims)} claim{'s' if len(report.claims) > 1 else ''}"
        print(f"checker: accepted {path}, {count}, in {spent:.0f} ms")
    return True
