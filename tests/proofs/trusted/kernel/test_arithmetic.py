"""The checker's numbers against Arb at far higher precision, and against `intervals`."""

import math
from fractions import Fraction

import flint
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from intervals import Interval
from proofs.trusted.equations import sincos
from proofs.trusted.kernel import arithmetic, elementary
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.elementary import log
from tests.once import examples

TRUTH_BITS = 4096
PRECISIONS = (8, 24, 53, 64, 113, 400, 2000)

quick = settings(max_examples=examples(40))
bits_of = st.sampled_from(PRECISIONS)
tame = st.fractions(-1000, 1000, max_denominator=10**12)
tiny = st.builds(lambda m, k: Fraction(m, 2**k), st.integers(-9, 9), st.integers(40, 300))
numbers = tame | tiny | st.integers(-9, 9).map(Fraction)
widths = st.sampled_from([Fraction(0), Fraction(1, 10**15), Fraction(1, 100), Fraction(1), 3, 7])


@st.composite
def near_quarter_turns(draw):
    """A rational within 10^-30 or so of a multiple of pi/2."""
    multiple = draw(st.integers(-(10**6), 10**6) | st.integers(-4, 4))
    digits = draw(st.integers(3, 60))
    quarter = exactly(lambda: flint.arb.pi() / 2)[0]
    return Fraction(multiple * quarter * 10**digits // 1 + draw(st.integers(-2, 2)), 10**digits)


angles = numbers | near_quarter_turns()


def arb(value: Fraction) -> flint.arb:
    return flint.arb(flint.fmpq(value.numerator, value.denominator))


def exactly(compute) -> tuple[Fraction, Fraction]:
    """The bounds that Arb gives at TRUTH_BITS, as rationals."""
    with flint.ctx.workprec(TRUTH_BITS):
        ball = compute()
        ends = []
        for end in (ball.lower(), ball.upper()):
            mantissa, exponent = end.man_exp()
            ends.append(Fraction(int(mantissa)) * Fraction(2) ** int(exponent))
    return ends[0], ends[1]


def contains(found: Enclosure, compute) -> bool:
    low, high = exactly(compute)
    return found.range[0] <= low and high <= found.range[1]


def box(low: Fraction, width: Fraction, bits: int) -> Enclosure:
    return Enclosure.of(low, low + width, bits)


def inside(share: Fraction, low: Fraction, width: Fraction) -> Fraction:
    return low + width * share


shares = st.fractions(0, 1, max_denominator=1000)
intervals_with_a_point = st.tuples(numbers, widths, shares)


# -- pi, rounding of inputs ------------------------------------------------------------------------


@pytest.mark.parametrize("bits", [1, 2, *range(3, 400, 7), 1000, 4000, 12000])
def test_pi_is_enclosed_and_tight(bits):
    low, high = pi(bits).range
    truth = "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862"
    assert low < Fraction(truth) + Fraction(1, 10**80) and Fraction(truth) < high
    with flint.ctx.workprec(bits + 200):
        assert arb(low) < flint.arb.pi() < arb(high)
    assert pi(bits).hi - pi(bits).lo <= 5


@pytest.mark.slow
def test_pi_at_very_many_precisions():
    """Some of them find pi next to a multiple of 2^-bits, where a lost error term shows."""
    mantissa = exactly(flint.arb.pi)[0]
    for bits in range(1, 1500):
        low, high = pi(bits).range
        assert low <= mantissa < high, bits


@quick
@given(numbers, widths, bits_of)
def test_of_is_the_tightest_enclosure(low, width, bits):
    found = box(low, width, bits)
    unit = Fraction(1, 2**bits)
    assert found.range[0] <= low < found.range[0] + unit
    assert found.range[1] - unit < low + width <= found.range[1]


# -- + - * / and powers ----------------------------------------------------------------------------

OPERATIONS = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
}


@pytest.mark.parametrize("name", OPERATIONS)
@quick
@given(intervals_with_a_point, intervals_with_a_point, bits_of)
def test_arithmetic_contains_every_result(name, one, two, bits):
    operate = OPERATIONS[name]
    (a, wa, x), (b, wb, y) = ((low, width, low + width * share) for low, width, share in (one, two))
    first, second = box(a, wa, bits), box(b, wb, bits)
    if name == "/" and second.lo <= 0 <= second.hi:
        with pytest.raises(Unproved):
            operate(first, second)
        return
    low, high = operate(first, second).range
    assert low <= operate(x, y) <= high


