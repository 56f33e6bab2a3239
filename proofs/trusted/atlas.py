"""An atlas: a region of (eta, nu) in cells, each with what is proved at all oscillators of it.

A region is cut where eta = 1 and nu = 0; its parts are numbered, the last one being the strip that
is left out around nu = 0, if there is one. A cell is a part, "0/", or a quarter of a cell: "0/3",
"0/31", ... A quarter's digit is 1 for the upper half of eta, and 2 more for the upper half of nu.

An atlas is a file of lines, each a JSON object in the form of certificates. The first one has
`schema`, `eta`, `nu`, `question`, and `epsilon` where impacts are not plastic. Then come the cells,
those that are not cut, in the order of their keys: `cell` (the key), `eta` and `nu` (its box),
`verdict`, `kind` and `says` (of the conclusion that decides it, the name and the words), and
`certificate`. Without one a cell is undecided, not looked at, or left out; `says` may tell why.
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

from proofs.trusted.certificate import Malformed, parse, texts
from proofs.trusted.kernel.meter import DEFAULT, METER, metered
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place
from proofs.trusted.questions import Question, question
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, Report, check_document

SCHEMA = "impact-proofs.atlas/2"
FIELDS = ("cell", "eta", "nu", "verdict", "kind", "says", "certificate")
NOT_YET, LEFT_OUT = "not looked at", "left out"
DEEPEST = 40
_WORK = 100  # on a cell, beside its certificate
Box = tuple[Range, Range]


# -- the region and its cells ----------------------------------------------------------------------


@dataclass(frozen=True)
class Region:
    """The parameters of an atlas, and what is asked there; epsilon as in `Place`."""

    eta: Range
    nu: Range
    question: str
    epsilon: Range | None = None

    def __post_init__(self) -> None:
        """Raise ValueError, one line, where there is nothing to look at."""
        for name, (low, high) in (("eta", self.eta), ("nu", self.nu)):
            if low >= high:
                raise ValueError(f"{name}: reversed or empty range")
        if self.eta[0] <= 0:
            raise ValueError("eta must be positive")
        asked, (least, most) = self.asked, self.epsilon or (Fraction(0),) * 2
        if not 0 <= least <= most < 1:
            raise ValueError("epsilon: a number or a range in [0, 1) is expected")
        if self.epsilon is not None and asked.plastic:
            raise ValueError(f"{self.question} is asked for plastic impacts alone, without epsilon")

    @property
    def asked(self) -> Question:
        """What is asked."""
        return question(self.question)

    @cached_property
    def roots(self) -> list[Box]:
        """The parts between the lines eta = 1 and nu = 0; of those at nu = 0, all but a strip.

        The strip is 2^-20 times as wide as its part.
        """
        etas, nus = _cut(self.eta, Fraction(1)), []
        for low, high in _cut(self.nu, Fraction(0)):
            strip = (high - low) / 2**20
            nus.append((low + strip * (low == 0), high - strip * (high == 0)))
        return [(eta, nu) for nu, eta in product(nus, etas)]

    @cached_property
    def parts(self) -> list[Box]:
        """The roots, and the strip beside them: together the region."""
        if not self.nu[0] <= 0 <= self.nu[1]:
            return self.roots
        zero, (_, first), (_, last) = Fraction(0), self.roots[0], self.roots[-1]
        return [*self.roots, (self.eta, (min(first[1], zero), max(last[0], zero)))]

    def sides(self, key: str) -> Box:
        """Return eta and nu of a cell, which may be the strip; Malformed where there is none."""
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

    def box(self, key: str) -> Place:
        """Return the oscillators of a cell; Malformed where there is none, Unproved for a strip."""
        return Place(*self.sides(key), self.epsilon)

    @property
    def text(self) -> str:
        """The region as it is written."""
        sides = {"eta": texts(self.eta), "nu": texts(self.nu)}
        more = {} if self.epsilon is None else {"epsilon": texts(self.epsilon)}
        held = {"schema": SCHEMA, **sides, "question": self.question, **more}
        return json.dumps(held, separators=(",", ":"))

    @classmethod
    def of(cls, text: str) -> Region:
        """Read what is written."""
        document = parse(text)
        more = ["epsilon"] if document.has("epsilon") else []
        schema, eta, nu, name, *rest = document.fields("schema", "eta", "nu", "question", *more)
        if schema.string() != SCHEMA:
            raise schema.fail(f"the schema is not {SCHEMA!r}")
        try:
            return cls(eta.range(), nu.range(), name.string(), *(each.range() for each in rest))
        except ValueError as error:
            raise error if isinstance(error, Malformed) else Malformed(str(error)) from None


def _cut(side: Range, at: Fraction) -> list[Range]:
    ends = [side[0], *([at] if side[0] < at < side[1] else []), side[1]]
    return list(pairwise(ends))


def area(box: Box) -> Fraction:
    """Return the area of a box."""
    (left, right), (low, high) = box
    return (right - left) * (high - low)


# -- the check -------------------------------------------------------------------------------------


def proved(region: Region, key: str, report: Report) -> tuple[str, str, str]:
    """Return verdict, kind and words of a cell whose certificate proves this.

    Raises Rejected where that answers nothing here: it must be about the cell's box, and say one
    thing, which decides the question.
    """
    if report.parameters != region.box(key):
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
        key_of, eta, nu, *said, certificate = parse(line).fields(*FIELDS)
        key, (verdict, kind, says) = key_of.string(), (each.string() for each in said)
        if (eta.range(), nu.range()) != region.sides(key):
            raise Rejected(f"cell {key}: its box is another one")
        is_strip = key == f"{len(region.roots)}/"
        if is_strip or certificate.is_null():
            may_be = [LEFT_OUT] if is_strip else [Verdict.UNDECIDED.value, NOT_YET]
            if verdict not in may_be or kind or not certificate.is_null():
                raise Rejected(f"cell {key}: nothing proves what it says")
        elif (verdict, kind, says) != proved(region, key, check_document(certificate)):
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
    work: float = DEFAULT,
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
        region = Region.of(next(unread, ""))
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
    whole = area((region.eta, region.nu))
    return Areas(cells, {verdict: share / whole for verdict, share in shares.items()})
