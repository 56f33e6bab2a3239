"""What a case is: an exact input, what the library says of it, and what is true of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.stress.kernels import Kernel, Range

Ranges = dict[str, Range]


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


@dataclass(frozen=True)
class Case:
    """One exact input of a family: the case can be made again from its fields."""

    family: str

    def answer(self) -> Answer:
        """Ask the library; let it raise."""
        raise NotImplementedError

    def bits(self) -> int | None:
        """Return the least precision that suffices, where the answer does not say."""
        return None

    def truths(self, kernel: Kernel) -> Sequence[Truth | None]:
        """Return the truth about every sample, None where it is out of reach."""
        raise NotImplementedError

    def best(self, hull: Range) -> Fraction:
        """Return the least width of an answer to this input, if `hull` are the true values."""
        raise NotImplementedError

    def inputs(self) -> dict[str, str]:
        """Return the fields as text."""
        return {name: str(getattr(self, name)) for name in self.__dataclass_fields__}
