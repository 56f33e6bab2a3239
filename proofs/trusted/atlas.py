"""An atlas: a region of two parameters in cells, each with what is proved at all points of it.

The parameters are eta and nu of the paper's oscillator; or any two of a map or of a system that
functions give, as certificates have them. A region is cut where its kind of system changes: the
oscillator's at eta = 1 and nu = 0. Its parts are numbered, the last one being the strip that is
left out around nu = 0, if there is one. A cell is a part, "0/", or a quarter of a cell: "0/3",
"0/31", ... A quarter's digit is 1 for the upper half of the first parameter, and 2 more for the
upper half of the second.

An atlas is a file of lines, each a JSON object in the form of certificates. The first one has
`schema`, `question` and, of the oscillator, `eta`, `nu`, and `epsilon` where impacts are not
plastic; of other systems `parameters`, the two ranges by name, `functions`, which of them is asked
about, `function`, and `region`, where it was looked for orbits: on that no theorem depends. Then
come the cells, those that are not cut, in the order of their keys: `cell` (the key), the box by the
names of the parameters, `verdict`, `kind` and `says` (of the conclusion that decides it, the name
and the words), and `certificate`. Without one a cell is undecided, not looked at, or left out;
`says` may tell why.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from itertools import pairwise, product
from typing import NamedTuple

from proofs.trusted.certificate import Malformed, Reader, parse
from proofs.trusted.kernel.meter import DEFAULT, METER, metered
from proofs.trusted.numbers import Range
from proofs.trusted.questions import Question
from proofs.trusted.subjects import PLASTIC, Box, Oscillators, Subject, Systems
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check_document

SCHEMA = "impact-proofs.atlas/2"
_BEFORE, _AFTER = ("cell",), ("verdict", "kind", "says", "certificate")
NOT_YET, LEFT_OUT = "not looked at", "left out"
DEEPEST = 40
_WORK = 100  # on a cell, beside its certificate


# -- the region and its cells ----------------------------------------------------------------------


@dataclass(frozen=True)
class Region:
    """The ranges of two parameters, what is asked there, and of which systems."""

    first: Range
    second: Range
    question: str
    subject: Subject = PLASTIC

    def __post_init__(self) -> None:
        """Raise ValueError, one line, where there is nothing to look at."""
        for name, (low, high) in zip(self.names, self.sides_of, strict=True):
            if low >= high:
                raise ValueError(f"{name}: reversed or empty range")
            if name in (*_BEFORE, *_AFTER):
                raise ValueError(f"a parameter of an atlas is not named {name!r}, as a column is")
        self.subject.require(self.first, self.second, self.question)

    @property
    def names(self) -> tuple[str, str]:
        """The names of the parameters."""
        return self.subject.names

    @property
    def fields(self) -> tuple[str, ...]:
        """The fields of a cell's line."""
        return (*_BEFORE, *self.names, *_AFTER)

    @property
    def sides_of(self) -> Box:
        """Both ranges."""
        return self.first, self.second

    @property
    def asked(self) -> Question:
        """What is asked."""
        return self.subject.question(self.question)

    @cached_property
    def roots(self) -> list[Box]:
        """The parts between the cuts; next to one of the second parameter, all but a strip.

        The strip is 2^-20 times as wide as its part.
        """
        at, zero = self.subject.cuts
        firsts, seconds = _cut(self.first, at), []
        for low, high in _cut(self.second, zero):
            strip = (high - low) / 2**20
            seconds.append((low + strip * (low == zero), high - strip * (high == zero)))
        return [(one, two) for two, one in product(seconds, firsts)]

    @cached_property
    def parts(self) -> list[Box]:
        """The roots, and the strip beside them: together the region."""
        zero = self.subject.cuts[1]
        if zero is None or not self.second[0] <= zero <= self.second[1]:
            return self.roots
        (_, first), (_, last) = self.roots[0], self.roots[-1]
        return [*self.roots, (self.first, (min(first[1], zero), max(last[0], zero)))]

    def sides(self, key: str) -> Box:
        """Return the box of a cell, which may be the strip; Malformed where there is none."""
        number, slash, path = key.partition("/")
        parts = {f"{i}": part for i, part in enumerate(self.parts)}
        deepest = 0 if number == f"{len(self.roots)}" else DEEPEST
        if not slash or number not in parts or not set(path) <= set("0123") or len(path) > deepest:
            raise Malformed(f"no cell: {key[:60]!r}")
        count, sides = 2 ** len(path), []
        for bit, (low, high) in enumerate(parts[number]):
            index = int("0" + "".join(str(int(digit) >> bit & 1) for digit in path), 2)
            unit = (high - low) / count
            sides.append((low + unit * index, low + unit * (index + 1)))
        return sides[0], sides[1]

    @property
    def text(self) -> str:
        """The region as it is written."""
        held = {"schema": SCHEMA, **self.subject.written(self.sides_of, self.question)}
        return json.dumps(held, separators=(",", ":"), ensure_ascii=False)

    @classmethod
    def read(cls, text: str) -> Region:
        """Read what is written."""
        document = parse(text)
        kind = Systems if document.has("functions") else Oscillators
        try:
            schema, first, second, asked, subject = kind.read(document)
            if schema != SCHEMA:
                raise document.fail(f"the schema is not {SCHEMA!r}")
            return cls(first, second, asked, subject)
        except ValueError as error:
            raise error if isinstance(error, Malformed) else Malformed(str(error)) from None


