"""Systems whose flow is validated: beside closed forms, in floating point, and what goes wrong."""

import tomllib
from fractions import Fraction
from importlib.resources import files

import numpy as np
import pytest

from intervals import Undecided
from proofs import System
from proofs.methods.derivation import Derivation
from proofs.methods.sampling import Sampled
from proofs.trusted.kernel.enclose import enclosed, point_box
from tests.proofs.trusted.kernel.flows import FLOWS


def file_of(name):
    return tomllib.loads((files("proofs.systems") / f"{name}.toml").read_text("utf-8"))


def validated(file):
    """The same system without its closed forms."""
    motions = {
        name: {key: value for key, value in motion.items() if key != "form"}
        for name, motion in file["motion"].items()
    }
    return {**file, "flow": "validated", "motion": motions}


IMPACTS = [
    ("impact-oscillator", {"phi": "1.13", "gamma": "-0.2"}, {}),
    ("bouncing-ball", {"phi": "1.02", "v": "1.57"}, {}),
    ("wall", {"a": "1", "v": "-1"}, {}),
    ("two-walls", {"a": "0.3", "v": "-0.83"}, {"wall": "right"}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "state", "wall"), IMPACTS, ids=[x[0] for x in IMPACTS])
def test_the_flow_agrees_with_the_closed_form(name, state, wall):
    file = file_of(name)
    closed, taylor = (
        System(each).impact(**wall, **state).conclusion.bounds for each in (file, validated(file))
    )
    for (a, b), (c, d) in zip(closed, taylor, strict=True):
        assert a <= d and c <= b
        assert max(b, d) - min(a, c) < Fraction(1, 10**9)


def test_digits_of_the_flow_and_of_the_closed_form():
    file = file_of("impact-oscillator")
    state = point_box([Fraction("1.13"), Fraction("-0.2")])
    one, two = (Derivation(System(each).functions).map("P") for each in (file, validated(file)))
    x = enclosed(state, 128)
    entries = [
        [*map_.values(x), *(entry for row in map_.jacobian(x) for entry in row)]
        for map_ in (one, two)
    ]
    for a, b in zip(*entries, strict=True):
        assert a.lo <= b.hi and b.lo <= a.hi
        assert max(a.hi, b.hi) - min(a.lo, b.lo) < 2 ** (128 - 90)


@pytest.mark.parametrize("name", ["duffing", "pendulum", "lorenz"])
def test_floating_point_follows_the_same_flow(name):
    example = FLOWS[name]
    map_ = Derivation({"F": example.data}).map("F")
    point = [Fraction(centre) for centre in example.centre]
    sampled = Sampled(map_)
    values, slopes = sampled.expanded(np.array([[float(x)] for x in point]))
    thin = enclosed(point_box(point), 64)
    for entries, floats, slip in (
        (map_.values(thin), values[0], 1e-9),
        ([x for row in map_.jacobian(thin) for x in row], slopes[0].ravel(), 1e-4),
    ):
        for x, value in zip(entries, floats, strict=True):
            low, high = map(float, x.range)
            assert low - slip * (1 + abs(value)) <= value <= high + slip * (1 + abs(value)) or (
                name == "pendulum" and high - low > 1e-3  # its force has a range
            )


@pytest.mark.slow
def test_orbits_are_found_and_stay_small():
    theorem = System.example("van-der-pol").orbits(1)
    assert [each.stability for each in theorem] == ["attracting"]
    assert len(theorem.certificate) < 1000
    wall = System.example("duffing-wall").orbits(1, near=[{"a": "3.36", "v": "1.1"}])
    assert [each.stability for each in wall] == ["attracting"]


WRONG = [
    ({"flow": "closed-ish"}, 'flow is "validated"'),
    ({"flow": "closed"}, 'needs flow = "validated"'),
    ({"impact": []}, "in the place of"),
    ({"end": {"a": "x"}}, "has no 'section'"),
    ({"end": {"section": "x'", "a": "x''"}}, "x'' is no state"),
    ({"end": {"section": "x'", "a": "x", "gap": "x"}}, "unknown key 'gap' of end"),
    ({"end": {"section": "x'", "a": "x", "direction": "up"}}, '"-" is expected'),
    ({"end": {"section": "x'", "a": "x", "count": 0}}, "an integer from 1"),
    ({"end": {"time": "x", "a": "x"}}, "a time depends on"),
    ({"motion": {"x": {"equation": "x'' = -x", "start": ["a", "0"], "form": "a"}}}, "key 'form'"),
    ({"motion": {"x": {"equation": "x'' = -x''", "start": ["a", "0"]}}}, "x'' is no state"),
]


@pytest.mark.parametrize(("change", "message"), WRONG, ids=[x[1] for x in WRONG])
def test_what_is_wrong_is_a_sentence(change, message):
    with pytest.raises(ValueError) as caught:
        System({**file_of("van-der-pol"), **change})
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.slow
def test_what_cannot_be_followed_is_a_sentence():
    van_der_pol = file_of("van-der-pol")
    motion = {"x": {"equation": "x'' = x^2 + x'^2 + 1", "start": ["a", "0"]}}
    with pytest.raises(Undecided, match=r"are followed up to the time 1\.00\d+"):
        System({**van_der_pol, "parameters": {}, "motion": motion}).impact(a="1")


def _duffing_after_a_period(u, v, steps=4000):
    """Two wells, by Runge and Kutta's rule."""

    def rate(t, x):
        return np.array([x[1], -0.25 * x[1] + x[0] - x[0] ** 3 + 0.3 * np.cos(t)])

    x, h = np.array([u, v]), 2 * np.pi / steps
    for t in h * np.arange(steps):
        a = rate(t, x)
        b = rate(t + h / 2, x + h / 2 * a)
        c = rate(t + h / 2, x + h / 2 * b)
        x = x + h / 6 * (a + 2 * b + 2 * c + rate(t + h, x + h * c))
    return x


@pytest.mark.slow
def test_a_saddle_that_attracts_nothing_is_found_where_motions_come_back(tmp_path):
    file = tmp_path / "wells.toml"
    file.write_text(
        'flow = "validated"\nvariables = ["u", "v"]\ntime = "t"\n'
        'region = { u = ["-2", "2"], v = ["-2", "2"] }\n'
        "[motion.x]\nequation = \"x'' = -0.25*x' + x - x^3 + 0.3*cos(t)\"\n"
        'start = ["u", "v"]\n[end]\ntime = "2*pi"\nu = "x"\nv = "x\'"\n'
    )
    wells = System.read(file)
    wells.effort = 2
    (saddle,) = wells.orbits(1)
    middle = [float(sum(side) / 2) for side in saddle.box]
    assert np.allclose(_duffing_after_a_period(*middle), middle, rtol=0, atol=1e-6)
