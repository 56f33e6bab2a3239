"""Lemma files: find the witnesses of rules about formulas, and write them down.

Each method of Lemmas finds the witness of the rule of its name with the package `intervals` and
adds a step; the checker, which has its own arithmetic, derives the step again. Raises Undecided
where no witness is found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from intervals import Interval, Undecided
from proofs.methods.formulas import (
    Values,
    dot,
    jacobian,
    mean_value_form,
    subdivide,
    values,
)
from proofs.trusted.certificate import SCHEMA, Reader, texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import Box
from proofs.trusted.kernel.formula import Formula, read_formula
from proofs.trusted.kernel.hset import inverse

_PLACES = 2**40  # candidates are rounded to multiples of 1 / _PLACES

Number = Fraction | int | str
Sides = Sequence[tuple[Number, Number]]


def exact(sides: Sides) -> Box:
    """Return a box with exact ends."""
    return tuple((Fraction(low), Fraction(high)) for low, high in sides)


def written(box: Box) -> list[list[str]]:
    """Write a box."""
    return [texts(side) for side in box]


@dataclass
class Lemmas:
    """A lemma file in the making: functions {name: (variables, expressions)}, and its steps."""

    functions: Mapping[str, tuple[Sequence[str], Sequence[Any]]]
    steps: dict[str, dict[str, Any]] = field(default_factory=dict)

    def document(self, *claims: str) -> dict[str, Any]:
        """Return the file's content; without names all steps but h-sets are claims."""
        named = [name for name, step in self.steps.items() if step["rule"] != "h-set"]
        return {
            "schema": SCHEMA,
            "parameters": None,
            "functions": {name: self._json(name) for name in self.functions},
            "steps": self.steps,
            "claims": list(claims) or named,
        }

    def _json(self, name: str) -> dict[str, Any]:
        variables, expressions = self.functions[name]
        return {"variables": list(variables), "values": list(expressions)}

    def formula(self, name: str) -> Formula:
        """Return a function as the checker reads it."""
        return read_formula(name, Reader(self._json(name)))

    def add(self, rule: str, witness: dict[str, Any]) -> str:
        """Add a step, return its name."""
        number = 1 + sum(step["rule"] == rule for step in self.steps.values())
        self.steps[f"{rule}-{number}"] = {"rule": rule, "witness": witness}
        return f"{rule}-{number}"

    # -- inequalities --------------------------------------------------------------------------

    def inequality(self, rule: str, claim: dict[str, Any]) -> str:
        """Add a step by `sign`, `monotone`, `range` or `expansion`, of which the claim is given."""
        formula = self.formula(claim["function"])
        component = int(claim.get("component", "1")) - 1
        variable = claim.get("variable", formula.variables[0] if rule == "expansion" else None)
        root = formula.roots[component]
        if variable is not None:
            root = formula.tape.derivative(root, formula.variables.index(variable))
        sides: Sides = claim["box"] if "box" in claim else [claim["interval"]]

        def decided(box: Box) -> bool:
            (value,) = mean_value_form(
                lambda x: values(formula, x, (root,)), lambda x: jacobian(formula, x, (root,)), box
            )
            return _holds(rule, claim, value)

        return self.add(rule, {"claim": claim, "tree": subdivide(exact(sides), decided)})

    def no_zero(self, function: str, sides: Sides) -> str:
        """Add a step `no-zero`."""
        formula, box = self.formula(function), exact(sides)
        tree = subdivide(box, lambda part: not all(v.contains_zero() for v in _on(formula, part)))
        return self.add("no-zero", {"function": function, "box": written(box), "tree": tree})

    def refute_at(self, rule: str, claim: dict[str, Any], point: Sequence[Number]) -> str:
        """Add a step `refute-at`."""
        witness = {"rule": rule, "claim": claim, "point": [str(Fraction(x)) for x in point]}
        return self.add("refute-at", witness)

    def identity(self, function: str, left: int, right: int, derivative: Sequence[str] = ()) -> str:
        """Add a step `identity`; components are counted from 1."""
        sides = {"left": str(left), "derivative": list(derivative), "right": str(right)}
        return self.add("identity", {"function": function, **sides})

    # -- zeros ---------------------------------------------------------------------------------

    def zero(self, function: str, component: int, interval: tuple[Number, Number]) -> str:
        """Add a step `zero`."""
        formula, box = self.formula(function), exact([interval])
        tree = subdivide(box, lambda part: bool(_on(formula, part)))
        place = {"function": function, "component": str(component)}
        return self.add("zero", {**place, "interval": texts(box[0]), "tree": tree})

    def root(self, monotone: str, tolerance: Number = "1/1000000000000") -> str:
        """Add a step `root`: halve the interval of a `monotone` step, as long as signs decide."""
        claim = self.steps[monotone]["witness"]["claim"]
        formula, width = self.formula(claim["function"]), Fraction(tolerance)
        (low, high), rises = exact(claim["box"])[0], claim["sign"] == "+"
        bits = 60 + (1 / width).__ceil__().bit_length()
        root = (formula.roots[int(claim["component"]) - 1],)
        while high - low > width / 4:
            middle = (low + high) / 2
            (value,) = values(formula, [Interval(middle, precision=bits)], root)
            if value.contains_zero():  # next to the root, or at it: take another point
                middle = (low + 2 * high) / 3
                (value,) = values(formula, [Interval(middle, precision=bits)], root)
            if value.contains_zero():
                raise Undecided("the sign beside the root")
            if (value.inf > 0) == rises:
                high = middle
            else:
                low = middle
        first, last = exact(claim["box"])[0]
        bracket = max(first, low // width * width), min(last, -(-high // width) * width)
        return self.add("root", {"monotone": monotone, "bracket": texts(bracket)})

    def unique_zero(self, function: str, guess: Sequence[Number], radius: Number) -> str:
        """Add a step `unique-zero`: Newton's method from the guess, then a cube around its end."""
        formula, reach = self.formula(function), Fraction(radius)
        centre = [Fraction(x) for x in guess]
        for _ in range(8):
            matrix = _inverse_at(formula, centre)
            defect = [v.mid for v in values(formula, [Interval(x) for x in centre])]
            moved = [x - dot(row, defect) for x, row in zip(centre, matrix, strict=True)]
            centre = [_rounded(x) for x in moved]
        unit = reach / 100
        box = tuple(
            (round((x - reach) / unit) * unit, round((x + reach) / unit) * unit) for x in centre
        )
        witness = {"function": function, "box": written(box), "centre": texts(centre)}
        return self.add("unique-zero", {**witness, "matrix": [texts(row) for row in matrix]})


def _on(formula: Formula, box: Box) -> Values:
    """Enclose the components on a box."""
    return mean_value_form(lambda x: values(formula, x), lambda x: jacobian(formula, x), box)


def _holds(rule: str, claim: dict[str, Any], value: Interval) -> bool:
    """Whether a claim follows where its quantity has these values."""
    if rule == "range":
        low, high = map(Fraction, claim["bounds"])
        return low <= value.inf and value.sup <= high
    if rule == "expansion":
        return value.inf >= Fraction(claim["bound"]) or value.sup <= -Fraction(claim["bound"])
    return value.inf > 0 if claim["sign"] == "+" else value.sup < 0


def _rounded(value: Fraction) -> Fraction:
    return Fraction(round(value * _PLACES), _PLACES)


def _inverse_at(formula: Formula, point: Sequence[Fraction]) -> list[list[Fraction]]:
    """Return about the inverse of the derivative at a point."""
    rows = jacobian(formula, [Interval(x) for x in point])
    try:
        exact_inverse = inverse(tuple(tuple(entry.mid for entry in row) for row in rows))
    except Unproved:
        raise Undecided("a singular derivative") from None
    return [[_rounded(entry) for entry in row] for row in exact_inverse]
