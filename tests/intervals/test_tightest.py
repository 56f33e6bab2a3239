"""The tightest functions against Arb at three times the precision and more, and exact cases."""

import itertools
import random
from fractions import Fraction

import flint
import pytest
from hypothesis import assume, example
from hypothesis import strategies as st
from mpmath import iv
from mpmath.libmp import from_man_exp

from intervals.elementary import algebraic, circular, exponential, logarithm, power, tightest, ziv
from intervals.elementary.tightest import FUNCTIONS
from tests.intervals import oracle
from tests.intervals.boxes import for_all, numbers, precisions
from tests.intervals.oracle import encloses, exponent, outward, quarter_turns, rounded

LARGEST = dict.fromkeys(("exp", "exp2", "exp10", "sinh", "cosh"), 2**20) | {
    "expm1": 500,  # beyond these the oracle would need as many bits
    "tanh": 500,
}


EVERY = FUNCTIONS | {  # of one number
    "sin": lambda x, precision: tightest.sincos(x, precision)[0],
    "cos": lambda x, precision: tightest.sincos(x, precision)[1],
}


def raw(x):
    x = Fraction(x)
    return from_man_exp(x.numerator, 1 - x.denominator.bit_length())


def exact(bounds):
    return tuple(
        Fraction(-int(m) if sign else int(m)) * Fraction(2) ** e for sign, m, e, _ in bounds
    )


def into_domain(name, x):
    """A number in the domain with the bits of x."""
    largest = LARGEST.get(name)
    if largest and abs(x) > largest:
        x /= Fraction(2) ** exponent(x)
    if name in ("asin", "acos", "atanh") and abs(x) >= 1:
        x /= Fraction(2) ** (exponent(x) + 1)
    if name == "acosh" and abs(x) < 1:
        x += 1 if x > 0 else -1
    return x if in_domain(name, x) else -x


def in_domain(name, x):
    return oracle.DOMAINS.get(name, lambda _: True)(x)


def check(name, x, precision):
    """The bounds are the numbers next to the value; nothing is asked outside the domain."""
    if in_domain(name, x):
        assert exact(EVERY[name](raw(x), precision)) == rounded(name, x, precision)


@pytest.mark.parametrize("name", EVERY)
@for_all(st.data(), precisions, precisions, st.sampled_from([-1, 1]), tries=30, at_length=150)
def test_tight(name, data, width, precision, sign):
    x = into_domain(name, sign * data.draw(numbers(width)))
    assume(in_domain(name, x))
    check(name, x, precision)


