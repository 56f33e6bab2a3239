"""Normal forms of bifurcations against published coefficients, and against Kuznetsov's formulas.

Published: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, chapter 4: Ricker's map flips
at alpha = e^2, x = 2 with c(0) = 1/6 (example 4.1); the delayed logistic map has a Neimark-Sacker
bifurcation at r = 2, x = 1/2 with theta = 60 degrees and a(0) = -2 (example 4.2); the Henon map has
its fold at a = -(1 - b)^2/4 and its flip at a = 3 (1 - b)^2/4 in Henon's own coordinates
(exercises; M. Henon, Commun. Math. Phys. 50, 1976). The logistic map flips at r = 3, with
c = (f''/2)^2 = 9. J. Guckenheimer and P. Holmes, Nonlinear Oscillations, section 2.4: the bouncing
ball (phi + v, alpha v - gamma cos(phi + v)) has its saddle-nodes at gamma = 2 n pi (1 - alpha) and
its flips at gamma = 2 sqrt(n^2 pi^2 (1 - alpha)^2 + (1 + alpha)^2).
"""

from fractions import Fraction
from itertools import product

import pytest
import sympy
from mpmath import mp, mpc, mpf

from intervals import Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.certify import enclosure
from proofs.methods.bifurcation.classify import meaning
from proofs.methods.bifurcation.closed import closed
from proofs.methods.bifurcation.maps import Map
from proofs.methods.bifurcation.normal_forms import NormalForm
from proofs.methods.grammar import canonical
from proofs.methods.lemmas import Lemmas
from proofs.trusted.files import render
from proofs.trusted.verify import check

LOGISTIC = ("x1 = r*x*(1 - x)",)
RICKER = ("x1 = a*x*exp(-x)",)
HENON = ("x1 = 1 - a*x^2 + y", "y1 = b*x")
DELAYED = ("x1 = r*x*(1 - y)", "y1 = x")
BALL = ("phi1 = phi + v - 2*pi*n", "v1 = alpha*v - g*cos(phi1)")


def candidates(kind, names, *lines):
    """What is found, classified, after the checker has accepted its proof."""
    file = Lemmas()
    found = closed(file, NormalForm(Map.read(*lines), kind), names)
    if file.steps:
        check(render(file.document()))
    return found


def in_closed_form(kind, names, *lines):
    """The numbers of what is no candidate alone."""
    return [each.values for each in candidates(kind, names, *lines) if each.kept]


def enclosed(kind, parameter, near, *lines, digits=15, **numbers):
    """An enclosure, after the checker has accepted its proof."""
    file, of = Lemmas(), Map.read(*lines).with_numbers(**numbers)
    near = {name: Fraction(value) for name, value in near.items()}
    found = enclosure(file, NormalForm(of, kind), parameter, near, digits)
    check(render(file.document()))
    return found


def same(expression, text):
    return derive.simplest(expression - derive.read(canonical(text))) == 0


@pytest.mark.slow
def test_a_point_that_is_not_real_is_no_bifurcation():
    """x1 = r + 1/x has the multiplier -1/x^2: 1 at x = i and -i, -1 at x = 1 and -1."""
    line = "x1 = r + 1/x"
    with pytest.raises(Undecided, match="no closed form"):
        in_closed_form("fold", ("x", "r"), line)
    found = candidates("flip", ("x", "r"), line)  # r = 0: then every x has the period 2
    assert {(str(each.values["x"]), each.what.kind) for each in found} == {
        ("1", "degenerate"),
        ("-1", "degenerate"),
    }


