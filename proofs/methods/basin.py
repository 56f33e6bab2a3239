"""Candidates for a partition of the circle on which a map can be followed: floating point.

Cuts are placed at preimages of cuts, so that most cells are mapped onto unions of cells, and the
bookkeeping of `s34_circle.cells` loses little. Nothing here is evidence.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Sampled:
    """A monotone branch: increasing phases, and their images, counted on the line."""

    phases: NDArray[np.float64]
    images: NDArray[np.float64]

    def preimages(self, image: float) -> Iterator[tuple[float, float]]:
        """Yield about the phases that are mapped to image + 2 pi k, and that, for every k."""
        low, high = float(self.images.min()), float(self.images.max())
        step = 1 if self.images[-1] > self.images[0] else -1
        for turns in range(
            math.ceil((low - image) / math.tau), 1 + int((high - image) // math.tau)
        ):
            lifted = image + math.tau * turns
            yield float(np.interp(lifted, self.images[::step], self.phases[::step])), lifted


@dataclass
class Cuts:
    """Cuts of the line, at least `finest` apart.

    refine(branch, phase, image) returns the phase near the given one with this image, counted on
    the line. origins: of each cut that is a preimage its branch, and the cut that is its image
    together with what is to be added to that.
    """

    branches: Sequence[Sampled]
    refine: Callable[[int, float, float], float]
    finest: float
    cuts: list[float] = field(default_factory=list)
    origins: dict[float, tuple[int, float, float]] = field(default_factory=dict)

    def grow(self, seeds: Iterable[float], sources: Iterable[float]) -> None:
        """Cut at the seeds, then at all preimages, of these and of the sources, that fit in."""
        self.cuts = sorted(set(seeds))
        waiting = deque([*sources, *self.cuts])
        while waiting:
            image = waiting.popleft()
            for index, branch in enumerate(self.branches):
                for phase, lifted in branch.preimages(image):
                    if self._fits(phase):
                        cut = self.refine(index, phase, lifted)
                        if self._fits(cut):
                            self.cuts.insert(bisect_left(self.cuts, cut), cut)
                            self.origins[cut] = index, image, lifted - image
                            waiting.append(cut)

    def _fits(self, cut: float) -> bool:
        place = bisect_left(self.cuts, cut)
        around = self.cuts[max(0, place - 1) : place + 1]
        return len(around) == 2 and all(abs(cut - x) > self.finest for x in around)

    def lean(self, sides: Callable[[float], float]) -> dict[float, tuple[float, float]]:
        """Move each preimage a little, so that its image is off its cut by sides(cut).

        Returns where each preimage is moved to, and its image. Images are moved before their
        preimages: they were found first.
        """
        moved: dict[float, tuple[float, float]] = {}
        for cut, (index, image, shift) in self.origins.items():
            target = moved.get(image, (image, 0.0))[0] + sides(image) + shift
            moved[cut] = self.refine(index, cut, target), target
        return moved
