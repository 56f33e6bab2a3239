"""Enclosing what is on a tape: integers in dictionaries, an operation a line.

The bounds are those of `Enclosures`, which makes an object of each: this takes a third of the time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from proofs.trusted.kernel.arithmetic import MANY, Enclosure, Unproved
from proofs.trusted.kernel.expression import Steps, Tape
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.operations import LARGEST, Enclosures

Bounds = dict[int, int]  # by the places of nodes


@dataclass
class Partial:
    """What is enclosed already of the nodes that do not change with one variable.

    The other inputs stay the same. variable: its place among the inputs; -1: none changes.
    """

    variable: int = -1
    lower: Bounds = field(default_factory=dict)
    upper: Bounds = field(default_factory=dict)
    roots: set[tuple[int, ...]] = field(default_factory=set)  # that were asked for


def enclose(
    tape: Tape,
    roots: tuple[int, ...],
    inputs: Sequence[Enclosure],
    bits: int,
    partial: Partial | None = None,
) -> list[Enclosure]:
    """Enclose roots at inputs of one precision; Unproved where a node is not proved defined."""
    partial = partial or Partial()
    still, moving = tape.divided(roots, partial.variable)
    lower, upper = partial.lower, partial.upper
    if roots not in partial.roots:
        fresh = [step for step in still if step.place not in lower] if lower else still
        run(fresh, inputs, bits, lower, upper)
        partial.roots.add(roots)
    if moving:
        lower, upper = dict(lower), dict(upper)
        run(moving, inputs, bits, lower, upper)
    return [Enclosure(lower[root], upper[root], bits) for root in roots]


def run(steps: Steps, inputs: Sequence[Enclosure], bits: int, lower: Bounds, upper: Bounds) -> None:
    """Enclose nodes whose arguments are enclosed; a result beyond 2^256 raises Unproved."""
    limit, numbers, is_short = 1 << (bits + LARGEST), Enclosures(bits), bits < MANY
    pairs = dict[int, tuple[Enclosure, Enclosure]]()  # sin and cos of nodes
    METER.get().spend((3 + (bits >> 7)) * len(steps))
    for place, op, i, j, node in steps:
        if op == "*" and is_short:
            low, high = _product(lower[i], upper[i], lower[j], upper[j])
            low, high = low >> bits, -(-high >> bits)
        elif op == "+":
            low, high = lower[i] + lower[j], upper[i] + upper[j]
        elif op == "-":
            low, high = lower[i] - upper[j], upper[i] - lower[j]
        elif op == "negative":
            low, high = -upper[i], -lower[i]
        else:
            if op == "variable":
                result = inputs[int(node.datum)]
            elif op in ("sin", "cos"):
                if i not in pairs:
                    pairs[i] = Enclosure(lower[i], upper[i], bits).sincos()
                result = pairs[i][op == "cos"]
            else:
                values = [Enclosure(lower[k], upper[k], bits) for k in node.arguments]
                result = numbers.apply(op, values, node.datum)
            low, high = result.lo, result.hi
        if high >= limit or -low >= limit:
            raise Unproved("a value beyond 2^256")
        lower[place], upper[place] = low, high


def _product(a: int, b: int, c: int, d: int) -> tuple[int, int]:
    """Return the ends of [a, b] [c, d]."""
    if c >= 0:
        return a * (c if a >= 0 else d), b * (d if b >= 0 else c)
    if d <= 0:
        return b * (c if b >= 0 else d), a * (d if a >= 0 else c)
    return min(a * d, b * c), max(a * c, b * d)
