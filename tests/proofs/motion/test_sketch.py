"""Floats that stand for the checker's numbers in a search: like these, and never believed."""

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intervals import DomainError
from proofs.motion.sketch import Sketch
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.gaps import falls, stays_up

ends = st.lists(st.fractions(-9, 9, max_denominator=999), min_size=2, max_size=2).map(sorted)


def alike(seen, proved):
    """Whether a sketch has about the ends of an enclosure."""
    pairs = zip(seen.range, proved.range, strict=True)
    return all(math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9) for x, y in pairs)


@pytest.mark.slow
@given(ends, ends)
def test_operations_are_about_those_of_enclosures(first, second):
    (x, y), (u, v) = (
        [kind.of(*ends, 80) for ends in (first, second)] for kind in (Sketch, Enclosure)
    )
    pairs = [(x + y, u + v), (x - y, u - v), (x * y, u * v), (-x, -u), (2 - x, 2 - u)]
    pairs += [(Fraction(1, 3) * x + 1, u * Fraction(1, 3) + 1), (x**2, u**2)]
    pairs += zip(x.sincos(), u.sincos(), strict=True)
    if min(y.lo, -y.hi) > 0.01 or y.lo > 0.01:
        pairs += [(x / y, u / v), (1 / y, 1 / v)]
    if max(x.lo, y.lo) < min(x.hi, y.hi):
        pairs += [(x.meet(y), u.meet(v))]
    assert all(alike(*pair) for pair in pairs)


@given(st.floats(0.1, 3), st.floats(0.01, 0.5), st.floats(0.5, 3))
def test_the_lemmas_on_flights_take_them(height, width, bend):
    """gap = height - time^2 bend / 2, by hand."""

    def gap_of(time, order):
        t = Sketch.of(*time)
        return (height - t * t * (bend / 2), -(t * bend), Sketch(-bend, -bend))[order]

    time = Fraction(1), 1 + Fraction(width)
    ends = [height - float(x) ** 2 * bend / 2 for x in time]
    assert stays_up(gap_of, time, min(ends)) == (min(ends) > 0)
    assert falls(gap_of, time)


def test_what_a_float_is_too_small_for_is_refused():
    for make in (
        lambda: Sketch.of(Fraction(10) ** 400, 0),
        lambda: 1 / Sketch(-1.0, 1.0),
        lambda: Sketch(math.inf, math.inf).sincos(),
        lambda: Sketch(math.nan, math.nan).sincos(),
    ):
        with pytest.raises(DomainError):
            make()
