"""Section 3.3: impacts with restitution, the map F on boxes of states, for boxes of oscillators.

A state is (phi, gamma): phase and velocity v / (omega_n p) before an impact. F takes it to the
state before the next impact; its phase is taken on the line, less a fixed number of turns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import (
    Launch,
    arrival,
    clock,
    closing,
    flight_derivative,
    gap,
    launch,
    launch_with_restitution,
    return_map_derivative,
)
from proofs.trusted.flights import (
    bits_for,
    bits_for_pieces,
    lifted,
    read_phases,
    read_times,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.gaps import brackets, first_windows
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Phases, Range, between, common, hull, show_range, within
from proofs.trusted.parameters import Place

Entries = tuple[tuple[Range, Range], tuple[Range, Range]]  # DF: rows (phase, velocity)


def size(values: Range) -> Fraction:
    """Return the largest absolute value in a range."""
    return max(abs(values[0]), abs(values[1]))


@dataclass(frozen=True)
class Rebound(Conclusion):
    """All states in phases x velocities are possible, and F is smooth in state and parameters.

    `phase`, less `turns` turns, and `velocity` enclose F, `derivative` its derivative DF.
    """

    at: Place
    phases: Range
    velocities: Range
    turns: int
    phase: Range
    velocity: Range
    derivative: Entries

    @property
    def sentence(self) -> str:
        return (
            f"all states of {show_range(self.phases)} x {show_range(self.velocities)} (phases x "
            "velocities before an impact) are physically possible (gap' <= 0), and F is smooth on "
            f"them, with values in {between(self.phase)} (less {self.turns} turns) x "
            f"{between(self.velocity)}."
        )


@dataclass(frozen=True)
class RectangleMap(Rebound):
    """F on a whole rectangle: its left and right edges have images at phases in `left`, `right`.

    parts: F on parts that cover it, each with all its velocities.
    """

    phases: Phases
    left: Range
    right: Range
    parts: tuple[Rebound, ...]

    @property
    def sign(self) -> int:
        """1 where the next phase is proved to increase with the phase, -1 where it decreases."""
        least, most = self.derivative[0][0]
        if least <= 0 <= most:
            raise Unproved("the next phase is not proved to be monotone in the phase")
        return 1 if least > 0 else -1

    @property
    def reach(self) -> tuple[Range, Range]:
        """The images of the edge with the lesser ones, and of that with the greater ones."""
        return (self.left, self.right) if self.sign > 0 else (self.right, self.left)

    @property
    def sentence(self) -> str:
        left, right = between(self.left), between(self.right)
        return f"{super().sentence} The left edge goes to phases in {left}, the right to {right}."


def rebound(context: Context, reader: Reader) -> Rebound:
    """Rule `rebound`: {eta, nu, epsilon, phases, velocities, times 0 < t_1 < ... < t_n, impact}.

    The first five are ranges: a box of oscillators, and of states (phi, gamma) before an impact,
    gamma = v / (omega_n p). Hypotheses, for all of them: closing speed -gap' >= 0 before the
    impact; gap'' > 0 on [0, t_1], or gap' > 0 there; gap < 0 at t_n. A piece [t_j, t_(j+1)] of
    width w is closed if min(gap(t_j), gap(t_(j+1))) > w^2/8 max(0, sup gap'') on it; the open
    pieces are one interval that ends at t_n, with gap' < 0 on it. `impact` lies in it, gap > 0
    at its lower and gap < 0 at its upper end.

    Conclusion: each state is physically possible and has its first impact after a time of flight
    in `impact`; it depends smoothly on state and parameters; F and DF are enclosed, F directly and
    by `_centred`.
    Proof. At launch gap = 0 and gap' = epsilon (closing speed) >= 0, so gap > 0 on (0, t_1]; on
    closed pieces by the error of linear interpolation. In the open interval gap falls through its
    only zero. Then (15), the implicit function theorem, and `return_map_derivative`.
    """
    *box_of, phases_of, velocities_of, times_of, impact_of = reader.fields(
        "eta", "nu", "epsilon", "phases", "velocities", "times", "impact"
    )
    at, times = Place(*(side.range() for side in box_of)), read_times(times_of)
    phases, velocities = read_phases(phases_of), velocities_of.range()
    found = next_states(at.sides, (phases, velocities), times, impact_of.range())
    return Rebound(at, phases, velocities, *found)


def next_states(
    sides: tuple[Range, Range, Range],
    states: tuple[Range, Range],
    times: Sequence[Fraction],
    impact: Range,
) -> tuple[int, Range, Range, Entries]:
    """Return turns, phase, velocity and derivative as rule `rebound` concludes them.

    sides: the ranges of eta > 0, of nu, which has one sign, and of epsilon >= 0.
    """
    (phases, velocities), side = states, 1 if sides[1][0] > 0 else -1
    bits = max(bits_for(impact), bits_for_pieces(times))
    eta, nu, epsilon, phi, gamma = (
        Enclosure.of(*values, bits) for values in (*sides, phases, velocities)
    )
    start = launch_with_restitution(side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    if (side * closing(start, gamma)).lo < 0:
        raise Unproved("the states are not proved possible: the mass would come from the table")

    def gap_of(time: Range, order: int) -> Enclosure:
        value: Enclosure = gap(start, clock(eta, Enclosure.of(*time, bits)), order)
        return value

    windows, transversal = first_windows(gap_of, times, 2, 1)
    if not transversal:
        raise Unproved("the first impact is not transversal")
    if not within(impact, windows[0]):
        raise Unproved("the bracket leaves the window of the first impact")
    if not brackets(gap_of, impact):
        raise Unproved("the bracket does not have the signs +, - at its ends")
    now = clock(eta, Enclosure.of(*impact, bits))
    falling = gap(start, now, 1)
    (p, q), (r, s) = return_map_derivative(start, now, epsilon, falling)
    early, late = phases[0] + impact[0], phases[1] + impact[1]
    turns = early // whole_turns(1, bits)[0]
    kick, direct = epsilon * closing(start, gamma), arrival(start, now)[1].range
    on_line, moved = _centred(start, nu, (phases, kick), impact, falling)
    phase = lifted(common((early, late), on_line), -turns, bits)
    derivative = (p.range, q.range), (r.range, s.range)
    return turns, phase, common(direct, moved), derivative


def _centred(
    start: Launch, nu: Enclosure, box: tuple[Range, Enclosure], impact: Range, fall: Enclosure
) -> tuple[Range, Range]:
    """Enclose phases, on the line, and velocities at the impacts of all flights from `start`.

    By the mean value theorem in (phi, kick), from the flight in their middle. Its time of flight,
    too: gap(t) = gap'(xi) (t - time), so time = t - gap(t) / gap'(xi), t the middle of what
    encloses it; twice. Hypothesis: the first impact of all launches in the box, phases x kicks, in
    which `start` encloses the two apart, is transversal, at a time in `impact`, gap' in `fall`.
    """
    (phases, kick), eta, bits = box, start.eta, fall.bits
    now = clock(eta, Enclosure.of(*impact, bits))
    centre, pushed = (_middle(ends, bits) for ends in (phases, kick.range))
    middle = launch(start.side, eta, nu, centre)._replace(kick=pushed)
    time = impact
    for _ in range(2):
        guess = _middle(time, bits)
        time = common(time, (guess - gap(middle, clock(eta, guess)) / fall).range)
    arrived = Enclosure.of(*time, bits)
    values = centre + arrived, arrival(middle, clock(eta, arrived))[1]
    aside = Enclosure.of(*phases, bits) - centre, kick - pushed
    phase, velocity = (
        (value + row[0] * aside[0] + row[1] * aside[1]).range
        for value, row in zip(values, flight_derivative(start, now, fall), strict=True)
    )
    return phase, velocity


def _middle(values: Range, bits: int) -> Enclosure:
    """Enclose the middle of a range."""
    middle = (values[0] + values[1]) / 2
    return Enclosure.of(middle, middle, bits)


def rectangle(context: Context, reader: Reader) -> RectangleMap:
    """Rule `rectangle`: {parts: names of rebound steps, edges: names of two, left and right}.

    Hypotheses: all are about the same oscillators and velocities, and take the same number of turns
    off; the edges are about one phase each, and the parts reach from that of the left one to that
    of the right one, each beginning not beyond the end of the one before.
    Conclusion: what F does on the rectangle between the edges.
    Proof. 1. Where two parts meet the first impact is the same, so F is one map on all of them,
    smooth as each part is, its phase continuous, since all take the same number of turns off.
    2. Values and derivatives lie in the hulls of those of the parts; those of an edge in its own.
    """
    parts_of, edges_of = reader.fields("parts", "edges")
    parts = [context.step(name, Rebound) for name in parts_of.items(least=1)]
    left, right = (context.step(name, Rebound) for name in edges_of.items(2, 2))
    METER.get().spend(10 * len(parts))
    low, high = left.phases[0], right.phases[0]
    if (left.phases, right.phases) != ((low, low), (high, high)):
        raise Unproved("an edge is about one phase")
    reach = low
    for part in (*parts, right):
        if (part.at, part.velocities, part.turns) != (left.at, left.velocities, left.turns):
            raise Unproved("steps are about other oscillators, velocities or turns")
        if part.phases[0] > reach:
            raise Unproved("the steps do not cover the rectangle")
        reach = part.phases[1]
    (p, q), (r, s) = (
        [hull([part.derivative[row][column] for part in parts]) for column in (0, 1)]
        for row in (0, 1)
    )
    image = hull([part.phase for part in parts]), hull([part.velocity for part in parts])
    states = Phases(low, high), left.velocities
    return RectangleMap(
        left.at,
        *states,
        left.turns,
        *image,
        ((p, q), (r, s)),
        left.phase,
        right.phase,
        tuple(parts),
    )
