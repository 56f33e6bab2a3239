"""Rule: expressions that solve equations; and the equations of an implicit derivative."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.values import Equal, Series, equal, series

_MOST = 40
_NAME = re.compile(r"[a-z][a-z0-9_]{0,19}")


@dataclass(frozen=True)
class Expressions(Conclusion):
    """Lemmas about unknowns that hold with these expressions in their places."""

    expressions: tuple[tuple[str, str], ...]
    lemmas: tuple[Equal | Series, ...]

    @property
    def sentence(self) -> str:
        """Return what the unknowns are, and the lemmas."""
        given = ", ".join(f"{name} = {text}" for name, text in self.expressions)
        return f"With {given}: {' '.join(each.sentence for each in self.lemmas)}"


def solution(context: Context, reader: Reader) -> Expressions:
    """Rule `formula-solution`: {expressions: {unknown: formula}, lemmas}.

    lemmas: a list of {left, right} and {function, variable, coefficients, nonzero}. Hypothesis: by
    `formula-equal` and `formula-series` each holds with at(F, unknowns=expressions) for each of its
    formulas F. Conclusion: each holds with the expressions in the places of the unknowns, all at
    once. Proof. at(F, ...) is that, by its definition; the two rules prove what results.
    """
    expressions_of, lemmas_of = reader.fields("expressions", "lemmas")
    expressions = []
    for name, text in expressions_of.members():
        if not _NAME.fullmatch(name):
            raise text.fail(f"not a name for an unknown: {name[:30]!r}")
        read_formulas(text)
        expressions.append((name, text.string()))
    given = ", ".join(f"{name}={text}" for name, text in expressions)
    lemmas = tuple(_lemma(context, each, given) for each in lemmas_of.items(1, _MOST))
    return Expressions(tuple(expressions), lemmas)


def _lemma(context: Context, reader: Reader, given: str) -> Equal | Series:
    """Prove a lemma with the expressions put into it; return it as it stands."""
    witness = reader.value
    if isinstance(witness, dict) and "left" in witness:
        sides = reader.fields("left", "right")
        read_formulas(*sides)
        left, right = (each.string() for each in sides)
        put = {"left": f"at({left}, {given})", "right": f"at({right}, {given})"}
        equal(context, Reader(put, reader.path))
        return Equal(left, right)
    function, variable, *lists = reader.fields("function", "variable", "coefficients", "nonzero")
    parts = [each.items(least, 12) for each, least in zip(lists, (1, 0), strict=True)]
    read_formulas(function, *parts[0], *parts[1])
    texts = [tuple(each.string() for each in part) for part in parts]
    moved = [[f"at({text}, {given})" for text in each] for each in texts]
    put_in = {
        "function": f"at({function.string()}, {given})",
        "variable": variable.string(),
        "coefficients": moved[0],
        "nonzero": moved[1],
    }
    series(context, Reader(put_in, reader.path))
    return Series(function.string(), variable.string(), *texts)


def implicit_derivative(
    equations: Sequence[str],
    variables: Sequence[str],
    images: Sequence[str],
    matrix: Sequence[str],
) -> tuple[str, ...]:
    """Return formulas that are 0 if a matrix, by its rows, is the derivative of a map.

    Theorem. Where equations G(x, y) = 0, as many as images y, hold and G_y is regular, y is a
    smooth function of x with the derivative Y that is the only solution of G_y Y + G_x = 0.
    """
    n = len(variables)
    return tuple(
        " + ".join(f"D({each}, {y})*({matrix[n * i + j]})" for i, y in enumerate(images))
        + f" + D({each}, {x})"
        for each in equations
        for j, x in enumerate(variables)
    )
