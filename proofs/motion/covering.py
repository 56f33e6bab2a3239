"""Phases cut until the first impact of every part is decided, each part at its precision."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import NamedTuple

from intervals.cover import PartsExhausted, cover
from intervals.errors import Undecided
from proofs.motion.flight import Flight, Numbers, interval
from proofs.motion.impact import (
    HORIZON,
    LEAST,
    FirstImpact,
    NoImpact,
    Sticks,
    Unsettled,
    first_impact,
    locate,
    march,
    name_of,
    up_to,
)
from proofs.motion.system import System
from proofs.trusted.numbers import Range

_MOST_HALVINGS = 128  # of a time step: thinner sets of phases are as good as one phase
_AGAIN = 16  # of the finest steps to a window: they may be longer for some of the launches


def cover_by_impacts(
    system: System,
    phases: Range,
    *,
    horizon: Fraction = HORIZON,
    limit: int = 200,
    numbers: Numbers = interval,
) -> list[FirstImpact]:
    """Cut `phases` until the first impact is transversal on every part; Undecided if it is not."""
    return cover_by(
        system,
        phases,
        lambda found: found.transversal,
        obstacle="grazing",
        horizon=horizon,
        limit=limit,
        numbers=numbers,
    )


class _Part(NamedTuple):
    """Launch phases, how often they were cut, and the precision at which they are asked.

    known: times as `march` takes them, or none: what is excluded for all is so for some.
    """

    phases: Range
    cuts: int = 0
    precision: int = LEAST
    known: tuple[Fraction, ...] = ()


def cover_by(
    system: System,
    phases: Range,
    accept: Callable[[FirstImpact], bool],
    *,
    obstacle: str,
    horizon: Fraction = HORIZON,
    limit: int = 400,
    numbers: Numbers = interval,
) -> list[FirstImpact]:
    """Cut `phases` until `accept` takes the first impact of every part, each at its precision.

    After two cuts, and every four more, a part that is not taken is asked again at the precision
    that its middle launch needs; else its width is to blame and it is cut. Undecided names a
    phase near which nothing helps, `obstacle` being the likely reason; a part without impact up
    to the horizon is cut four times before that is taken for an answer.
    """

    excluded: dict[Range, list[Fraction]] = {}

    def decide(part: _Part) -> FirstImpact | None:
        low = part.phases[0]
        most, failure = 16, Undecided(f"{obstacle} near phase {float(low):.9g}")
        try:
            flight = Flight(system, part.phases, part.precision, numbers=numbers)
            finest = steps_for(part.phases)
            if len(part.known) > 1:
                found = march(flight, part.known, horizon, finest)
            else:
                found = first_impact(flight, horizon, finest)
            if accept(found):
                return found
            excluded[part.phases] = found.known
        except Sticks:
            raise
        except NoImpact as error:
            most, failure = 4, error
        except Unsettled as error:
            most, failure, excluded[part.phases] = (1 if error.hopeless else 4), error, error.known
        except Undecided as error:
            failure = error
        if part.cuts >= most:
            raise failure
        return None

    def split(part: _Part) -> Iterable[_Part]:
        if part.cuts % 4 == 2 and numbers is interval:
            needed = precision_for(system, part.phases, horizon)
            if needed > part.precision:
                return [part._replace(precision=needed)]
        known = tuple(excluded.pop(part.phases, part.known))
        if known:
            known = tuple(up_to(known[-1] - _AGAIN * steps_for(part.phases), known))
        return [_Part(x, part.cuts + 1, part.precision, known) for x in halves(part.phases)]

    try:
        return [found for _, found in cover([_Part(phases)], decide, split, limit=limit)]
    except PartsExhausted:
        raise Undecided(f"{limit} parts of {name_of(phases)} do not suffice") from None


def precision_for(system: System, phases: Range, horizon: Fraction = HORIZON) -> int:
    """Return the precision at which the middle one of the launches is decided, the least if none.

    A choice, never evidence.
    """
    middle = (phases[0] + phases[1]) / 2
    try:
        return locate(system, (middle, middle), horizon=horizon).flight.precision
    except Undecided:
        return LEAST


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