def any_number(rng):
    """A number with up to 200 bits: around 1, near 1, small, tiny, large, of both signs."""
    man = rng.getrandbits(rng.choice([1, 2, 5, 24, 53, 53, 113, 200])) | 1
    top = rng.choice([(-6, 5), (-6, 5), (-6, 5), (-40, 10), (-600, -40), (0, 8)])
    x = man * Fraction(2) ** (rng.randint(*top) - man.bit_length())
    if rng.random() < 0.15:
        x = 1 + rng.choice([-1, 1]) * Fraction(1, 2 ** rng.randint(2, 300))
    return rng.choice([-1, 1]) * x


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("precision", [2, 3, 53])
def test_where_arguments_become_so_small_that_they_decide(name, precision):
    """Around 2^-p, 2^(-p/2), 2^(-p/3), where x, 1, 1 + x are next to the value."""
    powers = {-precision // part + k for part in (1, 2, 3) for k in range(-3, 5)}
    for k, sign, least in itertools.product(powers, (-1, 1), (0, Fraction(1, 2**20))):
        for x in (sign * (1 - least) * Fraction(2) ** k, 1 + sign * (1 - least) * Fraction(2) ** k):
            check(name, x, precision)


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("precision", [2, 53, 333, pytest.param(3333, marks=pytest.mark.slow)])
def test_small_integers_and_simple_fractions(name, precision):
    for numerator, denominator in itertools.product(range(-9, 10), (1, 2, 4, 8)):
        check(name, Fraction(numerator, denominator), precision)


# -- functions of two numbers ----------------------------------------------------------------------


TWO = {"atan2": tightest.atan2, "hypot": tightest.hypot, "pow": tightest.power}


def check_two(name, x, y, precision):
    assert exact(TWO[name](raw(x), raw(y), precision)) == rounded(name, x, y, precision)


small_exponents = st.sampled_from([Fraction(k, 8) for k in range(-40, 41)])
signs = st.sampled_from([-1, 0, 1, 1])


@pytest.mark.parametrize("name", TWO)
@for_all(
    st.data(), precisions, precisions, precisions, signs, st.sampled_from([-1, 1]), at_length=200
)
def test_functions_of_two_numbers_are_tight(name, data, width, height, precision, sign, other):
    x = data.draw(numbers(width))
    if name == "pow":
        y = data.draw(small_exponents | numbers(height, largest=16).map(lambda y: sign * y))
    else:
        x, y = other * x, sign * data.draw(numbers(height))
    check_two(name, x, y, precision)
    if name == "atan2" and y:
        check_two(name, y, x, precision)


@for_all(st.data(), precisions, precisions, st.integers(1, 40), st.sampled_from([-1, 1]))
def test_integer_power_is_tight(data, width, precision, n, sign):
    x = sign * data.draw(numbers(width))
    assert exact(tightest.integer_power(raw(x), n, precision)) == outward(x**n, x**n, precision)


EXACT_POWERS = """4^1/2=2 2^-3=1/8 9/4^3/2=27/8 1/4^-3/2=8 0^1/2=0 0^5=0 7^0=1 1^-5/2=1 5^3=125
18446744073709551616^1/64=2 3433683820292512484657849089281^1/64=3"""
NOT_DYADIC = "5^-1 3^-2 9^-1/2 9^1/4 9/8^1/2 1/2^1/2 2^3/2"


@pytest.mark.parametrize("text", EXACT_POWERS.split())
def test_exact_powers(text):
    x, y, value = map(Fraction, text.replace("=", "^").split("^"))
    for precision in (8, 53, 333):
        assert exact(tightest.power(raw(x), raw(y), precision)) == (value, value)


@pytest.mark.parametrize("text", NOT_DYADIC.split())
def test_powers_that_are_not_dyadic(text):
    for precision in (2, 53, 333):
        check_two("pow", *map(Fraction, text.split("^")), precision)


def test_powers_of_one_and_signs():
    for n in (1, 2, 3, 10**20, 10**20 + 1):
        assert exact(tightest.integer_power(raw(-1), n, 2)) == ((-1) ** n, (-1) ** n)
        assert exact(tightest.integer_power(raw(0), n, 2)) == (0, 0)
    down, up = exact(tightest.integer_power(raw(-3), 5, 4))
    assert (down, up) == (-256, -240)


def test_a_huge_integer_power():
    for x, n in ((Fraction(-12345677, 2**22), 10**6 + 1), (1 + Fraction(1, 2**500), 3 << 499)):
        down, up = exact(tightest.integer_power(raw(x), n, 53))
        assert up - down == oracle.ulp(down, 53) or up - down == oracle.ulp(up, 53)
        sign = (-1) ** (n % 2) if x < 0 else 1
        low, high = sorted((sign * down, sign * up))
        assert encloses(low, high, lambda t, n=n: (n * t.log()).exp(), abs(x), bits=1200)


# -- it ends, and soon -----------------------------------------------------------------------------

EXTREME = [
    *((1, -100_000), (3, -100_000), (5, -(10**9)), (3, 10_000), (5, 10**9), (1, 29), (1, 1000)),
    *((2**5000 + 1, -5000), (2**5000 - 1, -5000), (2**3000 + 1, -3003)),
]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_extreme_arguments_end(name):
    """The values are tested elsewhere; here the bounds are numbers that are neighbours."""
    for man, exp, precision in [(*x, p) for x in EXTREME for p in (2, 53, 333)]:
        if name == "tan" and exp == 10**9:
            continue  # takes pi to as many bits
        below_one = exp + man.bit_length() <= 0 or man == 1 == exp + 1
        if name in ("asin", "acos", "atanh") and not below_one:
            continue
        if name == "acosh" and below_one:
            continue
        try:
            down, up = FUNCTIONS[name](from_man_exp(man, exp), precision)
        except OverflowError:
            assert exp > 1000 or name in ("exp", "exp2", "exp10", "expm1", "sinh", "cosh")
            continue
        assert down == up or ziv.spacing(down, precision) <= max(down[2], up[2])


ODD = {"asin": 1, "tan": 1, "sinh": 1, "atanh": 1, "atan": -1, "tanh": -1, "asinh": -1}


@pytest.mark.parametrize("name", [*ODD, "expm1", "log1p"])
@pytest.mark.parametrize("exp", [-300, -100_000])
def test_tiny_arguments_are_rounded_away_from_themselves(name, exp):
    for man, sign in itertools.product((1, 3, 2**53 - 1), (-1, 1)):
        x = sign * man * Fraction(2) ** exp
        step = oracle.ulp(x, 53)
        grows = {"expm1": 1, "log1p": -1}.get(name, ODD.get(name, 0) * sign)
        if man == 1 and grows * sign < 0:
            step /= 2
        other = x + grows * step
        assert exact(FUNCTIONS[name](raw(x), 53)) == (min(x, other), max(x, other))


@pytest.mark.parametrize("k", [60, 700, 5000])
def test_next_to_one(k):
    """The values are those of series in d = 2^-k, of which three terms are enough."""
    d, p = Fraction(1, 2**k), 53

    def log1p(t):  # in balls, since 1 + t must not be rounded
        return t - t**2 / 2 + t**3 / 3 + flint.arb(0, 1) * t**4

    with flint.ctx.workprec(10 * k):
        root = flint.arb((2, -k)).sqrt()
        roots = oracle.ends(root * (1 - flint.arb((1, -k)) / 12 + flint.arb(0, 1) * root**4))
        other = oracle.ends(root * (1 + flint.arb((1, -k)) / 12 + flint.arb(0, 1) * root**4))
        log = oracle.ends(log1p(flint.arb((1, -k))))
        artanh = oracle.ends((flint.arb(2).log() * (k + 1) + log1p(-flint.arb((1, -k - 1)))) / 2)
    for name, x, (low, high) in (
        ("log", 1 + d, log),
        ("acosh", 1 + d, roots),
        ("acos", 1 - d, other),
        ("atanh", 1 - d, artanh),
    ):
        assert exact(FUNCTIONS[name](raw(x), p)) == outward(low, high, p)


@pytest.mark.parametrize("name", ["sin", "cos", "tan"])
@pytest.mark.parametrize("places", [60, 500, 2000])
def test_next_to_the_multiples_of_a_quarter_turn(name, places):
    low, _ = oracle.pi_bounds(places + 400)
    for n in (1, 2, 3, -7, 58, 2**61, 2**300 + 1):
        x = Fraction(round(n * low / 2 * 2**places), 2**places)
        for precision in (2, 53, 400):
            check(name, x, precision)
        _, _, quadrant = tightest.sincos(raw(x), 53)
        assert quadrant == quarter_turns(x)


def test_angles_of_extreme_points_end():
    tiny, huge = from_man_exp(3, -(10**9)), from_man_exp(5, 10**9)
    one, minus, three = raw(1), raw(-1), raw(3)
    with flint.ctx.workprec(100):
        pi = flint.arb.pi()
        half, whole = (outward(*oracle.ends(x), 53) for x in (pi / 2, pi))
    assert exact(tightest.atan2(one, tiny, 53)) == half
    assert exact(tightest.atan2(huge, minus, 53)) == half
    assert exact(tightest.atan2(tiny, minus, 53)) == whole
    assert exact(tightest.atan2(raw(0), minus, 53)) == whole
    assert exact(tightest.atan2(raw(0), huge, 53)) == (0, 0)
    down, up = tightest.atan2(tiny, three, 53)  # 2^-10^9 less a little
    assert up == from_man_exp(1, -(10**9)) and down == from_man_exp(2**53 - 1, -(10**9) - 53)
    scaled = [(sign, man, exp + 10**9, n) for sign, man, exp, n in tightest.atan2(tiny, raw(5), 53)]
    ratio = Fraction(3, 5)  # the angle is y / x but for 10^9 bits
    assert exact(scaled) == outward(ratio, ratio, 53)
    assert tightest.hypot(tiny, three, 53)[0] == three
    assert tightest.hypot(huge, raw(0), 53) == (huge, huge)


def test_huge_powers_are_refused():
    for x, y in ((3, 2**40), (2, 2**60), (1 + Fraction(1, 2**99), 2**140)):
        with pytest.raises(OverflowError):
            tightest.power(raw(x), raw(y), 53)
    for x, y in ((3, -(2**40)), (Fraction(5, 2**20), 2**100_000)):
        down, up = tightest.power(raw(x), raw(y), 53)
        assert down == raw(0) and up[2] + up[3] == 1 - 2**30


def test_powers_next_to_one_end():
    above, below, tiny = 1 + Fraction(1, 2**52), 1 - Fraction(1, 2**53), Fraction(1, 2**5000)
    for x, y in ((3, tiny**20), (1 + tiny, 3), (5, Fraction(3, 2**70))):
        assert exact(tightest.power(raw(x), raw(y), 53)) == (1, above)
        assert exact(tightest.power(raw(x), raw(-y), 53)) == (below, 1)


# -- roots -----------------------------------------------------------------------------------------


@for_all(st.data(), precisions)
def test_roots_of_powers_are_exact(data, precision):
    x = data.draw(numbers(precision))
    assert exact(FUNCTIONS["sqrt"](raw(x * x), precision)) == (x, x)
    assert exact(FUNCTIONS["cbrt"](raw(-(x**3)), precision)) == (-x, -x)
    assert exact(tightest.root(raw(-(x**5)), 5, precision)) == (-x, -x)
    assert exact(tightest.hypot(raw(3 * x), raw(-4 * x), precision + 3)) == (5 * x, 5 * x)


@for_all(st.integers(1, 2**64) | st.integers(1, 2**700), st.sampled_from([1, 2, 3, 5, 64]))
@example(7, 3)
@example(8, 3)
@example(63, 3)
@example(64, 3)
@example(10**300 - 1, 3)
@example(10**300, 3)
def test_the_integer_root(m, n):
    r = algebraic.integer_root(m, n)
    assert r**n <= m < (r + 1) ** n


# -- Ziv's strategy --------------------------------------------------------------------------------


@pytest.mark.parametrize("precision", [2, 3, 5])
def test_what_is_settled_is_how_the_numbers_within_are_rounded(precision):
    """Of [low, high] the points between the ends count: y is no number of `precision` bits."""
    scale = 3
    for low in range(-40, 41):
        for high in range(low + 1, low + 12, 2):
            ends = [Fraction(2 * low + 1, 16), Fraction(2 * high - 1, 16)]
            inner = [*ends, *(Fraction(n, 8) for n in range(low + 1, high))]
            expected = {outward(y, y, precision) for y in inner}
            found = ziv.settled(low, high, scale, precision)
            if found is None:
                size = max(abs(low), abs(high)).bit_length()
                assert len(expected) > 1 or low <= 0 <= high or size <= precision
            else:
                assert expected == {exact(found)}


@for_all(st.data(), precisions, precisions, st.sampled_from([-1, 1]), st.booleans(), tries=80)
def test_beside_a_number(data, width, precision, sign, upward):
    x = sign * data.draw(numbers(width))
    gap = Fraction(2) ** ziv.spacing(raw(x), precision)
    for part in (Fraction(1, 2**30), Fraction(1, 2), 1 - Fraction(1, 2**30)):
        y = x + gap * part * (1 if upward else -1)
        assert exact(ziv.beside(raw(x), upward, precision)) == outward(y, y, precision)


def test_more_bits_are_asked_until_it_is_settled():
    calls = []

    def third(bits):
        calls.append(bits)
        return (2**bits // 3 - 2**60, 2**bits // 3 + 2**60, bits)

    assert exact(ziv.tighten(third, 24)) == outward(Fraction(1, 3), Fraction(1, 3), 24)
    assert len(calls) > 2


ENCLOSED = sorted(set(EVERY) - {"sqrt", "cbrt", "sin", "cos", "exp", "log"})


def least_error(kernel, side):
    """The kernel with a value that is next to the true one, on one side, and the error 1."""

    def sharp(first, second, bits, *base):
        value, *n, _ = kernel(first, second, bits + 400, *base)
        return ((value >> 400) + side, *n, 1)

    return sharp


@pytest.fixture(params=[0, 1])
def enclosures(monkeypatch, request):
    """The enclosures that a function gives to `tighten`, at few bits, where each unit counts."""
    found = []
    for module in (circular, exponential, logarithm, power):
        for name in ("exp_fixed", "log_fixed", "angle_fixed"):
            if hasattr(module, name):
                kernel = least_error(getattr(module, name), request.param)
                monkeypatch.setattr(module, name, kernel)

    def record(enclose, precision, extra=0):
        found.extend(enclose(bits + extra) for bits in (8, 9, 10, 13, 40))
        return from_man_exp(1, 0), from_man_exp(1, 0)

    for module in (circular, exponential, logarithm, power):
        monkeypatch.setattr(module, "tighten", record)
    return found


def check_enclosures(enclosures, function, *arguments):
    for low, high, scale in enclosures:
        unit = Fraction(2) ** -scale
        assert encloses(low * unit, high * unit, function, *arguments, bits=300)
    enclosures.clear()


@pytest.mark.parametrize("name", ENCLOSED)
def test_enclosures_at_few_bits(name, enclosures):
    rng = random.Random(f"enclosures {name}")
    for _ in range(100):
        x = into_domain(name, any_number(rng) * rng.choice([1, 1, 2**8]))
        if in_domain(name, x):
            FUNCTIONS[name](raw(x), rng.choice([2, 53]))
            positive = name in ODD and name != "tan"  # odd by reflection
            check_enclosures(enclosures, oracle.FUNCTIONS[name], abs(x) if positive else x)


def test_enclosures_of_angles_and_powers_at_few_bits(enclosures):
    rng = random.Random(11)
    for _ in range(200):
        x, y = any_number(rng), any_number(rng)
        tightest.atan2(raw(abs(y)), raw(x), 53)
        check_enclosures(enclosures, oracle.FUNCTIONS["atan2"], abs(y), x)
        tightest.power(raw(abs(x)), raw(y), 53)
        check_enclosures(enclosures, oracle.FUNCTIONS["pow"], abs(x), y)


# -- where mpmath.iv excludes the true value -------------------------------------------------------


MISSED = [
    *(("exp", Fraction(-1, 2**53)), ("exp", Fraction(1, 2**22)), ("log1p", Fraction(1, 2**40))),
    *(("exp", Fraction(2**52 + 1, 2**74)), ("expm1", Fraction(1, 2**45))),
    ("log", 1 + Fraction(1, 2**35)),
    ("pow", Fraction(1, 2**4) + Fraction(1, 2**56), Fraction(-1, 2)),
]


@pytest.mark.parametrize(("name", "numbers"), [(name, numbers) for name, *numbers in MISSED])
def test_points_that_mpmath_iv_misses(name, numbers):
    ours = (FUNCTIONS | TWO)[name](*map(raw, numbers), 53)
    assert iv.prec == 53
    theirs = getattr(iv, name, pow)(*(iv.make_mpf((raw(x), raw(x))) for x in numbers))
    assert encloses(*exact(ours), oracle.FUNCTIONS[name], *numbers, bits=300)
    assert not encloses(*exact(theirs._mpi_), oracle.FUNCTIONS[name], *numbers, bits=300)
