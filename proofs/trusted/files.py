"""Certificates as files: how they are read, written, and told apart."""

from __future__ import annotations

import json
import os
import stat
from hashlib import sha256
from pathlib import Path
from textwrap import wrap
from typing import Any, BinaryIO

from proofs.trusted.certificate import MAX_BYTES, SIGNS, Malformed, Reader, parse, text, texts
from proofs.trusted.kernel.meter import METER
from proofs.trusted.parameters import Parameters, Place

_WIDTH = 100  # of a line


def opened(path: Path) -> BinaryIO:
    """Open a regular file; OSError where it is none, such as a pipe, which is not waited for."""
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0))
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise OSError("not a regular file")
    return os.fdopen(handle, "rb")


def read(path: Path) -> str:
    """Return a file's text; Malformed if it is too large or no UTF-8, OSError as in `opened`."""
    with opened(path) as file:
        return decoded(file.read(MAX_BYTES + 1))


def decoded(content: bytes) -> str:
    """Return the text that was read, up to a byte more than is allowed."""
    if len(content) > MAX_BYTES:
        raise Malformed(f"$: larger than {MAX_BYTES} bytes")
    METER.get().spend(len(content) >> 3)
    try:
        return content.decode()
    except UnicodeDecodeError:
        raise Malformed("$: not a text file") from None


def schema_of(source: str) -> str:
    """Return the schema that a text names, whatever else it holds; "" if it names none."""
    document = parse(source)
    return Reader(document.value["schema"], "$.schema").string() if document.has("schema") else ""


def digest(source: str) -> str:
    """Return the SHA-256 of a certificate's canonical form: without white space, ASCII.

    Keys stay in their order, which steps and expressions have: two files with the same digest are
    accepted or not, and say the same, however they are laid out.
    """
    canonical = json.dumps(json.loads(source), separators=(",", ":"))
    return "sha256:" + sha256(canonical.encode("ascii")).hexdigest()


def render(document: dict[str, Any]) -> str:
    """Write a text, on one line what fits there: the same document gives the same bytes."""
    return _laid_out(document, "") + "\n"


def _laid_out(value: Any, margin: str, before: int = 0) -> str:
    """Write a value that begins so many characters after its margin."""
    brief = json.dumps(value, ensure_ascii=False)
    if (
        len(margin) + before + len(brief) <= _WIDTH
        or not value
        or not isinstance(value, dict | list)
    ):
        return brief
    inner = margin + " "
    if isinstance(value, dict):
        names = {json.dumps(name, ensure_ascii=False): each for name, each in value.items()}
        parts = [f"{x}: {_laid_out(each, inner, len(x) + 2)}" for x, each in names.items()]
    elif all(isinstance(each, str) and " " not in each for each in value):
        parts = wrap(
            brief[1:-1], _WIDTH - len(inner), break_long_words=False, break_on_hyphens=False
        )
        return f"[\n{inner}" + f"\n{inner}".join(parts) + f"\n{margin}]"
    else:
        parts = [_laid_out(each, inner) for each in value]
    return f"{brief[0]}\n{inner}" + f",\n{inner}".join(parts) + f"\n{margin}{brief[-1]}"


def parameters_to_json(of: Parameters) -> dict[str, Any]:
    """Write one statement's numbers."""
    return {
        "eta": text(of.eta),
        "nu": text(of.nu),
        "left": texts(of.left),
        "right": texts(of.right),
        "interval": texts(of.interval),
        "slopes": texts(of.slopes),
        "ratios": None if of.ratios is None else texts(of.ratios),
        "printed_s0": of.printed_s0,
        "epsilon": None if of.epsilon is None else text(of.epsilon),
        "velocities": None if of.velocities is None else texts(of.velocities),
        "reach": None if of.reach is None else texts(of.reach),
    } | ({} if of.signs == (1, 1) else {SIGNS: list(map(str, of.signs))})


def box_to_json(box: Place) -> dict[str, Any]:
    """Write the box of oscillators that a file is about."""
    sides = {"eta": box.eta, "nu": box.nu, "epsilon": box.epsilon}
    return {name: texts(side) for name, side in sides.items() if side is not None}
