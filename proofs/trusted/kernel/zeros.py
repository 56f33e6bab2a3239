"""Rules: zeros of functions, their existence, uniqueness, brackets."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import (
    Box,
    add,
    attempts,
    box_text,
    enclosed,
    point_box,
    read_box,
    tried,
)
from proofs.trusted.kernel.formulas import Formulas, read_formulas
from proofs.trusted.kernel.values import Value
from proofs.trusted.numbers import Range, show_range, within


@dataclass(frozen=True)
class Zero(Conclusion):
    """A function of one variable has a zero in a bracket; perhaps the only one in an interval."""

    function: str
    variable: str
    interval: Range
    bracket: Range
    only: bool

    @property
    def sentence(self) -> str:
        """Return the statement."""
        place = f"{self.function} has a zero {self.variable} in {show_range(self.bracket)}"
        return (
            f"{place}, and no other in {show_range(self.interval)}." if self.only else f"{place}."
        )


@dataclass(frozen=True)
class UniqueZero(Conclusion):
    """F = (F_1, ..., F_n) has exactly one zero in a box."""

    function: Formulas
    box: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        box = box_text(self.box, self.function.variables)
        return (
            f"for {self.function.definition} and {box}: {self.function.name} has exactly one zero."
        )


def _sign_at(function: Formulas, point: Fraction) -> int:
    """Return the strict sign of a function at a point, or raise Unproved."""
    for (value,) in attempts(function, point_box((point,))):
        if value.lo > 0 or value.hi < 0:
            return 1 if value.lo > 0 else -1
    raise Unproved("the sign at an end is not decided")


def zero(context: Context, reader: Reader) -> Zero:
    """Rule `zero`: {function F of one variable x, value, bracket}.

    Hypotheses: `value` is a `formula-value` step about F, or about D(F, x), on an interval that
    contains the bracket; F has opposite strict signs at the ends of the bracket. Conclusion: F has
    a zero in the bracket (Bolzano: it is defined on the interval, hence continuous); if the step
    bounds D(F, x), and away from 0, then it is the only zero in the interval (F is monotone).
    """
    function, value_of, bracket_of = reader.fields("function", "value", "bracket")
    formulas, step = read_formulas(function), context.step(value_of, Value)
    if len(step.box) != 1 or formulas.variables != tuple(step.sides):
        raise value_of.fail("a step about a function of this variable alone is expected")
    text, bracket = function.string(), bracket_of.range()
    ((variable, interval),) = step.box
    slope = f"D({text}, {variable})"
    if step.function not in (text, slope):
        raise value_of.fail("the step is about another function")
    if not within(bracket, interval):
        raise bracket_of.fail("the bracket leaves the interval of the step")
    if _sign_at(formulas, bracket[0]) == _sign_at(formulas, bracket[1]):
        raise Unproved(f"the same sign at both ends of {show_range(bracket)}")
    only = step.function == slope and not step.bounds[0] <= 0 <= step.bounds[1]
    return Zero(text, variable, interval, bracket, only)


def unique_zero(context: Context, reader: Reader) -> UniqueZero:
    """Rule `unique-zero`: {function of n variables with n values, box X, centre m in X, matrix C}.

    Hypothesis: with an interval matrix J that contains F'(x) for all x in X, each component of

        K = m - C F(m) + (I - C J) (X - m)

    lies strictly inside that of X. Conclusion: F has exactly one zero in X.

    Proof. For x, y in X, F(x) - F(y) = B (x - y), B in J the mean of F' on the segment. So
    g(x) = x - C F(x) = m - C F(m) + (I - C B) (x - m) maps X into K. With widths w of X, all
    positive, and R the magnitudes of I - C J, (R w)_i <= wid K_i < w_i: g is a contraction of X
    in the norm max |x_i| / w_i and has one fixed point; and C is regular, since |I - C B| < 1, so
    the fixed points are the zeros. Source: Krawczyk 1969; Moore 1977; for n = 1 with
    C = 1 / F'(m) this is Newton's method with a remainder.
    """
    function_of, box_of, centre_of, matrix_of = reader.fields("function", "box", "centre", "matrix")
    function = context.function(function_of)
    n = len(function.variables)
    if len(function.roots) != n:
        raise function_of.fail("as many values as variables are expected")
    box, centre = read_box(box_of, n), centre_of.numbers(n, n)
    if not all(low <= m <= high for m, (low, high) in zip(centre, box, strict=True)):
        raise centre_of.fail("the centre is not in the box")
    matrix = [row.numbers(n, n) for row in matrix_of.items(n, n)]
    for image in tried(lambda bits: _krawczyk(function, box, centre, matrix, bits)):
        if all(a[0] < b[0] and b[1] < a[1] for a, b in zip(box, image, strict=True)):
            return UniqueZero(function, box)
    raise Unproved("the Krawczyk operator does not map the box strictly inside")


def _krawczyk(
    function: Formulas,
    box: Box,
    centre: tuple[Fraction, ...],
    matrix: list[tuple[Fraction, ...]],
    bits: int,
) -> list[Range]:
    """Enclose K = m - C F(m) + (I - C J) (X - m)."""
    x, middle = enclosed(box, bits), enclosed(point_box(centre), bits)
    steps = [a - m for a, m in zip(x, middle, strict=True)]
    values, nothing = function.values(middle), rational(Fraction(0), bits)
    columns = list(zip(*function.jacobian(x), strict=True))
    image = []
    for i, row in enumerate(matrix):
        c = [rational(entry, bits) for entry in row]
        defect = [int(i == j) - add(nothing, c, column) for j, column in enumerate(columns)]
        image.append(add(middle[i] - add(nothing, c, values), defect, steps).range)
    return image
