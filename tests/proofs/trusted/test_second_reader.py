"""Two readers of certificates agree: proofs.check, and one written from the specification alone.

They agree on the corpus, on changed certificates and at other parameters. Where the checker's
enclosures do not decide, Arb's may.
"""

import json
import random
import re
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from flint import arb, arb_series

from proofs.trusted.certificate import render
from proofs.trusted.parameters import PAPER
from tests.proofs.trusted.mutations import mutations
from tests.proofs.trusted.renewing import fresh
from tests.proofs.trusted.second_both import both
from tests.proofs.trusted.second_map import Impacts, ball

ROOT = Path(__file__).parents[3]
ACCEPTED = ROOT / "tests/certificates/accepted/horseshoe.json"
CORPUS = sorted((ROOT / "tests/certificates").glob("[amr]*/*.json"))

# Kinds that break the form and prove nothing: the page lets a reader call them either.
BOTH_FAULTS = {
    "claim id changed": "another statement; another claim has the id",
    "flight of the gap dropped": "the gap is not covered; a step is unused",
    "flight phases moved": "no impact proved; points lie outside the phases",
    "flight phases moved a turn": "no impact proved; the phases do not touch the next",
    "flight phases the whole circle": "no impact proved; the phases do not touch the next",
    "phase of a point changed": "no impact proved; the sets are no points of the slopes",
    "proof of another claim": "another verdict; a step that nothing uses",
    "points swapped": "brackets of other phases, which do not increase",
    "reference dropped": "a fact is missing; its step is unused",
    "other type": "a quantity that the claim does not have; it is no pair of bounds",
    "unknown field": "a quantity that the claim does not have; it is no pair of bounds",
    "why changed": "another text; none at all",
}
# The second reader leaves it to the checker how a reason is worded.
WORDING = re.compile(r"rejected: \$\.claims\[\d+\]\.(why|witness|corrected): ")
# Kinds of which Arb may prove more: the times of a flight subdivide less, and it bisects.
MORE_DECIDED = {"time dropped"}


# -- the corpus ------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_both_agree_on_the_corpus(path):
    text = path.read_text()
    found, other, same, reasons = both(text)
    assert found == other == path.parent.name and same, reasons


def test_both_read_the_same_verdicts_in_the_report():
    found, other, same, reasons = both(ACCEPTED.read_text())
    assert found == other == "accepted" and same, reasons


# -- changed certificates --------------------------------------------------------------------------


@pytest.fixture(scope="module")
def by_kind():
    kinds = {}
    for mutation in mutations(json.loads(ACCEPTED.read_text())):
        kinds.setdefault(mutation.kind, []).append(mutation)
    return kinds


def compare(chosen):
    """Assert that both accept, or both refuse in the same way; count the outcomes."""
    counts = Counter()
    for mutation in chosen:
        found, other, same, reasons = both(mutation.make())
        told = f"{mutation.kind} at {mutation.where}: {reasons}"
        counts[found, other] += 1
        if (found, other) == ("rejected", "accepted") and (
            mutation.kind in MORE_DECIDED or WORDING.match(reasons)
        ):
            continue
        assert (found == "accepted") == (other == "accepted"), told
        assert found == other or mutation.kind in BOTH_FAULTS, told
        assert same, told
    print(dict(counts))
    return counts


