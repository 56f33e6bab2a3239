"""A plane of two parameters in cells, with what is proved at all systems of each.

The parameters are (eta, nu) of the paper's oscillator, or by --range any two of a system or of a
map of your own. An adaptive quadtree of boxes: each cell has a proof of what is asked, or of its
opposite, or is cut in four down to the depth; what is left is undecided. DIR/atlas.jsonl has a
line for each cell, with its certificate; a run that was ended in any way goes on where it was.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.atlas")

import sys
from argparse import ArgumentTypeError, Namespace
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from proofs.commands.system import add_subject, subject
from proofs.methods.ends import ends_of
from proofs.methods.grammar import name as spelled
from proofs.plane import summary
from proofs.plane.head import executor, run
from proofs.plane.store import LINES, SAMPLE, Held, Store, file_of, opened
from proofs.report.build import INSTALL, missing
from proofs.shell.cli import Parser, heard, number, progress, share, whole
from proofs.shell.files import check_folder, check_targets, write_target, writing
from proofs.shell.screen import say
from proofs.trusted.atlas import DEEPEST, Region, proved
from proofs.trusted.certificate import Malformed, parse, texts
from proofs.trusted.files import render
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.numbers import Range
from proofs.trusted.questions import OF_MAPS, QUESTIONS
from proofs.trusted.subjects import Oscillators, Systems
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected

FOLDER = Path("runs/atlas")
_DEPTH, _CHUNK, _MOST_JOBS = 5, 16, 1000
EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. A depth of 5 makes cells of a
32nd of the region's sides at the smallest; a greater depth goes on with what is undecided.

DIR has atlas.jsonl, which `proofs.check` proves again, line by line, and pandas and DuckDB read;
sample.jsonl, the same of ten cells; atlas.json, areas and a digest; and, by the extra `report`,
atlas.svg and atlas.png, with curves of single-impact orbits on top; atlas.html, where each cell
says what is proved in it; and atlas.sqlite, with which it goes on. --executor dask:HOST:PORT sends
the cells to a Dask scheduler, dask: to one of this machine (pip install 'impact-proofs[cluster]').

exit status: 0 every cell is decided, 1 some are undecided, 2 bad input, or another run holds DIR

examples:
  python -m proofs atlas --eta 0.2112 0.2136 --nu -0.202 -0.198 --ask horseshoe
  python -m proofs atlas --eta 0.2 0.22 --nu -0.22 -0.2 --ask attractor --depth 6 --jobs 2
  python -m proofs atlas --eta 0.2 0.5 --nu 0.2 0.5 --ask orbits --epsilon 0.3 --depth 7
  python -m proofs atlas --eta 0.212 0.216 --nu -0.202 -0.198 --ask entropy:3
  python -m proofs atlas mine.toml --range g 0.05 0.2 --range e 0.3 0.7 --ask orbits:2 --out runs/b
  python -m proofs atlas --map "1 - a*x^2 + y" "b*x" --range a 1 2 --range b 0 0.3 --ask stable:1
  python -m proofs atlas --out runs/atlas --cell 0.2121 -0.2
  python -m proofs atlas --out runs/atlas --lines
  python -m proofs check runs/atlas/atlas.jsonl
"""


