"""Compile Coq files in the order of what they require."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

THEORY = Path(__file__).parent / "theory"
NAME = "Oscillator"  # the logical name of the folder, in Coq
OPTIONS = ["-R", ".", NAME, "-w", "-ambiguous-paths"]


def required(text: str) -> list[str]:
    """Return the modules of the theory that a file requires."""
    lists = re.findall(rf"^From {NAME} Require Import ([\w\s]+)\.", text, re.MULTILINE)
    return [name for names in lists for name in names.split()]


def order(folder: Path, wanted: list[str]) -> list[str]:
    """Return the modules wanted and all that they require, each after what it requires."""
    ordered: list[str] = []
    for name in wanted:
        before = order(folder, required((folder / f"{name}.v").read_text()))
        ordered += [each for each in [*before, name] if each not in ordered]
    return ordered


def compile_module(folder: Path, name: str) -> subprocess.CompletedProcess[str]:
    """Run coqc on one file of a folder, after those it requires."""
    command = ["coqc", *OPTIONS, f"{name}.v"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def copy_theory(folder: Path) -> None:
    """Copy the theory's sources into the folder where all is compiled."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in sorted(THEORY.glob("*.v")):
        shutil.copy(path, folder / path.name)
