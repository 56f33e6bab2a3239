"""Maps and systems of one's own: theorems against closed forms and simulation, errors in a line."""

import json
import math
import re
import time
import tomllib
from contextlib import suppress
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest

import proofs
from intervals import Undecided
from proofs import Map, System
from proofs.commands.system import main
from proofs.methods.frames import Frames, crossing
from proofs.methods.grammar import GrammarError
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.verify import Rejected, check

HENON = Map("1 - 1.4*x^2 + y", "0.3*x")
BALL = System.example("bouncing-ball")


def inside(box, *point):
    return all(low <= x <= high for (low, high), x in zip(box, point, strict=True))


def accepted(theorem, work=DEFAULT):
    """The checker, from the text alone, says what the theorem says."""
    report = check(theorem.certificate, work)
    assert report.sentences == tuple(each.sentence for each in theorem)
    return theorem


# -- maps ------------------------------------------------------------------------------------------


def test_fixed_points_of_henon():
    root = math.sqrt(0.7**2 + 4 * 1.4)
    points = [(x, 0.3 * x) for x in ((-0.7 - root) / 2.8, (-0.7 + root) / 2.8)]
    found = accepted(HENON.orbits(1))
    assert [each.stability for each in found] == ["a saddle", "a saddle"]
    assert all(inside(each.box, *p) for each, p in zip(found, points, strict=True))


@pytest.mark.parametrize(("r", "period"), [("2.8", 1), ("3.2", 2), ("3.5", 4), ("3.83", 3)])
def test_the_attracting_orbit_of_the_logistic_map(r, period):
    x = 0.3
    for _ in range(10_000):
        x = float(r) * x * (1 - x)
    orbit = {round(x := float(r) * x * (1 - x), 6) for _ in range(period)}
    (found,) = accepted(Map("r*x*(1 - x)", r=r).stable(box={"x": ("0", "1")}))
    assert found.period == period == len(orbit) and found.stability == "attracting"
    assert round(float(sum(found.box[0]) / 2), 6) in orbit


@pytest.mark.slow
def test_all_orbits_of_henon_are_as_many_as_published():
    box = {"x": ("-1.5", "1.5"), "y": ("-0.5", "0.5")}  # Galias 2001: 2, 1, 0, 1, 0, 2
    assert accepted(HENON.periodic_orbits(6, box)).conclusion.counts == ((1, 2), (2, 1), (6, 2))


def test_horseshoes_of_the_logistic_map():
    box = {"x": ("0", "1")}
    first = accepted(Map("r*x*(1 - x)", r="5").horseshoe(box=box))
    assert len(first) == 2 and first.conclusion.forward
    assert [each.local.power for each in first[0].graph.covers] == [1] * 4
    second = accepted(Map("r*x*(1 - x)", r="3.9").horseshoe(box=box))
    assert second[0].graph.covers[0].local.power == 2
    with pytest.raises(Undecided, match="no horseshoe"):
        Map("r*x*(1 - x)", r="3.2").horseshoe(box=box)


def test_parameters_in_a_range():
    found = accepted(Map("r*x*(1 - x)", r=("3.19", "3.21")).orbits(1, box={"x": ("0.2", "1")}))
    (box,) = found[0].box  # in the box where it is looked for; that of 0 comes after
    assert all(box[0] <= 1 - 1 / r <= box[1] for r in (3.19, 3.2, 3.21))
    assert "for all `r` in [3.19, 3.21]" in found[-1].sentence


