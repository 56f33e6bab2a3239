"""What every command that proves claims shares: options, files, the screen, the check.

`run` is the command of a group of claims.
"""

from __future__ import annotations

import json
import sys
from argparse import Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import Any, NamedTuple

from intervals import Undecided
from proofs.report.figures import figures, names
from proofs.report.page import Line
from proofs.shell.cli import Parser, add_parameters, heard, parameters, progress, refusal, share
from proofs.shell.files import (
    check_folder,
    check_targets,
    refusing,
    write_files,
    write_target,
    writing,
)
from proofs.shell.groups import FILES, MANIFEST_NAME, Made, entered, printed, produce, wanted
from proofs.shell.screen import Decided, gist, say, show_verdicts
from proofs.trusted.certificate import Malformed
from proofs.trusted.files import parameters_to_json, read
from proofs.trusted.kernel.meter import DEFAULT, Exhausted
from proofs.trusted.paper import BEYOND
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, check, premises

REPORTS, RUNS = Path("reports"), Path("runs")  # where the paper's results go, and all others
PLACES = 30
EPILOG = """\
{own}Results go to DIR/{group}.json (the certificate, which is also the machine form) and
DIR/{group}.md; DIR/MANIFEST.json says which file settles which claim, its digest, and how it was
made. DIR is `reports` where the run is the paper's own, with all claims and no other option, else
`runs`.

exit status: 0 every claim asked for is decided, 1 something is undecided,
             2 bad input (nothing is written), 3 the checker disagrees (a bug)

examples:
  python -m proofs {group}
  python -m proofs {group} --only {first} --digits 40
  python -m proofs {group} --json - > {group}.json
"""


class Group(NamedTuple):
    """The command of a group of claims: its name, which is its certificate's, and its help.

    heeded: the numbers that what is proved depends on; fixed: claims that none of them changes.
    options: for the prover, with what argparse is told of each. seen: returns what floating point
    sees, in Markdown, shown beside the verdicts.
    """

    name: str
    about: str
    heeded: Sequence[str] = ()
    examples: str = ""
    options: Mapping[str, Mapping[str, Any]] = MappingProxyType({})
    seen: Callable[[Parameters, Namespace], str] | None = None
    fixed: Sequence[str] = ()

    def chosen(self, options: Namespace) -> dict[str, Any]:
        """Return the options that are given."""
        return {name: x for name in self.options if (x := getattr(options, name)) is not None}


def run(group: Group, arguments: list[str] | None = None) -> int:
    """Run the command of a group of claims; return the exit status.

    With --figure the figures that are drawn from this certificate alone are written, too.
    """
    file, parser = group.name, _parser(group)
    options, unknown = parser.parse_known_args(arguments)
    if unknown:
        parser.error(refusal(unknown, group.heeded))
    given = [name for name in group.heeded if getattr(options, name) is not None]
    if given and options.only and {*options.only} <= {*group.fixed}:
        parser.error(f"--{given[0]} would change nothing in {' '.join(options.only)}")
    if options.figure and find_spec("matplotlib") is None:
        parser.error("--figure needs matplotlib: pip install 'impact-proofs[report]'")
    try:
        numbers = parameters(options, group.heeded, beyond=file in BEYOND)
    except ValueError as error:
        parser.error(str(error))
    except Undecided as failure:
        say(f"{parser.prog}: UNDECIDED: {failure}", sys.stderr)
        return 1
    asked = wanted(file, numbers, options.only)
    if not asked:
        parser.error("all its claims are about the paper's parameters: choose some by --only")
    if "rebounding" in asked and numbers.epsilon is None:
        parser.error(f"{' '.join(asked['rebounding'])}: with restitution: give --epsilon")
    is_less = numbers != PAPER or claims_of(file) > {x for ids in asked.values() for x in ids}
    is_other = is_less or file in BEYOND or options.figure or bool(group.chosen(options))
    choose_folder(parser, options, is_other)
    if is_less and is_whole(options.out, file):
        parser.error(f"{options.out}/{file}.json is about more of the paper: choose another --out")
    return _run(group, parser, options, numbers, asked)


def _parser(group: Group) -> Parser:
    """Return the parser of the command."""
    file = group.name
    claims = [claim for ids in FILES[file].values() for claim in ids]
    exact = "Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. "
    epilog = EPILOG.format(group=file, first=claims[0], own=exact if group.heeded else "")
    parser = Parser(f"proofs {file}", group.about, epilog + group.examples)
    add_parameters(parser, group.heeded, beyond=file in BEYOND)
    add_outputs(parser, claims)
    parser.add_argument("--no-check", action="store_true", help="do not run the checker after it")
    parser.set_defaults(figure=False)
    for name, settings in group.options.items():
        parser.add_argument(f"--{name}", **settings)
    if drawn := names(file):
        pictures = ", ".join(f"{name}.svg" for name in drawn)
        help_text = f"draw {pictures} in DIR/figures, too (needs matplotlib)"
        parser.add_argument("--figure", action="store_true", help=help_text)
    return parser


