"""Maps, of formulas and of motions: what rules ask of them; their angles, and turns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol, runtime_checkable

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.conclusion import Subject
from proofs.trusted.kernel.enclose import Circle, Differentiable, integer

_MOST_TURNS = 10**6


class Map(Subject, Differentiable, Protocol):
    """A map of a file, of some variables, to `size` values.

    It respects the periods of its angles: the image of x + a period is that of x, plus a multiple
    of the period of each value that is an angle.
    """

    @property
    def variables(self) -> tuple[str, ...]: ...
    @property
    def size(self) -> int: ...
    @property
    def circles(self) -> tuple[Circle, ...]: ...


@runtime_checkable
class Bent(Protocol):
    """A map of one variable to one value, of which the second derivative is known."""

    def bend(self, x: Sequence[Enclosure]) -> Enclosure:
        """Enclose the second derivative, for all x in a box."""


@runtime_checkable
class Jumping(Protocol):
    """A map that may jump: on a box its values may be in several places."""

    def possible_values(self, x: Sequence[Enclosure]) -> Iterator[list[Enclosure]]:
        """Enclose the values in each place."""


# -- turns -----------------------------------------------------------------------------------------


def counted(turns: int) -> str:
    """Write a number of periods, without its sign."""
    return f"{abs(turns)} period" if abs(turns) == 1 else f"{abs(turns)} periods"


def lifted(turns: int) -> str:
    """Write that so many periods are taken off."""
    return f"{'plus' if turns < 0 else 'less'} {counted(turns)}"


def turned(map_: Map, x: Sequence[Enclosure], turns: Sequence[int]) -> list[Enclosure]:
    """Enclose x less some periods of its angles."""
    lifted = list(x)
    for (place, period), count in zip(map_.periods(x[0].bits).items(), turns, strict=True):
        lifted[place] = lifted[place] - period * count
    return lifted


def read_turns(map_: Map, reader: Reader) -> tuple[int, ...]:
    """Read the field `turns`, which is there if a map has angles: an integer for each of them."""
    count = len(map_.circles)
    if reader.has("turns") != (count > 0):
        raise reader.fail("`turns` are for maps with angles, and needed there")
    if not count:
        return ()
    turns = dict(reader.entries())["turns"].items(count, count)
    return tuple(integer(each, -_MOST_TURNS, _MOST_TURNS) for each in turns)
