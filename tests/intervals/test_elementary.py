"""The fixed-point kernels against Arb: the claimed error bounds, the quadrants, the constants."""

import random
from fractions import Fraction
from math import floor

import flint
import pytest
from hypothesis import example
from hypothesis import strategies as st

from intervals.elementary import circular, constants, exponential, logarithm, series
from intervals.elementary.circular import angle_fixed, sincos_fixed
from intervals.elementary.constants import arc_of_ratio, log2_fixed, log10_fixed, pi_fixed
from intervals.elementary.explog import exp_fixed, log_fixed
from tests.intervals.boxes import for_all
from tests.intervals.oracle import encloses, evaluate, pi_bounds, quarter_turns
from tests.once import EFFORT

SMALL = 4  # the largest error bound that is met here; a unit is 2^-bits

widths = st.sampled_from([1, 2, 3, 53, 63, 255, 256, 257, 258]) | st.integers(1, 600)
if not EFFORT.quick:
    widths |= st.integers(600, 5000)


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


def within(value, error, bits, function, *x):
    """Whether |function(x) 2^bits - value| <= error."""
    low, high = (Fraction(end, 2**bits) for end in (value - error, value + error))
    return encloses(low, high, function, *x, bits=2 * bits + 100)


# -- the constants ---------------------------------------------------------------------------------


def log_bounds(number):
    return lambda bits: evaluate(lambda: flint.arb(number).log(), bits + 8)


log2_bounds = log_bounds(2)
CONSTANTS = [(pi_fixed, pi_bounds), (log2_fixed, log2_bounds), (log10_fixed, log_bounds(10))]
FEW = [*range(1, 800), 999, 1000, 1024, 2048, 3333, 5000]
MANY = [*FEW, *range(801, 5001, 7), 20_000, 50_000]


@pytest.mark.parametrize(("fixed", "true"), CONSTANTS)
def test_constants_are_the_floors(fixed, true):
    tried = FEW if EFFORT.quick else MANY
    low, high = true(max(tried) + 200)
    for bits in tried:
        expected = floor(low * 2**bits)
        assert expected == floor(high * 2**bits)
        assert fixed(bits) == expected


@pytest.mark.parametrize(("fixed", "true"), CONSTANTS)
def test_a_floor_that_the_guard_bits_leave_open_is_settled_with_more(fixed, true, monkeypatch):
    arc, calls = constants.arc_of_ratio, []

    def vague(numerator, denominator, bits, sign):
        calls.append(bits)
        value, units = arc(numerator, denominator, bits, sign)
        return value, units << 60

    monkeypatch.setattr(constants, "arc_of_ratio", vague)
    for bits in (1, 53, 200):
        assert fixed.__wrapped__(bits) == floor(true(400)[0] * 2**bits)
    assert len(set(calls)) > 3


@pytest.mark.parametrize(("sign", "function"), [(-1, flint.arb.atan), (1, flint.arb.atanh)])
def test_the_series_of_the_constants(sign, function):
    for ratio in [Fraction(1, n) for n in (2, 3, 5, 26, 239, 8749)] + [Fraction(129, 641)]:
        for bits in (1, 2, 10, 64, 333, 1500):
            value, error = arc_of_ratio(ratio.numerator, ratio.denominator, bits, sign)
            assert within(value, error, bits, function, ratio)
            assert error <= 2 * bits + 6


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


@for_all(arguments(), widths, at_length=400)
@example((1, 0), 1)
@example((0, 0), 53)
@example((-1, -3000), 53)
@example((25, -4), 1)
def test_sincos(argument, bits):
    check_sincos(*argument, bits)


