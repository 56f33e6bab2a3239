"""Published systems: certificates that the checker accepts, pages that say their conclusions."""

import html
import json
import re
from pathlib import Path

import pytest

from proofs.commands.published import published
from proofs.commands.published_page import FOLDER, INDEX, index, page, theorem
from tests.once import once

ROOT = Path(__file__).parents[2]
PAGES = {each.name: each for each in published()}
FILES = [(name, file) for name, each in PAGES.items() for file in each.asked]
LARGEST = 1_500_000
CURVES = "branches", "folds", "flips"


@once
def theorems(name):
    """What the checker concludes from a system's certificates: one that it rejects raises."""
    return {file: theorem(ROOT / FOLDER / name / f"{file}.json") for file in PAGES[name].asked}


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_a_page_says_what_its_certificates_conclude(name):
    proved = theorems(name)
    text = (ROOT / FOLDER / f"{name}.md").read_text()
    assert text == page(PAGES[name], proved)
    for each in proved.values():
        assert each.conclusions[0].sentence.rpartition(": ")[2] in html.unescape(text)
    assert text.index("## Theorems") < text.index("## What the literature says")
    assert PAGES[name].source and PAGES[name].source in text


def is_residual(function, own):
    """Whether the values are those of a map less the state, which parameters follow."""
    count = len(own["variables"])
    values = [re.sub(r"\be\b", "ee", value) for value in own["values"]]
    values = values if "ee" in function["variables"] else own["values"]
    pairs = zip(function["values"], values, own["variables"], strict=False)
    return (
        function["gaps"] == own["gaps"]
        and function["variables"][:count] == own["variables"]
        and all(left.startswith(f"{value} - {name}") for left, value, name in pairs)
    )


def test_certificates_are_about_the_systems_of_their_pages():
    """Other numbers for parameters aside: these are in the closed forms, too."""
    for name, file in FILES:
        functions = json.loads((ROOT / FOLDER / name / f"{file}.json").read_text())["functions"]
        own = PAGES[name].system.functions
        if file in CURVES:
            assert all(is_residual(each, own["P"]) for each in functions.values())
            continue
        if "section" in (end := own.get("P", {}).get("end", {})):
            own = {**own, "P2": {**own["P"], "end": {**end, "count": "2"}}}  # the second return
        assert {*functions} <= {*own, "Impact"}
        for key in {*functions} & {*own}:
            parts = {"variables", "periods", "gaps", "values", "maps", "end"} & {*own[key]}
            assert parts and all(functions[key][part] == own[key][part] for part in parts)


def test_nothing_else_is_there_and_it_is_small():
    files = [path for path in (ROOT / FOLDER).rglob("*") if path.is_file()]
    wanted = {f"{name}/{file}.json" for name, file in FILES}
    wanted |= {f"{name}.md" for name in PAGES} | {f"{name}/portrait.svg" for name in PAGES}
    assert {str(path.relative_to(ROOT / FOLDER)) for path in files} == wanted
    assert sum(path.stat().st_size for path in files if path.suffix == ".json") < LARGEST


@pytest.mark.slow
def test_the_index_is_current():
    assert (ROOT / INDEX).read_text() == index([(PAGES[name], theorems(name)) for name in PAGES])
