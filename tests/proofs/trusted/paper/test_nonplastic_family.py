"""Claim N5: horseshoes as epsilon grows, against orbits found by hand; certificates forged."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from itertools import product

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


def impact(epsilon, phi, gamma, times=(25.0, 56.0)):
    """The next impact by a scan of the gap typed by hand; the mass starts in flight."""
    eta, nu = 0.2121, -0.2
    speed = -nu * math.cos(phi) / eta + epsilon * (-nu * math.cos(phi) / eta - gamma)

    def gap(t):  # of the table above the mass, as nu < 0
        mass = (1 + nu * math.sin(phi)) * math.cos(eta * t) - speed * math.sin(eta * t)
        return 1 + nu * math.sin(phi + t) - mass

    low = 0.05
    while gap(low + 0.01) > 0:
        low += 0.01
    high = low + 0.01
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) > 0 else (low, middle)
    turned = (1 + nu * math.sin(phi)) * math.sin(eta * low) + speed * math.cos(eta * low)
    return (phi + low) % math.tau, turned


def follow(shoe, epsilon, word):
    """A state of V1 or V2 whose images follow a word, by bisection in the phase."""
    boxes = [*shoe.strips.after_first, *shoe.strips.after_second]
    (low, high), (least, most) = boxes[word[0]]
    low, high, gamma = float(low), float(high), float(least + most) / 2

    def last(phi):
        """Where the orbit of a phase leaves the word, -1 to the left, 1 to the right."""
        state, came = (phi, gamma), word[0]
        for symbol in word[1:]:
            state = impact(epsilon, *state)
            (left, right), (slow, fast) = boxes[2 * came + symbol]
            if not left <= state[0] <= right:
                return -1 if state[0] < left else 1
            assert slow < state[1] < fast
            came = symbol
        return 0

    for _ in range(60):
        middle = (low + high) / 2
        if (side := last(middle)) == 0:
            return middle
        low, high = (middle, high) if side < 0 else (low, middle)
    return None


@pytest.mark.slow
def test_every_word_is_followed(known):
    shoe = shoes(known)[-1]
    low, high = map(float, shoe.at.epsilon)
    for epsilon, word in product((low, high), product((0, 1), repeat=3)):
        assert follow(shoe, epsilon, word) is not None


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
