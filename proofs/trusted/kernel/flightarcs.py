"""Rule: curves of flights over a variable, that end transversally, or in a graze."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arcs import Arc, an_arc
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import PRECISIONS, add, centre_of, enclosed
from proofs.trusted.kernel.firstzero import FirstZero, shown
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.returns import LATEST, Launches
from proofs.trusted.kernel.zeros import Piece
from proofs.trusted.numbers import Range, show_range

_BITS = PRECISIONS[0]


def timed(flight: Flight) -> Formulas:
    """Return (G, g) as a function of the state and the time, G the values, g the first gap."""
    formulas, trees = flight.formulas, (*flight.trees, flight.walls[0])
    roots = (*flight.outcome, flight.gaps[0].orders[0])
    own = formulas.variables[: flight.state + 1]  # without parameters that have ranges
    return replace(formulas, variables=own, trees=trees, roots=roots)


def ends_in_a_graze(flight: Flight) -> bool:
    """Whether the last value is the derivative of the first gap by the time, which then is 0."""
    return flight.outcome[-1] == flight.gaps[0].orders[1]


@dataclass(frozen=True)
class FlightArc(Conclusion):
    """Along an arc of zeros of `timed` each flight has its first impact at the arc's time.

    There G = 0; it is a graze if the last value is the speed, and transversal if not.
    """

    function: Flight
    arc: Arc

    @property
    def ends(self) -> Range:
        """Return the values of the axis between which it goes."""
        return self.arc.ends

    @property
    def sentence(self) -> str:
        flight, arc, t = self.function, self.arc, self.function.time
        gap, axis = flight.walls[0], flight.variables[arc.axis]
        others = ", ".join(f"`{name}`" for name in flight.variables if name != axis)
        kind = f"transversal: `D({gap}, {t})` < 0"
        if ends_in_a_graze(flight):
            kind = f"a graze: `D({gap}, {t})` = 0 < `D({gap}, {t}, {t})`"
        return (
            f"for {flight.definition}: {arc.path}, there is for each `{axis}` in "
            f"{show_range(self.ends)} exactly one flight with `{flight.name}` = 0 and `{gap}` = 0 "
            f"at `{t}`. This is its first impact, {kind}; {others} and `{t}` are a smooth "
            f"function of `{axis}`{arc.passed}."
        )


def flight_arc(context: Context, reader: Reader) -> FlightArc:
    """Rule `flight-arc`: {flight function G, axis, pieces, points, starts}.

    G has one value less than variables, of which the axis is one, by its name; g is the gap of the
    impact. Pieces and points are those of an arc over it of zeros (x, t) of (G, g), see `an_arc`;
    starts: a time s > 0 for each piece. Hypotheses for each piece, with the times up to e in it,
    and all launches x from it: s < t; g > 0 on (0, s], other gaps are > 0 on (0, e]; on [s, e] g_t
    < 0; or, if the last value is g_t, g_tt > 0. Conclusion: `FlightArc`.

    Proof. At a zero (x, t) g = 0, and if g_t = 0 too, g > 0 on [s, t) by Taylor's formula at t; so
    it is if g falls: t is the time of the first impact, at which G = 0.
    """
    function_of, axis_of, pieces_of, points_of, starts_of = reader.fields(
        "function", "axis", "pieces", "points", "starts"
    )
    flight = context.function(function_of)
    if not isinstance(flight, Flight) or flight.circles or flight.size + 1 != flight.state:
        raise function_of.fail("a flight with one value less than variables, no angles, expected")
    if axis_of.string() not in flight.variables:
        raise axis_of.fail("a variable of the function is expected")
    axis = flight.variables.index(axis_of.string())
    arc = an_arc(timed(flight), axis, pieces_of, points_of)
    count = len(arc.pieces)
    for piece, start in zip(arc.pieces, starts_of.numbers(count, count), strict=True):
        require_first(flight, axis, piece, start)
    return FlightArc(flight, arc)


def require_first(flight: Flight, axis: int, piece: Piece, start: Fraction) -> None:
    """Raise Unproved unless the hypotheses of `flight-arc` about a piece hold."""
    low, end = piece.hull(axis)[-1]
    if not 0 < start < low < end <= LATEST:
        raise Unproved("a start is not between 0 and the times of its piece")
    launches, (gap, *others) = Slanted(flight, axis, piece), flight.gaps
    fall, bend = launches.on(gap.orders[1:3], Enclosure.of(start, end, _BITS))
    if bend.lo <= 0 if ends_in_a_graze(flight) else fall.hi >= 0:
        raise Unproved(f"the gap is not proved to end so, {shown(launches.states)}")
    FirstZero(launches, gap).require_none(start)
    for other in others:
        FirstZero(launches, other).require_none(end)


class Slanted:
    """All flights from the states of a piece.

    What is enclosed for a box around it is so too by what it is at the middle m of the axis, and by
    the derivative along the slanted sides times x - m (mean value theorem).
    """

    def __init__(self, flight: Flight, axis: int, piece: Piece) -> None:
        self._flight, n = flight, flight.state
        box, hull, middle = piece.box[:n], piece.hull(axis)[:n], centre_of(piece.box)[axis]
        thin = (*box[:axis], (middle, middle), *box[axis + 1 :])
        ranges = enclosed(flight.ranges, _BITS)
        self._whole, self._still = (
            Launches(flight, enclosed(each, _BITS), ranges) for each in (hull, thin)
        )
        rates = ((k, Fraction(1) if k == axis else piece.slope[k]) for k in range(n))
        self._rates = [(k, rational(rate, _BITS)) for k, rate in rates if rate]
        self._step = self.states[axis] - rational(middle, _BITS)

    @property
    def states(self) -> Sequence[Enclosure]:
        """The box around them."""
        return self._whole.states

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose formulas at times."""
        places, own = [k for k, _ in self._rates], [rate for _, rate in self._rates]
        slopes = [each for root in roots for each in self._flight.slopes(root, places)[:-1]]
        values = self._whole.on((*roots, *slopes), t)
        direct, rows, n = values[: len(roots)], values[len(roots) :], len(places)
        still, nothing = self._still.on(roots, t), rational(Fraction(0), _BITS)
        along = [add(nothing, rows[k * n : (k + 1) * n], own) for k in range(len(roots))]
        return [a.meet(b + c * self._step) for a, b, c in zip(direct, still, along, strict=True)]
