"""The paper's map with restitution as a flight: data for the kernel, put in by the checker itself.

A state is (phi, gamma): the phase of an impact and the velocity v / (omega_n p) before it. The map
takes it to the state before the next impact; phases are on the line.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.flight import Flight, read_gap
from proofs.trusted.kernel.head import read_head
from proofs.trusted.kernel.trees import formula
from proofs.trusted.parameters import Place

# Equations (5), (10), (14) and (15), as `equations` has them, which a test proves.
_LIFT, _RATE = "nu*sin(phi)", "nu*cos(phi)"
_CLOSING = f"(eta*gamma + {_RATE})"
_KICK = f"epsilon*{_CLOSING}"
GAP = (
    f"({_LIFT}*(cos(eta*t) - cos(t)) + {_RATE}*(sin(eta*t)*(1/eta) - sin(t)) + cos(eta*t) - 1 "
    f"+ {_KICK}*sin(eta*t)*(1/eta))"
)
ARRIVAL = f"(1 + {_LIFT})*sin(eta*t) - ({_RATE} + {_KICK})*(1/eta)*cos(eta*t)"
_HEAD = {
    "variables": ["phi", "gamma"],
    "time": "t",
    "parameters": {name: ["0", "1"] for name in ("eta", "nu", "epsilon")},  # `flight` puts others
    "periods": {"phi": "2*pi"},
}


@dataclass(frozen=True, eq=False)
class Oscillator(Flight):
    """The map of all oscillators of a box.

    A state is possible if the mass comes from above the table, gap' <= 0 before the impact: so it
    is defined where the closing speed is > 0, which is a second gap, the same at all times.
    """

    at: Place | None = None

    @property
    def definition(self) -> str:
        """Its name: what it is, the sentence says that begins with the oscillators."""
        return "F"


@lru_cache(maxsize=2)
def _flight(side: int) -> Flight:
    """Return the flight of all oscillators of which nu has this sign."""
    head, sign = read_head("F", Reader(_HEAD)), "" if side > 0 else "-"
    placer = head.placer()
    texts = (sign + GAP, sign + _CLOSING, "phi + t", ARRIVAL)
    trees = [formula(text) for text in texts]
    gaps = (
        read_gap(placer, "t", trees[0], formula(sign + _KICK)),
        read_gap(placer, "t", trees[1]),
    )
    return Flight(head.formulas("F", placer, trees), len(head.state), gaps, ())


def flight(at: Place) -> Oscillator:
    """Return the map of the oscillators of a box; their formulas are read once."""
    known = _flight(at.side)
    formulas = replace(known.formulas, ranges=at.sides, parts=())  # defined, as eta > 0
    return Oscillator(formulas, known.state, known.gaps, (), at=at)
