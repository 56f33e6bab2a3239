"""What users of mpmath, python-flint, numpy and JuliaIntervals look for."""

from decimal import Decimal
from fractions import Fraction

import flint
import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import strategies as st

import intervals
from intervals import Interval, IntervalArray, TightArray, convert
from intervals.errors import DomainError
from intervals.rounding import MAX
from intervals.systems import Roots
from tests.intervals.boxes import for_all
from tests.intervals.test_numpy import same


def test_sets_by_operators():
    x, y = Interval(0, 2), Interval(1, 3)
    assert x & y == Interval(1, 2) and x | y == Interval(0, 3) and x & Interval(5) is None
    assert 1 in x and "0.1" in x and Interval(1, 2) in x and 3 not in x and y not in x
    with pytest.raises(TypeError, match="float"):
        _ = 0.5 in x
    a, b = IntervalArray([(0, 2), (5, 6)]), IntervalArray([(1, 3), (6, 9)])
    assert same(a & b, IntervalArray([(1, 2), 6])) and same(a | b, IntervalArray([(0, 3), (5, 9)]))


def test_copies():
    x = Interval("0.1", precision=200)
    assert Interval(x) == x and Interval(x).precision == 200
    assert Interval(x, precision=20).contains(x) and Interval(x, precision=20).precision == 20
    assert Interval(0, x).sup == x.sup and Interval(Interval(1, 2), Interval(3)) == Interval(1, 3)
    a = IntervalArray([[1, (2, 3)]])
    assert same(IntervalArray(a), a) and same(a.copy(), a) and type(TightArray(a)) is TightArray


def test_decimals_are_taken_at_their_word():
    assert Interval(Decimal("0.1")) == Interval("0.1") == Interval(1) * Decimal("0.1")
    assert same(IntervalArray([Decimal("0.1")]), IntervalArray(["0.1"]))
    assert (IntervalArray([1]) + Decimal("0.1")).contains(Fraction(11, 10)).all()


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [
        ("3.56?1", "3.55", "3.57"),
        ("3.56?", "3.555", "3.565"),
        ("3.56?2u", "3.56", "3.58"),
        ("3.56?2d", "3.54", "3.56"),
        ("-10?3", "-13", "-7"),
        ("3.560?2e2", "355.8", "356.2"),
        (" +1.?1e-3 ", "0", "0.002"),
    ],
)
def test_uncertain_decimals(text, low, high):
    assert Interval(text, precision=90) == Interval(low, high, precision=90)
    assert same(IntervalArray([text]), IntervalArray([(low, high)]))


@pytest.mark.parametrize("text", ["3.56?1x", "?1", "3.56??", "3?1?2", "3?-1", "1?1e9999", "٣?1"])
def test_what_is_no_uncertain_decimal(text):
    with pytest.raises(ValueError):
        Interval(text)


def test_midpoint_and_radius():
    x = Interval.from_midpoint("3.56", "0.01")
    assert x == Interval("3.55", "3.57")
    with pytest.raises(ValueError, match="reversed"):
        Interval.from_midpoint(0, -1)


def test_conversions():
    third = Interval("1/3")
    assert convert.sympy(third).start == sympy.Rational(third.inf.numerator, third.inf.denominator)
    assert convert.interval(sympy.Rational(1, 3)) == third
    assert convert.interval(flint.arb(0.5)) == convert.interval(mpmath.mpf(0.5)) == Interval("1/2")
    for bad in (mpmath.iv.mpf(1), sympy.I, sympy.Symbol("x"), sympy.oo, sympy.Interval.open(0, 1)):
        with pytest.raises(TypeError):
            convert.interval(bad)
    assert convert.unproved_mpi(mpmath.iv.mpf([1, 2])) == Interval(1, 2)


SQRT_2 = sympy.sqrt(2)
OF_SYMPY = [
    *(sympy.pi, SQRT_2, sympy.E**2, -sympy.pi / (1 + SQRT_2), sympy.log(3) - sympy.atan(7)),
    *(sympy.Abs(sympy.sin(1) - 1), sympy.Max(sympy.pi, SQRT_2), sympy.Min(sympy.pi, SQRT_2)),
    *(sympy.atan2(-1, -SQRT_2), sympy.tanh(2) ** sympy.Rational(1, 3), sympy.acosh(3) ** -3),
]


@pytest.mark.parametrize("number", OF_SYMPY, ids=str)
def test_terms_of_sympy(number):
    for precision in (30, 53, 200):
        found = convert.interval(number, precision=precision)
        true = Fraction(str(number.evalf(90)))
        assert found.inf <= true <= found.sup
        assert 0 < found.wid <= abs(true) * Fraction(16, 2**precision)


def test_sets_of_sympy():
    assert convert.interval(sympy.Interval(1, 3)) == Interval(1, 3)
    assert convert.interval(sympy.Interval(0, SQRT_2)).contains("1.414")
    with pytest.raises(DomainError):  # the principal root is not real
        convert.interval(sympy.Pow(-8, sympy.Rational(1, 3), evaluate=False))


def test_solvers_from_the_top():
    (root,) = intervals.zeros(lambda x: x.cos() - x, Interval(0, 1))
    assert root.outcome is Roots.UNIQUE
    for box in ([Interval(0, 1)], Interval(0, 1)):
        assert intervals.krawczyk(lambda x: x.cos() - x, box).outcome is Roots.UNIQUE