long_ends = st.tuples(st.integers(-(2**700), 2**700), st.integers(0, 2**40) | st.just(2**699))


@quick
@given(long_ends, long_ends, st.sampled_from([64, 640]))
def test_products_are_the_tightest_whatever_the_widths(one, two, bits):
    (a, b), (c, d) = ((low, low + width) for low, width in (one, two))
    found, products = Enclosure(a, b, bits) * Enclosure(c, d, bits), (a * c, a * d, b * c, b * d)
    assert (found.lo, found.hi) == (min(products) >> bits, -(-max(products) >> bits))


@pytest.mark.parametrize("name", OPERATIONS)
@quick
@given(numbers, numbers, bits_of)
def test_arithmetic_on_points_errs_by_the_inputs_roundings_only(name, a, b, bits):
    first, second = rational(a, bits), rational(b, bits)
    assume(not (name == "/" and second.lo <= 0 <= second.hi))
    ends = [
        OPERATIONS[name](x, y) for x in first.range for y in second.range if y != 0 or name != "/"
    ]
    low, high = OPERATIONS[name](first, second).range
    unit = Fraction(1, 2**bits)
    assert min(ends) - unit < low <= min(ends) and max(ends) <= high < max(ends) + unit


@quick
@given(intervals_with_a_point, st.integers(-5, 5), st.integers(1, 6), bits_of)
def test_integers_mix_in(piece, n, power, bits):
    a, width, share = piece
    x, found = inside(share, a, width), box(a, width, bits)
    for result, true in (
        (found + n, x + n),
        (n + found, x + n),
        (found - n, x - n),
        (n - found, n - x),
        (n * found, n * x),
        (-found, -x),
        (found**power, x**power),
    ):
        assert result.range[0] <= true <= result.range[1]
    if n:
        quotient = (found / n).range
        assert quotient[0] <= x / n <= quotient[1]


def test_only_positive_powers():
    with pytest.raises(ValueError, match="positive"):
        rational(Fraction(2), 64) ** 0


def test_precisions_do_not_mix():
    with pytest.raises(ValueError, match="precision"):
        rational(Fraction(1), 64) + rational(Fraction(1), 65)


@pytest.mark.parametrize("numerator", ["-1", "0", "1"])
@pytest.mark.parametrize("divisor", [("-1", "1"), ("0", "1"), ("-1", "0"), ("0", "0")])
def test_division_by_an_enclosure_of_zero_proves_nothing(numerator, divisor):
    with pytest.raises(Unproved):
        rational(Fraction(numerator), 64) / Enclosure.of(*map(Fraction, divisor), 64)


@pytest.mark.parametrize("a", [7, -7])
@pytest.mark.parametrize("b", [3, -3])
def test_quotients_round_down_and_up_for_every_sign(a, b):
    quotient = Enclosure(a, a, 0) / Enclosure(b, b, 0)
    assert (quotient.lo, quotient.hi) == ((2, 3) if a * b > 0 else (-3, -2))


# -- sin and cos -----------------------------------------------------------------------------------


@quick
@given(angles, widths, shares, bits_of)
def test_sincos_contains_every_value(low, width, share, bits):
    x = inside(share, low, width)
    sin, cos = box(low, width, bits).sincos()
    assert contains(sin, lambda: arb(x).sin())
    assert contains(cos, lambda: arb(x).cos())


@pytest.mark.parametrize("bits", [8, 64])
def test_sincos_of_very_many_points(bits):
    """Some of the values lie next to a multiple of 2^-bits, where a lost error term shows."""
    unit = Fraction(1, 2**bits)
    for k in range(1, 1500):
        x = Fraction(k * k, 97) // unit * unit
        sin, cos = rational(x, bits).sincos()
        with flint.ctx.workprec(300):
            for found, true in ((sin, arb(x).sin()), (cos, arb(x).cos())):
                assert arb(found.range[0]) <= true <= arb(found.range[1]), x


