"""Changes to lemma files: every witness moved, swapped, dropped, doubled, renamed.

`mutations(document)` yields changes of a true file, by kind. A kind in `HARMLESS` may still be
proved by the checker, for the reason given; all others must be refused.
"""

import re
from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from typing import Any

from proofs.trusted.certificate import render
from proofs.trusted.rules import RULES
from tests.proofs.trusted.edits import Document, Mutation, drop, edited, put, swap, walk

HARMLESS = {
    "tree replaced by a leaf": "a simpler subdivision may do",
    "leaf divided": "a finer subdivision of the same box",
    "cut moved": "another subdivision of the same box",
    "branches swapped": "trees cover whatever they are: each leaf is proved anew",
    "axis changed": "another subdivision of the same box",
    "number moved a little": "another statement or witness near by, and true",
    "number moved a lot": "another statement or witness, and true: the sentence shows it",
    "entry doubled in place": "another statement, and true: the sentence shows it",
    "numbers swapped": "another statement or witness, and true: the sentence shows it",
    "integer changed": "another power or bound, and true: the sentence shows it",
    "reference changed": "another relation, and true: the sentence shows it",
    "claim dropped": "says less",
    "claims reordered": "the same claims",
    "steps reordered": "the same steps, where none needs another",
    "covers swapped": "the same graph, where the sets keep their places",
    "formula changed": "another formula for which the witness holds: the sentence shows it",
    "sign changed": "two relations or inequalities may hold at once only if said so",
}
PATHS = ("tree", "support", "outside", "matrices")


def is_tree(path):
    covers = len(path) > 3 and path[1].startswith("covers") and path[3] in ("left", "right")
    return covers or any(part in PATHS for part in path)


