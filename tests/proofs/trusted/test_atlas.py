"""An atlas is what its certificates prove, and where: no cell twice, none in another's place."""

import copy
import json
import math
import tracemalloc
from fractions import Fraction

import pytest

from proofs.trusted.atlas import Region, area, check_atlas
from proofs.trusted.certificate import SCHEMA as DOCUMENT
from proofs.trusted.certificate import Malformed, Reader, texts
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper.beyond.singles import StableSingles
from proofs.trusted.paper.branches import Branch
from proofs.trusted.parameters import Place
from proofs.trusted.questions import question
from proofs.trusted.subjects import Oscillators, Systems
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.oracles.edits import needed
from tests.proofs.plane.test_systems import made_of
from tests.proofs.trusted.kernel import lemma_examples

F = Fraction
REGION = Region((F("0.2115"), F("0.2127")), (F("-0.201"), F("-0.199")), "horseshoe")
ORBITS = Region(
    (F("0.595"), F("0.605")), (F("-0.755"), F("-0.745")), "orbits:3", Oscillators((F("0.3"),) * 2)
)


# -- the region ------------------------------------------------------------------------------------


def test_cells_are_quarters_in_the_order_of_their_digits():
    region = Region((F(0) + 1, F(2)), (F(-4), F(-2)), "attractor")
    assert region.subject.at(region.sides("0/")) == Place((F(1), F(2)), (F(-4), F(-2)))
    assert region.subject.at(region.sides("0/1")) == Place((F("1.5"), F(2)), (F(-4), F(-3)))
    assert region.subject.at(region.sides("0/2")) == Place((F(1), F("1.5")), (F(-3), F(-2)))
    assert region.subject.at(region.sides("0/30")) == Place(
        (F("1.5"), F("1.75")), (F(-3), F("-2.5"))
    )
    quarters = [region.sides(f"0/3{digit}") for digit in "0123"]
    assert sum(map(area, quarters)) == area(region.sides("0/3"))


def test_a_region_is_cut_at_resonance_and_where_the_table_stands_still():
    parts = Region((F("0.5"), F(2)), (F(-1), F(3)), "attractor").roots
    assert [eta for eta, _ in parts] == [(F("0.5"), 1), (1, F(2))] * 2
    assert all(nu[0] * nu[1] > 0 for _, nu in parts)
    strips = 6 - sum(map(area, parts))
    assert 0 < strips < 6 * F(1, 2**20) * 2
    assert len(Region((F("0.5"), F(1)), (F(0), F(3)), "attractor").roots) == 1


@pytest.mark.every
@pytest.mark.parametrize(
    ("eta", "nu", "question", "match"),
    [
        ((2, 1), (1, 2), "horseshoe", "eta: reversed or empty"),
        ((1, 1), (1, 2), "horseshoe", "eta: reversed or empty"),
        ((1, 2), (1, 1), "horseshoe", "nu: reversed or empty"),
        ((0, 1), (1, 2), "horseshoe", "positive"),
        ((-1, 1), (1, 2), "horseshoe", "positive"),
        ((1, 2), (1, 2), "chaos", "question"),
    ],
)
def test_what_is_no_region(eta, nu, question, match):
    with pytest.raises(ValueError, match=match):
        Region(tuple(map(F, eta)), tuple(map(F, nu)), question)


@pytest.mark.every
@pytest.mark.parametrize(
    ("question", "epsilon", "match"),
    [
        ("horseshoe", ("0.1", "0.1"), "horseshoe is asked for plastic impacts alone"),
        ("entropy:3", ("0", "0.1"), "plastic"),
        ("attractor", ("0.1", "0.1"), "plastic"),
        ("orbits", ("0.2", "0.1"), "epsilon"),
        ("orbits", ("0.5", "1"), "epsilon"),
        ("orbits", ("-0.1", "0.1"), "epsilon"),
        *(
            (name, None, "the question is one of")
            for name in ("entropy", "entropy:1", "entropy:51")
        ),
        *((name, None, "the question is one of") for name in ("entropy:03", "entropy:3.5", "rest")),
        *((name, None, "the question is one of") for name in ("orbits:", "orbits:0", "orbits:101")),
        *((name, None, "the question is one of") for name in ("attractor:2", "horseshoe:2", "")),
    ],
)
def test_what_is_not_asked(question, epsilon, match):
    sides = (F(1), F(2)), (F(1), F(2))
    with pytest.raises(ValueError, match=match):
        Region(*sides, question, Oscillators(epsilon and tuple(map(F, epsilon))))


