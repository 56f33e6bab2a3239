"""Curves of flights: truths beside simulation, lies, and what a slanted box encloses."""

import json
import random
from fractions import Fraction

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.flightarcs import Slanted, flight_arc
from proofs.trusted.kernel.returns import Launches
from proofs.trusted.kernel.zeros import Piece
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel.systems import SYSTEMS
from tests.proofs.trusted.kernel.test_flight import CLOCK

TOUCH = "(t - 1)**2 + x - p"  # where x = p, at t = 1
STILL = [{"name": "y", "form": "0", "equation": "0", "start": ["0"]}]
PIECE = {
    "box": [["2/5", "3/5"], ["0", "1"], ["9/10", "11/10"]],
    "slope": ["1", "0", "0"],
    "matrix": [["0", "1"], ["1/2", "0"]],
}
POINT = {"box": [["249/1000", "251/1000"], ["1/4", "1/4"], ["99/100", "101/100"]]}
WITNESS = {
    "function": "G",
    "axis": "p",
    "pieces": [PIECE],
    "points": [POINT | {"matrix": PIECE["matrix"]}],
    "starts": ["1/2"],
}


def touch(*gaps, values=None, **fields):
    head = {**CLOCK, "variables": ["x", "p"], "motion": STILL, "gaps": list(gaps)}
    return {**head, "values": values or [f"D({gaps[0]}, t)"], **fields}


def concluded(data, **changes):
    context = Context(functions={"G": read_map("G", Reader(data), {})})
    return flight_arc(context, Reader(json.loads(json.dumps({**WITNESS, **changes}))))


def bent(rate):
    """Pieces for a gap with a factor that is 1 at t = 1, where it changes so fast."""
    box = [["499/1000", "501/1000"], ["499/1000", "501/1000"], ["199/200", "201/200"]]
    matrix = [["0", "1"], ["1/2", str(-Fraction(rate) / 2)]]
    return {"pieces": [{**PIECE, "box": box, "matrix": matrix}], "points": [], "starts": ["19/20"]}


def falling(factor="1", last="-1", start="1/2"):
    """A gap that falls through 0 at t = 1 where x = p, times a factor; last: of the matrix."""
    box = [["499/1000", "501/1000"], ["499/1000", "501/1000"], ["199/200", "201/200"]]
    piece = {**PIECE, "box": box, "matrix": [["1", "0"], ["1/4", last]]}
    data = touch(f"(1 - t + (x - p)/4)*{factor}", values=["x - p"])
    return data, {"pieces": [piece], "points": [], "starts": [start]}


