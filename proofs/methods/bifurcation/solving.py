"""Normal forms by sympy: bifurcations in closed form, and their coefficients order by order."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

from intervals import Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.normal_forms import NormalForm

Solution = dict[str, Any]  # expressions of sympy by name


def points(form: NormalForm, names: tuple[str, ...]) -> list[Solution]:
    """Return bifurcations in closed form, solved for these names; Undecided where none is found."""
    return solve([derive.read(each) for each in (*form.map.fixed, form.condition())], names)


def solve(equations: list[Any], names: tuple[str, ...]) -> list[Solution]:
    """Return solutions in closed form, without roots; Undecided where none is found.

    There may be others: of each equation one factor is solved for a name in which it is linear, or
    that is the last one in it, and that is put into the others.
    """
    import sympy

    found: list[Solution] = []
    for each in _solved(equations, [sympy.Symbol(name) for name in names]):
        point = {str(name): value for name, value in each.items()}
        known = all(derive.is_real(x) and not _has_roots(x) for x in point.values())
        if known and point not in found:
            found.append(point)
    if not found:
        raise Undecided(f"no closed form of {', '.join(names)} without roots is found")
    return found


def _has_roots(expression: Any) -> bool:
    """Whether there are powers that are not whole: the checker has no series of these."""
    import sympy

    powers = expression.atoms(sympy.Pow)
    return any(not power.exp.is_integer and power.base != sympy.E for power in powers)


def _solved(equations: list[Any], unknowns: list[Any]) -> list[Solution]:
    """Return solutions of equations, by elimination."""
    import sympy

    tops = [sympy.numer(derive.simplest(each)) for each in equations]
    for place, top in enumerate(tops):
        others = [*tops[:place], *tops[place + 1 :]]
        factors = [f for f in derive.factors(top) if f.has(*unknowns)] if top else []
        factors = [f for f in factors if not isinstance(f, sympy.exp)]  # that is not 0
        choices = [(f, x) for f in factors for x in unknowns if _solvable(f, x, unknowns)]
        if factors and {f for f, _ in choices} == set(factors):
            return [
                {unknown: derive.simplest(value.subs(rest)), **rest}
                for factor in factors
                for unknown in [next(x for f, x in choices if f == factor)]
                for value in sympy.solve(factor, unknown)
                for rest in (
                    _solved(
                        [other.subs(unknown, value) for other in others],
                        [x for x in unknowns if x != unknown],
                    )
                    if others
                    else [{}]
                )
            ]
    return []


def _solvable(factor: Any, x: Any, unknowns: list[Any]) -> bool:
    """Whether an expression is linear in x, or quadratic or sin(x) without others.

    (Of pi/2, where cos(x) is 0, the checker knows no sine.)
    """
    import sympy

    if not factor.has(x):
        return False
    degree = factor.as_poly(x).degree() if factor.is_polynomial(x) else None
    alone = not (factor.free_symbols & set(unknowns)) - {x}
    return degree == 1 or (alone and (degree == 2 or factor == sympy.sin(x)))


def coefficients(form: NormalForm, point: Solution, parameter: str) -> Solution:
    """Return what the homological equations determine at a bifurcation; critical, and speed."""
    known: Solution = dict(point)

    def placed(text: str) -> Any:
        return derive.read(text, known)

    series = _taylor(form, placed)
    for order in range(1, form.order + 1):
        chart = [_truncated(placed(text), form, order) for text in form.chart()]
        reduced = [_truncated(placed(text), form, order) for text in form.reduced()]
        steps = [{n: c for n, c in each.items() if any(n)} for each in chart]
        moved = [_composed(each, reduced, order) for each in steps]
        sides = [_composed(each, [*steps, *moved], order) for each in series]
        equations = [side.get(powers, 0) for side in sides for powers in form.powers(order)]
        known |= _linear(equations, form.unknowns_of(order))
    last = {"critical": form.criticality, "speed": form.speed(parameter)}
    wanted = (*sorted(point), *form.unknowns)
    found = {name: known[name] for name in wanted} | {
        name: derive.simplest(placed(text)) for name, text in last.items()
    }
    if not all(map(derive.is_real, found.values())):
        raise Undecided("a coefficient is not defined: the bifurcation is degenerate")
    return found


Polynomial = dict[tuple[int, ...], Any]  # coefficients, expressions of sympy, by exponents


def _taylor(form: NormalForm, placed: Callable[[str], Any]) -> list[Polynomial]:
    """Return the equations as polynomials in the steps of point and image, at the fixed point."""
    import sympy

    of, found = form.map, []
    rest = ", ".join(f"{image}={x}" for image, x in zip(of.images, of.state, strict=True))
    names = (*of.state, *of.images)
    for each in of.equations:
        terms: Polynomial = {}
        for powers in product(range(form.order + 1), repeat=len(names)):
            if 0 < sum(powers) <= form.order:
                by = ", ".join(
                    name for name, n in zip(names, powers, strict=True) for _ in range(n)
                )
                value = derive.simplest(placed(f"at(D({each}, {by}), {rest})"))
                if value != 0:
                    terms[powers] = value / sympy.prod(map(sympy.factorial, powers))
        found.append(terms)
    return found


def _truncated(expression: Any, form: NormalForm, order: int) -> Polynomial:
    """Return a polynomial in the coordinates without higher terms, whose unknowns it may hold."""
    import sympy

    terms = sympy.Poly(expression, *map(sympy.Symbol, form.coordinates)).terms()
    return {powers: value for powers, value in terms if sum(powers) <= order and value != 0}


def _composed(outer: Polynomial, inner: list[Polynomial], order: int) -> Polynomial:
    """Put polynomials without constant terms into another one, without higher terms."""
    total: Polynomial = {}
    for powers, value in outer.items():
        term: Polynomial = {(0,) * len(next(iter(inner[0]))): value}
        for place, n in enumerate(powers):
            for _ in range(n):
                term = _product(term, inner[place], order)
        for exponents, each in term.items():
            total[exponents] = total.get(exponents, 0) + each
    return total


def _product(a: Polynomial, b: Polynomial, order: int) -> Polynomial:
    result: Polynomial = {}
    for one, c in a.items():
        for two, d in b.items():
            exponents = tuple(map(sum, zip(one, two, strict=True)))
            if sum(exponents) <= order:
                result[exponents] = result.get(exponents, 0) + c * d
    return result


def _linear(equations: list[Any], names: tuple[str, ...]) -> Solution:
    """Solve equations that are linear in the names; they may be more than these, if consistent."""
    import sympy

    unknowns = [sympy.Symbol(name) for name in names]
    tops = [sympy.numer(derive.simplest(each)) for each in equations]
    tops = [top for top in tops if top != 0]
    found = sympy.solve(tops, unknowns, dict=True) if names else [{}] * (not tops)
    if len(found) != 1 or len(found[0]) != len(names):
        raise Undecided(f"no coefficients {', '.join(names)}: the bifurcation is degenerate")
    return {str(name): derive.simplest(value) for name, value in found[0].items()}
