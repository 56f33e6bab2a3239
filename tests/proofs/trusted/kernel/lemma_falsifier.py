"""Looks for what is false in a lemma file: samples, Arb, numpy's eigenvalues; nothing of `proofs`.

`falsehoods(document)` yields the steps that a sample contradicts. It proves nothing, but it knows
nothing of the checker either: what the checker accepts must not be falsified here.
"""

import ast
import json
import random
from fractions import Fraction
from itertools import pairwise, product

import flint
import numpy as np

from tests.intervals.oracle import arb
from tests.proofs.trusted.kernel.arb_formulas import slopes, value

BITS = 120


def at(function, point):
    """The components at a point."""
    inputs = dict(zip(function["variables"], map(arb, point), strict=True))
    return [value(text, inputs) for text in function["values"]]


def columns_at(function, point):
    """The derivatives of the components, a column a variable."""
    inputs = dict(zip(function["variables"], map(arb, point), strict=True))
    return [[slopes(text, inputs, name) for text in function["values"]] for name in inputs]


def sample(box, rng, count=8):
    """Corners, the middle and random points of a box."""
    sides = [(Fraction(low), Fraction(high)) for low, high in box]
    yield from list(product(*sides))[:32]
    for _ in range(count):
        shares = [Fraction(rng.randint(0, 64), 64) for _ in sides]
        yield tuple(a + s * (b - a) for s, (a, b) in zip(shares, sides, strict=True))


# -- values and equations --------------------------------------------------------------------------


def bounded(step, functions, steps, rng):
    """A value outside the bounds, or undefined; inside a box all of it is defined."""
    low, high = map(arb, step["bounds"])
    for point in sample(step["box"].values(), rng):
        q = value(step["function"], dict(zip(step["box"], map(arb, point), strict=True)))
        if not q.is_finite() or q < low or q > high:
            return True
    return False


def names_of(*texts):
    tree = (node for text in texts for node in ast.walk(ast.parse(text)))
    found = {node.id for node in tree if isinstance(node, ast.Name)}
    return sorted(found - {"pi", "sin", "cos", "exp", "log", "sqrt", "D", "at"})


def equal(step, functions, steps, rng):
    names = names_of(step["left"], step["right"])
    for point in list(sample([["1/3", "5/2"]] * len(names), rng, 4))[-4:]:
        inputs = dict(zip(names, map(arb, point), strict=True))
        one, two = (value(step[side], inputs) for side in ("left", "right"))
        if one.is_finite() and two.is_finite() and not one.overlaps(two):
            return True
    return False


def series(step, functions, steps, rng):
    """At x = 1e-5 the rest is below 1e-4 times the last power, for others about 1."""
    names = names_of(step["function"], *step["coefficients"])
    inputs = {name: arb(Fraction(rng.randint(50, 200), 97)) for name in names}
    x = inputs[step["variable"]] = arb("1/100000")
    known = sum((value(c, inputs) * x**n for n, c in enumerate(step["coefficients"])), arb(0))
    rest = value(step["function"], inputs) - known
    return bool(abs(rest) > x ** (len(step["coefficients"]) - 1) / 10000)


# -- zeros -----------------------------------------------------------------------------------------


def plain(function, point):
    return np.array([float(v.mid()) for v in at(function, [Fraction(float(x)) for x in point])])


def newton(function, start, rounds=12):
    """A zero near a start, or None."""
    point = np.array([float(x) for x in start])
    for _ in range(rounds):
        with np.errstate(all="ignore"):
            values = plain(function, point)
            exact = [Fraction(float(x)) for x in point]
            columns = [[float(v.mid()) for v in column] for column in columns_at(function, exact)]
            try:
                point = point - np.linalg.solve(np.array(columns).T, values)
            except np.linalg.LinAlgError:
                return None
        if not np.all(np.isfinite(point)) or np.max(np.abs(point)) > 1e9:
            return None
    return point if np.max(np.abs(plain(function, point))) < 1e-9 else None


def zeros_in(function, box, rng):
    """Zeros that Newton's method finds clearly inside the box."""
    low, high = (np.array([float(Fraction(side[k])) for side in box]) for k in (0, 1))
    found = []
    for start in sample(box, rng, 6):
        zero = newton(function, start)
        if zero is None or np.any(zero <= low + 1e-9) or np.any(zero >= high - 1e-9):
            continue
        if all(np.max(np.abs(zero - other)) > 1e-7 for other in found):
            found.append(zero)
    return found


def unique_zero(step, functions, steps, rng):
    return len(zeros_in(functions[step["function"]], step["box"], rng)) != 1


def changes(text, name, low, high, count=97):
    """How often a function certainly changes its sign on an interval."""
    signs = []
    for k in range(count + 1):
        v = value(text, {name: arb(low + (high - low) * k / count)})
        if v > 0 or v < 0:
            signs.append(1 if v > 0 else -1)
    return sum(a != b for a, b in pairwise(signs))


def zero(step, functions, steps, rng):
    bounds = steps[step["value"]]["witness"]
    ((name, interval),) = bounds["box"].items()
    sides = [tuple(map(Fraction, side)) for side in (step["bracket"], interval)]
    if changes(step["function"], name, *sides[0]) % 2 == 0:
        return True
    one_sign = Fraction(bounds["bounds"][0]) * Fraction(bounds["bounds"][1]) > 0
    only = bounds["function"] != step["function"] and one_sign
    return only and changes(step["function"], name, *sides[1]) != 1


# -- symbolic dynamics -----------------------------------------------------------------------------


def matrix(step):
    return [[Fraction(x) for x in row] for row in step["matrix"]]


