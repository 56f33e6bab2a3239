"""MANIFEST.json: for each file the claims that it settles, its digest, and the two commands.

The commands make the certificate, and check it in the folder where it lies. The same certificates
always are the same bytes here: nothing tells when or where they were made.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from proofs.shell.groups import FILES
from proofs.trusted.certificate import MANIFEST, Reader, parameters_from_json
from proofs.trusted.files import digest, render
from proofs.trusted.manifest import checking, command

NAME = "MANIFEST.json"


def entered(folder: Path, certificates: Mapping[str, str]) -> str:
    """Return the folder's manifest with certificates, by the names of their files, entered.

    Entries about other files stay; a manifest that cannot be read is replaced.
    """
    files = _existing(folder)
    files |= {name: _entry(name, content) for name, content in certificates.items()}
    order = {f"{file}.json": place for place, file in enumerate(FILES)}
    names = sorted(files, key=lambda file: (order.get(file, len(order)), file))
    return render({"schema": MANIFEST, "files": {file: files[file] for file in names}})


def _entry(name: str, content: str) -> dict[str, Any]:
    """Return what is said of a certificate."""
    document = json.loads(content)
    claims = {
        entry["id"]: {"verdict": entry["verdict"], "statement": entry["statement"]}
        for entry in document["claims"]
    }
    of = parameters_from_json(Reader(document["parameters"]))
    return {
        "digest": digest(content),
        "parameters": document["parameters"],
        "made": command(name, of, tuple(claims)),
        "checked": checking(name),
        "claims": claims,
    }


def _existing(folder: Path) -> dict[str, Any]:
    """Return the entries of the manifest that is there, if it has the usual form."""
    try:
        document = json.loads((folder / NAME).read_text(encoding="utf-8"))
        return dict(document["files"]) if document["schema"] == MANIFEST else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}
