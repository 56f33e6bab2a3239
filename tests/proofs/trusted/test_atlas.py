"""An atlas is what its certificates prove, and where: no cell twice, none in another's place."""

import json
import sqlite3
import zlib
from contextlib import closing
from fractions import Fraction
from hashlib import sha256

import pytest

from proofs.plane.head import Here, run
from proofs.plane.store import NAME, opened
from proofs.trusted.atlas import Region, area, check_store
from proofs.trusted.certificate import Malformed
from proofs.trusted.numbers import Phases
from proofs.trusted.paper.beyond.boxes import CoveringShift
from proofs.trusted.paper.beyond.singles import StableSingles
from proofs.trusted.parameters import Place
from proofs.trusted.questions import question
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected

F = Fraction
REGION = Region((F("0.2115"), F("0.2127")), (F("-0.201"), F("-0.199")), "horseshoe")
ORBITS = Region((F("0.595"), F("0.605")), (F("-0.755"), F("-0.745")), "orbits:3", (F("0.3"),) * 2)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("atlas")
    with opened(folder, REGION) as store:
        run(store, 2, (Here(), 1), 16)
    return (folder / NAME).read_bytes()


@pytest.fixture
def path(made, tmp_path):
    (tmp_path / NAME).write_bytes(made)
    return tmp_path / NAME


def edit(path, query, *values):
    with closing(sqlite3.connect(path)) as store, store:
        assert store.execute(query, values).rowcount > 0


def rows(path, query):
    with closing(sqlite3.connect(path)) as store:
        return store.execute(query).fetchall()


# -- the region ------------------------------------------------------------------------------------


def test_cells_are_quarters_in_the_order_of_their_digits():
    region = Region((F(0) + 1, F(2)), (F(-4), F(-2)), "attractor")
    assert region.box("0/") == Place((F(1), F(2)), (F(-4), F(-2)))
    assert region.box("0/1") == Place((F("1.5"), F(2)), (F(-4), F(-3)))
    assert region.box("0/2") == Place((F(1), F("1.5")), (F(-3), F(-2)))
    assert region.box("0/30") == Place((F("1.5"), F("1.75")), (F(-3), F("-2.5")))
    quarters = [region.box(f"0/3{digit}") for digit in "0123"]
    assert sum(map(area, quarters)) == area(region.box("0/3"))


def test_a_region_is_cut_at_resonance_and_where_the_table_stands_still():
    parts = Region((F("0.5"), F(2)), (F(-1), F(3)), "attractor").roots
    assert [part.eta for part in parts] == [(F("0.5"), 1), (1, F(2))] * 2
    assert all(part.nu[0] * part.nu[1] > 0 for part in parts)
    strips = 6 - sum(map(area, parts))
    assert 0 < strips < 6 * F(1, 2**20) * 2
    assert len(Region((F("0.5"), F(1)), (F(0), F(3)), "attractor").roots) == 1


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
        Region(*sides, question, epsilon and tuple(map(F, epsilon)))


def test_a_region_is_read_as_it_is_written_and_all_cells_have_its_epsilon():
    for region in (REGION, ORBITS):
        assert Region.of(region.text) == region
        assert {box.epsilon for box in (*region.roots, region.box("0/21"))} == {region.epsilon}
    assert "epsilon" not in REGION.text  # as it was before there was any
    for text in (
        REGION.text.replace('"horseshoe"', '"horseshoe", "epsilon": ["1/3", "1/2"]'),
        ORBITS.text.replace("3/10", "1"),
        ORBITS.text.replace('["3/10", "3/10"]', '"3/10"'),
        ORBITS.text.replace('["3/10", "3/10"]', "null"),
        ORBITS.text.replace("orbits", "orbit"),
    ):
        with pytest.raises(Malformed):
            Region.of(text)


@pytest.mark.parametrize("key", ["", "0", "1/", "0/4", "0/" + "0" * 41, "-1/", "00/", "0/0/"])
def test_what_is_no_cell(key):
    with pytest.raises(Malformed):
        REGION.box(key)


# -- the store -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_all_cells_are_proved_again(path):
    found = check_store(path)
    assert found.cells == {"SPLIT": 5, "VERIFIED": 16}
    assert found.areas["VERIFIED"] == found.whole and found.missing == 0


@pytest.mark.slow
def test_cells_that_are_not_there_are_missing(path):
    edit(path, "DELETE FROM cells WHERE key = '0/01'")
    found = check_store(path)
    assert found.missing == found.whole / 16
    edit(path, "DELETE FROM cells WHERE key LIKE '0/0_'")
    assert check_store(path).missing == found.whole / 4


PROVED = "verdict = 'VERIFIED' AND key = '0/12'"


