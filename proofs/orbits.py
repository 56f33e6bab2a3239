"""All periodic points of the plastic impact map that a horseshoe has, one for each word.

A word such as 0010 says in which of I0, I1 the successive impacts lie. First the horseshoe is
proved: f is C^1 and monotone on I0 and I1, |f'| > 1, and both images cover I, which reaches from
the left end of I0 to the right end of I1. For sets that are given, f increases there and the phases
between them leave I; at other eta and nu they are found if they are not given. So each word has
exactly one phase with that itinerary that repeats it for ever, and no other phase is periodic with
its orbit in I0 and I1. Then each phase is enclosed, with its multiplier: the derivative of f^n
there, n the length of the word (for a word such as 0101, of period 2, the square of that of its
orbit). With --cycles the rate at which orbits escape follows, twice: proved by the transfer
operator, and from the multipliers of the shorter orbits alone.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.orbits")

import csv
import io
import sys
from argparse import ArgumentTypeError, Namespace
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import islice
from time import perf_counter

from intervals import Interval, IntervalError, Undecided
from proofs.methods.orbits import PeriodicPoint, periodic_points
from proofs.methods.words import Words
from proofs.motion.horseshoe_map import ImpactMap
from proofs.motion.impact import HORIZON
from proofs.motion.phase import turn
from proofs.motion.slope_cover import slope_cover
from proofs.motion.system import System
from proofs.search.s31_horseshoe import prove
from proofs.search.shifts import pairs, pieces
from proofs.search.steps import Prover
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, whole
from proofs.shell.files import write_target
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range, show, show_range
from proofs.trusted.paper.s31_horseshoe import ROWS
from proofs.trusted.paper.staying import StayingSet, staying_set
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.slopes import image_arc
from proofs.trusted.verdicts import Verdict

LEFT, RIGHT = (Fraction("1.1"), Fraction("1.15")), PAPER.right
_TRIES = 12  # of sets that are found
_BOXES = 16  # of each branch, for the proof that f is C^1 there
_LONGEST_PERIOD = 16
_LONGEST_ORBITS = 20
_AT_ONCE = 4000  # orbits
_LONGEST_WORD = 256
_SHOWN = 16  # rows on the screen
_EXPANSION = 10  # the longest period for the escape rate: more than 20 digits of it
_FAST_DIGITS = 14
_ENDS = ("lower", "upper")

EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. The table shows the first
rows only; --csv and --json have all of them, in bounds that are rounded outward.

exit status: 0 all points are proved and enclosed, 1 undecided: the horseshoe is not proved,
             2 bad input

examples:
  python -m proofs.orbits --period 3
  python -m proofs.orbits --word 0010 --digits 50
  python -m proofs.orbits --cycles 20 --fast --csv orbits.csv
  python -m proofs.orbits --eta 0.103 --nu 0.541 --period 2     the sets are found there
  python -m proofs.orbits --period 12 --csv orbits.csv
  python -m proofs.orbits --period 16 --fast --json - > orbits.json
"""


def horseshoe(of: Parameters) -> ImpactMap:
    """Prove that I0 and I1 make a full horseshoe, by the claims H1 and H5; Undecided if not.

    The proof of H5 has f(left end) and f(right end), mod 2 pi, in [0, 2 pi) on both sides of I,
    and f increasing by less than 2 pi between them; so the turns that f(phi) = phi + t leaves
    out are the same on all of I_j, those that take phi + t at the left end to its f.
    """
    proofs = prove(of, ("H1", "H5")).proofs
    known = {claim: [found for _, found in proof] for claim, proof in proofs.items()}
    decisions = {row.id: row.decide(of, known[row.id]) for row in ROWS if row.id in known}
    for claim, decision in decisions.items():
        if decision.verdict is not Verdict.VERIFIED:
            beside = next((x for x in known[claim] if isinstance(x, StayingSet)), None)
            raise Undecided(_refusal(decision.why, beside))
    expanding, covering = decisions["H1"], decisions["H5"]
    least = min(expanding.quantities[f"slope_min_I{j}"][0] for j in (0, 1))
    if not least > 1:
        raise Undecided("f' > 1 is not proved")
    images = [covering.quantities[f"image_low_I{j}"] for j in (0, 1)]
    return _impact_map(of, least, images)


def own_horseshoe(of: Parameters) -> ImpactMap:
    """Prove a full shift on two sets that are found, f increasing or decreasing on each.

    Its theorem, `staying_set`, has f monotone and C^1 on both, |f'| > 1. Here both images must be
    intervals of phases as well, that contain both sets: then they contain I, and the turns that are
    left out are the same on all of a set, as in `horseshoe`.
    """
    system = System(of.eta, of.nu)
    for left, right in islice(pairs(pieces(system)), _TRIES):
        with suppress(Undecided, Unproved):
            prover = Prover(system, _FAST_DIGITS, HORIZON)
            parts = [prover.slopes(list(domain))[1] for domain in (left, right)]
            shift = staying_set([part.domain for part in parts], parts, [])
            if shift.full and all(image_arc(part).is_interval for part in parts):
                sets = replace(of, left=left, right=right, interval=(left[0], right[1]))
                images = [part.images[0] for part in parts]
                return _impact_map(sets, shift.expansion, images)
    raise Undecided(f"no two sets are found at {of.place} with both images across both")


