"""Bifurcations proved: the Jacobian of a map, and enclosures at exact parameters."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from intervals import Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.classify import classified
from proofs.methods.bifurcation.maps import Map
from proofs.methods.bifurcation.normal_forms import NormalForm
from proofs.methods.lemmas import Lemmas, derived, dot, inverse, middles, undecided
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.trees import formula
from proofs.trusted.numbers import Range

_SPARE_DIGITS = 12
_NEWTON = 60  # steps from a guess


def prove_jacobian(file: Lemmas, map_: Map) -> None:
    """Add that the Jacobian is what sympy finds: G_x1 J + G_x = 0, entry by entry."""
    texts = [[derive.write(entry) for entry in row] for row in map_.jacobian.tolist()]
    for entry in map_.implicit(texts):
        with derived():
            file.equal(entry, "0")


def charts(form: NormalForm) -> list[NormalForm]:
    """Return the form with each variable of the state as the coordinate of the centre manifold."""
    places = range(1 if form.kind == "neimark_sacker" else len(form.map.state))
    return [replace(form, lead=place) for place in places]


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
    def signs(self) -> dict[str, int]:
        """The signs that decide."""
        ends = {"critical": self.critical, "speed": self.speed}
        return {name: 1 if low > 0 else -1 for name, (low, _) in ends.items()}

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
    reason = Undecided("no chart")
    for each in charts(form):
        try:
            with file.undone():
                return prove_enclosure(file, each, parameter, near, digits)
        except Undecided as failure:
            reason = failure
    raise reason


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
    file.define(name, (names, [text for each in orders for text in each]))
    radius = Fraction(1, 10 ** (digits + 2))
    step = file.unique_zero(name, [guess[each] for each in names], radius, bits=bits)
    box = {
        each: (Fraction(low), Fraction(high))
        for each, (low, high) in zip(names, file.steps[step]["witness"]["box"], strict=True)
    }
    values = {"critical": form.criticality, "speed": form.speed(parameter), **_invariants(form.map)}
    bounds: dict[str, Range] = {}

    def sign(test: str) -> int:
        text = re.sub(r"[a-z]+", lambda match: f"({values[match[0]]})", test.replace("^", "**"))
        low, high = _bounds(file, text, box, digits)
        if low <= 0 <= high:
            raise Undecided(f"whether {test} is 0 there")
        bounds[test] = low, high
        return 1 if low > 0 else -1

    class_ = classified(form.kind, len(form.map.state) == 2, sign)
    if class_.kind != form.kind:
        raise Undecided(f"{class_.kind}: {class_.why}")
    determinant = _bounds(file, values["determinant"], box, digits)
    return Enclosed(form, parameter, box, bounds["critical"], bounds["speed"], determinant)


def _invariants(map_: Map) -> dict[str, str]:
    """Return trace and determinant of the Jacobian; of a map of the line its derivative."""
    if len(map_.state) == 2:
        return map_.invariants()
    return {"determinant": f"-{map_.characteristic('0')}/{map_.turning()}"}  # det(-J) = -J


def _bounds(file: Lemmas, text: str, box: Mapping[str, Range], digits: int) -> Range:
    """Add bounds on a formula on a box; return them."""
    free = formula(text).free
    sides = {name: ends for name, ends in box.items() if name in free}
    return file.bounds(text, digits, (digits + _SPARE_DIGITS) * 4, **sides)


def _guess(
    form: NormalForm, parameter: str, near: Mapping[str, Fraction], bits: int
) -> dict[str, Fraction]:
    """Return about the solution: first the point, then the unknowns, order by order."""
    names = (*form.map.state, parameter)
    guess = _newton((*form.map.fixed, form.condition()), names, dict(near), bits)
    for order in range(1, form.order + 1):
        unknowns = form.unknowns_of(order)
        guess |= dict.fromkeys(unknowns, Fraction(0))
        guess = _newton(form.homological(order), unknowns, guess, bits)
    return guess


def _newton(
    texts: Any, names: tuple[str, ...], guess: dict[str, Fraction], bits: int
) -> dict[str, Fraction]:
    """Solve equations for some names by Newton's method; of too many equations, the first ones."""
    formulas = read_formulas(*map(Reader, texts))
    places = [formulas.variables.index(name) for name in names]
    for _ in range(_NEWTON if len(names) else 0):
        point = enclosed(point_box([guess.get(x, Fraction(0)) for x in formulas.variables]), bits)
        with undecided():
            defect = middles(formulas.values(point))
            rows = [middles([row[i] for i in places]) for row in formulas.jacobian(point)]
        chosen = _independent(rows, len(names))
        matrix = inverse(tuple(tuple(rows[i]) for i in chosen))
        steps = [dot(row, [defect[i] for i in chosen]) for row in matrix]
        unit = 2**bits
        for name, step in zip(names, steps, strict=True):
            guess[name] = Fraction(round((guess[name] - step) * unit), unit)
        if max(map(abs, steps)) * unit < 2**20:
            return guess
    if names:
        raise Undecided(f"Newton's method finds no {', '.join(names)}")
    return guess


def _independent(rows: Sequence[Sequence[Fraction]], count: int) -> list[int]:
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
