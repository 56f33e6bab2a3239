"""The rules about invariant sets: horseshoes, itineraries, and powers for the linear set."""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import bits_for
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, exp, log, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s31_horseshoe import Horseshoe
from proofs.trusted.paper.s32_sets.cantor import Excess, LinearSet, cylinder, length
from proofs.trusted.paper.s32_sets.itinerary import (
    Itinerary,
    follow,
)
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.slopes import SlopeRange

_LONGEST_WORD = 12


def itinerary(context: Context, reader: Reader) -> Itinerary:
    """Rule `itinerary`: {horseshoe, slopes: names of slope-range steps, phase}.

    Hypothesis: by f at the points of these steps, and as f increases on I0 and on I1, the orbit
    of the phase is enclosed until it leaves both, within 10 steps. Conclusion: where it went.
    """
    horseshoe_of, slopes_of, phase_of = reader.fields("horseshoe", "slopes", "phase")
    base = context.step(horseshoe_of, Horseshoe)
    names = slopes_of.items(most=10)
    slopes = [context.step(name, SlopeRange) for name in names]
    found = follow(base, slopes, phase := phase_of.number())
    if found is None:
        raise Unproved(f"the orbit of {show(phase)} is not known until it leaves I0 and I1")
    return found


def _root(context: Context, name: Reader) -> MoranRoot:
    return context.step(name, MoranRoot)


def _power(base: Fraction, exponent: Range) -> Enclosure:
    """Enclose base^s for all s in an interval, base > 0, at the precision that this deserves."""
    bits = bits_for(exponent)
    return exp(Enclosure.of(*exponent, bits) * log(base, bits))


def linear_set(context: Context, reader: Reader) -> LinearSet:
    """Rule `linear-set`: {root: name of a moran-root step}.

    Hypothesis: r0 + r1 < 1, exact. Conclusion: bounds on s and on |I|^s, in the theorem of
    `s32_sets.cantor` the dimension and the Hausdorff measure of the linear set.
    """
    (name,) = reader.fields("root")
    step = _root(context, name)
    if sum(step.ratios) >= 1:
        raise Unproved("the two parts overlap or touch: the ratios do not sum to less than 1")
    return LinearSet(step.ratios, step.root, _power(length(context.of.interval), step.root).range)


def excess(context: Context, reader: Reader) -> Excess:
    """Rule `excess`: {root: name of a moran-root step, epsilon > 0, word w of 1 to 12 letters}.

    Conclusion: bounds on (|L| + d)^s - |L|^s - d, L = I_w, d = epsilon / 2^(length of w).
    """
    root_of, epsilon_of, word_of = reader.fields("root", "epsilon", "word")
    step, epsilon, word = _root(context, root_of), epsilon_of.number(), word_of.string()
    if not 1 <= len(word) <= _LONGEST_WORD or not set(word) <= set("01"):
        raise word_of.fail("a word over 0 and 1 is expected")
    if epsilon <= 0:
        raise epsilon_of.fail("a positive number is expected")
    inside = length(cylinder(step.ratios, context.of.interval, word))
    delta = epsilon / 2 ** len(word)
    bounds = _power(inside + delta, step.root) - _power(inside, step.root)
    return Excess(step.ratios, epsilon, word, (bounds - rational(delta, bounds.bits)).range)
