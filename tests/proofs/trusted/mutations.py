"""Every kind of change to a certificate, and a corpus of the interesting ones.

`mutations(certificate)` yields changes of a true certificate, by kind. A kind in `HARMLESS` may
still prove what it says, for the reason given there; all others must be refused. From the root,
`python -m tests.proofs.trusted.mutations` prints how many of each kind are refused.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any

from proofs.trusted.certificate import SCHEMA, Malformed
from proofs.trusted.certificate import render as text_of
from proofs.trusted.paper import GROUPS as FILES
from proofs.trusted.verify import Rejected, Report, check
from tests.proofs.trusted.edits import Document, Edit, Mutation, at, drop, edited, put, swap, walk
from tests.proofs.trusted.renewing import fresh, renewed

VERDICTS = ("VERIFIED", "REFUTED", "UNDECIDED", "CONDITIONAL", "verified", "")

RESTITUTION = {"epsilon", "velocities", "reach"}

HARMLESS = {
    "time dropped": "another subdivision: every piece that is left is examined again",
    "time inserted": "another subdivision: every piece is examined again",
    "flight phases widened a little": "the same times prove the first impact of a few phases more",
    "bracket an ulp inward": "a tighter bracket that still holds the impact says no less",
    "bracket an ulp outward": "a wider bracket: the numbers recomputed from it still fit",
    "piece bracket an ulp inward": "still holds every impact time of the piece",
    "piece bracket outward": "wider, yet inside the window; the slopes are enclosed anew",
    "root an ulp inward": "a tighter bracket of the root",
    "root an ulp outward": "a wider bracket of the root: the digits recomputed from it still fit",
    "quantity outward": "a looser bound is still a bound",
    "quantity dropped": "says less",
    "claim dropped": "says less; refused only if a step is then used by nothing",
    "claims reordered": "the same claims",
    "reference added": "the same proof, and another true step",
    "proof of another claim": "where it decides the same, by the same texts",
    "corrected sets swapped, texts renewed": "the order in a file says nothing",
    "restitution changed": "claims about plastic impacts do not speak of it",
    "restitution left out": "claims about plastic impacts do not speak of it",
}


# -- access ----------------------------------------------------------------------------------------


def steps(document: Document, rule: str) -> list[tuple[str, Document]]:
    return [
        (name, step["witness"]) for name, step in document["steps"].items() if step["rule"] == rule
    ]


def moved(pair: list[str], low: Fraction | int, high: Fraction | int) -> list[str]:
    """Move the ends of a range by parts of its width, outward for positive numbers."""
    first, last = Fraction(pair[0]), Fraction(pair[1])
    width = last - first
    return [str(first - low * width), str(last + high * width)]


def renew_texts(document: Document) -> None:
    """Write all texts as the checker would."""
    document.update(renewed(document))


ULP, LOT = Fraction(1, 10), 10**12


# -- the kinds -------------------------------------------------------------------------------------


def brackets(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "slope-range") + steps(document, "point"):
        base = ("steps", name, "witness")
        points = (
            [(*base, "points", i) for i in range(len(witness["points"]))]
            if "points" in witness
            else [base]
        )
        for index, point in enumerate(points):
            path = (*point, "time")
            pair = at(document, path)
            turn = Fraction("6.283185307")
            low, high = map(Fraction, pair)
            yield "bracket an ulp inward", path, put(path, moved(pair, -ULP, 0))
            yield "bracket an ulp inward", path, put(path, moved(pair, 0, -ULP))
            yield "bracket an ulp outward", path, put(path, moved(pair, ULP, 0))
            yield "bracket an ulp outward", path, put(path, moved(pair, 0, ULP))
            most = Fraction(4, 5)
            yield "bracket inward past the impact", path, put(path, moved(pair, -most, 0))
            yield "bracket inward past the impact", path, put(path, moved(pair, 0, -most))
            yield "bracket moved aside", path, put(path, moved(pair, 2, -2))
            yield "bracket moved aside", path, put(path, moved(pair, -2, 2))
            yield "bracket moved by a turn", path, put(path, [str(low + turn), str(high + turn)])
            yield "bracket moved by a turn", path, put(path, [str(low - turn), str(high - turn)])
            yield "bracket far outward", path, put(path, ["1/1000", str(high)])
            yield "bracket far outward", path, put(path, [str(low), "1000"])
            yield "bracket collapsed", path, put(path, [pair[0], pair[0]])
            yield "bracket collapsed", path, put(path, [pair[1], pair[1]])
            yield "bracket reversed", path, put(path, pair[::-1])
            yield "bracket negative", path, put(path, [str(-high), str(-low)])
            yield "bracket with three ends", path, put(path, [*pair, pair[1]])
            yield "bracket dropped", path, drop(path)
            phase = Fraction(at(document, (*point, "phase")))
            for by in (Fraction(1, 10**9), Fraction(-1, 10**9), Fraction(1), Fraction(2)):
                yield "phase of a point changed", path, put((*point, "phase"), str(phase + by))
            if len(points) > 1:
                other = points[index - 1]
                yield "brackets swapped", path, swap(path, (*other, "time"))
                yield "points swapped", path, swap(point, other)
                yield "points dropped", path, drop(point)
                yield "points doubled", path, put((*base, "points"), [*witness["points"], {}])


def pieces(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "slope-range"):
        for index, piece in enumerate(witness["pieces"]):
            path = ("steps", name, "witness", "pieces", index, "time")
            pair = piece["time"]
            ends = [witness["points"][index + k]["time"] for k in (0, 1)]
            yield (
                "piece bracket an ulp inward",
                path,
                put(path, moved(pair, Fraction(-1, 10**9), 0)),
            )
            yield (
                "piece bracket an ulp inward",
                path,
                put(path, moved(pair, 0, Fraction(-1, 10**9))),
            )
            yield "piece bracket outward", path, put(path, moved(pair, Fraction(1, 100), 0))
            yield "piece bracket too narrow", path, put(path, [ends[0][1], pair[1]])
            yield "piece bracket too narrow", path, put(path, [pair[0], ends[1][0]])
            yield "piece bracket too narrow", path, put(path, moved(pair, Fraction(-1, 3), 0))
            yield "piece bracket too narrow", path, put(path, moved(pair, 0, Fraction(-1, 3)))
            yield "piece bracket of one point", path, put(path, ends[0])
            yield "piece bracket leaves the window", path, put(path, moved(pair, 0, 100))
            yield "piece bracket collapsed", path, put(path, [pair[0], pair[0]])
            yield "piece bracket reversed", path, put(path, pair[::-1])
            yield "pieces dropped", path, drop(path[:-1])
            yield "pieces doubled", path, put(path[:-2], [*witness["pieces"], piece])


def flights(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "first-impact"):
        path = ("steps", name, "witness", "times")
        times = witness["times"]
        yield "last time dropped", path, put(path, times[:-1])
        yield "launch piece too long", path, put(path, [times[-2], times[-1]])
        yield (
            "launch piece too long",
            path,
            put(path, ["20", *(t for t in times if Fraction(t) > 20)]),
        )
        yield "times reversed", path, put(path, times[::-1])
        yield "time zero", path, put(path, ["0", *times])
        yield "time negative", path, put(path, ["-1", *times])
        yield "time huge", path, put(path, [*times, "1000001"])
        yield "times emptied", path, put(path, [])
        yield "time doubled", path, put(path, [*times, times[-1]])
        for index in range(len(times) - 1):
            yield "time dropped", (*path, index), drop((*path, index))
            yield "times swapped", (*path, index), swap((*path, index), (*path, index + 1))
        middle = str((Fraction(times[-1]) + Fraction(times[-2])) / 2)
        yield "time inserted", path, put(path, [*times[:-1], middle, times[-1]])
        phases = ("steps", name, "witness", "phases")
        pair = witness["phases"]
        low, high = map(Fraction, pair)
        small = Fraction(1, 10**9)
        wider = [str(low - small), str(high + small)]
        if name not in at(document, ("steps", "avoids-1", "witness", "flights")):
            yield "flight phases widened a little", phases, put(phases, wider)
        yield "flight phases narrowed", phases, put(phases, [str(low + small), str(high)])
        yield "flight phases narrowed", phases, put(phases, [str(low), str(high - small)])
        yield "flight phases moved", phases, put(phases, [str(low + 1), str(high + 1)])
        yield "flight phases moved a turn", phases, put(phases, [str(low + 7), str(high + 7)])
        yield "flight phases reversed", phases, put(phases, [str(high + 1), str(low)])
        yield "flight phases the whole circle", phases, put(phases, ["0", "6"])


def references(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    names = list(document["steps"])
    for path, value in walk(document):
        if path and path[-1] == "flight":
            for other in (names[-1], path[1], "nowhere-1", "", "first-impact"):
                yield "flight reference changed", path, put(path, other)
        if path and path[-1] == "rule":
            for rule in ("first-impact", "point", "slope-range", "avoids", "moran-root", "believe"):
                if rule != value:
                    yield "rule changed", path, put(path, rule)
    for index, claim in enumerate(document["claims"]):
        path = ("claims", index, "proof")
        for place, name in enumerate(claim["proof"]):
            yield "reference dropped", path, drop((*path, place))
            yield "reference unknown", path, put((*path, place), "nowhere-1")
            yield "reference repeated", path, put(path, [*claim["proof"], name])
        others = [name for name in names if name not in claim["proof"]]
        yield "reference added", path, put(path, [*claim["proof"], others[0]])
    for name in names:
        path = ("steps", name)
        yield "step dropped", path, drop(path)
        yield "step added", path, put(("steps", "spare-1"), document["steps"][name])
        yield "step renamed", path, put(("steps", "x\nFILE: accepted"), document["steps"][name])
    yield "steps reordered", ("steps",), put(("steps",), dict(reversed(document["steps"].items())))


def avoiding(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "avoids"):
        base = ("steps", name, "witness")
        used = witness["flights"]
        for index in range(len(used)):
            path = (*base, "flights", index)
            yield "flight of the gap dropped", path, drop(path)
            yield "flight of the gap doubled", path, put((*base, "flights"), [*used, used[index]])
            if index:
                yield "flights of the gap swapped", path, swap(path, (*base, "flights", index - 1))
        path = (*base, "target")
        low, high = map(Fraction, witness["target"])
        small = Fraction(1, 1000)
        yield "target narrowed", path, put(path, [str(low + small), str(high)])
        yield "target narrowed", path, put(path, [str(low), str(high - small)])
        yield "target widened a little", path, put(path, [str(low - small / 100), str(high)])
        yield "target that is entered", path, put(path, ["0", "6"])
        yield "target that is entered", path, put(path, [str(low), "2"])
        yield "target moved", path, put(path, [str(low + 1), str(high + 1)])
        yield "target moved a turn", path, put(path, [str(low + 7), str(high + 7)])
        yield "target reversed", path, put(path, [str(high), str(low)])


def roots(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "moran-root"):
        path, pair = ("steps", name, "witness", "root"), witness["root"]
        ratios = ("steps", name, "witness", "ratios")
        low, high = map(Fraction, pair)
        small = Fraction(1, 10**25)
        yield "root an ulp inward", path, put(path, moved(pair, -ULP, -ULP))
        yield "root an ulp outward", path, put(path, moved(pair, ULP, ULP))
        for by in (small, -small, Fraction(1, 100), Fraction(-1, 100)):
            yield "root off", path, put(path, [str(low + by), str(high + by)])
        yield "root collapsed", path, put(path, [pair[0], pair[0]])
        yield "root reversed", path, put(path, pair[::-1])
        yield "root bracket far too wide", path, put(path, ["2/5", "1/2"])
        yield "root bracket far too wide", path, put(path, ["1/1000", "2"])
        yield "root not positive", path, put(path, ["0", pair[1]])
        yield "root not positive", path, put(path, ["-1", pair[1]])
        one, two = witness["ratios"]
        for pair_of in (
            [two, one],
            [one, one],
            ["1", two],
            ["0", two],
            ["-1/5", two],
            [one, "3/2"],
        ):
            yield "ratios of the root changed", ratios, put(ratios, pair_of)
        nudged = str(Fraction(one) + Fraction(1, 10**12))
        yield "ratios of the root changed", ratios, put(ratios, [nudged, two])


def parameters(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    """Without renewed texts: what is proved with them is the falsifier's to judge."""
    for path, value in walk(document["parameters"], ("parameters",)):
        if isinstance(value, str) and RESTITUTION & set(path):
            less = put(path, str(Fraction(value) - Fraction(1, 10**6)))
            yield "restitution changed", path, less
        elif isinstance(value, str) and path[-1] != "printed_s0":
            for by in (Fraction(1, 10**9), Fraction(-1, 10**9), Fraction(1, 50), Fraction(-1, 50)):
                yield "parameter changed", path, put(path, str(Fraction(value) + by))
    yield "parameters with nu = 0", ("parameters",), put(("parameters", "nu"), "0")
    yield "parameters with eta < 0", ("parameters",), put(("parameters", "eta"), "-2121/10000")
    yield "parameters on the other side", ("parameters",), put(("parameters", "nu"), "1/5")
    for printed in ("0.448", "0.450", "0.4491", "0.5", "4.49"):
        path = ("parameters", "printed_s0")
        yield "printed digits changed", path, put(path, printed)
    yield "ratios dropped", ("parameters",), put(("parameters", "ratios"), None)


