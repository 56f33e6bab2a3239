"""Make a failing case smaller: fewer digits of each number, as long as it still fails."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import Any

from proofs.stress.cases import Case

_MOST_TRIES = 200


def shrunk(case: Case, fails: Callable[[Case], bool], tries: int = _MOST_TRIES) -> Case:
    """Return a simplest case found that still fails: each number in turn, until none gives."""
    for number, simpler in enumerate(islice(_simpler(case), tries), 1):
        if fails(simpler):
            return shrunk(simpler, fails, tries - number)
    return case


def _simpler(case: Case) -> Iterator[Case]:
    """Yield the case with an interval a point, or with one number shorter, the shortest first."""
    values: dict[str, Any] = {name: getattr(case, name) for name in case.__dataclass_fields__}
    low, high = values["low"], values["high"]
    changes: list[dict[str, Any]] = []
    if low < high:
        changes = [{"high": low}, {"low": high}]
    for name, value in values.items():
        if isinstance(value, Fraction):
            both = ("low", "high") if name in ("low", "high") and low == high else (name,)
            changes += [dict.fromkeys(both, shorter) for shorter in _shorter(value)]
    for change in changes:
        if change.get("low", low) <= change.get("high", high):
            yield replace(case, **change)


def _shorter(value: Fraction) -> Iterator[Fraction]:
    """Yield numbers near by that take fewer digits."""
    size = len(str(value))
    seen = {value}
    for digits in (1, 2, 4, 8, 16, 32, 64):
        unit = Fraction(10) ** digits
        for near in (Fraction(round(value * unit)) / unit, value.limit_denominator(10**digits)):
            if near not in seen and near != 0 and len(str(near)) < size:
                seen.add(near)
                yield near
