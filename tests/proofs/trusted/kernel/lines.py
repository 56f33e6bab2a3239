"""Maps of the line and of a circle with known dynamics, and steps about them: tests take them."""

from fractions import Fraction

from proofs.trusted.certificate import SCHEMA

F = Fraction
FUNCTIONS = {
    "F": {"variables": ["x"], "values": ["5*x*(1 - x)"]},  # all but a Cantor set escapes [0, 1]
    "G": {"variables": ["x"], "values": ["16/5*x*(1 - x)"]},  # an orbit of period 2 attracts
    "H": {  # of degree 3 on the circle; fixed points at 1 and 1 + pi, where H' = 17/5
        "variables": ["x"],
        "values": ["3*x - 2 + sin(2*(x - 1))/5"],
        "parameters": {},
        "periods": {"x": "2*pi"},
    },
}
ENDS = ["0", "7/25"], ["18/25", "1"]
SHOE = ["999/1000", "2071/500"]  # around the fixed points of H


def slopes(function, *points):
    witness = {"function": function, "points": list(points), "bits": "64"}
    return {"rule": "slopes", "witness": witness}


def gap(function, source, target):
    low, high = map(F, source)
    points = [str(low + (high - low) * k / 64) for k in range(65)]
    return {"rule": "avoids", "witness": {"function": function, "points": points, "target": target}}


def staying(region, cells, gaps):
    entries = [{"slopes": name, "domain": ends} for name, ends in cells]
    return {"rule": "staying-set", "witness": {"region": region, "cells": entries, "gaps": gaps}}


STEPS = {
    "left": slopes("F", "0", "1/8", "1/4", "7/25"),
    "right": slopes("F", "18/25", "3/4", "7/8", "1"),
    "middle": gap("F", ["7/25", "18/25"], ["0", "1"]),
    "low": slopes("G", "1/2", "53/100"),
    "high": slopes("G", "159/200", "401/500"),
    "first": slopes("H", SHOE[0], "3/2", "41/20"),
    "last": slopes("H", "77/25", "7/2", SHOE[1]),
    "between": gap("H", ["41/20", "77/25"], SHOE),
    "set": staying([["0", "1"]], [("left", ENDS[0]), ("right", ENDS[1])], ["middle"]),
    "covering": {
        "rule": "covering-graph",
        "witness": {
            "branches": ["left", "right"],
            "images": [{"phase": x} for x in ("0", "7/25", "18/25", "1")],
            "states": [["0", "1"]],
            "weights": ["1"],
            "growth": "2",
        },
    },
    "orbit": {
        "rule": "stable-orbit",
        "witness": {
            "cells": [
                {"slopes": "low", "domain": ["1/2", "53/100"]},
                {"slopes": "high", "domain": ["159/200", "401/500"]},
            ]
        },
    },
    "shoe": staying(
        [SHOE], [("first", [SHOE[0], "41/20"]), ("last", ["77/25", SHOE[1]])], ["between"]
    ),
    "followed": {
        "rule": "itinerary",
        "witness": {"horseshoe": "shoe", "slopes": ["first"], "phase": "3/2"},
    },
    "thirds": {
        "rule": "moran-root",
        "witness": {"ratios": ["1/4", "1/4", "1/4"], "root": ["99/125", "793/1000"]},
    },
}
CLAIMS = ["set", "covering", "orbit", "shoe", "followed", "thirds"]


class Lines:
    """They as a file, like those that `Lemmas` collects."""

    def document(self):
        parts = {"functions": FUNCTIONS, "steps": STEPS, "claims": CLAIMS}
        return {"schema": SCHEMA, "parameters": None, **parts}
