"""Whether a folder is as it was when all of it was checked and its pages were made.

A file in the user's cache, not in the folder, which may come from anybody, says from what the pages
were made, and which they are: the digests of all certificates there, of this program and of the
packages that it draws with; and of each page. It is no proof, and where it is missing all is
checked, and pages are made again.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from platformdirs import user_cache_path

_DRAW = ("jinja2", "latex2mathml", "matplotlib", "mpmath", "numpy", "sympy")


def inputs(folder: Path) -> str:
    """Return a digest of all that the pages of a folder are made from."""
    texts = [sys.version, *(f"{package} {_version(package)}" for package in _DRAW)]
    for package in ("proofs", "intervals"):
        spec = find_spec(package)
        for root in (spec and spec.submodule_search_locations) or ():
            texts += _digests(Path(root), "**/*")
    return _digest(
        "\n".join(texts + _digests(folder, "*.json") + _digests(folder, "atlas/*/atlas.*")).encode()
    )


def place(folder: Path) -> Path:
    """Return the file about a folder."""
    return user_cache_path("impact-proofs") / f"{_digest(bytes(folder.resolve()))}.json"


def pages(folder: Path, made_from: str) -> set[str] | None:
    """Return the names of the pages in a folder, None where one is not what was made from this."""
    try:
        said = json.loads(place(folder).read_text(encoding="utf-8"))
        there = {name: _digest((folder / name).read_bytes()) for name in said["pages"]}
        return set(there) if said == {"from": made_from, "pages": there} else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def record(folder: Path, made_from: str, made: Mapping[str, str]) -> None:
    """Write the file that `pages` reads, where that is possible."""
    digests = {name: _digest(text.encode()) for name, text in made.items()}
    with suppress(OSError):
        place(folder).parent.mkdir(parents=True, exist_ok=True)
        place(folder).write_text(json.dumps({"from": made_from, "pages": digests}))


def _digests(folder: Path, pattern: str) -> list[str]:
    files = sorted(path for path in folder.glob(pattern) if path.is_file())
    return [
        f"{path.relative_to(folder)} {_digest(path.read_bytes())}"
        for path in files
        if path.suffix != ".pyc"
    ]


def _digest(content: bytes) -> str:
    return sha256(content).hexdigest()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "absent"