# -- published -------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "names", "lines", "wanted"),
    [
        ("flip", ("x", "r"), LOGISTIC, {"x": "2/3", "r": "3", "critical": "9", "speed": "-1"}),
        ("flip", ("x", "a"), RICKER, {"x": "2", "a": "exp(2)", "critical": "1/6"}),
        ("fold", ("x", "y", "a"), HENON, {"a": "-(1 - b)^2/4", "x": "2/(1 - b)"}),
        ("flip", ("x", "y", "a"), HENON, {"a": "3*(1 - b)^2/4", "x": "2/(3*(1 - b))"}),
        (
            "neimark_sacker",
            ("x", "y", "r"),
            DELAYED,
            {"r": "2", "x": "1/2", "y": "1/2", "trace": "1", "critical": "-2"},
        ),
    ],
)
def test_published_coefficients(kind, names, lines, wanted):
    found = in_closed_form(kind, names, *lines)[-1]
    for name, text in wanted.items():
        assert same(found[name], text), (name, found[name])


@pytest.mark.slow
def test_the_bouncing_ball():
    folds = in_closed_form("fold", ("v", "g", "phi"), *BALL)
    assert {str(each["g"]) for each in folds} == {"-2*pi*n*(alpha - 1)", "2*pi*n*(alpha - 1)"}
    (flip,) = in_closed_form("flip", ("v", "g", "n"), *BALL)
    value = 4 * (sympy.pi**2 * flip["n"] ** 2 * derive.read("(1 - alpha)**2"))
    value += derive.read("4*(1 + alpha)**2")
    assert derive.simplest(flip["g"] ** 2 - value) == 0
    with mp.workdps(30):
        found = enclosed("flip", "g", {"phi": -2, "v": "6.28", "g": 5}, *BALL, n="1", alpha="1/5")
        exact = 2 * mp.sqrt(mp.pi**2 * mpf("0.64") + mpf("1.44"))
        low, high = found.box["g"]
        assert mpf(low.numerator) / low.denominator < exact < mpf(high.numerator) / high.denominator
        assert high - low < Fraction(1, 10**15)


def test_a_fold_that_its_parameter_does_not_unfold_is_none():
    """The logistic map at r = 1: two fixed points cross, and neither vanishes."""
    (found,) = candidates("fold", ("x", "r"), *LOGISTIC)
    assert found.what.kind == "transcritical" and found.values["crossing"] == 1
    assert [found.values[name] for name in ("r", "critical", "speed")] == [1, -1, 0]


