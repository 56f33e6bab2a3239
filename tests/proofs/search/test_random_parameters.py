"""200 oscillators at random: what is proved about each, and an oracle's word on all of it."""

import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from importlib import import_module

import pytest

from proofs.shell.groups import PROVERS, row_of
from proofs.trusted.paper import BEYOND
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from tests.oracles.judge import oracle

COUNT, EFFORT = 200, 2


def sampled(seed=2026):
    """eta in (0.05, 3), |nu| in (0.01, 2), epsilon in (0, 0.3), four decimals."""
    rng = random.Random(seed)

    def drawn(low, high):
        return round(Fraction(rng.uniform(low, high)), 4)

    for _ in range(COUNT):
        eta, nu = drawn(0.05, 3), rng.choice((-1, 1)) * drawn(0.01, 2)
        yield replace(PAPER, eta=eta, nu=nu, epsilon=drawn(0, 0.3), velocities=None, reach=None)


@pytest.mark.long
@pytest.mark.parametrize("group", ["explore", "rebounding"])
def test_no_oracle_contradicts_what_is_proved_at_random(group, capsys):
    counts, told, nothing = Counter(), [], []
    for of in sampled():
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
