"""The fixed-point kernels against Arb: the claimed error bounds, the quadrants, the constants."""

import itertools
import random
from fractions import Fraction
from math import floor

import flint
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mpmath.libmp import from_man_exp

from intervals.elementary import constants, tightest, trig
from intervals.elementary.constants import log2_fixed, pi_fixed
from intervals.elementary.explog import exp_fixed, log_fixed
from intervals.elementary.trig import sincos_fixed
from tests.intervals import oracle
from tests.intervals.oracle import encloses, evaluate, pi_bounds, quarter_turns

SMALL = 4  # the largest error bound that is met here; a unit is 2^-bits

widths = st.sampled_from([1, 2, 3, 53, 63, 255, 256, 257, 258]) | st.integers(1, 600)


def dyadic(man, exp):
    return man * Fraction(2) ** exp


@st.composite
def arguments(draw, largest=3000):
    """(man, exp) of any sign: short, long, tiny, around 1, and up to 2^largest."""
    size = draw(st.integers(1, 400))
    man = random.Random(draw(st.integers(0, 2**32))).getrandbits(size) | 1
    man = draw(st.sampled_from([1, 3, 5, man, man, man, (1 << size) - 1, (1 << size) + 1]))
    kind = draw(st.sampled_from(["around 1", "around 1", "tiny", "huge"]))
    top = {"around 1": (-6, 6), "tiny": (-700, -6), "huge": (6, largest)}[kind]
    return draw(st.sampled_from([-1, 1])) * man, draw(st.integers(*top)) - man.bit_length()


def within(value, error, bits, function, x):
    """Whether |function(x) 2^bits - value| <= error."""
    unit = Fraction(1, 2**bits)
    low, high = (value - error) * unit, (value + error) * unit
    return encloses(low, high, function, x, bits=2 * bits + 100)


# -- the constants ---------------------------------------------------------------------------------


def log2_bounds(bits):
    return evaluate(lambda: flint.arb(2).log(), bits + 8)


CONSTANTS = [(pi_fixed, pi_bounds), (log2_fixed, log2_bounds)]


@pytest.mark.parametrize(("fixed", "true"), CONSTANTS)
def test_constants_are_the_floors(fixed, true):
    low, high = true(6000)
    for bits in [*range(1, 800), 999, 1000, 1024, 2048, 3333, 5000]:
        expected = floor(low * 2**bits)
        assert expected == floor(high * 2**bits)
        assert fixed(bits) == expected


@pytest.mark.slow
@pytest.mark.parametrize(("fixed", "true"), CONSTANTS)
def test_constants_are_the_floors_at_length(fixed, true):
    low, _ = true(50_200)
    for bits in [*range(1, 5001), 20_000, 50_000]:
        assert fixed(bits) == floor(low * 2**bits)


@pytest.mark.parametrize(("fixed", "true"), CONSTANTS)
def test_a_floor_that_the_guard_bits_leave_open_is_settled_with_more(fixed, true, monkeypatch):
    arc, calls = constants._arc, []

    def vague(inverse, bits, sign):
        calls.append(bits)
        value, units = arc(inverse, bits, sign)
        return value, units << 60

    monkeypatch.setattr(constants, "_arc", vague)
    for bits in (1, 53, 200):
        assert fixed.__wrapped__(bits) == floor(true(400)[0] * 2**bits)
    assert len(set(calls)) > 3


@pytest.mark.parametrize(("sign", "function"), [(-1, flint.arb.atan), (1, flint.arb.atanh)])
def test_the_series_of_the_constants(sign, function):
    for inverse in (2, 3, 5, 26, 239, 8749):
        for bits in (1, 2, 10, 64, 333, 1500):
            value, error = constants._arc(inverse, bits, sign)
            assert within(value, error, bits, function, Fraction(1, inverse))
            assert error <= bits + 3


# -- sin and cos -----------------------------------------------------------------------------------


