"""Two tables of claims agree: proofs.trusted.statements, and one typed from the specification."""

import json
import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import pytest
from proofs.trusted.GONE import STATEMENTS, Facts, decide, quantities

from proofs.trusted.certificate import parameters_to_json
from proofs.trusted.parameters import PAPER
from proofs.trusted.slopes import Impact, SlopeRange
from tests.proofs.trusted import second_claims
from tests.proofs.trusted.second_both import both

# -- H11 and H16 -----------------------------------------------------------------------------------


def dimension(slopes, ratios, printed, roots, claim):
    """A certificate of H11 or H16 alone, with the verdict left out."""
    of = replace(PAPER, slopes=slopes, ratios=ratios, printed_s0=printed)
    steps = {}
    for pair, root in roots if claim == "H11" else ():
        witness = {"ratios": list(map(str, pair)), "root": list(map(str, root))}
        steps[f"s{len(steps)}"] = {"rule": "moran-root", "witness": witness}
    entry = {"id": claim, "statement": STATEMENTS[claim].says(of), "proof": list(steps)}
    entry |= {"witness": None, "corrected": None, "quantities": {}}
    return {
        "schema": "impact-proofs.certificate/2",
        "parameters": parameters_to_json(of),
        "steps": steps,
        "claims": [entry],
        "corrected": None,
    }


def bracket(ratios, width):
    """A bracket of the root, found in floating point, to be proved by the readers."""
    low, high = 0.0, 64.0
    for _ in range(80):
        middle = (low + high) / 2
        more = sum(float(ratio) ** middle for ratio in ratios) > 1
        low, high = (middle, high) if more else (low, middle)
    return Fraction(low).limit_denominator(10**9) - width, Fraction(low) + width


def random_dimension(chance):
    high = Fraction(chance.choice((2, 3, 4, 8, Fraction("5.25"), Fraction("3.2"))))
    low = min(high, Fraction(chance.choice((1, 2, 3, 4, Fraction("4.2"), Fraction("1.25")))))
    exact = (1 / high, 1 / low)
    places = chance.choice((0, 1, 2, 3, 40, 41))
    shift = chance.choice((-1, 0, 0, 0, 1)) * Fraction(1, 10**places)
    ratios = tuple(Fraction(round(ratio * 10**places), 10**places) + shift for ratio in exact)
    ratios = chance.choice((None, ratios, exact))
    if ratios is not None and ratios[0] <= 0:
        ratios = exact
    pairs = dict.fromkeys((ratios or exact, exact))
    width = Fraction(1, 10 ** chance.choice((2, 5, 8)))
    roots = [(pair, bracket(pair, width)) for pair in pairs if max(pair) < 1]
    roots = [(pair, root) for pair, root in roots if root[0] > 0][: chance.choice((1, 2, 2, 2))]
    printed = None
    if roots and chance.random() < 0.8:
        digits = chance.randint(1, 4)
        cut = (roots[-1][1][0] + roots[-1][1][1]) / 2 * 10**digits
        printed = f"{(round(cut) + chance.choice((-1, 0, 0, 0, 1))) / 10**digits:.{digits}f}"
    return (low, high), ratios, printed, roots


@pytest.mark.parametrize("shift", [-2, 2])
def test_both_refuse_a_bracket_beside_the_root(shift):
    pair, width = PAPER.ratios, Fraction(1, 10**6)
    roots = [(each, bracket(each, width)) for each in (pair, PAPER.reciprocals)]
    for moved in (0, shift):
        shifted = [(each, tuple(end + moved * width for end in root)) for each, root in roots]
        document = dimension(PAPER.slopes, pair, "0.449", shifted, "H11")
        document["claims"][0]["verdict"] = "VERIFIED"
        found, other, _, reasons = both(json.dumps(document))
        assert found == other == ("rejected" if moved else "accepted"), reasons


@pytest.mark.slow
@pytest.mark.parametrize("part", range(2))
def test_both_give_the_same_verdict_on_h11_and_h16(part):
    chance, counts = random.Random(part), Counter()
    for _ in range(40):
        given = random_dimension(chance)
        for claim in ("H11", "H16"):
            document = dimension(*given, claim)
            accepted = []
            for verdict in ("VERIFIED", "REFUTED", "UNDECIDED"):
                document["claims"][0]["verdict"] = verdict
                found, other, _, reasons = both(json.dumps(document))
                assert found == other, f"{given}: {reasons}"
                accepted += [verdict] * (found == "accepted")
            assert len(accepted) == 1, f"{given}: {accepted}"
            counts[claim, *accepted] += 1
    assert len(counts) == 5 and min(counts.values()) >= 3, counts


