"""Flows against integrators that share nothing with them; forgeries, each refused with its reason.

`tests.oracles.ode` extrapolates midpoint rules in long doubles; mpmath has Taylor steps of its own.
"""

import json
import random
import time
from collections import Counter
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
import sympy

from proofs import System
from proofs.trusted.certificate import SCHEMA, Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.enclose import centre_of, enclosed, point_box
from proofs.trusted.kernel.lohner import Solutions, orthogonal
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.kernel.series import Series
from proofs.trusted.verify import Rejected, check
from tests.once import examples
from tests.oracles.ode import LONG, MANY, Solver
from tests.proofs.trusted.kernel.flows import (
    DUFFING,
    FLOWS,
    LORENZ,
    MADE,
    PENDULUM,
    VAN_DER_POL,
    box_of,
)

LONG_ONLY = pytest.mark.long
FAST = ["pendulum", "duffing", "lorenz", "van der pol", "made"]
BY_SPEED = [*FAST, *(pytest.param(x, marks=LONG_ONLY) for x in FLOWS if x not in FAST)]
SLIP = 1e-13  # of the integrator's values, as a part of them
SLOPE_SLIP = 1e-7  # of its differences


def flow(data):
    return read_map("F", Reader(data), {})


def enclosures(data, box, bits=64):
    map_, x = flow(data), enclosed(tuple(tuple(map(Fraction, side)) for side in box), bits)
    return map_.values(x), [entry for row in map_.jacobian(x) for entry in row]


def ends(entries):
    return np.array([[float(end) for end in x.range] for x in entries]).T


def inside(values, bounds, slip):
    return np.all(bounds[0] - slip <= values) and np.all(values <= bounds[1] + slip)


# -- containment -----------------------------------------------------------------------------------


def contained(name, count, rng):
    """Count boxes, those of which something is enclosed, and what is outside."""
    counts, points, bounds = Counter(boxes=count), [], []
    while len(points) < count:
        box = box_of(FLOWS[name], rng)
        try:
            bounds.append([ends(each) for each in enclosures(FLOWS[name].data, box)])
        except Unproved:
            counts["unproved"] += 1
            continue
        points.append([float(a) + float(b - a) * rng.random() for a, b in box])
    numbers = LONG._replace(step=FLOWS[name].step)
    values, slopes = Solver(FLOWS[name].data, numbers).both(np.array(points).T)
    for k, (value, slope) in enumerate(bounds):
        own, flat = values[:, k], slopes[:, :, k].ravel()
        counts["values"] += not inside(own, value, SLIP * (1 + abs(own)))
        counts["derivatives"] += not inside(flat, slope, SLOPE_SLIP * (1 + np.max(abs(flat))))
    return counts


@pytest.mark.parametrize("name", BY_SPEED)
def test_values_and_derivatives_are_enclosed(name):
    counts = contained(name, examples(12), random.Random(name))
    assert counts["unproved"] * 4 < counts["boxes"], counts
    assert not counts["values"] and not counts["derivatives"], counts


@pytest.mark.long
@pytest.mark.parametrize("name", FLOWS)
def test_thousands_of_boxes_are_enclosed(name):
    counts = contained(name, 300, random.Random(f"{name}, at length"))
    print(name, dict(counts))
    assert not counts["values"] and not counts["derivatives"], counts


TALL = {**PENDULUM, "parameters": {**PENDULUM["parameters"], "f": ["3/5", "3/5"]}}
POINTS = {  # at which long doubles are not enough; the step of the integrator
    "lorenz": ({**LORENZ, "end": {"time": "1/4"}}, ("1", "2", "20"), 1 / 64),
    "made": (MADE, ("3/5", "-1/3"), 1 / 16),
    "pendulum": (TALL, ("1", "2", "3"), 1 / 16),
    "van der pol": (VAN_DER_POL, ("-2",), 1 / 16),
}


