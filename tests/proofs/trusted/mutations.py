"""One mutator for all certificates: whatever stands in a file changed, by kinds.

`mutations(document)` yields changes of a true file. What breaks the form is in `FORM`. A change
after which a file still says the same is in `HARMLESS`, by the field, for the reason given; one
after which it says something else is judged by what it says.
"""

import json
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from typing import Any

from proofs.trusted.certificate import SCHEMA, Malformed
from proofs.trusted.files import render
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.rules import RULES
from proofs.trusted.verify import Rejected, Report, check
from tests.proofs.trusted.edits import Document, Edit, Mutation, drop, edited, put, swap, walk

Found = Iterator[tuple[str, tuple[Any, ...], Edit]]
TREES = "tree", "support"
VERDICTS = "VERIFIED", "REFUTED", "UNDECIDED", "CONDITIONAL", "verified", ""
TURN = Fraction("6.283185307")
FORM = {"other type", "missing", "unknown field", "unknown", "no tree", "no formula"}
FORM |= {"not canonical", "inward"}
ANY = ()
HARMLESS = {  # fields; what may be done to them, and why
    "times": ("nudged moved dropped", "another subdivision: every piece is examined again"),
    "time": (
        "nudged moved widened looser tighter",
        "another bracket that holds the impact; the numbers are computed from it again",
    ),
    "starts": ("nudged moved", "another time before the impact, up to which the gap is > 0"),
    "root": ("nudged looser tighter widened", "another bracket of the root"),
    **dict.fromkeys(("bounds", "states", "weights"), (ANY, "others, proved anew")),
    "points": ("nudged dropped", "other points of the same pieces"),
    "target": ("nudged moved looser tighter", "another interval that is avoided, too"),
    "slopes": ("added", "a step may be named twice"),
    "cuts": (ANY, "another subdivision: every part is proved anew"),
    "cone": (ANY, "other cones, proved again"),
    "bits": (ANY, "as tight numbers as are asked for"),
    "centre": (ANY, "another point that the operator is about"),
    "matrix": (ANY, "another preconditioner"),
    "forms": (ANY, "other cones"),
    "vector": (ANY, "another weight of the sets"),
    "radius": (ANY, "another box around a point"),
    "point": (ANY, "another point next to the orbit"),
    "slope": (ANY, "another slanted box"),
    "box": ("nudged looser tighter", "another box around what is looked for"),
    **dict.fromkeys((*TREES, "left", "right"), (ANY, "another subdivision, each leaf proved anew")),
    **dict.fromkeys(("epsilon", "velocities", "reach"), (ANY, "plastic claims do not speak of it")),
    **dict.fromkeys(("proof", "steps", "orbits", "cells"), ("swapped turned", "the order is free")),
    **dict.fromkeys(("gaps", "images"), ("added swapped turned", "one may be there twice")),
    "lower": ("another", "a digit less: a lower bound as well"),
    "formula": ("another", "the same function"),
}
EXCUSED = {  # what breaks the form elsewhere
    "velocities other type": "no velocities",
    "reach other type": "no reach",
    "epsilon other type": "no restitution",
    "ratios other type": "1 / slopes are meant",
    "quantities other type": "no quantities",
    "expressions unknown field": "another unknown",
    "points other type": "an arc without points says less",
    "periods missing": "a map of the line, not of the circle",
    "periods other type": "a map of the line, not of the circle",
}


def is_number(value: Any) -> bool:
    try:
        Fraction(value)
    except (ValueError, TypeError):
        return False
    return isinstance(value, str)


def field(path: tuple[Any, ...]) -> str:
    """The last name on a path."""
    return next((str(part) for part in reversed(path) if isinstance(part, str)), "")


def is_tree(path: tuple[Any, ...]) -> bool:
    covers = len(path) > 3 and str(path[1]).startswith("covers") and path[3] in ("left", "right")
    return covers or any(part in TREES for part in path)


def is_formula(path: tuple[Any, ...]) -> bool:
    if path[0] == "functions":
        return not {"variables", "parameters", "maps", "name", "time"} & {*path}
    inside = {"function", "left", "right", "coefficients", "nonzero", "expressions", "lemmas"}
    return bool(inside & {*path[3:]}) and path[-1] != "variable"


# -- the kinds -------------------------------------------------------------------------------------


def numbers(path: tuple[Any, ...], value: str) -> Found:
    """A number elsewhere, or written in another way."""
    number = Fraction(value)
    for by in (Fraction(1, 10**9), Fraction(-1, 10**9)):
        yield "nudged", path, put(path, str(number + by))
    for by in (1, -1, 5, Fraction(3, 10), Fraction(-3, 10), -2 * number, number):
        if by:
            yield "moved", path, put(path, str(number + by))
    forms = (f"+{value}", f" {value}", f"{value}\n", f"{value}/1", f"0{value}", f"{value}e0", "")
    forms += f"{2 * number.numerator}/{2 * number.denominator}", "-0", "nan", "inf", "0x10", "１"
    for form in (*forms, "1_0", "1e3", "1/0", "9" * 5000):
        yield "not canonical", path, put(path, form)


