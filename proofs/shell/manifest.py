"""MANIFEST.json: for each claim the file that settles it, its digest, and the two commands.

Where a certificate was made, with what and when, is said here and not in the certificate, so that
the same proof always is the same bytes.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from proofs import __version__
from proofs.trusted.certificate import (
    MANIFEST,
    Reader,
    digest,
    parameters_from_json,
    render,
    write_atomically,
)
from proofs.trusted.manifest import command

NAME = "MANIFEST.json"


def record(folder: Path, name: str, content: str) -> None:
    """Enter the claims of the certificate `folder / name`.

    Entries about other files stay; a manifest that cannot be read is replaced.
    """
    claims, files = _existing(folder)
    claims = {claim: entry for claim, entry in claims.items() if entry["file"] != name}
    document = json.loads(content)
    entries = {entry["id"]: entry for entry in document["claims"]}
    claims |= {
        claim: {"verdict": entry["verdict"], "statement": entry["statement"], "file": name}
        for claim, entry in entries.items()
    }
    of = parameters_from_json(Reader(document["parameters"]))
    files.pop(name, None)  # the newest is the last
    files[name] = {
        "digest": digest(content),
        "parameters": document["parameters"],
        "made": command(name, of, tuple(entries)),
        "with": _provenance(),
    }
    write_atomically(folder / NAME, render({"schema": MANIFEST, "claims": claims, "files": files}))


def _existing(folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the claims and the files of the manifest that is there, if it has the usual form."""
    try:
        document = json.loads((folder / NAME).read_text(encoding="utf-8"))
        claims, files = dict(document["claims"]), dict(document["files"])
        if document["schema"] == MANIFEST and all(
            entry["file"] in files for entry in claims.values()
        ):
            return claims, files
    except (OSError, ValueError, KeyError, TypeError):
        pass
    return {}, {}


def _provenance() -> dict[str, str]:
    """Return what was at work: this package, python, the imported packages, the machine's kind."""
    packages: dict[str, str] = {
        name: str(sys.modules[name].__version__)
        for name in ("mpmath", "numpy", "sympy")
        if name in sys.modules
    }
    machine = os.uname().machine if hasattr(os, "uname") else "unknown"
    return {
        "impact-proofs": __version__,
        "commit": _commit(),
        "python": ".".join(map(str, sys.version_info[:3])),
        **packages,
        "platform": f"{sys.platform} {machine}",
        "date": datetime.now(UTC).replace(microsecond=0).isoformat(),
    }


def _commit() -> str:
    root = Path(__file__).parent.parent
    if not (root / ".git").exists():
        return "unknown"
    try:
        command = ["git", "-C", str(root), "describe", "--always", "--dirty", "--abbrev=40"]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
