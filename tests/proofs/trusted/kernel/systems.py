"""Impact systems as functions of a file, and where their launches are: tests take them."""

from fractions import Fraction
from typing import NamedTuple

TURN = {"phi": "2*pi"}


def at(**numbers):
    """Parameters at one value each."""
    return {name: [value, value] for name, value in numbers.items()}


def motion(name, form, equation, *start):
    return {"name": name, "form": form, "equation": equation, "start": list(start)}


OSCILLATOR = {  # the paper's, of nu < 0
    "variables": ["phi", "gamma"],
    "parameters": at(eta="2121/10000", nu="-1/5", epsilon="1/100"),
    "periods": TURN,
    "time": "t",
    "motion": [
        motion(
            "q",
            "(1 + nu*sin(phi))*cos(eta*t) + (nu*cos(phi) + epsilon*(eta*gamma "
            "+ nu*cos(phi)))/eta*sin(eta*t)",
            "-eta**2*q",
            "1 + nu*sin(phi)",
            "nu*cos(phi) + epsilon*(eta*gamma + nu*cos(phi))",
        )
    ],
    "gaps": ["1 + nu*sin(phi + t) - q"],
    "values": ["phi + t", "-D(q, t)/eta"],
}
BALL = {  # on a vibrating table
    "variables": ["phi", "v"],
    "parameters": at(g="1/10", e="1/2"),
    "periods": TURN,
    "time": "t",
    "motion": [motion("y", "sin(phi) + v*t - g*t**2/2", "-g", "sin(phi)", "v")],
    "gaps": ["y - sin(phi + t)"],
    "values": ["phi + t", "(1 + e)*cos(phi + t) - e*D(y, t)"],
}
DAMPED = {  # a forced and damped oscillator at a wall at x = s, restitution r
    "variables": ["phi", "v"],
    "parameters": at(w="14/5", d="1/20", s="1/5", r="4/5"),
    "periods": TURN,
    "time": "t",
    "motion": [
        motion(
            "x",
            "cos(phi + w*t) + exp(-d*t)*((s - cos(phi))*cos(t) "
            "+ (v + w*sin(phi) + d*(s - cos(phi)))*sin(t))",
            "-2*d*D(x, t) - (1 + d**2)*x + (1 + d**2 - w**2)*cos(phi + w*t) - 2*d*w*sin(phi + w*t)",
            "s",
            "v",
        )
    ],
    "gaps": ["s - x"],
    "values": ["phi + w*t", "-r*D(x, t)"],
}
RATTLE = {  # a gear's tooth with drag between two walls that vibrate: from the lower to the upper
    "variables": ["phi", "v"],
    "parameters": at(b="1/4", c="1/10", e="3/5"),
    "periods": TURN,
    "time": "t",
    "motion": [motion("x", "b*sin(phi) + v*(1 - exp(-c*t))/c", "-c*D(x, t)", "b*sin(phi)", "v")],
    "gaps": ["b*sin(phi + t) + 1 - x", "x - b*sin(phi + t)"],
    "values": ["phi + t", "(1 + e)*b*cos(phi + t) - e*D(x, t)"],
}
RATTLE_BACK = {  # and from the upper one to the lower
    **RATTLE,
    "motion": [
        motion("x", "b*sin(phi) + 1 + v*(1 - exp(-c*t))/c", "-c*D(x, t)", "b*sin(phi) + 1", "v")
    ],
    "gaps": RATTLE["gaps"][::-1],
}
FAR = {**DAMPED, "parameters": {**DAMPED["parameters"], "s": ["11/10", "11/10"]}}
RESTING = {  # the ball, in contact: its velocity is the table's
    **BALL,
    "variables": ["phi"],
    "parameters": at(g="1/2"),
    "motion": [motion("y", "sin(phi) + cos(phi)*t - g*t**2/2", "-g", "sin(phi)", "cos(phi)")],
    "values": ["phi + t"],
}
_NORMAL = "((u*b*sin(x) + D(y, t) - c*cos(phi + t))/(1 + b**2*sin(x)**2))"
BILLIARD = {  # a ball over a wavy floor that vibrates; g is any number of a range
    "variables": ["phi", "s", "u", "w"],
    "parameters": {
        "g": ["1", "1001/1000"],
        "b": ["1/5", "1/5"],
        "c": ["1/10", "1/10"],
        "e": ["9/10", "9/10"],
    },
    "periods": {"phi": "2*pi", "s": "2*pi"},
    "time": "t",
    "motion": [
        motion("x", "s + u*t", "0", "s", "u"),
        motion("y", "b*cos(s) + c*sin(phi) + w*t - g*t**2/2", "-g", "b*cos(s) + c*sin(phi)", "w"),
    ],
    "gaps": ["y - b*cos(x) - c*sin(phi + t)"],
    "values": [
        "phi + t",
        "x",
        f"u - (1 + e)*{_NORMAL}*b*sin(x)",
        f"D(y, t) - (1 + e)*{_NORMAL}",
    ],
}


class Example(NamedTuple):
    """A function of a file, and a box of states at which it may be launched."""

    data: dict
    box: tuple[tuple[float, float], ...]


SYSTEMS = {
    "oscillator": Example(OSCILLATOR, ((0.9, 1.5), (-0.45, 0.05))),
    "ball": Example(BALL, ((-3, 3), (1, 3))),
    "damped": Example(DAMPED, ((-3, 3), (-4, -0.5))),
    "rattle": Example(RATTLE, ((-3, 3), (0.4, 3))),
    "back": Example(RATTLE_BACK, ((-3, 3), (-3, -0.4))),
    "billiard": Example(BILLIARD, ((-3, 3), (-3, 3), (-1, 1), (0.6, 2.5))),
}


def box_of(example, rng, widest=-2.0):
    """A small box of states, of a width between 2e-5 and 2 * 10^widest, as fractions."""
    width = Fraction(10 ** rng.uniform(-5, widest)).limit_denominator(10**6)
    centre = [Fraction(rng.uniform(*side)).limit_denominator(10**6) for side in example.box]
    return tuple((x - width, x + width) for x in centre)
