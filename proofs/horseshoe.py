"""Is the impact map a horseshoe on the printed sets? Claims H1-H6, H11, H16, N1 and N2.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.
"""

import sys
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from time import perf_counter
from typing import Any

from intervals import Undecided
from proofs import plastic, runner
from proofs.certificate import write_atomically
from proofs.cli import Parser, horizon, progress
from proofs.facts import Parameters
from proofs.model.impact import HORIZON
from proofs.report import markdown
from proofs.runner import Row, Tell

CLAIMS = (*plastic.CLAIMS, "N1", "N2")
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
  python -m proofs.horseshoe --only N1 N2 --epsilon 0.02
  python -m proofs.horseshoe --json - > result.json
"""


@dataclass(frozen=True)
class Outcome:
    """What a run proved: rows for people, corrected sets if any, a certificate for the checker."""

    rows: list[Row]
    corrected: Parameters | None
    certificate: dict[str, Any]


def prove(
    of: Parameters,
    claims: tuple[str, ...] = CLAIMS,
    *,
    digits: int = 30,
    longest: Fraction = HORIZON,
    tell: Tell = lambda stage: None,
) -> Outcome:
    """Decide the claims asked for, of the plastic map and of the one with restitution."""
    flat = [claim for claim in plastic.CLAIMS if claim in claims]
    found = plastic.prove(of, flat, digits=digits, horizon=longest, tell=tell)
    rows, proved = list(found.rows), found.certificate
    others = [claim for claim in ("N1", "N2") if claim in claims]
    if others:
        more, also = runner.settle("nonplastic", of, others, digits=digits, tell=tell)
        rows += more
        steps = proved["steps"] | also["steps"]
        entries = proved["claims"] + also["claims"]
        proved = runner.certificate(of, steps, entries, proved["corrected"])
    return Outcome(rows, found.corrected, proved)


def main(arguments: list[str] | None = None) -> int:
    """Run the main job; return the exit status."""
    parser = Parser("proofs.horseshoe", __doc__, EPILOG)
    runner.add_parameters(parser)
    runner.add_outputs(parser, CLAIMS)
    add = parser.add_argument
    add("--horizon", type=horizon, default=HORIZON, help="longest flight looked at (default 1000)")
    add("--figure", action="store_true", help="draw DIR/horseshoe.svg too (needs matplotlib)")
    options = parser.parse_args(arguments)
    if options.figure and find_spec("matplotlib") is None:
        parser.error("--figure needs matplotlib: pip install matplotlib")
    of = runner.prepared(parser, options)
    began = perf_counter()
    asked = tuple(options.only or CLAIMS)
    with progress() as tell:
        outcome = prove(of, asked, digits=options.digits, longest=options.horizon, tell=tell)
    seconds = perf_counter() - began
    try:
        made = runner.command("proofs.horseshoe", arguments)
        content = runner.write(options.out, "horseshoe", outcome.certificate, made)
        page = markdown(of, outcome.corrected, outcome.certificate, outcome.rows)
        write_atomically(options.out / "horseshoe.md", page)
        if options.figure:
            from proofs.figure import svg

            picture = svg(of, outcome.corrected)
            write_atomically(options.out / "horseshoe.svg", picture)
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    except (Undecided, OverflowError) as failure:
        print(f"{parser.prog}: no figure: {failure}", file=sys.stderr)
    correction = outcome.certificate["corrected"]
    theorem = correction and correction["theorem"]
    return runner.finish(outcome.rows, seconds, content, options, "horseshoe.json", theorem=theorem)


if __name__ == "__main__":
    sys.exit(main())
