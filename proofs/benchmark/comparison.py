"""One operation of several libraries, measured in turn, and what a row of the table says of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from proofs.benchmark.libraries import Measurable
from proofs.benchmark.measuring import Row, figures, in_turn, spread
from proofs.benchmark.operations import Operation

Tell = Callable[[str], None]
_WIDE, _NARROW = 30, 12


@dataclass(frozen=True)
class Comparison:
    """Seconds an element, samples in turn, of each library that has the operation."""

    seconds: Mapping[str, Sequence[float]]

    def ratios(self, own: str, other: str) -> list[float]:
        """Return how many times as long the other takes, sample by sample."""
        pairs = zip(self.seconds[other], self.seconds[own], strict=True)
        return [theirs / ours for theirs, ours in pairs]

    def row(self, name: str, own: str, beside: Sequence[str], asked: str, least: float) -> Row:
        """Return the row for library `own`; `asked` is empty or says that `least` is the target.

        The target is about the first library of `beside`.
        """
        ratios = {other: self.ratios(own, other) for other in beside if other in self.seconds}
        first, *others = beside
        cells = [
            f"{figures(1e9 * median(self.seconds[own])):>{_NARROW}}",
            f"{spread(ratios[first]) if first in ratios else '-':{_WIDE}}",
            *(f"{_median(ratios.get(x)):>{_NARROW}}" for x in others),
        ]
        reached = median(ratios[first]) >= least if asked and first in ratios else None
        samples = {"seconds an element": dict(self.seconds), "ratios": ratios}
        return Row(name, "  ".join(cells), asked, reached, samples)


def _median(ratios: Sequence[float] | None) -> str:
    return figures(median(ratios)) if ratios else "-"


def compare(
    libraries: Mapping[str, Measurable],
    operation: Operation,
    *,
    wide: bool,
    counts: Mapping[str, int],
    rounds: int,
    enough: float,
) -> Comparison:
    """Measure an operation over counts[name] intervals of each library."""
    samplers = {}
    for name, library in libraries.items():
        job = operation.job(name, wide, counts[name])
        if job:
            samplers[name] = library.sampler(job, enough)
    columns = in_turn(list(samplers.values()), rounds)
    return Comparison(dict(zip(samplers, columns, strict=True)))


def heading(title: str, beside: Sequence[str]) -> Row:
    """Return the row above the rows of a comparison."""
    first, *others = beside
    cells = [
        f"{'ns':>{_NARROW}}",
        f"{'ratio of ' + first:{_WIDE}}",
        *(f"{x:>{_NARROW}}" for x in others),
    ]
    return Row(title, "  ".join(cells))
