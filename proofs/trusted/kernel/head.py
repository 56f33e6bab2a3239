"""What the formulas of a map are of: the state, its angles, a flight's time, parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from types import MappingProxyType
from typing import NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import Circle
from proofs.trusted.kernel.expression import Tape
from proofs.trusted.kernel.formulas import (
    FUNCTION_NAME,
    MAX_VALUES,
    MAX_VARIABLES,
    Formulas,
    Placer,
)
from proofs.trusted.kernel.normalform import NormalForms, Polynomial, plus
from proofs.trusted.kernel.operations import Enclosures
from proofs.trusted.kernel.trees import Tree, is_name, read_tree
from proofs.trusted.numbers import Range, show, show_range

_OPTIONAL = ("parameters", "periods")
_BITS = 64


class Head(NamedTuple):
    """What a map's formulas are of: the state, a flight's time, parameters.

    state: of a flow, the variables of the map, then those that flow.
    numbers: parameters with one value; ranges: those with more.
    """

    state: tuple[str, ...]
    time: tuple[str, ...]
    numbers: Mapping[str, Fraction]
    ranges: Mapping[str, Range]
    periods: Mapping[str, Tree]

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables on the tape, in this order."""
        return (*self.state, *self.time, *self.ranges)

    @property
    def given(self) -> str:
        """Write the parameters, and the periods of angles."""
        values = [f"`{name}` = {show(value)}" for name, value in self.numbers.items()]
        values += [f"for all `{name}` in {show_range(ends)}" for name, ends in self.ranges.items()]
        values += [f"`{name}` modulo `{period}`" for name, period in self.periods.items()]
        return "".join(f", {value}" for value in values)

    def placer(self) -> Placer:
        """Return a tape that has the variables and the parameters."""
        tape = Tape()
        places = {v: tape.add("variable", datum=Fraction(i)) for i, v in enumerate(self.variables)}
        numbers = {name: tape.number(value) for name, value in self.numbers.items()}
        return Placer(tape, places | numbers, [])

    def _circle(self, placer: Placer, angle: str, period: Tree) -> Circle:
        if not period.free <= {*self.numbers}:
            raise Unproved(f"a period is a number, and that of {angle} is none")
        root = placer.place(period)
        (value,) = placer.tape.evaluate((root,), Enclosures(_BITS), ())
        if value.lo <= 0:
            raise Unproved(f"a period is positive, and that of {angle} is not")
        values = (f"{name} = {self.numbers[name]}" for name in sorted(period.free))
        return Circle(self.state.index(angle), root, (str(period), *values))

    def formulas(self, name: str, placer: Placer, trees: Sequence[Tree]) -> Formulas:
        """Put functions of the variables on one tape, the periods last."""
        roots, tape = tuple(map(placer.place, trees)), placer.tape
        circles = tuple(self._circle(placer, *each) for each in self.periods.items())
        parts = tuple(part for part in dict.fromkeys(placer.parts) if tape.may_fail(part))
        ranges = tuple(self.ranges.values())
        return Formulas(
            self.variables, tuple(trees), tape, roots, parts, name, ranges, circles, self.given
        )


def read_head(name: str, reader: Reader) -> Head:
    """Read the variables, the time, the parameters and the periods of a map."""
    require_function_name(reader, name)
    fields = dict(reader.entries())
    state = tuple(
        item.string()
        for key in ("variables", "state")
        if key in fields
        for item in fields[key].items(1, MAX_VARIABLES)
    )
    time = (fields["time"].string(),) if "time" in fields else ()
    sides = {
        each: item.range()
        for each, item in (fields["parameters"].entries() if "parameters" in fields else ())
    }
    names = (*state, *time, *sides)
    for each in names:
        require_name(reader, each, each in sides)
    if len({*names}) < len(names) or len(names) > MAX_VARIABLES:
        raise reader.fail(f"a name that is there twice, or more than {MAX_VARIABLES} names")
    numbers = {each: low for each, (low, high) in sides.items() if low == high}
    ranges = {each: ends for each, ends in sides.items() if each not in numbers}
    periods = dict(fields["periods"].entries()) if "periods" in fields else {}
    for each, period in periods.items():
        if each not in state[: len(fields["variables"].items())]:
            raise period.fail(f"a period of what is no variable: {each[:30]!r}")
    trees = {each: read_tree(period) for each, period in periods.items()}
    return Head(state, time, numbers, ranges, trees)


