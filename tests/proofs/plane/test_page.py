"""The page of an atlas holds what the store says of each cell, to the letter, and little more."""

import random
import re
from fractions import Fraction

import pytest

from proofs.plane import picture, summary
from proofs.plane.page import corner, data, page, said, size
from proofs.plane.picture import Overlay
from proofs.plane.store import Row, opened, quarters
from proofs.trusted.atlas import Region
from proofs.trusted.numbers import show_range
from proofs.trusted.subjects import Oscillators

F = Fraction
CUT = Region((F("0.9"), F("1.1")), (F("-1/3"), F("0.1")), "attractor")
PLAIN = Region((F("0.15"), F("0.35")), (F("-0.4"), F("-0.1")), "attractor")


def sentences(rng, box):
    at = f"At eta in {show_range(box.eta)}, nu in {show_range(box.nu)}, epsilon = 0: "
    phase = f"[{rng.randrange(10**6) / 10**6}, {1 + rng.randrange(10**6) / 10**6}]"
    yield "VERIFIED", "StickingMotion", f"{at}it has 1 impact, at a phase in {phase}."
    yield "VERIFIED", "StickingMotion", f"{at}it has 2 impacts, at a phase in {phase}."
    yield "VERIFIED", "StableOrbit", f"{at}|multiplier| <= {rng.randrange(100)}/7 <C0>, {{0, 1}}."
    yield "REFUTED", "AtRest", f"{at}the mass stays."
    yield "UNDECIDED", "", "an earlier impact is not excluded"
    yield "UNDECIDED", "", "-3 is no 2-1 of at eta in [0, 1]"


def cells(region, depth, rng, share=0.9):
    """Leaves of a tree as deep as this at most, some of them missing."""

    def below(key):
        if len(key.partition("/")[2]) < depth and rng.random() < share:
            for child in quarters(key):
                yield from below(child)
        elif rng.random() < 0.95:
            verdict, kind, text = rng.choice(
                [*sentences(rng, region.subject.at(region.sides(key)))]
            )
            yield Row(key, verdict, kind, text)

    for number in range(len(region.roots)):
        yield from below(f"{number}/")


def told(held):
    """Read the page's data as its script does: for each leaf what is said, and of which box."""
    for number, root in enumerate(held["roots"]):
        codes = iter(root["tree"])

        def node(key, root=root, codes=codes):
            code = next(codes)
            if code == -1:
                for child in quarters(key):
                    yield from node(child)
            elif code >= 0:
                at, side = corner(key, root["depth"]), size(key, root["depth"])
                sides = [
                    f"[{root[name][low]}, {root[name][low + side]}]"
                    for name, low in zip(("eta", "nu"), at, strict=True)
                ]
                pattern, *numbers = held["said"][code].split(" ")
                verdict, kind, parts = held["patterns"][int(pattern)]
                words = [
                    x if isinstance(x, str) else sides[-1 - x] if x < 0 else numbers[x]
                    for x in parts
                ]
                yield key, verdict, kind, "".join(words), *sides

        yield from node(f"{number}/")
        assert next(codes, None) is None


@pytest.mark.parametrize("region", [PLAIN, CUT])
@pytest.mark.parametrize("seed", [1, 3, 4])
def test_each_cell_is_told_as_it_is_stored(region, seed):
    there = list(cells(region, 4, random.Random(seed), share=0.95))
    want = [(*x[:4], *map(show_range, region.sides(x.key))) for x in there]
    assert list(told(data(region, there))) == want and len(want) > 99


def test_alike_sentences_are_one_pattern_and_equal_ones_are_there_once():
    at = "At eta in [0.15, 0.25], nu in [-0.4, -0.25], epsilon = 0: "
    row = Row("0/0", "VERIFIED", "", at + "C0 = [1.5, -2/3].")
    numbers = said(row, *map(show_range, PLAIN.sides("0/0"))).numbers
    assert numbers == ("0", "0", "1.5", "-2/3")
    there = list(cells(PLAIN, 5, random.Random(1), share=1))
    held = data(PLAIN, there)
    assert len(there) > 900 and len(held["patterns"]) == 6
    assert len(held["said"]) == len(set(held["said"])) < len(there)


@pytest.mark.parametrize(
    ("epsilon", "told"),
    [
        (None, "Impacts are plastic"),
        ((F("0.3"), F("0.3")), "Impacts have the restitution ε = 0.3"),
        ((F(0), F("1/3")), "Impacts have the restitution ε in [0, 1/3]"),
    ],
)
def test_the_page_says_what_impacts_it_is_about(tmp_path, epsilon, told, monkeypatch):
    pytest.importorskip("jinja2")
    monkeypatch.setattr(picture, "overlay", lambda region: Overlay([], []))
    region = Region(PLAIN.first, PLAIN.second, "orbits", Oscillators(epsilon))
    with opened(tmp_path, region) as store:
        store.put([Row("0/", "UNDECIDED", "", "nothing is found")])
        made = summary.summary(store)
        text = page(store, picture.shown(store, made))
    lede = re.search('<p class="lede">(.*?)</p>', text)[1]
    assert re.sub("<.*?>", "", lede).startswith(f"{told}. In each cell")
