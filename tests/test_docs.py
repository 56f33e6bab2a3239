"""Documentation and README: examples run, numbers are the ledger's, sentences have a source."""

import doctest
import importlib
import json
import os
import re
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

import pytest

from proofs.commands.ledger import CLAIMS
from proofs.shell.groups import row_of
from proofs.shell.screen import Decided, in_a_line
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.rules import find_rule
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import premises

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / "README.md",
    ROOT / "docs" / "own-map.md",
    *sorted(path for path in (ROOT / "docs").glob("*.md") if not path.is_symlink()),
]
TEXTS = {page.name: page.read_text() for page in PAGES}
COMMAND = re.compile(r"python (?:-[SO] )*-m (proofs[\w.]*(?: [a-z_]+)?)([^`\n|#]*)")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_examples_run(page):
    outcome = doctest.testfile(str(page), module_relative=False)
    assert not outcome.failed
    assert outcome.attempted or ">>>" not in TEXTS[page.name]


def test_there_are_examples():
    assert "Oscillator" in TEXTS["guide.md"] and ">>>" in TEXTS["guide.md"]


@pytest.mark.slow
def test_commands_and_their_options_exist():
    used = {}
    for text in TEXTS.values():
        for module, rest in COMMAND.findall(text):
            used.setdefault(module.rstrip("."), set()).update(re.findall(r"--[a-z][a-z-]*", rest))
    assert len(used) > 8
    for module, options in used.items():
        if options - {"--help"} or " " in module:
            told = help_of(module)
            if module == "proofs":
                told += help_of("proofs ledger")  # which options without a command go to
            assert not {option for option in options if option not in told}, module
        else:
            importlib.import_module(module)


def help_of(module):
    call = [sys.executable, "-m", *module.split(), "--help"]
    done = subprocess.run(call, capture_output=True, text=True, cwd=ROOT, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_files_that_are_named_exist():
    for name, text in TEXTS.items():
        paths = re.findall(r"`((?:proofs|intervals|tests|reports|docs)/[\w./-]*)`", text)
        paths += re.findall(r"\]\(([\w./-]+\.(?:svg|md|html|json))\)", text)
        for path in paths:
            assert (ROOT / path).exists() or (ROOT / "docs" / path).exists(), f"{name}: {path}"


def test_the_four_inequalities_are_those_of_the_certificate():
    proved = premises((ROOT / "reports" / "horseshoe.json").read_text()).known
    slopes = [each for each in proved.values() if isinstance(each, SlopeRange)]
    images = {x: y for each in slopes for x, y in zip(each.points, each.images, strict=True)}
    found = re.findall(r"f\((\d\.\d+)\) ([<>]) (\d\.\d+)", TEXTS["proof.md"])
    assert {point for point, _, _ in found} == {"1.1", "1.15", "1.27", "1.32"}
    for point, sign, bound in found:
        low, high = images[Fraction(point)]
        assert high < Fraction(bound) < Fraction("1.1") if sign == "<" else low > Fraction(bound)
        assert sign == "<" or Fraction(bound) > Fraction("1.32")
    (least,) = re.findall(r"on I1 \| f' ≥ ([\d.]+) \|", TEXTS["proof.md"])
    assert min(each.minimum[0] for each in slopes) >= Fraction(least)
    avoided = [each for each in proved.values() if isinstance(each, Avoids)]
    assert "no phase of [1.15, 1.27] has its first impact in I" in TEXTS["proof.md"]
    assert any(
        "[1.15, 1.27] has its first impact in [1.1, 1.32]" in each.sentence for each in avoided
    )


def test_the_readme_shows_what_the_screen_shows():
    rows = json.loads((ROOT / "reports" / "ledger.json").read_text())["claims"]
    claims = [Decided(x["id"], Verdict(x["verdict"]), x["statement"], x["why"]) for x in rows]
    shown = TEXTS["README.md"].partition("```text\n")[2].partition("\n```")[0].splitlines()
    true, verdicts = shown[0], shown[2:-1]
    assert shown[1] == shown[-1] == "..." and len(verdicts) == 5
    assert set(verdicts) <= {in_a_line(each) for each in claims}
    assert true.startswith("True (H2, H5): ") and any(
        true.removesuffix(" ...").split(": ", 1)[1] in (x["corrected"] or "") for x in rows
    )


def outputs(notebook):
    """What a reader of a notebook sees, but for pictures."""
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    data = [[{"text": x.get("text"), **x.get("data", {})} for x in cell.outputs] for cell in cells]
    shown = ("text", "text/html", "text/plain")
    return [[next(x[k] for k in shown if x.get(k)) for x in each] for each in data]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["horseshoe", "figures"])
