"""What must be believed for a claim: the files of the checker that run when it is checked alone."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from inspect import CO_OPTIMIZED
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple, TypeVar

import proofs.trusted
from proofs.trusted.certificate import parse, used_steps
from proofs.trusted.verify import check

_FOLDER = Path(proofs.trusted.__file__).parent
T = TypeVar("T")


class Trust(NamedTuple):
    """A claim, and the files that it rests on with their lines, docstrings included."""

    claim: str
    files: tuple[tuple[str, int], ...]

    @property
    def told(self) -> str:
        """Say how much it is, and name the files."""
        lines, names = sum(count for _, count in self.files), ", ".join(x for x, _ in self.files)
        return f"{self.claim}: to believe this, {lines} lines in {len(self.files)} files: {names}"


def trusted_for(source: str, work: int) -> Iterator[Trust]:
    """Check each claim of a certificate alone, with the steps that it needs; watch the calls."""
    reader = parse(source)
    document: dict[str, Any] = reader.value
    members = dict(reader.entries())
    for claim in document["claims"]:
        own = claim if isinstance(claim, str) else claim["id"]
        proof = {claim} if isinstance(claim, str) else {*claim["proof"]}
        steps = used_steps(members["steps"], proof)
        functions = {*used_steps(members["functions"], steps)}
        alone = {
            **document,
            "functions": {x: y for x, y in document["functions"].items() if x in functions},
            "steps": {x: y for x, y in document["steps"].items() if x in steps},
            "claims": [claim],
        }
        yield Trust(own, _files(json.dumps(alone), work))


def _files(source: str, work: int) -> tuple[tuple[str, int], ...]:
    """Return the files of the trusted part of which a function is called during a check."""
    _, called = watched(lambda: check(source, work))
    files = sorted(Path(name) for name in called if Path(name).is_relative_to(_FOLDER))
    return tuple(
        (str(path.relative_to(_FOLDER)), len(path.read_text("utf-8").splitlines()))
        for path in files
    )


def watched(run: Callable[[], T]) -> tuple[T, set[str]]:
    """Return what a function returns, and the files of which functions are called meanwhile."""
    files: set[str] = set()

    def observe(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code.co_flags & CO_OPTIMIZED:  # no module, no class's body
            files.add(frame.f_code.co_filename)

    before = sys.getprofile()
    sys.setprofile(observe)
    try:
        return run(), files
    finally:
        sys.setprofile(before)
