"""The interval Newton method in one variable; `krawczyk` has several, and many boxes at once."""

from collections.abc import Callable
from enum import Enum
from typing import Any, NamedTuple, overload

from intervals.formula import Formula, NoFormula
from intervals.generic import ends, middle
from intervals.interval import Interval
from intervals.jet import Jet
from intervals.systems import Function


class Roots(Enum):
    """What is proved about the zeros of f in the given box."""

    UNIQUE = "exactly one zero"
    NONE = "no zero"
    AT_LEAST_ONE = "at least one zero"
    UNDECIDED = "not decided"


class NewtonResult(NamedTuple):
    """The outcome, a box that contains every zero of the given box, and a reason."""

    outcome: Roots
    box: Interval | None
    reason: str


def derivative(f: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return f', for a formula f that takes jets, from a jet of order 1."""
    return lambda x: f(Jet(x, x * 0 + 1)).derivative()


@overload
def newton(f: Function, box: Interval, /, *, steps: int = 60) -> NewtonResult: ...
@overload
def newton(f: Function, df: Function, box: Interval, /, *, steps: int = 60) -> NewtonResult: ...
def newton(f: Function, *given: Any, steps: int = 60) -> NewtonResult:
    """Decide existence and uniqueness of a zero of f in a box, and contract the box.

    newton(f, box) takes a formula; newton(f, df, box) also functions of Intervals, with Intervals
    as values, that enclose a C^1 function and its derivative.

    Theorem (Moore; Neumaier 1990, 5.1). Let f be C^1 on X, m in X, and F' an enclosure of f'
    over X with 0 not in F'. N = m - F(m) / F' contains every zero of f in X. If N and X are
    disjoint there is none. If N is a subset of X there is exactly one. Whatever F' is: there is
    none if F(X) does not contain 0, and at least one if f <= 0 at one end and f >= 0 at the other.

    The inclusion is tested against the box that N was computed from, never against an already
    intersected one; uniqueness holds on that box, and as no zero is lost on the way to it, on
    the original box. Iteration ends when the box no longer shrinks by a quarter.
    """
    *slope_of, box = given
    try:
        f = Formula(f, 1).only
    except NoFormula:
        if not slope_of:
            raise
    df = slope_of[0] if slope_of else derivative(f)
    proved = False
    reason = "the Newton image leaves the box"
    for _ in range(steps):
        slope = df(box)
        if slope.contains_zero():
            reason = "the derivative's enclosure contains 0"
            if not (proved or f(box).contains_zero()):
                return NewtonResult(Roots.NONE, None, "the enclosure of f over the box excludes 0")
            break
        point = middle(box)
        image = point - f(point) / slope
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
    if steps and _changes_sign(f, box):
        return NewtonResult(Roots.AT_LEAST_ONE, box, f"f changes its sign, but {reason}")
    return NewtonResult(Roots.UNDECIDED, box, reason)


def _changes_sign(f: Callable[..., Any], box: Interval) -> bool:
    """Whether f <= 0 at one end and f >= 0 at the other, so that f has a zero if continuous."""
    left, right = map(f, ends(box))
    return bool(left.sup <= 0 <= right.inf or right.sup <= 0 <= left.inf)