def check_sincos(man, exp, bits):
    x = dyadic(man, exp)
    s, c, error, n_low, n_high = sincos_fixed(man, exp, bits)
    assert 0 < error <= SMALL
    assert within(s, error, bits, flint.arb.sin, x)
    assert within(c, error, bits, flint.arb.cos, x)
    turns = quarter_turns(x)
    assert n_low <= turns <= n_high <= n_low + 1
    low, _ = pi_bounds(2 * bits + 500 + 2 * max(0, man.bit_length() + exp))
    distance = min(abs(x - turns * low / 2), abs(x - (turns + 1) * low / 2))
    if distance > Fraction(7, 2 ** (bits + 8)):
        assert n_low == n_high


@settings(deadline=None, max_examples=50)
@given(arguments(), widths)
@example((1, 0), 1)
@example((0, 0), 53)
@example((-1, -3000), 53)
@example((25, -4), 1)
def test_sincos(argument, bits):
    check_sincos(*argument, bits)


@pytest.mark.slow
@settings(deadline=None, max_examples=2000)
@given(arguments(), widths | st.integers(600, 5000))
def test_sincos_at_length(argument, bits):
    check_sincos(*argument, bits)


@pytest.mark.parametrize("bits", [1000, 2500, 5000])
def test_sincos_at_high_precision(bits):
    rng = random.Random(bits)
    for exp in (-bits, 3 - bits, 40 - bits, 0):
        check_sincos(rng.getrandbits(bits), exp, bits)


@settings(deadline=None, max_examples=50)
@given(
    st.integers(-12, 12) | st.integers(-(2**200), 2**200),
    widths,
    st.sampled_from([-8, 0, 2, 6, 8, 9, 10, 12, 40]),
    st.integers(-3, 3),
)
def test_sincos_next_to_the_multiples_of_a_quarter_turn(n, bits, extra, step):
    """Where the reduced argument vanishes to the working precision, or is a few units."""
    places = max(1, bits + extra)
    low, _ = pi_bounds(places + 400)
    check_sincos(round(n * low / 2 * 2**places) + step, -places, bits)


@pytest.mark.parametrize("bits", [1, 2, 8, 53])
def test_sincos_at_all_small_arguments(bits):
    for man in range(-64, 65):
        for exp in (-8, -4, -3, 0):
            check_sincos(man, exp, bits)


@settings(deadline=None, max_examples=50)
@given(st.integers(-785, 785), st.integers(9, 700))
def test_the_taylor_series_of_sin_and_cos(thousandths, bits):
    r = (thousandths << bits) // 1000
    s, u, error = trig._taylor(r, bits)
    x = Fraction(r, 2**bits)
    assert within(s, error, bits, flint.arb.sin, x)
    assert within(u, error, bits, lambda y: 2 * (y / 2).sin() ** 2, x)


# -- exp and log -----------------------------------------------------------------------------------


def check_exp(man, exp, bits):
    y, n, error = exp_fixed(man, exp, bits)
    assert 0 < error <= SMALL
    assert 1 << bits <= 2 * y < 4 << bits
    x = dyadic(man, exp)
    assert within(y, error, bits, lambda t: (t - n * flint.arb(2).log()).exp(), x)


@settings(deadline=None, max_examples=50)
@given(arguments(largest=40), widths)
@example((0, 0), 1)
@example((-1, 0), 1)
@example((-1, -3000), 53)
def test_exp(argument, bits):
    check_exp(*argument, bits)


@pytest.mark.slow
@settings(deadline=None, max_examples=2000)
@given(arguments(largest=60), widths | st.integers(600, 5000))
def test_exp_at_length(argument, bits):
    check_exp(*argument, bits)


@settings(deadline=None, max_examples=50)
@given(st.integers(-3000, 3000), widths, st.integers(-3, 3))
def test_exp_next_to_where_the_exponent_changes(n, bits, step):
    """At odd multiples of log(2) / 2 the reduced argument is largest, at the others it is 0."""
    low, _ = log2_bounds(bits + 100)
    check_exp(round(n * low / 2 * 2**bits) + step, -bits, bits)


@pytest.mark.parametrize("bits", [1, 2, 3, 8])
def test_exp_at_all_small_arguments(bits):
    for man in range(-200, 201):
        for exp in (-6, -3, 0):
            check_exp(man, exp, bits)


