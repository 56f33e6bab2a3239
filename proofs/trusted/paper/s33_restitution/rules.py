"""Rules about impacts with restitution, for boxes of oscillators and of states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import (
    Launch,
    arrival,
    clock,
    closing,
    gap,
    launch_with_restitution,
    return_map_derivative,
)
from proofs.trusted.flights import (
    COVER_BITS,
    MAX_BITS,
    brackets,
    first_windows,
    lifted,
    read_phases,
    read_times,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.rebounds import (
    BarredWord,
    Rebound,
    Rectangle,
    Unjoined,
    barred,
)
from proofs.trusted.paper.s33_restitution.rebounds import rectangle as join

_ZERO = Fraction(0)
_JOINING = 200  # what joining steps costs, and deciding by them, in evaluations of the gap


@dataclass(frozen=True)
class _Flights:
    """All flights of a box: their launches, and the constants of their equations."""

    start: Launch
    epsilon: Enclosure
    closing_speed: Enclosure

    def gap(self, time: Range, order: int = 0) -> Enclosure:
        """Enclose a time derivative of the gap."""
        eta: Enclosure = self.start.eta
        value: Enclosure = gap(self.start, clock(eta, Enclosure.of(*time, eta.bits)), order)
        return value


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
    eta, nu, epsilon = (part.range() for part in box_of[:3])
    if eta[0] <= 0 or nu[0] <= 0 <= nu[1] or not 0 <= epsilon[0] <= epsilon[1] <= 1:
        raise reader.fail("the model has eta > 0, nu != 0 and epsilon in [0, 1]")
    phases, velocities, impact = read_phases(box_of[3]), box_of[4].range(), impact_of.range()
    times = read_times(times_of)
    shortest = min(now - before for before, now in pairwise((_ZERO, *times)))
    narrowest = impact[1] - impact[0]
    if narrowest == 0:
        raise Unproved("an empty bracket")
    bits = COVER_BITS + 2 * (1 / min(shortest, narrowest)).__ceil__().bit_length()
    bits = min(MAX_BITS, bits)
    flights = _flights((eta, nu, epsilon, phases, velocities), bits)
    if flights.closing_speed.lo < 0:
        raise Unproved("the states are not proved possible: the mass would come from the table")
    windows, transversal = first_windows(flights.gap, times, 2, 1)
    if not transversal:
        raise Unproved("the first impact is not transversal")
    window = windows[0]
    if not window[0] <= impact[0] < impact[1] <= window[1]:
        raise Unproved("the bracket leaves the window of the first impact")
    if not brackets(flights.gap, impact):
        raise Unproved("the bracket does not have the signs +, - at its ends")
    now = clock(flights.start.eta, Enclosure.of(*impact, bits))
    (p, q), (r, s) = return_map_derivative(flights.start, now, flights.epsilon)
    turns, phase = _after(phases, impact, bits)
    velocity: Enclosure = arrival(flights.start, now)[1]
    derivative = ((p.range, q.range), (r.range, s.range))
    box = (eta, nu, epsilon)
    return Rebound(box, phases, velocities, turns, phase, velocity.range, derivative)


def _flights(box: Sequence[Range], bits: int) -> _Flights:
    """Return the flights of a box (eta, nu, epsilon, phases, velocities)."""
    eta, nu, epsilon, phi, gamma = (Enclosure.of(*part, bits) for part in box)
    side = 1 if nu.lo > 0 else -1
    start = launch_with_restitution(side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
    return _Flights(start, epsilon, side * closing(start, gamma))


def _after(phases: Range, time: Range, bits: int) -> tuple[int, Range]:
    """Return a count and phases + time less 2 pi times it, the lower end about in [0, 2 pi)."""
    total = phases[0] + time[0], phases[1] + time[1]
    count = total[0] // whole_turns(1, bits)[0]
    return count, lifted(total, -count, bits)


def _rebounds(context: Context, names: Reader) -> list[Rebound]:
    return [context.step(name, Rebound) for name in names.items(least=1)]


def rectangle(context: Context, reader: Reader) -> Rectangle:
    """Rule `rectangle`: {impacts, eta, nu, epsilon, phases, velocities}: rebound steps that join.

    Hypotheses, conclusion and proof: `rebounds.rectangle`.
    """
    impacts, *box_of = reader.fields("impacts", "eta", "nu", "epsilon", "phases", "velocities")
    eta, nu, epsilon, phases, velocities = (part.range() for part in box_of)
    try:
        return join(_rebounds(context, impacts), (eta, nu, epsilon), phases, velocities)
    except Unjoined as failure:
        raise Unproved(str(failure)) from None


def barred_word(context: Context, reader: Reader) -> BarredWord:
    """Rule `barred-word`: {impacts, rectangles: two names, word of 0 and 1, bounds, from}.

    from: "above" or "below". Hypotheses, conclusion and proof: `rebounds.barred`.
    """
    impacts, names, word_of, bounds, side = reader.fields(
        "impacts", "rectangles", "word", "bounds", "from"
    )
    if side.string() not in ("above", "below"):
        raise side.fail("above or below")
    sign = 1 if side.string() == "above" else -1
    pair = [context.step(name, Rectangle) for name in names.items(2, 2)]
    word = word_of.string()
    if not set(word) <= {"0", "1"}:
        raise word_of.fail("a word is written in 0 and 1")
    parts, symbols = _rebounds(context, impacts), tuple(map(int, word))
    try:
        return barred(parts, (pair[0], pair[1]), symbols, bounds.numbers(), sign)
    except Unjoined as failure:
        raise Unproved(str(failure)) from None