@pytest.mark.long
@pytest.mark.parametrize("name", POINTS)
def test_many_digits_at_points(name):
    """By mpmath's numbers: 28 digits of the values, 15 of the derivatives."""
    data, point, step = POINTS[name]
    values, slopes = enclosures(data, [(x, x) for x in point], 128)
    with mpmath.workdps(40):
        exact = [[mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator] for x in point]
        own, differences = Solver(data, MANY._replace(step=step)).both(exact)
        for entries, wanted, slip in ((values, own, 1e-28), (slopes, differences, 1e-15)):
            for x, value in zip(entries, wanted.ravel(), strict=True):
                low, high = (mpmath.mpf(end.numerator) / end.denominator for end in x.range)
                assert low - slip <= value <= high + slip
                assert high - low < 1e-28


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=() if x in ("made", "pendulum") else LONG_ONLY) for x in FLOWS]
)
def test_precisions_agree_and_narrow_boxes_are_in_wide_ones(name):
    example, rng = FLOWS[name], random.Random(f"{name} twice")
    wide = box_of(example, rng)
    while any(b - a > Fraction(1, 10**4) for a, b in wide):
        wide = box_of(example, rng)
    middle = centre_of(wide)
    narrow = [((9 * m + a) / 10, (9 * m + b) / 10) for m, (a, b) in zip(middle, wide, strict=True)]
    boxes = [enclosures(example.data, box) for box in (point_box(middle), narrow, wide)]
    fine = enclosures(example.data, point_box(middle), 128)
    is_thin = "pendulum" not in name  # which has a parameter in a range
    for one, inner, outer, sharp in zip(*([*a, *b] for a, b in [*boxes, fine]), strict=True):
        (a, b), (c, d) = one.range, sharp.range
        assert a <= d and c <= b
        assert (d - c) * 2**40 <= b - a or not is_thin
        assert inner.range[0] <= d and c <= inner.range[1]
        assert outer.lo <= inner.lo <= inner.hi <= outer.hi


# -- truths and lies -------------------------------------------------------------------------------

CIRCLE = {
    "variables": ["a"],
    "time": "t",
    "state": ["x", "v"],
    "field": ["v", "-x"],
    "start": ["0", "a"],
    "end": {"time": "pi/2"},
    "values": ["x", "v"],
}
LINE = {**CIRCLE, "state": ["x"], "start": ["a"], "values": ["x"]}


def circle(**fields):
    return {**CIRCLE, **fields}


def line(rate, end, *values, **fields):
    values = list(values) or ["x"]
    return {**LINE, "field": [rate], "end": end, "values": values, **fields}


def section(gap, direction="-", count=1):
    return {"section": gap, "direction": direction, "count": str(count)}


UNIT, ONE = [("9/10", "11/10")], [("1", "1")]
FALL = circle(field=["v", "-2"], start=["a", "0"], values=["t", "v"], end=section("x"))
THREE = {"parameters": {"r": ["2", "3"]}}
TRUTHS = [  # the first value, in closed form
    ("x' = x", line("x", {"time": "1"}), ONE, lambda m: m.e),
    ("x' = x^2", line("x**2", {"time": "1/2"}), ONE, lambda m: 2),
    ("x' = x cos t", line("x*cos(t)", {"time": "2"}), ONE, lambda m: m.exp(m.sin(2))),
    ("x' = r x", line("r*x", {"time": "r/4"}, **THREE), ONE, lambda m: m.exp(2.5**2 / 4)),
    ("x' = a", line("a", {"time": "a"}), ONE, lambda m: 2),
    ("x' = 0", line("0", {"time": "a"}), ONE, lambda m: 1),
    ("x' = 1/x", line("1/x", {"time": "3/2"}), ONE, lambda m: 2),
    ("a quarter turn", CIRCLE, ONE, lambda m: 1),
    ("a fall", FALL, ONE, lambda m: 1),
    ("a section left upward", circle(end=section("x"), values=["t"]), ONE, lambda m: m.pi),
    ("left downward", circle(end=section("-x"), values=["t"]), ONE, lambda m: 2 * m.pi),
    (
        "left downward, but for rounding",
        circle(start=["sin(a)", "-1"], end=section("x - sin(a)"), values=["t"]),
        ONE,
        lambda m: 2 * m.pi,
    ),
    ("the third", circle(end=section("x", "-", 3), values=["t"]), ONE, lambda m: 5 * m.pi),
    ("the second up", circle(end=section("x", "+", 2), values=["t"]), ONE, lambda m: 4 * m.pi),
    (
        "a moving wall",
        circle(end=section("x - t/2")),
        ONE,
        lambda m: m.findroot(lambda t: m.sin(t) - t / 2, 1.9) / 2,
    ),
    ("an impact", circle(end={"gaps": ["x"]}, values=["t"]), ONE, lambda m: m.pi),
    ("an impact from above", {**FALL, "end": {"gaps": ["x"]}}, ONE, lambda m: 1),
    (
        "another wall",
        circle(end={"gaps": ["x - t/2", "2 - x", "x"]}),
        ONE,
        lambda m: m.findroot(lambda t: m.sin(t) - t / 2, 1.9) / 2,
    ),
    ("below at first", circle(end=section("x - 1/2")), ONE, lambda m: 0.5),
    ("a wide start, over steps", line("-1", section("x"), "t"), [("1", "9")], lambda m: 5),
]


