"""Numbers and intervals by the names of variables and parameters, as a user gives them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from proofs.methods.grammar import canonical, exact, name, typed
from proofs.trusted.certificate import texts
from proofs.trusted.numbers import Range, show

Exact = int | Fraction | str
Ends = Exact | Sequence[Exact]  # a number, or both ends of an interval


def optional(parameters: Mapping[str, Ends], periods: Mapping[str, str]) -> dict[str, Any]:
    """Return the fields of a function for parameters and angles, where it has some."""
    ranges = {each: texts(ends) for each, ends in exact_sides(parameters).items()}
    angles = {name(each): canonical(period) for each, period in periods.items()}
    fields = {"parameters": ranges, "periods": angles}
    return {field: value for field, value in fields.items() if value}


def box_of(variables: Sequence[str], state: Mapping[str, Ends]) -> tuple[Range, ...]:
    """Return the sides of a box of states, in the order of the variables."""
    sides = exact_sides(state)
    if {*sides} != {*variables}:
        wanted = ", ".join(f"{typed(each)}=..." for each in variables)
        raise ValueError(f"a value for each variable is expected: {wanted}")
    return tuple(sides[each] for each in variables)


def exact_sides(values: Mapping[str, Ends]) -> dict[str, Range]:
    """Return both ends for each name as the checker has it; what is wrong is said with the name."""
    sides: dict[str, Range] = {}
    for each, ends in values.items():
        try:
            sides[name(each)] = ends_of(ends)
        except (ValueError, TypeError) as error:
            raise type(error)(f"{each}: {error}") from None
    return sides


def listed(names: Iterable[str]) -> str:
    """Return names as they were typed."""
    return ", ".join(map(typed, names))


def ends_of(values: Ends) -> Range:
    """Return both ends of an interval, equal for a number; exact, so no floats."""
    if isinstance(values, str) or not isinstance(values, Sequence):
        return exact(values), exact(values)
    if len(values) != 2:
        raise ValueError(f"a number or two ends are expected, not {len(values)} numbers")
    low, high = map(exact, values)
    if low > high:
        raise ValueError(f"interval reversed: {show(low)} > {show(high)}")
    return low, high
