"""Complex boxes against Arb's acb, exact rationals, dense samples and closed identities."""

import cmath
import copy
import pickle
from fractions import Fraction
from itertools import product

import flint
import mpmath
import pytest
from hypothesis import strategies as st

import intervals
from intervals import ComplexInterval, DomainError, Interval, Jet, convert
from tests.intervals import oracle
from tests.intervals.boxes import for_all, precisions

NAMES = {"ComplexInterval": ComplexInterval, "Interval": Interval, "Fraction": Fraction}
FUNCTIONS = ("exp", "log", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh")
CUT = ("log", "sqrt")
POLES = ("tan", "tanh")
sides = st.tuples(*[st.integers(-40, 40).map(lambda k: Fraction(k, 16))] * 2).map(sorted)
parts = st.integers(0, 16).map(lambda k: Fraction(k, 16))


def box(real, imag, precision=53):
    return ComplexInterval(*(Interval(*ends, precision=precision) for ends in (real, imag)))


def point(ends, t):
    return ends[0] + (ends[1] - ends[0]) * t


def holds(z, value):
    """Whether the box can have the number in a ball of Arb, far smaller than the last bit."""
    ends = zip((z.real, z.imag), map(oracle.ends, (value.real, value.imag)), strict=True)
    return all(x.inf <= high and low <= x.sup for x, (low, high) in ends)


def acb(x, y):
    return flint.acb(oracle.arb(x), oracle.arb(y))


@pytest.mark.parametrize("name", FUNCTIONS)
@for_all(sides, sides, parts, parts, precisions, tries=40)
def test_functions_contain_the_values_inside(name, real, imag, s, t, precision):
    x, y = point(real, s), point(imag, t)
    try:
        found = getattr(intervals, name)(box(real, imag, precision))
    except DomainError:
        assert name in CUT + POLES
        return
    with flint.ctx.workprec(1500):
        value = getattr(acb(x, y), name)()
    assert holds(found, value)


@pytest.mark.parametrize("name", [*(n for n in FUNCTIONS if n not in POLES), "recip"])
@for_all(sides, sides, precisions, tries=30)
def test_points_have_the_tightest_values_but_for_a_bit(name, real, imag, precision):
    x, y = real[0], imag[0]
    size = x * x + y * y
    if not size or (name == "log" and abs(size - 1) < Fraction(1, 2)) or precision < 12:
        return
    found = getattr(box((x, x), (y, y), precision), name)()
    with flint.ctx.workprec(1500):
        z = acb(x, y)
        value = 1 / z if name == "recip" else getattr(z, name)()
    for side, ball in ((found.real, value.real), (found.imag, value.imag)):
        low, high = oracle.ends(ball)
        if low <= 0 <= high:
            assert side.mag <= Fraction(1, 2**1000)
            continue
        below, above = oracle.round_down(low, precision), oracle.round_up(high, precision)
        assert below - oracle.ulp(low, precision) <= side.inf <= low
        assert high <= side.sup <= above + oracle.ulp(high, precision)


OPERATIONS = {
    "+": lambda z, w: z + w,
    "-": lambda z, w: z - w,
    "*": lambda z, w: z * w,
    "/": lambda z, w: z / w,
    "1/": lambda z, w: 1 / z + w - w,
    "sqr": lambda z, w: z * z if isinstance(z, flint.acb) else z.sqr(),
    "**5": lambda z, w: z**5,
    "**-3": lambda z, w: z**-3,
}


@pytest.mark.parametrize("name", OPERATIONS)
@for_all(sides, sides, sides, sides, parts, parts, parts, precisions, tries=40)
def test_arithmetic_contains_the_values_inside(name, a, b, c, d, s, t, r, precision):
    try:
        found = OPERATIONS[name](box(a, b, precision), box(c, d))
    except DomainError:
        assert "/" in name or "-3" in name
        return
    with flint.ctx.workprec(1500):
        value = OPERATIONS[name](acb(point(a, s), point(b, t)), acb(point(c, r), point(d, s)))
    assert holds(found, value)


@for_all(sides, sides, sides, sides, precisions, tries=60)
def test_sums_and_products_are_the_tightest(a, b, c, d, precision):
    """Bilinear in four numbers of four intervals: the extremes are at corners."""
    z, w = box(a, b, precision), box(c, d, precision)
    corners = [
        (x * u - y * v, x * v + y * u)
        for x, y, u, v in product(*((side.inf, side.sup) for side in _sides(z, w)))
    ]
    for found, values in zip(_sides(z * w), zip(*corners, strict=True), strict=True):
        ends = oracle.outward(min(values), max(values), precision)
        assert (found.inf, found.sup) == ends
    assert (z + w).real == z.real + w.real and (z - w).imag == z.imag - w.imag
    square, (x, y) = z.sqr(), _sides(z)
    low, high = (
        oracle.outward(e, e, precision) for e in (x.mig**2 - y.mag**2, x.mag**2 - y.mig**2)
    )
    assert (square.real.inf, square.real.sup) == (low[0], high[1])
    assert square.subset(z * z)


def _sides(*boxes):
    return [side for z in boxes for side in (z.real, z.imag)]


HULLS = [*(name for name in FUNCTIONS if name not in POLES), "recip"]


@pytest.mark.parametrize("name", HULLS)
@for_all(sides, sides, tries=12)
def test_hulls_are_not_wider_than_the_values_on_the_edges(name, real, imag):
    """The extremes of analytic functions are on the boundary; the samples are near enough."""
    z = box(real, imag)
    try:
        found = getattr(z, name)()
    except DomainError:
        return
    if name in ("log", "recip") and abs(z).inf < Fraction(1, 4):
        return  # it changes too fast for the samples
    function = (lambda x: 1 / x) if name == "recip" else getattr(cmath, name)
    xs, ys = (
        [float(low + (high - low) * Fraction(k, 100)) for k in range(101)]
        + [float(min(max(0, low), high))]
        for low, high in (real, imag)
    )
    edges = [complex(x, y) for x in xs for y in map(float, imag)]
    edges += [complex(x, y) for x in map(float, real) for y in ys]
    values = [function(edge) for edge in edges]
    for side, samples in (
        (found.real, [v.real for v in values]),
        (found.imag, [v.imag for v in values]),
    ):
        slack = 1e-2 * (max(map(abs, samples)) + 1)
        assert min(samples) - slack <= side.inf <= min(samples) + 1e-9
        assert max(samples) - 1e-9 <= side.sup <= max(samples) + slack


BESIDE = [((-2, -1), (0, 1)), ((-2, -1), (0, 0)), ((-2, 1), (1, 2)), ((-2, 1), (-2, -1))]
ACROSS = [((-2, -1), (-1, 1)), ((-2, -1), (-1, 0)), ((-2, 1), (-1, 1)), ((-2, 0), (-1, 0))]
AT_ZERO = [((0, 1), (-1, 1)), ((0, 0), (0, 0)), ((0, 1), (0, 1)), ((-1, 1), (0, 1))]


def test_the_cut_belongs_to_its_upper_side():
    for sides in BESIDE:
        z = box(*sides)
        assert z.arg().inf >= -Interval.pi().sup and z.log().imag == z.arg()
        assert z.sqrt().real.inf >= 0
    for sides, names in [(s, ("arg", *CUT)) for s in ACROSS] + [
        (s, ("arg", "log")) for s in AT_ZERO
    ]:
        for name in names:
            with pytest.raises(DomainError, match=r"cut|origin|leaves"):
                getattr(box(*sides), name)()
    assert all(box(*sides).sqrt().contains(0) for sides in AT_ZERO)
    assert ComplexInterval(-1).arg() == Interval.pi()
    assert ComplexInterval(-4).sqrt() == ComplexInterval(0, 2)
    assert box((-4, -1), (0, 0)).sqrt() == box((0, 0), (1, 2))
    assert box((1, 4), (0, 0)).sqrt() == box((1, 2), (0, 0))


def test_poles():
    around = Interval("1.5", "1.7"), Interval("-0.1", "0.1")
    for z, name in ((ComplexInterval(*around), "tan"), (ComplexInterval(*around[::-1]), "tanh")):
        with pytest.raises(DomainError):
            getattr(z, name)()
    assert abs(ComplexInterval(around[0], 1).tan()).sup < 2


def test_numbers_in_and_the_precision_of_results():
    z = ComplexInterval("1.5", "0.2", precision=100)
    assert z.imag == Interval("1/5", precision=100) and z.precision == 100
    assert (z * ComplexInterval(1)).precision == (1 - z).sqrt().precision == 100
    assert ComplexInterval(Interval(1, 2), "0.2").real == Interval(1, 2)
    assert ComplexInterval(Interval(1, precision=99), 2).imag.precision == 99
    tenth = ComplexInterval.from_complex(0.1 - 0.1j)
    assert (tenth.real.inf, tenth.imag.sup) == (Fraction(0.1), Fraction(-0.1)) and tenth.wid == 0
    for x in (Interval(1, 2), Fraction(3, 2), 2):
        same = ComplexInterval(x)
        assert (x + z, x - z, x * z, x / z) == (same + z, same - z, same * z, same / z)
        assert (z + x, z - x, z * x, z / x) == (z + same, z - same, z * same, z / same)
    for wrong in (0.5, 1j, "1", None):
        with pytest.raises(TypeError):
            z + wrong
        with pytest.raises(TypeError):
            z.contains(wrong)
    for wrong in (0.5, 1j):
        with pytest.raises(TypeError):
            ComplexInterval(wrong)
        with pytest.raises(TypeError):
            assert z == wrong
    with pytest.raises(ValueError, match="finite"):
        ComplexInterval.from_complex(complex("nan"))
    with pytest.raises(TypeError, match="truth"):
        bool(z)


def test_sets():
    z, w = box((0, 2), (0, 3)), box((1, 3), (-1, 1))
    assert z.intersection(w) == box((1, 2), (0, 1)) and z.hull(w) == box((0, 3), (-1, 3))
    assert z.intersection(box((5, 6), (0, 1))) is None and z.disjoint(box((0, 1), (4, 5)))
    assert not z.disjoint(w) and not z.contains(w) and z.contains(1) and not z.contains(-1)
    inner = box((1, 1), (1, 2))
    assert inner.interior(z) and inner.subset(z) and z.subset(z) and not z.interior(z)
    assert not box((0, 1), (1, 2)).interior(z) and not inner.hull(5).subset(z)
    for number in (Fraction(1, 3), 2**70 + 1):  # which no box of 53 bits is
        around = ComplexInterval(number)
        assert around.contains(number) and not around.subset(number)
        assert ComplexInterval(around.real.inf).disjoint(number)
    assert ComplexInterval(3).subset(3) and not ComplexInterval(3, 1).subset(3)
    assert z.mid == (1, Fraction(3, 2)) and z.wid == 3 and abs(z).inf == 0
    assert abs(box((3, 3), (-4, 4))) == Interval(3, 5)
    assert z.conjugate() == box((0, 2), (-3, 0)) and len({z, box((0, 2), (0, 3)), w}) == 2


@for_all(sides, sides, precisions, st.integers(1, 30))
def test_text_pickle_and_copies(real, imag, precision, digits):
    z = box(real, imag, precision) / 3
    for same in (eval(repr(z), NAMES), pickle.loads(pickle.dumps(z)), copy.deepcopy(z)):
        assert same == z and same.precision == z.precision
    for text in (str(z), f"{z:{digits}}", f"{z:.{digits}f}"):
        assert ComplexInterval(text, precision=precision + 300).contains(z)
    assert str(ComplexInterval("0.5", -2, precision=10)) == "[0.500, 0.500] + [-2.00, -2.00]j"


@for_all(sides, sides, tries=20)
def test_numbers_of_other_libraries(real, imag):
    z = box(real, imag)
    ball = convert.acb(z)
    assert convert.complex_interval(ball).contains(z)
    iv = mpmath.iv.mpc(*map(convert.mpi, _sides(z)))
    parts = (convert.unproved_mpi(part) for part in (iv.real, iv.imag))
    assert ComplexInterval(*parts) == z
    number = convert.complex_interval(mpmath.mpc(float(real[0]), float(imag[0])))
    assert z.contains(number) and number.wid == 0
    for wrong in (1j, 1, z, "1", mpmath.mpf(1), flint.arb(1)):
        with pytest.raises(TypeError, match="not an mpc"):
            convert.complex_interval(wrong)
    with pytest.raises(ValueError, match="bounded"):
        convert.complex_interval(mpmath.mpc("inf"))


def test_jets_have_derivatives_of_analytic_functions():
    z = Jet.variable(ComplexInterval("0.3", "0.4", precision=200), 3)
    found = (z.sin() * z.exp() / (1 + z.sqr())).derivative(3)
    with mpmath.workdps(60):
        f = lambda t: mpmath.sin(t) * mpmath.exp(t) / (1 + t * t)  # noqa: E731
        value = mpmath.diff(f, mpmath.mpc("0.3", "0.4"), 3)
        near = convert.complex_interval(value, precision=300)
    assert found.wid < Fraction(1, 2**180)
    assert abs(found - near).sup < Fraction(1, 10**15)
