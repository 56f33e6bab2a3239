"""Make a failing case smaller: fewer digits of each number, as long as it still fails."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction

from proofs.stress.cases import Case

_MOST_TRIES = 200


def shrunk(case: Case, fails: Callable[[Case], bool]) -> Case:
    """Return a simplest case found that still fails: each number in turn, until none gives."""
    tries = 0
    again = True
    while again:
        again = False
        for simpler in _simpler(case):
            tries += 1
            if tries > _MOST_TRIES:
                return case
            if fails(simpler):
                case, again = simpler, True
                break
    return case


def _simpler(case: Case) -> Iterator[Case]:
    """Yield the case with one number shorter, the shortest first, or with an interval a point."""
    values = {name: getattr(case, name) for name in case.__dataclass_fields__}
    low, high = values["low"], values["high"]
    if low < high:
        yield from (replace(case, high=low), replace(case, low=high))
    for name, value in values.items():
        if not isinstance(value, Fraction):
            continue
        for shorter in _shorter(value):
            changed = {name: shorter}
            if name in ("low", "high") and low == high:
                changed = {"low": shorter, "high": shorter}
            if changed.get("low", low) <= changed.get("high", high):
                yield replace(case, **changed)


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
