"""What the README counts and quotes is what the ledger says."""

import json
import re
from collections import Counter
from fractions import Fraction
from pathlib import Path

from proofs.shell.groups import row_of
from proofs.shell.ledger import CLAIMS
from proofs.trusted.verdicts import Verdict, tally

ROOT = Path(__file__).parents[1]
README = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
ROWS = json.loads((ROOT / "reports" / "ledger.json").read_text(encoding="utf-8"))["claims"]
WORDS = {2: "two", 7: "seven", 10: "ten", 11: "eleven", 12: "twelve", 13: "thirteen"}


def count(rows):
    return Counter(row["verdict"] for row in rows)


def test_the_ledger_is_whole():
    assert [row["id"] for row in ROWS] == list(CLAIMS)


def test_claims_are_counted_by_the_ledger_and_ours_apart():
    paper = [row for row in ROWS if row_of(row["id"]).words]
    own = [row["id"] for row in ROWS if not row_of(row["id"]).words]
    verdicts = count(paper)
    assert verdicts["UNDECIDED"] == 0
    assert (
        f"Of the {len(paper)} claims of the paper that we count "
        f"{len(paper) - verdicts['SIMULATED']} are decided: {verdicts['VERIFIED']} "
        f"true as printed, {verdicts['REFUTED']} false, {verdicts['CONDITIONAL']} true under "
        "conditions that the paper leaves out."
    ) in README
    assert f"{', '.join(own[:-1])} and {own[-1]} are questions of our own" in README
    simulated = [row["id"] for row in paper if row["verdict"] == "SIMULATED"]
    told = f"{WORDS[len(simulated)].capitalize()} ({', '.join(simulated)}) are observations"
    assert told in README


def test_screen_and_checker_count_alike():
    paper, own = (Verdict.REFUTED, False), (Verdict.VERIFIED, True)
    assert tally([paper, own, paper]) == "2 REFUTED; of our own 1 VERIFIED"
    assert tally([paper]) == "1 REFUTED" and tally([own]) == "of our own 1 VERIFIED"


def test_sections_5_and_6_are_counted_by_the_ledger():
    soft, resonant = (count(row for row in ROWS if row["id"][0] == letter) for letter in "SR")
    assert (
        f"has {WORDS[soft['REFUTED']]} of {soft.total()} claims false, section 6 on resonance "
        f"{WORDS[resonant['REFUTED']]} of {resonant.total()}:"
    ) in README


def test_numbers_are_those_of_the_ledger():
    quantities = {row["id"]: row["quantities"] for row in ROWS}
    ((least, most),) = re.findall(r"between ([\d.]+) and ([\d.]+) % of the circle;", README)
    bounds = [Fraction(quantities["G4"]["basin_fraction"][end]) for end in ("lower", "upper")]
    assert 0 <= bounds[0] - Fraction(least) / 100 < Fraction(1, 10**7)
    assert bounds[1] <= Fraction(most) / 100 < 1
    ((lost, held),) = re.findall(r"between ([\d.]+) and ([\d.]+) % come to phases", README)
    assert Fraction(least) + Fraction(held) == Fraction(most) + Fraction(lost) == 100
    (neither,) = re.findall(r"at most ([\d.]+) % to neither", README)
    assert f"All but at most {neither} percent come" in next(
        row["corrected"] for row in ROWS if row["id"] == "G13"
    )
    (largest,) = re.findall(r"yes for every epsilon <= ([\d.]+),", README)
    assert Fraction(largest) == Fraction(quantities["G7"]["epsilon_proved_up_to"]["lower"])
    (window,) = re.findall(r"every epsilon in \[([\d.]+), ([\d.]+)\] \(G16\)", README)
    ends = (quantities["G16"][f"epsilon_proved_{end}"]["lower"] for end in ("from", "up_to"))
    assert tuple(map(Fraction, window)) == tuple(map(Fraction, ends))
    (entropy,) = re.findall(r"entropy >= ([\d.]+) \(G9\)", README)
    assert any(f">= {entropy}" in row["why"] for row in ROWS if row["id"] == "G9")
    dimensions = re.findall(r"\| (0\.\d+)\.\.\., and (0\.\d+)\.\.\. for", README)[0]
    texts = next(row["corrected"] for row in ROWS if row["id"] == "H13")
    assert all(f"between {digits}" in texts for digits in dimensions)


def test_claims_named_in_a_row_of_the_table_exist():
    assert set(re.findall(r"\b[MHNGPSREA]\d+\b", README)) <= set(CLAIMS)
