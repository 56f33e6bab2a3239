"""A claim takes the calls that it needs, and no others: counted in prover and checker."""

import sys
from collections import Counter
from contextlib import contextmanager

import pytest

from intervals.cover import cover
from proofs.methods.basin import Mesh
from proofs.methods.derive import simplest
from proofs.motion.witness import Flights
from proofs.shell import groups
from proofs.trusted import rules
from proofs.trusted.equations import gap, return_map_derivative, slope
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import check

TIMES = Flights.times
WATCHED = gap, slope, return_map_derivative, TIMES, cover, simplest, Mesh.leaning, Tape.evaluate
STEPS = rules.find_rule
FLIGHTS = {gap: 2400, cover: 6, slope: 25}
SLOPES = {gap: 1200, slope: 40}
FLOWN = {gap: 2500, return_map_derivative: 8}
NEEDED = [  # group, claims, the most calls in a proof, steps of the certificate
    ("horseshoe", "H16", {}, 0),
    ("foundations", "A2", {}, 0),
    ("sets", "H15 H17", {}, 0),
    ("sets", "H12 H14", {}, 2),
    ("foundations", "M4", {Tape.evaluate: 5}, 5),
    ("horseshoe", "H4", FLIGHTS, 1),
    ("horseshoe", "H1", SLOPES, 2),
    ("horseshoe", "H1 H3 H6 H11 H16", SLOPES, 4),  # steps that several need are made once
    ("circle", "G1", {gap: 160, TIMES: 1}, 1),  # an orbit of period 2: no cells of the circle
    ("horseshoe", "N2", FLOWN, 2),  # no plastic map
]


@contextmanager
def calls(*functions):
    """Count the calls inside the `with`, by qualified name."""
    counts = Counter()
    names = {function.__code__: function.__qualname__ for function in functions}

    def observe(frame, event, _):
        if event == "call" and frame.f_code in names:
            counts[names[frame.f_code]] += 1

    before = sys.getprofile()
    sys.setprofile(observe)
    try:
        yield counts
    finally:
        sys.setprofile(before)


@pytest.mark.parametrize("group, claims, most, steps", NEEDED, ids=lambda x: str(x)[:16])
def test_only_what_is_needed_is_computed(group, claims, most, steps):
    with calls(*WATCHED, STEPS) as proving:
        asked = groups.wanted(group, PAPER, claims.split())
        made = groups.produce(asked, PAPER, digits=30)
    with calls(*WATCHED, STEPS) as checking:
        check(made.certificate)
    allowed = {function.__qualname__: number for function, number in most.items()}
    assert proving.pop("find_rule", 0) == checking.pop("find_rule", 0) == steps
    assert set(proving) == set(allowed) >= set(checking)
    assert all(0 < proving[name] <= most for name, most in allowed.items()), proving
