"""The store of an atlas: one SQLite file, a row for each cell, one writer at a time.

Rows of a chunk are written in one transaction: whatever ends a run, a cell is there whole or not
at all, and never twice. What is left to do follows from what is there.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from pathlib import Path

from proofs.trusted.atlas import SPLIT, Cell, Region
from proofs.trusted.verdicts import Verdict

NAME = "atlas.sqlite"
_FIELDS = ", ".join(Cell._fields)
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


def quarters(key: str) -> list[str]:
    """Return the keys of the four quarters of a cell."""
    return [key + digit for digit in "0123"]


class Held(ValueError):
    """A store is not to be had: another run writes to it, or it is about another region."""


class Store:
    """An open store, held by this process."""

    def __init__(self, connection: sqlite3.Connection, region: Region) -> None:
        self._rows, self.region = connection, region

    def put(self, cells: Sequence[Cell]) -> None:
        """Write the rows of a chunk, all or none."""
        places = ", ".join("?" * len(Cell._fields))
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

    def cells(self, *verdicts: Verdict) -> Iterator[Cell]:
        """Yield the rows of these verdicts, in order."""
        marks = ", ".join("?" * len(verdicts))
        query = f"SELECT {_FIELDS} FROM cells WHERE verdict IN ({marks}) ORDER BY key"
        yield from map(Cell._make, self._rows.execute(query, [x.value for x in verdicts]))

    def rows(self) -> Iterator[Cell]:
        """Yield all rows, in order."""
        yield from map(Cell._make, self._rows.execute(f"SELECT {_FIELDS} FROM cells ORDER BY key"))

    def costs(self) -> Iterator[tuple[str, str, float]]:
        """Yield key, verdict and seconds of all rows."""
        yield from self._rows.execute("SELECT key, verdict, seconds FROM cells")

    def seconds(self) -> float:
        """Return the work on all cells."""
        return float(self._rows.execute("SELECT total(seconds) FROM cells").fetchone()[0])


@contextmanager
def opened(folder: Path, region: Region | None) -> Iterator[Store]:
    """Yield the store of a folder, held until the end; Held where it is not to be had.

    region: that of a new store, and of one that goes on; None for one that is there.
    """
    path = folder / NAME
    if region is None and not path.is_file():
        raise Held(f"there is no {path}")
    with _locked(folder), _told(path), closing(sqlite3.connect(path)) as connection:
        connection.executescript(_TABLES)
        known = connection.execute("SELECT text FROM region").fetchone()
        if known is None and region is not None:
            with connection:
                connection.execute("INSERT INTO region VALUES (?)", (region.text,))
            known = (region.text,)
        if known is None:
            raise Held(f"{path} has no region: its run ended before it began")
        own = Region.of(str(known[0]))
        if region not in (None, own):
            raise Held(f"{path} is about another region or question")
        yield Store(connection, own)
        with suppress(sqlite3.OperationalError):  # it is read just now, as by the checker
            connection.execute("PRAGMA journal_mode = DELETE")  # one file again


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