def both(edit: Edit) -> Edit:
    """Return an edit followed by renewed texts, where the parameters make sense at all."""

    def combined(document: Document) -> None:
        edit(document)
        renew_texts(document)

    return combined


def claims(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    entries = document["claims"]
    for index, claim in enumerate(entries):
        path = ("claims", index)
        for verdict in VERDICTS:
            if verdict != claim["verdict"]:
                yield "verdict changed", path, put((*path, "verdict"), verdict)
        said = claim["statement"]
        before = entries[index - 1]["statement"]
        for other in (said + " ", said[:-1], said.replace("f", "g"), said.lower(), "", before):
            if other != said:
                yield "statement changed", path, put((*path, "statement"), other)
        for other in (*FILES["horseshoe"], "H7", "", "h1"):
            if other != claim["id"]:
                yield "claim id changed", path, put((*path, "id"), other)
        yield "claim doubled", path, put(("claims",), [*entries, claim])
        yield "claim dropped", path, drop(path)
        for name in ("why", "witness", "corrected"):
            text = claim[name]
            others = [each[name] for each in entries if each[name] not in (text, None)]
            new = [*others[:1], "", *([text + " ", None] if text else ["x"])]
            for other in new:
                yield f"{name} changed", (*path, name), put((*path, name), other)
        for other in entries:
            if other["proof"] != claim["proof"] and other["verdict"] == "REFUTED":
                for kept in (other["proof"], claim["proof"] + other["proof"]):
                    given = put((*path, "proof"), list(dict.fromkeys(kept)))
                    yield "proof of another claim", path, given
    yield "claims emptied", ("claims",), put(("claims",), [])
    yield "claims reordered", ("claims",), put(("claims",), entries[::-1])


def chain(*edits: Edit) -> Edit:
    def combined(document: Document) -> None:
        for edit in edits:
            edit(document)

    return combined


def numbers(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for index, claim in enumerate(document["claims"]):
        base = ("claims", index, "quantities")
        for name, bounds in claim["quantities"].items():
            path = (*base, name)
            digits = len(bounds["lower"].partition(".")[2])
            ulp = Fraction(1, 10**digits)
            lower, upper = Fraction(bounds["lower"]), Fraction(bounds["upper"])

            def bound(side: str, value: Fraction, path: Any = path, digits: int = digits) -> Edit:
                return put((*path, side), fixed(value, digits))

            yield "quantity an ulp inward", path, bound("lower", lower + ulp)
            yield "quantity an ulp inward", path, bound("upper", upper - ulp)
            yield "quantity collapsed", path, bound("lower", upper)
            yield "quantity collapsed", path, bound("upper", lower)
            yield (
                "quantity moved",
                path,
                chain(bound("lower", lower + 1), bound("upper", upper + 1)),
            )
            gap = upper - lower + ulp
            yield "quantity moved", path, chain(bound("lower", lower - gap), bound("upper", lower))
            yield "quantity moved", path, chain(bound("lower", upper), bound("upper", upper + gap))
            yield "quantity reversed", path, bound("lower", upper + 1)
            yield "quantity outward", path, bound("lower", lower - ulp)
            yield "quantity outward", path, bound("upper", upper + LOT)
            yield "quantity dropped", path, drop(path)
            yield "quantity renamed", path, put((*base, "slope_of_nothing"), bounds)
            for other, entry in enumerate(document["claims"]):
                if name not in entry["quantities"] and entry["id"] != "H5":
                    place = ("claims", other, "quantities", name)
                    yield "quantity under another claim", place, put(place, bounds)


def fixed(value: Fraction, digits: int) -> str:
    scaled = round(value * 10**digits)
    whole, rest = divmod(abs(scaled), 10**digits)
    return f"{'-' * (scaled < 0)}{whole}.{rest:0{digits}}"


def correction(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for name, witness in steps(document, "staying-set"):
        base = ("steps", name, "witness")
        first, second = ((*base, "cells", k) for k in (0, 1))
        for side, domain in ((first, ["111/100", "23/20"]), (second, ["32/25", "33/25"])):
            edit = put((*side, "domain"), domain)
            yield "corrected sets changed, texts renewed", base, both(edit)
        yield "corrected sets swapped, texts renewed", base, both(swap(first, second))
        for region in ([["111/100", "33/25"]], [["11/10", "133/100"]], [["11/10", "13/10"]], []):
            edit = put((*base, "region"), region)
            yield "corrected interval changed, texts renewed", base, both(edit)
        for part in (witness["cells"][:1], [*witness["cells"], witness["cells"][0]], []):
            yield "corrected sets left out or doubled", base, both(put((*base, "cells"), part))
        yield "corrected gap changed", base, put((*base, "gaps", 0), witness["cells"][0]["slopes"])
        yield "corrected gap left out", base, both(put((*base, "gaps"), []))


def noncanonical(value: str) -> Iterator[str]:
    number = Fraction(value)
    yield f"{2 * number.numerator}/{2 * number.denominator}"
    yield from (f"+{value}", f" {value}", f"{value}\n", f"{value}/1", f"0{value}", f"{value}e0", "")
    yield from (f"{float(number)!r}e0", "-0", "nan", "inf", "0x10", "１", "1_0", "9" * 5000, "1/0")


def form(document: Document) -> Iterator[tuple[str, tuple[Any, ...], Edit]]:
    for path, value in walk(document):
        if isinstance(value, dict):
            yield "unknown field", path, put((*path, "extra"), "1")
            for key in value:
                if path[-1:] not in (("steps",), ("quantities",)):
                    yield "missing field", path, drop((*path, key))
        for other in (None, [], {}, True, [value], {"value": value}) if path else ():
            allowed = other is None and path[-1] == "ratios"
            allowed |= other == {} and path[-1] == "quantities"
            if other is None and path[-1] in RESTITUTION and value is not None:
                yield "restitution left out", path, put(path, other)
            elif other != value and not allowed:
                yield "other type", path, put(path, other)
        if isinstance(value, str) and is_number(value) and "quantities" not in path:
            for number in noncanonical(value):
                yield "number not canonical", path, put(path, number)
        if isinstance(value, str) and "quantities" in path:
            for number in (f"+{value}", f"{value}/1", f"{value}e0", f" {value}", "", "inf", "1/2"):
                yield "number not canonical", path, put(path, number)


def is_number(value: str) -> bool:
    try:
        Fraction(value)
    except ValueError:
        return False
    return value != "0.449"


def texts(document: Document) -> Iterator[tuple[str, str, str]]:
    """Yield (kind, where, text) of changes to the text itself."""
    whole = text_of(document)
    for share in range(1, 40):
        yield "truncated", f"{share}/40", whole[: len(whole) * share // 40]
    for old, new in (
        (f'"{SCHEMA}"', '"impact-proofs.certificate/1"'),
        (f'"{SCHEMA}"', '""'),
        ('"schema"', '"Schema"'),
    ):
        yield "other schema", new, whole.replace(old, new)
    for text in (
        "",
        "null",
        "[]",
        "{}",
        '"x"',
        "not JSON",
        "\x00",
        "﻿" + whole,
        whole + "x",
        whole[1:],
    ):
        yield "not a certificate", text[:9], text
    for depth in (10, 2000, 200_000):
        deep = "[" * depth + "]" * depth
        yield "nested deeply", f"{depth}", whole.replace('"0.449"', deep)
        yield "nested deeply", f"{depth}", deep
        yield "nested deeply", f"{depth}", '{"schema":' * depth
    for number in ("1", "-1", "1.5", "1e400", "NaN", "Infinity", "9" * 6000):
        for old in ('"2121/10000"', '"0.449"', '"8"'):
            yield "bare number", f"{old} {number[:9]}", whole.replace(old, number, 1)
    for path, value in walk(document):
        if isinstance(value, dict) and value:
            key = next(iter(value))
            marked = edited(document, put((*path, "MARK"), value[key])) if path else None
            text = marked or whole.replace("{", '{"MARK": "1",', 1)
            yield "duplicate field", str(path), text.replace('"MARK"', json.dumps(key))
    yield "too large", "spaces", whole + " " * 4_000_000


GROUPS = (brackets, pieces, flights, references, avoiding, roots)
GROUPS += (parameters, claims, numbers, correction, form)


def mutations(document: Document) -> Iterator[Mutation]:
    """Yield every mutation of a certificate."""
    for group in GROUPS:
        for kind, path, edit in group(document):
            yield Mutation(kind, ".".join(map(str, path)), partial(edited, document, edit))
    for kind, where, text in texts(document):
        yield Mutation(kind, where, partial(str, text))


# -- outcomes --------------------------------------------------------------------------------------


def outcome(text: str) -> tuple[str, str, Report | None]:
    """Return (accepted, rejected or malformed, the reason, the report)."""
    try:
        report = check(text)
    except Malformed as error:
        return "malformed", str(error), None
    except Rejected as error:
        return "rejected", str(error), None
    return "accepted", "", report


def tally(found: Iterable[Mutation], judge: Callable[[Mutation], str]) -> dict[str, Counter[str]]:
    """Count the outcomes of each kind."""
    counts: dict[str, Counter[str]] = {}
    for mutation in found:
        counts.setdefault(mutation.kind, Counter())[judge(mutation)] += 1
    return counts


def mutation_table(counts: dict[str, Counter[str]]) -> str:
    """Return how many mutations of each kind are refused, and how, as Markdown."""
    rows = ["| kind | rejected | malformed | still proves what it says |", "|---|---|---|---|"]
    total: Counter[str] = Counter()
    for kind, count in sorted(counts.items()):
        total += count
        rows.append(
            f"| {kind} | {count['rejected']} | {count['malformed']} | {count['accepted']} |"
        )
    sums = (total[key] for key in ("rejected", "malformed", "accepted"))
    return "\n".join([*rows, "| in all | {} | {} | {} |".format(*sums)])


if __name__ == "__main__":
    certificate = fresh()
    print(mutation_table(tally(mutations(certificate), lambda one: outcome(one.make())[0])))