TRUTHS = [
    ("an impact", *falling()),
    ("for all of a range", touch(f"({TOUCH})*k", parameters={"k": ["1", "11/10"]}), {}),
    ("an impact of some speed", *falling("(2 - t)")),
    ("a parabola", touch(TOUCH), {}),
    ("from the wall", touch(f"({TOUCH})*t"), bent(1)),
    ("another wall later", touch(TOUCH, "6/5 - t"), {}),
    ("an impact later", touch(f"({TOUCH})*(3 - t)/2"), bent(Fraction(-1, 2))),
]  # fmt: skip
NONE, FORM = "not proved > 0 up to the time", "no angles"
END, PLACE, ZERO = "not proved to end so", "a start is not between", "Krawczyk"
EARLY = {**PIECE, "box": [["2/5", "3/5"], ["0", "1"], ["2/5", "3/5"]]}
LIES = [
    ("an earlier impact", *falling("(t - 1/4)*(t - 1/8)*32/21", start="19/20"), NONE),
    ("an impact from below", *falling("(3 - 4*t)", "1"), END),
    ("another wall before the impact", touch("1 - t + (x - p)/4", "9/10 - t", values=["x - p"]),
     falling()[1], NONE),
    ("an impact before", touch(f"({TOUCH})*(t - 1/4)*(t - 1/8)*32/21"), bent(Fraction(52, 21)),
     NONE),
    ("a touch before", touch(f"({TOUCH})*(4*t - 1)**2/9"), bent(Fraction(8, 3)), NONE),
    ("a touch between", touch(f"({TOUCH})*(5*t - 4)**2"), {**bent(10), "starts": ["1/2"]}, END),
    ("another wall before", touch(TOUCH, "1/4 - t"), {}, NONE),
    ("another wall just before", touch(TOUCH, "9/10 - t"), {}, NONE),
    ("another wall at once", touch(TOUCH, TOUCH), {}, NONE),
    ("a launch in the wall", touch("1 - (t - 1)**2 - 1 + p - x"), {}, ZERO),
    ("a touch from below", touch("p - x - (t - 1)**2"), {"pieces": [
        {**PIECE, "matrix": [["0", "-1"], ["-1/2", "0"]]}], "points": []}, END),
    ("a start before it is convex", touch(f"{TOUCH} + (t - 1)**3*2"), {}, END),
    ("a start at the graze", touch(TOUCH), {"starts": ["1"]}, PLACE),
    ("a start in its times", touch(TOUCH), {"starts": ["19/20"]}, PLACE),
    ("a start after it", touch(TOUCH), {"starts": ["2"]}, PLACE),
    ("a start at launch", touch(TOUCH), {"starts": ["0"]}, PLACE),
    ("no start", touch(TOUCH), {"starts": []}, "expected 1"),
    ("another time", touch(TOUCH), {"pieces": [EARLY], "points": []}, ZERO),
    ("a passage", touch(TOUCH, values=["x - p"]), {}, ZERO),
    ("another's speed", touch(TOUCH, "9 - t", values=["D(9 - t, t)"]), {}, ZERO),
    ("the speed first", touch(TOUCH, values=["2*t - 2"]), {}, END),
    ("a point elsewhere", touch(TOUCH), {"points": [
        {**WITNESS["points"][0], "box": [["1/4", "1/4"], ["1/2", "1/2"], ["1", "1"]]}]}, "a point"),
    ("too many values", touch(TOUCH, values=["x", f"D({TOUCH}, t)"]), {}, FORM),
    ("angles", touch("2 + sin(x) + 0*p*t", values=["D(2 + sin(x) + 0*p*t, t)"],
                     periods={"x": "2*pi"}), {}, FORM),
    ("a formula", {"variables": ["x", "p"], "values": ["x"]}, {}, FORM),
    ("the time as the axis", touch(TOUCH), {"axis": "t"}, "a variable of the function"),
]  # fmt: skip


@pytest.mark.every
@pytest.mark.parametrize(("data", "changes"), [x[1:] for x in TRUTHS], ids=[x[0] for x in TRUTHS])
def test_truths(data, changes):
    found = concluded(data, **changes)
    assert "exactly one flight with `G` = 0" in found.sentence
    assert oracle(found, random.Random(0)) == []


@pytest.mark.every
@pytest.mark.parametrize(
    ("data", "changes", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES]
)
def test_lies(data, changes, reason):
    with pytest.raises((Unproved, Malformed), match=reason) as caught:
        concluded(data, **changes)
    assert len(str(caught.value).splitlines()) == 1


def test_a_slanted_box_encloses_its_flights():
    rng = random.Random("slanted")
    for example in SYSTEMS.values():
        flight = read_map("F", Reader(example.data), {})
        for _ in range(5):
            axis, n = rng.randrange(flight.state), flight.state
            centre = [Fraction(round(rng.uniform(*side), 3)) for side in example.box]
            reach = [Fraction(rng.randint(1, 9), 10 if k == axis else 1000) for k in range(n)]
            box = tuple((x - r, x + r) for x, r in zip(centre, reach, strict=True))
            slope = [Fraction(rng.randint(-20, 20), 10) for _ in range(n)]
            slope[axis] = Fraction(0)
            piece = Piece((*box, (Fraction(1), Fraction(2))), (*slope, Fraction(1)))
            slanted, time = Slanted(flight, axis, piece), Fraction(rng.randint(1, 30), 10)
            t, orders = Enclosure.of(time, time, 64), flight.gaps[0].orders[:3]
            wide = slanted.on(orders, t)
            for _ in range(20):
                x = box[axis][0] + 2 * reach[axis] * Fraction(rng.randint(0, 8), 8)
                sides = piece.cut(axis, x)[:n]
                place = [low + (high - low) * rng.choice((0, 1)) for low, high in sides]
                numbers = place, [low for low, _ in flight.ranges]
                one = Launches(flight, *(enclosed(point_box(each), 64) for each in numbers))
                for outer, inner in zip(wide, one.on(orders, t), strict=True):
                    assert outer.lo <= inner.lo and inner.hi <= outer.hi
