"""CERTIFICATE.md: the form of a certificate and what each rule infers, from the docstrings."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterator
from importlib import import_module

from proofs.trusted import certificate, verify
from proofs.trusted.kernel import composition, flight, flow, lohner, normalform, trees
from proofs.trusted.kernel.enclose import leaves
from proofs.trusted.kernel.lohner import Solutions, orthogonal
from proofs.trusted.kernel.section import Journey
from proofs.trusted.rules import RULES, find_rule


def specification() -> str:
    """Return the page, in Markdown."""
    parts = ["# Certificates", _doc(certificate), _doc(verify)]
    parts += ["# Formulas", _doc(trees), _doc(normalform), _doc(leaves)]
    parts += ["# Maps", *map(_doc, (composition, flight, flow, lohner))]
    for lemma in (Solutions.step, Solutions.at, orthogonal, Journey.watch, Journey.part):
        parts.append(f"`{lemma.__qualname__}`: {_doc(lemma)}")
    parts.append("# Rules")
    modules: dict[str, list[str]] = {}
    for name, place in RULES.items():
        modules.setdefault(place.rpartition(".")[0], []).append(name)
    for module, names in modules.items():
        parts.append(f"## {_doc(import_module(f'proofs.trusted.{module}'))}")
        for name in names:
            parts += [f"### `{name}`", *theorems(name)]
    return "\n\n".join(parts) + "\n"


def rule_theorem(name: str) -> list[str]:
    """Return what a rule takes and infers, with all proofs, in paragraphs of one line."""
    lemmas = _doc(import_module(str(find_rule(name).__module__)))
    texts = [*theorems(name), *([lemmas] if "Proof" in lemmas else [])]
    return [" ".join(each.split()) for text in texts for each in text.split("\n\n")]


def theorems(name: str) -> list[str]:
    """Return what a rule takes and infers, and the theorems that it names, with their proofs."""
    rule = find_rule(name)
    waiting: list[object] = [rule]
    seen: set[object] = {*map(find_rule, RULES)}  # which have sections of their own
    paragraphs = [_doc(rule)]
    while waiting:
        for word, named in _named(waiting.pop(0)):
            if named not in seen:
                seen.add(named)
                waiting.append(named)
                paragraphs.append(f"`{word}`: {_doc(named)}")
    return paragraphs


def _named(thing: object) -> Iterator[tuple[str, object]]:
    """Yield the functions and classes with a theorem or a proof that a docstring names."""
    module = sys.modules[thing.__module__]
    used = (getattr(x, "__module__", None) for x in vars(module).values())
    places = [module, *(sys.modules[x] for x in dict.fromkeys(used) if x in _trusted())]
    for word in re.findall(r"`([A-Za-z_][\w.]*)`", _doc(thing)):
        for place in places:
            named: object = place
            for part in word.split("."):
                named = getattr(named, part, None)
            if callable(named) and re.search("Theorem|Proof", _doc(named)):
                yield word, named
                break


def _trusted() -> set[str]:
    return {name for name in sys.modules if name.startswith("proofs.trusted.")}


def _doc(thing: object) -> str:
    return inspect.cleandoc(getattr(thing, "__doc__", None) or "")


if __name__ == "__main__":
    sys.stdout.write(specification())