@for_all(
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


# -- the series and the tables ---------------------------------------------------------------------


@for_all(st.integers(0, 2**32), st.integers(10, 700), st.integers(7, 40), tries=100)
@example(0, 10, 7)
@example(2**32, 10, 7)
@example(2**32, 700, 7)
def test_the_series(part, bits, small):
    """At all of 0 <= r < 2^-7 that the theorems speak of; kernels use them below 2^-16."""
    r = min(part << bits >> (32 + small), (1 << (bits - 7)) - 1)
    x = Fraction(r, 2**bits)
    for sign, function in ((-1, flint.arb.atan), (1, flint.arb.atanh)):
        value, error = series.arc(r, bits, sign)
        assert within(value, error, bits, function, x)
    value, error = series.exp_series(r, bits)
    low, high = Fraction(value, 2**bits), Fraction(value + error, 2**bits)
    assert encloses(low, high, flint.arb.exp, x, bits=2 * bits + 100)
    u, error = series.versine_series(r, bits)
    assert within(u, error, bits, lambda y: 2 * (y / 2).sin() ** 2, x)


@pytest.mark.parametrize("bits", [16, 80, 368, 1008])
def test_the_tables(bits):
    for scale in (series.COARSE, series.FINE):
        largest = 1 << scale
        for j in [*range(1, 20), 86, 128, 177, 200, 255, 256]:
            x = Fraction(j, largest)
            if j < largest:
                assert within(series.exp_at(j, scale, bits), 2, bits, flint.arb.exp, x)
                assert encloses(
                    Fraction(series.exp_at(j, scale, bits), 2**bits), 4, flint.arb.exp, x, bits=2000
                )
                s, c = series.sincos_at(j, scale, bits)
                assert within(s, 2, bits, flint.arb.sin, x)
                assert within(c, 2, bits, flint.arb.cos, x)
            assert within(series.atan_at(j, scale, bits), 2, bits, flint.arb.atan, x)
    for step, steps in ((8, range(170, 400, 9)), (15, range(32500, 33100, 50))):
        for c in steps:
            x = Fraction(c, 1 << step)
            assert within(series.log_at(c, step, bits), 2, bits, flint.arb.log, x)


# -- exp and log -----------------------------------------------------------------------------------


BASES = {2: log2_fixed, 10: log10_fixed}


def check_exp(man, exp, bits, base=None):
    """base^x = y 2^n for x = man 2^exp; the base is e if there is none."""
    y, n, error = exp_fixed(man, exp, bits, BASES.get(base))
    assert 0 < error <= SMALL
    assert 1 << bits <= y < 2 << bits

    def function(t):
        exponent = t * flint.arb(base).log() if base else t
        return (exponent - n * flint.arb(2).log()).exp()

    assert within(y, error, bits, function, dyadic(man, exp))


@for_all(arguments(largest=40), widths, st.sampled_from([None, None, *BASES]), at_length=400)
@example((0, 0), 1, None)
@example((-1, 0), 1, None)
@example((-1, -3000), 53, None)
def test_exp(argument, bits, base):
    check_exp(*argument, bits, base)


@for_all(st.integers(-3000, 3000), widths, st.integers(-3, 3))
def test_exp_next_to_where_the_exponent_changes(n, bits, step):
    """At odd multiples of log(2) / 2 the reduced argument is largest, at the others it is 0."""
    low, _ = log2_bounds(bits + 100)
    check_exp(round(n * low / 2 * 2**bits) + step, -bits, bits)


def check_log(man, exp, bits):
    y, error = log_fixed(man, exp, bits)
    assert 0 < error <= SMALL
    assert within(y, error, bits, flint.arb.log, dyadic(man, exp))


@for_all(arguments(largest=10**6), widths, at_length=400)
@example((1, 0), 1)
@example((1, -3000), 53)
@example((1, 10**5), 1)
def test_log(argument, bits):
    man, exp = argument
    check_log(abs(man), exp, bits)


@for_all(st.sampled_from([Fraction(1), Fraction(2, 3), Fraction(4, 3)]), widths, st.integers(-3, 3))
def test_log_next_to_one_and_to_where_the_exponent_changes(centre, bits, step):
    places = bits + 5
    check_log(round(centre * 2**places) + step, -places, bits)


@pytest.mark.parametrize("bits", [1, 2, 3, 8, 53])
def test_all_small_arguments(bits):
    for man in range(1, 300):
        for exp in (-8, -6, -4, -3, 0):
            check_log(man, exp, bits)
            if man <= 200:
                check_exp(man, exp, bits)
                check_exp(-man, exp, bits)
            if man <= 64:
                check_sincos(man, exp, bits)
                check_sincos(-man, exp, bits)


@pytest.mark.parametrize("bits", [1000, 2500, 5000])
def test_high_precision(bits):
    rng = random.Random(bits)
    for exp in (-bits, 4 - bits, 40 - bits, 0):
        man = rng.getrandbits(bits) | 1
        check_sincos(man, exp, bits)
        if exp:
            check_exp(man, exp, bits)
            check_exp(-man, exp, bits)
        check_log(man, exp, bits)


# -- angles ----------------------------------------------------------------------------------------


def check_angle(y, x, bits):
    angle, error = angle_fixed(y, x, bits)
    assert 0 < error <= SMALL
    assert within(angle, error, bits, flint.arb.atan2, y, x)


@for_all(arguments(largest=900), arguments(largest=900), widths, tries=100, at_length=250)
@example((1, 0), (0, 0), 1)
@example((0, 0), (1, 0), 1)
@example((1, 0), (1, 0), 53)
@example((255, 0), (256, 0), 53)
@example((257, 0), (256, 0), 53)
@example((1, 0), (2**16 + 1, 0), 53)
def test_angles(first, second, bits):
    shift = min(first[1], second[1])
    check_angle(*(abs(man) << (exp - shift) for man, exp in (first, second)), bits)


@pytest.mark.parametrize("bits", [1, 2, 8, 53])
def test_all_small_angles(bits):
    for y in range(40):
        for x in range(40):
            if x or y:
                check_angle(y, x, bits)


# -- the kernels' errors ---------------------------------------------------------------------------


def test_a_kernel_that_errs_as_much_as_it_may_changes_nothing(monkeypatch):
    """The bounds come from Y and E alone; for those that `tighten` gives see test_tightest."""
    rng = random.Random(7)
    samples = [(rng.getrandbits(24) | 1, -rng.randrange(18, 30)) for _ in range(30)]
    points = [(0, man, exp, man.bit_length()) for man, exp in samples]

    def all_bounds():
        functions = circular.sincos, circular.tan, logarithm.log, exponential.exp
        return [f(x, p) for f in functions for x in points for p in (2, 11, 24, 53)]

    def moved(kernel, places, units):
        """The kernel with the values at these places moved by some units, and with that error."""

        def moving(*arguments):
            parts = list(kernel(*arguments))
            for place in places:
                parts[place] += units
            parts[2 if len(parts) > 2 else 1] += abs(units)
            return tuple(parts)

        return moving

    expected = all_bounds()
    for units in (-50, 50):
        monkeypatch.setattr(circular, "sincos_fixed", moved(sincos_fixed, (0, 1), units))
        monkeypatch.setattr(exponential, "exp_fixed", moved(exp_fixed, (0,), units))
        monkeypatch.setattr(logarithm, "log_fixed", moved(log_fixed, (0,), units))
        assert all_bounds() == expected