def test_angles():
    """The standard map: fixed points (0, 0) and (0, pi), and on the cylinder more with x turned."""
    standard = Map("x + k*sin(y)", "x + y + k*sin(y)", k="1.2", periods={"x": "2*pi", "y": "2*pi"})
    found = accepted(standard.orbits(1))
    places = [tuple(float(sum(side) / 2) for side in each.box) for each in found]
    for y, kind in ((0.0, "a saddle"), (math.pi, None)):
        near = [k for k, p in enumerate(places) if abs(math.remainder(p[1] - y, math.tau)) < 1e-6]
        assert [found[k].stability for k in near] == [kind]


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: Map("r*x*(1 - x)"), "give numbers to parameters"),
        (lambda: Map("x", "y", "x"), "3 formulas for the variables x, y"),
        (lambda: Map("r*x", variables=["x"]), "r has no value"),
        (lambda: Map("2x"), r"write \* for a product"),
        (lambda: Map("x", Y="1"), "the parameter Y is in none of the formulas"),
        (lambda: Map("x").at(r="1"), "the parameter r is in none of the formulas"),
        (lambda: Map("x*y_", variables=["x"]), "'y_' is no name"),
        (lambda: Map("R*x", R="3,9"), "R: not a number: '3,9': write a decimal point"),
        (lambda: Map("1 - |x|"), r"character 5 .* write abs\("),
        (lambda: Map("x + y, x"), "several texts, not one with commas"),
        (lambda: Map("x^2", periods={"x": "2*pi"}), "respect the period of x"),
        (lambda: Map("x", periods={"y": "1"}), "period"),
        (lambda: Map("x", periods={"x": "-1"}), "a period is positive"),
        (lambda: HENON.image(x="1"), "a value for each variable"),
        (lambda: Map("x", periods=3), "periods are as"),
        (lambda: Map("sin^2(x)"), r"character 6 .* write sin\(...\)\^2"),
        (lambda: HENON.orbits(0), "whole number from 1"),
        (lambda: HENON.stable("8"), "whole number from 1"),
        (lambda: HENON.horseshoe(longest=0), "whole number from 1"),
        (lambda: HENON.periodic_orbits("2", {}), "whole number from 1"),
        (lambda: HENON.orbits(1, near=[{"x": "1"}]), "a value for each variable"),
        (lambda: HENON.orbits(1, {"z": ("0", "1")}), "none of the variables"),
        (lambda: HENON.image(x=("1", "0"), y="0"), "reversed"),
        (lambda: HENON.horseshoe(4), "a box is as"),
    ],
)
def test_what_is_no_map_is_a_sentence(make, reason):
    with pytest.raises(ValueError, match=reason) as refused:
        make()
    assert "\n" not in str(refused.value) and "$" not in str(refused.value)


def test_names_with_capital_letters_are_one_parameter_however_they_come():
    one, two = Map("r*x*(1 - x)", r="3.2"), Map("R*x*(1 - x)", R="3.9").at(R="3.2")
    assert one.stable()[0].box == two.stable()[0].box and two.variables == ("x",)
    assert two.respelled()[0] == "In what follows `r_` is R." and not one.respelled()


def test_an_orbit_that_is_not_proved_attracting_does_not_answer_for_one():
    """Points settle near an orbit whose multipliers are on the circle, or as close as this."""
    turning = Map("x + y", "y - x - y", variables=["x", "y"])  # of order 6
    assert turning._proved(turning._cycles(1, None))
    with pytest.raises(Undecided, match="not that it is attracting"):
        turning._proved(turning._cycles(1, None), is_attracting=True)
    nearly = Map("x*(1 - x^2)")
    with pytest.raises(Undecided):
        nearly.stable(box={"x": ("-0.5", "0.5")})


@pytest.mark.parametrize(
    ("formulas", "period", "reason"),
    [
        (["1 - y + abs(x)", "x"], 6, "no derivative"),  # the Gingerbreadman's, through x = 0
        (["abs(x)/2"], 1, r"1 .* such as that through \(0\): the map has no derivative on it"),
        (["abs(y) - abs(x)", "x"], 1, "no derivative"),
    ],
)
def test_an_orbit_through_a_kink_is_not_proved(formulas, period, reason):
    map_ = Map(*formulas)
    with pytest.raises(Undecided, match=reason):
        map_.orbits(period)
    for ask in (map_.stable, map_.horseshoe, map_.seen):
        with suppress(Undecided):
            ask()


def test_an_attracting_orbit_of_three_variables():
    delayed = Map("a - y^2 - b*z", "x", "y", a="0.3", b="0.1")
    sides = dict.fromkeys("xyz", ("-0.5", "0.5"))
    assert [each.stability for each in accepted(delayed.stable(box=sides))] == ["attracting"]


def test_floats_are_refused():
    for make in (lambda: Map("r*x", r=0.1), lambda: HENON.image(x=0.1, y="0")):
        with pytest.raises(TypeError, match="write it as"):
            make()


def test_completion_shows_what_there_is():
    assert {"Map", "System", "Oscillator", "Theorem"} <= {*dir(proofs)}


def test_a_file_of_another_system_is_not_replaced(tmp_path):
    file = tmp_path / "mine.json"
    HENON.orbits(1).save(file)
    HENON.orbits(2).save(file)
    kept = file.read_text()
    with pytest.raises(FileExistsError, match="another system"):
        Map("x/2").orbits(1).save(file)
    assert file.read_text() == kept