def test_notebooks_run_and_have_the_outputs_that_they_keep(name):
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = ROOT / "docs" / "notebooks" / f"{name}.ipynb"
    read = nbformat.read(notebook, as_version=4)
    kept = outputs(read)
    where = {"metadata": {"path": str(notebook.parent)}}
    client = nbclient.NotebookClient(read, timeout=120, resources=where)
    client.execute(env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert all(kept) and outputs(read) == kept


# -- what the README counts and quotes is what the ledger says -------------------------------------


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


# -- the reader's test -----------------------------------------------------------------------------


LEDGER = {x["id"]: x for x in json.loads((ROOT / "reports/ledger.json").read_text())["claims"]}
NUMBER = re.compile(r"(?<![\d.])\d+\.\d+(?![\d.]*[\w])")
OTHERS = "-", "counts", "inequalities"  # the last two: other tests of this file
OWN = {"0.2121", "0.2", "0.22", "0.21", "0.215", "0.205", "0.195", "3.9", "0.01", "3.11"}
SETS = {"1.1", "1.11", "1.15", "1.27", "1.32", "1.48"}  # printed, or repaired


SOURCES = {
    "docs/proof.md": """
From the equation | -
The numbers are those | -
What is proved, in full | -
Between impacts | -
Both are known | M1 M4
> X(t) | M1 M4
and their distance | M4
So the differential equation | M1 M5
Each equation stands | -
f(φ) is the phase | -
To enclose a zero | -
For all launches | rule:avoids
- at launch g | rule:avoids
- on a piece of time | rule:avoids
- in the window | rule:avoids
Everything is evaluated | -
A phase at which | -
Differentiating the equation | rule:slopes
> f'(φ) | rule:slopes
A(φ) being | rule:slopes
With an enclosure of f'' | rule:slopes
Let f be | -
| inequality | -
| f' > 1 | H2
| f(I0) | inequalities
| f(I1) | inequalities
| the rest of I | H4 rule:avoids
Then the phases whose | H7 H8 H9 H13 rule:staying-set
Four inequalities | H7
**Why the rest | -
Between I0 and I1 | H18
A little before | H18
**Why 000 | -
For the paper's I | H5
The orbit of 1.11 | H7
No orbit stays | H7
**Three sets | -
On [1.1, 1.18] | G5 G6
The paper's second | G5
- **Dimension | -
The inverse branches | H13 rule:dimension
A positive test | H13
- **Entropy | -
All of the circle | G17
A graph of intervals | G9 G17
- **Most phases | -
Following intervals | G13
A state has | -
The same steps | rule:rectangle rule:horseshoe
For the printed | N1 N2 N3 N5
The motion that sticks | G7
The program that | -
It writes down | -
The checker reads | -
[Certificates and rules] | -
""",
    "README.md": """
Theorems about | -
Is a paper | -
What holds | -
Every proved verdict | -
- **your system** | -
Periodic orbits | -
- **this paper** | -
A mass on | -
Claim by claim | -
- **your parameters** | -
- **your map** | -
- **the arithmetic** | -
The printed set | H5
With [1.1, 1.32] | H2
`reports/` holds | -
Python 3.11 | -
Once installed | -
With `--verbose` | -
`python -m proofs` lists | -
| to ask | -
| about all | -
| what can be | -
| the same for | -
| where a map | -
Of the 83 claims | counts
Two (G8, E1) | counts
H18, N4 | counts
The most telling | -
| the paper says | -
| 4.2 <= f' | H1 H2 H5 H7
| the dimension | H13 H11
| "another invariant | G5 G11 G20 G9 G17
| a stable orbit | G13
| it persists | G7 G15 G16
Section 5 on | counts
Restitution is | -
More: | -
The checker needs | -
It recomputes | -
All that a sceptic | -
Who trusts neither | -
The quick part | -
How fast | -
`docs/` is also | -
`CHANGELOG.md` | -
MIT licence | -
""",
}


def sentences(text):
    """The sentences and rows of tables of a page, but for titles, pictures and examples."""
    text = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    for block in re.split(r"\n\s*\n|\n(?=[-|>#])", text):
        line = " ".join(block.split())
        if line and not set(line) <= set("|- ") and not line.startswith(("#", "![")):
            yield from (
                [line] if line[0] == "|" else re.split(r"(?<=[.?])\*{0,2} (?=[A-Z`*\[])", line)
            )


def rows(page):
    lines = SOURCES[page].strip().splitlines()
    return [tuple(line.rsplit(" | ", 1)) for line in lines]


def numbers(sentence):
    """The decimals of a sentence that are not the paper's, nor those of commands."""
    return {*NUMBER.findall(re.sub(r"`[^`]*`", "", sentence))} - OWN - SETS


def is_said(number, sentence, text):
    """Whether a text has a number, whole; or its first digits, where dots stand for the others."""
    end = "" if f"{number}..." in sentence else r"(?!\d)"
    return re.search(rf"(?<![\d.]){re.escape(number)}{end}", text) is not None


@pytest.mark.parametrize("page", SOURCES)
def test_every_sentence_has_a_source(page):
    there = [*sentences((ROOT / page).read_text())]
    begun = [begins for begins, _ in rows(page)]
    assert [x for x, begins in zip(there, begun, strict=False) if not x.startswith(begins)] == []
    assert len(there) == len(begun), there[len(begun) :]


@pytest.mark.parametrize("page", SOURCES)
def test_every_number_is_its_source_s(page):
    missing = []
    for sentence, (_, source) in zip(sentences((ROOT / page).read_text()), rows(page), strict=True):
        names = source.split()
        assert all(find_rule(x[5:]) for x in names if x.startswith("rule:")), source
        said = " ".join(json.dumps(LEDGER[x], ensure_ascii=False) for x in names if x in LEDGER)
        assert said or names[0] in OTHERS or names[0].startswith("rule:"), source
        checked = names == ["inequalities"]
        told = {x for x in numbers(sentence) if not checked and not is_said(x, sentence, said)}
        missing += [(x, sentence[:50]) for x in told]
    assert not missing
