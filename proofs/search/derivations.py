"""Claims about formulas: find the proof of whatever they follow from.

Expressions for unknowns are found with sympy; equalities and power series are proved by the
checker's rules, by exact normal forms.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType
from typing import Any

from intervals import Undecided, decimal_bounds
from proofs.methods.derivation import concluded
from proofs.methods.lemmas import solution_witness, witness_of
from proofs.search.evidence import Evidence
from proofs.search.request import Request
from proofs.trusted.certificate import texts
from proofs.trusted.kernel import trees
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import enclosed, point_box, tried
from proofs.trusted.kernel.formulas import on_tape
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.values import Equal, Series, Value
from proofs.trusted.numbers import Range
from proofs.trusted.paper.formulas import (
    Asked,
    Lemma,
    Unknowns,
)
from proofs.trusted.verdicts import Row

SPARE_DIGITS = 12
Solvers = Mapping[Unknowns, Callable[[Unknowns], dict[str, str]]]  # expressions by sympy


def enclose(formula: str, digits: int, **point: Fraction) -> Range:
    """Enclose a formula at a point: decimal bounds of so many significant digits, or of 0."""
    formulas = on_tape(trees.formula(formula))
    box = point_box([point.get(name, Fraction(0)) for name in formulas.variables])
    ends = None
    for (value,) in tried(lambda bits: formulas.values(enclosed(box, bits))):
        low, high = ends = value.range
        if (high - low) * 10 ** (digits + SPARE_DIGITS) <= abs(low):
            break
    if ends is None:
        raise Undecided(f"no values of {formula} are enclosed")
    lower, upper = map(Fraction, decimal_bounds(*ends, digits))
    return lower, upper


@dataclass
class Steps:
    """The steps of a certificate about formulas, each with what it proves, once."""

    digits: int
    solvers: Solvers = field(default_factory=dict)
    steps: dict[str, dict[str, Any]] = field(default_factory=dict)
    names: dict[Lemma | Asked, tuple[str, Conclusion]] = field(default_factory=dict)

    def prove(self, wanted: Lemma | Asked) -> tuple[str, Conclusion] | None:
        """Return the step that proves something, and its conclusion; None if none is found."""
        if wanted not in self.names:
            if isinstance(wanted, Asked):
                self._value(wanted)
            elif isinstance(wanted, Unknowns):
                self._solution(wanted)
            else:
                self._lemma(wanted)
        return self.names.get(wanted)

    def _lemma(self, wanted: Equal | Series) -> None:
        """Prove an equality or a series by the rule itself: there is nothing to be found."""
        rule = "formula-equal" if isinstance(wanted, Equal) else "formula-series"
        witness = witness_of(wanted)
        with suppress(Unproved):
            self._add(wanted, concluded(rule, witness, Context()), rule, witness)

    def _solution(self, wanted: Unknowns) -> None:
        try:
            expressions = wanted.given or tuple(
                (name, trees.formula(text)) for name, text in self.solvers[wanted](wanted).items()
            )
        except Undecided:
            return
        solution = Expressions(expressions, wanted.lemmas)
        self._add(wanted, solution, "formula-solution", solution_witness(solution))

    def _value(self, asked: Asked) -> None:
        point = {variable.name: low for variable, (low, _) in asked.box}
        bounds = enclose(str(asked.function), self.digits, **point)
        witness = {
            "function": str(asked.function),
            "box": {variable.name: texts(side) for variable, side in asked.box},
            "tree": None,
            "bounds": texts(bounds),
        }
        value = Value(asked.function, asked.box, bounds)
        self._add(asked, value, "formula-value", witness)

    def _add(
        self, wanted: Lemma | Asked, conclusion: Conclusion, rule: str, witness: dict[str, Any]
    ) -> None:
        name = f"{rule.removeprefix('formula-')}-{len(self.steps) + 1}"
        self.steps[name] = {"rule": rule, "witness": witness}
        self.names[wanted] = (name, conclusion)


def prove_rows(
    request: Request, rows: Sequence[Row], solvers: Solvers = MappingProxyType({})
) -> Evidence:
    """Prove what the claims asked for follow from, each lemma once, whatever the parameters."""
    steps, evidence = Steps(request.digits, solvers), Evidence()
    for row in rows:
        if request.asks(row.id):
            request.tell(f"formulas of {row.id}")
            proved = [steps.prove(each) for each in row.needs]
            evidence.proofs[row.id] = [each for each in proved if each is not None]
    evidence.steps = steps.steps
    return evidence