def test_an_attractor_is_trapped():
    """By hand: |x'| <= 0.5 + 0.4 sin 1 < 1, |v'| <= 0.9; a union; a box that some images leave."""
    spiral = Map("x/2 + 0.4*sin(v)", "0.9*x", variables=("x", "v"))
    (trapped,) = accepted(spiral.trapping(x=("-1", "1"), v=("-1", "1")))
    assert "`F` has a fixed point in T." in trapped.sentence
    halves = [{"x": sides, "v": ("-1", "1")} for sides in (("-1", "0"), ("0", "1"))]
    (union,) = accepted(spiral.trapping(halves[0], **halves[1]))
    assert "the union of the 2 boxes" in union.sentence
    for side, image in (
        (("-0.6", "0.6"), "(-0.636588, -0.54)"),
        (("-0.1", "1"), "(-0.386588, -0.09)"),
    ):
        with pytest.raises(Undecided, match=re.escape(f"-1) is seen to go to {image}, outside")):
            spiral.trapping(x=side, v=("-1", "1"))
    with pytest.raises(Undecided, match=r"^no image of \(1, 2\) is seen"):
        Map("x/(2 - y)", "y").trapping(x=("1", "3"), y=("2", "3"))
    cylinder = Map("a + v", "v/2 + sin(a)/4", periods={"a": "2*pi"})
    (ring,) = accepted(cylinder.trapping(a=("0", "7"), v=("-0.6", "0.6")))
    assert "fixed point" not in ring.sentence
    with pytest.raises(Undecided, match="all around"):
        cylinder.trapping(a=("0", "6"), v=("-0.6", "0.6"))


# -- systems ---------------------------------------------------------------------------------------


def test_fixed_points_of_the_bouncing_ball():
    """A flight of k turns: v = g pi k, cos phi = v (1 - e)/(1 + e)."""
    found = accepted(BALL.orbits(1))
    assert len(found) >= 10
    for each in found:
        phi, v = (float(sum(side) / 2) for side in each.box)
        (turns,) = each.turns
        assert v == pytest.approx(0.1 * math.pi * turns) and math.cos(phi) == pytest.approx(v / 3)


@pytest.mark.slow
def test_the_next_impact_of_the_bouncing_ball():
    phi, v, h = 1.02, 1.57, 1e-5
    t = np.arange(1, 10**7) * h
    height = math.sin(phi) + v * t - 0.05 * t**2 - np.sin(phi + t)
    time = t[np.argmax(height <= 0)]
    after = 1.5 * math.cos(phi + time) - (v - 0.1 * time) / 2
    (image,) = accepted(BALL.impact(phi="1.02", v="1.57"))
    for (low, high), value in zip(image.bounds, (phi + time, after, time), strict=True):
        assert float(low) - 2e-4 <= value <= float(high) + 2e-4 and high - low < 1e-9


def test_an_orbit_of_the_billiard_whose_flights_last_half_a_period():
    """Church and Fortin's table for (1, 1, 1) has it: impacts at 1/4 and 3/4, steps of times."""
    near = {"s": "0.25", "x": "-0.69178462", "v": "-4.85072416", "w": "-3.50594969"}
    (orbit,) = accepted(System.example("billiard").orbits(2, near=[near]))
    assert orbit.turns == (1,)
    assert all(
        abs(sum(side) / 2 - Fraction(near[x])) < 1e-7
        for side, x in zip(orbit.box, "sxvw", strict=True)
    )


@pytest.mark.long
def test_the_horseshoe_of_roesslers_flow():
    """CAPD proves that on two sets the second return has the shift, by cones as well."""
    system = System.example("roessler")
    system.effort = 5
    entropy, conjugacy = accepted(system.horseshoe(), 2 * DEFAULT)
    assert (entropy.growth, entropy.length) == (2, 1)
    assert conjugacy.graph == entropy.graph and not conjugacy.forward
    assert "at the 2nd `t > 0` at which `x` rises through 0" in entropy.sentence


@pytest.mark.slow
def test_a_later_return_is_that_of_the_iterate():
    """The solution goes on from the section: P2 = P P, enclosed on ways of their own."""
    system = System.example("roessler")
    file = system._derivation(**system._return(2))
    once, twice = file.map("P"), file.map("P2")
    for point in (("-8.4", "0.03"), ("-5.2", "0.031")):
        x = enclosed(point_box(tuple(map(Fraction, point))), 64)
        both = zip(once.values(once.values(x)), twice.values(x), strict=True)
        assert all(max(a.lo, b.lo) <= min(a.hi, b.hi) for a, b in both)
        assert max(b.hi - b.lo for b in twice.values(x)) >> 24 == 0
    assert system._return(1) == BALL._return(2) == {}


