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
from proofs.search.derivations import prove_rows
from proofs.trusted.paper.formulas import Unknowns
from proofs.trusted.paper.s5_soft import near, soft, stability

_LIMIT = NormalForm(Map(("x", "lam"), near.LOCAL), "flip")
_STIFF = NormalForm(Map(("x",), (f"at({near.STIFF_LOCAL}, {near.STIFF_HERE})",)), "flip")


def _at_origin(*texts: str, names: tuple[str, ...]) -> dict[str, Any]:
    """Solve equations at x = 0 for names, of which there is one solution."""
    (found,) = solve([derive.read(f"at({each}, x=0)") for each in texts], names)
    return {"x": derive.read("0"), **found}


def _written(wanted: Unknowns, found: Mapping[str, Any]) -> dict[str, str]:
    return {name: derive.write(found[name]) for name in wanted.names}


def _point(wanted: Unknowns) -> dict[str, str]:
    """Solve for the fixed point of the limit map and its Jacobian."""
    found = _at_origin(*_LIMIT.map.fixed, names=("lam", "b"))
    matrix = _LIMIT.map.jacobian_at(found)
    entries = {f"j{i + 1}{j + 1}": matrix[i, j] for i in (0, 1) for j in (0, 1)}
    return _written(wanted, found | entries)


def _flip(wanted: Unknowns) -> dict[str, str]:
    """Solve for the flip of the limit map, and its centre manifold."""
    texts = (*_LIMIT.map.fixed, _LIMIT.condition())
    point = _at_origin(*texts, names=("lam", "b", "a"))
    return _written(wanted, coefficients(_LIMIT, point, "a"))


def _stiff_flip(wanted: Unknowns) -> dict[str, str]:
    """Solve for the normal form of the flip of springs of any stiffness."""
    point = _at_origin(_STIFF.condition(), names=("a",))
    return _written(wanted, coefficients(_STIFF, point, "a"))


def _jet(wanted: Unknowns, *, height: int, slope: int) -> dict[str, str]:
    """Solve for the jet of the plastic map, and the derivatives of its second iterate."""
    import sympy

    h, r = sympy.symbols("h r")
    terms = (h, h**2, h**3, r, r * h)
    unknowns = [sympy.Symbol(name) for name in wanted.names[:5]]
    image = slope * h + sum(s * x for s, x in zip(unknowns[1:], terms[1:], strict=True))
    side = derive.read(f"at({near.LOCAL_PLASTIC}, a={height}, x=h)").subs("x1", image)
    known = {unknowns[0]: sympy.Integer(slope)}
    for unknown, term in zip(unknowns[1:], terms[1:], strict=True):
        rate = side.diff(*_by(term)).subs({h: 0, r: 0}).subs(known)
        known[unknown] = derive.simplest(sympy.solve(rate, unknown)[0])
    once = image.subs(known)
    twice = once.subs(h, once)
    rates = [twice.diff(*_by(x)).subs({h: 0, r: 0}) for x in (r, h**2, h * r, h**3)]
    found = [known[unknown] for unknown in unknowns] + [derive.simplest(x) for x in rates]
    return _written(wanted, dict(zip(wanted.names, found, strict=True)))


def _by(term: Any) -> list[Any]:
    """Return the variables of a monomial, each as often as it occurs."""
    return [x for x, n in sorted(term.as_powers_dict().items(), key=str) for _ in range(n)]


prove = partial(
    prove_rows,
    (*soft.ROWS, *stability.ROWS),
    solvers=MappingProxyType(
        {
            near.POINT: _point,
            near.FLIP: _flip,
            near.STIFF_FLIP: _stiff_flip,
            near.JET: partial(_jet, height=4, slope=-1),
            near.PRINTED_JET: partial(_jet, height=2, slope=0),
        }
    ),
)