def _impact_map(of: Parameters, least: Fraction, images: Sequence[Range]) -> ImpactMap:
    """Return the map, images being those of the left ends of I0 and I1; |f'| >= least there."""
    system = System(of.eta, of.nu)
    covers = slope_cover(system, of.left, _BOXES), slope_cover(system, of.right, _BOXES)
    turns = []
    for cover, domain, ends in zip(covers, (of.left, of.right), images, strict=True):
        image = Interval(*ends)
        whole = (cover.times[0].item() + domain[0] - image) / turn(53)
        count = round(whole.mid)
        if not (whole.contains(count) and whole.wid < 1):
            raise ArithmeticError("an impact is at another phase than it was proved to be")
        turns.append(count)
    return ImpactMap(of, least, covers, (turns[0], turns[1]))


def _refusal(why: str, corrected: StayingSet | None) -> str:
    """Say why there is no proof, and on which sets there is one."""
    if corrected is None:
        return f"no horseshoe is proved: {why}"
    return f"no horseshoe is proved: {why}; it is one on {corrected.sets}"


def main(arguments: list[str] | None = None) -> int:
    """Enclose the periodic points asked for; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        of = _parameters(options)
    except ValueError as error:
        parser.error(str(error))
    names = ("word", "period", "cycles")
    asked = next(f"{name} {x}" for name in names if (x := getattr(options, name)))
    asked += ", binary64" if options.fast else f", {options.digits} digits"
    with answering(parser, options, asked, options.csv):
        return _answer(parser, of, options)


def _answer(parser: Parser, of: Parameters, options: Namespace) -> int:
    """Print or write the periodic points; return the exit status."""
    places = None if options.fast else options.digits
    began = perf_counter()
    try:
        options.tell("the horseshoe")
        proved = horseshoe(of) if options.left else own_horseshoe(of)
        of = proved.of
        found = _found(proved, options, places)
    except (Undecided, IntervalError, OverflowError) as failure:
        print(f"{parser.prog}: UNDECIDED: {failure}", file=sys.stderr)
        return 1
    seconds = perf_counter() - began
    options.tell("")
    shown = options.digits if places else min(options.digits, _FAST_DIGITS)
    rows = [_row(point, shown) for point in found]
    write_target(parser, options.csv, lambda: _csv(rows))
    answer: Answer = {"parameters": _machine_form(of, places), "orbits": rows}
    if options.cycles:
        answer["escape"] = _escape(proved, options, places, shown)
    give(parser, options, answer, lambda _: _text(of, rows, answer.get("escape"), seconds))
    return 0


def _found(of: ImpactMap, options: Namespace, places: int | None) -> list[PeriodicPoint]:
    """Return the points of the words asked for, or one of each orbit."""
    if not options.cycles:
        word, period = options.word, options.period
        words = Words.rotations(word) if word else Words.of_length(period)
        return periodic_points(of, words, places, options.tell)
    return _cycles(of, options.cycles, options, places)


def _cycles(
    of: ImpactMap, period: int, options: Namespace, places: int | None
) -> list[PeriodicPoint]:
    """Return a point of each orbit of a least period."""
    rows: list[PeriodicPoint] = []
    for words in Words.of_orbits(period, _AT_ONCE):
        tell = partial(_after, len(rows), options.tell)
        points = periodic_points(of, words, places, tell)
        rows += [points[cycle[0]] for cycle in words.cycles]
    return rows


def _escape(of: ImpactMap, options: Namespace, places: int | None, shown: int) -> Answer:
    """Return the escape rate by the operator, if it is proved, and by the cycles."""
    from proofs.methods.traces import escape_rate
    from proofs.search.s32_dimension import escape

    options.tell("the escape rate")
    most, precision = min(options.cycles, _EXPANSION), 60 + shown * 10 // 3
    found = [_cycles(of, n, options, places) for n in range(1, most + 1)]
    multipliers = [[Interval(*x.multiplier, precision=precision) for x in row] for row in found]
    proved, rate = escape(of.of, shown, options.tell), escape_rate(multipliers)
    return {
        "rate": proved and bounds(proved.rate, shown),
        "statement": proved and proved.sentence,
        "by_cycles": bounds((rate.inf, rate.sup), shown),
        "periods": most,
    }


def _after(orbits: int, tell: Callable[[str], None], stage: str) -> None:
    """Tell a stage, and how many orbits are done."""
    tell(f"{orbits} orbits; {stage}")


def _parser() -> Parser:
    parser = Parser("proofs.orbits", __doc__, EPILOG)
    which = parser.add_mutually_exclusive_group(required=True)
    add, period = which.add_argument, whole("a period", _LONGEST_PERIOD)
    add("--period", type=period, metavar="N", help=f"all words of length N, 1 to {_LONGEST_PERIOD}")
    help_text = f"all orbits of least period N, 1 to {_LONGEST_ORBITS}, a row each"
    add("--cycles", type=whole("a period", _LONGEST_ORBITS), metavar="N", help=help_text)
    add("--word", type=_word, metavar="W", help="one word of 0 and 1, with its rotations")
    add = parser.add_argument
    add("--fast", action="store_true", help="binary64 only, some 12 digits")
    add("--eta", type=number, default=PAPER.eta, help="frequency ratio (default 0.2121)")
    add("--nu", type=number, default=PAPER.nu, help="amplitude -beta/p (default -0.2)")
    for name, default in (("left", LEFT), ("right", RIGHT)):
        help_text = f"default {show(default[0])} {show(default[1])}; found at other eta, nu"
        add(f"--{name}", type=number, nargs=2, metavar=("A", "B"), help=help_text)
    add("--csv", metavar="FILE", help="write all rows to a file, or - for the screen")
    add_answer(parser, 25)
    return parser


def _word(text: str) -> str:
    if not 1 <= len(text) <= _LONGEST_WORD or set(text) - {"0", "1"}:
        raise ArgumentTypeError(
            f"a word is made of 1 to {_LONGEST_WORD} letters 0 and 1, not {text[:40]!r}"
        )
    return text


def _parameters(options: Namespace) -> Parameters:
    """Return the horseshoe's numbers; f' >= 1 is what is asked of the slopes.

    At another oscillator than the paper's, I0 and I1 are given both, or found.
    """
    elsewhere = (options.eta, options.nu) != (PAPER.eta, PAPER.nu)
    if elsewhere and (options.left is None) != (options.right is None):
        raise ValueError(
            "--left and --right go together at this oscillator; without, both are found"
        )
    left, right = tuple(options.left or LEFT), tuple(options.right or RIGHT)
    options.left = options.left or (None if elsewhere else LEFT)
    return replace(
        PAPER,
        eta=options.eta,
        nu=options.nu,
        left=left,
        right=right,
        interval=(left[0], right[1]),
        slopes=(Fraction(1), Fraction(1)),
        ratios=None,
        printed_s0=None,
        epsilon=None,
        velocities=None,
        reach=None,
    )


def _row(point: PeriodicPoint, places: int) -> Answer:
    """Return the JSON object of a point."""
    ends = {"phase": bounds(point.point, places), "multiplier": bounds(point.multiplier, places)}
    return {"word": point.word, "period": point.period, **ends}


def _machine_form(of: Parameters, places: int | None) -> Answer:
    """Return the JSON object of what was asked."""
    sets = {"left": of.left, "right": of.right, "interval": of.interval}
    return {
        "eta": show(of.eta),
        "nu": show(of.nu),
        **{name: [show(x) for x in ends] for name, ends in sets.items()},
        "digits": places,
    }


def _csv(rows: list[Answer]) -> str:
    target = io.StringIO()
    table = csv.writer(target, lineterminator="\n")
    names = ("phase", "multiplier")
    table.writerow(["word", "period", *(f"{name}_{end}" for name in names for end in _ENDS)])
    for row in rows:
        bounds = (row[name][end] for name in names for end in _ENDS)
        table.writerow([row["word"], row["period"], *bounds])
    return target.getvalue()


def _text(of: Parameters, rows: list[Answer], escape: Answer | None, seconds: float) -> str:
    said = []
    for row in rows[:_SHOWN]:
        said.append(f"{row['word']}  period {row['period']}")
        said += [*lines("phase", row["phase"], 10), *lines("multiplier", row["multiplier"], 10)]
    if len(rows) > _SHOWN:
        said.append(f"... and {len(rows) - _SHOWN} more: --csv and --json have all of them")
    sets = f"in I0 = {show_range(of.left)}, I1 = {show_range(of.right)}"
    if escape:
        said += ["", *_rates(escape)]
        what = (
            f"{len(rows)} orbits of least period {rows[0]['period']} {sets}, all that there are, "
            "each with the phase of the first of its words"
        )
    else:
        orbits = sum(Fraction(1, row["period"]) for row in rows)
        what = (
            f"{len(rows)} words of length {len(rows[0]['word'])}: one periodic phase each, proved "
            f"to exist and to be the only one of its word {sets}; orbits: {orbits}"
        )
    said.append(f"\n{what}, in {seconds:.2f} s")
    return "\n".join(said)


def _rates(escape: Answer) -> list[str]:
    """Say what is known of the escape rate."""
    cycles = lines("", escape["by_cycles"], 0)
    said = [
        "escape rate by the orbits of the periods up to "
        f"{escape['periods']} (what longer ones add is not bounded):",
        *cycles,
    ]
    if not escape["rate"]:
        return [*said, "no bounds are proved by the transfer operator"]
    proved = f"proved by the transfer operator, -log of its growth: {escape['statement']}"
    return [*said, proved, *lines("", escape["rate"], 0)]
