"""Phases cut until the first impact of every part is seen, each part at its precision."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from intervals.cover import PartsExhausted, cover
from intervals.errors import Undecided
from proofs.motion.witness import (
    BLIND,
    HORIZON,
    FlightBox,
    NoImpact,
    Seen,
    Sticks,
    Unsettled,
    locate,
    march,
    name_of,
    up_to,
)
from proofs.trusted.numbers import COVER_BITS, Range

_MOST_HALVINGS = 128  # of a time step: thinner sets of phases are as good as one phase
_AGAIN = 16  # of the finest steps to a window: they may be longer for some of the launches


class _Part(NamedTuple):
    """Flights, how often they were cut, at which precision they are asked, what is excluded."""

    flights: FlightBox
    cuts: int
    bits: int
    excluded: Sequence[Fraction] = ()


def cover_by(
    flights: FlightBox,
    accept: Callable[[Seen], bool] = lambda covered: covered.transversal,
    *,
    obstacle: str = "grazing",
    horizon: Fraction = HORIZON,
    limit: int = 200,
) -> list[Seen]:
    """Cut phases until `accept` takes the first impact of every part, each at its precision.

    After two cuts, and every four more, a part that is not taken is asked again at the precision
    that its middle launch needs; else its width is to blame and it is cut.
    Undecided names a phase near which nothing helps, `obstacle` being the likely reason; a part
    without impact up to the horizon is cut four times before that is taken for an answer.
    """
    excluded: dict[Range, list[Fraction]] = {}

    def decide(part: _Part) -> Seen | None:
        phases = part.flights.phases
        most, failure = 16, Undecided(f"{obstacle} near phase {float(phases[0]):.9g}")
        try:
            finest = steps_for(phases)
            seen = march(part.flights, part.bits, horizon, finest, part.excluded)
            if accept(seen):
                return seen
            excluded[phases] = seen.excluded
        except Sticks:
            raise
        except NoImpact as error:
            most, failure = 4, error
        except Unsettled as error:
            most, failure = (1 if error.hopeless else 4), error
            excluded[phases] = error.excluded
        except (Undecided, *BLIND) as error:
            failure = Undecided(str(error))
        if part.cuts >= most:
            raise failure
        return None

    def split(part: _Part) -> list[_Part]:
        phases = part.flights.phases
        if part.cuts % 4 == 2:
            needed = bits_needed(part.flights, horizon)
            if needed > part.bits:
                return [part._replace(bits=needed)]
        times = excluded.pop(phases, part.excluded)
        kept = up_to(times[-1] - _AGAIN * steps_for(phases), times) if times else ()
        return [
            _Part(replace(part.flights, phases=half), part.cuts + 1, part.bits, kept)
            for half in halves(phases)
        ]

    first = _Part(flights, 0, COVER_BITS)
    try:
        return [covered for _, covered in cover([first], decide, split, limit=limit)]
    except PartsExhausted:
        raise Undecided(f"{limit} parts of {name_of(flights.phases)} do not suffice") from None


def bits_needed(flights: FlightBox, horizon: Fraction = HORIZON) -> int:
    """Return the bits at which the middle one of the launches is decided, the least if none."""
    middle = sum(flights.phases, Fraction(0)) / 2
    try:
        launch = replace(flights, phases=(middle, middle))
        return locate(launch, horizon=horizon).bits
    except Undecided:
        return COVER_BITS


def steps_for(phases: Range) -> Fraction:
    """Return a finest time step that suits the width w of the phases: about sqrt(w) / 8.

    At a distance w from a grazing phase the gap dips below 0 for a time of the order sqrt(w).
    """
    halvings = (1 / (phases[1] - phases[0])).__ceil__().bit_length() // 2
    return Fraction(1, 1 << (3 + min(halvings, _MOST_HALVINGS)))


def halves(part: Range) -> tuple[Range, Range]:
    """Cut an interval in the middle."""
    middle = (part[0] + part[1]) / 2
    return (part[0], middle), (middle, part[1])
