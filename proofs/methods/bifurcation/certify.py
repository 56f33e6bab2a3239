"""Bifurcations proved: lemma files about closed forms, and enclosures at exact parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from intervals import Interval, Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.maps import Map
from proofs.methods.bifurcation.normal_forms import NormalForm
from proofs.methods.bifurcation.solving import Solution, coefficients, points
from proofs.methods.formulas import dot, inverse, jacobian, values
from proofs.methods.lemmas import Lemmas
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.kernel.solutions import solution
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import Equal, Series, equal
from proofs.trusted.numbers import Range
from proofs.trusted.rules import Rule

_SPARE_DIGITS = 12
_NEWTON = 60  # steps from a guess


def prove_jacobian(file: Lemmas, of: Map) -> None:
    """Add that the Jacobian is what sympy finds: G_x1 J + G_x = 0, entry by entry."""
    texts = [[derive.write(entry) for entry in row] for row in of.jacobian.tolist()]
    for entry in of.implicit(texts):
        _confirm(file, file.equal(entry, "0"), equal)


def _confirm(file: Lemmas, name: str, rule: Rule) -> None:
    """Take a step back, and raise Undecided, where the checker does not derive it.

    What sympy finds may rest on identities that the checker has not: exp(log(x)) = x, for one.
    """
    try:
        with metered(DEFAULT):
            rule(Context(), Reader(file.steps[name]["witness"]))
    except (Unproved, Malformed, Exhausted) as failure:
        del file.steps[name]
        raise Undecided(f"what sympy finds is not derived by the checker: {failure}") from None


def prove_closed_form(file: Lemmas, form: NormalForm, found: Solution, parameter: str) -> None:
    """Add that it is a bifurcation with these coefficients, see `normal_forms`."""
    scaled = ", ".join(f"{x}=h*{x}" for x in form.coordinates if x != "h")
    sides = [f"at({each}, {scaled})" if scaled else each for each in form.conjugacy()]
    nought, nonzero = ("0",) * (form.order + 1), tuple(_divisors(form, found))
    name = file.solution(
        {name: derive.write(value) for name, value in found.items()},
        *(Equal.read(each, "0") for each in (*form.map.fixed, form.condition())),
        *(Series.read(each, "h", nought, nonzero) for each in sides),
        Equal.read(form.criticality, "critical"),
        Equal.read(form.speed(parameter), "speed"),
    )
    _confirm(file, name, solution)


def closed(file: Lemmas, form: NormalForm, names: tuple[str, ...]) -> list[Solution]:
    """Return bifurcations in closed form, solved for these names, and add their proofs.

    Raises Undecided where none is found that is not degenerate.
    """
    found, reason = [], Undecided("none is found")
    parameter = next(name for name in names if name not in form.map.state)
    for point in points(form, names):
        for each in _charts(form):
            try:
                known = coefficients(each, point, parameter)
                prove_closed_form(file, each, known, parameter)
            except Undecided as failure:
                reason = failure
                continue
            found.append(known)
            break
    if not found:
        raise reason
    return found


def _charts(form: NormalForm) -> list[NormalForm]:
    """Return the form with each variable of the state as the coordinate of the centre manifold."""
    places = range(1 if form.kind == "neimark_sacker" else len(form.map.state))
    return [replace(form, lead=place) for place in places]


def _divisors(form: NormalForm, found: Solution) -> list[str]:
    """Return the factors of all denominators at a solution, but numbers."""
    import sympy

    at_rest = [derive.simplest(derive.read(each, found)) for each in form.map.equations]
    factors = {
        factor
        for each in (*found.values(), *at_rest, *_partials(form, found))
        for factor in derive.factors(sympy.denom(each))
    }
    return sorted(derive.write(factor) for factor in factors if not factor.is_Rational)


def _partials(form: NormalForm, point: Solution) -> list[Any]:
    """Return the derivatives of the equations at a solution."""
    names = (*form.map.state, *form.map.images)
    rows = form.map.partials(names)
    places = form.map.at_rest(point)
    return [derive.simplest(derive.read(entry, places)) for row in rows for entry in row]


# -- at exact parameters ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Enclosed:
    """A bifurcation of a map in all whose parameters but one are numbers.

    box: enclosures of the fixed point, the parameter and the coefficients, by name, of which there
    are no others in it; critical, speed, determinant (of J): what decides what happens.
    """

    form: NormalForm
    parameter: str
    box: Mapping[str, Range]
    critical: Range
    speed: Range
    determinant: Range

    @property
    def says(self) -> str:
        """What the signs mean, in a line."""
        if self.form.kind == "fold":
            return "two fixed points meet and vanish"
        flip = self.form.kind == "flip"
        stable = (self.critical[0] > 0) == flip
        what = "cycle of period two" if flip else "invariant circle"
        near = " in the centre manifold" if flip and len(self.form.map.state) > 1 else ""
        how = "supercritical: a stable" if stable else "subcritical: an unstable"
        return f"{how} {what}{near}"


def enclosure(
    file: Lemmas, form: NormalForm, parameter: str, near: Mapping[str, Fraction], digits: int
) -> Enclosed:
    """Prove an enclosure in the first chart of the centre manifold in which that succeeds."""
    *others, last = _charts(form)
    for each in others:
        try:
            return prove_enclosure(file, each, parameter, near, digits)
        except Undecided:
            continue
    return prove_enclosure(file, last, parameter, near, digits)


def prove_enclosure(
    file: Lemmas, form: NormalForm, parameter: str, near: Mapping[str, Fraction], digits: int
) -> Enclosed:
    """Enclose the bifurcation near a guess of fixed point and parameter, and add the proof.

    Raises Undecided where Newton's method does not end at one, or one that is degenerate.
    """
    names = (*form.map.state, parameter, *form.unknowns)
    orders = [form.homological(k) for k in range(form.order + 1)]
    bits = (digits + _SPARE_DIGITS) * 4
    guess = _guess(form, parameter, near, bits)
    name = f"F{len(file.functions) + 1}"
    file.functions = {**file.functions, name: (names, [text for each in orders for text in each])}
    radius = Fraction(1, 10 ** (digits + 2))
    step = file.unique_zero(name, [guess[each] for each in names], radius, bits=bits)
    box = {
        each: (Fraction(low), Fraction(high))
        for each, (low, high) in zip(names, file.steps[step]["witness"]["box"], strict=True)
    }
    if "t" in box and not max(map(abs, box["t"])) < 2:
        raise Undecided("multipliers that are real, of product 1: no Neimark-Sacker bifurcation")
    critical, speed = (
        _bounded(file, text, box, digits) for text in (form.criticality, form.speed(parameter))
    )
    area = f"{form.map.characteristic('0')}/{form.map.turning()}"
    sign = -1 if len(form.map.state) == 1 else 1  # det(-J) = -J
    low, high = _bounds(file, f"-{area}" if sign < 0 else area, box, digits)
    return Enclosed(form, parameter, box, critical, speed, (low, high))


def _bounds(file: Lemmas, text: str, box: Mapping[str, Range], digits: int) -> Range:
    """Add bounds on a formula on a box; return them."""
    free = formula(text).free
    sides = {name: ends for name, ends in box.items() if name in free}
    return file.bounds(text, digits, (digits + _SPARE_DIGITS) * 4, **sides)


def _bounded(file: Lemmas, text: str, box: Mapping[str, Range], digits: int) -> Range:
    """Add bounds that are not 0."""
    low, high = _bounds(file, text, box, digits)
    if low <= 0 <= high:
        raise Undecided(f"whether {text[:40]} is 0 there")
    return low, high


def _guess(
    form: NormalForm, parameter: str, near: Mapping[str, Fraction], bits: int
) -> dict[str, Fraction]:
    """Return about the solution: first the point, then the unknowns, order by order."""
    names = (*form.map.state, parameter)
    known = _newton((*form.map.fixed, form.condition()), names, dict(near), bits)
    for order in range(1, form.order + 1):
        unknowns = form.unknowns_of(order)
        known |= dict.fromkeys(unknowns, Fraction(0))
        known = _newton(form.homological(order), unknowns, known, bits)
    return known


def _newton(
    texts: Any, names: tuple[str, ...], known: dict[str, Fraction], bits: int
) -> dict[str, Fraction]:
    """Solve equations for some names by Newton's method; of too many equations, the first ones."""
    formulas = read_formulas(*map(Reader, texts))
    places = [formulas.variables.index(name) for name in names]
    for _ in range(_NEWTON if len(names) else 0):
        inputs = [Interval(known.get(x, 0), precision=bits) for x in formulas.variables]
        defect = [v.mid for v in values(formulas, inputs)]
        rows = [[row[i].mid for i in places] for row in jacobian(formulas, inputs)]
        chosen = _independent(rows, len(names))
        matrix = inverse(tuple(tuple(rows[i]) for i in chosen))
        steps = [dot(row, [defect[i] for i in chosen]) for row in matrix]
        unit = 2**bits
        for name, step in zip(names, steps, strict=True):
            known[name] = Fraction(round((known[name] - step) * unit), unit)
        if max(map(abs, steps)) * unit < 2**20:
            return known
    if names:
        raise Undecided(f"Newton's method finds no {', '.join(names)}")
    return known


def _independent(rows: list[list[Fraction]], count: int) -> list[int]:
    """Return the places of rows that are independent, the clearest first."""
    left, chosen = [list(row) for row in rows], list[int]()
    for column in range(count):
        sizes = [(0 if i in chosen else abs(row[column]), i) for i, row in enumerate(left)]
        size, pivot = max(sizes)
        if not size:
            raise Undecided("equations that determine nothing")
        chosen.append(pivot)
        for i, row in enumerate(left):
            if i != pivot and i not in chosen:
                factor = row[column] / left[pivot][column]
                left[i] = [a - factor * b for a, b in zip(row, left[pivot], strict=True)]
    return sorted(chosen)
