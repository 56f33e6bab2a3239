"""Atlases of any map: what a cell says is about the head's functions, all over its box."""

import json
import math
from fractions import Fraction as F

import pytest

from proofs import Map, System
from proofs.commands.atlas import main
from proofs.plane.head import Here, run
from proofs.plane.store import opened
from proofs.trusted.atlas import Region, check_atlas
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.subjects import Systems
from proofs.trusted.verify import Rejected

BOX = {"x": ("-2", "2"), "y": ("-1", "1")}


def systems(map_, *names):
    return Systems(map_.functions, map_.function, names, tuple(map_.region()))


def henon(a, b):
    made = Map("1 - a*x^2 + y", "b*x", a=a, b=b)
    made.box = BOX
    return made


SIDES = (F(1, 10), F(9, 10)), (F(1, 10), F(5, 10))
REGION = Region(*SIDES, "stable:1", systems(henon(*SIDES), "a", "b"))


def made_of(folder, region, depth):
    with opened(folder, region) as store:
        run(store, depth, (Here(), 1), 16)
        return [json.loads(line) for line in store.lines()]


@pytest.fixture(scope="module")
def lines(tmp_path_factory):
    return made_of(tmp_path_factory.mktemp("atlas"), REGION, 3)


def written(lines):
    return [json.dumps(line) for line in lines]


def is_stable(a, b):
    """By the closed form of Henon's fixed point: z^2 + 2 a x z - b has its zeros inside."""
    x = (b - 1 + math.sqrt((1 - b) ** 2 + 4 * a)) / (2 * a)
    return abs(2 * a * x) < 1 - b


def test_a_region_is_read_as_it_is_written():
    assert Region.read(REGION.text) == REGION


def test_all_functions_of_a_certificate_are_those_of_the_box():
    known = REGION.subject.at(SIDES)
    (function,) = known.values()
    other = {**function, "values": ["x", "y"]}
    for own, is_so in ((known, True), ({**known, "G": other}, False), ({"G": other}, False)):
        certificate = Reader({"functions": own})
        assert REGION.subject.is_about(certificate, None, SIDES) is is_so


def test_cells_are_where_the_orbit_is_stable(lines):
    areas = check_atlas(written(lines))
    assert F(1, 6) < areas.shares["VERIFIED"] < F("0.347") and areas.cells["UNDECIDED"] > 0
    for line in lines[1:]:
        corners = [(float(F(a)), float(F(b))) for a in line["a"] for b in line["b"]]
        if line["verdict"] == "VERIFIED":
            assert all(is_stable(*corner) for corner in corners)
        else:  # next to the flip curve
            assert not all(is_stable(a + 0.1, b + 0.1) for a, b in corners)


def first(lines):
    return next(line for line in lines[1:] if line["certificate"])


def step(line):
    ((_, only),) = line["certificate"]["steps"].items()
    return only["witness"]


LIES = {
    "of another map": lambda lines: lines[0]["functions"]["F"]["values"].reverse(),
    "of another map, in the cell": lambda lines: first(lines)["certificate"]["functions"]["F"][
        "values"
    ].__setitem__(1, "b*x + 0*y"),
    "for fewer parameters": lambda lines: first(lines)["certificate"]["functions"]["F"][
        "parameters"
    ].update(a=["1/4", "1/4"]),
    "of another function": lambda lines: lines[0].update(function="G"),
    "another question": lambda lines: lines[0].update(question="orbits:2"),
    "no question": lambda lines: lines[0].update(question="stable"),
    "no such parameter": lambda lines: lines[0].update(
        parameters={"a": ["1/10", "9/10"], "c": ["1/10", "1/2"]}
    ),
    "one parameter": lambda lines: lines[0].update(parameters={"a": ["1/10", "9/10"]}),
    "another range": lambda lines: lines[0]["parameters"].update(a=["1/10", "1"]),
    "no functions": lambda lines: lines[0].update(functions=[]),
    "parameters that are none": lambda lines: lines[0]["functions"]["F"].update(parameters="a"),
    "another orbit": lambda lines: step(first(lines)).update(box=[["3", "4"], ["3", "4"]]),
    "refuted": lambda lines: first(lines).update(verdict="REFUTED"),
    "without a proof": lambda lines: first(lines).update(certificate=None),
}


@pytest.mark.parametrize("name", LIES)
def test_lies_are_refused(lines, name):
    edited = json.loads(json.dumps(lines))
    LIES[name](edited)
    assert edited != lines
    with pytest.raises((Malformed, Rejected)):
        check_atlas(written(edited))


@pytest.mark.slow
def test_an_orbit_of_a_part_of_the_way_is_none():
    """P12 takes a state at one wall to one at the other: a fixed point of it is no orbit."""
    walls = System.example("two-walls", k=("0.4", "0.5"), e=("0.8", "0.9"))
    sides = (F("0.4"), F("0.5")), (F("0.8"), F("0.9"))
    region = Region(*sides, "orbits:1", systems(walls, "k", "e"))
    assert region.subject.function == "R"
    theorem = System.example("two-walls").orbits(1)
    assert [each.function.name for each in theorem] == ["R"] * len(theorem)
    other = Region(*sides, "orbits:1", Systems(walls.functions, "P12", ("k", "e")))
    assert region.asked.proved_by(theorem[0]) and not other.asked.proved_by(theorem[0])


@pytest.mark.parametrize("name", ["kind", "cell"])
def test_a_parameter_is_not_named_like_a_column(name):
    made = Map(f"1 - {name}*x^2 + b*x", **{name: ("1", "2"), "b": ("0", "1")})
    with pytest.raises(ValueError, match="column"):
        Region((F(1), F(2)), (F(0), F(1)), "horseshoe", systems(made, name, "b"))


@pytest.mark.slow
def test_the_command(tmp_path, capsys):
    ranges = ["--range", "R", "4.9", "5.1", "--range", "c", "0", "0.01"]
    own = ["--map", "R*x*(1 - x) + c", "--box", "x=0:1", *ranges]
    out = ["--out", str(tmp_path), "--depth", "1"]
    assert main([*own, "--ask", "orbits:2", *out]) == 0
    assert "1 of the area: a periodic orbit" in capsys.readouterr().out
    areas = check_atlas((tmp_path / "atlas.jsonl").read_text().splitlines())
    assert areas.shares == {"VERIFIED": 1}
    assert main(["--out", str(tmp_path), "--cell", "5", "0.005"]) == 0
    assert "exactly one periodic orbit of least period 2" in capsys.readouterr().out
