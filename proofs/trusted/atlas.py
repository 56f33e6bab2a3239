"""An atlas: a region of (eta, nu) in cells, each with what is proved at all oscillators of it.

A region is cut where eta = 1 and nu = 0, and its parts, the roots, are numbered; a cell is a root
or a quarter of a cell: "0/", "0/3", "0/31", ... A quarter's digit is 1 for the upper half of eta,
and 2 more for the upper half of nu. The store is an SQLite file with the tables `region` and
`cells`; it is read, and each cell proved again, as a manifest's files are.
"""

from __future__ import annotations

import json
import sqlite3
import zlib
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import closing
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from hashlib import sha256
from itertools import pairwise, product
from pathlib import Path
from typing import Any, NamedTuple

from proofs.trusted.certificate import MAX_BYTES, Malformed, parse, schema_of, texts
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.numbers import Range, show_range
from proofs.trusted.parameters import Place
from proofs.trusted.questions import Question, question
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check

SCHEMA = "impact-proofs.atlas/1"
SPLIT = "SPLIT"
DEEPEST = 40


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

    @property
    def roots(self) -> list[Place]:
        """The parts between the lines eta = 1 and nu = 0; of those at nu = 0, all but a strip.

        The strip is 2^-20 times as wide as its part.
        """
        etas, nus = _cut(self.eta, Fraction(1)), []
        for low, high in _cut(self.nu, Fraction(0)):
            strip = (high - low) / 2**20
            nus.append((low + strip * (low == 0), high - strip * (high == 0)))
        return [Place(eta, nu, self.epsilon) for nu, eta in product(nus, etas)]

    def box(self, key: str) -> Place:
        """Return the box of a cell; Malformed where it is none."""
        number, slash, path = key.partition("/")
        roots = {f"{i}": root for i, root in enumerate(self.roots)}
        if not slash or number not in roots or not set(path) <= set("0123") or len(path) > DEEPEST:
            raise Malformed(f"no cell: {key[:60]!r}")
        parts = 2 ** len(path)
        sides = []
        for bit, (low, high) in enumerate((roots[number].eta, roots[number].nu)):
            index = int("0" + "".join(str(int(digit) >> bit & 1) for digit in path), 2)
            unit = (high - low) / parts
            sides.append((low + unit * index, low + unit * (index + 1)))
        return Place(sides[0], sides[1], self.epsilon)

    @property
    def text(self) -> str:
        """The region as it is stored."""
        sides = {"eta": texts(self.eta), "nu": texts(self.nu)}
        more = {} if self.epsilon is None else {"epsilon": texts(self.epsilon)}
        return json.dumps({"schema": SCHEMA, **sides, "question": self.question, **more})

    @classmethod
    def of(cls, text: str) -> Region:
        """Read what is stored."""
        if schema_of(text) != SCHEMA:
            raise Malformed(f"$.schema: the schema is not {SCHEMA!r}")
        stored = parse(text)
        more = ["epsilon"] if stored.has("epsilon") else []
        _, eta, nu, name, *rest = stored.fields("schema", "eta", "nu", "question", *more)
        try:
            return cls(eta.range(), nu.range(), name.string(), *(each.range() for each in rest))
        except Malformed:
            raise
        except ValueError as error:
            raise Malformed(str(error)) from None


def _cut(side: Range, at: Fraction) -> list[Range]:
    ends = [side[0], *([at] if side[0] < at < side[1] else []), side[1]]
    return list(pairwise(ends))


def area(box: Place) -> Fraction:
    """Return the area of a box."""
    return (box.eta[1] - box.eta[0]) * (box.nu[1] - box.nu[0])


# -- cells -----------------------------------------------------------------------------------------


class Cell(NamedTuple):
    """A row of the store: a cell, its verdict or SPLIT, and for a verdict what proves it.

    kind, conclusion: of the conclusion that decides it, the name and the words; where the cell is
    undecided, "" and why. seconds: of work on it. sets: what may
    help its neighbours.
    """

    key: str
    eta: str
    nu: str
    verdict: str
    kind: str
    conclusion: str
    certificate: bytes | None
    sha256: str | None
    seconds: float
    sets: str


