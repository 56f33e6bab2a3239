"""CERTIFICATE.md: the form of a certificate and what each rule infers, from the docstrings."""

from __future__ import annotations

import inspect
import sys
from importlib import import_module

from proofs.trusted import certificate, verify
from proofs.trusted.kernel import normalform, trees
from proofs.trusted.kernel.enclose import leaves
from proofs.trusted.rules import RULES, find_rule


def specification() -> str:
    """Return the page, in Markdown."""
    parts = ["# Certificates", _doc(certificate), _doc(verify)]
    parts += ["# Formulas", _doc(trees), _doc(normalform), _doc(leaves), "# Rules"]
    modules: dict[str, list[str]] = {}
    for name, place in RULES.items():
        modules.setdefault(place.rpartition(".")[0], []).append(name)
    for module, names in modules.items():
        parts.append(f"## {_doc(import_module(f'proofs.trusted.{module}'))}")
        parts += [f"### `{name}`\n\n{_doc(find_rule(name))}" for name in names]
    return "\n\n".join(parts) + "\n"


def _doc(thing: object) -> str:
    return inspect.cleandoc(getattr(thing, "__doc__", None) or "")


if __name__ == "__main__":
    sys.stdout.write(specification())
