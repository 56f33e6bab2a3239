"""What transfer operators are bounded with: complex boxes, ellipses, series; against mpmath."""

import random
from fractions import Fraction

import pytest
from mpmath import chebyt, mp, mpc, mpf

from proofs.trusted.kernel import arithmetic
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational, sincos_near_zero
from proofs.trusted.kernel.complexes import BITS, Complex, Ellipse
from proofs.trusted.kernel.elementary import log_of
from proofs.trusted.kernel.transfer import Growth, Series
from tests.proofs.trusted.paper.reference import as_mpf

TINY = mpf(2) ** -40
HULL = (Fraction("0.4"), Fraction("0.9"))


@pytest.fixture(autouse=True)
def _precise():
    with mp.workprec(1200):
        yield


def box(chance, width):
    """A box of complex numbers with a point of it."""
    parts, point = [], []
    for _ in range(2):
        low = Fraction(chance.randint(-3000, 3000), 1000)
        high = low + Fraction(chance.randint(0, 1000), 1000) * width
        parts.append(Enclosure.of(low, high, BITS))
        point.append(as_mpf(low + (high - low) * Fraction(chance.randint(0, 4), 4)))
    return Complex(*parts), mpc(*point)


def holds(z, value):
    parts = zip(z.ranges, (value.real, value.imag), strict=True)
    return all(as_mpf(low) <= part <= as_mpf(high) for (low, high), part in parts)


SEVENTH = Fraction(-9, 7)
REAL = Complex.of(SEVENTH)
OPERATIONS = {
    "+": (lambda a, b: a + b, lambda a, b: a + b),
    "-": (lambda a, b: a - b, lambda a, b: a - b),
    "*": (lambda a, b: a * b, lambda a, b: a * b),
    "/": (lambda a, b: a / (b + 9), lambda a, b: a / (b + 9)),
    "times a real": (lambda a, b: a * REAL * b, lambda a, b: a * as_mpf(SEVENTH) * b),
    "a real times": (lambda a, b: REAL * (a + b), lambda a, b: as_mpf(SEVENTH) * (a + b)),
    "/ a real": (lambda a, b: (a - b) / REAL, lambda a, b: (a - b) / as_mpf(SEVENTH)),
    "1/": (lambda a, b: 1 / (a + 9), lambda a, b: 1 / (a + 9)),
    "of numbers": (lambda a, b: Fraction(2, 7) - a * 3, lambda a, b: mpf(2) / 7 - a * 3),
    "power": (lambda a, b: a**3, lambda a, b: a**3),
    "sin": (lambda a, b: a.sincos()[0], lambda a, b: mp.sin(a)),
    "cos": (lambda a, b: a.sincos()[1], lambda a, b: mp.cos(a)),
}


@pytest.mark.parametrize("name", OPERATIONS)
@pytest.mark.parametrize("width", [0, Fraction(1, 100), Fraction(1, 2)])
def test_complex_enclosures_contain(name, width):
    chance, (ours, theirs) = random.Random(name), OPERATIONS[name]
    for _ in range(40):
        (a, x), (b, y) = box(chance, width), box(chance, width)
        found = ours(a, b)
        assert holds(found, theirs(x, y))
        if not width:  # and no more than rounding
            assert found.spread < Fraction(1, 2**40)


def test_sizes_and_spreads_are_bounds():
    chance = random.Random(3)
    for _ in range(50):
        z, value = box(chance, 1)
        assert abs(value) <= as_mpf(z.size)
        corner = mpc(*(as_mpf(low) for low, _ in z.ranges))
        assert abs(value - corner) <= as_mpf(z.spread)
        wider = z.widened(Fraction(1, 3))
        assert holds(wider, value + mp.expjpi(chance.random() * 2) / 3)


def test_division_by_what_may_be_zero():
    square = Complex.of(Fraction(0)).widened(Fraction(1))
    with pytest.raises(Unproved):
        _ = 1 / square


@pytest.mark.parametrize("rho", [Fraction(3, 2), Fraction(7), Fraction(40)])
def test_polynomials_on_arcs(rho):
    """Value and derivative by the angle, at the middle and anywhere on the arc."""
    chance, ellipse, one = random.Random(5), Ellipse(HULL, rho), mpf(1)
    coefficients = [Fraction(chance.randint(-99, 99), 100) / rho**k for k in range(7)]

    def at(angle):
        w = as_mpf(rho) * mp.expj(angle)
        powers = [(w**k, w**-k) for k in range(7)]
        value = sum(as_mpf(c) * (p + q) / 2 for c, (p, q) in zip(coefficients, powers, strict=True))
        rates = zip(range(7), coefficients, powers, strict=True)
        return value, sum(1j * k * as_mpf(c) * (p - q) / 2 for k, c, (p, q) in rates) * one

    for count in (5, 64):
        for arc in ellipse.arcs(count)[::3]:
            germ, unit = arc.germ(coefficients), mp.pi / count
            middle = at(unit * (arc.j + mpf(1) / 2))
            assert holds(germ.value, middle[0]) and holds(germ.rate, middle[1])
            for share in (0, mpf(1) / 3, 1):
                value, rate = at(unit * (arc.j + share))
                assert holds(germ.values.widened(Fraction(1, 2**50)), value)
                assert holds(germ.rates.widened(Fraction(1, 2**50)), rate)
                assert not holds(germ.value, value) or count * share == 0 or rho < 2
    centre, half = ellipse.coordinates
    assert (centre - half, centre + half) == HULL


