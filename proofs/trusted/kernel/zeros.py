"""Rules: zeros of formulas: existence, uniqueness, brackets."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context, Quantity, read_box, read_point, where
from proofs.trusted.kernel.enclose import (
    PRECISIONS,
    Box,
    Components,
    add,
    attempts,
    decide,
    enclosed,
    leaves,
    point_box,
    shown,
)
from proofs.trusted.kernel.formula import Formula
from proofs.trusted.kernel.inequalities import Monotone, excludes_zero
from proofs.trusted.numbers import Range, show_range


@dataclass(frozen=True)
class Zero(Conclusion):
    """A function of one variable has a zero inside an interval."""

    quantity: Quantity
    interval: Range

    @property
    def sentence(self) -> str:
        """Return the statement."""
        of = self.quantity
        return f"{where(of.formula, (self.interval,), of.component)}: {of.name} has a zero"


@dataclass(frozen=True)
class Root(Conclusion):
    """A function of one variable has exactly one zero in an interval, and it lies in a bracket."""

    quantity: Quantity
    interval: Range
    bracket: Range

    @property
    def sentence(self) -> str:
        """Return the statement."""
        of = self.quantity
        return (
            f"{where(of.formula, (self.interval,), of.component)}: {of.name} has exactly one zero, "
            f"and it lies in {show_range(self.bracket)}"
        )


@dataclass(frozen=True)
class UniqueZero(Conclusion):
    """F has exactly one zero in a box."""

    formula: Formula
    box: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"{where(self.formula, self.box)}: {self.formula.name} has exactly one zero"


def _sign_at(context: Context, quantity: Quantity, point: Fraction) -> int:
    """Return the strict sign of a component at a point, or raise Unproved."""
    for values in attempts(quantity.map(), point_box((point,))):
        if excludes_zero(values[0]):
            return 1 if values[0].lo > 0 else -1
    raise Unproved(f"the sign is not decided at {shown(point_box((point,)))}")


def _change(context: Context, quantity: Quantity, bracket: Range) -> int:
    """Return the sign at the upper end of a bracket, opposite to that at the lower end."""
    low, high = (_sign_at(context, quantity, end) for end in bracket)
    if low == high:
        raise Unproved(f"the same sign at both ends of {shown((bracket,))}")
    return high


def zero(context: Context, reader: Reader) -> Zero:
    """Rule `zero`: {function of one variable, component, interval, tree}.

    Hypotheses: F_i has opposite strict signs at the ends, and is defined on each leaf of the tree,
    hence continuous on the interval. Conclusion: F_i has a zero inside (Bolzano).
    """
    function, component, interval_of, tree = reader.fields(
        "function", "component", "interval", "tree"
    )
    quantity = Quantity.read(context, function, component)
    if len(quantity.formula.variables) != 1:
        raise function.fail("a function of one variable is expected")
    interval = interval_of.range()
    _change(context, quantity, interval)
    for leaf in leaves(tree, (interval,)):
        decide(quantity.map(), leaf, lambda values: True)
    return Zero(quantity, interval)


def root(context: Context, reader: Reader) -> Root:
    """Rule `root`: {monotone, bracket}: a `monotone` step about a function of one variable.

    Hypotheses: the bracket lies in the interval of that step, and F_i has opposite strict signs
    at its ends. Conclusion: F_i has exactly one zero in the interval of the step, and it lies in
    the bracket: one exists there by Bolzano's theorem, and F_i is injective.
    """
    name, bracket_of = reader.fields("monotone", "bracket")
    step, bracket = context.step(name, Monotone), bracket_of.range()
    if len(step.box) != 1:
        raise name.fail("a function of one variable is expected")
    if not step.box[0][0] <= bracket[0] <= bracket[1] <= step.box[0][1]:
        raise bracket_of.fail("the bracket leaves the interval of the step")
    quantity = Quantity(step.quantity.formula, step.quantity.component)
    if _change(context, quantity, bracket) != step.sign:
        raise Unproved("the signs contradict the monotone step")
    return Root(quantity, step.box[0], bracket)


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
    function, box_of, centre_of, matrix_of = reader.fields("function", "box", "centre", "matrix")
    formula = context.formula(function)
    n = len(formula.variables)
    if len(formula.roots) != n:
        raise function.fail("as many values as variables are expected")
    box, centre = read_box(box_of, n), read_point(centre_of, n)
    if not all(low <= m <= high for m, (low, high) in zip(centre, box, strict=True)):
        raise centre_of.fail("the centre is not in the box")
    matrix = [read_point(row, n) for row in matrix_of.items(n, n)]
    for bits in PRECISIONS:
        try:
            image = _krawczyk(context.map_of(formula), box, centre, matrix, bits)
        except Unproved:
            continue
        if all(a[0] < b[0] and b[1] < a[1] for a, b in zip(box, image, strict=True)):
            return UniqueZero(formula, box)
    raise Unproved("the Krawczyk operator does not map the box strictly inside")


def _krawczyk(
    map_: Components,
    box: Box,
    centre: tuple[Fraction, ...],
    matrix: list[tuple[Fraction, ...]],
    bits: int,
) -> list[Range]:
    """Enclose K = m - C F(m) + (I - C J) (X - m)."""
    x = enclosed(box, bits)
    middle = [rational(m, bits) for m in centre]
    steps = [a - m for a, m in zip(x, middle, strict=True)]
    values = map_.values(middle)
    columns = list(zip(*map_.jacobian(x), strict=True))
    image = []
    for i, row in enumerate(matrix):
        c = [rational(entry, bits) for entry in row]
        nothing = rational(Fraction(0), bits)
        defect = [int(i == j) - add(nothing, c, column) for j, column in enumerate(columns)]
        image.append(add(middle[i] - add(nothing, c, values), defect, steps).range)
    return image
