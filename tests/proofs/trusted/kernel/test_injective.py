"""Which maps are proved to be one-to-one, and of which that is not proved: most are not."""

import pytest

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.injective import is_one_to_one
from tests.proofs.trusted.kernel.flows import LORENZ, ROESSLER
from tests.proofs.trusted.kernel.systems import BALL, DAMPED, OSCILLATOR, at
from tests.proofs.trusted.kernel.test_maps import DOUBLING, STANDARD, with_

PLANE = {"variables": ["x", "y"]}
HENON = {**PLANE, "parameters": {"a": ["1", "2"]}, "values": ["1 - a*x**2 + y", "3/10*x"]}
FLAT = with_(OSCILLATOR, parameters=at(eta="2121/10000", nu="-1/5", epsilon="0"))
BACK = {**ROESSLER, "values": ["x3", "x2"]}


def read(data, *maps):
    known = {}
    for name, each in zip("FGH", (*maps, data), strict=False):
        known[name] = read_map(name, Reader(each, name), known)
        last = known[name]
    return last


def known(map_, on_images=False):
    try:
        return is_one_to_one(map_, on_images)
    except Unproved:
        return False


@pytest.mark.parametrize(
    "data",
    [
        HENON,
        {**PLANE, "values": ["1 - 7/5*sqrt(x**2) + y", "1/2*x"]},
        {"variables": ["x", "y", "z"], "values": ["y + x*z", "z/3", "x + sin(z)"]},
        STANDARD,
        BALL,
        DAMPED,
        OSCILLATOR,
    ],
)
def test_maps_that_are(data):
    assert is_one_to_one(read(data))
    assert is_one_to_one(read({"maps": ["F", "F"]}, data))


LIES = [
    ("a double cover", DOUBLING),
    ("a square", {**PLANE, "values": ["x**2", "y"]}),
    ("a sum twice", {**PLANE, "values": ["x + y", "2*x + 2*y"]}),
    ("a slope that may be 0", {**PLANE, "parameters": {"b": ["-1", "1"]}, "values": ["b*x", "y"]}),
    ("branches of one slope", {**PLANE, "values": ["x - 2*atan(x) - 2*atan(1/x)", "y"]}),
    ("a jump of what comes after", {**PLANE, "values": ["x", "x + y - 2*atan(y) - 2*atan(1/y)"]}),
    ("fewer values than variables", {**PLANE, "values": ["x"]}),
    ("an angle halved", {**DOUBLING, "values": ["-2*x"]}),
    ("a plastic impact", FLAT),
    ("an impact that forgets", with_(BALL, parameters=at(g="1/10", e="0"))),
    ("a speed without its sign", with_(BALL, values=["phi + t", "D(y, t)**2"])),
    ("a phase that is lost", with_(BALL, values=["phi", "D(y, t)"])),
    ("a phase that waits", with_(BALL, values=["phi + t**2", "D(y, t)"])),
    ("a phase that turns with the speed", {
        **BALL,
        "motion": [{**BALL["motion"][0], "form": "v*t - g*t**2/2", "start": ["0", "v"]}],
        "gaps": ["y"],
        "values": ["phi + t*D(y, t)", "D(y, t)"],
    }),
    ("a table that starts slowly", with_(
        BALL,
        gaps=["y - sin(phi + t) - t**2"],
        values=["phi + t", "D(y, t)"],
    )),
    ("a slope, told apart by turns", {
        **BALL,
        "motion": [{**BALL["motion"][0], "form": "phi + v*t - g*t**2/2", "start": ["phi", "v"]}],
        "gaps": ["y - phi - t"],
    }),
    ("a launch above the table", {
        **BALL,
        "motion": [{**BALL["motion"][0], "form": "2 + v*t - g*t**2/2", "start": ["2", "v"]}],
    }),
    ("a section that comes at a time", LORENZ),
]  # fmt: skip


@pytest.mark.parametrize(("why", "data"), LIES, ids=[why for why, _ in LIES])
def test_maps_that_need_not_be(why, data):
    assert not known(read(data), on_images=True)


def test_a_section_is_returned_to_from_one_state():
    """Of a start beside the section, and of one whose state the values mix up, nothing is known."""
    assert known(read(ROESSLER), on_images=True)
    assert known(read({"maps": ["F", "F"]}, ROESSLER), on_images=True)
    assert not known(read(ROESSLER))  # a start may rise or fall
    assert not known(read({"maps": ["F", "G"]}, ROESSLER, with_(ROESSLER, start=["0", "y", "z"])))
    beside = with_(ROESSLER, start=["1", "y", "z"])
    driven = with_(ROESSLER, field=[*ROESSLER["field"][:2], "1/5 + x3*(x1 - 57/10) + sin(t)"])
    falling = with_(ROESSLER, end={"gaps": ["1 - x1"]}, start=["0", "y", "z"])
    for data in (BACK, beside, driven, falling):
        assert not known(read(data), on_images=True)