@pytest.mark.slow
def test_a_horseshoe_of_the_bouncing_ball():
    entropy, cone = accepted(BALL.horseshoe())
    assert (entropy.growth, entropy.length) == (2, 1) and not cone.forward


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "state", "told"),
    [
        ("bouncing-ball", {"phi": "0", "v": "1"}, "chatter"),
        ("wall", {"a": "0.3", "v": ("-0.2", "-0.1")}, "ask for `graze`"),
    ],
)
def test_what_happens_instead_of_an_impact_is_said_with_the_next_step(name, state, told):
    with pytest.raises(Undecided, match=told) as reason:
        System.example(name).impact(**state)
    assert "give" in str(reason.value) and "\n" not in str(reason.value)


@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("bouncing-ball", {"phi": "1.02", "v": "-3"}),
        ("two-walls", {"a": "0", "v": "3"}),
    ],
)
def test_no_flight_begins_towards_the_wall(name, state):
    (pressed,) = accepted(System.example(name).impact(**state))
    assert pressed.kind == "Pressed" and pressed.sentence.endswith("as before an impact.")


def mine(**changes):
    """The ball with what its state is in contact, and other values of its parameters."""
    (impact,) = BALL._file.file["impact"]
    return System({**BALL._file.file, "impact": [{**impact, "rest": {"v": "cos(phi)"}}]}, **changes)


def test_a_ball_rests_where_the_table_does_not_fall_faster():
    """Contact is kept where -sin(phi) > -g; with g > 1 at all phases."""
    (always,) = accepted(mine(g="1.1").rest(phi=("0", "6.2832")))
    assert "no flight begins, the motion is pressed against the wall" in always.sentence
    assert accepted(mine(g="0.5").rest(phi=("-3.66", "0.52")))
    for phi in (("-3.67", "0"), ("0", "0.53"), ("1", "1")):
        with pytest.raises(Undecided, match="no flight begins"):
            mine(g="0.5").rest(phi=phi)
    with pytest.raises(GrammarError, match="no 'rest'"):
        BALL.rest(phi="0")


@cache
def far_wall(*more):
    """The wall at 1, out of the reach of the forced oscillation, whose amplitude is 0.146."""
    file = System.example("wall")._file.file
    impacts = [{**file["impact"][0], **dict(each)} for each in ((), *more)]
    return System({**file, "impact": impacts}, d="1")


@pytest.mark.slow
def test_there_is_no_further_impact_where_damping_wins():
    (never,) = accepted(far_wall().impact(a="0.3", v=("-0.1", "-0.09")))
    assert never.kind == "NoImpact" and "at all `t` > 0" in never.sentence
    assert far_wall().impact(a="0.3", v="-1").conclusion.kind == "Image"


@pytest.mark.slow
def test_a_graze_is_between_an_impact_and_none():
    (graze,) = accepted(far_wall().graze(a="0.3", v=("-1", "-0.1")))
    (low, high), (start, end) = graze.box[1], graze.time
    assert graze.kind == "Graze" and graze.rises
    impact, none = (far_wall().impact(a="0.3", v=v).conclusion for v in (low, high))
    assert start < impact.bounds[-1][0] < end and none.kind == "NoImpact"
    with pytest.raises(Undecided, match="no graze is seen"):
        BALL.graze(phi="0.3", v=("1.5", "1.6"))
    with pytest.raises(ValueError, match="one variable with a range"):
        BALL.graze(phi="0.3", v="1.5")


@pytest.mark.slow
def test_two_walls_at_once_are_no_impact_with_one():
    with pytest.raises(Undecided, match="two walls may be hit at once"):
        far_wall((("wall", "other"),)).impact(a="0.3", v="-1")


@pytest.mark.slow
def test_a_wall_that_would_be_hit_soon_after_another():
    """In Y = |X|, from (1, 1): the left wall at (1 + sqrt(17))/2 = 2.56, the right one at 3."""
    wedge = System(tomllib.loads(WEDGE))
    theorem = accepted(wedge.impact(x="1", u="-0.5", w="1"))
    assert "`x` in [0.28" in theorem.conclusion.sentence and "`t` in [2.56" in str(theorem)
    assert inside(theorem.conclusion.bounds[3:], (1 + 17**0.5) / 2)


def test_orbits_with_two_walls():
    walls = System.example("two-walls")
    (found,) = accepted(walls.orbits(1))
    assert walls.walls == ("right", "left") and found.turns == (1,)
    with pytest.raises(ValueError, match="no wall 'top'"):
        walls.around("top")


SIDES = """
variables = ["s", "v"]
time = "t"
parameters = { w = "0.7", K = "25" }
periods = { s = "2*pi/w" }
motion.X = { equation = "X'' = -X'/10 - k*X + cos(w*(s + t))", start = ["0", "v"] }
[[impact]]
wall = "in"
at = { k = "K" }
next = ["out"]
gap = "-X"
s = "s + t"
v = "X'"
[[impact]]
wall = "out"
at = { k = "1" }
next = ["in"]
gap = "X"
s = "s + t"
v = "X'"
"""