@pytest.mark.parametrize("rho", [Fraction(3, 2), Fraction(7)])
def test_what_an_ellipse_contains(rho):
    ellipse = Ellipse(HULL, rho)
    centre, half = map(as_mpf, ellipse.coordinates)
    for k in range(24):
        w = as_mpf(rho) * mp.expjpi(mpf(k) / 12)
        for scale, inside in ((mpf("0.999"), True), (mpf("1.001"), False)):
            z = centre + half * (w + 1 / w) / 2 * scale
            found = Complex(*(rational(Fraction(mp.nstr(x, 30)), BITS) for x in (z.real, z.imag)))
            assert ellipse.contains(found) is inside


@pytest.mark.parametrize(
    ("hull", "rho"), [(HULL, 1), (HULL, 101), (HULL, -2), ((Fraction(1), Fraction(1)), 2)]
)
def test_no_ellipse(hull, rho):
    with pytest.raises(Unproved):
        Ellipse(hull, Fraction(rho))


@pytest.mark.parametrize("decay", [1, 7])
@pytest.mark.parametrize("bits", [64, 300])
def test_series_of_chebyshev_s_polynomials(bits, decay):
    chance = random.Random(bits)
    for terms in (1, 2, 9, 60):
        coefficients = [
            Fraction(chance.randint(-(10**9), 10**9), 10**9 * decay**k) for k in range(terms)
        ]
        h = Series.of(coefficients, bits)
        for width in (0, 5):
            lo = chance.randint(-(1 << bits), (1 << bits) - width)
            for u in (lo, -(1 << bits), (1 << bits) - width):
                found = h(Enclosure(u, u + width, bits))
                for x in (u, u + width):
                    terms_of = zip(h.coefficients, range(terms), strict=True)
                    value = sum(c * chebyt(k, mpf(x) / (1 << bits)) for c, k in terms_of)
                    assert found.lo <= value <= found.hi
                assert found.hi - found.lo < 4 * terms + 4 + 3 * width * terms**3
        size = sum(abs(mpf(c)) * 3**k for k, c in enumerate(h.coefficients)) / (1 << bits)
        assert size <= as_mpf(h.size(Fraction(3))) < size * (1 + TINY) + TINY * decay
    for outside in ((1 << bits) - 1, -(1 << bits) - 1):
        with pytest.raises(Unproved):
            h(Enclosure(outside, outside + 2, bits))


@pytest.mark.parametrize("bits", [64, 1000])
def test_logarithms_of_enclosures(bits):
    for text in ("1", "0.001", "3.7", "500", "0.9999999"):
        value = Fraction(text)
        thin, wide = rational(value, bits), Enclosure.of(value, value * Fraction(101, 100), bits)
        for found, least in ((log_of(thin), 30), (log_of(wide), None)):
            (low, high), true = map(as_mpf, found.range), mp.log(as_mpf(value))
            assert low <= true + mpf(2) ** (20 - bits) and true <= high
            assert least is None or high - low < mpf(2) ** (least - bits)
        assert mp.log(as_mpf(value) * mpf(101) / 100) <= as_mpf(log_of(wide).range[1]) + mpf(2) ** (
            20 - bits
        )
    for low, high in ((-1, 1), (0, 1), (1, 1 << 70)):
        with pytest.raises((Unproved, OverflowError)):
            log_of(Enclosure(low << bits, high << bits, bits))


@pytest.mark.parametrize("end", [1, 1 << 1900, 1 << 3500])
def test_numbers_beyond_floating_point_have_no_logarithm(end):
    with pytest.raises(Unproved, match="leaves"):
        log_of(Enclosure(end, end, 2000))


@pytest.mark.parametrize("bits", [64, 511, 512, 1000])
def test_sines_of_many_bits_and_of_narrow_enclosures(bits):
    chance = random.Random(bits)
    for _ in range(20):
        x = chance.choice((chance.getrandbits(bits + 6), -chance.getrandbits(bits // 2 + 9)))
        near_zero = chance.randint(-1, 1) * chance.getrandbits(3 * bits // 4)
        x = chance.choice((x, near_zero, int(mp.pi / 2 * chance.randint(-9, 9) * 2**bits)))
        for width in (0, 3, arithmetic._NARROW):
            angles = Enclosure(x, x + width, bits)
            (sin, cos), (odd, even) = angles.sincos(), sincos_near_zero(angles)
            for angle in (x, x + width):
                for found, true in ((sin, mp.sin), (cos, mp.cos), (odd, mp.sin), (even, mp.cos)):
                    assert found.lo <= true(mpf(angle) / 2**bits) * 2**bits <= found.hi
                    assert found.hi - found.lo <= 4 + 2 * width


def test_the_dimension_of_a_growth():
    """Two maps with slopes 1/3: L_s 1 = 2 3^-s; the dimension is log 2 / log 3."""
    third, true = Fraction(1, 3), mp.log(2) / mp.log(3)
    for s in map(Fraction, ("1", "1/2", "0.6309297535714574")):
        grown = Fraction(mp.nstr(2 * mp.mpf(3) ** -as_mpf(s), 40))
        spare = Fraction(1, 10**12)
        found = Growth(s, (grown - spare, grown + spare), ((third, third),) * 2)
        low, high = found.dimension(100)
        assert as_mpf(low) <= true <= as_mpf(high)
    assert as_mpf(high) <= 1 + TINY and as_mpf(low) > true - mpf(10) ** -9
    for change in ({"rates": ((third, Fraction(1)),)}, {"bounds": (Fraction(0), Fraction(1))}):
        given = {"s": s, "bounds": (third, third), "rates": ((third, third),)} | change
        with pytest.raises(Unproved):
            Growth(**given).dimension(100)
