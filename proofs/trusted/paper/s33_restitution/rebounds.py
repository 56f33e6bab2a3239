"""Section 3.3: impacts with restitution, the map F on boxes of states, for boxes of oscillators.

A state is (phi, gamma): phase and velocity v / (omega_n p) before an impact. F takes it to the
state before the next impact; its phase is taken on the line, less a fixed number of turns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import (
    arrival,
    clock,
    closing,
    gap,
    launch_with_restitution,
    return_map_derivative,
)
from proofs.trusted.flights import (
    COVER_BITS,
    LATEST,
    MAX_BITS,
    Gap,
    bits_for,
    falls,
    open_windows,
    read_phases,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Phases, Range, ceil_text, floor_text, hull, show_range, within
from proofs.trusted.parameters import Place

Entries = tuple[tuple[Range, Range], tuple[Range, Range]]  # DF: rows (phase, velocity)
_ZERO = Fraction(0)


def size(values: Range) -> Fraction:
    """Return the largest absolute value in a range."""
    return max(abs(values[0]), abs(values[1]))


def restitution(at: Place) -> Range:
    """Return the range of epsilon."""
    return at.epsilon or (_ZERO, _ZERO)


def outward(values: Range, places: int = 6) -> str:
    """Write an enclosure, rounded outward."""
    return f"[{floor_text(values[0], places)}, {ceil_text(values[1], places)}]"


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
        """Return the statement."""
        return (
            f"all states of {show_range(self.phases)} x {show_range(self.velocities)} (phases x "
            "velocities before an impact) are physically possible (gap' <= 0), and F is smooth on "
            f"them, with values in {outward(self.phase)} (less {self.turns} turns) x "
            f"{outward(self.velocity)}."
        )


@dataclass(frozen=True)
class RectangleMap(Conclusion):
    """All states of the rectangle phases x velocities are possible, and F is smooth on it.

    Phases of images are less `turns` turns. left, right: enclosures of those of the left and of
    the right edge; velocity: of all image velocities; derivative: of DF.
    """

    at: Place
    phases: Phases
    velocities: Range
    turns: int
    left: Range
    right: Range
    velocity: Range
    derivative: Entries

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"all states of {show_range(self.phases)} x {show_range(self.velocities)} are "
            "physically possible (gap' <= 0), and F is smooth there: it maps the left edge to "
            f"phases in {outward(self.left)}, the right one in {outward(self.right)} (less "
            f"{self.turns} turns), all to velocities in {outward(self.velocity)}."
        )


# -- the rules -------------------------------------------------------------------------------------


def rebound(context: Context, reader: Reader) -> Rebound:
    """Rule `rebound`: {eta, nu, epsilon, phases, velocities, times 0 < t_1 < ... < t_n, impact}.

    The first five are ranges: a box of oscillators, and of states (phi, gamma) before an impact,
    gamma = v / (omega_n p). Hypotheses, for all of them: closing speed -gap' >= 0 before the
    impact; gap'' > 0 on [0, t_1], or gap' > 0 there; gap < 0 at t_n. A piece [t_j, t_(j+1)] of
    width w is closed if min(gap(t_j), gap(t_(j+1))) > w^2/8 max(0, sup gap'') on it; the open
    pieces are one interval that ends at t_n, with gap' < 0 on it. `impact` lies in it, gap > 0
    at its lower and gap < 0 at its upper end.

    Conclusion: each state is physically possible and has its first impact after a time of flight
    in `impact`; it depends smoothly on state and parameters; F and DF are enclosed.
    Proof. At launch gap = 0 and gap' = epsilon (closing speed) >= 0, so gap > 0 on (0, t_1]; on
    closed pieces by the error of linear interpolation. In the open interval gap falls through its
    only zero. Then (15), the implicit function theorem, and `return_map_derivative`.
    """
    *box_of, times_of, impact_of = reader.fields(
        "eta", "nu", "epsilon", "phases", "velocities", "times", "impact"
    )
    at = Place(*(part.range() for part in box_of[:3]))
    phases, velocities, impact = read_phases(box_of[3]), box_of[4].range(), impact_of.range()
    times = times_of.numbers(least=2)
    if times[-1] > LATEST or any(now <= before for before, now in pairwise((_ZERO, *times))):
        raise times_of.fail(f"times must increase from 0, to at most {LATEST}")
    shortest = min(now - before for before, now in pairwise((_ZERO, *times)))
    bits = max(bits_for(impact), COVER_BITS + 2 * (1 / shortest).__ceil__().bit_length())
    sides = (at.eta, at.nu, restitution(at), phases, velocities)
    eta, nu, epsilon, phi, gamma = (Enclosure.of(*part, min(MAX_BITS, bits)) for part in sides)
    side = 1 if at.nu[0] > 0 else -1
    start = launch_with_restitution(side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    if (side * closing(start, gamma)).lo < 0:
        raise Unproved("the states are not proved possible: the mass would come from the table")

    def gap_of(time: Range, order: int) -> Enclosure:
        value: Enclosure = gap(start, clock(eta, Enclosure.of(*time, eta.bits)), order)
        return value

    _bracket(gap_of, times, impact)
    now = clock(eta, Enclosure.of(*impact, eta.bits))
    (p, q), (r, s) = return_map_derivative(start, now, epsilon)
    turns = (phases[0] + impact[0]) // whole_turns(1, eta.bits)[0]
    low, high = whole_turns(turns, eta.bits)
    return Rebound(
        at,
        phases,
        velocities,
        turns,
        (phases[0] + impact[0] - high, phases[1] + impact[1] - low),
        arrival(start, now)[1].range,
        ((p.range, q.range), (r.range, s.range)),
    )


def _bracket(gap_of: Gap, times: Sequence[Fraction], impact: Range) -> None:
    """Raise Unproved unless all first impacts are proved to be transversal and in `impact`."""
    first = (_ZERO, times[0])
    if gap_of(first, 2).lo <= 0 and gap_of(first, 1).lo <= 0:
        raise Unproved("the flights are not proved to leave the table")
    windows = open_windows(gap_of, times)
    if len(windows) != 1 or windows[0][1] != times[-1] or not falls(gap_of, windows[0]):
        raise Unproved("the first impact is not transversal")
    if not within(impact, windows[0]):
        raise Unproved("the bracket leaves the window of the first impact")
    low, high = (gap_of((time, time), 0) for time in impact)
    if not low.lo > 0 > high.hi:
        raise Unproved("the bracket does not have the signs +, - at its ends")


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
    return RectangleMap(
        left.at,
        Phases(low, high),
        left.velocities,
        left.turns,
        left.phase,
        right.phase,
        hull([part.velocity for part in parts]),
        ((p, q), (r, s)),
    )
