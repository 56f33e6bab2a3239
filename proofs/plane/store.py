"""The store of an atlas while it is made: one SQLite file, a row for each cell, one writer.

Rows of a chunk are written in one transaction: whatever ends a run, a cell is there whole or not
at all, and never twice. What is left to do follows from what is there. What is checked and read by
others are the lines that it writes.
"""

from __future__ import annotations

import json
import os
import sqlite3
import zlib
from collections.abc import Container, Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from proofs.trusted.atlas import DEEPEST, LEFT_OUT, NOT_YET, Region
from proofs.trusted.certificate import Malformed, texts
from proofs.trusted.verdicts import Verdict

NAME, LINES, SAMPLE = "atlas.sqlite", "atlas.jsonl", "sample.jsonl"
LEAVES = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED
_FEW = 10  # cells of a sample
SPLIT = "SPLIT"


class Row(NamedTuple):
    """A cell that was looked at: its verdict or SPLIT, and for a verdict what proves it.

    kind, conclusion: of the conclusion that decides it, the name and the words; where the cell is
    undecided, "" and why. certificate: packed. work: of its check. seconds: of all work on it.
    sets: what may help its neighbours.
    """

    key: str
    verdict: str
    kind: str = ""
    conclusion: str = ""
    certificate: bytes | None = None
    work: float = 0.0
    seconds: float = 0.0
    sets: str = ""

    @property
    def text(self) -> str:
        """The certificate."""
        return zlib.decompress(self.certificate or b"").decode()


_FIELDS = ", ".join(Row._fields)
_COLUMNS = _FIELDS.replace("key", "key TEXT PRIMARY KEY", 1)
_TABLES = f"""
PRAGMA journal_mode = WAL;
PRAGMA synchronous = NORMAL;
CREATE TABLE IF NOT EXISTS region (text TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS cells ({_COLUMNS});
"""  # WITHOUT ROWID would put each certificate on a page of its own, four times its size
_LEFT = """
WITH digits (digit) AS (VALUES ('0'), ('1'), ('2'), ('3'))
SELECT key || digit, sets FROM cells, digits WHERE verdict = ?
AND NOT EXISTS (SELECT 1 FROM cells AS there WHERE there.key = cells.key || digit)
"""


def file_of(key: str) -> str:
    """Return the name of the file that has a cell's certificate."""
    return f"cell-{key.replace('/', '-')}.json"


def quarters(key: str) -> list[str]:
    """Return the keys of the four quarters of a cell."""
    return [key + digit for digit in "0123"]


class Held(ValueError):
    """A store is not to be had: another run writes to it, or it is about another region."""


