"""Lemma files: find the witnesses of rules about formulas, and write them down.

Each method of Lemmas finds the witness of the rule of its name with the checker's enclosures and
adds a step, which the rule concludes. Raises Undecided where no witness is found,
Unproved where the rule denies one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from intervals import Undecided, decimal_bounds
from proofs.methods.derivation import Derivation
from proofs.methods.divisions import Tree, holds, subdivide
from proofs.trusted.certificate import Malformed, Reader, texts
from proofs.trusted.kernel import zeros
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.enclose import Box, Differentiable, centre_of, enclosed, point_box
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.kernel.head import read_function
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import Equal, Series
from proofs.trusted.kernel.zeros import Piece, Rows
from proofs.trusted.numbers import Range, within

_COARSE_DIGITS = 3
_UNUSED = (Fraction(0), Fraction(0))  # the side of x where there is no variable
_PLACES = 2**40  # candidates are rounded to multiples of 1 / _PLACES
_STEPS = 8  # of Newton's method
_BITS = 64

Number = Fraction | int | str
Sides = Sequence[tuple[Number, Number]]
Named = Mapping[str, tuple[Number, Number]]  # sides of a box, by the names of variables


def exact(sides: Sides) -> Box:
    """Return a box with exact ends."""
    return tuple((Fraction(low), Fraction(high)) for low, high in sides)


def written(box: Box) -> list[list[str]]:
    """Write a box."""
    return [texts(side) for side in box]


def bounds_of(text: str, box: Mapping[str, Range], sign: int) -> tuple[Range, Tree]:
    """Bound a formula that has a sign on a box; return bounds with room, and a subdivision."""
    ranges: list[Range] = []

    def decided(part: Range) -> bool:
        low, high = sorted((sign * part[0], sign * part[1]))
        if low > 0:
            ranges.append((low, high))
        return low > 0

    tree = _divided(text, box, decided)
    lower, upper = decimal_bounds(
        min(low for low, _ in ranges) / 2, max(high for _, high in ranges) * 2, _COARSE_DIGITS
    )
    low, high = sorted((sign * Fraction(lower), sign * Fraction(upper)))
    return (low, high), tree


def _divided(text: str, box: Mapping[str, Range], decided: Callable[[Range], bool]) -> Tree:
    """Divide a box until the enclosures of a formula decide; variables in alphabetical order."""
    formulas = read_formulas(Reader(text))
    sides = tuple(box.get(name, _UNUSED) for name in formulas.variables)
    return subdivide(sides, lambda part: holds(formulas, part, lambda x: decided(x[0].range)))


def witness_of(lemma: Equal | Series) -> dict[str, Any]:
    """Return what the checker needs for an equation or a series."""
    if isinstance(lemma, Equal):
        return {"left": str(lemma.left), "right": str(lemma.right)}
    return {
        "function": str(lemma.function),
        "variable": str(lemma.variable),
        "coefficients": list(map(str, lemma.coefficients)),
        "nonzero": list(map(str, lemma.nonzero)),
    }


def solution_witness(solution: Expressions) -> dict[str, Any]:
    """Return what the checker needs for expressions that solve equations."""
    return {
        "expressions": {name: str(value) for name, value in solution.expressions},
        "lemmas": [witness_of(each) for each in solution.lemmas],
    }


@dataclass
class Lemmas(Derivation):
    """A lemma file in the making: functions {name: (variables, texts) or JSON}, and its steps."""

    functions: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        given, self.functions = self.functions, {}
        for name, function in given.items():
            self.define(name, function)

    def define(self, name: str, function: Any) -> None:
        """Add a function: (variables, texts), or as it is written in a file."""
        if not isinstance(function, Mapping):
            variables, values_of = function
            function = {"variables": list(variables), "values": list(values_of)}
        self._define(name, function)
        self.functions = {**self.functions, name: function}

    def function(self, name: str) -> Formulas:
        """Return a formula as the checker reads it."""
        return read_function(name, Reader(self.functions[name]))

    # -- values and equations ------------------------------------------------------------------

    def value(self, text: str, bounds: tuple[Number, Number], **box: tuple[Number, Number]) -> str:
        """Add a step `formula-value`: closed bounds on a formula on a box.

        (The checker has exact values at points, of what is rational.)
        """
        (low, high), sides, tree = exact([bounds])[0], _sides(box), None
        if any(first < last for first, last in sides.values()):
            tree = _divided(text, sides, lambda part: within(part, (low, high)))
        return self._value(text, sides, (low, high), tree)

    def sign(self, text: str, sign: int, **box: tuple[Number, Number]) -> str:
        """Add a step `formula-value` with bounds of one sign, 1 or -1."""
        sides = _sides(box)
        return self._value(text, sides, *bounds_of(text, sides, sign))

    def bounds(self, text: str, digits: int, bits: int, **box: Range) -> Range:
        """Add a step `formula-value` with as narrow bounds as a box allows; return them."""
        formulas = read_formulas(Reader(text))
        sides = tuple(box.get(x, _UNUSED) for x in formulas.variables)
        with undecided():
            (value,) = formulas.values(enclosed(sides, bits))
        lower, upper = map(Fraction, decimal_bounds(*value.range, digits))
        self._value(text, _sides(box), (lower, upper), None)
        return lower, upper

    def _value(self, text: str, sides: Mapping[str, Range], bounds: Range, tree: Tree) -> str:
        box = {name: texts(side) for name, side in sides.items()}
        witness = {"function": text, "box": box, "tree": tree, "bounds": texts(bounds)}
        return self.add("formula-value", witness)

    def equal(self, left: str, right: str) -> str:
        """Add a step `formula-equal`."""
        return self.add("formula-equal", witness_of(Equal.read(left, right)))

    def series(self, text: str, variable: str, *coefficients: str, nonzero: Any = ()) -> str:
        """Add a step `formula-series`."""
        return self.add(
            "formula-series", witness_of(Series.read(text, variable, coefficients, nonzero))
        )

    def solution(self, expressions: Mapping[str, str], *lemmas: Equal | Series) -> str:
        """Add a step `formula-solution`."""
        expressed = Expressions(tuple((x, formula(y)) for x, y in expressions.items()), lemmas)
        return self.add("formula-solution", solution_witness(expressed))

    # -- zeros ---------------------------------------------------------------------------------

    def unique_zero(
        self, function: str, guess: Sequence[Number], radius: Number, *, bits: int = 64
    ) -> str:
        """Add a step `unique-zero`: Newton's method from the guess, then a cube around its end."""
        formula, reach = self.function(function), Fraction(radius)
        centre, matrix = newton(formula, [Fraction(x) for x in guess], bits=bits)
        unit = reach / 100
        box = tuple(
            (round((x - reach) / unit) * unit, round((x + reach) / unit) * unit) for x in centre
        )
        require_zero(formula, box, matrix, centre=centre, bits=bits)
        witness = {"function": function, "box": written(box), "centre": texts(centre)}
        return self.add("unique-zero", {**witness, "matrix": [texts(row) for row in matrix]})


