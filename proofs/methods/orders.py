"""Equations of any order as a system of first order, as the checker has a flow."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from proofs.methods.grammar import GrammarError


class FirstOrder(NamedTuple):
    """States y, y_1 = y', ... for each motion y: their rates, and their values at the start."""

    time: str
    orders: Mapping[str, int]
    field: list[str]
    start: list[str]

    @property
    def state(self) -> list[str]:
        """The names of the states."""
        return [_name(y, k) for y, order in self.orders.items() for k in range(order)]

    def formula(self, text: str) -> str:
        """Return a formula with names in the places of derivatives D(y, t)."""
        return _named(text, self.time, self.orders)


def first_order(motions: Sequence[Mapping[str, Any]], time: str) -> FirstOrder:
    """Return equations {name, equation, start} as a system of first order."""
    orders = {each["name"]: len(each["start"]) for each in motions}
    field: list[str] = []
    for each in motions:
        name, order = each["name"], len(each["start"])
        field += [_name(name, k) for k in range(1, order)]
        field.append(_named(each["equation"], time, orders))
    return FirstOrder(time, orders, field, [x for each in motions for x in each["start"]])


def _name(motion: str, order: int) -> str:
    return f"{motion}_{order}" if order else motion


def _named(text: str, time: str, orders: Mapping[str, int]) -> str:
    def name(match: re.Match[str]) -> str:
        motion, order = match[1], match[2].count(",")
        if order >= orders.get(motion, 0):
            why = "its equation gives it" if motion in orders else f"no motion is {motion}"
            raise GrammarError(f"{motion}{chr(39) * order} is no state: {why}")
        return _name(motion, order)

    return re.sub(rf"\bD\((\w+)((?:, {time})+)\)", name, text)
