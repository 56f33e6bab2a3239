"""What the paper derives from what: every id is a claim of the paper, nothing goes in a circle."""

import re

import pytest

from proofs.commands.ledger import CLAIMS
from proofs.report.dependencies import RESTS, falls_with, rests_on
from proofs.report.graph import falling, svg
from proofs.trusted.paper import find
from proofs.trusted.verdicts import Verdict


def test_ids_are_claims_of_the_paper_and_no_argument_goes_in_a_circle():
    for claim, rest in RESTS.items():
        for each in (claim, *rest.on):
            assert each in CLAIMS and not find(each).own
        assert rest.on and len(set(rest.on)) == len(rest.on)
        assert claim not in rests_on(claim)


def test_the_theorem_of_the_paper_falls_with_its_slope_bound():
    assert {"H7", "H8", "H13", "G5"} <= falls_with("H2")
    assert "H1" not in falls_with("H2") and rests_on("H8") >= {"H7", "H2", "M6", "M4", "M1"}


@pytest.mark.slow
def test_the_graph_shows_each_claim_once_and_carries_refutations_forward(found):
    graph = svg(found)
    refuted = {claim.id for claim in found.claims if claim.verdict is Verdict.REFUTED}
    boxes = re.findall(r'<a href="#([A-Z]\d+)">(?:(?!</a>).)*</a>', graph)
    assert sorted(boxes) == sorted(claim.id for claim in found.claims)
    ringed = set(re.findall(r'<a href="#(\w+)"><title>[^<]*</title><rect class="ring"', graph))
    assert ringed == {claim.id for claim in found.claims if rests_on(claim.id) & refuted}
    assert "H8" in ringed and "H1" not in ringed
    told = {each.claim.id: each for each in falling(found)}
    assert set(told) == {claim for claim in refuted if falls_with(claim)}
    for claim, each in told.items():
        members = [other.id for other in (*each.standing, *each.falling)]
        assert sorted(members) == sorted(falls_with(claim))
    corners = re.findall(r'<rect class="[A-Z]+" x="(\d+)" y="(\d+)"', graph)
    assert len(set(corners)) == len(corners) == len(found.claims)