@pytest.mark.parametrize(
    ("data", "box", "first"), [x[1:] for x in TRUTHS], ids=[x[0] for x in TRUTHS]
)
def test_truths(data, box, first):
    with mpmath.workdps(30):
        wanted = mpmath.mpf(first(mpmath.mp))
        for bits in (64, 192):
            low, high = enclosures(data, box, bits)[0][0].range
            low, high = (mpmath.mpf(end.numerator) / end.denominator for end in (low, high))
            assert low - 1e-28 <= wanted <= high + 1e-28
            if box is ONE and "parameters" not in data:
                assert high - low < mpmath.mpf(10) ** -(14 if bits == 64 else 50)


@pytest.mark.parametrize("rate", ["x**2", "x*x*x/3 - x"])
def test_coefficients_contain_the_exact_ones(rate):
    """From points whose products are rounded; by Leibniz, in fractions."""
    program, rng, orders = flow(line(rate, {"time": "1"})).equation.plain, random.Random(rate), 8

    def product(a, b):
        return [sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(len(a))]

    for width in [0] * 10 + [2**50, 2**58] * 5:
        m = rng.randrange(2**63, 2**64) | 1
        x, nothing = Enclosure(m - width, m + width, 64), Enclosure(0, 0, 64)
        series = Series(program, [nothing, x, nothing], Fraction(1, 4))
        for point in (m - width, m, m + width):
            exact = [Fraction(point, 2**64)]
            for k in range(orders):
                square = product(exact, exact)
                cube = product(square, exact)
                value = square[k] if rate == "x**2" else cube[k] / 3 - exact[k]
                exact.append(value / 4 / (k + 1))
                low, high = series.coefficients(k + 1)[0].range
                assert low <= exact[-1] <= high
                assert width or high - low < Fraction(1, 2**56)


CURVES = {  # solutions from x = 1 in closed form, and x' = f
    "x": lambda t: mpmath.exp(t),
    "x**2": lambda t: 1 / (1 - t),
    "-x**3": lambda t: 1 / mpmath.sqrt(1 + 2 * t),
    "cos(t)*x": lambda t: mpmath.exp(mpmath.sin(t)),
}


@pytest.mark.parametrize("rate", CURVES)
@pytest.mark.parametrize("order", [3, 5])
def test_a_step_of_low_order_is_right_by_its_rest(rate, order):
    solutions = Solutions.of(
        flow(line(rate, {"time": "1"})).equation, enclosed(point_box([Fraction(1)]), 96)
    )
    one = solutions.w[0]
    first, proved = solutions.begin([one], [[one]]), 0
    for h in (Fraction(1, 64), Fraction(1, 8), Fraction(1, 4)):
        step = solutions.step(first, Fraction(0), h, order)
        if step is None:
            continue
        proved += 1
        ends = [(solutions.after(step).states(solutions.q), h)]
        for part in (Fraction(1, 3), Fraction(1)):
            states = solutions.at(step, rational(part, 96))
            ends += [(each, part * h) for each in (states.all, states.middle, states.end)]
        for (entry,), time_ in ends:
            with mpmath.workdps(30):
                low, high = (mpmath.mpf(end.numerator) / end.denominator for end in entry.range)
                value = CURVES[rate](mpmath.mpf(time_.numerator) / time_.denominator)
            assert low <= value <= high
    assert proved


def test_a_step_beyond_blow_up_is_not_proved():
    solutions = Solutions.of(
        flow(line("x**2", {"time": "1"})).equation, enclosed(point_box([Fraction(1)]), 64)
    )
    one = solutions.w[0]
    for h in (Fraction(1), Fraction(3, 2), Fraction(4)):
        for order in (1, 2, 8, 20):
            first = solutions.begin([one], [[one]])
            assert solutions.step(first, Fraction(0), h, order) is None


