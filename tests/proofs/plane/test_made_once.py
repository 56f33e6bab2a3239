"""The atlases that were made once: their cells as certificates, and what is said of the whole."""

import json
import random
from pathlib import Path

import pytest

from proofs.plane.store import key_of
from proofs.trusted.atlas import Region, check_atlas, proved
from proofs.trusted.certificate import parse
from proofs.trusted.verify import check
from tests.oracles.judge import oracle

FOLDER = Path(__file__).parents[3] / "reports" / "atlas"
MADE = sorted(path.parent for path in FOLDER.glob("*/atlas.json"))


@pytest.mark.parametrize("folder", MADE, ids=lambda folder: folder.name)
def test_ten_cells_are_proved_where_they_are_said_to_be(folder):
    """And simulation agrees, at an oscillator of each."""
    made = json.loads((folder / "atlas.json").read_text())
    names = "schema", "eta", "nu", "question", "epsilon"
    region = Region.read(json.dumps({name: made[name] for name in names if name in made}))
    cells = sorted(folder.glob("cell-*.json"))
    assert len(cells) == 10 and (folder / "atlas.svg").exists()
    page = (folder / "atlas.html").read_text()
    assert made["digest"] in page and all(f'href="{path.name}"' in page for path in cells)
    assert len(page) < 3_000_000
    for path in cells:
        text = path.read_text()
        _, kind, _ = proved(region, key_of(path.name), parse(text))
        assert kind in made["kinds"]
        if region.asked.kind != "attractor":  # enclosures of arcs over a box are not one arc's
            assert oracle(check(text).conclusions[0], random.Random(path.name)) == []


def test_all_questions_were_asked():
    names = ["attractor", "entropy-3", "horseshoe", "orbits", "orbits-0.3"]
    assert [folder.name for folder in MADE] == names


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