def ranges(path: tuple[Any, ...], value: list[str]) -> Found:
    """A range [low, high] with its ends elsewhere, by parts of its width."""
    low, high = map(Fraction, value)
    width = high - low
    for kind, steps in (
        ("tighter", ((0.1, 0), (0, -0.1))),
        ("narrowed", ((0.75, 0), (0, -0.75))),
        ("looser", ((-0.1, 0), (0, 0.1))),
        ("widened", ((-1000, 0), (0, 1000))),
        ("aside", ((2, 2), (-2, -2), (TURN / width, TURN / width))),
        ("collapsed", ((0, -1), (1, 0))),
        ("turned", ((1, -1),)),
    ):
        for down, up in steps:
            ends = low + Fraction(down) * width, high + Fraction(up) * width
            yield kind, path, put(path, list(map(str, ends)))


def bounds(path: tuple[Any, ...], value: dict[str, str]) -> Found:
    """The printed bounds of a quantity, tighter than they are or written in another way."""
    lower, upper = (value["lower"], value["upper"])
    ulp = Fraction(1, 10 ** len(lower.partition(".")[2]))
    for side, by in (("lower", ulp), ("upper", -ulp)):
        yield "inward", path, put((*path, side), decimal(Fraction(value[side]) + by, ulp))
        for form in (f"+{value[side]}", f"{value[side]}e0", f" {value[side]}", "", "inf", "1/2"):
            yield "not canonical", path, put((*path, side), form)
    for low, high in ((upper, lower), (upper, upper), (lower, lower)):
        if low != high or lower != upper:
            yield "inward", path, put(path, {"lower": low, "upper": high})


