"""The checker's Taylor series against Arb's, and over sets against the points in them."""

from fractions import Fraction
from random import Random

import pytest
from flint import arb, arb_series, ctx, fmpq

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.series import Series, polynomial

BITS, ORDER = 100, 12
TINY = Fraction(1, 2**80)


def coefficients(seed, first):
    random = Random(seed)
    return [Fraction(first), *(Fraction(random.randint(-99, 99), 100) for _ in range(4))]


def mine(values, spread=Fraction(0)):
    """The polynomials with these coefficients, the first one within a distance."""
    first = Enclosure.of(values[0] - spread, values[0] + spread, BITS)
    return Series.polynomial(first, *(rational(c, BITS) for c in values[1:]))


@pytest.fixture
def exact():
    """Arb at a much higher precision; returns the coefficients as rationals, nearly exact."""
    ctx.prec, ctx.cap = 400, ORDER + 1

    def series(values):
        return arb_series([arb(fmpq(c.numerator, c.denominator)) for c in values])

    yield series
    ctx.prec, ctx.cap = 53, 10


def value(x):
    mantissa, exponent = x.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


FUNCTIONS = {
    "sum": (lambda x, y: x + y - 3, None),
    "reflected": (lambda x, y: 2 - x + (-y), None),
    "product": (lambda x, y: x * y * 5, None),
    "quotient": (lambda x, y: x / y, None),
    "power": (lambda x, y: x**3 * y, lambda x, y: x * x * x * y),
    "sin": (lambda x, y: x.sincos()[0] + y, lambda x, y: x.sin() + y),
    "cos": (lambda x, y: x.sincos()[1] * y, lambda x, y: x.cos() * y),
    "exp": (lambda x, y: (x - y).exp(), lambda x, y: (x - y).exp()),
    "log": (lambda x, y: y.log() / x, lambda x, y: y.log() / x),
    "logarithm": (lambda x, y: y.log(), lambda x, y: y.log()),
    "derivative": (lambda x, y: (x * y).derivative(), lambda x, y: (x * y).derivative()),
    "composed": (
        lambda x, y: (x.sincos()[0] / y.exp()).sincos()[1],
        lambda x, y: (x.sin() / y.exp()).cos(),
    ),
}


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_contains_the_coefficients_of_arb(name, seed, exact):
    function, same = FUNCTIONS[name]
    x, y = coefficients(seed, "0.7"), coefficients(seed + 10, "1.9")
    found, true = function(mine(x), mine(y)), (same or function)(exact(x), exact(y))
    for k in range(ORDER):
        low, high = found[k].range
        assert low - TINY**3 <= value(true[k]) <= high + TINY**3
        assert high - low < TINY


@pytest.mark.parametrize("name", FUNCTIONS)
def test_over_a_set_contains_those_of_its_points(name, exact):
    function, same = FUNCTIONS[name]
    x, y, spread = coefficients(3, "0.7"), coefficients(4, "1.9"), Fraction("0.01")
    found = function(mine(x, spread), mine(y, spread))
    for shift in (-spread, spread / 3, spread):
        moved = ([c[0] + shift, *c[1:]] for c in (x, y))
        true = (same or function)(*map(exact, moved))
        for k in range(6):
            low, high = found[k].range
            assert low <= value(true[k]) <= high


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 17, 200])
def test_polynomials(count, exact):
    random = Random(count)
    outer = [Fraction(random.randint(-99, 99), 50) for _ in range(count)]
    x = coefficients(5, "0.3")
    found, true = polynomial(outer, mine(x)), exact([Fraction(0)])
    for c in reversed(outer):
        true = true * exact(x) + exact([c])
    for k in range(ORDER):
        low, high = found[k].range
        assert low - TINY**3 <= value(true[k]) <= high + TINY**3
        assert high - low < TINY


def test_terms_from_a_power_on():
    rest = mine([Fraction(k) for k in range(5)]).sincos()[0].over_power(3)
    whole = mine([Fraction(k) for k in range(5)]).sincos()[0]
    assert [rest[k].range for k in range(4)] == [whole[k + 3].range for k in range(4)]


def test_domains():
    with pytest.raises(Unproved):
        mine([Fraction("0.005"), Fraction(1)], Fraction("0.01")).log()
    with pytest.raises(Unproved):
        (mine([Fraction(1)]) / mine([Fraction(0), Fraction(1)], Fraction("0.01")))[0]
    with pytest.raises(ValueError, match="positive powers"):
        mine([Fraction(1)]) ** 0
