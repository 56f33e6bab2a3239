"""Drawings of matplotlib as parts of one page: shapes of letters that they share stand once."""

from __future__ import annotations

import re
from collections.abc import Mapping

_BEFORE = re.compile(r"^.*?(?=<svg)", re.DOTALL)
_METADATA = re.compile(r"<(metadata|title)>.*?</\1>\s*|<style[^>]*>.*?</style>\s*", re.DOTALL)
_LETTER = re.compile(r'<path id="(?P<name>[^"]*)" (?P<shape>d="[^"]*"[^>]*)/>')


def inlined(drawings: Mapping[str, str]) -> dict[str, str]:
    """Return SVG files by name as elements of a page, in this order."""
    shared: dict[str, str] = {}  # shape to the name that it has in the page
    return {name: _inlined(text, shared) for name, text in drawings.items()}


def _inlined(text: str, shared: dict[str, str]) -> str:
    text = _METADATA.sub("", _BEFORE.sub("", text))
    names: dict[str, str] = {}

    def once(letter: re.Match[str]) -> str:
        first = shared.setdefault(letter["shape"], letter["name"])
        names[letter["name"]] = first
        return letter[0] if first == letter["name"] else ""

    text = _LETTER.sub(once, text)
    text = re.sub(r'href="#([^"]*)"', lambda use: f'href="#{names.get(use[1], use[1])}"', text)
    text = re.sub(r' d="([^"]*)"', lambda path: f' d="{shortened(path[1])}"', text)
    return re.sub(r"\s*\n\s*", "\n", text)


def shortened(path: str) -> str:
    """Return a path with the same numbers: after a point, more points are joined by lines."""
    path = " ".join(path.split())
    if not re.search("[^MLz0-9. -]", path):
        path = path.replace(" L ", " ")
    return re.sub(r" ?([A-Za-z]) ?", r"\1", path)
