"""Edits of certificates: where values are, and what is put in their places."""

import copy
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from proofs.trusted.certificate import render

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
