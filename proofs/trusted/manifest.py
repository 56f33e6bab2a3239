"""MANIFEST.json against the files that it lists."""

from __future__ import annotations

from pathlib import Path

from proofs.trusted.certificate import digest, parse, read
from proofs.trusted.verify import Checked, Rejected, check


def check_manifest(source: str, folder: Path, work: float) -> str:
    """Check every file that a manifest lists, and its entries; return what was found, in a line.

    Raises Malformed or Rejected where a file is not accepted, its digest is another one, or it
    does not prove a claim with the verdict and the statement that are listed.
    """
    _, claims_of, files_of = parse(source).fields("schema", "claims", "files")
    proved: dict[str, tuple[str, dict[str, Checked]]] = {}
    for name, entry in files_of.entries():
        if Path(name).name != name:
            raise entry.fail("not the name of a file in the same folder")
        try:
            text = read(folder / name)
        except OSError as error:
            raise Rejected(f"{entry.path}: cannot be read: {error.strerror}") from None
        proved[name] = digest(text), {claim.id: claim for claim in check(text, work).claims}
    count = 0
    for claim, entry in claims_of.members():
        verdict, statement, file, own, _, _ = entry.fields(
            "verdict", "statement", "file", "digest", "made", "checked"
        )
        if file.string() not in proved:
            raise file.fail("names no file of the list")
        true_digest, found = proved[file.string()]
        if own.string() != true_digest:
            raise Rejected(f"{own.path}: the file has the digest {true_digest}")
        if claim not in found or found[claim].verdict.value != verdict.string():
            raise Rejected(f"{verdict.path}: the file does not prove this")
        if found[claim].statement != statement.string():
            raise Rejected(f"{statement.path}: the file proves another statement")
        count += 1
    return f"{count} claims in {len(proved)} files, all as listed"