# Maps of which the books know what happens: (condition, equations, {place: kind}).
CLASSES = [
    ("fold", ("x1 = x + a - x^2",), {"x = 0, a = 0": "fold"}),
    ("fold", ("x1 = x + a*x - x^2",), {"x = 0, a = 0": "transcritical"}),
    ("fold", ("x1 = x + a*x - x^3",), {"x = 0, a = 0": "pitchfork"}),
    ("fold", ("x1 = x + a^2*x - x^3",), {"x = 0, a = 0": "degenerate"}),
    ("fold", ("x1 = x + a^2 + x^2",), {"x = 0, a = 0": "degenerate"}),  # one point alone
    ("fold", ("x1 = x + a + x^3",), {"x = 0, a = 0": "degenerate"}),  # the fixed point goes on
    ("fold", ("x1 = x + a + x^4",), {"x = 0, a = 0": "degenerate"}),
    ("flip", ("x1 = -x - a*x + x^3",), {"x = 0, a = 0": "flip"}),
    ("flip", ("x1 = -x - a*x + x^2 - x^3",), {"x = 0, a = 0": "degenerate"}),  # c = 0
    ("flip", ("x1 = -x + a^2 + x^3",), {"x = 0, a = 0": "degenerate"}),  # speed 0
    ("fold", ("x1 = x + a - y^2 + x^2", "y1 = y/2 + x"), {"x = 0, y = 0, a = 0": "fold"}),
    ("fold", ("x1 = x + a*x - x^2 + y^2", "y1 = y/2"), {"x = 0, y = 0, a = 0": "transcritical"}),
    ("fold", ("x1 = x + a*x - x^3 + x*y", "y1 = y/2"), {"x = 0, y = 0, a = 0": "pitchfork"}),
    ("fold", ("x1 = x + y", "y1 = y + a - x^2"), {"x = 0, y = 0, a = 0": "resonance 1:1"}),
    ("fold", ("x1 = x + a - x^2", "y1 = -y"), {"x = 0, y = 0, a = 0": "degenerate"}),  # 1 and -1
    ("flip", ("x1 = -x + y", "y1 = -y + a*x + x^3"), {"x = 0, y = 0, a = 0": "resonance 1:2"}),
    (
        "neimark_sacker",
        ("x1 = y", "y1 = -b*x + y^2 + x*y"),
        {"x = 0, y = 0, b = 1": "resonance 1:4", "x = 2, y = 2, b = 3": "none"},
    ),
    ("neimark_sacker", ("x1 = y", "y1 = -b*x - y + y^2"), {"x = 0, y = 0, b = 1": "resonance 1:3"}),
    # at b = 1 the map preserves areas: there is a circle through every point near
    ("neimark_sacker", ("x1 = y", "y1 = -b*x + y + y^2"), {"x = 0, y = 0, b = 1": "degenerate"}),
    ("neimark_sacker", DELAYED, {"x = 1/2, y = 1/2, r = 2": "neimark_sacker"}),
    ("neimark_sacker", ("x1 = y", "y1 = -b*x + y"), {"x = 0, y = 0, b = 1": "degenerate"}),
    ("neimark_sacker", ("x1 = y", "y1 = -b*x + 3*y + y^2"), {"x = 0, y = 0, b = 1": "none"}),
    # with exp, log, sin and roots
    ("flip", ("x1 = a - exp(x)",), {"x = 0, a = 1": "flip"}),
    ("fold", ("x1 = a*sin(x)",), {"x = 0, a = 1": "pitchfork"}),
    ("flip", ("x1 = a*sin(x)",), {"x = 0, a = -1": "flip"}),
    ("fold", ("x1 = sqrt(x) + a",), {"x = 1/4, a = -1/4": "fold"}),
    ("fold", ("x1 = a + log(x)",), {"x = 1, a = 1": "fold"}),
    ("flip", ("x1 = a - log(x)",), {"x = 1, a = 1": "flip"}),
    ("flip", ("x1 = a*x - x^3",), {"x = 0, a = -1": "flip", "x = 1, a = 2": "flip"}),
    # a point at which the map is not defined
    (
        "flip",
        ("x1 = sqrt(r)^2*x*(1 - x)",),
        {"x = 0, r = -1": "undecided", "x = 2/3, r = 3": "flip"},
    ),
]


@pytest.mark.parametrize(("condition", "lines", "wanted"), CLASSES)
def test_what_a_candidate_is(condition, lines, wanted):
    of = Map.read(*lines)
    names = (*of.state, *of.parameters[:1])
    found = {
        ", ".join(f"{x} = {each.values[x]}" for x in (*sorted(of.state), names[-1])): each
        for each in candidates(condition, names, *lines)
    }
    for place, kind in wanted.items():
        assert found[place].what.kind == kind, (place, found[place].what)
        assert found[place].kept is (kind not in ("degenerate", "none", "undecided"))
        assert found[place].kept or found[place].what.why


