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
    """Return what may be bifurcations, in closed form, solved for these names."""
    return solutions([derive.read(each) for each in (*form.map.fixed, form.condition())], names)


def solve(equations: list[Any], names: tuple[str, ...]) -> list[Solution]:
    """Return solutions in closed form, without roots; Undecided where none is found."""
    candidates = [point for point in solutions(equations, names) if not has_roots(point)]
    if not candidates:
        raise Undecided(f"no closed form of {', '.join(names)} without roots is found")
    return candidates


def solutions(equations: list[Any], names: tuple[str, ...]) -> list[Solution]:
    """Return real solutions in closed form; there may be others.

    Of each equation one factor is solved for a name in which it is linear, or that is the last one
    in it, and that is put into the others.
    """
    import sympy

    distinct: list[Solution] = []
    for each in _solved(equations, [sympy.Symbol(name) for name in names]):
        point = {str(name): value for name, value in each.items()}
        if point not in distinct:
            distinct.append(point)
    return distinct


def has_roots(point: Solution) -> bool:
    """Whether there are powers that are not whole: the checker has no series of these."""
    return bool(roots_of(point))


def roots_of(point: Solution) -> list[Any]:
    """Return the powers that are not whole, in an order."""
    import sympy

    powers = {power for value in point.values() for power in value.atoms(sympy.Pow)}
    roots = (x for x in powers if not x.exp.is_integer and x.base != sympy.E)
    return sorted(roots, key=sympy.default_sort_key)


def _solved(equations: list[Any], unknowns: list[Any]) -> list[Solution]:
    """Return real solutions of equations, by elimination, in the first order that yields any."""
    import sympy

    tops = [sympy.numer(derive.simplest(each)) for each in equations]
    for place, top in enumerate(tops):
        others = [*tops[:place], *tops[place + 1 :]]
        factors = [f for f in derive.factors(top) if f.has(*unknowns)] if top else []
        factors = [f for f in factors if not isinstance(f, sympy.exp)]  # that is not 0
        choices = [(f, x) for f in factors for x in unknowns if _solvable(f, x, unknowns)]
        if factors and {f for f, _ in choices} == set(factors):
            solved = [
                {unknown: derive.simplest(value.subs(rest)), **rest}
                for factor in factors
                for unknown in [next(x for f, x in choices if f == factor)]
                for value in _roots(factor, unknown)
                for rest in (
                    _solved(
                        [other.subs(unknown, value) for other in others],
                        [x for x in unknowns if x != unknown],
                    )
                    if others
                    else [{}]
                )
            ]
            solved = [each for each in solved if all(map(_may_be_real, each.values()))]
            if solved:
                return solved
    return []


def _may_be_real(value: Any) -> bool:
    return derive.is_real(value) and value.is_real is not False


def _solvable(factor: Any, x: Any, unknowns: list[Any]) -> bool:
    """Whether an expression is linear in x, or without other unknowns."""
    if not factor.has(x):
        return False
    alone = not (factor.free_symbols & set(unknowns)) - {x}
    return alone or (factor.is_polynomial(x) and factor.as_poly(x).degree() == 1)


def _roots(factor: Any, x: Any) -> list[Any]:
    """Return zeros of an expression: all that sympy finds, else those among simple numbers.

    (Of pi/2, where cos(x) is 0, the checker knows no sine.)
    """
    import sympy

    polynomial = factor.is_polynomial(x)
    powers = (x,) if polynomial else sympy.Poly(factor).gens
    try:
        if sum(each.has(x) for each in powers) == 1:
            return list(sympy.solve(factor, x))
        raise NotImplementedError  # x beside functions of x: sympy takes long, and finds nothing
    except NotImplementedError:
        simple = [sympy.Rational(n, 2) for n in range(-4, 5)]
        return [each for each in (*simple, sympy.pi, -sympy.pi) if factor.subs(x, each) == 0]


def coefficients(form: NormalForm, point: Solution, parameter: str) -> Solution:
    """Return what the homological equations determine at a bifurcation; critical, and speed."""
    values: Solution = dict(point)

    def placed(text: str) -> Any:
        return derive.read(text, values)

    series = _taylor(form, placed)
    for order in range(1, form.order + 1):
        chart = [_truncated(placed(text), form, order) for text in form.chart()]
        reduced = [_truncated(placed(text), form, order) for text in form.reduced()]
        steps = [{n: c for n, c in each.items() if any(n)} for each in chart]
        moved = [_composed(each, reduced, order) for each in steps]
        sides = [_composed(each, [*steps, *moved], order) for each in series]
        equations = [side.get(powers, 0) for side in sides for powers in form.powers(order)]
        values |= _linear(equations, form.unknowns_of(order))
    last = {"critical": form.criticality, "speed": form.speed(parameter)}
    wanted = (*sorted(point), *form.unknowns)
    named = {name: values[name] for name in wanted} | {
        name: derive.simplest(placed(text)) for name, text in last.items()
    }
    if not all(map(derive.is_real, named.values())):
        raise Undecided("a coefficient is not defined: the bifurcation is degenerate")
    return named


Polynomial = dict[tuple[int, ...], Any]  # coefficients, expressions of sympy, by exponents


def _taylor(form: NormalForm, placed: Callable[[str], Any]) -> list[Polynomial]:
    """Return the equations as polynomials in the steps of point and image, at the fixed point."""
    import sympy

    map_, polynomials = form.map, []
    rest = ", ".join(f"{image}={x}" for image, x in zip(map_.images, map_.state, strict=True))
    names = (*map_.state, *map_.images)
    for each in map_.equations:
        terms: Polynomial = {}
        for powers in product(range(form.order + 1), repeat=len(names)):
            if 0 < sum(powers) <= form.order:
                by = ", ".join(
                    name for name, n in zip(names, powers, strict=True) for _ in range(n)
                )
                value = derive.simplest(placed(f"at(D({each}, {by}), {rest})"))
                if value != 0:
                    terms[powers] = value / sympy.prod(map(sympy.factorial, powers))
        polynomials.append(terms)
    return polynomials


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
    for left, c in a.items():
        for right, d in b.items():
            exponents = tuple(map(sum, zip(left, right, strict=True)))
            if sum(exponents) <= order:
                result[exponents] = result.get(exponents, 0) + c * d
    return result


def _linear(equations: list[Any], names: tuple[str, ...]) -> Solution:
    """Solve equations that are linear in the names; they may be more than these, if consistent."""
    import sympy

    unknowns = [sympy.Symbol(name) for name in names]
    tops = [sympy.numer(derive.simplest(each)) for each in equations]
    tops = [top for top in tops if top != 0]
    solved = sympy.solve(tops, unknowns, dict=True) if names else [{}] * (not tops)
    if len(solved) != 1 or len(solved[0]) != len(names):
        raise Undecided(f"no coefficients {', '.join(names)}: the bifurcation is degenerate")
    return {str(name): derive.simplest(value) for name, value in solved[0].items()}