def main(arguments: list[str] | None = None) -> int:
    """Make an atlas, go on with one, or look up a cell; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    options.parser = parser
    region = _region(parser, options)
    if options.lines and options.json:
        parser.error("--lines has no machine form: leave out --json")
    check_folder(parser, options.out)
    check_targets(parser, options.json)
    try:
        with opened(options.out, region) as store:
            if options.cell:
                return _show_cell(parser, options, store)
            if options.lines:
                with writing(options.out) as put:
                    put(LINES, store.lines())
                return 0
            return _make(parser, options, store)
    except (Held, Malformed) as failure:
        parser.error(str(failure))
    except Rejected as failure:
        say(f"{parser.prog}: {failure}", sys.stderr)
        return 1


def _parser() -> Parser:
    parser = Parser("proofs atlas", __doc__, EPILOG)
    parser.add_argument("--eta", type=number, nargs=2, metavar=("A", "B"), help="frequency ratios")
    parser.add_argument("--nu", type=number, nargs=2, metavar=("A", "B"), help="amplitudes -beta/p")
    add_subject(parser)
    ranges = "two parameters of it, and from where to where"
    parser.add_argument("--range", nargs=3, action="append", metavar=("P", "A", "B"), help=ranges)
    restitution = "coefficient of restitution, one or a range; without it impacts are plastic"
    parser.add_argument("--epsilon", type=number, nargs="+", metavar="X", help=restitution)
    questions = f"one of {', '.join(QUESTIONS)}; of other systems {OF_MAPS}"
    parser.add_argument("--ask", metavar="QUESTION", help=questions)
    depth = f"how often cells are cut at most (default {_DEPTH})"
    read = whole("a depth", DEEPEST, 0)
    parser.add_argument("--depth", type=read, default=_DEPTH, metavar="D", help=depth)
    jobs = "processes (default 1)"
    parser.add_argument(
        "--jobs", type=whole("--jobs", _MOST_JOBS), default=1, metavar="N", help=jobs
    )
    parser.add_argument("--executor", type=_executor, default="here", metavar="dask:ADDRESS")
    chunk = f"cells that go out together (default {_CHUNK})"
    parser.add_argument(
        "--chunk", type=whole("--chunk", 10_000), default=_CHUNK, metavar="N", help=chunk
    )
    cell = "say what is proved in the cell that holds this point, and write its certificate"
    looking = parser.add_mutually_exclusive_group()
    looking.add_argument("--cell", type=number, nargs=2, metavar=("A", "B"), help=cell)
    lines = f"write {LINES} of what there is, and look at no cell"
    looking.add_argument("--lines", action="store_true", help=lines)
    share(parser, "--out", "--json", "--quiet")
    parser.set_defaults(out=FOLDER)
    return parser


def _executor(text: str) -> str:
    if text != "here" and not text.startswith("dask:"):
        raise ArgumentTypeError(f"here, dask: or dask:ADDRESS is expected, not {text[:40]!r}")
    if text != "here" and find_spec("distributed") is None:
        raise ArgumentTypeError("needs dask: pip install 'impact-proofs[cluster]'")
    return text


def _region(parser: Parser, options: Namespace) -> Region | None:
    """Return the region asked for; None where an atlas that is there is meant."""
    given = [options.eta, options.nu, options.ask]
    own = [options.file, options.example, options.map, options.range]
    try:
        if any(own):
            if any((options.eta, options.nu, options.epsilon)):
                parser.error("--eta, --nu and --epsilon are the oscillator's, without FILE")
            return _own_region(parser, options)
        if not any((*given, options.epsilon)):
            return None
        if not all(given):
            parser.error("--eta, --nu and --ask go together")
        sides = tuple(options.eta), tuple(options.nu)
        return Region(*sides, options.ask, Oscillators(_epsilon(options.epsilon)))
    except ValueError as failure:
        parser.error(str(failure))


def _own_region(parser: Parser, options: Namespace) -> Region:
    """Return the region of a system's or a map's parameters that is asked for."""
    if not options.ask or len(options.range or ()) != 2:
        parser.error("of a system --ask and two times --range P A B are expected")
    sides = [(name, ends_of((low, high))) for name, low, high in options.range]
    system = subject(options, dict(sides))
    (one, first), (two, second) = sides
    where = tuple(system.region())
    made = Systems(system.functions, system.function, (spelled(one), spelled(two)), where)
    return Region(first, second, options.ask, made)


def _epsilon(given: list[Fraction] | None) -> Range | None:
    """Return the range of epsilon; None where impacts are plastic."""
    if given is None or not any(given):
        return None
    if len(given) > 2:
        raise ValueError("epsilon: a number or a range in [0, 1) is expected")
    return given[0], given[-1]


def _make(parser: Parser, options: Namespace, store: Store) -> int:
    """Do what is left to do, then print and write what there is."""
    try:
        with progress() as tell, executor(options.jobs, options.executor) as doing:
            done = run(store, options.depth, doing, options.chunk, tell)
    except KeyboardInterrupt as stop:
        command = f"python -m proofs atlas --out {options.out} --depth {options.depth}"
        stop.add_note(f"what is done is saved, and {command} goes on")
        raise
    made = summary.summary(store)
    with writing(options.out) as put:
        put(LINES, store.lines())
        put("atlas.json", render(made))
        put(SAMPLE, store.sample())
    shown = LINES
    if packages := missing():
        say(f"{parser.prog}: no pictures and page, {', '.join(packages)} missing: {INSTALL}")
    else:
        with progress() as tell:
            tell("pictures")
            shown = _draw(options.out, store, made)
    write_target(parser, options.json, lambda: render(made))
    if heard(options):
        for line in summary.lines(made, store.region):
            say(line)
        work = int(made["checker_work"])
        more = f" --work {work}" if work > DEFAULT else ""
        say(f"{done} cells looked at now; python -m proofs check {options.out / LINES}{more}")
        say(f"all of it: {options.out / shown}")
    return int(made["cells"].get(Verdict.UNDECIDED.value, 0) > 0)


def _draw(folder: Path, store: Store, made: dict[str, Any]) -> str:
    """Write the pictures, and the page with all cells unless these are too many; return which."""
    from proofs.plane import page, picture
    from proofs.report.figures.style import style, svg_of

    files: dict[str, str] = {}
    shown = picture.shown(store, made)
    with style("atlas"):
        drawing = picture.picture(store.region, shown)
        image = picture.png(drawing)
        files["atlas.svg"] = svg_of(drawing, "atlas", made["holds"])
    if sum(made["cells"].values()) <= page.MOST:
        files["atlas.html"] = page.page(store, shown)
    with writing(folder) as put:
        put("atlas.png", image)
        for name, content in files.items():
            put(name, content)
    return list(files)[-1]


def _show_cell(parser: Parser, options: Namespace, store: Store) -> int:
    """Print what is proved in a cell, and write its certificate."""
    cell = summary.at(store, *options.cell)
    if cell is None:
        parser.error("no cell of this atlas holds the point")
    sides = store.region.sides(cell.key)
    path, verdict, says = None, cell.verdict, cell.conclusion
    if cell.certificate is not None:  # whatever the store says of it
        verdict, _, says = proved(store.region, cell.key, parse(cell.text))
        path = options.out / file_of(cell.key)
        with writing(options.out) as put:
            put(path.name, cell.text)
    made = {
        "cell": cell.key,
        "box": dict(zip(store.region.names, map(texts, sides), strict=True)),
        "verdict": verdict,
        "conclusion": says,
        "certificate": None if path is None else str(path),
    }
    write_target(parser, options.json, lambda: render(made))
    if heard(options):
        say(f"{verdict}: {says}")
        if path is not None:
            say(f"python -m proofs check {path}")
    return int(path is None)