@pytest.mark.slow
@pytest.mark.parametrize("root", ["1/2", "-3", "7/5"])
@pytest.mark.parametrize(
    ("lines", "names"),
    [
        (("x1 = a*x - b*x^3",), ("x", "a")),
        (("x1 = a*x - b*x^3 + c*x^2",), ("x", "a")),
        (("x1 = 1 - a*x^2 + y", "y1 = b*x"), ("x", "y", "b")),
    ],
)
def test_roots_of_parameters(lines, names, root):
    """A root is a parameter of its own: at its numbers it is a flip of the map as it was given."""
    found = [each for each in candidates("flip", names, *lines) if each.roots]
    assert len(found) == 1 and found[0].what.kind == "flip"
    numbers = {name: x.subs({"root": root, "c": 2}) for name, x in found[0].values.items()}
    state = sympy.symbols(names[:-1])
    images = [sympy.sympify(each.split("=")[1].replace("^", "**")) for each in lines]
    places = {"c": 2, **{x: numbers[x] for x in (*names, "a", "b") if x in numbers}}
    assert all((f - x).subs(places).equals(0) for f, x in zip(images, state, strict=True))
    jacobian = sympy.Matrix(images).jacobian(state).subs(places)
    assert (jacobian + sympy.eye(len(state))).det().equals(0)
    if len(state) == 1:  # Kuznetsov's coefficient of the flip
        second, third = (images[0].diff("x", k).subs(places) for k in (2, 3))
        assert (second**2 / 4 + third / 6 - numbers["critical"]).equals(0)


@pytest.mark.slow
def test_a_root_inside_of_a_root():
    """x^2 is a root of x^4 - c x^2 - b: at any roots it is a fold of the map as it was given."""
    line = "x1 = x + a + b*x + c*x^3/3 - x^5/5"
    (found,) = candidates("fold", ("x", "a"), line)
    assert found.what.kind == "fold" and [*found.roots] == ["root", "root2"]
    image = sympy.sympify(line.split("=")[1].replace("^", "**"))
    for root, root2 in (("1/2", "3/2"), ("-3", "1/7"), ("5", "-2")):
        places = {name: x.subs({"root": root, "root2": root2}) for name, x in found.values.items()}
        assert (image - sympy.Symbol("x")).subs(places).equals(0)
        assert (image.diff("x") - 1).subs(places).equals(0)
        assert (image.diff("x", 2).subs(places) / 2 - places["critical"]).equals(0)


SIDES = [  # of the parameter there are two fixed points, a cycle, a circle: on the other side none
    ("fold", "x1 = x + a - x^2", "greater a"),
    ("fold", "x1 = x - a - x^2", "smaller a"),
    ("fold", "x1 = x + a + x^2", "smaller a"),
    ("flip", "x1 = -x - a*x + x^3", "greater a"),
    ("flip", "x1 = -x - a*x - x^3", "smaller a"),
    ("flip", "x1 = -x + a*x + x^3", "smaller a"),
]


@pytest.mark.parametrize(("condition", "line", "side"), SIDES)
def test_on_which_side_it_is_by_counting(condition, line, side):
    known = candidates(condition, ("x", "a"), line)
    (found,) = [each for each in known if each.kept and each.values["a"] == 0]
    told = dict(meaning(found.what.kind, "a", False, found.signs.get))
    assert side in told["speed"]

    def count(a):
        x, image = sympy.Symbol("x"), sympy.sympify(line.split("=")[1].replace("^", "**"))
        image = image.subs("a", a)
        once = image if condition == "fold" else sympy.expand(image.subs(x, image))
        roots = sympy.Poly(sympy.expand(once - x), x).nroots(n=30)
        return sum(abs(complex(y).imag) < 1e-12 and abs(complex(y)) < 0.3 for y in roots)

    here, there = (count(sympy.Rational(sign, 100)) for sign in (1, -1))
    assert here != there and (here > there) is ("greater" in side)


@pytest.mark.slow
def test_closed_forms_and_enclosures_agree():
    """The real multipliers 3 + 2 sqrt(2), 3 - 2 sqrt(2) are none either way; the fold is one."""
    lines = ("x1 = y", "y1 = -b*x + y^2 + x*y")
    with pytest.raises(Undecided, match="real, of product 1"):
        enclosed("neimark_sacker", "b", {"x": 2, "y": 2, "b": 3}, *lines)
    with pytest.raises(Undecided):
        enclosed("neimark_sacker", "b", {"x": 0, "y": 0, "b": 1}, *lines)
    (found,) = candidates("fold", ("x", "a"), "x1 = x + a - x^2")
    near = enclosed("fold", "a", {"x": 0, "a": 0}, "x1 = x + a - x^2")
    assert found.signs == near.signs and found.what.kind == "fold"


