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
CREATE TABLE IF NOT EXISTS cells ({_COLUMNS}) WITHOUT ROWID;
"""


def quarters(key: str) -> list[str]:
    """Return the keys of the four quarters of a cell."""
    return [key + digit for digit in "0123"]


class Held(ValueError):
    """Another run writes to the store, or it is about another region."""


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
        done = dict(self._rows.execute("SELECT key, sets FROM cells WHERE verdict = ?", (SPLIT,)))
        keys = {f"{i}/": "" for i in range(len(self.region.roots))}
        keys.update((child, sets) for key, sets in done.items() for child in quarters(key))
        there = {key for (key,) in self._rows.execute("SELECT key FROM cells")}
        return sorted((key, sets) for key, sets in keys.items() if key not in there)

    def cells(self, *verdicts: Verdict) -> Iterator[Cell]:
        """Yield the rows of these verdicts, in order."""
        marks = ", ".join("?" * len(verdicts))
        query = f"SELECT {_FIELDS} FROM cells WHERE verdict IN ({marks}) ORDER BY key"
        yield from map(Cell._make, self._rows.execute(query, [x.value for x in verdicts]))

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
    with _locked(folder), closing(sqlite3.connect(path)) as connection:
        connection.executescript(_TABLES)
        known = connection.execute("SELECT text FROM region").fetchone()
        if known is None and region is not None:
            with connection:
                connection.execute("INSERT INTO region VALUES (?)", (region.text,))
            known = (region.text,)
        own = Region.of(str(known[0])) if known else None
        if own is None or region not in (None, own):
            raise Held(f"{path} is about another region or question")
        yield Store(connection, own)
        connection.execute("PRAGMA journal_mode = DELETE")  # one file again, to be read anywhere


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
