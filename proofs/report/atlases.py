"""The atlases beside a report, as its page links to them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from proofs.report.layout import percents
from proofs.trusted.atlas import NOT_YET
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.maps import Map
from proofs.trusted.numbers import show, show_range
from proofs.trusted.verdicts import Verdict

PAGES = "atlas/*/atlas.html"  # in a folder of results


class Atlas(NamedTuple):
    """A page of its own: where it is, what is asked of which oscillators, shares of the area."""

    link: str
    question: str
    holds: str
    region: str
    impacts: str
    shares: list[tuple[Verdict, str]]


def atlases(folder: Path) -> list[Atlas]:
    """Return the atlases that have a page; Malformed where there is no summary beside one."""
    return list(_found(folder))


def _found(folder: Path) -> Iterator[Atlas]:
    for page in sorted(folder.glob(PAGES)):
        try:
            made = json.loads(page.with_suffix(".json").read_text(encoding="utf-8"))
            yield _told(page.relative_to(folder).as_posix(), made)
        except (ValueError, KeyError, TypeError):
            raise Malformed(f"no summary of an atlas beside {page}") from None


def about(made: dict[str, Any]) -> str:
    """Return in words which systems an atlas is about, by its summary."""
    if "functions" in made:
        maps: dict[str, Map] = {}
        for name, function in made["functions"].items():
            maps[name] = read_map(name, Reader(function), maps)
        return maps[made["function"]].definition
    epsilon: Sequence[str] | None = made.get("epsilon")
    if epsilon is None:
        return "impacts are plastic"
    low, high = map(Fraction, epsilon)
    within = f"= {show(low)}" if low == high else f"in {show_range((low, high))}"
    return f"impacts have the restitution epsilon {within}"


def areas(shares: Mapping[str, str]) -> dict[str, str]:
    """Return in percent on what of the area there is which verdict, and what is left to do."""
    names = (Verdict.VERIFIED.value, Verdict.REFUTED.value, Verdict.UNDECIDED.value, NOT_YET)
    return percents({x: shares[x] for x in names}, Verdict.UNDECIDED.value)


def _told(link: str, made: dict[str, Any]) -> Atlas:
    sides = (
        f"{name} in {show_range((Fraction(low), Fraction(high)))}"
        for name, (low, high) in made.get(
            "parameters", {name: made.get(name) for name in ("eta", "nu")}
        ).items()
    )
    shown = [verdict for verdict in Verdict if made["cells"].get(verdict.value)]
    written = areas(made["share_of_area"])
    shares = [(verdict, written[verdict.value]) for verdict in shown]
    where = ", ".join(sides)
    return Atlas(link, made["question"], made["holds"], where, about(made), shares)
