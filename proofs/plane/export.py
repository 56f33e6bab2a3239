"""The cells of an atlas as a Parquet file, for tables of other programs; by pyarrow.

Columns: key, verdict, kind, conclusion, eta and nu (exact, as text; the ends as binary64, too),
seconds, certificate (JSON) and its sha256. The region is in the file's metadata, as `atlas`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from proofs.plane.store import Store
from proofs.plane.summary import LEAVES
from proofs.trusted.atlas import Cell, Region, unpacked

_AT_A_TIME = 2000  # rows of a group, and in memory
_TEXTS = "key", "verdict", "kind", "conclusion", "eta", "nu", "certificate", "sha256"
_NUMBERS = "eta_from", "eta_to", "nu_from", "nu_to", "seconds"


def export(store: Store, path: Path) -> int:
    """Write all cells, but those that are cut, to a file, whole or not at all; return how many."""
    import pyarrow as pa
    from pyarrow import parquet

    fields = [(name, pa.string()) for name in _TEXTS] + [(name, pa.float64()) for name in _NUMBERS]
    schema = pa.schema(fields, metadata={"atlas": store.region.text})
    part = path.parent / f".{path.name}.{os.getpid()}.part"
    count = 0
    try:
        with parquet.ParquetWriter(part, schema, compression="zstd") as file:
            for rows in _groups(store):
                file.write_table(pa.Table.from_pylist(rows, schema=schema))
                count += len(rows)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    return count


def _groups(store: Store) -> Iterator[list[dict[str, Any]]]:
    cells = store.cells(*LEAVES)
    while rows := [_row(store.region, cell) for cell in islice(cells, _AT_A_TIME)]:
        yield rows


def _row(region: Region, cell: Cell) -> dict[str, Any]:
    box = region.box(cell.key)
    ends = {"eta": box.eta, "nu": box.nu}
    floats = {
        f"{name}_{end}": float(value)
        for name, side in ends.items()
        for end, value in zip(("from", "to"), side, strict=True)
    }
    proof = None if cell.certificate is None else unpacked(cell)
    return {**cell._asdict(), **floats, "certificate": proof}
