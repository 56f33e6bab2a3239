"""Oscillators at random: what is proved about each, an oracle's word on it, and agreement."""

import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from itertools import islice

import pytest

from intervals import Undecided
from proofs.commands import single_impact
from proofs.motion.system import System
from proofs.plane import singles
from proofs.shell.groups import PROVERS, row_of
from proofs.trusted.paper import BEYOND
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import premises
from tests.oracles.judge import oracle

COUNT, AGREED, EFFORT = 200, 300, 2
VERIFIED, REFUTED = Verdict.VERIFIED, Verdict.REFUTED


def sampled(seed=2026):
    """eta in (0.05, 3), |nu| in (0.01, 2), epsilon in (0, 0.3), four decimals."""
    rng = random.Random(seed)

    def drawn(low, high):
        return round(Fraction(rng.uniform(low, high)), 4)

    while True:
        eta, nu = drawn(0.05, 3), rng.choice((-1, 1)) * drawn(0.01, 2)
        yield replace(PAPER, eta=eta, nu=nu, epsilon=drawn(0, 0.3), velocities=None, reach=None)


@pytest.mark.long
@pytest.mark.parametrize("group", ["explore", "rebounding"])
def test_no_oracle_contradicts_what_is_proved_at_random(group, capsys):
    counts, told, nothing = Counter(), [], []
    for of in islice(sampled(), COUNT):
        prover = import_module(f"proofs.search.{PROVERS[group]}")
        found, verdicts = prover.prove(of, BEYOND[group], effort=EFFORT), []
        for claim in BEYOND[group]:
            proof = [conclusion for _, conclusion in found.proofs.get(claim, [])]
            decision = row_of(claim).decide(of, proof)
            verdicts.append(decision.verdict)
            counts[claim, decision.verdict.value] += 1
            for conclusion in decision.because:
                told += [(of, claim, x) for x in oracle(conclusion, random.Random(1), of)]
        if Verdict.VERIFIED not in verdicts:
            nothing.append(f"{float(of.eta)} {float(of.nu)} {float(of.epsilon)}")
    with capsys.disabled():
        print(f"\n{group}: {dict(sorted(counts.items()))}; nothing at {len(nothing)}: {nothing}")
    assert not told
    assert sum(counts.values()) == COUNT * len(BEYOND[group])


def verdicts(group, of):
    found = import_module(f"proofs.search.{PROVERS[group]}").prove(of, BEYOND[group], effort=EFFORT)
    return {
        claim: row_of(claim).decide(of, [x for _, x in found.proofs.get(claim, [])]).verdict
        for claim in BEYOND[group]
    }


def stable_by_two(of):
    """The n up to 5 of stable single-impact orbits, by `single_impact` and by `atlas`, decided."""
    at = System(of.eta, of.nu)
    answer = single_impact.answer_for(at, range(1, 6), 20)
    open_ones = {each["n"] for each in answer["solutions"] if each["stable"] is None}
    decided = {*range(1, 6)} - {*answer["undecided"], *answer["resonant"], *open_ones}
    try:
        (drawn,) = premises(singles.propose(at.place, 5).certificate()).known.values()
    except Undecided:  # a cell of the atlas would be
        return set(), set()
    found = {each["n"] for each in answer["solutions"] if each["stable"]}
    return found & decided, {*drawn.stable} & decided


NEVER_BOTH = [("X1", x) for x in ("X2", "X3", "X4", "X5", "X10")] + [
    (x, "X8") for x in ("X6", "X7", "X9")
]


def contradictions(of):
    """What two commands, or two claims of one, say of an oscillator that cannot both be true."""
    said = verdicts("explore", of) | verdicts("rebounding", of)
    found, drawn = stable_by_two(of)
    if found != drawn:
        yield f"single_impact: stable for n in {found}; atlas: {drawn}"
    if found and said["X4"] is not VERIFIED:
        yield f"single_impact: stable for n in {found}; explore: X4 {said['X4'].value}"
    if (said["X10"], said["X3"]) == (VERIFIED, REFUTED):
        yield "explore: most orbits come to a motion that is none"
    for each in NEVER_BOTH:
        if {said[claim] for claim in each} == {VERIFIED}:
            yield f"explore: {each}"
    if of.eta == 1 and VERIFIED in (said[x] for x in ("X2", "X3", "X4", "X6")):
        yield f"resonance: all motions tend to grazing ones; explore: {said}"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, *(pytest.param(k, marks=pytest.mark.long) for k in (1, 3))])
def test_no_two_commands_contradict_each_other(seed):
    told = []
    for k, of in enumerate(islice(sampled(seed), 6 if seed < 3 else AGREED)):
        at = replace(of, eta=Fraction(1)) if k % 6 == 5 else of
        told += [(str(at), each) for each in contradictions(at)]
    assert not told
