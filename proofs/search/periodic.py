"""All periodic points of a horseshoe of the plastic map: its proof, and then each of its words."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice

from intervals import Interval, Undecided
from intervals.rounding import float_down, float_up
from proofs.methods.orbits import PeriodicPoint, periodic_points
from proofs.methods.words import Words
from proofs.motion.horseshoe_map import ImpactMap, turn
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import FAILED, Tell
from proofs.search.s31_horseshoe import prove
from proofs.search.shifts import pairs, pieces
from proofs.search.steps import Prover
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.images import image_arc
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s31_horseshoe import horseshoes
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Found

_TRIES = 12  # of sets that are found
_DIGITS = 14


def horseshoe(statement: Parameters) -> ImpactMap:
    """Prove that I0 and I1 make a full horseshoe; Undecided if not, with sets that do."""
    try:
        return _full_shift(statement, statement.left, statement.right)
    except FAILED as failure:
        conclusions = [conclusion for _, conclusion in prove(statement, ("H5",)).proofs["H5"]]
        beside = next(
            (f"; it is one on {x.sets}" for x in horseshoes(Found(statement, conclusions))), ""
        )
        raise Undecided(f"no horseshoe is proved: {failure}{beside}") from None


def own_horseshoe(statement: Parameters) -> ImpactMap:
    """Prove a full shift on two sets that are found, f increasing or decreasing on each."""
    for left, right in islice(pairs(pieces(System(statement.eta, statement.nu))), _TRIES):
        with suppress(*FAILED):
            return _full_shift(statement, left, right)
    raise Undecided(f"no two sets are found at {statement.place} with both images across both")


def _full_shift(statement: Parameters, left: Range, right: Range) -> ImpactMap:
    """Prove that f maps two sets over each other, and return it there.

    By the rule `staying-set` f is monotone and C^1 on both, |f'| > 1. Here both images must be
    intervals of phases as well, that contain both sets: so the turns that f(phi) = phi + t leaves
    out are the same on all of a set, those that take phi + t at the left end to its f.
    """
    prover = Prover(System(statement.eta, statement.nu), _DIGITS, HORIZON)
    steps = [prover.slopes(list(domain)) for domain in (left, right)]
    shift = prover.stays([left, right], list(zip(steps, (left, right), strict=True)))[1]
    arcs = [image_arc(part) for _, part in steps]
    if not (shift.full and all(arc.is_interval for arc in arcs)):
        raise Undecided("; ".join(arc.brief for arc in arcs))
    turns, windows = list[int](), dict[Range, Range]()
    for domain, (_, slope_range) in zip((left, right), steps, strict=True):
        around = Fraction(float_down(domain[0])), Fraction(float_up(domain[1]))
        windows |= prover.windows(around)
        time = prover.impact_map.impact(enclosed((domain[:1] * 2,), prover.bits)).range
        counted = (Interval(*time) + domain[0] - Interval(*slope_range.images[0])) / turn(53)
        count = round(counted.mid)
        if not (counted.contains(count) and counted.wid < 1):
            raise ArithmeticError("an impact is at another phase than it was proved to be")
        turns.append(count)
    sets = replace(statement, left=left, right=right, interval=(left[0], right[1]))
    return ImpactMap(sets, shift.expansion, windows, (turns[0], turns[1]))


def of_words(
    horseshoe_map: ImpactMap, asked: str | int, places: int, tell: Tell
) -> list[PeriodicPoint]:
    """Return the points of a word and its rotations, or of all words of a length."""
    words = Words.rotations(asked) if isinstance(asked, str) else Words.of_length(asked)
    return periodic_points(horseshoe_map, words, places, tell)
