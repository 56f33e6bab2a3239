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
    """A theorem by its name in Coq and in words."""

    name: str
    says: str


class Case(NamedTuple):
    """A Coq file, the theorems in it, and what one would look for in vain, with the reason."""

    text: str
    theorems: list[Theorem]
    left_out: Sequence[str] = ()


def ended(text: str, theorems: list[Theorem], left_out: Sequence[str] = ()) -> Case:
    """Return a case whose last lines print the axioms of all its theorems."""
    names = ", ".join(theorem.name for theorem in theorems)
    return Case(text + _ALL.format(names=names), theorems, left_out)


def comment(words: str) -> str:
    """Return words that neither end a comment of Coq's nor begin one or a string inside it."""
    return words.replace("(*", "( *").replace("*)", "* )").replace('"', "'")


def rational(x: Fraction) -> str:
    """Write a rational as a Coq term."""
    return f"({x.numerator}" + (f" / {x.denominator})" if x.denominator > 1 else ")")