def read_function(name: str, reader: Reader) -> Formulas:
    """Read a formula: {variables, values}, and perhaps parameters and periods."""
    _, values_of, *_ = reader.fields("variables", "values", *optional(reader))
    head = read_head(name, reader)
    trees = [read_tree(each) for each in values_of.items(1, MAX_VALUES)]
    try:
        formulas = head.formulas(name, head.placer(), trees)
    except Unproved as error:
        raise values_of.fail(str(error)) from None
    require_periods(reader, formulas, formulas.roots)
    return replace(formulas, variables=head.state)


def require_function_name(reader: Reader, name: str) -> None:
    """Raise Malformed unless a name is one of a function: h-sets and matrices have the others."""
    if not FUNCTION_NAME.fullmatch(name):
        raise reader.fail("functions are named like F or Gap2, not N, N1, M, A or D")


def require_name(reader: Reader, name: str, is_parameter: bool = False) -> None:
    """Raise Malformed unless a name is one of a variable: parameters alone are named `e`."""
    if not (is_name(name) and name[0].islower() and (is_parameter or name != "e")):
        raise reader.fail(f"not a name for a variable: {name[:30]!r}")


def optional(reader: Reader) -> list[str]:
    """Return the names of the fields that a map may have, and has."""
    return [name for name in _OPTIONAL if reader.has(name)]


def require_periods(
    reader: Reader,
    formulas: Formulas,
    values: Sequence[int],
    others: Sequence[int] = (),
    starts: Mapping[int, int] = MappingProxyType({}),
) -> None:
    """Raise Malformed unless formulas respect the periods of the angles.

    With x + P, P the period of an angle, in the place of x, each of the values changes by a
    multiple of its own period if it is the image of an angle, else not; nor do the others. That is
    seen in the normal forms, which are right wherever both sides are defined. starts: of states
    that flow, from their places: as much as a start changes, so much is its state moved.
    """
    if not formulas.circles:
        return
    tape, forms = formulas.tape, NormalForms(MAX_VARIABLES)
    own = {circle.place: circle.root for circle in formulas.circles}
    for circle in formulas.circles:
        angle = tape.add("variable", datum=Fraction(circle.place))
        moves = {angle: tape.add("+", angle, circle.root)}
        later = tape.moved(tuple(starts.values()), moves)
        for (state, before), after in zip(starts.items(), later, strict=True):
            moves[state] = tape.add("+", state, tape.add("-", after, before))
        turned = tape.moved((*values, *others), moves)
        for k, (before, after) in enumerate(zip((*values, *others), turned, strict=True)):
            roots = (before, after, own[k] if k < len(values) and k in own else before)
            one, two, period = tape.evaluate(roots, forms, forms.inputs())
            change = plus(two, one, -1)
            if k < len(values) and k in own:
                change = plus(change, period, -_multiple(change, period))
            if not forms.is_zero(change):
                variable = formulas.variables[circle.place]
                what = dict(zip(formulas.roots, formulas.trees, strict=False)).get(before, "a part")
                raise reader.fail(f"{what} is not proved to respect the period of {variable}")


def _multiple(value: Polynomial, period: Polynomial) -> int:
    """Return the integer k for which value = k period, if there is one; else any."""
    for monomial, factor in period.items():
        ratio = value.get(monomial, Fraction(0)) / factor
        return int(ratio) if ratio.denominator == 1 else 0
    return 0
