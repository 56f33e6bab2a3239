"""What a case is: an exact input, what the library says of it, and what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar, Protocol

from proofs.stress.kernels import Kernel
from proofs.trusted.numbers import Range

Ranges = dict[str, Range]


class Unknown(Exception):
    """The truth is out of reach: a touch, or too many steps."""


@dataclass(frozen=True)
class Truth:
    """Bounds of true values, by name; none of them, and a reason, where there is no value."""

    known: Ranges
    reason: str = ""


@dataclass(frozen=True)
class Answer:
    """What the library said of each sample: an enclosure, or several of which one is true.

    possible: whether it said only that these are the possible images. bits: the least precision
    that sufficed, of those that were tried.
    """

    samples: tuple[tuple[Ranges, ...], ...]
    bits: int | None = None
    possible: bool = False


class Case(Protocol):
    """One input. `__dataclass_fields__` are exact: the case can be made again from them."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def family(self) -> str:
        """The family it was drawn for."""

    def answer(self) -> Answer:
        """Ask the library; let it raise."""

    def bits(self) -> int | None:
        """Return the least precision that suffices, where the answer does not say."""

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the truth about every sample, None where it is out of reach."""

    def best(self, name: str, hull: Range) -> Fraction:
        """Return the least width of an answer to this input, if `hull` are the true values."""


def inputs(case: Case) -> dict[str, str]:
    """Return the exact input of a case as text."""
    return {name: _text(getattr(case, name)) for name in case.__dataclass_fields__}


def _text(value: object) -> str:
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