def cell(region: Region, key: str, source: str, work: float = DEFAULT) -> Cell:
    """Check a cell's certificate, and return the row; Rejected where it answers nothing here."""
    box, report = region.box(key), check(source, work)
    if report.parameters != box:
        raise Rejected(f"cell {key}: the certificate is about other parameters")
    verdict = region.asked.verdict(report.conclusions)
    if verdict is Verdict.UNDECIDED:
        raise Rejected(f"cell {key}: the certificate does not answer the question")
    packed = source.encode()
    return without_proof(region, key, verdict.value, report.sentences[0])._replace(
        kind=report.conclusions[0].kind,
        certificate=zlib.compress(packed),
        sha256=sha256(packed).hexdigest(),
    )


def without_proof(region: Region, key: str, verdict: str, why: str) -> Cell:
    """Return the row of a cell that is split or undecided."""
    box = region.box(key)
    sides = show_range(box.eta), show_range(box.nu)
    return Cell(key, *sides, verdict, "", why, None, None, 0.0, "")


def check_cell(region: Region, work: float, row: tuple[Any, ...]) -> tuple[str, Fraction]:
    """Re-derive a row of the store; return its verdict and its area.

    Raises Malformed or Rejected where it is not what its certificate proves.
    """
    given = Cell(*row)
    if not isinstance(given.key, str):
        raise Malformed("a cell without a key")
    if given.verdict in (SPLIT, Verdict.UNDECIDED.value):
        own = without_proof(region, given.key, given.verdict, given.conclusion)
    else:
        own = cell(region, given.key, unpacked(given), work)
    own = own._replace(certificate=given.certificate if own.certificate else None)
    if own._replace(seconds=given.seconds, sets=given.sets) != given:
        raise Rejected(f"cell {given.key}: its certificate proves something else")
    return given.verdict, area(region.box(given.key))


def unpacked(given: Cell) -> str:
    """Return a cell's certificate."""
    try:
        reader = zlib.decompressobj()
        content = reader.decompress(given.certificate or b"", MAX_BYTES)
        if not reader.eof:
            raise Malformed(f"cell {given.key}: no whole certificate")
        return content.decode()
    except (zlib.error, TypeError, UnicodeDecodeError):
        raise Malformed(f"cell {given.key}: no certificate") from None


# -- the store -------------------------------------------------------------------------------------


class Areas(NamedTuple):
    """How many cells have each verdict, and their area; whole: of the region, without strips."""

    cells: Counter[str]
    areas: Counter[str]
    whole: Fraction

    @property
    def missing(self) -> Fraction:
        """The area of what is not looked at yet."""
        return self.whole - sum(self.areas.values())


Mapped = Callable[[Callable[[tuple[Any, ...]], Any], Iterable[tuple[Any, ...]]], Iterable[Any]]


def check_store(path: Path, work: float = DEFAULT, mapped: Mapped = map) -> Areas:
    """Re-derive all cells of a store, each from its certificate; return what is proved where.

    A cell that is no root is a quarter of one that is split, so that cells do not overlap.
    mapped: what applies a function to rows, as `map` does. Raises Malformed or Rejected.
    """
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as store:
            rows = store.execute("SELECT text FROM region").fetchall()
            if len(rows) != 1:
                raise Malformed("a store is about one region")
            region = Region.of(str(rows[0][0]))
            if orphan := store.execute(_ORPHANS).fetchone():
                raise Rejected(f"cell {orphan[0]}: no quarter of a cell that is split")
            cells, areas = Counter[str](), Counter[str]()
            every = store.execute(f"SELECT {', '.join(Cell._fields)} FROM cells ORDER BY key")
            for verdict, size in mapped(partial(check_cell, region, work), every):
                cells[verdict] += 1
                areas[verdict] += 0 if verdict == SPLIT else size
    except sqlite3.Error as error:
        raise Malformed(f"no atlas: {error}") from None
    return Areas(cells, areas, sum(map(area, region.roots), Fraction(0)))


_ORPHANS = (
    "SELECT key FROM cells WHERE substr(key, -1) != '/' AND substr(key, 1, length(key) - 1) "
    f"NOT IN (SELECT key FROM cells WHERE verdict = '{SPLIT}') LIMIT 1"
)