def test_a_region_is_read_as_it_is_written_and_all_cells_have_its_epsilon():
    for region in (REGION, ORBITS):
        assert Region.read(region.text) == region
        assert (
            region.subject.at(region.sides("0/")).epsilon
            == region.subject.at(region.sides("0/21")).epsilon
            == region.subject.epsilon
        )
    assert "epsilon" not in REGION.text  # as it was before there was any
    for text in (
        REGION.text.replace('"horseshoe"', '"horseshoe","epsilon":["1/3","1/2"]'),
        ORBITS.text.replace("3/10", "1"),
        ORBITS.text.replace('["3/10","3/10"]', '"3/10"'),
        ORBITS.text.replace('["3/10","3/10"]', "null"),
        ORBITS.text.replace("orbits", "orbit"),
    ):
        assert text not in (REGION.text, ORBITS.text)
        with pytest.raises(Malformed):
            Region.read(text)


@pytest.mark.every
@pytest.mark.parametrize("key", ["", "0", "1/", "0/4", "0/" + "0" * 41, "-1/", "00/", "0/0/"])
def test_what_is_no_cell(key):
    with pytest.raises(Malformed):
        REGION.subject.at(REGION.sides(key))


# -- lines -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return made_of(tmp_path_factory.mktemp("atlas"), REGION, 2)


@pytest.fixture
def lines(made):
    """The region, and 16 cells of it: "0/00" to "0/33"."""
    return copy.deepcopy(made)


def proved(lines, work=DEFAULT):
    return check_atlas(map(json.dumps, lines), work)


def refused(lines, match="line|box|cell"):
    with pytest.raises((Rejected, Malformed), match=match):
        proved(lines)


def test_all_cells_are_proved_again(lines):
    assert proved(lines) == ({"VERIFIED": 16}, {"VERIFIED": 1})


def without(line, verdict):
    return line | {"verdict": verdict, "kind": "", "certificate": None}


def test_what_is_open_is_told_with_its_area(lines):
    lines[5], lines[6] = without(lines[5], "UNDECIDED"), without(lines[6], "not looked at")
    shares = proved(lines).shares
    assert shares == {"VERIFIED": F(7, 8), "UNDECIDED": F(1, 16), "not looked at": F(1, 16)}


ORDER = {
    "a cell is there twice, and another one is not": lambda cells: [
        *cells[:6],
        cells[5],
        *cells[7:],
    ],
    "one cell many times, others not at all": lambda cells: cells[:1] * 16,
    "a cell is there twice": lambda cells: [*cells[:6], *cells[5:]],
    "none but the first": lambda cells: cells[:1],
    "none": lambda cells: [],
    "the last one is missing": lambda cells: cells[:-1],
    "the first one is missing": lambda cells: cells[1:],
    "one is missing": lambda cells: [*cells[:4], *cells[5:]],
    "two change places": lambda cells: [*cells[:4], cells[5], cells[4], *cells[6:]],
    "all twice": lambda cells: cells * 2,
    "a cell in another one": lambda cells: [*cells[:4], *nested(cells[4]), *cells[5:]],
    "a cell around another one": lambda cells: [without(box(cells[0], "0/0"), "UNDECIDED"), *cells],
    "a part that is not there": lambda cells: [*cells, box(cells[0], "1/", REGION.sides("0/"))],
    "one too small at the end": lambda cells: [
        *cells[:-1],
        without(box(cells[0], "0/330"), "UNDECIDED"),
    ],
}


def box(line, key, sides=None):
    eta, nu = map(texts, sides or REGION.sides(key))
    return line | {"cell": key, "eta": eta, "nu": nu}


def nested(line):
    inner = without(box(line, line["cell"] + "2"), "UNDECIDED")
    return [line, inner]


@pytest.mark.every
@pytest.mark.parametrize("name", ORDER)
def test_cells_that_do_not_make_up_the_region(lines, name):
    refused([lines[0], *ORDER[name](lines[1:])], "ended|no cell|missing")


LIES = {
    "verdict": {"verdict": "REFUTED"},
    "another verdict": {"verdict": "CONDITIONAL"},
    "no verdict": {"verdict": None},
    "words": {"says": "f is chaotic"},
    "kind": {"kind": "AtRest"},
    "eta": {"eta": ["1/5", "3/10"]},
    "nu": {"nu": ["1/5", "3/10"]},
    "undecided, and a certificate": {"verdict": "UNDECIDED"},
    "not looked at, and a certificate": {"verdict": "not looked at"},
    "left out": {"verdict": "left out", "kind": "", "certificate": None},
    "split": {"verdict": "SPLIT", "kind": "", "certificate": None},
    "no certificate": {"certificate": None},
    "a text": {"certificate": "text"},
    "a kind without a certificate": {"verdict": "UNDECIDED", "certificate": None},
    "a digit too many": {"cell": "0/4"},
    "a space": {"cell": "0/00 "},
    "another way to write it": {"cell": "00/00"},
    "no cell": {"cell": None},
    "deep": {"cell": "0/" + "0" * 41},
    "more": {"more": ""},
}