def _run(
    group: Group,
    parser: Parser,
    options: Namespace,
    numbers: Parameters,
    asked: dict[str, tuple[str, ...]],
) -> int:
    """Prove the claims, write, print and check; return the exit status."""
    began, file, chosen = perf_counter(), group.name, group.chosen(options)
    with progress() as tell:
        made = produce(asked, numbers, digits=options.digits or PLACES, tell=tell, **chosen)
        if group.seen is not None:
            tell("the circle in floating point")
            made = made._replace(seen=group.seen(numbers, options))
    seconds = perf_counter() - began
    drawn = dict(_drawn(parser, file, made)) if options.figure else {}
    with refusing(parser, options.out):
        write(options.out, file, made)
        write_files(options.out / "figures", drawn)
    return finish(parser, options, made, file, seconds=seconds)


def _drawn(parser: Parser, file: str, made: Made) -> Iterator[tuple[str, str]]:
    """Draw the figures for which the certificate proves enough; say why another is not drawn."""
    documents = {file: premises(made.certificate)}
    for figure in figures(file):
        try:
            yield f"{figure.name}.svg", figure.svg(documents)
        except (Undecided, OverflowError) as failure:
            say(f"{parser.prog}: no {figure.name}: {failure}", sys.stderr)


def add_outputs(parser: Parser, claims: Sequence[str]) -> None:
    """Add the options for what is asked and where results go."""
    names = "--only", "--digits", "--out", "--json", "--quiet"
    share(parser, *names, places=PLACES, claims=claims)
    parser.add_argument("--verbose", action="store_true", help="say why, and print the numbers")
    parser.set_defaults(digits=None)


def choose_folder(parser: Parser, options: Namespace, is_other: bool) -> None:
    """Fill in the folder for results, and try what is to be written before any work is done.

    is_other: whether the results are not all those of the paper.
    """
    if options.out is None:
        options.out = RUNS if is_other or options.digits is not None else REPORTS
    check_targets(parser, options.json)
    check_folder(parser, options.out)


def is_whole(folder: Path, file: str) -> bool:
    """Whether the folder is that of the paper's results, and has this one, with all claims."""
    if folder.resolve() != REPORTS.resolve():
        return False
    try:
        there = json.loads((folder / f"{file}.json").read_text(encoding="utf-8"))
        claims = {entry["id"] for entry in there["claims"]}
        return there["parameters"] == parameters_to_json(PAPER) and claims >= claims_of(file)
    except (OSError, ValueError, KeyError, TypeError):
        return False


def claims_of(file: str) -> set[str]:
    """Return all claims of a certificate."""
    return {claim for ids in FILES[file].values() for claim in ids}


def write(folder: Path, name: str, made: Made) -> None:
    """Write a certificate and its page, and enter it in the manifest."""
    with writing(folder) as put:
        beside = f"\n{made.seen}\n" if made.seen else ""
        for kind, content in (("json", made.certificate), ("md", made.page + beside)):
            if content:
                put(f"{name}.{kind}", content)
        put(MANIFEST_NAME, entered(folder, {f"{name}.json": made.certificate}))


def finish(parser: Parser, options: Namespace, made: Made, file: str, *, seconds: float) -> int:
    """Print what was decided, have it checked, and return the exit status."""
    write_target(parser, options.json, lambda: made.certificate)
    if heard(options):
        print_lines(
            made.lines,
            options.digits or PLACES,
            verbose=options.verbose or options.digits is not None,
        )
        say(f"\n{made.seen}" if made.seen else "")
        say(f"all of it: {options.out}/{file}.md")
        summary = tally((line.verdict, not line.words) for line in made.lines)
        say(f"{summary}; proved in {seconds * 1000:.0f} ms")
    path = options.out / f"{file}.json"
    if not (options.no_check or _checked(path, quiet=not heard(options))):
        return 3
    return int(any(row.verdict is Verdict.UNDECIDED for row in made.lines))


def print_lines(lines: Sequence[Line], digits: int, *, verbose: bool) -> None:
    """Print the gist of what is true, then a line a claim; on request why, and the numbers."""
    gists = {line.id: gist(line.truth) for line in lines if line.truth is not None}
    for text in dict.fromkeys(gists.values()):
        beside = ", ".join(claim for claim, same in gists.items() if same == text)
        say(f"True ({beside}): {text}")
    say("" if gists else "no theorem is proved")
    rows = [Decided(x.id, x.verdict, x.statement, x.why) for x in lines]
    show_verdicts(rows, verbose=verbose)
    if not verbose:
        return
    numbers = {name: ends for line in lines for name, ends in line.quantities.items()}
    say("")
    for name, ends in numbers.items():
        lower, upper = printed(ends, digits).values()
        say(f"{name} in [{lower}, {upper}]")


def _checked(path: Path, quiet: bool) -> bool:
    """Run the independent checker on what was written; say loudly if it disagrees."""
    began, work, report = perf_counter(), DEFAULT, None
    while report is None:
        try:
            report = check(read(path), work)
        except Exhausted:
            work *= 8
        except (Malformed, Rejected) as error:
            say(f"THE CHECKER DISAGREES WITH THE PROVER, a bug: {error}", sys.stderr)
            return False
    if work > DEFAULT:
        say(f"it needs more work than is usual: python -m proofs check --work {work} {path}")
    if not quiet:
        spent = (perf_counter() - began) * 1000
        count = f"{len(report.claims)} claim{'s' if len(report.claims) > 1 else ''}"
        say(f"checker: accepted {path}, {count}, in {spent:.0f} ms")
    return True