def test_the_inverse_of_a_frame_is_enclosed():
    rng = random.Random("frames")
    for n in (1, 2, 3, 5):
        rows = [[Fraction(rng.randrange(-99, 100), 7) for _ in range(n)] for _ in range(n)]
        widths = [rational(Fraction(0), 256)] * n
        frame, inverse = orthogonal([[rational(x, 256) for x in row] for row in rows], widths)
        exact = sympy.Matrix(
            [[sympy.Rational(*x.range[0].as_integer_ratio()) for x in row] for row in frame]
        ).inv()
        for i, row in enumerate(inverse):
            for j, x in enumerate(row):
                low, high = (sympy.Rational(*end.as_integer_ratio()) for end in x.range)
                assert low <= exact[i, j] <= high
                assert high - low < sympy.Rational(1, 2**40)


ON, NO_STEP = "on both sides of the section", "it is not proved that the solutions go on"
TOUCHED, NEVER = "whether the section is crossed or touched", "the end is not reached in"
STAYS = "it is not proved that the gaps stay > 0"
INTO, PERIOD = "no derivatives of what flows", "not proved to respect the period"
STATE = [("0", "0"), ("0", "0"), ("0", "0")]


def tower():
    """3, squared 40 times, by substitutions."""
    text = "3"
    for _ in range(40):
        text = f"at(k*k, k={text})"
    return text


LIES = [  # what is false, the function, a box, the reason
    ("beyond blow-up", line("x**2", {"time": "2"}), ONE, "up to the time 0.99999"),
    ("a factor of a billion digits", line(f"{tower()}*x", {"time": "1"}), ONE, "too many digits"),
    ("a state as an angle", circle(periods={"x": "2*pi"}), ONE, "what is no variable"),
    ("to blow-up", line("x**2", {"time": "1"}), ONE, NO_STEP),
    ("blow-up for some", line("x**2", {"time": "1"}), UNIT, NO_STEP),
    ("beyond the end", line("-1/x", {"time": "1"}), ONE, "up to the time 0.4999"),
    ("not defined at first", line("log(x)", {"time": "1"}), [("0", "1")], NO_STEP),
    ("undefined with 0 times it", line("1 + 0*(1/(x - 3/2))", {"time": "1"}), ONE, NO_STEP),
    ("a tangency", circle(start=["a", "0"], end=section("x + 1")), ONE, TOUCHED),
    ("a tangency for some", circle(start=["1", "0"], end=section("x + a")), UNIT, TOUCHED),
    ("a section that is touched", circle(end=section("(x - 1/2)**2")), ONE, TOUCHED),
    ("a start on both sides", line("-1", section("x - 1"), "t"), UNIT, ON),
    ("a start next to it", line("-1", section("x - 1"), "t"), [("1", "1000001/1000000")], ON),
    ("a launch into the wall", circle(end={"gaps": ["-x"]}), ONE, STAYS),
    ("a launch behind the wall", circle(end={"gaps": ["x - 1/2"]}), ONE, STAYS),
    ("a launch that rests", circle(end={"gaps": ["x*t"]}), ONE, STAYS),
    ("another wall first", circle(end={"gaps": ["x", "1/2 - x"]}), ONE, STAYS),
    ("another wall at once", circle(end={"gaps": ["x", "2*x"]}), ONE, STAYS),
    ("another wall that is touched", circle(end={"gaps": ["x", "1 - x"]}), ONE, STAYS),
    ("another wall at the start", circle(end={"gaps": ["x", "1/10 - x", "-x"]}), ONE, STAYS),
    ("no section", circle(end=section("x - 2")), ONE, "after 0 crossings"),
    ("never again", line("1", section("x - 3", "+", 2)), ONE, NEVER),
    ("another direction", line("1", section("x - 3")), ONE, NEVER),
    ("no positive time", line("1", {"time": "a - 1"}), ONE, "not proved positive"),
    ("a time that may be 0", line("1", {"time": "a - 9/10"}), UNIT, "not proved positive"),
    ("a time far away", line("1", {"time": "1024"}), ONE, "not proved to be before 1024"),
    ("ever shorter steps", line("1/(x - 5/4)**2", {"time": "1"}), ONE, NO_STEP),
    ("a time of the state", line("1", {"time": "x"}), ONE, "depends on the variables of the map"),
    ("a start that moves", line("1", {"time": "1"}, start=["a + t"]), ONE, "does not depend on"),
    ("a start by the state", line("1", {"time": "1"}, start=["x"]), ONE, "does not depend on"),
    ("a velocity as 0", circle(field=["v", "D(x, t)"]), ONE, INTO),
    ("a speed as a value", circle(values=["D(x, t)"]), ONE, INTO),
    ("a derivative by the start", circle(values=["D(x, a)"]), ONE, INTO),
    ("a derivative by the state", circle(values=["D(x*v, x)"]), ONE, INTO),
    ("another time", circle(values=["at(x, t=2*t)"]), ONE, INTO),
    ("a section at another time", circle(end=section("at(x, t=2*t)")), ONE, INTO),
    ("a velocity inside", circle(field=["v", "-x + sin(2*D(x, t))"]), ONE, INTO),
    ("count 0", circle(end=section("x", "-", 0)), ONE, "an integer from 1"),
    ("no direction", circle(end=section("x", "*")), ONE, 'or "-" is expected'),
    ("two ends", circle(end={**section("x"), "time": "1"}), ONE, "unknown field"),
    ("no end", circle(end={}), ONE, "missing field"),
    ("a field too short", circle(field=["v"]), ONE, "1 entries, expected 2"),
    ("a name twice", circle(state=["x", "a"]), ONE, "a name that is there twice"),
    ("an unknown name", circle(field=["v", "-y"]), ONE, "unknown variable 'y'"),
    ("half a period", {**PENDULUM, "periods": {"a": "pi"}}, STATE, PERIOD),
    ("a period of a place", {**PENDULUM, "periods": {"q": "1"}}, STATE, PERIOD),
    ("a value that turns half", {**PENDULUM, "values": ["x", "v", "a/2"]}, STATE, PERIOD),
    ("a value in the place", {**PENDULUM, "values": ["x", "a", "v"]}, STATE, PERIOD),
    ("a wall that counts turns", {**DUFFING, "end": section("s/100 - x")}, STATE[:2], PERIOD),
    ("a start that counts", {**DUFFING, "start": ["0", "v", "a/2"]}, STATE[:2], PERIOD),
]