@pytest.mark.every
@pytest.mark.parametrize("name", LIES)
def test_a_cell_that_is_not_what_is_proved(lines, name):
    lines[1] |= LIES[name]
    refused(lines, "line 2: ")


def test_a_certificate_of_another_box_or_about_something_else(lines):
    document = lines[7]["certificate"]
    first = next(iter(document["steps"]))
    for false in (
        document | {"parameters": {"eta": ["2120/10000", "2121/10000"], "nu": ["-1/5", "-19/99"]}},
        document | {"parameters": lines[6]["certificate"]["parameters"]},
        {**document, "steps": {first: document["steps"][first]}, "claims": [first]},
        {**document, "claims": [*document["claims"], first]},
        lines[6]["certificate"],
    ):
        lines[7]["certificate"] = false
        refused(lines, "line 8: ")


def test_what_is_proved_of_another_box_is_not_of_this_one(lines):
    """The whole proof of a neighbour in the place of a cell's, and its words."""
    lines[7] |= {name: lines[6][name] for name in ("kind", "says", "certificate")}
    refused(lines, "other parameters")


def test_the_paper_s_map_is_no_function_of_a_file_whatever_its_name():
    """A map without fixed points, and one of the paper's oscillator, which has that name."""
    box, sides = [[1, 2]] * 2, {"eta": "2121/10000", "nu": "-1/5", "epsilon": "1/100"}
    witness = {
        "function": {name: [value] * 2 for name, value in sides.items()},
        "period": "1",
        "turns": ["4"],
        "box": [["557619/500000", "557649/500000"], ["-423249/1000000", "-423189/1000000"]],
        "matrix": [["1343/5000", "123/10000"], ["299/5000", "-4997/5000"]],
    }
    step = {"p": {"rule": "periodic-orbit", "witness": witness}}
    document = {"schema": DOCUMENT, "parameters": None, "functions": {}, "steps": step}
    document["claims"] = ["p"]
    (says,) = check(json.dumps(document)).sentences
    moved = {
        "variables": ["x"],
        "parameters": {"a": ["0"] * 2, "b": ["0"] * 2},
        "values": ["x+a+b"],
    }
    region = Region(*box, "orbits:1", Systems({"F": moved}, "F", ("a", "b")))
    said = {"verdict": "VERIFIED", "kind": "PeriodicOrbit", "says": says, "certificate": document}
    cell = {"cell": "0/", "a": ["1", "2"], "b": ["1", "2"], **said}
    refused([json.loads(region.text), cell], "does not answer the question")


@pytest.mark.parametrize(("step", "asked"), [("covering", "entropy:2"), ("orbit", "attractor")])
def test_a_function_of_a_file_is_not_the_paper_s_map(step, asked):
    """What is proved of a map of the line, in a file about the oscillators of the cell."""
    region = Region((F("0.2"), F("0.25")), (F("-0.2"), F("-0.1")), asked)
    sides = {name: texts(side) for name, side in zip(region.names, region.sides_of, strict=True)}
    document = json.loads(lemma_examples.text("lines"))
    steps = needed(document["steps"], [step])
    document |= {"parameters": sides, "steps": steps, "claims": [step]}
    named = {name for each in steps.values() for name in Reader(each).mentioned()}
    document["functions"] = {k: x for k, x in document["functions"].items() if k in named}
    (found,) = check(json.dumps(document)).conclusions
    said = {"verdict": "VERIFIED", "kind": found.kind, "says": found.sentence}
    cell = {"cell": "0/", **sides, **said, "certificate": document}
    refused([json.loads(region.text), cell], "other parameters")


def test_what_is_proved_of_another_oscillator_is_not_of_the_cell_s():
    """A stable orbit of the f that a witness names, in a file about the oscillators of a cell."""
    own = {"eta": ["1/4", "321/1280"], "nu": ["-157/640", "-125/512"]}
    ends = ["3120493/500000", "3243709/500000"]
    slopes = {"function": own, "points": ends, "bits": "64"}
    cells = [{"slopes": "s", "domain": ends}]
    steps = {
        "s": {"rule": "slopes", "witness": slopes},
        "o": {"rule": "stable-orbit", "witness": {"cells": cells}},
    }
    for eta, nu in ((own["eta"], own["nu"]), (["1/4", "321/1280"], ["-157/640", "-124/512"])):
        sides = {"eta": eta, "nu": [str(F(x)) for x in nu]}
        region = Region(*(tuple(map(F, side)) for side in sides.values()), "attractor")
        document = {"schema": DOCUMENT, "parameters": sides, "functions": {}, "steps": steps}
        document["claims"] = ["o"]
        (says,) = check(json.dumps(document)).sentences
        said = {"verdict": "VERIFIED", "kind": "StableOrbit", "says": says}
        atlas = [json.loads(region.text), {"cell": "0/", **sides, **said, "certificate": document}]
        if sides == own:
            assert proved(atlas).shares == {"VERIFIED": 1}
        else:
            refused(atlas, "other parameters")


