"""The rules about invariant sets: horseshoes, itineraries, and powers for the linear set."""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.facts import Avoids, Facts, MoranRoot, Parameters, Range, SlopeRange, show
from proofs.trusted.flights import Known, Rule, bits_for, earlier
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, exp, log, rational
from proofs.trusted.paper.s32_sets.cantor import Excess, LinearSet, cylinder, length
from proofs.trusted.paper.s32_sets.itinerary import (
    Horseshoe,
    Itinerary,
    follow,
    horseshoe_sets,
    obstacle,
)

_LONGEST_WORD = 12


def horseshoe(of: Parameters, known: Known, reader: Reader) -> Horseshoe:
    """Rule `horseshoe`: {left: I0, right: I1, slopes: [lo, hi], proof: names of steps}.

    Hypotheses: the slope-range and avoids steps named prove H1 to H6 for these sets and slopes,
    I from the left end of I0 to the right end of I1, and lo > 1. Conclusion: that, hence the
    theorem of `proofs.trusted.statements.theorem` at these numbers.
    """
    left, right, slopes, proof = reader.fields("left", "right", "slopes", "proof")
    facts, numbers = Facts(), (left.range(), right.range(), slopes.range())
    try:
        sets = horseshoe_sets(of, *numbers)
    except ValueError as error:
        raise reader.fail(str(error)) from None
    for name in proof.items(least=1):
        step = known.get(name.string())
        if not isinstance(step, SlopeRange | Avoids):
            raise name.fail("names no earlier slope-range or avoids step")
        facts.add(sets, step)
    missing = obstacle(sets, facts)
    if missing is not None:
        raise Unproved(f"no horseshoe: {missing}")
    return Horseshoe(sets)


def itinerary(of: Parameters, known: Known, reader: Reader) -> Itinerary:
    """Rule `itinerary`: {horseshoe, slopes: names of slope-range steps, phase}.

    Hypothesis: by f at the points of these steps, and as f increases on I0 and on I1, the orbit
    of the phase is enclosed until it leaves both, within 10 steps. Conclusion: where it went.
    """
    horseshoe_of, slopes_of, phase_of = reader.fields("horseshoe", "slopes", "phase")
    base = earlier(known, horseshoe_of, Horseshoe, "horseshoe")
    names = slopes_of.items(most=10)
    slopes = [earlier(known, name, SlopeRange, "slope-range") for name in names]
    found = follow(base.sets, slopes, phase := phase_of.number())
    if found is None:
        raise Unproved(f"the orbit of {show(phase)} is not known until it leaves I0 and I1")
    return found


def _root(known: Known, name: Reader) -> MoranRoot:
    return earlier(known, name, MoranRoot, "moran-root")


def _power(base: Fraction, exponent: Range) -> Enclosure:
    """Enclose base^s for all s in an interval, base > 0, at the precision that this deserves."""
    bits = bits_for(exponent)
    return exp(Enclosure.of(*exponent, bits) * log(base, bits))


def linear_set(of: Parameters, known: Known, reader: Reader) -> LinearSet:
    """Rule `linear-set`: {root: name of a moran-root step}.

    Hypothesis: r0 + r1 < 1, exact. Conclusion: bounds on s and on |I|^s, in the theorem of
    `s32_sets.cantor` the dimension and the Hausdorff measure of the linear set.
    """
    (name,) = reader.fields("root")
    step = _root(known, name)
    if sum(step.ratios) >= 1:
        raise Unproved("the two parts overlap or touch: the ratios do not sum to less than 1")
    reader.charge(10, bits_for(step.root))
    return LinearSet(step.ratios, step.root, _power(length(of.interval), step.root).range)


def excess(of: Parameters, known: Known, reader: Reader) -> Excess:
    """Rule `excess`: {root: name of a moran-root step, epsilon > 0, word w of 1 to 12 letters}.

    Conclusion: bounds on (|L| + d)^s - |L|^s - d, L = I_w, d = epsilon / 2^(length of w).
    """
    root_of, epsilon_of, word_of = reader.fields("root", "epsilon", "word")
    step, epsilon, word = _root(known, root_of), epsilon_of.number(), word_of.string()
    if not 1 <= len(word) <= _LONGEST_WORD or not set(word) <= set("01"):
        raise word_of.fail("a word over 0 and 1 is expected")
    if epsilon <= 0:
        raise epsilon_of.fail("a positive number is expected")
    reader.charge(20, bits_for(step.root))
    inside = length(cylinder(step.ratios, of.interval, word))
    delta = epsilon / 2 ** len(word)
    bounds = _power(inside + delta, step.root) - _power(inside, step.root)
    return Excess(step.ratios, epsilon, word, (bounds - rational(delta, bounds.bits)).range)


RULES: dict[str, Rule] = {
    "horseshoe": horseshoe,
    "itinerary": itinerary,
    "linear-set": linear_set,
    "excess": excess,
}