def test_a_box_as_wide_as_all_is_enclosed():
    """With as many digits as any: x e^-1 for x up to 10^60."""
    values, _ = enclosures(line("-x", {"time": "1"}), [("0", "1" + "0" * 60)])
    low, high = values[0].range
    assert low <= 0 and 3 * high > 10**60


@pytest.mark.parametrize(("data", "box", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES])
def test_lies(data, box, reason):
    with metered(1e6), pytest.raises((Unproved, Malformed, Exhausted)) as caught:
        enclosures(data, box)
    assert reason in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


# -- forgeries of certificates ---------------------------------------------------------------------


@cache
def orbit():
    """A certificate of a periodic orbit of Roessler's flow."""
    return System.example("roessler").orbits(1, near=[{"p": "-8.38", "q": "0.03"}]).certificate


def edited(path, value):
    """The certificate with another entry in its function, or in the witness of its step."""
    document = json.loads(orbit())
    place = document["functions"]["P"] if path[0] != "witness" else document["steps"][STEP]
    for key in path[:-1]:
        place = place[key]
    assert not (isinstance(place, list) or path[-1] in place) or place[path[-1]] != value
    place[path[-1]] = value
    return render(document)


STEP = "periodic-orbit-1"
FORGERIES = [
    ("another field", ("field", 1), "x + a*y + 1/1000000"),
    ("another sign", ("field", 0), "-y + z"),
    ("another parameter", ("parameters", "c"), ["57001/10000", "57001/10000"]),
    ("a range of parameters", ("parameters", "c"), ["57/10", "5701/1000"]),
    ("another section", ("end", "section"), "x - 1/1000000"),
    ("another direction", ("end", "direction"), "-"),
    ("one crossing more", ("end", "count"), "2"),
    ("one crossing less", ("end", "count"), "0"),
    ("a time", ("end",), {"time": "6"}),
    ("a wall", ("end",), {"gaps": ["-x"]}),
    ("another start", ("start", 0), "1/1000000"),
    ("another value", ("values", 0), "y + 1/1000000"),
    ("another order", ("values",), ["z", "y"]),
    ("another period", ("witness", "period"), "2"),
    ("another place", ("witness", "box", 0), ["-8380941743/1000000000", "-8380941742/1000000000"]),
    ("an angle", ("periods",), {"p": "2*pi"}),
]


