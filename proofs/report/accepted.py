"""Which claims have a theorem from Coq: a committed record of what coqc accepted.

An entry is about one certificate and one text of the theory, by their digests; where either is
another now, it says nothing. So it says the same where there is no coqc. It is no proof: who doubts
it runs `python -m proofs formal`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

from proofs.trusted.files import digest, render

THEORY = Path(__file__).parents[1] / "formal" / "theory"
RECORD = THEORY.parent / "accepted.json"


class Accepted(NamedTuple):
    """The theorems, by their names in Coq, that decide a claim; the certificate they are from."""

    file: str
    theorems: tuple[str, ...]


def accepted(certificates: Iterable[str], record: Path = RECORD) -> dict[str, Accepted]:
    """Return for each claim that one of these certificates decides in Coq what coqc accepted."""
    digests, theory = {digest(text) for text in certificates}, digest_of_theory()
    return {
        claim: Accepted(file, tuple(theorems))
        for file, entry in _entries(record).items()
        if entry["certificate"] in digests and entry["theory"] == theory
        for claim, theorems in entry["claims"].items()
    }


def recorded(file: str, source: str, claims: Mapping[str, list[str]], record: Path = RECORD) -> str:
    """Return the record with what coqc has just accepted of a certificate, without the stale."""
    theory = digest_of_theory()
    entry = {"certificate": digest(source), "theory": theory, "claims": claims}
    kept = {name: each for name, each in _entries(record).items() if each["theory"] == theory}
    return render(dict(sorted({**kept, file: entry}.items())))


def digest_of_theory() -> str:
    """Return the digest of all files of the theory."""
    theory = sha256()
    for path in sorted(THEORY.glob("*.v")):
        theory.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return theory.hexdigest()


def _entries(record: Path) -> dict[str, Any]:
    entries: dict[str, Any] = json.loads(record.read_text(encoding="utf-8"))
    return entries