@quick
@given(angles, bits_of)
def test_sincos_of_a_point_errs_by_a_few_units(x, bits):
    point = rational(x, bits)
    for found in point.sincos():
        assert found.hi - found.lo <= point.hi - point.lo + 3
        assert -(1 << bits) <= found.lo <= found.hi <= 1 << bits


@quick
@given(st.integers(-(10**4), 10**4), st.integers(10, 60), bits_of)
def test_extrema_inside_are_reached_exactly(multiple, digits, bits):
    reach = Fraction(1, 10**digits)
    quarter = exactly(lambda: flint.arb.pi() / 2)[0]
    sin, cos = Enclosure.of(multiple * quarter - reach, multiple * quarter + reach, bits).sincos()
    found, end = ((cos, 1), (sin, 1), (cos, -1), (sin, -1))[multiple % 4]
    assert (found.hi if end > 0 else -found.lo) == 1 << bits


@quick
@given(angles, st.integers(1, 30), bits_of)
def test_wide_angles_give_all_of_the_circle(low, turns, bits):
    for found in Enclosure.of(low, low + 7 * turns, bits).sincos():
        assert (found.lo, found.hi) == (-(1 << bits), 1 << bits)


@pytest.mark.parametrize("x", [10**6, -(10**6), 10**40, Fraction(10**40, 7), 10**300])
@pytest.mark.parametrize("bits", [64, 300])
def test_sincos_of_huge_angles(x, bits):
    sin, cos = rational(Fraction(x), bits).sincos()
    assert contains(sin, lambda: arb(Fraction(x)).sin())
    assert contains(cos, lambda: arb(Fraction(x)).cos())
    assert max(sin.hi - sin.lo, cos.hi - cos.lo) <= 4


# -- log and exp -----------------------------------------------------------------------------------

positive = (
    st.fractions(Fraction(1, 10**6), 10**6, max_denominator=10**9)
    | st.integers(-400, 400).map(lambda k: Fraction(2) ** k)
    | st.sampled_from([Fraction(2, 3), Fraction(4, 3), 1 + Fraction(1, 10**40), Fraction(1)])
).filter(lambda x: x > 0)


@quick
@given(positive, bits_of)
def test_log(x, bits):
    found = log(x, bits)
    assert contains(found, lambda: arb(x).log())
    octaves = abs(x.numerator.bit_length() - x.denominator.bit_length()) + 2
    assert found.hi - found.lo <= octaves * (40 + 4 * bits)


@quick
@given(st.fractions(-40, 5, max_denominator=10**9) | tiny, st.sampled_from([0, 3]), shares, bits_of)
def test_exp(low, width, share, bits):
    x = inside(share, low, Fraction(width))
    assert contains(elementary.exp(box(low, Fraction(width), bits)), lambda: arb(x).exp())


@quick
@example(Fraction(-1, 61909), 24)
@given(st.fractions(-60, 60, max_denominator=10**9) | tiny, bits_of)
def test_exp_of_a_point_errs_by_a_few_units(x, bits):
    point = rational(x, bits)
    found = elementary.exp(point)
    assert found.hi - found.lo <= 3 + (2 + point.hi - point.lo) * Fraction(found.hi + 1, 1 << bits)


@pytest.mark.parametrize("x", [64, -64, 10**9])
def test_exp_out_of_range_proves_nothing(x):
    with pytest.raises(Unproved):
        elementary.exp(rational(Fraction(x), 64))


@quick
@given(st.integers(1, 2**70), st.booleans(), st.sampled_from([1, 2]), bits_of)
def test_the_series_of_exp_and_cos_err_by_32_units(size, is_negative, step, bits):
    z = min(size << bits >> 72, 1 << bits >> 2) * (-1 if is_negative or step == 2 else 1)
    found, exact = arithmetic.exponential(z, step, bits), Fraction(z, 2**bits)
    low, high = exactly(lambda: arb(exact).exp() if step == 1 else arb(-exact).sqrt().cos())
    assert low * 2**bits - 32 <= found <= high * 2**bits + 32


