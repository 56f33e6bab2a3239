"""All periodic points of a horseshoe of the plastic map: its proof, and then each of its words."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import islice

from intervals import Interval, Undecided
from intervals.rounding import float_down, float_up
from proofs.methods.orbits import PeriodicPoint, periodic_points
from proofs.methods.traces import escape_rate
from proofs.methods.words import Words
from proofs.motion.branch import Branch
from proofs.motion.horseshoe_map import ImpactMap, turn
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import FAILED, Tell
from proofs.search.s31_horseshoe import prove
from proofs.search.shifts import pairs, pieces
from proofs.search.steps import Prover
from proofs.trusted.flights import FirstImpact
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s31_horseshoe import ROWS
from proofs.trusted.paper.staying import StayingSet
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import image_arc
from proofs.trusted.verdicts import Verdict

_TRIES = 12  # of sets that are found
_AT_ONCE = 4000  # orbits
_DIGITS = 14


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

    By the rule `staying-set` f is monotone and C^1 on both, |f'| > 1. Here both images must be
    intervals of phases as well, that contain both sets: then they contain I, and the turns that are
    left out are the same on all of a set, as in `horseshoe`.
    """
    system = System(of.eta, of.nu)
    for left, right in islice(pairs(pieces(system)), _TRIES):
        with suppress(*FAILED):
            prover = Prover(system, _DIGITS, HORIZON)
            steps = [prover.slopes(list(domain)) for domain in (left, right)]
            shift = prover.stays([left, right], list(zip(steps, (left, right), strict=True)))[1]
            parts = [part for _, part in steps]
            if shift.full and all(image_arc(part).is_interval for part in parts):
                sets = replace(of, left=left, right=right, interval=(left[0], right[1]))
                images = [part.images[0] for part in parts]
                return _impact_map(sets, shift.expansion, images)
    raise Undecided(f"no two sets are found at {of.place} with both images across both")


def _impact_map(of: Parameters, least: Fraction, images: Sequence[Range]) -> ImpactMap:
    """Return the map, images being those of the left ends of I0 and I1; |f'| >= least there."""
    prover = Prover(System(of.eta, of.nu), _DIGITS, HORIZON)
    turns, parts = list[int](), list[FirstImpact]()
    for domain, ends in zip((of.left, of.right), images, strict=True):
        around = Fraction(float_down(domain[0])), Fraction(float_up(domain[1]))
        found = prover.impacts(around)
        time = Branch(found, prover.bits).flight(domain[0], domain[0])[1]
        whole = (Interval(*time) + domain[0] - Interval(*ends)) / turn(53)
        count = round(whole.mid)
        if not (whole.contains(count) and whole.wid < 1):
            raise ArithmeticError("an impact is at another phase than it was proved to be")
        turns.append(count)
        parts += [part for _, part in found]
    return ImpactMap(of, least, tuple(parts), (turns[0], turns[1]))


def _refusal(why: str, corrected: StayingSet | None) -> str:
    """Say why there is no proof, and on which sets there is one."""
    if corrected is None:
        return f"no horseshoe is proved: {why}"
    return f"no horseshoe is proved: {why}; it is one on {corrected.sets}"


def of_words(
    of: ImpactMap, asked: str | int, places: int | None, tell: Tell
) -> list[PeriodicPoint]:
    """Return the points of a word and its rotations, or of all words of a length."""
    words = Words.rotations(asked) if isinstance(asked, str) else Words.of_length(asked)
    return periodic_points(of, words, places, tell)


def of_orbits(of: ImpactMap, period: int, places: int | None, tell: Tell) -> list[PeriodicPoint]:
    """Return a point of each orbit of a least period."""
    rows: list[PeriodicPoint] = []
    for words in Words.of_orbits(period, _AT_ONCE):
        points = periodic_points(of, words, places, partial(_after, len(rows), tell))
        rows += [points[cycle[0]] for cycle in words.cycles]
    return rows


def escape_by_cycles(
    of: ImpactMap, most: int, places: int | None, precision: int, tell: Tell
) -> Range:
    """Return the rate at which orbits escape, by the multipliers of those up to a period."""
    found = [of_orbits(of, n, places, tell) for n in range(1, most + 1)]
    rate = escape_rate(
        [[Interval(*x.multiplier, precision=precision) for x in row] for row in found]
    )
    return rate.inf, rate.sup


def _after(orbits: int, tell: Tell, stage: str) -> None:
    """Tell a stage, and how many orbits are done."""
    tell(f"{orbits} orbits; {stage}")
