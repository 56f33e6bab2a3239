"""Looks for what is false in a lemma file: samples, Arb, numpy's eigenvalues; nothing of `proofs`.

`falsehoods(document)` yields the steps that a sample contradicts. It proves nothing, but it knows
nothing of the checker either: what the checker accepts must not be falsified here.
"""

import json
import random
from fractions import Fraction
from itertools import pairwise, product
from math import factorial

import flint
import numpy as np

from tests.intervals.oracle import arb

BITS = 120


def value(expression, inputs):
    """The value of an expression for Arb balls, or for power series of them."""
    if isinstance(expression, str):
        return inputs[expression] if expression in inputs else lift(arb(expression), inputs)
    op, *parts = expression
    if op == "pi":
        return lift(flint.arb.pi(), inputs)
    if op == "^":
        base, n = value(parts[0], inputs), int(parts[1])
        product = base
        for _ in range(min(abs(n), 1000) - 1):
            product = product * base
        return product if n > 0 else 1 / product
    values = [value(part, inputs) for part in parts]
    if len(values) == 1:
        return -values[0] if op == "-" else getattr(values[0], op)()
    total = values[0]
    for other in values[1:]:
        if op == "+":
            total = total + other
        elif op == "-":
            total = total - other
        else:
            total = total * other if op == "*" else total / other
    return total


def lift(ball, inputs):
    like = next(iter(inputs.values()))
    return flint.arb_series([ball], like.prec) if isinstance(like, flint.arb_series) else ball


def at(function, point):
    """The components at a point."""
    inputs = dict(zip(function["variables"], map(arb, point), strict=True))
    return [value(expression, inputs) for expression in function["values"]]


def slopes(function, point, variable, order=1):
    """The derivatives of the components in one variable, of one order."""
    inputs = {
        name: flint.arb_series([arb(x), arb(int(i == variable))], order + 1)
        for i, (name, x) in enumerate(zip(function["variables"], point, strict=True))
    }
    found = [value(expression, inputs) for expression in function["values"]]
    return [series[order] * factorial(order) for series in found]


def alone(function, component):
    """The function of one component."""
    return {**function, "values": [function["values"][component]]}


def sample(box, rng, count=8):
    """Corners, the middle and random points of a box."""
    sides = [(Fraction(low), Fraction(high)) for low, high in box]
    yield from list(product(*sides))[:32]
    for _ in range(count):
        shares = [Fraction(rng.randint(0, 64), 64) for _ in sides]
        yield tuple(a + s * (b - a) for s, (a, b) in zip(shares, sides, strict=True))


# -- inequalities ----------------------------------------------------------------------------------


def quantity(rule, claim, function, point):
    component = int(claim.get("component", "1")) - 1
    name = claim.get("variable", function["variables"][0] if rule == "expansion" else None)
    if name is None:
        return at(function, point)[component]
    return slopes(function, point, function["variables"].index(name))[component]


def contradicts(rule, claim, q):
    """Whether a value at one point is certainly not as claimed."""
    if not q.is_finite():
        return True
    if rule == "range":
        low, high = map(arb, claim["bounds"])
        return bool(q < low or q > high)
    if rule == "expansion":
        return bool(abs(q) < arb(claim["bound"]))
    return bool(q < 0 if claim["sign"] == "+" else q > 0)


def agrees(rule, claim, q):
    """Whether a value at one point is certainly as claimed."""
    if rule == "range":
        low, high = map(arb, claim["bounds"])
        return bool(low < q < high)
    if rule == "expansion":
        return bool(abs(q) > arb(claim["bound"]))
    return bool(q > 0 if claim["sign"] == "+" else q < 0)


def inequality(rule, step, functions, steps, rng):
    claim = step["claim"]
    function, box = functions[claim["function"]], claim.get("box", [claim.get("interval")])
    return any(
        contradicts(rule, claim, quantity(rule, claim, function, p)) for p in sample(box, rng)
    )


def refutation(rule, step, functions, steps, rng):
    claim, point = step["claim"], [Fraction(x) for x in step["point"]]
    function = functions[claim["function"]]
    box = claim.get("box", [claim.get("interval")])
    inside = all(Fraction(a) <= x <= Fraction(b) for x, (a, b) in zip(point, box, strict=True))
    q = quantity(step["rule"], claim, function, point)
    return not inside or agrees(step["rule"], claim, q)


# -- zeros -----------------------------------------------------------------------------------------


