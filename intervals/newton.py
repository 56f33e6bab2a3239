"""The interval Newton method in one variable."""

from collections.abc import Callable
from enum import Enum
from typing import NamedTuple

from intervals.interval import Interval


class Roots(Enum):
    """What interval Newton proves about the zeros of f in the given box."""

    UNIQUE = "exactly one zero"
    NONE = "no zero"
    UNDECIDED = "not decided"


class NewtonResult(NamedTuple):
    """The outcome, a box that contains every zero of the given box, and a reason."""

    outcome: Roots
    box: Interval | None
    reason: str


def newton(
    f: Callable[[Interval], Interval],
    df: Callable[[Interval], Interval],
    box: Interval,
    *,
    steps: int = 60,
) -> NewtonResult:
    """Decide existence and uniqueness of a zero of f in `box`, and contract the box.

    Theorem (Moore; Neumaier 1990, 5.1). Let f be C^1 on X, m in X, and F' an enclosure of f'
    over X with 0 not in F'. N = m - F(m) / F' contains every zero of f in X. If N and X are
    disjoint there is none. If N is a subset of X there is exactly one.

    The inclusion is tested against the box that N was computed from, never against an already
    intersected one; uniqueness holds on that box, and as no zero is lost on the way to it, on
    the original box. Iteration ends when the box no longer shrinks by a quarter.
    """
    proved = False
    for _ in range(steps):
        slope = df(box)
        if slope.contains_zero():
            if proved:
                break
            return NewtonResult(Roots.UNDECIDED, box, "the derivative's enclosure contains 0")
        middle = Interval(box.mid, precision=box.precision)
        image = middle - f(middle) / slope
        proved = proved or (box.inf <= image.inf and image.sup <= box.sup)
        smaller = image.intersection(box)
        if smaller is None:
            return NewtonResult(Roots.NONE, None, "the Newton image is disjoint from the box")
        stalled = 4 * smaller.wid >= 3 * box.wid
        box = smaller
        if stalled:
            break
    if proved:
        return NewtonResult(Roots.UNIQUE, box, "the Newton image lies in its box")
    return NewtonResult(Roots.UNDECIDED, box, "the Newton image leaves the box")