@pytest.mark.slow
def test_a_spring_that_is_stiffer_on_one_side(tmp_path):
    """Both sides meet in X = 0, and each flight is ended by its own; followed by small steps."""
    file = tmp_path / "mine.toml"
    file.write_text(SIDES)
    system = System.read(file, w="2")
    (orbit,) = accepted(system.stable(longest=2, box={"v": ("0", "5")}))
    s, v = (float(sum(side) / 2) for side in orbit.box)
    state, now, step = np.array([0.0, v]), s, 1e-4

    def rate(x, t):
        return np.array([x[1], -x[1] / 10 - (25 if x[0] > 0 else 1) * x[0] + math.cos(2 * t)])

    for _ in range(round(orbit.turns[0] * math.pi / step)):
        middle = state + step / 2 * rate(state, now)
        state, now = state + step * rate(middle, now + step / 2), now + step
    assert abs(state[0]) < 1e-2 and abs(state[1] - v) < 1e-2
    with pytest.raises(GrammarError, match="next: no wall 'up'"):
        system.read(_rewritten(file, '["out"]', '["up"]'))
    with pytest.raises(GrammarError, match="k: not a number: 'Q'"):
        system.read(_rewritten(file, '"K" }', '"Q" }'))


def _rewritten(file, old, new):
    file.write_text(SIDES.replace(old, new, 1))
    return file


@pytest.mark.parametrize("name", System.examples())
def test_published_systems_are_read(name):
    system = System.example(name)
    assert system.title and repr(system)


TEXT = """
variables = ["phi", "v"]
time = "t"
parameters = { g = "0.1" }
periods = { phi = "2*pi" }
motion.y = { equation = "y'' = -g", start = ["sin(phi)", "v"] }
impact = [{ gap = "y - sin(phi + t)", phi = "phi + t", v = "cos(phi + t)" }]
"""


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("", "", ""),
        ("time", "clock", "no 'time'"),
        ('"0.1"', '"0.1", c = "1"', "the parameter c is in none of the formulas"),
        ("time =", 'colour = "red"\ntime =', "unknown key 'colour'"),
        ('"2*pi"', '"2*pi + 1/10"', "respect the period of phi"),
        ("-g", "g*", "the equation of y: not a formula"),
        ("y''", "y'", "begins y'' ="),
        ('"v"]', '"v"', "Unclosed array"),
        ('"0.1"', "0.1", 'g: 0.1 is a float, and not that decimal: write it as "0.1"'),
        ("= -g", "= -g*y^2", "not linear"),
        ("= -g", "= -g/0", "sympy finds no closed form of y"),
        (
            'time = "t"',
            "time = 't'\nflow = 'validated'\nmotion.Q.equation = \"Q = z'\"\nmotion.Q.start = []",
            "no motion is z",
        ),
        ("time", "title = 'Sto\u00df'\ntime", "no text in UTF-8"),
        ('"v"] }', '"v"], form = "sin(phi) + v*t + g*t^2/2" }', "not proved to solve"),
        ('"v"] }', '"v"], form = "cos(phi) + v*t - g*t^2/2" }', "not proved to start"),
        ('"cos(phi + t)"', '"cos(phi + s)"', "unknown variable 's': give it a value"),
        ("{ gap =", '{ rest = { q = "1" }, gap =', "rest: q is none of the variables"),
        ("{ gap =", '{ rest = "v", gap =', "'rest' is a table"),
        (', v = "cos(phi + t)"', "", "no 'v'"),
        ('"phi", "v"]', '"phi", "phi"]', "two variables have one name"),
        ('"phi", "v"]', '"phi", "V"]', "unknown key 'v' of impact"),
        ("y - sin(phi + t)", "t*(y - y)", "first derivatives"),
        ("impact = [{", "impact = { all = [{", "'impact' is a list: write \\[\\[impact\\]\\]"),
        ("-g", "-Gamma", "unknown variable 'Gamma'"),
        ("{ gap =", '{ at = { s = "-g" }, gap =', "at: s: not a number: '-g'; a number, or a"),
        (
            "time",
            "motion.W = { equation = \"W' = y\", start = ['1'] }\ntime",
            "y is in the .* of W",
        ),
        ('"0.1"', '"pi/9"', "g: not a number: 'pi/9': what has pi in it is written in the"),
    ],
)
def test_a_file_that_is_wrong_is_told_in_a_line(tmp_path, old, new, reason):
    file = tmp_path / "mine.toml"
    text = TEXT.replace(old, new, 1) if old else TEXT
    text = text.replace("}]", "}] }") if "all = " in new else text
    file.write_text(text, "latin-1")
    if not reason:
        file.write_text("\ufeff" + TEXT, "utf-8")
        assert System.read(file).variables == ("phi", "v")
        return
    with pytest.raises(GrammarError, match=reason) as refused:
        System.read(file)
    assert "\n" not in str(refused.value) and str(file) in str(refused.value)