def plain(function, point):
    return np.array([float(v.mid()) for v in at(function, [Fraction(float(x)) for x in point])])


def newton(function, start, rounds=12):
    """A zero near a start, or None."""
    point = np.array([float(x) for x in start])
    n = len(point)
    for _ in range(rounds):
        with np.errstate(all="ignore"):
            values = plain(function, point)
            exact = [Fraction(float(x)) for x in point]
            columns = [[float(v.mid()) for v in slopes(function, exact, j)] for j in range(n)]
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


def unique_zero(rule, step, functions, steps, rng):
    return len(zeros_in(functions[step["function"]], step["box"], rng)) != 1


def no_zero(rule, step, functions, steps, rng):
    return bool(zeros_in(functions[step["function"]], step["box"], rng))


def changes(function, component, low, high, count=97):
    """How often a component certainly changes its sign on an interval."""
    signs = []
    for k in range(count + 1):
        v = at(function, [low + (high - low) * k / count])[component]
        if v > 0 or v < 0:
            signs.append(1 if v > 0 else -1)
    return sum(a != b for a, b in pairwise(signs))


def zero(rule, step, functions, steps, rng):
    low, high = map(Fraction, step["interval"])
    component = int(step["component"]) - 1
    return changes(functions[step["function"]], component, low, high) == 0


def root(rule, step, functions, steps, rng):
    claim = steps[step["monotone"]]["witness"]["claim"]
    function, component = functions[claim["function"]], int(claim["component"]) - 1
    ends = [at(function, [Fraction(x)])[component] for x in step["bracket"]]
    low, high = map(Fraction, claim["box"][0])
    opposite = (ends[0] < 0 < ends[1]) or (ends[1] < 0 < ends[0])
    return not opposite or changes(function, component, low, high) != 1


def identity(rule, step, functions, steps, rng):
    function = functions[step["function"]]
    left, right = int(step["left"]) - 1, int(step["right"]) - 1
    names = step["derivative"]
    box = [["1/3", "5/2"]] * len(function["variables"])
    first, second = alone(function, left), alone(function, right)
    for point in list(sample(box, rng, 4))[-4:]:
        if not names:
            (one,) = at(first, point)
        elif len(set(names)) == 1:
            place = function["variables"].index(names[0])
            (one,) = slopes(first, point, place, len(names))
        else:
            return False
        (two,) = at(second, point)
        if one.is_finite() and two.is_finite() and not one.overlaps(two):
            return True
    return False


# -- symbolic dynamics -----------------------------------------------------------------------------


def matrix(step):
    return [[Fraction(x) for x in row] for row in step["matrix"]]


def local(function, power, source, target, q):
    """The image of a point in coordinates, and floats of the derivative there."""
    a, b = matrix(source), flint.fmpq_mat([[fmpq(x) for x in row] for row in matrix(target)])
    n = len(a)
    centre = [Fraction(x) for x in source["centre"]]
    point = [
        c + sum(x * y for x, y in zip(row, q, strict=True))
        for c, row in zip(centre, a, strict=True)
    ]
    jac = np.array([[float(x) for x in row] for row in a])
    balls = [arb(x) for x in point]
    for _ in range(power):
        middle = [Fraction(float(x.mid())) for x in balls]
        columns = [[float(v.mid()) for v in slopes(function, middle, j)] for j in range(n)]
        jac = np.array(columns).T @ jac
        inputs = dict(zip(function["variables"], balls, strict=True))
        balls = [value(expression, inputs) for expression in function["values"]]
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


def covers(rule, step, functions, steps, rng):
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


def graph(rule, step, functions, steps, rng):
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


def entropy(rule, step, functions, steps, rng):
    names, pairs = edges(steps[step["graph"]]["witness"], steps)
    adjacency = np.zeros((len(names), len(names)))
    for a, b in pairs:
        adjacency[names.index(a), names.index(b)] = 1
    radius = max(abs(np.linalg.eigvals(adjacency)))
    return float(step["growth"]) > radius ** int(step["length"]) * (1 + 1e-9)


def cone(rule, step, functions, steps, rng):
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
    **dict.fromkeys(("sign", "monotone", "range", "expansion"), inequality),
    "refute-at": refutation,
    "unique-zero": unique_zero,
    "no-zero": no_zero,
    "zero": zero,
    "root": root,
    "identity": identity,
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
            rule = step["rule"]
            judge = JUDGES[rule]
            if judge(rule, step["witness"], document["functions"], document["steps"], rng):
                yield name
