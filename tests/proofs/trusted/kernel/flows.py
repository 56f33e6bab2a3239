"""Flows as functions of a file, and boxes of their variables: tests take them."""

import random
from fractions import Fraction
from typing import NamedTuple

TURN = {"a": "2*pi"}
ROESSLER = {
    "variables": ["y", "z"],
    "time": "t",
    "state": ["x1", "x2", "x3"],
    "field": ["-x2 - x3", "x1 + 1/5*x2", "1/5 + x3*(x1 - 57/10)"],
    "start": ["0", "y", "z"],
    "end": {"section": "x1", "direction": "+", "count": "1"},
    "values": ["x2", "x3"],
}
LORENZ = {
    "variables": ["a", "b", "c"],
    "time": "t",
    "state": ["x", "y", "z"],
    "field": ["10*(y - x)", "x*(28 - z) - y", "x*y - 8/3*z"],
    "start": ["a", "b", "c"],
    "end": {"time": "1"},
    "values": ["x", "y", "z"],
}
VAN_DER_POL = {
    "variables": ["a"],
    "time": "t",
    "state": ["x", "v"],
    "field": ["v", "(1 - x**2)*v - x"],
    "start": ["a", "0"],
    "end": {"section": "v", "direction": "-", "count": "1"},
    "values": ["x"],
}
PENDULUM = {  # driven: the phase of the drive is part of the map's variables, and in the field
    "variables": ["q", "p", "a"],
    "parameters": {"d": ["1/5", "1/5"], "f": ["1/2", "3/5"], "w": ["2/3", "2/3"]},
    "periods": TURN,
    "time": "t",
    "state": ["x", "v"],
    "field": ["v", "-d*v - sin(x) + f*cos(a + w*t)"],
    "start": ["q", "p"],
    "end": {"time": "2*pi/w/4"},
    "values": ["x", "v", "a + w*t"],
}
DUFFING = {  # against a moving wall: the phase and the velocity after the impact
    "variables": ["a", "v"],
    "parameters": {"e": ["4/5", "4/5"]},
    "periods": TURN,
    "time": "t",
    "state": ["x", "u", "s"],
    "field": ["u", "-u/10 - x - x**3 + cos(s)", "14/5"],
    "start": ["sin(a)/20", "v", "a"],
    "end": {"gaps": ["sin(s)/20 - x", "x + 3"]},
    "values": ["s", "-e*u + (1 + e)*cos(s)*7/50"],
}
MADE = {  # every operation, a start and an end that move
    "variables": ["a", "b"],
    "time": "t",
    "state": ["x", "y"],
    "field": [
        "sqrt(1 + x**2)/(2 + cos(y)) - x*exp(-t)",
        "log(2 + y**2)*atan(x - y) - x**3/(1 + x**2)**2 + sin(t*b)/y**2",
    ],
    "start": ["a*b", "a + 2"],
    "end": {"time": "1/2 + a/10"},
    "values": ["x*y", "y - t", "exp(-x)"],
}
SECOND = {**ROESSLER, "end": {"section": "x1 - t/100", "direction": "-", "count": "2"}}


class Example(NamedTuple):
    """A flow, about where its variables are, how far boxes reach, and how wide they are at most.

    step: one in which midpoint rules are as exact as they can be.
    """

    data: dict
    centre: tuple[str, ...]
    reach: tuple[str, ...]
    wide: str
    step: float = 1 / 16


FLOWS = {
    "roessler": Example(ROESSLER, ("-7", "3/100"), ("3", "1/100"), "1/50"),
    "lorenz": Example(LORENZ, ("0", "0", "25"), ("15", "15", "10"), "1/1000", 1 / 64),
    "van der pol": Example(VAN_DER_POL, ("-2",), ("1",), "1/20"),
    "pendulum": Example(PENDULUM, ("0", "0", "3"), ("3", "2", "3"), "1/20"),
    "duffing": Example(DUFFING, ("3", "-2"), ("3", "1"), "1/50"),
    "made": Example(MADE, ("1/2", "1/2"), ("2/5", "1/2"), "1/20"),
    "second": Example(SECOND, ("-7", "3/100"), ("3", "1/100"), "1/200"),
}


def box_of(example, rng: random.Random):
    """A box at random; its sides are as wide as is allowed, or less by powers of ten."""
    scale = Fraction(example.wide) / 10 ** rng.randrange(9)
    sides = []
    for centre, reach in zip(example.centre, example.reach, strict=True):
        middle = Fraction(centre) + Fraction(reach) * Fraction(rng.randrange(-1000, 1001), 1000)
        radius = scale * min(Fraction(reach), 1) * rng.randrange(1, 100) / 200
        sides.append((middle - radius, middle + radius))
    return tuple(sides)
