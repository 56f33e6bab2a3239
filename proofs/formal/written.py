"""What the writers of Coq files share: a case, numbers and comments as Coq reads them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

_ALL = """
(* What all theorems together rest on. *)
Definition all := ({names}).
Print Assumptions all.
"""


class NoTheorem(ValueError):
    """The certificate is right, and decides nothing that is stated in Coq."""


class Theorem(NamedTuple):
    """A theorem by its name in Coq and in words, and the paper's claims whose verdict it proves."""

    name: str
    says: str
    decides: Sequence[str] = ()


class Case(NamedTuple):
    """A Coq file, the theorems in it, and what one would look for in vain, with the reason."""

    text: str
    theorems: list[Theorem]
    left_out: Sequence[str] = ()


class Writer:
    """Collects the lemmas and theorems of a case.

    numbers: what all templates may be filled in with.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.theorems: list[Theorem] = []
        self.left_out: list[str] = []
        self.numbers: dict[str, object] = {}

    def add(self, template: str, **values: object) -> None:
        """Write a template with these values."""
        self.lines.append(template.format(**fields(**{**self.numbers, **values})))

    def state(
        self, name: str, says: str, template: str, decides: Sequence[str] = (), /, **values: object
    ) -> None:
        """Write a theorem, and which claims of the paper it decides."""
        self.add(template, name=name, says=comment(says), **values)
        self.theorems.append(Theorem(name, says, decides))

    def ended(self, head: str) -> Case:
        """Return the case."""
        return ended(head + "".join(self.lines), self.theorems, self.left_out)


def ended(text: str, theorems: list[Theorem], left_out: Sequence[str] = ()) -> Case:
    """Return a case whose last lines print the axioms of all its theorems."""
    names = ", ".join(theorem.name for theorem in theorems)
    return Case(text + _ALL.format(names=names), theorems, left_out)


def comment(words: str) -> str:
    """Return words that neither end a comment of Coq's nor begin one or a string inside it."""
    return words.replace("(*", "( *").replace("*)", "* )").replace('"', "'")


def fields(**values: object) -> dict[str, str]:
    """Return values as they are written in Coq."""
    return {k: rational(x) if isinstance(x, Fraction) else str(x) for k, x in values.items()}


def by_cases(parts: Sequence[tuple[str, Fraction]], tactic: str) -> str:
    """Return a proof script: by which of the adjoining pieces phi is in."""
    lines = [
        f"\n  destruct (Rle_dec phi {rational(end)}) as [?|?]; [{tactic.format(name)} |]."
        for name, end in parts[:-1]
    ]
    return "".join(lines) + f"\n  {tactic.format(parts[-1][0])}."


def rational(x: Fraction) -> str:
    """Write a rational as a Coq term."""
    return f"({x.numerator}" + (f" / {x.denominator})" if x.denominator > 1 else ")")


def pairs(arrows: Sequence[tuple[int, ...]]) -> str:
    """Write pairs of numbers for Coq."""
    return "; ".join(f"({a}, {b})" for a, b in arrows)
