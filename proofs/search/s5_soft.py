"""Section 5: every equation of the soft springs derived, and its bifurcations decided."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

from proofs.methods import derive
from proofs.methods.bifurcation.maps import Map
from proofs.methods.bifurcation.normal_forms import NormalForm
from proofs.methods.bifurcation.solving import coefficients, solve
from proofs.search.derivations import Solvers, prove_rows
from proofs.search.request import proving
from proofs.trusted.paper.formulas import Unknowns
from proofs.trusted.paper.s5_soft import doubling, near, soft, stability

_LIMIT = NormalForm(Map(("x", "lam"), near.LOCAL), "flip")


def _written(wanted: Unknowns, values: Mapping[str, Any]) -> dict[str, str]:
    return {name: derive.write(values[name]) for name in wanted.names}


def _flip(wanted: Unknowns) -> dict[str, str]:
    """Solve for the flip of the limit map, and its centre manifold."""
    texts = (*_LIMIT.map.fixed, _LIMIT.condition())
    (flip,) = solve([derive.read(f"at({each}, x=0)") for each in texts], ("lam", "b", "a"))
    return _written(wanted, coefficients(_LIMIT, {"x": derive.read("0"), **flip}, "a"))


def _cycle(wanted: Unknowns) -> dict[str, str]:
    """Solve for orbits of period 2 near the flip, order by order."""
    import sympy

    sides = [_cubic(derive.read(each)) for each in doubling.SIDES]
    coefficients: dict[Any, Any] = {}
    for order, names in enumerate(("b", "a l_1", "b_2 l_2", "a_2 l_3")):
        rates = [derive.simplest(side[order].subs(coefficients)) for side in sides]
        solved = sympy.solve(rates, sympy.symbols(names), dict=True)[0]
        coefficients = {x: value.subs(solved) for x, value in coefficients.items()} | solved
    return {
        name: derive.write(derive.simplest(coefficients[sympy.Symbol(name)]))
        for name in wanted.names
    }


def _cubic(side: Any) -> list[Any]:
    """Return the coefficients up to h^3 of a function of h, sines and cosines of multiples of h."""
    import sympy

    side = side.replace(sympy.sin, lambda x: x - x**3 / 6)
    side = side.replace(sympy.cos, lambda x: 1 - x**2 / 2)
    h = sympy.Symbol("h")
    others = sympy.QQ.frac_field(*sorted(side.free_symbols - {h}, key=str))
    series = sympy.ring(h, others)[0].from_expr(side)
    return [others.to_sympy(series.coeff(series.ring.gens[0] ** n)) for n in range(4)]


def _jet(wanted: Unknowns, *, height: int, slope: int) -> dict[str, str]:
    """Solve for the jet of the plastic map, and the derivatives of its second iterate."""
    import sympy

    h, r = sympy.symbols("h r")
    terms = (h, h**2, h**3, r, r * h)
    unknowns = [sympy.Symbol(name) for name in wanted.names[:5]]
    image = slope * h + sum(s * x for s, x in zip(unknowns[1:], terms[1:], strict=True))
    side = derive.read(f"at({near.LOCAL_PLASTIC}, a={height}, x=h)").subs("x1", image)
    jet = {unknowns[0]: sympy.Integer(slope)}
    for unknown, term in zip(unknowns[1:], terms[1:], strict=True):
        rate = side.diff(*_by(term)).subs({h: 0, r: 0}).subs(jet)
        jet[unknown] = derive.simplest(sympy.solve(rate, unknown)[0])
    once = image.subs(jet)
    twice = once.subs(h, once)
    rates = [twice.diff(*_by(x)).subs({h: 0, r: 0}) for x in (r, h**2, h * r, h**3)]
    values = [jet[unknown] for unknown in unknowns] + [derive.simplest(x) for x in rates]
    return _written(wanted, dict(zip(wanted.names, values, strict=True)))


def _by(term: Any) -> list[Any]:
    """Return the variables of a monomial, each as often as it occurs."""
    return [x for x, n in sorted(term.as_powers_dict().items(), key=str) for _ in range(n)]


_SOLVERS: Solvers = MappingProxyType(
    {
        near.FLIP: _flip,
        doubling.CYCLE: _cycle,
        near.JET: partial(_jet, height=4, slope=-1),
        near.PRINTED_JET: partial(_jet, height=2, slope=0),
    }
)
prove = proving(partial(prove_rows, rows=(*soft.ROWS, *stability.ROWS), solvers=_SOLVERS))