def newton(
    map_: Map, guess: Sequence[Fraction], *, axis: int | None = None, bits: int = 64
) -> tuple[list[Fraction], list[list[Fraction]]]:
    """Return about a zero, and the inverse of the derivative; without moving along an axis."""
    centre, places = list(guess), 2 ** (bits - 13)
    moving = [k for k in range(len(centre)) if k != axis]
    with undecided():
        for _ in range(_STEPS):
            matrix = _inverse_at(map_, centre, moving)
            defect = middles(map_.values(enclosed(point_box(centre), bits)))
            last = list(centre)
            for k, row in zip(moving, matrix, strict=True):
                centre[k] = _rounded(centre[k] - dot(row, defect), places)
            if centre == last:
                break
    return centre, matrix


def require_zero(
    map_: Differentiable, box: Box, matrix: Rows, *, inside: Box = (), **options: Any
) -> None:
    """Raise Undecided unless the Krawczyk operator maps the box inside itself, or another one."""
    for k, (low, high) in krawczyk(map_, box, matrix, **options).items():
        if not (inside or box)[k][0] < low <= high < (inside or box)[k][1]:
            raise Undecided("whether there is exactly one zero near the guess")


def krawczyk(
    map_: Differentiable,
    box: Box,
    matrix: Rows,
    *,
    centre: Sequence[Fraction] = (),
    axis: int | None = None,
    slope: Sequence[Fraction] = (),
    bits: int = 64,
) -> dict[int, Range]:
    """Enclose m - C F(m) + (1 - C F'(X)) (X - m) by variables, as the checker does.

    With an axis and a slope: that of a slanted box, without the axis, see the rule `arc`.
    """
    piece = Piece(box, tuple(slope) or (Fraction(0),) * len(box))
    with undecided():
        image = zeros.krawczyk(map_, piece, centre or centre_of(box), matrix, (axis, bits))
        return {k: each.range for k, each in image.items()}


@contextmanager
def derived() -> Iterator[None]:
    """Say Undecided for what sympy finds and the checker does not conclude, or not soon.

    It may rest on identities that the checker has not: exp(log(x)) = x, for one.
    """
    try:
        with metered(DEFAULT):
            yield
    except (Unproved, Malformed, Exhausted) as failure:
        raise Undecided(f"what sympy finds is not derived by the checker: {failure}") from None


@contextmanager
def undecided() -> Iterator[None]:
    """Say Undecided for what the checker's lemmas do not prove."""
    try:
        yield
    except Unproved as error:
        raise Undecided(str(error)) from None


def middles(values: Sequence[Enclosure]) -> tuple[Fraction, ...]:
    """Return the middles of enclosures."""
    return centre_of(tuple(value.range for value in values))


def dot(row: Sequence[Any], column: Sequence[Any]) -> Any:
    """Return the sum of the products."""
    return sum((a * b for a, b in zip(row, column, strict=True)), 0)


def inverse(matrix: Rows) -> tuple[tuple[Fraction, ...], ...]:
    """Return the exact inverse (Gauss and Jordan), or raise Undecided."""
    n = len(matrix)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            raise Undecided("a singular matrix")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(n):
            if i != k and (factor := rows[i][k]):
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return tuple(tuple(row[n:]) for row in rows)


def _sides(box: Named) -> dict[str, Range]:
    """Return a box with exact ends, in alphabetical order."""
    return dict(zip(sorted(box), exact([box[name] for name in sorted(box)]), strict=True))


def _rounded(value: Fraction, places: int = _PLACES) -> Fraction:
    return Fraction(round(value * places), places)


def _inverse_at(
    map_: Map, point: Sequence[Fraction], places: Sequence[int]
) -> list[list[Fraction]]:
    """Return about the inverse of the derivative by some variables at a point."""
    rows = map_.jacobian(enclosed(point_box(point), _BITS))
    exact_inverse = inverse(tuple(middles([row[k] for k in places]) for row in rows))
    return [[_rounded(entry) for entry in row] for row in exact_inverse]
