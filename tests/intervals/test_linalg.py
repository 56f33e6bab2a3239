"""Linear systems and eigenvalues of interval matrices, against exact solutions by FLINT."""

import random
from fractions import Fraction

import flint
import numpy as np
import pytest

from intervals import Undecided, linalg
from intervals.array import IntervalArray
from intervals.linalg import SingularMatrix, _real, _square, eigenvalues, inverse, solve
from tests.intervals import oracle
from tests.once import examples


def rational(rows):
    return flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator) for x in row] for row in rows])


def exact_solution(a, b):
    x = rational(a).solve(rational(b))
    return [[Fraction(int(v.p), int(v.q)) for v in row] for row in x.tolist()]


def random_matrix(rng, rows, columns, radius):
    """An interval matrix around dyadic entries and the exact ends of its entries."""

    def entry():
        middle = Fraction(rng.randint(-(2**12), 2**12), 2**8)
        return middle - radius * rng.randint(0, 4), middle + radius * rng.randint(0, 4)

    ends = [[entry() for _ in range(columns)] for _ in range(rows)]
    return IntervalArray(ends), ends


def member(rng, ends):
    """A matrix inside, often with entries at the ends."""
    parts = [Fraction(0), Fraction(1), Fraction(1, 2), Fraction(rng.randrange(257), 256)]
    return [[low + (high - low) * rng.choice(parts) for low, high in row] for row in ends]


def contains(result, exact):
    flat = [x for row in exact for x in row]
    return all(y.contains(x) for y, x in zip(result.reshape(-1).tolist(), flat, strict=True))


# -- linear systems --------------------------------------------------------------------------------


@pytest.mark.slow
def test_solutions_contain_every_exact_one():
    rng, count, solved = random.Random("solve"), examples(240, 900), 0
    for _ in range(count):
        n, m = rng.randint(1, 6), rng.randint(1, 3)
        radius = rng.choice([Fraction(0), Fraction(1, 2**30), Fraction(1, 2**10), Fraction(1, 8)])
        (a, a_ends), (b, b_ends) = (random_matrix(rng, n, k, radius) for k in (n, m))
        try:
            x = solve(a, b)
        except SingularMatrix:
            continue
        solved += 1
        for _ in range(4):
            assert contains(x, exact_solution(member(rng, a_ends), member(rng, b_ends)))
    assert solved > count / 2


def test_a_thin_system_is_solved_sharply():
    rng = random.Random(3)
    a, ends = random_matrix(rng, 5, 5, Fraction(0))
    b = IntervalArray([1, 2, 3, 4, 5])
    x = solve(a, b)
    exact = exact_solution([[low for low, _ in row] for row in ends], [[k] for k in range(1, 6)])
    assert x.shape == (5,)
    assert contains(x, exact)
    size = max(abs(v) for row in exact for v in row)
    assert Fraction(float(x.wid.max())) < size / 2**40


def test_badly_scaled_systems_are_solved():
    """diag(2^-40, 1, 2^40) applied from both sides; an error in each entry of 1/64 of its size."""
    d = [Fraction(2) ** k for k in (-40, 0, 40)]
    core = [[4, 1, 1], [1, 5, 1], [1, 1, 6]]
    low, high = Fraction(63, 64), Fraction(65, 64)
    ends = [
        [(d[i] * core[i][j] * low / d[j], d[i] * core[i][j] * high / d[j]) for j in range(3)]
        for i in range(3)
    ]
    x = solve(IntervalArray(ends), IntervalArray([1, 1, 1]))
    rng = random.Random(8)
    for _ in range(20):
        assert contains(x, exact_solution(member(rng, ends), [[1]] * 3))


def test_inverse():
    rng = random.Random(4)
    a, ends = random_matrix(rng, 4, 4, Fraction(1, 2**12))
    unit = [[int(i == j) for j in range(4)] for i in range(4)]
    for _ in range(10):
        assert contains(inverse(a), exact_solution(member(rng, ends), unit))
    assert contains(inverse(IntervalArray([[4]])), [[Fraction(1, 4)]])


def test_matrices_that_include_a_singular_one_are_refused():
    rng = random.Random(5)
    for _ in range(40):
        n = rng.randint(2, 5)
        rows = [[Fraction(rng.randint(-8, 8)) for _ in range(n)] for _ in range(n - 1)]
        weights = [Fraction(rng.randint(-2, 2)) for _ in rows]
        columns = zip(*rows, strict=True)
        last = [sum(w * x for w, x in zip(weights, column, strict=True)) for column in columns]
        around = rng.choice([Fraction(0), Fraction(1, 2**40), Fraction(1, 2**4)])
        left = around * rng.randint(0, 4)
        ends = [[(x - left, x + around) for x in row] for row in [*rows, last]]
        with pytest.raises(SingularMatrix):
            solve(IntervalArray(ends), IntervalArray([1] * n))


def test_singular_at_the_edge_only():
    """[[1, t], [t, 1]], |t| <= r, is regular for r < 1; r = 1 includes a singular matrix."""

    def matrix(r):
        return IntervalArray([[1, (-r, r)], [(-r, r), 1]])

    x = solve(matrix(Fraction(99, 100)), IntervalArray([1, 1]))
    assert contains(x, [[Fraction(100)], [Fraction(100)]])
    with pytest.raises(SingularMatrix) as caught:
        solve(matrix(Fraction(1)), IntervalArray([1, 1]))
    assert isinstance(caught.value, Undecided)
    with pytest.raises(SingularMatrix):
        inverse(IntervalArray([[(-1, 1)]]))


def test_shapes_are_checked():
    for shape in ((2, 3), (4,), (0, 0)):
        a = IntervalArray.from_floats(np.ones(shape))
        for function in (eigenvalues, inverse):
            with pytest.raises(ValueError, match="square"):
                function(a)


