"""Is the impact map a horseshoe on the printed sets? Claims H1-H6, H11, H16, N1 and N2.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.
"""

import sys
from collections.abc import Sequence
from fractions import Fraction
from time import perf_counter

from intervals import Undecided
from proofs.motion.impact import HORIZON
from proofs.report.page import markdown
from proofs.search import s31_horseshoe as plastic
from proofs.search.evidence import Tell
from proofs.shell import groups, runner
from proofs.shell.cli import Parser, counting, horizon, progress
from proofs.shell.groups import Made
from proofs.trusted.certificate import render, write_atomically
from proofs.trusted.facts import Parameters

RESTITUTION = ("N1", "N2")
CLAIMS = (*plastic.CLAIMS, *RESTITUTION)
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


def produce(
    of: Parameters,
    claims: Sequence[str] = CLAIMS,
    *,
    digits: int = 30,
    longest: Fraction = HORIZON,
    tell: Tell = lambda stage: None,
) -> Made:
    """Decide the claims asked for, of the plastic map and of the one with restitution."""
    flat = [claim for claim in plastic.CLAIMS if claim in claims]
    found = plastic.prove(of, flat, digits=digits, horizon=longest, tell=tell)
    rows, proved = list(found.rows), found.certificate
    others = [claim for claim in RESTITUTION if claim in claims]
    if others:
        more, also = groups.settle("nonplastic", of, others, digits=digits, tell=tell)
        rows += more
        steps = proved["steps"] | also["steps"]
        entries = proved["claims"] + also["claims"]
        proved = groups.certificate(of, steps, entries, proved["corrected"])
    page = markdown(of, found.corrected, proved, rows)
    theorem = proved["corrected"] and proved["corrected"]["theorem"]
    return Made(rows, render(proved), page, theorem, found.corrected)


def main(arguments: list[str] | None = None) -> int:
    """Run the main job; return the exit status."""
    parser = Parser("proofs.horseshoe", __doc__, EPILOG)
    runner.add_parameters(parser)
    runner.add_outputs(parser, CLAIMS)
    longest = "longest flight looked at (default 1000)"
    parser.add_argument("--horizon", type=horizon, default=HORIZON, help=longest)
    runner.add_figure(parser, "horseshoe")
    options = parser.parse_args(arguments)
    runner.check_figure(parser, options)
    of = runner.prepared(parser, options)
    began = perf_counter()
    asked = tuple(options.only or CLAIMS)
    with counting(options.stats) as counts, progress() as tell:
        made = produce(of, asked, digits=options.digits, longest=options.horizon, tell=tell)
    seconds = perf_counter() - began
    try:
        by = runner.command("proofs.horseshoe", arguments)
        runner.write(options.out, "horseshoe", made.certificate, made.page, by)
        if options.figure:
            from proofs.report.horseshoe_figure import svg

            write_atomically(options.out / "horseshoe.svg", svg(of, made.corrected))
    except OSError as error:
        parser.error(f"cannot write to {options.out}: {error.strerror or error}")
    except (Undecided, OverflowError) as failure:
        print(f"{parser.prog}: no figure: {failure}", file=sys.stderr)
    return runner.finish(made, seconds, options, "horseshoe.json", counts)


if __name__ == "__main__":
    sys.exit(main())