A = IntervalArray([[1, 2, 0], [3, 4, 1], [1, 0, 5]])
V, W = IntervalArray([1, 2, 3]), IntervalArray([4, -5, 6])
NUMPYS = {  # what numpy does with ints, exactly
    "full_like": (lambda a, *_: np.full_like(a, 7)),
    "append": (lambda a, v, _: np.append(a, v)),
    "append rows": (lambda a, v, _: np.append(a, a, axis=0)),
    "pad": (lambda a, *_: np.pad(a, ((1, 0), (0, 2)))),
    "tensordot": (lambda a, *_: np.tensordot(a, a, axes=1)),
    "tensordot 2": (lambda a, *_: np.tensordot(a, a)),
    "tensordot axes": (lambda a, v, _: np.tensordot(a, a, axes=([0, 1], [1, 0]))),
    "tensordot 0": (lambda a, v, w: np.tensordot(v, w, axes=0)),
    "kron": (lambda a, *_: np.kron(a, a[:2])),
    "kron of vectors": (lambda a, v, w: np.kron(v, w)),
    "kron with a vector": (lambda a, v, w: np.kron(a, v)),
    "cross": (lambda a, v, w: np.cross(v, w)),
    "cross of rows": (lambda a, v, w: np.cross(a, w)),
    "flatten": (lambda a, *_: a.flatten()),
    "transpose": (lambda a, *_: a.transpose()),
    "transpose axes": (lambda a, *_: a.reshape((3, 3, 1)).transpose(2, 0, -2)),
    "reshape": (lambda a, *_: a.reshape((9,))),
    "transpose by a tuple": (lambda a, *_: a.reshape([3, 3, 1]).transpose((2, 0, 1))),
    "norm 1": (lambda a, *_: np.linalg.norm(a, 1)),
    "norm inf": (lambda a, *_: np.linalg.norm(a, np.inf)),
    "norm 1 of a vector": (lambda a, v, w: np.linalg.norm(w, 1)),
    "norm inf of rows": (lambda a, *_: np.linalg.norm(a, np.inf, axis=1)),
    "norm of rows, kept": (lambda a, *_: np.linalg.norm(a, 1, 1, keepdims=True)),
    "max": (lambda a, *_: a.max(axis=0)),
    "min": (lambda a, *_: a.min()),
    "dot": (lambda a, v, w: a.dot(v)),
}


@pytest.mark.parametrize("name", NUMPYS)
def test_names_of_numpy(name):
    numbers = [x.sup.astype(int) for x in (A, V, W)]
    expected, found = NUMPYS[name](*numbers), NUMPYS[name](A, V, W)
    assert isinstance(found, IntervalArray) and found.shape == np.shape(expected)
    assert (found.inf == expected).all() and (found.sup == expected).all()


def test_linear_algebra_of_numpy():
    assert A.dtype == np.float64 and A.mean().contains(Fraction(17, 9))
    inverse = np.linalg.inv(A)
    assert (A @ inverse).contains(IntervalArray(np.eye(3, dtype=int))).all()
    assert (A @ np.linalg.solve(A, V)).contains(V).all()
    assert len(np.linalg.eigvals(A)) == 3
    assert np.linalg.norm(V).item().contains(Interval(14, precision=100).sqrt())
    assert np.linalg.norm(A, axis=0).shape == (3,)
    for ord in (None, 2):
        assert np.linalg.norm(V, ord).item().contains(Interval(14, precision=100).sqrt())
    assert (np.linalg.norm(A, "fro") == np.linalg.norm(A)).all()
    for bad in ((A, 2), (A, -1), (V, 0), (V, "fro")):
        with pytest.raises(TypeError, match="order"):
            np.linalg.norm(*bad)


@for_all(st.integers(1, 5), st.integers(0, 2**32), st.sampled_from([0, 1, 2]))
def test_determinants_enclose(n, seed, rank_lost):
    rng = np.random.default_rng(seed)
    a = rng.integers(-9, 10, (n, n))
    a[:, n - min(rank_lost, n - 1) :] = a[:, :1]
    exact = sympy.Matrix(a.tolist()).det()
    found = np.linalg.det(IntervalArray(a))
    assert found.contains(int(exact)) and (rank_lost or found.wid <= 1e-9 * 9**n)
    wide = np.linalg.det(IntervalArray(a).widen("1/9"))
    assert wide.contains(int(exact)) and found.subset(wide.widen("1e-6"))
    inner = sympy.Matrix(a.tolist()) + sympy.Matrix(n, n, [sympy.Rational(1, 10)] * n * n)
    assert wide.contains(Fraction(str(inner.det())))


def test_what_an_array_is_not_asked():
    with pytest.raises(TypeError, match="many sets"):
        _ = 1 in V
    for ufunc, inputs in ((np.add, (V, V)), (np.sin, (V,))):
        with pytest.raises(TypeError, match="does not change"):
            ufunc(*inputs, out=np.zeros(3))
    assert intervals.rootn(Fraction(8), 3) == Interval(2)


infinite = st.sampled_from([-np.inf, -1.0, 0.0, 2.0, MAX, np.inf])


@for_all(infinite, infinite)
def test_infinite_bounds_are_taken(low, high):
    if low <= high and low < np.inf and high > -np.inf:
        x = IntervalArray.from_floats([low], [high])
        assert (x.inf, x.sup) == (low, high)
        assert (
            low <= x.mid <= high
            and np.isfinite(x.mid)
            and x.contains(IntervalArray.from_floats(x.mid))
        )
        assert same(eval(repr(x), {"IntervalArray": IntervalArray, "inf": np.inf}), x)
    else:
        with pytest.raises(ValueError):
            IntervalArray.from_floats([low], [high])
