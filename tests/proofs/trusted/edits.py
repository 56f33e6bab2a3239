"""Edits of certificates: where values are, and what is put in their places; lies in a line each."""

import copy
import json
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from proofs.trusted.certificate import FIELDS
from proofs.trusted.files import render

Document = dict[str, Any]
Edit = Callable[[Document], None]


class Mutation(NamedTuple):
    """A changed certificate (made when asked for), the kind of its change, and where it is."""

    kind: str
    where: str
    make: Callable[[], str]


def walk(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Yield (path, value) for all values inside, the whole first."""
    yield path, value
    if isinstance(value, dict):
        for key, member in value.items():
            yield from walk(member, (*path, key))
    elif isinstance(value, list):
        for index, member in enumerate(value):
            yield from walk(member, (*path, index))


def at(document: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        document = document[key]
    return document


def put(path: tuple[Any, ...], value: Any) -> Edit:
    """Return the edit that replaces one value."""

    def edit(document: Document) -> None:
        at(document, path[:-1])[path[-1]] = value

    return edit


def drop(path: tuple[Any, ...]) -> Edit:
    def edit(document: Document) -> None:
        del at(document, path[:-1])[path[-1]]

    return edit


def swap(first: tuple[Any, ...], second: tuple[Any, ...]) -> Edit:
    def edit(document: Document) -> None:
        one, two = at(document, first), at(document, second)
        at(document, first[:-1])[first[-1]] = two
        at(document, second[:-1])[second[-1]] = one

    return edit


def edited(document: Document, *edits: Edit) -> str:
    changed = copy.deepcopy(document)
    for edit in edits:
        edit(changed)
    return render(changed)


# -- lies ------------------------------------------------------------------------------------------


def lie(text: str) -> Edit:
    """Return the edits that a line says, joined by &: a place, what is done there, with what.

    A place is a path with dots: a number is an entry, * is all of them. It begins at a field of the
    file or, inside of a step's witness, with the step's name. Done there: = another value, as JSON,
    or numbers and words; + a number, to all numbers inside; drop or twice the entry i; reverse.
    """
    edits = [each.split(None, 2) for each in text.split(" & ")]

    def edit(document: Document) -> None:
        for place, change, *words in edits:
            first, *path = place.split(".")
            base = () if first in FIELDS else ("steps", first, "witness")
            root, names = at(document, base), [first, *path] if first in FIELDS else path
            _change(root, names, change, "".join(words))

    return edit


def _change(value: Any, names: list[str], change: str, words: str) -> None:
    key: Any = names[0] if isinstance(value, dict) or names[0] == "*" else int(names[0])
    if key == "*":
        for entry in range(len(value)):
            _change(value, [str(entry), *names[1:]], change, words)
    elif names[1:]:
        _change(value[key], names[1:], change, words)
    elif change == "=":
        value[key] = _value(words)
    elif change == "+":
        value[key] = _added(value[key], Fraction(words))
    elif change == "drop":
        del value[key][int(words)]
    elif change == "twice":
        value[key].append(value[key][int(words)])
    elif change == "reverse":
        value[key].reverse()
    else:
        raise ValueError(f"no edit: {change}")


def _value(words: str) -> Any:
    if words[:1] in ("[", "{", '"') or words in ("null", "true"):
        return json.loads(words)
    return words.split() if " " in words else words


def _added(value: Any, by: Fraction) -> Any:
    return (
        [_added(each, by) for each in value]
        if isinstance(value, list)
        else str(by + Fraction(value))
    )