WEDGE = """
variables = ["x", "u", "w"]
time = "t"
motion.X = { equation = "X'' = 0", start = ["s*x", "u"] }
motion.Y = { equation = "Y'' = -1", start = ["x", "w"] }
impact = [{ wall = "right", at = { s = "1" }, gap = "Y - X", x = "Y", u = "Y'", w = "X'" },
          { wall = "left", at = { s = "-1" }, gap = "Y + X", x = "Y", u = "-Y'", w = "-X'" }]
"""
FAST = """
variables = ["phi", "v"]
time = "t"
parameters = { a = "0.002", f = "30" }
periods = { phi = "1" }
motion.y = { equation = "y'' = -9.81", start = ["a*sin(2*pi*phi)", "v"] }
impact = [{ gap = "y - a*sin(2*pi*(phi + f*t))", phi = "phi + f*t", v = "-y'" }]
"""


def test_a_graze_of_a_fast_table():
    """Within 9 ms; gap = gap' = 0 by mpmath, and not the touch at launch."""

    def gap(v, t):
        lift = mpmath.sin(60 * mpmath.pi * t - mpmath.pi / 10) + mpmath.sin(mpmath.pi / 10)
        return v * t - mpmath.mpf("4.905") * t**2 - lift / 500

    (graze,) = accepted(System(tomllib.loads(FAST)).graze(phi="-1/20", v=("0.2", "0.5")))
    start = float(sum(graze.box[1]) / 2), float(sum(graze.time) / 2)
    root = mpmath.findroot(lambda v, t: (gap(v, t), mpmath.diff(gap, (v, t), (0, 1))), start)
    v, t = map(float, root)
    assert graze.box[1][0] < v < graze.box[1][1] and graze.time[0] < t < graze.time[1] < 0.009


@pytest.mark.parametrize("flow", ["", 'flow = "validated"'])
def test_floating_point_misses_no_impact_with_a_fast_table(flow):
    """Of a table with 30 periods in a unit of time: in seconds, say."""
    from proofs.methods.sampling import Sampled

    system = System(tomllib.loads(flow + FAST))
    starts = np.array([(p, v) for p in np.arange(0, 1, 0.1) for v in (0.1, 0.4, 0.6)]).T
    images = Sampled(system._kernel)(starts)
    for (phi, v), after in zip(starts.T, images.T, strict=True):
        t = 1e-5 + np.arange(40_000) / 100_000
        height = 0.002 * np.sin(2 * np.pi * phi) + v * t - 9.81 / 2 * t**2
        gap = height - 0.002 * np.sin(2 * np.pi * (phi + 30 * t))
        if gap[0] > 0:
            assert abs((after[0] - phi) / 30 - t[(gap <= 0).argmax()]) < 2e-5
        elif not flow:
            assert np.isnan(after).all()


