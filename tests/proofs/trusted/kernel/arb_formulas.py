"""Formulas evaluated by Python's reading and Arb's numbers, which know nothing of the checker."""

import ast
from math import factorial

import flint

from tests.intervals.oracle import arb

OPERATIONS = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
}


def value(text, inputs):
    """The value of a text for Arb balls, {name: ball}, or for power series of them."""
    return of(ast.parse(text, mode="eval").body, inputs)


def of(node, inputs):  # noqa: PLR0911
    match node:
        case ast.Constant(value=number):
            return lift(arb(number), inputs)
        case ast.Name(id="pi"):
            return lift(flint.arb.pi(), inputs)
        case ast.Name(id=name):
            return inputs[name]
        case ast.UnaryOp(operand=inner):
            return -of(inner, inputs)
        case ast.BinOp(op=ast.Pow(), left=base, right=exponent):
            return repeated(of(base, inputs), int(ast.unparse(exponent)))
        case ast.BinOp(op=op, left=left, right=right):
            return OPERATIONS[type(op)](of(left, inputs), of(right, inputs))
        case ast.Call(func=ast.Name(id="D"), args=[function, *by]):
            return derivative(function, [name.id for name in by], inputs)
        case ast.Call(func=ast.Name(id="at"), args=[function], keywords=places):
            return of(function, {**inputs, **{p.arg: of(p.value, inputs) for p in places}})
        case ast.Call(func=ast.Name(id=name), args=[inner]):
            return getattr(of(inner, inputs), name)()


def repeated(x, n):
    """x^n by multiplication: Arb's own power is undefined on balls around 0."""
    product = x
    for _ in range(min(abs(n), 1000) - 1):
        product = product * x
    return product if n > 0 else 1 / product


def derivative(function, names, inputs):
    """The derivative by one variable, as often as it is named, by Arb's power series."""
    (name,), order = set(names), len(names)
    series = {
        other: flint.arb_series([ball, int(other == name)], order + 1)
        for other, ball in inputs.items()
    }
    return of(function, series)[order] * factorial(order)


def lift(ball, inputs):
    like = next(iter(inputs.values()), ball)
    return flint.arb_series([ball], like.prec) if isinstance(like, flint.arb_series) else ball


def slopes(text, inputs, name):
    """The derivative of a text by a variable, at balls."""
    return derivative(ast.parse(text, mode="eval").body, [name], inputs)
