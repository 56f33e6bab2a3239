"""Where a printed claim and a proved theorem speak of the same symbol and give other values."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from proofs.report.typeset import html

_NAME = r"[A-Za-z]+[0-9]*(?:_[A-Za-z0-9]+)?'?"
_NUMBER = r"-?[0-9]+(?:[./][0-9]+)*"
_RANGE = r"\[[^\]]*\]"
_ROOT = r"sqrt\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
_VALUE = rf"{_RANGE}(?: x {_RANGE})?|{_ROOT}|{_NUMBER}"
_FACTS = (
    re.compile(rf"(?<![\w_^])(?P<name>{_NAME}) (?P<sign>=|<=|>=) (?P<value>{_VALUE})(?![\w/])"),
    re.compile(rf"(?<![\w/.])(?P<value>{_NUMBER}) (?P<sign><=) (?P<name>{_NAME})(?![\w_(])"),
)


class Fact(NamedTuple):
    """A symbol, a sign, and the value beyond it, with the place of the value in its text."""

    name: str
    sign: str
    value: str
    start: int
    end: int


def facts(text: str) -> Iterator[Fact]:
    """Yield what a text says about symbols: x = 1, x <= 2, 0 <= x, which is x >= 0."""
    for turned, pattern in enumerate(_FACTS):
        for match in pattern.finditer(text):
            sign = ">=" if turned else match["sign"]
            yield Fact(match["name"], sign, match["value"], *match.span("value"))


def marked(text: str, other: str) -> str:
    """Return a text as HTML, the values marked that the other text gives differently."""
    others: dict[tuple[str, str], set[str]] = {}
    for fact in facts(other):
        others.setdefault(fact[:2], set()).add(fact.value)
    parts, done = [], 0
    for fact in sorted(facts(text), key=lambda fact: fact.start):
        values = others.get(fact[:2])
        if values and fact.value not in values and fact.start >= done:
            parts += [html(text[done : fact.start]), f"<mark>{html(fact.value)}</mark>"]
            done = fact.end
    return "".join([*parts, html(text[done:])])