@pytest.mark.parametrize(
    "change",
    [
        f"verdict = 'REFUTED' WHERE {PROVED}",
        f"verdict = 'CONDITIONAL' WHERE {PROVED}",
        f"conclusion = 'f is chaotic' WHERE {PROVED}",
        f"kind = 'AtRest' WHERE {PROVED}",
        f"eta = '[0.2, 0.3]' WHERE {PROVED}",
        f"nu = '[0.2, 0.3]' WHERE {PROVED}",
        f"sha256 = '{'0' * 64}' WHERE {PROVED}",
        f"certificate = (SELECT certificate FROM cells WHERE key = '0/11') WHERE {PROVED}",
        f"verdict = 'UNDECIDED' WHERE {PROVED}",
        f"verdict = 'SPLIT' WHERE {PROVED}",
        "verdict = 'VERIFIED' WHERE key = '0/1'",
        "key = '0/122' WHERE key = '0/12'",
        "key = '0/4' WHERE key = '0/12'",
        f"certificate = NULL WHERE {PROVED}",
        f"certificate = 'text' WHERE {PROVED}",
        f"certificate = substr(certificate, 1, 100) WHERE {PROVED}",
        f"verdict = NULL WHERE {PROVED}",
    ],
)
def test_a_cell_that_is_not_what_is_proved(path, change):
    edit(path, f"UPDATE cells SET {change}")
    with pytest.raises((Rejected, Malformed)):
        check_store(path)


def test_a_cell_inside_of_one_that_is_decided(path):
    """Cells that overlap would count an area twice."""
    edit(
        path,
        "INSERT INTO cells SELECT '0/123', eta, nu, 'UNDECIDED', '', '', NULL, NULL, 0, '' "
        "FROM cells WHERE key = '0/12'",
    )
    with pytest.raises(Rejected, match="quarter"):
        check_store(path)


def put(path, key, document):
    packed = json.dumps(document).encode()
    edit(
        path,
        "UPDATE cells SET certificate = ?, sha256 = ? WHERE key = ?",
        zlib.compress(packed),
        sha256(packed).hexdigest(),
        key,
    )


def test_a_certificate_of_another_box_or_about_something_else(path):
    ((packed,),) = rows(path, "SELECT certificate FROM cells WHERE key = '0/12'")
    document = json.loads(zlib.decompress(packed))
    put(path, "0/12", document)
    check_store(path)
    first = next(iter(document["steps"]))
    for false in (
        document | {"parameters": {"eta": ["2120/10000", "2121/10000"], "nu": ["-1/5", "-19/99"]}},
        {**document, "steps": {first: document["steps"][first]}, "claims": [first]},
        {**document, "claims": [*document["claims"], first]},
    ):
        put(path, "0/12", false)
        with pytest.raises((Rejected, Malformed)):
            check_store(path)


def test_what_is_proved_of_another_box_is_not_of_this_one(path):
    """The whole proof of a neighbour in the place of a cell's, words and digest with it."""
    names = "kind", "conclusion", "certificate", "sha256"
    taken = ", ".join(f"{x} = (SELECT {x} FROM cells WHERE key = '0/11')" for x in names)
    edit(path, f"UPDATE cells SET {taken} WHERE key = '0/12'")
    with pytest.raises(Rejected, match="other parameters"):
        check_store(path)


def test_another_region_or_none(path):
    region = Region((F("0.2115"), F("0.2128")), REGION.nu, "horseshoe")
    edit(path, "UPDATE region SET text = ?", region.text)
    with pytest.raises(Rejected):
        check_store(path)
    for text in ("", "{}", REGION.text.replace("atlas/1", "atlas/2"), REGION.text.replace("-", "")):
        edit(path, "UPDATE region SET text = ?", text)
        with pytest.raises(Malformed):
            check_store(path)
    edit(path, "DELETE FROM region")
    with pytest.raises(Malformed):
        check_store(path)


def test_what_is_proved_for_one_epsilon_is_not_of_another(tmp_path):
    with opened(tmp_path, ORBITS) as store:
        run(store, 1, (Here(), 1), 16)
    path = tmp_path / NAME
    found = check_store(path)
    assert found.cells["VERIFIED"] and found.missing == 0
    for text in (
        ORBITS.text.replace("3/10", "2/5"),
        ORBITS.text.replace(', "epsilon": ["3/10", "3/10"]', ""),
        ORBITS.text.replace("orbits:3", "orbits:4"),
    ):
        edit(path, "UPDATE region SET text = ?", text)
        with pytest.raises(Rejected):
            check_store(path)


def test_more_sets_than_asked_for_are_enough_and_fewer_are_not():
    at = Place((F("0.2121"),) * 2, (F("-0.2"),) * 2)
    phases = [Phases(F(k), F(k) + F(1, 2)) for k in range(4)]
    for count in (2, 3, 4):
        found = [CoveringShift(at, tuple(phases[:count]))]
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


def test_what_is_no_store(tmp_path):
    path = tmp_path / NAME
    path.write_bytes(b"SQLite format 3\0" + bytes(4000))
    with pytest.raises(Malformed):
        check_store(path)
