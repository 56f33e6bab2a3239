"""Is the plastic impact map a horseshoe on the printed sets? Claims H1-H6, H11 and H16.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.
"""

import shlex
import sys
from argparse import Namespace
from collections import Counter
from dataclasses import replace
from importlib.util import find_spec
from os import getpid
from pathlib import Path
from time import perf_counter

from intervals import Undecided
from proofs import manifest
from proofs.certificate import Malformed, read, render, write_atomically
from proofs.check.verify import Rejected, check
from proofs.cli import Parser, coloured, digits, horizon, number, progress
from proofs.facts import PAPER, Parameters, show
from proofs.model.impact import HORIZON
from proofs.plastic import CLAIMS, Outcome, printed, prove
from proofs.report import markdown
from proofs.statements import STATEMENTS, Verdict

EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. Results go to DIR/horseshoe.json
(the certificate, which is also the machine form) and DIR/horseshoe.md; DIR/MANIFEST.json says
which file settles which claim, its digest, and how it was made.

exit status: 0 every claim asked for is decided, 1 something is undecided,
             2 bad input (nothing is written), 3 the checker disagrees (a bug)

examples:
  python -m proofs.horseshoe
  python -m proofs.horseshoe --figure
  python -m proofs.horseshoe --only H1 H2 --digits 50
  python -m proofs.horseshoe --eta 0.212 --nu -0.2 --left 1.1 1.15 --right 1.27 1.32
  python -m proofs.horseshoe --json - > result.json
"""


def main(arguments: list[str] | None = None) -> int:
    """Run the main job; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        of = _parameters(options)
        if options.figure and find_spec("matplotlib") is None:
            raise ValueError("--figure needs matplotlib: pip install matplotlib")
        _writable(options.out)
    except ValueError as error:
        parser.error(str(error))
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    began = perf_counter()
    with progress() as tell:
        outcome = prove(
            of, options.only or CLAIMS, digits=options.digits, horizon=options.horizon, tell=tell
        )
    content = render(outcome.certificate)
    try:
        write_atomically(options.out / "horseshoe.json", content)
        whys = {row.id: row.why for row in outcome.rows}
        page = markdown(of, outcome.corrected, outcome.certificate, whys)
        write_atomically(options.out / "horseshoe.md", page)
        manifest.record(options.out, "horseshoe.json", content, _command(arguments))
        if options.figure:
            from proofs.figure import svg

            picture = svg(of, outcome.corrected)
            write_atomically(options.out / "horseshoe.svg", picture)
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    except (Undecided, OverflowError) as failure:
        print(f"{parser.prog}: no figure: {failure}", file=sys.stderr)
    if options.json:
        print(content, end="")
    else:
        _print(outcome, perf_counter() - began)
    agreed = options.no_check or _checked(options.out / "horseshoe.json", quiet=options.json)
    if not agreed:
        return 3
    return int(any(row.verdict is Verdict.UNDECIDED for row in outcome.rows))


def _command(arguments: list[str] | None) -> str:
    given = sys.argv[1:] if arguments is None else arguments
    return shlex.join(["python", "-m", "proofs.horseshoe", *given])


def _parser() -> Parser:
    parser = Parser("proofs.horseshoe", __doc__, EPILOG)
    add = parser.add_argument
    add("--eta", type=number, default=PAPER.eta, help="frequency ratio (default 0.2121)")
    add("--nu", type=number, default=PAPER.nu, help="amplitude -beta/p (default -0.2)")
    for name, default in (("left", PAPER.left), ("right", PAPER.right), ("slopes", PAPER.slopes)):
        help_text = f"default {show(default[0])} {show(default[1])}"
        add(f"--{name}", type=number, nargs=2, default=default, metavar=("A", "B"), help=help_text)
    add(
        "--interval",
        type=number,
        nargs=2,
        metavar=("A", "B"),
        help="I (default: from the left end of I0 to the right end of I1)",
    )
    add("--only", nargs="+", choices=CLAIMS, metavar="ID", help=f"claims, of {' '.join(CLAIMS)}")
    add("--digits", type=digits, default=30, help="significant digits of the numbers (default 30)")
    add("--horizon", type=horizon, default=HORIZON, help="longest flight looked at (default 1000)")
    add("--out", type=Path, default=Path("reports"), metavar="DIR", help="default: reports")
    add("--json", choices=["-"], help="print the machine form on standard output")
    add("--figure", action="store_true", help="draw DIR/horseshoe.svg too (needs matplotlib)")
    add("--no-check", action="store_true", help="do not run the checker on what was written")
    return parser


def _parameters(options: Namespace) -> Parameters:
    """Return the statement's numbers; those printed for s_0 go with the printed slopes only."""
    left, right, slopes = tuple(options.left), tuple(options.right), tuple(options.slopes)
    interval = tuple(options.interval) if options.interval else (left[0], right[1])
    of = replace(
        PAPER,
        eta=options.eta,
        nu=options.nu,
        left=left,
        right=right,
        interval=interval,
        slopes=slopes,
    )
    return of if slopes == PAPER.slopes else replace(of, ratios=None, printed_s0=None)


def _writable(folder: Path) -> None:
    """Raise OSError if nothing can be written to the folder, before any work is done."""
    folder.mkdir(parents=True, exist_ok=True)
    trial = folder / f".trial.{getpid()}"
    trial.touch(exist_ok=False)
    trial.unlink()


def _print(outcome: Outcome, seconds: float) -> None:
    for row in outcome.rows:
        print(f"{row.id:4} {coloured(row.verdict)} {STATEMENTS[row.id].says(outcome.parameters)}")
        print(f"     {row.why}  ({row.seconds * 1000:.1f} ms)")
        for name, bounds in row.quantities.items():
            lower, upper = printed(bounds, 17).values()
            print(f"     {name} in [{lower}, {upper}]")
    if outcome.corrected is not None:
        print(f"\nCorrected theorem, VERIFIED: {outcome.certificate['corrected']['theorem']}")
    counts = Counter(row.verdict.value for row in outcome.rows)
    summary = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
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
        print(f"checker: accepted {path}, {_count(len(report.claims))}, in {spent:.0f} ms")
    return True


def _count(claims: int) -> str:
    return f"{claims} claim{'s' if claims > 1 else ''}"


if __name__ == "__main__":
    sys.exit(main())