@pytest.mark.parametrize("name", ["bouncing-ball", "wall", "two-walls"])
def test_derivatives_of_candidates_are_differences(name):
    system = System.example(name)
    sampled = system._sampled.iterate(2 - len(system.walls) // 2)
    low, high = np.array([[float(end) for end in side] for side in system.region()]).T[:, :, None]
    x = low + (high - low) * np.random.default_rng(1).random((len(low), 400))
    image, slopes = sampled.expanded(x)
    assert np.array_equal(image.T, sampled(x), equal_nan=True)
    step = 1e-6
    for k in range(len(x)):
        moved = [x + side * step * (np.arange(len(x)) == k)[:, None] for side in (1, -1)]
        change = (sampled(moved[0]) - sampled(moved[1])).T / (2 * step)
        tame = np.isfinite(change).all(axis=1) & (np.abs(change).max(axis=1) < 100)
        assert tame.sum() > 20
        assert np.abs(slopes[tame, :, k] - change[tame]).max() < 1e-4


def test_flights_get_shorter_to_the_end_of_chatter():
    """Each takes about half as long as that before it, down to a thousandth of a step in time."""
    ball, (x,) = System.example("bouncing-ball"), np.array([[[5.5], [1.0]]])
    times, slow = [], ball.at(g="1")._sampled
    while np.isfinite(after := slow(x)).all():
        times.append(after[0, 0] - x[0, 0])
        x = slow.reduced(after)
    assert len(times) > 10 and times[-1] < 1e-4
    assert all(0.4 < b / a < 0.6 for a, b in zip(times[-8:-1], times[-7:], strict=True))
    assert slow.undefined(slow.map, x).startswith("at once, as at rest or after chatter")


# -- the command -----------------------------------------------------------------------------------


def test_the_dossier_of_a_map(tmp_path, capsys):
    asked = ["--ask", "orbits:1", "stable", "--box", "x=0:1", "--out", str(tmp_path)]
    assert main(["--map", "r*x*(1 - x)", "--set", "r=3.2", *asked]) == 0
    said = capsys.readouterr().out
    assert said.index("Theorem, VERIFIED") < said.index("stable       VERIFIED")
    assert said.index("VERIFIED") < said.index("Seen in floating point, not proved")
    for file in ("orbits-1.json", "stable.json"):
        assert check((tmp_path / file).read_text()).sentences
    with pytest.raises(FileExistsError, match="about another system"):  # a line of the launcher's
        main(["--map", "x/2", "--ask", "orbits:1", "--out", str(tmp_path)])


def test_the_machine_form(capsys):
    assert main(["--map", "x/2 + 1", "--ask", "orbits:1", "horseshoe", "--json", "-"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert [claim["verdict"] for claim in found["claims"]] == ["VERIFIED", "UNDECIDED"]
    certificate = found["claims"][0]["certificate"]
    assert check(json.dumps(certificate)).sentences == tuple(found["claims"][0]["theorems"])
    certificate["steps"]["periodic-orbit-1"]["witness"]["box"] = [["3", "4"]]
    with pytest.raises(Rejected):
        check(json.dumps(certificate))


def test_the_time_is_over(capsys):
    """A question that is begun is stopped: Roessler's horseshoe takes many seconds."""
    arguments = ["--example", "roessler", "--ask", "horseshoe", "--seconds", "0.7"]
    began = time.monotonic()
    assert main(arguments) == 1
    assert time.monotonic() - began < 1.7
    said = capsys.readouterr().out
    assert said.count("stopped after 0.7 seconds, as asked") == 2 and "points at random" not in said


def test_names_of_motions_are_respelled():
    assert System(tomllib.loads(WEDGE)).respelled()[0] == "In what follows `x_` is X, `y_` is Y."
    flow = System(tomllib.loads('flow = "validated"' + FAST.replace("y", "Y")))
    assert flow.respelled()[0] == "In what follows `y_` is Y."


@pytest.mark.slow
def test_what_comes_next_is_asked(capsys):
    assert main(["--example", "wall", "--ask", "impact:a=0.3,v=-1", "impact:a=0.3,v=1"]) == 0
    said = capsys.readouterr().out
    assert "its values are `a` in" in said and "it moves into the wall" in said


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("impact:phi=1", "a value for each variable is expected: phi=..., v=..."),
        ("impact:phi=1,v=2,v=3", "v is given twice"),
        ("image:phi=1,v=x", "v: not a number: 'x'"),
        ("graze:phi=1,v=2", "one variable with a range is expected"),
        ("touching:phi=1,v=0:3", "two ranges are expected"),
        ("branches:q=1:2", "q is none of the parameters g, e"),
        ("flow:t=1,phi=1,v=2", "the flow is one of closed forms"),
    ],
)
def test_what_cannot_be_asked_is_told_before_any_work(asked, told, capsys, monkeypatch):
    monkeypatch.setattr(System, "orbits", None)
    with pytest.raises(SystemExit, match="2"):
        main(["--example", "bouncing-ball", "--ask", "orbits:1", asked])
    assert told in capsys.readouterr().err


def test_an_attracting_orbit_of_a_period_is_asked(capsys):
    assert main(["--map", "r*x*(1 - x)", "--set", "r=3.2", "--ask", "stable:2", "stable:1"]) == 1
    said = capsys.readouterr().out
    assert (
        "stable:2     VERIFIED   an attracting periodic orbit exists, of the least period 2" in said
    )
    assert "of the least period 1: none is seen, of a period 1\n" in said


def test_branches_of_flows_are_not_followed():
    with pytest.raises(Undecided, match="with a closed form"):
        System.example("van-der-pol").branches(m=("1", "2"))


def test_all_orbits_and_images_are_asked_of_the_command(capsys):
    asked = ["--ask", "all:3", "orbits", "image:x=0.3", "horseshoe:2", "--box", "x=-1:2"]
    assert main(["--map", "R*x*(1 - x)", "--set", "R=3.9", *asked]) == 0
    said = capsys.readouterr().out
    assert "exactly these: 2 of least period 1, 2 of least period 3." in said
    assert said.startswith("In what follows `r_` is R.\n") and "values are `x` in [0.81" in said
    assert said.count("N1 => N2") == 1  # once for both of its consequences


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--map", "sqrt(x - 10)"], "30 end before: where the map is not defined"),
        (["--map", "x^2 + 1"], "30 end before: beyond 1e+06"),
        (["--map", "x + 0.3 - sin(x)/2"], "x may be an angle: give it the period 2*pi"),
        (["--map", "x/0"], "30 end before: where the map is not defined"),
        (["--map", "x^2 - 1"], "18 come to an orbit of period 2 through (-1)\n"),
        (["--map", "-x"], "30 come to no attracting orbit of a period up to 8\n"),
        (["--map", "r*x", "--set", "r=0:2"], "exist: no isolated one is seen\n"),
        (["--map", "1 - r*x^2", "--set", "r=-1:3"], "narrower ranges do: r in [0.5, 1.5]\n"),
        (["--map", "exp(9*x)"], "is not defined, or too large for floating point"),
        (["--map", "x/2"], "of 30 points at random, x in [-3, 3], 30 are followed"),
        (["--example", "wall", "--box", "v=-1:2"], "as at rest or after chatter: d - x"),
        (["--example", "two-walls"], "at another wall than is next in their order"),
    ],
)
def test_what_becomes_of_points_is_said(arguments, told, capsys):
    main([*arguments, "--ask", "orbits:1", "--effort", "1"])
    assert told in capsys.readouterr().out


