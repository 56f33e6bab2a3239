"""The reader's test: each sentence of README and of `docs/proof.md`, and what it stands on.

A row is the beginning of a sentence, in the order of the page, and its source: claims of the
ledger, rules of the checker, arithmetic of another test, or "-", where it defines, announces or
tells how to use something; such a sentence has no number but the paper's own.
"""

import json
import re
from pathlib import Path

import pytest

from proofs.trusted.rules import find_rule

ROOT = Path(__file__).parents[1]
LEDGER = {x["id"]: x for x in json.loads((ROOT / "reports/ledger.json").read_text())["claims"]}
NUMBER = re.compile(r"(?<![\d.])\d+\.\d+(?![\d.]*[\w])")
OTHERS = "-", "counts", "inequalities"  # the last two: `test_readme`, `test_docs`
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