def test_another_region_or_none(lines):
    region = Region((F("0.2115"), F("0.2128")), REGION.second, "horseshoe")
    refused([json.loads(region.text), *lines[1:]], "box is another")
    for text in ("", "{}", REGION.text.replace("atlas/2", "atlas/1"), REGION.text.replace("-", "")):
        with pytest.raises(Malformed):
            check_atlas([text, *map(json.dumps, lines[1:])])
    with pytest.raises(Malformed):
        check_atlas([])


def test_what_is_proved_for_one_epsilon_is_not_of_another(tmp_path):
    held = made_of(tmp_path, ORBITS, 1)
    found = proved(held)
    assert found.cells["VERIFIED"] and "not looked at" not in found.shares
    for change in ({"epsilon": ["2/5", "2/5"]}, {"question": "orbits:4"}):
        refused([held[0] | change, *held[1:]])
    held[0].pop("epsilon")
    refused(held)


STRIP = Region((F("0.5"), F("0.6")), (F("-0.1"), F("0.1")), "horseshoe")


def of_strip(**changes):
    """An atlas that is not looked at, with a strip; changes: of that line."""
    line = {"verdict": "not looked at", "kind": "", "says": "", "certificate": None}
    cells = [box(line, key, STRIP.sides(key)) for key in ("0/", "1/", "2/")]
    cells[2] |= {"verdict": "left out"} | changes
    return [json.loads(STRIP.text), *cells]


def test_the_strip_is_a_line_and_nothing_is_proved_of_it(lines):
    assert proved(of_strip()).shares == {"not looked at": 1 - F(1, 2**20), "left out": F(1, 2**20)}
    (low, high) = STRIP.sides("2/")[1]
    assert low < 0 < high and STRIP.sides("0/")[1][1] == low and STRIP.sides("1/")[1][0] == high
    refused(of_strip()[:-1], "missing")
    for changes in (
        {"verdict": "not looked at"},
        {"verdict": "UNDECIDED"},
        {"verdict": "VERIFIED", "kind": "AtRest"},
        {"certificate": lines[1]["certificate"]},
        {"cell": "2/0"},
        {"nu": ["0", "1/10"]},
    ):
        refused(of_strip(**changes), "line 4: ")


def test_one_budget_is_for_all_cells(lines):
    proved(lines)  # some values are kept
    with metered(math.inf) as meter:
        proved(lines, math.inf)
    proved(lines, meter.spent)
    with pytest.raises(Exhausted, match="--work"):
        proved(lines, meter.spent - 1)


@pytest.mark.slow
def test_memory_does_not_grow_with_the_number_of_cells(lines):
    """Of undecided ones; a list of them would be larger."""
    line = json.dumps(without(lines[1], "UNDECIDED"))
    region = json.dumps(lines[0])
    peaks = []
    for depth in (4, 6):

        def every(depth=depth):
            yield region
            for place in range(4**depth):
                key = "0/" + "".join(f"{place >> 2 * k & 3}" for k in reversed(range(depth)))
                yield json.dumps(box(json.loads(line), key))

        tracemalloc.start()
        assert check_atlas(every()).cells == {"UNDECIDED": 4**depth}
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.5 * peaks[0]


def test_more_sets_than_asked_for_are_enough_and_fewer_are_not():
    at = Place((F("0.2121"),) * 2, (F("-0.2"),) * 2)
    branches = tuple(Branch(at, (F(k), F(k) + F(1, 2)), 1, ((F(1), F(2)),)) for k in range(4))
    for count in (2, 3, 4):
        cells = tuple(branch.phases for branch in branches[:count])
        found = [EntropyBound(PlasticMap(at), branches, 1, F(count), cells)]
        verdicts = [question(f"entropy:{k}").verdict(found) for k in (2, 3, 4)]
        assert [x is Verdict.VERIFIED for x in verdicts] == [k <= count for k in (2, 3, 4)]
        assert question("horseshoe").verdict(found) is Verdict.VERIFIED
        assert question("orbits").verdict(found) is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("most", "stable", "verdict"),
    [(10, (1, 3), "VERIFIED"), (10, (), "REFUTED"), (9, (1,), "UNDECIDED"), (11, (), "UNDECIDED")],
)
def test_orbits_are_decided_by_all_n_up_to_the_one_asked_for(most, stable, verdict):
    found = [StableSingles(Place((F(1),) * 2, (F(1),) * 2), most, stable)]
    assert question("orbits").verdict(found).value == verdict
    assert question("orbits:10").verdict(found * 2) is Verdict.UNDECIDED