def trees(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    for path, value in walk(document["steps"], ("steps",)):
        if not is_tree(path) or isinstance(value, str):
            continue
        if value is None:
            yield "leaf divided", path, put(path, ["1", "1/1000003", None, None])
            yield "tree malformed", path, put(path, [])
            yield "tree malformed", path, put(path, ["1", "1/2", None])
            yield "cut outside", path, put(path, ["1", "1000000", None, None])
            yield "axis unknown", path, put(path, ["99", "0", None, None])
        else:
            axis, cut, left, right = value
            yield "tree replaced by a leaf", path, put(path, None)
            yield "branches swapped", path, put(path, [axis, cut, right, left])
            for by in (Fraction(1, 10**6), Fraction(-1, 10**6), Fraction(1, 10)):
                yield "cut moved", path, put((*path, 1), str(Fraction(cut) + by))
            yield "axis changed", path, put((*path, 0), "2" if axis == "1" else "1")
            yield "cut outside", path, put((*path, 1), "1000000")
            yield "branch dropped", path, put(path, [axis, cut, left])
            yield "branch doubled", path, put(path, [axis, cut, left, right, right])


def is_number(value):
    try:
        Fraction(value)
    except (ValueError, TypeError):
        return False
    return True


def numbers(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    for path, value in walk(document["steps"], ("steps",)):
        if is_tree(path) or {"rule", "coefficients", "expressions"} & {*path}:
            continue
        if isinstance(value, list) and len(value) > 1 and all(map(is_number, value)):
            yield "numbers swapped", path, put(path, value[::-1])
            yield "entry doubled in place", path, put(path, [value[0], *value[:-1]])
            yield "entry dropped", path, put(path, value[:-1])
            yield "entry added", path, put(path, [*value, value[-1]])
        if not is_number(value):
            continue
        number = Fraction(value)
        if path[-1] in ("power", "length", "growth"):
            for by in (-1, 1, 5):
                yield "integer changed", path, put(path, str(number + by))
            yield "integer nonsense", path, put(path, str(number + Fraction(1, 2)))
            continue
        for by in (Fraction(1, 10**9), Fraction(-1, 10**9)):
            yield "number moved a little", path, put(path, str(number + by))
        for by in (Fraction(3, 10), Fraction(-3, 10), -2 * number, number):
            if by:
                yield "number moved a lot", path, put(path, str(number + by))
        for other in (f"+{value}", f"{value}/1", f" {value}", "nan", "1e3", "", "0x1", "9" * 4000):
            yield "number not canonical", path, put(path, other)


def names(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    steps = document["steps"]
    for name, step in steps.items():
        path = ("steps", name)
        for rule in (*RULES, "believe", ""):
            if rule != step["rule"]:
                yield "rule changed", path, put((*path, "rule"), rule)
        yield "step dropped", path, drop(path)
        yield "step added", path, put(("steps", "spare"), step)
        for field in step["witness"]:
            yield "field dropped", (*path, field), drop((*path, "witness", field))
        yield "field added", path, put((*path, "witness", "note"), "x")
    yield "steps reordered", ("steps",), put(("steps",), dict(reversed(steps.items())))


def references(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    steps = document["steps"]
    for name, step in steps.items():
        path = ("steps", name)
        for inner, value in walk(step["witness"], (*path, "witness")):
            if value in ("+", "-"):
                yield "sign changed", inner, put(inner, "-" if value == "+" else "+")
                yield "sign unknown", inner, put(inner, "0")
            if isinstance(value, str) and value in steps:
                for other in steps:
                    if other != value:
                        yield "reference changed", inner, put(inner, other)
                for other in ("nowhere", "", name, "F"):
                    yield "reference unknown", inner, put(inner, other)
            if isinstance(value, str) and value in document["functions"]:
                yield "reference unknown", inner, put(inner, "Nothing")
            for other in (None, [], {}, True, {"value": value}):
                fewer = other == [] and inner[-1] == "points"  # of an arc: says less
                allowed = fewer or (other is None and is_tree(inner))
                if other != value and not allowed:
                    yield "other type", inner, put(inner, other)


def claims(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    listed = document["claims"]
    yield "claims reordered", ("claims",), put(("claims",), listed[::-1])
    yield "claims emptied", ("claims",), put(("claims",), [])
    yield "claim doubled", ("claims",), put(("claims",), [*listed, listed[0]])
    for index in range(len(listed)):
        yield "claim dropped", ("claims", index), drop(("claims", index))
        yield "claim unknown", ("claims", index), put(("claims", index), "nowhere")


OTHERS = {
    " + ": [" - ", "*"],
    " - ": [" + ", "*"],
    "*": [" + ", "/"],
    "/": ["*", " - "],
    "sin": ["cos", "exp"],
    "cos": ["sin"],
    "t": ["phi"],
}


def texts_in(document: Document) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """The texts of steps."""
    for path, value in walk(document["steps"], ("steps",)):
        named = {"function", "left", "right", "coefficients"} & {*path[3:]}
        if named and not is_tree(path) and value not in ([], *document["functions"]):
            yield path, value


def formulas(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    for path, value in (*walk(document["functions"], ("functions",)), *texts_in(document)):
        if not isinstance(value, str) or "variables" in path:
            continue
        tokens = re.findall(r"\w+|\*\*| ?[-+*/(),=] ?", value)
        for index, token in enumerate(tokens):
            for other in OTHERS.get(token, ["3" * len(token)] if token.isdigit() else []):
                changed = "".join([*tokens[:index], other, *tokens[index + 1 :]])
                yield "formula changed", path, put(path, changed)
        for other in (f" {value}", f"({value}", f"tan({value})", f"0x10*({value})", f"{value}#"):
            yield "formula malformed", path, put(path, other)


def relations(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Any]]:
    """Lists of a graph and of a cone step: dropped, doubled, swapped."""
    for name, step in document["steps"].items():
        for field in ("covers", "relations", "forms"):
            listed = step["witness"].get(field)
            if not isinstance(listed, list):
                continue
            path = ("steps", name, "witness", field)
            yield f"{field} dropped", path, put(path, listed[:-1])
            yield f"{field} doubled", path, put(path, [*listed, listed[0]])
            if len(listed) > 1 and listed[0] != listed[1]:
                yield f"{field} swapped", path, swap((*path, 0), (*path, 1))


GROUPS = (trees, numbers, names, references, claims, formulas, relations)


def mutations(document: Document) -> Iterator[Mutation]:
    """Yield every mutation of a lemma file."""
    whole = render(document)
    for group in GROUPS:
        for kind, path, edit in group(document):
            yield Mutation(kind, ".".join(map(str, path)), partial(edited, document, edit))
    for share in range(1, 10):
        yield Mutation("truncated", f"{share}/10", partial(str, whole[: len(whole) * share // 10]))
