"""The atlases that were made once: ten cells of each with their certificates, and their pages."""

import json
import random
from pathlib import Path

import pytest

from proofs.check import check_file
from proofs.trusted.atlas import check_atlas
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.verify import check
from tests.once import committed
from tests.oracles.judge import oracle

FOLDER = Path(__file__).parents[3] / "reports" / "atlas"
NAMES = ["attractor", "entropy-3", "horseshoe", "orbits", "orbits-0.3"]


@pytest.mark.parametrize("name", NAMES)
def test_ten_cells_are_proved_where_they_are_said_to_be(name, capsys):
    """And simulation agrees, at an oscillator of each."""
    folder = FOLDER / name
    made = json.loads((folder / "atlas.json").read_text())
    assert check_file(folder / "sample.jsonl", DEFAULT) == 1  # the rest is not looked at
    assert "not looked at" in capsys.readouterr().out
    head, *lines = map(json.loads, (folder / "sample.jsonl").read_text().splitlines())
    assert head.items() <= made.items()
    cells = [line for line in lines if line["certificate"]]
    assert len(cells) == 10 and {line["kind"] for line in cells} <= made["kinds"].keys()
    page = (folder / "atlas.html").read_text()
    assert made["digest"] in page and 'href="sample.jsonl"' in page and len(page) < 3_000_000
    if name != "attractor":  # enclosures of arcs over a box are not one arc's
        for file, text in committed().items():
            if file.startswith(f"atlas/{name}/"):
                assert oracle(check(text).conclusions[0], random.Random(file)) == []


def test_all_questions_were_asked():
    assert sorted(path.parent.name for path in FOLDER.glob("*/atlas.json")) == NAMES


@pytest.mark.slow
def test_a_small_one_is_there_as_a_whole():
    """On both sides of resonance and of the table at rest: every verdict, and the strip."""
    path = FOLDER / "across-resonance.jsonl"
    assert path.stat().st_size < 1_000_000
    with path.open() as file:
        found = check_atlas(file)
    assert {*found.cells} == {"VERIFIED", "REFUTED", "UNDECIDED", "left out"}
    assert sum(found.shares.values()) == 1 and found.shares["left out"] < 1e-6
    assert found.shares["REFUTED"] + found.shares["VERIFIED"] > 0.9
