"""What floating point sees beside what `explore` proves: the circle cut, and fates of orbits."""

from __future__ import annotations

import math
from argparse import Namespace
from collections.abc import Iterator
from typing import TYPE_CHECKING

from intervals import Undecided
from proofs.motion.system import System
from proofs.search.budget import EFFORT, FASTEST, Budget
from proofs.trusted.numbers import TURN, show
from proofs.trusted.parameters import Parameters

if TYPE_CHECKING:
    from proofs.search.portrait import Stretch

_NARROW = 0.005  # of stretches that are counted only
_SMALL = 50  # a denominator of eta after which touches are common

_TITLE = "## Seen in floating point, not proved"


def dossier(of: Parameters, options: Namespace) -> str:
    """Return in Markdown what floating point sees on the circle, and what is special here."""
    budget = Budget(of.eta, options.effort or EFFORT, options.seconds or math.inf)
    lines = [_TITLE, ""]
    if of.eta > FASTEST:
        return "\n".join([*lines, f"Nothing: for eta > {FASTEST} flights are not followed."])
    try:
        lines += _circle(of, budget) if of.epsilon is None else ()
        lines += _fates(of, budget)
    except Undecided as failure:
        lines.append(f"Not all that was to be looked at: {failure}.")
    return "\n".join([*lines, *_special(of)])


def _fates(of: Parameters, budget: Budget) -> Iterator[str]:
    """Say what motions come to."""
    from proofs.search.portrait import fates

    system, epsilon = System(of.eta, of.nu), float(of.epsilon or 0)
    yield from (f"Of {budget.starts} motions from random impacts:", "")
    for fate in fates(system, epsilon, budget.starts, budget.impacts, budget.check):
        yield f"- {100 * fate.share:.0f} percent: {fate.name}, after up to {fate.impacts} impacts"


def _circle(of: Parameters, budget: Budget) -> Iterator[str]:
    """Cut the circle into stretches of the plastic map."""
    from proofs.report.page import markdown_table
    from proofs.search.portrait import HEAD, rows, stretches

    system = System(of.eta, of.nu)
    seen = stretches(system, budget.grid, budget.farthest, budget.check)
    shown = rows(seen, _NARROW)
    yield (
        f"The circle in {len(shown)} stretches, from {budget.grid} phases, flights up to time "
        f"{budget.farthest:g}:"
    )
    yield from ("", *markdown_table([HEAD, *shown]), "", *_others(seen))


def _others(seen: list[Stretch]) -> Iterator[str]:
    """Say what the table leaves out."""
    widths = [each.width for each in seen if each.width > _NARROW]
    if rest := len(seen) - len(widths):
        share = 100 * (1 - sum(widths) / float(TURN))
        yield f"{rest} narrower ones and what lies between them are {share:.2g} percent of it."


def _special(of: Parameters) -> Iterator[str]:
    """Say where arithmetic is special, and where more is known."""
    turns = of.eta.denominator
    hints = []
    if of.eta == 1:
        hints.append("eta = 1 is resonance: `python -m proofs resonance` has f in closed form")
    elif turns <= _SMALL:
        hints.append(
            f"eta = {show(of.eta)} has the small denominator {turns}: for flights that touch the "
            f"table at the time {turns} * 2 pi = {turns * float(TURN):.6g} see X5"
        )
    if of.nu <= -1:
        hints.append("nu <= -1: X5, and long flights in X2, are looked at for -1 < nu < 0 only")
    if hints:
        yield from ("", "What is special here:", "", *(f"- {hint}" for hint in hints))
