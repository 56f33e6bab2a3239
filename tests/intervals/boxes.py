"""Boxes to draw from, polynomials whose zeros are known, and what may be said of zeros in a box."""

import random
from fractions import Fraction
from functools import reduce

from hypothesis import given, settings
from hypothesis import strategies as st

from intervals.systems import Roots
from tests.intervals.oracle import exponent, pi_bounds, round_down, round_up, ulp
from tests.once import examples


def for_all(*strategies, tries=50, at_length=None):
    """Do as `given`, with so many examples, `at_length` in the whole suite."""

    def decorated(test):
        effort = settings(max_examples=examples(tries, at_length))
        return effort(given(*strategies)(test))

    return decorated


precisions = st.sampled_from([2, 3, 5, 24, 53, 64, 113, 200, 400]) | st.integers(2, 400)

ANYWHERE = ("grid", "power", "tiny", "huge", "quarter turn", "near one")
MODERATE = ("grid", "power", "tiny", "quarter turn", "near one")


@st.composite
def mantissas(draw, precision):
    """A positive int of at most `precision` bits: the length, then the bits."""
    bits = draw(st.sampled_from([precision, precision, 1, 2]) | st.integers(1, precision))
    bits = min(bits, precision)
    if bits <= 64:
        return draw(st.integers(1, (1 << bits) - 1))
    return random.Random(draw(st.integers(0, 2**32))).getrandbits(bits) | 1


@st.composite
def numbers(draw, precision, kinds=ANYWHERE, largest=None):
    """A positive number of `precision` bits."""
    kind = draw(st.sampled_from(kinds))
    man = draw(mantissas(precision))
    if kind == "grid":
        x = man * Fraction(2) ** draw(st.integers(-precision - 6, 6 - precision))
    elif kind == "power":
        x = Fraction(2) ** draw(st.integers(-60, 10))
    elif kind == "tiny":
        x = man * Fraction(2) ** -draw(st.integers(precision, precision + 1200))
    elif kind == "huge":
        x = man * Fraction(2) ** draw(st.integers(0, 1500))
    elif kind == "quarter turn":
        k = draw(st.integers(1, 12) | st.integers(1, 10**6))
        low, high = pi_bounds(precision + 64)
        x = draw(
            st.sampled_from([round_down(k * low / 2, precision), round_up(k * high / 2, precision)])
        )
    else:
        step = draw(st.integers(1, 3)) * Fraction(2) ** -precision
        x = round_down(1 + draw(st.sampled_from([-1, 2])) * step, precision)
    return x if largest is None or x <= largest else x / Fraction(2) ** exponent(x)


@st.composite
def boxes(draw, precision, kinds=ANYWHERE, largest=None, positive=False):
    """The ends of an interval: thin, an ulp wide, narrow, wide, around 0, touching 0."""
    shapes = ["thin", "thin", "ulp", "narrow", "wide"]
    shape = draw(st.sampled_from(shapes if positive else [*shapes, "around", "touching"]))
    x = draw(numbers(precision, kinds, largest))
    if shape in ("wide", "around"):
        y = draw(numbers(precision, kinds, largest))
        low, high = (-x, y) if shape == "around" else (min(x, y), max(x, y))
    elif shape == "touching":
        low, high = Fraction(0), x
    elif shape == "narrow":
        low, high = x, round_up(x + x * Fraction(2) ** -draw(st.integers(1, precision)), precision)
    else:
        low, high = x, x + (ulp(x, precision) if shape == "ulp" else 0)
    if not positive and draw(st.booleans()):
        low, high = -high, -low
    return low, high


def inside(low, high):
    """Rationals in [low, high], often its ends."""
    parts = st.sampled_from([0, 1, Fraction(1, 2)]) | st.integers(0, 2**16).map(
        lambda k: Fraction(k, 2**16)
    )
    return parts.map(lambda t: low + (high - low) * t)


# -- polynomials whose zeros are known, and what may be said of the zeros in a box -----------------


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
