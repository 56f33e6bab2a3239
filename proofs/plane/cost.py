"""What cells cost, in CPU seconds: against their size, and against where they are."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from proofs.plane.store import Store
from proofs.report.figures import style
from proofs.trusted.atlas import SPLIT
from proofs.trusted.verdicts import Verdict

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

_BINS = 16
_LEAST = 0.01  # that is told
_GROUPS = {"proved": style.GREEN, "undecided": style.RED, "cut in four": style.BLUE}
_NAMES = {Verdict.UNDECIDED.value: "undecided", SPLIT: "cut in four"}
_SHARES = (10, 50, 90)


class Cost(NamedTuple):
    """The cost of one cell: how often the region was cut for it, its middle, CPU milliseconds."""

    depth: int
    eta: float
    nu: float
    outcome: str
    spent: float


def costs(store: Store) -> list[Cost]:
    """Return the cost of all cells, of those that were cut as well."""
    found = []
    for key, verdict, seconds in store.costs():
        box = store.region.box(key)
        middle = float(sum(box.eta)) / 2, abs(float(sum(box.nu))) / 2
        outcome = _NAMES.get(verdict, "proved")
        found.append(
            Cost(len(key.partition("/")[2]), *middle, outcome, max(1000 * seconds, _LEAST))
        )
    return found


def by_depth(found: Iterable[Cost]) -> list[dict[str, Any]]:
    """Return for each depth the cells and their CPU milliseconds: median, mean, nine tenths."""
    rows = []
    for depth, spent in _grouped(found, lambda cost: cost.depth).items():
        _, median, most = np.percentile(spent, _SHARES)
        named = {"median": median, "mean": np.mean(spent), "nine_tenths": most}
        times = {name: f"{float(value):.3g}" for name, value in named.items()}
        rows.append({"depth": int(depth), "cells": len(spent), **times})
    return rows


def _grouped(found: Iterable[Cost], of: Callable[[Cost], float]) -> dict[float, list[float]]:
    groups: dict[float, list[float]] = {}
    for cost in found:
        groups.setdefault(of(cost), []).append(cost.spent)
    return dict(sorted(groups.items()))


def figure(found: list[Cost]) -> Drawing:
    """Draw medians, and bars with the middle eight tenths: against depth, eta and |nu|."""
    drawing, axes = style.sheet(2.6, 1, 3, sharey=True)
    _panel(axes[0], found, lambda cost: cost.depth, "times cut in four")
    for name, at in (("eta", axes[1]), ("nu", axes[2])):
        places = [getattr(cost, name) for cost in found]
        low, width = min(places), (max(places) - min(places)) / _BINS or 1.0

        def middle(cost: Cost, name: str = name, low: float = low, width: float = width) -> float:
            place = int((getattr(cost, name) - low) / width)
            return low + width * (min(_BINS - 1, place) + 0.5)

        _panel(at, found, middle, {"eta": r"$\eta$", "nu": r"$|\nu|$"}[name])
        at.locator_params(axis="x", nbins=4)
    axes[0].set(ylabel="CPU milliseconds", yscale="log")
    axes[0].xaxis.get_major_locator().set_params(integer=True)
    drawing.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return drawing


def _panel(axes: Axes, found: list[Cost], of: Callable[[Cost], float], label: str) -> None:
    for outcome, colour in _GROUPS.items():
        groups = _grouped((cost for cost in found if cost.outcome == outcome), of)
        if groups:
            low, median, high = np.array([np.percentile(x, _SHARES) for x in groups.values()]).T
            bars = np.array([median - low, high - median])
            axes.errorbar([*groups], median, bars, fmt="o", color=colour, label=outcome, ms=2.5)
    axes.set_xlabel(label)