# -- eigenvalues -----------------------------------------------------------------------------------


def roots(rows):
    """(re, im, multiplicity) of the eigenvalues, exact ends, from the characteristic polynomial."""
    polynomial = rational(rows).charpoly()
    result = []
    for root, multiplicity in polynomial.numer().complex_roots():
        z = flint.acb(root)
        result.append((oracle.ends(z.real), oracle.ends(z.imag), multiplicity))
    return result


def inside(ends, side):
    """Whether a ball is in an interval, up to the radius of the ball."""
    low, high = ends
    assert high - low < Fraction(1, 2**80)
    return side.inf <= high and low <= side.sup


def check_spectrum(found, rows):
    assert sum(value.multiplicity for value in found) == len(rows)
    with flint.ctx.workprec(400):
        exact = roots(rows)
    for value in found:
        held = [m for re, im, m in exact if inside(re, value.real) and inside(im, value.imag)]
        assert sum(held) == value.multiplicity
    for i, x in enumerate(found):
        for y in found[:i]:
            assert x.real.disjoint(y.real) or x.imag.disjoint(y.imag)


def integers(rows):
    return [[Fraction(x) for x in row] for row in rows]


@pytest.mark.slow
def test_eigenvalues_contain_every_exact_one():
    rng = random.Random("eigenvalues")
    for _ in range(examples(75, 325)):
        n = rng.randint(1, 6)
        radius = rng.choice([Fraction(0), Fraction(1, 2**30), Fraction(1, 2**8), Fraction(1)])
        a, ends = random_matrix(rng, n, n, radius)
        found = eigenvalues(a)
        for _ in range(3):
            check_spectrum(found, member(rng, ends))


def test_real_and_complex_eigenvalues_are_told_apart():
    real = eigenvalues(IntervalArray([[2, 1], [1, 3]]))
    assert [(x.imag.is_singleton(), x.multiplicity) for x in real] == [(True, 1)] * 2
    pair = eigenvalues(IntervalArray([[0, 1], [-1, 0]]))
    assert [x.multiplicity for x in pair] == [1, 1]
    assert pair[0].imag.certainly_negative() and pair[1].imag.certainly_positive()
    assert all(x.real.contains(0) and x.real.wid < Fraction(1, 2**40) for x in pair)
    near = eigenvalues(IntervalArray([[1, (Fraction(-1, 2**40), Fraction(1, 2**40))], [1, 1]]))
    assert [x.multiplicity for x in near] == [2]


def doubled(matrix):
    return IntervalArray.from_floats(_real(matrix + 0j))


def test_discs_hold_for_a_poor_inverse():
    """W V is far from the unit matrix: the discs must account for it."""
    rng = np.random.default_rng(21)
    for _ in range(40):
        a = rng.integers(-4, 5, (3, 3))
        v = np.eye(3) + rng.uniform(-0.4, 0.4, (3, 3))
        w = np.linalg.inv(v) + rng.uniform(-0.12, 0.12, (3, 3))
        square = _square(*map(doubled, (a, v, w)))
        if square is None:
            continue
        lower, upper = square
        with flint.ctx.workprec(300):
            exact = roots(integers(a.tolist()))
        for re, im, _ in exact:
            point = np.array([float(re[0]), float(im[0])])
            assert ((lower - 1e-12 <= point) & (point <= upper + 1e-12)).all(axis=1).any()


def test_similarity_error_is_not_left_out():
    """V = I, W = I + e N: W A V has other eigenvalues than A, and only e_i covers the gap."""
    a = np.diag([1.0, 3.0])
    w = np.diag([1.25, 0.75])
    lower, upper = _square(*map(doubled, (a, np.eye(2), w)))
    assert lower[0, 0] <= 1 <= upper[0, 0] and lower[1, 0] <= 3 <= upper[1, 0]
    assert _square(*map(doubled, (a, np.eye(2), 2 * np.eye(2)))) is None


def test_a_rectangle_on_the_axis_is_made_symmetric_before_it_counts_as_real(monkeypatch):
    """i and -i, in rectangles of which one reaches across the axis: neither is real."""
    squares = np.array([[-0.1, -0.5], [-0.1, -1.1]]), np.array([[0.1, 1.1], [0.1, -0.6]])
    monkeypatch.setattr(linalg, "_squares", lambda a: [squares])
    (pair,) = eigenvalues(IntervalArray([[0, 1], [-1, 0]]))
    assert pair.multiplicity == 2 and pair.imag.contains(1) and pair.imag.contains(-1)


def test_extreme_sizes():
    for scale in (Fraction(2) ** -900, Fraction(2) ** 900):
        rows = [[2 * scale, scale], [scale, 3 * scale]]
        found = eigenvalues(IntervalArray(rows))
        assert sum(x.multiplicity for x in found) == 2
        low, high = (
            scale * (5 + f(Fraction(5), 60)) / 2 for f in (oracle.sqrt_down, oracle.sqrt_up)
        )
        assert any(x.real.inf <= low and high <= x.real.sup for x in found)
        x = solve(IntervalArray(rows), IntervalArray([1, 2]))
        assert contains(x, exact_solution(rows, [[1], [2]]))
    with pytest.raises(OverflowError):
        eigenvalues(IntervalArray([[10**308, 10**308], [10**308, 10**308]]))


@pytest.mark.parametrize("shape", [(4,), (6,), (1,), (), (2, 3), (3, 1, 1), (0,), (3, 0)])
def test_right_sides_of_other_shapes_are_refused(shape):
    side = IntervalArray.from_floats(np.ones(shape))
    with pytest.raises(ValueError, match="right side"):
        solve(IntervalArray.from_floats(np.eye(3)), side)
