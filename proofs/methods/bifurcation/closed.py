"""Bifurcations in closed form: candidates, classified, each with its lemmas."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from intervals import IntervalError, Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.certify import charts
from proofs.methods.bifurcation.classify import Class, classified
from proofs.methods.bifurcation.normal_forms import NormalForm
from proofs.methods.bifurcation.solving import (
    Solution,
    coefficients,
    has_roots,
    points,
    roots_of,
)
from proofs.methods.lemmas import Lemmas, derived
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.values import Equal, Series

_SIGN_BITS = 200
ROOT = "root"  # a parameter, where the closed form has a root of parameters; the next is root2
_MOST_ROOTS = 3
_ALIKE = 1e-12


@dataclass(frozen=True)
class Closed:
    """A candidate in closed form: expressions by name, what it is, and the signs that decide.

    roots: the squares of roots that are parameters, each by those before and the map's.
    """

    values: Solution
    what: Class
    signs: Mapping[str, int]
    roots: Solution = field(default_factory=dict)

    @property
    def kept(self) -> bool:
        """Whether it is a bifurcation, or a resonance."""
        return not self.what.dropped


def closed(file: Lemmas, form: NormalForm, names: tuple[str, ...]) -> list[Closed]:
    """Return what is found of a condition, solved for these names, classified, with its proof.

    Raises Undecided where no closed form is found.
    """
    parameter = next(name for name in names if name not in form.map.state)
    candidates = points(form, names)
    if not candidates:
        raise Undecided(
            f"no closed form of {', '.join(names)} is found: solve for others, or look near numbers"
        )
    plain = [each for each in candidates if not _rooted(each)]
    classes = [_classified(file, form, each, parameter) for each in plain]
    for each in candidates:
        if _rooted(each) and not any(_is_reached(each, other) for other in classes):
            classes.append(_by_roots(file, form, names, each, {}))
    return classes


def _rooted(point: Solution) -> bool:
    return any(power.base.free_symbols for power in roots_of(point))


def _is_reached(point: Solution, other: Closed) -> bool:
    """Whether a point is that of a candidate with roots, for one sign of each."""
    import sympy

    shown = [other.values] if other.roots else []
    for name, square in reversed(other.roots.items()):
        signs = [{name: sign * sympy.sqrt(square)} for sign in (1, -1)]
        shown = [{x: v.subs(each) for x, v in values.items()} for values in shown for each in signs]
    return any(all(_alike(point[x], values[x]) for x in point) for values in shown)


def _alike(left: Any, right: Any) -> bool:
    """Whether two expressions are about the same at some numbers."""
    names = sorted((left - right).free_symbols, key=str)
    places = {x: Fraction(k * k + 3, k + 2) for k, x in enumerate(names)}
    return abs(complex((left - right).evalf(30, subs=places))) < _ALIKE


def _by_roots(
    file: Lemmas, form: NormalForm, names: tuple[str, ...], point: Solution, roots: Solution
) -> Closed:
    """Classify a candidate whose roots of parameters are parameters, in place of other ones.

    If a root is of r, and r = ROOT^2 has one solution for a parameter, a rational one, that is
    put into the map: what is proved is so for all ROOT, of either sign, at which it is defined.
    Then the next root, inside of which others may have stood. roots: those before, by their names.
    """
    import sympy

    name = f"{ROOT}{len(roots) + 1}" if roots else ROOT
    left = Closed(point, Class("undecided", "with roots of parameters"), {})
    squares = [x.base for x in roots_of(point) if x.exp.q == 2 and x.base.free_symbols]
    square = next((x for x in squares if not has_roots({name: x})), None)
    if square is None or name in form.map.parameters or len(roots) == _MOST_ROOTS:
        return left
    free = {*form.map.parameters} - {*names, *roots}
    for parameter in sorted(free & {str(x) for x in square.free_symbols}):
        values = sympy.solve(square - sympy.Symbol(name) ** 2, sympy.Symbol(parameter))
        if len(values) != 1 or has_roots({parameter: values[0]}):
            continue
        moved = replace(form, map=form.map.with_numbers(**{parameter: derive.write(values[0])}))
        for each in points(moved, names):
            if _uses(each, name):
                made = _reduced(file, moved, names, each, {**roots, name: square})
                placed = values[0].subs({x: made.values[x] for x in free & {*made.values}})
                return replace(made, values={**made.values, parameter: derive.simplest(placed)})
    return left


def _reduced(
    file: Lemmas, form: NormalForm, names: tuple[str, ...], point: Solution, roots: Solution
) -> Closed:
    """Classify a candidate of a map that has these roots as parameters."""
    if _rooted(point):
        return _by_roots(file, form, names, point, roots)
    parameter = next(name for name in names if name not in form.map.state)
    return replace(_classified(file, form, point, parameter), roots=roots)


def _uses(point: Solution, name: str) -> bool:
    return any(str(x) == name for value in point.values() for x in value.free_symbols)


def _classified(file: Lemmas, form: NormalForm, point: Solution, parameter: str) -> Closed:
    """Classify a candidate, and add the proof; what fails in it is told as why it is dropped."""
    numbers = Numbers(file, form, point, parameter)
    try:
        with file.undone():
            numbers.require_defined()
            class_ = classified(form.kind, len(form.map.state) == 2, numbers.sign)
            if numbers.open_domain:
                class_ = class_._replace(where=(*class_.where, "the map is defined"))
            numbers.prove()
    except Undecided as failure:
        return Closed(point, Class("undecided", str(failure)), {})
    return Closed({**point, **numbers.values}, class_, numbers.signs)


class Numbers:
    """The numbers by which a candidate in closed form is classified, each found when asked for."""

    def __init__(self, file: Lemmas, form: NormalForm, point: Solution, parameter: str) -> None:
        self.file, self.form, self.point, self.parameter = file, form, point, parameter
        self.values: Solution = {}
        self.signs: dict[str, int] = {}
        self._normal: Solution | None = None
        self._lemmas: list[Equal] = []

    def require_defined(self) -> None:
        """Raise Undecided unless the map is proved to be defined at a point of numbers."""
        if not self._free:
            try:
                self._proved_sign(self._at(self.form.map.turning()))
            except Undecided:
                raise Undecided("the map is not proved to be defined there") from None

    @property
    def _free(self) -> bool:
        """Whether parameters are left."""
        left = {*self.form.map.parameters} - {*self.point}
        return bool(left) or any(x.free_symbols for x in self.point.values())

    @property
    def open_domain(self) -> bool:
        """Whether it depends on parameters if the map is defined there."""
        return self._free and bool(re.search("sqrt|log|/[^0-9]", "".join(self.form.map.equations)))

    def sign(self, name: str) -> int | None:
        """Return the sign of a number; None if that depends on parameters."""
        text = name.replace("^", "**")
        for invariant in ("trace", "determinant"):
            if invariant in text and invariant not in self.values:
                self._note(invariant, self.form.map.invariants()[invariant])
        if name in ("critical", "speed", "cubic", "crossing", "mixed") and name not in self.values:
            self._find(name)
        number = derive.simplest(derive.read(text, self.values))
        if number.free_symbols:
            return None
        sign = self._sign(derive.write(number)) if number != 0 else 0
        if name in self.values:
            self.signs[name] = sign
        return sign

    def _sign(self, text: str) -> int:
        """Return the sign of a number that is not 0."""
        import sympy

        number = derive.read(text)
        if number.is_Rational:
            return int(sympy.sign(number))
        return self._proved_sign(text)

    def _proved_sign(self, text: str) -> int:
        """Prove the sign of a number, and that it is defined."""
        with derived():
            try:
                low, high = self.file.bounds(text, 6, _SIGN_BITS)
            except (IntervalError, Unproved) as failure:
                raise Undecided(f"{text[:60]} is not defined: {failure}") from None
        if low <= 0 <= high:
            raise Undecided(f"whether {text[:40]} is 0")
        return 1 if low > 0 else -1

    def _at(self, text: str) -> str:
        places = self.form.map.at_rest(self.point).items()
        return f"at({text}, {', '.join(f'{x}={derive.write(value)}' for x, value in places)})"

    def _note(self, name: str, text: str) -> None:
        """Find a number by its formula at the candidate, and take down the lemma."""
        values = self._normal or self.point
        self.values[name] = derive.simplest(derive.read(text, values))
        if not derive.is_real(self.values[name]):
            raise Undecided(f"{name} is not defined there")
        self._lemmas.append(Equal.read(text, name))

    def _find(self, name: str) -> None:
        if name == "cubic":
            self.form = replace(self.form, kind="pitchfork", lead=0)
            self._normal = None
        if self._normal is None:
            self._normal = self._coefficients()
            self.values |= {x: self._normal[x] for x in ("critical", "speed")}
        if name == "cubic":
            self._note(name, "b3")
        elif name in ("crossing", "mixed"):
            texts = self.form.unfolding(self.parameter, self._row())
            self._note(name, texts[name == "mixed"])

    def _coefficients(self) -> Solution:
        """Return the coefficients in the first chart of the centre manifold that there is."""
        reason = Undecided("no normal form")
        for each in charts(self.form):
            try:
                normal = coefficients(each, self.point, self.parameter)
            except Undecided as failure:
                reason = failure
                continue
            self.form = each
            return normal
        raise reason

    def _row(self) -> int:
        """Return a row of the derivative of `fixed` that gives a direction, see `unfolding`."""
        if len(self.form.map.state) == 1:
            return 0
        other = self.form.map.state[1 - self.form.lead]
        rows = [derive.read(f"D({each}, {other})", self.point) for each in self.form.map.fixed]
        return next((i for i, x in enumerate(rows) if derive.simplest(x) != 0), 0)

    def prove(self) -> None:
        """Add that it is a fixed point as the condition says, with these numbers."""
        given = {**(self._normal or self.point), **self.values}
        rest = [Equal.read(each, "0") for each in (*self.form.map.fixed, self.form.condition())]
        sides: list[Equal | Series] = []
        if self._normal is not None:
            sides = [*self._conjugate(), Equal.read(self.form.criticality, "critical")]
            sides.append(Equal.read(self.form.speed(self.parameter), "speed"))
        values = {name: derive.write(value) for name, value in given.items()}
        with derived():
            self.file.solution(values, *rest, *sides, *self._lemmas)

    def _conjugate(self) -> list[Equal] | list[Series]:
        """Return that the map is the normal form in the chart, see `normal_forms`.

        Where roots or logarithms occur, of which the checker has no series, by derivatives at the
        fixed point, around which the map is smooth where it is defined.
        """
        form, values = self.form, self._normal or {}
        if has_roots(self.point) or re.search("sqrt|log", "".join(form.map.equations)):
            orders = (form.homological(k) for k in range(form.order + 1))
            return [Equal.read(each, "0") for order in orders for each in order]
        scaled = ", ".join(f"{x}=h*{x}" for x in form.coordinates if x != "h")
        sides = [f"at({each}, {scaled})" if scaled else each for each in form.conjugacy()]
        nought, nonzero = ("0",) * (form.order + 1), tuple(_divisors(form, values))
        return [Series.read(each, "h", nought, nonzero) for each in sides]


def _divisors(form: NormalForm, solution: Solution) -> list[str]:
    """Return the factors of all denominators at a solution, but numbers."""
    import sympy

    at_rest = [derive.simplest(derive.read(each, solution)) for each in form.map.equations]
    factors = {
        factor
        for each in (*solution.values(), *at_rest, *_partials(form, solution))
        for factor in derive.factors(sympy.denom(each))
    }
    return sorted(derive.write(factor) for factor in factors if not factor.is_Rational)


def _partials(form: NormalForm, point: Solution) -> list[Any]:
    """Return the derivatives of the equations at a solution."""
    names = (*form.map.state, *form.map.images)
    rows = form.map.partials(names)
    places = form.map.at_rest(point)
    return [derive.simplest(derive.read(entry, places)) for row in rows for entry in row]
