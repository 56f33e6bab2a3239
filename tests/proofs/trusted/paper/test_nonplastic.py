"""Claims N1-N3, N5: verdicts against independent numbers; certificates that must be rejected."""

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from mpmath import mp, mpf

from proofs.search import s33_family
from proofs.shell.groups import produce
from proofs.trusted.files import render
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.paper import find
from proofs.trusted.paper.s33_restitution.horseshoes import shoes
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import check
from tests.oracles.sources import conclusions
from tests.proofs.trusted.paper import reference


@cache
def made(of, *claims):
    """The entries of claims by id, and the certificate, which the checker accepts."""
    found = produce({"nonplastic": claims}, of, digits=30)
    certificate = json.loads(found.certificate)
    entries = {entry["id"]: entry for entry in certificate["claims"]}
    checked = {claim.id: claim.verdict.value for claim in check(found.certificate).claims}
    assert checked == {line.id: line.verdict.value for line in found.lines}
    assert checked == {claim: entry["verdict"] for claim, entry in entries.items()}
    return entries, certificate


@pytest.fixture(scope="module")
def paper():
    return made(PAPER, "N1", "N2")


def pair_of(low, high):
    return Fraction(low), Fraction(high)


# -- what is proved --------------------------------------------------------------------------------


def corner(phi, gamma, near):
    """The image phase of a state, by the root of (14) typed by hand, at 50 digits."""
    numbers = [mpf(x) for x in ("0.2121", "-0.2", "0.01", phi, gamma)]
    time = mp.findroot(lambda t: reference.left_side_14(*numbers, t), near)
    return (numbers[3] + time) % (2 * mp.pi)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("image_of_left_edge_of_V1", ("1.11", "0", 25.13)),
        ("image_of_right_edge_of_V1", ("1.15", "-0.45", 25.28)),
        ("image_of_left_edge_of_V2", ("1.27", "0", 56.36)),
        ("image_of_right_edge_of_V2", ("1.32", "-0.45", 56.53)),
    ],
)
def test_extreme_images_of_the_edges(paper, name, state):
    printed = paper[0]["N1"]["quantities"][name]
    true = corner(*state)
    assert mpf(printed["lower"]) <= true <= mpf(printed["upper"])
    assert mpf(printed["upper"]) - mpf(printed["lower"]) < mpf(10) ** -25


def other(**change):
    """Other numbers, with an I that holds all sets of phases."""
    return replace(PAPER, interval=pair_of("1.1", "1.4"), **change)


def slow(*case):
    return pytest.param(*case, marks=pytest.mark.slow)


WIDER = other(left=pair_of("1.11", "1.16"), right=pair_of("1.27", "1.33"))
BOTH_OPEN = {"N1": "UNDECIDED", "N2": "UNDECIDED"}
ONE_OPEN = {"N1": "REFUTED", "N2": "UNDECIDED"}


@pytest.mark.parametrize(
    ("of", "verdicts", "texts"),
    [
        (
            PAPER,
            {"N1": "REFUTED", "N2": "VERIFIED"},
            [
                "V2 V2 V2 V2",
                "short of 1.32 by at least 0.019174",
                "V1 = [1.11, 1.16] x [-0.45, 0], V2 = [1.27, 1.33] x [-0.45, 0]",
                "golden mean",
                "physically possible",
            ],
        ),
        slow(
            PAPER,
            {"N3": "VERIFIED"},
            [
                "At eta in [0.21205, 0.21215], nu in [-0.20",
                "epsilon in [0, 0.015]: let V1 = ",
                "without 22",
                "short of 1.35 by at least 0.0018",
            ],
        ),
        slow(  # a rectangle grazes; the images of its corners are proved all the same
            other(nu=Fraction("-0.25")),
            BOTH_OPEN,
            ["the right edge of V2 to a phase in [1.015248, 1.015249]"],
        ),
        slow(  # an edge alone refutes
            other(eta=Fraction("0.212")),
            {"N1": "REFUTED"},
            ["left edge of V1 to a phase in [1.114936, 1.114937], short of 1.11 by at least"],
        ),
        slow(WIDER, {"N1": "VERIFIED", "N2": "VERIFIED"}, []),
        slow(other(epsilon=Fraction(0)), ONE_OPEN, []),  # the left edge of V1 fails
        slow(other(velocities=pair_of("-0.3", 0)), ONE_OPEN, []),  # images leave them
        (other(epsilon=None), BOTH_OPEN, []),
        (other(velocities=None), BOTH_OPEN, []),
    ],
)
def test_verdicts_and_what_is_said(of, verdicts, texts):
    entries, certificate = made(of, *verdicts)
    assert {claim: entry["verdict"] for claim, entry in entries.items()} == verdicts
    first = next(iter(entries.values()))
    said = " ".join(first[part] or "" for part in ("why", "witness", "corrected"))
    assert [text for text in texts if text not in said] == []
    assert len(render(certificate)) < 1_000_000


# -- what must be rejected -------------------------------------------------------------------------


def steps(certificate, rule):
    return [step["witness"] for step in certificate["steps"].values() if step["rule"] == rule]


# -- claim N5 --------------------------------------------------------------------------------------


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
