"""The paper's maps, from one impact to the next, as maps of first impacts: data for the kernel.

The gap and what is at an impact are those of `equations`, put in by the checker itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import ClassVar, NamedTuple, Self

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import (
    Launch,
    Number,
    arrival,
    clock,
    closing,
    gap,
    launch,
    launch_acceleration,
    launch_with_restitution,
    return_map_derivative,
    slope,
)
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, pi, rational
from proofs.trusted.kernel.enclose import Box, Circle, Matrix, centre_of, point_box
from proofs.trusted.kernel.firstzero import FirstZero, Gap
from proofs.trusted.kernel.returns import Impact, ReturnMap
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place

LATEST = Fraction(10**6)
# The numbers of functions: 0 to 4 are the gap and its derivatives by the time; partial derivatives
# by the first, second, ... of state, time and parameters come once, twice, ... _COUNT after.
_CLOSING, _NOTHING, _LEAVING, _PHASE, _VELOCITY, _COUNT = range(5, 11)
LEAVES = Gap((0, 1, 2, 3), 2, _LEAVING, is_constant=False)
SEPARATES = Gap((0, 1, 2, 3, 4), 3, 3, is_constant=False)
REBOUNDS = Gap((0, 1, 2), 1, _LEAVING, is_constant=False)
_IS_POSSIBLE = Gap((_CLOSING, _NOTHING, _NOTHING), 0, _CLOSING, is_constant=True)


class Flown(NamedTuple):
    """A state, and the launch after its impact; gamma: where impacts are not plastic."""

    phi: Number
    gamma: Number
    start: Launch

    def function(self, number: int, t: Number) -> Number:
        """Return a function at a time.

        At launch gap = 0, and gap' is side kick; for plastic impacts that is 0, and gap'' is the
        launch acceleration.
        """
        phi, gamma, start = self
        if number < _CLOSING:
            return gap(start, clock(start.eta, t), number)
        if number == _VELOCITY:
            return arrival(start, clock(start.eta, t))[1]
        if number == _PHASE:
            return phi + t
        if number == _CLOSING:
            return closing(start, gamma) * start.side
        if number == _LEAVING:
            return launch_acceleration(start) if start.kick is None else start.kick * start.side
        return t * 0


@dataclass(frozen=True)
class Equations:
    """The functions of state, time and parameters (eta, nu, and epsilon) that a map is made of."""

    name: str
    variables: tuple[str, ...]
    roots: tuple[int, ...]
    side: int
    ranges: Box
    circles: ClassVar = (Circle(0, 0, ("2*pi",)),)

    def periods(self, bits: int) -> dict[int, Enclosure]:
        """Enclose that of the phase."""
        return {0: pi(bits) * 2}

    def pinned(self) -> Self:
        """Return them at the middle of the ranges."""
        return replace(self, ranges=point_box(centre_of(self.ranges)))

    def derivative(self, root: int, place: int) -> int:
        """Return the number of a partial derivative."""
        return root + _COUNT * (1 + place)

    def launched(self, states: Sequence[Enclosure], parameters: Sequence[Enclosure]) -> Launched:
        """Return them for all of these states and parameters."""
        return Launched(self.side, states, parameters)


@dataclass
class Launched:
    """The functions at times, for all of some states and parameters."""

    side: int
    states: Sequence[Enclosure]
    parameters: Sequence[Enclosure]
    _flown: dict[int, Flown] = field(default_factory=dict)

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose some of them."""
        return [self._value(*divmod(root, _COUNT), t) for root in roots]

    def _value(self, by: int, number: int, t: Enclosure) -> Enclosure:
        """Enclose a function; for by > 0 its derivative, by a Dual in this place."""
        time = _moving(t) if by == len(self.states) + 1 else t
        if by not in self._flown:
            self._flown[by] = self._launch(by)
        value = self._flown[by].function(number, time)
        if isinstance(value, Dual):
            return value.derivative
        return t * 0 if by else value

    def _launch(self, by: int) -> Flown:
        inputs: list[Number] = [None, *self.states, None, *self.parameters]
        if inputs[by] is not None:
            inputs[by] = _moving(inputs[by])
        if len(self.states) == 1:
            _, phi, _, eta, nu = inputs
            return Flown(phi, None, launch(self.side, eta, nu, phi))
        _, phi, gamma, _, eta, nu, epsilon = inputs
        start = launch_with_restitution(self.side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
        return Flown(phi, gamma, start)


def _moving(x: Enclosure) -> Dual:
    return Dual(x, rational(Fraction(1), x.bits))


class PaperMap(ReturnMap):
    """A map of all oscillators of a place."""

    formulas: Equations

    @cached_property
    def at(self) -> Place:
        """The oscillators; Unproved where epsilon may be 1."""
        return Place(*self.ranges)

    def __eq__(self, other: object) -> bool:
        """Whether it is the same map, of the same oscillators."""
        return isinstance(other, PaperMap) and self.formulas == other.formulas

    def __hash__(self) -> int:
        return hash(self.formulas)


class Oscillator(PaperMap):
    """The map F with restitution: from the state before an impact to that before the next one.

    A state is (phi, gamma): the phase of an impact and the velocity v / (omega_n p) before it;
    phases are on the line. It is possible if the mass comes from above the table, gap' <= 0 before
    the impact: so F is defined where the closing speed is > 0, which is a second gap, the same at
    all times.
    """

    def __init__(self, sides: Box, latest: Fraction = LATEST) -> None:
        """Take ranges of eta > 0, of nu, of one sign, and of epsilon from 0 to 1."""
        roots, side = (0, _CLOSING, _PHASE, _VELOCITY), 1 if sides[1][0] > 0 else -1
        equations = Equations("F", ("phi", "gamma"), roots, side, sides)
        super().__init__(equations, 2, (REBOUNDS, _IS_POSSIBLE), latest=latest)

    @property
    def definition(self) -> str:
        """What it is; no function of a file, though one may have its name."""
        return f"`{self.name}`, from an impact to the next one at {self.at}"

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative by `return_map_derivative`, in which terms cancel.

        What follows from the equations alone is up to four times as wide: with it 5 of 47 stable
        orbits of claim G16 are proved.
        """
        impact, (phi, gamma) = self._impact(x), x
        eta, nu, epsilon = impact.launches.parameters
        start = launch_with_restitution(
            self.formulas.side, eta, nu, phi, epsilon=epsilon, gamma=gamma
        )
        now = clock(eta, impact.time)
        return [list(row) for row in return_map_derivative(start, now, epsilon)]


class PlasticMap(PaperMap):
    """The plastic impact map f: from the phase of an impact to that of the next, on a circle."""

    smooth: ClassVar = ", all first impacts from there being transversal"
    of_orbits: ClassVar = (
        "; all its impacts are transversal, and after each the mass leaves the table at once"
    )

    def __init__(self, at: Place, latest: Fraction = LATEST, leaves: Gap = LEAVES) -> None:
        """Take the oscillators; leaves: the gap, with the order by which flights leave the table.

        `SEPARATES`: of launches where the acceleration is >= 0 and increases with the phase, as it
        does with the time.
        """
        equations = Equations("f", ("phi",), (0, _PHASE), at.side, at.sides[:2])
        super().__init__(equations, 1, (leaves,), latest=latest)

    @property
    def definition(self) -> str:
        """What it is; no function of a file, though one may be called so."""
        return f"f at {self.at}"

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose f' by `slope`."""
        impact = self._impact(x)
        eta, nu = impact.launches.parameters
        start = launch(self.formulas.side, eta, nu, x[0])
        return [[slope(start, clock(eta, impact.time), impact.fall)]]

    def landing(self, x: Sequence[Enclosure]) -> Impact:
        """Enclose when flights end, and gap_t then."""
        return self._impact(x)

    def window(self, x: Sequence[Enclosure]) -> Range:
        """Return times low < high: gap > 0 on (0, low], gap_t < 0 between, gap < 0 at the end."""
        return FirstZero(self._launches(x), self.gaps[0]).window(self.latest)

    def bend(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose f'': the derivative of the slope along (phi + s, t + (f' - 1) s)."""
        impact, (phi,) = self._impact(x), x
        (eta, nu), time, down = impact.launches.parameters, impact.time, impact.fall
        start, moving = (launch(self.formulas.side, eta, nu, each) for each in (phi, _moving(phi)))
        now = clock(eta, time)
        faster = slope(start, now, down) - 1
        change = gap(moving, now, 1).derivative + gap(start, now, 2) * faster
        later = clock(eta, Dual(time, faster))
        bent: Dual = slope(moving, later, Dual(down, change))
        return bent.derivative


def read_oscillator(reader: Reader) -> PaperMap:
    """Read {eta, nu, epsilon}, ranges, or without epsilon, for plastic impacts."""
    more = ("epsilon",) if reader.has("epsilon") else ()
    place = Place(*(side.range() for side in reader.fields("eta", "nu", *more)))
    return Oscillator(place.sides) if more else PlasticMap(place)
