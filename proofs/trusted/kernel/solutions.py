"""Rule: expressions that solve equations; and the equations of an implicit derivative."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.trees import Places, is_name, read_tree
from proofs.trusted.kernel.values import Equal, Series, read_lemma

_MOST = 40


@dataclass(frozen=True)
class Expressions(Conclusion):
    """Lemmas about unknowns, which they bind, that hold with these expressions in their places."""

    expressions: Places
    lemmas: tuple[Equal | Series, ...]

    def __post_init__(self) -> None:
        unknowns = {name for name, _ in self.expressions}
        if not 0 < len(unknowns) <= _MOST or not all(map(is_name, unknowns)):
            raise Unproved(f"names of up to {_MOST} unknowns are expected")
        if any(text.free & unknowns for _, text in self.expressions):
            raise Unproved("an expression for an unknown has no unknowns")

    @property
    def sentence(self) -> str:
        """Return what the unknowns are, and the lemmas."""
        given = ", ".join(f"`{name} = {value}`" for name, value in self.expressions)
        return f"With {given}: {' '.join(each.sentence for each in self.lemmas)}"


def solution(_: Context, reader: Reader) -> Expressions:
    """Rule `formula-solution`: {expressions: {unknown: formula}, lemmas}, at most 40 of each.

    lemmas: a list of {left, right} and {function, variable, coefficients, nonzero}, the variable
    being no unknown. Hypothesis: by `formula-equal` and `formula-series` each holds with at(F,
    unknowns=expressions) for each of its formulas F. Conclusion: each holds with the expressions,
    which have no unknowns, in the places of the unknowns, all at once. Proof. at(F, ...)
    is that, by its definition; the two rules prove what results.
    """
    expressions_of, lemmas_of = reader.fields("expressions", "lemmas")
    given = tuple((name, read_tree(value)) for name, value in expressions_of.members())
    found = Expressions(given, tuple(map(read_lemma, lemmas_of.items(1, _MOST))))
    for lemma in found.lemmas:
        lemma.put(given).prove()
    return found


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
