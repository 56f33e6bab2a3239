"""Polynomials whose zeros are known, and what may be said of the zeros in a box."""

from functools import reduce

from intervals.newton import Roots


def from_roots(roots, t):
    return reduce(lambda total, root: total * (t - root), roots, 0 * t + 1)


def horner(coefficients, t):
    """The polynomial with these coefficients, lowest first."""
    return reduce(lambda total, c: total * t + c, reversed(coefficients), 0 * t)


def holds(box, point):
    return all(side.contains(value) for side, value in zip(box, point, strict=True))


def check_claim(outcome, given_box, box, zeros):
    """What is claimed about the zeros in the given box is true, and the box holds all of them."""
    inside = [zero for zero in zeros if holds(given_box, zero)]
    if outcome is Roots.NONE:
        assert not inside
        return
    assert all(holds(box, zero) for zero in inside)
    assert holds(given_box, box)
    assert outcome is not Roots.UNIQUE or len(inside) == 1
    assert outcome is not Roots.AT_LEAST_ONE or inside