@pytest.mark.slow
def test_what_depends_on_parameters_is_a_condition():
    (flip,) = candidates("flip", ("x", "y", "a"), *HENON)
    assert flip.what.kind == "flip" and "critical is not 0" in flip.what.where
    (circle,) = candidates("neimark_sacker", ("x", "y", "b"), "x1 = y", "y1 = -b*x + c*y + y^3")[:1]
    assert {"4 - trace^2 > 0", "trace is not 0", "trace + 1 is not 0"} <= {*circle.what.where}
    (root,) = candidates("fold", ("x", "a"), "x1 = a + c*log(x)")
    assert "the map is defined" in root.what.where


# -- by the formulas of Kuznetsov, with numerical derivatives --------------------------------------


def forms(f, point):
    """A, B, C of a map of the plane: its derivative and its second and third differentials."""

    def differential(order):
        places = list(product((0, 1), repeat=order))
        known = {
            (i, sum(c)): mp.diff(lambda x, y, i=i: f(x, y)[i], point, (order - sum(c), sum(c)))
            for i in (0, 1)
            for c in places
        }

        def apply(*vectors):
            terms = {c: mp.fprod(v[k] for v, k in zip(vectors, c, strict=True)) for c in places}
            return [mp.fsum(known[i, sum(c)] * terms[c] for c in places) for i in (0, 1)]

        return apply

    return differential(1), differential(2), differential(3)


def dual(a, multiplier, q):
    """The left eigenvector with p . q = 1 (p already conjugate)."""
    first, second = a((1, 0)), a((0, 1))
    p = [first[1], multiplier - first[0]]
    assert abs(dot(p, second) - multiplier * p[1]) < 1e-10
    return [each / dot(p, q) for each in p]


def solve(a, shift, right):
    """Solve (shift - A) x = right."""
    first, second = a((1, 0)), a((0, 1))
    rows = mp.matrix([[shift - first[0], -second[0]], [-first[1], shift - second[1]]])
    return list(mp.lu_solve(rows, mp.matrix(right)))


def dot(p, x):
    return p[0] * x[0] + p[1] * x[1]


def flip_coefficient(f, point):
    """c = <p, C(q, q, q) + 3 B(q, (1 - A)^-1 B(q, q))>/6, equation (5.41), q = (1, .)."""
    a, b, c = forms(f, point)
    columns = a((1, 0)), a((0, 1))
    q = [mpf(1), (-1 - columns[0][0]) / columns[1][0]]
    p = dual(a, mpf(-1), q)
    return (dot(p, c(q, q, q)) + 3 * dot(p, b(q, solve(a, 1, b(q, q))))) / 6


def circle_coefficient(f, point):
    """a = Re(conj(l) g21/2) - Re((1 - 2 l) conj(l)^2/(2 (1 - l)) g20 g11) - |g11|^2/2 - |g02|^2/4.

    Equation (4.22), q = (l - J22, J21).
    """
    a, b, c = forms(f, point)
    columns = a((1, 0)), a((0, 1))
    trace = columns[0][0] + columns[1][1]
    unit = mpc(trace, mp.sqrt(4 - trace**2)) / 2
    q = [unit - columns[1][1], mpc(columns[0][1])]
    p, bar = dual(a, unit, q), [mp.conj(each) for each in q]
    g20, g11, g02 = dot(p, b(q, q)), dot(p, b(q, bar)), dot(p, b(bar, bar))
    g21 = dot(p, c(q, q, bar))
    cross = (1 - 2 * unit) * mp.conj(unit) ** 2 / (2 * (1 - unit)) * g20 * g11
    last = mp.re(mp.conj(unit) * g21 / 2) - mp.re(cross)
    return last - abs(g11) ** 2 / 2 - abs(g02) ** 2 / 4


