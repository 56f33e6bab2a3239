"""Taylor forms: the range of a function of one variable, with an error of any order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from intervals.formula import Formula
from intervals.generic import Number, ends, meet, middle, where
from intervals.jet import Jet

_NEWTON_STEPS = 4  # each doubles the order of the width of Z: enough up to order 31


def taylor(f: Callable[[Any], Any], x: Number, order: int = 2) -> Number:
    """Enclose the range of f over X, an Interval or an IntervalArray, by its Taylor form.

    Hypothesis: f is a formula that takes jets, n = order times differentiable on X. Theorem: with
    c_k = f^(k) / k!, m in X and H = X - m, each f(x) is q(x - m) for a polynomial q with
    coefficients c_0(m), ..., c_(n-1)(m) and one from c_n(X) (Lagrange), and jets enclose these.
    The result also lies within the natural form f(X). If f has n + 1 continuous derivatives and
    `polynomial_range` is in the first or second case of its theorem, the result exceeds the range
    by O(wid X^(n+1)): order 0 is the natural form, order 1 the mean-value form.
    """
    if order < 0:
        raise ValueError("the order is at least 0")
    point, formula = middle(x), Formula(f, 1).only
    over: list[Number] = list(formula(Jet.variable(x, order)).coefficients)
    at: list[Number] = list(formula(Jet.variable(point, order)).coefficients)
    return meet(over[0], polynomial_range([*at[:order], over[order]], x - point))


def polynomial_range(coefficients: list[Any], h: Number) -> Number:
    """Enclose q(H) for all polynomials q with coefficients in the given ones, lowest first.

    Theorem. If Z contains all zeros of q' in H, q(H) is in the hull of q at the ends of H and q(Z).
    Proof: q attains its extrema over H at an end or at a zero of q'.
    Z is a point where q' is of one sign over H; the intersection of H with some interval Newton
    images for q' where q'' is; and H else. q(Z) lies in q(z) + q'(Z) (Z - z), z in Z.
    """
    slopes = _derivative(coefficients)
    left, right = ends(h)
    slope = _value(slopes, h)
    monotone = (slope.inf >= 0) | (slope.sup <= 0)
    critical = where(monotone, left, h)
    if not np.all(monotone):
        critical = where(monotone, left, _critical(slopes, h))
    z = middle(critical)
    inside = _value(coefficients, z) + _value(slopes, critical) * (critical - z)
    return _value(coefficients, left).hull(_value(coefficients, right)).hull(inside)


def _critical(slopes: list[Any], h: Number) -> Number:
    """Return a part of H that contains the zeros of q' in H, by interval Newton where q'' != 0."""
    curvatures = _derivative(slopes)
    part = h
    for _ in range(_NEWTON_STEPS):
        curvature = _value(curvatures, part)
        usable = np.logical_not(curvature.contains_zero())
        z = middle(part)
        image = z - _value(slopes, z) / where(usable, curvature, h * 0 + 1)
        part = where(usable, meet(part, image), part)
    return part


def _derivative(coefficients: list[Any]) -> list[Any]:
    return [k * c for k, c in enumerate(coefficients)][1:]


def _value(coefficients: list[Any], h: Number) -> Number:
    """Return the polynomial at H by Horner's scheme."""
    total = h * 0
    for c in reversed(coefficients):
        total = total * h + c
    return total
