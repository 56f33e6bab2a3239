"""The paper's map with restitution as a flight: data for the kernel, put in by the checker itself.

A state is (phi, gamma): the phase of an impact and the velocity v / (omega_n p) before it. The map
takes it to the state before the next impact; phases are on the line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock, launch_with_restitution, return_map_derivative
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.enclose import Matrix, enclosed
from proofs.trusted.kernel.flight import Flight, read_gap
from proofs.trusted.kernel.head import read_head
from proofs.trusted.kernel.trees import formula
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

# Equations (5), (10), (14) and (15), as `equations` has them, which a test proves.
_LIFT, _RATE = "nu*sin(phi)", "nu*cos(phi)"
CLOSING = f"(eta*gamma + {_RATE})"
_KICK = f"epsilon*{CLOSING}"
GAP = (
    f"({_LIFT}*(cos(eta*t) - cos(t)) + {_RATE}*(sin(eta*t)*(1/eta) - sin(t)) + cos(eta*t) - 1 "
    f"+ {_KICK}*sin(eta*t)*(1/eta))"
)
ARRIVAL = f"(1 + {_LIFT})*sin(eta*t) - ({_RATE} + {_KICK})*(1/eta)*cos(eta*t)"
LATEST = Fraction(10**6)
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

    @property
    def sides(self) -> tuple[Range, Range, Range]:
        """The ranges of eta, nu and epsilon."""
        eta, nu, epsilon = self.formulas.ranges
        return eta, nu, epsilon

    @property
    def side(self) -> int:
        """The sign of nu."""
        return 1 if self.sides[1][0] > 0 else -1

    @property
    def at(self) -> Place:
        """The oscillators; Unproved where epsilon may be 1."""
        return Place(*self.sides)

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative by `return_map_derivative`, in which terms cancel.

        What follows from the formulas alone is up to four times as wide: with it 5 of 47 stable
        orbits of claim G16 are proved.
        """
        time, (phi, gamma) = self.impact(x), x
        eta, nu, epsilon = enclosed(self.formulas.ranges, phi.bits)
        start = launch_with_restitution(self.side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
        return [list(row) for row in return_map_derivative(start, clock(eta, time), epsilon)]

    def __eq__(self, other: object) -> bool:
        """Whether it is about the same oscillators."""
        return isinstance(other, Oscillator) and self.sides == other.sides

    def __hash__(self) -> int:
        return hash(self.sides)

    @property
    def definition(self) -> str:
        """What it is; no function of a file, though one may have its name."""
        return f"`{self.name}`, from an impact to the next one at {self.at}"


@lru_cache(maxsize=2)
def _flight(side: int) -> Flight:
    """Return the flight of all oscillators of which nu has this sign."""
    head, sign = read_head("F", Reader(_HEAD)), "" if side > 0 else "-"
    placer = head.placer()
    texts = (sign + GAP, sign + CLOSING, "phi + t", ARRIVAL)
    trees = [formula(text) for text in texts]
    gaps = (
        read_gap(placer, "t", trees[0], formula(sign + _KICK)),
        read_gap(placer, "t", trees[1]),
    )
    return Flight(head.formulas("F", placer, trees), len(head.state), gaps, ())


def flight(sides: Sequence[Range], latest: Fraction = LATEST) -> Oscillator:
    """Return the map for ranges of eta > 0, of nu, of one sign, and of epsilon from 0 to 1."""
    known = _flight(1 if sides[1][0] > 0 else -1)
    formulas = replace(known.formulas, ranges=tuple(sides), parts=())  # defined, as eta > 0
    return Oscillator(formulas, known.state, known.gaps, (), latest)


def read_oscillator(reader: Reader) -> Oscillator:
    """Read {eta, nu, epsilon}: ranges."""
    place = Place(*(side.range() for side in reader.fields("eta", "nu", "epsilon")))
    return flight(place.sides)
