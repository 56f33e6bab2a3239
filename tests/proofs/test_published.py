"""Published systems: certificates that the checker accepts, pages that say their conclusions."""

import html
import json
import re
from functools import cache
from pathlib import Path

import pytest

from proofs.commands.published import published
from proofs.commands.published_page import FOLDER, INDEX, index, page, theorem
from tests.once import once

ROOT = Path(__file__).parents[2]
NAMES = [path.stem for path in sorted((ROOT / FOLDER).glob("*.md"))]
LENGTHY = {"roessler"}  # half a minute, of which its horseshoe takes most
BY_SPEED = [pytest.param(x, marks=[pytest.mark.long] * (x in LENGTHY)) for x in NAMES]
LARGEST = 1_500_000
CURVES, GRAZES = ("branches", "folds", "flips"), ("grazing", "touching")


@cache
def systems():
    """What is published, by name: closed forms are solved for, which takes a second."""
    return {each.name: each for each in published()}


def claims(name, file):
    """What a certificate claims: so many conclusions."""
    return json.loads((ROOT / FOLDER / name / f"{file}.json").read_text())["claims"]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(LENGTHY))
def test_the_orbits_of_a_lengthy_system_stand_on_its_page(name):
    text = html.unescape((ROOT / FOLDER / f"{name}.md").read_text())
    orbits = [file for file in systems()[name].asked if file.startswith("orbits")]
    for file in orbits:
        proved = theorem(ROOT / FOLDER / name / f"{file}.json")
        assert proved.conclusions[0].sentence.rpartition(": ")[2] in text
    assert orbits


def files():
    return [(name, file) for name, each in systems().items() for file in each.asked]


@once
def theorems(name):
    """What the checker concludes from a system's certificates: one that it rejects raises."""
    return {file: theorem(ROOT / FOLDER / name / f"{file}.json") for file in systems()[name].asked}


@pytest.mark.slow
@pytest.mark.parametrize("name", BY_SPEED)
def test_a_page_says_what_its_certificates_conclude(name):
    proved, its = theorems(name), systems()[name]
    text = (ROOT / FOLDER / f"{name}.md").read_text()
    assert text == page(its, proved)
    for file, each in proved.items():
        assert len(each) == len(claims(name, file))
        parts = each.conclusions[0].sentence.rpartition(": ")[2].split("; ")
        assert all(part in html.unescape(text) for part in parts)
    assert text.index("## Theorems") < text.index("## What the literature says")
    assert its.source and its.source in text


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


@pytest.mark.slow
def test_certificates_are_about_the_systems_of_their_pages():
    """Other numbers for parameters aside: these are in the closed forms, too."""
    for name, file in files():
        functions = json.loads((ROOT / FOLDER / name / f"{file}.json").read_text())["functions"]
        own = systems()[name].system.functions
        if file in GRAZES:
            (each,), (gap,) = functions.values(), own["P"]["gaps"]
            assert each["gaps"] == [gap] and each["values"][-1] == f"D({gap}, t)"
            continue
        if file in CURVES:
            assert all(is_residual(each, own["P"]) for each in functions.values())
            continue
        if "section" in (end := own.get("P", {}).get("end", {})):
            own = {**own, "P2": {**own["P"], "end": {**end, "count": "2"}}}  # the second return
        assert {*functions} <= {*own, "Impact"}
        for key in {*functions} & {*own}:
            parts = {"variables", "periods", "gaps", "values", "maps", "end"} & {*own[key]}
            assert parts and all(functions[key][part] == own[key][part] for part in parts)


@pytest.mark.slow
def test_nothing_else_is_there_and_it_is_small():
    there = [path for path in (ROOT / FOLDER).rglob("*") if path.is_file()]
    wanted = {f"{name}/{file}.json" for name, file in files()}
    wanted |= {each for name in systems() for each in (f"{name}.md", f"{name}/portrait.svg")}
    assert {str(path.relative_to(ROOT / FOLDER)) for path in there} == wanted
    assert sum(path.stat().st_size for path in there if path.suffix == ".json") < LARGEST


@pytest.mark.slow
def test_the_index_is_current():
    """It counts conclusions, one for each claim, as the tests of the pages see."""
    counted = [(x, {file: claims(x.name, file) for file in x.asked}) for x in systems().values()]
    assert (ROOT / INDEX).read_text() == index(counted)
