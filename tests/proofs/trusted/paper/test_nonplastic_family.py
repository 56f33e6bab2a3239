"""Claim N5: horseshoes as epsilon grows, against orbits found by hand; certificates forged."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.search import s33_family
from proofs.shell.groups import produce
from proofs.trusted.files import render
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.horseshoes import shoes
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import check
from tests.oracles.sources import conclusions

FAR = Fraction("0.06")


@pytest.fixture(scope="module")
def family():
    """The certificate for small epsilon, which the checker accepts: two rectangles, then four."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(s33_family, "_FAR", FAR)
        made = produce({"nonplastic": ("N5",)}, PAPER, digits=30).certificate
    return json.loads(made)


@pytest.fixture(scope="module")
def known(family):
    """What the checker concludes from it."""
    return list(conclusions(family)[1].values())


@pytest.mark.slow
def test_what_is_said(family, known):
    (claim,) = check(render(family)).claims
    assert claim.verdict.value == "VERIFIED"
    said = family["claims"][0]["corrected"]
    assert "epsilon in [0, 0.06]: for each epsilon there are disjoint sets V1 and V2" in said
    assert "conjugate to the two-sided full shift" in said and "one-sided full shift" in said
    found = shoes(known)
    assert hasattr(found[0].strips, "velocities") and hasattr(found[-1].strips, "after_first")


def test_beyond_what_is_proved_nothing_is_decided(known):
    row = find("N5")
    assert row.own
    for epsilon, verdict in (("0", "VERIFIED"), ("0.0599", "VERIFIED"), ("0.06", "UNDECIDED")):
        decision = row.decide(replace(PAPER, epsilon=Fraction(epsilon)), known)
        assert decision.verdict.value == verdict
    assert "proved up to epsilon = 0.06 only" in decision.missing
    for of in (replace(PAPER, eta=Fraction("0.2122")), replace(PAPER, epsilon=None)):
        assert row.decide(of, known).verdict.value == "UNDECIDED"
    for missing in (each for each in known if isinstance(each, Horseshoe)):
        without = [each for each in known if each != missing]
        assert row.decide(replace(PAPER, epsilon=Fraction("0.05")), without).missing