def test_a_return_may_take_longer_than_32():
    """Van der Pol's, seven times slower: 46.6."""
    file = System.example("van-der-pol")._file.file
    x = {"equation": "x'' = m*(1 - x^2)*x'/7 - x/49", "start": ["a", "0"]}
    assert "of period 1 through (2.00862)" in System({**file, "motion": {"x": x}}).seen()[-1]


def test_what_floating_point_does_not_see_is_not_said(capsys):
    """The image of x + 1 is that of x, or differs by 2: not always by the same number of turns."""
    assert main(["--map", "x/abs(x)", "--ask", "stable"]) == 0
    assert "angle" not in capsys.readouterr().out
    assert main(["--map", "2*x", "--ask", "stable"]) == 1
    assert "exists: none is seen, of a period up to 8\n" in capsys.readouterr().out


@pytest.mark.slow
def test_effort_is_how_much_is_looked_at():
    few, many = System.example("bouncing-ball"), System.example("bouncing-ball")
    few.effort, many.effort = 1, 3
    assert 0 < len(few.orbits(2)) < len(many.orbits(2))


def test_orbits_in_the_box_come_first_and_angles_are_below_a_period():
    """p + 7 sin x, x + p + 7 sin x: fixed points at x = 0 and pi, p any multiple of 2 pi."""
    kicked = Map("p + 7*sin(x)", "x + p + 7*sin(x)", periods={"x": "2*pi"})
    orbits = list(kicked.orbits(1))
    inside = [max(map(abs, each.box[0])) < 3 for each in orbits]
    assert inside == [True] * 2 + [False] * (len(orbits) - 2) and len(orbits) > 9
    assert all(-0.1 < each.box[1][0] < 6.2 for each in orbits)
    assert "having decreased by 1 period)" in str(kicked.orbits(1, near=[{"p": "-6.3", "x": "0"}]))


def test_digits_of_sets_are_those_that_matter():
    said = str(Map("2*x + y", "x + y", periods={"x": "1", "y": "1"}).horseshoe())
    assert "the points (0, " in said and not re.search("[0-9.]{12}", said.partition("entropy")[0])


def test_many_theorems_are_counted():
    theorem = Map("x^3 - 3*x", variables=["x"]).orbits(3, {"x": ("-2", "2")})
    assert theorem.text(3).endswith(
        f"- and {len(theorem) - 3} more of this kind, in the certificate"
    )
    assert str(theorem).count("- exactly one") == len(theorem) > 3


def test_the_image_of_a_box_is_about_as_wide_as_it_is():
    """4 x (1 - x) takes [0.1, 0.9] onto [0.36, 1]."""
    (image,) = accepted(Map("4*x*(1 - x)").image(x=("0.1", "0.9"))).conclusion.bounds
    assert image[0] <= Fraction(36, 100) < 1 <= image[1] < image[0] + Fraction(65, 100)


def test_candidates_that_meet_are_none():
    """3 x takes [-1/5, 1/5] across itself; a set around 3/10 meets it."""
    sets = Frames(np.array([[0], [0.3]]), np.array([[[0.2]]] * 2), ((0, 0),))
    with pytest.raises(Undecided, match="two sets meet"):
        crossing(Map("3*x")._sampled, sets)
