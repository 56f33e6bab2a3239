"""Closed forms of linear motions with constant coefficients, by sympy: candidates."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from intervals import Undecided
from proofs.methods import derive

_HINT = "nth_linear_constant_coeff_"  # sympy's matching of other kinds may go on for ever


def closed_form(
    name: str, time: str, equation: str, start: Sequence[str], numbers: Mapping[str, Fraction]
) -> str:
    """Return y(t) with y^(n) = equation and y^(k) = start at t = 0; formulas as the checker's.

    numbers: what stands for some parameters. Raises Undecided where the equation is not linear with
    constant coefficients, or sympy finds no form; then the system's file has to give one.
    """
    import sympy

    n, t = len(start), sympy.Symbol(time)
    y = sympy.Function(name)(t)
    rates = [sympy.Symbol(f"{name}_{k}") for k in range(n)]
    derivative = re.compile(rf"D\({name}((?:, {time})+)\)")
    text = derivative.sub(lambda match: f"{name}_{match[1].count(',')}", equation)
    text = re.sub(rf"\b{name}\b", f"{name}_0", text)
    places = {each: sympy.Rational(value) for each, value in numbers.items()}
    right = sympy.expand(derive.read(text, places))
    slopes = [sympy.diff(right, rate) for rate in rates]
    if any(slope.has(t, *rates) for slope in slopes):
        raise Undecided(f"the equation of {name} is not linear with constant coefficients")
    moving = right.subs({rate: y.diff(t, k) for k, rate in enumerate(rates)})
    try:
        forced = right.subs(dict.fromkeys(rates, 0)) != 0
        hint = _HINT + ("undetermined_coefficients" if forced else "homogeneous")
        general = sympy.dsolve(sympy.Eq(y.diff(t, n), moving), y, hint=hint).rhs
    except (NotImplementedError, ValueError, TypeError, AssertionError):  # the last of y/0
        raise Undecided(f"sympy finds no closed form of {name}") from None
    constants = sorted(general.free_symbols - right.free_symbols - {t}, key=str)
    conditions = [
        general.diff(t, k).subs(t, 0) - derive.read(value, places) for k, value in enumerate(start)
    ]
    solved = sympy.solve(conditions, constants, dict=True)
    form: Any = sympy.expand(general.subs(solved[0])) if solved else None
    if form is None or not derive.is_real(form) or form.has(sympy.Integral):
        raise Undecided(f"sympy finds no real closed form of {name}")
    return derive.write(form)