def middle(ends):
    return mpf(sum(ends).numerator) / sum(ends).denominator / 2


CASES = {
    "henon": (
        "flip", "a", {"x": 1, "y": "0.3", "a": "0.4"}, HENON, {"b": "3/10"},
        lambda x, y, a: (1 - a * x**2 + y, mpf("0.3") * x),
    ),
    "implicit ball": (
        "flip", "g", {"phi": -2, "v": "6.28", "g": 5}, BALL, {"n": "1", "alpha": "1/5"},
        lambda x, y, g: (x + y - 2 * mp.pi, y / 5 - g * mp.cos(x + y)),
    ),
    "delayed logistic": (
        "neimark_sacker", "r", {"x": ".5", "y": ".5", "r": 2}, DELAYED, {},
        lambda x, y, r: (r * x * (1 - y), x),
    ),
    "predator and prey": (
        "neimark_sacker", "d", {"x": ".5", "y": "1", "d": "2"},
        ("x1 = 3*x*(1 - x) - x*y", "y1 = d*x*y"), {},
        lambda x, y, d: (3 * x * (1 - x) - x * y, d * x * y),
    ),
}  # fmt: skip


PUBLISHED = {"delayed logistic"}  # its coefficient is compared with the book's, too


@pytest.mark.slow
@pytest.mark.parametrize(
    "case", [pytest.param(x, marks=[pytest.mark.long] * (x in PUBLISHED)) for x in CASES]
)
def test_coefficients_by_the_projection_method(case):
    kind, parameter, near, lines, numbers, f = CASES[case]
    found = enclosed(kind, parameter, near, *lines, **numbers)
    with mp.workdps(40):
        state = [middle(found.box[x]) for x in found.form.map.state]
        value = middle(found.box[parameter])
        wanted = (flip_coefficient if kind == "flip" else circle_coefficient)(
            lambda x, y: f(x, y, value), state
        )
        assert abs(wanted - middle(found.critical)) < mpf(10) ** -11, wanted
        assert abs(wanted) > 0.05


# -- what is refused -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (("x1 = r*x*(1 - x",), "not a formula"),
        (("x1 = x@2",), "in no formula"),
        (("r*x = 0",), "one or two variables"),
        (("x1 = x", "y1 = y", "z1 = z"), "one or two variables"),
        (("x1",), "an equation such as"),
    ],
)
def test_what_is_no_map(lines, message):
    with pytest.raises(ValueError, match=message):
        Map.read(*lines)


def test_names_that_are_taken():
    with pytest.raises(ValueError, match="something else: b2"):
        NormalForm(Map.read("x1 = b2*x*(1 - x)"), "flip")
    with pytest.raises(ValueError, match="something else: h"):
        NormalForm(Map.read("h1 = r*h*(1 - h)"), "flip")


@pytest.mark.slow
def test_the_coordinates_are_none_of_the_variables():
    """The delayed logistic map in variables u and v."""
    found = in_closed_form("neimark_sacker", ("u", "v", "r"), "u1 = r*u*(1 - v)", "v1 = u")
    assert (found[0]["r"], found[0]["critical"]) == (2, -2)


def test_names_with_capital_letters():
    found = in_closed_form("flip", ("x_", "r_"), "X1 = R*X*(1 - X)")
    assert [each["r_"] for each in found] == [-1, 3]


def test_an_implicit_map_has_the_jacobian_of_the_explicit_one():
    """x1 = f(x), and the same map given as the root of exp(x1) - exp(f(x))."""
    plain, hidden = Map.read(*RICKER), Map.read("exp(x1) = exp(a*x*exp(-x))")
    image = derive.read("a*x*exp(-x)")
    for of in (plain, hidden):
        there = of.jacobian[0, 0].subs(sympy.Symbol("x1"), image)
        assert sympy.simplify(there - sympy.diff(image, sympy.Symbol("x"))) == 0