def check_log(man, exp, bits):
    y, error = log_fixed(man, exp, bits)
    assert 0 < error <= SMALL
    assert within(y, error, bits, flint.arb.log, dyadic(man, exp))


@settings(deadline=None, max_examples=50)
@given(arguments(), widths)
@example((1, 0), 1)
@example((1, -3000), 53)
def test_log(argument, bits):
    man, exp = argument
    check_log(abs(man), exp, bits)


@pytest.mark.slow
@settings(deadline=None, max_examples=2000)
@given(arguments(largest=10**6), widths | st.integers(600, 5000))
def test_log_at_length(argument, bits):
    man, exp = argument
    check_log(abs(man), exp, bits)


@settings(deadline=None, max_examples=50)
@given(st.sampled_from([Fraction(1), Fraction(2, 3), Fraction(4, 3)]), widths, st.integers(-3, 3))
def test_log_next_to_one_and_to_where_the_exponent_changes(centre, bits, step):
    places = bits + 5
    check_log(round(centre * 2**places) + step, -places, bits)


@pytest.mark.parametrize("bits", [1, 2, 3, 8])
def test_log_at_all_small_arguments(bits):
    for man in range(1, 300):
        for exp in (-8, -4, 0):
            check_log(man, exp, bits)


@pytest.mark.parametrize("bits", [1000, 2500, 5000])
def test_exp_and_log_at_high_precision(bits):
    rng = random.Random(bits)
    for exp in (-bits, 4 - bits, 30 - bits):
        man = rng.getrandbits(bits) | 1
        check_exp(man, exp, bits)
        check_exp(-man, exp, bits)
        check_log(man, exp, bits)


# -- rounding to the next number -------------------------------------------------------------------


@pytest.mark.parametrize("precision", [2, 3, 5])
def test_what_is_settled_is_how_all_the_numbers_are_rounded(precision):
    bits, unit = 3, Fraction(1, 8)
    for value, error in itertools.product(range(-80, 81), range(6)):
        ends = (value - error) * unit, (value + error) * unit
        expected = {(oracle.round_down(y, precision), oracle.round_up(y, precision)) for y in ends}
        found = tightest._settled(value, error, bits, precision)
        if found is None:
            assert len(expected) == 2
        else:
            ((down, up),) = expected
            assert [dyadic(-x[1] if x[0] else x[1], x[2]) for x in found] == [down, up]


@settings(deadline=None, max_examples=50)
@given(arguments(), st.integers(2, 200))
@example((0, 0), 53)
@example((1, -54), 53)
@example((-1, -54), 53)
@example((-1, -10_000), 53)
def test_the_quadrant_is_the_floor(argument, precision):
    _, _, quadrant = tightest.sincos(from_man_exp(*argument), precision)
    assert quadrant == quarter_turns(dyadic(*argument))


def test_a_kernel_that_errs_as_much_as_it_may_changes_nothing(monkeypatch):
    """The bounds come from Y and E alone: any Y within E of the truth gives the same ones."""
    rng = random.Random(7)
    samples = [(rng.getrandbits(24) | 1, -rng.randrange(18, 30)) for _ in range(60)]
    points = [from_man_exp(*sample) for sample in samples]

    def all_bounds():
        functions = (tightest.sincos, tightest.exp, tightest.log)
        return [f(x, p) for f in functions for x in points for p in (2, 11, 24, 53)]

    expected = all_bounds()
    for shift in (-1, 1):

        def sincos(man, exp, bits, shift=shift):
            s, c, error, n_low, n_high = sincos_fixed(man, exp, bits)
            return s + 50 * shift, c - 50 * shift, error + 50, n_low, n_high

        def exponential(man, exp, bits, shift=shift):
            y, n, error = exp_fixed(man, exp, bits)
            return y + 50 * shift, n, error + 50

        def logarithm(man, exp, bits, shift=shift):
            y, error = log_fixed(man, exp, bits)
            return y + 50 * shift, error + 50

        monkeypatch.setattr(tightest, "sincos_fixed", sincos)
        monkeypatch.setattr(tightest, "exp_fixed", exponential)
        monkeypatch.setattr(tightest, "log_fixed", logarithm)
        assert all_bounds() == expected