def decimal(value: Fraction, unit: Fraction) -> str:
    """A multiple of a power of 10 as a decimal."""
    places = len(str(unit.denominator)) - 1
    whole, rest = divmod(abs(value.numerator * (unit.denominator // value.denominator)), 10**places)
    return f"{'-' * (value < 0)}{whole}" + f".{rest:0{places}}" * (places > 0)


def lists(path: tuple[Any, ...], value: list[Any]) -> Found:
    """A list with entries dropped, doubled, in another order."""
    for index in range(len(value)):
        yield "dropped", path, drop((*path, index))
        if index and value[index] != value[index - 1]:
            yield "swapped", path, swap((*path, index), (*path, index - 1))
            yield "doubled in place", path, put((*path, index), value[index - 1])
    yield "added", path, put(path, [*value, value[-1]])
    yield "emptied", path, put(path, [])
    if value[::-1] != value:
        yield "turned", path, put(path, value[::-1])


def trees(path: tuple[Any, ...], value: Any) -> Found:
    """A subdivision cut otherwise."""
    if value is None:
        yield "leaf cut", path, put(path, ["1", "1/1000003", None, None])
        others = [], ["1", "1/2", None], ["1", "1000000", None, None], ["99", "0", None, None]
        for other in others:
            yield "no tree", path, put(path, other)
    elif isinstance(value, list) and len(value) == 4:
        axis, cut, left, right = value
        yield "cut off", path, put(path, None)
        yield "swapped", path, put(path, [axis, cut, right, left])
        yield "nudged", path, put((*path, 1), str(Fraction(cut) + Fraction(1, 10**6)))
        yield "moved", path, put((*path, 1), str(Fraction(cut) + Fraction(1, 10)))
        yield "moved", path, put((*path, 0), "2" if axis == "1" else "1")
        for other in ([axis, "1000000", left, right], [axis, cut, left], [*value, right]):
            yield "no tree", path, put(path, other)


TOKENS = {" + ": (" - ", "*"), " - ": (" + ", "*"), "*": (" + ", "/"), "/": ("*", " - ")}
TOKENS |= {"sin": ("cos", "exp"), "cos": ("sin",), "t": ("phi",)}


def formulas(path: tuple[Any, ...], value: str) -> Found:
    """A formula with one sign, name or number exchanged; what is none."""
    tokens = re.findall(r"\w+|\*\*| ?[-+*/(),=] ?", value)
    for index, token in enumerate(tokens):
        for other in TOKENS.get(token, ["3" * len(token)] if token.isdigit() else []):
            yield (
                "another",
                path,
                put(path, "".join([*tokens[:index], other, *tokens[index + 1 :]])),
            )
    for other in (f" {value}", f"({value}", f"tan({value})", f"0x10*({value})", f"{value}#"):
        yield "no formula", path, put(path, other)


def names(document: Document, path: tuple[Any, ...], value: str) -> Found:
    """A name of another step, rule, function, claim; of none."""
    steps = document["steps"]
    known, unknown = (), ()
    if value in steps:
        known, unknown = tuple(steps), ("nowhere", "", path[1], "F", "avoids")
    elif value in document["functions"]:
        unknown = ("Nothing",)
    elif value in ("+", "-"):
        known, unknown = ("+", "-"), ("0",)
    elif path[-1] == "rule":
        known = (*RULES, "believe", "")
    elif path[0] == "claims":
        texts = f"{value} ", value[:-1], value.lower(), ""
        known = VERDICTS if path[-1] == "verdict" else texts
    for kind, others in (("another", known), ("unknown", unknown)):
        yield from ((kind, path, put(path, other)) for other in others if other != value)


def contents(document: Document, path: tuple[Any, ...], value: Any) -> Found:
    """What can be done to a value, by what it is."""
    pair = isinstance(value, list) and len(value) == 2 and all(map(is_number, value))
    if isinstance(value, dict) and set(value) == {"lower", "upper"}:
        yield from bounds(path, value)
    elif pair and Fraction(value[0]) < Fraction(value[1]):
        yield from ranges(path, value)
    elif isinstance(value, list) and value:
        yield from lists(path, value)
    elif isinstance(value, str) and is_formula(path) and value not in document["functions"]:
        yield from formulas(path, value)
    elif is_number(value) and "quantities" not in path and path[-1] != "printed_s0":
        yield from numbers(path, value)
    elif isinstance(value, str):
        yield from names(document, path, value)


def inside(document: Document) -> Found:
    """All that can be done to what stands in a file."""
    for path, value in walk(document):
        if path[:1] in ((), ("schema",)):
            continue
        if is_tree(path) and not isinstance(value, str):
            yield from trees(path, value)
            continue
        if isinstance(value, dict):
            yield "unknown field", path, put((*path, "extra"), "1")
            free = path in (("functions",), ("steps",)) or path[-1] in ("quantities", "box")
            optional = ("periods", "parameters") if path[:1] == ("functions",) else ()
            needed = () if free else (key for key in value if key not in optional)
            yield from (("missing", path, drop((*path, key))) for key in needed)
        for other in (None, [], {}, True, [value], {"value": value}):
            if other != value:
                yield "other type", path, put(path, other)
        yield from contents(document, path, value)
    steps = document["steps"]
    for name, step in steps.items():
        yield "dropped", ("steps",), drop(("steps", name))
        yield "added", ("steps",), put(("steps", "spare-1"), step)
        yield "added", ("steps",), put(("steps", "x\nFILE: accepted"), step)
    yield "turned", ("steps",), put(("steps",), dict(reversed(steps.items())))


def texts(document: Document) -> Iterator[tuple[str, str, str]]:
    """Yield (kind, where, text) of changes to the text itself."""
    whole = render(document)
    for share in range(1, 40):
        yield "truncated", f"{share}/40", whole[: len(whole) * share // 40]
    for schema in ("impact-proofs.certificate/1", "", f"{SCHEMA}1"):
        yield "other schema", schema, whole.replace(SCHEMA, schema)
    for text in ("", "null", "[]", "{}", '"x"', "not JSON", "\0", "﻿" + whole, whole + "x"):
        yield "not a certificate", text[:9], text
    for depth in (2000, 200_000):
        deep = "[" * depth + "]" * depth
        for text in (whole.replace('"claims": ', f'"claims": {deep}, "x": ', 1), deep):
            yield "nested deeply", f"{depth}", text
        yield "nested deeply", f"{depth}", '{"schema":' * depth
    number = re.search(r'"-?[0-9]+(/[0-9]+)?"', whole)
    for bare in ("1", "-1", "1.5", "1e400", "NaN", "Infinity", "9" * 6000) if number else ():
        yield "bare number", bare[:9], whole.replace(number[0], bare, 1)
    for path, value in walk(document):
        if isinstance(value, dict) and value and path:
            key = next(iter(value))
            text = edited(document, put((*path, "MARK"), value[key]))
            yield "duplicate field", str(path), text.replace('"MARK"', json.dumps(key))
    yield "too large", "spaces", whole + " " * 4_000_000


def mutations(document: Document) -> Iterator[Mutation]:
    """Yield every mutation of a certificate; its kind is the field and what is done to it."""
    for kind, path, edit in inside(document):
        where = ".".join(map(str, path))
        formula = kind in ("another", "no formula") and is_formula(path)
        name = "formula" if formula else field(path)
        yield Mutation(f"{name} {kind}", where, partial(edited, document, edit))
    for kind, where, text in texts(document):
        yield Mutation(kind, where, partial(str, text))


def outcome(text: str) -> tuple[str, str, Report | None]:
    """Return (accepted, rejected or malformed, the reason, the report)."""
    try:
        report = check(text)
    except Malformed as error:
        return "malformed", str(error), None
    except (Rejected, Exhausted) as error:
        return "rejected", str(error), None
    return "accepted", "", report