@pytest.mark.slow
@pytest.mark.usefixtures("remembered_clock")
@pytest.mark.parametrize("part", range(2))
@pytest.mark.parametrize("each", [2, pytest.param(6, marks=pytest.mark.long)])
def test_both_agree_on_changed_certificates(by_kind, part, each):
    """Of so many of each kind."""
    chosen = [x for some in by_kind.values() for x in some[len(some) // 3 :: len(some) // each + 1]]
    counts = compare(chosen[part::2])
    assert len(by_kind) > 100 and counts["rejected", "rejected"] > 10


@pytest.mark.parametrize(
    "number",
    ["-0", "1/1", "0/1", "1/0", "-0/3", "2/4", "+1", "01", "1/02", "1.0", "1e3", " 1", "1\n", "",
     "1/-3", "\u0661", "1_0", "0x1", "1" * 401, "1" * 5000],
)  # fmt: skip
def test_both_refuse_a_number_out_of_form(number):
    document = json.loads((ROOT / "tests/certificates/accepted/h16_alone.json").read_text())
    document["parameters"]["interval"][0] = number  # any from 0 to 1.11 would do
    found, other, _, reasons = both(json.dumps(document))
    assert found == other == "malformed", reasons


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        pytest.param({"nu": Fraction("-0.25")}, marks=pytest.mark.slow),
        {"nu": Fraction("0.2")},
        pytest.param({"eta": Fraction("0.23")}, marks=pytest.mark.slow),
        pytest.param({"slopes": (Fraction("4.8"), Fraction("6.5"))}, marks=pytest.mark.slow),
        {"slopes": (Fraction("0.9"), Fraction(6)), "ratios": None, "printed_s0": None},
        pytest.param({"interval": (Fraction("1"), Fraction("1.32"))}, marks=pytest.mark.slow),
        {"left": (Fraction("1.1"), Fraction("1.15")),
         "interval": (Fraction("1.1"), Fraction("1.32")),
         "slopes": (Fraction(4), Fraction(7)), "ratios": None, "printed_s0": None},
        {"left": (Fraction("0.5"), Fraction("0.51")), "right": (Fraction("0.52"), Fraction("0.53")),
         "interval": (Fraction("0.5"), Fraction("0.53"))},
    ],
)  # fmt: skip
def test_both_agree_at_other_parameters(changes):
    found, other, same, reasons = both(render(fresh(replace(PAPER, **changes))))
    assert found == other == "accepted" and same, reasons


# -- the second reader's own equations -------------------------------------------------------------


def test_the_derivatives_typed_are_those_of_the_gap():
    chance = random.Random(4)
    for _ in range(200):
        eta, nu = Fraction(chance.randint(1, 300), 100), Fraction(chance.randint(1, 200), 100)
        impacts = Impacts(eta, nu * chance.choice((1, -1)))
        phi, t = (ball(Fraction(chance.randint(0, 6000), 1000)) for _ in range(2))
        series = impacts.gap(phi, arb_series([t, 1], prec=3))
        assert series[1].overlaps(-impacts.fall(phi, t))
        assert (2 * series[2]).overlaps(impacts.bend(phi, t))
        assert (impacts.gap(phi, arb(0)) * 2**40).abs_upper() < 1  # it starts at 0, at rest
        assert (impacts.fall(phi, arb(0)) * 2**40).abs_upper() < 1


def test_a_piece_is_closed_exactly_where_a_parabola_stays_above_0():
    """gap = c + (t - 1/2)^2 attains the bound of linear interpolation: its minimum is c."""

    class Parabola(Impacts):
        def gap(self, phi, t):
            return self.eta + (t - arb(0.5)) ** 2

        def bend(self, phi, t):
            return 2 + 0 * t

    piece = ((Fraction(1), Fraction(1)), (Fraction(0), Fraction(1)))
    for low, is_closed in ((Fraction(1, 1000), True), (Fraction(-1, 1000), False)):
        assert Parabola(low, Fraction(1)).closed(*piece) is is_closed


def test_both_refuse_the_bracket_of_a_later_impact():
    """The equations go on after the first impact: at 1.13, gap falls through 0 near 56 again."""
    document = json.loads(ACCEPTED.read_text())
    impacts, phase = Impacts(PAPER.eta, PAPER.nu), ball(Fraction("1.13"))
    grid = [Fraction(k, 8) for k in range(8 * 26, 8 * 90)]
    signs = [impacts.gap(phase, ball(t)) > 0 for t in grid]
    later = next(i for i in range(len(grid) - 1) if signs[i] and not signs[i + 1])
    document["steps"]["point-1"]["witness"]["time"] = [str(t) for t in grid[later : later + 2]]
    found, other, _, reasons = both(json.dumps(document))
    assert found == other == "rejected" and reasons.count("window") == 2, reasons