@pytest.mark.slow
def test_an_orbit_is_checked_within_the_usual_work():
    sentence = check(orbit()).sentences[0]
    for text in ("D(z, t) = b + z*(x - c)", "1st `t > 0` at which `x` rises", "`c` = 5.7"):
        assert text in sentence
    assert len(orbit()) < 1200


DEAR = ("another sign", "one crossing more", "another period", "a range of parameters")


@pytest.mark.parametrize(
    ("path", "value"),
    [pytest.param(*x[1:], id=x[0], marks=LONG_ONLY if x[0] in DEAR else ()) for x in FORGERIES],
)
def test_forgeries(path, value):
    began = time.process_time()
    with pytest.raises((Rejected, Malformed, Exhausted)):
        check(edited(path, value))
    assert time.process_time() - began < 15


SADDLE = {**CIRCLE, "variables": ["a", "b"], "field": ["x", "-v"], "start": ["a", "b"]}


@pytest.mark.parametrize(("wide", "is_covered"), [("2718279", True), ("2718284", False)])
def test_a_covering_that_fails_by_a_millionth(wide, is_covered):
    """x' = x, v' = -v, for a time 1: the half width e = 2.7182818... beside that of the target."""
    unit = {"centre": ["0", "0"], "matrix": [["1", "0"], ["0", "1"]]}
    target = {**unit, "matrix": [[str(Fraction(wide) / 10**6), "0"], ["0", "1"]]}
    sets = {
        name: {
            **each,
            "inverse": [
                [str(1 / Fraction(x)) if x != "0" else x for x in row] for row in each["matrix"]
            ],
        }
        for name, each in (("N", unit), ("M", target))
    }
    steps = {name: {"rule": "h-set", "witness": each} for name, each in sets.items()}
    witness = {"function": "F", "power": "1", "source": "N", "target": "M", "sign": "+"}
    whole = ["1", "0", None, None]
    witness |= {"left": None, "right": None, "support": whole}
    steps["over"] = {"rule": "covers", "witness": witness}
    document = {"schema": SCHEMA, "parameters": None, "steps": steps, "claims": ["over"]}
    text = render({**document, "functions": {"F": {**SADDLE, "end": {"time": "1"}}}})
    if is_covered:
        assert len(check(text).conclusions) == 1
    else:
        with pytest.raises(Rejected):
            check(text)


def test_every_part_of_a_flow_is_in_its_definition():
    """What is not said is not part of a theorem."""
    plain = {**DUFFING, "periods": {}}
    said = flow(plain).definition
    edits = [("field", k, "x + u + 1") for k in range(3)]
    edits += [("start", k, "7/2") for k in (0, 1)] + [("values", 1, "u*x")]
    for key, k, text in edits:
        other = {**DUFFING, key: [text if i == k else x for i, x in enumerate(DUFFING[key])]}
        assert (
            flow({**other, "periods": {}}).definition != flow({**DUFFING, "periods": {}}).definition
        )
    for end in ({"gaps": ["x + 3"]}, section("x"), section("x", "+"), section("x", "+", 12)):
        assert flow({**plain, "end": end}).definition != said
    assert (
        "at the 12th `t > 0` at which `x` rises through 0"
        in flow({**DUFFING, "end": section("x", "+", 12), "periods": {}}).definition
    )


HOSTILE = {
    "many states": {
        **LINE,
        "state": [f"x{i}" for i in range(8)],
        "field": [f"sin({'*'.join(f'x{(i + k) % 8}' for k in range(8))})" for i in range(8)],
        "start": ["a"] * 8,
        "end": {"time": "1000"},
        "values": ["x0"],
    },
    "a high power": line("cos(x**1000 + t)", {"time": "1000"}),
    "long numbers": line(f"-x*{'7' * 3000}/{'9' * 3000}", {"time": "1000"}),
    "a fast field": line("cos(1000000*t)", {"time": "1000"}),
    "many crossings": circle(end=section("x", "-", 100)),
    "never there": circle(end=section("x - 3")),
    "a long sum": line(" + ".join(f"sin({k}*x)" for k in range(1, 140)), {"time": "1"}),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_costs_no_more_than_it_is_given(name):
    began = time.process_time()
    with metered(5e5) as meter, pytest.raises((Exhausted, Unproved)):
        for bits in (64, 4096):
            enclosures(HOSTILE[name], ONE, bits)
    assert time.process_time() - began < 3, meter.spent