class Store:
    """An open store, held by this process."""

    def __init__(self, connection: sqlite3.Connection, region: Region) -> None:
        self._rows, self.region = connection, region

    def put(self, cells: Sequence[Row]) -> None:
        """Write the rows of a chunk, all or none."""
        places = ", ".join("?" * len(Row._fields))
        with self._rows:
            self._rows.executemany(f"INSERT INTO cells VALUES ({places})", cells)

    def reopen(self, depth: int) -> None:
        """Split what is undecided above a depth."""
        with self._rows:
            self._rows.execute(
                "UPDATE cells SET verdict = ?, conclusion = '' WHERE verdict = ? AND "
                "length(key) - instr(key, '/') < ?",
                (SPLIT, Verdict.UNDECIDED.value, depth),
            )

    def left(self) -> list[tuple[str, str]]:
        """Return the cells still to be looked at, with sets that may help: those of the parent."""
        roots = [(f"{i}/", "") for i in range(len(self.region.roots))]
        there = {key for (key,) in self._rows.execute("SELECT key FROM cells WHERE key LIKE '%/'")}
        below = self._rows.execute(_LEFT, (SPLIT,)).fetchall()
        return sorted([*(root for root in roots if root[0] not in there), *below])

    def cells(self, *verdicts: Verdict) -> Iterator[Row]:
        """Yield the rows of these verdicts, in order."""
        marks = ", ".join("?" * len(verdicts))
        query = f"SELECT {_FIELDS} FROM cells WHERE verdict IN ({marks}) ORDER BY key"
        yield from map(Row._make, self._rows.execute(query, [x.value for x in verdicts]))

    def row(self, key: str) -> Row | None:
        """Return the row of a cell, None where there is none."""
        entry = self._rows.execute(f"SELECT {_FIELDS} FROM cells WHERE key = ?", (key,)).fetchone()
        return None if entry is None else Row._make(entry)

    def total(self, column: str) -> float:
        """Return the sum over all rows, of `work` or `seconds`."""
        return float(self._rows.execute(f"SELECT total({column}) FROM cells").fetchone()[0])

    def sample(self) -> Iterator[str]:
        """Yield an atlas of a few proved cells, spread over all: the others are not looked at."""
        query = "SELECT key FROM cells WHERE certificate NOTNULL AND verdict != ? ORDER BY key"
        proved = [key for (key,) in self._rows.execute(query, (SPLIT,))]
        few = min(_FEW, len(proved))
        return self.lines([proved[k * len(proved) // few] for k in range(few)])

    def lines(self, only: Container[str] | None = None) -> Iterator[str]:
        """Yield the atlas: region, cells and what is not looked at yet, strip.

        only: the cells of which it says something; without it all.
        """
        yield f"{self.region.text}\n"
        full = 4**DEEPEST  # smallest cells, of which a part consists
        ended = 0
        for row in self.cells(*LEAVES):
            if only is not None and row.key not in only:
                continue
            number, _, path = row.key.partition("/")
            size = full >> 2 * len(path)
            begins = int(number) * full + int(f"0{path}", 4) * size
            yield from (self._line(Row(key, NOT_YET)) for key in _between(ended, begins))
            yield self._line(row)
            ended = begins + size
        count = len(self.region.roots)
        yield from (self._line(Row(key, NOT_YET)) for key in _between(ended, count * full))
        if count < len(self.region.parts):
            yield self._line(Row(f"{count}/", LEFT_OUT))

    def _line(self, row: Row) -> str:
        proof = None if row.certificate is None else json.loads(row.text)
        sides = map(texts, self.region.sides(row.key))
        values = row.key, *sides, row.verdict, row.kind, row.conclusion, proof
        held = dict(zip(self.region.fields, values, strict=True))
        return json.dumps(held, separators=(",", ":"), ensure_ascii=False) + "\n"


def _between(begin: int, end: int) -> Iterator[str]:
    """Yield the largest cells that lie one after the other from a place to another."""
    while begin < end:
        depth = 0
        while begin % (size := 4 ** (DEEPEST - depth)) or begin + size > end:
            depth += 1
        number, place = divmod(begin // size, 4**depth)
        yield f"{number}/" + "".join(f"{place >> 2 * k & 3}" for k in reversed(range(depth)))
        begin += size


@contextmanager
def opened(folder: Path, region: Region | None) -> Iterator[Store]:
    """Yield the store of a folder, held until the end; Held where it is not to be had.

    region: that of a new store, and of one that goes on; None for one that is there.
    """
    path = folder / NAME
    if region is None and not path.is_file():
        raise Held(f"there is no {path}")
    with _locked(folder), _told(path), closing(sqlite3.connect(path)) as connection:
        begun = None
        with suppress(sqlite3.OperationalError):  # no table yet
            begun = connection.execute("SELECT text FROM region").fetchone()
        own = region if begun is None else _read(path, str(begun[0]))
        if own is None:
            raise Held(f"{path} has no region: its run ended before it began")
        if region not in (None, own):
            raise Held(f"{path} is about another region or question: choose a folder by --out")
        connection.executescript(_TABLES)
        if begun is None:
            with connection:
                connection.execute("INSERT INTO region VALUES (?)", (own.text,))
        yield Store(connection, own)
        with suppress(sqlite3.OperationalError):  # another program reads it just now
            connection.execute("PRAGMA journal_mode = DELETE")  # one file again


def _read(path: Path, text: str) -> Region:
    try:
        return Region.read(text)
    except Malformed as error:
        raise Held(f"{path} is of another version ({error}): make it anew elsewhere") from None


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Turn what SQLite says, of a full disk or a file that is no store, into one line."""
    try:
        yield
    except sqlite3.Error as error:
        raise Held(f"{path}: {error}") from None


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Hold a store's lock; Held at once where another process does."""
    handle = os.open(folder / f".{NAME}.lock", os.O_RDWR | os.O_CREAT)
    try:
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                raise Held(f"another run writes to {folder / NAME}") from None
        yield
    finally:
        os.close(handle)