@pytest.mark.parametrize("bits", [8, 24])
def test_what_is_known_from_few_terms_holds_no_further_than_it_is_used(bits):
    """exp X from its lower end, if X is narrow; sin X, cos X from two terms, if X is near 0."""
    one, root = 1 << bits, 1 << (bits >> 1)
    for x in range(-one >> 1, 3 * one, max(1, one // 160)):
        for width in (1, root - 1, root, one >> 4):
            piece = Enclosure(x, x + width, bits)
            sin, cos = piece.sincos()
            for y in (x / one, (x + width) / one):
                values = math.sin(y), math.cos(y), math.exp(y)
                for found, true in zip((sin, cos, elementary.exp(piece)), values, strict=True):
                    assert found.lo - 1e-6 <= true * one <= found.hi + 1e-6


@pytest.mark.parametrize("off", [-31, 31])
def test_what_the_series_err_by_is_allowed_for(off, monkeypatch):
    """With few bits, some of very many values lie next to a multiple of a unit."""
    right = arithmetic.exponential
    for module in (arithmetic, elementary):
        monkeypatch.setattr(module, "exponential", lambda *given: right(*given) + off)
    by_halves = arithmetic._sincos_by_halves.__wrapped__
    for x in range(-4 << 8, 5 << 8):
        angle, grown = x / 2**8, elementary.exp(Enclosure(x, x, 8))
        sin, cos, first, last = by_halves(x, 8, 8 + 12 + 4 + 3, 2)
        assert first <= angle // (math.pi / 2) <= last <= first + 1
        for (low, high), true in (
            (sin, math.sin(angle)),
            (cos, math.cos(angle)),
            ((grown.lo, grown.hi), math.exp(angle)),
        ):
            assert low <= true * 2**8 + 1e-9 and true * 2**8 - 1e-9 <= high


# -- dual numbers ----------------------------------------------------------------------------------


def formula(x, y):
    """A function with every operation that the equations use."""
    sin, cos = sincos(x * y)
    return (sin * 2 - y + 1) / (cos + 3 - x * x) - (4 - sin) * -x


def formula_derivatives(x: flint.arb, y: flint.arb) -> tuple[flint.arb, flint.arb]:
    """Its partial derivatives, worked out by hand."""
    sin, cos = (x * y).sin(), (x * y).cos()
    top, bottom = 2 * sin - y + 1, cos + 3 - x * x
    by_x = (2 * y * cos * bottom - top * (-y * sin - 2 * x)) / bottom**2 + 4 - sin - x * y * cos
    by_y = ((2 * x * cos - 1) * bottom + top * x * sin) / bottom**2 - x * x * cos
    return by_x, by_y


small = st.fractions(-1, 1, max_denominator=1000)


@quick
@given(st.tuples(small, small), st.tuples(small, small), st.sampled_from([0, 1]), shares, bits_of)
def test_dual_derivatives(place, direction, percent, share, bits):
    (x, y), (dx, dy), width = place, direction, Fraction(percent, 100)
    first = Dual(box(x, width, bits), rational(dx, bits))
    second = Dual(box(y, width, bits), rational(dy, bits))
    try:
        found = formula(first, second)
    except Unproved:
        assume(False)
    at_x, at_y = inside(share, x, width), inside(share, y, width)

    def true() -> flint.arb:
        by_x, by_y = formula_derivatives(arb(at_x), arb(at_y))
        return by_x * arb(dx) + by_y * arb(dy)

    assert contains(found.derivative, true)


@quick
@given(small, small, bits_of)
def test_duals_and_enclosures_mix(x, y, bits):
    dual, constant = Dual(rational(x, bits), rational(Fraction(1), bits)), rational(y, bits)
    for found, true in (
        (dual + constant, 1),
        (constant + dual, 1),
        (dual - constant, 1),
        (constant - dual, -1),
        (dual * constant, y),
        (constant * dual, y),
        (1 - dual, -1),
        (3 * dual, 3),
        (-dual, -1),
    ):
        assert found.derivative.range[0] <= true <= found.derivative.range[1]


# -- two kernels -----------------------------------------------------------------------------------


def overlap(ours: Enclosure, theirs: Interval) -> bool:
    return ours.range[0] <= theirs.sup and theirs.inf <= ours.range[1]