def _cut(side: Range, at: Fraction | None) -> list[Range]:
    is_cut = at is not None and side[0] < at < side[1]
    ends = [side[0], *([at] if is_cut and at is not None else []), side[1]]
    return list(pairwise(ends))


def area(box: Box) -> Fraction:
    """Return the area of a box."""
    (left, right), (low, high) = box
    return (right - left) * (high - low)


# -- the check -------------------------------------------------------------------------------------


def proved(region: Region, key: str, certificate: Reader) -> tuple[str, str, str]:
    """Return verdict, kind and words of a cell whose certificate proves this.

    Raises Rejected where that answers nothing here: it must be about the cell's box, and say one
    thing, which decides the question.
    """
    report = check_document(certificate)
    if not region.subject.is_about(certificate, report, region.sides(key)):
        raise Rejected(f"cell {key}: the certificate is about other parameters")
    verdict = region.asked.verdict(report.conclusions)
    if verdict is Verdict.UNDECIDED:
        raise Rejected(f"cell {key}: the certificate does not answer the question")
    return verdict.value, report.conclusions[0].kind, report.sentences[0]


def check_cell(region: Region, numbered: tuple[int, str]) -> tuple[str, str]:
    """Re-derive a line of an atlas, given with its number; return the cell and its verdict.

    Raises Malformed or Rejected where it is not what its certificate proves.
    """
    number, line = numbered
    METER.get().spend(_WORK)
    try:
        key_of, one, two, *said, certificate = parse(line).fields(*region.fields)
        key, (verdict, kind, says) = key_of.string(), (each.string() for each in said)
        if (one.range(), two.range()) != region.sides(key):
            raise Rejected(f"cell {key}: its box is another one")
        is_strip = key == f"{len(region.roots)}/"
        if is_strip or certificate.is_null():
            may_be = [LEFT_OUT] if is_strip else [Verdict.UNDECIDED.value, NOT_YET]
            if verdict not in may_be or kind or not certificate.is_null():
                raise Rejected(f"cell {key}: nothing proves what it says")
        elif (verdict, kind, says) != proved(region, key, certificate):
            raise Rejected(f"cell {key}: its certificate proves something else")
    except (Malformed, Rejected) as error:
        raise type(error)(f"line {number}: {error}") from None
    return key, verdict


class Areas(NamedTuple):
    """How many cells have each verdict, and their share of the region's area."""

    cells: Counter[str]
    shares: dict[str, Fraction]


def check_atlas(
    lines: Iterable[str],
    work: int = DEFAULT,
    mapped: Callable[..., Iterable[tuple[str, str]]] = map,
) -> Areas:
    """Re-derive all cells of an atlas, each from its certificate; return what is proved where.

    A cell begins where the one before it ended, in the order of the keys, and the last one ends the
    last part: so no cell lies in another, and in each part their areas add up to its own. Of what
    is read nothing is kept.
    mapped: what applies a function to lines, as `map` does. Raises Malformed, Rejected, Exhausted.
    """
    with metered(work):
        unread = iter(lines)
        region = Region.read(next(unread, ""))
        cells, areas = Counter[str](), Counter[tuple[str, int]]()
        ended = 0  # in units of the smallest cells, `full` of which are a part
        full = 4**DEEPEST
        for key, verdict in mapped(partial(check_cell, region), enumerate(unread, 2)):
            number, _, path = key.partition("/")
            size = full >> 2 * len(path)
            if int(number) * full + int("0" + path, 4) * size != ended:
                raise Rejected(f"cell {key}: it does not begin where the one before it ended")
            ended += size
            cells[verdict] += 1
            areas[verdict, int(number)] += size
        if ended != len(region.parts) * full:
            raise Rejected("cells are missing at the end")
    shares = dict.fromkeys(cells, Fraction(0))
    for (verdict, part), count in areas.items():
        shares[verdict] += Fraction(count, full) * area(region.parts[part])
    whole = area(region.sides_of)
    return Areas(cells, {verdict: share / whole for verdict, share in shares.items()})
