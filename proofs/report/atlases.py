"""The atlases beside a report, as its page links to them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

from proofs.report.layout import percent
from proofs.trusted.certificate import Malformed
from proofs.trusted.numbers import show_range
from proofs.trusted.verdicts import Verdict

PAGES = "atlas/*/atlas.html"  # in a folder of results


class Atlas(NamedTuple):
    """A page of its own: where it is, what is asked there and where, shares of the area."""

    link: str
    question: str
    holds: str
    region: str
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


def _told(link: str, made: dict[str, Any]) -> Atlas:
    sides = (
        f"{name} in {show_range((Fraction(made[name][0]), Fraction(made[name][1])))}"
        for name in ("eta", "nu")
    )
    shares = [
        (verdict, percent(made["share_of_area"][verdict.value]))
        for verdict in Verdict
        if made["cells"].get(verdict.value)
    ]
    return Atlas(link, made["question"], made["holds"], ", ".join(sides), shares)