def local(function, power, source, target, q):
    """The image of a point in coordinates, and floats of the derivative there."""
    a, b = matrix(source), flint.fmpq_mat([[fmpq(x) for x in row] for row in matrix(target)])
    centre = [Fraction(x) for x in source["centre"]]
    point = [
        c + sum(x * y for x, y in zip(row, q, strict=True))
        for c, row in zip(centre, a, strict=True)
    ]
    jac = np.array([[float(x) for x in row] for row in a])
    balls = [arb(x) for x in point]
    for _ in range(power):
        middle = [Fraction(float(x.mid())) for x in balls]
        columns = [[float(v.mid()) for v in column] for column in columns_at(function, middle)]
        jac = np.array(columns).T @ jac
        inputs = dict(zip(function["variables"], balls, strict=True))
        balls = [value(text, inputs) for text in function["values"]]
    inverse = [[arb(Fraction(int(x.p), int(x.q))) for x in row] for row in b.inv().table()]
    moved = [x - arb(d) for x, d in zip(balls, target["centre"], strict=True)]
    image = [sum((x * y for x, y in zip(row, moved, strict=True)), arb(0)) for row in inverse]
    plain_inverse = np.array([[float(x.mid()) for x in row] for row in inverse])
    return image, plain_inverse @ jac


def fmpq(x):
    return flint.fmpq(x.numerator, x.denominator)


def parts(step, functions, steps):
    sets = [steps[step[name]]["witness"] for name in ("source", "target")]
    return functions[step["function"]], int(step["power"]), *sets


def covers(step, functions, steps, rng):
    data = parts(step, functions, steps)
    n, s = len(data[0]["variables"]), 1 if step["sign"] == "+" else -1
    for q in sample([["-1", "1"]] * n, rng):
        image, _ = local(*data, q)
        if not all(v.is_finite() for v in image):
            return True
        if abs(q[0]) == 1 and s * q[0].numerator * image[0] < 1:
            return True
        if abs(image[0]) < 1 and any(abs(v) > 1 for v in image[1:]):
            return True
    return False


def edges(step, steps):
    found = [steps[name]["witness"] for name in step["covers"]]
    pairs = [(one["source"], one["target"]) for one in found]
    return list(dict.fromkeys(name for pair in pairs for name in pair)), pairs


def graph(step, functions, steps, rng):
    """Random points of each set: none may lie in another."""
    names, _ = edges(step, steps)
    for one, two in product(names, repeat=2):
        if one == two:
            continue
        n = len(steps[one]["witness"]["centre"])
        for q in sample([["-1", "1"]] * n, rng, 30):
            a = np.array(matrix(steps[one]["witness"]), float)
            b = np.array(matrix(steps[two]["witness"]), float)
            c, d = (
                np.array([float(Fraction(x)) for x in steps[k]["witness"]["centre"]])
                for k in (one, two)
            )
            inside = np.linalg.solve(b, c + a @ np.array(q, float) - d)
            if np.max(np.abs(inside)) < 1 - 1e-9:
                return True
    return False


def entropy(step, functions, steps, rng):
    names, pairs = edges(steps[step["graph"]]["witness"], steps)
    adjacency = np.zeros((len(names), len(names)))
    for a, b in pairs:
        adjacency[names.index(a), names.index(b)] = 1
    radius = max(abs(np.linalg.eigvals(adjacency)))
    return float(step["growth"]) > radius ** int(step["length"]) * (1 + 1e-9)


def cone(step, functions, steps, rng):
    witness = steps[step["graph"]]["witness"]
    names, pairs = edges(witness, steps)
    forms = [np.diag([float(Fraction(x)) for x in form]) for form in step["forms"]]
    for name, (a, b), relation in zip(witness["covers"], pairs, step["relations"], strict=True):
        data = parts(steps[name]["witness"], functions, steps)
        n = len(forms[0])
        before, after = forms[names.index(a)], forms[names.index(b)]
        bounds = np.array([[float(Fraction(x)) for x in side] for side in relation["jacobian"]])
        for q in sample([["-1", "1"]] * n, rng, 6):
            image, jac = local(*data, q)
            stays = all(abs(v) < 1 for v in image)
            inside = all(
                Fraction(low) <= x <= Fraction(high)
                for x, (low, high) in zip(q, relation["box"], strict=True)
            )
            flat = jac.reshape(-1)
            if stays and not inside:
                return True
            if inside and np.any((flat < bounds[:, 0] - 1e-9) | (flat > bounds[:, 1] + 1e-9)):
                return True
            shares = np.array([rng.random() for _ in flat])
            for d in (jac if inside else None, (bounds @ [0.5, 0.5]).reshape(n, n)):
                if d is not None and np.min(np.linalg.eigvalsh(d.T @ after @ d - before)) <= 0:
                    return True
            d = (bounds[:, 0] + shares * (bounds[:, 1] - bounds[:, 0])).reshape(n, n)
            if np.min(np.linalg.eigvalsh(d.T @ after @ d - before)) <= 0:
                return True
    return False


JUDGES = {
    "formula-value": bounded,
    "formula-equal": equal,
    "formula-series": series,
    "unique-zero": unique_zero,
    "zero": zero,
    "covers": covers,
    "graph": graph,
    "entropy": entropy,
    "cone": cone,
    "h-set": lambda *_: False,
}


def falsehoods(source, seed=0):
    """Yield the names of the steps of a file that a sample contradicts."""
    document, rng = json.loads(source), random.Random(seed)
    with flint.ctx.workprec(BITS):
        for name, step in document["steps"].items():
            judge = JUDGES[step["rule"]]
            if judge(step["witness"], document["functions"], document["steps"], rng):
                yield name