# -- H1 to H6 --------------------------------------------------------------------------------------


def random_facts(chance):
    """Parameters, conclusions of steps about them, witnesses: of a few numbers that often meet."""

    def pair(values):
        return tuple(sorted(chance.choices(values, k=2)))

    def image(phase):
        low = chance.choice([*turns, *whole * 10])
        if likely and phase in marks:
            low = (whole[0] - Fraction(1, 4), whole[1])[marks.index(phase) % 2]
        return low, low + Fraction(chance.choice((0, 0, 1)), 8)

    likely = chance.random() < 0.3  # a horseshoe, or nearly one
    grid = [Fraction(k, 2) for k in range(1, 13)]
    marks = sorted(chance.sample(grid, 4))
    whole = (marks[0], marks[3])
    if chance.random() < 0.3:
        whole = (chance.choice([m for m in grid if m <= marks[0]]),
                 chance.choice([m for m in grid if m >= marks[3]]))  # fmt: skip
    turns = [Fraction(k, 8) for k in range(52)] + [second_claims.BELOW_TURN]
    speeds = [Fraction(k, 2) for k in chance.choice(((1, 2, 3, 4), (-4, -3, -2), range(-3, 9)))]
    of = replace(PAPER, left=tuple(marks[:2]), right=tuple(marks[2:]), interval=whole,
                 slopes=pair([Fraction(k, 2) for k in (1, 2, 3)]))  # fmt: skip
    steps = []
    for _ in range(chance.randint(1, 2)):
        phases = {*marks, *chance.choices(grid, k=2)}
        phases = sorted(phases if likely else phases - {chance.choice([None, *marks])})
        points = [(phase, pair(speeds), image(phase)) for phase in phases]
        steps.append(("slope-range", (points, [pair(speeds) for _ in phases[1:]])))
    union, target = pair([*grid, *marks[1:3] * 4]), chance.choice((whole, pair(grid)))
    steps.append(("avoids", ((marks[1], marks[2]), whole) if likely else (union, target)))
    slopes = [Fraction(k, 4) for k in (-4, -2, 1, 2, 3, 4, 8)]
    return of, steps, (chance.choice(grid), pair(slopes), image(None)), pair([*grid, *marks])


def told_to_the_checker(of, steps):
    facts = Facts()
    for rule, conclusion in steps:
        if rule == "slope-range":
            points, pieces = conclusion
            facts.add_slopes(of, SlopeRange(*zip(*points, strict=True), tuple(pieces)))
        else:
            facts.add_avoided(of, *conclusion)
    return facts


def compare_tables(seed, size):
    chance, counts = random.Random(seed), Counter()
    for _ in range(size):
        of, steps, point, missed = random_facts(chance)
        for claim in ("H1", "H2", "H3", "H4", "H5", "H6"):
            for witness in ({}, {"point": point}, {"missed": missed}):
                facts = told_to_the_checker(of, steps)
                facts.points += [Impact(*witness["point"])] if "point" in witness else []
                facts.missed = witness.get("missed")
                expected = decide(claim, of, facts)[0].value
                mine = second_claims.Facts(of, steps)
                found = second_claims.verdict(claim, mine, **witness)
                if found != expected and "REFUTED" in (found, expected) and witness:
                    # contradictory facts: both "proved" and refuted, never of a true map
                    assert second_claims.verdict(claim, mine) == "VERIFIED", (claim, of, steps)
                    continue
                assert found == expected, (claim, of, steps, witness)
                assert mine.quantities(claim) == quantities(claim, facts)
                counts[claim, found] += 1
    return counts


@pytest.mark.slow
def test_both_tables_of_claims_give_the_same_verdicts():
    counts = compare_tables(1, 500)
    assert len(counts) == 18 and min(counts.values()) >= 3, counts


@pytest.mark.slow
def test_both_tables_of_claims_give_the_same_verdicts_often():
    counts = compare_tables(2, 2500)
    assert min(counts.values()) >= 10, counts
