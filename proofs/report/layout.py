"""How texts are laid out on the page: sentences, enumerations, enclosures, what is marked, names.

Marked is where a printed claim and a proved theorem speak of the same symbol and give other values.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from proofs.report.findings import Findings
from proofs.report.typeset import html
from proofs.trusted.numbers import ceil_text, floor_text
from proofs.trusted.verdicts import Verdict

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


if TYPE_CHECKING:
    from markupsafe import Markup

_MANY = 6  # parts after which an enumeration is a list


@dataclass(frozen=True)
class Block:
    """A sentence of a statement, or a list with what introduces it."""

    text: Markup
    items: tuple[Markup, ...] = ()
    style: str = ""


def sentences(text: str) -> list[str]:
    """Divide a text after each full stop that a capital or a symbol in brackets follows."""
    return re.split(r"(?<=\.) (?=[A-Z(|])", text)


def block(sentence: str, printed: str) -> Block:
    """Return a sentence, enumerations as a list: see `enumerated`."""
    head, parts, style = enumerated(sentence)
    return Block(_markup(head, printed), tuple(_markup(x, printed) for x in parts), style)


def enumerated(sentence: str) -> tuple[str, list[str], str]:
    """Return what introduces an enumeration, its parts, and how they are set; no parts: no list."""
    head, *numbered = re.split(r"[;:] \(\d\) ", sentence)
    if len(numbered) > 1:
        return head + ":", numbered, "parts"
    cases = re.fullmatch(r"(.*:) ((?:n = 1|epsilon in \[[^\]]*\]): .*?)", sentence)
    parts = cases[2].split("; ") if cases else []
    if cases and len(parts) > _MANY:
        return cases[1], parts, "narrow"
    return sentence, [], ""


def _markup(text: str, printed: str) -> Markup:
    """Return what is marked; the package is one of the page's, and may be missing elsewhere."""
    from markupsafe import Markup

    return Markup(marked(text, printed))


def enclosure(lower: str, upper: str) -> str:
    """Write two decimals as one: 1.23[45, 46]; wide ones as a range, rounded outward."""
    if lower == upper:
        return lower
    places = max(len(text.partition(".")[2]) for text in (lower, upper))
    low, high = (_padded(text, places) for text in (lower, upper))
    shared = next((k for k, (a, b) in enumerate(zip(low, high, strict=False)) if a != b), 0)
    if len(low) == len(high) and shared > len(low.partition(".")[0]) + 4:
        return f"{low[:shared]}[{low[shared:]}, {high[shared:]}]"
    return f"[{floor_text(Fraction(lower), 8)}, {ceil_text(Fraction(upper), 8)}]"


def percent(share: str) -> str:
    """Write a share in percent, rounded down to a tenth."""
    return _tenths(int(Fraction(share) * 1000))


def percents(shares: Mapping[str, str], last: str) -> dict[str, str]:
    """Write the shares of a whole in percent, to a tenth, so that they add up to 100.

    They are rounded down, and what is left is of `last`; without that, of those that lose most.
    """
    exact = {name: Fraction(share) * 1000 for name, share in shares.items()}
    tenths = {name: int(share) for name, share in exact.items()}
    losers = sorted(exact, key=lambda name: tenths[name] - exact[name])
    for loser in losers[: 1000 - sum(tenths.values())]:
        tenths[last if exact.get(last) else loser] += 1
    return {name: _tenths(share) for name, share in tenths.items()}


def _tenths(count: int) -> str:
    return f"{count // 10}.{count % 10} %"


def _padded(text: str, places: int) -> str:
    integer, _, digits = text.partition(".")
    return f"{integer}.{digits.ljust(places, '0')}" if places else integer


PAPER_TITLE = (
    "On the Dynamics of a Harmonic Oscillator Undergoing Impacts with a Vibrating Platform"
)
MEANINGS = MappingProxyType(
    {
        Verdict.VERIFIED: "true as printed",
        Verdict.REFUTED: "false as printed",
        Verdict.CONDITIONAL: "true under conditions",
        Verdict.UNDECIDED: "not decided",
        Verdict.SIMULATED: "observed, not proved",
    }
)
DEFINITIONS = MappingProxyType(
    {
        Verdict.VERIFIED: "Proved as printed, misprints of the scan aside.",
        Verdict.REFUTED: "Proved false as printed, with an exact witness; beside it stands the "
        "strongest true statement nearby that could be proved.",
        Verdict.CONDITIONAL: "True exactly under conditions that the paper leaves out; they are "
        "stated and proved.",
        Verdict.UNDECIDED: "Neither proved nor refuted; what is missing is said.",
        Verdict.SIMULATED: "An observation, not mathematics: reproduced by simulation, and never "
        "called a proof.",
    }
)


def verdict_name(verdict: Verdict) -> str:
    """Return a verdict as a word."""
    return verdict.value.capitalize()


def summary(findings: Findings) -> str:
    """Return in two sentences what the report is about and what it does."""
    count = sum(not claim.row.own for claim in findings.claims)
    return (
        "A mass on a spring bounces on a vibrating table. Is it chaotic, as the paper says? Here "
        f"are its {count} claims, one by one: what is true, what is not, and what is true instead, "
        "with proofs that a small independent program checks. The paper was received on 16 July "
        "1999 and accepted on 22 August 2000; the scan that was read names neither authors nor "
        "journal."
    )


def tally(findings: Findings) -> list[tuple[Verdict, int]]:
    """Return how many of the paper's claims have which verdict."""
    counts = Counter(claim.verdict for claim in findings.claims if not claim.row.own)
    return [(verdict, counts[verdict]) for verdict in Verdict if counts[verdict]]
