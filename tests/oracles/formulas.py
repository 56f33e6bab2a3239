"""Formulas as texts, evaluated at points; judges of what is concluded about them.

A reader of its own: Python's `ast`, Arb numbers, D(F, x, ...) by central differences at high
precision. Sampling proves nothing; what it contradicts is false.
"""

import ast
import math
import operator
from fractions import Fraction
from functools import lru_cache
from types import SimpleNamespace

import flint

BITS, STEP = 900, -150
_DEEP, _DEEP_STEP = 3000, -500  # for series
_OPERATIONS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


@lru_cache(maxsize=2048)
def compiled(text):
    """A function of an environment {name: Arb number}, and the names of its free variables.

    Where it has no D, power series may stand for numbers.
    """
    return _built(ast.parse(text.replace("^", "**"), mode="eval").body)


def _built(node):
    match node:
        case ast.Constant(value=value):
            return (lambda env, own=Fraction(str(value)): exact(own)), frozenset()
        case ast.Name(id=name):
            known = (lambda env: flint.arb.pi()) if name == "pi" else operator.itemgetter(name)
            return known, frozenset({name} - {"pi"})
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            value, free = _built(inner)
            return (lambda env: -value(env)), free
        case ast.BinOp(left=base, op=ast.Pow(), right=exponent):
            (value, free), n = _built(base), int(ast.literal_eval(exponent))
            return (lambda env: _power(value(env), n)), free
        case ast.BinOp(left=left, op=op, right=right):
            (a, free), (b, more), act = _built(left), _built(right), _OPERATIONS[type(op)]
            return (lambda env: act(a(env), b(env))), free | more
        case ast.Call(func=ast.Name(id=name), args=[inner, *others], keywords=places):
            return _called(name, inner, others, places)
    raise ValueError(f"no formula: {ast.dump(node)[:80]}")


def _called(name, inner, others, places):
    value, free = _built(inner)
    if name == "D":
        for other in others:
            value = _derivative(value, other.id)
        return value, free
    if name == "at":
        moved = {one.arg: _built(one.value) for one in places}
        used = (names for _, names in moved.values())

        def substituted(env):
            return value({**env, **{key: other(env) for key, (other, _) in moved.items()}})

        return substituted, (free - set(moved)).union(*used)
    if name == "sqrt":
        return (lambda env: _root(value(env))), free
    return (lambda env: getattr(value(env), name)()), free


def _power(x, n):
    """Of a ball that holds 0 flint knows no powers."""
    if abs(n) >= 100:
        return x**n
    power = math.prod([x] * abs(n), start=flint.arb(1))
    return power if n >= 0 else 1 / power


def _root(x):
    """A square root; of what may be 0, by differences for derivatives, that of what is not < 0."""
    may_vanish = isinstance(x, flint.arb) and x.contains(0)
    return x.abs_upper().sqrt().union(flint.arb(0)) if may_vanish else x.sqrt()


def _derivative(value, name):
    def central(env):
        step = flint.arb(2) ** (_DEEP_STEP if flint.ctx.prec > BITS else STEP)
        here = env.get(name, flint.arb(0))  # the formula may be without it
        up, down = ({**env, name: here + sign * step} for sign in (1, -1))
        return (value(up) - value(down)) / (2 * step)

    return central


def exact(x):
    """A rational at the current precision."""
    x = Fraction(x)
    return flint.arb(x.numerator) / x.denominator


def number(text, env):
    """The value of a text, or None where it is not defined."""
    found = compiled(text)[0](env)
    return found if found.is_finite() else None


def differ(one, two):
    """Whether two numbers are different, beyond what differences for derivatives leave open."""
    return bool(abs(one - two) > exact(Fraction(1, 10**30)) * (1 + abs(one) + abs(two)))


def random_env(names, rng):
    """Random values, some of them negative or large."""
    return {name: exact(Fraction(rng.randint(-2000, 3000), 997)) for name in sorted(names)}


def equal(view, rng, wanted=2):
    """left = right, wherever both are defined."""
    with flint.ctx.workprec(BITS):
        names = compiled(view.left)[1] | compiled(view.right)[1]
        for _ in range(12):
            env = random_env(names, rng)
            sides = [number(text, env) for text in (view.left, view.right)]
            if None in sides:
                continue
            if differ(*sides):
                return [f"the sides differ at {_told(env)}"]
            wanted -= 1
            if not wanted:
                return []
        return []


def series(view, rng):
    """function - sum of the terms is O(x^n) as x -> 0, from both sides."""
    n, name = len(view.coefficients), view.variable
    with flint.ctx.workprec(_DEEP):
        names = frozenset().union(
            *(compiled(c)[1] for c in (view.function, *view.coefficients, *view.nonzero))
        )
        for sign in (1, -1):
            for _ in range(6):
                env = {**random_env(names, rng), name: sign * flint.arb(2) ** -90}
                terms = [number(text, env) for text in view.coefficients]
                whole = number(view.function, env)
                if None in (whole, *terms) or any(number(t, env) == 0 for t in view.nonzero):
                    continue
                rest = whole - sum((c * env[name] ** k for k, c in enumerate(terms)), flint.arb(0))
                if abs(rest) > flint.arb(2) ** (45 - 90 * n) * (1 + sum(map(abs, terms))):
                    return [f"not the series at {_told(env)}"]
                break
    return []


def value(view, rng):
    """The function is defined on the box and lies within bounds there."""
    with flint.ctx.workprec(300):
        for env in box_points(dict(view.box), rng, 6):
            found = number(view.function, env)
            if found is None:
                return [f"not defined at {_told(env)}"]
            if found < exact(view.bounds[0]) or found > exact(view.bounds[1]):
                return [f"the value at {_told(env)} is {found.str(12)}"]
    return []


def expressions(view, rng):
    """Each lemma holds with the expressions in the place of their names."""
    given = ", ".join(f"{name}={text}" for name, text in view.expressions)
    told = []
    for lemma in view.lemmas:
        put = {
            field: tuple(f"at({x}, {given})" for x in old)
            if isinstance(old, tuple)
            else f"at({old}, {given})"
            for field, old in vars(lemma).items()
            if field not in ("kind", "variable")
        }
        moved = SimpleNamespace(**{**vars(lemma), **put})
        told += (equal if lemma.kind == "Equal" else series)(moved, rng)
    return told


def box_points(sides, rng, count):
    """The two extreme corners of a box, and random points."""
    for k in range(count):
        shares = {name: Fraction(rng.randint(0, 1024), 1024) if k > 1 else k for name in sides}
        yield {name: exact(a + shares[name] * (b - a)) for name, (a, b) in sides.items()}


def _told(env):
    return ", ".join(f"{name} = {float(x):.6g}" for name, x in env.items())


def theorem(view, rng):
    """A text that follows from formulas, which are judged themselves: nothing to sample."""
    return [] if view.text else ["no text"]
